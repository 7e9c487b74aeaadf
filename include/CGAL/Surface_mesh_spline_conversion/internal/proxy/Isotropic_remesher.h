// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_ISOTROPIC_REMESHER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_ISOTROPIC_REMESHER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Boundary_chains.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Mesh_editor.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Surface_walk.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The normals of the vertices, of length one, as means over the faces around, smoothed a few times
// against noise.
inline std::vector<Eigen::Vector3d> smoothed_normals(const Working_mesh& mesh, int rounds)
{
  const int n = mesh.number_of_vertices();
  std::vector<Eigen::Vector3d> normal(n, Eigen::Vector3d::Zero()), sum;
  for(int f = 0; f < mesh.number_of_faces(); ++f)
  {
    const Eigen::Vector3d m = mesh.normal(f);
    for(const int v : mesh.triangles[f])
      normal[v] += m;
  }
  const auto normalize = [&normal]()
  {
    for(Eigen::Vector3d& m : normal)
      m.normalize();
  };
  normalize();
  for(int round = 0; round < rounds; ++round)
  {
    sum = normal;
    for(int h = 0; h < mesh.number_of_halfedges(); ++h)
      sum[mesh.source(h)] += normal[mesh.target(h)];
    normal.swap(sum);
    normalize();
  }
  return normal;
}

// height over longest edge, relative to that of an equilateral triangle; negative if the triangle
// is turned over against `normal`
inline double triangle_shape(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c, const Eigen::Vector3d& normal)
{
  const double longest = (std::max)({(b - a).squaredNorm(), (c - b).squaredNorm(),
                                     (a - c).squaredNorm()});
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const double shape = 2 / std::sqrt(3.) * n.norm() / longest;
  return n.dot(normal) < 0 ? -shape : shape;
}

// Remeshes a surface with triangles of a given size, nearly equilateral, by collapses, splits and
// flips of edges and by moving vertices along the surface (Botsch and Kobbelt 2004). Vertices stay
// on the original surface, those of the boundary on its boundary. An edge that is too short remains
// if its collapse would turn normals too far or flatten the surface: thin parts stay fine.
class Isotropic_remesher
{
public:
  // `length`: per vertex of `original` the wanted edge length; `is_kept`: the vertices that must
  // remain, among them the first of each chain
  Isotropic_remesher(const Working_mesh& original, const std::vector<double>& length,
                     const std::vector<char>& is_kept)
    : m_original(original), m_original_length(length), m_walk(original), m_boundary(original),
      m_mesh(original), m_editor(m_mesh, is_kept), m_length(length),
      m_original_normal(smoothed_normals(original, rounds_of_smoothing))
  {
    m_normal = m_original_normal;
    m_is_crease.assign(original.number_of_vertices(), 0);
    for(int f = 0; f < original.number_of_faces(); ++f)
    {
      const Eigen::Vector3d n = original.normal(f).normalized();
      for(const int v : original.triangles[f])
        if(n.dot(m_normal[v]) < cosine_at_crease)
          m_is_crease[v] = 1;
    }
    for(int v = 0; v < original.number_of_vertices(); ++v)
      m_place.push_back(at_vertex(original, v));
  }

  // The first call makes the mesh coarse. Further ones follow changes of `length`, nearly local,
  // where it has become smaller.
  void run()
  {
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      update(v);
    collapse_to_length();
    for(int i = 0; i < number_of_iterations; ++i)
    {
      split_edges(longest);
      collapse_short_edges(shortest);
      flip_edges();
      move_vertices();
      compact();
    }
    flip_edges();
    split_edges(std::numeric_limits<double>::infinity());
    compact();
  }

  const Working_mesh& mesh() const { return m_mesh; }
  const std::vector<Working_location>& places() const { return m_place; }

private:
  static constexpr int rounds_of_smoothing = 3, number_of_iterations = 3;
  // bounds of edges relative to the wanted length
  static constexpr double shortest = 0.8, longest = 4. / 3;
  // between the normal of a face and those at its vertices, and before and after a change
  static constexpr double largest_turn = 0.5, cosine_at_crease = 0.75;
  // between an edge and the tangent planes at its ends: 0.45 are 7 edges around a cylinder
  static constexpr double steepest_edge = 0.45;
  // between neighbouring boundary edges before and after a collapse
  static constexpr double largest_boundary_turn = 0.94;
  static constexpr double least_shape = 0.25;

  static Working_location at_vertex(const Working_mesh& mesh, int v)
  {
    const int h = mesh.vertex_halfedge[v];
    Working_location place{h / 3, {{0, 0, 0}}};
    place.barycentric[h % 3] = 1;
    return place;
  }

  double length_of(int h) const
  {
    return (std::min)(m_length[m_mesh.source(h)], m_length[m_mesh.target(h)]);
  }

  double relative_length(int h) const { return m_mesh.vector(h).norm() / length_of(h); }

  bool is_first_halfedge(int h) const
  {
    return m_editor.is_face(h / 3) && m_mesh.opposite[h] < h;
  }

  // The shortest edges first, in steps, such that triangles stay of similar size.
  void collapse_to_length()
  {
    const int most_steps = 6;
    double smallest = shortest;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      smallest = (std::min)(smallest, relative_length(h));
    const int steps
      = (std::min)(most_steps, static_cast<int>(std::log2(shortest / smallest)) + 1);
    for(int i = steps; i >= 0; --i)
    {
      collapse_short_edges(std::ldexp(shortest, -i));
      compact();
    }
  }

  void collapse_short_edges(double limit)
  {
    std::vector<std::pair<double, int> > edges;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(is_first_halfedge(h))
        if(const double length = relative_length(h); length < limit)
          edges.emplace_back(length, h);
    std::sort(edges.begin(), edges.end());
    for(const std::pair<double, int>& edge : edges)
      if(m_editor.is_face(edge.second / 3) && relative_length(edge.second) < limit)
        try_to_collapse(edge.second);
  }

  // removes the end whose removal gives the better triangles
  void try_to_collapse(int h)
  {
    const int a = m_mesh.source(h), b = m_mesh.target(h);
    const double score_a = collapse_score(h, a, b), score_b = collapse_score(h, b, a);
    if(score_a > 0 && score_a >= score_b)
      m_editor.collapse(h, a);
    else if(score_b > 0)
      m_editor.collapse(h, b);
  }

  // the worst shape of the changed triangles, or -1 if the collapse is not allowed
  double collapse_score(int h, int removed, int remaining) const
  {
    if(!m_editor.can_collapse(h, removed) || !keeps_boundary(h, removed, remaining))
      return -1;
    const double wanted = (std::min)(m_length[removed], m_length[remaining]);
    const Eigen::Vector3d& p = m_mesh.points[remaining];
    double worst = 1, worst_before = 1, offset = longest * wanted;
    bool is_allowed = true;
    m_mesh.for_each_outgoing(removed, [&](int g)
    {
      const int x = m_mesh.target(g), y = m_mesh.source(Working_mesh::previous(g));
      const Eigen::Vector3d &a = m_mesh.points[removed], &c = m_mesh.points[x],
                            &d = m_mesh.points[y];
      const Eigen::Vector3d old_normal = (c - a).cross(d - a);
      const double old_shape = triangle_shape(a, c, d, old_normal);
      worst_before = (std::min)(worst_before, old_shape);
      if(!is_allowed || x == remaining || y == remaining)
        return;
      const Eigen::Vector3d normal = (c - p).cross(d - p).normalized();
      const double sliver = 0.05;
      is_allowed = fits(normal, remaining) && fits(normal, x) && fits(normal, y)
                   && (old_shape < sliver
                       || normal.dot(old_normal) >= largest_turn * old_normal.norm())
                   && is_edge_allowed(remaining, x, wanted)
                   && is_edge_allowed(remaining, y, wanted);
      worst = (std::min)(worst, triangle_shape(p, c, d, normal));
      offset = (std::min)(offset, std::abs(normal.dot(a - p)));
    });
    // the removed point has to lie near one of the new triangles
    const double largest_offset = 0.15;
    if(!is_allowed || worst < (std::min)(least_shape, worst_before)
       || offset > largest_offset * wanted)
      return -1;
    return worst;
  }

  // is the normal of a face near that of the surface at `v`?
  bool fits(const Eigen::Vector3d& normal, int v) const
  {
    const double largest_turn_at_crease = 0.1;
    return normal.dot(m_normal[v]) >= (m_is_crease[v] ? largest_turn_at_crease : largest_turn);
  }

  bool is_edge_allowed(int v, int w, double wanted) const
  {
    const Eigen::Vector3d e = m_mesh.points[w] - m_mesh.points[v];
    const double length = e.norm();
    return length <= longest * wanted
           && (m_is_crease[v] || std::abs(e.dot(m_normal[v])) <= steepest_edge * length)
           && (m_is_crease[w] || std::abs(e.dot(m_normal[w])) <= steepest_edge * length);
  }

  // Collapses along the boundary must not cut off its bends.
  bool keeps_boundary(int h, int removed, int remaining) const
  {
    if(!m_mesh.is_border(h))
      return true;
    const int g = m_mesh.source(h) == removed ? incoming_border(removed)
                                              : m_mesh.vertex_halfedge[removed];
    const int x = m_mesh.source(g) == removed ? m_mesh.target(g) : m_mesh.source(g);
    const Eigen::Vector3d a = (m_mesh.points[removed] - m_mesh.points[x]).normalized(),
                          b = (m_mesh.points[remaining] - m_mesh.points[removed]).normalized();
    return a.dot(b) >= largest_boundary_turn;
  }

  int incoming_border(int v) const
  {
    int last = -1;
    m_mesh.for_each_outgoing(v, [&last](int g) { last = g; });
    return Working_mesh::previous(last);
  }

  // Splits edges longer than `limit`, and inner edges between two boundary vertices.
  void split_edges(double limit)
  {
    std::vector<std::pair<double, std::pair<int, int> > > edges;
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(is_first_halfedge(h))
      {
        const int a = m_mesh.source(h), b = m_mesh.target(h);
        const bool is_ear_edge = !m_mesh.is_border(h) && m_mesh.is_border_vertex(a)
                                 && m_mesh.is_border_vertex(b);
        if(const double length = relative_length(h); length > limit || is_ear_edge)
          edges.emplace_back(-length, std::make_pair(a, b));
      }
    std::sort(edges.begin(), edges.end());
    for(const auto& edge : edges)
      split(m_mesh.find_halfedge(edge.second.first, edge.second.second));
  }

  void split(int h)
  {
    const int a = m_mesh.source(h), b = m_mesh.target(h);
    const Eigen::Vector3d normal = (m_normal[a] + m_normal[b]).normalized();
    const bool is_border = m_mesh.is_border(h);
    const double middle
      = (m_mesh.boundary_piece[h].first + m_mesh.boundary_piece[h].last) / 2;
    const std::size_t chain = m_mesh.boundary_piece[h].chain;
    const int v = m_editor.split(h);
    m_place.push_back(is_border ? m_boundary(chain, middle)
                                : m_walk.project(m_mesh.points[v], normal, m_place[a].face));
    m_length.push_back(0);
    m_normal.push_back(normal);
    m_is_crease.push_back(0);
    update(v);
  }

  // sets what belongs to a vertex from its place on the original
  void update(int v)
  {
    const Working_location& place = m_place[v];
    m_mesh.points[v] = m_walk.point(place);
    m_length[v] = 0;
    m_normal[v].setZero();
    for(int i = 0; i < 3; ++i)
    {
      const int w = m_original.triangles[place.face][i];
      m_length[v] += place.barycentric[i] * m_original_length[w];
      m_normal[v] += place.barycentric[i] * m_original_normal[w];
    }
    m_normal[v].normalize();
  }

  // Flips edges where this improves the worse of two triangles.
  void flip_edges()
  {
    const int most_sweeps = 5;
    bool has_flipped = true;
    for(int sweep = 0; sweep < most_sweeps && has_flipped; ++sweep)
    {
      has_flipped = false;
      for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
        if(is_first_halfedge(h) && is_flip_wanted(h) && m_editor.can_flip(h))
        {
          m_editor.flip(h);
          has_flipped = true;
        }
    }
  }

  bool is_flip_wanted(int h) const
  {
    if(m_mesh.is_border(h))
      return false;
    const int a = m_mesh.source(h), b = m_mesh.target(h);
    const int c = m_mesh.target(Working_mesh::next(h));
    const int d = m_mesh.target(Working_mesh::next(m_mesh.opposite[h]));
    const Eigen::Vector3d &p = m_mesh.points[a], &q = m_mesh.points[b], &r = m_mesh.points[c],
                          &s = m_mesh.points[d];
    const Eigen::Vector3d direction = m_normal[a] + m_normal[b] + m_normal[c] + m_normal[d];
    const double least_gain = 1.01;
    const double before = (std::min)(triangle_shape(p, q, r, direction),
                                     triangle_shape(q, p, s, direction));
    const double after = (std::min)(triangle_shape(p, s, r, direction),
                                    triangle_shape(s, q, r, direction));
    if(!(after > 0) || after < least_gain * before)
      return false;
    const Eigen::Vector3d n = (s - p).cross(r - p).normalized(),
                          m = (q - s).cross(r - s).normalized();
    return fits(n, a) && fits(n, c) && fits(n, d) && fits(m, b) && fits(m, c) && fits(m, d)
           && n.dot(m) >= largest_turn && is_edge_allowed(c, d, 2 * length_of(h));
  }

  // Moves inner vertices along the surface to the centroids of their faces.
  void move_vertices()
  {
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
      if(m_editor.is_vertex(v) && !m_mesh.is_border_vertex(v) && !m_is_crease[v])
        move(v);
  }

  void move(int v)
  {
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    double area = 0;
    m_mesh.for_each_outgoing(v, [&](int h)
    {
      const double a = m_mesh.normal(h / 3).norm();
      area += a;
      for(const int w : m_mesh.triangles[h / 3])
        centroid += a / 3 * m_mesh.points[w];
    });
    if(!(area > 0))
      return;
    const Eigen::Vector3d old_point = m_mesh.points[v];
    const Working_location old_place = m_place[v];
    Eigen::Vector3d step = centroid / area - old_point;
    step -= step.dot(m_normal[v]) * m_normal[v];
    const double old_shape = worst_shape_around(v);
    m_place[v] = m_walk.project(old_point + step, m_normal[v], old_place.face);
    update(v);
    if(worst_shape_around(v) >= (std::min)(old_shape, least_shape))
      return;
    m_place[v] = old_place;
    update(v);
  }

  // -1 if a face around `v` is turned against the surface
  double worst_shape_around(int v) const
  {
    double worst = 1;
    m_mesh.for_each_outgoing(v, [&](int h)
    {
      const std::array<int, 3>& t = m_mesh.triangles[h / 3];
      const Eigen::Vector3d normal = m_mesh.normal(h / 3).normalized();
      const bool is_fit = fits(normal, t[0]) && fits(normal, t[1]) && fits(normal, t[2]);
      worst = (std::min)(worst, is_fit ? triangle_shape(m_mesh.points[t[0]], m_mesh.points[t[1]],
                                                        m_mesh.points[t[2]], normal)
                                       : -1.);
    });
    return worst;
  }

  template <typename T>
  static void permute(const std::vector<int>& old_vertex, std::vector<T>& values)
  {
    std::vector<T> result;
    result.reserve(old_vertex.size());
    for(const int v : old_vertex)
      result.push_back(values[v]);
    values.swap(result);
  }

  void compact()
  {
    std::vector<int> old_vertex;
    m_editor.compact(old_vertex);
    permute(old_vertex, m_length);
    permute(old_vertex, m_normal);
    permute(old_vertex, m_place);
    permute(old_vertex, m_is_crease);
  }

  const Working_mesh& m_original;
  const std::vector<double>& m_original_length;
  Surface_walk m_walk;
  Boundary_chains m_boundary;
  Working_mesh m_mesh;
  Mesh_editor m_editor;
  std::vector<double> m_length;                     // per vertex, as the following ones
  std::vector<Eigen::Vector3d> m_original_normal;
  std::vector<Eigen::Vector3d> m_normal;
  std::vector<Working_location> m_place;
  std::vector<char> m_is_crease;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_ISOTROPIC_REMESHER_H
