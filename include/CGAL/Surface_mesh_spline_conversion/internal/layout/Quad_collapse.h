// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_COLLAPSE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_COLLAPSE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Collapse_pattern.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Fewer quads, from a layout some of whose chords or quads have been collapsed.
struct Collapsed_quads
{
  Quad_grid quads;
  std::vector<int> original;                // per quad: the one of the layout before, whose sides
                                            // have the same numbers
  std::vector<int> vertex_of;               // per vertex of the layout before
  std::vector<int> anchor;                  // per vertex: at the boundary, the vertex before that
                                            // it lies at
};

// Finds out which chords and quads of a layout can be collapsed such that the topology of the
// surface, the corners, and what the stages after the map need are kept.
class Quad_collapse
{
public:
  typedef Quad_grid::Side Side;

  // inside
  static constexpr int most_quads_at_vertex = 8;

  // `is_corner`: per vertex, not to be moved along the boundary
  Quad_collapse(const Quad_grid& quads, const std::vector<char>& is_corner) : m_quads(quads)
  {
    find_boundary(is_corner);
  }

  // The quads that are left by a pattern of collapses; nothing if this is not admissible. Sides and
  // diagonals that become a vertex have to be a tree, together with what becomes a vertex between
  // them, that meets the boundary in one piece with at most one corner. At the boundary, as many
  // quads stay at each vertex as before; inside, there are three to eight. Each quad has four
  // vertices. No loop has less than four sides, as those of integer grid maps.
  std::optional<Collapsed_quads> collapse(const Collapse_pattern& pattern,
                                          int most_bad_quads = 0) const
  {
    std::optional<Collapsed_quads> result = collapse_for_now(pattern);
    if(result && (number_of_bad_quads(result->quads) > most_bad_quads
                  || !has_good_valences(*result) || !set_borders(*result)))
      result.reset();
    return result;
  }

  // the same without what may be made good by further collapses: the numbers of quads at vertices,
  // and of sides of loops; there are no pieces of the boundary yet
  std::optional<Collapsed_quads> collapse_for_now(const Collapse_pattern& pattern) const
  {
    Collapsed_quads result;
    const std::vector<int> group = vertex_groups(pattern);
    if(!are_trees(group, pattern) || !make_quads(pattern, result)
       || !result.quads.number_vertices() || !place_vertices(group, pattern, result)
       || result.quads.euler_characteristic() != m_quads.euler_characteristic())
      return std::nullopt;
    return result;
  }

  // those without four different vertices
  static int number_of_bad_quads(const Quad_grid& quads)
  {
    int number = 0;
    for(const auto& vertices : quads.vertices)
      number += std::set<int>(vertices.begin(), vertices.end()).size() < 4 ? 1 : 0;
    return number;
  }

  // the border sides from a vertex of the boundary to another one
  std::vector<Side> sides_between(int v, int w) const
  {
    std::vector<Side> sides;
    do
    {
      sides.push_back(m_border_side[v]);
      v = next_on_boundary(v);
    }
    while(v != w);
    return sides;
  }

private:
  static constexpr int least_sides_of_loop = 4;

  static int side_vertex(const Quad_grid& quads, const Side& side)
  {
    return quads.vertices[side.first][side.second & 3];
  }

  void find_boundary(const std::vector<char>& is_corner)
  {
    m_border_side.assign(m_quads.number_of_vertices(), Side(-1, 0));
    m_incoming = m_border_side;
    for(int q = 0; q < m_quads.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
        if(m_quads.is_border(q, i))
        {
          m_border_side[m_quads.vertices[q][i]] = Side(q, i);
          m_incoming[m_quads.vertices[q][(i + 1) & 3]] = Side(q, i);
          const Quad_grid::Border& b = m_quads.borders[q][i];
          m_chain_length[b.chain] += b.last - b.first;
        }
    m_is_fixed = is_corner;
    for(int v = 0; v < m_quads.number_of_vertices(); ++v)
      if(m_quads.is_border_vertex[v]
         && (m_quads.valence[v] != 2
             || border(m_border_side[v]).chain != border(m_incoming[v]).chain))
        m_is_fixed[v] = 1;
  }

  const Quad_grid::Border& border(const Side& side) const
  {
    return m_quads.borders[side.first][side.second];
  }

  // per vertex: a vertex that is the same for all those that it meets
  std::vector<int> vertex_groups(const Collapse_pattern& pattern) const
  {
    std::vector<int> group(m_quads.number_of_vertices());
    for(std::size_t v = 0; v < group.size(); ++v)
      group[v] = static_cast<int>(v);
    const auto root = [&group](int v)
    {
      while(group[v] != v)
        v = group[v] = group[group[v]];
      return v;
    };
    const auto unite = [&](int q, int i, int j)
    { group[root(m_quads.vertices[q][i])] = root(m_quads.vertices[q][j]); };
    for(int q = 0; q < m_quads.number_of_quads(); ++q)
    {
      for(int i = 0; i < 4; ++i)
        if(pattern.is_shrunk(Side(q, i)))
          unite(q, i, (i + 1) & 3);
      if(const int i = pattern.diagonal(q); i >= 0)
        unite(q, i, i + 2);
    }
    for(std::size_t v = 0; v < group.size(); ++v)
      group[v] = root(static_cast<int>(v));
    return group;
  }

  bool are_trees(const std::vector<int>& group, const Collapse_pattern& pattern) const
  {
    struct Counts
    {
      int euler_characteristic = 0, border_euler_characteristic = 0, fixed = 0;
      bool is_at_border = false;
    };
    std::vector<Counts> counts(group.size());
    for(std::size_t v = 0; v < group.size(); ++v)
    {
      Counts& c = counts[group[v]];
      ++c.euler_characteristic;
      c.border_euler_characteristic += m_quads.is_border_vertex[v] ? 1 : 0;
      c.is_at_border = c.is_at_border || m_quads.is_border_vertex[v];
      c.fixed += m_is_fixed[v];
    }
    for(int q = 0; q < m_quads.number_of_quads(); ++q)
    {
      const int corner = (std::max)(pattern.diagonal(q), 0);
      counts[group[m_quads.vertices[q][corner]]].euler_characteristic
        += faces_minus_diagonals(q, pattern);
      for(int i = 0; i < 4; ++i)
      {
        Counts& c = counts[group[m_quads.vertices[q][i]]];
        if(!pattern.is_shrunk(Side(q, i))
           || (!m_quads.is_border(q, i) && m_quads.neighbors[q][i] < Side(q, i)))
          continue;
        --c.euler_characteristic;
        c.border_euler_characteristic -= m_quads.is_border(q, i) ? 1 : 0;
      }
    }
    for(std::size_t v = 0; v < group.size(); ++v)
      if(group[v] == static_cast<int>(v)
         && (counts[v].euler_characteristic != 1
             || counts[v].border_euler_characteristic != (counts[v].is_at_border ? 1 : 0)
             || counts[v].fixed > 1))
        return false;
    return true;
  }

  // the faces of a quad that become a vertex, two if it has a diagonal, less the diagonals
  static int faces_minus_diagonals(int q, const Collapse_pattern& pattern)
  {
    const auto is_shrunk = [&](int i) { return pattern.is_shrunk(Side(q, i & 3)); };
    const auto are_shrunk = [&](int i) { return is_shrunk(i) && is_shrunk(i + 1) ? 1 : 0; };
    const int i = pattern.diagonal(q);
    return i < 0 ? are_shrunk(0) * are_shrunk(2) : are_shrunk(i) + are_shrunk(i + 2) - 1;
  }

  // Links what is left, across quads that collapse.
  bool make_quads(const Collapse_pattern& pattern, Collapsed_quads& result) const
  {
    std::vector<int> number(m_quads.number_of_quads(), -1);
    for(int q = 0; q < m_quads.number_of_quads(); ++q)
      if(pattern.is_left(q))
      {
        number[q] = result.quads.add_quad();
        result.original.push_back(q);
      }
    for(int k = 0; k < result.quads.number_of_quads(); ++k)
      for(int i = 0; i < 4; ++i)
      {
        const Side beyond
          = pattern.beyond(Side(result.original[k], i), [](const Side&, const Side&) {});
        if(beyond.first == Quad_grid::border)
          result.quads.make_border(Side(k, i));
        else
          result.quads.neighbors[k][i] = Side(number[beyond.first], beyond.second);
      }
    return result.quads.number_of_quads() > 0;
  }

  // One vertex for each group.
  bool place_vertices(const std::vector<int>& group, const Collapse_pattern& pattern,
                      Collapsed_quads& result) const
  {
    std::vector<int> vertex_of(group.size(), -1), group_of(result.quads.number_of_vertices(), -1);
    for(int k = 0; k < result.quads.number_of_quads(); ++k)
      for(int i = 0; i < 4; ++i)
      {
        const int v = result.quads.vertices[k][i];
        const int g = group[m_quads.vertices[result.original[k]][i]];
        if((group_of[v] >= 0 && group_of[v] != g) || (vertex_of[g] >= 0 && vertex_of[g] != v))
          return false;
        group_of[v] = g;
        vertex_of[g] = v;
      }
    result.anchor.assign(result.quads.number_of_vertices(), -1);
    for(std::size_t v = 0; v < group.size(); ++v)
    {
      if(vertex_of[group[v]] < 0)
        return false;
      if(m_quads.is_border_vertex[v] && !result.quads.is_border_vertex[vertex_of[group[v]]])
        return false;
      result.vertex_of.push_back(vertex_of[group[v]]);
    }
    for(int v = 0; v < result.quads.number_of_vertices(); ++v)
      if(result.quads.is_border_vertex[v])
      {
        result.anchor[v] = anchor_of(group_of[v], group, pattern);
        if(result.anchor[v] < 0)
          return false;
        result.quads.mesh_vertex[v] = m_quads.mesh_vertex[result.anchor[v]];
      }
    return true;
  }

  // of a group: its corner, or else the vertex of the boundary in the middle; -1 if there is none
  int anchor_of(int g, const std::vector<int>& group, const Collapse_pattern& pattern) const
  {
    int first = -1;
    for(std::size_t v = 0; v < group.size(); ++v)
      if(group[v] == g && m_quads.is_border_vertex[v])
      {
        if(m_is_fixed[v])
          return static_cast<int>(v);
        if(first < 0)
          first = static_cast<int>(v);
      }
    return first < 0 ? -1 : middle_of(first, pattern);
  }

  int next_on_boundary(int v) const
  {
    const Side& side = m_border_side[v];
    return m_quads.vertices[side.first][(side.second + 1) & 3];
  }

  // of the piece of the boundary around a vertex that becomes a vertex
  int middle_of(int v, const Collapse_pattern& pattern) const
  {
    const auto is_inside = [&](const Side& side) { return pattern.is_shrunk(side); };
    while(is_inside(m_incoming[v]))
      v = side_vertex(m_quads, m_incoming[v]);
    std::vector<int> piece(1, v);
    std::vector<double> position(1, 0);
    while(is_inside(m_border_side[piece.back()]))
    {
      const Quad_grid::Border& b = border(m_border_side[piece.back()]);
      position.push_back(position.back() + b.last - b.first);
      piece.push_back(next_on_boundary(piece.back()));
    }
    const auto distance = [&](double x) { return std::abs(x - position.back() / 2); };
    const auto middle
      = std::min_element(position.begin(), position.end(),
                         [&](double x, double y) { return distance(x) < distance(y); });
    return piece[middle - position.begin()];
  }

  bool has_good_valences(const Collapsed_quads& result) const
  {
    const Quad_grid& quads = result.quads;
    for(int v = 0; v < quads.number_of_vertices(); ++v)
    {
      const int n = quads.valence[v];
      if(quads.is_border_vertex[v] ? n != m_quads.valence[result.anchor[v]]
                                   : n < 3 || n > most_quads_at_vertex)
        return false;
    }
    return true;
  }

  bool set_borders(Collapsed_quads& result) const
  {
    Quad_grid& quads = result.quads;
    std::set<Side> left;
    for(int q = 0; q < quads.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
        if(quads.is_border(q, i))
        {
          const int first = quads.vertices[q][i], last = quads.vertices[q][(i + 1) & 3];
          quads.borders[q][i] = merged(sides_between(result.anchor[first], result.anchor[last]));
          left.emplace(q, i);
        }
    while(!left.empty())
      if(remove_loop(quads, left) < least_sides_of_loop)
        return false;
    return true;
  }

  // the side that starts at a vertex
  static std::set<Side>::iterator side_from(const Quad_grid& quads, std::set<Side>& sides, int v)
  {
    return std::find_if(sides.begin(), sides.end(),
                        [&](const Side& side) { return side_vertex(quads, side) == v; });
  }

  // Removes the sides of a loop, and returns their number.
  static int remove_loop(const Quad_grid& quads, std::set<Side>& left)
  {
    int n = 0;
    int v = side_vertex(quads, *left.begin());
    for(auto side = side_from(quads, left, v); side != left.end();
        side = side_from(quads, left, v))
    {
      v = side_vertex(quads, Side(side->first, side->second + 1));
      left.erase(side);
      ++n;
    }
    return n;
  }

  Quad_grid::Border merged(const std::vector<Side>& sides) const
  {
    Quad_grid::Border result = border(sides.front());
    result.last = border(sides.back()).last;
    if(result.last <= result.first)
      result.last += m_chain_length.at(result.chain);
    return result;
  }

  const Quad_grid& m_quads;
  std::vector<Side> m_border_side;           // per vertex of the boundary: that starts there
  std::vector<Side> m_incoming;              // per vertex of the boundary: that ends there
  std::map<std::size_t, double> m_chain_length;
  std::vector<char> m_is_fixed;              // per vertex: at corners and ends of chains
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_COLLAPSE_H
