// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_KEEP_FREED_MEMORY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_KEEP_FREED_MEMORY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <limits>

#ifdef __GLIBC__ // defined by the header above
#include <malloc.h>
#endif

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Lets this process keep freed blocks of memory for later use; for programs, at their start. By
// default, the C library of GNU returns large blocks at once, and the system spends up to a tenth
// of the time of a conversion on fresh pages.
inline void keep_freed_memory()
{
#ifdef __GLIBC__
  const int largest_threshold = 32 << 20;
  mallopt(M_MMAP_THRESHOLD, largest_threshold);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_KEEP_FREED_MEMORY_H
