// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MINIMIZE_DISTORTION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MINIMIZE_DISTORTION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/field/Face_geometry.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Map_system.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A map during optimisation: scalars x = M y + constants for the free variables y.
struct Map_iterate
{
  Eigen::VectorXd x, y;
};

struct Newton_step
{
  bool is_descent = false;
  double length = 0;             // in (0, 1] if is_descent
  double decrement = 0;          // expected decrease of the energy by a full step
  double energy_before = 0, energy_after = 0;
};

inline double total_energy(const Map_system& system, const Eigen::VectorXd& x,
                           const Distortion_energy& energy)
{
  double sum = 0;
  for(int f = 0; f < system.number_of_faces(); ++f)
  {
    sum += system.references()[f].area * energy.value(system.jacobian(x, f));
    if(!(sum < std::numeric_limits<double>::infinity()))
      break;
  }
  return sum;
}

// adds up the derivatives of the energy; see `Map_system::assemble()`
inline bool assemble_energy(Map_system& system, const Eigen::VectorXd& x,
                            const Eigen::VectorXd* drift, const Distortion_energy& energy)
{
  return system.assemble(x, drift,
    [&](int f, const Eigen::Matrix2d& J, Jacobian_gradient& gradient, Jacobian_hessian& hessian)
    {
      energy.derivatives(J, gradient, hessian);
      gradient *= system.references()[f].area;
      hessian *= system.references()[f].area;
    });
}

// One projected Newton step with backtracking.
inline Newton_step take_newton_step(Map_system& system, Map_iterate& map,
                                    const Distortion_energy& energy)
{
  const double sufficient_decrease = 1e-4, smallest_length = 1e-12;
  Newton_step step;
  step.energy_before = total_energy(system, map.x, energy);
  if(!assemble_energy(system, map.x, nullptr, energy))
    return step;
  const Eigen::VectorXd dy = system.solve();
  const double slope = system.gradient().dot(dy);
  if(!(slope < 0))
    return step;
  step.decrement = -slope;
  const Eigen::VectorXd dx = system.linear_part(dy);
  for(double t = 1; t > smallest_length; t /= 2)
  {
    const Eigen::VectorXd x = map.x + t * dx;
    step.energy_after = total_energy(system, x, energy);
    if(step.energy_after <= step.energy_before + sufficient_decrease * t * slope)
    {
      map.x = x;
      map.y += t * dy;
      step.length = t;
      step.is_descent = true;
      return step;
    }
  }
  return step;
}

// What is wrong with a map, in floating point.
struct Map_defects
{
  double smallest_determinant = std::numeric_limits<double>::infinity();
  int inverted_faces = 0;
  std::vector<int> vertices;     // at inverted faces or with wrong cones

  bool none() const { return vertices.empty(); }
};

inline Map_defects find_map_defects(const Working_mesh& mesh, const std::vector<int>& cone,
                                    const Map_system& system, const Eigen::VectorXd& x)
{
  Map_defects defects;
  std::vector<double> angle(mesh.number_of_vertices(), 0.);
  std::vector<char> is_bad(mesh.number_of_vertices(), 0);
  for(int f = 0; f < mesh.number_of_faces(); ++f)
  {
    const double d = system.jacobian(x, f).determinant();
    defects.smallest_determinant = (std::min)(defects.smallest_determinant, d);
    const bool is_inverted = !(d > 0);
    defects.inverted_faces += is_inverted;
    for(int i = 0; i < 3; ++i)
    {
      const int v = mesh.triangles[f][i];
      const Eigen::Vector2d p = system.point(x, 3 * f + i);
      const Eigen::Vector2d a = system.point(x, 3 * f + (i + 1) % 3) - p;
      const Eigen::Vector2d b = system.point(x, 3 * f + (i + 2) % 3) - p;
      angle[v] += std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
      if(is_inverted)
        is_bad[v] = 1;
    }
  }
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
    if(is_bad[v] || std::lround(angle[v] / right_angle) != cone[v])
      defects.vertices.push_back(v);
  return defects;
}

// Controls epsilon of the energy while triangles are inverted (Garanzha et al. 2021, with bounds: a
// large start wrecks the map, a tiny one makes the systems ill-conditioned before all is turned
// over).
class Epsilon_schedule
{
public:
  explicit Epsilon_schedule(double smallest_determinant)
  {
    const double d = (std::min)(smallest_determinant, 0.);
    m_epsilon = (std::min)(largest, std::sqrt(smallest * smallest + 0.04 * d * d));
    m_epsilon = (std::max)(m_epsilon, floor);
  }

  double epsilon() const { return m_epsilon; }

  void update(const Newton_step& step, double smallest_determinant)
  {
    const double small_decrement = 1e-2, reduction = 0.3, least_progress = 0.1;
    const double progress
      = (std::max)(1 - step.energy_after / step.energy_before, least_progress);
    const double mu = (1 - progress) * Distortion_energy(m_epsilon).chi(smallest_determinant);
    double next = m_epsilon;
    if(smallest_determinant < mu)
      next = (std::min)(next, 2 * std::sqrt(mu * (mu - smallest_determinant)));
    if(step.decrement < small_decrement * step.energy_after)
      next = (std::min)(next, m_epsilon * reduction);
    m_epsilon = (std::min)(m_epsilon, (std::max)(next, floor));
  }

private:
  static constexpr double largest = 0.5, smallest = 1e-4, floor = 1e-3;
  double m_epsilon;
};

// Turns over inverted triangles; returns as soon as there are none and all cones are right, else
// with the remaining defects.
inline Map_defects untangle(const Working_mesh& mesh, const std::vector<int>& cone,
                            Map_system& system, Map_iterate& map, int& iterations)
{
  const int most_iterations = 50, patience = 12;
  Map_defects defects = find_map_defects(mesh, cone, system, map.x);
  Epsilon_schedule schedule(defects.smallest_determinant);
  std::size_t fewest = defects.vertices.size();
  for(int i = 0, since_progress = 0; i < most_iterations && since_progress < patience; ++i)
  {
    // wrong cones alone cannot be cured: they are full turns off
    if(defects.inverted_faces == 0)
      break;
    const Newton_step step
      = take_newton_step(system, map, Distortion_energy(schedule.epsilon()));
    if(!step.is_descent)
      break;
    ++iterations;
    defects = find_map_defects(mesh, cone, system, map.x);
    schedule.update(step, defects.smallest_determinant);
    since_progress = defects.vertices.size() < fewest ? 0 : since_progress + 1;
    fewest = (std::min)(fewest, defects.vertices.size());
  }
  return defects;
}

// Reduces the distortion of a map without inverted triangles; none gets inverted, and no cone
// changes.
inline void minimize_distortion(Map_system& system, Map_iterate& map, double small_decrement,
                                int& iterations)
{
  const int most_iterations = 50;
  for(int i = 0; i < most_iterations; ++i)
  {
    const Newton_step step = take_newton_step(system, map, Distortion_energy(0));
    if(!step.is_descent)
      return;
    ++iterations;
    if(step.length == 1 && step.decrement < small_decrement * step.energy_after)
      return;
  }
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MINIMIZE_DISTORTION_H
