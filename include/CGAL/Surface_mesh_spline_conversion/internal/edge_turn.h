// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EDGE_TURN_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EDGE_TURN_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/boost/graph/helpers.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// how much a mesh turns at an edge
struct Edge_turn
{
  double angle = 0;   // between the normals of both faces
  double sagitta = 0; // the distance between a facet and the arc that turns as much, see below
};

// returns the turn of an edge, which is zero at the boundary. With the heights h1 and h2 of both
// faces over the edge and the angle a between their normals, the arc has the curvature
// 2 a / (h1 + h2), and its chord the length h1 or h2.
template <typename TriangleMesh, typename VertexPointMap>
Edge_turn edge_turn(typename boost::graph_traits<TriangleMesh>::halfedge_descriptor h,
                    const TriangleMesh& tm, const VertexPointMap& vpm)
{
  Edge_turn result;
  const auto o = opposite(h, tm);
  if(is_border(h, tm) || is_border(o, tm))
    return result;
  const Eigen::Vector3d p = to_eigen(get(vpm, source(h, tm)));
  const Eigen::Vector3d edge = to_eigen(get(vpm, target(h, tm))) - p;
  const auto normal = [&](const auto& g, double sign)
  {
    const Eigen::Vector3d apex = to_eigen(get(vpm, target(next(g, tm), tm))) - p;
    return Eigen::Vector3d(sign * edge.cross(apex));
  };
  const Eigen::Vector3d n1 = normal(h, 1), n2 = normal(o, -1);
  result.angle = std::atan2(n1.cross(n2).norm(), n1.dot(n2));
  const double h1 = n1.norm() / edge.norm(), h2 = n2.norm() / edge.norm();
  if(h1 + h2 > 0)
    result.sagitta = result.angle * std::pow((std::max)(h1, h2), 2) / (4 * (h1 + h2));
  return result;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EDGE_TURN_H
