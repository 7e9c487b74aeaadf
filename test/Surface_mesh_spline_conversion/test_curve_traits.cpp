// Points and derivatives of the curve models against closed forms and against difference quotients.

#include <CGAL/Surface_mesh_spline_conversion/Curve_on_surface_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Function_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Variant_curve_traits_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

const double pi = 3.14159265358979323846;

template <typename Vector>
double norm(const Vector& v)
{
  return std::sqrt(CGAL::to_double(v.squared_length()));
}

// Each derivative must be the limit of the central difference quotients of the one below it. Two
// step widths give a value of fourth order. Errors are relative to the largest derivative.
template <typename Traits>
void check_derivatives(const Traits& traits, const typename Traits::Curve_3& curve, double first,
                       double last)
{
  typedef typename Traits::Vector_3 Vector_3;

  const auto point = traits.construct_point_on_curve_3_object();
  const auto derivative = traits.construct_derivative_on_curve_3_object();
  const auto value = [&](double t, int order) -> Vector_3
    { return order == 0 ? point(curve, t) - CGAL::ORIGIN : derivative(curve, t, order); };
  const double h = 1e-3 * (last - first);
  for(int order = 1; order <= 3; ++order)
  {
    double largest_error = 0, largest_derivative = 0;
    for(int i = 1; i < 40; ++i)
    {
      const double t = first + (i + 0.217) / 41 * (last - first);
      const Vector_3 wide = (value(t + 2 * h, order - 1) - value(t - 2 * h, order - 1)) / (4 * h);
      const Vector_3 narrow = (value(t + h, order - 1) - value(t - h, order - 1)) / (2 * h);
      const Vector_3 error = (4. * narrow - wide) / 3. - value(t, order);
      largest_error = (std::max)(largest_error, norm(error));
      largest_derivative = (std::max)(largest_derivative, norm(value(t, order)));
    }
    const double rounding = 1e-9;
    assert(largest_error < 1e-7 * largest_derivative + rounding);
  }
}

// Bernstein polynomials are B-splines without inner knots, and can be evaluated by another formula.
template <typename K>
void test_bezier_curve()
{
  typedef SC::NURBS_curve_traits_3<K> Traits;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  for(int degree = 1; degree <= 14; ++degree)
  {
    std::vector<Point_3> points;
    std::vector<double> weights, knots(degree + 1, 2.);
    knots.insert(knots.end(), degree + 1, 5.);
    for(int i = 0; i <= degree; ++i)
    {
      points.push_back(Point_3(std::sin(2. * i), std::cos(3. * i), 0.1 * i * i));
      weights.push_back(1 + 0.4 * std::sin(5. * i));
    }
    const SC::NURBS_curve_3<K> curve(degree, knots, points, weights);
    for(double x : {0., 0.1, 0.5, 0.77, 1.})
    {
      Vector_3 sum(0, 0, 0);
      double weight_sum = 0, binomial = 1;
      for(int i = 0; i <= degree; ++i)
      {
        const double b = weights[i] * binomial * std::pow(x, i) * std::pow(1 - x, degree - i);
        sum = sum + b * (points[i] - CGAL::ORIGIN);
        weight_sum += b;
        binomial = binomial * (degree - i) / (i + 1);
      }
      assert(norm(curve.point(2 + 3 * x) - (CGAL::ORIGIN + sum / weight_sum)) < 1e-11);
    }
    if(degree <= 5)
      check_derivatives(Traits(), curve, 2, 5);
  }
}

// A cubic that is written with inner knots, by its blossom, is still this cubic.
template <typename K>
void test_cubic_with_knots(bool is_clamped)
{
  typedef typename K::Point_3 Point_3;

  const auto blossom = [](double a, double b, double c)
    { return Point_3(a * b * c, (a * b + b * c + c * a) / 3, 2 - (a + b + c) / 3); };
  std::vector<double> knots = {0, 0, 0, 0, 0.3, 0.7, 0.7, 1.1, 1.4, 2, 2, 2, 2};
  if(!is_clamped)
    knots = {-0.5, -0.4, 0, 0, 0.3, 0.7, 0.7, 1.1, 1.4, 2, 2, 2.5, 2.6};
  std::vector<Point_3> points;
  for(std::size_t i = 0; i + 4 < knots.size(); ++i)
    points.push_back(blossom(knots[i + 1], knots[i + 2], knots[i + 3]));
  const SC::NURBS_curve_3<K> curve(3, knots, points);
  assert(curve.first_parameter() == 0 && curve.last_parameter() == 2);
  for(double t = 0; t <= 2; t += 0.0625)
  {
    assert(norm(curve.point(t) - Point_3(t * t * t, t * t, 2 - t)) < 1e-13);
    assert(norm(curve.derivative(t, 1) - typename K::Vector_3(3 * t * t, 2 * t, -1)) < 1e-12);
    assert(norm(curve.derivative(t, 2) - typename K::Vector_3(6 * t, 2, 0)) < 1e-11);
    assert(norm(curve.derivative(t, 3) - typename K::Vector_3(6, 0, 0)) < 1e-9);
  }
}

template <typename K>
void test_lines_and_arcs()
{
  typedef SC::NURBS_curve_3<K> Curve;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  const Curve line = Curve::make_line_segment(Point_3(1, 2, 3), Point_3(3, 1, 7));
  assert(norm(line.point(0.25) - Point_3(1.5, 1.75, 4)) < 1e-15);
  assert(norm(line.derivative(0.25, 1) - Vector_3(2, -1, 4)) < 1e-15);
  assert(norm(line.derivative(0.25, 2)) == 0);

  const Point_3 center(1, 0, -2);
  for(double last : {0.3, pi / 2, 2., pi, 4.7, 2 * pi})
  {
    const Curve arc
      = Curve::make_circular_arc(center, Vector_3(0, 3, 0), Vector_3(0, 0, 3), 0, last);
    assert(arc.is_rational() && arc.degree() == 2);
    for(int i = 0; i <= 100; ++i)
    {
      const Vector_3 r = arc.point(last * i / 100) - center;
      assert(std::abs(norm(r) - 3) < 1e-14 && r.x() == 0);
    }
    assert(norm(arc.point(last) - center
                - Vector_3(0, 3 * std::cos(last), 3 * std::sin(last))) < 1e-14);
    check_derivatives(SC::NURBS_curve_traits_3<K>(), arc, 0, (std::min)(last, pi / 2) * 0.99);
  }
}

// The pcurve is the parabola u = 0.3 + t, v = 0.2 + t^2 / 2.
template <typename K>
void test_curves_on_surfaces()
{
  typedef SC::Elementary_surface_3<K> Surface;
  typedef SC::Curve_on_surface_3<K> Curve;
  typedef typename K::Point_2 Point_2;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  Surface surface;
  surface.origin = Point_3(1, 2, 3);
  surface.x_axis = Vector_3(0.6, 0.8, 0);
  surface.y_axis = Vector_3(0, 0, 1);
  surface.z_axis = Vector_3(0.8, -0.6, 0);
  surface.radius = 2;
  surface.minor_radius = 0.7;
  surface.half_angle = 0.4;
  const std::vector<double> knots = {0, 0, 0, 1, 1, 1};
  const std::vector<Point_2> points = {Point_2(0.3, 0.2), Point_2(0.8, 0.2), Point_2(1.3, 0.7)};
  for(auto type : {Surface::PLANE, Surface::CYLINDER, Surface::CONE, Surface::SPHERE,
                   Surface::TORUS})
  {
    surface.type = type;
    const Curve curve(surface, 2, knots, points);
    for(double t = 0; t <= 1; t += 0.125)
    {
      const Vector_3 d = curve.point(t) - surface.origin;
      const double x = d * surface.x_axis, y = d * surface.y_axis, z = d * surface.z_axis;
      const double u = 0.3 + t, v = 0.2 + t * t / 2;
      const double distances[] = {std::hypot(x - u, y - v), 2, 2 + v * std::sin(0.4),
                                  2 * std::cos(v), 2 + 0.7 * std::cos(v)};
      const double heights[] = {0, v, v * std::cos(0.4), 2 * std::sin(v), 0.7 * std::sin(v)};
      assert(std::abs(z - heights[type]) < 1e-14);
      if(type == Surface::PLANE)
        assert(distances[type] < 1e-14);
      else
        assert(std::abs(x - distances[type] * std::cos(u)) < 1e-14
               && std::abs(y - distances[type] * std::sin(u)) < 1e-14);
    }
    check_derivatives(SC::Curve_on_surface_traits_3<K>(), curve, 0, 1);
    check_derivatives(SC::Curve_on_surface_traits_3<K>(),
                      Curve(surface, 2, knots, points, {1, 0.7, 2}), 0, 1);
  }
  surface.y_axis = Vector_3(0, 0.1, 1);
  assert(!Curve::defect(surface, 2, knots, points).empty());
}

// A curve passes through a seam where an angle is a multiple of the full turn. It may turn back
// there, or run along the seam.
template <typename K>
void test_seams()
{
  typedef SC::Elementary_surface_3<K> Surface;
  typedef SC::Curve_on_surface_traits_3<K> Surface_traits;
  typedef SC::Variant_curve_traits_3<SC::NURBS_curve_traits_3<K>, Surface_traits> Traits;
  typedef typename Surface_traits::Curve_3 Curve;
  typedef typename K::Point_2 Point_2;
  typedef typename K::Point_3 Point_3;

  Surface surface;
  surface.radius = 3;
  surface.minor_radius = 1;
  const auto seams = [&](typename Surface::Type type, const std::vector<Point_2>& points,
                         const std::vector<double>& weights)
  {
    surface.type = type;
    const int degree = int(points.size()) - 1;
    std::vector<double> knots(points.size(), 1);
    knots.insert(knots.end(), points.size(), 2);
    const Curve curve(surface, degree, knots, points, weights);
    const auto result = Traits().construct_seam_parameters_on_curve_3_object()(curve);
    assert(result == curve.seam_parameters());
    return result;
  };
  const auto is_at = [](const std::vector<double>& parameters, const std::vector<double>& wanted)
  {
    for(std::size_t i = 0; i < wanted.size() && parameters.size() == wanted.size(); ++i)
      if(!(std::abs(parameters[i] - wanted[i]) < 1e-14))
        return false;
    return parameters.size() == wanted.size();
  };
  const std::vector<Point_2> line = {Point_2(2.5 * pi, 0.5 * pi), Point_2(-0.5 * pi, -0.25 * pi)};
  assert(seams(Surface::PLANE, line, {}).empty());
  for(auto type : {Surface::CYLINDER, Surface::CONE, Surface::SPHERE})
    assert(is_at(seams(type, line, {}), {1 + 1. / 6, 1 + 5. / 6}));
  assert(is_at(seams(Surface::TORUS, line, {}), {1 + 1. / 6, 1 + 2. / 3, 1 + 5. / 6}));
  // with the weight 3 at its end, the line is at x where the other one is at x / (3 - 2 x)
  assert(is_at(seams(Surface::CYLINDER, line, {1, 3}), {1 + 1. / 16, 1 + 5. / 8}));
  // a parabola that touches the seam, and curves on it up to rounding, or from there
  assert(seams(Surface::CYLINDER, {Point_2(1, 0), Point_2(-1, 0), Point_2(1, 1)}, {}).empty());
  assert(seams(Surface::CYLINDER, {Point_2(1e-15, 0), Point_2(-1e-15, 1)}, {}).empty());
  assert(seams(Surface::CYLINDER, {Point_2(-1e-15, 0), Point_2(2 * pi, 1)}, {}).empty());
  // more turns than samples
  assert(seams(Surface::CYLINDER, {Point_2(1, 0), Point_2(1e6, 1)}, {}).empty());
  assert(seams(Surface::CYLINDER, {Point_2(-1e300, 0), Point_2(1e300, 1)}, {}).empty());
  const typename Traits::Curve_3 plain(
    SC::NURBS_curve_3<K>::make_line_segment(Point_3(0, 0, 0), Point_3(1, 1, 1)));
  assert(Traits().construct_seam_parameters_on_curve_3_object()(plain).empty());
}

template <typename K>
void test_variant()
{
  typedef SC::NURBS_curve_traits_3<K> Nurbs_traits;
  typedef SC::Function_curve_traits_3<K> Function_traits;
  typedef SC::Variant_curve_traits_3<Nurbs_traits, Function_traits> Traits;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  const typename Function_traits::Curve_3 helix(
    [](double t) { return Point_3(std::cos(t), std::sin(t), t); },
    [](double t, int k) { return Vector_3(std::cos(t + k * pi / 2), std::sin(t + k * pi / 2),
                                          k == 1 ? 1 : 0); });
  const auto line = SC::NURBS_curve_3<K>::make_line_segment(Point_3(0, 0, 0), Point_3(1, 1, 1));
  const Traits traits;
  const typename Traits::Curve_3 a(helix), b(line), c(b);
  assert(b == c && a != b);
  assert(norm(traits.construct_point_on_curve_3_object()(a, 2.) - helix.point(2.)) == 0);
  assert(norm(traits.construct_point_on_curve_3_object()(b, 0.5) - Point_3(0.5, 0.5, 0.5)) == 0);
  check_derivatives(traits, a, 0, 1);
  check_derivatives(traits, b, 0, 1);
}

// What is no curve must be refused with a reason.
template <typename K>
void test_defects()
{
  typedef SC::NURBS_curve_3<K> Curve;
  typedef typename K::Point_3 Point_3;

  const std::vector<Point_3> points(4, Point_3(0, 0, 0));
  const double nan = std::nan("");
  assert(Curve::defect(3, {0, 0, 0, 0, 1, 1, 1, 1}, points).empty());
  assert(!Curve::defect(0, {0, 0, 0, 0, 1}, points).empty());
  assert(!Curve::defect(-7, {}, points).empty());
  assert(!Curve::defect(4, {0, 0, 0, 0, 0, 1, 1, 1, 1}, points).empty());
  assert(!Curve::defect(3, {0, 0, 0, 0, 1, 1, 1}, points).empty());
  assert(!Curve::defect(3, {0, 0, 0, 0, 0, 0, 0, 0}, points).empty());
  assert(!Curve::defect(3, {0, 0, 0, 2, 1, 1, 1, 1}, points).empty());
  assert(!Curve::defect(3, {0, 0, 0, 0, nan, 1, 1, 1}, points).empty());
  assert(!Curve::defect(1, {0, 0, 1, 1, 2, 2}, points).empty());
  assert(!Curve::defect(3, {0, 0, 0, 0, 1, 1, 1, 1}, points, {1, 1, 1}).empty());
  assert(!Curve::defect(3, {0, 0, 0, 0, 1, 1, 1, 1}, points, {1, 1, 0, 1}).empty());
  assert(!Curve::defect(3, {0, 0, 0, 0, 1, 1, 1, 1},
                        std::vector<Point_3>(4, Point_3(0, nan, 0))).empty());
}

template <typename K>
void test()
{
  test_bezier_curve<K>();
  test_cubic_with_knots<K>(true);
  test_cubic_with_knots<K>(false);
  test_lines_and_arcs<K>();
  test_curves_on_surfaces<K>();
  test_seams<K>();
  test_variant<K>();
  test_defects<K>();
}

int main()
{
  test<CGAL::Simple_cartesian<double> >();
  test<CGAL::Exact_predicates_inexact_constructions_kernel>();
  std::cout << "done" << std::endl;
  return EXIT_SUCCESS;
}
