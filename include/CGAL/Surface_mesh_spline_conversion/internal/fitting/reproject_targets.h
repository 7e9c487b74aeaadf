// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_REPROJECT_TARGETS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_REPROJECT_TARGETS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Replaces the targets of the fit samples by the points of the target closest to the present
// surface. The surface then no longer has to follow the kinks of the parametrization of the mesh,
// only its shape.
//
// A cell of the sample grid of a patch must not fold: where its orientation differs from that of
// the target grid, the targets with equal parameters are kept. They also are beside a corner of the
// boundary between two quads: the line between these shall leave it within the angles of both, and
// would slide along the surface where the patches beside it are small.
template <typename Surface, typename Target>
class Target_reprojection
{
  typedef std::size_t size_type;
  typedef Interior_samples<Surface, Target> Samples;

  typedef typename Target::FT FT;
  typedef typename Target::Point_3 Point_3;
  typedef std::vector<Eigen::Vector3d> Points;

public:
  Target_reprojection(const Target& target, Samples& samples)
    : m_target(target), m_samples(samples)
  {}

  void operator()(const std::vector<size_type>& patches)
  {
    for_each_index(patches.size(), [&](size_type i) { reproject(patches[i]); });
  }

private:
  void reproject(size_type patch)
  {
    if(m_samples.is_at_split_corner(patch))
      return;
    const auto& grid = m_samples.grid(patch);
    const Points points = m_samples.surface_points(patch);
    Points original, feet;
    std::vector<size_type> faces;
    original.reserve(points.size());
    feet.reserve(points.size());
    faces.reserve(points.size());
    for(size_type k = 0; k < grid.number_of_fit_samples(); ++k)
    {
      const size_type i = m_samples.error_sample(patch, k);
      const typename Samples::Place at = m_samples.error_place(i);
      original.push_back(m_samples.target(i));
      faces.push_back(m_samples.near_face(patch, k));
      feet.push_back(to_eigen(m_target.foot_point(
        to_point(points[k]), at.quad, at.u, at.v,
        to_point(original.back()), m_samples.mesh_face(i), faces.back())));
    }
    unfold(grid.u + 1, grid.v + 1, original, feet);
    for(size_type k = 0; k < grid.number_of_fit_samples(); ++k)
    {
      m_samples.set_fit_target(patch, k, feet[k]);
      m_samples.set_near_face(patch, k, faces[k]);
    }
  }

  static Point_3 to_point(const Eigen::Vector3d& p)
  {
    return Point_3(FT(p[0]), FT(p[1]), FT(p[2]));
  }

  // taking back a foot may fold a neighbouring cell, hence the repetition; each round that goes
  // on takes back at least one foot
  static void unfold(size_type columns, size_type rows, const Points& original, Points& feet)
  {
    std::vector<char> is_original(feet.size(), false);
    bool is_changed = true;
    while(is_changed)
    {
      is_changed = false;
      for(size_type j = 0; j + 1 < rows; ++j)
        for(size_type i = 0; i + 1 < columns; ++i)
        {
          const size_type k = j * columns + i;
          if(normal(feet, k, columns).dot(normal(original, k, columns)) > 0)
            continue;
          for(size_type corner : {k, k + 1, k + columns, k + columns + 1})
            if(!is_original[corner])
            {
              feet[corner] = original[corner];
              is_original[corner] = true;
              is_changed = true;
            }
        }
    }
  }

  // twice the area vector of the cell with the first corner `k`
  static Eigen::Vector3d normal(const Points& points, size_type k, size_type columns)
  {
    return (points[k + columns + 1] - points[k]).cross(points[k + columns] - points[k + 1]);
  }

  const Target& m_target;
  Samples& m_samples;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_REPROJECT_TARGETS_H
