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

#include <CGAL/Surface_mesh_spline_conversion/internal/field/Face_geometry.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Map_system.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
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

inline Map_system::Reference make_reference(const Eigen::Matrix2d& shape)
{
  return Map_system::Reference{shape.inverse(), shape.determinant() / 2};
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
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double> > solver(laplacian);
  const Eigen::VectorXd exponent = solver.solve(curvature);
  if(solver.info() != Eigen::Success || !exponent.allFinite())
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
