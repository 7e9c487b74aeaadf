// The surface against independent ones: tensor-product B-splines, limits of Catmull-Clark
// subdivision, difference quotients, and itself across the edges of the layout.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/T_NURCC_surface_3.h>
#include <CGAL/subdivision_method_3.h>

#include "T_NURCC_test_layouts.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iostream>
#include <limits>

template <typename K>
double distance(const CGAL::Point_3<K>& p, const CGAL::Point_3<K>& q)
{
  return std::sqrt(CGAL::squared_distance(p, q));
}

// the recursion of Cox and de Boor
double b_spline(const std::vector<double>& t, std::size_t i, std::size_t degree, double x)
{
  if(degree == 0)
    return t[i] <= x && x < t[i + 1] ? 1 : 0;
  double result = 0;
  if(t[i + degree] > t[i])
    result += (x - t[i]) / (t[i + degree] - t[i]) * b_spline(t, i, degree - 1, x);
  if(t[i + degree + 1] > t[i + 1])
    result += (t[i + degree + 1] - x) / (t[i + degree + 1] - t[i + 1])
              * b_spline(t, i + 1, degree - 1, x);
  return result;
}

std::vector<double> clamped_knots(std::size_t n)
{
  std::vector<double> t(3, 0);
  for(std::size_t i = 0; i <= n; ++i)
    t.push_back(double(i));
  t.insert(t.end(), 3, double(n));
  return t;
}

// On a flat grid, the initial control points are the Greville points of their functions: the
// surface is the identity, and they tell which tensor-product function is theirs.
template <typename K>
void test_tensor_product()
{
  typedef CGAL::T_NURCC_surface_3<K> Surface;
  const std::size_t m = 4, n = 3;
  Surface surface(grid_layout<K>(m, n));
  assert(surface.error() == Surface::Error_code::OK && surface.is_valid());
  assert(surface.number_of_control_points() == (m + 3) * (n + 3));
  assert(surface.number_of_patches() == m * n && surface.number_of_t_junctions() == 0);

  const std::vector<double> s = clamped_knots(m), t = clamped_knots(n);
  std::mt19937 generator(1);
  std::vector<std::array<std::size_t, 2> > index(surface.number_of_control_points());
  for(std::size_t k = 0; k < index.size(); ++k)
  {
    const typename K::Point_3 p = surface.control_point(k);
    index[k] = {{m + 3, n + 3}};
    for(std::size_t i = 0; i < m + 3; ++i)
      if(std::abs((s[i + 1] + s[i + 2] + s[i + 3]) / 3 - p.x()) < 1e-9)
        index[k][0] = i;
    for(std::size_t j = 0; j < n + 3; ++j)
      if(std::abs((t[j + 1] + t[j + 2] + t[j + 3]) / 3 - p.y()) < 1e-9)
        index[k][1] = j;
    assert(index[k][0] < m + 3 && index[k][1] < n + 3);
    surface.set_control_point(k, typename K::Point_3(p.x(), p.y(), double(generator() % 100) / 50));
  }
  for(std::size_t patch = 0; patch < m * n; ++patch)
    for(int k = 0; k < 20; ++k)
    {
      const double u = double(generator() % 1000) / 1000, v = double(generator() % 1000) / 1000;
      const auto quad = surface.patch_origin(patch).quad;
      const double x = double(quad % m) + u, y = double(quad / m) + v;
      double z = 0;
      for(std::size_t i = 0; i < index.size(); ++i)
        z += surface.control_point(i).z() * b_spline(s, index[i][0], 3, x)
             * b_spline(t, index[i][1], 3, y);
      assert(distance(surface.position(patch, u, v), typename K::Point_3(x, y, z)) < 1e-13);
    }
}

// limit positions of all vertices after some subdivisions by the package Subdivision_method_3
template <typename K>
void test_catmull_clark(const std::set<std::array<int, 3> >& cubes)
{
  typedef typename K::Point_3 Point;
  typedef typename K::Vector_3 Vector;
  const Layout<K> layout = cubes_layout<K>(cubes, false);
  const CGAL::T_NURCC_surface_3<K> surface(layout);
  assert(surface.is_valid());

  std::vector<Point> points;
  std::vector<std::vector<std::size_t> > polygons;
  for(std::size_t v = 0; v < layout.number_of_vertices(); ++v)
    points.push_back(layout.point(v));
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    polygons.push_back({layout.vertex(q, 0), layout.vertex(q, 1), layout.vertex(q, 2),
                        layout.vertex(q, 3)});
  CGAL::Surface_mesh<Point> mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  const int levels = 3;
  CGAL::Subdivision_method_3::CatmullClark_subdivision(
    mesh, CGAL::parameters::number_of_iterations(levels));
  std::vector<Point> limits;
  for(auto v : mesh.vertices())
  {
    double n = 0;
    Vector sum = CGAL::NULL_VECTOR;
    for(auto h : mesh.halfedges_around_target(mesh.halfedge(v)))
    {
      n += 1;
      sum = sum + 4 * (mesh.point(mesh.source(h)) - CGAL::ORIGIN)
            + (mesh.point(mesh.source(mesh.prev(h))) - CGAL::ORIGIN);
    }
    limits.push_back(CGAL::ORIGIN + (n * n * (mesh.point(v) - CGAL::ORIGIN) + sum) / (n * (n + 5)));
  }
  const int steps = 1 << levels;
  for(std::size_t patch = 0; patch < surface.number_of_patches(); ++patch)
    for(int i = 0; i <= steps; ++i)
      for(int j = 0; j <= steps; ++j)
      {
        const Point p = surface.position(patch, double(i) / steps, double(j) / steps);
        double nearest = (std::numeric_limits<double>::max)();
        for(const Point& q : limits)
          nearest = (std::min)(nearest, distance(p, q));
        assert(nearest < 1e-13);
      }
}

// derivatives against central differences, also close to extraordinary points
template <typename K>
void test_derivatives(const Layout<K>& layout)
{
  const CGAL::T_NURCC_surface_3<K> surface(layout);
  const double h = 1e-5;
  std::mt19937 generator(2);
  for(std::size_t patch = 0; patch < surface.number_of_patches(); ++patch)
  {
    const auto r = surface.patch_origin(patch);
    for(int k = 0; k < 10; ++k)
    {
      const double u = r.u0 + (r.u1 - r.u0) * (0.05 + 0.9 * double(generator() % 997) / 997);
      const double v = r.v0 + (r.v1 - r.v0) * (0.05 + 0.9 * double(generator() % 997) / 997);
      for(int i = 0; i <= 1; ++i)
        for(int j = 0; i + j <= 1; ++j)
        {
          const auto du = (surface.derivative(patch, u + h, v, i, j)
                           - surface.derivative(patch, u - h, v, i, j)) / (2 * h);
          const auto dv = (surface.derivative(patch, u, v + h, i, j)
                           - surface.derivative(patch, u, v - h, i, j)) / (2 * h);
          assert((du - surface.derivative(patch, u, v, i + 1, j)).squared_length() < 1e-6);
          assert((dv - surface.derivative(patch, u, v, i, j + 1)).squared_length() < 1e-6);
        }
    }
    // the tangent plane at an extraordinary point is the limit of tangent planes
    const auto n0 = surface.normal(patch, r.u0, r.v0);
    const auto n1 = surface.normal(patch, r.u0 + 1e-7, r.v0 + 1e-7);
    assert((n0 - n1).squared_length() < 1e-6); // for valence 8, the limit is approached slowly
  }
}

// derivative (i, j) in the frame of a side: first along the side, second inwards
template <typename K>
typename K::Vector_3 derivative_at_side(const CGAL::T_NURCC_surface_3<K>& surface,
                                        const std::pair<std::size_t, int>& side, double t,
                                        int i, int j)
{
  const double uv[4][2] = {{t, 0}, {1, t}, {1 - t, 1}, {0, 1 - t}};
  const double u = uv[side.second][0], v = uv[side.second][1], inwards = 1e-3;
  const double along[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const double* a = along[side.second];
  const double* b = along[(side.second + 1) & 3];
  const std::size_t patch = surface.patch_at(side.first, u + inwards * (b[0] + 0.1 * a[0]),
                                             v + inwards * (b[1] + 0.1 * a[1]));
  if(i + j == 0)
    return surface.position(patch, u, v) - CGAL::ORIGIN;
  if(i + j == 1)
  {
    const double* c = i == 1 ? a : b;
    return c[0] * surface.derivative(patch, u, v, 1, 0)
           + c[1] * surface.derivative(patch, u, v, 0, 1);
  }
  const double* c = i > 0 ? a : b;
  const double* d = i > 1 ? a : b;
  return c[0] * d[0] * surface.derivative(patch, u, v, 2, 0)
         + (c[0] * d[1] + c[1] * d[0]) * surface.derivative(patch, u, v, 1, 1)
         + c[1] * d[1] * surface.derivative(patch, u, v, 0, 2);
}

// C2 across all sides of quads, but for the sides above corners on regular vertices
template <typename K>
void test_continuity(const CGAL::T_NURCC_surface_3<K>& surface, const Layout<K>& layout,
                     const std::set<std::pair<std::size_t, int> >& c0_sides)
{
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int s = 0; s < 4; ++s)
    {
      if(layout.is_border(q, s))
        continue;
      const auto other = layout.neighbor(q, s);
      const bool is_c0 = c0_sides.count(std::make_pair(q, s)) != 0;
      double jump_of_tangent = 0;
      for(const double t : {0.0625, 0.3, 0.5, 0.71875, 0.9})
        for(int i = 0; i <= 2; ++i)
          for(int j = 0; i + j <= 2; ++j)
          {
            const double sign = (i + j) == 1 ? -1 : 1;
            const double jump = std::sqrt(
              (derivative_at_side<K>(surface, {q, s}, t, i, j)
               - sign * derivative_at_side<K>(surface, other, 1 - t, i, j)).squared_length());
            if(i == 0 && j == 1)
              jump_of_tangent = (std::max)(jump_of_tangent, jump);
            assert(jump < 1e-9 || (is_c0 && j > 0));
          }
      assert(!is_c0 || jump_of_tangent > 1e-6);
    }
}

template <typename K>
void test_corner_lines()
{
  const Layout<K> flat = grid_layout<K>(4, 5);
  std::mt19937 generator(3);
  Layout<K> layout = flat;
  layout.set_corner(2, true);
  CGAL::T_NURCC_surface_3<K> surface(layout);
  assert(surface.number_of_t_junctions() == 2 && surface.is_valid());
  for(std::size_t i = 0; i < surface.number_of_control_points(); ++i)
    surface.set_control_point(i, surface.control_point(i)
                                 + typename K::Vector_3(0, 0, double(generator() % 100) / 100));
  // quads 1 and 2, and 5 and 6 above them, are those at the line of two knot intervals
  test_continuity(surface, layout, {{1, 1}, {2, 3}, {5, 1}, {6, 3}});
}

template <typename K>
void move_control_points(CGAL::T_NURCC_surface_3<K>& surface, std::mt19937& generator)
{
  for(std::size_t i = 0; i < surface.number_of_control_points(); ++i)
    surface.set_control_point(i, surface.control_point(i)
                                 + typename K::Vector_3(0, 0, double(generator() % 100) / 100));
}

// T-vertices on the rings of an extraordinary point, and a refined boundary next to it
template <typename K>
void test_refined_continuity(int n, int m)
{
  typedef CGAL::T_NURCC_surface_3<K> Surface;
  std::mt19937 generator(static_cast<unsigned int>(10 * n + m));
  Layout<K> layout = fan_layout<K>(n, m);
  add_chains(layout, 0, generator);
  Surface surface(layout);
  for(int step = 0; step < 3; ++step)
  {
    const auto knots = surface.boundary_curve(0).knots;
    surface.refine_boundary({{0, knots.front(), knots[knots.size() / 2]}});
    surface.refine(std::vector<typename Surface::Patch_split>{
      {generator() % surface.number_of_patches(), true, false}});
    move_control_points(surface, generator);
    assert(surface.is_valid());
    test_continuity(surface, layout, {});
  }
}

// a corner whose edge ends at an extraordinary point: there the normal is continuous nevertheless
template <typename K>
void test_corner_at_extraordinary_point()
{
  std::mt19937 generator(5);
  Layout<K> layout = fan_layout<K>(5, 1);
  std::size_t quad = 0;
  int side = 0; // the edge from the extraordinary point, which is vertex 0
  while(layout.vertex(quad, side) != 0)
    ++side;
  layout.set_corner(layout.vertex(quad, side + 1), true);
  CGAL::T_NURCC_surface_3<K> surface(layout);
  assert(surface.is_valid() && surface.number_of_patches() == layout.number_of_quads());
  move_control_points(surface, generator);
  const auto other = layout.neighbor(quad, side);
  test_continuity(surface, layout, {{quad, side}, {other.first, other.second}});
}

template <typename K>
void test_kernel()
{
  test_tensor_product<K>();
  test_corner_lines<K>();
  test_catmull_clark<K>({{{0, 0, 0}}});
  test_catmull_clark<K>(stairs());
  test_catmull_clark<K>(two_holes());
  for(const int n : {3, 5, 6, 8})
    for(const int m : {1, 2, 3})
    {
      const Layout<K> layout = fan_layout<K>(n, m);
      const CGAL::T_NURCC_surface_3<K> surface(layout);
      assert(surface.is_valid() && surface.number_of_extraordinary_points() == 1);
      test_continuity(surface, layout, {});
      test_derivatives(layout);
      test_refined_continuity<K>(n, m);
    }
  test_corner_at_extraordinary_point<K>();
  const Layout<K> layout = cubes_layout<K>(stairs(), true);
  test_continuity(CGAL::T_NURCC_surface_3<K>(layout), layout, {});
}

int main()
{
  test_kernel<CGAL::Simple_cartesian<double> >();
  test_kernel<CGAL::Exact_predicates_inexact_constructions_kernel>();
  std::cout << "done" << std::endl;
  return EXIT_SUCCESS;
}
