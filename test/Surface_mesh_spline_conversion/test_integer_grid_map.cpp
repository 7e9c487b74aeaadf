// The re-solve of a seamless map with prescribed integer differences meets them exactly, keeps all
// triangles positive and all cones, notices contradictions and ignores repeated constraints.

#include "generated_working_meshes.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/field/build_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/compute_seamless_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/solve_integer_grid_map.h>

#include <cassert>
#include <iostream>
#include <queue>

using CGAL::Surface_mesh_spline_conversion::Cross_field;
using CGAL::Surface_mesh_spline_conversion::Error_code;
using namespace CGAL::Surface_mesh_spline_conversion::internal;

Seamless_map make_map(const Working_mesh& mesh, double quad_size)
{
  Cross_field field;
  field.mesh = mesh;
  field.size.assign(mesh.number_of_vertices(), quad_size);
  assert(build_cross_field(field) == Error_code::OK);
  Seamless_map map;
  assert(compute_seamless_map(field, map) == Error_code::OK);
  return map;
}

// the halfedges crossed on a shortest way from face `f` to face `g` that avoids some halfedges
std::vector<int> face_path(const Working_mesh& mesh, int f, int g,
                           const std::vector<char>& is_closed)
{
  std::vector<int> reached_by(mesh.number_of_faces(), -2);
  std::queue<int> queue;
  queue.push(f);
  reached_by[f] = -1;
  while(!queue.empty())
  {
    const int x = queue.front();
    queue.pop();
    for(int h = 3 * x; h < 3 * x + 3; ++h)
      if(!mesh.is_border(h) && !is_closed[h] && reached_by[mesh.opposite[h] / 3] == -2)
      {
        reached_by[mesh.opposite[h] / 3] = h;
        queue.push(mesh.opposite[h] / 3);
      }
  }
  assert(reached_by[g] != -2);
  std::vector<int> path;
  for(int x = g; x != f; x = reached_by[x] / 3)
    path.insert(path.begin(), reached_by[x]);
  return path;
}

// difference of two corners developed along a path, in fixed point
Fixed_point_2 developed_difference(const Seamless_map& map, const Integer_constraint& c)
{
  Fixed_point_2 x = map.coordinates[c.to_corner];
  for(auto h = c.path.rbegin(); h != c.path.rend(); ++h)
    x = rotate(-map.rotation[*h], minus(x, map.translation(*h)));
  return minus(x, map.coordinates[c.from_corner]);
}

Integer_constraint rounded(const Seamless_map& map, int from, int to, std::vector<int> path)
{
  Integer_constraint c{from, to, std::move(path), {{0, 0}}};
  const Fixed_point_2 d = developed_difference(map, c);
  for(int i = 0; i < 2; ++i)
    c.difference[i]
      = static_cast<int>(std::lround(std::ldexp(static_cast<double>(d[i]), -map.fractional_bits)));
  return c;
}

void check_result(const Seamless_map& map, const std::vector<Integer_constraint>& constraints)
{
  assert(find_defects(map).empty());
  for(const Integer_constraint& c : constraints)
  {
    const Fixed_point_2 d = developed_difference(map, c);
    for(int i = 0; i < 2; ++i)
      assert(d[i] == std::int64_t(c.difference[i]) * (std::int64_t(1) << map.fractional_bits));
  }
}

int corner_of(const Working_mesh& mesh, int v) { return mesh.vertex_halfedge[v]; }

std::vector<int> designated_corners(const Working_mesh& mesh)
{
  std::vector<int> corners;
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
    if(mesh.is_corner[v])
      corners.push_back(v);
  return corners;
}

// constraints from the first corner to the others, without crossing seams
std::vector<Integer_constraint> star_constraints(const Seamless_map& map)
{
  const std::vector<int> corners = designated_corners(map.mesh);
  const std::vector<char> none(map.mesh.number_of_halfedges(), 0);
  std::vector<Integer_constraint> constraints;
  const int a = corner_of(map.mesh, corners[0]);
  for(std::size_t i = 1; i < corners.size(); ++i)
  {
    const int b = corner_of(map.mesh, corners[i]);
    constraints.push_back(rounded(map, a, b, face_path(map.mesh, a / 3, b / 3, none)));
  }
  return constraints;
}

// A rectangle of 9 x 7 units gets any number of quads, also far from the wanted ones.
void test_rectangle()
{
  const Seamless_map map
    = make_map(Test::make_grid(9, 7, false, false, Test::in_plane, Test::no_hole), 1.5);
  std::vector<Integer_constraint> constraints = star_constraints(map);
  assert(constraints.size() == 3);
  for(int factor : {1, 5})
  {
    std::vector<Integer_constraint> scaled = constraints;
    for(Integer_constraint& c : scaled)
      c.difference = {{factor * c.difference[0], factor * c.difference[1]}};
    Seamless_map result;
    assert(solve_integer_grid_map(map, scaled, result));
    check_result(result, scaled);

    // twice the same, and a contradiction
    scaled.push_back(scaled.front());
    assert(solve_integer_grid_map(map, scaled, result));
    scaled.back().difference[0] += 1;
    assert(!solve_integer_grid_map(map, scaled, result));
  }
  // opposite sides must have equal lengths
  constraints.back().difference[0] += 1;
  constraints.back().difference[1] += 1;
  Seamless_map result;
  assert(!solve_integer_grid_map(map, constraints, result));
}

// Both closed ways on a torus, from a vertex to itself; with them all translations are integers.
void test_torus()
{
  const Seamless_map map = make_map(Test::make_grid(40, 14, true, true,
    [](double u, double v) { return Test::on_torus(Test::pi * u / 20, Test::pi * v / 7); },
    Test::no_hole), 0.7);
  const Working_mesh& mesh = map.mesh;
  const int n = mesh.number_of_halfedges();
  std::vector<Integer_constraint> constraints;
  for(int way = 0; way < 2; ++way)
  {
    // a wall over which the way has to step: u = 0 or v = 0
    std::vector<char> wall(n, 0);
    int start = -1, end = -1;
    for(int h = 0; h < n; ++h)
    {
      const auto on_wall = [&](int v)
        { const Eigen::Vector3d& p = mesh.points[v];
          return way == 0 ? std::abs(p[1]) < 1e-9 && p[0] > 0
                          : std::abs(p[2]) < 1e-9 && p.head<2>().norm() > 3; };
      wall[h] = on_wall(mesh.source(h)) && on_wall(mesh.target(h));
      if(wall[h] && start < 0)
      {
        start = h;
        end = mesh.opposite[h];
      }
    }
    // from the face on one side around to that on the other side, and over the wall
    std::vector<int> path = face_path(mesh, start / 3, end / 3, wall);
    path.push_back(end);
    constraints.push_back(rounded(map, start, start, path));
    assert(constraints.back().difference[0] != 0 || constraints.back().difference[1] != 0);
  }
  // the second way starts elsewhere: connect both
  const std::vector<char> none(n, 0);
  const int a = constraints[0].from_corner, b = constraints[1].from_corner;
  if(mesh.source(a) != mesh.source(b))
    constraints.push_back(rounded(map, a, b, face_path(mesh, a / 3, b / 3, none)));
  Seamless_map result;
  assert(solve_integer_grid_map(map, constraints, result));
  check_result(result, constraints);
  const std::int64_t unit = std::int64_t(1) << result.fractional_bits;
  for(int h = 0; h < n; ++h)
    for(int i = 0; i < 2; ++i)
      assert(result.translation(h)[i] % unit == 0);
}

int main()
{
  test_rectangle();
  test_torus();
  return 0;
}
