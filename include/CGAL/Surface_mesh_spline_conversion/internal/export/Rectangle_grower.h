// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_RECTANGLE_GROWER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_RECTANGLE_GROWER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_block.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_rectangle.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/is_smooth_segment.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Grows rectangles of free cells that join with C2 continuity, so that each is one tensor product
/// B-spline. A rectangle grows by whole strips; it may run across layout quads, but never touches
/// itself: kernels then need no seam. As knot lines run through the whole face, a strip of cells of
/// other sizes costs control points: it stays apart if that is more than it would cost as a face of
/// its own.
class Rectangle_grower
{
public:
  Rectangle_grower(const Cell_complex& complex, Smooth_segments& is_smooth)
    : m_complex(complex), m_is_smooth(is_smooth), m_face_of_cell(complex.cells().size(), NO_INDEX),
      m_strip_of_cell(complex.cells().size(), 0), m_outline_check(complex)
  {}

  /// may a face grow from a cell, or over it?
  bool is_free(std::size_t cell) const
  {
    return cell != NO_INDEX && m_face_of_cell[cell] == NO_INDEX
        && is_mergeable(m_complex.cells()[cell]);
  }

  /// lets a face grow from a free cell on its sides in turn; its cells then are in face `index`
  Cell_rectangle grown(std::size_t seed, std::size_t index)
  {
    m_face_of_cell[seed] = index;
    Cell_block face
      = cell_block(m_complex, {{{seed, Tick_frame()}}, m_complex.cells()[seed].rectangle});
    for(int side = 0, failures = 0; failures < 4; side = (side + 1) & 3)
    {
      Cell_block strip;
      if(!find_strip(face, index, side, strip) || saving(face, strip, side) < 0)
      {
        ++failures;
        continue;
      }
      failures = 0;
      for(const Placed_cell& placed : strip.rectangle.cells)
        m_face_of_cell[placed.cell] = index;
      join(face, strip, side);
    }
    return std::move(face.rectangle);
  }

private:
  // what a face costs beside its control points, in records of a file of the size of a point: loop,
  // edges with their ends, and vertices
  static constexpr double POINTS_PER_FACE = 20;

  // how often the width of a strip is enlarged to a cell that reaches further
  static constexpr int MAXIMUM_NUMBER_OF_ENLARGEMENTS = 4;

  // of the B-spline, whose knots are simple inside
  static double number_of_points(const Cell_block& block)
  {
    return double(block.breaks[0].size() + 2) * double(block.breaks[1].size() + 2);
  }

  // the points of a face and of a strip along a side of it, each with its own copy of their common
  // edge, less those of one face for both
  static double saving(const Cell_block& face, const Cell_block& strip, int side)
  {
    double joined = 1;
    for(int axis = 0; axis < 2; ++axis)
      joined *= double(united(face.breaks[axis], strip.breaks[axis]).size() + 2);
    return number_of_points(face) + number_of_points(strip)
         + double(strip.breaks[side & 1].size() + 2) + POINTS_PER_FACE - joined;
  }

  Tick_rectangle image(const Placed_cell& placed) const
  {
    return placed_rectangle(m_complex, placed);
  }

  Placed_cell placed_across(const Placed_cell& placed, const Cell_complex::Segment_use& use) const
  {
    return {m_complex.across(use).cell, placed.frame.after(m_complex.frame_across_segment(use))};
  }

  // finds a strip of cells along a side of the face, with which it does not touch itself
  bool find_strip(const Cell_block& face, std::size_t index, int side, Cell_block& result)
  {
    std::vector<Placed_cell> first;
    if(!first_layer(face, side, first))
      return false;
    std::int64_t width = 0;
    for(const Placed_cell& placed : first)
      width = (std::max)(width, image(placed).extent((side + 1) & 1));
    for(int i = 0; i < MAXIMUM_NUMBER_OF_ENLARGEMENTS; ++i)
    {
      std::vector<Placed_cell> strip;
      const std::int64_t required = fill_strip(face.rectangle, side, width, first, strip);
      if(required < 0)
        return false;
      if(required == width)
      {
        result = cell_block(
          m_complex, {std::move(strip), strip_bounds(face.rectangle.bounds, side, width)});
        return !touches_itself(face, result, index, side);
      }
      width = required;
    }
    return false;
  }

  bool first_layer(const Cell_block& face, int side, std::vector<Placed_cell>& first)
  {
    for(const Placed_cell& placed : face.rim[side])
      for(const auto& use : m_complex.uses(placed.cell, cell_side(placed, side)))
      {
        if(!is_free(m_complex.across(use).cell) || !m_is_smooth(use.segment))
          return false;
        first.push_back(placed_across(placed, use));
      }
    return true;
  }

  static Tick_rectangle strip_bounds(const Tick_rectangle& bounds, int side, std::int64_t width)
  {
    Tick_rectangle r = bounds;
    const int axis = (side + 1) & 1;
    if(side == 1 || side == 2)
    {
      r.low[axis] = bounds.high[axis];
      r.high[axis] = bounds.high[axis] + width;
    }
    else
    {
      r.high[axis] = bounds.low[axis];
      r.low[axis] = bounds.low[axis] - width;
    }
    return r;
  }

  // Collects the cells that fill the strip. Returns the width it needs for cells that reach beyond
  // it, the given width if it is filled, -1 if it cannot be filled.
  std::int64_t fill_strip(const Cell_rectangle& face, int side, std::int64_t width,
                          const std::vector<Placed_cell>& first, std::vector<Placed_cell>& strip)
  {
    const Tick_rectangle bounds = strip_bounds(face.bounds, side, width);
    ++m_strip;
    for(const Placed_cell& placed : first)
      add_to_strip(placed, strip);
    double covered = 0;
    for(std::size_t i = 0; i < strip.size(); ++i)
    {
      const Placed_cell placed = strip[i];
      const Tick_rectangle r = image(placed);
      const int axis = (side + 1) & 1;
      if(r.low[1 - axis] < bounds.low[1 - axis] || r.high[1 - axis] > bounds.high[1 - axis])
        return -1;
      if(r.low[axis] < bounds.low[axis] || r.high[axis] > bounds.high[axis])
        return required_width(face.bounds, r, side);
      covered += area(r);
      if(!add_neighbors(bounds, placed, strip))
        return -1;
    }
    return (covered == area(bounds)) ? width : -1;
  }

  static std::int64_t required_width(const Tick_rectangle& face, const Tick_rectangle& r, int side)
  {
    return (side == 1 || side == 2) ? side_level(r, side) - side_level(face, side)
                                    : side_level(face, side) - side_level(r, side);
  }

  void add_to_strip(const Placed_cell& placed, std::vector<Placed_cell>& strip)
  {
    if(m_strip_of_cell[placed.cell] == m_strip)
      return;
    m_strip_of_cell[placed.cell] = m_strip;
    strip.push_back(placed);
  }

  // adds the neighbours across those segments of the cell that lie inside the strip
  bool add_neighbors(const Tick_rectangle& bounds, const Placed_cell& placed,
                     std::vector<Placed_cell>& strip)
  {
    for(int s = 0; s < 4; ++s)
    {
      if(side_level(image(placed), face_side(placed, s)) == side_level(bounds, face_side(placed, s)))
        continue;
      for(const auto& use : m_complex.uses(placed.cell, s))
      {
        if(!is_free(m_complex.across(use).cell) || !m_is_smooth(use.segment))
          return false;
        const Placed_cell next = placed_across(placed, use);
        if(m_strip_of_cell[next.cell] == m_strip && !is_placed_as(next, strip))
          return false;
        add_to_strip(next, strip);
      }
    }
    return true;
  }

  static bool is_placed_as(const Placed_cell& placed, const std::vector<Placed_cell>& strip)
  {
    for(const Placed_cell& other : strip)
      if(other.cell == placed.cell)
        return other.frame == placed.frame;
    return false;
  }

  bool touches_itself(const Cell_block& face, const Cell_block& strip, std::size_t index, int side)
  {
    return m_outline_check.touches_itself(
      face, side, strip, (side + 2) & 3, [this, index](std::size_t cell)
    { return m_face_of_cell[cell] == index || m_strip_of_cell[cell] == m_strip; });
  }

  const Cell_complex& m_complex;
  Smooth_segments& m_is_smooth;
  std::vector<std::size_t> m_face_of_cell;
  std::vector<std::size_t> m_strip_of_cell; // the last strip a cell was taken into
  std::size_t m_strip = 0;
  Outline_check m_outline_check;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_RECTANGLE_GROWER_H
