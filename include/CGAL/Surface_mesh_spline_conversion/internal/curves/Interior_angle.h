// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_INTERIOR_ANGLE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_INTERIOR_ANGLE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>

#include <cmath>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Measures the angle of the mesh at a boundary vertex between the tangents of the boundary curves.
//
// This is the sum of the angles of the faces at the vertex, corrected by the angles between the
// boundary edges, which are chords of the curves, and the tangents. The latter are measured in the
// planes of the first and the last face.
template <typename TriangleMesh, typename VertexPointMap>
class Interior_angle
{
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_descriptor;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point_3;
  typedef typename Kernel_traits<Point_3>::Kernel::Vector_3 Vector_3;
  typedef typename Kernel_traits<Point_3>::Kernel::FT FT;

public:
  Interior_angle(const TriangleMesh& tm, const VertexPointMap& vpm) : m_tm(tm), m_vpm(vpm) {}

  // `incoming` and `outgoing` are consecutive halfedges of a loop; the tangents point along it.
  FT operator()(halfedge_descriptor incoming, halfedge_descriptor outgoing,
                const Vector_3& incoming_tangent, const Vector_3& outgoing_tangent) const
  {
    FT sum = signed_angle(outgoing_tangent, direction(outgoing), normal(outgoing));
    // counter clockwise through the faces at the common vertex
    halfedge_descriptor h = outgoing;
    for(;;)
    {
      const halfedge_descriptor last = prev(h, m_tm);
      const Vector_3 a = direction(h), b = -direction(last);
      sum += std::atan2(std::sqrt(cross_product(a, b).squared_length()), a * b);
      if(last == incoming)
        break;
      h = opposite(last, m_tm);
    }
    return sum + signed_angle(-direction(incoming), -incoming_tangent, normal(incoming));
  }

private:
  Vector_3 direction(halfedge_descriptor h) const
  {
    return get(m_vpm, target(h, m_tm)) - get(m_vpm, source(h, m_tm));
  }

  Vector_3 normal(halfedge_descriptor h) const
  {
    return cross_product(direction(h), direction(next(h, m_tm)));
  }

  // returns the angle from a to b, projected to the plane with this normal.
  static FT signed_angle(const Vector_3& a, const Vector_3& b, const Vector_3& normal)
  {
    const Vector_3 n = normal / std::sqrt(normal.squared_length());
    return std::atan2(cross_product(a, b) * n, a * b - (a * n) * (b * n));
  }

  const TriangleMesh& m_tm;
  const VertexPointMap& m_vpm;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_INTERIOR_ANGLE_H
