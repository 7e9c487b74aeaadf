// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_SEAM_PARAMETERS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_SEAM_PARAMETERS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

template <typename Traits>
auto find_seam_parameters(const Traits& traits, const typename Traits::Curve_3& curve, int)
  -> decltype(traits.construct_seam_parameters_on_curve_3_object()(curve))
{
  return traits.construct_seam_parameters_on_curve_3_object()(curve);
}

template <typename Traits>
std::vector<typename Traits::FT>
find_seam_parameters(const Traits&, const typename Traits::Curve_3&, long)
{
  return std::vector<typename Traits::FT>();
}

// returns the parameters at which a curve crosses the seam of its surface; none, if the traits know
// no surfaces
template <typename Traits>
std::vector<typename Traits::FT>
seam_parameters(const Traits& traits, const typename Traits::Curve_3& curve)
{
  return find_seam_parameters(traits, curve, 0);
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_SEAM_PARAMETERS_H
