// The stages up to the quad layout, one by one, for a case with boundary curves.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/OBJ_quad_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_integer_grid_map.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_quad_layout.h>

#include <cstdlib>
#include <iostream>
#include <string>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef SC::Conversion_case<K> Case;
typedef SC::Boundary_curve_network_3<Case::Triangle_mesh, Case::Curve_traits> Network;

int main(int argc, char* argv[])
{
  const std::string path
    = (argc > 1) ? argv[1] : CGAL::data_file_path("cases/d2_square_corner/case.json");
  Case input;
  std::string message;
  if(!CGAL::IO::read_case(path, input, message))
  {
    std::cerr << message << std::endl;
    return EXIT_FAILURE;
  }
  const Network network(input.mesh, input.halfedge_curve_map(), input.traits);
  if(network.error() != SC::Error_code::OK)
  {
    std::cerr << network.message() << std::endl;
    return EXIT_FAILURE;
  }

  SC::Cross_field field;
  SC::Integer_grid_map map;
  SC::Quad_layout<K> layout;
  if(SC::compute_cross_field(input.mesh, network, field) != SC::Error_code::OK
     || SC::compute_integer_grid_map(field, map) != SC::Error_code::OK
     || SC::extract_quad_layout(map, input.mesh, network, layout) != SC::Error_code::OK)
  {
    std::cerr << "no quad layout was found" << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << layout.number_of_quads() << " quads, " << layout.number_of_vertices()
            << " vertices\n";
  const SC::Quad_layout<K>::Location center = layout.inverse_map()(0, 0.5, 0.5);
  std::cout << "the centre of quad 0 is the point " << center.point << " in face " << center.face
            << std::endl;
  return CGAL::IO::write_OBJ("quad_layout.obj", layout) ? EXIT_SUCCESS : EXIT_FAILURE;
}
