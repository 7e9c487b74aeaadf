// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_BOUNDARY_CURVE_NETWORK_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_BOUNDARY_CURVE_NETWORK_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Curve_joint.h>
#include <CGAL/Surface_mesh_spline_conversion/Curve_segment.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/smallest_enclosing_sphere_diameter.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Arc_length_table.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Boundary_loop.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Interior_angle.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Oriented_segment.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/boundary_loops.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/check_triangle_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

The class `Boundary_curve_network_3` knows which curves bound a triangle mesh. It checks mesh,
curves and their association, finds the loops of the boundary and its corners, and offers the curves
as *chains* that are parametrized by arc length.

A boundary edge is named by its halfedge whose face lies in the mesh. *Loops* run along these
halfedges, that is, with the mesh to the left. A *corner* is a boundary vertex at which the curves
of its two edges have different tangents, or which the user declares to be one. A *chain* is the
part of a loop between two consecutive corners, or a whole loop without corner; the latter is
*closed*, and its arc lengths are taken modulo its length. A loop with one corner is one chain that
is not closed, from the corner to itself.

A mesh without boundary has a network without loops.

\tparam TriangleMesh a model of `HalfedgeListGraph` and `FaceListGraph`
\tparam BoundaryCurveTraits a model of `BoundaryCurveTraits_3` with the point type of the mesh
*/
template <typename TriangleMesh,
          typename BoundaryCurveTraits = NURBS_curve_traits_3<typename Kernel_traits<
            typename boost::property_traits<typename boost::property_map<TriangleMesh,
              vertex_point_t>::const_type>::value_type>::Kernel> >
class Boundary_curve_network_3
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef internal::Oriented_segment<BoundaryCurveTraits> Oriented_segment;

public:
  typedef TriangleMesh Triangle_mesh;
  typedef BoundaryCurveTraits Boundary_curve_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef std::size_t size_type;
  typedef typename BoundaryCurveTraits::FT FT;
  typedef typename BoundaryCurveTraits::Point_3 Point_3;
  typedef typename BoundaryCurveTraits::Vector_3 Vector_3;
  typedef typename BoundaryCurveTraits::Curve_3 Curve_3;
  typedef Surface_mesh_spline_conversion::Curve_segment<BoundaryCurveTraits> Curve_segment;
  typedef Surface_mesh_spline_conversion::Curve_joint<FT> Curve_joint;

  /// an edge of a chain
  struct Chain_edge
  {
    size_type chain; ///< index of the chain
    size_type index; ///< position of the edge in the chain
  };

  /// a place on a chain
  struct Chain_location
  {
    size_type edge; ///< position of the edge in the chain
    Curve_3 curve;  ///< the curve of the edge
    FT parameter;   ///< the parameter on the curve
  };

  /// the foot of a point on a chain
  struct Projection
  {
    FT arc_length; ///< arc length of the foot
    FT distance;   ///< distance between the point and the foot
  };

  /// \name Creation
  /// @{

  /*!
  creates the network of the boundary of `tm`, and checks it. Whether everything is right is told by
  `error()`; if not, only `error()` and `message()` may be called.

  \tparam HalfedgeCurveMap a model of `ReadablePropertyMap` with
          `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` as key type and
          `Curve_segment<BoundaryCurveTraits>` as value type; it is read for the halfedges of
          boundary edges whose faces lie in the mesh
  \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

  \param tm a triangle mesh, which must outlive the network
  \param halfedge_curve_map the curve of each boundary edge and its parameters at the ends of the
         edge
  \param traits the traits of the curves
  \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones
         listed below

  \cgalNamedParamsBegin
    \cgalParamNBegin{vertex_point_map}
      \cgalParamDescription{a property map associating points to the vertices of `tm`}
      \cgalParamType{a class model of `ReadablePropertyMap` with
                      `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and
                      `%Point_3` as value type}
      \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
    \cgalParamNEnd
    \cgalParamNBegin{corner_angle}
      \cgalParamDescription{a boundary vertex is a corner if the tangents of its two curves
                             enclose more than this angle, in degrees}
      \cgalParamType{a number between 0 and 180}
      \cgalParamDefault{0.5}
    \cgalParamNEnd
    \cgalParamNBegin{vertex_is_constrained_map}
      \cgalParamDescription{the boundary vertices that are corners whatever the angle}
      \cgalParamType{a class model of `ReadablePropertyMap` with
                      `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and `bool`
                      as value type}
      \cgalParamDefault{no vertex}
    \cgalParamNEnd
    \cgalParamNBegin{association_tolerance}
      \cgalParamDescription{the largest distance allowed between a boundary vertex and the points of
                             the curves assigned to it, in model units}
      \cgalParamType{a positive number}
      \cgalParamDefault{\f$ 10^{-6} \f$ times `smallest_enclosing_sphere_diameter(tm)`}
    \cgalParamNEnd
  \cgalNamedParamsEnd
  */
  template <typename HalfedgeCurveMap,
            typename NamedParameters = parameters::Default_named_parameters>
  Boundary_curve_network_3(const TriangleMesh& tm, const HalfedgeCurveMap& halfedge_curve_map,
                           const BoundaryCurveTraits& traits,
                           const NamedParameters& np = parameters::default_values())
    : m_tm(&tm), m_traits(traits)
  {
    initialize(halfedge_curve_map, np);
  }

  /// creates the network of a closed mesh, which has no curves. The parameters are those of the
  /// other constructor. An open mesh gets the error that its boundary edges have no curves.
  template <typename NamedParameters = parameters::Default_named_parameters>
  explicit Boundary_curve_network_3(const TriangleMesh& tm,
                                    const NamedParameters& np = parameters::default_values())
    : m_tm(&tm)
  {
    initialize(Constant_property_map<halfedge_descriptor, Curve_segment>(), np);
  }

  /// @}
  /// \name Errors
  /// @{

  /// returns `Error_code::OK` if mesh, curves and association have no defect.
  Error_code error() const { return m_error; }

  /// returns a sentence on the defect that names the elements and says what to do, or an empty
  /// string. Vertices and faces are numbered as in `vertices(tm)` and `faces(tm)`.
  const std::string& message() const { return m_message; }

  /// @}
  /// \name Loops and Chains
  /// All functions but those of the previous section have the precondition
  /// `error() == Error_code::OK`.
  /// @{

  /// returns the mesh.
  const TriangleMesh& triangle_mesh() const { return *m_tm; }

  /// returns the traits of the curves.
  const BoundaryCurveTraits& traits() const { return m_traits; }

  /// returns the diameter of the smallest sphere enclosing the vertices of the mesh.
  const FT& diameter() const { return m_diameter; }

  /// returns the largest distance between a boundary vertex and its curve that is accepted.
  const FT& association_tolerance() const { return m_association_tolerance; }

  /// returns the number of boundary loops.
  size_type number_of_loops() const { return m_loops.size(); }

  /// returns the halfedges of a loop, in its direction.
  const std::vector<halfedge_descriptor>& loop(size_type l) const { return m_loops[l]; }

  /// returns the number of chains of all loops.
  size_type number_of_chains() const { return m_chains.size(); }

  /// returns the chains of a loop, in its direction.
  const std::vector<size_type>& chains_of_loop(size_type l) const { return m_chains_of_loop[l]; }

  /// returns the loop to which a chain belongs.
  size_type chain_loop(size_type c) const { return m_chains[c].loop; }

  /// returns the halfedges of a chain, in its direction.
  const std::vector<halfedge_descriptor>& chain_halfedges(size_type c) const
  {
    return m_chains[c].halfedges;
  }

  /// returns `true` if the chain is a whole loop without corner.
  bool is_closed(size_type c) const { return m_chains[c].is_closed; }

  /// returns the chain of a boundary halfedge and its position there.
  /// \pre `is_border(opposite(h, triangle_mesh()), triangle_mesh())`
  Chain_edge chain_of(halfedge_descriptor h) const
  {
    const size_type e = get(m_edge_number, h);
    CGAL_precondition(e != 0);
    return m_edges[e - 1].position;
  }

  /// returns `true` if `v` is a corner of the boundary.
  bool is_corner(vertex_descriptor v) const
  {
    const size_type e = get(m_outgoing_edge_number, v);
    return e != 0 && m_edges[e - 1].begins_at_corner;
  }

  /// returns the interior angle of the mesh at the boundary vertex `v` in radians: the angle from
  /// the tangent of the outgoing curve to that of the incoming curve, measured on the mesh.
  FT corner_angle(vertex_descriptor v) const
  {
    const size_type e = get(m_outgoing_edge_number, v);
    CGAL_precondition(e != 0);
    return m_edges[e - 1].interior_angle;
  }

  /// returns the joints of a chain by ascending arc length. Corners are not among them.
  const std::vector<Curve_joint>& joints(size_type c) const { return m_chains[c].joints; }

  /// returns the arc lengths, ascending, at which the curves of a chain pass through the seams of
  /// their surfaces, if the traits have the functor `Construct_seam_parameters_on_curve_3` of
  /// `Curve_on_surface_traits_3`.
  const std::vector<FT>& surface_seams(size_type c) const { return m_chains[c].surface_seams; }

  /// @}
  /// \name Geometry of Chains
  /// Arc lengths `s` are clamped to \f$ [0, \mathit{length}] \f$ on a chain that is not closed.
  /// @{

  /// returns the length of a chain.
  FT length(size_type c) const { return m_chains[c].table.length(); }

  /// returns the arc length at the source of edge `i` of chain `c`, or the length of the chain if
  /// `i` is the number of its edges.
  FT arc_length(size_type c, size_type i) const { return m_chains[c].table.arc_length(i); }

  /// returns the arc length at the parameter `t` of edge `i` of chain `c`.
  FT arc_length(size_type c, size_type i, const FT& t) const
  {
    return m_chains[c].table.arc_length(i, t);
  }

  /// returns the curve and the parameters of edge `i` of chain `c`.
  const Curve_segment& curve_segment(size_type c, size_type i) const
  {
    return m_chains[c].segments[i];
  }

  /// returns the place at the arc length `s` of chain `c`; it is the inverse of
  /// `arc_length(c, i, t)`.
  Chain_location locate(size_type c, const FT& s) const
  {
    const auto position = locate_parameter(c, s);
    return Chain_location{position.edge, curve_segment(c, position.edge).curve,
                          position.parameter};
  }

  /// returns the point at the arc length `s` of chain `c`.
  Point_3 point(size_type c, const FT& s) const
  {
    const auto position = locate_parameter(c, s);
    return oriented_segment(c, position.edge).point(position.parameter);
  }

  /// returns the derivative with respect to arc length at the arc length `s` of chain `c`: of order
  /// 1 the unit tangent, of order 2 the curvature vector, of order 3 its derivative.
  /// \pre `1 <= order && order <= 3`
  Vector_3 derivative(size_type c, const FT& s, int order) const
  {
    const auto position = locate_parameter(c, s);
    return oriented_segment(c, position.edge).derivative(position.parameter, order);
  }

  /// returns the point and the unit tangent at the arc length `s` of chain `c`, which is searched
  /// for once only.
  std::pair<Point_3, Vector_3> point_and_tangent(size_type c, const FT& s) const
  {
    const auto position = locate_parameter(c, s);
    const Oriented_segment segment = oriented_segment(c, position.edge);
    return {segment.point(position.parameter), segment.derivative(position.parameter, 1)};
  }

  /// returns the arc length modulo the length of a closed chain, clamped to the others.
  FT normalized_arc_length(size_type c, const FT& s) const
  {
    const FT total = length(c);
    if(!is_closed(c))
      return (std::max)(FT(0), (std::min)(total, s));
    const FT remainder = s - std::floor(s / total) * total;
    return (FT(0) <= remainder && remainder < total) ? remainder : FT(0);
  }

  /// returns the point of chain `c` closest to `p`, as found from the closest of a few points of
  /// each edge. On curves that wind closely between these points, it may be a local minimum.
  Projection project(size_type c, const Point_3& p) const
  {
    const int points_per_edge = 4;
    FT guess(0), smallest_squared_distance = (point(c, FT(0)) - p).squared_length();
    for(size_type i = 0; i < chain_halfedges(c).size(); ++i)
      for(int k = 1; k <= points_per_edge; ++k)
      {
        const FT x = FT(k) / FT(points_per_edge);
        const FT s = (FT(1) - x) * arc_length(c, i) + x * arc_length(c, i + 1);
        const FT squared_distance = (point(c, s) - p).squared_length();
        if(squared_distance < smallest_squared_distance)
        {
          guess = s;
          smallest_squared_distance = squared_distance;
        }
      }
    return project(c, p, guess);
  }

  /// returns a point of chain `c` from which the distance to `p` increases to both sides, as
  /// reached from the arc length `guess` by steps that decrease the distance.
  Projection project(size_type c, const Point_3& p, const FT& guess) const
  {
    // Steps are halved until the distance decreases. When they drop below rounding, that is the
    // foot.
    const int maximum_number_of_steps = 60;
    const FT smallest_step = FT(4) * (std::numeric_limits<FT>::epsilon)() * length(c);
    FT s = normalized_arc_length(c, guess);
    FT squared_distance = (point(c, s) - p).squared_length();
    for(int i = 0; i < maximum_number_of_steps; ++i)
    {
      FT step = projection_step(c, p, s);
      FT next = normalized_arc_length(c, s + step);
      FT next_squared_distance = (point(c, next) - p).squared_length();
      while(next_squared_distance > squared_distance && std::abs(step) > smallest_step)
      {
        step /= FT(2);
        next = normalized_arc_length(c, s + step);
        next_squared_distance = (point(c, next) - p).squared_length();
      }
      if(!(next_squared_distance <= squared_distance))
        break;
      const bool has_arrived = std::abs(step) <= smallest_step || next == s;
      s = next;
      squared_distance = next_squared_distance;
      if(has_arrived)
        break;
    }
    return Projection{s, std::sqrt(squared_distance)};
  }

  /// @}

private:
  typedef internal::Boundary_chain<TriangleMesh, BoundaryCurveTraits> Chain;
  typedef internal::Arc_length_table<FT> Arc_length_table;
  typedef typename boost::property_map<TriangleMesh,
            dynamic_halfedge_property_t<size_type> >::const_type Halfedge_number_map;
  typedef typename boost::property_map<TriangleMesh,
            dynamic_vertex_property_t<size_type> >::const_type Vertex_number_map;

  template <typename HalfedgeCurveMap, typename NamedParameters>
  void initialize(const HalfedgeCurveMap& halfedge_curve_map, const NamedParameters& np)
  {
    using parameters::choose_parameter;
    using parameters::get_parameter;

    const auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                      get_const_property_map(vertex_point, *m_tm));
    const auto is_constrained
      = choose_parameter(get_parameter(np, internal_np::vertex_is_constrained),
                         Constant_property_map<vertex_descriptor, bool>(false));
    const internal::Triangle_mesh_check<TriangleMesh, std::decay_t<decltype(vpm)> >
      mesh_check(*m_tm, vpm);
    m_error = mesh_check(m_message);
    if(m_error != Error_code::OK)
      return;

    m_diameter = smallest_enclosing_sphere_diameter(*m_tm, parameters::vertex_point_map(vpm));
    const FT default_corner_angle(0.5), default_relative_tolerance(1e-6);
    const FT corner_angle
      = choose_parameter(get_parameter(np, internal_np::corner_angle), default_corner_angle);
    m_association_tolerance
      = choose_parameter(get_parameter(np, internal_np::association_tolerance),
                         default_relative_tolerance * m_diameter);
    if(!check_parameters(corner_angle))
      return;

    m_loops = internal::boundary_loops(*m_tm);
    number_edges();
    for(size_type l = 0; l < number_of_loops() && m_error == Error_code::OK; ++l)
    {
      internal::Boundary_loop<TriangleMesh, BoundaryCurveTraits>
        loop(*m_tm, m_traits, l, m_loops[l]);
      loop.read(halfedge_curve_map, vpm, mesh_check);
      if(loop.check_association(m_association_tolerance, corner_angle * FT(CGAL_PI) / FT(180)))
      {
        loop.find_corners(is_constrained, corner_angle * FT(CGAL_PI) / FT(180), m_diameter);
        loop.append_chains(m_chains);
      }
      if(!loop.message().empty())
        set_error(Error_code::INVALID_BOUNDARY_ASSOCIATION, loop.message());
    }
    if(m_error == Error_code::OK)
      index_chains(vpm);
  }

  bool check_parameters(const FT& corner_angle)
  {
    if(!(FT(0) < corner_angle && corner_angle < FT(180)))
      set_error(Error_code::INVALID_PARAMETER,
                "The parameter corner_angle must be between 0 and 180 degrees.");
    else if(!(FT(0) < m_association_tolerance) || !std::isfinite(m_association_tolerance))
      set_error(Error_code::INVALID_PARAMETER,
                "The parameter association_tolerance must be a positive number.");
    return m_error == Error_code::OK;
  }

  void set_error(Error_code code, const std::string& message)
  {
    m_error = code;
    m_message = message;
  }

  // numbers the boundary edges of all loops from 1, and leaves 0 for the others.
  void number_edges()
  {
    m_edge_number = get(dynamic_halfedge_property_t<size_type>(), *m_tm);
    m_outgoing_edge_number = get(dynamic_vertex_property_t<size_type>(), *m_tm);
    for(const halfedge_descriptor h : halfedges(*m_tm))
      put(m_edge_number, h, 0);
    for(const vertex_descriptor v : vertices(*m_tm))
      put(m_outgoing_edge_number, v, 0);
    size_type n = 0;
    for(const auto& halfedges_of_loop : m_loops)
      for(const halfedge_descriptor h : halfedges_of_loop)
      {
        put(m_edge_number, h, ++n);
        put(m_outgoing_edge_number, source(h, *m_tm), n);
      }
    m_edges.resize(n);
  }

  template <typename VertexPointMap>
  void index_chains(const VertexPointMap& vpm)
  {
    m_chains_of_loop.resize(number_of_loops());
    for(size_type c = 0; c < number_of_chains(); ++c)
    {
      const Chain& chain = m_chains[c];
      m_chains_of_loop[chain.loop].push_back(c);
      for(size_type i = 0; i < chain.halfedges.size(); ++i)
      {
        Edge& edge = m_edges[get(m_edge_number, chain.halfedges[i]) - 1];
        edge.position = Chain_edge{c, i};
        edge.begins_at_corner = (i == 0 && !chain.is_closed);
      }
    }
    for(const auto& halfedges_of_loop : m_loops)
      for(size_type i = 0; i < halfedges_of_loop.size(); ++i)
      {
        const halfedge_descriptor outgoing = halfedges_of_loop[i];
        const halfedge_descriptor incoming
          = halfedges_of_loop[(i == 0 ? halfedges_of_loop.size() : i) - 1];
        const internal::Interior_angle<TriangleMesh, VertexPointMap> angle(*m_tm, vpm);
        m_edges[get(m_edge_number, outgoing) - 1].interior_angle
          = angle(incoming, outgoing, oriented_segment(incoming).derivative_at_end(1),
                  oriented_segment(outgoing).derivative_at_begin(1));
      }
  }

  Oriented_segment oriented_segment(size_type c, size_type edge) const
  {
    return Oriented_segment(m_traits, m_chains[c].segments[edge]);
  }

  Oriented_segment oriented_segment(halfedge_descriptor h) const
  {
    const Chain_edge position = chain_of(h);
    return oriented_segment(position.chain, position.index);
  }

  typename Arc_length_table::Position locate_parameter(size_type c, const FT& s) const
  {
    return m_chains[c].table.locate(normalized_arc_length(c, s));
  }

  // returns a Newton step to the closest point, or where the distance is not convex, a step of
  // the length of the tangential part of the distance vector.
  FT projection_step(size_type c, const Point_3& p, const FT& s) const
  {
    const auto position = locate_parameter(c, s);
    const Oriented_segment segment = oriented_segment(c, position.edge);
    const Vector_3 to_curve = segment.point(position.parameter) - p;
    const FT slope = to_curve * segment.derivative(position.parameter, 1);
    const FT convexity = FT(1) + to_curve * segment.derivative(position.parameter, 2);
    const FT smallest_convexity(0.1);
    return (convexity > smallest_convexity) ? -slope / convexity : -slope;
  }

  // what is known of a boundary edge and its source
  struct Edge
  {
    Chain_edge position;
    bool begins_at_corner;
    FT interior_angle;
  };

  const TriangleMesh* m_tm;
  BoundaryCurveTraits m_traits;
  Error_code m_error = Error_code::OK;
  std::string m_message;
  FT m_diameter = FT(0);
  FT m_association_tolerance = FT(0);
  std::vector<std::vector<halfedge_descriptor> > m_loops;
  std::vector<std::vector<size_type> > m_chains_of_loop;
  std::vector<Chain> m_chains;
  std::vector<Edge> m_edges;
  Halfedge_number_map m_edge_number;
  Vertex_number_map m_outgoing_edge_number;
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_BOUNDARY_CURVE_NETWORK_3_H
