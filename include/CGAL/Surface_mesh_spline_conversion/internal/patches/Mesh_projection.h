// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_MESH_PROJECTION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_MESH_PROJECTION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/compatibility.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Closest points on a triangle mesh. Distances are computed with doubles for all kernels.
class Mesh_projection
{
public:
  typedef Simple_cartesian<double> Kernel;
  typedef Kernel::Point_3 Point_3;
  typedef Kernel::Vector_3 Vector_3;

  // a point of the mesh; the face is its position in `faces(tm)`
  struct Foot
  {
    Point_3 point;
    std::size_t face;
  };

  template <typename TriangleMesh, typename VertexPointMap>
  Mesh_projection(const TriangleMesh& tm, const VertexPointMap& vpm)
  {
    auto numbers = get(CGAL::dynamic_vertex_property_t<std::size_t>(), tm);
    for(auto v : vertices(tm))
    {
      put(numbers, v, m_vertices.size());
      m_vertices.push_back(to_double_point(get(vpm, v)));
    }
    m_triangles.reserve(num_faces(tm));
    for(auto f : faces(tm))
    {
      std::array<std::size_t, 3> corners;
      std::size_t i = 0;
      for(auto v : vertices_around_face(halfedge(f, tm), tm))
        corners[i++] = get(numbers, v);
      m_corners.push_back(corners);
      m_triangles.emplace_back(m_vertices[corners[0]], m_vertices[corners[1]],
                               m_vertices[corners[2]]);
      for(i = 0; i < 3; ++i)
        m_mean_edge_length += std::sqrt(CGAL::squared_distance(
          m_vertices[corners[i]], m_vertices[corners[(i + 1) % 3]])) / double(3 * num_faces(tm));
    }
    // a triangle without area has no plane to project to; its neighbours cover it
    for(std::size_t f = 0; f < m_triangles.size(); ++f)
      if(normal(f) != NULL_VECTOR)
        m_tree.insert(Primitive(&m_triangles[f]));
    m_tree.build();
  }

  Mesh_projection(const Mesh_projection&) = delete;
  Mesh_projection& operator=(const Mesh_projection&) = delete;

  // returns the point of the mesh closest to `query`; the closer the face `hint` is, the faster.
  // Only what is closer than the point of this face need be searched.
  Foot operator()(const Point_3& query, std::size_t hint) const
  {
    const auto result = m_tree.closest_point_and_primitive(
      query, std::make_pair(closest_point(hint, query), &m_triangles[hint]));
    return Foot{result.first, static_cast<std::size_t>(result.second - m_triangles.data())};
  }

  // returns the normal of a face, of the length of twice its area
  Vector_3 normal(std::size_t face) const
  {
    const Kernel::Triangle_3& t = m_triangles[face];
    return CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  }

  // returns the barycentric coordinates of a point of a face
  std::array<double, 3> barycentric(std::size_t face, const Point_3& p) const
  {
    const Kernel::Triangle_3& t = m_triangles[face];
    return Polygon_mesh_processing::barycentric_coordinates(t[0], t[1], t[2], p);
  }

  // returns the point of a face that is closest to `p`
  Point_3 closest_point(std::size_t face, const Point_3& p) const
  {
    return Kernel().construct_projected_point_3_object()(m_triangles[face], p);
  }

  std::size_t number_of_faces() const { return m_triangles.size(); }

  // an edge between two faces counts twice
  double mean_edge_length() const { return m_mean_edge_length; }

  // the vertices have the numbers of their positions in `vertices(tm)`
  std::size_t number_of_vertices() const { return m_vertices.size(); }
  const Point_3& vertex(std::size_t i) const { return m_vertices[i]; }
  const std::array<std::size_t, 3>& corners(std::size_t face) const { return m_corners[face]; }

  template <typename Point>
  static Point_3 to_double_point(const Point& p)
  {
    return Point_3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }

private:
  // a model of AABBPrimitive that names a triangle by its address
  struct Primitive
  {
    typedef const Kernel::Triangle_3* Id;
    typedef Kernel::Point_3 Point;
    typedef Kernel::Triangle_3 Datum;

    Primitive() : m_id(nullptr) {}
    explicit Primitive(Id id) : m_id(id) {}
    const Datum& datum() const { return *m_id; }
    const Id& id() const { return m_id; }
    const Point& reference_point() const { return m_id->vertex(0); }

    typedef const Datum& Datum_reference;
    typedef const Point& Point_reference;

  private:
    Id m_id;
  };

  std::vector<Point_3> m_vertices;
  std::vector<std::array<std::size_t, 3> > m_corners; // of the faces
  std::vector<Kernel::Triangle_3> m_triangles;
  AABB_tree<AABB_traits_3<Kernel, Primitive> > m_tree;
  double m_mean_edge_length = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_MESH_PROJECTION_H
