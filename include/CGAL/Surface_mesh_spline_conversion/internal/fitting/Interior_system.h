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

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Fairness_energy.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

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
// not fixed, on the patches on which they act. The matrix serves all fits of a refinement level;
// only the targets change.
template <typename Samples>
class Interior_system
{
public:
  typedef std::size_t size_type;
  typedef Eigen::SparseMatrix<double> Matrix; // the lower triangle
  typedef Eigen::Matrix<double, Eigen::Dynamic, 3> Points;

  static constexpr int fixed = -1;

  // `patches`: all on which a control point acts that is not fixed.
  // `energy`: is added to the squared error, unless it is a null pointer
  Interior_system(const Samples& samples, const std::vector<bool>& is_fixed,
                  const std::vector<size_type>& patches, const Fairness_energy* energy = nullptr)
    : m_samples(samples), m_energy(energy), m_patches(patches), m_unknown(is_fixed.size(), fixed)
  {
    for(size_type i = 0; i < is_fixed.size(); ++i)
      if(!is_fixed[i])
        m_unknown[i] = m_number_of_unknowns++;
    if(m_number_of_unknowns == 0)
      return;
    assemble();
    regularize();
    m_preconditioner.compute(m_matrix);
  }

  bool is_valid() const
  {
    return m_number_of_unknowns == 0 || m_preconditioner.info() == Eigen::Success;
  }

  // returns the row of a control point, or `fixed`
  int unknown(size_type control_point) const { return m_unknown[control_point]; }

  double coefficient(int row, int column) const
  {
    return m_matrix.coeff((std::max)(row, column), (std::min)(row, column));
  }

  // moves the control points of the surface to the least-squares fit of the targets; the remaining
  // error is the given share of the present one
  template <typename Surface>
  bool fit(Surface& surface, double relative_accuracy) const
  {
    typedef typename Surface::Point_3 Point_3;
    typedef typename Surface::FT FT;
    Points points(static_cast<Eigen::Index>(m_unknown.size()), 3);
    for(size_type i = 0; i < m_unknown.size(); ++i)
      points.row(static_cast<Eigen::Index>(i)) = to_eigen(surface.control_point(i)).transpose();
    if(!solve(points, relative_accuracy) || !points.allFinite())
      return false; // nothing is known of the curves between the samples that were checked
    for(size_type i = 0; i < m_unknown.size(); ++i)
      if(m_unknown[i] != fixed)
      {
        const auto p = points.row(static_cast<Eigen::Index>(i));
        surface.set_control_point(i, Point_3(FT(p[0]), FT(p[1]), FT(p[2])));
      }
    return true;
  }

  // does the same for the given control points
  bool solve(Points& control_points, double relative_accuracy) const
  {
    if(m_number_of_unknowns == 0)
      return true;
    const Points residual = right_hand_side(control_points);
    Points correction(m_number_of_unknowns, 3);
    for_each_index(3, [&](size_type d)
    {
      correction.col(Eigen::Index(d)) = solution(residual.col(Eigen::Index(d)), relative_accuracy);
    });
    if(!correction.allFinite())
      return false;
    for(size_type i = 0; i < m_unknown.size(); ++i)
      if(m_unknown[i] != fixed)
        control_points.row(static_cast<Eigen::Index>(i)) += correction.row(m_unknown[i]);
    return true;
  }

private:
  typedef Eigen::VectorXd Vector;

  // Share of the diagonal that is added to it. It makes functions harmless that no sample sees,
  // and is far below what the fit can resolve: the correction is solved for, so that it does not
  // pull the control points anywhere.
  static constexpr double relative_regularization = 1e-9;

  // so many that the memory of a thread for the positions of rows is no burden
  static constexpr size_type columns_at_once = 512;

  // a function among those of a patch
  struct Use
  {
    size_type patch; // its position in `m_patches`
    size_type function;
  };

  // the entries of a column of the lower triangle
  struct Column
  {
    std::vector<int> rows;
    std::vector<double> values;
  };

  int row(const Use& use) const
  {
    return m_unknown[m_samples.function(m_patches[use.patch], use.function)];
  }

  // Each entry is the sum over the patches of the products of two functions, in the order of the
  // patches, whatever the number of threads.
  void assemble()
  {
    std::vector<Eigen::MatrixXd> products(m_patches.size());
    for_each_index(products.size(), [&](size_type i) { products[i] = patch_products(m_patches[i]); });
    std::vector<std::vector<Use> > uses(static_cast<size_type>(m_number_of_unknowns));
    for(size_type p = 0; p < m_patches.size(); ++p)
      for(size_type i = 0; i < m_samples.number_of_functions(m_patches[p]); ++i)
        if(row(Use{p, i}) != fixed)
          uses[static_cast<size_type>(row(Use{p, i}))].push_back(Use{p, i});
    std::vector<Column> columns(uses.size());
    for_each_index((columns.size() + columns_at_once - 1) / columns_at_once, [&](size_type block)
    {
      std::vector<size_type> positions(columns.size(), 0);
      const size_type end = (std::min)((block + 1) * columns_at_once, columns.size());
      for(size_type c = block * columns_at_once; c < end; ++c)
        columns[c] = make_column(int(c), uses[c], products, positions);
    });
    set_matrix(columns);
  }

  Eigen::MatrixXd patch_products(size_type patch) const
  {
    const Eigen::Index n = static_cast<Eigen::Index>(m_samples.number_of_functions(patch));
    const Eigen::Index samples
      = static_cast<Eigen::Index>(m_samples.grid(patch).number_of_fit_samples());
    Eigen::MatrixXd values(samples, n);
    for(Eigen::Index k = 0; k < samples; ++k)
      values.row(k) = std::sqrt(m_samples.weight(patch, size_type(k)))
                      * Eigen::Map<const Eigen::RowVectorXd>(
                          m_samples.values(patch, size_type(k)), n);
    Eigen::MatrixXd result = values.transpose() * values;
    if(m_energy != nullptr)
    {
      const Eigen::MatrixXd& derivatives = m_energy->derivatives(patch);
      result += m_energy->weight(patch) * derivatives.transpose() * derivatives;
    }
    return result;
  }

  // `positions`: zeros for all rows, before and after
  Column make_column(int column, const std::vector<Use>& uses,
                     const std::vector<Eigen::MatrixXd>& products,
                     std::vector<size_type>& positions) const
  {
    Column result;
    for_each_entry(column, uses, [&](int r, const Use&, size_type)
    {
      if(positions[size_type(r)]++ == 0)
        result.rows.push_back(r);
    });
    std::sort(result.rows.begin(), result.rows.end());
    for(size_type i = 0; i < result.rows.size(); ++i)
      positions[size_type(result.rows[i])] = i;
    result.values.assign(result.rows.size(), 0);
    for_each_entry(column, uses, [&](int r, const Use& use, size_type i)
    {
      result.values[positions[size_type(r)]]
        += products[use.patch](Eigen::Index(i), Eigen::Index(use.function));
    });
    for(int r : result.rows)
      positions[size_type(r)] = 0;
    return result;
  }

  // calls `visit(row, use, i)` for the functions `i` of the patches of a column
  template <typename Visitor>
  void for_each_entry(int column, const std::vector<Use>& uses, const Visitor& visit) const
  {
    for(const Use& use : uses)
      for(size_type i = 0; i < m_samples.number_of_functions(m_patches[use.patch]); ++i)
      {
        const int r = row(Use{use.patch, i});
        if(r >= column)
          visit(r, use, i);
      }
  }

  void set_matrix(const std::vector<Column>& columns)
  {
    m_matrix.resize(m_number_of_unknowns, m_number_of_unknowns);
    size_type entries = 0;
    for(const Column& column : columns)
      entries += column.rows.size();
    m_matrix.resizeNonZeros(static_cast<Eigen::Index>(entries));
    int position = 0;
    for(size_type c = 0; c < columns.size(); ++c)
    {
      m_matrix.outerIndexPtr()[c] = position;
      std::copy(columns[c].rows.begin(), columns[c].rows.end(), m_matrix.innerIndexPtr() + position);
      std::copy(columns[c].values.begin(), columns[c].values.end(), m_matrix.valuePtr() + position);
      position += int(columns[c].rows.size());
    }
    m_matrix.outerIndexPtr()[columns.size()] = position;
  }

  // the diagonal begins each column
  double& diagonal(int i) { return m_matrix.valuePtr()[m_matrix.outerIndexPtr()[i]]; }

  void regularize()
  {
    double largest = 0;
    for(int i = 0; i < m_number_of_unknowns; ++i)
      largest = (std::max)(largest, diagonal(i));
    for(int i = 0; i < m_number_of_unknowns; ++i)
      diagonal(i) += relative_regularization * (largest > 0 ? largest : 1);
  }

  // preconditioned conjugate gradients from zero on
  Vector solution(const Vector& right_hand_side, double relative_accuracy) const
  {
    const double limit = relative_accuracy * relative_accuracy * right_hand_side.squaredNorm();
    Vector result = Vector::Zero(right_hand_side.size()), residual = right_hand_side;
    Vector direction = m_preconditioner.solve(residual), image, scaled;
    double product = residual.dot(direction);
    for(Eigen::Index i = 0; i < 2 * residual.size() && residual.squaredNorm() > limit; ++i)
    {
      image = m_matrix.selfadjointView<Eigen::Lower>() * direction;
      const double step = product / direction.dot(image);
      result += step * direction;
      residual -= step * image;
      scaled = m_preconditioner.solve(residual);
      const double next = residual.dot(scaled);
      direction = scaled + (next / product) * direction;
      product = next;
    }
    return result;
  }

  // returns the residual of the normal equations at the given control points
  Points right_hand_side(const Points& control_points) const
  {
    std::vector<Points> parts(m_patches.size());
    for_each_index(parts.size(), [&](size_type i)
      { parts[i] = patch_residual(m_patches[i], control_points); });
    Points result = Points::Zero(m_number_of_unknowns, 3);
    for(size_type p = 0; p < m_patches.size(); ++p)
      for(size_type i = 0; i < m_samples.number_of_functions(m_patches[p]); ++i)
        if(row(Use{p, i}) != fixed)
          result.row(row(Use{p, i})) += parts[p].row(Eigen::Index(i));
    return result;
  }

  Points patch_residual(size_type patch, const Points& control_points) const
  {
    const Eigen::Index n = static_cast<Eigen::Index>(m_samples.number_of_functions(patch));
    const Eigen::Index samples
      = static_cast<Eigen::Index>(m_samples.grid(patch).number_of_fit_samples());
    Points points(n, 3);
    for(Eigen::Index i = 0; i < n; ++i)
      points.row(i) = control_points.row(Eigen::Index(m_samples.function(patch, size_type(i))));
    const Eigen::Map<const Eigen::MatrixXd> values(m_samples.values(patch, 0), n, samples);
    Points differences = values.transpose().lazyProduct(points);
    for(Eigen::Index k = 0; k < samples; ++k)
      differences.row(k) = m_samples.weight(patch, size_type(k))
                           * (m_samples.fit_target(patch, size_type(k)).transpose()
                              - differences.row(k));
    Points result = values.lazyProduct(differences);
    if(m_energy != nullptr)
    {
      const Eigen::MatrixXd& derivatives = m_energy->derivatives(patch);
      result -= m_energy->weight(patch) * (derivatives.transpose() * (derivatives * points));
    }
    return result;
  }

  const Samples& m_samples;
  const Fairness_energy* m_energy;
  std::vector<size_type> m_patches;
  std::vector<int> m_unknown; // per control point
  int m_number_of_unknowns = 0;
  Matrix m_matrix;
  // The factor has as many entries as the matrix in any order: one with less fill gains nothing.
  Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int> > m_preconditioner;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_INTERIOR_SYSTEM_H
