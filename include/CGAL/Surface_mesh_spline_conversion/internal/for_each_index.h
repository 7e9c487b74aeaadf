// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FOR_EACH_INDEX_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FOR_EACH_INDEX_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/parallel_for.h>
#endif

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Calls `function(i)` for all `i` below `n`, with several threads if the program is linked with
// TBB. Each call must write to places of its own, such that the result does not depend on the
// order.
template <typename Function>
void for_each_index(std::size_t n, const Function& function)
{
#ifdef CGAL_LINKED_WITH_TBB
  tbb::parallel_for(std::size_t(0), n, function);
#else
  for(std::size_t i = 0; i < n; ++i)
    function(i);
#endif
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FOR_EACH_INDEX_H
