// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_HARMONIC_DISK_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_HARMONIC_DISK_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Work_budget.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/field/Face_geometry.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Flat_triangles.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Map_neighborhood.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/harmonic_coordinates.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A disk of faces of the working mesh, laid flat by a harmonic map to the unit disk, and a
// homeomorphism of it that leaves its boundary where it is.
class Harmonic_disk
{
public:
  // of the harmonic map: cotangents, or the same for all edges, whatever their lengths
  enum class Weights { GEOMETRIC, COMBINATORIAL };

  // The disk is the part of the neighborhood that is not farther away than `radius`, in quads. See
  // `is_valid()`; nothing moves yet.
  Harmonic_disk(const Map_neighborhood& neighborhood, double radius,
                Weights weights = Weights::GEOMETRIC, const Work_budget& budget = Work_budget())
    : m_weights(weights)
  {
    copy_faces(neighborhood);
    if(divide_long_edges(radius))
    {
      divide_at(radius);
      cut_off(radius);
      m_is_valid = find_boundary() && is_disk() && lay_surface_flat();
    }
    spend(neighborhood, budget);
    if(!m_is_valid)
      return;
    index_faces();
    m_source = m_target;
  }

  // Are the faces a disk, and are no flat faces inverted?
  bool is_valid() const { return m_is_valid; }

  // Lays the map flat with the same boundary. A point will move to the one with the same place: the
  // map continued by this motion is nearly conformal inside, with equal angles at singularities,
  // which also find their places on the surface. Where map and surface are similar, nothing moves.
  // Returns `false` if flat faces are inverted.
  bool follow_map()
  {
    std::vector<Eigen::Vector2d> points = boundary_circle();
    if(!set_harmonic_coordinates(m_mesh, points, [this](int h) { return map_corner(h); }))
      return false;
    m_source = Flat_triangles(m_mesh.triangles, std::move(points));
    return m_source.is_embedded();
  }

  // The share of the surface that loses nearly all of its area in the map by the motion: a part
  // that sticks out becomes small when it is laid flat.
  double squeezed_share() const
  {
    const double least_ratio = 1. / 64;
    double squeezed = 0, all = 0;
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      const double area = m_mesh.normal(f).norm();
      all += area;
      if(flat_area(m_target, f) < least_ratio * flat_area(m_source, f))
        squeezed += area;
    }
    return squeezed / all;
  }

  // The point with one place will move to another place, those between it and the boundary less.
  // Returns `false` if flat faces are inverted.
  bool shift(const Eigen::Vector2d& from, const Eigen::Vector2d& to)
  {
    m_source = m_target;
    std::vector<Eigen::Vector2d> points = m_source.points();
    const Eigen::Vector2d motion = (from - to) / (1 - to.norm());
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(!m_mesh.is_border_vertex(v))
        points[v] += (1 - points[v].norm()) * motion;
    m_target = Flat_triangles(m_mesh.triangles, std::move(points));
    if(!m_target.is_embedded())
      return false;
    m_target.prepare_location();
    return true;
  }

  // The point with one place will move to another place, straight lines from there to the boundary
  // to such lines. Nothing folds, however far apart these places are.
  void drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to) { m_drag = Drag{from, to}; }

  // where a point is laid flat before it moves; nothing if it does not lie in the disk
  std::optional<Eigen::Vector2d> place(const Working_location& at) const
  {
    const double rounding = 1e-12;
    const Eigen::Vector3d b(at.barycentric[0], at.barycentric[1], at.barycentric[2]);
    int best = -1;
    double best_minimum = -rounding;
    Eigen::Vector3d coordinates;
    const auto parts = m_parts.find(at.face);
    if(parts == m_parts.end())
      return std::nullopt;
    for(const int part : parts->second)
    {
      const Eigen::Vector3d c = m_in_part[part] * b;
      if(c.minCoeff() <= best_minimum)
        continue;
      best = part;
      best_minimum = c.minCoeff();
      coordinates = c;
      if(best_minimum >= 0)
        break;
    }
    if(best < 0)
      return std::nullopt;
    return m_source.point(best, coordinates);
  }

  // the point of the surface that a place belongs to after the motion
  Working_location at_place(const Eigen::Vector2d& p) const
  {
    const std::pair<int, Eigen::Vector3d> found = m_target.locate(p);
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for(int i = 0; i < 3; ++i)
      b += found.second[i] * m_corners[3 * found.first + i].barycentric;
    b = b.cwiseMax(0.);
    b /= b.sum();
    return Working_location{static_cast<int>(m_mesh.parent[found.first]), {{b[0], b[1], b[2]}}};
  }

  // the faces of the working mesh that meet the disk, sorted
  const std::vector<int>& faces() const { return m_faces; }

  // Does the interior of the disk meet that of another one?
  bool meets(const Harmonic_disk& other) const
  {
    return has_part_in(other) || other.has_part_in(*this);
  }

  Working_location operator()(const Working_location& at) const
  {
    const std::optional<Eigen::Vector2d> p = place(at);
    return p ? at_place(m_drag ? dragged(*p) : *p) : at;
  }

private:
  // a corner of a face of the refined disk
  struct Corner
  {
    Eigen::Vector3d barycentric;  // in the face of the working mesh
    Eigen::Vector2d position;     // in the map, with a center of the disk as origin, in quads
  };

  struct Drag
  {
    Eigen::Vector2d from, to;
  };

  // the triangle of `from` and a side of the boundary with the point becomes that of `to`
  Eigen::Vector2d dragged(const Eigen::Vector2d& p) const
  {
    double best_minimum = -1;
    Eigen::Vector2d result = p;
    for(const int h : m_boundary)
    {
      const Eigen::Vector2d& a = m_target.points()[m_mesh.source(h)];
      const Eigen::Vector2d& b = m_target.points()[m_mesh.target(h)];
      const double area = cross_product(a - m_drag->from, b - m_drag->from);
      const Eigen::Vector3d c(cross_product(a - p, b - p) / area,
                              cross_product(b - p, m_drag->from - p) / area,
                              cross_product(m_drag->from - p, a - p) / area);
      if(c.minCoeff() <= best_minimum)
        continue;
      best_minimum = c.minCoeff();
      result = c[0] * m_drag->to + c[1] * a + c[2] * b;
    }
    return result;
  }

  double flat_area(const Flat_triangles& triangles, int f) const
  {
    const std::array<int, 3>& t = m_mesh.triangles[f];
    const std::vector<Eigen::Vector2d>& points = triangles.points();
    return cross_product(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]) / 2;
  }

  // Does the middle of a face lie in another disk?
  bool has_part_in(const Harmonic_disk& other) const
  {
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      const auto parts = other.m_parts.find(static_cast<int>(m_mesh.parent[f]));
      if(parts == other.m_parts.end())
        continue;
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for(int i = 0; i < 3; ++i)
        middle += m_corners[3 * f + i].barycentric / 3;
      for(const int part : parts->second)
        if((other.m_in_part[part] * middle).minCoeff() > 0)
          return true;
    }
    return false;
  }

  // for a neighborhood and a disk
  void spend(const Map_neighborhood& neighborhood, const Work_budget& budget) const
  {
    const double work_per_face = 1.2, work_per_face_of_mesh = 1e-3;
    budget.spend(work_per_face * m_mesh.number_of_faces()
                 + work_per_face_of_mesh * neighborhood.map().mesh.number_of_faces());
  }

  void copy_faces(const Map_neighborhood& neighborhood)
  {
    const Seamless_map& map = neighborhood.map();
    std::unordered_map<int, int> number;
    for(const Map_neighborhood::Face& f : neighborhood.faces())
    {
      std::array<int, 3> t;
      for(int i = 0; i < 3; ++i)
      {
        const int v = map.mesh.triangles[f.face][i];
        const auto entry = number.emplace(v, m_mesh.number_of_vertices());
        t[i] = entry.first->second;
        if(entry.second)
          m_mesh.points.push_back(map.mesh.points[v]);
        m_corners.push_back(Corner{Eigen::Vector3d::Unit(i), f.positions[i]});
      }
      m_mesh.triangles.push_back(t);
      m_mesh.parent.push_back(static_cast<std::size_t>(f.face));
    }
    complete_mesh([&](int h) { return neighborhood.opposite(h); });
  }

  // Links the halfedges of the triangles. `opposite`: where the opposite of a halfedge is, or -1
  template <typename Opposite>
  void complete_mesh(const Opposite& opposite)
  {
    m_mesh.is_corner.assign(m_mesh.points.size(), 0);
    m_mesh.boundary_piece.assign(m_corners.size(), Working_mesh::Boundary_piece());
    m_mesh.opposite.resize(m_corners.size());
    m_mesh.vertex_halfedge.assign(m_mesh.points.size(), -1);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      m_mesh.opposite[h] = opposite(h);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(int& first = m_mesh.vertex_halfedge[m_mesh.source(h)]; first < 0 || m_mesh.is_border(h))
        first = h;
  }

  // Removes the faces that are not within the radius. The vertices that are left keep their order.
  void cut_off(double radius)
  {
    const Working_mesh mesh = std::move(m_mesh);
    const std::vector<Corner> corners = std::move(m_corners);
    m_mesh = Working_mesh();
    m_corners.clear();
    std::vector<int> number(mesh.points.size(), -1);
    std::vector<int> number_of_face(mesh.number_of_faces(), -1), old_face;
    for(int f = 0; f < mesh.number_of_faces(); ++f)
    {
      if(!is_within(&corners[3 * f], radius))
        continue;
      number_of_face[f] = m_mesh.number_of_faces();
      old_face.push_back(f);
      m_mesh.triangles.push_back(mesh.triangles[f]);
      m_mesh.parent.push_back(mesh.parent[f]);
      m_corners.insert(m_corners.end(), &corners[3 * f], &corners[3 * f] + 3);
      for(const int v : mesh.triangles[f])
        number[v] = 0;
    }
    for(std::size_t v = 0; v < number.size(); ++v)
      if(number[v] == 0)
      {
        number[v] = m_mesh.number_of_vertices();
        m_mesh.points.push_back(mesh.points[v]);
      }
    for(std::array<int, 3>& t : m_mesh.triangles)
      for(int& v : t)
        v = number[v];
    complete_mesh([&](int h)
    {
      const int o = mesh.opposite[3 * old_face[h / 3] + h % 3];
      return o < 0 || number_of_face[o / 3] < 0 ? -1 : 3 * number_of_face[o / 3] + o % 3;
    });
  }

  static bool is_within(const Corner* corners, double radius)
  {
    return std::all_of(corners, corners + 3, [&](const Corner& c)
      { return c.position.norm() < (1 + snapping) * radius; });
  }

  // Lists the halfedges of the boundary; `false` if it is not one loop without repeated vertices.
  bool find_boundary()
  {
    std::vector<int> next(m_mesh.number_of_vertices(), -1); // per vertex
    int first = -1;
    std::size_t borders = 0;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.is_border(h))
      {
        if(next[m_mesh.source(h)] >= 0)
          return false;
        next[m_mesh.source(h)] = h;
        first = h;
        ++borders;
      }
    if(first < 0)
      return false;
    m_boundary.clear();
    int h = first;
    do
    {
      m_boundary.push_back(h);
      h = next[m_mesh.target(h)];
    }
    while(h != first);
    return m_boundary.size() == borders;
  }

  // Tells a disk from other surfaces with one boundary loop.
  bool is_disk() const
  {
    const int edges
      = (m_mesh.number_of_halfedges() + static_cast<int>(m_boundary.size())) / 2;
    return m_mesh.number_of_vertices() - edges + m_mesh.number_of_faces() == 1;
  }

  // Splits the edge of a halfedge at the share `t` of its length.
  void split_edge(int h, double t = 0.5)
  {
    const int o = m_mesh.opposite[h];
    const Eigen::Vector3d point
      = (1 - t) * m_mesh.points[m_mesh.source(h)] + t * m_mesh.points[m_mesh.target(h)];
    m_mesh.points[m_mesh.split_edge(h)] = point;
    inherit_split(h, t);
    if(o >= 0)
      inherit_split(o, 1 - t);
  }

  void inherit_split(int h, double t)
  {
    const std::size_t f = 3 * static_cast<std::size_t>(h / 3), i = h % 3, j = (i + 1) % 3;
    const Corner a = m_corners[f + i], b = m_corners[f + j];
    const Corner between{(1 - t) * a.barycentric + t * b.barycentric,
                         (1 - t) * a.position + t * b.position};
    for(std::size_t k = 0; k < 3; ++k)
      m_corners.push_back(k == i ? between : Corner(m_corners[f + k]));
    m_corners[f + j] = between;
  }

  // The disk gets enough vertices inside and on its boundary. Returns `false` if that takes too
  // many faces: where three corners lie on a line in the map, the division may not end.
  bool divide_long_edges(double radius)
  {
    const double edges_per_radius = 5, reduction = 0.7;
    const int most_faces = 2 * m_mesh.number_of_faces() + 20000;
    double longest = 0;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(map_distance(h) < radius)
        longest = (std::max)(longest, map_length(h));
    while(longest > radius / edges_per_radius)
    {
      longest = (std::max)(reduction * longest, radius / edges_per_radius);
      for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
        if(map_length(h) > longest && map_distance(h) < radius)
        {
          if(m_mesh.number_of_faces() > most_faces)
            return false;
          split_edge(h);
        }
    }
    return true;
  }

  // of the edge from the center
  double map_distance(int h) const
  {
    return Map_neighborhood::distance_to_segment(m_corners[h].position,
                                                 m_corners[Working_mesh::next(h)].position);
  }

  // Puts vertices where edges leave the disk.
  void divide_at(double radius)
  {
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
    {
      const Eigen::Vector2d a = m_corners[h].position;
      const Eigen::Vector2d e = m_corners[Working_mesh::next(h)].position - a;
      if(a.norm() > (1 - snapping) * radius || (a + e).norm() < (1 + snapping) * radius)
        continue;
      // |a + t e| = radius
      const double p = a.dot(e) / e.squaredNorm();
      const double q = (a.squaredNorm() - radius * radius) / e.squaredNorm();
      split_edge(h, std::sqrt(p * p - q) - p);
    }
  }

  double map_length(int h) const
  {
    return (m_corners[Working_mesh::next(h)].position - m_corners[h].position).norm();
  }

  // The boundary on a circle, with arc lengths in proportion to those in the map.
  std::vector<Eigen::Vector2d> boundary_circle() const
  {
    double length = 0, sum = 0;
    for(const int h : m_boundary)
      length += map_length(h);
    std::vector<Eigen::Vector2d> points(m_mesh.number_of_vertices(), Eigen::Vector2d::Zero());
    for(const int h : m_boundary)
    {
      const double angle = 2 * pi * sum / length;
      points[m_mesh.source(h)] = Eigen::Vector2d(std::cos(angle), std::sin(angle));
      sum += map_length(h);
    }
    return points;
  }

  bool lay_surface_flat()
  {
    std::vector<Eigen::Vector2d> points = boundary_circle();
    const bool is_laid = m_weights == Weights::GEOMETRIC
      ? set_harmonic_coordinates(m_mesh, points, [this](int h) { return surface_corner(h); })
      : set_harmonic_coordinates(m_mesh, points, [](int) { return equilateral_corner(); });
    if(!is_laid)
      return false;
    m_target = Flat_triangles(m_mesh.triangles, std::move(points));
    return m_target.is_embedded();
  }

  std::pair<Eigen::Vector3d, Eigen::Vector3d> surface_corner(int h) const
  {
    return std::make_pair(m_mesh.vector(h),
                          Eigen::Vector3d(-m_mesh.vector(Working_mesh::previous(h))));
  }

  static std::pair<Eigen::Vector2d, Eigen::Vector2d> equilateral_corner()
  {
    return std::make_pair(Eigen::Vector2d(1, 0), Eigen::Vector2d(0.5, std::sqrt(0.75)));
  }

  std::pair<Eigen::Vector2d, Eigen::Vector2d> map_corner(int h) const
  {
    const Eigen::Vector2d& p = m_corners[h].position;
    return std::make_pair(Eigen::Vector2d(m_corners[Working_mesh::next(h)].position - p),
                          Eigen::Vector2d(m_corners[Working_mesh::previous(h)].position - p));
  }

  void index_faces()
  {
    for(const std::size_t f : m_mesh.parent)
      m_faces.push_back(static_cast<int>(f));
    std::sort(m_faces.begin(), m_faces.end());
    m_faces.erase(std::unique(m_faces.begin(), m_faces.end()), m_faces.end());
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      m_parts[static_cast<int>(m_mesh.parent[f])].push_back(f);
      Eigen::Matrix3d corners;
      for(int i = 0; i < 3; ++i)
        corners.col(i) = m_corners[3 * f + i].barycentric;
      m_in_part.push_back(corners.inverse());
    }
    m_target.prepare_location();
  }

  // where vertices count as lying on the boundary of the disk, relative to the radius
  static constexpr double snapping = 1e-3;

  Weights m_weights;
  std::optional<Drag> m_drag;
  bool m_is_valid = false;
  std::vector<int> m_faces;
  Working_mesh m_mesh;                         // the refined disk; parents are faces of the working
                                               // mesh
  std::vector<Corner> m_corners;               // per corner of the refined disk
  std::vector<int> m_boundary;                 // halfedges
  Flat_triangles m_source, m_target;           // before and after the motion
  std::unordered_map<int, std::vector<int> > m_parts; // by face of the working mesh: faces of the
                                                      // disk
  std::vector<Eigen::Matrix3d> m_in_part;      // from barycentric coordinates in the working mesh
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_HARMONIC_DISK_H
