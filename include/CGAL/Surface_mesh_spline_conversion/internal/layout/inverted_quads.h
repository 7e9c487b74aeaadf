// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INVERTED_QUADS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INVERTED_QUADS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/scaled_jacobian.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The scaled Jacobian of a quad of a layout that is drawn flat; not positive if it is not convex or
// faces the wrong side of the mesh near its middle. `faces`: the corners of the faces of the mesh,
// as `Surface_location` counts them
template <typename GeomTraits>
double shape_of_flat_quad(const Quad_layout<GeomTraits>& layout, std::size_t q,
                          const std::vector<std::array<Eigen::Vector3d, 3> >& faces)
{
  typedef typename GeomTraits::FT FT;
  std::array<Eigen::Vector3d, 4> points;
  for(int i = 0; i < 4; ++i)
    points[i] = to_eigen(layout.point(layout.vertex(q, i)));
  const auto& face = faces[layout.inverse_map()(q, FT(0.5), FT(0.5)).face];
  return oriented_scaled_jacobian(points, (face[1] - face[0]).cross(face[2] - face[0]));
}

// the least one of all quads
template <typename GeomTraits>
double least_shape_of_flat_quads(const Quad_layout<GeomTraits>& layout,
                                 const std::vector<std::array<Eigen::Vector3d, 3> >& faces)
{
  double least = 1;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
  {
    const double shape = shape_of_flat_quad(layout, q, faces);
    if(!(shape >= least))
      least = shape;
  }
  return least;
}

// the quads with a shape that is not positive, in increasing order
template <typename GeomTraits>
std::vector<std::size_t> inverted_quads(
  const Quad_layout<GeomTraits>& layout,
  const std::vector<std::array<Eigen::Vector3d, 3> >& faces)
{
  std::vector<std::size_t> inverted;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    if(!(shape_of_flat_quad(layout, q, faces) > 0))
      inverted.push_back(q);
  return inverted;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INVERTED_QUADS_H
