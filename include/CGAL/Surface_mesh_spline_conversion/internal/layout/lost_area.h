// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LOST_AREA_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LOST_AREA_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The area of a quad of a layout, from points on a square grid.
template <typename GeomTraits>
double sampled_area(const Quad_layout<GeomTraits>& layout, std::size_t q)
{
  typedef typename GeomTraits::FT FT;
  constexpr int cells = 8;
  std::array<std::array<Eigen::Vector3d, cells + 1>, cells + 1> p;
  for(int i = 0; i <= cells; ++i)
    for(int j = 0; j <= cells; ++j)
      p[i][j] = to_eigen(layout.inverse_map()(q, FT(i) / cells, FT(j) / cells).point);
  double area = 0;
  for(int i = 0; i < cells; ++i)
    for(int j = 0; j < cells; ++j)
    {
      const Eigen::Vector3d diagonal = p[i + 1][j + 1] - p[i][j];
      area += (p[i + 1][j] - p[i][j]).cross(diagonal).norm() / 2
              + diagonal.cross(p[i][j + 1] - p[i][j]).norm() / 2;
    }
  return area;
}

// The share of the area of the mesh that samples of the quads have too little, where parts of the
// surface are squeezed between them, or too much, where these are so uneven that samples zigzag.
// `faces`: the corners of the faces of the mesh
template <typename GeomTraits>
double lost_area(const Quad_layout<GeomTraits>& layout,
                 const std::vector<std::array<Eigen::Vector3d, 3> >& faces)
{
  double sampled = 0, all = 0;
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    sampled += sampled_area(layout, q);
  for(const auto& face : faces)
    all += (face[1] - face[0]).cross(face[2] - face[0]).norm() / 2;
  return std::abs(1 - sampled / all);
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LOST_AREA_H
