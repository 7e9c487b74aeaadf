// Folds of the projection from a proxy are found, whatever their size: the proxy is a square with
// few triangles, and its original is the same square with bumps of which it is known, or found by
// many samples, whether the lines of projection meet them once. Unfolding makes the folds vanish.
// A projection does not leave the bar of a frame where it starts, whatever the faces of the places.

#include "generated_working_meshes.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Projection_fold_check.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Proxy_projection.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Surface_unfolder.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iostream>
#include <memory>
#include <random>
#include <vector>

namespace {

namespace internal = CGAL::Surface_mesh_spline_conversion::internal;
using internal::Proxy_mesh;
using internal::Working_location;
using internal::Working_mesh;

const int proxy_side = 4, original_side = 64; // edges per side of the square

Working_mesh make_square(int n)
{
  return Test::make_grid(n, n, false, false,
                         [n](double u, double v) { return Test::in_plane(u / n, v / n); },
                         Test::no_hole);
}

// the corner of a face of the mesh at a point
Working_location corner_at(const Working_mesh& mesh, const Eigen::Vector3d& p)
{
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    if(mesh.points[mesh.source(h)] == p)
    {
      Working_location place{h / 3, {{0, 0, 0}}};
      place.barycentric[h % 3] = 1;
      return place;
    }
  assert(false);
  return Working_location{-1, {{0, 0, 0}}};
}

// `move(p)` moves the points of the original but for those at vertices of the proxy
template <typename Move>
Proxy_mesh make_proxy(const Move& move)
{
  Proxy_mesh proxy;
  proxy.mesh = make_square(proxy_side);
  Working_mesh original = make_square(original_side);
  for(const Eigen::Vector3d& p : proxy.mesh.points)
  {
    proxy.place.push_back(corner_at(original, p));
    proxy.normal.push_back(Eigen::Vector3d::UnitZ());
  }
  std::vector<char> is_fixed(original.number_of_vertices(), 0);
  for(const Working_location& place : proxy.place)
    for(int i = 0; i < 3; ++i)
      if(place.barycentric[i] == 1)
        is_fixed[original.triangles[place.face][i]] = 1;
  for(int v = 0; v < original.number_of_vertices(); ++v)
    if(!is_fixed[v] && !original.is_border_vertex(v))
      move(original.points[v]);
  proxy.original = proxy.unfolded = std::make_shared<const Working_mesh>(original);
  return proxy;
}

std::vector<int> folded_faces(const Proxy_mesh& proxy, std::vector<int>& below)
{
  std::vector<int> faces;
  internal::Projection_fold_check check(proxy);
  for(int f = 0; f < proxy.mesh.number_of_faces(); ++f)
  {
    const std::size_t before = below.size();
    check.append_folded(f, below);
    const bool is_some_below = below.size() > before;
    if(check.is_folded(f))
      faces.push_back(f);
    else
      assert(!is_some_below);
  }
  return faces;
}

bool is_folded(const Proxy_mesh& proxy)
{
  std::vector<int> below;
  return !folded_faces(proxy, below).empty();
}

const Eigen::Vector3d middle(0.421875, 0.328125, 0); // a vertex of the original

// A height field has no fold, however steep it is; a part that is shifted over its neighbor has
// one, however small it is.
void test_bumps()
{
  for(const double radius : {0.02, 0.1, 0.3})
    for(const double height : {-0.15, 0.0, 0.15})
    {
      const auto bump = [&](const Eigen::Vector3d& p)
        { return (std::max)(0., 1 - (p - middle).norm() / radius); };
      assert(!is_folded(make_proxy([&](Eigen::Vector3d& p) { p[2] += height * bump(p); })));
      assert(is_folded(make_proxy([&](Eigen::Vector3d& p)
      {
        const double b = bump(p);
        p[0] += 1.5 * (std::max)(radius, 0.02) * b;
        p[2] += height * b;
      })));
    }
}

// Lines of projection that meet at a height above the middle of a face: a pyramid must end below.
void test_crossing_lines()
{
  const auto make = [](double top, double focus)
  {
    const Eigen::Vector3d foot(1. / 3, 5. / 12, 0); // the middle of a face
    Proxy_mesh proxy = make_proxy([&](Eigen::Vector3d& p)
      { p[2] += (std::max)(0., top * (1 - (p - foot).norm() / 0.07)); });
    for(std::size_t v = 0; v < proxy.normal.size(); ++v)
      if(const Eigen::Vector3d& p = proxy.mesh.points[v]; (p - foot).norm() < 0.2)
        proxy.normal[v] += (foot - p) / focus;
    return proxy;
  };
  assert(!is_folded(make(0.1, 1)));
  assert(!is_folded(make(0.1, 0.2)));
  assert(is_folded(make(0.1, 0.08)));
  assert(!is_folded(make(0.04, 0.08)));
}

// Is the projection turned over at one of many places?
bool is_turned(const Proxy_mesh& proxy, int f)
{
  const internal::Proxy_projection projection(proxy);
  const int n = 60;
  const double step = 1e-6;
  for(int i = 1; i < n; ++i)
    for(int j = 1; i + j < n; ++j)
    {
      const auto image = [&](double di, double dj)
      {
        const double a = double(i) / n + di, b = double(j) / n + dj;
        return projection(Working_location{f, {{1 - a - b, a, b}}});
      };
      const Working_location at = image(0, 0), u = image(step, 0), v = image(0, step);
      if(u.face != at.face || v.face != at.face)
        continue;
      const Eigen::Vector3d p = projection.point(at);
      const Eigen::Vector3d normal
        = (projection.point(u) - p).cross(projection.point(v) - p) / (step * step);
      if(normal.dot(proxy.unfolded->normal(at.face).normalized()) < -1e-6)
        return true;
    }
  return false;
}

// With noise, no face of the proxy is turned over at a sample and yet taken for good.
void test_noise()
{
  int folded = 0, turned = 0;
  for(const double noise : {0.002, 0.01, 0.02})
    for(unsigned seed = 1; seed <= 3; ++seed)
    {
      std::mt19937 random(seed);
      const auto number = [&]() { return noise * (random() / 2147483648. - 1); };
      Proxy_mesh proxy = make_proxy([&](Eigen::Vector3d& p)
      {
        for(int i = 0; i < 3; ++i)
          p[i] += number();
      });
      for(Eigen::Vector3d& n : proxy.normal)
        n = Eigen::Vector3d(30 * number(), 30 * number(), 1).normalized();
      std::vector<int> below;
      const std::vector<int> faces = folded_faces(proxy, below);
      for(int f = 0; f < proxy.mesh.number_of_faces(); ++f)
        if(is_turned(proxy, f))
        {
          ++turned;
          assert(std::find(faces.begin(), faces.end(), f) != faces.end());
        }
      folded += static_cast<int>(faces.size());
      // less than half of the edges' length cannot fold a plane
      assert(noise > 0.002 || faces.empty());
    }
  std::cout << folded << " faces with folds, " << turned << " of them seen by samples" << std::endl;
  assert(folded > 0);
}

// a few rounds of unfolding cure noise, with the boundary and distant vertices where they were
void test_unfolding()
{
  std::mt19937 random(5);
  Proxy_mesh proxy = make_proxy([&](Eigen::Vector3d& p)
  {
    if((p - middle).norm() < 0.1)
      p[0] += 0.03 * (random() / 2147483648. - 1);
  });
  internal::Surface_unfolder unfolder(*proxy.original, *proxy.original);
  proxy.unfolded = unfolder.mesh();
  std::vector<int> below;
  assert(!folded_faces(proxy, below).empty());
  for(int round = 0; round < 8 && !below.empty(); ++round)
  {
    unfolder.unfold(below);
    below.clear();
    folded_faces(proxy, below);
  }
  assert(below.empty());
  for(int v = 0; v < proxy.original->number_of_vertices(); ++v)
    if(proxy.original->is_border_vertex(v) || (proxy.original->points[v] - middle).norm() > 0.2)
      assert(proxy.unfolded->points[v] == proxy.original->points[v]);
}

// a square frame of four bars, one unit thick, with sharp edges
Working_mesh make_frame()
{
  const int bars = 4, edges_per_bar = 4, sides = 4;
  return Test::make_grid(sides, bars * edges_per_bar, true, true, [](double side, double along)
  {
    const bool is_outside = side < 0.5 || side > 2.5;
    const double size = is_outside ? 5 : 4, z = side < 1.5 ? 0 : 1;
    const int bar = static_cast<int>(along / edges_per_bar) % bars;
    const double t = 2 * (along / edges_per_bar - std::floor(along / edges_per_bar)) - 1;
    const Eigen::Vector2d on_first(size, t * size);
    const Eigen::Vector2d p = Eigen::Rotation2Dd(bar * Test::pi / 2) * on_first;
    return Eigen::Vector3d(p[0], p[1], z);
  }, Test::no_hole);
}

// A mesh with sharp edges as its own proxy: points are their images, also if the faces of the
// places are turned away from the lines of projection.
void test_sharp_edges()
{
  const Working_mesh mesh = make_frame();
  const int most_faces_at_vertex = 8, n = 8;
  for(int k = 0; k < most_faces_at_vertex; ++k)
  {
    Proxy_mesh proxy;
    proxy.original = proxy.unfolded = std::make_shared<const Working_mesh>(mesh);
    proxy.mesh = mesh;
    for(int v = 0; v < mesh.number_of_vertices(); ++v)
    {
      std::vector<int> outgoing;
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      mesh.for_each_outgoing(v, [&](int h)
      {
        outgoing.push_back(h);
        normal += mesh.normal(h / 3).normalized();
      });
      const int h = outgoing[k % outgoing.size()];
      proxy.place.push_back(Working_location{h / 3, {{0, 0, 0}}});
      proxy.place.back().barycentric[h % 3] = 1;
      proxy.normal.push_back(normal.normalized());
    }
    assert(!is_folded(proxy));
    const internal::Proxy_projection projection(proxy);
    for(int f = 0; f < mesh.number_of_faces(); ++f)
      for(int i = 0; i <= n; ++i)
        for(int j = 0; i + j <= n; ++j)
        {
          const Working_location at{f, {{double(n - i - j) / n, double(i) / n, double(j) / n}}};
          assert((projection.point(projection(at)) - point_at(mesh, at)).norm() < 1e-12);
        }
  }
}

} // namespace

int main()
{
  test_bumps();
  test_crossing_lines();
  test_noise();
  test_unfolding();
  test_sharp_edges();
  return 0;
}
