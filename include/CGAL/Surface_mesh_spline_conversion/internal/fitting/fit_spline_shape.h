// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FIT_SPLINE_SHAPE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FIT_SPLINE_SHAPE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Span_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_cubic_spline.h>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Improves the fit of a cubic spline to a curve where only its shape counts, not where on the curve
// the points of the spline are.
//
// The distances across the curve, at the closest points of the curve, are minimized in the
// least-squares sense by Gauss-Newton steps; the distances along it, to the points at equal
// parameters, count with a small weight. A coarse spline may then be about twice as close to the
// curve as the fit at equal parameters. The ends of an open spline stay, as do the directions of its
// end derivatives; their lengths are unknowns. At the joints, the spline passes through the points of
// the curve at equal parameters.
//
// The weight is the given one on spans of length 1, and grows with the inverse square of the
// length. Short spans are there for a jump of the curvature, where sliding along the curve gains
// little, but would make the speed of the spline ripple.
template <typename CurveTarget>
class Spline_shape_fitter
{
public:
  Spline_shape_fitter(const Cubic_spline_basis& basis, const std::vector<double>& joints,
                      CurveTarget& target, double tangential_weight)
    : m_basis(basis), m_target(target), m_tangential_weight(tangential_weight),
      m_is_periodic(basis.is_periodic())
  {
    make_samples();
    for(double x : joints)
      m_joints.emplace_back(basis.values(basis.span_of(x), x), target.point(x));
  }

  // improves `polygon`, a fit at equal parameters; returns `false` if the linear system is singular
  bool operator()(Control_polygon& polygon)
  {
    constexpr int number_of_steps = 3; // further ones change nothing that counts
    for(int i = 0; i < number_of_steps; ++i)
    {
      for(Sample& sample : m_samples)
        sample.foot = closer_foot(evaluate(sample.values, polygon, 0), sample.foot, m_target);
      if(!step(polygon))
        return false;
    }
    return true;
  }

private:
  struct Sample
  {
    Cubic_spline_basis::Values values;
    double weight, tangential_weight;
    double first_arc_length; // at the same parameter
    Curve_foot foot;
  };

  // an unknown, and where it moves one of the four control points of a span
  struct Term
  {
    int unknown;
    std::size_t function;
    Eigen::Vector3d direction;
  };

  void make_samples()
  {
    for(std::size_t span = 0; span < m_basis.number_of_spans(); ++span)
    {
      const double begin = m_basis.span_begin(span), length = m_basis.span_end(span) - begin;
      for(std::size_t k = 0; k < boole_weights.size(); ++k)
      {
        const double x = begin + length * (double(k) / 4);
        const Curve_foot foot = m_target.foot(x);
        m_samples.push_back({m_basis.values(span, x), boole_weights[k] * length,
                             (std::min)(1., m_tangential_weight / (length * length)),
                             foot.arc_length, foot});
      }
    }
  }

  // The unknowns are, in the order of the control points, the moves of the free ones, and in an
  // open spline those of the second and of the second last one along the tangents.
  std::vector<Term> terms(const Cubic_spline_basis::Values& values,
                          const Control_polygon& polygon) const
  {
    std::vector<Term> result;
    result.reserve(12);
    const std::size_t n = polygon.size();
    for(std::size_t i = 0; i < 4; ++i)
    {
      const std::size_t f = values.functions[i];
      if(m_is_periodic || (f > 1 && f + 2 < n))
        for(int d = 0; d < 3; ++d)
          result.push_back({first_unknown(f) + d, i, Eigen::Vector3d::Unit(d)});
      else if(f == 1)
        result.push_back({0, i, polygon[1] - polygon[0]});
      else if(f + 2 == n)
        result.push_back({first_unknown(f), i, polygon[n - 2] - polygon[n - 1]});
    }
    return result;
  }

  int first_unknown(std::size_t control_point) const
  {
    return 3 * static_cast<int>(control_point) - (m_is_periodic ? 0 : 5);
  }

  int number_of_unknowns() const
  {
    return 3 * static_cast<int>(m_basis.size()) - (m_is_periodic ? 0 : 10);
  }

  // The constraints: what the moves add to the points at the joints takes these to the curve. The
  // multipliers are the unknowns from `first` on.
  void add_joints(const Control_polygon& polygon, int first,
                  std::vector<Eigen::Triplet<double> >& entries,
                  Eigen::VectorXd& right_hand_side) const
  {
    for(const auto& [values, point] : m_joints)
    {
      right_hand_side.segment<3>(first) = point - evaluate(values, polygon, 0);
      for(const Term& term : terms(values, polygon))
        for(int d = 0; d < 3; ++d)
          entries.emplace_back(first + d, term.unknown,
                               values.derivatives[0][term.function] * term.direction[d]);
      for(int d = 0; d < 3; ++d, ++first)
        entries.emplace_back(first, first, multiplier_regularization);
    }
  }

  // adds the samples of a span, which depend on the same control points
  void add_span(std::size_t span, const Control_polygon& polygon,
                std::vector<Eigen::Triplet<double> >& entries,
                Eigen::VectorXd& right_hand_side) const
  {
    Eigen::Matrix<double, 12, 12> products = Eigen::Matrix<double, 12, 12>::Zero();
    Eigen::Matrix<double, 3, 4> residuals = Eigen::Matrix<double, 3, 4>::Zero();
    const auto first = m_samples.begin() + std::ptrdiff_t(span * boole_weights.size());
    for(auto it = first; it != first + boole_weights.size(); ++it)
    {
      const Eigen::Vector3d& tangent = it->foot.tangent;
      const Eigen::Matrix3d weight
        = it->weight * (Eigen::Matrix3d::Identity()
                        - (1 - it->tangential_weight) * tangent * tangent.transpose());
      const Eigen::Vector3d residual
        = weight * (it->foot.point + (it->first_arc_length - it->foot.arc_length) * tangent
                    - evaluate(it->values, polygon, 0));
      const Cubic_spline_basis::Row& row = it->values.derivatives[0];
      for(int i = 0; i < 4; ++i)
      {
        residuals.col(i) += row[i] * residual;
        for(int j = 0; j < 4; ++j)
          products.block<3, 3>(3 * i, 3 * j) += (row[i] * row[j]) * weight;
      }
    }
    const std::vector<Term> span_terms = terms(first->values, polygon);
    for(const Term& a : span_terms)
    {
      right_hand_side[a.unknown] += a.direction.dot(residuals.col(a.function));
      for(const Term& b : span_terms)
        if(b.unknown <= a.unknown)
          entries.emplace_back(a.unknown, b.unknown,
                               a.direction.dot(products.block<3, 3>(3 * a.function, 3 * b.function)
                                               * b.direction));
    }
  }

  bool step(Control_polygon& polygon) const
  {
    const int n = number_of_unknowns() + 3 * static_cast<int>(m_joints.size());
    std::vector<Eigen::Triplet<double> > entries;
    Eigen::VectorXd right_hand_side = Eigen::VectorXd::Zero(n);
    for(std::size_t span = 0; span < m_basis.number_of_spans(); ++span)
      add_span(span, polygon, entries, right_hand_side);
    add_joints(polygon, number_of_unknowns(), entries, right_hand_side);
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    // the matrix is a band, but for the constraints and the corners of a periodic one
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower,
                          Eigen::NaturalOrdering<int> > solver(matrix);
    if(solver.info() != Eigen::Success)
      return false;
    const Eigen::VectorXd moves = solver.solve(right_hand_side);
    if(!moves.allFinite())
      return false;
    move(moves, polygon);
    return true;
  }

  void move(const Eigen::VectorXd& moves, Control_polygon& polygon) const
  {
    const std::size_t n = polygon.size(), fixed = m_is_periodic ? 0 : 2;
    for(std::size_t i = fixed; i < n - fixed; ++i)
      polygon[i] += moves.segment<3>(first_unknown(i));
    if(m_is_periodic)
      return;
    polygon[1] += moves[0] * (polygon[1] - polygon[0]);
    polygon[n - 2] += moves[first_unknown(n - 2)] * (polygon[n - 2] - polygon[n - 1]);
  }

  const Cubic_spline_basis& m_basis;
  CurveTarget& m_target;
  double m_tangential_weight;
  bool m_is_periodic;
  std::vector<Sample> m_samples;
  std::vector<std::pair<Cubic_spline_basis::Values, Eigen::Vector3d> > m_joints; // and their points
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FIT_SPLINE_SHAPE_H
