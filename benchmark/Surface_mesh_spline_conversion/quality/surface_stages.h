// The stages that the programs on the quality of the surface share: a case and its layout, and the
// surface in the default mode of the package and in that of the paper.
#ifndef QUALITY_SURFACE_STAGES_H
#define QUALITY_SURFACE_STAGES_H

#include <CGAL/Real_timer.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/T_NURCC_surface_3.h>
#include <CGAL/property_map.h>

#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/Transfinite_patch_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_boundary.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_interior.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef SC::Conversion_case<Kernel> Case;
typedef SC::Boundary_curve_network_3<Case::Triangle_mesh, Case::Curve_traits> Network;
typedef SC::Quad_layout<Kernel> Layout;
typedef SC::Transfinite_patch_network_3<Kernel, Case::Triangle_mesh, Case::Curve_traits> Target;
typedef CGAL::T_NURCC_surface_3<Kernel> Surface;

// A case with its network; not to be copied, as the network refers to the mesh.
struct Input
{
  explicit Input(const std::string& path)
  {
    is_valid = CGAL::IO::read_case(path, data, message);
    if(is_valid)
      network.emplace_back(data.mesh, data.halfedge_curve_map(), data.traits,
                           CGAL::parameters::vertex_is_constrained_map(data.vertex_is_corner_map()));
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
  bool is_valid;
};

// tolerances relative to the diameter
struct Tolerances
{
  double xi, delta;
};

// what a mode costs
struct Outcome
{
  std::size_t layout_quads = 0, patches = 0, control_points = 0, iterations = 0;
  bool is_met = false;
  double seconds = 0;

  std::size_t added_patches() const { return patches - layout_quads; }
};

inline void count(const Surface& surface, const Layout& layout, Outcome& outcome)
{
  outcome.layout_quads = layout.number_of_quads();
  outcome.patches = surface.number_of_patches();
  outcome.control_points = surface.number_of_control_points();
}

inline Outcome run_default_mode(const Input& input, const Layout& layout,
                                const Tolerances& tolerances, SC::Conversion_report& report)
{
  CGAL::Real_timer timer;
  timer.start();
  const Target target(layout, input.network.front(), input.data.mesh);
  Surface surface(layout);
  const auto np = CGAL::parameters::boundary_tolerance(tolerances.xi * input.diameter())
                    .interior_tolerance(tolerances.delta * input.diameter());
  Outcome outcome;
  outcome.is_met = SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK
                   && SC::fit_interior(surface, target, report, np) == SC::Error_code::OK;
  outcome.iterations = report.iterations.size();
  outcome.seconds = timer.time();
  count(surface, layout, outcome);
  return outcome;
}

#endif // QUALITY_SURFACE_STAGES_H
