// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_PARTITION_IMPROVER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_PARTITION_IMPROVER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_block.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_rectangle.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/is_smooth_segment.h>

#include <CGAL/Random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Improves a partition of cells into rectangles, such that the faces are few and their file is
/// small, by simulated annealing. In a move, a rectangle grows over one of its sides: a rectangle
/// of the same width is cut out of those beside it, and what is left of them joins others where
/// that pays. A cut and a joint change edges and vertices at their two ends only, so that the
/// change of the file is known without a look at the rest.
class Partition_improver
{
public:
  Partition_improver(const Cell_complex& complex, Smooth_segments& is_smooth)
    : m_complex(complex), m_is_smooth(is_smooth), m_outline_check(complex),
      m_face_of_cell(complex.cells().size(), NO_INDEX), m_frame_of_cell(complex.cells().size()),
      m_segments_of_vertex(complex.number_of_vertices())
  {
    for(std::size_t i = 0; i < complex.segments().size(); ++i)
      for(std::size_t v : complex.segments()[i].vertex)
        m_segments_of_vertex[v].push_back(i);
  }

  void operator()(std::vector<Cell_rectangle>& faces)
  {
    for(const Cell_rectangle& face : faces)
      if(!is_movable(face))
        add(face);
    m_first_movable = m_faces.size();
    for(const Cell_rectangle& face : faces)
      if(is_movable(face))
        add(face);
    if(!(anneal() < 0))
      return;
    faces.clear();
    for(const auto& face : m_faces)
      if(face)
        faces.push_back(face->block.rectangle);
  }

private:
  struct Face
  {
    Cell_block block;
    double cost; // without its edges
  };

  // a face along a whole side of another; `frame` takes its coordinates to those of the other
  struct Neighbor
  {
    std::size_t face = NO_INDEX;
    Tick_frame frame;
  };

  // What parts of a file take, in records of the size of a control point with a reference to it
  // (93 bytes on average): a face without edges; an edge with its two uses and the first of its
  // inner points, a further point of it, and a vertex. A face counts three times what it takes, as
  // kernels like few faces; this makes the files of the test cases no larger.
  static constexpr double POINTS_PER_FACE = 10;
  static constexpr double POINTS_PER_EDGE = 3.6;
  static constexpr double POINTS_PER_SEGMENT = 1.1;
  static constexpr double POINTS_PER_VERTEX = 1.4;

  // Kernels and mesh generators have difficulties with slivers: each width by which a face is
  // longer than so many counts as so many points.
  static constexpr double LONG_FACE = 8;
  static constexpr double POINTS_PER_WIDTH = 4;

  // In the units of the cost. At the first temperature faces are cut for nothing now and then, at
  // the last one nothing becomes larger.
  static constexpr double FIRST_TEMPERATURE = 40;
  static constexpr double LAST_TEMPERATURE = 0.3;

  // ten times as many save one percent of the file
  static constexpr std::size_t NUMBER_OF_MOVES = 1000;
  static constexpr std::size_t NUMBER_OF_MOVES_PER_FACE = 100;

  // one move of so many only cuts a face, the others let one grow
  static constexpr int MOVES_PER_CUT = 8;

  // is it neither a cap nor beside a crease?
  bool is_movable(const Cell_rectangle& face) const
  {
    return is_mergeable(m_complex.cells()[face.cells.front().cell]);
  }

  bool is_movable(std::size_t face) const { return face >= m_first_movable; }

  // of a face with so many breaks and extents along its axes, without its edges; the knots of the
  // B-splines are simple inside
  static double cost(const std::array<double, 2>& breaks, const std::array<double, 2>& extents)
  {
    const double widths = (std::max)(extents[0], extents[1]) / (std::min)(extents[0], extents[1]);
    return POINTS_PER_FACE + (breaks[0] + 2) * (breaks[1] + 2)
         + POINTS_PER_WIDTH * (std::max)(0., widths - LONG_FACE);
  }

  static double cost(const Cell_block& block)
  {
    return cost({{double(block.breaks[0].size()), double(block.breaks[1].size())}},
                {{double(block.rectangle.bounds.extent(0)),
                  double(block.rectangle.bounds.extent(1))}});
  }

  // returns the change of the cost
  double anneal()
  {
    const std::size_t number_of_faces = m_faces.size() - m_first_movable;
    if(number_of_faces < 2)
      return 0;
    const std::size_t n = NUMBER_OF_MOVES + NUMBER_OF_MOVES_PER_FACE * number_of_faces;
    CGAL::Random random(0);
    double sum = 0;
    for(std::size_t i = 0; i < n; ++i)
    {
      const double temperature = FIRST_TEMPERATURE
        * std::pow(LAST_TEMPERATURE / FIRST_TEMPERATURE, double(i) / double(n));
      const std::size_t f
        = m_first_movable + random.get_int(0, int(m_faces.size() - m_first_movable));
      begin_move();
      const bool is_possible = m_faces[f] && move(f, random);
      if(is_possible
         && (m_change < 0 || random.get_double() < std::exp(-m_change / temperature)))
        sum += m_change;
      else
        undo_move();
    }
    return sum;
  }

  // Returns `false` if it turns out on the way that the move is not possible.
  bool move(std::size_t f, CGAL::Random& random)
  {
    const int side = random.get_int(0, 4);
    const bool is_cut = (random.get_int(0, MOVES_PER_CUT) == 0);
    return is_cut ? divide(f, side & 1, random) : grow(f, side, random);
  }

  // Cuts a face somewhere.
  bool divide(std::size_t f, int axis, CGAL::Random& random)
  {
    const std::vector<std::int64_t>& breaks = block(f).breaks[axis];
    if(breaks.size() == 2)
      return false;
    const std::int64_t level = breaks[random.get_int(1, int(breaks.size()) - 1)];
    if(!is_line(f, axis, level))
      return false;
    for(std::size_t part : cut(f, axis, level))
      m_rest.push_back(part);
    join_rest();
    return true;
  }

  // Lets a face grow over a side. Returns `false` if it turns out on the way that it cannot.
  bool grow(std::size_t f, int side, CGAL::Random& random)
  {
    std::vector<Neighbor> beside;
    if(!find_neighbors(f, side, beside))
      return false;
    const std::vector<std::int64_t> levels = common_levels(beside, side, f);
    if(levels.empty())
      return false;
    const bool is_farthest = random.get_bool();
    const std::size_t level = random.get_int(0, int(levels.size()));
    const int first_axis = random.get_int(0, 2);
    const Tick_rectangle strip = strip_to(bounds(f), side, levels[is_farthest ? 0 : level]);
    for(Neighbor& n : beside)
    {
      const Tick_rectangle part = common_part(strip, n.frame(bounds(n.face)));
      if(!cut_out(n.face, n.frame.inverse()(part), first_axis))
        return false;
    }
    std::size_t joined = beside.front().face;
    for(std::size_t i = 1; i < beside.size(); ++i)
      if(!join_faces(joined, beside[i].face))
        return false;
    if(!join_faces(f, joined))
      return false;
    m_rest.push_back(f);
    join_rest();
    return true;
  }

  const Cell_block& block(std::size_t f) const { return m_faces[f]->block; }
  const Tick_rectangle& bounds(std::size_t f) const { return block(f).rectangle.bounds; }

  std::size_t face_of_cell(std::size_t cell) const
  {
    return (cell == NO_INDEX) ? NO_INDEX : m_face_of_cell[cell];
  }

  // the frame of the face across a segment, in the plane of the face with the cell on this side
  Tick_frame frame_of_neighbor(const Placed_cell& placed,
                               const Cell_complex::Segment_use& use) const
  {
    return placed.frame.after(m_complex.frame_across_segment(use))
      .after(m_frame_of_cell[m_complex.across(use).cell].inverse());
  }

  // The faces over which a face could grow, in their order along the side. Returns `false` if it
  // cannot.
  bool find_neighbors(std::size_t f, int side, std::vector<Neighbor>& result)
  {
    for(const Placed_cell& placed : block(f).rim[side])
      for(const auto& use : m_complex.uses(placed.cell, cell_side(placed, side)))
      {
        const std::size_t g = face_of_cell(m_complex.across(use).cell);
        if(g == NO_INDEX || g == f || !is_movable(g) || !m_is_smooth(use.segment))
          return false;
        const Tick_frame frame = frame_of_neighbor(placed, use);
        const auto known = std::find_if(result.begin(), result.end(),
                                        [g](const Neighbor& n) { return n.face == g; });
        if(known == result.end())
          result.push_back({g, frame});
        else if(!(known->frame == frame)) // it winds round a handle
          return false;
      }
    auto begin = [this, side](const Neighbor& n)
    { return n.frame(bounds(n.face)).low[side & 1]; };
    std::sort(result.begin(), result.end(), [&begin](const Neighbor& a, const Neighbor& b)
              { return begin(a) < begin(b); });
    return true;
  }

  // To where the face may grow: coordinates of cell sides that all faces beside it have, the
  // farthest one first.
  std::vector<std::int64_t> common_levels(const std::vector<Neighbor>& beside, int side,
                                          std::size_t f) const
  {
    const int axis = (side + 1) & 1;
    std::vector<std::int64_t> result;
    for(const Neighbor& n : beside)
    {
      const std::vector<std::int64_t> breaks = placed_breaks(block(n.face), n.frame, axis);
      std::vector<std::int64_t> common;
      std::set_intersection(breaks.begin(), breaks.end(), result.begin(), result.end(),
                            std::back_inserter(common));
      result = (&n == &beside.front()) ? breaks : common;
    }
    result.erase(std::find(result.begin(), result.end(), side_level(bounds(f), side)));
    if(side == 1 || side == 2)
      std::reverse(result.begin(), result.end());
    return result;
  }

  static Tick_rectangle strip_to(const Tick_rectangle& bounds, int side, std::int64_t level)
  {
    Tick_rectangle result = bounds;
    const int axis = (side + 1) & 1;
    result.low[axis] = (std::min)(level, side_level(bounds, side));
    result.high[axis] = (std::max)(level, side_level(bounds, side));
    return result;
  }

  static Tick_rectangle common_part(const Tick_rectangle& a, const Tick_rectangle& b)
  {
    Tick_rectangle result;
    for(int axis = 0; axis < 2; ++axis)
    {
      result.low[axis] = (std::max)(a.low[axis], b.low[axis]);
      result.high[axis] = (std::min)(a.high[axis], b.high[axis]);
    }
    return result;
  }

  // Cuts a rectangle out of a face, which becomes that rectangle. Returns `false` if cells are in
  // the way.
  bool cut_out(std::size_t& f, const Tick_rectangle& rectangle, int first_axis)
  {
    for(int axis : {first_axis, 1 - first_axis})
      for(int end = 0; end < 2; ++end)
      {
        const std::int64_t level = (end == 0) ? rectangle.low[axis] : rectangle.high[axis];
        if(level == ((end == 0) ? bounds(f).low[axis] : bounds(f).high[axis]))
          continue;
        if(!is_line(f, axis, level))
          return false;
        const std::array<std::size_t, 2> parts = cut(f, axis, level);
        f = parts[1 - end];
        m_rest.push_back(parts[end]);
      }
    return true;
  }

  // does no cell reach across?
  bool is_line(std::size_t f, int axis, std::int64_t level) const
  {
    for(const Placed_cell& placed : block(f).rectangle.cells)
    {
      const Tick_rectangle r = placed_rectangle(m_complex, placed);
      if(r.low[axis] < level && level < r.high[axis])
        return false;
    }
    return true;
  }

  std::array<std::size_t, 2> cut(std::size_t f, int axis, std::int64_t level)
  {
    const Cell_rectangle& whole = take(f).block.rectangle;
    std::array<Cell_rectangle, 2> parts;
    for(const Placed_cell& placed : whole.cells)
      parts[placed_rectangle(m_complex, placed).low[axis] < level ? 0 : 1].cells.push_back(placed);
    parts[0].bounds = parts[1].bounds = whole.bounds;
    parts[0].bounds.high[axis] = parts[1].bounds.low[axis] = level;
    const std::array<std::size_t, 2> result = {{add(parts[0]), add(parts[1])}};
    const int side = (axis == 0) ? 1 : 2;
    m_change -= change_by_joint(result[0], side, neighbor(result[0], side));
    return result;
  }

  // the face along the whole side of another, if there is one
  Neighbor neighbor(std::size_t f, int side) const
  {
    Neighbor result;
    for(const Placed_cell& placed : block(f).rim[side])
      for(const auto& use : m_complex.uses(placed.cell, cell_side(placed, side)))
      {
        const std::size_t g = face_of_cell(m_complex.across(use).cell);
        if(g == NO_INDEX || g == f || !is_movable(g)
           || (result.face != NO_INDEX && g != result.face))
          return Neighbor();
        if(result.face == NO_INDEX)
          result = {g, frame_of_neighbor(placed, use)};
      }
    const Tick_rectangle r = result.frame(bounds(result.face));
    const int along = side & 1;
    const bool is_whole = r.low[along] == bounds(f).low[along]
                       && r.high[along] == bounds(f).high[along]
                       && side_level(r, (side + 2) & 3) == side_level(bounds(f), side);
    return is_whole ? result : Neighbor();
  }

  // The change of the cost if two faces become one. The edge between them vanishes; where it ends
  // at a vertex with two further edges, these become one.
  double change_by_joint(std::size_t f, int side, const Neighbor& n) const
  {
    std::array<double, 2> breaks, extents;
    for(int axis = 0; axis < 2; ++axis)
    {
      breaks[axis] = double(united(block(f).breaks[axis],
                                   placed_breaks(block(n.face), n.frame, axis)).size());
      extents[axis] = double(bounds(f).extent(axis));
    }
    extents[(side + 1) & 1] += double(n.frame(bounds(n.face)).extent((side + 1) & 1));
    double result = cost(breaks, extents) - m_faces[f]->cost - m_faces[n.face]->cost
                  - POINTS_PER_EDGE;
    for(const Placed_cell& placed : block(f).rim[side])
    {
      const auto& uses = m_complex.uses(placed.cell, cell_side(placed, side));
      result -= POINTS_PER_SEGMENT * double(uses.size());
      for(int end = 0; end < 2; ++end)
      {
        const std::size_t v
          = (end == 0) ? m_complex.source(uses.front()) : m_complex.target(uses.back());
        if(is_at_end(f, side, placed, end) && degree(v) == 3)
          result -= POINTS_PER_EDGE + POINTS_PER_VERTEX;
      }
    }
    return result;
  }

  // is it the first (0) or last (1) cell along a side, counter clockwise?
  bool is_at_end(std::size_t f, int side, const Placed_cell& placed, int end) const
  {
    const Tick_rectangle r = placed_rectangle(m_complex, placed);
    const int along = side & 1;
    return ((side < 2) == (end == 0)) ? r.low[along] == bounds(f).low[along]
                                      : r.high[along] == bounds(f).high[along];
  }

  // the number of edges at a vertex
  int degree(std::size_t v) const
  {
    int result = 0;
    for(std::size_t i : m_segments_of_vertex[v])
    {
      const auto& sides = m_complex.segments()[i].sides;
      if(face_of_cell(sides[0].cell) != face_of_cell(sides[1].cell))
        ++result;
    }
    return result;
  }

  bool is_allowed(std::size_t f, int side, const Neighbor& n)
  {
    for(const Placed_cell& placed : block(f).rim[side])
      for(const auto& use : m_complex.uses(placed.cell, cell_side(placed, side)))
        if(!m_is_smooth(use.segment))
          return false;
    return !m_outline_check.touches_itself(
      block(f), side, block(n.face), (side + 2 - n.frame.turns + 4) & 3, [&](std::size_t cell)
    { return m_face_of_cell[cell] == f || m_face_of_cell[cell] == n.face; });
  }

  // makes one face of two, with the index `f` from then on; returns `false` if they cannot be one
  bool join_faces(std::size_t& f, std::size_t g)
  {
    for(int side = 0; side < 4; ++side)
    {
      const Neighbor n = neighbor(f, side);
      if(n.face != g || !is_allowed(f, side, n))
        continue;
      f = join_neighbor(f, side, n);
      return true;
    }
    return false;
  }

  std::size_t join_neighbor(std::size_t f, int side, const Neighbor& n)
  {
    m_change += change_by_joint(f, side, n);
    auto face = std::make_unique<Face>(take(f));
    join(face->block, placed_block(take(n.face).block, n.frame), side);
    return add(std::move(face));
  }

  // joins what is left of faces with others, as long as that pays
  void join_rest()
  {
    while(!m_rest.empty())
    {
      const std::size_t f = m_rest.back();
      m_rest.pop_back();
      if(!m_faces[f])
        continue;
      double least = 0;
      int best_side = -1;
      for(int side = 0; side < 4; ++side)
      {
        const Neighbor n = neighbor(f, side);
        const double change = (n.face == NO_INDEX) ? 0 : change_by_joint(f, side, n);
        if(!(change < least) || !is_allowed(f, side, n))
          continue;
        least = change;
        best_side = side;
      }
      if(best_side >= 0)
        m_rest.push_back(join_neighbor(f, best_side, neighbor(f, best_side)));
    }
  }

  // adds a face with an index that is free; returns the index
  std::size_t add(std::unique_ptr<Face> face)
  {
    if(m_free.empty())
    {
      m_free.push_back(m_faces.size());
      m_faces.emplace_back();
    }
    const std::size_t f = m_free.back();
    m_free.pop_back();
    m_log.emplace_back(f, nullptr);
    face->cost = cost(face->block);
    put(f, std::move(face));
    return f;
  }

  std::size_t add(const Cell_rectangle& cells)
  {
    return add(std::make_unique<Face>(Face{cell_block(m_complex, cells), 0}));
  }

  void put(std::size_t f, std::unique_ptr<Face> face)
  {
    for(const Placed_cell& placed : face->block.rectangle.cells)
    {
      m_face_of_cell[placed.cell] = f;
      m_frame_of_cell[placed.cell] = placed.frame;
    }
    m_faces[f] = std::move(face);
  }

  // takes a face away; it remains in the log
  const Face& take(std::size_t f)
  {
    m_log.emplace_back(f, std::move(m_faces[f]));
    m_free.push_back(f);
    return *m_log.back().second;
  }

  void begin_move()
  {
    m_log.clear();
    m_rest.clear();
    m_change = 0;
  }

  void undo_move()
  {
    for(; !m_log.empty(); m_log.pop_back())
    {
      const std::size_t f = m_log.back().first;
      if(m_log.back().second)
      {
        put(f, std::move(m_log.back().second));
        m_free.pop_back();
      }
      else
      {
        m_faces[f].reset();
        m_free.push_back(f);
      }
    }
  }

  const Cell_complex& m_complex;
  Smooth_segments& m_is_smooth;
  Outline_check m_outline_check;
  std::vector<std::unique_ptr<Face> > m_faces;
  std::vector<std::size_t> m_free; // indices without a face
  std::size_t m_first_movable = 0;
  std::vector<std::size_t> m_face_of_cell;
  std::vector<Tick_frame> m_frame_of_cell; // in its face
  std::vector<std::vector<std::size_t> > m_segments_of_vertex;
  // the move that is being tried: faces that were added (nothing) and taken away, in turn, what is
  // left of faces, and the change of the cost
  std::vector<std::pair<std::size_t, std::unique_ptr<Face> > > m_log;
  std::vector<std::size_t> m_rest;
  double m_change = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_PARTITION_IMPROVER_H
