// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_MERGER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_MERGER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/blossoms.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// a cell in the plane of a face; the frame takes coordinates of its quad to those of the face
struct Placed_cell
{
  std::size_t cell;
  Tick_frame frame;
};

/// the cells of a face, which fill a rectangle
struct Cell_rectangle
{
  std::vector<Placed_cell> cells;
  Tick_rectangle bounds;
};

/// Greedy partition of a cell complex into rectangles of cells that join with C2 continuity, so that
/// each is one tensor product B-spline. A rectangle grows by whole strips; it may run across layout
/// quads, but never touches itself: kernels then need no seam.
class Cell_merger
{
public:
  /// how many spans a face may have for each of its cells, as knot lines run through the whole face
  static constexpr std::size_t SPANS_PER_CELL = 2;

  /// how often the width of a strip is enlarged to a cell that reaches further
  static constexpr int MAXIMUM_NUMBER_OF_ENLARGEMENTS = 4;

  /// two pieces are C2 if their blossoms agree to `tolerance`
  Cell_merger(const Cell_complex& complex, double tolerance)
    : m_complex(complex), m_tolerance(tolerance), m_face_of_cell(complex.cells().size(), NO_INDEX),
      m_strip_of_cell(complex.cells().size(), 0), m_smooth(complex.segments().size(), UNKNOWN)
  {}

  /// returns the rectangles; without `do_merge`, each cell is one, but beside creases
  std::vector<Cell_rectangle> operator()(bool do_merge)
  {
    std::vector<Cell_rectangle> faces;
    for(std::size_t seed : seeds())
    {
      if(m_face_of_cell[seed] != NO_INDEX || m_complex.cells()[seed].crease != NO_INDEX)
        continue;
      m_face_of_cell[seed] = faces.size();
      faces.push_back(single_cell(seed));
      if(do_merge && m_complex.cells()[seed].cap == NO_INDEX)
        grow(faces.back(), faces.size() - 1);
    }
    append_crease_faces(faces);
    return faces;
  }

  /// the rectangle of a cell in the coordinates of its face
  static Tick_rectangle image(const Cell_complex& complex, const Placed_cell& placed)
  {
    return placed.frame(complex.cells()[placed.cell].rectangle);
  }

  /// the side of the cell that corresponds to a side of the face
  static int cell_side(const Placed_cell& placed, int face_side)
  {
    return (face_side - placed.frame.turns + 4) & 3;
  }

  /// the coordinate that is constant along a side
  static std::int64_t level(const Tick_rectangle& r, int side)
  {
    return (side == 1) ? r.high[0] : (side == 2) ? r.high[1] : (side == 3) ? r.low[0] : r.low[1];
  }

  /// the coordinates of all cell sides of a face along an axis
  std::vector<std::int64_t> breakpoints(const Cell_rectangle& face, int axis) const
  {
    std::vector<std::int64_t> result;
    for(const Placed_cell& placed : face.cells)
    {
      const Tick_rectangle r = image(placed);
      result.push_back(r.low[axis]);
      result.push_back(r.high[axis]);
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  /// returns `true` if the pieces on both sides of a segment join with C2 continuity
  bool is_smooth(std::size_t segment)
  {
    if(m_smooth[segment] == UNKNOWN)
      m_smooth[segment] = compute_smoothness(m_complex.segments()[segment]) ? YES : NO;
    return m_smooth[segment] == YES;
  }

private:
  enum Smoothness : char { UNKNOWN, YES, NO };

  // large cells first, so that small ones do not cut them up
  std::vector<std::size_t> seeds() const
  {
    const std::vector<Cell>& cells = m_complex.cells();
    std::vector<std::size_t> order(cells.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&cells](std::size_t a, std::size_t b)
                     { return area(cells[a].rectangle) > area(cells[b].rectangle); });
    return order;
  }

  static double area(const Tick_rectangle& r) { return double(r.extent(0)) * double(r.extent(1)); }

  Cell_rectangle single_cell(std::size_t cell) const
  {
    return {{{cell, Tick_frame()}}, m_complex.cells()[cell].rectangle};
  }

  // the cells on one side of a crease make one face
  void append_crease_faces(std::vector<Cell_rectangle>& faces)
  {
    std::map<std::pair<std::size_t, std::size_t>, Cell_rectangle> by_side;
    for(std::size_t c = 0; c < m_complex.cells().size(); ++c)
    {
      const Cell& cell = m_complex.cells()[c];
      if(cell.crease == NO_INDEX)
        continue;
      Cell_rectangle& face = by_side[{cell.crease, cell.sector}];
      const Tick_rectangle r = cell.frame(cell.rectangle);
      if(face.cells.empty())
        face.bounds = r;
      for(int axis = 0; axis < 2; ++axis)
      {
        face.bounds.low[axis] = (std::min)(face.bounds.low[axis], r.low[axis]);
        face.bounds.high[axis] = (std::max)(face.bounds.high[axis], r.high[axis]);
      }
      face.cells.push_back({c, cell.frame});
    }
    for(auto& entry : by_side)
    {
      Cell_rectangle& face = entry.second;
      std::sort(face.cells.begin(), face.cells.end(),
                [this](const Placed_cell& a, const Placed_cell& b)
      { // the cell at the smallest parameters first
        const Tick_point p = image(a).low, q = image(b).low;
        return p[1] < q[1] || (p[1] == q[1] && p[0] < q[0]);
      });
      for(const Placed_cell& placed : face.cells)
        m_face_of_cell[placed.cell] = faces.size();
      faces.push_back(face);
    }
  }

  Tick_rectangle image(const Placed_cell& placed) const { return image(m_complex, placed); }

  // the side of the face that corresponds to a side of the cell
  static int face_side(const Placed_cell& placed, int cell_side)
  {
    return (cell_side + placed.frame.turns) & 3;
  }

  Placed_cell placed_across(const Placed_cell& placed, const Cell_complex::Segment_use& use) const
  {
    return {m_complex.across(use).cell, placed.frame.after(m_complex.frame_across_segment(use))};
  }

  void grow(Cell_rectangle& face, std::size_t index)
  {
    for(int side = 0, failures = 0; failures < 4; side = (side + 1) & 3)
      failures = extend(face, index, side) ? 0 : failures + 1;
  }

  // adds a strip of cells along a side of the face, if there is one
  bool extend(Cell_rectangle& face, std::size_t index, int side)
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
      const std::int64_t required = fill_strip(face, side, width, first, strip);
      if(required < 0)
        return false;
      if(required == width)
        return accept(face, index, side, width, strip);
      width = required;
    }
    return false;
  }

  bool is_free(std::size_t cell) const
  {
    return cell != NO_INDEX && m_face_of_cell[cell] == NO_INDEX
        && m_complex.cells()[cell].cap == NO_INDEX
        && m_complex.cells()[cell].crease == NO_INDEX;
  }

  bool first_layer(const Cell_rectangle& face, int side, std::vector<Placed_cell>& first)
  {
    for(const Placed_cell& placed : face.cells)
    {
      if(level(image(placed), side) != level(face.bounds, side))
        continue;
      for(const auto& use : m_complex.uses(placed.cell, cell_side(placed, side)))
      {
        if(!is_free(m_complex.across(use).cell) || !is_smooth(use.segment))
          return false;
        first.push_back(placed_across(placed, use));
      }
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
    return (side == 1 || side == 2) ? level(r, side) - level(face, side)
                                    : level(face, side) - level(r, side);
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
      if(level(image(placed), face_side(placed, s)) == level(bounds, face_side(placed, s)))
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

  bool accept(Cell_rectangle& face, std::size_t index, int side, std::int64_t width,
              const std::vector<Placed_cell>& strip)
  {
    Cell_rectangle grown = face;
    grown.cells.insert(grown.cells.end(), strip.begin(), strip.end());
    const Tick_rectangle added = strip_bounds(face.bounds, side, width);
    for(int axis = 0; axis < 2; ++axis)
    {
      grown.bounds.low[axis] = (std::min)(face.bounds.low[axis], added.low[axis]);
      grown.bounds.high[axis] = (std::max)(face.bounds.high[axis], added.high[axis]);
    }
    const std::size_t spans
      = (breakpoints(grown, 0).size() - 1) * (breakpoints(grown, 1).size() - 1);
    if(spans > SPANS_PER_CELL * grown.cells.size() || touches_itself(grown, index))
      return false;
    for(const Placed_cell& placed : strip)
      m_face_of_cell[placed.cell] = index;
    face = std::move(grown);
    return true;
  }

  // does the outline pass a vertex twice, or run along cells of the face itself?
  bool touches_itself(const Cell_rectangle& face, std::size_t index) const
  {
    std::vector<std::size_t> vertices;
    for(const Placed_cell& placed : face.cells)
      for(int side = 0; side < 4; ++side)
      {
        if(level(image(placed), side) != level(face.bounds, side))
          continue;
        for(const auto& use : m_complex.uses(placed.cell, cell_side(placed, side)))
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

  // compares the first three rows of blossoms across the segment, taken over the smaller width
  bool compute_smoothness(const Cell_complex::Segment& segment) const
  {
    std::array<Bicubic, 2> grid;
    std::array<double, 2> extent;
    for(int k = 0; k < 2; ++k)
    {
      const auto& side = segment.sides[k];
      if(side.cell == NO_INDEX || m_complex.cells()[side.cell].cap != NO_INDEX)
        return false;
      const Cell& cell = m_complex.cells()[side.cell];
      grid[k] = rotated(cell.points, (4 - side.side) & 3);
      extent[k] = double(cell.rectangle.extent((side.side + 1) & 1));
    }
    const double step = (std::min)(extent[0], extent[1]);
    const double inside = step / extent[0], outside = -step / extent[1];
    const auto &left = segment.sides[0], &right = segment.sides[1];
    for(int row = 0; row < 3; ++row)
      for(int i = 0; i < 4; ++i)
      {
        const Eigen::Vector3d difference
          = blossom(grid[0], bezier_arguments(left.first, left.last, i),
                    bezier_arguments(0, inside, row))
          - blossom(grid[1], bezier_arguments(right.last, right.first, i),
                    bezier_arguments(0, outside, row));
        if(!(difference.norm() <= m_tolerance))
          return false;
      }
    return true;
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

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_MERGER_H
