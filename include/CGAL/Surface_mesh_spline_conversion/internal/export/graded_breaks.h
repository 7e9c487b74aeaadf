// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_GRADED_BREAKS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_GRADED_BREAKS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_rectangle.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// the knots of a face, by axis
typedef std::array<std::vector<std::int64_t>, 2> Face_breaks;

/// the fewest knots of faces: the coordinates of their cell sides
inline std::vector<Face_breaks> cell_breaks(const Cell_complex& complex,
                                            const std::vector<Cell_rectangle>& faces)
{
  std::vector<Face_breaks> result;
  for(const Cell_rectangle& face : faces)
    result.push_back({{breakpoints(complex, face, 0), breakpoints(complex, face, 1)}});
  return result;
}

/// Halves long knot intervals of faces beside short ones of other faces. Programs that look for the
/// closest point of a shell start from samples in each interval; where those on one side of an edge
/// are much denser, they never get to the face on the other side.
class Break_grading
{
public:
  Break_grading(const Cell_complex& complex, const std::vector<Cell_rectangle>& faces)
    : m_complex(complex), m_breaks(cell_breaks(complex, faces)),
      m_face_of_cell(complex.cells().size(), NO_INDEX), m_frame_of_cell(complex.cells().size())
  {
    for(std::size_t f = 0; f < faces.size(); ++f)
      for(const Placed_cell& placed : faces[f].cells)
      {
        m_face_of_cell[placed.cell] = f;
        m_frame_of_cell[placed.cell] = placed.frame;
      }
  }

  /// returns the knots of the faces
  std::vector<Face_breaks> operator()()
  {
    const std::vector<std::array<Border, 2> > borders = find_borders();
    for(bool has_changed = true; has_changed; )
    {
      has_changed = false;
      for(const std::array<Border, 2>& sides : borders)
        for(int i = 0; i < 2; ++i)
          has_changed = halve_long_intervals(sides[i], sides[1 - i]) || has_changed;
    }
    return std::move(m_breaks);
  }

private:
  // of the lengths of knot intervals on both sides of an edge
  static constexpr std::int64_t LARGEST_RATIO = 4;

  // a part of a side of a face
  struct Border
  {
    std::size_t face;
    int axis; // along the side
    std::int64_t low, high;
  };

  typedef std::vector<std::int64_t>::const_iterator Break_iterator;

  // the segments between different faces, seen from both; those beside creases keep their knots
  std::vector<std::array<Border, 2> > find_borders() const
  {
    std::vector<std::array<Border, 2> > result;
    for(const Cell_complex::Segment& segment : m_complex.segments())
    {
      const auto& sides = segment.sides;
      if(can_grade(sides[0].cell) && can_grade(sides[1].cell)
         && m_face_of_cell[sides[0].cell] != m_face_of_cell[sides[1].cell])
        result.push_back({{border(sides[0]), border(sides[1])}});
    }
    return result;
  }

  bool can_grade(std::size_t cell) const
  {
    return cell != NO_INDEX && m_complex.cells()[cell].crease == NO_INDEX;
  }

  Border border(const Cell_complex::Segment_side& segment) const
  {
    const Placed_cell placed = {segment.cell, m_frame_of_cell[segment.cell]};
    const Tick_rectangle r = placed_rectangle(m_complex, placed);
    const int side = face_side(placed, segment.side), axis = side & 1;
    const auto place = [&](double fraction)
    {
      const std::int64_t distance = std::llround(fraction * double(r.extent(axis)));
      return side < 2 ? r.low[axis] + distance : r.high[axis] - distance;
    };
    const std::int64_t first = place(segment.first), last = place(segment.last);
    return {m_face_of_cell[segment.cell], axis, (std::min)(first, last), (std::max)(first, last)};
  }

  // the breaks before the knot intervals that overlap a border, and the end
  std::pair<Break_iterator, Break_iterator> intervals(const Border& border) const
  {
    const std::vector<std::int64_t>& breaks = m_breaks[border.face][border.axis];
    return {std::upper_bound(breaks.begin(), breaks.end(), border.low) - 1,
            std::lower_bound(breaks.begin(), breaks.end(), border.high)};
  }

  std::int64_t shortest_interval(const Border& border) const
  {
    std::int64_t result = (std::numeric_limits<std::int64_t>::max)() / LARGEST_RATIO;
    const auto range = intervals(border);
    for(auto b = range.first; b != range.second; ++b)
      result = (std::min)(result, *(b + 1) - *b);
    return result;
  }

  bool halve_long_intervals(const Border& border, const Border& other)
  {
    const std::int64_t largest = LARGEST_RATIO * shortest_interval(other);
    std::vector<std::int64_t> middles;
    const auto range = intervals(border);
    for(auto b = range.first; b != range.second; ++b)
      if(*(b + 1) - *b > largest)
        middles.push_back(*b + (*(b + 1) - *b) / 2);
    std::vector<std::int64_t>& breaks = m_breaks[border.face][border.axis];
    breaks.insert(breaks.end(), middles.begin(), middles.end());
    std::sort(breaks.begin(), breaks.end());
    return !middles.empty();
  }

  const Cell_complex& m_complex;
  std::vector<Face_breaks> m_breaks;
  std::vector<std::size_t> m_face_of_cell;
  std::vector<Tick_frame> m_frame_of_cell; // in its face
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_GRADED_BREAKS_H
