// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_QUANTIZATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_QUANTIZATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Work_budget.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Length_network.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Quantization_oracle.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Finds integer lengths of the arcs of a T-mesh near the real ones. When the budget is used up,
// those that have been found so far are kept.
class Quantization
{
public:
  Quantization(const Motorcycle_graph& graph, int fractional_bits,
               const Work_budget& budget = Work_budget())
    : m_graph(graph), m_real_lengths(real_lengths(graph, fractional_bits)),
      m_targets(m_real_lengths), m_network(graph, m_targets), m_oracle(graph), m_budget(budget)
  {
    find_loops();
  }

  // Lengths of at least one, for which every rectangle of the T-mesh is a grid of quads. They exist
  // because the real lengths solve the same equations. `false` should not happen.
  bool quantize_all_positive()
  {
    if(!balance_positive_lengths())
      return false;
    descend(false);
    return m_oracle(m_network.lengths());
  }

  // Lowers lengths, down to zero where the oracle finds that the layout stays valid: rounding up
  // all short arcs to one would refine the layout without need. \pre `quantize_all_positive()` has
  // succeeded
  void allow_zeros()
  {
    descend_to_zeros();
    if(quads_per_area(1) > largest_waste && !m_budget.is_used_up())
      approach_from_finer_lengths();
  }

  const std::vector<int>& lengths() const { return m_network.lengths(); }

  // Lengths for smaller and smaller quads, found on the way to large ones: maps to them may be
  // easier to find.
  const std::vector<std::vector<int> >& finer_lengths() const { return m_finer_lengths; }

  // the wanted lengths in quads
  static std::vector<double> real_lengths(const Motorcycle_graph& graph, int fractional_bits)
  {
    std::vector<double> lengths;
    for(const Motorcycle_graph::Arc& arc : graph.arcs)
      lengths.push_back(std::ldexp(static_cast<double>(arc.length), -fractional_bits));
    return lengths;
  }

  // a boundary loop needs this number of quad sides to carry a useful spline
  static constexpr int smallest_loop = 4;

private:
  static constexpr int maximum_number_of_passes = 30;
  // improvements below this part of a unit of cost are noise
  static constexpr double smallest_gain = 1e-9;
  // more quads than this times the wanted number are worth a second attempt
  static constexpr double largest_waste = 1.2;
  // bounds the work of this attempt
  static constexpr double largest_scale = 16;

  bool balance_positive_lengths()
  {
    std::vector<int> start(m_targets.size());
    for(std::size_t a = 0; a < start.size(); ++a)
      start[a] = (std::max)(m_positive_bounds[a], static_cast<int>(std::lround(m_targets[a])));
    m_network.set_lower_bounds(m_positive_bounds);
    m_network.set_lengths(start);
    return m_network.balance() || balance_in_double_cover();
  }

  void descend_to_zeros()
  {
    m_network.set_lower_bounds(std::vector<int>(m_targets.size(), 0));
    descend(true);
  }

  // number of quads relative to that of quads with `scale` times the real lengths
  double quads_per_area(double scale) const
  {
    double quads = 0, area = 0;
    for(const Motorcycle_graph::Rectangle& rectangle : m_graph.rectangles)
    {
      std::array<double, 2> size = {{0, 0}}, real_size = {{0, 0}};
      for(int side = 0; side < 2; ++side)
        for(int h : rectangle.sides[side])
        {
          size[side] += m_network.length(h / 2);
          real_size[side] += scale * m_real_lengths[h / 2];
        }
      quads += size[0] * size[1];
      area += real_size[0] * real_size[1];
    }
    return quads / area;
  }

  void set_scale(double scale)
  {
    for(std::size_t a = 0; a < m_targets.size(); ++a)
      m_targets[a] = scale * m_real_lengths[a];
    m_network.set_targets(m_targets);
  }

  // Where the quads are larger than most arcs, single steps from lengths of one get stuck. It is
  // better to quantize for small quads, where rounding is harmless, and to enlarge them by and by.
  void approach_from_finer_lengths()
  {
    const std::vector<int> lengths = m_network.lengths();
    const double cost = m_network.cost();
    double scale = 1;
    do
    {
      scale *= 2;
      set_scale(scale);
      if(!balance_positive_lengths())
        break;
      descend(false);
    }
    while(scale < largest_scale && quads_per_area(scale) > largest_waste);
    for(; scale > 1; scale /= std::sqrt(2.))
    {
      set_scale(scale);
      descend_to_zeros();
      m_finer_lengths.push_back(m_network.lengths());
    }
    std::reverse(m_finer_lengths.begin(), m_finer_lengths.end());
    set_scale(1);
    descend_to_zeros();
    if(m_network.cost() > cost || !m_oracle(m_network.lengths()))
      m_network.set_lengths(lengths);
  }

  // Collects the boundary arcs per loop, and the bounds that give every loop enough sides.
  void find_loops()
  {
    m_positive_bounds.assign(m_graph.arcs.size(), 1);
    std::vector<char> is_visited(m_graph.arcs.size(), 0);
    for(int first = 0; first < static_cast<int>(m_graph.arcs.size()); ++first)
    {
      if(!m_graph.arcs[first].is_on_boundary || is_visited[first])
        continue;
      m_loops.emplace_back();
      for(int a = first; !is_visited[a]; a = m_graph.nodes[m_graph.arcs[a].node[1]].slots[0] / 2)
      {
        is_visited[a] = 1;
        m_loops.back().push_back(a);
      }
      std::vector<int>& loop = m_loops.back();
      // the longest arcs take what is missing
      std::sort(loop.begin(), loop.end(), [this](int a, int b)
        { return std::make_pair(-m_targets[a], a) < std::make_pair(-m_targets[b], b); });
      for(int i = static_cast<int>(loop.size()); i < smallest_loop; ++i)
        ++m_positive_bounds[loop[i % loop.size()]];
    }
  }

  bool has_large_loops() const
  {
    for(const std::vector<int>& loop : m_loops)
    {
      int sum = 0;
      for(int a : loop)
        sum += m_network.length(a);
      if(sum < smallest_loop)
        return false;
    }
    return true;
  }

  // Balancing by single walks can fail where a walk has to use an arc twice; in the double cover it
  // cannot, at the price of lengths of at least two.
  bool balance_in_double_cover()
  {
    Length_network cover = m_network.double_cover();
    std::vector<int> start(2 * m_targets.size()), bounds(start.size());
    for(std::size_t i = 0; i < start.size(); ++i)
    {
      bounds[i] = (m_positive_bounds[i / 2] + 1) / 2;
      start[i] = (std::max)(bounds[i], static_cast<int>(std::lround(m_targets[i / 2] / 2)));
    }
    cover.set_lower_bounds(bounds);
    cover.set_lengths(start);
    if(!cover.balance())
      return false;
    std::vector<int> sums(m_targets.size());
    for(std::size_t a = 0; a < sums.size(); ++a)
      sums[a] = cover.length(static_cast<int>(2 * a)) + cover.length(static_cast<int>(2 * a + 1));
    m_network.set_lengths(std::move(sums));
    return true;
  }

  // Changes lengths by one as long as the cost falls, the worst arcs first. What has failed is
  // tried again only after something else has changed.
  void descend(bool use_oracle)
  {
    int number_of_changes = 0;
    std::vector<std::array<int, 2> > changes_before(m_targets.size(), {{-1, -1}});
    for(int pass = 0; pass < maximum_number_of_passes; ++pass)
    {
      const int changes_before_pass = number_of_changes;
      for(const int arc : arcs_by_excess())
        for(const int change : {-1, 1})
        {
          int& before = changes_before[arc][change > 0];
          if(m_budget.is_used_up())
            return;
          if(before != number_of_changes && try_change(arc, change, use_oracle))
            ++number_of_changes;
          else
            before = number_of_changes;
        }
      if(number_of_changes == changes_before_pass)
        return;
    }
  }

  std::vector<int> arcs_by_excess() const
  {
    std::vector<int> arcs(m_targets.size());
    std::iota(arcs.begin(), arcs.end(), 0);
    std::stable_sort(arcs.begin(), arcs.end(), [this](int a, int b)
      { return m_network.excess(a) > m_network.excess(b); });
    return arcs;
  }

  bool try_change(int arc, int change, bool use_oracle)
  {
    if(m_network.marginal_cost(arc, change) >= 0 || !change_length(arc, change))
      return false;
    if(m_network.pending_cost() < -smallest_gain && has_large_loops()
       && (!use_oracle || is_valid()))
    {
      m_network.commit();
      return true;
    }
    m_network.revert();
    return false;
  }

  // `Length_network::change()`
  bool change_length(int arc, int change)
  {
    const double work_per_visit = 0.2, visits = m_network.number_of_visits();
    const bool is_changed = m_network.change(arc, change);
    m_budget.spend(work_per_visit * (m_network.number_of_visits() - visits));
    return is_changed;
  }

  bool is_valid()
  {
    const double work_per_point = 0.03;
    const bool result = m_oracle(m_network.lengths());
    m_budget.spend(work_per_point * static_cast<double>(m_oracle.number_of_points()));
    return result;
  }

  const Motorcycle_graph& m_graph;
  std::vector<double> m_real_lengths;          // in quads
  std::vector<double> m_targets;               // the real lengths times a scale
  Length_network m_network;
  Quantization_oracle m_oracle;
  Work_budget m_budget;
  std::vector<std::vector<int> > m_loops;      // boundary arcs
  std::vector<int> m_positive_bounds;
  std::vector<std::vector<int> > m_finer_lengths;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_QUANTIZATION_H
