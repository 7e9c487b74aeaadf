// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_INTEGER_CONSTRAINTS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_INTEGER_CONSTRAINTS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Motorcycle_graph.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Turns integer arc lengths into equations for the re-solve of the map: one for every critical node
// but one per component, along a spanning tree of the T-mesh, and one for every generator of the
// fundamental group, by a second tree dual to the first one. As the rectangles are simply connected,
// these imply the lengths of all arcs.
class Integer_constraint_builder
{
public:
  Integer_constraint_builder(const Seamless_map& map, const Motorcycle_graph& graph,
                             const std::vector<int>& lengths)
    : m_map(map), m_graph(graph), m_lengths(lengths)
  {}

  std::vector<Integer_constraint> build()
  {
    std::vector<Integer_constraint> constraints;
    grow_tree();
    for(int n = 0; n < static_cast<int>(m_graph.nodes.size()); ++n)
      if(m_graph.nodes[n].is_critical() && m_half_arc_to[n] >= 0)
        constraints.push_back(make_constraint(walk_from_anchor(n)));
    const std::vector<char> is_implied = grow_dual_tree();
    for(int a = 0; a < static_cast<int>(m_graph.arcs.size()); ++a)
      if(!is_in_tree(a) && !is_implied[a])
        constraints.push_back(make_constraint(walk_around(a)));
    return constraints;
  }

private:
  // Grows a spanning tree from critical nodes, breadth first.
  void grow_tree()
  {
    const int n = static_cast<int>(m_graph.nodes.size());
    m_half_arc_to.assign(n, -1);
    std::vector<char> is_reached(n, 0);
    std::vector<int> queue;
    for(int root = 0; root < n; ++root)
    {
      if(is_reached[root] || !m_graph.nodes[root].is_critical())
        continue;
      queue.assign(1, root);
      is_reached[root] = 1;
      for(std::size_t i = 0; i < queue.size(); ++i)
        for(int h : m_graph.nodes[queue[i]].slots)
          if(h >= 0 && !is_reached[m_graph.target(h)])
          {
            is_reached[m_graph.target(h)] = 1;
            m_half_arc_to[m_graph.target(h)] = h;
            queue.push_back(m_graph.target(h));
          }
    }
  }

  bool is_in_tree(int arc) const
  {
    return m_half_arc_to[m_graph.target(2 * arc)] == 2 * arc
           || m_half_arc_to[m_graph.source(2 * arc)] == 2 * arc + 1;
  }

  // the half-arcs along each face: those around the rectangles, then those outside the boundary loops
  std::vector<std::vector<int> > half_arcs_of_faces() const
  {
    std::vector<std::vector<int> > faces;
    for(const Motorcycle_graph::Rectangle& rectangle : m_graph.rectangles)
    {
      faces.emplace_back();
      for(const std::vector<int>& side : rectangle.sides)
        faces.back().insert(faces.back().end(), side.begin(), side.end());
    }
    std::vector<char> is_visited(m_graph.arcs.size(), 0);
    for(int first = 0; first < static_cast<int>(m_graph.arcs.size()); ++first)
    {
      if(!m_graph.arcs[first].is_on_boundary || is_visited[first])
        continue;
      faces.emplace_back();
      for(int a = first; !is_visited[a]; a = m_graph.nodes[m_graph.target(2 * a)].slots[0] / 2)
      {
        is_visited[a] = 1;
        faces.back().push_back(2 * a + 1);
      }
    }
    return faces;
  }

  // The arcs whose lengths are implied: those crossed by a spanning tree of the faces that crosses
  // no arc of the first tree. It contains the outsides of the boundary loops, from one of which it
  // grows. These are no disks: ways around the other loops need an equation, so that the arcs by
  // which the tree enters them do not count.
  std::vector<char> grow_dual_tree() const
  {
    const std::vector<std::vector<int> > half_arcs = half_arcs_of_faces();
    std::vector<int> face_of(m_graph.number_of_half_arcs());
    for(std::size_t f = 0; f < half_arcs.size(); ++f)
      for(int h : half_arcs[f])
        face_of[h] = static_cast<int>(f);

    std::vector<char> is_implied(m_graph.arcs.size(), 0);
    std::vector<char> is_reached(half_arcs.size(), 0);
    std::vector<int> queue;
    for(std::size_t root = half_arcs.size(); root-- > 0;)
    {
      if(is_reached[root])
        continue;
      queue.assign(1, static_cast<int>(root));
      is_reached[root] = 1;
      for(std::size_t i = 0; i < queue.size(); ++i)
        for(int h : half_arcs[queue[i]])
        {
          const int neighbor = face_of[h ^ 1];
          if(is_reached[neighbor] || is_in_tree(h / 2))
            continue;
          is_reached[neighbor] = 1;
          is_implied[h / 2] = neighbor < static_cast<int>(m_graph.rectangles.size());
          queue.push_back(neighbor);
        }
    }
    return is_implied;
  }

  // the half-arcs in the tree that lead to `node` from the last critical node before it
  std::vector<int> walk_from_anchor(int node) const
  {
    std::vector<int> walk;
    do
    {
      const int h = m_half_arc_to[node];
      walk.push_back(h);
      node = m_graph.source(h);
    }
    while(!m_graph.nodes[node].is_critical());
    std::reverse(walk.begin(), walk.end());
    return walk;
  }

  // from the critical node before the source of an arc through the arc to that before its target
  std::vector<int> walk_around(int arc) const
  {
    const std::array<int, 2>& node = m_graph.arcs[arc].node;
    std::vector<int> walk;
    if(!m_graph.nodes[node[0]].is_critical())
      walk = walk_from_anchor(node[0]);
    walk.push_back(2 * arc);
    if(!m_graph.nodes[node[1]].is_critical())
    {
      const std::vector<int> back = walk_from_anchor(node[1]);
      for(auto it = back.rbegin(); it != back.rend(); ++it)
        walk.push_back(*it ^ 1);
    }
    return walk;
  }

  Integer_constraint make_constraint(const std::vector<int>& walk) const
  {
    Integer_constraint constraint;
    const int first_face = m_graph.ray(walk.front()).face;
    const int last_face = m_graph.ray(walk.back() ^ 1).face;
    constraint.from_corner
      = corner_of_vertex(m_map.mesh, first_face, vertex(m_graph.source(walk.front())));
    constraint.to_corner
      = corner_of_vertex(m_map.mesh, last_face, vertex(m_graph.target(walk.back())));
    std::array<std::int64_t, 2> difference = {{0, 0}};
    int rotation = 0; // from the first chart to the present one
    for(int h : walk)
    {
      const Motorcycle_graph::Arc& arc = m_graph.arcs[h / 2];
      const Fixed_point_2 axis = axis_vector(m_graph.ray(h).direction - rotation);
      for(int i = 0; i < 2; ++i)
        difference[i] += m_lengths[h / 2] * axis[i];
      const std::vector<int> path = h & 1 ? reversed_path(m_map, arc.path) : arc.path;
      for(int crossed : path)
        rotation = (rotation + m_map.rotation[crossed]) & 3;
      constraint.path.insert(constraint.path.end(), path.begin(), path.end());
    }
    constraint.difference = {{static_cast<int>(difference[0]), static_cast<int>(difference[1])}};
    return constraint;
  }

  int vertex(int node) const { return m_graph.nodes[node].vertex; }

  const Seamless_map& m_map;
  const Motorcycle_graph& m_graph;
  const std::vector<int>& m_lengths;
  std::vector<int> m_half_arc_to; // per node: the half-arc of the tree that leads to it, or -1
};

inline std::vector<Integer_constraint> integer_constraints(const Seamless_map& map,
                                                           const Motorcycle_graph& graph,
                                                           const std::vector<int>& lengths)
{
  return Integer_constraint_builder(map, graph, lengths).build();
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_INTEGER_CONSTRAINTS_H
