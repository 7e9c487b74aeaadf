// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_TRY_BREP_OPERATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_TRY_BREP_OPERATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/run_in_child_process.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/volume.h>
#include <CGAL/Surface_mesh_spline_conversion/measure_BRep.h>

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBndLib.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepGProp.hxx>
#include <BRepOffsetAPI_MakeOffsetShape.hxx>
#include <BRepOffsetAPI_MakeThickSolid.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Plane.hxx>
#include <Standard_Failure.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

is what CAD users do with a solid.
*/
enum class BRep_operation
{
  OFFSET,  ///< moves all faces outwards
  THICKEN, ///< turns the solid into a wall outside of its faces, open at the largest planar face
  FILLET,  ///< rounds the edges between B-spline faces and other faces
  CHAMFER, ///< cuts these edges
  CUT      ///< cuts the solid in two with a box that covers a part of it
};

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

is how an operation on a B-Rep ended.
*/
struct BRep_operation_result
{
  /// `"ok"`, `"not done"`, `"invalid"`, `"free edges"`, `"faces lost"`, `"wrong volume"`,
  /// `"crashed"`, `"timed out"`, or `"not applicable"`
  std::string status;
  double volume = std::numeric_limits<double>::quiet_NaN(); ///< volume of the result

  /// returns `true` if the result is a valid, closed solid with a plausible volume.
  bool is_ok() const { return status == "ok"; }
};

namespace internal {

/// Applies one operation to a solid, and judges the result.
class BRep_operation_trial
{
public:
  BRep_operation_trial(const TopoDS_Shape& shape, double size) : m_shape(shape), m_size(size)
  {
    BRepBndLib::Add(shape, m_bounds);
    if(!(size > 0))
      m_size = DEFAULT_RELATIVE_SIZE * m_bounds.CornerMin().Distance(m_bounds.CornerMax());
    GProp_GProps surface;
    BRepGProp::SurfaceProperties(shape, surface);
    m_volume = internal::volume(shape);
    m_area = surface.Mass();
  }

  BRep_operation_result operator()(BRep_operation operation) const
  {
    try
    {
      switch(operation)
      {
        case BRep_operation::OFFSET: return offset();
        case BRep_operation::THICKEN: return thicken();
        case BRep_operation::FILLET: return fillet();
        case BRep_operation::CHAMFER: return chamfer();
        case BRep_operation::CUT: return cut();
      }
    }
    catch(const Standard_Failure&) {}
    return {"not done"};
  }

private:
  static constexpr double DEFAULT_RELATIVE_SIZE = 0.01;
  // offsets follow the first order estimate, area times distance, up to the effect of curvature
  static constexpr double SHARE_OF_ESTIMATE = 0.25;
  static constexpr double OFFSET_TOLERANCE = 1e-4;  // of the kernel for its own intersections, mm
  static constexpr double CUT_ACCURACY = 1e-4;      // relative to the volume
  static constexpr double FILLET_SHARE = 0.05;      // a fillet changes less of the volume

  static BRep_operation_result judge(const TopoDS_Shape& shape, double least, double largest)
  {
    if(shape.IsNull())
      return {"not done"};
    const Stitching_report report = measure_BRep(shape);
    const double volume = internal::volume(shape);
    if(!report.is_valid)
      return {"invalid", volume};
    if(report.free_edges > 0)
      return {"free edges", volume};
    if(!(volume >= least && volume <= largest))
      return {"wrong volume", volume};
    return {"ok", volume};
  }

  // The kernel may drop faces, and call the rest valid: every face but `removed` must have an
  // image.
  template <typename Maker>
  BRep_operation_result judge_images(Maker& maker, const TopoDS_Face& removed, double estimate,
                                     double volume) const
  {
    const BRep_operation_result result
      = judge(maker.Shape(), volume + (1 - SHARE_OF_ESTIMATE) * estimate,
              volume + (1 + SHARE_OF_ESTIMATE) * estimate);
    if(!result.is_ok())
      return result;
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(maker.Shape(), TopAbs_FACE, faces);
    for(TopExp_Explorer x(m_shape, TopAbs_FACE); x.More(); x.Next())
    {
      bool has_image = x.Current().IsSame(removed);
      for(const TopoDS_Shape& image : maker.Generated(x.Current()))
        has_image = has_image || faces.Contains(image);
      if(!has_image)
        return {"faces lost", result.volume};
    }
    return result;
  }

  BRep_operation_result offset() const
  {
    BRepOffsetAPI_MakeOffsetShape maker;
    maker.PerformByJoin(m_shape, m_size, OFFSET_TOLERANCE, BRepOffset_Skin, Standard_False,
                        Standard_False, GeomAbs_Arc);
    if(!maker.IsDone())
      return {"not done"};
    return judge_images(maker, TopoDS_Face(), m_area * m_size, m_volume);
  }

  BRep_operation_result thicken() const
  {
    TopoDS_Face open;
    double open_area = 0;
    for(TopExp_Explorer x(m_shape, TopAbs_FACE); x.More(); x.Next())
    {
      const TopoDS_Face& face = TopoDS::Face(x.Current());
      GProp_GProps properties;
      BRepGProp::SurfaceProperties(face, properties);
      if(!Handle(Geom_Plane)::DownCast(BRep_Tool::Surface(face)).IsNull()
         && properties.Mass() > open_area)
      {
        open = face;
        open_area = properties.Mass();
      }
    }
    if(open.IsNull())
      return {"not applicable"};
    TopTools_ListOfShape open_faces;
    open_faces.Append(open);
    BRepOffsetAPI_MakeThickSolid maker;
    maker.MakeThickSolidByJoin(m_shape, open_faces, m_size, 10 * OFFSET_TOLERANCE, BRepOffset_Skin,
                               Standard_False, Standard_False, GeomAbs_Arc);
    if(!maker.IsDone())
      return {"not done"};
    return judge_images(maker, open, (m_area - open_area) * m_size, 0);
  }

  // calls `add` for each edge between a B-spline face and another face
  bool for_joint_edges(const std::function<void(const TopoDS_Edge&)>& add) const
  {
    TopTools_IndexedDataMapOfShapeListOfShape faces;
    TopExp::MapShapesAndAncestors(m_shape, TopAbs_EDGE, TopAbs_FACE, faces);
    bool is_found = false;
    for(int i = 1; i <= faces.Extent(); ++i)
    {
      int splines = 0;
      for(const TopoDS_Shape& face : faces(i))
        splines += !Handle(Geom_BSplineSurface)::DownCast(
          BRep_Tool::Surface(TopoDS::Face(face))).IsNull();
      if(splines != 1 || faces(i).Extent() != 2)
        continue;
      add(TopoDS::Edge(faces.FindKey(i)));
      is_found = true;
    }
    return is_found;
  }

  template <typename Maker>
  BRep_operation_result blend(Maker& maker) const
  {
    if(!for_joint_edges([this, &maker](const TopoDS_Edge& edge)
       {
         if(maker.Contour(edge) == 0) // not yet added along tangent edges
           maker.Add(m_size, edge);
       }))
      return {"not applicable"};
    maker.Build();
    if(!maker.IsDone())
      return {"not done"};
    return judge(maker.Shape(), (1 - FILLET_SHARE) * m_volume, (1 + FILLET_SHARE) * m_volume);
  }

  BRep_operation_result fillet() const
  {
    BRepFilletAPI_MakeFillet maker(m_shape);
    return blend(maker);
  }

  BRep_operation_result chamfer() const
  {
    BRepFilletAPI_MakeChamfer maker(m_shape);
    return blend(maker);
  }

  BRep_operation_result cut() const
  {
    const gp_Pnt low = m_bounds.CornerMin(), high = m_bounds.CornerMax();
    const gp_Vec diagonal(low, high);
    // through faces, not along them
    const gp_Pnt corner = low.Translated(gp_Vec(0.43 * diagonal.X(), 0.37 * diagonal.Y(),
                                                -0.1 * diagonal.Z()));
    const TopoDS_Shape box = BRepPrimAPI_MakeBox(corner, high.Translated(0.1 * diagonal)).Shape();
    BRepAlgoAPI_Cut outer(m_shape, box);
    BRepAlgoAPI_Common inner(m_shape, box);
    if(!outer.IsDone() || outer.HasErrors() || !inner.IsDone() || inner.HasErrors())
      return {"not done"};
    const BRep_operation_result part = judge(inner.Shape(), 0, m_volume);
    if(!part.is_ok())
      return part;
    const double rest = m_volume - part.volume;
    return judge(outer.Shape(), rest - CUT_ACCURACY * m_volume, rest + CUT_ACCURACY * m_volume);
  }

  TopoDS_Shape m_shape;
  Bnd_Box m_bounds;
  double m_size;
  double m_volume;
  double m_area;
};

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionOpenCascade

applies an operation to a solid in a child process, so that a crash or an endless loop of the kernel
only loses this result. The result is judged: it must be valid and closed, without loss of faces,
and with a volume that agrees with an estimate (area times distance for offset and wall, the sum of
both parts for a cut).

An operation may also fail on a perfect model: compare with one where the surface is exact.

This needs Open CASCADE and a POSIX system. If headers of both are included, those of \cgal must
come first.

\param shape a solid in millimetres
\param operation the operation
\param size distance, thickness, or radius in millimetres, not used by the cut; if it is not
       positive, a hundredth of the diagonal of the bounding box
\param seconds the time limit
*/
inline BRep_operation_result try_BRep_operation(const TopoDS_Shape& shape,
                                                BRep_operation operation, double size,
                                                unsigned int seconds = 120)
{
  std::string bytes; // the volume, and the status
  const internal::Child_end end = internal::run_in_child_process([&]
  {
    const BRep_operation_result r = internal::BRep_operation_trial(shape, size)(operation);
    return std::string(reinterpret_cast<const char*>(&r.volume), sizeof r.volume) + r.status;
  }, seconds, bytes);
  BRep_operation_result result;
  switch(end)
  {
    case internal::Child_end::NORMAL:
      std::memcpy(&result.volume, bytes.data(), sizeof result.volume);
      result.status = bytes.substr(sizeof result.volume);
      break;
    case internal::Child_end::CRASHED: result.status = "crashed"; break;
    case internal::Child_end::TIMED_OUT: result.status = "timed out"; break;
    case internal::Child_end::NOT_STARTED: result.status = "not done"; break;
  }
  return result;
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_TRY_BREP_OPERATION_H
