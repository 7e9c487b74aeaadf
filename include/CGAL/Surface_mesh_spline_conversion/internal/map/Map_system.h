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
#include <CGAL/Surface_mesh_spline_conversion/internal/Work_budget.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Cut_graph.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Distortion_energy.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/seam_equations.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <numeric>
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

  Map_system(const Working_mesh& mesh, const Cut_graph& cut, const Map_space& space,
             const Work_budget& budget)
    : m_space(space), m_number_of_faces(mesh.number_of_faces()),
      m_wedge(mesh.number_of_halfedges()), m_budget(budget)
  {
    for(int corner = 0; corner < mesh.number_of_halfedges(); ++corner)
      m_wedge[corner] = cut.wedge(corner);
    collect_entries();
    build_pattern();
    m_solver.analyze(m_matrix);
    estimate_work();
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
    m_budget.spend(m_work_per_step);
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

  void estimate_work()
  {
    const double work_per_place = 0.03, work_per_operation = 2e-4;
    m_work_per_step = work_per_place * static_cast<double>(m_place.size())
                      + work_per_operation * m_solver.number_of_operations();
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

  // A face that depends on a column, and the slot of the column in the face.
  struct Use
  {
    int face;
    int slot;
  };

  // the uses of column c are those from start[c] to start[c + 1]
  std::vector<Use> find_uses(std::vector<int>& start) const
  {
    start.assign(m_space.number_of_free_variables() + 1, 0);
    for(int c : m_column)
      ++start[c + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Use> uses(m_column.size());
    std::vector<int> end(start.begin(), start.end() - 1);
    for(int f = 0; f < m_number_of_faces; ++f)
      for(int i = 0; i < number_of_slots(f); ++i)
        uses[end[m_column[m_column_start[f] + i]]++] = Use{f, i};
    return uses;
  }

  // the lower triangle, column by column, and the places of the entries of the faces in it
  void build_pattern()
  {
    const int n = m_space.number_of_free_variables();
    reserve_places();
    std::vector<int> first_use, start(1, 0), inner;
    const std::vector<Use> uses = find_uses(first_use);
    std::vector<int> place(n, -1); // of each row in `inner`; before start[c]: in an earlier column
    for(int c = 0; c < n; ++c)
    {
      for(int k = first_use[c]; k < first_use[c + 1]; ++k)
        for(int i = m_column_start[uses[k].face] + uses[k].slot;
            i < m_column_start[uses[k].face + 1]; ++i)
          if(place[m_column[i]] < start[c])
          {
            place[m_column[i]] = start[c];
            inner.push_back(m_column[i]);
          }
      std::sort(inner.begin() + start[c], inner.end());
      start.push_back(static_cast<int>(inner.size()));
      for(int k = start[c]; k < start[c + 1]; ++k)
        place[inner[k]] = k;
      for(int k = first_use[c]; k < first_use[c + 1]; ++k)
        locate_entries(uses[k], place);
    }
    m_matrix.resize(n, n);
    m_matrix.resizeNonZeros(inner.size());
    std::copy(start.begin(), start.end(), m_matrix.outerIndexPtr());
    std::copy(inner.begin(), inner.end(), m_matrix.innerIndexPtr());
  }

  // for each face one place for each pair of slots (i, j), j <= i
  void reserve_places()
  {
    m_place_start.assign(1, 0);
    for(int f = 0; f < m_number_of_faces; ++f)
      m_place_start.push_back(m_place_start.back()
                              + number_of_slots(f) * (number_of_slots(f) + 1) / 2);
    m_place.resize(m_place_start.back());
  }

  static int pair_of_slots(int i, int j) { return i * (i + 1) / 2 + j; }

  void locate_entries(const Use& use, const std::vector<int>& place)
  {
    for(int i = use.slot; i < number_of_slots(use.face); ++i)
      m_place[m_place_start[use.face] + pair_of_slots(i, use.slot)]
        = place[m_column[m_column_start[use.face] + i]];
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
          values[place[pair_of_slots(e.slot, m_entry[b].slot)]]
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
  Sparse_solver<double> m_solver;
  Work_budget m_budget;
  double m_work_per_step = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_MAP_SYSTEM_H
