// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SMOOTH_CREASES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SMOOTH_CREASES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/corner_tangents.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/split_corners.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/number_utils.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Makes the normals agree on both sides of the lines that start at the corners of the boundary
// between two quads (paper, Fig. 6(b)).
//
// There the control points of the two outer rows have triple knots, and the surface is only
// continuous across the line above the corner, for two bays. With J the jump of the derivative
// across the line and n the mean normal, the normals agree where n . J = 0. This is linear in
// the control points for given n: the few inner control points that act on J are moved such that
// it holds, in the sense of least squares with a large weight, with the least increase of the
// error of the fit. As n changes, this is repeated.
//
// Where only the outermost row has a triple knot, no inner control point acts on J. Then those are
// moved that act on the derivative along the line, such that it lies in the plane of the
// derivatives on both sides. At the corner it is the one of Corner_tangents: several of these
// control points act on it, and the fit alone may turn it out of the interior angle, which folds
// the surface over.
template <typename Surface, typename Target, typename System>
class Crease_smoother
{
  typedef std::size_t size_type;
  typedef typename Target::FT FT;
  typedef typename Surface::Point_3 Point_3;
  typedef Quad_point<FT> Place;

  // a point on the line above a corner, as seen from both sides
  struct Sample
  {
    std::array<Place, 2> places;
    std::array<std::array<int, 2>, 2> across, along; // directions in (u,v) of the quads
  };

  // a linear functional of the control points
  typedef std::map<size_type, double> Functional;

  // the derivative along the line at a corner, and what it shall be
  struct Tangent
  {
    Functional functional;
    Eigen::Vector3d wanted;
  };

public:
  Crease_smoother(Surface& surface, const Target& target)
    : m_surface(surface), m_target(target)
  {}

  // moves control points that are unknowns of the system
  void operator()(const System& system)
  {
    m_system = &system;
    collect_tangents();
    for_each_split_corner(m_target.layout(), [this](size_type first, int i, size_type second, int j)
      { smooth(first, i, second, j); });
  }

  // returns the patches beside each of the lines
  std::vector<std::vector<size_type> > patches_of_lines() const
  {
    std::vector<std::vector<size_type> > result;
    for_each_split_corner(m_target.layout(), [&](size_type first, int i, size_type second, int j)
    {
      std::vector<size_type> patches;
      for(const Sample& sample : make_samples(first, i, second, j))
        for(const Place& p : sample.places)
          patches.push_back(m_surface.patch_at(p.quad, p.u, p.v));
      result.push_back(patches);
    });
    return result;
  }

private:
  static constexpr int samples_per_bay = 4;
  static constexpr int maximum_number_of_rounds = 3;

  // A surface that turns by much more than a right angle within two bays has no normal that could
  // be kept; control points are not moved by more than this share of the size of a quad.
  static constexpr double largest_move = 0.1;

  // Ratio of the weight of the constraint to that of the fit. What remains of a jump is its share.
  static constexpr double constraint_weight = 1e4;

  // derivatives of functions that are smooth across the line cancel up to rounding
  static constexpr double relative_rounding = 1e-10;

  // the corner is the end of side `i` of `first` and the begin of side `j` of `second`
  void smooth(size_type first, int i, size_type second, int j)
  {
    const std::vector<Sample> samples = make_samples(first, i, second, j);
    std::vector<Functional> functionals;
    for(const Sample& s : samples)
      functionals.push_back(jump(s));
    std::vector<size_type> unknowns = free_control_points(functionals);
    m_is_jump_free = !unknowns.empty();
    if(!m_is_jump_free)
    {
      for(size_type k = 0; k < samples.size(); ++k)
        functionals[k] = derivative_along(samples[k]);
      unknowns = free_control_points(functionals);
    }
    if(unknowns.empty())
      return;
    if(!m_is_jump_free)
      move({}, {}, unknowns); // to the wanted tangents
    make_normals_agree(first, samples, functionals, unknowns);
  }

  // where unknowns of the system act on the derivative along the line at the corner
  void collect_tangents()
  {
    const Corner_tangents<Surface, Target> tangents(m_surface, m_target);
    m_tangents.clear();
    for_each_split_corner(m_target.layout(), [&](size_type first, int i, size_type second, int j)
    {
      Sample corner;
      add_side(first, i, 1, 0, corner, 0);
      Tangent tangent = {derivative_along(corner), tangents.derivative(first, i, second, j)};
      remove_rounding(tangent.functional, std::sqrt(scale({tangent.functional})));
      if(!free_control_points({tangent.functional}).empty() && tangent.wanted.allFinite())
        m_tangents.push_back(tangent);
    });
  }

  void make_normals_agree(size_type first, const std::vector<Sample>& samples,
                          const std::vector<Functional>& functionals,
                          const std::vector<size_type>& unknowns)
  {
    const Positions start = positions(unknowns);
    const double limit = largest_move * CGAL::to_double(m_target.quad_size(first));
    for(int round = 0; round < maximum_number_of_rounds; ++round)
    {
      const Positions last = positions(unknowns);
      const double misfit = normal_misfit(samples);
      move(samples, functionals, unknowns);
      if(normal_misfit(samples) < misfit && distance(positions(unknowns), start) <= limit)
        continue;
      set_positions(unknowns, last);
      break;
    }
  }

  typedef std::vector<Eigen::Vector3d> Positions;

  Positions positions(const std::vector<size_type>& control_points) const
  {
    Positions result;
    for(size_type i : control_points)
      result.push_back(to_eigen(m_surface.control_point(i)));
    return result;
  }

  void set_positions(const std::vector<size_type>& control_points, const Positions& positions)
  {
    for(size_type a = 0; a < control_points.size(); ++a)
    {
      const Eigen::Vector3d& p = positions[a];
      m_surface.set_control_point(control_points[a], Point_3(FT(p[0]), FT(p[1]), FT(p[2])));
    }
  }

  static double distance(const Positions& a, const Positions& b)
  {
    double result = 0;
    for(size_type i = 0; i < a.size(); ++i)
      result = (std::max)(result, (a[i] - b[i]).norm());
    return result;
  }

  // the largest sine of the angle between the normals on both sides
  double normal_misfit(const std::vector<Sample>& samples) const
  {
    double result = 0;
    for(const Sample& s : samples)
    {
      const Eigen::Vector3d along = derivative(s, 0, s.along);
      const Eigen::Vector3d a = derivative(s, 0, s.across).cross(along).normalized();
      const Eigen::Vector3d b = derivative(s, 1, s.across).cross(along).normalized();
      result = (std::max)(result, a.dot(b) > 0 ? a.cross(b).norm() : 1);
    }
    return result;
  }

  std::vector<Sample> make_samples(size_type first, int i, size_type second, int j) const
  {
    std::vector<Sample> samples;
    const double bay = length_of_bay(first, i);
    for(int k = 0; k < 2 * samples_per_bay; ++k)
    {
      const double y = bay * (k + 0.5) / samples_per_bay;
      Sample s;
      add_side(first, i, 1, y, s, 0);
      add_side(second, j, 0, y, s, 1);
      samples.push_back(s);
    }
    return samples;
  }

  // the extension inwards of the patch at the end of side `i`
  double length_of_bay(size_type quad, int i) const
  {
    const auto uv = from_side<FT>(i, FT(1), FT(0));
    const auto o = m_surface.patch_origin(m_surface.patch_at(quad, uv[0], uv[1]));
    return CGAL::to_double(i % 2 == 0 ? o.v1 - o.v0 : o.u1 - o.u0);
  }

  // the place at the parameter `t` (0 or 1) of side `i` and at the distance `y` inwards, which may
  // lie in the quad behind; the directions are read off from two neighbouring points
  void add_side(size_type quad, int i, int t, double y, Sample& sample, size_type side) const
  {
    constexpr double step = 1. / 1024;
    auto at = [&](double x, double d)
    {
      const auto uv = from_side<FT>(i, FT(x), FT(d));
      return cross_sides(m_target.layout(), Place{quad, uv[0], uv[1]});
    };
    const Place p = at(t, y), next = at(t + (t == 0 ? step : -step), y), above = at(t, y + step);
    auto direction = [](const FT& from, const FT& to)
    {
      return to > from ? 1 : (to < from ? -1 : 0);
    };
    const int sign = t == 0 ? 1 : -1;
    sample.places[side] = p;
    sample.across[side] = {{sign * direction(p.u, next.u), sign * direction(p.v, next.v)}};
    sample.along[side] = {{direction(p.u, above.u), direction(p.v, above.v)}};
  }

  // returns S_x behind the line minus S_x before it
  Functional jump(const Sample& s) const
  {
    Functional result;
    double largest = 0;
    std::vector<typename Surface::Basis_function> functions;
    for(size_type side = 0; side < 2; ++side)
    {
      const Place& p = s.places[side];
      functions.clear();
      m_surface.basis(m_surface.patch_at(p.quad, p.u, p.v), p.u, p.v, 1, functions);
      for(const auto& f : functions)
      {
        const double value = s.across[side][0] * f.value[1] + s.across[side][1] * f.value[2];
        result[f.control_point] += side == 0 ? -value : value;
        largest = (std::max)(largest, std::abs(value));
      }
    }
    remove_rounding(result, largest);
    return result;
  }

  // `largest`: of the values that the terms are sums of
  static void remove_rounding(Functional& functional, double largest)
  {
    for(auto it = functional.begin(); it != functional.end(); )
      it = std::abs(it->second) <= relative_rounding * largest ? functional.erase(it)
                                                               : std::next(it);
  }

  Functional derivative_along(const Sample& s) const
  {
    Functional result;
    const Place& p = s.places[0];
    std::vector<typename Surface::Basis_function> functions;
    m_surface.basis(m_surface.patch_at(p.quad, p.u, p.v), p.u, p.v, 1, functions);
    for(const auto& f : functions)
    {
      const double value = s.along[0][0] * f.value[1] + s.along[0][1] * f.value[2];
      if(value != 0)
        result[f.control_point] += value;
    }
    return result;
  }

  std::vector<size_type> free_control_points(const std::vector<Functional>& functionals) const
  {
    std::vector<size_type> result;
    for(const Functional& functional : functionals)
      for(const auto& term : functional)
        if(m_system->unknown(term.first) != System::fixed)
          result.push_back(term.first);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  Eigen::Vector3d derivative(const Sample& s, size_type side,
                             const std::array<std::array<int, 2>, 2>& direction) const
  {
    const Place& p = s.places[side];
    const size_type patch = m_surface.patch_at(p.quad, p.u, p.v);
    return direction[side][0] * to_eigen(m_surface.derivative(patch, p.u, p.v, 1, 0))
           + direction[side][1] * to_eigen(m_surface.derivative(patch, p.u, p.v, 0, 1));
  }

  // one step of the constrained least-squares problem in the coordinates of the unknowns; where the
  // unknowns act on tangents at corners, these are constraints, too
  void move(const std::vector<Sample>& samples, const std::vector<Functional>& functionals,
            const std::vector<size_type>& unknowns)
  {
    const Eigen::Index n = static_cast<Eigen::Index>(unknowns.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    Eigen::VectorXd right_hand_side = Eigen::VectorXd::Zero(3 * n);
    double largest = 0;
    for(Eigen::Index a = 0; a < n; ++a)
      for(Eigen::Index b = 0; b < n; ++b)
      {
        const double c = m_system->coefficient(m_system->unknown(unknowns[size_type(a)]),
                                              m_system->unknown(unknowns[size_type(b)]));
        matrix.block<3, 3>(3 * a, 3 * b) = c * Eigen::Matrix3d::Identity();
        largest = (std::max)(largest, c);
      }
    auto constrain = [&](const Functional& functional, const Eigen::Vector3d& direction,
                         double residual, double weight)
    {
      const Eigen::VectorXd row = constraint_row(functional, direction, unknowns);
      if(row.isZero(0)) // other unknowns
        return;
      matrix += weight * row * row.transpose();
      right_hand_side -= weight * residual * row;
    };
    for(size_type k = 0; k < samples.size(); ++k)
      constrain(functionals[k], constraint_direction(samples[k]), normal_jump(samples[k]),
                constraint_weight * largest / scale(functionals));
    for(const Tangent& t : m_tangents)
    {
      const Eigen::Vector3d residual = value(t.functional) - t.wanted;
      for(int d = 0; d < 3; ++d)
        constrain(t.functional, Eigen::Vector3d::Unit(d), residual[d],
                  constraint_weight * largest / scale({t.functional}));
    }
    const Eigen::VectorXd step = matrix.ldlt().solve(right_hand_side);
    if(!step.allFinite())
      return;
    Positions moved = positions(unknowns);
    for(Eigen::Index a = 0; a < n; ++a)
      moved[size_type(a)] += step.segment<3>(3 * a);
    set_positions(unknowns, moved);
  }

  // the coefficients of the product of a functional and a direction
  static Eigen::VectorXd constraint_row(const Functional& functional,
                                        const Eigen::Vector3d& direction,
                                        const std::vector<size_type>& unknowns)
  {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(unknowns.size()));
    for(size_type a = 0; a < unknowns.size(); ++a)
    {
      const auto it = functional.find(unknowns[a]);
      if(it != functional.end())
        row.segment<3>(3 * static_cast<Eigen::Index>(a)) = it->second * direction;
    }
    return row;
  }

  Eigen::Vector3d value(const Functional& functional) const
  {
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    for(const auto& term : functional)
      result += term.second * to_eigen(m_surface.control_point(term.first));
    return result;
  }

  Eigen::Vector3d mean_normal(const Sample& s) const
  {
    return (derivative(s, 0, s.across) + derivative(s, 1, s.across))
      .cross(derivative(s, 0, s.along)).normalized();
  }

  // n . J
  double normal_jump(const Sample& s) const
  {
    return mean_normal(s).dot(derivative(s, 1, s.across) - derivative(s, 0, s.across));
  }

  // the vector whose product with the jump, or with the derivative along the line, is n . J
  Eigen::Vector3d constraint_direction(const Sample& s) const
  {
    if(m_is_jump_free)
      return mean_normal(s);
    const Eigen::Vector3d before = derivative(s, 0, s.across), after = derivative(s, 1, s.across);
    const Eigen::Vector3d sum = before + after;
    return (after - before).cross(sum) / sum.cross(derivative(s, 0, s.along)).norm();
  }

  // the largest square of a coefficient
  static double scale(const std::vector<Functional>& functionals)
  {
    double result = 0;
    for(const Functional& functional : functionals)
      for(const auto& term : functional)
        result = (std::max)(result, term.second * term.second);
    return result;
  }

  Surface& m_surface;
  const Target& m_target;
  const System* m_system = nullptr;
  std::vector<Tangent> m_tangents;
  bool m_is_jump_free = true; // do inner control points act on the jump at the present corner?
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SMOOTH_CREASES_H
