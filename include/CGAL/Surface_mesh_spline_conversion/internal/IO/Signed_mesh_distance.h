// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_SIGNED_MESH_DISTANCE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_SIGNED_MESH_DISTANCE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/compatibility.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>

#include <CGAL/Named_function_parameters.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The distance of points from a triangle mesh, negative on the side opposite to the normal of the
// closest face.
template <typename TriangleMesh, typename NamedParameters>
class Signed_mesh_distance
{
  typedef typename GetGeomTraits<TriangleMesh, NamedParameters>::type Geom_traits;
  typedef typename Geom_traits::Point_3 Point_3;
  typedef typename Geom_traits::Vector_3 Vector_3;
  typedef typename GetVertexPointMap<TriangleMesh, NamedParameters>::const_type VPM;
  typedef AABB_face_graph_triangle_primitive<TriangleMesh, VPM> Primitive;
  typedef AABB_tree<internal::AABB_traits_3<Geom_traits, Primitive> > Tree;

public:
  Signed_mesh_distance(const TriangleMesh& tm, const NamedParameters& np)
    : m_tm(tm),
      m_vpm(parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                         get_const_property_map(vertex_point, tm))),
      m_tree(faces(tm).begin(), faces(tm).end(), tm, m_vpm)
  {}

  std::vector<double> of_points(const std::vector<std::array<double, 3> >& points) const
  {
    std::vector<double> result(points.size(), 0.);
    if(m_tree.empty())
      return result;
    for(std::size_t i = 0; i < points.size(); ++i)
      result[i] = of_point(Point_3(points[i][0], points[i][1], points[i][2]));
    return result;
  }

private:
  double of_point(const Point_3& p) const
  {
    const auto closest = m_tree.closest_point_and_primitive(p);
    const auto h = halfedge(closest.second, m_tm);
    const Point_3& a = get(m_vpm, source(h, m_tm));
    const Point_3& b = get(m_vpm, target(h, m_tm));
    const Point_3& c = get(m_vpm, target(next(h, m_tm), m_tm));
    const Vector_3 offset = p - closest.first, normal = cross_product(b - a, c - a);
    const double distance = std::sqrt(CGAL::to_double(offset.squared_length()));
    return (offset * normal < 0) ? -distance : distance;
  }

  const TriangleMesh& m_tm;
  VPM m_vpm;
  Tree m_tree;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_SIGNED_MESH_DISTANCE_H
