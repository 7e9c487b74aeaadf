// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INTEGER_GRID_CELLS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INTEGER_GRID_CELLS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Boundary_positions.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Triangle_locator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Moves the charts of a map so that the integer grids of all faces agree; `false` if this is not
// possible. `start_corners` has a corner at an integer point for every component.
inline bool align_integer_grids(Seamless_map& map, const std::vector<int>& start_corners)
{
  const std::int64_t unit = std::int64_t(1) << map.fractional_bits;
  auto fraction = [unit](const Fixed_point_2& p)
    { return Fixed_point_2{{p[0] & (unit - 1), p[1] & (unit - 1)}}; };
  auto move_face = [&map](int f, const Fixed_point_2& by)
  {
    for(int c = 3 * f; c < 3 * f + 3; ++c)
      map.coordinates[c] = minus(map.coordinates[c], by);
  };
  const Fixed_point_2 zero = {{0, 0}};
  std::vector<char> is_visited(map.mesh.number_of_faces(), 0);
  std::vector<int> stack;
  for(int corner : start_corners)
  {
    if(is_visited[Working_mesh::face(corner)])
      continue;
    stack.assign(1, Working_mesh::face(corner));
    is_visited[stack.back()] = 1;
    move_face(stack.back(), fraction(map.coordinates[corner]));
    while(!stack.empty())
    {
      const int f = stack.back();
      stack.pop_back();
      for(int h = 3 * f; h < 3 * f + 3; ++h)
      {
        if(map.mesh.is_border(h))
          continue;
        const int g = Working_mesh::face(map.mesh.opposite[h]);
        const Fixed_point_2 offset = fraction(map.translation(h));
        if(is_visited[g])
        {
          if(offset != zero)
            return false;
          continue;
        }
        is_visited[g] = 1;
        move_face(g, offset);
        stack.push_back(g);
      }
    }
  }
  return std::find(is_visited.begin(), is_visited.end(), 0) == is_visited.end();
}

// Finds the quads of an integer grid map, exactly: a quad is a set of pairs (face, unit cell of its
// chart) whose interiors overlap, connected across the edges that cut the open cell.
class Integer_grid_cells
{
public:
  // \pre the integer grids of all charts agree
  Integer_grid_cells(const Seamless_map& map, const Boundary_positions& positions,
                     Quad_grid& quads, Triangle_locator& locator)
    : m_map(map), m_mesh(map.mesh), m_positions(positions), m_quads(quads), m_locator(locator),
      m_unit(std::int64_t(1) << map.fractional_bits)
  {}

  // returns an empty string or what is wrong with the map
  const char* build()
  {
    find_pairs();
    if(!cluster_pairs())
      return "a cell of the integer grid is not simply connected";
    if(!link_inside_faces() || !link_along_edges())
      return "the cells of the integer grid do not meet side by side";
    if(!m_quads.number_vertices())
      return "a cell of the integer grid is not complete";
    if(!attach_vertices())
      return "a singularity of the integer grid map is not at an integer point";
    return "";
  }

private:
  // A unit cell, by its lower corner in units, in the chart of a face.
  struct Pair
  {
    int face;
    std::array<std::int64_t, 2> cell;
    int quad;
    Placed_face placed;         // in the chart of the quad, where the cell is the unit square
  };

  std::int64_t floor_of(std::int64_t x) const { return x >> m_map.fractional_bits; }

  Open_box box(const std::array<std::int64_t, 2>& cell) const
  {
    return Open_box{{{cell[0] * m_unit, cell[1] * m_unit}},
                    {{(cell[0] + 1) * m_unit, (cell[1] + 1) * m_unit}}};
  }

  std::array<Fixed_point_2, 3> triangle(int f) const
  {
    return {{m_map.coordinates[3 * f], m_map.coordinates[3 * f + 1], m_map.coordinates[3 * f + 2]}};
  }

  void find_pairs()
  {
    m_first_pair.assign(1, 0);
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      const std::array<Fixed_point_2, 3> t = triangle(f);
      std::array<std::int64_t, 2> low, high;
      for(int i = 0; i < 2; ++i)
      {
        low[i] = floor_of((std::min)({t[0][i], t[1][i], t[2][i]}));
        high[i] = floor_of((std::max)({t[0][i], t[1][i], t[2][i]}) - 1);
      }
      for(std::int64_t i = low[0]; i <= high[0]; ++i)
        for(std::int64_t j = low[1]; j <= high[1]; ++j)
          if(do_intersect(box({{i, j}}), t))
            m_pairs.push_back(Pair{f, {{i, j}}, -1, Placed_face()});
      m_first_pair.push_back(m_pairs.size());
    }
  }

  // the pair of a face and a cell of its chart, or null
  Pair* find_pair(int f, const std::array<std::int64_t, 2>& cell)
  {
    auto begin = m_pairs.begin() + m_first_pair[f], end = m_pairs.begin() + m_first_pair[f + 1];
    auto it = std::lower_bound(begin, end, cell,
      [](const Pair& p, const std::array<std::int64_t, 2>& c) { return p.cell < c; });
    return it != end && it->cell == cell ? &*it : nullptr;
  }

  // the same cell in the chart beyond the halfedge `h`, by way of twice its centre
  Pair* find_pair_across(int h, const std::array<std::int64_t, 2>& cell)
  {
    const Fixed_point_2 turned
      = rotate(m_map.rotation[h], Fixed_point_2{{2 * cell[0] + 1, 2 * cell[1] + 1}});
    const Fixed_point_2 t = m_map.translation(h);
    const std::array<std::int64_t, 2> image
      = {{(turned[0] - 1) / 2 + floor_of(t[0]), (turned[1] - 1) / 2 + floor_of(t[1])}};
    return find_pair(Working_mesh::face(m_mesh.opposite[h]), image);
  }

  bool cluster_pairs()
  {
    std::vector<Pair*> stack;
    for(Pair& first : m_pairs)
    {
      if(first.quad >= 0)
        continue;
      first.quad = m_quads.add_quad();
      first.placed
        = Placed_face{first.face, 0, {{-first.cell[0] * m_unit, -first.cell[1] * m_unit}}};
      m_locator.begin_quad();
      stack.assign(1, &first);
      while(!stack.empty())
      {
        const Pair& pair = *stack.back();
        stack.pop_back();
        m_locator.add(m_map, pair.placed, static_cast<double>(m_unit));
        if(!visit_neighbors(pair, stack))
          return false;
      }
    }
    return true;
  }

  bool visit_neighbors(const Pair& pair, std::vector<Pair*>& stack)
  {
    for(int h = 3 * pair.face; h < 3 * pair.face + 3; ++h)
    {
      if(!do_intersect(box(pair.cell), m_map.coordinates[h],
                       m_map.coordinates[Working_mesh::next(h)]))
        continue;
      Pair* next = m_mesh.is_border(h) ? nullptr : find_pair_across(h, pair.cell);
      if(next == nullptr)
        return false;
      const Placed_face placed = pair.placed.across(m_map, h);
      if(next->quad >= 0)
      {
        if(next->quad != pair.quad || !(next->placed == placed))
          return false;
        continue;
      }
      next->quad = pair.quad;
      next->placed = placed;
      stack.push_back(next);
    }
    return true;
  }

  // the side of the quad that lies in `direction` of the chart of the pair's face
  static Quad_grid::Side side(const Pair& pair, int direction)
  {
    return Quad_grid::Side(pair.quad, (direction + pair.placed.rotation + 1) & 3);
  }

  static std::array<std::int64_t, 2> neighbor_cell(std::array<std::int64_t, 2> cell, int direction)
  {
    cell[along_axis(direction)] += axis_sign(direction);
    return cell;
  }

  // A face that overlaps two neighbouring cells overlaps their common side, as it is convex.
  bool link_inside_faces()
  {
    for(const Pair& pair : m_pairs)
      for(int direction = 0; direction < 2; ++direction)
      {
        const Pair* next = find_pair(pair.face, neighbor_cell(pair.cell, direction));
        if(next != nullptr && !m_quads.link(side(pair, direction), side(*next, direction + 2)))
          return false;
      }
    return true;
  }

  // Edges that lie on a line of the integer grid separate cells, too.
  bool link_along_edges()
  {
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
    {
      const Fixed_point_2& a = m_map.coordinates[h];
      const Fixed_point_2 e = minus(m_map.coordinates[Working_mesh::next(h)], a);
      if(e[0] != 0 && e[1] != 0)
        continue;
      const int direction = e[1] == 0 ? (e[0] > 0 ? 0 : 2) : (e[1] > 0 ? 1 : 3);
      if((a[across_axis(direction)] & (m_unit - 1)) == 0 && !link_along_edge(h, direction))
        return false;
    }
    return true;
  }

  bool link_along_edge(int h, int direction)
  {
    const Fixed_point_2& a = m_map.coordinates[h];
    const Fixed_point_2& b = m_map.coordinates[Working_mesh::next(h)];
    const int along = along_axis(direction), across = across_axis(direction);
    const int outward = (direction + 3) & 3;
    std::array<std::int64_t, 2> cell;
    cell[across] = floor_of(a[across]) - (axis_sign(outward) > 0 ? 1 : 0);
    const std::int64_t last = floor_of((std::max)(a[along], b[along]) - 1);
    for(cell[along] = floor_of((std::min)(a[along], b[along])); cell[along] <= last; ++cell[along])
    {
      const Pair* inner = find_pair(Working_mesh::face(h), cell);
      if(inner == nullptr)
        return false;
      const Quad_grid::Side here = side(*inner, outward);
      if(m_mesh.is_border(h))
      {
        if(!m_quads.make_border(here))
          return false;
        const std::int64_t begin = (cell[along] + (axis_sign(direction) < 0 ? 1 : 0)) * m_unit;
        set_border_piece(here, h, axis_sign(direction) * (begin - a[along]));
        continue;
      }
      const Pair* outer = find_pair_across(h, neighbor_cell(cell, outward));
      if(outer == nullptr
         || !m_quads.link(here, side(*outer, outward + 2 + m_map.rotation[h])))
        return false;
    }
    return true;
  }

  // `offset`: from the source of `h` to the start of the side
  void set_border_piece(const Quad_grid::Side& side, int h, std::int64_t offset)
  {
    const double first = static_cast<double>(m_positions.position(h) + offset);
    m_quads.borders[side.first][side.second]
      = m_positions.piece(m_positions.chain(h), first, first + static_cast<double>(m_unit));
  }

  // Notes the vertices of the mesh that lie at vertices of quads; all critical ones have to.
  bool attach_vertices()
  {
    for(Pair& pair : m_pairs)
      for(int c = 3 * pair.face; c < 3 * pair.face + 3; ++c)
      {
        const Fixed_point_2 p = pair.placed(m_map.coordinates[c]);
        if((p[0] != 0 && p[0] != m_unit) || (p[1] != 0 && p[1] != m_unit))
          continue;
        const int corner = p[1] == 0 ? (p[0] == 0 ? 0 : 1) : (p[0] == 0 ? 3 : 2);
        if(!m_quads.attach(pair.quad, corner, m_mesh.source(c)))
          return false;
      }
    return true;
  }

  const Seamless_map& m_map;
  const Working_mesh& m_mesh;
  const Boundary_positions& m_positions;
  Quad_grid& m_quads;
  Triangle_locator& m_locator;
  std::int64_t m_unit;
  std::vector<Pair> m_pairs;              // sorted by face and cell
  std::vector<std::size_t> m_first_pair;  // per face
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INTEGER_GRID_CELLS_H
