// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_RECTANGLE_COMPOSITION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_RECTANGLE_COMPOSITION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Boundary_positions.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Triangle_locator.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Motorcycle_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// An increasing piecewise linear function on [0, n] with integer breakpoints.
class Monotone_function
{
public:
  void add(int argument, double value)
  {
    m_arguments.push_back(argument);
    m_values.push_back(value);
  }

  double operator()(double x) const
  {
    const auto above
      = std::upper_bound(m_arguments.begin() + 1, m_arguments.end() - 1, x,
                         [](double a, int b) { return a < b; });
    const std::size_t i = above - m_arguments.begin();
    const double ratio = (x - m_arguments[i - 1]) / (m_arguments[i] - m_arguments[i - 1]);
    return m_values[i - 1] + ratio * (m_values[i] - m_values[i - 1]);
  }

  // x -> value(n) - f(n - x): the function of the same side run through backwards
  Monotone_function reversed() const
  {
    Monotone_function f;
    for(std::size_t i = m_arguments.size(); i-- > 0;)
      f.add(m_arguments.back() - m_arguments[i], m_values.back() - m_values[i]);
    return f;
  }

  int size() const { return m_arguments.back(); }
  double length() const { return m_values.back(); }

private:
  std::vector<int> m_arguments;
  std::vector<double> m_values;
};

// Maps the integer rectangle [0, a] x [0, b] to a real one by two monotone shears: a homeomorphism
// that is piecewise linear on each side, as given by the functions of the sides.
struct Rectangle_shears
{
  Monotone_function bottom, right, top, left; // all from left to right or from bottom to top

  double x(double s, double t) const
  {
    const double ratio = t / left.size();
    return (1 - ratio) * bottom(s) + ratio * top(s);
  }

  double y(double x, double t) const
  {
    const double ratio = x / bottom.length();
    return (1 - ratio) * left(t) + ratio * right(t);
  }
};

// Builds the quads of a T-mesh with lengths of at least one: every rectangle becomes a grid of quads
// which its shears carry to the seamless map. No solver takes part, so this cannot fail.
class Rectangle_composition
{
public:
  // where a quad lies in its rectangle
  struct Quad_place
  {
    int rectangle;
    int i, j;
  };

  Rectangle_composition(const Seamless_map& map, const Motorcycle_graph& graph,
                        const std::vector<int>& lengths, const Boundary_positions& positions,
                        Quad_grid& quads, Triangle_locator& locator)
    : m_map(map), m_graph(graph), m_lengths(lengths), m_positions(positions), m_quads(quads),
      m_locator(locator), m_unit(std::ldexp(1., map.fractional_bits))
  {}

  // returns an empty string or what is wrong
  const char* build()
  {
    m_unit_sides.resize(m_graph.number_of_half_arcs());
    for(int r = 0; r < static_cast<int>(m_graph.rectangles.size()); ++r)
      if(!add_rectangle(r))
        return "a rectangle of the motorcycle graph cannot be developed";
    if(!link_across_arcs() || !m_quads.number_vertices())
      return "the quads of the rectangles do not meet side by side";
    if(!attach_vertices())
      return "two critical vertices share a vertex of the layout";
    return "";
  }

  const std::vector<Quad_place>& places() const { return m_places; }
  const std::vector<Rectangle_shears>& shears() const { return m_shears; }

private:
  typedef std::tuple<int, int, Fixed_point_2> Placement_key;

  static Placement_key key(const Placed_face& placed)
  {
    return Placement_key(placed.face, placed.rotation, placed.translation);
  }

  bool add_rectangle(int r)
  {
    const Motorcycle_graph::Rectangle& rectangle = m_graph.rectangles[r];
    Rectangle_shears shears;
    shears.bottom = side_function(rectangle.sides[0]);
    shears.right = side_function(rectangle.sides[1]);
    shears.top = side_function(rectangle.sides[2]).reversed();
    shears.left = side_function(rectangle.sides[3]).reversed();
    m_shears.push_back(shears);
    const int width = shears.bottom.size(), height = shears.left.size();
    std::vector<Placed_face> faces;
    if(width < 1 || height < 1 || width != shears.top.size() || height != shears.right.size()
       || !develop_rectangle(r, faces))
      return false;
    const int first = m_quads.number_of_quads();
    for(int j = 0; j < height; ++j)
      for(int i = 0; i < width; ++i)
        add_quad(r, i, j, faces);
    link_inside(first, width, height);
    collect_unit_sides(rectangle, first, width, height);
    return true;
  }

  Monotone_function side_function(const std::vector<int>& half_arcs) const
  {
    Monotone_function f;
    int argument = 0;
    std::int64_t value = 0;
    f.add(0, 0);
    for(int h : half_arcs)
    {
      argument += m_lengths[h / 2];
      value += m_graph.length(h);
      f.add(argument, static_cast<double>(value) / m_unit);
    }
    return f;
  }

  // Finds all faces that overlap the interior of a rectangle, in its chart.
  bool develop_rectangle(int r, std::vector<Placed_face>& faces) const
  {
    Chart_ray ray = m_graph.ray(m_graph.rectangles[r].sides[0].front());
    if(!move_to_face_on_the_left(m_map, ray))
      return false;
    const Fixed_point_2 turned = rotate(-ray.direction, ray.point);
    const Open_box box{{{0, 0}}, {{m_graph.side_length(r, 0), m_graph.side_length(r, 1)}}};
    faces.assign(1, Placed_face{ray.face, -ray.direction & 3, {{-turned[0], -turned[1]}}});
    std::set<Placement_key> found;
    found.insert(key(faces[0]));
    for(std::size_t i = 0; i < faces.size(); ++i)
      for(int h = 3 * faces[i].face; h < 3 * faces[i].face + 3; ++h)
      {
        const Placed_face placed = faces[i];
        if(!do_intersect(box, placed(m_map.coordinates[h]),
                         placed(m_map.coordinates[Working_mesh::next(h)])))
          continue;
        if(m_map.mesh.is_border(h))
          return false;
        const Placed_face next = placed.across(m_map, h);
        if(found.insert(key(next)).second)
          faces.push_back(next);
      }
    return true;
  }

  void add_quad(int r, int i, int j, const std::vector<Placed_face>& faces)
  {
    m_quads.add_quad();
    m_places.push_back(Quad_place{r, i, j});
    m_locator.begin_quad();
    const Open_box box = image_box(m_shears[r], i, j);
    for(const Placed_face& placed : faces)
    {
      std::array<Fixed_point_2, 3> triangle;
      for(int k = 0; k < 3; ++k)
        triangle[k] = placed(m_map.coordinates[3 * placed.face + k]);
      if(do_intersect(box, triangle))
        m_locator.add(m_map, placed, m_unit);
    }
  }

  // a box that contains the image of a quad under the shears, which are monotone; one unit of the
  // map larger to be safe from rounding
  Open_box image_box(const Rectangle_shears& shears, int i, int j) const
  {
    const double x0 = (std::min)(shears.x(i, j), shears.x(i, j + 1));
    const double x1 = (std::max)(shears.x(i + 1, j), shears.x(i + 1, j + 1));
    const double y0 = (std::min)(shears.y(x0, j), shears.y(x1, j));
    const double y1 = (std::max)(shears.y(x0, j + 1), shears.y(x1, j + 1));
    auto fixed = [this](double x) { return static_cast<std::int64_t>(std::floor(x * m_unit)); };
    return Open_box{{{fixed(x0) - 1, fixed(y0) - 1}}, {{fixed(x1) + 2, fixed(y1) + 2}}};
  }

  void link_inside(int first, int width, int height)
  {
    for(int j = 0; j < height; ++j)
      for(int i = 0; i < width; ++i)
      {
        const int q = first + j * width + i;
        if(i + 1 < width)
          m_quads.link(Quad_grid::Side(q, 1), Quad_grid::Side(q + 1, 3));
        if(j + 1 < height)
          m_quads.link(Quad_grid::Side(q, 2), Quad_grid::Side(q + width, 0));
      }
  }

  // Notes the sides of quads along the half-arcs of a rectangle.
  void collect_unit_sides(const Motorcycle_graph::Rectangle& rectangle, int first, int width, int height)
  {
    for(int side = 0; side < 4; ++side)
    {
      int position = 0;
      for(int h : rectangle.sides[side])
        for(int k = 0; k < m_lengths[h / 2]; ++k, ++position)
        {
          const int i = side == 0 ? position : side == 1 ? width - 1
                      : side == 2 ? width - 1 - position : 0;
          const int j = side == 0 ? 0 : side == 1 ? position
                      : side == 2 ? height - 1 : height - 1 - position;
          m_unit_sides[h].emplace_back(first + j * width + i, side);
        }
    }
  }

  bool link_across_arcs()
  {
    for(int a = 0; a < static_cast<int>(m_graph.arcs.size()); ++a)
    {
      const std::vector<Quad_grid::Side>& left = m_unit_sides[2 * a];
      const std::vector<Quad_grid::Side>& right = m_unit_sides[2 * a + 1];
      const int n = m_lengths[a];
      for(int k = 0; k < n; ++k)
        if(m_graph.arcs[a].is_on_boundary ? !m_quads.make_border(left[k])
                                           : !m_quads.link(left[k], right[n - 1 - k]))
          return false;
      if(m_graph.arcs[a].is_on_boundary && !set_border_pieces(a))
        return false;
    }
    return true;
  }

  bool set_border_pieces(int a)
  {
    const Chart_ray& start = m_graph.arcs[a].ray[0];
    const int h = border_halfedge(start);
    if(h < 0)
      return false;
    const Fixed_point_2 offset = minus(start.point, m_map.coordinates[h]);
    const std::int64_t sum = offset[0] + offset[1];
    const double begin = static_cast<double>(m_positions.position(h) + (sum < 0 ? -sum : sum));
    const double step = static_cast<double>(m_graph.arcs[a].length) / m_lengths[a];
    for(int k = 0; k < m_lengths[a]; ++k)
    {
      const Quad_grid::Side& side = m_unit_sides[2 * a][k];
      m_quads.borders[side.first][side.second]
        = m_positions.piece(m_positions.chain(h), begin + k * step, begin + (k + 1) * step);
    }
    return true;
  }

  // the border halfedge along which a boundary arc starts
  int border_halfedge(const Chart_ray& ray) const
  {
    for(int h = 3 * ray.face; h < 3 * ray.face + 3; ++h)
    {
      const Fixed_point_2& a = m_map.coordinates[h];
      const Fixed_point_2 e = minus(m_map.coordinates[Working_mesh::next(h)], a);
      const Fixed_point_2 d = axis_vector(ray.direction);
      if(m_map.mesh.is_border(h) && determinant(e, d) == 0
         && e[along_axis(ray.direction)] * d[along_axis(ray.direction)] > 0
         && determinant(e, minus(ray.point, a)) == 0)
        return h;
    }
    return -1;
  }

  // A half-arc starts at the source of its first unit side.
  bool attach_vertices()
  {
    for(int h = 0; h < m_graph.number_of_half_arcs(); ++h)
    {
      const int v = m_graph.nodes[m_graph.source(h)].vertex;
      if(v < 0 || m_unit_sides[h].empty())
        continue;
      const Quad_grid::Side& side = m_unit_sides[h].front();
      if(!m_quads.attach(side.first, side.second, v))
        return false;
    }
    return true;
  }

  const Seamless_map& m_map;
  const Motorcycle_graph& m_graph;
  const std::vector<int>& m_lengths;
  const Boundary_positions& m_positions;
  Quad_grid& m_quads;
  Triangle_locator& m_locator;
  double m_unit;
  std::vector<Rectangle_shears> m_shears;                   // per rectangle
  std::vector<Quad_place> m_places;                         // per quad
  std::vector<std::vector<Quad_grid::Side> > m_unit_sides;  // per half-arc
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_RECTANGLE_COMPOSITION_H
