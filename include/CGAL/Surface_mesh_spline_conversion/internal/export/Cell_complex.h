// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_COMPLEX_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_COMPLEX_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/blossoms.h>

#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// length of a side of a layout quad in the integer coordinates of the cells: all knots of a
/// T-NURCC surface are multiples of 2^-20, and virtual subdivision at extraordinary points needs
/// some more bits
constexpr std::int64_t QUAD_TICKS = std::int64_t(1) << 40;

constexpr std::size_t NO_INDEX = (std::numeric_limits<std::size_t>::max)();

typedef std::array<std::int64_t, 2> Tick_point;

struct Tick_rectangle
{
  Tick_point low;
  Tick_point high;

  std::int64_t extent(int axis) const { return high[axis] - low[axis]; }
};

/// a quarter turn and a translation
struct Tick_frame
{
  int turns = 0;
  Tick_point shift = {{0, 0}};

  Tick_point operator()(Tick_point p) const
  {
    for(int r = 0; r < turns; ++r)
      p = {{-p[1], p[0]}};
    return {{p[0] + shift[0], p[1] + shift[1]}};
  }

  Tick_rectangle operator()(const Tick_rectangle& r) const
  {
    const Tick_point a = (*this)(r.low), b = (*this)(r.high);
    return {{{(std::min)(a[0], b[0]), (std::min)(a[1], b[1])}},
            {{(std::max)(a[0], b[0]), (std::max)(a[1], b[1])}}};
  }

  Tick_frame inverse() const
  {
    Tick_frame result;
    result.turns = (4 - turns) & 3;
    const Tick_point p = result(shift);
    result.shift = {{-p[0], -p[1]}};
    return result;
  }

  /// returns this frame after `first`
  Tick_frame after(const Tick_frame& first) const
  {
    return {(turns + first.turns) & 3, (*this)(first.shift)};
  }

  bool operator==(const Tick_frame& other) const
  {
    return turns == other.turns && shift == other.shift;
  }
};

/// a rectangle of a layout quad with a polynomial; of a cap, only the rectangle
struct Cell
{
  std::size_t quad;
  Tick_rectangle rectangle;
  std::shared_ptr<const Bicubic> points; ///< shared by copies of the cell
  std::size_t patch;
  std::size_t cap = NO_INDEX; ///< index of the cap the cell belongs to, if any
  std::size_t sector = 0;     ///< of the cap or crease
  std::size_t crease = NO_INDEX; ///< index of the crease the cell lies beside, if any
  Tick_frame frame;           ///< takes coordinates of the quad to those of the crease
  bool is_end_of_crease = false; ///< must a cap follow?
};

/// may a cell share a face with others?
inline bool is_mergeable(const Cell& cell)
{
  return cell.cap == NO_INDEX && cell.crease == NO_INDEX;
}

/// how the layout quads hang together, by side: (quad, side), the quad `NO_INDEX` at the boundary
typedef std::vector<std::array<std::pair<std::size_t, int>, 4> > Quad_neighbors;

/// corner `i` of a layout quad
inline Tick_point quad_corner(int i)
{
  i &= 3;
  return {{i == 1 || i == 2 ? QUAD_TICKS : 0, i >= 2 ? QUAD_TICKS : 0}};
}

/// the frame that takes coordinates of the quad across side `i` to those of the quad, when `j` is
/// the number of the common side there
inline Tick_frame frame_across(int i, int j)
{
  Tick_frame frame;
  frame.turns = (i + 2 - j + 4) & 3;
  const Tick_point from = frame(quad_corner(j)), to = quad_corner(i + 1);
  frame.shift = {{to[0] - from[0], to[1] - from[1]}};
  return frame;
}

/// The cells of a surface with all incidences: where the sides of cells meet, they are cut to
/// segments that have one cell, or none, on either side.
class Cell_complex
{
public:
  struct Segment_side
  {
    std::size_t cell = NO_INDEX;
    double first = 0;     ///< where the segment lies on this side of the cell, counter clockwise
    double last = 1;
    int side = 0;         ///< of the cell, in the coordinates of its quad
    int quad_side = -1;   ///< side of the quad the segment lies on, or -1
  };

  /// runs from `vertex[0]` to `vertex[1]` with `sides[0]` on the left and `sides[1]` on the right
  struct Segment
  {
    std::array<std::size_t, 2> vertex;
    std::array<Segment_side, 2> sides;
  };

  /// a segment as seen from a cell: which of its sides is the cell's
  struct Segment_use
  {
    std::size_t segment;
    int which;
  };

  typedef boost::iterator_range<const Segment_use*> Segment_uses;

  Cell_complex(std::vector<Cell> cells, const Quad_neighbors& neighbors)
    : m_cells(std::move(cells)), m_neighbors(neighbors)
  {
    collect_lines();
    for(auto& line : m_lines)
      cut_line(line.first, line.second);
    m_number_of_vertices = m_vertices.size();
    m_lines.clear();
    m_vertices.clear();
    m_segments.shrink_to_fit();
    collect_uses();
  }

  const std::vector<Cell>& cells() const { return m_cells; }
  const std::vector<Segment>& segments() const { return m_segments; }
  const Quad_neighbors& neighbors() const { return m_neighbors; }
  std::size_t number_of_vertices() const { return m_number_of_vertices; }

  /// the segments along `side` of `cell`, counter clockwise
  Segment_uses uses(std::size_t cell, int side) const
  {
    const std::size_t i = side_index(cell, side);
    return Segment_uses(m_uses.data() + m_first_use[i], m_uses.data() + m_first_use[i + 1]);
  }

  /// the vertex where the use begins, as seen from its cell
  std::size_t source(const Segment_use& use) const { return m_segments[use.segment].vertex[use.which]; }

  std::size_t target(const Segment_use& use) const
  {
    return m_segments[use.segment].vertex[1 - use.which];
  }

  const Segment_side& here(const Segment_use& use) const
  {
    return m_segments[use.segment].sides[use.which];
  }

  const Segment_side& across(const Segment_use& use) const
  {
    return m_segments[use.segment].sides[1 - use.which];
  }

  /// the frame of the quad across the segment, in the coordinates of the quad of this side
  Tick_frame frame_across_segment(const Segment_use& use) const
  {
    if(here(use).quad_side < 0)
      return Tick_frame();
    return frame_across(here(use).quad_side, across(use).quad_side);
  }

private:
  // (quad, -1 - side) of a line between two quads, or (quad, axis, coordinate) of a line inside
  typedef std::tuple<std::size_t, int, std::int64_t> Line;
  typedef std::tuple<std::size_t, std::int64_t, std::int64_t> Point_key;

  struct Interval
  {
    std::int64_t first;
    std::int64_t last;
    std::size_t cell;
    int side;
    int quad_side;

    bool operator<(const Interval& other) const { return first < other.first; }
  };

  typedef std::array<std::vector<Interval>, 2> Line_sides;

  static std::int64_t side_coordinate(int side, const Tick_point& p)
  {
    return (side == 0) ? p[0] : (side == 1) ? p[1]
         : (side == 2) ? QUAD_TICKS - p[0] : QUAD_TICKS - p[1];
  }

  static Tick_point point_on_side(int side, std::int64_t t)
  {
    return (side == 0) ? Tick_point{{t, 0}} : (side == 1) ? Tick_point{{QUAD_TICKS, t}}
         : (side == 2) ? Tick_point{{QUAD_TICKS - t, QUAD_TICKS}}
         : Tick_point{{0, QUAD_TICKS - t}};
  }

  // a line between two quads belongs to the smaller of its two sides
  bool is_canonical(std::size_t quad, int side) const
  {
    const auto& other = m_neighbors[quad][side];
    return other.first == NO_INDEX || std::make_pair(quad, side) <= other;
  }

  void collect_lines()
  {
    for(std::size_t c = 0; c < m_cells.size(); ++c)
      for(int side = 0; side < 4; ++side)
        add_to_line(c, side);
  }

  void add_to_line(std::size_t c, int side)
  {
    const Cell& cell = m_cells[c];
    const int axis = (side + 1) & 1; // the axis along which the line is constant
    const std::int64_t level
      = (side == 1 || side == 2) ? cell.rectangle.high[axis] : cell.rectangle.low[axis];
    if(level != 0 && level != QUAD_TICKS)
    {
      const int which = (side == 0 || side == 1) ? 0 : 1;
      m_lines[Line(cell.quad, axis, level)][which].push_back(
        {cell.rectangle.low[1 - axis], cell.rectangle.high[1 - axis], c, side, -1});
      return;
    }
    std::int64_t a = side_coordinate(side, cell.rectangle.low);
    std::int64_t b = side_coordinate(side, cell.rectangle.high);
    if(is_canonical(cell.quad, side))
      m_lines[Line(cell.quad, -1 - side, 0)][0].push_back(
        {(std::min)(a, b), (std::max)(a, b), c, side, side});
    else
    {
      const auto& other = m_neighbors[cell.quad][side];
      a = QUAD_TICKS - a;
      b = QUAD_TICKS - b;
      m_lines[Line(other.first, -1 - other.second, 0)][1].push_back(
        {(std::min)(a, b), (std::max)(a, b), c, side, side});
    }
  }

  // cuts a line at the ends of the sides on its left and its right
  void cut_line(const Line& line, Line_sides& sides)
  {
    std::vector<std::int64_t> cuts;
    for(auto& intervals : sides)
    {
      std::sort(intervals.begin(), intervals.end());
      for(const Interval& i : intervals)
      {
        cuts.push_back(i.first);
        cuts.push_back(i.last);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());

    std::array<std::size_t, 2> next = {{0, 0}};
    for(std::size_t k = 0; k + 1 < cuts.size(); ++k)
    {
      Segment segment;
      bool is_covered = false;
      for(int which = 0; which < 2; ++which)
      {
        while(next[which] < sides[which].size() && sides[which][next[which]].last <= cuts[k])
          ++next[which];
        if(next[which] == sides[which].size() || sides[which][next[which]].first > cuts[k])
          continue;
        segment.sides[which]
          = segment_side(sides[which][next[which]], which, cuts[k], cuts[k + 1]);
        is_covered = true;
      }
      if(is_covered)
        add_segment(line, segment, cuts[k], cuts[k + 1]);
    }
  }

  static Segment_side segment_side(const Interval& interval, int which, std::int64_t a,
                                   std::int64_t b)
  {
    const double length = double(interval.last - interval.first);
    Segment_side result;
    result.cell = interval.cell;
    result.side = interval.side;
    result.quad_side = interval.quad_side;
    result.first = double((which == 0) ? a - interval.first : interval.last - b) / length;
    result.last = double((which == 0) ? b - interval.first : interval.last - a) / length;
    return result;
  }

  void add_segment(const Line& line, Segment& segment, std::int64_t a, std::int64_t b)
  {
    segment.vertex = {{vertex_on_line(line, a), vertex_on_line(line, b)}};
    // a segment with a cell on its right only is turned round
    if(segment.sides[0].cell == NO_INDEX)
    {
      std::swap(segment.sides[0], segment.sides[1]);
      std::swap(segment.vertex[0], segment.vertex[1]);
    }
    m_segments.push_back(segment);
  }

  static std::size_t side_index(std::size_t cell, int side) { return 4 * cell + std::size_t(side); }

  // sorts the sides of segments by the sides of cells, counter clockwise
  void collect_uses()
  {
    m_first_use.assign(4 * m_cells.size() + 1, 0);
    for_each_use([this](const Segment_use& use)
      { ++m_first_use[side_index(here(use).cell, here(use).side) + 1]; });
    std::partial_sum(m_first_use.begin(), m_first_use.end(), m_first_use.begin());
    m_uses.resize(m_first_use.back());
    std::vector<std::size_t> next = m_first_use;
    for_each_use([&](const Segment_use& use)
      { m_uses[next[side_index(here(use).cell, here(use).side)]++] = use; });
    for(std::size_t i = 0; i + 1 < m_first_use.size(); ++i)
      std::sort(m_uses.begin() + std::ptrdiff_t(m_first_use[i]),
                m_uses.begin() + std::ptrdiff_t(m_first_use[i + 1]),
                [this](const Segment_use& a, const Segment_use& b)
                { return here(a).first < here(b).first; });
  }

  template <typename Visitor>
  void for_each_use(const Visitor& visit) const
  {
    for(std::size_t i = 0; i < m_segments.size(); ++i)
      for(int which = 0; which < 2; ++which)
        if(m_segments[i].sides[which].cell != NO_INDEX)
          visit(Segment_use{i, which});
  }

  std::size_t vertex_on_line(const Line& line, std::int64_t t)
  {
    const int kind = std::get<1>(line);
    const std::int64_t level = std::get<2>(line);
    const Tick_point p = (kind < 0) ? point_on_side(-1 - kind, t)
                       : (kind == 0) ? Tick_point{{level, t}} : Tick_point{{t, level}};
    return m_vertices.emplace(canonical_point(std::get<0>(line), p), m_vertices.size())
      .first->second;
  }

  // the smallest name of a point: points on sides have two, layout vertices as many as quads
  Point_key canonical_point(std::size_t quad, const Tick_point& p) const
  {
    Point_key best(quad, p[0], p[1]);
    for(int side = 0; side < 4; ++side)
    {
      if(point_on_side(side, side_coordinate(side, p)) != p)
        continue;
      const std::int64_t t = side_coordinate(side, p);
      if(t == 0)
        return canonical_corner(quad, side);
      const auto& other = m_neighbors[quad][side];
      if(t == QUAD_TICKS || other.first == NO_INDEX)
        continue;
      const Tick_point q = point_on_side(other.second, QUAD_TICKS - t);
      best = (std::min)(best, Point_key(other.first, q[0], q[1]));
    }
    return best;
  }

  // walks round a layout vertex, in both directions if there is a boundary
  Point_key canonical_corner(std::size_t quad, int corner) const
  {
    std::pair<std::size_t, int> best(quad, corner);
    for(int direction = 0; direction < 2; ++direction)
    {
      std::pair<std::size_t, int> at(quad, corner);
      do
      {
        best = (std::min)(best, at);
        at = (direction == 0) ? next_sector(m_neighbors, at) : previous_sector(m_neighbors, at);
      }
      while(at.first != NO_INDEX && at != std::make_pair(quad, corner));
      if(at.first != NO_INDEX)
        break;
    }
    const Tick_point p = quad_corner(best.second);
    return Point_key(best.first, p[0], p[1]);
  }

public:
  /// the next corner of a quad counter clockwise round a layout vertex; its quad is `NO_INDEX` at
  /// the boundary
  static std::pair<std::size_t, int> next_sector(const Quad_neighbors& neighbors,
                                                 const std::pair<std::size_t, int>& corner)
  {
    return neighbors[corner.first][(corner.second + 3) & 3];
  }

  static std::pair<std::size_t, int> previous_sector(const Quad_neighbors& neighbors,
                                                     const std::pair<std::size_t, int>& corner)
  {
    auto side = neighbors[corner.first][corner.second];
    if(side.first != NO_INDEX)
      side.second = (side.second + 1) & 3;
    return side;
  }

private:
  std::vector<Cell> m_cells;
  Quad_neighbors m_neighbors;
  std::map<Line, Line_sides> m_lines;
  std::map<Point_key, std::size_t> m_vertices;
  std::vector<Segment> m_segments;
  std::vector<Segment_use> m_uses;
  std::vector<std::size_t> m_first_use; // of the sides of the cells
  std::size_t m_number_of_vertices = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_COMPLEX_H
