// A half disc bounded by a line and an arc: associates the boundary edges with the curves, and
// prints what the network makes of it.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_traits_3.h>

#include <cstdlib>
#include <iostream>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef CGAL::Surface_mesh<K::Point_3> Mesh;
typedef SC::NURBS_curve_traits_3<K> Traits;
typedef SC::Curve_segment<Traits> Segment;

int main()
{
  const K::Point_3 origin(0, 0, 0);
  const Traits::Curve_3 arc = Traits::Curve_3::make_circular_arc(
    origin, K::Vector_3(1, 0, 0), K::Vector_3(0, 1, 0), 0, CGAL_PI);
  const Traits::Curve_3 line
    = Traits::Curve_3::make_line_segment(K::Point_3(-1, 0, 0), K::Point_3(1, 0, 0));

  // a fan of triangles about the centre, which is a boundary vertex, too
  Mesh mesh;
  const std::size_t n = 12;
  const Mesh::Vertex_index center = mesh.add_vertex(origin);
  std::vector<Mesh::Vertex_index> rim;
  const double step = CGAL_PI / n;
  for(std::size_t i = 0; i <= n; ++i)
    rim.push_back(mesh.add_vertex(arc.point(i * step)));
  for(std::size_t i = 0; i < n; ++i)
    mesh.add_face(center, rim[i], rim[i + 1]);

  // the key is the halfedge whose face lies in the mesh, the parameters are those at its ends
  auto curves = mesh.add_property_map<Mesh::Halfedge_index, Segment>("h:curve").first;
  for(std::size_t i = 0; i < n; ++i)
    curves[mesh.halfedge(rim[i], rim[i + 1])] = Segment{arc, i * step, (i + 1) * step};
  curves[mesh.halfedge(rim[n], center)] = Segment{line, 0, 0.5};
  curves[mesh.halfedge(center, rim[0])] = Segment{line, 0.5, 1};

  const SC::Boundary_curve_network_3<Mesh, Traits> network(mesh, curves, Traits());
  if(network.error() != SC::Error_code::OK)
  {
    std::cerr << network.message() << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << network.number_of_loops() << " loop, " << network.number_of_chains()
            << " chains between corners\n";
  for(std::size_t c = 0; c < network.number_of_chains(); ++c)
    std::cout << "chain " << c << ": " << network.chain_halfedges(c).size() << " edges, length "
              << network.length(c) << ", middle " << network.point(c, network.length(c) / 2)
              << '\n';
  return EXIT_SUCCESS;
}
