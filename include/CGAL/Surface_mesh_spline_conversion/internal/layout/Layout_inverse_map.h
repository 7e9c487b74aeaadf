// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LAYOUT_INVERSE_MAP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LAYOUT_INVERSE_MAP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Triangle_locator.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// barycentric coordinates of the orthogonal projection of `p` to the plane of a triangle
inline std::array<double, 3> barycentric_coordinates(const std::array<Eigen::Vector3d, 3>& triangle,
                                                     const Eigen::Vector3d& p)
{
  for(int i = 0; i < 3; ++i)
    if(p == triangle[i])
      return {{i == 0 ? 1. : 0., i == 1 ? 1. : 0., i == 2 ? 1. : 0.}};
  const Eigen::Vector3d normal
    = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  std::array<double, 3> b;
  for(int i = 0; i < 3; ++i)
    b[i] = normal.dot((triangle[(i + 1) % 3] - p).cross(triangle[(i + 2) % 3] - p))
           / normal.squaredNorm();
  return b;
}

// The points of a refined mesh as points of the faces that have been divided.
class Parent_faces
{
public:
  // `corners`: those of the faces that `mesh.parent` counts
  Parent_faces(const Working_mesh& mesh,
               const std::vector<std::array<Eigen::Vector3d, 3> >& corners)
    : m_faces(mesh.number_of_faces())
  {
    for(int f = 0; f < mesh.number_of_faces(); ++f)
    {
      m_faces[f].parent = static_cast<int>(mesh.parent[f]);
      for(int i = 0; i < 3; ++i)
        m_faces[f].in_parent[i]
          = barycentric_coordinates(corners[mesh.parent[f]], mesh.points[mesh.triangles[f][i]]);
    }
  }

  Working_location operator()(const Working_location& at) const
  {
    const Face& face = m_faces[at.face];
    Working_location result;
    result.face = face.parent;
    for(int i = 0; i < 3; ++i)
      result.barycentric[i] = at.barycentric[0] * face.in_parent[0][i]
                              + at.barycentric[1] * face.in_parent[1][i]
                              + at.barycentric[2] * face.in_parent[2][i];
    return result;
  }

private:
  struct Face
  {
    int parent;
    std::array<std::array<double, 3>, 3> in_parent; // barycentric coordinates of the corners
  };

  std::vector<Face> m_faces;
};

// a location of a layout from the parameter plane
template <typename GeomTraits>
Surface_location<GeomTraits> make_surface_location(const Working_location& at,
                                                   const Eigen::Vector3d& p)
{
  Surface_location<GeomTraits> location;
  location.face = static_cast<std::size_t>(at.face);
  location.point = typename GeomTraits::Point_3(p[0], p[1], p[2]);
  for(int i = 0; i < 3; ++i)
    location.barycentric[i] = typename GeomTraits::FT(at.barycentric[i]);
  return location;
}

// The inverse map of a layout. `LocateOnWorkingMesh` returns the `Working_location` at the local
// coordinates of a quad.
template <typename GeomTraits, typename LocateOnWorkingMesh>
class Layout_inverse_map
  : public Quad_layout<GeomTraits>::Inverse_map
{
public:
  typedef typename Quad_layout<GeomTraits>::FT FT;
  typedef typename Quad_layout<GeomTraits>::Location Location;

  // `input_faces`: the corners of the input faces in the order of `faces(tm)`
  Layout_inverse_map(LocateOnWorkingMesh locate, const Working_mesh& mesh,
                     const std::vector<std::array<Eigen::Vector3d, 3> >& input_faces)
    : m_locate(std::move(locate)), m_parents(mesh, input_faces), m_points(mesh.number_of_faces())
  {
    for(int f = 0; f < mesh.number_of_faces(); ++f)
      for(int i = 0; i < 3; ++i)
        m_points[f][i] = mesh.points[mesh.triangles[f][i]];
  }

  Location operator()(std::size_t quad, FT u, FT v) const override
  {
    const Working_location at = m_locate(quad, CGAL::to_double(u), CGAL::to_double(v));
    const std::array<Eigen::Vector3d, 3>& t = m_points[at.face];
    const std::array<double, 3>& b = at.barycentric;
    return make_surface_location<GeomTraits>(m_parents(at),
                                             b[0] * t[0] + b[1] * t[1] + b[2] * t[2]);
  }

private:
  LocateOnWorkingMesh m_locate;
  Parent_faces m_parents;
  std::vector<std::array<Eigen::Vector3d, 3> > m_points; // of the corners of each face
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LAYOUT_INVERSE_MAP_H
