// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_RELAXATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_RELAXATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Place_cell.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A homeomorphism of the quads of a layout that maps each of them to itself: harmonic inside, by
// length on their sides.
class Quad_relaxation
{
public:
  typedef Quad_grid::Place Place;

  Quad_relaxation() {}

  Quad_relaxation(const Quad_grid& quads, const Place_cell::Locate& locate)
  {
    for(int q = 0; q < quads.number_of_quads() && m_is_valid; ++q)
      m_is_valid = add_quad(quads, q, locate);
  }

  // Have all quads been laid flat without inverted faces?
  bool is_valid() const { return m_is_valid; }

  Place operator()(const Place& place) const
  {
    for(int i = 0; i < 4; ++i)
      if(is_on_side(place, i))
        return place_on_side(place.quad, i, at_share(m_shares[place.quad][i],
                                                     along_side(place, i)));
    return m_cells[place.quad](Eigen::Vector2d(2 * place.u - 1, 2 * place.v - 1));
  }

private:
  static constexpr int steps = 2 * Place_cell::half;

  typedef std::array<double, steps + 1> Shares;

  static double at_share(const Shares& shares, double x)
  {
    const std::size_t i = std::upper_bound(shares.begin() + 1, shares.end() - 1, x)
                          - shares.begin() - 1;
    return (i + (x - shares[i]) / (shares[i + 1] - shares[i])) / steps;
  }

  bool add_quad(const Quad_grid& quads, int q, const Place_cell::Locate& locate)
  {
    Place_cell cell;
    for(int corner = 0; corner < 4; ++corner)
      cell.add_quarter(quads, Quad_grid::Side(q, corner), locate);
    m_shares.emplace_back();
    for(int i = 0; i < 4; ++i)
    {
      const Shares shares = shares_of_side(q, i, locate);
      m_shares.back()[i] = shares;
      for(int j = 0; j <= steps; ++j)
      {
        const Place at = place_on_side(q, i, shares[j]);
        cell.fix(quads, place_on_side(q, i, j / double(steps)),
                 Eigen::Vector2d(2 * at.u - 1, 2 * at.v - 1));
      }
    }
    const bool is_flat = cell.lay_flat();
    m_cells.push_back(std::move(cell));
    return is_flat;
  }

  static Shares shares_of_side(int q, int i, const Place_cell::Locate& locate)
  {
    Shares shares;
    shares[0] = 0;
    Eigen::Vector3d last = locate(place_on_side(q, i, 0));
    for(int j = 1; j <= steps; ++j)
    {
      const Eigen::Vector3d next = locate(place_on_side(q, i, j / double(steps)));
      shares[j] = shares[j - 1] + (next - last).norm();
      last = next;
    }
    for(double& x : shares)
      x /= shares[steps];
    return shares;
  }

  bool m_is_valid = true;
  std::vector<Place_cell> m_cells;                 // per quad
  std::vector<std::array<Shares, 4> > m_shares;    // per quad and side
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_QUAD_RELAXATION_H
