// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_CONVERSION_HISTORY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_CONVERSION_HISTORY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/History_chart.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/JSON_writer.h>

#include <fstream>
#include <ostream>
#include <string>

namespace CGAL {
namespace IO {

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes the iterations of `report` as a table with comma separated values: a line with the names of
the columns, then one line per iteration. Fields that were not measured are empty.

\returns `true` if the stream is good after writing
*/
inline bool write_history_CSV(std::ostream& out,
                              const Surface_mesh_spline_conversion::Conversion_report& report)
{
  using Surface_mesh_spline_conversion::internal::number_to_string;
  out << "stage,iteration,patches,control_points,"
         "boundary_linf,boundary_hausdorff,interior_linf,seconds,component\n";
  for(const auto& record : report.iterations)
    out << record.stage << ',' << std::to_string(record.iteration) << ','
        << std::to_string(record.patches) << ',' << std::to_string(record.control_points) << ','
        << number_to_string(record.boundary_linf, "") << ','
        << number_to_string(record.boundary_hausdorff, "") << ','
        << number_to_string(record.interior_linf, "") << ','
        << number_to_string(record.seconds, "") << ',' << std::to_string(record.component) << '\n';
  return out.good();
}

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes the iterations of `report` to the file `filename`, see the overload for streams.

\returns `true` if the file was written
*/
inline bool write_history_CSV(const std::string& filename,
                              const Surface_mesh_spline_conversion::Conversion_report& report)
{
  std::ofstream out(filename);
  return write_history_CSV(out, report) && out.flush().good();
}

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

draws the iterations of `report` as a chart in the form of the figures of the paper: the errors on
a logarithmic axis on the left, the number of patches on the right, and a dashed line for each
tolerance. The courses of several connected components follow each other, with a vertical line
between them.

\returns `true` if the file was written
*/
inline bool write_history_SVG(const std::string& filename,
                              const Surface_mesh_spline_conversion::Conversion_report& report)
{
  std::ofstream out(filename);
  Surface_mesh_spline_conversion::internal::History_chart(report).write(out);
  return out.flush().good();
}

} // namespace IO
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_CONVERSION_HISTORY_H
