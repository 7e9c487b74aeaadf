// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Thousands of random refinements of small surfaces. After each, 16 functions must live on every
// regular Bezier element and sum up to one. On grids, where everything has global coordinates, the
// extensions of T-junctions are traced anew and compared pair by pair, and the surface is evaluated
// as the sum of all basis functions, by the recursion of Cox and de Boor; on small surfaces the
// rank of the whole basis is computed.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/T_NURCC_surface_3.h>

#include "T_NURCC_test_layouts.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

typedef CGAL::Simple_cartesian<double> K;
typedef CGAL::T_NURCC_surface_3<K> Surface;

namespace internal = CGAL::Surface_mesh_spline_conversion::internal;

// The control mesh of a surface on a grid of quads, in global coordinates (ticks)
class Plane_T_mesh
{
  typedef internal::Ticks Ticks;
  typedef std::array<Ticks, 2> Position;
  typedef Surface::Control_mesh Mesh;

  // from `low` to `high` along `axis`, at `position` of the other axis
  struct Segment
  {
    int axis;
    Ticks position, low, high;
  };

  struct T_junction
  {
    Position position;
    Position direction;
  };

  template <typename Index, typename Value>
  static Mesh::Property_map<Index, Value> property_map(const Mesh& mesh, const std::string& name)
  {
    const std::pair<Mesh::Property_map<Index, Value>, bool> found
      = mesh.property_map<Index, Value>(name);
    assert(found.second);
    return found.first;
  }

public:
  Plane_T_mesh(const Surface& surface, std::size_t number_of_columns)
    : m_number_of_columns(number_of_columns)
  {
    const Mesh& mesh = surface.control_mesh();
    const auto origin = property_map<Mesh::Face_index, internal::Face_origin>(mesh, "f:origin");
    const auto is_corner = property_map<Mesh::Halfedge_index, bool>(mesh, "h:corner");
    const auto length = property_map<Mesh::Edge_index, Ticks>(mesh, "e:length");
    m_vertices.resize(mesh.num_vertices());
    for(const auto f : mesh.faces())
    {
      Position p = {{0, 0}};
      int side = 0;
      static const int step[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
      for(const auto h : mesh.halfedges_around_face(mesh.halfedge(f)))
      {
        const Position start = p;
        for(std::size_t k = 0; k < 2; ++k)
          p[k] += step[side][k] * length[mesh.edge(h)];
        add_segment(global(origin[f], start), global(origin[f], p));
        m_vertices[mesh.target(h)] = global(origin[f], p);
        if(is_corner[h])
          ++side;
        else // the target lies inside a side
        {
          const int inward = (side + 1) & 3;
          const Position q = {{p[0] + step[inward][0], p[1] + step[inward][1]}};
          const Position a = global(origin[f], p), b = global(origin[f], q);
          m_junctions.push_back(T_junction{a, {{b[0] - a[0], b[1] - a[1]}}});
        }
      }
    }
  }

  std::size_t number_of_t_junctions() const { return m_junctions.size(); }

  // the largest distance between the surface and the sum of all basis functions, at some points of
  // all patches
  double largest_difference(const Surface& surface) const
  {
    std::vector<std::array<std::array<double, 5>, 2> > knots;
    for(const Position& p : m_vertices)
      knots.push_back({{local_knots(p, 0), local_knots(p, 1)}});
    double result = 0;
    for(std::size_t i = 0; i < surface.number_of_patches(); ++i)
    {
      const auto o = surface.patch_origin(i);
      for(const double s : {0.07, 0.47, 0.93}) // on no knot
      {
        const double u = o.u0 + s * (o.u1 - o.u0), v = o.v0 + (1 - 0.9 * s) * (o.v1 - o.v0);
        const double x = double(o.quad % m_number_of_columns) + u;
        const double y = double(o.quad / m_number_of_columns) + v;
        K::Vector_3 sum = CGAL::NULL_VECTOR;
        for(std::size_t k = 0; k < knots.size(); ++k)
        {
          const double weight = b_spline(knots[k][0], 0, 3, x) * b_spline(knots[k][1], 0, 3, y);
          if(weight != 0)
            sum = sum + weight * (surface.control_point(k) - CGAL::ORIGIN);
        }
        result = (std::max)(result, (surface.position(i, u, v) - (CGAL::ORIGIN + sum))
                                      .squared_length());
      }
    }
    return std::sqrt(result);
  }

  // the number of pairs of closed extensions that cross
  std::size_t number_of_crossings() const
  {
    std::vector<Segment> extensions;
    for(const T_junction& t : m_junctions)
    {
      const Position ahead = end(t.position, t.direction, 2);
      const Position behind = end(t.position, {{-t.direction[0], -t.direction[1]}}, 1);
      const int axis = t.direction[0] != 0 ? 0 : 1;
      extensions.push_back(Segment{axis, t.position[1 - axis], (std::min)(ahead[axis], behind[axis]),
                                   (std::max)(ahead[axis], behind[axis])});
    }
    std::size_t result = 0;
    for(const Segment& a : extensions)
      for(const Segment& b : extensions)
        if(a.axis == 0 && b.axis == 1 && a.low <= b.position && b.position <= a.high
           && b.low <= a.position && a.position <= b.high)
          ++result;
    return result;
  }

private:
  std::array<double, 5> local_knots(const Position& p, std::size_t axis) const
  {
    Position direction = {{0, 0}};
    direction[axis] = 1;
    const Position back = {{-direction[0], -direction[1]}};
    return {{internal::to_parameter(end(p, back, 2)[axis]),
             internal::to_parameter(end(p, back, 1)[axis]), internal::to_parameter(p[axis]),
             internal::to_parameter(end(p, direction, 1)[axis]),
             internal::to_parameter(end(p, direction, 2)[axis])}};
  }

  // the recursion of Cox and de Boor
  static double b_spline(const std::array<double, 5>& t, std::size_t i, std::size_t degree, double x)
  {
    if(x <= t[i] || x >= t[i + degree + 1])
      return 0;
    if(degree == 0)
      return 1;
    double result = 0;
    if(t[i + degree] > t[i])
      result += (x - t[i]) / (t[i + degree] - t[i]) * b_spline(t, i, degree - 1, x);
    if(t[i + degree + 1] > t[i + 1])
      result += (t[i + degree + 1] - x) / (t[i + degree + 1] - t[i + 1])
                * b_spline(t, i + 1, degree - 1, x);
    return result;
  }

  // from the frame of a face; 0-channels lie around the grid, one tick wide
  Position global(const internal::Face_origin& origin, const Position& p) const
  {
    const Ticks unit = internal::unit_ticks;
    const Ticks x0 = Ticks(origin.quad % m_number_of_columns) * unit;
    const Ticks y0 = Ticks(origin.quad / m_number_of_columns) * unit;
    if(origin.kind == internal::Face_origin::PATCH)
      return {{x0 + origin.first[0] + p[0], y0 + origin.first[1] + p[1]}};
    const Ticks x = (origin.kind == internal::Face_origin::CORNER ? -1 : origin.first[0]) + p[0];
    const Ticks y = p[1] - 1; // of row 0
    switch(origin.side)
    {
      case 0: return {{x0 + x, y0 + y}};
      case 1: return {{x0 + unit - y, y0 + x}};
      case 2: return {{x0 + unit - x, y0 + unit - y}};
      default: return {{x0 + y, y0 + unit - x}};
    }
  }

  void add_segment(const Position& a, const Position& b)
  {
    const int axis = a[0] != b[0] ? 0 : 1;
    assert(a[1 - axis] == b[1 - axis]);
    m_segments.push_back(Segment{axis, a[1 - axis], (std::min)(a[axis], b[axis]),
                                 (std::max)(a[axis], b[axis])});
  }

  // the point on a ray where it has met so many perpendicular segments or vertices, or the last one
  // that it meets
  Position end(Position p, const Position& direction, int steps) const
  {
    const int axis = direction[0] != 0 ? 0 : 1;
    for(int i = 0; i < steps; ++i)
    {
      Ticks nearest = 0;
      for(const Segment& s : m_segments)
        if(s.axis != axis && s.low <= p[1 - axis] && p[1 - axis] <= s.high)
        {
          const Ticks distance = (s.position - p[axis]) * direction[axis];
          if(distance > 0 && (nearest == 0 || distance < nearest))
            nearest = distance;
        }
      for(const Position& v : m_vertices) // those of row 0 may be on no perpendicular segment
        if(v[1 - axis] == p[1 - axis])
        {
          const Ticks distance = (v[axis] - p[axis]) * direction[axis];
          if(distance > 0 && (nearest == 0 || distance < nearest))
            nearest = distance;
        }
      p[axis] += direction[axis] * nearest;
    }
    return p;
  }

  std::size_t m_number_of_columns;
  std::vector<Segment> m_segments;
  std::vector<T_junction> m_junctions;
  std::vector<Position> m_vertices;
};

// The smallest eigenvalue of the mass matrix of the basis, sampled on all elements, with respect to
// its diagonal. It vanishes if the functions are linearly dependent.
double smallest_eigenvalue(const Surface& surface)
{
  const Eigen::Index n = static_cast<Eigen::Index>(surface.number_of_control_points());
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n);
  std::vector<Surface::Basis_function> basis;
  for(const auto& e : surface.bezier_elements(2))
    for(int k = 0; k < 25; ++k)
    {
      surface.basis(e.patch, e.u0 + (k % 5) * 0.25 * (e.u1 - e.u0),
                    e.v0 + (k / 5) * 0.25 * (e.v1 - e.v0), 0, basis);
      for(const auto& a : basis)
        for(const auto& b : basis)
          mass(Eigen::Index(a.control_point), Eigen::Index(b.control_point))
            += a.value[0] * b.value[0];
    }
  const Eigen::VectorXd scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  assert(scale.allFinite());
  mass = scale.asDiagonal() * mass * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(mass, Eigen::EigenvaluesOnly)
    .eigenvalues()[0];
}

// refines a few random patches in random directions, or random spans of the boundary
void refine_randomly(Surface& surface, std::mt19937& generator)
{
  if(generator() % 3 == 0)
  {
    std::vector<Surface::Boundary_span> spans;
    for(std::size_t c = 0; c < surface.number_of_boundary_chains(); ++c)
    {
      const auto knots = surface.boundary_curve(c).knots;
      for(std::size_t i = 0; i + 1 < knots.size(); ++i)
        if(knots[i] < knots[i + 1] && generator() % 8 == 0)
          spans.push_back({c, knots[i], knots[i + 1]});
    }
    surface.refine_boundary(spans);
    return;
  }
  std::vector<Surface::Patch_split> splits;
  for(unsigned int k = 0; k < 1 + generator() % 3; ++k)
  {
    const unsigned int directions = 1 + generator() % 3;
    splits.push_back({generator() % surface.number_of_patches(), (directions & 1) != 0,
                      (directions & 2) != 0});
  }
  surface.refine(splits);
}

struct Statistics
{
  std::size_t number_of_refinements = 0;
  std::size_t largest_number_of_patches = 0;
  double smallest_eigenvalue = 1;
};

// `number_of_columns` is that of a grid, else zero
void test_layout(Layout<K> layout, std::size_t number_of_columns, double share_of_corners,
                 unsigned int number_of_seeds, Statistics& statistics)
{
  constexpr std::size_t steps = 5, largest_rank = 250;
  for(unsigned int seed = 0; seed < number_of_seeds; ++seed)
  {
    std::mt19937 generator(seed);
    add_chains(layout, share_of_corners, generator);
    Surface surface(layout);
    assert(surface.error() == Surface::Error_code::OK && surface.is_valid());
    for(std::size_t step = 0; step < steps; ++step)
    {
      refine_randomly(surface, generator);
      assert(surface.is_valid());
      if(number_of_columns != 0)
        assert(Plane_T_mesh(surface, number_of_columns).number_of_crossings() == 0);
      ++statistics.number_of_refinements;
    }
    for(std::size_t i = 0; i < surface.number_of_control_points(); ++i)
      surface.set_control_point(i, surface.control_point(i)
                                   + K::Vector_3(0, 0, double(generator() % 100) / 100));
    if(number_of_columns != 0)
      assert(Plane_T_mesh(surface, number_of_columns).largest_difference(surface) < 1e-12);
    statistics.largest_number_of_patches
      = (std::max)(statistics.largest_number_of_patches, surface.number_of_patches());
    if(seed == 0 && surface.number_of_control_points() <= largest_rank)
      statistics.smallest_eigenvalue
        = (std::min)(statistics.smallest_eigenvalue, smallest_eigenvalue(surface));
  }
}

// the mesh in global coordinates has the same T-junctions as the surface
void test_number_of_t_junctions()
{
  Surface surface(grid_layout<K>(6, 6));
  assert(Plane_T_mesh(surface, 6).number_of_t_junctions() == 0);
  surface.refine(std::vector<Surface::Patch_split>{{14, true, true}});
  assert(Plane_T_mesh(surface, 6).number_of_t_junctions() == surface.number_of_t_junctions());
}

// the closure is local: what one marked patch costs in the middle of a grid
void test_spread()
{
  const Surface surface(grid_layout<K>(20, 20));
  for(const bool is_quadrisected : {false, true})
  {
    Surface refined = surface;
    for(int level = 0; level < 5; ++level)
    {
      const std::size_t before = refined.number_of_patches();
      refined.refine(std::vector<Surface::Patch_split>{{refined.patch_at(210, 0.3, 0.3), true,
                                                        is_quadrisected}});
      std::cout << refined.number_of_patches() - before << ' ';
      assert(refined.number_of_patches() - before <= 32);
    }
    std::cout << "patches added by one " << (is_quadrisected ? "quadrisection" : "bisection")
              << ", level by level\n";
    assert(refined.is_valid());
  }
}

int main()
{
  test_number_of_t_junctions();
  test_spread();
  Statistics statistics;
  for(const double share : {0., 0.4})
  {
    test_layout(grid_layout<K>(1, 1), 1, share, 20, statistics);
    test_layout(grid_layout<K>(3, 2), 3, share, 40, statistics);
    test_layout(grid_layout<K>(5, 5), 5, share, 20, statistics);
    for(const int n : {3, 5, 6, 7, 8})
      for(const int m : {1, 2, 3})
        test_layout(fan_layout<K>(n, m), 0, share, 12, statistics);
    test_layout(cubes_layout<K>(stairs(), true), 0, share, 10, statistics);
  }
  test_layout(cubes_layout<K>(stairs(), false), 0, 0, 10, statistics);
  test_layout(cubes_layout<K>(two_holes(), false), 0, 0, 10, statistics);
  std::cout << statistics.number_of_refinements << " refinements, up to "
            << statistics.largest_number_of_patches << " patches, smallest eigenvalue "
            << statistics.smallest_eigenvalue << std::endl;
  assert(statistics.smallest_eigenvalue > 1e-6);
  return EXIT_SUCCESS;
}
