// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_ERROR_CODE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_ERROR_CODE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is what the functions of this package return. Every value but `OK` comes with a sentence in the
`Conversion_report` that names the element concerned and says what to do.
*/
enum class Error_code
{
  OK,                           ///< the result meets all tolerances
  EMPTY_MESH,                   ///< the mesh has no face
  NON_TRIANGULAR_MESH,          ///< a face is not a triangle
  NON_MANIFOLD_MESH,            ///< a vertex or an edge is not manifold
  DEGENERATE_MESH,              ///< a coordinate is not finite, or a face has no area
  INVALID_BOUNDARY_ASSOCIATION, ///< boundary edges and curves do not belong together
  INVALID_PARAMETER,            ///< a tolerance or size is not a positive number
  NO_SEAMLESS_MAP,              ///< no locally injective seamless map was found
  NO_QUAD_LAYOUT,               ///< no valid quad layout was found
  SINGULAR_SYSTEM,              ///< a linear system could not be solved
  TOLERANCE_NOT_REACHED,        ///< the surface is valid, but a tolerance is not met
  INTERRUPTED                   ///< the visitor asked to stop
};

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

returns a short description of `code`.
*/
inline const char* error_message(Error_code code)
{
  switch(code)
  {
    case Error_code::OK: return "ok";
    case Error_code::EMPTY_MESH: return "the mesh has no face";
    case Error_code::NON_TRIANGULAR_MESH: return "the mesh has a face that is not a triangle";
    case Error_code::NON_MANIFOLD_MESH: return "the mesh is not manifold";
    case Error_code::DEGENERATE_MESH: return "the mesh has a degenerate element";
    case Error_code::INVALID_BOUNDARY_ASSOCIATION:
      return "the boundary edges and the curves do not belong together";
    case Error_code::INVALID_PARAMETER: return "a parameter is out of its range";
    case Error_code::NO_SEAMLESS_MAP: return "no locally injective seamless map was found";
    case Error_code::NO_QUAD_LAYOUT: return "no valid quad layout was found";
    case Error_code::SINGULAR_SYSTEM: return "a linear system could not be solved";
    case Error_code::TOLERANCE_NOT_REACHED: return "a tolerance was not reached";
    case Error_code::INTERRUPTED: return "the conversion was interrupted";
  }
  return "";
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_ERROR_CODE_H
