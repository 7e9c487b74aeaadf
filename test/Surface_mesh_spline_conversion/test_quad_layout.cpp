// Quad layouts of generated seamless maps, both by solving the map again and by composing
// rectangles: the invariants of a quad layout are checked from outside.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "quad_layout_checks.h"
#include "voxel_seamless_maps.h"

#include <CGAL/Surface_mesh_spline_conversion/extract_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Integer_grid_map_builder.h>

#include <iostream>
#include <string>

namespace SC = CGAL::Surface_mesh_spline_conversion;
using namespace Test;

typedef CGAL::Simple_cartesian<double> K;
typedef CGAL::Surface_mesh<K::Point_3> Mesh;
typedef SC::Quad_layout<K> Layout;

namespace {

// stands for a network: the generated boundaries have no curves
struct No_curves
{
  SC::Error_code error() const { return SC::Error_code::OK; }
};

Mesh make_mesh(const Working_mesh& working)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for(const auto& p : working.points)
    vertices.push_back(mesh.add_vertex(K::Point_3(p[0], p[1], p[2])));
  for(const auto& t : working.triangles)
    mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  return mesh;
}

// what the layout has to have, found from the working mesh
struct Expectation
{
  int euler_characteristic = 0;
  int number_of_loops = 0;
  std::multiset<int> irregular_valences;
  std::vector<double> chain_lengths;
  std::vector<bool> is_closed;

  explicit Expectation(const Seamless_map& map)
  {
    const Working_mesh& mesh = map.mesh;
    int border = 0;
    std::set<int> visited;
    for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    {
      if(!mesh.is_border(h))
        continue;
      ++border;
      add_piece(mesh, h);
      if(visited.count(h))
        continue;
      ++number_of_loops;
      for(int g = h; visited.insert(g).second; g = mesh.vertex_halfedge[mesh.target(g)]) {}
    }
    euler_characteristic = mesh.number_of_vertices() + mesh.number_of_faces()
                           - (mesh.number_of_halfedges() + border) / 2;
    for(int v = 0; v < mesh.number_of_vertices(); ++v)
      if(map.cone[v] != (mesh.is_border_vertex(v) ? 2 : 4))
        irregular_valences.insert(mesh.is_border_vertex(v) ? -map.cone[v] : map.cone[v]);
  }

  void add_piece(const Working_mesh& mesh, int h)
  {
    const Working_mesh::Boundary_piece& piece = mesh.boundary_piece[h];
    if(chain_lengths.size() <= piece.chain)
    {
      chain_lengths.resize(piece.chain + 1, 0);
      is_closed.resize(piece.chain + 1, true);
    }
    chain_lengths[piece.chain] = (std::max)(chain_lengths[piece.chain], piece.last);
    if(mesh.is_corner[mesh.source(h)])
      is_closed[piece.chain] = false;
  }
};

void check_layout(const Seamless_map& seamless, const SC::Integer_grid_map& map)
{
  const Mesh mesh = make_mesh(seamless.mesh);
  Layout layout;
  const SC::Error_code code = SC::extract_quad_layout(map, mesh, No_curves(), layout);
  assert(code == SC::Error_code::OK);
  (void)code;
  assert(static_cast<int>(layout.number_of_quads()) == map.number_of_quads);
  const double diameter = 10;
  const Quad_layout_checks<Layout, Mesh> checks(layout, mesh, diameter);
  const Expectation expected(seamless);
  checks.check_combinatorics(expected.euler_characteristic, expected.number_of_loops);
  assert(checks.irregular_valences() == expected.irregular_valences);
  checks.check_boundary(expected.chain_lengths, expected.is_closed);
  checks.check_points(5);
  checks.check_continuity(7);
  checks.check_agreement();
  checks.check_orientation(5);
  // a grid only approximates the folds of the mesh, from below
  const double area = checks.relative_area(24);
  assert(area < 1 + 1e-3 && area > 0.5);

  for(std::size_t v = 0; v < layout.number_of_vertices(); ++v)
    if(layout.is_corner(v))
    {
      bool is_mesh_vertex = false;
      for(auto w : mesh.vertices())
        is_mesh_vertex = is_mesh_vertex || mesh.point(w) == layout.point(v);
      assert(is_mesh_vertex);
    }
}

// returns `true` if the map could be solved again
bool test_map(const Seamless_map& seamless)
{
  SC::Integer_grid_map map;
  const bool is_built = SC::internal::Integer_grid_map_builder(map).build(seamless);
  if(!is_built)
    std::cerr << map.message << std::endl;
  assert(is_built);
  const bool is_resolved = map.is_resolved;
  check_layout(seamless, map);

  SC::internal::Quantization quantization(map.graph, seamless.fractional_bits);
  const bool is_quantized = quantization.quantize_all_positive();
  assert(is_quantized);
  (void)is_quantized;
  map.map = seamless;
  map.lengths = quantization.lengths();
  map.is_resolved = false;
  SC::internal::Mapped_quads quads;
  assert(*quads.build(map) == 0);
  map.number_of_quads = quads.quads().number_of_quads();
  check_layout(seamless, map);
  return is_resolved;
}

void test_voxels()
{
  int number_of_maps = 0, resolved = 0;
  for(int seed = 0; seed < 60; ++seed)
  {
    std::mt19937 random(seed);
    Voxel_surface_options options;
    options.subdivision = 2 + seed % 3;
    options.jitter = seed % 3 == 0 ? 0 : 1000;
    options.hole_probability = seed % 2 ? 0.2 : 0;
    options.edge = std::int64_t(1) << (19 + seed % 4);
    options.edge += options.edge / 5;
    Seamless_map map;
    if(!make_voxel_map(random_voxels(1 + seed % 9, random), options, random, map))
      continue;
    ++number_of_maps;
    resolved += test_map(map);
  }
  std::cout << number_of_maps << " voxel maps, " << resolved << " solved again" << std::endl;
  assert(number_of_maps > 20 && resolved > number_of_maps / 2);
}

void test_flat_maps()
{
  for(std::int64_t shear : {0, 1 << 12, 12345})
  {
    test_map(make_flat_map(12, 5, 1 << 14, 0, false, 14));
    test_map(make_flat_map(12, 9, 1 << 14, shear, true, 13));
  }
}

} // namespace

int main()
{
  test_voxels();
  test_flat_maps();
  return 0;
}
