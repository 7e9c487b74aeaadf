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
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/volume.h>

#include <BRepCheck_Analyzer.hxx>
#include <BRep_Tool.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

#include <algorithm>
#include <cmath>
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
  report.edges = internal::count_subshapes(shape, TopAbs_EDGE);
  report.vertices = internal::count_subshapes(shape, TopAbs_VERTEX);
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
    report.volume = internal::volume(shape);
  return report;
}

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

describes how two faces meet along their common edges: the distance of their points at equal
parameters of the edge, split by the normals of the faces. What kernels are sensitive to is the
normal part, above all where faces are tangent to each other.
*/
struct BRep_gaps
{
  double normal = 0;     ///< largest part along the normal of one of the faces, in millimetres
  double tangential = 0; ///< largest part in the tangent planes of both faces, in millimetres
  double angle = 0;      ///< largest angle between the normals of two B-spline faces, in degrees
};

namespace internal {

/// A face along one of its edges.
class Face_at_edge
{
public:
  Face_at_edge(const TopoDS_Edge& edge, const TopoDS_Face& face)
    : m_surface(BRep_Tool::Surface(face)), m_is_reversed(face.Orientation() == TopAbs_REVERSED)
  {
    m_pcurve = BRep_Tool::CurveOnSurface(edge, face, m_first, m_last);
  }

  bool has_curve() const { return !m_pcurve.IsNull(); }

  bool is_spline() const { return !Handle(Geom_BSplineSurface)::DownCast(m_surface).IsNull(); }

  double first() const { return m_first; }

  double last() const { return m_last; }

  /// computes the point and the unit normal at `t`; returns `false` at a pole of the surface.
  bool evaluate(double t, gp_Pnt& p, gp_Vec& normal) const
  {
    gp_Vec du, dv;
    const gp_Pnt2d q = m_pcurve->Value(t);
    m_surface->D1(q.X(), q.Y(), p, du, dv);
    normal = du.Crossed(dv);
    if(!(normal.Magnitude() > 1e-10 * du.Magnitude() * dv.Magnitude()))
      return false;
    normal /= m_is_reversed ? -normal.Magnitude() : normal.Magnitude();
    return true;
  }

private:
  Handle(Geom_Surface) m_surface;
  Handle(Geom2d_Curve) m_pcurve;
  bool m_is_reversed;
  double m_first = 0, m_last = 0;
};

inline void add_gaps(const Face_at_edge& left, const Face_at_edge& right, BRep_gaps& gaps)
{
  const int samples = 64;
  const double degrees = 180 / std::acos(-1.);
  for(int k = 0; k <= samples; ++k)
  {
    const double t = left.first() + (left.last() - left.first()) * k / samples;
    gp_Pnt p, q;
    gp_Vec m, n;
    if(!left.evaluate(t, p, m) || !right.evaluate(t, q, n))
      continue;
    const gp_Vec gap(p, q);
    gaps.normal = (std::max)({gaps.normal, std::abs(gap.Dot(m)), std::abs(gap.Dot(n))});
    const double rest = (std::max)((gap - gap.Dot(m) * m).Magnitude(),
                                   (gap - gap.Dot(n) * n).Magnitude());
    gaps.tangential = (std::max)(gaps.tangential, rest);
    if(left.is_spline() && right.is_spline())
      gaps.angle = (std::max)(gaps.angle, degrees * m.Angle(n));
  }
}

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

measures how the faces of a boundary representation meet along the edges of two faces.

This needs Open CASCADE. If headers of both are included, those of \cgal must come first.
*/
inline BRep_gaps measure_BRep_gaps(const TopoDS_Shape& shape)
{
  BRep_gaps gaps;
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  for(int i = 1; i <= faces.Extent(); ++i)
  {
    const TopoDS_Edge& edge = TopoDS::Edge(faces.FindKey(i));
    if(BRep_Tool::Degenerated(edge) || faces(i).Extent() != 2)
      continue;
    const internal::Face_at_edge left(edge, TopoDS::Face(faces(i).First()));
    const internal::Face_at_edge right(edge, TopoDS::Face(faces(i).Last()));
    if(left.has_curve() && right.has_curve())
      internal::add_gaps(left, right, gaps);
  }
  return gaps;
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_MEASURE_BREP_H
