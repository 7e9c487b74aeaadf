// A smooth height field over the unit square with ridges and bumps of several scales, and a
// target for the fits of the package that is this field.
#ifndef QUALITY_HEIGHT_FIELD_H
#define QUALITY_HEIGHT_FIELD_H

#include "surface_types.h"

#include <CGAL/Surface_mesh_spline_conversion/Curve_joint.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

// a function z(x,y) and its gradient
struct Height_field
{
  // a Gaussian bell over an ellipse: half axes `a` and `b`, the first one turned by `angle`
  struct Bell
  {
    double x, y, height, a, b, angle;
  };

  static const std::vector<Bell>& bells()
  {
    static const std::vector<Bell> result = {
      {0.35, 0.60, 0.25, 0.45, 0.35, 0.3},   // a hill
      {0.70, 0.30, 0.12, 0.30, 0.06, 0.8},   // ridges
      {0.25, 0.25, 0.08, 0.05, 0.25, 0.0},
      {0.60, 0.80, 0.10, 0.25, 0.07, -0.5},
      {0.15, 0.80, 0.06, 0.06, 0.06, 0.0},   // bumps
      {0.85, 0.75, 0.05, 0.05, 0.05, 0.0},
      {0.45, 0.40, -0.04, 0.08, 0.08, 0.0}};
    return result;
  }

  double operator()(double x, double y) const { return value_and_gradient(x, y)[0]; }

  std::array<double, 3> value_and_gradient(double x, double y) const
  {
    std::array<double, 3> result = {{0, 0, 0}};
    for(const Bell& bell : bells())
    {
      const double c = std::cos(bell.angle), s = std::sin(bell.angle);
      const double p = (c * (x - bell.x) + s * (y - bell.y)) / bell.a;
      const double q = (-s * (x - bell.x) + c * (y - bell.y)) / bell.b;
      const double value = bell.height * std::exp(-p * p - q * q);
      result[0] += value;
      result[1] += value * (-2 * p * c / bell.a + 2 * q * s / bell.b);
      result[2] += value * (-2 * p * s / bell.a - 2 * q * c / bell.b);
    }
    return result;
  }
};

// The graph of a height field as a target, on a layout of n by n squares with the same parameters
// as the plane.
class Height_target
{
public:
  typedef Kernel::FT FT;
  typedef Kernel::Point_3 Point_3;
  typedef Kernel::Vector_3 Vector_3;
  typedef ::Layout Layout;

  Height_target(const Height_field& field, std::size_t n)
    : m_field(field), m_n(n), m_layout(make_layout(field, n)) {}

  const Layout& layout() const { return m_layout; }
  FT diameter() const { return std::sqrt(2.); }
  std::size_t number_of_chains() const { return 4; }
  std::size_t number_of_sides(std::size_t) const { return m_n; }
  bool is_on_mesh(std::size_t, double, double) const { return true; }
  FT quad_size(std::size_t) const { return 1 / FT(m_n); }

  // there is no mesh
  std::size_t number_of_mesh_faces() const { return 0; }
  std::size_t number_of_mesh_points() const { return 0; }
  std::array<std::size_t, 6> points_of_mesh_face(std::size_t) const { return {}; }
  Point_3 mesh_point(std::size_t) const { return Point_3(0, 0, 0); }

  Point_3 point(std::size_t quad, FT u, FT v) const
  {
    const FT x = (FT(quad % m_n) + u) / FT(m_n), y = (FT(quad / m_n) + v) / FT(m_n);
    return Point_3(x, y, m_field(x, y));
  }
  Point_3 point(std::size_t quad, FT u, FT v, std::size_t& face) const
  {
    face = 0;
    return point(quad, u, v);
  }
  Point_3 foot_point(const Point_3&, std::size_t, FT, FT, const Point_3& start,
                     std::size_t, std::size_t&) const
  {
    return start; // distances are those at equal (x,y)
  }

  Point_3 curve_point(std::size_t chain, FT t) const
  {
    const std::array<FT, 2> xy = place(chain, t);
    return Point_3(xy[0], xy[1], m_field(xy[0], xy[1]));
  }
  Vector_3 curve_derivative(std::size_t chain, FT t, int) const
  {
    const std::array<FT, 2> xy = place(chain, t), d = direction(chain);
    const std::array<double, 3> z = m_field.value_and_gradient(xy[0], xy[1]);
    return Vector_3(d[0], d[1], z[1] * d[0] + z[2] * d[1]) / FT(m_n);
  }

  // the parameter of the curves is used in place of the arc length
  FT arc_length(std::size_t, FT t) const { return t; }
  FT speed(std::size_t, FT) const { return 1; }
  const Height_target& network() const { return *this; }
  std::vector<CGAL::Surface_mesh_spline_conversion::Curve_joint<FT> > joints(std::size_t) const
  {
    return {};
  }
  std::vector<FT> surface_seams(std::size_t) const { return {}; }
  Point_3 point(std::size_t chain, FT t) const { return curve_point(chain, t); }
  Vector_3 derivative(std::size_t chain, FT t, int order) const
  {
    return curve_derivative(chain, t, order);
  }
  std::pair<Point_3, Vector_3> point_and_tangent(std::size_t chain, FT t) const
  {
    return {point(chain, t), derivative(chain, t, 1)};
  }

private:
  static std::array<FT, 2> direction(std::size_t chain)
  {
    const std::array<FT, 2> directions[4] = {{{1, 0}}, {{0, 1}}, {{-1, 0}}, {{0, -1}}};
    return directions[chain];
  }

  std::array<FT, 2> place(std::size_t chain, FT t) const
  {
    const std::array<FT, 2> starts[4] = {{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}}};
    const std::array<FT, 2> d = direction(chain);
    return {{starts[chain][0] + d[0] * t / FT(m_n), starts[chain][1] + d[1] * t / FT(m_n)}};
  }

  static Layout make_layout(const Height_field& field, std::size_t n)
  {
    std::vector<Point_3> points;
    for(std::size_t j = 0; j <= n; ++j)
      for(std::size_t i = 0; i <= n; ++i)
      {
        const FT x = FT(i) / FT(n), y = FT(j) / FT(n);
        points.emplace_back(x, y, field(x, y));
      }
    std::vector<std::array<std::size_t, 4> > quads;
    for(std::size_t j = 0; j < n; ++j)
      for(std::size_t i = 0; i < n; ++i)
      {
        const std::size_t v = j * (n + 1) + i;
        quads.push_back({{v, v + 1, v + n + 2, v + n + 1}});
      }
    Layout result(points, quads);
    for(std::size_t k = 0; k < n; ++k)
    {
      const std::size_t quad_of_side[4] = {k, (k + 1) * n - 1, n * n - 1 - k, (n - 1 - k) * n};
      for(int side = 0; side < 4; ++side)
        result.set_boundary_side(quad_of_side[side], side,
                                 Layout::Boundary_side{std::size_t(side), FT(k), FT(k + 1)});
    }
    for(std::size_t corner : {std::size_t(0), n, n * (n + 1), (n + 1) * (n + 1) - 1})
      result.set_corner(corner, true);
    return result;
  }

  Height_field m_field;
  std::size_t m_n;
  Layout m_layout;
};

#endif // QUALITY_HEIGHT_FIELD_H
