// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_FAIRING_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_FAIRING_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Fairness_energy.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_system.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/interior_error.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/reproject_targets.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/smooth_creases.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Makes a fitted surface fair within its tolerance. A least-squares fit follows what it can resolve
// of the facets of the mesh, most of all in the small patches that the tolerance of the boundary
// asks for; reflections show that. Here the variation of the curvature is added to the error of the
// fit, with a weight that smooths over a length of a quarter of a quad. Where the surface leaves
// the tolerance or folds, the length is halved, twice, and then the control points of the fit are
// taken back. The patches stay, and so do the control points that are fixed.
template <typename Surface, typename Target>
class Interior_fairing
{
  typedef std::size_t size_type;
  typedef typename Target::FT FT;
  typedef typename Surface::Point_3 Point_3;
  typedef Interior_samples<Surface, Target> Samples;
  typedef Interior_system<Samples> System;
  typedef Interior_error<Surface, Target> Errors;

public:
  // `samples`: those of the fit; their targets of the fit are changed.
  // `errors`: those of the fit.
  // `is_fixed`: control points that do not move
  Interior_fairing(Surface& surface, const Target& target, Samples& samples, Errors& errors,
                   const std::vector<bool>& is_fixed, double tolerance)
    : m_surface(surface), m_target(target), m_samples(samples), m_is_fixed(is_fixed),
      m_tolerance(goal * tolerance), m_energy(surface, samples),
      m_patches(samples.number_of_patches()), m_strikes(samples.number_of_patches(), 0)
  {
    for(size_type i = 0; i < surface.number_of_control_points(); ++i)
      m_start.push_back(surface.control_point(i));
    std::iota(m_patches.begin(), m_patches.end(), size_type(0));
    for(size_type p : m_patches)
    {
      m_energy.set_weight(p, first_weight);
      m_area_vectors.push_back(area_vectors(p));
    }
    for(const auto& violation : errors.errors(m_tolerance))
      hold(violation.patch);
  }

  // Returns `false` if the surface had to be left as it was.
  bool operator()()
  {
    constexpr int maximum_number_of_rounds = 12;
    for(int round = 0; round < maximum_number_of_rounds; ++round)
    {
      if(!move_control_points())
        break;
      const std::vector<size_type> bad = bad_patches();
      if(bad.empty())
        return true;
      weaken(bad);
    }
    restore();
    return false;
  }

  // takes the control points of the fit back around places where someone else has found the surface
  // to be too far from the mesh, or not smooth
  void hold_at(const std::vector<Point_3>& places)
  {
    const Errors errors(m_surface, m_target, m_samples, false, nullptr);
    for(const auto& split : errors.splits_around(places))
      hold(split.patch);
  }

  // takes all control points of the fit back
  void restore()
  {
    for(size_type i = 0; i < m_is_fixed.size(); ++i)
      restore(i);
  }

private:
  // Samples see the largest distance within a few percent.
  static constexpr double goal = 0.9;

  // With the weight h^6 the energy smooths over a length of h quads.
  static constexpr double first_weight = 1. / 4096; // h = 1/4
  static constexpr double next_weight = 1. / 64;    // half of h
  static constexpr int maximum_number_of_strikes = 3;

  static constexpr double first_accuracy = 1e-6, next_accuracy = 1e-4;

  // Smaller or turned around by more than that, a patch is folded, or about to be.
  static constexpr double smallest_area_ratio = 0.2;

  void restore(size_type control_point)
  {
    m_surface.set_control_point(control_point, m_start[control_point]);
  }

  // the control points of a patch stay as they were in the fit
  void hold(size_type patch)
  {
    m_strikes[patch] = maximum_number_of_strikes;
    for(size_type i = 0; i < m_samples.number_of_functions(patch); ++i)
    {
      m_is_fixed[m_samples.function(patch, i)] = true;
      restore(m_samples.function(patch, i));
    }
  }

  bool move_control_points()
  {
    const System system(m_samples, m_is_fixed, m_patches, &m_energy);
    m_samples.reset_fit_targets();
    if(!system.is_valid() || !system.fit(m_surface, first_accuracy))
      return false;
    Target_reprojection<Surface, Target>(m_target, m_samples)(m_patches);
    if(!system.fit(m_surface, next_accuracy))
      return false;
    Crease_smoother<Surface, Target, System>(m_surface, m_target)(system);
    return true;
  }

  std::vector<size_type> bad_patches()
  {
    std::vector<bool> is_bad(m_patches.size(), false);
    for(size_type p : m_patches)
      is_bad[p] = is_folded(p);
    Errors errors(m_surface, m_target, m_samples, false, nullptr);
    for(const auto& violation : errors.errors(m_tolerance))
      is_bad[violation.patch] = true;
    std::vector<size_type> result;
    for(size_type p : m_patches)
      if(is_bad[p] && m_strikes[p] < maximum_number_of_strikes)
        result.push_back(p);
    return result;
  }

  // reduces the weights of patches, and of those that share control points with them
  void weaken(const std::vector<size_type>& patches)
  {
    std::vector<bool> is_near(m_is_fixed.size(), false);
    for(size_type p : patches)
    {
      for(size_type i = 0; i < m_samples.number_of_functions(p); ++i)
        is_near[m_samples.function(p, i)] = true;
      if(++m_strikes[p] == maximum_number_of_strikes)
        hold(p);
    }
    for(size_type p : m_patches)
      for(size_type i = 0; i < m_samples.number_of_functions(p); ++i)
        if(is_near[m_samples.function(p, i)])
        {
          m_energy.set_weight(p, next_weight * m_energy.weight(p));
          break;
        }
  }

  static constexpr std::array<double, 3> places_in_patch{{1. / 16, 1. / 2, 15. / 16}};

  typedef std::array<Eigen::Vector3d, 9> Area_vectors; // S_u x S_v

  Area_vectors area_vectors(size_type patch) const
  {
    const auto o = m_surface.patch_origin(patch);
    Area_vectors result;
    for(size_type k = 0; k < result.size(); ++k)
    {
      const FT u = o.u0 + FT(places_in_patch[k % 3]) * (o.u1 - o.u0);
      const FT v = o.v0 + FT(places_in_patch[k / 3]) * (o.v1 - o.v0);
      result[k] = to_eigen(m_surface.derivative(patch, u, v, 1, 0))
                    .cross(to_eigen(m_surface.derivative(patch, u, v, 0, 1)));
    }
    return result;
  }

  bool is_folded(size_type patch) const
  {
    const Area_vectors now = area_vectors(patch), before = m_area_vectors[patch];
    for(size_type k = 0; k < now.size(); ++k)
      if(!(now[k].dot(before[k]) >= smallest_area_ratio * before[k].squaredNorm()))
        return true;
    return false;
  }

  Surface& m_surface;
  const Target& m_target;
  Samples& m_samples;
  std::vector<bool> m_is_fixed;
  double m_tolerance;
  std::vector<Point_3> m_start; // the control points of the fit
  Fairness_energy m_energy;
  std::vector<size_type> m_patches; // all
  std::vector<int> m_strikes;       // how often a patch was bad
  std::vector<Area_vectors> m_area_vectors; // of the fit
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_FAIRING_H
