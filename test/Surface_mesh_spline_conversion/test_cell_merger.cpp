// Merging of the pieces of a surface: on small grids with gaps, all partitions into rectangles are
// tried, and their files measured; on large ones, the least number of rectangles is known.
#include <CGAL/Random.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/STEP.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_merger.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Shell_assembler.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;
using namespace SMSC::internal;
typedef CGAL::Simple_cartesian<double> K;

const double EQUALITY = 1e-11;

// A plane grid of quads of which some are missing. Quads have one cell, or four.
struct Grid
{
  int width, height;
  std::vector<std::size_t> quad;
  std::size_t number_of_quads = 0;
  Quad_neighbors neighbors;
  std::vector<Cell> cells;
  std::vector<std::vector<std::size_t> > cells_of_quad;

  Grid(int width, int height, const std::vector<char>& is_there,
       const std::vector<char>& is_quartered)
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
          add_cells(x, y, is_quartered[width * y + x] ? 2 : 1);
        }
  }

  std::size_t at(int x, int y) const
  {
    return (x < 0 || y < 0 || x >= width || y >= height) ? NO_INDEX : quad[width * y + x];
  }

private:
  void add_cells(int x, int y, int n)
  {
    cells_of_quad.emplace_back();
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
      {
        Cell cell;
        cell.quad = cell.patch = at(x, y);
        cell.rectangle.low = {{i * QUAD_TICKS / n, j * QUAD_TICKS / n}};
        cell.rectangle.high = {{(i + 1) * QUAD_TICKS / n, (j + 1) * QUAD_TICKS / n}};
        for(int k = 0; k < 16; ++k)
          cell.points[k] = Eigen::Vector3d(x + (i + (k % 4) / 3.) / n, y + (j + (k / 4) / 3.) / n, 0);
        cells_of_quad.back().push_back(cells.size());
        cells.push_back(cell);
      }
  }
};

std::size_t size_of_file(const Cell_complex& complex, const std::vector<Cell_rectangle>& faces)
{
  SMSC::NURBS_shell_3<K> shell;
  Shell_assembler<K>(complex, {}, {})(faces, {}, shell);
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
    std::vector<char> is_there, is_quartered;
    for(int i = 0; i < width * height; ++i)
    {
      is_there.push_back(random.get_int(0, 5) > 0);
      is_quartered.push_back(random.get_int(0, 4) == 0);
    }
    is_there[0] = true;
    const Grid grid(width, height, is_there, is_quartered);
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
  assert(sum / number_of_grids < 1.005 && largest < 1.03);
}

// of a square with n x n holes in rows and columns
std::size_t number_of_rectangles(int n, Merging merging)
{
  const int width = 2 * n + 1;
  std::vector<char> is_there(width * width, true);
  for(int y = 1; y < width; y += 2)
    for(int x = 1; x < width; x += 2)
      is_there[width * y + x] = false;
  const Grid grid(width, width, is_there, std::vector<char>(width * width, false));
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

int main()
{
  test_small_grids();
  test_sieves();
  return 0;
}
