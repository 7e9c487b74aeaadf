// Writes the files that convert_case was asked for.
#ifndef CONVERT_CASE_WRITE_RESULTS_H
#define CONVERT_CASE_WRITE_RESULTS_H

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/JSON_report.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/STEP.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/VTU.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/conversion_history.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/surface_pictures.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_NURBS_faces.h>
#include <CGAL/Surface_mesh_spline_conversion/find_boundary_vertices.h>

#include <CGAL/Real_timer.h>
#include <CGAL/T_NURCC_surface_3.h>

#include "Options.h"
#include "brep.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#ifndef _WIN32
#include <sys/resource.h>
#endif

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef SC::Conversion_report Report;

// The largest resident memory of this process so far, in bytes; 0 if unknown.
inline std::size_t peak_memory()
{
#ifdef _WIN32
  return 0;
#else
  rusage usage;
  if(getrusage(RUSAGE_SELF, &usage) != 0)
    return 0;
#ifdef __APPLE__
  return static_cast<std::size_t>(usage.ru_maxrss);
#else
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
#endif
#endif
}

// Creates the folders of the output files; returns what is wrong with them, or nothing.
inline std::string prepare_output(const Options& options)
{
  namespace fs = std::filesystem;
  std::vector<fs::path> folders = {options.pictures};
  for(const std::string& file
      : {options.output, options.report, options.history, options.vtk, options.stitched})
    folders.push_back(fs::path(file).parent_path());
  for(const fs::path& folder : folders)
  {
    std::error_code error;
    if(!folder.empty() && !fs::is_directory(folder, error)
       && !fs::create_directories(folder, error))
      return "the folder " + folder.string() + " cannot be created";
  }
  return std::string();
}

// Tells the user if a file could not be written.
inline bool check(bool is_written, const std::string& filename)
{
  if(!is_written)
    std::fprintf(stderr, "convert_case: %s cannot be written\n", filename.c_str());
  return is_written;
}

inline bool write_report(const Options& options, Report& report)
{
  report.peak_memory_bytes = peak_memory();
  return options.report.empty()
      || check(CGAL::IO::write_JSON(options.report, report), options.report);
}

// writes the table and the chart of the iterations, or the chart alone if its name was given
inline bool write_history(const Options& options, const Report& report)
{
  if(options.history.empty())
    return true;
  const std::filesystem::path path(options.history);
  const std::string chart = std::filesystem::path(path).replace_extension(".svg").string();
  const bool is_table_written
    = path.extension() == ".svg"
   || check(CGAL::IO::write_history_CSV(options.history, report), options.history);
  return check(CGAL::IO::write_history_SVG(chart, report), chart) && is_table_written;
}

// Adds the faces of `part` to `whole`.
template <typename Shell>
void append(const Shell& part, Shell& whole)
{
  const std::size_t first_vertex = whole.number_of_vertices();
  const std::size_t first_edge = whole.number_of_edges();
  for(std::size_t v = 0; v < part.number_of_vertices(); ++v)
    whole.add_vertex(part.point(v));
  for(std::size_t e = 0; e < part.number_of_edges(); ++e)
  {
    auto edge = part.edge(e);
    edge.source += first_vertex;
    edge.target += first_vertex;
    whole.add_edge(edge);
  }
  for(std::size_t f = 0; f < part.number_of_faces(); ++f)
  {
    auto face = part.face(f);
    for(auto& oriented_edge : face.loop)
      oriented_edge.edge += first_edge;
    whole.add_face(face);
  }
}

// Stitches the faces with the residual model; returns `true` if there was nothing to do, or the
// result is written.
template <typename K>
bool write_stitched(const Options& options, const SC::NURBS_shell_3<K>& shell,
                    const std::string& residual, const std::string& unit, double closeness,
                    Report& report)
{
  if(options.stitched.empty())
    return true;
  CGAL::Real_timer timer;
  timer.start();
  const std::string error = stitch_and_write(
    shell, {residual, options.stitched, unit, 2 * closeness, options.stitching_seconds},
    report.stitching);
  report.add_time("stitch", timer.time());
  if(!error.empty())
  {
    std::fprintf(stderr, "convert_case: %s\n", error.c_str());
    report.warnings.push_back(error);
    return false;
  }
  const std::string warning = stitching_warning(report.stitching);
  if(!warning.empty())
  {
    std::fprintf(stderr, "convert_case: warning: %s\n", warning.c_str());
    report.warnings.push_back(warning);
  }
  return true;
}

// Writes the faces of all surfaces to the STEP file and the VTK file, and the stitched model.
template <typename Network, typename K>
bool write_faces(const Options& options, const Network& network,
                 const std::vector<CGAL::T_NURCC_surface_3<K> >& surfaces,
                 const SC::STEP_information& information, const std::string& residual,
                 Report& report)
{
  CGAL::Real_timer timer;
  timer.start();
  SC::NURBS_shell_3<K> shell;
  // a surface may have missed the tolerance
  const double closeness
    = (std::max)(report.boundary_tolerance, 2 * report.boundary.max_deviation);
  for(const CGAL::T_NURCC_surface_3<K>& surface : surfaces)
  {
    SC::NURBS_shell_3<K> part;
    SC::extract_NURBS_faces(surface, part,
                            CGAL::parameters::interior_tolerance(report.interior_tolerance)
                              .do_merge_patches(options.do_merge)
                              .boundary_vertices(SC::find_boundary_vertices(surface, network,
                                                                            closeness)));
    append(part, shell);
  }
  report.counts.nurbs_faces = shell.number_of_faces();
  bool is_written
    = options.output.empty()
   || check(CGAL::IO::write_STEP(options.output, shell, information), options.output);
  if(!options.vtk.empty())
    is_written = check(CGAL::IO::write_VTU(options.vtk, shell), options.vtk) && is_written;
  report.add_time("export", timer.time());
  // stitching may take long: what is known should be on the disk before
  is_written = write_report(options, report) && is_written;
  return write_stitched(options, shell, residual, information.unit, closeness, report)
      && is_written;
}

// Writes all files; returns `true` if every one is written.
template <typename Network, typename K>
bool write_results(const Options& options, const Network& network,
                   const std::vector<CGAL::T_NURCC_surface_3<K> >& surfaces,
                   const SC::STEP_information& information, const std::string& residual,
                   Report& report)
{
  bool is_written = true;
  if(!surfaces.empty())
  {
    is_written = write_faces(options, network, surfaces, information, residual, report);
    if(!options.pictures.empty())
      is_written = check(CGAL::IO::write_pictures(options.pictures, surfaces, network.triangle_mesh(),
                                                report),
                         options.pictures) && is_written;
  }
  is_written = write_history(options, report) && is_written;
  return write_report(options, report) && is_written;
}

#endif // CONVERT_CASE_WRITE_RESULTS_H
