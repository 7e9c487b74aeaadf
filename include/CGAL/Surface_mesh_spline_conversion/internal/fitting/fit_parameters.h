// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FIT_PARAMETERS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FIT_PARAMETERS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Error_metric.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/format_number.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/number_utils.h>

#include <cmath>
#include <cstddef>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// the limits of the boundary fit
struct Boundary_fit_options
{
  double tolerance; // what is judged
  double goal;      // where the refinement stops
  Error_metric error_metric;
  std::size_t maximum_number_of_patches;
};

// the limits of the interior fit
struct Interior_fit_options
{
  double tolerance;
  Error_metric error_metric;
  std::size_t maximum_number_of_patches;
  bool do_coarsen;
};

constexpr double default_relative_boundary_tolerance = 1e-6;
constexpr double default_relative_interior_tolerance = 1e-3;

// Share of the boundary tolerance at which the refinement stops. Two faces meet at a curve, and a
// CAD system that sews them adds their deviations from their common edge. As the error falls by 16
// per bisection, this costs a few percent of the control points.
constexpr double boundary_goal = 1. / 2;

constexpr std::size_t default_maximum_number_of_patches = 200000;

// Returns what is wrong with a tolerance, or an empty string. Below the smallest one there is nothing
// but the rounding of the coordinates.
inline std::string tolerance_defect(const std::string& name, double tolerance, double diameter)
{
  constexpr double smallest_relative_tolerance = 1e-14;
  if(!(tolerance > 0) || !std::isfinite(tolerance))
    return "the " + name + " tolerance is not a positive number";
  const double smallest = smallest_relative_tolerance * diameter;
  if(tolerance < smallest)
    return "the " + name + " tolerance " + format_number(tolerance) + " is below "
           + format_number(smallest) + ", about the rounding errors of the coordinates";
  return std::string();
}

template <typename NamedParameters>
std::size_t maximum_number_of_patches(const NamedParameters& np)
{
  return static_cast<std::size_t>(parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::maximum_number_of_patches),
    default_maximum_number_of_patches));
}

template <typename NamedParameters>
Error_metric error_metric(const NamedParameters& np)
{
  return parameters::choose_parameter(parameters::get_parameter(np, internal_np::error_metric),
                                      Error_metric::REPROJECTED);
}

template <typename NamedParameters>
bool do_coarsen(const NamedParameters& np)
{
  return parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::do_coarsen_patches), false);
}

template <typename Target, typename NamedParameters>
Boundary_fit_options boundary_fit_options(const Target& target, const NamedParameters& np)
{
  const double tolerance = CGAL::to_double(parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::boundary_tolerance),
    default_relative_boundary_tolerance * CGAL::to_double(target.diameter())));
  const Error_metric metric = error_metric(np);
  // the parametric errors are for comparison with the paper, which knows no such goal
  const double goal = metric == Error_metric::PARAMETRIC ? tolerance : boundary_goal * tolerance;
  return Boundary_fit_options{tolerance, goal, metric, maximum_number_of_patches(np)};
}

template <typename Target, typename NamedParameters>
Interior_fit_options interior_fit_options(const Target& target, const NamedParameters& np)
{
  const double tolerance = CGAL::to_double(parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::interior_tolerance),
    default_relative_interior_tolerance * CGAL::to_double(target.diameter())));
  return Interior_fit_options{tolerance, error_metric(np), maximum_number_of_patches(np),
                              do_coarsen(np)};
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FIT_PARAMETERS_H
