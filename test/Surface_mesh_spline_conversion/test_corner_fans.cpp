// The line of a layout that leaves a concave corner of the boundary with a quad above a straight
// angle is turned to the bisector, within the faces around the corner; other lines stay.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Corner_fans.h>

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef Kernel::Point_3 Point;
typedef CGAL::Surface_mesh<Point> Mesh;
typedef SC::Surface_location<Kernel> Location;

const Point origin(0, 0, 0);

double angle_between(const Point& a, const Point& b)
{
  const auto x = a - origin, y = b - origin;
  return std::atan2(std::sqrt(CGAL::cross_product(x, y).squared_length()), x * y);
}

// Faces around the origin, not in a plane; the rim has about the radius 1.
struct Fan
{
  static constexpr std::size_t number_of_faces = 7;
  std::vector<Point> rim;
  std::vector<double> angles = {0}; // of the edges, when the faces are developed
  Mesh mesh;

  explicit Fan(double extent)
  {
    const Mesh::Vertex_index center = mesh.add_vertex(origin);
    std::vector<Mesh::Vertex_index> v;
    for(std::size_t k = 0; k <= number_of_faces; ++k)
    {
      const double x = extent * double(k) / number_of_faces;
      rim.emplace_back(std::cos(x), std::sin(x), 0.2 * std::sin(3 * x));
      v.push_back(mesh.add_vertex(rim.back()));
    }
    for(std::size_t k = 0; k < number_of_faces; ++k)
    {
      angles.push_back(angles.back() + angle_between(rim[k], rim[k + 1]));
      const std::array<Mesh::Vertex_index, 3> turned[3]
        = {{{center, v[k], v[k + 1]}}, {{v[k], v[k + 1], center}}, {{v[k + 1], center, v[k]}}};
      mesh.add_face(turned[k % 3]);
    }
  }

  double angle() const { return angles.back(); }

  double angle(const Location& at) const
  {
    return angles[at.face] + angle_between(rim[at.face], at.point);
  }

  // the point at the angle `x` and the distance `r`
  Location place(double x, double r) const
  {
    std::size_t k = 0;
    while(k + 1 < number_of_faces && angles[k + 1] < x)
      ++k;
    const auto a = rim[k] - origin, b = rim[k + 1] - origin;
    const double whole = angles[k + 1] - angles[k];
    const auto d = std::sin(whole - (x - angles[k])) / std::sqrt(a.squared_length()) * a
                   + std::sin(x - angles[k]) / std::sqrt(b.squared_length()) * b;
    return location(k, origin + (r / std::sin(whole)) * d);
  }

  Location location(std::size_t face, const Point& p) const
  {
    Location result;
    result.face = face;
    result.point = p;
    result.barycentric = {{0, 0, 0}};
    if(p == origin)
      for(std::size_t i = 0; i < 3; ++i)
        result.barycentric[i] = corner(face, i) == origin;
    return result;
  }

  // the vertices of a face as those of `vertices_around_face()`
  Point corner(std::size_t face, std::size_t i) const
  {
    std::vector<Point> result;
    const Mesh::Face_index f(static_cast<Mesh::size_type>(face));
    for(const auto v : vertices_around_face(mesh.halfedge(f), mesh))
      result.push_back(mesh.point(v));
    return result[i];
  }
};

// Two quads at the origin; the line between them leaves it at the angle `line`, as a ray.
struct Layout
{
  typedef double FT;
  typedef Point Point_3;
  typedef ::Location Location;

  const Fan& fan;
  double line;

  struct Inverse_map
  {
    const Layout& layout;

    Location operator()(std::size_t quad, double u, double v) const
    {
      const double right_angle = std::acos(0.);
      const Fan& fan = layout.fan;
      const double r = quad == 0 ? std::hypot(u, v) : std::hypot(1 - u, v);
      if(r == 0)
        return fan.location(quad == 0 ? 0 : Fan::number_of_faces - 1, origin);
      return quad == 0
               ? fan.place(layout.line * std::atan2(v, u) / right_angle, r)
               : fan.place(layout.line + (fan.angle() - layout.line)
                                           * std::atan2(1 - u, v) / right_angle, r);
    }
  };

  Inverse_map inverse_map() const { return Inverse_map{*this}; }
  std::size_t number_of_quads() const { return 2; }
  std::size_t vertex(std::size_t quad, int i) const
  {
    static const std::size_t vertices[2][4] = {{0, 1, 2, 3}, {4, 0, 3, 5}};
    return vertices[quad][i & 3];
  }
  bool is_corner(std::size_t v) const { return v == 0; }
  std::pair<std::size_t, int> neighbor(std::size_t quad, int) const
  {
    return quad == 0 ? std::make_pair(std::size_t(1), 1) : std::make_pair(std::size_t(0), 3);
  }
  bool is_border(std::size_t quad, int i) const { return (i & 3) != (quad == 0 ? 3 : 1); }
};

double distance(const Point& a, const Point& b) { return std::sqrt((a - b).squared_length()); }

// a point is a combination of the vertices of its face
void check_barycentric(const Fan& fan, const Location& at)
{
  auto p = origin;
  for(std::size_t i = 0; i < 3; ++i)
  {
    assert(at.barycentric[i] > -1e-12);
    p = p + at.barycentric[i] * (fan.corner(at.face, i) - origin);
  }
  assert(distance(p, at.point) < 1e-12);
}

void test(double extent, double share_of_line, bool is_turned)
{
  const Fan fan(extent);
  const Layout layout{fan, share_of_line * fan.angle()};
  const SC::internal::Mesh_projection mesh(fan.mesh, fan.mesh.points());
  const SC::internal::Corner_fans<Layout> fans(layout, mesh);
  const double largest = std::abs(share_of_line - 0.5) + 0.5; // of the shares of the quads
  assert(is_turned == (largest * fan.angle() > 0.9 * CGAL_PI));
  constexpr int n = 200;
  double last_angle_of_line = fan.angle() / 2;
  for(double r : {1e-6, 1e-3, 0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8})
  {
    const double angle_of_line = fan.angle(fans(fan.place(layout.line, r)));
    assert(std::abs(angle_of_line - fan.angle() / 2)
           >= std::abs(last_angle_of_line - fan.angle() / 2) - 1e-9);
    last_angle_of_line = angle_of_line;
    if(is_turned && r <= 0.02)
      assert(std::abs(angle_of_line - fan.angle() / 2) < 1e-9);
    double last = -1e-9;
    for(int i = 0; i <= n; ++i)
    {
      const Location at = fan.place(fan.angle() * i / n, r), turned = fans(at);
      assert(std::abs(distance(turned.point, origin) - r) < 1e-12);
      assert(fan.angle(turned) > last);
      last = fan.angle(turned);
      if(!is_turned || r > 0.5)
        assert(turned.face == at.face && turned.point == at.point);
      else if(r < 0.3)
        check_barycentric(fan, turned);
      if(i == 0 || i == n)
        assert(distance(turned.point, at.point) < 1e-7 * r);
    }
  }
}

int main()
{
  test(5, 0.2, true);
  test(5, 0.8, true);
  test(5.5, 0.45, true);
  test(4.5, 0.45, false); // both angles are below 0.9 of a straight one
  test(3.5, 0.5, false);
  return 0;
}
