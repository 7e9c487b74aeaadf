// The part of convert_case that is compiled only if Open CASCADE is found.

#include "brep.h"

#include <CGAL/Surface_mesh_spline_conversion/Free_edge_normals_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Open_cascade_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/associate_boundary_with_BRep.h>
#include <CGAL/Surface_mesh_spline_conversion/smallest_enclosing_sphere_diameter.h>
#include <CGAL/Surface_mesh_spline_conversion/stitch_with_BRep.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/BRep.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/run_in_child_process.h>

#include <boost/property_map/property_map.hpp>

#include <Standard_Failure.hxx>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <utility>

namespace {

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef SC::Stitching_report Report;
typedef SC::Open_cascade_curve_traits_3<K>::Curve_3 Kernel_curve;
typedef SC::Curve_segment<SC::Open_cascade_curve_traits_3<K> > Kernel_segment;
typedef SC::Function_curve_traits_3<K>::Curve_3 Function_curve;

// the length of a unit in millimetres
double millimetres(const std::string& unit)
{
  const std::map<std::string, double> lengths
    = {{"mm", 1}, {"cm", 10}, {"m", 1000}, {"um", 1e-3}, {"in", 25.4}};
  const auto length = lengths.find(unit);
  return (length == lengths.end()) ? 1 : length->second;
}

// calls `f` for all figures of a report that are numbers
template <typename Figures, typename Function>
void for_each_figure(Figures& r, const Function& f)
{
  for(auto* n : {&r.solids, &r.shells, &r.faces, &r.edges, &r.vertices, &r.free_edges,
                 &r.unmatched_edges, &r.multiple_edges})
    f(*n);
  f(r.is_valid);
  for(auto* x : {&r.edge_distance, &r.edge_deviation, &r.edge_tolerance, &r.vertex_tolerance,
                 &r.residual_tolerance, &r.volume})
    f(*x);
}

// The bytes that the process of the stitching sends: figures, length of the name of the method,
// this name, and the message.
std::string packed(const Report& report, const std::string& message)
{
  std::string bytes;
  const auto append = [&bytes](const auto& value)
  { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for_each_figure(report, append);
  append(report.method.size());
  return bytes + report.method + message;
}

void unpack(const std::string& bytes, Report& report, std::string& message)
{
  std::size_t at = 0, length = 0;
  const auto take = [&bytes, &at](auto& value)
  {
    std::memcpy(&value, bytes.data() + at, sizeof value);
    at += sizeof value;
  };
  for_each_figure(report, take);
  take(length);
  report.method = bytes.substr(at, length);
  message = bytes.substr(at + length);
}

std::string stitch(const Brep_shell& shell, const Stitching_task& task, Report& report)
{
  const double scale = millimetres(task.unit);
  TopoDS_Shape residual, result;
  std::string message;
  if(!CGAL::IO::read_BRep(task.residual, residual, message))
    return message;
  SC::stitch_with_BRep(shell, residual, scale * task.tolerance, result, report, scale);
  if(!CGAL::IO::write_BRep(task.output, result, task.unit))
    return task.output + " cannot be written";
  return std::string();
}

// The conversion itself is compiled without Open CASCADE: it sees functions.
Function_curve function_curve(const Kernel_curve& curve)
{
  return Function_curve([curve](double t) { return curve.point(t); },
                        [curve](double t, int order) { return curve.derivative(t, order); });
}

std::string associate(const Brep_mesh& mesh, const std::string& residual,
                      std::vector<Function_segment>& segments)
{
  TopoDS_Shape shape;
  std::string message;
  if(!CGAL::IO::read_BRep(residual, shape, message))
    return message;
  std::vector<Kernel_segment> found(mesh.number_of_halfedges());
  if(SC::associate_boundary_with_BRep(
       mesh, shape, boost::make_iterator_property_map(found.begin(),
                                                      get(boost::halfedge_index, mesh)),
       message) != SC::Error_code::OK)
    return message;
  std::vector<std::pair<Kernel_curve, Function_curve> > curves;
  for(std::size_t h = 0; h < found.size(); ++h)
  {
    const Kernel_segment& s = found[h];
    if(s.is_empty())
      continue;
    auto known = std::find_if(curves.begin(), curves.end(),
                              [&s](const auto& pair) { return pair.first == s.curve; });
    if(known == curves.end())
      known = curves.insert(curves.end(), {s.curve, function_curve(s.curve)});
    segments[h] = {known->second, s.first, s.second};
  }
  return std::string();
}

// Normals of edges that do not bound the mesh would be without meaning.
std::string find_boundary_vertex_without_edge(const Brep_mesh& mesh, double scale,
                                              const SC::Free_edge_normals_3<K>& normals)
{
  const double largest_relative_distance = 1e-3;
  const double largest = largest_relative_distance * SC::smallest_enclosing_sphere_diameter(mesh);
  for(const Brep_mesh::Vertex_index v : mesh.vertices())
    if(mesh.is_border(v)
       && !(normals.distance(CGAL::ORIGIN + scale * (mesh.point(v) - CGAL::ORIGIN))
            <= scale * largest))
      return "--tangent: the residual model has no free edge at the boundary vertex "
             + std::to_string(v.idx());
  return std::string();
}

std::string failure_message(const Standard_Failure& failure)
{
  return std::string("Open CASCADE failed: ") + failure.GetMessageString();
}

} // namespace

std::string associate_with_residual(const Brep_mesh& mesh, const std::string& residual,
                                    std::vector<Function_segment>& segments,
                                    std::vector<char>& corners)
{
  segments.assign(mesh.number_of_halfedges(), Function_segment());
  corners.assign(mesh.number_of_vertices(), false);
  try
  {
    return associate(mesh, residual, segments);
  }
  catch(const Standard_Failure& failure)
  {
    return failure_message(failure);
  }
}

std::string read_normals(const std::string& residual, const Brep_mesh& mesh,
                         const std::string& unit, Normal_function& normal)
{
  try
  {
    TopoDS_Shape shape;
    std::string message;
    if(!CGAL::IO::read_BRep(residual, shape, message))
      return message;
    const double scale = millimetres(unit);
    const SC::Free_edge_normals_3<K> normals(shape);
    message = find_boundary_vertex_without_edge(mesh, scale, normals);
    if(!message.empty())
      return message;
    normal = [normals, scale](const K::Point_3& p, const K::Vector_3& tangent)
    { return normals(CGAL::ORIGIN + scale * (p - CGAL::ORIGIN), tangent); };
    return std::string();
  }
  catch(const Standard_Failure& failure)
  {
    return failure_message(failure);
  }
}

std::string stitch_and_write(const Brep_shell& shell, const Stitching_task& task, Report& report)
{
  std::string bytes, message;
  const SC::internal::Child_end end = SC::internal::run_in_child_process([&]
  {
    Report figures;
    try
    {
      const std::string error = stitch(shell, task, figures);
      return packed(figures, error);
    }
    catch(const Standard_Failure& failure)
    {
      return packed(figures, failure_message(failure));
    }
  }, static_cast<unsigned int>(task.seconds), bytes);
  switch(end)
  {
    case SC::internal::Child_end::NORMAL:
      unpack(bytes, report, message);
      return message;
    case SC::internal::Child_end::CRASHED:
      message = "stitching: Open CASCADE crashed";
      break;
    case SC::internal::Child_end::TIMED_OUT:
      message = "stitching: Open CASCADE did not end in " + std::to_string(task.seconds)
              + " seconds";
      break;
    case SC::internal::Child_end::NOT_STARTED:
      message = "stitching: no process could be started";
      break;
  }
  std::remove(task.output.c_str()); // it is incomplete, or of an earlier run
  return message + "; there is no stitched model, the surface itself is not affected";
}
