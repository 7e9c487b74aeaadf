// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_TRANSFINITE_PATCH_NETWORK_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_TRANSFINITE_PATCH_NETWORK_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/boundary_band.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Corner_fans.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Curved_facets.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Displacement_reach.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Layout_boundary.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Mesh_projection.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

The class `Transfinite_patch_network_3` is the surface that `fit_boundary()` and `fit_interior()`
approximate: a \f$ C^0 \f$ network of patches, one per quad of a layout, that interpolates the
boundary curves and coincides with the mesh in all quads without a boundary side.

A point of a quad with a boundary side is the point of the mesh given by the inverse map of the
layout plus a displacement that blends the gaps between the curves and the boundary of the mesh over
the width of the quad. It ends earlier where the quad is wider than the band along the boundary, or
where the gap is larger than those nearby by more than half the tolerance.
The parameter of a boundary chain runs by one along each quad side. It is related to the arc length
by a function that is \f$ C^2 \f$ and monotone: the vertices of the layout slide along the curves,
and the inverse map is warped accordingly in the quads with a boundary side.

Optionally, the faces of the mesh are replaced by curved triangles, which interpolate the vertices
and normals estimated there: the *smooth target*. It is meant for tolerances below the height of the
facets, and ends in the same curves. At edges where the mesh turns by more than 40 degrees it
coincides with the mesh.

The class keeps references to the layout, to the mesh and to the network of curves.

\tparam GeomTraits a model of `Kernel`
\tparam TriangleMesh a model of `FaceListGraph`
\tparam BoundaryCurveTraits a model of `BoundaryCurveTraits_3` with the same point type
*/
template <typename GeomTraits, typename TriangleMesh, typename BoundaryCurveTraits>
class Transfinite_patch_network_3
{
public:
  typedef std::size_t size_type;
  typedef typename GeomTraits::FT FT;
  typedef typename GeomTraits::Point_3 Point_3;
  typedef typename GeomTraits::Vector_3 Vector_3;
  typedef Quad_layout<GeomTraits> Layout;
  typedef Boundary_curve_network_3<TriangleMesh, BoundaryCurveTraits> Network;

  /// \name Creation
  /// @{

  /*!
  constructs the patches.

  \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

  \param layout a quad layout of `tm` with an inverse map
  \param network the boundary curves of `tm`; it has no chain if `tm` is closed
  \param tm the mesh
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones below

  \cgalNamedParamsBegin
    \cgalParamNBegin{vertex_point_map}
      \cgalParamDescription{a property map associating points to the vertices of `tm`}
      \cgalParamType{a class model of `ReadablePropertyMap` with
                     `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and
                     `GeomTraits::Point_3` as value type}
      \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
    \cgalParamNEnd
    \cgalParamNBegin{interior_tolerance}
      \cgalParamDescription{the distance between surface and mesh that is aimed at, in model units:
                             half of it does not matter in the blend of the gaps}
      \cgalParamType{a number type convertible to `double`}
      \cgalParamDefault{`1e-3` times the diameter of the mesh}
    \cgalParamNEnd
    \cgalParamNBegin{boundary_band}
      \cgalParamDescription{the width of the band along the boundary in which the gaps are blended,
                             in model units}
      \cgalParamType{a number type convertible to `double`}
      \cgalParamDefault{three mean edge lengths of the mesh}
    \cgalParamNEnd
    \cgalParamNBegin{use_smooth_correspondence}
      \cgalParamDescription{whether the vertices of the layout slide along the curves so that the
                             arc length is a smooth function of the parameter; otherwise it is
                             linear along each quad side, as in the paper}
      \cgalParamType{`bool`}
      \cgalParamDefault{`true`}
    \cgalParamNEnd
    \cgalParamNBegin{use_smooth_target}
      \cgalParamDescription{whether curved triangles take the place of the faces of the mesh}
      \cgalParamType{`bool`}
      \cgalParamDefault{`false`}
    \cgalParamNEnd
  \cgalNamedParamsEnd

  \pre every boundary side of the layout names a chain of the network
  */
  template <typename NamedParameters = parameters::Default_named_parameters>
  Transfinite_patch_network_3(const Layout& layout, const Network& network, const TriangleMesh& tm,
                              const NamedParameters& np = parameters::default_values())
    : m_layout(layout), m_network(network),
      m_boundary(layout, tm, network,
                 parameters::choose_parameter(
                   parameters::get_parameter(np, internal_np::use_smooth_correspondence), true))
  {
    using parameters::choose_parameter;
    using parameters::get_parameter;
    const auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                      get_const_property_map(vertex_point, tm));
    m_mesh = std::make_shared<internal::Mesh_projection>(tm, vpm);
    m_fans = std::make_shared<internal::Corner_fans<Layout> >(m_layout, *m_mesh);
    m_reach = std::make_shared<internal::Displacement_reach>(
      tm, vpm, network, internal::boundary_band_width(np, tm, vpm),
      negligible_share * CGAL::to_double(choose_parameter(
        get_parameter(np, internal_np::interior_tolerance),
        default_relative_tolerance * network.diameter())));
    if(choose_parameter(get_parameter(np, internal_np::use_smooth_target), false))
      m_curved = std::make_shared<internal::Curved_facets>(tm, vpm);
    find_quad_sizes();
    find_corner_displacements();
  }

  /// @}
  /// \name Boundary
  /// @{

  /// returns the number of chains of the network.
  size_type number_of_chains() const { return m_boundary.number_of_chains(); }

  /// returns `true` if `chain` is a loop without corner.
  bool is_closed(size_type chain) const { return m_boundary.correspondence(chain).is_closed(); }

  /// returns the number of quad sides of `chain`, which is the length of its parameter range.
  size_type number_of_sides(size_type chain) const { return m_boundary.sides(chain).size(); }

  /// returns the arc length at the parameter `x`, in model units; periodic up to the length of the
  /// chain if it is closed.
  FT arc_length(size_type chain, const FT& x) const
  {
    return FT(m_boundary.correspondence(chain)(CGAL::to_double(x)));
  }

  /// returns the derivative of the arc length at the parameter `x`.
  FT speed(size_type chain, const FT& x) const
  {
    return FT(m_boundary.correspondence(chain)(CGAL::to_double(x), 1));
  }

  /// returns the point of the curve at the parameter `x` of `chain`.
  Point_3 curve_point(size_type chain, const FT& x) const
  {
    return m_network.point(chain, arc_length(chain, x));
  }

  /// returns the derivative of order one or two of the curve with respect to the parameter `x`.
  Vector_3 curve_derivative(size_type chain, const FT& x, int order) const
  {
    const internal::Boundary_correspondence& s = m_boundary.correspondence(chain);
    const double xd = CGAL::to_double(x);
    const FT speed(s(xd, 1));
    const Vector_3 tangent = m_network.derivative(chain, FT(s(xd)), 1);
    if(order == 1)
      return speed * tangent;
    return (speed * speed) * m_network.derivative(chain, FT(s(xd)), 2) + FT(s(xd, 2)) * tangent;
  }

  /// @}
  /// \name Patches
  /// @{

  /// returns the diameter of the smallest sphere enclosing the vertices of the mesh.
  FT diameter() const { return m_network.diameter(); }

  /// returns the network of the boundary curves.
  const Network& network() const { return m_network; }

  /// returns the layout.
  const Layout& layout() const { return m_layout; }

  /// returns the mean length of the sides of `quad`, in model units.
  const FT& quad_size(size_type quad) const { return m_quad_sizes[quad]; }

  /// returns `true` if a side of `quad` lies on the boundary.
  bool is_boundary_quad(size_type quad) const { return m_boundary.quad_sides(quad) != nullptr; }

  /// returns the point at the local coordinates `(u,v)` of `quad`, in \f$ [0,1]^2 \f$.
  Point_3 point(size_type quad, const FT& u, const FT& v) const
  {
    size_type face;
    return point(quad, u, v, face);
  }

  /// returns the same point; `face` becomes the position in `faces(tm)` of the face it is made
  /// from, or the number of faces on the boundary.
  Point_3 point(size_type quad, const FT& u, const FT& v, size_type& face) const
  {
    face = m_mesh->number_of_faces();
    const Quad_sides* sides = m_boundary.quad_sides(quad);
    for(int i = 0; sides != nullptr && i < 4; ++i)
    {
      const std::array<FT, 2> td = internal::to_side<FT>(i, u, v);
      if((*sides)[i].is_on_boundary() && td[1] == FT(0))
        return curve_point((*sides)[i].chain, FT(double((*sides)[i].index)) + td[0]);
    }
    const Mesh_place place = place_on_mesh(quad, u, v);
    face = place.location.face;
    return smooth_point(place.location) + place.displacement;
  }

  /// returns `true` if the point at the local coordinates `(u,v)` of `quad` lies on the mesh, or on
  /// its curved triangles, since no curve of the boundary displaces it.
  bool is_on_mesh(size_type quad, const FT& u, const FT& v) const
  {
    return !is_boundary_quad(quad) || place_on_mesh(quad, u, v).displacement == NULL_VECTOR;
  }

  /*!
  returns a point of the patches with no closer one to `p` around it, in the neighbourhood of the
  local coordinates `(u,v)` of `quad`. The search goes from the face of the mesh there over its
  neighbors to closer ones. In a quad with a boundary side, the displacement of the mesh is taken to
  be that at `(u,v)` in this neighbourhood.

  If the point found is further away from the one at `(u,v)` than half the size of the quad or of
  the mean quad, or lies on a face with opposite orientation, it belongs to another part of the
  mesh; then `point(quad, u, v)` is returned.
  */
  Point_3 foot_point(const Point_3& p, size_type quad, const FT& u, const FT& v) const
  {
    size_type near_face = number_of_mesh_faces();
    return foot_point_on_mesh(p, quad, u, v, near_face);
  }

  /// returns such a point; `start` is `point(quad, u, v, face)`, which need not be found again. The
  /// search begins at the face of the mesh at the position `near_face`, which becomes the face the
  /// point found is made from.
  Point_3 foot_point(const Point_3& p, size_type quad, const FT& u, const FT& v,
                     const Point_3& start, size_type face, size_type& near_face) const
  {
    if(is_boundary_quad(quad))
      return foot_point_on_mesh(p, quad, u, v, near_face);
    const Mesh_projection::Point_3 q = Mesh_projection::to_double_point(start);
    return foot_point(p, quad, Foot{has_smooth_target() ? m_mesh->closest_point(face, q) : q, face},
                      Vector_3(FT(0), FT(0), FT(0)), start, near_face);
  }

  /// returns such a point; the search begins at `face`.
  Point_3 foot_point(const Point_3& p, size_type quad, const FT& u, const FT& v,
                     const Point_3& start, size_type face) const
  {
    size_type near_face = face;
    return foot_point(p, quad, u, v, start, face, near_face);
  }

  /// returns `true` if the patches are made from curved triangles instead of the faces of the mesh.
  bool has_smooth_target() const { return m_curved != nullptr; }

  /// returns a bound of the distance of the curved triangles from the faces of the mesh, in model
  /// units.
  FT smooth_target_height() const { return has_smooth_target() ? FT(m_curved->height()) : FT(0); }

  /// @}
  /// \name Mesh
  /// @{

  /// returns the number of faces of the mesh.
  size_type number_of_mesh_faces() const { return m_mesh->number_of_faces(); }

  /// returns the number of points where the mesh may be farthest from a surface: its vertices and
  /// the middles of its inner edges. A smooth target does not have the latter.
  size_type number_of_mesh_points() const
  {
    return m_mesh->number_of_vertices() + (has_smooth_target() ? 0 : m_mesh->number_of_edges());
  }

  /// returns the point of the vertex at the position `i` in `vertices(tm)`, or the middle of an
  /// edge where `i` is not less than the number of vertices, rounded to doubles.
  Point_3 mesh_point(size_type i) const
  {
    const size_type n = m_mesh->number_of_vertices();
    const Mesh_projection::Point_3 p = i < n ? m_mesh->vertex(i) : m_mesh->middle(i - n);
    return Point_3(FT(p.x()), FT(p.y()), FT(p.z()));
  }

  /// returns the numbers of the vertices of the face at the position `face`, and of the middles of
  /// its edges; the largest number stands for those that do not count.
  std::array<size_type, 6> points_of_mesh_face(size_type face) const
  {
    constexpr size_type none = Mesh_projection::none;
    const auto& v = m_mesh->corners(face);
    const auto& e = m_mesh->edges(face);
    const auto middle = [this](size_type edge)
    {
      return edge == none || has_smooth_target() ? none : m_mesh->number_of_vertices() + edge;
    };
    return {{v[0], v[1], v[2], middle(e[0]), middle(e[1]), middle(e[2])}};
  }

  /// @}

private:
  typedef internal::Layout_boundary<GeomTraits> Layout_boundary;
  typedef typename Layout_boundary::Quad_sides Quad_sides;
  typedef typename Layout_boundary::Quad_side Quad_side;
  typedef internal::Mesh_projection Mesh_projection;
  typedef Mesh_projection::Foot Foot;

  // foot points are accepted up to this share of the size of a quad away from the target
  static constexpr double largest_move = 0.5;

  // The target may be that share of the tolerance farther from the mesh than the gaps along the
  // boundary: the rest is left to the fit.
  static constexpr double negligible_share = 0.5;
  static constexpr double default_relative_tolerance = 1e-3;

  void find_quad_sizes()
  {
    for(size_type q = 0; q < m_layout.number_of_quads(); ++q)
    {
      double sum = 0;
      for(int i = 0; i < 4; ++i)
      {
        const Point_3& source = m_layout.point(m_layout.vertex(q, i));
        const Point_3& target = m_layout.point(m_layout.vertex(q, i + 1));
        sum += std::sqrt(CGAL::to_double(CGAL::squared_distance(source, target)));
      }
      m_quad_sizes.push_back(FT(sum / 4));
      m_mean_quad_size += m_quad_sizes.back() / FT(double(m_layout.number_of_quads()));
    }
  }

  // The displacement of a corner between two boundary sides vanishes but for rounding, as curves
  // and mesh meet there. It is taken off, so that the boundary is interpolated exactly.
  void find_corner_displacements()
  {
    m_corner_displacements.assign(m_layout.number_of_quads(), nullptr);
    for(size_type q = 0; q < m_layout.number_of_quads(); ++q)
    {
      const Quad_sides* sides = m_boundary.quad_sides(q);
      for(int i = 0; sides != nullptr && i < 4; ++i)
        if((*sides)[i].is_on_boundary() && (*sides)[(i + 3) & 3].is_on_boundary())
        {
          if(!m_corner_displacements[q])
            m_corner_displacements[q] = std::make_shared<Corner_displacements>(no_displacements());
          (*m_corner_displacements[q])[i]
            = side_effect(q, i, (*sides)[i], FT(0), FT(0), FT(1)).displacement;
        }
    }
  }

  typedef std::array<Vector_3, 4> Corner_displacements;

  static Corner_displacements no_displacements()
  {
    Corner_displacements result;
    result.fill(Vector_3(FT(0), FT(0), FT(0)));
    return result;
  }

  // a point of the mesh, and what the patch adds to it
  struct Mesh_place
  {
    typename Layout::Location location;
    Vector_3 displacement;
  };

  typename Layout::Location inverse_map_across(size_type quad, const FT& u, const FT& v) const
  {
    const internal::Quad_point<FT> p
      = internal::cross_sides(m_layout, internal::Quad_point<FT>{quad, u, v});
    return m_layout.inverse_map()(p.quad, p.u, p.v);
  }

  FT slide(const Quad_side& side, const FT& t) const
  {
    return FT(m_boundary.slide(side.chain, double(side.index) + CGAL::to_double(t)));
  }

  // what a boundary side adds to a point of the mesh
  struct Side_effect
  {
    FT weight = FT(0);
    Vector_3 displacement = NULL_VECTOR; // mu_i(t) of section 2.3 of the paper
    Point_3 source = ORIGIN;             // the point of the boundary of the mesh that it displaces
    double reach = 0;                    // how far from there it acts at most, in model units
  };

  // returns the effect at the parameter t of a side, for the inverse map warped by `slide`
  Side_effect side_effect(size_type quad, int i, const Quad_side& side, const FT& t,
                          const FT& slide, const FT& weight) const
  {
    const std::array<FT, 2> uv = internal::from_side<FT>(i, t + slide, FT(0));
    const typename Layout::Location source = inverse_map_across(quad, uv[0], uv[1]);
    const FT s = arc_length(side.chain, FT(double(side.index)) + t);
    return Side_effect{weight, m_network.point(side.chain, s) - smooth_point(source), source.point,
                       (*m_reach)(side.chain, CGAL::to_double(s))};
  }

  // section 2.3 of the paper: the mesh, warped by the slides, plus the blended displacements of
  // all boundary sides. Side i acts on a point with the weight 1 - d, d its distance to the side.
  Mesh_place place_on_mesh(size_type quad, const FT& u, const FT& v) const
  {
    const Quad_sides* sides = m_boundary.quad_sides(quad);
    if(sides == nullptr)
      return Mesh_place{(*m_fans)(m_layout.inverse_map()(quad, u, v)), NULL_VECTOR};
    FT warped_u = u, warped_v = v;
    std::array<Side_effect, 4> effects;
    for(int i = 0; i < 4; ++i)
    {
      const Quad_side& side = (*sides)[i];
      if(!side.is_on_boundary())
        continue;
      const std::array<FT, 2> td = internal::to_side<FT>(i, u, v);
      const FT weight = FT(1) - td[1], side_slide = slide(side, td[0]);
      effects[i] = side_effect(quad, i, side, td[0], side_slide, weight);
      const FT move = weight * side_slide;
      (i % 2 == 0 ? warped_u : warped_v) += (i < 2 ? move : -move);
    }
    const typename Layout::Location location
      = (*m_fans)(inverse_map_across(quad, warped_u, warped_v));
    for(Side_effect& effect : effects)
      effect.weight = (std::min)(effect.weight, weight_within_reach(effect, location.point));
    return Mesh_place{location, blended_displacement(quad, effects)};
  }

  // In wide quads, a displacement ends with its reach.
  static FT weight_within_reach(const Side_effect& effect, const Point_3& p)
  {
    const double distance = std::sqrt(CGAL::to_double(CGAL::squared_distance(effect.source, p)));
    return distance < effect.reach ? FT(1 - distance / effect.reach) : FT(0);
  }

  Vector_3 blended_displacement(size_type quad, const std::array<Side_effect, 4>& effects) const
  {
    Vector_3 result = NULL_VECTOR;
    for(const Side_effect& effect : effects)
      result = result + effect.weight * effect.displacement;
    if(m_corner_displacements[quad])
      for(std::size_t i = 0; i < 4; ++i)
        result = result - (effects[i].weight * effects[(i + 3) & 3].weight)
                          * (*m_corner_displacements[quad])[i];
    return result;
  }

  // returns the point of the smooth target that belongs to a point of the mesh
  Point_3 smooth_point(const typename Layout::Location& at) const
  {
    if(!has_smooth_target())
      return at.point;
    std::array<double, 3> b;
    for(size_type i = 0; i < 3; ++i)
      b[i] = CGAL::to_double(at.barycentric[i]);
    const Eigen::Vector3d d = m_curved->displacement(at.face, b);
    return at.point + Vector_3(FT(d[0]), FT(d[1]), FT(d[2]));
  }

  Mesh_projection::Vector_3 curved_displacement(const Foot& foot) const
  {
    const Eigen::Vector3d d
      = m_curved->displacement(foot.face, m_mesh->barycentric(foot.face, foot.point));
    return Mesh_projection::Vector_3(d[0], d[1], d[2]);
  }

  // Returns the point of the mesh closest to `query`; with the smooth target, the point of the mesh
  // that belongs to about the closest one of the target: the displacement is taken to be the same
  // around it.
  Foot closest_foot(const Mesh_projection::Point_3& query, const Foot& hint,
                    size_type near_face) const
  {
    constexpr int number_of_rounds = 2;
    if(!has_smooth_target())
      return m_mesh->near_foot(query, near_face);
    Foot foot = hint;
    for(int round = 0; round < number_of_rounds; ++round)
    {
      foot = m_mesh->near_foot(query - curved_displacement(foot), near_face);
      near_face = foot.face;
    }
    return foot;
  }

  // finds the place of the mesh at the parameters; the search for the closest point begins there
  // if `near_face` is no face
  Point_3 foot_point_on_mesh(const Point_3& p, size_type quad, const FT& u, const FT& v,
                             size_type& near_face) const
  {
    const Mesh_place at = place_on_mesh(quad, u, v);
    if(near_face == number_of_mesh_faces())
      near_face = at.location.face;
    return foot_point(
      p, quad, Foot{Mesh_projection::to_double_point(at.location.point), at.location.face},
      at.displacement, smooth_point(at.location) + at.displacement, near_face);
  }

  // `hint`: a point of the mesh about below `start`; `displacement`: what the patch adds to the
  // mesh
  Point_3 foot_point(const Point_3& p, size_type quad, const Foot& hint,
                     const Vector_3& displacement, const Point_3& start, size_type& near_face) const
  {
    const Foot foot
      = closest_foot(Mesh_projection::to_double_point(p - displacement), hint, near_face);
    near_face = foot.face;
    // quads near extraordinary points may be much smaller than the others
    const double limit
      = largest_move * CGAL::to_double((std::max)(m_quad_sizes[quad], m_mean_quad_size));
    const bool is_near = CGAL::squared_distance(foot.point, hint.point) <= limit * limit;
    const bool is_same_side
      = foot.face == hint.face || m_mesh->normal(foot.face) * m_mesh->normal(hint.face) > 0;
    if(!is_near || !is_same_side)
      return start;
    const Mesh_projection::Point_3 q
      = has_smooth_target() ? foot.point + curved_displacement(foot) : foot.point;
    return Point_3(FT(q.x()), FT(q.y()), FT(q.z())) + displacement;
  }

  const Layout& m_layout;
  const Network& m_network;
  Layout_boundary m_boundary;
  std::shared_ptr<const Mesh_projection> m_mesh;
  std::shared_ptr<const internal::Corner_fans<Layout> > m_fans;
  std::shared_ptr<const internal::Curved_facets> m_curved; // null without smooth target
  std::vector<FT> m_quad_sizes;
  FT m_mean_quad_size = FT(0);
  std::shared_ptr<const internal::Displacement_reach> m_reach;
  std::vector<std::shared_ptr<Corner_displacements> > m_corner_displacements;
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_TRANSFINITE_PATCH_NETWORK_3_H
