// The target of the fits: continuity, interpolation of the curves, coincidence with the mesh, the
// correspondence between parameter and arc length, and foot points.
#include "synthetic_layout.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/patches/smooth_correspondence.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace internal = CGAL::Surface_mesh_spline_conversion::internal;
using namespace synthetic;

double distance(const Point& p, const Point& q) { return std::sqrt(CGAL::squared_distance(p, q)); }

// neighbouring patches agree along their common side; the boundary is the curve at the parameter
void test_sides(const Input& input)
{
  const Target& target = input.target();
  const Layout& layout = input.layout();
  std::size_t boundary_sides = 0;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
    {
      const Layout::Side other = layout.neighbor(q, i);
      boundary_sides += layout.is_border(q, i) ? 1 : 0;
      for(int k = 0; k <= 32; ++k)
      {
        const double t = k / 32.;
        const auto here = internal::from_side<double>(i, t, 0.);
        const Point p = target.point(q, here[0], here[1]);
        if(layout.is_border(q, i))
        {
          // the limit from inside is the curve, too
          const auto inside = internal::from_side<double>(i, t, 1e-10);
          assert(distance(p, target.point(q, inside[0], inside[1])) < 1e-8);
          continue;
        }
        const auto there = internal::from_side<double>(other.second, 1 - t, 0.);
        assert(distance(p, target.point(other.first, there[0], there[1])) < 1e-12);
      }
    }
  std::size_t sides = 0;
  for(std::size_t c = 0; c < target.number_of_chains(); ++c)
  {
    const std::vector<Layout::Side> chain = layout.chain_sides(c);
    assert(chain.size() == target.number_of_sides(c));
    for(std::size_t k = 0; k < chain.size(); ++k)
      for(double t : {0., 0.3, 0.5, 0.9})
      {
        const auto uv = internal::from_side<double>(chain[k].second, t, 0.);
        const double x = double(k) + t;
        assert(distance(target.point(chain[k].first, uv[0], uv[1]), target.curve_point(c, x))
               < 1e-14);
        assert(distance(target.curve_point(c, x),
                        input.network().point(c, target.arc_length(c, x))) < 1e-14);
      }
    sides += chain.size();
  }
  assert(sides == boundary_sides);
}

// s(x) is monotone and C2, and its derivatives are those of the point
void test_curves(const Input& input, double smallest_speed)
{
  const Target& target = input.target();
  for(std::size_t c = 0; c < target.number_of_chains(); ++c)
  {
    const double n = double(target.number_of_sides(c));
    const double mean = input.network().length(c) / n;
    if(!target.is_closed(c))
      assert(target.arc_length(c, 0) == 0
             && std::abs(target.arc_length(c, n) - input.network().length(c)) < 1e-14);
    for(int k = 1; k < 200; ++k)
    {
      const double x = n * k / 200, h = 1e-3;
      const double quotient
        = (target.arc_length(c, x + h) - target.arc_length(c, x - h)) / (2 * h);
      const Vector first = target.curve_derivative(c, x, 1);
      assert(quotient > smallest_speed * mean);
      assert(std::abs(std::sqrt(first.squared_length()) - quotient) < 1e-4 * mean);
      const Vector before = target.curve_derivative(c, x - h, 1),
                   after = target.curve_derivative(c, x + h, 1);
      const Vector second = target.curve_derivative(c, x, 2);
      assert(std::sqrt(((after - before) / (2 * h) - second).squared_length()) < 1e-2 * mean);
    }
    for(int k = 1; k < int(n); ++k) // no jump of the second derivative at quad vertices
    {
      const double h = 1e-9;
      const Vector jump
        = target.curve_derivative(c, k + h, 2) - target.curve_derivative(c, k - h, 2);
      assert(std::sqrt(jump.squared_length()) < 1e-6 * mean);
    }
  }
}

void test_inside(const Input& input)
{
  const Target& target = input.target();
  std::size_t inner = 0;
  double largest_size = 0;
  for(std::size_t q = 0; q < input.layout().number_of_quads(); ++q)
    largest_size = (std::max)(largest_size, target.quad_size(q));
  for(std::size_t q = 0; q < input.layout().number_of_quads(); ++q)
    for(double u : {0.1, 0.45, 0.8})
      for(double v : {0.2, 0.55, 0.9})
      {
        const Point p = target.point(q, u, v);
        assert(distance(target.foot_point(p, q, u, v), p) < 1e-14);
        std::size_t face;
        assert(target.point(q, u, v, face) == p);
        const Point near = p + 0.02 * target.quad_size(q) * Vector(-0.4, 0.2, 0.6);
        assert(target.foot_point(near, q, u, v, p, face) == target.foot_point(near, q, u, v));
        if(target.is_boundary_quad(q))
          continue;
        ++inner;
        assert(p == input.layout().inverse_map()(q, u, v).point);
        // a foot point is not further away, and the difference is orthogonal to the mesh
        const Point lifted = p + 0.02 * target.quad_size(q) * Vector(0.5, -0.3, 0.8);
        const Point foot = target.foot_point(lifted, q, u, v);
        assert(distance(lifted, foot) <= distance(lifted, p));
        assert(distance(target.foot_point(foot, q, u, v), foot) < 1e-12);
        std::size_t near_face = face;
        assert(distance(target.foot_point(lifted, q, u, v, p, face, near_face), foot) < 1e-12);
        std::size_t again = near_face;
        assert(target.foot_point(lifted, q, u, v, p, face, again) == foot && again == near_face);
        // the foot of a far point may lie anywhere, and is not accepted far away
        const Point far = target.foot_point(p + Vector(10, 7, 8), q, u, v);
        assert(distance(far, p) <= 0.5 * largest_size);
      }
  assert(inner > 0);
}

// In quads with a boundary side the foot is as close as the best of a fine grid, up to what the
// displacement changes in between.
void test_feet_in_boundary_quads(const Input& input)
{
  const Target& target = input.target();
  for(std::size_t q = 0; q < input.layout().number_of_quads(); q += 3)
  {
    if(!target.is_boundary_quad(q))
      continue;
    const double size = target.quad_size(q);
    const Point p = target.point(q, 0.4, 0.6) + 0.02 * size * Vector(0.6, 0.5, 0.7);
    double best = distance(p, target.point(q, 0.4, 0.6));
    for(int i = -20; i <= 20; ++i)
      for(int j = -20; j <= 20; ++j)
        best = (std::min)(best, distance(p, target.point(q, 0.4 + i / 200., 0.6 + j / 200.)));
    assert(distance(p, target.foot_point(p, q, 0.4, 0.6)) < 1.2 * best + 2e-3 * size);
  }
}

double squared_distance_from_mesh(const Point& p, const Mesh& mesh)
{
  double result = std::numeric_limits<double>::infinity();
  for(Mesh::Face_index f : mesh.faces())
  {
    std::vector<Point> corners;
    for(Mesh::Vertex_index v : vertices_around_face(halfedge(f, mesh), mesh))
      corners.push_back(mesh.point(v));
    result = (std::min)(result, CGAL::squared_distance(
      p, Kernel::Triangle_3(corners[0], corners[1], corners[2])));
  }
  return result;
}

double squared_distance_from_boundary(const Point& p, const Mesh& mesh)
{
  double result = std::numeric_limits<double>::infinity();
  for(Mesh::Edge_index e : mesh.edges())
    if(mesh.is_border(e))
      result = (std::min)(result, CGAL::squared_distance(
        p, Kernel::Segment_3(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)))));
  return result;
}

// a plane over the unit square with a narrow ridge at x = 25/48, between the vertices of a mesh with
// 24 columns: the gaps of the edges there are large, all others vanish
Surface ridge(double height)
{
  auto bell = [height](double a, int i)
  {
    constexpr double width = 0.005;
    const double x = (a - 25. / 48) / width, e = height * std::exp(-x * x / 2);
    return i == 0 ? e : (i == 1 ? -x * e / width : (x * x - 1) * e / (width * width));
  };
  Surface s;
  s.point = [bell](double a, double b) { return Point(a, b, bell(a, 0)); };
  s.derivative = [bell](double a, double b, int i, int j)
  {
    return Vector(i == 0 && j == 0 ? a : (i == 1 && j == 0 ? 1 : 0),
                  i == 0 && j == 0 ? b : (i == 0 && j == 1 ? 1 : 0), j == 0 ? bell(a, i) : 0);
  };
  return s;
}

// parameter lines that are inclined by up to 70 degrees along the lower and upper side
std::array<double, 2> inclined(double a, double b)
{
  const double pi = CGAL_PI;
  return {{a + 0.9 * std::sin(3 * pi * b) * std::sin(pi * a) / pi, b}};
}

// A gap does not reach to points whose nearest edge of the boundary is farther along than two edges,
// where measure_deviation() does not tolerate it.
void test_single_gap()
{
  constexpr double height = 0.02, column = 1. / 24, negligible = 0.5e-3;
  const Input input(ridge(height), 2, 2, 12, inclined);
  test_sides(input);
  std::size_t displaced = 0, inclined_places = 0;
  for(std::size_t q = 0; q < 2; ++q)
    for(double u = 1. / 128; u < 1; u += 1. / 64)
      for(double v = 1. / 128; v < 0.5; v += 1. / 128)
      {
        const Point p = input.target().point(q, u, v);
        const double to_side = (std::min)({p.x(), 1 - p.x(), 1 - p.y()});
        const bool is_near_gap
          = p.y() <= to_side && std::abs(p.x() - 25. / 48) < 2.5 * column + 1e-9;
        displaced += is_near_gap && p.z() > height / 10 ? 1 : 0;
        const double x = (double(q) + u) / 2;
        inclined_places += !is_near_gap && std::abs(x - 25. / 48) < column / 2 ? 1 : 0;
        assert(is_near_gap || std::abs(p.z()) < negligible * input.network().diameter() + 1e-6);
      }
  assert(displaced > 10 && inclined_places > 10);
}

double mean_edge_length_of_faces(const Mesh& mesh)
{
  double sum = 0;
  for(Mesh::Halfedge_index h : mesh.halfedges())
    if(!mesh.is_border(h))
      sum += distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)));
  return sum / (3. * mesh.number_of_faces());
}

// In a quad that is much wider than the edges of the mesh, the gap between curve and chord does not
// reach farther than the three edges within which measure_deviation() tolerates it.
void test_wide_boundary_quads(const Input& input)
{
  const Target& target = input.target();
  const double band = 3 * mean_edge_length_of_faces(input.mesh());
  std::size_t beyond = 0, displaced = 0;
  for(std::size_t q = 0; q < input.layout().number_of_quads(); ++q)
    for(double u = 1. / 64; u < 1; u += 1. / 32)
      for(double v = 1. / 64; v < 1; v += 1. / 32)
      {
        assert(target.is_boundary_quad(q));
        const Point p = target.point(q, u, v);
        const double d = std::sqrt(squared_distance_from_mesh(p, input.mesh()));
        if(std::sqrt(squared_distance_from_boundary(p, input.mesh())) > 1.001 * band)
        {
          assert(target.is_on_mesh(q, u, v) && d < 1e-12);
          ++beyond;
        }
        else if(d > 1e-6)
        {
          assert(!target.is_on_mesh(q, u, v));
          ++displaced;
        }
      }
  assert(beyond > 100 && displaced > 100);
}

// arc lengths that no smooth curve can follow within the bounds still give a monotone function
void test_extreme_arc_lengths()
{
  const std::vector<std::vector<double> > inputs = {
    {0, 1}, {0, 1, 1.001, 1.002, 9, 9.001, 20}, {0, 5, 5.0001, 10}, {0, 1, 2, 3, 4, 400}};
  for(bool is_closed : {false, true})
    for(const std::vector<double>& arc_lengths : inputs)
    {
      const internal::Boundary_correspondence s = internal::Correspondence_smoother(
        arc_lengths, std::vector<bool>(arc_lengths.size(), false), is_closed)();
      const double n = double(arc_lengths.size() - 1);
      assert(s.is_closed() == is_closed);
      assert(is_closed || (s(0) == 0 && s(n) == arc_lengths.back()));
      assert(!is_closed || std::abs(s(n + 0.25) - s(0.25) - arc_lengths.back()) < 1e-12);
      for(int k = 0; k < 1000; ++k)
        assert(s(n * k / 1000.) < s(n * (k + 1) / 1000.));
    }
}

int main()
{
  for(double jitter : {0., 0.5})
  {
    const Input graph(height_field(0.3), 7, 5, 4, jittered(7, 5, jitter));
    test_sides(graph);
    test_curves(graph, 0.4);
    test_inside(graph);
    test_feet_in_boundary_quads(graph);
    const Input band(torus_band(2, 0.5), 9, 4, 4, jittered(9, 4, jitter));
    test_sides(band);
    test_curves(band, 0.4);
    test_inside(band);
    test_feet_in_boundary_quads(band);
  }
  // one quad with four boundary sides, quads with two opposite ones, with three
  test_sides(Input(height_field(0.3), 1, 1, 5));
  test_sides(Input(height_field(0.3), 4, 1, 5, jittered(4, 1, 0.4)));
  test_sides(Input(torus_band(2, 0.5), 5, 1, 5, jittered(5, 1, 0.4)));
  test_sides(Input(notched_graph(), 6, 3, 5));
  for(double jitter : {0., 0.4})
  {
    const Input wide(height_field(0.3), 2, 2, 12, jittered(2, 2, jitter));
    test_sides(wide);
    test_feet_in_boundary_quads(wide);
    test_wide_boundary_quads(wide);
  }
  test_single_gap();
  test_extreme_arc_lengths();
  return 0;
}
