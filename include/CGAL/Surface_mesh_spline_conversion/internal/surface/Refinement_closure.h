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
//  - row 0 has all knots of row 1, but may have more: its functions reach one bay inwards only;
//  - neighboring intervals of row 0 differ at most by a factor of two, a side of a patch has at
//    most two parts, and a patch is at most four times as long as wide;
//  - the faces around an extraordinary point, and the edges that leave them, have equal lengths or
//    the length zero, and no T-vertex: where this does not hold, these faces are quadrisected;
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

  static constexpr std::int64_t maximum_aspect = 4;

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

  // marks an edge of row 0 to be bisected, given by its halfedge inside
  void mark_boundary(Halfedge h)
  {
    if(size(h) > 1)
      m_boundary_marks.push_back(h);
  }

  bool has_marks() const { return !m_marks.empty() || !m_boundary_marks.empty(); }

  // bisects the marked faces and restores all rules; \pre the mesh is up to date
  void run()
  {
    apply_marks();
    m_mesh.update_frames();
    std::vector<Face> faces(m_mesh.mesh().faces().begin(), m_mesh.mesh().faces().end());
    while(mark_what_breaks_rules(faces))
    {
      apply_marks();
      faces = m_mesh.update_frames();
    }
    m_mesh.update_intervals();
  }

private:
  std::int64_t size(Face f, int axis) const { return rounded_parameter(m_mesh.extent(f, axis)); }
  std::int64_t size(Halfedge h) const { return rounded_parameter(m_mesh.length(h)); }

  // Returns `false` if there is nothing to be marked. `faces`: all that may break a rule by their
  // own sides.
  bool mark_what_breaks_rules(const std::vector<Face>& faces)
  {
    for(Face f : faces)
      if(m_mesh.is_patch(f))
        mark_patch(f);
      else if(m_mesh.origin(f).kind == Face_origin::CHANNEL && parts_of_side(f, 2) > 1)
        mark(f, 0);
    mark_boundary_grading();
    mark_extraordinary_points();
    if(!has_marks())
      mark_crossings();
    return has_marks();
  }

  void apply_marks()
  {
    split_boundary_edges();
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
  }

  void split_boundary_edges()
  {
    std::sort(m_boundary_marks.begin(), m_boundary_marks.end());
    m_boundary_marks.erase(std::unique(m_boundary_marks.begin(), m_boundary_marks.end()),
                           m_boundary_marks.end());
    for(Halfedge h : m_boundary_marks)
    {
      const Ticks begin = m_mesh.origin(m_mesh.face(h)).first[0] + m_mesh.offset(h);
      const std::int64_t sum
        = rounded_parameter(begin) + rounded_parameter(begin + m_mesh.length(h));
      m_mesh.split_edge(h, (Ticks(sum) << (parameter_bits - 1)) - begin);
    }
    m_boundary_marks.clear();
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
          mark_boundary(h);
        if(size(g) > 2 * size(h))
          mark_boundary(g);
      }
  }

  void mark_patch(Face f)
  {
    for(int axis = 0; axis < 2; ++axis)
      if(size(f, axis) > maximum_aspect * size(f, 1 - axis))
        mark(f, axis);
    for(int side = 0; side < 4; ++side)
      if(parts_of_side(f, side) > 2)
        mark(f, side & 1);
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

  // checks that the faces within two units of the extraordinary point (the faces around it before
  // the unit was halved) are not larger than the unit, and marks those that are
  bool is_region_fine(Vertex v)
  {
    const std::int64_t unit = m_units[v];
    if(unit == rounded_parameter(unit_ticks))
      return true;
    const Ticks extent = (2 * unit) << parameter_bits;
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

  // checks the faces around an extraordinary point and the edges that leave them
  bool is_ring_regular(Vertex v) const
  {
    for(Halfedge h : m_mesh.mesh().halfedges_around_target(m_mesh.mesh().halfedge(v)))
    {
      if(!is_square(m_mesh.face(h), m_units[v]))
        return false;
      for(Vertex w : m_mesh.mesh().vertices_around_face(h))
        if(!m_mesh.is_extraordinary(w) && !is_uniform(w, m_units[v]))
          return false;
    }
    return true;
  }

  bool is_square(Face f, std::int64_t unit) const
  {
    return size(f, 0) == unit && size(f, 1) == unit
           && m_mesh.mesh().degree(f) == 4;
  }

  // checks that the four edges have the length of the unit or lead across a 0-channel
  bool is_uniform(Vertex v, std::int64_t unit) const
  {
    const auto& star = m_mesh.star(v);
    if(star.is_T)
      return false;
    for(Halfedge h : star.out)
      if(size(h) != unit && size(h) != 0)
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
    // The T-junction on the coarsest edge first: its extension soon ends in the coarse part,
    // whereas a fine one could be pushed ahead of another through the whole refined part.
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
      const int rank = rank_of_extension(junction);
      bool is_waiting = is_settled[i];
      for(std::size_t j : junction.crossings)
        if(rank < rank_of_extension(junctions[j]))
          is_waiting = true;
      if(is_waiting)
        continue;
      if(rank == 0)
        shorten(junction);
      else
        extend(junction);
      for(std::size_t j : junction.crossings)
        is_settled[j] = true;
    }
  }

  typedef typename T_junction_extensions<Point>::T_junction T_junction;

  // Which of two T-junctions is to be extended? That of higher rank: 2 within a patch, 1 on row 0,
  // 0 if it belongs to a multiple knot at a corner, which cannot be extended.
  int rank_of_extension(const T_junction& junction) const
  {
    const Halfedge h = m_mesh.star(junction.vertex).into[junction.direction];
    const Face f = m_mesh.face(h);
    const std::int64_t position = rounded_parameter(m_mesh.offset(h) + m_mesh.length(h));
    if(position == 0 || position == size(f, m_mesh.side(h) & 1))
      return 0;
    return m_mesh.is_patch(f) ? 2 : 1;
  }

  void extend(const T_junction& junction)
  {
    const Halfedge h = m_mesh.star(junction.vertex).into[junction.direction];
    mark(m_mesh.face(h), m_mesh.side(h) & 1);
  }

  // halves the bay above a corner
  void shorten(const T_junction& junction)
  {
    Halfedge h = m_mesh.star(junction.vertex).into[junction.direction];
    if(!m_mesh.is_patch(m_mesh.face(h)))
      h = m_mesh.opposite(m_mesh.first_of_side(m_mesh.face(h), 2));
    mark(m_mesh.face(h), 1 - (m_mesh.side(h) & 1));
  }

  Mesh& m_mesh;
  std::vector<std::int64_t>& m_units;
  std::vector<Mark> m_marks;
  std::vector<Halfedge> m_boundary_marks;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_REFINEMENT_CLOSURE_H
