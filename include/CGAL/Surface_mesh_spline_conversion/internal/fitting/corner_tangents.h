// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_CORNER_TANGENTS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_CORNER_TANGENTS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/patches/split_corners.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Chooses the direction in which the surface leaves the corners of the boundary between two quads
// (paper, Fig. 6(b)).
//
// The patches on both sides share this direction, and each has the angle between it and a tangent
// of the boundary. Neither may reach a straight angle, or the patch folds over, even where the
// corresponding isoline of the map runs like that. Hence the direction is that of the bisector of
// the interior angle, in the plane of both tangents; then the normals agree at the corner, too.
//
// Where both outer rows have a triple knot, it is given by one control point of the second row.
// Where only the outermost row has one, several control points act on the derivative at the corner,
// and the fit has to respect it as a constraint, see Crease_smoother.
template <typename Surface, typename Target>
class Corner_tangents
{
  typedef std::size_t size_type;
  typedef typename Target::FT FT;
  typedef typename Surface::Point_3 Point_3;
  typedef Eigen::Vector3d Vector;

public:
  Corner_tangents(Surface& surface, const Target& target) : m_surface(surface), m_target(target) {}

  // sets the control points that give the direction alone, and marks them in `is_fixed`
  void operator()(std::vector<bool>& is_fixed)
  {
    for_each_split_corner(m_target.layout(), [&](size_type first, int i, size_type second, int j)
      { fix(first, i, second, j, is_fixed); });
  }

  // Returns the wanted derivative inwards at the corner that is the end of side `i` of `first` and
  // the begin of side `j` of `second`, by the coordinate of the quads. It is not finite where the
  // tangents have no bisector.
  Vector derivative(size_type first, int i, size_type second, int j) const
  {
    const auto corner = from_side<FT>(i, FT(1), FT(0));
    const double bay = inward_extent(m_surface.patch_at(first, corner[0], corner[1]), i);
    const auto end = from_side<FT>(i, FT(1), FT(bay));
    const Vector chord = to_eigen(m_target.point(first, end[0], end[1]))
                       - to_eigen(m_target.point(first, corner[0], corner[1]));
    return bisector(first, i, second, j) * (chord.norm() / bay);
  }

private:
  // smaller derivatives of functions, relative to the largest one, are rounding
  static constexpr double relative_rounding = 1e-10;

  // tangents that enclose a smaller angle do not determine a plane (in radians)
  static constexpr double smallest_angle = 0.1;

  // the corner is the end of side `i` of `first` and the begin of side `j` of `second`
  void fix(size_type first, int i, size_type second, int j, std::vector<bool>& is_fixed)
  {
    const auto corner = from_side<FT>(i, FT(1), FT(0));
    const size_type patch = m_surface.patch_at(first, corner[0], corner[1]);
    double coefficient = 0;
    const size_type point = second_row_point(patch, i, is_fixed, coefficient);
    if(point == is_fixed.size())
      return;
    const Vector wanted = derivative(first, i, second, j);
    if(!wanted.allFinite())
      return;
    const Vector p = to_eigen(m_target.point(first, corner[0], corner[1])) + wanted / coefficient;
    m_surface.set_control_point(point, Point_3(FT(p[0]), FT(p[1]), FT(p[2])));
    is_fixed[point] = true;
  }

  double inward_extent(size_type patch, int i) const
  {
    const auto origin = m_surface.patch_origin(patch);
    return CGAL::to_double(i % 2 == 0 ? origin.v1 - origin.v0 : origin.u1 - origin.u0);
  }

  // The control point that may move on which the inward derivative at the end of side `i` depends,
  // and its coefficient. Returns the size of `is_fixed` unless there is exactly one.
  size_type second_row_point(size_type patch, int i, const std::vector<bool>& is_fixed,
                             double& coefficient) const
  {
    const auto corner = from_side<FT>(i, FT(1), FT(0)), inner = from_side<FT>(i, FT(1), FT(1));
    std::vector<typename Surface::Basis_function> functions;
    m_surface.basis(patch, corner[0], corner[1], 1, functions);
    std::vector<std::pair<double, size_type> > candidates;
    double largest = 0;
    for(const auto& f : functions)
    {
      const double value = CGAL::to_double(inner[0] - corner[0]) * f.value[1]
                           + CGAL::to_double(inner[1] - corner[1]) * f.value[2];
      largest = (std::max)(largest, std::abs(value));
      if(!is_fixed[f.control_point])
        candidates.emplace_back(value, f.control_point);
    }
    size_type result = is_fixed.size();
    for(const auto& candidate : candidates)
    {
      if(std::abs(candidate.first) <= relative_rounding * largest)
        continue;
      if(result != is_fixed.size())
        return is_fixed.size();
      coefficient = candidate.first;
      result = candidate.second;
    }
    return result;
  }

  Vector tangent(size_type quad, int side, bool at_end) const
  {
    const size_type chain = m_target.layout().boundary_side(quad, side).chain;
    const FT x = at_end ? FT(double(m_target.number_of_sides(chain))) : FT(0);
    return to_eigen(m_target.curve_derivative(chain, x, 1)).normalized();
  }

  Vector bisector(size_type first, int i, size_type second, int j) const
  {
    const Vector in = tangent(first, i, true), out = tangent(second, j, false);
    const Vector fan = fan_normal(first, i, second, j);
    Vector normal = in.cross(out);
    if(normal.norm() > smallest_angle)
      normal *= normal.dot(fan) > 0 ? 1 : -1;
    else
      normal = fan;
    const Vector sum = in + out;
    if(sum.norm() <= smallest_angle) // the boundary turns back: the bisector goes straight on
      return (in - out).normalized();
    return normal.cross(sum).normalized();
  }

  // the normal of the fan of points around the corner, from the outgoing to the incoming curve
  Vector fan_normal(size_type first, int i, size_type second, int j) const
  {
    constexpr int steps = 8;
    constexpr double radius = 0.5;
    std::vector<Vector> fan;
    const auto corner = from_side<FT>(i, FT(1), FT(0));
    const Vector origin = to_eigen(m_target.point(first, corner[0], corner[1]));
    for(int k = 0; k <= 2 * steps; ++k)
    {
      const double angle = CGAL_PI * k / (2 * steps);
      const FT x(radius * std::cos(angle)), y(radius * std::sin(angle));
      const auto uv = k <= steps ? from_side<FT>(j, x, y) : from_side<FT>(i, FT(1) + x, y);
      fan.push_back(to_eigen(m_target.point(k <= steps ? second : first, uv[0], uv[1])) - origin);
    }
    Vector normal = Vector::Zero();
    for(std::size_t k = 0; k + 1 < fan.size(); ++k)
      normal += fan[k].cross(fan[k + 1]);
    return normal.normalized();
  }

  Surface& m_surface;
  const Target& m_target;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_CORNER_TANGENTS_H
