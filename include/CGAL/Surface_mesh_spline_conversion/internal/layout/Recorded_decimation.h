// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_RECORDED_DECIMATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_RECORDED_DECIMATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/field/Face_geometry.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// a point of a triangle: barycentric coordinates for the vertices in their order
struct Triangle_point
{
  int triangle;
  std::array<double, 3> barycentric;
};

inline std::array<double, 3> barycentric_coordinates(const std::array<Eigen::Vector2d, 3>& triangle,
                                                     const Eigen::Vector2d& p)
{
  const double area = cross_product(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  std::array<double, 3> b;
  for(int i = 0; i < 3; ++i)
    b[i] = cross_product(triangle[(i + 1) % 3] - p, triangle[(i + 2) % 3] - p) / area;
  return b;
}

// Puts coordinates that are negative by rounding onto the triangle, and those of its vertices, up to
// rounding, to the vertex.
inline void clamp_to_triangle(std::array<double, 3>& b)
{
  const double almost_one = 1 - 1e-13;
  for(int i = 0; i < 3; ++i)
    if(b[i] >= almost_one)
    {
      b = {{0, 0, 0}};
      b[i] = 1;
      return;
    }
  double sum = 0;
  for(double& x : b)
    sum += x = (std::max)(0., x);
  for(double& x : b)
    x /= sum;
}

// Coarsens a triangle mesh by collapses of edges into one of their ends, and records a
// homeomorphism from the coarse to the fine mesh, as Lee et al. 1998 (MAPS) do for the removal of
// vertices: each collapse takes place in a plane chart of the faces around the vertex that goes,
// where both triangulations are valid. The homeomorphism is linear where all the charts are, and
// does not depend on how well the vertices represent the shape.
class Recorded_decimation
{
public:
  typedef std::array<int, 3> Triangle;

  // `size`: wanted edge length at the vertices. `is_fixed` vertices stay.
  // \pre the triangles form a simplicial complex that is an orientable manifold
  Recorded_decimation(std::vector<Eigen::Vector3d> points, std::vector<Triangle> triangles,
                      std::vector<double> size, std::vector<char> is_fixed)
    : m_points(std::move(points)), m_triangles(std::move(triangles)), m_size(std::move(size)),
      m_is_fixed(std::move(is_fixed)), m_operation(m_triangles.size(), -1),
      m_is_alive(m_triangles.size(), 1), m_faces(m_points.size()), m_ring(m_points.size()),
      m_original_triangle(m_points.size(), -1)
  {
    for(int t = 0; t < static_cast<int>(m_triangles.size()); ++t)
      for(int v : m_triangles[t])
      {
        m_faces[v].push_back(t);
        m_original_triangle[v] = t;
      }
    for(int v = 0; v < number_of_vertices(); ++v)
      update_ring(v);
    for(int v = 0; v < number_of_vertices(); ++v)
      if(is_border(v))
        m_passed[v] = std::vector<Passed_vertex>();
  }

  // With `keeps_border_edges_apart`, no inner edge is made that joins two boundary vertices, and
  // these keep two faces.
  void coarsen(bool keeps_border_edges_apart)
  {
    m_keeps_border_edges_apart = keeps_border_edges_apart;
    for(int v = 0; v < number_of_vertices(); ++v)
      push_edges(v);
    while(!m_queue.empty())
    {
      const Entry entry = m_queue.top();
      m_queue.pop();
      const int v = std::get<1>(entry), w = std::get<2>(entry);
      if(!m_faces[v].empty() && !m_faces[w].empty() && std::get<0>(entry) == length(v, w))
        try_collapse(v, w);
    }
  }

  int number_of_vertices() const { return static_cast<int>(m_points.size()); }
  bool has_vertex(int v) const { return !m_faces[v].empty(); }
  const Eigen::Vector3d& point(int v) const { return m_points[v]; }
  double size(int v) const { return m_size[v]; }
  bool is_fixed(int v) const { return m_is_fixed[v]; }
  bool is_border(int v) const { return m_ring[v].is_open; }
  const Triangle& triangle(int t) const { return m_triangles[t]; }

  // neighbours counter clockwise; on the boundary from the next to the previous boundary vertex
  const std::vector<int>& ring(int v) const { return m_ring[v].vertices; }

  // the triangles between them
  const std::vector<int>& ring_triangles(int v) const { return m_ring[v].triangles; }

  std::vector<int> triangles() const
  {
    std::vector<int> result;
    for(int t = 0; t < static_cast<int>(m_triangles.size()); ++t)
      if(m_is_alive[t])
        result.push_back(t);
    return result;
  }

  // a vertex that went, at its place on a boundary edge: 0 at the source, 1 at the target
  struct Passed_vertex
  {
    int vertex;
    double position;
  };

  // the vertices on the boundary edge that leaves `v`, in their order
  const std::vector<Passed_vertex>& passed_vertices(int v) const { return m_passed.at(v); }

  // the same point in the mesh before all collapses
  Triangle_point original(Triangle_point p) const
  {
    while(m_operation[p.triangle] >= 0)
    {
      for(int i = 0; i < 3; ++i)
        if(p.barycentric[i] == 1)
          return at_vertex(m_triangles[p.triangle][i]);
      p = before(m_operations[m_operation[p.triangle]], p);
    }
    return p;
  }

private:
  // the faces around a vertex
  struct Ring
  {
    std::vector<int> vertices;   // one more than faces on the boundary
    std::vector<int> triangles;
    bool is_open = false;
  };

  // The chart of a collapse has the removed vertex at its origin; all triangles that come and go
  // have two successive vertices of the ring and either this vertex or the remaining one.
  struct Operation
  {
    std::vector<Eigen::Vector2d> ring;
    std::vector<int> old_triangles;     // between the vertices of the ring
    std::vector<int> first_corner;      // corner of these at the origin
    std::vector<int> new_triangles;     // or -1; vertices: the remaining one, ring i, ring i + 1
    int remaining;                      // position in the ring

    int next(int i) const { return i + 1 == static_cast<int>(ring.size()) ? 0 : i + 1; }
  };

  typedef std::tuple<double, int, int> Entry;

  double length(int v, int w) const
  {
    return 2 * (m_points[v] - m_points[w]).norm() / (m_size[v] + m_size[w]);
  }

  void push_edges(int v)
  {
    const double longest = 0.8;
    for(int w : ring(v))
      if(length(v, w) < longest)
      {
        m_queue.emplace(length(v, w), v, w);
        m_queue.emplace(length(v, w), w, v);
      }
  }

  int corner_of(int t, int v) const
  {
    const Triangle& triangle = m_triangles[t];
    return triangle[0] == v ? 0 : triangle[1] == v ? 1 : 2;
  }

  void update_ring(int v)
  {
    Ring& r = m_ring[v];
    r = Ring();
    if(m_faces[v].empty())
      return;
    std::map<int, int> after, before; // neighbour -> face that begins or ends there
    for(int t : m_faces[v])
    {
      const int i = corner_of(t, v);
      after[m_triangles[t][(i + 1) % 3]] = t;
      before[m_triangles[t][(i + 2) % 3]] = t;
    }
    int first = after.begin()->first;
    for(const auto& entry : after)
      if(before.count(entry.first) == 0)
      {
        first = entry.first;
        r.is_open = true;
      }
    int w = first;
    for(std::size_t i = 0; i < m_faces[v].size(); ++i)
    {
      const int t = after[w];
      r.vertices.push_back(w);
      r.triangles.push_back(t);
      w = m_triangles[t][(corner_of(t, v) + 2) % 3];
    }
    if(r.is_open)
      r.vertices.push_back(w);
  }

  void try_collapse(int v, int w)
  {
    if(!is_allowed(v, w))
      return;
    Operation operation;
    for(bool is_round : {false, true})
      if(make_chart(v, w, is_round, operation))
      {
        apply(v, w, operation);
        return;
      }
  }

  bool is_allowed(int v, int w) const
  {
    const std::vector<int>& around = ring(v);
    const int n = static_cast<int>(around.size());
    const int k = static_cast<int>(std::find(around.begin(), around.end(), w) - around.begin());
    if(m_is_fixed[v] || k == n)
      return false;
    // along the boundary only, and faces must remain
    if(n < 3 || (is_border(v) && k != 0 && k != n - 1))
      return false;
    if(!keeps_enough_faces(v, w))
      return false;
    for(int i = 0; i < n; ++i)
    {
      const int x = around[i];
      if(x == w)
        continue;
      // the links of the ends meet in the tips of the faces at the edge only
      if(is_neighbor(i, k, n, is_border(v)))
      {
        if(needs_faces(x) && ring(x).size() < 4)
          return false;
      }
      else if(std::find(ring(w).begin(), ring(w).end(), x) != ring(w).end()
              || !is_allowed_edge(v, w, x))
        return false;
    }
    return true;
  }

  // inner vertices need three faces; boundary vertices need two lest an edge joins their neighbours
  bool needs_faces(int v) const { return !is_border(v) || m_keeps_border_edges_apart; }

  bool keeps_enough_faces(int v, int w) const
  {
    const std::size_t smallest_sum = is_border(v) ? 6 : 7;
    return !needs_faces(w) || ring(v).size() + ring(w).size() >= smallest_sum;
  }

  static bool is_neighbor(int i, int k, int n, bool is_open)
  {
    const int distance = std::abs(i - k);
    return distance == 1 || (!is_open && distance == n - 1);
  }

  // the edge from `w` to `x` that comes with the collapse of `v` into `w`
  bool is_allowed_edge(int v, int w, int x) const
  {
    const double longest = 1.4;
    if(length(w, x) > longest)
      return false;
    const bool is_border_edge
      = is_border(v) && (x == ring(v).front() || x == ring(v).back());
    return is_border_edge || !m_keeps_border_edges_apart || !is_border(w) || !is_border(x);
  }

  // Unfolds the ring of `v` around it, with angles scaled to a full or straight one; a round chart
  // puts the ring on a circle, where it is convex. Returns `false` if new triangles would be
  // inverted or slivers.
  bool make_chart(int v, int w, bool is_round, Operation& operation) const
  {
    const double full_turn = 8 * std::atan(1.);
    const Ring& r = m_ring[v];
    const std::vector<double> angle = scaled_angles(v, r.is_open ? full_turn / 2 : full_turn);
    operation.ring.clear();
    double sum = 0;
    for(std::size_t i = 0; i < r.vertices.size(); ++i)
    {
      const double radius = is_round ? 1 : (m_points[r.vertices[i]] - m_points[v]).norm();
      operation.ring.emplace_back(radius * std::cos(sum), radius * std::sin(sum));
      if(i < angle.size())
        sum += angle[i];
    }
    if(r.is_open) // straight, in spite of rounding
      operation.ring.back() = Eigen::Vector2d(-operation.ring.back().norm(), 0);
    operation.remaining = static_cast<int>(
      std::find(r.vertices.begin(), r.vertices.end(), w) - r.vertices.begin());
    return has_good_triangles(operation, r, is_round);
  }

  // no angle is tiny or straight
  std::vector<double> scaled_angles(int v, double total) const
  {
    const Ring& r = m_ring[v];
    const double n = static_cast<double>(r.triangles.size());
    const double smallest_share = 0.1, even_share = 0.3;
    std::vector<double> angle;
    double sum = 0;
    for(int t : r.triangles)
    {
      const int i = corner_of(t, v);
      const Eigen::Vector3d a = m_points[m_triangles[t][(i + 1) % 3]] - m_points[v];
      const Eigen::Vector3d b = m_points[m_triangles[t][(i + 2) % 3]] - m_points[v];
      angle.push_back(std::atan2(a.cross(b).norm(), a.dot(b)));
      sum += angle.back();
    }
    if(!(sum > 0))
      return std::vector<double>(angle.size(), total / n);
    double largest = 0, smallest = total;
    for(double& a : angle)
    {
      a *= total / sum;
      largest = (std::max)(largest, a);
      smallest = (std::min)(smallest, a);
    }
    double share = smallest < smallest_share * total / n ? smallest_share : 0;
    const double straight = 0.9 * 4 * std::atan(1.);
    if(largest > straight)
      share = (std::max)(even_share, (largest - straight) / (largest - total / n));
    for(double& a : angle)
      a += share * (total / n - a);
    return angle;
  }

  static bool has_good_triangles(const Operation& operation, const Ring& r, bool is_round)
  {
    const double smallest_quality = is_round ? 1e-3 : 0.1;
    const Eigen::Vector2d& w = operation.ring[operation.remaining];
    for(std::size_t i = 0; i < r.triangles.size(); ++i)
    {
      const int a = static_cast<int>(i), b = operation.next(a);
      if(a == operation.remaining || b == operation.remaining)
        continue;
      const Eigen::Vector2d e0 = operation.ring[a] - w, e1 = operation.ring[b] - w;
      const double squares = e0.squaredNorm() + e1.squaredNorm() + (e1 - e0).squaredNorm();
      if(!(cross_product(e0, e1) > smallest_quality * squares / 4))
        return false;
    }
    return true;
  }

  void apply(int v, int w, Operation& operation)
  {
    const Ring r = m_ring[v];
    if(r.is_open)
      pass_border_vertex(v, operation);
    operation.old_triangles = r.triangles;
    const int index = static_cast<int>(m_operations.size());
    for(std::size_t i = 0; i < r.triangles.size(); ++i)
    {
      const int t = r.triangles[i], a = static_cast<int>(i), b = operation.next(a);
      operation.first_corner.push_back(corner_of(t, v));
      const bool vanishes = a == operation.remaining || b == operation.remaining;
      operation.new_triangles.push_back(vanishes ? -1 : static_cast<int>(m_triangles.size()));
      remove_triangle(t);
      if(!vanishes)
        add_triangle({{w, r.vertices[a], r.vertices[b]}}, index);
    }
    m_operations.push_back(std::move(operation));
    update_ring(v);
    for(int x : r.vertices)
      update_ring(x);
    push_edges(w);
  }

  void remove_triangle(int t)
  {
    m_is_alive[t] = 0;
    for(int x : m_triangles[t])
      m_faces[x].erase(std::find(m_faces[x].begin(), m_faces[x].end(), t));
  }

  void add_triangle(const Triangle& triangle, int operation)
  {
    const int t = static_cast<int>(m_triangles.size());
    m_triangles.push_back(triangle);
    m_operation.push_back(operation);
    m_is_alive.push_back(1);
    for(int x : triangle)
      m_faces[x].push_back(t);
  }

  // joins the boundary edges before and after `v`
  void pass_border_vertex(int v, const Operation& operation)
  {
    const double before = operation.ring.back().norm(), after = operation.ring.front().norm();
    const double share = before / (before + after);
    std::vector<Passed_vertex>& list = m_passed[ring(v).back()];
    for(Passed_vertex& p : list)
      p.position *= share;
    list.push_back(Passed_vertex{v, share});
    for(const Passed_vertex& p : m_passed[v])
      list.push_back(Passed_vertex{p.vertex, share + (1 - share) * p.position});
    m_passed.erase(v);
  }

  Triangle_point at_vertex(int v) const
  {
    Triangle_point p{m_original_triangle[v], {{0, 0, 0}}};
    p.barycentric[corner_of(p.triangle, v)] = 1;
    return p;
  }

  Triangle_point before(const Operation& operation, const Triangle_point& p) const
  {
    const int i = static_cast<int>(
      std::find(operation.new_triangles.begin(), operation.new_triangles.end(), p.triangle)
      - operation.new_triangles.begin());
    const Eigen::Vector2d at = p.barycentric[0] * operation.ring[operation.remaining]
                               + p.barycentric[1] * operation.ring[i]
                               + p.barycentric[2] * operation.ring[operation.next(i)];
    Triangle_point best{-1, {{0, 0, 0}}};
    double best_minimum = 0;
    for(std::size_t j = 0; j < operation.old_triangles.size(); ++j)
    {
      const std::array<double, 3> b = barycentric_coordinates(
        {{Eigen::Vector2d(0, 0), operation.ring[j], operation.ring[operation.next(int(j))]}}, at);
      const double minimum = (std::min)({b[0], b[1], b[2]});
      if(best.triangle >= 0 && minimum <= best_minimum)
        continue;
      best_minimum = minimum;
      best.triangle = operation.old_triangles[j];
      for(int k = 0; k < 3; ++k)
        best.barycentric[(operation.first_corner[j] + k) % 3] = b[k];
    }
    clamp_to_triangle(best.barycentric);
    return best;
  }

  std::vector<Eigen::Vector3d> m_points;
  std::vector<Triangle> m_triangles;                  // present and past ones
  std::vector<double> m_size;                         // per vertex
  std::vector<char> m_is_fixed;                       // per vertex
  std::vector<int> m_operation;                       // per triangle: that made it, or -1
  std::vector<char> m_is_alive;                       // per triangle
  std::vector<std::vector<int> > m_faces;             // per vertex: its present triangles
  std::vector<Ring> m_ring;                           // per vertex
  std::vector<int> m_original_triangle;               // per vertex: one of those before collapses
  std::map<int, std::vector<Passed_vertex> > m_passed; // per source of a boundary edge
  std::vector<Operation> m_operations;
  bool m_keeps_border_edges_apart = false;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry> > m_queue;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_RECORDED_DECIMATION_H
