// Curved triangles in the place of facets: how close they come to the shape that the mesh samples,
// and what a fit to them gains.
#include "synthetic_layout.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_boundary.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_interior.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/edge_turn.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Curved_facets.h>
#include <CGAL/T_NURCC_surface_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

using namespace synthetic;
namespace params = CGAL::parameters;

using Eigen::Vector3d;
typedef SC::internal::Curved_facets Curved_facets;
typedef std::array<double, 3> Barycentric;

std::array<Vector3d, 3> corners(const Mesh& mesh, Mesh::Face_index f)
{
  std::array<Vector3d, 3> result;
  std::size_t i = 0;
  for(const auto v : vertices_around_face(mesh.halfedge(f), mesh))
    result[i++] = SC::internal::to_eigen(mesh.point(v));
  return result;
}

// calls visit(b, p, d) for points p of a face with the coordinates b and the displacement d
template <typename Visit>
void for_each_point(const Mesh& mesh, const Curved_facets& curved, Mesh::Face_index f,
                    const Visit& visit)
{
  constexpr int n = 6;
  const std::array<Vector3d, 3> t = corners(mesh, f);
  for(int i = 0; i <= n; ++i)
    for(int j = 0; i + j <= n; ++j)
    {
      const Barycentric b = {{double(i) / n, double(j) / n, double(n - i - j) / n}};
      visit(b, Vector3d(b[0] * t[0] + b[1] * t[1] + b[2] * t[2]), curved.displacement(f.idx(), b));
    }
}

// vertices are interpolated, the triangles do not leave the faces by more than their height, and
// both faces at an edge have the same curve
void check_continuity(const Mesh& mesh, const Curved_facets& curved)
{
  for(const auto f : mesh.faces())
    for_each_point(mesh, curved, f, [&](const Barycentric& b, const Vector3d&, const Vector3d& d)
    {
      assert(d.norm() <= curved.height() * (1 + 1e-12));
      if((std::max)({b[0], b[1], b[2]}) == 1)
        assert(d == Vector3d::Zero());
    });
  // the coordinates of the point of `h` at `t`, from its source to its target
  const auto coordinates = [&](Mesh::Halfedge_index h, double t)
  {
    Barycentric b = {{0, 0, 0}};
    std::size_t i = 0;
    for(const auto v : vertices_around_face(mesh.halfedge(mesh.face(h)), mesh))
    {
      b[i] = v == mesh.target(h) ? t : (v == mesh.source(h) ? 1 - t : 0);
      ++i;
    }
    return b;
  };
  for(const auto e : mesh.edges())
  {
    const auto h = mesh.halfedge(e), o = mesh.opposite(h);
    if(mesh.is_border(h) || mesh.is_border(o))
      continue;
    for(const double t : {0.1, 0.37, 0.5, 0.88})
      assert((curved.displacement(mesh.face(h).idx(), coordinates(h, t))
              - curved.displacement(mesh.face(o).idx(), coordinates(o, 1 - t))).norm() < 1e-14);
  }
}

// the largest distances of the facets and of the curved triangles from a shape, away from the
// boundary and at it
struct Distances
{
  double facets = 0, curved = 0, curved_at_border = 0;
};

template <typename Distance>
Distances measure(const Mesh& mesh, const Distance& distance)
{
  const Curved_facets curved(mesh, mesh.points());
  check_continuity(mesh, curved);
  Distances result;
  for(const auto f : mesh.faces())
  {
    bool is_at_border = false;
    for(const auto v : vertices_around_face(mesh.halfedge(f), mesh))
      is_at_border = is_at_border || mesh.is_border(v);
    double& largest = is_at_border ? result.curved_at_border : result.curved;
    for_each_point(mesh, curved, f, [&](const Barycentric&, const Vector3d& p, const Vector3d& d)
    {
      result.facets = (std::max)(result.facets, std::abs(distance(p)));
      largest = (std::max)(largest, std::abs(distance(p + d)));
    });
  }
  return result;
}

// a part of the unit sphere
Surface sphere_cap()
{
  // sqrt(1 - x^2 - y^2) and its partial derivatives
  const auto z = [](double x, double y, int i, int j)
  {
    const double w = std::sqrt(1 - x * x - y * y);
    switch(10 * i + j)
    {
      case 0: return w;
      case 10: return -x / w;
      case 1: return -y / w;
      case 20: return -(1 - y * y) / (w * w * w);
      case 2: return -(1 - x * x) / (w * w * w);
      case 11: return -x * y / (w * w * w);
      case 30: return -3 * x * (1 - y * y) / std::pow(w, 5);
      case 3: return -3 * y * (1 - x * x) / std::pow(w, 5);
      default: assert(false); return 0.;
    }
  };
  constexpr double width = 1;
  Surface s;
  s.point = [z](double a, double b)
  {
    const double x = width * (a - 0.5), y = width * (b - 0.5);
    return Point(x, y, z(x, y, 0, 0));
  };
  s.derivative = [z](double a, double b, int i, int j)
  {
    const double x = width * (a - 0.5), y = width * (b - 0.5);
    return Vector(i == 1 && j == 0 ? width : 0, i == 0 && j == 1 ? width : 0,
                  std::pow(width, i + j) * z(x, y, i, j));
  };
  return s;
}

double distance_to_sphere(const Vector3d& p) { return p.norm() - 1; }

// adds a point of the unit sphere, unless it is there
Mesh::Vertex_index add_to_sphere(const Vector3d& p, Mesh& mesh)
{
  const Vector3d q = p.normalized();
  for(const auto v : mesh.vertices())
    if((SC::internal::to_eigen(mesh.point(v)) - q).norm() < 1e-9)
      return v;
  return mesh.add_vertex(Point(q[0], q[1], q[2]));
}

// each face becomes four, with vertices on the unit sphere
Mesh subdivided_sphere(const Mesh& mesh)
{
  Mesh result;
  for(const auto f : mesh.faces())
  {
    const std::array<Vector3d, 3> t = corners(mesh, f);
    const auto a = add_to_sphere(t[0], result), b = add_to_sphere(t[1], result),
      c = add_to_sphere(t[2], result), d = add_to_sphere(t[0] + t[1], result),
      e = add_to_sphere(t[1] + t[2], result), g = add_to_sphere(t[2] + t[0], result);
    result.add_face(a, d, g);
    result.add_face(d, b, e);
    result.add_face(g, e, c);
    result.add_face(d, e, g);
  }
  return result;
}

void test_sphere()
{
  const Input input(sphere_cap(), 3, 3, 3);
  const Distances cap = measure(input.mesh(), distance_to_sphere);
  assert(40 * cap.curved < cap.facets && 2 * cap.curved_at_border < cap.facets);

  Mesh icosahedron;
  CGAL::make_icosahedron<Mesh, Point>(icosahedron);
  const Mesh closed = subdivided_sphere(subdivided_sphere(icosahedron));
  const Distances sphere = measure(closed, distance_to_sphere);
  assert(25 * sphere.curved < sphere.facets);

  CGAL::Polyhedron_3<CGAL::Exact_predicates_inexact_constructions_kernel> polyhedron;
  CGAL::copy_face_graph(closed, polyhedron);
  const double height = Curved_facets(closed, closed.points()).height();
  const double other
    = Curved_facets(polyhedron, get(CGAL::vertex_point, polyhedron)).height();
  assert(std::abs(height - other) < 1e-12 && height < 1.3 * sphere.facets);
}

void test_torus()
{
  constexpr double major = 1, minor = 0.4;
  // a band does not need to be closed for its inner faces to be those of the torus
  const Input input(torus_band(major, minor), 8, 2, 4);
  const auto distance = [=](const Vector3d& p)
  { return std::hypot(std::hypot(p[0], p[1]) - major, p[2]) - minor; };
  const Distances d = measure(input.mesh(), distance);
  assert(10 * d.curved < d.facets && 2 * d.curved_at_border < d.facets);
}

void test_flat_mesh()
{
  const Input input(height_field(0), 3, 3, 2);
  assert(Curved_facets(input.mesh(), input.mesh().points()).height() == 0);
}

// a cylinder with flat ends, from z = 0
Mesh cylinder(std::size_t n, double height)
{
  Mesh mesh;
  const auto lower = mesh.add_vertex(Point(0, 0, 0)), upper = mesh.add_vertex(Point(0, 0, height));
  std::vector<Mesh::Vertex_index> rings[3];
  for(std::size_t k = 0; k < 3; ++k)
    for(std::size_t i = 0; i < n; ++i)
    {
      const double a = 2 * CGAL_PI * double(i) / double(n);
      rings[k].push_back(mesh.add_vertex(Point(std::cos(a), std::sin(a), height * double(k) / 2)));
    }
  for(std::size_t i = 0; i < n; ++i)
  {
    const std::size_t j = (i + 1) % n;
    mesh.add_face(lower, rings[0][j], rings[0][i]);
    mesh.add_face(upper, rings[2][i], rings[2][j]);
    for(std::size_t k = 0; k < 2; ++k)
    {
      mesh.add_face(rings[k][i], rings[k][j], rings[k + 1][j]);
      mesh.add_face(rings[k][i], rings[k + 1][j], rings[k + 1][i]);
    }
  }
  return mesh;
}

// The edges between the ends and the rest stay, the ends stay flat, the rest becomes round.
void test_cylinder()
{
  constexpr std::size_t n = 24;
  constexpr double height = 0.7;
  const Mesh mesh = cylinder(n, height);
  const Curved_facets curved(mesh, mesh.points());
  check_continuity(mesh, curved);
  double gap_in_the_middle = 0;
  for(const auto f : mesh.faces())
    for_each_point(mesh, curved, f, [&](const Barycentric&, const Vector3d& p, const Vector3d& d)
    {
      const bool is_at_end = p[2] < 1e-12 || p[2] > height - 1e-12;
      if(is_at_end)
        assert(d.norm() < 1e-14);
      else if(std::abs(p[2] - height / 2) < 1e-12)
        gap_in_the_middle = (std::max)(gap_in_the_middle, std::abs((p + d).head<2>().norm() - 1));
    });
  assert(10 * gap_in_the_middle < 1 - std::cos(CGAL_PI / n));
}

void test_box()
{
  Mesh box;
  CGAL::make_hexahedron(Point(0, 0, 0), Point(2, 0, 0), Point(2, 1, 0), Point(0, 1, 0),
                        Point(0, 1, 3), Point(0, 0, 3), Point(2, 0, 3), Point(2, 1, 3), box);
  std::vector<Mesh::Face_index> quads(box.faces().begin(), box.faces().end());
  for(const auto f : quads)
    CGAL::Euler::split_face(box.halfedge(f), box.next(box.next(box.halfedge(f))), box);
  assert(box.number_of_faces() == 12 && Curved_facets(box, box.points()).height() == 0);
}

// the points of the target: on the curved triangles, and in the curves at the boundary
void test_target(const Input& input, const Target& smooth)
{
  assert(smooth.has_smooth_target() && !input.target().has_smooth_target());
  double facets = 0, curved = 0;
  for(std::size_t q = 0; q < smooth.layout().number_of_quads(); ++q)
    for(double u : {0., 0.23, 0.5, 0.81, 1.})
      for(double v : {0., 0.31, 0.5, 0.77, 1.})
      {
        std::size_t face;
        const Point p = smooth.point(q, u, v, face);
        if(face == smooth.number_of_mesh_faces())
          assert(p == input.target().point(q, u, v));
        if(smooth.is_boundary_quad(q))
          continue;
        const double height
          = std::sqrt(CGAL::squared_distance(p, input.target().point(q, u, v)));
        assert(height <= smooth.smooth_target_height());
        facets = (std::max)(facets, distance_to_sphere(
                   SC::internal::to_eigen(input.target().point(q, u, v))) * -1);
        curved = (std::max)(curved, std::abs(distance_to_sphere(SC::internal::to_eigen(p))));
        // the closest point of a lifted one is about below it, that of a point of the target itself
        assert(std::sqrt(CGAL::squared_distance(smooth.foot_point(p, q, u, v, p, face), p)) < 1e-9);
        const Point lifted = p + 0.01 * (p - CGAL::ORIGIN);
        const Point foot = smooth.foot_point(lifted, q, u, v, p, face);
        assert(std::abs(std::sqrt(CGAL::squared_distance(foot, lifted)) - 0.01) < 1e-3);
      }
  assert(40 * curved < facets);
}

struct Fit
{
  Fit(const Input& input, const Target& target, double tolerance)
    : surface(input.layout())
  {
    const auto np = params::interior_tolerance(tolerance).boundary_tolerance(tolerance);
    assert(SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK);
    assert(SC::fit_interior(surface, target, report, np) == SC::Error_code::OK);
  }

  // the largest distance from the unit sphere
  double error() const
  {
    double result = 0;
    for(std::size_t p = 0; p < surface.number_of_patches(); ++p)
    {
      const auto o = surface.patch_origin(p);
      for(double s : {0., 0.13, 0.29, 0.5, 0.57, 0.91, 1.})
        for(double t : {0., 0.11, 0.33, 0.5, 0.68, 0.97, 1.})
          result = (std::max)(result, std::abs(distance_to_sphere(SC::internal::to_eigen(
            surface.position(p, o.u0 + s * (o.u1 - o.u0), o.v0 + t * (o.v1 - o.v0))))));
    }
    return result;
  }

  CGAL::T_NURCC_surface_3<Kernel> surface;
  SC::Conversion_report report;
};

void test_fit()
{
  const Input input(sphere_cap(), 4, 4, 3);
  const Target smooth(input.layout(), input.network(), input.mesh(), params::use_smooth_target(true));
  test_target(input, smooth);
  double sagitta = 0;
  for(const auto e : input.mesh().edges())
    sagitta = (std::max)(sagitta, SC::internal::edge_turn(
      input.mesh().halfedge(e), input.mesh(), input.mesh().points()).sagitta);
  const Fit to_facets(input, input.target(), sagitta / 4), to_smooth(input, smooth, sagitta / 4);
  assert(2 * to_smooth.surface.number_of_patches() < to_facets.surface.number_of_patches());
  assert(2 * to_smooth.error() < to_facets.error());
}

int main()
{
  test_sphere();
  test_torus();
  test_flat_mesh();
  test_cylinder();
  test_box();
  test_fit();
  return EXIT_SUCCESS;
}
