// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_PICTURE_SCENE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_PICTURE_SCENE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

The class `Picture_scene` holds what a picture shows: shaded triangles, lines and marks on them, all
as plain arrays, so that anything can be drawn. `IO::write_PNG()` draws it without a display and
without any library.
*/
struct Picture_scene
{
  typedef std::array<double, 3> Point;        ///< Cartesian coordinates
  typedef std::array<unsigned char, 3> Color; ///< red, green, blue

  /// tells how the triangles are coloured.
  enum class Shading
  {
    PLAIN,  ///< in one colour, bluish where the surface is seen from inside
    VALUES, ///< by `values`, from blue over white to red, black beyond `largest_value`
    ZEBRA   ///< as a mirror of parallel stripes of light, which shows the order of continuity
  };

  /// is a line segment.
  struct Line
  {
    Point source;     ///< one end
    Point target;     ///< the other end
    Color color;      ///< the colour
    double thickness; ///< in pixels
  };

  /// is a disc that faces the viewer.
  struct Mark
  {
    Point point;   ///< the centre
    Color color;   ///< the colour
    double radius; ///< in pixels
  };

  std::vector<Point> points;                            ///< the vertices of the triangles
  std::vector<Point> normals;                           ///< unit normals at the points
  std::vector<double> values;                           ///< for `VALUES`: numbers at the points
  std::vector<std::array<std::size_t, 3> > triangles;   ///< indices of points
  std::vector<Line> lines;                              ///< drawn where they are not hidden
  std::vector<Mark> marks;                              ///< drawn where they are not hidden
  std::string title;                                    ///< the line above the picture
  Shading shading = Shading::PLAIN;                     ///< how the triangles are coloured
  double largest_value = 1;                             ///< the end of the colour map
};

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

The class `Picture_view` describes an orthographic view. The scene is scaled to fill the picture.
*/
struct Picture_view
{
  double azimuth = 35;      ///< of the direction to the viewer, in degrees around the z-axis
  double elevation = 25;    ///< of the direction to the viewer above the xy-plane, in degrees
  double zoom = 1;          ///< magnification about the centre of the scene
  std::size_t width = 760;  ///< in pixels
  std::size_t height = 700; ///< in pixels
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_PICTURE_SCENE_H
