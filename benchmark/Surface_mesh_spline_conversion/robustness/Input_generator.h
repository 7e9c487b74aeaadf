// Generates open meshes as they come from volumes of voxels: trusses, tubes and plates of genus 0
// to 6 that end at the walls of a box, with noise and slivers. Same number, same mesh.
#ifndef ROBUSTNESS_INPUT_GENERATOR_H
#define ROBUSTNESS_INPUT_GENERATOR_H

#include "Layout_checker.h"
#include "Plain_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace Check {

// Positive inside, about the distance from the surface near it.
typedef std::function<double(const Point&)> Implicit_shape;

// Numbers that are the same on each platform.
class Random_numbers
{
public:
  explicit Random_numbers(std::size_t seed) : m_engine(static_cast<std::uint32_t>(seed)) {}

  double real(double first, double last)
  {
    const double range = 4294967296.;
    return first + (last - first) * (double(m_engine()) / range);
  }

  // one of first, ..., last
  int integer(int first, int last) { return first + int(m_engine() % unsigned(last - first + 1)); }

private:
  std::mt19937 m_engine;
};

struct Bar
{
  Point source, target;
};

// the union of round bars, blended where they meet
inline Implicit_shape union_of_bars(const std::vector<Bar>& bars, double radius)
{
  const double sharpness = 6 / radius;
  return [bars, radius, sharpness](const Point& p)
  {
    double sum = 0;
    for(const Bar& bar : bars)
      sum += std::exp(-sharpness * (distance_to_segment(p, bar.source, bar.target) - radius));
    return std::log(sum + 1e-300) / sharpness;
  };
}

// a point from which bars leave the box at the wall `w` of 0, ..., 5
inline Point beyond_wall(int w, const Point& p)
{
  Point outside = p;
  outside[std::size_t(w / 2)] = (w % 2 == 0) ? -2 : 2;
  return outside;
}

// a frame between the corners of a cube, with stubs through the walls
inline Implicit_shape make_truss(Random_numbers& random, double radius)
{
  const double half_width = 0.5, jitter = 0.08;
  const int edges[12][2] = {{0, 1}, {1, 3}, {3, 2}, {0, 4}, {4, 5}, {5, 7}, {7, 6},
                            {2, 6}, {0, 2}, {1, 5}, {3, 7}, {4, 6}};
  Point nodes[8];
  for(int i = 0; i < 8; ++i)
    for(int d = 0; d < 3; ++d)
      nodes[i][std::size_t(d)]
        = ((i >> d) & 1 ? half_width : -half_width) + random.real(-jitter, jitter);
  std::vector<Bar> bars;
  // the first seven edges form a path through all corners, each further edge adds a handle
  const int number_of_edges = 7 + random.integer(0, 5);
  for(int e = 0; e < number_of_edges; ++e)
    bars.push_back({nodes[edges[e][0]], nodes[edges[e][1]]});
  const int number_of_stubs = random.integer(1, 6);
  for(int s = 0; s < number_of_stubs; ++s)
  {
    const int node = random.integer(0, 7), axis = random.integer(0, 2);
    bars.push_back({nodes[node], beyond_wall(2 * axis + ((node >> axis) & 1), nodes[node])});
  }
  return union_of_bars(bars, radius);
}

// a bent tube through the box, with branches
inline Implicit_shape make_tube(Random_numbers& random, double radius)
{
  const auto inner_point = [&random]()
  { return Point{{random.real(-.55, .55), random.real(-.55, .55), random.real(-.55, .55)}}; };
  std::vector<Point> knees(std::size_t(random.integer(1, 3)));
  std::generate(knees.begin(), knees.end(), inner_point);
  std::vector<Bar> bars = {{knees.front(), beyond_wall(0, knees.front())},
                           {knees.back(), beyond_wall(1, knees.back())}};
  for(std::size_t i = 0; i + 1 < knees.size(); ++i)
    bars.push_back({knees[i], knees[i + 1]});
  const int number_of_branches = random.integer(0, 3);
  for(int b = 0; b < number_of_branches; ++b)
  {
    const Point& knee = knees[std::size_t(random.integer(0, int(knees.size()) - 1))];
    bars.push_back({knee, beyond_wall(random.integer(2, 5), knee)});
  }
  return union_of_bars(bars, radius);
}

// a wavy plate with round holes
inline Implicit_shape make_plate(Random_numbers& random, double half_thickness)
{
  const double height = random.real(0, 0.3), a = random.real(1, 3), b = random.real(1, 3);
  const int number_of_holes = random.integer(0, 7);
  std::vector<Point> holes; // (x, y, radius) on a grid of three by three, so that they are apart
  for(int k = 0; k < number_of_holes; ++k)
  {
    const int cell = (4 * k + 2) % 9;
    holes.push_back({{0.6 * (cell % 3 - 1) + random.real(-.04, .04),
                      0.6 * (cell / 3 - 1) + random.real(-.04, .04), random.real(.12, .18)}});
  }
  const double sharpness = 6 / half_thickness;
  return [=](const Point& p)
  {
    const double middle = height * std::sin(a * p[0]) * std::cos(b * p[1]);
    double sum = std::exp(sharpness * (p[2] - middle - half_thickness))
                 + std::exp(sharpness * (middle - p[2] - half_thickness));
    for(const Point& hole : holes)
      sum += std::exp(sharpness * (hole[2] - std::hypot(p[0] - hole[0], p[1] - hole[1])));
    return -std::log(sum) / sharpness;
  };
}

// Marching tetrahedra in the box [-1,1]^3. The vertices lie on the surface up to rounding, also
// those at the walls; noise moves the others along the edges of the grid.
class Marching_tetrahedra
{
public:
  // `noise`, `sliver`: relative to the step of the grid
  Marching_tetrahedra(const Implicit_shape& shape, int cells, double noise, double sliver,
                      Random_numbers& random)
    : m_shape(shape), m_cells(cells), m_step(2. / cells)
  {
    const int n = cells + 1;
    for(int k = 0; k < n; ++k)
      for(int j = 0; j < n; ++j)
        for(int i = 0; i < n; ++i)
        {
          m_nodes.push_back({{-1 + m_step * i, -1 + m_step * j, -1 + m_step * k}});
          m_noise.push_back(is_near_wall({{i, j, k}}) ? 0 : noise * m_step * random.real(-1, 1));
          const double share_of_slivers = 0.05;
          if(random.real(0, 1) < share_of_slivers && sliver > 0)
            approach_surface({{i, j, k}}, sliver * m_step);
          m_values.push_back(m_shape(m_nodes.back()) + m_noise.back());
        }
  }

  Triangle_mesh operator()()
  {
    // the six tetrahedra of a cell share its diagonal
    const int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7},
                                  {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}};
    for(int k = 0; k < m_cells; ++k)
      for(int j = 0; j < m_cells; ++j)
        for(int i = 0; i < m_cells; ++i)
          for(const auto& t : tetrahedra)
          {
            std::array<std::size_t, 4> nodes;
            for(std::size_t a = 0; a < 4; ++a)
              nodes[a] = node(i + (t[a] & 1), j + ((t[a] >> 1) & 1), k + (t[a] >> 2));
            march(nodes);
          }
    return std::move(m_mesh);
  }

private:
  std::size_t node(int i, int j, int k) const
  {
    return std::size_t((k * (m_cells + 1) + j) * (m_cells + 1) + i);
  }

  bool is_near_wall(const std::array<int, 3>& index) const
  {
    for(int i : index)
      if(i < 2 || i > m_cells - 2)
        return true;
    return false;
  }

  // Moves the last node to the given distance from the surface if it is close to it already; nodes
  // of walls stay in them. Around it there will be triangles of about that size.
  void approach_surface(const std::array<int, 3>& index, double distance)
  {
    Point p = m_nodes.back();
    const double reach = 0.25 * m_step, offset = m_shape(p) > 0 ? distance : -distance;
    for(int iteration = 0; iteration < 20; ++iteration)
    {
      Point gradient;
      const double difference = 1e-3 * m_step;
      for(std::size_t d = 0; d < 3; ++d)
      {
        Point q = p;
        q[d] += difference;
        const bool is_on_wall = index[d] == 0 || index[d] == m_cells;
        gradient[d] = is_on_wall ? 0 : (m_shape(q) - m_shape(p)) / difference;
      }
      p = p - ((m_shape(p) - offset) / (dot(gradient, gradient) + 1e-12)) * gradient;
    }
    if(Check::distance(p, m_nodes.back()) < reach)
    {
      m_nodes.back() = p;
      m_noise.back() = 0;
    }
  }

  // the vertex on the edge between two nodes on different sides
  std::size_t vertex(std::size_t a, std::size_t b)
  {
    if(a > b)
      std::swap(a, b);
    const auto inserted = m_vertices.emplace(std::make_pair(a, b), m_mesh.points.size());
    if(!inserted.second)
      return inserted.first->second;
    double inside = m_values[a] > 0 ? 0 : 1, outside = 1 - inside;
    const Point p = m_nodes[a], d = m_nodes[b] - m_nodes[a];
    for(int bisection = 0; bisection < 60; ++bisection)
    {
      const double t = (inside + outside) / 2;
      const double value = m_shape(p + t * d) + (1 - t) * m_noise[a] + t * m_noise[b];
      (value > 0 ? inside : outside) = t;
    }
    m_mesh.points.push_back(p + ((inside + outside) / 2) * d);
    return inserted.first->second;
  }

  // the triangles in one tetrahedron, with their normals away from the nodes inside
  void march(const std::array<std::size_t, 4>& nodes)
  {
    std::vector<std::size_t> order; // the nodes inside come first
    int inversions = 0;
    for(const bool is_inside : {true, false})
      for(std::size_t i = 0; i < 4; ++i)
        if((m_values[nodes[i]] > 0) == is_inside)
        {
          for(const std::size_t j : order)
            inversions += j > i ? 1 : 0;
          order.push_back(i);
        }
    std::size_t n[4];
    for(std::size_t i = 0; i < 4; ++i)
      n[i] = nodes[order[i]];
    const bool is_odd = inversions % 2 == 1;
    const auto number_inside = std::count_if(nodes.begin(), nodes.end(), [this](std::size_t i)
      { return m_values[i] > 0; });
    if(number_inside == 1)
      add_triangle(vertex(n[0], n[1]), vertex(n[0], n[2]), vertex(n[0], n[3]), is_odd);
    else if(number_inside == 3)
      add_triangle(vertex(n[0], n[3]), vertex(n[1], n[3]), vertex(n[2], n[3]), is_odd);
    else if(number_inside == 2)
    {
      const std::size_t a = vertex(n[0], n[2]), c = vertex(n[1], n[3]);
      add_triangle(a, vertex(n[0], n[3]), c, is_odd);
      add_triangle(a, c, vertex(n[1], n[2]), is_odd);
    }
  }

  void add_triangle(std::size_t a, std::size_t b, std::size_t c, bool do_reverse)
  {
    if(do_reverse)
      std::swap(b, c);
    m_mesh.triangles.push_back({{a, b, c}});
  }

  const Implicit_shape& m_shape;
  int m_cells;
  double m_step;
  std::vector<Point> m_nodes;
  std::vector<double> m_noise, m_values;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> m_vertices; // by the ends of the edge
  Triangle_mesh m_mesh;
};

// the connected component with the most triangles
inline Triangle_mesh largest_component(const Triangle_mesh& mesh)
{
  Disjoint_sets sets(mesh.points.size());
  for(const auto& t : mesh.triangles)
  {
    sets.unite(t[0], t[1]);
    sets.unite(t[0], t[2]);
  }
  std::map<std::size_t, std::size_t> sizes;
  for(const auto& t : mesh.triangles)
    ++sizes[sets.find(t[0])];
  std::size_t largest = 0;
  for(const auto& component : sizes)
    if(!sizes.count(largest) || component.second > sizes[largest])
      largest = component.first;
  Triangle_mesh result;
  std::map<std::size_t, std::size_t> copied;
  for(auto t : mesh.triangles)
    if(sets.find(t[0]) == largest)
    {
      for(std::size_t& v : t)
      {
        const auto inserted = copied.emplace(v, result.points.size());
        if(inserted.second)
          result.points.push_back(mesh.points[v]);
        v = inserted.first->second;
      }
      result.triangles.push_back(t);
    }
  return result;
}

// Generates a connected open mesh of genus 0 to 6; `description` says what it is.
inline Triangle_mesh generate_mesh(std::size_t seed, std::string& description)
{
  Random_numbers random(seed);
  for(;;)
  {
    const char* const kinds[] = {"truss", "tube", "plate"};
    const std::size_t kind = seed % 3;
    // three steps of the grid across bars and plates at least
    const double size = kind == 2 ? random.real(.1, .18) : random.real(.16, .26);
    const int cells = int(std::ceil(3 / size)) + random.integer(0, 8);
    const Implicit_shape shape = kind == 0 ? make_truss(random, size)
                               : kind == 1 ? make_tube(random, size) : make_plate(random, size);
    const double noise = random.integer(0, 2) * 0.05;
    const double slivers[] = {0, 1e-2, 1e-4, 1e-6};
    const double sliver = slivers[random.integer(0, 3)];
    const Triangle_mesh mesh
      = largest_component(Marching_tetrahedra(shape, cells, noise, sliver, random)());
    const Topology topology = topology_of(mesh);
    const long least_genus = 0, largest_genus = 6;
    const long genus = topology.size() == 1
                       ? (2 - topology[0].second - topology[0].first) / 2 : least_genus - 1;
    if(genus < least_genus || genus > largest_genus || topology[0].second == 0)
      continue;
    char text[128];
    std::snprintf(text, sizeof text, "%s, genus %ld, %ld loops, %zu triangles, noise %g, sliver %g",
                  kinds[kind], genus, topology[0].second, mesh.triangles.size(), noise, sliver);
    description = text;
    return mesh;
  }
}

inline bool write_OFF(const std::string& filename, const Triangle_mesh& mesh)
{
  std::ofstream out(filename);
  out.precision(17);
  out << "OFF\n" << mesh.points.size() << ' ' << mesh.triangles.size() << " 0\n";
  for(const Point& p : mesh.points)
    out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for(const auto& t : mesh.triangles)
    out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.flush().good();
}

} // namespace Check

#endif // ROBUSTNESS_INPUT_GENERATOR_H
