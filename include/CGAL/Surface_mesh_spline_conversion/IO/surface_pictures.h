// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_SURFACE_PICTURES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_SURFACE_PICTURES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/PNG.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/Signed_mesh_distance.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/surface_scene.h>

#include <CGAL/Named_function_parameters.h>

#include <string>

namespace CGAL {
namespace IO {

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

draws the result of a conversion into the existing folder `folder`:

- `layout.png`: the sides of the layout quads and the extraordinary points (red: valence 3,
  blue: valence 5, violet: others)
- `patches.png`: the sides of the patches
- `deviation.png`: the signed distance of the surface from the mesh, black where it exceeds the
  interior tolerance. Along the boundary it includes the distance between curves and mesh edges.
- `zebra.png`: the mirror image of parallel stripes of light

\tparam SurfaceRange a range of `T_NURCC_surface_3`
\tparam TriangleMesh a model of `FaceListGraph`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param folder an existing folder
\param surfaces the surfaces
\param tm the mesh they were made from
\param report the report of the conversion
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
       below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `tm`}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                   `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and
                   `%Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\returns `true` if all files were written
*/
template <typename SurfaceRange, typename TriangleMesh,
          typename NamedParameters = parameters::Default_named_parameters>
bool write_pictures(const std::string& folder,
                    const SurfaceRange& surfaces,
                    const TriangleMesh& tm,
                    const Surface_mesh_spline_conversion::Conversion_report& report,
                    const NamedParameters& np = parameters::default_values())
{
  namespace SC = Surface_mesh_spline_conversion;
  using SC::Picture_scene;

  Picture_scene scene = SC::internal::surface_scene(surfaces, SC::internal::Patch_lines::LAYOUT);
  SC::internal::add_extraordinary_points(surfaces, scene);
  scene.title = std::to_string(report.counts.layout_quads) + " quads, "
              + std::to_string(report.counts.extraordinary_points) + " extraordinary points";
  bool is_written = write_PNG(folder + "/layout.png", scene);

  scene = SC::internal::surface_scene(surfaces, SC::internal::Patch_lines::PATCHES);
  scene.title = std::to_string(report.counts.patches) + " patches, "
              + std::to_string(report.counts.control_points) + " control points";
  is_written = write_PNG(folder + "/patches.png", scene) && is_written;

  scene.lines.clear();
  scene.title = "zebra stripes";
  scene.shading = Picture_scene::Shading::ZEBRA;
  is_written = write_PNG(folder + "/zebra.png", scene) && is_written;

  scene.values = SC::internal::Signed_mesh_distance<TriangleMesh, NamedParameters>(tm, np)
                   .of_points(scene.points);
  scene.title = "distance from the mesh";
  scene.shading = Picture_scene::Shading::VALUES;
  scene.largest_value = report.interior_tolerance;
  return write_PNG(folder + "/deviation.png", scene) && is_written;
}

} // namespace IO
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_SURFACE_PICTURES_H
