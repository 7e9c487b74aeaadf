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
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Surface_foot_point.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>

#include <Eigen/Core>

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

// Measures the distance between surface and target at the error samples of all patches, and from
// the vertices of the mesh to the surface: there the mesh is farthest from a smooth surface.
// Vertices in quads with a boundary side do not count, as the target differs from the mesh there.
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
  // `is_parametric`: only the distances between points with equal parameters count.
  // `previous`: the error on the previous samples, or a null pointer; it is kept where neither the
  // surface nor its neighbourhood has changed
  Interior_error(const Surface& surface, const Target& target, const Samples& samples,
                 bool is_parametric, const Interior_error* previous)
    : m_surface(surface), m_target(target), m_samples(samples), m_is_parametric(is_parametric)
  {
    for(size_type i = 0; i < surface.number_of_control_points(); ++i)
      m_control_points.push_back(to_eigen(surface.control_point(i)));
    m_is_kept.assign(samples.number_of_patches(), false);
    if(previous != nullptr)
      find_kept_patches([&](size_type p) { return has_previous_points(p, *previous); });
    const size_type n = samples.number_of_error_samples();
    m_points.resize(n);
    m_distances.resize(n);
    m_is_bound.resize(n);
    for_each_index(samples.number_of_patches(), [&](size_type p)
    {
      if(m_is_kept[p])
        copy_distances(p, *previous);
      else
        make_bounds(p);
    });
    if(!is_parametric)
    {
      m_nearest = nearest_samples();
      m_errors_of_vertices.resize(m_nearest.size());
      measure_vertices([&](size_type v) { return previous_error_of_vertex(v, previous); });
    }
  }

  // measures anew what has changed since control points have moved
  void update()
  {
    std::vector<Eigen::Vector3d> before(m_control_points.size());
    before.swap(m_control_points);
    for(size_type i = 0; i < before.size(); ++i)
      m_control_points[i] = to_eigen(m_surface.control_point(i));
    find_kept_patches([&](size_type p) { return has_points(p, before); });
    for_each_index(m_is_kept.size(), [&](size_type p)
    {
      if(!m_is_kept[p])
        make_bounds(p);
    });
    if(!m_is_parametric)
      measure_vertices([this](size_type v) { return m_is_kept[place(m_nearest[v]).patch]
                                                      ? m_errors_of_vertices[v] : unknown; });
  }

  // returns the largest distance
  Largest_error largest()
  {
    constexpr size_type batch_size = 64; // measured at once
    std::vector<size_type> order(m_distances.size());
    std::iota(order.begin(), order.end(), size_type(0));
    const auto is_smaller = [this](size_type a, size_type b) { return comes_before(b, a); };
    std::make_heap(order.begin(), order.end(), is_smaller);

    Largest_error result = m_largest_of_vertices;
    while(!order.empty() && m_distances[order.front()] > result.error)
    {
      std::vector<size_type> batch;
      while(!order.empty() && batch.size() < batch_size)
      {
        std::pop_heap(order.begin(), order.end(), is_smaller);
        batch.push_back(order.back());
        order.pop_back();
      }
      for_each_index(batch.size(), [&](size_type k) { distance(batch[k]); });
      for(size_type i : batch)
        if(m_distances[i] > result.error)
          result = Largest_error{m_distances[i], m_points[i]};
    }
    return result;
  }

  // returns the patches with a distance of at least `tolerance`, and the directions in which they
  // should be split
  std::vector<Patch_split> violations(double tolerance)
  {
    std::vector<size_type> patches;
    for(const Patch_error& e : errors(tolerance))
      patches.push_back(e.patch);
    return splits(patches);
  }

  // the largest distance on a patch
  struct Patch_error
  {
    size_type patch;
    double error;
  };

  // returns the patches with a distance of at least `tolerance`
  std::vector<Patch_error> errors(double tolerance)
  {
    std::vector<double> largest(m_samples.number_of_patches());
    for_each_index(largest.size(), [&](size_type p) { largest[p] = error(p, tolerance); });
    std::vector<Patch_error> result;
    for(size_type p = 0; p < largest.size(); ++p)
      if(largest[p] >= tolerance)
        result.push_back(Patch_error{p, largest[p]});
    return result;
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

  // The square patches of a quad of the layout are halved in the direction in which their errors
  // vary more, other patches in their longer direction, unless the error varies so much more in the
  // other one. One direction for a quad, and halving in turns, let the halves of neighbors match:
  // where directions are mixed, extensions of T-junctions cross, and the surface needs up to a half
  // more control points.
  static constexpr double directional_ratio = 5;

  static constexpr size_type none = static_cast<size_type>(-1);
  static constexpr double unknown = -1; // a distance

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
    return m_distances[a] != m_distances[b] ? m_distances[a] > m_distances[b] : a < b;
  }

  // returns the largest distance on a patch, or zero if it is below the tolerance
  double error(size_type patch, double tolerance)
  {
    double result = m_is_parametric ? 0 : m_vertex_errors[patch];
    const size_type end = m_samples.first_error_sample(patch + 1);
    for(size_type i = m_samples.first_error_sample(patch); i < end; ++i)
      if(m_distances[i] >= (std::max)(tolerance, result))
        result = (std::max)(result, distance(i));
    return result < tolerance ? 0 : result;
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

  // measures the distance at a sample, unless it is known
  double distance(size_type i)
  {
    if(m_is_bound[i])
    {
      m_distances[i] = (std::max)(distance_to_target(i), distance_to_surface(i));
      m_is_bound[i] = false;
    }
    return m_distances[i];
  }

  double distance_to_target(size_type i) const
  {
    const typename Samples::Place at = place(i);
    const Point_3 p = to_point(m_points[i]), start = to_point(target_point(i));
    const Point_3 foot
      = m_target.foot_point(p, at.quad, at.u, at.v, start, m_samples.mesh_face(i));
    return (std::min)(m_distances[i], (to_eigen(foot) - m_points[i]).norm());
  }

  static Point_3 to_point(const Eigen::Vector3d& p)
  {
    return Point_3(FT(p[0]), FT(p[1]), FT(p[2]));
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

  void make_bounds(size_type patch)
  {
    const auto& grid = m_samples.grid(patch);
    const size_type first = m_samples.first_error_sample(patch);
    std::vector<Point_3> points;
    m_surface.positions(patch, 2 * grid.u, 2 * grid.v, points);
    for(size_type i = first; i < m_samples.first_error_sample(patch + 1); ++i)
    {
      m_points[i] = to_eigen(points[i - first]);
      m_distances[i] = (m_points[i] - target_point(i)).norm();
      m_is_bound[i] = !m_is_parametric;
    }
  }

  // A patch is kept if its points are where they were, and those of its neighbours, on which
  // closest points may lie.
  template <typename IsUnmoved>
  void find_kept_patches(const IsUnmoved& is_unmoved)
  {
    std::vector<bool> is_near_change(m_control_points.size(), false);
    for(size_type p = 0; p < m_is_kept.size(); ++p)
      if(!is_unmoved(p))
        for(size_type i = 0; i < m_samples.number_of_functions(p); ++i)
          is_near_change[m_samples.function(p, i)] = true;
    for(size_type p = 0; p < m_is_kept.size(); ++p)
    {
      m_is_kept[p] = true;
      for(size_type i = 0; i < m_samples.number_of_functions(p); ++i)
        if(is_near_change[m_samples.function(p, i)])
          m_is_kept[p] = false;
    }
  }

  bool has_previous_points(size_type patch, const Interior_error& previous) const
  {
    return m_samples.has_previous_functions(patch) && has_points(patch, previous.m_control_points);
  }

  // are the control points that act on a patch those of `points`?
  bool has_points(size_type patch, const std::vector<Eigen::Vector3d>& points) const
  {
    for(size_type i = 0; i < m_samples.number_of_functions(patch); ++i)
    {
      const size_type c = m_samples.function(patch, i);
      if(m_control_points[c] != points[c])
        return false;
    }
    return true;
  }

  // returns the number of a sample of a kept patch among the previous ones
  size_type previous_sample(size_type i, const Interior_error& previous) const
  {
    const size_type patch = place(i).patch;
    return previous.m_samples.first_error_sample(m_samples.previous_patch(patch)) + i
           - m_samples.first_error_sample(patch);
  }

  void copy_distances(size_type patch, const Interior_error& previous)
  {
    for(size_type i = m_samples.first_error_sample(patch);
        i < m_samples.first_error_sample(patch + 1); ++i)
    {
      const size_type old = previous_sample(i, previous);
      m_points[i] = previous.m_points[old];
      m_distances[i] = previous.m_distances[old];
      m_is_bound[i] = previous.m_is_bound[old];
    }
  }

  // returns the error of a vertex in the previous measurement, or `unknown`
  double previous_error_of_vertex(size_type v, const Interior_error* previous) const
  {
    const size_type i = m_nearest[v];
    const bool is_known = m_is_kept[place(i).patch]
                          && previous->m_nearest[v] == previous_sample(i, *previous);
    return is_known ? previous->m_errors_of_vertices[v] : unknown;
  }

  // `known_error(v)` is `unknown` or the error of a vertex that need not be measured
  template <typename KnownError>
  void measure_vertices(const KnownError& known_error)
  {
    m_largest_of_vertices = Largest_error();
    m_vertex_errors.assign(m_samples.number_of_patches(), 0);
    for_each_index(m_nearest.size(), [&](size_type v)
    {
      const size_type i = m_nearest[v];
      if(i == none || m_target.is_boundary_quad(place(i).quad))
        return;
      const double known = known_error(v);
      m_errors_of_vertices[v]
        = known < 0 ? distance_to_surface(to_eigen(m_target.mesh_vertex(v)), i) : known;
    });
    for(size_type v = 0; v < m_nearest.size(); ++v)
    {
      if(m_nearest[v] == none)
        continue;
      const double error = m_errors_of_vertices[v];
      double& largest_of_patch = m_vertex_errors[place(m_nearest[v]).patch];
      largest_of_patch = (std::max)(largest_of_patch, error);
      if(error > m_largest_of_vertices.error)
        m_largest_of_vertices = Largest_error{error, to_eigen(m_target.mesh_vertex(v))};
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
  std::vector<Eigen::Vector3d> m_control_points;
  std::vector<double> m_distances; // at the samples
  std::vector<char> m_is_bound;    // are these upper bounds, or measured?
  std::vector<char> m_is_kept;     // patches
  std::vector<size_type> m_nearest; // samples to the vertices of the mesh
  std::vector<double> m_errors_of_vertices;
  std::vector<double> m_vertex_errors; // the largest ones of the patches
  Largest_error m_largest_of_vertices;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_ERROR_H
