// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_CURVE_TRAITS_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_CURVE_TRAITS_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Curve_member_traits.h>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionCurveTraits

The class `NURBS_curve_traits_3` makes boundary curves of (rational) B-spline curves, among them
line segments and circular arcs; see `NURBS_curve_3` for their creation. Evaluation does not
allocate memory for degrees below 10.

\tparam K a model of `Kernel` with a floating-point number type

\cgalModels{BoundaryCurveTraits_3}
*/
template <typename K>
class NURBS_curve_traits_3
#ifndef DOXYGEN_RUNNING
  : public internal::Curve_member_traits<K, NURBS_curve_3<K> >
#endif
{
public:
  /// The type of the curves.
  typedef NURBS_curve_3<K> Curve_3;
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_CURVE_TRAITS_3_H
