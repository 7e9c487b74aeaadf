// Judges quad layouts. Shares no code with the package: it sees plain arrays, and the inverse map
// as a function.
#ifndef ROBUSTNESS_LAYOUT_CHECKER_H
#define ROBUSTNESS_LAYOUT_CHECKER_H

#include "Plain_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Check {

// Euler characteristic and number of boundary loops of the connected components, sorted.
typedef std::vector<std::pair<long, long> > Topology;

class Disjoint_sets
{
public:
  explicit Disjoint_sets(std::size_t n) : m_parent(n)
  {
    std::iota(m_parent.begin(), m_parent.end(), std::size_t(0));
  }

  std::size_t find(std::size_t i)
  {
    while(m_parent[i] != i)
      i = m_parent[i] = m_parent[m_parent[i]];
    return i;
  }

  void unite(std::size_t i, std::size_t j) { m_parent[find(i)] = find(j); }

private:
  std::vector<std::size_t> m_parent;
};

// the topology of a mesh of polygons whose vertices are all used and whose edges have at most two
// faces
template <typename Polygons>
Topology topology_of(std::size_t number_of_points, const Polygons& polygons)
{
  Disjoint_sets sets(number_of_points);
  std::set<std::pair<std::size_t, std::size_t> > halfedges; // (source, target)
  std::map<std::size_t, long> twice_chi, loops;
  for(const auto& polygon : polygons)
    for(std::size_t i = 0; i < polygon.size(); ++i)
    {
      const std::size_t source = polygon[i], target = polygon[(i + 1) % polygon.size()];
      halfedges.emplace(source, target);
      sets.unite(source, target);
    }
  for(std::size_t v = 0; v < number_of_points; ++v)
    twice_chi[sets.find(v)] += 2;
  for(const auto& polygon : polygons)
    twice_chi[sets.find(polygon[0])] += 2;
  std::map<std::size_t, std::size_t> next;
  for(const auto& h : halfedges)
  {
    const bool is_border = !halfedges.count({h.second, h.first});
    twice_chi[sets.find(h.first)] -= is_border ? 2 : 1;
    if(is_border)
      next[h.first] = h.second;
  }
  while(!next.empty())
  {
    ++loops[sets.find(next.begin()->first)];
    for(auto it = next.begin(); it != next.end();)
    {
      const std::size_t v = it->second;
      next.erase(it);
      it = next.find(v);
    }
  }
  Topology result;
  for(const auto& component : twice_chi)
    result.emplace_back(component.second / 2, loops[component.first]);
  std::sort(result.begin(), result.end());
  return result;
}

inline Topology topology_of(const Triangle_mesh& mesh)
{
  return topology_of(mesh.points.size(), mesh.triangles);
}

// A defect of a layout: a short name of the property that is violated, and where.
struct Defect
{
  std::string property;
  std::string place;
};

class Layout_checker
{
  typedef Quad_mesh::Side Side;
  typedef Quad_mesh::Location Location;
  static constexpr std::size_t null = Quad_mesh::null;

  // relative to the diameter: exact up to the rounding of coordinates
  static constexpr double exact = 1e-12;
  // where exact points have been interpolated or summed up
  static constexpr double almost_exact = 1e-9;

public:
  Layout_checker(const Quad_mesh& layout, const Triangle_mesh& mesh, const Boundary_chains& chains)
    : m_layout(layout), m_mesh(mesh), m_chains(chains)
  {}

  // Checks everything; returns the defects found, the first of each property. An empty result means
  // that the layout is valid.
  const std::vector<Defect>& check()
  {
    if(!check_gluing())
      return m_defects;
    check_vertex_fans();
    check_topology();
    check_valences();
    check_boundary_points();
    check_corners();
    if(!m_layout.pieces.empty())
      check_boundary_cover();
    if(m_layout.inverse_map)
      check_inverse_map();
    return m_defects;
  }

  // vertices inside with other than four quads
  std::size_t number_of_extraordinary_points() const { return m_extraordinary; }

  // share of the area of the mesh that the images of the quads have, by sampling
  double relative_area() const { return m_relative_area; }

private:
  void report(const std::string& property, const std::string& place)
  {
    for(const Defect& defect : m_defects)
      if(defect.property == property)
        return;
    m_defects.push_back({property, place});
  }

  static std::string quad(std::size_t q, int side = -1)
  {
    return "quad " + std::to_string(q) + (side < 0 ? "" : ", side " + std::to_string(side));
  }

  static std::string vertex(std::size_t v) { return "vertex " + std::to_string(v); }

  static std::string number(double x)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", x);
    return text;
  }

  std::size_t number_of_quads() const { return m_layout.quads.size(); }
  std::size_t vertex(std::size_t q, int i) const { return m_layout.quads[q][i & 3]; }
  Side neighbor(std::size_t q, int i) const { return m_layout.neighbors[q][i & 3]; }
  bool is_border(std::size_t q, int i) const { return neighbor(q, i).first == null; }

  // Sides are paired, with the same end points in reverse: an oriented surface without edges of
  // three quads. Returns `false` if nothing else can be checked.
  bool check_gluing()
  {
    if(m_layout.quads.empty())
      report("no quads", "");
    for(std::size_t q = 0; q < number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        if(vertex(q, i) >= m_layout.points.size())
          report("vertex out of range", quad(q));
        if(is_border(q, i))
          continue;
        const Side other = neighbor(q, i);
        if(other.first >= number_of_quads() || other.second < 0 || other.second > 3)
          report("neighbour out of range", quad(q, i));
        else if(other == Side(q, i) || neighbor(other.first, other.second) != Side(q, i))
          report("sides not paired", quad(q, i));
        else if(vertex(q, i) != vertex(other.first, other.second + 1)
                || vertex(q, i + 1) != vertex(other.first, other.second))
          report("sides not oriented", quad(q, i));
      }
    for(std::size_t v = 0; v < m_layout.points.size(); ++v)
      for(double x : m_layout.points[v])
        if(!std::isfinite(x))
          report("point not finite", vertex(v));
    return m_defects.empty();
  }

  // The quads at each vertex form one fan or one cycle.
  void check_vertex_fans()
  {
    std::vector<std::size_t> fans(m_layout.points.size(), 0);
    std::vector<std::array<bool, 4> > is_visited(number_of_quads(),
                                                 std::array<bool, 4>{{false, false, false, false}});
    // fans begin at boundary sides, cycles anywhere
    for(const bool do_cycles : {false, true})
      for(std::size_t q = 0; q < number_of_quads(); ++q)
        for(int i = 0; i < 4; ++i)
          if(!is_visited[q][i] && (do_cycles || is_border(q, i)))
          {
            ++fans[vertex(q, i)];
            Side at(q, i);
            while(at.first != null && !is_visited[at.first][at.second])
            {
              is_visited[at.first][at.second] = true;
              at = neighbor(at.first, at.second + 3);
            }
          }
    for(std::size_t v = 0; v < fans.size(); ++v)
      if(fans[v] != 1)
        report(fans[v] == 0 ? "vertex without quad" : "several fans at a vertex", vertex(v));
  }

  // the boundary side that follows the boundary side (q, i)
  Side next_border(std::size_t q, int i) const
  {
    Side at(q, (i + 1) & 3);
    while(!is_border(at.first, at.second))
    {
      const Side other = neighbor(at.first, at.second);
      at = Side(other.first, (other.second + 1) & 3);
    }
    return at;
  }

  void check_topology()
  {
    Disjoint_sets sets(m_layout.points.size());
    for(std::size_t q = 0; q < number_of_quads(); ++q)
      for(int i = 0; i < 3; ++i)
        sets.unite(vertex(q, i), vertex(q, i + 1));
    std::map<std::size_t, long> twice_chi, loops;
    for(std::size_t v = 0; v < m_layout.points.size(); ++v)
      twice_chi[sets.find(v)] += 2;
    std::set<Side> borders;
    for(std::size_t q = 0; q < number_of_quads(); ++q)
    {
      long& twice = twice_chi[sets.find(vertex(q, 0))];
      twice += 2;
      for(int i = 0; i < 4; ++i)
      {
        twice -= is_border(q, i) ? 2 : 1;
        if(is_border(q, i))
          borders.insert(Side(q, i));
      }
    }
    while(!borders.empty())
    {
      Side side = *borders.begin();
      ++loops[sets.find(vertex(side.first, 0))];
      while(borders.erase(side) > 0)
        side = next_border(side.first, side.second);
    }
    Topology topology;
    for(const auto& component : twice_chi)
      topology.emplace_back(component.second / 2, loops[component.first]);
    std::sort(topology.begin(), topology.end());
    const Topology wanted = topology_of(m_mesh);
    if(topology.size() != wanted.size())
      report("number of components", count(topology.size(), wanted.size()));
    else
      for(std::size_t i = 0; i < wanted.size(); ++i)
      {
        if(topology[i].first != wanted[i].first)
          report("Euler characteristic", count(topology[i].first, wanted[i].first));
        if(topology[i].second != wanted[i].second)
          report("number of loops", count(topology[i].second, wanted[i].second));
      }
  }

  static std::string count(long number, long wanted)
  {
    return std::to_string(number) + " instead of " + std::to_string(wanted);
  }

  // At least three quads inside; two on the boundary, but for corners.
  void check_valences()
  {
    std::vector<int> valence(m_layout.points.size(), 0);
    m_is_border.assign(m_layout.points.size(), false);
    for(std::size_t q = 0; q < number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        ++valence[vertex(q, i)];
        if(is_border(q, i))
          m_is_border[vertex(q, i)] = m_is_border[vertex(q, i + 1)] = true;
      }
    for(std::size_t v = 0; v < valence.size(); ++v)
    {
      const std::string place = vertex(v) + " has " + std::to_string(valence[v]) + " quads";
      const bool is_corner = !m_layout.is_corner.empty() && m_layout.is_corner[v];
      if(!m_is_border[v] && valence[v] < 3)
        report("valence inside", place);
      if(m_is_border[v] && !is_corner && !m_layout.is_corner.empty() && valence[v] != 2)
        report("valence on the boundary", place);
      if(is_corner && !m_is_border[v])
        report("corner inside", place);
      m_extraordinary += (!m_is_border[v] && valence[v] != 4) ? 1 : 0;
    }
  }

  // Boundary vertices lie on the boundary of the mesh or on its curves.
  void check_boundary_points()
  {
    std::set<std::pair<std::size_t, std::size_t> > halfedges;
    for(const auto& t : m_mesh.triangles)
      for(std::size_t i = 0; i < 3; ++i)
        halfedges.emplace(t[i], t[(i + 1) % 3]);
    std::vector<std::pair<Point, Point> > edges;
    for(const auto& h : halfedges)
      if(!halfedges.count({h.second, h.first}))
        edges.emplace_back(m_mesh.points[h.first], m_mesh.points[h.second]);
    std::vector<bool> is_on_curve(m_layout.points.size(), false);
    for(std::size_t q = 0; q < m_layout.pieces.size(); ++q)
      for(int i = 0; i < 4; ++i)
        if(is_border(q, i) && m_layout.pieces[q][i].chain < m_chains.lengths.size())
        {
          const Quad_mesh::Piece& piece = m_layout.pieces[q][i];
          if(distance(m_chains.point(piece.chain, piece.first), m_layout.points[vertex(q, i)])
             <= exact * m_mesh.diameter)
            is_on_curve[vertex(q, i)] = true;
        }
    for(std::size_t v = 0; v < m_layout.points.size(); ++v)
      if(m_is_border[v] && !is_on_curve[v])
      {
        double least = m_mesh.diameter;
        for(const auto& edge : edges)
          least = (std::min)(least, distance_to_segment(m_layout.points[v], edge.first, edge.second));
        if(least > exact * m_mesh.diameter)
          report("boundary vertex off the boundary",
                 vertex(v) + " by " + number(least / m_mesh.diameter) + " D");
      }
  }

  // Each corner of the input is a corner of the layout.
  void check_corners()
  {
    std::size_t marked = 0;
    for(std::size_t v = 0; v < m_layout.is_corner.size(); ++v)
      marked += m_layout.is_corner[v] ? 1 : 0;
    if(!m_layout.is_corner.empty() && marked != m_mesh.corners.size())
      report("number of corners", count(marked, m_mesh.corners.size()));
    for(const std::size_t c : m_mesh.corners)
    {
      bool is_found = false;
      for(std::size_t v = 0; v < m_layout.points.size() && !is_found; ++v)
        is_found = m_is_border[v] && (m_layout.is_corner.empty() || m_layout.is_corner[v])
                   && distance(m_layout.points[v], m_mesh.points[c]) <= exact * m_mesh.diameter;
      if(!is_found)
        report("corner without layout vertex", "mesh vertex " + std::to_string(c));
    }
  }

  // The pieces of each chain follow each other in the order of the boundary and cover it once; the
  // vertices are where the pieces begin, as far as the mesh follows the curve.
  void check_boundary_cover()
  {
    std::vector<std::vector<Side> > sides(m_chains.lengths.size());
    for(std::size_t q = 0; q < number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
        if(is_border(q, i))
        {
          const std::size_t chain = m_layout.pieces[q][i].chain;
          if(chain >= sides.size())
            report("boundary side without chain", quad(q, i));
          else
            sides[chain].emplace_back(q, i);
        }
    for(std::size_t c = 0; c < sides.size(); ++c)
      check_chain(c, sides[c]);
  }

  const Quad_mesh::Piece& piece(const Side& side) const
  {
    return m_layout.pieces[side.first][side.second];
  }

  void check_chain(std::size_t c, std::vector<Side>& sides)
  {
    const std::string place = "chain " + std::to_string(c);
    const double length = m_chains.lengths[c], tolerance = almost_exact * length;
    if(sides.empty())
      return report("chain without side", place);
    std::sort(sides.begin(), sides.end(), [this](const Side& a, const Side& b)
      { return piece(a).first < piece(b).first; });
    for(std::size_t i = 0; i < sides.size(); ++i)
    {
      const Side side = sides[i], next = sides[(i + 1) % sides.size()];
      const bool is_last = i + 1 == sides.size();
      const double end = is_last && !m_chains.is_closed[c] ? length
                                                           : piece(next).first + is_last * length;
      if(!(piece(side).first < piece(side).last))
        report("boundary piece not increasing", quad(side.first, side.second));
      if(!(std::abs(piece(side).last - end) <= tolerance))
        report("boundary not covered once", quad(side.first, side.second) + " of " + place);
      if((!is_last || m_chains.is_closed[c]) && next_border(side.first, side.second) != next)
        report("order of boundary sides", quad(side.first, side.second) + " of " + place);
      const double gap = distance(m_chains.point(c, piece(side).first),
                                  m_layout.points[vertex(side.first, side.second)]);
      if(!(gap <= 2 * m_chains.distances[c] + almost_exact * m_mesh.diameter))
        report("boundary vertex at another place of its curve", quad(side.first, side.second));
    }
    if(!m_chains.is_closed[c] && !(std::abs(piece(sides[0]).first) <= tolerance))
      report("boundary not covered once", place + " at its begin");
  }

  Location locate(std::size_t q, double u, double v) const { return m_layout.inverse_map(q, u, v); }

  static std::pair<double, double> on_side(int i, double t)
  {
    const std::pair<double, double> places[] = {{t, 0}, {1, t}, {1 - t, 1}, {0, 1 - t}};
    return places[i & 3];
  }

  // The images are points of the mesh, agree with the vertices and with the neighbours, keep the
  // orientation, and together have the area of the mesh.
  void check_inverse_map()
  {
    for(std::size_t q = 0; q < number_of_quads(); ++q)
    {
      const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      for(int i = 0; i < 4; ++i)
      {
        const Location at = locate(q, corners[i][0], corners[i][1]);
        if(!check_location(q, at))
          return;
        if(distance(at.point, m_layout.points[vertex(q, i)]) > exact * m_mesh.diameter)
          report("vertex off its image", vertex(vertex(q, i)));
        check_continuity(q, i);
      }
    }
    // enough samples to see most triangles, and more where the map varies too much for these
    const double triangles_per_quad = double(m_mesh.triangles.size()) / double(number_of_quads());
    const double sampling_error = 0.1, most_samples = 1e6;
    int n = (std::max)(4, (std::min)(64, int(2 * std::sqrt(triangles_per_quad))));
    m_relative_area = sampled_area(n);
    while(!(std::abs(m_relative_area - 1) < sampling_error)
          && double(number_of_quads()) * n * n < most_samples)
      m_relative_area = sampled_area(n *= 2);
    // a place covered twice, or not at all
    if(!(std::abs(m_relative_area - 1) < sampling_error))
      report("area of the images", number(m_relative_area) + " of the area of the mesh");
  }

  // of the images, relative to the area of the mesh, by n x n samples per quad; checks these
  double sampled_area(int n)
  {
    double area = 0;
    for(std::size_t q = 0; q < number_of_quads(); ++q)
      for(int j = 0; j < n; ++j)
        for(int i = 0; i < n; ++i)
          area += check_orientation(q, (i + 0.45) / n, (j + 0.55) / n) / (n * n);
    return area / m_mesh.area();
  }

  bool check_location(std::size_t q, const Location& at)
  {
    if(at.face >= m_mesh.triangles.size())
    {
      report("image without face", quad(q));
      return false;
    }
    Point p = {{0, 0, 0}};
    double sum = 0;
    bool is_inside = true;
    for(std::size_t k = 0; k < 3; ++k)
    {
      p = p + at.barycentric[k] * m_mesh.points[m_mesh.triangles[at.face][k]];
      sum += at.barycentric[k];
      is_inside = is_inside && at.barycentric[k] > -almost_exact;
    }
    if(!is_inside || !(std::abs(sum - 1) < almost_exact))
      report("image outside of its face", quad(q));
    if(!(distance(p, at.point) <= almost_exact * m_mesh.diameter))
      report("image off the mesh", quad(q));
    return true;
  }

  void check_continuity(std::size_t q, int i)
  {
    if(is_border(q, i))
      return;
    const Side other = neighbor(q, i);
    const int samples = 5;
    for(int k = 0; k <= samples; ++k)
    {
      const auto here = on_side(i, double(k) / samples);
      const auto there = on_side(other.second, 1 - double(k) / samples);
      if(!(distance(locate(q, here.first, here.second).point,
                    locate(other.first, there.first, there.second).point)
           <= almost_exact * m_mesh.diameter))
        return report("images of neighbours apart", quad(q, i));
    }
  }

  // Checks the orientation by a small step in u and in v; returns the ratio of the areas of image
  // and quad. Steps that leave the face or cross a kink of the map are tried in the other
  // directions: where the map is reversed, all of them are. Longer steps serve only where all short
  // ones drown in rounding.
  double check_orientation(std::size_t q, double u, double v)
  {
    const double short_step = 1e-7, long_step = 1e-5;
    const Location at = locate(q, u, v);
    if(!check_location(q, at))
      return 0;
    for(const double step : {short_step, long_step})
    {
      const double ratio = signed_ratio(q, u, v, at, step);
      if(ratio < 0)
        report("orientation of the image", quad(q));
      if(ratio != 0)
        return std::abs(ratio) * norm(m_mesh.normal(at.face));
    }
    // between faces: what the step itself spans
    const Location b = locate(q, u + long_step, v), c = locate(q, u, v + long_step);
    return norm(cross(b.point - at.point, c.point - at.point)) / (long_step * long_step);
  }

  // The ratio of the areas, in barycentric coordinates, for the first direction in which it is
  // positive; else, for a direction in which it is negative; zero if rounding hides it everywhere.
  double signed_ratio(std::size_t q, double u, double v, const Location& at, double step) const
  {
    const double rounding = 1e-14; // of differences of barycentric coordinates
    double result = 0;
    for(const double du : {step, -step})
      for(const double dv : {du, -du})
      {
        const Location b = locate(q, u + du, v), c = locate(q, u, v + dv);
        if(at.face != b.face || at.face != c.face)
          continue;
        const Point db = b.barycentric - at.barycentric, dc = c.barycentric - at.barycentric;
        const double area = db[0] * dc[1] - db[1] * dc[0];
        if(std::abs(area) <= rounding * (norm(db) + norm(dc)))
          continue;
        result = area / (du * dv);
        if(result > 0)
          return result;
      }
    return result;
  }

  const Quad_mesh& m_layout;
  const Triangle_mesh& m_mesh;
  const Boundary_chains& m_chains;
  std::vector<bool> m_is_border;
  std::size_t m_extraordinary = 0;
  double m_relative_area = 0;
  std::vector<Defect> m_defects;
};

} // namespace Check

#endif // ROBUSTNESS_LAYOUT_CHECKER_H
