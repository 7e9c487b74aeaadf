// Every defect of mesh, curves and their association must be reported with its elements.

#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Function_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <boost/iterator/function_output_iterator.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef Kernel::Point_3 Point_3;
typedef Kernel::Vector_3 Vector_3;
typedef SC::Conversion_case<Kernel> Case;
typedef Case::Triangle_mesh Mesh;
typedef Mesh::Vertex_index Vertex_index;
typedef Mesh::Halfedge_index Halfedge_index;
typedef SC::Boundary_curve_network_3<Mesh, Case::Curve_traits> Network;

const double pi = 3.14159265358979323846;
const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

std::string edge_name(const Mesh& mesh, Halfedge_index h)
{
  return "(vertices " + std::to_string(std::size_t(source(h, mesh))) + " to "
         + std::to_string(std::size_t(target(h, mesh))) + ")";
}

Case read(const std::string& name)
{
  Case result;
  std::string message;
  const std::string path = CGAL::data_file_path("cases/" + name + "/case.json");
  if(!CGAL::IO::read_case(path, result, message))
    std::cerr << message << std::endl;
  assert(message.empty());
  return result;
}

Network make_network(const Case& c)
{
  return Network(c.mesh, c.halfedge_curve_map(), c.traits);
}

// The corners found by the angle are those of the file, and the loops have its sizes.
void test_valid_case(const Case& c, std::size_t loops, std::size_t chains, std::size_t corners)
{
  const Network network = make_network(c);
  assert(network.error() == SC::Error_code::OK);
  assert(network.number_of_loops() == loops && network.number_of_chains() == chains);
  std::size_t number_of_corners = 0;
  for(const Vertex_index v : vertices(c.mesh))
  {
    assert(network.is_corner(v) == bool(c.corners[v]));
    number_of_corners += network.is_corner(v);
  }
  assert(number_of_corners == corners);
  for(std::size_t i = 0; i < chains; ++i)
    for(std::size_t k = 0; k < network.chain_halfedges(i).size(); ++k)
    {
      const Halfedge_index h = network.chain_halfedges(i)[k];
      assert(network.chain_of(h).chain == i && network.chain_of(h).index == k);
      const Vector_3 d
        = c.mesh.point(source(h, c.mesh)) - network.point(i, network.arc_length(i, k));
      assert(std::sqrt(d.squared_length()) < 1e-12 * network.diameter());
    }
}

// changes one edge in every way, and expects its name in the message.
void test_broken_edge(const Case& valid, Halfedge_index h)
{
  typedef Case::Curve_segment Segment;

  const auto expect = [&](const Segment& segment, const std::string& reason, bool is_exact = true)
  {
    Case broken = valid;
    broken.segments[h] = segment;
    const Network network = make_network(broken);
    assert(network.error() == SC::Error_code::INVALID_BOUNDARY_ASSOCIATION);
    assert(contains(network.message(), reason));
    assert(contains(network.message(), "Loop ") && contains(network.message(), ", edge "));
    // a jump of the parameter may be reported at the edge before
    assert(!is_exact || contains(network.message(), edge_name(valid.mesh, h)));
  };
  const Segment s = valid.segments[h];
  const double width = s.second - s.first;
  expect(Segment(), "no curve is assigned");
  expect(Segment{s.curve, s.second, s.first}, "exchange the parameters");
  expect(Segment{s.curve, s.first, not_a_number}, "not a finite number");
  expect(Segment{s.curve, infinity, s.second}, "not a finite number");
  expect(Segment{s.curve, s.first, s.second + 0.3 * width}, "", false);
  expect(Segment{s.curve, s.first - 0.3 * width, s.second}, "", false);
  expect(Segment{s.curve, s.first, s.first + 0.5 * width}, "", false);
}

void test_broken_edges(const Case& valid, std::size_t step)
{
  std::size_t i = 0;
  for(const Halfedge_index h : halfedges(valid.mesh))
    if(!valid.segments[h].is_empty() && i++ % step == 0)
      test_broken_edge(valid, h);
}

void test_broken_loops(const Case& valid)
{
  const Network network = make_network(valid);
  for(std::size_t l = 0; l < network.number_of_loops(); ++l)
  {
    Case reversed = valid, misplaced = valid;
    for(const Halfedge_index h : network.loop(l))
    {
      std::swap(reversed.segments[h].first, reversed.segments[h].second);
      misplaced.segments[opposite(h, valid.mesh)] = valid.segments[h];
      misplaced.segments[h] = Case::Curve_segment();
    }
    const Network reversed_network = make_network(reversed);
    assert(reversed_network.error() == SC::Error_code::INVALID_BOUNDARY_ASSOCIATION);
    assert(contains(reversed_network.message(), "Loop " + std::to_string(l) + " "));
    assert(contains(reversed_network.message(), "all edges"));
    const Network misplaced_network = make_network(misplaced);
    assert(contains(misplaced_network.message(), "no curve is assigned"));
  }
}

// A vertex off its curve is an error from the tolerance on.
void test_tolerance(const Case& valid)
{
  const double diameter = SC::smallest_enclosing_sphere_diameter(valid.mesh);
  const Halfedge_index h = make_network(valid).loop(0)[3];
  const Vertex_index v = source(h, valid.mesh);
  for(double distance : {5e-7, 2e-6})
  {
    Case moved = valid;
    moved.mesh.point(v) = moved.mesh.point(v) + Vector_3(0, 0, distance * diameter);
    const Network network = make_network(moved);
    if(distance < 1e-6)
      assert(network.error() == SC::Error_code::OK);
    else
      assert(network.error() == SC::Error_code::INVALID_BOUNDARY_ASSOCIATION
             && contains(network.message(), "away from vertex " + std::to_string(std::size_t(v))));
    const Network tolerant(moved.mesh, moved.halfedge_curve_map(), moved.traits,
                           CGAL::parameters::association_tolerance(3e-6 * diameter));
    assert(tolerant.error() == SC::Error_code::OK);
  }
  for(double tolerance : {0., -1., not_a_number, infinity})
    assert(Network(valid.mesh, valid.halfedge_curve_map(), valid.traits,
                   CGAL::parameters::association_tolerance(tolerance)).error()
           == SC::Error_code::INVALID_PARAMETER);
  for(double angle : {0., -1., 180., not_a_number})
    assert(Network(valid.mesh, valid.halfedge_curve_map(), valid.traits,
                   CGAL::parameters::corner_angle(angle)).error()
           == SC::Error_code::INVALID_PARAMETER);
}

// Segments of a circle whose ends are right, but not what lies between.
void test_wrong_ways_round()
{
  typedef SC::Function_curve_traits_3<Kernel> Traits;

  bool has_nan = false;
  const Traits::Curve_3 circle(
    [](double t) { return Point_3(std::cos(t), std::sin(t), 0); },
    [&](double t, int k) { return has_nan ? Vector_3(not_a_number, 0, 0)
                                          : Vector_3(std::cos(t + k * pi / 2),
                                                     std::sin(t + k * pi / 2), 0); });
  const int n = 12;
  Mesh mesh;
  std::vector<Vertex_index> v;
  for(int i = 0; i < n; ++i)
    v.push_back(mesh.add_vertex(circle.point(2 * pi * i / n)));
  const Vertex_index center = mesh.add_vertex(Point_3(0, 0, 0));
  std::map<Halfedge_index, SC::Curve_segment<Traits> > segments;
  for(int i = 0; i < n; ++i)
    mesh.add_face(center, v[i], v[(i + 1) % n]);
  for(int i = 0; i < n; ++i)
    segments[mesh.halfedge(v[i], v[(i + 1) % n])] = {circle, 2 * pi * i / n, 2 * pi * (i + 1) / n};

  const Halfedge_index h = mesh.halfedge(v[7], v[8]);
  const auto message = [&]()
  {
    const SC::Boundary_curve_network_3<Mesh, Traits>
      network(mesh, boost::make_assoc_property_map(segments), Traits());
    assert((network.error() == SC::Error_code::OK) == network.message().empty());
    return network.message();
  };
  assert(message().empty());
  segments[h].second -= 0.1;
  assert(contains(message(), edge_name(mesh, h)) && contains(message(), "not monotone"));
  segments[h].second += 0.1 - 2 * pi;
  assert(contains(message(), edge_name(mesh, h)) && contains(message(), "long way round"));
  // also where no neighbor on the same curve tells the direction
  const Traits::Curve_3 copy([=](double t) { return circle.point(t); },
                             [=](double t, int k) { return circle.derivative(t, k); });
  segments[h].curve = copy;
  assert(contains(message(), edge_name(mesh, h)) && contains(message(), "long way round"));
  segments[h].second += 4 * pi;
  assert(contains(message(), edge_name(mesh, h)) && contains(message(), "times as long"));
  segments[h].second -= 2 * pi;
  assert(message().empty());
  // a spline may turn quickly between two vertices, but not have a corner there
  segments[h].curve = circle;
  for(int degree : {1, 2})
  {
    const Point_3 p = circle.point(segments[h].first), q = circle.point(segments[h].second);
    const Point_3 r = p + 0.4 * (q - p) + 0.1 * (p - CGAL::ORIGIN);
    const SC::NURBS_curve_3<Kernel> spline
      = (degree == 1) ? SC::NURBS_curve_3<Kernel>(1, {0, 0, 0.37, 1, 1}, {p, r, q})
                      : SC::NURBS_curve_3<Kernel>(2, {0, 0, 0, 1, 1, 1}, {p, r, q});
    const auto old = segments[h];
    segments[h] = {Traits::Curve_3([=](double t) { return spline.point(t); },
                                   [=](double t, int k) { return spline.derivative(t, k); }), 0, 1};
    assert((degree == 2) == message().empty());
    assert(degree == 2 || contains(message(), "jumps at the parameter 0.3"));
    segments[h] = old;
  }
  has_nan = true;
  assert(contains(message(), "is not finite"));
}

// A defect of the mesh, and the numbers of its elements.
template <typename Mesh_>
void expect_defect(const Mesh_& mesh, SC::Error_code code, const std::string& reason)
{
  const SC::Boundary_curve_network_3<Mesh_> network(mesh);
  assert(network.error() == code);
  assert(contains(network.message(), reason));
}

void test_meshes()
{
  Mesh empty;
  expect_defect(empty, SC::Error_code::EMPTY_MESH, "no face");
  assert(SC::smallest_enclosing_sphere_diameter(empty) == 0);

  Mesh mesh;
  std::vector<Vertex_index> v;
  for(const Point_3& p : {Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0),
                          Point_3(-1, 0, 0), Point_3(-1, -1, 0)})
    v.push_back(mesh.add_vertex(p));
  expect_defect(mesh, SC::Error_code::EMPTY_MESH, "no face");
  mesh.add_face(v[0], v[1], v[2]);
  expect_defect(mesh, SC::Error_code::NON_MANIFOLD_MESH, "Vertex 3 belongs to no face");
  Mesh bow_tie = mesh;
  bow_tie.add_face(v[0], v[2], v[3]);
  bow_tie.add_face(v[0], v[4], v[5]);
  expect_defect(bow_tie, SC::Error_code::NON_MANIFOLD_MESH, "vertex 0");

  Mesh quad = mesh;
  quad.add_face(std::vector<Vertex_index>{v[0], v[3], v[4], v[5]});
  expect_defect(quad, SC::Error_code::NON_TRIANGULAR_MESH, "Face 1 ");

  Mesh valid = mesh;
  valid.add_face(v[0], v[2], v[3]);
  valid.add_face(v[0], v[3], v[4]);
  valid.add_face(v[0], v[4], v[5]);
  expect_defect(valid, SC::Error_code::INVALID_BOUNDARY_ASSOCIATION, "no curve is assigned");
  for(double x : {not_a_number, infinity, -infinity})
  {
    Mesh broken = valid;
    broken.point(v[4]) = Point_3(-1, x, 0);
    expect_defect(broken, SC::Error_code::DEGENERATE_MESH, "vertex 4 is not a finite");
    assert(std::isnan(SC::smallest_enclosing_sphere_diameter(broken)));
  }
  for(const Point_3& p : {Point_3(0, 0, 0), Point_3(1, 1, 0), Point_3(0.5, 0.5, 0)})
  {
    Mesh broken = valid;
    broken.point(v[1]) = p;
    expect_defect(broken, SC::Error_code::DEGENERATE_MESH, "Face 0 (vertices");
    std::string message;
    std::map<Halfedge_index, SC::Curve_segment<SC::NURBS_curve_traits_3<Kernel> > > curves;
    assert(SC::interpolate_boundary_curves(broken, SC::NURBS_curve_traits_3<Kernel>(),
                                           boost::make_assoc_property_map(curves), message)
           == SC::Error_code::DEGENERATE_MESH);
    assert(contains(message, "Face 0 (vertices") && curves.empty());
  }
  Mesh tiny = valid;
  for(const Vertex_index u : vertices(tiny))
    tiny.point(u) = CGAL::ORIGIN + 1e-30 * (tiny.point(u) - CGAL::ORIGIN);
  expect_defect(tiny, SC::Error_code::INVALID_BOUNDARY_ASSOCIATION, "no curve is assigned");
}

// The smallest sphere by brute force over all pairs, triples and quadruples of points.
double brute_force_diameter(const std::vector<Point_3>& points)
{
  double best = infinity;
  const auto consider = [&](const Point_3& center, double squared_radius)
  {
    for(const Point_3& p : points)
      if((p - center).squared_length() > squared_radius * (1 + 1e-12))
        return;
    best = (std::min)(best, 2 * std::sqrt(squared_radius));
  };
  const std::size_t n = points.size();
  for(std::size_t i = 0; i < n; ++i)
    for(std::size_t j = 0; j < i; ++j)
    {
      const Point_3 middle = CGAL::midpoint(points[i], points[j]);
      consider(middle, (points[i] - middle).squared_length());
      for(std::size_t k = 0; k < j; ++k)
      {
        const Point_3 c3 = CGAL::circumcenter(points[i], points[j], points[k]);
        consider(c3, (points[i] - c3).squared_length());
        for(std::size_t l = 0; l < k; ++l)
        {
          if(CGAL::coplanar(points[i], points[j], points[k], points[l]))
            continue;
          const Point_3 c4 = CGAL::circumcenter(points[i], points[j], points[k], points[l]);
          consider(c4, (points[i] - c4).squared_length());
        }
      }
    }
  return best;
}

void test_diameter()
{
  for(int seed = 1; seed <= 40; ++seed)
  {
    Mesh mesh;
    std::vector<Point_3> points;
    for(int i = 0; i < 12; ++i)
      points.push_back(Point_3(std::sin(seed * 12.9898 + i * 78.233),
                               std::sin(seed * 39.346 + i * 11.135) * (seed % 3),
                               1e3 + std::sin(seed * 73.156 + i * 52.235)));
    for(const Point_3& p : points)
      mesh.add_vertex(p);
    const double expected = brute_force_diameter(points);
    assert(std::abs(SC::smallest_enclosing_sphere_diameter(mesh) - expected) < 1e-10 * expected);
  }
}

// The same bracket as a Polyhedron_3 with another kernel has the same network.
void test_polyhedron(const Case& valid)
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel Epick;
  typedef CGAL::Polyhedron_3<Epick> Polyhedron;
  typedef boost::graph_traits<Polyhedron>::halfedge_descriptor Halfedge;
  typedef SC::Conversion_case<Epick> Epick_case;
  typedef SC::Boundary_curve_network_3<Polyhedron, Epick_case::Curve_traits> Polyhedron_network;

  Epick_case c;
  std::string message;
  assert(CGAL::IO::read_case(CGAL::data_file_path("cases/d4_bracket_simp"), c, message));
  Polyhedron polyhedron;
  std::map<Halfedge, Epick_case::Curve_segment> segments;
  CGAL::copy_face_graph(c.mesh, polyhedron, CGAL::parameters::halfedge_to_halfedge_output_iterator(
    boost::make_function_output_iterator(
      [&](const std::pair<Halfedge_index, Halfedge>& h)
      {
        segments[h.second] = c.segments[h.first];
      })));
  const Polyhedron_network network(polyhedron, boost::make_assoc_property_map(segments), c.traits);
  const Network expected = make_network(valid);
  assert(network.error() == SC::Error_code::OK);
  assert(network.number_of_loops() == expected.number_of_loops());
  assert(network.number_of_chains() == expected.number_of_chains());
  assert(std::abs(network.diameter() - expected.diameter()) < 1e-13 * expected.diameter());
  double sum = 0, expected_sum = 0;
  for(std::size_t i = 0; i < network.number_of_chains(); ++i)
  {
    sum += network.length(i);
    expected_sum += expected.length(i);
  }
  assert(std::abs(sum - expected_sum) < 1e-12 * sum);
}

int main()
{
  const Case square = read("d2_square_corner"), bracket = read("d4_bracket_simp");
  test_valid_case(square, 1, 1, 1);
  test_valid_case(bracket, 6, 16, 16);
  test_broken_edges(square, 1);
  test_broken_edges(bracket, 13);
  test_broken_loops(square);
  test_broken_loops(bracket);
  test_tolerance(bracket);
  test_wrong_ways_round();
  test_meshes();
  test_diameter();
  test_polyhedron(bracket);
  std::cout << "done" << std::endl;
  return EXIT_SUCCESS;
}
