// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SUPERNODAL_PATTERN_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SUPERNODAL_PATTERN_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// What the factors of all symmetric matrices with the same pattern have in common: an approximate
// minimum degree ordering, and the supernodes: columns of the factor with similar patterns.
class Supernodal_pattern
{
public:
  // where an entry of the matrix goes in the block of its supernode
  struct Entry
  {
    int source;           // its number in the matrix
    bool is_transposed;   // by the ordering
    std::size_t place;    // in the block, column by column
  };

  // `lower`: the lower triangle of a matrix with the pattern, compressed, with all diagonal entries
  template <typename Scalar>
  explicit Supernodal_pattern(const Eigen::SparseMatrix<Scalar>& lower)
    : m_n(static_cast<int>(lower.cols())), m_outer(lower.outerIndexPtr()),
      m_inner(lower.innerIndexPtr())
  {
    order();
    find_supernodes();
    find_rows();
    locate_entries();
    forget_columns();
  }

  int number_of_unknowns() const { return m_n; }
  int number_of_supernodes() const { return static_cast<int>(m_first.size()) - 1; }

  // of each unknown in the order of elimination
  int position(int unknown) const { return m_position[unknown]; }

  int first_column(int s) const { return m_first[s]; }
  int columns(int s) const { return m_first[s + 1] - m_first[s]; }
  // below the diagonal block
  int rows(int s) const { return static_cast<int>(m_row_start[s + 1] - m_row_start[s]); }
  int height(int s) const { return columns(s) + rows(s); }
  int row(int s, int i) const { return m_rows[m_row_start[s] + i]; }
  const std::vector<int>& children(int s) const { return m_children[s]; }
  // the rows of `s` in the block of its parent
  const int* places_in_parent(int s) const { return m_place_in_parent.data() + m_row_start[s]; }

  // The block of a supernode, a matrix of its height and columns, in the values of the factor.
  std::size_t first_value(int s) const { return m_value_start[s]; }
  std::size_t number_of_values() const { return m_value_start.back(); }

  // about the multiplications of a factorisation
  double number_of_operations() const
  {
    double sum = 0;
    for(int s = 0; s < number_of_supernodes(); ++s)
      sum += static_cast<double>(columns(s)) * height(s) * height(s) / 2;
    return sum;
  }

  const Entry* entries_begin(int s) const { return m_entry.data() + m_entry_start[s]; }
  const Entry* entries_end(int s) const { return m_entry.data() + m_entry_start[s + 1]; }

private:
  // minimum degree, then a postorder of the elimination tree
  void order()
  {
    eliminate_small_degrees_first();
    permute_pattern();
    find_tree();
    const std::vector<int> order = postorder();
    for(int& p : m_position)
      p = order[p];
    permute_pattern();
    find_tree();
  }

  // Unknowns with the same neighbours, such as the coordinates of a point, are ordered as one.
  void eliminate_small_degrees_first()
  {
    const std::vector<int> representative = find_representatives();
    std::vector<int> number(m_n, -1), members(m_n, 0);
    int n = 0;
    for(int i = 0; i < m_n; ++i)
    {
      ++members[representative[i]];
      if(representative[i] == i)
        number[i] = n++;
    }
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> ordering;
    Eigen::AMDOrdering<int>()(representative_pattern(number, n).selfadjointView<Eigen::Lower>(),
                              ordering);
    std::vector<int> end(n), inverse(n);
    for(int i = 0; i < n; ++i)
      inverse[ordering.indices()[i]] = i;
    for(int i = 0; i < m_n; ++i)
      if(number[i] >= 0)
        end[inverse[number[i]]] = members[i];
    std::partial_sum(end.begin(), end.end(), end.begin());
    m_position.resize(m_n);
    for(int i = m_n - 1; i >= 0; --i)
      m_position[i] = --end[inverse[number[representative[i]]]];
  }

  // For each unknown the first one with the same neighbours, itself included. These have the same
  // sum of hash values; a collision could only make the ordering worse.
  std::vector<int> find_representatives() const
  {
    std::vector<std::uint64_t> sum(m_n, 0);
    for_each_entry([&](int, int i, int j)
    {
      sum[i] += hash(j);
      if(i != j)
        sum[j] += hash(i);
    });
    std::vector<int> representative(m_n);
    std::iota(representative.begin(), representative.end(), 0);
    for_each_entry([&](int, int i, int j)
    {
      if(sum[i] == sum[j] && representative[i] == i)
        representative[i] = representative[j];
    });
    return representative;
  }

  // the mixing of splitmix64 (Steele, Lea and Flood 2014)
  static std::uint64_t hash(std::uint64_t i)
  {
    i += 0x9e3779b97f4a7c15u;
    i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9u;
    i = (i ^ (i >> 27)) * 0x94d049bb133111ebu;
    return i ^ (i >> 31);
  }

  Eigen::SparseMatrix<double> representative_pattern(const std::vector<int>& number, int n) const
  {
    Eigen::SparseMatrix<double> pattern(n, n);
    std::vector<int> inner;
    inner.reserve(m_outer[m_n]);
    for(int j = 0; j < m_n; ++j)
    {
      if(number[j] < 0)
        continue;
      for(int k = m_outer[j]; k < m_outer[j + 1]; ++k)
        if(number[m_inner[k]] >= 0)
          inner.push_back(number[m_inner[k]]);
      pattern.outerIndexPtr()[number[j] + 1] = static_cast<int>(inner.size());
    }
    pattern.resizeNonZeros(inner.size());
    std::copy(inner.begin(), inner.end(), pattern.innerIndexPtr());
    std::fill(pattern.valuePtr(), pattern.valuePtr() + inner.size(), 0.);
    return pattern;
  }

  // calls `function(k, i, j)` for the k-th entry of the matrix, in row i >= j of column j
  template <typename Function>
  void for_each_entry(Function function) const
  {
    for(int j = 0; j < m_n; ++j)
      for(int k = m_outer[j]; k < m_outer[j + 1]; ++k)
        function(k, m_inner[k], j);
  }

  // for each column the rows below the diagonal, and for each row the columns before it
  void permute_pattern()
  {
    m_column_start.assign(m_n + 1, 0);
    m_before_start.assign(m_n + 1, 0);
    const auto for_each_entry_below_diagonal = [this](auto function)
    {
      for_each_entry([&](int, int i, int j)
      {
        if(i != j)
          function(std::minmax({m_position[i], m_position[j]}));
      });
    };
    for_each_entry_below_diagonal([&](const std::pair<int, int>& e)
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
    for_each_entry_below_diagonal([&](const std::pair<int, int>& e)
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

  // the entries of the matrix, supernode by supernode
  void locate_entries()
  {
    m_entry_start.assign(number_of_supernodes() + 1, 0);
    const auto supernode_of = [this](int i, int j)
      { return m_supernode[(std::min)(m_position[i], m_position[j])]; };
    for_each_entry([&](int, int i, int j) { ++m_entry_start[supernode_of(i, j) + 1]; });
    std::partial_sum(m_entry_start.begin(), m_entry_start.end(), m_entry_start.begin());
    m_entry.resize(m_entry_start.back());
    std::vector<std::size_t> end(m_entry_start.begin(), m_entry_start.end() - 1);
    for_each_entry([&](int k, int i, int j)
    {
      const int s = supernode_of(i, j);
      const auto e = std::minmax({m_position[i], m_position[j]});
      m_entry[end[s]++]
        = Entry{k, m_position[i] < m_position[j],
                std::size_t(e.first - m_first[s]) * height(s) + place_in(s, e.second)};
    });
  }

  // frees what only the analysis needs
  void forget_columns()
  {
    m_outer = m_inner = nullptr;
    for(std::vector<int>* numbers : {&m_column, &m_column_start, &m_before, &m_before_start,
                                     &m_tree_parent, &m_count, &m_supernode, &m_parent})
      std::vector<int>().swap(*numbers);
  }

  int m_n;
  const int *m_outer, *m_inner;            // the matrix, during the analysis
  std::vector<int> m_position;             // per unknown
  std::vector<int> m_column, m_column_start, m_before, m_before_start, m_tree_parent, m_count;
  std::vector<int> m_supernode;            // per column
  std::vector<int> m_parent;               // per supernode, -1 for roots
  std::vector<int> m_first;                // per supernode: first column
  std::vector<std::vector<int> > m_children;
  std::vector<int> m_rows, m_place_in_parent;
  std::vector<std::size_t> m_row_start;    // per supernode, in the former
  std::vector<std::size_t> m_value_start;  // per supernode
  std::vector<Entry> m_entry;
  std::vector<std::size_t> m_entry_start;  // per supernode
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SUPERNODAL_PATTERN_H
