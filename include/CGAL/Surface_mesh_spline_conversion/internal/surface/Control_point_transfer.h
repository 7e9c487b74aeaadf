// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CONTROL_POINT_TRANSFER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CONTROL_POINT_TRANSFER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Patch_basis.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Computes the control points of a refined T-mesh from the surface before. A new control point is
// the blossom value of the polynomial near it at its knots: exact where the old space is contained
// in the new one. Around extraordinary points the rules of Catmull and Clark apply.
template <typename K>
class Control_point_transfer
{
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;
  typedef T_mesh<Point_3> Mesh;
  typedef typename Mesh::Vertex Vertex;
  typedef typename Mesh::Halfedge Halfedge;
  typedef typename Mesh::Face Face;

  // a point on the boundary of a patch where the control point in question lies, in the frame of
  // the patch, and the direction at the control point of the first axis of the patch
  struct Seat
  {
    Face face;
    std::array<Ticks, 2> position;
    int direction;
  };

  // the control point in the coordinates of a quad of the layout: its middle three knots along the
  // axes of the quad, and a point nearby, inside of a patch
  struct Site
  {
    std::array<std::array<double, 3>, 2> knots;
    std::array<double, 2> nearby;
    std::size_t patch; // of the old surface, at the point nearby
  };

public:
  Control_point_transfer(const Mesh& old_mesh, const Patch_basis<Point_3>& old_basis, Mesh& mesh)
    : m_old_mesh(old_mesh), m_old_basis(old_basis), m_mesh(mesh) {}

  void run()
  {
    std::vector<Point_3> points;
    for(Vertex v : m_mesh.mesh().vertices())
      points.push_back(is_unchanged(v) ? m_mesh.mesh().point(v) : new_point(v));
    for(Vertex v : m_mesh.mesh().vertices())
      m_mesh.mesh().point(v) = points[v];
  }

private:
  static std::array<std::int64_t, 4> neighbor_intervals(const Mesh& mesh, Vertex v)
  {
    std::array<std::int64_t, 4> result;
    for(int d = 0; d < 4; ++d)
      result[d] = rounded_parameter(mesh.star(v).interval[d][0]);
    return result;
  }

  bool is_unchanged(Vertex v) const
  {
    if(v >= m_old_mesh.mesh().num_vertices())
      return false;
    if(m_mesh.is_extraordinary(v))
      return m_mesh.length(m_mesh.mesh().halfedge(v))
             == m_old_mesh.length(m_old_mesh.mesh().halfedge(v));
    const auto before = neighbor_intervals(m_old_mesh, v);
    auto after = neighbor_intervals(m_mesh, v);
    for(int d = 0; d < 4; ++d) // the numbering of the directions may have changed
    {
      if(before == after)
        return true;
      std::rotate(after.begin(), after.begin() + 1, after.end());
    }
    return false;
  }

  Point_3 new_point(Vertex v) const
  {
    std::vector<Seat> seats;
    collect_seats(v, v, 0, seats);
    Point_3 result = m_mesh.mesh().point(v);
    const bool is_inside = !m_mesh.star(v).is_border;
    for(const Seat& seat : seats)
      if(is_inside && subdivide(v, seat, result))
        return result;
    if(m_mesh.is_extraordinary(v))
      return result;
    for(const Seat& seat : seats)
    {
      const Site s = site(v, seat);
      if(s.patch != no_index && evaluate_blossom(s, result))
        return result;
    }
    return result;
  }

  // collects the patches at `w`, which is `v`, or the vertex of row 1 that is reached from a vertex
  // `v` of row 0 across the 0-channel; directions at `w` minus those at `v` are `turns`
  void collect_seats(Vertex v, Vertex w, int turns, std::vector<Seat>& seats) const
  {
    const Halfedge first = m_mesh.opposite(m_mesh.mesh().halfedge(w));
    Halfedge h = first;
    do
    {
      if(!m_mesh.is_border(h) && m_mesh.is_patch(m_mesh.face(h)))
        seats.push_back(Seat{m_mesh.face(h), m_mesh.local_source(h),
                             m_mesh.direction(h) - m_mesh.side(h) - turns});
      h = m_mesh.rotated(h);
    }
    while(h != first);
    if(!seats.empty())
      return;
    if(m_mesh.star(w).is_T)
      return add_seat_behind_channel(w, turns, seats);
    // a corner of the crossing of two channels reaches row 1 by way of another vertex of row 0
    const auto& star = m_mesh.star(w);
    const Halfedge radial = star.out[star.quarter_turns == 1 ? 0 : 1];
    const int next_turns = m_mesh.direction(m_mesh.opposite(radial)) + 2 - m_mesh.direction(radial);
    collect_seats(v, m_mesh.target(radial), turns + next_turns, seats);
  }

  // adds the point of a patch next to a T-vertex of row 0; its direction 0 is that of the boundary
  void add_seat_behind_channel(Vertex w, int turns, std::vector<Seat>& seats) const
  {
    const Halfedge h = m_mesh.star(w).into[1];
    const Halfedge row_1 = m_mesh.opposite(m_mesh.first_of_side(m_mesh.face(h), 2));
    const Face f = m_mesh.face(row_1);
    const Ticks x = m_mesh.offset(row_1) + m_mesh.offset(h) + m_mesh.length(h);
    seats.push_back(Seat{f, m_mesh.local_position(f, m_mesh.side(row_1), x),
                         -m_mesh.side(row_1) - turns});
  }

  Site site(Vertex v, const Seat& seat) const
  {
    const Face_origin& origin = m_mesh.origin(seat.face);
    const std::array<Ticks, 2>& local = seat.position;
    Site result;
    for(int axis = 0; axis < 2; ++axis)
    {
      const double x = to_parameter(origin.first[axis] + local[axis]);
      const double middle
        = 0.5 * (to_parameter(origin.first[axis]) + to_parameter(origin.last[axis]));
      result.nearby[axis] = x + 0.25 * (middle - x);
      const int d = (seat.direction + axis) & 3;
      const auto& star = m_mesh.star(v);
      result.knots[axis] = {{x - to_parameter(star.interval[(d + 2) & 3][0]), x,
                             x + to_parameter(star.interval[d][0])}};
    }
    result.patch = m_old_basis.patch_at(origin.quad, result.nearby[0], result.nearby[1]);
    return result;
  }

  // The points of the first subdivision of an old extraordinary patch: the new vertex lies at a
  // corner, in the middle of a side, or in the center of it, and the patch was quadrisected.
  bool subdivide(Vertex v, const Seat& seat, Point_3& result) const
  {
    const Face f = seat.face;
    const Face_origin& origin = m_mesh.origin(f);
    const std::size_t i = m_old_basis.patch_at(origin.quad,
      0.5 * (to_parameter(origin.first[0]) + to_parameter(origin.last[0])),
      0.5 * (to_parameter(origin.first[1]) + to_parameter(origin.last[1])));
    const Patch& patch = m_old_basis.patch(i);
    if(patch.extraordinary == no_index
       || 2 * to_parameter(m_mesh.extent(f, 0)) != patch.u1 - patch.u0
       || 2 * to_parameter(m_mesh.extent(f, 1)) != patch.v1 - patch.v0)
      return false;
    const std::array<Ticks, 2>& local = seat.position;
    const int a = int(std::lround(2 * (to_parameter(origin.first[0] + local[0]) - patch.u0)
                                  / (patch.u1 - patch.u0)));
    const int b = int(std::lround(2 * (to_parameter(origin.first[1] + local[1]) - patch.v0)
                                  / (patch.v1 - patch.v0)));
    const Extraordinary_face& face = m_old_basis.extraordinary_face(patch);
    if(a == 1 && b == 1)
      result = point(face, face.refined_center.row(0));
    else if(a == 1 || b == 1)
      result = point(face, face.refined_edges.row(b == 0 ? 0 : (a == 2 ? 1 : (b == 2 ? 2 : 3))));
    else if(m_mesh.is_extraordinary(v))
    {
      result = point(face, face.refined_corners.row(b == 0 ? (a == 0 ? 0 : 1) : (a == 0 ? 3 : 2)));
      return true; // no other function contributes
    }
    else
      return false;
    result = result + blossom_of_functions(site(v, seat));
    return true;
  }

  Point_3 point(const Extraordinary_face& face, const Eigen::RowVectorXd& stencil) const
  {
    Vector_3 p = NULL_VECTOR;
    for(std::size_t k = 0; k < face.control_points.size(); ++k)
      p = p + stencil[static_cast<Eigen::Index>(k)] * (old_point(face.control_points[k]) - ORIGIN);
    return ORIGIN + p;
  }

  const Point_3& old_point(std::size_t i) const
  {
    return m_old_mesh.mesh().point(Vertex(typename Mesh::Mesh::size_type(i)));
  }

  bool evaluate_blossom(const Site& s, Point_3& result) const
  {
    const Patch& patch = m_old_basis.patch(s.patch);
    const double u = s.nearby[0] - patch.u0, v = s.nearby[1] - patch.v0;
    if(patch.extraordinary != no_index)
      return evaluate_blossom_of_quarter(s, patch, u / (patch.u1 - patch.u0),
                                         v / (patch.v1 - patch.v0), result);
    result = ORIGIN + blossom_of_functions(s);
    return true;
  }

  // the contribution of the functions of a patch, in the product form, to a new control point
  Vector_3 blossom_of_functions(const Site& s) const
  {
    const Patch& patch = m_old_basis.patch(s.patch);
    const Regular_element& e
      = m_old_basis.element_at(patch, s.nearby[0] - patch.u0, s.nearby[1] - patch.v0);
    const Row wu = weights(s.knots[0], patch.u0 + e.u0, patch.u0 + e.u1);
    const Row wv = weights(s.knots[1], patch.v0 + e.v0, patch.v0 + e.v1);
    Vector_3 p = NULL_VECTOR;
    for(std::size_t i = e.first; i < e.last; ++i)
    {
      const Element_function& f = m_old_basis.function(i);
      p = p + dot(wu, m_old_basis.factor_u(f)) * dot(wv, m_old_basis.factor_v(f))
              * (old_point(f.control_point) - ORIGIN);
    }
    return p;
  }

  // in an extraordinary patch, only the quarters at regular corners are polynomials
  bool evaluate_blossom_of_quarter(const Site& s, const Patch& patch, double u, double v,
                                   Point_3& result) const
  {
    const Extraordinary_face& face = m_old_basis.extraordinary_face(patch);
    const int corner = Extraordinary_face::quarter_at(u, v);
    if(face.quarters[corner].table != nullptr)
      return false;
    std::array<std::array<double, 3>, 2> local; // knots in the frame of the quarter
    for(int k = 0; k < 3; ++k)
    {
      const std::array<double, 2> st = Extraordinary_face::to_quarter(corner,
        (s.knots[0][k] - patch.u0) / (patch.u1 - patch.u0),
        (s.knots[1][k] - patch.v0) / (patch.v1 - patch.v0));
      local[0][k] = st[0];
      local[1][k] = st[1];
    }
    const Row ws = weights(local[0], 0, 1), wt = weights(local[1], 0, 1);
    const Stencil_matrix& bezier = face.quarters[corner].bezier;
    Eigen::RowVectorXd stencil = Eigen::RowVectorXd::Zero(bezier.cols());
    for(int j = 0; j < 4; ++j)
      for(int i = 0; i < 4; ++i)
        stencil += ws[i] * wt[j] * bezier.row(4 * j + i);
    result = point(face, stencil) + blossom_of_functions(s);
    return true;
  }

  static Row weights(const std::array<double, 3>& knots, double begin, double end)
  {
    const double size = end - begin;
    return bezier_blossom_weights((knots[0] - begin) / size, (knots[1] - begin) / size,
                                  (knots[2] - begin) / size);
  }

  const Mesh& m_old_mesh;
  const Patch_basis<Point_3>& m_old_basis;
  Mesh& m_mesh;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CONTROL_POINT_TRANSFER_H
