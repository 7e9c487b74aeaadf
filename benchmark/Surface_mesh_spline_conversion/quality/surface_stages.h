// The stages that the programs on the quality of the surface share: a case and its layout, and the
// surface in the default mode of the package and in that of the paper.
#ifndef QUALITY_SURFACE_STAGES_H
#define QUALITY_SURFACE_STAGES_H

#include "surface_types.h"

#include <CGAL/Real_timer.h>
#include <CGAL/Surface_mesh/IO.h>
#include <CGAL/property_map.h>

#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/Transfinite_patch_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_boundary.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_interior.h>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

typedef SC::Conversion_case<Kernel> Case;
typedef SC::Boundary_curve_network_3<Case::Triangle_mesh, Case::Curve_traits> Network;
typedef SC::Transfinite_patch_network_3<Kernel, Case::Triangle_mesh, Case::Curve_traits> Target;

// A case, or a closed mesh, with its network; not to be copied, as the network refers to the mesh.
struct Input
{
  Input() {}

  // `path` is a case or the file of a closed mesh
  explicit Input(const std::string& path)
  {
    if(std::filesystem::path(path).extension() == ".off")
    {
      is_valid = CGAL::IO::read_polygon_mesh(path, data.mesh);
      message = is_valid ? "" : path + " cannot be read";
      if(is_valid)
        network.emplace_back(data.mesh);
    }
    else
    {
      is_valid = CGAL::IO::read_case(path, data, message);
      if(is_valid)
        network.emplace_back(
          data.mesh, data.halfedge_curve_map(), data.traits,
          CGAL::parameters::vertex_is_constrained_map(data.vertex_is_corner_map()));
    }
    if(is_valid && network.front().error() != SC::Error_code::OK)
    {
      is_valid = false;
      message = network.front().message();
    }
  }

  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  double diameter() const { return network.front().diameter(); }

  // `quad_size` is relative to the diameter
  bool make_layout(double quad_size, Layout& layout) const
  {
    SC::Conversion_report report;
    const CGAL::Constant_property_map<CGAL::SM_Vertex_index, double> sizes(quad_size * diameter());
    return is_valid
           && SC::compute_quad_layout(data.mesh, network.front(), layout, report,
                                      CGAL::parameters::quad_size_map(sizes)) == SC::Error_code::OK;
  }

  Case data;
  std::vector<Network> network;
  std::string message;
  bool is_valid = false;
};

// tolerances relative to the diameter
struct Tolerances
{
  double xi, delta;
};

// what a mode costs
struct Outcome
{
  std::size_t layout_quads = 0, patches = 0, control_points = 0, bezier_elements = 0,
    iterations = 0;
  bool is_met = false;
  double seconds = 0;

  std::size_t added_patches() const { return patches - layout_quads; }
};

inline void count(const Surface& surface, const Layout& layout, Outcome& outcome)
{
  outcome.layout_quads = layout.number_of_quads();
  outcome.patches = surface.number_of_patches();
  outcome.control_points = surface.number_of_control_points();
  outcome.bezier_elements = surface.bezier_elements().size();
}

// fits `surface`, as made from the layout, in the default mode
inline Outcome run_default_mode(const Input& input, const Layout& layout,
                                const Tolerances& tolerances, SC::Conversion_report& report,
                                Surface& surface)
{
  CGAL::Real_timer timer;
  timer.start();
  const Target target(layout, input.network.front(), input.data.mesh);
  surface = Surface(layout);
  report.boundary_tolerance = tolerances.xi * input.diameter();
  report.interior_tolerance = tolerances.delta * input.diameter();
  const auto np = CGAL::parameters::boundary_tolerance(report.boundary_tolerance)
                    .interior_tolerance(report.interior_tolerance);
  Outcome outcome;
  outcome.is_met = SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK
                   && SC::fit_interior(surface, target, report, np) == SC::Error_code::OK;
  outcome.iterations = report.iterations.size();
  outcome.seconds = timer.time();
  count(surface, layout, outcome);
  return outcome;
}

#endif // QUALITY_SURFACE_STAGES_H
