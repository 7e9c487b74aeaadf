// Refinement: what must not change, what a valid result is, on random parts of the boundary of
// layouts with all kinds of corners and with extraordinary points near the boundary.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Bezier_patches.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_samples.h>
#include <CGAL/T_NURCC_surface_3.h>

#include "T_NURCC_test_layouts.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iostream>

template <typename K>
using Surface = CGAL::T_NURCC_surface_3<K>;

template <typename K>
double largest_difference(const Surface<K>& a, const Surface<K>& b)
{
  double result = 0;
  for(std::size_t i = 0; i < a.number_of_patches(); ++i)
  {
    const auto r = a.patch_origin(i);
    for(const double s : {0., 0.01, 0.3, 0.5, 0.8, 1.})
      for(const double t : {0., 0.01, 0.3, 0.5, 0.8, 1.})
      {
        const double u = r.u0 + s * (r.u1 - r.u0), v = r.v0 + t * (r.v1 - r.v0);
        const auto p = a.position(i, u, v), q = b.position(b.patch_at(r.quad, u, v), u, v);
        result = (std::max)(result, std::sqrt(CGAL::squared_distance(p, q)));
      }
  }
  return result;
}

// the 16 functions of every regular Bezier element are linearly independent and sum up to one
template <typename K>
void check_local_basis(const Surface<K>& surface)
{
  std::vector<typename Surface<K>::Basis_function> basis;
  for(const auto& element : surface.bezier_elements(2))
  {
    const bool is_regular = !surface.is_extraordinary_patch(element.patch);
    Eigen::Matrix<double, 16, 16> matrix;
    for(int k = 0; k < 16; ++k)
    {
      const double u = element.u0 + (element.u1 - element.u0) * (0.1 + 0.26 * (k & 3));
      const double v = element.v0 + (element.v1 - element.v0) * (0.1 + 0.26 * (k >> 2));
      surface.basis(element.patch, u, v, 0, basis);
      double sum = 0;
      for(std::size_t i = 0; i < basis.size(); ++i)
      {
        sum += basis[i].value[0];
        if(is_regular)
          matrix(k, Eigen::Index(i)) = basis[i].value[0];
      }
      assert(std::abs(sum - 1) < 1e-12);
      assert(!is_regular || basis.size() == 16);
    }
    if(is_regular)
      assert(std::abs(matrix.fullPivLu().matrixLU().diagonal().cwiseAbs().minCoeff()) > 1e-9);
  }
}

// the exact elements reproduce the surface, and they cover it
template <typename K>
void check_bezier_elements(const Surface<K>& surface)
{
  double area = 0, area_of_patches = 0;
  for(std::size_t i = 0; i < surface.number_of_patches(); ++i)
  {
    const auto r = surface.patch_origin(i);
    area_of_patches += (r.u1 - r.u0) * (r.v1 - r.v0);
  }
  for(const auto& e : surface.bezier_elements(3))
  {
    area += (e.u1 - e.u0) * (e.v1 - e.v0);
    const double s = 0.3, t = 0.8;
    typename K::Vector_3 p = CGAL::NULL_VECTOR;
    const double binomial[4] = {1, 3, 3, 1};
    for(int j = 0; j < 4; ++j)
      for(int i = 0; i < 4; ++i)
        p = p + binomial[i] * binomial[j] * std::pow(s, i) * std::pow(1 - s, 3 - i) * std::pow(t, j)
                * std::pow(1 - t, 3 - j) * (e.points[std::size_t(4 * j + i)] - CGAL::ORIGIN);
    const auto q = surface.position(e.patch, e.u0 + s * (e.u1 - e.u0), e.v0 + t * (e.v1 - e.v0));
    const double error = std::sqrt(CGAL::squared_distance(CGAL::ORIGIN + p, q));
    assert(error < (e.is_extraordinary ? 0.01 : 1e-12));
  }
  assert(std::abs(area - area_of_patches) < 1e-9);
}

// grids of points of patches are the points one by one
template <typename K>
void check_grids(const Surface<K>& surface)
{
  const std::size_t nu = 6, nv = 4;
  std::vector<typename K::Point_3> points;
  for(std::size_t i = 0; i < surface.number_of_patches(); ++i)
  {
    const auto r = surface.patch_origin(i);
    surface.positions(i, nu, nv, points);
    assert(points.size() == (nu + 1) * (nv + 1));
    for(std::size_t k = 0; k < points.size(); ++k)
    {
      const double u = r.u0 + (r.u1 - r.u0) * double(k % (nu + 1)) / double(nu);
      const double v = r.v0 + (r.v1 - r.v0) * double(k / (nu + 1)) / double(nv);
      assert(CGAL::squared_distance(points[k], surface.position(i, u, v)) < 1e-24);
    }
  }
}

// patches in Bezier form have the points and derivatives of the surface
template <typename K>
void check_bezier_patches(const Surface<K>& surface)
{
  namespace internal = CGAL::Surface_mesh_spline_conversion::internal;
  internal::Bezier_patches<Surface<K> > patches(surface);
  for(std::size_t i = 0; i < surface.number_of_patches(); ++i)
  {
    patches.update(i);
    std::vector<Eigen::Vector3d> points;
    if(!surface.is_extraordinary_patch(i))
      patches.points(i, 4, 2, points);
    const auto r = surface.patch_origin(i);
    for(std::size_t k = 0; k < 15; ++k)
    {
      const double u = r.u0 + (r.u1 - r.u0) * double(k % 5) / 4;
      const double v = r.v0 + (r.v1 - r.v0) * double(k / 5) / 2;
      const Eigen::Vector3d p = internal::to_eigen(surface.position(i, u, v));
      assert(points.empty() || (points[k] - p).norm() < 1e-12);
      const auto q = patches.point_and_tangents(i, u, v);
      assert((q.point - p).norm() < 1e-12);
      assert((q.u - internal::to_eigen(surface.derivative(i, u, v, 1, 0))).norm() < 1e-10);
      assert((q.v - internal::to_eigen(surface.derivative(i, u, v, 0, 1))).norm() < 1e-10);
    }
  }
}

// a target that is no part of what is tested
template <typename K>
struct Flat_target
{
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;

  const Layout<K>& quads;

  const Layout<K>& layout() const { return quads; }
  std::size_t number_of_mesh_faces() const { return 0; }
  std::array<std::size_t, 6> points_of_mesh_face(std::size_t) const { return {}; }
  Point_3 mesh_point(std::size_t) const { return Point_3(0, 0, 0); }

  Point_3 point(std::size_t, double u, double v, std::size_t& face) const
  {
    face = 0;
    return Point_3(u, v, 0);
  }
};

// the values of the functions at the samples of a fit give the points of the surface
template <typename K>
void check_samples(const Surface<K>& surface, const Layout<K>& layout)
{
  namespace internal = CGAL::Surface_mesh_spline_conversion::internal;
  const Flat_target<K> target{layout};
  const internal::Interior_samples<Surface<K>, Flat_target<K> > samples(surface, target, nullptr);
  const auto error = [&](std::size_t i, const Eigen::Vector3d& p)
  {
    const auto at = samples.error_place(i);
    return (internal::to_eigen(surface.position(at.patch, at.u, at.v)) - p).norm();
  };
  for(std::size_t p = 0; p < surface.number_of_patches(); ++p)
  {
    const std::vector<Eigen::Vector3d> points = samples.surface_points(p);
    assert(points.size() == samples.grid(p).number_of_fit_samples());
    for(std::size_t k = 0; k < points.size(); ++k)
      assert(error(samples.error_sample(p, k), points[k]) < 1e-12);
    const std::vector<double>& values = samples.error_values(p);
    const std::size_t n = samples.number_of_functions(p), number = values.size() / n;
    assert(number == (surface.is_extraordinary_patch(p) ? samples.grid(p).number_of_error_samples()
                                                        : 0));
    for(std::size_t k = 0; k < number; ++k)
    {
      Eigen::Vector3d sum(0, 0, 0);
      for(std::size_t i = 0; i < n; ++i)
        sum += values[k * n + i]
               * internal::to_eigen(surface.control_point(samples.function(p, i)));
      assert(error(samples.first_error_sample(p) + k, sum) < 1e-12);
    }
  }
}

// Patches that a refinement has left with the same number have the same functions, and those whose
// functions have changed have another one. Returns how many have the same number.
template <typename K>
std::size_t check_stamps(const Surface<K>& before, const Surface<K>& after)
{
  typedef std::vector<typename Surface<K>::Basis_function> Basis;
  std::size_t result = 0;
  for(std::size_t i = 0; i < after.number_of_patches(); ++i)
  {
    const auto r = after.patch_origin(i);
    const std::size_t j = before.patch_at(r.quad, (r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2);
    const auto s = before.patch_origin(j);
    bool is_equal = r.u0 == s.u0 && r.u1 == s.u1 && r.v0 == s.v0 && r.v1 == s.v1;
    for(int k = 0; is_equal && k < 25; ++k)
    {
      const double u = r.u0 + (r.u1 - r.u0) * (0.03 + 0.235 * (k % 5));
      const double v = r.v0 + (r.v1 - r.v0) * (0.03 + 0.235 * (k / 5));
      Basis a, b;
      before.basis(j, u, v, 0, a);
      after.basis(i, u, v, 0, b);
      is_equal = std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& f, const auto& g)
        { return f.control_point == g.control_point && f.value[0] == g.value[0]; });
    }
    assert(is_equal == (after.basis_stamp(i) == before.basis_stamp(j)));
    result += is_equal ? 1 : 0;
  }
  return result;
}

// evaluates a boundary curve by its definition
template <typename K>
typename K::Point_3 curve_point(const Surface<K>& surface,
                                const typename Surface<K>::Boundary_curve& curve, double x)
{
  std::vector<double> knots(curve.knots.begin(), curve.knots.end());
  const std::size_t n = curve.control_points.size();
  if(curve.is_closed) // three knots more on both sides
  {
    const double length = knots.back();
    for(std::size_t i = 0; i < 3; ++i)
    {
      knots.insert(knots.begin(), knots[n - 1] - length);
      knots.push_back(knots[2 + 2 * i] + length);
    }
  }
  std::size_t span = 3;
  while(span + 5 < knots.size() && knots[span + 1] <= x)
    ++span;
  std::array<typename K::Vector_3, 4> d;
  for(std::size_t i = 0; i < 4; ++i)
  {
    // the first knot of a periodic function is the second before its own
    const std::size_t k = curve.is_closed ? (span - 3 + i + 2 * n - 1) % n : span - 3 + i;
    d[i] = surface.control_point(curve.control_points[k]) - CGAL::ORIGIN;
  }
  for(std::size_t r = 1; r < 4; ++r)
    for(std::size_t i = 3; i >= r; --i)
    {
      const std::size_t j = span - 3 + i;
      const double a = (x - knots[j]) / (knots[j + 4 - r] - knots[j]);
      d[i] = (1 - a) * d[i - 1] + a * d[i];
    }
  return CGAL::ORIGIN + d[3];
}

// the boundary curves are the boundary of the surface
template <typename K>
void check_boundary(const Surface<K>& surface, const Layout<K>& layout)
{
  for(std::size_t c = 0; c < surface.number_of_boundary_chains(); ++c)
  {
    const auto curve = surface.boundary_curve(c);
    const auto sides = layout.chain_sides(c);
    assert(curve.knots.back() == double(sides.size()));
    assert(curve.knots.size() == curve.control_points.size() + (curve.is_closed ? 1 : 4));
    for(std::size_t k = 0; k < sides.size(); ++k)
      for(const double t : {0.0, 0.2, 0.45, 0.81, 0.99})
      {
        const double uv[4][2] = {{t, 0}, {1, t}, {1 - t, 1}, {0, 1 - t}};
        const double u = uv[sides[k].second][0], v = uv[sides[k].second][1];
        const auto p = surface.position(surface.patch_at(sides[k].first, u, v), u, v);
        assert(CGAL::squared_distance(p, curve_point(surface, curve, double(k) + t)) < 1e-24);
      }
  }
}

// the ring after one more subdivision is that of Catmull and Clark, its center has the right limit
// a refinement does not change the boundary curves
template <typename K>
double largest_boundary_difference(const Surface<K>& a, const Surface<K>& b)
{
  double result = 0;
  for(std::size_t c = 0; c < a.number_of_boundary_chains(); ++c)
  {
    const auto curve = a.boundary_curve(c), refined = b.boundary_curve(c);
    for(double x = 0.01; x < curve.knots.back(); x += 0.0931)
      result = (std::max)(result, CGAL::squared_distance(curve_point(a, curve, x),
                                                         curve_point(b, refined, x)));
  }
  return std::sqrt(result);
}

template <typename K>
void check_extraordinary_rings(const Surface<K>& surface)
{
  for(std::size_t i = 0; i < surface.number_of_extraordinary_points(); ++i)
  {
    const int level = surface.minimum_ring_level(i);
    const auto ring = surface.extraordinary_ring(i, level);
    const auto next = surface.extraordinary_ring(i, level + 1);
    const int n = ring.valence();
    typename K::Vector_3 limit = n * n * (ring.points[0] - CGAL::ORIGIN);
    for(int k = 0; k < n; ++k)
    {
      limit = limit + 4 * (ring.point(k, 1, 0) - CGAL::ORIGIN)
              + (ring.point(k, 1, 1) - CGAL::ORIGIN);
      const auto center = CGAL::centroid(ring.point(k, 0, 0), ring.point(k, 1, 0),
                                         ring.point(k, 1, 1), ring.point(k, 0, 1));
      assert(CGAL::squared_distance(center, next.point(k, 1, 1)) < 1e-24);
    }
    const auto& sector = ring.sectors.front();
    const double u = (sector.corner == 1 || sector.corner == 2) ? sector.u1 : sector.u0;
    const double v = sector.corner >= 2 ? sector.v1 : sector.v0;
    assert(CGAL::squared_distance(CGAL::ORIGIN + limit / (n * (n + 5)),
                                  surface.position(sector.patch, u, v)) < 1e-24);
  }
}

template <typename K>
void test_uniform_refinement(const Layout<K>& layout)
{
  Surface<K> surface(layout);
  assert(surface.is_valid() && surface.number_of_t_junctions() == 0);
  Surface<K> refined = surface;
  std::size_t patches = surface.number_of_patches();
  for(int k = 0; k < 2; ++k)
  {
    refined.refine_uniformly();
    patches *= 4;
    assert(refined.number_of_patches() == patches && refined.is_valid());
    assert(largest_difference(surface, refined) < 1e-13);
  }
  check_extraordinary_rings(surface);
  check_extraordinary_rings(refined);
  check_bezier_elements(surface);
}

template <typename K>
void test_boundary_refinement(Layout<K> layout, double share_of_corners, unsigned int seed)
{
  std::mt19937 generator(seed);
  add_chains(layout, share_of_corners, generator);
  Surface<K> surface(layout);
  assert(surface.error() == Surface<K>::Error_code::OK);
  for(int step = 0; step < 4; ++step)
  {
    check_boundary(surface, layout);
    const Surface<K> before = surface;
    std::vector<typename Surface<K>::Boundary_span> spans;
    for(std::size_t c = 0; c < surface.number_of_boundary_chains(); ++c)
    {
      const auto knots = surface.boundary_curve(c).knots;
      for(std::size_t i = 0; i + 1 < knots.size(); ++i)
        if(knots[i] < knots[i + 1] && generator() % 5 == 0)
          spans.push_back({c, knots[i], knots[i + 1]});
    }
    surface.refine_boundary(spans);
    assert(surface.is_valid());
    check_stamps(before, surface);
    for(const auto& span : spans)
    {
      const auto knots = surface.boundary_curve(span.chain).knots;
      assert(std::find(knots.begin(), knots.end(), (span.x0 + span.x1) / 2) != knots.end());
    }
    assert(largest_boundary_difference(before, surface) < 1e-12);
    if(surface.number_of_patches() == before.number_of_patches())
      assert(largest_difference(before, surface) < 1e-12);
    if(step == 1) // patches anywhere
    {
      std::vector<std::size_t> patches;
      for(std::size_t i = 0; i < surface.number_of_patches(); ++i)
        if(generator() % 16 == 0)
          patches.push_back(i);
      const std::size_t number_of_patches = surface.number_of_patches();
      surface.refine(patches);
      assert(surface.is_valid());
      assert(surface.number_of_patches() >= number_of_patches + 3 * patches.size());
    }
  }
  check_local_basis(surface);
  check_bezier_elements(surface);
  check_grids(surface);
  check_bezier_patches(surface);
  check_samples(surface, layout);
  check_boundary(surface, layout);
  check_extraordinary_rings(surface);
  std::cout << layout.number_of_quads() << " quads -> " << surface.number_of_patches()
            << " patches, " << surface.number_of_t_junctions() << " T-junctions" << std::endl;
}

// all knots at once give the surface of the step-by-step bisection of the spans around them
template <typename K>
void test_boundary_refinement_to_knots(Layout<K> layout, unsigned int seed)
{
  std::mt19937 generator(seed);
  add_chains(layout, 0.3, generator);
  const Surface<K> start(layout);
  assert(start.error() == Surface<K>::Error_code::OK);
  std::vector<std::vector<double> > knots(start.number_of_boundary_chains());
  for(std::size_t c = 0; c < knots.size(); c += 2) // the other chains are left as they are
  {
    const double last = start.boundary_curve(c).knots.back();
    for(int i = 0; i < 2; ++i)
      knots[c].push_back(last * double(generator() % 16) / 16);
    std::sort(knots[c].begin(), knots[c].end());
  }
  Surface<K> at_once = start, step_by_step = start;
  at_once.refine_boundary_to(knots);
  assert(at_once.is_valid());
  for(std::vector<typename Surface<K>::Boundary_span> spans(1); !spans.empty();)
  {
    spans.clear();
    for(std::size_t c = 0; c < knots.size(); ++c)
    {
      const auto present = step_by_step.boundary_curve(c).knots;
      for(std::size_t i = 0; i + 1 < present.size(); ++i)
        for(const double x : knots[c])
          if(present[i] < x && x < present[i + 1])
            spans.push_back({c, present[i], present[i + 1]});
    }
    step_by_step.refine_boundary(spans);
  }
  for(std::size_t c = 0; c < knots.size(); ++c)
  {
    const auto curve = at_once.boundary_curve(c);
    assert(curve.knots == step_by_step.boundary_curve(c).knots);
    for(const double x : knots[c])
      assert(std::binary_search(curve.knots.begin(), curve.knots.end(), x));
  }
  assert(at_once.number_of_patches() == step_by_step.number_of_patches());
  assert(at_once.number_of_control_points() == step_by_step.number_of_control_points());
  assert(largest_boundary_difference(start, at_once) < 1e-12);
}

template <typename K>
void test_kernel(unsigned int number_of_seeds)
{
  test_uniform_refinement<K>(grid_layout<K>(1, 1));
  test_uniform_refinement<K>(cubes_layout<K>(stairs(), false));
  test_uniform_refinement<K>(cubes_layout<K>(stairs(), true));
  for(const int n : {3, 5, 8})
    for(const int m : {1, 2})
      test_uniform_refinement<K>(fan_layout<K>(n, m));
  for(unsigned int seed = 0; seed < number_of_seeds; ++seed)
    for(const double share : {0., 0.3})
    {
      test_boundary_refinement<K>(grid_layout<K>(2 + seed, 3), share, seed);
      for(const int m : {1, 2, 3})
        test_boundary_refinement<K>(fan_layout<K>(seed == 0 ? 3 : 4 + int(seed), m), share, seed);
      test_boundary_refinement<K>(cubes_layout<K>(stairs(), true), share, seed);
    }
  for(unsigned int seed = 0; seed < 5 * number_of_seeds; ++seed)
  {
    test_boundary_refinement_to_knots<K>(grid_layout<K>(2 + seed % 4, 4), seed);
    test_boundary_refinement_to_knots<K>(cubes_layout<K>(stairs(), true), seed);
  }
}

// repeated refinement at one place of a large grid stays near that place
template <typename K>
void test_local_refinement()
{
  Layout<K> layout = grid_layout<K>(20, 20);
  std::mt19937 generator(1);
  add_chains(layout, 0, generator);
  Surface<K> surface(layout);
  for(int step = 0; step < 6; ++step)
    surface.refine_boundary({{0, 12.1, 12.1001}});
  assert(surface.is_valid());
  assert(surface.number_of_patches() < layout.number_of_quads() + 100);
}

// bisections of single patches in the middle of a grid stay single
template <typename K>
void test_directional_refinement()
{
  typedef typename Surface<K>::Patch_split Patch_split;
  const Surface<K> surface(grid_layout<K>(8, 8));
  for(const bool in_u : {true, false})
  {
    Surface<K> refined = surface;
    refined.refine(std::vector<Patch_split>{{refined.patch_at(27, 0.5, 0.5), in_u, !in_u}});
    assert(refined.is_valid());
    assert(refined.number_of_patches() == surface.number_of_patches() + 1);
    const auto r = refined.patch_origin(refined.patch_at(27, 0.25, 0.25));
    assert(r.u1 == (in_u ? 0.5 : 1) && r.v1 == (in_u ? 1 : 0.5));
    assert(largest_difference(surface, refined) < 1e-13);
    // the functions have changed on the two halves, and two patches further at most
    const std::size_t same = check_stamps(surface, refined);
    assert(same < surface.number_of_patches() && same + 25 >= surface.number_of_patches());
  }
}

// each patch of a surface that is refined to the patches of another one lies in one of those
template <typename K>
void check_patches_of_copy(const Surface<K>& surface, const Surface<K>& copy)
{
  assert(copy.is_valid());
  for(std::size_t i = 0; i < copy.number_of_patches(); ++i)
  {
    const auto r = copy.patch_origin(i);
    const auto s = surface.patch_origin(surface.patch_at(r.quad, (r.u0 + r.u1) / 2,
                                                         (r.v0 + r.v1) / 2));
    assert(s.u0 <= r.u0 && r.u1 <= s.u1 && s.v0 <= r.v0 && r.v1 <= s.v1);
  }
}

// refinement to given rectangles
template <typename K>
void test_refinement_to_rectangles(Layout<K> layout)
{
  typedef typename Surface<K>::Patch_origin Patch_origin;
  std::mt19937 generator(3);
  add_chains(layout, 0.3, generator);
  const Surface<K> surface(layout);
  std::vector<Patch_origin> patches;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    patches.push_back(Patch_origin{q, 0, 0, 1, 1});
  Surface<K> same = surface;
  same.refine_to(patches); // nothing is to be done
  assert(same.number_of_patches() == surface.number_of_patches()
         && largest_difference(surface, same) == 0);

  Surface<K> refined = surface, uniform = surface;
  for(int step = 0; step < 4; ++step)
    refined.refine(std::vector<std::size_t>{generator() % refined.number_of_patches()});
  patches.clear();
  for(std::size_t i = 0; i < refined.number_of_patches(); ++i)
    patches.push_back(refined.patch_origin(i));
  Surface<K> copy = surface;
  copy.refine_to(patches);
  check_patches_of_copy(refined, copy);
  assert(copy.number_of_patches() == refined.number_of_patches());

  // a small rectangle acts where it is
  uniform.refine_uniformly();
  copy = surface;
  copy.refine_to({Patch_origin{0, 0.25, 0.5, 0.5, 0.75}});
  const auto r = copy.patch_origin(copy.patch_at(0, 0.3, 0.6));
  assert(copy.is_valid() && r.u0 == 0.25 && r.u1 == 0.5 && r.v0 == 0.5 && r.v1 == 0.75);
  patches.clear();
  for(std::size_t i = 0; i < uniform.number_of_patches(); ++i)
    patches.push_back(uniform.patch_origin(i));
  copy = surface;
  copy.refine_to(patches);
  assert(copy.number_of_control_points() == uniform.number_of_control_points());
  assert(largest_difference(uniform, copy) < 1e-12);
}

// layouts that are not supported are reported
void test_errors()
{
  typedef CGAL::Simple_cartesian<double> K;
  typedef K::Point_3 Point;
  const std::vector<Point> points = {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0),
    Point(-1, 1, 0), Point(-1, 0, 0), Point(-1, -1, 0), Point(0, -1, 0)};
  const Layout<K> reentrant(points, {{{0, 1, 2, 3}}, {{0, 3, 4, 5}}, {{0, 5, 6, 7}}});
  const Surface<K> surface(reentrant);
  assert(surface.error() == Surface<K>::Error_code::NO_QUAD_LAYOUT);
  assert(surface.message().find("vertex 0") != std::string::npos);
  assert(surface.number_of_patches() == 0 && !surface.is_valid());
}

int main()
{
  test_kernel<CGAL::Simple_cartesian<double> >(3);
  test_kernel<CGAL::Exact_predicates_inexact_constructions_kernel>(1);
  test_local_refinement<CGAL::Simple_cartesian<double> >();
  test_directional_refinement<CGAL::Simple_cartesian<double> >();
  test_refinement_to_rectangles(grid_layout<CGAL::Simple_cartesian<double> >(4, 3));
  for(const int n : {3, 5, 6})
    test_refinement_to_rectangles(fan_layout<CGAL::Simple_cartesian<double> >(n, 2));
  test_errors();
  return EXIT_SUCCESS;
}
