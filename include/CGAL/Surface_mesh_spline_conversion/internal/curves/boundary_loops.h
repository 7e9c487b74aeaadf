// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_BOUNDARY_LOOPS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_BOUNDARY_LOOPS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>

#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// returns the boundary loops of a mesh. A loop consists of the halfedges whose faces lie in the
// mesh (their opposites are border halfedges); the mesh is to their left.
// The loops are ordered by their first halfedges in halfedges(tm).
template <typename TriangleMesh>
std::vector<std::vector<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor> >
boundary_loops(const TriangleMesh& tm)
{
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_descriptor;

  auto is_visited = get(dynamic_halfedge_property_t<bool>(), tm);
  for(const halfedge_descriptor h : halfedges(tm))
    put(is_visited, h, false);
  std::vector<std::vector<halfedge_descriptor> > loops;
  for(const halfedge_descriptor first : halfedges(tm))
  {
    if(!is_border(opposite(first, tm), tm) || is_border(first, tm) || get(is_visited, first))
      continue;
    loops.emplace_back();
    for(halfedge_descriptor h = first; !get(is_visited, h); )
    {
      put(is_visited, h, true);
      loops.back().push_back(h);
      h = opposite(prev(opposite(h, tm), tm), tm);
    }
  }
  return loops;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_BOUNDARY_LOOPS_H
