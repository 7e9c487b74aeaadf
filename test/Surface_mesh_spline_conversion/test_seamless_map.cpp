// Seamless maps are exactly seamless and aligned, positive, and have the prescribed cones, on
// inputs with every topological feature. All checks use other formulas than the solver.

#include "generated_working_meshes.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/map/compute_seamless_map.h>

#include <cassert>
#include <iostream>

using CGAL::Surface_mesh_spline_conversion::Cross_field;
using CGAL::Surface_mesh_spline_conversion::Error_code;
using namespace CGAL::Surface_mesh_spline_conversion::internal;

Cross_field make_field(const Working_mesh& mesh, double quad_size)
{
  Cross_field field;
  field.mesh = mesh;
  field.size.assign(mesh.number_of_vertices(), quad_size);
  const Error_code code = build_cross_field(field);
  assert(code == Error_code::OK);
  return field;
}

Eigen::Vector2d point(const Seamless_map& map, int corner)
{
  return Eigen::Vector2d(std::ldexp(double(map.coordinates[corner][0]), -map.fractional_bits),
                         std::ldexp(double(map.coordinates[corner][1]), -map.fractional_bits));
}

// squared lengths of edges from both sides, exactly; with the signs of the triangles and the total
// angles this is everything but the directions of the transitions
void check_edges(const Seamless_map& map)
{
  for(int h = 0; h < map.mesh.number_of_halfedges(); ++h)
  {
    const Fixed_point_2 e = minus(map.coordinates[Working_mesh::next(h)], map.coordinates[h]);
    if(map.mesh.is_border(h))
    {
      assert((e[0] == 0) != (e[1] == 0));
      continue;
    }
    const int o = map.mesh.opposite[h];
    const Fixed_point_2 back = minus(map.coordinates[Working_mesh::next(o)], map.coordinates[o]);
    // multiplication of e by i^rotation as a complex number
    const std::int64_t c[4] = {1, 0, -1, 0}, s[4] = {0, 1, 0, -1};
    const int r = map.rotation[h];
    assert(c[r] * e[0] - s[r] * e[1] == -back[0] && s[r] * e[0] + c[r] * e[1] == -back[1]);
  }
}

void check_triangles_and_cones(const Seamless_map& map)
{
  std::vector<double> angle(map.mesh.number_of_vertices(), 0.);
  for(int f = 0; f < map.mesh.number_of_faces(); ++f)
    for(int i = 0; i < 3; ++i)
    {
      const Eigen::Vector2d p = point(map, 3 * f + i);
      const Eigen::Vector2d a = point(map, 3 * f + (i + 1) % 3) - p;
      const Eigen::Vector2d b = point(map, 3 * f + (i + 2) % 3) - p;
      const double turn = std::atan2(b[1], b[0]) - std::atan2(a[1], a[0]);
      const double positive_turn = turn < 0 ? turn + 2 * Test::pi : turn;
      assert(0 < positive_turn && positive_turn < Test::pi);
      angle[map.mesh.triangles[f][i]] += positive_turn;
    }
  for(int v = 0; v < map.mesh.number_of_vertices(); ++v)
    assert(std::abs(angle[v] - map.cone[v] * Test::pi / 2) < 1e-6);
}

double area(const Seamless_map& map)
{
  double sum = 0;
  for(int f = 0; f < map.mesh.number_of_faces(); ++f)
  {
    const Eigen::Vector2d p = point(map, 3 * f);
    const Eigen::Vector2d a = point(map, 3 * f + 1) - p, b = point(map, 3 * f + 2) - p;
    sum += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return sum;
}

double surface_area(const Working_mesh& mesh)
{
  double sum = 0;
  for(int f = 0; f < mesh.number_of_faces(); ++f)
    sum += mesh.vector(3 * f).cross(mesh.vector(3 * f + 1)).norm() / 2;
  return sum;
}

void test_input(const Test::Input& input)
{
  std::cout << input.name << std::endl;
  const Cross_field field = make_field(input.mesh, input.quad_size);
  Seamless_map map;
  const Error_code code = compute_seamless_map(field, map);
  assert(code == Error_code::OK);
  assert(map.cone.size() == map.mesh.points.size());
  check_edges(map);
  check_triangles_and_cones(map);

  // the same input gives the same map, also at another scale
  Seamless_map again, scaled;
  assert(compute_seamless_map(field, again) == Error_code::OK);
  assert(again.coordinates == map.coordinates);
  Working_mesh larger = input.mesh;
  for(Eigen::Vector3d& p : larger.points)
    p *= 4;
  assert(compute_seamless_map(make_field(larger, 4 * input.quad_size), scaled) == Error_code::OK);
  assert(scaled.cone == map.cone);

  // as many quads as the size asks for, where quads are smaller than the features
  const double quads = surface_area(input.mesh) / (input.quad_size * input.quad_size);
  if(quads > 50)
    assert(0.8 * quads < area(map) && area(map) < 1.25 * quads);
}

// sizes that change by a factor of three: the map follows them
void test_graded_size()
{
  Cross_field field;
  field.mesh = Test::make_grid(30, 30, false, false, Test::in_plane, Test::no_hole);
  for(const Eigen::Vector3d& p : field.mesh.points)
    field.size.push_back(1 + p[0] / 15);
  assert(build_cross_field(field) == Error_code::OK);
  Seamless_map map;
  assert(compute_seamless_map(field, map) == Error_code::OK);
  check_edges(map);
  check_triangles_and_cones(map);
  double left = 0, right = 0;
  for(int f = 0; f < map.mesh.number_of_faces(); ++f)
  {
    const Eigen::Vector2d p = point(map, 3 * f);
    const Eigen::Vector2d a = point(map, 3 * f + 1) - p, b = point(map, 3 * f + 2) - p;
    const double x = map.mesh.points[map.mesh.triangles[f][0]][0];
    (x < 15 ? left : right) += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  assert(left > 1.2 * right);
}

int main()
{
  for(const Test::Input& input : Test::working_mesh_inputs())
    test_input(input);
  test_graded_size();
  return 0;
}
