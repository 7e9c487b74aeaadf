// The motorcycle graph of generated seamless maps: rectangles that fill the surface, sources at all
// singularities and corners, boundary lengths, and paths along arcs, each compared with what the map
// itself says.

#include "voxel_seamless_maps.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/map/integer_constraints.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/build_motorcycle_graph.h>

#include <iostream>

namespace SC = CGAL::Surface_mesh_spline_conversion;
using namespace Test;
using SC::internal::Motorcycle_graph;

namespace {

// the rectangles have the area of the triangles
void check_area(const Seamless_map& map, const Motorcycle_graph& graph)
{
  SC::internal::Wide_integer twice_triangles = 0, rectangles = 0;
  for(int f = 0; f < map.mesh.number_of_faces(); ++f)
    twice_triangles += determinant(minus(map.coordinates[3 * f + 1], map.coordinates[3 * f]),
                                   minus(map.coordinates[3 * f + 2], map.coordinates[3 * f]));
  for(int r = 0; r < static_cast<int>(graph.rectangles.size()); ++r)
    rectangles += static_cast<SC::internal::Wide_integer>(graph.side_length(r, 0))
                  * graph.side_length(r, 1);
  assert(twice_triangles == 2 * rectangles);
}

// every irregular vertex is a node with one arc per quarter turn
void check_sources(const Seamless_map& map, const Motorcycle_graph& graph)
{
  std::map<int, const Motorcycle_graph::Node*> node_at;
  for(const Motorcycle_graph::Node& node : graph.nodes)
    if(node.vertex >= 0)
    {
      const bool is_new = node_at.emplace(node.vertex, &node).second;
      assert(is_new);
      (void)is_new;
    }
  for(int v = 0; v < map.mesh.number_of_vertices(); ++v)
  {
    const bool is_border = map.mesh.is_border_vertex(v);
    if(map.cone[v] == (is_border ? 2 : 4) && !map.mesh.is_corner[v])
      continue;
    assert(node_at.count(v) == 1);
    assert(static_cast<int>(node_at[v]->slots.size()) == map.cone[v] + (is_border ? 1 : 0));
    for(int h : node_at[v]->slots)
      assert(h >= 0);
  }
}

// the boundary arcs are as long as the boundary, and every loop has a source
void check_boundary(const Seamless_map& map, const Motorcycle_graph& graph)
{
  std::int64_t arcs = 0, edges = 0;
  for(const Motorcycle_graph::Arc& arc : graph.arcs)
    arcs += arc.is_on_boundary ? arc.length : 0;
  for(int h = 0; h < map.mesh.number_of_halfedges(); ++h)
    if(map.mesh.is_border(h))
    {
      const Fixed_point_2 e = minus(map.coordinates[Working_mesh::next(h)], map.coordinates[h]);
      edges += std::abs(e[0]) + std::abs(e[1]);
    }
  assert(arcs == edges);
}

int number_of_components_with_boundary(const Seamless_map& map)
{
  std::vector<char> is_visited(map.mesh.number_of_faces(), 0);
  int number = 0;
  for(int first = 0; first < map.mesh.number_of_halfedges(); ++first)
  {
    if(!map.mesh.is_border(first) || is_visited[first / 3])
      continue;
    ++number;
    std::vector<int> stack(1, first / 3);
    is_visited[first / 3] = 1;
    while(!stack.empty())
    {
      const int f = stack.back();
      stack.pop_back();
      for(int h = 3 * f; h < 3 * f + 3; ++h)
        if(!map.mesh.is_border(h) && !is_visited[map.mesh.opposite[h] / 3])
        {
          is_visited[map.mesh.opposite[h] / 3] = 1;
          stack.push_back(map.mesh.opposite[h] / 3);
        }
    }
  }
  return number;
}

// With the real lengths as "integer" lengths, the differences of the constraints are those that one
// finds by carrying coordinates back along the path.
void check_constraints(const Seamless_map& map, const Motorcycle_graph& graph)
{
  std::vector<int> lengths;
  for(const Motorcycle_graph::Arc& arc : graph.arcs)
    lengths.push_back(static_cast<int>(arc.length));
  const auto constraints = SC::internal::integer_constraints(map, graph, lengths);
  std::set<int> vertices;
  for(const auto& constraint : constraints)
  {
    Fixed_point_2 p = map.coordinates[constraint.to_corner];
    int face = constraint.to_corner / 3;
    for(auto it = constraint.path.rbegin(); it != constraint.path.rend(); ++it)
    {
      const int back = map.mesh.opposite[*it];
      assert(back >= 0 && back / 3 == face);
      p = plus(rotate(map.rotation[back], p), map.translation(back));
      face = *it / 3;
    }
    assert(face == constraint.from_corner / 3);
    const Fixed_point_2 difference = minus(p, map.coordinates[constraint.from_corner]);
    assert(difference[0] == constraint.difference[0] && difference[1] == constraint.difference[1]);
    vertices.insert(map.mesh.source(constraint.from_corner));
    vertices.insert(map.mesh.source(constraint.to_corner));
  }
  std::size_t number_of_critical = 0;
  for(const Motorcycle_graph::Node& node : graph.nodes)
    number_of_critical += node.is_critical() ? 1 : 0;
  // one vertex of a component without closed ways may need no equation
  assert(constraints.empty() || vertices.size() == number_of_critical);
  // a spanning tree, two generators per handle, and one per boundary loop but the first one
  const SC::internal::Cut_graph cut(map.mesh, map.rotation, map.cone);
  const int number_of_components = static_cast<int>(cut.roots().size());
  assert(static_cast<int>(constraints.size()) - static_cast<int>(number_of_critical)
         == number_of_components - graph.euler_characteristic()
            - number_of_components_with_boundary(map));
}

void check(const Seamless_map& map)
{
  Motorcycle_graph graph;
  const std::string failure = SC::internal::compute_motorcycle_graph(map, graph);
  if(!failure.empty())
    std::cerr << failure << std::endl;
  assert(failure.empty());
  check_area(map, graph);
  check_sources(map, graph);
  check_boundary(map, graph);
  check_constraints(map, graph);
}

void test_voxels(int number_of_seeds)
{
  int number_of_maps = 0;
  for(int seed = 0; seed < number_of_seeds; ++seed)
  {
    std::mt19937 random(seed);
    Voxel_surface_options options;
    options.subdivision = 1 + seed % 4;
    options.jitter = seed % 3 == 0 ? 0 : (seed % 3 == 1 ? 1000 : 1 << 16);
    options.hole_probability = seed % 2 ? 0.2 : 0;
    Seamless_map map;
    if(!make_voxel_map(random_voxels(1 + seed % 13, random), options, random, map))
      continue;
    // designated corners with two quarter turns are sources, too
    for(int v = 0; v < map.mesh.number_of_vertices(); ++v)
      if(map.mesh.is_border_vertex(v) && random() % 8 == 0)
        map.mesh.is_corner[v] = 1;
    check(map);
    ++number_of_maps;
  }
  std::cout << number_of_maps << " voxel maps" << std::endl;
  assert(number_of_maps > number_of_seeds / 3);
}

// closed isolines, and isolines that wind around many times
void test_flat_maps()
{
  for(std::int64_t shear : {0, 1, 1 << 12, 77777, 12345})
  {
    check(make_flat_map(12, 5, 1 << 14, 0, false, 14));
    check(make_flat_map(7, 6, 1 << 14, shear, true, 14));
  }
}

// maps whose coordinates do not agree with their cones are refused
void test_wrong_maps()
{
  std::mt19937 random(1);
  Voxel_surface_options options;
  Seamless_map map;
  const bool is_manifold = make_voxel_map(random_voxels(1, random), options, random, map);
  assert(is_manifold);
  (void)is_manifold;
  Motorcycle_graph graph;
  Seamless_map wrong = map;
  for(int& cone : wrong.cone)
    cone = cone == 3 ? 5 : cone;
  assert(*SC::internal::compute_motorcycle_graph(wrong, graph) != 0);
}

} // namespace

int main()
{
  test_voxels(400);
  test_flat_maps();
  test_wrong_maps();
  return 0;
}
