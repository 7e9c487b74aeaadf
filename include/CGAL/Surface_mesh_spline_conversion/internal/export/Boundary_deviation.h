// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_BOUNDARY_DEVIATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_BOUNDARY_DEVIATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/Point_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/compatibility.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Deviation_statistics.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// A set of curves with samples, on which points are projected. `Curves` offers `size()`,
/// `number_of_intervals(i)`, `point(i,t)` and `derivative(i,t)` for t in [0,1].
///
/// The search starts from the chords between the samples, since the samples next to a point may all
/// lie on another curve that has more of them.
template <typename Curves>
class Curve_projector
{
  typedef CGAL::Simple_cartesian<double> Kernel;
  typedef std::vector<Kernel::Segment_3> Segments;
  typedef CGAL::AABB_segment_primitive<Kernel, Segments::const_iterator> Primitive;
  typedef CGAL::AABB_tree<AABB_traits_3<Kernel, Primitive> > Tree;

public:
  struct Foot
  {
    double distance = (std::numeric_limits<double>::infinity)();
    std::size_t curve = 0;
    double parameter = 0;
  };

  explicit Curve_projector(const Curves& curves) : m_curves(curves)
  {
    for(std::size_t i = 0; i < curves.size(); ++i)
      for(int k = 0; k <= curves.number_of_intervals(i); ++k)
      {
        const double t = k / double(curves.number_of_intervals(i));
        m_samples.push_back({i, t});
        m_points.push_back(curves.point(i, t));
        if(k > 0)
          add_chord();
      }
    m_tree.insert(m_segments.begin(), m_segments.end());
    m_tree.build();
  }

  Curve_projector(const Curve_projector&) = delete;
  Curve_projector& operator=(const Curve_projector&) = delete;

  const std::vector<Eigen::Vector3d>& points() const { return m_points; }

  std::vector<Foot> project(const std::vector<Eigen::Vector3d>& points) const
  {
    std::vector<Foot> feet(points.size());
    for_each_index(points.size(), [&](std::size_t i) { feet[i] = project(points[i]); });
    return feet;
  }

  Foot project(const Eigen::Vector3d& p) const
  {
    const auto closest = m_tree.closest_point_and_primitive(point(p));
    Foot best = project_from_chord(p, std::size_t(closest.second - m_segments.begin()));
    const double radius = best.distance + m_largest_sagitta;
    std::vector<Segments::const_iterator> near;
    m_tree.all_intersected_primitives(Kernel::Sphere_3(point(p), radius * radius),
                                      std::back_inserter(near));
    for(const auto segment : near)
    {
      const std::size_t i = std::size_t(segment - m_segments.begin());
      if(is_on_chord(best, i)
         || std::sqrt(CGAL::squared_distance(point(p), *segment)) > best.distance + m_sagittas[i])
        continue;
      const Foot foot = project_from_chord(p, i);
      if(foot.distance < best.distance)
        best = foot;
    }
    return best;
  }

  /// the place of an entry of `points()`
  struct Sample
  {
    std::size_t curve;
    double parameter;
  };

  const std::vector<Sample>& samples() const { return m_samples; }

private:
  static constexpr int MAXIMUM_NUMBER_OF_STEPS = 24;
  static constexpr double NEGLIGIBLE_STEP = 1e-12; // of the parameter

  static Kernel::Point_3 point(const Eigen::Vector3d& p)
  {
    return Kernel::Point_3(p.x(), p.y(), p.z());
  }

  // the chord that ends at the last sample
  void add_chord()
  {
    constexpr double SAFETY = 2; // the curve may be farther away than in the middle
    const Sample& end = m_samples.back();
    const double middle = (m_samples[m_samples.size() - 2].parameter + end.parameter) / 2;
    m_segments.emplace_back(point(m_points[m_points.size() - 2]), point(m_points.back()));
    m_chord_ends.push_back(m_samples.size() - 1);
    m_sagittas.push_back(SAFETY * std::sqrt(CGAL::squared_distance(
      point(m_curves.point(end.curve, middle)), m_segments.back())));
    m_largest_sagitta = (std::max)(m_largest_sagitta, m_sagittas.back());
  }

  // has the search ended on the part of the curve that belongs to a chord?
  bool is_on_chord(const Foot& foot, std::size_t chord) const
  {
    const Sample &a = m_samples[m_chord_ends[chord] - 1], &b = m_samples[m_chord_ends[chord]];
    return foot.curve == b.curve && a.parameter <= foot.parameter && foot.parameter <= b.parameter;
  }

  // starts at the parameter of the point of the chord that is closest to `p`
  Foot project_from_chord(const Eigen::Vector3d& p, std::size_t chord) const
  {
    const std::size_t end = m_chord_ends[chord];
    const Sample &a = m_samples[end - 1], &b = m_samples[end];
    const Eigen::Vector3d d = m_points[end] - m_points[end - 1];
    const double share
      = d.isZero(0) ? 0 : (p - m_points[end - 1]).dot(d) / d.squaredNorm();
    return project_from(p, a.curve, a.parameter + (std::min)(1., (std::max)(0., share))
                                                    * (b.parameter - a.parameter));
  }

  Foot project_from(const Eigen::Vector3d& p, std::size_t curve, double t) const
  {
    double distance = (m_curves.point(curve, t) - p).norm();
    for(int step = 0; step < MAXIMUM_NUMBER_OF_STEPS; ++step)
    {
      const Eigen::Vector3d d = m_curves.derivative(curve, t);
      double delta = (p - m_curves.point(curve, t)).dot(d) / d.squaredNorm();
      bool has_improved = false;
      for(int halving = 0; halving < 4 && !has_improved; ++halving, delta /= 2)
      {
        const double next = (std::min)(1., (std::max)(0., t + delta));
        const double next_distance = (m_curves.point(curve, next) - p).norm();
        if(!(next_distance < distance))
          continue;
        has_improved = std::abs(next - t) > NEGLIGIBLE_STEP;
        t = next;
        distance = next_distance;
      }
      if(!has_improved)
        break;
    }
    Foot foot;
    foot.distance = distance;
    foot.curve = curve;
    foot.parameter = t;
    return foot;
  }

  const Curves& m_curves;
  std::vector<Sample> m_samples;
  std::vector<Eigen::Vector3d> m_points;
  Segments m_segments;                   // the chords
  std::vector<std::size_t> m_chord_ends; // samples
  std::vector<double> m_sagittas;        // bounds of the heights of the curve above its chords
  double m_largest_sagitta = 0;
  Tree m_tree;
};

/// the curves of the boundary edges of a mesh
template <typename Network>
class Network_curves
{
public:
  explicit Network_curves(const Network& network) : m_network(network)
  {
    for(std::size_t c = 0; c < network.number_of_chains(); ++c)
      for(std::size_t e = 0; e < network.chain_halfedges(c).size(); ++e)
        m_edges.push_back({c, e});
  }

  std::size_t size() const { return m_edges.size(); }

  int number_of_intervals(std::size_t) const { return 8; }

  std::size_t chain(std::size_t i) const { return m_edges[i].chain; }

  double arc_length(std::size_t i, double t) const
  {
    return CGAL::to_double(m_network.arc_length(m_edges[i].chain, m_edges[i].index,
                                                parameter(i, t)));
  }

  Eigen::Vector3d point(std::size_t i, double t) const
  {
    return to_eigen(m_network.traits().construct_point_on_curve_3_object()(segment(i).curve,
                                                                          parameter(i, t)));
  }

  Eigen::Vector3d derivative(std::size_t i, double t) const
  {
    const auto d = m_network.traits().construct_derivative_on_curve_3_object();
    return CGAL::to_double(segment(i).second - segment(i).first)
         * to_eigen(d(segment(i).curve, parameter(i, t), 1));
  }

private:
  typedef typename Network::FT FT;

  struct Edge
  {
    std::size_t chain;
    std::size_t index;
  };

  const typename Network::Curve_segment& segment(std::size_t i) const
  {
    return m_network.curve_segment(m_edges[i].chain, m_edges[i].index);
  }

  FT parameter(std::size_t i, double t) const
  {
    return segment(i).first + (segment(i).second - segment(i).first) * FT(t);
  }

  const Network& m_network;
  std::vector<Edge> m_edges;
};

/// the curves of the boundary edges of a shell
template <typename K>
class Shell_border_curves
{
public:
  explicit Shell_border_curves(const NURBS_shell_3<K>& shell) : m_shell(shell)
  {
    for(std::size_t e = 0; e < shell.number_of_edges(); ++e)
      if(shell.is_border(e))
        m_edges.push_back(e);
  }

  std::size_t size() const { return m_edges.size(); }

  int number_of_intervals(std::size_t i) const { return 16 * int(curve(i).knots.number_of_spans()); }

  Eigen::Vector3d point(std::size_t i, double t) const
  {
    return to_eigen(curve(i).point(parameter(i, t)));
  }

  Eigen::Vector3d derivative(std::size_t i, double t) const
  {
    return CGAL::to_double(curve(i).last() - curve(i).first())
         * to_eigen(curve(i).derivative(parameter(i, t), 1));
  }

private:
  const B_spline_curve_3<K>& curve(std::size_t i) const { return m_shell.edge(m_edges[i]).curve; }

  typename K::FT parameter(std::size_t i, double t) const
  {
    return curve(i).first() + (curve(i).last() - curve(i).first()) * typename K::FT(t);
  }

  const NURBS_shell_3<K>& m_shell;
  std::vector<std::size_t> m_edges;
};

struct Boundary_deviation
{
  Deviation_statistics statistics;
  std::size_t chain = 0;   ///< where it is largest
  double arc_length = 0;
  double corner = 0;       ///< largest distance of a corner from a vertex of the boundary
};

/// compares the boundary of a shell with that of a mesh, in both directions
template <typename K, typename Network>
Boundary_deviation boundary_deviation(const NURBS_shell_3<K>& shell, const Network& network)
{
  Boundary_deviation result;
  if(network.number_of_chains() == 0)
    return result;
  const Network_curves<Network> curves(network);
  const Shell_border_curves<K> border(shell);
  const Curve_projector<Network_curves<Network> > on_curves(curves);
  const Curve_projector<Shell_border_curves<K> > on_border(border);
  const auto feet_on_curves = on_curves.project(on_border.points());
  for(std::size_t i = 0; i < feet_on_curves.size(); ++i)
  {
    const auto& foot = feet_on_curves[i];
    if(result.statistics.add(foot.distance, on_border.points()[i]))
    {
      result.chain = curves.chain(foot.curve);
      result.arc_length = curves.arc_length(foot.curve, foot.parameter);
    }
  }
  const auto feet_on_border = on_border.project(on_curves.points());
  for(std::size_t i = 0; i < feet_on_border.size(); ++i)
    if(result.statistics.add(feet_on_border[i].distance, on_curves.points()[i]))
    {
      const auto& sample = on_curves.samples()[i];
      result.chain = curves.chain(sample.curve);
      result.arc_length = curves.arc_length(sample.curve, sample.parameter);
    }
  return result;
}

/// the largest distance of a corner of the mesh from the nearest vertex on the boundary of the
/// shell
template <typename K, typename TriangleMesh, typename VertexPointMap, typename Network>
double corner_deviation(const NURBS_shell_3<K>& shell, const TriangleMesh& tm,
                        const VertexPointMap& vpm, const Network& network)
{
  std::vector<Eigen::Vector3d> points;
  for(std::size_t e = 0; e < shell.number_of_edges(); ++e)
    if(shell.is_border(e))
      for(std::size_t v : {shell.edge(e).source, shell.edge(e).target})
        points.push_back(to_eigen(shell.point(v)));
  const Point_index index(points);
  double result = 0;
  for(std::size_t l = 0; l < network.number_of_loops(); ++l)
    for(auto h : network.loop(l))
      if(network.is_corner(source(h, tm)))
      {
        const Eigen::Vector3d p = to_eigen(get(vpm, source(h, tm)));
        const std::vector<std::size_t> nearest = index.nearest(p, 1);
        result = (std::max)(result, nearest.empty() ? (std::numeric_limits<double>::infinity)()
                                                    : (points[nearest[0]] - p).norm());
      }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_BOUNDARY_DEVIATION_H
