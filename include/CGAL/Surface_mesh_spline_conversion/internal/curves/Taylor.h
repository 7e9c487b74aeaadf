// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_TAYLOR_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_TAYLOR_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <array>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The Taylor polynomial f(t + x) = c[0] + c[1] x + ... + c[order] x^order of a function at one
// parameter t. Arithmetic on these truncated polynomials is the chain rule: whatever formula is
// written for numbers yields its derivatives up to `order` without a second formula.
template <typename FT, int order>
struct Taylor
{
  std::array<FT, order + 1> c;

  static Taylor constant(const FT& value)
  {
    Taylor result;
    result.c.fill(FT(0));
    result.c[0] = value;
    return result;
  }

  // returns the derivative of order k.
  FT derivative(int k) const
  {
    FT factorial(1);
    for(int i = 2; i <= k; ++i)
      factorial *= FT(i);
    return factorial * c[k];
  }

  friend Taylor operator+(const Taylor& a, const Taylor& b)
  {
    Taylor result;
    for(int k = 0; k <= order; ++k)
      result.c[k] = a.c[k] + b.c[k];
    return result;
  }

  friend Taylor operator*(const FT& a, const Taylor& b)
  {
    Taylor result;
    for(int k = 0; k <= order; ++k)
      result.c[k] = a * b.c[k];
    return result;
  }

  friend Taylor operator*(const Taylor& a, const Taylor& b)
  {
    Taylor result;
    for(int k = 0; k <= order; ++k)
    {
      result.c[k] = FT(0);
      for(int j = 0; j <= k; ++j)
        result.c[k] += a.c[j] * b.c[k - j];
    }
    return result;
  }

  // from a = q b: a_k = sum_j q_j b_{k-j}
  friend Taylor operator/(const Taylor& a, const Taylor& b)
  {
    Taylor quotient;
    for(int k = 0; k <= order; ++k)
    {
      FT remainder = a.c[k];
      for(int j = 0; j < k; ++j)
        remainder -= quotient.c[j] * b.c[k - j];
      quotient.c[k] = remainder / b.c[0];
    }
    return quotient;
  }
};

// computes sine and cosine together, from (sin x)' = x' cos x and (cos x)' = - x' sin x.
template <typename FT, int order>
void sine_and_cosine(const Taylor<FT, order>& x, Taylor<FT, order>& sine, Taylor<FT, order>& cosine)
{
  using std::cos;
  using std::sin;
  sine.c[0] = sin(x.c[0]);
  cosine.c[0] = cos(x.c[0]);
  for(int k = 1; k <= order; ++k)
  {
    sine.c[k] = cosine.c[k] = FT(0);
    for(int j = 1; j <= k; ++j)
    {
      sine.c[k] += FT(j) * x.c[j] * cosine.c[k - j];
      cosine.c[k] -= FT(j) * x.c[j] * sine.c[k - j];
    }
    sine.c[k] /= FT(k);
    cosine.c[k] /= FT(k);
  }
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_TAYLOR_H
