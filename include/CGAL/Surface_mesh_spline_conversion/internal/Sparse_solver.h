// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SPARSE_SOLVER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SPARSE_SOLVER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Supernodal_cholesky.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#ifdef CGAL_SURFACE_MESH_SPLINE_CONVERSION_USE_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Solves real symmetric or complex self-adjoint systems with the same pattern. The factorisation of
// positive definite matrices is that of this package, or of CHOLMOD if
// `CGAL_SURFACE_MESH_SPLINE_CONVERSION_USE_CHOLMOD` is defined; matrices that are indefinite, be it
// by rounding, get one with pivots of both signs.
template <typename Scalar>
class Sparse_solver
{
public:
  typedef Eigen::SparseMatrix<Scalar> Matrix;
  typedef Eigen::Matrix<Scalar, Eigen::Dynamic, 1> Vector;

#ifdef CGAL_SURFACE_MESH_SPLINE_CONVERSION_USE_CHOLMOD
  Sparse_solver() { m_cholesky.cholmod().print = 0; } // no warnings of indefinite matrices
#endif

  // `lower`: the lower triangle of a matrix with the pattern, with all diagonal entries
  void analyze(const Matrix& lower)
  {
#ifdef CGAL_SURFACE_MESH_SPLINE_CONVERSION_USE_CHOLMOD
    m_cholesky.analyzePattern(lower);
#else
    m_cholesky.analyze(lower);
#endif
  }

  // The same for a pattern that `other` has analyzed.
  template <typename Other_scalar>
  void analyze(const Matrix& lower, const Sparse_solver<Other_scalar>& other)
  {
#ifdef CGAL_SURFACE_MESH_SPLINE_CONVERSION_USE_CHOLMOD
    (void)other;
    analyze(lower);
#else
    (void)lower;
    m_cholesky.share_analysis(other.m_cholesky);
#endif
  }

  // about the multiplications of a factorisation. \pre The pattern has been analyzed.
  double number_of_operations()
  {
#ifdef CGAL_SURFACE_MESH_SPLINE_CONVERSION_USE_CHOLMOD
    return m_cholesky.cholmod().fl / 2;
#else
    return m_cholesky.pattern()->number_of_operations();
#endif
  }

  // Returns `false` if the matrix is singular.
  bool factorize(const Matrix& lower)
  {
    m_is_definite = factorize_definite(lower);
    if(m_is_definite)
      return true;
    m_ldlt.compute(lower);
    return m_ldlt.info() == Eigen::Success;
  }

  Vector solve(const Vector& b) const
  {
    if(m_is_definite)
      return m_cholesky.solve(b);
    return m_ldlt.solve(b);
  }

private:
  template <typename Other_scalar> friend class Sparse_solver;

#ifdef CGAL_SURFACE_MESH_SPLINE_CONVERSION_USE_CHOLMOD
  bool factorize_definite(const Matrix& lower)
  {
    m_cholesky.factorize(lower);
    return m_cholesky.info() == Eigen::Success;
  }

  Eigen::CholmodSupernodalLLT<Matrix> m_cholesky;
#else
  bool factorize_definite(const Matrix& lower) { return m_cholesky.factorize(lower); }

  Supernodal_cholesky<Scalar> m_cholesky;
#endif
  Eigen::SimplicialLDLT<Matrix> m_ldlt;
  bool m_is_definite = false;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SPARSE_SOLVER_H
