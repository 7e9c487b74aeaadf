// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_PLAN_BISECTION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_PLAN_BISECTION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Error_metric.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Cubic_spline_basis.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_cubic_spline.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_spline_shape.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/spline_error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// the knots of a boundary chain: full open knot vector, or the knots of one period
struct Chain_knots
{
  std::vector<double> knots;
  double period = 0; // 0: open
  std::vector<double> joints; // parameters where the spline shall pass through the curve

  Cubic_spline_basis basis() const
  {
    return period > 0 ? Cubic_spline_basis(knots, period) : Cubic_spline_basis(knots);
  }
};

// Returns how often a span with the given error is bisected at once. The error of a smooth curve
// falls by 16 per bisection, that of its shape by up to 64; the last one of the predicted
// bisections is left to the next measurement, as an error may fall faster at first.
inline int number_of_bisections(double error, double tolerance, Error_metric metric)
{
  constexpr int maximum_at_once = 4;
  const double gain = metric == Error_metric::PARAMETRIC ? 16 : 64;
  const int levels = static_cast<int>(std::floor(std::log(error / tolerance) / std::log(gain)));
  return (std::max)(1, (std::min)(levels, maximum_at_once));
}

// Bisects the spans of a chain: span `i` is cut in `2^levels[i]` pieces, and then spans are cut
// until no span is more than twice as long as its neighbours (paper, section 3.2.4). Spans are
// not cut below `shortest`.
class Chain_bisection
{
public:
  Chain_bisection(const Chain_knots& chain, double shortest)
    : m_chain(chain), m_basis(chain.basis()), m_shortest(shortest)
  {}

  Chain_knots operator()(const std::vector<int>& levels)
  {
    for(std::size_t span = 0; span < m_basis.number_of_spans(); ++span)
    {
      const double begin = m_basis.span_begin(span), length = m_basis.span_end(span) - begin;
      int level = levels[span];
      while(level > 0 && std::ldexp(length, -level) < m_shortest)
        --level;
      const std::size_t pieces = std::size_t(1) << level;
      for(std::size_t k = 0; k < pieces; ++k)
        m_breaks.push_back(begin + length * (double(k) / double(pieces)));
    }
    m_end = m_basis.span_end(m_basis.number_of_spans() - 1);
    while(balance())
      continue;
    return with_new_knots();
  }

private:
  double length(std::size_t i) const
  {
    return (i + 1 < m_breaks.size() ? m_breaks[i + 1] : m_end) - m_breaks[i];
  }

  bool is_unbalanced(std::size_t i) const
  {
    const std::size_t n = m_breaks.size();
    const bool is_periodic = m_chain.period > 0;
    const double longest = 2 * (1 + relative_rounding) * shortest_neighbor(i, n, is_periodic);
    return length(i) > longest;
  }

  double shortest_neighbor(std::size_t i, std::size_t n, bool is_periodic) const
  {
    double result = length(i);
    if(i > 0 || is_periodic)
      result = (std::min)(result, length((i + n - 1) % n));
    if(i + 1 < n || is_periodic)
      result = (std::min)(result, length((i + 1) % n));
    return result;
  }

  bool balance()
  {
    std::vector<double> breaks;
    for(std::size_t i = 0; i < m_breaks.size(); ++i)
    {
      breaks.push_back(m_breaks[i]);
      if(is_unbalanced(i))
        breaks.push_back(m_breaks[i] + length(i) / 2);
    }
    breaks.swap(m_breaks);
    return breaks.size() != m_breaks.size();
  }

  // multiple knots keep their multiplicity
  Chain_knots with_new_knots() const
  {
    Chain_knots result = m_chain;
    for(double x : m_breaks)
      if(!std::binary_search(m_chain.knots.begin(), m_chain.knots.end(), x))
        result.knots.push_back(x);
    std::sort(result.knots.begin(), result.knots.end());
    return result;
  }

  // the lengths are dyadic, and equal ones are equal but for the rounding of a long chain
  static constexpr double relative_rounding = 1e-6;

  const Chain_knots& m_chain;
  Cubic_spline_basis m_basis;
  double m_shortest, m_end = 0;
  std::vector<double> m_breaks;
};

// the state of the fit of a chain
struct Chain_fit
{
  Control_polygon polygon;
  std::vector<Span_error> errors; // per span
  bool is_solved = false;

  Span_error worst() const
  {
    Span_error result;
    for(const Span_error& e : errors)
    {
      result.bound = (std::max)(result.bound, e.bound);
      if(e.sampled > result.sampled)
      {
        result.sampled = e.sampled;
        result.worst = e.worst;
      }
    }
    return result;
  }
};

template <typename CurveTarget>
std::vector<Span_error> errors_at_equal_parameters(const Cubic_spline_basis& basis,
                                                   const Control_polygon& polygon,
                                                   CurveTarget& target)
{
  std::vector<Span_error> result;
  for(std::size_t span = 0; span < basis.number_of_spans(); ++span)
  {
    const double begin = basis.span_begin(span), length = basis.span_end(span) - begin;
    result.push_back(spline_error(basis, polygon,
                                  sample_at_equal_parameters(begin, length, target), span));
  }
  return result;
}

// fits a chain on given knots at equal parameters, and measures the error there
template <typename CurveTarget>
Chain_fit fit_chain(const Chain_knots& knots, CurveTarget& target)
{
  const Cubic_spline_basis basis = knots.basis();
  Cubic_spline_fitter<CurveTarget> fitter(basis, knots.joints, target);
  Chain_fit result;
  result.is_solved = fitter();
  if(!result.is_solved)
    return result;
  result.polygon = fitter.polygon();
  result.errors = errors_at_equal_parameters(basis, result.polygon, target);
  return result;
}

// Improves the fit `start` at equal parameters to one of the shape of the curve. The spline may
// move along the curve, as far as the surface beside it can follow; where it moves too far, the
// weight of the distances along the curve is increased.
template <typename CurveTarget>
Chain_fit fit_chain_shape(const Chain_knots& knots, const Chain_fit& start, CurveTarget& target)
{
  constexpr double tangential_weights[] = {1e-3, 1e-2, 1e-1};
  constexpr double largest_shift = 0.05; // in sides of quads
  const Cubic_spline_basis basis = knots.basis();
  for(double weight : tangential_weights)
  {
    Chain_fit result = start;
    if(!Spline_shape_fitter<CurveTarget>(basis, knots.joints, target, weight)(result.polygon))
      continue;
    const Foot_sampler<CurveTarget> sampler(basis, result.polygon, target);
    Span_samples samples;
    bool is_admissible = true;
    for(std::size_t span = 0; span < basis.number_of_spans() && is_admissible; ++span)
    {
      is_admissible = sampler(span, largest_shift, samples);
      if(is_admissible)
        result.errors[span] = spline_error(basis, result.polygon, samples, span);
    }
    if(is_admissible && result.worst().bound < start.worst().bound)
      return result;
  }
  return start;
}

// fits a chain on given knots as close as the metric asks for
template <typename CurveTarget>
Chain_fit fit_chain(const Chain_knots& knots, CurveTarget& target, Error_metric metric,
                    double tolerance)
{
  const Chain_fit result = fit_chain(knots, target);
  if(metric == Error_metric::PARAMETRIC || !result.is_solved
     || result.worst().bound < tolerance)
    return result;
  return fit_chain_shape(knots, result, target);
}

// knots and the fit on them
struct Fitted_chain
{
  Chain_knots knots;
  Chain_fit fit;
};

// Is bisection of no use, as the error is hardly less than that of `earlier`, which has far fewer
// spans? That of a curve falls, but not that of noise or of rounding.
inline bool is_noise(const Fitted_chain& chain, const Fitted_chain& earlier)
{
  constexpr std::size_t many = 1024, growth = 16;
  constexpr double least_share = 0.9;
  const std::size_t spans = chain.fit.errors.size();
  return spans >= many && spans >= growth * earlier.fit.errors.size()
         && chain.fit.worst().bound >= least_share * earlier.fit.worst().bound;
}

// Returns the levels of bisection of the spans whose error is not below the tolerance. Those with a
// much smaller error than the worst one wait: it is often the one beside them that disturbs them.
inline std::vector<int> planned_levels(const Chain_fit& fit, Error_metric metric, double tolerance)
{
  constexpr double share_of_worst = 1. / 16;
  const double threshold = (std::max)(tolerance, share_of_worst * fit.worst().bound);
  std::vector<int> levels;
  for(const Span_error& error : fit.errors)
    levels.push_back(error.bound < threshold
                     ? 0 : number_of_bisections(error.bound, tolerance, metric));
  return levels;
}

// Returns knots on which the bound of the error is below the tolerance, with the fit there, by
// bisection of the spans where it is not; gives up at `maximum_number_of_knots`, where spans would
// become shorter than `shortest_span`, where bisection does not help, or where there is no fit.
template <typename CurveTarget>
Fitted_chain plan_bisection(Fitted_chain chain, CurveTarget& target, Error_metric metric,
                            double tolerance, double shortest_span,
                            std::size_t maximum_number_of_knots)
{
  std::vector<Fitted_chain> coarser;
  while(chain.fit.is_solved)
  {
    std::vector<int> levels = planned_levels(chain.fit, metric, tolerance);
    Chain_knots finer = Chain_bisection(chain.knots, shortest_span)(levels);
    if(finer.knots.size() > maximum_number_of_knots)
    {
      for(int& level : levels)
        level = (std::min)(level, 1);
      finer = Chain_bisection(chain.knots, shortest_span)(levels);
    }
    if(finer.knots.size() == chain.knots.knots.size()
       || finer.knots.size() > maximum_number_of_knots)
      break;
    coarser.push_back(chain);
    chain.fit = fit_chain(finer, target, metric, tolerance);
    chain.knots = std::move(finer);
    const auto as_good = std::find_if(coarser.begin(), coarser.end(), [&](const Fitted_chain& c)
      { return is_noise(chain, c); });
    if(as_good != coarser.end())
      return *as_good;
  }
  return chain;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_PLAN_BISECTION_H
