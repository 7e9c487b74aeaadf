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
// fundamental group (the arcs outside of the tree and of a dual tree of the rectangles). As the
// rectangles are simply connected, these imply the lengths of all arcs.
class Integer_constraint_builder
{
public:
  Integer_constraint_builder(const Seamless_map& map, const Motorcycle_graph& graph,
                             const std::vector<int>& lengths)
    : m_map(map), m_t_mesh(graph), m_lengths(lengths)
  {}

  std::vector<Integer_constraint> build()
  {
    std::vector<Integer_constraint> constraints;
    grow_tree();
    for(int n = 0; n < static_cast<int>(m_t_mesh.nodes.size()); ++n)
      if(m_t_mesh.nodes[n].is_critical() && m_half_arc_to[n] >= 0)
        constraints.push_back(make_constraint(walk_from_anchor(n)));
    const std::vector<char> is_in_dual_tree = grow_dual_tree();
    for(int a = 0; a < static_cast<int>(m_t_mesh.arcs.size()); ++a)
      if(!is_in_tree(a) && !is_in_dual_tree[a])
        constraints.push_back(make_constraint(walk_around(a)));
    return constraints;
  }

private:
  // Grows a spanning tree from critical nodes, breadth first.
  void grow_tree()
  {
    const int n = static_cast<int>(m_t_mesh.nodes.size());
    m_half_arc_to.assign(n, -1);
    std::vector<char> is_reached(n, 0);
    std::vector<int> queue;
    for(int root = 0; root < n; ++root)
    {
      if(is_reached[root] || !m_t_mesh.nodes[root].is_critical())
        continue;
      queue.assign(1, root);
      is_reached[root] = 1;
      for(std::size_t i = 0; i < queue.size(); ++i)
        for(int h : m_t_mesh.nodes[queue[i]].slots)
          if(h >= 0 && !is_reached[m_t_mesh.target(h)])
          {
            is_reached[m_t_mesh.target(h)] = 1;
            m_half_arc_to[m_t_mesh.target(h)] = h;
            queue.push_back(m_t_mesh.target(h));
          }
    }
  }

  bool is_in_tree(int arc) const
  {
    return m_half_arc_to[m_t_mesh.target(2 * arc)] == 2 * arc
           || m_half_arc_to[m_t_mesh.source(2 * arc)] == 2 * arc + 1;
  }

  // the arcs crossed by a spanning tree of the rectangles that crosses no arc of the tree
  std::vector<char> grow_dual_tree() const
  {
    std::vector<char> is_crossed(m_t_mesh.arcs.size(), 0);
    std::vector<char> is_reached(m_t_mesh.rectangles.size(), 0);
    std::vector<int> queue;
    for(int root = 0; root < static_cast<int>(is_reached.size()); ++root)
    {
      if(is_reached[root])
        continue;
      queue.assign(1, root);
      is_reached[root] = 1;
      for(std::size_t i = 0; i < queue.size(); ++i)
        for(const std::vector<int>& side : m_t_mesh.rectangles[queue[i]].sides)
          for(int h : side)
          {
            const int neighbor = m_t_mesh.rectangle_of[h ^ 1];
            if(neighbor < 0 || is_reached[neighbor] || is_in_tree(h / 2))
              continue;
            is_reached[neighbor] = 1;
            is_crossed[h / 2] = 1;
            queue.push_back(neighbor);
          }
    }
    return is_crossed;
  }

  // the half-arcs in the tree that lead to `node` from the last critical node before it
  std::vector<int> walk_from_anchor(int node) const
  {
    std::vector<int> walk;
    do
    {
      const int h = m_half_arc_to[node];
      walk.push_back(h);
      node = m_t_mesh.source(h);
    }
    while(!m_t_mesh.nodes[node].is_critical());
    std::reverse(walk.begin(), walk.end());
    return walk;
  }

  // from the critical node before the source of an arc through the arc to that before its target
  std::vector<int> walk_around(int arc) const
  {
    const std::array<int, 2>& node = m_t_mesh.arcs[arc].node;
    std::vector<int> walk;
    if(!m_t_mesh.nodes[node[0]].is_critical())
      walk = walk_from_anchor(node[0]);
    walk.push_back(2 * arc);
    if(!m_t_mesh.nodes[node[1]].is_critical())
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
    const int first_face = m_t_mesh.ray(walk.front()).face;
    const int last_face = m_t_mesh.ray(walk.back() ^ 1).face;
    constraint.from_corner
      = corner_of_vertex(m_map.mesh, first_face, vertex(m_t_mesh.source(walk.front())));
    constraint.to_corner
      = corner_of_vertex(m_map.mesh, last_face, vertex(m_t_mesh.target(walk.back())));
    std::array<std::int64_t, 2> difference = {{0, 0}};
    int rotation = 0; // from the first chart to the present one
    for(int h : walk)
    {
      const Motorcycle_graph::Arc& arc = m_t_mesh.arcs[h / 2];
      const Fixed_point_2 axis = axis_vector(m_t_mesh.ray(h).direction - rotation);
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

  int vertex(int node) const { return m_t_mesh.nodes[node].vertex; }

  const Seamless_map& m_map;
  const Motorcycle_graph& m_t_mesh;
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
