// The tolerances and sizes of a conversion in model units.
#ifndef CONVERT_CASE_RESOLUTION_H
#define CONVERT_CASE_RESOLUTION_H

#include <CGAL/Surface_mesh_spline_conversion/Error_metric.h>
#include <CGAL/Surface_mesh_spline_conversion/smallest_enclosing_sphere_diameter.h>

#include "Options.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

struct Resolution
{
  double xi, delta, quad_size;
  CGAL::Surface_mesh_spline_conversion::Error_metric error_metric;
  std::size_t maximum_number_of_patches;
};

// Tolerances and quad size of a preset, relative to the diameter of the enclosing sphere.
struct Preset
{
  double xi, delta, quad_size;
};

inline Preset find_preset(const std::string& name)
{
  if(name == "coarse")
    return Preset{1e-5, 5e-3, 1. / 20};
  if(name == "fine")
    return Preset{1e-7, 5e-4, 1. / 60};
  return Preset{1e-6, 1e-3, 1. / 40};
}

inline CGAL::Surface_mesh_spline_conversion::Error_metric find_error_metric(const std::string& name)
{
  using CGAL::Surface_mesh_spline_conversion::Error_metric;
  if(name == "parametric")
    return Error_metric::PARAMETRIC;
  return (name == "hausdorff") ? Error_metric::HAUSDORFF : Error_metric::REPROJECTED;
}

template <typename Mesh>
double mean_edge_length(const Mesh& mesh)
{
  double sum = 0;
  for(const auto e : mesh.edges())
  {
    const auto h = mesh.halfedge(e);
    const auto difference = mesh.point(mesh.target(h)) - mesh.point(mesh.source(h));
    sum += std::sqrt(difference.squared_length());
  }
  return mesh.is_empty() ? 0 : sum / static_cast<double>(mesh.number_of_edges());
}

// Combines preset and options; explicit options win.
template <typename Mesh>
Resolution find_resolution(const Options& options, const Mesh& mesh)
{
  const double diameter
    = CGAL::Surface_mesh_spline_conversion::smallest_enclosing_sphere_diameter(mesh);
  const Preset preset = find_preset(options.preset);
  const double unit = options.is_relative ? diameter : 1;
  const auto choose = [unit](double option, double otherwise)
  { return std::isnan(option) ? otherwise : option * unit; };

  Resolution resolution;
  resolution.xi = choose(options.xi, preset.xi * diameter);
  resolution.delta = choose(options.delta, preset.delta * diameter);
  // the default also keeps the quads larger than the triangles, whose edges must not be copied
  const double smallest = (options.preset == "medium") ? 2 * mean_edge_length(mesh) : 0;
  resolution.quad_size = choose(options.quad_size,
                                (std::max)(preset.quad_size * diameter, smallest));
  resolution.error_metric = find_error_metric(options.error_metric);
  resolution.maximum_number_of_patches = options.maximum_number_of_patches;
  return resolution;
}

#endif // CONVERT_CASE_RESOLUTION_H
