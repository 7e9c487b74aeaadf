// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_CURVATURE_ALIGNMENT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_CURVATURE_ALIGNMENT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/field/Face_geometry.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The wish of a face to have a cross direction along its principal curvature directions, or along
// the one that the user wants.
struct Curvature_alignment
{
  std::vector<std::complex<double> > cross;  // per face: e^(4 i angle) of a wanted direction
  std::vector<double> confidence;            // per face: of curvature in [0, 1), 0 at umbilics
};

inline std::vector<Eigen::Vector3d> vertex_normals(const Working_mesh& mesh,
                                                   const Face_geometry& geometry)
{
  std::vector<Eigen::Vector3d> normals(mesh.number_of_vertices(), Eigen::Vector3d::Zero());
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
  {
    const int first = 3 * (h / 3);
    const Eigen::Vector3d normal = mesh.vector(first).cross(mesh.vector(first + 1)).normalized();
    normals[mesh.source(h)] += geometry.corner_angle[h] * normal;
  }
  for(Eigen::Vector3d& normal : normals)
    if(normal.squaredNorm() > 0)
      normal.normalize();
  return normals;
}

// The shape operator of a face that fits the differences of the vertex normals along its edges in
// the sense of least squares (Rusinkiewicz 2004), as a symmetric tensor in space.
inline Eigen::Matrix3d face_shape_operator(const Working_mesh& mesh, int f,
                                           const Eigen::Vector3d& axis,
                                           const std::vector<Eigen::Vector3d>& normals)
{
  const Eigen::Vector3d normal = mesh.vector(3 * f).cross(mesh.vector(3 * f + 1)).normalized();
  Eigen::Matrix<double, 3, 2> frame;
  frame << axis, normal.cross(axis);
  Eigen::Matrix3d system = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_hand_side = Eigen::Vector3d::Zero();
  for(int h = 3 * f; h < 3 * f + 3; ++h)
  {
    const Eigen::Vector2d e = frame.transpose() * mesh.vector(h);
    const Eigen::Vector2d d
      = frame.transpose() * (normals[mesh.target(h)] - normals[mesh.source(h)]);
    Eigen::Matrix<double, 2, 3> row;
    row << e[0], e[1], 0, 0, e[0], e[1];
    system += row.transpose() * row;
    right_hand_side += row.transpose() * d;
  }
  const Eigen::Vector3d s = system.inverse() * right_hand_side;
  Eigen::Matrix2d shape;
  shape << s[0], s[1], s[1], s[2];
  if(!shape.allFinite())
    shape.setZero();
  return frame * shape * frame.transpose();
}

// Averages of the face tensors over the faces at the vertices, weighted by area, and back.
inline void smooth_tensors(const Working_mesh& mesh, const Face_geometry& geometry,
                           std::vector<Eigen::Matrix3d>& tensors)
{
  std::vector<Eigen::Matrix3d> sum(mesh.number_of_vertices(), Eigen::Matrix3d::Zero());
  std::vector<double> weight(mesh.number_of_vertices(), 0.);
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
  {
    sum[mesh.source(h)] += geometry.area[h / 3] * tensors[h / 3];
    weight[mesh.source(h)] += geometry.area[h / 3];
  }
  for(int f = 0; f < mesh.number_of_faces(); ++f)
  {
    tensors[f].setZero();
    for(int v : mesh.triangles[f])
      tensors[f] += sum[v] / (3 * weight[v]);
  }
}

// Number of averages after which a tensor has spread over about a third of a quad: curvature below
// this scale cannot be followed by the quads.
inline int number_of_tensor_averages(const Working_mesh& mesh, const Face_geometry& geometry,
                                     double size)
{
  const int most_averages = 12;
  double area = 0;
  for(double a : geometry.area)
    area += a;
  const double edge = std::sqrt(area / mesh.number_of_faces() * 2);
  const double averages = std::pow(size / (2 * edge), 2);
  return 1 + static_cast<int>((std::min)(averages, most_averages - 1.));
}

inline void align_face(const Working_mesh& mesh, int f, const Eigen::Vector3d& axis, double size,
                       const Eigen::Matrix3d& tensor, Curvature_alignment& alignment)
{
  // a difference of the curvatures of half a radian per quad gets half of the confidence
  const double half_confidence = 0.5;
  const Eigen::Vector3d normal = mesh.vector(3 * f).cross(mesh.vector(3 * f + 1)).normalized();
  const Eigen::Vector3d second_axis = normal.cross(axis);
  const double s00 = axis.dot(tensor * axis), s01 = axis.dot(tensor * second_axis);
  const double s11 = second_axis.dot(tensor * second_axis);
  const std::complex<double> anisotropy((s00 - s11) / 2, s01);
  const double difference = 2 * std::abs(anisotropy);
  const double larger = (difference + std::abs(s00 + s11)) / 2;
  if(!(difference > 0) || !std::isfinite(difference))
    return;
  const double turn = difference * size;
  alignment.cross[f] = std::pow(anisotropy / std::abs(anisotropy), 2);
  alignment.confidence[f] = turn * turn / (turn * turn + half_confidence * half_confidence)
                            * (std::min)(1., difference / larger);
}

inline Curvature_alignment align_with_curvature(const Cross_field& field,
                                                const Face_geometry& geometry)
{
  const Working_mesh& mesh = field.mesh;
  const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh, geometry);
  std::vector<Eigen::Matrix3d> tensors(mesh.number_of_faces());
  for(int f = 0; f < mesh.number_of_faces(); ++f)
    tensors[f] = face_shape_operator(mesh, f, field.axis[f], normals);

  double mean_size = 0;
  for(double size : field.size)
    mean_size += size / field.size.size();
  const int averages = number_of_tensor_averages(mesh, geometry, mean_size);
  for(int i = 0; i < averages; ++i)
    smooth_tensors(mesh, geometry, tensors);

  Curvature_alignment alignment;
  alignment.cross.assign(mesh.number_of_faces(), 0.);
  alignment.confidence.assign(mesh.number_of_faces(), 0.);
  for(int f = 0; f < mesh.number_of_faces(); ++f)
    align_face(mesh, f, field.axis[f], field.size[mesh.triangles[f][0]], tensors[f], alignment);
  return alignment;
}

// Replaces curvature by the directions that the user wants, where there are some.
inline void align_with_wanted_directions(const Cross_field& field, Curvature_alignment& alignment)
{
  // the field follows within a tenth of a quad
  const double confidence = 100;
  if(field.wanted_direction.empty())
    return;
  for(int f = 0; f < field.mesh.number_of_faces(); ++f)
  {
    const Eigen::Vector3d& wanted = field.wanted_direction[field.mesh.parent[f]];
    const Eigen::Vector3d second_axis = field.mesh.normal(f).normalized().cross(field.axis[f]);
    const std::complex<double> direction(wanted.dot(field.axis[f]), wanted.dot(second_axis));
    if(!(std::abs(direction) > 0))
      continue;
    alignment.cross[f] = std::pow(direction / std::abs(direction), 4);
    alignment.confidence[f] = confidence;
  }
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FIELD_CURVATURE_ALIGNMENT_H
