// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_RUN_STAGE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_RUN_STAGE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>

#include <CGAL/Real_timer.h>

#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Runs a stage, a function object that returns an error code, between the calls of the visitor, and
// adds its time to the report. The report always gets a message if the stage fails.
template <typename Visitor, typename Stage>
Error_code run_stage(const std::string& name, Visitor& visitor, Conversion_report& report,
                     const Stage& stage)
{
  if(!visitor.go_further())
  {
    report.message = "the visitor interrupted the conversion before the stage '" + name + "'";
    return Error_code::INTERRUPTED;
  }
  visitor.on_stage_begin(name);
  Real_timer timer;
  timer.start();
  const Error_code code = stage();
  report.add_time(name, timer.time());
  visitor.on_stage_end(name, timer.time());
  if(code != Error_code::OK && report.message.empty())
    report.message = "stage '" + name + "': " + error_message(code);
  return code;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_RUN_STAGE_H
