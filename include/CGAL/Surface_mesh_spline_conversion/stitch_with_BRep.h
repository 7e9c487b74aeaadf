// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_STITCH_WITH_BREP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_STITCH_WITH_BREP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Stitching_report.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Solid_assembler.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/Stitcher.h>
#include <CGAL/Surface_mesh_spline_conversion/measure_BRep.h>

#include <BRepBuilderAPI_Sewing.hxx>
#include <TopoDS_Shape.hxx>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// sews what could not be joined edge by edge.
inline std::vector<TopoDS_Face> sew(const std::vector<TopoDS_Face>& faces, double tolerance)
{
  BRepBuilderAPI_Sewing sewing(tolerance);
  for(const TopoDS_Face& face : faces)
    sewing.Add(face);
  sewing.Perform();
  std::vector<TopoDS_Face> result;
  for(TopExp_Explorer x(sewing.SewedShape(), TopAbs_FACE); x.More(); x.Next())
    result.push_back(TopoDS::Face(x.Current()));
  return result;
}

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

joins a shell with the B-Rep that it bounds, and makes solids of what is closed.

Each free edge of the B-Rep along the boundary of the shell is replaced by the boundary edges of the
shell: they lie exactly on the shell, and their curves in the parameter planes of the faces of the
B-Rep are computed at equal parameters. Only the part of the gap that is normal to these faces
remains, and goes into the tolerances of the edges. Vertices are shared: where only one of both sides
has a vertex, the other one gets it. Only if an edge of the shell finds no partner, Open CASCADE sews
what is left.

The faces are oriented like those of the shell. A closed shell that is turned inside out becomes a
cavity of the solid around it.

This needs Open CASCADE. If headers of both are included, those of \cgal must come first.

\tparam K a model of `Kernel`

\param shell the shell, for instance as made by `extract_NURBS_faces()`
\param residual the B-Rep, in millimetres; its free edges are to lie on the boundary of `shell`. The
       tolerances of its vertices may grow
\param tolerance the largest distance of vertices and edges that are joined, in millimetres
\param result a solid, a shell, or a compound of several ones
\param report the figures of the result
\param millimetres the length of one unit of the coordinates of `shell` in millimetres

\return `true` if all boundary edges of `shell` are joined with `residual`
*/
template <typename K>
bool stitch_with_BRep(const NURBS_shell_3<K>& shell, const TopoDS_Shape& residual, double tolerance,
                      TopoDS_Shape& result, Stitching_report& report, double millimetres = 1)
{
  report = Stitching_report();
  const double residual_tolerance = internal::largest_tolerance(residual);
  internal::Stitcher<K> stitcher(shell, millimetres, residual, tolerance);
  std::vector<TopoDS_Face> faces = stitcher();
  std::string method = "shared edges";
  std::size_t free_edges = internal::Solid_assembler(faces).number_of_free_edges();
  if(stitcher.number_of_unmatched_edges() > 0)
  {
    const std::vector<TopoDS_Face> sewn = internal::sew(faces, tolerance);
    const std::size_t sewn_free_edges = internal::Solid_assembler(sewn).number_of_free_edges();
    if(sewn.size() == faces.size() && sewn_free_edges < free_edges)
    {
      faces = sewn;
      method = "sewing";
    }
  }
  result = internal::Solid_assembler(faces)();
  report = measure_BRep(result);
  report.method = method;
  report.unmatched_edges = stitcher.number_of_unmatched_edges();
  report.edge_distance = stitcher.edge_distance();
  report.residual_tolerance = residual_tolerance;
  return report.unmatched_edges == 0 || (method == "sewing" && report.free_edges == 0);
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_STITCH_WITH_BREP_H
