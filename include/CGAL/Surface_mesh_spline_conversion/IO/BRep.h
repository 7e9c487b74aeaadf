// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_BREP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_BREP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/IO/STEP.h>

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Shape.hxx>

#include <algorithm>
#include <cctype>
#include <map>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// stops the messages that the translators of Open CASCADE print.
inline void silence_open_cascade()
{
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
}

/// does the name end in `extension`, in lower or upper case?
inline bool has_extension(const std::string& filename, const std::string& extension)
{
  return filename.size() >= extension.size()
      && std::equal(extension.rbegin(), extension.rend(), filename.rbegin(),
                    [](unsigned char a, unsigned char b) { return a == std::tolower(b); });
}

/// returns the name that Open CASCADE has for a unit of length, or nothing.
inline std::string unit_name(const std::string& unit)
{
  const std::map<std::string, std::string> names
    = {{"mm", "MM"}, {"cm", "CM"}, {"m", "M"}, {"um", "UM"}, {"in", "INCH"}};
  const auto name = names.find(unit);
  return (name == names.end()) ? std::string() : name->second;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion

namespace IO {

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

reads a boundary representation from a file: STEP, or the format of Open CASCADE if the name ends in
`.brep`. Coordinates are in millimetres, whatever the unit of a STEP file is.

This needs Open CASCADE. If headers of both are included, those of \cgal must come first.

\param filename name of the file
\param shape the boundary representation
\param message if reading fails, a sentence that names the file

\return `true` if the file holds a shape
*/
inline bool read_BRep(const std::string& filename, TopoDS_Shape& shape, std::string& message)
{
  namespace internal = Surface_mesh_spline_conversion::internal;
  internal::silence_open_cascade();
  if(internal::has_extension(filename, ".brep"))
  {
    if(BRepTools::Read(shape, filename.c_str(), BRep_Builder()))
      return true;
    message = filename + " cannot be read as a file of Open CASCADE";
    return false;
  }
  STEPControl_Reader reader;
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  if(reader.ReadFile(filename.c_str()) != IFSelect_RetDone)
  {
    message = filename + " cannot be read as a STEP file";
    return false;
  }
  reader.TransferRoots();
  shape = reader.OneShape();
  if(!shape.IsNull())
    return true;
  message = "the STEP file " + filename + " holds no shape";
  return false;
}

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

writes a boundary representation to a file: STEP, or the format of Open CASCADE if the name ends in
`.brep`; only the latter keeps tolerances. The uncertainty in a STEP file is the largest tolerance,
so that readers take edges as they are. Equal shapes give equal files: a STEP file has the default
time stamp of `STEP_information`.

This needs Open CASCADE. If headers of both are included, those of \cgal must come first.

\param filename name of the file
\param shape the boundary representation, in millimetres
\param unit the unit of the STEP file: `"mm"`, `"cm"`, `"m"`, `"um"` or `"in"`

\return `true` if the unit is known and the file was written
*/
inline bool write_BRep(const std::string& filename, const TopoDS_Shape& shape,
                       const std::string& unit = "mm")
{
  namespace internal = Surface_mesh_spline_conversion::internal;
  internal::silence_open_cascade();
  if(internal::has_extension(filename, ".brep"))
    return BRepTools::Write(shape, filename.c_str());
  if(internal::unit_name(unit).empty())
    return false;
  STEPControl_Controller::Init(); // the parameters exist from then on
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  Interface_Static::SetCVal("write.step.unit", internal::unit_name(unit).c_str());
  // By default the uncertainty is the mean of the tolerances. Where an edge deviates more from a
  // face, Open CASCADE then replaces its curve in the parameter plane by one that it checks at 22
  // points.
  const int largest_tolerance = 1;
  Interface_Static::SetIVal("write.precision.mode", largest_tolerance);
  STEPControl_Writer writer; // takes the factor of the unit when it is made
  if(writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone)
    return false;
  APIHeaderSection_MakeHeader header(writer.Model());
  header.SetTimeStamp(new TCollection_HAsciiString(
    Surface_mesh_spline_conversion::STEP_information().time_stamp.c_str()));
  return writer.Write(filename.c_str()) == IFSelect_RetDone;
}

} // namespace IO
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_BREP_H
