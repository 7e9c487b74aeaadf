// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_PROXY_MESH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_PROXY_MESH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A coarser and well-shaped mesh that stands for a triangle mesh while field, map and layout are
// computed. Its vertices lie on the original, unfolded. At the boundary it has the chains of the
// original: between two neighbouring boundary vertices the arc lengths of both run over the same
// interval.
struct Proxy_mesh
{
  std::shared_ptr<const Working_mesh> original;
  std::shared_ptr<const Working_mesh> unfolded; // the original with some inner vertices moved: the
                                                // projection goes to it
  Working_mesh mesh;
  std::vector<Working_location> place;  // per vertex of `mesh`: where it lies on the original
  std::vector<Eigen::Vector3d> normal;  // per vertex of `mesh`: the direction of projection, of
                                        // length one
  bool is_folded = false;               // is the projection not known to be one to one?
  std::vector<double> size;             // per vertex of `mesh`: wanted edge length of the quads
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_PROXY_MESH_H
