// Deviations of a plane face with known answers from a plane mesh with straight boundary.
#include "graph_mesh.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>
#include <CGAL/Surface_mesh_spline_conversion/measure_deviation.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;
typedef CGAL::Simple_cartesian<double> K;
typedef K::Point_3 Point_3;
typedef CGAL::Surface_mesh<Point_3> Mesh;
typedef SMSC::NURBS_shell_3<K> Shell;
typedef SMSC::NURBS_curve_traits_3<K> Curve_traits;
typedef SMSC::Boundary_curve_network_3<Mesh, Curve_traits> Network;

constexpr double SIZE = 10;
const int CELLS = 20;

// two bicubic faces side by side over the square; `z(i,j)` moves control point i of 0 to 6, j of 0
// to 3; or over a part of the square that is `width` wide
Shell two_faces(const std::function<double(int, int)>& z, double width = SIZE,
                std::size_t crease = Shell::null)
{
  Shell shell;
  const SMSC::Knot_vector<double> knots(3, {0, 1});
  auto point = [&](int i, int j) { return Point_3(SIZE * i / 6, width * j / 3, z(i, j)); };
  std::map<std::pair<int, int>, std::size_t> vertex;
  for(int i : {0, 3, 6})
    for(int j : {0, 3})
      vertex[{i, j}] = shell.add_vertex(point(i, j));
  auto edge = [&](int i0, int j0, int i1, int j1)
  {
    Shell::Edge e = {vertex[{i0, j0}], vertex[{i1, j1}], {knots, {}}};
    for(int k = 0; k <= 3; ++k)
      e.curve.control_points.push_back(point(i0 + (i1 - i0) / 3 * k, j0 + (j1 - j0) / 3 * k));
    return shell.add_edge(e);
  };
  std::size_t middle = Shell::null;
  for(int first : {0, 3})
  {
    Shell::Face face;
    face.surface.knots = {{knots, knots}};
    for(int j = 0; j <= 3; ++j)
      for(int i = 0; i <= 3; ++i)
        face.surface.control_points.push_back(point(first + i, j));
    face.patch = 0;
    face.is_extraordinary = false;
    face.crease = crease;
    face.loop.push_back({edge(first, 0, first + 3, 0), true});
    const std::size_t right = edge(first + 3, 0, first + 3, 3);
    face.loop.push_back({right, true});
    face.loop.push_back({edge(first + 3, 3, first, 3), true});
    if(first == 0)
      face.loop.push_back({edge(0, 3, 0, 0), true});
    else
      face.loop.push_back({middle, false});
    middle = right;
    shell.add_face(face);
  }
  return shell;
}

// n x n bicubic faces over the square, of the height `curvature * x * x / 2`, with the control
// point beside the lower left corner of each moved by `height`
Shell face_grid(int n, double height, double curvature = 0)
{
  typedef std::pair<int, int> Place; // of a control point
  Shell shell;
  const SMSC::Knot_vector<double> knots(3, {0, 1});
  const double step = SIZE / (3 * n);
  auto point = [=](const Place& p)
  {
    const int k = p.first % 3;
    const double a = step * (p.first - k), b = a + 3 * step; // ends of the face, if between them
    const double square
      = (k == 0) ? a * a : (k == 1) ? (a * a + 2 * a * b) / 3 : (2 * a * b + b * b) / 3;
    return Point_3(step * p.first, step * p.second, curvature / 2 * square);
  };
  std::map<Place, std::size_t> vertices;
  std::map<std::pair<Place, Place>, std::size_t> edges;
  for(int j = 0; j <= 3 * n; j += 3)
    for(int i = 0; i <= 3 * n; i += 3)
      vertices[{i, j}] = shell.add_vertex(point({i, j}));
  auto use = [&](const Place& from, const Place& to)
  {
    const auto reverse = edges.find({to, from});
    if(reverse != edges.end())
      return Shell::Oriented_edge{reverse->second, false};
    Shell::Edge e = {vertices[from], vertices[to], {knots, {}}};
    for(int k = 0; k <= 3; ++k)
      e.curve.control_points.push_back(point({from.first + (to.first - from.first) / 3 * k,
                                              from.second + (to.second - from.second) / 3 * k}));
    return Shell::Oriented_edge{edges[{from, to}] = shell.add_edge(e), true};
  };
  for(int j = 0; j < 3 * n; j += 3)
    for(int i = 0; i < 3 * n; i += 3)
    {
      Shell::Face face;
      face.surface.knots = {{knots, knots}};
      for(int b = 0; b <= 3; ++b)
        for(int a = 0; a <= 3; ++a)
          face.surface.control_points.push_back(
            point({i + a, j + b}) + K::Vector_3(0, 0, (a == 1 && b == 1) ? height : 0));
      face.patch = 0;
      face.is_extraordinary = false;
      const Place corners[] = {{i, j}, {i + 3, j}, {i + 3, j + 3}, {i, j + 3}};
      for(int k = 0; k < 4; ++k)
        face.loop.push_back(use(corners[k], corners[(k + 1) % 4]));
      shell.add_face(face);
    }
  return shell;
}

struct Measurement
{
  Mesh mesh = graph_mesh<Mesh>(SIZE, CELLS, [](double, double) { return 0; });
  Curve_traits traits;

  SMSC::Deviation<K> operator()(const Shell& shell, double tolerance = 1)
  {
    SMSC::Deviation<K> deviation;
    with_network([&](const Network& network)
    {
      SMSC::measure_deviation(shell, mesh, network, deviation,
                              CGAL::parameters::interior_tolerance(tolerance));
    });
    return deviation;
  }

  void with_network(const std::function<void(const Network&)>& use)
  {
    auto map = mesh.add_property_map<Mesh::Halfedge_index, SMSC::Curve_segment<Curve_traits> >(
      "h:curve").first;
    std::string message;
    const SMSC::Error_code code
      = SMSC::interpolate_boundary_curves(mesh, traits, map, message);
    assert(code == SMSC::Error_code::OK);
    const Network network(mesh, map, traits);
    assert(network.error() == SMSC::Error_code::OK && network.number_of_chains() == 4);
    use(network);
  }
};

bool is_close(double x, double expected, double error) { return std::abs(x - expected) <= error; }

// Above a valley of the mesh, which is a diagonal of the square, the deviation has a ridge that
// rises slowly to its top and falls fast to both sides.
void test_ridge()
{
  const double slope = 0.02, height = 0.1, bump = 0.005;
  Measurement valley;
  valley.mesh = graph_mesh<Mesh>(SIZE, 2, [slope](double x, double y)
    { return slope * std::abs(x - y); });
  const Shell shell = two_faces([=](int i, int j)
    { return i % 3 != 0 && j % 3 != 0 ? height + bump : height; });
  double largest = 0;
  for(int k = 0; k <= 100000; ++k)
  {
    const double v = k / 100000., u = v < 0.5 ? 2 * v : 2 * v - 1; // on the diagonal
    largest = (std::max)(largest, height + bump * 9 * u * (1 - u) * v * (1 - v));
  }
  largest /= std::sqrt(1 + 2 * slope * slope); // distance from both planes of the valley
  const SMSC::Deviation<K> d = valley(shell, 1.001 * largest);
  assert(d.interior_violations.empty() && is_close(d.interior_maximum, largest, 1e-5 * largest));
}

// The edges of a mesh lie on a parabolic cylinder, and the surface touches the middles of its
// facets from inside but for bumps. At the edges the deviation has ridges, which rise far above the
// samples on both sides; those of two of the faces have their tops between vertices of the mesh.
void test_ridges_between_samples()
{
  const double curvature = 0.01, width = SIZE / CELLS, sagitta = curvature * width * width / 8;
  Measurement facets;
  facets.mesh = graph_mesh<Mesh>(SIZE, CELLS, [=](double x, double)
    { return -sagitta + curvature * x * x / 2; });
  const double bump = 2.5 * sagitta;       // of the control point
  auto b1 = [](double t) { return 3 * t * (1 - t) * (1 - t); };
  const double u = (5.5 - SIZE / 2) * 6 / SIZE; // of such an edge; its vertices have 0.2 and 0.5
  const double at_vertices = b1(u) * b1(0.2), at_top = b1(u) * b1(1 / 3.);
  const double tolerance = sagitta + bump * (at_vertices + at_top) / 2;
  const SMSC::Deviation<K> d = facets(face_grid(6, bump, curvature), tolerance);
  for(double y : {SIZE * (1 + 1 / 3.) / 6, SIZE * (4 + 1 / 3.) / 6})
    assert(std::any_of(d.interior_violations.begin(), d.interior_violations.end(),
                       [=](const Point_3& p)
                       { return std::hypot(p.x() - 5.5, p.y() - y) < width / 2; }));
}

// A piece rounds a valley of the mesh, far from the vertices and the middles of the edges there. Its
// samples, which are beside the ridge of the deviation, are smaller than those of many other pieces.
void test_ridge_between_samples_of_piece()
{
  typedef SMSC::internal::Bezier_piece Piece;
  const double slope = 0.6, height = 0.04, curvature = 4, size = 0.4;
  const double largest = height / std::sqrt(1 + slope * slope), limit = 0.98 * largest;
  const Mesh valley = graph_mesh<Mesh>(SIZE, 2, [=](double x, double)
    { return slope * std::abs(x - SIZE / 2); });
  Measurement plane; // lends its boundary
  plane.mesh = graph_mesh<Mesh>(SIZE, 2, [](double, double) { return 0; });
  plane.with_network([&](const Network& network)
  {
    const double x = -size * 5 / 16; // between the samples, from the valley on
    Piece round = {{{2, 1}}, {}, 0};
    for(double y : {6., 6. + size})
      for(int i = 0; i <= 2; ++i)
        round.points.emplace_back(SIZE / 2 + x + i * size / 2, y, height + curvature / 2
                                  * (x + (i == 2 ? size : 0)) * (x + (i == 0 ? 0 : size)));
    std::vector<Piece> pieces(1, round);
    for(int k = 0; k < 30; ++k) // parallel to the mesh
    {
      Piece flat = {{{1, 1}}, {}, 0};
      for(int j : {0, 1})
        for(int i : {0, 1})
          flat.points.emplace_back(7 + i * size, 0.3 * (k + j),
                                   slope * (2 + i * size) + 0.7 * height);
      pieces.push_back(flat);
    }
    const SMSC::internal::Mesh_distance distance(plane.mesh, valley.points(), network);
    const SMSC::internal::Interior_deviation interior(pieces, distance, 0, limit, limit);
    assert(interior.violations().size() == 1);
    assert(is_close(interior.statistics().maximum, largest, 1e-3 * largest));
  });
}

// A surface that changes in one of its faces: what is taken from the measurement before gives the
// same as to measure everything.
void test_change()
{
  Measurement measure;
  measure.with_network([&](const Network& network)
  {
    typedef SMSC::internal::Deviation_meter<Mesh, Mesh::Property_map<Mesh::Vertex_index, Point_3>,
                                            Network> Meter;
    const double limit = 0.05;
    const auto bumps = [](double left, double right)
    {
      return two_faces([=](int i, int j)
        { return j % 3 == 0 ? 0 : i == 1 ? left : i == 5 ? right : 0; });
    };
    Meter meter(measure.mesh, measure.mesh.points(), network, 0, limit, limit);
    for(const auto& shell : {bumps(0.3, 0.1), bumps(0.3, 0.2), bumps(0, 0.2), bumps(0, 0.2)})
    {
      Meter other(measure.mesh, measure.mesh.points(), network, 0, limit, limit);
      const auto d = meter(shell, SMSC::internal::bezier_pieces(shell));
      const auto e = other(shell, SMSC::internal::bezier_pieces(shell));
      assert(d.interior_maximum == e.interior_maximum && d.interior_mean == e.interior_mean);
      assert(d.fraction_within == e.fraction_within && d.interior_worst == e.interior_worst);
      assert(d.interior_violations == e.interior_violations && !d.interior_violations.empty());
    }
  });
}

// The samples of a tiny piece are closer to the centre of a facet than those of the piece that it
// lies on.
void test_uneven_pieces()
{
  typedef SMSC::internal::Bezier_piece Piece;
  Measurement measure;
  measure.with_network([&](const Network& network)
  {
    const double limit = 0.03, width = SIZE / CELLS; // of a cell of the mesh
    const auto square = [](double x, double y, double size)
    {
      Piece piece = {{{1, 1}}, {}, 0};
      for(int j : {0, 1})
        for(int i : {0, 1})
          piece.points.emplace_back(x + i * size, y + j * size, 0);
      return piece;
    };
    const std::vector<Piece> pieces
      = {square(0, 0, SIZE), square(10 * width + width / 3 + limit, 10 * width + 0.66 * width, 1e-3)};
    const SMSC::internal::Mesh_distance distance(measure.mesh, measure.mesh.points(), network);
    SMSC::internal::Interior_deviation interior(pieces, distance, 0, limit, limit);
    interior.add_mesh(measure.mesh, measure.mesh.points());
    assert(interior.statistics().maximum < 1e-12);
  });
}

// On one side of a narrow strip the edges of the mesh are so short that samples of its curve hide
// those of the other side, which is one edge.
void test_uneven_boundary()
{
  constexpr int EDGES = 200;
  constexpr double WIDTH = SIZE / 100;
  Measurement strip;
  strip.mesh.clear();
  std::vector<Mesh::Vertex_index> v;
  for(double x : {0., SIZE})
    v.push_back(strip.mesh.add_vertex(Point_3(x, 0, 0)));
  for(int k = EDGES; k >= 0; --k)
    v.push_back(strip.mesh.add_vertex(Point_3(SIZE * k / EDGES, WIDTH, 0)));
  for(std::size_t i = 1; i + 1 < v.size(); ++i)
    strip.mesh.add_face(v[0], v[i], v[i + 1]);
  const SMSC::Deviation<K> d = strip(two_faces([](int, int) { return 0; }, WIDTH));
  assert(d.boundary_maximum < 1e-12);
}

int main()
{
  Measurement measure;
  const double rounding = 1e-12;

  // nothing moved
  SMSC::Deviation<K> d = measure(two_faces([](int, int) { return 0; }));
  assert(d.boundary_maximum < rounding && d.corner_maximum < rounding);
  assert(d.interior_maximum < rounding && d.normal_angle_maximum < 1e-10);
  assert(d.normal_violations.empty() && d.folds.empty());
  assert(d.fraction_within == 1 && d.faces_against_mesh == 0 && d.interior_violations.empty());

  // moved as a whole: everything deviates by that much, and nothing is within less
  d = measure(two_faces([](int, int) { return 0.01; }), 0.009);
  assert(is_close(d.boundary_maximum, 0.01, rounding) && is_close(d.boundary_mean, 0.01, rounding));
  assert(is_close(d.corner_maximum, 0.01, rounding));
  assert(is_close(d.interior_maximum, 0.01, rounding) && is_close(d.interior_mean, 0.01, rounding));
  assert(d.fraction_within == 0 && d.interior_violations.size() == 2); // one a face

  // a bump off the grid of samples: the maximum of B_1 B_1 is (4/9)^2 at (1/3,1/3)
  d = measure(two_faces([](int i, int j) { return (i == 1 && j == 1) ? 0.3 : 0; }), 0.01);
  assert(d.boundary_maximum < rounding);
  assert(is_close(d.interior_maximum, 0.3 * 16 / 81, 1e-8));
  assert(is_close(d.interior_worst.x(), SIZE / 6, 0.01) && is_close(d.interior_worst.y(), SIZE / 3, 0.01));
  assert(0.5 < d.fraction_within && d.fraction_within < 0.95);
  assert(d.interior_violations.size() == 1 && d.interior_violations[0] == d.interior_worst);

  // the same bump on many faces: each of them is found, though no sample on the grid of eighths
  // exceeds the bound; the largest one is at (3/8,3/8)
  d = measure(face_grid(6, 0.3), 0.3 * 0.195);
  assert(std::pow(3 * 3. / 8 * std::pow(5. / 8, 2), 2) < 0.194);
  assert(d.interior_violations.size() == 36 && is_close(d.interior_maximum, 0.3 * 16 / 81, 1e-8));

  // the boundary curve bulges: its largest distance is 0.2 * 3 * (1/3) (2/3)^2 at 1/3 of the edge
  d = measure(two_faces([](int i, int j) { return (i == 1 && j == 0) ? 0.2 : 0; }));
  assert(is_close(d.boundary_maximum, 0.2 * 4 / 9, 1e-3 * 0.2));
  assert(is_close(d.boundary_worst.x(), SIZE / 6, 0.1) && d.corner_maximum < rounding);
  assert(is_close(d.worst_arc_length, SIZE / 6, 0.1));

  // a fold along the common edge, whose slope changes by 2 a: angle 2 atan a
  const double a = 0.05;
  d = measure(two_faces([a](int i, int) { return a * SIZE / 6 * std::abs(i - 3); }));
  assert(is_close(d.normal_angle_maximum, 2 * std::atan(a) * 180 / CGAL_PI, 1e-9));
  assert(is_close(d.normal_angle_worst.x(), SIZE / 2, rounding));
  assert(d.normal_violations.size() == 1 && d.normal_violations[0] == d.normal_angle_worst);
  assert(d.crease_angle_maximum == 0);

  // the same on a line above a corner
  d = measure(two_faces([a](int i, int) { return a * SIZE / 6 * std::abs(i - 3); }, SIZE, 0));
  assert(is_close(d.crease_angle_maximum, 2 * std::atan(a) * 180 / CGAL_PI, 1e-9));
  assert(d.normal_angle_maximum == 0 && is_close(d.normal_angle_worst.x(), SIZE / 2, rounding));
  assert(d.normal_violations.size() == 1 && d.normal_violations[0] == d.normal_angle_worst);

  // a vertex of the mesh pulled out: only seen from the mesh
  Measurement spiky;
  spiky.mesh.point(Mesh::Vertex_index((CELLS + 1) * CELLS / 2 + CELLS / 2)) = Point_3(5, 5, 0.7);
  d = spiky(two_faces([](int, int) { return 0; }));
  assert(is_close(d.interior_maximum, 0.7, 1e-9) && d.interior_violations.empty());
  d = spiky(two_faces([](int, int) { return 0; }), 0.6);
  assert(d.interior_violations.size() == 1 && d.interior_violations[0] == Point_3(5, 5, 0.7));

  // a mesh that looks the other way
  Measurement flipped;
  CGAL::Surface_mesh<Point_3> mesh;
  for(auto v : flipped.mesh.vertices())
    mesh.add_vertex(flipped.mesh.point(v));
  for(auto f : flipped.mesh.faces())
  {
    std::vector<Mesh::Vertex_index> v;
    for(auto w : flipped.mesh.vertices_around_face(flipped.mesh.halfedge(f)))
      v.insert(v.begin(), w);
    mesh.add_face(v);
  }
  flipped.mesh = mesh;
  d = flipped(two_faces([](int, int) { return 0; }));
  assert(d.faces_against_mesh == 2 && d.interior_maximum < rounding);
  assert(d.folds.size() == 2);
  for(std::size_t i = 0; i < 2; ++i) // the middle of each face
    assert(CGAL::squared_distance(d.folds[i], Point_3(SIZE * (1 + 2. * double(i)) / 4, SIZE / 2, 0))
           < rounding);
  test_ridge();
  test_ridges_between_samples();
  test_ridge_between_samples_of_piece();
  test_change();
  test_uneven_pieces();
  test_uneven_boundary();
  std::cout << "ok" << std::endl;
  return 0;
}
