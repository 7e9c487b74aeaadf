// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_MESH_COMPONENT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_MESH_COMPONENT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Curve_segment.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/property_map.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A connected component of the input as a mesh of its own, with the curves of its boundary. The
// order of vertices and faces is that of the input.
template <typename Point, typename BoundaryCurveTraits>
struct Mesh_component
{
  typedef Point Point_3;
  typedef CGAL::Surface_mesh<Point_3> Mesh;
  typedef typename Mesh::Vertex_index Vertex_index;
  typedef typename Mesh::Halfedge_index Halfedge_index;
  typedef typename Mesh::Face_index Face_index;
  typedef typename Kernel_traits<Point>::Kernel::Vector_3 Vector_3;
  typedef Curve_segment<BoundaryCurveTraits> Segment;
  typedef typename Mesh::template Property_map<Halfedge_index, Segment> Halfedge_curve_map;
  typedef typename Mesh::template Property_map<Vertex_index, bool> Corner_map;
  typedef typename Mesh::template Property_map<Vertex_index, double> Size_map;
  typedef typename Mesh::template Property_map<Face_index, Vector_3> Direction_map;

  Mesh mesh;
  Halfedge_curve_map segments; // of the halfedges along the boundary with their face in the mesh
  Corner_map corners;          // the corners of the boundary
  Size_map sizes;              // wanted edge lengths of the quads
  Direction_map directions;    // wanted directions of the quads, zero for none

  Mesh_component()
    : segments(mesh.template add_property_map<Halfedge_index, Segment>("h:segment").first)
    , corners(mesh.template add_property_map<Vertex_index, bool>("v:corner", false).first)
    , sizes(mesh.template add_property_map<Vertex_index, double>("v:size").first)
    , directions(mesh.template add_property_map<Face_index, Vector_3>("f:direction").first)
  {}
  Mesh_component(const Mesh_component&) = delete;
  Mesh_component& operator=(const Mesh_component&) = delete;
};

// Copies the connected components of a triangle mesh.
template <typename TriangleMesh, typename VertexPointMap, typename BoundaryCurveTraits>
class Component_splitter
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::face_descriptor face_descriptor;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point_3;
  typedef typename boost::property_map<TriangleMesh,
            dynamic_face_property_t<std::size_t> >::const_type Face_component_map;
  typedef typename boost::property_map<TriangleMesh,
            dynamic_vertex_property_t<std::size_t> >::const_type Vertex_position_map;

public:
  typedef Mesh_component<Point_3, BoundaryCurveTraits> Component;

  Component_splitter(const TriangleMesh& tm, const VertexPointMap& vpm)
    : m_tm(tm)
    , m_vpm(vpm)
    , m_component(get(dynamic_face_property_t<std::size_t>(), tm))
    , m_position(get(dynamic_vertex_property_t<std::size_t>(), tm))
    , m_number_of_components(label_components())
  {
    std::size_t n = 0;
    for(const vertex_descriptor v : vertices(tm))
      put(m_position, v, n++);
  }

  std::size_t number_of_components() const { return m_number_of_components; }

  // copies component `i`; `is_corner(v)` tells the corners of the boundary, `size(v)` the quad
  // size, and `direction(f)` the wanted direction of the quads.
  template <typename HalfedgeCurveMap, typename IsCorner, typename Size, typename Direction>
  void copy(std::size_t i, const HalfedgeCurveMap& curves, const IsCorner& is_corner,
            const Size& size, const Direction& direction, Component& component) const
  {
    std::vector<typename Component::Vertex_index> copied(num_vertices(m_tm));
    std::vector<bool> is_copied(copied.size(), false);
    for(const face_descriptor f : faces(m_tm))
      if(get(m_component, f) == i)
        for(const vertex_descriptor v : vertices_around_face(halfedge(f, m_tm), m_tm))
          is_copied[get(m_position, v)] = true;
    for(const vertex_descriptor v : vertices(m_tm))
      if(const std::size_t p = get(m_position, v); is_copied[p])
      {
        copied[p] = component.mesh.add_vertex(get(m_vpm, v));
        component.corners[copied[p]] = is_corner(v);
        component.sizes[copied[p]] = size(v);
      }
    for(const face_descriptor f : faces(m_tm))
      if(get(m_component, f) == i)
        component.directions[component.mesh.add_face(vertices_of(f, copied))] = direction(f);
    copy_segments(i, curves, copied, component);
  }

private:
  std::size_t label_components() const
  {
    std::size_t n = 0;
    for(const face_descriptor f : faces(m_tm))
      put(m_component, f, unlabelled);
    for(const face_descriptor f : faces(m_tm))
      if(get(m_component, f) == unlabelled)
        flood(f, n++);
    return n;
  }

  void flood(face_descriptor seed, std::size_t label) const
  {
    std::vector<face_descriptor> stack(1, seed);
    put(m_component, seed, label);
    while(!stack.empty())
    {
      const face_descriptor f = stack.back();
      stack.pop_back();
      for(const halfedge_descriptor h : halfedges_around_face(halfedge(f, m_tm), m_tm))
      {
        if(is_border(opposite(h, m_tm), m_tm))
          continue;
        const face_descriptor g = face(opposite(h, m_tm), m_tm);
        if(get(m_component, g) == unlabelled)
        {
          put(m_component, g, label);
          stack.push_back(g);
        }
      }
    }
  }

  template <typename VertexIndex>
  std::vector<VertexIndex> vertices_of(face_descriptor f,
                                       const std::vector<VertexIndex>& copied) const
  {
    std::vector<VertexIndex> corners;
    for(const vertex_descriptor v : vertices_around_face(halfedge(f, m_tm), m_tm))
      corners.push_back(copied[get(m_position, v)]);
    return corners;
  }

  template <typename HalfedgeCurveMap, typename VertexIndex>
  void copy_segments(std::size_t i, const HalfedgeCurveMap& curves,
                     const std::vector<VertexIndex>& copied, Component& component) const
  {
    for(const halfedge_descriptor h : halfedges(m_tm))
      if(!is_border(h, m_tm) && is_border(opposite(h, m_tm), m_tm)
         && get(m_component, face(h, m_tm)) == i)
        component.segments[component.mesh.halfedge(copied[get(m_position, source(h, m_tm))],
                                                   copied[get(m_position, target(h, m_tm))])]
          = get(curves, h);
  }

  static constexpr std::size_t unlabelled = static_cast<std::size_t>(-1);

  const TriangleMesh& m_tm;
  VertexPointMap m_vpm;
  Face_component_map m_component;
  Vertex_position_map m_position;
  std::size_t m_number_of_components;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_MESH_COMPONENT_H
