// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_SHELL_ASSEMBLER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_SHELL_ASSEMBLER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/caps/Cap_builder.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/caps/Crease_builder.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_rectangle.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/blossoms.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/graded_breaks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// The control points of the C2 cubic B-spline with `breaks` as simple knots: blossoms at three
/// consecutive knots. `piece(i)` is the polynomial on span i with its first and last parameter; it
/// may reach beyond the span.
inline Blossom_arguments control_point_arguments(const std::vector<double>& breaks, std::size_t i)
{
  auto knot = [&breaks](std::size_t k)
  { return breaks[(k < 3) ? 0 : (std::min)(k - 3, breaks.size() - 1)]; };
  return {{knot(i + 1), knot(i + 2), knot(i + 3)}};
}

/// the span whose polynomial gives control point `i`: one in the middle of its support
inline std::size_t control_point_span(const std::vector<double>& breaks, std::size_t i)
{
  return (i < 2) ? 0 : (std::min)(i - 2, breaks.size() - 2);
}

inline Blossom_arguments normalized(Blossom_arguments t, double first, double last)
{
  for(double& x : t)
    x = (x - first) / (last - first);
  return t;
}

/// a point on side `side` of a quad on the boundary, `parameter` counter clockwise in [0,1]
struct Boundary_point
{
  std::size_t quad;
  int side;
  double parameter;
};

/// turns the faces of caps so that the extraordinary point is at the smallest parameters
inline void turn_caps(const Cell_complex& complex, const std::vector<Cap>& caps,
                      std::vector<Cell_rectangle>& faces)
{
  for(Cell_rectangle& face : faces)
  {
    const Cell& cell = complex.cells()[face.cells.front().cell];
    if(cell.cap == NO_INDEX)
      continue;
    face.cells.front().frame.turns = (4 - caps[cell.cap].sectors[cell.sector].corner) & 3;
    face.bounds = face.cells.front().frame(cell.rectangle);
  }
}

/// Builds vertices, edges and faces of a shell from rectangles of cells. A vertex stands at every
/// corner of a face and wherever more than two faces, or the boundary and two faces, meet; between
/// vertices the two faces share one edge.
template <typename K>
class Shell_assembler
{
  typedef NURBS_shell_3<K> Shell;
  typedef Cell_complex::Segment_use Segment_use;
  typedef typename K::Point_3 Point_3;

public:
  Shell_assembler(const Cell_complex& complex, const std::vector<Cap>& caps,
                  const std::vector<Crease>& creases)
    : m_complex(complex), m_caps(caps), m_creases(creases)
  {}

  /// \param faces those of caps have the extraordinary point at the smallest parameters, see
  ///        `turn_caps()`
  /// \param breaks the knots of the faces; those of creases do not count
  /// \param boundary_points where the boundary must have further vertices
  void operator()(const std::vector<Cell_rectangle>& faces, const std::vector<Face_breaks>& breaks,
                  const std::vector<Boundary_point>& boundary_points, Shell& shell)
  {
    m_is_node.assign(m_complex.number_of_vertices(), false);
    for(const Boundary_point& point : boundary_points)
      add_node(point);
    std::vector<Loop> loops(faces.size());
    for(std::size_t f = 0; f < faces.size(); ++f)
      loops[f] = loop(faces[f]);
    mark_nodes(loops);
    divide_boundary_edges(loops);

    m_vertex.assign(m_is_node.size(), NO_INDEX);
    m_edge_of_segment.assign(m_complex.segments().size(), NO_INDEX);
    for(std::size_t f = 0; f < faces.size(); ++f)
      add_face(faces[f], breaks[f], loops[f], shell);
  }

private:
  // a segment, or the part of it between two further vertices, as fractions in its direction
  struct Piece
  {
    Segment_use use;
    double first;
    double last;
    std::size_t source;
    std::size_t target;
  };

  typedef std::array<std::vector<Piece>, 4> Loop; // one run for each side of the face
  typedef typename std::vector<Piece>::const_iterator Piece_iterator;

  // the longest boundary edge, in lengths of its shortest span
  static constexpr double LARGEST_EDGE = 16, LARGEST_PLANAR_EDGE = 64;

  // Turns a point of the boundary into a node: the vertex of the complex there, or a new one that
  // cuts a segment.
  void add_node(const Boundary_point& point)
  {
    constexpr double CLOSE = 1e-9; // in sides of quads; shorter edges make no sense
    const std::vector<Cell_complex::Segment>& segments = m_complex.segments();
    for(std::size_t i = 0; i < segments.size(); ++i)
    {
      const Cell_complex::Segment_side& left = segments[i].sides[0];
      if(segments[i].sides[1].cell != NO_INDEX || left.quad_side != point.side
         || m_complex.cells()[left.cell].quad != point.quad)
        continue;
      const Tick_rectangle& r = m_complex.cells()[left.cell].rectangle;
      const int axis = point.side & 1;
      const double begin = (point.side < 2) ? r.low[axis] : QUAD_TICKS - r.high[axis];
      const double extent = double(r.extent(axis)) * (left.last - left.first);
      const double first = begin + double(r.extent(axis)) * left.first;
      const double fraction = (point.parameter * double(QUAD_TICKS) - first) / extent;
      const double close = CLOSE * double(QUAD_TICKS) / extent;
      if(fraction < -close || fraction > 1 + close)
        continue;
      if(fraction < close || fraction > 1 - close)
        m_is_node[segments[i].vertex[fraction < close ? 0 : 1]] = true;
      else
      {
        m_cuts[i].insert({fraction, m_is_node.size()});
        m_is_node.push_back(true);
      }
      return;
    }
  }

  void append_pieces(const Segment_use& use, std::vector<Piece>& pieces) const
  {
    Piece piece = {use, 0, 1, m_complex.source(use), m_complex.target(use)};
    const auto cuts = m_cuts.find(use.segment);
    if(cuts != m_cuts.end())
      for(const auto& cut : cuts->second)
      {
        const std::size_t target = piece.target;
        piece.last = cut.first;
        piece.target = cut.second;
        pieces.push_back(piece);
        piece.first = piece.last;
        piece.source = piece.target;
        piece.last = 1;
        piece.target = target;
      }
    pieces.push_back(piece);
  }

  const Cap_sector& sector(const Cell& cell) const { return m_caps[cell.cap].sectors[cell.sector]; }

  Loop loop(const Cell_rectangle& face) const
  {
    Loop result;
    for(int side = 0; side < 4; ++side)
      for(const Placed_cell& placed : cells_on_side(m_complex, face, side))
        for(const Segment_use& use : m_complex.uses(placed.cell, cell_side(placed, side)))
          append_pieces(use, result[side]);
    return result;
  }

  void mark_nodes(const std::vector<Loop>& loops)
  {
    std::vector<char> is_outline(m_complex.segments().size(), false);
    std::vector<int> degree(m_is_node.size(), 0);
    for(const Loop& loop : loops)
      for(const auto& side : loop)
      {
        m_is_node[side.front().source] = true;
        for(const Piece& piece : side)
          if(!is_outline[piece.use.segment])
          {
            is_outline[piece.use.segment] = true;
            ++degree[m_complex.source(piece.use)];
            ++degree[m_complex.target(piece.use)];
          }
      }
    for(std::size_t v = 0; v < degree.size(); ++v)
      if(degree[v] > 2)
        m_is_node[v] = true;
  }

  // Where kernels compute or check the curve of an edge on the face beside the shell, they look at
  // evenly spaced parameters, Open CASCADE at 23 of them to check, and miss what happens in much
  // shorter spans. Edges in planes have such curves without any deviation if the face is in the same
  // plane, as it often is; they may be longer.
  void divide_boundary_edges(const std::vector<Loop>& loops)
  {
    for(const Loop& loop : loops)
      for(const auto& side : loop)
        for(Piece_iterator begin = side.begin(), end; begin != side.end(); begin = end)
        {
          end = end_of_run(begin, side.end());
          if(m_complex.across(begin->use).cell == NO_INDEX)
            divide(begin, end);
        }
  }

  // makes nodes of knots of a run next to its middle until no part is too long
  void divide(Piece_iterator begin, Piece_iterator end)
  {
    double total = 0, shortest = (std::numeric_limits<double>::max)();
    for(Piece_iterator piece = begin; piece != end; ++piece)
    {
      total += length(*piece);
      shortest = (std::min)(shortest, length(*piece));
    }
    if(total <= LARGEST_EDGE * shortest
       || (total <= LARGEST_PLANAR_EDGE * shortest && is_planar(begin, end)))
      return;
    Piece_iterator middle = begin;
    for(double before = 0; before + length(*middle) / 2 < total / 2 || middle == begin; ++middle)
      before += length(*middle);
    m_is_node[middle->source] = true;
    divide(begin, middle);
    divide(middle, end);
  }

  bool is_planar(Piece_iterator begin, Piece_iterator end) const
  {
    constexpr double FLAT = 1e-9; // of the extent; curves in planes are fitted to rounding
    typedef Eigen::Vector3d Vector;
    const Vector origin = cubic(begin->use).front();
    std::vector<Vector> points;
    for(Piece_iterator piece = begin; piece != end; ++piece)
      for(const Vector& p : cubic(piece->use))
        points.push_back(p - origin);
    const auto farthest = [&points](const auto& distance)
    {
      return *std::max_element(points.begin(), points.end(),
                               [&distance](const Vector& p, const Vector& q)
                               { return distance(p) < distance(q); });
    };
    const Vector u = farthest([](const Vector& p) { return p.norm(); });
    const Vector v = farthest([&u](const Vector& p) { return u.cross(p).norm(); });
    const Vector normal = u.cross(v).normalized();
    const auto height = [&normal](const Vector& p) { return std::abs(normal.dot(p)); };
    return height(farthest(height)) <= FLAT * u.norm();
  }

  Piece_iterator end_of_run(Piece_iterator begin, Piece_iterator end) const
  {
    return std::find_if(begin + 1, end,
                        [this](const Piece& piece) { return m_is_node[piece.source]; });
  }

  void add_face(const Cell_rectangle& cells, const Face_breaks& breaks, const Loop& loop,
                Shell& shell)
  {
    typename Shell::Face face;
    const Cell& first = m_complex.cells()[cells.cells.front().cell];
    face.is_extraordinary = (first.cap != NO_INDEX);
    face.patch = first.patch;
    face.crease = (first.crease == NO_INDEX) ? Shell::null : first.crease;
    face.surface = face.is_extraordinary ? cap_surface(first, in_quads(breaks))
                 : first.crease != NO_INDEX ? crease_surface(first)
                 : merged_surface(cells, breaks, face.patch);
    for(const auto& side : loop)
      for(Piece_iterator begin = side.begin(), end; begin != side.end(); begin = end)
      {
        end = end_of_run(begin, side.end());
        face.loop.push_back(oriented_edge({begin, end}, shell));
      }
    if(face.is_extraordinary)
      take_edges(shell, face);
    shell.add_face(std::move(face));
  }

  // Gives a sector of a cap the very points of the edges on its whole sides; its own differ from
  // them by rounding. Sides 0 and 3, between two sectors, are always whole. Where the sector has
  // further knots, it keeps its own points.
  static void take_edges(const Shell& shell, typename Shell::Face& face)
  {
    for(int side = 0; side < 4; ++side)
    {
      if(face.loop.size() != 4 && side % 3 != 0)
        continue;
      const auto& use = (side == 3) ? face.loop.back() : face.loop[side];
      std::vector<std::size_t> indices = face.surface.indices_on_side(side);
      const std::vector<Point_3>& points = shell.edge(use.edge).curve.control_points;
      if(indices.size() != points.size())
        continue;
      if(!use.is_forward)
        std::reverse(indices.begin(), indices.end());
      for(std::size_t i = 0; i < points.size(); ++i)
        face.surface.control_points[indices[i]] = points[i];
    }
  }

  // the second face that comes along an edge finds it by the segments; boundary edges, which may be
  // parts of segments, have one face only
  typename Shell::Oriented_edge oriented_edge(const std::vector<Piece>& run, Shell& shell)
  {
    const std::size_t known = m_edge_of_segment[run.front().use.segment];
    if(known != NO_INDEX && m_complex.across(run.front().use).cell != NO_INDEX)
      return {known, false};
    typename Shell::Edge edge;
    edge.curve = curve(run);
    auto& points = edge.curve.control_points;
    edge.source = vertex(run.front().source, points.front(), shell);
    edge.target = vertex(run.back().target, points.back(), shell);
    points.front() = shell.point(edge.source);
    points.back() = shell.point(edge.target);
    const std::size_t e = shell.add_edge(std::move(edge));
    for(const Piece& piece : run)
      m_edge_of_segment[piece.use.segment] = e;
    return {e, true};
  }

  std::size_t vertex(std::size_t v, const Point_3& p, Shell& shell)
  {
    if(m_vertex[v] == NO_INDEX)
      m_vertex[v] = shell.add_vertex(p);
    return m_vertex[v];
  }

  static Point_3 point(const Eigen::Vector3d& p) { return Point_3(p.x(), p.y(), p.z()); }

  bool is_cap(const Cell_complex::Segment_side& side) const
  {
    return side.cell != NO_INDEX && m_complex.cells()[side.cell].cap != NO_INDEX;
  }

  // is this a whole side of a cap?
  bool is_side_of_cap(const Cell_complex::Segment_side& side) const
  {
    return is_cap(side) && side.first == 0 && side.last == 1;
  }

  // in units of layout quads
  double length(const Segment_use& use) const
  {
    const auto& side = m_complex.here(use);
    const double extent = double(m_complex.cells()[side.cell].rectangle.extent(side.side & 1));
    return (side.last - side.first) * extent / double(QUAD_TICKS);
  }

  double length(const Piece& piece) const { return (piece.last - piece.first) * length(piece.use); }

  B_spline_curve_3<K> curve(const std::vector<Piece>& run) const
  {
    for(const auto* side : {&m_complex.here(run.front().use), &m_complex.across(run.front().use)})
      if(run.size() == 1 && is_side_of_cap(*side))
        return cap_curve(run.front().use, *side);
    std::vector<Cubic> pieces;
    std::vector<double> breaks(1, 0);
    for(const Piece& piece : run)
    {
      pieces.push_back(restriction(cubic(piece.use), piece.first, piece.last));
      breaks.push_back(breaks.back() + length(piece));
    }
    B_spline_curve_3<K> result;
    for(std::size_t i = 0; i < pieces.size() + 3; ++i)
    {
      const std::size_t k = control_point_span(breaks, i);
      result.control_points.push_back(point(blossom(pieces[k], normalized(
        control_point_arguments(breaks, i), breaks[k], breaks[k + 1]))));
    }
    result.knots = Knot_vector<typename K::FT>(3, {breaks.begin(), breaks.end()});
    return result;
  }

  // the curve of a segment as seen from the use, from a bicubic cell on either side
  Cubic cubic(const Segment_use& use) const
  {
    if(!is_cap(m_complex.here(use)))
    {
      const auto& side = m_complex.here(use);
      return restriction(side_curve(*m_complex.cells()[side.cell].points, side.side), side.first,
                         side.last);
    }
    const auto& side = m_complex.across(use);
    return restriction(side_curve(*m_complex.cells()[side.cell].points, side.side), side.last,
                       side.first);
  }

  // the curve of a side of a cap, in the direction of the use
  B_spline_curve_3<K> cap_curve(const Segment_use& use,
                                const Cell_complex::Segment_side& side) const
  {
    const Cap_sector& s = sector(m_complex.cells()[side.cell]);
    const Biquintic grid = rotated(s.points, (4 + s.corner - side.side) & 3);
    B_spline_curve_3<K> result;
    for(int i = 0; i < Cap_operator::ORDER; ++i)
      result.control_points.push_back(point(grid[i]));
    if(&side != &m_complex.here(use))
      std::reverse(result.control_points.begin(), result.control_points.end());
    result.knots = Knot_vector<typename K::FT>(Cap_operator::DEGREE, {0, length(use)});
    return result;
  }

  // the knots from the first on, in layout quads
  static std::array<std::vector<double>, 2> in_quads(const Face_breaks& ticks)
  {
    std::array<std::vector<double>, 2> result;
    for(int axis = 0; axis < 2; ++axis)
      for(std::int64_t t : ticks[axis])
        result[axis].push_back(double(t - ticks[axis].front()) / double(QUAD_TICKS));
    return result;
  }

  B_spline_surface_3<K> cap_surface(const Cell& cell,
                                    const std::array<std::vector<double>, 2>& breaks) const
  {
    constexpr int degree = Cap_operator::DEGREE, order = Cap_operator::ORDER;
    const Biquintic& points = sector(cell).points;
    const Eigen::MatrixXd u = knot_insertion(degree, breaks[0]);
    const Eigen::MatrixXd v = knot_insertion(degree, breaks[1]);
    B_spline_surface_3<K> result;
    for(Eigen::Index j = 0; j < v.rows(); ++j)
      for(Eigen::Index i = 0; i < u.rows(); ++i)
      {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for(int b = 0; b < order; ++b)
          for(int a = 0; a < order; ++a)
            sum += u(i, a) * v(j, b) * points[order * b + a];
        result.control_points.push_back(point(sum));
      }
    for(int axis = 0; axis < 2; ++axis)
      result.knots[axis]
        = Knot_vector<typename K::FT>(degree, {breaks[axis].begin(), breaks[axis].end()});
    return result;
  }

  // the points at the breaks follow from their neighbours
  B_spline_surface_3<K> crease_surface(const Cell& cell) const
  {
    const Crease& crease = m_creases[cell.crease];
    const std::vector<Eigen::Vector3d>& points = crease.points[cell.sector];
    constexpr std::size_t columns = Crease_builder::COLUMNS, rows = Crease_builder::ROWS;
    const std::size_t pieces = crease.breaks.size() - 1;
    B_spline_surface_3<K> result;
    std::vector<typename K::FT> breaks;
    std::vector<int> multiplicities(pieces + 1, int(rows) - 2);
    multiplicities.front() = multiplicities.back() = int(rows);
    for(std::int64_t t : crease.breaks)
      breaks.push_back(double(t) / double(QUAD_TICKS));
    result.knots[0] = Knot_vector<typename K::FT>(
      Crease_builder::DEGREE_ACROSS, {0, double(crease.width[cell.sector]) / double(QUAD_TICKS)});
    result.knots[1]
      = Knot_vector<typename K::FT>(Crease_builder::DEGREE_ALONG, breaks, multiplicities);
    for(std::size_t k = 0; k < pieces; ++k)
      for(std::size_t b = (k == 0 ? 0 : 1); b < (k + 1 == pieces ? rows : rows - 1); ++b)
        for(std::size_t a = 0; a < columns; ++a)
          result.control_points.push_back(point(points[columns * (rows * k + b) + a]));
    return result;
  }

  B_spline_surface_3<K> merged_surface(const Cell_rectangle& face, const Face_breaks& ticks,
                                       std::size_t& patch) const
  {
    const std::array<std::vector<double>, 2> breaks = in_quads(ticks);
    const std::vector<std::size_t> cell_of_span = cells_of_spans(face, ticks);
    std::vector<Bicubic> pieces;
    for(const Placed_cell& placed : face.cells)
      pieces.push_back(rotated(*m_complex.cells()[placed.cell].points, placed.frame.turns));
    patch = m_complex.cells()[face.cells[cell_of_span[0]].cell].patch;

    B_spline_surface_3<K> result;
    const std::size_t nu = breaks[0].size() + 2, nv = breaks[1].size() + 2;
    for(std::size_t j = 0; j < nv; ++j)
      for(std::size_t i = 0; i < nu; ++i)
      {
        const std::size_t c = cell_of_span[control_point_span(breaks[1], j) * (nu - 3)
                                           + control_point_span(breaks[0], i)];
        const Tick_rectangle r = placed_rectangle(m_complex, face.cells[c]);
        std::array<Blossom_arguments, 2> t;
        for(int axis = 0; axis < 2; ++axis)
          t[axis] = normalized(control_point_arguments(breaks[axis], axis == 0 ? i : j),
                               double(r.low[axis] - face.bounds.low[axis]) / double(QUAD_TICKS),
                               double(r.high[axis] - face.bounds.low[axis]) / double(QUAD_TICKS));
        result.control_points.push_back(point(blossom(pieces[c], t[0], t[1])));
      }
    for(int axis = 0; axis < 2; ++axis)
      result.knots[axis]
        = Knot_vector<typename K::FT>(3, {breaks[axis].begin(), breaks[axis].end()});
    return result;
  }

  // which cell covers a span of the tensor product grid; spans in u run fastest
  std::vector<std::size_t> cells_of_spans(const Cell_rectangle& face,
                                          const Face_breaks& ticks) const
  {
    const std::size_t nu = ticks[0].size() - 1, nv = ticks[1].size() - 1;
    std::vector<std::size_t> result(nu * nv, 0);
    for(std::size_t c = 0; c < face.cells.size(); ++c)
    {
      const Tick_rectangle r = placed_rectangle(m_complex, face.cells[c]);
      std::array<std::array<std::size_t, 2>, 2> range;
      for(int axis = 0; axis < 2; ++axis)
      {
        const auto begin = ticks[axis].begin(), end = ticks[axis].end();
        range[axis][0] = std::lower_bound(begin, end, r.low[axis]) - begin;
        range[axis][1] = std::lower_bound(begin, end, r.high[axis]) - begin;
      }
      for(std::size_t j = range[1][0]; j < range[1][1]; ++j)
        for(std::size_t i = range[0][0]; i < range[0][1]; ++i)
          result[j * nu + i] = c;
    }
    return result;
  }

  const Cell_complex& m_complex;
  const std::vector<Cap>& m_caps;
  const std::vector<Crease>& m_creases;
  // vertices of the complex and, after them, those that cut segments
  std::vector<char> m_is_node;
  std::vector<std::size_t> m_vertex;          // of the shell
  std::vector<std::size_t> m_edge_of_segment;
  // fraction and vertex of cuts, by segment
  std::map<std::size_t, std::map<double, std::size_t> > m_cuts;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_SHELL_ASSEMBLER_H
