// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_SMALLEST_ENCLOSING_SPHERE_DIAMETER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_SMALLEST_ENCLOSING_SPHERE_DIAMETER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/graph/graph_traits.hpp>

#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionFunctions

computes the diameter of the smallest sphere that encloses the vertices of a mesh. All default
tolerances and sizes of this package are relative to this length.

\tparam TriangleMesh a model of `VertexListGraph`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param tm a mesh
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
       below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `tm`}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and
                    `%Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the diameter in model units, accurate to rounding; 0 if the mesh has no vertex, and not a
        number if a coordinate is not finite.
*/
template <typename TriangleMesh,
          typename NamedParameters = parameters::Default_named_parameters>
#ifdef DOXYGEN_RUNNING
FT
#else
typename GetGeomTraits<TriangleMesh, NamedParameters>::type::FT
#endif
smallest_enclosing_sphere_diameter(const TriangleMesh& tm,
                                   const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;

  typedef typename GetGeomTraits<TriangleMesh, NamedParameters>::type Geom_traits;
  typedef typename Geom_traits::FT FT;
  typedef Min_sphere_of_points_d_traits_3<Geom_traits, FT, Tag_true> Sphere_traits;

  const auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                    get_const_property_map(vertex_point, tm));
  std::vector<typename Geom_traits::Point_3> points;
  for(const auto v : vertices(tm))
  {
    points.push_back(get(vpm, v));
    const FT squared_distance_to_origin = (points.back() - ORIGIN).squared_length();
    if(!std::isfinite(squared_distance_to_origin))
      return squared_distance_to_origin - squared_distance_to_origin;
  }
  if(points.empty())
    return FT(0);
  Min_sphere_of_spheres_d<Sphere_traits> sphere(points.begin(), points.end());
  return FT(2) * sphere.radius();
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_SMALLEST_ENCLOSING_SPHERE_DIAMETER_H
