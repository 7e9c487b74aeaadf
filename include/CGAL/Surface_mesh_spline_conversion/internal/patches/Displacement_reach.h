// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_DISPLACEMENT_REACH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_DISPLACEMENT_REACH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/curves/chord_gaps.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// How far from the boundary the gaps between a mesh and its boundary curves may displace a surface,
// in model units. Within the band along the boundary, a surface may be as far from the mesh as the
// gaps at the nearest edge tell, see `tolerated_gaps()`, beyond it not at all. So the displacement has
// to end with the band; where an edge has a much larger gap than others not far away, for instance
// across a fillet, before points are nearer to these.
class Displacement_reach
{
public:
  // `band`: the width of the band along the boundary
  // `negligible_gap`: displacements that exceed the tolerated gaps by less than that do not matter
  template <typename TriangleMesh, typename VertexPointMap, typename Network>
  Displacement_reach(const TriangleMesh& tm, const VertexPointMap& vpm, const Network& network,
                     double band, double negligible_gap)
    : m_chains(network.number_of_chains())
  {
    std::vector<Edge> edges;
    for(std::size_t l = 0; l < network.number_of_loops(); ++l)
      add_loop(tm, vpm, network, network.loop(l), edges);
    for(std::size_t c = 0; c < network.number_of_chains(); ++c)
    {
      m_chains[c].reaches.resize(network.chain_halfedges(c).size());
      for(std::size_t i = 1; i <= network.chain_halfedges(c).size(); ++i)
        m_chains[c].ends.push_back(CGAL::to_double(network.arc_length(c, i)));
    }
    for(const Edge& edge : edges)
      m_chains[edge.chain].reaches[edge.index]
        = reach(edge, edges, band, negligible_gap);
  }

  // returns the reach of the displacement of the boundary of the mesh at an arc length of a chain,
  // which may be more than the length of a closed one
  double operator()(std::size_t chain, double arc_length) const
  {
    const Chain& c = m_chains[chain];
    const double s = arc_length - c.ends.back() * std::floor(arc_length / c.ends.back());
    const std::size_t i
      = std::size_t(std::upper_bound(c.ends.begin(), c.ends.end(), s) - c.ends.begin());
    return c.reaches[(std::min)(i, c.reaches.size() - 1)];
  }

private:
  typedef CGAL::Simple_cartesian<double> Kernel;

  struct Edge
  {
    std::size_t chain, index;
    Kernel::Segment_3 segment;
    double gap, tolerated_gap;
  };

  struct Chain
  {
    std::vector<double> ends; // arc lengths of the ends of the edges
    std::vector<double> reaches;
  };

  template <typename TriangleMesh, typename VertexPointMap, typename Network, typename Loop>
  static void add_loop(const TriangleMesh& tm, const VertexPointMap& vpm, const Network& network,
                       const Loop& loop, std::vector<Edge>& edges)
  {
    const auto point = [&](auto v)
    {
      const Eigen::Vector3d p = to_eigen(get(vpm, v));
      return Kernel::Point_3(p.x(), p.y(), p.z());
    };
    std::vector<double> gaps;
    for(auto h : loop)
      gaps.push_back(chord_gap(tm, vpm, network, h));
    const std::vector<double> tolerated = tolerated_gaps(gaps);
    std::size_t i = 0;
    for(auto h : loop)
    {
      const auto place = network.chain_of(h);
      edges.push_back(Edge{place.chain, place.index,
                           Kernel::Segment_3(point(source(h, tm)), point(target(h, tm))),
                           gaps[i], tolerated[i]});
      ++i;
    }
  }

  // A displacement falls linearly with the distance from its edge.
  static double reach(const Edge& edge, const std::vector<Edge>& edges, double band,
                      double negligible_gap)
  {
    double result = band;
    for(const Edge& other : edges)
    {
      // a point whose nearest edge is `other` is at least half as far away as that
      const double share = (other.tolerated_gap + negligible_gap) / edge.gap; // that is tolerated
      if(!(share < 1))
        continue;
      const double largest_distance = 2 * (1 - share) * result;
      if(CGAL::squared_distance(edge.segment, other.segment) < largest_distance * largest_distance)
        result = std::sqrt(CGAL::squared_distance(edge.segment, other.segment)) / (2 * (1 - share));
    }
    return result;
  }

  std::vector<Chain> m_chains;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_DISPLACEMENT_REACH_H
