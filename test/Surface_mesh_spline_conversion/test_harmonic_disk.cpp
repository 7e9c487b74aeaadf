// The motions of a disk of faces, on plane surfaces whose map is known: k squares around a
// singularity, with the conformal map that spreads them over a full turn. Where the surface has
// been disturbed, the motion leads back to the undisturbed place; it is a bijection that fixes what
// lies outside of the disk.

#include "voxel_seamless_maps.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Harmonic_disk.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/scaled_jacobian.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <vector>

using namespace Test;
using internal::Harmonic_disk;
using internal::Map_neighborhood;
using internal::Working_location;

namespace {

typedef std::complex<double> Complex;
typedef std::function<Complex(const Complex&)> Disturbance;

const double pi = 3.14159265358979323846;
const int quads_per_square = 4, cells_per_quad = 4;
const int n = quads_per_square * cells_per_quad; // cells per square
const int bits = 20;                             // of the coordinates of the map

struct Surface
{
  Seamless_map map;
  std::vector<Complex> undisturbed; // per vertex: the place for which the map is conformal
  int center = 0;
};

// k squares of n x n cells around a vertex. The maps of points of neighbouring squares differ by a
// right angle.
Surface make_surface(int k, const Disturbance& disturb)
{
  Surface surface;
  Seamless_map& map = surface.map;
  map.fractional_bits = bits;
  std::map<std::array<int, 3>, int> number; // square, i, j
  const auto vertex = [&](int s, int i, int j)
  {
    // the side i = 0 of a square is the side j = 0 of the next one
    std::array<int, 3> key = i == 0 && j > 0 ? std::array<int, 3>{{(s + 1) % k, j, 0}}
                                            : std::array<int, 3>{{s, i, j}};
    if(i == 0 && j == 0)
      key[0] = 0;
    const auto entry = number.emplace(key, static_cast<int>(surface.undisturbed.size()));
    if(entry.second)
    {
      const double r = std::hypot(key[1], key[2]) / cells_per_quad;
      const double angle = (std::atan2(key[2], key[1]) + key[0] * pi / 2) * 4 / k;
      const Complex place = std::polar(std::pow(r, 4. / k), angle);
      const Complex disturbed = disturb(place);
      surface.undisturbed.push_back(place);
      map.mesh.points.push_back(Eigen::Vector3d(disturbed.real(), disturbed.imag(), 0));
    }
    return entry.first->second;
  };
  const auto add = [&](int s, const std::array<std::array<int, 2>, 3>& corners)
  {
    std::array<int, 3> t;
    for(int i = 0; i < 3; ++i)
    {
      t[i] = vertex(s, corners[i][0], corners[i][1]);
      map.coordinates.push_back({{(std::int64_t(corners[i][0]) << bits) / cells_per_quad,
                                  (std::int64_t(corners[i][1]) << bits) / cells_per_quad}});
    }
    map.mesh.parent.push_back(map.mesh.triangles.size());
    map.mesh.triangles.push_back(t);
  };
  for(int s = 0; s < k; ++s)
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
      {
        add(s, {{{{i, j}}, {{i + 1, j}}, {{i + 1, j + 1}}}});
        add(s, {{{{i, j}}, {{i + 1, j + 1}}, {{i, j + 1}}}});
      }
  surface.center = vertex(0, 0, 0);
  map.mesh.is_corner.assign(map.mesh.points.size(), 0);
  const bool is_manifold = connect(map);
  assert(is_manifold);
  return surface;
}

Complex undisturbed(const Complex& z) { return z; }

// moves points near the origin only, the origin by almost a third of a quad
Complex disturbed(const Complex& z)
{
  const double bump = (std::max)(0., 1 - std::norm(z / 1.6));
  return z + bump * bump * Complex(0.2, -0.2);
}

Eigen::Vector3d point(const Working_mesh& mesh, const Working_location& at)
{
  const std::array<int, 3>& t = mesh.triangles[at.face];
  return at.barycentric[0] * mesh.points[t[0]] + at.barycentric[1] * mesh.points[t[1]]
         + at.barycentric[2] * mesh.points[t[2]];
}

Working_location at_corner(int face, int i)
{
  Working_location at{face, {{0, 0, 0}}};
  at.barycentric[i] = 1;
  return at;
}

Working_location at_vertex(const Working_mesh& mesh, int v)
{
  const int h = mesh.vertex_halfedge[v];
  return at_corner(h / 3, h % 3);
}

Harmonic_disk make_disk(const Surface& surface, double radius,
                        Harmonic_disk::Weights weights = Harmonic_disk::Weights::GEOMETRIC)
{
  const std::vector<Working_location> centers(1, at_vertex(surface.map.mesh, surface.center));
  return Harmonic_disk(Map_neighborhood(surface.map, centers, radius), radius, weights);
}

double cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.cross(b)[2]; }

// Parts of the faces keep their orientation, and together cover the surface once.
void check_bijection(const Surface& surface, const Harmonic_disk& disk)
{
  const Working_mesh& mesh = surface.map.mesh;
  const int parts = 6;
  double area = 0, image_area = 0;
  for(int f = 0; f < mesh.number_of_faces(); ++f)
  {
    area += mesh.normal(f).norm();
    const auto image = [&](int i, int j)
    {
      const double b = double(i) / parts, c = double(j) / parts;
      return point(mesh, disk(Working_location{f, {{1 - b - c, b, c}}}));
    };
    const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Eigen::Vector3d& c)
    {
      const double part = cross(b - a, c - a);
      assert(part > 0);
      image_area += part;
    };
    for(int j = 0; j < parts; ++j)
      for(int i = 0; i + j < parts; ++i)
      {
        add(image(i, j), image(i + 1, j), image(i, j + 1));
        if(i + j + 1 < parts)
          add(image(i + 1, j), image(i + 1, j + 1), image(i, j + 1));
      }
  }
  // chords of the curved images of lines cut off little
  assert(std::abs(image_area - area) < 1e-3 * area);
}

// distance in the map from the singularity
double map_distance(int k, const Complex& place)
{
  return std::pow(std::abs(place), k / 4.);
}

// What lies outside of the disk stays exactly, the boundary up to rounding.
void check_outside(const Surface& surface, int k, const Harmonic_disk& disk, double radius)
{
  const Working_mesh& mesh = surface.map.mesh;
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
    if(map_distance(k, surface.undisturbed[v]) > (1 + 1e-9) * radius)
      assert((point(mesh, disk(at_vertex(mesh, v))) - mesh.points[v]).norm() < 1e-12);
}

// The motion leads to where the map is conformal.
void check_places(const Surface& surface, const Harmonic_disk& disk, double tolerance)
{
  const Working_mesh& mesh = surface.map.mesh;
  double largest = 0;
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
  {
    const Complex& place = surface.undisturbed[v];
    const Eigen::Vector3d wanted(place.real(), place.imag(), 0);
    largest = (std::max)(largest, (point(mesh, disk(at_vertex(mesh, v))) - wanted).norm());
  }
  assert(largest < tolerance);
}

void check_map(int k)
{
  const double radius = 2.5;
  for(const Disturbance& disturbance : {Disturbance(undisturbed), Disturbance(disturbed)})
  {
    const Surface surface = make_surface(k, disturbance);
    Harmonic_disk disk = make_disk(surface, radius);
    assert(disk.is_valid());
    // before it follows the map, the disk moves nothing
    check_places(surface, disk, disturbance(0) == 0. ? 1e-9 : 0.3);
    const bool is_embedded = disk.follow_map();
    assert(is_embedded);
    // the disturbance moves points by 0.28
    check_places(surface, disk, 0.05);
    check_outside(surface, k, disk, radius);
    check_bijection(surface, disk);
  }
}

void check_shift()
{
  const double radius = 2.5;
  const Surface surface = make_surface(4, undisturbed);
  const Working_location center = at_vertex(surface.map.mesh, surface.center);
  for(const Eigen::Vector2d& motion : {Eigen::Vector2d(0.3, 0), Eigen::Vector2d(-0.2, 0.35)})
  {
    Harmonic_disk disk = make_disk(surface, radius);
    const Eigen::Vector2d from = *disk.place(center), to = from + motion;
    const Eigen::Vector3d goal = point(surface.map.mesh, disk.at_place(to));
    const bool is_embedded = disk.shift(from, to);
    assert(is_embedded);
    // up to the size of the triangles, on which the motion is linear
    assert((point(surface.map.mesh, disk(center)) - goal).norm() < 0.05);
    assert((goal - surface.map.mesh.points[surface.center]).norm() > 0.5);
    check_outside(surface, 4, disk, radius);
    check_bijection(surface, disk);
  }
}

// The second motion takes back the first one, at samples of all faces.
void check_inverse(const Surface& surface, const Harmonic_disk& disk, const Harmonic_disk& back)
{
  const Working_mesh& mesh = surface.map.mesh;
  for(int f = 0; f < mesh.number_of_faces(); ++f)
    for(const std::array<double, 3>& b : {std::array<double, 3>{{0.6, 0.3, 0.1}},
                                          std::array<double, 3>{{0.1, 0.2, 0.7}}})
    {
      const Working_location at{f, b};
      assert((point(mesh, back(disk(at))) - point(mesh, at)).norm() < 1e-9);
    }
}

// Places far apart, between which `shift()` would fold the disk.
void check_drag()
{
  const double radius = 2.5;
  const Surface surface = make_surface(4, undisturbed);
  const Working_location center = at_vertex(surface.map.mesh, surface.center);
  for(const auto weights : {Harmonic_disk::Weights::GEOMETRIC,
                            Harmonic_disk::Weights::COMBINATORIAL})
    for(const Eigen::Vector2d& to : {Eigen::Vector2d(0.7, 0), Eigen::Vector2d(-0.4, 0.6)})
    {
      Harmonic_disk folded = make_disk(surface, radius, weights), disk = folded, back = folded;
      const Eigen::Vector2d from = *disk.place(center);
      const bool is_embedded = folded.shift(from, to);
      assert(!is_embedded);
      const Eigen::Vector3d goal = point(surface.map.mesh, disk.at_place(to));
      disk.drag(from, to);
      assert((point(surface.map.mesh, disk(center)) - goal).norm() < 1e-9);
      assert((goal - surface.map.mesh.points[surface.center]).norm() > 1);
      back.drag(to, from);
      check_inverse(surface, disk, back);
      check_outside(surface, 4, disk, radius);
    }
}

// Two disks meet unless they are apart, and a ring is no disk.
void check_topology()
{
  const Surface surface = make_surface(4, undisturbed);
  const Working_mesh& mesh = surface.map.mesh;
  const auto disk_at = [&](double x, double y, double radius)
  {
    int nearest = 0;
    for(int v = 0; v < mesh.number_of_vertices(); ++v)
      if((mesh.points[v] - Eigen::Vector3d(x, y, 0)).norm()
         < (mesh.points[nearest] - Eigen::Vector3d(x, y, 0)).norm())
        nearest = v;
    const std::vector<Working_location> centers(1, at_vertex(mesh, nearest));
    return Harmonic_disk(Map_neighborhood(surface.map, centers, radius), radius);
  };
  const Harmonic_disk left = disk_at(-1.5, 0, 1), right = disk_at(1.5, 0, 1);
  const Harmonic_disk large = disk_at(0, 0, 2), upper = disk_at(-1.5, 1.5, 1);
  assert(left.is_valid() && right.is_valid() && large.is_valid() && upper.is_valid());
  assert(!left.meets(right) && !right.meets(left));
  assert(left.meets(large) && large.meets(left) && left.meets(upper));
  // at the boundary of the surface
  const Harmonic_disk corner = disk_at(4, 4, 1);
  assert(corner.is_valid());
  check_bijection(surface, corner);
  // the whole surface is a disk, too
  assert(disk_at(0, 0, 20).is_valid());
}

void check_scaled_jacobian()
{
  typedef std::array<Eigen::Vector3d, 4> Quad;
  const Eigen::Vector3d o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), up(0, 0, 1), down(0, 0, -1);
  const Quad square = {{o, x, x + y, y}};
  assert(std::abs(internal::scaled_jacobian(square) - 1) < 1e-12);
  assert(std::abs(internal::oriented_scaled_jacobian(square, up) - 1) < 1e-12);
  assert(std::abs(internal::oriented_scaled_jacobian(square, down) + 1) < 1e-12);
  // at right angles to the surface
  assert(internal::oriented_scaled_jacobian(square, x) == 0);
  // a rhombus with an angle of 30 degrees
  const Eigen::Vector3d slanted(std::cos(pi / 6), std::sin(pi / 6), 0);
  assert(std::abs(internal::scaled_jacobian({{o, x, x + slanted, slanted}}) - 0.5) < 1e-12);
  // a concave corner, and a side without length
  assert(internal::scaled_jacobian({{o, x, 0.1 * (x + y), y}}) < 0);
  assert(internal::scaled_jacobian({{o, x, x, y}}) == 0);
}

} // namespace

int main()
{
  for(const int k : {3, 4, 5, 6})
    check_map(k);
  check_shift();
  check_drag();
  check_topology();
  check_scaled_jacobian();
  return 0;
}
