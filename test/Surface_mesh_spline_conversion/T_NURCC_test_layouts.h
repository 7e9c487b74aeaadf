#ifndef T_NURCC_TEST_LAYOUTS_H
#define T_NURCC_TEST_LAYOUTS_H

#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/number_type_config.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <set>
#include <vector>

// generated quad layouts for the tests of the T-NURCC surface

template <typename K>
using Layout = CGAL::Surface_mesh_spline_conversion::Quad_layout<K>;

// m x n unit squares in the plane
template <typename K>
Layout<K> grid_layout(std::size_t m, std::size_t n)
{
  std::vector<typename K::Point_3> points;
  std::vector<std::array<std::size_t, 4> > quads;
  for(std::size_t j = 0; j <= n; ++j)
    for(std::size_t i = 0; i <= m; ++i)
      points.emplace_back(double(i), double(j), 0);
  for(std::size_t j = 0; j < n; ++j)
    for(std::size_t i = 0; i < m; ++i)
    {
      const std::size_t a = j * (m + 1) + i;
      quads.push_back({{a, a + 1, a + m + 2, a + m + 1}});
    }
  return Layout<K>(points, quads);
}

// n sectors of m x m quads around a vertex, which has the distance m from the boundary
template <typename K>
Layout<K> fan_layout(int n, int m)
{
  auto index = [n, m](int k, int a, int b) -> std::size_t
  {
    if(a == 0 && b == 0)
      return 0;
    if(a == 0)
    {
      ++k;
      a = b;
      b = 0;
    }
    return std::size_t(1 + (k % n) * m * (m + 1) + (a - 1) * (m + 1) + b);
  };
  std::vector<typename K::Point_3> points(std::size_t(1 + n * m * (m + 1)));
  std::vector<std::array<std::size_t, 4> > quads;
  for(int k = 0; k < n; ++k)
    for(int a = 0; a <= m; ++a)
      for(int b = 0; b <= m; ++b)
      {
        const double s = 2 * CGAL_PI * k / n, t = 2 * CGAL_PI * (k + 1) / n;
        if(a > 0 || b == 0)
          points[index(k, a, b)] = typename K::Point_3(a * std::cos(s) + b * std::cos(t),
            a * std::sin(s) + b * std::sin(t), 0.1 * a * b - 0.05 * a * a * std::sin(k));
        if(a < m && b < m)
          quads.push_back({{index(k, a, b), index(k, a + 1, b), index(k, a + 1, b + 1),
                            index(k, a, b + 1)}});
      }
  return Layout<K>(points, quads);
}

// the boundary of a set of cubes, somewhat distorted; without the lower sides if `is_open`
template <typename K>
Layout<K> cubes_layout(const std::set<std::array<int, 3> >& cubes, bool is_open)
{
  std::map<std::array<int, 3>, std::size_t> indices;
  std::vector<typename K::Point_3> points;
  std::vector<std::array<std::size_t, 4> > quads;
  auto index = [&](const std::array<int, 3>& a)
  {
    const auto result = indices.emplace(a, points.size());
    if(result.second)
      points.emplace_back(a[0] + 0.1 * std::sin(3. * a[1] + a[2]), a[1] + 0.1 * std::cos(2. * a[0]),
                          1.2 * a[2] + 0.05 * a[0] * a[1]);
    return result.first->second;
  };
  for(const std::array<int, 3>& cube : cubes)
    for(std::size_t axis = 0; axis < 3; ++axis)
      for(int side = 0; side < 2; ++side)
      {
        std::array<int, 3> neighbor = cube;
        neighbor[axis] += 2 * side - 1;
        if(cubes.count(neighbor) || (is_open && axis == 2 && neighbor[2] < 0))
          continue;
        std::array<std::size_t, 4> quad;
        for(std::size_t k = 0; k < 4; ++k)
        {
          std::array<int, 3> v = cube;
          v[axis] += side;
          v[(axis + 1) % 3] += (k == 1 || k == 2) ? 1 : 0;
          v[(axis + 2) % 3] += k / 2;
          quad[k] = index(v);
        }
        if(side == 0)
          std::swap(quad[1], quad[3]);
        quads.push_back(quad);
      }
  return Layout<K>(points, quads);
}

// a plate with three extraordinary points of valence 5, six of valence 3 ... in adjacent quads
inline std::set<std::array<int, 3> > stairs()
{
  std::set<std::array<int, 3> > cubes;
  for(int x = 0; x < 4; ++x)
    for(int y = 0; y < 4; ++y)
      cubes.insert({{x, y, 0}});
  cubes.insert({{1, 1, 1}});
  cubes.insert({{2, 1, 1}});
  cubes.insert({{1, 2, 1}});
  return cubes;
}

// a plate with two holes, of genus 2
inline std::set<std::array<int, 3> > two_holes()
{
  std::set<std::array<int, 3> > cubes;
  for(int x = 0; x < 5; ++x)
    for(int y = 0; y < 3; ++y)
      if(y != 1 || x % 2 == 0)
        cubes.insert({{x, y, 0}});
  return cubes;
}

// numbers of quads at the vertices
template <typename K>
std::vector<int> valences(const Layout<K>& layout)
{
  std::vector<int> result(layout.number_of_vertices(), 0);
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
      ++result[layout.vertex(q, i)];
  return result;
}

// marks the convex corners, and others at random, and cuts the boundary into chains
template <typename K>
void add_chains(Layout<K>& layout, double share_of_corners, std::mt19937& generator)
{
  typedef typename Layout<K>::Side Side;
  std::map<std::size_t, Side> boundary; // by the first vertex
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
      if(layout.is_border(q, i))
        boundary[layout.vertex(q, i)] = Side(q, i);
  const std::vector<int> valence = valences(layout);
  for(const auto& entry : boundary)
    layout.set_corner(entry.first, valence[entry.first] == 1
                                   || generator() % 1000 < 1000 * share_of_corners);
  std::size_t chain = 0;
  std::set<std::size_t> done;
  for(const bool is_at_corner : {true, false})
    for(const auto& entry : boundary)
    {
      if(done.count(entry.first) || (is_at_corner && !layout.is_corner(entry.first)))
        continue;
      std::size_t v = entry.first;
      double length = 0;
      do
      {
        done.insert(v);
        const Side side = boundary[v];
        layout.set_boundary_side(side.first, side.second, {chain, length, length + 1});
        length += 1;
        v = layout.vertex(side.first, side.second + 1);
      }
      while(v != entry.first && !layout.is_corner(v));
      ++chain;
    }
}

#endif // T_NURCC_TEST_LAYOUTS_H
