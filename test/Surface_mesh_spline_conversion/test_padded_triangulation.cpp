// The layout of last resort: on meshes of all topologies, at sizes from fine to coarser than the
// mesh, the quads satisfy the invariants of a layout, and the inverse map is a homeomorphism that
// covers the mesh once.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "generated_working_meshes.h"
#include "quad_layout_checks.h"

#include <CGAL/Surface_mesh_spline_conversion/extract_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Padded_triangulation.h>

#include <cassert>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;
using namespace Test;

typedef CGAL::Simple_cartesian<double> K;
typedef CGAL::Surface_mesh<K::Point_3> Mesh;
typedef SC::Quad_layout<K> Layout;

namespace {

Mesh to_surface_mesh(const Working_mesh& working)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for(const auto& p : working.points)
    vertices.push_back(mesh.add_vertex(K::Point_3(p[0], p[1], p[2])));
  for(const auto& t : working.triangles)
    mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  return mesh;
}

// Two points of a quad that are close to each other have images that are: a map with a tear or a
// fold in a cell of the grid would reverse the cell. Steps are far below the kinks of the map.
void check_orientation(const Layout& layout)
{
  const double step = 1e-9;
  const int n = 4;
  std::size_t used = 0, all = 0;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
      {
        const double u = (i + 0.43) / n, v = (j + 0.59) / n;
        const auto a = layout.inverse_map()(q, u, v), b = layout.inverse_map()(q, u + step, v),
                   c = layout.inverse_map()(q, u, v + step);
        ++all;
        if(a.face != b.face || a.face != c.face)
          continue;
        ++used;
        const double b0 = b.barycentric[0] - a.barycentric[0];
        const double b1 = b.barycentric[1] - a.barycentric[1];
        const double c0 = c.barycentric[0] - a.barycentric[0];
        const double c1 = c.barycentric[1] - a.barycentric[1];
        assert(b0 * c1 - b1 * c0 > 0);
      }
  assert(used > 0.99 * all);
}

struct Topology
{
  int euler_characteristic = 0, loops = 0;
  std::vector<double> chain_lengths;
  std::vector<bool> is_closed;
};

Topology topology(const Working_mesh& mesh)
{
  Topology t;
  int border = 0;
  std::set<int> visited;
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
  {
    if(!mesh.is_border(h))
      continue;
    ++border;
    const Working_mesh::Boundary_piece& piece = mesh.boundary_piece[h];
    if(t.chain_lengths.size() <= piece.chain)
    {
      t.chain_lengths.resize(piece.chain + 1, 0);
      t.is_closed.resize(piece.chain + 1, true);
    }
    t.chain_lengths[piece.chain] = (std::max)(t.chain_lengths[piece.chain], piece.last);
    // the generated chains are whole loops, and may begin anywhere
    if(piece.first == 0 && mesh.is_corner[mesh.source(h)])
      t.is_closed[piece.chain] = false;
    if(!visited.count(h))
      ++t.loops;
    for(int g = h; visited.insert(g).second; g = mesh.vertex_halfedge[mesh.target(g)]) {}
  }
  t.euler_characteristic = mesh.number_of_vertices() + mesh.number_of_faces()
                           - (mesh.number_of_halfedges() + border) / 2;
  return t;
}

void check_valences(const Layout& layout)
{
  std::vector<int> valence(layout.number_of_vertices(), 0);
  std::vector<char> is_border(layout.number_of_vertices(), 0);
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
    {
      ++valence[layout.vertex(q, i)];
      if(layout.is_border(q, i))
        is_border[layout.vertex(q, i)] = 1;
    }
  for(std::size_t v = 0; v < valence.size(); ++v)
    assert(is_border[v] ? valence[v] == 2 : valence[v] >= 3);
}

// returns the number of quads
std::size_t check(Working_mesh mesh, double size)
{
  const bool is_simplicial = internal::make_simplicial(mesh);
  assert(is_simplicial);
  (void)is_simplicial;
  internal::split_ears(mesh);
  const Mesh input = to_surface_mesh(mesh);
  for(std::size_t f = 0; f < mesh.parent.size(); ++f)
    mesh.parent[f] = f;
  double diameter = 0;
  for(const auto& p : mesh.points)
    diameter = (std::max)(diameter, 2 * (p - mesh.points[0]).norm());
  Layout layout;
  SC::internal::set_layout(
    internal::Padded_triangulation(mesh, std::vector<double>(mesh.points.size(), size)), mesh,
    SC::internal::face_corners(input, get(CGAL::vertex_point, input)), layout);
  const Topology t = topology(mesh);
  const Quad_layout_checks<Layout, Mesh> checks(layout, input, diameter);
  checks.check_combinatorics(t.euler_characteristic, t.loops);
  checks.check_boundary(t.chain_lengths, t.is_closed);
  checks.check_points(3);
  checks.check_continuity(4);
  checks.check_agreement();
  check_valences(layout);
  check_orientation(layout);
  std::size_t corners = 0;
  for(std::size_t v = 0; v < layout.number_of_vertices(); ++v)
    corners += layout.is_corner(v);
  assert(corners == std::size_t(std::count(mesh.is_corner.begin(), mesh.is_corner.end(), 1)));
  return layout.number_of_quads();
}

} // namespace

int main()
{
  for(const Input& input : working_mesh_inputs())
  {
    const std::size_t fine = check(input.mesh, 0.5);
    const std::size_t coarse = check(input.mesh, 4);
    assert(coarse <= fine);
  }
  // the smallest meshes: a triangle, a strip of two, a pillow of two, a tetrahedron
  const Points t = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Points p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
  check(make_mesh(t, {{{0, 1, 2}}}), 1);
  check(make_mesh(p, {{{0, 1, 2}}, {{1, 3, 2}}}), 1);
  check(make_mesh(t, {{{0, 1, 2}}, {{0, 2, 1}}}), 1);
  check(make_mesh(p, {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}}), 1);
  return 0;
}
