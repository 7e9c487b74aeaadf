// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CAP_BUILDER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CAP_BUILDER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/blossoms.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Cap_operator.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Bezier points of a biquintic piece, `[6*b+a]` with `a` along `u`
typedef std::array<Eigen::Vector3d, Cap_operator::POINTS> Biquintic;

/// the square of a cap in one of the quads round an extraordinary point
struct Cap_sector
{
  std::size_t quad = NO_INDEX;
  int corner = 0;           ///< of the quad, where the extraordinary point is
  Tick_rectangle rectangle = {{{0, 0}}, {{0, 0}}};
  std::size_t patch = NO_INDEX;
  Biquintic points;         ///< extraordinary point at (0,0), `u` along side `corner` of the quad
};

struct Cap
{
  std::vector<Cap_sector> sectors; ///< counter clockwise
  std::int64_t patch_size = QUAD_TICKS; ///< of the patches round the extraordinary point
  int level = 0;                   ///< the squares are patches halved so many times
  int level_of_surface = -1;       ///< the same for the cap that the surface has itself, if any
  double residual = 0;             ///< of the equations of tangent continuity
  double deviation = 0;            ///< from the surface, normal to it
  bool is_regular = true;          ///< do the normals look the way they do on the surface?
};

/// The caps that a surface has itself. They are made from the limit of subdivision, whose place they
/// take.
struct Caps_of_surface
{
  /// how many times a patch is halved to the cap at one of its corners, or -1 if there is none
  std::function<int(std::size_t, int)> level;
  /// the point of a patch as it is without caps
  std::function<Eigen::Vector3d(std::size_t, double, double)> limit;
};

/// Replaces the neighbourhoods of extraordinary points by G1 caps. A cap is as large as possible:
/// the cells along its outer sides must be single polynomials that belong to no cap, and its
/// deviation from the surface must keep a tolerance. Halving the squares divides the deviation by
/// 3 to 8, depending on the valence. Caps that the surface has itself do not deviate from it, unless
/// they have to be smaller here; then the limit of subdivision takes the place of what is missing.
template <typename Position>
class Cap_builder
{
public:
  struct Settings
  {
    double tolerance;   ///< on the deviation
    double equality;    ///< lengths below are rounding
    int maximum_level;  ///< to which the cells are given
    Caps_of_surface caps = {}; ///< empty functions if there are none
  };

  /// \param complex all cells, subdivided at extraordinary points to the maximum level
  /// \param position returns the point of a patch at coordinates of its quad, in [0,1]
  Cap_builder(const Cell_complex& complex, const Position& position, const Settings& settings)
    : m_complex(complex), m_position(position), m_settings(settings), m_cells_of_quad(
        complex.neighbors().size())
  {
    const std::vector<Cell>& cells = m_complex.cells();
    for(std::size_t c = 0; c < cells.size(); ++c)
      m_cells_of_quad[cells[c].quad].push_back(c);
  }

  std::vector<Cap> operator()()
  {
    find_extraordinary_points();
    separate();
    std::vector<std::size_t> open(m_caps.size());
    std::iota(open.begin(), open.end(), std::size_t(0));
    while(!open.empty())
    {
      set_rectangles();
      mark_covered_cells();
      std::vector<std::size_t> again;
      for(std::size_t i : open)
      {
        compute(m_caps[i]);
        if(is_good(m_caps[i]) || is_smallest(m_caps[i]))
          continue;
        ++m_caps[i].level;
        again.push_back(i);
      }
      open.swap(again);
    }
    for(Cap& cap : m_caps)
      if(cap.level_of_surface >= 0 && cap.level_of_surface < cap.level)
        measure_limit(cap);
    return m_caps;
  }

  /// the cells that remain, and those of the caps
  std::vector<Cell> cells(const std::vector<Cap>& caps) const
  {
    std::vector<char> is_covered(m_complex.cells().size(), false);
    for(const Cap& cap : caps)
      for(const Cap_sector& sector : cap.sectors)
        for(std::size_t c : m_cells_of_quad[sector.quad])
          if(contains(sector.rectangle, m_complex.cells()[c].rectangle))
            is_covered[c] = true;
    std::vector<Cell> result;
    for(std::size_t c = 0; c < is_covered.size(); ++c)
      if(!is_covered[c])
        result.push_back(m_complex.cells()[c]);
    Bicubic zeros; // points of the caps take their place
    zeros.fill(Eigen::Vector3d::Zero());
    const auto no_points = std::make_shared<const Bicubic>(zeros);
    for(std::size_t i = 0; i < caps.size(); ++i)
      for(std::size_t k = 0; k < caps[i].sectors.size(); ++k)
      {
        const Cap_sector& sector = caps[i].sectors[k];
        Cell cell;
        cell.points = no_points;
        cell.quad = sector.quad;
        cell.rectangle = sector.rectangle;
        cell.patch = sector.patch;
        cell.cap = i;
        cell.sector = k;
        result.push_back(cell);
      }
    return result;
  }

private:
  static constexpr int INTERVALS = Cap_operator::INTERVALS;

  static bool contains(const Tick_rectangle& r, const Tick_rectangle& s)
  {
    return r.low[0] <= s.low[0] && r.low[1] <= s.low[1]
        && s.high[0] <= r.high[0] && s.high[1] <= r.high[1];
  }

  void find_extraordinary_points()
  {
    const Quad_neighbors& neighbors = m_complex.neighbors();
    for(std::size_t q = 0; q < neighbors.size(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        const std::pair<std::size_t, int> start(q, i);
        std::vector<std::pair<std::size_t, int> > round;
        std::pair<std::size_t, int> at = start;
        do
        {
          round.push_back(at);
          at = Cell_complex::next_sector(neighbors, at);
        }
        while(at.first != NO_INDEX && at != start && at > start);
        if(at == start && round.size() != 4)
          add_cap(round);
      }
  }

  void add_cap(const std::vector<std::pair<std::size_t, int> >& round)
  {
    Cap cap;
    for(const auto& corner : round)
    {
      Cap_sector sector;
      sector.quad = corner.first;
      sector.corner = corner.second;
      sector.patch = patch_at_corner(corner);
      for(int axis = 0; axis < 2; ++axis)
        cap.patch_size
          = (std::min)(cap.patch_size, patch_bounds(sector.quad, sector.patch).extent(axis));
      cap.sectors.push_back(sector);
    }
    const Cap_sector& first = cap.sectors.front();
    if(m_settings.caps.level)
    {
      cap.level_of_surface = m_settings.caps.level(first.patch, first.corner);
      cap.level = (std::max)(0, cap.level_of_surface);
    }
    m_caps.push_back(cap);
  }

  std::size_t patch_at_corner(const std::pair<std::size_t, int>& corner) const
  {
    const Tick_point p = quad_corner(corner.second);
    for(std::size_t c : m_cells_of_quad[corner.first])
      if(contains(m_complex.cells()[c].rectangle, {p, p}))
        return m_complex.cells()[c].patch;
    return NO_INDEX;
  }

  Tick_rectangle patch_bounds(std::size_t quad, std::size_t patch) const
  {
    Tick_rectangle bounds = {{{QUAD_TICKS, QUAD_TICKS}}, {{0, 0}}};
    for(std::size_t c : m_cells_of_quad[quad])
      if(m_complex.cells()[c].patch == patch)
        for(int axis = 0; axis < 2; ++axis)
        {
          const Tick_rectangle& r = m_complex.cells()[c].rectangle;
          bounds.low[axis] = (std::min)(bounds.low[axis], r.low[axis]);
          bounds.high[axis] = (std::max)(bounds.high[axis], r.high[axis]);
        }
    return bounds;
  }

  void set_rectangles()
  {
    for(Cap& cap : m_caps)
      set_rectangles(cap, cap.level);
  }

  static void set_rectangles(Cap& cap, int level)
  {
    const std::int64_t size = cap.patch_size >> level;
    for(Cap_sector& sector : cap.sectors)
    {
      const Tick_point p = quad_corner(sector.corner);
      for(int axis = 0; axis < 2; ++axis)
      {
        sector.rectangle.low[axis] = (p[axis] == 0) ? 0 : QUAD_TICKS - size;
        sector.rectangle.high[axis] = (p[axis] == 0) ? size : QUAD_TICKS;
      }
    }
  }

  // halves caps until none touches another, the boundary, or a side with several cells
  void separate()
  {
    for(bool has_changed = true; has_changed; )
    {
      has_changed = false;
      set_rectangles();
      mark_covered_cells();
      for(Cap& cap : m_caps)
        if(cap.level < m_settings.maximum_level && !has_single_neighbors(cap))
        {
          ++cap.level;
          has_changed = true;
        }
    }
  }

  void mark_covered_cells()
  {
    m_is_covered.assign(m_complex.cells().size(), 0);
    for(const Cap& cap : m_caps)
      for(const Cap_sector& sector : cap.sectors)
        for(std::size_t c : m_cells_of_quad[sector.quad])
          if(contains(sector.rectangle, m_complex.cells()[c].rectangle))
            ++m_is_covered[c];
  }

  bool has_single_neighbors(const Cap& cap) const
  {
    for(const Cap_sector& sector : cap.sectors)
    {
      for(std::size_t c : m_cells_of_quad[sector.quad])
        if(contains(sector.rectangle, m_complex.cells()[c].rectangle)
           && (m_is_covered[c] > 1 || m_complex.cells()[c].crease != NO_INDEX))
          return false;
      for(int side = 0; side < 2; ++side)
        if(!neighbor(sector, side).is_single)
          return false;
    }
    return true;
  }

  struct Neighbor
  {
    bool is_single = false;
    Cell_complex::Segment_use use = {NO_INDEX, 0}; // one of the segments, seen from inside
  };

  // the cell across the outer side u = 1 (0) or v = 1 (1) of a sector
  Neighbor neighbor(const Cap_sector& sector, int outer_side) const
  {
    Neighbor result;
    const int side = (sector.corner + 1 + outer_side) & 3;
    const Tick_rectangle& r = sector.rectangle;
    const int axis = (side + 1) & 1;
    std::size_t only = NO_INDEX;
    for(std::size_t c : m_cells_of_quad[sector.quad])
    {
      const Tick_rectangle& s = m_complex.cells()[c].rectangle;
      const bool is_high = (side == 1 || side == 2);
      if(!contains(r, s) || (is_high ? s.high[axis] != r.high[axis] : s.low[axis] != r.low[axis]))
        continue;
      for(const auto& use : m_complex.uses(c, side))
      {
        const std::size_t other = m_complex.across(use).cell;
        if(other == NO_INDEX || (only != NO_INDEX && other != only)
           || m_is_covered[other] > 0)
          return Neighbor();
        only = other;
        result.use = use;
      }
    }
    result.is_single = (only != NO_INDEX);
    return result;
  }

  // the rows for the data of `Cap_operator`
  static Eigen::MatrixXd empty_data(const Cap& cap)
  {
    return Eigen::MatrixXd::Zero(Eigen::Index(cap.sectors.size())
                                 * (Cap_operator::RIBBON_DATA + Cap_operator::SAMPLES), 3);
  }

  void compute(Cap& cap)
  {
    const int n = int(cap.sectors.size());
    Eigen::MatrixXd data = empty_data(cap);
    for(int k = 0; k < n; ++k)
      for(int side = 0; side < 2; ++side)
        set_ribbon(cap.sectors[k], side, data, Cap_operator::RIBBON_DATA * k + 8 * side);
    if(m_settings.caps.limit)
      set_samples(cap, m_settings.caps.limit, data);
    else
      set_samples(cap, m_position, data);
    const Cap_operator& smooth = cap_operator(n, true);
    Eigen::MatrixXd points = smooth(data);
    cap.residual = smooth.residual(points, data);
    // at the line of discontinuity of a corner the neighbours do not fit together
    if(cap.residual > m_settings.equality && is_smallest(cap))
      points = cap_operator(n, false)(data);
    for(int k = 0; k < n; ++k)
      for(int i = 0; i < Cap_operator::POINTS; ++i)
        cap.sectors[k].points[i] = points.row(Cap_operator::POINTS * k + i).transpose();
    if(cap.level == cap.level_of_surface)
      set_samples(cap, m_position, data);
    measure(cap, data);
  }

  // may the cap not be halved any more? The size of one at the end of a crease is given.
  bool is_smallest(const Cap& cap) const
  {
    if(cap.level == m_settings.maximum_level)
      return true;
    for(const Cap_sector& sector : cap.sectors)
      for(int side = 0; side < 2; ++side)
      {
        const Neighbor n = neighbor(sector, side);
        if(n.is_single && m_complex.cells()[m_complex.across(n.use).cell].is_end_of_crease)
          return true;
      }
    return false;
  }

  bool is_good(const Cap& cap) const
  {
    return cap.residual <= m_settings.equality && cap.deviation <= m_settings.tolerance
        && cap.is_regular;
  }

  // position and cross derivative of the neighbour; the unit of length is the side of the cap
  void set_ribbon(const Cap_sector& sector, int side, Eigen::MatrixXd& data, int row) const
  {
    const Neighbor neighbor = this->neighbor(sector, side);
    if(neighbor.use.segment == NO_INDEX)
      return;
    const auto& across = m_complex.across(neighbor.use);
    const Cell& cell = m_complex.cells()[across.cell];
    const Bicubic grid = rotated(*cell.points, (4 - across.side) & 3);
    const double size = double(sector.rectangle.extent(0));
    const double along = double(cell.rectangle.extent(across.side & 1));
    const double step = size / double(cell.rectangle.extent((across.side + 1) & 1));
    const std::array<double, 2> range = ribbon_range(sector, side, neighbor.use, size / along);
    for(int i = 0; i < 4; ++i)
    {
      const Blossom_arguments u = bezier_arguments(range[0], range[1], i);
      const Eigen::Vector3d position = blossom(grid, u, {{0, 0, 0}});
      const Eigen::Vector3d derivative = 3 * (blossom(grid, u, {{0, 0, step}}) - position);
      data.row(row + i) = position.transpose();
      data.row(row + 4 + i) = derivative.transpose();
    }
  }

  // Where the side of the cap begins and ends on the side of the neighbour. The first outer side
  // (v upwards) runs counter clockwise round the cap, hence clockwise round the neighbour, the
  // second (u upwards) the other way round.
  std::array<double, 2> ribbon_range(const Cap_sector& sector, int outer_side,
                                     const Cell_complex::Segment_use& use, double length) const
  {
    const int side = (sector.corner + 1 + outer_side) & 3;
    const Cell& inner = m_complex.cells()[m_complex.here(use).cell];
    const auto& across = m_complex.across(use);
    const int axis = side & 1;
    const double offset = (side == 0 || side == 1)
      ? double(inner.rectangle.low[axis] - sector.rectangle.low[axis])
      : double(sector.rectangle.high[axis] - inner.rectangle.high[axis]);
    const double unit = double(inner.rectangle.extent(axis)), size = double(
      sector.rectangle.extent(axis));
    // counter clockwise position of the segment's begin on the side of the cap, in sides of the cap
    const double position = (offset + m_complex.here(use).first * unit) / size;
    const double begin = across.last + position * length;
    return (outer_side == 0) ? std::array<double, 2>{{begin, begin - length}}
                             : std::array<double, 2>{{begin - length, begin}};
  }

  template <typename Point>
  static Eigen::Vector3d point_of_sector(const Cap_sector& sector, const Point& point, double u,
                                         double v)
  {
    const double size = std::ldexp(double(sector.rectangle.extent(0)), -40);
    double x = u * size, y = v * size;
    for(int r = 0; r < sector.corner; ++r)
    {
      const double t = x;
      x = 1 - y;
      y = t;
    }
    return point(sector.patch, x, y);
  }

  // `point` returns the point of a patch at coordinates of its quad
  template <typename Point>
  static void set_samples(const Cap& cap, const Point& point, Eigen::MatrixXd& data)
  {
    Eigen::Index row = Cap_operator::RIBBON_DATA * Eigen::Index(cap.sectors.size());
    for(const Cap_sector& sector : cap.sectors)
      for(int j = 0; j <= INTERVALS; ++j)
        for(int i = 0; i <= INTERVALS; ++i, ++row)
          data.row(row) = point_of_sector(sector, point, i / double(INTERVALS),
                                          j / double(INTERVALS)).transpose();
  }

  // returns the point of a sector at a sample
  static Eigen::Vector3d sample(const Cap& cap, const Eigen::MatrixXd& data, std::size_t k, int i,
                                int j)
  {
    const int first = Cap_operator::RIBBON_DATA * int(cap.sectors.size())
                      + Cap_operator::SAMPLES * int(k);
    return data.row(first + (INTERVALS + 1) * j + i).transpose();
  }

  // returns the normal of the triangles between samples
  static Eigen::Vector3d normal(const Cap& cap, const Eigen::MatrixXd& data, std::size_t k, int i,
                                int j)
  {
    i = (std::min)(i, INTERVALS - 1);
    j = (std::min)(j, INTERVALS - 1);
    return (sample(cap, data, k, i + 1, j + 1) - sample(cap, data, k, i, j))
      .cross(sample(cap, data, k, i, j + 1) - sample(cap, data, k, i + 1, j)).normalized();
  }

  // Compares the limit with the larger cap that the surface has.
  void measure_limit(Cap& cap) const
  {
    Cap larger = cap;
    set_rectangles(larger, cap.level_of_surface);
    Eigen::MatrixXd surface = empty_data(cap), limit = surface;
    set_samples(larger, m_position, surface);
    set_samples(larger, m_settings.caps.limit, limit);
    for(std::size_t k = 0; k < cap.sectors.size(); ++k)
      for(int j = 0; j <= INTERVALS; ++j)
        for(int i = 0; i <= INTERVALS; ++i)
          cap.deviation = (std::max)(cap.deviation, std::abs(normal(cap, surface, k, i, j).dot(
            sample(cap, limit, k, i, j) - sample(cap, surface, k, i, j))));
  }

  // compares cap and surface at the samples
  void measure(Cap& cap, const Eigen::MatrixXd& data) const
  {
    const Bernstein_table table;
    cap.deviation = 0;
    cap.is_regular = true;
    for(std::size_t k = 0; k < cap.sectors.size(); ++k)
      for(int j = 0; j <= INTERVALS; ++j)
        for(int i = 0; i <= INTERVALS; ++i)
        {
          const Eigen::Vector3d direction = normal(cap, data, k, i, j);
          std::array<Eigen::Vector3d, 3> d;
          table.evaluate(cap.sectors[k].points, i, j, d);
          cap.deviation = (std::max)(cap.deviation, std::abs(direction.dot(
            d[0] - sample(cap, data, k, i, j))));
          cap.is_regular = cap.is_regular && direction.dot(d[1].cross(d[2])) > 0;
        }
  }

  // values and derivatives of biquintic pieces at the samples
  struct Bernstein_table
  {
    Eigen::MatrixXd value, derivative;

    Bernstein_table() : value(INTERVALS + 1, 6), derivative(INTERVALS + 1, 6)
    {
      for(int i = 0; i <= INTERVALS; ++i)
      {
        value.row(i) = Cap_operator::bernstein(5, i / double(INTERVALS)).transpose();
        Eigen::RowVectorXd lower(7);
        lower << 0, Cap_operator::bernstein(4, i / double(INTERVALS)).transpose(), 0;
        derivative.row(i) = 5 * (lower.head(6) - lower.tail(6));
      }
    }

    void evaluate(const Biquintic& points, int i, int j, std::array<Eigen::Vector3d, 3>& d) const
    {
      d.fill(Eigen::Vector3d::Zero());
      for(int b = 0; b < 6; ++b)
        for(int a = 0; a < 6; ++a)
        {
          d[0] += value(i, a) * value(j, b) * points[6 * b + a];
          d[1] += derivative(i, a) * value(j, b) * points[6 * b + a];
          d[2] += value(i, a) * derivative(j, b) * points[6 * b + a];
        }
    }
  };

  const Cell_complex& m_complex;
  const Position& m_position;
  Settings m_settings;
  std::vector<std::vector<std::size_t> > m_cells_of_quad;
  std::vector<char> m_is_covered;
  std::vector<Cap> m_caps;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CAP_BUILDER_H
