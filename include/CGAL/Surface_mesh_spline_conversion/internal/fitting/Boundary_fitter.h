// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_BOUNDARY_FITTER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_BOUNDARY_FITTER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Cached_curve_target.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/format_number.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/plan_bisection.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/Real_timer.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The boundary iteration of section 3.2 of the paper on a surface and a target, see fit_boundary().
//
// The refinement is planned chain by chain on univariate splines, which costs next to nothing; the
// surface is then refined once to the planned knots, and to what its closure adds to them.
template <typename Surface, typename Target, typename Visitor>
class Boundary_fitter
{
  typedef std::size_t size_type;
  typedef typename Target::FT FT;
  typedef typename Surface::Point_3 Point_3;

  // the curve of a chain as a curve target
  struct Chain_target
  {
    const Target* target;
    size_type chain;

    Eigen::Vector3d point(double x) const { return to_eigen(target->curve_point(chain, FT(x))); }

    Eigen::Vector3d derivative(double x) const
    {
      return to_eigen(target->curve_derivative(chain, FT(x), 1));
    }

    double arc_length(double x) const
    {
      return CGAL::to_double(target->arc_length(chain, FT(x)));
    }

    Eigen::Vector3d curve_point(double s) const
    {
      return to_eigen(target->network().point(chain, FT(s)));
    }

    Curve_foot curve_foot(double s) const
    {
      const auto [point, tangent] = target->network().point_and_tangent(chain, FT(s));
      return {s, to_eigen(point), to_eigen(tangent)};
    }
  };

public:
  Boundary_fitter(Surface& surface, const Target& target, const Boundary_fit_options& options,
                  Visitor& visitor, Conversion_report& report)
    : m_surface(surface), m_target(target), m_options(options), m_visitor(visitor),
      m_report(report)
  {
    for(size_type c = 0; c < target.number_of_chains(); ++c)
    {
      m_curves.emplace_back(Chain_target{&target, c});
      m_joints.push_back(joints(c));
    }
    m_chains.resize(m_curves.size());
  }

  Error_code operator()()
  {
    // two are enough unless the closure of the refinement moves errors to other spans
    constexpr size_type maximum_number_of_iterations = 8;
    for(size_type iteration = 0; iteration < maximum_number_of_iterations; ++iteration)
    {
      if(!m_visitor.go_further())
        return Error_code::INTERRUPTED;
      Real_timer timer;
      timer.start();
      if(iteration > 0 && !refine())
        break;
      if(!fit())
        return fail(Error_code::SINGULAR_SYSTEM, "the boundary curve of chain "
                    + std::to_string(m_worst_chain) + " could not be fitted");
      record(iteration, timer.time());
      if(m_worst.bound < m_options.goal)
        break;
    }
    report_errors();
    if(m_worst.bound < m_options.tolerance || m_curves.empty())
      return Error_code::OK;
    return fail(Error_code::TOLERANCE_NOT_REACHED, "the boundary tolerance was not reached: chain "
                + std::to_string(m_worst_chain) + " has an error of " + format_number(m_worst.bound)
                + " at the arc length " + format_number(m_report.boundary.worst_parameter)
                + "; allow more patches or a larger boundary tolerance");
  }

private:
  // spans of a chain are not bisected further than 2^-14 quads: errors that are still too large
  // there come from the input
  static constexpr double shortest_span = 1. / 16384;

  // the fit of a chain on the knots that the surface has or shall have, and its errors at equal
  // parameters
  struct Measured_chain
  {
    Fitted_chain chain;
    bool is_measured = false;
    double parametric_deviation = 0;
    Error_parts parametric_parts;
  };

  Error_code fail(Error_code code, const std::string& message)
  {
    m_report.message = message;
    return code;
  }

  // the parameters of the joints of a chain, and of the seams of its surfaces
  std::vector<double> joints(size_type chain) const
  {
    std::vector<double> result;
    if(m_target.number_of_sides(chain) == 0)
      return result;
    std::vector<FT> arc_lengths = m_target.network().surface_seams(chain);
    for(const auto& joint : m_target.network().joints(chain))
      arc_lengths.push_back(joint.arc_length);
    const double first = CGAL::to_double(m_target.arc_length(chain, FT(0)));
    const double last
      = CGAL::to_double(m_target.arc_length(chain, FT(double(m_target.number_of_sides(chain)))));
    for(const FT& arc_length : arc_lengths)
    {
      const double s = CGAL::to_double(arc_length);
      result.push_back(parameter(chain, s < first ? s + last - first : s)); // on a closed chain
    }
    return result;
  }

  // the parameter at the arc length `s`, which is not less than that at the parameter 0
  double parameter(size_type chain, double s) const
  {
    const auto distance
      = [&](double x) { return CGAL::to_double(m_target.arc_length(chain, FT(x))) - s; };
    const double last = double(m_target.number_of_sides(chain));
    if(distance(0) >= 0 || distance(last) <= 0)
      return 0;
    const auto bracket = boost::math::tools::bisect(distance, 0., last,
                                                    boost::math::tools::eps_tolerance<double>());
    return (bracket.first + bracket.second) / 2;
  }

  Chain_knots knots(size_type chain) const
  {
    Chain_knots result;
    result.joints = m_joints[chain];
    const auto curve = m_surface.boundary_curve(chain);
    for(const auto& x : curve.knots)
      result.knots.push_back(CGAL::to_double(x));
    if(curve.is_closed)
    {
      // the last knot is the first one of the next period
      result.period = result.knots.back() - result.knots.front();
      result.knots.pop_back();
    }
    return result;
  }

  // fits all chains on the knots of the surface; those whose knots are as before keep their fit
  bool fit()
  {
    m_worst = Span_error();
    m_parametric_deviation = 0;
    m_parametric_parts = Error_parts();
    m_is_met.assign(m_curves.size(), true);
    for_each_index(m_curves.size(), [&](size_type c) { fit(c, m_chains[c]); });
    for(size_type c = 0; c < m_curves.size(); ++c)
    {
      if(m_target.number_of_sides(c) == 0)
        continue;
      const Measured_chain& measured = m_chains[c];
      if(!measured.chain.fit.is_solved)
      {
        m_worst_chain = c;
        return false;
      }
      set_control_points(c, measured.chain.fit.polygon);
      m_parametric_deviation = (std::max)(m_parametric_deviation, measured.parametric_deviation);
      m_parametric_parts.add(measured.parametric_parts);
      const Span_error worst = measured.chain.fit.worst();
      m_is_met[c] = worst.bound < m_options.goal;
      if(worst.bound > m_worst.bound)
      {
        m_worst = worst;
        m_worst_chain = c;
      }
    }
    return true;
  }

  void fit(size_type chain, Measured_chain& result)
  {
    if(m_target.number_of_sides(chain) == 0)
      return;
    const Chain_knots chain_knots = knots(chain);
    if(!result.chain.fit.is_solved || chain_knots.knots != result.chain.knots.knots)
    {
      result = Measured_chain();
      result.chain = {chain_knots, fit_chain(chain_knots, m_curves[chain], m_options.error_metric,
                                             m_options.goal)};
    }
    if(result.chain.fit.is_solved && !result.is_measured)
      measure_parametric_deviation(chain, result);
  }

  void measure_parametric_deviation(size_type chain, Measured_chain& result)
  {
    const Cubic_spline_basis basis = result.chain.knots.basis();
    const Control_polygon& polygon = result.chain.fit.polygon;
    for(size_type span = 0; span < basis.number_of_spans(); ++span)
    {
      const double begin = basis.span_begin(span), length = basis.span_end(span) - begin;
      const Span_samples samples = sample_at_equal_parameters(begin, length, m_curves[chain]);
      result.parametric_deviation
        = (std::max)(result.parametric_deviation,
                     spline_error(basis, polygon, samples, span).sampled);
      result.parametric_parts.add(error_parts(basis, polygon, samples, span));
    }
    result.is_measured = true;
  }

  void set_control_points(size_type chain, const Control_polygon& polygon)
  {
    const auto curve = m_surface.boundary_curve(chain);
    CGAL_assertion(curve.control_points.size() == polygon.size());
    for(size_type i = 0; i < polygon.size(); ++i)
      m_surface.set_control_point(curve.control_points[i],
                                  Point_3(FT(polygon[i][0]), FT(polygon[i][1]), FT(polygon[i][2])));
  }

  // refines the surface so that the fit of each chain is expected to reach the goal, or as far as
  // the limit of the patches allows; returns `false` if nothing can be refined
  bool refine()
  {
    // the outermost row takes many knots before patches have to be split
    constexpr size_type many_knots_per_patch = 32, many_patches = 6250;
    const size_type most = m_options.maximum_number_of_patches;
    const size_type room = most - (std::min)(most, m_surface.number_of_patches());
    const std::vector<Measured_chain> chains = m_chains;
    size_type knots = many_knots_per_patch * (std::min)(room, many_patches);
    while(knots > 0)
    {
      plan(knots);
      const size_type new_knots = number_of_knots(m_chains) - number_of_knots(chains);
      if(has_room(new_knots))
      {
        const size_type size = m_surface.number_of_control_points();
        m_surface.refine_boundary_to(planned_knots());
        return m_surface.number_of_control_points() > size;
      }
      m_chains = chains;
      knots = (std::min)(knots, new_knots) / 2;
    }
    return false;
  }

  // Does the surface with the planned knots, of which so many are new, keep the limit of the
  // patches? Only a trial tells what the closure adds, if there may be too many.
  bool has_room(size_type new_knots) const
  {
    constexpr size_type many_patches_per_knot = 8;
    const size_type most = m_options.maximum_number_of_patches;
    if(m_surface.number_of_patches() + many_patches_per_knot * new_knots <= most)
      return true;
    Surface trial = m_surface;
    trial.refine_boundary_to(planned_knots());
    return trial.number_of_patches() <= most;
  }

  static size_type number_of_knots(const std::vector<Measured_chain>& chains)
  {
    size_type result = 0;
    for(const Measured_chain& c : chains)
      result += c.chain.knots.knots.size();
    return result;
  }

  // plans the knots of the chains that have not reached the goal, with at most so many new ones for
  // each
  void plan(size_type most_knots)
  {
    for_each_index(m_curves.size(), [&](size_type c)
    {
      if(m_is_met[c])
        return;
      const size_type size = m_chains[c].chain.knots.knots.size();
      Measured_chain plan;
      plan.chain = plan_bisection(std::move(m_chains[c].chain), m_curves[c],
                                  m_options.error_metric, m_options.goal, shortest_span,
                                  size + most_knots);
      m_chains[c] = std::move(plan);
    });
  }

  // returns the planned knots of the chains that have not reached the goal
  std::vector<std::vector<FT> > planned_knots() const
  {
    std::vector<std::vector<FT> > result(m_chains.size());
    for(size_type c = 0; c < m_chains.size(); ++c)
      if(!m_is_met[c])
      {
        const std::vector<double>& planned = m_chains[c].chain.knots.knots;
        result[c].assign(planned.begin(), planned.end());
      }
    return result;
  }

  void record(size_type iteration, double seconds)
  {
    Conversion_report::Iteration entry;
    entry.stage = "fit_boundary";
    entry.iteration = iteration;
    entry.patches = m_surface.number_of_patches();
    entry.control_points = m_surface.number_of_control_points();
    entry.boundary_linf = m_parametric_deviation;
    entry.boundary_hausdorff = m_worst.sampled;
    entry.seconds = seconds;
    m_report.iterations.push_back(entry);
    m_visitor.on_iteration(entry);
  }

  void report_errors()
  {
    if(m_curves.empty())
      return;
    Conversion_report::Boundary& b = m_report.boundary;
    b.certified_bound = m_worst.bound;
    b.max_parametric_deviation = m_parametric_deviation;
    b.max_normal_part = m_parametric_parts.normal;
    b.max_tangential_part = m_parametric_parts.tangential;
    b.worst_curve = m_worst_chain;
    b.worst_parameter
      = CGAL::to_double(m_target.arc_length(m_worst_chain, FT(m_worst.worst)));
  }

  Surface& m_surface;
  const Target& m_target;
  Boundary_fit_options m_options;
  Visitor& m_visitor;
  Conversion_report& m_report;
  std::vector<Cached_curve_target<Chain_target> > m_curves;
  std::vector<std::vector<double> > m_joints; // of each chain
  std::vector<Measured_chain> m_chains;
  std::vector<bool> m_is_met; // per chain: has it reached the goal?
  Span_error m_worst;
  double m_parametric_deviation = 0;
  Error_parts m_parametric_parts;
  size_type m_worst_chain = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_BOUNDARY_FITTER_H
