// Concave corners of the boundary between two quads, of which some have an extraordinary point: the
// surface leaves the corner along the bisector, and is not folded over beside it. Beside the corner
// the targets of the fit stay those at equal parameters.
#include "block_layouts.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_spline_conversion/Curve_joint.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_boundary.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_interior.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/reproject_targets.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/split_corners.h>
#include <CGAL/T_NURCC_surface_3.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;
namespace params = CGAL::parameters;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef Kernel::Point_3 Point;
typedef Kernel::Vector_3 Vector;
typedef SC::Quad_layout<Kernel> Quad_layout;
typedef CGAL::T_NURCC_surface_3<Kernel> T_NURCC_surface;

// a target without a mesh: the bilinear quads of a plane layout
struct Bilinear_target
{
  typedef Kernel::FT FT;
  typedef Kernel::Point_3 Point_3;
  typedef Quad_layout Layout;

  const Layout& quads;
  Vector slide = Vector(0, 0, 0); // from the point at equal parameters to the foot point

  const Layout& layout() const { return quads; }
  double diameter() const { return 2; }
  double quad_size(std::size_t) const { return 0.5; }
  std::size_t number_of_chains() const { return quads.number_of_chains(); }
  std::size_t number_of_sides(std::size_t c) const { return quads.chain_sides(c).size(); }

  Point vertex(std::size_t quad, int i) const { return quads.point(quads.vertex(quad, i)); }

  Point curve_point(std::size_t chain, double x) const
  {
    const auto sides = quads.chain_sides(chain);
    const std::size_t k = (std::min)(std::size_t(x), sides.size() - 1);
    return CGAL::barycenter(vertex(sides[k].first, sides[k].second), 1 - x + double(k),
                            vertex(sides[k].first, sides[k].second + 1), x - double(k));
  }

  Vector curve_derivative(std::size_t chain, double x, int) const
  {
    const auto sides = quads.chain_sides(chain);
    const auto side = sides[(std::min)(std::size_t(x), sides.size() - 1)];
    return vertex(side.first, side.second + 1) - vertex(side.first, side.second);
  }

  double speed(std::size_t chain, double x) const
  {
    return std::sqrt(curve_derivative(chain, x, 1).squared_length());
  }

  double arc_length(std::size_t chain, double x) const
  {
    double result = 0;
    for(std::size_t k = 0; double(k) < x; ++k)
      result += (std::min)(x - double(k), 1.) * speed(chain, double(k));
    return result;
  }

  // the curves by their arc length
  const Bilinear_target& network() const { return *this; }

  std::vector<SC::Curve_joint<double> > joints(std::size_t) const { return {}; }
  std::vector<double> surface_seams(std::size_t) const { return {}; }

  double parameter(std::size_t chain, double s) const
  {
    std::size_t k = 0;
    while(k + 1 < number_of_sides(chain) && arc_length(chain, double(k + 1)) < s)
      ++k;
    return double(k) + (s - arc_length(chain, double(k))) / speed(chain, double(k));
  }

  Point point(std::size_t chain, double s) const
  {
    return curve_point(chain, parameter(chain, s));
  }

  Vector derivative(std::size_t chain, double s, int) const
  {
    const double x = parameter(chain, s);
    return curve_derivative(chain, x, 1) / speed(chain, x);
  }

  std::pair<Point, Vector> point_and_tangent(std::size_t chain, double s) const
  {
    return {point(chain, s), derivative(chain, s, 1)};
  }

  Point point(std::size_t quad, double u, double v) const
  {
    return CGAL::barycenter(CGAL::barycenter(vertex(quad, 0), 1 - u, vertex(quad, 1), u), 1 - v,
                            CGAL::barycenter(vertex(quad, 3), 1 - u, vertex(quad, 2), u), v);
  }

  Point point(std::size_t quad, double u, double v, std::size_t& face) const
  {
    face = 0;
    return point(quad, u, v);
  }

  Point foot_point(const Point&, std::size_t, double, double, const Point& start, std::size_t,
                   std::size_t&) const
  {
    return start + slide;
  }

  bool is_on_mesh(std::size_t, double, double) const { return true; }
  std::size_t number_of_mesh_faces() const { return 0; }
  std::size_t number_of_mesh_points() const { return 0; }
  std::array<std::size_t, 6> points_of_mesh_face(std::size_t) const { return {}; }
  Point mesh_point(std::size_t) const { return Point(0, 0, 0); }
};

// A pentagon of n x n quads around each corner, with one extraordinary point, and a notch in the
// middle of a side.
Quad_layout notched_pentagon(const std::array<double, 3>& notch, int n)
{
  Blocks blocks = polygon_blocks(5);
  blocks[0][3] = blocks[1][1] = notch;
  return block_layout<Kernel>(
    blocks, n, [](double x, double y, double z) { return Point(x, y, z); },
    [&notch](const Point& p) { return p == Point(notch[0], notch[1], notch[2]); });
}

Vector unit(const Vector& v) { return v / std::sqrt(v.squared_length()); }

// the derivatives in the directions of the sides of a quad at the corner `i`
std::array<Vector, 2> derivatives(const T_NURCC_surface& surface, std::size_t quad, int i, double u,
                                  double v)
{
  const std::size_t patch = surface.patch_at(quad, u, v);
  std::array<Vector, 2> result
    = {{surface.derivative(patch, u, v, 1, 0), surface.derivative(patch, u, v, 0, 1)}};
  for(int k = 0; k < i; ++k) // a quarter of a turn
    result = {{result[1], -result[0]}};
  return result;
}

// `share`: of the way from corner `i` to the next one
std::array<double, 2> on_side(int i, double share)
{
  static const double u[4] = {0, 1, 1, 0}, v[4] = {0, 0, 1, 1};
  const int j = (i + 1) % 4;
  return {{u[i] + share * (u[j] - u[i]), v[i] + share * (v[j] - v[i])}};
}

void test(const std::array<double, 3>& notch, int n)
{
  const Quad_layout layout = notched_pentagon(notch, n);
  const Bilinear_target target{layout};
  T_NURCC_surface surface(layout);
  SC::Conversion_report report;
  const auto np = params::boundary_tolerance(1e-6).interior_tolerance(0.02);
  assert(SC::fit_boundary(surface, target, report, np) == SC::Error_code::OK);
  assert(SC::fit_interior(surface, target, report, np) == SC::Error_code::OK);
  int corners = 0;
  auto check = [&](std::size_t first, int i, std::size_t second, int j)
  {
    ++corners;
    const Point corner = target.vertex(second, j);
    const Vector out = unit(target.vertex(second, j + 1) - corner);
    const Vector in = unit(target.vertex(first, i) - corner);
    const Vector bisector = -unit(in + out); // the interior angle is above a straight one
    for(double y : {0., 1e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 0.99})
    {
      // the line is the side i + 1 of `first`, and the side j + 3 of `second` backwards
      const auto left = on_side((i + 1) & 3, y), right = on_side((j + 3) & 3, 1 - y);
      const auto a = derivatives(surface, first, i, left[0], left[1]);
      const auto b = derivatives(surface, second, j, right[0], right[1]);
      assert((a[1] - b[1]).squared_length() < 1e-12);
      assert(CGAL::cross_product(a[0], a[1]).z() > 0 && CGAL::cross_product(b[0], b[1]).z() > 0);
      if(y == 0)
        assert(unit(a[1]) * bisector > 1 - 1e-6);
    }
  };
  SC::internal::for_each_split_corner(layout, check);
  assert(corners == 1);
}

void test_targets(const std::array<double, 3>& notch, int n)
{
  typedef SC::internal::Interior_samples<T_NURCC_surface, Bilinear_target> Samples;
  const Quad_layout layout = notched_pentagon(notch, n);
  const Bilinear_target target{layout, Vector(0.3, 0.1, 0)};
  const T_NURCC_surface surface(layout);
  Samples samples(surface, target, nullptr);
  std::vector<std::size_t> patches(samples.number_of_patches());
  std::iota(patches.begin(), patches.end(), std::size_t(0));
  SC::internal::Target_reprojection<T_NURCC_surface, Bilinear_target>(target, samples)(patches);
  std::size_t number_at_corner = 0;
  for(std::size_t p : patches)
  {
    // the notch is the only corner between two quads
    bool is_at_corner = false;
    for(std::size_t k = 0; k < samples.grid(p).number_of_fit_samples(); ++k)
      is_at_corner = is_at_corner
                     || samples.target(samples.error_sample(p, k))
                          == Eigen::Vector3d(notch[0], notch[1], notch[2]);
    number_at_corner += is_at_corner;
    for(std::size_t k = 0; k < samples.grid(p).number_of_fit_samples(); ++k)
    {
      const Eigen::Vector3d move
        = samples.fit_target(p, k) - samples.target(samples.error_sample(p, k));
      assert((move - (is_at_corner ? 0 : 1) * Eigen::Vector3d(0.3, 0.1, 0)).norm() < 1e-12);
    }
  }
  assert(number_at_corner == 2);
}

int main()
{
  test_targets({{0.2, 0.3, 0}}, 1);
  test_targets({{0.2, 0.3, 0}}, 3);
  // the quads at the corner have the extraordinary point, or have not
  for(int n : {1, 3})
    for(double x : {0., 0.1, 0.2})
      test({{0.2 + x, 0.3 - x, 0}}, n);
}
