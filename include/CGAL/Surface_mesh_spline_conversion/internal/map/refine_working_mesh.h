// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_REFINE_WORKING_MESH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_REFINE_WORKING_MESH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Makes sure that every face has at most one boundary edge and every boundary vertex at least two
// faces: splits the inner edges that join two boundary vertices.
inline void split_ears(Working_mesh& mesh)
{
  // a face with three boundary edges has no inner edge yet
  const int n = mesh.number_of_faces();
  for(int h = 0; h < 3 * n; h += 3)
    if(mesh.is_border(h) && mesh.is_border(h + 1) && mesh.is_border(h + 2))
      mesh.split_edge(h);

  std::vector<std::pair<int, int> > edges;
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    if(mesh.opposite[h] > h && mesh.is_border_vertex(mesh.source(h))
       && mesh.is_border_vertex(mesh.target(h)))
      edges.emplace_back(mesh.source(h), mesh.target(h));
  for(const std::pair<int, int>& e : edges)
    mesh.split_edge(mesh.find_halfedge(e.first, e.second));
}

// Splits edges that are longer than `factor` quads, longest first, so that singularities find a
// place and the map has enough freedom. `size` is the wanted size of the quads at the vertices.
inline void split_long_edges(Working_mesh& mesh, std::vector<double>& size, double factor)
{
  // a size far below the mesh edges is the user's mistake and must not exhaust the memory
  const int most_faces = 3000000;
  typedef std::pair<double, std::pair<int, int> > Entry; // (relative length, end vertices)
  std::priority_queue<Entry> queue;
  const auto push = [&](int h)
  {
    const int a = mesh.source(h), b = mesh.target(h);
    const double length = 2 * mesh.vector(h).norm() / (size[a] + size[b]);
    if(length > factor)
      queue.emplace(length, std::make_pair(a, b));
  };
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    if(mesh.opposite[h] < h)
      push(h);
  while(!queue.empty() && mesh.number_of_faces() < most_faces)
  {
    const std::pair<int, int> edge = queue.top().second;
    queue.pop();
    size.push_back((size[edge.first] + size[edge.second]) / 2);
    const int v = mesh.split_edge(mesh.find_halfedge(edge.first, edge.second));
    mesh.for_each_outgoing(v, [&](int h)
    {
      push(h);
      if(mesh.is_border(Working_mesh::previous(h)))
        push(Working_mesh::previous(h));
    });
  }
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_REFINE_WORKING_MESH_H
