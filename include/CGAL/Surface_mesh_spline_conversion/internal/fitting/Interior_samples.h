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

#include <CGAL/Surface_mesh_spline_conversion/internal/patches/split_corners.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
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
// it and, per fit sample, their weights. Patches with an extraordinary point, which have no Bezier
// form, keep the weights at the error samples, too.
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

  static constexpr size_type none = static_cast<size_type>(-1);

  // `previous`: the samples of the same target before the surface was refined, or a null pointer;
  // what is known of patches that still exist is taken from there
  Interior_samples(const Surface& surface, const Target& target, const Interior_samples* previous)
    : m_surface(surface), m_target(target), m_number_of_patches(surface.number_of_patches())
  {
    for(size_type p = 0; p < m_number_of_patches; ++p)
      m_origins.push_back(surface.patch_origin(p));
    find_previous_patches(previous);
    m_grids.resize(m_number_of_patches);
    for_each_index(m_number_of_patches, [&](size_type p)
      { m_grids[p] = is_known(p) ? previous->grid(m_previous[p]) : choose_grid(p, previous); });
    number_samples();
    find_split_corners();
    m_factors.assign(m_number_of_patches, 1);
    m_targets.resize(m_number_of_patches);
    make_stencils(previous);
    for_each_index(m_number_of_patches, [&](size_type p)
    {
      if(is_known(p))
        copy_targets(p, *previous);
      else
        make_targets(p, previous);
    });
  }

  size_type number_of_patches() const { return m_number_of_patches; }

  // is a patch at a corner of the boundary between two quads?
  bool is_at_split_corner(size_type patch) const { return m_is_at_split_corner[patch]; }

  const Grid& grid(size_type patch) const { return m_grids[patch]; }

  // returns the number of a patch among the previous samples, or `none`
  size_type previous_patch(size_type patch) const { return m_previous[patch]; }

  // returns `true` if the functions on a patch are those of the previous samples
  bool has_previous_functions(size_type patch) const { return m_has_previous_functions[patch]; }

  // returns the number of control points that act on a patch
  size_type number_of_functions(size_type patch) const
  {
    return m_stencils[patch]->functions.size();
  }

  // returns a control point that acts on a patch
  size_type function(size_type patch, size_type i) const
  {
    return m_stencils[patch]->functions[i];
  }

  // returns the number of a control point among those that act on a patch, or their number if it is
  // none of them
  size_type local_index(size_type patch, size_type control_point) const
  {
    const std::vector<size_type>& functions = m_stencils[patch]->functions;
    return size_type(std::find(functions.begin(), functions.end(), control_point) - functions.begin());
  }

  // returns the values of the functions of a patch at fit sample `k`
  const double* values(size_type patch, size_type k) const
  {
    return m_stencils[patch]->values.data() + k * number_of_functions(patch);
  }

  // returns the points of the surface at the fit samples of a patch
  std::vector<Eigen::Vector3d> surface_points(size_type patch) const
  {
    std::vector<Eigen::Vector3d> control_points;
    control_points.reserve(number_of_functions(patch));
    for(size_type i : m_stencils[patch]->functions)
      control_points.push_back(to_eigen(m_surface.control_point(i)));
    std::vector<Eigen::Vector3d> result(m_grids[patch].number_of_fit_samples(),
                                        Eigen::Vector3d(0, 0, 0));
    const double* value = values(patch, 0);
    for(Eigen::Vector3d& p : result)
      for(const Eigen::Vector3d& q : control_points)
        p += *value++ * q;
    return result;
  }

  // returns the values of the functions of a patch with an extraordinary point at all its error
  // samples, one row after the other
  const std::vector<double>& error_values(size_type patch) const
  {
    return m_stencils[patch]->error_values;
  }

  // multiplies the weights of a patch
  void increase_weight(size_type patch, double factor) { m_factors[patch] *= factor; }

  // the trapezoidal rule: the target is only continuous (paper, section 3.3.1)
  double weight(size_type patch, size_type k) const
  {
    const auto end_weight
      = [](size_type i, size_type n) { return i == 0 || i == n ? 0.5 : 1; };
    const Grid& g = m_grids[patch];
    const auto& o = m_origins[patch];
    const double area = CGAL::to_double((o.u1 - o.u0) * (o.v1 - o.v0));
    return m_factors[patch] * area * end_weight(k % (g.u + 1), g.u)
           * end_weight(k / (g.u + 1), g.v) / double(g.u * g.v);
  }

  // Error samples are numbered through all patches.
  size_type number_of_error_samples() const { return m_patches.size(); }
  size_type first_error_sample(size_type patch) const { return m_first_error_sample[patch]; }

  Place error_place(size_type i) const
  {
    const size_type patch = m_patches[i], k = i - m_first_error_sample[patch];
    const size_type row = 2 * m_grids[patch].u + 1;
    return error_place(patch, k % row, k / row);
  }

  // returns the error sample at the place of fit sample `k` of a patch
  size_type error_sample(size_type patch, size_type k) const
  {
    const Grid& g = m_grids[patch];
    return m_first_error_sample[patch] + 2 * (k / (g.u + 1)) * (2 * g.u + 1)
           + 2 * (k % (g.u + 1));
  }

  // returns the point of the target at an error sample
  const Eigen::Vector3d& target(size_type i) const
  {
    const size_type patch = m_patches[i];
    return m_targets[patch]->points[i - m_first_error_sample[patch]];
  }

  // returns the face of the mesh at an error sample, see `Transfinite_patch_network_3::point()`
  size_type mesh_face(size_type i) const
  {
    const size_type patch = m_patches[i];
    return m_targets[patch]->faces[i - m_first_error_sample[patch]];
  }

  // returns the point of the target that the surface shall have at a fit sample
  const Eigen::Vector3d& fit_target(size_type patch, size_type k) const
  {
    return m_fit_targets[m_first_fit_sample[patch] + k];
  }

  void set_fit_target(size_type patch, size_type k, const Eigen::Vector3d& p)
  {
    m_fit_targets[m_first_fit_sample[patch] + k] = p;
  }

  // the face of the mesh that the point of the target closest to the surface at a fit sample was
  // last found on: where to search for it again
  size_type near_face(size_type patch, size_type k) const
  {
    return m_near_faces[m_first_fit_sample[patch] + k];
  }

  void set_near_face(size_type patch, size_type k, size_type face)
  {
    m_near_faces[m_first_fit_sample[patch] + k] = std::uint32_t(face);
  }

  // returns the face of the fit sample before an error sample
  size_type near_face(size_type i) const
  {
    const size_type patch = m_patches[i], k = i - m_first_error_sample[patch];
    const Grid& g = m_grids[patch];
    const size_type row = 2 * g.u + 1;
    return near_face(patch, k / row / 2 * (g.u + 1) + k % row / 2);
  }

  // takes the points with equal parameters as targets of the fit
  void reset_fit_targets()
  {
    for_each_index(m_number_of_patches, [this](size_type p) { reset_fit_targets(p); });
  }

private:
  typedef typename std::decay<decltype(std::declval<Surface>().patch_origin(0))>::type Origin;

  typedef std::vector<typename Surface::Basis_function> Stencil; // the functions at a sample

  // the control points that act on a patch, and their weights at the fit and the error samples
  struct Patch_stencils
  {
    std::vector<size_type> functions;
    std::vector<double> values, error_values;
  };

  // the points of the target at the error samples of a patch, and the faces of the mesh there
  struct Patch_targets
  {
    std::vector<Eigen::Vector3d> points;
    std::vector<std::uint32_t> faces;
  };

  static constexpr size_type coarse_grid = 2, fine_grid = 4;

  static Place place(size_type patch, const FT& s, const FT& t, const Origin& o)
  {
    return Place{patch, o.quad, o.u0 + s * (o.u1 - o.u0), o.v0 + t * (o.v1 - o.v0)};
  }

  // the place with the position (i, j) in the grid of error samples
  Place error_place(size_type patch, size_type i, size_type j) const
  {
    const Grid& g = m_grids[patch];
    return place(patch, FT(double(i) / double(2 * g.u)), FT(double(j) / double(2 * g.v)),
                 m_origins[patch]);
  }

  // The patches of a quad do not overlap: no two have the same first corner.
  static auto key(const Origin& o) { return std::tie(o.quad, o.u0, o.v0); }

  std::vector<size_type> sorted_patches() const
  {
    std::vector<size_type> result(m_number_of_patches);
    std::iota(result.begin(), result.end(), size_type(0));
    std::sort(result.begin(), result.end(), [this](size_type a, size_type b)
      { return key(m_origins[a]) < key(m_origins[b]); });
    return result;
  }

  static bool contains(const Origin& a, const Origin& b)
  {
    return a.u0 <= b.u0 && b.u1 <= a.u1 && a.v0 <= b.v0 && b.v1 <= a.v1;
  }

  // returns the patch that contains a rectangle of a quad, or `none`
  size_type find(const std::vector<size_type>& sorted, const Origin& o) const
  {
    auto it = std::upper_bound(sorted.begin(), sorted.end(), o,
      [this](const Origin& a, size_type b) { return key(a) < key(m_origins[b]); });
    while(it != sorted.begin() && m_origins[*--it].quad == o.quad)
      if(contains(m_origins[*it], o))
        return *it;
    return none;
  }

  bool is_known(size_type patch) const { return m_previous[patch] != none; }

  void find_previous_patches(const Interior_samples* previous)
  {
    m_previous.assign(m_number_of_patches, none);
    m_parents.assign(m_number_of_patches, none);
    if(previous == nullptr)
      return;
    const std::vector<size_type> order = previous->sorted_patches();
    for(size_type p = 0; p < m_number_of_patches; ++p)
    {
      m_parents[p] = previous->find(order, m_origins[p]);
      if(m_parents[p] != none && contains(m_origins[p], previous->m_origins[m_parents[p]]))
        m_previous[p] = m_parents[p];
    }
  }

  void find_split_corners()
  {
    m_is_at_split_corner.assign(m_number_of_patches, false);
    for_each_split_corner(m_target.layout(), [this](size_type first, int i, size_type second, int j)
    {
      const auto end = from_side<FT>(i, FT(1), FT(0)), begin = from_side<FT>(j, FT(0), FT(0));
      m_is_at_split_corner[m_surface.patch_at(first, end[0], end[1])] = true;
      m_is_at_split_corner[m_surface.patch_at(second, begin[0], begin[1])] = true;
    });
  }

  void number_samples()
  {
    m_first_fit_sample.push_back(0);
    m_first_error_sample.push_back(0);
    for(size_type p = 0; p < m_number_of_patches; ++p)
    {
      m_first_fit_sample.push_back(m_first_fit_sample[p] + m_grids[p].number_of_fit_samples());
      m_first_error_sample.push_back(m_first_error_sample[p]
                                     + m_grids[p].number_of_error_samples());
    }
    m_patches.reserve(m_first_error_sample.back());
    for(size_type p = 0; p < m_number_of_patches; ++p)
      m_patches.resize(m_first_error_sample[p + 1], std::uint32_t(p));
    m_fit_targets.resize(m_first_fit_sample.back());
    m_near_faces.resize(m_first_fit_sample.back());
  }

  // compares the lines in the middle of the patch with the longest edge of the face in its center
  Grid choose_grid(size_type patch, const Interior_samples* previous) const
  {
    const Origin& o = m_origins[patch];
    const FT half(0.5);
    size_type face;
    const auto point = [&](const FT& s, const FT& t)
    { return target_point(place(patch, s, t, o), previous, face); };
    const Eigen::Vector3d left = point(FT(0), half), right = point(FT(1), half);
    const Eigen::Vector3d lower = point(half, FT(0)), upper = point(half, FT(1));
    const Eigen::Vector3d center = point(half, half);
    if(face >= m_target.number_of_mesh_faces())
      return Grid{fine_grid, fine_grid};
    double edge = 0;
    const auto points = m_target.points_of_mesh_face(face); // its vertices first
    for(size_type i = 0; i < 3; ++i)
      edge = (std::max)(edge, (to_eigen(m_target.mesh_point(points[i]))
                               - to_eigen(m_target.mesh_point(points[(i + 1) % 3]))).norm());
    const auto number = [edge](double length)
      { return 2 * length < edge ? coarse_grid : fine_grid; };
    return Grid{number((center - left).norm() + (right - center).norm()),
                number((center - lower).norm() + (upper - center).norm())};
  }

  // Returns the point of the target at a place, and the face of the mesh there. If a patch was
  // halved, most samples of its parts are samples of it; if it was quadrisected, nearly a third.
  Eigen::Vector3d target_point(const Place& at, const Interior_samples* previous,
                               size_type& face) const
  {
    const size_type patch = m_parents[at.patch];
    const size_type i = patch == none ? none : previous->error_sample_at(patch, at.u, at.v);
    if(i == none)
      return to_eigen(m_target.point(at.quad, at.u, at.v, face));
    face = previous->mesh_face(i);
    return previous->target(i);
  }

  // returns the error sample of a patch at the parameters, or `none`
  size_type error_sample_at(size_type patch, const FT& u, const FT& v) const
  {
    const Grid& g = m_grids[patch];
    const Origin& o = m_origins[patch];
    const double x = double(2 * g.u) * CGAL::to_double((u - o.u0) / (o.u1 - o.u0));
    const double y = double(2 * g.v) * CGAL::to_double((v - o.v0) / (o.v1 - o.v0));
    const size_type i = size_type(x), j = size_type(y);
    return double(i) == x && double(j) == y ? m_first_error_sample[patch] + j * (2 * g.u + 1) + i
                                            : none;
  }

  void make_targets(size_type patch, const Interior_samples* previous)
  {
    const Grid& g = m_grids[patch];
    const auto targets = std::make_shared<Patch_targets>();
    targets->points.reserve(g.number_of_error_samples());
    targets->faces.reserve(g.number_of_error_samples());
    for(size_type j = 0; j <= 2 * g.v; ++j)
      for(size_type i = 0; i <= 2 * g.u; ++i)
      {
        size_type face;
        targets->points.push_back(target_point(error_place(patch, i, j), previous, face));
        targets->faces.push_back(std::uint32_t(face));
      }
    m_targets[patch] = targets;
    reset_fit_targets(patch);
    for(size_type k = 0; k < m_grids[patch].number_of_fit_samples(); ++k)
      set_near_face(patch, k, mesh_face(error_sample(patch, k)));
  }

  void copy_targets(size_type patch, const Interior_samples& other)
  {
    const size_type old = m_previous[patch];
    m_targets[patch] = other.m_targets[old];
    for(size_type k = 0; k < m_grids[patch].number_of_fit_samples(); ++k)
    {
      set_fit_target(patch, k, other.fit_target(old, k));
      set_near_face(patch, k, other.near_face(old, k));
    }
  }

  void reset_fit_targets(size_type patch)
  {
    for(size_type k = 0; k < m_grids[patch].number_of_fit_samples(); ++k)
      set_fit_target(patch, k, target(error_sample(patch, k)));
  }

  void make_stencils(const Interior_samples* previous)
  {
    m_stencils.resize(m_number_of_patches);
    m_stamps.resize(m_number_of_patches);
    m_has_previous_functions.resize(m_number_of_patches);
    for_each_index(m_number_of_patches, [&](size_type p)
    {
      m_stamps[p] = m_surface.basis_stamp(p);
      m_has_previous_functions[p]
        = is_known(p) && previous->m_stamps[m_previous[p]] == m_stamps[p];
      m_stencils[p] = m_has_previous_functions[p]
                        ? previous->m_stencils[m_previous[p]]
                        : std::make_shared<const Patch_stencils>(patch_stencils(p));
    });
  }

  Patch_stencils patch_stencils(size_type patch) const
  {
    const Grid& g = m_grids[patch];
    Patch_stencils result;
    if(!m_surface.is_extraordinary_patch(patch))
    {
      m_surface.basis_on_grid(patch, g.u, g.v, result.functions, result.values);
      return result;
    }
    result.error_values = grid_values(patch, 2 * g.u, 2 * g.v, result.functions);
    const std::ptrdiff_t n = std::ptrdiff_t(result.functions.size());
    result.values.reserve(size_type(n) * g.number_of_fit_samples());
    for(size_type k = 0; k < g.number_of_fit_samples(); ++k)
    {
      const auto first = result.error_values.begin()
                         + n * std::ptrdiff_t(error_sample(patch, k) - m_first_error_sample[patch]);
      result.values.insert(result.values.end(), first, first + n);
    }
    return result;
  }

  // Returns the values of the functions of a patch on a uniform grid, see
  // `Surface::basis_on_grid()`.
  std::vector<double> grid_values(size_type patch, size_type nu, size_type nv,
                                  std::vector<size_type>& functions) const
  {
    constexpr size_type usual_number = 16; // of functions
    const size_type samples = (nu + 1) * (nv + 1);
    Stencil stencil, stencils; // of a sample, and of all
    std::vector<size_type> ends;
    stencils.reserve(usual_number * samples);
    for(size_type k = 0; k < samples; ++k)
    {
      const Place at = place(patch, FT(double(k % (nu + 1)) / double(nu)),
                             FT(double(k / (nu + 1)) / double(nv)), m_origins[patch]);
      m_surface.basis(patch, at.u, at.v, 0, stencil);
      number_functions(stencil, functions);
      stencils.insert(stencils.end(), stencil.begin(), stencil.end());
      ends.push_back(stencils.size());
    }
    std::vector<double> result(functions.size() * samples, 0);
    for(size_type k = 0, i = 0; k < samples; ++k)
      for(; i < ends[k]; ++i)
        result[k * functions.size() + stencils[i].control_point] += stencils[i].value[0];
    return result;
  }

  // replaces control points by their numbers among the functions of the patch; neighboring samples
  // have the same functions in the same order
  static void number_functions(Stencil& stencil, std::vector<size_type>& functions)
  {
    for(size_type i = 0; i < stencil.size(); ++i)
    {
      size_type& point = stencil[i].control_point;
      size_type number = i;
      if(i >= functions.size() || functions[i] != point)
        number = size_type(std::find(functions.begin(), functions.end(), point)
                           - functions.begin());
      if(number == functions.size())
        functions.push_back(point);
      point = number;
    }
  }

  const Surface& m_surface;
  const Target& m_target;
  size_type m_number_of_patches;
  std::vector<Origin> m_origins;
  std::vector<size_type> m_previous; // patches
  std::vector<size_type> m_parents;  // previous patches that contain the patches, or `none`
  std::vector<char> m_has_previous_functions;
  std::vector<bool> m_is_at_split_corner; // patches
  std::vector<Grid> m_grids;
  std::vector<double> m_factors; // of the weights of the patches
  std::vector<size_type> m_stamps; // of the functions of the patches
  std::vector<std::shared_ptr<const Patch_stencils> > m_stencils;
  std::vector<size_type> m_first_fit_sample, m_first_error_sample; // of a patch
  std::vector<std::uint32_t> m_patches; // of the error samples
  std::vector<std::shared_ptr<const Patch_targets> > m_targets; // of the patches
  std::vector<Eigen::Vector3d> m_fit_targets;
  std::vector<std::uint32_t> m_near_faces; // see near_face()
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_SAMPLES_H
