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
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/graded_breaks.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

struct Extraction_settings
{
  Merging merging;       ///< of bicubic pieces to faces
  int levels;            ///< of subdivision of the cells at extraordinary points
  double cap_tolerance;  ///< on the deviation of caps
  std::vector<Boundary_point> boundary_points; ///< where the boundary must have vertices
  Caps_of_surface caps = {}; ///< empty functions if there are none
};

struct Extraction_result
{
  std::size_t number_of_caps = 0;
  std::size_t number_of_sharp_caps = 0; ///< caps that are tangent continuous only approximately
  double cap_deviation = 0;             ///< largest deviation of caps from the surface
  std::size_t number_of_creases = 0;    ///< crease lines with tangent continuous faces
  double crease_deviation = 0;          ///< largest deviation of these faces from the surface
};

/// Pieces agree if they do so to this fraction of the extent: some hundred times the rounding
/// errors of double, a hundredth of what CAD kernels resolve (10^-7 mm in parts of 100 mm).
constexpr double RELATIVE_EQUALITY = 1e-11;

inline double largest_coordinate(const std::vector<Cell>& cells)
{
  double result = 0;
  for(const Cell& cell : cells)
    for(const Eigen::Vector3d& p : *cell.points)
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
      c.points = std::make_shared<const Bicubic>(
        restriction(*cell.points, i / 2., j / 2., (i + 1) / 2., (j + 1) / 2.));
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
    std::vector<char> marks(complex.cells().size(), false);
    for(std::size_t c = 0; c < marks.size(); ++c)
      marks[c] = complex.cells()[c].cap == NO_INDEX && touches_itself(complex, c);
    if(std::find(marks.begin(), marks.end(), true) == marks.end())
      return complex;
    std::vector<Cell> next;
    for(std::size_t c = 0; c < marks.size(); ++c)
      if(marks[c])
        for(const Cell& part : quartered(complex.cells()[c]))
          next.push_back(part);
      else
        next.push_back(complex.cells()[c]);
    cells = std::move(next);
  }
}

/// the crease lines that get faces of their own
enum class Crease_lines
{
  ALL,
  WITHOUT_CAPS, ///< those that do not run into extraordinary points
  NONE
};

// do all cells of the creases remain, and does a cap follow where one must?
inline bool fit_together(const Cell_complex& before, const Cell_complex& after)
{
  auto count = [](const Cell_complex& complex)
  {
    std::size_t n = 0;
    for(const Cell& cell : complex.cells())
      n += cell.crease != NO_INDEX ? 1 : 0;
    return n;
  };
  if(count(before) != count(after))
    return false;
  for(std::size_t c = 0; c < after.cells().size(); ++c)
  {
    const Cell& cell = after.cells()[c];
    if(!cell.is_end_of_crease)
      continue;
    const auto& uses = after.uses(c, cell_side({c, cell.frame}, 2));
    if(uses.size() != 1 || after.across(uses.front()).cell == NO_INDEX
       || after.cells()[after.across(uses.front()).cell].cap == NO_INDEX
       || after.across(uses.front()).last - after.across(uses.front()).first != 1)
      return false;
  }
  return true;
}

/// finds creases and caps, and the cells that remain; returns `false` if they do not fit together
template <typename Position>
bool cut_out_creases_and_caps(const Cell_complex& all, const Quad_neighbors& neighbors,
                              const Position& position, const Extraction_settings& settings,
                              double equality, Crease_lines lines, std::vector<Crease>& creases,
                              std::vector<Cap>& caps, std::vector<Cell>& cells)
{
  creases.clear();
  std::vector<Cell> cut;
  if(lines != Crease_lines::NONE)
  {
    Crease_builder builder(all, {settings.cap_tolerance, equality, settings.levels,
                                 lines == Crease_lines::ALL});
    creases = builder();
    cut = builder.cells(creases);
  }
  else
    cut = all.cells();
  const Cell_complex complex(std::move(cut), neighbors);
  Cap_builder<Position> builder(complex, position,
                                {settings.cap_tolerance, equality, settings.levels,
                                 settings.caps});
  caps = builder();
  cells = builder.cells(caps);
  return creases.empty() || fit_together(complex, Cell_complex(cells, neighbors));
}

/// Returns the polynomial pieces of the faces of a shell: the cells, which the knots of the others
/// in a face do not cut, and the pieces of caps and creases. While a surface is refined, those of
/// its cells that stay the same have the same pieces, to the bit.
template <typename K>
std::vector<Bezier_piece> pieces_of_cells(const Cell_complex& complex,
                                          const std::vector<Cell_rectangle>& faces,
                                          const NURBS_shell_3<K>& shell)
{
  std::vector<Bezier_piece> result;
  for(std::size_t f = 0; f < faces.size(); ++f)
    if(!is_mergeable(complex.cells()[faces[f].cells.front().cell]))
      append_bezier_pieces(shell.face(f).surface, f, result);
    else
      for(const Placed_cell& placed : faces[f].cells)
      {
        const Bicubic& points = *complex.cells()[placed.cell].points;
        result.push_back(Bezier_piece{{{3, 3}}, {points.begin(), points.end()}, f});
      }
  return result;
}

/// The whole extraction for any set of cells: caps, rectangles, topology.
/// \param position returns the point of a patch at coordinates of its quad, in [0,1]
/// \param pieces if not null, see `pieces_of_cells()`
template <typename K, typename Position>
Extraction_result extract_shell(std::vector<Cell> cells, const Quad_neighbors& neighbors,
                                const Position& position, const Extraction_settings& settings,
                                NURBS_shell_3<K>& shell,
                                std::vector<Bezier_piece>* pieces = nullptr)
{
  const double equality = RELATIVE_EQUALITY * largest_coordinate(cells);
  const Cell_complex all = make_cell_complex(std::move(cells), neighbors);
  std::vector<Crease> creases;
  std::vector<Cap> caps;
  std::vector<Cell> parts;
  for(Crease_lines lines : {Crease_lines::ALL, Crease_lines::WITHOUT_CAPS, Crease_lines::NONE})
    if(cut_out_creases_and_caps(all, neighbors, position, settings, equality, lines, creases, caps,
                                parts))
      break;
  const Cell_complex complex = make_cell_complex(std::move(parts), neighbors);

  std::vector<Cell_rectangle> faces = Cell_merger(complex, equality)(settings.merging);
  turn_caps(complex, caps, faces);
  const std::vector<Face_breaks> breaks = settings.merging == Merging::BEST
    ? Break_grading(complex, faces)() : cell_breaks(complex, faces);
  Shell_assembler<K>(complex, caps, creases)(faces, breaks, settings.boundary_points, shell);
  if(pieces != nullptr)
    *pieces = pieces_of_cells(complex, faces, shell);

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
