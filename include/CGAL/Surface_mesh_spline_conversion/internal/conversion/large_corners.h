// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_LARGE_CORNERS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_LARGE_CORNERS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/format_number.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_type_config.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Is a vertex a corner of the boundary with an interior angle above a full turn? The surface has at
// most two quads at a corner (paper, Fig. 6(b)). Each of them is regular only if the angle between
// its two derivatives there is below a straight one, hence two of them fill less than a full turn.
//
// `Network`: a `Boundary_curve_network_3` of the mesh of the vertex
template <typename Vertex, typename Network>
bool is_large_corner(Vertex v, const Network& network)
{
  return network.is_corner(v) && CGAL::to_double(network.corner_angle(v)) >= 2 * CGAL_PI;
}

// returns how many folds of the surface are not next to such a corner: smaller quads may be without
// them. `size_map`: from the vertices of the mesh to the wanted size of the quads
template <typename TriangleMesh, typename VertexPointMap, typename Network, typename SizeMap,
          typename Point_3>
std::size_t number_of_avoidable_folds(const TriangleMesh& tm, const VertexPointMap& vpm,
                                      const Network& network, const SizeMap& size_map,
                                      const std::vector<Point_3>& folds)
{
  constexpr double reach = 0.1; // of the fold at a corner, in quads
  std::vector<std::pair<Point_3, double> > corners; // with the square of the reach
  for(const auto v : vertices(tm))
    if(is_large_corner(v, network))
    {
      const double distance = reach * CGAL::to_double(get(size_map, v));
      corners.emplace_back(get(vpm, v), distance * distance);
    }
  return std::size_t(std::count_if(folds.begin(), folds.end(), [&](const Point_3& fold)
  {
    return std::none_of(corners.begin(), corners.end(), [&](const auto& corner)
      { return CGAL::squared_distance(corner.first, fold) < corner.second; });
  }));
}

// Warns of those corners.
template <typename TriangleMesh, typename VertexPointMap, typename Network>
void warn_about_large_corners(const TriangleMesh& tm, const VertexPointMap& vpm,
                              const Network& network, Conversion_report& report)
{
  for(const auto v : vertices(tm))
  {
    if(!is_large_corner(v, network))
      continue;
    const double degrees = CGAL::to_double(network.corner_angle(v)) * 180 / CGAL_PI;
    const auto& p = get(vpm, v);
    report.warnings.push_back("the interior angle of the corner at ("
      + format_number(CGAL::to_double(p.x())) + ", " + format_number(CGAL::to_double(p.y())) + ", "
      + format_number(CGAL::to_double(p.z())) + ") is " + format_number(degrees) + " degrees: two "
      "quads cannot fill it, and next to the corner the surface is folded over, within the tolerances");
  }
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_LARGE_CORNERS_H
