// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_PADDED_TRIANGULATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_PADDED_TRIANGULATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Recorded_decimation.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Triangle_locator.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// a halfedge with the same ends as another one, or opposite to an inner vertex of less than three
// faces; -1 if there is none and the mesh is a simplicial complex
inline int non_simplicial_halfedge(const Working_mesh& mesh)
{
  std::set<std::pair<int, int> > ends;
  std::vector<int> number_of_faces(mesh.number_of_vertices(), 0);
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
  {
    ++number_of_faces[mesh.source(h)];
    if(!ends.emplace(mesh.source(h), mesh.target(h)).second)
      return h;
  }
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    if(!mesh.is_border_vertex(mesh.source(h)) && number_of_faces[mesh.source(h)] < 3)
      return Working_mesh::next(h);
  return -1;
}

// Splits edges until the mesh is a simplicial complex; `false` if this is not achieved.
inline bool make_simplicial(Working_mesh& mesh)
{
  const int most_splits = 1000;
  for(int i = 0; i < most_splits; ++i)
  {
    const int h = non_simplicial_halfedge(mesh);
    if(h < 0)
      return true;
    mesh.split_edge(h);
  }
  return false;
}

// A quad layout that every orientable triangle mesh has, by combinatorial means only. The mesh is
// coarsened; a ring is cut off along each boundary loop, at half of the triangles there, and is
// divided into quads; every triangle of the rest is divided into three quads. All vertices on the
// boundary are regular; each loop has at least six sides, and corners are vertices.
class Padded_triangulation
{
public:
  // `size`: wanted edge length of the quads, per vertex.
  // \pre no inner edge of the mesh joins two boundary vertices, and it is a simplicial complex
  Padded_triangulation(const Working_mesh& mesh, const std::vector<double>& size)
    : m_mesh(mesh), m_coarse(decimate(mesh, size)), m_rest(cut_rings())
  {
    m_rest.coarsen(false);
    divide_triangles();
    for(const std::vector<int>& loop : coarse_loops())
      add_ring(loop);
    m_quads.number_vertices();
    attach_vertices();
  }

  const Quad_grid& quads() const { return m_quads; }

  // the point of the working mesh at the local coordinates (u,v) of a quad; neighbours agree
  // exactly
  Working_location operator()(std::size_t quad, double u, double v) const
  {
    const Quad_grid::Place at
      = m_quads.representative(Quad_grid::Place{static_cast<int>(quad), u, v});
    const int n = 3 * static_cast<int>(m_triangles.size());
    const Triangle_point p
      = m_coarse.original(at.quad < n ? locate_in_rest(at.quad, at.u, at.v)
                                      : locate_in_ring(m_intervals[(at.quad - n) / 2],
                                                       ((at.quad - n) % 2 + at.u) / 2, at.v));
    return Working_location{p.triangle, p.barycentric};
  }

private:
  typedef std::array<double, 3> Barycentric;

  // a triangle inside a triangle of the coarse mesh
  struct Cell
  {
    int triangle;
    std::array<Barycentric, 3> corners;

    Triangle_point operator()(const Barycentric& b) const
    {
      Triangle_point p{triangle, {{0, 0, 0}}};
      for(int i = 0; i < 3; ++i)
        for(int j = 0; j < 3; ++j)
          p.barycentric[j] += b[i] * corners[i][j];
      return p;
    }
  };

  // A cell in a ring, with its corners in the plane: the first coordinate runs along the loop, by
  // one per edge of the rest, the second from the boundary (0) to the rest (1).
  struct Ring_cell
  {
    Cell cell;
    std::array<Eigen::Vector2d, 3> positions;
  };

  // the cells of a ring over a unit interval
  typedef std::vector<Ring_cell> Interval;

  // a vertex of the loop of the rest: on the edge from vertex `outer` of the loop to its neighbour
  struct Inner_vertex
  {
    int outer;
    int neighbor;
    double position;
  };

  // a loop of the boundary and the ring beside it
  struct Ring
  {
    std::vector<int> loop;             // the first vertex is repeated at the end
    std::vector<double> positions;     // of its vertices
    std::vector<Inner_vertex> inner;   // the first one is repeated at the end
    int number_of_intervals = 0;
    int first_interval = 0;
  };

  // Coarse edges become two sides of quads.
  static Recorded_decimation decimate(const Working_mesh& mesh, const std::vector<double>& size)
  {
    std::vector<double> edge_length(size);
    for(double& x : edge_length)
      x *= 2;
    Recorded_decimation coarse(mesh.points, mesh.triangles, edge_length, mesh.is_corner);
    coarse.coarsen(true);
    return coarse;
  }

  // Cuts the coarse mesh where the barycentric coordinates of boundary vertices sum up to one half.
  // The vertices of the rest are the inner ones and those where edges have been cut.
  Recorded_decimation cut_rings()
  {
    std::vector<Recorded_decimation::Triangle> triangles;
    for(int v = 0; v < m_coarse.number_of_vertices(); ++v)
    {
      m_rest_points.push_back(m_coarse.point(v));
      m_rest_size.push_back(m_coarse.size(v));
    }
    for(int t : m_coarse.triangles())
      cut_triangle(t, triangles);
    std::vector<char> is_fixed(m_rest_points.size(), 0);
    for(int v = 0; v < m_coarse.number_of_vertices(); ++v)
      if(m_coarse.has_vertex(v) && m_coarse.is_fixed(v))
        is_fixed[cut_vertex(v, m_coarse.ring(v)[radial(v)])] = 1;
    return Recorded_decimation(m_rest_points, triangles, m_rest_size, is_fixed);
  }

  // the edge around a boundary vertex that divides the ring
  int radial(int v) const { return static_cast<int>(m_coarse.ring(v).size() - 1) / 2; }

  int cut_vertex(int boundary_vertex, int inner_vertex)
  {
    const auto entry = m_cut_vertex.emplace(std::make_pair(boundary_vertex, inner_vertex),
                                            static_cast<int>(m_rest_points.size()));
    if(entry.second)
    {
      m_rest_points.push_back((m_coarse.point(boundary_vertex) + m_coarse.point(inner_vertex)) / 2);
      m_rest_size.push_back((m_coarse.size(boundary_vertex) + m_coarse.size(inner_vertex)) / 2);
    }
    return entry.first->second;
  }

  static Barycentric corner(int i)
  {
    Barycentric b = {{0, 0, 0}};
    b[i % 3] = 1;
    return b;
  }

  static Barycentric middle(int i, int j)
  {
    Barycentric b = {{0, 0, 0}};
    b[i % 3] = b[j % 3] = 0.5;
    return b;
  }

  void cut_triangle(int t, std::vector<Recorded_decimation::Triangle>& triangles)
  {
    const Recorded_decimation::Triangle& v = m_coarse.triangle(t);
    int first = 0, count = 0;
    for(int i = 0; i < 3; ++i)
      if(m_coarse.is_border(v[i]))
      {
        ++count;
        if(!m_coarse.is_border(v[(i + 2) % 3]))
          first = i;
      }
    const int i = first, a = v[i], b = v[(i + 1) % 3], c = v[(i + 2) % 3];
    const auto add = [&](int x, int y, int z, const std::array<Barycentric, 3>& corners)
    {
      triangles.push_back({{x, y, z}});
      m_coarse_of_rest.push_back(Cell{t, corners});
    };
    if(count == 0)
      add(a, b, c, {{corner(i), corner(i + 1), corner(i + 2)}});
    else if(count == 1)
    {
      const int p = cut_vertex(a, b), q = cut_vertex(a, c);
      add(p, b, c, {{middle(i, i + 1), corner(i + 1), corner(i + 2)}});
      add(p, c, q, {{middle(i, i + 1), corner(i + 2), middle(i, i + 2)}});
    }
    else
      add(cut_vertex(a, c), cut_vertex(b, c), c,
          {{middle(i, i + 2), middle(i + 1, i + 2), corner(i + 2)}});
  }

  // Quad `3 * k + i` lies at corner `i` of triangle `k` of the rest.
  void divide_triangles()
  {
    m_triangles = m_rest.triangles();
    std::map<std::pair<int, int>, int> quad_at; // the edge from its first to its second vertex
    for(int t : m_triangles)
      for(int i = 0; i < 3; ++i)
      {
        const int q = m_quads.add_quad();
        quad_at[std::make_pair(m_rest.triangle(t)[i], m_rest.triangle(t)[(i + 1) % 3])] = q;
      }
    for(int q = 0; q < m_quads.number_of_quads(); ++q)
      m_quads.link(Quad_grid::Side(q, 1), Quad_grid::Side(next_corner(q), 2));
    for(const auto& entry : quad_at)
    {
      const auto opposite
        = quad_at.find(std::make_pair(entry.first.second, entry.first.first));
      if(opposite != quad_at.end())
        m_quads.link(Quad_grid::Side(entry.second, 0),
                     Quad_grid::Side(next_corner(opposite->second), 3));
      else
        m_border_quad[entry.first.first] = entry.second;
    }
  }

  static int next_corner(int q) { return q % 3 == 2 ? q - 2 : q + 1; }

  // the boundary loops of the coarse mesh
  std::vector<std::vector<int> > coarse_loops() const
  {
    std::vector<std::vector<int> > loops;
    std::vector<char> is_visited(m_coarse.number_of_vertices(), 0);
    for(int v = 0; v < m_coarse.number_of_vertices(); ++v)
    {
      if(!m_coarse.has_vertex(v) || !m_coarse.is_border(v) || is_visited[v])
        continue;
      loops.emplace_back();
      for(int w = v; !is_visited[w]; w = m_coarse.ring(w).front())
      {
        is_visited[w] = 1;
        loops.back().push_back(w);
      }
    }
    return loops;
  }

  void add_ring(const std::vector<int>& loop)
  {
    Ring ring;
    ring.loop = loop;
    ring.loop.push_back(loop.front());
    ring.first_interval = static_cast<int>(m_intervals.size());
    place_inner_vertices(ring);
    m_intervals.resize(m_intervals.size() + ring.number_of_intervals);
    add_cells(ring);
    add_ring_quads(ring);
  }

  // the vertices of the rest beside vertex `outer` of the loop, from neighbour `first` on
  void append_inner(Ring& ring, int outer, int first, int last) const
  {
    for(int i = first; i >= last; --i)
      ring.inner.push_back(Inner_vertex{outer, i, 0});
  }

  int inner_id(const Ring& ring, const Inner_vertex& p) const
  {
    const int v = ring.loop[p.outer];
    return m_cut_vertex.at(std::make_pair(v, m_coarse.ring(v)[p.neighbor]));
  }

  // Numbers the vertices that the rest has on its loop, beginning with zero, and places the others
  // between them. A vertex of the boundary is placed below the inner vertex of its radial edge.
  void place_inner_vertices(Ring& ring)
  {
    const int n = static_cast<int>(ring.loop.size()) - 1;
    append_inner(ring, 0, radial(ring.loop[0]), 1);
    for(int k = 1; k < n; ++k)
      append_inner(ring, k, static_cast<int>(m_coarse.ring(ring.loop[k]).size()) - 2, 1);
    append_inner(ring, n, static_cast<int>(m_coarse.ring(ring.loop[0]).size()) - 2,
                 radial(ring.loop[0]));
    std::map<int, double> position;
    for(const Inner_vertex& p : ring.inner)
    {
      const int id = inner_id(ring, p);
      if(!m_rest.has_vertex(id) || position.count(id) != 0)
        continue;
      const int i = ring.number_of_intervals++;
      position[id] = i;
      m_ring_vertex.push_back(id);
      for(const auto& passed : m_rest.passed_vertices(id))
        position[passed.vertex] = i + passed.position;
    }
    double turn = 0, last = -1;
    ring.positions.resize(ring.loop.size());
    for(Inner_vertex& p : ring.inner)
    {
      const double x = position.at(inner_id(ring, p));
      if(x < last)
        turn += ring.number_of_intervals;
      last = x;
      p.position = x + turn;
      if(p.neighbor == radial(ring.loop[p.outer]))
        ring.positions[p.outer] = p.position;
    }
  }

  void add_cells(const Ring& ring)
  {
    for(std::size_t k = 0; k + 1 < ring.inner.size(); ++k)
    {
      const Inner_vertex& p = ring.inner[k];
      const Inner_vertex& q = ring.inner[k + 1];
      const Eigen::Vector2d at_p(p.position, 1), at_q(q.position, 1);
      const Eigen::Vector2d at_v(ring.positions[p.outer], 0), at_w(ring.positions[q.outer], 0);
      const int v = ring.loop[p.outer];
      const int t = m_coarse.ring_triangles(v)[q.outer == p.outer ? q.neighbor : 0];
      const Recorded_decimation::Triangle& triangle = m_coarse.triangle(t);
      const int i = static_cast<int>(std::find(triangle.begin(), triangle.end(), v)
                                     - triangle.begin());
      if(q.outer == p.outer)
      {
        add_cell(ring, Cell{t, {{corner(i), middle(i, i + 1), middle(i, i + 2)}}},
                 {{at_v, at_q, at_p}});
        continue;
      }
      add_cell(ring, Cell{t, {{corner(i), corner(i + 1), middle(i + 1, i + 2)}}},
               {{at_v, at_w, at_q}});
      add_cell(ring, Cell{t, {{corner(i), middle(i + 1, i + 2), middle(i, i + 2)}}},
               {{at_v, at_q, at_p}});
    }
  }

  void add_cell(const Ring& ring, const Cell& cell, const std::array<Eigen::Vector2d, 3>& positions)
  {
    const double first = (std::min)({positions[0][0], positions[1][0], positions[2][0]});
    const double last = (std::max)({positions[0][0], positions[1][0], positions[2][0]});
    for(int k = static_cast<int>(std::floor(first)); k < last; ++k)
    {
      Ring_cell shifted{cell, positions};
      for(Eigen::Vector2d& x : shifted.positions)
        x[0] -= k;
      m_intervals[ring.first_interval + modulo(k, ring.number_of_intervals)].push_back(shifted);
    }
  }

  static int modulo(int k, int n) { return ((k % n) + n) % n; }

  // two quads per edge of the rest
  void add_ring_quads(const Ring& ring)
  {
    const int n = 2 * ring.number_of_intervals, first = m_quads.number_of_quads();
    for(int i = 0; i < n; ++i)
    {
      m_quads.add_quad();
      m_quads.make_border(Quad_grid::Side(first + i, 0));
      m_quads.borders[first + i][0] = boundary_piece(ring, 0.5 * i);
    }
    for(int i = 0; i < n; ++i)
    {
      m_quads.link(Quad_grid::Side(first + i, 1), Quad_grid::Side(first + (i + 1) % n, 3));
      const int q = m_border_quad.at(m_ring_vertex[ring.first_interval + i / 2]);
      m_quads.link(Quad_grid::Side(first + i, 2),
                   i % 2 == 0 ? Quad_grid::Side(q, 0) : Quad_grid::Side(next_corner(q), 3));
    }
    for(std::size_t k = 0; k + 1 < ring.loop.size(); ++k)
    {
      const double twice = 2 * ring.positions[k];
      if(twice == std::floor(twice))
        m_boundary_vertices.emplace_back(first + modulo(static_cast<int>(twice), n), ring.loop[k]);
    }
  }

  void attach_vertices()
  {
    for(const std::pair<int, int>& entry : m_boundary_vertices)
      m_quads.attach(entry.first, 0, entry.second);
    for(std::size_t k = 0; k < m_triangles.size(); ++k)
      for(int i = 0; i < 3; ++i)
      {
        const int v = m_rest.triangle(m_triangles[k])[i];
        if(v < m_coarse.number_of_vertices())
          m_quads.attach(static_cast<int>(3 * k) + i, 0, v);
      }
  }

  // the boundary from `position` on, by half a unit
  Quad_grid::Border boundary_piece(const Ring& ring, double position) const
  {
    const double n = ring.number_of_intervals;
    const double begin = ring.positions.front();
    double first = position, last = position + 0.5;
    if(first < begin)
      first += n;
    if(last <= begin)
      last += n;
    const std::size_t k = std::upper_bound(ring.positions.begin(), ring.positions.end() - 1, first)
                          - ring.positions.begin() - 1;
    const std::size_t l = std::lower_bound(ring.positions.begin() + 1, ring.positions.end(), last)
                          - ring.positions.begin() - 1;
    Quad_grid::Border border;
    std::size_t chain_at_end = 0;
    if(first == ring.positions[k])
    {
      const auto& piece = m_mesh.boundary_piece[m_mesh.vertex_halfedge[ring.loop[k]]];
      border.chain = piece.chain;
      border.first = piece.first;
    }
    else
      border.first = arc_length(ring, k, first, border.chain);
    if(last == ring.positions[l + 1])
      border.last = m_mesh.boundary_piece[incoming_on_boundary(ring.loop[l + 1])].last;
    else
      border.last = arc_length(ring, l, last, chain_at_end);
    if(border.last <= border.first)
      wrap(border);
    return border;
  }

  // a piece of a closed chain over its seam, or one that ends there
  void wrap(Quad_grid::Border& border) const
  {
    double length = 0;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.boundary_piece[h].chain == border.chain)
        length = (std::max)(length, m_mesh.boundary_piece[h].last);
    if(border.first >= length)
      border.first -= length;
    else
      border.last += length;
  }

  int incoming_on_boundary(int v) const
  {
    int h = Working_mesh::previous(m_mesh.vertex_halfedge[v]);
    while(!m_mesh.is_border(h))
      h = Working_mesh::previous(m_mesh.opposite[h]);
    return h;
  }

  // of the point at `position` on edge `k` of the loop
  double arc_length(const Ring& ring, std::size_t k, double position, std::size_t& chain) const
  {
    const int v = ring.loop[k], t = m_coarse.ring_triangles(v).front();
    const Recorded_decimation::Triangle& triangle = m_coarse.triangle(t);
    const int i = static_cast<int>(std::find(triangle.begin(), triangle.end(), v)
                                   - triangle.begin());
    const double x
      = (position - ring.positions[k]) / (ring.positions[k + 1] - ring.positions[k]);
    Triangle_point p{t, {{0, 0, 0}}};
    p.barycentric[i] = 1 - x;
    p.barycentric[(i + 1) % 3] = x;
    p = m_coarse.original(p);
    for(int h = 3 * p.triangle; h < 3 * p.triangle + 3; ++h)
      if(m_mesh.is_border(h))
      {
        const Working_mesh::Boundary_piece& piece = m_mesh.boundary_piece[h];
        const double a = p.barycentric[h % 3], b = p.barycentric[(h + 1) % 3];
        chain = piece.chain;
        return piece.first + b / (a + b) * (piece.last - piece.first);
      }
    // at a vertex, but in a face without a boundary edge
    const int j = static_cast<int>(std::max_element(p.barycentric.begin(), p.barycentric.end())
                                   - p.barycentric.begin());
    const auto& piece
      = m_mesh.boundary_piece[m_mesh.vertex_halfedge[m_mesh.triangles[p.triangle][j]]];
    chain = piece.chain;
    return piece.first;
  }

  Triangle_point locate_in_rest(std::size_t quad, double u, double v) const
  {
    const int i = static_cast<int>(quad % 3);
    const std::array<Barycentric, 4> corners
      = {{corner(i), middle(i, i + 1), {{1. / 3, 1. / 3, 1. / 3}}, middle(i, i + 2)}};
    const std::array<double, 4> weights = {{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v}};
    Triangle_point p{m_triangles[quad / 3], {{0, 0, 0}}};
    for(int k = 0; k < 4; ++k)
      for(int j = 0; j < 3; ++j)
        p.barycentric[j] += weights[k] * corners[k][j];
    p = m_rest.original(p);
    return m_coarse_of_rest[p.triangle](p.barycentric);
  }

  Triangle_point locate_in_ring(const Interval& interval, double x, double y) const
  {
    const Ring_cell* best = nullptr;
    Barycentric coordinates = {{0, 0, 0}};
    double best_minimum = 0;
    for(const Ring_cell& cell : interval)
    {
      const Barycentric b = barycentric_coordinates(cell.positions, Eigen::Vector2d(x, y));
      const double minimum = (std::min)({b[0], b[1], b[2]});
      if(best != nullptr && minimum <= best_minimum)
        continue;
      best = &cell;
      best_minimum = minimum;
      coordinates = b;
    }
    clamp_to_triangle(coordinates);
    return best->cell(coordinates);
  }

  Working_mesh m_mesh;
  Recorded_decimation m_coarse;
  std::map<std::pair<int, int>, int> m_cut_vertex;  // by boundary and inner vertex of an edge
  std::vector<Eigen::Vector3d> m_rest_points;
  std::vector<double> m_rest_size;
  std::vector<Cell> m_coarse_of_rest;               // per triangle of the rest before coarsening
  Recorded_decimation m_rest;
  std::vector<int> m_triangles;                     // of the rest
  std::map<int, int> m_border_quad;                 // by source of a boundary edge of the rest
  std::vector<int> m_ring_vertex;                   // per interval: where it begins
  std::vector<Interval> m_intervals;
  std::vector<std::pair<int, int> > m_boundary_vertices; // quad and vertex at its first corner
  Quad_grid m_quads;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_PADDED_TRIANGULATION_H
