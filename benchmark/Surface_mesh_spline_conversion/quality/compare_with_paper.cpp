// Compares the default mode of the package with the mode of the paper.
// usage: compare_with_paper CASE...
// The case d2_square_corner is also run in the setting of Fig. 13 of the paper.

#include "Paper_mode.h"
#include "surface_stages.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

// the largest surface that the mode of the paper may make
const std::size_t maximum_number_of_patches = 20000;

// Fig. 13: the unit square with one corner, tolerance 1e-4
bool print_figure_13(const Input& input)
{
  const Tolerances tolerances{1e-4, 1e-3};
  Layout layout;
  if(!input.make_layout(0.12, layout))
    return false;
  std::printf("Fig. 13: boundary tolerance 1e-4, %zu quads\n", layout.number_of_quads());
  std::printf("  %-8s %9s %8s %12s %12s\n", "mode", "iteration", "patches", "parametric",
              "Hausdorff");
  Paper_mode paper(input, layout, tolerances, maximum_number_of_patches);
  std::size_t i = 0;
  for(const Boundary_iteration& entry : paper.fit_boundary())
    std::printf("  %-8s %9zu %8zu %12.3g %12.3g\n", "paper", i++, entry.patches, entry.parametric,
                entry.hausdorff);
  SC::Conversion_report report;
  const Outcome outcome = run_default_mode(input, layout, tolerances, report);
  for(const auto& entry : report.iterations)
    if(entry.stage == "fit_boundary")
      std::printf("  %-8s %9zu %8zu %12.3g %12.3g\n", "default", entry.iteration, entry.patches,
                  entry.boundary_linf / input.diameter(),
                  entry.boundary_hausdorff / input.diameter());
  std::printf("  default: %zu patches, %zu control points in the end\n", outcome.patches,
              outcome.control_points);
  return true;
}

void print_row(const std::string& name, const char* mode, const Outcome& outcome)
{
  std::printf("%-18s %-8s %6zu %7zu %9zu %10zu %8.3f %s\n", name.c_str(), mode,
              outcome.layout_quads, outcome.added_patches(), outcome.control_points,
              outcome.iterations, outcome.seconds, outcome.is_met ? "yes" : "no");
  std::fflush(stdout);
}

int main(int argc, char* argv[])
{
  const Tolerances tolerances{1e-5, 1e-3};
  const double quad_size = 0.08;
  std::vector<double> ratios;
  std::printf("boundary tolerance 1e-5, interior tolerance 1e-3, quad size 0.08\n"
              "%-18s %-8s %6s %7s %9s %10s %8s %s\n", "case", "mode", "quads", "added",
              "controls", "iterations", "seconds", "met");
  for(int i = 1; i < argc; ++i)
  {
    const Input input(argv[i]);
    const std::string name = std::filesystem::path(argv[i]).filename().string();
    Layout layout;
    if(!input.make_layout(quad_size, layout))
    {
      std::fprintf(stderr, "%s: %s\n", name.c_str(),
                   input.is_valid ? "no layout" : input.message.c_str());
      return EXIT_FAILURE;
    }
    SC::Conversion_report report;
    const Outcome ours = run_default_mode(input, layout, tolerances, report);
    print_row(name, "default", ours);
    const Outcome theirs = Paper_mode(input, layout, tolerances, maximum_number_of_patches)();
    print_row(name, "paper", theirs);
    ratios.push_back(double(ours.added_patches()) / double((std::max)(theirs.added_patches(),
                                                                      std::size_t(1))));
    if(name == "d2_square_corner" && !print_figure_13(input))
      return EXIT_FAILURE;
  }
  std::sort(ratios.begin(), ratios.end());
  if(!ratios.empty())
    std::printf("patches added by the default mode in proportion to the mode of the paper, median: "
                "%.3f\n", ratios[ratios.size() / 2]);
  return EXIT_SUCCESS;
}
