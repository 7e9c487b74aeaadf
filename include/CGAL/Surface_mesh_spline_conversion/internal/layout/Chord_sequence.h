// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CHORD_SEQUENCE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CHORD_SEQUENCE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Work_budget.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Chord_collapse.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/scaled_jacobian.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Chooses chords of a layout that are collapsed one after the other: each time the one that leaves
// the least cost, which counts flat quads between the present vertices.
class Chord_sequence
{
public:
  struct Step
  {
    int chord;
    int number_of_quads; // that are left
  };

  // `is_corner`: see `Chord_collapse`. `point`: of the surface at a place
  Chord_sequence(const Quad_grid& quads, const std::vector<char>& is_corner,
                 const std::function<Eigen::Vector3d(const Quad_grid::Place&)>& point)
    : m_quads(quads), m_chords(quads, is_corner), m_points(quads.number_of_vertices())
  {
    for(int q = 0; q < quads.number_of_quads(); ++q)
    {
      const std::array<Eigen::Vector3d, 4> p
        = {{point({q, 0, 0}), point({q, 1, 0}), point({q, 1, 1}), point({q, 0, 1})}};
      for(int i = 0; i < 4; ++i)
        m_points[quads.vertices[q][i]] = p[i];
      const Eigen::Vector3d along_u = point({q, 0.75, 0.5}) - point({q, 0.25, 0.5});
      const Eigen::Vector3d along_v = point({q, 0.5, 0.75}) - point({q, 0.5, 0.25});
      m_normals.push_back(along_u.cross(along_v));
    }
  }

  // until there are not more than `enough` quads, or no chord is left that can be collapsed, or the
  // budget is used up
  std::vector<Step> find(double enough, const Work_budget& budget) const
  {
    std::vector<Step> steps;
    std::vector<char> is_in_set(m_chords.number_of_chords(), 0);
    int number = m_quads.number_of_quads();
    const double work_per_quad_and_chord = 0.4;
    while(number > enough && !budget.is_used_up())
    {
      budget.spend(work_per_quad_and_chord * m_quads.number_of_quads()
                   * m_chords.number_of_chords());
      const std::optional<Step> step = best_step(is_in_set);
      if(!step)
        break;
      steps.push_back(*step);
      is_in_set[step->chord] = 1;
      number = step->number_of_quads;
    }
    return steps;
  }

private:
  std::optional<Step> best_step(std::vector<char>& is_in_set) const
  {
    std::optional<Step> best;
    double least_cost = std::numeric_limits<double>::infinity();
    for(int c = 0; c < m_chords.number_of_chords(); ++c)
    {
      if(is_in_set[c])
        continue;
      is_in_set[c] = 1;
      const std::optional<Collapsed_quads> collapsed = m_chords.collapse(is_in_set);
      is_in_set[c] = 0;
      const double cost_after = collapsed ? cost(*collapsed) : least_cost;
      if(cost_after >= least_cost)
        continue;
      least_cost = cost_after;
      best = Step{c, collapsed->quads.number_of_quads()};
    }
    return best;
  }

  // the number of quads; one with half the best shape counts twice, an inverted one more than five
  // times
  double cost(const Collapsed_quads& collapsed) const
  {
    const std::vector<Eigen::Vector3d> points = points_of(collapsed);
    double sum = 0;
    for(int q = 0; q < collapsed.quads.number_of_quads(); ++q)
    {
      std::array<Eigen::Vector3d, 4> corners;
      for(int i = 0; i < 4; ++i)
        corners[i] = points[collapsed.quads.vertices[q][i]];
      const double shape
        = oriented_scaled_jacobian(corners, m_normals[collapsed.original[q]]);
      sum += 1 + 4 * (1 - shape) * (1 - shape);
    }
    return sum;
  }

  // the new vertices: those that stay at the boundary, and the means of those inside that meet
  std::vector<Eigen::Vector3d> points_of(const Collapsed_quads& collapsed) const
  {
    std::vector<Eigen::Vector3d> points(collapsed.quads.number_of_vertices(),
                                        Eigen::Vector3d::Zero());
    std::vector<int> number(points.size(), 0);
    for(std::size_t v = 0; v < collapsed.vertex_of.size(); ++v)
    {
      points[collapsed.vertex_of[v]] += m_points[v];
      ++number[collapsed.vertex_of[v]];
    }
    for(std::size_t v = 0; v < points.size(); ++v)
      if(collapsed.quads.is_border_vertex[v])
        points[v] = m_points[collapsed.anchor[v]];
      else
        points[v] /= number[v];
    return points;
  }

  const Quad_grid& m_quads;
  const Chord_collapse m_chords;
  std::vector<Eigen::Vector3d> m_points;  // per vertex
  std::vector<Eigen::Vector3d> m_normals; // per quad, near its middle
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CHORD_SEQUENCE_H
