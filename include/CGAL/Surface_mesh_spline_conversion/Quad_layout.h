// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_QUAD_LAYOUT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_QUAD_LAYOUT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/assertions.h>
#include <CGAL/use.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is a point on the input mesh: a face, given by its position in `faces(tm)`, and barycentric
coordinates with respect to the vertices of the face, in the order of
`vertices_around_face(halfedge(f, tm), tm)`.
*/
template <typename GeomTraits>
struct Surface_location
{
  typedef typename GeomTraits::FT FT;

  std::size_t face;                          ///< position of the face in `faces(tm)`
  std::array<FT, 3> barycentric;             ///< sums up to one
  typename GeomTraits::Point_3 point;        ///< the point itself
};

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is the interval of a boundary chain that is assigned to a boundary side of a quad. Both ends are
arc lengths of the chain (see `Boundary_curve_network_3`), `first < last`; on a closed chain `first`
lies in `[0, length)` and `last` may exceed the length.
*/
template <typename FT>
struct Boundary_side
{
  std::size_t chain; ///< index of the chain in the network
  FT first;          ///< arc length where the side begins
  FT last;           ///< arc length where the side ends
};

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

The class `Quad_layout` is a partition of a triangle mesh into quads that meet edge to edge: the
result of `extract_quad_layout()`, and the base mesh of the T-NURCC surface.

The vertices 0, 1, 2, 3 of a quad have the local coordinates (0,0), (1,0), (1,1), (0,1), counter
clockwise as seen from outside; side `i` runs from vertex `i` to vertex `i+1`. The mesh lies to the
left of a boundary side, and the arc length of its chain increases along it.

\tparam GeomTraits a model of `Kernel`
*/
template <typename GeomTraits>
class Quad_layout
{
public:
  typedef std::size_t size_type;
  typedef typename GeomTraits::FT FT;
  typedef typename GeomTraits::Point_3 Point_3;
  typedef Surface_location<GeomTraits> Location;
  typedef Surface_mesh_spline_conversion::Boundary_side<FT> Boundary_side;

  /// a side of a quad: (quad, number of the side)
  typedef std::pair<size_type, int> Side;

  /// The inverse map \f$ \varphi^{-1} \f$ of the layout: a homeomorphism from the quads to the
  /// mesh.
  struct Inverse_map
  {
    virtual ~Inverse_map() {}

    /// returns the point of the mesh at the local coordinates `(u,v)` in \f$ [0,1]^2 \f$ of `quad`.
    virtual Location operator()(size_type quad, FT u, FT v) const = 0;
  };

  /// marks the absence of a neighbour or chain.
  static constexpr size_type null = (std::numeric_limits<size_type>::max)();

  /// \name Creation
  /// @{

  /// creates an empty layout.
  Quad_layout() {}

  /// creates a layout from points and quads (counter clockwise), and finds the neighbours.
  /// \pre the quads form an orientable 2-manifold with or without boundary in which no two sides
  ///      have the same source and target
  Quad_layout(std::vector<Point_3> points, std::vector<std::array<size_type, 4> > quads)
    : m_points(std::move(points)), m_quads(std::move(quads)),
      m_neighbors(m_quads.size()), m_corner(m_points.size(), false)
  {
    std::map<std::pair<size_type, size_type>, Side> side_of;
    for(size_type q = 0; q < m_quads.size(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        const bool is_new
          = side_of.emplace(std::make_pair(vertex(q, i), vertex(q, i + 1)), Side(q, i)).second;
        CGAL_precondition(is_new);
        CGAL_USE(is_new);
      }
    for(size_type q = 0; q < m_quads.size(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        auto it = side_of.find(std::make_pair(vertex(q, i + 1), vertex(q, i)));
        m_neighbors[q][i] = (it == side_of.end()) ? Side(null, 0) : it->second;
      }
    m_boundary_sides.resize(m_quads.size());
    for(auto& sides : m_boundary_sides)
      sides.fill(Boundary_side{null, FT(0), FT(0)});
  }

  /// creates a layout from points, quads and neighbours; needed where two sides have the same end
  /// vertices, as in very coarse layouts.
  Quad_layout(std::vector<Point_3> points, std::vector<std::array<size_type, 4> > quads,
              std::vector<std::array<Side, 4> > neighbors)
    : m_points(std::move(points)), m_quads(std::move(quads)),
      m_neighbors(std::move(neighbors)), m_corner(m_points.size(), false)
  {
    m_boundary_sides.resize(m_quads.size());
    for(auto& sides : m_boundary_sides)
      sides.fill(Boundary_side{null, FT(0), FT(0)});
  }

  /// @}
  /// \name Combinatorics
  /// @{

  /// returns the number of vertices.
  size_type number_of_vertices() const { return m_points.size(); }

  /// returns the number of quads.
  size_type number_of_quads() const { return m_quads.size(); }

  /// returns vertex `i` modulo 4 of `quad`.
  size_type vertex(size_type quad, int i) const { return m_quads[quad][i & 3]; }

  /// returns the side across side `i` of `quad`; its quad is `null` at the boundary.
  Side neighbor(size_type quad, int i) const { return m_neighbors[quad][i & 3]; }

  /// returns `true` if side `i` of `quad` lies on the boundary.
  bool is_border(size_type quad, int i) const { return neighbor(quad, i).first == null; }

  /// returns `true` if the boundary has a tangent discontinuity at `vertex`.
  bool is_corner(size_type vertex) const { return m_corner[vertex]; }

  /// returns the boundary sides of `chain` in the order of their arc length.
  std::vector<Side> chain_sides(size_type chain) const
  {
    std::vector<Side> sides;
    for(size_type q = 0; q < number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
        if(is_border(q, i) && boundary_side(q, i).chain == chain)
          sides.emplace_back(q, i);
    std::sort(sides.begin(), sides.end(), [this](const Side& a, const Side& b)
      { return boundary_side(a.first, a.second).first < boundary_side(b.first, b.second).first; });
    return sides;
  }

  /// returns the number of boundary chains: one more than the largest index of a chain.
  size_type number_of_chains() const
  {
    size_type n = 0;
    for(const auto& sides : m_boundary_sides)
      for(const Boundary_side& side : sides)
        if(side.chain != null)
          n = (std::max)(n, side.chain + 1);
    return n;
  }

  /// @}
  /// \name Geometry
  /// @{

  /// returns the position of `vertex`.
  const Point_3& point(size_type vertex) const { return m_points[vertex]; }

  /// returns what is assigned to the boundary side `i` of `quad`.
  /// \pre `is_border(quad, i)`
  const Boundary_side& boundary_side(size_type quad, int i) const
  {
    return m_boundary_sides[quad][i & 3];
  }

  /// returns the inverse map.
  /// \pre an inverse map is set
  const Inverse_map& inverse_map() const
  {
    CGAL_precondition(m_inverse_map != nullptr);
    return *m_inverse_map;
  }

  /// @}
  /// \name Modifiers
  /// @{

  /// moves `vertex`.
  void set_point(size_type vertex, const Point_3& p) { m_points[vertex] = p; }

  /// marks `vertex` as a corner of the boundary.
  void set_corner(size_type vertex, bool is_corner) { m_corner[vertex] = is_corner; }

  /// assigns a piece of a chain to the boundary side `i` of `quad`.
  void set_boundary_side(size_type quad, int i, const Boundary_side& side)
  {
    m_boundary_sides[quad][i & 3] = side;
  }

  /// sets the inverse map, which is shared by the copies of the layout.
  void set_inverse_map(std::shared_ptr<const Inverse_map> map) { m_inverse_map = std::move(map); }

  /// @}

private:
  std::vector<Point_3> m_points;
  std::vector<std::array<size_type, 4> > m_quads;
  std::vector<std::array<Side, 4> > m_neighbors;
  std::vector<std::array<Boundary_side, 4> > m_boundary_sides;
  std::vector<bool> m_corner;
  std::shared_ptr<const Inverse_map> m_inverse_map;
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_QUAD_LAYOUT_H
