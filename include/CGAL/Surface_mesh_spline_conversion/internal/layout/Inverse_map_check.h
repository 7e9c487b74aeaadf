// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INVERSE_MAP_CHECK_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INVERSE_MAP_CHECK_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Looks for samples at which the inverse map of a layout reverses the orientation.
template <typename GeomTraits>
class Inverse_map_check
{
public:
  typedef Quad_layout<GeomTraits> Layout;

  // `number_of_faces`: that of the input
  Inverse_map_check(const Layout& layout, std::size_t number_of_faces)
    : m_layout(layout), m_number_of_faces(number_of_faces)
  {}

  bool is_orientation_kept() const
  {
    const int n = samples_per_side();
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
      for(int i = 0; i < n; ++i)
        for(int j = 0; j < n; ++j)
          if(is_reversed(q, (i + 0.5) / n, (j + 0.5) / n))
            return false;
    return true;
  }

private:
  typedef std::array<double, 3> Barycentric;

  // enough to meet most faces of the input several times
  int samples_per_side() const
  {
    const int fewest = 6, most = 100;
    const double samples_per_face = 9;
    const double faces_per_quad
      = static_cast<double>(m_number_of_faces) / static_cast<double>(m_layout.number_of_quads());
    return (std::max)(fewest, (std::min)(most, static_cast<int>(
                                std::ceil(std::sqrt(samples_per_face * faces_per_quad)))));
  }

  // Do all small triangles at (u,v) whose images lie in one face have reversed images?
  bool is_reversed(std::size_t quad, double u, double v) const
  {
    const double step = 1e-7, rounding = 1e-14;
    std::size_t face, other_face;
    const Barycentric at = locate(quad, u, v, face);
    bool is_reversed = false;
    for(const double du : {step, -step})
      for(const double dv : {step, -step})
      {
        const Barycentric a = minus(locate(quad, u + du, v, other_face), at);
        if(other_face != face)
          continue;
        const Barycentric b = minus(locate(quad, u, v + dv, other_face), at);
        if(other_face != face)
          continue;
        const double area = (a[0] * b[1] - a[1] * b[0]) * du * dv / (step * step);
        if(area > 0)
          return false;
        is_reversed = is_reversed || area < -rounding * (length(a) + length(b));
      }
    return is_reversed;
  }

  Barycentric locate(std::size_t quad, double u, double v, std::size_t& face) const
  {
    const auto at = m_layout.inverse_map()(quad, typename Layout::FT(u), typename Layout::FT(v));
    face = at.face;
    return {{CGAL::to_double(at.barycentric[0]), CGAL::to_double(at.barycentric[1]),
             CGAL::to_double(at.barycentric[2])}};
  }

  static Barycentric minus(const Barycentric& a, const Barycentric& b)
  {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
  }

  static double length(const Barycentric& a)
  {
    return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]);
  }

  const Layout& m_layout;
  std::size_t m_number_of_faces;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INVERSE_MAP_CHECK_H
