// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_DEVIATION_STATISTICS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_DEVIATION_STATISTICS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Eigen/Core>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// maximum, mean and share below a bound of a sequence of deviations
struct Deviation_statistics
{
  double bound = 0;
  double maximum = 0;
  double sum = 0;
  std::size_t number = 0;
  std::size_t number_within = 0;
  Eigen::Vector3d worst = Eigen::Vector3d::Zero();

  /// returns `true` if the deviation is the largest up to now
  bool add(double deviation, const Eigen::Vector3d& p)
  {
    const bool is_worst = (number == 0 || !(deviation <= maximum));
    if(is_worst)
    {
      maximum = deviation;
      worst = p;
    }
    sum += deviation;
    ++number;
    if(deviation <= bound)
      ++number_within;
    return is_worst;
  }

  double mean() const { return (number == 0) ? 0 : sum / double(number); }

  double fraction_within() const
  {
    return (number == 0) ? 1 : double(number_within) / double(number);
  }
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_DEVIATION_STATISTICS_H
