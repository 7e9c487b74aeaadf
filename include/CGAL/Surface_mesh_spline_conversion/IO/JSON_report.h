// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_JSON_REPORT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_JSON_REPORT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/JSON_writer.h>

#include <fstream>
#include <ostream>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

inline void write_JSON_input(JSON_writer& json, const Conversion_report& report)
{
  json.open("input", '{');
  json.member("vertices", report.input.vertices);
  json.member("triangles", report.input.triangles);
  json.member("components", report.input.components);
  json.member("genus", report.input.genus);
  json.member("loops", report.input.loops);
  json.member("corners", report.input.corners);
  json.member("diameter", report.input.diameter);
  json.member("facet_sagitta", report.input.facet_sagitta);
  json.close('}');
  json.member("xi", report.boundary_tolerance);
  json.member("delta", report.interior_tolerance);
  json.member("quad_size", report.quad_size);
}

inline void write_JSON_deviations(JSON_writer& json, const Conversion_report& report)
{
  json.open("boundary", '{');
  json.member("max_deviation", report.boundary.max_deviation);
  json.member("mean_deviation", report.boundary.mean_deviation);
  json.member("certified_bound", report.boundary.certified_bound);
  json.member("max_parametric_deviation", report.boundary.max_parametric_deviation);
  json.member("max_normal_part", report.boundary.max_normal_part);
  json.member("max_tangential_part", report.boundary.max_tangential_part);
  json.open("worst", '{');
  json.member("curve", report.boundary.worst_curve);
  json.member("t", report.boundary.worst_parameter);
  json.close('}');
  json.member("max_corner_error", report.boundary.max_corner_error);
  json.close('}');
  json.open("interior", '{');
  json.member("max_deviation", report.interior.max_deviation);
  json.member("mean_deviation", report.interior.mean_deviation);
  json.member("fraction_within_delta", report.interior.fraction_within_delta);
  json.member("certified_bound", report.interior.certified_bound);
  json.member("target_deviation", report.interior.target_deviation);
  json.member("target_height", report.interior.target_height);
  json.member("worst", report.interior.worst);
  json.close('}');
}

inline void write_JSON_counts(JSON_writer& json, const Conversion_report& report)
{
  json.open("counts", '{');
  json.member("layout_quads", report.counts.layout_quads);
  json.member("patches", report.counts.patches);
  json.member("control_points", report.counts.control_points);
  json.member("extraordinary_points", report.counts.extraordinary_points);
  json.member("t_junctions", report.counts.t_junctions);
  json.member("nurbs_faces", report.counts.nurbs_faces);
  json.member("bezier_elements", report.counts.bezier_elements);
  json.close('}');
  json.open("smoothness", '{');
  json.member("max_normal_angle_degrees", report.smoothness.max_normal_angle_degrees);
  json.member("max_crease_angle_degrees", report.smoothness.max_crease_angle_degrees);
  json.member("max_tangency_angle_degrees", report.smoothness.max_tangency_angle_degrees);
  json.member("tangency_conflicts", report.smoothness.tangency_conflicts);
  json.close('}');
}

inline void write_JSON_map(JSON_writer& json, const Conversion_report::Map& map)
{
  json.open("map", '{');
  json.member("flipped_triangles", map.flipped_triangles);
  json.member("fallback", map.fallback);
  json.member("extraordinary_points", map.extraordinary_points);
  json.member("min_scaled_jacobian", map.min_scaled_jacobian);
  json.member("mean_angle_deviation_degrees", map.mean_angle_deviation_degrees);
  json.member("max_angle_deviation_degrees", map.max_angle_deviation_degrees);
  json.member("min_size_ratio", map.min_size_ratio);
  json.member("mean_size_ratio", map.mean_size_ratio);
  json.member("max_size_ratio", map.max_size_ratio);
  json.member("relative_number_of_quads", map.relative_number_of_quads);
  json.member("mean_singular_value_ratio", map.mean_singular_value_ratio);
  json.member("max_singular_value_ratio", map.max_singular_value_ratio);
  json.member("mean_area_ratio", map.mean_area_ratio);
  json.member("max_area_ratio", map.max_area_ratio);
  json.member("mean_kink_degrees", map.mean_kink_degrees);
  json.member("max_kink_degrees", map.max_kink_degrees);
  json.close('}');
}

inline void write_JSON_stitching(JSON_writer& json, const Stitching_report& stitching)
{
  if(stitching.method == Stitching_report().method)
    return;
  json.open("stitching", '{');
  json.member("method", stitching.method);
  json.member("solids", stitching.solids);
  json.member("shells", stitching.shells);
  json.member("faces", stitching.faces);
  json.member("edges", stitching.edges);
  json.member("vertices", stitching.vertices);
  json.member("free_edges", stitching.free_edges);
  json.member("unmatched_edges", stitching.unmatched_edges);
  json.member("multiple_edges", stitching.multiple_edges);
  json.member("is_valid", std::size_t(stitching.is_valid));
  json.member("edge_distance_mm", stitching.edge_distance);
  json.member("edge_deviation_mm", stitching.edge_deviation);
  json.member("edge_tolerance_mm", stitching.edge_tolerance);
  json.member("vertex_tolerance_mm", stitching.vertex_tolerance);
  json.member("residual_tolerance_mm", stitching.residual_tolerance);
  json.member("volume_mm3", stitching.volume);
  json.close('}');
}

inline void write_JSON_course(JSON_writer& json, const Conversion_report& report)
{
  json.open("iterations", '[');
  for(const Conversion_report::Iteration& record : report.iterations)
  {
    json.open("", '{');
    json.member("stage", record.stage);
    json.member("iteration", record.iteration);
    json.member("patches", record.patches);
    json.member("control_points", record.control_points);
    json.member("boundary_linf", record.boundary_linf);
    json.member("boundary_hausdorff", record.boundary_hausdorff);
    json.member("interior_linf", record.interior_linf);
    json.member("seconds", record.seconds);
    json.member("component", record.component);
    json.close('}');
  }
  json.close(']');
  json.open("stages", '[');
  for(const Conversion_report::Stage& stage : report.stages)
  {
    json.open("", '{');
    json.member("name", stage.name);
    json.member("seconds", stage.seconds);
    json.close('}');
  }
  json.close(']');
  json.member("peak_memory_bytes", report.peak_memory_bytes);
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion

namespace IO {

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes `report` as a JSON object (UTF-8) to `out`. Lengths are in model units, times in seconds;
numbers that were not measured are written as `null`. The members are

- `status`: `"ok"`, or a short description of the failure; `message`: the whole story;
  `warnings`: an array of strings
- `input`, `xi`, `delta`, `quad_size`, `boundary`, `interior`, `counts`, `smoothness`, `map`,
  `iterations`, `stages`, `peak_memory_bytes`: the members of
  `Surface_mesh_spline_conversion::Conversion_report`; `xi` and `delta` are the two tolerances
- `stitching`, if the surface was stitched with a B-Rep: `Stitching_report`, in millimetres

\returns `true` if the stream is good after writing
*/
inline bool write_JSON(std::ostream& out,
                       const Surface_mesh_spline_conversion::Conversion_report& report)
{
  namespace SC = Surface_mesh_spline_conversion;
  SC::internal::JSON_writer json(out);
  json.open("", '{');
  json.member("status", SC::error_message(report.status));
  json.member("message", report.message);
  json.member("warnings", report.warnings);
  SC::internal::write_JSON_input(json, report);
  SC::internal::write_JSON_deviations(json, report);
  SC::internal::write_JSON_counts(json, report);
  SC::internal::write_JSON_map(json, report.map);
  SC::internal::write_JSON_stitching(json, report.stitching);
  SC::internal::write_JSON_course(json, report);
  json.close('}');
  return out.good();
}

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes `report` as a JSON object to the file `filename`.

\returns `true` if the file was written
*/
inline bool write_JSON(const std::string& filename,
                       const Surface_mesh_spline_conversion::Conversion_report& report)
{
  std::ofstream out(filename);
  return write_JSON(out, report) && out.flush().good();
}

} // namespace IO
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_JSON_REPORT_H
