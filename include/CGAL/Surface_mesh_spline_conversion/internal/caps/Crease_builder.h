// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CREASE_BUILDER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CREASE_BUILDER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/caps/Crease_finder.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/caps/Crease_ribbons.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/blossoms.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// The pair of faces beside a crease line that replace the surface there: cubic across the line, of
/// degree five along it, once continuously differentiable.
struct Crease
{
  std::vector<std::int64_t> breaks;                      ///< along the line, from 0 on
  std::array<std::int64_t, 2> width;                     ///< of the left and the right face
  std::array<std::vector<Eigen::Vector3d>, 2> points;    ///< Bezier points of the faces, see below
  /// a third of the change of the derivative along the line at the boundary, times `shift_end`
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  std::int64_t shift_end = 0;                            ///< y from where on the line is not moved
  double deviation = 0;                                  ///< from the surface, normal to it
  bool ends_at_cap = false;                              ///< of the same width
};

/// Makes the surface tangent continuous across crease lines: the cross derivatives of both sides
/// are changed such that they lie in common tangent planes, and nothing else is. The faces keep
/// their outer curves and the derivatives there.
///
/// At the boundary, the tangent plane is that of the curves. Where the surface misses it because
/// the direction of the line depends on several control points there, the line is moved by a cubic
/// spline that takes its direction into the plane, and the surface on both sides with it. The
/// spline has two pieces of the same length and fades out twice continuously differentiable. It is
/// as long as the line, or a half, a quarter, ... of it where that would move the surface too far.
///
/// The points of a face are those of its pieces along the line, 24 each: `4*b+a` for point a in x,
/// from smaller to larger x, and b in y.
class Crease_builder
{
public:
  static constexpr int DEGREE_ACROSS = 3;
  static constexpr int DEGREE_ALONG = Crease_ribbons::DEGREE;
  static constexpr int COLUMNS = DEGREE_ACROSS + 1;
  static constexpr int ROWS = DEGREE_ALONG + 1;

  struct Settings
  {
    double tolerance;     ///< the deviation that is allowed; faces are made narrower to keep it
    double equality;      ///< lengths below are rounding
    int levels;           ///< of subdivision at extraordinary points
    bool may_end_at_caps; ///< are lines to extraordinary points taken into account?
  };

  Crease_builder(const Cell_complex& complex, const Settings& settings)
    : m_complex(complex), m_tolerance(settings.tolerance), m_equality(settings.equality)
  {
    m_lines = Crease_finder(complex, settings.levels, settings.equality)();
    if(!settings.may_end_at_caps)
      m_lines.erase(std::remove_if(m_lines.begin(), m_lines.end(),
                                   [](const Crease_line& line) { return line.ends_at_cap; }),
                    m_lines.end());
    m_number_of_uses.assign(complex.cells().size(), 0);
    for(const Crease_line& line : m_lines)
      for(const auto& cells : line.cells)
        for(const Placed_cell& placed : cells)
          ++m_number_of_uses[placed.cell];
  }

  std::vector<Crease> operator()()
  {
    std::vector<Crease> result;
    std::vector<Crease_line> lines;
    for(const Crease_line& line : m_lines)
    {
      Crease crease;
      if(!build(line, crease))
        continue;
      result.push_back(crease);
      lines.push_back(line);
    }
    m_lines.swap(lines);
    return result;
  }

  /// all cells, cut such that those of the creases are separate
  std::vector<Cell> cells(const std::vector<Crease>& creases) const
  {
    std::vector<Cell> work = m_complex.cells();
    std::vector<std::vector<std::size_t> > parts(work.size()); // of cut cells
    for(std::size_t i = 0; i < creases.size(); ++i)
      for(std::size_t side = 0; side < 2; ++side)
        for(const Placed_cell& placed : m_lines[i].cells[side])
          cut(placed, i, side, creases[i], work, parts[placed.cell]);
    for(Cell& cell : work)
      if(cell.crease != NO_INDEX)
      {
        move_line(creases[cell.crease], cell);
        if(creases[cell.crease].ends_at_cap)
          set_end(creases[cell.crease], cell);
      }
    return work;
  }

private:
  // a face is narrowed so often at most until its deviation is small enough
  static constexpr int MAXIMUM_NUMBER_OF_HALVINGS = 3;

  // A shift is shortened so often at most. Its size falls with its length, so that this allows any
  // slope of the line against the plane of the tangents: next to a corner close to 180 degrees, the
  // surface may leave that plane by any angle.
  static constexpr int MAXIMUM_NUMBER_OF_SHIFT_HALVINGS = 12;

  Tick_rectangle image(const Placed_cell& placed) const
  {
    return placed_rectangle(m_complex, placed);
  }

  // the width that all cells of a side have; half of it where two creases share a cell
  std::int64_t width(const std::vector<Placed_cell>& cells) const
  {
    std::int64_t result = image(cells.front()).extent(0);
    for(const Placed_cell& placed : cells)
      result = (std::min)(result, image(placed).extent(0) / m_number_of_uses[placed.cell]);
    return result;
  }

  bool build(const Crease_line& line, Crease& crease) const
  {
    crease.breaks = line.breaks;
    crease.ends_at_cap = line.ends_at_cap;
    for(std::size_t side = 0; side < 2; ++side)
      crease.width[side] = width(line.cells[side]);
    if(line.ends_at_cap && !fit_to_cap(line, crease))
      return false;
    set_shift(pieces(line, crease, 0).front(), pieces(line, crease, 1).front(), crease);
    const Crease_ribbons ribbons(pieces(line, crease, 0), pieces(line, crease, 1),
                                 lengths(crease), {{size(crease.width[0]), size(crease.width[1])}});
    if(!ribbons.is_regular())
      return false;
    const double shift = deviation_of_shift(crease.shift);
    for(int i = 0; i < MAXIMUM_NUMBER_OF_HALVINGS && !crease.ends_at_cap; ++i)
      for(std::size_t side = 0; side < 2; ++side)
        if(ribbons.deviation(side, size(crease.width[side])) + shift > m_tolerance)
          crease.width[side] /= 2;
    for(std::size_t side = 0; side < 2; ++side)
    {
      const double w = size(crease.width[side]);
      crease.deviation = (std::max)(crease.deviation, ribbons.deviation(side, w) + shift);
      set_points(pieces(line, crease, side), ribbons, side, w, crease.points[side]);
    }
    return true;
  }

  // Sets the shift that takes the direction of the line at the boundary into the plane of the
  // tangents there, for the first pieces on both sides; none where that is so already, or where
  // even the shortest would move the surface too far.
  void set_shift(const Bicubic& left, const Bicubic& right, Crease& crease) const
  {
    constexpr double smallest_sine = 1e-6; // tangents with a smaller one have no plane to speak of
    const Eigen::Vector3d before = left[3] - left[2], after = right[1] - right[0];
    const Eigen::Vector3d normal = before.cross(after);
    if(normal.norm() <= smallest_sine * before.norm() * after.norm())
      return;
    const double height = normal.dot(right[0] - right[4]) / normal.squaredNorm();
    const Eigen::Vector3d change = height / double(crease.breaks[1]) * normal;
    for(int i = 0; i <= MAXIMUM_NUMBER_OF_SHIFT_HALVINGS; ++i)
    {
      const std::int64_t end = crease.breaks.back() >> i;
      const Eigen::Vector3d shift = change * double(end);
      if(deviation_of_shift(shift) > m_tolerance)
        continue;
      if(deviation_of_shift(shift) <= m_equality)
        return;
      crease.shift = shift;
      crease.shift_end = end;
      insert_break(end / 2, crease.breaks);
      insert_break(end, crease.breaks);
      return;
    }
  }

  static void insert_break(std::int64_t y, std::vector<std::int64_t>& breaks)
  {
    const auto at = std::lower_bound(breaks.begin(), breaks.end(), y);
    if(*at != y)
      breaks.insert(at, y);
  }

  // Bezier point `i` of max(0, 1 - y/end)^3 between two values of y, both on the same side of `end`
  static double fading_cube(std::int64_t first, std::int64_t last, std::int64_t end, int i)
  {
    if(last > end)
      return 0;
    return std::pow(1 - double(first) / double(end), 3 - i)
         * std::pow(1 - double(last) / double(end), i);
  }

  // adds what moves the line to the points of a bicubic from `first` to `last` along it
  static void add_shift(const Crease& crease, std::size_t side, std::int64_t first,
                        std::int64_t last, Bicubic& points)
  {
    for(int b = 0; b < 4; ++b)
    {
      const double share = fading_cube(first, last, crease.shift_end, b)
                         - fading_cube(first, last, crease.shift_end / 2, b);
      for(int column : {0, 1}) // the line, and beside it
        points[4 * b + (side == 0 ? DEGREE_ACROSS - column : column)] += share * crease.shift;
    }
  }

  static double deviation_of_shift(const Eigen::Vector3d& shift)
  {
    constexpr double largest_share = 0.3; // of the difference of cubes
    return largest_share * shift.norm();
  }

  // the cap is as wide as the last cells, whatever they share
  bool fit_to_cap(const Crease_line& line, Crease& crease) const
  {
    const std::int64_t size = (std::min)(image(line.cells[0].back()).extent(0),
                                         image(line.cells[1].back()).extent(0));
    const bool has_room = crease.width[0] >= size && crease.width[1] >= size;
    crease.width = {{size, size}};
    return has_room;
  }

  // the edges of faces are taken from cells
  static void move_line(const Crease& crease, Cell& cell)
  {
    const Tick_rectangle r = cell.frame(cell.rectangle);
    Bicubic grid = rotated(*cell.points, cell.frame.turns);
    add_shift(crease, cell.sector, r.low[1], r.high[1], grid);
    cell.points = std::make_shared<const Bicubic>(rotated(grid, 4 - cell.frame.turns));
  }

  // Gives the last cells the position and derivative of the new face at its end: the cap there
  // takes them from the cells.
  static void set_end(const Crease& crease, Cell& cell)
  {
    const Tick_rectangle r = cell.frame(cell.rectangle);
    if(r.high[1] != crease.breaks.back())
      return;
    Bicubic grid = rotated(*cell.points, cell.frame.turns);
    const std::size_t last = crease.breaks.size() - 2;
    const double share = double(r.extent(1))
                       / double(crease.breaks[last + 1] - crease.breaks[last]);
    const std::vector<Eigen::Vector3d>& points = crease.points[cell.sector];
    for(int a = 0; a < COLUMNS; ++a)
    {
      const Eigen::Vector3d& end = points[COLUMNS * (ROWS * last + ROWS - 1) + a];
      const Eigen::Vector3d& before = points[COLUMNS * (ROWS * last + ROWS - 2) + a];
      grid[12 + a] = end;
      grid[8 + a] = end - share * DEGREE_ALONG / 3 * (end - before);
    }
    cell.points = std::make_shared<const Bicubic>(rotated(grid, 4 - cell.frame.turns));
    cell.is_end_of_crease = true;
  }

  // in units of layout quads
  static double size(std::int64_t ticks) { return double(ticks) / double(QUAD_TICKS); }

  static std::vector<double> lengths(const Crease& crease)
  {
    std::vector<double> result;
    for(std::size_t k = 0; k + 1 < crease.breaks.size(); ++k)
      result.push_back(size(crease.breaks[k + 1] - crease.breaks[k]));
    return result;
  }

  // the surface on one side, between two breaks each
  std::vector<Bicubic> pieces(const Crease_line& line, const Crease& crease, std::size_t side) const
  {
    std::vector<Bicubic> result;
    std::size_t i = 0;
    for(std::size_t k = 0; k + 1 < crease.breaks.size(); ++k)
    {
      while(image(line.cells[side][i]).high[1] <= crease.breaks[k])
        ++i;
      const Placed_cell& placed = line.cells[side][i];
      const Tick_rectangle r = image(placed);
      const double share = double(crease.width[side]) / double(r.extent(0));
      const Bicubic grid = rotated(*m_complex.cells()[placed.cell].points, placed.frame.turns);
      result.push_back(restriction(
        grid, side == 0 ? 1 - share : 0, double(crease.breaks[k] - r.low[1]) / double(r.extent(1)),
        side == 0 ? 1 : share, double(crease.breaks[k + 1] - r.low[1]) / double(r.extent(1))));
      add_shift(crease, side, crease.breaks[k], crease.breaks[k + 1], result.back());
    }
    return result;
  }

  static void set_points(const std::vector<Bicubic>& pieces, const Crease_ribbons& ribbons,
                         std::size_t side, double width, std::vector<Eigen::Vector3d>& points)
  {
    for(std::size_t k = 0; k < pieces.size(); ++k)
      for(int b = 0; b < ROWS; ++b)
        for(int a = 0; a < COLUMNS; ++a)
        {
          const int column = (side == 0) ? DEGREE_ACROSS - a : a; // from the line outwards
          Cubic c;
          for(int j = 0; j < 4; ++j)
            c[j] = pieces[k][4 * j + a];
          Eigen::Vector3d p = Crease_ribbons::raised(c)[b];
          const bool is_on_boundary = (k == 0 && b == 0); // given by the curves
          if(column == 1 && !is_on_boundary)
            p += (side == 0 ? -width : width) / DEGREE_ACROSS * ribbons.change(side, k)[b];
          points.push_back(p);
        }
  }

  // Cuts off what a cell has outside of the face. Cells that two creases share may be cut already.
  void cut(const Placed_cell& placed, std::size_t crease, std::size_t side, const Crease& c,
           std::vector<Cell>& cells, std::vector<std::size_t>& parts) const
  {
    if(parts.empty())
      parts.push_back(placed.cell);
    const Tick_rectangle block = {{{side == 0 ? -c.width[0] : 0, 0}},
                                  {{side == 0 ? 0 : c.width[1], c.breaks.back()}}};
    const std::array<std::vector<std::int64_t>, 2> cuts
      = {{{block.low[0], block.high[0]}, {c.shift_end / 2, c.shift_end, block.high[1]}}};
    for(std::size_t i = 0; i < parts.size(); ++i)
      for(int axis = 0; axis < 2; ++axis)
        for(std::int64_t at : cuts[axis])
        {
          const Tick_rectangle r = placed.frame(cells[parts[i]].rectangle);
          if(!(r.low[axis] < at && at < r.high[axis]))
            continue;
          const std::array<Cell, 2> halves = divided(cells[parts[i]], placed.frame, axis, at);
          cells[parts[i]] = halves[0];
          parts.push_back(cells.size());
          cells.push_back(halves[1]);
        }
    for(std::size_t part : parts)
    {
      const Tick_rectangle r = placed.frame(cells[part].rectangle);
      if(r.low[0] < block.low[0] || r.high[0] > block.high[0] || r.high[1] > block.high[1])
        continue;
      cells[part].crease = crease;
      cells[part].sector = side;
      cells[part].frame = placed.frame;
    }
  }

  // divides a cell at the coordinate `at` of `axis` in the frame
  static std::array<Cell, 2> divided(const Cell& cell, const Tick_frame& frame, int axis,
                                     std::int64_t at)
  {
    const Tick_rectangle r = frame(cell.rectangle);
    const double t = double(at - r.low[axis]) / double(r.extent(axis));
    const Bicubic grid = rotated(*cell.points, frame.turns);
    std::array<Cell, 2> result = {{cell, cell}};
    for(std::size_t k = 0; k < 2; ++k)
    {
      std::array<std::array<double, 2>, 2> range = {{{{0, 1}}, {{0, 1}}}};
      range[axis] = (k == 0) ? std::array<double, 2>{{0, t}} : std::array<double, 2>{{t, 1}};
      Tick_rectangle part = r;
      (k == 0 ? part.high : part.low)[axis] = at;
      result[k].points = std::make_shared<const Bicubic>(
        rotated(restriction(grid, range[0][0], range[1][0], range[0][1], range[1][1]),
                4 - frame.turns));
      result[k].rectangle = frame.inverse()(part);
    }
    return result;
  }

  const Cell_complex& m_complex;
  double m_tolerance;
  double m_equality;
  std::vector<Crease_line> m_lines;
  std::vector<int> m_number_of_uses; // of each cell
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CREASE_BUILDER_H
