// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_BEZIER_PIECES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_BEZIER_PIECES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// a polynomial piece of a face, with its own parameters in [0,1]
struct Bezier_piece
{
  static constexpr int MAXIMUM_DEGREE = 5;
  typedef std::array<double, MAXIMUM_DEGREE + 1> Bernstein;
  typedef std::array<Eigen::Vector3d, 3> Point_and_tangents;

  std::array<int, 2> degree;
  std::vector<Eigen::Vector3d> points; ///< `u` runs fastest
  std::size_t face;

  static Bernstein bernstein(int degree, double t)
  {
    Bernstein value = {{1}};
    for(int d = 1; d <= degree; ++d)
    {
      for(int i = d; i > 0; --i)
        value[i] = (i < d ? (1 - t) * value[i] : 0.) + t * value[i - 1];
      value[0] *= 1 - t;
    }
    return value;
  }

  static Bernstein bernstein_derivative(int degree, double t)
  {
    const Bernstein lower = bernstein(degree - 1, t);
    Bernstein value;
    for(int i = 0; i <= degree; ++i)
      value[i] = degree * ((i > 0 ? lower[i - 1] : 0.) - (i < degree ? lower[i] : 0.));
    return value;
  }

  Eigen::Vector3d point(double u, double v) const
  {
    return sum(bernstein(degree[0], u), bernstein(degree[1], v));
  }

  /// point and first derivatives by `u` and `v`
  Point_and_tangents point_and_tangents(double u, double v) const
  {
    const Bernstein bu = bernstein(degree[0], u), bv = bernstein(degree[1], v);
    return {{sum(bu, bv), sum(bernstein_derivative(degree[0], u), bv),
             sum(bu, bernstein_derivative(degree[1], v))}};
  }

private:
  Eigen::Vector3d sum(const Bernstein& bu, const Bernstein& bv) const
  {
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    const Eigen::Vector3d* p = points.data();
    for(int j = 0; j <= degree[1]; ++j)
    {
      Eigen::Vector3d row = Eigen::Vector3d::Zero();
      for(int i = 0; i <= degree[0]; ++i)
        row += bu[i] * *p++;
      result += bv[j] * row;
    }
    return result;
  }
};

/// The matrix from the control points of a span (the last `degree + 1` up to `span`) to its Bezier
/// points: the blossom by de Boor's algorithm, applied to the unit vectors.
template <typename FT>
Eigen::MatrixXd bezier_extraction(const Knot_vector<FT>& knots, std::size_t span)
{
  const int degree = knots.degree();
  std::vector<double> t;
  for(int k = -degree; k <= degree + 1; ++k)
    t.push_back(CGAL::to_double(knots.full()[span + k])); // t[degree] begins the span
  Eigen::MatrixXd result(degree + 1, degree + 1);
  for(int b = 0; b <= degree; ++b)
  {
    Eigen::MatrixXd d = Eigen::MatrixXd::Identity(degree + 1, degree + 1);
    for(int r = 1; r <= degree; ++r)
    {
      const double argument = (r <= b) ? t[degree + 1] : t[degree];
      for(int j = degree; j >= r; --j)
      {
        const double alpha = (argument - t[j]) / (t[j + 1 + degree - r] - t[j]);
        d.row(j) = ((1 - alpha) * d.row(j - 1) + alpha * d.row(j)).eval();
      }
    }
    result.row(b) = d.row(degree);
  }
  return result;
}

/// first indices of the nonempty spans
template <typename FT>
std::vector<std::size_t> nonempty_spans(const Knot_vector<FT>& knots)
{
  std::vector<std::size_t> result;
  for(std::size_t i = 0; i + 1 < knots.full().size(); ++i)
    if(knots.full()[i] < knots.full()[i + 1])
      result.push_back(i);
  return result;
}

/// appends the pieces of a surface
template <typename K>
void append_bezier_pieces(const B_spline_surface_3<K>& surface, std::size_t face,
                          std::vector<Bezier_piece>& pieces)
{
  std::array<std::vector<Eigen::MatrixXd>, 2> extraction;
  std::array<std::vector<std::size_t>, 2> spans;
  for(int axis = 0; axis < 2; ++axis)
  {
    spans[axis] = nonempty_spans(surface.knots[axis]);
    for(std::size_t span : spans[axis])
      extraction[axis].push_back(bezier_extraction(surface.knots[axis], span));
  }
  const int du = surface.knots[0].degree(), dv = surface.knots[1].degree();
  for(std::size_t sv = 0; sv < spans[1].size(); ++sv)
    for(std::size_t su = 0; su < spans[0].size(); ++su)
    {
      Bezier_piece piece;
      piece.degree = {{du, dv}};
      piece.face = face;
      piece.points.assign((du + 1) * (dv + 1), Eigen::Vector3d::Zero());
      for(int b = 0; b <= dv; ++b)
        for(int a = 0; a <= du; ++a)
          for(int j = 0; j <= dv; ++j)
            for(int i = 0; i <= du; ++i)
              piece.points[b * (du + 1) + a]
                += extraction[0][su](a, i) * extraction[1][sv](b, j)
                 * to_eigen(surface.control_point(spans[0][su] - du + i, spans[1][sv] - dv + j));
      pieces.push_back(piece);
    }
}

/// the polynomial pieces of all faces
template <typename K>
std::vector<Bezier_piece> bezier_pieces(const NURBS_shell_3<K>& shell)
{
  std::vector<Bezier_piece> pieces;
  pieces.reserve(shell.number_of_spans());
  for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
    append_bezier_pieces(shell.face(f).surface, f, pieces);
  return pieces;
}

/// Finds the point of a piece closest to `p`, from the parameters (u,v) on, by the method of Gauss
/// and Newton with the bounds as active set. Returns the distance.
inline double project_to_piece(const Bezier_piece& piece, const Eigen::Vector3d& p, double& u,
                               double& v)
{
  constexpr int MAXIMUM_NUMBER_OF_STEPS = 24;
  constexpr double NEGLIGIBLE_STEP = 1e-9; // its square is far below what is measured
  double distance = (piece.point(u, v) - p).norm();
  for(int step = 0; step < MAXIMUM_NUMBER_OF_STEPS; ++step)
  {
    const Bezier_piece::Point_and_tangents d = piece.point_and_tangents(u, v);
    const Eigen::Vector3d r = p - d[0];
    Eigen::Vector2d g(r.dot(d[1]), r.dot(d[2]));
    Eigen::Matrix2d h;
    h << d[1].dot(d[1]), d[1].dot(d[2]), d[1].dot(d[2]), d[2].dot(d[2]);
    const bool is_u_fixed = (u <= 0 && g[0] < 0) || (u >= 1 && g[0] > 0);
    const bool is_v_fixed = (v <= 0 && g[1] < 0) || (v >= 1 && g[1] > 0);
    Eigen::Vector2d s(is_u_fixed ? 0 : g[0] / h(0, 0), is_v_fixed ? 0 : g[1] / h(1, 1));
    if(!is_u_fixed && !is_v_fixed && h.determinant() > 0)
      s = h.inverse() * g;
    bool has_improved = false;
    for(double scale = 1; scale > 0.1 && !has_improved; scale /= 2)
    {
      const double x = (std::min)(1., (std::max)(0., u + scale * s[0]));
      const double y = (std::min)(1., (std::max)(0., v + scale * s[1]));
      const double next = (piece.point(x, y) - p).norm();
      if(!(next < distance))
        continue;
      has_improved = (std::abs(x - u) + std::abs(y - v) > NEGLIGIBLE_STEP);
      u = x;
      v = y;
      distance = next;
    }
    if(!has_improved)
      break;
  }
  return distance;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_BEZIER_PIECES_H
