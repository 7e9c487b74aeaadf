// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_NURCC_SURFACE_3_IMPL_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_NURCC_SURFACE_3_IMPL_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Control_point_transfer.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Rectangle_splitter.h>
#include <CGAL/T_NURCC_surface_3.h>

#include <algorithm>
#include <cmath>

namespace CGAL {

template <typename K>
typename T_NURCC_surface_3<K>::Boundary_curve
T_NURCC_surface_3<K>::boundary_curve(size_type chain) const
{
  Boundary_curve curve;
  curve.is_closed = m_chain_is_closed[chain];
  curve.control_points.push_back(m_chain_starts[chain]);
  std::vector<FT> positions(1, FT(0));
  for_each_boundary_edge(chain, [&](Halfedge h, double, double end)
  {
    curve.control_points.push_back(m_mesh.target(h));
    positions.push_back(FT(end));
  });
  if(curve.is_closed)
  {
    curve.control_points.pop_back(); // the first one again
    curve.knots = positions;
    return curve;
  }
  curve.knots.assign(2, positions.front());
  curve.knots.insert(curve.knots.end(), positions.begin(), positions.end());
  curve.knots.insert(curve.knots.end(), 2, positions.back());
  return curve;
}

template <typename K>
bool T_NURCC_surface_3<K>::is_chain_end(Vertex v) const
{
  for(size_type c = 0; c < m_chain_starts.size(); ++c)
    if(m_chain_starts[c] == v && !m_chain_is_closed[c])
      return true;
  return false;
}

// calls `visit(h, begin, end)` for the edges of a chain, with their intervals of parameters
template <typename K>
template <typename Visitor>
void T_NURCC_surface_3<K>::for_each_boundary_edge(size_type chain, const Visitor& visit) const
{
  using namespace Surface_mesh_spline_conversion::internal;
  Ticks x = 0;
  Vertex v = m_chain_starts[chain];
  do
  {
    const Halfedge h = m_mesh.star(v).out[0]; // a boundary vertex begins with its boundary edge
    const Ticks begin = x;
    x += m_mesh.length(h);
    visit(h, to_parameter(begin), to_parameter(x));
    v = m_mesh.target(h);
  }
  while(v != m_chain_starts[chain] && (m_chain_is_closed[chain] || !is_chain_end(v)));
}

// changes the T-mesh, and computes the new control points
template <typename K>
template <typename Change>
void T_NURCC_surface_3<K>::change_mesh(const Change& change)
{
  namespace internal = Surface_mesh_spline_conversion::internal;
  const T_mesh old_mesh = m_mesh;
  change(m_mesh, m_units);
  internal::Control_point_transfer<K>(old_mesh, m_basis, m_mesh).run();
  update(old_mesh);
}

// marks faces with `mark(closure)`, and refines
template <typename K>
template <typename Marker>
void T_NURCC_surface_3<K>::refine_marked(const Marker& mark)
{
  change_mesh([&mark](T_mesh& mesh, std::vector<std::int64_t>& units)
  {
    Closure closure(mesh, units);
    mark(closure);
    closure.run();
  });
}

template <typename K>
void T_NURCC_surface_3<K>::refine_uniformly()
{
  refine_marked([this](Closure& closure)
  {
    for(Face f : m_mesh.mesh().faces())
      for(int axis = 0; axis < 2; ++axis)
        closure.mark(f, axis);
  });
}

template <typename K>
void T_NURCC_surface_3<K>::refine(const std::vector<size_type>& patches)
{
  std::vector<Patch_split> splits;
  for(size_type i : patches)
    splits.push_back(Patch_split{i, true, true});
  refine(splits);
}

template <typename K>
void T_NURCC_surface_3<K>::refine(const std::vector<Patch_split>& splits)
{
  refine_marked([&, this](Closure& closure)
  {
    for(const Patch_split& split : splits)
    {
      const Face f = face_of_patch(split.patch);
      if(split.u)
        closure.mark(f, 0);
      if(split.v)
        closure.mark(f, 1);
    }
  });
}

template <typename K>
void T_NURCC_surface_3<K>::refine_to(const std::vector<Patch_origin>& rectangles)
{
  change_mesh([&rectangles](T_mesh& mesh, std::vector<std::int64_t>& units)
  {
    Surface_mesh_spline_conversion::internal::Rectangle_splitter<Point_3> splitter(mesh);
    for(const Patch_origin& r : rectangles)
      splitter.add(r.quad, {{{CGAL::to_double(r.u0), CGAL::to_double(r.v0)}},
                            {{CGAL::to_double(r.u1), CGAL::to_double(r.v1)}}});
    splitter.run();
    Closure(mesh, units).run();
  });
}

template <typename K>
void T_NURCC_surface_3<K>::refine_boundary(const std::vector<Boundary_span>& spans)
{
  refine_marked([&, this](Closure& closure) { mark_spans(spans, closure); });
}

template <typename K>
void T_NURCC_surface_3<K>::mark_spans(const std::vector<Boundary_span>& spans,
                                      Closure& closure) const
{
  for(size_type c = 0; c < number_of_boundary_chains(); ++c)
  {
    std::vector<const Boundary_span*> spans_of_chain;
    for(const Boundary_span& span : spans)
      if(span.chain == c)
        spans_of_chain.push_back(&span);
    if(spans_of_chain.empty())
      continue;
    for_each_boundary_edge(c, [&](Halfedge h, double begin, double end)
    {
      for(const Boundary_span* span : spans_of_chain)
        if(begin < end && CGAL::to_double(span->x0) < end && begin < CGAL::to_double(span->x1))
          closure.mark_boundary(h);
    });
  }
}

template <typename K>
void T_NURCC_surface_3<K>::refine_boundary_to(const std::vector<std::vector<FT> >& knots)
{
  CGAL_precondition(knots.size() == number_of_boundary_chains());
  change_mesh([&, this](T_mesh& mesh, std::vector<std::int64_t>& units)
  {
    for(;;)
    {
      Closure closure(mesh, units);
      for(size_type c = 0; c < number_of_boundary_chains(); ++c)
        mark_intervals_around(c, knots[c], closure);
      if(!closure.has_marks())
        return;
      closure.run();
    }
  });
}

// marks the intervals of a chain that have one of the given knots inside
template <typename K>
void T_NURCC_surface_3<K>::mark_intervals_around(size_type chain, const std::vector<FT>& knots,
                                                 Closure& closure) const
{
  if(knots.empty())
    return;
  for_each_boundary_edge(chain, [&](Halfedge h, double begin, double end)
  {
    const auto it = std::upper_bound(knots.begin(), knots.end(), FT(begin));
    if(it != knots.end() && *it < FT(end))
      closure.mark_boundary(h);
  });
}

template <typename K>
std::vector<typename T_NURCC_surface_3<K>::Bezier_element>
T_NURCC_surface_3<K>::bezier_elements(int levels) const
{
  std::vector<Bezier_element> result;
  for(size_type i = 0; i < number_of_patches(); ++i)
  {
    if(is_extraordinary_patch(i))
    {
      add_extraordinary_elements(i, (std::max)(levels, 1), result);
      continue;
    }
    const std::vector<Bezier_element> elements = patch_elements(i);
    result.insert(result.end(), elements.begin(), elements.end());
  }
  return result;
}

template <typename K>
std::vector<typename T_NURCC_surface_3<K>::Bezier_element>
T_NURCC_surface_3<K>::patch_elements(size_type patch) const
{
  CGAL_precondition(!is_extraordinary_patch(patch));
  const Patch& p = m_basis.patch(patch);
  std::vector<Bezier_element> result;
  for(size_type e = m_basis.first_element(p); e < m_basis.last_element(p); ++e)
    result.push_back(regular_element(patch, m_basis.element(e)));
  return result;
}

template <typename K>
typename T_NURCC_surface_3<K>::Bezier_element
T_NURCC_surface_3<K>::regular_element(size_type i, const Regular_element& e) const
{
  const Patch& patch = m_basis.patch(i);
  Bezier_element result{i, patch.u0 + e.u0, patch.v0 + e.v0, patch.u0 + e.u1, patch.v0 + e.v1,
                        false, {}};
  std::array<Vector_3, 16> points;
  points.fill(NULL_VECTOR);
  add_functions(e, Rectangle{e.u0, e.v0, e.u1, e.v1}, points);
  for(int k = 0; k < 16; ++k)
    result.points[k] = ORIGIN + points[k];
  return result;
}

// adds the functions of element `e` to the Bezier points on the rectangle `r`, in coordinates of
// the face
template <typename K>
void T_NURCC_surface_3<K>::add_functions(const Regular_element& e, const Rectangle& r,
                                         std::array<Vector_3, 16>& points) const
{
  namespace internal = Surface_mesh_spline_conversion::internal;
  const double du = e.u1 - e.u0, dv = e.v1 - e.v0;
  const bool is_whole = r.u0 == e.u0 && r.u1 == e.u1 && r.v0 == e.v0 && r.v1 == e.v1;
  for(size_type f = e.first; f < e.last; ++f)
  {
    const auto& function = m_basis.function(f);
    internal::Row u = m_basis.factor_u(function), v = m_basis.factor_v(function);
    if(!is_whole)
    {
      u = internal::restricted(u, (r.u0 - e.u0) / du, (r.u1 - e.u0) / du);
      v = internal::restricted(v, (r.v0 - e.v0) / dv, (r.v1 - e.v0) / dv);
    }
    const Vector_3 p = control_point(function.control_point) - ORIGIN;
    for(int j = 0; j < 4; ++j)
      for(int k = 0; k < 4; ++k)
      {
        const FT weight = u[k] * v[j];
        points[4 * j + k] = points[4 * j + k] + weight * p;
      }
  }
}

// multiplies a stencil with the control points of an extraordinary face
template <typename K>
typename T_NURCC_surface_3<K>::Point_3
T_NURCC_surface_3<K>::stencil_point(const Extraordinary_face& face,
                                    const Eigen::Ref<const Eigen::RowVectorXd>& stencil) const
{
  Vector_3 p = NULL_VECTOR;
  for(size_type k = 0; k < face.control_points.size(); ++k)
    p = p + stencil[static_cast<Eigen::Index>(k)]
            * (control_point(face.control_points[k]) - ORIGIN);
  return ORIGIN + p;
}

// turns the Bezier points of a piece at `corner` of a face into the frame of the face
template <typename K>
void T_NURCC_surface_3<K>::turn(int corner, std::array<Vector_3, 16>& points)
{
  const std::array<Vector_3, 16> p = points;
  for(int j = 0; j < 4; ++j)
    for(int i = 0; i < 4; ++i)
      switch(corner)
      {
        case 0: break;
        case 1: points[4 * i + 3 - j] = p[4 * j + i]; break;
        case 2: points[4 * (3 - j) + 3 - i] = p[4 * j + i]; break;
        default: points[4 * (3 - i) + j] = p[4 * j + i];
      }
}

// the rectangle [s0, s1] x [t0, t1] of the quarter at `corner`, in coordinates of the patch
template <typename K>
typename T_NURCC_surface_3<K>::Rectangle
T_NURCC_surface_3<K>::quarter_rectangle(const Patch& patch, int corner, double s0, double t0,
                                        double s1, double t1)
{
  const std::array<double, 2> p = Extraordinary_face::to_face(corner, s0, t0);
  const std::array<double, 2> q = Extraordinary_face::to_face(corner, s1, t1);
  const double du = patch.u1 - patch.u0, dv = patch.v1 - patch.v0;
  return Rectangle{du * (std::min)(p[0], q[0]), dv * (std::min)(p[1], q[1]),
                   du * (std::max)(p[0], q[0]), dv * (std::max)(p[1], q[1])};
}

template <typename K>
void T_NURCC_surface_3<K>::add_extraordinary_elements(size_type i, int levels,
                                                      std::vector<Bezier_element>& out) const
{
  const auto& face = m_basis.extraordinary_face(m_basis.patch(i));
  for(int corner = 0; corner < 4; ++corner)
  {
    if(face.quarters[corner].table == nullptr)
    {
      add_piece(i, corner, face.bezier(corner, 0, 0), {{0, 0}}, 1, out);
      continue;
    }
    double size = 1;
    for(int level = 1; level < levels; ++level)
    {
      size /= 2;
      add_piece(i, corner, face.bezier(corner, level, 0), {{size, 0}}, size, out);
      add_piece(i, corner, face.bezier(corner, level, 1), {{size, size}}, size, out);
      add_piece(i, corner, face.bezier(corner, level, 2), {{0, size}}, size, out);
    }
    add_last_piece(i, corner, levels, size, out);
  }
}

// Adds the square [s, s+size] x [t, t+size] of the quarter at `corner` of an extraordinary patch,
// cut in pieces where the functions of the patch are. `stencils` has the Bezier points of its
// Catmull-Clark part.
template <typename K>
void T_NURCC_surface_3<K>::add_piece(size_type i, int corner, const Stencil_matrix& stencils,
                                     const std::array<double, 2>& st, double size,
                                     std::vector<Bezier_element>& out) const
{
  namespace internal = Surface_mesh_spline_conversion::internal;
  const Patch& patch = m_basis.patch(i);
  const std::array<Vector_3, 16> points = piece_points(i, corner, stencils);
  const Rectangle r = quarter_rectangle(patch, corner, st[0], st[1], st[0] + size, st[1] + size);
  for(size_type e = m_basis.first_element(patch); e < m_basis.last_element(patch); ++e)
  {
    const Regular_element& element = m_basis.element(e);
    const Rectangle part = {(std::max)(r.u0, element.u0), (std::max)(r.v0, element.v0),
                            (std::min)(r.u1, element.u1), (std::min)(r.v1, element.v1)};
    if(part.u0 >= part.u1 || part.v0 >= part.v1)
      continue;
    std::array<Vector_3, 16> sum;
    sum.fill(NULL_VECTOR);
    std::array<internal::Row, 4> wu, wv;
    for(int k = 0; k < 4; ++k)
    {
      const internal::Row unit = {{k == 0 ? 1. : 0., k == 1 ? 1. : 0., k == 2 ? 1. : 0.,
                                   k == 3 ? 1. : 0.}};
      wu[k] = internal::restricted(unit, (part.u0 - r.u0) / (r.u1 - r.u0),
                                   (part.u1 - r.u0) / (r.u1 - r.u0));
      wv[k] = internal::restricted(unit, (part.v0 - r.v0) / (r.v1 - r.v0),
                                   (part.v1 - r.v0) / (r.v1 - r.v0));
    }
    for(int k = 0; k < 16; ++k)
      for(int l = 0; l < 16; ++l)
        sum[k] = sum[k] + FT(wu[l & 3][k & 3] * wv[l >> 2][k >> 2]) * points[l];
    add_functions(element, part, sum);
    add_element(i, part, false, sum, out);
  }
}

// adds the square of the given size at an extraordinary corner
template <typename K>
void T_NURCC_surface_3<K>::add_last_piece(size_type i, int corner, int levels, double size,
                                          std::vector<Bezier_element>& out) const
{
  const Patch& patch = m_basis.patch(i);
  const auto& face = m_basis.extraordinary_face(patch);
  std::array<Vector_3, 16> points
    = piece_points(i, corner, face.bezier_at_extraordinary_point(corner, levels));
  const Rectangle r = quarter_rectangle(patch, corner, 0, 0, size, size);
  const std::array<double, 2> center
    = {{(r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2}};
  add_functions(m_basis.element_at(patch, center[0], center[1]), r, points);
  add_element(i, r, true, points, out);
}

template <typename K>
std::array<typename K::Vector_3, 16>
T_NURCC_surface_3<K>::piece_points(size_type i, int corner, const Stencil_matrix& stencils) const
{
  const auto& face = m_basis.extraordinary_face(m_basis.patch(i));
  std::array<Vector_3, 16> points;
  for(int k = 0; k < 16; ++k)
    points[k] = stencil_point(face, stencils.row(k)) - ORIGIN;
  turn(corner, points);
  return points;
}

template <typename K>
void T_NURCC_surface_3<K>::add_element(size_type i, const Rectangle& r, bool is_extraordinary,
                                       const std::array<Vector_3, 16>& points,
                                       std::vector<Bezier_element>& out) const
{
  const Patch& patch = m_basis.patch(i);
  Bezier_element element{i, patch.u0 + r.u0, patch.v0 + r.v0, patch.u0 + r.u1, patch.v0 + r.v1,
                         is_extraordinary, {}};
  for(int k = 0; k < 16; ++k)
    element.points[k] = ORIGIN + points[k];
  out.push_back(element);
}

// The ring is read off from the Catmull-Clark part and from the functions of the patches next to
// the extraordinary point; these must not be cut within the ring.
template <typename K>
int T_NURCC_surface_3<K>::minimum_ring_level(size_type i) const
{
  int level = 2;
  const Halfedge first = m_mesh.opposite(m_mesh.mesh().halfedge(m_extraordinary_points[i]));
  Halfedge h = first;
  do
  {
    const Patch& patch = m_basis.patch(m_basis.patch_of_face(m_mesh.face(h)));
    const double size = patch.u1 - patch.u0;
    for(size_type e = m_basis.first_element(patch); e < m_basis.last_element(patch); ++e)
    {
      const Regular_element& element = m_basis.element(e);
      for(const double cut : {element.u0, element.u1, element.v0, element.v1})
        for(const double distance : {cut, size - cut})
          if(distance > 0)
            while(std::ldexp(size, 1 - level) > distance)
              ++level;
    }
    h = m_mesh.rotated(h);
  }
  while(h != first);
  return level;
}

template <typename K>
typename T_NURCC_surface_3<K>::Extraordinary_ring
T_NURCC_surface_3<K>::extraordinary_ring(size_type i, int level) const
{
  CGAL_precondition(level >= minimum_ring_level(i));
  Extraordinary_ring ring;
  const Vertex center = m_extraordinary_points[i];
  ring.control_point = center;
  ring.level = level;
  const Halfedge first = m_mesh.opposite(m_mesh.mesh().halfedge(center));
  Halfedge h = first;
  do
  {
    add_sector(h, level, ring);
    h = m_mesh.rotated(h);
  }
  while(h != first);
  return ring;
}

// adds the sector to the left of `h`
template <typename K>
void T_NURCC_surface_3<K>::add_sector(Halfedge h, int level, Extraordinary_ring& ring) const
{
  namespace internal = Surface_mesh_spline_conversion::internal;
  const size_type i = m_basis.patch_of_face(m_mesh.face(h));
  const Patch& patch = m_basis.patch(i);
  const auto& face = m_basis.extraordinary_face(patch);
  const int corner = m_mesh.side(h);
  const double size = std::ldexp(2., -level); // of the sector, in the quarter of the face
  const Rectangle r = quarter_rectangle(patch, corner, 0, 0, size, size);
  ring.sectors.push_back(typename Extraordinary_ring::Sector{i, patch.quad, patch.u0 + r.u0,
    patch.v0 + r.v0, patch.u0 + r.u1, patch.v0 + r.v1, corner});
  const internal::Face_quarter& quarter = face.quarters[corner];
  const int n = quarter.table->valence();
  const internal::Stencil_matrix net = quarter.table->net(level - 1) * quarter.net;
  if(ring.points.empty())
    ring.points.push_back(stencil_point(face, net.row(0)));
  for(int a = 1; a <= 2; ++a)
    for(int b = 0; b <= 2; ++b)
      ring.points.push_back(stencil_point(face, net.row(internal::index_in_net(a, b, n)))
                            + function_coefficient(i, corner, size, a, b));
}

// the control point (a, b) of the grid with the given distances around a corner of a patch, as far
// as the functions of the patch contribute to it
template <typename K>
typename K::Vector_3
T_NURCC_surface_3<K>::function_coefficient(size_type i, int corner, double size, int a, int b) const
{
  namespace internal = Surface_mesh_spline_conversion::internal;
  const Patch& patch = m_basis.patch(i);
  const Rectangle r = quarter_rectangle(patch, corner, 0, 0, size, size);
  const Regular_element& e
    = m_basis.element_at(patch, (r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2);
  std::array<internal::Row, 2> weights;
  for(int axis = 0; axis < 2; ++axis)
  {
    std::array<double, 3> x;
    for(int k = 0; k < 3; ++k)
    {
      const std::array<double, 2> uv
        = Extraordinary_face::to_face(corner, size * (a + k - 1), size * (b + k - 1));
      x[k] = axis == 0 ? (uv[0] * (patch.u1 - patch.u0) - e.u0) / (e.u1 - e.u0)
                       : (uv[1] * (patch.v1 - patch.v0) - e.v0) / (e.v1 - e.v0);
    }
    weights[axis] = internal::bezier_blossom_weights(x[0], x[1], x[2]);
  }
  Vector_3 sum = NULL_VECTOR;
  for(size_type f = e.first; f < e.last; ++f)
  {
    const auto& function = m_basis.function(f);
    sum = sum + FT(internal::dot(weights[0], m_basis.factor_u(function))
                   * internal::dot(weights[1], m_basis.factor_v(function)))
                * (control_point(function.control_point) - ORIGIN);
  }
  return sum;
}

template <typename K>
bool T_NURCC_surface_3<K>::is_valid() const
{
  if(m_error != Error_code::OK || !m_mesh.is_valid())
    return false;
  for(size_type i = 0; i < number_of_patches(); ++i)
    if(!(is_extraordinary_patch(i) ? is_partition_of_unity(i) : is_regular_basis(i)))
      return false;
  return true;
}

// checks that 16 functions live on every element of a patch, and that they sum up to one
template <typename K>
bool T_NURCC_surface_3<K>::is_regular_basis(size_type i) const
{
  const Patch& patch = m_basis.patch(i);
  for(size_type e = m_basis.first_element(patch); e < m_basis.last_element(patch); ++e)
  {
    const Regular_element& element = m_basis.element(e);
    if(element.last - element.first != 16)
      return false;
    for(int k = 0; k < 16; ++k)
    {
      double sum = 0;
      for(size_type f = element.first; f < element.last; ++f)
        sum += m_basis.factor_u(m_basis.function(f))[k & 3]
               * m_basis.factor_v(m_basis.function(f))[k >> 2];
      if(std::abs(sum - 1) > tolerance_of_sums)
        return false;
    }
  }
  return true;
}

// checks the sum of the functions at points of all quarters and elements of a patch
template <typename K>
bool T_NURCC_surface_3<K>::is_partition_of_unity(size_type i) const
{
  const Patch& patch = m_basis.patch(i);
  for(size_type e = m_basis.first_element(patch); e < m_basis.last_element(patch); ++e)
  {
    const Regular_element& element = m_basis.element(e);
    for(int k = 0; k <= 80; ++k)
    {
      const double u = element.u0 + 0.125 * (k % 9) * (element.u1 - element.u0);
      const double v = element.v0 + 0.125 * (k / 9) * (element.v1 - element.v0);
      double sum = 0;
      visit(i, patch.u0 + u, patch.v0 + v, 0,
            [&sum](size_type, const std::array<double, 6>& value) { sum += value[0]; });
      if(std::abs(sum - 1) > tolerance_of_sums)
        return false;
    }
  }
  return true;
}

} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_NURCC_SURFACE_3_IMPL_H
