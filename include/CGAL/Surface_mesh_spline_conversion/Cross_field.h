// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_CROSS_FIELD_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_CROSS_FIELD_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Proxy_mesh.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is a cross field on a triangle mesh, the result of `compute_cross_field()`: four orthogonal
directions in every face, and the information how they are continued across edges.

<b>How to read the cross field.</b> Halfedges are numbered `3 * f + i`, see the working mesh. Face
`f` has a frame: its first axis is the unit vector `axis[f]`, its second axis follows counter
clockwise in the plane of the face. Direction `j` of the cross of `f` makes the angle `angle[f] +
j * pi / 2` with the first axis. Let the halfedge `h` of `f` be opposite to a halfedge of `g`.
Unfolding `g` into the plane of `f` turns the axis of `g` into the axis of `f` when it is turned
by `kappa[h]`: a direction with the angle `a` in the frame of `f` has the angle `a + kappa[h]` in
that of `g`. Direction `j` of `f` continues as direction `j + period_jump[h]` of `g`. The
directions seen in a round trip about a vertex turn by an integer number of right angles:
`quarter_turns[v]` quads meet at `v` in a quad mesh that follows the field; 4 inside and 2 on the
boundary are the regular values, 1 belongs to a convex corner. All other vertices are the
singularities of the field.

The sum of `4 - quarter_turns[v]` over the inner vertices and of `2 - quarter_turns[v]` over the
boundary vertices is four times the Euler characteristic, for each connected component. In the face
of a boundary halfedge one direction of the cross is parallel to this halfedge.

\sa `compute_cross_field()`
*/
struct Cross_field
{
  internal::Working_mesh mesh;        ///< the mesh of the field, a refinement of the input or of
                                      ///< its proxy
  std::shared_ptr<const internal::Proxy_mesh> proxy; ///< the proxy, if there is one
  std::vector<Eigen::Vector3d> axis;  ///< per face: first axis of its frame
  std::vector<double> angle;          ///< per face: angle of direction 0
  std::vector<double> kappa;          ///< per halfedge: turn between the frames, 0 on the boundary
  std::vector<int> period_jump;       ///< per halfedge: matching of the directions
  std::vector<int> quarter_turns;     ///< per vertex: number of right angles
  std::vector<double> size;           ///< per vertex: wanted edge length of the quads
  std::vector<Eigen::Vector3d> wanted_direction; ///< per face that `mesh` counts as a parent: one
                                      ///< the field should follow, zero for none; may be empty
  double spacing = 1;                 ///< distances between singularities, and from them to the
                                      ///< boundary, are those for quads of `size` times this factor
  bool keeps_large_corners = false;   ///< whether corners of the boundary with an interior angle
                                      ///< above a full turn keep all their right angles
  bool gathers_singularities = false; ///< whether singularities of more than four right angles that
                                      ///< are near each other meet at one vertex
  double joining_distance = 0;        ///< in quad sizes: such singularities that are closer to each
                                      ///< other meet at one vertex with at most eight right angles
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_CROSS_FIELD_H
