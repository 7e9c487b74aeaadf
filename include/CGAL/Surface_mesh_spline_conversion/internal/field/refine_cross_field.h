// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_REFINE_CROSS_FIELD_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_REFINE_CROSS_FIELD_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Cross_field.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The part of a face beyond the new vertex on `h` gets the frame and the angle of the face, so that
// turns and period jumps can be handed on unchanged, and are zero between the two parts.
inline void inherit_split(Cross_field& field, int h)
{
  const int f = h / 3, i = h % 3, g = static_cast<int>(field.axis.size());
  field.axis.push_back(field.axis[f]);
  field.angle.push_back(field.angle[f]);
  field.kappa.resize(field.kappa.size() + 3, 0.);
  field.period_jump.resize(field.period_jump.size() + 3, 0);
  const int outer = Working_mesh::next(h), moved = 3 * g + (i + 1) % 3;
  field.kappa[3 * g + i] = field.kappa[h];
  field.period_jump[3 * g + i] = field.period_jump[h];
  field.kappa[moved] = field.kappa[outer];
  field.period_jump[moved] = field.period_jump[outer];
  field.kappa[outer] = 0;
  field.period_jump[outer] = 0;
}

// Splits the edge of `h` at its midpoint; the field is the same as before. Returns the new vertex.
inline int split_edge(Cross_field& field, int h)
{
  Working_mesh& mesh = field.mesh;
  const int o = mesh.opposite[h];
  field.size.push_back((field.size[mesh.source(h)] + field.size[mesh.target(h)]) / 2);
  field.quarter_turns.push_back(o < 0 ? 2 : 4);
  const int v = mesh.split_edge(h);
  inherit_split(field, h);
  if(o >= 0)
    inherit_split(field, o);
  return v;
}

// Singularities and designated corners must become vertices of the layout.
inline bool is_critical(const Cross_field& field, int v)
{
  if(field.mesh.is_border_vertex(v))
    return field.mesh.is_corner[v] || field.quarter_turns[v] != 2;
  return field.quarter_turns[v] != 4;
}

// An edge between critical vertices would have to be an isoline or could not be stretched freely.
inline void split_edges_between_critical_vertices(Cross_field& field)
{
  std::vector<char> critical(field.mesh.number_of_vertices());
  for(int v = 0; v < field.mesh.number_of_vertices(); ++v)
    critical[v] = is_critical(field, v);
  std::vector<std::pair<int, int> > edges;
  for(int h = 0; h < field.mesh.number_of_halfedges(); ++h)
    if(field.mesh.opposite[h] > h && critical[field.mesh.source(h)]
       && critical[field.mesh.target(h)])
      edges.emplace_back(field.mesh.source(h), field.mesh.target(h));
  for(const std::pair<int, int>& e : edges)
    split_edge(field, field.mesh.find_halfedge(e.first, e.second));
}

// A vertex with many right angles needs enough triangles to unfold: splitting the edges opposite to
// it doubles their number.
inline void split_links_of_large_cones(Cross_field& field)
{
  const int n = field.mesh.number_of_vertices();
  for(int v = 0; v < n; ++v)
  {
    if(field.quarter_turns[v] < 5 || field.mesh.is_border_vertex(v))
      continue;
    std::vector<int> outgoing;
    field.mesh.for_each_outgoing(v, [&outgoing](int h) { outgoing.push_back(h); });
    if(static_cast<int>(outgoing.size()) >= 2 * (field.quarter_turns[v] - 1))
      continue;
    for(int h : outgoing)
      split_edge(field, Working_mesh::next(h));
  }
}

inline void refine_at_singularities(Cross_field& field)
{
  split_edges_between_critical_vertices(field);
  split_links_of_large_cones(field);
}

// Splits the edges of the faces around some vertices.
inline void refine_around(Cross_field& field, const std::vector<int>& vertices)
{
  std::vector<std::pair<int, int> > edges;
  std::vector<char> is_near(field.mesh.number_of_faces(), 0);
  for(int v : vertices)
    field.mesh.for_each_outgoing(v, [&](int h) { is_near[h / 3] = 1; });
  for(int h = 0; h < field.mesh.number_of_halfedges(); ++h)
    if(field.mesh.opposite[h] > h && (is_near[h / 3] || is_near[field.mesh.opposite[h] / 3]))
      edges.emplace_back(field.mesh.source(h), field.mesh.target(h));
  for(const std::pair<int, int>& e : edges)
    split_edge(field, field.mesh.find_halfedge(e.first, e.second));
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_REFINE_CROSS_FIELD_H
