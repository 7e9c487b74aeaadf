// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_INTERIOR_DEVIATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_INTERIOR_DEVIATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Point_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Deviation_statistics.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Mesh_distance.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_type_config.h>

#include <boost/math/tools/minima.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Distances between the pieces of a surface and a mesh in both directions. Near the boundary,
/// where the mesh has chords and the surface has curves, only what exceeds the chord gap counts.
class Interior_deviation
{
public:
  /// \param band the width of the band along the boundary where gaps count
  /// \param bound deviations up to it count as within the tolerance
  /// \param limit larger deviations are violations
  Interior_deviation(const std::vector<Bezier_piece>& pieces, const Mesh_distance& mesh,
                     double band, double bound, double limit)
    : m_pieces(pieces), m_mesh(mesh), m_band(band), m_limit(limit)
  {
    m_statistics.bound = bound;
    std::vector<Piece_samples> parts(pieces.size());
    for_each_index(pieces.size(), [&](std::size_t i) { sample_piece(i, parts[i]); });
    for(const Piece_samples& part : parts)
      append(part);
    climb(starts_at_samples());
  }

  /// adds the distances of the vertices and face centres of the mesh from the surface, and searches
  /// for large deviations of the surface above the creases of the mesh
  template <typename TriangleMesh, typename VertexPointMap>
  void add_mesh(const TriangleMesh& tm, const VertexPointMap& vpm)
  {
    std::vector<Eigen::Vector3d> queries;
    for(auto v : vertices(tm))
      queries.push_back(to_eigen(get(vpm, v)));
    for(auto f : faces(tm))
    {
      queries.push_back(Eigen::Vector3d::Zero());
      for(auto v : vertices_around_face(halfedge(f, tm), tm))
        queries.back() += to_eigen(get(vpm, v)) / 3;
    }
    const Point_index index(m_points);
    const std::vector<Foot> feet = project_all(queries, index);
    for(std::size_t i = 0; i < queries.size(); ++i)
    {
      const double deviation = excess(queries[i], feet[i].distance);
      m_statistics.add(deviation, queries[i]);
      note_violation(feet[i].piece, deviation, queries[i]);
    }
    climb(starts_at(project_all(places_on_creases(tm, vpm, index), index)));
  }

  const Deviation_statistics& statistics() const { return m_statistics; }

  /// the places where the deviation exceeds the limit: the worst one of each piece, in their order
  std::vector<Eigen::Vector3d> violations() const
  {
    std::vector<Eigen::Vector3d> result;
    for(const auto& entry : m_violations)
      result.push_back(entry.second.place);
    return result;
  }

  /// the middle of each piece that looks against the mesh at most of its samples, of faces that do
  std::vector<Eigen::Vector3d> folds() const
  {
    std::vector<Eigen::Vector3d> result;
    for(std::size_t i = 0; i < m_pieces.size(); ++i)
      if(m_piece_facing[i] < 0 && m_facing.at(m_pieces[i].face) < 0)
        result.push_back(m_pieces[i].point(0.5, 0.5));
    return result;
  }

  /// the number of faces that look against the mesh at most of their samples
  std::size_t number_of_faces_against_mesh() const
  {
    std::size_t n = 0;
    for(const auto& entry : m_facing)
      if(entry.second < 0)
        ++n;
    return n;
  }

private:
  static constexpr int MINIMUM_NUMBER_OF_INTERVALS = 4;
  static constexpr int MAXIMUM_NUMBER_OF_INTERVALS = 64;
  static constexpr unsigned int NUMBER_OF_STARTS = 6;
  static constexpr std::size_t NUMBER_OF_LARGEST = 24;
  static constexpr std::size_t NUMBER_OF_DIRECTIONS = 32;

  // Between samples the deviation may be that much larger: a crease of the mesh passes between
  // them.
  static constexpr double CLOSE_TO_LIMIT = 0.75;

  struct Sample
  {
    std::size_t piece;
    double u;
    double v;
    std::size_t triangle; // of the mesh, the closest one
  };

  struct Piece_samples
  {
    std::vector<Sample> samples;
    std::vector<Eigen::Vector3d> points;
    std::vector<double> deviations;
    std::vector<char> is_peak; // is no sample beside it larger?
    long facing = 0;      // samples that look like the mesh minus those that look against it
    std::size_t hint = 0; // for the search on the mesh
  };

  // the point of the surface that is closest to a point of the mesh
  struct Foot
  {
    std::size_t piece;
    double u;
    double v;
    double distance;
  };

  // the end of a climb
  struct Summit
  {
    std::size_t piece;
    double deviation;
    Eigen::Vector3d place;
  };

  // a sample on its way uphill
  struct Climber
  {
    Sample sample;
    Summit summit;
  };

  struct Violation
  {
    double deviation;
    Eigen::Vector3d place;
  };

  // so many intervals that samples are as dense as the vertices of the mesh; an even number
  int number_of_intervals(double length) const
  {
    const double n = std::ceil(length / m_mesh.mean_edge_length() / 2) * 2;
    return int((std::min)(double(MAXIMUM_NUMBER_OF_INTERVALS),
                          (std::max)(double(MINIMUM_NUMBER_OF_INTERVALS), n)));
  }

  double length(const Bezier_piece& piece, int axis) const
  {
    double result = 0;
    Eigen::Vector3d last;
    for(int i = 0; i <= 4; ++i)
    {
      const double t = i / 4.;
      const Eigen::Vector3d p = (axis == 0) ? piece.point(t, 0.5) : piece.point(0.5, t);
      if(i > 0)
        result += (p - last).norm();
      last = p;
    }
    return result;
  }

  // grid points and, as a mesh of the same spacing could hide its chords, the centres between them
  void sample_piece(std::size_t i, Piece_samples& part) const
  {
    const Bezier_piece& piece = m_pieces[i];
    const int nu = number_of_intervals(length(piece, 0)), nv = number_of_intervals(length(piece, 1));
    for(int b = 0; b <= 2 * nv; ++b)
      for(int a = b & 1; a <= 2 * nu; a += 2)
        add_sample({i, a / (2. * nu), b / (2. * nv), part.hint}, a & 1, part);
    find_peaks(nu, nv, part);
  }

  // Samples lie where the sum of column and row is even, see above.
  static void find_peaks(int nu, int nv, Piece_samples& part)
  {
    static constexpr int OFFSETS[8][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1},
                                          {-2, 0}, {2, 0}, {0, -2}, {0, 2}};
    auto deviation = [&](int column, int row)
    {
      const int before = row / 2 * (2 * nu + 1) + (row & 1) * (nu + 1);
      return part.deviations[std::size_t(before + column / 2)];
    };
    for(int b = 0; b <= 2 * nv; ++b)
      for(int a = b & 1; a <= 2 * nu; a += 2)
      {
        bool is_peak = true;
        for(const auto& offset : OFFSETS)
        {
          const int column = a + offset[0], row = b + offset[1];
          if(0 <= column && column <= 2 * nu && 0 <= row && row <= 2 * nv)
            is_peak = is_peak && deviation(column, row) <= deviation(a, b);
        }
        part.is_peak.push_back(is_peak);
      }
  }

  void add_sample(Sample sample, bool is_center, Piece_samples& part) const
  {
    const Bezier_piece& piece = m_pieces[sample.piece];
    const auto d = is_center ? piece.point_and_tangents(sample.u, sample.v)
                 : Bezier_piece::Point_and_tangents{{piece.point(sample.u, sample.v)}};
    const Mesh_distance::Foot foot = m_mesh.foot(d[0], sample.triangle);
    part.hint = sample.triangle;
    part.samples.push_back(sample);
    part.points.push_back(d[0]);
    part.deviations.push_back(excess(d[0], foot.distance));
    if(is_center)
      part.facing += (d[1].cross(d[2]).dot(foot.normal) >= 0) ? 1 : -1;
  }

  void append(const Piece_samples& part)
  {
    m_samples.insert(m_samples.end(), part.samples.begin(), part.samples.end());
    m_points.insert(m_points.end(), part.points.begin(), part.points.end());
    m_deviations.insert(m_deviations.end(), part.deviations.begin(), part.deviations.end());
    m_is_peak.insert(m_is_peak.end(), part.is_peak.begin(), part.is_peak.end());
    for(std::size_t i = 0; i < part.points.size(); ++i)
    {
      m_statistics.add(part.deviations[i], part.points[i]);
      note_violation(part.samples[i].piece, part.deviations[i], part.points[i]);
    }
    m_facing[m_pieces[part.samples.front().piece].face] += part.facing;
    m_piece_facing.push_back(part.facing);
  }

  // What is tolerated falls continuously to nothing in the outer half of the band, or in the part of
  // it that is farther away than the curves are from their chords. If it jumped, the search uphill
  // would not find what exceeds the tolerance just beyond the band.
  double excess(const Eigen::Vector3d& p, double distance) const
  {
    double gap;
    const double outer = m_band - m_mesh.boundary_distance(p, m_band, gap);
    const double fall = (std::min)(m_band / 2, m_band - gap);
    const double share = outer >= fall ? 1 : (std::max)(0., outer / fall);
    return (std::max)(0., distance - (outer >= 0 ? share * gap : 0));
  }

  // Walks uphill from large deviations, so that neither the maximum nor the verdict on a piece
  // hangs on the grid. A piece may have several peaks.
  void climb(const std::vector<Climber>& starts)
  {
    std::vector<Summit> summits(starts.size());
    for_each_index(starts.size(), [&](std::size_t i) { summits[i] = climb_from(starts[i]); });
    for(const Summit& summit : summits)
    {
      note_violation(summit.piece, summit.deviation, summit.place);
      if(summit.deviation > m_statistics.maximum)
      {
        m_statistics.maximum = summit.deviation;
        m_statistics.worst = summit.place;
      }
    }
  }

  // The samples that come close to the limit, and the largest ones of a few pieces. On a piece that
  // is known to violate the limit, peaks are enough; elsewhere, a ridge between the samples may rise
  // beside one that is no peak.
  std::vector<Climber> starts_at_samples() const
  {
    std::vector<std::size_t> largest, starts; // the largest of each piece
    for(std::size_t i = 0; i < m_samples.size(); ++i)
    {
      if(m_deviations[i] > CLOSE_TO_LIMIT * m_limit
         && (m_is_peak[i] || m_violations.count(m_samples[i].piece) == 0))
        starts.push_back(i);
      if(i == 0 || m_samples[i].piece != m_samples[i - 1].piece)
        largest.push_back(i);
      else if(m_deviations[i] > m_deviations[largest.back()])
        largest.back() = i;
    }
    const std::size_t n = (std::min)(NUMBER_OF_LARGEST, largest.size());
    std::partial_sort(largest.begin(), largest.begin() + std::ptrdiff_t(n), largest.end(),
                      [this](std::size_t a, std::size_t b)
                      { return std::make_pair(-m_deviations[a], a)
                             < std::make_pair(-m_deviations[b], b); });
    starts.insert(starts.end(), largest.begin(), largest.begin() + std::ptrdiff_t(n));
    std::vector<Climber> result;
    for(std::size_t i : starts)
      result.push_back(Climber{m_samples[i],
                               {m_samples[i].piece, m_deviations[i], m_points[i]}});
    return result;
  }

  // Along a crease of the mesh, the deviation of a surface on its inner side has a ridge, which may
  // rise between samples by more than these tell.
  std::vector<Climber> starts_at(const std::vector<Foot>& feet) const
  {
    std::vector<Climber> result;
    for(const Foot& foot : feet)
    {
      const Eigen::Vector3d p = m_pieces[foot.piece].point(foot.u, foot.v);
      Sample sample{foot.piece, foot.u, foot.v, 0};
      const double deviation = excess(p, m_mesh.foot(p, sample.triangle).distance);
      if(deviation > CLOSE_TO_LIMIT * m_limit)
        result.push_back(Climber{sample, {foot.piece, deviation, p}});
    }
    return result;
  }

  // returns the middles of the edges of the mesh at which the ridge may rise close to the limit
  // from the nearest sample
  template <typename TriangleMesh, typename VertexPointMap>
  std::vector<Eigen::Vector3d> places_on_creases(const TriangleMesh& tm, const VertexPointMap& vpm,
                                                 const Point_index& index) const
  {
    // samples are half an edge apart
    const double least_slope = (1 - CLOSE_TO_LIMIT) * m_limit / (m_mesh.mean_edge_length() / 4);
    std::vector<Eigen::Vector3d> result;
    for(auto e : edges(tm))
    {
      const auto h = halfedge(e, tm);
      const double slope = is_border(e, tm) ? 0 : slope_of_crease(h, tm, vpm);
      if(!(slope > least_slope))
        continue;
      const Eigen::Vector3d middle
        = (to_eigen(get(vpm, source(h, tm))) + to_eigen(get(vpm, target(h, tm)))) / 2;
      const std::size_t i = index.nearest(middle, 1).front();
      if(m_deviations[i] + slope * (m_points[i] - middle).norm() > CLOSE_TO_LIMIT * m_limit)
        result.push_back(middle);
    }
    return result;
  }

  // the sine of half the angle between the normals at an edge
  template <typename Halfedge, typename TriangleMesh, typename VertexPointMap>
  static double slope_of_crease(Halfedge h, const TriangleMesh& tm, const VertexPointMap& vpm)
  {
    return (normal(h, tm, vpm) - normal(opposite(h, tm), tm, vpm)).norm() / 2;
  }

  template <typename Halfedge, typename TriangleMesh, typename VertexPointMap>
  static Eigen::Vector3d normal(Halfedge h, const TriangleMesh& tm, const VertexPointMap& vpm)
  {
    const Eigen::Vector3d a = to_eigen(get(vpm, source(h, tm)));
    const Eigen::Vector3d b = to_eigen(get(vpm, target(h, tm)));
    return (b - a).cross(to_eigen(get(vpm, target(next(h, tm), tm))) - a).normalized();
  }

  // Tries directions all around with smaller and smaller steps. There have to be many: beside a
  // crease of the mesh the deviation has a ridge, and a step that leaves it goes down. Where that
  // ends closely below the limit, ridges are followed, too.
  Summit climb_from(Climber climber) const
  {
    constexpr double FIRST_STEP = 1. / 16, LAST_STEP = 1e-4, LAST_RIDGE_STEP = 1. / 512;
    for(double step = FIRST_STEP; step > LAST_STEP; )
      if(!step_uphill(step, climber))
        step /= 2;
    for(double step = FIRST_STEP; step > LAST_RIDGE_STEP && is_just_met(climber.summit); )
      if(!step_along_ridge(step, climber))
        step /= 2;
    return climber.summit;
  }

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
    const Bezier_piece& piece = m_pieces[climber.sample.piece];
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
        = m_pieces[climber.sample.piece].point(clamped(uv[0]), clamped(uv[1]));
      return -excess(p, m_mesh.foot(p, hint).distance);
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
    const Eigen::Vector3d p = m_pieces[climber.sample.piece].point(u, v);
    std::size_t& hint = climber.sample.triangle;
    if(m_mesh.distance_to_triangle(p, hint) <= climber.summit.deviation)
      return false; // a bound of what is sought
    const double deviation = excess(p, m_mesh.foot(p, hint).distance);
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

  std::vector<Foot> project_all(const std::vector<Eigen::Vector3d>& points,
                                const Point_index& index) const
  {
    std::vector<Foot> result(points.size());
    for_each_index(points.size(), [&](std::size_t i) { result[i] = project(points[i], index); });
    return result;
  }

  Foot project(const Eigen::Vector3d& p, const Point_index& index) const
  {
    Foot result{0, 0, 0, (std::numeric_limits<double>::infinity)()};
    for(std::size_t i : index.nearest(p, NUMBER_OF_STARTS))
    {
      Foot next{m_samples[i].piece, m_samples[i].u, m_samples[i].v, 0};
      next.distance = project_to_piece(m_pieces[next.piece], p, next.u, next.v);
      if(next.distance < result.distance)
        result = next;
    }
    return result;
  }

  void note_violation(std::size_t piece, double deviation, const Eigen::Vector3d& p)
  {
    if(!(deviation > m_limit))
      return;
    const auto entry = m_violations.emplace(piece, Violation{deviation, p}).first;
    if(deviation > entry->second.deviation)
      entry->second = Violation{deviation, p};
  }

  const std::vector<Bezier_piece>& m_pieces;
  const Mesh_distance& m_mesh;
  double m_band, m_limit;
  std::vector<Sample> m_samples;
  std::vector<Eigen::Vector3d> m_points;
  std::vector<double> m_deviations;
  std::vector<char> m_is_peak;
  std::map<std::size_t, long> m_facing; // by face
  std::vector<long> m_piece_facing;
  std::map<std::size_t, Violation> m_violations; // by piece
  Deviation_statistics m_statistics;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_INTERIOR_DEVIATION_H
