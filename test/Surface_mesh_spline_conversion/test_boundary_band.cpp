// The band along the boundary is that of all components: a component with tiny faces beside a coarse
// dome narrows the band of the dome, also so far that the curves leave the inner half of it.

#include "graph_mesh.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/convert_to_T_NURCC.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;
typedef CGAL::Simple_cartesian<double> K;
typedef K::Point_3 Point_3;
typedef CGAL::Surface_mesh<Point_3> Mesh;
typedef SMSC::NURBS_curve_traits_3<K> Curve_traits;
typedef CGAL::T_NURCC_surface_3<K> Surface;

// a steep paraboloid over a disk
Mesh dome(int sectors)
{
  constexpr int RINGS = 8;
  constexpr double RADIUS = 10, STEEPNESS = 0.06;
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v(1, mesh.add_vertex(Point_3(0, 0, 0)));
  for(int i = 1; i <= RINGS; ++i)
    for(int k = 0; k < sectors; ++k)
    {
      const double r = RADIUS * i / RINGS, angle = 2 * CGAL_PI * k / sectors;
      v.push_back(mesh.add_vertex(Point_3(r * std::cos(angle), r * std::sin(angle),
                                          -STEEPNESS * r * r)));
    }
  const auto vertex
    = [&v, sectors](int ring, int k) { return v[1 + sectors * (ring - 1) + k % sectors]; };
  for(int k = 0; k < sectors; ++k)
  {
    mesh.add_face(v[0], vertex(1, k), vertex(1, k + 1));
    for(int i = 1; i < RINGS; ++i)
    {
      mesh.add_face(vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1));
      mesh.add_face(vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1));
    }
  }
  return mesh;
}

Mesh dome_beside_fine_square(int sectors, int cells)
{
  Mesh mesh = dome(sectors);
  Mesh square = graph_mesh<Mesh>(4, cells, [](double, double) { return 0; });
  for(const auto v : square.vertices())
    square.point(v) = square.point(v) + K::Vector_3(15, 0, 0);
  mesh += square;
  return mesh;
}

double mean_edge_length(const Mesh& mesh)
{
  double sum = 0;
  for(const auto e : mesh.edges())
  {
    const auto h = mesh.halfedge(e);
    const double length
      = std::sqrt(CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
    sum += (mesh.is_border(e) ? 1 : 2) * length;
  }
  return sum / (3. * mesh.number_of_faces());
}

double distance_to_boundary(const Mesh& mesh, const Point_3& p)
{
  double nearest = std::numeric_limits<double>::infinity();
  for(const auto e : mesh.edges())
    if(mesh.is_border(e))
    {
      const auto h = mesh.halfedge(e);
      nearest = (std::min)(nearest, CGAL::squared_distance(p,
        K::Segment_3(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)))));
    }
  return std::sqrt(nearest);
}

double distance_to_faces(const Mesh& mesh, const Point_3& p)
{
  double nearest = std::numeric_limits<double>::infinity();
  for(const auto f : mesh.faces())
  {
    std::vector<Point_3> t;
    for(const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      t.push_back(mesh.point(v));
    nearest = (std::min)(nearest,
                         CGAL::squared_distance(p, K::Triangle_3(t[0], t[1], t[2])));
  }
  return std::sqrt(nearest);
}

// the largest distance from the mesh at samples farther than `band` from its boundary
double largest_distance(const Surface& surface, const Mesh& mesh, double band)
{
  constexpr int INTERVALS = 4;
  double result = 0;
  for(std::size_t i = 0; i < surface.number_of_patches(); ++i)
  {
    const auto o = surface.patch_origin(i);
    for(int b = 0; b <= INTERVALS; ++b)
      for(int a = 0; a <= INTERVALS; ++a)
      {
        const Point_3 p = surface.position(i, o.u0 + (o.u1 - o.u0) * a / INTERVALS,
                                           o.v0 + (o.v1 - o.v0) * b / INTERVALS);
        if(distance_to_boundary(mesh, p) > band)
          result = (std::max)(result, distance_to_faces(mesh, p));
      }
  }
  return result;
}

void test(int sectors, int cells)
{
  constexpr double DELTA = 0.04, QUAD_SIZE = 3;
  Mesh mesh = dome_beside_fine_square(sectors, cells);
  Curve_traits traits;
  auto curves = mesh.add_property_map<Mesh::Halfedge_index, SMSC::Curve_segment<Curve_traits> >(
    "h:curve").first;
  std::string message;
  assert(SMSC::interpolate_boundary_curves(mesh, traits, curves, message) == SMSC::Error_code::OK);
  std::vector<Surface> surfaces;
  SMSC::Conversion_report report;
  assert(SMSC::convert_to_T_NURCC(mesh, curves, traits, surfaces, report,
                                  CGAL::parameters::interior_tolerance(DELTA)
                                    .boundary_tolerance(DELTA / 100).quad_size_map(QUAD_SIZE))
         == SMSC::Error_code::OK);
  assert(surfaces.size() == 2);
  assert(largest_distance(surfaces[0], dome(sectors), 3 * mean_edge_length(mesh)) < DELTA);
}

int main()
{
  test(24, 40);
  test(12, 50);
  return EXIT_SUCCESS;
}
