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

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Replaces the targets of the fit samples by the points of the target closest to the present
// surface. The surface then no longer has to follow the kinks of the parametrization of the mesh,
// only its shape.
//
// A cell of the sample grid of a patch must not fold: where its orientation differs from that of
// the target grid, the targets with equal parameters are kept.
template <typename Surface, typename Target>
class Target_reprojection
{
  typedef std::size_t size_type;
  typedef Interior_samples<Surface, Target> Samples;
  typedef typename Target::FT FT;
  typedef typename Target::Point_3 Point_3;

  static constexpr size_type grid = Samples::fit_grid;
  typedef std::array<Eigen::Vector3d, Samples::fit_samples> Grid;

public:
  Target_reprojection(const Surface& surface, const Target& target, Samples& samples)
    : m_surface(surface), m_target(target), m_samples(samples)
  {}

  void operator()()
  {
    for(size_type p = 0; p < m_samples.number_of_patches(); ++p)
      reproject(p);
  }

private:
  void reproject(size_type patch)
  {
    Grid original, feet;
    for(size_type k = 0; k < Samples::fit_samples; ++k)
    {
      const typename Samples::Place at = m_samples.fit_place(patch, k);
      original[k] = m_samples.target(patch, Samples::error_sample(k));
      const Point_3 p = m_surface.position(at.patch, at.u, at.v);
      feet[k] = to_eigen(m_target.foot_point(p, at.quad, at.u, at.v));
    }
    unfold(original, feet);
    for(size_type k = 0; k < Samples::fit_samples; ++k)
      m_samples.set_fit_target(patch, k, feet[k]);
  }

  // taking back a foot may fold a neighbouring cell, hence the repetition; each round that goes
  // on takes back at least one foot
  static void unfold(const Grid& original, Grid& feet)
  {
    bool is_changed = true;
    while(is_changed)
    {
      is_changed = false;
      for(size_type j = 0; j + 1 < grid; ++j)
        for(size_type i = 0; i + 1 < grid; ++i)
        {
          const size_type k = j * grid + i;
          if(normal(feet, k).dot(normal(original, k)) > 0)
            continue;
          for(size_type corner : {k, k + 1, k + grid, k + grid + 1})
            if(feet[corner] != original[corner])
            {
              feet[corner] = original[corner];
              is_changed = true;
            }
        }
    }
  }

  // twice the area vector of the cell with the first corner `k`
  static Eigen::Vector3d normal(const Grid& points, size_type k)
  {
    return (points[k + grid + 1] - points[k]).cross(points[k + grid] - points[k + 1]);
  }

  const Surface& m_surface;
  const Target& m_target;
  Samples& m_samples;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_REPROJECT_TARGETS_H
