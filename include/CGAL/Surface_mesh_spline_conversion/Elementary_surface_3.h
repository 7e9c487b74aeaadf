// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_ELEMENTARY_SURFACE_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_ELEMENTARY_SURFACE_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Taylor.h>

#include <CGAL/assertions.h>

#include <array>
#include <cmath>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionCurveTraits

is a plane, cylinder, cone, sphere or torus with a parametrization \f$ S(u,v) \f$, the surfaces on
which trim curves of mechanical parts usually lie. With the frame \f$ O, X, Y, Z \f$, the radii
\f$ r, r_2 \f$ and the half angle \f$ a \f$:

- plane: \f$ O + u X + v Y \f$
- cylinder: \f$ O + r (\cos u\, X + \sin u\, Y) + v Z \f$
- cone: \f$ O + (r + v \sin a)(\cos u\, X + \sin u\, Y) + v \cos a\, Z \f$
- sphere: \f$ O + r \cos v\, (\cos u\, X + \sin u\, Y) + r \sin v\, Z \f$
- torus: \f$ O + (r + r_2 \cos v)(\cos u\, X + \sin u\, Y) + r_2 \sin v\, Z \f$

Angles are in radians.

\tparam K a model of `Kernel` with a floating-point number type
*/
template <typename K>
struct Elementary_surface_3
{
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  /// the kinds of surfaces
  enum Type { PLANE, CYLINDER, CONE, SPHERE, TORUS };

  Type type = PLANE;                                  ///< kind of the surface
  Point_3 origin = Point_3(FT(0), FT(0), FT(0));      ///< \f$ O \f$
  Vector_3 x_axis = Vector_3(FT(1), FT(0), FT(0));    ///< \f$ X \f$, a unit vector
  Vector_3 y_axis = Vector_3(FT(0), FT(1), FT(0));    ///< \f$ Y \f$, a unit vector
  Vector_3 z_axis = Vector_3(FT(0), FT(0), FT(1));    ///< \f$ Z \f$, a unit vector
  FT radius = FT(0);                                  ///< \f$ r \f$
  FT minor_radius = FT(0);                            ///< \f$ r_2 \f$
  FT half_angle = FT(0);                              ///< \f$ a \f$

  /// returns what is wrong with the members, or an empty string if they define a surface.
  std::string defect() const
  {
    // what a frame printed with six digits still satisfies
    const FT frame_tolerance(1e-5);
    const Vector_3 axes[3] = {x_axis, y_axis, z_axis};
    for(int i = 0; i < 3; ++i)
      for(int j = 0; j <= i; ++j)
        if(!(std::abs(axes[i] * axes[j] - FT(i == j ? 1 : 0)) < frame_tolerance))
          return "the axes are not orthonormal";
    for(int i = 0; i < 3; ++i)
      if(!std::isfinite(origin[i]))
        return "the origin is not a finite point";
    if(!std::isfinite(radius) || !std::isfinite(minor_radius) || !std::isfinite(half_angle))
      return "a radius or angle is not a finite number";
    if((type == CYLINDER || type == SPHERE || type == TORUS) && !(radius > FT(0)))
      return "the radius is not positive";
    if(type == TORUS && !(minor_radius > FT(0)))
      return "the minor radius is not positive";
    return std::string();
  }

  /// returns how many of the parameters, \f$ u \f$ first, are angles of full circles: none for a
  /// plane, both for a torus, else one.
  int number_of_periods() const { return type == PLANE ? 0 : type == TORUS ? 2 : 1; }

#ifndef DOXYGEN_RUNNING
  template <int order>
  using Taylor = internal::Taylor<FT, order>;

  // evaluates the surface at a curve u(t), v(t).
  template <int order>
  std::array<Taylor<order>, 3> evaluate(const Taylor<order>& u, const Taylor<order>& v) const
  {
    const std::array<Taylor<order>, 3> local = evaluate_in_frame(u, v);
    std::array<Taylor<order>, 3> result;
    for(int i = 0; i < 3; ++i)
    {
      result[i] = x_axis[i] * local[0] + y_axis[i] * local[1] + z_axis[i] * local[2];
      result[i].c[0] += origin[i];
    }
    return result;
  }

private:
  template <int order>
  std::array<Taylor<order>, 3> evaluate_in_frame(const Taylor<order>& u,
                                                 const Taylor<order>& v) const
  {
    const auto constant = [](const FT& value) { return Taylor<order>::constant(value); };
    Taylor<order> sine, cosine;
    switch(type)
    {
      case PLANE:
        return {{u, v, constant(FT(0))}};
      case CYLINDER:
        return revolve(u, constant(radius), v);
      case CONE:
        return revolve(u, constant(radius) + FT(std::sin(half_angle)) * v,
                       FT(std::cos(half_angle)) * v);
      case SPHERE:
        sine_and_cosine(v, sine, cosine);
        return revolve(u, radius * cosine, radius * sine);
      case TORUS:
        sine_and_cosine(v, sine, cosine);
        return revolve(u, constant(radius) + minor_radius * cosine, minor_radius * sine);
    }
    return {{u, v, constant(FT(0))}};
  }

  // returns the point of a surface of revolution at the angle u, a distance from the axis, a
  // height.
  template <int order>
  static std::array<Taylor<order>, 3> revolve(const Taylor<order>& u, const Taylor<order>& distance,
                                              const Taylor<order>& height)
  {
    Taylor<order> sine, cosine;
    sine_and_cosine(u, sine, cosine);
    return {{distance * cosine, distance * sine, height}};
  }
#endif
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_ELEMENTARY_SURFACE_3_H
