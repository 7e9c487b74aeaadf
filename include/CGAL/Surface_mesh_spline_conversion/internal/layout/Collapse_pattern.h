// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_COLLAPSE_PATTERN_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_COLLAPSE_PATTERN_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>

#include <array>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A collapse of a chord, a strip of quads that share opposite sides: the sides between them shrink
// to a vertex each. Or of a diagonal: two opposite vertices of a quad meet, and its sides become
// one at each of the others.
struct Collapse_step
{
  enum class Kind { CHORD, DIAGONAL };

  Kind kind;
  int quad;   // one of those that are left by the steps before
  int number; // the chord goes through the sides with this number, 0 or 1, and two more; the
              // vertices with this number and two more meet
};

// What becomes of the quads of a layout in a sequence of such steps. Lines between the middles of
// the sides that are left cross the quads that are not.
class Collapse_pattern
{
public:
  typedef Quad_grid::Side Side;

  explicit Collapse_pattern(const Quad_grid& quads)
    : m_quads(&quads), m_states(quads.number_of_quads())
  {}

  bool is_left(int quad) const { return m_states[quad].is_left; }

  // Has a side become a vertex?
  bool is_shrunk(const Side& side) const
  {
    return m_states[side.first].is_shrunk[side.second];
  }

  // of a quad, the number of the first of two opposite vertices that have met across it, or -1
  int diagonal(int quad) const { return m_states[quad].diagonal; }

  // The side at the other end of the strips that are crossed from the side of a quad that is left.
  // `cross(side, other)` is called for the sides of each quad that is crossed.
  template <typename Cross>
  Side beyond(const Side& side, const Cross& cross) const
  {
    Side next = m_quads->neighbors[side.first][side.second];
    while(next.first != Quad_grid::border && !is_left(next.first))
    {
      const Side other(next.first, m_states[next.first].across[next.second]);
      cross(next, other);
      next = m_quads->neighbors[other.first][other.second];
    }
    return next;
  }

  // the quads that a chord crosses, and numbers of sides of them, 0 or 1
  std::set<Side> chord(int quad, int number) const
  {
    std::set<Side> crossed;
    const auto none = [](const Side&, const Side&) {};
    for(const int first : {number, number + 2})
      for(Side side(quad, first); side.first != Quad_grid::border;)
      {
        const bool is_new = crossed.emplace(side.first, side.second % 2).second;
        if(!is_new && side != Side(quad, number + 2))
          break;
        side = beyond(side, none);
        side.second = (side.second + 2) & 3;
      }
    return crossed;
  }

  void apply(const Collapse_step& step)
  {
    if(step.kind == Collapse_step::Kind::CHORD)
      collapse_chord(chord(step.quad, step.number));
    else
      collapse_diagonal(step.quad, step.number);
  }

private:
  struct State
  {
    bool is_left = true;
    std::array<bool, 4> is_shrunk = {{false, false, false, false}};
    std::array<int, 4> across = {{-1, -1, -1, -1}}; // per side: where the line from it ends, or -1
    int diagonal = -1;
  };

  void collapse_chord(const std::set<Side>& crossed)
  {
    std::vector<Side> shrunk;
    for(const Side& c : crossed)
      for(const int i : {c.second, c.second + 2})
      {
        shrunk.emplace_back(c.first, i);
        beyond(shrunk.back(), [&](const Side& side, const Side& other)
        {
          shrunk.push_back(side);
          shrunk.push_back(other);
        });
      }
    for(const Side& side : shrunk)
    {
      m_states[side.first].is_shrunk[side.second] = true;
      m_states[side.first].across[side.second] = -1;
    }
    for(const Side& c : crossed)
    {
      m_states[c.first].is_left = false;
      if(crossed.count(Side(c.first, 1 - c.second)) == 0)
        join(c.first, c.second + 1, (c.second + 3) & 3);
    }
  }

  void collapse_diagonal(int quad, int number)
  {
    m_states[quad].is_left = false;
    m_states[quad].diagonal = number;
    join(quad, number, number + 1);
    join(quad, number + 2, (number + 3) & 3);
  }

  void join(int quad, int i, int j)
  {
    m_states[quad].across[i] = j;
    m_states[quad].across[j] = i;
  }

  const Quad_grid* m_quads;
  std::vector<State> m_states; // per quad
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_COLLAPSE_PATTERN_H
