// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_CONVERSION_REPORT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_CONVERSION_REPORT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/Stitching_report.h>

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

The class `Conversion_report` holds every figure of a conversion: what came in, which errors were
reached, how large the result is, and what it cost.

Lengths are in model units, times in seconds. Counts are sums over the connected components of the
mesh, deviations are the largest over them. A number that was not measured (for instance the
boundary deviation of a closed mesh) is a quiet NaN, see `is_measured()`.

\sa `convert_to_T_NURCC()`
\sa `IO::write_JSON()`
*/
struct Conversion_report
{
  typedef std::size_t size_type;

  /// the value of a number that was not measured.
  static constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

  /// returns `true` if `value` is not the mark `not_measured`.
  static constexpr bool is_measured(double value) { return value == value; }

  /// describes the mesh and its boundary.
  struct Input
  {
    size_type vertices = 0;         ///< number of vertices
    size_type triangles = 0;        ///< number of faces
    size_type components = 0;       ///< number of connected components
    size_type genus = 0;            ///< sum of the genera of the components
    size_type loops = 0;            ///< number of boundary loops
    size_type corners = 0;          ///< number of corners of the boundary
    double diameter = not_measured; ///< of the smallest sphere that encloses the vertices (D)
    /// largest distance between a facet and an arc that bends like the mesh at an edge of the facet
    double facet_sagitta = not_measured;
  };

  /// describes the distance between the boundary of the surface and the curves.
  struct Boundary
  {
    double max_deviation = not_measured;            ///< measured Hausdorff distance
    double mean_deviation = not_measured;           ///< mean distance over the boundary samples
    double certified_bound = not_measured;          ///< upper bound, with an estimated remainder
    double max_parametric_deviation = not_measured; ///< distance at equal chain parameter
    double max_normal_part = not_measured;          ///< its part at right angles to the curve
    double max_tangential_part = not_measured;      ///< its part along the curve, which is no gap
    size_type worst_curve = 0;                      ///< chain of the largest deviation
    double worst_parameter = not_measured;          ///< arc length of the largest deviation
    double max_corner_error = not_measured;         ///< distance at the corners
  };

  /// describes the distance between the surface and the mesh.
  struct Interior
  {
    double max_deviation = not_measured;         ///< in the chosen error metric
    double mean_deviation = not_measured;        ///< mean over the samples
    double fraction_within_delta = not_measured; ///< share of the samples, in `[0,1]`
    double certified_bound = not_measured;       ///< proved bound from surface to mesh, if asked for
    double target_deviation = not_measured;      ///< distance to the smooth target, if there is one
    double target_height = not_measured;         ///< bound of the target's distance from the mesh
    /// place of the largest deviation
    std::array<double, 3> worst = {{not_measured, not_measured, not_measured}};
  };

  /// describes the size of the result.
  struct Counts
  {
    size_type layout_quads = 0;         ///< quads of the layout
    size_type patches = 0;              ///< faces of the T-mesh without the 0-channels
    size_type control_points = 0;       ///< control points of the surface
    size_type extraordinary_points = 0; ///< interior vertices of valence other than four
    size_type t_junctions = 0;          ///< T-junctions of the T-mesh
    size_type nurbs_faces = 0;          ///< faces of the boundary representation that was measured;
                                        ///< `extract_NURBS_faces()` may merge more of them
    size_type bezier_elements = 0;      ///< polynomial pieces of the surface
  };

  /// describes how smooth the surface is.
  struct Smoothness
  {
    /// largest angle between the normals on both sides of an inner edge, but for lines above corners
    double max_normal_angle_degrees = not_measured;
    /// largest angle between the normals on both sides of a line above a corner; zero without any
    double max_crease_angle_degrees = not_measured;
    /// largest angle between the normals of the surface and those it was to have along the boundary
    double max_tangency_angle_degrees = not_measured;
    /// number of ends of curves where the two curves at the corner exclude the wanted normal
    size_type tangency_conflicts = 0;
  };

  /// describes the integer grid map and the quads of its layout, see `measure_layout_quality()`.
  struct Map
  {
    size_type flipped_triangles = 0; ///< always zero in a valid map
    std::string fallback = "none";   ///< the rung of the ladder of fallbacks that was needed

    size_type extraordinary_points = 0;                 ///< inner vertices with three, five, ... quads
    double min_scaled_jacobian = not_measured;          ///< smallest sine of a corner of a flat quad
    double mean_angle_deviation_degrees = not_measured; ///< of corners from a right angle
    double max_angle_deviation_degrees = not_measured;  ///< of corners from a right angle
    double min_size_ratio = not_measured;               ///< length of a side / wanted size
    double mean_size_ratio = not_measured;              ///< length of a side / wanted size
    double max_size_ratio = not_measured;               ///< length of a side / wanted size
    double relative_number_of_quads = not_measured;     ///< quads / (area / square of wanted size)
    double mean_singular_value_ratio = not_measured;    ///< larger / smaller one, weighted by area
    double max_singular_value_ratio = not_measured;     ///< larger / smaller one
    double mean_area_ratio = not_measured;              ///< area / square of wanted size, or inverse
    double max_area_ratio = not_measured;               ///< area / square of wanted size, or inverse
    double mean_kink_degrees = not_measured;            ///< turn of a line across a side of a quad
    double max_kink_degrees = not_measured;             ///< turn of a line across a side of a quad
  };

  /// describes one iteration of a fit.
  struct Iteration
  {
    std::string stage;                       ///< name of the stage, for instance `fit_boundary`
    size_type iteration = 0;                 ///< number of the iteration within the stage, from 0
    size_type patches = 0;                   ///< patches at that time
    size_type control_points = 0;            ///< control points at that time
    double boundary_linf = not_measured;     ///< largest parametric deviation from the curves
    double boundary_hausdorff = not_measured;///< largest distance from the curves
    double interior_linf = not_measured;     ///< largest deviation from the mesh
    double seconds = 0;                      ///< duration of the iteration
    size_type component = 0;                 ///< number of the connected component, from 0; set
                                             ///< when the whole conversion has ended
  };

  /// describes the time spent in a stage.
  struct Stage
  {
    std::string name;   ///< name of the stage
    double seconds = 0; ///< duration, summed up over the components
  };

  /// what the conversion returned
  Error_code status = Error_code::OK;

  /// what happened, where, and what to do about it; empty if everything went well.
  std::string message;

  /// inputs that are accepted, but probably not meant that way
  std::vector<std::string> warnings;

  Input input;                           ///< the mesh
  double boundary_tolerance = not_measured; ///< the tolerance \f$ \xi \f$ that was asked for
  double interior_tolerance = not_measured; ///< the tolerance \f$ \delta \f$ that was asked for
  double quad_size = not_measured;       ///< the edge length of the quads that was asked for
  Boundary boundary;                     ///< the error along the boundary
  Interior interior;                     ///< the error in the interior
  Counts counts;                         ///< the size of the result
  Smoothness smoothness;                 ///< the normals
  Map map;                               ///< the map
  Stitching_report stitching;            ///< the stitched B-Rep, if the caller made one
  std::vector<Iteration> iterations;     ///< the course of the fits
  std::vector<Stage> stages;             ///< the times of the stages, in the order they began
  size_type peak_memory_bytes = 0;       ///< largest resident memory of the process, if known

  /// adds `seconds` to the time of the stage `name`.
  void add_time(const std::string& name, double seconds)
  {
    for(Stage& stage : stages)
      if(stage.name == name)
      {
        stage.seconds += seconds;
        return;
      }
    stages.push_back(Stage{name, seconds});
  }
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_CONVERSION_REPORT_H
