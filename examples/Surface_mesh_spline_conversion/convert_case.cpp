// The command line tool: converts a case (a mesh with boundary curves) or a bare mesh, and writes
// the surface, a report, and pictures. Run it with --help for the options.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/T_NURCC_surface_3.h>

#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/convert_to_T_NURCC.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/keep_freed_memory.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>

#include "convert_case/Options.h"
#include "convert_case/Progress_visitor.h"
#include "convert_case/Thread_limit.h"
#include "convert_case/brep.h"
#include "convert_case/mesh_reader.h"
#include "convert_case/resolution.h"
#include "convert_case/write_results.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

typedef CGAL::Simple_cartesian<double> K;
typedef SC::Conversion_case<K> Case;
typedef CGAL::T_NURCC_surface_3<K> Surface;
typedef SC::Boundary_curve_network_3<Case::Triangle_mesh, Case::Curve_traits> Network;

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

// Reads a case folder or its case.json.
Mesh_defect read_case(const std::string& path, Case& input)
{
  std::string message;
  if(std::filesystem::is_regular_file(path) && lower_case_extension(path) != ".json")
    return {SC::Error_code::EMPTY_MESH,
            path + " is neither a case nor an OFF, PLY, OBJ, or STL file"};
  if(!CGAL::IO::read_case(path, input, message))
    return {SC::Error_code::INVALID_BOUNDARY_ASSOCIATION, message};
  return {SC::Error_code::OK, message};
}

// Reads a mesh file. An open mesh gets smooth curves through its boundary vertices.
Mesh_defect read_bare_mesh(const std::string& filename, Case& input,
                           std::vector<std::string>& warnings)
{
  typedef SC::NURBS_curve_traits_3<K> Curve_traits;
  Mesh_defect defect = read_mesh(filename, input.mesh, warnings);
  if(defect.code != SC::Error_code::OK)
    return defect;
  Case::Triangle_mesh& mesh = input.mesh;
  auto curves = mesh.add_property_map<CGAL::SM_Halfedge_index, SC::Curve_segment<Curve_traits> >(
    "h:curve").first;
  defect.code = SC::interpolate_boundary_curves(mesh, Curve_traits(), curves, defect.message);
  // one type of curves for all inputs: the conversion is compiled once
  for(const CGAL::SM_Halfedge_index h : mesh.halfedges())
  {
    input.segments.push_back({Case::Curve_3(curves[h].curve), curves[h].first, curves[h].second});
    if(!input.segments.back().is_empty()
       && (input.curves.empty() || !(input.curves.back() == input.segments.back().curve)))
      input.curves.push_back(input.segments.back().curve);
  }
  input.corners.assign(mesh.number_of_vertices(), false);
  input.unit = "mm";
  return defect;
}

// Reads a mesh file, and finds its curves among the free edges of a residual model.
Mesh_defect read_mesh_with_residual(const Options& options, Case& input,
                                    std::vector<std::string>& warnings)
{
  Mesh_defect defect = read_mesh(options.input, input.mesh, warnings);
  if(defect.code != SC::Error_code::OK)
    return defect;
  std::vector<Function_segment> segments;
  input.unit = "mm";
  input.residual_file = options.residual;
  defect.message = associate_with_residual(input.mesh, options.residual, segments, input.corners);
  if(!defect.message.empty())
    return {SC::Error_code::INVALID_BOUNDARY_ASSOCIATION, defect.message};
  for(const Function_segment& s : segments)
  {
    input.segments.push_back({Case::Curve_3(s.curve), s.first, s.second});
    if(!s.is_empty() && std::find(input.curves.begin(), input.curves.end(), Case::Curve_3(s.curve))
                          == input.curves.end())
      input.curves.push_back(s.curve);
  }
  return defect;
}

// Tells if files are asked for in a unit of the case that is not known.
Mesh_defect check_unit(const Options& options, const Case& input)
{
  const bool needs_unit
    = !options.output.empty() || !options.stitched.empty() || options.is_tangent;
  if(!needs_unit || SC::internal::STEP_writer<K>::is_unit(input.unit))
    return {SC::Error_code::OK, std::string()};
  return {SC::Error_code::INVALID_PARAMETER,
          "the unit '" + input.unit + "' of the case is none of mm, cm, m, um, and in"};
}

// Reads whatever the options name.
Mesh_defect read_input(const Options& options, Case& input, std::vector<std::string>& warnings)
{
  const bool has_residual = !options.residual.empty();
  if((has_residual || options.is_tangent || !options.stitched.empty()) && !has_open_cascade)
    return {SC::Error_code::INVALID_PARAMETER, "--stitched, --residual, and --tangent are not "
            "available in this build: they need Open CASCADE"};
  if(is_mesh_file(options.input))
  {
    if(has_residual)
      return read_mesh_with_residual(options, input, warnings);
    if(!options.stitched.empty())
      return {SC::Error_code::INVALID_PARAMETER, "--stitched needs --residual if there is no case"};
    return read_bare_mesh(options.input, input, warnings);
  }
  const Mesh_defect defect = read_case(options.input, input);
  if(has_residual)
    input.residual_file = options.residual;
  if(defect.code == SC::Error_code::OK && !options.stitched.empty() && input.residual_file.empty())
    return {SC::Error_code::INVALID_PARAMETER,
            "--stitched: the case has no residual model; --residual can name one"};
  return defect.code == SC::Error_code::OK ? check_unit(options, input) : defect;
}

// The library tells the place of the largest deviation by chain and arc length; the report is to
// name the curve of the case and its parameter.
void name_worst_curve(const Case& input, const Network& network, Report::Boundary& boundary)
{
  if(network.error() != SC::Error_code::OK || boundary.worst_curve >= network.number_of_chains())
    return;
  const auto place = network.locate(boundary.worst_curve, boundary.worst_parameter);
  for(std::size_t i = 0; i < input.curves.size(); ++i)
    if(input.curves[i] == place.curve)
      boundary.worst_curve = i;
  boundary.worst_parameter = place.parameter;
}

// The normals of the residual model along the curves of the case; none if they are not asked for.
typedef std::function<K::Vector_3(const Case::Curve_3&, const K::FT&)> Curve_normals;

std::string read_curve_normals(const Options& options, const Case& input, Curve_normals& normals)
{
  if(!options.is_tangent)
    return std::string();
  if(input.residual_file.empty())
    return "--tangent needs a residual model";
  Normal_function normal;
  const std::string error = read_normals(input.residual_file, input.mesh, input.unit, normal);
  const auto point = input.traits.construct_point_on_curve_3_object();
  const auto derivative = input.traits.construct_derivative_on_curve_3_object();
  normals = [normal, point, derivative](const Case::Curve_3& curve, const K::FT& t)
  { return normal(point(curve, t), derivative(curve, t, 1)); };
  return error;
}

// Converts, and writes whatever came out.
Exit_code convert_and_write(const Options& options, const Case& input,
                            const Curve_normals& normals,
                            const std::vector<std::string>& warnings)
{
  const Resolution resolution = find_resolution(options, input.mesh);
  Progress_visitor visitor(options.is_quiet, number_of_stages(input.mesh));
  std::vector<Surface> surfaces;
  Report report;
  const SC::Error_code code = SC::convert_to_T_NURCC(
    input.mesh, input.halfedge_curve_map(), input.traits, surfaces, report,
    CGAL::parameters::boundary_tolerance(resolution.xi)
      .interior_tolerance(resolution.delta)
      .quad_size_map(resolution.quad_size)
      .error_metric(resolution.error_metric)
      .maximum_number_of_patches(resolution.maximum_number_of_patches)
      .do_coarsen_patches(options.do_coarsen)
      .do_fair_interior(options.do_fair)
      .do_certify_interior(options.do_certify)
      .use_smooth_target(options.has_smooth_target)
      .use_caps(options.has_caps)
      .boundary_tangency(normals)
      .vertex_is_constrained_map(input.vertex_is_corner_map())
      .visitor(std::ref(visitor)));
  const Network network(input.mesh, input.halfedge_curve_map(), input.traits,
                        CGAL::parameters::vertex_is_constrained_map(input.vertex_is_corner_map()));
  name_worst_curve(input, network, report.boundary);
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
  information.unit = input.unit;
  information.uncertainty = resolution.xi;
  const bool is_written = write_results(options, network, surfaces, information,
                                        input.residual_file, report);
  return is_written ? exit_code(code) : FAILURE;
}

Exit_code run(const Options& options)
{
  Report report;
  const std::string error = prepare_output(options);
  if(!error.empty())
    return stop(options, report, SC::Error_code::INVALID_PARAMETER, error);
  Case input;
  const Mesh_defect defect = read_input(options, input, report.warnings);
  if(defect.code != SC::Error_code::OK)
    return stop(options, report, defect.code, defect.message);
  Curve_normals normals;
  const std::string normal_error = read_curve_normals(options, input, normals);
  if(!normal_error.empty())
    return stop(options, report, SC::Error_code::INVALID_PARAMETER, normal_error);
  return convert_and_write(options, input, normals, report.warnings);
}

int main(int argc, char* argv[])
{
  SC::internal::keep_freed_memory();
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
    const Thread_limit limit(options.threads);
    return run(options);
  }
  catch(const std::exception& exception) // for instance, not enough memory
  {
    std::fprintf(stderr, "convert_case: %s\n", exception.what());
    return FAILURE;
  }
}
