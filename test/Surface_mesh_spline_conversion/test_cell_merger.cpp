// Merging of the pieces of a surface: on grids with gaps, all partitions into rectangles are tried,
// and their files measured.
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

const int WIDTH = 4, HEIGHT = 3;

// A plane grid of quads of which some are missing. Quads have one cell, or four.
struct Grid
{
  std::vector<std::size_t> quad = std::vector<std::size_t>(WIDTH * HEIGHT, NO_INDEX);
  std::size_t number_of_quads = 0;
  Quad_neighbors neighbors;
  std::vector<Cell> cells;
  std::vector<std::vector<std::size_t> > cells_of_quad;

  Grid(const std::vector<char>& is_there, const std::vector<char>& is_quartered)
  {
    for(int i = 0; i < WIDTH * HEIGHT; ++i)
      if(is_there[i])
        quad[i] = number_of_quads++;
    for(int y = 0; y < HEIGHT; ++y)
      for(int x = 0; x < WIDTH; ++x)
        if(at(x, y) != NO_INDEX)
        {
          neighbors.push_back({{{at(x, y - 1), 2}, {at(x + 1, y), 3}, {at(x, y + 1), 0},
                                {at(x - 1, y), 1}}});
          add_cells(x, y, is_quartered[WIDTH * y + x] ? 2 : 1);
        }
  }

  std::size_t at(int x, int y) const
  {
    return (x < 0 || y < 0 || x >= WIDTH || y >= HEIGHT) ? NO_INDEX : quad[WIDTH * y + x];
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
      if(grid.at(x, y) == NO_INDEX || is_used[WIDTH * y + x])
        return false;
  return true;
}

// the smallest file of all partitions that continue the given faces; every partition is found once,
// as the first free quad is the lower left one of its rectangle
std::size_t smallest_file(const Grid& grid, const Cell_complex& complex, std::vector<char>& is_used,
                          std::vector<Cell_rectangle>& faces)
{
  int first = 0;
  while(first < WIDTH * HEIGHT && (is_used[first] || grid.quad[first] == NO_INDEX))
    ++first;
  if(first == WIDTH * HEIGHT)
    return size_of_file(complex, faces);
  std::size_t best = (std::numeric_limits<std::size_t>::max)();
  const int x0 = first % WIDTH, y0 = first / WIDTH;
  for(int y1 = y0 + 1; y1 <= HEIGHT; ++y1)
    for(int x1 = x0 + 1; x1 <= WIDTH && is_free(grid, is_used, x0, y0, x1, y1); ++x1)
    {
      auto mark = [&](char value)
      {
        for(int y = y0; y < y1; ++y)
          std::fill_n(is_used.begin() + WIDTH * y + x0, x1 - x0, value);
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

int main()
{
  const int number_of_grids = 30;
  const double equality = 1e-11;
  CGAL::Random random(1);
  double largest = 0, sum = 0;
  for(int g = 0; g < number_of_grids; ++g)
  {
    std::vector<char> is_there, is_quartered;
    for(int i = 0; i < WIDTH * HEIGHT; ++i)
    {
      is_there.push_back(random.get_int(0, 5) > 0);
      is_quartered.push_back(random.get_int(0, 4) == 0);
    }
    is_there[0] = true;
    const Grid grid(is_there, is_quartered);
    const Cell_complex complex(grid.cells, grid.neighbors);
    const std::vector<Cell_rectangle> faces = Cell_merger(complex, equality)(true);
    check_partition(complex, faces);
    assert(Cell_merger(complex, equality)(false).size() == grid.cells.size());
    std::vector<char> is_used(WIDTH * HEIGHT, false);
    std::vector<Cell_rectangle> none;
    const double ratio = double(size_of_file(complex, faces))
                       / double(smallest_file(grid, complex, is_used, none));
    largest = (std::max)(largest, ratio);
    sum += ratio;
  }
  assert(sum / number_of_grids < 1.03 && largest < 1.2);
  return 0;
}
