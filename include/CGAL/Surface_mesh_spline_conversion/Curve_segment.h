// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_CURVE_SEGMENT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_CURVE_SEGMENT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>



namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionCurveTraits

is the piece of a curve that belongs to a boundary edge of the mesh. It runs in the direction of the
boundary halfedge whose face lies in the mesh; `second` may be smaller than `first`.

A segment with `first == second`, as the default constructor makes it, stands for "no curve".

\tparam BoundaryCurveTraits a model of `BoundaryCurveTraits_3`
*/
template <typename BoundaryCurveTraits>
struct Curve_segment
{
  typedef typename BoundaryCurveTraits::Curve_3 Curve_3;
  typedef typename BoundaryCurveTraits::FT FT;

  Curve_3 curve = Curve_3(); ///< the curve
  FT first = FT(0);          ///< the parameter at the source of the halfedge
  FT second = FT(0);         ///< the parameter at the target of the halfedge

  /// returns `true` if no curve is assigned.
  bool is_empty() const { return first == second; }
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_CURVE_SEGMENT_H
