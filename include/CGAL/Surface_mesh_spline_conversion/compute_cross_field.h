// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_COMPUTE_CROSS_FIELD_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_COMPUTE_CROSS_FIELD_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/field/build_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/limit_gradation.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/make_working_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Proxy_projection.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/make_proxy_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

namespace internal {

inline double mean_edge_length(const Working_mesh& mesh)
{
  double sum = 0;
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    sum += mesh.vector(h).norm();
  return sum / mesh.number_of_halfedges();
}

// the quad size is a number, a function or property map of the vertices, or is to be chosen
template <typename Size, typename VertexDescriptor>
double quad_size_at(const Size& size, VertexDescriptor v, double)
{
  if constexpr(std::is_arithmetic<Size>::value)
    return static_cast<double>(size);
  else if constexpr(std::is_invocable<const Size&, VertexDescriptor>::value)
    return CGAL::to_double(size(v));
  else
    return CGAL::to_double(get(size, v));
}

template <typename VertexDescriptor>
double quad_size_at(internal_np::Param_not_found, VertexDescriptor, double default_size)
{
  return default_size;
}

// The vertices of the working mesh at which one curve ends and another begins.
template <typename BoundaryCurveNetwork>
std::vector<char> find_curve_joints(const Working_mesh& mesh, const BoundaryCurveNetwork& network)
{
  std::set<std::pair<std::size_t, double> > joints; // (chain, arc length)
  for(std::size_t c = 0; c < network.number_of_chains(); ++c)
    for(const auto& joint : network.joints(c))
      joints.emplace(c, CGAL::to_double(network.arc_length(c, joint.edge)));
  std::vector<char> is_joint(mesh.number_of_vertices(), 0);
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    if(mesh.is_border(h))
    {
      const Working_mesh::Boundary_piece& piece = mesh.boundary_piece[h];
      is_joint[mesh.source(h)] = joints.count(std::make_pair(piece.chain, piece.first)) > 0;
    }
  return is_joint;
}

// One of several attempts at a field; the first one is that of `compute_cross_field()`.
struct Field_attempt
{
  // the proxy or the mesh itself, the other one of these, or the mesh itself in any case
  enum class Mesh { CHOSEN, OTHER, ITSELF };

  double spacing = 1;                 // see `Cross_field`
  double proxy_refinement = 1;        // by how much the edges of the proxy are shorter than usual
  Mesh mesh = Mesh::CHOSEN;
  bool gathers_singularities = false; // see `Cross_field`
  double joining_distance = 0;        // see `Cross_field`
  // per face of the input: the size of the quads there, as a share of the wanted one; may be empty
  std::vector<double> size_shares = {};
  // the proxy, or null if the mesh itself is used: for attempts that differ only in the spacing
  std::shared_ptr<std::optional<std::shared_ptr<const Proxy_mesh> > > known_proxy = nullptr;
};

inline bool is_proxy_wanted(const Proxy_builder&, bool choice) { return choice; }

inline bool is_proxy_wanted(const Proxy_builder& builder, internal_np::Param_not_found)
{
  return builder.is_proxy_wanted();
}

inline std::vector<Eigen::Vector3d> directions_on_proxy(const Cross_field& field,
                                                        const Proxy_mesh& proxy)
{
  std::vector<Eigen::Vector3d> wanted;
  if(field.wanted_direction.empty())
    return wanted;
  const Proxy_projection projection(proxy);
  for(int f = 0; f < proxy.mesh.number_of_faces(); ++f)
  {
    const Working_location centroid{f, {{1. / 3, 1. / 3, 1. / 3}}};
    wanted.push_back(field.wanted_direction[proxy.original->parent[projection(centroid).face]]);
  }
  return wanted;
}

// The proxy of the mesh of `field`, null if none is wanted or none is good enough. `choice`: the
// named parameter.
template <typename Choice>
std::shared_ptr<const Proxy_mesh> find_proxy(const Cross_field& field,
                                             const std::vector<char>& is_kept,
                                             const Field_attempt& attempt, const Choice& choice)
{
  if(attempt.mesh == Field_attempt::Mesh::ITSELF)
    return nullptr;
  if(attempt.known_proxy && *attempt.known_proxy)
    return **attempt.known_proxy;
  const auto original = std::make_shared<const Working_mesh>(field.mesh);
  Proxy_builder builder(original, field.size, is_kept, attempt.proxy_refinement);
  auto proxy = std::make_shared<Proxy_mesh>();
  const bool is_other = attempt.mesh == Field_attempt::Mesh::OTHER;
  if(is_proxy_wanted(builder, choice) == is_other || !builder.build(*proxy))
    proxy = nullptr;
  if(attempt.known_proxy)
    *attempt.known_proxy = proxy;
  return proxy;
}

// growth of the size of the quads per unit length, at most
constexpr double size_gradation = 0.5;

// Makes the sizes of the quads smaller. `shares`: see `Field_attempt`; not empty
inline void reduce_sizes(const std::vector<double>& shares, Cross_field& field)
{
  const std::vector<double> size = field.size;
  for(int f = 0; f < field.mesh.number_of_faces(); ++f)
    for(const int v : field.mesh.triangles[f])
      field.size[v] = (std::min)(field.size[v], shares[field.mesh.parent[f]] * size[v]);
  limit_gradation(field.mesh, size_gradation, field.size);
}

// the sizes of `field` at the vertices of a proxy of its mesh, where they are below the wanted ones
inline std::vector<double> reduced_sizes(const Cross_field& field, const Proxy_mesh& proxy)
{
  std::vector<double> result;
  for(std::size_t v = 0; v < proxy.size.size(); ++v)
  {
    const Working_location& at = proxy.place[v];
    double size = 0;
    for(int i = 0; i < 3; ++i)
      size += at.barycentric[i] * field.size[field.mesh.triangles[at.face][i]];
    result.push_back((std::min)(proxy.size[v], size));
  }
  return result;
}

// Replaces the mesh of `field` by a proxy and computes the field there. Returns `false`, with
// `field` as before, if there is no proxy.
inline bool build_cross_field_on_proxy(Cross_field& field,
                                       std::shared_ptr<const Proxy_mesh> proxy,
                                       bool has_reduced_sizes)
{
  if(!proxy)
    return false;
  Cross_field on_proxy;
  on_proxy.spacing = field.spacing;
  on_proxy.keeps_large_corners = field.keeps_large_corners;
  on_proxy.gathers_singularities = field.gathers_singularities;
  on_proxy.joining_distance = field.joining_distance;
  on_proxy.mesh = proxy->mesh;
  on_proxy.size = has_reduced_sizes ? reduced_sizes(field, *proxy) : proxy->size;
  on_proxy.wanted_direction = directions_on_proxy(field, *proxy);
  on_proxy.proxy = proxy;
  if(build_cross_field(on_proxy) != Error_code::OK)
    return false;
  field = std::move(on_proxy);
  return true;
}

// sizes that would give more are refused: many times what memory and CAD systems stand
constexpr double largest_number_of_quads = 1e6;

// returns a lower bound of the number of quads of the given sizes at the vertices
inline double least_number_of_quads(const Working_mesh& mesh, const std::vector<double>& size)
{
  double result = 0;
  for(int f = 0; f < mesh.number_of_faces(); ++f)
  {
    const std::array<int, 3>& v = mesh.triangles[f];
    const double largest = (std::max)({size[v[0]], size[v[1]], size[v[2]]});
    result += mesh.normal(f).norm() / (2 * largest * largest);
  }
  return result;
}

// The wanted quad sizes at the vertices of the working mesh, of which the first ones are those of
// `vertex`. Returns `false` if one is not a positive number, or if there would be too many quads.
template <typename Size, typename VertexDescriptor>
bool compute_quad_sizes(const Working_mesh& mesh, const std::vector<VertexDescriptor>& vertex,
                        const Size& size_map, double diameter, std::vector<double>& size)
{
  const double quads_per_diameter = 40, edges_per_quad = 2;
  const double default_size = (std::max)(diameter / quads_per_diameter,
                                         edges_per_quad * mean_edge_length(mesh));
  size.clear();
  for(const VertexDescriptor v : vertex)
  {
    size.push_back(quad_size_at(size_map, v, default_size));
    if(!(size.back() > 0) || !std::isfinite(size.back()))
      return false;
  }
  // vertices that split ears: the gradation gives them the size of their neighbours
  const double largest = *std::max_element(size.begin(), size.end());
  size.resize(mesh.number_of_vertices(), largest);
  limit_gradation(mesh, size_gradation, size);
  return least_number_of_quads(mesh, size) <= largest_number_of_quads;
}

template <typename TriangleMesh>
bool read_wanted_directions(const TriangleMesh&, internal_np::Param_not_found,
                            std::vector<Eigen::Vector3d>&)
{
  return true;
}

// The directions that the user wants at the faces of `tm`, none at all if all of them are zero.
// Returns `false` if one is not a vector of finite numbers.
template <typename TriangleMesh, typename CrossFieldMap>
bool read_wanted_directions(const TriangleMesh& tm, const CrossFieldMap& map,
                            std::vector<Eigen::Vector3d>& wanted)
{
  bool is_any_nonzero = false;
  for(const auto f : faces(tm))
  {
    wanted.push_back(to_eigen(get(map, f)));
    if(!wanted.back().allFinite())
      return false;
    is_any_nonzero = is_any_nonzero || !wanted.back().isZero(0);
  }
  if(!is_any_nonzero)
    wanted.clear();
  return true;
}

// See below.
template <typename TriangleMesh, typename BoundaryCurveNetwork, typename NamedParameters>
Error_code compute_cross_field(const TriangleMesh& tm, const BoundaryCurveNetwork& network,
                               const Field_attempt& attempt, Cross_field& field,
                               const NamedParameters& np)
{
  using parameters::choose_parameter;
  using parameters::get_parameter;

  if(network.error() != Error_code::OK)
    return network.error();
  const auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                    get_const_property_map(vertex_point, tm));
  field = Cross_field();
  field.spacing = attempt.spacing;
  field.gathers_singularities = attempt.gathers_singularities;
  field.joining_distance = attempt.joining_distance;
  field.keeps_large_corners
    = choose_parameter(get_parameter(np, internal_np::do_keep_large_corners), false);
  std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor> vertex;
  const Error_code code = make_working_mesh(tm, network, vpm, field.mesh, vertex);
  if(code != Error_code::OK)
    return code;

  if(!compute_quad_sizes(field.mesh, vertex, get_parameter(np, internal_np::quad_size_map),
                         CGAL::to_double(network.diameter()), field.size))
    return Error_code::INVALID_PARAMETER;
  if(!read_wanted_directions(tm, get_parameter(np, internal_np::cross_field_map),
                             field.wanted_direction))
    return Error_code::INVALID_PARAMETER;
  const auto proxy = find_proxy(field, find_curve_joints(field.mesh, network), attempt,
                                get_parameter(np, internal_np::use_proxy_mesh));
  const bool has_reduced_sizes = !attempt.size_shares.empty();
  if(has_reduced_sizes)
    reduce_sizes(attempt.size_shares, field);
  if(build_cross_field_on_proxy(field, proxy, has_reduced_sizes))
    return Error_code::OK;
  return build_cross_field(field);
}

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

computes a smooth cross field on a triangle mesh whose singularities and boundary behaviour suit
quads of a given size.

In the boundary faces the field is aligned with the boundary, elsewhere it follows the directions
that the user wants, or those of principal curvature where these are distinct. Boundary vertices are
regular, but for corners with an interior angle below 135 degrees, at which one quad will stand;
what convex corners turn together is rounded where they are closer than a quarter of a quad, as at a
chamfer. What the field turns more at other corners is moved to an inner vertex, about two quads
away. Pairs of opposite singularities that are closer than two quads cancel each other. The field
lives on a refinement of the mesh: edges that are longer than a quad or that join two boundary
vertices or two singularities are split.

If the mesh is much finer than the quads or has many badly shaped triangles, the field is computed
on a proxy: a mesh of well-shaped triangles of about a third of the quad size, with vertices on the
mesh, but where this is folded, and on its boundary, which the later stages use, too. The proxy is
checked: projected along its normals, its faces cover the mesh without gaps, and with folds in few
faces at most. If this fails, the mesh itself is used.

\tparam TriangleMesh a model of `HalfedgeListGraph` and `FaceListGraph`
\tparam BoundaryCurveNetwork an instance of `Boundary_curve_network_3`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param tm a triangle mesh
\param network the curves at the boundary of `tm`
\param field the result
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
       below

\cgalNamedParamsBegin
  \cgalParamNBegin{quad_size_map}
    \cgalParamDescription{the wanted edge length of the quads, in model units}
    \cgalParamType{a number, a function object that returns a number for a
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor`, or a class model of
                    `ReadablePropertyMap` with this as key type and a number type as value type}
    \cgalParamDefault{the larger of `D / 40` and twice the mean edge length, where `D` is
                       `smallest_enclosing_sphere_diameter(tm)`}
    \cgalParamExtra{Sizes are reduced where they grow faster than by half of the distance. Those that
                    would give more than a million quads are refused.}
  \cgalParamNEnd
  \cgalParamNBegin{cross_field_map}
    \cgalParamDescription{a direction at each face that one arm of the cross should follow. Only its
                           part in the plane of the face counts, and not its length.}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%face_descriptor` as key type and
                    `%Vector_3` as value type}
    \cgalParamDefault{the zero vector everywhere}
    \cgalParamExtra{where it is the zero vector the field is smooth and follows the curvature. At
                     the boundary, alignment with the boundary comes first; a wish that disagrees
                     with it moves the singularities, and so does one that is not smooth.}
  \cgalParamNEnd
  \cgalParamNBegin{do_keep_large_corners}
    \cgalParamDescription{whether a corner with an interior angle above a full turn keeps as many
                           quads as its angle has right angles, in place of two}
    \cgalParamType{Boolean}
    \cgalParamDefault{`false`}
    \cgalParamExtra{`T_NURCC_surface_3` does not support such corners. A layout of last resort
                     has two quads there all the same.}
  \cgalParamNEnd
  \cgalParamNBegin{use_proxy_mesh}
    \cgalParamDescription{whether to try to compute the field on a proxy of the mesh}
    \cgalParamType{Boolean}
    \cgalParamDefault{`true` if the mesh has at least 1.5 times as many faces as the proxy would
                       have, or if more than one percent of its triangles are badly shaped}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `tm`}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and
                    `%Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return `Error_code::OK`, or the reason why there is no field: that of the network if it has one, an
        unsuitable mesh, a size that is not a positive number, a direction that
        is not finite, or a numerical failure.

\pre `network` has been created from `tm`
*/
template <typename TriangleMesh, typename BoundaryCurveNetwork,
          typename NamedParameters = parameters::Default_named_parameters>
Error_code compute_cross_field(const TriangleMesh& tm, const BoundaryCurveNetwork& network,
                               Cross_field& field,
                               const NamedParameters& np = parameters::default_values())
{
  return internal::compute_cross_field(tm, network, internal::Field_attempt(), field, np);
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_COMPUTE_CROSS_FIELD_H
