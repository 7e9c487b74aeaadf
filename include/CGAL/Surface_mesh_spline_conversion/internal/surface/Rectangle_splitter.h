// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_RECTANGLE_SPLITTER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_RECTANGLE_SPLITTER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Bisects the patches of a T-mesh until none of them is longer than a rectangle that it overlaps,
// in any of the two directions. A patch is cut such that few rectangles are cut with it. Leaves the
// rules of the refinement closure to the caller.
template <typename Point>
class Rectangle_splitter
{
  typedef T_mesh<Point> Mesh;
  typedef typename Mesh::Face Face;

public:
  // [first[0], last[0]] x [first[1], last[1]] in the coordinates of a quad of the layout
  struct Rectangle
  {
    std::array<double, 2> first, last;
  };

  typedef std::vector<Rectangle> Rectangles;

  explicit Rectangle_splitter(Mesh& mesh) : m_mesh(mesh) {}

  void add(std::size_t quad, const Rectangle& rectangle)
  {
    if(m_rectangles.size() <= quad)
      m_rectangles.resize(quad + 1);
    m_rectangles[quad].push_back(rectangle);
  }

  void run()
  {
    std::vector<Face> patches;
    for(Face f : m_mesh.mesh().faces())
      if(m_mesh.is_patch(f) && m_mesh.origin(f).quad < m_rectangles.size())
        patches.push_back(f);
    for(Face f : patches)
      split(f, m_rectangles[m_mesh.origin(f).quad]);
    m_mesh.update_frames();
  }

private:
  static constexpr int none = -1;

  Rectangle rectangle(Face f) const
  {
    const Face_origin& o = m_mesh.origin(f);
    return Rectangle{{{to_parameter(o.first[0]), to_parameter(o.first[1])}},
                     {{to_parameter(o.last[0]), to_parameter(o.last[1])}}};
  }

  static bool overlap(const Rectangle& r, const Rectangle& s)
  {
    return r.first[0] < s.last[0] && s.first[0] < r.last[0] && r.first[1] < s.last[1]
           && s.first[1] < r.last[1];
  }

  // `candidates` are the rectangles that may overlap the face
  void split(Face f, const Rectangles& candidates)
  {
    const Rectangle r = rectangle(f);
    Rectangles overlapping;
    for(const Rectangle& s : candidates)
      if(overlap(r, s))
        overlapping.push_back(s);
    const int axis = axis_of_cut(r, overlapping);
    if(axis == none)
      return;
    for(Face part : m_mesh.bisect(f, axis))
      split(part, overlapping);
  }

  // of the axes along which the patch is too long, the one whose cut divides the smaller number of
  // rectangles, or the longer one if both are equal; `none` if the patch is short enough
  static int axis_of_cut(const Rectangle& r, const Rectangles& rectangles)
  {
    std::array<bool, 2> is_too_long = {{false, false}};
    std::array<std::size_t, 2> divided = {{0, 0}};
    for(const Rectangle& s : rectangles)
      for(std::size_t axis : {0, 1})
      {
        const double middle = (r.first[axis] + r.last[axis]) / 2;
        is_too_long[axis] = is_too_long[axis] || length(r, axis) > length(s, axis);
        divided[axis] += s.first[axis] < middle && middle < s.last[axis] ? 1 : 0;
      }
    if(!is_too_long[0] || !is_too_long[1])
      return is_too_long[0] ? 0 : (is_too_long[1] ? 1 : none);
    if(divided[0] != divided[1])
      return divided[0] < divided[1] ? 0 : 1;
    return length(r, 0) >= length(r, 1) ? 0 : 1;
  }

  static double length(const Rectangle& r, std::size_t axis) { return r.last[axis] - r.first[axis]; }

  Mesh& m_mesh;
  std::vector<Rectangles> m_rectangles; // per quad
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_RECTANGLE_SPLITTER_H
