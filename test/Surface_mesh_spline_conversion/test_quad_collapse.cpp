// Chords and quads of plane and closed layouts collapse to what is known: topology, corners,
// boundary are kept, valences are as expected, and the map from the new quads to those before is a
// homeomorphism.

#include <CGAL/Simple_cartesian.h>

#include "block_layouts.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Collapse_sequence.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Collapse_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_relaxation.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef SC::Quad_layout<K> Layout;
typedef SC::internal::Quad_grid Quad_grid;
typedef SC::internal::Collapse_pattern Collapse_pattern;
typedef SC::internal::Collapse_sequence Collapse_sequence;
typedef SC::internal::Collapse_step Collapse_step;
typedef SC::internal::Collapsed_quads Collapsed_quads;
typedef SC::internal::Quad_collapse Quad_collapse;
typedef std::function<Eigen::Vector3d(const Quad_grid::Place&)> Locate;

namespace {

struct Input
{
  Quad_grid quads;
  std::vector<char> is_corner;
  Locate point; // bilinear
};

Input make_input(const Layout& layout)
{
  Input input;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    input.quads.add_quad();
  for(int q = 0; q < input.quads.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
    {
      if(layout.is_border(q, i))
      {
        const auto& side = layout.boundary_side(q, i);
        input.quads.make_border(Quad_grid::Side(q, i));
        input.quads.borders[q][i].chain = side.chain;
        input.quads.borders[q][i].first = side.first;
        input.quads.borders[q][i].last = side.last;
        continue;
      }
      const auto side = layout.neighbor(q, i);
      input.quads.link(Quad_grid::Side(q, i),
                       Quad_grid::Side(static_cast<int>(side.first), side.second));
    }
  assert(input.quads.number_vertices());
  input.is_corner.assign(input.quads.number_of_vertices(), 0);
  std::vector<std::array<Eigen::Vector3d, 4> > corners(layout.number_of_quads());
  for(int q = 0; q < input.quads.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
    {
      const auto& p = layout.point(layout.vertex(q, i));
      corners[q][i] = Eigen::Vector3d(p.x(), p.y(), p.z());
      if(layout.is_corner(layout.vertex(q, i)))
        input.is_corner[input.quads.vertices[q][i]] = 1;
    }
  input.point = [corners](const Quad_grid::Place& at) -> Eigen::Vector3d
  {
    const auto& p = corners[at.quad];
    return (1 - at.v) * ((1 - at.u) * p[0] + at.u * p[1])
           + at.v * ((1 - at.u) * p[3] + at.u * p[2]);
  };
  return input;
}

Input make_input(const Blocks& blocks, int m)
{
  return make_input(block_layout<K>(blocks, m, [](double x, double y, double z)
    { return K::Point_3(x, y, z); }, [](const K::Point_3& p)
    { return p.z() == 0 && std::abs(p.x()) == 1 && std::abs(p.y()) == 1; }));
}

int number_of_corners(const Input& input, const Quad_grid& quads, const std::vector<int>& anchor)
{
  int n = 0;
  for(int v = 0; v < quads.number_of_vertices(); ++v)
    n += quads.is_border_vertex[v] && input.is_corner[anchor[v]] ? 1 : 0;
  return n;
}

// The pieces of each chain have the same total length, and the corners are left.
void check_boundary(const Input& input, const Collapsed_quads& collapsed)
{
  std::map<std::size_t, double> before, after;
  const auto add = [](const Quad_grid& quads, std::map<std::size_t, double>& lengths)
  {
    for(int q = 0; q < quads.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
        if(quads.is_border(q, i))
        {
          const Quad_grid::Border& border = quads.borders[q][i];
          lengths[border.chain] += border.last - border.first;
        }
  };
  add(input.quads, before);
  add(collapsed.quads, after);
  assert(before.size() == after.size());
  for(const auto& chain : before)
    assert(std::abs(after.at(chain.first) - chain.second) < 1e-12);
  int corners = 0;
  for(const char is_corner : input.is_corner)
    corners += is_corner;
  assert(number_of_corners(input, collapsed.quads, collapsed.anchor) == corners);
}

// In the plane: the map keeps the orientation and covers the area once, and neighbours agree.
void check_homeomorphism(const Quad_grid& quads, const Locate& point, double area)
{
  const int n = 12;
  double sum = 0;
  for(int q = 0; q < quads.number_of_quads(); ++q)
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
      {
        std::array<Eigen::Vector3d, 4> p;
        for(int k = 0; k < 4; ++k)
          p[k] = point({q, (i + (k == 1 || k == 2)) / double(n), (j + (k >= 2)) / double(n)});
        const double cell = (p[2] - p[0]).cross(p[3] - p[1])[2] / 2;
        sum += cell;
        const double u = (i + 0.43) / n, v = (j + 0.59) / n, step = 1e-7;
        const Eigen::Vector3d o = point({q, u, v});
        assert((point({q, u + step, v}) - o).cross(point({q, u, v + step}) - o)[2] > 0);
      }
  assert(std::abs(sum - area) < 1e-9 * area);
  for(int q = 0; q < quads.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
      for(double t : {0., 0.3, 0.5, 1.})
      {
        const Eigen::Vector3d p = point(SC::internal::place_on_side(q, i, t));
        const Quad_grid::Side next = quads.neighbors[q][i];
        if(next.first != Quad_grid::border)
          assert((p - point(SC::internal::place_on_side(next.first, next.second, 1 - t))).norm()
                 < 1e-9);
      }
}

Locate composed(const Input& input, const SC::internal::Collapse_map& map)
{
  return [&input, &map](const Quad_grid::Place& p) { return input.point(map(p)); };
}

// What is known after a collapse. `area`: of a layout in the plane, or 0
void check_collapse(const Input& input, const Quad_collapse& collapse,
                    const Collapse_pattern& pattern, const Collapsed_quads& collapsed, double area)
{
  assert(collapsed.quads.euler_characteristic() == input.quads.euler_characteristic());
  check_boundary(input, collapsed);
  const SC::internal::Collapse_map map(input.quads, collapse, pattern, collapsed, input.point);
  assert(map.is_valid());
  if(area == 0)
    return;
  check_homeomorphism(collapsed.quads, composed(input, map), area);
  const SC::internal::Quad_relaxation relaxation(collapsed.quads, composed(input, map));
  assert(relaxation.is_valid());
  check_homeomorphism(collapsed.quads, [&](const Quad_grid::Place& p)
    { return input.point(map(relaxation(p))); }, area);
}

// Collapses each chord alone.
void check_single_chords(const Input& input, double area)
{
  const Quad_collapse collapse(input.quads, input.is_corner);
  int collapsed_chords = 0;
  for(int q = 0; q < input.quads.number_of_quads(); ++q)
    for(int i = 0; i < 2; ++i)
    {
      Collapse_pattern pattern(input.quads);
      std::set<int> crossed;
      for(const Quad_grid::Side& side : pattern.chord(q, i))
        crossed.insert(side.first);
      if(*crossed.begin() < q)
        continue;
      pattern.apply(Collapse_step{Collapse_step::Kind::CHORD, q, i});
      const std::optional<Collapsed_quads> collapsed = collapse.collapse(pattern);
      if(!collapsed)
        continue;
      ++collapsed_chords;
      assert(collapsed->quads.number_of_quads()
             == input.quads.number_of_quads() - int(crossed.size()));
      check_collapse(input, collapse, pattern, *collapsed, area);
    }
  assert(collapsed_chords > 0);
}

std::multiset<int> valences_inside(const Quad_grid& quads)
{
  std::multiset<int> valences;
  for(int v = 0; v < quads.number_of_vertices(); ++v)
    if(!quads.is_border_vertex[v])
      valences.insert(quads.valence[v]);
  return valences;
}

// Collapses each quad alone: where all of its vertices are inside, two of them meet, and the others
// lose a quad each.
void check_single_quads(const Input& input, double area)
{
  const Quad_grid& quads = input.quads;
  const Quad_collapse collapse(quads, input.is_corner);
  int collapsed_quads = 0;
  for(int q = 0; q < quads.number_of_quads(); ++q)
    for(int i = 0; i < 2; ++i)
    {
      Collapse_pattern pattern(quads);
      pattern.apply(Collapse_step{Collapse_step::Kind::DIAGONAL, q, i});
      const std::optional<Collapsed_quads> collapsed = collapse.collapse(pattern);
      bool is_inside = true;
      std::array<int, 4> valence;
      for(int k = 0; k < 4; ++k)
      {
        is_inside = is_inside && !quads.is_border_vertex[quads.vertices[q][k]];
        valence[k] = quads.valence[quads.vertices[q][k]];
      }
      const int meeting = valence[i] + valence[i + 2] - 2;
      const int least = (std::min)(valence[i + 1], valence[(i + 3) & 3]) - 1;
      assert(bool(collapsed) == (is_inside && meeting <= 8 && least >= 3));
      if(!collapsed)
        continue;
      ++collapsed_quads;
      assert(collapsed->quads.number_of_quads() == quads.number_of_quads() - 1);
      std::multiset<int> valences = valences_inside(quads);
      for(const int n : valence)
        valences.erase(valences.find(n));
      valences.insert({meeting, valence[i + 1] - 1, valence[(i + 3) & 3] - 1});
      assert(valences == valences_inside(collapsed->quads));
      check_collapse(input, collapse, pattern, *collapsed, area);
    }
  assert(collapsed_quads > 0);
}

// Collapses chords and quads one after the other until few are left: the same is known.
void check_sequence(const Input& input, double enough, double area)
{
  const auto moves = Collapse_sequence(input.quads, input.is_corner, input.point,
                                       Collapse_sequence::Parts::CHORDS_AND_QUADS)
                       .find(enough, SC::internal::Work_budget());
  assert(!moves.empty() && moves.back().number_of_quads <= enough);
  const Quad_collapse collapse(input.quads, input.is_corner);
  Collapse_pattern pattern(input.quads);
  for(const Collapse_sequence::Move& move : moves)
  {
    for(const Collapse_step& step : move.steps)
      pattern.apply(step);
    const std::optional<Collapsed_quads> collapsed = collapse.collapse(pattern);
    assert(collapsed && collapsed->quads.number_of_quads() == move.number_of_quads);
    assert(collapsed->quads.euler_characteristic() == input.quads.euler_characteristic());
    check_boundary(input, *collapsed);
  }
  check_collapse(input, collapse, pattern, *collapse.collapse(pattern), area);
}

// what is left when as many chords, or chords and quads, as possible have collapsed
int least_number(const Input& input,
                 Collapse_sequence::Parts parts = Collapse_sequence::Parts::CHORDS)
{
  const auto moves = Collapse_sequence(input.quads, input.is_corner, input.point, parts)
                       .find(0, SC::internal::Work_budget());
  return moves.empty() ? input.quads.number_of_quads() : moves.back().number_of_quads;
}

// A torus of 13 quads, q beside q + 1 and below q + 5: each of its two chords crosses all of them,
// so that nothing would be left of it.
Input torus_without_chords()
{
  Input input;
  const int n = 13;
  for(int q = 0; q < n; ++q)
    input.quads.add_quad();
  for(int q = 0; q < n; ++q)
  {
    input.quads.link({q, 1}, {(q + 1) % n, 3});
    input.quads.link({q, 2}, {(q + 5) % n, 0});
  }
  assert(input.quads.number_vertices());
  input.is_corner.assign(input.quads.number_of_vertices(), 0);
  // the plane of unit squares has the periods (3,2) and (-2,3)
  input.point = [](const Quad_grid::Place& p)
  {
    const double x = p.quad + p.u;
    const double s = 2 * M_PI * (3 * x + 2 * p.v) / n, t = 2 * M_PI * (-2 * x + 3 * p.v) / n;
    return Eigen::Vector3d((3 + std::cos(s)) * std::cos(t), (3 + std::cos(s)) * std::sin(t),
                           std::sin(s));
  };
  return input;
}

} // namespace

int main()
{
  const Blocks square{{{{{-1, -1, 0}}, {{1, -1, 0}}, {{1, 1, 0}}, {{-1, 1, 0}}}}};
  check_single_chords(make_input(square, 4), 4);
  check_single_chords(make_input(ring_blocks(), 3), 4);
  for(int n : {3, 5, 6})
    check_single_chords(make_input(polygon_blocks(n), 3), n * std::sin(2 * M_PI / n) / 2);
  check_single_chords(make_input(cube_blocks(false), 3), 0);
  check_single_chords(make_input(tube_blocks(), 3), 0);
  assert(least_number(make_input(square, 4)) == 1);
  assert(least_number(make_input(cube_blocks(false), 3)) == 6);
  // four sides of each loop
  assert(least_number(make_input(tube_blocks(), 2)) == 4);
  // four sides of a square, and at least three quads around the vertices inside
  assert(least_number(make_input(polygon_blocks(3), 3)) == 3);
  for(int n : {3, 5, 6})
    check_single_quads(make_input(polygon_blocks(n), 3), n * std::sin(2 * M_PI / n) / 2);
  check_single_quads(make_input(square, 4), 4);
  check_single_quads(make_input(cube_blocks(false), 3), 0);
  check_sequence(make_input(polygon_blocks(5), 4), 25, 5 * std::sin(2 * M_PI / 5) / 2);
  check_sequence(make_input(ring_blocks(), 4), 20, 4);
  const Input torus = torus_without_chords();
  assert(least_number(torus) == 13);
  assert(least_number(torus, Collapse_sequence::Parts::CHORDS_AND_QUADS) < 13);
  check_sequence(torus, 12, 0);
}
