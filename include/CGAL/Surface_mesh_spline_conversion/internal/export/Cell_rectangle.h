// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_RECTANGLE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_RECTANGLE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// the rectangle of a cell in the coordinates of its face
inline Tick_rectangle placed_rectangle(const Cell_complex& complex, const Placed_cell& placed)
{
  return placed.frame(complex.cells()[placed.cell].rectangle);
}

/// the side of the cell that corresponds to a side of the face
inline int cell_side(const Placed_cell& placed, int face_side)
{
  return (face_side - placed.frame.turns + 4) & 3;
}

/// the side of the face that corresponds to a side of the cell
inline int face_side(const Placed_cell& placed, int cell_side)
{
  return (cell_side + placed.frame.turns) & 3;
}

/// the coordinate that is constant along a side
inline std::int64_t side_level(const Tick_rectangle& r, int side)
{
  return (side == 1) ? r.high[0] : (side == 2) ? r.high[1] : (side == 3) ? r.low[0] : r.low[1];
}

inline double area(const Tick_rectangle& r) { return double(r.extent(0)) * double(r.extent(1)); }

/// the coordinates of all cell sides of a face along an axis
inline std::vector<std::int64_t> breakpoints(const Cell_complex& complex,
                                             const Cell_rectangle& face, int axis)
{
  std::vector<std::int64_t> result;
  for(const Placed_cell& placed : face.cells)
  {
    const Tick_rectangle r = placed_rectangle(complex, placed);
    result.push_back(r.low[axis]);
    result.push_back(r.high[axis]);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// the cells along a side of a face, counter clockwise
inline std::vector<Placed_cell> cells_on_side(const Cell_complex& complex,
                                              const Cell_rectangle& face, int side)
{
  std::vector<std::pair<std::int64_t, std::size_t> > order;
  for(std::size_t i = 0; i < face.cells.size(); ++i)
  {
    const Tick_rectangle r = placed_rectangle(complex, face.cells[i]);
    if(side_level(r, side) == side_level(face.bounds, side))
      order.emplace_back((side < 2) ? r.low[side] : -r.high[side - 2], i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Placed_cell> result;
  for(const auto& entry : order)
    result.push_back(face.cells[entry.second]);
  return result;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_RECTANGLE_H
