// Quad layouts made of blocks of m x m quads, with their boundary chains.
#ifndef BLOCK_LAYOUTS_H
#define BLOCK_LAYOUTS_H

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

// Boundary vertices for which `is_corner` holds, or that have one quad only, end chains.
template <typename K>
void set_chains(CGAL::Surface_mesh_spline_conversion::Quad_layout<K>& layout,
                const std::function<bool(const typename K::Point_3&)>& is_corner)
{
  typedef std::pair<std::size_t, int> Side;
  std::map<std::size_t, Side> next; // by source vertex
  std::map<std::size_t, int> number_of_quads;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
    {
      ++number_of_quads[layout.vertex(q, i)];
      if(layout.is_border(q, i))
        next[layout.vertex(q, i)] = Side(q, i);
    }
  for(const auto& entry : next)
    layout.set_corner(entry.first, number_of_quads[entry.first] == 1
                                   || is_corner(layout.point(entry.first)));
  std::set<std::size_t> done;
  std::size_t chain = 0;
  for(bool closed : {false, true})
    for(const auto& entry : next)
    {
      if(done.count(entry.first) || (!closed && !layout.is_corner(entry.first)))
        continue;
      double s = 0;
      std::size_t v = entry.first;
      do
      {
        done.insert(v);
        const Side side = next.at(v);
        const std::size_t w = layout.vertex(side.first, side.second + 1);
        const double length
          = std::sqrt((layout.point(v) - layout.point(w)).squared_length());
        layout.set_boundary_side(side.first, side.second, {chain, s, s + length});
        s += length;
        v = w;
      }
      while(v != entry.first && !layout.is_corner(v));
      ++chain;
    }
}

// `blocks` are quads of points; `shape` maps the points of the bilinear grids to space. The local
// frames of the quads are turned, so that neighbours rarely agree.
template <typename K>
CGAL::Surface_mesh_spline_conversion::Quad_layout<K> block_layout(
  const std::vector<std::array<std::array<double, 3>, 4> >& blocks, int m,
  const std::function<typename K::Point_3(double, double, double)>& shape,
  const std::function<bool(const typename K::Point_3&)>& is_corner
    = [](const typename K::Point_3&) { return false; })
{
  std::map<std::array<long, 3>, std::size_t> index;
  std::vector<typename K::Point_3> points;
  std::vector<std::array<std::size_t, 4> > quads;
  auto vertex = [&](const std::array<std::array<double, 3>, 4>& b, double u, double v)
  {
    std::array<double, 3> p;
    std::array<long, 3> key;
    for(int k = 0; k < 3; ++k)
    {
      p[k] = (1 - v) * ((1 - u) * b[0][k] + u * b[1][k]) + v * ((1 - u) * b[3][k] + u * b[2][k]);
      key[k] = std::lround(p[k] * 1e6);
    }
    const auto it = index.emplace(key, points.size());
    if(it.second)
      points.push_back(shape(p[0], p[1], p[2]));
    return it.first->second;
  };
  for(const auto& b : blocks)
    for(int j = 0; j < m; ++j)
      for(int i = 0; i < m; ++i)
      {
        static const int du[4] = {0, 1, 1, 0}, dv[4] = {0, 0, 1, 1};
        std::array<std::size_t, 4> quad;
        for(int k = 0; k < 4; ++k)
          quad[(k + i + 2 * j) % 4] = vertex(b, (i + du[k]) / double(m), (j + dv[k]) / double(m));
        quads.push_back(quad);
      }
  CGAL::Surface_mesh_spline_conversion::Quad_layout<K> layout(points, quads);
  set_chains<K>(layout, is_corner);
  return layout;
}

typedef std::vector<std::array<std::array<double, 3>, 4> > Blocks;

// the surface of the cube [-1,1]^3, without the top if `is_open`
inline Blocks cube_blocks(bool is_open)
{
  Blocks blocks;
  for(int axis = 0; axis < 3; ++axis)
    for(int sign = -1; sign <= 1; sign += 2)
    {
      if(is_open && axis == 2 && sign == 1)
        continue;
      std::array<std::array<double, 3>, 4> b;
      static const int du[4] = {-1, 1, 1, -1}, dv[4] = {-1, -1, 1, 1};
      for(int k = 0; k < 4; ++k)
      {
        b[k][axis] = sign;
        b[k][(axis + 1) % 3] = (sign > 0) ? du[k] : dv[k];
        b[k][(axis + 2) % 3] = (sign > 0) ? dv[k] : du[k];
      }
      blocks.push_back(b);
    }
  return blocks;
}

// a tube: the sides of the cube [-1,1]^3, without bottom and top
inline Blocks tube_blocks()
{
  Blocks blocks = cube_blocks(true);
  blocks.pop_back();
  return blocks;
}

// a regular polygon with n corners, cut to n blocks that meet at the center
inline Blocks polygon_blocks(int n)
{
  Blocks blocks;
  auto corner = [n](int k) -> std::array<double, 3>
  { return {{std::cos(2 * M_PI * k / n), std::sin(2 * M_PI * k / n), 0}}; };
  auto middle = [&corner](int k) -> std::array<double, 3>
  {
    const auto a = corner(k), b = corner(k + 1);
    return {{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, 0}};
  };
  for(int k = 0; k < n; ++k)
    blocks.push_back({{{{0, 0, 0}}, middle(k + n - 1), corner(k), middle(k)}});
  return blocks;
}

// the square [-1,1]^2 round an inner square: four extraordinary points, boundary without corner
// vertices of one quad
inline Blocks ring_blocks()
{
  static const int x[4] = {-1, 1, 1, -1}, y[4] = {-1, -1, 1, 1};
  Blocks blocks(1);
  for(int k = 0; k < 4; ++k)
    blocks[0][k] = {{x[k] / 2., y[k] / 2., 0}};
  for(int k = 0; k < 4; ++k)
  {
    const int l = (k + 1) % 4;
    blocks.push_back({{{{double(x[k]), double(y[k]), 0}}, {{double(x[l]), double(y[l]), 0}},
                       {{x[l] / 2., y[l] / 2., 0}}, {{x[k] / 2., y[k] / 2., 0}}}});
  }
  return blocks;
}

#endif // BLOCK_LAYOUTS_H
