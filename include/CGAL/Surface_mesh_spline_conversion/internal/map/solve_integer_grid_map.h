// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_SOLVE_INTEGER_GRID_MAP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_SOLVE_INTEGER_GRID_MAP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/minimize_distortion.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/reference_shapes.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/round_to_fixed_point.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Deforms a seamless map such that differences of critical vertices become prescribed integers.
class Integer_grid_map_solver
{
public:
  Integer_grid_map_solver(const Seamless_map& start, const Work_budget& budget)
    : m_start(start), m_mesh(start.mesh), m_cut(m_mesh, start.rotation, start.cone),
      m_component(face_components(m_mesh)), m_budget(budget)
  {}

  bool solve(const std::vector<Integer_constraint>& constraints, Seamless_map& result)
  {
    if(m_cut.rotation() != m_start.rotation || !set_up_equations(constraints))
      return false;
    Map_system system(m_mesh, m_cut, m_space, m_budget);
    set_references(system);
    set_start(system);
    if(!follow_path(system) && !jump_and_untangle(system))
      return false;
    int iterations = 0;
    minimize_distortion(system, m_iterate, final_decrement, iterations);

    result.mesh = m_mesh;
    result.cone = m_start.cone;
    result.size = m_start.size;
    result.repairs = m_start.repairs;
    return round_to_fixed_point(m_space, m_cut, m_iterate.x, m_iterate.y, result).empty()
           && is_integral(constraints, result);
  }

private:
  // the quads of the layout come from this map: worth some more iterations than its start
  static constexpr double final_decrement = 1e-4;

  bool set_up_equations(const std::vector<Integer_constraint>& constraints)
  {
    std::vector<int> components(m_mesh.number_of_halfedges(), -1);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.is_border(h))
        components[h] = m_start.coordinates[h][0]
                        == m_start.coordinates[Working_mesh::next(h)][0] ? 0 : 1;
    Seam_equations equations(m_mesh, m_cut, components);
    for(const Integer_constraint& constraint : constraints)
      if(!equations.add_constraint(constraint))
        return false;
    choose_pins(constraints);
    for(int corner : m_pin)
      equations.pin(corner);
    return equations.solve(m_space);
  }

  // a critical vertex of each component becomes the origin
  void choose_pins(const std::vector<Integer_constraint>& constraints)
  {
    m_pin.clear();
    for(int root : m_cut.roots())
      m_pin.push_back(3 * root);
    for(auto c = constraints.rbegin(); c != constraints.rend(); ++c)
      m_pin[m_component[c->from_corner / 3]] = c->from_corner;
  }

  void set_references(Map_system& system) const
  {
    const std::vector<double> angle_ratio = angle_ratios(m_mesh, m_start.cone);
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      const Eigen::Matrix2d shape
        = scale_angle(m_mesh, f, angle_ratio,
                      turned_shape(m_mesh, f, m_mesh.vector(3 * f).normalized(), 0));
      system.references().push_back(
        make_reference(clamp_sliver(shape / face_size(m_mesh, m_start.size, f))));
      system.references().back().area *= face_weight(m_mesh, f);
    }
  }

  Eigen::Vector2d start_point(int corner) const
  {
    const Fixed_point_2& x = m_start.coordinates[corner];
    const Fixed_point_2& origin = m_start.coordinates[m_pin[m_component[corner / 3]]];
    Eigen::Vector2d point;
    for(int i = 0; i < 2; ++i)
      point[i] = std::ldexp(static_cast<double>(x[i] - origin[i]), -m_start.fractional_bits);
    return point;
  }

  // free variables of the start, and the way that its scalars have to go
  void set_start(const Map_system& system)
  {
    m_iterate.x.resize(m_space.number_of_scalars());
    for(int corner = 0; corner < m_mesh.number_of_halfedges(); ++corner)
      m_iterate.x.segment<2>(2 * m_cut.wedge(corner)) = start_point(corner);
    m_iterate.y.resize(m_space.number_of_free_variables());
    for(int i = 0; i < m_space.number_of_free_variables(); ++i)
    {
      const int scalar = m_space.free_scalar[i];
      m_iterate.y[i] = scalar < m_space.number_of_scalars()
        ? m_iterate.x[scalar] : translation(scalar - m_space.number_of_scalars());
    }
    m_drift = system.constants() - (m_iterate.x - system.linear_part(m_iterate.y));
  }

  // component of the translation of a branch of cuts
  double translation(int index) const
  {
    const int h = m_cut.branches()[index / 2].front();
    const Eigen::Vector2d image = rotate(m_start.rotation[h], start_point(h));
    return (start_point(Working_mesh::next(m_mesh.opposite[h])) - image)[index % 2];
  }

  // Newton's method from an infeasible start: full steps would satisfy the constraints, shortened
  // steps keep all triangles positive and reduce the violation in proportion
  bool follow_path(Map_system& system)
  {
    const int most_iterations = 60, most_tiny_steps = 5;
    const double tiny_step = 0.01;
    const Distortion_energy energy(0);
    int tiny_steps = 0;
    for(int i = 0; i < most_iterations && tiny_steps < most_tiny_steps; ++i)
    {
      if(!assemble_energy(system, m_iterate.x, &m_drift, energy))
        return false;
      const Eigen::VectorXd dy = system.solve();
      const Eigen::VectorXd dx = m_drift + system.linear_part(dy);
      const double t = admissible_step(system, dx);
      m_iterate.x += t * dx;
      m_iterate.y += t * dy;
      m_drift *= 1 - t;
      if(t == 1)
        return true;
      tiny_steps = t < tiny_step ? tiny_steps + 1 : 0;
    }
    return false;
  }

  // the longest step, by halving, after which no determinant has shrunk too much
  double admissible_step(const Map_system& system, const Eigen::VectorXd& dx) const
  {
    const double smallest_fraction = 0.1, smallest_step = 1e-6;
    for(double t = 1; t > smallest_step; t /= 2)
    {
      const Eigen::VectorXd x = m_iterate.x + t * dx;
      bool is_admissible = true;
      for(int f = 0; f < system.number_of_faces() && is_admissible; ++f)
        is_admissible = system.jacobian(x, f).determinant()
                        >= smallest_fraction * system.jacobian(m_iterate.x, f).determinant();
      if(is_admissible)
        return t;
    }
    return 0;
  }

  // satisfies the constraints at once, at the price of inverted triangles
  bool jump_and_untangle(Map_system& system)
  {
    if(!assemble_energy(system, m_iterate.x, &m_drift, Distortion_energy(0)))
      return false;
    const Eigen::VectorXd dy = system.solve();
    m_iterate.x += m_drift + system.linear_part(dy);
    m_iterate.y += dy;
    int iterations = 0;
    return untangle(m_mesh, m_start.cone, system, m_iterate, iterations).none();
  }

  // the ends of the constraints and all transitions are integers
  bool is_integral(const std::vector<Integer_constraint>& constraints,
                   const Seamless_map& map) const
  {
    const std::int64_t unit = std::int64_t(1) << map.fractional_bits;
    const auto is_integer = [unit](const Fixed_point_2& x)
      { return x[0] % unit == 0 && x[1] % unit == 0; };
    for(const Integer_constraint& constraint : constraints)
      if(!is_integer(map.coordinates[constraint.from_corner])
         || !is_integer(map.coordinates[constraint.to_corner]))
        return false;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(!m_mesh.is_border(h) && !is_integer(map.translation(h)))
        return false;
    return true;
  }

  const Seamless_map& m_start;
  const Working_mesh& m_mesh;
  Cut_graph m_cut;
  std::vector<int> m_component;   // per face
  std::vector<int> m_pin;         // per component: corner at the origin
  Map_space m_space;
  Map_iterate m_iterate;
  Eigen::VectorXd m_drift;        // violation of the constraints, as a change of the scalars
  Work_budget m_budget;
};

// Computes a seamless map with the combinatorics of `start` in which the differences between
// critical vertices are those of `constraints`. If these connect all critical vertices and generate
// all closed ways, then the result is an integer-grid map: all critical vertices and translations
// are integers. Returns `false` if the constraints contradict each other or no such map was found.
inline bool solve_integer_grid_map(const Seamless_map& start,
                                   const std::vector<Integer_constraint>& constraints,
                                   Seamless_map& result,
                                   const Work_budget& budget = Work_budget())
{
  return Integer_grid_map_solver(start, budget).solve(constraints, result);
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_SOLVE_INTEGER_GRID_MAP_H
