// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CREASE_FINDER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CREASE_FINDER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_rectangle.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/blossoms.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// A line from a point of the boundary inwards across which the first derivative jumps, with the
/// cells on its left (0) and right (1). In the coordinates of the crease the line is x = 0, and the
/// boundary is at y = 0; frames take coordinates of quads to these.
struct Crease_line
{
  std::array<std::vector<Placed_cell>, 2> cells;
  std::vector<std::int64_t> breaks; ///< y of the ends of all cells along the line
  bool ends_at_cap = false;         ///< does it run into an extraordinary point, and is cut before?
};

/// Finds the lines above corners of the boundary between two quads (paper, Fig. 6(b)).
class Crease_finder
{
public:
  /// Caps at the end of creases are patches halved so many times: small enough for extraordinary
  /// points that share an edge.
  static constexpr int LEVEL_OF_CAPS = 2;

  /// \param levels how often the patches at extraordinary points are subdivided
  /// \param equality derivatives agree if they do so to it, over the smaller of both widths
  Crease_finder(const Cell_complex& complex, int levels, double equality)
    : m_complex(complex), m_levels(levels), m_equality(equality)
  {}

  /// returns the lines that end inside, where the jump fades out, or at an extraordinary point,
  /// before the cap there. A line that runs to the boundary is left out.
  std::vector<Crease_line> operator()()
  {
    collect_incidences();
    std::vector<Crease_line> result;
    const auto& segments = m_complex.segments();
    for(std::size_t s = 0; s < segments.size(); ++s)
      for(int end = 0; end < 2; ++end)
        if(m_is_boundary[segments[s].vertex[end]] && is_crease(s))
        {
          Crease_line line;
          if(follow(s, end, line))
            result.push_back(line);
        }
    return result;
  }

private:
  void collect_incidences()
  {
    m_is_boundary.assign(m_complex.number_of_vertices(), false);
    m_segments_of_vertex.resize(m_complex.number_of_vertices());
    const auto& segments = m_complex.segments();
    for(std::size_t s = 0; s < segments.size(); ++s)
      for(std::size_t v : segments[s].vertex)
      {
        m_segments_of_vertex[v].push_back(s);
        if(segments[s].sides[1].cell == NO_INDEX)
          m_is_boundary[v] = true;
      }
  }

  // compares position and first derivative on both sides
  bool is_crease(std::size_t s) const
  {
    const Cell_complex::Segment& segment = m_complex.segments()[s];
    if(segment.sides[0].cell == NO_INDEX || segment.sides[1].cell == NO_INDEX)
      return false;
    std::array<Bicubic, 2> grid;
    std::array<double, 2> extent;
    for(int k = 0; k < 2; ++k)
    {
      const auto& side = segment.sides[k];
      const Cell& cell = m_complex.cells()[side.cell];
      grid[k] = rotated(*cell.points, (4 - side.side) & 3);
      extent[k] = double(cell.rectangle.extent((side.side + 1) & 1));
    }
    const double step = (std::min)(extent[0], extent[1]);
    const auto &left = segment.sides[0], &right = segment.sides[1];
    for(int i = 0; i < 4; ++i)
    {
      const Eigen::Vector3d jump
        = blossom(grid[0], bezier_arguments(left.first, left.last, i), {{0, 0, step / extent[0]}})
        - blossom(grid[1], bezier_arguments(right.last, right.first, i),
                  {{0, 0, -step / extent[1]}});
      if(!(jump.norm() <= m_equality))
        return true;
    }
    return false;
  }

  // follows the line from the vertex `end` of segment `s`, which lies on the boundary
  bool follow(std::size_t s, int end, Crease_line& line) const
  {
    line.breaks.push_back(0);
    for(std::size_t next = s; next != NO_INDEX; )
    {
      if(!append(next, end, line))
        return false;
      const std::size_t v = m_complex.segments()[next].vertex[1 - end];
      if(m_is_boundary[v])
        return false;
      std::vector<std::size_t> others;
      for(std::size_t t : m_segments_of_vertex[v])
        if(t != next && is_crease(t))
          others.push_back(t);
      if(others.size() > 1)
        return cut_before_cap(line);
      const std::size_t following = others.empty() ? NO_INDEX : others.front();
      if(following != NO_INDEX)
        end = (m_complex.segments()[following].vertex[0] == v) ? 0 : 1;
      next = following;
    }
    return true;
  }

  // Shortens a line to an extraordinary point by the size of the cap; the last cell has the size of
  // the patch after all subdivisions.
  bool cut_before_cap(Crease_line& line) const
  {
    const std::size_t n = line.breaks.size();
    const std::int64_t smallest = line.breaks[n - 1] - line.breaks[n - 2];
    if(m_levels < LEVEL_OF_CAPS)
      return false;
    const std::int64_t end
      = line.breaks.back() - (smallest << (m_levels - LEVEL_OF_CAPS));
    while(!line.breaks.empty() && line.breaks.back() > end)
      line.breaks.pop_back();
    if(line.breaks.size() < 2 || line.breaks.back() != end)
      return false;
    for(auto& cells : line.cells)
      while(placed_rectangle(m_complex, cells.back()).low[1] >= end)
        cells.pop_back();
    line.ends_at_cap = true;
    return true;
  }

  // appends the cells beside a segment; fails if the line turns
  bool append(std::size_t s, int end, Crease_line& line) const
  {
    std::int64_t last = 0;
    for(int k = 0; k < 2; ++k)
    {
      // seen from the end on the boundary, side `end` of the segment is on the left
      const auto& side = m_complex.segments()[s].sides[k == 0 ? end : 1 - end];
      const Cell& cell = m_complex.cells()[side.cell];
      Placed_cell placed = {side.cell, Tick_frame()};
      placed.frame.turns = ((k == 0 ? 1 : 3) - side.side + 4) & 3;
      const Tick_rectangle r = placed.frame(cell.rectangle);
      const double extent = double(r.extent(1));
      const std::int64_t first = (k == 0)
        ? r.low[1] + std::llround(side.first * extent)
        : r.high[1] - std::llround(side.last * extent);
      placed.frame.shift = {{k == 0 ? -r.high[0] : -r.low[0], line.breaks.back() - first}};
      last = line.breaks.back() + std::llround((side.last - side.first) * extent);
      std::vector<Placed_cell>& cells = line.cells[k];
      if(!cells.empty() && !is_same_or_above(placed, cells.back()))
        return false;
      if(cells.empty() || cells.back().cell != side.cell)
        cells.push_back(placed);
    }
    line.breaks.push_back(last);
    return true;
  }

  bool is_same_or_above(const Placed_cell& placed, const Placed_cell& last) const
  {
    if(placed.cell == last.cell)
      return placed.frame == last.frame;
    for(const auto& use : m_complex.uses(last.cell, cell_side(last, 2)))
      if(m_complex.across(use).cell == placed.cell
         && last.frame.after(m_complex.frame_across_segment(use)) == placed.frame)
        return true;
    return false;
  }

  const Cell_complex& m_complex;
  int m_levels;
  double m_equality;
  std::vector<char> m_is_boundary;
  std::vector<std::vector<std::size_t> > m_segments_of_vertex;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CREASE_FINDER_H
