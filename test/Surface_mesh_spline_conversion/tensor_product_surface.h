// A bicubic tensor-product spline over a layout of m x n quads: a reference for the surface class
// with the interface the fits use. Refinement inserts knot lines through the whole surface.
#ifndef TENSOR_PRODUCT_SURFACE_H
#define TENSOR_PRODUCT_SURFACE_H

#include "synthetic_layout.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Cubic_spline_basis.h>

namespace SC = CGAL::Surface_mesh_spline_conversion;

namespace synthetic {

class Tensor_product_surface
{
public:
  typedef std::size_t size_type;
  typedef double FT;
  typedef Point Point_3;
  struct Patch_split { size_type patch; bool u, v; };
  struct Basis_function { size_type control_point; std::array<double, 6> value; };
  struct Patch_origin { size_type quad; double u0, v0, u1, v1; };
  struct Bezier_element { double u0, v0, u1, v1; std::array<Point, 16> points; };
  struct Boundary_curve
  {
    std::vector<size_type> control_points;
    std::vector<double> knots;
    bool is_closed;
  };

  Tensor_product_surface(const Layout& layout, int m, int n, bool is_periodic)
    : m_layout(layout), m_m(m), m_n(n), m_is_periodic(is_periodic)
  {
    for(int i = 0; i <= (is_periodic ? m - 1 : m); ++i)
      m_breaks[0].push_back(i);
    for(int j = 0; j <= n; ++j)
      m_breaks[1].push_back(j);
    update();
  }

  size_type number_of_control_points() const { return m_points.size(); }
  const Point& control_point(size_type i) const { return m_points[i]; }
  void set_control_point(size_type i, const Point& p) { m_points[i] = p; }
  size_type number_of_patches() const { return u().number_of_spans() * v().number_of_spans(); }
  size_type number_of_boundary_chains() const { return m_layout.number_of_chains(); }

  Patch_origin patch_origin(size_type p) const
  {
    const size_type i = p % u().number_of_spans(), j = p / u().number_of_spans();
    const double x = std::floor(u().span_begin(i)), y = std::floor(v().span_begin(j));
    return {size_type(x) + m_m * size_type(y), u().span_begin(i) - x, v().span_begin(j) - y,
            u().span_end(i) - x, v().span_end(j) - y};
  }

  // all functions change with each refinement
  size_type basis_stamp(size_type) const { return number_of_control_points(); }

  size_type patch_at(size_type quad, double x, double y) const
  {
    // the patch inside the quad
    const double inside = 1e-9;
    const double a = quad % m_m + (std::min)((std::max)(x, inside), 1 - inside);
    const double b = quad / m_m + (std::min)((std::max)(y, inside), 1 - inside);
    return u().span_of(a) + u().number_of_spans() * v().span_of(b);
  }

  void basis(size_type p, double x, double y, int, std::vector<Basis_function>& out) const
  {
    const size_type i = p % u().number_of_spans(), j = p / u().number_of_spans();
    const size_type quad = patch_origin(p).quad;
    out.clear();
    const auto a = u().values(i, quad % m_m + x), b = v().values(j, quad / m_m + y);
    for(size_type k = 0; k < 4; ++k)
      for(size_type l = 0; l < 4; ++l)
      {
        Basis_function f;
        f.control_point = b.functions[k] * u().size() + a.functions[l];
        const int orders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
        for(int o = 0; o < 6; ++o)
          f.value[o] = a.derivatives[orders[o][0]][l] * b.derivatives[orders[o][1]][k];
        out.push_back(f);
      }
  }

  Point position(size_type p, double x, double y) const
  {
    return CGAL::ORIGIN + derivative(p, x, y, 0, 0);
  }

  void positions(size_type p, size_type nu, size_type nv, std::vector<Point>& out) const
  {
    const Patch_origin o = patch_origin(p);
    out.clear();
    for(size_type j = 0; j <= nv; ++j)
      for(size_type i = 0; i <= nu; ++i)
        out.push_back(position(p, o.u0 + (o.u1 - o.u0) * double(i) / double(nu),
                               o.v0 + (o.v1 - o.v0) * double(j) / double(nv)));
  }

  // no Bezier form: patches are evaluated one point after the other
  bool is_extraordinary_patch(size_type) const { return true; }
  std::vector<Bezier_element> patch_elements(size_type) const { return {}; }
  double basis_bound(size_type) const { return 1; }
  void basis_on_grid(size_type, size_type, size_type, std::vector<size_type>&,
                     std::vector<double>&) const
  {}

  Vector derivative(size_type p, double x, double y, int i, int j) const
  {
    std::vector<Basis_function> functions;
    basis(p, x, y, 2, functions);
    const int place = i + j == 2 ? 3 + j : i + 2 * j;
    Vector sum(0, 0, 0);
    for(const Basis_function& f : functions)
      sum = sum + f.value[place] * (m_points[f.control_point] - CGAL::ORIGIN);
    return sum;
  }

  Boundary_curve boundary_curve(size_type chain) const
  {
    const auto sides = m_layout.chain_sides(chain);
    const int side = sides.front().second;
    const bool is_row = side % 2 == 0;
    const SC::internal::Cubic_spline_basis& b = is_row ? u() : v();
    Boundary_curve result;
    result.is_closed = m_is_periodic;
    std::vector<std::pair<double, size_type> > entries;
    for(size_type i = 0; i < b.size(); ++i)
    {
      const size_type point = is_row ? (side == 0 ? 0 : v().size() - 1) * u().size() + i
                                     : i * u().size() + (side == 1 ? u().size() - 1 : 0);
      double x = m_is_periodic ? m_breaks[0][i] : double(i);
      if(m_is_periodic)
      {
        const double column = double(sides.front().first % m_m);
        x = side == 0 ? x - column : column + 1 - x;
        x -= m_m * std::floor(x / m_m);
      }
      else if(side >= 2)
        x = -x;
      entries.emplace_back(x, point);
    }
    std::sort(entries.begin(), entries.end());
    for(const auto& e : entries)
      result.control_points.push_back(e.second);
    if(m_is_periodic)
    {
      for(const auto& e : entries)
        result.knots.push_back(e.first);
      result.knots.push_back(entries.front().first + m_m);
    }
    else
    {
      result.knots = clamped(m_breaks[is_row ? 0 : 1]);
      const double end = result.knots.back();
      if(side >= 2)
      {
        for(double& x : result.knots)
          x = end - x;
        std::reverse(result.knots.begin(), result.knots.end());
      }
    }
    return result;
  }

  void refine_uniformly()
  {
    for(int d = 0; d < 2; ++d)
    {
      const SC::internal::Cubic_spline_basis b = *m_basis[d];
      for(size_type i = 0; i < b.number_of_spans(); ++i)
        insert(d, (b.span_begin(i) + b.span_end(i)) / 2);
    }
    update();
  }

  // a tensor product has no finer choice
  template <typename Marks>
  void refine(const Marks&) { refine_uniformly(); }

  void refine_boundary_to(const std::vector<std::vector<double> >& knots)
  {
    for(size_type chain = 0; chain < knots.size(); ++chain)
      for(double x : knots[chain])
      {
        const auto sides = m_layout.chain_sides(chain);
        const int side = sides.front().second, d = side % 2;
        if(m_is_periodic)
        {
          const double column = double(sides.front().first % m_m);
          x = side == 0 ? x + column : column + 1 - x;
          x -= m_m * std::floor(x / m_m);
        }
        else if(side >= 2)
          x = (d == 0 ? m_m : m_n) - x;
        insert(d, x);
      }
    update();
  }

private:
  const SC::internal::Cubic_spline_basis& u() const { return *m_basis[0]; }
  const SC::internal::Cubic_spline_basis& v() const { return *m_basis[1]; }

  static std::vector<double> clamped(const std::vector<double>& breaks)
  {
    std::vector<double> knots(3, breaks.front());
    knots.insert(knots.end(), breaks.begin(), breaks.end());
    knots.insert(knots.end(), 3, breaks.back());
    return knots;
  }

  void insert(int d, double x)
  {
    auto it = std::lower_bound(m_breaks[d].begin(), m_breaks[d].end(), x);
    if(it == m_breaks[d].end() || *it != x)
      m_breaks[d].insert(it, x);
  }

  void update()
  {
    typedef SC::internal::Cubic_spline_basis Basis;
    m_basis[0] = m_is_periodic ? std::make_shared<Basis>(m_breaks[0], double(m_m))
                               : std::make_shared<Basis>(clamped(m_breaks[0]));
    m_basis[1] = std::make_shared<Basis>(clamped(m_breaks[1]));
    m_points.assign(u().size() * v().size(), Point(0, 0, 0));
  }

  const Layout& m_layout;
  int m_m, m_n;
  bool m_is_periodic;
  std::vector<double> m_breaks[2];
  std::shared_ptr<const SC::internal::Cubic_spline_basis> m_basis[2];
  std::vector<Point> m_points;
};

} // namespace synthetic

#endif // TENSOR_PRODUCT_SURFACE_H
