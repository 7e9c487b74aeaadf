// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_PROXY_INVERSE_MAP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_PROXY_INVERSE_MAP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Layout_inverse_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Mapped_quads.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Proxy_projection.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

inline std::vector<std::array<Eigen::Vector3d, 3> > face_corners(const Working_mesh& mesh)
{
  std::vector<std::array<Eigen::Vector3d, 3> > corners;
  corners.reserve(mesh.triangles.size());
  for(const std::array<int, 3>& t : mesh.triangles)
    corners.push_back({{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}});
  return corners;
}

// The points of the mesh of a map of a proxy, which is a refinement of the proxy, as points of the
// mesh that the proxy stands for: they are projected to that mesh, unfolded, whose faces are those
// of the mesh.
class Proxy_image
{
public:
  Proxy_image(const Working_mesh& mesh, std::shared_ptr<const Proxy_mesh> proxy)
    : m_proxy(std::move(proxy)), m_parents(mesh, face_corners(m_proxy->mesh)),
      m_projection(*m_proxy)
  {}

  const Working_mesh& original() const { return *m_proxy->original; }

  // on the original
  Working_location operator()(const Working_location& at) const
  {
    return m_projection(m_parents(at));
  }

private:
  std::shared_ptr<const Proxy_mesh> m_proxy;
  Parent_faces m_parents;
  Proxy_projection m_projection;
};

// The inverse map of a layout that has been extracted from an integer grid map of a proxy.
template <typename GeomTraits>
class Proxy_inverse_map
  : public Quad_layout<GeomTraits>::Inverse_map
{
public:
  typedef typename Quad_layout<GeomTraits>::FT FT;
  typedef typename Quad_layout<GeomTraits>::Location Location;

  // `input_faces`: the corners of the input faces in the order of `faces(tm)`
  Proxy_inverse_map(Mapped_quads quads, std::shared_ptr<const Proxy_image> image,
                    std::vector<std::array<Eigen::Vector3d, 3> > input_faces)
    : m_quads(std::move(quads)), m_image(std::move(image)), m_input_faces(std::move(input_faces))
  {}

  Location operator()(std::size_t quad, FT u, FT v) const override
  {
    const Working_location at
      = (*m_image)(m_quads(quad, CGAL::to_double(u), CGAL::to_double(v)));
    return make_surface_location<GeomTraits>(in_input_face(at), point_at(m_image->original(), at));
  }

private:
  // from a face of the original of the proxy, which may be part of an input face
  Working_location in_input_face(const Working_location& at) const
  {
    const Working_mesh& original = m_image->original();
    Working_location result{static_cast<int>(original.parent[at.face]), {{0, 0, 0}}};
    for(int i = 0; i < 3; ++i)
    {
      const std::array<double, 3> corner = barycentric_coordinates(
        m_input_faces[result.face], original.points[original.triangles[at.face][i]]);
      for(int j = 0; j < 3; ++j)
        result.barycentric[j] += at.barycentric[i] * corner[j];
    }
    return result;
  }

  Mapped_quads m_quads;
  std::shared_ptr<const Proxy_image> m_image;
  std::vector<std::array<Eigen::Vector3d, 3> > m_input_faces;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_PROXY_INVERSE_MAP_H
