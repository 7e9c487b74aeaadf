// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FAIRNESS_ENERGY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FAIRNESS_ENERGY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// How much the curvature of a surface varies: the integral of
// |S_uuu|^2 + 3 |S_uuv|^2 + 3 |S_uvv|^2 + |S_vvv|^2 over each patch in the parameters of the
// layout, in which all quads have the size 1. It vanishes for quadratic surfaces. Each patch has a
// weight of its own.
//
// The third derivatives are differences of second ones between the four Gauss points of the
// patch; S_uuu and S_vvv of a bicubic patch are exact. A patch where functions act that vanish at
// all samples has no energy: without them, it would depend on the origin.
class Fairness_energy
{
public:
  typedef std::size_t size_type;

  // all weights are 0
  template <typename Surface, typename Samples>
  Fairness_energy(const Surface& surface, const Samples& samples)
    : m_derivatives(samples.number_of_patches()), m_weights(samples.number_of_patches(), 0)
  {
    for_each_index(m_derivatives.size(), [&](size_type p)
      { m_derivatives[p] = third_derivatives(surface, samples, p); });
  }

  double weight(size_type patch) const { return m_weights[patch]; }

  void set_weight(size_type patch, double weight) { m_weights[patch] = weight; }

  // returns the matrix whose product with the control points of a patch, in the order of the
  // samples, has the energy of the patch as its squared norm
  const Eigen::MatrixXd& derivatives(size_type patch) const { return m_derivatives[patch]; }

private:
  // the functions of a patch at one of its points: S_uu and S_vv
  struct Second_derivatives
  {
    Eigen::RowVectorXd uu, vv;
    bool is_complete; // do the samples see all functions?
  };

  template <typename Surface, typename Samples>
  static Second_derivatives second_derivatives(const Surface& surface, const Samples& samples,
                                               size_type patch, double s, double t)
  {
    typedef typename Surface::FT FT;
    const auto o = surface.patch_origin(patch);
    std::vector<typename Surface::Basis_function> functions;
    surface.basis(patch, o.u0 + FT(s) * (o.u1 - o.u0), o.v0 + FT(t) * (o.v1 - o.v0), 2, functions);
    const Eigen::Index n = Eigen::Index(samples.number_of_functions(patch));
    Second_derivatives result{Eigen::RowVectorXd::Zero(n), Eigen::RowVectorXd::Zero(n), true};
    for(const auto& f : functions)
    {
      const Eigen::Index i = Eigen::Index(samples.local_index(patch, f.control_point));
      if(i == n)
      {
        result.is_complete = false;
        break;
      }
      result.uu[i] += f.value[3];
      result.vv[i] += f.value[5];
    }
    return result;
  }

  template <typename Surface, typename Samples>
  static Eigen::MatrixXd third_derivatives(const Surface& surface, const Samples& samples,
                                           size_type patch)
  {
    const std::array<double, 2> gauss{{0.5 - std::sqrt(1. / 12), 0.5 + std::sqrt(1. / 12)}};
    const auto o = surface.patch_origin(patch);
    const double width = CGAL::to_double(o.u1 - o.u0), height = CGAL::to_double(o.v1 - o.v0);
    const double weight = std::sqrt(width * height / 2); // of each of two samples
    const double per_u = weight / ((gauss[1] - gauss[0]) * width);
    const double per_v = weight / ((gauss[1] - gauss[0]) * height);
    const Eigen::Index functions = Eigen::Index(samples.number_of_functions(patch));
    std::array<std::array<Second_derivatives, 2>, 2> at;
    for(size_type i = 0; i < 2; ++i)
      for(size_type j = 0; j < 2; ++j)
      {
        at[i][j] = second_derivatives(surface, samples, patch, gauss[i], gauss[j]);
        if(!at[i][j].is_complete)
          return Eigen::MatrixXd(0, functions);
      }
    Eigen::MatrixXd result(8, functions);
    for(size_type k = 0; k < 2; ++k)
    {
      const Eigen::Index row = 4 * Eigen::Index(k);
      result.row(row) = per_u * (at[1][k].uu - at[0][k].uu);
      result.row(row + 1) = std::sqrt(3.) * per_v * (at[k][1].uu - at[k][0].uu);
      result.row(row + 2) = std::sqrt(3.) * per_u * (at[1][k].vv - at[0][k].vv);
      result.row(row + 3) = per_v * (at[k][1].vv - at[k][0].vv);
    }
    return result;
  }

  std::vector<Eigen::MatrixXd> m_derivatives;
  std::vector<double> m_weights;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_FAIRNESS_ENERGY_H
