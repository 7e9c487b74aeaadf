// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_NAMED_PARAMETERS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_NAMED_PARAMETERS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Named_function_parameters.h>
namespace CGAL {
namespace internal_np {
#define CGAL_add_named_parameter(X, Y, Z) enum X { Y };
#include <CGAL/Surface_mesh_spline_conversion/internal/parameters_interface.h>
#undef CGAL_add_named_parameter
} // namespace internal_np
namespace Surface_mesh_spline_conversion { namespace internal {

// a CGAL named-parameter pack that also offers the setters of this package
template <typename T, typename Tag, typename Base = internal_np::No_property>
struct Named_parameters : CGAL::Named_function_parameters<T, Tag, Base>
{
  typedef CGAL::Named_function_parameters<T, Tag, Base> Pack;
  using Pack::Pack;

#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_SETTER(X, Z)                                              \
  template <typename K>                                                        \
  Named_parameters<K, internal_np::X, Pack> Z(const K& k) const                \
  { return Named_parameters<K, internal_np::X, Pack>(k, *this); }
#define CGAL_add_named_parameter(X, Y, Z)       CGAL_SURFACE_MESH_SPLINE_CONVERSION_SETTER(X, Z)
#define CGAL_add_existing_named_parameter(X, Z) CGAL_SURFACE_MESH_SPLINE_CONVERSION_SETTER(X, Z)
#include <CGAL/Surface_mesh_spline_conversion/internal/parameters_interface.h>
#undef CGAL_add_named_parameter
#undef CGAL_add_existing_named_parameter
#undef CGAL_SURFACE_MESH_SPLINE_CONVERSION_SETTER
};
}} // namespace Surface_mesh_spline_conversion::internal

namespace parameters {
#define CGAL_add_named_parameter(X, Y, Z)                                                          \
  template <typename K>                                                                            \
  Surface_mesh_spline_conversion::internal::Named_parameters<K, internal_np::X> Z(const K& k)                  \
  { return Surface_mesh_spline_conversion::internal::Named_parameters<K, internal_np::X>(k); }
#include <CGAL/Surface_mesh_spline_conversion/internal/parameters_interface.h>
#undef CGAL_add_named_parameter
} // namespace parameters
} // namespace CGAL
#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_NAMED_PARAMETERS_H
