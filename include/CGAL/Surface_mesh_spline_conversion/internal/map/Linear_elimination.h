// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_LINEAR_ELIMINATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_LINEAR_ELIMINATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <boost/integer/common_factor_rt.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Exact elimination of linear equations with integer coefficients over many variables, most of
// which occur in short equations only. Dependent variables are kept as rational rows in terms of
// others, which are substituted lazily.
class Linear_elimination
{
public:
  typedef std::int64_t Integer;
  typedef std::vector<std::pair<int, Integer> > Terms; // (variable, coefficient)

  // the variable is (sum of terms + constant) / denominator
  struct Row
  {
    Terms terms;
    Integer constant = 0;
    Integer denominator = 1;
  };

  enum Result { ADDED, REDUNDANT, CONTRADICTION };

  // variables of small weight are eliminated first
  explicit Linear_elimination(std::vector<int> weights)
    : m_weight(std::move(weights)), m_row(m_weight.size()), m_is_dependent(m_weight.size(), 0)
  {}

  bool is_dependent(int variable) const { return m_is_dependent[variable] != 0; }

  // `false` if numbers got too large for an exact elimination
  bool is_exact() const { return m_is_exact; }

  // adds the equation variable = sum of terms, for a variable that occurs nowhere yet
  void substitute(int variable, Terms terms)
  {
    m_row[variable].terms = std::move(terms);
    m_is_dependent[variable] = 1;
  }

  // adds the equation: sum of terms + constant = 0
  Result add_equation(const Terms& terms, Integer constant)
  {
    Row row;
    row.terms = terms;
    row.constant = constant;
    row = substituted(row);
    if(row.terms.empty())
      return row.constant == 0 ? REDUNDANT : CONTRADICTION;
    const std::size_t i = pivot(row.terms);
    const int variable = row.terms[i].first;
    Integer divisor = -row.terms[i].second;
    row.terms.erase(row.terms.begin() + i);
    if(divisor < 0)
    {
      for(std::pair<int, Integer>& term : row.terms)
        term.second = -term.second;
      row.constant = -row.constant;
      divisor = -divisor;
    }
    row.denominator = divisor;
    reduce(row);
    m_row[variable] = std::move(row);
    m_is_dependent[variable] = 1;
    return ADDED;
  }

  // the row of a dependent variable in terms of free variables
  const Row& resolved_row(int variable)
  {
    resolve(variable);
    return m_row[variable];
  }

private:
  static constexpr Integer largest_number = Integer(1) << 30;

  // the cheapest variable; among these a coefficient of one keeps denominators small
  std::size_t pivot(const Terms& terms) const
  {
    std::size_t best = 0;
    for(std::size_t i = 1; i < terms.size(); ++i)
      if(cost(terms[i]) < cost(terms[best]))
        best = i;
    return best;
  }

  std::pair<int, Integer> cost(const std::pair<int, Integer>& term) const
  {
    return std::make_pair(m_weight[term.first], std::abs(term.second));
  }

  bool needs_substitution(const Row& row) const
  {
    return std::any_of(row.terms.begin(), row.terms.end(),
      [this](const std::pair<int, Integer>& term) { return is_dependent(term.first); });
  }

  // makes the row of a variable free of dependent variables, rows it depends on first; an explicit
  // stack because chains along the boundary may be long
  void resolve(int variable)
  {
    std::vector<int> stack(1, variable);
    while(!stack.empty())
    {
      const int v = stack.back();
      bool is_ready = true;
      for(const std::pair<int, Integer>& term : m_row[v].terms)
        if(is_dependent(term.first) && needs_substitution(m_row[term.first]))
        {
          stack.push_back(term.first);
          is_ready = false;
        }
      if(!is_ready)
        continue;
      if(needs_substitution(m_row[v]))
        m_row[v] = combined(m_row[v]);
      stack.pop_back();
    }
  }

  Row substituted(const Row& row)
  {
    for(const std::pair<int, Integer>& term : row.terms)
      if(is_dependent(term.first))
        resolve(term.first);
    return combined(row);
  }

  // replaces dependent variables, whose rows are resolved
  Row combined(const Row& row)
  {
    Integer multiple = 1;
    for(const std::pair<int, Integer>& term : row.terms)
      if(is_dependent(term.first))
        multiple = boost::integer::lcm(multiple, m_row[term.first].denominator);
    Row sum;
    sum.denominator = row.denominator * multiple;
    sum.constant = row.constant * multiple;
    for(const std::pair<int, Integer>& term : row.terms)
    {
      if(!is_dependent(term.first))
      {
        sum.terms.emplace_back(term.first, term.second * multiple);
        continue;
      }
      const Row& other = m_row[term.first];
      const Integer factor = term.second * (multiple / other.denominator);
      for(const std::pair<int, Integer>& t : other.terms)
        sum.terms.emplace_back(t.first, t.second * factor);
      sum.constant += other.constant * factor;
    }
    collect(sum.terms);
    reduce(sum);
    return sum;
  }

  // adds up the terms of each variable
  static void collect(Terms& terms)
  {
    std::sort(terms.begin(), terms.end());
    std::size_t n = 0;
    for(std::size_t i = 0; i < terms.size();)
    {
      std::pair<int, Integer> term(terms[i].first, 0);
      for(; i < terms.size() && terms[i].first == term.first; ++i)
        term.second += terms[i].second;
      if(term.second != 0)
        terms[n++] = term;
    }
    terms.resize(n);
  }

  void reduce(Row& row)
  {
    Integer divisor = boost::integer::gcd(row.denominator, row.constant);
    for(const std::pair<int, Integer>& term : row.terms)
      divisor = boost::integer::gcd(divisor, term.second);
    if(divisor > 1)
    {
      row.denominator /= divisor;
      row.constant /= divisor;
      for(std::pair<int, Integer>& term : row.terms)
        term.second /= divisor;
    }
    if(row.denominator > largest_number)
      m_is_exact = false;
    for(const std::pair<int, Integer>& term : row.terms)
      if(std::abs(term.second) > largest_number)
        m_is_exact = false;
  }

  std::vector<int> m_weight;
  std::vector<Row> m_row;
  std::vector<char> m_is_dependent;
  bool m_is_exact = true;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_LINEAR_ELIMINATION_H
