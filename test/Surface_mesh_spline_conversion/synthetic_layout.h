// Layouts with a known inverse map: a parametric surface over a rectangle, meshed by a grid, with
// a layout of m x n quads. No map has to be computed.
#ifndef SYNTHETIC_LAYOUT_H
#define SYNTHETIC_LAYOUT_H

#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Function_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/Transfinite_patch_network_3.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

namespace synthetic {

typedef CGAL::Simple_cartesian<double> Kernel;
typedef Kernel::Point_3 Point;
typedef Kernel::Vector_3 Vector;
typedef CGAL::Surface_mesh<Point> Mesh;
typedef boost::graph_traits<Mesh>::halfedge_descriptor halfedge_descriptor;
typedef SC::Function_curve_traits_3<Kernel> Curve_traits;
typedef SC::Boundary_curve_network_3<Mesh, Curve_traits> Network;
typedef SC::Quad_layout<Kernel> Layout;
typedef SC::Transfinite_patch_network_3<Kernel, Mesh, Curve_traits> Target;

// a surface over [0,1]^2 with its partial derivatives: derivative(a, b, i, j), i + j <= 3
struct Surface
{
  std::function<Point(double, double)> point;
  std::function<Vector(double, double, int, int)> derivative;
  bool is_periodic = false; // in the first parameter
  bool has_corner = false;  // at (1/2, 0); the derivatives are those on the side of the argument
};

// the i-th derivative of sin(w x + p)
inline double sine(double w, double x, double p, int i)
{
  return std::pow(w, i) * std::sin(w * x + p + i * std::acos(0.));
}

// the graph of a smooth function over the unit square
inline Surface height_field(double amplitude)
{
  Surface s;
  auto z = [amplitude](double a, double b, int i, int j)
  {
    return amplitude * sine(2.5, a, 0.4, i) * sine(2., b, 1.1, j);
  };
  s.point = [z](double a, double b) { return Point(a, b, z(a, b, 0, 0)); };
  s.derivative = [z](double a, double b, int i, int j)
  {
    return Vector(i == 1 && j == 0 ? 1 : 0, i == 0 && j == 1 ? 1 : 0, z(a, b, i, j));
  };
  return s;
}

// the graph of a bell over the unit square
inline Surface hill()
{
  constexpr double width = 0.09;
  // derivatives of exp(-x^2/2), x = (t - 1/2) / width
  auto bell = [](double t, int i)
  {
    const double x = (t - 0.5) / width, e = std::exp(-x * x / 2);
    return i == 0 ? e : (i == 1 ? -x * e / width : (x * x - 1) * e / (width * width));
  };
  Surface s;
  s.point = [bell](double a, double b) { return Point(a, b, 0.2 * bell(a, 0) * bell(b, 0)); };
  s.derivative = [bell](double a, double b, int i, int j)
  {
    return Vector(i == 1 && j == 0 ? 1 : 0, i == 0 && j == 1 ? 1 : 0,
                  0.2 * bell(a, i) * bell(b, j));
  };
  return s;
}

// the graph of z = sin(3 x + 1/2) / 5 + 3 y^2 / 10 over a domain whose lower side has a corner in
// the middle; pure derivatives only
inline Surface notched_graph()
{
  auto y = [](double a, double b, int i, int j)
  {
    const double slope = a < 0.5 ? -0.4 : 0.4;
    if(i + j > 1)
      return 0.;
    return i == 1 ? slope * (1 - b) : (j == 1 ? 1 - slope * (a - 0.5)
                                              : b + slope * (a - 0.5) * (1 - b));
  };
  Surface s;
  s.has_corner = true;
  s.derivative = [y](double a, double b, int i, int j)
  {
    const int order = i + j;
    const double first = i > 0 ? y(a, b, 1, 0) : y(a, b, 0, 1), value = y(a, b, 0, 0);
    const double square = order == 0 ? value * value
                          : (order == 1 ? 2 * value * first : (order == 2 ? 2 * first * first : 0));
    const double wave = j == 0 ? sine(3, a, 0.5, i) : 0;
    return Vector(order == 0 ? a : (i == 1 ? 1 : 0), y(a, b, i, j), 0.2 * wave + 0.3 * square);
  };
  const auto at = s.derivative;
  s.point = [at](double a, double b) { return CGAL::ORIGIN + at(a, b, 0, 0); };
  return s;
}

// a band of a torus with the given radii; its boundary consists of two circles
inline Surface torus_band(double major, double minor)
{
  const double pi = 2 * std::acos(0.);
  Surface s;
  s.is_periodic = true;
  auto at = [=](double a, double b, int i, int j)
  {
    const double w = 2 * pi, turn = 1.5;
    const double r = (j == 0 ? major : 0) + minor * sine(turn, b, -0.5 + pi / 2, j);
    return Vector(r * sine(w, a, pi / 2, i), r * sine(w, a, 0, i),
                  i == 0 ? -minor * sine(turn, b, -0.5, j) : 0);
  };
  s.point = [at](double a, double b) { return CGAL::ORIGIN + at(a, b, 0, 0); };
  s.derivative = at;
  return s;
}

// how the layout lies on the parameter rectangle: a bijection of the rectangle that keeps its sides
typedef std::function<std::array<double, 2>(double, double)> Warp;

inline std::array<double, 2> no_warp(double a, double b) { return {{a, b}}; }

// piecewise linear warp with kinks at the multiples of 1/m, of at most `jitter / 2` cells
inline Warp jittered(int m, int n, double jitter)
{
  auto shifted = [jitter](double x, int cells, int seed)
  {
    auto node = [&](int i)
    {
      if(i % cells == 0)
        return double(i) / cells;
      const double noise
        = std::sin(12.9898 * (i + 1) + 78.233 * (seed + 1)) * 43758.5453;
      return (i + jitter * (noise - std::floor(noise) - 0.5)) / cells;
    };
    const int i = (std::min)(int(x * cells), cells - 1);
    return node(i) + (x * cells - i) * (node(i + 1) - node(i));
  };
  return [=](double a, double b)
  {
    // the shift changes from row to row, linearly in between
    const double row = b * n, column = a * m;
    const int j = (std::min)(int(row), n - 1), i = (std::min)(int(column), m - 1);
    const double s = row - j, t = column - i;
    const double x = (1 - s) * shifted(a, m, j) + s * shifted(a, m, j + 1);
    const double y = (1 - t) * shifted(b, n, 50 + i) + t * shifted(b, n, 50 + (i + 1) % m);
    return std::array<double, 2>{{x, y}};
  };
}

class Input
{
public:
  // a mesh of (cells * m) x (cells * n) squares, a layout of m x n quads
  Input(const Surface& surface, int m, int n, int cells, const Warp& warp = no_warp)
    : m_surface(surface), m_warp(warp), m_m(m), m_n(n), m_columns(m * cells), m_rows(n * cells)
  {
    make_mesh();
    make_network();
    make_layout();
    m_target = std::make_shared<Target>(m_layout, *m_network, m_mesh);
  }

  Input(const Input&) = delete;

  const Mesh& mesh() const { return m_mesh; }
  const Network& network() const { return *m_network; }
  const Layout& layout() const { return m_layout; }
  const Target& target() const { return *m_target; }

  std::array<double, 2> parameters(std::size_t quad, double u, double v) const
  {
    return m_warp((quad % m_m + u) / m_m, (quad / m_m + v) / m_n);
  }

private:
  std::size_t vertex_id(int i, int j) const
  {
    return std::size_t(j) * (m_surface.is_periodic ? m_columns : m_columns + 1)
           + (m_surface.is_periodic ? i % m_columns : i);
  }

  void make_mesh()
  {
    for(int j = 0; j <= m_rows; ++j)
      for(int i = 0; i < (m_surface.is_periodic ? m_columns : m_columns + 1); ++i)
        m_mesh.add_vertex(m_surface.point(double(i) / m_columns, double(j) / m_rows));
    for(int j = 0; j < m_rows; ++j)
      for(int i = 0; i < m_columns; ++i)
      {
        const Mesh::Vertex_index a(vertex_id(i, j)), b(vertex_id(i + 1, j)),
          c(vertex_id(i + 1, j + 1)), d(vertex_id(i, j + 1));
        m_mesh.add_face(a, b, c);
        m_mesh.add_face(a, c, d);
      }
  }

  // the side of the parameter rectangle from one corner to the next, counter clockwise; side 4 is
  // the first half of side 0
  Curve_traits::Curve_3 side_curve(int side) const
  {
    if(side == 4)
      return first_half_of_lower_side();
    const Surface s = m_surface;
    const double sign = side < 2 ? 1 : -1;
    auto place = [side](double t)
    {
      switch(side)
      {
        case 0: return std::array<double, 2>{{t, 0}};
        case 1: return std::array<double, 2>{{1, t}};
        case 2: return std::array<double, 2>{{1 - t, 1}};
        default: return std::array<double, 2>{{0, 1 - t}};
      }
    };
    return Curve_traits::Curve_3(
      [s, place](double t) { return s.point(place(t)[0], place(t)[1]); },
      [s, place, sign, side](double t, int order)
      {
        return std::pow(sign, order)
               * s.derivative(place(t)[0], place(t)[1], side % 2 == 0 ? order : 0,
                              side % 2 == 0 ? 0 : order);
      });
  }

  Curve_traits::Curve_3 first_half_of_lower_side() const
  {
    const Surface s = m_surface;
    const double before_corner = 0.5 - 1e-13;
    return Curve_traits::Curve_3(
      [s](double t) { return s.point(t, 0); },
      [s, before_corner](double t, int order)
      { return s.derivative((std::min)(t, before_corner), 0, order, 0); });
  }

  void add_segment(int side, int k, int cells, std::size_t from, std::size_t to)
  {
    const halfedge_descriptor h
      = halfedge(Mesh::Vertex_index(from), Mesh::Vertex_index(to), m_mesh).first;
    m_segments[h] = SC::Curve_segment<Curve_traits>{m_curves[side], double(k) / cells,
                                                    double(k + 1) / cells};
  }

  void make_network()
  {
    m_segments = m_mesh.add_property_map<halfedge_descriptor, SC::Curve_segment<Curve_traits> >(
      "h:segment").first;
    for(int side = 0; side < 5; ++side)
      m_curves.push_back(side_curve(side));
    for(int i = 0; i < m_columns; ++i)
    {
      add_segment(m_surface.has_corner && 2 * i < m_columns ? 4 : 0, i, m_columns,
                  vertex_id(i, 0), vertex_id(i + 1, 0));
      add_segment(2, i, m_columns, vertex_id(m_columns - i, m_rows),
                  vertex_id(m_columns - i - 1, m_rows));
    }
    for(int j = 0; j < m_rows && !m_surface.is_periodic; ++j)
    {
      add_segment(1, j, m_rows, vertex_id(m_columns, j), vertex_id(m_columns, j + 1));
      add_segment(3, j, m_rows, vertex_id(0, m_rows - j), vertex_id(0, m_rows - j - 1));
    }
    m_network = std::make_shared<Network>(m_mesh, m_segments, Curve_traits());
    assert(m_network->error() == SC::Error_code::OK);
  }

  // the inverse map: the grid cell and triangle that contain the parameters
  struct Inverse_map : Layout::Inverse_map
  {
    explicit Inverse_map(const Input& input) : input(input) {}

    Layout::Location operator()(std::size_t quad, double u, double v) const override
    {
      const std::array<double, 2> ab = input.parameters(quad, u, v);
      return input.locate(ab[0], ab[1]);
    }

    const Input& input;
  };

  Layout::Location locate(double a, double b) const
  {
    const double x = a * m_columns, y = b * m_rows;
    const int i = (std::max)(0, (std::min)(int(x), m_columns - 1));
    const int j = (std::max)(0, (std::min)(int(y), m_rows - 1));
    const double s = x - i, t = y - j;
    const bool is_lower = s >= t;
    const std::size_t first = vertex_id(i, j), last = vertex_id(i + 1, j + 1);
    Layout::Location location;
    location.face = 2 * (std::size_t(j) * m_columns + i) + (is_lower ? 0 : 1);
    double sum[3] = {0, 0, 0};
    int k = 0;
    for(Mesh::Vertex_index w : vertices_around_face(
          halfedge(Mesh::Face_index(location.face), m_mesh), m_mesh))
    {
      const double middle = is_lower ? s - t : t - s;
      location.barycentric[k] = w.idx() == first ? 1 - (is_lower ? s : t)
                                : (w.idx() == last ? (is_lower ? t : s) : middle);
      for(int d = 0; d < 3; ++d)
        sum[d] += location.barycentric[k] * m_mesh.point(w)[d];
      ++k;
    }
    location.point = Point(sum[0], sum[1], sum[2]);
    return location;
  }

  std::size_t layout_vertex(int i, int j) const
  {
    return std::size_t(j) * (m_surface.is_periodic ? m_m : m_m + 1)
           + (m_surface.is_periodic ? i % m_m : i);
  }

  void make_layout()
  {
    std::vector<Point> points;
    std::vector<std::array<std::size_t, 4> > quads;
    for(int j = 0; j <= m_n; ++j)
      for(int i = 0; i < (m_surface.is_periodic ? m_m : m_m + 1); ++i)
      {
        const std::array<double, 2> ab = m_warp(double(i) / m_m, double(j) / m_n);
        points.push_back(m_surface.point(ab[0], ab[1]));
      }
    for(int j = 0; j < m_n; ++j)
      for(int i = 0; i < m_m; ++i)
        quads.push_back({{layout_vertex(i, j), layout_vertex(i + 1, j),
                          layout_vertex(i + 1, j + 1), layout_vertex(i, j + 1)}});
    m_layout = Layout(points, quads);
    m_layout.set_inverse_map(std::make_shared<Inverse_map>(*this));
    for(std::size_t q = 0; q < quads.size(); ++q)
      for(int i = 0; i < 4; ++i)
        if(m_layout.is_border(q, i))
          m_layout.set_boundary_side(q, i, boundary_side(q, i));
    if(!m_surface.is_periodic)
      for(int k = 0; k < 4; ++k)
        m_layout.set_corner(layout_vertex(k % 3 == 0 ? 0 : m_m, k < 2 ? 0 : m_n), true);
    if(m_surface.has_corner)
      m_layout.set_corner(layout_vertex(m_m / 2, 0), true);
  }

  double arc_length(std::size_t quad, int corner, int side, std::size_t& chain) const
  {
    const double uv[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::array<double, 2> ab = parameters(quad, uv[corner & 3][0], uv[corner & 3][1]);
    const double t = side % 2 == 0 ? ab[0] : ab[1], x = side < 2 ? t : 1 - t;
    const int cells = side % 2 == 0 ? m_columns : m_rows;
    // the end of a side lies on the edge before it: a corner may follow
    const int cell = corner == side ? int(x * cells + 1e-9) : int(std::ceil(x * cells - 1e-9)) - 1;
    const int edge = (std::max)(0, (std::min)(cell, cells - 1));
    const std::size_t vertices[4][2] = {
      {vertex_id(edge, 0), vertex_id(edge + 1, 0)},
      {vertex_id(m_columns, edge), vertex_id(m_columns, edge + 1)},
      {vertex_id(m_columns - edge, m_rows), vertex_id(m_columns - edge - 1, m_rows)},
      {vertex_id(0, m_rows - edge), vertex_id(0, m_rows - edge - 1)}};
    const auto place = m_network->chain_of(
      halfedge(Mesh::Vertex_index(vertices[side][0]), Mesh::Vertex_index(vertices[side][1]),
               m_mesh).first);
    chain = place.chain;
    const double first = m_network->arc_length(place.chain, place.index);
    const double last = m_network->arc_length(place.chain, place.index + 1);
    return first + (x * cells - edge) * (last - first);
  }

  Layout::Boundary_side boundary_side(std::size_t quad, int side) const
  {
    Layout::Boundary_side result;
    result.first = arc_length(quad, side, side, result.chain);
    result.last = arc_length(quad, side + 1, side, result.chain);
    if(result.last <= result.first)
      result.last += m_network->length(result.chain);
    if(m_network->is_closed(result.chain) && result.first >= m_network->length(result.chain))
    {
      result.first -= m_network->length(result.chain);
      result.last -= m_network->length(result.chain);
    }
    return result;
  }

  Surface m_surface;
  Warp m_warp;
  int m_m, m_n, m_columns, m_rows;
  Mesh m_mesh;
  std::vector<Curve_traits::Curve_3> m_curves;
  Mesh::Property_map<halfedge_descriptor, SC::Curve_segment<Curve_traits> > m_segments;
  std::shared_ptr<Network> m_network;
  Layout m_layout;
  std::shared_ptr<Target> m_target;
};

} // namespace synthetic

#endif // SYNTHETIC_LAYOUT_H
