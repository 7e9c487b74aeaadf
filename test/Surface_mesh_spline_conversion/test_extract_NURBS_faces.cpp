// Shells of T-NURCC surfaces: extraordinary points of all valences at all distances from the
// boundary, corners of both kinds, further vertices on the boundary, files.
#include "block_layouts.h"
#include "separatrix_rectangles.h"
#include "shell_checks.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/OBJ_quad_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_NURBS_faces.h>

#include <cstddef>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;
typedef CGAL::Simple_cartesian<double> K;
typedef K::Point_3 Point_3;
typedef SMSC::Quad_layout<K> Quad_layout;
typedef SMSC::NURBS_shell_3<K> Shell;

const double RADIUS = 10;

Point_3 on_sphere(double x, double y, double z)
{
  const double length = std::sqrt(x * x + y * y + z * z);
  return Point_3(RADIUS * x / length, RADIUS * y / length, RADIUS * z / length);
}

Point_3 on_cylinder(double x, double y, double z)
{
  const double length = std::sqrt(x * x + y * y);
  return Point_3(RADIUS * x / length, RADIUS * y / length, RADIUS * z);
}

// with rims that leave their planes
Point_3 on_wavy_cylinder(double x, double y, double z)
{
  return on_cylinder(x, y, z) + K::Vector_3(0, 0, 2 * x * y / (x * x + y * y));
}

Point_3 on_hill(double x, double y, double)
{
  return Point_3(RADIUS * x + std::sin(3 * y) / 2, RADIUS * y, 3 * std::cos(2 * x) * std::cos(1.5 * y));
}

// the first corner of a bicubic face is a point of its patch, at a multiple of 1/32 of its sides
void check_vertices(const CGAL::T_NURCC_surface_3<K>& surface, const Shell& shell)
{
  for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
  {
    const auto& face = shell.face(f);
    if(face.is_extraordinary)
      continue;
    double best = 1e9;
    const auto o = surface.patch_origin(face.patch);
    const Point_3 p = face.surface.control_point(0, 0);
    for(int k = 0; k < 33 * 33; ++k)
    {
      const double u = o.u0 + (o.u1 - o.u0) * (k % 33) / 32, v = o.v0 + (o.v1 - o.v0) * (k / 33) / 32;
      best = (std::min)(best, (p - surface.position(face.patch, u, v)).squared_length());
    }
    assert(best < 1e-24 * RADIUS * RADIUS);
  }
}

// the derivative of the surface at corner `at` of a quad towards its corner `to`
K::Vector_3 derivative_along_side(const CGAL::T_NURCC_surface_3<K>& surface, std::size_t q, int at,
                                  int to)
{
  static const int u[4] = {0, 1, 1, 0}, v[4] = {0, 0, 1, 1};
  const std::size_t patch = surface.patch_at(q, u[at & 3], v[at & 3]);
  return (u[to & 3] - u[at & 3]) * surface.derivative(patch, u[at & 3], v[at & 3], 1, 0)
       + (v[to & 3] - v[at & 3]) * surface.derivative(patch, u[at & 3], v[at & 3], 0, 1);
}

// the largest angle between the normals on both sides of the lines above corners, at the corners
double largest_angle_at_corners(const Quad_layout& layout,
                                const CGAL::T_NURCC_surface_3<K>& surface)
{
  double result = 0;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
    {
      const int at = (i + 1) & 3;
      if(!layout.is_border(q, i) || !layout.is_corner(layout.vertex(q, at)) || layout.is_border(q, at))
        continue;
      const auto other = layout.neighbor(q, at);
      const K::Vector_3 line = derivative_along_side(surface, q, at, at + 1);
      const K::Vector_3 a = CGAL::cross_product(line, derivative_along_side(surface, q, at, i));
      const K::Vector_3 b = CGAL::cross_product(
        derivative_along_side(surface, other.first, other.second + 1, other.second + 2), line);
      result = (std::max)(result, std::atan2(
        std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b) * 180 / CGAL_PI);
    }
  return result;
}

// Above a corner between two quads, moves the control points that give the direction of the line
// between them, such that it lies in the plane of the tangents of the boundary, or has the given
// slope against it.
void straighten_corners(const Quad_layout& layout, CGAL::T_NURCC_surface_3<K>& surface,
                        double slope = 0)
{
  static const int u[4] = {0, 1, 1, 0}, v[4] = {0, 0, 1, 1};
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
    {
      const int at = (i + 1) & 3; // the corner
      if(!layout.is_border(q, i) || !layout.is_corner(layout.vertex(q, at)) || layout.is_border(q, at))
        continue;
      const auto other = layout.neighbor(q, at);
      const K::Vector_3 back = derivative_along_side(surface, q, at, i);
      const K::Vector_3 on
        = derivative_along_side(surface, other.first, other.second + 1, other.second + 2);
      const K::Vector_3 normal = CGAL::cross_product(on, back);
      const double scale = slope * std::sqrt((back + on).squared_length() / normal.squared_length());
      const K::Vector_3 direction = back + on + scale * normal;
      std::vector<CGAL::T_NURCC_surface_3<K>::Basis_function> functions;
      surface.basis(surface.patch_at(q, u[at], v[at]), u[at], v[at], 1, functions);
      for(const auto& f : functions)
      {
        const int next = (at + 1) & 3;
        const double inwards = (u[next] - u[at]) * f.value[1] + (v[next] - v[at]) * f.value[2];
        const Point_3 corner = layout.point(layout.vertex(q, at));
        const Point_3 p = surface.control_point(f.control_point);
        if(inwards > 1e-9 && (p - corner).squared_length() > 0)
          surface.set_control_point(f.control_point, corner + direction * std::sqrt(
            (p - corner).squared_length() / direction.squared_length()));
      }
    }
}

std::size_t number_of_separatrix_rectangles(const Quad_layout& layout)
{
  Separatrix_rectangles::Neighbors neighbors(layout.number_of_quads());
  std::vector<std::pair<std::size_t, int> > corners;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
    {
      neighbors[q][i] = layout.is_border(q, i) ? std::make_pair(std::size_t(-1), 0)
                                               : std::pair<std::size_t, int>(layout.neighbor(q, i));
      if(layout.is_corner(layout.vertex(q, i)) && !layout.is_border(q, i)
         && layout.is_border(q, (i + 3) & 3))
        corners.emplace_back(q, i);
    }
  return Separatrix_rectangles(neighbors, std::size_t(-1), corners).number_of_rectangles();
}

// a single polynomial, if it is not beside a crease
bool is_single_piece(const SMSC::B_spline_surface_3<K>& surface)
{
  return surface.knots[0].number_of_spans() == 1
      && (surface.knots[1].number_of_spans() == 1 || surface.knots[1].degree() == 5);
}

// the lines above corners that have edges; each begins at the boundary
std::size_t number_of_lines_above_corners(const Shell& shell)
{
  std::vector<char> is_on_border(shell.number_of_vertices(), false);
  for(std::size_t e = 0; e < shell.number_of_edges(); ++e)
    if(shell.is_border(e))
      is_on_border[shell.edge(e).source] = is_on_border[shell.edge(e).target] = true;
  std::set<std::size_t> lines;
  for(std::size_t e = 0; e < shell.number_of_edges(); ++e)
    if(shell.is_crease(e)
       && (is_on_border[shell.edge(e).source] || is_on_border[shell.edge(e).target]))
      lines.insert(shell.face(shell.face_of_edge(e, true)).crease);
  return lines.size();
}

// a negative number of border edges stands for any
void check(const std::string& name, const Quad_layout& layout,
           const CGAL::T_NURCC_surface_3<K>& surface, long euler_characteristic,
           long number_of_border_edges, std::size_t number_of_creases)
{
  std::size_t faces = 0;
  for(bool merge : {false, true})
  {
    Shell shell;
    const auto statistics = SMSC::extract_NURBS_faces(
      surface, shell, CGAL::parameters::interior_tolerance(1e-2).do_merge_patches(merge));
    const Shell_checks<K> checks(shell);
    std::cout << name << ": " << surface.number_of_patches() << " patches, "
              << shell.number_of_faces() << " faces, caps deviate " << statistics.deviation
              << ", " << statistics.number_of_creases << " creases " << statistics.crease_deviation
              << ", gap " << checks.largest_gap << ", angle " << checks.largest_angle << std::endl;
    assert(checks.euler_characteristic == euler_characteristic);
    assert(checks.largest_gap < 1e-13 * RADIUS);
    assert(checks.largest_angle < 1e-8);
    assert(statistics.number_of_creases == number_of_creases);
    assert(number_of_lines_above_corners(shell) == number_of_creases);
    assert(statistics.number_of_caps == surface.number_of_extraordinary_points());
    assert(statistics.number_of_sharp_caps == 0);
    // the caps of the surface are those of the faces, unless these have to be smaller beside creases
    assert(!surface.has_caps() || number_of_creases > 0 || statistics.deviation < 1e-13 * RADIUS);
    assert(!merge || number_of_border_edges < 0
           || checks.number_of_border_edges == number_of_border_edges);
    assert(!merge || shell.number_of_faces() < faces);
    std::size_t sectors = 2 * number_of_creases; // those of creases and caps
    for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
    {
      sectors += shell.face(f).is_extraordinary;
      assert(merge || is_single_piece(shell.face(f).surface));
    }
    assert(!merge
           || shell.number_of_faces() - sectors <= 4 * number_of_separatrix_rectangles(layout));
    faces = shell.number_of_faces();
    if(!surface.has_caps() || number_of_creases == 0)
      check_vertices(surface, shell);
  }
}

// with the caps of the faces alone, and with a surface that has them itself
void test(const std::string& name, const Quad_layout& layout, long euler_characteristic,
          long number_of_border_edges, std::size_t number_of_creases = 0,
          int number_of_refinements = 0)
{
  CGAL::T_NURCC_surface_3<K> surface(layout);
  assert(surface.error() == SMSC::Error_code::OK);
  for(int i = 0; i < number_of_refinements; ++i)
    surface.refine_boundary({{0, 0, std::ldexp(1., -i)}});
  assert(number_of_refinements == 0 || surface.number_of_t_junctions() > 0);
  straighten_corners(layout, surface);
  check(name, layout, surface, euler_characteristic, number_of_border_edges, number_of_creases);
  surface.set_caps(true);
  check(name + " with caps", layout, surface, euler_characteristic, number_of_border_edges,
        number_of_creases);
}

// Where the line above a corner leaves the plane of the tangents of the boundary, its faces do not;
// next to extraordinary points, and away from them. For that the line is moved by no more than a
// tenth of the tolerance, however much it leaves the plane.
void test_lines_out_of_the_tangent_plane(int m, double tolerance)
{
  auto is_corner = [](const Point_3& p)
  { return p.z() > 0 && std::abs(std::abs(p.x()) - std::abs(p.y())) < 1e-9; };
  const Quad_layout layout = block_layout<K>(cube_blocks(true), m, on_sphere, is_corner);
  double deviation_in_plane = 0; // of the faces at creases
  for(double slope : {0., 0.02, -0.02, 0.05, -0.05, 0.7, -0.7})
  {
    CGAL::T_NURCC_surface_3<K> surface(layout);
    straighten_corners(layout, surface, slope);
    const double angle = largest_angle_at_corners(layout, surface);
    assert(slope == 0 ? angle < 1e-8 : angle > 1);
    Shell shell;
    const auto statistics = SMSC::extract_NURBS_faces(
      surface, shell, CGAL::parameters::interior_tolerance(tolerance));
    const Shell_checks<K> checks(shell);
    assert(statistics.number_of_creases == 4);
    assert(checks.largest_gap < 1e-13 * RADIUS);
    assert(checks.largest_angle < 1e-8);
    if(slope == 0)
      deviation_in_plane = statistics.crease_deviation;
    if(std::abs(slope) < 0.1)
      assert(statistics.crease_deviation < 1.1 * (deviation_in_plane + 0.1 * tolerance));
    else // the faces have to turn from the plane
      assert(statistics.crease_deviation < deviation_in_plane + 0.3 * tolerance);
    if(tolerance == 2 && std::abs(slope) < 0.03) // a tenth is for the faces at creases as a whole
      assert(statistics.crease_deviation < 0.1 * tolerance);
  }
}

// an edge of the boundary is cut where a vertex is wanted, and nothing else changes
void test_boundary_vertices()
{
  const Quad_layout layout = block_layout<K>(polygon_blocks(5), 2, on_hill);
  const CGAL::T_NURCC_surface_3<K> surface(layout);
  Shell plain, cut;
  SMSC::extract_NURBS_faces(surface, plain);
  std::vector<SMSC::Boundary_vertex<double> > vertices;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int side = 0; side < 4; ++side)
      if(layout.is_border(q, side))
      {
        vertices.push_back({q, side, 0.3});
        vertices.push_back({q, side, 0});
        vertices.push_back({q, side, 1. / 3});
      }
  SMSC::extract_NURBS_faces(surface, cut, CGAL::parameters::boundary_vertices(vertices));
  const Shell_checks<K> before(plain), after(cut);
  assert(plain.number_of_faces() == cut.number_of_faces());
  assert(after.euler_characteristic == before.euler_characteristic);
  assert(after.largest_gap < 1e-13 * RADIUS);
  assert(after.number_of_border_edges == long(vertices.size()));
  for(const auto& v : vertices)
  {
    const double t[4][2] = {{v.parameter, 0}, {1, v.parameter}, {1 - v.parameter, 1},
                            {0, 1 - v.parameter}};
    const double x = t[v.side][0], y = t[v.side][1];
    const Point_3 p = surface.position(surface.patch_at(v.quad, x, y), x, y);
    double best = 1e9;
    for(std::size_t i = 0; i < cut.number_of_vertices(); ++i)
      best = (std::min)(best, (p - cut.point(i)).squared_length());
    assert(best < 1e-24 * RADIUS * RADIUS);
  }
}

// the largest ratio of the length of a border edge to its shortest span, in the parameter
double largest_border_edge(const Shell& shell)
{
  std::vector<int> uses(shell.number_of_edges(), 0);
  for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
    for(const auto& use : shell.face(f).loop)
      ++uses[use.edge];
  double result = 0;
  for(std::size_t e = 0; e < uses.size(); ++e)
  {
    const std::vector<double>& knots = shell.edge(e).curve.knots.knots();
    if(uses[e] == 1)
      for(std::size_t i = 1; i < knots.size(); ++i)
        result = (std::max)(result, (knots.back() - knots.front()) / (knots[i] - knots[i - 1]));
  }
  return result;
}

// Where the boundary is refined towards a point, its edges are divided such that kernels, which
// look at an edge at a few parameters, do not miss the short spans; edges in planes, whose faces beside
// may be in other surfaces, are longer.
void test_refined_boundary(const Quad_layout& layout, bool is_planar)
{
  CGAL::T_NURCC_surface_3<K> surface(layout);
  for(int i = 0; i < 9; ++i)
    surface.refine_boundary({{0, 0, std::ldexp(1., -i)}});
  Shell shell;
  SMSC::extract_NURBS_faces(surface, shell);
  const Shell_checks<K> checks(shell);
  const double largest = largest_border_edge(shell);
  assert(checks.largest_gap < 1e-13 * RADIUS);
  assert(is_planar ? 16 < largest && largest <= 64 : largest <= 16);
}

std::size_t count(const std::string& text, const std::string& word)
{
  std::size_t n = 0;
  for(std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++n;
  return n;
}

void test_obj()
{
  const Quad_layout layout = block_layout<K>(cube_blocks(true), 2, on_sphere);
  const CGAL::T_NURCC_surface_3<K> surface(layout);
  std::ostringstream quads, control;
  bool written = CGAL::IO::write_OBJ(quads, layout) && CGAL::IO::write_OBJ(control, surface);
  assert(written);
  assert(count(quads.str(), "v ") == layout.number_of_vertices());
  assert(count(quads.str(), "f ") == layout.number_of_quads());
  assert(count(control.str(), "v ") == surface.number_of_control_points());
  assert(count(control.str(), "f ") == surface.control_mesh().number_of_faces());
}

int main()
{
  test("sphere 1", block_layout<K>(cube_blocks(false), 1, on_sphere), 2, 0);
  test("sphere 3", block_layout<K>(cube_blocks(false), 3, on_sphere), 2, 0);
  test("cup 1", block_layout<K>(cube_blocks(true), 1, on_sphere), 1, 2);
  test("cup 2", block_layout<K>(cube_blocks(true), 2, on_sphere), 1, 2);
  auto is_corner = [](const Point_3& p)
  { return p.z() > 0 && std::abs(std::abs(p.x()) - std::abs(p.y())) < 1e-9; };
  for(int m : {1, 2, 3, 4}) // distance of extraordinary points from each other and from corners
    test("cup with corners " + std::to_string(m),
         block_layout<K>(cube_blocks(true), m, on_sphere, is_corner), 1, -1, 4);
  for(int n : {3, 5, 6, 7, 8})
    test("polygon " + std::to_string(n),
         block_layout<K>(polygon_blocks(n), (n < 7) ? 1 : 2, on_hill), 1, 2 * n);
  test("refined polygon 5", block_layout<K>(polygon_blocks(5), 3, on_hill), 1, -1, 0, 3);
  test("refined cup", block_layout<K>(cube_blocks(true), 4, on_sphere), 1, -1, 0, 3);
  test("tube", block_layout<K>(tube_blocks(), 3, on_cylinder), 0, -1);
  test("refined tube", block_layout<K>(tube_blocks(), 4, on_cylinder), 0, -1, 0, 3);
  for(int m : {1, 2, 3})
    for(double tolerance : {2., 0.5})
      test_lines_out_of_the_tangent_plane(m, tolerance);
  test_boundary_vertices();
  test_refined_boundary(block_layout<K>(tube_blocks(), 3, on_wavy_cylinder), false);
  test_refined_boundary(block_layout<K>(tube_blocks(), 3, on_cylinder), true);
  test_obj();
  return 0;
}
