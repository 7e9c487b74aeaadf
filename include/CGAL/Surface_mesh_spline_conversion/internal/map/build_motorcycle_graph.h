// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_BUILD_MOTORCYCLE_GRAPH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_BUILD_MOTORCYCLE_GRAPH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Motorcycle_tracer.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Motorcycle_graph.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Assembles the T-mesh from the traces of a `Motorcycle_tracer`.
class Motorcycle_graph_builder
{
  typedef Isoline_trace Trace;

public:
  Motorcycle_graph_builder(const Seamless_map& map, Motorcycle_graph& graph)
    : m_map(map), m_mesh(map.mesh), m_graph(graph), m_tracer(map)
  {}

  // returns an empty string or says what is wrong with the map
  const char* build()
  {
    m_graph = Motorcycle_graph();
    if(!add_sources())
      return "the cones of the seamless map do not agree with its coordinates";
    if(!m_tracer.run())
      return "an isoline of the seamless map cannot be traced";
    add_source_nodes();
    if(!collect_hits() || !add_line_nodes() || !add_boundary_nodes())
      return "isolines of the seamless map overlap";
    if(!add_lines() || !add_boundary_arcs())
      return "an arc of the motorcycle graph does not close";
    return check();
  }

private:
  // A meeting of a trace with a line, seen from the line.
  struct Hit
  {
    std::int64_t position;
    std::size_t step;
    int side;
    int trace;
  };

  // where an isoline arrives: a node of the T-mesh, and the way from the last face of the isoline to
  // the face in which the other arcs of the node start
  struct Line_end
  {
    int node = -1;
    int slot = -1;
    std::vector<int> path;
  };

  // A node on a line or a boundary edge, with the number of crossings before it.
  struct Line_node
  {
    std::int64_t position;
    std::size_t step;
    int node;
  };

  bool is_critical(int v) const
  {
    return m_map.cone[v] != (m_mesh.is_border_vertex(v) ? 2 : 4)
           || (m_mesh.is_border_vertex(v) && m_mesh.is_corner[v]);
  }

  // Sources are the cones, the corners, one vertex of each boundary loop that has none of these and
  // one vertex of each component without any source.
  bool add_sources()
  {
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(is_critical(v) && !m_tracer.add_source(v))
        return false;
    std::vector<char> is_visited(m_mesh.number_of_halfedges(), 0);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.is_border(h) && !is_visited[h] && !add_source_on_loop(h, is_visited))
        return false;
    return add_sources_of_components();
  }

  // the boundary halfedge that follows `h` along its loop
  int next_on_boundary(int h) const { return m_mesh.vertex_halfedge[m_mesh.target(h)]; }

  bool add_source_on_loop(int first, std::vector<char>& is_visited)
  {
    bool has_source = false;
    for(int h = first; !is_visited[h]; h = next_on_boundary(h))
    {
      is_visited[h] = 1;
      has_source = has_source || m_tracer.source_of_vertex(m_mesh.source(h)) >= 0;
    }
    return has_source || m_tracer.add_source(m_mesh.source(first));
  }

  bool add_sources_of_components()
  {
    std::vector<char> is_visited(m_mesh.number_of_faces(), 0);
    for(int first = 0; first < m_mesh.number_of_faces(); ++first)
    {
      if(is_visited[first])
        continue;
      bool has_source = false;
      std::vector<int> stack(1, first);
      is_visited[first] = 1;
      while(!stack.empty())
      {
        const int f = stack.back();
        stack.pop_back();
        for(int h = 3 * f; h < 3 * f + 3; ++h)
        {
          has_source = has_source || m_tracer.source_of_vertex(m_mesh.source(h)) >= 0;
          const int o = m_mesh.opposite[h];
          if(o >= 0 && !is_visited[Working_mesh::face(o)])
          {
            is_visited[Working_mesh::face(o)] = 1;
            stack.push_back(Working_mesh::face(o));
          }
        }
      }
      if(!has_source && !m_tracer.add_source(m_mesh.source(3 * first)))
        return false;
    }
    return true;
  }

  void add_source_nodes()
  {
    for(const Motorcycle_tracer::Source& source : m_tracer.sources())
      m_graph.nodes.push_back(Motorcycle_graph::Node{
        source.vertex, m_mesh.is_border_vertex(source.vertex), m_map.cone[source.vertex],
        std::vector<int>(source.number_of_slots, -1)});
  }

  // Two joined traces form one line, named by the one whose path leads to the other.
  bool is_line(int t) const
  {
    const Trace& trace = m_tracer.traces()[t];
    return trace.end != Trace::End::JOINED || t < trace.other;
  }

  // the crossed halfedges of a line; for a joined pair from source to source
  std::vector<int> line_path(int t) const
  {
    const Trace& trace = m_tracer.traces()[t];
    std::vector<int> path = trace.crossed;
    if(trace.end != Trace::End::JOINED)
      return path;
    path.resize(own_steps(t));
    std::vector<int> back = m_tracer.traces()[trace.other].crossed;
    back.resize(own_steps(trace.other));
    back = reversed_path(m_map, back);
    path.insert(path.end(), back.begin(), back.end());
    return path;
  }

  // number of crossings of a joined trace up to the face where it meets its partner
  std::size_t own_steps(int t) const { return m_tracer.traces()[t].joint_step; }

  bool collect_hits()
  {
    const std::vector<Trace>& traces = m_tracer.traces();
    m_hits.resize(traces.size());
    m_ends.resize(traces.size());
    for(int t = 0; t < static_cast<int>(traces.size()); ++t)
    {
      const Trace& trace = traces[t];
      if(trace.end == Trace::End::ON_BOUNDARY)
        m_boundary_hits.emplace_back(trace.other, Hit{trace.other_position, 0, 1, t});
      if(trace.end != Trace::End::ON_TRACE)
        continue;
      Hit hit{trace.other_position, trace.other_step, trace.side, t};
      int line = trace.other;
      if(!is_line(line))
      {
        const Trace& partner = traces[line];
        if(hit.step > own_steps(line))
          return false;
        hit.position = partner.length - hit.position;
        hit.step = own_steps(partner.other) + own_steps(line) - hit.step;
        hit.side = 4 - hit.side;
        line = partner.other;
      }
      m_hits[line].push_back(hit);
    }
    return true;
  }

  int add_node(bool is_on_boundary)
  {
    m_graph.nodes.push_back(Motorcycle_graph::Node{-1, is_on_boundary, is_on_boundary ? 2 : 4,
                                          std::vector<int>(is_on_boundary ? 3 : 4, -1)});
    return static_cast<int>(m_graph.nodes.size()) - 1;
  }

  // One node per point of a line: traces that arrive from both sides share it.
  bool add_line_nodes()
  {
    m_line_nodes.resize(m_hits.size());
    for(std::size_t t = 0; t < m_hits.size(); ++t)
    {
      std::vector<Hit>& hits = m_hits[t];
      std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b)
        { return std::make_pair(a.position, a.side) < std::make_pair(b.position, b.side); });
      const std::vector<int> path = hits.empty() ? std::vector<int>() : line_path(t);
      for(std::size_t i = 0; i < hits.size(); ++i)
      {
        const bool is_new = i == 0 || hits[i].position != hits[i - 1].position;
        if(!is_new && hits[i].side == hits[i - 1].side)
          return false;
        if(is_new)
          m_line_nodes[t].push_back(Line_node{hits[i].position, hits[i].step, add_node(false)});
        const Line_node& node = m_line_nodes[t].back();
        m_ends[hits[i].trace]
          = Line_end{node.node, hits[i].side, part_of_path(path, hits[i].step, node.step)};
      }
    }
    return true;
  }

  // the crossings between two steps of a path, in either direction
  std::vector<int> part_of_path(const std::vector<int>& path, std::size_t from, std::size_t to) const
  {
    const std::vector<int> part(path.begin() + (std::min)(from, to),
                                path.begin() + (std::max)(from, to));
    return from <= to ? part : reversed_path(m_map, part);
  }

  bool add_boundary_nodes()
  {
    std::sort(m_boundary_hits.begin(), m_boundary_hits.end(),
      [](const std::pair<int, Hit>& a, const std::pair<int, Hit>& b)
      { return std::make_pair(a.first, a.second.position)
               < std::make_pair(b.first, b.second.position); });
    for(std::size_t i = 0; i < m_boundary_hits.size(); ++i)
    {
      const int h = m_boundary_hits[i].first;
      const Hit& hit = m_boundary_hits[i].second;
      if(i > 0 && m_boundary_hits[i - 1].first == h
         && m_boundary_hits[i - 1].second.position == hit.position)
        return false;
      const int node = add_node(true);
      m_boundary_nodes.emplace_back(h, Line_node{hit.position, 0, node});
      m_ends[hit.trace] = Line_end{node, 1, {}};
    }
    return true;
  }

  bool add_lines()
  {
    for(int t = 0; t < static_cast<int>(m_tracer.traces().size()); ++t)
      if(is_line(t) && !add_line(t))
        return false;
    return true;
  }

  // Adds the arcs of a line.
  bool add_line(int t)
  {
    const Trace& trace = m_tracer.traces()[t];
    Line_end last = m_ends[t];
    if(trace.end == Trace::End::JOINED)
    {
      const Trace& partner = m_tracer.traces()[trace.other];
      last = Line_end{partner.source, partner.slot, {}};
    }
    const std::vector<int> path = line_path(t);
    Line_node from{0, 0, trace.source};
    int slot = trace.slot;
    Chart_ray ray{Working_mesh::face(trace.start_corner), m_map.coordinates[trace.start_corner],
                  trace.start_direction};
    for(const Line_node& node : m_line_nodes[t])
    {
      if(!add_arc(ray, part_of_path(path, from.step, node.step), node.position - from.position,
                  {{from.node, node.node}}, {{slot, 2}}, false))
        return false;
      ray = m_graph.arcs.back().ray[1];
      from = node;
      slot = 0;
    }
    std::vector<int> rest = part_of_path(path, from.step, path.size());
    rest.insert(rest.end(), last.path.begin(), last.path.end());
    return add_arc(ray, std::move(rest), trace.length - from.position,
                   {{from.node, last.node}}, {{slot, last.slot}}, false);
  }

  // Adds an arc that starts at `ray`; `false` if it does not end where it should.
  bool add_arc(const Chart_ray& ray, std::vector<int> path, std::int64_t length,
               const std::array<int, 2>& nodes, const std::array<int, 2>& slots,
               bool is_on_boundary)
  {
    if(length <= 0 || nodes[1] < 0 || m_graph.nodes[nodes[0]].slots[slots[0]] >= 0
       || m_graph.nodes[nodes[1]].slots[slots[1]] >= 0)
      return false;
    Chart_ray end = ray;
    end.point[along_axis(ray.direction)] += axis_sign(ray.direction) * length;
    end = develop(m_map, end, path);
    const int vertex = m_graph.nodes[nodes[1]].vertex;
    if(vertex >= 0)
    {
      const int corner = corner_of_vertex(m_mesh, end.face, vertex);
      if(corner < 0 || m_map.coordinates[corner] != end.point)
        return false;
    }
    else if(!is_in_triangle(m_map, end.face, end.point))
      return false;
    m_graph.add_arc(Motorcycle_graph::Arc{nodes, slots, {{ray, end}}, std::move(path), length,
                                 is_on_boundary});
    return true;
  }

  bool add_boundary_arcs()
  {
    for(int n = 0; n < static_cast<int>(m_tracer.sources().size()); ++n)
      if(m_graph.nodes[n].is_on_boundary && !add_boundary_arcs_from(n))
        return false;
    return true;
  }

  // Adds the boundary arcs from the source `n` to the next source.
  bool add_boundary_arcs_from(int n)
  {
    int h = m_mesh.vertex_halfedge[m_graph.nodes[n].vertex];
    Chart_ray ray = border_ray(h, 0);
    std::int64_t length = 0;
    std::vector<int> path;
    int node = n;
    for(;;)
    {
      auto it = std::lower_bound(m_boundary_nodes.begin(), m_boundary_nodes.end(), h,
        [](const std::pair<int, Line_node>& a, int halfedge) { return a.first < halfedge; });
      std::int64_t begin = 0;
      for(; it != m_boundary_nodes.end() && it->first == h; ++it)
      {
        if(!add_arc(ray, std::move(path), length + it->second.position - begin,
                    {{node, it->second.node}}, {{0, 2}}, true))
          return false;
        begin = it->second.position;
        node = it->second.node;
        ray = border_ray(h, begin);
        length = 0;
        path.clear();
      }
      length += border_length(h) - begin;
      const int source = m_tracer.source_of_vertex(m_mesh.target(h));
      if(source >= 0)
      {
        const int slot = static_cast<int>(m_graph.nodes[source].slots.size()) - 1;
        return add_arc(ray, std::move(path), length, {{node, source}}, {{0, slot}}, true);
      }
      Fan_position fan{Working_mesh::next(h), 0, {}};
      while(step_clockwise(m_map, fan)) {}
      path.insert(path.end(), fan.crossed.begin(), fan.crossed.end());
      h = fan.corner;
    }
  }

  // direction of a border halfedge, which is parallel to an axis
  int border_direction(int h) const
  {
    const Fixed_point_2 e = minus(m_map.coordinates[Working_mesh::next(h)], m_map.coordinates[h]);
    return e[1] == 0 ? (e[0] > 0 ? 0 : 2) : (e[1] > 0 ? 1 : 3);
  }

  std::int64_t border_length(int h) const
  {
    const Fixed_point_2 e = minus(m_map.coordinates[Working_mesh::next(h)], m_map.coordinates[h]);
    const std::int64_t sum = e[0] + e[1];
    return sum < 0 ? -sum : sum;
  }

  Chart_ray border_ray(int h, std::int64_t offset) const
  {
    Chart_ray ray{Working_mesh::face(h), m_map.coordinates[h], border_direction(h)};
    ray.point[along_axis(ray.direction)] += axis_sign(ray.direction) * offset;
    return ray;
  }

  // Checks the invariants of a motorcycle graph.
  const char* check()
  {
    for(const Motorcycle_graph::Node& node : m_graph.nodes)
    {
      const auto empty = std::count(node.slots.begin(), node.slots.end(), -1);
      if(empty > (node.is_critical() || node.is_on_boundary ? 0 : 1))
        return "a slot of a node of the motorcycle graph is empty";
    }
    if(!m_graph.find_rectangles())
      return "a face of the motorcycle graph is no rectangle";
    for(int r = 0; r < static_cast<int>(m_graph.rectangles.size()); ++r)
      for(int side = 0; side < 2; ++side)
        if(m_graph.side_length(r, side) != m_graph.side_length(r, side + 2))
          return "opposite sides of a rectangle differ in length";
    if(m_graph.euler_characteristic() != euler_characteristic(m_mesh))
      return "the motorcycle graph does not have the topology of the mesh";
    return "";
  }

  static int euler_characteristic(const Working_mesh& mesh)
  {
    int edges = 0;
    for(int h = 0; h < mesh.number_of_halfedges(); ++h)
      edges += mesh.opposite[h] < h ? 1 : 0;
    return mesh.number_of_vertices() - edges + mesh.number_of_faces();
  }

  const Seamless_map& m_map;
  const Working_mesh& m_mesh;
  Motorcycle_graph& m_graph;
  Motorcycle_tracer m_tracer;
  std::vector<std::vector<Hit> > m_hits;                       // per line
  std::vector<std::vector<Line_node> > m_line_nodes;           // per line
  std::vector<Line_end> m_ends;                                // per trace
  std::vector<std::pair<int, Hit> > m_boundary_hits;           // by border halfedge
  std::vector<std::pair<int, Line_node> > m_boundary_nodes;    // by border halfedge, ordered
};

// Computes the motorcycle graph of a seamless map; returns an empty string or what is wrong.
inline const char* compute_motorcycle_graph(const Seamless_map& map, Motorcycle_graph& graph)
{
  return Motorcycle_graph_builder(map, graph).build();
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_BUILD_MOTORCYCLE_GRAPH_H
