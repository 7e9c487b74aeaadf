// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_PNG_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_PNG_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/IO/Picture_scene.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/Scene_painter.h>

#include <string>
#include <vector>

namespace CGAL {
namespace IO {

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

draws `scene` as seen from `views`, side by side, into the PNG file `filename`. For scenes that are
coloured by values a legend is added.

\pre `scene.normals` has the size of `scene.points`; so has `scene.values` if it is used
\returns `true` if the file was written
*/
inline bool write_PNG(const std::string& filename,
                      const Surface_mesh_spline_conversion::Picture_scene& scene,
                      const std::vector<Surface_mesh_spline_conversion::Picture_view>& views)
{
  return Surface_mesh_spline_conversion::internal::draw_scene(scene, views).write_PNG(filename);
}

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

draws `scene` from two opposite directions, side by side, into the PNG file `filename`.

\returns `true` if the file was written
*/
inline bool write_PNG(const std::string& filename,
                      const Surface_mesh_spline_conversion::Picture_scene& scene)
{
  Surface_mesh_spline_conversion::Picture_view front, back;
  back.azimuth += 180;
  back.elevation = -back.elevation;
  return write_PNG(filename, scene, {front, back});
}

} // namespace IO
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_PNG_H
