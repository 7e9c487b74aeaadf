// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_BOUNDARY_CHAINS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_BOUNDARY_CHAINS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The boundary edges of a working mesh by the arc lengths of their chains.
class Boundary_chains
{
public:
  explicit Boundary_chains(const Working_mesh& mesh) : m_mesh(&mesh)
  {
    for(int h = 0; h < mesh.number_of_halfedges(); ++h)
      if(mesh.is_border(h))
      {
        const Working_mesh::Boundary_piece& piece = mesh.boundary_piece[h];
        if(m_edges.size() <= piece.chain)
          m_edges.resize(piece.chain + 1);
        m_edges[piece.chain].emplace_back(piece.first, h);
      }
    for(auto& edges : m_edges)
      std::sort(edges.begin(), edges.end());
  }

  // the point at an arc length, which is proportional to the length on each edge
  // \pre there is a chain of this number
  Working_location operator()(std::size_t chain, double arc_length) const
  {
    const std::vector<std::pair<double, int> >& edges = m_edges[chain];
    const auto above = std::upper_bound(edges.begin() + 1, edges.end(),
                                        std::make_pair(arc_length, m_mesh->number_of_halfedges()));
    const int h = (above - 1)->second;
    const Working_mesh::Boundary_piece& piece = m_mesh->boundary_piece[h];
    const double t = (arc_length - piece.first) / (piece.last - piece.first);
    Working_location place{h / 3, {{0, 0, 0}}};
    place.barycentric[(h + 1) % 3] = (std::max)(0., (std::min)(1., t));
    place.barycentric[h % 3] = 1 - place.barycentric[(h + 1) % 3];
    return place;
  }

  // the arc lengths of the vertices between two arc lengths, in increasing order
  std::vector<double> vertices_between(std::size_t chain, double first, double last) const
  {
    std::vector<double> result;
    const std::vector<std::pair<double, int> >& edges = m_edges[chain];
    for(auto edge = std::upper_bound(edges.begin(), edges.end(),
                                     std::make_pair(first, m_mesh->number_of_halfedges()));
        edge != edges.end() && edge->first < last; ++edge)
      result.push_back(edge->first);
    return result;
  }

private:
  const Working_mesh* m_mesh;
  std::vector<std::vector<std::pair<double, int> > > m_edges; // per chain: (arc length, halfedge)
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_BOUNDARY_CHAINS_H
