// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_EXTRACT_QUAD_LAYOUT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_EXTRACT_QUAD_LAYOUT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/Integer_grid_map.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Layout_inverse_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Mapped_quads.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Proxy_inverse_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

namespace internal {

// the corners of all faces, in the order of `faces(tm)` and `vertices_around_face()`
template <typename TriangleMesh, typename VertexPointMap>
std::vector<std::array<Eigen::Vector3d, 3> > face_corners(const TriangleMesh& tm,
                                                          const VertexPointMap& vpm)
{
  std::vector<std::array<Eigen::Vector3d, 3> > corners;
  for(auto f : faces(tm))
  {
    std::array<Eigen::Vector3d, 3> points;
    std::size_t i = 0;
    for(auto v : vertices_around_face(halfedge(f, tm), tm))
    {
      const auto& p = get(vpm, v);
      points[i++] = Eigen::Vector3d(CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                                    CGAL::to_double(p.z()));
    }
    corners.push_back(points);
  }
  return corners;
}

// Copies the combinatorics and the boundary to a layout whose points are not set yet.
template <typename GeomTraits>
Quad_layout<GeomTraits> make_layout(const Quad_grid& grid, const Working_mesh& mesh)
{
  typedef Quad_layout<GeomTraits> Layout;
  const std::size_t n = grid.number_of_quads();
  std::vector<std::array<std::size_t, 4> > quads(n);
  std::vector<std::array<typename Layout::Side, 4> > neighbors(n);
  for(std::size_t q = 0; q < n; ++q)
    for(int i = 0; i < 4; ++i)
    {
      quads[q][i] = grid.vertices[q][i];
      const Quad_grid::Side& side = grid.neighbors[q][i];
      neighbors[q][i] = side.first < 0 ? typename Layout::Side(Layout::null, 0)
                                       : typename Layout::Side(side.first, side.second);
    }
  Layout layout(std::vector<typename Layout::Point_3>(grid.number_of_vertices()),
                std::move(quads), std::move(neighbors));
  for(std::size_t q = 0; q < n; ++q)
    for(int i = 0; i < 4; ++i)
      if(layout.is_border(q, i))
      {
        const Quad_grid::Border& border = grid.borders[q][i];
        layout.set_boundary_side(q, i, typename Layout::Boundary_side{
          border.chain, typename Layout::FT(border.first), typename Layout::FT(border.last)});
      }
  for(int v = 0; v < grid.number_of_vertices(); ++v)
    layout.set_corner(v, grid.mesh_vertex[v] >= 0 && mesh.is_corner[grid.mesh_vertex[v]]);
  return layout;
}

// Sets the points of the vertices: those at the boundary exactly where they are among the first `n`
// vertices of the mesh, others by the inverse map.
template <typename GeomTraits>
void set_points(const Quad_grid& grid, const Working_mesh& mesh, int n,
                Quad_layout<GeomTraits>& layout)
{
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    for(int i = 0; i < 4; ++i)
      layout.set_point(layout.vertex(q, i),
                       layout.inverse_map()(q, i == 1 || i == 2, i >= 2).point);
  for(int v = 0; v < grid.number_of_vertices(); ++v)
    if(grid.is_border_vertex[v] && grid.mesh_vertex[v] >= 0 && grid.mesh_vertex[v] < n)
    {
      const Eigen::Vector3d& p = mesh.points[grid.mesh_vertex[v]];
      layout.set_point(v, typename GeomTraits::Point_3(p[0], p[1], p[2]));
    }
}

// The layout of quads together with their inverse map; the first `n` vertices of the mesh have
// exact points.
template <typename GeomTraits>
void set_layout(const Quad_grid& grid, const Working_mesh& mesh, int n,
                std::shared_ptr<const typename Quad_layout<GeomTraits>::Inverse_map> inverse_map,
                Quad_layout<GeomTraits>& layout)
{
  layout = make_layout<GeomTraits>(grid, mesh);
  layout.set_inverse_map(std::move(inverse_map));
  set_points(grid, mesh, n, layout);
}

// The layout of quads that are found on a refinement of the input itself.
template <typename Quads, typename GeomTraits>
void set_layout(Quads quads, const Working_mesh& mesh,
                const std::vector<std::array<Eigen::Vector3d, 3> >& input_faces,
                Quad_layout<GeomTraits>& layout)
{
  const Quad_grid grid = quads.quads();
  set_layout(grid, mesh, mesh.number_of_vertices(),
             std::make_shared<const Layout_inverse_map<GeomTraits, Quads> >(std::move(quads), mesh,
                                                                            input_faces), layout);
}

// the quads of a map, as they lie in it
inline Error_code find_quads(const Integer_grid_map& map, Mapped_quads& quads)
{
  return *quads.build(map) == 0 ? Error_code::OK : Error_code::NO_QUAD_LAYOUT;
}

// The layout of the quads of a map, after motions that give them better shapes, as many as the
// budget allows.
template <typename TriangleMesh, typename GeomTraits, typename NamedParameters>
void set_mapped_layout(Mapped_quads quads, const Integer_grid_map& map, const TriangleMesh& tm,
                       Vertex_smoothing::Priority priority, const Work_budget& budget,
                       Quad_layout<GeomTraits>& layout, const NamedParameters& np)
{
  const auto vpm = parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::vertex_point),
    get_const_property_map(vertex_point, tm));
  const Working_mesh& mesh = map.map.mesh;
  const auto corners = face_corners(tm, vpm);
  if(!map.proxy)
  {
    quads.smooth(map, [&](const Working_location& at) { return surface_sample(mesh, at); },
                 priority, budget);
    set_layout(std::move(quads), mesh, corners, layout);
    return;
  }
  const auto image = std::make_shared<const Proxy_image>(mesh, map.proxy);
  quads.smooth(map, [&](const Working_location& at)
    { return surface_sample(image->original(), (*image)(at)); }, priority, budget);
  const Quad_grid grid = quads.quads();
  set_layout(grid, mesh, map.proxy->mesh.number_of_vertices(),
             std::make_shared<const Proxy_inverse_map<GeomTraits> >(std::move(quads), image,
                                                                    corners), layout);
}

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

extracts the quad layout of an integer grid map: the quads with their neighbours, their vertices on
the mesh, the pieces of the boundary below them, and the inverse map.

All decisions are exact, and the result is checked: it has the Euler characteristic of the mesh, its
irregular vertices are the singularities of the map, corners of the boundary are vertices, and the
boundary sides cover each boundary chain once. Vertices at boundary vertices of the mesh have
exactly their points. Extraordinary points need not lie at vertices of the mesh: they, and the quads
around, are moved such that the angles at them become nearly equal. The inverse map is continuous up
to rounding and maps no two quads to the same place. It is piecewise linear away from extraordinary
points if the map has been solved again (`Integer_grid_map::is_resolved`) and there is no proxy.
With a proxy, its points are projected to the mesh along normals that are interpolated on the proxy,
and those of the boundary by arc length; where the mesh is folded, they are projected to a smoother
surface of the same triangles.

\tparam TriangleMesh a model of `FaceListGraph`
\tparam BoundaryCurveNetwork an instance of `Boundary_curve_network_3`
\tparam GeomTraits a model of `Kernel`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param map the integer grid map
\param tm the triangle mesh from which `map` has been computed
\param network the curves at the boundary of `tm`
\param layout the result
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
\cgalNamedParamsEnd

\return `Error_code::OK`, the error of the network if it has one, or `Error_code::NO_QUAD_LAYOUT`.

\pre `network` and `map` have been created from `tm`
*/
template <typename TriangleMesh, typename BoundaryCurveNetwork, typename GeomTraits,
          typename NamedParameters = parameters::Default_named_parameters>
Error_code extract_quad_layout(const Integer_grid_map& map, const TriangleMesh& tm,
                               const BoundaryCurveNetwork& network,
                               Quad_layout<GeomTraits>& layout,
                               const NamedParameters& np = parameters::default_values())
{
  if(network.error() != Error_code::OK)
    return network.error();
  internal::Mapped_quads quads;
  const Error_code code = internal::find_quads(map, quads);
  if(code == Error_code::OK)
    internal::set_mapped_layout(std::move(quads), map, tm,
                                internal::Vertex_smoothing::Priority::EVEN_MAP,
                                internal::Work_budget(), layout, np);
  return code;
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_EXTRACT_QUAD_LAYOUT_H
