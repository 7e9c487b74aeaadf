// From an open mesh without curves to a STEP file: smooth curves are laid through the boundary
// vertices, the faces of the surface share their edges.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/STEP.h>
#include <CGAL/Surface_mesh_spline_conversion/convert_to_T_NURCC.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_NURBS_faces.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef CGAL::Surface_mesh<K::Point_3> Mesh;
typedef SC::NURBS_curve_traits_3<K> Traits;

int main(int argc, char* argv[])
{
  const std::string filename
    = (argc > 1) ? argv[1] : CGAL::data_file_path("cases/d2_square_corner/mesh.off");
  Mesh mesh;
  if(!CGAL::IO::read_polygon_mesh(filename, mesh))
  {
    std::cerr << filename << " is not a mesh" << std::endl;
    return EXIT_FAILURE;
  }
  auto curves
    = mesh.add_property_map<Mesh::Halfedge_index, SC::Curve_segment<Traits> >("h:curve").first;
  std::vector<CGAL::T_NURCC_surface_3<K> > surfaces;
  SC::Conversion_report report;
  SC::Error_code code = SC::interpolate_boundary_curves(mesh, Traits(), curves, report.message);
  if(code == SC::Error_code::OK)
    code = SC::convert_to_T_NURCC(mesh, curves, Traits(), surfaces, report);
  if(code != SC::Error_code::OK)
  {
    std::cerr << SC::error_message(code) << ": " << report.message << std::endl;
    return EXIT_FAILURE;
  }
  SC::NURBS_shell_3<K> shell;
  for(const CGAL::T_NURCC_surface_3<K>& surface : surfaces)
    SC::extract_NURBS_faces(surface, shell);
  std::cout << shell.number_of_faces() << " faces in surface.step" << std::endl;
  return CGAL::IO::write_STEP("surface.step", shell) ? EXIT_SUCCESS : EXIT_FAILURE;
}
