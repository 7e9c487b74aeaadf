// Prints figures of the paper as tables, draws them, and compares the default mode of the package
// with the mode of the paper.
// usage: compare_with_paper CASES MESH.off FOLDER
// CASES is the folder of the cases, MESH.off the closed mesh of Fig. 14; pictures go to FOLDER.

#include "Paper_mode.h"
#include "figure_12.h"
#include "figure_13.h"
#include "figure_14.h"
#include "figure_2.h"
#include "surface_stages.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

// the largest surface that the mode of the paper may make
const std::size_t maximum_number_of_patches = 20000;

void print_row(const std::string& name, const char* mode, const Outcome& outcome)
{
  std::printf("%-18s %-8s %6zu %7zu %9zu %9zu %10zu %8.3f %s\n", name.c_str(), mode,
              outcome.layout_quads, outcome.added_patches(), outcome.control_points,
              outcome.bezier_elements, outcome.iterations, outcome.seconds,
              outcome.is_met ? "yes" : "no");
  std::fflush(stdout);
}

// what the default mode costs in proportion to a mode of the paper
struct Ratios
{
  std::vector<double> patches, control_points;

  void add(const Outcome& ours, const Outcome& theirs)
  {
    patches.push_back(double(ours.added_patches())
                      / double((std::max)(theirs.added_patches(), std::size_t(1))));
    control_points.push_back(double(ours.control_points) / double(theirs.control_points));
  }

  void print(const char* mode) const
  {
    if(!patches.empty())
      std::printf("default mode in proportion to mode '%s', median: added patches %.3f, control "
                  "points %.3f\n", mode, median(patches), median(control_points));
  }

private:
  static double median(std::vector<double> values)
  {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  }
};

// all modes on all cases
bool print_modes(const std::vector<std::string>& cases, const std::string& folder)
{
  const Tolerances tolerances{1e-5, 1e-3};
  const double quad_size = 0.08;
  Ratios to_paper, to_extension;
  std::printf("Modes: boundary tolerance 1e-5, interior tolerance 1e-3, quad size 0.08\n"
              "%-18s %-8s %6s %7s %9s %9s %10s %8s %s\n", "case", "mode", "quads", "added",
              "controls", "elements", "iterations", "seconds", "met");
  for(const std::string& path : cases)
  {
    const Input input(path);
    const std::string name = std::filesystem::path(path).filename().string();
    Layout layout;
    if(!input.make_layout(quad_size, layout))
    {
      std::printf("%-18s %s\n", name.c_str(),
                  input.is_valid ? "no layout" : input.message.c_str());
      continue;
    }
    SC::Conversion_report default_report, paper_report;
    Surface surface;
    const Outcome ours = run_default_mode(input, layout, tolerances, default_report, surface);
    print_row(name, "default", ours);
    const Outcome theirs = Paper_mode(input, layout, tolerances,
                                      maximum_number_of_patches)(paper_report);
    print_row(name, "paper", theirs);
    to_paper.add(ours, theirs);
    SC::Conversion_report extension_report;
    const Outcome extension = Paper_mode(input, layout, tolerances, maximum_number_of_patches,
                                         Standardization::EXTENSION)(extension_report);
    print_row(name, "one bay", extension);
    to_extension.add(ours, extension);
    if(!CGAL::IO::write_history_SVG(folder + "/modes_" + name + "_default.svg", default_report)
       || !CGAL::IO::write_history_SVG(folder + "/modes_" + name + "_paper.svg", paper_report))
      return false;
  }
  to_paper.print("paper");
  to_extension.print("one bay");
  return true;
}

int main(int argc, char* argv[])
{
  if(argc != 4)
  {
    std::fprintf(stderr, "usage: compare_with_paper CASES MESH.off FOLDER\n");
    return EXIT_FAILURE;
  }
  const std::string folder_of_cases = argv[1], folder = argv[3];
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::vector<std::string> cases;
  for(const auto& entry : std::filesystem::directory_iterator(folder_of_cases, error))
    if(entry.is_directory())
      cases.push_back(entry.path().string());
  std::sort(cases.begin(), cases.end());
  const Input dome(folder_of_cases + "/d1_dome"), square(folder_of_cases + "/d2_square_corner"),
    bracket(folder_of_cases + "/d4_bracket_simp"), closed(argv[2]);
  for(const Input* input : {&dome, &square, &bracket, &closed})
    if(!input->is_valid)
    {
      std::fprintf(stderr, "%s\n", input->message.c_str());
      return EXIT_FAILURE;
    }
  const bool is_written
    = print_figure_2(dome, folder)
   && print_figure_12(dome, "dome", folder, maximum_number_of_patches)
   && print_figure_12(bracket, "bracket", folder, maximum_number_of_patches)
   && print_figure_13(square, folder, maximum_number_of_patches)
   && print_figure_14(closed, folder, maximum_number_of_patches)
   && print_modes(cases, folder);
  if(!is_written)
    std::fprintf(stderr, "a layout was not found, or a file in %s cannot be written\n",
                 folder.c_str());
  return is_written ? EXIT_SUCCESS : EXIT_FAILURE;
}
