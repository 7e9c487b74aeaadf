// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_BLOCK_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_BLOCK_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_rectangle.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// a rectangle of cells with what is needed to join it with another
struct Cell_block
{
  Cell_rectangle rectangle;
  std::array<std::vector<std::int64_t>, 2> breaks; ///< coordinates of cell sides, by axis
  std::array<std::vector<Placed_cell>, 4> rim;     ///< the cells along each side
};

inline Cell_block cell_block(const Cell_complex& complex, Cell_rectangle cells)
{
  Cell_block result;
  for(int axis = 0; axis < 2; ++axis)
    result.breaks[axis] = breakpoints(complex, cells, axis);
  for(const Placed_cell& placed : cells.cells)
    for(int side = 0; side < 4; ++side)
      if(side_level(placed_rectangle(complex, placed), side) == side_level(cells.bounds, side))
        result.rim[side].push_back(placed);
  result.rectangle = std::move(cells);
  return result;
}

inline std::vector<std::int64_t> united(const std::vector<std::int64_t>& a,
                                        const std::vector<std::int64_t>& b)
{
  std::vector<std::int64_t> result;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

/// the breaks along an axis after a motion
inline std::vector<std::int64_t> placed_breaks(const Cell_block& block, const Tick_frame& frame,
                                               int axis)
{
  const int from = (frame.turns & 1) ? 1 - axis : axis;
  std::vector<std::int64_t> result;
  for(std::int64_t t : block.breaks[from])
    result.push_back(frame(Tick_point{{from == 0 ? t : 0, from == 1 ? t : 0}})[axis]);
  if(result.front() > result.back())
    std::reverse(result.begin(), result.end());
  return result;
}

/// a block after a motion
inline Cell_block placed_block(const Cell_block& block, const Tick_frame& frame)
{
  auto place = [&frame](std::vector<Placed_cell> cells)
  {
    for(Placed_cell& placed : cells)
      placed.frame = frame.after(placed.frame);
    return cells;
  };
  Cell_block result;
  result.rectangle = {place(block.rectangle.cells), frame(block.rectangle.bounds)};
  for(int axis = 0; axis < 2; ++axis)
    result.breaks[axis] = placed_breaks(block, frame, axis);
  for(int side = 0; side < 4; ++side)
    result.rim[(side + frame.turns) & 3] = place(block.rim[side]);
  return result;
}

/// appends a block in the same plane that lies along a side of the first
inline void join(Cell_block& block, const Cell_block& strip, int side)
{
  auto append = [](const std::vector<Placed_cell>& from, std::vector<Placed_cell>& to)
  { to.insert(to.end(), from.begin(), from.end()); };
  append(strip.rectangle.cells, block.rectangle.cells);
  for(int axis = 0; axis < 2; ++axis)
  {
    block.breaks[axis] = united(block.breaks[axis], strip.breaks[axis]);
    Tick_rectangle& bounds = block.rectangle.bounds;
    bounds.low[axis] = (std::min)(bounds.low[axis], strip.rectangle.bounds.low[axis]);
    bounds.high[axis] = (std::max)(bounds.high[axis], strip.rectangle.bounds.high[axis]);
  }
  block.rim[side] = strip.rim[side];
  append(strip.rim[(side + 1) & 3], block.rim[(side + 1) & 3]);
  append(strip.rim[(side + 3) & 3], block.rim[(side + 3) & 3]);
}

/// Tells whether the outline of two blocks with a common side touches itself.
class Outline_check
{
public:
  explicit Outline_check(const Cell_complex& complex)
    : m_complex(complex), m_visit_of_vertex(complex.number_of_vertices(), 0)
  {}

  /// would the outline of both pass a vertex twice, or run along cells of the blocks themselves?
  /// \param side the common side as numbered in the first block
  /// \param strip_side the same in the second
  template <typename IsInside>
  bool touches_itself(const Cell_block& block, int side, const Cell_block& strip, int strip_side,
                      const IsInside& is_inside)
  {
    ++m_visit;
    return !visit(block, side, is_inside) || !visit(strip, strip_side, is_inside);
  }

private:
  // passes along all sides but one
  template <typename IsInside>
  bool visit(const Cell_block& block, int common_side, const IsInside& is_inside)
  {
    for(int side = 0; side < 4; ++side)
    {
      if(side == common_side)
        continue;
      for(const Placed_cell& placed : block.rim[side])
        for(const auto& use : m_complex.uses(placed.cell, cell_side(placed, side)))
        {
          const std::size_t other = m_complex.across(use).cell;
          std::size_t& visit = m_visit_of_vertex[m_complex.source(use)];
          if(visit == m_visit || (other != NO_INDEX && is_inside(other)))
            return false;
          visit = m_visit;
        }
    }
    return true;
  }

  const Cell_complex& m_complex;
  std::vector<std::size_t> m_visit_of_vertex; // the last outline a vertex was on
  std::size_t m_visit = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_BLOCK_H
