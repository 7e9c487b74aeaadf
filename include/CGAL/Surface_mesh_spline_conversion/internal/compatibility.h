// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_COMPATIBILITY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_COMPATIBILITY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

// the only file that names a CGAL version
#include <CGAL/version.h>
#if CGAL_VERSION_NR >= 1060000000
#  include <CGAL/AABB_traits_3.h>
#  include <variant>
#else
#  include <CGAL/AABB_traits.h>
#  include <boost/variant/get.hpp>
#endif
#include <optional>
namespace CGAL { namespace Surface_mesh_spline_conversion { namespace internal {
#if CGAL_VERSION_NR >= 1060000000
template <class GT, class P> using AABB_traits_3 = CGAL::AABB_traits_3<GT, P>;
template <class T, class V> const T* get_if(const V* v) { return std::get_if<T>(v); }
#else
template <class GT, class P> using AABB_traits_3 = CGAL::AABB_traits<GT, P>;
template <class T, class V> const T* get_if(const V* v) { return boost::get<T>(v); }
#endif
template <class Index, class T, class Mesh>
auto find_property_map(const Mesh& mesh, const std::string& name)
{
  typedef typename Mesh::template Property_map<Index, T> Map;
  auto r = mesh.template property_map<Index, T>(name);
#if CGAL_VERSION_NR >= 1060000000
  return std::optional<Map>(r);
#else
  return r.second ? std::optional<Map>(r.first) : std::optional<Map>();
#endif
}
}}}
#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_COMPATIBILITY_H
