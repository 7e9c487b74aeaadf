// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_STITCHER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_STITCHER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Curve_set.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Free_edges.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Shell_edges.h>

#include <BRepTools_ReShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Replaces the free edges of a B-Rep (the residual) by the boundary edges of a shell, so that both
/// share edges and vertices. The new edges lie on the boundary of the shell; their curves in the
/// parameter planes of the faces of the residual are computed.
template <typename K>
class Stitcher
{
  typedef typename Shell_edges<K>::Piece Piece;

public:
  /// \param tolerance the largest distance of edges, and of vertices, that are joined, in mm
  Stitcher(const NURBS_shell_3<K>& shell, double scale, const TopoDS_Shape& residual,
           double tolerance)
    : m_edges(shell, scale), m_residual(residual), m_free_edges(residual), m_tolerance(tolerance)
  {
    for(std::size_t e = 0; e < shell.number_of_edges(); ++e)
      if(shell.is_border(e))
      {
        m_border.push_back(e);
        const auto& curve = m_edges.curve(e);
        m_border_curves.add(curve, curve->FirstParameter(), curve->LastParameter());
      }
  }

  /// returns the faces of the shell, and then those of the residual.
  std::vector<TopoDS_Face> operator()()
  {
    join_vertices();
    m_edges.make_edges();
    std::vector<TopoDS_Face> faces = m_edges.faces();
    join_edges();
    for(std::size_t e = 0; e < m_edges.shell().number_of_edges(); ++e)
      for(const Piece& piece : m_edges.pieces(e))
        cover_ends(piece.edge);
    for(TopExp_Explorer x(m_reshape->Apply(m_residual), TopAbs_FACE); x.More(); x.Next())
      faces.push_back(TopoDS::Face(x.Current()));
    return faces;
  }

  /// returns how many pieces of boundary edges of the shell stay free.
  std::size_t number_of_unmatched_edges() const { return m_number_of_unmatched_edges; }

  /// returns the largest distance of joined edges.
  double edge_distance() const { return m_edge_distance; }

private:
  // a piece of the boundary of the shell that replaces a part of a free edge
  struct Partner
  {
    const Piece* piece;
    double middle;   // parameter on the free edge
    bool is_forward; // do both run in the same direction?
  };

  // The vertices of the free edges become those of the shell; where the shell has none, an edge of
  // the shell is split.
  void join_vertices()
  {
    TopTools_IndexedMapOfShape vertices;
    for(std::size_t i = 0; i < m_free_edges.size(); ++i)
    {
      vertices.Add(m_free_edges[i].source);
      vertices.Add(m_free_edges[i].target);
    }
    std::vector<std::tuple<double, int, std::size_t> > pairs;
    for(const std::size_t v : vertices_of_border())
      for(int i = 1; i <= vertices.Extent(); ++i)
      {
        const double distance
          = BRep_Tool::Pnt(TopoDS::Vertex(vertices(i))).Distance(m_edges.point(v));
        if(distance <= m_tolerance)
          pairs.emplace_back(distance, i, v);
      }
    std::sort(pairs.begin(), pairs.end());
    std::vector<char> is_joined(vertices.Extent() + 1, false);
    std::vector<char> is_replaced(m_edges.shell().number_of_vertices(), false);
    for(const auto& pair : pairs)
    {
      const int i = std::get<1>(pair);
      const std::size_t v = std::get<2>(pair);
      if(is_joined[i] || is_replaced[v])
        continue;
      is_joined[i] = is_replaced[v] = true;
      m_edges.replace(v, TopoDS::Vertex(vertices(i).Oriented(TopAbs_FORWARD)));
    }
    for(int i = 1; i <= vertices.Extent(); ++i)
      if(!is_joined[i])
        split_border(TopoDS::Vertex(vertices(i).Oriented(TopAbs_FORWARD)));
  }

  std::vector<std::size_t> vertices_of_border() const
  {
    std::vector<std::size_t> result;
    for(std::size_t e : m_border)
      for(std::size_t v : {m_edges.shell().edge(e).source, m_edges.shell().edge(e).target})
        result.push_back(v);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  void split_border(const TopoDS_Vertex& vertex)
  {
    const Curve_set::Foot foot = m_border_curves.nearest(BRep_Tool::Pnt(vertex));
    if(foot.distance > m_tolerance || foot.parameter <= m_border_curves.first(foot.curve)
       || foot.parameter >= m_border_curves.last(foot.curve))
      return;
    m_edges.split(m_border[foot.curve], foot.parameter, vertex);
  }

  void join_edges()
  {
    m_reshape = new BRepTools_ReShape;
    std::vector<std::vector<Partner> > partners(m_free_edges.size());
    for(std::size_t e : m_border)
      for(const Piece& piece : m_edges.pieces(e))
        if(!find_partner(m_edges.curve(e), piece, partners))
          ++m_number_of_unmatched_edges;
    for(std::size_t i = 0; i < partners.size(); ++i)
      if(!partners[i].empty())
        replace_edge(i, partners[i]);
  }

  bool find_partner(const Handle(Geom_Curve)& curve, const Piece& piece,
                    std::vector<std::vector<Partner> >& partners)
  {
    const int samples = 16;
    const double middle = (piece.first + piece.last) / 2;
    const Curve_set::Foot foot = m_free_edges.curves().nearest(curve->Value(middle));
    if(foot.curve == Curve_set::NONE)
      return false;
    double distance = 0;
    for(int k = 0; k <= samples; ++k)
    {
      const gp_Pnt p = curve->Value(piece.first + (piece.last - piece.first) * k / samples);
      distance = (std::max)(distance, m_free_edges.curves().nearest(p, foot.curve).distance);
    }
    if(distance > m_tolerance)
      return false;
    m_edge_distance = (std::max)(m_edge_distance, distance);
    const bool is_forward
      = m_free_edges.curves().tangent(foot.curve, foot.parameter).Dot(curve->DN(middle, 1)) > 0;
    partners[foot.curve].push_back({&piece, foot.parameter, is_forward});
    return true;
  }

  // Replaces free edge i by a chain of pieces; where there is none, by a part of itself.
  void replace_edge(std::size_t i, std::vector<Partner>& partners)
  {
    std::sort(partners.begin(), partners.end(),
              [](const Partner& a, const Partner& b) { return a.middle < b.middle; });
    BRep_Builder builder;
    TopoDS_Wire chain;
    builder.MakeWire(chain);
    TopoDS_Vertex end = m_free_edges[i].source;
    double end_parameter = m_free_edges.curves().first(i);
    for(const Partner& partner : partners)
    {
      const Piece& piece = *partner.piece;
      const TopoDS_Vertex& source = partner.is_forward ? piece.source : piece.target;
      if(!source.IsSame(end))
        builder.Add(chain, part_of_edge(i, end_parameter, parameter_of(i, source), end, source));
      const double begin = source.IsSame(end) ? end_parameter : parameter_of(i, source);
      add_curve_on_face(i, partner, begin);
      builder.Add(chain, piece.edge.Oriented(partner.is_forward ? TopAbs_FORWARD
                                                                : TopAbs_REVERSED));
      end = partner.is_forward ? piece.target : piece.source;
      end_parameter = parameter_of(i, end);
    }
    if(!end.IsSame(m_free_edges[i].target))
      builder.Add(chain, part_of_edge(i, end_parameter, m_free_edges.curves().last(i), end,
                                      m_free_edges[i].target));
    m_reshape->Replace(m_free_edges[i].edge, chain);
  }

  // on a closed edge, the parameter at which a chain arrives at its only vertex is never used
  double parameter_of(std::size_t i, const TopoDS_Vertex& vertex) const
  {
    if(vertex.IsSame(m_free_edges[i].source) || vertex.IsSame(m_free_edges[i].target))
      return m_free_edges.parameter(i, vertex);
    return m_free_edges.curves().nearest(BRep_Tool::Pnt(vertex), i).parameter;
  }

  TopoDS_Edge part_of_edge(std::size_t i, double first, double last, const TopoDS_Vertex& source,
                           const TopoDS_Vertex& target) const
  {
    BRep_Builder builder;
    TopoDS_Edge edge = TopoDS::Edge(m_free_edges[i].edge.EmptyCopied());
    builder.Add(edge, source.Oriented(TopAbs_FORWARD));
    builder.Add(edge, target.Oriented(TopAbs_REVERSED));
    builder.Range(edge, first, last);
    cover_ends(edge);
    return edge;
  }

  // adds the curve of a piece in the parameter plane of the face at free edge i; `begin` is the
  // parameter on the free edge of the end that comes first there
  void add_curve_on_face(std::size_t i, const Partner& partner, double begin) const
  {
    const TopoDS_Face& face = m_free_edges[i].face;
    double first, last;
    const Handle(Geom2d_Curve) old = BRep_Tool::CurveOnSurface(m_free_edges[i].edge, face, first,
                                                               last);
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(partner.piece->edge, first, last);
    // where the first parameter of the piece lies on the free edge
    double start = begin;
    if(!partner.is_forward)
    {
      start = m_free_edges.curves().nearest(curve->Value(first), i).parameter;
      if(start < partner.middle) // the vertex of a closed edge, as the start of it
        start = m_free_edges.curves().last(i);
    }
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    const Handle(Geom2d_Curve) pcurve
      = Edge_on_surface(curve, surface)(first, last, old->Value(start));
    BRep_Builder().UpdateEdge(partner.piece->edge, pcurve, face, Precision::Confusion());
    BRep_Builder().Range(partner.piece->edge, first, last);
    cover_deviation(partner.piece->edge, edge_deviation(curve, pcurve, surface, first, last));
  }

  Shell_edges<K> m_edges;
  TopoDS_Shape m_residual;
  Free_edges m_free_edges;
  double m_tolerance;
  std::vector<std::size_t> m_border; // the boundary edges of the shell
  Curve_set m_border_curves;         // with the same indices
  Handle(BRepTools_ReShape) m_reshape;
  std::size_t m_number_of_unmatched_edges = 0;
  double m_edge_distance = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_STITCHER_H
