// Closest points of a mesh from any face as start, also one without area, against the distances to
// all triangles: those of the search in the whole mesh do not depend on the start; those of the
// search over neighbors are closest around themselves, and nearly always in the whole mesh for a start
// near by.
#include <CGAL/Random.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Mesh_distance.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Mesh_projection.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <Eigen/Core>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <vector>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;
typedef CGAL::Simple_cartesian<double> K;
typedef K::Point_3 Point_3;
typedef CGAL::Surface_mesh<Point_3> Mesh;
typedef SMSC::internal::Mesh_projection Projection;

// a tetrahedron whose bottom has a vertex in the middle of an edge: its face there has no area
Mesh tetrahedron_with_flat_face()
{
  Mesh mesh;
  const auto a = mesh.add_vertex(Point_3(0, 0, 0)), b = mesh.add_vertex(Point_3(2, 0, 0));
  const auto c = mesh.add_vertex(Point_3(0, 2, 0)), d = mesh.add_vertex(Point_3(0, 0, 2));
  const auto middle = mesh.add_vertex(Point_3(1, 0, 0));
  mesh.add_face(a, c, b);
  mesh.add_face(a, b, middle); // no area
  mesh.add_face(a, middle, d);
  mesh.add_face(middle, b, d);
  mesh.add_face(b, c, d);
  mesh.add_face(c, a, d);
  return mesh;
}

// a bumpy torus of 12 times 12 cells
Mesh torus()
{
  const int n = 12;
  Mesh mesh;
  for(int j = 0; j < n; ++j)
    for(int i = 0; i < n; ++i)
    {
      const double u = 2 * CGAL_PI * i / n, v = 2 * CGAL_PI * j / n;
      const double r = 0.8 + 0.2 * std::sin(3 * u) * std::cos(2 * v);
      const double radius = 2 + r * std::cos(v);
      mesh.add_vertex(Point_3(radius * std::cos(u), radius * std::sin(u), r * std::sin(v)));
    }
  const auto vertex = [](int i, int j) { return Mesh::Vertex_index(unsigned(j % n * n + i % n)); };
  for(int j = 0; j < n; ++j)
    for(int i = 0; i < n; ++i)
    {
      mesh.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      mesh.add_face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  return mesh;
}

std::vector<K::Triangle_3> triangles(const Mesh& mesh)
{
  std::vector<K::Triangle_3> result;
  for(auto f : mesh.faces())
  {
    std::vector<Point_3> p;
    for(auto v : vertices_around_face(mesh.halfedge(f), mesh))
      p.push_back(mesh.point(v));
    result.emplace_back(p[0], p[1], p[2]);
  }
  return result;
}

double smallest_distance(const std::vector<K::Triangle_3>& triangles, const Point_3& query)
{
  double result = (std::numeric_limits<double>::infinity)();
  for(const K::Triangle_3& t : triangles)
    result = (std::min)(result, std::sqrt(CGAL::squared_distance(query, t)));
  return result;
}

double distance(const Point_3& p, const K::Triangle_3& t)
{
  return std::sqrt(CGAL::squared_distance(p, t));
}

void test_near_foot(const std::vector<K::Triangle_3>& triangles, const Projection& projection,
                    const Point_3& query, std::size_t start)
{
  const auto foot = projection.near_foot(query, start);
  const double reached = std::sqrt(CGAL::squared_distance(query, foot.point));
  assert(distance(foot.point, triangles[foot.face]) < 1e-13);
  assert(reached < distance(query, triangles[start]) + 1e-13);
  assert(!triangles[foot.face].is_degenerate());
  for(const K::Triangle_3& t : triangles)
    assert(distance(foot.point, t) > 1e-12 || distance(query, t) > reached - 1e-12);
}

// queries a little off the mesh, and a start at the face there; above a concave edge, another face may
// be closer without being a neighbor
void test_near_start(const std::vector<K::Triangle_3>& triangles, const Projection& projection,
                     CGAL::Random& random)
{
  const int samples_of_face = 20;
  std::size_t others = 0;
  for(std::size_t face = 0; face < triangles.size(); ++face)
    for(int i = 0; i < samples_of_face; ++i)
    {
      const double a = random.get_double(), b = random.get_double() * (1 - a);
      const double height = 0.02 * random.get_double();
      const K::Triangle_3& t = triangles[face];
      const K::Vector_3 normal = projection.normal(face);
      const double length = std::sqrt(normal.squared_length());
      const Point_3 query = CGAL::barycenter(t[0], a, t[1], b, t[2], 1 - a - b)
                            + (length > 0 ? height / length : 0) * normal;
      const auto foot = projection.near_foot(query, face);
      const double excess = std::sqrt(CGAL::squared_distance(query, foot.point))
                            - smallest_distance(triangles, query);
      assert(excess > -1e-13 && excess < 0.1 * height + 1e-13);
      if(excess > 1e-13)
        ++others;
    }
  assert(200 * others < samples_of_face * triangles.size());
}

// each edge inside the mesh has one number, that of both its faces, and its middle
void test_edges(const Mesh& mesh)
{
  const Projection projection(mesh, mesh.points());
  std::vector<int> faces_of_edge(projection.number_of_edges(), 0);
  std::size_t face = 0;
  for(auto f : mesh.faces())
  {
    std::size_t i = 0;
    for(auto h : halfedges_around_face(mesh.halfedge(f), mesh))
    {
      const std::size_t edge = projection.edges(face)[i++];
      assert((edge == Projection::none) == mesh.is_border(mesh.edge(h)));
      if(edge == Projection::none)
        continue;
      ++faces_of_edge[edge];
      const Point_3 middle = CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)));
      assert(CGAL::squared_distance(projection.middle(edge), middle) < 1e-28);
    }
    ++face;
  }
  for(int n : faces_of_edge)
    assert(n == 2);
}

void test(const Mesh& mesh, double reach, CGAL::Random& random)
{
  const std::vector<K::Triangle_3> all = triangles(mesh);
  const Projection projection(mesh, mesh.points());
  test_near_start(all, projection, random);
  const SMSC::Boundary_curve_network_3<Mesh> network(mesh);
  const SMSC::internal::Mesh_distance distance(mesh, mesh.points(), network);
  for(int i = 0; i < 300; ++i)
  {
    const Point_3 query(random.get_double(-reach, reach), random.get_double(-reach, reach),
                        random.get_double(-reach, reach));
    const double expected = smallest_distance(all, query);
    for(std::size_t hint = 0; hint < all.size(); ++hint)
    {
      test_near_foot(all, projection, query, hint);
      std::size_t face = hint;
      const Eigen::Vector3d p(query.x(), query.y(), query.z());
      assert(std::abs(distance.foot(p, face).distance - expected) < 1e-13);
      assert(std::abs(std::sqrt(CGAL::squared_distance(query, all[face])) - expected) < 1e-13);
    }
  }
}

int main()
{
  CGAL::Random random(0);
  test(tetrahedron_with_flat_face(), 3, random);
  test(torus(), 3, random);
  test_edges(tetrahedron_with_flat_face());
  Mesh open_torus = torus();
  CGAL::Euler::remove_face(open_torus.halfedge(Mesh::Face_index(0)), open_torus);
  open_torus.collect_garbage();
  test_edges(open_torus);
  return EXIT_SUCCESS;
}
