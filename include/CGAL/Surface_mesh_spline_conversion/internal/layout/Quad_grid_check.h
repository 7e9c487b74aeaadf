// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_GRID_CHECK_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_GRID_CHECK_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Boundary_positions.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Seamless_map.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Checks that quads cover the mesh of a map as they should. The quads are manifold by construction:
// they are glued along sides only, and vertices are found by walking around them.
class Quad_grid_check
{
public:
  Quad_grid_check(const Seamless_map& map, const Boundary_positions& positions,
                  const Quad_grid& quads)
    : m_map(map), m_mesh(map.mesh), m_positions(positions), m_quads(quads)
  {}

  // returns an empty string or what is wrong
  const char* run() const
  {
    if(m_quads.euler_characteristic() != m_mesh.euler_characteristic())
      return "the quads do not have the topology of the mesh";
    if(!has_right_valences())
      return "a vertex of the layout has the wrong number of quads";
    if(!has_all_critical_vertices())
      return "a singularity or corner is not a vertex of the layout";
    if(!covers_boundary())
      return "the boundary sides of the quads do not cover the boundary once";
    return "";
  }

private:
  // pieces of the boundary that follow each other agree to this part of the length of the chain
  static constexpr double rounding = 1e-9;

  bool has_right_valences() const
  {
    for(int v = 0; v < m_quads.number_of_vertices(); ++v)
    {
      const int at = m_quads.mesh_vertex[v];
      const int valence = at >= 0 ? m_map.cone[at] : (m_quads.is_border_vertex[v] ? 2 : 4);
      if(m_quads.valence[v] != valence
         || (at >= 0 && m_mesh.is_border_vertex(at) != bool(m_quads.is_border_vertex[v])))
        return false;
    }
    return true;
  }

  // one vertex of the layout at every cone and corner, never two at the same vertex of the mesh
  bool has_all_critical_vertices() const
  {
    std::vector<char> is_used(m_mesh.number_of_vertices(), 0);
    for(int at : m_quads.mesh_vertex)
      if(at >= 0)
      {
        if(is_used[at])
          return false;
        is_used[at] = 1;
      }
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
    {
      const bool is_border = m_mesh.is_border_vertex(v);
      const bool is_critical
        = m_map.cone[v] != (is_border ? 2 : 4) || (is_border && m_mesh.is_corner[v]);
      if(is_critical && !is_used[v])
        return false;
    }
    return true;
  }

  bool covers_boundary() const
  {
    std::vector<std::vector<std::pair<double, double> > > pieces(m_positions.number_of_chains());
    for(int q = 0; q < m_quads.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        if(!m_quads.is_border(q, i))
          continue;
        const Quad_grid::Border& border = m_quads.borders[q][i];
        if(border.chain >= pieces.size() || !(border.first < border.last))
          return false;
        pieces[border.chain].emplace_back(border.first, border.last);
      }
    for(std::size_t c = 0; c < pieces.size(); ++c)
    {
      std::sort(pieces[c].begin(), pieces[c].end());
      if(pieces[c].empty() || !covers_chain(c, pieces[c]))
        return false;
    }
    return true;
  }

  bool covers_chain(std::size_t c, const std::vector<std::pair<double, double> >& pieces) const
  {
    const double length = m_positions.chain_length(c);
    double end = m_positions.is_closed(c) ? pieces.back().second - length : 0;
    for(const std::pair<double, double>& piece : pieces)
    {
      if(std::abs(piece.first - end) > rounding * length)
        return false;
      end = piece.second;
    }
    return m_positions.is_closed(c) || std::abs(end - length) <= rounding * length;
  }

  const Seamless_map& m_map;
  const Working_mesh& m_mesh;
  const Boundary_positions& m_positions;
  const Quad_grid& m_quads;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_GRID_CHECK_H
