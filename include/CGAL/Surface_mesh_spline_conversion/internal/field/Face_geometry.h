// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_FACE_GEOMETRY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_FACE_GEOMETRY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Cross_field.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

constexpr double pi = 3.14159265358979323846;
constexpr double right_angle = pi / 2;

// The corners of face `f` in its frame, relative to corner 0.
inline std::array<Eigen::Vector2d, 3>
flat_triangle(const Working_mesh& mesh, int f, const Eigen::Vector3d& axis)
{
  const std::array<int, 3>& t = mesh.triangles[f];
  const Eigen::Vector3d e1 = mesh.points[t[1]] - mesh.points[t[0]];
  const Eigen::Vector3d e2 = mesh.points[t[2]] - mesh.points[t[0]];
  const Eigen::Vector3d second_axis = e1.cross(e2).normalized().cross(axis);
  return {{Eigen::Vector2d(0, 0), Eigen::Vector2d(e1.dot(axis), e1.dot(second_axis)),
           Eigen::Vector2d(e2.dot(axis), e2.dot(second_axis))}};
}

inline double cross_product(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

// Intrinsic geometry of the faces of a working mesh.
struct Face_geometry
{
  std::vector<double> area;            // per face
  std::vector<double> corner_angle;    // per corner
  std::vector<double> halfedge_angle;  // per halfedge, in the frame of its face
  std::vector<double> edge_weight;     // per halfedge: of the difference across, 0 on the border

  Face_geometry(const Working_mesh& mesh, const std::vector<Eigen::Vector3d>& axis)
    : area(mesh.number_of_faces()), corner_angle(mesh.number_of_halfedges()),
      halfedge_angle(mesh.number_of_halfedges()), edge_weight(mesh.number_of_halfedges(), 0.)
  {
    for(int f = 0; f < mesh.number_of_faces(); ++f)
      measure_face(mesh, f, axis[f]);
    for(int h = 0; h < mesh.number_of_halfedges(); ++h)
      if(!mesh.is_border(h))
        edge_weight[h] = dual_edge_weight(mesh, h);
  }

  // sum of the corner angles at each vertex
  std::vector<double> total_angles(const Working_mesh& mesh) const
  {
    std::vector<double> total(mesh.number_of_vertices(), 0.);
    for(int h = 0; h < mesh.number_of_halfedges(); ++h)
      total[mesh.source(h)] += corner_angle[h];
    return total;
  }

private:
  void measure_face(const Working_mesh& mesh, int f, const Eigen::Vector3d& axis)
  {
    const std::array<Eigen::Vector2d, 3> p = flat_triangle(mesh, f, axis);
    area[f] = cross_product(p[1], p[2]) / 2;
    for(int i = 0; i < 3; ++i)
    {
      const Eigen::Vector2d d = p[(i + 1) % 3] - p[i], e = p[(i + 2) % 3] - p[i];
      halfedge_angle[3 * f + i] = std::atan2(d[1], d[0]);
      corner_angle[3 * f + i] = std::atan2(cross_product(d, e), d.dot(e));
    }
  }

  // ratio of the edge to the distance of the barycentres (in the mean), bounded because slivers
  // would make the system ill-conditioned without telling anything about the field
  double dual_edge_weight(const Working_mesh& mesh, int h) const
  {
    const double smallest_weight = 0.01, largest_weight = 100;
    const double areas = area[h / 3] + area[mesh.opposite[h] / 3];
    const double weight = 3 * mesh.vector(h).squaredNorm() / areas;
    return (std::min)((std::max)(weight, smallest_weight), largest_weight);
  }
};

// Gives every face a frame whose axis is its first halfedge, and the turns between the frames. The
// turns are computed once and then kept: wrapping them again would change period jumps.
inline void initialize_frames(Cross_field& field)
{
  const Working_mesh& mesh = field.mesh;
  field.axis.resize(mesh.number_of_faces());
  for(int f = 0; f < mesh.number_of_faces(); ++f)
    field.axis[f] = mesh.vector(3 * f).normalized();
  const Face_geometry geometry(mesh, field.axis);
  field.kappa.assign(mesh.number_of_halfedges(), 0.);
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
  {
    const int o = mesh.opposite[h];
    if(o < h)
      continue;
    const double turn = geometry.halfedge_angle[o] + pi - geometry.halfedge_angle[h];
    field.kappa[h] = std::remainder(turn, 2 * pi);
    field.kappa[o] = -field.kappa[h];
  }
}

// The turn of the directions against parallel transport when `h` is crossed.
inline double mismatch(const Cross_field& field, int h)
{
  const int f = h / 3, g = field.mesh.opposite[h] / 3;
  return field.angle[g] - field.angle[f] - field.kappa[h] + field.period_jump[h] * right_angle;
}

// The number of right angles at each vertex. Crossing `h` goes counter clockwise about its target.
// Returns the largest distance of a number from its integer: rounding error if all is well.
inline double compute_quarter_turns(const Cross_field& field, const Face_geometry& geometry,
                                    std::vector<int>& quarter_turns)
{
  const Working_mesh& mesh = field.mesh;
  std::vector<double> turn = geometry.total_angles(mesh);
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    if(!mesh.is_border(h))
      turn[mesh.target(h)] -= mismatch(field, h);
  quarter_turns.resize(mesh.number_of_vertices());
  double residual = 0;
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
  {
    quarter_turns[v] = static_cast<int>(std::lround(turn[v] / right_angle));
    residual = (std::max)(residual, std::abs(turn[v] / right_angle - quarter_turns[v]));
  }
  return residual;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_FACE_GEOMETRY_H
