// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_WORKING_MESH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_WORKING_MESH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/assertions.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The triangle mesh on which field, map and layout are computed: the same point set as the input
// mesh, refined by edge splits only. Halfedge `3 * f + i` runs from `triangles[f][i]` to
// `triangles[f][(i + 1) % 3]`; the corner of face `f` at `triangles[f][i]` has the same index.
struct Working_mesh
{
  // the piece of a boundary chain below a boundary halfedge: arc lengths at its source and target
  struct Boundary_piece
  {
    std::size_t chain = no_chain;
    double first = 0;
    double last = 0;
  };

  static constexpr std::size_t no_chain = (std::numeric_limits<std::size_t>::max)();

  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3> > triangles;
  std::vector<int> opposite;                   // per halfedge, -1 on the boundary
  std::vector<int> vertex_halfedge;            // outgoing; on the boundary the boundary halfedge,
                                               // which comes first in counter clockwise order
  std::vector<std::size_t> parent;             // per face: position of the input face in faces(tm)
  std::vector<Boundary_piece> boundary_piece;  // per halfedge, meaningful on the boundary
  std::vector<char> is_corner;                 // per vertex: designated corner of the boundary

  int number_of_vertices() const { return static_cast<int>(points.size()); }
  int number_of_faces() const { return static_cast<int>(triangles.size()); }
  int number_of_halfedges() const { return 3 * number_of_faces(); }

  static int face(int h) { return h / 3; }
  static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
  int source(int h) const { return triangles[h / 3][h % 3]; }
  int target(int h) const { return triangles[h / 3][(h + 1) % 3]; }
  bool is_border(int h) const { return opposite[h] < 0; }
  bool is_border_vertex(int v) const { return opposite[vertex_halfedge[v]] < 0; }

  // the next outgoing halfedge in counter clockwise order, or -1 at the boundary
  int next_around_source(int h) const { return opposite[previous(h)]; }

  Eigen::Vector3d vector(int h) const { return points[target(h)] - points[source(h)]; }

  // normal of a face, of the length of twice its area
  Eigen::Vector3d normal(int f) const { return vector(3 * f).cross(vector(3 * f + 1)); }

  int euler_characteristic() const
  {
    int edges = 0;
    for(int h = 0; h < number_of_halfedges(); ++h)
      edges += opposite[h] < h ? 1 : 0;
    return number_of_vertices() - edges + number_of_faces();
  }

  // calls `function(h)` for the halfedges that leave `v`, one per face, counter clockwise
  template <typename Function>
  void for_each_outgoing(int v, Function function) const
  {
    const int first = vertex_halfedge[v];
    int h = first;
    do
    {
      function(h);
      h = next_around_source(h);
    }
    while(h >= 0 && h != first);
  }

  // splits the edge of `h` at its midpoint and returns the new vertex. The face of `h` keeps the
  // part at the source of `h`; its other part is appended, then that of the opposite face. The
  // halfedge `next(h)` becomes the new inner edge, and its old edge moves to the appended face.
  int split_edge(int h)
  {
    const int o = opposite[h];
    const int v = number_of_vertices();
    points.push_back((points[source(h)] + points[target(h)]) / 2);
    is_corner.push_back(0);
    const int near_target = split_triangle(h, v);
    vertex_halfedge.push_back(near_target);
    if(o < 0)
    {
      opposite[near_target] = -1;
      split_boundary_piece(h, near_target);
      return v;
    }
    const int near_source = split_triangle(o, v);
    link(h, near_source);
    link(near_target, o);
    return v;
  }

  // an outgoing halfedge of `a` with target `b`, or -1. A list of edges to be split must consist of
  // pairs of vertices, because splits move halfedges.
  int find_halfedge(int a, int b) const
  {
    int found = -1;
    for_each_outgoing(a, [&](int h) { if(target(h) == b) found = h; });
    return found;
  }

  // sets `opposite` of two halfedges of the same edge
  void link(int h, int o)
  {
    opposite[h] = o;
    opposite[o] = h;
  }

private:
  // cuts the face of `h` at the vertex `v` on `h` and returns the halfedge from `v` to the old
  // target of `h`, in the new face
  int split_triangle(int h, int v)
  {
    const int f = face(h), i = h % 3;
    const int g = number_of_faces();
    const int b = triangles[f][(i + 1) % 3];
    triangles.push_back(triangles[f]);
    triangles[g][i] = v;
    triangles[f][(i + 1) % 3] = v;
    parent.push_back(parent[f]);
    opposite.resize(opposite.size() + 3, -1);
    boundary_piece.resize(boundary_piece.size() + 3);

    const int outer = next(h), moved = 3 * g + (i + 1) % 3;
    if(opposite[outer] >= 0)
      link(moved, opposite[outer]);
    boundary_piece[moved] = boundary_piece[outer];
    boundary_piece[outer] = Boundary_piece();
    link(outer, 3 * g + (i + 2) % 3);
    if(vertex_halfedge[b] == outer)
      vertex_halfedge[b] = moved;
    return 3 * g + i;
  }

  void split_boundary_piece(int h, int near_target)
  {
    boundary_piece[near_target] = boundary_piece[h];
    const double middle = (boundary_piece[h].first + boundary_piece[h].last) / 2;
    boundary_piece[h].last = middle;
    boundary_piece[near_target].first = middle;
  }
};

// a point of the working mesh
struct Working_location
{
  int face;
  std::array<double, 3> barycentric; // sums up to one
};

inline Eigen::Vector3d point_at(const Working_mesh& mesh, const Working_location& at)
{
  const std::array<int, 3>& t = mesh.triangles[at.face];
  return at.barycentric[0] * mesh.points[t[0]] + at.barycentric[1] * mesh.points[t[1]]
         + at.barycentric[2] * mesh.points[t[2]];
}

// Connected component of every face, numbered from 0.
inline std::vector<int> face_components(const Working_mesh& mesh)
{
  std::vector<int> component(mesh.number_of_faces(), -1), stack;
  int n = 0;
  for(int seed = 0; seed < mesh.number_of_faces(); ++seed)
  {
    if(component[seed] >= 0)
      continue;
    component[seed] = n;
    stack.push_back(seed);
    while(!stack.empty())
    {
      const int f = stack.back();
      stack.pop_back();
      for(int h = 3 * f; h < 3 * f + 3; ++h)
        if(!mesh.is_border(h) && component[mesh.opposite[h] / 3] < 0)
        {
          component[mesh.opposite[h] / 3] = n;
          stack.push_back(mesh.opposite[h] / 3);
        }
    }
    ++n;
  }
  return component;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_WORKING_MESH_H
