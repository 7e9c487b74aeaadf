// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_BOUNDARY_BAND_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_BOUNDARY_BAND_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Width of the band along the boundary of a mesh, in mean edge lengths: only there a surface may
// leave the mesh, which has chords, for the curves of the boundary.
constexpr double boundary_band = 3;

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_BOUNDARY_BAND_H
