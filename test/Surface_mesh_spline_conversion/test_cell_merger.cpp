// Merging of the pieces of a surface: on small grids with gaps, all partitions into rectangles are
// tried, and their files measured; on large ones, the least number of rectangles is known. The
// knots of faces side by side are similarly dense, and further knots do not change a polynomial.
#include <CGAL/Random.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/STEP.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_merger.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Shell_assembler.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;
using namespace SMSC::internal;
typedef CGAL::Simple_cartesian<double> K;

const double EQUALITY = 1e-11;

// the numbers of cells along the axes of a quad
typedef std::array<int, 2> Parts;

// a plane grid of quads of which some are missing
struct Grid
{
  int width, height;
  std::vector<std::size_t> quad;
  std::size_t number_of_quads = 0;
  Quad_neighbors neighbors;
  std::vector<Cell> cells;
  std::vector<std::vector<std::size_t> > cells_of_quad;

  Grid(int width, int height, const std::vector<char>& is_there,
       const std::vector<Parts>& parts)
    : width(width), height(height), quad(width * height, NO_INDEX)
  {
    for(int i = 0; i < width * height; ++i)
      if(is_there[i])
        quad[i] = number_of_quads++;
    for(int y = 0; y < height; ++y)
      for(int x = 0; x < width; ++x)
        if(at(x, y) != NO_INDEX)
        {
          neighbors.push_back({{{at(x, y - 1), 2}, {at(x + 1, y), 3}, {at(x, y + 1), 0},
                                {at(x - 1, y), 1}}});
          add_cells(x, y, parts[width * y + x]);
        }
  }

  std::size_t at(int x, int y) const
  {
    return (x < 0 || y < 0 || x >= width || y >= height) ? NO_INDEX : quad[width * y + x];
  }

private:
  void add_cells(int x, int y, const Parts& n)
  {
    cells_of_quad.emplace_back();
    for(int j = 0; j < n[1]; ++j)
      for(int i = 0; i < n[0]; ++i)
      {
        Cell cell;
        cell.quad = cell.patch = at(x, y);
        cell.rectangle.low = {{i * QUAD_TICKS / n[0], j * QUAD_TICKS / n[1]}};
        cell.rectangle.high = {{(i + 1) * QUAD_TICKS / n[0], (j + 1) * QUAD_TICKS / n[1]}};
        Bicubic points;
        for(int k = 0; k < 16; ++k)
          points[k] = Eigen::Vector3d(x + (i + (k % 4) / 3.) / n[0],
                                      y + (j + (k / 4) / 3.) / n[1], 0);
        cell.points = std::make_shared<const Bicubic>(points);
        cells_of_quad.back().push_back(cells.size());
        cells.push_back(cell);
      }
  }
};

typedef SMSC::NURBS_shell_3<K> Shell;

Shell make_shell(const Cell_complex& complex, const std::vector<Cell_rectangle>& faces,
                 const std::vector<Face_breaks>& breaks)
{
  Shell shell;
  Shell_assembler<K>(complex, {}, {})(faces, breaks, {}, shell);
  return shell;
}

std::size_t size_of_file(const Cell_complex& complex, const std::vector<Cell_rectangle>& faces)
{
  const Shell shell = make_shell(complex, faces, cell_breaks(complex, faces));
  std::ostringstream os;
  CGAL::IO::write_STEP(os, shell);
  return os.str().size();
}

// the quads of [x0,x1) x [y0,y1) as one face, in the coordinates of the first
Cell_rectangle rectangle(const Grid& grid, int x0, int y0, int x1, int y1)
{
  Cell_rectangle face;
  face.bounds = {{{0, 0}}, {{(x1 - x0) * QUAD_TICKS, (y1 - y0) * QUAD_TICKS}}};
  for(int y = y0; y < y1; ++y)
    for(int x = x0; x < x1; ++x)
      for(std::size_t c : grid.cells_of_quad[grid.at(x, y)])
        face.cells.push_back({c, {0, {{(x - x0) * QUAD_TICKS, (y - y0) * QUAD_TICKS}}}});
  return face;
}

bool is_free(const Grid& grid, const std::vector<char>& is_used, int x0, int y0, int x1, int y1)
{
  for(int y = y0; y < y1; ++y)
    for(int x = x0; x < x1; ++x)
      if(grid.at(x, y) == NO_INDEX || is_used[grid.width * y + x])
        return false;
  return true;
}

// the smallest file of all partitions that continue the given faces; every partition is found once,
// as the first free quad is the lower left one of its rectangle
std::size_t smallest_file(const Grid& grid, const Cell_complex& complex, std::vector<char>& is_used,
                          std::vector<Cell_rectangle>& faces)
{
  const int number_of_quads = grid.width * grid.height;
  int first = 0;
  while(first < number_of_quads && (is_used[first] || grid.quad[first] == NO_INDEX))
    ++first;
  if(first == number_of_quads)
    return size_of_file(complex, faces);
  std::size_t best = (std::numeric_limits<std::size_t>::max)();
  const int x0 = first % grid.width, y0 = first / grid.width;
  for(int y1 = y0 + 1; y1 <= grid.height; ++y1)
    for(int x1 = x0 + 1; x1 <= grid.width && is_free(grid, is_used, x0, y0, x1, y1); ++x1)
    {
      auto mark = [&](char value)
      {
        for(int y = y0; y < y1; ++y)
          std::fill_n(is_used.begin() + grid.width * y + x0, x1 - x0, value);
      };
      mark(true);
      faces.push_back(rectangle(grid, x0, y0, x1, y1));
      best = (std::min)(best, smallest_file(grid, complex, is_used, faces));
      faces.pop_back();
      mark(false);
    }
  return best;
}

void check_partition(const Cell_complex& complex, const std::vector<Cell_rectangle>& faces)
{
  std::vector<int> uses(complex.cells().size(), 0);
  for(const Cell_rectangle& face : faces)
  {
    double sum = 0;
    for(const Placed_cell& placed : face.cells)
    {
      ++uses[placed.cell];
      const Tick_rectangle r = placed_rectangle(complex, placed);
      for(int axis = 0; axis < 2; ++axis)
        assert(r.low[axis] >= face.bounds.low[axis] && r.high[axis] <= face.bounds.high[axis]);
      sum += area(r);
    }
    assert(sum == area(face.bounds));
  }
  for(int n : uses)
    assert(n == 1);
}

// on all small grids together, the files are little larger than the smallest ones
void test_small_grids()
{
  const int width = 4, height = 3, number_of_grids = 30;
  CGAL::Random random(1);
  double largest = 0, sum = 0;
  for(int g = 0; g < number_of_grids; ++g)
  {
    std::vector<char> is_there;
    std::vector<Parts> parts;
    for(int i = 0; i < width * height; ++i)
    {
      is_there.push_back(random.get_int(0, 5) > 0);
      const int n = random.get_int(0, 4) == 0 ? 2 : 1;
      parts.push_back({{n, n}});
    }
    is_there[0] = true;
    const Grid grid(width, height, is_there, parts);
    const Cell_complex complex(grid.cells, grid.neighbors);
    const std::vector<Cell_rectangle> faces = Cell_merger(complex, EQUALITY)(Merging::BEST);
    check_partition(complex, faces);
    assert(Cell_merger(complex, EQUALITY)(Merging::NONE).size() == grid.cells.size());
    std::vector<char> is_used(width * height, false);
    std::vector<Cell_rectangle> none;
    const double ratio = double(size_of_file(complex, faces))
                       / double(smallest_file(grid, complex, is_used, none));
    largest = (std::max)(largest, ratio);
    sum += ratio;
  }
  assert(sum / number_of_grids < 1.002 && largest < 1.01);
}

// of a square with n x n holes in rows and columns
std::size_t number_of_rectangles(int n, Merging merging)
{
  const int width = 2 * n + 1;
  std::vector<char> is_there(width * width, true);
  for(int y = 1; y < width; y += 2)
    for(int x = 1; x < width; x += 2)
      is_there[width * y + x] = false;
  const Grid grid(width, width, is_there, std::vector<Parts>(width * width, {{1, 1}}));
  const Cell_complex complex(grid.cells, grid.neighbors);
  const std::vector<Cell_rectangle> faces = Cell_merger(complex, EQUALITY)(merging);
  check_partition(complex, faces);
  return faces.size();
}

// The sieve has 4 n^2 concave corners, each of which needs a cut; a cut between two corners serves
// both. Outside there are 4 (n - 1) of these, between any four holes two of four can be made. Cuts
// make as many rectangles as they are, less one for each hole, and one more: n^2 + 3.
void test_sieves()
{
  for(int n = 2; n < 7; ++n)
  {
    const std::size_t least = n * n + 3;
    assert(number_of_rectangles(n, Merging::BEST) == least);
    assert(number_of_rectangles(n, Merging::FAST) > least);
  }
}

// the places of the knots of a face of a plane grid, by axis
std::array<std::vector<double>, 2> knot_places(const Shell::Face& face)
{
  std::array<std::vector<double>, 2> result;
  for(int axis = 0; axis < 2; ++axis)
    for(double knot : face.surface.knots[axis].knots())
      result[axis].push_back(face.surface.control_points.front()[axis] + knot);
  return result;
}

// returns the largest ratio of the lengths of knot intervals side by side on two faces
double ratio_across_edges(const Shell& shell)
{
  double result = 1;
  for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
    for(std::size_t g = 0; g < shell.number_of_faces(); ++g)
      for(int axis = 0; axis < 2; ++axis)
      {
        const auto a = knot_places(shell.face(f)), b = knot_places(shell.face(g));
        if(a[1 - axis].back() != b[1 - axis].front())
          continue;
        for(std::size_t i = 0; i + 1 < a[axis].size(); ++i)
          for(std::size_t k = 0; k + 1 < b[axis].size(); ++k)
            if(a[axis][i] < b[axis][k + 1] && b[axis][k] < a[axis][i + 1])
            {
              const double ratio = (a[axis][i + 1] - a[axis][i]) / (b[axis][k + 1] - b[axis][k]);
              result = (std::max)({result, ratio, 1 / ratio});
            }
      }
  return result;
}

// two quads with short cells in the first row, which is a face of its own
void test_grading()
{
  const int width = 12, height = 4;
  std::vector<Parts> parts(width * height, {{1, 1}});
  parts[5] = parts[6] = {{32, 1}};
  const Grid grid(width, height, std::vector<char>(width * height, true), parts);
  const Cell_complex complex(grid.cells, grid.neighbors);
  const std::vector<Cell_rectangle> faces = {rectangle(grid, 0, 0, width, 1),
                                             rectangle(grid, 0, 1, 6, height),
                                             rectangle(grid, 6, 1, width, height)};
  const Shell coarse = make_shell(complex, faces, cell_breaks(complex, faces));
  const Shell graded = make_shell(complex, faces, Break_grading(complex, faces)());
  assert(ratio_across_edges(coarse) == 32);
  assert(ratio_across_edges(graded) == 4);
  for(std::size_t f = 0; f < faces.size(); ++f)
    for(double u : {0., 0.3, 0.6, 1.})
      for(double v : {0., 0.4, 0.9})
        assert(CGAL::squared_distance(coarse.face(f).surface.point(u, v),
                                      graded.face(f).surface.point(u, v))
               < 1e-24);
}

// the B-spline with further knots against the polynomial
void test_knot_insertion()
{
  constexpr int degree = 5;
  const std::vector<double> breaks = {0, 0.25, 1, 1.5, 2};
  const Eigen::VectorXd bezier_points = Eigen::VectorXd::LinSpaced(degree + 1, 3, 8).array().sin();
  const Eigen::VectorXd control_points = knot_insertion(degree, breaks) * bezier_points;
  const SMSC::Knot_vector<double> knots(degree, breaks);
  assert(std::size_t(control_points.size()) == knots.number_of_functions());
  for(double t : {0., 0.1, 0.25, 0.7, 1.2, 1.9, 2.})
  {
    SMSC::Knot_vector<double>::Basis basis;
    const std::size_t span = knots.find_span(t);
    knots.evaluate(span, t, 0, basis);
    const Bezier_piece::Bernstein bernstein = Bezier_piece::bernstein(degree, t / breaks.back());
    double difference = 0;
    for(int i = 0; i <= degree; ++i)
      difference += basis[0][i] * control_points[Eigen::Index(span) - degree + i]
                  - bernstein[i] * bezier_points[i];
    assert(std::abs(difference) < 1e-14);
  }
}

int main()
{
  test_small_grids();
  test_sieves();
  test_grading();
  test_knot_insertion();
  return 0;
}
