// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_NURCC_SURFACE_3_POSITIONS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_NURCC_SURFACE_3_POSITIONS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/cubic_B_spline.h>
#include <CGAL/T_NURCC_surface_3.h>

#include <algorithm>
#include <array>
#include <vector>

namespace CGAL {

template <typename K>
void T_NURCC_surface_3<K>::positions(size_type i, size_type nu, size_type nv,
                                     std::vector<Point_3>& out) const
{
  const Patch& patch = m_basis.patch(i);
  out.assign((nu + 1) * (nv + 1), Point_3(ORIGIN));
  if(!is_extraordinary_patch(i))
    for(size_type e = m_basis.first_element(patch); e < m_basis.last_element(patch); ++e)
      add_positions(patch, m_basis.element(e), nu, nv, out);
  else
    for(size_type k = 0; k < out.size(); ++k)
      out[k] = position(i, patch.u0 + (patch.u1 - patch.u0) * double(k % (nu + 1)) / double(nu),
                        patch.v0 + (patch.v1 - patch.v0) * double(k / (nu + 1)) / double(nv));
}

// computes the points of the grid on element `e`, ends included
template <typename K>
void T_NURCC_surface_3<K>::add_positions(const Patch& patch, const Regular_element& e, size_type nu,
                                         size_type nv, std::vector<Point_3>& out) const
{
  namespace internal = Surface_mesh_spline_conversion::internal;
  std::array<Vector_3, 16> points;
  points.fill(NULL_VECTOR);
  add_functions(e, Rectangle{e.u0, e.v0, e.u1, e.v1}, points);
  for(size_type j = 0; j <= nv; ++j)
  {
    const double v = (patch.v1 - patch.v0) * double(j) / double(nv);
    if(v < e.v0 || e.v1 < v)
      continue;
    const internal::Row row = internal::bernstein((v - e.v0) / (e.v1 - e.v0), 0);
    std::array<Vector_3, 4> curve; // the Bezier points of the line along `u`
    for(size_type k = 0; k < 4; ++k)
      curve[k] = FT(row[0]) * points[k] + FT(row[1]) * points[4 + k] + FT(row[2]) * points[8 + k]
                 + FT(row[3]) * points[12 + k];
    for(size_type i = 0; i <= nu; ++i)
    {
      const double u = (patch.u1 - patch.u0) * double(i) / double(nu);
      if(u < e.u0 || e.u1 < u)
        continue;
      const internal::Row column = internal::bernstein((u - e.u0) / (e.u1 - e.u0), 0);
      out[j * (nu + 1) + i] = ORIGIN + (FT(column[0]) * curve[0] + FT(column[1]) * curve[1]
                                        + FT(column[2]) * curve[2] + FT(column[3]) * curve[3]);
    }
  }
}

template <typename K>
void T_NURCC_surface_3<K>::basis_on_grid(size_type i, size_type nu, size_type nv,
                                         std::vector<size_type>& control_points,
                                         std::vector<double>& values) const
{
  using Surface_mesh_spline_conversion::internal::Row;
  using Surface_mesh_spline_conversion::internal::dot;
  CGAL_precondition(!is_extraordinary_patch(i));
  const Patch& patch = m_basis.patch(i);
  const size_type first = m_basis.element(m_basis.first_element(patch)).first;
  const size_type last = m_basis.element(m_basis.last_element(patch) - 1).last;
  control_points.clear();
  std::vector<size_type> numbers; // of the functions from the first to the last one
  for(size_type f = first; f < last; ++f)
  {
    const size_type point = m_basis.function(f).control_point;
    const auto it = std::find(control_points.begin(), control_points.end(), point);
    numbers.push_back(size_type(it - control_points.begin()));
    if(it == control_points.end())
      control_points.push_back(point);
  }
  const size_type n = control_points.size();
  values.assign(n * (nu + 1) * (nv + 1), 0);
  for(size_type e = m_basis.first_element(patch); e < m_basis.last_element(patch); ++e)
  {
    const Regular_element& element = m_basis.element(e);
    const auto columns = bernstein_on_grid(patch.u1 - patch.u0, nu, element.u0, element.u1);
    for(const auto& row : bernstein_on_grid(patch.v1 - patch.v0, nv, element.v0, element.v1))
      for(size_type f = element.first; f < element.last; ++f)
      {
        const Row& factor_u = m_basis.factor_u(m_basis.function(f));
        const double value = dot(row.second, m_basis.factor_v(m_basis.function(f)));
        for(const auto& column : columns)
          values[(row.first * (nu + 1) + column.first) * n + numbers[f - first]]
            += value * dot(column.second, factor_u);
      }
  }
}

// Evaluates the Bernstein polynomials on [begin, end] at the ends of `n` intervals of [0, size], as
// far as these lie in [begin, end], the begin excluded unless it is zero.
template <typename K>
typename T_NURCC_surface_3<K>::Grid_rows
T_NURCC_surface_3<K>::bernstein_on_grid(double size, size_type n, double begin, double end)
{
  namespace internal = Surface_mesh_spline_conversion::internal;
  Grid_rows result;
  for(size_type i = 0; i <= n; ++i)
  {
    const double x = size * double(i) / double(n);
    if((begin < x || (i == 0 && begin == 0)) && x <= end)
      result.emplace_back(i, internal::bernstein((x - begin) / (end - begin), 0));
  }
  return result;
}

} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_NURCC_SURFACE_3_POSITIONS_H
