// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_T_NURCC_SURFACE_3_H
#define CGAL_T_NURCC_SURFACE_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Patch_basis.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Refinement_closure.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh_builder.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {

/*!
\ingroup PkgSurfaceMeshSplineConversionSurface

The class `T_NURCC_surface_3` is a T-NURCC surface of degree three: a spline surface that is
controlled by a mesh of quads with T-vertices and with vertices of any valence.

The surface is made from a quad layout. Every boundary edge of the layout gets a *0-channel*, a ring
of faces with a knot interval of length zero, such that the outer row of control points (row 0)
alone defines the boundary curves, which are cubic splines. A corner of the boundary at a layout
vertex with one quad becomes the crossing of two 0-channels; at a layout vertex with two quads, the
rows 0 and 1 get a triple knot, or row 0 alone if one of these quads has an extraordinary vertex.

Away from the vertices of valence other than four (the *extraordinary points*), the surface is a
T-spline, bicubic on every *Bezier element*, and twice continuously differentiable, except across
the line above a corner with a triple knot: of two knot intervals, or one if only row 0 has it.
Around an extraordinary point it is the limit surface of Catmull and Clark. All basis functions sum
up to one.

A *patch* is a face of the control mesh that is not part of a 0-channel. Points of a patch are given
in the local coordinates `(u,v)` in \f$ [0,1]^2 \f$ of its quad of the layout, in the orientation of
the quad; derivatives are taken with respect to these coordinates.

\tparam K a model of `Kernel` with `double` as number type
*/
template <typename K>
class T_NURCC_surface_3
{
  typedef Surface_mesh_spline_conversion::internal::T_mesh<typename K::Point_3> T_mesh;
  typedef Surface_mesh_spline_conversion::internal::Patch_basis<typename K::Point_3> Patch_basis;
  typedef Surface_mesh_spline_conversion::internal::Patch Patch;

public:
  typedef K Geom_traits;
  typedef std::size_t size_type;
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;
  typedef Surface_mesh_spline_conversion::Quad_layout<K> Quad_layout;
  typedef Surface_mesh_spline_conversion::Error_code Error_code;

  /// the control mesh; its vertices are the control points
  typedef CGAL::Surface_mesh<Point_3> Control_mesh;

  /// The rectangle of a patch in its quad of the layout.
  struct Patch_origin
  {
    size_type quad;
    FT u0, v0, u1, v1;
  };

  /// The value of the basis function of a control point, and its derivatives, at some point.
  struct Basis_function
  {
    size_type control_point;
    std::array<double, 6> value; ///< \f$ N, N_u, N_v, N_{uu}, N_{uv}, N_{vv} \f$
  };

  /*!
  The boundary curve of a chain, a cubic spline in the parameter `x` in \f$ [0,n] \f$ for a chain of
  `n` sides of quads.

  Of an open chain, `knots` is the full knot vector: four more knots than control points, with the
  ends repeated four times. Of a closed chain, `knots` has one more entry than there are control
  points; control point `i` belongs to the periodic B-spline with the knots `knots[i-2]` to
  `knots[i+2]`, where `x = 0` and `x = n` are the same point.
  */
  struct Boundary_curve
  {
    std::vector<size_type> control_points;
    std::vector<FT> knots;
    bool is_closed;
  };

  /// A part of the boundary, from parameter `x0` to `x1` of `chain`.
  struct Boundary_span
  {
    size_type chain;
    FT x0, x1;
  };

  /// A patch to be split: `u` halves its interval in `u`, `v` that in `v`, both quadrisect it.
  struct Patch_split
  {
    size_type patch;
    bool u, v;
  };

  /*!
  A rectangle on which the surface is bicubic, with its Bezier points: number `4*j+i` is point `i`
  along `u` and `j` along `v`. An element with `is_extraordinary` touches an extraordinary point;
  there the points are an approximation that has the exact tangent planes along the two sides away
  from the extraordinary point.
  */
  struct Bezier_element
  {
    size_type patch;
    FT u0, v0, u1, v1; ///< in the quad of the layout
    bool is_extraordinary;
    std::array<Point_3, 16> points;
  };

  /*!
  The control points around an extraordinary point after some exact subdivisions, where the
  neighborhood is uniform: its two rings. Along edge `k` and edge `k+1` (counter clockwise) it has
  the points `point(k, a, b)`, `a` steps along edge `k` and `b` along edge `k+1`, from 0 to 2.
  */
  struct Extraordinary_ring
  {
    /// The face between the edges `k` and `k+1`: a square of the size of one step.
    struct Sector
    {
      size_type patch, quad;
      FT u0, v0, u1, v1;  ///< rectangle in the quad of the layout
      int corner;         ///< the corner of this rectangle at the extraordinary point (0 to 3,
                          ///< as the vertices of a quad); edge `k` is the side with this number
    };

    size_type control_point; ///< of the surface
    int level;               ///< number of subdivisions
    std::vector<Sector> sectors;
    std::vector<Point_3> points; ///< the center, then six points per sector

    int valence() const { return static_cast<int>(sectors.size()); }

    const Point_3& point(int k, int a, int b) const
    {
      if(a == 0 && b == 0)
        return points[0];
      const int n = valence();
      if(a == 0)
        return point(k + 1, b, 0);
      return points[static_cast<std::size_t>(1 + 6 * (((k % n) + n) % n) + 3 * (a - 1) + b)];
    }
  };

  /// \name Creation
  /// @{

  /// creates an empty surface.
  T_NURCC_surface_3() {}

  /// creates the surface on a quad layout. If the layout is not supported, the surface is empty and
  /// `error()` tells why: a boundary vertex must have one or two quads, an interior vertex at
  /// least three. The initial control points come from the points of the layout.
  explicit T_NURCC_surface_3(const Quad_layout& layout)
  {
    Surface_mesh_spline_conversion::internal::T_mesh_builder<K> builder(layout, m_mesh);
    m_error = builder.build();
    m_message = builder.message();
    if(m_error != Error_code::OK)
    {
      m_mesh = T_mesh();
      return;
    }
    m_chain_starts = builder.chain_starts();
    m_chain_is_closed = builder.chain_is_closed();
    Closure(m_mesh, m_units).run();
    update(T_mesh());
  }

  /// @}
  /// \name Status
  /// @{

  /// returns `OK`, or why the surface could not be created.
  Error_code error() const { return m_error; }

  /// returns a sentence that names the vertex of the layout that is not supported.
  const std::string& message() const { return m_message; }

  /// @}
  /// \name Control Points
  /// @{

  /// returns the control mesh. Its property maps `h:corner` (the target is a corner of the face),
  /// `e:length` and `f:origin` describe the T-mesh.
  const Control_mesh& control_mesh() const { return m_mesh.mesh(); }

  /// returns the number of control points.
  size_type number_of_control_points() const { return m_mesh.mesh().num_vertices(); }

  /// returns control point `i`.
  const Point_3& control_point(size_type i) const { return m_mesh.mesh().point(vertex(i)); }

  /// moves control point `i`.
  void set_control_point(size_type i, const Point_3& p) { m_mesh.mesh().point(vertex(i)) = p; }

  /// @}
  /// \name Patches
  /// @{

  /// returns the number of patches.
  size_type number_of_patches() const { return m_basis.number_of_patches(); }

  /// returns where patch `i` lies.
  Patch_origin patch_origin(size_type i) const
  {
    const Patch& p = m_basis.patch(i);
    return Patch_origin{p.quad, p.u0, p.v0, p.u1, p.v1};
  }

  /// returns the patch that contains the point `(u,v)` of `quad`.
  size_type patch_at(size_type quad, const FT& u, const FT& v) const
  {
    return m_basis.patch_at(quad, CGAL::to_double(u), CGAL::to_double(v));
  }

  /// returns a number that tells when the basis functions of patch `i` have got their present form:
  /// a patch that covers the same rectangle as one before some refinements, and has the same
  /// number, has the same functions.
  size_type basis_stamp(size_type i) const { return m_basis.stamp(i); }

  /// returns `true` if patch `i` has an extraordinary point as vertex.
  bool is_extraordinary_patch(size_type i) const
  {
    return m_basis.patch(i).extraordinary != Surface_mesh_spline_conversion::internal::no_index;
  }

  /// returns the number of extraordinary points.
  size_type number_of_extraordinary_points() const { return m_extraordinary_points.size(); }

  /// returns `true` if caps take the place of the limit surface at extraordinary points.
  bool has_caps() const { return m_basis.has_caps(); }

  /// puts G1 caps in the place of the limit surface at extraordinary points, as far as it is tangent
  /// continuous around them, or takes them away. A cap consists of one biquintic polynomial on each
  /// patch at the extraordinary point; its points are linear in the control points. All points,
  /// derivatives, and basis functions are those of the caps then; Bezier elements and rings of
  /// control points are still those of the limit surface.
  void set_caps(bool has_caps) { m_basis.set_caps(m_mesh, has_caps); }

  /// returns how many times patch `i` is halved in both directions to the square of the cap at one of
  /// its corners (0 to 3, as the vertices of a quad), or -1 if there is no cap.
  int cap_level(size_type i, int corner) const { return m_basis.cap_level(i, corner); }

  /// returns a bound of the sum of the magnitudes of all basis functions on patch `i`: one, except on
  /// a cap, where some are negative.
  double basis_bound(size_type i) const { return m_basis.bound(i); }

  /// returns the number of T-junctions.
  size_type number_of_t_junctions() const
  {
    size_type n = 0;
    for(auto v : m_mesh.mesh().vertices())
      n += m_mesh.star(v).is_T ? 1 : 0;
    return n;
  }

  /// @}
  /// \name Evaluation
  /// @{

  /// returns the point `(u,v)` of a patch.
  Point_3 position(size_type patch, const FT& u, const FT& v) const
  {
    return ORIGIN + sum(patch, u, v, 0, 0);
  }

  /// computes the points of a patch on a uniform grid of `nu` intervals in `u` and `nv` in `v`:
  /// point `j*(nu+1)+i` is the one at `i` intervals along `u` and `j` along `v`.
  void positions(size_type patch, size_type nu, size_type nv, std::vector<Point_3>& out) const;

  /// returns the derivative of order `i` in `u` and `j` in `v`.
  /// At an extraordinary point, the first derivatives are tangent vectors of a conventional length,
  /// and the second derivatives those of a point nearby, because the limits do not exist.
  /// \pre `i + j <= 2`
  Vector_3 derivative(size_type patch, const FT& u, const FT& v, int i, int j) const
  {
    CGAL_precondition(i >= 0 && j >= 0 && i + j <= 2);
    const int order = i + j;
    return sum(patch, u, v, order, order == 0 ? 0 : (order == 1 ? 1 + j : 3 + j));
  }

  /// returns the unit normal, or the null vector where the surface is singular.
  Vector_3 normal(size_type patch, const FT& u, const FT& v) const
  {
    Vector_3 su = NULL_VECTOR, sv = NULL_VECTOR;
    visit(patch, u, v, 1, [&](size_type i, const std::array<double, 6>& value)
    {
      const Vector_3 p = control_point(i) - ORIGIN;
      su = su + value[1] * p;
      sv = sv + value[2] * p;
    });
    const Vector_3 n = CGAL::cross_product(su, sv);
    const double length = std::sqrt(CGAL::to_double(n.squared_length()));
    return length == 0 ? Vector_3(NULL_VECTOR) : n / FT(length);
  }

  /// computes the basis functions that do not vanish at the point `(u,v)` of a patch, with their
  /// derivatives up to `order`; a control point may occur more than once.
  void basis(size_type patch, const FT& u, const FT& v, int order,
             std::vector<Basis_function>& out) const
  {
    out.clear();
    visit(patch, u, v, order, [&out](size_type i, const std::array<double, 6>& value)
    { out.push_back(Basis_function{i, value}); });
  }

  /// computes the basis functions of a patch on a uniform grid, see `positions()`: with the `n`
  /// control points of its functions, number `k*n+i` of `values` is the value at point `k` of the
  /// function of `control_points[i]`.
  /// \pre `!is_extraordinary_patch(patch)`
  void basis_on_grid(size_type patch, size_type nu, size_type nv,
                     std::vector<size_type>& control_points, std::vector<double>& values) const;

  /// @}
  /// \name Boundary
  /// @{

  /// returns the number of boundary chains of the layout.
  size_type number_of_boundary_chains() const { return m_chain_starts.size(); }

  /// returns the curve of boundary `chain`.
  Boundary_curve boundary_curve(size_type chain) const;

  /// @}
  /// \name Refinement
  /// After a refinement, existing control points keep their index, but patches are renumbered. New
  /// control points reproduce the surface where the old functions are combinations of the new ones,
  /// which is so wherever no T-vertex is near, and are a good approximation elsewhere.
  /// @{

  /// halves all knot intervals; a surface without T-vertices does not change.
  void refine_uniformly();

  /// quadrisects the given patches, and refines what has to be refined with them, see
  /// `refine_boundary()`.
  void refine(const std::vector<size_type>& patches);

  /// splits the given patches in one or both directions, and refines what has to be refined with
  /// them, see `refine_boundary()`. A patch may occur more than once.
  void refine(const std::vector<Patch_split>& splits);

  /// splits patches until none of them is longer, in `u` or in `v`, than one of the given
  /// rectangles that it overlaps, and refines what has to be refined with them, see
  /// `refine_boundary()`. A new surface that is refined to the patches of another one on the same
  /// layout, some of them merged, is a coarser surface than that.
  void refine_to(const std::vector<Patch_origin>& rectangles);

  /// halves the knot intervals of the boundary that overlap the given spans, on row 0 alone, and
  /// what has to be refined with them to have a sound surface: neighboring intervals of row 0, and
  /// the parts of a side of a patch, differ at most by a factor of two; the faces around an
  /// extraordinary point are quadrisected if one of them or an edge that leaves them is split; and
  /// extensions of T-junctions do not cross, therefore the basis functions are linearly independent
  /// and sum up to one. Patches are split at convex corners only, or next to other T-junctions.
  void refine_boundary(const std::vector<Boundary_span>& spans);

  /// halves knot intervals of the boundary, on row 0 alone, until none of them has one of the given
  /// parameters inside, as far as there is a finer size, and refines what has to be refined with
  /// them, see `refine_boundary()`. The parameters of each chain are in increasing order.
  /// \pre `knots.size() == number_of_boundary_chains()`
  void refine_boundary_to(const std::vector<std::vector<FT> >& knots);

  /// @}
  /// \name Export
  /// @{

  /// returns the Bezier elements of the surface. Patches with extraordinary points are subdivided
  /// exactly `levels` times, at least once.
  std::vector<Bezier_element> bezier_elements(int levels = 1) const;

  /// returns the Bezier elements of one patch.
  /// \pre `!is_extraordinary_patch(patch)`
  std::vector<Bezier_element> patch_elements(size_type patch) const;

  /// returns a number of subdivisions after which the two rings around extraordinary point `i`
  /// are uniform and contain neither another extraordinary point nor a boundary vertex inside.
  int minimum_ring_level(size_type i) const;

  /// returns the two rings of control points around extraordinary point `i` after `level`
  /// subdivisions.
  /// \pre `level >= minimum_ring_level(i)`
  Extraordinary_ring extraordinary_ring(size_type i, int level) const;

  /// @}
  /// \name Validity
  /// @{

  /// checks that exactly 16 functions live on every regular Bezier element, that the functions sum
  /// up to one, and the lengths and corners of the faces of the control mesh.
  bool is_valid() const;

  /// @}

protected:
  // for derived classes that refine by other rules: `change(mesh, units)` splits faces of the
  // T-mesh, restores what `Refinement_closure` asks for, and leaves the mesh up to date; `units`
  // are those of the closure
  template <typename Change>
  void change_mesh(const Change& change);

  // returns the face of the T-mesh that is patch `i`
  typename T_mesh::Face face_of_patch(size_type i) const
  {
    return typename T_mesh::Face(typename Control_mesh::size_type(m_basis.patch(i).face));
  }

private:
  typedef typename T_mesh::Vertex Vertex;
  typedef typename T_mesh::Halfedge Halfedge;
  typedef typename T_mesh::Face Face;

  static Vertex vertex(size_type i) { return Vertex(typename Control_mesh::size_type(i)); }

  // brings all but the control points up to date; `old_mesh`: the mesh that the basis belongs to
  void update(const T_mesh& old_mesh)
  {
    m_basis = Patch_basis(m_mesh, old_mesh, m_basis);
    m_extraordinary_points.clear();
    for(Vertex v : m_mesh.mesh().vertices())
      if(m_mesh.is_extraordinary(v))
        m_extraordinary_points.push_back(v);
  }

  template <typename Visitor>
  void visit(size_type patch, const FT& u, const FT& v, int order, const Visitor& visitor) const
  {
    m_basis.evaluate(patch, CGAL::to_double(u), CGAL::to_double(v), order, visitor);
  }

  Vector_3 sum(size_type patch, const FT& u, const FT& v, int order, int k) const
  {
    Vector_3 result = NULL_VECTOR;
    visit(patch, u, v, order, [&](size_type i, const std::array<double, 6>& value)
    { result = result + value[static_cast<std::size_t>(k)] * (control_point(i) - ORIGIN); });
    return result;
  }

  typedef Surface_mesh_spline_conversion::internal::Regular_element Regular_element;
  typedef Surface_mesh_spline_conversion::internal::Extraordinary_face Extraordinary_face;
  typedef Surface_mesh_spline_conversion::internal::Stencil_matrix Stencil_matrix;

  // points of a grid with the values of functions there
  typedef Surface_mesh_spline_conversion::internal::Row Row;
  typedef std::vector<std::pair<size_type, Row> > Grid_rows;

  // in coordinates of a patch: the origin is its corner (u0, v0)
  struct Rectangle
  {
    double u0, v0, u1, v1;
  };

  typedef Surface_mesh_spline_conversion::internal::Refinement_closure<Point_3> Closure;

  template <typename Marker>
  void refine_marked(const Marker& mark);
  template <typename Visitor>
  void for_each_boundary_edge(size_type chain, const Visitor& visit) const;
  void mark_spans(const std::vector<Boundary_span>& spans, Closure& closure) const;
  void mark_intervals_around(size_type chain, const std::vector<FT>& knots,
                             Closure& closure) const;
  bool is_chain_end(Vertex v) const;
  Bezier_element regular_element(size_type i, const Regular_element& e) const;
  void add_positions(const Patch& patch, const Regular_element& e, size_type nu, size_type nv,
                     std::vector<Point_3>& out) const;
  static Grid_rows bernstein_on_grid(double size, size_type n, double begin, double end);
  void add_functions(const Regular_element& e, const Rectangle& r,
                     std::array<Vector_3, 16>& points) const;
  Point_3 stencil_point(const Extraordinary_face& face,
                        const Eigen::Ref<const Eigen::RowVectorXd>& stencil) const;
  static void turn(int corner, std::array<Vector_3, 16>& points);
  static Rectangle quarter_rectangle(const Patch& patch, int corner, double s0, double t0,
                                     double s1, double t1);
  void add_extraordinary_elements(size_type i, int levels, std::vector<Bezier_element>& out) const;
  void add_piece(size_type i, int corner, const Stencil_matrix& stencils,
                 const std::array<double, 2>& st, double size,
                 std::vector<Bezier_element>& out) const;
  void add_last_piece(size_type i, int corner, int levels, double size,
                      std::vector<Bezier_element>& out) const;
  std::array<Vector_3, 16> piece_points(size_type i, int corner,
                                        const Stencil_matrix& stencils) const;
  void add_element(size_type i, const Rectangle& r, bool is_extraordinary,
                   const std::array<Vector_3, 16>& points, std::vector<Bezier_element>& out) const;
  void add_sector(Halfedge h, int level, Extraordinary_ring& ring) const;
  Vector_3 function_coefficient(size_type i, int corner, double size, int a, int b) const;
  bool is_regular_basis(size_type i) const;
  bool is_partition_of_unity(size_type i) const;

  static constexpr double tolerance_of_sums = 1e-12; // rounding errors of sums of order one

  T_mesh m_mesh;
  Patch_basis m_basis;
  std::vector<std::int64_t> m_units; // the intervals around extraordinary points
  std::vector<Vertex> m_extraordinary_points;
  std::vector<Vertex> m_chain_starts; // on row 0
  std::vector<bool> m_chain_is_closed;
  Error_code m_error = Error_code::OK;
  std::string m_message;
};

} // namespace CGAL

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_NURCC_surface_3_impl.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_NURCC_surface_3_positions.h>

#endif // CGAL_T_NURCC_SURFACE_3_H
