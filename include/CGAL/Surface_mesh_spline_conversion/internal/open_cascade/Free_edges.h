// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_FREE_EDGES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_FREE_EDGES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Curve_set.h>

#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// The free edges of a boundary representation: those that are used once, by one face.
class Free_edges
{
public:
  struct Free_edge
  {
    TopoDS_Edge edge; ///< oriented forward
    TopoDS_Face face;
    bool is_forward;  ///< does the face, as it is oriented in the shape, use the edge forward?
    TopoDS_Vertex source, target;
  };

  explicit Free_edges(const TopoDS_Shape& shape)
  {
    TopTools_IndexedMapOfShape edges;
    std::vector<Free_edge> uses;
    std::vector<int> number_of_uses;
    for(TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next())
      for(TopExp_Explorer x(f.Current(), TopAbs_EDGE); x.More(); x.Next())
      {
        const std::size_t e = edges.Add(x.Current()) - 1;
        number_of_uses.resize((std::max)(number_of_uses.size(), e + 1), 0);
        uses.resize(number_of_uses.size());
        ++number_of_uses[e];
        uses[e].edge = TopoDS::Edge(x.Current().Oriented(TopAbs_FORWARD));
        uses[e].face = TopoDS::Face(f.Current());
        uses[e].is_forward = (x.Current().Orientation() == TopAbs_FORWARD);
      }
    for(std::size_t e = 0; e < uses.size(); ++e)
      if(number_of_uses[e] == 1 && !BRep_Tool::Degenerated(uses[e].edge))
        add(uses[e]);
  }

  std::size_t size() const { return m_edges.size(); }

  const Free_edge& operator[](std::size_t i) const { return m_edges[i]; }

  /// the curves of the edges, with the same indices
  const Curve_set& curves() const { return m_curves; }

  /// returns the parameter of `vertex` on edge `i`, which begins or ends there.
  double parameter(std::size_t i, const TopoDS_Vertex& vertex) const
  {
    return m_edges[i].source.IsSame(vertex) ? m_curves.first(i) : m_curves.last(i);
  }

private:
  void add(Free_edge& edge)
  {
    double first, last;
    Handle(Geom_Curve) curve = BRep_Tool::Curve(edge.edge, first, last);
    if(curve.IsNull() && BRepLib::BuildCurve3d(edge.edge))
      curve = BRep_Tool::Curve(edge.edge, first, last);
    if(curve.IsNull())
      return;
    TopExp::Vertices(edge.edge, edge.source, edge.target);
    m_edges.push_back(edge);
    m_curves.add(curve, first, last);
  }

  std::vector<Free_edge> m_edges;
  Curve_set m_curves;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_FREE_EDGES_H
