// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MOTORCYCLE_TRACER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MOTORCYCLE_TRACER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/chart_navigation.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// An isoline that starts at a source vertex and runs until it meets another one or the boundary.
struct Isoline_trace
{
  enum class End { NONE, ON_TRACE, ON_BOUNDARY, JOINED };

  int source;                 // index of the source
  int slot;                   // quarter turn at the source, counter clockwise
  int start_corner;
  int start_direction;
  std::vector<int> crossed;   // halfedges crossed from the face of the start corner to the end

  End end = End::NONE;
  std::int64_t length = 0;    // to the end; for a joined pair the distance of the two sources
  int other = -1;             // the trace met (ON_TRACE, JOINED) or the border halfedge
  std::int64_t other_position = 0; // on `other`, from its source
  std::size_t other_step = 0;      // number of crossings of `other` before the face of the meeting
  int side = 0;               // on which side of `other`: 1 left, 3 right
  std::size_t joint_step = 0; // JOINED: number of own crossings up to the face of the meeting
};

// Traces all isolines of the motorcycle graph (Eppstein et al. 2008) exactly. Traces advance in the
// order of their length, which is a heuristic; that the trace recorded first wins makes the graph
// consistent in any order.
class Motorcycle_tracer
{
public:
  typedef Isoline_trace Trace;

  // a vertex that sends out a trace into each of its interior quarter turns
  struct Source
  {
    int vertex;
    int number_of_slots;          // on the boundary including the two boundary directions
    std::vector<int> trace;       // per slot, -1 for the boundary directions
  };

  explicit Motorcycle_tracer(const Seamless_map& map)
    : m_map(map), m_mesh(map.mesh), m_segments(map.mesh.number_of_faces()),
      m_source_of_vertex(map.mesh.number_of_vertices(), -1),
      m_passages(map.mesh.number_of_vertices())
  {}

  const std::vector<Source>& sources() const { return m_sources; }
  const std::vector<Trace>& traces() const { return m_traces; }

  // returns the source at a vertex, or -1
  int source_of_vertex(int v) const { return m_source_of_vertex[v]; }

  // makes `v` a source; `false` if its directions do not agree with the cone of the map
  bool add_source(int v)
  {
    const bool on_boundary = m_mesh.is_border_vertex(v);
    Source source{v, m_map.cone[v] + (on_boundary ? 1 : 0), {}};
    const int id = static_cast<int>(m_sources.size());
    m_mesh.for_each_outgoing(v, [&](int corner)
    {
      for(int direction : directions_in_sector(corner))
      {
        const int slot = static_cast<int>(source.trace.size());
        if(on_boundary && slot == 0)
          source.trace.push_back(-1);
        else
          source.trace.push_back(start_trace(id, slot, corner, direction));
      }
    });
    if(static_cast<int>(source.trace.size()) != m_map.cone[v])
      return false;
    if(on_boundary)
      source.trace.push_back(-1);
    m_source_of_vertex[v] = id;
    m_sources.push_back(std::move(source));
    return true;
  }

  // advances all traces to their ends; `false` if the map is not consistent
  bool run()
  {
    for(int t = 0; t < static_cast<int>(m_traces.size()); ++t)
      m_queue.emplace(0, t);
    // every step crosses an edge; a valid map needs far fewer
    std::size_t steps_left = 1000 * (m_segments.size() + 1000);
    while(!m_queue.empty())
    {
      const int t = m_queue.top().second;
      m_queue.pop();
      if(m_traces[t].end != Trace::End::NONE)
        continue;
      if(steps_left-- == 0 || !advance(t))
        return false;
      if(m_traces[t].end == Trace::End::NONE)
        m_queue.emplace(m_heads[t].distance, t);
    }
    return true;
  }

private:
  static constexpr std::int64_t infinity = (std::numeric_limits<std::int64_t>::max)();

  // where a trace is about to run: from a corner through its triangle, through a triangle after
  // crossing its halfedge, or along a halfedge from its source
  struct Head
  {
    enum class Mode { FROM_CORNER, THROUGH_EDGE, ALONG_EDGE };

    Mode mode;
    int halfedge;
    Chart_ray origin;           // the start of the trace and its direction, seen in this chart
    std::int64_t distance;      // travelled, rounded down: only for the order of the queue
  };

  // the run of a trace through a triangle
  struct Segment
  {
    int trace;
    std::size_t step;           // number of crossings before
    Fixed_point_2 origin;       // the start of the trace seen in this chart
    int direction;
    std::int64_t end;           // position where the trace ends in this triangle, or `infinity`
    int detour;                 // halfedge to cross from this triangle to that of the step, or -1
  };

  // the run of a trace through a regular vertex
  struct Passage
  {
    int trace;
    std::size_t step;
    int corner;                 // by which the trace arrives
    int direction;              // in the chart of this corner
    std::int64_t position;
    bool ends;
  };

  // where a trace meets another one
  struct Meeting
  {
    int trace = -1;
    std::size_t step = 0;
    int direction = 0;
    int detour = -1;
    std::int64_t own_position = 0;
    std::int64_t position = 0;
  };

  std::vector<int> directions_in_sector(int corner) const
  {
    std::vector<int> directions;
    for(int d = 0; d < 4; ++d)
      if(position_in_sector(m_map, corner, d) != Sector_position::OUTSIDE)
        directions.push_back(d);
    // a sector is smaller than half a turn: two consecutive directions at most
    if(directions.size() == 2 && ((directions[0] + 1) & 3) != directions[1])
      std::swap(directions[0], directions[1]);
    return directions;
  }

  int start_trace(int source, int slot, int corner, int direction)
  {
    Trace trace;
    trace.source = source;
    trace.slot = slot;
    trace.start_corner = corner;
    trace.start_direction = direction;
    m_traces.push_back(trace);
    const Chart_ray origin{Working_mesh::face(corner), m_map.coordinates[corner], direction};
    m_heads.push_back(Head{mode_at(corner, direction), corner, origin, 0});
    return static_cast<int>(m_traces.size()) - 1;
  }

  Head::Mode mode_at(int corner, int direction) const
  {
    return position_in_sector(m_map, corner, direction) == Sector_position::ALONG_HALFEDGE
             ? Head::Mode::ALONG_EDGE : Head::Mode::FROM_CORNER;
  }

  static std::int64_t position(const Fixed_point_2& origin, int direction, const Fixed_point_2& p)
  {
    const int a = along_axis(direction);
    return axis_sign(direction) * (p[a] - origin[a]);
  }

  // Advances a trace by one triangle or edge.
  bool advance(int t)
  {
    return m_heads[t].mode == Head::Mode::ALONG_EDGE ? run_along_edge(t) : run_through_triangle(t);
  }

  bool run_through_triangle(int t)
  {
    const Head& head = m_heads[t];
    const Chart_ray ray = head.origin;
    if(try_to_join(t, ray))
      return true;

    const bool from_corner = head.mode == Head::Mode::FROM_CORNER;
    const int apex = from_corner ? -1 : Working_mesh::previous(head.halfedge);
    const int c = across_axis(ray.direction);
    const bool exits_at_apex = !from_corner && m_map.coordinates[apex][c] == ray.point[c];
    const int exit = exits_at_apex ? -1 : exit_halfedge(head);

    Meeting meeting;
    find_crossing(ray, head.mode == Head::Mode::THROUGH_EDGE ? head.halfedge : -1,
                  from_corner ? head.halfedge : -1, -1, meeting);
    if(meeting.trace < 0 && exit >= 0 && !m_mesh.is_border(exit))
    {
      // a trace that reaches the exit point from the other side may not have arrived here yet
      const Chart_ray beyond = cross_edge(m_map, exit, ray);
      find_crossing(beyond, -1, -1, m_mesh.opposite[exit], meeting);
      if(meeting.trace >= 0)
      {
        record(t, ray, meeting.own_position);
        m_traces[t].crossed.push_back(exit);
        end_on_trace(t, beyond.direction, meeting);
        return true;
      }
    }
    if(meeting.trace >= 0)
    {
      record(t, ray, meeting.own_position);
      end_on_trace(t, ray.direction, meeting);
      return true;
    }
    record(t, ray, infinity);
    return exits_at_apex ? arrive_at_vertex(t, apex, ray) : leave_through_edge(t, exit, ray);
  }

  bool run_along_edge(int t)
  {
    const Head& head = m_heads[t];
    const int h = head.halfedge;
    const Chart_ray ray = head.origin;
    if(m_mesh.is_border(h))
      return false;
    const Chart_ray beyond = cross_edge(m_map, h, ray);
    if(try_to_join(t, ray))
      return true;

    Meeting here, there;
    find_crossing(ray, -1, h, h, here);
    find_crossing(beyond, -1, Working_mesh::next(m_mesh.opposite[h]), m_mesh.opposite[h], there);
    const bool is_there = there.trace >= 0
      && (here.trace < 0 || there.own_position < here.own_position);
    const Meeting& meeting = is_there ? there : here;
    const std::int64_t end = meeting.trace >= 0 ? meeting.own_position : infinity;
    record(t, ray, end);
    record(t, beyond, end, m_mesh.opposite[h]);
    if(meeting.trace < 0)
      return arrive_at_vertex(t, Working_mesh::next(h), ray);
    if(is_there)
      m_traces[t].crossed.push_back(h);
    end_on_trace(t, is_there ? beyond.direction : ray.direction, meeting);
    return true;
  }

  void record(int t, const Chart_ray& ray, std::int64_t end, int detour = -1)
  {
    m_segments[ray.face].push_back(
      Segment{t, m_traces[t].crossed.size(), ray.point, ray.direction, end, detour});
  }

  // Looks for the nearest trace across `ray` in its face. Crossings on the halfedge `entry` and at
  // the corner `start` are behind the ray; with `only_on` >= 0 other points do not count.
  void find_crossing(const Chart_ray& ray, int entry, int start, int only_on, Meeting& best) const
  {
    const int across = across_axis(ray.direction), along = along_axis(ray.direction);
    for(const Segment& segment : m_segments[ray.face])
    {
      if(along_axis(segment.direction) == along)
        continue;
      Fixed_point_2 p;
      p[across] = ray.point[across];
      p[along] = segment.origin[along];
      if(!is_in_triangle(m_map, ray.face, p)
         || (entry >= 0 && side_of_halfedge(m_map, entry, p) == 0)
         || (start >= 0 && m_map.coordinates[start] == p)
         || (only_on >= 0 && side_of_halfedge(m_map, only_on, p) != 0))
        continue;
      const std::int64_t other = position(segment.origin, segment.direction, p);
      const std::int64_t own = position(ray.point, ray.direction, p);
      if(own <= 0 || other >= segment.end || is_source(ray.face, p) || (best.trace >= 0 && own >= best.own_position))
        continue;
      best.trace = segment.trace;
      best.step = segment.step;
      best.direction = segment.direction;
      best.detour = segment.detour;
      best.own_position = own;
      best.position = other;
    }
  }

  // Traces that meet at a source do so in different slots.
  bool is_source(int f, const Fixed_point_2& p) const
  {
    for(int c = 3 * f; c < 3 * f + 3; ++c)
      if(m_map.coordinates[c] == p)
        return m_source_of_vertex[m_mesh.source(c)] >= 0;
    return false;
  }

  void end_on_trace(int t, int direction, const Meeting& meeting)
  {
    Trace& trace = m_traces[t];
    trace.end = Trace::End::ON_TRACE;
    trace.length = meeting.own_position;
    trace.other = meeting.trace;
    trace.other_position = meeting.position;
    trace.other_step = meeting.step;
    trace.side = (direction + 2 - meeting.direction) & 3;
    if(meeting.detour >= 0)
      trace.crossed.push_back(meeting.detour);
  }

  // Two traces on the same isoline that run towards each other become one arc.
  bool try_to_join(int t, const Chart_ray& ray)
  {
    const int across = across_axis(ray.direction);
    for(const Segment& segment : m_segments[ray.face])
      if(((segment.direction ^ ray.direction) & 3) == 2
         && segment.origin[across] == ray.point[across]
         && m_traces[segment.trace].end == Trace::End::NONE)
      {
        if(segment.detour >= 0)
          m_traces[t].crossed.push_back(segment.detour);
        join(t, segment.trace, segment.step, position(ray.point, ray.direction, segment.origin));
        return true;
      }
    return false;
  }

  void join(int t, int other, std::size_t step, std::int64_t length)
  {
    Trace& trace = m_traces[t];
    trace.end = Trace::End::JOINED;
    trace.length = length;
    trace.other = other;
    trace.joint_step = trace.crossed.size();
    Trace& partner = m_traces[other];
    partner.end = Trace::End::JOINED;
    partner.length = length;
    partner.other = t;
    partner.joint_step = step;
  }

  // the edge by which a trace leaves its triangle
  int exit_halfedge(const Head& head) const
  {
    const int first = Working_mesh::next(head.halfedge);
    if(head.mode == Head::Mode::FROM_CORNER)
      return first;
    const int c = across_axis(head.origin.direction);
    const std::int64_t constant = head.origin.point[c];
    const bool source_is_below = m_map.coordinates[first][c] < constant;
    const bool apex_is_below = m_map.coordinates[Working_mesh::next(first)][c] < constant;
    return source_is_below != apex_is_below ? first : Working_mesh::next(first);
  }

  // position, rounded down, where the line of `ray` crosses the halfedge `h`
  std::int64_t crossing_position(int h, const Chart_ray& ray) const
  {
    const int along = along_axis(ray.direction), across = across_axis(ray.direction);
    const Fixed_point_2& a = m_map.coordinates[h];
    const Fixed_point_2 e = minus(m_map.coordinates[Working_mesh::next(h)], a);
    const Wide_integer offset
      = static_cast<Wide_integer>(ray.point[across] - a[across]) * e[along] / e[across];
    return axis_sign(ray.direction)
           * (a[along] + static_cast<std::int64_t>(offset) - ray.point[along]);
  }

  bool leave_through_edge(int t, int exit, const Chart_ray& ray)
  {
    Trace& trace = m_traces[t];
    if(m_mesh.is_border(exit))
    {
      const int along = along_axis(ray.direction), across = across_axis(ray.direction);
      const Fixed_point_2& a = m_map.coordinates[exit];
      if(m_map.coordinates[Working_mesh::next(exit)][along] != a[along])
        return false;
      const std::int64_t offset = ray.point[across] - a[across];
      end_on_boundary(trace, exit, offset < 0 ? -offset : offset,
                      position(ray.point, ray.direction, a));
      return true;
    }
    const std::int64_t distance = crossing_position(exit, ray);
    trace.crossed.push_back(exit);
    m_heads[t] = Head{Head::Mode::THROUGH_EDGE, m_mesh.opposite[exit],
                      cross_edge(m_map, exit, ray), distance};
    return true;
  }

  void end_on_boundary(Trace& trace, int halfedge, std::int64_t offset, std::int64_t length)
  {
    trace.end = Trace::End::ON_BOUNDARY;
    trace.other = halfedge;
    trace.other_position = offset;
    trace.length = length;
  }

  // A trace arrives at the vertex of `corner`, in the face of this corner.
  bool arrive_at_vertex(int t, int corner, const Chart_ray& ray)
  {
    const int v = m_mesh.source(corner);
    const std::int64_t length = position(ray.point, ray.direction, m_map.coordinates[corner]);
    if(m_source_of_vertex[v] >= 0)
      return arrive_at_source(t, corner, ray.direction, length);
    if(m_mesh.is_border_vertex(v))
      return arrive_at_border_vertex(t, corner, ray.direction, length);

    for(const Passage& passage : m_passages[v])
    {
      Fan_position fan{corner, ray.direction, {}};
      while(fan.corner != passage.corner)
        step_counterclockwise(m_map, fan);
      const int turn = (fan.direction - passage.direction) & 3;
      if(turn == 0)
        return false;
      if(turn == 2 && (passage.ends || m_traces[passage.trace].end != Trace::End::NONE))
        continue;
      if((turn & 1) && passage.ends)
        continue;
      meet_at_vertex(t, passage, fan, length);
      return true;
    }
    return pass_vertex(t, corner, ray, length);
  }

  void meet_at_vertex(int t, const Passage passage, const Fan_position& fan, std::int64_t length)
  {
    Trace& trace = m_traces[t];
    if(((fan.direction - passage.direction) & 1) == 0)
    {
      trace.crossed.insert(trace.crossed.end(), fan.crossed.begin(), fan.crossed.end());
      join(t, passage.trace, passage.step, length + passage.position);
      return;
    }
    m_passages[m_mesh.source(passage.corner)].push_back(
      Passage{t, trace.crossed.size() + fan.crossed.size(), passage.corner, fan.direction,
              length, true});
    trace.crossed.insert(trace.crossed.end(), fan.crossed.begin(), fan.crossed.end());
    Meeting meeting;
    meeting.trace = passage.trace;
    meeting.step = passage.step;
    meeting.direction = passage.direction;
    meeting.own_position = length;
    meeting.position = passage.position;
    close_segments(t, passage.corner, length);
    end_on_trace(t, fan.direction, meeting);
  }

  // Continues a trace straight on beyond a regular vertex.
  bool pass_vertex(int t, int corner, const Chart_ray& ray, std::int64_t length)
  {
    Trace& trace = m_traces[t];
    m_passages[m_mesh.source(corner)].push_back(
      Passage{t, trace.crossed.size(), corner, ray.direction, length, false});
    const Fan_position fan = find_sector(m_map, corner, ray.direction);
    if(fan.corner < 0)
      return false;
    trace.crossed.insert(trace.crossed.end(), fan.crossed.begin(), fan.crossed.end());
    m_heads[t] = Head{mode_at(fan.corner, fan.direction), fan.corner,
                      develop(m_map, ray, fan.crossed), length};
    return true;
  }

  // The isoline through a border vertex that is no source ends there.
  bool arrive_at_border_vertex(int t, int corner, int direction, std::int64_t length)
  {
    Fan_position fan{corner, direction, {}};
    while(step_clockwise(m_map, fan)) {}
    Trace& trace = m_traces[t];
    trace.crossed.insert(trace.crossed.end(), fan.crossed.begin(), fan.crossed.end());
    end_on_boundary(trace, fan.corner, 0, length);
    return true;
  }

  // A trace that runs into a source meets the trace which starts there and has not moved yet.
  bool arrive_at_source(int t, int corner, int direction, std::int64_t length)
  {
    Fan_position fan{corner, (direction + 2) & 3, {}};
    // the way back runs inside the sector of the corner or along its second edge
    if(position_in_sector(m_map, fan.corner, fan.direction) == Sector_position::OUTSIDE
       && !step_counterclockwise(m_map, fan))
      return false;
    for(int other : m_sources[m_source_of_vertex[m_mesh.source(corner)]].trace)
      if(other >= 0 && m_traces[other].start_corner == fan.corner
         && m_traces[other].start_direction == fan.direction)
      {
        Trace& trace = m_traces[t];
        if(m_traces[other].end != Trace::End::NONE)
          return false;
        trace.crossed.insert(trace.crossed.end(), fan.crossed.begin(), fan.crossed.end());
        join(t, other, 0, length);
        return true;
      }
    return false;
  }

  // A trace that ends at the vertex of `corner` does not block others there.
  void close_segments(int t, int corner, std::int64_t length)
  {
    m_mesh.for_each_outgoing(m_mesh.source(corner), [&](int c)
    {
      for(Segment& segment : m_segments[Working_mesh::face(c)])
      {
        const int across = across_axis(segment.direction);
        if(segment.trace == t && segment.end == infinity
           && segment.origin[across] == m_map.coordinates[c][across]
           && position(segment.origin, segment.direction, m_map.coordinates[c]) == length)
          segment.end = length;
      }
    });
  }

  const Seamless_map& m_map;
  const Working_mesh& m_mesh;
  std::vector<std::vector<Segment> > m_segments;     // per face
  std::vector<Source> m_sources;
  std::vector<int> m_source_of_vertex;
  std::vector<std::vector<Passage> > m_passages;     // per vertex
  std::vector<Trace> m_traces;
  std::vector<Head> m_heads;
  typedef std::pair<std::int64_t, int> Queue_item;
  std::priority_queue<Queue_item, std::vector<Queue_item>, std::greater<Queue_item> > m_queue;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MOTORCYCLE_TRACER_H
