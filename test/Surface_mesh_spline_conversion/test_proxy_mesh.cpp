// The proxy of a mesh: it has the topology and the boundary chains of the original, its triangles
// are well shaped and of the wanted size, its vertices lie on the original, and the projection back
// is a map onto the original that follows the boundary by arc length.

#include "generated_working_meshes.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/make_proxy_mesh.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace internal = CGAL::Surface_mesh_spline_conversion::internal;
using internal::Proxy_mesh;
using internal::Working_location;
using internal::Working_mesh;

int euler_characteristic(const Working_mesh& mesh)
{
  int border = 0;
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    border += mesh.is_border(h) ? 1 : 0;
  return mesh.number_of_vertices() - (mesh.number_of_halfedges() + border) / 2
         + mesh.number_of_faces();
}

// links of halfedges and vertices agree, each vertex has one fan, and there are no ears
void check_structure(const Working_mesh& mesh)
{
  int corners = 0;
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    if(!mesh.is_border(h))
    {
      const int o = mesh.opposite[h];
      assert(mesh.opposite[o] == h);
      assert(mesh.source(o) == mesh.target(h) && mesh.target(o) == mesh.source(h));
      assert(!(mesh.is_border_vertex(mesh.source(h)) && mesh.is_border_vertex(mesh.target(h))));
    }
    else
      assert(mesh.vertex_halfedge[mesh.source(h)] == h);
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
  {
    assert(mesh.source(mesh.vertex_halfedge[v]) == v);
    mesh.for_each_outgoing(v, [&corners](int) { ++corners; });
  }
  assert(corners == mesh.number_of_halfedges());
}

double chain_length(const Working_mesh& mesh, std::size_t chain)
{
  double length = 0;
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    if(mesh.is_border(h) && mesh.boundary_piece[h].chain == chain)
      length = (std::max)(length, mesh.boundary_piece[h].last);
  return length;
}

// The pieces of each chain follow each other without gap from 0 to its length, and the vertices lie
// on the boundary of the original at their arc length.
void check_boundary(const Proxy_mesh& proxy)
{
  const internal::Boundary_chains chains(*proxy.original);
  const internal::Surface_walk walk(*proxy.original);
  std::vector<std::vector<std::pair<double, double> > > pieces;
  for(int h = 0; h < proxy.mesh.number_of_halfedges(); ++h)
  {
    if(!proxy.mesh.is_border(h))
      continue;
    const Working_mesh::Boundary_piece& piece = proxy.mesh.boundary_piece[h];
    pieces.resize((std::max)(pieces.size(), piece.chain + 1));
    pieces[piece.chain].emplace_back(piece.first, piece.last);
    const Eigen::Vector3d p = walk.point(chains(piece.chain, piece.first));
    assert((p - proxy.mesh.points[proxy.mesh.source(h)]).norm() <= 1e-12);
  }
  for(std::size_t c = 0; c < pieces.size(); ++c)
  {
    assert(pieces[c].size() >= 4);
    std::sort(pieces[c].begin(), pieces[c].end());
    double s = 0;
    for(const std::pair<double, double>& piece : pieces[c])
    {
      assert(piece.first == s && piece.second > s);
      s = piece.second;
    }
    assert(s == chain_length(*proxy.original, c));
  }
}

// returns the largest distance between points of the proxy and their images on the original
double check_projection(const Proxy_mesh& proxy)
{
  const internal::Proxy_projection projection(proxy);
  double largest = 0;
  const int n = 5;
  for(int f = 0; f < proxy.mesh.number_of_faces(); ++f)
    for(int i = 0; i <= n; ++i)
      for(int j = 0; i + j <= n; ++j)
      {
        const std::array<double, 3> b = {{double(n - i - j) / n, double(i) / n, double(j) / n}};
        const Working_location place = projection(Working_location{f, b});
        double sum = 0;
        for(const double x : place.barycentric)
        {
          assert(x >= 0);
          sum += x;
        }
        assert(std::abs(sum - 1) < 1e-12);
        Eigen::Vector3d p(0, 0, 0);
        for(int k = 0; k < 3; ++k)
          p += b[k] * proxy.mesh.points[proxy.mesh.triangles[f][k]];
        largest = (std::max)(largest, (p - projection.point(place)).norm());
      }
  return largest;
}

// along the boundary of the proxy, the images run along that of the original without turning back
void check_monotony(const Proxy_mesh& proxy)
{
  const internal::Proxy_projection projection(proxy);
  const Working_mesh& original = *proxy.original;
  for(int h = 0; h < proxy.mesh.number_of_halfedges(); ++h)
  {
    if(!proxy.mesh.is_border(h))
      continue;
    double last = proxy.mesh.boundary_piece[h].first;
    const int n = 7;
    for(int i = 1; i < n; ++i)
    {
      Working_location at{h / 3, {{0, 0, 0}}};
      at.barycentric[h % 3] = 1 - double(i) / n;
      at.barycentric[(h + 1) % 3] = double(i) / n;
      const Working_location place = projection(at);
      int g = 3 * place.face;
      while(!(original.is_border(g) && place.barycentric[(g + 2) % 3] == 0))
        ++g;
      assert(g < 3 * place.face + 3);
      const Working_mesh::Boundary_piece& piece = original.boundary_piece[g];
      const double s = piece.first + place.barycentric[(g + 1) % 3] * (piece.last - piece.first);
      assert(s > last && s < proxy.mesh.boundary_piece[h].last);
      last = s;
    }
  }
}

internal::Proxy_builder builder_of(const Working_mesh& mesh, const std::vector<double>& sizes)
{
  return internal::Proxy_builder(std::make_shared<const Working_mesh>(mesh), sizes,
                                 std::vector<char>(mesh.number_of_vertices(), 0), 1);
}

bool is_proxy_wanted(const Working_mesh& mesh, double size)
{
  const std::vector<double> sizes(mesh.number_of_vertices(), size);
  return builder_of(mesh, sizes).is_proxy_wanted();
}

Proxy_mesh make_proxy(const std::string& name, const Working_mesh& mesh, double size,
                      double least_shape = 0.2)
{
  const std::vector<double> sizes(mesh.number_of_vertices(), size);
  Proxy_mesh proxy, again;
  const bool is_made = builder_of(mesh, sizes).build(proxy);
  assert(is_made);
  const bool is_made_again = builder_of(mesh, sizes).build(again);
  assert(is_made_again);
  assert(again.mesh.points == proxy.mesh.points && again.mesh.triangles == proxy.mesh.triangles);

  check_structure(proxy.mesh);
  assert(euler_characteristic(proxy.mesh) == euler_characteristic(mesh));
  check_boundary(proxy);
  check_monotony(proxy);
  const internal::Surface_walk walk(mesh);
  double worst = 1, longest = 0;
  for(int v = 0; v < proxy.mesh.number_of_vertices(); ++v)
    assert((walk.point(proxy.place[v]) - proxy.mesh.points[v]).norm() < 1e-12);
  for(int f = 0; f < proxy.mesh.number_of_faces(); ++f)
  {
    const std::array<int, 3>& t = proxy.mesh.triangles[f];
    worst = (std::min)(worst, internal::triangle_shape(proxy.mesh.points[t[0]],
                                                       proxy.mesh.points[t[1]],
                                                       proxy.mesh.points[t[2]],
                                                       proxy.mesh.normal(f)));
  }
  for(int h = 0; h < proxy.mesh.number_of_halfedges(); ++h)
    longest = (std::max)(longest, proxy.mesh.vector(h).norm());
  std::cout << name << ": " << mesh.number_of_faces() << " -> " << proxy.mesh.number_of_faces()
            << " faces, worst shape " << worst << ", longest edge " << longest / size
            << " quads" << std::endl;
  assert(worst > least_shape && longest < 0.75 * size);
  return proxy;
}

Working_mesh make_plate(int n)
{
  const auto hole = [n](int i, int j)
  {
    const auto is_in = [&](double x, double y, double r)
      { return std::hypot(i + 0.5 - x * n, j + 0.5 - y * n) < r * n; };
    return is_in(0.3, 0.3, 0.15) || is_in(0.7, 0.6, 0.03);
  };
  return Test::make_grid(n, n, false, false,
                         [n](double u, double v) { return Test::in_plane(u / n, v / n); }, hole);
}

void test_need()
{
  assert(is_proxy_wanted(Test::make_sphere(5), 0.4));
  assert(!is_proxy_wanted(Test::make_sphere(3), 0.4));
}

void test_sphere()
{
  const double size = 0.4;
  const Proxy_mesh proxy = make_proxy("sphere", Test::make_sphere(5), size);
  // the sagitta of an edge of half a quad
  assert(check_projection(proxy) < size * size / 4 / 8 * 1.5);
  double area = 0;
  for(int f = 0; f < proxy.mesh.number_of_faces(); ++f)
    area += proxy.mesh.normal(f).norm() / 2;
  assert(std::abs(area / (4 * Test::pi) - 1) < 0.02);
}

void test_plate()
{
  const Proxy_mesh proxy = make_proxy("plate with two holes", make_plate(80), 0.15);
  assert(check_projection(proxy) < 0.02);
}

// points are projected to the same side of a thin wall
void test_thin_wall()
{
  Working_mesh wall = Test::make_sphere(6);
  for(Eigen::Vector3d& p : wall.points)
    p[2] *= 0.01;
  // the rim, a hundred times sharper than the wall is thin, keeps its flat triangles
  const Proxy_mesh proxy = make_proxy("thin wall", wall, 0.2, 0.02);
  assert(check_projection(proxy) < 0.01);
  const internal::Proxy_projection projection(proxy);
  for(int f = 0; f < proxy.mesh.number_of_faces(); ++f)
  {
    const Eigen::Vector3d n = proxy.mesh.normal(f).normalized();
    const Working_location place
      = projection(Working_location{f, {{1. / 3, 1. / 3, 1. / 3}}});
    if(projection.point(place).head<2>().norm() < 0.99)
      assert(projection.point(place)[2] * n[2] > 0);
  }
}

// rows of triangles of height 1e-6
void test_slivers()
{
  const Working_mesh mesh = Test::make_grid(40, 40, false, false, [](double u, double v)
  {
    const double step = std::floor(v / 2);
    return Test::in_plane(u / 40, (2 * step + (v - 2 * step) * 1e-6) / 40);
  }, Test::no_hole);
  assert(is_proxy_wanted(mesh, 0.05));
  const Proxy_mesh proxy = make_proxy("slivers", mesh, 0.15);
  assert(check_projection(proxy) < 1e-9);
}

void test_noise()
{
  const Proxy_mesh proxy
    = make_proxy("noisy sphere", Test::with_noise(Test::make_sphere(5), 0.004), 0.4);
  assert(check_projection(proxy) < 0.03);
}

// Along the rims of a ring with walls a hundredth of its width apart, any projection folds but from
// a proxy with very many faces: it is given up before it outgrows the ring.
void test_thin_ring()
{
  const Working_mesh ring = Test::make_grid(42, 24, true, true, Test::on_thin_ring, Test::no_hole);
  const std::vector<double> sizes(ring.number_of_vertices(), 4);
  Proxy_mesh proxy;
  if(builder_of(ring, sizes).build(proxy))
    assert(proxy.mesh.number_of_faces() <= 2 * ring.number_of_faces());
}

} // namespace

int main()
{
  test_need();
  test_sphere();
  test_plate();
  test_thin_wall();
  test_slivers();
  test_noise();
  test_thin_ring();
  return 0;
}
