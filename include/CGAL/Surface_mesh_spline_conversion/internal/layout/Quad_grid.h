// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_GRID_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_GRID_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The combinatorics of a quad layout under construction: quads that are linked side by side, their
// vertices, and what lies on the boundary. Sides and vertices are numbered as in `Quad_layout`.
struct Quad_grid
{
  typedef std::pair<int, int> Side; // quad and number of the side

  // a piece of a boundary chain, in arc lengths
  struct Border
  {
    std::size_t chain = Working_mesh::no_chain;
    double first = 0;
    double last = 0;
  };

  // the point at the local coordinates (u,v) of a quad
  struct Place
  {
    int quad;
    double u, v;
  };

  static constexpr int border = -1;  // the quad beyond a border side
  static constexpr int unknown = -2;

  std::vector<std::array<Side, 4> > neighbors;
  std::vector<std::array<Border, 4> > borders;
  std::vector<std::array<int, 4> > vertices;
  std::vector<int> valence;                 // per vertex: number of quads
  std::vector<Side> first_corner;           // per vertex: the first quad and which of its corners
  std::vector<char> is_border_vertex;       // per vertex
  std::vector<int> mesh_vertex;             // per vertex: vertex of the working mesh there, or -1

  int number_of_quads() const { return static_cast<int>(neighbors.size()); }
  int number_of_vertices() const { return static_cast<int>(valence.size()); }
  bool is_border(int quad, int side) const { return neighbors[quad][side].first == border; }

  int add_quad()
  {
    std::array<Side, 4> none;
    none.fill(Side(unknown, 0));
    neighbors.push_back(none);
    borders.emplace_back();
    return number_of_quads() - 1;
  }

  // Makes two sides neighbours; `false` if one of them has another neighbour already.
  bool link(const Side& a, const Side& b)
  {
    return a != b && link_one_way(a, b) && link_one_way(b, a);
  }

  bool make_border(const Side& side) { return link_one_way(side, Side(border, 0)); }

  // Numbers the vertices by walking around them; `false` if a side has no neighbour.
  bool number_vertices()
  {
    for(const auto& sides : neighbors)
      for(const Side& side : sides)
        if(side.first == unknown)
          return false;
    std::array<int, 4> none;
    none.fill(unknown);
    vertices.assign(neighbors.size(), none);
    valence.clear();
    first_corner.clear();
    is_border_vertex.clear();
    for(int q = 0; q < number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
        if(vertices[q][i] == unknown)
          number_vertex(Side(q, i));
    mesh_vertex.assign(valence.size(), -1);
    return true;
  }

  // Notes that vertex `i` of a quad lies at a vertex of the working mesh; `false` if another one is
  // there.
  bool attach(int quad, int i, int v)
  {
    int& attached = mesh_vertex[vertices[quad][i]];
    if(attached >= 0 && attached != v)
      return false;
    attached = v;
    return true;
  }

  // The same point as seen from the first of the quads that have it in common. What is evaluated
  // there is the same for all of them, without any rounding.
  // \pre the vertices have been numbered
  Place representative(const Place& place) const
  {
    Place p = is_corner(place) ? place : on_first_side(place);
    if(!is_corner(p))
      return p;
    const int i = p.v == 0 ? int(p.u) : 3 - int(p.u);
    const Side& first = first_corner[vertices[p.quad][i]];
    return Place{first.first, first.second == 1 || first.second == 2 ? 1. : 0.,
                 first.second >= 2 ? 1. : 0.};
  }

  int euler_characteristic() const
  {
    int half_edges = 0;
    for(const auto& sides : neighbors)
      for(const Side& side : sides)
        half_edges += side.first == border ? 2 : 1;
    return number_of_vertices() - half_edges / 2 + number_of_quads();
  }

private:
  static bool is_corner(const Place& p)
  {
    return (p.u == 0 || p.u == 1) && (p.v == 0 || p.v == 1);
  }

  // a place that is no corner, from the first quad at its side if it is on one
  Place on_first_side(const Place& p) const
  {
    const int i = p.v == 0 ? 0 : p.u == 1 ? 1 : p.v == 1 ? 2 : p.u == 0 ? 3 : -1;
    if(i < 0 || is_border(p.quad, i) || Side(p.quad, i) < neighbors[p.quad][i])
      return p;
    const Side& first = neighbors[p.quad][i];
    // sides run along their coordinate (0 and 1) or against it, neighbours in opposite directions
    const double x = i % 2 == 0 ? p.u : p.v;
    const double y = (i < 2) == (first.second < 2) ? 1 - x : x;
    switch(first.second)
    {
      case 0: return Place{first.first, y, 0};
      case 1: return Place{first.first, 1, y};
      case 2: return Place{first.first, y, 1};
      default: return Place{first.first, 0, y};
    }
  }

  bool link_one_way(const Side& from, const Side& to)
  {
    Side& neighbor = neighbors[from.first][from.second];
    if(neighbor.first == unknown)
      neighbor = to;
    return neighbor == to;
  }

  // the quads around vertex `corner.second` of a quad: across the side that starts at the vertex,
  // and across the one that ends there
  bool step_clockwise(Side& corner) const
  {
    const Side next = neighbors[corner.first][corner.second];
    if(next.first != border)
      corner = Side(next.first, (next.second + 1) & 3);
    return next.first != border;
  }

  bool step_counterclockwise(Side& corner) const
  {
    const Side next = neighbors[corner.first][(corner.second + 3) & 3];
    if(next.first != border)
      corner = next;
    return next.first != border;
  }

  void number_vertex(const Side& first)
  {
    Side corner = first;
    bool is_on_border = false;
    while(!is_on_border)
    {
      is_on_border = !step_counterclockwise(corner);
      if(corner == first)
        break;
    }
    const Side start = corner;
    const int id = number_of_vertices();
    valence.push_back(0);
    first_corner.push_back(first);
    is_border_vertex.push_back(is_on_border);
    do
    {
      vertices[corner.first][corner.second] = id;
      ++valence.back();
    }
    while(step_clockwise(corner) && corner != start);
  }
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_GRID_H
