// Operations of CAD users on the stitched window model, where gaps normal to the plane of the
// window let them fail: the same operations on the exact model pass.
#include "brep_models.h"

#include <CGAL/Surface_mesh_spline_conversion/stitch_with_BRep.h>
#include <CGAL/Surface_mesh_spline_conversion/try_BRep_operation.h>

#include <cassert>
#include <iostream>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;

int main()
{
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
