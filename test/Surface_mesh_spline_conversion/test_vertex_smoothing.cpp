// Corners of flat quads are moved where the layout has them: on a plane square whose map and quads
// are perfect, but which is displaced afterwards, as by the projection from a proxy, such that a
// quad becomes inverted. By closed forms, without the measures of the library: all corners of all
// displaced quads turn left after the motion, which fixes the boundary and keeps the orientation;
// without displacement, nothing moves. Nor are quads left inverted where the square is pinched,
// which short motions cannot repair. Where the map has the priority, no quad becomes intolerably
// uneven by the motions. Without limits of the work, all of it is counted; with a limit, it is not
// exceeded by more than one corner costs, and what has been moved so far makes nothing worse.

#include "voxel_seamless_maps.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Vertex_smoothing.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace Test;
using internal::Quad_grid;
using internal::Surface_sample;
using internal::Vertex_smoothing;
using internal::surface_sample;
using internal::Working_location;

namespace {

const int size = 8, cells_per_quad = 8; // quads per side of the square
const int n = size * cells_per_quad;
const int bits = 20;                    // of the coordinates of the map

// each quad has `cells_per_quad` x `cells_per_quad` cells of two faces
Seamless_map make_square()
{
  Seamless_map map;
  map.fractional_bits = bits;
  for(int j = 0; j <= n; ++j)
    for(int i = 0; i <= n; ++i)
      map.mesh.points.push_back(Eigen::Vector3d(i, j, 0) / cells_per_quad);
  const auto add = [&](const std::array<std::array<int, 2>, 3>& corners)
  {
    std::array<int, 3> t;
    for(int i = 0; i < 3; ++i)
    {
      t[i] = corners[i][1] * (n + 1) + corners[i][0];
      map.coordinates.push_back({{(std::int64_t(corners[i][0]) << bits) / cells_per_quad,
                                  (std::int64_t(corners[i][1]) << bits) / cells_per_quad}});
    }
    map.mesh.parent.push_back(map.mesh.triangles.size());
    map.mesh.triangles.push_back(t);
  };
  for(int j = 0; j < n; ++j)
    for(int i = 0; i < n; ++i)
    {
      add({{{{i, j}}, {{i + 1, j}}, {{i + 1, j + 1}}}});
      add({{{{i, j}}, {{i + 1, j + 1}}, {{i, j + 1}}}});
    }
  map.mesh.is_corner.assign(map.mesh.points.size(), 0);
  const bool is_manifold = connect(map);
  assert(is_manifold);
  return map;
}

Quad_grid make_quads()
{
  Quad_grid grid;
  for(int q = 0; q < size * size; ++q)
    grid.add_quad();
  for(int j = 0; j < size; ++j)
    for(int i = 0; i < size; ++i)
    {
      const int q = j * size + i;
      const bool is_linked
        = (i == 0 ? grid.make_border({q, 3}) : grid.link({q, 3}, {q - 1, 1}))
          && (j == 0 ? grid.make_border({q, 0}) : grid.link({q, 0}, {q - size, 2}))
          && (i + 1 < size || grid.make_border({q, 1}))
          && (j + 1 < size || grid.make_border({q, 2}));
      assert(is_linked);
    }
  const bool is_complete = grid.number_vertices();
  assert(is_complete);
  return grid;
}

Working_location locate(double x, double y)
{
  const int i = (std::min)(n - 1, int(x * cells_per_quad));
  const int j = (std::min)(n - 1, int(y * cells_per_quad));
  const double s = x * cells_per_quad - i, t = y * cells_per_quad - j;
  const int f = 2 * (j * n + i);
  return s >= t ? Working_location{f, {{1 - s, s - t, t}}}
                : Working_location{f + 1, {{1 - t, s, t - s}}};
}

Working_location locate(int quad, double u, double v)
{
  return locate(quad % size + u, quad / size + v);
}

// Moves the middle of the square by 0.98 quads along the diagonal, less around it, and nothing from
// two quads on. It is one to one: of points on a line through the middle, it moves the one at
// distance r by 0.98 (1 - r / 2)^2, whose derivative is less than 1.
Eigen::Vector3d displaced(const Eigen::Vector3d& p)
{
  const double r = (p - Eigen::Vector3d(size, size, 0) / 2).norm();
  const double share = (std::max)(0., 1 - r / 2);
  return p + 0.98 * share * share * Eigen::Vector3d(1, 1, 0).normalized();
}

// Shrinks what is around the middle of a side between two inner vertices to a thousandth, both
// vertices included, and turns it by 2.7: a place much thinner than a quad where two corners
// happen to lie the wrong way round. One to one: distances from the middle grow throughout.
Eigen::Vector3d pinched(const Eigen::Vector3d& p)
{
  const Eigen::Vector3d middle(size / 2 + 0.5, size / 2, 0);
  const Eigen::Vector3d d = p - middle;
  const double share = (std::min)(1., (std::max)(0., (2.3 - d.norm()) / 1.5));
  const double angle = 2.7 * share, scale = std::pow(1e-3, share);
  return middle + scale * Eigen::Vector3d(std::cos(angle) * d[0] - std::sin(angle) * d[1],
                                          std::sin(angle) * d[0] + std::cos(angle) * d[1], 0);
}

double cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a[0] * b[1] - a[1] * b[0]; }

// the least sine of the corners of all quads, seen from above
template <typename Place>
double least_sine(const Place& place)
{
  double least = 1;
  for(int q = 0; q < size * size; ++q)
  {
    const std::array<Eigen::Vector3d, 4> p
      = {{place(q, 0, 0), place(q, 1, 0), place(q, 1, 1), place(q, 0, 1)}};
    for(int i = 0; i < 4; ++i)
      least = (std::min)(least, cross((p[(i + 1) % 4] - p[i]).normalized(),
                                      (p[(i + 3) % 4] - p[i]).normalized()));
  }
  return least;
}

// small parts of the quads keep their orientation
template <typename Place>
void check_orientation(const Place& place)
{
  const int parts = 16;
  for(int q = 0; q < size * size; ++q)
    for(int j = 0; j < parts; ++j)
      for(int i = 0; i < parts; ++i)
      {
        const auto at = [&](int k, int l) { return place(q, double(k) / parts, double(l) / parts); };
        const Eigen::Vector3d p = at(i, j);
        assert(cross(at(i + 1, j) - p, at(i, j + 1) - p) > 0);
      }
}

void check_boundary(const Vertex_smoothing& smoothing)
{
  for(int i = 0; i <= n; ++i)
  {
    const double x = double(i) / cells_per_quad;
    for(const Working_location& at
        : {locate(x, 0), locate(double(size), x), locate(x, double(size)), locate(0, x)})
    {
      const Working_location moved = smoothing(at);
      assert(moved.face == at.face && moved.barycentric == at.barycentric);
    }
  }
}

void test_displaced_quads()
{
  const Seamless_map map = make_square();
  const Quad_grid grid = make_quads();
  const auto image = [&](const Working_location& at)
  { return Surface_sample{displaced(point_at(map.mesh, at)), Eigen::Vector3d::UnitZ()}; };
  const Vertex_smoothing smoothing(map, grid, image, [](int q, double u, double v)
    { return locate(q, u, v); });

  assert(least_sine([&](int q, double u, double v) { return image(locate(q, u, v)).point; }) < 0);
  const auto place = [&](int q, double u, double v)
  { return image(smoothing(locate(q, u, v))).point; };
  assert(least_sine(place) > 0.1);
  check_orientation(place);
  check_boundary(smoothing);
}

// of a map to the surface, in a quad
template <typename Place>
double evenness_of(int q, const Place& place)
{
  std::vector<Surface_sample> samples;
  const double cells = internal::samples_per_side - 1;
  for(int j = 0; j < internal::samples_per_side; ++j)
    for(int i = 0; i < internal::samples_per_side; ++i)
      samples.push_back(Surface_sample{place(q, i / cells, j / cells), Eigen::Vector3d::UnitZ()});
  return internal::evenness(samples);
}

// the least evenness after the motions of the quads that are less even than before, where the square
// is pinched
double least_lost_evenness(Vertex_smoothing::Priority priority)
{
  Seamless_map map = make_square();
  for(Eigen::Vector3d& p : map.mesh.points)
    p = pinched(p);
  const Vertex_smoothing smoothing(
    map, make_quads(), [&](const Working_location& at) { return surface_sample(map.mesh, at); },
    [](int q, double u, double v) { return locate(q, u, v); }, priority);
  double least = 1;
  for(int q = 0; q < size * size; ++q)
  {
    const double before = evenness_of(q, [&](int quad, double u, double v)
      { return point_at(map.mesh, locate(quad, u, v)); });
    const double after = evenness_of(q, [&](int quad, double u, double v)
      { return point_at(map.mesh, smoothing(locate(quad, u, v))); });
    if(after < before)
      least = (std::min)(least, after);
  }
  return least;
}

void test_priorities()
{
  assert(least_lost_evenness(Vertex_smoothing::Priority::FLAT_QUADS) < 0.1);
  assert(least_lost_evenness(Vertex_smoothing::Priority::EVEN_MAP) >= 0.1);
}

// short motions in disks around the corners leave quads inverted here
void test_pinched_quads()
{
  Seamless_map map = make_square();
  for(Eigen::Vector3d& p : map.mesh.points)
    p = pinched(p);
  for(int f = 0; f < map.mesh.number_of_faces(); ++f)
    assert(map.mesh.normal(f)[2] > 0);
  const Quad_grid grid = make_quads();
  const auto image = [&](const Working_location& at)
  { return surface_sample(map.mesh, at); };
  const Vertex_smoothing smoothing(map, grid, image, [](int q, double u, double v)
    { return locate(q, u, v); }, Vertex_smoothing::Priority::FLAT_QUADS);

  assert(least_sine([&](int q, double u, double v) { return image(locate(q, u, v)).point; }) < 0);
  assert(least_sine([&](int q, double u, double v)
    { return image(smoothing(locate(q, u, v))).point; }) > 0.1);
  check_boundary(smoothing);
}

// the work that has been counted
double test_limit_of_work(double limit)
{
  Seamless_map map = make_square();
  for(Eigen::Vector3d& p : map.mesh.points)
    p = pinched(p);
  const internal::Work_budget budget(limit);
  const Vertex_smoothing smoothing(
    map, make_quads(), [&](const Working_location& at) { return surface_sample(map.mesh, at); },
    [](int q, double u, double v) { return locate(q, u, v); },
    Vertex_smoothing::Priority::FLAT_QUADS, budget);
  check_boundary(smoothing);
  const double before = least_sine([&](int q, double u, double v)
    { return point_at(map.mesh, locate(q, u, v)); });
  const double after = least_sine([&](int q, double u, double v)
    { return point_at(map.mesh, smoothing(locate(q, u, v))); });
  assert(after >= before);
  return budget.spent();
}

void test_limits_of_work()
{
  const double all = test_limit_of_work(std::numeric_limits<double>::infinity());
  const double half = test_limit_of_work(all / 2);
  assert(half >= all / 2 && half < 0.75 * all);
  // corners have to be located in any case
  assert(test_limit_of_work(1) < all / 50);
  const internal::Work_budget budget(100), share = budget.share(0.5);
  share.spend(60);
  assert(share.is_used_up() && !budget.is_used_up() && budget.spent() == 60);
  assert(budget.share(0.25).rest() == 10);
}

void test_undisplaced_quads()
{
  const Seamless_map map = make_square();
  const auto image = [&](const Working_location& at)
  { return surface_sample(map.mesh, at); };
  const Vertex_smoothing smoothing(map, make_quads(), image, [](int q, double u, double v)
    { return locate(q, u, v); });
  for(int q = 0; q < size * size; ++q)
    for(const double t : {0., 0.25, 0.7, 1.})
    {
      const Working_location at = locate(q, t, 1 - t), moved = smoothing(at);
      assert(moved.face == at.face && moved.barycentric == at.barycentric);
    }
}

} // namespace

int main()
{
  test_displaced_quads();
  test_pinched_quads();
  test_undisplaced_quads();
  test_priorities();
  test_limits_of_work();
  return 0;
}
