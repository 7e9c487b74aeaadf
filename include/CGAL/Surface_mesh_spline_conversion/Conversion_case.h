// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_CONVERSION_CASE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_CONVERSION_CASE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Curve_on_surface_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Curve_segment.h>
#include <CGAL/Surface_mesh_spline_conversion/Function_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Variant_curve_traits_3.h>

#include <CGAL/Surface_mesh.h>

#include <boost/property_map/property_map.hpp>

#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

is an input of the conversion as read from a file by `CGAL::IO::read_case()`: a mesh with the curves
of its boundary.

\tparam K a model of `Kernel` with a floating-point number type
*/
template <typename K>
struct Conversion_case
{
  typedef typename K::Point_3 Point_3;
  typedef Surface_mesh<Point_3> Triangle_mesh;
  typedef Variant_curve_traits_3<NURBS_curve_traits_3<K>,
                                 Curve_on_surface_traits_3<K>,
                                 Function_curve_traits_3<K> > Curve_traits;
  typedef typename Curve_traits::Curve_3 Curve_3;
  typedef Surface_mesh_spline_conversion::Curve_segment<Curve_traits> Curve_segment;

  std::string name;                    ///< name of the case
  std::string unit = "mm";             ///< unit of length
  std::string residual_file;           ///< path of the B-Rep next to the mesh; may be empty
  Triangle_mesh mesh;                  ///< the mesh
  Curve_traits traits;                 ///< traits of the curves
  std::vector<Curve_3> curves;         ///< the curves
  std::vector<Curve_segment> segments; ///< the curve of each halfedge, by its index
  std::vector<char> corners;           ///< is the vertex of this index a corner?

  /// returns a property map from the halfedges of `mesh` to their curves, valid as long as the case
  /// is neither moved nor changed.
  auto halfedge_curve_map() const
  {
    return boost::make_iterator_property_map(segments.begin(), get(boost::halfedge_index, mesh));
  }

  /// returns a property map that tells which vertices of `mesh` are corners, valid as long as the
  /// case is neither moved nor changed.
  auto vertex_is_corner_map() const
  {
    return boost::make_iterator_property_map(corners.begin(), get(boost::vertex_index, mesh));
  }
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_CONVERSION_CASE_H
