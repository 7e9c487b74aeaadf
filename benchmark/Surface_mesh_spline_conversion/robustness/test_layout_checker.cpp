// The checker of layouts accepts a valid layout, and finds each of its mutations. The bounds of the
// number of quads are those of layouts that are known.

#include "Layout_bound.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace {

const std::size_t n = 4; // quads per side of the square

struct Square
{
  Check::Triangle_mesh mesh;
  Check::Boundary_chains chains;
  Check::Quad_mesh layout;
};

std::size_t vertex(std::size_t i, std::size_t j) { return j * (n + 1) + i; }

// the unit square, with one chain around it that begins at the corner (0,0), the only corner that
// is declared
Check::Point point_on_chain(double s)
{
  const double side = std::floor(s), t = s - side;
  switch(int(side) & 3)
  {
    case 0: return {{t, 0, 0}};
    case 1: return {{1, t, 0}};
    case 2: return {{1 - t, 1, 0}};
    default: return {{0, 1 - t, 0}};
  }
}

// location in the square divided into two triangles along its diagonal
Check::Quad_mesh::Location locate(double x, double y)
{
  const std::size_t face = x >= y ? 0 : 1; // (0,0) (1,0) (1,1) and (0,0) (1,1) (0,1)
  const Check::Point barycentric = face == 0 ? Check::Point{{1 - x, x - y, y}}
                                             : Check::Point{{1 - y, x, y - x}};
  return {face, barycentric, {{x, y, 0}}};
}

Square make_square()
{
  Square square;
  square.mesh.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}};
  square.mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  square.mesh.diameter = std::sqrt(2.);
  square.mesh.corners = {0, 1, 2, 3};
  square.chains.lengths = {1, 1, 1, 1};
  square.chains.is_closed = {false, false, false, false};
  square.chains.distances = {0, 0, 0, 0};
  square.chains.point = [](std::size_t chain, double s)
  { return point_on_chain(double(chain) + s * (1 - 1e-16)); };
  Check::Quad_mesh& layout = square.layout;
  for(std::size_t j = 0; j <= n; ++j)
    for(std::size_t i = 0; i <= n; ++i)
    {
      layout.points.push_back({{double(i) / n, double(j) / n, 0}});
      layout.is_corner.push_back(i % n == 0 && j % n == 0);
    }
  const std::size_t null = Check::Quad_mesh::null;
  for(std::size_t j = 0; j < n; ++j)
    for(std::size_t i = 0; i < n; ++i)
    {
      const std::size_t q = j * n + i;
      layout.quads.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                               vertex(i, j + 1)}});
      layout.neighbors.push_back({{{j > 0 ? q - n : null, j > 0 ? 2 : 0},
                                   {i + 1 < n ? q + 1 : null, i + 1 < n ? 3 : 0},
                                   {j + 1 < n ? q + n : null, 0},
                                   {i > 0 ? q - 1 : null, i > 0 ? 1 : 0}}});
      const double h = 1. / n, x = double(i) * h, y = double(j) * h;
      layout.pieces.push_back({{{0, x, x + h}, {1, y, y + h}, {2, 1 - x - h, 1 - x},
                                {3, 1 - y - h, 1 - y}}});
    }
  layout.inverse_map = [](std::size_t q, double u, double v)
  { return locate((double(q % n) + u) / n, (double(q / n) + v) / n); };
  return square;
}

// glues quad `q` along its side `i` to nothing
void cut(Check::Quad_mesh& layout, std::size_t q, int i)
{
  const Check::Quad_mesh::Side other = layout.neighbors[q][i];
  layout.neighbors[other.first][other.second].first = Check::Quad_mesh::null;
  layout.neighbors[q][i].first = Check::Quad_mesh::null;
}

struct Mutation
{
  std::string property; // the defect that has to be found
  std::function<void(Square&)> apply;
};

// replaces the inverse map by `change(q, u, v)` of (x, y) of the square
void change_map(Square& square, const std::function<void(double&, double&)>& change)
{
  square.layout.inverse_map = [change](std::size_t q, double u, double v)
  {
    double x = (double(q % n) + u) / n, y = (double(q / n) + v) / n;
    change(x, y);
    return locate(x, y);
  };
}

// makes the mesh a square ring
void punch_hole(Square& square)
{
  square.mesh.triangles.clear();
  for(std::size_t i = 0; i < 4; ++i)
  {
    const Check::Point corner = square.mesh.points[i];
    square.mesh.points.push_back({{0.4 + 0.2 * corner[0], 0.4 + 0.2 * corner[1], 0}});
    const std::size_t next = (i + 1) % 4;
    square.mesh.triangles.push_back({{i, next, 4 + next}});
    square.mesh.triangles.push_back({{i, 4 + next, 4 + i}});
  }
}

const std::size_t inner = vertex(2, 2), boundary = vertex(2, 0);

std::vector<Mutation> mutations()
{
  typedef Check::Quad_mesh::Side Side;
  return {
    {"no quads", [](Square& s) { s.layout.quads.clear(); }},
    {"vertex out of range", [](Square& s) { s.layout.quads[5][2] = 1000; }},
    {"neighbour out of range", [](Square& s) { s.layout.neighbors[5][1] = Side(1000, 0); }},
    {"sides not paired", [](Square& s) { s.layout.neighbors[5][1] = Side(7, 3); }},
    {"sides not oriented", [](Square& s) { std::swap(s.layout.quads[5][0], s.layout.quads[5][1]); }},
    {"point not finite", [](Square& s) { s.layout.points[inner][1] = std::nan(""); }},
    {"vertex without quad", [](Square& s)
      {
        s.layout.points.push_back({{0.5, 0.5, 0}});
        s.layout.is_corner.push_back(false);
      }},
    {"several fans at a vertex", [](Square& s)
      {
        cut(s.layout, 5, 1);
        cut(s.layout, 5, 2);
        cut(s.layout, 10, 0);
        cut(s.layout, 10, 3);
      }},
    {"Euler characteristic", punch_hole}, {"number of loops", punch_hole},
    {"number of components", [](Square& s)
      {
        const std::size_t m = s.mesh.points.size();
        for(const double x : {5., 6., 7.})
          s.mesh.points.push_back({{x, x * x, 0}});
        s.mesh.triangles.push_back({{m, m + 1, m + 2}});
      }},
    {"valence on the boundary", [](Square& s) { s.layout.is_corner[0] = false; }},
    {"corner inside", [](Square& s) { s.layout.is_corner[inner] = true; }},
    {"number of corners", [](Square& s) { s.layout.is_corner[boundary] = true; }},
    {"corner without layout vertex", [](Square& s) { s.mesh.points[2][0] += 1e-9; }},
    {"boundary vertex off the boundary", [](Square& s) { s.layout.points[boundary][1] = 1e-9; }},
    {"boundary side without chain", [](Square& s) { s.layout.pieces[1][0].chain = 4; }},
    {"chain without side", [](Square& s)
      {
        for(auto& pieces : s.layout.pieces)
          for(auto& piece : pieces)
            piece.chain = piece.chain == 1 ? 0 : piece.chain;
      }},
    {"boundary piece not increasing", [](Square& s)
      { std::swap(s.layout.pieces[1][0].first, s.layout.pieces[1][0].last); }},
    {"boundary not covered once", [](Square& s) { s.layout.pieces[3][0].last = 0.9; }},
    {"order of boundary sides", [](Square& s)
      { std::swap(s.layout.pieces[1][0], s.layout.pieces[2][0]); }},
    {"boundary vertex at another place of its curve", [](Square& s)
      { s.layout.pieces[1][0].first = s.layout.pieces[0][0].last = 0.26; }},
    {"vertex off its image", [](Square& s) { s.layout.points[inner][0] += 1e-9; }},
    {"image without face", [](Square& s)
      {
        s.layout.inverse_map = [](std::size_t, double, double)
        { return Check::Quad_mesh::Location{2, {{1, 0, 0}}, {{0, 0, 0}}}; };
      }},
    {"image outside of its face", [](Square& s)
      { change_map(s, [](double& x, double&) { x *= 1.1; }); }},
    {"image off the mesh", [](Square& s)
      {
        const auto map = s.layout.inverse_map;
        s.layout.inverse_map = [map](std::size_t q, double u, double v)
        {
          Check::Quad_mesh::Location at = map(q, u, v);
          at.point[2] = 1e-3 * u * (1 - u);
          return at;
        };
      }},
    {"images of neighbours apart", [](Square& s)
      {
        const auto map = s.layout.inverse_map;
        s.layout.inverse_map = [map](std::size_t q, double u, double v)
        { return map(q, q == 5 ? u + 0.1 * u * (1 - u) * (1 - v) : u, v); };
      }},
    {"orientation of the image", [](Square& s)
      { change_map(s, [](double& x, double&) { x += 0.3 * std::sin(6.283185307179586 * x); }); }},
    {"area of the images", [](Square& s) { change_map(s, [](double& x, double&) { x *= 0.8; }); }}};
}

Check::Triangle_mesh mesh_of(std::size_t number_of_points,
                             std::vector<std::array<std::size_t, 3> > triangles)
{
  Check::Triangle_mesh mesh;
  for(std::size_t i = 0; i < number_of_points; ++i)
    mesh.points.push_back({{std::cos(double(i)), std::sin(double(i)), double(i)}});
  mesh.triangles = std::move(triangles);
  return mesh;
}

// a band of three pairs of triangles between two loops, or a torus if `n` bands are closed
std::vector<std::array<std::size_t, 3> > bands(std::size_t n, bool is_closed)
{
  std::vector<std::array<std::size_t, 3> > triangles;
  for(std::size_t j = 0; j < n; ++j)
    for(std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t next = is_closed ? (j + 1) % n : j + 1;
      const std::size_t a = 3 * j + i, b = 3 * j + (i + 1) % 3;
      const std::size_t c = 3 * next + (i + 1) % 3, d = 3 * next + i;
      triangles.push_back({{a, b, c}});
      triangles.push_back({{a, c, d}});
    }
  return triangles;
}

int check_bound(const char* name, const Check::Triangle_mesh& mesh, long expected,
                long expected_with_low_valences)
{
  Check::Layout_bound bound(mesh);
  const long any = bound.number_of_quads(), low = bound.number_of_quads_with_low_valences();
  const bool is_right = any == expected && low == expected_with_low_valences;
  if(!is_right)
    std::printf("bounds of %s: %ld and %ld instead of %ld and %ld\n", name, any, low, expected,
                expected_with_low_valences);
  return is_right ? 0 : 1;
}

// a rectangular plate with `n` holes, of unit squares of two triangles
Check::Triangle_mesh plate_with_holes(std::size_t n)
{
  const std::size_t width = 2 * n + 1, height = 3;
  const auto vertex = [&](std::size_t i, std::size_t j) { return j * (width + 1) + i; };
  Check::Triangle_mesh mesh;
  for(std::size_t j = 0; j <= height; ++j)
    for(std::size_t i = 0; i <= width; ++i)
      mesh.points.push_back({{double(i), double(j), 0}});
  for(std::size_t j = 0; j < height; ++j)
    for(std::size_t i = 0; i < width; ++i)
      if(j != 1 || i % 2 == 0)
      {
        mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)}});
        mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)}});
      }
  mesh.corners = {vertex(0, 0), vertex(width, 0), vertex(0, height), vertex(width, height)};
  return mesh;
}

// two tori, joined by a tube in place of a triangle of each
std::vector<std::array<std::size_t, 3> > double_torus()
{
  const auto torus = bands(3, true);
  std::vector<std::array<std::size_t, 3> > triangles(torus.begin() + 1, torus.end());
  const std::array<std::size_t, 3> hole = torus.front();
  for(std::size_t i = 1; i < torus.size(); ++i)
    triangles.push_back({{torus[i][0] + 9, torus[i][2] + 9, torus[i][1] + 9}}); // a mirror image
  for(std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t a = hole[i], b = hole[(i + 1) % 3];
    triangles.push_back({{a, b, b + 9}});
    triangles.push_back({{a, b + 9, a + 9}});
  }
  return triangles;
}

int check_bounds()
{
  int failures = 0;
  Check::Triangle_mesh square = make_square().mesh;
  failures += check_bound("a square", square, 1, 1);
  square.corners.clear();
  failures += check_bound("a disk", square, 5, 5); // one in the middle, one at each of four sides
  square.corners = {0, 2};
  failures += check_bound("a lens", square, 3, 3);
  const std::vector<std::array<std::size_t, 3> > tetrahedron
    = {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 1}}, {{1, 3, 2}}};
  failures += check_bound("a sphere", mesh_of(4, tetrahedron), 6, 6);
  failures += check_bound("a ring", mesh_of(6, bands(1, false)), 4, 4);
  failures += check_bound("a torus", mesh_of(9, bands(3, true)), 1, 1);
  // two spheres
  std::vector<std::array<std::size_t, 3> > two = tetrahedron;
  for(const auto& t : tetrahedron)
    two.push_back({{t[0] + 4, t[1] + 4, t[2] + 4}});
  failures += check_bound("two spheres", mesh_of(8, two), 12, 12);
  // Euler characteristic -1 and twelve sides; at least four vertices of valence 5
  failures += check_bound("a plate with two holes", plate_with_holes(2), 7, 11);
  // eight vertices of valence 5, or one of valence 12
  failures += check_bound("a double torus", mesh_of(18, double_torus()), 3, 10);
  return failures;
}

int check_valid(const char* name, const Square& square)
{
  int failures = 0;
  Check::Layout_checker checker(square.layout, square.mesh, square.chains);
  for(const Check::Defect& defect : checker.check())
  {
    std::printf("%s has the defect: %s (%s)\n", name, defect.property.c_str(),
                defect.place.c_str());
    ++failures;
  }
  return failures;
}

// Most of each quad goes to a narrow strip: few samples give a wrong area.
Square make_uneven_square()
{
  Square square = make_square();
  change_map(square, [](double& x, double&)
  {
    const double begin = std::floor(x * n);
    x = (begin + std::pow(x * n - begin, 8)) / n;
  });
  return square;
}

} // namespace

int main()
{
  int failures = check_bounds();
  failures += check_valid("the valid layout", make_square());
  failures += check_valid("the uneven layout", make_uneven_square());
  for(const Mutation& mutation : mutations())
  {
    Square mutant = make_square();
    mutation.apply(mutant);
    Check::Layout_checker mutant_checker(mutant.layout, mutant.mesh, mutant.chains);
    bool is_found = false;
    for(const Check::Defect& defect : mutant_checker.check())
      is_found = is_found || defect.property == mutation.property;
    if(!is_found)
    {
      std::printf("not found: %s\n", mutation.property.c_str());
      ++failures;
    }
  }
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
