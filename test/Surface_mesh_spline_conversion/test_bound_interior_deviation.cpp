// Bounds of the distance from a bicubic face to a mesh: with known answers, and against dense
// samples.

#include "graph_mesh.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/bound_interior_deviation.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;
typedef CGAL::Simple_cartesian<double> K;
typedef K::Point_3 Point_3;
typedef CGAL::Surface_mesh<Point_3> Mesh;
typedef SMSC::NURBS_shell_3<K> Shell;
typedef SMSC::NURBS_curve_traits_3<K> Curve_traits;
typedef SMSC::Boundary_curve_network_3<Mesh, Curve_traits> Network;

const double size = 10;
const int cells = 20;
const double band = 2; // more than three mean edge lengths of the mesh

// a bicubic face over the square; `z(i,j)` is the height of a control point
Shell one_face(const std::function<double(int, int)>& z)
{
  Shell shell;
  const SMSC::Knot_vector<double> knots(3, {0, 1});
  const auto point = [&z](int i, int j) { return Point_3(size * i / 3, size * j / 3, z(i, j)); };
  const std::array<std::array<int, 2>, 4> corners = {{{{0, 0}}, {{3, 0}}, {{3, 3}}, {{0, 3}}}};
  std::vector<std::size_t> vertices;
  for(const auto& c : corners)
    vertices.push_back(shell.add_vertex(point(c[0], c[1])));
  Shell::Face face;
  face.surface.knots = {{knots, knots}};
  for(int j = 0; j <= 3; ++j)
    for(int i = 0; i <= 3; ++i)
      face.surface.control_points.push_back(point(i, j));
  face.patch = 0;
  face.is_extraordinary = false;
  for(std::size_t s = 0; s < 4; ++s)
  {
    const auto &a = corners[s], &b = corners[(s + 1) % 4];
    Shell::Edge edge = {vertices[s], vertices[(s + 1) % 4], {knots, {}}};
    for(int k = 0; k <= 3; ++k)
      edge.curve.control_points.push_back(point(a[0] + (b[0] - a[0]) / 3 * k,
                                                a[1] + (b[1] - a[1]) / 3 * k));
    face.loop.push_back({shell.add_edge(edge), true});
  }
  shell.add_face(face);
  return shell;
}

double bound(const Shell& shell, Mesh mesh, double tolerance)
{
  Curve_traits traits;
  auto map = mesh.add_property_map<Mesh::Halfedge_index, SMSC::Curve_segment<Curve_traits> >(
    "h:curve").first;
  std::string message;
  assert(SMSC::interpolate_boundary_curves(mesh, traits, map, message) == SMSC::Error_code::OK);
  const Network network(mesh, map, traits);
  assert(network.error() == SMSC::Error_code::OK);
  return SMSC::bound_interior_deviation(shell, mesh, network,
                                        CGAL::parameters::interior_tolerance(tolerance));
}

// the largest distance at dense samples away from the boundary, triangle by triangle
double sampled_distance(const Shell& shell, const Mesh& mesh)
{
  const SMSC::internal::Bezier_piece piece = SMSC::internal::bezier_pieces(shell).front();
  constexpr int n = 60;
  double result = 0;
  for(int j = 0; j <= n; ++j)
    for(int i = 0; i <= n; ++i)
    {
      const Eigen::Vector3d p = piece.point(double(i) / n, double(j) / n);
      if((std::min)({p.x(), p.y(), size - p.x(), size - p.y()}) < band)
        continue;
      double nearest = std::numeric_limits<double>::infinity();
      for(const auto f : mesh.faces())
      {
        std::vector<Point_3> t;
        for(const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
          t.push_back(mesh.point(v));
        nearest = (std::min)(nearest, CGAL::squared_distance(Point_3(p.x(), p.y(), p.z()),
                                                             K::Triangle_3(t[0], t[1], t[2])));
      }
      result = (std::max)(result, std::sqrt(nearest));
    }
  return result;
}

void test_known_answers()
{
  const Mesh flat = graph_mesh<Mesh>(size, cells, [](double, double) { return 0; });
  const double height = 0.1;
  const Shell raised = one_face([height](int, int) { return height; });
  for(const double tolerance : {1e-3, 0.999 * height})
  {
    const double b = bound(raised, flat, tolerance);
    assert(b >= height * (1 - 1e-12) && b <= 1.01 * height);
  }
  assert(bound(raised, flat, 2 * height) <= 2 * height);

  // the maximum of B_1 B_1 is (4/9)^2 at (1/3,1/3)
  const Shell bump = one_face([](int i, int j) { return (i == 1 && j == 1) ? 1 : 0; });
  const double top = 16. / 81;
  for(const double tolerance : {0.5 * top, 0.9999 * top, 1.0001 * top, 1.1 * top})
  {
    const double b = bound(bump, flat, tolerance);
    assert(b >= top * (1 - 1e-12));
    assert(tolerance < top ? b <= 1.01 * top : b <= tolerance);
  }
  // a face in the mesh
  assert(bound(one_face([](int, int) { return 0; }), flat, 0.05) <= 0.05);
}

void test_against_samples()
{
  std::mt19937 generator(5);
  const auto random = [&generator]() { return double(generator() % 1000) / 1000; };
  for(int k = 0; k < 3; ++k)
  {
    const double a = random(), b = random();
    const Mesh mesh
      = graph_mesh<Mesh>(size, cells, [a, b](double x, double y)
        { return 0.3 * std::sin(a * x + b) * std::cos(b * y); });
    std::array<double, 16> heights;
    for(double& h : heights)
      h = 0.6 * random();
    const Shell shell = one_face([&heights](int i, int j) { return heights[4 * j + i]; });
    const double sampled = sampled_distance(shell, mesh);
    assert(bound(shell, mesh, 1.2 * sampled) >= sampled);
    const double largest = bound(shell, mesh, 0.5 * sampled);
    assert(largest >= sampled && largest < 2.5 * sampled); // samples keep out of a wider band
  }
}

// both halves are the piece itself
void test_bisection()
{
  SMSC::internal::Bezier_piece piece;
  piece.degree = {{3, 5}};
  piece.face = 7;
  std::mt19937 generator(1);
  for(int i = 0; i < 24; ++i)
    piece.points.emplace_back(generator() % 10, generator() % 10, generator() % 10);
  for(const int axis : {0, 1})
  {
    const auto halves = SMSC::internal::bisected(piece, axis);
    for(const double u : {0., 0.3, 1.})
      for(const double v : {0., 0.6, 1.})
        for(int half = 0; half < 2; ++half)
        {
          const Eigen::Vector3d p = halves[half].point(u, v);
          const Eigen::Vector3d q = axis == 0 ? piece.point((u + half) / 2, v)
                                              : piece.point(u, (v + half) / 2);
          assert((p - q).norm() < 1e-12 && halves[half].face == 7);
        }
  }
}

int main()
{
  test_bisection();
  test_known_answers();
  test_against_samples();
  return EXIT_SUCCESS;
}
