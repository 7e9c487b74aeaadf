// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_DISTORTION_ENERGY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_DISTORTION_ENERGY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

typedef Eigen::Matrix<double, 4, 1> Jacobian_gradient;  // with respect to J00, J01, J10, J11
typedef Eigen::Matrix<double, 4, 4> Jacobian_hessian;

// Distortion of a linear map J of the plane, zero derivative at rotations:
//   E = (|J|^2 + det(J)^2 + 1) / chi(det(J)),  chi(d) = (d + sqrt(d^2 + epsilon^2)) / 2
// (Garanzha et al. 2021). With epsilon = 0 it is infinite where det(J) <= 0; a positive epsilon
// lets inverted triangles turn over.
class Distortion_energy
{
public:
  explicit Distortion_energy(double epsilon) : m_epsilon(epsilon) {}

  // the smallest value, for rotations, in the limit of epsilon = 0
  static constexpr double minimum = 4;

  double chi(double d) const
  {
    const double root = std::sqrt(m_epsilon * m_epsilon + d * d);
    if(d > 0)
      return (d + root) / 2;
    // no cancellation for large negative d
    return m_epsilon > 0 ? m_epsilon * m_epsilon / (2 * (root - d)) : 0.;
  }

  double value(const Eigen::Matrix2d& J) const
  {
    const double d = J.determinant();
    const double c = chi(d);
    if(!(c > 0))
      return std::numeric_limits<double>::infinity();
    return (J.squaredNorm() + d * d + 1) / c;
  }

  // gradient, and the hessian without its negative eigenvalues. With J = U diag(s0, s1) V^T it has
  // the eigenvectors U twist V^T and U flip V^T and otherwise acts on U diag(., .) V^T.
  void derivatives(const Eigen::Matrix2d& J, Jacobian_gradient& gradient,
                   Jacobian_hessian& hessian) const
  {
    Eigen::Matrix2d U, V;
    Eigen::Vector2d s;
    decompose(J, U, s, V);
    const double d = s[0] * s[1], norm = s.squaredNorm();
    const double root = std::sqrt(m_epsilon * m_epsilon + d * d);
    const double c = chi(d), c1 = c / root;
    const double c2 = m_epsilon * m_epsilon / (2 * root * root * root);
    const double numerator = norm + d * d + 1;
    // derivatives with respect to the squared norm n and the determinant d
    const double E_n = 1 / c, E_nd = -c1 / (c * c);
    const double E_d = 2 * d / c - numerator * c1 / (c * c);
    const double E_dd = 2 / c - 4 * d * c1 / (c * c)
                        + numerator * (2 * c1 * c1 / c - c2) / (c * c);

    const Eigen::Vector2d g(2 * E_n * s[0] + E_d * s[1], 2 * E_n * s[1] + E_d * s[0]);
    const Eigen::Matrix2d first = U.col(0) * V.col(0).transpose();
    const Eigen::Matrix2d second = U.col(1) * V.col(1).transpose();
    gradient = g[0] * flat(first) + g[1] * flat(second);

    const double h00 = 2 * E_n + 4 * E_nd * d + E_dd * s[1] * s[1];
    const double h11 = 2 * E_n + 4 * E_nd * d + E_dd * s[0] * s[0];
    const double h01 = E_d + E_dd * d + 2 * E_nd * norm;
    hessian.setZero();
    add_symmetric_block(h00, h01, h11, flat(first), flat(second), hessian);
    const Eigen::Matrix2d a = U.col(0) * V.col(1).transpose(), b = U.col(1) * V.col(0).transpose();
    add_mode(2 * E_n + E_d, flat(a - b) * std::sqrt(0.5), hessian);
    add_mode(2 * E_n - E_d, flat(a + b) * std::sqrt(0.5), hessian);
  }

private:
  // keeps the system definite
  static constexpr double smallest_eigenvalue = 1e-8;

  static Jacobian_gradient flat(const Eigen::Matrix2d& M)
  {
    return Jacobian_gradient(M(0, 0), M(0, 1), M(1, 0), M(1, 1));
  }

  // J = U diag(s) V^T with rotations U and V; s[1] has the sign of det(J)
  static void decompose(const Eigen::Matrix2d& J, Eigen::Matrix2d& U, Eigen::Vector2d& s,
                        Eigen::Matrix2d& V)
  {
    const double e = (J(0, 0) + J(1, 1)) / 2, f = (J(0, 0) - J(1, 1)) / 2;
    const double g = (J(1, 0) + J(0, 1)) / 2, h = (J(1, 0) - J(0, 1)) / 2;
    const double q = std::sqrt(e * e + h * h), r = std::sqrt(f * f + g * g);
    s = Eigen::Vector2d(q + r, q - r);
    // turns by the sum and the difference of the angles of U and V, of which U is half the sum
    const Turn sum = r > 0 ? Turn(f / r, g / r) : Turn(1);
    const Turn difference = q > 0 ? Turn(e / q, h / q) : Turn(1);
    const Turn u = half(sum * difference);
    U = rotation(u);
    V = rotation(u * std::conj(difference));
  }

  typedef std::complex<double> Turn; // of absolute value 1

  // one of the two turns whose square is `turn`
  static Turn half(const Turn& turn)
  {
    const double larger = std::sqrt((1 + std::abs(turn.real())) / 2);
    const double smaller = turn.imag() / (2 * larger);
    return turn.real() > 0 ? Turn(larger, smaller) : Turn(smaller, larger);
  }

  static Eigen::Matrix2d rotation(const Turn& turn)
  {
    Eigen::Matrix2d R;
    R << turn.real(), -turn.imag(), turn.imag(), turn.real();
    return R;
  }

  static void add_mode(double eigenvalue, const Jacobian_gradient& mode, Jacobian_hessian& hessian)
  {
    hessian.noalias() += (std::max)(eigenvalue, smallest_eigenvalue) * mode * mode.transpose();
  }

  static void add_symmetric_block(double h00, double h01, double h11, const Jacobian_gradient& a,
                                  const Jacobian_gradient& b, Jacobian_hessian& hessian)
  {
    const double mean = (h00 + h11) / 2, difference = (h00 - h11) / 2;
    const double radius = std::sqrt(difference * difference + h01 * h01);
    const Turn turn = radius > 0 ? half(Turn(difference / radius, h01 / radius)) : Turn(1);
    const double c = turn.real(), s = turn.imag();
    add_mode(mean + radius, c * a + s * b, hessian);
    add_mode(mean - radius, c * b - s * a, hessian);
  }

  double m_epsilon;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_DISTORTION_ENERGY_H
