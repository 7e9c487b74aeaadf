// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_CORNER_NORMALS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_CORNER_NORMALS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/edge_turn.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_type_config.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The normals of the smooth surface that a triangle mesh stands for, at the corners of its faces.
//
// The faces around a vertex form sectors between edges at which the mesh ends, or turns so much
// that they are features. All corners of a sector have the same normal, bit for bit. It is that of
// a graph of degree two through the vertex that is closest to the vertices around it in the sector,
// and to the apexes behind them: its error is of second order also beside the boundary. Where these
// points do not determine the graph, the normal is the sum of those of the faces with the weights
// of N. Max (Journal of Graphics Tools 4(2), 1999).
template <typename TriangleMesh, typename VertexPointMap>
class Corner_normals
{
  typedef boost::graph_traits<TriangleMesh> Graph;
  typedef typename Graph::halfedge_descriptor halfedge_descriptor;
  typedef std::vector<halfedge_descriptor> Sector; // the halfedges to the vertex in its faces

public:
  // edges at which the mesh turns by more than that are features
  static constexpr double largest_turn = 40 * CGAL_PI / 180;

  Corner_normals(const TriangleMesh& tm, const VertexPointMap& vpm)
    : m_tm(tm), m_vpm(vpm),
      m_sectors(get(CGAL::dynamic_halfedge_property_t<std::size_t>(), tm)),
      m_is_end(get(CGAL::dynamic_halfedge_property_t<bool>(), tm))
  {
    for(const halfedge_descriptor h : halfedges(tm))
      put(m_is_end, h, is_border(h, tm) || is_border(opposite(h, tm), tm)
                         || edge_turn(h, tm, vpm).angle > largest_turn);
    for(const auto v : vertices(tm))
      if(halfedge(v, tm) != Graph::null_halfedge())
        set_normals(v);
  }

  // returns the unit normal at the target of `h` in the face of `h`
  const Eigen::Vector3d& operator()(halfedge_descriptor h) const
  {
    return m_normals[get(m_sectors, h)];
  }

  // does the surface end or have a feature at an edge?
  bool is_end(halfedge_descriptor h) const { return get(m_is_end, h); }

private:
  void set_normals(typename Graph::vertex_descriptor v)
  {
    bool has_ends = false;
    for(const halfedge_descriptor h : halfedges_around_target(v, m_tm))
      if(is_end(h))
      {
        has_ends = true;
        if(!is_border(h, m_tm))
          set_normals(sector(h), true);
      }
    if(!has_ends)
      set_normals(sector(halfedge(v, m_tm)), false);
  }

  Sector sector(halfedge_descriptor first) const
  {
    Sector result;
    halfedge_descriptor h = first;
    do
    {
      result.push_back(h);
      h = opposite(next(h, m_tm), m_tm);
    }
    while(h != first && !is_end(h));
    return result;
  }

  // `is_open`: whether the last face of the sector does not adjoin the first one
  void set_normals(const Sector& sector, bool is_open)
  {
    for(const halfedge_descriptor h : sector)
      put(m_sectors, h, m_normals.size());
    m_normals.push_back(graph_normal(sector, is_open, sum_of_normals(sector)));
  }

  Eigen::Vector3d point(typename Graph::vertex_descriptor v) const
  {
    return to_eigen(get(m_vpm, v));
  }

  Eigen::Vector3d sum_of_normals(const Sector& sector) const
  {
    Eigen::Vector3d result(0, 0, 0);
    for(const halfedge_descriptor h : sector)
    {
      const Eigen::Vector3d p = point(target(h, m_tm));
      const Eigen::Vector3d a = point(target(next(h, m_tm), m_tm)) - p;
      const Eigen::Vector3d b = point(source(h, m_tm)) - p;
      const double squares = a.squaredNorm() * b.squaredNorm();
      if(squares > 0)
        result += a.cross(b) / squares;
    }
    return result.normalized();
  }

  // the vertices around the vertex of a sector, and those behind, relative to it
  std::vector<Eigen::Vector3d> neighbors(const Sector& sector, bool is_open) const
  {
    const Eigen::Vector3d p = point(target(sector.front(), m_tm));
    std::vector<Eigen::Vector3d> result;
    for(const halfedge_descriptor h : sector)
    {
      const halfedge_descriptor far = prev(h, m_tm);
      result.push_back(point(source(h, m_tm)) - p);
      if(!is_end(far))
        result.push_back(point(target(next(opposite(far, m_tm), m_tm), m_tm)) - p);
    }
    if(is_open)
      result.push_back(point(target(next(sector.back(), m_tm), m_tm)) - p);
    return result;
  }

  // `axis`: about the normal
  Eigen::Vector3d graph_normal(const Sector& sector, bool is_open, const Eigen::Vector3d& axis) const
  {
    typedef Eigen::Matrix<double, 5, 1> Vector5;
    const double largest_slope = std::tan(largest_turn);
    const std::vector<Eigen::Vector3d> points = neighbors(sector, is_open);
    double size = 0;
    for(const Eigen::Vector3d& p : points)
      size += p.norm() / double(points.size());
    if(points.size() < 5 || !(size > 0) || axis.isZero())
      return axis;
    const Eigen::Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
    Eigen::Matrix<double, 5, 5> matrix = Eigen::Matrix<double, 5, 5>::Zero();
    Vector5 rhs = Vector5::Zero();
    for(const Eigen::Vector3d& p : points)
    {
      const double x = u.dot(p) / size, y = v.dot(p) / size, z = axis.dot(p) / size;
      const Vector5 row = (Vector5() << x, y, x * x, x * y, y * y).finished();
      const double weight = size * size / (std::max)(p.squaredNorm(), 1e-12 * size * size);
      matrix += weight * row * row.transpose();
      rhs += weight * z * row;
    }
    const Eigen::LDLT<Eigen::Matrix<double, 5, 5> > solver(matrix);
    const Vector5 graph = solver.solve(rhs);
    const double slope = graph.head<2>().norm();
    if(!(solver.rcond() > smallest_rcond) || !(slope < largest_slope))
      return axis;
    return (axis - graph[0] * u - graph[1] * v).normalized();
  }

  // below that the points lie about on a curve of degree two, and do not determine the graph
  static constexpr double smallest_rcond = 1e-6;

  const TriangleMesh& m_tm;
  const VertexPointMap& m_vpm;
  typename boost::property_map<TriangleMesh,
    CGAL::dynamic_halfedge_property_t<std::size_t> >::const_type m_sectors;
  typename boost::property_map<TriangleMesh,
    CGAL::dynamic_halfedge_property_t<bool> >::const_type m_is_end;
  std::vector<Eigen::Vector3d> m_normals; // of the sectors
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_CORNER_NORMALS_H
