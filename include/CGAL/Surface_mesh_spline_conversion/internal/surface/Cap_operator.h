// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CAP_OPERATOR_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CAP_OPERATOR_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/number_type_config.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <utility>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// The linear map from the data round an extraordinary point of valence n to the Bezier points of a
/// G1 cap: one biquintic patch p_k(u,v) per sector k, extraordinary point at (0,0), u along spoke
/// k, v along spoke k+1 (counter clockwise).
///
/// The equations are
///  - at the outer sides u = 1 and v = 1, position and cross derivative of the bicubic neighbours;
///  - along spoke k, p_k(u,0) = p_(k-1)(0,u) = e(u), a quartic, and
///    d_v p_k(u,0) + d_u p_(k-1)(0,u) = 2 cos(2 pi / n) (1-u)^2 e'(u).
/// The double zero at u = 1 is needed as the neighbours fix the twist there; it is what takes the
/// degree to five. What is left free is fitted to samples of the limit surface, with a little
/// fairness. All of it depends on the valence only.
class Cap_operator
{
public:
  static constexpr int DEGREE = 5;
  static constexpr int ORDER = DEGREE + 1;
  static constexpr int POINTS = ORDER * ORDER;       ///< Bezier points of a sector
  static constexpr int RIBBON_DATA = 16;             ///< data of the two outer sides of a sector
  static constexpr int INTERVALS = 8;                ///< between samples along a side
  static constexpr int SAMPLES = (INTERVALS + 1) * (INTERVALS + 1);

  /// The data of sector k are rows `RIBBON_DATA*k + 8*s + 4*d + i`: outer side s (u = 1, v = 1),
  /// d = 0 for positions and 1 for cross derivatives, Bezier point i of a cubic along the side;
  /// after the ribbons of all sectors, rows `SAMPLES*k + (INTERVALS+1)*j + i` of samples at
  /// (i,j)/INTERVALS. With `is_smooth` false only the curves of the sides are exact, the rest of
  /// the equations hold in the sense of least squares.
  explicit Cap_operator(int valence, bool is_smooth = true)
    : m_valence(valence), m_is_smooth(is_smooth)
  {
    set_equations();
    set_objective();
    solve();
  }

  int valence() const { return m_valence; }

  int number_of_data() const { return m_valence * (RIBBON_DATA + SAMPLES); }

  /// returns the Bezier points, row `POINTS*k + ORDER*b + a` for point a in u and b in v
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& data) const { return m_operator * data; }

  /// returns the largest residual of the equations
  double residual(const Eigen::MatrixXd& points, const Eigen::MatrixXd& data) const
  {
    return (m_equations * points - m_right_hand_side * data.topRows(m_valence * RIBBON_DATA))
      .rowwise().norm().maxCoeff();
  }

  /// the values of the Bernstein polynomials of `degree` at `t`
  static Eigen::VectorXd bernstein(int degree, double t)
  {
    Eigen::VectorXd value = Eigen::VectorXd::Zero(degree + 1);
    value[0] = 1;
    for(int d = 1; d <= degree; ++d)
      for(int i = d; i >= 0; --i)
        value[i] = (1 - t) * (i < d ? value[i] : 0.) + t * (i > 0 ? value[i - 1] : 0.);
    return value;
  }

  /// the matrix that raises the degree of Bezier points
  static Eigen::MatrixXd elevation(int from, int to)
  {
    Eigen::MatrixXd result = Eigen::MatrixXd::Identity(from + 1, from + 1);
    for(int d = from; d < to; ++d)
    {
      Eigen::MatrixXd step = Eigen::MatrixXd::Zero(d + 2, d + 1);
      for(int i = 0; i <= d; ++i)
      {
        step(i, i) = 1 - i / double(d + 1);
        step(i + 1, i) = (i + 1) / double(d + 1);
      }
      result = (step * result).eval();
    }
    return result;
  }

private:
  // relative to the largest pivot; the equations have entries of order one and gaps of many decades
  static constexpr double RANK_THRESHOLD = 1e-10;
  // of third differences against samples: enough to fix what samples see badly
  static constexpr double FAIRNESS_WEIGHT = 1e-4;
  // of equations that hold in the sense of least squares only, against samples
  static constexpr double EQUATION_WEIGHT = 1e3;

  int column(int k, int a, int b) const
  {
    return POINTS * ((k + m_valence) % m_valence) + ORDER * b + a;
  }

  // the points of a sector seen from an outer side: a across (5 on the side), b along
  int side_column(int k, int side, int a, int b) const
  {
    return (side == 0) ? column(k, a, b) : column(k, b, a);
  }

  void set_equations()
  {
    const int n = m_valence, exact = n * 3 * ORDER, smooth = n * (2 * ORDER + ORDER + 1);
    m_equations = Eigen::MatrixXd::Zero(exact + smooth, POINTS * n);
    m_right_hand_side = Eigen::MatrixXd::Zero(exact + smooth, RIBBON_DATA * n);
    m_number_of_exact_equations = m_is_smooth ? exact + smooth : exact;
    int row = 0;
    for(int k = 0; k < n; ++k)
      set_curves(k, row);
    for(int k = 0; k < n; ++k)
      set_smoothness(k, row);
  }

  // outer sides lie on the neighbours' curves, spokes are shared
  void set_curves(int k, int& row)
  {
    const Eigen::MatrixXd raise = elevation(3, DEGREE);
    for(int side = 0; side < 2; ++side)
      for(int b = 0; b < ORDER; ++b, ++row)
      {
        m_equations(row, side_column(k, side, DEGREE, b)) = 1;
        m_right_hand_side.block(row, RIBBON_DATA * k + 8 * side, 1, 4) = raise.row(b);
      }
    for(int a = 0; a < ORDER; ++a, ++row)
    {
      m_equations(row, column(k, a, 0)) = 1;
      m_equations(row, column(k - 1, 0, a)) = -1;
    }
  }

  void set_smoothness(int k, int& row)
  {
    const Eigen::MatrixXd raise = elevation(3, DEGREE);
    for(int side = 0; side < 2; ++side)
      for(int b = 0; b < ORDER; ++b, ++row)
      {
        m_equations(row, side_column(k, side, DEGREE, b)) = DEGREE;
        m_equations(row, side_column(k, side, DEGREE - 1, b)) = -DEGREE;
        m_right_hand_side.block(row, RIBBON_DATA * k + 8 * side + 4, 1, 4) = raise.row(b);
      }
    static const std::array<double, ORDER> fifth_difference = {{1, -5, 10, -10, 5, -1}};
    for(int a = 0; a < ORDER; ++a)
      m_equations(row, column(k, a, 0)) = fifth_difference[a];
    ++row;
    const Eigen::MatrixXd along = spoke_derivative();
    for(int a = 0; a < ORDER; ++a, ++row)
    {
      m_equations(row, column(k, a, 1)) += DEGREE;
      m_equations(row, column(k, a, 0)) -= DEGREE;
      m_equations(row, column(k - 1, 1, a)) += DEGREE;
      m_equations(row, column(k - 1, 0, a)) -= DEGREE;
      for(int q = 0; q < ORDER; ++q)
        m_equations(row, column(k, q, 0)) -= along(a, q);
    }
  }

  // from the points of e, a quartic raised to degree five, to those of 2 cos(2 pi / n) (1-u)^2 e'
  Eigen::MatrixXd spoke_derivative() const
  {
    const Eigen::MatrixXd raise = elevation(4, DEGREE);
    const Eigen::MatrixXd lower
      = (raise.transpose() * raise).ldlt().solve(Eigen::MatrixXd(raise.transpose()));
    Eigen::MatrixXd difference = Eigen::MatrixXd::Zero(4, 5);
    for(int i = 0; i < 4; ++i)
    {
      difference(i, i) = -4;
      difference(i, i + 1) = 4;
    }
    // the product of a cubic with (1-u)^2 is of degree five: C(3,i) / C(5,i)
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(ORDER, 4);
    static const std::array<double, 4> factor = {{1., 3. / 5., 3. / 10., 1. / 10.}};
    for(int i = 0; i < 4; ++i)
      product(i, i) = factor[i];
    return 2 * std::cos(2 * CGAL_PI / m_valence) * product * difference * lower;
  }

  void set_objective()
  {
    const int n = m_valence, samples = SAMPLES * n, fairness = 2 * 3 * ORDER * n;
    m_objective = Eigen::MatrixXd::Zero(samples + fairness, POINTS * n);
    for(int k = 0; k < n; ++k)
      for(int j = 0; j <= INTERVALS; ++j)
        for(int i = 0; i <= INTERVALS; ++i)
        {
          const Eigen::VectorXd bu = bernstein(DEGREE, i / double(INTERVALS));
          const Eigen::VectorXd bv = bernstein(DEGREE, j / double(INTERVALS));
          const int row = SAMPLES * k + (INTERVALS + 1) * j + i;
          for(int b = 0; b < ORDER; ++b)
            for(int a = 0; a < ORDER; ++a)
              m_objective(row, column(k, a, b)) = bu[a] * bv[b];
        }
    static const std::array<double, 4> third_difference = {{-1, 3, -3, 1}};
    const double weight = std::sqrt(FAIRNESS_WEIGHT);
    int row = samples;
    for(int k = 0; k < n; ++k)
      for(int a = 0; a < ORDER; ++a)
        for(int s = 0; s + 3 < ORDER; ++s, row += 2)
          for(int q = 0; q < 4; ++q)
          {
            m_objective(row, column(k, s + q, a)) = weight * third_difference[q];
            m_objective(row + 1, column(k, a, s + q)) = weight * third_difference[q];
          }
  }

  // minimizes the objective on the affine space of the solutions of the exact equations
  void solve()
  {
    const int n = m_valence, unknowns = POINTS * n, exact = m_number_of_exact_equations;
    const int soft = int(m_equations.rows()) - exact;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> cod;
    cod.setThreshold(RANK_THRESHOLD);
    cod.compute(m_equations.topRows(exact));
    const int free_points = unknowns - int(cod.rank());
    Eigen::MatrixXd kernel = Eigen::MatrixXd::Zero(unknowns, free_points);
    kernel.bottomRows(free_points).setIdentity();
    kernel = (cod.colsPermutation() * (cod.matrixZ().transpose() * kernel)).eval();
    const Eigen::MatrixXd particular = cod.solve(m_right_hand_side.topRows(exact));

    Eigen::MatrixXd system(m_objective.rows() + soft, unknowns);
    system << m_objective, EQUATION_WEIGHT * m_equations.bottomRows(soft);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(system.rows(), number_of_data());
    right.leftCols(RIBBON_DATA * n) = -system * particular;
    right.block(0, RIBBON_DATA * n, SAMPLES * n, SAMPLES * n).setIdentity();
    right.block(m_objective.rows(), 0, soft, RIBBON_DATA * n)
      += EQUATION_WEIGHT * m_right_hand_side.bottomRows(soft);
    const Eigen::MatrixXd free = (system * kernel).colPivHouseholderQr().solve(right);
    m_operator = kernel * free;
    m_operator.leftCols(RIBBON_DATA * n) += particular;
  }

  int m_valence;
  bool m_is_smooth;
  int m_number_of_exact_equations = 0;
  Eigen::MatrixXd m_equations;       // the exact ones first
  Eigen::MatrixXd m_right_hand_side; // from the ribbons
  Eigen::MatrixXd m_objective;       // samples, then fairness
  Eigen::MatrixXd m_operator;
};

/// returns the operator of a valence, which is computed once for all surfaces
inline const Cap_operator& cap_operator(int valence, bool is_smooth)
{
  static std::mutex mutex;
  static std::map<std::pair<int, bool>, Cap_operator> operators;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto key = std::make_pair(valence, is_smooth);
  auto it = operators.find(key);
  if(it == operators.end())
    it = operators.emplace(key, Cap_operator(valence, is_smooth)).first;
  return it->second;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CAP_OPERATOR_H
