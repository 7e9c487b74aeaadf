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

#include <CGAL/Surface_mesh_spline_conversion/internal/Supernodal_pattern.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Factorises sparse positive definite matrices, real symmetric or complex self-adjoint, with the
// same pattern: the multifrontal method (Liu 1992). The dense blocks of the supernodes are
// factorised by Eigen. Deterministic.
template <typename Scalar>
class Supernodal_cholesky
{
public:
  typedef Eigen::SparseMatrix<Scalar> Matrix;
  typedef Eigen::Matrix<Scalar, Eigen::Dynamic, 1> Vector;

  // `lower`: the lower triangle of a matrix with the pattern, compressed, with all diagonal entries
  void analyze(const Matrix& lower) { m_pattern = std::make_shared<Supernodal_pattern>(lower); }

  // for matrices with the pattern that `other` has analyzed
  template <typename Other_scalar>
  void share_analysis(const Supernodal_cholesky<Other_scalar>& other)
  {
    m_pattern = other.pattern();
  }

  std::shared_ptr<const Supernodal_pattern> pattern() const { return m_pattern; }

  // Returns `false` if the matrix is not positive definite, up to rounding.
  // \pre `lower` has the pattern that has been analyzed
  bool factorize(const Matrix& lower)
  {
    m_values.resize(m_pattern->number_of_values());
    m_updates.assign(m_pattern->number_of_supernodes(), Dense_matrix());
    for(int s = 0; s < m_pattern->number_of_supernodes(); ++s)
      if(!factorize_supernode(s, lower))
        return false;
    m_updates.clear();
    return true;
  }

  // \pre the last call of `factorize()` has succeeded
  Vector solve(const Vector& b) const
  {
    const Supernodal_pattern& pattern = *m_pattern;
    Vector x(b.size()), below;
    for(int i = 0; i < b.size(); ++i)
      x[pattern.position(i)] = b[i];
    for(int s = 0; s < pattern.number_of_supernodes(); ++s)
    {
      auto head = x.segment(pattern.first_column(s), pattern.columns(s));
      diagonal_block(s).template triangularView<Eigen::Lower>().solveInPlace(head);
      below.noalias() = lower_block(s) * head;
      for(int i = 0; i < pattern.rows(s); ++i)
        x[pattern.row(s, i)] -= below[i];
    }
    for(int s = pattern.number_of_supernodes() - 1; s >= 0; --s)
    {
      auto head = x.segment(pattern.first_column(s), pattern.columns(s));
      below.resize(pattern.rows(s));
      for(int i = 0; i < pattern.rows(s); ++i)
        below[i] = x[pattern.row(s, i)];
      head.noalias() -= lower_block(s).adjoint() * below;
      diagonal_block(s).adjoint().template triangularView<Eigen::Upper>().solveInPlace(head);
    }
    Vector result(b.size());
    for(int i = 0; i < b.size(); ++i)
      result[i] = x[pattern.position(i)];
    return result;
  }

private:
  typedef Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> Dense_matrix;
  typedef Eigen::Map<Dense_matrix> Block;
  typedef Eigen::Map<const Dense_matrix> Const_block;
  typedef Eigen::Ref<Dense_matrix, 0, Eigen::OuterStride<> > Block_reference;

  Block block(int s)
  {
    return Block(m_values.data() + m_pattern->first_value(s), m_pattern->height(s),
                 m_pattern->columns(s));
  }

  Const_block block(int s) const
  {
    return Const_block(m_values.data() + m_pattern->first_value(s), m_pattern->height(s),
                       m_pattern->columns(s));
  }

  auto diagonal_block(int s) const { return block(s).topRows(m_pattern->columns(s)); }
  auto lower_block(int s) const { return block(s).bottomRows(m_pattern->rows(s)); }

  bool factorize_supernode(int s, const Matrix& lower)
  {
    const int n = m_pattern->columns(s), m = m_pattern->rows(s);
    set_entries(s, lower);
    Dense_matrix& update = m_updates[s];
    update.setZero(m, m);
    for(const int child : m_pattern->children(s))
    {
      add_update(child, s);
      m_updates[child].resize(0, 0);
    }
    Block_reference diagonal = block(s).topRows(n), below = block(s).bottomRows(m);
    const Eigen::LLT<Block_reference> llt(diagonal);
    if(llt.info() != Eigen::Success)
      return false;
    diagonal.adjoint().template triangularView<Eigen::Upper>()
      .template solveInPlace<Eigen::OnTheRight>(below);
    if(m > 0)
      update.template selfadjointView<Eigen::Lower>().rankUpdate(below, -1.);
    return true;
  }

  // the block of a supernode in the matrix
  void set_entries(int s, const Matrix& lower)
  {
    block(s).setZero();
    Scalar* values = block(s).data();
    for(auto e = m_pattern->entries_begin(s); e != m_pattern->entries_end(s); ++e)
    {
      const Scalar value = lower.valuePtr()[e->source];
      values[e->place] = e->is_transposed ? Eigen::numext::conj(value) : value;
    }
  }

  // adds the update of a child to the blocks and the update of its parent `s`
  void add_update(int child, int s)
  {
    const Dense_matrix& from = m_updates[child];
    const int* place = m_pattern->places_in_parent(child);
    const int n = m_pattern->columns(s), size = m_pattern->rows(child);
    for(int j = 0; j < size; ++j)
    {
      Scalar* column = place[j] < n ? block(s).col(place[j]).data()
                                    : m_updates[s].col(place[j] - n).data() - n;
      for(int i = j; i < size; ++i)
        column[place[i]] += from(i, j);
    }
  }

  std::shared_ptr<const Supernodal_pattern> m_pattern;
  Vector m_values;                       // the blocks of the supernodes, of the factor
  std::vector<Dense_matrix> m_updates;   // per supernode
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SUPERNODAL_CHOLESKY_H
