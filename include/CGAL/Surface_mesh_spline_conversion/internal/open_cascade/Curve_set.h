// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_CURVE_SET_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_CURVE_SET_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Edge_on_surface.h>

#include <Geom_Curve.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Finds the nearest points on curves of a set.
class Curve_set
{
public:
  static constexpr std::size_t NONE = (std::numeric_limits<std::size_t>::max)();

  struct Foot
  {
    std::size_t curve = NONE;
    double parameter = 0;
    double distance = (std::numeric_limits<double>::max)();
  };

  /// adds the part of a curve between two parameters; returns its index.
  std::size_t add(const Handle(Geom_Curve)& curve, double first, double last)
  {
    const std::size_t least_samples = 64, per_span = 8;
    m_curves.push_back({curve, first, last, m_samples.size(), 0});
    const std::vector<double> breaks = curve_breaks(curve, first, last);
    const std::size_t n = (std::max)(per_span, least_samples / (breaks.size() - 1));
    for(std::size_t i = 0; i + 1 < breaks.size(); ++i)
      for(std::size_t k = 0; k < n; ++k)
        add_sample(breaks[i] + (breaks[i + 1] - breaks[i]) * double(k) / double(n));
    add_sample(last);
    m_curves.back().end = m_samples.size();
    return m_curves.size() - 1;
  }

  std::size_t size() const { return m_curves.size(); }

  gp_Pnt point(std::size_t i, double t) const { return m_curves[i].curve->Value(t); }

  gp_Vec tangent(std::size_t i, double t) const { return m_curves[i].curve->DN(t, 1); }

  const Handle(Geom_Curve)& curve(std::size_t i) const { return m_curves[i].curve; }

  double first(std::size_t i) const { return m_curves[i].first; }

  double last(std::size_t i) const { return m_curves[i].last; }

  /// returns the nearest point on any curve.
  Foot nearest(const gp_Pnt& p) const
  {
    Foot result;
    for(std::size_t i = 0; i < m_curves.size(); ++i)
    {
      const Foot foot = nearest(p, i, result.distance);
      if(foot.distance < result.distance)
        result = foot;
    }
    return result;
  }

  /// returns the nearest point on curve `i`, or any point if it is not nearer than `limit`.
  Foot nearest(const gp_Pnt& p, std::size_t i,
               double limit = (std::numeric_limits<double>::max)()) const
  {
    const Curve& c = m_curves[i];
    std::vector<double> distances;
    for(std::size_t k = c.begin; k < c.end; ++k)
      distances.push_back(p.Distance(m_samples[k].point));
    const auto best = std::min_element(distances.begin(), distances.end());
    Foot result = {i, m_samples[c.begin + (best - distances.begin())].t, *best};
    // farther from the nearest sample than any point of the curve is
    const double reach = *best - c.largest_step;
    if(reach >= limit)
      return result;
    const double bound = *best + c.largest_step;
    const std::size_t n = distances.size();
    for(std::size_t k = 0; k < n; ++k)
    {
      const std::size_t before = (k > 0) ? k - 1 : k, after = (k + 1 < n) ? k + 1 : k;
      if(distances[k] <= bound && distances[k] <= distances[before]
         && distances[k] <= distances[after])
        refine(p, m_samples[c.begin + before].t, m_samples[c.begin + k].t,
               m_samples[c.begin + after].t, result);
    }
    return result;
  }

private:
  struct Curve
  {
    Handle(Geom_Curve) curve;
    double first, last;
    std::size_t begin, end; // samples
    double largest_step = 0;
  };

  struct Sample
  {
    double t;
    gp_Pnt point;
  };

  void add_sample(double t)
  {
    Curve& c = m_curves.back();
    m_samples.push_back({t, c.curve->Value(t)});
    if(m_samples.size() > c.begin + 1)
      c.largest_step = (std::max)(c.largest_step, 2 * m_samples.back().point.Distance(
        m_samples[m_samples.size() - 2].point));
  }

  // Newton's method for the foot of the perpendicular in an interval, with bisection where it leaves
  void refine(const gp_Pnt& p, double low, double t, double high, Foot& foot) const
  {
    const int most_steps = 60;
    const Handle(Geom_Curve)& curve = m_curves[foot.curve].curve;
    const double small = 1e-15 * (m_curves[foot.curve].last - m_curves[foot.curve].first);
    for(int i = 0; i < most_steps; ++i)
    {
      gp_Pnt c;
      gp_Vec d1, d2;
      curve->D2(t, c, d1, d2);
      const gp_Vec to_curve(p, c);
      const double slope = to_curve.Dot(d1), curvature = d1.SquareMagnitude() + to_curve.Dot(d2);
      (slope > 0 ? high : low) = t;
      double next = (curvature > 0) ? t - slope / curvature : low;
      if(!(next > low && next < high))
        next = (low + high) / 2;
      const double step = std::abs(next - t);
      t = next;
      if(step <= small)
        break;
    }
    for(const double candidate : {t, m_curves[foot.curve].first, m_curves[foot.curve].last})
    {
      const double distance = p.Distance(curve->Value(candidate));
      if(distance < foot.distance)
      {
        foot.parameter = candidate;
        foot.distance = distance;
      }
    }
  }

  std::vector<Curve> m_curves;
  std::vector<Sample> m_samples;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_CURVE_SET_H
