// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_OPEN_CASCADE_CURVE_TRAITS_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_OPEN_CASCADE_CURVE_TRAITS_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Curve_member_traits.h>

#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopAbs_Orientation.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include <cmath>
#include <memory>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

The class `Open_cascade_curve_3` is a handle to the curve of an edge of a boundary representation.
Copies share the curve, and two curves are equal if they share it.

This needs Open CASCADE. If headers of both are included, those of \cgal must come first.

\tparam K a model of `Kernel` with a floating-point number type
*/
template <typename K>
class Open_cascade_curve_3
{
public:
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  /// creates a handle that refers to no curve; it can only be compared and assigned.
  Open_cascade_curve_3() {}

  /// creates the curve of an edge without a face.
  explicit Open_cascade_curve_3(const TopoDS_Edge& edge)
    : Open_cascade_curve_3(edge, TopoDS_Face())
  {}

  /// creates the curve of an edge of a face. An edge that is only known in the parameter plane of
  /// its face gets a curve in space.
  Open_cascade_curve_3(TopoDS_Edge edge, const TopoDS_Face& face)
  {
    auto data = std::make_shared<Data>();
    data->curve = BRep_Tool::Curve(edge, data->first, data->last);
    if(data->curve.IsNull() && BRepLib::BuildCurve3d(edge))
      data->curve = BRep_Tool::Curve(edge, data->first, data->last);
    if(data->curve.IsNull())
      return;
    data->edge = edge;
    if(!face.IsNull())
    {
      double first, last;
      data->pcurve = BRep_Tool::CurveOnSurface(edge, face, first, last);
      data->surface = BRep_Tool::Surface(face);
      data->is_reversed = (face.Orientation() == TopAbs_REVERSED);
    }
    m_data = data;
  }

  /// returns `true` if both handles refer to the same curve.
  friend bool operator==(const Open_cascade_curve_3& a, const Open_cascade_curve_3& b)
  {
    return a.m_data == b.m_data;
  }

  /// returns `true` if the handles refer to different curves.
  friend bool operator!=(const Open_cascade_curve_3& a, const Open_cascade_curve_3& b)
  {
    return !(a == b);
  }

  /// returns `false` if the edge has no curve.
  bool is_valid() const { return m_data != nullptr; }

  /// returns the edge.
  const TopoDS_Edge& edge() const { return m_data->edge; }

  /// returns the smallest parameter.
  FT first() const { return FT(m_data->first); }

  /// returns the largest parameter.
  FT last() const { return FT(m_data->last); }

  /// returns `true` if the curve can also be evaluated outside of `[first(), last()]`, where it
  /// repeats itself.
  bool is_periodic() const { return m_data->curve->IsPeriodic(); }

  /// returns `true` if the curve ends where it begins.
  bool is_closed() const
  {
    const double tolerance = BRep_Tool::Tolerance(m_data->edge);
    return m_data->curve->Value(m_data->first).IsEqual(m_data->curve->Value(m_data->last),
                                                       tolerance);
  }

  /// returns `true` if the face of the edge is known.
  bool has_face() const { return !m_data->pcurve.IsNull(); }

  /// returns the point at `t`.
  Point_3 point(const FT& t) const
  {
    const gp_Pnt p = m_data->curve->Value(t);
    return Point_3(FT(p.X()), FT(p.Y()), FT(p.Z()));
  }

  /// returns the derivative at `t` of an order from 1 to 3.
  Vector_3 derivative(const FT& t, int order) const
  {
    return vector(m_data->curve->DN(t, order));
  }

  /// returns the unit normal of the face at `t`, on the outer side of the face as it is oriented;
  /// the null vector at a pole of the surface.
  /// \pre `has_face()`
  Vector_3 normal(const FT& t) const
  {
    gp_Pnt p;
    gp_Vec du, dv;
    const gp_Pnt2d q = m_data->pcurve->Value(t);
    m_data->surface->D1(q.X(), q.Y(), p, du, dv);
    const gp_Vec normal = du.Crossed(dv);
    const double length = normal.Magnitude();
    if(!(length > 0))
      return Vector_3(0, 0, 0);
    return vector(normal / (m_data->is_reversed ? -length : length));
  }

private:
  struct Data
  {
    TopoDS_Edge edge;
    Handle(Geom_Curve) curve;
    Handle(Geom2d_Curve) pcurve;
    Handle(Geom_Surface) surface;
    double first = 0, last = 0;
    bool is_reversed = false;
  };

  static Vector_3 vector(const gp_Vec& v) { return Vector_3(FT(v.X()), FT(v.Y()), FT(v.Z())); }

  std::shared_ptr<const Data> m_data;
};

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

The class `Open_cascade_curve_traits_3` makes boundary curves of edges of a boundary representation.
Its `Construct_normal_on_curve_3` returns the normals of a face along its edge.

Parameters are those of the curve in space, whatever the orientation of the edge. The evaluation
changes nothing, so that several threads may evaluate the same curve.

This needs Open CASCADE. If headers of both are included, those of \cgal must come first.

\tparam K a model of `Kernel` with a floating-point number type

\cgalModels{BoundaryCurveTraits_3}

\sa `associate_boundary_with_BRep()`
*/
template <typename K>
class Open_cascade_curve_traits_3
#ifndef DOXYGEN_RUNNING
  : public internal::Curve_member_traits_with_normals<K, Open_cascade_curve_3<K> >
#endif
{
public:
  /// The type of the curves.
  typedef Open_cascade_curve_3<K> Curve_3;
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_OPEN_CASCADE_CURVE_TRAITS_3_H
