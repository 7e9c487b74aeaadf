// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_SMOOTH_CORRESPONDENCE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_SMOOTH_CORRESPONDENCE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Boundary_correspondence.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Chooses the correspondence s(x) of a boundary chain.
//
// The arc length normalized per quad side, as in section 2.2 of the paper, has a jump of speed at
// every quad vertex, which a C2 spline can only follow by refinement. We take a C2 cubic spline
// that minimizes
//     sum (s(k) - s_k)^2 + alpha int (s''')^2,
// s_k the arc length at quad vertex k: the quad vertices slide along the curve. The largest
// alpha is taken for which s is monotone and no vertex slides too far.
class Correspondence_smoother
{
public:
  typedef std::size_t size_type;

  // `arc_lengths[k]` belongs to the vertex k of the chain, 0 <= k <= number of sides; vertices
  // with `is_fixed[k]` do not slide. The ends of an open chain never slide.
  Correspondence_smoother(std::vector<double> arc_lengths, std::vector<bool> is_fixed,
                          bool is_closed)
    : m_arc_lengths(std::move(arc_lengths)), m_is_fixed(std::move(is_fixed)),
      m_is_closed(is_closed), m_number_of_sides(m_arc_lengths.size() - 1),
      m_step((m_arc_lengths.back() - m_arc_lengths.front()) / double(m_number_of_sides))
  {
    m_is_fixed.front() = m_is_fixed.front() || !is_closed;
    m_is_fixed.back() = !is_closed; // the last vertex of a closed chain is the first one
  }

  Boundary_correspondence operator()() const
  {
    // attenuation of an alternating displacement by 1 + 64 alpha, of one with a wave length of
    // ten sides by 1 + 0.06 alpha
    const std::array<double, 7> alphas = {{1000, 100, 10, 1, 0.1, 0.01, 0.001}};
    std::optional<Boundary_correspondence> second_best;
    for(double alpha : alphas)
    {
      const std::optional<Boundary_correspondence> s = minimize(alpha);
      if(!s)
        continue;
      if(is_admissible(*s, preferred_compression))
        return *s;
      if(!second_best && is_admissible(*s, largest_compression))
        second_best = s;
    }
    return second_best ? *second_best : monotone_interpolation();
  }

private:
  // The warp of the map along the boundary (see Transfinite_patch_network_3) shortens a quad at
  // most to these shares of its length, and moves a point by at most a third of a quad side.
  static constexpr double preferred_compression = 0.5;
  static constexpr double largest_compression = 0.25;
  static constexpr double largest_slide = 1. / 3;

  // Weight of int (s'')^2 relative to the other terms: decides only where they leave a degree
  // of freedom, on chains of one or two sides.
  static constexpr double tie_breaker = 1e-9;

  double side_length(size_type k) const { return m_arc_lengths[k + 1] - m_arc_lengths[k]; }

  bool is_admissible(const Boundary_correspondence& s, double compression) const
  {
    constexpr int samples_per_side = 8;
    for(size_type k = 0; k < m_number_of_sides; ++k)
    {
      if(s.smallest_slope(k) < largest_compression * side_length(k))
        return false;
      for(int i = 0; i < samples_per_side; ++i)
      {
        const double x = double(k) + double(i) / samples_per_side;
        if(!is_small_slide(x, s(x), s(x, 1), compression))
          return false;
      }
    }
    return true;
  }

  // compares with the correspondence that is linear on each quad side
  bool is_small_slide(double x, double s, double slope, double compression) const
  {
    const double period = m_arc_lengths.back() - m_arc_lengths.front();
    double turn = 0;
    if(m_is_closed)
      turn = std::floor((s - m_arc_lengths.front()) / period);
    s -= turn * period;
    auto it = std::upper_bound(m_arc_lengths.begin() + 1, m_arc_lengths.end() - 1, s);
    const size_type k = static_cast<size_type>(it - m_arc_lengths.begin()) - 1;
    const double position = double(k) + turn * double(m_number_of_sides)
                            + (s - m_arc_lengths[k]) / side_length(k);
    return std::abs(position - x) <= largest_slide && slope >= compression * side_length(k);
  }

  // Position of the coefficient `j - 1` of the deviation o(x) = s(x) - (linear function), a
  // uniform cubic spline: o(k) = (c_{k-1} + 4 c_k + c_{k+1}) / 6.
  int coefficient(size_type j) const
  {
    const size_type n = m_number_of_sides;
    return static_cast<int>(m_is_closed ? (j + n - 1) % n : j);
  }

  int number_of_coefficients() const
  {
    return static_cast<int>(m_is_closed ? m_number_of_sides : m_number_of_sides + 3);
  }

  typedef std::vector<std::pair<int, double> > Linear_form;
  typedef std::vector<Eigen::Triplet<double> > Entries;

  Linear_form value_form(size_type k) const
  {
    return {{coefficient(k), 1. / 6}, {coefficient(k + 1), 4. / 6}, {coefficient(k + 2), 1. / 6}};
  }

  static void add_square(const Linear_form& form, double weight, Entries& entries)
  {
    for(const auto& a : form)
      for(const auto& b : form)
        entries.emplace_back(a.first, b.first, weight * a.second * b.second);
  }

  double linear_part(size_type k) const { return m_arc_lengths.front() + m_step * double(k); }

  size_type number_of_vertices() const
  {
    return m_is_closed ? m_number_of_sides : m_number_of_sides + 1;
  }

  // the matrix of the first order conditions with one multiplier per fixed vertex
  Entries first_order_conditions(double alpha, Eigen::VectorXd& right_hand_side) const
  {
    Entries entries;
    int multiplier = number_of_coefficients();
    for(size_type k = 0; k < number_of_vertices(); ++k)
    {
      const Linear_form form = value_form(k);
      const double deviation = m_arc_lengths[k] - linear_part(k);
      if(m_is_fixed[k])
      {
        for(const auto& a : form)
        {
          entries.emplace_back(a.first, multiplier, a.second);
          entries.emplace_back(multiplier, a.first, a.second);
        }
        right_hand_side[multiplier++] = deviation;
        continue;
      }
      add_square(form, 1, entries);
      for(const auto& a : form)
        right_hand_side[a.first] += a.second * deviation;
    }
    for(size_type k = 0; k < m_number_of_sides; ++k)
    {
      add_square({{coefficient(k), -1}, {coefficient(k + 1), 3}, {coefficient(k + 2), -3},
                  {coefficient(k + 3), 1}}, alpha, entries);
      for(size_type j = k; j < k + 2; ++j)
        add_square({{coefficient(j), 1}, {coefficient(j + 1), -2}, {coefficient(j + 2), 1}},
                   tie_breaker, entries);
    }
    return entries;
  }

  std::optional<Boundary_correspondence> minimize(double alpha) const
  {
    const size_type fixed = static_cast<size_type>(
      std::count(m_is_fixed.begin(),
                 m_is_fixed.begin() + static_cast<std::ptrdiff_t>(number_of_vertices()), true));
    const int size = number_of_coefficients() + static_cast<int>(fixed);
    Eigen::VectorXd right_hand_side = Eigen::VectorXd::Zero(size);
    const Entries entries = first_order_conditions(alpha, right_hand_side);
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double> > solver;
    solver.compute(matrix);
    if(solver.info() != Eigen::Success)
      return std::nullopt;
    const Eigen::VectorXd c = solver.solve(right_hand_side);
    if(!c.allFinite())
      return std::nullopt;
    return correspondence(c);
  }

  Boundary_correspondence correspondence(const Eigen::VectorXd& c) const
  {
    std::vector<double> values, slopes;
    for(size_type k = 0; k <= m_number_of_sides; ++k)
    {
      double deviation = 0;
      for(const auto& a : value_form(k))
        deviation += a.second * c[a.first];
      const bool is_exact = m_is_fixed[k] || (m_is_closed && k == m_number_of_sides
                                              && m_is_fixed.front());
      values.push_back(is_exact ? m_arc_lengths[k] : linear_part(k) + deviation);
      slopes.push_back(m_step + (c[coefficient(k + 2)] - c[coefficient(k)]) / 2);
    }
    return Boundary_correspondence(std::move(values), std::move(slopes), m_is_closed);
  }

  // C1 interpolation with the harmonic means of the neighbouring speeds as slopes (Fritsch,
  // Butland): always monotone
  Boundary_correspondence monotone_interpolation() const
  {
    const size_type n = m_number_of_sides;
    std::vector<double> slopes;
    for(size_type k = 0; k <= n; ++k)
    {
      const bool has_before = k > 0 || m_is_closed, has_after = k < n || m_is_closed;
      const double before = has_before ? side_length((k + n - 1) % n) : side_length(0);
      const double after = has_after ? side_length(k % n) : side_length(n - 1);
      slopes.push_back(2 * before * after / (before + after));
    }
    return Boundary_correspondence(m_arc_lengths, std::move(slopes), m_is_closed);
  }

  std::vector<double> m_arc_lengths;
  std::vector<bool> m_is_fixed;
  bool m_is_closed;
  size_type m_number_of_sides;
  double m_step;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_SMOOTH_CORRESPONDENCE_H
