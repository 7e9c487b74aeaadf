// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_QUANTIZATION_ORACLE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_QUANTIZATION_ORACLE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Motorcycle_graph.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Decides whether integer arc lengths >= 0 give a quad layout with the topology, the cones and the
// boundary loops of the T-mesh. It builds the quotient of the grid points on the arcs that the zero
// lengths imply and counts: no separation heuristic is needed to keep loops apart, handles open and
// corners distinct. Linear in the number of grid points on arcs.
class Quantization_oracle
{
public:
  explicit Quantization_oracle(const Motorcycle_graph& graph)
    : m_graph(graph), m_euler_characteristic(graph.euler_characteristic())
  {}

  bool operator()(const std::vector<int>& lengths)
  {
    number_points(lengths);
    for(std::size_t a = 0; a < lengths.size(); ++a)
      if(lengths[a] == 0)
        unite(m_graph.arcs[a].node[0], m_graph.arcs[a].node[1]);
    if(!collapse_rectangles(lengths))
      return false;
    count_quads(lengths);
    return has_right_vertices(lengths);
  }

  // those of the last decision, a measure of its work
  std::size_t number_of_points() const { return m_parent.size(); }

private:
  // a class of identified grid points
  struct Point_class
  {
    int angle = 0;              // quarter turns found
    int number_of_critical = 0;
    int critical_angle = 0;     // quarter turns of the critical node
    bool is_on_boundary = false;
  };

  void number_points(const std::vector<int>& lengths)
  {
    int n = static_cast<int>(m_graph.nodes.size());
    m_first_point.resize(lengths.size());
    for(std::size_t a = 0; a < lengths.size(); ++a)
    {
      m_first_point[a] = n;
      n += lengths[a] > 1 ? lengths[a] - 1 : 0;
    }
    m_parent.resize(n);
    for(int i = 0; i < n; ++i)
      m_parent[i] = i;
    m_classes.assign(n, Point_class());
  }

  int find(int i)
  {
    while(m_parent[i] != i)
      i = m_parent[i] = m_parent[m_parent[i]];
    return i;
  }

  void unite(int i, int j) { m_parent[find(i)] = find(j); }

  // the grid points on a side of a rectangle, both ends included
  void get_side_points(const std::vector<int>& half_arcs, const std::vector<int>& lengths,
                       std::vector<int>& points) const
  {
    points.assign(1, m_graph.source(half_arcs.front()));
    for(int h : half_arcs)
    {
      const int a = h / 2, n = lengths[a];
      for(int i = 1; i < n; ++i)
        points.push_back(m_first_point[a] + ((h & 1) ? n - 1 - i : i - 1));
      if(n > 0)
        points.push_back(m_graph.target(h));
    }
  }

  // identifies opposite sides of rectangles without width; `false` if opposite sides differ
  bool collapse_rectangles(const std::vector<int>& lengths)
  {
    for(const Motorcycle_graph::Rectangle& rectangle : m_graph.rectangles)
    {
      const std::array<std::vector<int>, 4>& sides = rectangle.sides;
      const std::array<int, 2> size
        = {{side_size(sides[0], lengths), side_size(sides[1], lengths)}};
      if(side_size(sides[2], lengths) != size[0] || side_size(sides[3], lengths) != size[1])
        return false;
      for(int direction = 0; direction < 2; ++direction)
        // the sides have no length if the other direction is to be collapsed as well
        if(size[1 - direction] == 0)
        {
          get_side_points(sides[direction], lengths, m_side[0]);
          get_side_points(sides[direction + 2], lengths, m_side[1]);
          for(int i = 0; i <= size[direction]; ++i)
            unite(m_side[0][i], m_side[1][size[direction] - i]);
        }
    }
    return true;
  }

  static int side_size(const std::vector<int>& half_arcs, const std::vector<int>& lengths)
  {
    int sum = 0;
    for(int h : half_arcs)
      sum += lengths[h / 2];
    return sum;
  }

  // adds the angles of the quads to the classes, and counts quads and inner grid points
  void count_quads(const std::vector<int>& lengths)
  {
    m_number_of_quads = 0;
    m_number_of_inner_points = 0;
    for(const Motorcycle_graph::Rectangle& rectangle : m_graph.rectangles)
    {
      const std::int64_t w = side_size(rectangle.sides[0], lengths);
      const std::int64_t h = side_size(rectangle.sides[1], lengths);
      if(w == 0 || h == 0)
        continue;
      m_number_of_quads += w * h;
      m_number_of_inner_points += (w - 1) * (h - 1);
      for(const std::vector<int>& side : rectangle.sides)
      {
        int angle = 1; // at the first point, the corner of the rectangle
        for(const int half_arc : side)
        {
          const int a = half_arc / 2;
          if(lengths[a] == 0)
            continue;
          m_classes[find(m_graph.source(half_arc))].angle += angle;
          angle = 2;
          for(int i = 1; i < lengths[a]; ++i)
            m_classes[find(m_first_point[a] + i - 1)].angle += angle;
        }
      }
    }
  }

  // one critical point at most in a class, the right angle in every class, the right topology
  bool has_right_vertices(const std::vector<int>& lengths)
  {
    std::int64_t number_of_border_sides = 0;
    for(std::size_t i = 0; i < m_graph.nodes.size(); ++i)
    {
      const Motorcycle_graph::Node& node = m_graph.nodes[i];
      Point_class& c = m_classes[find(static_cast<int>(i))];
      c.is_on_boundary = c.is_on_boundary || node.is_on_boundary;
      c.number_of_critical += node.is_critical() ? 1 : 0;
      if(node.is_critical())
        c.critical_angle = node.quarter_turns;
    }
    for(std::size_t a = 0; a < lengths.size(); ++a)
      if(m_graph.arcs[a].is_on_boundary)
      {
        number_of_border_sides += lengths[a];
        for(int i = 1; i < lengths[a]; ++i)
          m_classes[find(m_first_point[a] + i - 1)].is_on_boundary = true;
      }
    std::int64_t number_of_vertices = m_number_of_inner_points;
    for(std::size_t i = 0; i < m_parent.size(); ++i)
    {
      if(m_parent[i] != static_cast<int>(i))
        continue;
      const Point_class& c = m_classes[i];
      const int angle = c.number_of_critical ? c.critical_angle : (c.is_on_boundary ? 2 : 4);
      if(c.number_of_critical > 1 || c.angle != angle)
        return false;
      ++number_of_vertices;
    }
    const std::int64_t twice_number_of_edges = 4 * m_number_of_quads + number_of_border_sides;
    return 2 * number_of_vertices - twice_number_of_edges + 2 * m_number_of_quads
           == 2 * m_euler_characteristic;
  }

  const Motorcycle_graph& m_graph;
  std::int64_t m_euler_characteristic;
  std::int64_t m_number_of_quads = 0;
  std::int64_t m_number_of_inner_points = 0;
  std::vector<int> m_first_point;              // per arc: first point inside
  std::vector<int> m_parent;                   // union-find over the points
  std::vector<Point_class> m_classes;
  std::array<std::vector<int>, 2> m_side;      // scratch
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_QUANTIZATION_ORACLE_H
