// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_EXTRAORDINARY_FACE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_EXTRAORDINARY_FACE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Catmull_Clark_table.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// the tables in use, shared by all faces of a surface
class Catmull_clark_tables
{
public:
  typedef std::shared_ptr<const Catmull_clark_table> Pointer;

  Pointer get(int valence, bool is_zero_u, bool is_zero_v)
  {
    Pointer& table = m_tables[std::make_pair(valence, int(is_zero_u) + 2 * int(is_zero_v))];
    if(table == nullptr)
      table = std::make_shared<Catmull_clark_table>(valence, is_zero_u, is_zero_v);
    return table;
  }

private:
  std::map<std::pair<int, int>, Pointer> m_tables;
};

// A quarter of a face with extraordinary vertices, at one of the corners of the face. Its frame has
// the corner as origin, u along the side that begins there, and side length 1.
struct Face_quarter
{
  Catmull_clark_tables::Pointer table; // null if the corner is regular
  Stencil_matrix net;                  // 2n+8 points after the first subdivision
  Stencil_matrix bezier;               // of a quarter with regular corner

  // \pre the tables are from the same set
  bool operator==(const Face_quarter& q) const
  {
    return table == q.table && are_equal(net, q.net) && are_equal(bezier, q.bezier);
  }

private:
  static bool are_equal(const Stencil_matrix& a, const Stencil_matrix& b)
  {
    return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
  }
};

// The values of the basis functions of a face: one column per control point, rows for N, N_u, N_v,
// N_uu, N_uv, N_vv.
typedef Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor> Basis_matrix;

// A face of the T-mesh with one to four extraordinary corners: the limit of the subdivision rules
// of Catmull and Clark, as linear functionals of the control points.
//
// Only the functions of the vertices of the faces around the extraordinary corners are treated
// here. That of any other vertex is a product of two splines on the face, because it vanishes to
// the third order along a line through the extraordinary corner; it is left to `Bezier_extraction`.
// Therefore T-vertices do no harm unless they touch the faces around the extraordinary corners or
// the edges that leave these.
//
// The first subdivision is done with the knot intervals at hand: regular control points are refined
// by knot insertion in their local knot vectors, so zero intervals stay zero, and extraordinary
// points by the rule for valence n. Then every quarter of the face has at most one extraordinary
// corner and is treated by a table.
class Extraordinary_face
{
public:
  std::vector<std::size_t> control_points;  // columns of all stencils
  std::array<Face_quarter, 4> quarters;
  Stencil_matrix refined_corners;           // the four corners after one subdivision
  Stencil_matrix refined_edges;             // the midpoints of the four sides
  Stencil_matrix refined_center;

  // the level of a piece of a quarter, its number, and the place of (s, t) in it
  struct Place
  {
    int level = 0; // 0: the quarter itself
    int piece = 0;
    double s, t;   // in the piece
    bool is_extraordinary_point = false;
  };

  // \pre the tables of both are from the same set
  bool has_functions(const Extraordinary_face& other) const
  {
    return control_points == other.control_points && quarters == other.quarters;
  }

  // converts face coordinates to coordinates of the quarter with the given corner
  static std::array<double, 2> to_quarter(int corner, double u, double v)
  {
    switch(corner)
    {
      case 0: return {{2 * u, 2 * v}};
      case 1: return {{2 * v, 2 * (1 - u)}};
      case 2: return {{2 * (1 - u), 2 * (1 - v)}};
      default: return {{2 * (1 - v), 2 * u}};
    }
  }

  static std::array<double, 2> to_face(int corner, double s, double t)
  {
    switch(corner)
    {
      case 0: return {{s / 2, t / 2}};
      case 1: return {{1 - t / 2, s / 2}};
      case 2: return {{1 - s / 2, 1 - t / 2}};
      default: return {{t / 2, 1 - s / 2}};
    }
  }

  static int quarter_at(double u, double v)
  {
    return v <= 0.5 ? (u <= 0.5 ? 0 : 1) : (u <= 0.5 ? 3 : 2);
  }

  Place locate(int corner, double s, double t) const
  {
    Place place;
    place.s = s;
    place.t = t;
    if(quarters[corner].table == nullptr)
      return place;
    place.level = 1;
    while((std::max)(place.s, place.t) <= 0.5)
    {
      if(place.level == Catmull_clark_table::maximum_level)
      {
        place.is_extraordinary_point = true;
        return place;
      }
      place.s *= 2;
      place.t *= 2;
      ++place.level;
    }
    const bool is_right = place.s > 0.5, is_upper = place.t > 0.5;
    place.piece = is_right ? (is_upper ? 1 : 0) : 2;
    place.s = 2 * place.s - (is_right ? 1 : 0);
    place.t = 2 * place.t - (is_upper ? 1 : 0);
    return place;
  }

  // the Bernstein coefficients of a piece, 16 rows
  Stencil_matrix bezier(int corner, int level, int piece) const
  {
    const Face_quarter& quarter = quarters[corner];
    return level == 0 ? quarter.bezier
                      : Stencil_matrix(quarter.table->piece(level, piece) * quarter.net);
  }

  // approximates the part of side 2^(1-level) of a quarter at its extraordinary corner by one
  // bicubic piece: exact in position and normal derivative along the two sides away from the
  // corner, exact in position in the middle and in the middle of the other sides
  Stencil_matrix bezier_at_extraordinary_point(int corner, int level) const;

  // evaluates the basis at (u, v) in [0,1]^2 up to the derivatives of the given order
  void evaluate(double u, double v, int order, Basis_matrix& result) const
  {
    const int corner = quarter_at(u, v);
    const Face_quarter& quarter = quarters[corner];
    const std::array<double, 2> st = to_quarter(corner, u, v);
    const Place place = locate(corner, st[0], st[1]);
    result.setZero(6, static_cast<Eigen::Index>(control_points.size()));
    const int rows = order == 0 ? 1 : (order == 1 ? 3 : 6);
    if(!place.is_extraordinary_point)
      evaluate_piece(quarter, place, order, result.topRows(rows));
    else
      result.row(0) = quarter.table->limit().row(0) * quarter.net;
    if(order > 0 && place.level > 0
       && (place.is_extraordinary_point
           || place.level > quarter.table->maximum_level_of_derivatives()))
    {
      result.middleRows(1, 2) = quarter.table->limit().bottomRows(2) * quarter.net;
      if(order > 1)
      {
        const double x = distance_of_second_derivatives;
        Stencil_matrix values(6, result.cols());
        evaluate_piece(quarter, locate(corner, x, x), order, values);
        result.bottomRows(3) = values.bottomRows(3);
      }
    }
    rotate_derivatives(corner, result);
  }

  // from derivatives with respect to the coordinates of the quarter to those of the face
  static void rotate_derivatives(int corner, Basis_matrix& m)
  {
    m.middleRows(1, 2) *= 2;
    m.bottomRows(3) *= 4;
    if(corner == 1 || corner == 3)
    {
      m.row(1).swap(m.row(2));
      m.row(3).swap(m.row(5));
      m.row(4) *= -1;
    }
    if(corner == 1 || corner == 2)
      m.row(1) *= -1;
    if(corner == 2 || corner == 3)
      m.row(2) *= -1;
  }

private:
  // the second derivatives have no limit at an extraordinary point; this distance is a compromise
  static constexpr double distance_of_second_derivatives = 1. / 64;

  // The matrices are too small for the blocked products of Eigen.
  static void evaluate_piece(const Face_quarter& quarter, const Place& place, int order,
                             Eigen::Ref<Stencil_matrix> result)
  {
    const auto b = bernstein_rows(place, order);
    if(place.level == 0)
      result = b.topRows(result.rows()).lazyProduct(quarter.bezier);
    else
    {
      const Stencil_matrix values = b.topRows(result.rows()).lazyProduct(
        quarter.table->piece(place.level, place.piece));
      result = values.lazyProduct(quarter.net);
    }
  }

  static Eigen::Matrix<double, 6, 16, Eigen::RowMajor> bernstein_rows(const Place& place, int order)
  {
    static const int derivative[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
    Eigen::Matrix<double, 6, 16, Eigen::RowMajor> b;
    const double scale = std::ldexp(1., place.level);
    for(int k = 0; k < 6; ++k)
    {
      const int du = derivative[k][0], dv = derivative[k][1];
      if(du + dv > order)
        break;
      const Row bs = bernstein(place.s, du), bt = bernstein(place.t, dv);
      const double factor = (du + dv > 0 ? scale : 1) * (du + dv > 1 ? scale : 1);
      for(int j = 0; j < 4; ++j)
        for(int i = 0; i < 4; ++i)
          b(k, 4 * j + i) = factor * bs[i] * bt[j];
    }
    return b;
  }
};

inline Stencil_matrix
Extraordinary_face::bezier_at_extraordinary_point(int corner, int level) const
{
  const Catmull_clark_table& table = *quarters[corner].table;
  std::array<Stencil_matrix, 3> pieces; // of the next level, on half the interval
  for(int s = 0; s < 3; ++s)
    pieces[s] = table.piece(level, s) * quarters[corner].net;

  // Along the two sides away from the corner the surface continues a bicubic neighbor, so there
  // the cubics of the piece between them extend to the whole side.
  const std::array<Row, 4> extension = {{ bezier_blossom_weights(-1, -1, -1),
    bezier_blossom_weights(-1, -1, 1), bezier_blossom_weights(-1, 1, 1),
    bezier_blossom_weights(1, 1, 1) }};
  Stencil_matrix b = Stencil_matrix::Zero(16, pieces[0].cols());
  for(int j = 0; j < 4; ++j)
    for(int i = 0; i < 4; ++i)
      if(i > 1 || j > 1)
        for(int l = 0; l < 4; ++l)
          for(int k = 0; k < 4; ++k)
            b.row(4 * j + i) += extension[i][k] * extension[j][l] * pieces[1].row(4 * l + k);

  b.row(0) = table.limit().row(0) * quarters[corner].net;
  b.row(1) = (8 * pieces[0].row(0) - b.row(0) - 3 * b.row(2) - b.row(3)) / 3;
  b.row(4) = (8 * pieces[2].row(0) - b.row(0) - 3 * b.row(8) - b.row(12)) / 3;
  const std::array<double, 4> w = {{1, 3, 3, 1}};
  Eigen::RowVectorXd rest = 64 * pieces[1].row(0);
  for(int k = 0; k < 16; ++k)
    if(k != 5)
      rest -= w[k & 3] * w[k >> 2] * b.row(k);
  b.row(5) = rest / 9;
  return b;
}

// Gathers the control points around an extraordinary face and does the first subdivision.
template <typename Point>
class Extraordinary_face_builder
{
  typedef T_mesh<Point> Mesh;
  typedef typename Mesh::Vertex Vertex;
  typedef typename Mesh::Halfedge Halfedge;
  typedef typename Mesh::Face Face;
  typedef Eigen::RowVectorXd Stencil;

public:
  Extraordinary_face_builder(const Mesh& mesh, Catmull_clark_tables& tables)
    : m_mesh(mesh), m_tables(tables) {}

  // \pre no edge of the faces around the extraordinary corners of `f`, nor one that leaves these
  //      faces, is split
  Extraordinary_face operator()(Face f)
  {
    m_face_points.clear();
    m_control_points = m_mesh.extraordinary_neighbors(f);
    m_sides[0] = m_mesh.halfedge(f);
    for(int c = 1; c < 4; ++c)
      m_sides[c] = m_mesh.next(m_sides[c - 1]);
    Extraordinary_face result;
    for(Vertex v : m_control_points)
      result.control_points.push_back(v);
    const Eigen::Index columns = static_cast<Eigen::Index>(m_control_points.size());
    result.refined_corners.resize(4, columns);
    result.refined_edges.resize(4, columns);
    result.refined_center = face_point(f);
    for(int c = 0; c < 4; ++c)
    {
      result.refined_corners.row(c) = vertex_point(m_sides[c]);
      result.refined_edges.row(c) = edge_point(m_sides[c]);
    }
    for(int c = 0; c < 4; ++c)
      result.quarters[c] = quarter(c, result);
    return result;
  }

private:
  // adds a multiple of a control point, if it is among those treated here
  void add(Stencil& stencil, Vertex v, double factor) const
  {
    const auto it = std::lower_bound(m_control_points.begin(), m_control_points.end(), v);
    if(it != m_control_points.end() && *it == v)
      stencil[it - m_control_points.begin()] += factor;
  }

  Stencil zero() const
  {
    return Stencil::Zero(static_cast<Eigen::Index>(m_control_points.size()));
  }

  double interval(Halfedge h) const { return to_parameter(m_mesh.length(h)); }

  // the extent of the face of `h` perpendicular to `h`
  double width(Halfedge h) const
  {
    return to_parameter(m_mesh.extent(m_mesh.face(h), 1 - (m_mesh.side(h) & 1)));
  }

  // The weight of the source of `h` in the midpoint of `h`: knot insertion at the middle of the
  // interval d, between the intervals `before` and `behind`.
  double weight(Halfedge h) const
  {
    const Vertex v = m_mesh.source(h);
    const std::array<Ticks, 2> forward = m_mesh.intervals_along(h);
    const double d = to_parameter(forward[0]), behind = to_parameter(forward[1]);
    double before = d; // uniform at an extraordinary point
    if(!m_mesh.is_extraordinary(v))
      before = to_parameter(m_mesh.star(v).interval[(m_mesh.direction(h) + 2) & 3][0]);
    const double sum = before + d + behind;
    return sum == 0 ? 1 : (d / 2 + behind) / sum;
  }

  const Stencil& face_point(Face f)
  {
    const auto it = m_face_points.find(f);
    if(it != m_face_points.end())
      return it->second;
    Stencil stencil = zero();
    for(Halfedge h : m_mesh.mesh().halfedges_around_face(m_mesh.halfedge(f)))
      if(m_mesh.is_corner(m_mesh.prev(h)))
        add(stencil, m_mesh.source(h), weight(h) * weight(m_mesh.opposite(m_mesh.prev(h))));
    return m_face_points.emplace(f, stencil).first->second;
  }

  Stencil edge_point(Halfedge h)
  {
    const Halfedge o = m_mesh.opposite(h);
    const double left = width(h), right = width(o);
    Stencil stencil = zero();
    add(stencil, m_mesh.source(h), weight(h) / 2);
    add(stencil, m_mesh.target(h), weight(o) / 2);
    stencil += (right * face_point(m_mesh.face(h)) + left * face_point(m_mesh.face(o)))
               / (2 * (left + right));
    return stencil;
  }

  // the new position of the source of `h`
  Stencil vertex_point(Halfedge h)
  {
    const Vertex v = m_mesh.source(h);
    return m_mesh.is_extraordinary(v) ? extraordinary_vertex_point(h) : regular_vertex_point(v);
  }

  Stencil extraordinary_vertex_point(Halfedge h)
  {
    Stencil stencil = zero();
    int n = 0;
    Halfedge g = h;
    do
    {
      stencil += 4 * edge_point(g) - face_point(m_mesh.face(g));
      ++n;
      g = m_mesh.rotated(g);
    }
    while(g != h);
    stencil /= n;
    add(stencil, m_mesh.source(h), n - 3);
    return stencil / n;
  }

  Stencil regular_vertex_point(Vertex v)
  {
    const auto& out = m_mesh.star(v).out;
    std::array<double, 4> w;
    for(int d = 0; d < 4; ++d)
    {
      const double same = interval(out[d]), other = interval(out[(d + 2) & 3]);
      w[d] = other / (same + other);
    }
    Stencil stencil = zero();
    add(stencil, v, 0.25);
    for(int d = 0; d < 4; ++d)
      stencil += 0.5 * w[d] * edge_point(out[d])
                 - 0.25 * w[d] * w[(d + 1) & 3] * face_point(m_mesh.face(out[d]));
    return stencil;
  }

  // the quarter at corner c, from the points of the first subdivision
  Face_quarter quarter(int c, const Extraordinary_face& face)
  {
    const Halfedge h = m_sides[c];
    const int a = (c + 1) & 3, b = (c + 2) & 3, d = (c + 3) & 3;
    std::vector<Stencil> net(1, face.refined_corners.row(c));
    int n = 0;
    Halfedge g = h;
    do
    {
      net.push_back(edge_point(g));
      net.push_back(face_point(m_mesh.face(g)));
      ++n;
      g = m_mesh.rotated(g);
    }
    while(g != h);
    net.push_back(face.refined_corners.row(a));
    net.push_back(face.refined_edges.row(a));
    net.push_back(face.refined_corners.row(b));
    net.push_back(face.refined_edges.row(b));
    net.push_back(face.refined_corners.row(d));
    net.push_back(edge_point(m_mesh.prev(m_mesh.opposite(h))));
    net.push_back(edge_point(m_mesh.next(m_mesh.opposite(m_sides[d]))));

    Face_quarter result;
    result.net.resize(size_of_net(n), static_cast<Eigen::Index>(m_control_points.size()));
    for(std::size_t i = 0; i < net.size(); ++i)
      result.net.row(static_cast<Eigen::Index>(i)) = net[i];
    set_pieces(h, n, result);
    return result;
  }

  // a regular quarter is a bicubic piece, another one is left to a table
  void set_pieces(Halfedge h, int n, Face_quarter& result)
  {
    const Halfedge g = m_mesh.rotated(h);
    const bool is_zero_u = is_zero(m_mesh.intervals_along(h)[1]);
    const bool is_zero_v = is_zero(m_mesh.intervals_along(g)[1]);
    if(m_mesh.is_extraordinary(m_mesh.source(h)))
    {
      result.table = m_tables.get(n, is_zero_u, is_zero_v);
      return;
    }
    const auto& star = m_mesh.star(m_mesh.source(h));
    const int u = m_mesh.direction(h), v = m_mesh.direction(g);
    const Span_knots knots_u = knots(is_zero(star.interval[(u + 2) & 3][0]), is_zero_u);
    const Span_knots knots_v = knots(is_zero(star.interval[(v + 2) & 3][0]), is_zero_v);
    result.bezier = tensor_bezier(knots_u, knots_v, result.net.cols(),
      [&](int i, int j) -> Stencil { return result.net.row(index_in_net(i - 1, j - 1, 4)); });
  }

  static bool is_zero(Ticks interval) { return rounded_parameter(interval) == 0; }

  // knots of a quarter: intervals are halved, zero intervals remain
  static Span_knots knots(bool is_zero_before, bool is_zero_behind)
  {
    Span_knots t = {{-2, -1, 0, 1, 2, 3}};
    if(is_zero_before)
      t[0] = t[1] = 0;
    if(is_zero_behind)
      t[5] = 2;
    return t;
  }

  const Mesh& m_mesh;
  Catmull_clark_tables& m_tables;
  std::vector<Vertex> m_control_points;
  std::array<Halfedge, 4> m_sides;
  std::map<Face, Stencil> m_face_points;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_EXTRAORDINARY_FACE_H
