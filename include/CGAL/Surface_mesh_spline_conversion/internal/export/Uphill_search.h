// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_UPHILL_SEARCH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_UPHILL_SEARCH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Mesh_distance.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Surface_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>

#include <CGAL/number_type_config.h>

#include <boost/math/tools/minima.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// a sample on its way uphill
struct Climber
{
  std::size_t piece;
  Piece_sample sample;
  Summit summit;
};

/// Searches for places of a surface with large deviations from a mesh, uphill from samples.
class Uphill_search
{
public:
  /// \param band the width of the band along the boundary where chord gaps do not count
  /// \param limit of the deviations
  Uphill_search(const std::vector<Bezier_piece>& pieces, const Mesh_distance& mesh, double band,
                double limit)
    : m_pieces(pieces), m_mesh(mesh), m_band(band), m_limit(limit)
  {}

  /// Tries directions all around with smaller and smaller steps. There have to be many: beside a
  /// crease of the mesh the deviation has a ridge, and a step that leaves it goes down. Where that
  /// ends closely below the limit, ridges are followed, too.
  void operator()(Climber& climber) const
  {
    constexpr double FIRST_STEP = 1. / 16, LAST_STEP = 1e-4, LAST_RIDGE_STEP = 1. / 512;
    for(double step = FIRST_STEP; step > LAST_STEP; )
      if(!step_uphill(step, climber))
        step /= 2;
    for(double step = FIRST_STEP; step > LAST_RIDGE_STEP && is_just_met(climber.summit); )
      if(!step_along_ridge(step, climber))
        step /= 2;
  }

private:
  static constexpr std::size_t NUMBER_OF_DIRECTIONS = 32;

  // is the deviation closely below the limit?
  bool is_just_met(const Summit& summit) const
  {
    constexpr double CLOSE = 0.98;
    return CLOSE * m_limit <= summit.deviation && summit.deviation <= m_limit;
  }

  // takes steps in directions all around, as far as they lead uphill; returns `false` if none does
  bool step_uphill(double step, Climber& climber) const
  {
    static const std::array<Eigen::Vector2d, NUMBER_OF_DIRECTIONS> directions = compass();
    bool has_improved = false;
    for(const Eigen::Vector2d& direction : directions)
      if(move_uphill(position(climber) + step * direction, climber))
        has_improved = true;
    return has_improved;
  }

  // Takes the first step that leads uphill when it is completed by the best one across it, which
  // goes back to the ridge. Returns `false` if none does.
  bool step_along_ridge(double step, Climber& climber) const
  {
    static const std::array<Eigen::Vector2d, NUMBER_OF_DIRECTIONS> directions = compass();
    for(const Eigen::Vector2d& direction : directions)
    {
      const Eigen::Vector2d at = position(climber) + step * direction;
      const Eigen::Vector2d across = step / 4 * Eigen::Vector2d(-direction[1], direction[0]);
      if(may_rise(climber, at - across, at + across)
         && move_uphill(highest_place(climber, at - across, at + across), climber))
        return true;
    }
    return false;
  }

  // May there be a larger deviation between `a` and `b`? The distance from any one triangle is a
  // bound, and is convex along a straight line. The curve between the points leaves the line by its
  // height in the middle; twice that is on the safe side.
  bool may_rise(const Climber& climber, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const
  {
    if(!is_inside(a) || !is_inside(b))
      return true;
    const Bezier_piece& piece = m_pieces[climber.piece];
    const Eigen::Vector2d m = (a + b) / 2;
    const Eigen::Vector3d p = piece.point(a[0], a[1]), q = piece.point(b[0], b[1]);
    const Eigen::Vector3d middle = piece.point(m[0], m[1]);
    std::size_t triangle = climber.sample.triangle;
    m_mesh.foot(middle, triangle);
    const double bound = (std::max)(m_mesh.distance_to_triangle(p, triangle),
                                    m_mesh.distance_to_triangle(q, triangle));
    return bound + 2 * (middle - (p + q) / 2).norm() > climber.summit.deviation;
  }

  // the place between `a` and `b` with the largest deviation
  Eigen::Vector2d highest_place(const Climber& climber, const Eigen::Vector2d& a,
                                const Eigen::Vector2d& b) const
  {
    constexpr int NUMBER_OF_BITS = 10; // of the result
    std::size_t hint = climber.sample.triangle;
    auto depth = [&](double t)
    {
      const Eigen::Vector2d uv = a + t * (b - a);
      const Eigen::Vector3d p
        = m_pieces[climber.piece].point(clamped(uv[0]), clamped(uv[1]));
      return -m_mesh.excess(p, m_mesh.foot(p, hint).distance, m_band);
    };
    return a + boost::math::tools::brent_find_minima(depth, 0., 1., NUMBER_OF_BITS).first * (b - a);
  }

  static Eigen::Vector2d position(const Climber& climber)
  {
    return Eigen::Vector2d(climber.sample.u, climber.sample.v);
  }

  // moves to the given parameters if the deviation is larger there; returns whether it is
  bool move_uphill(const Eigen::Vector2d& uv, Climber& climber) const
  {
    const double u = clamped(uv[0]), v = clamped(uv[1]);
    const Eigen::Vector3d p = m_pieces[climber.piece].point(u, v);
    std::size_t& hint = climber.sample.triangle;
    if(m_mesh.distance_to_triangle(p, hint) <= climber.summit.deviation)
      return false; // a bound of what is sought
    const double deviation = m_mesh.excess(p, m_mesh.foot(p, hint).distance, m_band);
    if(!(deviation > climber.summit.deviation))
      return false;
    climber.sample.u = u;
    climber.sample.v = v;
    climber.summit.deviation = deviation;
    climber.summit.place = p;
    return true;
  }

  static std::array<Eigen::Vector2d, NUMBER_OF_DIRECTIONS> compass()
  {
    std::array<Eigen::Vector2d, NUMBER_OF_DIRECTIONS> result;
    for(std::size_t i = 0; i < NUMBER_OF_DIRECTIONS; ++i)
    {
      const double angle = 2 * CGAL_PI * double(i) / double(NUMBER_OF_DIRECTIONS);
      result[i] = Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    return result;
  }

  static bool is_inside(const Eigen::Vector2d& uv)
  {
    return 0 <= uv.minCoeff() && uv.maxCoeff() <= 1;
  }

  static double clamped(double t) { return (std::min)(1., (std::max)(0., t)); }

  const std::vector<Bezier_piece>& m_pieces;
  const Mesh_distance& m_mesh;
  double m_band, m_limit;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_UPHILL_SEARCH_H
