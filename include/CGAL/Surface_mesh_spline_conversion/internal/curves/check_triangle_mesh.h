// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CHECK_TRIANGLE_MESH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CHECK_TRIANGLE_MESH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The checks of the input mesh that every stage relies on. A defect is returned as a code and a
// message with the positions of the elements in vertices(tm) and faces(tm).
template <typename TriangleMesh, typename VertexPointMap>
class Triangle_mesh_check
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::face_descriptor face_descriptor;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point_3;
  typedef typename Kernel_traits<Point_3>::Kernel::FT FT;
  typedef typename boost::property_map<TriangleMesh,
            dynamic_vertex_property_t<std::size_t> >::const_type Vertex_number_map;

public:
  Triangle_mesh_check(const TriangleMesh& tm, const VertexPointMap& vpm)
    : m_tm(tm), m_vpm(vpm), m_number(get(dynamic_vertex_property_t<std::size_t>(), tm))
  {
    std::size_t n = 0;
    for(const vertex_descriptor v : vertices(tm))
      put(m_number, v, n++);
  }

  // checks everything; the first defect found is reported.
  Error_code operator()(std::string& message) const
  {
    if(faces(m_tm).begin() == faces(m_tm).end())
    {
      message = "The mesh has no face.";
      return Error_code::EMPTY_MESH;
    }
    Error_code code = check_triangles(message);
    if(code == Error_code::OK)
      code = check_manifold(message);
    if(code == Error_code::OK)
      code = check_coordinates(message);
    if(code == Error_code::OK)
      code = check_areas(message);
    return code;
  }

  // returns the position of v in vertices(tm).
  std::size_t number(vertex_descriptor v) const { return get(m_number, v); }

private:
  Error_code check_triangles(std::string& message) const
  {
    std::size_t n = 0;
    for(const face_descriptor f : faces(m_tm))
    {
      if(!is_triangle(halfedge(f, m_tm), m_tm))
      {
        message = "Face " + std::to_string(n)
                  + " is not a triangle; triangulate the mesh, for example with "
                    "CGAL::Polygon_mesh_processing::triangulate_faces().";
        return Error_code::NON_TRIANGULAR_MESH;
      }
      ++n;
    }
    return Error_code::OK;
  }

  // A vertex is manifold if the halfedges around it form one cycle, and at most one of these is on
  // the border.
  Error_code check_manifold(std::string& message) const
  {
    auto degree = get(dynamic_vertex_property_t<std::size_t>(), m_tm);
    for(const vertex_descriptor v : vertices(m_tm))
      put(degree, v, 0);
    for(const halfedge_descriptor h : halfedges(m_tm))
    {
      if(is_border(h, m_tm) && is_border(opposite(h, m_tm), m_tm))
      {
        message = "The edge between vertices " + name(source(h, m_tm)) + " and "
                  + name(target(h, m_tm)) + " belongs to no face; remove it.";
        return Error_code::NON_MANIFOLD_MESH;
      }
      put(degree, target(h, m_tm), get(degree, target(h, m_tm)) + 1);
    }
    for(const vertex_descriptor v : vertices(m_tm))
    {
      const std::size_t d = get(degree, v);
      if(d == 0)
      {
        message = "Vertex " + name(v) + " belongs to no face; remove it, for example with "
                  "CGAL::Polygon_mesh_processing::remove_isolated_vertices().";
        return Error_code::NON_MANIFOLD_MESH;
      }
      if(!has_one_umbrella(v, d))
      {
        message = "Several parts of the mesh meet only at vertex " + name(v)
                  + "; give each its own vertex, for example with "
                    "CGAL::Polygon_mesh_processing::duplicate_non_manifold_vertices().";
        return Error_code::NON_MANIFOLD_MESH;
      }
    }
    return Error_code::OK;
  }

  bool has_one_umbrella(vertex_descriptor v, std::size_t degree) const
  {
    std::size_t number_of_halfedges = 0, number_of_borders = 0;
    for(const halfedge_descriptor h : halfedges_around_target(halfedge(v, m_tm), m_tm))
    {
      ++number_of_halfedges;
      if(is_border(h, m_tm))
        ++number_of_borders;
      if(number_of_halfedges > degree)
        return false;
    }
    return number_of_halfedges == degree && number_of_borders <= 1;
  }

  Error_code check_coordinates(std::string& message) const
  {
    for(const vertex_descriptor v : vertices(m_tm))
      for(int i = 0; i < 3; ++i)
        if(!std::isfinite(get(m_vpm, v)[i]))
        {
          message = "A coordinate of vertex " + name(v) + " is not a finite number.";
          return Error_code::DEGENERATE_MESH;
        }
    return Error_code::OK;
  }

  Error_code check_areas(std::string& message) const
  {
    std::size_t n = 0;
    for(const face_descriptor f : faces(m_tm))
    {
      const halfedge_descriptor h = halfedge(f, m_tm);
      const std::array<vertex_descriptor, 3> v
        = {{source(h, m_tm), target(h, m_tm), target(next(h, m_tm), m_tm)}};
      if(!has_area(get(m_vpm, v[0]), get(m_vpm, v[1]), get(m_vpm, v[2])))
      {
        message = "Face " + std::to_string(n) + " (vertices " + name(v[0]) + ", " + name(v[1])
                  + ", " + name(v[2]) + ") has no area; collapse or flip one of its edges, or "
                    "remesh.";
        return Error_code::DEGENERATE_MESH;
      }
      ++n;
    }
    return Error_code::OK;
  }

  // The cross product is compared with the rounding errors of its own computation.
  static bool has_area(const Point_3& a, const Point_3& b, const Point_3& c)
  {
    const auto u = b - a, v = c - a;
    const FT rounding = FT(8) * (std::numeric_limits<FT>::epsilon)();
    const FT product = std::sqrt(u.squared_length()) * std::sqrt(v.squared_length());
    return std::sqrt(cross_product(u, v).squared_length()) > rounding * product;
  }

  std::string name(vertex_descriptor v) const { return std::to_string(number(v)); }

  const TriangleMesh& m_tm;
  VertexPointMap m_vpm;
  Vertex_number_map m_number;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CHECK_TRIANGLE_MESH_H
