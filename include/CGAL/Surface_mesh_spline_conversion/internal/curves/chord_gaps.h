// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CHORD_GAPS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CHORD_GAPS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Returns the largest distance of the curve of a boundary edge from the edge, in model units: the
// *chord gap*. `h`: the halfedge of the edge in a loop of the network.
template <typename TriangleMesh, typename VertexPointMap, typename Network, typename Halfedge>
double chord_gap(const TriangleMesh& tm, const VertexPointMap& vpm, const Network& network,
                 Halfedge h)
{
  constexpr int number_of_intervals = 16;
  const auto place = network.chain_of(h);
  const auto& segment = network.curve_segment(place.chain, place.index);
  const auto point_on_curve = network.traits().construct_point_on_curve_3_object();
  const Eigen::Vector3d a = to_eigen(get(vpm, source(h, tm)));
  const Eigen::Vector3d d = to_eigen(get(vpm, target(h, tm))) - a;
  double gap = 0;
  for(int i = 1; i < number_of_intervals; ++i)
  {
    const auto t = segment.first + (segment.second - segment.first) * i / double(number_of_intervals);
    const Eigen::Vector3d r = to_eigen(point_on_curve(segment.curve, t)) - a;
    const double s = (std::min)(1., (std::max)(0., r.dot(d) / d.squaredNorm()));
    gap = (std::max)(gap, (r - s * d).norm());
  }
  return gap;
}

// Returns, for each edge of a loop, how far a surface may be from the mesh where this edge is the
// nearest one of the boundary: the largest chord gap of the edge and of the two on either side of
// it, as a quad of the layout may span a few edges.
inline std::vector<double> tolerated_gaps(const std::vector<double>& gaps)
{
  constexpr std::size_t number_of_neighbors = 2;
  const std::size_t n = gaps.size();
  std::vector<double> result = gaps;
  for(std::size_t i = 0; i < n; ++i)
    for(std::size_t k = 1; k <= number_of_neighbors; ++k)
      result[i] = (std::max)({result[i], gaps[(i + k) % n], gaps[(i + k * (n - 1)) % n]});
  return result;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CHORD_GAPS_H
