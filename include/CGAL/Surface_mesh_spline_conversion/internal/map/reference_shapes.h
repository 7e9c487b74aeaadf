// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_REFERENCE_SHAPES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_REFERENCE_SHAPES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Sparse_solver.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/field/Face_geometry.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Map_system.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Makes a sliver less extreme: its height is not what the map should preserve, and it would spoil
// the condition of the systems. `shape` holds two edge vectors.
inline Eigen::Matrix2d clamp_sliver(const Eigen::Matrix2d& shape)
{
  const double smallest_ratio = 0.1;
  Eigen::Matrix2d equilateral;
  equilateral << 1, 0.5, 0, std::sqrt(0.75);
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(shape * equilateral.inverse(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector2d s = svd.singularValues();
  if(s[1] >= smallest_ratio * s[0])
    return shape;
  s[1] = smallest_ratio * s[0];
  return svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose() * equilateral;
}

// Edge vectors of face `f` with respect to the direction at `angle` in its frame.
inline Eigen::Matrix2d turned_shape(const Working_mesh& mesh, int f, const Eigen::Vector3d& axis,
                                    double angle)
{
  const std::array<Eigen::Vector2d, 3> p = flat_triangle(mesh, f, axis);
  Eigen::Matrix2d turn, edges;
  turn << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
  edges << p[1], p[2];
  return turn * edges;
}

// By how much the map must scale the angles at the vertices that are singularities or corners,
// where this is not an accident of the discretization; one elsewhere.
inline std::vector<double> angle_ratios(const Working_mesh& mesh, const std::vector<int>& cone)
{
  std::vector<double> total_angle(mesh.number_of_vertices(), 0), ratio(total_angle.size(), 1);
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
  {
    const Eigen::Vector3d a = mesh.vector(h), b = -mesh.vector(Working_mesh::previous(h));
    total_angle[mesh.source(h)] += std::atan2(a.cross(b).norm(), a.dot(b));
  }
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
    if(mesh.is_corner[v] || cone[v] != (mesh.is_border_vertex(v) ? 2 : 4))
      ratio[v] = cone[v] * right_angle / total_angle[v];
  return ratio;
}

// Scales the angle at a singularity or corner of face `f`, and keeps the lengths of the two edges
// there. No map is isometric at such a vertex; the best one scales the angles of all its faces
// equally. With this reference it has no distortion. Otherwise a few faces would take all of it,
// and the isoline that leaves a concave corner could have more than a straight angle on one side.
inline Eigen::Matrix2d scale_angle(const Working_mesh& mesh, int f,
                                   const std::vector<double>& angle_ratio,
                                   const Eigen::Matrix2d& shape)
{
  const double largest_angle = 0.9 * pi;
  const std::array<Eigen::Vector2d, 3> p = {{Eigen::Vector2d::Zero(), shape.col(0), shape.col(1)}};
  for(int i = 0; i < 3; ++i)
  {
    const double ratio = angle_ratio[mesh.triangles[f][i]];
    if(ratio == 1)
      continue;
    const Eigen::Vector2d a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
    const double angle = std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
    const double turn = (std::min)(ratio * angle, largest_angle);
    const Eigen::Vector2d turned
      = Eigen::Rotation2Dd(turn) * a * (b.norm() / a.norm());
    std::array<Eigen::Vector2d, 3> q = p;
    q[(i + 2) % 3] = p[i] + turned;
    Eigen::Matrix2d result;
    result << q[1] - q[0], q[2] - q[0];
    return result;
  }
  return shape;
}

inline Map_system::Reference make_reference(const Eigen::Matrix2d& shape)
{
  return Map_system::Reference{shape.inverse(), shape.determinant() / 2};
}

// How much a face counts. The faces at the corners of the boundary are small, but what the isolines
// do there decides the shape of the patches: with this weight the angles on both sides of the
// isoline of a concave corner mostly differ by less than ten degrees, and stay well below a
// straight angle.
inline double face_weight(const Working_mesh& mesh, int f)
{
  const double corner_weight = 30;
  for(int v : mesh.triangles[f])
    if(mesh.is_corner[v])
      return corner_weight;
  return 1;
}

inline double face_size(const Working_mesh& mesh, const std::vector<double>& size, int f)
{
  return (size[mesh.triangles[f][0]] + size[mesh.triangles[f][1]] + size[mesh.triangles[f][2]]) / 3;
}

// Scales of the faces for which the scaled surface is flat up to the prescribed cones: the start of
// the map. Solves L s = K_target - K with the cotangent Laplacian; the scale is e^s (compare
// Springborn, Schroeder and Pinkall 2008, first Newton step). Returns an empty vector if this
// fails.
inline std::vector<double> conformal_scales(const Working_mesh& mesh, const Face_geometry& geometry,
                                            const std::vector<int>& cone)
{
  // slivers must not dominate, nor may extreme scales enter the start
  const double smallest_cotangent = 0.02, largest_cotangent = 20, largest_exponent = 2;
  // removes the constant functions from the kernel
  const double ridge = 1e-9;
  const int n = mesh.number_of_vertices();
  std::vector<Eigen::Triplet<double> > entries;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(n, ridge), curvature(n);
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
  {
    const double angle = geometry.corner_angle[Working_mesh::previous(h)];
    const double cotangent = (std::min)(largest_cotangent,
      (std::max)(smallest_cotangent, 0.5 * std::cos(angle) / std::sin(angle)));
    const int v = mesh.source(h), w = mesh.target(h);
    diagonal[v] += cotangent;
    diagonal[w] += cotangent;
    entries.emplace_back((std::max)(v, w), (std::min)(v, w), -cotangent);
  }
  const std::vector<double> total_angle = geometry.total_angles(mesh);
  for(int v = 0; v < n; ++v)
  {
    entries.emplace_back(v, v, diagonal[v]);
    curvature[v] = total_angle[v] - cone[v] * right_angle;
  }
  Eigen::SparseMatrix<double> laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  Sparse_solver<double> solver;
  solver.analyze(laplacian);
  if(!solver.factorize(laplacian))
    return std::vector<double>();
  const Eigen::VectorXd exponent = solver.solve(curvature);
  if(!exponent.allFinite())
    return std::vector<double>();

  std::vector<double> scale(mesh.number_of_faces());
  double mean = 0, total_area = 0;
  for(int f = 0; f < mesh.number_of_faces(); ++f)
  {
    const std::array<int, 3>& t = mesh.triangles[f];
    scale[f] = (exponent[t[0]] + exponent[t[1]] + exponent[t[2]]) / 3;
    mean += geometry.area[f] * scale[f];
    total_area += geometry.area[f];
  }
  mean /= total_area;
  for(double& s : scale)
    s = std::exp((std::min)(largest_exponent, (std::max)(-largest_exponent, s - mean)));
  return scale;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_REFERENCE_SHAPES_H
