// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_SEAM_EQUATIONS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_SEAM_EQUATIONS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Cut_graph.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Linear_elimination.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Seamless_map.h>

#include <boost/integer/common_factor_rt.hpp>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// All maps that satisfy the linear equations of a seamless map: the scalar `2 * wedge + component`
// is (sum of numerator * free variable + constant) / denominator. Row r owns the entries from
// start[r] to start[r + 1].
struct Map_space
{
  std::vector<int> start, column;
  std::vector<std::int64_t> numerator;
  std::vector<std::int64_t> constant;
  std::int64_t denominator = 1;
  std::vector<int> free_scalar;        // per free variable: the scalar that it is

  int number_of_scalars() const { return static_cast<int>(constant.size()); }
  int number_of_free_variables() const { return static_cast<int>(free_scalar.size()); }
};

// Sets up and eliminates the equations: transitions across cuts, alignment of the boundary,
// prescribed integer differences, and one fixed point per component. Elimination instead of
// penalties makes every map exactly seamless and aligned.
class Seam_equations
{
public:
  // `constant_component[h]` of a boundary halfedge: 0 if u, 1 if v is constant along it
  Seam_equations(const Working_mesh& mesh, const Cut_graph& cut,
                 const std::vector<int>& constant_component)
    : m_mesh(mesh), m_cut(cut), m_elimination(weights(cut))
  {
    add_transitions_along_branches();
    for(int h = 0; h < mesh.number_of_halfedges(); ++h)
      if(mesh.is_border(h))
        align(h, constant_component[h]);
    for(const std::vector<int>& branch : cut.branches())
    {
      add_transition(branch.front(), branch.front(),
                     Working_mesh::next(mesh.opposite[branch.front()]));
      add_transition(branch.back(), Working_mesh::next(branch.back()),
                     mesh.opposite[branch.back()]);
    }
  }

  // returns `false` if the constraint contradicts the others
  bool add_constraint(const Integer_constraint& constraint)
  {
    Point_terms terms = point(constraint.to_corner);
    for(auto h = constraint.path.rbegin(); h != constraint.path.rend(); ++h)
      pull_back(*h, terms);
    subtract(terms, point(constraint.from_corner));
    for(int i = 0; i < 2; ++i)
      if(m_elimination.add_equation(terms[i], -constraint.difference[i])
         == Linear_elimination::CONTRADICTION)
        return false;
    return true;
  }

  // fixes the place of a corner: the first of each connected component removes its translations
  void pin(int corner)
  {
    const Point_terms terms = point(corner);
    for(int i = 0; i < 2; ++i)
      m_elimination.add_equation(terms[i], 0);
  }

  // returns `false` if the numbers got too large
  bool solve(Map_space& space)
  {
    const int n = 2 * m_cut.number_of_wedges();
    const std::vector<int> number = number_free_variables(space);
    space.denominator = common_denominator(n);
    if(space.denominator > largest_denominator)
      return false;
    space.start.assign(1, 0);
    for(int i = 0; i < n; ++i)
    {
      if(!m_elimination.is_dependent(i))
        append_row(space, Linear_elimination::Terms(1, std::make_pair(i, 1)), 0, 1, number);
      else
      {
        const Linear_elimination::Row& row = m_elimination.resolved_row(i);
        append_row(space, row.terms, row.constant, row.denominator, number);
      }
    }
    return m_elimination.is_exact();
  }

private:
  typedef Linear_elimination::Terms Terms;
  typedef std::array<Terms, 2> Point_terms; // u and v of a point

  static constexpr std::int64_t largest_denominator = std::int64_t(1) << 20;

  // Translations of long branches occur in many rows and stay free, short ones are eliminated. This
  // order decides the sparsity of everything that follows.
  static std::vector<int> weights(const Cut_graph& cut)
  {
    const int wedge_weight = 2, weight_per_edge = 3;
    std::vector<int> weights(2 * cut.number_of_wedges(), wedge_weight);
    for(const std::vector<int>& branch : cut.branches())
      weights.insert(weights.end(), 2, 1 + weight_per_edge * static_cast<int>(branch.size()));
    return weights;
  }

  static Point_terms variables(int first)
  {
    return {{Terms(1, std::make_pair(first, 1)), Terms(1, std::make_pair(first + 1, 1))}};
  }

  Point_terms point(int corner) const { return variables(2 * m_cut.wedge(corner)); }

  Point_terms translation(int h) const
  {
    return variables(2 * m_cut.number_of_wedges() + 2 * m_cut.branch(h));
  }

  static void negate(Terms& terms)
  {
    for(std::pair<int, Linear_elimination::Integer>& term : terms)
      term.second = -term.second;
  }

  static void turn(int quarter_turns, Point_terms& p)
  {
    for(int i = quarter_turns & 3; i > 0; --i)
    {
      std::swap(p[0], p[1]);
      negate(p[0]);
    }
  }

  static void add(Point_terms& a, const Point_terms& b)
  {
    for(int i = 0; i < 2; ++i)
      a[i].insert(a[i].end(), b[i].begin(), b[i].end());
  }

  static void subtract(Point_terms& a, Point_terms b)
  {
    negate(b[0]);
    negate(b[1]);
    add(a, b);
  }

  // from the chart behind `h` to the chart of the face of `h`
  void pull_back(int h, Point_terms& p) const
  {
    if(m_cut.branch(h) < 0)
      return;
    if(m_cut.is_forward(h))
    {
      subtract(p, translation(h));
      turn(-m_cut.rotation()[h], p);
      return;
    }
    turn(m_cut.rotation()[m_mesh.opposite[h]], p);
    add(p, translation(h));
  }

  // the image of a corner under the transition of the forward halfedge `h`
  Point_terms transition(int h, int corner) const
  {
    Point_terms image = point(corner);
    turn(m_cut.rotation()[h], image);
    add(image, translation(h));
    return image;
  }

  // the corners on the far side of the inner vertices of branches occur in no other equation
  void add_transitions_along_branches()
  {
    for(const std::vector<int>& branch : m_cut.branches())
      for(std::size_t i = 0; i + 1 < branch.size(); ++i)
      {
        const Point_terms image = transition(branch[i], Working_mesh::next(branch[i]));
        const int far = 2 * m_cut.wedge(m_mesh.opposite[branch[i]]);
        m_elimination.substitute(far, image[0]);
        m_elimination.substitute(far + 1, image[1]);
      }
  }

  void add_transition(int h, int corner, int opposite_corner)
  {
    Point_terms terms = transition(h, corner);
    subtract(terms, point(opposite_corner));
    m_elimination.add_equation(terms[0], 0);
    m_elimination.add_equation(terms[1], 0);
  }

  void align(int h, int component)
  {
    const Terms terms{{2 * m_cut.wedge(h) + component, 1},
                      {2 * m_cut.wedge(Working_mesh::next(h)) + component, -1}};
    m_elimination.add_equation(terms, 0);
  }

  // free variables that occur in scalars, in the order of their indices
  std::vector<int> number_free_variables(Map_space& space)
  {
    const int n = 2 * m_cut.number_of_wedges();
    std::vector<int> number(n + 2 * m_cut.branches().size(), -1);
    std::vector<char> is_used(number.size(), 0);
    for(int i = 0; i < n; ++i)
      if(!m_elimination.is_dependent(i))
        is_used[i] = 1;
      else
        for(const std::pair<int, std::int64_t>& term : m_elimination.resolved_row(i).terms)
          is_used[term.first] = 1;
    for(std::size_t i = 0; i < number.size(); ++i)
      if(is_used[i])
      {
        number[i] = space.number_of_free_variables();
        space.free_scalar.push_back(static_cast<int>(i));
      }
    return number;
  }

  std::int64_t common_denominator(int n)
  {
    std::int64_t denominator = 1;
    for(int i = 0; i < n && denominator <= largest_denominator; ++i)
      if(m_elimination.is_dependent(i))
        denominator
          = boost::integer::lcm(denominator, m_elimination.resolved_row(i).denominator);
    return denominator;
  }

  static void append_row(Map_space& space, const Terms& terms, std::int64_t constant,
                         std::int64_t denominator, const std::vector<int>& number)
  {
    const std::int64_t factor = space.denominator / denominator;
    for(const std::pair<int, std::int64_t>& term : terms)
    {
      space.column.push_back(number[term.first]);
      space.numerator.push_back(term.second * factor);
    }
    space.constant.push_back(constant * factor);
    space.start.push_back(static_cast<int>(space.column.size()));
  }

  const Working_mesh& m_mesh;
  const Cut_graph& m_cut;
  Linear_elimination m_elimination;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_SEAM_EQUATIONS_H
