// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MOTORCYCLE_GRAPH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MOTORCYCLE_GRAPH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/chart_navigation.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The motorcycle graph of a seamless map: a partition of the surface into rectangles of the
// parameter plane that meet in T-junctions. Half-arc `2 * a` runs along arc `a`, `2 * a + 1` against
// it; the rectangle of a half-arc lies on its left.
struct Motorcycle_graph
{
  // Slots are the quarter turns at a node, counter clockwise, with the outgoing half-arcs. A node at
  // a vertex inside has as many as the cone has quarter turns; on the boundary there is one more, the
  // first slot holding the outgoing, the last the incoming boundary arc. A node where isolines meet
  // has four slots, one of which may be empty.
  struct Node
  {
    int vertex;                 // of the working mesh, -1 where isolines meet
    bool is_on_boundary;
    int quarter_turns;          // total angle
    std::vector<int> slots;     // outgoing half-arcs, -1 where empty

    bool is_critical() const { return vertex >= 0; }
  };

  struct Arc
  {
    std::array<int, 2> node;
    std::array<int, 2> slot;
    std::array<Chart_ray, 2> ray; // at both ends, pointing along the arc
    std::vector<int> path;        // halfedges crossed from the face of ray[0] to that of ray[1]
    std::int64_t length;
    bool is_on_boundary;          // the mesh lies to the left
  };

  // the half-arcs on the four sides, counter clockwise
  struct Rectangle
  {
    std::array<std::vector<int>, 4> sides;
  };

  std::vector<Node> nodes;
  std::vector<Arc> arcs;
  std::vector<Rectangle> rectangles;
  std::vector<int> rectangle_of;  // per half-arc, -1 outside

  int number_of_half_arcs() const { return 2 * static_cast<int>(arcs.size()); }

  int source(int half_arc) const { return arcs[half_arc / 2].node[half_arc & 1]; }
  int target(int half_arc) const { return arcs[half_arc / 2].node[1 - (half_arc & 1)]; }
  int target_slot(int half_arc) const { return arcs[half_arc / 2].slot[1 - (half_arc & 1)]; }

  // the start of a half-arc, with its direction
  Chart_ray ray(int half_arc) const
  {
    Chart_ray start = arcs[half_arc / 2].ray[half_arc & 1];
    if(half_arc & 1)
      start.direction ^= 2;
    return start;
  }

  std::int64_t length(int half_arc) const { return arcs[half_arc / 2].length; }

  bool is_outside(int half_arc) const
  {
    return (half_arc & 1) && arcs[half_arc / 2].is_on_boundary;
  }

  std::int64_t side_length(int rectangle, int side) const
  {
    std::int64_t sum = 0;
    for(int h : rectangles[rectangle].sides[side])
      sum += length(h);
    return sum;
  }

  int add_arc(Arc arc)
  {
    const int a = static_cast<int>(arcs.size());
    for(int end = 0; end < 2; ++end)
      nodes[arc.node[end]].slots[arc.slot[end]] = 2 * a + end;
    arcs.push_back(std::move(arc));
    return a;
  }

  // Finds the rectangles; `false` if a face is no rectangle.
  bool find_rectangles()
  {
    rectangles.clear();
    rectangle_of.assign(number_of_half_arcs(), -1);
    for(int h = 0; h < number_of_half_arcs(); ++h)
      if(!is_outside(h) && rectangle_of[h] < 0 && !find_rectangle(h))
        return false;
    return true;
  }

  // the Euler characteristic of the surface, if all faces are disks
  int euler_characteristic() const
  {
    return static_cast<int>(nodes.size()) - static_cast<int>(arcs.size())
           + static_cast<int>(rectangles.size());
  }

private:
  // Turns clockwise at the end of `half_arc` to the next filled slot and returns the number of
  // quarter turns to the left that remain inside the face: 1 at a corner, 2 straight on; 0 if there
  // is no next half-arc.
  int next_in_face(int half_arc, int& next) const
  {
    const Node& node = nodes[target(half_arc)];
    const int n = static_cast<int>(node.slots.size());
    int slot = target_slot(half_arc);
    for(int turns = 1; turns <= n; ++turns)
    {
      if(--slot < 0)
      {
        if(node.is_on_boundary)
          return 0;
        slot += n;
      }
      next = node.slots[slot];
      if(next >= 0)
        return turns;
    }
    return 0;
  }

  bool find_rectangle(int first)
  {
    std::vector<int> half_arcs;
    std::vector<int> corners; // positions of the half-arcs that end at a corner
    int h = first;
    do
    {
      if(rectangle_of[h] >= 0)
        return false;
      rectangle_of[h] = static_cast<int>(rectangles.size());
      int next = -1;
      const int turns = next_in_face(h, next);
      if(turns < 1 || turns > 2)
        return false;
      if(turns == 1)
        corners.push_back(static_cast<int>(half_arcs.size()));
      half_arcs.push_back(h);
      h = next;
    }
    while(h != first);
    if(corners.size() != 4)
      return false;

    Rectangle rectangle;
    const int n = static_cast<int>(half_arcs.size());
    for(int i = 0, side = 0; i < n; ++i)
    {
      const int position = (corners[3] + 1 + i) % n;
      rectangle.sides[side].push_back(half_arcs[position]);
      if(position == corners[side])
        ++side;
    }
    rectangles.push_back(std::move(rectangle));
    return true;
  }
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MOTORCYCLE_GRAPH_H
