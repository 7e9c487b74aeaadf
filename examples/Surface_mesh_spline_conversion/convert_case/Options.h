// The command line of convert_case.
#ifndef CONVERT_CASE_OPTIONS_H
#define CONVERT_CASE_OPTIONS_H

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

// Exit codes of convert_case.
enum Exit_code
{
  SUCCESS = 0,               // tolerances met and files written
  BAD_INPUT = 2,             // the message names the element
  TOLERANCE_NOT_REACHED = 3, // the best surface is written, the report says where and why
  FAILURE = 4                // any other failure
};

struct Options
{
  static constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

  std::string input;
  double xi = not_given, delta = not_given, quad_size = not_given;
  std::string preset = "medium";
  bool is_relative = false;
  std::string output, report, history, vtk, pictures, stitched, residual;
  std::size_t stitching_seconds = 600; // many times what a thousand faces take
  std::size_t threads = 0; // as many as the machine offers
  std::size_t maximum_number_of_patches = 200000; // the default of the library
  std::string error_metric = "reprojected";
  bool do_merge = true;
  bool do_coarsen = false;
  bool do_fair = false;
  bool do_certify = false;
  bool has_smooth_target = false;
  bool has_caps = false;
  bool is_tangent = false;
  bool is_quiet = false;
  bool asks_for_help = false;
};

inline const char* usage()
{
  return
    "usage: convert_case INPUT [options]\n"
    "INPUT is a case (a folder or its case.json) or a mesh (OFF, PLY, OBJ, STL).\n"
    "  --xi X             tolerance of the boundary\n"
    "  --delta D          tolerance of the interior\n"
    "  --quad-size H      edge length of the quads of the layout\n"
    "  --preset P         coarse, medium (default), or fine: sets X, D, and H\n"
    "  --relative         X, D, and H are relative to the diameter of the enclosing sphere\n"
    "  --output F.step    write the surface as STEP file\n"
    "  --report F.json    write all figures\n"
    "  --history F.csv    write the iterations (and a chart of them beside it, F.svg), or F.svg\n"
    "                     for the chart alone\n"
    "  --vtk F.vtu        write the surface as Bezier cells\n"
    "  --pictures DIR     draw layout, patches, deviation, and zebra stripes\n"
    "  --stitched F.step  stitch with the residual model to a solid (or F.brep)\n"
    "  --stitch-limit S   give up stitching after S seconds (600)\n"
    "  --residual F.step  the residual model: that of a mesh, or instead of that of the case;\n"
    "                     a mesh gets the curves of its free edges\n"
    "  --tangent          make the surface tangent to the faces of the residual model\n"
    "  --threads N        at most N threads (all cores; one if built without TBB)\n"
    "  --max-patches N    stop refining at this number of patches\n"
    "  --coarsen          look for a surface with fewer patches after the fit\n"
    "  --fair             even out the curvature within the tolerances\n"
    "  --certify          prove a bound of the distance from the surface to the mesh\n"
    "  --smooth-target    fit curved triangles instead of the facets of the mesh: D is the distance\n"
    "                     from them\n"
    "  --caps             fit the caps at extraordinary points themselves, not what they stand for\n"
    "  --error-metric M   parametric, reprojected (default), or hausdorff\n"
    "  --no-merge         one face per Bezier element in the STEP file\n"
    "  --quiet            no progress on the standard error stream\n"
    "exit status: 0 tolerances met, 2 bad input, 3 a tolerance was not reached, 4 other failure\n";
}

// Reads a positive finite number that fills the whole text.
inline bool parse_number(const std::string& text, double& value)
{
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value) && value > 0;
}

// Reads a positive integer that fills the whole text.
inline bool parse_count(const std::string& text, std::size_t& value)
{
  const std::size_t most_digits = 15;
  if(text.empty() || text.size() > most_digits
     || text.find_first_not_of("0123456789") != std::string::npos)
    return false;
  value = static_cast<std::size_t>(std::strtoull(text.c_str(), nullptr, 10));
  return value > 0;
}

inline bool parse_word(const std::string& text, const std::vector<std::string>& words,
                       std::string& value)
{
  value = text;
  for(const std::string& word : words)
    if(word == text)
      return true;
  return false;
}

// Reads the command line; returns what is wrong with it, or nothing.
inline std::string parse_options(const std::vector<std::string>& arguments, Options& options)
{
  typedef std::function<bool(const std::string&)> Setter;
  const auto number = [](double& value)
  { return [&value](const std::string& text) { return parse_number(text, value); }; };
  const auto count = [](std::size_t& value)
  { return [&value](const std::string& text) { return parse_count(text, value); }; };
  const auto path = [](std::string& value)
  { return [&value](const std::string& text) { value = text; return !text.empty(); }; };
  const auto word = [](std::string& value, const std::vector<std::string>& words)
  { return [&value, words](const std::string& text) { return parse_word(text, words, value); }; };

  const std::map<std::string, Setter> setters = {
    {"--xi", number(options.xi)},
    {"--delta", number(options.delta)},
    {"--quad-size", number(options.quad_size)},
    {"--preset", word(options.preset, {"coarse", "medium", "fine"})},
    {"--output", path(options.output)},
    {"--report", path(options.report)},
    {"--history", path(options.history)},
    {"--vtk", path(options.vtk)},
    {"--pictures", path(options.pictures)},
    {"--stitched", path(options.stitched)},
    {"--stitch-limit", count(options.stitching_seconds)},
    {"--residual", path(options.residual)},
    {"--threads", count(options.threads)},
    {"--max-patches", count(options.maximum_number_of_patches)},
    {"--error-metric",
     word(options.error_metric, {"parametric", "reprojected", "hausdorff"})}};
  const std::map<std::string, std::function<void()> > switches = {
    {"--relative", [&options] { options.is_relative = true; }},
    {"--tangent", [&options] { options.is_tangent = true; }},
    {"--coarsen", [&options] { options.do_coarsen = true; }},
    {"--fair", [&options] { options.do_fair = true; }},
    {"--certify", [&options] { options.do_certify = true; }},
    {"--smooth-target", [&options] { options.has_smooth_target = true; }},
    {"--caps", [&options] { options.has_caps = true; }},
    {"--no-merge", [&options] { options.do_merge = false; }},
    {"--quiet", [&options] { options.is_quiet = true; }},
    {"--help", [&options] { options.asks_for_help = true; }}};

  for(std::size_t i = 0; i < arguments.size(); ++i)
  {
    const std::string& argument = arguments[i];
    if(switches.count(argument))
      switches.at(argument)();
    else if(setters.count(argument))
    {
      if(i + 1 == arguments.size())
        return argument + " needs a value";
      if(!setters.at(argument)(arguments[++i]))
        return "'" + arguments[i] + "' is no value for " + argument;
    }
    else if(argument.size() > 1 && argument[0] == '-')
      return "unknown option " + argument;
    else if(!options.input.empty())
      return "there are two inputs, '" + options.input + "' and '" + argument + "'";
    else
      options.input = argument;
  }
  if(options.input.empty() && !options.asks_for_help)
    return "the input is missing";
  return std::string();
}

#endif // CONVERT_CASE_OPTIONS_H
