// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_UNPIVOTED_LU_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_UNPIVOTED_LU_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Eigen/Core>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Factorises a sparse matrix whose pattern is symmetric, but whose values are not, without a choice
// of pivots: for diagonally dominant matrices, which need none. Row by row, as a Cholesky
// factorisation with one pattern for both factors, which is several times faster than one that has
// to be ready for other pivots.
class Unpivoted_lu
{
public:
  // `matrix`: with all diagonal entries, and with both or none of two opposite ones
  explicit Unpivoted_lu(const Eigen::SparseMatrix<double>& matrix)
    : m_n(static_cast<int>(matrix.cols())), m_position(m_n), m_columns(m_n), m_pivot(m_n, 0.)
  {
    Eigen::AMDOrdering<int>::PermutationType order;
    Eigen::AMDOrdering<int>()(matrix, order);
    for(int i = 0; i < m_n; ++i)
      m_position[order.indices()[i]] = i;
    factorize(matrix, order.indices());
  }

  // Is there no pivot of zero?
  bool is_regular() const
  {
    return std::all_of(m_pivot.begin(), m_pivot.end(), [](double p)
      { return p != 0 && std::isfinite(p); });
  }

  // for one or more right hand sides. \pre `is_regular()`
  template <typename Right>
  Right solve(const Right& right) const
  {
    Right x(right.rows(), right.cols());
    for(int i = 0; i < m_n; ++i)
      x.row(m_position[i]) = right.row(i);
    for(int k = 0; k < m_n; ++k)
      for(const Entry& e : m_columns[k])
        x.row(e.index) -= e.lower * x.row(k);
    for(int k = m_n - 1; k >= 0; --k)
    {
      for(const Entry& e : m_columns[k])
        x.row(k) -= e.upper * x.row(e.index);
      x.row(k) /= m_pivot[k];
    }
    Right result(right.rows(), right.cols());
    for(int i = 0; i < m_n; ++i)
      result.row(i) = x.row(m_position[i]);
    return result;
  }

private:
  // in a column of the lower factor, whose diagonal is one, and in the row of the upper one
  struct Entry
  {
    int index;
    double lower, upper;
  };

  template <typename Order>
  void factorize(const Eigen::SparseMatrix<double>& matrix, const Order& order)
  {
    const Eigen::SparseMatrix<double> transposed = matrix.transpose();
    std::vector<int> parent(m_n, -1), last_visit(m_n, -1), pattern, path;
    std::vector<double> row(m_n, 0.), column(m_n, 0.); // of the present index, before its diagonal
    for(int i = 0; i < m_n; ++i)
    {
      last_visit[i] = i;
      pattern.clear();
      for_each_entry(matrix, order[i], [&](int k, double value)
      {
        column[k] = value;
        find_path(k, i, parent, last_visit, path);
        pattern.insert(pattern.end(), path.rbegin(), path.rend());
      });
      for_each_entry(transposed, order[i], [&](int k, double value) { row[k] = value; });
      // later paths end where earlier ones begin
      std::reverse(pattern.begin(), pattern.end());
      eliminate(i, pattern, row, column);
    }
  }

  // visits the entries before the diagonal in a column of the matrix, and adds those on it
  template <typename Function>
  void for_each_entry(const Eigen::SparseMatrix<double>& matrix, int column, Function function)
  {
    const int i = m_position[column];
    for(Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry)
    {
      const int k = m_position[entry.row()];
      if(k < i)
        function(k, entry.value());
      else if(k == i)
        m_pivot[i] = entry.value();
    }
  }

  // the way up the elimination tree from `k` to what has been visited for index `i`
  static void find_path(int k, int i, std::vector<int>& parent, std::vector<int>& last_visit,
                        std::vector<int>& path)
  {
    path.clear();
    for(; last_visit[k] != i; k = parent[k])
    {
      last_visit[k] = i;
      path.push_back(k);
      if(parent[k] < 0)
        parent[k] = i;
    }
  }

  // The row of the lower factor and the column of the upper one for index `i`, whose entries are
  // those of `pattern`, each before those that depend on it. Clears `row` and `column`.
  void eliminate(int i, const std::vector<int>& pattern, std::vector<double>& row,
                 std::vector<double>& column)
  {
    for(const int k : pattern)
    {
      const double lower = row[k] / m_pivot[k], upper = column[k];
      row[k] = 0;
      column[k] = 0;
      for(const Entry& e : m_columns[k])
      {
        row[e.index] -= lower * e.upper;
        column[e.index] -= upper * e.lower;
      }
      m_pivot[i] -= lower * upper;
      m_columns[k].push_back(Entry{i, lower, upper});
    }
  }

  int m_n;
  std::vector<int> m_position;                 // of each row in the order of elimination
  std::vector<std::vector<Entry> > m_columns;  // in this order
  std::vector<double> m_pivot;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_UNPIVOTED_LU_H
