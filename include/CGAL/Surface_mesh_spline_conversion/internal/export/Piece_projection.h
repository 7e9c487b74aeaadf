// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_PIECE_PROJECTION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_PIECE_PROJECTION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Point_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Surface_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// the point of a surface that is closest to a point
struct Piece_foot
{
  std::size_t piece;
  double u;
  double v;
  double distance;
};

/// Finds the points of a surface that are closest to others, from the samples of its pieces on.
class Piece_projection
{
  typedef std::vector<Eigen::Vector3d> Points;

public:
  Piece_projection(const std::vector<Bezier_piece>& pieces, const Surface_samples& samples)
    : m_pieces(pieces), m_samples(samples), m_index(numbered_points())
  {}

  std::vector<Piece_foot> operator()(const Points& points) const
  {
    std::vector<Piece_foot> result(points.size());
    for_each_index(points.size(), [&](std::size_t i) { result[i] = project(points[i]); });
    return result;
  }

  /// The samples closest to a point may all be on a piece beside that with the closest point. This
  /// searches all pieces that come closer than the point that was found, for those at a distance
  /// between `least` and `most`.
  void search_all_around(const Points& points, double least, double most,
                         std::vector<Piece_foot>& feet) const
  {
    std::vector<Box> balls;
    for(std::size_t i = 0; i < points.size(); ++i)
      if(least <= feet[i].distance && feet[i].distance <= most)
        balls.emplace_back(box(points[i], feet[i].distance), i);
    if(balls.empty())
      return;
    std::vector<Box> hulls = boxes_of_pieces();
    std::map<std::size_t, std::vector<std::size_t> > pieces_of_point;
    box_intersection_d(balls.begin(), balls.end(), hulls.begin(), hulls.end(),
                       [&](const Box& ball, const Box& hull)
                       { pieces_of_point[ball.info()].push_back(hull.info()); });
    for(auto& entry : pieces_of_point)
    {
      std::sort(entry.second.begin(), entry.second.end());
      const Eigen::Vector3d& p = points[entry.first];
      for(std::size_t piece : entry.second)
        improve(p, piece, m_samples[piece]->nearest(p), feet[entry.first]);
    }
  }

  /// returns the sample closest to a point: the piece, and the index in its samples
  std::pair<std::size_t, std::size_t> nearest_sample(const Eigen::Vector3d& p) const
  {
    return place(m_index.nearest(p, 1).front());
  }

private:
  typedef Box_intersection_d::Box_with_info_d<double, 3, std::size_t> Box;

  static constexpr unsigned int NUMBER_OF_STARTS = 6;

  // the points of all samples, which numbers them
  std::vector<Point_index::Point_3> numbered_points()
  {
    m_first_samples.push_back(0);
    for(const auto& samples : m_samples)
      m_first_samples.push_back(m_first_samples.back() + samples->points.size());
    std::vector<Point_index::Point_3> result;
    result.reserve(m_first_samples.back());
    for(const auto& samples : m_samples)
      for(const Eigen::Vector3d& p : samples->points)
        result.emplace_back(p.x(), p.y(), p.z());
    return result;
  }

  // the piece of a sample, and its index there
  std::pair<std::size_t, std::size_t> place(std::size_t sample) const
  {
    const auto next = std::upper_bound(m_first_samples.begin(), m_first_samples.end(), sample);
    return {std::size_t(next - m_first_samples.begin()) - 1, sample - *(next - 1)};
  }

  // From all samples of a piece near the closest one, the search ends in the same point.
  Piece_foot project(const Eigen::Vector3d& p) const
  {
    Piece_foot result{0, 0, 0, (std::numeric_limits<double>::infinity)()};
    std::vector<std::size_t> pieces;
    for(std::size_t i : m_index.nearest(p, NUMBER_OF_STARTS))
    {
      const auto [piece, sample] = place(i);
      if(std::find(pieces.begin(), pieces.end(), piece) != pieces.end())
        continue;
      pieces.push_back(piece);
      improve(p, piece, sample, result);
    }
    return result;
  }

  // searches a piece from a sample for a closer point
  void improve(const Eigen::Vector3d& p, std::size_t piece, std::size_t sample,
               Piece_foot& foot) const
  {
    const Piece_sample start = m_samples[piece]->sample(sample);
    Piece_foot next{piece, start.u, start.v, 0};
    next.distance = project_to_piece(m_pieces[piece], p, next.u, next.v);
    if(next.distance < foot.distance)
      foot = next;
  }

  std::vector<Box> boxes_of_pieces() const
  {
    std::vector<Box> result;
    for(std::size_t i = 0; i < m_pieces.size(); ++i)
    {
      Bbox_3 hull;
      for(const Eigen::Vector3d& p : m_pieces[i].points)
        hull += box(p, 0);
      result.emplace_back(hull, i);
    }
    return result;
  }

  static Bbox_3 box(const Eigen::Vector3d& p, double radius)
  {
    return Bbox_3(p.x() - radius, p.y() - radius, p.z() - radius,
                  p.x() + radius, p.y() + radius, p.z() + radius);
  }

  const std::vector<Bezier_piece>& m_pieces;
  const Surface_samples& m_samples;
  std::vector<std::size_t> m_first_samples; // of the pieces
  Point_index m_index;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_PIECE_PROJECTION_H
