// The univariate fit of boundary chains on curves with known derivatives, and the boundary fit of a
// surface: convergence order, exact ends, planarity, bound of the error, balance.
#include "tensor_product_surface.h"

#include <CGAL/Surface_mesh_spline_conversion/fit_boundary.h>

#include <CGAL/T_NURCC_surface_3.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace internal = CGAL::Surface_mesh_spline_conversion::internal;
using internal::Chain_fit;
using internal::Chain_knots;
using internal::Cubic_spline_basis;

const double pi = 2 * std::acos(0.);

// a circle with `sides` quad sides in a tilted plane; `unevenness` > 0 makes the speed vary
struct Circle
{
  double sides, unevenness = 0;

  Eigen::Vector3d at(double c, double s) const
  {
    return c * Eigen::Vector3d(2, 1, -2) / 3 + s * Eigen::Vector3d(1, 2, 2) / 3;
  }
  double angle(double x) const
  {
    return 2 * pi * x / sides + unevenness * std::sin(2 * pi * x / sides);
  }
  Eigen::Vector3d point(double x) const { return at(std::cos(angle(x)), std::sin(angle(x))); }
  Eigen::Vector3d derivative(double x) const
  {
    const double w = 2 * pi / sides * (1 + unevenness * std::cos(2 * pi * x / sides));
    return w * at(-std::sin(angle(x)), std::cos(angle(x)));
  }
  double arc_length(double x) const { return angle(x); } // the radius is one
  internal::Curve_foot foot(double x) const { return curve_foot(arc_length(x)); }
  Eigen::Vector3d curve_point(double s) const { return at(std::cos(s), std::sin(s)); }
  internal::Curve_foot curve_foot(double s) const
  {
    return {s, curve_point(s), at(-std::sin(s), std::cos(s))};
  }
};

Chain_knots periodic_knots(int n)
{
  Chain_knots result;
  result.period = n;
  for(int i = 0; i < n; ++i)
    result.knots.push_back(i);
  return result;
}

Chain_knots open_knots(int n)
{
  Chain_knots result;
  for(int i = 0; i <= n; ++i)
    result.knots.insert(result.knots.end(), i == 0 || i == n ? 4 : 1, double(i));
  return result;
}

double dense_error(const Chain_knots& knots, const Chain_fit& fit, const Circle& circle)
{
  const Cubic_spline_basis basis = knots.basis();
  double result = 0;
  for(std::size_t span = 0; span < basis.number_of_spans(); ++span)
    for(int i = 0; i <= 100; ++i)
    {
      const double t = i / 100.;
      const double x = (1 - t) * basis.span_begin(span) + t * basis.span_end(span);
      const Eigen::Vector3d s = internal::evaluate(basis.values(span, x), fit.polygon, 0);
      result = (std::max)(result, (s - circle.point(x)).norm());
    }
  return result;
}

void test_basis(const Chain_knots& knots)
{
  const Cubic_spline_basis basis = knots.basis();
  for(std::size_t span = 0; span < basis.number_of_spans(); ++span)
    for(int i = 1; i < 8; ++i)
    {
      const double length = basis.span_end(span) - basis.span_begin(span);
      const double x = basis.span_begin(span) + length * i / 8, h = 1e-4 * length;
      assert(basis.span_of(x) == span);
      const auto b = basis.values(span, x), before = basis.values(span, x - h),
                 after = basis.values(span, x + h);
      double sum = 0;
      for(int k = 0; k < 4; ++k)
      {
        sum += b.derivatives[0][k];
        for(int order = 0; order < 2; ++order)
        {
          const double quotient
            = (after.derivatives[order][k] - before.derivatives[order][k]) / (2 * h);
          assert(std::abs(quotient - b.derivatives[order + 1][k])
                 < 1e-6 / std::pow(length, order + 1));
        }
      }
      assert(std::abs(sum - 1) < 1e-14);
    }
}

void test_convergence(bool is_closed)
{
  double last = 0;
  for(int n : {16, 32, 64, 128})
  {
    Circle circle{is_closed ? double(n) : 2. * n, 0.3};
    const Chain_knots knots = is_closed ? periodic_knots(n) : open_knots(n);
    const Chain_fit fit = internal::fit_chain(knots, circle);
    const double error = dense_error(knots, fit, circle);
    assert(fit.is_solved && error <= fit.worst().bound && fit.worst().bound < 1.05 * error);
    assert(last == 0 || (last / error > 13 && last / error < 20)); // order 4
    last = error;
    for(const Eigen::Vector3d& p : fit.polygon) // the normal of the plane is (2, -2, 1) / 3
      assert(std::abs(2 * p[0] - 2 * p[1] + p[2]) < 1e-13);
  }
}

void test_ends()
{
  for(int n : {1, 2, 3, 10})
  {
    Circle circle{3. * n, 0.3};
    const Chain_knots knots = open_knots(n);
    const Cubic_spline_basis basis = knots.basis();
    const Chain_fit fit = internal::fit_chain(knots, circle);
    const auto first = basis.values(0, 0), last = basis.values(basis.number_of_spans() - 1, n);
    assert(fit.polygon.front() == circle.point(0) && fit.polygon.back() == circle.point(n));
    assert((internal::evaluate(first, fit.polygon, 1) - circle.derivative(0)).norm() < 1e-13);
    assert((internal::evaluate(last, fit.polygon, 1) - circle.derivative(n)).norm() < 1e-13);
  }
}

// The fit of the shape: not farther from the circle, in its plane, with its tangents at the
// ends, and bounded by the stated error. The distance to a circle is known without closest points.
void test_shape(bool is_closed)
{
  double last = 0;
  for(int n : {8, 16, 32})
  {
    Circle circle{is_closed ? double(n) : 2. * n, 0.3};
    const Chain_knots knots = is_closed ? periodic_knots(n) : open_knots(n);
    const Cubic_spline_basis basis = knots.basis();
    const Chain_fit start = internal::fit_chain(knots, circle);
    const Chain_fit fit = internal::fit_chain_shape(knots, start, circle);
    double error = 0;
    for(std::size_t span = 0; span < basis.number_of_spans(); ++span)
      for(int i = 0; i <= 100; ++i)
      {
        const double x = basis.span_begin(span) + i / 100.;
        const Eigen::Vector3d p = internal::evaluate(basis.values(span, x), fit.polygon, 0);
        error = (std::max)(error, std::abs(p.norm() - 1));
        assert(std::abs(2 * p[0] - 2 * p[1] + p[2]) < 1e-13);
      }
    for(const Eigen::Vector3d& p : fit.polygon)
      assert(std::abs(2 * p[0] - 2 * p[1] + p[2]) < 1e-13);
    assert(error <= fit.worst().bound && fit.worst().bound < 1.1 * error);
    // a closed spline on many spans at equal parameters has hardly an error along the curve
    assert(error < (is_closed ? 1.001 : 0.9) * start.worst().sampled);
    assert(last == 0 || last / error > 8);
    last = error;
    for(const Eigen::Vector3d& p : fit.polygon)
      assert(std::abs(2 * p[0] - 2 * p[1] + p[2]) < 1e-13);
    if(is_closed)
      continue;
    assert(fit.polygon.front() == circle.point(0) && fit.polygon.back() == circle.point(n));
    const auto values = basis.values(0, 0);
    assert(internal::evaluate(values, fit.polygon, 1).normalized().cross(
             circle.derivative(0).normalized()).norm() < 1e-13);
  }
}

// The splines pass through the joints, wherever these are on the spans, and their errors fall as
// without joints.
void test_joints(bool is_closed)
{
  double last = 0;
  for(int n : {8, 16, 32})
  {
    Circle circle{is_closed ? double(n) : 2. * n, 0.3};
    Chain_knots knots = is_closed ? periodic_knots(n) : open_knots(n);
    const Cubic_spline_basis basis = knots.basis();
    const Chain_fit without
      = internal::fit_chain_shape(knots, internal::fit_chain(knots, circle), circle);
    knots.joints = {0.3, 1, 2.71, 5.5, 5.9};
    if(is_closed)
      knots.joints.push_back(0);
    const Chain_fit fit = internal::fit_chain(knots, circle);
    const Chain_fit shape = internal::fit_chain_shape(knots, fit, circle);
    assert(shape.worst().bound < fit.worst().bound);
    double distance = 0;
    for(double x : knots.joints)
    {
      const auto values = basis.values(basis.span_of(x), x);
      for(const Chain_fit* f : {&fit, &shape})
        assert((internal::evaluate(values, f->polygon, 0) - circle.point(x)).norm()
               < 1e-6 * f->worst().bound);
      distance = (std::max)(distance, (internal::evaluate(values, without.polygon, 0)
                                       - circle.point(x)).norm());
    }
    assert(distance > 0.1 * without.worst().bound);
    assert(last == 0 || last / fit.worst().bound > 10); // order 4
    last = fit.worst().bound;
  }
}

// a straight line that goes on as a circular arc: its curvature jumps
struct Line_and_arc
{
  static constexpr double end_of_line = 3.1234;

  double angle(double s) const { return (std::max)(0., s - end_of_line) / 0.8; }
  double arc_length(double x) const { return x + 0.05 * std::sin(x); }
  double speed(double x) const { return 1 + 0.05 * std::cos(x); }
  Eigen::Vector3d curve_point(double s) const
  {
    return Eigen::Vector3d((std::min)(s, end_of_line) + 0.8 * std::sin(angle(s)),
                           0.8 * (1 - std::cos(angle(s))), 0);
  }
  internal::Curve_foot curve_foot(double s) const
  {
    return {s, curve_point(s), Eigen::Vector3d(std::cos(angle(s)), std::sin(angle(s)), 0)};
  }
  internal::Curve_foot foot(double x) const { return curve_foot(arc_length(x)); }
  Eigen::Vector3d point(double x) const { return foot(x).point; }
  Eigen::Vector3d derivative(double x) const { return speed(x) * foot(x).tangent; }
};

// where short spans are needed, the spline runs along the curve about as fast as the target
void test_evenness()
{
  Line_and_arc curve;
  for(double tolerance : {1e-4, 1e-5})
  {
    const SC::Error_metric metric = SC::Error_metric::REPROJECTED;
    const auto [knots, fit] = internal::plan_bisection(
      {open_knots(6), internal::fit_chain(open_knots(6), curve, metric, tolerance)}, curve, metric,
      tolerance, 1e-4, 10000);
    assert(fit.worst().bound < tolerance);
    const Cubic_spline_basis basis = knots.basis();
    for(int i = 0; i <= 3000; ++i)
    {
      const double x = i / 500.;
      const Eigen::Vector3d derivative
        = internal::evaluate(basis.values(basis.span_of(x), x), fit.polygon, 1);
      assert(std::abs(derivative.norm() / curve.speed(x) - 1) < 0.005);
    }
  }
}

// the figures of 16 quads on a circle, with the tolerance relative to the diagonal of its box
void test_number_of_segments()
{
  const Circle circle{16};
  internal::Cached_curve_target<Circle> target(circle);
  const double tolerance = 1e-6 * std::sqrt(8.);
  const auto [knots, fit]
    = internal::plan_bisection({periodic_knots(16), internal::fit_chain(periodic_knots(16), target)},
                               target, SC::Error_metric::PARAMETRIC, tolerance, 1e-3, 10000);
  assert(knots.knots.size() == 32);
  assert(dense_error(knots, fit, circle) < tolerance);
}

// a circle whose points are known up to a pseudo-random error only
struct Noisy_circle : Circle
{
  double noise;
  Noisy_circle(double sides, double noise) : Circle{sides}, noise(noise) {}

  Eigen::Vector3d curve_point(double s) const
  {
    return (1 + noise * std::sin(1e9 * s)) * Circle::curve_point(s);
  }
  internal::Curve_foot curve_foot(double s) const
  {
    internal::Curve_foot foot = Circle::curve_foot(s);
    foot.point = curve_point(s);
    return foot;
  }
  internal::Curve_foot foot(double x) const { return curve_foot(arc_length(x)); }
  Eigen::Vector3d point(double x) const { return curve_point(arc_length(x)); }
};

// Spans are not bisected below the noise of a curve, where this is of no use.
void test_noise()
{
  const double noise = 1e-9;
  Noisy_circle circle(16, noise);
  for(auto metric : {SC::Error_metric::PARAMETRIC, SC::Error_metric::REPROJECTED})
  {
    const auto [knots, fit] = internal::plan_bisection(
      {periodic_knots(16), internal::fit_chain(periodic_knots(16), circle)}, circle, metric,
      noise / 100, 1e-4, 100000);
    assert(fit.worst().bound < 10 * noise && knots.knots.size() < 2000);
  }
}

void test_balance()
{
  for(const Chain_knots& knots : {periodic_knots(8), open_knots(8)})
  {
    std::vector<int> levels(8, 0);
    levels[3] = 5;
    const Cubic_spline_basis basis
      = internal::Chain_bisection(knots, 1e-6)(levels).basis();
    assert(basis.number_of_spans() > 8 + 31);
    for(std::size_t i = 0; i + 1 < basis.number_of_spans(); ++i)
    {
      const double a = basis.span_end(i) - basis.span_begin(i);
      const double b = basis.span_end(i + 1) - basis.span_begin(i + 1);
      assert(a <= 2 * b && b <= 2 * a);
    }
  }
}

// the unit tangent of the boundary of the target, by a difference quotient
synthetic::Vector tangent(const synthetic::Target& target, std::size_t quad, int side, double t)
{
  const double h = 1e-4;
  const auto before = internal::from_side<double>(side, t - h, 0.);
  const auto after = internal::from_side<double>(side, t + h, 0.);
  const synthetic::Vector d
    = target.point(quad, after[0], after[1]) - target.point(quad, before[0], before[1]);
  return d / std::sqrt(d.squared_length());
}

// checks the parts of an error against the largest ones of the report, which are those at samples
void check_parts(const synthetic::Vector& error, const synthetic::Vector& tangent,
                 const SC::Conversion_report::Boundary& boundary)
{
  const double allowance = 0.05 * boundary.max_parametric_deviation;
  const double along = error * tangent;
  assert(std::abs(along) <= boundary.max_tangential_part + allowance);
  assert(std::sqrt((error - along * tangent).squared_length())
         <= boundary.max_normal_part + allowance);
}

void test_surface(const synthetic::Surface& shape, double jitter, SC::Error_metric metric)
{
  const int m = 8, n = 5;
  synthetic::Input input(shape, m, n, 4, synthetic::jittered(m, n, jitter));
  const synthetic::Target& target = input.target();
  synthetic::Tensor_product_surface surface(input.layout(), m, n, shape.is_periodic);
  SC::Conversion_report report;
  const double tolerance = 1e-7 * target.diameter();
  const SC::Error_code code
    = SC::fit_boundary(surface, target, report, CGAL::parameters::boundary_tolerance(tolerance)
                                                  .error_metric(metric));
  assert(code == SC::Error_code::OK && report.boundary.certified_bound < tolerance);
  // sewing adds the deviations of two faces from their common edge
  assert(metric == SC::Error_metric::PARAMETRIC
         || report.boundary.certified_bound < tolerance / 2);
  assert(report.iterations.back().boundary_hausdorff <= report.boundary.certified_bound);
  assert(report.iterations.size() <= 3 && report.iterations.back().stage == "fit_boundary");
  double worst = 0;
  for(std::size_t q = 0; q < input.layout().number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
      for(int k = 0; input.layout().is_border(q, i) && k <= 40; ++k)
      {
        const auto uv = internal::from_side<double>(i, k / 40., 0.);
        const auto p = surface.position(surface.patch_at(q, uv[0], uv[1]), uv[0], uv[1]);
        const double parametric = std::sqrt(squared_distance(p, target.point(q, uv[0], uv[1])));
        assert(parametric <= report.boundary.max_parametric_deviation * 1.05);
        const std::size_t chain = input.layout().boundary_side(q, i).chain;
        check_parts(p - target.point(q, uv[0], uv[1]),
                    tangent(target, q, i, (std::min)((std::max)(k / 40., 1e-3), 1 - 1e-3)),
                    report.boundary);
        worst = (std::max)(worst, metric == SC::Error_metric::PARAMETRIC
                                    ? parametric : target.network().project(chain, p).distance);
      }
  assert(worst > 0 && worst <= report.boundary.certified_bound);
  const SC::Conversion_report::Boundary& b = report.boundary;
  assert(b.max_normal_part <= b.max_parametric_deviation
         && b.max_tangential_part <= b.max_parametric_deviation);
  assert(b.max_parametric_deviation
         <= 1.05 * std::hypot(b.max_normal_part, b.max_tangential_part));
}

// a target the curves of which pass through the seams of their surfaces
class Target_with_seams : public synthetic::Target
{
public:
  struct Network : public synthetic::Network
  {
    explicit Network(const synthetic::Network& network) : synthetic::Network(network) {}

    std::vector<double> surface_seams(std::size_t c) const
    {
      return {0.123 * length(c), 0.71 * length(c)};
    }
  };

  explicit Target_with_seams(const synthetic::Target& target)
    : synthetic::Target(target), m_network(target.network())
  {}

  const Network& network() const { return m_network; }

private:
  Network m_network;
};

// the distance between a point and the side `i` of a quad, by nested intervals
double distance_from_side(const synthetic::Tensor_product_surface& surface, std::size_t q, int i,
                          const synthetic::Point& p)
{
  const auto distance = [&](double t)
  {
    const auto uv = internal::from_side<double>(i, (std::min)((std::max)(t, 0.), 1.), 0.);
    return std::sqrt(squared_distance(p, surface.position(surface.patch_at(q, uv[0], uv[1]),
                                                          uv[0], uv[1])));
  };
  double best = 0.5;
  for(double step = 0.05; step > 1e-9; step /= 4)
  {
    const double middle = best;
    for(int k = -10; k <= 10; ++k)
      if(distance(middle + k * step) < distance(best))
        best = middle + k * step;
  }
  return distance(best);
}

// returns the largest distance of the seams from the boundary of the surface fitted to a target,
// relative to the error of the boundary
template <typename Target>
double largest_distance_of_seams(const synthetic::Input& input, const Target& target, int m, int n)
{
  synthetic::Tensor_product_surface surface(input.layout(), m, n, false);
  SC::Conversion_report report;
  assert(SC::fit_boundary(surface, target, report, CGAL::parameters::boundary_tolerance(1e-4))
         == SC::Error_code::OK);
  const Target_with_seams seams(input.target());
  double result = 0;
  for(std::size_t c = 0; c < input.network().number_of_chains(); ++c)
    for(double s : seams.network().surface_seams(c))
    {
      double distance = 1;
      for(std::size_t q = 0; q < input.layout().number_of_quads(); ++q)
        for(int i = 0; i < 4; ++i)
          if(input.layout().is_border(q, i))
            distance = (std::min)(distance, distance_from_side(surface, q, i,
                                                               input.network().point(c, s)));
      result = (std::max)(result, distance);
    }
  return result / report.boundary.certified_bound;
}

// The boundary passes through the seams of the surfaces of its curves.
void test_seams()
{
  const int m = 8, n = 5;
  const synthetic::Input input(synthetic::height_field(0.3), m, n, 4,
                               synthetic::jittered(m, n, 0.5));
  assert(largest_distance_of_seams(input, input.target(), m, n) > 0.1);
  assert(largest_distance_of_seams(input, Target_with_seams(input.target()), m, n) < 1e-3);
}

// However small the tolerance is, the fit ends, and keeps the limit of the patches.
void test_limits()
{
  const int m = 8, n = 5;
  synthetic::Input input(synthetic::height_field(0.3), m, n, 4, synthetic::jittered(m, n, 0.5));
  const CGAL::Surface_mesh_spline_conversion::Quad_layout<synthetic::Kernel>& layout
    = input.layout();
  SC::Conversion_report report;
  double last_bound = 1;
  for(std::size_t limit : {0, 60, 150, 300})
  {
    CGAL::T_NURCC_surface_3<synthetic::Kernel> surface(layout);
    const std::size_t size = surface.number_of_patches();
    assert(SC::fit_boundary(surface, input.target(), report,
                            CGAL::parameters::boundary_tolerance(1e-11)
                              .maximum_number_of_patches(limit))
           == SC::Error_code::TOLERANCE_NOT_REACHED);
    assert(surface.number_of_patches() <= (std::max)(limit, size) && !report.message.empty());
    // and each larger one is of use
    assert(report.boundary.certified_bound < 0.3 * last_bound);
    last_bound = report.boundary.certified_bound;
  }
  CGAL::T_NURCC_surface_3<synthetic::Kernel> surface(layout);
  for(double bad : {0., -1., 1e-300, 1e-17, std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::quiet_NaN()})
  {
    assert(SC::fit_boundary(surface, input.target(), report,
                            CGAL::parameters::boundary_tolerance(bad))
           == SC::Error_code::INVALID_PARAMETER);
    assert(report.message.find("boundary tolerance") != std::string::npos);
  }
}

int main()
{
  test_basis(open_knots(5));
  test_basis(periodic_knots(5));
  Chain_knots with_multiple_knots = open_knots(4);
  with_multiple_knots.knots.insert(with_multiple_knots.knots.begin() + 5, 2, 1.5);
  std::sort(with_multiple_knots.knots.begin(), with_multiple_knots.knots.end());
  test_basis(with_multiple_knots);
  test_convergence(true);
  test_convergence(false);
  test_ends();
  test_number_of_segments();
  test_noise();
  test_limits();
  test_balance();
  test_evenness();
  test_joints(true);
  test_joints(false);
  test_shape(true);
  test_shape(false);
  test_seams();
  for(double jitter : {0., 0.5})
    for(auto metric : {SC::Error_metric::PARAMETRIC, SC::Error_metric::REPROJECTED})
    {
      test_surface(synthetic::height_field(0.3), jitter, metric);
      test_surface(synthetic::torus_band(2, 0.5), jitter, metric);
    }
  return 0;
}
