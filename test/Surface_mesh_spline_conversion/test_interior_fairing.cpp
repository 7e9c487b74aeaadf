// Making a fitted surface fair: the energy against integrals known in closed form, and the normals
// of a surface fitted to a rough mesh against those of the smooth shape.
#include "synthetic_layout.h"

#include <CGAL/Surface_mesh_spline_conversion/fit_boundary.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_fitter.h>
#include <CGAL/T_NURCC_surface_3.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

using namespace synthetic;
namespace params = CGAL::parameters;

typedef CGAL::T_NURCC_surface_3<Kernel> T_NURCC_surface;
typedef SC::internal::Interior_fitter<T_NURCC_surface, Target, SC::Default_visitor> Fitter;
typedef SC::internal::Interior_samples<T_NURCC_surface, Target> Samples;
typedef SC::internal::Interior_system<Samples> System;

// returns the energy of z = x^i y^j over a layout of n x n quads of size 1
double energy_of_monomial(int n, int i, int j)
{
  const Input input(height_field(0), n, n, 1);
  T_NURCC_surface surface(input.layout());
  Samples samples(surface, input.target(), nullptr);
  std::vector<std::size_t> patches(surface.number_of_patches());
  std::iota(patches.begin(), patches.end(), std::size_t(0));
  for(std::size_t p : patches)
    for(std::size_t k = 0; k < samples.grid(p).number_of_fit_samples(); ++k)
    {
      const auto at = samples.error_place(samples.error_sample(p, k));
      const double x = double(at.quad % std::size_t(n)) + at.u;
      const double y = double(at.quad / std::size_t(n)) + at.v;
      samples.set_fit_target(p, k, Eigen::Vector3d(0, 0, std::pow(x, i) * std::pow(y, j)));
    }
  const std::vector<bool> is_fixed(surface.number_of_control_points(), false);
  const System system(samples, is_fixed, patches);
  System::Points points = System::Points::Zero(Eigen::Index(is_fixed.size()), 3);
  for(int repetition = 0; repetition < 3; ++repetition)
    assert(system.is_valid() && system.solve(points, 1e-13));
  const SC::internal::Fairness_energy energy(surface, samples);
  double sum = 0;
  for(std::size_t p : patches)
  {
    Eigen::VectorXd z(Eigen::Index(samples.number_of_functions(p)));
    for(Eigen::Index f = 0; f < z.size(); ++f)
      z[f] = points(Eigen::Index(samples.function(p, std::size_t(f))), 2);
    sum += (energy.derivatives(p) * z).squaredNorm();
  }
  return sum;
}

void test_energy()
{
  const int n = 5;
  const double area = n * n;
  const auto is_close = [](double a, double b) { return std::abs(a - b) < 1e-5 * (1 + b); };
  assert(is_close(energy_of_monomial(n, 2, 0), 0));
  assert(is_close(energy_of_monomial(n, 1, 1), 0));
  assert(is_close(energy_of_monomial(n, 3, 0), 36 * area));
  assert(is_close(energy_of_monomial(n, 0, 3), 36 * area));
  assert(is_close(energy_of_monomial(n, 2, 1), 12 * area));
  assert(is_close(energy_of_monomial(n, 1, 2), 12 * area));
  assert(is_close(energy_of_monomial(n, 3, 1), 48 * area * area));
}

constexpr double amplitude = 5e-4; // of the relief

// The graph of a smooth function with a relief that ends at the boundary; derivatives are those
// without it.
Surface rough_graph()
{
  Surface s = height_field(0.3);
  s.point = [](double a, double b)
  {
    const double relief = 16 * amplitude * a * (1 - a) * b * (1 - b);
    const Point p = height_field(0.3).point(a, b);
    return Point(a, b, p.z() + relief * std::sin(60 * a) * std::sin(56 * b));
  };
  return s;
}

// The rough graph fitted with patches that can follow the relief.
struct Rough_fit
{
  static constexpr int n = 6;

  explicit Rough_fit(double tolerance)
    : shape(height_field(0.3)), input(rough_graph(), n, n, 8), surface(input.layout())
  {
    surface.refine_uniformly();
    surface.refine_uniformly();
    const auto np = params::interior_tolerance(tolerance).boundary_tolerance(tolerance);
    assert(SC::fit_boundary(surface, input.target(), report, np) == SC::Error_code::OK);
  }

  double largest_distance() const
  {
    double result = 0;
    for_each_sample([&](std::size_t p, const auto& o, double u, double v)
    {
      const Point q = surface.position(p, u, v);
      std::size_t face;
      const Point start = input.target().point(o.quad, u, v, face);
      const Point foot = input.target().foot_point(q, o.quad, u, v, start, face);
      result = (std::max)(result, std::sqrt(CGAL::squared_distance(q, foot)));
    });
    return result;
  }

  // The mean sine of the angle with the normal of the shape, away from the boundary. The largest one
  // is at the relief where the tolerance forces the surface to follow it.
  double mean_normal_error() const
  {
    double sum = 0;
    std::size_t number = 0;
    for_each_sample([&](std::size_t p, const auto& o, double u, double v)
    {
      if(input.target().is_boundary_quad(o.quad))
        return;
      const Point q = surface.position(p, u, v);
      const Vector normal = CGAL::cross_product(shape.derivative(q.x(), q.y(), 1, 0),
                                                shape.derivative(q.x(), q.y(), 0, 1));
      const Vector sine = CGAL::cross_product(surface.normal(p, u, v), normal);
      sum += std::sqrt(sine.squared_length() / normal.squared_length());
      ++number;
    });
    return sum / double(number);
  }

  template <typename Function>
  void for_each_sample(const Function& visit) const
  {
    for(std::size_t p = 0; p < surface.number_of_patches(); ++p)
    {
      const auto o = surface.patch_origin(p);
      for(double s : {0.06, 0.29, 0.57, 0.91})
        for(double t : {0.11, 0.44, 0.68, 0.97})
          visit(p, o, o.u0 + s * (o.u1 - o.u0), o.v0 + t * (o.v1 - o.v0));
    }
  }

  std::vector<Point> control_points() const
  {
    std::vector<Point> result;
    for(std::size_t i = 0; i < surface.number_of_control_points(); ++i)
      result.push_back(surface.control_point(i));
    return result;
  }

  Surface shape;
  Input input;
  T_NURCC_surface surface;
  SC::Conversion_report report;
};

// Coarsening, as long as it helps, ends with a surface that is taken back.
void coarsen_as_far_as_possible(Fitter& fitter, const T_NURCC_surface& surface)
{
  std::size_t size;
  do
  {
    size = surface.number_of_control_points();
    assert(fitter.coarsen() == SC::Error_code::OK);
  }
  while(surface.number_of_control_points() < size);
}

void test_fairing(double tolerance, double smallest_gain, bool do_coarsen)
{
  Rough_fit fit(tolerance);
  SC::Default_visitor visitor;
  const auto np = params::interior_tolerance(tolerance).boundary_tolerance(tolerance);
  Fitter fitter(fit.surface, fit.input.target(),
                SC::internal::interior_fit_options(fit.input.target(), np),
                SC::internal::boundary_fit_options(fit.input.target(), np),
                SC::internal::Boundary_normals<Target>(), visitor, fit.report);
  assert(fitter() == SC::Error_code::OK);
  if(do_coarsen)
    coarsen_as_far_as_possible(fitter, fit.surface);
  const std::vector<Point> fitted = fit.control_points();
  const double error = fit.mean_normal_error();
  assert(fitter.make_fair({}) == SC::Error_code::OK);
  assert(fit.largest_distance() < tolerance);
  assert(smallest_gain * fit.mean_normal_error() < error);
  for(std::size_t c = 0; c < fit.surface.number_of_boundary_chains(); ++c)
    for(std::size_t i : fit.surface.boundary_curve(c).control_points)
      assert(fit.surface.control_point(i) == fitted[i]);

  // the fit comes back around a place, then everywhere
  const std::size_t quad = 2 * Rough_fit::n + 2, patch = fit.surface.patch_at(quad, 0.3, 0.3);
  const Point place = fit.surface.position(patch, 0.3, 0.3);
  assert(fitter.make_fair({place}) == SC::Error_code::OK);
  std::vector<T_NURCC_surface::Basis_function> functions;
  fit.surface.basis(patch, 0.3, 0.3, 0, functions);
  for(const auto& f : functions)
    assert(fit.surface.control_point(f.control_point) == fitted[f.control_point]);
  assert(fit.control_points() != fitted && fit.largest_distance() < tolerance);
  fitter.restore_fit();
  assert(fit.control_points() == fitted);
}

int main()
{
  test_energy();
  test_fairing(3 * amplitude, 20, false);
  test_fairing(0.8 * amplitude, 1, true);
  return 0;
}
