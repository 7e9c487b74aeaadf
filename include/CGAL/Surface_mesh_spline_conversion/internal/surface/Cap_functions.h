// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CAP_FUNCTIONS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CAP_FUNCTIONS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Cap_operator.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Extraordinary_face.h>

#include <Eigen/Core>
#include <Eigen/QR>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// The limit of subdivision round an extraordinary point where all knot intervals are equal. It
/// depends on two rings of control points: the center, then six points per sector.
class Uniform_neighborhood
{
public:
  explicit Uniform_neighborhood(int valence) : m_valence(valence), m_sectors(std::size_t(valence))
  {
    const auto table = std::make_shared<Catmull_clark_table>(valence, false, false);
    for(int k = 0; k < valence; ++k)
    {
      Extraordinary_face& sector = m_sectors[std::size_t(k)];
      sector.control_points.resize(std::size_t(number_of_points()));
      sector.quarters[0].table = table;
      sector.quarters[0].net = net(k);
    }
  }

  int number_of_points() const { return 1 + 6 * m_valence; }

  /// returns the values of the control points, and of their derivatives, at `(x,y)` in sector `k`
  Eigen::MatrixXd operator()(int k, double x, double y) const
  {
    Basis_matrix values;
    m_sectors[std::size_t(k)].evaluate(x / 2, y / 2, 1, values); // the sector is a quarter
    Eigen::MatrixXd result = values.topRows(3);
    result.bottomRows(2) /= 2;
    return result;
  }

private:
  // the point `a` steps along edge `k` and `b` along edge `k+1`
  int index(int k, int a, int b) const
  {
    if(a == 0)
      return b == 0 ? 0 : index(k + 1, b, 0);
    return 1 + 6 * ((k + m_valence) % m_valence) + 3 * (a - 1) + b;
  }

  // the points of the net of a face, see `index_in_net()`
  Stencil_matrix net(int k) const
  {
    Stencil_matrix result = Stencil_matrix::Zero(size_of_net(m_valence), number_of_points());
    result(0, 0) = 1;
    for(int i = 0; i < m_valence; ++i)
      for(int b = 0; b < 2; ++b)
        result(1 + 2 * i + b, index(k + i, 1, b)) = 1;
    const std::array<int, 7> outer = {{index(k, 2, 0), index(k, 2, 1), index(k, 2, 2),
      index(k, 1, 2), index(k, 0, 2), index(k - 1, 1, 2), index(k + 1, 2, 1)}};
    for(int i = 0; i < 7; ++i)
      result(1 + 2 * m_valence + i, outer[std::size_t(i)]) = 1;
    return result;
  }

  int m_valence;
  std::vector<Extraordinary_face> m_sectors;
};

/// Returns what a cap depends on: the data of `Cap_operator` on the outer sides, and the
/// extraordinary point. `evaluate(k, x, y)` returns the values of functions and of their derivatives
/// in three rows, as above.
template <typename Evaluate>
Eigen::MatrixXd cap_data(int valence, Eigen::Index number_of_functions, const Evaluate& evaluate)
{
  constexpr int side_data = Cap_operator::RIBBON_DATA / 2;
  Eigen::Matrix4d to_bezier; // from the points of a cubic at 0, 1/3, 2/3, 1
  to_bezier << 6, 0, 0, 0, -5, 18, -9, 2, 2, -9, 18, -5, 0, 0, 0, 6;
  to_bezier /= 6;
  Eigen::MatrixXd result(Cap_operator::RIBBON_DATA * valence + 1, number_of_functions);
  for(int k = 0; k < valence; ++k)
    for(int side = 0; side < 2; ++side)
    {
      Eigen::MatrixXd points(4, number_of_functions), derivatives(4, number_of_functions);
      for(int i = 0; i < 4; ++i)
      {
        const Eigen::MatrixXd values = side == 0 ? evaluate(k, 1., i / 3.) : evaluate(k, i / 3., 1.);
        points.row(i) = values.row(0);
        derivatives.row(i) = values.row(1 + side);
      }
      const int row = Cap_operator::RIBBON_DATA * k + side_data * side;
      result.middleRows(row, 4) = to_bezier * points;
      result.middleRows(row + 4, 4) = to_bezier * derivatives;
    }
  result.bottomRows(1) = evaluate(0, 0., 0.).topRows(1);
  return result;
}

/// computes the matrix from the data of a cap to its Bezier points
inline Eigen::MatrixXd make_cap_matrix(int valence)
{
  constexpr int intervals = Cap_operator::INTERVALS;
  const Uniform_neighborhood neighborhood(valence);
  const Eigen::MatrixXd data
    = cap_data(valence, neighborhood.number_of_points(), neighborhood);
  const Eigen::MatrixXd from_data
    = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(data).pseudoInverse();
  Eigen::MatrixXd samples(Cap_operator::SAMPLES * valence, neighborhood.number_of_points());
  int row = 0;
  for(int k = 0; k < valence; ++k)
    for(int j = 0; j <= intervals; ++j)
      for(int i = 0; i <= intervals; ++i, ++row)
        samples.row(row)
          = neighborhood(k, i / double(intervals), j / double(intervals)).row(0);
  const int ribbons = Cap_operator::RIBBON_DATA * valence;
  Eigen::MatrixXd all = Eigen::MatrixXd::Identity(ribbons + samples.rows(), data.rows());
  all.bottomRows(samples.rows()) = samples * from_data;
  return cap_operator(valence, true)(all);
}

/// returns the matrix of a valence, which is computed once for all surfaces
inline const Eigen::MatrixXd& cap_matrix(int valence)
{
  static std::mutex mutex;
  static std::map<int, Eigen::MatrixXd> matrices;
  const std::lock_guard<std::mutex> lock(mutex);
  auto it = matrices.find(valence);
  if(it == matrices.end())
    it = matrices.emplace(valence, make_cap_matrix(valence)).first;
  return it->second;
}

/// The functions of the control points of a surface on a cap, which takes the place of the limit of
/// subdivision round an extraordinary point.
class Cap_functions
{
public:
  /// `data`: see `cap_data()`, with a column for each control point
  Cap_functions(const std::vector<std::size_t>& control_points, int valence,
                const Eigen::MatrixXd& data)
    : m_control_points(control_points), m_points(cap_matrix(valence) * data)
    , m_residual(cap_operator(valence, true).residual(m_points, data))
    , m_bound(m_points.cwiseAbs().rowwise().sum().maxCoeff())
  {}

  /// is the cap tangent continuous? It cannot be so where the surface beside it is not.
  bool is_smooth() const { return m_residual < largest_residual; }

  const std::vector<std::size_t>& control_points() const { return m_control_points; }

  /// returns a bound of the sum of the magnitudes of all functions
  double bound() const { return m_bound; }

  /// evaluates the functions at `(x,y)` in a sector, up to the derivatives of the given order
  void evaluate(int sector, double x, double y, int order, Basis_matrix& result) const
  {
    constexpr int derivative[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
    Eigen::Matrix<double, 6, Cap_operator::POINTS, Eigen::RowMajor> weights;
    weights.setZero();
    for(int k = 0; k < 6; ++k)
    {
      if(derivative[k][0] + derivative[k][1] > order)
        break;
      const Eigen::VectorXd u = bernstein(x, derivative[k][0]), v = bernstein(y, derivative[k][1]);
      for(int b = 0; b < Cap_operator::ORDER; ++b)
        weights.row(k).segment(Cap_operator::ORDER * b, Cap_operator::ORDER) = v[b] * u.transpose();
    }
    result = weights.lazyProduct(
      m_points.middleRows(Cap_operator::POINTS * sector, Cap_operator::POINTS));
  }

private:
  static constexpr double largest_residual = 1e-10; // of sums of functions of order one

  // the derivatives of Bernstein polynomials are differences of those of lower degree
  static Eigen::VectorXd bernstein(double t, int derivative)
  {
    Eigen::VectorXd result = Cap_operator::bernstein(Cap_operator::DEGREE - derivative, t);
    for(int d = derivative; d > 0; --d)
    {
      const Eigen::Index n = result.size();
      Eigen::VectorXd next = Eigen::VectorXd::Zero(n + 1);
      next.tail(n) = double(n) * result;
      next.head(n) -= double(n) * result;
      result = next;
    }
    return result;
  }

  std::vector<std::size_t> m_control_points;
  Stencil_matrix m_points; // Bezier points, see `Cap_operator`
  double m_residual;
  double m_bound;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CAP_FUNCTIONS_H
