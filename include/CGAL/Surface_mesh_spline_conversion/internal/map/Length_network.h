// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_LENGTH_NETWORK_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_LENGTH_NETWORK_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Motorcycle_graph.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Walk_search.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The equations "opposite sides of a rectangle have the same length" for the integer lengths of the
// arcs. As an arc occurs in two equations at most, they form a bidirected network, in which lengths
// are changed along walks.
class Length_network
{
public:
  // an occurrence of an arc in an equation
  struct Occurrence
  {
    int arc;
    int equation;
    int sign;
  };

  // the network of a T-mesh with the wanted lengths `targets` in quads
  Length_network(const Motorcycle_graph& graph, std::vector<double> targets)
    : m_targets(std::move(targets)), m_equations(2 * graph.rectangles.size()),
      m_arcs(graph.arcs.size())
  {
    for(std::size_t r = 0; r < graph.rectangles.size(); ++r)
      for(int side = 0; side < 4; ++side)
        for(int h : graph.rectangles[r].sides[side])
          add_occurrence(h / 2, static_cast<int>(2 * r) + (side & 1), side < 2 ? 1 : -1);
    initialize();
  }

  // The double cover: two copies of every equation and arc, so that every arc enters one equation
  // and leaves another one. It is an ordinary network: integer lengths can always be balanced
  // there, and the sums of both copies solve the original equations.
  Length_network double_cover() const
  {
    Length_network cover(2 * m_equations.size(), 2 * m_arcs.size());
    for(int a = 0; a < static_cast<int>(m_arcs.size()); ++a)
      for(int copy = 0; copy < 2; ++copy)
      {
        cover.m_targets[2 * a + copy] = m_targets[a] / 2;
        int layer = copy;
        for(std::size_t i = 0; i < m_arcs[a].size(); ++i)
        {
          const Occurrence& o = m_arcs[a][i];
          if(i == 1 && o.sign == m_arcs[a][0].sign)
            layer = 1 - layer;
          cover.add_occurrence(2 * a + copy, 2 * o.equation + layer, o.sign);
        }
      }
    cover.initialize();
    return cover;
  }

  const std::vector<int>& lengths() const { return m_lengths; }
  int length(int arc) const { return m_lengths[arc]; }
  int number_of_arcs() const { return static_cast<int>(m_arcs.size()); }

  // sets all lengths, not necessarily balanced
  void set_lengths(std::vector<int> lengths)
  {
    m_lengths = std::move(lengths);
    std::fill(m_imbalance.begin(), m_imbalance.end(), 0);
    for(int a = 0; a < number_of_arcs(); ++a)
      for(const Occurrence& o : m_arcs[a])
        m_imbalance[o.equation] += o.sign * m_lengths[a];
    m_changes.clear();
    update_all_step_costs();
  }

  void set_targets(std::vector<double> targets)
  {
    m_targets = std::move(targets);
    update_all_step_costs();
  }

  void set_lower_bounds(std::vector<int> bounds)
  {
    m_lower_bounds = std::move(bounds);
    update_all_step_costs();
  }

  // sum of (n - l)^2 / l over the lengths n and their targets l
  double cost() const
  {
    double sum = 0;
    for(int a = 0; a < number_of_arcs(); ++a)
      sum += excess(a) * (m_lengths[a] - m_targets[a]);
    return sum;
  }

  // distance of a length from its target, relative to the target
  double excess(int arc) const
  {
    return (m_lengths[arc] - m_targets[arc]) / weight_divisor(arc);
  }

  // change of the cost when a length changes by `change`
  double marginal_cost(int arc, int change) const
  {
    return change * (2 * (m_lengths[arc] - m_targets[arc]) + change) / weight_divisor(arc);
  }

  // balances all equations by shortest augmenting walks; `false` if a walk fails
  bool balance()
  {
    for(int e = 0; e < static_cast<int>(m_equations.size()); ++e)
      while(m_imbalance[e] != 0)
        if(!augment(e, -1))
          return false;
    m_changes.clear();
    return true;
  }

  // Changes the length of an arc by one and balances the equations again. The change is pending
  // until `commit()` or `revert()`; on `false` it is reverted.
  bool change(int arc, int change)
  {
    if(m_lengths[arc] + change < m_lower_bounds[arc])
      return false;
    add_change(arc, change);
    for(const Occurrence& o : m_arcs[arc])
      while(m_imbalance[o.equation] != 0)
        if(!augment(o.equation, arc))
        {
          revert();
          return false;
        }
    return true;
  }

  // see `Walk_search`
  double number_of_visits() const { return m_find_walk.number_of_visits(); }

  // the change of cost of the pending changes
  double pending_cost() const { return m_pending_cost; }

  void commit()
  {
    m_changes.clear();
    m_pending_cost = 0;
  }

  void revert()
  {
    while(!m_changes.empty())
    {
      const Change c = m_changes.back();
      m_changes.pop_back();
      apply(c.arc, -c.amount);
    }
    m_pending_cost = 0;
  }

private:
  typedef Walk_search::Change Change;

  // paid for every arc of a walk, so that costs are positive and walks short
  static constexpr double step_cost = 1.5;
  static constexpr double smallest_step_cost = 1e-3;
  // shorter targets count as if they were this long
  static constexpr double smallest_divisor = 0.25;

  Length_network(std::size_t number_of_equations, std::size_t number_of_arcs)
    : m_targets(number_of_arcs), m_equations(number_of_equations), m_arcs(number_of_arcs)
  {}

  void initialize()
  {
    m_imbalance.assign(m_equations.size(), 0);
    m_lengths.assign(m_arcs.size(), 0);
    m_lower_bounds.assign(m_arcs.size(), 0);
    collect_steps();
    update_all_step_costs();
  }

  void collect_steps()
  {
    std::vector<std::vector<Walk_search::Step> > steps(2 * m_equations.size());
    for(std::size_t e = 0; e < m_equations.size(); ++e)
      for(const int need : {-1, 1})
        for(const Occurrence& o : m_equations[e])
        {
          const int amount = need * o.sign;
          const Occurrence* other = other_occurrence(o);
          steps[state(static_cast<int>(e), need)].push_back(
            Walk_search::Step{Change{o.arc, amount}, other == nullptr
              ? -1 : state(other->equation, -other->sign * amount)});
        }
    m_find_walk.set_steps(steps, m_arcs.size());
  }

  void update_all_step_costs()
  {
    for(int a = 0; a < number_of_arcs(); ++a)
      update_step_costs(a);
  }

  void update_step_costs(int arc)
  {
    for(const int amount : {-1, 1})
      m_find_walk.set_cost(Change{arc, amount}, m_lengths[arc] + amount < m_lower_bounds[arc]
        ? std::numeric_limits<double>::infinity()
        : (std::max)(smallest_step_cost, marginal_cost(arc, amount) + step_cost));
  }

  void add_occurrence(int arc, int equation, int sign)
  {
    m_arcs[arc].push_back(Occurrence{arc, equation, sign});
    m_equations[equation].push_back(Occurrence{arc, equation, sign});
  }

  double weight_divisor(int arc) const { return (std::max)(smallest_divisor, m_targets[arc]); }

  void apply(int arc, int amount)
  {
    m_lengths[arc] += amount;
    for(const Occurrence& o : m_arcs[arc])
      m_imbalance[o.equation] += o.sign * amount;
    update_step_costs(arc);
  }

  void add_change(int arc, int amount)
  {
    m_pending_cost += marginal_cost(arc, amount);
    m_changes.push_back(Change{arc, amount});
    apply(arc, amount);
  }

  static int state(int equation, int need) { return 2 * equation + (need > 0 ? 1 : 0); }

  // Reduces the imbalance of an equation by one by changing lengths along a shortest walk to a
  // boundary arc or to an equation with the opposite imbalance. The arc `banned` is not used; only
  // its equations are out of balance then.
  bool augment(int equation, int banned)
  {
    const auto is_end = [this, equation](int s) { return is_welcome(s, equation); };
    std::vector<int> ends;
    if(banned >= 0 && !m_find_walk.has_open_ends())
      for(const Occurrence& o : m_arcs[banned])
        for(const int need : {-1, 1})
          if(is_end(state(o.equation, need)))
            ends.push_back(state(o.equation, need));
    if(!m_find_walk(state(equation, -m_imbalance[equation]), banned, is_end, ends, m_walk))
      return false;
    for(const Change& c : m_walk)
      add_change(c.arc, c.amount);
    // a walk may use an arc twice
    for(const Change& c : m_walk)
      if(m_lengths[c.arc] < m_lower_bounds[c.arc])
        return false;
    return true;
  }

  // the occurrence of an arc besides `o`, or null
  const Occurrence* other_occurrence(const Occurrence& o) const
  {
    const std::vector<Occurrence>& both = m_arcs[o.arc];
    if(both.size() < 2)
      return nullptr;
    const bool is_first = both[0].equation == o.equation && both[0].sign == o.sign;
    return &both[is_first ? 1 : 0];
  }

  // `true` if a walk from the equation `start` finds the imbalance that it needs in a last state
  bool is_welcome(int last_state, int start) const
  {
    const int imbalance = m_imbalance[last_state / 2] * ((last_state & 1) ? 1 : -1);
    return imbalance > (last_state / 2 == start ? 1 : 0);
  }

  std::vector<double> m_targets;
  std::vector<std::vector<Occurrence> > m_equations;
  std::vector<std::vector<Occurrence> > m_arcs;
  std::vector<int> m_imbalance;
  std::vector<int> m_lengths;
  std::vector<int> m_lower_bounds;
  std::vector<Change> m_changes;
  double m_pending_cost = 0;
  Walk_search m_find_walk;
  std::vector<Change> m_walk;   // scratch
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_LENGTH_NETWORK_H
