// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CREASE_RIBBONS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CREASE_RIBBONS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/blossoms.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Cross derivatives on both sides of a crease line that lie in common tangent planes.
///
/// Let e(y) be the line, R-(y) and R+(y) the derivatives by x on its left and right, T their mean
/// and K half their difference. The new ones are T - k and T + k with k = a T + b e': whatever the
/// functions a and b, they span the same plane with e'. At the boundary k = K, because there R- and
/// R+ are tangents of the curves, which enclose the direction of the line; at the other end k and
/// k' vanish, as K and K' do. In between, a (quadratic) and b (cubic between two breaks, both once
/// continuously differentiable) are chosen such that k is closest to K.
class Crease_ribbons
{
public:
  static constexpr int DEGREE = 5;
  typedef Eigen::Vector3d Vector;
  typedef std::array<Vector, DEGREE + 1> Quintic;

  /// \param left, right the surface between two breaks each, with x from left to right and y
  ///         inwards
  /// \param lengths of these pieces along y
  /// \param widths of the left and the right pieces
  Crease_ribbons(const std::vector<Bicubic>& left, const std::vector<Bicubic>& right,
                 const std::vector<double>& lengths, const std::array<double, 2>& widths)
    : m_lengths(lengths), m_pieces(lengths.size())
  {
    for(std::size_t k = 0; k < m_pieces.size(); ++k)
      for(int j = 0; j < 4; ++j)
      {
        const Vector line = left[k][4 * j + 3];
        const Vector before = 3 / widths[0] * (line - left[k][4 * j + 2]);
        const Vector after = 3 / widths[1] * (right[k][4 * j + 1] - line);
        m_pieces[k].mean[j] = (before + after) / 2;
        m_pieces[k].jump[j] = (after - before) / 2;
        if(j > 0)
          m_pieces[k].tangent[j - 1] = 3 / lengths[k] * (line - left[k][4 * (j - 1) + 3]);
      }
    fit();
  }

  /// do both sides keep their orientation?
  bool is_regular() const
  {
    bool result = true;
    for_each_sample([&](const Piece& p, double t, const Vector& k)
    {
      const Vector tangent = value(p.tangent, t), mean = value(p.mean, t), jump = value(p.jump, t);
      for(int sign : {-1, 1})
        result = result && (mean + sign * jump).cross(tangent).dot((mean + sign * k).cross(tangent)) > 0;
    });
    return result;
  }

  /// returns by how much the surface moves along its normals on the left (0) or right (1), if the
  /// second of four columns of Bezier points is changed over `width`
  double deviation(std::size_t side, double width) const
  {
    constexpr double largest_bernstein_value = 4. / 9.;
    double largest = 0;
    for_each_sample([&](const Piece& p, double t, const Vector& k)
    {
      const Vector jump = value(p.jump, t);
      const Vector derivative = value(p.mean, t) + (side == 0 ? -1 : 1) * jump;
      const Vector normal = derivative.cross(value(p.tangent, t)).normalized();
      largest = (std::max)(largest, std::abs(normal.dot(k - jump)));
    });
    return largest * width / 3 * largest_bernstein_value;
  }

  /// returns the Bezier points of what is added to the derivative by x on piece `k` of a side
  Quintic change(std::size_t side, std::size_t k) const
  {
    const Quintic old = raised(m_pieces[k].jump);
    Quintic result;
    for(int i = 0; i <= DEGREE; ++i)
      result[i] = (side == 0 ? -1 : 1) * (m_pieces[k].new_jump[i] - old[i]);
    return result;
  }

  /// returns the Bezier points of degree five of a cubic
  static Quintic raised(const Cubic& c)
  {
    return product(std::array<double, 3>{{1, 1, 1}}, c);
  }

private:
  static constexpr int SAMPLES_PER_PIECE = 16;

  struct Piece
  {
    Cubic mean;                    // T
    Cubic jump;                    // K
    std::array<Vector, 3> tangent; // e'
    Quintic new_jump;              // k
  };

  static double binomial(int n, int k)
  {
    double result = 1;
    for(int i = 0; i < k; ++i)
      result = result * (n - i) / (i + 1);
    return result;
  }

  // the product of a polynomial with numbers and one with vectors as Bezier points
  template <std::size_t M, std::size_t N>
  static Quintic product(const std::array<double, M>& a, const std::array<Vector, N>& b)
  {
    static_assert(M + N == DEGREE + 2, "the product has degree five");
    constexpr int m = int(M) - 1, n = int(N) - 1;
    Quintic result;
    result.fill(Vector::Zero());
    for(int i = 0; i <= m; ++i)
      for(int j = 0; j <= n; ++j)
        result[i + j] += binomial(m, i) * binomial(n, j) / binomial(DEGREE, i + j) * a[i] * b[j];
    return result;
  }

  static double bernstein(int degree, int i, double t)
  {
    return binomial(degree, i) * std::pow(t, i) * std::pow(1 - t, degree - i);
  }

  template <std::size_t N>
  static Vector value(const std::array<Vector, N>& b, double t)
  {
    Vector result = Vector::Zero();
    for(int i = 0; i < int(N); ++i)
      result += bernstein(int(N) - 1, i, t) * b[i];
    return result;
  }

  template <typename Function>
  void for_each_sample(const Function& f) const
  {
    for(const Piece& p : m_pieces)
      for(int s = 0; s <= SAMPLES_PER_PIECE; ++s)
        f(p, s / double(SAMPLES_PER_PIECE), value(p.new_jump, s / double(SAMPLES_PER_PIECE)));
  }

  // The unknowns: three Bezier points of a and four of b for each piece.
  static constexpr int UNKNOWNS = 7;

  static int unknown_a(std::size_t piece, int i) { return UNKNOWNS * int(piece) + i; }
  static int unknown_b(std::size_t piece, int i) { return UNKNOWNS * int(piece) + 3 + i; }

  void fit()
  {
    const int n = int(m_pieces.size());
    Eigen::MatrixXd conditions = Eigen::MatrixXd::Zero(4 * n + 2, UNKNOWNS * n);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(4 * n + 2);
    set_conditions(conditions, values);
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(conditions);
    const Eigen::VectorXd particular = lu.solve(values);
    const Eigen::MatrixXd kernel = lu.kernel();
    Eigen::MatrixXd system;
    Eigen::VectorXd jumps;
    set_objective(system, jumps);
    const Eigen::VectorXd x = particular + kernel * (system * kernel).colPivHouseholderQr().solve(
      Eigen::VectorXd(jumps - system * particular));
    for(std::size_t k = 0; k < m_pieces.size(); ++k)
    {
      Piece& p = m_pieces[k];
      std::array<double, 3> a;
      std::array<double, 4> b;
      for(int i = 0; i < 3; ++i)
        a[i] = x[unknown_a(k, i)];
      for(int i = 0; i < 4; ++i)
        b[i] = x[unknown_b(k, i)];
      const Quintic along_mean = product(a, p.mean), along_line = product(b, p.tangent);
      for(int i = 0; i <= DEGREE; ++i)
        p.new_jump[i] = along_mean[i] + along_line[i];
    }
  }

  void set_conditions(Eigen::MatrixXd& conditions, Eigen::VectorXd& values) const
  {
    Eigen::Matrix<double, 3, 2> plane;
    plane << m_pieces[0].mean[0], m_pieces[0].tangent[0];
    values.head<2>() = plane.colPivHouseholderQr().solve(m_pieces[0].jump[0]);
    conditions(0, unknown_a(0, 0)) = 1;
    conditions(1, unknown_b(0, 0)) = 1;
    int row = 2;
    const std::size_t n = m_pieces.size();
    for(std::size_t k = 0; k < n; ++k, row += 4)
    {
      conditions(row, unknown_a(k, 2)) = 1;
      conditions(row + 1, unknown_b(k, 3)) = 1;
      conditions(row + 2, unknown_a(k, 1)) = -1 / m_lengths[k];
      conditions(row + 2, unknown_a(k, 2)) = 1 / m_lengths[k];
      conditions(row + 3, unknown_b(k, 2)) = -1 / m_lengths[k];
      conditions(row + 3, unknown_b(k, 3)) = 1 / m_lengths[k];
      if(k + 1 == n)
        continue;
      conditions(row, unknown_a(k + 1, 0)) = -1;
      conditions(row + 1, unknown_b(k + 1, 0)) = -1;
      for(int i = 0; i < 2; ++i)
      {
        const double sign = (i == 0) ? 1 : -1;
        conditions(row + 2, unknown_a(k + 1, i)) = sign / m_lengths[k + 1];
        conditions(row + 3, unknown_b(k + 1, i)) = sign / m_lengths[k + 1];
      }
    }
  }

  // the differences between k and K at samples, weighted by the lengths of the pieces
  void set_objective(Eigen::MatrixXd& system, Eigen::VectorXd& jumps) const
  {
    const int n = int(m_pieces.size()), rows = 3 * (SAMPLES_PER_PIECE + 1) * n;
    system = Eigen::MatrixXd::Zero(rows, UNKNOWNS * n);
    jumps = Eigen::VectorXd::Zero(rows);
    int row = 0;
    for(std::size_t k = 0; k < m_pieces.size(); ++k)
      for(int s = 0; s <= SAMPLES_PER_PIECE; ++s, row += 3)
      {
        const Piece& p = m_pieces[k];
        const double t = s / double(SAMPLES_PER_PIECE), weight = std::sqrt(m_lengths[k]);
        for(int i = 0; i < 3; ++i)
          system.block<3, 1>(row, unknown_a(k, i)) = weight * bernstein(2, i, t) * value(p.mean, t);
        for(int i = 0; i < 4; ++i)
          system.block<3, 1>(row, unknown_b(k, i))
            = weight * bernstein(3, i, t) * value(p.tangent, t);
        jumps.segment<3>(row) = weight * value(p.jump, t);
      }
  }

  std::vector<double> m_lengths;
  std::vector<Piece> m_pieces;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CAPS_CREASE_RIBBONS_H
