// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MAKE_WORKING_MESH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MAKE_WORKING_MESH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/refine_working_mesh.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Copies a triangle mesh, with the boundary chains of its curve network, to a working mesh.
template <typename TriangleMesh, typename CurveNetwork, typename VertexPointMap>
class Working_mesh_builder
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::face_descriptor face_descriptor;

public:
  Working_mesh_builder(const TriangleMesh& tm, const CurveNetwork& network,
                       const VertexPointMap& vpm, Working_mesh& mesh)
    : m_tm(tm), m_network(network), m_vpm(vpm), m_mesh(mesh),
      m_vertex_index(get(dynamic_vertex_property_t<int>(), tm)),
      m_halfedge_index(get(dynamic_halfedge_property_t<int>(), tm))
  {}

  // `vertex[i]` is the vertex of `tm` at point `i`, for the vertices before any split
  Error_code build(std::vector<vertex_descriptor>& vertex)
  {
    m_mesh = Working_mesh();
    vertex.clear();
    for(const vertex_descriptor v : vertices(m_tm))
      put(m_vertex_index, v, -1);
    for(const halfedge_descriptor h : halfedges(m_tm))
      put(m_halfedge_index, h, -1);
    for(const face_descriptor f : faces(m_tm))
      if(!add_face(f, vertex))
        return Error_code::NON_TRIANGULAR_MESH;
    if(m_mesh.triangles.empty())
      return Error_code::EMPTY_MESH;
    connect();
    add_chains();
    return check();
  }

private:
  bool add_face(face_descriptor f, std::vector<vertex_descriptor>& vertex)
  {
    std::array<int, 3> triangle;
    int i = 0;
    for(const halfedge_descriptor h : halfedges_around_face(halfedge(f, m_tm), m_tm))
    {
      if(i == 3)
        return false;
      put(m_halfedge_index, h, 3 * m_mesh.number_of_faces() + i);
      triangle[i++] = vertex_index(source(h, m_tm), vertex);
    }
    m_mesh.parent.push_back(m_mesh.triangles.size());
    m_mesh.triangles.push_back(triangle);
    return i == 3;
  }

  // vertices without faces are left out
  int vertex_index(vertex_descriptor v, std::vector<vertex_descriptor>& vertex)
  {
    int index = get(m_vertex_index, v);
    if(index >= 0)
      return index;
    index = m_mesh.number_of_vertices();
    put(m_vertex_index, v, index);
    vertex.push_back(v);
    const auto& p = get(m_vpm, v);
    m_mesh.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                               CGAL::to_double(p.z()));
    m_mesh.is_corner.push_back(0);
    return index;
  }

  void connect()
  {
    m_mesh.opposite.assign(m_mesh.number_of_halfedges(), -1);
    m_mesh.boundary_piece.resize(m_mesh.number_of_halfedges());
    m_mesh.vertex_halfedge.assign(m_mesh.number_of_vertices(), -1);
    for(const halfedge_descriptor h : halfedges(m_tm))
      if(get(m_halfedge_index, h) >= 0)
        m_mesh.opposite[get(m_halfedge_index, h)] = get(m_halfedge_index, opposite(h, m_tm));
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
    {
      int& outgoing = m_mesh.vertex_halfedge[m_mesh.source(h)];
      if(outgoing < 0 || m_mesh.is_border(h))
        outgoing = h;
    }
  }

  void add_chains()
  {
    for(std::size_t c = 0; c < m_network.number_of_chains(); ++c)
    {
      const auto& chain = m_network.chain_halfedges(c);
      for(std::size_t i = 0; i < chain.size(); ++i)
      {
        const int h = get(m_halfedge_index, chain[i]);
        Working_mesh::Boundary_piece& piece = m_mesh.boundary_piece[h];
        piece.chain = c;
        piece.first = CGAL::to_double(m_network.arc_length(c, i));
        piece.last = CGAL::to_double(m_network.arc_length(c, i + 1));
        m_mesh.is_corner[m_mesh.source(h)] = m_network.is_corner(source(chain[i], m_tm));
      }
    }
  }

  Error_code check() const
  {
    // every corner belongs to the one fan of its vertex
    int corners = 0;
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      m_mesh.for_each_outgoing(v, [&corners](int) { ++corners; });
    if(corners != m_mesh.number_of_halfedges())
      return Error_code::NON_MANIFOLD_MESH;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.is_border(h) && m_mesh.boundary_piece[h].chain == Working_mesh::no_chain)
        return Error_code::INVALID_BOUNDARY_ASSOCIATION;
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      const double area = m_mesh.vector(3 * f).cross(m_mesh.vector(3 * f + 1)).norm();
      if(!(area > 0) || !std::isfinite(area))
        return Error_code::DEGENERATE_MESH;
    }
    return Error_code::OK;
  }

  const TriangleMesh& m_tm;
  const CurveNetwork& m_network;
  const VertexPointMap& m_vpm;
  Working_mesh& m_mesh;
  typename boost::property_map<TriangleMesh, dynamic_vertex_property_t<int> >::const_type
    m_vertex_index;
  typename boost::property_map<TriangleMesh, dynamic_halfedge_property_t<int> >::const_type
    m_halfedge_index;
};

// Creates the working mesh of `tm`, without ears. `vertex[i]` is the vertex of `tm` at point `i`.
template <typename TriangleMesh, typename CurveNetwork, typename VertexPointMap>
Error_code make_working_mesh(
  const TriangleMesh& tm, const CurveNetwork& network, const VertexPointMap& vpm,
  Working_mesh& mesh,
  std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor>& vertex)
{
  Working_mesh_builder<TriangleMesh, CurveNetwork, VertexPointMap> builder(tm, network, vpm, mesh);
  const Error_code code = builder.build(vertex);
  if(code == Error_code::OK)
    split_ears(mesh);
  return code;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MAKE_WORKING_MESH_H
