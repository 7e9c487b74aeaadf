// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_LIMIT_GRADATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_LIMIT_GRADATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Makes sizes grow at most by `gradation` per unit length: steeper ones could not be followed by
// quads of bounded distortion.
inline void limit_gradation(const Working_mesh& mesh, double gradation, std::vector<double>& size)
{
  typedef std::pair<double, int> Entry; // (size, vertex)
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry> > queue;
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
    queue.emplace(size[v], v);
  while(!queue.empty())
  {
    const Entry top = queue.top();
    queue.pop();
    if(top.first > size[top.second])
      continue;
    const auto limit = [&](int v, double distance)
    {
      if(size[v] <= top.first + gradation * distance)
        return;
      size[v] = top.first + gradation * distance;
      queue.emplace(size[v], v);
    };
    mesh.for_each_outgoing(top.second, [&](int h)
    {
      const int back = Working_mesh::previous(h);
      limit(mesh.target(h), mesh.vector(h).norm());
      limit(mesh.source(back), mesh.vector(back).norm());
    });
  }
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_LIMIT_GRADATION_H
