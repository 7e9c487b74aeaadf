// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CONE_DISK_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CONE_DISK_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Sparse_solver.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/field/Face_geometry.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Cone_neighborhood.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A homeomorphism of a disk of faces around a singularity that leaves the boundary of the disk
// where it is. Both the map and the surface are laid flat, with the same boundary: the map by the
// power of the complex plane that gives the singularity a full turn, the surface by a harmonic map.
// A point moves to the one with the same place. The map continued by this motion has equal angles
// at the singularity, which also finds its place on the surface.
class Cone_disk
{
public:
  // The disk has about the given radius, in quads, and lies in the neighborhood. See `is_valid()`.
  Cone_disk(const Seamless_map& map, const Cone_neighborhood& neighborhood, double radius)
    : m_power(4. / map.cone[neighborhood.cone()])
  {
    copy_faces(map, neighborhood);
    divide_large_angles();
    divide_long_edges(radius);
    divide_at_circle(radius);
    cut_off(radius);
    m_is_valid = is_disk() && has_no_other_cone() && lay_map_flat() && lay_surface_flat();
    if(m_is_valid)
      index_faces();
  }

  // Are the faces a disk, and are no flat faces inverted?
  bool is_valid() const { return m_is_valid; }

  // the faces of the working mesh that meet the disk, sorted
  const std::vector<int>& faces() const { return m_faces; }

  // Does the interior of the disk meet that of another one?
  bool meets(const Cone_disk& other) const
  {
    return has_part_in(other) || other.has_part_in(*this);
  }

  // \pre `at.face` is one of the faces
  Working_location operator()(const Working_location& at) const
  {
    const double rounding = 1e-12;
    const Eigen::Vector3d b(at.barycentric[0], at.barycentric[1], at.barycentric[2]);
    int best = -1;
    double best_minimum = -rounding;
    Eigen::Vector3d coordinates;
    for(const int part : m_parts.at(at.face))
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
    return best < 0 ? at : on_surface(flat_point(m_map_points, best, coordinates));
  }

private:
  // a corner of a face of the refined disk
  struct Corner
  {
    Eigen::Vector3d barycentric;  // in the face of the working mesh
    Eigen::Vector2d position;     // in the parameter plane, with the singularity at the origin
  };

  static constexpr int center = 0; // the vertex at the singularity

  // Does the middle of a face lie in another disk?
  bool has_part_in(const Cone_disk& other) const
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

  void copy_faces(const Seamless_map& map, const Cone_neighborhood& neighborhood)
  {
    std::vector<int> original(1, neighborhood.cone()); // per vertex: in the working mesh
    std::unordered_map<int, int> number;
    number.emplace(neighborhood.cone(), center);
    for(const Cone_neighborhood::Face& f : neighborhood.faces())
    {
      std::array<int, 3> t;
      for(int i = 0; i < 3; ++i)
      {
        const int v = map.mesh.triangles[f.face][i];
        const auto entry = number.emplace(v, static_cast<int>(number.size()));
        if(entry.second)
          original.push_back(v);
        t[i] = entry.first->second;
        m_corners.push_back(Corner{Eigen::Vector3d::Unit(i), f.positions[i]});
      }
      m_mesh.triangles.push_back(t);
      m_mesh.parent.push_back(static_cast<std::size_t>(f.face));
    }
    for(const int v : original)
    {
      m_mesh.points.push_back(map.mesh.points[v]);
      m_is_regular.push_back(!map.mesh.is_border_vertex(v) && map.cone[v] == 4);
    }
    complete_mesh();
  }

  // Links the halfedges of the triangles.
  void complete_mesh()
  {
    m_mesh.is_corner.assign(m_mesh.points.size(), 0);
    m_mesh.boundary_piece.assign(m_corners.size(), Working_mesh::Boundary_piece());
    m_mesh.opposite.assign(m_corners.size(), -1);
    m_mesh.vertex_halfedge.assign(m_mesh.points.size(), -1);
    std::map<std::pair<int, int>, int> halfedge;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      halfedge.emplace(std::make_pair(m_mesh.source(h), m_mesh.target(h)), h);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
    {
      const auto opposite = halfedge.find({m_mesh.target(h), m_mesh.source(h)});
      if(opposite != halfedge.end())
        m_mesh.opposite[h] = opposite->second;
      if(int& first = m_mesh.vertex_halfedge[m_mesh.source(h)];
         first < 0 || opposite == halfedge.end())
        first = h;
    }
  }

  // Removes the faces that are not within the radius. The vertices that are left keep their order.
  void cut_off(double radius)
  {
    const Working_mesh mesh = std::move(m_mesh);
    const std::vector<Corner> corners = std::move(m_corners);
    const std::vector<char> is_regular = std::move(m_is_regular);
    m_mesh = Working_mesh();
    m_corners.clear();
    m_is_regular.clear();
    std::vector<int> number(mesh.points.size(), -1);
    for(int f = 0; f < mesh.number_of_faces(); ++f)
    {
      if(!is_within(&corners[3 * f], radius))
        continue;
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
        m_is_regular.push_back(is_regular[v]);
      }
    for(std::array<int, 3>& t : m_mesh.triangles)
      for(int& v : t)
        v = number[v];
    complete_mesh();
  }

  static bool is_within(const Corner* corners, double radius)
  {
    const double rounding = 1e-3;
    return std::all_of(corners, corners + 3, [&](const Corner& c)
      { return c.position.norm() < (1 + rounding) * radius; });
  }

  // one boundary loop without repeated vertices, and the Euler characteristic of a disk
  bool is_disk() const
  {
    std::vector<int> outgoing_borders(m_mesh.number_of_vertices(), 0);
    int borders = 0;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.is_border(h))
      {
        ++borders;
        if(++outgoing_borders[m_mesh.source(h)] > 1)
          return false;
      }
    const int edges = (m_mesh.number_of_halfedges() + borders) / 2;
    return borders > 0 && m_mesh.number_of_vertices() - edges + m_mesh.number_of_faces() == 1;
  }

  // The vertices inside are regular but for the singularity.
  bool has_no_other_cone() const
  {
    if(m_is_regular[center] || m_mesh.is_border_vertex(center))
      return false;
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(v != center && !m_is_regular[v] && !m_mesh.is_border_vertex(v))
        return false;
    return true;
  }

  static double signed_angle(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
  {
    return std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
  }

  // of the map, at the corner
  double corner_angle(int h) const
  {
    const Eigen::Vector2d& p = m_corners[h].position;
    return signed_angle(m_corners[Working_mesh::next(h)].position - p,
                        m_corners[Working_mesh::previous(h)].position - p);
  }

  // Splits the edge of a halfedge at the share `t` of its length.
  void split_edge(int h, double t = 0.5)
  {
    const int o = m_mesh.opposite[h];
    const Eigen::Vector3d point
      = (1 - t) * m_mesh.points[m_mesh.source(h)] + t * m_mesh.points[m_mesh.target(h)];
    m_mesh.points[m_mesh.split_edge(h)] = point;
    m_is_regular.push_back(1);
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

  // The angles at the singularity are not to reach a straight angle when it gets a full turn.
  void divide_large_angles()
  {
    const int most_rounds = 4;
    const double largest_angle = 0.25 * pi / m_power;
    for(int round = 0; round < most_rounds; ++round)
    {
      std::vector<int> large;
      m_mesh.for_each_outgoing(center, [&](int h)
        { if(corner_angle(h) > largest_angle) large.push_back(h); });
      for(const int h : large)
        split_edge(Working_mesh::next(h));
    }
  }

  // The disk gets enough vertices inside and on its boundary.
  void divide_long_edges(double radius)
  {
    const double edges_per_radius = 5, reduction = 0.7;
    double longest = 0;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(map_distance(h) < radius)
        longest = (std::max)(longest, map_length(h));
    while(longest > radius / edges_per_radius)
    {
      longest = (std::max)(reduction * longest, radius / edges_per_radius);
      for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
        if(map_length(h) > longest && map_distance(h) < radius)
          split_edge(h);
    }
  }

  // of the edge from the singularity
  double map_distance(int h) const
  {
    return Cone_neighborhood::distance_to_segment(m_corners[h].position,
                                                  m_corners[Working_mesh::next(h)].position);
  }

  // Puts vertices where edges leave the disk: its boundary becomes convex.
  void divide_at_circle(double radius)
  {
    const double rounding = 1e-3;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
    {
      const Eigen::Vector2d a = m_corners[h].position;
      const Eigen::Vector2d e = m_corners[Working_mesh::next(h)].position - a;
      if(a.norm() > (1 - rounding) * radius || (a + e).norm() < (1 + rounding) * radius)
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

  // Polar coordinates of the map, with the singularity turned to a full turn.
  bool lay_map_flat()
  {
    m_map_points.assign(m_mesh.number_of_vertices(), Eigen::Vector2d::Zero());
    std::vector<char> is_placed(m_mesh.number_of_vertices(), 0);
    std::vector<char> is_reached(m_mesh.number_of_faces(), 0);
    std::vector<double> angle(m_mesh.number_of_vertices(), 0);
    std::vector<int> queue;
    const auto place = [&](int h, double at)
    {
      const int v = m_mesh.source(h);
      is_placed[v] = 1;
      angle[v] = at;
      const double r = std::pow(m_corners[h].position.norm(), m_power);
      m_map_points[v] = Eigen::Vector2d(r * std::cos(m_power * at), r * std::sin(m_power * at));
    };
    is_placed[center] = 1;
    double turn = 0;
    m_mesh.for_each_outgoing(center, [&](int h)
    {
      place(Working_mesh::next(h), turn);
      turn += corner_angle(h);
      is_reached[h / 3] = 1;
      queue.push_back(Working_mesh::next(h));
    });
    // halfedges between placed vertices: what lies beyond follows
    for(std::size_t i = 0; i < queue.size(); ++i)
    {
      const int o = m_mesh.opposite[queue[i]];
      if(o < 0 || is_reached[o / 3])
        continue;
      is_reached[o / 3] = 1;
      const int apex = Working_mesh::previous(o);
      if(!is_placed[m_mesh.source(apex)])
        place(apex, angle[m_mesh.source(o)]
                      + signed_angle(m_corners[o].position, m_corners[apex].position));
      queue.push_back(apex);
      queue.push_back(Working_mesh::next(o));
    }
    return is_embedded(m_map_points);
  }

  bool is_embedded(const std::vector<Eigen::Vector2d>& points) const
  {
    const double smallest_share = 1e-7; // of the mean area
    std::vector<double> areas;
    double sum = 0;
    for(const std::array<int, 3>& t : m_mesh.triangles)
    {
      const Eigen::Vector2d a = points[t[1]] - points[t[0]], b = points[t[2]] - points[t[0]];
      areas.push_back(a[0] * b[1] - a[1] * b[0]);
      sum += areas.back();
    }
    return *std::min_element(areas.begin(), areas.end())
           > smallest_share * sum / static_cast<double>(areas.size());
  }

  // Harmonic coordinates on the surface with the boundary of the map.
  bool lay_surface_flat()
  {
    m_surface_points = m_map_points;
    std::vector<int> unknown(m_mesh.number_of_vertices(), -1);
    int n = 0;
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(!m_mesh.is_border_vertex(v))
        unknown[v] = n++;
    std::vector<Eigen::Triplet<double> > entries;
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n);
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n, 2);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
    {
      const double weight = (std::max)(smallest_cotangent, cotangent(Working_mesh::previous(h)));
      const int v = m_mesh.source(h), w = m_mesh.target(h);
      for(const std::pair<int, int>& e : {std::make_pair(v, w), std::make_pair(w, v)})
        if(const int i = unknown[e.first]; i >= 0)
        {
          diagonal[i] += weight;
          if(unknown[e.second] < 0)
            right.row(i) += weight * m_map_points[e.second].transpose();
        }
      if(unknown[v] >= 0 && unknown[w] >= 0)
        entries.emplace_back((std::max)(unknown[v], unknown[w]),
                             (std::min)(unknown[v], unknown[w]), -weight);
    }
    for(int i = 0; i < n; ++i)
      entries.emplace_back(i, i, diagonal[i]);
    Sparse_solver::Matrix matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Sparse_solver solver;
    solver.analyze(matrix);
    if(!solver.factorize(matrix))
      return false;
    const Eigen::VectorXd x = solver.solve(right.col(0)), y = solver.solve(right.col(1));
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(unknown[v] >= 0)
        m_surface_points[v] = Eigen::Vector2d(x[unknown[v]], y[unknown[v]]);
    return is_embedded(m_surface_points);
  }

  static constexpr double smallest_cotangent = 0.05; // positive: no fold behind a convex boundary

  // of the surface, at the corner
  double cotangent(int h) const
  {
    const Eigen::Vector3d a = m_mesh.vector(h), b = -m_mesh.vector(Working_mesh::previous(h));
    return a.dot(b) / a.cross(b).norm();
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
      Eigen::Matrix3d corners, flat;
      for(int i = 0; i < 3; ++i)
      {
        corners.col(i) = m_corners[3 * f + i].barycentric;
        flat.col(i) << 1, m_surface_points[m_mesh.triangles[f][i]];
      }
      m_in_part.push_back(corners.inverse());
      m_in_flat_face.push_back(flat.inverse());
    }
  }

  Eigen::Vector2d flat_point(const std::vector<Eigen::Vector2d>& points, int f,
                             const Eigen::Vector3d& barycentric) const
  {
    const std::array<int, 3>& t = m_mesh.triangles[f];
    return barycentric[0] * points[t[0]] + barycentric[1] * points[t[1]]
           + barycentric[2] * points[t[2]];
  }

  // the point of the surface that lies at a place of the plane, or, within rounding, nearest to it
  Working_location on_surface(const Eigen::Vector2d& p) const
  {
    const Eigen::Vector3d homogeneous(1, p[0], p[1]);
    int best = -1;
    double best_minimum = 0;
    Eigen::Vector3d coordinates;
    for(int f = 0; f < m_mesh.number_of_faces(); ++f)
    {
      const Eigen::Vector3d c = m_in_flat_face[f] * homogeneous;
      if(best >= 0 && c.minCoeff() <= best_minimum)
        continue;
      best = f;
      best_minimum = c.minCoeff();
      coordinates = c;
      if(best_minimum >= 0)
        break;
    }
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for(int i = 0; i < 3; ++i)
      b += coordinates[i] * m_corners[3 * best + i].barycentric;
    b = b.cwiseMax(0.);
    b /= b.sum();
    return Working_location{static_cast<int>(m_mesh.parent[best]), {{b[0], b[1], b[2]}}};
  }

  double m_power;                              // of the complex plane, that flattens the cone
  bool m_is_valid = false;
  std::vector<int> m_faces;
  std::vector<char> m_is_regular;              // per vertex of the refined disk: no singularity of
                                               // the map, and not on its boundary
  Working_mesh m_mesh;                         // the refined disk; parents are faces of the working
                                               // mesh
  std::vector<Corner> m_corners;               // per corner of the refined disk
  std::vector<Eigen::Vector2d> m_map_points;     // per vertex of the refined disk
  std::vector<Eigen::Vector2d> m_surface_points;
  std::unordered_map<int, std::vector<int> > m_parts; // by face of the working mesh: faces of the
                                                      // disk
  std::vector<Eigen::Matrix3d> m_in_part;      // from barycentric coordinates in the working mesh
  std::vector<Eigen::Matrix3d> m_in_flat_face; // from homogeneous coordinates
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CONE_DISK_H
