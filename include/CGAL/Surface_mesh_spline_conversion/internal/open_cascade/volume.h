// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_VOLUME_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_VOLUME_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <TopoDS_Shape.hxx>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// returns the signed volume inside a closed shape. Open CASCADE subdivides the faces until it
/// estimates the error of each below the given fraction of it; with its fixed number of Gauss
/// points, a planar face in a boundary of many spans may be wrong by 10^-3.
inline double volume(const TopoDS_Shape& shape)
{
  constexpr double RELATIVE_ERROR = 1e-8;
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties, RELATIVE_ERROR);
  return properties.Mass();
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_VOLUME_H
