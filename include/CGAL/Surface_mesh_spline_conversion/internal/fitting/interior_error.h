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

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Bezier_patches.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Nearest_sample.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Split_directions.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Surface_foot_point.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Mesh_point_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>
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

// Measures the distance between surface and target at the error samples of all patches, and to the
// surface from the points of the mesh where it is farthest from a smooth one: its vertices, and the
// middles of its edges, above which the distance has ridges between the samples. These points do not
// count along the boundary where the target differs from the mesh.
//
// The distance between points with equal parameters is an upper bound of the distance between a
// point and the other side; so is the distance before control points have moved, plus the largest
// of their moves. Foot points are computed only where the bound reaches the tolerance, or by
// descending bound as long as it exceeds the largest distance found.
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
  // `previous`: the error on the previous samples, or a null pointer; it bounds the error where the
  // functions of the surface have not changed
  Interior_error(const Surface& surface, const Target& target, const Samples& samples,
                 bool is_parametric, const Interior_error* previous)
    : m_surface(surface), m_target(target), m_samples(samples), m_is_parametric(is_parametric),
      m_patches(surface)
  {
    for(size_type i = 0; i < surface.number_of_control_points(); ++i)
      m_control_points.push_back(to_eigen(surface.control_point(i)));
    m_moves.assign(samples.number_of_patches(), unbounded);
    if(previous != nullptr)
      find_moves([&](size_type p) { return samples.has_previous_functions(p)
                                             ? move(p, previous->m_control_points) : unbounded; });
    const size_type n = samples.number_of_error_samples();
    m_distances.reserve(n + number_of_mesh_points());
    m_is_bound.reserve(n + number_of_mesh_points());
    m_distances.resize(n, unbounded);
    m_is_bound.resize(n, true);
    m_upper_bounds.assign(samples.number_of_patches(), unbounded);
    m_is_kept.assign(samples.number_of_patches(), false);
    for_each_index(samples.number_of_patches(), [&](size_type p)
    {
      if(m_moves[p] != unbounded)
        copy_distances(p, *previous);
      if(m_moves[p] == 0)
        m_patches.copy(p, previous->m_patches, samples.previous_patch(p));
      else
        make_bounds(p);
    });
    if(!is_parametric)
      add_mesh_points(previous);
  }

  // Adapts the bounds since control points have moved. What was known before is kept until the
  // update is accepted or taken back.
  void update()
  {
    std::vector<Eigen::Vector3d> before(m_control_points.size());
    before.swap(m_control_points);
    for(size_type i = 0; i < before.size(); ++i)
      m_control_points[i] = to_eigen(m_surface.control_point(i));
    find_moves([&](size_type p) { return move(p, before); });
    for(size_type p = 0; p < m_moves.size(); ++p)
      if(m_moves[p] != 0 && !m_is_kept[p])
      {
        m_is_kept[p] = true;
        keep(p);
      }
    for_each_index(m_moves.size(), [&](size_type p)
    {
      if(m_moves[p] == 0)
        return;
      make_bounds(p);
      for(size_type i = first_mesh_point(p); i < first_mesh_point(p + 1); ++i)
        increase_bound(m_mesh_points[i], p);
    });
  }

  // makes the updates since the last call final
  void accept()
  {
    for(size_type p : m_kept.patches)
      m_is_kept[p] = false;
    m_kept.patches.clear();
    m_kept.elements.clear();
    m_kept.distances.clear();
  }

  // takes back the updates that have not been accepted
  // \pre the control points are those of the last accepted update again
  void take_back()
  {
    for(size_type i = 0; i < m_control_points.size(); ++i)
      m_control_points[i] = to_eigen(m_surface.control_point(i));
    auto elements = m_kept.elements.begin();
    auto distance = m_kept.distances.begin();
    for(size_type p : m_kept.patches)
    {
      m_patches.set_elements(p, *elements++);
      for_each_place(p, [&](size_type i) { std::tie(m_distances[i], m_is_bound[i]) = *distance++; });
      m_upper_bounds[p] = unbounded;
    }
    accept();
  }

  // returns the largest distance
  Largest_error largest()
  {
    constexpr size_type batch_size = 64; // measured at once
    std::vector<size_type> order = possibly_largest();
    const auto is_smaller = [this](size_type a, size_type b) { return comes_before(b, a); };
    std::make_heap(order.begin(), order.end(), is_smaller);

    Largest_error result;
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
          result = Largest_error{m_distances[i], measured_point(i)};
    }
    return result;
  }

  // returns the patches with a distance of at least `tolerance`, and the directions in which they
  // should be split
  std::vector<Patch_split> violations(double tolerance)
  {
    std::vector<size_type> patches;
    for(const Patch_error& e : errors(tolerance, tolerance))
      patches.push_back(e.patch);
    return splits(patches);
  }

  // the largest distance on a patch
  struct Patch_error
  {
    size_type patch;
    double error;
  };

  // returns the patches with a distance of at least `tolerance`. Larger ones than `enough` are
  // sought no further.
  std::vector<Patch_error> errors(double tolerance, double enough = unbounded)
  {
    std::vector<double> largest(m_samples.number_of_patches());
    for_each_index(largest.size(), [&](size_type p) { largest[p] = error(p, tolerance, enough); });
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
    return splits(patches_at(points));
  }

  // returns the patches with the points of the surface closest to `points`
  std::vector<size_type> patches_at(const std::vector<Point_3>& points) const
  {
    std::set<size_type> patches;
    for(const typename Samples::Place& p : foot_places(points))
      patches.insert(p.patch);
    return std::vector<size_type>(patches.begin(), patches.end());
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

  static constexpr double unbounded = (std::numeric_limits<double>::max)(); // a distance

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

  // returns all whose bound or distance reaches the largest measured distance
  std::vector<size_type> possibly_largest() const
  {
    double measured = 0;
    for(size_type i = 0; i < m_distances.size(); ++i)
      if(!m_is_bound[i])
        measured = (std::max)(measured, m_distances[i]);
    std::vector<size_type> result;
    for(size_type i = 0; i < m_distances.size(); ++i)
      if(m_distances[i] >= measured)
        result.push_back(i);
    return result;
  }

  // Returns the largest distance on a patch, or zero if it is below the tolerance. Begins with the
  // largest bound, so that few others exceed what has been found.
  double error(size_type patch, double tolerance, double enough)
  {
    if(m_upper_bounds[patch] <= tolerance)
      return 0;
    double result = 0;
    const auto measure = [&](size_type i)
    {
      if(m_distances[i] >= (std::max)(tolerance, result) && result < enough)
        result = (std::max)(result, distance(i));
    };
    const size_type first = m_samples.first_error_sample(patch);
    const size_type end = m_samples.first_error_sample(patch + 1);
    const auto position = [this](size_type i) { return m_distances.begin() + std::ptrdiff_t(i); };
    measure(size_type(std::max_element(position(first), position(end)) - m_distances.begin()));
    for_each_place(patch, measure);
    if(result >= tolerance)
      return result;
    m_upper_bounds[patch] = tolerance;
    return 0;
  }

  std::vector<typename Samples::Place> foot_places(const std::vector<Point_3>& points) const
  {
    std::vector<typename Samples::Place> result;
    if(points.empty())
      return result;
    std::vector<Eigen::Vector3d> of_surface;
    for(size_type i = 0; i < m_samples.number_of_error_samples(); ++i)
      of_surface.push_back(surface_point(i));
    const Nearest_sample<Samples> nearest(m_samples, of_surface);
    for(const Point_3& point : points)
    {
      const Eigen::Vector3d p = to_eigen(point); // kept by the search
      Foot_point foot(m_patches, m_target.layout(), p, place(nearest(p)));
      foot();
      result.push_back(foot.place());
    }
    return result;
  }

  // Samples are followed by the points of the mesh.
  bool is_mesh_point(size_type i) const { return i >= m_samples.number_of_error_samples(); }

  Eigen::Vector3d mesh_point(size_type i) const
  {
    return to_eigen(m_target.mesh_point(i - m_samples.number_of_error_samples()));
  }

  size_type number_of_mesh_points() const
  {
    return m_is_parametric ? 0 : m_target.number_of_mesh_points();
  }

  Eigen::Vector3d measured_point(size_type i) const
  {
    return is_mesh_point(i) ? mesh_point(i) : surface_point(i);
  }

  // returns the point of the surface at a sample
  Eigen::Vector3d surface_point(size_type i) const
  {
    const typename Samples::Place at = place(i);
    return m_surface.is_extraordinary_patch(at.patch)
             ? combined_control_points(at.patch, i - m_samples.first_error_sample(at.patch))
             : m_patches.point(at.patch, at.u, at.v);
  }

  // what was known of patches before control points moved, one patch after the other
  struct Kept_patches
  {
    std::vector<size_type> patches;
    std::vector<typename Bezier_patches<Surface>::Elements> elements;
    std::vector<std::pair<double, char> > distances; // of samples and points of the mesh; are they bounds?
  };

  void keep(size_type patch)
  {
    m_kept.patches.push_back(patch);
    m_kept.elements.push_back(m_patches.elements(patch));
    for_each_place(patch, [&](size_type i)
      { m_kept.distances.emplace_back(m_distances[i], m_is_bound[i]); });
  }

  // visits the samples and the points of the mesh of a patch
  template <typename Visitor>
  void for_each_place(size_type patch, const Visitor& visit) const
  {
    for(size_type i = m_samples.first_error_sample(patch);
        i < m_samples.first_error_sample(patch + 1); ++i)
      visit(i);
    for(size_type i = first_mesh_point(patch); i < first_mesh_point(patch + 1); ++i)
      visit(m_mesh_points[i]);
  }

  // measures the distance at a sample or a point of the mesh, unless it is known
  double distance(size_type i)
  {
    if(m_is_bound[i])
    {
      m_distances[i] = is_mesh_point(i)
        ? distance_to_surface(mesh_point(i), m_nearest[i - m_samples.number_of_error_samples()])
        : (std::max)(distance_to_target(i), distance_to_surface(target_point(i), i));
      m_is_bound[i] = false;
    }
    return m_distances[i];
  }

  double distance_to_target(size_type i) const
  {
    const typename Samples::Place at = place(i);
    const Eigen::Vector3d point = surface_point(i);
    const Point_3 p = to_point(point), start = to_point(target_point(i));
    size_type near_face = m_samples.near_face(i);
    const Point_3 foot
      = m_target.foot_point(p, at.quad, at.u, at.v, start, m_samples.mesh_face(i), near_face);
    return (std::min)(m_distances[i], (to_eigen(foot) - point).norm());
  }

  std::vector<Patch_split> splits(const std::vector<size_type>& patches) const
  {
    return Split_directions<Surface, Target>(m_surface, m_target, m_samples)(patches);
  }

  static Point_3 to_point(const Eigen::Vector3d& p)
  {
    return Point_3(FT(p[0]), FT(p[1]), FT(p[2]));
  }

  // the search starts at sample `i`
  double distance_to_surface(const Eigen::Vector3d& query, size_type i) const
  {
    return (Foot_point(m_patches, m_target.layout(), query, place(i))() - query).norm();
  }

  void make_bounds(size_type patch)
  {
    const auto& grid = m_samples.grid(patch);
    const size_type first = m_samples.first_error_sample(patch);
    std::vector<Eigen::Vector3d> points;
    m_upper_bounds[patch] = unbounded;
    m_patches.update(patch);
    if(!m_surface.is_extraordinary_patch(patch))
      m_patches.points(patch, 2 * grid.u, 2 * grid.v, points);
    else
      for(size_type k = 0; k < grid.number_of_error_samples(); ++k)
        points.push_back(combined_control_points(patch, k));
    for(size_type i = first; i < m_samples.first_error_sample(patch + 1); ++i)
    {
      const double parametric = (points[i - first] - target_point(i)).norm();
      increase_bound(i, patch);
      m_distances[i] = m_is_parametric ? parametric : (std::min)(parametric, m_distances[i]);
      m_is_bound[i] = !m_is_parametric;
    }
  }

  // returns the point of a patch with an extraordinary point at its error sample `k`
  Eigen::Vector3d combined_control_points(size_type patch, size_type k) const
  {
    const size_type n = m_samples.number_of_functions(patch);
    const double* value = m_samples.error_values(patch).data() + k * n;
    Eigen::Vector3d result(0, 0, 0);
    for(size_type i = 0; i < n; ++i)
      result += value[i] * m_control_points[m_samples.function(patch, i)];
    return result;
  }

  // adds what the patch of a sample or a point of the mesh has moved
  void increase_bound(size_type i, size_type patch)
  {
    m_distances[i] = m_moves[patch] == unbounded ? unbounded : m_distances[i] + m_moves[patch];
    m_is_bound[i] = true;
  }

  // Finds how far the points of each patch, and of its neighbours, on which closest points may lie,
  // have moved at most. `move(p)`: a bound of the moves of the points of a patch
  template <typename Move>
  void find_moves(const Move& move)
  {
    std::vector<double> near(m_control_points.size(), 0);
    for(size_type p = 0; p < m_moves.size(); ++p)
    {
      const double largest = move(p);
      for(size_type i = 0; i < m_samples.number_of_functions(p); ++i)
        near[m_samples.function(p, i)] = (std::max)(near[m_samples.function(p, i)], largest);
    }
    for(size_type p = 0; p < m_moves.size(); ++p)
    {
      m_moves[p] = 0;
      for(size_type i = 0; i < m_samples.number_of_functions(p); ++i)
        m_moves[p] = (std::max)(m_moves[p], near[m_samples.function(p, i)]);
    }
  }

  // returns a bound of the moves of the points of a patch: the largest one of a control point that
  // acts on it, unless there are negative functions
  double move(size_type patch, const std::vector<Eigen::Vector3d>& before) const
  {
    double result = 0;
    for(size_type i = 0; i < m_samples.number_of_functions(patch); ++i)
    {
      const size_type c = m_samples.function(patch, i);
      result = (std::max)(result, (m_control_points[c] - before[c]).norm());
    }
    return m_surface.basis_bound(patch) * result;
  }

  // returns the number of a sample of a known patch among the previous ones
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
      m_distances[i] = previous.m_distances[old];
      m_is_bound[i] = previous.m_is_bound[old];
    }
  }

  // appends the points of the mesh to the samples
  void add_mesh_points(const Interior_error* previous)
  {
    const Mesh_point_samples<Samples, Target> nearest(m_samples, m_target);
    m_nearest = previous == nullptr ? nearest() : nearest(previous->m_samples, previous->m_nearest);
    const size_type n = m_samples.number_of_error_samples();
    m_distances.resize(n + m_nearest.size(), 0);
    m_is_bound.resize(n + m_nearest.size(), false);
    m_first_mesh_points.assign(m_samples.number_of_patches() + 1, 0);
    for(size_type v = 0; v < m_nearest.size(); ++v)
      if(is_measured(v))
        ++m_first_mesh_points[place(m_nearest[v]).patch + 1];
    std::partial_sum(m_first_mesh_points.begin(), m_first_mesh_points.end(), m_first_mesh_points.begin());
    m_mesh_points.resize(m_first_mesh_points.back());
    std::vector<size_type> next = m_first_mesh_points;
    for(size_type v = 0; v < m_nearest.size(); ++v)
      if(is_measured(v))
      {
        m_mesh_points[next[place(m_nearest[v]).patch]++] = n + v;
        bound_mesh_point(v, previous);
      }
  }

  bool is_measured(size_type v) const { return m_nearest[v] != Samples::none; }

  void bound_mesh_point(size_type v, const Interior_error* previous)
  {
    const size_type i = m_nearest[v], p = place(i).patch;
    const size_type k = m_samples.number_of_error_samples() + v;
    m_distances[k] = (mesh_point(k) - surface_point(i)).norm();
    m_is_bound[k] = true;
    if(m_moves[p] == unbounded || previous->m_nearest[v] != previous_sample(i, *previous))
      return;
    const size_type old = previous->m_samples.number_of_error_samples() + v;
    m_distances[k] = (std::min)(m_distances[k], previous->m_distances[old] + m_moves[p]);
    m_is_bound[k] = m_moves[p] != 0 || previous->m_is_bound[old];
  }

  // returns the position of the first point of a patch in `m_mesh_points`
  size_type first_mesh_point(size_type patch) const
  {
    return m_is_parametric ? 0 : m_first_mesh_points[patch];
  }

  const Surface& m_surface;
  const Target& m_target;
  const Samples& m_samples;
  bool m_is_parametric;
  Bezier_patches<Surface> m_patches;
  std::vector<Eigen::Vector3d> m_control_points;
  std::vector<double> m_distances; // at the samples, then of the points of the mesh
  std::vector<char> m_is_bound;    // are these upper bounds, or measured?
  std::vector<double> m_upper_bounds; // which all distances on a patch are below
  std::vector<double> m_moves;     // the largest ones in the neighbourhood of each patch
  std::vector<char> m_is_kept;     // patches
  Kept_patches m_kept;
  std::vector<size_type> m_nearest; // samples to the points of the mesh
  std::vector<size_type> m_mesh_points, m_first_mesh_points; // of the patches
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_ERROR_H
