// Generated seamless maps for the tests of T-mesh, quantization and layout: surfaces of voxel
// sets. Every voxel face is a square chart of `edge` units, cut into `n x n` small squares and
// these into triangles, so that isolines run along edges and through vertices everywhere: the
// degenerate cases of the tracer are the rule here.
#ifndef TEST_VOXEL_SEAMLESS_MAPS_H
#define TEST_VOXEL_SEAMLESS_MAPS_H

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Cut_graph.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/chart_navigation.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace Test {

namespace internal = CGAL::Surface_mesh_spline_conversion::internal;
using internal::determinant;
using internal::minus;
using internal::plus;
using internal::rotate;
using internal::Fixed_point_2;
using internal::Seamless_map;
using internal::Working_mesh;

typedef std::array<int, 3> Lattice_point;

// finds opposite halfedges, outgoing halfedges and rotations; `false` if the mesh is no manifold
inline bool connect(Seamless_map& map)
{
  Working_mesh& mesh = map.mesh;
  const int n = mesh.number_of_halfedges();
  std::map<std::pair<int, int>, int> halfedge;
  for(int h = 0; h < n; ++h)
    if(!halfedge.emplace(std::make_pair(mesh.source(h), mesh.target(h)), h).second)
      return false;
  mesh.opposite.assign(n, -1);
  mesh.vertex_halfedge.assign(mesh.number_of_vertices(), -1);
  mesh.boundary_piece.assign(n, Working_mesh::Boundary_piece());
  std::vector<int> number_of_corners(mesh.number_of_vertices(), 0);
  for(int h = 0; h < n; ++h)
  {
    auto it = halfedge.find(std::make_pair(mesh.target(h), mesh.source(h)));
    mesh.opposite[h] = it == halfedge.end() ? -1 : it->second;
    int& outgoing = mesh.vertex_halfedge[mesh.source(h)];
    if(outgoing < 0 || mesh.opposite[h] < 0)
      outgoing = h;
    ++number_of_corners[mesh.source(h)];
  }
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
  {
    int around = 0;
    if(mesh.vertex_halfedge[v] < 0)
      return false;
    mesh.for_each_outgoing(v, [&](int) { ++around; });
    if(around != number_of_corners[v])
      return false;
  }
  map.rotation.assign(n, 0);
  for(int h = 0; h < n; ++h)
    if(!mesh.is_border(h))
    {
      const int o = mesh.opposite[h];
      const Fixed_point_2 here = minus(map.coordinates[mesh.next(h)], map.coordinates[h]);
      const Fixed_point_2 there = minus(map.coordinates[o], map.coordinates[mesh.next(o)]);
      while(map.rotation[h] < 4 && rotate(map.rotation[h], here) != there)
        ++map.rotation[h];
      assert(map.rotation[h] < 4);
    }
  return true;
}

// numbers the chains between the vertices that are corners, and measures their arc lengths
inline void make_chains(Working_mesh& mesh)
{
  std::size_t chain = 0;
  std::vector<char> is_visited(mesh.number_of_halfedges(), 0);
  for(int pass = 0; pass < 2; ++pass)
    for(int first = 0; first < mesh.number_of_halfedges(); ++first)
    {
      if(!mesh.is_border(first) || is_visited[first]
         || (pass == 0 && !mesh.is_corner[mesh.source(first)]))
        continue;
      double length = 0;
      int h = first;
      do
      {
        is_visited[h] = 1;
        const double end = length + mesh.vector(h).norm();
        mesh.boundary_piece[h].chain = chain;
        mesh.boundary_piece[h].first = length;
        mesh.boundary_piece[h].last = end;
        length = end;
        h = mesh.vertex_halfedge[mesh.target(h)];
      }
      while(!is_visited[h] && !mesh.is_corner[mesh.source(h)]);
      ++chain;
    }
}

// total angles of the vertices in quarter turns, from the real angles
inline void measure_cones(Seamless_map& map)
{
  std::vector<double> angle(map.mesh.number_of_vertices(), 0);
  for(int c = 0; c < map.mesh.number_of_halfedges(); ++c)
  {
    const Fixed_point_2 a = minus(map.coordinates[Working_mesh::next(c)], map.coordinates[c]);
    const Fixed_point_2 b = minus(map.coordinates[Working_mesh::previous(c)], map.coordinates[c]);
    angle[map.mesh.source(c)]
      += std::atan2(static_cast<double>(determinant(a, b)),
                    static_cast<double>(a[0]) * b[0] + static_cast<double>(a[1]) * b[1]);
  }
  map.cone.resize(angle.size());
  for(std::size_t v = 0; v < angle.size(); ++v)
    map.cone[v] = static_cast<int>(std::lround(angle[v] / std::acos(0.)));
}

// moves the regular vertices inside by up to `amount` units, differently in u and v
inline void jitter(Seamless_map& map, int amount, std::mt19937& random)
{
  for(int v = 0; v < map.mesh.number_of_vertices(); ++v)
  {
    if(map.mesh.is_border_vertex(v) || map.cone[v] != 4)
      continue;
    const int range = 2 * amount + 1;
    Fixed_point_2 offset = {{static_cast<std::int64_t>(random() % range) - amount,
                             static_cast<std::int64_t>(random() % range) - amount}};
    map.mesh.for_each_outgoing(v, [&](int c)
    {
      map.coordinates[c] = plus(map.coordinates[c], offset);
      offset = rotate(map.rotation[Working_mesh::previous(c)], offset);
    });
  }
}

// changes the charts such that transitions are trivial where the cut graph does not cut
inline void comb(Seamless_map& map)
{
  const internal::Cut_graph cut(map.mesh, map.rotation, map.cone);
  for(int c = 0; c < map.mesh.number_of_halfedges(); ++c)
    map.coordinates[c] = rotate(-cut.turns(c / 3), map.coordinates[c]);
  map.rotation = cut.rotation();
  std::vector<char> is_visited(map.mesh.number_of_faces(), 0);
  std::vector<int> stack(cut.roots());
  for(int root : stack)
    is_visited[root] = 1;
  while(!stack.empty())
  {
    const int f = stack.back();
    stack.pop_back();
    for(int h = 3 * f; h < 3 * f + 3; ++h)
    {
      if(map.mesh.is_border(h) || cut.branch(h) >= 0
         || is_visited[map.mesh.opposite[h] / 3])
        continue;
      const int g = map.mesh.opposite[h] / 3;
      is_visited[g] = 1;
      const Fixed_point_2 t = map.translation(h);
      for(int c = 3 * g; c < 3 * g + 3; ++c)
        map.coordinates[c] = minus(map.coordinates[c], t);
      stack.push_back(g);
    }
  }
}

struct Voxel_surface_options
{
  int subdivision = 2;         // small squares along a voxel edge
  std::int64_t edge = 1 << 20; // units of a voxel edge
  int fractional_bits = 20;
  int jitter = 0;              // units
  double hole_probability = 0; // of a voxel face
};

// the map of the surface of a voxel set; `false` if it is no manifold
inline bool make_voxel_map(const std::set<Lattice_point>& voxels,
                           const Voxel_surface_options& options, std::mt19937& random,
                           Seamless_map& map)
{
  map = Seamless_map();
  map.fractional_bits = options.fractional_bits;
  const int n = options.subdivision;
  const std::int64_t unit = options.edge / n;
  std::map<Lattice_point, int> vertex;
  auto add_corner = [&](const Lattice_point& p)
  {
    auto inserted = vertex.emplace(p, static_cast<int>(map.mesh.points.size()));
    if(inserted.second)
      map.mesh.points.emplace_back(p[0] / double(n), p[1] / double(n), p[2] / double(n));
    return inserted.first->second;
  };
  for(const Lattice_point& voxel : voxels)
    for(int axis = 0; axis < 3; ++axis)
      for(int side = 0; side < 2; ++side)
      {
        Lattice_point neighbor = voxel;
        neighbor[axis] += side ? 1 : -1;
        if(voxels.count(neighbor) || (random() % 1000) < 1000 * options.hole_probability)
          continue;
        // u, v and the outward normal are right-handed
        const int u = (axis + (side ? 1 : 2)) % 3, v = (axis + (side ? 2 : 1)) % 3;
        for(int i = 0; i < n; ++i)
          for(int j = 0; j < n; ++j)
          {
            std::array<int, 4> id;
            std::array<Fixed_point_2, 4> x;
            for(int k = 0; k < 4; ++k)
            {
              const int a = i + ((k == 1 || k == 2) ? 1 : 0), b = j + (k >= 2 ? 1 : 0);
              Lattice_point p = {{n * voxel[0], n * voxel[1], n * voxel[2]}};
              p[axis] += side ? n : 0;
              p[u] += a;
              p[v] += b;
              id[k] = add_corner(p);
              x[k] = {{a * unit, b * unit}};
            }
            const int d = random() % 2;
            for(const std::array<int, 3>& t : {std::array<int, 3>{{d, d + 1, d + 2}},
                                               std::array<int, 3>{{d, d + 2, (d + 3) & 3}}})
            {
              map.mesh.triangles.push_back({{id[t[0]], id[t[1]], id[t[2]]}});
              for(int k : t)
                map.coordinates.push_back(x[k]);
            }
          }
      }
  map.mesh.is_corner.assign(map.mesh.points.size(), 0);
  map.mesh.parent.resize(map.mesh.triangles.size());
  for(std::size_t f = 0; f < map.mesh.parent.size(); ++f)
    map.mesh.parent[f] = f;
  if(map.mesh.triangles.empty() || !connect(map))
    return false;
  measure_cones(map);
  jitter(map, options.jitter, random);
  for(int v = 0; v < map.mesh.number_of_vertices(); ++v)
    map.mesh.is_corner[v] = map.mesh.is_border_vertex(v) && map.cone[v] != 2;
  make_chains(map.mesh);
  comb(map);
  map.size.assign(map.mesh.number_of_vertices(),
                  std::ldexp(1., options.fractional_bits) / options.edge);
  return true;
}

// A map of a parallelogram, `columns` x `rows` squares whose rows are shifted by `shear` units, with
// its left and right side glued and, if `is_torus`, also bottom and top: no vertex is singular.
// The points lie on a torus or a cylinder.
inline Seamless_map make_flat_map(int columns, int rows, std::int64_t edge, std::int64_t shear,
                                  bool is_torus, int fractional_bits)
{
  Seamless_map map;
  map.fractional_bits = fractional_bits;
  const double full = 4 * std::acos(0.);
  const int number_of_rows_of_points = is_torus ? rows : rows + 1;
  for(int j = 0; j < number_of_rows_of_points; ++j)
    for(int i = 0; i < columns; ++i)
    {
      const double a = full * i / columns, b = full * j / rows;
      if(is_torus)
        map.mesh.points.emplace_back((3 + std::cos(b)) * std::cos(a),
                                     (3 + std::cos(b)) * std::sin(a), std::sin(b));
      else
        map.mesh.points.emplace_back(std::cos(a), std::sin(a), full * j / columns);
    }
  for(int j = 0; j < rows; ++j)
    for(int i = 0; i < columns; ++i)
      for(const std::array<int, 3>& t : {std::array<int, 3>{{0, 1, 2}},
                                         std::array<int, 3>{{0, 2, 3}}})
      {
        std::array<int, 3> id;
        for(int k = 0; k < 3; ++k)
        {
          const int a = i + ((t[k] == 1 || t[k] == 2) ? 1 : 0), b = j + (t[k] >= 2 ? 1 : 0);
          id[k] = (b % number_of_rows_of_points) * columns + a % columns;
          map.coordinates.push_back({{a * edge + b * shear, b * edge}});
        }
        map.mesh.triangles.push_back(id);
      }
  map.mesh.is_corner.assign(map.mesh.points.size(), 0);
  map.mesh.parent.resize(map.mesh.triangles.size());
  for(std::size_t f = 0; f < map.mesh.parent.size(); ++f)
    map.mesh.parent[f] = f;
  const bool is_manifold = connect(map);
  assert(is_manifold);
  (void)is_manifold;
  measure_cones(map);
  make_chains(map.mesh);
  comb(map);
  map.size.assign(map.mesh.points.size(),
                  full / columns * std::ldexp(1., fractional_bits) / edge);
  return map;
}

// a random connected voxel set
inline std::set<Lattice_point> random_voxels(int number, std::mt19937& random)
{
  std::set<Lattice_point> voxels;
  voxels.insert(Lattice_point{{0, 0, 0}});
  while(static_cast<int>(voxels.size()) < number)
  {
    auto it = voxels.begin();
    std::advance(it, random() % voxels.size());
    Lattice_point p = *it;
    p[random() % 3] += random() % 2 ? 1 : -1;
    voxels.insert(p);
  }
  return voxels;
}

} // namespace Test

#endif // TEST_VOXEL_SEAMLESS_MAPS_H
