// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_SAMPLES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_SAMPLES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The samples of a surface and of its target at one refinement level (paper, section 3.3.1): a
// uniform grid of 5x5 samples on each patch for the fit, nested in a grid of 9x9 for the error.
//
// The surface is linear in its control points: per patch we keep the control points that act on
// it and, per sample, their weights.
template <typename Surface, typename Target>
class Interior_samples
{
public:
  typedef std::size_t size_type;
  typedef typename Target::FT FT;
  typedef typename Target::Point_3 Point_3;

  static constexpr size_type fit_grid = 5;
  static constexpr size_type error_grid = 2 * fit_grid - 1;
  static constexpr size_type fit_samples = fit_grid * fit_grid;
  static constexpr size_type error_samples = error_grid * error_grid;

  // a parameter of the surface
  struct Place
  {
    size_type patch, quad;
    FT u, v;
  };

  Interior_samples(const Surface& surface, const Target& target)
    : m_surface(surface), m_target(target), m_number_of_patches(surface.number_of_patches())
  {
    m_first_function.push_back(0);
    for(size_type p = 0; p < m_number_of_patches; ++p)
    {
      m_origins.push_back(surface.patch_origin(p));
      add_stencils(p);
      for(size_type k = 0; k < error_samples; ++k)
      {
        const Place place = error_place(p, k);
        m_targets.push_back(to_eigen(target.point(place.quad, place.u, place.v)));
      }
    }
    reset_fit_targets();
  }

  size_type number_of_patches() const { return m_number_of_patches; }

  // returns the number of control points that act on a patch
  size_type number_of_functions(size_type patch) const
  {
    return m_first_function[patch + 1] - m_first_function[patch];
  }

  // returns a control point that acts on a patch
  size_type function(size_type patch, size_type i) const
  {
    return m_functions[m_first_function[patch] + i];
  }

  // returns the value of function `i` of a patch at fit sample `k`
  double value(size_type patch, size_type k, size_type i) const
  {
    return m_values[m_first_function[patch] * fit_samples + k * number_of_functions(patch) + i];
  }

  // the trapezoidal rule: the target is only continuous (paper, section 3.3.1)
  double weight(size_type patch, size_type k) const
  {
    const auto end_weight = [](size_type i) { return i == 0 || i + 1 == fit_grid ? 0.5 : 1; };
    const auto& o = m_origins[patch];
    const double area = CGAL::to_double((o.u1 - o.u0) * (o.v1 - o.v0));
    return area * end_weight(k % fit_grid) * end_weight(k / fit_grid)
           / ((fit_grid - 1) * (fit_grid - 1));
  }

  Place error_place(size_type patch, size_type k) const
  {
    return place(patch, k % error_grid, k / error_grid);
  }

  Place fit_place(size_type patch, size_type k) const
  {
    return place(patch, 2 * (k % fit_grid), 2 * (k / fit_grid));
  }

  // returns the point of the target at an error sample
  const Eigen::Vector3d& target(size_type patch, size_type k) const
  {
    return m_targets[patch * error_samples + k];
  }

  // returns the point of the target that the surface shall have at a fit sample
  const Eigen::Vector3d& fit_target(size_type patch, size_type k) const
  {
    return m_fit_targets[patch * fit_samples + k];
  }

  void set_fit_target(size_type patch, size_type k, const Eigen::Vector3d& p)
  {
    m_fit_targets[patch * fit_samples + k] = p;
  }

  // returns the error sample at the place of fit sample `k`
  static size_type error_sample(size_type k)
  {
    return 2 * (k / fit_grid) * error_grid + 2 * (k % fit_grid);
  }

  // takes the points with equal parameters as targets
  void reset_fit_targets()
  {
    m_fit_targets.clear();
    for(size_type p = 0; p < m_number_of_patches; ++p)
      for(size_type k = 0; k < fit_samples; ++k)
        m_fit_targets.push_back(target(p, error_sample(k)));
  }

private:
  Place place(size_type patch, size_type i, size_type j) const
  {
    const auto& o = m_origins[patch];
    const FT s = FT(double(i) / (error_grid - 1)), t = FT(double(j) / (error_grid - 1));
    return Place{patch, o.quad, o.u0 + s * (o.u1 - o.u0), o.v0 + t * (o.v1 - o.v0)};
  }

  void add_stencils(size_type patch)
  {
    for(size_type k = 0; k < fit_samples; ++k)
    {
      const Place at = fit_place(patch, k);
      m_stencils[k].clear();
      m_surface.basis(patch, at.u, at.v, 0, m_stencils[k]);
    }
    const size_type first = m_functions.size();
    for(const auto& stencil : m_stencils)
      for(const auto& b : stencil)
        m_functions.push_back(b.control_point);
    const auto begin = m_functions.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, m_functions.end());
    m_functions.erase(std::unique(begin, m_functions.end()), m_functions.end());
    m_first_function.push_back(m_functions.size());

    const size_type n = m_functions.size() - first;
    const size_type first_value = m_values.size();
    m_values.resize(first_value + n * fit_samples, 0);
    for(size_type k = 0; k < fit_samples; ++k)
      for(const auto& b : m_stencils[k])
      {
        const auto it = std::lower_bound(m_functions.begin() + static_cast<std::ptrdiff_t>(first),
                                         m_functions.end(), b.control_point);
        const size_type i = static_cast<size_type>(it - m_functions.begin()) - first;
        m_values[first_value + k * n + i] += b.value[0];
      }
  }

  typedef typename std::decay<decltype(std::declval<Surface>().patch_origin(0))>::type Origin;

  const Surface& m_surface;
  const Target& m_target;
  size_type m_number_of_patches;
  std::vector<Origin> m_origins;
  std::vector<size_type> m_first_function, m_functions;
  std::vector<double> m_values;
  std::vector<Eigen::Vector3d> m_targets, m_fit_targets;
  std::array<std::vector<typename Surface::Basis_function>, fit_samples> m_stencils;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_SAMPLES_H
