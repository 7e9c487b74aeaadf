// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_CURVED_FACETS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_CURVED_FACETS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/edge_turn.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Corner_normals.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A continuous surface of curved triangles, one over each face of a triangle mesh: point-normal
// triangles (A. Vlachos et al., "Curved PN triangles", Symposium on Interactive 3D Graphics, 2001)
// with the normals of `Corner_normals`, each of them described by its displacement from the face, a
// Bezier triangle of degree three.
//
// It interpolates the vertices, and keeps to the mesh at features. How far it leaves a face is
// bounded by the sagittas of the face and of its neighbors, except at features: where the mesh is
// flat, it stays flat, whatever the normals are.
class Curved_facets
{
public:
  typedef std::size_t size_type;

  template <typename TriangleMesh, typename VertexPointMap>
  Curved_facets(const TriangleMesh& tm, const VertexPointMap& vpm)
  {
    const Corner_normals<TriangleMesh, VertexPointMap> normals(tm, vpm);
    const auto sagittas = get(CGAL::dynamic_face_property_t<double>(), tm);
    for(const auto f : faces(tm))
      put(sagittas, f, facet_sagitta(f, normals, tm, vpm));
    const auto displacement = [&](const auto& e, const auto& h)
    {
      return edge_displacement(e, h, normals, tm, vpm, smaller_sagitta(e, sagittas, tm));
    };
    m_facets.reserve(num_faces(tm));
    for(const auto f : faces(tm))
    {
      Facet facet;
      size_type i = 0;
      for(const auto h : halfedges_around_face(halfedge(f, tm), tm))
      {
        facet.next[i] = displacement(next(h, tm), h);
        facet.previous[i] = displacement(h, h);
        ++i;
      }
      m_facets.push_back(facet);
    }
  }

  // returns the vector from the point of a face with the coordinates `b` to the curved triangle.
  // `face` is a position in `faces(tm)`, and the coordinates are those of `Surface_location`.
  Eigen::Vector3d displacement(size_type face, const std::array<double, 3>& b) const
  {
    const Facet& facet = m_facets[face];
    Eigen::Vector3d result(0, 0, 0), sum(0, 0, 0);
    for(size_type i = 0; i < 3; ++i)
    {
      result += 3 * b[i] * b[i]
                * (b[(i + 1) % 3] * facet.next[i] + b[(i + 2) % 3] * facet.previous[i]);
      sum += facet.next[i] + facet.previous[i];
    }
    // the control point in the middle lets quadratic displacements be reproduced
    return result + 6 * b[0] * b[1] * b[2] * sum / 4;
  }

  // returns a bound of the distance of the curved triangles from their faces: with their shares in
  // the one in the middle, the weights of the control points on the edges have the sum
  // 3 (b0 b1 + b1 b2 + b2 b0) <= 1
  double height() const
  {
    double result = 0;
    for(const Facet& facet : m_facets)
      for(size_type i = 0; i < 3; ++i)
        result = (std::max)({result, facet.next[i].norm(), facet.previous[i].norm()});
    return result;
  }

private:
  // On a sphere with equilateral facets the control points on the edges are 8/3 sagittas away.
  static constexpr double largest_share_of_sagitta = 4;

  // the control points at corner `i` on the edges to the next corner and to the previous one
  struct Facet
  {
    std::array<Eigen::Vector3d, 3> next, previous;
  };

  // returns the displacement of the control point of the edge of `e` that is closer to the target
  // of the halfedge `h`
  template <typename Halfedge, typename Normals, typename TriangleMesh, typename VertexPointMap>
  static Eigen::Vector3d edge_displacement(Halfedge e, Halfedge h, const Normals& normals,
                                           const TriangleMesh& tm, const VertexPointMap& vpm,
                                           double sagitta)
  {
    const bool is_border_edge = is_border(e, tm) || is_border(opposite(e, tm), tm);
    if(normals.is_end(e) && !is_border_edge)
      return Eigen::Vector3d::Zero();
    const auto v = target(h, tm), w = target(e, tm) == v ? source(e, tm) : target(e, tm);
    const Eigen::Vector3d normal = normals(h);
    const Eigen::Vector3d edge = to_eigen(get(vpm, w)) - to_eigen(get(vpm, v));
    const double height = -edge.dot(normal) / 3, limit = largest_share_of_sagitta * sagitta;
    return (std::max)(-limit, (std::min)(limit, height)) * normal;
  }

  // the largest sagitta at the edges of a face that are no features
  template <typename Face, typename Normals, typename TriangleMesh, typename VertexPointMap>
  static double facet_sagitta(Face f, const Normals& normals, const TriangleMesh& tm,
                              const VertexPointMap& vpm)
  {
    double result = 0;
    for(const auto h : halfedges_around_face(halfedge(f, tm), tm))
      if(!normals.is_end(h))
        result = (std::max)(result, edge_turn(h, tm, vpm).sagitta);
    return result;
  }

  // the sagitta of the flatter one of the faces at an edge
  template <typename Halfedge, typename SagittaMap, typename TriangleMesh>
  static double smaller_sagitta(Halfedge e, const SagittaMap& sagittas, const TriangleMesh& tm)
  {
    double result = (std::numeric_limits<double>::infinity)();
    for(const Halfedge h : {e, opposite(e, tm)})
      if(!is_border(h, tm))
        result = (std::min)(result, get(sagittas, face(h, tm)));
    return result;
  }

  std::vector<Facet> m_facets;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_CURVED_FACETS_H
