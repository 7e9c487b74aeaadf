// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_SHELL_EDGES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_SHELL_EDGES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Edge_on_surface.h>

#include <CGAL/number_utils.h>

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Tolerances are this much larger than what was measured at samples.
constexpr double TOLERANCE_MARGIN = 1.05;

/// makes the tolerance of an edge cover a measured deviation.
inline void cover_deviation(const TopoDS_Edge& edge, double deviation)
{
  BRep_Builder().UpdateEdge(edge, (std::max)(TOLERANCE_MARGIN * deviation, Precision::Confusion()));
}

/// makes the tolerances of the vertices of an edge cover the edge and its ends.
inline void cover_ends(const TopoDS_Edge& edge)
{
  double first, last;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  TopoDS_Vertex source, target;
  TopExp::Vertices(edge, source, target);
  const double tolerance = BRep_Tool::Tolerance(edge);
  const auto cover = [tolerance](const TopoDS_Vertex& v, const gp_Pnt& end)
  {
    const double distance = TOLERANCE_MARGIN * BRep_Tool::Pnt(v).Distance(end);
    BRep_Builder().UpdateVertex(v, (std::max)(tolerance, distance));
  };
  cover(source, curve->Value(first));
  cover(target, curve->Value(last));
}

/// makes an edge on a curve between two vertices.
inline TopoDS_Edge make_edge(const Handle(Geom_Curve)& curve, double first, double last,
                             const TopoDS_Vertex& source, const TopoDS_Vertex& target)
{
  BRep_Builder builder;
  TopoDS_Edge edge;
  builder.MakeEdge(edge, curve, Precision::Confusion());
  builder.Range(edge, first, last);
  builder.Add(edge, source.Oriented(TopAbs_FORWARD));
  builder.Add(edge, target.Oriented(TopAbs_REVERSED));
  return edge;
}

/// Turns a `NURBS_shell_3` into faces of Open CASCADE that share edges and vertices. Between the
/// construction and `faces()`, vertices can be replaced, and edges split.
template <typename K>
class Shell_edges
{
  typedef NURBS_shell_3<K> Shell;
  typedef Knot_vector<typename K::FT> Knots;

public:
  /// a part of an edge
  struct Piece
  {
    TopoDS_Edge edge;
    double first, last;
    TopoDS_Vertex source, target;
  };

  /// \param scale the length of a model unit in millimetres
  Shell_edges(const Shell& shell, double scale)
    : m_shell(shell), m_scale(scale), m_vertices(shell.number_of_vertices()),
      m_pieces(shell.number_of_edges())
  {
    BRep_Builder builder;
    for(std::size_t v = 0; v < shell.number_of_vertices(); ++v)
      builder.MakeVertex(m_vertices[v], point(shell.point(v)), Precision::Confusion());
    for(std::size_t e = 0; e < shell.number_of_edges(); ++e)
      m_curves.push_back(curve(shell.edge(e).curve));
  }

  const Shell& shell() const { return m_shell; }

  const Handle(Geom_BSplineCurve)& curve(std::size_t e) const { return m_curves[e]; }

  /// returns the point of vertex `v` of the shell.
  gp_Pnt point(std::size_t v) const { return BRep_Tool::Pnt(m_vertices[v]); }

  /// lets `vertex` stand for vertex `v` of the shell.
  void replace(std::size_t v, const TopoDS_Vertex& vertex) { m_vertices[v] = vertex; }

  /// puts `vertex` on edge `e` at `parameter`.
  void split(std::size_t e, double parameter, const TopoDS_Vertex& vertex)
  {
    Piece piece;
    piece.first = parameter;
    piece.source = vertex;
    m_pieces[e].push_back(piece);
  }

  /// makes the edges; no vertex can be changed from now on.
  void make_edges()
  {
    for(std::size_t e = 0; e < m_pieces.size(); ++e)
    {
      std::vector<Piece>& pieces = m_pieces[e];
      std::sort(pieces.begin(), pieces.end(),
                [](const Piece& a, const Piece& b) { return a.first < b.first; });
      Piece begin;
      begin.first = m_curves[e]->FirstParameter();
      begin.source = m_vertices[m_shell.edge(e).source];
      pieces.insert(pieces.begin(), begin);
      for(std::size_t i = 0; i < pieces.size(); ++i)
      {
        const bool is_last = (i + 1 == pieces.size());
        pieces[i].last = is_last ? m_curves[e]->LastParameter() : pieces[i + 1].first;
        pieces[i].target = is_last ? m_vertices[m_shell.edge(e).target] : pieces[i + 1].source;
        pieces[i].edge = make_edge(m_curves[e], pieces[i].first, pieces[i].last, pieces[i].source,
                                   pieces[i].target);
      }
    }
  }

  const std::vector<Piece>& pieces(std::size_t e) const { return m_pieces[e]; }

  /// makes the faces.
  std::vector<TopoDS_Face> faces() const
  {
    std::vector<TopoDS_Face> result;
    for(std::size_t f = 0; f < m_shell.number_of_faces(); ++f)
      result.push_back(make_face(m_shell.face(f)));
    return result;
  }

private:
  template <typename Point>
  gp_Pnt point(const Point& p) const
  {
    return gp_Pnt(m_scale * CGAL::to_double(p.x()), m_scale * CGAL::to_double(p.y()),
                  m_scale * CGAL::to_double(p.z()));
  }

  static TColStd_Array1OfReal knot_array(const Knots& knots)
  {
    TColStd_Array1OfReal result(1, static_cast<int>(knots.knots().size()));
    for(std::size_t i = 0; i < knots.knots().size(); ++i)
      result(static_cast<int>(i) + 1) = CGAL::to_double(knots.knots()[i]);
    return result;
  }

  static TColStd_Array1OfInteger multiplicity_array(const Knots& knots)
  {
    TColStd_Array1OfInteger result(1, static_cast<int>(knots.knots().size()));
    for(std::size_t i = 0; i < knots.knots().size(); ++i)
      result(static_cast<int>(i) + 1) = knots.multiplicities()[i];
    return result;
  }

  Handle(Geom_BSplineCurve) curve(const B_spline_curve_3<K>& curve) const
  {
    TColgp_Array1OfPnt poles(1, static_cast<int>(curve.control_points.size()));
    for(int i = poles.Lower(); i <= poles.Upper(); ++i)
      poles(i) = point(curve.control_points[i - 1]);
    return new Geom_BSplineCurve(poles, knot_array(curve.knots), multiplicity_array(curve.knots),
                                 curve.knots.degree());
  }

  Handle(Geom_BSplineSurface) surface(const B_spline_surface_3<K>& surface) const
  {
    TColgp_Array2OfPnt poles(1, static_cast<int>(surface.knots[0].number_of_functions()),
                             1, static_cast<int>(surface.knots[1].number_of_functions()));
    for(int i = 1; i <= poles.UpperRow(); ++i)
      for(int j = 1; j <= poles.UpperCol(); ++j)
        poles(i, j) = point(surface.control_point(i - 1, j - 1));
    return new Geom_BSplineSurface(poles, knot_array(surface.knots[0]), knot_array(surface.knots[1]),
                                   multiplicity_array(surface.knots[0]),
                                   multiplicity_array(surface.knots[1]),
                                   surface.knots[0].degree(), surface.knots[1].degree());
  }

  TopoDS_Face make_face(const typename Shell::Face& face) const
  {
    BRep_Builder builder;
    const Handle(Geom_BSplineSurface) geometry = surface(face.surface);
    TopoDS_Face result;
    builder.MakeFace(result, geometry, Precision::Confusion());
    builder.NaturalRestriction(result, Standard_False);
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    double u0, u1, v0, v1;
    geometry->Bounds(u0, u1, v0, v1);
    const std::array<gp_Pnt2d, 5> corners
      = {{gp_Pnt2d(u0, v0), gp_Pnt2d(u1, v0), gp_Pnt2d(u1, v1), gp_Pnt2d(u0, v1), gp_Pnt2d(u0, v0)}};
    const std::array<std::size_t, 5> begin = sides(face, geometry, corners);
    for(int side = 0; side < 4; ++side)
      add_side(face, begin[side], begin[side + 1], corners[side], corners[side + 1], result, wire);
    wire.Closed(Standard_True);
    builder.Add(result, wire);
    return result;
  }

  std::size_t source(const typename Shell::Oriented_edge& e) const
  {
    return e.is_forward ? m_shell.edge(e.edge).source : m_shell.edge(e.edge).target;
  }

  // the positions in the loop at which the sides of the face begin
  std::array<std::size_t, 5> sides(const typename Shell::Face& face,
                                   const Handle(Geom_BSplineSurface)& surface,
                                   const std::array<gp_Pnt2d, 5>& corners) const
  {
    std::array<std::size_t, 5> result = {{0, 0, 0, 0, face.loop.size()}};
    for(int side = 1; side < 4; ++side)
    {
      const gp_Pnt corner = surface->Value(corners[side].X(), corners[side].Y());
      double best = (std::numeric_limits<double>::max)();
      // every side has an edge at least
      for(std::size_t i = result[side - 1] + 1; i + (4 - side) <= face.loop.size(); ++i)
      {
        const double square = corner.SquareDistance(
          point(m_shell.point(source(face.loop[i]))));
        if(square < best)
        {
          best = square;
          result[side] = i;
        }
      }
    }
    return result;
  }

  double length(const typename Shell::Oriented_edge& e) const
  {
    return m_curves[e.edge]->LastParameter() - m_curves[e.edge]->FirstParameter();
  }

  // adds the edges of a side, which lie on the segment from p to q in the parameter plane
  void add_side(const typename Shell::Face& face, std::size_t begin, std::size_t end,
                const gp_Pnt2d& p, const gp_Pnt2d& q, const TopoDS_Face& result,
                TopoDS_Wire& wire) const
  {
    double sum = 0, position = 0;
    for(std::size_t i = begin; i < end; ++i)
      sum += length(face.loop[i]);
    const gp_Vec2d direction(p, q);
    for(std::size_t i = begin; i < end; ++i)
    {
      const gp_Pnt2d source = p.Translated(direction * (position / sum));
      position += length(face.loop[i]);
      const gp_Pnt2d target = p.Translated(direction * (position / sum));
      add_edge(face.loop[i], source, target, result, wire);
    }
  }

  void add_edge(const typename Shell::Oriented_edge& e, const gp_Pnt2d& source,
                const gp_Pnt2d& target, const TopoDS_Face& face, TopoDS_Wire& wire) const
  {
    const double first = m_curves[e.edge]->FirstParameter();
    const gp_Pnt2d& p = e.is_forward ? source : target;
    const gp_Pnt2d& q = e.is_forward ? target : source;
    const gp_Vec2d speed = gp_Vec2d(p, q) / length(e);
    std::vector<Piece> pieces = m_pieces[e.edge];
    if(!e.is_forward)
      std::reverse(pieces.begin(), pieces.end());
    for(const Piece& piece : pieces)
    {
      add_curve_on_face(piece, p.Translated(speed * (piece.first - first)),
                        p.Translated(speed * (piece.last - first)), face);
      BRep_Builder().Add(wire, piece.edge.Oriented(e.is_forward ? TopAbs_FORWARD
                                                                : TopAbs_REVERSED));
    }
  }

  // a straight line in the parameter plane, unless the parameters of edge and face do not agree
  void add_curve_on_face(const Piece& piece, const gp_Pnt2d& p, const gp_Pnt2d& q,
                         const TopoDS_Face& face) const
  {
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    double first, last;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(piece.edge, first, last);
    Handle(Geom2d_Curve) pcurve = line(first, last, p, q);
    double deviation = edge_deviation(curve, pcurve, surface, first, last);
    if(deviation > Precision::Confusion())
    {
      const Handle(Geom2d_Curve) other = Edge_on_surface(curve, surface)(first, last, p);
      const double other_deviation = edge_deviation(curve, other, surface, first, last);
      if(other_deviation < deviation)
      {
        pcurve = other;
        deviation = other_deviation;
      }
    }
    BRep_Builder().UpdateEdge(piece.edge, pcurve, face, Precision::Confusion());
    BRep_Builder().Range(piece.edge, first, last);
    cover_deviation(piece.edge, deviation);
  }

  static Handle(Geom2d_Curve) line(double first, double last, const gp_Pnt2d& p, const gp_Pnt2d& q)
  {
    const double speed = p.Distance(q) / (last - first);
    if(std::abs(speed - 1) < 1e-12)
    {
      const gp_Dir2d direction(gp_Vec2d(p, q));
      return new Geom2d_Line(p.Translated(gp_Vec2d(direction) * -first), direction);
    }
    TColgp_Array1OfPnt2d poles(1, 2);
    poles(1) = p;
    poles(2) = q;
    TColStd_Array1OfReal knots(1, 2);
    knots(1) = first;
    knots(2) = last;
    TColStd_Array1OfInteger multiplicities(1, 2);
    multiplicities.Init(2);
    return new Geom2d_BSplineCurve(poles, knots, multiplicities, 1);
  }

  const Shell& m_shell;
  double m_scale;
  std::vector<TopoDS_Vertex> m_vertices;
  std::vector<Handle(Geom_BSplineCurve)> m_curves;
  std::vector<std::vector<Piece> > m_pieces;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_SHELL_EDGES_H
