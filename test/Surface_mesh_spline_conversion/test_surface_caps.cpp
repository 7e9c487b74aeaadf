// Surfaces with caps at extraordinary points: smooth, sizes as the layout demands, the same however
// the surface has been refined.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/T_NURCC_surface_3.h>

#include "T_NURCC_test_layouts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <random>
#include <vector>

typedef CGAL::Simple_cartesian<double> K;
typedef K::Vector_3 Vector_3;
typedef CGAL::T_NURCC_surface_3<K> Surface;
typedef Surface::Patch_origin Patch_origin;

double length(const Vector_3& v) { return std::sqrt(v.squared_length()); }

// the point at `s` along a side of a rectangle, counter clockwise
std::array<double, 2> on_side(const Patch_origin& o, int side, double s)
{
  const double u = o.u0 + s * (o.u1 - o.u0), v = o.v0 + s * (o.v1 - o.v0);
  switch(side)
  {
    case 0: return {{u, o.v0}};
    case 1: return {{o.u1, v}};
    case 2: return {{o.u0 + o.u1 - u, o.v1}};
    default: return {{o.u0, o.v0 + o.v1 - v}};
  }
}

// points and normals of quads agree on their common sides, extraordinary points included
void check_sides_of_quads(const Layout<K>& layout, const Surface& surface)
{
  const Patch_origin whole = {0, 0, 0, 1, 1};
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
      for(int k = 0; k <= 64 && !layout.is_border(q, i); ++k)
      {
        const auto other = layout.neighbor(q, i);
        const auto a = on_side(whole, i, k / 64.), b = on_side(whole, other.second, 1 - k / 64.);
        const std::size_t p = surface.patch_at(q, a[0], a[1]);
        const std::size_t r = surface.patch_at(other.first, b[0], b[1]);
        assert(length(surface.position(p, a[0], a[1]) - surface.position(r, b[0], b[1])) < 1e-12);
        assert(length(surface.normal(p, a[0], a[1]) - surface.normal(r, b[0], b[1])) < 1e-9);
      }
}

// the square of a cap; an empty one if there is none
Patch_origin square(const Surface& surface, std::size_t patch, int corner)
{
  Patch_origin o = surface.patch_origin(patch);
  const int level = surface.cap_level(patch, corner);
  const double size = level < 0 ? 0 : std::ldexp(o.u1 - o.u0, -level);
  (corner == 0 || corner == 3 ? o.u1 : o.u0) = corner == 0 || corner == 3 ? o.u0 + size : o.u1 - size;
  (corner < 2 ? o.v1 : o.v0) = corner < 2 ? o.v0 + size : o.v1 - size;
  return o;
}

// Along its outer sides a cap has the tangents of the surface without caps; its derivatives are
// limits of differences, and the bound of the functions holds.
void check_cap(const Surface& surface, const Surface& limit, std::size_t patch, int corner)
{
  constexpr double step = 1e-6;
  const Patch_origin o = square(surface, patch, corner);
  for(int side : {(corner + 1) & 3, (corner + 2) & 3})
    for(int k = 0; k <= 16; ++k)
    {
      const auto a = on_side(o, side, k / 16.);
      assert(length(surface.position(patch, a[0], a[1]) - limit.position(patch, a[0], a[1])) < 1e-12);
      for(int i = 0; i < 2; ++i)
        assert(length(surface.derivative(patch, a[0], a[1], i, 1 - i)
                      - limit.derivative(patch, a[0], a[1], i, 1 - i)) < 1e-10);
    }
  std::vector<Surface::Basis_function> functions;
  for(double s : {0.1, 0.5, 0.8})
    for(double t : {0.2, 0.7})
    {
      const double u = o.u0 + s * (o.u1 - o.u0), v = o.v0 + t * (o.v1 - o.v0);
      surface.basis(patch, u, v, 2, functions);
      double sum = 0;
      for(const auto& f : functions)
        sum += std::abs(f.value[0]);
      assert(1 <= sum + 1e-12 && sum <= surface.basis_bound(patch));
      for(int order = 0; order < 2; ++order)
        for(int i = 0; i < 2; ++i)
        {
          const auto value = [&](double x, double y)
          {
            return order == 0 ? surface.position(patch, x, y) - CGAL::ORIGIN
                              : surface.derivative(patch, x, y, 0, 1);
          };
          const Vector_3 difference = (value(u + (1 - i) * step, v + i * step)
                                       - value(u - (1 - i) * step, v - i * step)) / (2 * step);
          const Vector_3 derivative = surface.derivative(patch, u, v, 1 - i, i + order);
          assert(length(difference - derivative) < 1e-6 * (1 + length(derivative)));
        }
    }
}

// returns the number of sectors of caps
std::size_t check_caps(const Layout<K>& layout, const Surface& surface)
{
  assert(surface.has_caps() && surface.is_valid());
  check_sides_of_quads(layout, surface);
  Surface limit = surface;
  limit.set_caps(false);
  assert(!limit.has_caps());
  std::size_t result = 0;
  for(std::size_t p = 0; p < surface.number_of_patches(); ++p)
    for(int corner = 0; corner < 4; ++corner)
    {
      assert(limit.cap_level(p, corner) == -1 && limit.basis_bound(p) == 1);
      if(surface.cap_level(p, corner) < 0)
        continue;
      ++result;
      check_cap(surface, limit, p, corner);
    }
  return result;
}

// The largest squares that touch neither the boundary nor one another: of the patches, of half of
// them at distance one from the boundary, and of a quarter between neighbours.
void test_levels()
{
  for(int valence : {3, 5, 6, 7, 8, 11})
    for(int m : {1, 2, 3})
    {
      Layout<K> layout = fan_layout<K>(valence, m);
      std::mt19937 generator(1);
      add_chains(layout, 0, generator);
      Surface surface(layout);
      surface.set_caps(true);
      assert(check_caps(layout, surface) == std::size_t(valence));
      for(std::size_t p = 0; p < surface.number_of_patches(); ++p)
        for(int corner = 0; corner < 4; ++corner)
          assert(surface.cap_level(p, corner) == -1 || surface.cap_level(p, corner) == (m == 1));
    }
  const Layout<K> layout = cubes_layout<K>({{{0, 0, 0}}}, false);
  Surface surface(layout);
  surface.set_caps(true);
  assert(check_caps(layout, surface) == 24);
  for(std::size_t p = 0; p < 6; ++p)
    for(int corner = 0; corner < 4; ++corner)
      assert(surface.cap_level(p, corner) == 2);
}

bool has_functions_of(const Surface& a, std::size_t p, const Surface& b, std::size_t q)
{
  const Patch_origin o = a.patch_origin(p);
  std::vector<Surface::Basis_function> f, g;
  for(int k = 0; k < 25; ++k)
  {
    const double u = o.u0 + (o.u1 - o.u0) * (0.03 + 0.235 * (k % 5));
    const double v = o.v0 + (o.v1 - o.v0) * (0.03 + 0.235 * (k / 5));
    a.basis(p, u, v, 0, f);
    b.basis(q, u, v, 0, g);
    for(auto* functions : {&f, &g})
      std::sort(functions->begin(), functions->end(), [](const auto& x, const auto& y)
        { return x.control_point < y.control_point; });
    const bool is_equal = std::equal(f.begin(), f.end(), g.begin(), g.end(),
      [](const auto& x, const auto& y)
      { return x.control_point == y.control_point && std::abs(x.value[0] - y.value[0]) < 1e-12; });
    if(!is_equal)
      return false;
  }
  return true;
}

// A surface that has had caps while it was refined is the one that gets them afterwards, and the
// stamps tell what has changed on the way.
void test_refinement(const Layout<K>& layout, unsigned int seed)
{
  std::mt19937 generator(seed);
  Surface surface(layout), plain(layout);
  surface.set_caps(true);
  for(int i = 0; i < 4; ++i)
  {
    const Surface before = surface;
    const std::vector<Surface::Patch_split> splits
      = {{generator() % surface.number_of_patches(), true, i % 2 == 0}};
    surface.refine(splits);
    plain.refine(splits);
    assert(check_caps(layout, surface) > 0);
    Surface other = plain;
    other.set_caps(true);
    for(std::size_t p = 0; p < surface.number_of_patches(); ++p)
    {
      assert(has_functions_of(surface, p, other, p));
      const Patch_origin r = surface.patch_origin(p);
      const std::size_t q = before.patch_at(r.quad, (r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2);
      const Patch_origin s = before.patch_origin(q);
      if(r.u0 == s.u0 && r.u1 == s.u1 && r.v0 == s.v0 && r.v1 == s.v1
         && surface.basis_stamp(p) == before.basis_stamp(q))
        assert(has_functions_of(surface, p, before, q));
    }
  }
}

int main()
{
  test_levels();
  for(unsigned int seed : {1, 2, 3})
  {
    test_refinement(cubes_layout<K>(stairs(), false), seed);
    test_refinement(cubes_layout<K>(two_holes(), false), seed);
  }
  return EXIT_SUCCESS;
}
