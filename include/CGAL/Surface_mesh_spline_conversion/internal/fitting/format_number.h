// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FORMAT_NUMBER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FORMAT_NUMBER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <sstream>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// returns a number for a message; std::to_string() would print small lengths as zero
inline std::string format_number(double x)
{
  std::ostringstream out;
  out << x;
  return out.str();
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FORMAT_NUMBER_H
