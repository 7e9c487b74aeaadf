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
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_rectangle.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Partition_improver.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Rectangle_grower.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/is_smooth_segment.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// how much effort goes into merging cells to rectangles
enum class Merging
{
  NONE, ///< each cell is one, but beside creases
  FAST, ///< rectangles grow one after the other
  BEST  ///< then they are improved together
};

/// Partition of a cell complex into rectangles of cells that join with C2 continuity, such that the
/// faces are few and their file is small: rectangles grow from one cell after the other, and are
/// improved together.
class Cell_merger
{
public:
  /// two pieces are C2 if their blossoms agree to `tolerance`
  Cell_merger(const Cell_complex& complex, double tolerance)
    : m_complex(complex), m_is_smooth(complex, tolerance), m_grower(complex, m_is_smooth)
  {}

  /// returns the rectangles
  std::vector<Cell_rectangle> operator()(Merging merging)
  {
    std::vector<std::size_t> cells(m_complex.cells().size());
    std::iota(cells.begin(), cells.end(), std::size_t(0));
    large_first(cells);
    if(merging == Merging::NONE)
      return single_cells(cells);
    std::vector<Cell_rectangle> faces = partition(cells);
    if(merging == Merging::BEST)
      Partition_improver(m_complex, m_is_smooth)(faces);
    return faces;
  }

private:
  Cell_rectangle single_cell(std::size_t cell) const
  {
    return {{{cell, Tick_frame()}}, m_complex.cells()[cell].rectangle};
  }

  std::vector<Cell_rectangle> single_cells(const std::vector<std::size_t>& cells)
  {
    std::vector<Cell_rectangle> faces;
    for(std::size_t c : cells)
      if(m_complex.cells()[c].crease == NO_INDEX)
        faces.push_back(single_cell(c));
    append_crease_faces(faces);
    return faces;
  }

  std::vector<Cell_rectangle> partition(const std::vector<std::size_t>& seeds)
  {
    std::vector<Cell_rectangle> faces;
    for(std::size_t seed : seeds)
    {
      if(m_grower.is_free(seed))
        faces.push_back(m_grower.grown(seed, faces.size()));
      else if(m_complex.cells()[seed].cap != NO_INDEX)
        faces.push_back(single_cell(seed));
    }
    append_crease_faces(faces);
    return faces;
  }

  // so that small cells do not cut large ones up
  void large_first(std::vector<std::size_t>& cells) const
  {
    std::stable_sort(cells.begin(), cells.end(), [this](std::size_t a, std::size_t b)
    {
      return area(m_complex.cells()[a].rectangle) > area(m_complex.cells()[b].rectangle);
    });
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
        const Tick_point p = placed_rectangle(m_complex, a).low, q = placed_rectangle(m_complex, b).low;
        return p[1] < q[1] || (p[1] == q[1] && p[0] < q[0]);
      });
      faces.push_back(face);
    }
  }

  const Cell_complex& m_complex;
  Smooth_segments m_is_smooth;
  Rectangle_grower m_grower;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_MERGER_H
