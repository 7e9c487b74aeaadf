// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_HARMONIC_COORDINATES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_HARMONIC_COORDINATES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Unpivoted_lu.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

template <typename Vector>
double tangent_of_half_angle(const std::pair<Vector, Vector>& corner)
{
  // by the diagonals of a rhombus
  const Vector a = corner.first.normalized(), b = corner.second.normalized();
  return (a - b).norm() / (a + b).norm();
}

template <typename Vector>
double cotangent(const std::pair<Vector, Vector>& corner)
{
  const double t = tangent_of_half_angle(corner);
  return (1 / t - t) / 2;
}

// the neighbours of an inner vertex with their weights
template <typename Corner_vectors>
std::vector<std::pair<int, double> > harmonic_weights_at(const Working_mesh& mesh, int v,
                                                         const Corner_vectors& corner)
{
  const double smallest_weight = 1e-3;
  std::vector<std::pair<int, double> > weights;
  bool is_positive = true;
  mesh.for_each_outgoing(v, [&](int h)
  {
    const double weight = cotangent(corner(Working_mesh::previous(h)))
                          + cotangent(corner(Working_mesh::previous(mesh.opposite[h])));
    is_positive = is_positive && weight > -smallest_weight;
    weights.emplace_back(mesh.target(h), (std::max)(smallest_weight, weight));
  });
  if(is_positive)
    return weights;
  weights.clear();
  mesh.for_each_outgoing(v, [&](int h)
  {
    const int beside = Working_mesh::next(mesh.opposite[h]);
    weights.emplace_back(mesh.target(h), (tangent_of_half_angle(corner(h))
                                          + tangent_of_half_angle(corner(beside)))
                                         / corner(h).first.norm());
  });
  return weights;
}

// Sets the inner points to harmonic coordinates. All weights are positive, so that nothing folds
// behind a convex boundary: cotangents, or mean value coordinates (Floater 2003) where one of these
// would be negative; both reproduce linear functions. `corner(h)`: the vectors from a corner along
// its halfedge and to the third corner, in the plane of the face.
template <typename Corner_vectors>
bool set_harmonic_coordinates(const Working_mesh& mesh, std::vector<Eigen::Vector2d>& points,
                              const Corner_vectors& corner)
{
  std::vector<int> unknown(mesh.number_of_vertices(), -1);
  int n = 0;
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
    if(!mesh.is_border_vertex(v))
      unknown[v] = n++;
  if(n == 0)
    return false;
  std::vector<Eigen::Triplet<double> > entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n, 2);
  const auto add = [&](int i, int w, double weight)
  {
    entries.emplace_back(i, i, weight);
    if(unknown[w] >= 0)
      entries.emplace_back(i, unknown[w], -weight);
    else
      right.row(i) += weight * points[w].transpose();
  };
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
    if(const int i = unknown[v]; i >= 0)
      for(const auto& weight : harmonic_weights_at(mesh, v, corner))
        add(i, weight.first, weight.second);
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  // all rows are diagonally dominant
  const Unpivoted_lu solver(matrix);
  if(!solver.is_regular())
    return false;
  const Eigen::MatrixX2d x = solver.solve(right);
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
    if(unknown[v] >= 0)
      points[v] = x.row(unknown[v]).transpose();
  return true;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_HARMONIC_COORDINATES_H
