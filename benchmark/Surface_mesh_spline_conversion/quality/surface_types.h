// The types that the programs on the quality of the surface share.
#ifndef QUALITY_SURFACE_TYPES_H
#define QUALITY_SURFACE_TYPES_H

#include <CGAL/Simple_cartesian.h>
#include <CGAL/T_NURCC_surface_3.h>

#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef SC::Quad_layout<Kernel> Layout;
typedef CGAL::T_NURCC_surface_3<Kernel> Surface;

#endif // QUALITY_SURFACE_TYPES_H
