// Joints of boundary curves become vertices of the shell: a square with joints on its sides, and a
// disk whose circle has a seam, or lies on a cylinder that has one.
#include "block_layouts.h"
#include "shell_checks.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Curve_on_surface_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_NURBS_faces.h>
#include <CGAL/Surface_mesh_spline_conversion/find_boundary_vertices.h>

#include <iostream>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;
typedef CGAL::Simple_cartesian<double> K;
typedef K::Point_3 Point_3;
typedef CGAL::Surface_mesh<Point_3> Mesh;
typedef SMSC::NURBS_curve_traits_3<K> Traits;
typedef SMSC::Boundary_curve_network_3<Mesh, Traits> Network;
typedef SMSC::NURBS_shell_3<K> Shell;

// a fan round the origin
template <typename CurveTraits>
struct Fan_of
{
  Mesh mesh;
  CurveTraits traits;
  Mesh::Property_map<Mesh::Halfedge_index, SMSC::Curve_segment<CurveTraits> > curves;

  // `segment(i)`: the curve of edge `i`
  template <typename Segment>
  Fan_of(const std::vector<Point_3>& points, const Segment& segment)
  {
    curves = mesh.add_property_map<Mesh::Halfedge_index, SMSC::Curve_segment<CurveTraits> >(
      "h:curve").first;
    const Mesh::Vertex_index center = mesh.add_vertex(Point_3(0, 0, 0));
    std::vector<Mesh::Vertex_index> v;
    for(const Point_3& p : points)
      v.push_back(mesh.add_vertex(p));
    for(std::size_t i = 0; i < v.size(); ++i)
    {
      const Mesh::Vertex_index w = v[(i + 1) % v.size()];
      mesh.add_face(center, v[i], w);
      curves[mesh.halfedge(v[i], w)] = segment(i);
    }
  }
};

// a curve of its own for each edge
struct Fan : public Fan_of<Traits>
{
  explicit Fan(const std::vector<Point_3>& points)
    : Fan_of<Traits>(points, [&](std::size_t i)
        { return SMSC::Curve_segment<Traits>{Traits::Curve_3::make_line_segment(
                   points[i], points[(i + 1) % points.size()]), 0, 1}; })
  {}
};

bool is_vertex(const Shell& shell, const Point_3& p, double distance)
{
  for(std::size_t v = 0; v < shell.number_of_vertices(); ++v)
    if((shell.point(v) - p).squared_length() <= distance * distance)
      return true;
  return false;
}

// The square [-1,1]^2: its boundary is exact. One joint is at a corner of a patch up to 1e-8.
void test_square()
{
  const std::vector<Point_3> points
    = {Point_3(-1, -1, 0), Point_3(-0.3, -1, 0), Point_3(0.37, -1, 0), Point_3(1, -1, 0),
       Point_3(1, 1e-8, 0), Point_3(1, 1, 0), Point_3(-1, 1, 0)};
  Fan fan(points);
  const Network network(fan.mesh, fan.curves, fan.traits);
  assert(network.error() == SMSC::Error_code::OK && network.number_of_chains() == 4);
  auto is_corner = [](const Point_3& p) { return std::abs(p.x() * p.y()) > 1 - 1e-9; };
  const CGAL::T_NURCC_surface_3<K> surface(block_layout<K>(
    ring_blocks(), 2, [](double x, double y, double z) { return Point_3(x, y, z); }, is_corner));

  const auto vertices = SMSC::find_boundary_vertices(surface, network, 1e-6);
  assert(vertices.size() == points.size());
  Shell plain, shell;
  SMSC::extract_NURBS_faces(surface, plain);
  SMSC::extract_NURBS_faces(surface, shell, CGAL::parameters::boundary_vertices(vertices));
  for(const Point_3& p : points)
    assert(is_vertex(shell, p, 1e-7));
  assert(!is_vertex(plain, points[1], 1e-3));
  assert(Shell_checks<K>(shell).largest_gap < 1e-13);

  // the edges lie on one curve each, and cover the chains
  std::vector<double> covered(4, 0);
  const auto places = SMSC::locate_border_edges(shell, network);
  assert(long(places.size()) == Shell_checks<K>(shell).number_of_border_edges);
  for(const auto& place : places)
  {
    assert(shell.is_border(place.edge) && place.first < place.last);
    covered[place.chain] += place.last - place.first;
    for(const auto& joint : network.joints(place.chain))
      assert(joint.arc_length <= place.first + 1e-6 || joint.arc_length >= place.last - 1e-6);
    const auto& edge = shell.edge(place.edge);
    assert((network.point(place.chain, place.first) - shell.point(edge.source)).squared_length()
           < 1e-14);
    assert((network.point(place.chain, place.last) - shell.point(edge.target)).squared_length()
           < 1e-14);
  }
  for(double length : covered)
    assert(std::abs(length - 2) < 1e-7);

  // curves of another surface are far away
  Fan far({Point_3(5, 4, 0), Point_3(6, 5, 0), Point_3(-4, 7, 0)});
  const Network other(far.mesh, far.curves, far.traits);
  assert(SMSC::find_boundary_vertices(surface, other, 1e-3).empty());
}

// A joint anywhere on a side of the square is found: in the middle of quads, and beside their
// vertices, on either side.
void test_places_of_joints()
{
  const CGAL::T_NURCC_surface_3<K> surface(block_layout<K>(
    ring_blocks(), 2, [](double x, double y, double z) { return Point_3(x, y, z); },
    [](const Point_3& p) { return std::abs(p.x() * p.y()) > 1 - 1e-9; }));
  constexpr int n = 200;
  for(int i = 1; i < n; ++i)
  {
    const Point_3 joint(-1 + 2. * i / n, -1, 0);
    Fan fan({Point_3(-1, -1, 0), joint, Point_3(1, -1, 0), Point_3(1, 1, 0), Point_3(-1, 1, 0)});
    const Network network(fan.mesh, fan.curves, fan.traits);
    const auto vertices = SMSC::find_boundary_vertices(surface, network, 1e-9);
    assert(vertices.size() == 5);
    Shell shell;
    SMSC::extract_NURBS_faces(surface, shell, CGAL::parameters::boundary_vertices(vertices));
    assert(is_vertex(shell, joint, 1e-9));
  }
}

// a surface whose boundary is a circle up to 0.05 only
CGAL::T_NURCC_surface_3<K> disk()
{
  return CGAL::T_NURCC_surface_3<K>(block_layout<K>(
    ring_blocks(), 4, [](double x, double y, double)
    {
      const double length = std::hypot(x, y) + 1e-300;
      const double size = (std::max)(std::abs(x), std::abs(y));
      return Point_3(x * size / length, y * size / length, 0);
    }));
}

// A closed chain: the seam is a vertex, and intervals run over it.
void test_disk()
{
  const double r = std::sqrt(0.5);
  const Traits::Curve_3 circle(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
                               {Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0),
                                Point_3(-1, 1, 0), Point_3(-1, 0, 0), Point_3(-1, -1, 0),
                                Point_3(0, -1, 0), Point_3(1, -1, 0), Point_3(1, 0, 0)},
                               {1, r, 1, r, 1, r, 1, r, 1});
  std::vector<Point_3> points;
  for(int i = 0; i < 16; ++i)
    points.push_back(circle.point(i / 4.));
  Fan fan(points);
  for(Mesh::Halfedge_index h : fan.mesh.halfedges())
    if(!fan.curves[h].is_empty())
    {
      const double t = double(target(h, fan.mesh).idx() - 1);
      fan.curves[h] = {circle, (t == 0 ? 15 : t - 1) / 4, (t == 0 ? 16 : t) / 4};
    }
  const Network network(fan.mesh, fan.curves, fan.traits);
  assert(network.error() == SMSC::Error_code::OK && network.is_closed(0));
  const CGAL::T_NURCC_surface_3<K> surface = disk();
  const double tolerance = 0.1;
  const auto vertices = SMSC::find_boundary_vertices(surface, network, tolerance);
  assert(vertices.size() == 1);
  Shell shell;
  SMSC::extract_NURBS_faces(surface, shell, CGAL::parameters::boundary_vertices(vertices));
  assert(is_vertex(shell, Point_3(1, 0, 0), tolerance));
  double covered = 0;
  for(const auto& place : SMSC::locate_border_edges(shell, network))
  {
    assert(place.chain == 0 && place.first < place.last);
    covered += place.last - place.first;
  }
  assert(std::abs(covered - network.length(0)) < 1e-9);
}

// The circle is a curve on a cylinder, whose seam is in the midst of an edge of the mesh.
void test_disk_in_cylinder()
{
  typedef SMSC::Curve_on_surface_traits_3<K> Surface_traits;
  constexpr int n = 16;
  const double begin = 1.1, end = begin + 2 * CGAL_PI;
  Surface_traits::Curve_3::Surface cylinder;
  cylinder.type = cylinder.CYLINDER;
  cylinder.radius = 1;
  const Surface_traits::Curve_3 circle(cylinder, 1, {begin, begin, end, end},
                                       {K::Point_2(begin, 0), K::Point_2(end, 0)});
  const auto parameter = [&](std::size_t i) { return begin + 2 * CGAL_PI * double(i) / n; };
  std::vector<Point_3> points;
  for(std::size_t i = 0; i < n; ++i)
    points.push_back(circle.point(parameter(i)));
  const Fan_of<Surface_traits> fan(points, [&](std::size_t i)
    { return SMSC::Curve_segment<Surface_traits>{circle, parameter(i), parameter(i + 1)}; });
  const SMSC::Boundary_curve_network_3<Mesh, Surface_traits> network(fan.mesh, fan.curves,
                                                                     fan.traits);
  assert(network.error() == SMSC::Error_code::OK && network.is_closed(0));
  const double tolerance = 0.1;
  const auto vertices = SMSC::find_boundary_vertices(disk(), network, tolerance);
  assert(vertices.size() == 2);
  Shell shell;
  SMSC::extract_NURBS_faces(disk(), shell, CGAL::parameters::boundary_vertices(vertices));
  assert(is_vertex(shell, Point_3(1, 0, 0), tolerance));
  assert(is_vertex(shell, circle.point(begin), tolerance));
}

int main()
{
  test_square();
  test_places_of_joints();
  test_disk();
  test_disk_in_cylinder();
  return 0;
}
