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

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_rectangle.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/is_smooth_segment.h>

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

/// Grows rectangles of free cells that join with C2 continuity, so that each is one tensor product
/// B-spline. A rectangle grows by whole strips; it may run across layout quads, but never touches
/// itself: kernels then need no seam. As knot lines run through the whole face, a strip of cells of
/// other sizes costs control points: it stays apart if that is more than it would cost as a face of
/// its own.
class Rectangle_grower
{
public:
  /// where a rectangle grows next: on the sides in turn, or where a strip saves most; neither gives
  /// the better partition of all surfaces
  enum class Growth
  {
    IN_TURN,
    BY_SAVING
  };

  /// what a face costs beside its control points, in records of a file of the size of a point: loop,
  /// edges with their ends, and vertices
  static constexpr double POINTS_PER_FACE = 20;

  /// two pieces are C2 if their blossoms agree to `tolerance`
  Rectangle_grower(const Cell_complex& complex, double tolerance)
    : m_complex(complex), m_tolerance(tolerance), m_face_of_cell(complex.cells().size(), NO_INDEX),
      m_strip_of_cell(complex.cells().size(), 0), m_smooth(complex.segments().size(), UNKNOWN)
  {}

  /// the face a cell is in, `NO_INDEX` if it is free
  std::size_t face_of_cell(std::size_t cell) const { return m_face_of_cell[cell]; }

  void set_face_of_cell(std::size_t cell, std::size_t face) { m_face_of_cell[cell] = face; }

  /// may a cell share a face with others?
  bool is_mergeable(std::size_t cell) const
  {
    return m_complex.cells()[cell].cap == NO_INDEX && m_complex.cells()[cell].crease == NO_INDEX;
  }

  /// lets a face grow from a free cell; its cells then are in face `index`
  Cell_rectangle grown(std::size_t seed, std::size_t index, Growth growth)
  {
    m_face_of_cell[seed] = index;
    Block face = block({{{seed, Tick_frame()}}, m_complex.cells()[seed].rectangle});
    for(int next = 0;;)
    {
      Block best;
      int best_side = -1;
      double best_saving = 0;
      for(int i = 0; i < 4 && (best_side < 0 || growth == Growth::BY_SAVING); ++i)
      {
        const int side = (next + i) & 3;
        Block strip;
        if(!find_strip(face, index, side, strip))
          continue;
        const double s = saving(face, strip, side);
        if(s < best_saving || (s == best_saving && best_side >= 0))
          continue;
        best = std::move(strip);
        best_side = side;
        best_saving = s;
      }
      if(best_side < 0)
        return std::move(face.cells);
      for(const Placed_cell& placed : best.cells.cells)
        m_face_of_cell[placed.cell] = index;
      join(face, best, best_side);
      next = (best_side + 1) & 3;
    }
  }

private:
  enum Smoothness : char { UNKNOWN, YES, NO };

  // how often the width of a strip is enlarged to a cell that reaches further
  static constexpr int MAXIMUM_NUMBER_OF_ENLARGEMENTS = 4;

  // a rectangle of cells with what is needed to join it with another
  struct Block
  {
    Cell_rectangle cells;
    std::array<std::vector<std::int64_t>, 2> breaks;
    std::array<std::vector<Placed_cell>, 4> rim; // the cells along each side

    // of the B-spline, whose knots are simple inside
    double number_of_points() const { return double(breaks[0].size() + 2) * (breaks[1].size() + 2); }
  };

  Block block(Cell_rectangle cells) const
  {
    Block result;
    for(int axis = 0; axis < 2; ++axis)
      result.breaks[axis] = breakpoints(m_complex, cells, axis);
    for(const Placed_cell& placed : cells.cells)
      for(int side = 0; side < 4; ++side)
        if(side_level(image(placed), side) == side_level(cells.bounds, side))
          result.rim[side].push_back(placed);
    result.cells = std::move(cells);
    return result;
  }

  static std::vector<std::int64_t> united(const std::vector<std::int64_t>& a,
                                          const std::vector<std::int64_t>& b)
  {
    std::vector<std::int64_t> result;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
  }

  // the points of a face and of a strip along a side of it, each with its own copy of their common
  // edge, less those of one face for both
  static double saving(const Block& face, const Block& strip, int side)
  {
    double joined = 1;
    for(int axis = 0; axis < 2; ++axis)
      joined *= double(united(face.breaks[axis], strip.breaks[axis]).size() + 2);
    return face.number_of_points() + strip.number_of_points()
         + double(strip.breaks[side & 1].size() + 2) + POINTS_PER_FACE - joined;
  }

  static void join(Block& face, const Block& strip, int side)
  {
    auto append = [](const std::vector<Placed_cell>& from, std::vector<Placed_cell>& to)
    { to.insert(to.end(), from.begin(), from.end()); };
    append(strip.cells.cells, face.cells.cells);
    for(int axis = 0; axis < 2; ++axis)
    {
      face.breaks[axis] = united(face.breaks[axis], strip.breaks[axis]);
      Tick_rectangle& bounds = face.cells.bounds;
      bounds.low[axis] = (std::min)(bounds.low[axis], strip.cells.bounds.low[axis]);
      bounds.high[axis] = (std::max)(bounds.high[axis], strip.cells.bounds.high[axis]);
    }
    face.rim[side] = strip.rim[side];
    append(strip.rim[(side + 1) & 3], face.rim[(side + 1) & 3]);
    append(strip.rim[(side + 3) & 3], face.rim[(side + 3) & 3]);
  }

  Tick_rectangle image(const Placed_cell& placed) const
  {
    return placed_rectangle(m_complex, placed);
  }

  Placed_cell placed_across(const Placed_cell& placed, const Cell_complex::Segment_use& use) const
  {
    return {m_complex.across(use).cell, placed.frame.after(m_complex.frame_across_segment(use))};
  }

  bool is_smooth(std::size_t segment)
  {
    if(m_smooth[segment] == UNKNOWN)
      m_smooth[segment] = is_smooth_segment(m_complex, segment, m_tolerance) ? YES : NO;
    return m_smooth[segment] == YES;
  }

  // finds a strip of cells along a side of the face, with which it does not touch itself
  bool find_strip(const Block& face, std::size_t index, int side, Block& result)
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
      const std::int64_t required = fill_strip(face.cells, side, width, first, strip);
      if(required < 0)
        return false;
      if(required == width)
      {
        result = block({std::move(strip), strip_bounds(face.cells.bounds, side, width)});
        return !touches_itself(face, result, index, side);
      }
      width = required;
    }
    return false;
  }

  bool is_free(std::size_t cell) const
  {
    return cell != NO_INDEX && m_face_of_cell[cell] == NO_INDEX && is_mergeable(cell);
  }

  bool first_layer(const Block& face, int side, std::vector<Placed_cell>& first)
  {
    for(const Placed_cell& placed : face.rim[side])
      for(const auto& use : m_complex.uses(placed.cell, cell_side(placed, side)))
      {
        if(!is_free(m_complex.across(use).cell) || !is_smooth(use.segment))
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
        if(!is_free(m_complex.across(use).cell) || !is_smooth(use.segment))
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

  // would the outline of both pass a vertex twice, or run along cells of the face itself?
  bool touches_itself(const Block& face, const Block& strip, std::size_t index, int side) const
  {
    std::vector<std::size_t> vertices;
    for(int s = 0; s < 4; ++s)
      for(const Block* part : {&face, &strip})
      {
        if(s == (part == &face ? side : (side + 2) & 3)) // the common edge
          continue;
        for(const Placed_cell& placed : part->rim[s])
          for(const auto& use : m_complex.uses(placed.cell, cell_side(placed, s)))
          {
            const std::size_t other = m_complex.across(use).cell;
            if(other != NO_INDEX
               && (m_face_of_cell[other] == index || m_strip_of_cell[other] == m_strip))
              return true;
            vertices.push_back(m_complex.source(use));
          }
      }
    std::sort(vertices.begin(), vertices.end());
    return std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end();
  }

  const Cell_complex& m_complex;
  double m_tolerance;
  std::vector<std::size_t> m_face_of_cell;
  std::vector<std::size_t> m_strip_of_cell; // the last strip a cell was taken into
  std::size_t m_strip = 0;
  std::vector<Smoothness> m_smooth;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_RECTANGLE_GROWER_H
