// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_BOUNDARY_POSITIONS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_BOUNDARY_POSITIONS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Seamless_map.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Relates lengths on the boundary in the parameter plane to arc lengths. A position is the length
// in the parameter plane, in units of the map, from the start of the chain.
class Boundary_positions
{
public:
  explicit Boundary_positions(const Seamless_map& map)
    : m_mesh(map.mesh), m_position(map.mesh.number_of_halfedges(), 0)
  {
    std::vector<char> is_visited(m_mesh.number_of_halfedges(), 0);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.is_border(h) && !is_visited[h] && starts_chain(h))
        measure_chain(map, h, is_visited);
  }

  std::size_t chain(int h) const { return m_mesh.boundary_piece[h].chain; }

  // position of the source of a border halfedge
  std::int64_t position(int h) const { return m_position[h]; }

  // the piece of a chain between two positions, of which the first may lie before the start and the
  // last beyond the end of a closed chain; not longer than the chain
  Quad_grid::Border piece(std::size_t chain, double first, double last) const
  {
    const double length = m_tables[chain].back().first;
    if(m_is_closed[chain])
    {
      const double turns = std::floor(first / length);
      first -= turns * length;
      last -= turns * length;
    }
    Quad_grid::Border border;
    border.chain = chain;
    border.first = arc_length(chain, first);
    border.last = last <= length ? arc_length(chain, last)
                                 : m_tables[chain].back().second + arc_length(chain, last - length);
    return border;
  }

  std::size_t number_of_chains() const { return m_tables.size(); }
  bool is_closed(std::size_t chain) const { return m_is_closed[chain]; }
  double chain_length(std::size_t chain) const { return m_tables[chain].back().second; }

private:
  // positions and arc lengths
  typedef std::vector<std::pair<double, double> > Table;

  int previous_on_boundary(int h) const
  {
    int g = Working_mesh::previous(h);
    while(!m_mesh.is_border(g))
      g = Working_mesh::previous(m_mesh.opposite[g]);
    return g;
  }

  bool starts_chain(int h) const
  {
    const int previous = previous_on_boundary(h);
    return chain(previous) != chain(h)
           || m_mesh.boundary_piece[previous].last > m_mesh.boundary_piece[h].last;
  }

  void measure_chain(const Seamless_map& map, int first, std::vector<char>& is_visited)
  {
    const std::size_t c = chain(first);
    if(m_tables.size() <= c)
    {
      m_tables.resize(c + 1);
      m_is_closed.resize(c + 1, false);
    }
    m_tables[c].emplace_back(0, m_mesh.boundary_piece[first].first);
    std::int64_t position = 0;
    int h = first;
    do
    {
      is_visited[h] = 1;
      m_position[h] = position;
      const Fixed_point_2 e
        = minus(map.coordinates[Working_mesh::next(h)], map.coordinates[h]);
      position += e[0] + e[1] < 0 ? -(e[0] + e[1]) : e[0] + e[1];
      m_tables[c].emplace_back(static_cast<double>(position), m_mesh.boundary_piece[h].last);
      h = m_mesh.vertex_halfedge[m_mesh.target(h)];
    }
    while(chain(h) == c && !is_visited[h]);
    m_is_closed[c] = h == first && !m_mesh.is_corner[m_mesh.source(first)];
  }

  double arc_length(std::size_t chain, double position) const
  {
    const Table& table = m_tables[chain];
    auto above = std::upper_bound(table.begin() + 1, table.end() - 1,
                                  std::make_pair(position, table.back().second));
    auto below = above - 1;
    const double ratio = (position - below->first) / (above->first - below->first);
    return below->second
           + (std::min)(1., (std::max)(0., ratio)) * (above->second - below->second);
  }

  const Working_mesh& m_mesh;
  std::vector<std::int64_t> m_position;    // per border halfedge, of its source
  std::vector<Table> m_tables;             // per chain
  std::vector<bool> m_is_closed;           // per chain
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_BOUNDARY_POSITIONS_H
