// Converts a paraboloid over a disc: its boundary edges are chords of a circle, the boundary of the
// surface is the circle.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/Function_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/convert_to_T_NURCC.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef CGAL::Surface_mesh<K::Point_3> Mesh;
typedef SC::Function_curve_traits_3<K> Traits;
typedef SC::Curve_segment<Traits> Segment;

// rings of triangles around the origin
Mesh make_paraboloid(std::size_t rings, std::size_t sectors)
{
  const double step = 2 * CGAL_PI / sectors;
  Mesh mesh;
  const Mesh::Vertex_index center = mesh.add_vertex(K::Point_3(0, 0, 0.5));
  for(std::size_t i = 1; i <= rings; ++i)
    for(std::size_t j = 0; j < sectors; ++j)
    {
      const double r = double(i) / rings;
      mesh.add_vertex(K::Point_3(r * std::cos(j * step), r * std::sin(j * step), (1 - r * r) / 2));
    }
  const auto vertex = [sectors](std::size_t i, std::size_t j)
  { return Mesh::Vertex_index(1 + (i - 1) * sectors + j % sectors); };
  for(std::size_t j = 0; j < sectors; ++j)
  {
    mesh.add_face(center, vertex(1, j), vertex(1, j + 1));
    for(std::size_t i = 1; i < rings; ++i)
    {
      mesh.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      mesh.add_face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
  return mesh;
}

int main()
{
  Mesh mesh = make_paraboloid(8, 32);
  const Traits::Curve_3 circle(
    [](double t) { return K::Point_3(std::cos(t), std::sin(t), 0); },
    [](double t, int order) // each derivative turns by a quarter
    {
      const double turned = t + order * CGAL_PI / 2;
      return K::Vector_3(std::cos(turned), std::sin(turned), 0);
    });

  auto curves = mesh.add_property_map<Mesh::Halfedge_index, Segment>("h:curve").first;
  for(const Mesh::Halfedge_index h : mesh.halfedges())
    if(mesh.is_border(mesh.opposite(h)))
    {
      const K::Point_3 p = mesh.point(mesh.source(h)), q = mesh.point(mesh.target(h));
      const double first = std::atan2(p.y(), p.x()), second = std::atan2(q.y(), q.x());
      curves[h] = Segment{circle, first, second < first ? second + 2 * CGAL_PI : second};
    }

  std::vector<CGAL::T_NURCC_surface_3<K> > surfaces;
  SC::Conversion_report report;
  const SC::Error_code code = SC::convert_to_T_NURCC(
    mesh, curves, Traits(), surfaces, report,
    CGAL::parameters::boundary_tolerance(1e-5).interior_tolerance(0.02).quad_size_map(0.3));
  std::cout << SC::error_message(code) << ": " << report.counts.patches
            << " patches, distance from the circle " << report.boundary.max_deviation
            << ", from the mesh " << report.interior.max_deviation << std::endl;
  return code == SC::Error_code::OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
