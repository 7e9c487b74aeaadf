// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_BUILD_CROSS_FIELD_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_BUILD_CROSS_FIELD_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/field/Face_geometry.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/field/index_surgery.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/field/refine_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/field/smooth_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/refine_working_mesh.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The number of right angles is an integer by construction; more than this means broken input.
constexpr double largest_index_residual = 1e-6;

// Solves for the angles after changes of the period jumps, which the singularities depend on alone.
inline Error_code adapt_angles(Cross_field& field, const Face_geometry& geometry,
                               Cross_field_smoother& smoother)
{
  const std::vector<int> wanted = field.quarter_turns;
  if(!smoother.smooth_with_fixed_period_jumps())
    return Error_code::SINGULAR_SYSTEM;
  compute_quarter_turns(field, geometry, field.quarter_turns);
  return wanted == field.quarter_turns ? Error_code::OK : Error_code::DEGENERATE_MESH;
}

// Field and period jumps on the present mesh. `has_room` tells if all indices found a place.
inline Error_code try_to_build_cross_field(Cross_field& field, bool& has_room)
{
  initialize_frames(field);
  const Face_geometry geometry(field.mesh, field.axis);
  Cross_field_smoother smoother(field, geometry);
  if(!smoother.smooth())
    return Error_code::SINGULAR_SYSTEM;
  smoother.match_directions();
  if(!(compute_quarter_turns(field, geometry, field.quarter_turns) < largest_index_residual))
    return Error_code::DEGENERATE_MESH;
  has_room = Index_surgery(field, geometry).run();
  if(!has_room)
    return Error_code::OK;

  return adapt_angles(field, geometry, smoother);
}

// Multiplies the sizes by the spacing of the singularities, as long as the object lives.
class Spacing_as_size
{
public:
  explicit Spacing_as_size(Cross_field& field) : m_field(field) { multiply(field.spacing); }
  ~Spacing_as_size() { multiply(1 / m_field.spacing); }
  Spacing_as_size(const Spacing_as_size&) = delete;
  Spacing_as_size& operator=(const Spacing_as_size&) = delete;

private:
  void multiply(double factor)
  {
    if(factor != 1)
      for(double& size : m_field.size)
        size *= factor;
  }

  Cross_field& m_field;
};

// Computes the cross field on `field.mesh`, which has no ears, for the quad sizes `field.size`, and
// refines the mesh where field and map need it.
inline Error_code build_cross_field(Cross_field& field)
{
  const Spacing_as_size spacing(field);
  // each attempt halves the length of the longest edges
  const int most_attempts = 5;
  double longest_edge = 1;
  bool has_room = false;
  for(int i = 0; i < most_attempts && !has_room; ++i, longest_edge /= 2)
  {
    split_long_edges(field.mesh, field.size, longest_edge);
    const Error_code code = try_to_build_cross_field(field, has_room);
    if(code != Error_code::OK)
      return code;
  }
  if(!has_room)
    return Error_code::NO_SEAMLESS_MAP;
  refine_at_singularities(field);
  return Error_code::OK;
}

// Moves the singularities near the given vertices.
inline Error_code relocate_singularities(Cross_field& field, const std::vector<int>& vertices)
{
  const Spacing_as_size spacing(field);
  const Face_geometry geometry(field.mesh, field.axis);
  Index_surgery(field, geometry).relocate_near(vertices);
  Cross_field_smoother smoother(field, geometry);
  const Error_code code = adapt_angles(field, geometry, smoother);
  refine_at_singularities(field);
  return code;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_BUILD_CROSS_FIELD_H
