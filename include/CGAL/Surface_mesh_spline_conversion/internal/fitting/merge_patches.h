// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_MERGE_PATCHES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_MERGE_PATCHES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <map>
#include <tuple>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

template <typename Origin>
class Pair_merger
{
  typedef std::tuple<std::size_t, double, double, double, double> Key;

public:
  Pair_merger(const std::vector<Origin>& all, const std::vector<Origin>& calm) : m_all(all)
  {
    for(const Origin& o : calm)
      m_calm[key(o)] = true;
  }

  std::vector<Origin> operator()()
  {
    std::vector<Origin> result;
    for(const Origin& o : m_all)
    {
      const auto it = m_calm.find(key(o));
      if(it == m_calm.end())
      {
        result.push_back(o);
        continue;
      }
      if(!it->second)
        continue;
      Origin merged = o;
      const double w = o.u1 - o.u0, h = o.v1 - o.v0;
      const int first = w < h ? 0 : 1;
      if(try_merge(o, first, merged) || (w == h && try_merge(o, 1 - first, merged)))
        it->second = false;
      result.push_back(merged);
    }
    return result;
  }

private:
  static Key key(const Origin& o)
  {
    return Key(o.quad, double(o.u0), double(o.v0), double(o.u1), double(o.v1));
  }

  bool try_merge(const Origin& o, int axis, Origin& merged)
  {
    Origin other = o;
    const double size = axis == 0 ? o.u1 - o.u0 : o.v1 - o.v0;
    if(size >= 1)
      return false;
    const double k = (axis == 0 ? o.u0 : o.v0) / size;
    const double shift = std::fmod(k, 2) == 0 ? size : -size;
    (axis == 0 ? other.u0 : other.v0) += shift;
    (axis == 0 ? other.u1 : other.v1) += shift;
    const auto it = m_calm.find(key(other));
    if(it == m_calm.end() || !it->second)
      return false;
    it->second = false;
    merged = o;
    merged.u0 = (std::min)(o.u0, other.u0);
    merged.v0 = (std::min)(o.v0, other.v0);
    merged.u1 = (std::max)(o.u1, other.u1);
    merged.v1 = (std::max)(o.v1, other.v1);
    return true;
  }

  const std::vector<Origin>& m_all;
  std::map<Key, bool> m_calm; // whether it is still there
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif
