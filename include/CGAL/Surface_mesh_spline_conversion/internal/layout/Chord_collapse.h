// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CHORD_COLLAPSE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CHORD_COLLAPSE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

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

// Fewer quads, from a layout some of whose chords have been collapsed. A chord is a strip of quads
// that share opposite sides; the sides between them shrink to a vertex each.
struct Collapsed_quads
{
  Quad_grid quads;
  std::vector<int> original;                // per quad: the one of the layout before, whose sides
                                            // have the same numbers
  std::vector<int> vertex_of;               // per vertex of the layout before
  std::vector<int> anchor;                  // per vertex: at the boundary, the vertex before that
                                            // it lies at
};

// Finds out which chords of a layout can be collapsed such that the topology of the surface, the
// corners, and what the stages after the map need are kept.
class Chord_collapse
{
public:
  typedef Quad_grid::Side Side;

  // the chords through sides 0 and 2, and through sides 1 and 3 of a quad
  typedef std::array<int, 2> Chords_of_quad;

  // `is_corner`: per vertex, not to be moved along the boundary
  Chord_collapse(const Quad_grid& quads, const std::vector<char>& is_corner) : m_quads(quads)
  {
    number_chords();
    find_boundary(is_corner);
  }

  int number_of_chords() const { return m_number_of_chords; }

  const Chords_of_quad& chords(int quad) const { return m_chords[quad]; }

  // The quads that are left when the chords of a set are collapsed; nothing if this is not
  // admissible. Sides that become a vertex have to be a tree, together with quads whose chords are
  // both in the set, that meets the boundary in one piece with at most one corner. At the boundary,
  // as many quads stay at each vertex as before; inside, there are three to eight. Each quad has
  // four vertices. No loop has less than four sides, as those of integer grid maps.
  std::optional<Collapsed_quads> collapse(const std::vector<char>& is_in_set) const
  {
    Collapsed_quads result;
    const std::vector<int> group = vertex_groups(is_in_set);
    if(!are_trees(group, is_in_set) || !make_quads(is_in_set, result)
       || !result.quads.number_vertices() || !place_vertices(group, is_in_set, result)
       || result.quads.euler_characteristic() != m_quads.euler_characteristic()
       || !has_good_quads(result.quads) || !has_good_valences(result)
       || !set_borders(result))
      return std::nullopt;
    return result;
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
  static constexpr int most_quads_at_vertex = 8;
  static constexpr int least_sides_of_loop = 4;

  static int side_vertex(const Quad_grid& quads, const Side& side)
  {
    return quads.vertices[side.first][side.second & 3];
  }

  void number_chords()
  {
    m_chords.assign(m_quads.number_of_quads(), Chords_of_quad{{-1, -1}});
    for(int q = 0; q < m_quads.number_of_quads(); ++q)
      for(int i = 0; i < 2; ++i)
        if(m_chords[q][i] < 0)
        {
          mark_chord(Side(q, i));
          mark_chord(Side(q, i + 2));
          ++m_number_of_chords;
        }
  }

  // from a quad on, across one of its sides
  void mark_chord(Side side)
  {
    bool is_new = true;
    while(is_new)
    {
      m_chords[side.first][side.second % 2] = m_number_of_chords;
      const Side next = m_quads.neighbors[side.first][side.second];
      if(next.first == Quad_grid::border)
        return;
      side = Side(next.first, (next.second + 2) & 3);
      is_new = m_chords[side.first][side.second % 2] < 0;
    }
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

  bool is_collapsed(const Side& side, const std::vector<char>& is_in_set) const
  {
    return is_in_set[m_chords[side.first][side.second % 2]] != 0;
  }

  bool is_left(int quad, const std::vector<char>& is_in_set) const
  {
    return !is_in_set[m_chords[quad][0]] && !is_in_set[m_chords[quad][1]];
  }

  // per vertex: a vertex that is the same for all those that it meets
  std::vector<int> vertex_groups(const std::vector<char>& is_in_set) const
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
    for(int q = 0; q < m_quads.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
        if(is_collapsed(Side(q, i), is_in_set))
          group[root(m_quads.vertices[q][i])] = root(m_quads.vertices[q][(i + 1) & 3]);
    for(std::size_t v = 0; v < group.size(); ++v)
      group[v] = root(static_cast<int>(v));
    return group;
  }

  bool are_trees(const std::vector<int>& group, const std::vector<char>& is_in_set) const
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
      for(int i = 0; i < 4; ++i)
      {
        const Side side(q, i);
        Counts& c = counts[group[m_quads.vertices[q][i]]];
        if(i == 0 && is_in_set[m_chords[q][0]] && is_in_set[m_chords[q][1]])
          ++c.euler_characteristic;
        if(!is_collapsed(side, is_in_set) || (!m_quads.is_border(q, i)
                                              && m_quads.neighbors[q][i] < side))
          continue;
        --c.euler_characteristic;
        c.border_euler_characteristic -= m_quads.is_border(q, i) ? 1 : 0;
      }
    for(std::size_t v = 0; v < group.size(); ++v)
      if(group[v] == static_cast<int>(v)
         && (counts[v].euler_characteristic != 1
             || counts[v].border_euler_characteristic != (counts[v].is_at_border ? 1 : 0)
             || counts[v].fixed > 1))
        return false;
    return true;
  }

  // Links what is left, across strips that collapse.
  bool make_quads(const std::vector<char>& is_in_set, Collapsed_quads& result) const
  {
    std::vector<int> number(m_quads.number_of_quads(), -1);
    for(int q = 0; q < m_quads.number_of_quads(); ++q)
      if(is_left(q, is_in_set))
      {
        number[q] = result.quads.add_quad();
        result.original.push_back(q);
      }
    for(int k = 0; k < result.quads.number_of_quads(); ++k)
      for(int i = 0; i < 4; ++i)
      {
        const Side beyond = beyond_strips(Side(result.original[k], i), number);
        if(beyond.first == Quad_grid::border)
          result.quads.make_border(Side(k, i));
        else
          result.quads.neighbors[k][i] = Side(number[beyond.first], beyond.second);
      }
    return result.quads.number_of_quads() > 0;
  }

  // the side at the other end of the strips that are crossed from the side of a quad that is left
  Side beyond_strips(const Side& side, const std::vector<int>& number) const
  {
    Side next = m_quads.neighbors[side.first][side.second];
    while(next.first != Quad_grid::border && number[next.first] < 0)
      next = m_quads.neighbors[next.first][(next.second + 2) & 3];
    return next;
  }

  // One vertex for each group.
  bool place_vertices(const std::vector<int>& group, const std::vector<char>& is_in_set,
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
        result.anchor[v] = anchor_of(group_of[v], group, is_in_set);
        if(result.anchor[v] < 0)
          return false;
        result.quads.mesh_vertex[v] = m_quads.mesh_vertex[result.anchor[v]];
      }
    return true;
  }

  // of a group: its corner, or else the vertex of the boundary in the middle; -1 if there is none
  int anchor_of(int g, const std::vector<int>& group, const std::vector<char>& is_in_set) const
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
    return first < 0 ? -1 : middle_of(first, is_in_set);
  }

  int next_on_boundary(int v) const
  {
    const Side& side = m_border_side[v];
    return m_quads.vertices[side.first][(side.second + 1) & 3];
  }

  // of the piece of the boundary around a vertex that becomes a vertex
  int middle_of(int v, const std::vector<char>& is_in_set) const
  {
    const auto is_inside = [&](const Side& side) { return is_collapsed(side, is_in_set); };
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

  static bool has_good_quads(const Quad_grid& quads)
  {
    for(int q = 0; q < quads.number_of_quads(); ++q)
    {
      const std::set<int> different(quads.vertices[q].begin(), quads.vertices[q].end());
      if(different.size() < 4)
        return false;
      for(const Side& side : quads.neighbors[q])
        if(side.first == q)
          return false;
    }
    return true;
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
  std::vector<Chords_of_quad> m_chords;      // per quad
  int m_number_of_chords = 0;
  std::vector<Side> m_border_side;           // per vertex of the boundary: that starts there
  std::vector<Side> m_incoming;              // per vertex of the boundary: that ends there
  std::map<std::size_t, double> m_chain_length;
  std::vector<char> m_is_fixed;              // per vertex: at corners and ends of chains
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CHORD_COLLAPSE_H
