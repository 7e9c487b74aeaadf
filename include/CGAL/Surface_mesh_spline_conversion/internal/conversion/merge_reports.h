// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_MERGE_REPORTS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_MERGE_REPORTS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// the larger of two figures of which either may not have been measured
inline double larger(double a, double b)
{
  if(!Conversion_report::is_measured(a))
    return b;
  return (Conversion_report::is_measured(b) && b > a) ? b : a;
}

// the mean of two figures, weighted with the numbers of patches they were taken from
inline double weighted_mean(double a, double weight_of_a, double b, double weight_of_b)
{
  if(!Conversion_report::is_measured(a) || weight_of_a == 0)
    return b;
  if(!Conversion_report::is_measured(b))
    return a;
  return (weight_of_a * a + weight_of_b * b) / (weight_of_a + weight_of_b);
}

inline void merge_boundary(const Conversion_report::Boundary& part,
                           Conversion_report::Boundary& whole, double part_weight,
                           double whole_weight)
{
  const double previous = whole.max_deviation;
  whole.max_deviation = larger(whole.max_deviation, part.max_deviation);
  if(whole.max_deviation != previous)
  {
    whole.worst_curve = part.worst_curve;
    whole.worst_parameter = part.worst_parameter;
  }
  whole.mean_deviation
    = weighted_mean(whole.mean_deviation, whole_weight, part.mean_deviation, part_weight);
  whole.certified_bound = larger(whole.certified_bound, part.certified_bound);
  whole.max_parametric_deviation
    = larger(whole.max_parametric_deviation, part.max_parametric_deviation);
  whole.max_normal_part = larger(whole.max_normal_part, part.max_normal_part);
  whole.max_tangential_part = larger(whole.max_tangential_part, part.max_tangential_part);
  whole.max_corner_error = larger(whole.max_corner_error, part.max_corner_error);
}

inline void merge_interior(const Conversion_report::Interior& part,
                           Conversion_report::Interior& whole, double part_weight,
                           double whole_weight)
{
  const double previous = whole.max_deviation;
  whole.max_deviation = larger(whole.max_deviation, part.max_deviation);
  if(whole.max_deviation != previous)
    whole.worst = part.worst;
  whole.mean_deviation
    = weighted_mean(whole.mean_deviation, whole_weight, part.mean_deviation, part_weight);
  whole.certified_bound = larger(whole.certified_bound, part.certified_bound);
  whole.target_deviation = larger(whole.target_deviation, part.target_deviation);
  whole.target_height = larger(whole.target_height, part.target_height);
  whole.fraction_within_delta = weighted_mean(whole.fraction_within_delta, whole_weight,
                                              part.fraction_within_delta, part_weight);
}

inline void merge_counts(const Conversion_report::Counts& part, Conversion_report::Counts& whole)
{
  whole.layout_quads += part.layout_quads;
  whole.patches += part.patches;
  whole.control_points += part.control_points;
  whole.extraordinary_points += part.extraordinary_points;
  whole.t_junctions += part.t_junctions;
  whole.nurbs_faces += part.nurbs_faces;
  whole.bezier_elements += part.bezier_elements;
}

// the smaller of two figures of which either may not have been measured
inline double smaller(double a, double b) { return -larger(-a, -b); }

// adds the quality of the layout of a component, with the numbers of quads as weights.
inline void merge_map(const Conversion_report::Map& part, Conversion_report::Map& whole,
                      double part_weight, double whole_weight)
{
  const auto mean = [part_weight, whole_weight](double& a, double b)
  { a = weighted_mean(a, whole_weight, b, part_weight); };
  const auto maximum = [](double& a, double b) { a = larger(a, b); };
  const auto minimum = [](double& a, double b) { a = smaller(a, b); };

  whole.flipped_triangles += part.flipped_triangles;
  if(part.fallback != "none")
    whole.fallback = part.fallback;
  whole.extraordinary_points += part.extraordinary_points;
  minimum(whole.min_scaled_jacobian, part.min_scaled_jacobian);
  mean(whole.mean_angle_deviation_degrees, part.mean_angle_deviation_degrees);
  maximum(whole.max_angle_deviation_degrees, part.max_angle_deviation_degrees);
  minimum(whole.min_size_ratio, part.min_size_ratio);
  mean(whole.mean_size_ratio, part.mean_size_ratio);
  maximum(whole.max_size_ratio, part.max_size_ratio);
  mean(whole.mean_singular_value_ratio, part.mean_singular_value_ratio);
  maximum(whole.max_singular_value_ratio, part.max_singular_value_ratio);
  mean(whole.mean_area_ratio, part.mean_area_ratio);
  maximum(whole.max_area_ratio, part.max_area_ratio);
  mean(whole.mean_kink_degrees, part.mean_kink_degrees);
  maximum(whole.max_kink_degrees, part.max_kink_degrees);
  // both numbers of quads divided by the wanted number
  const double wanted = (whole_weight > 0 ? whole_weight / whole.relative_number_of_quads : 0)
                        + (part_weight > 0 ? part_weight / part.relative_number_of_quads : 0);
  whole.relative_number_of_quads = (whole_weight + part_weight) / wanted;
}

// adds the course of a component after those of the components before it
inline void merge_iterations(const Conversion_report& part, Conversion_report& whole)
{
  const std::size_t component
    = whole.iterations.empty() ? 0 : whole.iterations.back().component + 1;
  for(Conversion_report::Iteration iteration : part.iterations)
  {
    iteration.component = component;
    whole.iterations.push_back(iteration);
  }
}

// Adds the report of a connected component to that of the whole: counts and times are summed up,
// deviations are the largest, means are weighted with the numbers of patches.
inline void merge_reports(const Conversion_report& part, Conversion_report& whole)
{
  const double part_weight = double(part.counts.patches);
  const double whole_weight = double(whole.counts.patches);
  merge_boundary(part.boundary, whole.boundary, part_weight, whole_weight);
  merge_interior(part.interior, whole.interior, part_weight, whole_weight);
  merge_map(part.map, whole.map, double(part.counts.layout_quads),
            double(whole.counts.layout_quads));
  merge_counts(part.counts, whole.counts);
  whole.input.facet_sagitta = larger(whole.input.facet_sagitta, part.input.facet_sagitta);
  whole.smoothness.max_normal_angle_degrees
    = larger(whole.smoothness.max_normal_angle_degrees, part.smoothness.max_normal_angle_degrees);
  whole.smoothness.max_crease_angle_degrees
    = larger(whole.smoothness.max_crease_angle_degrees, part.smoothness.max_crease_angle_degrees);
  whole.smoothness.max_tangency_angle_degrees = larger(
    whole.smoothness.max_tangency_angle_degrees, part.smoothness.max_tangency_angle_degrees);
  whole.smoothness.tangency_conflicts += part.smoothness.tangency_conflicts;
  merge_iterations(part, whole);
  whole.warnings.insert(whole.warnings.end(), part.warnings.begin(), part.warnings.end());
  for(const Conversion_report::Stage& stage : part.stages)
    whole.add_time(stage.name, stage.seconds);
  if(whole.message.empty())
    whole.message = part.message;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_MERGE_REPORTS_H
