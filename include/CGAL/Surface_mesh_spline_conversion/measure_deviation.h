// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_MEASURE_DEVIATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_MEASURE_DEVIATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/boundary_band.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Boundary_deviation.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Interior_deviation.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Mesh_distance.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Normal_net.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/normal_angles.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is how far a shell is from a mesh and from the curves at its boundary: the result of
`measure_deviation()`. Lengths are in model units.

\tparam K a model of `Kernel`
*/
template <typename K>
struct Deviation
{
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;

  FT boundary_maximum = 0;        ///< largest distance between boundary and curves, both ways
  FT boundary_mean = 0;           ///< their mean
  Point_3 boundary_worst;         ///< where it is largest
  std::size_t worst_chain = 0;    ///< the chain of the network where it is largest
  FT worst_arc_length = 0;        ///< the place on this chain
  FT corner_maximum = 0;          ///< largest distance of a corner from the boundary's vertices

  FT interior_maximum = 0;        ///< largest distance between surface and mesh, both ways
  FT interior_mean = 0;           ///< their mean
  FT fraction_within = 1;         ///< share of the samples that keep the interior tolerance
  Point_3 interior_worst;         ///< where it is largest
  std::vector<Point_3> interior_violations; ///< where it exceeds the interior tolerance: the worst
                                            ///< place of each polynomial piece of the shell

  FT normal_angle_maximum = 0;    ///< largest angle between normals across an edge, in degrees
  Point_3 normal_angle_worst;     ///< where it is largest
  std::vector<Point_3> normal_violations; ///< where it exceeds one degree: the worst place of each
                                          ///< edge
  std::size_t faces_against_mesh = 0; ///< faces that look the other way than the mesh
  std::vector<Point_3> folds;         ///< the middle of their polynomial pieces that do
  std::vector<Point_3> piece_folds;   ///< a place in each polynomial piece that is folded over,
                                      ///< however small the fold is
};

namespace internal {

// See measure_deviation() below. `band`: the width of the band along the boundary. `limit`:
// deviations of the interior are violations above it, which need not be the tolerance.
template <typename K, typename TriangleMesh, typename VertexPointMap, typename BoundaryCurveNetwork>
void measure_shell(const NURBS_shell_3<K>& shell, const TriangleMesh& tm, const VertexPointMap& vpm,
                   const BoundaryCurveNetwork& network, double band, double tolerance,
                   double limit, Deviation<K>& deviation)
{
  constexpr double LARGEST_ANGLE = 1; // in degrees
  auto point = [](const Eigen::Vector3d& p) { return typename K::Point_3(p.x(), p.y(), p.z()); };

  const Boundary_deviation boundary = boundary_deviation(shell, network);
  deviation.boundary_maximum = boundary.statistics.maximum;
  deviation.boundary_mean = boundary.statistics.mean();
  deviation.boundary_worst = point(boundary.statistics.worst);
  deviation.worst_chain = boundary.chain;
  deviation.worst_arc_length = boundary.arc_length;
  deviation.corner_maximum = corner_deviation(shell, tm, vpm, network);

  const Mesh_distance mesh(tm, vpm, network);
  const std::vector<Bezier_piece> pieces = bezier_pieces(shell);
  Interior_deviation interior(pieces, mesh, band, tolerance, limit);
  interior.add_mesh(tm, vpm);
  deviation.interior_maximum = interior.statistics().maximum;
  deviation.interior_mean = interior.statistics().mean();
  deviation.fraction_within = interior.statistics().fraction_within();
  deviation.interior_worst = point(interior.statistics().worst);
  deviation.interior_violations.clear();
  for(const Eigen::Vector3d& p : interior.violations())
    deviation.interior_violations.push_back(point(p));
  deviation.faces_against_mesh = interior.number_of_faces_against_mesh();
  deviation.folds.clear();
  for(const Eigen::Vector3d& p : interior.folds())
    deviation.folds.push_back(point(p));
  deviation.piece_folds.clear();
  for(const Eigen::Vector3d& p : folds_of_pieces(pieces))
    deviation.piece_folds.push_back(point(p));

  const Normal_angles angles = normal_angles(shell, LARGEST_ANGLE);
  deviation.normal_angle_maximum = angles.statistics.maximum;
  deviation.normal_angle_worst = point(angles.statistics.worst);
  deviation.normal_violations.clear();
  for(const Eigen::Vector3d& p : angles.violations)
    deviation.normal_violations.push_back(point(p));
}

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

measures how far a shell is from the mesh it was made from.

The measurement shares no code with the fits. Boundary: points of the boundary edges of the shell
are projected on the curves, and points of the curves on the boundary edges. Interior: points of the
surface, as dense as the vertices of the mesh and with a search uphill from the largest values and
from creases of the mesh, are compared with the mesh, and the vertices and face centres of the mesh
with the surface. In a band along the boundary, where the mesh has chords and the surface has
curves, only what exceeds the gap between the nearest edges and their curves counts; in the outer
half of this band, as far as it is beyond the gap, what exceeds a part of the gap that falls to
nothing. All figures are maxima over samples, hence lower bounds.

\tparam K a model of `Kernel`
\tparam TriangleMesh a model of `FaceListGraph` and `VertexListGraph`
\tparam BoundaryCurveNetwork an instance of `Boundary_curve_network_3`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param shell the shell
\param tm the triangle mesh
\param network the curves of its boundary
\param deviation the result
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
       below

\cgalNamedParamsBegin
  \cgalParamNBegin{interior_tolerance}
    \cgalParamDescription{the deviation up to which a sample counts as within, in model units}
    \cgalParamType{a positive number}
    \cgalParamDefault{\f$ 10^{-3} \f$ times the diameter of the network}
  \cgalParamNEnd
  \cgalParamNBegin{boundary_band}
    \cgalParamDescription{the width of the band along the boundary, in model units}
    \cgalParamType{a number type convertible to `double`}
    \cgalParamDefault{three mean edge lengths of `tm`}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `tm`}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and
                    `%Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\pre `tm` has a face, and the network has no error
*/
template <typename K, typename TriangleMesh, typename BoundaryCurveNetwork,
          typename NamedParameters = parameters::Default_named_parameters>
void measure_deviation(const NURBS_shell_3<K>& shell, const TriangleMesh& tm,
                       const BoundaryCurveNetwork& network, Deviation<K>& deviation,
                       const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;

  constexpr double DEFAULT_RELATIVE_TOLERANCE = 1e-3;
  auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                              get_const_property_map(CGAL::vertex_point, tm));
  const double tolerance
    = CGAL::to_double(choose_parameter(get_parameter(np, internal_np::interior_tolerance),
                                       DEFAULT_RELATIVE_TOLERANCE * network.diameter()));
  internal::measure_shell(shell, tm, vpm, network, internal::boundary_band_width(np, tm, vpm),
                          tolerance, tolerance, deviation);
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_MEASURE_DEVIATION_H
