// Curves of a mesh among the free edges of a B-Rep: the circle of a cylinder, which is one closed
// edge with a seam, and the four edges of a window.
#include "brep_models.h"

#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/BRep.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/associate_boundary_with_BRep.h>
#include <CGAL/config.h>
#include <CGAL/number_type_config.h>

#include <cassert>
#include <iostream>
#include <string>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;
typedef CGAL::Surface_mesh<Point_3> Mesh;
typedef SMSC::Open_cascade_curve_traits_3<K> Traits;
typedef SMSC::Curve_segment<Traits> Segment;
typedef Mesh::Property_map<Mesh::Halfedge_index, Segment> Segment_map;

// a fan round a center, which is vertex 0
Mesh fan(const Point_3& center, const std::vector<Point_3>& points)
{
  Mesh mesh;
  mesh.add_vertex(center);
  for(const Point_3& p : points)
    mesh.add_vertex(p);
  const unsigned int n = static_cast<unsigned int>(points.size());
  for(unsigned int i = 0; i < n; ++i)
    mesh.add_face(Mesh::Vertex_index(0), Mesh::Vertex_index(i + 1),
                  Mesh::Vertex_index((i + 1) % n + 1));
  return mesh;
}

SMSC::Error_code associate(Mesh& mesh, const TopoDS_Shape& shape, Segment_map& segments,
                           std::string& message)
{
  segments = mesh.add_property_map<Mesh::Halfedge_index, Segment>("h:segment").first;
  return SMSC::associate_boundary_with_BRep(mesh, shape, segments, message);
}

// points on the circle from an angle on, in either direction
std::vector<Point_3> circle(int n, double first, double direction)
{
  std::vector<Point_3> points;
  for(int i = 0; i < n; ++i)
  {
    const double angle = first + direction * 2 * CGAL_PI * i / n;
    points.emplace_back(20 * std::cos(angle), 20 * std::sin(angle), 30);
  }
  return points;
}

void check_circle(int n, double first, double direction)
{
  Mesh mesh = fan(Point_3(0, 0, 30), circle(n, first, direction));
  Segment_map segments;
  std::string message;
  assert(associate(mesh, open_cylinder(), segments, message) == SMSC::Error_code::OK);
  const Traits traits;
  double sum = 0;
  for(const Mesh::Halfedge_index h : mesh.halfedges())
  {
    const Segment& s = segments[h];
    if(s.is_empty())
      continue;
    const auto point = traits.construct_point_on_curve_3_object();
    assert(CGAL::squared_distance(point(s.curve, s.first), mesh.point(mesh.source(h))) < 1e-24);
    assert(CGAL::squared_distance(point(s.curve, s.second), mesh.point(mesh.target(h))) < 1e-24);
    sum += std::abs(s.second - s.first);
    // the normal of the cylinder points away from its axis
    const K::Vector_3 normal = traits.construct_normal_on_curve_3_object()(s.curve, s.first);
    const K::Vector_3 radius = (mesh.point(mesh.source(h)) - Point_3(0, 0, 30)) / 20;
    assert((normal - radius).squared_length() < 1e-24);
    // the derivative of a circle by its angle
    const K::Vector_3 d2
      = traits.construct_derivative_on_curve_3_object()(s.curve, s.first, 2);
    assert((d2 + 20 * radius).squared_length() < 1e-20);
  }
  assert(std::abs(sum - 2 * CGAL_PI) < 1e-12);
  const SMSC::Boundary_curve_network_3<Mesh, Traits> network(mesh, segments, traits);
  assert(network.error() == SMSC::Error_code::OK);
  assert(network.number_of_chains() == 1 && network.is_closed(0));
  assert(std::abs(network.length(0) - 40 * CGAL_PI) < 1e-9);
}

std::vector<Point_3> window(bool has_corners)
{
  std::vector<Point_3> points;
  const std::vector<Point_3> corners
    = {Point_3(20, 15, 40), Point_3(80, 15, 40), Point_3(80, 45, 40), Point_3(20, 45, 40)};
  for(std::size_t i = 0; i < 4; ++i)
    for(int k = (has_corners || i != 2) ? 0 : 1; k < 3; ++k)
      points.push_back(corners[i] + k / 3. * (corners[(i + 1) % 4] - corners[i]));
  return points;
}

void check_window()
{
  Mesh mesh = fan(Point_3(50, 30, 46), window(true));
  Segment_map segments;
  std::string message;
  assert(associate(mesh, box_with_window(), segments, message) == SMSC::Error_code::OK);
  const SMSC::Boundary_curve_network_3<Mesh, Traits> network(mesh, segments, Traits());
  assert(network.error() == SMSC::Error_code::OK);
  assert(network.number_of_loops() == 1 && network.number_of_chains() == 4);
  for(std::size_t c = 0; c < 4; ++c)
    assert(std::abs(network.length(c) - (c % 2 == 0 ? 60 : 30)) < 1e-9
           || std::abs(network.length(c) - (c % 2 == 0 ? 30 : 60)) < 1e-9);
}

// Vertices next to the ends of edges, as they are in files of single precision: there the curves end,
// and meet. The boundary of the residual model is one closed spline with a corner at its seam.
void check_inexact_mesh(const Mesh& exact, const TopoDS_Shape& shape, std::size_t corners)
{
  const double noise = 3e-7 * CGAL::to_double(SMSC::smallest_enclosing_sphere_diameter(exact));
  CGAL::Random random(7);
  for(int run = 0; run < 10; ++run)
  {
    Mesh mesh = exact;
    for(Point_3& p : mesh.points())
      p = p + K::Vector_3(random.get_double(-noise, noise), random.get_double(-noise, noise),
                          random.get_double(-noise, noise));
    Segment_map segments;
    std::string message;
    assert(associate(mesh, shape, segments, message) == SMSC::Error_code::OK);
    const Traits traits;
    const auto point = traits.construct_point_on_curve_3_object();
    for(const Mesh::Halfedge_index h : mesh.halfedges())
    {
      if(!mesh.is_border(h))
        continue;
      const Segment& next = segments[mesh.opposite(h)];
      const Segment& s = segments[mesh.opposite(mesh.next(h))];
      assert(CGAL::squared_distance(point(s.curve, s.second), point(next.curve, next.first))
             < 1e-24);
    }
    const SMSC::Boundary_curve_network_3<Mesh, Traits> network(mesh, segments, traits);
    assert(network.error() == SMSC::Error_code::OK);
    assert(network.number_of_chains() == corners);
  }
}

void check_inexact_meshes()
{
  check_inexact_mesh(fan(Point_3(0, 0, 30), circle(12, 0, 1)), open_cylinder(), 1);
  check_inexact_mesh(fan(Point_3(50, 30, 46), window(true)), box_with_window(), 4);
  SMSC::Conversion_case<K> input;
  TopoDS_Shape shape;
  std::string message;
  const std::string folder = CGAL::data_file_path("cases/d2_square_corner");
  assert(CGAL::IO::read_case(folder, input, message));
  assert(CGAL::IO::read_BRep(folder + "/residual.step", shape, message));
  check_inexact_mesh(input.mesh, shape, 1);
}

// Errors name the vertices.
void check_errors()
{
  Segment_map segments;
  std::string message;
  Mesh without_corner = fan(Point_3(50, 30, 46), window(false));
  assert(associate(without_corner, box_with_window(), segments, message)
         == SMSC::Error_code::INVALID_BOUNDARY_ASSOCIATION);
  std::cout << message << std::endl;
  assert(message.find("vertices 6 and 7") != std::string::npos);

  std::vector<Point_3> points = window(true);
  points[4] = points[4] + K::Vector_3(0.25, 0, 0);
  Mesh moved = fan(Point_3(50, 30, 46), points);
  message.clear();
  assert(associate(moved, box_with_window(), segments, message)
         == SMSC::Error_code::INVALID_BOUNDARY_ASSOCIATION);
  std::cout << message << std::endl;
  assert(message.find("vertex 5 is 0.25 away") != std::string::npos);

  // a closed model has no free edges
  message.clear();
  assert(associate(moved, BRepPrimAPI_MakeBox(1, 1, 1).Shape(), segments, message)
         == SMSC::Error_code::INVALID_BOUNDARY_ASSOCIATION);
  std::cout << message << std::endl;
  assert(message.find("no free edges") != std::string::npos);
}

int main()
{
  check_circle(12, 0, 1);
  check_circle(12, 0, -1);
  check_circle(3, 0, 1);
  check_circle(7, 0.3, 1); // a periodic curve needs no vertex at its seam
  check_circle(7, 0.3, -1);
  check_window();
  check_inexact_meshes();
  check_errors();
  return 0;
}
