// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_SAMPLES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_SAMPLES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The samples of a surface and of its target at one refinement level (paper, section 3.3.1): a
// uniform grid of 5x5 samples on each patch for the fit, nested in a grid of 9x9 for the error.
// In a direction in which the patch is shorter than half of an edge of the mesh there, 3 and 5 are
// enough.
//
// The surface is linear in its control points: per patch we keep the control points that act on
// it and, per fit sample, their weights.
template <typename Surface, typename Target>
class Interior_samples
{
public:
  typedef std::size_t size_type;
  typedef typename Target::FT FT;
  typedef typename Target::Point_3 Point_3;

  // a parameter of the surface
  struct Place
  {
    size_type patch, quad;
    FT u, v;
  };

  // the numbers of intervals of the grid for the fit
  struct Grid
  {
    size_type u, v;

    size_type number_of_fit_samples() const { return (u + 1) * (v + 1); }
    size_type number_of_error_samples() const { return (2 * u + 1) * (2 * v + 1); }
  };

  // `previous`: the samples of the same target before the surface was refined, or a null pointer;
  // what is known of patches that still exist is taken from there
  Interior_samples(const Surface& surface, const Target& target, const Interior_samples* previous)
    : m_surface(surface), m_target(target), m_number_of_patches(surface.number_of_patches())
    , m_local_numbers(surface.number_of_control_points(), none)
  {
    const std::vector<size_type> order = previous != nullptr ? previous->sorted_patches()
                                                             : std::vector<size_type>();
    m_first_function.push_back(0);
    m_first_value.push_back(0);
    m_first_fit_sample.push_back(0);
    m_first_error_sample.push_back(0);
    for(size_type p = 0; p < m_number_of_patches; ++p)
    {
      m_origins.push_back(surface.patch_origin(p));
      const size_type old = previous != nullptr ? previous->find(order, m_origins[p]) : none;
      m_grids.push_back(old != none ? previous->grid(old) : choose_grid(p));
      m_first_fit_sample.push_back(m_first_fit_sample[p] + m_grids[p].number_of_fit_samples());
      m_first_error_sample.push_back(m_first_error_sample[p]
                                     + m_grids[p].number_of_error_samples());
      m_patches.resize(m_first_error_sample.back(), p);
      add_stencils(p);
      if(old != none)
        copy_targets(*previous, old);
      else
        add_targets(p);
    }
    reset_fit_targets();
  }

  size_type number_of_patches() const { return m_number_of_patches; }

  const Grid& grid(size_type patch) const { return m_grids[patch]; }

  // returns the number of control points that act on a patch
  size_type number_of_functions(size_type patch) const
  {
    return m_first_function[patch + 1] - m_first_function[patch];
  }

  // returns a control point that acts on a patch
  size_type function(size_type patch, size_type i) const
  {
    return m_functions[m_first_function[patch] + i];
  }

  // returns the values of the functions of a patch at fit sample `k`
  const double* values(size_type patch, size_type k) const
  {
    return m_values.data() + m_first_value[patch] + k * number_of_functions(patch);
  }

  // the trapezoidal rule: the target is only continuous (paper, section 3.3.1)
  double weight(size_type patch, size_type k) const
  {
    const auto end_weight
      = [](size_type i, size_type n) { return i == 0 || i == n ? 0.5 : 1; };
    const Grid& g = m_grids[patch];
    const auto& o = m_origins[patch];
    const double area = CGAL::to_double((o.u1 - o.u0) * (o.v1 - o.v0));
    return area * end_weight(k % (g.u + 1), g.u) * end_weight(k / (g.u + 1), g.v)
           / double(g.u * g.v);
  }

  // Error samples are numbered through all patches.
  size_type number_of_error_samples() const { return m_targets.size(); }
  size_type first_error_sample(size_type patch) const { return m_first_error_sample[patch]; }

  Place error_place(size_type i) const
  {
    const size_type patch = m_patches[i], k = i - m_first_error_sample[patch];
    const Grid& g = m_grids[patch];
    const size_type row = 2 * g.u + 1;
    const auto& o = m_origins[patch];
    return place(patch, FT(double(k % row) / double(2 * g.u)),
                 FT(double(k / row) / double(2 * g.v)), o);
  }

  // returns the error sample at the place of fit sample `k` of a patch
  size_type error_sample(size_type patch, size_type k) const
  {
    const Grid& g = m_grids[patch];
    return m_first_error_sample[patch] + 2 * (k / (g.u + 1)) * (2 * g.u + 1)
           + 2 * (k % (g.u + 1));
  }

  // returns the point of the target at an error sample
  const Eigen::Vector3d& target(size_type i) const { return m_targets[i]; }

  // returns the face of the mesh at an error sample, see `Transfinite_patch_network_3::point()`
  size_type mesh_face(size_type i) const { return m_faces[i]; }

  // returns the point of the target that the surface shall have at a fit sample
  const Eigen::Vector3d& fit_target(size_type patch, size_type k) const
  {
    return m_fit_targets[m_first_fit_sample[patch] + k];
  }

  void set_fit_target(size_type patch, size_type k, const Eigen::Vector3d& p)
  {
    m_fit_targets[m_first_fit_sample[patch] + k] = p;
  }

  // takes the points with equal parameters as targets
  void reset_fit_targets()
  {
    m_fit_targets.clear();
    for(size_type p = 0; p < m_number_of_patches; ++p)
      for(size_type k = 0; k < m_grids[p].number_of_fit_samples(); ++k)
        m_fit_targets.push_back(target(error_sample(p, k)));
  }

private:
  typedef typename std::decay<decltype(std::declval<Surface>().patch_origin(0))>::type Origin;

  static constexpr size_type coarse_grid = 2, fine_grid = 4;
  static constexpr size_type none = static_cast<size_type>(-1);

  static Place place(size_type patch, const FT& s, const FT& t, const Origin& o)
  {
    return Place{patch, o.quad, o.u0 + s * (o.u1 - o.u0), o.v0 + t * (o.v1 - o.v0)};
  }

  static auto key(const Origin& o) { return std::tie(o.quad, o.u0, o.v0, o.u1, o.v1); }

  std::vector<size_type> sorted_patches() const
  {
    std::vector<size_type> result(m_number_of_patches);
    std::iota(result.begin(), result.end(), size_type(0));
    std::sort(result.begin(), result.end(), [this](size_type a, size_type b)
      { return key(m_origins[a]) < key(m_origins[b]); });
    return result;
  }

  size_type find(const std::vector<size_type>& sorted, const Origin& o) const
  {
    const auto it = std::lower_bound(sorted.begin(), sorted.end(), o,
      [this](size_type a, const Origin& b) { return key(m_origins[a]) < key(b); });
    return it != sorted.end() && key(m_origins[*it]) == key(o) ? *it : none;
  }

  // compares the lines in the middle of the patch with the longest edge of the face in its center
  Grid choose_grid(size_type patch) const
  {
    const Origin& o = m_origins[patch];
    const FT half(0.5);
    size_type face;
    const auto point = [&](const FT& s, const FT& t)
    {
      const Place at = place(patch, s, t, o);
      return to_eigen(m_target.point(at.quad, at.u, at.v, face));
    };
    const Eigen::Vector3d left = point(FT(0), half), right = point(FT(1), half);
    const Eigen::Vector3d lower = point(half, FT(0)), upper = point(half, FT(1));
    const Eigen::Vector3d center = point(half, half);
    if(face >= m_target.number_of_mesh_faces())
      return Grid{fine_grid, fine_grid};
    double edge = 0;
    const auto& vertices = m_target.mesh_face(face);
    for(size_type i = 0; i < 3; ++i)
      edge = (std::max)(edge, (to_eigen(m_target.mesh_vertex(vertices[i]))
                               - to_eigen(m_target.mesh_vertex(vertices[(i + 1) % 3]))).norm());
    const auto number = [edge](double length)
      { return 2 * length < edge ? coarse_grid : fine_grid; };
    return Grid{number((center - left).norm() + (right - center).norm()),
                number((center - lower).norm() + (upper - center).norm())};
  }

  void add_targets(size_type patch)
  {
    for(size_type i = first_error_sample(patch); i < first_error_sample(patch + 1); ++i)
    {
      const Place at = error_place(i);
      size_type face;
      m_targets.push_back(to_eigen(m_target.point(at.quad, at.u, at.v, face)));
      m_faces.push_back(face);
    }
  }

  void copy_targets(const Interior_samples& other, size_type patch)
  {
    const auto begin = static_cast<std::ptrdiff_t>(other.first_error_sample(patch));
    const auto end = static_cast<std::ptrdiff_t>(other.first_error_sample(patch + 1));
    m_targets.insert(m_targets.end(), other.m_targets.begin() + begin,
                     other.m_targets.begin() + end);
    m_faces.insert(m_faces.end(), other.m_faces.begin() + begin, other.m_faces.begin() + end);
  }

  void add_stencils(size_type patch)
  {
    const Grid& g = m_grids[patch];
    const size_type samples = g.number_of_fit_samples();
    const size_type first = m_functions.size();
    m_stencils.resize((std::max)(m_stencils.size(), samples));
    for(size_type k = 0; k < samples; ++k)
    {
      const Place at = place(patch, FT(double(k % (g.u + 1)) / double(g.u)),
                             FT(double(k / (g.u + 1)) / double(g.v)), m_origins[patch]);
      m_stencils[k].clear();
      m_surface.basis(patch, at.u, at.v, 0, m_stencils[k]);
      for(const auto& b : m_stencils[k])
        if(m_local_numbers[b.control_point] == none)
        {
          m_local_numbers[b.control_point] = m_functions.size() - first;
          m_functions.push_back(b.control_point);
        }
    }
    m_first_function.push_back(m_functions.size());

    const size_type n = m_functions.size() - first, first_value = m_values.size();
    m_values.resize(first_value + n * samples, 0);
    m_first_value.push_back(m_values.size());
    for(size_type k = 0; k < samples; ++k)
      for(const auto& b : m_stencils[k])
        m_values[first_value + k * n + m_local_numbers[b.control_point]] += b.value[0];
    for(size_type i = first; i < m_functions.size(); ++i)
      m_local_numbers[m_functions[i]] = none;
  }

  const Surface& m_surface;
  const Target& m_target;
  size_type m_number_of_patches;
  std::vector<Origin> m_origins;
  std::vector<Grid> m_grids;
  std::vector<size_type> m_first_function, m_functions;
  std::vector<size_type> m_first_value, m_first_fit_sample, m_first_error_sample; // of a patch
  std::vector<double> m_values;
  std::vector<size_type> m_patches; // of the error samples
  std::vector<Eigen::Vector3d> m_targets, m_fit_targets;
  std::vector<size_type> m_faces;
  // working space of add_stencils(): the functions at the samples, and the numbers of the control
  // points among the functions of the patch
  std::vector<std::vector<typename Surface::Basis_function> > m_stencils;
  std::vector<size_type> m_local_numbers;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_SAMPLES_H
