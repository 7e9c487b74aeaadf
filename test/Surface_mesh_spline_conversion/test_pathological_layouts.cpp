// Layouts of inputs on which maps tend to fail: tiny meshes, needles, vertices close together,
// loops shorter than a quad, many loops, sizes far from that of the mesh. Each gives a valid
// layout; inputs that are no surface give a code and a message that names the element.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "generated_working_meshes.h"
#include "quad_layout_checks.h"

#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>

#include <cassert>
#include <cmath>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;
using namespace Test;

typedef CGAL::Simple_cartesian<double> K;
typedef CGAL::Surface_mesh<K::Point_3> Mesh;
typedef SC::NURBS_curve_traits_3<K> Curve_traits;
typedef SC::Curve_segment<Curve_traits> Segment;
typedef SC::Boundary_curve_network_3<Mesh, Curve_traits> Network;
typedef SC::Quad_layout<K> Layout;

namespace {

Mesh to_surface_mesh(const Points& points, const Triangles& triangles)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for(const auto& p : points)
    vertices.push_back(mesh.add_vertex(K::Point_3(p[0], p[1], p[2])));
  for(const auto& t : triangles)
    mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  return mesh;
}

Mesh to_surface_mesh(const Working_mesh& mesh)
{
  return to_surface_mesh(mesh.points, mesh.triangles);
}

struct Result
{
  SC::Error_code code;
  std::string message;
  std::string fallback;
  std::size_t quads = 0;
};

void check_layout(const Mesh& mesh, const Network& network, const Layout& layout)
{
  const Quad_layout_checks<Layout, Mesh> checks(layout, mesh, network.diameter());
  const int edges = static_cast<int>(mesh.number_of_edges());
  checks.check_combinatorics(int(mesh.number_of_vertices()) - edges + int(mesh.number_of_faces()),
                             static_cast<int>(network.number_of_loops()));
  std::vector<double> lengths;
  std::vector<bool> is_closed;
  for(std::size_t c = 0; c < network.number_of_chains(); ++c)
  {
    lengths.push_back(network.length(c));
    is_closed.push_back(network.is_closed(c));
  }
  if(!lengths.empty())
    checks.check_boundary(lengths, is_closed);
  checks.check_points(3);
  checks.check_continuity(3);
}

// `size` is relative to the diameter
Result compute(Mesh mesh, double size)
{
  auto curves = mesh.add_property_map<Mesh::Halfedge_index, Segment>("h:curve").first;
  Result result;
  result.code = SC::interpolate_boundary_curves(mesh, Curve_traits(), curves, result.message);
  if(result.code != SC::Error_code::OK)
    return result;
  const Network network(mesh, curves, Curve_traits());
  result.message = network.message();
  result.code = network.error();
  if(result.code != SC::Error_code::OK)
    return result;
  Layout layout;
  SC::Conversion_report report;
  result.code = SC::compute_quad_layout(mesh, network, layout, report,
    CGAL::parameters::quad_size_map(size * network.diameter()));
  result.message = report.message;
  result.fallback = report.map.fallback;
  result.quads = layout.number_of_quads();
  if(result.code == SC::Error_code::OK)
    check_layout(mesh, network, layout);
  return result;
}

void check_valid(const std::string& name, const Mesh& mesh)
{
  for(double size : {0.05, 0.3, 3.})
  {
    const Result result = compute(mesh, size);
    if(result.code != SC::Error_code::OK)
      std::cerr << name << " at " << size << ": " << result.message << std::endl;
    assert(result.code == SC::Error_code::OK);
    assert(result.message.empty() && result.quads > 0);
  }
}

void check_rejected(const Mesh& mesh, SC::Error_code code, const std::string& element)
{
  const Result result = compute(mesh, 0.1);
  assert(result.code == code);
  assert(result.message.find(element) != std::string::npos);
}

Eigen::Vector3d on_tube(double u, double v)
{
  return Eigen::Vector3d(std::cos(pi * u / 6), std::sin(pi * u / 6), v);
}

void check_small_meshes()
{
  check_valid("triangle", to_surface_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}}));
  check_valid("needle", to_surface_mesh({{0, 0, 0}, {1, 0, 0}, {0.5, 1e-6, 0}}, {{{0, 1, 2}}}));
  check_valid("strip", to_surface_mesh(make_grid(5, 1, false, false, in_plane, no_hole)));
  check_valid("annulus", to_surface_mesh(make_grid(12, 1, true, false,
    [](double u, double v) { return Eigen::Vector3d((1 + v) * std::cos(pi * u / 6),
                                                    (1 + v) * std::sin(pi * u / 6), 0); },
    no_hole)));
  check_valid("long thin tube", to_surface_mesh(make_grid(12, 60, true, false, on_tube, no_hole)));
  check_valid("tetrahedron", to_surface_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}}));
  check_valid("tiny", to_surface_mesh(make_grid(6, 4, false, false,
    [](double u, double v) { return Eigen::Vector3d(1e-6 * u, 1e-6 * v, 0); }, no_hole)));
}

void check_bad_triangles()
{
  // the fifth row is moved close to the fourth one
  check_valid("needles", to_surface_mesh(make_grid(12, 8, false, false,
    [](double u, double v) { return in_plane(u, v < 4.5 ? v : v - 1 + 1e-6 * v); }, no_hole)));
  Working_mesh close = make_grid(12, 8, false, false, in_plane, no_hole);
  for(Eigen::Vector3d& p : close.points)
    if((p - Eigen::Vector3d(5, 4, 0)).norm() < 1e-3)
      p = Eigen::Vector3d(6 - 1e-6, 4, 0);
  check_valid("two vertices close together", to_surface_mesh(close));
  check_valid("noise", to_surface_mesh(
    with_noise(make_grid(24, 16, false, false, in_plane, no_hole), 0.3)));
}

void check_many_loops()
{
  const int n = 6;
  const auto is_hole = [](int i, int j) { return i % 3 == 1 && j % 3 == 1; };
  const Mesh plate = to_surface_mesh(make_grid(3 * n, 3 * n, false, false, in_plane, is_hole));
  for(double size : {0.05, 0.3})
  {
    const Result result = compute(plate, size);
    assert(result.code == SC::Error_code::OK);
    // quads at each hole
    assert(result.quads > n * n);
  }
}

void check_no_surfaces()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  check_rejected(to_surface_mesh({{0, 0, 0}, {1, nan, 0}, {0, 1, 0}}, {{{0, 1, 2}}}),
                 SC::Error_code::DEGENERATE_MESH, "vertex 1");
  check_rejected(to_surface_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, infinity}}, {{{0, 1, 2}}}),
                 SC::Error_code::DEGENERATE_MESH, "vertex 2");
  check_rejected(to_surface_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}},
                                 {{{0, 1, 2}}, {{1, 3, 2}}}),
                 SC::Error_code::DEGENERATE_MESH, "Face 1");
  check_rejected(to_surface_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                                 {{{0, 1, 2}}, {{0, 3, 4}}}),
                 SC::Error_code::NON_MANIFOLD_MESH, "vertex 0");
  check_rejected(to_surface_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{{0, 1, 2}}}),
                 SC::Error_code::NON_MANIFOLD_MESH, "ertex 3");
  check_rejected(Mesh(), SC::Error_code::EMPTY_MESH, "no face");
}

} // namespace

int main()
{
  check_small_meshes();
  check_bad_triangles();
  check_many_loops();
  check_no_surfaces();
  return 0;
}
