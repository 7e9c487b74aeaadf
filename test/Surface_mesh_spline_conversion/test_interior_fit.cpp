// The interior fit: convergence order on a smooth target, the effect of re-projection on a kinked
// parametrization, normals above corners of the boundary, steps, limits and interruption.
#include "tensor_product_surface.h"

#include <CGAL/Surface_mesh_spline_conversion/fit_boundary.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_interior.h>
#include <CGAL/T_NURCC_surface_3.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

using namespace synthetic;
namespace params = CGAL::parameters;

typedef CGAL::T_NURCC_surface_3<Kernel> T_NURCC_surface;

// a target without a mesh: the parametric surface itself
struct Smooth_target
{
  typedef Kernel::FT FT;
  typedef Kernel::Point_3 Point_3;
  typedef synthetic::Layout Layout;

  const Input& input;
  const Surface& shape;

  const Layout& layout() const { return input.layout(); }
  double diameter() const { return input.target().diameter(); }
  double quad_size(std::size_t q) const { return input.target().quad_size(q); }
  std::size_t number_of_chains() const { return input.target().number_of_chains(); }
  std::size_t number_of_sides(std::size_t c) const { return input.target().number_of_sides(c); }
  double arc_length(std::size_t c, double x) const { return input.target().arc_length(c, x); }
  double speed(std::size_t c, double x) const { return input.target().speed(c, x); }
  const auto& network() const { return input.target().network(); }

  std::array<double, 2> place(std::size_t chain, double x, Vector& direction) const
  {
    const auto sides = layout().chain_sides(chain);
    const std::size_t k = (std::min)(std::size_t(x), sides.size() - 1);
    const auto uv = SC::internal::from_side<double>(sides[k].second, x - double(k), 0.);
    const auto next = SC::internal::from_side<double>(sides[k].second, 1., 0.);
    const auto first = SC::internal::from_side<double>(sides[k].second, 0., 0.);
    const auto a = input.parameters(sides[k].first, next[0], next[1]);
    const auto b = input.parameters(sides[k].first, first[0], first[1]);
    direction = Vector(a[0] - b[0], a[1] - b[1], 0);
    return input.parameters(sides[k].first, uv[0], uv[1]);
  }

  Point curve_point(std::size_t chain, double x) const
  {
    Vector direction;
    const auto ab = place(chain, x, direction);
    return shape.point(ab[0], ab[1]);
  }

  Vector curve_derivative(std::size_t chain, double x, int) const
  {
    Vector d;
    const auto ab = place(chain, x, d);
    return d.x() * shape.derivative(ab[0], ab[1], 1, 0)
           + d.y() * shape.derivative(ab[0], ab[1], 0, 1);
  }

  Point point(std::size_t quad, double u, double v) const
  {
    const auto ab = input.parameters(quad, u, v);
    return shape.point(ab[0], ab[1]);
  }

  Point point(std::size_t quad, double u, double v, std::size_t& face) const
  {
    face = 0;
    return point(quad, u, v);
  }

  Point foot_point(const Point&, std::size_t, double, double, const Point& start,
                   std::size_t, std::size_t&) const
  {
    return start;
  }

  bool is_on_mesh(std::size_t, double, double) const { return true; }
  std::size_t number_of_mesh_faces() const { return 0; }
  std::size_t number_of_mesh_points() const { return 0; }
  std::array<std::size_t, 6> points_of_mesh_face(std::size_t) const { return {}; }
  Point mesh_point(std::size_t) const { return Point(0, 0, 0); }
};

template <typename FitSurface>
void test_convergence(const Surface& shape)
{
  const Input input(shape, 6, 6, 1);
  const Smooth_target target{input, shape};
  FitSurface surface(input.layout());
  // one fit without refinement
  const auto np = params::interior_tolerance(1e-9).boundary_tolerance(target.diameter())
                  .error_metric(SC::Error_metric::PARAMETRIC).maximum_number_of_patches(1);
  double last = 0;
  for(int level = 0; level < 3; ++level)
  {
    if(level > 0)
      surface.refine_uniformly();
    SC::Conversion_report report;
    assert(SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK);
    assert(SC::fit_interior(surface, target, report, np)
           == SC::Error_code::TOLERANCE_NOT_REACHED);
    // order 4 means a factor of 16
    const double error = report.interior.max_deviation;
    assert(level == 0 || last / error > 11);
    last = error;
  }
}

// A shape with detail in one place is refined there only, and measured in another way: against the
// shape itself between the samples.
void test_local_refinement()
{
  const Surface shape = hill();
  const Input input(shape, 8, 8, 1);
  const Smooth_target target{input, shape};
  T_NURCC_surface surface(input.layout());
  SC::Conversion_report report;
  const double tolerance = 1e-4 * target.diameter();
  const auto np = params::interior_tolerance(tolerance).boundary_tolerance(target.diameter())
                  .error_metric(SC::Error_metric::PARAMETRIC);
  assert(SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK);
  assert(SC::fit_interior(surface, target, report, np) == SC::Error_code::OK);
  assert(surface.is_valid());
  std::size_t smallest = 0, far = 0;
  double size = 1;
  for(std::size_t p = 0; p < surface.number_of_patches(); ++p)
  {
    const auto o = surface.patch_origin(p);
    size = (std::min)(size, o.u1 - o.u0);
    const auto ab = input.parameters(o.quad, (o.u0 + o.u1) / 2, (o.v0 + o.v1) / 2);
    const bool is_far = std::hypot(ab[0] - 0.5, ab[1] - 0.5) > 0.45;
    far += is_far ? 1 : 0;
    smallest += is_far && o.u1 - o.u0 < 0.5 ? 1 : 0;
    for(double s : {0.21, 0.68})
      for(double t : {0.33, 0.81})
      {
        const double u = o.u0 + s * (o.u1 - o.u0), v = o.v0 + t * (o.v1 - o.v0);
        const auto q = surface.position(p, u, v) - target.point(o.quad, u, v);
        assert(std::sqrt(q.squared_length()) < 1.1 * tolerance);
      }
  }
  assert(size <= 0.25 && far > 0 && smallest == 0);
}

// A fit that has met its tolerance goes on at a place where someone else finds too much.
void test_improvement()
{
  typedef SC::internal::Interior_fitter<T_NURCC_surface, Smooth_target, SC::Default_visitor> Fitter;
  const Surface shape = hill();
  const Input input(shape, 8, 8, 1);
  const Smooth_target target{input, shape};
  T_NURCC_surface surface(input.layout());
  SC::Conversion_report report;
  SC::Default_visitor visitor;
  const double d = target.diameter();
  const auto np = params::interior_tolerance(d).boundary_tolerance(d);
  assert(SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK);
  report = SC::Conversion_report();
  Fitter fitter(surface, target, SC::internal::interior_fit_options(target, np),
                SC::internal::boundary_fit_options(target, np),
                SC::internal::Boundary_normals<Smooth_target>(), visitor, report);
  assert(fitter() == SC::Error_code::OK && surface.number_of_patches() == 64);
  const std::size_t quad = 3 * 8 + 4;
  const Point place = surface.position(surface.patch_at(quad, 0.3, 0.6), 0.3, 0.6);
  assert(fitter.improve({place, place}, {}) == SC::Error_code::OK);
  const auto is_whole = [&surface](std::size_t q)
  {
    const auto o = surface.patch_origin(surface.patch_at(q, 0.3, 0.6));
    return o.u0 == 0 && o.v0 == 0 && o.u1 == 1 && o.v1 == 1;
  };
  assert(surface.is_valid() && !is_whole(quad) && is_whole(0) && is_whole(63));
  // a corner of four patches
  assert(is_whole(18) && is_whole(9));
  assert(fitter.improve({}, {surface.position(surface.patch_at(18, 0, 0), 0, 0)})
         == SC::Error_code::OK);
  for(std::size_t q : {9, 10, 17, 18})
    assert(!is_whole(q));
  assert(surface.is_valid() && is_whole(0) && is_whole(63));
  std::vector<std::size_t> iterations;
  for(const auto& entry : report.iterations)
    if(entry.stage == "fit_interior")
      iterations.push_back(entry.iteration);
  assert((iterations == std::vector<std::size_t>{0, 1, 2}));

  // coarsening, however often it is tried, leaves as many refinements as there were
  for(int i = 0; i < 24; ++i)
    assert(fitter.coarsen() == SC::Error_code::OK);
  const std::size_t size = surface.number_of_patches();
  assert(fitter.improve({place}, {}) == SC::Error_code::OK && surface.number_of_patches() > size);
}

// the largest distance at equal parameters, at points that are no samples of the fit
double distance_between_samples(const T_NURCC_surface& surface, const Smooth_target& target)
{
  double result = 0;
  for(std::size_t p = 0; p < surface.number_of_patches(); ++p)
  {
    const auto o = surface.patch_origin(p);
    for(double s : {0.06, 0.29, 0.57, 0.91})
      for(double t : {0.11, 0.44, 0.68, 0.97})
      {
        const double u = o.u0 + s * (o.u1 - o.u0), v = o.v0 + t * (o.v1 - o.v0);
        const Vector d = surface.position(p, u, v) - target.point(o.quad, u, v);
        result = (std::max)(result, std::sqrt(d.squared_length()));
      }
  }
  return result;
}

// A surface that was refined everywhere becomes coarser where the tolerance allows it, and then has
// about as many patches as one that was not; one that cannot become coarser is kept. The report
// tells the errors of the surface that remains. The quads are no squares: with equal errors on both
// sides of a diagonal, rounding would decide which patches are split and merged.
void test_coarsening()
{
  const Surface shape = hill();
  const Input input(shape, 8, 9, 1);
  const Smooth_target target{input, shape};
  const double tolerance = 1e-4 * target.diameter();
  const auto fit = [&](T_NURCC_surface& surface, SC::Conversion_report& report, bool do_coarsen)
  {
    const auto np = params::interior_tolerance(tolerance).boundary_tolerance(target.diameter())
                    .error_metric(SC::Error_metric::PARAMETRIC).do_coarsen_patches(do_coarsen);
    assert(SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK);
    assert(SC::fit_interior(surface, target, report, np) == SC::Error_code::OK);
  };
  std::size_t patches_from_coarse = 0;
  for(const bool is_fine : {false, true})
  {
    T_NURCC_surface fitted(input.layout()), coarsened(input.layout());
    SC::Conversion_report report, report_of_coarsened;
    if(is_fine)
    {
      fitted.refine_uniformly();
      coarsened.refine_uniformly();
    }
    fit(fitted, report, false);
    fit(coarsened, report_of_coarsened, true);
    assert(coarsened.is_valid());
    assert(coarsened.number_of_patches() <= fitted.number_of_patches());
    assert(coarsened.number_of_control_points() <= fitted.number_of_control_points());
    if(is_fine)
      assert(3 * coarsened.number_of_patches() < 2 * fitted.number_of_patches()
             && 10 * coarsened.number_of_patches() < 11 * patches_from_coarse);
    else
      patches_from_coarse = coarsened.number_of_patches();
    const double error = distance_between_samples(coarsened, target);
    assert(error < 1.1 * tolerance);
    assert(report_of_coarsened.interior.max_deviation < tolerance
           && error < 1.1 * report_of_coarsened.interior.max_deviation);
  }
}

// After a refinement in one place the far control points keep their places, the near ones do not,
// and the error is that of a measurement from nothing.
void test_local_fit()
{
  typedef SC::internal::Interior_fitter<T_NURCC_surface, synthetic::Target, SC::Default_visitor>
    Fitter;
  typedef SC::internal::Interior_samples<T_NURCC_surface, synthetic::Target> Samples;
  const int n = 16;
  const Input input(hill(), n, n, 4, jittered(n, n, 0.3));
  const synthetic::Target& target = input.target();
  T_NURCC_surface surface(input.layout());
  SC::Conversion_report report;
  SC::Default_visitor visitor;
  const double d = target.diameter();
  const auto np = params::interior_tolerance(d).boundary_tolerance(d);
  assert(SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK);
  Fitter fitter(surface, target, SC::internal::interior_fit_options(target, np),
                SC::internal::boundary_fit_options(target, np),
                SC::internal::Boundary_normals<synthetic::Target>(), visitor, report);
  assert(fitter() == SC::Error_code::OK);
  std::vector<Point> before;
  for(std::size_t i = 0; i < surface.number_of_control_points(); ++i)
    before.push_back(surface.control_point(i));
  const std::size_t quad = 4 * n + 4;
  const Point place = surface.position(surface.patch_at(quad, 0.5, 0.5), 0.5, 0.5);
  assert(fitter.improve({place}, {}) == SC::Error_code::OK);
  std::size_t moved = 0;
  for(std::size_t i = 0; i < before.size(); ++i)
    if(surface.control_point(i) != before[i])
    {
      ++moved;
      assert(std::sqrt(CGAL::squared_distance(before[i], place)) < 0.4 * d);
    }
  assert(10 < moved && moved < before.size() / 2);
  const Samples samples(surface, target, nullptr);
  const double error = SC::internal::Interior_error<T_NURCC_surface, synthetic::Target>(
    surface, target, samples, false, nullptr).largest().error;
  assert(std::abs(error - report.interior.max_deviation) < 1e-12 * d);
}

// Larger weights of the patches that violate a tolerance by little leave fewer of them; the errors
// are those of a measurement from nothing, and the boundary stays where it is.
void test_reweighted_fit()
{
  typedef SC::internal::Interior_samples<T_NURCC_surface, synthetic::Target> Samples;
  typedef SC::internal::Interior_error<T_NURCC_surface, synthetic::Target> Errors;
  const int n = 6;
  const Input input(hill(), n, n, 16, jittered(n, n, 0.3));
  const synthetic::Target& target = input.target();
  T_NURCC_surface surface(input.layout());
  SC::Conversion_report report;
  const double d = target.diameter();
  const auto np = params::interior_tolerance(d).boundary_tolerance(d);
  assert(SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK);
  assert(SC::fit_interior(surface, target, report, np) == SC::Error_code::OK);
  std::vector<bool> is_fixed(surface.number_of_control_points(), false);
  for(std::size_t c = 0; c < surface.number_of_boundary_chains(); ++c)
    for(std::size_t i : surface.boundary_curve(c).control_points)
      is_fixed[i] = true;
  std::vector<Point> before;
  for(std::size_t i = 0; i < is_fixed.size(); ++i)
    before.push_back(surface.control_point(i));

  Samples samples(surface, target, nullptr);
  Errors errors(surface, target, samples, false, nullptr);
  const double largest = errors.largest().error, tolerance = 0.8 * largest;
  const std::size_t violations = errors.errors(tolerance).size();
  assert(violations > 0);
  SC::internal::Reweighted_fit<T_NURCC_surface, synthetic::Target>(
    surface, target, samples, is_fixed, tolerance)(errors, 1e-6);
  assert(errors.errors(tolerance).size() < violations && errors.largest().error < largest);
  for(std::size_t i = 0; i < is_fixed.size(); ++i)
    assert(!is_fixed[i] || surface.control_point(i) == before[i]);
  const Samples again(surface, target, nullptr);
  assert(std::abs(Errors(surface, target, again, false, nullptr).largest().error
                  - errors.largest().error) < 1e-12 * d);
}

// a face of a mesh whose vertices lie on the shape, and the middle of one of its edges above it
struct Target_with_far_edge : Smooth_target
{
  static constexpr double height = 0.05;

  bool is_on_mesh(std::size_t, double, double) const { return true; }
  std::size_t number_of_mesh_faces() const { return 1; }
  std::size_t number_of_mesh_points() const { return 4; }

  std::array<std::size_t, 6> points_of_mesh_face(std::size_t) const
  {
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    return {{0, 1, 2, none, 3, none}};
  }

  Point mesh_point(std::size_t i) const
  {
    const double a[] = {0.3, 0.7, 0.5, 0.43}, b[] = {0.3, 0.4, 0.7, 0.57};
    const Vector du = shape.derivative(a[i], b[i], 1, 0), dv = shape.derivative(a[i], b[i], 0, 1);
    const Vector normal = CGAL::cross_product(du, dv);
    return shape.point(a[i], b[i])
           + (i == 3 ? height / std::sqrt(normal.squared_length()) : 0) * normal;
  }
};

// The distance of the middle of an edge of the mesh from the surface counts.
void test_error_at_edge()
{
  typedef SC::internal::Interior_samples<T_NURCC_surface, Target_with_far_edge> Samples;
  typedef SC::internal::Interior_error<T_NURCC_surface, Target_with_far_edge> Errors;
  const Surface shape = height_field(0.3);
  const Input input(shape, 6, 6, 1);
  const Target_with_far_edge target{{input, shape}};
  T_NURCC_surface surface(input.layout());
  SC::Conversion_report report;
  const double d = target.diameter();
  const auto np = params::interior_tolerance(d).boundary_tolerance(1e-4 * d);
  assert(SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK);
  assert(SC::fit_interior(surface, target, report, np) == SC::Error_code::OK);
  const Samples samples(surface, target, nullptr);
  const SC::internal::Largest_error largest
    = Errors(surface, target, samples, false, nullptr).largest();
  assert(std::abs(largest.error - target.height) < 0.01 * target.height);
  const Point place(largest.place[0], largest.place[1], largest.place[2]);
  assert(CGAL::squared_distance(place, target.mesh_point(3)) < 1e-20);
}

// largest distance at equal parameters on a quad of a surface that has not been refined
double distance_on_quad(const T_NURCC_surface& surface, const Smooth_target& target,
                        std::size_t quad)
{
  double result = 0;
  for(int k = 0; k < 81; ++k)
  {
    const double u = k % 9 / 8., v = k / 9 / 8.;
    const Vector d = surface.position(surface.patch_at(quad, u, v), u, v) - target.point(quad, u, v);
    result = (std::max)(result, std::sqrt(d.squared_length()));
  }
  return result;
}

// Larger weights of a patch nearly always lower its largest distance, although they act on the squares
// of all of them, and the tolerance is still met everywhere. There are no further patches.
void test_move_closer()
{
  typedef SC::internal::Interior_fitter<T_NURCC_surface, Smooth_target, SC::Default_visitor> Fitter;
  const int n = 8;
  const Surface shape = hill();
  const Input input(shape, n, n, 1);
  const Smooth_target target{input, shape};
  const double d = target.diameter();
  double tolerance = d;
  int closer = 0;
  for(const double factor : {1., 1.001}) // the first fit tells the largest error
  {
    T_NURCC_surface surface(input.layout());
    SC::Conversion_report report;
    SC::Default_visitor visitor;
    const auto np = params::interior_tolerance(factor * tolerance).boundary_tolerance(d);
    assert(SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK);
    Fitter fitter(surface, target, SC::internal::interior_fit_options(target, np),
                  SC::internal::boundary_fit_options(target, np),
                  SC::internal::Boundary_normals<Smooth_target>(), visitor, report);
    assert(fitter() == SC::Error_code::OK);
    tolerance = report.interior.max_deviation;
    for(std::size_t quad = 0; factor > 1 && quad < n * n; ++quad)
    {
      const double before = distance_on_quad(surface, target, quad);
      const std::size_t fixed = surface.boundary_curve(0).control_points[1];
      const Point boundary = surface.control_point(fixed);
      const Point place = surface.position(surface.patch_at(quad, 0.5, 0.5), 0.5, 0.5);
      const bool is_closer = fitter.move_closer({place});
      const double after = distance_on_quad(surface, target, quad);
      assert(surface.number_of_patches() == n * n && surface.control_point(fixed) == boundary);
      assert(is_closer || after == before);
      closer += after < before ? 1 : 0;
      for(std::size_t q = 0; q < n * n; ++q)
        assert(distance_on_quad(surface, target, q) < factor * tolerance);
    }
  }
  assert(10 * closer > 8 * n * n);
}

struct Reference_surface : Tensor_product_surface
{
  explicit Reference_surface(const Layout& layout) : Tensor_product_surface(layout, 6, 6, false) {}
};

// a smooth shape with a parametrization that has kinks
void test_reprojection()
{
  const Surface shape = height_field(0.3);
  const Input input(shape, 8, 5, 16, jittered(8, 5, 0.3));
  const double d = input.target().diameter();
  const std::size_t maximum = 700;
  auto fit = [&](SC::Error_metric metric, SC::Conversion_report& report, T_NURCC_surface& surface)
  {
    const auto np = params::boundary_tolerance(2e-5 * d).interior_tolerance(4e-4 * d)
                    .error_metric(metric).maximum_number_of_patches(maximum);
    assert(SC::fit_boundary(surface, input.target(), report, np) == SC::Error_code::OK);
    return SC::fit_interior(surface, input.target(), report, np);
  };
  SC::Conversion_report parametric, reprojected;
  T_NURCC_surface a(input.layout()), b(input.layout());
  assert(fit(SC::Error_metric::PARAMETRIC, parametric, a) == SC::Error_code::TOLERANCE_NOT_REACHED);
  assert(parametric.interior.max_deviation > 1e-3 * d && !parametric.message.empty());
  assert(fit(SC::Error_metric::REPROJECTED, reprojected, b) == SC::Error_code::OK);
  assert(b.is_valid());
  // measured in another way: against the function itself
  for(std::size_t p = 0; p < b.number_of_patches(); ++p)
    for(double s : {0.1, 0.35, 0.6, 0.85})
      for(double t : {0.15, 0.4, 0.7, 0.95})
      {
        const auto o = b.patch_origin(p);
        const Point q = b.position(p, o.u0 + s * (o.u1 - o.u0), o.v0 + t * (o.v1 - o.v0));
        assert(std::abs(q.z() - shape.point(q.x(), q.y()).z()) < 5e-4 * d);
      }
}

// largest angle between the normals on both sides of the line above the corner, in degrees
double normal_angle(const T_NURCC_surface& surface, int m)
{
  double sine = 0;
  for(int k = 0; k < 64; ++k)
  {
    const double y = 2 * k / 64., v = y - std::floor(y);
    const std::size_t left = std::size_t(y) * m + m / 2 - 1, right = left + 1;
    const Vector a = surface.normal(surface.patch_at(left, 1, v), 1, v);
    const Vector b = surface.normal(surface.patch_at(right, 0, v), 0, v);
    sine = (std::max)(sine, std::sqrt(CGAL::cross_product(a, b).squared_length()
                                      / (a.squared_length() * b.squared_length())));
  }
  return std::asin(sine) * 90 / std::acos(0.);
}

void test_corner()
{
  const int m = 6;
  const Input input(notched_graph(), m, 4, 16);
  const double d = input.target().diameter();
  T_NURCC_surface surface(input.layout());
  SC::Conversion_report report;
  const auto np = params::boundary_tolerance(1e-4 * d).interior_tolerance(2e-3 * d);
  assert(SC::fit_boundary(surface, input.target(), report, np) == SC::Error_code::OK);
  assert(SC::fit_interior(surface, input.target(), report, np) == SC::Error_code::OK);
  assert(normal_angle(surface, m) < 0.5);
}

// No surface follows a step of the target. Refinement ends there, and the report names the place.
void test_step()
{
  const double radius = 0.2, height = 0.1;
  const auto distance = [](double a, double b) { return std::hypot(a - 0.5, b - 0.5); };
  Surface shape = height_field(0);
  shape.point = [&](double a, double b)
    { return Point(a, b, distance(a, b) < radius ? height : 0); };
  const Input input(shape, 6, 6, 1);
  const Smooth_target target{input, shape};
  T_NURCC_surface surface(input.layout());
  SC::Conversion_report report;
  const auto np = params::interior_tolerance(1e-3).boundary_tolerance(1e-3);
  assert(SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK);
  assert(SC::fit_interior(surface, target, report, np) == SC::Error_code::TOLERANCE_NOT_REACHED);
  assert(surface.is_valid() && surface.number_of_patches() < 5000); // without end otherwise
  assert(report.message.find("near the point") != std::string::npos);
  const auto& worst = report.interior.worst;
  assert(std::abs(distance(worst[0], worst[1]) - radius) < 0.1);
}

struct Stopping_visitor : SC::Default_visitor
{
  int calls = 0, last_call;
  explicit Stopping_visitor(int last_call) : last_call(last_call) {}
  bool go_further() { return ++calls < last_call; }
};

void test_limits()
{
  const Input input(height_field(0.3), 5, 4, 3);
  T_NURCC_surface surface(input.layout());
  SC::Conversion_report report;
  for(double bad : {0., -1., 1e-300, std::numeric_limits<double>::infinity(), std::nan("")})
  {
    assert(SC::fit_boundary(surface, input.target(), report, params::boundary_tolerance(bad))
           == SC::Error_code::INVALID_PARAMETER);
    assert(SC::fit_interior(surface, input.target(), report, params::interior_tolerance(bad))
           == SC::Error_code::INVALID_PARAMETER);
  }
  for(int calls : {1, 2})
  {
    Stopping_visitor visitor(calls);
    assert(SC::fit_interior(surface, input.target(), report, params::visitor(std::ref(visitor)))
           == SC::Error_code::INTERRUPTED);
    assert(visitor.calls == calls);
  }
  Stopping_visitor visitor(1);
  assert(SC::fit_boundary(surface, input.target(), report, params::visitor(std::ref(visitor)))
         == SC::Error_code::INTERRUPTED);
  // below the size of the facets nothing helps; the surface stays valid
  assert(SC::fit_boundary(surface, input.target(), report) == SC::Error_code::OK);
  assert(SC::fit_interior(surface, input.target(), report,
                          params::interior_tolerance(1e-7).maximum_number_of_patches(300))
         == SC::Error_code::TOLERANCE_NOT_REACHED);
  assert(surface.is_valid() && report.interior.max_deviation > 1e-7 && !report.message.empty());
}

int main()
{
  test_convergence<Reference_surface>(height_field(0.3));
  test_convergence<T_NURCC_surface>(height_field(0.3));
  test_local_refinement();
  test_improvement();
  test_coarsening();
  test_local_fit();
  test_reweighted_fit();
  test_error_at_edge();
  test_move_closer();
  test_reprojection();
  test_corner();
  test_step();
  test_limits();
  return 0;
}
