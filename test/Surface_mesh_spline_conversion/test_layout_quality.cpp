// The figures of the quality of a layout agree with those calculated by hand: of two sheared
// squares, whose lines turn at the common side, and of three rhombi about an extraordinary point.
// Quads are known to be inverted that turn right at a corner or not at all, or wind backwards.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Surface_mesh_spline_conversion/extract_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/inverted_quads.h>
#include <CGAL/Surface_mesh_spline_conversion/measure_layout_quality.h>

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

namespace {

const double half_width = 10; // of the square mesh in the plane z = 0
const double degrees = 180 / CGAL_PI;

template <typename K>
CGAL::Surface_mesh<typename K::Point_3> make_square()
{
  typedef typename K::Point_3 Point_3;
  CGAL::Surface_mesh<Point_3> mesh;
  const auto a = mesh.add_vertex(Point_3(-half_width, -half_width, 0));
  const auto b = mesh.add_vertex(Point_3(half_width, -half_width, 0));
  const auto c = mesh.add_vertex(Point_3(half_width, half_width, 0));
  const auto d = mesh.add_vertex(Point_3(-half_width, half_width, 0));
  mesh.add_face(a, b, c);
  mesh.add_face(a, c, d);
  return mesh;
}

// quads mapped bilinearly to the square
template <typename K>
struct Bilinear_map
  : public SC::Quad_layout<K>::Inverse_map
{
  typedef SC::Quad_layout<K> Layout;

  explicit Bilinear_map(const Layout& layout) : m_layout(layout) {}

  typename Layout::Location operator()(std::size_t quad, typename K::FT u,
                                       typename K::FT v) const override
  {
    const double weights[4] = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
    double x = 0, y = 0;
    for(int i = 0; i < 4; ++i)
    {
      x += weights[i] * m_layout.point(m_layout.vertex(quad, i)).x();
      y += weights[i] * m_layout.point(m_layout.vertex(quad, i)).y();
    }
    const double s = (x + half_width) / (2 * half_width), t = (y + half_width) / (2 * half_width);
    typename Layout::Location location;
    location.point = typename K::Point_3(x, y, 0);
    location.face = s > t ? 0 : 1;
    location.barycentric = s > t ? std::array<double, 3>{{1 - s, s - t, t}}
                                 : std::array<double, 3>{{1 - t, s, t - s}};
    return location;
  }

  Layout m_layout;
};

template <typename K>
SC::Quad_layout<K> make_layout(const std::vector<typename K::Point_3>& points,
                               const std::vector<std::array<std::size_t, 4> >& quads)
{
  SC::Quad_layout<K> layout(points, quads);
  layout.set_inverse_map(std::make_shared<const Bilinear_map<K> >(layout));
  return layout;
}

void check(double value, double expected)
{
  const double tolerance = 1e-5; // of the difference quotients
  assert(std::abs(value - expected) < tolerance * (1 + std::abs(expected)));
  (void)value;
  (void)expected;
}

template <typename K>
void test_sheared_squares(double shear, double size)
{
  typedef typename K::Point_3 P;
  const auto mesh = make_square<K>();
  const SC::Quad_layout<K> layout = make_layout<K>(
    {P(0, shear, 0), P(1, 0, 0), P(2, shear, 0), P(0, 1 + shear, 0), P(1, 1, 0), P(2, 1 + shear, 0)},
    {{{0, 1, 4, 3}}, {{1, 2, 5, 4}}});
  SC::Conversion_report::Map map;
  SC::measure_layout_quality(layout, mesh, map, CGAL::parameters::quad_size_map(size));

  assert(map.extraordinary_points == 0);
  const double angle = std::atan(shear), square = shear * shear;
  check(map.min_scaled_jacobian, std::cos(angle));
  check(map.mean_angle_deviation_degrees, angle * degrees);
  check(map.max_angle_deviation_degrees, angle * degrees);
  check(map.min_size_ratio, 1 / size);
  check(map.max_size_ratio, std::sqrt(1 + square) / size);
  check(map.mean_size_ratio, (1 + std::sqrt(1 + square)) / 2 / size);
  check(map.relative_number_of_quads, 2 * size * size / (4 * half_width * half_width));
  // eigenvalues of the first fundamental form, whose determinant is one
  const double eigenvalue = 1 + square / 2 + std::sqrt(square + square * square / 4);
  check(map.mean_singular_value_ratio, eigenvalue);
  check(map.max_singular_value_ratio, eigenvalue);
  check(map.mean_area_ratio, size < 1 ? 1 / (size * size) : size * size);
  check(map.max_area_ratio, map.mean_area_ratio);
  // of the lines of constant v; those of constant u do not cross an inner side
  check(map.mean_kink_degrees, 2 * angle * degrees);
  check(map.max_kink_degrees, 2 * angle * degrees);
}

// a size given per vertex, linear in x
template <typename K>
void test_size_field()
{
  typedef typename K::Point_3 P;
  auto mesh = make_square<K>();
  auto sizes = mesh.template add_property_map<CGAL::SM_Vertex_index, double>("v:size").first;
  for(const auto v : mesh.vertices())
    sizes[v] = 2 + 0.1 * mesh.point(v).x();
  const SC::Quad_layout<K> layout
    = make_layout<K>({P(0, 0, 0), P(1, 0, 0), P(1, 1, 0), P(0, 1, 0)}, {{{0, 1, 2, 3}}});
  SC::Conversion_report::Map map;
  SC::measure_layout_quality(layout, mesh, map, CGAL::parameters::quad_size_map(sizes));
  check(map.max_size_ratio, 1 / 2.0);
  check(map.min_size_ratio, 1 / 2.1);
  check(map.mean_size_ratio, (1 / 2.0 + 1 / 2.1 + 2 / 2.05) / 4);
}

template <typename K>
void test_rhombi()
{
  typedef typename K::Point_3 P;
  std::vector<P> points(1, P(0, 0, 0));
  for(int i = 0; i < 6; ++i)
    points.push_back(P(std::cos(i * CGAL_PI / 3), std::sin(i * CGAL_PI / 3), 0));
  const SC::Quad_layout<K> layout
    = make_layout<K>(points, {{{0, 1, 2, 3}}, {{0, 3, 4, 5}}, {{0, 5, 6, 1}}});
  SC::Conversion_report::Map map;
  SC::measure_layout_quality(layout, make_square<K>(), map);
  assert(map.extraordinary_points == 1);
  check(map.min_scaled_jacobian, std::sqrt(3.) / 2);
  check(map.mean_angle_deviation_degrees, 30);
  check(map.relative_number_of_quads, 1); // without a size, the quads have the right one
  check(map.max_kink_degrees, 60);
}

template <typename K>
void test_inverted_quads()
{
  typedef typename K::Point_3 P;
  typedef std::vector<std::size_t> Quads;
  const auto mesh = make_square<K>();
  const auto inverted = [&](const std::vector<P>& points,
                            const std::vector<std::array<std::size_t, 4> >& quads)
  {
    return SC::internal::inverted_quads(
      make_layout<K>(points, quads),
      SC::internal::face_corners(mesh, get(CGAL::vertex_point, mesh)));
  };
  const auto with_last_corner = [&](double x, double y)
  { return inverted({P(0, 0, 0), P(2, 0, 0), P(x, y, 0), P(0, 2, 0)}, {{{0, 1, 2, 3}}}); };
  assert(with_last_corner(2, 2) == Quads());
  assert(with_last_corner(1.01, 1.01) == Quads());
  assert(with_last_corner(1, 1) == Quads{0});     // three corners on a line
  assert(with_last_corner(0.5, 0.5) == Quads{0}); // turns right
  assert(with_last_corner(2, 0) == Quads{0});     // a side without length
  // the second one winds backwards, the third one crosses itself
  assert((inverted({P(0, 0, 0), P(1, 0, 0), P(1, 1, 0), P(0, 1, 0), P(3, 0, 0), P(3, 1, 0),
                    P(4, 1, 0), P(4, 0, 0), P(6, 0, 0), P(7, 0, 0), P(6, 1, 0), P(7, 1, 0)},
                   {{{0, 1, 2, 3}}, {{4, 5, 6, 7}}, {{8, 9, 10, 11}}}) == Quads{1, 2}));
}

template <typename K>
void test()
{
  for(const double shear : {0., 0.2, 1.})
    for(const double size : {0.5, 1., 3.})
      test_sheared_squares<K>(shear, size);
  test_size_field<K>();
  test_rhombi<K>();
  test_inverted_quads<K>();
}

} // namespace

int main()
{
  test<CGAL::Simple_cartesian<double> >();
  test<CGAL::Exact_predicates_inexact_constructions_kernel>();
  return 0;
}
