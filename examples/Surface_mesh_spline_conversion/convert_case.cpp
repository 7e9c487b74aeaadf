// The command line tool: converts a case (a mesh with boundary curves) or a bare mesh, and writes
// the surface, a report, and pictures. Run it with --help for the options.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/T_NURCC_surface_3.h>

#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/convert_to_T_NURCC.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>

#include "convert_case/Options.h"
#include "convert_case/Progress_visitor.h"
#include "convert_case/mesh_reader.h"
#include "convert_case/resolution.h"
#include "convert_case/write_results.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

typedef CGAL::Simple_cartesian<double> K;
typedef CGAL::Surface_mesh<K::Point_3> Mesh;
typedef CGAL::T_NURCC_surface_3<K> Surface;

// Ends a run that failed before the conversion: tells why, also in the report.
Exit_code stop(const Options& options, Report& report, SC::Error_code code,
               const std::string& message)
{
  report.status = code;
  report.message = message;
  std::fprintf(stderr, "convert_case: %s\n", message.c_str());
  write_report(options, report);
  return BAD_INPUT;
}

Exit_code exit_code(SC::Error_code code)
{
  switch(code)
  {
    case SC::Error_code::OK:
      return SUCCESS;
    case SC::Error_code::EMPTY_MESH:
    case SC::Error_code::NON_TRIANGULAR_MESH:
    case SC::Error_code::NON_MANIFOLD_MESH:
    case SC::Error_code::DEGENERATE_MESH:
    case SC::Error_code::INVALID_BOUNDARY_ASSOCIATION:
    case SC::Error_code::INVALID_PARAMETER:
      return BAD_INPUT;
    case SC::Error_code::TOLERANCE_NOT_REACHED:
      return TOLERANCE_NOT_REACHED;
    case SC::Error_code::NO_SEAMLESS_MAP:
    case SC::Error_code::NO_QUAD_LAYOUT:
    case SC::Error_code::SINGULAR_SYSTEM:
    case SC::Error_code::INTERRUPTED:
      break;
  }
  return FAILURE;
}

// Converts, and writes whatever came out. `conversion` calls convert_to_T_NURCC() with the named
// parameters it is given.
template <typename Conversion>
Exit_code convert_and_write(const Options& options, const Mesh& mesh, const std::string& unit,
                            Report& report, const Conversion& conversion)
{
  const Resolution resolution = find_resolution(options, mesh);
  Progress_visitor visitor(options.is_quiet, number_of_stages(mesh));
  std::vector<Surface> surfaces;
  // the conversion starts a report of its own
  const std::vector<std::string> warnings = report.warnings;
  const SC::Error_code code
    = conversion(surfaces, report,
                 CGAL::parameters::boundary_tolerance(resolution.xi)
                   .interior_tolerance(resolution.delta)
                   .quad_size_map(resolution.quad_size)
                   .error_metric(resolution.error_metric)
                   .maximum_number_of_patches(resolution.maximum_number_of_patches)
                   .visitor(std::ref(visitor)));
  report.status = code;
  report.warnings.insert(report.warnings.begin(), warnings.begin(), warnings.end());
  for(const std::string& warning : report.warnings)
    std::fprintf(stderr, "convert_case: warning: %s\n", warning.c_str());
  if(code != SC::Error_code::OK)
    std::fprintf(stderr, "convert_case: %s: %s\n", SC::error_message(code),
                 report.message.c_str());

  if(code != SC::Error_code::OK && code != SC::Error_code::TOLERANCE_NOT_REACHED)
    surfaces.clear(); // what is there is only a part of the result
  SC::STEP_information information;
  information.product = std::filesystem::path(options.input).stem().string();
  information.unit = unit;
  information.uncertainty = resolution.xi;
  const bool is_written = write_results(options, mesh, surfaces, information, report);
  return is_written ? exit_code(code) : FAILURE;
}

Exit_code convert_case(const Options& options)
{
  Report report;
  SC::Conversion_case<K> input;
  std::string message;
  if(!CGAL::IO::read_case(options.input, input, message))
    return stop(options, report, SC::Error_code::INVALID_BOUNDARY_ASSOCIATION, message);
  return convert_and_write(options, input.mesh, input.unit, report,
    [&input](std::vector<Surface>& surfaces, Report& r, const auto& np)
    {
      return SC::convert_to_T_NURCC(input.mesh, input.halfedge_curve_map(), input.traits, surfaces,
                                    r, np.vertex_is_constrained_map(input.vertex_is_corner_map()));
    });
}

Exit_code convert_bare_mesh(const Options& options)
{
  Report report;
  Mesh mesh;
  const Mesh_defect defect = read_mesh(options.input, mesh, report.warnings);
  if(defect.code != SC::Error_code::OK)
    return stop(options, report, defect.code, defect.message);
  if(CGAL::is_closed(mesh))
    return convert_and_write(options, mesh, "mm", report,
      [&mesh](std::vector<Surface>& surfaces, Report& r, const auto& np)
      { return SC::convert_to_T_NURCC(mesh, surfaces, r, np); });

  typedef SC::NURBS_curve_traits_3<K> Curve_traits;
  typedef SC::Curve_segment<Curve_traits> Segment;
  const Curve_traits traits;
  auto curves = mesh.add_property_map<Mesh::Halfedge_index, Segment>("h:curve").first;
  std::string message;
  const SC::Error_code code = SC::interpolate_boundary_curves(mesh, traits, curves, message);
  if(code != SC::Error_code::OK)
    return stop(options, report, code, message);
  return convert_and_write(options, mesh, "mm", report,
    [&mesh, &curves, &traits](std::vector<Surface>& surfaces, Report& r, const auto& np)
    { return SC::convert_to_T_NURCC(mesh, curves, traits, surfaces, r, np); });
}

Exit_code run(const Options& options)
{
  Report report;
  if(!options.stitched.empty())
    return stop(options, report, SC::Error_code::INVALID_PARAMETER,
                "--stitched is not available in this build: it needs Open CASCADE");
  const std::string error = prepare_output(options);
  if(!error.empty())
    return stop(options, report, SC::Error_code::INVALID_PARAMETER, error);
  if(is_mesh_file(options.input))
    return convert_bare_mesh(options);
  if(std::filesystem::is_regular_file(options.input)
     && lower_case_extension(options.input) != ".json")
    return stop(options, report, SC::Error_code::EMPTY_MESH,
                options.input + " is neither a case nor an OFF, PLY, OBJ, or STL file");
  return convert_case(options);
}

int main(int argc, char* argv[])
{
  Options options;
  const std::string error
    = parse_options(std::vector<std::string>(argv + 1, argv + argc), options);
  if(options.asks_for_help)
  {
    std::printf("%s", usage());
    return SUCCESS;
  }
  if(!error.empty())
  {
    std::fprintf(stderr, "convert_case: %s (--help shows the options)\n", error.c_str());
    return BAD_INPUT;
  }
  try
  {
    return run(options);
  }
  catch(const std::exception& exception) // for instance, not enough memory
  {
    std::fprintf(stderr, "convert_case: %s\n", exception.what());
    return FAILURE;
  }
}
