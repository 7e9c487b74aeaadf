// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_MEASURE_BREP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_MEASURE_BREP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Stitching_report.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Edge_on_surface.h>

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// returns the number of different subshapes of a kind.
inline std::size_t count_subshapes(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind)
{
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  return static_cast<std::size_t>(map.Extent());
}

inline double largest_edge_tolerance(const TopoDS_Shape& shape)
{
  double result = 0;
  for(TopExp_Explorer x(shape, TopAbs_EDGE); x.More(); x.Next())
    result = (std::max)(result, BRep_Tool::Tolerance(TopoDS::Edge(x.Current())));
  return result;
}

inline double largest_vertex_tolerance(const TopoDS_Shape& shape)
{
  double result = 0;
  for(TopExp_Explorer x(shape, TopAbs_VERTEX); x.More(); x.Next())
    result = (std::max)(result, BRep_Tool::Tolerance(TopoDS::Vertex(x.Current())));
  return result;
}

/// returns the largest tolerance of edges and vertices.
inline double largest_tolerance(const TopoDS_Shape& shape)
{
  return (std::max)(largest_edge_tolerance(shape), largest_vertex_tolerance(shape));
}

/// measures how far an edge is from a face that uses it, at equal parameters.
inline double edge_deviation(const TopoDS_Edge& edge, const TopoDS_Face& face)
{
  double first, last;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  if(curve.IsNull())
    return 0;
  double first_on_face, last_on_face;
  const Handle(Geom2d_Curve) pcurve
    = BRep_Tool::CurveOnSurface(edge, face, first_on_face, last_on_face);
  if(pcurve.IsNull())
    return 0;
  return edge_deviation(curve, pcurve, BRep_Tool::Surface(face), first, last);
}

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

measures a boundary representation: it counts its parts, finds free edges, measures the distance of
edges from their faces, and has Open CASCADE check it. The members of the report on how it was
stitched keep their initial values.

This needs Open CASCADE. If headers of both are included, those of \cgal must come first.
*/
inline Stitching_report measure_BRep(const TopoDS_Shape& shape)
{
  Stitching_report report;
  report.solids = internal::count_subshapes(shape, TopAbs_SOLID);
  report.shells = internal::count_subshapes(shape, TopAbs_SHELL);
  report.faces = internal::count_subshapes(shape, TopAbs_FACE);
  TopTools_IndexedMapOfShape edges;
  std::vector<std::size_t> uses(1, 0); // the map counts from one
  for(TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next())
    for(TopExp_Explorer x(f.Current(), TopAbs_EDGE); x.More(); x.Next())
    {
      const TopoDS_Edge& edge = TopoDS::Edge(x.Current());
      if(BRep_Tool::Degenerated(edge))
        continue;
      const std::size_t e = edges.Add(edge);
      uses.resize((std::max)(uses.size(), e + 1), 0);
      ++uses[e];
      report.edge_deviation = (std::max)(report.edge_deviation, internal::edge_deviation(
        edge, TopoDS::Face(f.Current())));
    }
  report.free_edges = std::count(uses.begin(), uses.end(), std::size_t(1));
  report.multiple_edges
    = std::count_if(uses.begin(), uses.end(), [](std::size_t n) { return n > 2; });
  report.edge_tolerance = internal::largest_edge_tolerance(shape);
  report.vertex_tolerance = internal::largest_vertex_tolerance(shape);
  report.is_valid = BRepCheck_Analyzer(shape).IsValid();
  if(report.solids > 0 && report.free_edges == 0)
  {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(shape, properties);
    report.volume = properties.Mass();
  }
  return report;
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_MEASURE_BREP_H
