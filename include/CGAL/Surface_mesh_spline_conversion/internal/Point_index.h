// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_POINT_INDEX_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_POINT_INDEX_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <boost/iterator/counting_iterator.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// nearest neighbours among a fixed set of points
class Point_index
{
  typedef CGAL::Simple_cartesian<double> Kernel;
  typedef CGAL::Pointer_property_map<Kernel::Point_3>::const_type Point_map;
  typedef CGAL::Search_traits_3<Kernel> Base_traits;
  typedef CGAL::Search_traits_adapter<std::size_t, Point_map, Base_traits> Traits;
  typedef CGAL::Orthogonal_k_neighbor_search<Traits> Search;

public:
  typedef Kernel::Point_3 Point_3;

  explicit Point_index(const std::vector<Eigen::Vector3d>& points)
    : Point_index(converted(points))
  {}

  explicit Point_index(std::vector<Point_3> points)
    : m_points(std::move(points)),
      m_tree(boost::counting_iterator<std::size_t>(0),
             boost::counting_iterator<std::size_t>(m_points.size()), typename Search::Splitter(),
             Traits(point_map()))
  {
    if(!m_points.empty())
      m_tree.build();
  }

  Point_index(const Point_index&) = delete;
  Point_index& operator=(const Point_index&) = delete;

  bool empty() const { return m_points.empty(); }

  /// the indices of the `k` points nearest to `p`, by distance
  std::vector<std::size_t> nearest(const Eigen::Vector3d& p, unsigned int k) const
  {
    if(m_points.empty())
      return std::vector<std::size_t>();
    const typename Search::Distance distance(point_map());
    const Search search(m_tree, Point_3(p.x(), p.y(), p.z()), k, 0, true, distance);
    std::vector<std::pair<double, std::size_t> > order;
    for(const auto& neighbor : search)
      order.emplace_back(neighbor.second, neighbor.first);
    std::sort(order.begin(), order.end()); // also among equal distances
    std::vector<std::size_t> result;
    for(const auto& entry : order)
      result.push_back(entry.second);
    return result;
  }

private:
  Point_map point_map() const { return CGAL::make_property_map(m_points); }

  static std::vector<Point_3> converted(const std::vector<Eigen::Vector3d>& points)
  {
    std::vector<Point_3> result;
    result.reserve(points.size());
    for(const Eigen::Vector3d& p : points)
      result.emplace_back(p.x(), p.y(), p.z());
    return result;
  }

  std::vector<Point_3> m_points;
  typename Search::Tree m_tree;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_POINT_INDEX_H
