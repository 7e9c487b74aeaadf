// Fig. 14 of the paper: a closed mesh, the rocker arm.
#ifndef QUALITY_FIGURE_14_H
#define QUALITY_FIGURE_14_H

#include "Paper_mode.h"
#include "surface_picture.h"
#include "surface_stages.h"

#include <CGAL/Real_timer.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/conversion_history.h>

#include <cstddef>
#include <cstdio>
#include <string>

inline bool print_figure_14(const Input& input, const std::string& folder,
                            std::size_t maximum_number_of_patches)
{
  const Tolerances tolerances{1e-6, 2e-3};
  CGAL::Real_timer timer;
  timer.start();
  Layout layout;
  if(!input.make_layout(0.04, layout))
    return false;
  timer.stop();
  std::printf("Fig. 14: interior tolerance 2e-3, quad size 0.04; the paper has 3993 patches, 4185 "
              "control points,\n         59 s for the fit and 4 min for the map\n"
              "  %-8s %6s %8s %9s %10s %8s %8s %s\n", "mode", "quads", "patches", "controls",
              "iterations", "map s", "fit s", "met");
  SC::Conversion_report default_report, paper_report;
  Surface surface;
  const Outcome ours = run_default_mode(input, layout, tolerances, default_report, surface);
  Paper_mode paper(input, layout, tolerances, maximum_number_of_patches);
  const Outcome theirs = paper(paper_report);
  for(const Outcome* outcome : {&ours, &theirs})
    std::printf("  %-8s %6zu %8zu %9zu %10zu %8.2f %8.2f %s\n",
                outcome == &ours ? "default" : "paper", outcome->layout_quads, outcome->patches,
                outcome->control_points, outcome->iterations, timer.time(), outcome->seconds,
                outcome->is_met ? "yes" : "no");
  std::fflush(stdout);
  return draw_patches(folder + "/figure_14_default.png", surface,
                      "default mode: " + std::to_string(ours.patches) + " patches")
         && draw_patches(folder + "/figure_14_paper.png", paper.surface(),
                         "mode of the paper: " + std::to_string(theirs.patches) + " patches")
         && CGAL::IO::write_history_SVG(folder + "/figure_14_default.svg", default_report)
         && CGAL::IO::write_history_SVG(folder + "/figure_14_paper.svg", paper_report);
}

#endif // QUALITY_FIGURE_14_H
