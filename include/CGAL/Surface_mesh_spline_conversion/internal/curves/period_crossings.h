// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_PERIOD_CROSSINGS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_PERIOD_CROSSINGS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/number_utils.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Appends the parameters at which an angle passes through `value`, as far as samples, which ascend,
// lie on different sides. Where it stays there, or turns back, it does not pass.
template <typename FT, typename Angle>
void append_crossings(const Angle& angle, const FT& value, const std::vector<FT>& samples,
                      std::vector<FT>& result)
{
  const FT rounding(1e-9);
  const auto difference = [&](const FT& t) { return angle(t) - value; };
  FT last(0), last_difference(0);
  for(const FT& t : samples)
  {
    const FT d = difference(t);
    if(std::abs(d) <= rounding)
      continue;
    if(last_difference * d < FT(0))
    {
      const auto bracket = boost::math::tools::bisect(difference, last, t,
                                                      boost::math::tools::eps_tolerance<FT>());
      result.push_back((bracket.first + bracket.second) / FT(2));
    }
    last = t;
    last_difference = d;
  }
}

// Appends the parameters at which an angle passes through a multiple of the full turn; none if it
// makes more turns than there are samples, which tell nothing then.
template <typename FT, typename Angle>
void append_period_crossings(const Angle& angle, const std::vector<FT>& samples,
                             std::vector<FT>& result)
{
  const FT period(2 * CGAL_PI);
  FT smallest = angle(samples.front()), largest = smallest;
  for(const FT& t : samples)
  {
    smallest = (std::min)(smallest, angle(t));
    largest = (std::max)(largest, angle(t));
  }
  const FT first = std::ceil(smallest / period), last = std::floor(largest / period);
  if(!(last - first < FT(double(samples.size()))))
    return;
  for(std::size_t i = 0; FT(double(i)) <= last - first; ++i)
    append_crossings(angle, FT((first + FT(double(i))) * period), samples, result);
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_PERIOD_CROSSINGS_H
