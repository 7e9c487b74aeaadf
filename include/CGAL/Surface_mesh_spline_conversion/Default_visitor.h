// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_DEFAULT_VISITOR_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_DEFAULT_VISITOR_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>

#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

The class `Default_visitor` does nothing, and never interrupts. It is a convenient base class for
visitors that are interested in some of the events only.

\cgalModels{SplineConversionVisitor}
*/
struct Default_visitor
{
  /// is called when the stage `name` begins.
  void on_stage_begin(const std::string& /* name */) {}

  /// is called when the stage `name` has ended.
  void on_stage_end(const std::string& /* name */, double /* seconds */) {}

  /// is called after each iteration of a fit.
  void on_iteration(const Conversion_report::Iteration& /* record */) {}

  /// returns `true`: the conversion goes on.
  bool go_further() { return true; }
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_DEFAULT_VISITOR_H
