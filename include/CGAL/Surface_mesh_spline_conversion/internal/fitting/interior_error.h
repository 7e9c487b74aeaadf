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

#include <CGAL/Surface_mesh_spline_conversion/internal/Point_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <set>
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
class Surface_foot_point
{
  typedef decltype(Place::u) FT;

public:
  Surface_foot_point(const Surface& surface, const Layout& layout, const Eigen::Vector3d& query,
                     const Place& place)
    : m_surface(surface), m_layout(layout), m_query(query), m_place(place), m_point(point(place))
  {}

  const Eigen::Vector3d& operator()()
  {
    constexpr int maximum_number_of_steps = 6;
    if(!improve(m_place) && !improve(inside(m_place)))
      return m_point;
    for(int step = 1; step < maximum_number_of_steps && improve(m_place); ++step)
      continue;
    return m_point;
  }

  // returns where the point found lies
  const Place& place() const { return m_place; }

private:
  Eigen::Vector3d point(const Place& p) const
  {
    return to_eigen(m_surface.position(p.patch, p.u, p.v));
  }

  // At an extraordinary point the parametrization has no regular derivative; a place a little
  // inside of its patch has.
  Place inside(Place p) const
  {
    constexpr double share = 1. / 16;
    const auto o = m_surface.patch_origin(p.patch);
    p.u += FT(share) * ((o.u0 + o.u1) / FT(2) - p.u);
    p.v += FT(share) * ((o.v0 + o.v1) / FT(2) - p.v);
    return p;
  }

  // a step from `start`; halved twice if it does not decrease the distance
  bool improve(const Place& start)
  {
    constexpr double largest_step = 0.25; // in quads
    const Eigen::Vector3d difference = m_query - point(start);
    Eigen::Matrix<double, 3, 2> tangents;
    tangents.col(0) = to_eigen(m_surface.derivative(start.patch, start.u, start.v, 1, 0));
    tangents.col(1) = to_eigen(m_surface.derivative(start.patch, start.u, start.v, 0, 1));
    const Eigen::Matrix2d gram = tangents.transpose() * tangents;
    if(!(gram.determinant() > 0))
      return false;
    Eigen::Vector2d step = gram.inverse() * (tangents.transpose() * difference);
    if(!step.allFinite())
      return false;
    step = step.cwiseMax(-largest_step).cwiseMin(largest_step);
    return move(start, step) || move(start, step / 2) || move(start, step / 4);
  }

  bool move(const Place& start, const Eigen::Vector2d& step)
  {
    // a step that gains less than this share of the distance is the last one
    constexpr double smallest_gain = 1e-3;
    const Quad_point<FT> q = cross_sides(
      m_layout, Quad_point<FT>{start.quad, start.u + FT(step[0]), start.v + FT(step[1])});
    const Place next{m_surface.patch_at(q.quad, q.u, q.v), q.quad, q.u, q.v};
    const Eigen::Vector3d p = point(next);
    const double before = (m_point - m_query).norm(), after = (p - m_query).norm();
    if(!(after < before))
      return false;
    m_point = p;
    m_place = next;
    return after < (1 - smallest_gain) * before;
  }

  const Surface& m_surface;
  const Layout& m_layout;
  const Eigen::Vector3d& m_query;
  Place m_place;
  Eigen::Vector3d m_point;
};

// Measures the distance between surface and target at the error samples of all patches, and from
// the vertices of the mesh to the surface: there the mesh is farthest from a smooth surface. Vertices
// in quads with a boundary side do not count, as the target differs from the mesh there.
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
  typedef typename Surface::Patch_split Patch_split;

public:
  // `is_parametric`: only the distances between points with equal parameters count
  Interior_error(const Surface& surface, const Target& target, const Samples& samples,
                 bool is_parametric)
    : m_surface(surface), m_target(target), m_samples(samples), m_is_parametric(is_parametric)
  {
    const size_type n = samples.number_of_error_samples();
    m_points.resize(n);
    m_bounds.resize(n);
    for_each_index(n, [&](size_type i)
    {
      const typename Samples::Place at = place(i);
      m_points[i] = to_eigen(surface.position(at.patch, at.u, at.v));
      m_bounds[i] = (m_points[i] - target_point(i)).norm();
    });
    if(!is_parametric)
      measure_vertices();
  }

  // returns the largest distance
  Largest_error largest() const
  {
    std::vector<size_type> order(m_bounds.size());
    std::iota(order.begin(), order.end(), size_type(0));
    std::make_heap(order.begin(), order.end(), [this](size_type a, size_type b)
      { return comes_before(b, a); });

    Largest_error result = m_largest_of_vertices;
    for(auto end = order.end(); end != order.begin(); --end)
    {
      if(!(m_bounds[order.front()] > result.error))
        break;
      const size_type i = order.front();
      const double distance = this->distance(i);
      if(distance > result.error)
        result = Largest_error{distance, m_points[i]};
      std::pop_heap(order.begin(), end, [this](size_type a, size_type b)
        { return comes_before(b, a); });
    }
    return result;
  }

  // returns the patches with a distance of at least `tolerance`, and the directions in which they
  // should be split
  std::vector<Patch_split> violations(double tolerance) const
  {
    std::vector<char> is_split(m_samples.number_of_patches());
    for_each_index(is_split.size(), [&](size_type p) { is_split[p] = is_violating(p, tolerance); });
    std::vector<size_type> patches;
    for(size_type p = 0; p < is_split.size(); ++p)
      if(is_split[p])
        patches.push_back(p);
    return splits(patches);
  }

  // returns the patches with the points of the surface closest to `points`, and the directions in
  // which they should be split
  std::vector<Patch_split> splits_at(const std::vector<Point_3>& points) const
  {
    std::set<size_type> patches;
    for(const typename Samples::Place& p : foot_places(points))
      patches.insert(p.patch);
    return splits(std::vector<size_type>(patches.begin(), patches.end()));
  }

  // returns all patches at the points of the surface closest to `points`, to be quadrisected
  std::vector<Patch_split> splits_around(const std::vector<Point_3>& points) const
  {
    constexpr double step = 1. / 128; // in quads
    std::set<size_type> patches;
    for(const typename Samples::Place& p : foot_places(points))
      for(double du : {-step, step})
        for(double dv : {-step, step})
        {
          const Quad_point<FT> q = cross_sides(m_target.layout(),
                                               Quad_point<FT>{p.quad, p.u + FT(du), p.v + FT(dv)});
          patches.insert(m_surface.patch_at(q.quad, q.u, q.v));
        }
    std::vector<Patch_split> result;
    for(size_type p : patches)
      result.push_back(Patch_split{p, true, true});
    return result;
  }

private:
  typedef Surface_foot_point<Surface, typename Target::Layout, typename Samples::Place> Foot_point;

  // The square patches of a quad of the layout are halved in the direction in which their errors vary
  // more, other patches in their longer direction, unless the error varies so much more in the other
  // one. One direction for a quad, and halving in turns, let the halves of neighbors match: where
  // directions are mixed, extensions of T-junctions cross, and the surface needs up to a half more
  // control points.
  static constexpr double directional_ratio = 5;

  static constexpr size_type none = static_cast<size_type>(-1);

  typename Samples::Place place(size_type i) const
  {
    return m_samples.error_place(i);
  }

  const Eigen::Vector3d& target_point(size_type i) const
  {
    return m_samples.target(i);
  }

  bool comes_before(size_type a, size_type b) const
  {
    return m_bounds[a] != m_bounds[b] ? m_bounds[a] > m_bounds[b] : a < b;
  }

  // Only samples whose bound violates the tolerance are measured, up to the first one that violates
  // it.
  bool is_violating(size_type patch, double tolerance) const
  {
    if(!m_is_parametric && m_vertex_errors[patch] >= tolerance)
      return true;
    const size_type end = m_samples.first_error_sample(patch + 1);
    for(size_type i = m_samples.first_error_sample(patch); i < end; ++i)
      if(m_bounds[i] >= tolerance && distance(i) >= tolerance)
        return true;
    return false;
  }

  std::vector<typename Samples::Place> foot_places(const std::vector<Point_3>& points) const
  {
    const Point_index index(m_points);
    std::vector<typename Samples::Place> result;
    for(const Point_3& point : points)
    {
      const Eigen::Vector3d p = to_eigen(point); // kept by the search
      Foot_point foot(m_surface, m_target.layout(), p, place(index.nearest(p, 1).front()));
      foot();
      result.push_back(foot.place());
    }
    return result;
  }

  // how much the error varies along `u` and `v`: the integrals of its squared derivatives
  struct Variation
  {
    double u = 0, v = 0;
  };

  bool is_square(size_type patch) const
  {
    const auto origin = m_surface.patch_origin(patch);
    return origin.u1 - origin.u0 == origin.v1 - origin.v0;
  }

  // decides in which directions `patches` are split
  std::vector<Patch_split> splits(const std::vector<size_type>& patches) const
  {
    std::vector<Variation> variations(m_target.layout().number_of_quads());
    for(size_type p : patches)
      if(is_square(p))
      {
        const Variation variation = this->variation(p);
        Variation& sum = variations[m_surface.patch_origin(p).quad];
        sum.u += variation.u;
        sum.v += variation.v;
      }
    std::vector<Patch_split> result;
    for(size_type p : patches)
    {
      const Variation& of_quad = variations[m_surface.patch_origin(p).quad];
      const bool is_along_u = is_split_along_u(p, of_quad.u >= of_quad.v);
      result.push_back(Patch_split{p, is_along_u, !is_along_u});
    }
    return result;
  }

  // `is_quad_along_u`: whether the square patches of the quad are split along `u`
  bool is_split_along_u(size_type patch, bool is_quad_along_u) const
  {
    const auto origin = m_surface.patch_origin(patch);
    const FT width = origin.u1 - origin.u0, height = origin.v1 - origin.v0;
    const Variation variation = this->variation(patch);
    const double ratio = directional_ratio * directional_ratio;
    if(variation.u > ratio * variation.v && FT(2) * width >= height)
      return true;
    if(variation.v > ratio * variation.u && FT(2) * height >= width)
      return false;
    return width == height ? is_quad_along_u : width > height;
  }

  Variation variation(size_type patch) const
  {
    const auto& grid = m_samples.grid(patch);
    const size_type row = grid.u + 1;
    Variation result;
    for(size_type k = 0; k < grid.number_of_fit_samples(); ++k)
    {
      if(k % row != 0)
        result.u += (difference(patch, k) - difference(patch, k - 1)).squaredNorm()
                    * double(grid.u) / double(grid.v + 1);
      if(k >= row)
        result.v += (difference(patch, k) - difference(patch, k - row)).squaredNorm()
                    * double(grid.v) / double(grid.u + 1);
    }
    return result;
  }

  Eigen::Vector3d difference(size_type patch, size_type k) const
  {
    return m_points[m_samples.error_sample(patch, k)] - m_samples.fit_target(patch, k);
  }

  double distance(size_type i) const
  {
    return m_is_parametric ? m_bounds[i]
                           : (std::max)(distance_to_target(i), distance_to_surface(i));
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
    return distance_to_surface(target_point(i), i);
  }

  // the search starts at sample `i`
  double distance_to_surface(const Eigen::Vector3d& query, size_type i) const
  {
    return (Foot_point(m_surface, m_target.layout(), query, place(i))() - query).norm();
  }

  void measure_vertices()
  {
    m_vertex_errors.assign(m_samples.number_of_patches(), 0);
    const std::vector<size_type> nearest = nearest_samples();
    std::vector<double> errors(nearest.size(), 0);
    for_each_index(nearest.size(), [&](size_type v)
    {
      const size_type i = nearest[v];
      if(i != none && !m_target.is_boundary_quad(place(i).quad))
        errors[v] = distance_to_surface(to_eigen(m_target.mesh_vertex(v)), i);
    });
    for(size_type v = 0; v < nearest.size(); ++v)
    {
      if(nearest[v] == none)
        continue;
      double& largest_of_patch = m_vertex_errors[place(nearest[v]).patch];
      largest_of_patch = (std::max)(largest_of_patch, errors[v]);
      if(errors[v] > m_largest_of_vertices.error)
        m_largest_of_vertices = Largest_error{errors[v], to_eigen(m_target.mesh_vertex(v))};
    }
  }

  // returns, for each vertex of the mesh, the sample nearest to it in the faces around it
  std::vector<size_type> nearest_samples() const
  {
    std::vector<size_type> result(m_target.number_of_mesh_vertices(), none);
    std::vector<double> distances(result.size(), 0);
    for(size_type i = 0; i < m_points.size(); ++i)
    {
      const size_type face = m_samples.mesh_face(i);
      if(face == m_target.number_of_mesh_faces())
        continue;
      for(size_type v : m_target.mesh_face(face))
      {
        const double d = (to_eigen(m_target.mesh_vertex(v)) - target_point(i)).squaredNorm();
        if(result[v] != none && d >= distances[v])
          continue;
        result[v] = i;
        distances[v] = d;
      }
    }
    return result;
  }

  const Surface& m_surface;
  const Target& m_target;
  const Samples& m_samples;
  bool m_is_parametric;
  std::vector<Eigen::Vector3d> m_points; // of the surface
  std::vector<double> m_bounds;
  std::vector<double> m_vertex_errors; // per patch
  Largest_error m_largest_of_vertices;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_ERROR_H
