// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_NORMAL_ANGLES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_NORMAL_ANGLES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Knot_vector.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Deviation_statistics.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>

#include <CGAL/number_type_config.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// where an oriented edge lies on the boundary of its face
struct Edge_on_face
{
  int side;      ///< of the parameter rectangle, counter clockwise from the lower one
  double offset; ///< of its begin on the side, counter clockwise
  double length;

  /// the parameters at the fraction `t` of the edge in the direction of the loop
  template <typename K>
  std::array<double, 2> parameters(const B_spline_surface_3<K>& surface, double t) const
  {
    const int axis = side & 1;
    const auto &along = surface.knots[axis].knots(), &across = surface.knots[1 - axis].knots();
    const double s = offset + t * length;
    std::array<double, 2> result;
    result[axis] = CGAL::to_double(side < 2 ? along.front() + s : along.back() - s);
    result[1 - axis]
      = CGAL::to_double((side == 1 || side == 2) ? across.back() : across.front());
    return result;
  }
};

/// The places of the edges of a face. Along each side the parameter intervals of its edges add up
/// to that of the face.
template <typename K>
std::vector<Edge_on_face> places_of_edges(const NURBS_shell_3<K>& shell, std::size_t f)
{
  const auto& face = shell.face(f);
  auto side_length = [&face](int side)
  {
    const auto& knots = face.surface.knots[side & 1].knots();
    return CGAL::to_double(knots.back() - knots.front());
  };
  std::vector<Edge_on_face> result;
  Edge_on_face place = {0, 0, 0};
  for(const auto& e : face.loop)
  {
    const auto& curve = shell.edge(e.edge).curve;
    place.length = CGAL::to_double(curve.last() - curve.first());
    if(place.offset + place.length / 2 > side_length(place.side) && place.side < 3)
    {
      ++place.side;
      place.offset = 0;
    }
    result.push_back(place);
    place.offset += place.length;
  }
  return result;
}

/// the fractions of a curve that divide each of its spans into `n` intervals
template <typename FT>
std::vector<double> fractions_of_spans(const Knot_vector<FT>& knots, int n)
{
  const std::vector<FT>& breaks = knots.knots();
  const double first = CGAL::to_double(breaks.front());
  const double extent = CGAL::to_double(breaks.back()) - first;
  std::vector<double> result(1, 0);
  for(std::size_t k = 0; k + 1 < breaks.size(); ++k)
  {
    const double low = (CGAL::to_double(breaks[k]) - first) / extent;
    const double high = (CGAL::to_double(breaks[k + 1]) - first) / extent;
    for(int i = 1; i <= n; ++i)
      result.push_back(low + (high - low) * i / n);
  }
  return result;
}

/// the unit normals of a face at fractions of an edge, in the direction of the edge; zero where
/// there is none
template <typename K>
std::vector<Eigen::Vector3d> normals_along_edge(const B_spline_surface_3<K>& surface,
                                                const Edge_on_face& place, bool is_forward,
                                                const std::vector<double>& fractions)
{
  std::vector<Eigen::Vector3d> result;
  for(double t : fractions)
  {
    const std::array<double, 2> uv = place.parameters(surface, is_forward ? t : 1 - t);
    const auto d = surface.derivatives(uv[0], uv[1], 1);
    result.push_back(to_eigen(d[1][0]).cross(to_eigen(d[0][1])).stableNormalized());
  }
  return result;
}

/// angles between normals, in degrees
struct Normal_angles
{
  Deviation_statistics creases; ///< on lines above corners
  Deviation_statistics others;
  std::vector<Eigen::Vector3d> violations; ///< the worst place of each edge with more than the bound
};

/// The angles between the normals of adjacent faces at samples of their edges.
/// \param bound in degrees
template <typename K>
Normal_angles normal_angles(const NURBS_shell_3<K>& shell, double bound)
{
  constexpr int INTERVALS_OF_A_SPAN = 8;
  std::vector<std::vector<Eigen::Vector3d> > first(shell.number_of_edges());
  Normal_angles result;
  result.creases.bound = result.others.bound = bound;
  for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
  {
    const std::vector<Edge_on_face> places = places_of_edges(shell, f);
    for(std::size_t i = 0; i < places.size(); ++i)
    {
      const auto& use = shell.face(f).loop[i];
      if(shell.is_border(use.edge))
        continue;
      const B_spline_curve_3<K>& curve = shell.edge(use.edge).curve;
      const std::vector<double> fractions = fractions_of_spans(curve.knots, INTERVALS_OF_A_SPAN);
      const std::vector<Eigen::Vector3d> normals
        = normals_along_edge(shell.face(f).surface, places[i], use.is_forward, fractions);
      if(first[use.edge].empty())
      {
        first[use.edge] = normals;
        continue;
      }
      Deviation_statistics edge;
      for(std::size_t k = 0; k < fractions.size(); ++k)
      {
        const Eigen::Vector3d &a = first[use.edge][k], &b = normals[k];
        const double angle = std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / CGAL_PI;
        const auto t = curve.first() + (curve.last() - curve.first()) * fractions[k];
        const Eigen::Vector3d p = to_eigen(curve.point(t));
        edge.add(angle, p);
        (shell.is_crease(use.edge) ? result.creases : result.others).add(angle, p);
      }
      if(edge.maximum > bound)
        result.violations.push_back(edge.worst);
      first[use.edge] = std::vector<Eigen::Vector3d>();
    }
  }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_NORMAL_ANGLES_H
