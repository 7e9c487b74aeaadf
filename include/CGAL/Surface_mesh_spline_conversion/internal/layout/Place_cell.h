// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_PLACE_CELL_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_PLACE_CELL_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Flat_triangles.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/harmonic_coordinates.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// how far a place is in the direction of side `i` of its quad
inline double along_side(const Quad_grid::Place& p, int i)
{
  i &= 3;
  return i == 0 ? p.u : i == 1 ? p.v : i == 2 ? 1 - p.u : 1 - p.v;
}

inline bool is_on_side(const Quad_grid::Place& p, int i)
{
  return i == 0 ? p.v == 0 : i == 1 ? p.u == 1 : i == 2 ? p.v == 1 : p.u == 0;
}

// the place at `t` along side `i` of a quad, and `d` inside
inline Quad_grid::Place place_near_side(int quad, int i, double t, double d)
{
  switch(i & 3)
  {
    case 0: return Quad_grid::Place{quad, t, d};
    case 1: return Quad_grid::Place{quad, 1 - d, t};
    case 2: return Quad_grid::Place{quad, 1 - t, 1 - d};
    default: return Quad_grid::Place{quad, d, 1 - t};
  }
}

inline Quad_grid::Place place_on_side(int quad, int i, double t)
{
  return place_near_side(quad, i, t, 0);
}

// A disk of parts of quads, which are divided into triangles, laid flat behind a convex boundary
// by a harmonic map. Gives the place in the quads for a point of the plane.
class Place_cell
{
public:
  typedef Quad_grid::Place Place;
  typedef std::function<Eigen::Vector3d(const Place&)> Locate; // the point of the surface

  // squares along half a side of a quad; a power of two, so that places are exact
  static constexpr int half = 4;

  // Adds the quarter at a corner of a quad.
  void add_quarter(const Quad_grid& quads, const Quad_grid::Side& corner, const Locate& locate)
  {
    const int i0 = corner.second == 1 || corner.second == 2 ? half : 0;
    const int j0 = corner.second >= 2 ? half : 0;
    const auto place = [&](int i, int j)
    { return Place{corner.first, (i0 + i) / (2. * half), (j0 + j) / (2. * half)}; };
    for(int j = 0; j < half; ++j)
      for(int i = 0; i < half; ++i)
      {
        add_triangle(quads, {{place(i, j), place(i + 1, j), place(i + 1, j + 1)}}, locate);
        add_triangle(quads, {{place(i, j), place(i + 1, j + 1), place(i, j + 1)}}, locate);
      }
  }

  // Adds the part at a corner of a quad that lines between the middles of adjacent sides divide
  // into three: those at two opposite corners, and that with the diagonal between the others.
  // `diagonal`: the first of its ends, which counts for both.
  void add_part(const Quad_grid& quads, const Quad_grid::Side& corner, int diagonal,
                const Locate& locate)
  {
    const int part = ((corner.second - diagonal) & 1) == 0 ? 0
                     : corner.second == diagonal + 1       ? 1 : -1;
    if(part == 0 && corner.second != diagonal)
      return;
    // with the diagonal from the first corner
    const auto place = [&](int i, int j)
    {
      const double x = i / (2. * half), y = j / (2. * half);
      return diagonal == 0 ? Place{corner.first, x, y} : Place{corner.first, 1 - y, x};
    };
    for(int j = 0; j < 2 * half; ++j)
      for(int i = 0; i < 2 * half; ++i)
      {
        const int below = i - j >= half ? 1 : j - i > half ? -1 : 0;
        const int above = i - j > half ? 1 : j - i >= half ? -1 : 0;
        if(below == part)
          add_triangle(quads, {{place(i, j), place(i + 1, j), place(i + 1, j + 1)}}, locate);
        if(above == part)
          add_triangle(quads, {{place(i, j), place(i + 1, j + 1), place(i, j + 1)}}, locate);
      }
  }

  // Fixes the point of a vertex on the boundary.
  void fix(const Quad_grid& quads, const Place& place, const Eigen::Vector2d& p)
  {
    m_fixed[m_number.at(key(quads, place))] = p;
  }

  // Sets the points inside. Returns `false` if not exactly those on the boundary have been fixed,
  // or flat triangles are inverted.
  bool lay_flat()
  {
    if(!complete_mesh())
      return false;
    std::vector<Eigen::Vector2d> points(m_mesh.points.size(), Eigen::Vector2d::Zero());
    for(const auto& entry : m_fixed)
      points[entry.first] = entry.second;
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(m_mesh.is_border_vertex(v) != (m_fixed.count(v) > 0))
        return false;
    const bool is_flat
      = is_embedded_with(points, [this](int h) { return corner_of_surface(h); })
        || is_embedded_with(points, [](int) { return equilateral_corner(); });
    if(is_flat)
      m_flat.prepare_location();
    m_mesh = Working_mesh();
    m_number.clear();
    m_fixed.clear();
    return is_flat;
  }

  Place operator()(const Eigen::Vector2d& p) const
  {
    const std::pair<int, Eigen::Vector3d> found = m_flat.locate(p);
    const Eigen::Vector3d b = found.second.cwiseMax(0.) / found.second.cwiseMax(0.).sum();
    const std::array<Place, 3>& corners = m_places[found.first];
    Place place{corners[0].quad, 0, 0};
    for(int i = 0; i < 3; ++i)
    {
      place.u += b[i] * corners[i].u;
      place.v += b[i] * corners[i].v;
    }
    place.u = (std::min)(place.u, 1.);
    place.v = (std::min)(place.v, 1.);
    return place;
  }

private:
  // the same for all quads with the place
  typedef std::tuple<int, double, double> Key;

  static Key key(const Quad_grid& quads, const Place& place)
  {
    const Place p = quads.representative(place);
    return Key(p.quad, p.u, p.v);
  }

  void add_triangle(const Quad_grid& quads, const std::array<Place, 3>& places,
                    const Locate& locate)
  {
    std::array<int, 3> triangle;
    for(int i = 0; i < 3; ++i)
    {
      const auto entry = m_number.emplace(key(quads, places[i]), m_mesh.number_of_vertices());
      triangle[i] = entry.first->second;
      if(entry.second)
        m_mesh.points.push_back(locate(places[i]));
    }
    m_mesh.triangles.push_back(triangle);
    m_places.push_back(places);
  }

  // Links the triangles; `false` if an edge has more than two.
  bool complete_mesh()
  {
    std::map<std::pair<int, int>, int> halfedge;
    m_mesh.is_corner.assign(m_mesh.points.size(), 0);
    m_mesh.opposite.assign(m_mesh.number_of_halfedges(), -1);
    m_mesh.vertex_halfedge.assign(m_mesh.points.size(), -1);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(!halfedge.emplace(std::make_pair(m_mesh.source(h), m_mesh.target(h)), h).second)
        return false;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
    {
      const auto found = halfedge.find(std::make_pair(m_mesh.target(h), m_mesh.source(h)));
      m_mesh.opposite[h] = found == halfedge.end() ? -1 : found->second;
      if(int& first = m_mesh.vertex_halfedge[m_mesh.source(h)]; first < 0 || m_mesh.is_border(h))
        first = h;
    }
    return true;
  }

  template <typename Corner_vectors>
  bool is_embedded_with(std::vector<Eigen::Vector2d> points, const Corner_vectors& corner)
  {
    if(!set_harmonic_coordinates(m_mesh, points, corner))
      return false;
    m_flat = Flat_triangles(m_mesh.triangles, std::move(points));
    return m_flat.is_embedded();
  }

  std::pair<Eigen::Vector3d, Eigen::Vector3d> corner_of_surface(int h) const
  {
    return std::make_pair(m_mesh.vector(h),
                          Eigen::Vector3d(-m_mesh.vector(Working_mesh::previous(h))));
  }

  static std::pair<Eigen::Vector2d, Eigen::Vector2d> equilateral_corner()
  {
    return std::make_pair(Eigen::Vector2d(1, 0), Eigen::Vector2d(0.5, std::sqrt(0.75)));
  }

  Flat_triangles m_flat;
  std::vector<std::array<Place, 3> > m_places; // per triangle, of its corners, in one quad
  // during construction only
  Working_mesh m_mesh;
  std::map<Key, int> m_number;
  std::map<int, Eigen::Vector2d> m_fixed;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_PLACE_CELL_H
