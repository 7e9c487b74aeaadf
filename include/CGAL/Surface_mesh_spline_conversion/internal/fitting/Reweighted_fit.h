// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_REWEIGHTED_FIT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_REWEIGHTED_FIT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_system.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/interior_error.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/reproject_targets.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Lowers the largest distances of a least-squares fit. Many patches violate the tolerance by
// little, beside others that are far below it. The weights of these patches are increased with
// their errors, and the control points that act on them are fitted again: iteratively reweighted
// least squares, which tend to the fit with the smallest largest distance. What meets the tolerance
// then need not be refined. The rounds do not always improve the fit, the best one is taken. They
// do not help where so many patches violate the tolerance that they stand side by side.
template <typename Surface, typename Target>
class Reweighted_fit
{
  typedef std::size_t size_type;
  typedef Interior_samples<Surface, Target> Samples;
  typedef Interior_system<Samples> System;
  typedef Interior_error<Surface, Target> Errors;
  typedef typename Errors::Patch_error Patch_error;
  typedef typename Surface::Point_3 Point_3;

public:
  // `is_fixed`: control points that do not move
  Reweighted_fit(Surface& surface, const Target& target, Samples& samples,
                 const std::vector<bool>& is_fixed, double tolerance)
    : m_surface(surface), m_target(target), m_samples(samples), m_is_fixed(is_fixed),
      m_tolerance(tolerance)
  {}

  // `errors`: of the fit, and then of the best one that was found. `accuracy`: see Interior_system
  void operator()(Errors& errors, double accuracy)
  {
    constexpr double largest_share = 0.4; // of violating patches
    std::vector<Patch_error> violations = errors.errors(m_tolerance, largest_excess * m_tolerance);
    if(double(violations.size()) > largest_share * double(m_samples.number_of_patches()))
      return;
    std::vector<Point_3> points = control_points();
    size_type fewest = violations.size();
    for(int round = 0; round < number_of_rounds && fit(violations, accuracy); ++round)
    {
      errors.update();
      violations = errors.errors(m_tolerance, largest_excess * m_tolerance);
      if(violations.size() >= fewest)
        continue;
      fewest = violations.size();
      points = control_points();
      errors.accept();
    }
    take_back(points, errors);
  }

  // Moves the surface closer to the target on some patches of a fit that meets the tolerance, so that
  // it still does. Returns `false` if that is not possible, the fit is the same then.
  bool move_closer(const std::vector<size_type>& patches, Errors& errors, double accuracy)
  {
    constexpr double first_excess = 1.5; // instead of the errors, which meet the tolerance
    std::vector<Patch_error> violations;
    for(size_type p : patches)
      violations.push_back(Patch_error{p, first_excess * m_tolerance});
    const std::vector<Point_3> points = control_points();
    for(int round = 0; round < number_of_rounds && fit(violations, accuracy); ++round)
    {
      errors.update();
      violations = errors.errors(m_tolerance, largest_excess * m_tolerance);
      if(!violations.empty())
        continue;
      errors.accept();
      return true;
    }
    take_back(points, errors);
    return false;
  }

private:
  static constexpr int number_of_rounds = 12;

  // Patches whose error exceeds the tolerance by this factor have to be refined anyway.
  static constexpr double largest_excess = 2;

  std::vector<Point_3> control_points() const
  {
    std::vector<Point_3> result;
    for(size_type i = 0; i < m_is_fixed.size(); ++i)
      result.push_back(m_surface.control_point(i));
    return result;
  }

  void take_back(const std::vector<Point_3>& points, Errors& errors)
  {
    for(size_type i = 0; i < points.size(); ++i)
      m_surface.set_control_point(i, points[i]);
    errors.take_back();
  }

  // fits with larger weights; returns `false` if that is not possible
  bool fit(const std::vector<Patch_error>& violations, double accuracy)
  {
    const std::vector<bool> is_fixed = increase_weights(violations);
    const std::vector<size_type> patches = patches_with_free_points(is_fixed);
    return !patches.empty() && fit(is_fixed, patches, accuracy);
  }

  // returns which control points do not move
  std::vector<bool> increase_weights(const std::vector<Patch_error>& violations)
  {
    constexpr double factor = 1.5; // of the weight of a patch at the tolerance
    std::vector<bool> result(m_is_fixed.size(), true);
    for(const Patch_error& e : violations)
    {
      const double excess = e.error / m_tolerance;
      if(excess >= largest_excess)
        continue;
      m_samples.increase_weight(e.patch, factor * excess * excess);
      for(size_type i = 0; i < m_samples.number_of_functions(e.patch); ++i)
      {
        const size_type c = m_samples.function(e.patch, i);
        result[c] = m_is_fixed[c];
      }
    }
    return result;
  }

  std::vector<size_type> patches_with_free_points(const std::vector<bool>& is_fixed) const
  {
    std::vector<size_type> result;
    for(size_type p = 0; p < m_samples.number_of_patches(); ++p)
      for(size_type i = 0; i < m_samples.number_of_functions(p); ++i)
        if(!is_fixed[m_samples.function(p, i)])
        {
          result.push_back(p);
          break;
        }
    return result;
  }

  bool fit(const std::vector<bool>& is_fixed, const std::vector<size_type>& patches,
           double accuracy)
  {
    const System system(m_samples, is_fixed, patches);
    if(!system.is_valid() || !system.fit(m_surface, accuracy))
      return false;
    Target_reprojection<Surface, Target>(m_target, m_samples)(patches);
    return system.fit(m_surface, accuracy);
  }

  Surface& m_surface;
  const Target& m_target;
  Samples& m_samples;
  const std::vector<bool>& m_is_fixed;
  double m_tolerance;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_REWEIGHTED_FIT_H
