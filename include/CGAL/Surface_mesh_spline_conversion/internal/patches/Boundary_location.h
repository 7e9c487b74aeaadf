// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_BOUNDARY_LOCATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_BOUNDARY_LOCATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Finds the arc length of a point of the mesh that lies on the boundary.
template <typename TriangleMesh, typename Network>
class Boundary_location
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::face_descriptor face_descriptor;

public:
  Boundary_location(const TriangleMesh& tm, const Network& network)
    : m_mesh(tm), m_network(network), m_faces(faces(tm).begin(), faces(tm).end())
  {}

  // returns the arc length of a point on `chain`, or nothing if the point is not there
  template <typename Location>
  std::optional<double> operator()(std::size_t chain, const Location& location) const
  {
    // the barycentric coordinate i belongs to the target of h
    std::array<double, 3> b;
    for(std::size_t i = 0; i < 3; ++i)
      b[i] = CGAL::to_double(location.barycentric[i]);

    std::optional<double> result;
    double smallest = largest_barycentric_rounding;
    halfedge_descriptor h = halfedge(m_faces[location.face], m_mesh);
    for(std::size_t i = 0; i < 3; ++i, h = next(h, m_mesh))
    {
      if(b[(i + 1) % 3] <= smallest && is_on(h, chain))
      {
        smallest = b[(i + 1) % 3];
        result = on_edge(h, b[i] / (b[i] + b[(i + 2) % 3]));
      }
    }
    for(std::size_t i = 0; i < 3 && !result; ++i, h = next(h, m_mesh))
      if(b[i] >= 1 - largest_barycentric_rounding)
        result = at_vertex(h, chain);
    return result;
  }

private:
  // points of the boundary come from a map with coordinates that are rounded
  static constexpr double largest_barycentric_rounding = 1e-6;

  bool is_on(halfedge_descriptor h, std::size_t chain) const
  {
    return is_border(opposite(h, m_mesh), m_mesh)
           && m_network.chain_of(h).chain == chain;
  }

  double on_edge(halfedge_descriptor h, double t) const
  {
    const auto place = m_network.chain_of(h);
    const double first = CGAL::to_double(m_network.arc_length(place.chain, place.index));
    const double last = CGAL::to_double(m_network.arc_length(place.chain, place.index + 1));
    return first + t * (last - first);
  }

  // the point is the target of h, which may be the only vertex of its face on the boundary
  std::optional<double> at_vertex(halfedge_descriptor h, std::size_t chain) const
  {
    for(halfedge_descriptor g : halfedges_around_target(h, m_mesh))
      if(!is_border(g, m_mesh) && is_on(g, chain))
        return on_edge(g, 1);
    for(halfedge_descriptor g : halfedges_around_target(h, m_mesh))
      if(is_border(g, m_mesh) && is_on(opposite(g, m_mesh), chain))
        return on_edge(opposite(g, m_mesh), 0);
    return std::nullopt;
  }

  const TriangleMesh& m_mesh;
  const Network& m_network;
  std::vector<face_descriptor> m_faces;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_BOUNDARY_LOCATION_H
