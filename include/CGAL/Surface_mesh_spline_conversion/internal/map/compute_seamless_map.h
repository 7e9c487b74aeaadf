// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_COMPUTE_SEAMLESS_MAP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_COMPUTE_SEAMLESS_MAP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/field/build_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/minimize_distortion.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/reference_shapes.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/round_to_fixed_point.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// What the solution of a map cost.
struct Map_statistics
{
  int untangling_iterations = 0;
  int distortion_iterations = 0;
  int initially_inverted = 0;
};

// One attempt to compute a seamless map that follows a cross field.
class Seamless_map_solver
{
public:
  Seamless_map_solver(const Cross_field& field, const Work_budget& budget)
    : m_field(field), m_mesh(field.mesh), m_geometry(field.mesh, field.axis),
      m_cut(field.mesh, field.period_jump, field.quarter_turns), m_budget(budget)
  {}

  // returns the vertices where the map is not valid; `true` in `first` if systems could be solved
  std::pair<bool, std::vector<int> > solve(Seamless_map& map, Map_statistics& statistics)
  {
    Seam_equations equations(m_mesh, m_cut, constant_components());
    for(int root : m_cut.roots())
      equations.pin(3 * root);
    if(!equations.solve(m_space))
      return std::make_pair(false, std::vector<int>());
    Map_system system(m_mesh, m_cut, m_space, m_budget);
    if(!compute_scales() || !compute_initial_map(system))
      return std::make_pair(false, std::vector<int>());

    use_scaled_references(system);
    Map_defects defects = find_map_defects(m_mesh, m_field.quarter_turns, system, m_iterate.x);
    statistics.initially_inverted = defects.inverted_faces;
    defects = untangle(m_mesh, m_field.quarter_turns, system, m_iterate,
                       statistics.untangling_iterations);
    if(!defects.none())
      return std::make_pair(true, defects.vertices);
    use_references(system);
    const double small_decrement = 1e-3;
    minimize_distortion(system, m_iterate, small_decrement, statistics.distortion_iterations);

    map.mesh = m_mesh;
    map.cone = m_field.quarter_turns;
    map.size = m_field.size;
    return std::make_pair(true,
                          round_to_fixed_point(m_space, m_cut, m_iterate.x, m_iterate.y, map));
  }

private:
  double direction(int f) const { return m_field.angle[f] + m_cut.turns(f) * right_angle; }

  // boundary edges are parallel to a direction of the field
  std::vector<int> constant_components() const
  {
    std::vector<int> components(m_mesh.number_of_halfedges(), -1);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.is_border(h))
      {
        const Eigen::Vector2d e = halfedge_vector(h);
        components[h] = std::abs(e[0]) > std::abs(e[1]) ? 1 : 0;
      }
    return components;
  }

  // in the turned frame of its face
  Eigen::Vector2d halfedge_vector(int h) const
  {
    const Eigen::Matrix2d shape
      = turned_shape(m_mesh, h / 3, m_field.axis[h / 3], direction(h / 3));
    switch(h % 3)
    {
      case 0: return shape.col(0);
      case 1: return shape.col(1) - shape.col(0);
      default: return -shape.col(1);
    }
  }

  // from the lengths in quads to those of the initial map: undoes a graded size, because a
  // conformal start has fewer inverted triangles; both have the same total area
  bool compute_scales()
  {
    m_scale = conformal_scales(m_mesh, m_geometry, m_field.quarter_turns);
    if(m_scale.empty())
      return false;
    double wanted = 0, present = 0;
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      const double size = face_size(m_mesh, m_field.size, f);
      m_scale[f] *= size;
      wanted += m_geometry.area[f] / (size * size);
      present += m_geometry.area[f] * m_scale[f] * m_scale[f] / (size * size);
    }
    for(double& scale : m_scale)
      scale *= std::sqrt(wanted / present);
    m_references.reserve(m_mesh.number_of_faces());
    const std::vector<double> angle_ratio = angle_ratios(m_mesh, m_field.quarter_turns);
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      const Eigen::Matrix2d shape
        = scale_angle(m_mesh, f, angle_ratio,
                      turned_shape(m_mesh, f, m_field.axis[f], direction(f)));
      m_references.push_back(
        make_reference(clamp_sliver(shape / face_size(m_mesh, m_field.size, f))));
      m_references.back().area *= face_weight(m_mesh, f);
    }
    return true;
  }

  void use_references(Map_system& system) const { system.references() = m_references; }

  void use_scaled_references(Map_system& system) const
  {
    system.references() = m_references;
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      system.references()[f].inverse /= m_scale[f];
      system.references()[f].area *= m_scale[f] * m_scale[f];
    }
  }

  // Poisson equation: Jacobians as close as possible to the conformally scaled frames
  bool compute_initial_map(Map_system& system)
  {
    use_scaled_references(system);
    m_iterate.x = system.constants();
    m_iterate.y = Eigen::VectorXd::Zero(m_space.number_of_free_variables());
    const bool is_regular = system.assemble(m_iterate.x, nullptr,
      [&](int f, const Eigen::Matrix2d& J, Jacobian_gradient& gradient, Jacobian_hessian& hessian)
      {
        // every triangle counts by its area before scaling
        const double weight = m_references[f].area;
        gradient = weight * Jacobian_gradient(J(0, 0) - 1, J(0, 1), J(1, 0), J(1, 1) - 1);
        hessian = weight * Jacobian_hessian::Identity();
      });
    if(!is_regular)
      return false;
    m_iterate.y = system.solve();
    m_iterate.x += system.linear_part(m_iterate.y);
    return m_iterate.x.allFinite();
  }

  const Cross_field& m_field;
  const Working_mesh& m_mesh;
  Face_geometry m_geometry;
  Cut_graph m_cut;
  Work_budget m_budget;
  Map_space m_space;
  std::vector<double> m_scale;                        // per face
  std::vector<Map_system::Reference> m_references;    // per face, unscaled
  Map_iterate m_iterate;
};

constexpr int number_of_rungs = 6;
constexpr int rung_of_refinement = 4;

// repairs are local, and would only cost time where the map is wrong all over the mesh
constexpr std::size_t most_repairable_vertices = 100;

// A rung of the ladder of repairs, for a field that gave no valid map near some vertices. Moving
// the singularities to better triangles helps most.
inline Error_code repair(int rung, const std::vector<int>& vertices, Cross_field& field)
{
  if(rung == rung_of_refinement)
  {
    refine_around(field, vertices);
    return Error_code::OK;
  }
  // a size that changes may ask for more than the singularities allow
  if(rung == number_of_rungs)
    field.size.assign(field.size.size(), *std::min_element(field.size.begin(), field.size.end()));
  return relocate_singularities(field, vertices);
}

// Computes a seamless map that follows `input`. Where this fails, singularities are moved and the
// mesh is refined, at most as many times as there are repairs, and as the budget allows.
inline Error_code compute_seamless_map(const Cross_field& input, Seamless_map& map,
                                       Map_statistics& statistics,
                                       int most_repairs = number_of_rungs,
                                       const Work_budget& budget = Work_budget())
{
  Cross_field field = input;
  for(int rung = 0;; ++rung)
  {
    const std::pair<bool, std::vector<int> > result
      = Seamless_map_solver(field, budget).solve(map, statistics);
    if(!result.first)
      return Error_code::SINGULAR_SYSTEM;
    map.repairs = rung;
    if(result.second.empty())
      return Error_code::OK;
    if(rung == most_repairs || (rung > 0 && result.second.size() > most_repairable_vertices)
       || budget.is_used_up())
      return Error_code::NO_SEAMLESS_MAP;
    const Error_code code = repair(rung + 1, result.second, field);
    if(code != Error_code::OK)
      return code;
  }
}

inline Error_code compute_seamless_map(const Cross_field& field, Seamless_map& map,
                                       int most_repairs = number_of_rungs,
                                       const Work_budget& budget = Work_budget())
{
  Map_statistics statistics;
  return compute_seamless_map(field, map, statistics, most_repairs, budget);
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_COMPUTE_SEAMLESS_MAP_H
