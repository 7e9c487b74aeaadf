// The mode of the paper, for comparison: the arc length is linear along each side of a quad, the
// error is that at equal parameters, and each iteration bisects the boundary edges and
// quadrisects the patches that are not met, by the rules of `Quadrisection_closure`.
#ifndef QUALITY_PAPER_MODE_H
#define QUALITY_PAPER_MODE_H

#include "Paper_surface.h"
#include "surface_stages.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/plan_bisection.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <algorithm>
#include <cmath>

// one iteration of the boundary fit, lengths relative to the diameter
struct Boundary_iteration
{
  std::size_t patches;
  double parametric, hausdorff;
  std::size_t control_points;
};

class Paper_mode
{
public:
  Paper_mode(const Input& input, const Layout& layout, const Tolerances& tolerances,
             std::size_t maximum_number_of_patches,
             Standardization standardization = Standardization::QUADRISECTION)
    : m_input(input), m_layout(layout), m_tolerances(tolerances),
      m_maximum_number_of_patches(maximum_number_of_patches),
      m_target(layout, input.network.front(), input.data.mesh,
               CGAL::parameters::use_smooth_correspondence(false)),
      m_surface(layout, standardization)
  {}

  // fits the boundary until the parametric error is met; `visit(iteration, surface)` is called
  // for each iteration
  template <typename Visitor>
  std::vector<Boundary_iteration> fit_boundary(const Visitor& visit)
  {
    const std::size_t maximum_number_of_iterations = 16;
    std::vector<Boundary_iteration> result;
    for(std::size_t i = 0; i < maximum_number_of_iterations; ++i)
    {
      std::vector<Surface::Boundary_span> spans;
      result.push_back(fit(spans));
      visit(result.back(), m_surface);
      m_is_met = spans.empty();
      if(m_is_met || m_surface.number_of_patches() > m_maximum_number_of_patches)
        break;
      m_surface.refine_boundary(spans);
    }
    return result;
  }

  std::vector<Boundary_iteration> fit_boundary()
  {
    return fit_boundary([](const Boundary_iteration&, const Surface&) {});
  }

  // fits boundary and interior
  Outcome operator()(SC::Conversion_report& report)
  {
    CGAL::Real_timer timer;
    timer.start();
    Outcome outcome;
    report.boundary_tolerance = m_tolerances.xi * m_input.diameter();
    report.interior_tolerance = m_tolerances.delta * m_input.diameter();
    add_to_report(fit_boundary(), report);
    const auto np = CGAL::parameters::boundary_tolerance(report.boundary_tolerance)
                      .interior_tolerance(report.interior_tolerance)
                      .error_metric(SC::Error_metric::PARAMETRIC)
                      .maximum_number_of_patches(m_maximum_number_of_patches);
    const bool is_interior_met
      = SC::fit_interior(m_surface, m_target, report, np) == SC::Error_code::OK;
    outcome.is_met = m_is_met && is_interior_met;
    outcome.iterations = report.iterations.size();
    outcome.seconds = timer.time();
    count(m_surface, m_layout, outcome);
    return outcome;
  }

  const Surface& surface() const { return m_surface; }

  // adds iterations of the boundary to a report, whose lengths are in model units
  void add_to_report(const std::vector<Boundary_iteration>& iterations,
                     SC::Conversion_report& report) const
  {
    for(const Boundary_iteration& iteration : iterations)
    {
      SC::Conversion_report::Iteration entry;
      entry.stage = "fit_boundary";
      entry.iteration = report.iterations.size();
      entry.patches = iteration.patches;
      entry.control_points = iteration.control_points;
      entry.boundary_linf = iteration.parametric * m_input.diameter();
      entry.boundary_hausdorff = iteration.hausdorff * m_input.diameter();
      report.iterations.push_back(entry);
    }
  }

private:
  // the curve of a chain as a function of the parameter
  struct Chain_target
  {
    const Target* target;
    std::size_t chain;

    Eigen::Vector3d point(double x) const
    {
      return SC::internal::to_eigen(target->curve_point(chain, x));
    }
    Eigen::Vector3d derivative(double x) const
    {
      return SC::internal::to_eigen(target->curve_derivative(chain, x, 1));
    }
  };

  // fits all chains, and finds the spans with a too large error
  Boundary_iteration fit(std::vector<Surface::Boundary_span>& spans)
  {
    const double d = m_input.diameter();
    Boundary_iteration result{m_surface.number_of_patches(), 0, 0,
                              m_surface.number_of_control_points()};
    for(std::size_t c = 0; c < m_target.number_of_chains(); ++c)
    {
      const SC::internal::Chain_knots knots = chain_knots(c);
      const SC::internal::Cubic_spline_basis basis = knots.basis();
      Chain_target target{&m_target, c};
      const SC::internal::Chain_fit fit = SC::internal::fit_chain(knots, target);
      const auto curve = m_surface.boundary_curve(c);
      for(std::size_t i = 0; i < fit.polygon.size(); ++i)
        m_surface.set_control_point(curve.control_points[i],
                                    Kernel::Point_3(fit.polygon[i][0], fit.polygon[i][1],
                                                    fit.polygon[i][2]));
      for(std::size_t span = 0; span < basis.number_of_spans(); ++span)
      {
        result.parametric = (std::max)(result.parametric, fit.errors[span].sampled / d);
        result.hausdorff = (std::max)(result.hausdorff, distance(c, basis, fit, span) / d);
        if(fit.errors[span].sampled > m_tolerances.xi * d)
          spans.push_back({c, basis.span_begin(span), basis.span_end(span)});
      }
    }
    return result;
  }

  SC::internal::Chain_knots chain_knots(std::size_t chain) const
  {
    const auto curve = m_surface.boundary_curve(chain);
    SC::internal::Chain_knots result;
    result.knots.assign(curve.knots.begin(), curve.knots.end());
    if(curve.is_closed)
    {
      result.period = result.knots.back() - result.knots.front();
      result.knots.pop_back();
    }
    return result;
  }

  // the largest distance of a span to the curve
  double distance(std::size_t chain, const SC::internal::Cubic_spline_basis& basis,
                  const SC::internal::Chain_fit& fit, std::size_t span) const
  {
    const int samples = 8;
    double result = 0;
    for(int i = 0; i <= samples; ++i)
    {
      const double t = double(i) / samples;
      const double x = (1 - t) * basis.span_begin(span) + t * basis.span_end(span);
      const Eigen::Vector3d p = SC::internal::evaluate(basis.values(span, x), fit.polygon, 0);
      result = (std::max)(result, m_input.network.front().project(
        chain, Kernel::Point_3(p[0], p[1], p[2]), m_target.arc_length(chain, x)).distance);
    }
    return result;
  }

  const Input& m_input;
  const Layout& m_layout;
  Tolerances m_tolerances;
  std::size_t m_maximum_number_of_patches;
  Target m_target;
  Paper_surface m_surface;
  bool m_is_met = false;
};

#endif // QUALITY_PAPER_MODE_H
