// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MAP_SYSTEM_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MAP_SYSTEM_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Sparse_solver.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Cut_graph.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Distortion_energy.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/seam_equations.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Newton steps in a space of maps. The sparsity pattern, its ordering and the places where the
// matrices of the triangles go are computed once.
class Map_system
{
public:
  // shape that a triangle should have: J = [x1 - x0, x2 - x0] * inverse
  struct Reference
  {
    Eigen::Matrix2d inverse;
    double area;
  };

  Map_system(const Working_mesh& mesh, const Cut_graph& cut, const Map_space& space)
    : m_space(space), m_number_of_faces(mesh.number_of_faces()),
      m_wedge(mesh.number_of_halfedges())
  {
    for(int corner = 0; corner < mesh.number_of_halfedges(); ++corner)
      m_wedge[corner] = cut.wedge(corner);
    collect_entries();
    build_pattern();
    locate_entries();
    m_solver.analyze(m_matrix);
  }

  std::vector<Reference>& references() { return m_reference; }
  const std::vector<Reference>& references() const { return m_reference; }
  int number_of_faces() const { return m_number_of_faces; }

  Eigen::Vector2d point(const Eigen::VectorXd& x, int corner) const
  {
    return x.segment<2>(2 * m_wedge[corner]);
  }

  Eigen::Matrix2d jacobian(const Eigen::VectorXd& x, int f) const
  {
    Eigen::Matrix2d edges;
    edges.col(0) = point(x, 3 * f + 1) - point(x, 3 * f);
    edges.col(1) = point(x, 3 * f + 2) - point(x, 3 * f);
    return edges * m_reference[f].inverse;
  }

  // the scalars for the free variables `y`, without the constants
  Eigen::VectorXd linear_part(const Eigen::VectorXd& y) const
  {
    Eigen::VectorXd x(m_space.number_of_scalars());
    for(int i = 0; i < m_space.number_of_scalars(); ++i)
    {
      double sum = 0;
      for(int k = m_space.start[i]; k < m_space.start[i + 1]; ++k)
        sum += m_space.numerator[k] * y[m_space.column[k]];
      x[i] = sum / m_space.denominator;
    }
    return x;
  }

  Eigen::VectorXd constants() const
  {
    Eigen::VectorXd x(m_space.number_of_scalars());
    for(int i = 0; i < m_space.number_of_scalars(); ++i)
      x[i] = static_cast<double>(m_space.constant[i]) / m_space.denominator;
    return x;
  }

  // Adds up `model(f, J, gradient, hessian)` of all triangles, and factorises. `drift` is a change
  // of the scalars that the step has to make anyway. Returns `false` if the matrix is singular.
  template <typename Model>
  bool assemble(const Eigen::VectorXd& x, const Eigen::VectorXd* drift, Model model)
  {
    std::fill(m_matrix.valuePtr(), m_matrix.valuePtr() + m_matrix.nonZeros(), 0.);
    m_gradient.setZero(m_space.number_of_free_variables());
    for(int f = 0; f < m_number_of_faces; ++f)
    {
      Jacobian_gradient g;
      Jacobian_hessian h;
      model(f, jacobian(x, f), g, h);
      const Eigen::Matrix<double, 4, 6> B = corner_derivatives(f);
      const Eigen::Matrix<double, 6, 6> local_matrix = B.transpose() * h * B;
      Eigen::Matrix<double, 6, 1> local_gradient = B.transpose() * g;
      if(drift)
        local_gradient += local_matrix * corners(*drift, f);
      scatter(f, local_matrix, local_gradient);
    }
    return m_solver.factorize(m_matrix);
  }

  const Eigen::VectorXd& gradient() const { return m_gradient; }

  // the step of the free variables
  Eigen::VectorXd solve() { return m_solver.solve(-m_gradient); }

private:
  typedef Eigen::SparseMatrix<double> Matrix;

  // scalar `local` (2 * corner + component) of a face depends on column `slot` of the face
  struct Entry
  {
    int local;
    int slot;
    double coefficient;
  };

  int scalar(int f, int local) const { return 2 * m_wedge[3 * f + local / 2] + local % 2; }

  Eigen::Matrix<double, 6, 1> corners(const Eigen::VectorXd& x, int f) const
  {
    Eigen::Matrix<double, 6, 1> values;
    for(int i = 0; i < 3; ++i)
      values.segment<2>(2 * i) = point(x, 3 * f + i);
    return values;
  }

  Eigen::Matrix<double, 4, 6> corner_derivatives(int f) const
  {
    const Eigen::Matrix2d& G = m_reference[f].inverse;
    Eigen::Matrix<double, 4, 6> B = Eigen::Matrix<double, 4, 6>::Zero();
    for(int q = 0; q < 2; ++q)
      for(int c = 0; c < 2; ++c)
      {
        B(2 * q + c, q) = -G(0, c) - G(1, c);
        B(2 * q + c, 2 + q) = G(0, c);
        B(2 * q + c, 4 + q) = G(1, c);
      }
    return B;
  }

  // the columns that each face depends on, sorted, and how
  void collect_entries()
  {
    m_entry_start.assign(1, 0);
    m_column_start.assign(1, 0);
    std::vector<int> columns;
    for(int f = 0; f < m_number_of_faces; ++f)
    {
      columns.clear();
      for(int local = 0; local < 6; ++local)
        for(int k = m_space.start[scalar(f, local)]; k < m_space.start[scalar(f, local) + 1]; ++k)
          columns.push_back(m_space.column[k]);
      std::sort(columns.begin(), columns.end());
      columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
      for(int local = 0; local < 6; ++local)
        for(int k = m_space.start[scalar(f, local)]; k < m_space.start[scalar(f, local) + 1]; ++k)
        {
          const auto place = std::lower_bound(columns.begin(), columns.end(), m_space.column[k]);
          m_entry.push_back(Entry{local, static_cast<int>(place - columns.begin()),
            static_cast<double>(m_space.numerator[k]) / m_space.denominator});
        }
      m_column.insert(m_column.end(), columns.begin(), columns.end());
      m_entry_start.push_back(static_cast<int>(m_entry.size()));
      m_column_start.push_back(static_cast<int>(m_column.size()));
    }
  }

  int number_of_slots(int f) const { return m_column_start[f + 1] - m_column_start[f]; }

  // the lower triangle, column by column
  void build_pattern()
  {
    const int n = m_space.number_of_free_variables();
    std::vector<std::size_t> count(n + 1, 0);
    for(int f = 0; f < m_number_of_faces; ++f)
      for(int i = 0; i < number_of_slots(f); ++i)
        count[m_column[m_column_start[f] + i] + 1] += number_of_slots(f) - i;
    for(int c = 0; c < n; ++c)
      count[c + 1] += count[c];
    std::vector<int> rows(count[n]);
    std::vector<std::size_t> end(count.begin(), count.end() - 1);
    for(int f = 0; f < m_number_of_faces; ++f)
      for(int i = m_column_start[f]; i < m_column_start[f + 1]; ++i)
        for(int j = i; j < m_column_start[f + 1]; ++j)
          rows[end[m_column[i]]++] = m_column[j];
    fill_matrix(count, rows);
  }

  void fill_matrix(const std::vector<std::size_t>& first, std::vector<int>& rows)
  {
    const int n = m_space.number_of_free_variables();
    std::vector<int> start(1, 0), inner;
    for(int c = 0; c < n; ++c)
    {
      const auto begin = rows.begin() + first[c];
      auto end = rows.begin() + first[c + 1];
      std::sort(begin, end);
      end = std::unique(begin, end);
      inner.insert(inner.end(), begin, end);
      start.push_back(static_cast<int>(inner.size()));
    }
    m_matrix.resize(n, n);
    m_matrix.resizeNonZeros(inner.size());
    std::copy(start.begin(), start.end(), m_matrix.outerIndexPtr());
    std::copy(inner.begin(), inner.end(), m_matrix.innerIndexPtr());
  }

  // for each face the places in the matrix of its pairs of slots (i, j), j <= i
  void locate_entries()
  {
    m_place_start.assign(1, 0);
    for(int f = 0; f < m_number_of_faces; ++f)
    {
      for(int i = m_column_start[f]; i < m_column_start[f + 1]; ++i)
        for(int j = m_column_start[f]; j <= i; ++j)
        {
          const int* begin = m_matrix.innerIndexPtr() + m_matrix.outerIndexPtr()[m_column[j]];
          const int* end = m_matrix.innerIndexPtr() + m_matrix.outerIndexPtr()[m_column[j] + 1];
          const int* place = std::lower_bound(begin, end, m_column[i]);
          m_place.push_back(static_cast<int>(place - m_matrix.innerIndexPtr()));
        }
      m_place_start.push_back(m_place.size());
    }
  }

  void scatter(int f, const Eigen::Matrix<double, 6, 6>& local_matrix,
               const Eigen::Matrix<double, 6, 1>& local_gradient)
  {
    double* values = m_matrix.valuePtr();
    const int* place = m_place.data() + m_place_start[f];
    for(int a = m_entry_start[f]; a < m_entry_start[f + 1]; ++a)
    {
      const Entry& e = m_entry[a];
      m_gradient[m_column[m_column_start[f] + e.slot]] += e.coefficient * local_gradient[e.local];
      for(int b = m_entry_start[f]; b < m_entry_start[f + 1]; ++b)
        if(m_entry[b].slot <= e.slot)
          values[place[e.slot * (e.slot + 1) / 2 + m_entry[b].slot]]
            += e.coefficient * m_entry[b].coefficient * local_matrix(e.local, m_entry[b].local);
    }
  }

  const Map_space& m_space;
  int m_number_of_faces;
  std::vector<int> m_wedge;               // per corner
  std::vector<Reference> m_reference;     // per face
  std::vector<Entry> m_entry;
  std::vector<int> m_entry_start;         // per face
  std::vector<int> m_column;
  std::vector<int> m_column_start;        // per face
  std::vector<int> m_place;
  std::vector<std::size_t> m_place_start; // per face
  Matrix m_matrix;
  Eigen::VectorXd m_gradient;
  Sparse_solver m_solver;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MAP_SYSTEM_H
