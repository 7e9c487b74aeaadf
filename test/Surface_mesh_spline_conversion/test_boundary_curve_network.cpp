// Arc length, its inverse, chains, corners, joints and projection, against closed forms.

#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Curve_on_surface_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Function_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

const double pi = 3.14159265358979323846;

template <typename Vector>
double norm(const Vector& v)
{
  return std::sqrt(v.squared_length());
}

// Curves with known points, derivatives and arc lengths.
template <typename K>
struct Functions
{
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;
  typedef typename SC::Function_curve_traits_3<K>::Curve_3 Curve_3;

  static Curve_3 ellipse(double a, double b)
  {
    return Curve_3(
      [=](double t) { return Point_3(a * std::cos(t), b * std::sin(t), 0); },
      [=](double t, int k)
        { return Vector_3(a * std::cos(t + k * pi / 2), b * std::sin(t + k * pi / 2), 0); });
  }

  static Curve_3 helix(double radius, double pitch)
  {
    return Curve_3(
      [=](double t) { return Point_3(radius * std::cos(t), radius * std::sin(t), pitch * t); },
      [=](double t, int k) { return Vector_3(radius * std::cos(t + k * pi / 2),
                                             radius * std::sin(t + k * pi / 2),
                                             k == 1 ? pitch : 0); });
  }
};

// A model of BoundaryCurveTraits_3 with nothing but what the concept promises: a network that uses
// more does not compile. Its curves are circles around the z axis.
template <typename K>
struct Curve_traits_archetype
{
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  class Curve_3
  {
  public:
    Curve_3() : m_radius(0) {}
    Curve_3(const Curve_3& other) : m_radius(other.m_radius) {}
    Curve_3& operator=(const Curve_3& other) { m_radius = other.m_radius; return *this; }
    bool operator==(const Curve_3& other) const { return m_radius == other.m_radius; }

  private:
    friend Curve_traits_archetype;
    explicit Curve_3(FT radius) : m_radius(radius) {}
    FT m_radius;
  };

  static Curve_3 circle(FT radius) { return Curve_3(radius); }

  class Construct_point_on_curve_3
  {
  public:
    Point_3 operator()(const Curve_3& c, FT t) const
    {
      return CGAL::ORIGIN + c.m_radius * Vector_3(std::cos(t), std::sin(t), 0);
    }

  private:
    friend Curve_traits_archetype;
    explicit Construct_point_on_curve_3(int) {}
  };

  class Construct_derivative_on_curve_3
  {
  public:
    Vector_3 operator()(const Curve_3& c, FT t, int order) const
    {
      return c.m_radius * Vector_3(std::cos(t + order * pi / 2), std::sin(t + order * pi / 2), 0);
    }

  private:
    friend Curve_traits_archetype;
    explicit Construct_derivative_on_curve_3(int) {}
  };

  explicit Curve_traits_archetype(int) {}
  Curve_traits_archetype(const Curve_traits_archetype&) {}
  Curve_traits_archetype& operator=(const Curve_traits_archetype&) = delete;

  Construct_point_on_curve_3 construct_point_on_curve_3_object() const
  {
    return Construct_point_on_curve_3(0);
  }

  Construct_derivative_on_curve_3 construct_derivative_on_curve_3_object() const
  {
    return Construct_derivative_on_curve_3(0);
  }
};

// A mesh of triangles around a center, whose boundary vertices lie on curves.
template <typename Mesh_, typename Traits>
struct Fan
{
  typedef Mesh_ Mesh;
  typedef typename Traits::Point_3 Point_3;
  typedef typename boost::graph_traits<Mesh>::vertex_descriptor vertex_descriptor;
  typedef typename boost::graph_traits<Mesh>::halfedge_descriptor halfedge_descriptor;
  typedef SC::Curve_segment<Traits> Segment;
  typedef boost::associative_property_map<std::map<halfedge_descriptor, Segment> > Curve_map;
  typedef SC::Boundary_curve_network_3<Mesh, Traits> Network;

  Mesh mesh;
  std::vector<vertex_descriptor> vertices;
  std::map<halfedge_descriptor, Segment> segments;

  Fan(const Traits& traits, const std::vector<Segment>& boundary, const Point_3& center)
  {
    const auto point = traits.construct_point_on_curve_3_object();
    const vertex_descriptor c = add_point(center);
    for(const Segment& s : boundary)
      vertices.push_back(add_point(point(s.curve, s.first)));
    const std::size_t n = vertices.size();
    for(std::size_t i = 0; i < n; ++i)
      CGAL::Euler::add_face(
        std::array<vertex_descriptor, 3>{{c, vertices[i], vertices[(i + 1) % n]}}, mesh);
    for(std::size_t i = 0; i < n; ++i)
      segments[CGAL::halfedge(vertices[i], vertices[(i + 1) % n], mesh).first] = boundary[i];
  }

  vertex_descriptor add_point(const Point_3& p)
  {
    const vertex_descriptor v = add_vertex(mesh);
    put(get(CGAL::vertex_point, mesh), v, p);
    return v;
  }
};

// returns n segments of equal parameter width.
template <typename Traits>
void append_segments(const typename Traits::Curve_3& curve, double first, double last, int n,
                     std::vector<SC::Curve_segment<Traits> >& segments)
{
  const double width = last - first;
  for(int i = 0; i < n; ++i)
    segments.push_back({curve, first + width * i / n, first + width * (i + 1) / n});
}

template <typename K, typename Mesh>
void test_ellipse(bool is_reversed)
{
  typedef SC::Function_curve_traits_3<K> Traits;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  const double a = 3, b = 1, sign = is_reversed ? -1 : 1;
  const double eccentricity = std::sqrt(1 - b * b / (a * a));
  std::vector<SC::Curve_segment<Traits> > segments;
  append_segments<Traits>(Functions<K>::ellipse(a, b), 0, sign * 2 * pi, 17, segments);
  const Fan<Mesh, Traits> fan(Traits(), segments, Point_3(0, 0, 0.5));
  const typename Fan<Mesh, Traits>::Network
    network(fan.mesh, boost::make_assoc_property_map(fan.segments), Traits());
  assert(network.error() == SC::Error_code::OK && network.message().empty());
  assert(network.number_of_loops() == 1 && network.number_of_chains() == 1);
  assert(network.is_closed(0) && network.loop(0).size() == 17);

  // quarter of the ellipse: a E(e), measured from the end of the minor axis
  const double length = 4 * a * std::comp_ellint_2(eccentricity);
  assert(std::abs(network.length(0) - length) < 1e-13 * length);

  // the seam of the curve is the only joint, and smooth
  assert(network.joints(0).size() == 1 && network.joints(0)[0].continuity == 2);
  const double seam = network.joints(0)[0].arc_length;
  for(int i = -50; i < 150; ++i)
  {
    const double s = length * i / 100;
    const auto location = network.locate(0, seam + s);
    const double t = sign * location.parameter;
    assert(-1e-12 < t && t < 2 * pi + 1e-12);
    const double from_minor_axis = a * std::ellint_2(eccentricity, t - pi / 2);
    const double expected = from_minor_axis + length / 4;
    const double difference = std::remainder(expected - s, length);
    assert(std::abs(difference) < 1e-12 * length);
    assert(std::abs(std::remainder(network.arc_length(0, location.edge, location.parameter)
                                   - s - seam, length)) < 1e-13 * length);

    const double speed = std::hypot(a * std::sin(t), b * std::cos(t));
    const Vector_3 tangent = network.derivative(0, seam + s, 1);
    assert(norm(tangent - Vector_3(-a * std::sin(t), sign * b * std::cos(t), 0) / speed) < 1e-11);
    // inwards, of the length of the curvature a b / |C'|^3
    const Vector_3 curvature = network.derivative(0, seam + s, 2);
    assert(std::abs(norm(curvature) - a * b / std::pow(speed, 3)) < 1e-9);
    assert(std::abs(curvature * tangent) < 1e-12);
  }
}

// A loop of a helix and a straight line, whose ends are corners.
template <typename K, typename Mesh>
void test_helix()
{
  typedef SC::Function_curve_traits_3<K> Traits;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  const double radius = 2, pitch = 0.3, last = 1.5 * pi;
  const auto helix = Functions<K>::helix(radius, pitch);
  const Point_3 begin = helix.point(0), end = helix.point(last);
  const typename Traits::Curve_3 line(
    [=](double t) { return end + t * (begin - end); },
    [=](double, int k) { return k == 1 ? begin - end : Vector_3(0, 0, 0); });
  std::vector<SC::Curve_segment<Traits> > segments;
  append_segments<Traits>(helix, 0, last, 11, segments);
  append_segments<Traits>(line, 0, 1, 3, segments);
  const Fan<Mesh, Traits> fan(Traits(), segments, Point_3(-0.5, 0.4, 0.6));
  const typename Fan<Mesh, Traits>::Network
    network(fan.mesh, boost::make_assoc_property_map(fan.segments), Traits());
  assert(network.error() == SC::Error_code::OK);
  assert(network.number_of_chains() == 2 && network.chains_of_loop(0).size() == 2);
  for(std::size_t i = 0; i < fan.vertices.size(); ++i)
    assert(network.is_corner(fan.vertices[i]) == (i == 0 || i == 11));

  const auto first
    = CGAL::halfedge(fan.vertices[0], fan.vertices[1], fan.mesh).first;
  const std::size_t c = network.chain_of(first).chain;
  const double speed = std::hypot(radius, pitch);
  assert(network.chain_of(first).index == 0 && !network.is_closed(c) && network.joints(c).empty());
  assert(std::abs(network.length(c) - speed * last) < 1e-13 * network.length(c));
  for(int i = 0; i <= 40; ++i)
  {
    const double s = network.length(c) * i / 40, t = s / speed;
    assert(norm(network.point(c, s) - helix.point(t)) < 1e-13);
    for(int order = 1; order <= 3; ++order)
      assert(norm(network.derivative(c, s, order)
                  - helix.derivative(t, order) / std::pow(speed, order)) < 1e-12);

    // the foot of a point on the principal normal is known
    const Vector_3 normal = helix.derivative(t, 2) / radius;
    const auto foot = network.project(c, helix.point(t) + 0.3 * normal, s + 0.4);
    assert(std::abs(foot.arc_length - s) < 1e-7 && std::abs(foot.distance - 0.3) < 1e-13);
    const auto global_foot = network.project(c, helix.point(t) + 0.3 * normal);
    assert(std::abs(global_foot.arc_length - s) < 1e-7);
  }
  // ends are clamped, and met exactly
  assert(network.locate(c, -1.).parameter == 0 && network.locate(c, 1e9).parameter == last);
  for(std::size_t i = 0; i < 11; ++i)
    assert(network.locate(c, network.arc_length(c, i)).parameter
           == network.curve_segment(c, i).first);
}

// Speeds with kinks: arc length of a polyline as a curve of degree 1, and of a graph whose third
// derivative jumps.
void test_arc_length_with_knots()
{
  typedef SC::internal::Arc_length_table<double> Table;

  Table polyline; // one unit per parameter up to 1/3, then 5
  const auto speed = [](double t) { return t < 1. / 3 ? 1. : 5.; };
  assert(polyline.append_edge(speed, 0, 1) && polyline.append_edge(speed, 1, 0.25));
  assert(std::abs(polyline.arc_length(1) - 11. / 3) < 1e-12);
  assert(std::abs(polyline.length() - 11. / 3 - 10. / 3 - 1. / 12) < 1e-12);
  assert(std::abs(polyline.locate(2. / 3).parameter - 0.4) < 1e-12);
  assert(polyline.locate(polyline.length()).parameter == 0.25);

  Table cusp; // |t| is the speed of (t^2/2, 0, 0)
  assert(cusp.append_edge([](double t) { return std::abs(t); }, -0.3, 1));
  assert(std::abs(cusp.length() - 0.545) < 1e-12);
  for(double t = -0.25; t < 1; t += 0.125)
    assert(std::abs(cusp.arc_length(0, t) - (0.09 + t * std::abs(t)) / 2) < 1e-12);

  Table invalid;
  assert(!invalid.append_edge([](double) { return 0.; }, 0, 1));
  assert(!invalid.append_edge([](double t) { return std::sqrt(t - 0.9); }, 0, 1));
  assert(invalid.length() == 0);
  // noise must not make it run for ever
  Table noise;
  assert(noise.append_edge([](double t) { return 1 + 0.01 * std::sin(1e15 * t); }, 0, 1));
  assert(std::abs(noise.length() - 1) < 0.01);
}

// A stadium has joints of lines and arcs that are no corners. A flag makes one a corner.
template <typename K, typename Mesh>
void test_joints_and_flags()
{
  typedef SC::NURBS_curve_traits_3<K> Traits;
  typedef typename Traits::Curve_3 Curve_3;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;
  typedef Fan<Mesh, Traits> Fan;

  std::vector<SC::Curve_segment<Traits> > segments;
  const auto line = [](double x, double y, double to_x)
    { return Curve_3::make_line_segment(Point_3(x, y, 0), Point_3(to_x, y, 0)); };
  const auto arc = [](double x, double first)
    { return Curve_3::make_circular_arc(Point_3(x, 0, 0), Vector_3(1, 0, 0), Vector_3(0, 1, 0),
                                        first, first + pi); };
  append_segments<Traits>(line(-2, -1, 2), 0, 1, 4, segments);
  append_segments<Traits>(arc(2, -pi / 2), -pi / 2, pi / 2, 5, segments);
  append_segments<Traits>(line(2, 1, -2), 0, 1, 4, segments);
  append_segments<Traits>(arc(-2, pi / 2), pi / 2, 1.5 * pi, 5, segments);
  const Fan fan(Traits(), segments, Point_3(0, 0, 0));
  const auto map = boost::make_assoc_property_map(fan.segments);
  const typename Fan::Network network(fan.mesh, map, Traits());
  assert(network.error() == SC::Error_code::OK && network.number_of_chains() == 1);
  assert(std::abs(network.length(0) - 8 - 2 * pi) < 1e-12);
  assert(network.joints(0).size() == 4 && network.joints(0)[0].arc_length == 0);
  for(const auto& joint : network.joints(0))
    assert(joint.continuity == 1 && joint.turning_angle < 1e-6);
  for(const auto v : fan.vertices)
    assert(std::abs(network.corner_angle(v) - pi) < 1e-6 && !network.is_corner(v));

  std::map<typename Fan::vertex_descriptor, bool> flags;
  for(const auto v : vertices(fan.mesh))
    flags[v] = (v == fan.vertices[4]);
  const typename Fan::Network flagged(fan.mesh, map, Traits(),
    CGAL::parameters::vertex_is_constrained_map(boost::make_assoc_property_map(flags)));
  assert(flagged.error() == SC::Error_code::OK && flagged.number_of_chains() == 1);
  assert(flagged.is_corner(fan.vertices[4]) && !flagged.is_closed(0));
  assert(flagged.joints(0).size() == 3);
  assert(source(flagged.chain_halfedges(0)[0], fan.mesh) == fan.vertices[4]);
}

// A circle on a cylinder passes through the seam, in the midst of an edge or at a vertex, wherever it
// begins, and in either direction.
template <typename K, typename Mesh>
void test_surface_seams()
{
  typedef SC::Curve_on_surface_traits_3<K> Traits;
  typedef typename K::Point_2 Point_2;
  typedef typename K::Point_3 Point_3;
  typedef Fan<Mesh, Traits> Fan;

  constexpr int n = 8;
  typename Traits::Curve_3::Surface cylinder;
  cylinder.type = cylinder.CYLINDER;
  cylinder.radius = 2;
  for(double begin : {-0.3, -0.25 * pi})
    for(bool is_reversed : {false, true})
    {
      const typename Traits::Curve_3 circle(
        cylinder, 1, {0, 0, 1, 1}, {Point_2(begin, 0), Point_2(begin + 2 * pi, 0)});
      std::vector<SC::Curve_segment<Traits> > segments;
      append_segments<Traits>(circle, is_reversed ? 1 : 0, is_reversed ? 0 : 1, n, segments);
      const Fan fan(Traits(), segments, Point_3(0, 0, 0));
      const typename Fan::Network network(
        fan.mesh, boost::make_assoc_property_map(fan.segments), Traits());
      assert(network.error() == SC::Error_code::OK && network.is_closed(0));
      assert(network.surface_seams(0).size() == 1);
      assert(std::abs(network.surface_seams(0)[0]
                      - (is_reversed ? 4 * pi + 2 * begin : -2 * begin)) < 1e-12);
    }
}

// The interior angle of a sector of a disk, convex or concave, at its center.
template <typename K, typename Mesh>
void test_corner_angle(double angle)
{
  typedef SC::NURBS_curve_traits_3<K> Traits;
  typedef typename Traits::Curve_3 Curve_3;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;
  typedef Fan<Mesh, Traits> Fan;

  const Point_3 tip(0, 0, 0), a(1, 0, 0), b(std::cos(angle), std::sin(angle), 0);
  // bulging sides, whose tangents at the tip enclose 0.2 more on each side
  const auto side = [](const Point_3& p, const Point_3& q, double bulge)
  {
    const Vector_3 d = q - p, n(d.y(), -d.x(), 0);
    return Curve_3(2, {0, 0, 0, 1, 1, 1}, {p, p + d / 2 + std::tan(bulge) / 2 * n, q});
  };
  std::vector<SC::Curve_segment<Traits> > segments;
  append_segments<Traits>(side(tip, a, 0.2), 0, 1, 6, segments);
  append_segments<Traits>(Curve_3::make_circular_arc(tip, Vector_3(1, 0, 0), Vector_3(0, 1, 0), 0,
                                                     angle), 0, angle, 10, segments);
  append_segments<Traits>(side(b, tip, 0.2), 0, 1, 6, segments);
  const Point_3 center(0.6 * std::cos(angle / 2), 0.6 * std::sin(angle / 2), 0);
  const Fan fan(Traits(), segments, center);
  const typename Fan::Network network(fan.mesh, boost::make_assoc_property_map(fan.segments),
                                      Traits(), CGAL::parameters::corner_angle(5.));
  assert(network.error() == SC::Error_code::OK && network.number_of_chains() == 3);
  assert(network.is_corner(fan.vertices[0]));
  assert(std::abs(network.corner_angle(fan.vertices[0]) - angle - 0.4) < 1e-6);
  assert(std::abs(network.corner_angle(fan.vertices[6]) - pi / 2 - 0.2) < 1e-6);
}

// Splines through points of a circle have an error of fourth order, and are C2 also at their seam;
// a parabola is reproduced between corners.
template <typename K, typename Mesh>
void test_interpolation()
{
  typedef SC::NURBS_curve_traits_3<K> Traits;
  typedef typename K::Point_3 Point_3;
  typedef Fan<Mesh, Traits> Fan;

  double previous_error = 0;
  for(int n : {16, 32, 64})
  {
    std::vector<SC::Curve_segment<Traits> > segments;
    append_segments<Traits>(Traits::Curve_3::make_circular_arc(
      Point_3(0, 0, 0), typename K::Vector_3(1, 0, 0), typename K::Vector_3(0, 1, 0), 0, 2 * pi),
      0, 2 * pi, n, segments);
    Fan fan(Traits(), segments, Point_3(0, 0, 0));
    auto map = boost::make_assoc_property_map(fan.segments);
    std::string message;
    assert(SC::interpolate_boundary_curves(fan.mesh, Traits(), map, message) == SC::Error_code::OK);
    const typename Fan::Network network(fan.mesh, map, Traits());
    assert(network.error() == SC::Error_code::OK && network.is_closed(0));
    assert(network.joints(0).size() == 1 && network.joints(0)[0].continuity == 2);
    double error = 0;
    for(int i = 0; i < 1000; ++i)
      error = (std::max)(error, std::abs(1 - norm(network.point(0, network.length(0) * i / 1000)
                                                  - CGAL::ORIGIN)));
    assert(error < 1e-3 && (previous_error == 0 || error < previous_error / 14));
    previous_error = error;

    // with a small angle every vertex is a corner, and every curve a line
    assert(SC::interpolate_boundary_curves(fan.mesh, Traits(), map, message,
             CGAL::parameters::corner_angle(1.)) == SC::Error_code::OK);
    const typename Fan::Network polygon(fan.mesh, map, Traits());
    assert(polygon.number_of_chains() == static_cast<std::size_t>(n));
    double perimeter = 0, sum = 0;
    for(int i = 0; i < n; ++i)
    {
      const auto vpm = get(CGAL::vertex_point, fan.mesh);
      perimeter += norm(get(vpm, fan.vertices[i]) - get(vpm, fan.vertices[(i + 1) % n]));
      sum += polygon.length(i);
    }
    assert(std::abs(perimeter - sum) < 1e-13);
  }
}

// The spline conditions, on random-looking points: interpolation, C2, and not-a-knot.
template <typename K>
void test_spline_conditions()
{
  typedef typename K::Point_3 Point_3;

  for(int n = 2; n < 12; ++n)
    for(bool is_closed : {false, true})
    {
      std::vector<Point_3> points;
      for(int i = 0; i < n; ++i)
        points.push_back(Point_3(std::cos(2 * pi * i / n) + 0.2 * std::sin(7. * i),
                                 std::sin(2 * pi * i / n), 0.3 * std::cos(11. * i)));
      if(is_closed)
        points.push_back(points[0]);
      if(is_closed && n < 3)
        continue;
      const SC::internal::Cubic_spline_interpolation<K> spline(points, is_closed);
      const SC::NURBS_curve_3<K> curve = spline.curve();
      const std::vector<double>& t = spline.parameters();
      for(std::size_t i = 0; i < points.size(); ++i)
        assert(norm(curve.point(t[i]) - points[i]) < 1e-13);
      for(int order = 1; is_closed && order <= 2; ++order)
        assert(norm(curve.derivative(t.front(), order)
                    - curve.derivative(t.back(), order)) < 1e-10);
      const auto third = [&](std::size_t i)
        { return curve.derivative((t[i] + t[i + 1]) / 2, 3); };
      if(!is_closed && points.size() > 3)
      {
        const std::size_t last = points.size() - 2;
        assert(norm(third(0) - third(1)) < 1e-8 && norm(third(last) - third(last - 1)) < 1e-8);
      }
      if(!is_closed && points.size() == 3)
        assert(norm(third(0)) < 1e-9 && norm(third(1)) < 1e-9);
    }
}

template <typename K, typename Mesh>
void test_archetype()
{
  typedef Curve_traits_archetype<K> Traits;
  typedef typename K::Point_3 Point_3;

  const Traits traits(0);
  std::vector<SC::Curve_segment<Traits> > segments;
  append_segments<Traits>(Traits::circle(2), 0, 2 * pi, 9, segments);
  const Fan<Mesh, Traits> fan(traits, segments, Point_3(0, 0, 1));
  const typename Fan<Mesh, Traits>::Network
    network(fan.mesh, boost::make_assoc_property_map(fan.segments), traits);
  assert(network.error() == SC::Error_code::OK);
  assert(std::abs(network.length(0) - 4 * pi) < 1e-12);
  assert(std::abs(network.project(0, Point_3(1, 1, 1)).distance
                  - std::hypot(2 - std::sqrt(2.), 1)) < 1e-12);
  assert(network.locate(0, 1.).curve == Traits::circle(2));
  assert(std::abs(norm(network.derivative(0, 1., 3)) - 0.25) < 1e-12);
}

// A tetrahedron needs no curves.
template <typename K, typename Mesh>
void test_closed_mesh()
{
  typedef typename K::Point_3 Point_3;

  Mesh mesh;
  CGAL::make_tetrahedron(Point_3(1, 1, 1), Point_3(1, -1, -1), Point_3(-1, 1, -1),
                         Point_3(-1, -1, 1), mesh);
  const SC::Boundary_curve_network_3<Mesh> network(mesh);
  assert(network.error() == SC::Error_code::OK);
  assert(network.number_of_loops() == 0 && network.number_of_chains() == 0);
  assert(std::abs(network.diameter() - 2 * std::sqrt(3.)) < 1e-14);
  for(const auto v : vertices(mesh))
    assert(!network.is_corner(v));
}

template <typename K, typename Mesh>
void test()
{
  test_ellipse<K, Mesh>(false);
  test_ellipse<K, Mesh>(true);
  test_helix<K, Mesh>();
  test_joints_and_flags<K, Mesh>();
  test_surface_seams<K, Mesh>();
  for(double angle : {0.8, pi / 2, 2., 3.5, 4.5, 5.5})
    test_corner_angle<K, Mesh>(angle);
  test_interpolation<K, Mesh>();
  test_archetype<K, Mesh>();
  test_closed_mesh<K, Mesh>();
}

int main()
{
  typedef CGAL::Simple_cartesian<double> Cartesian;
  typedef CGAL::Exact_predicates_inexact_constructions_kernel Epick;

  test_arc_length_with_knots();
  test_spline_conditions<Cartesian>();
  test_spline_conditions<Epick>();
  test<Cartesian, CGAL::Surface_mesh<Cartesian::Point_3> >();
  test<Epick, CGAL::Polyhedron_3<Epick> >();
  std::cout << "done" << std::endl;
  return EXIT_SUCCESS;
}
