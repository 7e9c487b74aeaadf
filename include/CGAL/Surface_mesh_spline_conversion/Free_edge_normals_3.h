// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_FREE_EDGE_NORMALS_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_FREE_EDGE_NORMALS_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/number_utils.h>

#include <CGAL/Surface_mesh_spline_conversion/Open_cascade_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Curve_set.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Free_edges.h>

#include <TopoDS_Shape.hxx>
#include <gp_Pnt.hxx>

#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

The class `Free_edge_normals_3` is a functor for the normals of the faces of a boundary
representation along its free edges. With points and tangents of curves it serves as named parameter
`boundary_tangency` of `convert_to_T_NURCC()`. Copies share the edges.

This needs Open CASCADE. If headers of both are included, those of \cgal must come first.

\tparam K a model of `Kernel` with a floating-point number type
*/
template <typename K>
class Free_edge_normals_3
{
public:
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  /// collects the free edges of a boundary representation, in millimetres.
  explicit Free_edge_normals_3(const TopoDS_Shape& shape)
    : m_edges(std::make_shared<const internal::Free_edges>(shape))
  {
    for(std::size_t i = 0; i < m_edges->size(); ++i)
      m_curves.emplace_back((*m_edges)[i].edge, (*m_edges)[i].face);
  }

  /// returns the unit normal of the face at the point of its free edge that is closest to `p`. At
  /// the common vertex of several edges it is the one whose tangent has the direction of `tangent`
  /// or the opposite one. It is the null vector if there is no free edge, or the face has no normal
  /// there.
  Vector_3 operator()(const Point_3& p, const Vector_3& tangent) const
  {
    typedef typename K::FT FT;
    const gp_Pnt q = point(p);
    const double reach = m_edges->curves().nearest(q).distance + resolution;
    Vector_3 result(0, 0, 0);
    FT largest(-1);
    for(std::size_t i = 0; i < m_curves.size(); ++i)
    {
      const internal::Curve_set::Foot foot = m_edges->curves().nearest(q, i, reach);
      if(!(foot.distance <= reach) || !m_curves[i].has_face())
        continue;
      const Vector_3 t = m_curves[i].derivative(FT(foot.parameter), 1);
      const FT product = (t * tangent) * (t * tangent) / t.squared_length();
      if(!(product > largest))
        continue;
      largest = product;
      result = m_curves[i].normal(FT(foot.parameter));
    }
    return result;
  }

  /// returns the distance of `p` from the closest free edge.
  typename K::FT distance(const Point_3& p) const
  {
    return typename K::FT(m_edges->curves().nearest(point(p)).distance);
  }

private:
  static constexpr double resolution = 1e-6; // in millimetres; edges meet at their vertices up to it

  static gp_Pnt point(const Point_3& p)
  {
    return gp_Pnt(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }

  std::shared_ptr<const internal::Free_edges> m_edges;
  std::vector<typename Open_cascade_curve_traits_3<K>::Curve_3> m_curves;
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_FREE_EDGE_NORMALS_3_H
