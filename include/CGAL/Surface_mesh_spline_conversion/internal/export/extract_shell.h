// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_EXTRACT_SHELL_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_EXTRACT_SHELL_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/caps/Cap_builder.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/caps/Crease_builder.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_merger.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Shell_assembler.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

struct Extraction_settings
{
  bool across_patches;   ///< may faces cover several patches?
  int levels;            ///< of subdivision of the cells at extraordinary points
  double cap_tolerance;  ///< on the deviation of caps
  std::vector<Boundary_point> boundary_points; ///< where the boundary must have vertices
};

struct Extraction_result
{
  std::size_t number_of_caps = 0;
  std::size_t number_of_sharp_caps = 0; ///< caps that are tangent continuous only approximately
  double cap_deviation = 0;             ///< largest deviation of caps from the surface
  std::size_t number_of_creases = 0;    ///< crease lines with tangent continuous faces
  double crease_deviation = 0;          ///< largest deviation of these faces from the surface
};

/// Pieces agree if they do so to this fraction of the extent: some hundred times the rounding errors
/// of double, a hundredth of what CAD kernels resolve (10^-7 mm in parts of 100 mm).
constexpr double RELATIVE_EQUALITY = 1e-11;

inline double largest_coordinate(const std::vector<Cell>& cells)
{
  double result = 0;
  for(const Cell& cell : cells)
    for(const Eigen::Vector3d& p : cell.points)
      result = (std::max)(result, p.cwiseAbs().maxCoeff());
  return result;
}

inline std::vector<Cell> quartered(const Cell& cell)
{
  std::vector<Cell> result;
  for(int j = 0; j < 2; ++j)
    for(int i = 0; i < 2; ++i)
    {
      Cell c = cell;
      const std::array<int, 2> at = {{i, j}};
      for(int axis = 0; axis < 2; ++axis)
      {
        const std::int64_t half = cell.rectangle.extent(axis) / 2;
        c.rectangle.low[axis] += at[axis] * half;
        c.rectangle.high[axis] = c.rectangle.low[axis] + half;
      }
      c.points = restriction(cell.points, i / 2., j / 2., (i + 1) / 2., (j + 1) / 2.);
      result.push_back(c);
    }
  return result;
}

inline bool touches_itself(const Cell_complex& complex, std::size_t c)
{
  std::vector<std::size_t> vertices;
  for(int side = 0; side < 4; ++side)
    for(const auto& use : complex.uses(c, side))
    {
      if(complex.across(use).cell == c)
        return true;
      vertices.push_back(complex.source(use));
    }
  std::sort(vertices.begin(), vertices.end());
  return std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end();
}

/// quarters cells that touch themselves, as there are in very coarse layouts, until there are none
inline Cell_complex make_cell_complex(std::vector<Cell> cells, const Quad_neighbors& neighbors)
{
  for(;;)
  {
    Cell_complex complex(std::move(cells), neighbors);
    std::vector<Cell> next;
    for(std::size_t c = 0; c < complex.cells().size(); ++c)
      if(complex.cells()[c].cap == NO_INDEX && touches_itself(complex, c))
        for(const Cell& part : quartered(complex.cells()[c]))
          next.push_back(part);
      else
        next.push_back(complex.cells()[c]);
    if(next.size() == complex.cells().size())
      return complex;
    cells = std::move(next);
  }
}

/// The whole extraction for any set of cells: caps, rectangles, topology.
/// \param position returns the point of a patch at coordinates of its quad, in [0,1]
template <typename K, typename Position>
Extraction_result extract_shell(std::vector<Cell> cells, const Quad_neighbors& neighbors,
                                const Position& position, const Extraction_settings& settings,
                                NURBS_shell_3<K>& shell)
{
  const double equality = RELATIVE_EQUALITY * largest_coordinate(cells);
  Cell_complex all = make_cell_complex(std::move(cells), neighbors);
  Crease_builder crease_builder(all, settings.cap_tolerance, equality);
  const std::vector<Crease> creases = crease_builder();
  if(!creases.empty())
    all = Cell_complex(crease_builder.cells(creases), neighbors);

  Cap_builder<Position> builder(all, position,
                                {settings.cap_tolerance, equality, settings.levels});
  const std::vector<Cap> caps = builder();
  const Cell_complex complex = make_cell_complex(builder.cells(caps), neighbors);

  Cell_merger merger(complex, equality);
  std::vector<Cell_rectangle> faces = merger(settings.across_patches);
  Shell_assembler<K>(complex, caps, creases, merger)(std::move(faces), settings.boundary_points,
                                                     shell);

  Extraction_result result;
  result.number_of_caps = caps.size();
  result.number_of_creases = creases.size();
  for(const Crease& crease : creases)
    result.crease_deviation = (std::max)(result.crease_deviation, crease.deviation);
  for(const Cap& cap : caps)
  {
    result.cap_deviation = (std::max)(result.cap_deviation, cap.deviation);
    if(cap.residual > equality)
      ++result.number_of_sharp_caps;
  }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_EXTRACT_SHELL_H
