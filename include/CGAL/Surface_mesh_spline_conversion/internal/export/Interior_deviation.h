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

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Deviation_statistics.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Mesh_distance.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Piece_projection.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Surface_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Uphill_search.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>

#include <CGAL/boost/graph/iterator.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Distances between the pieces of a surface and a mesh in both directions. Near the boundary,
/// where the mesh has chords and the surface has curves, only what exceeds the chord gap counts.
/// Where a surface has not changed since another measurement, what is known of its pieces is taken
/// from there.
class Interior_deviation
{
public:
  /// \param band the width of the band along the boundary where gaps count
  /// \param bound deviations up to it count as within the tolerance
  /// \param limit larger deviations are violations
  /// \param previous a measurement with the same mesh, band and limit, or a null pointer
  Interior_deviation(std::vector<Bezier_piece> pieces, const Mesh_distance& mesh, double band,
                     double bound, double limit, const Interior_deviation* previous = nullptr)
    : m_pieces(std::move(pieces)), m_mesh(mesh), m_band(band), m_limit(limit),
      m_search(m_pieces, mesh, band, limit)
  {
    m_statistics.bound = bound;
    const std::vector<std::size_t> changed = take_known_pieces(previous);
    std::vector<Piece_samples> parts(changed.size());
    for_each_index(changed.size(), [&](std::size_t i) { sample_piece(changed[i], parts[i]); });
    climb_from_samples(changed, parts);
    for(std::size_t i = 0; i < changed.size(); ++i)
      m_samples[changed[i]] = std::make_shared<const Piece_samples>(std::move(parts[i]));
    for(std::size_t i = 0; i < m_samples.size(); ++i)
      add_piece(i);
    climb(largest_of_pieces());
  }

  Interior_deviation(const Interior_deviation&) = delete;
  Interior_deviation& operator=(const Interior_deviation&) = delete;

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
    const Piece_projection projection(m_pieces, m_samples);
    std::vector<Piece_foot> feet = projection(queries);
    // a closer point can be closer by an interval between samples
    projection.search_all_around(queries, CLOSE_TO_LIMIT * m_limit,
                                 m_limit + m_mesh.mean_edge_length(), feet);
    for(std::size_t i = 0; i < queries.size(); ++i)
    {
      const double deviation = m_mesh.excess(queries[i], feet[i].distance, m_band);
      m_statistics.add(deviation, queries[i]);
      note_violation(feet[i].piece, Summit{deviation, queries[i]});
    }
    climb(starts_at(projection(places_on_creases(tm, vpm, projection))));
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
      if(m_samples[i]->facing < 0 && m_facing.at(m_pieces[i].face) < 0)
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
  static constexpr std::size_t NUMBER_OF_LARGEST = 24;

  // Between samples the deviation may be that much larger: a crease of the mesh passes between
  // them.
  static constexpr double CLOSE_TO_LIMIT = 0.75;

  // Finds the pieces that are among those of another measurement, to the bit. Returns the others.
  std::vector<std::size_t> take_known_pieces(const Interior_deviation* previous)
  {
    std::vector<const Bezier_piece*> known;
    if(previous != nullptr)
      for(const Bezier_piece& piece : previous->m_pieces)
        known.push_back(&piece);
    std::sort(known.begin(), known.end(), comes_before);
    m_samples.resize(m_pieces.size());
    std::vector<std::size_t> result;
    for(std::size_t i = 0; i < m_pieces.size(); ++i)
    {
      const auto found = std::lower_bound(known.begin(), known.end(), &m_pieces[i], comes_before);
      if(found == known.end() || comes_before(&m_pieces[i], *found))
        result.push_back(i);
      else
        m_samples[i] = previous->m_samples[std::size_t(*found - previous->m_pieces.data())];
    }
    return result;
  }

  // an order of pieces by their polynomials
  static bool comes_before(const Bezier_piece* a, const Bezier_piece* b)
  {
    if(a->degree != b->degree)
      return a->degree < b->degree;
    return std::lexicographical_compare(
      a->points.begin(), a->points.end(), b->points.begin(), b->points.end(),
      [](const Eigen::Vector3d& p, const Eigen::Vector3d& q)
      { return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3); });
  }

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
    part.intervals = {{nu, nv}};
    const std::size_t n = std::size_t((nu + 1) * (nv + 1) + nu * nv);
    part.points.reserve(n);
    part.triangles.reserve(n);
    part.deviations.reserve(n);
    for(int b = 0; b <= 2 * nv; ++b)
      for(int a = b & 1; a <= 2 * nu; a += 2)
        add_sample(piece, a / (2. * nu), b / (2. * nv), a & 1, part);
  }

  void add_sample(const Bezier_piece& piece, double u, double v, bool is_center,
                  Piece_samples& part) const
  {
    std::size_t triangle = part.triangles.empty() ? 0 : part.triangles.back();
    const auto d = is_center ? piece.point_and_tangents(u, v)
                             : Bezier_piece::Point_and_tangents{{piece.point(u, v)}};
    const Mesh_distance::Foot foot = m_mesh.foot(d[0], triangle);
    part.points.push_back(d[0]);
    part.triangles.push_back(std::uint32_t(triangle));
    part.deviations.push_back(m_mesh.excess(d[0], foot.distance, m_band));
    if(is_center)
      part.facing += (d[1].cross(d[2]).dot(foot.normal) >= 0) ? 1 : -1;
  }

  void add_piece(std::size_t i)
  {
    const Piece_samples& part = *m_samples[i];
    for(std::size_t k = 0; k < part.points.size(); ++k)
    {
      m_statistics.add(part.deviations[k], part.points[k]);
      note_violation(i, Summit{part.deviations[k], part.points[k]});
    }
    for(const Summit& summit : part.summits)
      note(i, summit);
    m_facing[m_pieces[i].face] += part.facing;
  }

  // Walks uphill from large deviations, so that neither the maximum nor the verdict on a piece
  // hangs on the grid. A piece may have several peaks.
  void climb(std::vector<Climber> climbers)
  {
    for_each_index(climbers.size(), [&](std::size_t i) { m_search(climbers[i]); });
    for(const Climber& climber : climbers)
      note(climber.piece, climber.summit);
  }

  // Climbs from the samples that come close to the limit, and from peaks beside which the deviation
  // may rise to it. On a piece that is known to violate the limit, peaks are enough; elsewhere, a
  // ridge between the samples may rise beside one that is no peak.
  void climb_from_samples(const std::vector<std::size_t>& pieces,
                          std::vector<Piece_samples>& parts) const
  {
    std::vector<Climber> climbers;
    std::vector<std::size_t> part_of_climber;
    for(std::size_t i = 0; i < parts.size(); ++i)
    {
      const std::vector<char> is_peak = peaks(parts[i]);
      const bool is_violation = parts[i].deviations[parts[i].largest()] > m_limit;
      for(std::size_t k = 0; k < is_peak.size(); ++k)
        if(is_close_to_limit(parts[i].deviations[k])
             ? is_peak[k] || !is_violation : is_peak[k] && may_rise_to_limit(pieces[i], parts[i], k))
        {
          climbers.push_back(climber_at(pieces[i], parts[i], k));
          part_of_climber.push_back(i);
        }
    }
    for_each_index(climbers.size(), [&](std::size_t c) { m_search(climbers[c]); });
    for(std::size_t c = 0; c < climbers.size(); ++c)
      parts[part_of_climber[c]].summits.push_back(climbers[c].summit);
  }

  bool is_close_to_limit(double deviation) const { return deviation > CLOSE_TO_LIMIT * m_limit; }

  // May the deviation rise to the limit where no other sample is closer? Along the surface it changes
  // by the sine of the angle between the normals of surface and mesh.
  bool may_rise_to_limit(std::size_t piece, const Piece_samples& part, std::size_t k) const
  {
    const Piece_sample sample = part.sample(k);
    const Bezier_piece::Point_and_tangents d
      = m_pieces[piece].point_and_tangents(sample.u, sample.v);
    const double distance
      = (std::max)(d[1].norm() / part.intervals[0], d[2].norm() / part.intervals[1]) / 2;
    const double room = m_limit - part.deviations[k];
    if(distance <= room)
      return false;
    std::size_t triangle = sample.triangle;
    const Eigen::Vector3d normal = m_mesh.foot(d[0], triangle).normal;
    const Eigen::Vector3d cross = d[1].cross(d[2]);
    return distance * cross.cross(normal).norm() > room * cross.norm() * normal.norm();
  }

  static Climber climber_at(std::size_t piece, const Piece_samples& part, std::size_t k)
  {
    return Climber{piece, part.sample(k), {part.deviations[k], part.points[k]}};
  }

  // returns the largest samples of the few pieces with the largest ones, but for those where climbs
  // have started
  std::vector<Climber> largest_of_pieces() const
  {
    std::vector<Climber> result;
    for(std::size_t i = 0; i < m_samples.size(); ++i)
      result.push_back(climber_at(i, *m_samples[i], m_samples[i]->largest()));
    const std::size_t n = (std::min)(NUMBER_OF_LARGEST, result.size());
    std::partial_sort(result.begin(), result.begin() + std::ptrdiff_t(n), result.end(),
                      [](const Climber& a, const Climber& b)
                      { return std::make_pair(-a.summit.deviation, a.piece)
                             < std::make_pair(-b.summit.deviation, b.piece); });
    result.erase(result.begin() + std::ptrdiff_t(n), result.end());
    result.erase(std::remove_if(result.begin(), result.end(), [this](const Climber& climber)
                                { return is_close_to_limit(climber.summit.deviation); }),
                 result.end());
    return result;
  }

  // Along a crease of the mesh, the deviation of a surface on its inner side has a ridge, which may
  // rise between samples by more than these tell.
  std::vector<Climber> starts_at(const std::vector<Piece_foot>& feet) const
  {
    std::vector<Climber> result;
    for(const Piece_foot& foot : feet)
    {
      const Eigen::Vector3d p = m_pieces[foot.piece].point(foot.u, foot.v);
      Piece_sample sample{foot.u, foot.v, 0};
      const double deviation = m_mesh.excess(p, m_mesh.foot(p, sample.triangle).distance, m_band);
      if(is_close_to_limit(deviation))
        result.push_back(Climber{foot.piece, sample, {deviation, p}});
    }
    return result;
  }

  // returns the middles of the edges of the mesh at which the ridge may rise close to the limit
  // from the nearest sample
  template <typename TriangleMesh, typename VertexPointMap>
  std::vector<Eigen::Vector3d> places_on_creases(const TriangleMesh& tm, const VertexPointMap& vpm,
                                                 const Piece_projection& projection) const
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
      const auto [piece, k] = projection.nearest_sample(middle);
      const Piece_samples& samples = *m_samples[piece];
      if(is_close_to_limit(samples.deviations[k] + slope * (samples.points[k] - middle).norm()))
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

  void note(std::size_t piece, const Summit& summit)
  {
    note_violation(piece, summit);
    if(summit.deviation > m_statistics.maximum)
    {
      m_statistics.maximum = summit.deviation;
      m_statistics.worst = summit.place;
    }
  }

  void note_violation(std::size_t piece, const Summit& summit)
  {
    if(!(summit.deviation > m_limit))
      return;
    const auto entry = m_violations.emplace(piece, summit).first;
    if(summit.deviation > entry->second.deviation)
      entry->second = summit;
  }

  std::vector<Bezier_piece> m_pieces;
  const Mesh_distance& m_mesh;
  double m_band, m_limit;
  Uphill_search m_search;
  Surface_samples m_samples;
  std::map<std::size_t, long> m_facing;       // by face
  std::map<std::size_t, Summit> m_violations; // by piece
  Deviation_statistics m_statistics;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_INTERIOR_DEVIATION_H
