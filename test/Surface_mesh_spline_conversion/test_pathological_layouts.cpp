// Layouts of inputs on which maps tend to fail: tiny meshes, needles, vertices close together, thin
// walls, loops shorter than a quad or at the same triangle, many loops, corners with more than a
// full turn, sizes far from that of the mesh. Each gives a valid layout; inputs that are no surface
// give a code and a message that names the element.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include "generated_working_meshes.h"
#include "quad_layout_checks.h"

#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <set>
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
typedef std::array<int, 3> Lattice_point;

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
  double min_scaled_jacobian = 0;
  Layout layout;
  std::multiset<int> irregular; // numbers of quads at vertices, negative at the boundary
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
  checks.check_agreement();
}

// of the images of the quads, by samples
double sampled_area(const Layout& layout)
{
  const int n = 64;
  const double step = 1e-6;
  double area = 0;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
      {
        const double u = (i + 0.45) / n, v = (j + 0.55) / n;
        const K::Point_3 p = layout.inverse_map()(q, u, v).point;
        const K::Vector_3 along_u = layout.inverse_map()(q, u + step, v).point - p;
        const K::Vector_3 along_v = layout.inverse_map()(q, u, v + step).point - p;
        area += std::sqrt(CGAL::cross_product(along_u, along_v).squared_length())
                / (step * step * n * n);
      }
  return area;
}

// `size` is relative to the diameter
Result compute(Mesh mesh, double size, bool keeps_large_corners = false)
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
    CGAL::parameters::quad_size_map(size * network.diameter())
                     .do_keep_large_corners(keeps_large_corners));
  result.message = report.message;
  result.fallback = report.map.fallback;
  result.quads = layout.number_of_quads();
  result.min_scaled_jacobian = report.map.min_scaled_jacobian;
  result.irregular = Quad_layout_checks<Layout, Mesh>(layout, mesh, network.diameter())
                       .irregular_valences();
  if(result.code != SC::Error_code::OK)
    return result;
  check_layout(mesh, network, layout);
  result.layout = layout;
  return result;
}

void check_valid(const std::string& name, const Mesh& mesh,
                 const std::vector<double>& sizes = {0.05, 0.3, 3.})
{
  for(double size : sizes)
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
  const auto is_hole = [](int i, int j) { return i % 3 == 1 && j % 3 == 1; };
  const auto check = [&](std::size_t n, double size)
  {
    const int m = static_cast<int>(3 * n);
    const Result result = compute(to_surface_mesh(make_grid(m, m, false, false, in_plane, is_hole)),
                                  size);
    assert(result.code == SC::Error_code::OK);
    // quads at each hole
    assert(result.quads > n * n);
  };
  check(6, 0.05);
  check(6, 0.3);
}

// two walls at a distance of a hundredth of their size, straight and round
void check_thin_walls()
{
  check_valid("thin wall", to_surface_mesh(make_grid(42, 20, true, false, [](double u, double v)
    { const Eigen::Vector2d p = on_thin_rectangle(u); return Eigen::Vector3d(p[0], v, p[1]); },
    no_hole)));
  check_valid("thin ring", to_surface_mesh(make_grid(42, 24, true, true, on_thin_ring, no_hole)));
}

// holes that are triangles of a fine lattice: some triangles have their corners on three loops
void check_neighboring_loops()
{
  Working_mesh plate = make_grid(12, 9, false, false, in_plane, no_hole);
  Triangles triangles;
  const auto is_at = [&](const std::array<int, 3>& t, double x, double y)
  {
    const Eigen::Vector3d middle
      = (plate.points[t[0]] + plate.points[t[1]] + plate.points[t[2]]) / 3;
    return (middle - Eigen::Vector3d(x, y, 0)).norm() < 0.1;
  };
  for(const auto& t : plate.triangles)
    // each has one corner of the triangle (5,4) (6,4) (6,5) on its boundary
    if(!is_at(t, 5 - 1. / 3, 4 - 2. / 3) && !is_at(t, 6 + 2. / 3, 4 - 2. / 3)
       && !is_at(t, 6 + 1. / 3, 5 + 2. / 3))
      triangles.push_back(t);
  assert(triangles.size() + 3 == plate.triangles.size());
  check_valid("loops at one triangle", to_surface_mesh(plate.points, triangles), {0.05, 0.3});
}

// the surface of some of n x n x n cubes
Mesh make_cubes(int n, const std::function<bool(const Lattice_point&)>& is_inside)
{
  std::map<Lattice_point, int> numbers;
  Points points;
  Triangles triangles;
  const auto number = [&](const Lattice_point& p)
  {
    const auto entry = numbers.emplace(p, int(points.size()));
    if(entry.second)
      points.emplace_back(p[0], p[1], p[2]);
    return entry.first->second;
  };
  for(int i = 0; i < n * n * n; ++i)
    for(std::size_t axis = 0; axis < 3; ++axis)
      for(int side = 0; side < 2; ++side)
      {
        Lattice_point cube = {{i % n, i / n % n, i / n / n}}, beside = cube;
        beside[axis] += 2 * side - 1;
        if(!is_inside(cube) || is_inside(beside))
          continue;
        cube[axis] += side;
        std::array<Lattice_point, 4> corners = {{cube, cube, cube, cube}};
        const std::size_t first = (axis + (side == 1 ? 1 : 2)) % 3, second = 3 - axis - first;
        ++corners[1][first];
        ++corners[2][first];
        ++corners[2][second];
        ++corners[3][second];
        std::array<int, 4> v;
        std::transform(corners.begin(), corners.end(), v.begin(), number);
        triangles.push_back({{v[0], v[1], v[2]}});
        triangles.push_back({{v[0], v[2], v[3]}});
      }
  return to_surface_mesh(points, triangles);
}

// those along the 12 edges of a large cube
Mesh make_frame(int n)
{
  return make_cubes(n, [n](const Lattice_point& cube)
  {
    int ends = 0;
    for(int x : cube)
    {
      if(x < 0 || x >= n)
        return false;
      ends += x == 0 || x == n - 1 ? 1 : 0;
    }
    return ends >= 2;
  });
}

// six teeth side by side
Mesh make_comb()
{
  return make_cubes(12, [](const Lattice_point& cube)
  {
    return cube[0] >= 0 && cube[0] < 11 && cube[1] == 0 && cube[2] >= 0 && cube[2] < 8
           && (cube[2] == 0 || cube[0] % 2 == 0);
  });
}

// A quad with a tooth in its middle does not leave next to all of it to a small part of itself.
void check_comb()
{
  const Result result = compute(make_comb(), 0.5);
  assert(result.code == SC::Error_code::OK);
  const double area = 218; // of the unit squares
  assert(sampled_area(result.layout) > 0.95 * area); // 0.86 with such quads
}

// Large quads do not wind around bars many times.
void check_crowded_layout()
{
  const Result result = compute(make_frame(7), 0.5);
  assert(result.code == SC::Error_code::OK);
  assert(result.quads < 120); // 175 if singularities are spread
}

// two square sheets with two thin square tubes between them
Mesh make_connected_sheets()
{
  const int n = 12;
  const auto is_between = [](int x, int first, int last) { return first <= x && x < last; };
  const Mesh plate = make_cubes(n, [&](const Lattice_point& cube)
  {
    const int x = cube[0], y = cube[1];
    return is_between(x, 0, n) && is_between(y, 0, n) && cube[2] == 0
           && !(x == 2 && y == 3) && !(x == 8 && y == 7);
  });
  Mesh sheets = plate;
  for(const auto f : plate.faces())
  {
    const auto h = plate.halfedge(f);
    const K::Point_3 centroid
      = CGAL::centroid(plate.point(plate.source(h)), plate.point(plate.target(h)),
                       plate.point(plate.target(plate.next(h))));
    if(centroid.x() == 0 || centroid.x() == n || centroid.y() == 0 || centroid.y() == n)
      CGAL::Euler::remove_face(sheets.halfedge(f), sheets);
  }
  sheets.collect_garbage();
  return sheets;
}

// Where quads are much larger than tubes, the singularities around these are joined.
void check_joined_singularities()
{
  const Result fine = compute(make_connected_sheets(), 0.15);
  assert(fine.code == SC::Error_code::OK && fine.fallback == "none");
  assert(fine.irregular.count(5) == 16);
  const Result coarse = compute(make_connected_sheets(), 0.5);
  assert(coarse.code == SC::Error_code::OK);
  assert(coarse.quads < 30); // 44 with singularities of five quads each
  assert(coarse.min_scaled_jacobian > 0);
  assert(*coarse.irregular.rbegin() <= 8);
}

// Chords collapse where quads are crowded, and the quads that are left have good shapes.
void check_collapsed_chords()
{
  const Result result = compute(make_connected_sheets(), 0.2);
  assert(result.code == SC::Error_code::OK);
  assert(result.quads < 50); // 54 without collapses
  assert(result.min_scaled_jacobian > 0.76); // what it is without collapses
}

// No quad winds around a bar, although smaller ones in their place do once.
void check_winding_quads()
{
  const Result result = compute(make_frame(9), 0.2);
  assert(result.code == SC::Error_code::OK);
  assert(result.min_scaled_jacobian > 0); // -1 after one attempt
}

// No singularity is needed on a torus, and none appears.
void check_torus()
{
  const Mesh torus = to_surface_mesh(make_grid(60, 24, true, true, [](double u, double v)
    { return on_torus(pi * u / 30, pi * v / 12); }, no_hole));
  for(double size : {0.05, 0.1})
  {
    const Result result = compute(torus, size);
    assert(result.code == SC::Error_code::OK && result.fallback == "none");
    assert(result.irregular.empty());
  }
}

// A star with many spikes: what its concave corners, with two quads each, turn more fits only in
// the middle. There is a layout of quads that are not inverted, with one vertex for all of it.
void check_star()
{
  const int spikes = 20;
  Points points{{0, 0, 0}};
  Triangles triangles;
  for(int i = 0; i < 2 * spikes; ++i)
  {
    const double radius = i % 2 == 0 ? 0.02 : 1, angle = pi * i / spikes;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    triangles.push_back({{0, 1 + i, 1 + (i + 1) % (2 * spikes)}});
  }
  for(double size : {0.3, 1.})
  {
    const Result result = compute(to_surface_mesh(points, triangles), size);
    assert(result.code == SC::Error_code::OK);
    assert(result.fallback == "singularities gathered on the mesh itself");
    assert(result.min_scaled_jacobian > 0); // -1 with the layout of last resort
    // a quad for each spike
    assert(result.irregular.count(spikes) == 1 && result.quads == std::size_t(spikes));
  }
}

// A sphere with holes and narrow bridges between them, which would have to carry singularities
// at distances of the quads: they are close to each other, and there is a map.
void check_narrow_bridges()
{
  const int around = 12, across = 6;
  const Mesh sphere = to_surface_mesh(make_grid(around, across, true, false, [&](double i, double j)
    {
      const double t = 2 * pi * i / around, p = pi * (0.08 + 0.84 * j / across);
      return Eigen::Vector3d(std::sin(p) * std::cos(t), std::sin(p) * std::sin(t), std::cos(p));
    }, [](int i, int j) { return i % 2 == 1 && j % 2 == 1; }));
  const Result result = compute(sphere, 1);
  assert(result.code == SC::Error_code::OK);
  assert(result.fallback.find("spacing") == 0); // not the layout of last resort
  assert(result.min_scaled_jacobian > 0); // -0.99 with the layout of last resort
}

// A ramp that winds by one and a quarter turns about a corner: five quads or two.
void check_large_corner()
{
  const int rings = 10, steps = 45;
  Points points{{0, 0, 0}};
  Triangles triangles;
  for(int r = 1; r <= rings; ++r)
    for(int s = 0; s <= steps; ++s)
    {
      const double angle = 2.5 * pi * s / steps;
      points.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.05 * r * angle);
    }
  const auto index = [&](int r, int s) { return r == 0 ? 0 : 1 + (r - 1) * (steps + 1) + s; };
  for(int r = 0; r < rings; ++r)
    for(int s = 0; s < steps; ++s)
    {
      triangles.push_back({{index(r, s), index(r + 1, s), index(r + 1, s + 1)}});
      if(r > 0)
        triangles.push_back({{index(r, s), index(r + 1, s + 1), index(r, s + 1)}});
    }
  const Mesh ramp = to_surface_mesh(points, triangles);
  for(double size : {0.05, 0.1})
  {
    const Result kept = compute(ramp, size, true), moved = compute(ramp, size);
    assert(kept.code == SC::Error_code::OK && kept.fallback == "none");
    assert(kept.irregular.count(-5) == 1);
    assert(moved.code == SC::Error_code::OK);
    // at most two quads at all vertices of the boundary
    assert(!moved.irregular.empty() && *moved.irregular.begin() >= -2);
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
  check_thin_walls();
  check_neighboring_loops();
  check_comb();
  check_crowded_layout();
  check_joined_singularities();
  check_collapsed_chords();
  check_winding_quads();
  check_torus();
  check_large_corner();
  check_star();
  check_narrow_bridges();
  check_no_surfaces();
  return 0;
}
