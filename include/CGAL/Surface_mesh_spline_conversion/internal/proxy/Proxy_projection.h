// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_PROXY_PROJECTION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_PROXY_PROJECTION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Boundary_chains.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Proxy_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Surface_walk.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Maps points of a proxy mesh to its original, unfolded: along the normals, which are interpolated
// between the vertices, from a vertex of the face on. Points of the boundary go to the boundary
// point with the same arc length; near the boundary, faces are warped such that both fit.
class Proxy_projection
{
public:
  // \pre `proxy` outlives this object
  explicit Proxy_projection(const Proxy_mesh& proxy)
    : m_proxy(&proxy), m_walk(*proxy.unfolded), m_chains(*proxy.unfolded)
  {
    for(int f = 0; f < proxy.mesh.number_of_faces(); ++f)
    {
      m_border.push_back(-1);
      m_longest_side.push_back(0);
      for(int i = 0; i < 3; ++i)
      {
        m_longest_side.back()
          = (std::max)(m_longest_side.back(), proxy.mesh.vector(3 * f + i).norm());
        if(proxy.mesh.is_border(3 * f + i))
          m_border.back() = i;
      }
    }
  }

  Working_location operator()(const Working_location& at) const
  {
    const std::array<int, 3>& t = m_proxy->mesh.triangles[at.face];
    const std::array<double, 3>& b = at.barycentric;
    int nearest = 0;
    for(int i = 1; i < 3; ++i)
      if(b[i] > b[nearest])
        nearest = i;
    if(b[nearest] >= 1 - rounding)
      return m_proxy->place[t[nearest]];
    Eigen::Vector3d q = Eigen::Vector3d::Zero(), n = Eigen::Vector3d::Zero();
    for(int i = 0; i < 3; ++i)
    {
      q += b[i] * m_proxy->mesh.points[t[i]];
      n += b[i] * m_proxy->normal[t[i]];
    }
    if(m_border[at.face] >= 0)
    {
      const int i = m_border[at.face], j = (i + 1) % 3;
      const double share = b[i] + b[j];
      if(share >= 1 - rounding)
        return at_boundary(3 * at.face + i, b[j] / share);
      if(share > 0)
        q += share * boundary_offset(3 * at.face + i, b[j] / share);
    }
    std::array<int, 3> faces;
    for(int i = 0; i < 3; ++i)
      faces[i] = m_proxy->place[t[(nearest + i) % 3]].face;
    return m_walk.project(q, n, faces, m_longest_side[at.face]);
  }

  // on the unfolded original
  Eigen::Vector3d point(const Working_location& at) const { return m_walk.point(at); }

private:
  // of barycentric coordinates
  static constexpr double rounding = 1e-12;

  // the point of the original that belongs to the point `t` of the boundary edge `h` of the proxy
  Working_location at_boundary(int h, double t) const
  {
    const Working_mesh::Boundary_piece& piece = m_proxy->mesh.boundary_piece[h];
    return m_chains(piece.chain, piece.first + t * (piece.last - piece.first));
  }

  Eigen::Vector3d boundary_offset(int h, double t) const
  {
    const Working_mesh& mesh = m_proxy->mesh;
    return m_walk.point(at_boundary(h, t)) - (1 - t) * mesh.points[mesh.source(h)]
           - t * mesh.points[mesh.target(h)];
  }

  const Proxy_mesh* m_proxy;
  Surface_walk m_walk;
  Boundary_chains m_chains;
  std::vector<int> m_border;          // per face: the number of its boundary edge, or -1
  std::vector<double> m_longest_side; // per face: no image lies farther away
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_PROXY_PROJECTION_H
