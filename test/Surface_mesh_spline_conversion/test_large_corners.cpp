// The warning about corners of the boundary with an interior angle above a full turn, on ramps that
// wind about a corner, and the folds next to such a corner, which smaller quads do not avoid.

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/conversion/large_corners.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>
#include <CGAL/number_type_config.h>
#include <CGAL/property_map.h>

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef K::Point_3 Point;
typedef CGAL::Surface_mesh<Point> Mesh;
typedef SC::NURBS_curve_traits_3<K> Traits;

// A cone of rays from the origin, which rise while they turn by `angle`; it is straight along them.
Mesh ramp(double angle)
{
  const std::size_t rings = 6, steps = 40;
  std::vector<Point> points(1, CGAL::ORIGIN);
  std::vector<std::array<std::size_t, 3> > triangles;
  for(std::size_t r = 1; r <= rings; ++r)
    for(std::size_t s = 0; s <= steps; ++s)
    {
      const double a = angle * double(s) / double(steps);
      points.emplace_back(double(r) * std::cos(a), double(r) * std::sin(a), 0.05 * double(r) * a);
    }
  const auto index = [](std::size_t r, std::size_t s)
  {
    return r == 0 ? 0 : 1 + (r - 1) * (steps + 1) + s;
  };
  for(std::size_t r = 0; r < rings; ++r)
    for(std::size_t s = 0; s < steps; ++s)
    {
      triangles.push_back({{index(r, s), index(r + 1, s), index(r + 1, s + 1)}});
      if(r > 0)
        triangles.push_back({{index(r, s), index(r + 1, s + 1), index(r, s + 1)}});
    }
  Mesh result;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, result);
  return result;
}

// the sum of the angles of the faces at the origin, in degrees
double angle_at_origin(const Mesh& mesh)
{
  double sum = 0;
  for(const auto f : faces(mesh))
    for(const auto h : halfedges_around_face(halfedge(f, mesh), mesh))
      if(mesh.point(target(h, mesh)) == CGAL::ORIGIN)
        sum += CGAL::approximate_angle(mesh.point(source(h, mesh)), Point(CGAL::ORIGIN),
                                       mesh.point(target(next(h, mesh), mesh)));
  return sum;
}

void test(double angle, bool is_large)
{
  Mesh mesh = ramp(angle);
  auto curves
    = mesh.add_property_map<Mesh::Halfedge_index, SC::Curve_segment<Traits> >("h:curve").first;
  std::string message;
  assert(SC::interpolate_boundary_curves(mesh, Traits(), curves, message) == SC::Error_code::OK);
  const SC::Boundary_curve_network_3<Mesh, Traits> network(mesh, curves, Traits());
  assert(network.error() == SC::Error_code::OK);
  SC::Conversion_report report;
  SC::internal::warn_about_large_corners(mesh, get(CGAL::vertex_point, mesh), network, report);
  assert(report.warnings.size() == (is_large ? 1 : 0));
  const CGAL::Constant_property_map<Mesh::Vertex_index, double> size(2);
  const std::vector<Point> folds
    = {Point(0, 0, 0), Point(0.1, 0.1, 0), Point(0.3, 0, 0), Point(0, 0, 6)};
  assert(SC::internal::number_of_avoidable_folds(mesh, get(CGAL::vertex_point, mesh), network, size,
                                                 folds) == (is_large ? 2 : 4));
  if(!is_large)
    return;
  const std::string start = "the interior angle of the corner at (0, 0, 0) is ";
  assert(report.warnings[0].compare(0, start.size(), start) == 0);
  const double degrees = std::stod(report.warnings[0].substr(start.size()));
  assert(std::abs(degrees - angle_at_origin(mesh)) < 1);
}

int main()
{
  for(double turns : {0.25, 0.75, 0.95})
    test(2 * CGAL_PI * turns, false);
  for(double turns : {1.05, 1.25, 1.45})
    test(2 * CGAL_PI * turns, true);
}
