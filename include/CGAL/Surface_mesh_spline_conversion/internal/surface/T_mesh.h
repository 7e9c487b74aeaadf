// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_MESH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_MESH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/cubic_B_spline.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// tells where a face of the T-mesh lies: in a quad of the layout, or in a 0-channel
struct Face_origin
{
  enum Kind { PATCH, CHANNEL, CORNER };

  Kind kind = PATCH;
  std::size_t quad = 0;
  int side = 0;                               // of the quad, for the 0-channel along it
  std::array<Ticks, 2> first = {{0, 0}};      // rectangle in the quad; in a channel: first[0] to
  std::array<Ticks, 2> last = {{0, 0}};       // last[0] along the side, first[1] = 0, last[1] = 1

  bool operator==(const Face_origin& o) const
  {
    return kind == o.kind && quad == o.quad && side == o.side && first == o.first && last == o.last;
  }
};

// The control T-mesh: a half-edge mesh in which T-vertices are ordinary vertices. The corners of a
// face are marked at its halfedges, every edge has a length in ticks, and `halfedge(f)` is the
// first halfedge of side 0 of the face `f`, whose local frame it defines.
//
// The part below "Frames" is a cache that is brought up to date after splits: by `update_frames()`
// as far as the splits reach, by `update()` as a whole.
template <typename Point>
class T_mesh
{
public:
  typedef CGAL::Surface_mesh<Point> Mesh;
  typedef typename Mesh::Vertex_index Vertex;
  typedef typename Mesh::Halfedge_index Halfedge;
  typedef typename Mesh::Edge_index Edge;
  typedef typename Mesh::Face_index Face;

  // directions at a vertex are numbered 0 to 3 counter clockwise
  struct Star
  {
    std::array<Halfedge, 4> out;     // outgoing edges
    std::array<Halfedge, 4> into;    // where out is missing: halfedge of the face to be crossed
    std::array<std::array<Ticks, 2>, 4> interval; // the next two knot intervals
    int quarter_turns = 0;           // sum of the angles at the vertex, 4 unless at the boundary
    bool is_border = false;
    bool is_T = false;               // lies inside a side of a face

    // returns `true` if the edges, where the faces to be crossed lie, and the knots are the same
    bool has_knots_of(const Star& s) const
    {
      return out == s.out && into == s.into && interval == s.interval;
    }
  };

  T_mesh() { add_properties(); }

  T_mesh(const T_mesh& other) { *this = other; }

  T_mesh& operator=(const T_mesh& other)
  {
    if(this == &other)
      return *this;
    m_mesh = other.m_mesh;
    add_properties(); // binds the maps to the properties copied with the mesh
    m_side = other.m_side;
    m_offset = other.m_offset;
    m_direction = other.m_direction;
    m_star = other.m_star;
    m_changed = other.m_changed;
    return *this;
  }

  Mesh& mesh() { return m_mesh; }
  const Mesh& mesh() const { return m_mesh; }

  bool is_corner(Halfedge h) const { return m_corner[h]; }
  void set_corner(Halfedge h, bool is_corner) { m_corner[h] = is_corner; }
  Ticks length(Halfedge h) const { return m_length[m_mesh.edge(h)]; }
  void set_length(Halfedge h, Ticks length) { m_length[m_mesh.edge(h)] = length; }
  const Face_origin& origin(Face f) const { return m_origin[f]; }
  void set_origin(Face f, const Face_origin& origin) { m_origin[f] = origin; }
  bool is_patch(Face f) const { return m_origin[f].kind == Face_origin::PATCH; }

  // width (axis 0) or height (axis 1) of a face
  Ticks extent(Face f, int axis) const { return m_origin[f].last[axis] - m_origin[f].first[axis]; }

  Halfedge opposite(Halfedge h) const { return m_mesh.opposite(h); }
  Halfedge next(Halfedge h) const { return m_mesh.next(h); }
  Halfedge prev(Halfedge h) const { return m_mesh.prev(h); }
  Vertex target(Halfedge h) const { return m_mesh.target(h); }
  Vertex source(Halfedge h) const { return m_mesh.source(h); }
  Face face(Halfedge h) const { return m_mesh.face(h); }
  Halfedge halfedge(Face f) const { return m_mesh.halfedge(f); }
  bool is_border(Halfedge h) const { return m_mesh.is_border(h); }

  // the next halfedge counter clockwise with the same source
  Halfedge rotated(Halfedge h) const { return opposite(prev(h)); }

  // returns the first halfedge of a side of a face
  Halfedge first_of_side(Face f, int side) const
  {
    Halfedge h = halfedge(f);
    for(; side > 0; h = next(h))
      if(m_corner[h])
        --side;
    return h;
  }

  /// \name Splits

  // splits `h` at the distance `offset` from its source; the part of `h` up to the new vertex is a
  // new halfedge, which is returned
  Halfedge split_edge(Halfedge h, Ticks offset)
  {
    CGAL_precondition(0 < offset && offset < length(h));
    const Halfedge o = opposite(h);
    const Ticks rest = length(h) - offset;
    const bool is_corner_of_opposite = m_corner[o];
    const Point p = CGAL::midpoint(m_mesh.point(source(h)), m_mesh.point(target(h)));
    const bool starts_face = !is_border(h) && halfedge(face(h)) == h;
    for(Halfedge side : {h, o})
      if(!is_border(side))
        m_changed.push_back(face(side));
    const Halfedge first = CGAL::Euler::split_edge(h, m_mesh);
    m_mesh.point(target(first)) = p;
    set_length(first, offset);
    set_length(h, rest);
    m_corner[first] = false;
    m_corner[opposite(h)] = false;
    m_corner[opposite(first)] = is_corner_of_opposite;
    if(starts_face)
      m_mesh.set_halfedge(face(first), first);
    return first;
  }

  // returns the halfedge of the side that ends at the distance `offset` from the start of the side,
  // and splits an edge if there is none
  Halfedge vertex_on_side(Face f, int side, Ticks offset)
  {
    Halfedge h = first_of_side(f, side);
    while(length(h) < offset)
    {
      offset -= length(h);
      h = next(h);
    }
    return length(h) == offset ? h : split_edge(h, offset);
  }

  // the distance of the parametric midpoint of a face from its side 3 (axis 0) or 0 (axis 1)
  Ticks middle(Face f, int axis) const
  {
    const Face_origin& r = m_origin[f];
    const std::int64_t sum = rounded_parameter(r.first[axis]) + rounded_parameter(r.last[axis]);
    return (Ticks(sum) << (parameter_bits - 1)) - r.first[axis];
  }

  // splits the face at the middle of its width (axis 0) or height (axis 1); the new edge ends at
  // existing vertices where there are some, else in the middle of edges. Returns both parts.
  std::array<Face, 2> bisect(Face f, int axis)
  {
    const Ticks offset = middle(f, axis);
    const Halfedge h1 = vertex_on_side(f, axis, offset);
    const Halfedge h2 = vertex_on_side(f, axis + 2, extent(f, axis) - offset);
    const Face_origin r = m_origin[f];
    const Halfedge reference = halfedge(f);

    const Halfedge h3 = CGAL::Euler::split_face(h1, h2, m_mesh);
    const Halfedge h4 = opposite(h3);
    set_length(h3, r.last[1 - axis] - r.first[1 - axis]);
    for(Halfedge h : {h1, h2, h3, h4})
      m_corner[h] = true;

    Face_origin r1 = r, r2 = r;
    r1.last[axis] = r2.first[axis] = r.first[axis] + offset;
    const Face f1 = face(h3), f2 = face(h4);
    m_origin[f1] = r1;
    m_origin[f2] = r2;
    m_mesh.set_halfedge(f1, reference);
    m_mesh.set_halfedge(f2, axis == 0 ? next(h4) : h4);
    m_changed.insert(m_changed.end(), {f1, f2});
    return {{f1, f2}};
  }

  /// \name Frames
  /// valid after update(), all but the knot intervals after update_frames(), too

  // brings the frames of all faces and vertices and the knot intervals up to date
  void update()
  {
    m_changed.assign(m_mesh.faces().begin(), m_mesh.faces().end());
    update_frames();
    update_intervals();
  }

  // brings the frames of faces and vertices up to date, and returns the faces that have changed, in
  // ascending order
  std::vector<Face> update_frames()
  {
    m_side.resize(m_mesh.num_halfedges(), 0);
    m_offset.resize(m_mesh.num_halfedges(), 0);
    m_direction.resize(m_mesh.num_halfedges(), 0);
    m_star.resize(m_mesh.num_vertices());
    std::vector<Face> faces;
    faces.swap(m_changed);
    remove_duplicates(faces);
    std::vector<Vertex> vertices;
    for(Face f : faces)
    {
      update_sides(f);
      for(Vertex v : m_mesh.vertices_around_face(halfedge(f)))
        vertices.push_back(v);
    }
    remove_duplicates(vertices);
    for(Vertex v : vertices)
      update_star(v);
    return faces;
  }

  // brings the knot intervals up to date; \pre the frames are
  void update_intervals()
  {
    for(Vertex v : m_mesh.vertices())
      if(!is_extraordinary(v))
        for(int d = 0; d < 4; ++d)
          m_star[v].interval[d] = intervals(v, d);
  }

  int side(Halfedge h) const { return m_side[h]; }
  Ticks offset(Halfedge h) const { return m_offset[h]; }   // of the source, along the side
  int direction(Halfedge h) const { return m_direction[h]; } // at the source, if regular
  const Star& star(Vertex v) const { return m_star[v]; }
  bool is_extraordinary(Vertex v) const
  {
    return !m_star[v].is_border && m_star[v].quarter_turns != 4;
  }

  bool is_extraordinary_face(Face f) const
  {
    for(Halfedge h : m_mesh.halfedges_around_face(halfedge(f)))
      if(m_corner[h] && is_extraordinary(target(h)))
        return true;
    return false;
  }

  // the vertices of the faces around the extraordinary corners of `f`, in ascending order: those
  // whose functions are no products of two splines on `f`
  std::vector<Vertex> extraordinary_neighbors(Face f) const
  {
    std::vector<Vertex> result;
    for(Halfedge h : m_mesh.halfedges_around_face(halfedge(f)))
      if(m_corner[h] && is_extraordinary(target(h)))
        for(Halfedge g : m_mesh.halfedges_around_target(h))
          for(Vertex v : m_mesh.vertices_around_face(g))
            result.push_back(v);
    remove_duplicates(result);
    return result;
  }

  // position of the source of `h` in the frame of its face
  std::array<Ticks, 2> local_source(Halfedge h) const
  {
    return local_position(face(h), m_side[h], m_offset[h]);
  }

  // the point at the distance `x` from the start of a side
  std::array<Ticks, 2> local_position(Face f, int side, Ticks x) const
  {
    const Ticks width = extent(f, 0), height = extent(f, 1);
    switch(side)
    {
      case 0: return {{x, 0}};
      case 1: return {{width, x}};
      case 2: return {{width - x, height}};
      default: return {{0, height - x}};
    }
  }

  // the next two knot intervals at the source of `h` along `h`, also if the source is extraordinary
  std::array<Ticks, 2> intervals_along(Halfedge h) const
  {
    const Vertex v = source(h);
    if(!is_extraordinary(v))
      return m_star[v].interval[m_direction[h]];
    Ray ray;
    No_observer none;
    arrive(h, ray, none);
    const Ticks first = length(h);
    return {{first, advance(ray, none)}};
  }

  // follows the knot line that leaves `v` in `direction` over `steps` knot intervals. The observer
  // is told of the faces it cuts (with the axis of the face that is cut), the edges it runs along,
  // the edges it crosses in their interior, and the vertices it meets (with its direction there).
  template <typename Observer>
  void follow(Vertex v, int direction, int steps, Observer& observer) const
  {
    Ray ray;
    ray.vertex = v;
    ray.direction = direction;
    for(int i = 0; i < steps && !ray.is_at_end; ++i)
      advance(ray, observer);
  }

  // checks that faces have four corners, and opposite sides the lengths of their rectangles
  bool is_valid() const
  {
    for(Face f : m_mesh.faces())
    {
      std::array<Ticks, 4> sum = {{0, 0, 0, 0}};
      int corners = 0;
      for(Halfedge h : m_mesh.halfedges_around_face(halfedge(f)))
      {
        if(corners == 4 || length(h) <= 0)
          return false;
        sum[corners] += length(h);
        corners += m_corner[h] ? 1 : 0;
      }
      if(corners != 4 || sum[0] != extent(f, 0) || sum[2] != extent(f, 0)
         || sum[1] != extent(f, 1) || sum[3] != extent(f, 1))
        return false;
    }
    return m_mesh.is_valid();
  }

private:
  // a place on a knot line: a vertex and a direction, or a point inside an edge of a face
  struct Ray
  {
    Vertex vertex;
    int direction = 0;
    Halfedge edge;       // if valid: the ray enters the face of this halfedge ...
    Ticks position = 0;  // ... at this distance from the start of its side
    bool is_at_end = false;
    Ticks last = 0;      // the interval crossed before
  };

  struct No_observer
  {
    void on_face(Face, int) {}
    void on_edge(Halfedge) {}
    void on_crossing(Halfedge) {}
    void on_vertex(Vertex, int) {}
  };

  void add_properties()
  {
    m_corner = m_mesh.template add_property_map<Halfedge, bool>("h:corner", false).first;
    m_length = m_mesh.template add_property_map<Edge, Ticks>("e:length", 0).first;
    m_origin = m_mesh.template add_property_map<Face, Face_origin>("f:origin").first;
  }

  template <typename Index>
  static void remove_duplicates(std::vector<Index>& indices)
  {
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  }

  void update_sides(Face f)
  {
    int side = 0;
    Ticks offset = 0;
    for(Halfedge h : m_mesh.halfedges_around_face(halfedge(f)))
    {
      m_side[h] = side;
      m_offset[h] = offset;
      offset += length(h);
      if(m_corner[h])
      {
        ++side;
        offset = 0;
      }
    }
  }

  void update_star(Vertex v)
  {
    Star star;
    Halfedge first = opposite(m_mesh.halfedge(v));
    Halfedge h = first;
    do // at the boundary, begin with the edge that has no face to its right
    {
      if(is_border(opposite(h)))
      {
        star.is_border = true;
        first = h;
      }
      h = rotated(h);
    }
    while(h != first && !star.is_border);
    fill_star(star, first);
    m_star[v] = star;
  }

  void fill_star(Star& star, Halfedge first)
  {
    int d = 0;
    Halfedge h = first;
    do
    {
      m_direction[h] = d & 3;
      if(d < 4)
        star.out[d] = h;
      if(is_border(h))
        break;
      const bool is_corner = m_corner[prev(h)];
      if(!is_corner)
      {
        star.is_T = true;
        if(d < 3)
          star.into[d + 1] = prev(h);
      }
      d += is_corner ? 1 : 2;
      h = rotated(h);
    }
    while(h != first);
    star.quarter_turns = d;
  }

  std::array<Ticks, 2> intervals(Vertex v, int direction) const
  {
    Ray ray;
    ray.vertex = v;
    ray.direction = direction;
    std::array<Ticks, 2> result;
    No_observer none;
    for(Ticks& interval : result)
      interval = advance(ray, none);
    return result;
  }

  // moves the ray to the next knot line and returns the interval; behind an extraordinary point
  // the last interval is repeated, outside of the surface the intervals are zero
  template <typename Observer>
  Ticks advance(Ray& ray, Observer& observer) const
  {
    if(ray.is_at_end)
      return ray.last;
    if(ray.edge.is_valid())
      return cross(ray.edge, ray.position, ray, observer);
    const Star& star = m_star[ray.vertex];
    const Halfedge h = star.out[ray.direction];
    if(h.is_valid())
    {
      arrive(h, ray, observer);
      return length(h);
    }
    const Halfedge g = star.into[ray.direction];
    if(!g.is_valid())
      return end(ray, 0);
    return cross(g, m_offset[g] + length(g), ray, observer);
  }

  Ticks end(Ray& ray, Ticks last) const
  {
    ray.is_at_end = true;
    return ray.last = last;
  }

  // sets the ray to the target of `h`, straight on
  template <typename Observer>
  void arrive(Halfedge h, Ray& ray, Observer& observer) const
  {
    observer.on_edge(h);
    ray.vertex = target(h);
    ray.edge = Halfedge();
    if(is_extraordinary(ray.vertex))
      end(ray, length(h));
    else
    {
      ray.direction = (m_direction[opposite(h)] + 2) & 3;
      observer.on_vertex(ray.vertex, ray.direction);
    }
  }

  // crosses the face of `h` from the point at `position` on the side of `h`
  template <typename Observer>
  Ticks cross(Halfedge h, Ticks position, Ray& ray, Observer& observer) const
  {
    const Face f = face(h);
    const int axis = m_side[h] & 1;
    observer.on_face(f, axis);
    Ticks rest = extent(f, axis) - position; // on the opposite side, which runs the other way
    Halfedge g = h;
    while(m_side[g] != ((m_side[h] + 2) & 3))
      g = next(g);
    while(length(g) < rest)
    {
      rest -= length(g);
      g = next(g);
    }
    ray.edge = Halfedge();
    if(length(g) == rest)
    {
      ray.vertex = target(g);
      ray.direction = (m_direction[next(g)] + 3) & 3;
      observer.on_vertex(ray.vertex, ray.direction);
    }
    else
    {
      const Halfedge o = opposite(g);
      observer.on_crossing(g);
      if(is_border(o))
        end(ray, 0);
      else
      {
        ray.edge = o;
        ray.position = m_offset[o] + length(g) - rest;
      }
    }
    return extent(f, 1 - axis);
  }

  Mesh m_mesh;
  typename Mesh::template Property_map<Halfedge, bool> m_corner;
  typename Mesh::template Property_map<Edge, Ticks> m_length;
  typename Mesh::template Property_map<Face, Face_origin> m_origin;
  std::vector<int> m_side;
  std::vector<Ticks> m_offset;
  std::vector<int> m_direction;
  std::vector<Star> m_star;
  std::vector<Face> m_changed; // faces whose frames are out of date
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_MESH_H
