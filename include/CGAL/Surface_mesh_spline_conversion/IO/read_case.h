// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_READ_CASE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_READ_CASE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_case.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/Case_reader.h>

#include <exception>
#include <string>

namespace CGAL {
namespace IO {

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

reads a case: a folder with the file `case.json`, and next to it the mesh and optionally the B-Rep
that it bounds.

\tparam K a model of `Kernel` with a floating-point number type

\param path a folder, or the file `case.json` itself
\param result the case; its former contents are lost
\param message if reading fails, a sentence that names the file and the line or element

\return `true` if the files were read and are consistent. Whether the curves fit to the mesh is
        checked by `Boundary_curve_network_3`.
*/
template <typename K>
bool read_case(const std::string& path,
               Surface_mesh_spline_conversion::Conversion_case<K>& result,
               std::string& message)
{
  result = Surface_mesh_spline_conversion::Conversion_case<K>();
  message.clear();
  try
  {
    Surface_mesh_spline_conversion::internal::Case_reader<K>(path).read(result);
    return true;
  }
  catch(const std::exception& e) // also of allocations whose sizes come from a damaged file
  {
    message = e.what();
  }
  return false;
}

} // namespace IO
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_READ_CASE_H
