// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_FITTER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_FITTER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_metric.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Boundary_fitter.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_fairing.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_system.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Refitted_region.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Reweighted_fit.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/boundary_tangency.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/corner_tangents.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/format_number.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/interior_error.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/merge_pairs.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/reproject_targets.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/smooth_creases.h>

#include <CGAL/Real_timer.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The interior iteration of section 3.3 of the paper on a surface and a target, see fit_interior().
template <typename Surface, typename Target, typename Visitor>
class Interior_fitter
{
  typedef std::size_t size_type;
  typedef typename Surface::Point_3 Point_3;
  typedef Interior_samples<Surface, Target> Samples;
  typedef Interior_system<Samples> System;
  typedef Interior_error<Surface, Target> Errors;
  typedef Interior_fairing<Surface, Target> Fairing;
  typedef Crease_smoother<Surface, Target, System> Smoother;
  typedef typename Surface::Patch_split Patch_split;

public:
  Interior_fitter(Surface& surface, const Target& target, const Interior_fit_options& options,
                  const Boundary_fit_options& boundary_options,
                  const Boundary_normals<Target>& boundary_normals, Visitor& visitor,
                  Conversion_report& report)
    : m_surface(surface), m_target(target), m_options(options), m_boundary_normals(boundary_normals),
      m_visitor(visitor), m_report(report),
      m_boundary_fitter(surface, target, boundary_options, visitor, report)
  {}

  Error_code operator()()
  {
    return refine_until_met(0, (std::numeric_limits<size_type>::max)());
  }

  // Goes on after a fit that has met the tolerances: looks for a surface with fewer patches, and no
  // more control points, that meets them too. Patches are merged, and the surface is refined from
  // there, the worst patches first; so long as this helps.
  Error_code coarsen()
  {
    constexpr int maximum_number_of_rounds = 3;
    for(int round = 0; round < maximum_number_of_rounds; ++round)
    {
      State state = save();
      const Error_code code = fit_merged();
      if(code == Error_code::INTERRUPTED)
        return code;
      if(code == Error_code::OK && m_surface.number_of_control_points()
                                     <= state.surface.number_of_control_points())
        continue;
      restore(std::move(state));
      break;
    }
    return m_boundary_code;
  }

  // Goes on after a fit that has met the tolerances: fits again with larger weights where someone else
  // has found the surface to be too far from the mesh, or folded. Returns `false`, and keeps the fit,
  // if not all tolerances are met then.
  bool move_closer(const std::vector<Point_3>& places)
  {
    if(is_parametric()
       || !refit().move_closer(m_error->patches_at(places), *m_error, next_accuracy))
      return false;
    m_largest = m_error->largest();
    return true;
  }

  // Goes on after a fit that has met the tolerances: refines the surface where someone else has
  // found it to be too far from the mesh, and around places where the normals do not agree, and
  // fits again.
  Error_code improve(const std::vector<Point_3>& far, const std::vector<Point_3>& rough)
  {
    std::vector<Patch_split> splits = m_error->splits_at(far);
    const std::vector<Patch_split> around = m_error->splits_around(rough);
    splits.insert(splits.end(), around.begin(), around.end());
    if(far.empty() && !can_refine(splits))
      return m_boundary_code;
    const Error_code code = refine(splits);
    if(code != Error_code::OK)
      return code;
    ++m_iteration;
    return (*this)();
  }

  // Goes on after a fit that has met the tolerances: makes the surface fair. Each call keeps the
  // fit around places where someone else has found the fair surface to be not as good.
  Error_code make_fair(const std::vector<Point_3>& places)
  {
    if(!m_fairing)
      m_fairing.reset(new Fairing(m_surface, m_target, *m_samples, *m_error, m_is_fixed,
                                  m_options.tolerance));
    else
      m_fairing->hold_at(places);
    if(!m_visitor.go_further())
      return Error_code::INTERRUPTED;
    (*m_fairing)();
    return m_boundary_code;
  }

  // returns the largest distance between the surface and the target, which need not be the mesh
  double largest_error() const
  {
    return Errors(m_surface, m_target, *m_samples, is_parametric(), nullptr).largest().error;
  }

  // takes the fit back, as if it had not been made fair
  void restore_fit() { m_fairing->restore(); }

private:
  // what describes the surface at the end of a fit
  struct State
  {
    Surface surface;
    std::unique_ptr<Samples> samples;
    std::unique_ptr<Errors> error;
    std::vector<bool> is_fixed, is_fixed_in_refits;
    Largest_error largest;
    Error_code boundary_code;
    size_type refinements;
    int tangency_refinements;
    Conversion_report::Boundary boundary;
    Conversion_report::Interior interior;
    Conversion_report::Smoothness smoothness;
    std::string message;
  };

  // a fit, while the surface is refined
  struct Level
  {
    double error;
    size_type patches;
  };

  // Accuracy of the solutions relative to the error at the start, which is that of the surface
  // before the first fit, and the effect of a refinement or of new targets for the others. Ten
  // iterations of conjugate gradients gain about four digits.
  static constexpr double first_accuracy = 1e-9;
  static constexpr double next_accuracy = 1e-5;

  // Patches that exceed the tolerance by no more than this factor wait until there are no others.
  // Then they get larger weights before they are refined.
  static constexpr double small_excess = 1.25;

  // Refinements that go on for longer than that chase a place where the surface cannot follow.
  static constexpr size_type maximum_number_of_iterations = 48;

  Error_code fail(Error_code code, const std::string& message)
  {
    m_report.message = message;
    return code;
  }

  // The patches along the boundary are halved that many times at most where the surface is not
  // tangent to the face beyond it; each time divides the angle by sixteen.
  static constexpr int maximum_number_of_tangency_refinements = 2;

  // while the normals along the boundary are not the wanted ones
  std::vector<Patch_split> splits_for_tangency()
  {
    if(m_tangency_refinements == maximum_number_of_tangency_refinements)
      return std::vector<Patch_split>();
    ++m_tangency_refinements;
    return m_tangency_splits;
  }

  bool can_refine(const std::vector<Patch_split>& splits) const
  {
    return m_surface.number_of_patches() + 3 * splits.size() <= m_options.maximum_number_of_patches
           && m_refinements + 1 < maximum_number_of_iterations;
  }

  // Has the error hardly fallen although the surface has grown to twice its patches, and each patch
  // of some refinement stands for many now? Errors of approximation fall with the size of the
  // patches, at a crease of the target in proportion to it; those of a fold do not.
  static bool is_hopeless(const std::vector<Level>& levels)
  {
    constexpr double least_share = 0.9;
    constexpr size_type many = 32;
    const Level& last = levels.back();
    for(size_type i = 0; i + 1 < levels.size(); ++i)
    {
      const size_type added = last.patches - levels[i].patches;
      if(last.error >= least_share * levels[i].error && added >= levels[i].patches
         && added >= many * (levels[i + 1].patches - levels[i].patches))
        return true;
    }
    return false;
  }

  // Returns the error from which on patches are refined. The error of a patch falls when those beside
  // it are refined: the worst ones come first, unless the largest error does not fall.
  double least_refined_error(const std::vector<Level>& levels) const
  {
    constexpr double large_share = 2. / 3, least_fall = 0.9;
    constexpr size_type rounds = 4; // a single one may not help
    const bool is_stuck = levels.size() > rounds
      && m_largest.error > least_fall * levels[levels.size() - 1 - rounds].error;
    if(is_parametric() || !m_has_large_errors || is_stuck)
      return m_options.tolerance;
    return (std::max)(small_excess * m_options.tolerance, large_share * m_largest.error);
  }

  Error_code fail_at_worst_place()
  {
    const Eigen::Vector3d& p = m_largest.place;
    return fail(Error_code::TOLERANCE_NOT_REACHED, "the interior tolerance was not reached: the "
                "error near the point (" + format_number(p[0]) + ", " + format_number(p[1]) + ", "
                + format_number(p[2]) + ") is " + format_number(m_largest.error)
                + " and does not fall with the size of the patches; look for a fold or a step of "
                "the mesh there, or make the quads smaller");
  }

  // Fits, and refines the patches whose error is not below the tolerance, the worst first, until
  // there is none. Those with less than `share_of_worst` of the largest error wait in any case.
  // Gives up at `number_of_patches`, and where refinement does not help.
  Error_code refine_until_met(double share_of_worst, size_type number_of_patches)
  {
    std::vector<Level> levels;
    for(; m_surface.number_of_patches() < number_of_patches; ++m_iteration)
    {
      Real_timer timer;
      timer.start();
      Error_code code = fit();
      if(code != Error_code::OK)
        return code;
      record(timer.time());
      const bool is_met = m_largest.error < m_options.tolerance;
      const std::vector<Patch_split> splits = is_met ? splits_for_tangency() : m_error->violations(
        (std::max)(least_refined_error(levels), share_of_worst * m_largest.error));
      if(is_met && (splits.empty() || !can_refine(splits)))
        return m_boundary_code;
      levels.push_back(Level{m_largest.error, m_surface.number_of_patches()});
      if(!is_met && is_hopeless(levels))
        return fail_at_worst_place();
      code = refine(splits);
      if(code != Error_code::OK)
        return code;
    }
    return Error_code::TOLERANCE_NOT_REACHED;
  }

  // merges patches in pairs, and fits the surface that has the remaining ones
  Error_code fit_merged()
  {
    // the errors of patches fall with those of the worst ones beside them
    constexpr double share_of_worst = 0.8;
    const size_type number_of_patches = m_surface.number_of_patches();
    const std::vector<typename Surface::Patch_origin> patches = merge_pairs(m_surface);
    const bool has_caps = m_surface.has_caps();
    m_surface = Surface(m_target.layout());
    m_surface.set_caps(has_caps);
    m_surface.refine_to(patches);
    m_is_fitted = false;
    m_refinements = 0;
    m_tangency_refinements = 0;
    ++m_iteration;
    const Error_code code = fit_boundary();
    return code == Error_code::OK ? refine_until_met(share_of_worst, number_of_patches) : code;
  }

  State save()
  {
    return State{m_surface, std::move(m_samples), std::move(m_error), m_is_fixed,
                 m_is_fixed_in_refits, m_largest, m_boundary_code, m_refinements,
                 m_tangency_refinements, m_report.boundary, m_report.interior, m_report.smoothness,
                 m_report.message};
  }

  void restore(State&& state)
  {
    m_surface = std::move(state.surface);
    m_is_fitted = true;
    m_samples = std::move(state.samples);
    m_error = std::move(state.error);
    m_is_fixed = std::move(state.is_fixed);
    m_is_fixed_in_refits = std::move(state.is_fixed_in_refits);
    m_largest = state.largest;
    m_boundary_code = state.boundary_code;
    m_refinements = state.refinements;
    m_tangency_refinements = state.tangency_refinements;
    m_report.boundary = state.boundary;
    m_report.interior = state.interior;
    m_report.smoothness = state.smoothness;
    m_report.message = state.message;
  }

  // splits patches, and fits the boundary again, which may miss its tolerance
  Error_code refine(const std::vector<Patch_split>& splits)
  {
    if(!can_refine(splits))
      return fail(Error_code::TOLERANCE_NOT_REACHED, "the interior tolerance was not reached: "
                  "the error is " + format_number(m_largest.error) + " with "
                  + std::to_string(m_surface.number_of_patches()) + " patches; allow more "
                  "patches, or a larger interior tolerance, or make the quads smaller");
    m_surface.refine(splits);
    ++m_refinements;
    return fit_boundary();
  }

  Error_code fit_boundary()
  {
    m_boundary_code = m_boundary_fitter();
    return m_boundary_code == Error_code::TOLERANCE_NOT_REACHED ? Error_code::OK : m_boundary_code;
  }

  size_type number_of_reprojections() const
  {
    switch(m_options.error_metric)
    {
      case Error_metric::PARAMETRIC: return 0;
      case Error_metric::REPROJECTED: return 1;
      case Error_metric::HAUSDORFF: return 3;
    }
    return 0;
  }

  // A solution that only leads to other targets need not be better than that for these.
  double accuracy_of_first_solution() const
  {
    return m_is_fitted && number_of_reprojections() > 0 ? next_accuracy : first_accuracy;
  }

  // fits the surface at the present refinement level, and measures its error
  Error_code fit()
  {
    if(!m_visitor.go_further())
      return Error_code::INTERRUPTED;
    m_fairing.reset();
    const std::unique_ptr<Samples> previous = std::move(m_samples);
    const std::unique_ptr<Errors> previous_error = std::move(m_error);
    m_samples.reset(new Samples(m_surface, m_target, previous.get()));
    m_is_fixed_in_refits = boundary_control_points();
    const Error_code code = move_control_points(m_is_fixed_in_refits);
    if(code != Error_code::OK)
      return code;
    m_error.reset(new Errors(m_surface, m_target, *m_samples, is_parametric(),
                             previous_error.get()));
    m_largest = m_error->largest();
    m_has_large_errors = m_largest.error >= small_excess * m_options.tolerance;
    if(is_parametric() || m_has_large_errors)
      return Error_code::OK;
    refit()(*m_error, next_accuracy);
    m_largest = m_error->largest();
    return Error_code::OK;
  }

  // The paper refines all patches at once, and knows no weights.
  bool is_parametric() const { return m_options.error_metric == Error_metric::PARAMETRIC; }

  Reweighted_fit<Surface, Target> refit()
  {
    return Reweighted_fit<Surface, Target>(m_surface, m_target, *m_samples, m_is_fixed_in_refits,
                                           m_options.tolerance);
  }

  // `is_fixed`: the control points of the boundary, and then all that shall stay where they are
  Error_code move_control_points(std::vector<bool>& is_fixed)
  {
    Samples& samples = *m_samples;
    Corner_tangents<Surface, Target>(m_surface, m_target)(is_fixed);
    Smoother smoother(m_surface, m_target);
    if(m_boundary_normals && !fit_tangency(is_fixed))
      return fail(Error_code::SINGULAR_SYSTEM, "the second row of control points could not be "
                  "determined");
    m_is_fixed = is_fixed;
    // with normals, the second row of control points has moved along the whole boundary
    const Refitted_region<Samples> region(samples, is_fixed, smoother.patches_of_lines(),
                                          bool(m_boundary_normals));
    const System system(samples, region.is_fixed(), region.patches());
    if(!system.is_valid())
      return fail(Error_code::SINGULAR_SYSTEM, "the control points could not be determined");
    // in a part of the surface, patches that have not been split keep their targets
    if(region.is_whole())
      samples.reset_fit_targets();
    bool is_solved = system.fit(m_surface, accuracy_of_first_solution());
    for(size_type i = 0; is_solved && i < number_of_reprojections(); ++i)
    {
      if(!m_visitor.go_further())
        return Error_code::INTERRUPTED;
      Target_reprojection<Surface, Target>(m_target, samples)(region.patches());
      is_solved = system.fit(m_surface, next_accuracy);
    }
    if(!is_solved)
      return fail(Error_code::SINGULAR_SYSTEM, "the control points could not be determined");
    m_is_fitted = true;
    smoother(system);
    for(const std::vector<size_type>& group : smoother.patches_of_lines())
      for(size_type p : group)
        for(size_type i = 0; i < samples.number_of_functions(p); ++i)
          is_fixed[samples.function(p, i)] = true;
    return Error_code::OK;
  }

  // fits the second row of control points to the target, then to the normals along the boundary
  bool fit_tangency(std::vector<bool>& is_fixed)
  {
    std::vector<size_type> patches(m_samples->number_of_patches());
    std::iota(patches.begin(), patches.end(), size_type(0));
    m_samples->reset_fit_targets();
    const System system(*m_samples, is_fixed, patches);
    if(!system.is_valid() || !system.fit(m_surface, first_accuracy))
      return false;
    Boundary_tangency<Surface, Target> tangency(m_surface, m_target, m_boundary_normals);
    if(!tangency(is_fixed))
      return false;
    m_report.smoothness.max_tangency_angle_degrees = tangency.measure(m_tangency_splits);
    m_report.smoothness.tangency_conflicts = tangency.number_of_conflicts();
    return true;
  }

  // the boundary curves belong to the boundary fit (paper, section 3.3)
  std::vector<bool> boundary_control_points() const
  {
    std::vector<bool> result(m_surface.number_of_control_points(), false);
    for(size_type c = 0; c < m_surface.number_of_boundary_chains(); ++c)
      for(size_type i : m_surface.boundary_curve(c).control_points)
        result[i] = true;
    return result;
  }

  void record(double seconds)
  {
    Conversion_report::Iteration entry;
    entry.stage = "fit_interior";
    entry.iteration = m_iteration;
    entry.patches = m_surface.number_of_patches();
    entry.control_points = m_surface.number_of_control_points();
    entry.interior_linf = m_largest.error;
    entry.seconds = seconds;
    m_report.iterations.push_back(entry);
    m_report.interior.max_deviation = m_largest.error;
    for(int d = 0; d < 3; ++d)
      m_report.interior.worst[static_cast<size_type>(d)] = m_largest.place[d];
    m_visitor.on_iteration(entry);
  }

  Surface& m_surface;
  const Target& m_target;
  Interior_fit_options m_options;
  Boundary_normals<Target> m_boundary_normals;
  Visitor& m_visitor;
  Conversion_report& m_report;
  Boundary_fitter<Surface, Target, Visitor> m_boundary_fitter;
  std::unique_ptr<Samples> m_samples; // at the last refinement level
  std::unique_ptr<Errors> m_error;    // of the last fit
  std::vector<bool> m_is_fixed;       // the control points that the last fit could not move
  std::vector<bool> m_is_fixed_in_refits; // these, and those that have moved for smooth creases
  std::unique_ptr<Fairing> m_fairing; // of the last fit
  Largest_error m_largest;
  bool m_has_large_errors = false; // before patches got larger weights
  Error_code m_boundary_code = Error_code::OK; // of the last fit of the boundary
  bool m_is_fitted = false; // does the surface come from a fit, maybe refined?
  size_type m_iteration = 0;
  size_type m_refinements = 0; // of the present surface
  std::vector<Patch_split> m_tangency_splits; // of patches that are not tangent
  int m_tangency_refinements = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_FITTER_H
