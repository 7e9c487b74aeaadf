// Fig. 12 of the paper: transfinite interpolation, or instead of it a mesh refined along the
// boundary.
#ifndef QUALITY_FIGURE_12_H
#define QUALITY_FIGURE_12_H

#include "Paper_mode.h"
#include "polygon_boundary.h"
#include "surface_picture.h"
#include "surface_stages.h"

#include <CGAL/Surface_mesh_spline_conversion/IO/conversion_history.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>

// the largest distance of the boundary of a surface from the curves: the tolerance that edges get
// when the surface is stitched to its neighbours
inline double stitch_gap(const Surface& surface, const Layout& layout, const Network& network)
{
  const int samples_per_side = 32;
  double result = 0;
  for(std::size_t c = 0; c < layout.number_of_chains(); ++c)
    for(const Layout::Side& side : layout.chain_sides(c))
      for(int k = 0; k < samples_per_side; ++k)
      {
        const auto uv = SC::internal::from_side<double>(side.second,
                                                        double(k) / samples_per_side, 0.);
        const Kernel::Point_3 p
          = surface.position(surface.patch_at(side.first, uv[0], uv[1]), uv[0], uv[1]);
        result = (std::max)(result, network.project(c, p).distance);
      }
  return result;
}

inline void print_row_of_figure_12(const char* boundary, const char* mode, const Outcome& outcome,
                                   double gap)
{
  std::printf("  %-12s %-8s %6zu %8zu %9zu %9zu %11.2e %s\n", boundary, mode, outcome.layout_quads,
              outcome.patches, outcome.control_points, outcome.bezier_elements, gap,
              outcome.is_met ? "yes" : "no");
  std::fflush(stdout);
}

inline bool print_figure_12(const Input& input, const std::string& name, const std::string& folder,
                            std::size_t maximum_number_of_patches)
{
  const Tolerances tolerances{1e-5, 1e-3};
  const double quad_size = 0.08, d = input.diameter();
  Input polygonal;
  make_polygon_boundary(input, polygonal);
  std::printf("Fig. 12: %s, boundary tolerance 1e-5, interior tolerance 1e-3, quad size 0.08\n"
              "  %-12s %-8s %6s %8s %9s %9s %11s %s\n", name.c_str(), "boundary", "mode", "quads",
              "patches", "controls", "elements", "gap/D", "met");
  for(const Input* source : {&input, static_cast<const Input*>(&polygonal)})
  {
    const bool is_polygonal = source == &polygonal;
    const char* boundary = is_polygonal ? "refined mesh" : "transfinite";
    Layout layout;
    if(!source->make_layout(quad_size, layout))
      return false;
    SC::Conversion_report default_report, paper_report;
    Surface surface;
    const Outcome ours = run_default_mode(*source, layout, tolerances, default_report, surface);
    print_row_of_figure_12(boundary, "default", ours,
                           stitch_gap(surface, layout, input.network.front()) / d);
    Paper_mode paper(*source, layout, tolerances, maximum_number_of_patches);
    const Outcome theirs = paper(paper_report);
    print_row_of_figure_12(boundary, "paper", theirs,
                           stitch_gap(paper.surface(), layout, input.network.front()) / d);
    const std::string file = folder + "/figure_12_" + name
                             + (is_polygonal ? "_refined_mesh" : "_transfinite");
    const std::string title = std::to_string(theirs.patches) + " patches, mode of the paper, "
                              + boundary;
    if(!draw_patches(file + ".png", paper.surface(), title)
       || !CGAL::IO::write_history_SVG(file + ".svg", paper_report))
      return false;
  }
  return true;
}

#endif // QUALITY_FIGURE_12_H
