// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_EXTRACT_NURBS_FACES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_EXTRACT_NURBS_FACES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/T_NURCC_surface_3.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/extract_shell.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/quad_neighbors.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is a place where the boundary of a shell gets a vertex, on a boundary side of a quad of the layout.
*/
template <typename FT>
struct Boundary_vertex
{
  std::size_t quad; ///< the quad
  int side;         ///< the number of the side
  FT parameter;     ///< in \f$ [0,1] \f$, counter clockwise along the side
};

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

tells how well the caps at extraordinary points replace the surface.
*/
template <typename FT>
struct Cap_statistics
{
  std::size_t number_of_caps = 0;       ///< one for each extraordinary point
  std::size_t number_of_sharp_caps = 0; ///< caps that are tangent continuous only approximately
  FT deviation = 0;                     ///< largest distance from the surface, along its normals
  std::size_t number_of_creases = 0;    ///< lines above corners with tangent continuous faces
  FT crease_deviation = 0;              ///< largest distance of these faces from the surface
};

namespace internal {

// Subdivisions of patches at extraordinary points. Two suffice for caps of extraordinary points
// that share an edge; each further one divides the deviation by three and more.
constexpr int EXTRACTION_LEVELS = 6;

// the share of the interior tolerance that caps may use
constexpr double CAP_SHARE_OF_TOLERANCE = 0.1;

template <typename FT>
std::int64_t quad_ticks(const FT& t)
{
  return std::llround(CGAL::to_double(t) * double(QUAD_TICKS));
}

template <typename K>
std::vector<Cell> surface_cells(const T_NURCC_surface_3<K>& surface)
{
  const auto elements = surface.bezier_elements(EXTRACTION_LEVELS);
  std::vector<Cell> cells;
  cells.reserve(elements.size());
  for(const auto& element : elements)
  {
    Cell cell;
    cell.patch = element.patch;
    cell.quad = surface.patch_origin(element.patch).quad;
    cell.rectangle = {{{quad_ticks(element.u0), quad_ticks(element.v0)}},
                      {{quad_ticks(element.u1), quad_ticks(element.v1)}}};
    Bicubic points;
    for(std::size_t i = 0; i < points.size(); ++i)
      points[i] = to_eigen(element.points[i]);
    cell.points = std::make_shared<const Bicubic>(points);
    cells.push_back(std::move(cell));
  }
  return cells;
}

// Extracts the faces of a surface with the given cells, see `extract_NURBS_faces()`. `pieces`: those
// of the faces if not null, see `pieces_of_cells()`
template <typename K>
Cap_statistics<typename K::FT>
extract_faces(const T_NURCC_surface_3<K>& surface, std::vector<Cell> cells, double tolerance,
              const std::vector<Boundary_vertex<typename K::FT> >& boundary_vertices,
              Merging merging, NURBS_shell_3<K>& shell,
              std::vector<Bezier_piece>* pieces = nullptr)
{
  typedef typename K::FT FT;

  Extraction_settings settings;
  settings.merging = merging;
  settings.levels = EXTRACTION_LEVELS;
  settings.cap_tolerance = CAP_SHARE_OF_TOLERANCE * tolerance;
  for(const Boundary_vertex<FT>& v : boundary_vertices)
    settings.boundary_points.push_back({v.quad, v.side, CGAL::to_double(v.parameter)});

  auto position_on = [](const T_NURCC_surface_3<K>& surface)
  {
    return [&surface](std::size_t patch, double u, double v)
      { return to_eigen(surface.position(patch, FT(u), FT(v))); };
  };
  T_NURCC_surface_3<K> limit; // the surface without caps
  if(surface.has_caps())
  {
    limit = surface;
    limit.set_caps(false);
    settings.caps.limit = position_on(limit);
    settings.caps.level = [&surface](std::size_t patch, int corner)
      { return surface.cap_level(patch, corner); };
  }
  const Extraction_result result = extract_shell(std::move(cells), quad_neighbors(surface),
                                                 position_on(surface), settings, shell, pieces);

  Cap_statistics<FT> statistics;
  statistics.number_of_caps = result.number_of_caps;
  statistics.number_of_sharp_caps = result.number_of_sharp_caps;
  statistics.deviation = result.cap_deviation;
  statistics.number_of_creases = result.number_of_creases;
  statistics.crease_deviation = result.crease_deviation;
  return statistics;
}

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

turns a T-NURCC surface into the faces of a boundary representation.

Away from extraordinary points the surface is piecewise bicubic. Its pieces are merged to rectangles
on which it is twice continuously differentiable; each becomes one bicubic B-spline face, exactly.
At an extraordinary point of valence \f$ n \f$, \f$ n \f$ biquintic faces make a cap that joins its
neighbors and itself with continuous tangent planes. It approximates the surface, or is the surface if
that has caps, see `T_NURCC_surface_3::set_caps()`. Adjacent faces share their edges; a face whose
side has T-junctions has several edges there.

\tparam K a model of `Kernel` with a floating point number type
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param surface the surface
\param shell receives the faces; it should be empty
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
       below

\return the number and the deviation of the caps

\cgalNamedParamsBegin
  \cgalParamNBegin{interior_tolerance}
    \cgalParamDescription{in model units; caps are made smaller until they deviate from the surface
                           by less than a tenth of it}
    \cgalParamType{a positive number}
    \cgalParamDefault{\f$ 10^{-3} \f$ times the largest coordinate}
  \cgalParamNEnd
  \cgalParamNBegin{do_merge_patches}
    \cgalParamDescription{whether faces may cover several bicubic pieces; if not, there is one face
                           for each of them, except beside lines above corners}
    \cgalParamType{Boolean}
    \cgalParamDefault{`true`}
  \cgalParamNEnd
  \cgalParamNBegin{boundary_vertices}
    \cgalParamDescription{where the boundary gets vertices beside those at its corners, for instance
                           at the joints of the curves}
    \cgalParamType{`std::vector<Boundary_vertex<FT> >`}
    \cgalParamDefault{none}
  \cgalParamNEnd
\cgalNamedParamsEnd
*/
template <typename K, typename NamedParameters = parameters::Default_named_parameters>
Cap_statistics<typename K::FT>
extract_NURBS_faces(const T_NURCC_surface_3<K>& surface, NURBS_shell_3<K>& shell,
                    const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  typedef typename K::FT FT;

  constexpr double DEFAULT_RELATIVE_TOLERANCE = 1e-3;
  std::vector<internal::Cell> cells = internal::surface_cells(surface);
  const FT tolerance = choose_parameter(
    get_parameter(np, internal_np::interior_tolerance),
    FT(DEFAULT_RELATIVE_TOLERANCE * internal::largest_coordinate(cells)));
  const bool do_merge
    = choose_parameter(get_parameter(np, internal_np::do_merge_patches), true);
  return internal::extract_faces(
    surface, std::move(cells), CGAL::to_double(tolerance),
    choose_parameter(get_parameter(np, internal_np::boundary_vertices),
                     std::vector<Boundary_vertex<FT> >()),
    do_merge ? internal::Merging::BEST : internal::Merging::NONE, shell);
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_EXTRACT_NURBS_FACES_H
