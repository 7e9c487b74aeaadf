// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_REFINEMENT_CLOSURE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_REFINEMENT_CLOSURE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Face_search.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_junction_extensions.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Refines a T-mesh by bisecting faces, such that the result is analysis-suitable and graded:
//  - a face of a 0-channel has no T-vertex: row 1 is split together with row 0;
//  - the splits of the boundary are carried one bay inwards;
//  - neighboring intervals of row 0 differ at most by a factor of two, a side of a face has at most
//    two parts, and a face is at most eight times as long as wide;
//  - the patch at a convex corner is a square;
//  - around an extraordinary point, the closed two-ring has equal intervals and no T-vertex: where
//    this does not hold, the ring is quadrisected;
//  - extensions of T-junctions do not cross: one of the two is extended by one bay.
// All rules only split faces, down to the finest size there is, hence the process ends.
template <typename Point>
class Refinement_closure
{
  typedef T_mesh<Point> Mesh;
  typedef typename Mesh::Vertex Vertex;
  typedef typename Mesh::Halfedge Halfedge;
  typedef typename Mesh::Face Face;
  typedef std::pair<Face, int> Mark; // a face, and the axis along which it is cut in two

  static constexpr std::int64_t maximum_aspect = 8;

public:
  // `units` holds, for every vertex, the interval of its ring if it is extraordinary, else zero
  Refinement_closure(Mesh& mesh, std::vector<std::int64_t>& units) : m_mesh(mesh), m_units(units)
  {
    m_units.resize(mesh.mesh().num_vertices(), 0);
    for(Vertex v : mesh.mesh().vertices())
      if(mesh.is_extraordinary(v) && m_units[v] == 0)
        m_units[v] = rounded_parameter(mesh.length(mesh.mesh().halfedge(v)));
  }

  // marks a face to be bisected; `axis` is the one whose interval is halved
  void mark(Face f, int axis)
  {
    if(size(f, axis) > 1)
      m_marks.emplace_back(f, axis);
  }

  // bisects the marked faces and restores all rules; \pre the mesh is up to date
  void run()
  {
    do
    {
      apply_marks();
      mark_channels();
      mark_boundary_grading();
      mark_patches();
      mark_extraordinary_points();
      if(m_marks.empty())
        mark_crossings();
    }
    while(!m_marks.empty());
  }

private:
  std::int64_t size(Face f, int axis) const { return rounded_parameter(m_mesh.extent(f, axis)); }
  std::int64_t size(Halfedge h) const { return rounded_parameter(m_mesh.length(h)); }

  void apply_marks()
  {
    std::sort(m_marks.begin(), m_marks.end());
    m_marks.erase(std::unique(m_marks.begin(), m_marks.end()), m_marks.end());
    for(std::size_t i = 0; i < m_marks.size(); ++i)
    {
      const bool is_double = i + 1 < m_marks.size() && m_marks[i + 1].first == m_marks[i].first;
      const std::array<Face, 2> parts = m_mesh.bisect(m_marks[i].first, m_marks[i].second);
      if(is_double)
      {
        ++i;
        for(Face f : parts)
          m_mesh.bisect(f, m_marks[i].second);
      }
    }
    m_marks.clear();
    m_mesh.update();
  }

  // the number of parts of positive length of a side
  int parts_of_side(Face f, int side) const
  {
    int parts = 0;
    for(Halfedge h : m_mesh.mesh().halfedges_around_face(m_mesh.halfedge(f)))
      if(m_mesh.side(h) == side && size(h) > 0)
        ++parts;
    return parts;
  }

  void mark_channels()
  {
    for(Face f : m_mesh.mesh().faces())
      if(m_mesh.origin(f).kind == Face_origin::CHANNEL && parts_of_side(f, 2) > 1)
        mark(f, 0);
  }

  void mark_boundary_grading()
  {
    for(Halfedge h : m_mesh.mesh().halfedges())
      if(m_mesh.is_border(m_mesh.opposite(h)) && size(h) > 0)
      {
        Halfedge g = h; // the next edge of positive length along the boundary
        do
          g = m_mesh.opposite(m_mesh.prev(m_mesh.opposite(g)));
        while(size(g) == 0);
        if(size(h) > 2 * size(g))
          mark(m_mesh.face(h), 0);
        if(size(g) > 2 * size(h))
          mark(m_mesh.face(g), 0);
      }
  }

  void mark_patches()
  {
    for(Face f : m_mesh.mesh().faces())
    {
      if(m_mesh.origin(f).kind == Face_origin::CORNER)
        mark_convex_corner(f);
      if(!m_mesh.is_patch(f))
        continue;
      for(int axis = 0; axis < 2; ++axis)
        if(size(f, axis) > maximum_aspect * size(f, 1 - axis))
          mark(f, axis);
      for(int side = 0; side < 4; ++side)
      {
        // a patch on the boundary follows the intervals of row 1
        if(parts_of_side(f, side) > (is_on_channel(f, side) ? 1 : 2))
          mark(f, side & 1);
      }
    }
  }

  bool is_on_channel(Face f, int side) const
  {
    return m_mesh.origin(m_mesh.face(m_mesh.opposite(m_mesh.first_of_side(f, side)))).kind
           == Face_origin::CHANNEL;
  }

  void mark_convex_corner(Face corner)
  {
    for(Halfedge h : m_mesh.mesh().halfedges_around_face(m_mesh.halfedge(corner)))
    {
      // of its four vertices, only the one on row 1 has four edges
      const auto& star = m_mesh.star(m_mesh.source(h));
      if(star.is_border)
        continue;
      for(int d = 0; d < 4; ++d)
      {
        const Face f = m_mesh.face(star.out[d]);
        if(m_mesh.is_patch(f) && size(f, 0) != size(f, 1))
          mark(f, size(f, 0) > size(f, 1) ? 0 : 1);
      }
    }
  }

  void mark_extraordinary_points()
  {
    for(std::size_t i = 0; i < m_units.size(); ++i)
      if(m_units[i] != 0)
      {
        const Vertex v = Vertex(typename Mesh::Mesh::size_type(i));
        if(is_region_fine(v) && !is_ring_regular(v))
        {
          m_units[i] /= 2;
          is_region_fine(v);
        }
      }
  }

  // checks that the intervals are not larger than the unit within four units of the extraordinary
  // point (its closed two-ring before the unit was halved), and marks the faces where they are
  bool is_region_fine(Vertex v)
  {
    const std::int64_t unit = m_units[v];
    if(unit == rounded_parameter(unit_ticks))
      return true;
    const Ticks extent = (4 * unit) << parameter_bits;
    bool is_fine = true;
    Face_search<Point> search(m_mesh);
    for(Halfedge h : m_mesh.mesh().halfedges_around_target(m_mesh.mesh().halfedge(v)))
      for(const auto& placement : search(m_mesh.opposite(h), 0, {{extent, extent}}))
        for(int axis = 0; axis < 2; ++axis)
          if(size(placement.face, axis) > unit)
          {
            mark(placement.face, axis);
            is_fine = false;
          }
    return is_fine;
  }

  // checks the closed two-ring of an extraordinary point
  bool is_ring_regular(Vertex v) const
  {
    for(Halfedge h : m_mesh.mesh().halfedges_around_target(m_mesh.mesh().halfedge(v)))
      for(Halfedge g : m_mesh.mesh().halfedges_around_face(h))
        for(Halfedge e : m_mesh.mesh().halfedges_around_target(g))
          if(!m_mesh.is_border(e) && !is_face_regular(m_mesh.face(e), m_units[v]))
            return false;
    return true;
  }

  bool is_face_regular(Face f, std::int64_t unit) const
  {
    const Face_origin::Kind kind = m_mesh.origin(f).kind;
    if(kind == Face_origin::CORNER)
      return true;
    if(size(f, 0) != unit || (kind == Face_origin::PATCH && size(f, 1) != unit))
      return false;
    for(Halfedge h : m_mesh.mesh().halfedges_around_face(m_mesh.halfedge(f)))
      if(!m_mesh.is_corner(h) || m_mesh.star(m_mesh.target(h)).is_T)
        return false;
    return true;
  }

  // extends T-junctions until no two extensions cross; those that wait for another one in this
  // round are left alone
  void mark_crossings()
  {
    const T_junction_extensions<Point> extensions(m_mesh);
    const auto& junctions = extensions.junctions();
    std::vector<std::size_t> order;
    for(std::size_t i = 0; i < junctions.size(); ++i)
      if(!junctions[i].crossings.empty())
        order.push_back(i);
    // The T-junction on the coarsest edge first: its extension soon ends in the coarse part, whereas
    // a fine one could be pushed ahead of another through the whole refined part.
    auto key = [&](std::size_t i)
    {
      const Halfedge h = m_mesh.star(junctions[i].vertex).into[junctions[i].direction];
      const Face f = m_mesh.face(h);
      const int axis = m_mesh.side(h) & 1;
      return std::make_tuple(-size(f, axis), -size(f, 1 - axis),
                             -static_cast<std::int64_t>(junctions[i].crossings.size()));
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return key(i) < key(j); });
    std::vector<bool> is_settled(junctions.size(), false);
    for(std::size_t i : order)
    {
      const auto& junction = junctions[i];
      const bool do_extend = is_extensible(junction);
      bool is_waiting = is_settled[i];
      for(std::size_t j : junction.crossings)
        if(!do_extend && is_extensible(junctions[j]))
          is_waiting = true;
      if(is_waiting)
        continue;
      // the line above a corner on a regular vertex can only be shortened
      const Halfedge h = m_mesh.star(junction.vertex).into[junction.direction];
      const int axis = m_mesh.side(h) & 1;
      mark(m_mesh.face(h), do_extend ? axis : 1 - axis);
      for(std::size_t j : junction.crossings)
        is_settled[j] = true;
    }
  }

  // is the T-junction in the middle of the side of a patch?
  bool is_extensible(const typename T_junction_extensions<Point>::T_junction& junction) const
  {
    const Halfedge h = m_mesh.star(junction.vertex).into[junction.direction];
    const std::int64_t position = rounded_parameter(m_mesh.offset(h) + m_mesh.length(h));
    return 0 < position && position < size(m_mesh.face(h), m_mesh.side(h) & 1);
  }

  Mesh& m_mesh;
  std::vector<std::int64_t>& m_units;
  std::vector<Mark> m_marks;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_REFINEMENT_CLOSURE_H
