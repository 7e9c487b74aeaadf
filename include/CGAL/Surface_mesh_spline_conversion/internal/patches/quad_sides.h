// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_QUAD_SIDES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_QUAD_SIDES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>

#include <array>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// returns the local coordinates (u,v) of the point at parameter `t` of side `i` and at distance
// `d` inwards
template <typename FT>
std::array<FT, 2> from_side(int i, const FT& t, const FT& d)
{
  switch(i & 3)
  {
    case 0: return {{t, d}};
    case 1: return {{FT(1) - d, t}};
    case 2: return {{FT(1) - t, FT(1) - d}};
    default: return {{d, FT(1) - t}};
  }
}

// returns the parameter along side `i` and the distance inwards of the point `(u,v)`
template <typename FT>
std::array<FT, 2> to_side(int i, const FT& u, const FT& v)
{
  switch(i & 3)
  {
    case 0: return {{u, v}};
    case 1: return {{v, FT(1) - u}};
    case 2: return {{FT(1) - u, FT(1) - v}};
    default: return {{FT(1) - v, u}};
  }
}

// a point of the parameter domain of a layout
template <typename FT>
struct Quad_point
{
  std::size_t quad;
  FT u, v;
};

// Brings a point outside the unit square of its quad to the quad that it lies in, through the
// transitions of the layout; stops at the boundary of the layout. The point lies at most a
// fraction of a quad outside, so that few crossings are needed.
template <typename GeomTraits>
Quad_point<typename GeomTraits::FT>
cross_sides(const Quad_layout<GeomTraits>& layout, Quad_point<typename GeomTraits::FT> p)
{
  typedef typename GeomTraits::FT FT;
  constexpr int maximum_number_of_crossings = 4;
  auto clamped = [](const FT& x) { return x < FT(0) ? FT(0) : (x > FT(1) ? FT(1) : x); };

  for(int crossing = 0; crossing < maximum_number_of_crossings; ++crossing)
  {
    int side = -1;
    for(int i = 0; i < 4 && side < 0; ++i)
      if(to_side(i, p.u, p.v)[1] < FT(0) && !layout.is_border(p.quad, i))
        side = i;
    if(side < 0)
      break;
    const std::array<FT, 2> td = to_side(side, p.u, p.v);
    const std::pair<std::size_t, int> other = layout.neighbor(p.quad, side);
    const std::array<FT, 2> uv = from_side(other.second, FT(1) - td[0], -td[1]);
    p = Quad_point<FT>{other.first, uv[0], uv[1]};
  }
  return Quad_point<FT>{p.quad, clamped(p.u), clamped(p.v)};
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_QUAD_SIDES_H
