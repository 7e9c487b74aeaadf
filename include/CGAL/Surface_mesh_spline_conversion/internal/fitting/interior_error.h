// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_ERROR_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_ERROR_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// the largest distance over a set of samples
struct Largest_error
{
  double error = 0;
  Eigen::Vector3d place = Eigen::Vector3d(0, 0, 0); // on the surface
};

// Finds the point of the surface closest to a point of the target, by Gauss-Newton steps in the
// local coordinates of the quads.
template <typename Surface, typename Layout, typename Place>
Eigen::Vector3d foot_point_on_surface(const Surface& surface, const Layout& layout,
                                      const Eigen::Vector3d& query, Place place)
{
  typedef decltype(place.u) FT;
  constexpr int maximum_number_of_steps = 4;
  constexpr double smallest_step = 1e-4, largest_step = 0.25; // in quads
  Eigen::Vector3d best = to_eigen(surface.position(place.patch, place.u, place.v));
  for(int step = 0; step < maximum_number_of_steps; ++step)
  {
    Eigen::Matrix<double, 3, 2> tangents;
    tangents.col(0) = to_eigen(surface.derivative(place.patch, place.u, place.v, 1, 0));
    tangents.col(1) = to_eigen(surface.derivative(place.patch, place.u, place.v, 0, 1));
    const Eigen::Matrix2d gram = tangents.transpose() * tangents;
    if(!(gram.determinant() > 0))
      break;
    Eigen::Vector2d move = gram.inverse() * (tangents.transpose() * (query - best));
    move = move.cwiseMax(-largest_step).cwiseMin(largest_step);
    const Quad_point<FT> next = cross_sides(
      layout, Quad_point<FT>{place.quad, place.u + FT(move[0]), place.v + FT(move[1])});
    const std::size_t patch = surface.patch_at(next.quad, next.u, next.v);
    const Eigen::Vector3d p = to_eigen(surface.position(patch, next.u, next.v));
    if(!((p - query).squaredNorm() < (best - query).squaredNorm()))
      break;
    best = p;
    place = Place{patch, next.quad, next.u, next.v};
    if(move.lpNorm<Eigen::Infinity>() < smallest_step)
      break;
  }
  return best;
}

// Measures the distance between surface and target at the error samples of all patches.
//
// The distance between points with equal parameters is an upper bound of the distance between a
// point and the other side. Samples are therefore visited by descending bound, and foot points
// are computed only as long as the bound exceeds the largest distance found.
template <typename Surface, typename Target>
class Interior_error
{
  typedef std::size_t size_type;
  typedef Interior_samples<Surface, Target> Samples;
  typedef typename Target::FT FT;
  typedef typename Target::Point_3 Point_3;

public:
  Interior_error(const Surface& surface, const Target& target, const Samples& samples)
    : m_surface(surface), m_target(target), m_samples(samples)
  {
    const size_type n = samples.number_of_patches() * Samples::error_samples;
    m_points.reserve(n);
    for(size_type i = 0; i < n; ++i)
    {
      const typename Samples::Place at = place(i);
      m_points.push_back(to_eigen(surface.position(at.patch, at.u, at.v)));
      m_bounds.push_back((m_points.back() - target_point(i)).norm());
    }
  }

  // returns the largest distance between points with equal parameters
  Largest_error parametric() const
  {
    const auto it = std::max_element(m_bounds.begin(), m_bounds.end());
    if(it == m_bounds.end())
      return Largest_error();
    return Largest_error{*it, m_points[static_cast<size_type>(it - m_bounds.begin())]};
  }

  // returns the larger of both one-sided distances
  Largest_error two_sided() const
  {
    std::vector<size_type> order(m_bounds.size());
    std::iota(order.begin(), order.end(), size_type(0));
    std::make_heap(order.begin(), order.end(), [this](size_type a, size_type b)
      { return comes_before(b, a); });

    Largest_error result;
    for(auto end = order.end(); end != order.begin(); --end)
    {
      if(!(m_bounds[order.front()] > result.error))
        break;
      const size_type i = order.front();
      const double distance = (std::max)(distance_to_target(i), distance_to_surface(i));
      if(distance > result.error)
        result = Largest_error{distance, m_points[i]};
      std::pop_heap(order.begin(), end, [this](size_type a, size_type b)
        { return comes_before(b, a); });
    }
    return result;
  }

private:
  typename Samples::Place place(size_type i) const
  {
    return m_samples.error_place(i / Samples::error_samples, i % Samples::error_samples);
  }

  const Eigen::Vector3d& target_point(size_type i) const
  {
    return m_samples.target(i / Samples::error_samples, i % Samples::error_samples);
  }

  bool comes_before(size_type a, size_type b) const
  {
    return m_bounds[a] != m_bounds[b] ? m_bounds[a] > m_bounds[b] : a < b;
  }

  double distance_to_target(size_type i) const
  {
    const typename Samples::Place at = place(i);
    const Eigen::Vector3d& p = m_points[i];
    const Point_3 foot
      = m_target.foot_point(Point_3(FT(p[0]), FT(p[1]), FT(p[2])), at.quad, at.u, at.v);
    return (std::min)(m_bounds[i], (to_eigen(foot) - p).norm());
  }

  double distance_to_surface(size_type i) const
  {
    const Eigen::Vector3d foot = foot_point_on_surface(m_surface, m_target.layout(),
                                                      target_point(i), place(i));
    return (foot - target_point(i)).norm();
  }

  const Surface& m_surface;
  const Target& m_target;
  const Samples& m_samples;
  std::vector<Eigen::Vector3d> m_points; // of the surface
  std::vector<double> m_bounds;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_ERROR_H
