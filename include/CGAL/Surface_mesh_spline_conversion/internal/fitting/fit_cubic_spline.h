// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FIT_CUBIC_SPLINE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FIT_CUBIC_SPLINE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Cubic_spline_basis.h>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A `CurveTarget` has the functions `Eigen::Vector3d point(double x)` and
// `Eigen::Vector3d derivative(double x)`; a periodic target accepts any `x`.

typedef std::vector<Eigen::Vector3d> Control_polygon;

// returns the derivative of the given order of a spline
inline Eigen::Vector3d evaluate(const Cubic_spline_basis::Values& values,
                                const Control_polygon& polygon, std::size_t order)
{
  Eigen::Vector3d result(0, 0, 0);
  for(std::size_t i = 0; i < 4; ++i)
    result += values.derivatives[order][i] * polygon[values.functions[i]];
  return result;
}

// Boole's rule on the unit interval; it has degree of exactness 5, and positive weights
constexpr std::array<double, 5> boole_weights
  = {{7. / 90, 32. / 90, 12. / 90, 32. / 90, 7. / 90}};

// On the diagonal of the multipliers of constraints: the matrix is then quasidefinite (Vanderbei,
// 1995), so that it can be factorized even where constraints depend on each other, and the
// constraints hold up to about this share of what the least squares alone would leave. Multipliers
// are the last unknowns, and have to be eliminated last: as pivots, they would cancel the rest.
constexpr double multiplier_regularization = -1e-10;

// Fits a cubic spline to a curve in the least-squares sense (paper, section 3.2.1). At the joints,
// which are parameters, the spline passes through the points of the curve: edges of other faces of
// a CAD model may end there.
//
// The end points and end derivatives of an open spline are those of the target (section 3.2.2);
// they fix the two first and the two last control points, which are eliminated. The three
// coordinates share one matrix, hence a curve in a plane has its control points in this plane.
template <typename CurveTarget>
class Cubic_spline_fitter
{
public:
  Cubic_spline_fitter(const Cubic_spline_basis& basis, const std::vector<double>& joints,
                      CurveTarget& target)
    : m_basis(basis), m_joints(joints), m_target(target),
      m_polygon(basis.size(), Eigen::Vector3d(0, 0, 0)), m_first_free(basis.is_periodic() ? 0 : 2),
      m_number_of_free(basis.size() - 2 * m_first_free)
  {}

  // returns `false` if the linear system is singular
  bool operator()()
  {
    // coordinates relative to a point of the curve: rounding is that of the size of the curve,
    // not that of its distance to the origin
    m_origin = m_target.point(m_basis.span_begin(0));
    if(!m_basis.is_periodic())
      fix_ends();
    if(m_number_of_free > 0 && !solve())
      return false;
    for(Eigen::Vector3d& p : m_polygon)
      p += m_origin;
    if(!m_basis.is_periodic())
      m_polygon.back() = m_target.point(m_basis.span_end(m_basis.number_of_spans() - 1));
    return true;
  }

  const Control_polygon& polygon() const { return m_polygon; }

private:
  void fix_ends()
  {
    const std::size_t n = m_basis.size(), last_span = m_basis.number_of_spans() - 1;
    const double begin = m_basis.span_begin(0), end = m_basis.span_end(last_span);
    const double first_length = m_basis.span_end(0) - begin;
    const double last_length = end - m_basis.span_begin(last_span);
    const Eigen::Vector3d last_point = m_target.point(end) - m_origin;
    m_polygon[0].setZero();
    m_polygon[1] = m_target.derivative(begin) * (first_length / 3);
    m_polygon[n - 1] = last_point;
    m_polygon[n - 2] = last_point - m_target.derivative(end) * (last_length / 3);
  }

  bool is_free(std::size_t i) const
  {
    return i >= m_first_free && i < m_first_free + m_number_of_free;
  }

  // what the free functions have to add up to at `x`
  Eigen::Vector3d value_of_free(const Cubic_spline_basis::Values& values, double x) const
  {
    Eigen::Vector3d result = m_target.point(x) - m_origin;
    for(std::size_t i = 0; i < 4; ++i)
      if(!is_free(values.functions[i]))
        result -= values.derivatives[0][i] * m_polygon[values.functions[i]];
    return result;
  }

  // the constraint with the given number; its multiplier is the unknown behind the free points
  void add_joint(std::size_t number)
  {
    const double x = m_joints[number];
    const Cubic_spline_basis::Values values = m_basis.values(m_basis.span_of(x), x);
    const int r = static_cast<int>(m_number_of_free + number);
    m_right_hand_side.row(r) = value_of_free(values, x).transpose();
    for(std::size_t i = 0; i < 4; ++i)
      if(is_free(values.functions[i]))
        m_entries.emplace_back(r, static_cast<int>(values.functions[i] - m_first_free),
                               values.derivatives[0][i]);
    m_entries.emplace_back(r, r, multiplier_regularization);
  }

  void add_sample(std::size_t span, double x, double weight)
  {
    const Cubic_spline_basis::Values values = m_basis.values(span, x);
    const Cubic_spline_basis::Row& row = values.derivatives[0];
    const Eigen::Vector3d value = value_of_free(values, x);
    for(std::size_t i = 0; i < 4; ++i)
    {
      if(!is_free(values.functions[i]))
        continue;
      const int r = static_cast<int>(values.functions[i] - m_first_free);
      m_right_hand_side.row(r) += weight * row[i] * value.transpose();
      for(std::size_t j = 0; j < 4; ++j)
      {
        const int c = static_cast<int>(values.functions[j]) - static_cast<int>(m_first_free);
        if(is_free(values.functions[j]) && c <= r)
          m_entries.emplace_back(r, c, weight * row[i] * row[j]);
      }
    }
  }

  bool solve()
  {
    const int n = static_cast<int>(m_number_of_free + m_joints.size());
    m_right_hand_side.setZero(n, 3);
    for(std::size_t span = 0; span < m_basis.number_of_spans(); ++span)
    {
      const double begin = m_basis.span_begin(span), length = m_basis.span_end(span) - begin;
      for(std::size_t k = 0; k < boole_weights.size(); ++k)
        add_sample(span, begin + length * (double(k) / 4), length * boole_weights[k]);
    }
    for(std::size_t k = 0; k < m_joints.size(); ++k)
      add_joint(k);
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(m_entries.begin(), m_entries.end());
    // the matrix is a band, but for the constraints and the corners of a periodic one
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower,
                          Eigen::NaturalOrdering<int> > solver(matrix);
    if(solver.info() != Eigen::Success)
      return false;
    const Eigen::MatrixXd solution = solver.solve(m_right_hand_side);
    if(!solution.allFinite())
      return false;
    for(std::size_t i = 0; i < m_number_of_free; ++i)
      m_polygon[m_first_free + i] = solution.row(static_cast<int>(i)).transpose();
    return true;
  }

  const Cubic_spline_basis& m_basis;
  const std::vector<double>& m_joints;
  CurveTarget& m_target;
  Control_polygon m_polygon;
  std::size_t m_first_free, m_number_of_free;
  Eigen::Vector3d m_origin;
  Eigen::MatrixXd m_right_hand_side;
  std::vector<Eigen::Triplet<double> > m_entries;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FIT_CUBIC_SPLINE_H
