// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_MERGE_PAIRS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_MERGE_PAIRS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Merges patches in pairs: the two halves of a rectangle that may come from its bisection, across
// the longer side if possible. The others stay as they are.
//
// Origin: `T_NURCC_surface_3::Patch_origin`
template <typename Origin>
class Pair_merger
{
  typedef std::tuple<std::size_t, double, double, double, double> Key;

public:
  explicit Pair_merger(const std::vector<Origin>& patches)
  {
    for(const Origin& patch : patches)
      m_is_free[key(patch)] = true;
  }

  std::vector<Origin> operator()(const std::vector<Origin>& patches)
  {
    std::vector<Origin> result;
    for(const Origin& patch : patches)
    {
      if(!take(patch))
        continue;
      const int axis = size(patch, 0) < size(patch, 1) ? 0 : 1;
      Origin other = other_half(patch, axis);
      if(!take(other) && !take(other = other_half(patch, 1 - axis)))
        other = patch;
      result.push_back(Origin{patch.quad, (std::min)(patch.u0, other.u0),
                              (std::min)(patch.v0, other.v0), (std::max)(patch.u1, other.u1),
                              (std::max)(patch.v1, other.v1)});
    }
    return result;
  }

private:
  static Key key(const Origin& o)
  {
    return Key(o.quad, CGAL::to_double(o.u0), CGAL::to_double(o.v0), CGAL::to_double(o.u1),
               CGAL::to_double(o.v1));
  }

  static double size(const Origin& o, int axis)
  {
    return CGAL::to_double(axis == 0 ? o.u1 - o.u0 : o.v1 - o.v0);
  }

  // returns whether there is such a patch that is not merged yet, and reserves it
  bool take(const Origin& patch)
  {
    const auto it = m_is_free.find(key(patch));
    if(it == m_is_free.end() || !it->second)
      return false;
    it->second = false;
    return true;
  }

  // the patch beside `patch`, with which it would make up a rectangle of twice its size; beyond the
  // quad if the patch is as long as the quad
  static Origin other_half(const Origin& patch, int axis)
  {
    const double size = Pair_merger::size(patch, axis);
    const double position = CGAL::to_double(axis == 0 ? patch.u0 : patch.v0) / size;
    const double shift = std::fmod(position, 2) == 0 ? size : -size;
    Origin result = patch;
    (axis == 0 ? result.u0 : result.v0) += shift;
    (axis == 0 ? result.u1 : result.v1) += shift;
    return result;
  }

  std::map<Key, bool> m_is_free;
};

// returns rectangles that are made of one or two of the patches of a surface
template <typename Surface>
std::vector<typename Surface::Patch_origin> merge_pairs(const Surface& surface)
{
  std::vector<typename Surface::Patch_origin> patches;
  for(std::size_t p = 0; p < surface.number_of_patches(); ++p)
    patches.push_back(surface.patch_origin(p));
  return Pair_merger<typename Surface::Patch_origin>(patches)(patches);
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_MERGE_PAIRS_H
