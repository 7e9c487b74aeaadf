// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_LICENSE_SURFACE_MESH_SPLINE_CONVERSION_H
#define CGAL_LICENSE_SURFACE_MESH_SPLINE_CONVERSION_H

// The counterpart of CGAL's generated licence headers; it is dropped when the package is merged.

#endif // CGAL_LICENSE_SURFACE_MESH_SPLINE_CONVERSION_H
