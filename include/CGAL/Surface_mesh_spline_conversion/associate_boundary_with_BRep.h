// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_ASSOCIATE_BOUNDARY_WITH_BREP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_ASSOCIATE_BOUNDARY_WITH_BREP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Curve_segment.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/smallest_enclosing_sphere_diameter.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <CGAL/Surface_mesh_spline_conversion/Open_cascade_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Curve_set.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Free_edges.h>

#include <TopoDS_Shape.hxx>
#include <gp_Pnt.hxx>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Finds the free edge of a B-Rep, and the parameters on it, that belong to a boundary edge.
template <typename K>
class Boundary_association
{
  typedef Open_cascade_curve_traits_3<K> Traits;
  typedef Surface_mesh_spline_conversion::Curve_segment<Traits> Curve_segment;
  typedef typename Traits::Curve_3 Curve_3;

public:
  /// \param points the boundary vertices of the mesh
  Boundary_association(const TopoDS_Shape& shape, const std::vector<gp_Pnt>& points,
                       double tolerance)
    : m_free_edges(shape), m_tolerance(tolerance)
  {
    for(std::size_t i = 0; i < m_free_edges.size(); ++i)
    {
      // oriented as in its face
      const auto& e = m_free_edges[i];
      m_curves.emplace_back(TopoDS::Edge(e.edge.Oriented(e.is_forward ? TopAbs_FORWARD
                                                                      : TopAbs_REVERSED)), e.face);
      m_ends.push_back({end_vertex(i, m_free_edges.curves().first(i), points),
                        end_vertex(i, m_free_edges.curves().last(i), points)});
    }
  }

  /// returns the nearest point on any free edge.
  Curve_set::Foot nearest(const gp_Pnt& p) const { return m_free_edges.curves().nearest(p); }

  /// returns the part of a free edge that is nearest to the chord from `p` to `q` and begins and
  /// ends there; an empty one if there is none.
  Curve_segment segment(const gp_Pnt& p, const gp_Pnt& q) const
  {
    Curve_segment result;
    double best = (std::numeric_limits<double>::max)();
    for(std::size_t i = 0; i < m_curves.size(); ++i)
    {
      const Curve_set::Foot first = m_free_edges.curves().nearest(p, i, m_tolerance);
      if(first.distance > m_tolerance)
        continue;
      const Curve_set::Foot second = m_free_edges.curves().nearest(q, i, m_tolerance);
      if(second.distance > m_tolerance)
        continue;
      for(double s : parameters(i, first.parameter, p))
        for(double t : parameters(i, second.parameter, q))
        {
          const double distance = chord_distance(i, s, t, p, q);
          if(s == t || !(distance < best) || !is_in_domain(i, s, t))
            continue;
          best = distance;
          result.curve = m_curves[i];
          result.first = typename K::FT(s);
          result.second = typename K::FT(t);
        }
    }
    return result;
  }

private:
  // The vertex where curve i ends is the one next to its end. It lies on several curves, and the
  // foot of its perpendicular on each of them may be before the end.
  gp_Pnt end_vertex(std::size_t i, double t, const std::vector<gp_Pnt>& points) const
  {
    const gp_Pnt end = m_free_edges.curves().point(i, t);
    gp_Pnt result = end;
    double least = m_tolerance;
    for(const gp_Pnt& p : points)
      if(p.Distance(end) <= least)
      {
        least = p.Distance(end);
        result = p;
      }
    return result;
  }

  // `t`: the foot of `p` on curve i; a point of a closed curve has several parameters
  std::vector<double> parameters(std::size_t i, double t, const gp_Pnt& p) const
  {
    const Curve_3& c = m_curves[i];
    const double first = CGAL::to_double(c.first()), last = CGAL::to_double(c.last());
    const bool is_first = p.Distance(m_ends[i].first) == 0;
    const bool is_last = p.Distance(m_ends[i].second) == 0;
    if(is_first || is_last)
      return is_first && is_last ? std::vector<double>{first, last}
                                 : std::vector<double>{is_first ? first : last};
    if(!c.is_closed())
      return {t};
    const double period = last - first;
    return {t, t - period, t + period};
  }

  // One end of a segment may be beyond the seam of a periodic curve, but no segment begins there:
  // the seam has two parameters.
  bool is_in_domain(std::size_t i, double s, double t) const
  {
    const Curve_3& c = m_curves[i];
    const double first = CGAL::to_double(c.first()), last = CGAL::to_double(c.last());
    const auto is_inside = [first, last](double x) { return x >= first && x <= last; };
    const auto is_inner = [first, last](double x) { return x > first && x < last; };
    return (is_inside(s) && is_inside(t)) || (c.is_periodic() && (is_inner(s) || is_inner(t)));
  }

  // how far the inner part of the curve is from the middle of the chord
  double chord_distance(std::size_t i, double s, double t, const gp_Pnt& p, const gp_Pnt& q) const
  {
    const gp_Pnt middle((p.XYZ() + q.XYZ()) / 2);
    double result = 0;
    for(const double x : {0.25, 0.375, 0.5, 0.625, 0.75})
      result = (std::max)(result,
                          middle.Distance(m_free_edges.curves().point(i, s + (t - s) * x)));
    return result;
  }

  Free_edges m_free_edges;
  std::vector<Curve_3> m_curves;
  std::vector<std::pair<gp_Pnt, gp_Pnt> > m_ends; // the vertices of the mesh at the ends of curves
  double m_tolerance;
};

/// tells which end of a boundary edge lies on no free edge, or that both lie on different ones.
template <typename K>
std::string association_defect(const Boundary_association<K>& association, double tolerance,
                               const gp_Pnt& p, std::size_t v, const gp_Pnt& q, std::size_t w)
{
  std::ostringstream message;
  for(const auto& end : {std::make_pair(&p, v), std::make_pair(&q, w)})
  {
    const Curve_set::Foot foot = association.nearest(*end.first);
    if(foot.distance <= tolerance)
      continue;
    message << "the boundary vertex " << end.second;
    if(foot.curve == Curve_set::NONE)
      message << " belongs to no edge: the B-Rep has no free edges";
    else
      message << " is " << foot.distance << " away from the nearest free edge of the B-Rep, "
              << "farther than the tolerance " << tolerance;
    return message.str();
  }
  message << "the boundary vertices " << v << " and " << w << " are connected, but lie on "
          << "different free edges of the B-Rep: the mesh needs a vertex where an edge ends or a "
          << "closed edge begins";
  return message.str();
}

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

finds the curves that bound a mesh among the free edges of a boundary representation, by projection.

Each boundary edge of the mesh gets the part of a free edge that begins and ends at the vertices of
the boundary edge and follows it. The mesh must have a vertex wherever a free edge ends, and the curve
ends at the vertex next to this end; where the tangents of two edges differ,
`Boundary_curve_network_3` finds a corner.

This needs Open CASCADE. If headers of both are included, those of \cgal must come first.

\tparam TriangleMesh a model of `HalfedgeListGraph` and `FaceListGraph`
\tparam HalfedgeCurveMap a model of `WritablePropertyMap` with
        `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` as key type and
        `Curve_segment<Open_cascade_curve_traits_3<K> >` as value type, where `K` is the kernel of
        the points of the mesh
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param tm a triangle mesh, in millimetres
\param shape the boundary representation, in millimetres
\param halfedge_curve_map written for the halfedges of boundary edges whose faces lie in the mesh
\param message if there is an error, a sentence that names the vertices
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
       below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `tm`}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and
                    `%Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
  \cgalParamNEnd
  \cgalParamNBegin{association_tolerance}
    \cgalParamDescription{the largest distance between a boundary vertex and its curve}
    \cgalParamType{a positive number}
    \cgalParamDefault{\f$ 10^{-6} \f$ times `smallest_enclosing_sphere_diameter(tm)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return `Error_code::OK` or `Error_code::INVALID_BOUNDARY_ASSOCIATION`
*/
template <typename TriangleMesh, typename HalfedgeCurveMap,
          typename NamedParameters = parameters::Default_named_parameters>
Error_code associate_boundary_with_BRep(const TriangleMesh& tm, const TopoDS_Shape& shape,
                                        HalfedgeCurveMap halfedge_curve_map, std::string& message,
                                        const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  typedef typename GetVertexPointMap<TriangleMesh, NamedParameters>::const_type Vertex_point_map;
  typedef typename boost::property_traits<Vertex_point_map>::value_type Point_3;
  typedef typename Kernel_traits<Point_3>::Kernel K;
  typedef typename K::FT FT;

  const double DEFAULT_RELATIVE_TOLERANCE = 1e-6;
  const Vertex_point_map vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                                get_const_property_map(vertex_point, tm));
  const FT given = choose_parameter(get_parameter(np, internal_np::association_tolerance), FT(0));
  const double tolerance = (given > FT(0)) ? CGAL::to_double(given)
    : DEFAULT_RELATIVE_TOLERANCE * CGAL::to_double(smallest_enclosing_sphere_diameter(
        tm, parameters::vertex_point_map(vpm)));

  std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor>
    numbered(vertices(tm).begin(), vertices(tm).end());
  const auto number = [&numbered](auto v)
  { return std::size_t(std::find(numbered.begin(), numbered.end(), v) - numbered.begin()); };
  const auto kernel_point = [&vpm](auto v)
  {
    const auto& p = get(vpm, v);
    return gp_Pnt(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  };

  std::vector<gp_Pnt> boundary_points;
  for(const auto h : halfedges(tm))
    if(is_border(h, tm))
      boundary_points.push_back(kernel_point(target(h, tm)));
  const internal::Boundary_association<K> association(shape, boundary_points, tolerance);
  for(const auto h : halfedges(tm))
  {
    if(is_border(h, tm) || !is_border(opposite(h, tm), tm))
      continue;
    const gp_Pnt p = kernel_point(source(h, tm)), q = kernel_point(target(h, tm));
    const auto segment = association.segment(p, q);
    if(segment.is_empty())
    {
      message = internal::association_defect(association, tolerance, p, number(source(h, tm)), q,
                                             number(target(h, tm)));
      return Error_code::INVALID_BOUNDARY_ASSOCIATION;
    }
    put(halfedge_curve_map, h, segment);
  }
  return Error_code::OK;
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_ASSOCIATE_BOUNDARY_WITH_BREP_H
