// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_CACHED_CURVE_TARGET_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_CACHED_CURVE_TARGET_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Span_samples.h>

#include <Eigen/Core>

#include <unordered_map>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A curve target that remembers its values at the parameters of the spline. These are dyadic and
// recur from one refinement level to the next (paper, section 3.2.3), hence the exact comparison of
// numbers.
template <typename CurveTarget>
class Cached_curve_target
{
public:
  explicit Cached_curve_target(const CurveTarget& target) : m_target(target) {}

  Eigen::Vector3d point(double x)
  {
    auto it = m_points.find(x);
    if(it == m_points.end())
      it = m_points.emplace(x, m_target.point(x)).first;
    return it->second;
  }

  Eigen::Vector3d derivative(double x)
  {
    auto it = m_derivatives.find(x);
    if(it == m_derivatives.end())
      it = m_derivatives.emplace(x, m_target.derivative(x)).first;
    return it->second;
  }

  Curve_foot foot(double x)
  {
    return {m_target.arc_length(x), point(x), derivative(x).normalized()};
  }

  Eigen::Vector3d curve_point(double s) const { return m_target.curve_point(s); }
  Curve_foot curve_foot(double s) const { return m_target.curve_foot(s); }

private:
  CurveTarget m_target;
  std::unordered_map<double, Eigen::Vector3d> m_points, m_derivatives;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_CACHED_CURVE_TARGET_H
