// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_WALK_SEARCH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_WALK_SEARCH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Finds shortest walks in a bidirected network. A state of a walk is twice an equation, plus one if
// the balance of the equation has to grow. A step changes the length of an arc by one, and leads to
// another state. The cost of the last step does not count.
class Walk_search
{
public:
  // of the length of an arc
  struct Change
  {
    int arc;
    int amount;
  };

  // `next` is the state reached, or negative where the walk ends behind the arc
  struct Step
  {
    Change change;
    int next;
  };

  // the steps from each state
  void set_steps(const std::vector<std::vector<Step> >& steps, std::size_t number_of_arcs)
  {
    m_steps.clear();
    m_first_step.assign(1, 0);
    m_has_open_ends = false;
    for(const std::vector<Step>& from_state : steps)
    {
      for(const Step& step : from_state)
      {
        m_steps.push_back(step);
        m_has_open_ends = m_has_open_ends || step.next < 0;
      }
      m_first_step.push_back(static_cast<int>(m_steps.size()));
    }
    m_costs.resize(number_of_arcs);
    m_forward.labels.assign(steps.size(), Label());
    m_backward.labels.assign(steps.size(), Label());
  }

  // infinite if the step is forbidden
  void set_cost(const Change& change, double cost)
  {
    m_costs[change.arc][change.amount > 0] = cost;
  }

  // how many states all searches have left, a measure of their work
  double number_of_visits() const { return m_number_of_visits; }

  // `true` if some steps lead out of the network
  bool has_open_ends() const { return m_has_open_ends; }

  // Finds a shortest walk from `start` to a state for which `is_end()`, last change first, without
  // the arc `banned`; `false` if there is none. Where `ends` contains all these states, those from
  // which they are too far away are left out. This does not change the result.
  template <typename IsEnd>
  bool operator()(int start, int banned, const IsEnd& is_end, const std::vector<int>& ends,
                  std::vector<Change>& walk)
  {
    ++m_stamp;
    m_banned = banned;
    m_forward.queue.clear();
    m_backward.queue.clear();
    m_limit = infinity();
    m_radius = 0;
    push(m_forward, start, 0, -1, -1);
    for(const int end : ends)
      push_steps_backward(end, 0, false);
    while(!m_forward.queue.empty())
    {
      const Item item = pop(m_forward.queue);
      if(item.first > m_forward.labels[item.second].distance || is_hopeless(item))
        continue;
      ++m_number_of_visits;
      for(int i = m_first_step[item.second]; i < m_first_step[item.second + 1]; ++i)
      {
        if(!is_allowed(m_steps[i].change))
          continue;
        if(m_steps[i].next < 0 || is_end(m_steps[i].next))
        {
          trace_back(i, item.second, walk);
          return true;
        }
        push(m_forward, m_steps[i].next, item.first + cost(m_steps[i].change), item.second, i);
      }
      if(!ends.empty())
        advance_backward();
    }
    return false;
  }

private:
  typedef std::pair<double, int> Item; // distance, state

  struct Label
  {
    double distance;
    int previous; // state
    int step;     // that led here
    int stamp = 0;
  };

  struct Front
  {
    std::vector<Label> labels; // per state
    std::vector<Item> queue;
  };

  static constexpr double infinity() { return std::numeric_limits<double>::infinity(); }

  double cost(const Change& change) const { return m_costs[change.arc][change.amount > 0]; }

  bool is_allowed(const Change& change) const
  {
    return change.arc != m_banned && cost(change) < infinity();
  }

  bool has_label(const Front& front, int state) const
  {
    return front.labels[state].stamp == m_stamp;
  }

  void push(Front& front, int state, double distance, int previous, int step)
  {
    Label& label = front.labels[state];
    if(label.stamp == m_stamp && label.distance <= distance)
      return;
    label = Label{distance, previous, step, m_stamp};
    front.queue.emplace_back(distance, state);
    std::push_heap(front.queue.begin(), front.queue.end(), std::greater<Item>());
    const Front& other = &front == &m_forward ? m_backward : m_forward;
    if(has_label(other, state))
      m_limit = (std::min)(m_limit, distance + other.labels[state].distance);
  }

  static Item pop(std::vector<Item>& queue)
  {
    std::pop_heap(queue.begin(), queue.end(), std::greater<Item>());
    const Item item = queue.back();
    queue.pop_back();
    return item;
  }

  // `true` if no walk through the state of `item` is as short as one that has been found
  bool is_hopeless(const Item& item) const
  {
    const double rounding = 1 + 1e-9;
    const Label& label = m_backward.labels[item.second];
    const double rest = has_label(m_backward, item.second)
      ? (std::min)(m_radius, label.distance) : m_radius;
    return item.first + rest > m_limit * rounding;
  }

  // finds the distance to the ends from one more state
  void advance_backward()
  {
    if(m_backward.queue.empty())
    {
      m_radius = infinity();
      return;
    }
    const Item item = pop(m_backward.queue);
    m_radius = item.first;
    if(item.first <= m_backward.labels[item.second].distance)
      push_steps_backward(item.second, item.first, true);
  }

  // A step backward from a state is one forward from the state with the opposite need.
  void push_steps_backward(int state, double distance, bool has_cost)
  {
    const int opposite = state ^ 1;
    for(int i = m_first_step[opposite]; i < m_first_step[opposite + 1]; ++i)
      if(m_steps[i].next >= 0 && is_allowed(m_steps[i].change))
        push(m_backward, m_steps[i].next ^ 1,
             has_cost ? distance + cost(m_steps[i].change) : distance, state, i);
  }

  void trace_back(int last_step, int state, std::vector<Change>& walk) const
  {
    walk.assign(1, m_steps[last_step].change);
    for(; m_forward.labels[state].previous >= 0; state = m_forward.labels[state].previous)
      walk.push_back(m_steps[m_forward.labels[state].step].change);
  }

  std::vector<Step> m_steps;      // from the states
  std::vector<int> m_first_step;
  std::vector<std::array<double, 2> > m_costs; // per arc: shorter and longer by one
  bool m_has_open_ends = false;
  Front m_forward;                // from the start
  Front m_backward;               // from the ends
  int m_banned = -1;
  double m_limit = 0;             // length of the shortest walk found so far
  double m_radius = 0;            // the states without a label are at least this far from the ends
  int m_stamp = 0;
  double m_number_of_visits = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_WALK_SEARCH_H
