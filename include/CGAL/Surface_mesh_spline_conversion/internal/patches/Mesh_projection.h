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

#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Planar_triangle.h>

#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
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

  static constexpr std::size_t none = static_cast<std::size_t>(-1); // in place of a face

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
    auto positions = get(CGAL::dynamic_face_property_t<std::size_t>(), tm);
    std::size_t number_of_faces = 0;
    for(auto f : faces(tm))
      put(positions, f, number_of_faces++);
    m_triangles.reserve(number_of_faces);
    m_planar_triangles.reserve(number_of_faces);
    for(auto f : faces(tm))
    {
      std::array<std::size_t, 3> corners, neighbors;
      std::size_t i = 0;
      for(auto h : halfedges_around_face(halfedge(f, tm), tm))
      {
        corners[i] = get(numbers, target(h, tm));
        const auto other = face(opposite(h, tm), tm);
        neighbors[i++] = other == boost::graph_traits<TriangleMesh>::null_face()
                           ? none : get(positions, other);
      }
      m_corners.push_back(corners);
      m_neighbors.push_back(neighbors);
      m_triangles.emplace_back(m_vertices[corners[0]], m_vertices[corners[1]],
                               m_vertices[corners[2]]);
      m_planar_triangles.emplace_back(std::array<Point_3, 3>{{m_vertices[corners[0]],
        m_vertices[corners[1]], m_vertices[corners[2]]}});
      m_has_area.push_back(normal(m_has_area.size()) != NULL_VECTOR);
    }
    number_edges();
  }

  // Returns a point of the mesh with no closer one to `query` around it: that at the end of a way
  // from the face `start` over neighbors that are not farther. This takes constant time if `start`
  // is near the point. Faces without area, which have no normal, are only crossed.
  Foot near_foot(const Point_3& query, std::size_t start) const
  {
    constexpr double rounding = 1 + 1e-12; // faces that meet at the point are at the same distance
    constexpr std::size_t usual_length = 16; // of a way, which then needs no memory of its own
    Foot result;
    double smallest = (std::numeric_limits<double>::infinity)();
    boost::container::small_vector<std::size_t, usual_length> way;
    const auto visit = [&](std::size_t face)
    {
      if(m_planar_triangles[face].squared_distance_of_plane(query) > rounding * smallest)
        return;
      const Point_3 p = closest_point(face, query);
      const double distance = CGAL::squared_distance(query, p);
      if(distance > rounding * smallest)
        return;
      if(way.empty() || (distance < smallest && m_has_area[face]))
        result = Foot{p, face};
      if(m_has_area[face])
        smallest = (std::min)(smallest, distance);
      way.push_back(face);
    };
    visit(start);
    for(std::size_t k = 0; k < way.size(); ++k)
      for(std::size_t f : m_neighbors[way[k]])
        if(f != none && std::find(way.begin(), way.end(), f) == way.end())
          visit(f);
    return result;
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
    return m_planar_triangles[face].closest_point(p);
  }

  std::size_t number_of_faces() const { return m_triangles.size(); }

  // the vertices have the numbers of their positions in `vertices(tm)`
  std::size_t number_of_vertices() const { return m_vertices.size(); }
  const Point_3& vertex(std::size_t i) const { return m_vertices[i]; }
  const std::array<std::size_t, 3>& corners(std::size_t face) const { return m_corners[face]; }

  // Neighbor `i` is across the edge that ends at corner `i`; it is `none` at the boundary.
  const std::array<std::size_t, 3>& neighbors(std::size_t face) const { return m_neighbors[face]; }

  // the edges inside the mesh
  std::size_t number_of_edges() const { return m_edges.size(); }

  // Edge `i` ends at corner `i`; it is `none` at the boundary.
  const std::array<std::size_t, 3>& edges(std::size_t face) const { return m_face_edges[face]; }

  Point_3 middle(std::size_t edge) const
  {
    return CGAL::midpoint(m_vertices[m_edges[edge][0]], m_vertices[m_edges[edge][1]]);
  }

  template <typename Point>
  static Point_3 to_double_point(const Point& p)
  {
    return Point_3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }

private:
  // numbers each edge between two faces when the first of them is visited
  void number_edges()
  {
    m_face_edges.resize(m_corners.size(), {{none, none, none}});
    for(std::size_t f = 0; f < m_corners.size(); ++f)
      for(std::size_t i = 0; i < 3; ++i)
      {
        const std::size_t other = m_neighbors[f][i];
        if(other == none || m_face_edges[f][i] != none)
          continue;
        const std::size_t source = m_corners[f][(i + 2) % 3], target = m_corners[f][i];
        m_face_edges[f][i] = m_edges.size();
        for(std::size_t j = 0; j < 3; ++j)
          if(m_neighbors[other][j] == f && m_corners[other][j] == source)
            m_face_edges[other][j] = m_edges.size();
        m_edges.push_back({{source, target}});
      }
  }

  std::vector<Point_3> m_vertices;
  std::vector<std::array<std::size_t, 3> > m_corners; // of the faces
  std::vector<std::array<std::size_t, 3> > m_neighbors;
  std::vector<std::array<std::size_t, 3> > m_face_edges;
  std::vector<std::array<std::size_t, 2> > m_edges; // their vertices
  std::vector<Kernel::Triangle_3> m_triangles;
  std::vector<Planar_triangle> m_planar_triangles;
  std::vector<char> m_has_area; // faces
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_MESH_PROJECTION_H
