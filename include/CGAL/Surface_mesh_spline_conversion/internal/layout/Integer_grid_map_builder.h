// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INTEGER_GRID_MAP_BUILDER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INTEGER_GRID_MAP_BUILDER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Integer_grid_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Mapped_quads.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Quantization.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/integer_constraints.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/build_motorcycle_graph.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/solve_integer_grid_map.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Makes an integer grid map from a seamless map. Every attempt is accepted only if its quads have
// been found and checked.
class Integer_grid_map_builder
{
public:
  explicit Integer_grid_map_builder(Integer_grid_map& result,
                                    const Work_budget& budget = Work_budget())
    : m_result(result), m_budget(budget)
  {}

  // returns `false` if there is no layout; the result then says why
  bool build(const Seamless_map& seamless)
  {
    m_result.is_resolved = false;
    m_result.map = seamless;
    m_result.message = compute_motorcycle_graph(seamless, m_result.graph);
    if(!m_result.message.empty())
      return false;
    measure_area();
    Quantization quantization(m_result.graph, seamless.fractional_bits, m_budget);
    if(!quantization.quantize_all_positive())
    {
      m_result.message = "no integer lengths were found for the motorcycle graph";
      return false;
    }
    const std::vector<std::vector<int> > attempts = wanted_lengths(quantization);
    for(const std::vector<int>& lengths : attempts)
      if(is_worth_a_try(attempts, lengths) && solve_again(seamless, lengths))
        return true;
    return compose_rectangles(seamless, attempts.back());
  }

private:
  // from large quads to positive lengths, the present ones of `quantization`
  static std::vector<std::vector<int> > wanted_lengths(Quantization& quantization)
  {
    const std::vector<int> positive_lengths = quantization.lengths();
    quantization.allow_zeros();
    std::vector<std::vector<int> > lengths(1, quantization.lengths());
    const std::vector<std::vector<int> >& finer = quantization.finer_lengths();
    lengths.insert(lengths.end(), finer.begin(), finer.end());
    lengths.push_back(positive_lengths);
    lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
    return lengths;
  }

  // Without work left, only the best lengths and the safest ones are tried.
  bool is_worth_a_try(const std::vector<std::vector<int> >& attempts,
                      const std::vector<int>& lengths) const
  {
    return !m_budget.is_used_up() || &lengths == &attempts.front() || &lengths == &attempts.back();
  }

  void measure_area()
  {
    m_result.parameter_area = 0;
    for(int r = 0; r < static_cast<int>(m_result.graph.rectangles.size()); ++r)
      m_result.parameter_area
        += std::ldexp(static_cast<double>(m_result.graph.side_length(r, 0)),
                      -m_result.map.fractional_bits)
           * std::ldexp(static_cast<double>(m_result.graph.side_length(r, 1)),
                        -m_result.map.fractional_bits);
  }

  // Solves the map with integer differences between the critical vertices (Bommes et al. 2013).
  bool solve_again(const Seamless_map& seamless, const std::vector<int>& lengths)
  {
    const std::vector<Integer_constraint> constraints
      = integer_constraints(seamless, m_result.graph, lengths);
    Seamless_map resolved;
    if(!solve_integer_grid_map(seamless, constraints, resolved, m_budget))
    {
      m_result.message = "the map could not be solved with integer singularities";
      return false;
    }
    if(!align_integer_grids(resolved, critical_corners(resolved)))
    {
      m_result.message = "the translations of the map are not integers";
      return false;
    }
    m_result.map = std::move(resolved);
    m_result.lengths = lengths;
    m_result.is_resolved = true;
    return accept();
  }

  // a corner at every source of the motorcycle graph
  std::vector<int> critical_corners(const Seamless_map& map) const
  {
    std::vector<int> corners;
    for(const Motorcycle_graph::Node& node : m_result.graph.nodes)
      if(node.is_critical())
        corners.push_back(map.mesh.vertex_halfedge[node.vertex]);
    return corners;
  }

  bool compose_rectangles(const Seamless_map& seamless, const std::vector<int>& lengths)
  {
    const std::string reason = m_result.message;
    m_result.map = seamless;
    m_result.lengths = lengths;
    m_result.is_resolved = false;
    if(!accept())
      return false;
    m_result.message = reason;
    return true;
  }

  bool accept()
  {
    Mapped_quads quads;
    m_result.message = quads.build(m_result);
    m_result.number_of_quads = quads.quads().number_of_quads();
    return m_result.message.empty();
  }

  Integer_grid_map& m_result;
  Work_budget m_budget;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_INTEGER_GRID_MAP_BUILDER_H
