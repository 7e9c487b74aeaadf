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

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <utility>
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

  FT normal_angle_maximum = 0;    ///< largest angle between normals across an edge, in degrees, but
                                  ///< for the lines above corners
  FT crease_angle_maximum = 0;    ///< the same on the lines above corners; zero if there are none
  Point_3 normal_angle_worst;     ///< where the angle is largest
  std::vector<Point_3> normal_violations; ///< where it exceeds one degree: the worst place of each
                                          ///< edge
  std::size_t faces_against_mesh = 0; ///< faces that look the other way than the mesh
  std::vector<Point_3> folds;         ///< the middle of their polynomial pieces that do
  std::vector<Point_3> piece_folds;   ///< a place in each polynomial piece that is folded over,
                                      ///< however small the fold is
};

namespace internal {

// Measures surfaces on one mesh, see measure_deviation() below. What is known of a surface from the
// last measurement is not measured again.
template <typename TriangleMesh, typename VertexPointMap, typename BoundaryCurveNetwork>
class Deviation_meter
{
public:
  // `band`: the width of the band along the boundary. `limit`: deviations of the interior are
  // violations above it, which need not be the tolerance.
  Deviation_meter(const TriangleMesh& tm, const VertexPointMap& vpm,
                  const BoundaryCurveNetwork& network, double band, double tolerance, double limit)
    : m_tm(tm), m_vpm(vpm), m_network(network), m_mesh_distance(tm, vpm, network), m_band(band),
      m_tolerance(tolerance), m_limit(limit)
  {}

  // `pieces`: the polynomial pieces of the shell
  template <typename K>
  Deviation<K> operator()(const NURBS_shell_3<K>& shell, std::vector<Bezier_piece> pieces)
  {
    Deviation<K> result;
    measure_boundary(shell, result);
    for(const Eigen::Vector3d& p : folds_of_pieces(pieces))
      result.piece_folds.push_back(point<K>(p));
    measure_interior(std::move(pieces), result);
    measure_normals(shell, result);
    return result;
  }

private:
  template <typename K>
  static typename K::Point_3 point(const Eigen::Vector3d& p)
  {
    return typename K::Point_3(p.x(), p.y(), p.z());
  }

  template <typename K>
  void measure_boundary(const NURBS_shell_3<K>& shell, Deviation<K>& result) const
  {
    const Boundary_deviation boundary = boundary_deviation(shell, m_network);
    result.boundary_maximum = boundary.statistics.maximum;
    result.boundary_mean = boundary.statistics.mean();
    result.boundary_worst = point<K>(boundary.statistics.worst);
    result.worst_chain = boundary.chain;
    result.worst_arc_length = boundary.arc_length;
    result.corner_maximum = corner_deviation(shell, m_tm, m_vpm, m_network);
  }

  template <typename K>
  void measure_interior(std::vector<Bezier_piece> pieces, Deviation<K>& result)
  {
    m_interior.reset(new Interior_deviation(std::move(pieces), m_mesh_distance, m_band, m_tolerance,
                                            m_limit, m_interior.get()));
    m_interior->add_mesh(m_tm, m_vpm);
    const Deviation_statistics& statistics = m_interior->statistics();
    result.interior_maximum = statistics.maximum;
    result.interior_mean = statistics.mean();
    result.fraction_within = statistics.fraction_within();
    result.interior_worst = point<K>(statistics.worst);
    for(const Eigen::Vector3d& p : m_interior->violations())
      result.interior_violations.push_back(point<K>(p));
    result.faces_against_mesh = m_interior->number_of_faces_against_mesh();
    for(const Eigen::Vector3d& p : m_interior->folds())
      result.folds.push_back(point<K>(p));
  }

  template <typename K>
  static void measure_normals(const NURBS_shell_3<K>& shell, Deviation<K>& result)
  {
    constexpr double LARGEST_ANGLE = 1; // in degrees
    const Normal_angles angles = normal_angles(shell, LARGEST_ANGLE);
    result.normal_angle_maximum = angles.others.maximum;
    result.crease_angle_maximum = angles.creases.maximum;
    result.normal_angle_worst = point<K>(angles.creases.maximum > angles.others.maximum
                                           ? angles.creases.worst : angles.others.worst);
    for(const Eigen::Vector3d& p : angles.violations)
      result.normal_violations.push_back(point<K>(p));
  }

  const TriangleMesh& m_tm;
  VertexPointMap m_vpm;
  const BoundaryCurveNetwork& m_network;
  Mesh_distance m_mesh_distance;
  double m_band, m_tolerance, m_limit;
  std::unique_ptr<Interior_deviation> m_interior; // of the last surface
};

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

\pre `tm` has a face, the network has no error, and the tolerance is positive
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
  CGAL_precondition(tolerance > 0);
  typedef internal::Deviation_meter<TriangleMesh, decltype(vpm), BoundaryCurveNetwork> Meter;
  deviation = Meter(tm, vpm, network, internal::boundary_band_width(np, tm, vpm), tolerance,
                    tolerance)(shell, internal::bezier_pieces(shell));
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_MEASURE_DEVIATION_H
