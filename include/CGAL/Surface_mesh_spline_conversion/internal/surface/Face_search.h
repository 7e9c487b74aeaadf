// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_FACE_SEARCH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_FACE_SEARCH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>

#include <algorithm>
#include <array>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Finds the faces of a T-mesh that overlap a rectangle which has a vertex as corner, by a search
// across edges that develops the faces into the frame of the rectangle.
template <typename Point>
class Face_search
{
  typedef T_mesh<Point> Mesh;
  typedef typename Mesh::Halfedge Halfedge;
  typedef typename Mesh::Face Face;
  typedef std::array<Ticks, 2> Position;

public:
  // a face in the frame of the rectangle: its origin and `turns` quarter turns
  struct Placement
  {
    Face face;
    int turns;
    Position origin;

    bool operator==(const Placement& p) const
    {
      return face == p.face && turns == p.turns && origin == p.origin;
    }
  };

  explicit Face_search(const Mesh& mesh) : m_mesh(mesh) {}

  // returns the faces that overlap [0, extent[0]] x [0, extent[1]]. The origin is the source of
  // `h`, `h` has the direction `turns`, and the face of `h` is the first one.
  const std::vector<Placement>& operator()(Halfedge h, int turns, const Position& extent)
  {
    m_queue.assign(1, place(h, turns, {{0, 0}}));
    for(std::size_t i = 0; i < m_queue.size(); ++i)
    {
      const Placement p = m_queue[i];
      for(Halfedge g : m_mesh.mesh().halfedges_around_face(m_mesh.halfedge(p.face)))
      {
        const Halfedge o = m_mesh.opposite(g);
        if(m_mesh.is_border(o))
          continue;
        const Position source = transformed(p, m_mesh.local_source(m_mesh.next(g)));
        const Placement q = place(o, (m_mesh.side(g) + p.turns + 2) & 3, source);
        // a face may occur more than once, in different places, on a short closed strip of faces
        if(overlaps(q, extent) && std::find(m_queue.begin(), m_queue.end(), q) == m_queue.end())
          m_queue.push_back(q);
      }
    }
    return m_queue;
  }

private:
  static Position turned(int turns, const Position& p)
  {
    switch(turns)
    {
      case 0: return p;
      case 1: return {{-p[1], p[0]}};
      case 2: return {{-p[0], -p[1]}};
      default: return {{p[1], -p[0]}};
    }
  }

  static Position transformed(const Placement& p, const Position& x)
  {
    const Position y = turned(p.turns, x);
    return {{p.origin[0] + y[0], p.origin[1] + y[1]}};
  }

  // places the face of `h` such that `h` begins at `source` and has the given direction
  Placement place(Halfedge h, int direction, const Position& source) const
  {
    Placement p;
    p.face = m_mesh.face(h);
    p.turns = (direction - m_mesh.side(h) + 4) & 3;
    const Position y = turned(p.turns, m_mesh.local_source(h));
    p.origin = {{source[0] - y[0], source[1] - y[1]}};
    return p;
  }

  bool overlaps(const Placement& p, const Position& extent) const
  {
    const Position end
      = transformed(p, {{m_mesh.extent(p.face, 0), m_mesh.extent(p.face, 1)}});
    for(int k = 0; k < 2; ++k)
      if((std::max)(p.origin[k], end[k]) <= 0 || (std::min)(p.origin[k], end[k]) >= extent[k])
        return false;
    return true;
  }

  const Mesh& m_mesh;
  std::vector<Placement> m_queue;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_FACE_SEARCH_H
