// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERPOLATE_BOUNDARY_CURVES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERPOLATE_BOUNDARY_CURVES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Curve_segment.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Cubic_spline_interpolation.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/boundary_loops.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/check_triangle_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_type_basic.h>

#include <boost/graph/graph_traits.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

#ifndef DOXYGEN_RUNNING
namespace internal {

// Puts interpolating splines on the edges of one boundary loop.
template <typename TriangleMesh, typename K, typename HalfedgeCurveMap>
class Boundary_loop_interpolation
{
  typedef std::size_t size_type;
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_descriptor;
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;
  typedef Curve_segment<NURBS_curve_traits_3<K> > Segment;

public:
  template <typename VertexPointMap>
  Boundary_loop_interpolation(const TriangleMesh& tm, const VertexPointMap& vpm,
                              const std::vector<halfedge_descriptor>& halfedges,
                              HalfedgeCurveMap halfedge_curve_map)
    : m_halfedges(halfedges), m_map(halfedge_curve_map)
  {
    for(const halfedge_descriptor h : halfedges)
      m_points.push_back(get(vpm, source(h, tm)));
  }

  // interpolates between the vertices at which the edges turn by more than `corner_angle` (in
  // radians).
  void operator()(const FT& corner_angle) const
  {
    // a regular polygon that turns by just this angle shall not get corners here and there
    const FT rounding(1e-6);
    const size_type n = m_halfedges.size();
    std::vector<size_type> corners;
    for(size_type i = 0; i < n; ++i)
      if(turning_angle(i) > corner_angle + rounding)
        corners.push_back(i);
    if(corners.empty())
      interpolate(0, n, true);
    for(size_type k = 0; k < corners.size(); ++k)
    {
      const size_type end = (k + 1 < corners.size()) ? corners[k + 1] : corners[0] + n;
      interpolate(corners[k], end - corners[k], false);
    }
  }

private:
  FT turning_angle(size_type i) const
  {
    const size_type n = m_halfedges.size();
    const Vector_3 in = m_points[i] - m_points[(i + n - 1) % n];
    const Vector_3 out = m_points[(i + 1) % n] - m_points[i];
    return std::atan2(std::sqrt(cross_product(in, out).squared_length()), in * out);
  }

  void interpolate(size_type begin, size_type number_of_edges, bool is_closed) const
  {
    const size_type n = m_halfedges.size();
    std::vector<Point_3> points;
    for(size_type k = 0; k <= number_of_edges; ++k)
      points.push_back(m_points[(begin + k) % n]);
    const Cubic_spline_interpolation<K> interpolation(points, is_closed);
    const NURBS_curve_3<K> curve = interpolation.curve();
    const std::vector<FT>& t = interpolation.parameters();
    for(size_type k = 0; k < number_of_edges; ++k)
      put(m_map, m_halfedges[(begin + k) % n], Segment{curve, t[k], t[k + 1]});
  }

  const std::vector<halfedge_descriptor>& m_halfedges;
  HalfedgeCurveMap m_map;
  std::vector<Point_3> m_points;
};

} // namespace internal
#endif

/*!
\ingroup PkgSurfaceMeshSplineConversionFunctions

makes boundary curves for an open mesh that comes without: cubic \f$ C^2 \f$ splines through the
boundary vertices, with chord-length parameters. A loop without corner gets one periodic spline;
otherwise there is one spline (with the not-a-knot condition at its ends) between each two
consecutive corners.

\tparam TriangleMesh a model of `HalfedgeListGraph` and `FaceListGraph`
\tparam K a model of `Kernel` with a floating-point number type
\tparam HalfedgeCurveMap a model of `WritablePropertyMap` with
        `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` as key type and
        `Curve_segment<NURBS_curve_traits_3<K> >` as value type
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param tm a triangle mesh
\param traits the traits of the curves
\param halfedge_curve_map is set for the halfedges of boundary edges whose faces lie in the mesh
\param message if the mesh has a defect, a sentence that names the element
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
       below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `tm`}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and
                    `K::Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
  \cgalParamNEnd
  \cgalParamNBegin{corner_angle}
    \cgalParamDescription{a boundary vertex becomes a corner if the boundary edges turn there by
                           more than this angle, in degrees}
    \cgalParamType{a number between 0 and 180}
    \cgalParamDefault{30}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return `Error_code::OK`, or the defect of mesh or parameters
*/
template <typename TriangleMesh, typename K, typename HalfedgeCurveMap,
          typename NamedParameters = parameters::Default_named_parameters>
Error_code interpolate_boundary_curves(const TriangleMesh& tm,
                                       const NURBS_curve_traits_3<K>& traits,
                                       HalfedgeCurveMap halfedge_curve_map,
                                       std::string& message,
                                       const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;

  typedef typename K::FT FT;

  CGAL_USE(traits);
  const auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                    get_const_property_map(vertex_point, tm));
  const internal::Triangle_mesh_check<TriangleMesh, std::decay_t<decltype(vpm)> >
    mesh_check(tm, vpm);
  const Error_code code = mesh_check(message);
  if(code != Error_code::OK)
    return code;

  const FT default_corner_angle(30);
  const FT corner_angle
    = choose_parameter(get_parameter(np, internal_np::corner_angle), default_corner_angle);
  if(!(FT(0) < corner_angle && corner_angle < FT(180)))
  {
    message = "The parameter corner_angle must be between 0 and 180 degrees.";
    return Error_code::INVALID_PARAMETER;
  }
  for(const auto& loop : internal::boundary_loops(tm))
    internal::Boundary_loop_interpolation<TriangleMesh, K, HalfedgeCurveMap>
      (tm, vpm, loop, halfedge_curve_map)(corner_angle * FT(CGAL_PI) / FT(180));
  return Error_code::OK;
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERPOLATE_BOUNDARY_CURVES_H
