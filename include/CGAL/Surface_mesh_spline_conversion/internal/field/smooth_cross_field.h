// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_SMOOTH_CROSS_FIELD_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_SMOOTH_CROSS_FIELD_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Sparse_solver.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/field/curvature_alignment.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Computes the angles of a cross field: boundary faces are aligned with the boundary, the others
// follow the principal curvature directions where these are distinct, and vary as little as
// possible. The representation e^(4 i angle) is smooth across edges; it is smoothed by a few steps
// of heat flow over the length of a quad, each followed by a normalisation (Viertel and Osting
// 2019), which removes singularities that quads of this size cannot resolve.
class Cross_field_smoother
{
public:
  Cross_field_smoother(Cross_field& field, const Face_geometry& geometry)
    : m_field(field), m_mesh(field.mesh), m_geometry(geometry),
      m_alignment(align_with_curvature(field, geometry)), m_is_fixed(m_mesh.number_of_faces(), 0)
  {
    align_with_wanted_directions(field, m_alignment);
    mark_boundary_faces();
    mark_faces_of_closed_components();
    number_unknowns();
  }

  // solves for the directions; returns `false` if a linear system could not be solved
  bool smooth()
  {
    fix_angles();
    if(m_number_of_unknowns == 0)
      return true;
    initialize_values();
    assemble(m_matrix);
    m_solver.analyze(m_matrix);
    m_is_analyzed = true;
    if(!factorize(0) || !solve(0))
      return false;
    if(!factorize(1))
      return false;
    for(int i = 0; i < number_of_heat_steps; ++i)
      if(!solve(1))
        return false;
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
      if(!m_is_fixed[f])
        m_field.angle[f] = std::arg(m_value[f]) / 4;
    return true;
  }

  // sets each period jump to the closest matching of the directions
  void match_directions()
  {
    m_field.period_jump.assign(m_mesh.number_of_halfedges(), 0);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
    {
      const int o = m_mesh.opposite[h];
      if(o < h)
        continue;
      const double turn = m_field.angle[h / 3] + m_field.kappa[h] - m_field.angle[o / 3];
      m_field.period_jump[h] = static_cast<int>(std::lround(turn / right_angle));
      m_field.period_jump[o] = -m_field.period_jump[h];
    }
  }

  // solves for the smoothest angles with the given period jumps and angles of the fixed faces
  bool smooth_with_fixed_period_jumps()
  {
    if(m_number_of_unknowns == 0)
      return true;
    Real_matrix matrix(m_number_of_unknowns, m_number_of_unknowns);
    assemble(matrix);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(m_number_of_unknowns);
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
      if(m_unknown[f] >= 0)
      {
        const double weight = alignment_weight(f);
        matrix.valuePtr()[matrix.outerIndexPtr()[m_unknown[f]]] += weight;
        b[m_unknown[f]] = weight * aligned_angle(f) + angle_flux(f);
      }
    Sparse_solver<double> solver;
    if(m_is_analyzed)
      solver.analyze(matrix, m_solver);
    else
      solver.analyze(matrix);
    if(!solver.factorize(matrix))
      return false;
    const Eigen::VectorXd x = solver.solve(b);
    if(!x.allFinite())
      return false;
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
      if(m_unknown[f] >= 0)
        m_field.angle[f] = x[m_unknown[f]];
    return true;
  }

private:
  typedef std::complex<double> Complex;
  typedef Eigen::SparseMatrix<Complex> Complex_matrix;
  typedef Eigen::SparseMatrix<double> Real_matrix;

  static constexpr int number_of_heat_steps = 4;
  // weight of the alignment with curvature against smoothness, over the area of one quad
  static constexpr double alignment_strength = 1;

  void mark_boundary_faces()
  {
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.is_border(h))
        m_is_fixed[h / 3] = 1;
  }

  // without boundary the rotation is free: fix the face that knows best
  void mark_faces_of_closed_components()
  {
    const std::vector<int> component = face_components(m_mesh);
    std::vector<int> best;
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      if(component[f] == static_cast<int>(best.size()))
        best.push_back(f);
      int& b = best[component[f]];
      if(m_is_fixed[b])
        continue;
      if(m_is_fixed[f] || m_alignment.confidence[f] > m_alignment.confidence[b])
        b = f;
    }
    for(int f : best)
      m_is_fixed[f] = 1;
  }

  // there is only one boundary halfedge in a face, because ears have been split
  void fix_angles()
  {
    m_field.angle.assign(m_mesh.number_of_faces(), 0.);
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
      if(m_is_fixed[f])
        m_field.angle[f] = std::arg(m_alignment.cross[f]) / 4;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.is_border(h))
        m_field.angle[h / 3] = m_geometry.halfedge_angle[h];
  }

  void number_unknowns()
  {
    m_unknown.assign(m_mesh.number_of_faces(), -1);
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
      if(!m_is_fixed[f])
        m_unknown[f] = m_number_of_unknowns++;
    m_matrix.resize(m_number_of_unknowns, m_number_of_unknowns);
  }

  void initialize_values()
  {
    m_value.assign(m_mesh.number_of_faces(), Complex(0));
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
      if(m_is_fixed[f])
        m_value[f] = std::polar(1., 4 * m_field.angle[f]);
  }

  double quad_area(int f) const
  {
    double size = 0;
    for(int v : m_mesh.triangles[f])
      size += m_field.size[v] / 3;
    return size * size;
  }

  double alignment_weight(int f) const
  {
    return alignment_strength * m_alignment.confidence[f] * m_geometry.area[f] / quad_area(f);
  }

  // the entry for the edge of `h`, in the row of its face
  void add_entry(int h, Complex& value) const
  {
    value -= std::polar(m_geometry.edge_weight[h], -4 * m_field.kappa[h]);
  }

  void add_entry(int h, double& value) const { value -= m_geometry.edge_weight[h]; }

  // the lower half of the connection Laplacian (complex) or of the Laplacian (real)
  template <typename Matrix>
  void assemble(Matrix& matrix)
  {
    const int most_entries = 4; // per column
    m_diagonal.assign(m_number_of_unknowns, 0.);
    matrix.reserve(most_entries * m_number_of_unknowns);
    std::vector<std::pair<int, int> > below; // row, and halfedge in its face
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      const int column = m_unknown[f];
      if(column < 0)
        continue;
      below.clear();
      for(int h = 3 * f; h < 3 * f + 3; ++h)
        if(!m_mesh.is_border(h))
        {
          m_diagonal[column] += m_geometry.edge_weight[h];
          const int row = m_unknown[m_mesh.opposite[h] / 3];
          if(row > column)
            below.emplace_back(row, m_mesh.opposite[h]);
        }
      std::sort(below.begin(), below.end());
      matrix.startVec(column);
      matrix.insertBack(column, column) = m_diagonal[column];
      for(std::size_t k = 0; k < below.size(); ++k)
      {
        if(k == 0 || below[k].first != below[k - 1].first)
          matrix.insertBack(below[k].first, column) = 0;
        add_entry(below[k].second, matrix.data().value(matrix.data().size() - 1));
      }
    }
    matrix.finalize();
  }

  // `time` is the duration of a heat step divided by the area of a quad; 0 stands for infinity
  double heat_weight(int f, double time) const
  {
    return time > 0 ? m_geometry.area[f] / (time * quad_area(f)) : 0.;
  }

  bool factorize(double time)
  {
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
      if(m_unknown[f] >= 0)
        m_matrix.valuePtr()[m_matrix.outerIndexPtr()[m_unknown[f]]] // the first one of its column
          = m_diagonal[m_unknown[f]] + alignment_weight(f) + heat_weight(f, time);
    return m_solver.factorize(m_matrix);
  }

  bool solve(double time)
  {
    Eigen::VectorXcd b = Eigen::VectorXcd::Zero(m_number_of_unknowns);
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      if(m_unknown[f] < 0)
        continue;
      Complex& sum = b[m_unknown[f]];
      sum = heat_weight(f, time) * m_value[f] + alignment_weight(f) * m_alignment.cross[f];
      for(int h = 3 * f; h < 3 * f + 3; ++h)
        if(!m_mesh.is_border(h) && m_is_fixed[m_mesh.opposite[h] / 3])
          sum += std::polar(m_geometry.edge_weight[h], -4 * m_field.kappa[h])
                 * m_value[m_mesh.opposite[h] / 3];
    }
    const Eigen::VectorXcd x = m_solver.solve(b);
    if(!x.allFinite())
      return false;
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
      if(m_unknown[f] >= 0)
      {
        const Complex z = x[m_unknown[f]];
        m_value[f] = std::abs(z) > 0 ? z / std::abs(z) : Complex(1);
      }
    return true;
  }

  // the principal direction that is closest to the present direction
  double aligned_angle(int f) const
  {
    const double wanted = std::arg(m_alignment.cross[f]) / 4;
    return wanted + right_angle * std::lround((m_field.angle[f] - wanted) / right_angle);
  }

  // right-hand side of the real system: known angles and turns on the three edges
  double angle_flux(int f) const
  {
    double sum = 0;
    for(int h = 3 * f; h < 3 * f + 3; ++h)
    {
      if(m_mesh.is_border(h))
        continue;
      const int g = m_mesh.opposite[h] / 3;
      double turn = m_field.period_jump[h] * right_angle - m_field.kappa[h];
      if(m_is_fixed[g])
        turn += m_field.angle[g];
      sum += m_geometry.edge_weight[h] * turn;
    }
    return sum;
  }

  Cross_field& m_field;
  const Working_mesh& m_mesh;
  const Face_geometry& m_geometry;
  Curvature_alignment m_alignment;
  std::vector<char> m_is_fixed;      // per face
  std::vector<int> m_unknown;        // per face, -1 if fixed
  int m_number_of_unknowns = 0;
  std::vector<double> m_diagonal;    // per unknown, of the Laplacian alone
  std::vector<Complex> m_value;      // per face, e^(4 i angle)
  Complex_matrix m_matrix;
  Sparse_solver<Complex> m_solver;
  bool m_is_analyzed = false;        // the pattern of the matrices
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_SMOOTH_CROSS_FIELD_H
