// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_INDEX_SURGERY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_INDEX_SURGERY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/field/Face_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Shortest paths along edges from one vertex, inside the mesh: paths do not pass through boundary
// vertices, which have no period jumps on their boundary edges.
class Edge_paths
{
public:
  explicit Edge_paths(const Working_mesh& mesh)
    : m_mesh(mesh), m_distance(mesh.number_of_vertices(), infinity()),
      m_halfedge(mesh.number_of_vertices(), -1), m_start_angle(mesh.number_of_vertices(), 0.)
  {}

  // visits vertices by increasing distance up to `radius`, until `visit(v)` returns `true`;
  // returns the last vertex then, and -1 otherwise
  template <typename Visit>
  int search(int source, double radius, const Face_geometry& geometry, Visit visit)
  {
    reset();
    push(source, 0, -1, 0);
    while(!m_queue.empty())
    {
      const double d = m_queue.top().first;
      const int v = m_queue.top().second;
      m_queue.pop();
      if(d > m_distance[v])
        continue;
      if(d > radius)
        break;
      if(v != source && visit(v))
        return v;
      if(v == source || !m_mesh.is_border_vertex(v))
        relax_neighbors(v, v == source, geometry);
    }
    return -1;
  }

  double distance(int v) const { return m_distance[v]; }

  // angle at the source, from its first halfedge, in which the path to `v` leaves
  double start_angle(int v) const { return m_start_angle[v]; }

  // calls `function` for the halfedges of the path to `v`, from its end
  template <typename Function>
  void for_each_halfedge(int v, Function function) const
  {
    for(; m_halfedge[v] >= 0; v = m_mesh.source(m_halfedge[v]))
      function(m_halfedge[v]);
  }

private:
  typedef std::pair<double, int> Entry;

  static double infinity() { return (std::numeric_limits<double>::max)(); }

  void reset()
  {
    for(int v : m_touched)
      m_distance[v] = infinity();
    m_touched.clear();
    m_queue = Queue();
  }

  void push(int v, double distance, int halfedge, double start_angle)
  {
    if(distance >= m_distance[v])
      return;
    if(m_distance[v] == infinity())
      m_touched.push_back(v);
    m_distance[v] = distance;
    m_halfedge[v] = halfedge;
    m_start_angle[v] = start_angle;
    m_queue.emplace(distance, v);
  }

  void relax_neighbors(int v, bool is_source, const Face_geometry& geometry)
  {
    double angle = 0;
    m_mesh.for_each_outgoing(v, [&](int h)
    {
      if(!m_mesh.is_border(h))
        push(m_mesh.target(h), m_distance[v] + m_mesh.vector(h).norm(), h,
             is_source ? angle : m_start_angle[v]);
      angle += geometry.corner_angle[h];
    });
  }

  typedef std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry> > Queue;

  const Working_mesh& m_mesh;
  std::vector<double> m_distance;
  std::vector<int> m_halfedge;        // last halfedge of the path
  std::vector<double> m_start_angle;
  std::vector<int> m_touched;
  Queue m_queue;
};

// Makes the singularities of a cross field suitable for quads, by changing period jumps only: the
// boundary gets regular vertices and convex corners (paper 3.1.3), what remains of other corners
// moves inside, singularities of opposite index that are closer than two quads cancel each other.
// Changing the period jumps along a path moves an index from one of its ends to the other.
class Index_surgery
{
public:
  Index_surgery(Cross_field& field, const Face_geometry& geometry)
    : m_field(field), m_mesh(field.mesh), m_geometry(geometry),
      m_total_angle(geometry.total_angles(field.mesh)), m_paths(field.mesh)
  {
    set_targets();
    measure_boundary_distances();
  }

  // returns `false` if a surplus could not be moved, because the mesh has too few inner vertices
  bool run()
  {
    cancel_opposite_pairs();
    bool success = true;
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
    {
      const int tolerated = m_mesh.is_border_vertex(v) ? 0 : 1;
      while(success && std::abs(surplus(v)) > tolerated)
        success = move_surplus_of(v);
    }
    cancel_opposite_pairs();
    if(m_field.gathers_singularities)
      gather_singularities();
    if(m_field.joining_distance > 0)
      join_singularities();
    return success;
  }

  // moves singularities near the given vertices, where a map turned out to be impossible, to
  // vertices with better triangles
  void relocate_near(const std::vector<int>& vertices)
  {
    const auto is_singular = [this](int x) { return !is_regular_inside(x) && is_inside(x); };
    for(int v : vertices)
    {
      int singularity = v;
      if(!is_singular(v))
        singularity = m_paths.search(v, relocation_distance * m_field.size[v], m_geometry,
                                     is_singular);
      if(singularity >= 0)
        relocate(singularity);
    }
  }

private:
  // in quad sizes
  static constexpr double relocation_distance = 2.25;
  static constexpr double smallest_boundary_distance = 2;
  static constexpr double smallest_cone_distance = 1.5;
  static constexpr double search_radius = 3;
  static constexpr double smallest_corner_distance = 0.25;

  void set_targets()
  {
    m_target.assign(m_mesh.number_of_vertices(), 4);
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(m_mesh.is_border_vertex(v))
      {
        const long turns = std::lround(m_total_angle[v] / right_angle);
        m_target[v] = m_mesh.is_corner[v] && turns <= 1 ? 1 : 2;
        // as the paper accepts
        if(m_field.keeps_large_corners && m_mesh.is_corner[v]
           && m_total_angle[v] > 4 * right_angle)
          m_target[v] = m_field.quarter_turns[v];
      }
    set_targets_of_close_corners();
  }

  // Convex corners that are much closer to each other than the quads, as those of a chamfer, turn
  // the boundary like one: what they turn is rounded together. (Rounded alone, two corners of 135
  // degrees turn it by nothing, or by twice as much.)
  void set_targets_of_close_corners()
  {
    std::vector<int> next(m_mesh.number_of_vertices(), -1);
    std::vector<char> is_first(m_mesh.number_of_vertices(), 1);
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(is_convex_corner(v))
      {
        next[v] = close_corner_after(v);
        if(next[v] >= 0)
          is_first[next[v]] = 0;
      }
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(next[v] >= 0 && is_first[v])
      {
        std::vector<int> corners;
        for(int w = v; w >= 0; w = next[w])
          corners.push_back(w);
        round_turns_together(corners);
      }
  }

  bool is_convex_corner(int v) const
  {
    return m_mesh.is_corner[v] && m_total_angle[v] < 2 * right_angle;
  }

  // the next corner of the boundary, if it is convex and close, or -1
  int close_corner_after(int v) const
  {
    const double largest = smallest_corner_distance * m_field.size[v];
    double distance = 0;
    int w = v;
    do
    {
      const int h = m_mesh.vertex_halfedge[w];
      distance += m_mesh.vector(h).norm();
      w = m_mesh.target(h);
    }
    while(!m_mesh.is_corner[w] && distance < largest);
    return distance < largest && w != v && is_convex_corner(w) ? w : -1;
  }

  void round_turns_together(std::vector<int>& corners)
  {
    double turn = 0;
    for(int v : corners)
      turn += (std::min)(1., 2 - m_total_angle[v] / right_angle);
    std::stable_sort(corners.begin(), corners.end(),
                     [this](int v, int w) { return m_total_angle[v] < m_total_angle[w]; });
    const std::size_t turning = static_cast<std::size_t>(std::lround(turn));
    for(std::size_t i = 0; i < corners.size(); ++i)
      m_target[corners[i]] = i < turning ? 1 : 2;
  }

  int surplus(int v) const { return m_field.quarter_turns[v] - m_target[v]; }

  bool is_inside(int v) const { return !m_mesh.is_border_vertex(v); }

  bool is_regular_inside(int v) const { return is_inside(v) && surplus(v) == 0; }

  // moves `sign` right angles along the path from `source` to `goal`
  void move(int source, int goal, int sign)
  {
    m_paths.for_each_halfedge(goal, [this, sign](int h)
    {
      m_field.period_jump[h] -= sign;
      m_field.period_jump[m_mesh.opposite[h]] += sign;
    });
    m_field.quarter_turns[source] -= sign;
    m_field.quarter_turns[goal] += sign;
  }

  bool move_surplus_of(int v)
  {
    const int sign = surplus(v) > 0 ? 1 : -1;
    const double size = m_field.size[v];
    const auto is_opposite = [this, sign](int x) { return surplus(x) * sign < 0; };
    int goal = m_paths.search(v, search_radius * size, m_geometry, is_opposite);
    if(goal < 0)
      goal = best_relocation(v);
    if(goal < 0)
      goal = m_paths.search(v, (std::numeric_limits<double>::max)(), m_geometry,
        [&](int x) { return is_opposite(x) || is_regular_inside(x); });
    if(goal < 0)
      return false;
    move(v, goal, sign);
    return true;
  }

  // the regular inner vertex that suits best as the new place of the surplus of `v`, or -1
  int best_relocation(int v)
  {
    collect_singularities();
    int best = -1;
    double smallest_penalty = (std::numeric_limits<double>::max)();
    m_paths.search(v, search_radius * m_field.size[v], m_geometry, [&](int x)
    {
      if(is_regular_inside(x) && relocation_penalty(v, x) < smallest_penalty)
      {
        smallest_penalty = relocation_penalty(v, x);
        best = x;
      }
      return false;
    });
    return best;
  }

  void relocate(int v)
  {
    const double wanted_distance = 0.5;
    const double size = m_field.size[v];
    const int sign = surplus(v) > 0 ? 1 : -1;
    int best = -1;
    double smallest_penalty = (std::numeric_limits<double>::max)();
    m_paths.search(v, size, m_geometry, [&](int x)
    {
      const double penalty = std::abs(m_paths.distance(x) / size - wanted_distance)
                             - smallest_angle_around(x);
      if(is_regular_inside(x) && penalty < smallest_penalty)
      {
        smallest_penalty = penalty;
        best = x;
      }
      return false;
    });
    if(best >= 0)
      move(v, best, sign);
  }

  double smallest_angle_around(int v) const
  {
    double smallest = pi;
    m_mesh.for_each_outgoing(v, [&](int h)
    {
      for(int corner = 3 * (h / 3); corner < 3 * (h / 3) + 3; ++corner)
        smallest = (std::min)(smallest, m_geometry.corner_angle[corner]);
    });
    return smallest;
  }

  // near the bisector, at the wanted distance from `v`, away from the boundary and from others
  double relocation_penalty(int v, int x) const
  {
    const double boundary_weight = 2, bisector_weight = 0.5;
    const double size = m_field.size[v];
    double penalty = std::abs(m_paths.distance(x) / size - relocation_distance);
    penalty += boundary_weight
               * (std::max)(0., smallest_boundary_distance - m_boundary_distance[x] / size);
    if(m_mesh.is_border_vertex(v))
      penalty += bisector_weight * std::abs(m_paths.start_angle(x) - m_total_angle[v] / 2);
    for(int s : m_singularities)
    {
      const double distance = (m_mesh.points[s] - m_mesh.points[x]).norm() / size;
      penalty += (std::max)(0., smallest_cone_distance - distance);
    }
    return penalty;
  }

  void collect_singularities()
  {
    m_singularities.clear();
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(is_inside(v) && surplus(v) != 0)
        m_singularities.push_back(v);
  }

  // nearest pairs first
  void cancel_opposite_pairs()
  {
    for(double radius : {0.25, 0.5, 0.75, 1., 1.5, 2.})
      for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      {
        if(!is_inside(v) || surplus(v) == 0)
          continue;
        const int sign = surplus(v) > 0 ? 1 : -1;
        const int goal = m_paths.search(v, radius * m_field.size[v], m_geometry, [&](int x)
          { return is_inside(x) && surplus(x) * sign < 0; });
        if(goal >= 0)
          move(v, goal, sign);
      }
  }

  // Thin parts of the shape may have no room for single singularities. Those with a surplus move to
  // a vertex each that is in reach of most of them, with the smallest sum of distances.
  void gather_singularities()
  {
    typedef std::pair<int, double> Suitability; // number of singularities, and minus that sum
    std::vector<Suitability> suitability(m_mesh.number_of_vertices(), Suitability(0, 0.));
    for_each_in_reach([&](int, int x, double distance)
    {
      ++suitability[x].first;
      suitability[x].second -= distance;
    });
    std::vector<int> goal(m_mesh.number_of_vertices(), -1);
    for_each_in_reach([&](int v, int x, double)
    {
      if(goal[v] < 0 || suitability[x] > suitability[goal[v]])
        goal[v] = x;
    });
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(goal[v] >= 0)
        move_surplus(v, goal[v]);
  }

  // Singularities with a surplus that are closer than wanted meet half-way, nearest pairs first.
  void join_singularities()
  {
    const int most_right_angles = 8;
    const double distance = m_field.joining_distance / m_field.spacing; // relative to `size`
    for(double share : {0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.})
      for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      {
        if(!is_inside(v) || surplus(v) <= 0)
          continue;
        const int goal
          = m_paths.search(v, share * distance * m_field.size[v], m_geometry, [&](int x)
            { return is_inside(x) && surplus(x) > 0
                     && surplus(x) + m_field.quarter_turns[v] <= most_right_angles; });
        if(goal < 0)
          continue;
        const int middle = middle_of_path_to(goal);
        move_surplus(v, middle);
        move_surplus(goal, middle);
      }
  }

  // a regular vertex near the middle of the last path found, or its end
  int middle_of_path_to(int goal) const
  {
    int middle = goal;
    m_paths.for_each_halfedge(goal, [&](int h)
    {
      const int x = m_mesh.source(h);
      if(is_regular_inside(x) && m_paths.distance(x) >= m_paths.distance(goal) / 2)
        middle = x;
    });
    return middle;
  }

  // moves all of it
  void move_surplus(int v, int goal)
  {
    if(v == goal)
      return;
    m_paths.search(v, (std::numeric_limits<double>::max)(), m_geometry,
                   [goal](int x) { return x == goal; });
    while(surplus(v) > 0)
      move(v, goal, 1);
  }

  // Calls `function(v, x, distance)` for each inner vertex `v` with a surplus and each inner vertex
  // `x` in its reach, itself first. Many of them reach fewer vertices each: the work is in
  // proportion to the size of the mesh.
  template <typename Function>
  void for_each_in_reach(Function function)
  {
    const std::size_t visits_per_vertex = 100;
    collect_singularities();
    const std::size_t most_visits
      = visits_per_vertex * m_mesh.number_of_vertices() / (m_singularities.size() + 1);
    for(int v : m_singularities)
    {
      if(surplus(v) <= 0)
        continue;
      function(v, v, 0.);
      std::size_t visits = 0;
      m_paths.search(v, search_radius * m_field.size[v], m_geometry, [&](int x)
      {
        if(is_inside(x) && surplus(x) >= 0)
          function(v, x, m_paths.distance(x));
        return ++visits >= most_visits;
      });
    }
  }

  // lengths of shortest edge paths from the boundary
  void measure_boundary_distances()
  {
    typedef std::pair<double, int> Entry;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry> > queue;
    m_boundary_distance.assign(m_mesh.number_of_vertices(), (std::numeric_limits<double>::max)());
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(m_mesh.is_border_vertex(v))
      {
        m_boundary_distance[v] = 0;
        queue.emplace(0., v);
      }
    while(!queue.empty())
    {
      const Entry top = queue.top();
      queue.pop();
      if(top.first > m_boundary_distance[top.second])
        continue;
      m_mesh.for_each_outgoing(top.second, [&](int h)
      {
        const double distance = top.first + m_mesh.vector(h).norm();
        if(distance >= m_boundary_distance[m_mesh.target(h)])
          return;
        m_boundary_distance[m_mesh.target(h)] = distance;
        queue.emplace(distance, m_mesh.target(h));
      });
    }
  }

  Cross_field& m_field;
  const Working_mesh& m_mesh;
  const Face_geometry& m_geometry;
  std::vector<double> m_total_angle;
  Edge_paths m_paths;
  std::vector<int> m_target;               // per vertex: wanted number of right angles
  std::vector<double> m_boundary_distance; // per vertex
  std::vector<int> m_singularities;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_INDEX_SURGERY_H
