// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_MESH_DISTANCE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_MESH_DISTANCE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/compatibility.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/chord_gaps.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Distances from a triangle mesh and from its boundary. Along the boundary the mesh has chords
/// where the surface has curves: this *chord gap* is known for each boundary edge.
class Mesh_distance
{
  typedef CGAL::Simple_cartesian<double> Kernel;
  typedef std::vector<Kernel::Triangle_3> Triangles;
  typedef std::vector<Kernel::Segment_3> Segments;
  typedef CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator> Triangle_primitive;
  typedef CGAL::AABB_segment_primitive<Kernel, Segments::const_iterator> Segment_primitive;
  typedef CGAL::AABB_tree<AABB_traits_3<Kernel, Triangle_primitive> > Triangle_tree;
  typedef CGAL::AABB_tree<AABB_traits_3<Kernel, Segment_primitive> > Segment_tree;

public:
  struct Foot
  {
    double distance;
    Eigen::Vector3d normal; ///< of the triangle, not of unit length
  };

  template <typename TriangleMesh, typename VertexPointMap, typename Network>
  Mesh_distance(const TriangleMesh& tm, const VertexPointMap& vpm, const Network& network)
  {
    double sum = 0;
    for(auto f : faces(tm))
    {
      std::vector<Kernel::Point_3> p;
      for(auto v : vertices_around_face(halfedge(f, tm), tm))
        p.push_back(point(to_eigen(get(vpm, v))));
      m_triangles.emplace_back(p[0], p[1], p[2]);
      for(int i = 0; i < 3; ++i)
        sum += std::sqrt(CGAL::squared_distance(p[i], p[(i + 1) % 3]));
    }
    m_mean_edge_length = m_triangles.empty() ? 0 : sum / (3. * double(m_triangles.size()));
    for(std::size_t l = 0; l < network.number_of_loops(); ++l)
      add_loop(tm, vpm, network, network.loop(l));
    m_triangle_tree.insert(m_triangles.begin(), m_triangles.end());
    m_triangle_tree.build();
    m_segment_tree.insert(m_segments.begin(), m_segments.end());
    m_segment_tree.build();
  }

  Mesh_distance(const Mesh_distance&) = delete;
  Mesh_distance& operator=(const Mesh_distance&) = delete;

  double mean_edge_length() const { return m_mean_edge_length; }

  /// `hint` makes queries fast that are close to each other; it is updated
  Foot foot(const Eigen::Vector3d& p, std::size_t& hint) const
  {
    const Triangles::const_iterator begin = m_triangles.begin();
    // only what is closer than the point of this triangle need be searched
    const auto start = Triangle_tree::Point_and_primitive_id(
      Kernel().construct_projected_point_3_object()(begin[hint], point(p)),
      begin + std::ptrdiff_t(hint));
    const auto closest = m_triangle_tree.closest_point_and_primitive(point(p), start);
    hint = std::size_t(closest.second - begin);
    const Kernel::Triangle_3& t = m_triangles[hint];
    const Eigen::Vector3d a = to_eigen(t[0]);
    return {(to_eigen(closest.first) - p).norm(),
            (to_eigen(t[1]) - a).cross(to_eigen(t[2]) - a)};
  }

  /// the distance from one of the triangles
  double distance_to_triangle(const Eigen::Vector3d& p, std::size_t triangle) const
  {
    return std::sqrt(CGAL::squared_distance(point(p), m_triangles[triangle]));
  }

  /// the distance from the boundary, infinite if it is not less than `limit`, and the chord gap there
  double boundary_distance(const Eigen::Vector3d& p, double limit, double& chord_gap) const
  {
    constexpr double FARTHER = 1.01;
    const Kernel::Point_3 query = point(p);
    chord_gap = 0;
    if(m_segments.empty())
      return (std::numeric_limits<double>::infinity)();
    // only what is closer than this point, which is on no segment, need be searched
    const auto start = Segment_tree::Point_and_primitive_id(
      query + Kernel::Vector_3(FARTHER * limit, 0, 0), m_segments.begin());
    const auto closest = m_segment_tree.closest_point_and_primitive(query, start);
    const double distance = (to_eigen(closest.first) - p).norm();
    if(!(distance < limit))
      return (std::numeric_limits<double>::infinity)();
    chord_gap = m_chord_gaps[std::size_t(closest.second - m_segments.begin())];
    return distance;
  }

  /// Returns what of the distance of a point from the mesh exceeds what is tolerated in a band along
  /// the boundary. This is the chord gap; it falls continuously to nothing in the outer half of the
  /// band, or in the part of it that is farther away than the curves are from their chords. If it
  /// jumped, a search for the largest excess would not find what is just beyond the band.
  double excess(const Eigen::Vector3d& p, double distance, double band) const
  {
    double gap;
    const double outer = band - boundary_distance(p, band, gap);
    const double fall = (std::min)(band / 2, band - gap);
    const double share = outer >= fall ? 1 : (std::max)(0., outer / fall);
    return (std::max)(0., distance - (outer >= 0 ? share * gap : 0));
  }

private:
  static Kernel::Point_3 point(const Eigen::Vector3d& p)
  {
    return Kernel::Point_3(p.x(), p.y(), p.z());
  }

  template <typename TriangleMesh, typename VertexPointMap, typename Network, typename Loop>
  void add_loop(const TriangleMesh& tm, const VertexPointMap& vpm, const Network& network,
                const Loop& loop)
  {
    std::vector<double> gaps;
    for(auto h : loop)
    {
      m_segments.emplace_back(point(to_eigen(get(vpm, source(h, tm)))),
                              point(to_eigen(get(vpm, target(h, tm)))));
      gaps.push_back(chord_gap(tm, vpm, network, h));
    }
    const std::vector<double> tolerated = tolerated_gaps(gaps);
    m_chord_gaps.insert(m_chord_gaps.end(), tolerated.begin(), tolerated.end());
  }

  Triangles m_triangles;
  Segments m_segments;
  std::vector<double> m_chord_gaps;
  Triangle_tree m_triangle_tree;
  Segment_tree m_segment_tree;
  double m_mean_edge_length = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_MESH_DISTANCE_H
