// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_COLLAPSE_SEQUENCE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_COLLAPSE_SEQUENCE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Work_budget.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_collapse.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/scaled_jacobian.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Chooses chords, or chords and quads of a layout that are collapsed one after the other. Of chords
// alone, it is each time the one that leaves the least cost, which counts flat quads between the
// present vertices. Single quads change the numbers of quads at vertices: then these count as well,
// and it is each time what lowers the cost most for each quad that vanishes.
class Collapse_sequence
{
public:
  enum class Parts { CHORDS, CHORDS_AND_QUADS };

  // collapses that belong together
  struct Move
  {
    std::vector<Collapse_step> steps;
    int number_of_quads; // that are left
  };

  // `is_corner`: see `Quad_collapse`. `point`: of the surface at a place
  Collapse_sequence(const Quad_grid& quads, const std::vector<char>& is_corner,
                    const std::function<Eigen::Vector3d(const Quad_grid::Place&)>& point,
                    Parts parts)
    : m_quads(quads), m_collapse(quads, is_corner), m_parts(parts),
      m_points(quads.number_of_vertices())
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

  // until there are not more than `enough` quads, or nothing is left that can be collapsed, or the
  // budget is used up
  std::vector<Move> find(double enough, const Work_budget& budget) const
  {
    std::vector<Move> moves;
    Present present{Collapse_pattern(m_quads), {}};
    std::optional<Collapsed_quads> collapsed = m_collapse.collapse_for_now(present.pattern);
    while(collapsed && collapsed->quads.number_of_quads() > enough && !budget.is_used_up())
    {
      present.collapsed = std::move(*collapsed);
      std::optional<Move> move = best_move(present, budget);
      if(!move)
        break;
      for(const Collapse_step& step : move->steps)
        present.pattern.apply(step);
      collapsed = m_collapse.collapse_for_now(present.pattern);
      moves.push_back(std::move(*move));
    }
    return moves;
  }

private:
  struct Present
  {
    Collapse_pattern pattern;
    Collapsed_quads collapsed;
  };

  std::optional<Move> best_move(const Present& present, const Work_budget& budget) const
  {
    std::optional<Move> best;
    double best_gain = -std::numeric_limits<double>::infinity();
    const double cost_before = cost(present.collapsed);
    for(const Collapse_step& step : candidates(present))
    {
      budget.spend(work_per_quad * m_quads.number_of_quads());
      Move move{std::vector<Collapse_step>(1, step), 0};
      const std::optional<Collapsed_quads> collapsed = after(present, move.steps);
      if(!collapsed)
        continue;
      move.number_of_quads = collapsed->quads.number_of_quads();
      const int vanished = present.collapsed.quads.number_of_quads() - move.number_of_quads;
      const double gain = (cost_before - cost(*collapsed))
                          / (m_parts == Parts::CHORDS ? 1 : vanished);
      if(gain <= best_gain)
        continue;
      best_gain = gain;
      best = std::move(move);
    }
    return best;
  }

  // all chords, and the diagonals between inner vertices that would not have too many quads
  std::vector<Collapse_step> candidates(const Present& present) const
  {
    typedef Collapse_step::Kind Kind;
    std::vector<Collapse_step> steps;
    std::set<Quad_grid::Side> done;
    const Quad_grid& quads = present.collapsed.quads;
    for(int k = 0; k < quads.number_of_quads(); ++k)
      for(int i = 0; i < 2; ++i)
      {
        const int q = present.collapsed.original[k];
        if(done.count(Quad_grid::Side(q, i)) == 0)
        {
          done.merge(present.pattern.chord(q, i));
          steps.push_back(Collapse_step{Kind::CHORD, q, i});
        }
        const int v = quads.vertices[k][i], w = quads.vertices[k][i + 2];
        if(m_parts == Parts::CHORDS_AND_QUADS && are_inside(quads, k)
           && quads.valence[v] + quads.valence[w] - 2 <= Quad_collapse::most_quads_at_vertex)
          steps.push_back(Collapse_step{Kind::DIAGONAL, q, i});
      }
    return steps;
  }

  static bool are_inside(const Quad_grid& quads, int k)
  {
    return std::none_of(quads.vertices[k].begin(), quads.vertices[k].end(),
                        [&](int v) { return quads.is_border_vertex[v] != 0; });
  }

  // The quads after more steps; appends the steps that remove vertices with two quads.
  std::optional<Collapsed_quads> after(const Present& present,
                                       std::vector<Collapse_step>& steps) const
  {
    Collapse_pattern pattern = present.pattern;
    pattern.apply(steps.front());
    std::optional<Collapsed_quads> collapsed = m_collapse.collapse_for_now(pattern);
    for(std::optional<Collapse_step> step; collapsed && (step = removal(*collapsed));)
    {
      pattern.apply(*step);
      steps.push_back(*step);
      collapsed = m_collapse.collapse_for_now(pattern);
    }
    if(!collapsed)
      return std::nullopt;
    return m_collapse.collapse(pattern,
                               Quad_collapse::number_of_bad_quads(present.collapsed.quads));
  }

  // of a vertex with two quads, which become one
  static std::optional<Collapse_step> removal(const Collapsed_quads& collapsed)
  {
    const Quad_grid& quads = collapsed.quads;
    for(int v = 0; v < quads.number_of_vertices(); ++v)
      if(!quads.is_border_vertex[v] && quads.valence[v] == 2)
      {
        const Quad_grid::Side& corner = quads.first_corner[v];
        return Collapse_step{Collapse_step::Kind::DIAGONAL, collapsed.original[corner.first],
                             corner.second % 2};
      }
    return std::nullopt;
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
    return m_parts == Parts::CHORDS ? sum : sum + cost_of_valences(collapsed.quads);
  }

  static double cost_of_valences(const Quad_grid& quads)
  {
    const double weight = 0.3;
    double sum = 0;
    for(int v = 0; v < quads.number_of_vertices(); ++v)
      if(!quads.is_border_vertex[v])
        sum += weight * (quads.valence[v] - 4) * (quads.valence[v] - 4);
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

  static constexpr double work_per_quad = 0.4; // and candidate

  const Quad_grid& m_quads;
  const Quad_collapse m_collapse;
  const Parts m_parts;
  std::vector<Eigen::Vector3d> m_points;  // per vertex
  std::vector<Eigen::Vector3d> m_normals; // per quad, near its middle
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_COLLAPSE_SEQUENCE_H
