// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_ROUND_TO_FIXED_POINT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_ROUND_TO_FIXED_POINT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Cut_graph.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/check_seamless_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/seam_equations.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Coordinates keep clear of the range of 64 bits, so that sums of them do, too.
constexpr int most_coordinate_bits = 45;

// Rounds the free variables to multiples of the denominator, in units of 2^-bits quads: all other
// coordinates are then integers that satisfy all equations exactly. Returns `false` if constants
// are not representable.
inline bool evaluate_exactly(const Map_space& space, const Cut_graph& cut, const Eigen::VectorXd& y,
                             int bits, Seamless_map& map)
{
  std::vector<std::int64_t> multiple(space.number_of_free_variables());
  for(int i = 0; i < space.number_of_free_variables(); ++i)
    multiple[i] = std::llround(std::ldexp(y[i], bits) / space.denominator);
  std::vector<std::int64_t> scalar(space.number_of_scalars());
  for(int i = 0; i < space.number_of_scalars(); ++i)
  {
    const Wide_integer constant
      = static_cast<Wide_integer>(space.constant[i]) * (static_cast<Wide_integer>(1) << bits);
    if(constant % space.denominator != 0)
      return false;
    Wide_integer sum = constant / space.denominator;
    for(int k = space.start[i]; k < space.start[i + 1]; ++k)
      sum += static_cast<Wide_integer>(space.numerator[k]) * multiple[space.column[k]];
    scalar[i] = static_cast<std::int64_t>(sum);
  }
  map.fractional_bits = bits;
  map.coordinates.resize(map.mesh.number_of_halfedges());
  for(int corner = 0; corner < map.mesh.number_of_halfedges(); ++corner)
    map.coordinates[corner]
      = Fixed_point_2{{scalar[2 * cut.wedge(corner)], scalar[2 * cut.wedge(corner) + 1]}};
  map.rotation = cut.rotation();
  return true;
}

// Makes the map exact, with more digits if triangles get lost by rounding. `map.mesh` and
// `map.cone` must be set. Returns the vertices where the map is not valid.
inline std::vector<int> round_to_fixed_point(const Map_space& space, const Cut_graph& cut,
                                             const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                                             Seamless_map& map)
{
  const int usual_bits = 32, most_bits = 40, step = 4;
  const double range = (std::max)(1., (std::max)(x.cwiseAbs().maxCoeff(),
                                      y.size() > 0 ? y.cwiseAbs().maxCoeff() : 0.));
  const int available = most_coordinate_bits - static_cast<int>(std::ceil(std::log2(range)));
  std::vector<int> defects;
  for(int bits = (std::min)(usual_bits, available); bits <= most_bits; bits += step)
  {
    if(bits < 0 || !evaluate_exactly(space, cut, y, bits, map))
      return std::vector<int>(1, 0);
    defects = find_defects(map);
    if(defects.empty() || bits + step > available)
      break;
  }
  return defects;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_ROUND_TO_FIXED_POINT_H
