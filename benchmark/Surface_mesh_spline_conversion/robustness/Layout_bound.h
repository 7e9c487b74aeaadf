// A lower bound of the number of quads of the layouts of a mesh. Shares no code with the package.
#ifndef ROBUSTNESS_LAYOUT_BOUND_H
#define ROBUSTNESS_LAYOUT_BOUND_H

#include "Layout_checker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace Check {

// A component with Euler characteristic x, B boundary sides, and I inner vertices has B vertices on
// its boundary, and Euler's formula gives the number of quads: B / 2 + I - x. A boundary loop has
// at least four sides, and one between any two corners. At boundary vertices there are two quads,
// but for corners below 135 degrees, which may have one. Hence, with C of these, the sum of
// 4 - valence over the inner vertices is at least 4 x - C and at most 4 x. Each contributes at most
// one, and, if no valence is above five, at least minus one.
class Layout_bound
{
public:
  explicit Layout_bound(const Triangle_mesh& mesh) : m_mesh(mesh), m_sets(mesh.points.size())
  {
    for(const auto& t : mesh.triangles)
      for(std::size_t i = 0; i < 3; ++i)
      {
        m_halfedges.emplace(t[i], t[(i + 1) % 3]);
        m_sets.unite(t[i], t[(i + 1) % 3]);
      }
    count_elements();
    count_corners();
    count_sides();
  }

  // the smallest number of quads of all components together
  long number_of_quads() { return number_of_quads(false); }

  // the same with three to five quads at each inner vertex
  long number_of_quads_with_low_valences() { return number_of_quads(true); }

private:
  long number_of_quads(bool has_low_valences)
  {
    long sum = 0;
    for(const auto& component : m_twice_chi)
    {
      const long chi = component.second / 2, sides = m_sides[component.first];
      const long inner = (std::max)({4 * chi - m_convex[component.first], sides == 0 ? 1l : 0l,
                                     has_low_valences ? -4 * chi : 0l});
      // the number of sides is even
      sum += (std::max)(1l, (sides + 1) / 2 + inner - chi);
    }
    return sum;
  }

  bool is_border(std::size_t source, std::size_t target) const
  {
    return m_halfedges.count({target, source}) == 0;
  }

  void count_elements()
  {
    for(const auto& h : m_halfedges)
      m_twice_chi[m_sets.find(h.first)] -= is_border(h.first, h.second) ? 2 : 1;
    for(const auto& t : m_mesh.triangles)
      m_twice_chi[m_sets.find(t[0])] += 2;
    for(std::size_t v = 0; v < m_mesh.points.size(); ++v)
      m_twice_chi[m_sets.find(v)] += 2;
  }

  void count_corners()
  {
    const double largest_angle = 0.75 * std::acos(-1.);
    std::map<std::size_t, double> angle;
    for(const std::size_t c : m_mesh.corners)
      angle[c] = 0;
    for(const auto& t : m_mesh.triangles)
      for(std::size_t i = 0; i < 3; ++i)
      {
        const auto corner = angle.find(t[i]);
        if(corner == angle.end())
          continue;
        const Point a = m_mesh.points[t[(i + 1) % 3]] - m_mesh.points[t[i]];
        const Point b = m_mesh.points[t[(i + 2) % 3]] - m_mesh.points[t[i]];
        corner->second += std::atan2(norm(cross(a, b)), dot(a, b));
      }
    for(const auto& corner : angle)
      m_convex[m_sets.find(corner.first)] += corner.second < largest_angle ? 1 : 0;
  }

  void count_sides()
  {
    const long smallest_loop = 4;
    const std::set<std::size_t> corners(m_mesh.corners.begin(), m_mesh.corners.end());
    std::map<std::size_t, std::size_t> next;
    for(const auto& h : m_halfedges)
      if(is_border(h.first, h.second))
        next[h.first] = h.second;
    while(!next.empty())
    {
      long corners_of_loop = 0;
      const std::size_t first = next.begin()->first;
      for(auto it = next.begin(); it != next.end();)
      {
        corners_of_loop += corners.count(it->first) > 0 ? 1 : 0;
        const std::size_t v = it->second;
        next.erase(it);
        it = next.find(v);
      }
      m_sides[m_sets.find(first)] += (std::max)(smallest_loop, corners_of_loop);
    }
  }

  const Triangle_mesh& m_mesh;
  Disjoint_sets m_sets;
  std::set<std::pair<std::size_t, std::size_t> > m_halfedges; // (source, target)
  std::map<std::size_t, long> m_twice_chi, m_convex, m_sides; // per component
};

} // namespace Check

#endif // ROBUSTNESS_LAYOUT_BOUND_H
