// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_SURFACE_UNFOLDER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_SURFACE_UNFOLDER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <Eigen/Core>

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// of an inner vertex
inline Eigen::Vector3d mean_of_neighbors(const Working_mesh& mesh, int v)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int n = 0;
  mesh.for_each_outgoing(v, [&](int h)
  {
    sum += mesh.points[mesh.target(h)];
    ++n;
  });
  return sum / n;
}

// A mesh with the points of some vertices moved such that small folds, as by noise, vanish: the
// moving vertices approach the means of their neighbors. The faces stay the same, which makes it a
// homeomorphic image of the mesh: what is mapped to a point of a face belongs to the point of the
// same face of the mesh with the same barycentric coordinates.
class Surface_unfolder
{
public:
  // `start`: the mesh with the points of some vertices moved
  Surface_unfolder(const Working_mesh& mesh, const Working_mesh& start)
    : m_original(mesh), m_unfolded(std::make_shared<Working_mesh>(start))
  {}

  // follows later motions
  std::shared_ptr<const Working_mesh> mesh() const { return m_unfolded; }

  // Moves the inner vertices of some faces, and those that have been moved before.
  void unfold(const std::vector<int>& faces)
  {
    const int sweeps = 5;
    for(const int f : faces)
      for(const int v : m_original.triangles[f])
        if(!m_original.is_border_vertex(v))
          m_moving.insert(v);
    for(int sweep = 0; sweep < sweeps; ++sweep)
      for(const int v : m_moving)
        m_unfolded->points[v] = limited(v, mean_of_neighbors(*m_unfolded, v));
  }

private:
  // Folds of single faces vanish if vertices move no farther than their longest edge; larger shapes
  // are to remain.
  Eigen::Vector3d limited(int v, const Eigen::Vector3d& p) const
  {
    double longest = 0;
    m_original.for_each_outgoing(v, [&](int h)
      { longest = (std::max)(longest, m_original.vector(h).norm()); });
    const Eigen::Vector3d motion = p - m_original.points[v];
    const double distance = motion.norm();
    return distance > longest ? m_original.points[v] + longest / distance * motion : p;
  }

  const Working_mesh& m_original;
  std::shared_ptr<Working_mesh> m_unfolded;
  std::set<int> m_moving; // vertices
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_SURFACE_UNFOLDER_H
