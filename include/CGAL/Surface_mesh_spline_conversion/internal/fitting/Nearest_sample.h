// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_NEAREST_SAMPLE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_NEAREST_SAMPLE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Finds the error sample nearest to a point. Boxes around the patches are made much faster than a
// search tree of all samples, which would pay for many points only.
template <typename Samples>
class Nearest_sample
{
  typedef std::size_t size_type;

public:
  // `points`: of the surface at the error samples
  Nearest_sample(const Samples& samples, const std::vector<Eigen::Vector3d>& points)
    : m_samples(samples), m_points(points), m_boxes(samples.number_of_patches())
  {
    for(size_type p = 0; p < m_boxes.size(); ++p)
      for(size_type i = samples.first_error_sample(p); i < samples.first_error_sample(p + 1); ++i)
        m_boxes[p].extend(points[i]);
  }

  // returns the first one of the nearest samples
  size_type operator()(const Eigen::Vector3d& query) const
  {
    size_type result = 0;
    double smallest = (std::numeric_limits<double>::infinity)();
    for(size_type p = 0; p < m_boxes.size(); ++p)
      if(m_boxes[p].squaredExteriorDistance(query) < smallest)
        for(size_type i = m_samples.first_error_sample(p); i < m_samples.first_error_sample(p + 1);
            ++i)
        {
          const double distance = (m_points[i] - query).squaredNorm();
          if(distance >= smallest)
            continue;
          smallest = distance;
          result = i;
        }
    return result;
  }

private:
  const Samples& m_samples;
  const std::vector<Eigen::Vector3d>& m_points;
  std::vector<Eigen::AlignedBox3d> m_boxes; // of the patches
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_NEAREST_SAMPLE_H
