// Fig. 13 of the paper: the boundary iteration on a unit square with one corner.
#ifndef QUALITY_FIGURE_13_H
#define QUALITY_FIGURE_13_H

#include "Paper_mode.h"
#include "surface_picture.h"
#include "surface_stages.h"

#include <CGAL/Surface_mesh_spline_conversion/IO/conversion_history.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

// writes the patches after each iteration in the mode of the paper
struct Iteration_pictures
{
  std::string folder;
  std::size_t number = 0;
  bool is_written = true;

  void operator()(const Boundary_iteration& iteration, const Surface& surface)
  {
    const std::string file = folder + "/figure_13_iteration_" + std::to_string(number) + ".png";
    is_written = draw_patches(file, surface, "iteration " + std::to_string(number++) + ": "
                              + std::to_string(iteration.patches) + " patches", true)
                 && is_written;
  }
};

inline void print_boundary_iterations(const char* mode, const SC::Conversion_report& report,
                                      double diameter)
{
  for(const auto& entry : report.iterations)
    if(entry.stage == "fit_boundary")
      std::printf("  %-8s %9zu %8zu %9zu %12.3g %12.3g\n", mode, entry.iteration, entry.patches,
                  entry.control_points, entry.boundary_linf / diameter,
                  entry.boundary_hausdorff / diameter);
}

inline bool print_figure_13(const Input& input, const std::string& folder,
                            std::size_t maximum_number_of_patches)
{
  const Tolerances tolerances{1e-4, 1e-3};
  Layout layout;
  if(!input.make_layout(0.12, layout))
    return false;
  const double d = input.diameter();
  std::printf("Fig. 13: boundary tolerance 1e-4, %zu quads; the paper has 710 patches when the "
              "Hausdorff distance\n         is met (iteration 5), 1255 when the parametric error "
              "is (iteration 8)\n"
              "  %-8s %9s %8s %9s %12s %12s\n", layout.number_of_quads(), "mode", "iteration",
              "patches", "controls", "parametric", "Hausdorff");
  Paper_mode paper(input, layout, tolerances, maximum_number_of_patches);
  Iteration_pictures pictures{folder};
  SC::Conversion_report paper_report, default_report;
  paper_report.boundary_tolerance = tolerances.xi * d;
  paper.add_to_report(paper.fit_boundary([&pictures](const Boundary_iteration& i, const Surface& s)
                                         { pictures(i, s); }), paper_report);
  SC::Conversion_report extension_report;
  Paper_mode extension(input, layout, tolerances, maximum_number_of_patches,
                       Standardization::EXTENSION);
  extension.add_to_report(extension.fit_boundary(), extension_report);
  Surface surface;
  const Outcome outcome = run_default_mode(input, layout, tolerances, default_report, surface);
  print_boundary_iterations("paper", paper_report, d);
  print_boundary_iterations("one bay", extension_report, d);
  print_boundary_iterations("default", default_report, d);
  std::printf("  are 16 functions on each Bezier element, that sum up to one? paper: %s, one bay: %s, "
              "default: %s\n", paper.surface().is_valid() ? "yes" : "no",
              extension.surface().is_valid() ? "yes" : "no", surface.is_valid() ? "yes" : "no");
  std::printf("  default: %zu patches, %zu control points, %zu Bezier elements in the end\n",
              outcome.patches, outcome.control_points, outcome.bezier_elements);
  std::fflush(stdout);
  return pictures.is_written
         && CGAL::IO::write_history_SVG(folder + "/figure_13_paper.svg", paper_report)
         && CGAL::IO::write_history_SVG(folder + "/figure_13_default.svg", default_report)
         && draw_patches(folder + "/figure_13_default.png", surface,
                         "default mode: " + std::to_string(outcome.patches) + " patches", true);
}

#endif // QUALITY_FIGURE_13_H
