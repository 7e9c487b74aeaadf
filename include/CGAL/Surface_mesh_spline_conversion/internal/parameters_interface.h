// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
// X-macro list; no include guard on purpose. It has the form of
// CGAL/STL_Extension/internal/parameters_interface.h, where the first block moves at merge time.

// new named parameters of this package
#ifdef CGAL_add_named_parameter
CGAL_add_named_parameter(boundary_tolerance_t, boundary_tolerance, boundary_tolerance)
CGAL_add_named_parameter(interior_tolerance_t, interior_tolerance, interior_tolerance)
CGAL_add_named_parameter(quad_size_map_t, quad_size_map, quad_size_map)
CGAL_add_named_parameter(cross_field_map_t, cross_field_map, cross_field_map)
CGAL_add_named_parameter(corner_angle_t, corner_angle, corner_angle)
CGAL_add_named_parameter(association_tolerance_t, association_tolerance, association_tolerance)
CGAL_add_named_parameter(error_metric_t, error_metric, error_metric)
CGAL_add_named_parameter(maximum_number_of_patches_t, maximum_number_of_patches,
                         maximum_number_of_patches)
CGAL_add_named_parameter(do_coarsen_patches_t, do_coarsen_patches, do_coarsen_patches)
CGAL_add_named_parameter(do_certify_interior_t, do_certify_interior, do_certify_interior)
CGAL_add_named_parameter(do_fair_interior_t, do_fair_interior, do_fair_interior)
CGAL_add_named_parameter(do_merge_patches_t, do_merge_patches, do_merge_patches)
CGAL_add_named_parameter(boundary_band_t, boundary_band, boundary_band)
CGAL_add_named_parameter(boundary_vertices_t, boundary_vertices, boundary_vertices)
CGAL_add_named_parameter(boundary_tangency_t, boundary_tangency, boundary_tangency)
CGAL_add_named_parameter(do_keep_large_corners_t, do_keep_large_corners, do_keep_large_corners)
CGAL_add_named_parameter(use_caps_t, use_caps, use_caps)
CGAL_add_named_parameter(use_proxy_mesh_t, use_proxy_mesh, use_proxy_mesh)
CGAL_add_named_parameter(use_smooth_correspondence_t, use_smooth_correspondence,
                         use_smooth_correspondence)
CGAL_add_named_parameter(use_smooth_target_t, use_smooth_target, use_smooth_target)
#endif

// parameters that CGAL already has and that this package accepts
#ifdef CGAL_add_existing_named_parameter
CGAL_add_existing_named_parameter(vertex_point_t, vertex_point_map)
CGAL_add_existing_named_parameter(geom_traits_t, geom_traits)
CGAL_add_existing_named_parameter(vertex_is_constrained_t, vertex_is_constrained_map)
CGAL_add_existing_named_parameter(visitor_t, visitor)
CGAL_add_existing_named_parameter(verbose_t, verbose)
CGAL_add_existing_named_parameter(number_of_iterations_t, number_of_iterations)
#endif
