// Generated triangle meshes for the tests of field and map, as working meshes without ears.
#ifndef TEST_GENERATED_WORKING_MESHES_H
#define TEST_GENERATED_WORKING_MESHES_H

#include <CGAL/Surface_mesh_spline_conversion/internal/map/refine_working_mesh.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace Test {

namespace internal = CGAL::Surface_mesh_spline_conversion::internal;
using internal::Working_mesh;

typedef std::vector<Eigen::Vector3d> Points;
typedef std::vector<std::array<int, 3> > Triangles;

const double pi = 3.14159265358979323846;

// Opposite halfedges by a map of edges; every boundary loop is a chain, arc lengths are chord
// lengths; boundary vertices where the boundary turns by more than 30 degrees are corners.
inline Working_mesh make_mesh(const Points& points, const Triangles& triangles)
{
  Working_mesh mesh;
  mesh.points = points;
  mesh.triangles = triangles;
  const int n = mesh.number_of_halfedges();
  std::map<std::pair<int, int>, int> halfedge;
  for(int h = 0; h < n; ++h)
    halfedge[std::make_pair(mesh.source(h), mesh.target(h))] = h;
  mesh.opposite.assign(n, -1);
  mesh.vertex_halfedge.assign(points.size(), -1);
  mesh.boundary_piece.resize(n);
  mesh.is_corner.assign(points.size(), 0);
  for(int f = 0; f < mesh.number_of_faces(); ++f)
    mesh.parent.push_back(f);
  for(int h = 0; h < n; ++h)
  {
    const auto it = halfedge.find(std::make_pair(mesh.target(h), mesh.source(h)));
    mesh.opposite[h] = it == halfedge.end() ? -1 : it->second;
    int& outgoing = mesh.vertex_halfedge[mesh.source(h)];
    if(outgoing < 0 || mesh.opposite[h] < 0)
      outgoing = h;
  }
  std::size_t chain = 0;
  for(int seed = 0; seed < n; ++seed)
  {
    if(!mesh.is_border(seed) || mesh.boundary_piece[seed].chain != Working_mesh::no_chain)
      continue;
    double length = 0;
    int h = seed;
    do
    {
      const int next = mesh.vertex_halfedge[mesh.target(h)];
      mesh.boundary_piece[h].chain = chain;
      mesh.boundary_piece[h].first = length;
      mesh.boundary_piece[h].last = length += mesh.vector(h).norm();
      const double cosine = mesh.vector(h).normalized().dot(mesh.vector(next).normalized());
      mesh.is_corner[mesh.target(h)] = cosine < std::cos(pi / 6);
      h = next;
    }
    while(h != seed);
    ++chain;
  }
  internal::split_ears(mesh);
  return mesh;
}

// A grid of m x n squares, each cut into two triangles, without the squares where `hole(i, j)`;
// `place(u, v)` for u in [0, m], v in [0, n]. Closed directions wrap around.
template <typename Place, typename Hole>
Working_mesh make_grid(int m, int n, bool is_u_closed, bool is_v_closed, Place place, Hole hole)
{
  const int columns = is_u_closed ? m : m + 1, rows = is_v_closed ? n : n + 1;
  const auto index = [&](int i, int j) { return (j % rows) * columns + i % columns; };
  Triangles triangles;
  for(int j = 0; j < n; ++j)
    for(int i = 0; i < m; ++i)
      if(!hole(i, j))
      {
        triangles.push_back({{index(i, j), index(i + 1, j), index(i + 1, j + 1)}});
        triangles.push_back({{index(i, j), index(i + 1, j + 1), index(i, j + 1)}});
      }
  // keep the vertices in use
  std::vector<int> number(columns * rows, -1);
  Points points;
  for(std::array<int, 3>& t : triangles)
    for(int& v : t)
    {
      if(number[v] < 0)
      {
        number[v] = static_cast<int>(points.size());
        points.push_back(place(v % columns, v / columns));
      }
      v = number[v];
    }
  return make_mesh(points, triangles);
}

inline bool no_hole(int, int) { return false; }

inline Eigen::Vector3d in_plane(double u, double v) { return Eigen::Vector3d(u, v, 0); }

// The outline of a rectangle of 20 by 0.2: 20 steps along one side, one across, 20 back, one
// across.
inline Eigen::Vector2d on_thin_rectangle(double u)
{
  const double x = u < 20 ? u : (u < 21 ? 20 : (u < 41 ? 41 - u : 0));
  const double y = u < 20 ? 0 : (u < 21 ? (u - 20) * 0.2 : (u < 41 ? 0.2 : (42 - u) * 0.2));
  return Eigen::Vector2d(x, y);
}

// A flat ring, inner radius 20, closed in both directions: u along the outline of its section, 24
// steps of v around.
inline Eigen::Vector3d on_thin_ring(double u, double v)
{
  const Eigen::Vector2d p = on_thin_rectangle(u);
  const double angle = pi * v / 12;
  return Eigen::Vector3d((20 + p[0]) * std::cos(angle), (20 + p[0]) * std::sin(angle), p[1]);
}

struct Input
{
  std::string name;
  Working_mesh mesh;
  double quad_size;
  int euler_characteristic;
};

inline Working_mesh make_sphere(int subdivisions)
{
  Points p{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  Triangles t{{{0, 1, 2}}, {{1, 3, 2}}, {{3, 4, 2}}, {{4, 0, 2}},
              {{1, 0, 5}}, {{3, 1, 5}}, {{4, 3, 5}}, {{0, 4, 5}}};
  for(int s = 0; s < subdivisions; ++s)
  {
    std::map<std::pair<int, int>, int> middle;
    const auto split = [&](int a, int b)
    {
      const auto edge = std::make_pair((std::min)(a, b), (std::max)(a, b));
      if(middle.count(edge) == 0)
      {
        middle[edge] = static_cast<int>(p.size());
        p.push_back(Eigen::Vector3d((p[a] + p[b]).normalized()));
      }
      return middle[edge];
    };
    Triangles finer;
    for(const auto& x : t)
    {
      const int a = split(x[0], x[1]), b = split(x[1], x[2]), c = split(x[2], x[0]);
      finer.insert(finer.end(), {{{x[0], a, c}}, {{a, x[1], b}}, {{c, b, x[2]}}, {{a, b, c}}});
    }
    t = finer;
  }
  return make_mesh(p, t);
}

inline Working_mesh make_regular_disk(int corners)
{
  Points p{{0, 0, 0}};
  Triangles t;
  for(int i = 0; i < corners; ++i)
  {
    p.emplace_back(std::cos(2 * pi * i / corners), std::sin(2 * pi * i / corners), 0);
    t.push_back({{0, 1 + i, 1 + (i + 1) % corners}});
  }
  return make_mesh(p, t);
}

// boundary r = 1 + cos, smooth but for one corner at the origin
inline Eigen::Vector3d in_drop(double ring, double angle, int rings)
{
  const double t = ring / rings;
  const double x = 1.5 - 0.5 * t + t * std::cos(angle) * (1 + std::cos(angle));
  return Eigen::Vector3d(x, t * std::sin(angle) * (1 + std::cos(angle)), 0);
}

inline Working_mesh make_drop(int rings, int sectors)
{
  Points p{{1.5, 0, 0}};
  Triangles t;
  for(int r = 1; r <= rings; ++r)
    for(int s = 0; s < sectors; ++s)
      p.push_back(in_drop(r, pi * (2. * s / sectors - 1), rings));
  const auto index = [&](int r, int s) { return r == 0 ? 0 : 1 + (r - 1) * sectors + s % sectors; };
  for(int r = 0; r < rings; ++r)
    for(int s = 0; s < sectors; ++s)
    {
      t.push_back({{index(r, s), index(r + 1, s), index(r + 1, s + 1)}});
      if(r > 0)
        t.push_back({{index(r, s), index(r + 1, s + 1), index(r, s + 1)}});
    }
  return make_mesh(p, t);
}

inline Eigen::Vector3d on_torus(double u, double v)
{
  return Eigen::Vector3d((3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u),
                         std::sin(v));
}

inline Working_mesh disjoint_union(const Working_mesh& a, const Working_mesh& b,
                                   const Eigen::Vector3d& offset)
{
  Points points = a.points;
  Triangles triangles = a.triangles;
  for(const Eigen::Vector3d& p : b.points)
    points.push_back(p + offset);
  const int n = a.number_of_vertices();
  for(const auto& t : b.triangles)
    triangles.push_back({{t[0] + n, t[1] + n, t[2] + n}});
  return make_mesh(points, triangles);
}

inline Working_mesh with_noise(Working_mesh mesh, double amplitude)
{
  std::mt19937 random(7);
  const auto uniform = [&random]() { return 2. * (random() - random.min())
                                            / double(random.max() - random.min()) - 1.; };
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
    if(!mesh.is_border_vertex(v))
      mesh.points[v] += amplitude * Eigen::Vector3d(uniform(), uniform(), uniform());
  return mesh;
}

// every topological feature once
inline std::vector<Input> working_mesh_inputs()
{
  std::vector<Input> inputs;
  const auto add = [&inputs](const std::string& name, const Working_mesh& mesh, double size,
                             int chi)
    { inputs.push_back(Input{name, mesh, size, chi}); };
  const auto plate_hole = [](int i, int j) { return 7 <= i && i < 12 && 5 <= j && j < 9; };
  const auto notch = [](int i, int j) { return i >= 8 && j >= 6; };

  add("triangle", make_mesh({{0, 0, 0}, {1, 0, 0}, {0.4, 0.9, 0}}, {{{0, 1, 2}}}), 0.3, 1);
  add("large quads on a triangle",
      make_mesh({{0, 0, 0}, {1, 0, 0}, {0.4, 0.9, 0}}, {{{0, 1, 2}}}), 10, 1);
  add("two triangles", make_mesh({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                                 {{{0, 1, 2}}, {{0, 2, 3}}}), 0.5, 1);
  add("square", make_grid(9, 7, false, false, in_plane, no_hole), 1.5, 1);
  add("plate with a hole", make_grid(20, 14, false, false, in_plane, plate_hole), 2, 0);
  add("notch", make_grid(16, 12, false, false, in_plane, notch), 1.5, 1);
  add("coarse notch", make_grid(16, 12, false, false, in_plane, notch), 6, 1);
  add("slivers", make_grid(8, 8, false, false,
    [](double u, double v) { return in_plane(u, v < 4.5 ? v : v - 1 + 1e-6 * v); }, no_hole), 2, 1);
  add("hexagon", make_regular_disk(6), 0.4, 1);
  add("disk", make_regular_disk(40), 0.3, 1);
  add("disk with one corner", make_drop(10, 48), 0.3, 1);
  add("annulus", make_grid(36, 6, true, false,
    [](double u, double v) { return Eigen::Vector3d((3 + v / 3) * std::cos(pi * u / 18),
                                                    (3 + v / 3) * std::sin(pi * u / 18), 0); },
    no_hole), 0.8, 0);
  add("tube", make_grid(24, 20, true, false,
    [](double u, double v) { return Eigen::Vector3d(std::cos(pi * u / 12), std::sin(pi * u / 12),
                                                    v / 4); }, no_hole), 0.5, 0);
  add("torus", make_grid(40, 14, true, true,
    [](double u, double v) { return on_torus(pi * u / 20, pi * v / 7); }, no_hole), 0.7, 0);
  add("sphere", make_sphere(3), 0.3, 2);
  add("coarse sphere", make_sphere(3), 1.5, 2);
  add("octahedron", make_sphere(0), 0.5, 2);
  add("noisy sphere", with_noise(make_sphere(4), 0.02), 0.3, 2);
  add("noisy plate", with_noise(make_grid(20, 14, false, false, in_plane, plate_hole), 0.2), 2, 0);
  add("two components", disjoint_union(make_sphere(3),
    make_grid(9, 7, false, false,
              [](double u, double v) { return in_plane(u / 4, v / 4); }, no_hole),
    Eigen::Vector3d(5, 0, 0)), 0.4, 3);
  return inputs;
}

} // namespace Test

#endif // TEST_GENERATED_WORKING_MESHES_H
