// What convert_case does with boundary representations, if Open CASCADE is there.
#ifndef CONVERT_CASE_BREP_H
#define CONVERT_CASE_BREP_H

#include <CGAL/Surface_mesh_spline_conversion/Curve_segment.h>
#include <CGAL/Surface_mesh_spline_conversion/Function_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Stitching_report.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

typedef CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> Brep_mesh;
typedef CGAL::Surface_mesh_spline_conversion::NURBS_shell_3<CGAL::Simple_cartesian<double> >
  Brep_shell;
typedef CGAL::Surface_mesh_spline_conversion::Curve_segment<
  CGAL::Surface_mesh_spline_conversion::Function_curve_traits_3<CGAL::Simple_cartesian<double> > >
  Function_segment;

// The normal of the face of a residual model at a point of a free edge with a given tangent.
typedef CGAL::Simple_cartesian<double> Brep_kernel;
typedef std::function<Brep_kernel::Vector_3(const Brep_kernel::Point_3&,
                                            const Brep_kernel::Vector_3&)> Normal_function;

struct Stitching_task
{
  std::string residual; // file of the B-Rep
  std::string output;   // file of the solid
  std::string unit;     // of the shell and of the output
  double tolerance;     // largest distance of what is joined, in this unit
  std::size_t seconds;  // when to give up
};

#ifdef CGAL_SMSC_USE_OPENCASCADE

constexpr bool has_open_cascade = true;

// Finds the curve of each halfedge of the boundary, and the corners, by the indices of the mesh.
// Returns what is wrong, or nothing.
std::string associate_with_residual(const Brep_mesh& mesh, const std::string& residual,
                                    std::vector<Function_segment>& segments,
                                    std::vector<char>& corners);

// Reads the normals along the free edges that bound a mesh in a unit; returns what is wrong, or
// nothing.
std::string read_normals(const std::string& residual, const Brep_mesh& mesh,
                         const std::string& unit, Normal_function& normal);

// Stitches in a process of its own, so that a crash or an endless loop of Open CASCADE only loses
// the output. Returns what prevented the output from being written, or nothing.
std::string stitch_and_write(const Brep_shell& shell, const Stitching_task& task,
                             CGAL::Surface_mesh_spline_conversion::Stitching_report& report);

#else

constexpr bool has_open_cascade = false;

inline std::string associate_with_residual(const Brep_mesh&, const std::string&,
                                           std::vector<Function_segment>&, std::vector<char>&)
{
  return "Open CASCADE is missing";
}

inline std::string read_normals(const std::string&, const Brep_mesh&, const std::string&,
                                Normal_function&)
{
  return "Open CASCADE is missing";
}

inline std::string stitch_and_write(const Brep_shell&, const Stitching_task&,
                                    CGAL::Surface_mesh_spline_conversion::Stitching_report&)
{
  return "Open CASCADE is missing";
}

#endif

// Returns what a user should know about a stitched model, or nothing.
inline std::string
stitching_warning(const CGAL::Surface_mesh_spline_conversion::Stitching_report& report)
{
  if(report.unmatched_edges > 0)
    return "stitching: " + std::to_string(report.unmatched_edges)
           + " boundary edges of the surface have no partner on the residual model";
  if(report.free_edges > 0)
    return "stitching: the result is not closed, it has " + std::to_string(report.free_edges)
           + " free edges; the residual model is open elsewhere";
  if(!report.is_valid)
    return "stitching: the checker of Open CASCADE finds a defect in the result";
  return std::string();
}

#endif // CONVERT_CASE_BREP_H
