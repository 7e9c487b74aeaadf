// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_QUAD_NEIGHBORS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_QUAD_NEIGHBORS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/T_NURCC_surface_3.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/compatibility.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// How the quads of the layout under a surface hang together, read off its control mesh: quads are
/// neighbours where faces of the control mesh are that lie in them.
template <typename K>
class Quad_neighbor_finder
{
  typedef typename T_NURCC_surface_3<K>::Control_mesh Mesh;
  typedef typename Mesh::Face_index Face;
  typedef typename Mesh::Halfedge_index Halfedge;

public:
  explicit Quad_neighbor_finder(const T_NURCC_surface_3<K>& surface)
    : m_mesh(surface.control_mesh()),
      m_origin(*find_property_map<Face, Face_origin>(m_mesh, "f:origin")),
      m_corner(*find_property_map<Halfedge, bool>(m_mesh, "h:corner"))
  {}

  Quad_neighbors operator()() const
  {
    Quad_neighbors result;
    for(Face f : m_mesh.faces())
      if(m_origin[f].kind == Face_origin::PATCH)
      {
        if(result.size() <= m_origin[f].quad)
          result.resize(m_origin[f].quad + 1, no_neighbors());
        add_face(f, result);
      }
    return result;
  }

private:
  typedef std::pair<std::size_t, int> Side;

  static std::array<Side, 4> no_neighbors()
  {
    std::array<Side, 4> result;
    result.fill(Side(NO_INDEX, 0));
    return result;
  }

  // a face of the same quad is across, unless the halfedge lies on a side of the quad
  void add_face(Face f, Quad_neighbors& neighbors) const
  {
    int side = 0;
    const Halfedge first = m_mesh.halfedge(f);
    Halfedge h = first;
    do
    {
      const Halfedge opposite = m_mesh.opposite(h);
      if(is_on_side_of_quad(f, side) && !m_mesh.is_border(opposite)
         && m_origin[m_mesh.face(opposite)].kind == Face_origin::PATCH)
        neighbors[m_origin[f].quad][side]
          = Side(m_origin[m_mesh.face(opposite)].quad, side_of(opposite));
      if(m_corner[h])
        ++side;
      h = m_mesh.next(h);
    }
    while(h != first);
  }

  bool is_on_side_of_quad(Face f, int side) const
  {
    const Face_origin& r = m_origin[f];
    const int axis = (side + 1) & 1;
    return (side == 1 || side == 2) ? to_parameter(r.last[axis]) == 1
                                    : to_parameter(r.first[axis]) == 0;
  }

  // the side of its face on which a halfedge lies
  int side_of(Halfedge h) const
  {
    int side = 0;
    for(Halfedge g = m_mesh.halfedge(m_mesh.face(h)); g != h; g = m_mesh.next(g))
      if(m_corner[g])
        ++side;
    return side;
  }

  const Mesh& m_mesh;
  typename Mesh::template Property_map<Face, Face_origin> m_origin;
  typename Mesh::template Property_map<Halfedge, bool> m_corner;
};

template <typename K>
Quad_neighbors quad_neighbors(const T_NURCC_surface_3<K>& surface)
{
  return Quad_neighbor_finder<K>(surface)();
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_QUAD_NEIGHBORS_H
