// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_EDGE_ON_SURFACE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_EDGE_ON_SURFACE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Plane.hxx>
#include <Geom_Surface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec.hxx>
#include <gp_Vec2d.hxx>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// the inner knots of `curve` between `first` and `last`, and both of these
inline std::vector<double> curve_breaks(const Handle(Geom_Curve)& curve, double first, double last)
{
  std::vector<double> breaks(1, first);
  const Handle(Geom_BSplineCurve) spline = Handle(Geom_BSplineCurve)::DownCast(curve);
  const double close = 1e-9 * (last - first); // knots this close to an end make no span
  if(!spline.IsNull())
    for(int i = 1; i <= spline->NbKnots(); ++i)
      if(spline->Knot(i) > first + close && spline->Knot(i) < last - close)
        breaks.push_back(spline->Knot(i));
  breaks.push_back(last);
  return breaks;
}

/// returns the largest distance of an edge from a surface at equal parameters, sampled between
/// the knots of both curves.
inline double edge_deviation(const Handle(Geom_Curve)& curve, const Handle(Geom2d_Curve)& pcurve,
                             const Handle(Geom_Surface)& surface, double first, double last)
{
  const std::size_t least_samples = 64;
  std::vector<double> breaks = curve_breaks(curve, first, last);
  const Handle(Geom2d_BSplineCurve) spline = Handle(Geom2d_BSplineCurve)::DownCast(pcurve);
  if(!spline.IsNull())
    for(int i = 1; i <= spline->NbKnots(); ++i)
      if(spline->Knot(i) > first && spline->Knot(i) < last)
        breaks.push_back(spline->Knot(i));
  std::sort(breaks.begin(), breaks.end());
  const std::size_t per_span = 4 + least_samples / (breaks.size() - 1);
  double result = 0;
  for(std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for(std::size_t k = 0; k <= per_span; ++k)
    {
      const double t = breaks[i] + (breaks[i + 1] - breaks[i]) * double(k) / double(per_span);
      const gp_Pnt2d q = pcurve->Value(t);
      result = (std::max)(result, curve->Value(t).Distance(surface->Value(q.X(), q.Y())));
    }
  return result;
}

/// Computes the curve in the parameter plane of a surface whose image is a curve in space next to
/// the surface, at equal parameters: a C1 cubic spline through feet of perpendiculars. Its knots are
/// those of the curve, bisected until the spline follows the feet.
class Edge_on_surface
{
public:
  Edge_on_surface(const Handle(Geom_Curve)& curve, const Handle(Geom_Surface)& surface)
    : m_curve(curve), m_surface(surface)
  {}

  /// returns the curve between `first` and `last`; `guess` is near the first foot.
  Handle(Geom2d_Curve) operator()(double first, double last, const gp_Pnt2d& guess) const
  {
    const std::vector<double> breaks = curve_breaks(m_curve, first, last);
    std::vector<Node> nodes(1, node(first, guess));
    for(std::size_t i = 1; i < breaks.size(); ++i)
    {
      const Node begin = nodes.back();
      // a foot is found from one nearby: march in steps
      gp_Pnt2d p = begin.point;
      for(int k = 1; k < STEPS; ++k)
        p = foot(m_curve->Value(begin.t + (breaks[i] - begin.t) * k / STEPS), p);
      append(begin, node(breaks[i], p), 0, nodes);
    }
    return spline(nodes);
  }

private:
  static constexpr int STEPS = 4;
  static constexpr int DEEPEST_LEVEL = 10;
  static constexpr int NEWTON_STEPS = 20;
  static constexpr double TOLERANCE = 1e-8; // a tenth of the resolution of the kernel, in mm

  struct Node
  {
    double t;
    gp_Pnt2d point;
    gp_Vec2d derivative;
  };

  // the coefficients of a displacement in the tangent plane
  static gp_Vec2d components(const gp_Vec& v, const gp_Vec& du, const gp_Vec& dv)
  {
    const double a = du.SquareMagnitude(), b = du.Dot(dv), c = dv.SquareMagnitude();
    const double determinant = a * c - b * b;
    if(!(determinant > 1e-20 * a * c)) // a pole of the surface
      return gp_Vec2d(0, 0);
    const double x = v.Dot(du), y = v.Dot(dv);
    return gp_Vec2d((c * x - b * y) / determinant, (a * y - b * x) / determinant);
  }

  gp_Pnt2d foot(const gp_Pnt& p, gp_Pnt2d q) const
  {
    for(int i = 0; i < NEWTON_STEPS; ++i)
    {
      gp_Pnt s;
      gp_Vec du, dv;
      m_surface->D1(q.X(), q.Y(), s, du, dv);
      const gp_Vec2d step = components(gp_Vec(s, p), du, dv);
      q.Translate(step);
      const double length = std::abs(step.X()) * du.Magnitude() + std::abs(step.Y()) * dv.Magnitude();
      if(length < 1e-5 * TOLERANCE)
        break;
    }
    return q;
  }

  Node node(double t, const gp_Pnt2d& guess) const
  {
    gp_Pnt p, s;
    gp_Vec tangent, du, dv;
    m_curve->D1(t, p, tangent);
    const gp_Pnt2d q = foot(p, guess);
    m_surface->D1(q.X(), q.Y(), s, du, dv);
    return {t, q, components(tangent, du, dv)};
  }

  static gp_Pnt2d interpolate(const Node& a, const Node& b, double s)
  {
    const double h = b.t - a.t;
    const double f1 = s * s * (3 - 2 * s), g0 = h * s * (1 - s) * (1 - s), g1 = -h * s * s * (1 - s);
    return gp_Pnt2d((1 - f1) * a.point.X() + f1 * b.point.X()
                      + g0 * a.derivative.X() + g1 * b.derivative.X(),
                    (1 - f1) * a.point.Y() + f1 * b.point.Y()
                      + g0 * a.derivative.Y() + g1 * b.derivative.Y());
  }

  bool is_close(const Node& a, const Node& b) const
  {
    for(const double s : {0.25, 0.5, 0.75})
    {
      const gp_Pnt2d q = interpolate(a, b, s);
      const gp_Pnt2d exact = foot(m_curve->Value(a.t + (b.t - a.t) * s), q);
      if(m_surface->Value(q.X(), q.Y()).Distance(m_surface->Value(exact.X(), exact.Y())) > TOLERANCE)
        return false;
    }
    return true;
  }

  void append(const Node& a, const Node& b, int level, std::vector<Node>& nodes) const
  {
    if(level < DEEPEST_LEVEL && !is_close(a, b))
    {
      const Node middle = node((a.t + b.t) / 2, interpolate(a, b, 0.5));
      append(a, middle, level + 1, nodes);
      append(middle, b, level + 1, nodes);
    }
    else
      nodes.push_back(b);
  }

  Handle(Geom2d_Curve) spline(const std::vector<Node>& nodes) const
  {
    const int n = static_cast<int>(nodes.size());
    TColgp_Array1OfPnt2d poles(1, 2 * n);
    TColStd_Array1OfReal knots(1, n);
    TColStd_Array1OfInteger multiplicities(1, n);
    for(int i = 0; i < n; ++i)
    {
      const Node& node = nodes[i];
      knots(i + 1) = node.t;
      multiplicities(i + 1) = (i == 0 || i == n - 1) ? 4 : 2;
      const double before = (i == 0) ? 0 : node.t - nodes[i - 1].t;
      const double after = (i == n - 1) ? 0 : nodes[i + 1].t - node.t;
      poles(2 * i + 1) = node.point.Translated(node.derivative * (-before / 3));
      poles(2 * i + 2) = node.point.Translated(node.derivative * (after / 3));
    }
    Handle(Geom2d_BSplineCurve) result = new Geom2d_BSplineCurve(poles, knots, multiplicities, 3);
    // in a plane the image of a C2 spline is one
    if(!Handle(Geom_Plane)::DownCast(m_surface).IsNull())
      for(int i = n - 1; i > 1; --i)
        result->RemoveKnot(i, 1, 1e-2 * TOLERANCE);
    return result;
  }

  Handle(Geom_Curve) m_curve;
  Handle(Geom_Surface) m_surface;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_EDGE_ON_SURFACE_H
