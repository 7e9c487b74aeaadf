// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_OBJ_QUAD_MESH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_OBJ_QUAD_MESH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/T_NURCC_surface_3.h>

#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Text_buffer.h>

#include <CGAL/number_utils.h>

#include <cstddef>
#include <fstream>
#include <ostream>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

template <typename Point>
void write_obj_vertex(Text_buffer& out, const Point& p)
{
  out << "v " << CGAL::to_double(p.x()) << ' ' << CGAL::to_double(p.y()) << ' '
      << CGAL::to_double(p.z()) << '\n';
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion

namespace IO {

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes the vertices and quads of a layout to a stream in the OBJ format.

\return `true` if the stream is still good
*/
template <typename GeomTraits>
bool write_OBJ(std::ostream& os,
               const Surface_mesh_spline_conversion::Quad_layout<GeomTraits>& layout)
{
  {
    Surface_mesh_spline_conversion::internal::Text_buffer out(os);
    for(std::size_t v = 0; v < layout.number_of_vertices(); ++v)
      Surface_mesh_spline_conversion::internal::write_obj_vertex(out, layout.point(v));
    for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
    {
      out << 'f';
      for(int i = 0; i < 4; ++i)
        out << ' ' << layout.vertex(q, i) + 1;
      out << '\n';
    }
  }
  os.flush();
  return os.good();
}

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes the control mesh of a surface to a stream in the OBJ format. Faces with T-vertices are
polygons with more than four vertices; the faces of 0-channels are among them.

\return `true` if the stream is still good
*/
template <typename K>
bool write_OBJ(std::ostream& os, const T_NURCC_surface_3<K>& surface)
{
  {
    Surface_mesh_spline_conversion::internal::Text_buffer out(os);
    const auto& mesh = surface.control_mesh();
    for(std::size_t i = 0; i < surface.number_of_control_points(); ++i)
      Surface_mesh_spline_conversion::internal::write_obj_vertex(out, surface.control_point(i));
    for(auto f : mesh.faces())
    {
      out << 'f';
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        out << ' ' << std::size_t(v) + 1;
      out << '\n';
    }
  }
  os.flush();
  return os.good();
}

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes a layout to the file `filename`, as above.

\return `true` if the file was written
*/
template <typename GeomTraits>
bool write_OBJ(const std::string& filename,
               const Surface_mesh_spline_conversion::Quad_layout<GeomTraits>& layout)
{
  std::ofstream os(filename, std::ios::binary);
  return os && write_OBJ(os, layout);
}

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes the control mesh of a surface to the file `filename`, as above.

\return `true` if the file was written
*/
template <typename K>
bool write_OBJ(const std::string& filename, const T_NURCC_surface_3<K>& surface)
{
  std::ofstream os(filename, std::ios::binary);
  return os && write_OBJ(os, surface);
}

} // namespace IO
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_OBJ_QUAD_MESH_H
