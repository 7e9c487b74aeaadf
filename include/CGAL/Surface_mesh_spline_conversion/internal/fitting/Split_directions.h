// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SPLIT_DIRECTIONS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SPLIT_DIRECTIONS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_samples.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Decides in which directions patches are split.
//
// The square patches of a quad of the layout are halved in the direction in which their errors
// vary more, other patches in their longer direction, unless the error varies so much more in the
// other one. One direction for a quad, and halving in turns, let the halves of neighbors match:
// where directions are mixed, extensions of T-junctions cross, and the surface needs up to a half
// more control points.
template <typename Surface, typename Target>
class Split_directions
{
  typedef std::size_t size_type;
  typedef Interior_samples<Surface, Target> Samples;
  typedef typename Target::FT FT;
  typedef typename Surface::Patch_split Patch_split;

public:
  Split_directions(const Surface& surface, const Target& target, const Samples& samples)
    : m_surface(surface), m_target(target), m_samples(samples)
  {}

  std::vector<Patch_split> operator()(const std::vector<size_type>& patches) const
  {
    std::vector<Variation> variations(m_target.layout().number_of_quads());
    for(size_type p : patches)
      if(is_square(p))
      {
        const Variation variation = this->variation(p);
        Variation& sum = variations[m_surface.patch_origin(p).quad];
        sum.u += variation.u;
        sum.v += variation.v;
      }
    std::vector<Patch_split> result;
    for(size_type p : patches)
    {
      const Variation& of_quad = variations[m_surface.patch_origin(p).quad];
      const bool is_along_u = is_split_along_u(p, of_quad.u >= of_quad.v);
      result.push_back(Patch_split{p, is_along_u, !is_along_u});
    }
    return result;
  }

private:
  static constexpr double directional_ratio = 5;

  // how much the error varies along `u` and `v`: the integrals of its squared derivatives
  struct Variation
  {
    double u = 0, v = 0;
  };

  bool is_square(size_type patch) const
  {
    const auto origin = m_surface.patch_origin(patch);
    return origin.u1 - origin.u0 == origin.v1 - origin.v0;
  }

  // `is_quad_along_u`: whether the square patches of the quad are split along `u`
  bool is_split_along_u(size_type patch, bool is_quad_along_u) const
  {
    const auto origin = m_surface.patch_origin(patch);
    const FT width = origin.u1 - origin.u0, height = origin.v1 - origin.v0;
    const Variation variation = this->variation(patch);
    const double ratio = directional_ratio * directional_ratio;
    if(variation.u > ratio * variation.v && FT(2) * width >= height)
      return true;
    if(variation.v > ratio * variation.u && FT(2) * height >= width)
      return false;
    return width == height ? is_quad_along_u : width > height;
  }

  Variation variation(size_type patch) const
  {
    const auto& grid = m_samples.grid(patch);
    const size_type row = grid.u + 1;
    std::vector<Eigen::Vector3d> differences = m_samples.surface_points(patch);
    for(size_type k = 0; k < differences.size(); ++k)
      differences[k] -= m_samples.fit_target(patch, k);
    Variation result;
    for(size_type k = 0; k < differences.size(); ++k)
    {
      if(k % row != 0)
        result.u += (differences[k] - differences[k - 1]).squaredNorm()
                    * double(grid.u) / double(grid.v + 1);
      if(k >= row)
        result.v += (differences[k] - differences[k - row]).squaredNorm()
                    * double(grid.v) / double(grid.u + 1);
    }
    return result;
  }

  const Surface& m_surface;
  const Target& m_target;
  const Samples& m_samples;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SPLIT_DIRECTIONS_H
