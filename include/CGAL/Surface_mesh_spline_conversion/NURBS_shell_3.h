// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_SHELL_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_SHELL_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Knot_vector.h>

#include <CGAL/Origin.h>
#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is a polynomial B-spline curve with a clamped knot vector.

\tparam K a model of `Kernel`
*/
template <typename K>
struct B_spline_curve_3
{
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  Knot_vector<FT> knots;               ///< degree, knots and multiplicities
  std::vector<Point_3> control_points; ///< as many as `knots` has functions

  /// returns the first parameter.
  FT first() const { return knots.knots().front(); }

  /// returns the last parameter.
  FT last() const { return knots.knots().back(); }

  /// returns the point at `t`.
  Point_3 point(FT t) const { return CGAL::ORIGIN + derivative(t, 0); }

  /// returns the derivative of `order` 0, 1 or 2 at `t`; order 0 is the vector from the origin.
  Vector_3 derivative(FT t, int order) const
  {
    typename Knot_vector<FT>::Basis basis;
    const std::size_t span = knots.find_span(t);
    knots.evaluate(span, t, order, basis);
    Vector_3 sum(0, 0, 0);
    for(int i = 0; i <= knots.degree(); ++i)
      sum = sum + basis[order][i] * (control_points[span - knots.degree() + i] - CGAL::ORIGIN);
    return sum;
  }
};

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is a polynomial tensor product B-spline surface with clamped knot vectors.

\tparam K a model of `Kernel`
*/
template <typename K>
struct B_spline_surface_3
{
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  std::array<Knot_vector<FT>, 2> knots; ///< for `u` and `v`
  std::vector<Point_3> control_points;  ///< row by row: `u` runs fastest

  /// returns control point `i` in `u`, `j` in `v`.
  const Point_3& control_point(std::size_t i, std::size_t j) const
  {
    return control_points[j * knots[0].number_of_functions() + i];
  }

  /// returns the indices in `control_points` of those on a side, counter clockwise; side 0 is that
  /// with the smallest `v`.
  std::vector<std::size_t> indices_on_side(int side) const
  {
    const std::size_t nu = knots[0].number_of_functions(), nv = knots[1].number_of_functions();
    std::vector<std::size_t> result((side & 1) ? nv : nu);
    for(std::size_t i = 0; i < result.size(); ++i)
      result[i] = (side == 0) ? i : (side == 1) ? nu * i + nu - 1
                : (side == 2) ? nu * nv - 1 - i : nu * (nv - 1 - i);
    return result;
  }

  /// returns the point at `(u,v)`.
  Point_3 point(FT u, FT v) const { return CGAL::ORIGIN + derivatives(u, v, 0)[0][0]; }

  /// returns the derivatives by `u` (first index) and `v` (second index) up to `order` 0, 1 or 2 in
  /// total; the derivative of order 0 is the vector from the origin, those beyond `order` are zero.
  std::array<std::array<Vector_3, 3>, 3> derivatives(FT u, FT v, int order) const
  {
    typename Knot_vector<FT>::Basis bu, bv;
    const std::size_t su = knots[0].find_span(u), sv = knots[1].find_span(v);
    knots[0].evaluate(su, u, order, bu);
    knots[1].evaluate(sv, v, order, bv);
    const int du = knots[0].degree(), dv = knots[1].degree();
    std::array<std::array<Vector_3, 3>, 3> result;
    for(auto& row : result)
      row.fill(Vector_3(0, 0, 0));
    for(int j = 0; j <= dv; ++j)
      for(int a = 0; a <= order; ++a)
      {
        Vector_3 row(0, 0, 0);
        for(int i = 0; i <= du; ++i)
          row = row + bu[a][i] * (control_point(su - du + i, sv - dv + j) - CGAL::ORIGIN);
        for(int b = 0; a + b <= order; ++b)
          result[a][b] = result[a][b] + bv[b][j] * row;
      }
    return result;
  }
};

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

The class `NURBS_shell_3` is the boundary representation that is written to CAD files: B-spline
faces with explicit, shared edges and vertices. It is the result of `extract_NURBS_faces()`.

The loop of a face runs counter clockwise as seen from outside, that is from the side to which
\f$ S_u \times S_v \f$ points. Every edge is used by two faces in opposite directions, or by one
face at the boundary. The faces form one or more connected components.

\tparam K a model of `Kernel`
*/
template <typename K>
class NURBS_shell_3
{
public:
  typedef std::size_t size_type;
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef B_spline_curve_3<K> Curve;
  typedef B_spline_surface_3<K> Surface;

  /// marks the absence of a face.
  static constexpr size_type null = (std::numeric_limits<size_type>::max)();

  /// an edge; its curve runs from the vertex `source` to the vertex `target`.
  struct Edge
  {
    size_type source;
    size_type target;
    Curve curve;
  };

  /// the use of an edge in a loop.
  struct Oriented_edge
  {
    size_type edge;
    bool is_forward;
  };

  /// a face; the loop begins at the smallest parameters and runs along the lower side first.
  struct Face
  {
    Surface surface;
    std::vector<Oriented_edge> loop;
    size_type patch;              ///< the patch of the T-NURCC surface at the smallest parameters
    bool is_extraordinary;        ///< is this a cap at an extraordinary point?
    size_type crease = null;      ///< the line above a corner that the face lies beside, or `null`
  };

  /// \name Creation
  /// @{

  /// adds a vertex and returns its index.
  size_type add_vertex(const Point_3& p) { m_points.push_back(p); return m_points.size() - 1; }

  /// adds an edge and returns its index.
  /// \pre the vertices exist
  size_type add_edge(Edge edge)
  {
    CGAL_precondition(edge.source < m_points.size() && edge.target < m_points.size());
    m_edges.push_back(std::move(edge));
    m_faces_of_edge.push_back({{null, null}});
    return m_edges.size() - 1;
  }

  /// adds a face and returns its index.
  /// \pre the edges of the loop exist, and none is already used in the same direction
  size_type add_face(Face face)
  {
    for(const Oriented_edge& e : face.loop)
    {
      CGAL_precondition(e.edge < m_edges.size());
      CGAL_precondition(m_faces_of_edge[e.edge][e.is_forward ? 0 : 1] == null);
      m_faces_of_edge[e.edge][e.is_forward ? 0 : 1] = m_faces.size();
    }
    m_faces.push_back(std::move(face));
    return m_faces.size() - 1;
  }

  /// @}
  /// \name Access
  /// @{

  /// returns the number of vertices.
  size_type number_of_vertices() const { return m_points.size(); }

  /// returns the number of edges.
  size_type number_of_edges() const { return m_edges.size(); }

  /// returns the number of faces.
  size_type number_of_faces() const { return m_faces.size(); }

  /// returns the position of vertex `v`.
  const Point_3& point(size_type v) const { return m_points[v]; }

  /// returns edge `e`.
  const Edge& edge(size_type e) const { return m_edges[e]; }

  /// returns face `f`.
  const Face& face(size_type f) const { return m_faces[f]; }

  /// returns the face to the left of edge `e` or, if not `is_forward`, of its opposite; or `null`.
  size_type face_of_edge(size_type e, bool is_forward) const
  {
    return m_faces_of_edge[e][is_forward ? 0 : 1];
  }

  /// returns `true` if edge `e` has one face only.
  bool is_border(size_type e) const
  {
    return m_faces_of_edge[e][0] == null || m_faces_of_edge[e][1] == null;
  }

  /// returns `true` if edge `e` lies on a line above a corner, between the faces beside it.
  bool is_crease(size_type e) const
  {
    if(is_border(e))
      return false;
    const size_type crease = m_faces[m_faces_of_edge[e][0]].crease;
    return crease != null && crease == m_faces[m_faces_of_edge[e][1]].crease;
  }

  /// returns the number of polynomial pieces of all faces.
  size_type number_of_spans() const
  {
    size_type n = 0;
    for(const Face& f : m_faces)
      n += f.surface.knots[0].number_of_spans() * f.surface.knots[1].number_of_spans();
    return n;
  }

  /// returns the faces of each connected component; components are in the order of their first
  /// face.
  std::vector<std::vector<size_type> > components() const
  {
    std::vector<size_type> root(m_faces.size());
    std::iota(root.begin(), root.end(), size_type(0));
    auto find = [&root](size_type f)
    {
      while(root[f] != f)
        f = root[f] = root[root[f]];
      return f;
    };
    for(const auto& faces : m_faces_of_edge)
      if(faces[0] != null && faces[1] != null)
      {
        const size_type a = find(faces[0]), b = find(faces[1]);
        root[(std::max)(a, b)] = (std::min)(a, b);
      }
    std::vector<std::vector<size_type> > result;
    std::vector<size_type> index(m_faces.size(), null);
    for(size_type f = 0; f < m_faces.size(); ++f)
    {
      const size_type r = find(f);
      if(r == f)
      {
        index[f] = result.size();
        result.emplace_back();
      }
      result[index[r]].push_back(f);
    }
    return result;
  }

  /// @}

private:
  std::vector<Point_3> m_points;
  std::vector<Edge> m_edges;
  std::vector<Face> m_faces;
  std::vector<std::array<size_type, 2> > m_faces_of_edge;
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_SHELL_3_H
