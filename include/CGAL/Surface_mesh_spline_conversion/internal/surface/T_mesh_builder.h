// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_MESH_BUILDER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_MESH_BUILDER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>

#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Builds the control T-mesh of a quad layout with the boundary conditions of section 3.1.2 of the
// article (Fig. 6 a, b, c): a 0-channel along the boundary, whose outer row of vertices (row 0)
// controls the boundary curve and whose inner row (row 1, the vertices of the layout) controls
// the tangent planes. The initial control points reproduce a flat uniform layout.
//
// The triple knot at a corner between two quads is one of both rows (Fig. 6 b), but of row 0 only if
// one of these quads has an extraordinary vertex.
template <typename GeomTraits>
class T_mesh_builder
{
  typedef typename GeomTraits::FT FT;
  typedef typename GeomTraits::Point_3 Point_3;
  typedef Quad_layout<GeomTraits> Layout;
  typedef typename Layout::Side Side;
  typedef T_mesh<Point_3> Mesh;
  typedef typename Mesh::Vertex Vertex;
  typedef typename Mesh::Halfedge Halfedge;
  typedef typename Mesh::Face Face;

  static constexpr std::size_t null = Layout::null;

  // the edges of the 0-channel at a boundary vertex of the layout, each from row 0 to row 1
  struct Radials
  {
    std::vector<Halfedge> incoming; // along the boundary, up to the vertex
    std::vector<Halfedge> outgoing; // from the vertex on
    Vertex before, after;           // further vertices of row 0, if only this has a triple knot
  };

  // what is around a vertex of the layout
  struct Layout_vertex
  {
    int quads = 0;
    int boundary_sides = 0;  // that begin here
    Side outgoing = Side(null, 0), incoming = Side(null, 0);
  };

public:
  T_mesh_builder(const Layout& layout, Mesh& mesh) : m_layout(layout), m_mesh(mesh) {}

  // the row-0 vertex where a chain begins, for each chain of the layout
  const std::vector<Vertex>& chain_starts() const { return m_chain_starts; }
  const std::vector<bool>& chain_is_closed() const { return m_chain_is_closed; }
  const std::string& message() const { return m_message; }

  Error_code build()
  {
    if(!check_layout())
      return Error_code::NO_QUAD_LAYOUT;
    for(std::size_t v = 0; v < m_layout.number_of_vertices(); ++v)
      m_mesh.mesh().add_vertex(m_layout.point(v));
    m_sides.resize(4 * m_layout.number_of_quads());
    m_radials.resize(m_layout.number_of_vertices());
    for(std::size_t v = 0; v < m_layout.number_of_vertices(); ++v)
      if(is_boundary(v))
        add_radials(v);
    add_edges_of_quads();
    add_quads();
    for(std::size_t v = 0; v < m_layout.number_of_vertices(); ++v)
      if(is_boundary(v))
        add_channel(m_vertices[v].outgoing);
    close_border();
    set_vertex_halfedges();
    find_chain_starts();
    m_mesh.update();
    return Error_code::OK;
  }

private:
  bool is_boundary(std::size_t v) const { return m_vertices[v].outgoing.first != null; }
  bool is_convex_corner(std::size_t v) const { return is_boundary(v) && m_vertices[v].quads == 1; }
  bool is_extraordinary(std::size_t v) const
  {
    return !is_boundary(v) && m_vertices[v].quads != 4;
  }
  bool is_regular_corner(std::size_t v) const
  {
    return is_boundary(v) && m_vertices[v].quads == 2 && m_layout.is_corner(v);
  }

  // has a corner between two quads a triple knot in rows 0 and 1?
  bool has_two_triple_knots(std::size_t v) const
  {
    if(!is_regular_corner(v))
      return false;
    const std::size_t before = m_vertices[v].incoming.first, after = m_vertices[v].outgoing.first;
    for(int k = 0; k < 4; ++k)
      if(is_extraordinary(m_layout.vertex(before, k)) || is_extraordinary(m_layout.vertex(after, k)))
        return false;
    return true;
  }

  bool fail(std::size_t v, const std::string& reason)
  {
    m_message = "vertex " + std::to_string(v) + " of the quad layout " + reason;
    return false;
  }

  bool check_layout()
  {
    m_vertices.resize(m_layout.number_of_vertices());
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        ++m_vertices[m_layout.vertex(q, i)].quads;
        if(m_layout.is_border(q, i))
        {
          ++m_vertices[m_layout.vertex(q, i)].boundary_sides;
          m_vertices[m_layout.vertex(q, i)].outgoing = Side(q, i);
          m_vertices[m_layout.vertex(q, i + 1)].incoming = Side(q, i);
        }
      }
    for(std::size_t v = 0; v < m_vertices.size(); ++v)
    {
      if(m_vertices[v].quads == 0)
        return fail(v, "belongs to no quad");
      if(m_vertices[v].boundary_sides > 1)
        return fail(v, "lies on the boundary more than once");
      if(is_boundary(v) && m_vertices[v].quads > 2)
        return fail(v, "is a boundary vertex of more than two quads; move the singularity inwards");
      if(!is_boundary(v) && m_vertices[v].quads < 3)
        return fail(v, "is an interior vertex of less than three quads");
    }
    return true;
  }

  Point_3 point(const Side& side, FT x, FT y) const // x along the side, y inwards
  {
    const std::size_t q = side.first;
    const int i = side.second;
    const Point_3 p = CGAL::barycenter(m_layout.point(m_layout.vertex(q, i)), FT(1) - x,
                                       m_layout.point(m_layout.vertex(q, i + 1)), x);
    const Point_3 r = CGAL::barycenter(m_layout.point(m_layout.vertex(q, i + 3)), FT(1) - x,
                                       m_layout.point(m_layout.vertex(q, i + 2)), x);
    return CGAL::barycenter(p, FT(1) - y, r, y);
  }

  Vertex add_vertex(const Point_3& p) { return m_mesh.mesh().add_vertex(p); }

  Halfedge add_edge(Vertex source, Vertex target, Ticks length)
  {
    auto& mesh = m_mesh.mesh();
    const Halfedge h = mesh.add_edge();
    mesh.set_target(h, target);
    mesh.set_target(mesh.opposite(h), source);
    m_mesh.set_length(h, length);
    return h;
  }

  // adds a face along the halfedges and marks its corners
  void add_face(const std::vector<Halfedge>& halfedges, const std::vector<bool>& is_corner,
                const Face_origin& origin)
  {
    auto& mesh = m_mesh.mesh();
    const Face f = mesh.add_face();
    for(std::size_t i = 0; i < halfedges.size(); ++i)
    {
      mesh.set_face(halfedges[i], f);
      mesh.set_next(halfedges[i], halfedges[(i + 1) % halfedges.size()]);
      m_mesh.set_corner(halfedges[i], is_corner[i]);
    }
    mesh.set_halfedge(f, halfedges.front());
    m_mesh.set_origin(f, origin);
  }

  // adds the vertices and edges of the 0-channel that belong to a boundary vertex of the layout;
  // control points lie at the Greville abscissae of their functions
  void add_radials(std::size_t v)
  {
    const FT third = FT(1) / FT(3);
    const Vertex vertex(static_cast<typename Mesh::Mesh::size_type>(v));
    const Side out = m_vertices[v].outgoing, in = m_vertices[v].incoming;
    Radials& radials = m_radials[v];
    auto radial = [&](Vertex row_0, Vertex row_1)
    { return add_edge(row_0, row_1, zero_interval_ticks); };

    if(is_convex_corner(v))
    {
      m_mesh.mesh().point(vertex) = point(out, third, third);
      const Vertex before = add_vertex(point(out, 0, third));
      const Vertex after = add_vertex(point(out, third, 0));
      const Vertex corner = add_vertex(point(out, 0, 0));
      radials.incoming = {radial(before, vertex)};
      radials.outgoing = {radial(after, vertex)};
      const Halfedge h1 = add_edge(corner, after, zero_interval_ticks);
      const Halfedge h2 = add_edge(before, corner, zero_interval_ticks);
      Face_origin origin;
      origin.kind = Face_origin::CORNER;
      origin.quad = out.first;
      origin.side = out.second;
      origin.last = {{zero_interval_ticks, zero_interval_ticks}};
      add_face({h1, radials.outgoing[0], m_mesh.opposite(radials.incoming[0]), h2},
               std::vector<bool>(4, true), origin);
      return;
    }
    m_mesh.mesh().point(vertex) = point(out, 0, third);
    const Halfedge center = radial(add_vertex(point(out, 0, 0)), vertex);
    radials.incoming = radials.outgoing = {center};
    if(is_regular_corner(v) && !has_two_triple_knots(v))
    {
      radials.before = add_vertex(point(in, FT(1) - third, 0));
      radials.after = add_vertex(point(out, third, 0));
    }
    else if(is_regular_corner(v))
    {
      const FT last = FT(1) - third;
      radials.incoming.insert(radials.incoming.begin(),
        radial(add_vertex(point(in, last, 0)), add_vertex(point(in, last, third))));
      radials.outgoing.push_back(
        radial(add_vertex(point(out, third, 0)), add_vertex(point(out, third, third))));
    }
  }

  // all radial edges along a boundary side
  std::vector<Halfedge> radials_of_side(const Side& side) const
  {
    std::vector<Halfedge> result = m_radials[m_layout.vertex(side.first, side.second)].outgoing;
    const Radials& end = m_radials[m_layout.vertex(side.first, side.second + 1)];
    result.insert(result.end(), end.incoming.begin(), end.incoming.end());
    return result;
  }

  // positions of the radial edges along a boundary side
  std::vector<Ticks> positions_on_side(const Side& side) const
  {
    std::vector<Ticks> result(1, 0);
    if(has_two_triple_knots(m_layout.vertex(side.first, side.second)))
      result.push_back(zero_interval_ticks);
    if(has_two_triple_knots(m_layout.vertex(side.first, side.second + 1)))
      result.push_back(unit_ticks - zero_interval_ticks);
    result.push_back(unit_ticks);
    return result;
  }

  void add_edges_of_quads()
  {
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        const Side side(q, i), neighbor = m_layout.neighbor(q, i);
        std::vector<Halfedge>& halfedges = m_sides[4 * q + i];
        if(m_layout.is_border(q, i))
        {
          const std::vector<Halfedge> radials = radials_of_side(side);
          const std::vector<Ticks> x = positions_on_side(side);
          for(std::size_t j = 0; j + 1 < radials.size(); ++j)
            halfedges.push_back(add_edge(m_mesh.target(radials[j]), m_mesh.target(radials[j + 1]),
                                         x[j + 1] - x[j]));
        }
        else if(halfedges.empty())
        {
          typedef typename Mesh::Mesh::size_type size_type;
          const Halfedge h = add_edge(Vertex(size_type(m_layout.vertex(q, i))),
                                      Vertex(size_type(m_layout.vertex(q, i + 1))), unit_ticks);
          halfedges.push_back(h);
          m_sides[4 * neighbor.first + (neighbor.second & 3)].push_back(m_mesh.opposite(h));
        }
      }
  }

  void add_quads()
  {
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
    {
      std::vector<Halfedge> halfedges;
      std::vector<bool> is_corner;
      for(int i = 0; i < 4; ++i)
      {
        const std::vector<Halfedge>& side = m_sides[4 * q + i];
        halfedges.insert(halfedges.end(), side.begin(), side.end());
        is_corner.resize(halfedges.size(), false);
        is_corner.back() = true;
      }
      Face_origin origin;
      origin.quad = q;
      origin.last = {{unit_ticks, unit_ticks}};
      add_face(halfedges, is_corner, origin);
    }
  }

  // adds the faces of the 0-channel along a boundary side
  void add_channel(const Side& side)
  {
    const std::vector<Halfedge> radials = radials_of_side(side);
    const std::vector<Ticks> x = positions_on_side(side);
    const std::vector<Halfedge>& row_1 = m_sides[4 * side.first + side.second];
    for(std::size_t j = 0; j + 1 < radials.size(); ++j)
    {
      Face_origin origin;
      origin.kind = Face_origin::CHANNEL;
      origin.quad = side.first;
      origin.side = side.second;
      origin.first = {{x[j], 0}};
      origin.last = {{x[j + 1], zero_interval_ticks}};
      std::vector<Halfedge> halfedges
        = row_0_edges(radials[j], radials[j + 1], x[j + 1] - x[j],
                      j == 0 ? m_radials[m_layout.vertex(side.first, side.second)].after : Vertex(),
                      j + 2 == radials.size()
                        ? m_radials[m_layout.vertex(side.first, side.second + 1)].before : Vertex());
      std::vector<bool> is_corner(halfedges.size() + 3, true);
      for(std::size_t k = 0; k + 1 < halfedges.size(); ++k)
        is_corner[k] = false;
      for(Halfedge h : {radials[j + 1], m_mesh.opposite(row_1[j]), m_mesh.opposite(radials[j])})
        halfedges.push_back(h);
      add_face(halfedges, is_corner, origin);
    }
  }

  // adds the edges of row 0 between two radial edges, by way of the given vertices if there are any
  std::vector<Halfedge> row_0_edges(Halfedge first, Halfedge last, Ticks length, Vertex after,
                                    Vertex before)
  {
    std::vector<Halfedge> result;
    Vertex v = m_mesh.source(first);
    if(after.is_valid())
    {
      result.push_back(add_edge(v, after, zero_interval_ticks));
      length -= zero_interval_ticks;
      v = after;
    }
    if(before.is_valid())
    {
      result.push_back(add_edge(v, before, length - zero_interval_ticks));
      length = zero_interval_ticks;
      v = before;
    }
    result.push_back(add_edge(v, m_mesh.source(last), length));
    return result;
  }

  // links the halfedges without a face along the boundary
  void close_border()
  {
    auto& mesh = m_mesh.mesh();
    std::vector<Halfedge> from(mesh.num_vertices());
    for(Halfedge h : mesh.halfedges())
      if(!mesh.face(h).is_valid())
        from[mesh.source(h)] = h;
    for(Halfedge h : mesh.halfedges())
      if(!mesh.face(h).is_valid())
        mesh.set_next(h, from[mesh.target(h)]);
  }

  void set_vertex_halfedges()
  {
    auto& mesh = m_mesh.mesh();
    for(Halfedge h : mesh.halfedges())
      if(!mesh.halfedge(mesh.target(h)).is_valid() || !mesh.face(h).is_valid())
        mesh.set_halfedge(mesh.target(h), h);
  }

  // a chain begins at the corner, which on a convex corner is the source of the crossing's edge
  void find_chain_starts()
  {
    std::vector<FT> first(m_layout.number_of_chains());
    m_chain_starts.assign(m_layout.number_of_chains(), Vertex());
    m_chain_is_closed.assign(m_layout.number_of_chains(), false);
    for(std::size_t v = 0; v < m_layout.number_of_vertices(); ++v)
    {
      if(!is_boundary(v))
        continue;
      const Side side = m_vertices[v].outgoing;
      const auto& piece = m_layout.boundary_side(side.first, side.second);
      if(piece.chain == null
         || (m_chain_starts[piece.chain].is_valid() && first[piece.chain] <= piece.first))
        continue;
      first[piece.chain] = piece.first;
      m_chain_is_closed[piece.chain] = !m_layout.is_corner(v);
      const Halfedge radial = m_radials[v].outgoing.front();
      m_chain_starts[piece.chain]
        = m_mesh.source(is_convex_corner(v) ? m_mesh.prev(radial) : radial);
    }
  }

  const Layout& m_layout;
  Mesh& m_mesh;
  std::vector<Layout_vertex> m_vertices;
  std::vector<Radials> m_radials;
  std::vector<std::vector<Halfedge> > m_sides; // halfedges of side i of quad q at 4 q + i
  std::vector<Vertex> m_chain_starts;
  std::vector<bool> m_chain_is_closed;
  std::string m_message;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_MESH_BUILDER_H
