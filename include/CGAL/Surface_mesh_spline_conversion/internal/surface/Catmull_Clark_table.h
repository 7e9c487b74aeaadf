// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CATMULL_CLARK_TABLE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CATMULL_CLARK_TABLE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/cubic_B_spline.h>

#include <CGAL/number_type_config.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

typedef Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> Stencil_matrix;

// number of points that determine a face with one extraordinary vertex of valence n
inline int size_of_net(int n) { return 2 * n + 8; }

// The numbering of the 2n+8 points around a face with corners (0,0), (1,0), (1,1), (0,1), of which
// (0,0) has valence n: the point (0,0), then counter clockwise the ends of its edges (odd numbers)
// alternating with the opposite corners of its faces, then seven outer points. Grid coordinates
// lie in -1..2; (-1,-1) exists for n = 4 only.
inline int index_in_net(int i, int j, int n)
{
  static const int outer[7][2] = {{2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {2, -1}, {-1, 2}};
  static const int inner[3][3] = {{6, 5, 4}, {-1, 0, 3}, {0, 1, 2}}; // [i+1][j+1]
  if(i == 2 || j == 2)
  {
    int k = 0;
    while(outer[k][0] != i || outer[k][1] != j)
      ++k;
    return 2 * n + 1 + k;
  }
  if(j == -1 && i >= 0)
    return 2 * n - 1 + i;
  return inner[i + 1][j + 1];
}

// the matrix from the four B-spline coefficients of a span to its Bernstein coefficients
inline std::array<Row, 4> span_to_bezier(const Span_knots& t)
{
  const double a = t[2], b = t[3];
  return {{blossom_weights(t, a, a, a), blossom_weights(t, a, a, b), blossom_weights(t, a, b, b),
           blossom_weights(t, b, b, b)}};
}

// computes the 16 Bernstein coefficients (number 4 j + i, with i in the first direction) of a
// bicubic piece from the stencils of its 4 x 4 control points: `row(i, j)` with i, j in 0..3
template <typename Row_of_grid>
Stencil_matrix tensor_bezier(const Span_knots& knots_u, const Span_knots& knots_v, int columns,
                             const Row_of_grid& row)
{
  const std::array<Row, 4> bu = span_to_bezier(knots_u), bv = span_to_bezier(knots_v);
  Stencil_matrix result = Stencil_matrix::Zero(16, columns);
  for(int l = 0; l < 4; ++l)
    for(int m = 0; m < 4; ++m)
    {
      const Eigen::RowVectorXd r = row(m, l);
      for(int j = 0; j < 4; ++j)
        for(int i = 0; i < 4; ++i)
          if(bu[i][m] != 0 && bv[j][l] != 0)
            result.row(4 * j + i) += bu[i][m] * bv[j][l] * r;
    }
  return result;
}

// Subdivision of a face with one extraordinary vertex by the rules of Catmull and Clark. Around the
// vertex the knot intervals are uniform; behind the far ends of its two edges they may be zero,
// where these ends lie on the boundary (the flags).
class Catmull_clark_step
{
public:
  Catmull_clark_step(int valence, bool is_zero_u, bool is_zero_v) : n(valence)
  {
    const std::array<Row, 5> mu = refinement(is_zero_u), mv = refinement(is_zero_v);
    m_next = Stencil_matrix::Zero(size_of_net(n), size_of_net(n));
    for(int k = 0; k < n; ++k)
    {
      const int edge = 1 + 2 * k, face = edge + 1, following = 1 + 2 * ((k + 1) % n);
      for(int p : {0, edge, face, following})
        m_next(face, p) += 0.25;
    }
    for(int k = 0; k < n; ++k)
    {
      const int edge = 1 + 2 * k, face = edge + 1, previous = 2 * ((k + n - 1) % n) + 2;
      m_next.row(edge) = 0.25 * (m_next.row(face) + m_next.row(previous));
      m_next(edge, 0) += 0.25;
      m_next(edge, edge) += 0.25;
    }
    for(int k = 0; k < n; ++k)
      m_next.row(0) += (4 * m_next.row(1 + 2 * k) - m_next.row(2 + 2 * k)) / (n * double(n));
    m_next(0, 0) += (n - 3) / double(n);
    for(int i = -1; i <= 2; ++i)
      for(int j = -1; j <= 2; ++j)
        if(i == 2 || j == 2)
          m_next.row(index_in_net(i, j, n)) = tensor_row(mu[i + 1], mv[j + 1]);

    static const int first[3][2] = {{0, -1}, {0, 0}, {-1, 0}};
    const Span_knots uniform = {{-2, -1, 0, 1, 2, 3}};
    for(int s = 0; s < 3; ++s)
      m_pieces[s] = tensor_bezier(uniform, uniform, size_of_net(n),
        [&](int a, int b) -> Eigen::RowVectorXd
        {
          const int i = first[s][0] + a, j = first[s][1] + b;
          if(i < 2 && j < 2)
            return m_next.row(index_in_net(i, j, n));
          return tensor_row(mu[i + 1], mv[j + 1]);
        });
  }

  // the net of the quarter at the extraordinary vertex
  const Stencil_matrix& next() const { return m_next; }

  // the Bernstein coefficients of the other quarters: (1,0), (1,1) and (0,1)
  const Stencil_matrix& piece(int s) const { return m_pieces[s]; }

private:
  // refinement of one cubic spline: rows for the positions -1/2, 0, 1/2, 1, 3/2, columns for -1..2
  static std::array<Row, 5> refinement(bool is_zero_behind)
  {
    const double b = is_zero_behind ? 0.75 : 0.5, a = 1 - b;
    return {{ Row{{.5, .5, 0, 0}}, Row{{.125, .75, .125, 0}}, Row{{0, .5, .5, 0}},
              Row{{0, .125, .625 + a / 4, b / 4}}, Row{{0, 0, a, b}} }};
  }

  Eigen::RowVectorXd tensor_row(const Row& wu, const Row& wv) const
  {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size_of_net(n));
    for(int i = 0; i < 4; ++i)
      for(int j = 0; j < 4; ++j)
        if(wu[i] * wv[j] != 0)
          row[index_in_net(i - 1, j - 1, n)] += wu[i] * wv[j];
    return row;
  }

  int n;
  Stencil_matrix m_next;
  std::array<Stencil_matrix, 3> m_pieces;
};

// All levels of subdivision of a face with one extraordinary vertex, as matrices that act on the
// 2n+8 points of its net, and the limit of the vertex itself.
class Catmull_clark_table
{
public:
  // below a parameter distance of 2^-maximum_level the limit at the vertex is used: there the
  // difference is far below the precision of a double
  static constexpr int maximum_level = 48;

  Catmull_clark_table(int valence, bool is_zero_u, bool is_zero_v) : n(valence)
  {
    const Catmull_clark_step first(n, is_zero_u, is_zero_v), uniform(n, false, false);
    m_nets.push_back(Stencil_matrix::Identity(size_of_net(n), size_of_net(n)));
    for(int level = 0; level < maximum_level; ++level)
    {
      const Catmull_clark_step& step = (level == 0) ? first : uniform;
      std::array<Stencil_matrix, 3> pieces;
      for(int s = 0; s < 3; ++s)
        pieces[s] = step.piece(s) * m_nets.back();
      m_pieces.push_back(pieces);
      m_nets.push_back(step.next() * m_nets.back());
    }
    compute_limit();
  }

  int valence() const { return n; }

  // the net at the extraordinary vertex after `level` subdivisions
  const Stencil_matrix& net(int level) const { return m_nets[level]; }

  // the Bernstein coefficients of piece s of subdivision `level`, level >= 1
  const Stencil_matrix& piece(int level, int s) const { return m_pieces[level - 1][s]; }

  // Distances shrink by the subdominant eigenvalue per level. Beyond this level, rounding errors
  // would spoil the derivatives, and the tangents at the vertex are used in their place.
  int maximum_level_of_derivatives() const { return m_maximum_level_of_derivatives; }

  // position and tangent vectors along the edges 0 and 1 at the vertex, 3 rows. The tangents have
  // the length of the derivative if n is 4; else the parametrization is singular there.
  const Stencil_matrix& limit() const { return m_limit; }

private:
  void compute_limit()
  {
    m_limit = Stencil_matrix::Zero(3, size_of_net(n));
    const double angle = 2 * CGAL_PI / n, c = std::cos(angle);
    const double a = 1 + c + std::cos(angle / 2) * std::sqrt(2 * (9 + c));
    const double subdominant
      = (5 + c + std::cos(angle / 2) * std::sqrt(2 * (9 + c))) / 16;
    const double smallest_distance = 1e-8; // half of the digits of a double
    m_maximum_level_of_derivatives
      = static_cast<int>(std::log(smallest_distance) / std::log(subdominant));
    m_limit(0, 0) = n / double(n + 5);
    for(int k = 0; k < n; ++k)
    {
      m_limit(0, 1 + 2 * k) = 4 / double(n * (n + 5));
      m_limit(0, 2 + 2 * k) = 1 / double(n * (n + 5));
      for(int d = 0; d < 2; ++d)
      {
        const double begin = std::cos((k - d) * angle), end = std::cos((k - d + 1) * angle);
        m_limit(1 + d, 1 + 2 * k) = a * begin / (3 * n);
        m_limit(1 + d, 2 + 2 * k) = (begin + end) / (3 * n);
      }
    }
  }

  int n;
  std::vector<Stencil_matrix> m_nets;
  std::vector<std::array<Stencil_matrix, 3> > m_pieces;
  Stencil_matrix m_limit;
  int m_maximum_level_of_derivatives = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CATMULL_CLARK_TABLE_H
