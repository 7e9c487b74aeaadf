// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_MESH_EDITOR_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_MESH_EDITOR_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Collapses and flips edges of a working mesh without a change of its topology or of the chains at
// its boundary. Collapses leave gaps in the numbering, see `is_face()`; `compact()` closes them.
class Mesh_editor
{
public:
  // `is_kept`: per vertex, those that must not be removed; the first vertex of each chain is one
  Mesh_editor(Working_mesh& mesh, const std::vector<char>& is_kept)
    : m_mesh(mesh), m_is_kept(is_kept), m_is_face(mesh.number_of_faces(), 1)
  {}

  bool is_face(int f) const { return m_is_face[f] != 0; }
  bool is_vertex(int v) const { return m_mesh.vertex_halfedge[v] >= 0; }
  bool is_kept(int v) const { return m_is_kept[v] != 0; }

  int number_of_faces_around(int v) const
  {
    int n = 0;
    m_mesh.for_each_outgoing(v, [&n](int) { ++n; });
    return n;
  }

  // calls `function(w)` for the neighbours of a vertex
  template <typename Function>
  void for_each_neighbor(int v, Function function) const
  {
    int last = -1;
    m_mesh.for_each_outgoing(v, [&](int h) { function(m_mesh.target(h)); last = h; });
    const int incoming = Working_mesh::previous(last);
    if(m_mesh.is_border(incoming))
      function(m_mesh.source(incoming));
  }

  bool are_neighbors(int v, int w) const
  {
    bool result = false;
    for_each_neighbor(v, [&](int x) { result = result || x == w; });
    return result;
  }

  // May the edge of `h` be collapsed to its end other than `removed`? Boundary vertices move along
  // the boundary only, and no inner edge comes to join two of them.
  bool can_collapse(int h, int removed) const
  {
    const int remaining = m_mesh.source(h) == removed ? m_mesh.target(h) : m_mesh.source(h);
    const bool is_border_edge = m_mesh.is_border(h);
    if(is_kept(removed) || (m_mesh.is_border_vertex(removed) && !is_border_edge))
      return false;
    const int c = m_mesh.target(Working_mesh::next(h));
    const int d = is_border_edge ? -1 : m_mesh.target(Working_mesh::next(m_mesh.opposite[h]));
    if(c == d || !can_lose_face(c) || (d >= 0 && !can_lose_face(d)))
      return false;
    const bool is_remaining_at_border = m_mesh.is_border_vertex(remaining);
    bool is_legal = true;
    for_each_neighbor(removed, [&](int x)
    {
      if(x == remaining || x == c || x == d)
        return;
      const bool joins_border = is_remaining_at_border && m_mesh.is_border_vertex(x)
                                && !m_mesh.is_border_vertex(removed);
      if(joins_border || are_neighbors(remaining, x))
        is_legal = false;
    });
    return is_legal;
  }

  // \pre `can_collapse(h, removed)`
  void collapse(int h, int removed)
  {
    if(m_mesh.is_border(h))
      collapse_border(h, removed);
    else
      collapse_inner(m_mesh.source(h) == removed ? h : m_mesh.opposite[h]);
    m_mesh.vertex_halfedge[removed] = -1;
  }

  bool can_flip(int h) const
  {
    if(m_mesh.is_border(h))
      return false;
    const int c = m_mesh.target(Working_mesh::next(h));
    const int d = m_mesh.target(Working_mesh::next(m_mesh.opposite[h]));
    return c != d && can_lose_face(m_mesh.source(h)) && can_lose_face(m_mesh.target(h))
           && !(m_mesh.is_border_vertex(c) && m_mesh.is_border_vertex(d)) && !are_neighbors(c, d);
  }

  // The edge of `h` becomes the other diagonal of its two faces; `next(h)` is the new edge.
  // \pre `can_flip(h)`
  void flip(int h)
  {
    const int o = m_mesh.opposite[h];
    const int n = Working_mesh::next(h), m = Working_mesh::next(o);
    const int a = m_mesh.source(h), b = m_mesh.target(h);
    const int c = m_mesh.target(n), d = m_mesh.target(m);
    move_edge(m, h);
    move_edge(n, o);
    m_mesh.link(n, m);
    m_mesh.triangles[n / 3][n % 3] = d;
    m_mesh.triangles[m / 3][m % 3] = c;
    if(m_mesh.vertex_halfedge[a] == m)
      m_mesh.vertex_halfedge[a] = h;
    if(m_mesh.vertex_halfedge[b] == n)
      m_mesh.vertex_halfedge[b] = o;
  }

  int split(int h)
  {
    const int v = m_mesh.split_edge(h);
    m_is_face.resize(m_mesh.number_of_faces(), 1);
    m_is_kept.push_back(0);
    return v;
  }

  // Renumbers vertices and faces; `old_vertex[v]` is the former number of vertex `v`.
  void compact(std::vector<int>& old_vertex)
  {
    Working_mesh result;
    std::vector<int> new_vertex(m_mesh.number_of_vertices(), -1), new_face(m_is_face.size(), -1);
    std::vector<char> is_kept;
    old_vertex.clear();
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(is_vertex(v))
      {
        new_vertex[v] = result.number_of_vertices();
        old_vertex.push_back(v);
        result.points.push_back(m_mesh.points[v]);
        result.is_corner.push_back(m_mesh.is_corner[v]);
        is_kept.push_back(m_is_kept[v]);
      }
    int number_of_faces = 0;
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
      if(is_face(f))
        new_face[f] = number_of_faces++;
    const auto moved = [&new_face](int h) { return h < 0 ? -1 : 3 * new_face[h / 3] + h % 3; };
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
      if(is_face(f))
      {
        result.parent.push_back(result.triangles.size());
        result.triangles.push_back(m_mesh.triangles[f]);
        for(int i = 0; i < 3; ++i)
        {
          result.triangles.back()[i] = new_vertex[m_mesh.triangles[f][i]];
          result.opposite.push_back(moved(m_mesh.opposite[3 * f + i]));
          result.boundary_piece.push_back(m_mesh.boundary_piece[3 * f + i]);
        }
      }
    for(const int v : old_vertex)
      result.vertex_halfedge.push_back(moved(m_mesh.vertex_halfedge[v]));
    m_mesh = std::move(result);
    m_is_kept = std::move(is_kept);
    m_is_face.assign(m_mesh.number_of_faces(), 1);
  }

private:
  // three faces remain around inner vertices, two at the boundary
  bool can_lose_face(int v) const
  {
    return number_of_faces_around(v) > (m_mesh.is_border_vertex(v) ? 2 : 3);
  }

  void rename(int v, int w)
  {
    m_mesh.for_each_outgoing(v, [&](int h) { m_mesh.triangles[h / 3][h % 3] = w; });
  }

  // `to` takes over the place of the halfedge `from` in the mesh
  void move_edge(int from, int to)
  {
    const int o = m_mesh.opposite[from];
    m_mesh.boundary_piece[to] = m_mesh.boundary_piece[from];
    m_mesh.boundary_piece[from] = Working_mesh::Boundary_piece();
    if(o < 0)
      m_mesh.opposite[to] = -1;
    else
      m_mesh.link(to, o);
  }

  // removes the face of `h`, whose ends have become one: its other two edges fall together
  void close_face(int h)
  {
    const int n = Working_mesh::next(h), p = Working_mesh::previous(h);
    const int on = m_mesh.opposite[n], op = m_mesh.opposite[p];
    const int c = m_mesh.source(p);
    if(on >= 0 && op >= 0)
      m_mesh.link(on, op);
    else
    {
      const int remaining = on >= 0 ? on : op;
      m_mesh.opposite[remaining] = -1;
      m_mesh.boundary_piece[remaining] = m_mesh.boundary_piece[on >= 0 ? p : n];
    }
    if(m_mesh.vertex_halfedge[c] == p)
      m_mesh.vertex_halfedge[c] = on >= 0 ? on : Working_mesh::next(op);
    m_is_face[h / 3] = 0;
  }

  // removes the source of `h`, an inner vertex
  void collapse_inner(int h)
  {
    const int o = m_mesh.opposite[h], b = m_mesh.target(h);
    const int n = Working_mesh::next(h);
    const int to_third = m_mesh.opposite[Working_mesh::previous(h)];
    int& outgoing = m_mesh.vertex_halfedge[b];
    if(outgoing == n || outgoing == o)
      outgoing = to_third;
    rename(m_mesh.source(h), b);
    close_face(h);
    close_face(o);
  }

  // removes one end of the boundary edge `h`; the next boundary edge takes over its piece
  void collapse_border(int h, int removed)
  {
    const int a = m_mesh.source(h), b = m_mesh.target(h);
    const int n = Working_mesh::next(h);
    const int to_third = m_mesh.opposite[Working_mesh::previous(h)];
    const Working_mesh::Boundary_piece piece = m_mesh.boundary_piece[h];
    int outgoing = m_mesh.vertex_halfedge[b];
    if(outgoing == n)
      outgoing = to_third;
    const int before = incoming_border(a);
    rename(removed, removed == a ? b : a);
    close_face(h);
    m_mesh.vertex_halfedge[removed == a ? b : a] = outgoing;
    if(removed == b)
      m_mesh.boundary_piece[outgoing].first = piece.first;
    else
      m_mesh.boundary_piece[before == Working_mesh::previous(h) ? m_mesh.opposite[n] : before].last
        = piece.last;
  }

  int incoming_border(int v) const
  {
    int last = -1;
    m_mesh.for_each_outgoing(v, [&last](int h) { last = h; });
    return Working_mesh::previous(last);
  }

  Working_mesh& m_mesh;
  std::vector<char> m_is_kept;
  std::vector<char> m_is_face;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_MESH_EDITOR_H
