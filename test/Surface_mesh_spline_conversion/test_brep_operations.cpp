// Operations of CAD users on the stitched window model, where gaps normal to the plane of the
// window let them fail: the same operations on the exact model pass. And on the exact model of a
// case.
#include "brep_models.h"

#include <CGAL/Surface_mesh_spline_conversion/IO/BRep.h>
#include <CGAL/Surface_mesh_spline_conversion/stitch_with_BRep.h>
#include <CGAL/Surface_mesh_spline_conversion/try_BRep_operation.h>

#include <CGAL/config.h>

#include <BRepBuilderAPI_Sewing.hxx>

#include <cassert>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;

// The case d2 is a prism, whose organic face is plane: a plane face in the free edge makes the
// exact model.
TopoDS_Shape exact_prism()
{
  TopoDS_Shape residual, result;
  std::string message;
  const std::string file = CGAL::data_file_path("cases/d2_square_corner/residual.step");
  assert(CGAL::IO::read_BRep(file, residual, message));
  std::map<const TopoDS_TShape*, int> uses;
  for(TopExp_Explorer x(residual, TopAbs_EDGE); x.More(); x.Next())
    ++uses[x.Current().TShape().get()];
  BRepBuilderAPI_MakeWire wire;
  for(TopExp_Explorer x(residual, TopAbs_EDGE); x.More(); x.Next())
    if(uses[x.Current().TShape().get()] == 1)
      wire.Add(TopoDS::Edge(x.Current()));
  BRepBuilderAPI_Sewing sewing;
  sewing.Add(residual);
  sewing.Add(BRepBuilderAPI_MakeFace(wire.Wire(), Standard_True).Face());
  sewing.Perform();
  std::vector<TopoDS_Face> faces;
  for(TopExp_Explorer x(sewing.SewedShape(), TopAbs_FACE); x.More(); x.Next())
    faces.push_back(TopoDS::Face(x.Current()));
  return SMSC::internal::Solid_assembler(faces)();
}

// The boundary has hundreds of spans: quadrature with a fixed number of points misses this volume
// by 4e-4, more than the accuracy to which both parts of a cut must fill the whole.
void test_exact_prism()
{
  const TopoDS_Shape prism = exact_prism();
  const SMSC::Stitching_report report = SMSC::measure_BRep(prism);
  std::cout << "prism: volume " << report.volume << std::endl;
  assert(report.solids == 1 && report.free_edges == 0 && report.is_valid);
  assert(std::abs(report.volume - 0.8) < 1e-7);
  assert(SMSC::try_BRep_operation(prism, SMSC::BRep_operation::CUT, 0).is_ok());
}

int main()
{
  test_exact_prism();
  const std::vector<std::pair<SMSC::BRep_operation, double> > operations
    = {{SMSC::BRep_operation::OFFSET, 1}, {SMSC::BRep_operation::THICKEN, 1.5},
       {SMSC::BRep_operation::FILLET, 1}, {SMSC::BRep_operation::CUT, 0}};
  std::map<SMSC::BRep_operation, double> exact_volumes;
  for(const double gap : {0., 1e-4}) // 1e-4 mm is about 1e-6 of the diameter
  {
    TopoDS_Shape solid;
    SMSC::Stitching_report report;
    assert(SMSC::stitch_with_BRep(window_dome(2, 2, 6, gap), box_with_window(), 2 * gap + 1e-6,
                                  solid, report));
    for(const auto& operation : operations)
    {
      const SMSC::BRep_operation_result result
        = SMSC::try_BRep_operation(solid, operation.first, operation.second);
      std::cout << "gap " << gap << ", operation " << int(operation.first) << ": " << result.status
                << ", volume " << result.volume << std::endl;
      assert(result.is_ok());
      const double exact = exact_volumes.insert({operation.first, result.volume}).first->second;
      assert(std::abs(result.volume - exact) < 1e-6 * exact);
    }
    assert(SMSC::try_BRep_operation(solid, SMSC::BRep_operation::FILLET, 1000).status != "ok");
  }
  return 0;
}
