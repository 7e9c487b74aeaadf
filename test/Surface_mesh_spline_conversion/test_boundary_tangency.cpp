// Tangency to the faces beyond the boundary: to planes and spheres, along some of the curves, and
// at corners that exclude it.
#include "synthetic_layout.h"

#include <CGAL/Surface_mesh_spline_conversion/Curve_on_surface_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_boundary.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_interior.h>
#include <CGAL/T_NURCC_surface_3.h>

#include <cassert>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>

using namespace synthetic;
namespace params = CGAL::parameters;

typedef CGAL::T_NURCC_surface_3<Kernel> T_NURCC_surface;
typedef std::function<Vector(const Point&)> Normal_at;

struct Normal_functor
{
  Normal_at normal;

  Vector operator()(const Curve_traits::Curve_3& c, double t) const { return normal(c.point(t)); }
};

Vector unit(const Vector& v) { return v / std::sqrt(v.squared_length()); }

double angle(const Vector& a, const Vector& b)
{
  return std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), std::abs(a * b));
}

// the largest angle between the surface and the normals where there are any, in radians
double largest_angle(const Input& input, const T_NURCC_surface& surface, const Normal_at& normal)
{
  double result = 0;
  const Layout& layout = input.layout();
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
      for(int k = 0; layout.is_border(q, i) && k <= 50; ++k)
      {
        const auto uv = SC::internal::from_side<double>(i, k / 50., 0.);
        const std::size_t patch = surface.patch_at(q, uv[0], uv[1]);
        const Vector n = normal(surface.position(patch, uv[0], uv[1]));
        if(n.squared_length() > 0)
          result = (std::max)(result, angle(n, surface.normal(patch, uv[0], uv[1])));
      }
  return result;
}

SC::Conversion_report fit(const Input& input, T_NURCC_surface& surface, const Normal_at& normal,
                          double interior_tolerance)
{
  SC::Conversion_report report;
  const double d = input.target().diameter();
  const auto np = params::boundary_tolerance(1e-10 * d).interior_tolerance(interior_tolerance * d)
                  .boundary_tangency(Normal_functor{normal});
  assert(SC::fit_boundary(surface, input.target(), report, np) == SC::Error_code::OK);
  assert(SC::fit_interior(surface, input.target(), report, np) == SC::Error_code::OK);
  return report;
}

constexpr double DEGREE = 0.0174532925199433;

// a band between two circles that is to be tangent to a face with these normals along the upper one
void test_band(const std::string& name, const Normal_at& normal, double angle_before)
{
  const Input input(torus_band(2, 0.6), 64, 6, 2);
  const Normal_at upper
    = [&normal](const Point& p) { return p.z() > 0 ? unit(normal(p)) : Vector(0, 0, 0); };
  const Normal_at none = [](const Point&) { return Vector(0, 0, 0); };
  T_NURCC_surface free_surface(input.layout()), surface(input.layout());
  const SC::Conversion_report without = fit(input, free_surface, none, 2e-3);
  assert(without.smoothness.tangency_conflicts == 0);
  std::cout << name << ": angle without condition " << largest_angle(input, free_surface, upper)
            << std::endl;
  assert(largest_angle(input, free_surface, upper) > angle_before);
  const SC::Conversion_report report = fit(input, surface, upper, 5e-2);
  const double angle = largest_angle(input, surface, upper);
  std::cout << name << ": angle " << angle << " radians, reported "
            << report.smoothness.max_tangency_angle_degrees << " degrees, interior "
            << report.interior.max_deviation << std::endl;
  assert(angle < 1e-6);
  assert(report.smoothness.max_tangency_angle_degrees < 1e-6 / DEGREE);
  assert(report.smoothness.max_tangency_angle_degrees > 0.9 * angle / DEGREE - 1e-7);
  assert(report.smoothness.tangency_conflicts == 0);
}

// Along all sides of a square, the normals of the shape itself are compatible with all corners.
// They must not make the fit worse.
void test_compatible_corners()
{
  const Surface shape = height_field(0.3);
  const Input input(shape, 24, 24, 2);
  const Normal_at normal = [&shape](const Point& p)
  {
    return unit(CGAL::cross_product(shape.derivative(p.x(), p.y(), 1, 0),
                                    shape.derivative(p.x(), p.y(), 0, 1)));
  };
  T_NURCC_surface surface(input.layout());
  const SC::Conversion_report report = fit(input, surface, normal, 1e-3);
  std::cout << "compatible corners: angle " << largest_angle(input, surface, normal) << std::endl;
  assert(report.smoothness.tangency_conflicts == 0);
  assert(largest_angle(input, surface, normal) < 1e-6);
}

// A horizontal plane along one side is not that of the corners at its ends; it is reached in
// between.
void test_incompatible_corners()
{
  const Input input(height_field(0.3), 24, 24, 2);
  const auto normal = [](const Curve_traits::Curve_3& c, double t)
  {
    const bool is_lower = c.point(t).y() < 1e-9 && std::abs(c.derivative(t, 1).y()) < 1e-9;
    return Vector(0, 0, is_lower ? 1 : 0);
  };
  T_NURCC_surface surface(input.layout());
  SC::Conversion_report report;
  const auto np = params::boundary_tangency(normal);
  assert(SC::fit_boundary(surface, input.target(), report) == SC::Error_code::OK);
  SC::fit_interior(surface, input.target(), report, np.maximum_number_of_patches(1));
  assert(report.smoothness.tangency_conflicts == 2);
  assert(surface.is_valid());
  const auto slope = [&surface](std::size_t quad, double u)
  {
    const Vector d = surface.derivative(surface.patch_at(quad, u, 0), u, 0, 0, 1);
    return std::abs(unit(d).z());
  };
  std::cout << "incompatible corners: slope " << slope(12, 0.5) << ", at the corner "
            << slope(0, 0) << std::endl;
  assert(slope(12, 0.5) < 1e-6 && slope(0, 0) > 0.1);
}

// the normals that curves on surfaces know
void test_normals_of_curves()
{
  typedef SC::Curve_on_surface_traits_3<Kernel> Traits;
  SC::Elementary_surface_3<Kernel> sphere;
  sphere.type = SC::Elementary_surface_3<Kernel>::SPHERE;
  sphere.origin = Point(1, 2, 3);
  sphere.radius = 4;
  typedef Kernel::Point_2 Point_2;
  const Traits::Curve_3 curve(sphere, 1, {0, 0, 1, 1}, {Point_2(0.1, -0.4), Point_2(2.3, 0.7)});
  for(double t : {0., 0.3, 1.})
  {
    const Vector n = Traits().construct_normal_on_curve_3_object()(curve, t);
    const Vector radius = (curve.point(t) - sphere.origin) / 4;
    assert((n - radius).squared_length() < 1e-24 || (n + radius).squared_length() < 1e-24);
  }
}

int main()
{
  test_band("plane", [](const Point&) { return Vector(0, 0, 1); }, 60 * DEGREE);
  test_band("sphere", [](const Point& p) { return p - Point(0, 0, -0.8); }, 3 * DEGREE);
  test_compatible_corners();
  test_incompatible_corners();
  test_normals_of_curves();
  return 0;
}
