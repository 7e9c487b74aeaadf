// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SUPERNODAL_CHOLESKY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SUPERNODAL_CHOLESKY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Factorises sparse positive definite matrices with the same pattern: the multifrontal method (Liu
// 1992) after an approximate minimum degree ordering. Columns with similar patterns form
// supernodes, whose dense blocks are factorised by Eigen. Deterministic.
class Supernodal_cholesky
{
public:
  typedef Eigen::SparseMatrix<double> Matrix;

  // `lower`: the lower triangle of a matrix with the pattern, compressed, with all diagonal entries
  void analyze(const Matrix& lower)
  {
    m_n = static_cast<int>(lower.cols());
    order(lower);
    find_supernodes();
    find_rows();
    locate_entries(lower);
  }

  // Returns `false` if the matrix is not positive definite, up to rounding.
  // \pre `lower` has the pattern that has been analyzed
  bool factorize(const Matrix& lower)
  {
    m_values.assign(m_value_start.back(), 0.);
    for(Eigen::Index k = 0; k < lower.nonZeros(); ++k)
      m_values[m_place[k]] += lower.valuePtr()[k];
    m_updates.assign(number_of_supernodes(), Eigen::MatrixXd());
    for(int s = 0; s < number_of_supernodes(); ++s)
      if(!factorize_supernode(s))
        return false;
    m_updates.clear();
    return true;
  }

  // \pre the last call of `factorize()` has succeeded
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const
  {
    Eigen::VectorXd x(m_n), below;
    for(int i = 0; i < m_n; ++i)
      x[m_position[i]] = b[i];
    for(int s = 0; s < number_of_supernodes(); ++s)
    {
      auto head = x.segment(m_first[s], columns(s));
      diagonal_block(s).triangularView<Eigen::Lower>().solveInPlace(head);
      below.noalias() = lower_block(s) * head;
      for(int i = 0; i < rows(s); ++i)
        x[m_rows[m_row_start[s] + i]] -= below[i];
    }
    for(int s = number_of_supernodes() - 1; s >= 0; --s)
    {
      auto head = x.segment(m_first[s], columns(s));
      below.resize(rows(s));
      for(int i = 0; i < rows(s); ++i)
        below[i] = x[m_rows[m_row_start[s] + i]];
      head.noalias() -= lower_block(s).transpose() * below;
      diagonal_block(s).transpose().triangularView<Eigen::Upper>().solveInPlace(head);
    }
    Eigen::VectorXd result(m_n);
    for(int i = 0; i < m_n; ++i)
      result[i] = x[m_position[i]];
    return result;
  }

private:
  typedef Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<> > Block;
  typedef Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<> > Const_block;

  int number_of_supernodes() const { return static_cast<int>(m_first.size()) - 1; }
  int columns(int s) const { return m_first[s + 1] - m_first[s]; }
  // below the diagonal block
  int rows(int s) const { return static_cast<int>(m_row_start[s + 1] - m_row_start[s]); }
  int height(int s) const { return columns(s) + rows(s); }

  Const_block diagonal_block(int s) const
  {
    return Const_block(m_values.data() + m_value_start[s], columns(s), columns(s),
                       Eigen::OuterStride<>(height(s)));
  }

  Const_block lower_block(int s) const
  {
    return Const_block(m_values.data() + m_value_start[s] + columns(s), rows(s), columns(s),
                       Eigen::OuterStride<>(height(s)));
  }

  // minimum degree, then a postorder of the elimination tree
  void order(const Matrix& lower)
  {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> ordering;
    Eigen::AMDOrdering<int>()(Matrix(lower.selfadjointView<Eigen::Lower>()), ordering);
    m_position.resize(m_n);
    for(int i = 0; i < m_n; ++i)
      m_position[ordering.indices()[i]] = i;
    permute_pattern(lower);
    find_tree();
    const std::vector<int> order = postorder();
    for(int& p : m_position)
      p = order[p];
    permute_pattern(lower);
    find_tree();
  }

  // for each column the rows below the diagonal, and for each row the columns before it
  void permute_pattern(const Matrix& lower)
  {
    m_column_start.assign(m_n + 1, 0);
    m_before_start.assign(m_n + 1, 0);
    const auto for_each_entry = [&](auto function)
    {
      for(int j = 0; j < m_n; ++j)
        for(int k = lower.outerIndexPtr()[j]; k < lower.outerIndexPtr()[j + 1]; ++k)
          if(lower.innerIndexPtr()[k] != j)
            function(std::minmax({m_position[lower.innerIndexPtr()[k]], m_position[j]}));
    };
    for_each_entry([&](const std::pair<int, int>& e)
    {
      ++m_column_start[e.first + 1];
      ++m_before_start[e.second + 1];
    });
    for(int i = 0; i < m_n; ++i)
    {
      m_column_start[i + 1] += m_column_start[i];
      m_before_start[i + 1] += m_before_start[i];
    }
    m_column.resize(m_column_start[m_n]);
    m_before.resize(m_before_start[m_n]);
    std::vector<int> column_end(m_column_start.begin(), m_column_start.end() - 1),
                     before_end(m_before_start.begin(), m_before_start.end() - 1);
    for_each_entry([&](const std::pair<int, int>& e)
    {
      m_column[column_end[e.first]++] = e.second;
      m_before[before_end[e.second]++] = e.first;
    });
  }

  // the elimination tree, and the number of entries of the factor below the diagonal per column
  void find_tree()
  {
    m_tree_parent.assign(m_n, -1);
    m_count.assign(m_n, 0);
    std::vector<int> mark(m_n, -1);
    for(int i = 0; i < m_n; ++i)
    {
      mark[i] = i;
      for(int k = m_before_start[i]; k < m_before_start[i + 1]; ++k)
        for(int j = m_before[k]; mark[j] != i; j = m_tree_parent[j])
        {
          if(m_tree_parent[j] < 0)
            m_tree_parent[j] = i;
          ++m_count[j];
          mark[j] = i;
        }
    }
  }

  // the number of each node in a postorder
  std::vector<int> postorder() const
  {
    std::vector<int> first_child(m_n, -1), sibling(m_n, -1), number(m_n, -1), stack;
    for(int i = m_n - 1; i >= 0; --i)
      if(m_tree_parent[i] >= 0)
      {
        sibling[i] = first_child[m_tree_parent[i]];
        first_child[m_tree_parent[i]] = i;
      }
    int next = 0;
    for(int root = 0; root < m_n; ++root)
    {
      if(m_tree_parent[root] >= 0)
        continue;
      stack.push_back(root);
      while(!stack.empty())
      {
        const int i = stack.back();
        if(first_child[i] >= 0)
        {
          stack.push_back(first_child[i]);
          first_child[i] = -1;
          continue;
        }
        number[i] = next++;
        stack.pop_back();
        // the place on the stack goes to the next child of the same parent
        if(sibling[i] >= 0)
          stack.push_back(sibling[i]);
      }
    }
    return number;
  }

  // Columns with the same pattern, and small ones with a few more zeros, form supernodes.
  void find_supernodes()
  {
    struct Node
    {
      int first, columns, rows;
      double zeros;
    };
    std::vector<Node> nodes;
    for(int j = 0; j < m_n; ++j)
    {
      nodes.push_back(Node{j, 1, m_count[j], 0.});
      while(nodes.size() > 1)
      {
        const Node &child = nodes[nodes.size() - 2], &parent = nodes.back();
        if(m_tree_parent[parent.first - 1] < parent.first
           || m_tree_parent[parent.first - 1] >= parent.first + parent.columns)
          break;
        const int columns = child.columns + parent.columns;
        const double zeros = child.zeros + parent.zeros
          + double(child.columns) * (parent.columns + parent.rows - child.rows);
        const double entries = double(columns) * (columns + 1) / 2 + double(columns) * parent.rows;
        if(zeros > largest_share_of_zeros(columns) * entries)
          break;
        const Node merged{child.first, columns, parent.rows, zeros};
        nodes.pop_back();
        nodes.back() = merged;
      }
    }
    m_first.clear();
    m_supernode.resize(m_n);
    for(std::size_t s = 0; s < nodes.size(); ++s)
    {
      m_first.push_back(nodes[s].first);
      for(int j = nodes[s].first; j < nodes[s].first + nodes[s].columns; ++j)
        m_supernode[j] = static_cast<int>(s);
    }
    m_first.push_back(m_n);
  }

  // dense operations on small blocks cost more than those on zeros
  static double largest_share_of_zeros(int columns)
  {
    return columns <= 4 ? 0.8 : columns <= 16 ? 0.4 : columns <= 48 ? 0.1 : 0.05;
  }

  // the rows of each supernode below its diagonal block, and where they are in its parent
  void find_rows()
  {
    const int n = number_of_supernodes();
    std::vector<std::vector<int> > children(n);
    std::vector<int> mark(m_n, -1);
    m_row_start.assign(1, 0);
    m_value_start.assign(1, 0);
    m_rows.clear();
    m_parent.assign(n, -1);
    for(int s = 0; s < n; ++s)
    {
      std::vector<int> found;
      const auto add = [&](int row)
      {
        if(row < m_first[s + 1] || mark[row] == s)
          return;
        mark[row] = s;
        found.push_back(row);
      };
      for(int k = m_column_start[m_first[s]]; k < m_column_start[m_first[s + 1]]; ++k)
        add(m_column[k]);
      for(const int child : children[s])
        for(std::size_t k = m_row_start[child]; k < m_row_start[child + 1]; ++k)
          add(m_rows[k]);
      std::sort(found.begin(), found.end());
      m_rows.insert(m_rows.end(), found.begin(), found.end());
      m_row_start.push_back(m_rows.size());
      m_value_start.push_back(m_value_start.back() + std::size_t(height(s)) * columns(s));
      if(!found.empty())
      {
        m_parent[s] = m_supernode[found.front()];
        children[m_parent[s]].push_back(s);
      }
    }
    m_place_in_parent.resize(m_rows.size());
    for(int s = 0; s < n; ++s)
      for(std::size_t k = m_row_start[s]; k < m_row_start[s + 1]; ++k)
        m_place_in_parent[k] = place_in(m_parent[s], m_rows[k]);
    m_children.swap(children);
  }

  // the position of a row in the blocks of a supernode
  int place_in(int s, int row) const
  {
    if(row < m_first[s + 1])
      return row - m_first[s];
    const auto begin = m_rows.begin() + m_row_start[s];
    return columns(s)
           + static_cast<int>(std::lower_bound(begin, m_rows.begin() + m_row_start[s + 1], row)
                              - begin);
  }

  void locate_entries(const Matrix& lower)
  {
    m_place.resize(lower.nonZeros());
    for(int j = 0; j < m_n; ++j)
      for(int k = lower.outerIndexPtr()[j]; k < lower.outerIndexPtr()[j + 1]; ++k)
      {
        const auto e = std::minmax({m_position[lower.innerIndexPtr()[k]], m_position[j]});
        const int s = m_supernode[e.first];
        m_place[k] = m_value_start[s] + std::size_t(e.first - m_first[s]) * height(s)
                     + place_in(s, e.second);
      }
  }

  bool factorize_supernode(int s)
  {
    const int n = columns(s), m = rows(s);
    Eigen::MatrixXd& update = m_updates[s];
    update.setZero(m, m);
    for(const int child : m_children[s])
    {
      add_update(child, s);
      m_updates[child].resize(0, 0);
    }
    double* values = m_values.data() + m_value_start[s];
    Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<> > diagonal
      = Block(values, n, n, Eigen::OuterStride<>(n + m));
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<> > > llt(diagonal);
    if(llt.info() != Eigen::Success)
      return false;
    Block below(values + n, m, n, Eigen::OuterStride<>(n + m));
    diagonal.transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(below);
    if(m > 0)
      update.selfadjointView<Eigen::Lower>().rankUpdate(below, -1.);
    return true;
  }

  // adds the update of a child to the blocks and the update of its parent `s`
  void add_update(int child, int s)
  {
    const Eigen::MatrixXd& from = m_updates[child];
    const int* place = m_place_in_parent.data() + m_row_start[child];
    const int n = columns(s), size = rows(child);
    double* values = m_values.data() + m_value_start[s];
    for(int j = 0; j < size; ++j)
    {
      double* column = place[j] < n ? values + std::size_t(place[j]) * height(s)
                                    : m_updates[s].data() + std::size_t(place[j] - n) * rows(s) - n;
      for(int i = j; i < size; ++i)
        column[place[i]] += from(i, j);
    }
  }

  int m_n = 0;
  std::vector<int> m_position;             // of each unknown in the order of elimination
  std::vector<int> m_column, m_column_start, m_before, m_before_start, m_tree_parent, m_count;
  std::vector<int> m_first;                // per supernode: first column
  std::vector<int> m_supernode;            // per column
  std::vector<int> m_parent;               // per supernode, -1 for roots
  std::vector<std::vector<int> > m_children;
  std::vector<int> m_rows, m_place_in_parent;
  std::vector<std::size_t> m_row_start;    // per supernode, in the former
  std::vector<std::size_t> m_value_start;  // per supernode
  std::vector<std::size_t> m_place;        // per entry of the matrix, in the values
  std::vector<double> m_values;            // the factor, supernode by supernode, column by column
  std::vector<Eigen::MatrixXd> m_updates;  // per supernode
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SUPERNODAL_CHOLESKY_H
