// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_MEASURE_LAYOUT_QUALITY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_MEASURE_LAYOUT_QUALITY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Layout_quality_meter.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

measures the quads of a layout and its inverse map, by samples.

- The flat quads spanned by the vertices: the scaled Jacobian (the smallest sine of the four corner
  angles, seen along the normal of the quad; not positive if the quad is not convex), and the
  deviation of the corner angles from a right angle.
- The sizes: the lengths of the sides in proportion to the wanted size, and the number of quads in
  proportion to the area of the mesh divided by the square of the wanted size.
- The inverse map: the proportion of the singular values of its derivative (1 where squares stay
  squares), the area of its image in proportion to the square of the wanted size (or the inverse
  of this proportion, if it is larger), and the angle by which lines of constant `u` or `v` turn
  where they cross the side of a quad.

\tparam TriangleMesh a model of `FaceListGraph`
\tparam GeomTraits a model of `Kernel`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param layout a layout with inverse map
\param tm the triangle mesh of the layout
\param report receives the figures; `flipped_triangles` and `fallback` are left as they are
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
       below

\cgalNamedParamsBegin
  \cgalParamNBegin{quad_size_map}
    \cgalParamDescription{the wanted edge length of the quads, in model units}
    \cgalParamType{a number, or a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and a number
                    type as value type}
    \cgalParamDefault{the size of as many squares as there are quads, with the area of the mesh}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `tm`}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and
                    `%Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\pre `layout` has been made from `tm` and has at least one quad

\sa `compute_quad_layout()`
*/
template <typename TriangleMesh, typename GeomTraits,
          typename NamedParameters = parameters::Default_named_parameters>
void measure_layout_quality(const Quad_layout<GeomTraits>& layout, const TriangleMesh& tm,
                            Conversion_report::Map& report,
                            const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;

  const auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                    get_const_property_map(vertex_point, tm));
  const auto size = get_parameter(np, internal_np::quad_size_map);
  typedef internal::Layout_quality_meter<GeomTraits> Meter;
  std::vector<typename Meter::Face> mesh;
  double area = 0;
  for(const auto f : faces(tm))
  {
    mesh.emplace_back();
    std::size_t i = 0;
    for(const auto v : vertices_around_face(halfedge(f, tm), tm))
      mesh.back().points[i++] = internal::to_eigen(get(vpm, v));
    area += mesh.back().area();
  }
  const double mean_size = std::sqrt(area / static_cast<double>(layout.number_of_quads()));
  std::size_t face = 0;
  for(const auto f : faces(tm))
  {
    std::size_t i = 0;
    for(const auto v : vertices_around_face(halfedge(f, tm), tm))
      mesh[face].sizes[i++] = internal::quad_size_at(size, v, mean_size);
    ++face;
  }
  Meter(layout, mesh, report).measure();
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_MEASURE_LAYOUT_QUALITY_H
