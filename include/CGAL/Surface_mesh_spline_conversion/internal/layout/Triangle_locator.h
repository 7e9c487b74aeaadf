// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_TRIANGLE_LOCATOR_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_TRIANGLE_LOCATOR_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/chart_navigation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A face with the motion of its chart to the chart of a quad or rectangle:
// x -> R^rotation x + translation.
struct Placed_face
{
  int face;
  int rotation;
  Fixed_point_2 translation;

  Fixed_point_2 operator()(const Fixed_point_2& p) const
  {
    return plus(rotate(rotation, p), translation);
  }

  // the face beyond the halfedge `h` in the same chart
  Placed_face across(const Seamless_map& map, int h) const
  {
    const int r = (rotation - map.rotation[h]) & 3;
    return Placed_face{Working_mesh::face(map.mesh.opposite[h]), r,
                       minus(translation, rotate(r, map.translation(h)))};
  }
};

inline bool operator==(const Placed_face& a, const Placed_face& b)
{
  return a.face == b.face && a.rotation == b.rotation && a.translation == b.translation;
}

// an open rectangle of the parameter plane
struct Open_box
{
  Fixed_point_2 lower, upper;
};

// `true` if all corners of the box lie on or right of the line from `a` to `b`
inline bool is_right_of(const Open_box& box, const Fixed_point_2& a, const Fixed_point_2& b)
{
  for(int i = 0; i < 4; ++i)
  {
    const Fixed_point_2 corner = {{(i & 1) ? box.upper[0] : box.lower[0],
                                   (i & 2) ? box.upper[1] : box.lower[1]}};
    if(determinant(minus(b, a), minus(corner, a)) > 0)
      return false;
  }
  return true;
}

// separating axis tests, exact; segments and triangles are counted without their boundary
inline bool do_intersect(const Open_box& box, const Fixed_point_2& a, const Fixed_point_2& b)
{
  for(int i = 0; i < 2; ++i)
    if((std::max)(a[i], b[i]) <= box.lower[i] || (std::min)(a[i], b[i]) >= box.upper[i])
      return false;
  return !is_right_of(box, a, b) && !is_right_of(box, b, a);
}

inline bool do_intersect(const Open_box& box, const std::array<Fixed_point_2, 3>& triangle)
{
  for(int i = 0; i < 2; ++i)
    if((std::max)({triangle[0][i], triangle[1][i], triangle[2][i]}) <= box.lower[i]
       || (std::min)({triangle[0][i], triangle[1][i], triangle[2][i]}) >= box.upper[i])
      return false;
  for(int i = 0; i < 3; ++i)
    if(is_right_of(box, triangle[i], triangle[(i + 1) % 3]))
      return false;
  return true;
}

// For every quad the faces that it overlaps, with their barycentric coordinates as functions of the
// coordinates of the chart.
class Triangle_locator
{
public:
  // Starts the list of the next quad.
  void begin_quad() { m_first.push_back(m_entries.size()); }

  // Adds a face to the list of the last quad; coordinates of the chart are counted in `unit`s.
  void add(const Seamless_map& map, const Placed_face& placed, double unit)
  {
    Entry entry;
    entry.face = placed.face;
    std::array<Fixed_point_2, 3> p;
    for(int i = 0; i < 3; ++i)
      p[i] = placed(map.coordinates[3 * placed.face + i]);
    const double area = static_cast<double>(determinant(minus(p[1], p[0]), minus(p[2], p[0])));
    for(int i = 0; i < 3; ++i)
    {
      const Fixed_point_2& a = p[(i + 1) % 3];
      const Fixed_point_2& b = p[(i + 2) % 3];
      entry.coefficients[i] = {{static_cast<double>(determinant(a, b)) / area,
                                static_cast<double>(a[1] - b[1]) / area * unit,
                                static_cast<double>(b[0] - a[0]) / area * unit}};
    }
    for(int k = 0; k < 2; ++k)
    {
      entry.box.lower[k] = static_cast<double>((std::min)({p[0][k], p[1][k], p[2][k]})) / unit;
      entry.box.upper[k] = static_cast<double>((std::max)({p[0][k], p[1][k], p[2][k]})) / unit;
    }
    m_entries.push_back(entry);
  }

  // Sorts the faces of all quads into cells, in which searches are short.
  void make_cells()
  {
    m_grids.clear();
    m_first_of_cell.assign(1, 0);
    m_sorted.clear();
    for(std::size_t quad = 0; quad < m_first.size(); ++quad)
      make_cells(quad);
  }

  // the point of the mesh at (x,y): in the face that contains the point, or, within rounding, is
  // nearest to containing it
  Working_location operator()(std::size_t quad, double x, double y) const
  {
    Working_location best{-1, {{0, 0, 0}}};
    double best_minimum = 0;
    if(quad < m_grids.size())
    {
      const std::size_t cell = m_grids[quad].cell(x, y);
      for(std::size_t k = m_first_of_cell[cell]; k < m_first_of_cell[cell + 1]; ++k)
        if(improve(m_entries[m_sorted[k]], x, y, best, best_minimum) && best_minimum >= 0)
          return normalized(best);
    }
    for(std::size_t e = m_first[quad]; e < end(quad); ++e)
      if(improve(m_entries[e], x, y, best, best_minimum) && best_minimum >= 0)
        break;
    return normalized(best);
  }

private:
  struct Box
  {
    std::array<double, 2> lower, upper;
  };

  // coordinate i is coefficients[i] times (1, x, y)
  struct Entry
  {
    int face;
    std::array<std::array<double, 3>, 3> coefficients;
    Box box; // of the face in the chart
  };

  // uniform cells, `size` in each direction
  struct Grid
  {
    Box box;
    std::size_t size, first; // number of its first cell

    std::size_t position(int axis, double x) const
    {
      const double share = (x - box.lower[axis]) / (box.upper[axis] - box.lower[axis]);
      if(!(share > 0))
        return 0;
      return (std::min)(std::size_t((std::min)(share, 1.) * double(size)), size - 1);
    }

    std::size_t cell(double x, double y) const
    {
      return first + position(1, y) * size + position(0, x);
    }
  };

  std::size_t end(std::size_t quad) const
  {
    return quad + 1 < m_first.size() ? m_first[quad + 1] : m_entries.size();
  }

  // about as many cells as faces
  void make_cells(std::size_t quad)
  {
    Grid grid{{{{0, 0}}, {{1, 1}}}, 1, m_first_of_cell.size() - 1};
    while((grid.size + 1) * (grid.size + 1) <= end(quad) - m_first[quad])
      ++grid.size;
    for(std::size_t e = m_first[quad]; e < end(quad); ++e)
      for(int k = 0; k < 2; ++k)
      {
        const bool is_first = e == m_first[quad];
        const Box& box = m_entries[e].box;
        grid.box.lower[k] = is_first ? box.lower[k] : (std::min)(grid.box.lower[k], box.lower[k]);
        grid.box.upper[k] = is_first ? box.upper[k] : (std::max)(grid.box.upper[k], box.upper[k]);
      }
    m_grids.push_back(grid);
    std::vector<std::vector<std::size_t> > cells(grid.size * grid.size);
    for(std::size_t e = m_first[quad]; e < end(quad); ++e)
    {
      const Box& box = m_entries[e].box;
      for(std::size_t j = grid.position(1, box.lower[1]); j <= grid.position(1, box.upper[1]); ++j)
        for(std::size_t i = grid.position(0, box.lower[0]); i <= grid.position(0, box.upper[0]);
            ++i)
          cells[j * grid.size + i].push_back(e);
    }
    for(const std::vector<std::size_t>& cell : cells)
    {
      m_sorted.insert(m_sorted.end(), cell.begin(), cell.end());
      m_first_of_cell.push_back(m_sorted.size());
    }
  }

  // takes an entry whose least coordinate is larger than that of the best one
  static bool improve(const Entry& entry, double x, double y, Working_location& best,
                      double& best_minimum)
  {
    std::array<double, 3> b;
    for(int i = 0; i < 3; ++i)
    {
      const std::array<double, 3>& c = entry.coefficients[i];
      b[i] = c[0] + c[1] * x + c[2] * y;
    }
    const double minimum = (std::min)({b[0], b[1], b[2]});
    if(best.face >= 0 && minimum <= best_minimum)
      return false;
    best = Working_location{entry.face, b};
    best_minimum = minimum;
    return true;
  }

  static Working_location normalized(Working_location at)
  {
    for(double& x : at.barycentric)
      x = (std::max)(0., x);
    const double sum = at.barycentric[0] + at.barycentric[1] + at.barycentric[2];
    for(double& x : at.barycentric)
      x /= sum;
    return at;
  }

  std::vector<std::size_t> m_first; // per quad
  std::vector<Entry> m_entries;
  std::vector<Grid> m_grids;                // per quad
  std::vector<std::size_t> m_first_of_cell; // positions in `m_sorted`
  std::vector<std::size_t> m_sorted;        // entries, by cells
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_TRIANGLE_LOCATOR_H
