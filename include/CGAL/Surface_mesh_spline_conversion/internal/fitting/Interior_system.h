// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_SYSTEM_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_SYSTEM_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/assertions.h>

#include <Eigen/Core>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The normal equations of the interior fit (paper, section 3.3.1) for all control points that are
// not fixed. The matrix serves all fits of a refinement level; only the targets change.
template <typename Samples>
class Interior_system
{
public:
  typedef std::size_t size_type;
  typedef Eigen::SparseMatrix<double> Matrix; // the lower triangle
  typedef Eigen::Matrix<double, Eigen::Dynamic, 3> Points;

  static constexpr int fixed = -1;

  Interior_system(const Samples& samples, const std::vector<bool>& is_fixed)
    : m_samples(samples), m_unknown(is_fixed.size(), fixed)
  {
    for(size_type i = 0; i < is_fixed.size(); ++i)
      if(!is_fixed[i])
        m_unknown[i] = m_number_of_unknowns++;
    if(m_number_of_unknowns == 0)
      return;
    make_pattern();
    for(size_type p = 0; p < samples.number_of_patches(); ++p)
      add_patch(p);
    regularize();
    m_solver.compute(m_matrix);
  }

  bool is_valid() const
  {
    return m_number_of_unknowns == 0 || m_solver.info() == Eigen::Success;
  }

  // returns the row of a control point, or `fixed`
  int unknown(size_type control_point) const { return m_unknown[control_point]; }

  double coefficient(int row, int column) const
  {
    return m_matrix.coeff((std::max)(row, column), (std::min)(row, column));
  }

  // moves the control points to the least-squares fit of the targets; the remaining error is the
  // given share of the present one
  bool solve(Points& control_points, double relative_accuracy)
  {
    if(m_number_of_unknowns == 0)
      return true;
    const Points residual = right_hand_side(control_points);
    m_solver.setTolerance(relative_accuracy);
    Points correction(m_number_of_unknowns, 3);
    for(int d = 0; d < 3; ++d)
    {
      const Eigen::VectorXd column = residual.col(d);
      if(column.squaredNorm() == 0)
        correction.col(d).setZero();
      else
        correction.col(d) = m_solver.solve(column);
    }
    if(!correction.allFinite())
      return false;
    for(size_type i = 0; i < m_unknown.size(); ++i)
      if(m_unknown[i] != fixed)
        control_points.row(static_cast<Eigen::Index>(i)) += correction.row(m_unknown[i]);
    return true;
  }

private:
  // Share of the diagonal that is added to it. It makes functions harmless that no sample sees,
  // and is far below what the fit can resolve: the correction is solved for, so that it does not
  // pull the control points anywhere.
  static constexpr double relative_regularization = 1e-9;

  // the columns of the lower triangle: functions that share a patch
  void make_pattern()
  {
    std::vector<std::vector<size_type> > patches(static_cast<size_type>(m_number_of_unknowns));
    for(size_type p = 0; p < m_samples.number_of_patches(); ++p)
      for(size_type i = 0; i < m_samples.number_of_functions(p); ++i)
        if(m_unknown[m_samples.function(p, i)] != fixed)
          patches[static_cast<size_type>(m_unknown[m_samples.function(p, i)])].push_back(p);

    m_matrix.resize(m_number_of_unknowns, m_number_of_unknowns);
    std::vector<int> rows, last_seen(static_cast<size_type>(m_number_of_unknowns), -1);
    std::vector<int> sizes, all_rows;
    for(int column = 0; column < m_number_of_unknowns; ++column)
    {
      rows.assign(1, column);
      last_seen[static_cast<size_type>(column)] = column;
      for(size_type p : patches[static_cast<size_type>(column)])
        for(size_type i = 0; i < m_samples.number_of_functions(p); ++i)
        {
          const int row = m_unknown[m_samples.function(p, i)];
          if(row <= column || last_seen[static_cast<size_type>(row)] == column)
            continue;
          last_seen[static_cast<size_type>(row)] = column;
          rows.push_back(row);
        }
      std::sort(rows.begin(), rows.end());
      sizes.push_back(static_cast<int>(rows.size()));
      all_rows.insert(all_rows.end(), rows.begin(), rows.end());
    }
    set_pattern(sizes, all_rows);
  }

  void set_pattern(const std::vector<int>& sizes, const std::vector<int>& rows)
  {
    m_matrix.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
    int position = 0;
    for(size_type column = 0; column < sizes.size(); ++column)
    {
      m_matrix.outerIndexPtr()[column] = position;
      position += sizes[column];
    }
    m_matrix.outerIndexPtr()[sizes.size()] = position;
    std::copy(rows.begin(), rows.end(), m_matrix.innerIndexPtr());
    std::fill(m_matrix.valuePtr(), m_matrix.valuePtr() + position, 0.);
  }

  // adds the products of the functions of a patch; the dense product first, so that each entry of
  // the sparse matrix is looked up once per patch
  void add_patch(size_type patch)
  {
    const size_type n = m_samples.number_of_functions(patch);
    const Eigen::Index size = static_cast<Eigen::Index>(n);
    const size_type samples = m_samples.grid(patch).number_of_fit_samples();
    m_values.resize(static_cast<Eigen::Index>(samples), size);
    for(size_type k = 0; k < samples; ++k)
    {
      const double root = std::sqrt(m_samples.weight(patch, k));
      for(size_type i = 0; i < n; ++i)
        m_values(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i))
          = root * m_samples.values(patch, k)[i];
    }
    m_products.noalias() = m_values.transpose() * m_values;
    for(size_type j = 0; j < n; ++j)
      for(size_type i = 0; i < n; ++i)
      {
        const int row = m_unknown[m_samples.function(patch, i)];
        const int column = m_unknown[m_samples.function(patch, j)];
        if(column != fixed && row >= column)
          entry(row, column) += m_products(static_cast<Eigen::Index>(i),
                                           static_cast<Eigen::Index>(j));
      }
  }

  double& entry(int row, int column)
  {
    const int* begin = m_matrix.innerIndexPtr() + m_matrix.outerIndexPtr()[column];
    const int* end = m_matrix.innerIndexPtr() + m_matrix.outerIndexPtr()[column + 1];
    const int* it = std::lower_bound(begin, end, row);
    CGAL_assertion(it != end && *it == row);
    return m_matrix.valuePtr()[it - m_matrix.innerIndexPtr()];
  }

  void regularize()
  {
    double largest = 0;
    for(int i = 0; i < m_number_of_unknowns; ++i)
      largest = (std::max)(largest, entry(i, i));
    for(int i = 0; i < m_number_of_unknowns; ++i)
      entry(i, i) += relative_regularization * (largest > 0 ? largest : 1);
  }

  // returns the residual of the normal equations at the given control points
  Points right_hand_side(const Points& control_points) const
  {
    Points result = Points::Zero(m_number_of_unknowns, 3);
    for(size_type p = 0; p < m_samples.number_of_patches(); ++p)
    {
      const size_type n = m_samples.number_of_functions(p);
      for(size_type k = 0; k < m_samples.grid(p).number_of_fit_samples(); ++k)
      {
        const double* values = m_samples.values(p, k);
        Eigen::RowVector3d difference = m_samples.fit_target(p, k).transpose();
        for(size_type i = 0; i < n; ++i)
          difference -= values[i]
                        * control_points.row(static_cast<Eigen::Index>(m_samples.function(p, i)));
        difference *= m_samples.weight(p, k);
        for(size_type i = 0; i < n; ++i)
        {
          const int row = m_unknown[m_samples.function(p, i)];
          if(row != fixed)
            result.row(row) += values[i] * difference;
        }
      }
    }
    return result;
  }

  const Samples& m_samples;
  std::vector<int> m_unknown; // per control point
  int m_number_of_unknowns = 0;
  Matrix m_matrix;
  Eigen::MatrixXd m_values, m_products;
  Eigen::ConjugateGradient<Matrix, Eigen::Lower, Eigen::IncompleteCholesky<double> > m_solver;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_SYSTEM_H
