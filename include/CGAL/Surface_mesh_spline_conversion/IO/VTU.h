// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_VTU_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_VTU_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Text_buffer.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>

#include <cstddef>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// what is written for each Bezier cell beside its points
struct Bezier_cell_data
{
  std::size_t patch;
  std::size_t face;
  bool is_extraordinary;
};

/// the order of the points of `VTK_BEZIER_QUADRILATERAL`: corners, sides, inside
inline std::vector<std::size_t> vtk_point_order(int du, int dv)
{
  auto at = [du](int i, int j) { return std::size_t(j * (du + 1) + i); };
  std::vector<std::size_t> order = {at(0, 0), at(du, 0), at(du, dv), at(0, dv)};
  for(int i = 1; i < du; ++i)
    order.push_back(at(i, 0));
  for(int j = 1; j < dv; ++j)
    order.push_back(at(du, j));
  for(int i = 1; i < du; ++i)
    order.push_back(at(i, dv));
  for(int j = 1; j < dv; ++j)
    order.push_back(at(0, j));
  for(int j = 1; j < dv; ++j)
    for(int i = 1; i < du; ++i)
      order.push_back(at(i, j));
  return order;
}

inline void write_vtu_array_head(Text_buffer& out, const char* type, const char* name,
                                 int components)
{
  out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
      << components << "\" format=\"ascii\">\n";
}

inline void write_vtu_geometry(Text_buffer& out, const std::vector<Bezier_piece>& pieces)
{
  constexpr int VTK_BEZIER_QUADRILATERAL = 77;
  out << "<Points>\n";
  write_vtu_array_head(out, "Float64", "Points", 3);
  std::size_t n = 0;
  for(const Bezier_piece& piece : pieces)
  {
    for(std::size_t i : vtk_point_order(piece.degree[0], piece.degree[1]))
    {
      const Eigen::Vector3d& p = piece.points[i];
      out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
    n += piece.points.size();
  }
  out << "</DataArray>\n</Points>\n<Cells>\n";
  write_vtu_array_head(out, "Int64", "connectivity", 1);
  for(std::size_t i = 0; i < n; ++i)
    out << i << '\n';
  out << "</DataArray>\n";
  write_vtu_array_head(out, "Int64", "offsets", 1);
  std::size_t offset = 0;
  for(const Bezier_piece& piece : pieces)
    out << (offset += piece.points.size()) << '\n';
  out << "</DataArray>\n";
  write_vtu_array_head(out, "UInt8", "types", 1);
  for(std::size_t i = 0; i < pieces.size(); ++i)
    out << VTK_BEZIER_QUADRILATERAL << '\n';
  out << "</DataArray>\n</Cells>\n";
}

inline void write_vtu_cell_data(Text_buffer& out, const std::vector<Bezier_piece>& pieces,
                                const std::vector<Bezier_cell_data>& data)
{
  out << "<CellData HigherOrderDegrees=\"HigherOrderDegrees\">\n";
  write_vtu_array_head(out, "Float64", "HigherOrderDegrees", 3);
  for(const Bezier_piece& piece : pieces)
    out << piece.degree[0] << ' ' << piece.degree[1] << " 0\n";
  out << "</DataArray>\n";
  write_vtu_array_head(out, "Int64", "patch", 1);
  for(const Bezier_cell_data& d : data)
    out << d.patch << '\n';
  out << "</DataArray>\n";
  write_vtu_array_head(out, "Int64", "face", 1);
  for(const Bezier_cell_data& d : data)
    out << d.face << '\n';
  out << "</DataArray>\n";
  write_vtu_array_head(out, "UInt8", "extraordinary", 1);
  for(const Bezier_cell_data& d : data)
    out << (d.is_extraordinary ? "1\n" : "0\n");
  out << "</DataArray>\n</CellData>\n";
}

inline bool write_vtu(std::ostream& os, const std::vector<Bezier_piece>& pieces,
                      const std::vector<Bezier_cell_data>& data)
{
  std::size_t n = 0;
  for(const Bezier_piece& piece : pieces)
    n += piece.points.size();
  {
    Text_buffer out(os);
    out << "<?xml version=\"1.0\"?>\n"
        << "<VTKFile type=\"UnstructuredGrid\" version=\"2.0\" byte_order=\"LittleEndian\">\n"
        << "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" << n << "\" NumberOfCells=\""
        << pieces.size() << "\">\n";
    write_vtu_geometry(out, pieces);
    write_vtu_cell_data(out, pieces, data);
    out << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }
  os.flush();
  return os.good();
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion

namespace IO {

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes the polynomial pieces of a shell to a stream as exact Bezier cells
(`VTK_BEZIER_QUADRILATERAL`) in the XML format of VTK for unstructured grids, which ParaView shows.
The cell data are `patch`, `face` and `extraordinary` (is it a cap?).

\tparam K a model of `Kernel`
\return `true` if the stream is still good
*/
template <typename K>
bool write_VTU(std::ostream& os, const Surface_mesh_spline_conversion::NURBS_shell_3<K>& shell)
{
  namespace internal = Surface_mesh_spline_conversion::internal;
  const std::vector<internal::Bezier_piece> pieces = internal::bezier_pieces(shell);
  std::vector<internal::Bezier_cell_data> data;
  for(const internal::Bezier_piece& piece : pieces)
    data.push_back({shell.face(piece.face).patch, piece.face,
                    shell.face(piece.face).is_extraordinary});
  return internal::write_vtu(os, pieces, data);
}

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes the polynomial pieces of a shell to the file `filename`, as above.

\return `true` if the file was written
*/
template <typename K>
bool write_VTU(const std::string& filename,
               const Surface_mesh_spline_conversion::NURBS_shell_3<K>& shell)
{
  std::ofstream os(filename, std::ios::binary);
  return os && write_VTU(os, shell);
}

} // namespace IO
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_VTU_H
