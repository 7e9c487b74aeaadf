// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_SPLIT_CORNERS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_SPLIT_CORNERS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Calls `visit(first, i, second, j)` for the corners of the boundary between two quads (paper, Fig.
// 6(b)): the corner is the end of side `i` of quad `first` and the begin of side `j` of `second`.
template <typename Layout, typename Visitor>
void for_each_split_corner(const Layout& layout, const Visitor& visit)
{
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
    {
      if(!layout.is_border(q, i) || !layout.is_corner(layout.vertex(q, i + 1))
         || layout.is_border(q, i + 1))
        continue;
      const auto other = layout.neighbor(q, i + 1);
      if(layout.is_border(other.first, other.second + 1))
        visit(q, i, other.first, (other.second + 1) & 3);
    }
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_SPLIT_CORNERS_H
