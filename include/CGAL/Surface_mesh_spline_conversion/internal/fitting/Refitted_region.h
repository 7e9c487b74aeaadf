// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_REFITTED_REGION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_REFITTED_REGION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The part of a surface that is fitted again after a refinement. The control points that act on
// patches whose functions have changed are free, which reach about two patches further; all others
// keep their places. Where that is the larger part of the surface, the whole is fitted.
template <typename Samples>
class Refitted_region
{
  typedef std::size_t size_type;
  typedef std::vector<std::vector<size_type> > Groups;

public:
  // `is_fixed`: control points that never move.
  // `groups`: patches that are fitted together, or not at all.
  // `is_whole`: is the whole surface fitted in any case?
  Refitted_region(const Samples& samples, const std::vector<bool>& is_fixed, const Groups& groups,
                  bool is_whole)
    : m_samples(samples), m_is_fixed(is_fixed), m_is_free(is_fixed.size(), false),
      m_is_whole(is_whole)
  {
    for(size_type p = 0; p < samples.number_of_patches(); ++p)
      if(!samples.has_previous_functions(p))
        set_free(p);
    while(complete(groups))
      continue;
    choose_patches();
  }

  // does it contain the whole surface?
  bool is_whole() const { return m_is_whole; }

  // returns which control points do not move
  const std::vector<bool>& is_fixed() const { return m_is_fixed; }

  // returns the patches on which control points act that move, in ascending order
  const std::vector<size_type>& patches() const { return m_patches; }

private:
  // from this share of the control points on, the whole surface is fitted
  static constexpr double largest_share = 0.5;

  // makes all control points free that act on a patch
  void set_free(size_type patch)
  {
    for(size_type i = 0; i < m_samples.number_of_functions(patch); ++i)
      m_is_free[m_samples.function(patch, i)] = true;
  }

  bool has_free_point(size_type patch) const
  {
    for(size_type i = 0; i < m_samples.number_of_functions(patch); ++i)
      if(m_is_free[m_samples.function(patch, i)])
        return true;
    return false;
  }

  // returns `true` if control points have become free
  bool complete(const Groups& groups)
  {
    const std::vector<bool> is_free = m_is_free;
    for(const std::vector<size_type>& group : groups)
    {
      bool is_touched = false;
      for(size_type p : group)
        is_touched = is_touched || has_free_point(p);
      for(size_type p : group)
        if(is_touched)
          set_free(p);
    }
    return m_is_free != is_free;
  }

  void choose_patches()
  {
    size_type movable = 0, free = 0;
    for(size_type c = 0; c < m_is_fixed.size(); ++c)
      if(!m_is_fixed[c])
      {
        ++movable;
        free += m_is_free[c] ? 1 : 0;
      }
    m_is_whole = m_is_whole || double(free) > largest_share * double(movable);
    for(size_type c = 0; c < m_is_fixed.size() && !m_is_whole; ++c)
      if(!m_is_free[c])
        m_is_fixed[c] = true;
    for(size_type p = 0; p < m_samples.number_of_patches(); ++p)
      if(m_is_whole || has_moving_point(p))
        m_patches.push_back(p);
  }

  bool has_moving_point(size_type patch) const
  {
    for(size_type i = 0; i < m_samples.number_of_functions(patch); ++i)
      if(!m_is_fixed[m_samples.function(patch, i)])
        return true;
    return false;
  }

  const Samples& m_samples;
  std::vector<bool> m_is_fixed, m_is_free; // control points
  std::vector<size_type> m_patches;
  bool m_is_whole;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_REFITTED_REGION_H
