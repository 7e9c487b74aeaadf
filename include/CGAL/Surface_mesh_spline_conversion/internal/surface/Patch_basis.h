// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_PATCH_BASIS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_PATCH_BASIS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Bezier_extraction.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Cap_functions.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Extraordinary_face.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// a patch: a face of the T-mesh with an area
struct Patch
{
  std::size_t face;
  std::size_t quad;
  double u0, v0, u1, v1;      // rectangle in the quad of the layout
  std::size_t extraordinary;  // its number among the extraordinary faces, or no_index
};

constexpr std::size_t no_index = (std::numeric_limits<std::size_t>::max)();

// The basis functions of a T-NURCC surface, patch by patch, in the coordinates of the quads of the
// layout. It depends on the T-mesh, but not on the positions of the control points.
template <typename Point>
class Patch_basis
{
  typedef T_mesh<Point> Mesh;
  typedef typename Mesh::Vertex Vertex;
  typedef typename Mesh::Halfedge Halfedge;
  typedef typename Mesh::Face Face;

public:
  Patch_basis() {}

  // `previous`: the basis of `old_mesh`, the mesh before it was refined, or empty ones.
  // \pre the meshes are up to date
  Patch_basis(const Mesh& mesh, const Mesh& old_mesh, const Patch_basis& previous)
    : m_tables(previous.m_tables)
  {
    Bezier_extraction<Point> extraction(mesh, old_mesh, previous.m_bezier);
    m_bezier = std::move(extraction.result());
    m_patch_of_face.assign(mesh.mesh().num_faces(), no_index);
    Extraordinary_face_builder<Point> builder(mesh, m_tables);
    for(Face f : mesh.mesh().faces())
      if(mesh.is_patch(f))
      {
        Patch patch = patch_of_origin(f, mesh.origin(f));
        if(mesh.is_extraordinary_face(f))
        {
          patch.extraordinary = m_extraordinary_faces.size();
          m_extraordinary_faces.push_back(builder(f));
        }
        if(m_patches_of_quad.size() <= patch.quad)
          m_patches_of_quad.resize(patch.quad + 1);
        m_patches_of_quad[patch.quad].push_back(m_patches.size());
        m_patch_of_face[f] = m_patches.size();
        m_patches.push_back(patch);
      }
    set_stamps(previous);
    if(previous.m_has_caps)
      add_caps(mesh, previous);
  }

  bool has_caps() const { return m_has_caps; }

  // puts caps in the place of the limit of subdivision at extraordinary points, or takes them away
  void set_caps(const Mesh& mesh, bool has_caps)
  {
    ++m_last_stamp;
    m_has_caps = has_caps;
    m_caps.clear();
    for(std::size_t i = 0; i < m_patches.size(); ++i)
      if(m_patches[i].extraordinary != no_index)
        m_stamps[i] = m_last_stamp;
    if(has_caps)
      add_caps(mesh, Patch_basis());
  }

  // returns how many times the patch is halved to the square of the cap at one of its corners, or -1
  // if there is none
  int cap_level(std::size_t i, int corner) const
  {
    const Cap* cap = find_cap(m_patches[i], corner);
    return cap == nullptr ? -1 : cap->level;
  }

  // returns a bound of the sum of the magnitudes of all functions on a patch
  double bound(std::size_t i) const
  {
    double result = 1; // there are no negative ones elsewhere
    for(int corner = 0; corner < 4; ++corner)
      if(const Cap* cap = find_cap(m_patches[i], corner))
        result = (std::max)(result, cap->functions->bound());
    return result;
  }

  std::size_t number_of_patches() const { return m_patches.size(); }
  const Patch& patch(std::size_t i) const { return m_patches[i]; }
  std::size_t patch_of_face(std::size_t f) const { return m_patch_of_face[f]; }

  // returns the patch that contains the point (u, v) of the quad
  std::size_t patch_at(std::size_t quad, double u, double v) const
  {
    for(std::size_t i : m_patches_of_quad[quad])
    {
      const Patch& p = m_patches[i];
      if(p.u0 <= u && u <= p.u1 && p.v0 <= v && v <= p.v1)
        return i;
    }
    return no_index;
  }

  // A number that tells when the functions of a patch have got their present form: a patch on the
  // same rectangle that had the same number before some refinements had the same functions.
  std::size_t stamp(std::size_t i) const { return m_stamps[i]; }

  const Extraordinary_face& extraordinary_face(const Patch& patch) const
  {
    return m_extraordinary_faces[patch.extraordinary];
  }

  // The elements of a patch are numbered from first_element() to last_element(); in an
  // extraordinary patch, those functions are added to that of its `extraordinary_face()`.
  std::size_t first_element(const Patch& patch) const
  {
    return m_bezier.first_element[patch.face];
  }
  std::size_t last_element(const Patch& patch) const
  {
    return m_bezier.first_element[patch.face + 1];
  }
  const Regular_element& element(std::size_t i) const { return m_bezier.elements[i]; }
  const Element_function& function(std::size_t i) const { return m_bezier.functions[i]; }

  // returns the factors of a function
  const Row& factor_u(const Element_function& f) const { return m_bezier.rows[f.u]; }
  const Row& factor_v(const Element_function& f) const { return m_bezier.rows[f.v]; }

  // calls `visit(control_point, values)` for the functions that do not vanish at the point (u, v)
  // of the quad; `values` are N, N_u, N_v, N_uu, N_uv, N_vv up to `order`
  template <typename Visitor>
  void evaluate(std::size_t i, double u, double v, int order, const Visitor& visit) const
  {
    if(!evaluate_cap(m_patches[i], u, v, order, visit))
      evaluate_limit(i, u, v, order, visit);
  }

  // does the same for the surface without caps
  template <typename Visitor>
  void evaluate_limit(std::size_t i, double u, double v, int order, const Visitor& visit) const
  {
    const Patch& patch = m_patches[i];
    evaluate_regular(patch, u - patch.u0, v - patch.v0, order, visit);
    if(patch.extraordinary != no_index)
      evaluate_extraordinary(patch, u, v, order, visit);
  }

  // returns the element that contains the point, in coordinates of the face
  const Regular_element& element_at(const Patch& patch, double u, double v) const
  {
    const std::size_t last = last_element(patch) - 1;
    for(std::size_t i = first_element(patch); i < last; ++i)
      if(u <= m_bezier.elements[i].u1 && v <= m_bezier.elements[i].v1)
        return m_bezier.elements[i];
    return m_bezier.elements[last];
  }

private:
  // the cap at a corner of a patch
  struct Cap
  {
    int level = -1; // see cap_level()
    int sector = 0;
    std::shared_ptr<const Cap_functions> functions; // null if there is no cap
  };

  struct Patch_corner
  {
    std::size_t patch;
    int corner;
  };

  // The square of a cap is not smaller than that: such a part of the sides of its patch.
  static constexpr int maximum_cap_level = 6;

  static Patch patch_of_origin(std::size_t f, const Face_origin& origin)
  {
    return Patch{f, origin.quad, to_parameter(origin.first[0]), to_parameter(origin.first[1]),
                 to_parameter(origin.last[0]), to_parameter(origin.last[1]), no_index};
  }

  // patches whose functions are not those of the previous basis get a new stamp
  void set_stamps(const Patch_basis& previous)
  {
    m_last_stamp = previous.m_last_stamp + 1;
    for(const Patch& patch : m_patches)
    {
      const std::size_t i = previous.find(patch);
      m_stamps.push_back(i != no_index && has_functions(patch, previous, previous.m_patches[i])
                           ? previous.m_stamps[i] : m_last_stamp);
    }
  }

  // Caps are those of the previous basis where nothing round them has changed.
  void add_caps(const Mesh& mesh, const Patch_basis& previous)
  {
    m_has_caps = true;
    m_caps.resize(m_extraordinary_faces.size());
    for(Vertex v : mesh.mesh().vertices())
      if(mesh.is_extraordinary(v))
        add_cap(mesh, corners_at(mesh, v), previous);
  }

  // the corners of patches at an extraordinary point, counter clockwise
  std::vector<Patch_corner> corners_at(const Mesh& mesh, Vertex v) const
  {
    std::vector<Patch_corner> result;
    const Halfedge first = mesh.opposite(mesh.mesh().halfedge(v));
    Halfedge h = first;
    do
    {
      result.push_back(Patch_corner{m_patch_of_face[mesh.face(h)], mesh.side(h)});
      h = mesh.rotated(h);
    }
    while(h != first);
    return result;
  }

  void add_cap(const Mesh& mesh, const std::vector<Patch_corner>& corners,
               const Patch_basis& previous)
  {
    Cap cap;
    cap.level = cap_level(mesh, corners);
    const std::size_t i = previous.find(m_patches[corners.front().patch]);
    const Cap* old = i == no_index || !previous.m_has_caps ? nullptr
      : &previous.m_caps[previous.m_patches[i].extraordinary][std::size_t(corners.front().corner)];
    bool is_new = old == nullptr || old->level != cap.level;
    for(const Patch_corner& c : corners)
      is_new = is_new || m_stamps[c.patch] == m_last_stamp;
    cap.sector = is_new ? 0 : old->sector;
    if(!is_new)
      cap.functions = old->functions;
    else if(cap.level <= maximum_cap_level)
      cap.functions = make_cap(corners, cap.level);
    for(const Patch_corner& c : corners)
    {
      m_caps[m_patches[c.patch].extraordinary][std::size_t(c.corner)] = cap;
      cap.sector = (cap.sector + 1) % int(corners.size());
      if(is_new)
        m_stamps[c.patch] = m_last_stamp;
    }
  }

  // The square of a cap lies in an element of each patch; the surface beside its outer sides is one
  // polynomial along each of them, that belongs to no other cap.
  int cap_level(const Mesh& mesh, const std::vector<Patch_corner>& corners) const
  {
    int result = 0;
    for(const Patch_corner& c : corners)
    {
      const Patch& patch = m_patches[c.patch];
      const Face f{typename Mesh::Mesh::size_type(patch.face)};
      for(int i = 1; i < 4; ++i)
        if(mesh.is_extraordinary(mesh.source(mesh.first_of_side(f, (c.corner + i) & 3))))
          result = (std::max)(result, 2);
      if(!has_single_neighbor(mesh, f, (c.corner + 1) & 3)
         || !has_single_neighbor(mesh, f, (c.corner + 2) & 3))
        result = (std::max)(result, 1);
      while(result <= maximum_cap_level && is_cut(patch, c.corner, result))
        ++result;
    }
    return result;
  }

  // is the square at a corner of a patch cut by elements?
  bool is_cut(const Patch& patch, int corner, int level) const
  {
    const double size = patch.u1 - patch.u0, length = std::ldexp(size, -level);
    for(std::size_t e = first_element(patch); e < last_element(patch); ++e)
    {
      const Regular_element& element = m_bezier.elements[e];
      for(double u : {element.u0, element.u1})
      {
        const double distance = corner == 0 || corner == 3 ? u : size - u;
        if(0 < distance && distance < length)
          return true;
      }
      for(double v : {element.v0, element.v1})
      {
        const double distance = corner < 2 ? v : size - v;
        if(0 < distance && distance < length)
          return true;
      }
    }
    return false;
  }

  bool has_single_neighbor(const Mesh& mesh, Face f, int side) const
  {
    const Halfedge inner = mesh.first_of_side(f, side), h = mesh.opposite(inner);
    if(!mesh.is_corner(inner) || mesh.is_border(h) || !mesh.is_patch(mesh.face(h))
       || mesh.is_extraordinary_face(mesh.face(h)))
      return false;
    const int axis = mesh.side(h) & 1;
    const auto position = [&](Ticks x)
      { return to_parameter(mesh.local_position(mesh.face(h), mesh.side(h), x)[std::size_t(axis)]); };
    double begin = position(mesh.offset(h)), end = position(mesh.offset(h) + mesh.length(h));
    if(begin > end)
      std::swap(begin, end);
    const Patch& patch = m_patches[m_patch_of_face[mesh.face(h)]];
    for(std::size_t e = first_element(patch); e < last_element(patch); ++e)
    {
      const Regular_element& element = m_bezier.elements[e];
      const double x = axis == 0 ? element.u0 : element.v0;
      if(begin < x && x < end)
        return false;
    }
    return true;
  }

  std::shared_ptr<const Cap_functions> make_cap(const std::vector<Patch_corner>& corners,
                                                int level) const
  {
    std::vector<std::size_t> functions;
    for(const Patch_corner& c : corners)
    {
      const std::vector<std::size_t>& points = extraordinary_face(m_patches[c.patch]).control_points;
      functions.insert(functions.end(), points.begin(), points.end());
      m_bezier.for_each_function(m_patches[c.patch].face, [&](const Element_function& f)
        { functions.push_back(f.control_point); });
    }
    std::sort(functions.begin(), functions.end());
    functions.erase(std::unique(functions.begin(), functions.end()), functions.end());
    const auto evaluate = [&](int k, double x, double y)
      { return values_in_square(corners[std::size_t(k)], level, x, y, functions); };
    const int valence = int(corners.size());
    const auto result = std::make_shared<const Cap_functions>(
      functions, valence, cap_data(valence, Eigen::Index(functions.size()), evaluate));
    return result->is_smooth() ? result : nullptr;
  }

  // returns the values of the functions of the surface without caps, and of their derivatives, in
  // three rows; x begins at the corner, along the side that begins there
  Eigen::MatrixXd values_in_square(const Patch_corner& c, int level, double x, double y,
                                   const std::vector<std::size_t>& functions) const
  {
    constexpr int direction[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}; // of the sides
    const Patch& patch = m_patches[c.patch];
    const double du = patch.u1 - patch.u0, dv = patch.v1 - patch.v0;
    const double length = std::ldexp(1., -level);
    const std::array<double, 2> at
      = Extraordinary_face::to_face(c.corner, 2 * length * x, 2 * length * y);
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3, Eigen::Index(functions.size()));
    evaluate_limit(c.patch, patch.u0 + at[0] * du, patch.v0 + at[1] * dv, 1,
      [&](std::size_t point, const std::array<double, 6>& value)
      {
        const Eigen::Index column = Eigen::Index(
          std::lower_bound(functions.begin(), functions.end(), point) - functions.begin());
        result(0, column) += value[0];
        for(int k = 0; k < 2; ++k)
        {
          const int* d = direction[(c.corner + k) & 3];
          result(1 + k, column) += length * (d[0] * du * value[1] + d[1] * dv * value[2]);
        }
      });
    return result;
  }

  // returns the cap at a corner of a patch, or a null pointer
  const Cap* find_cap(const Patch& patch, int corner) const
  {
    if(!m_has_caps || patch.extraordinary == no_index)
      return nullptr;
    const Cap& cap = m_caps[patch.extraordinary][std::size_t(corner)];
    return cap.functions == nullptr ? nullptr : &cap;
  }

  // evaluates the basis if the point lies on a cap
  template <typename Visitor>
  bool evaluate_cap(const Patch& patch, double u, double v, int order, const Visitor& visit) const
  {
    const double du = patch.u1 - patch.u0, dv = patch.v1 - patch.v0;
    for(int corner = 0; corner < 4; ++corner)
    {
      const Cap* cap = find_cap(patch, corner);
      if(cap == nullptr)
        continue;
      const std::array<double, 2> st
        = Extraordinary_face::to_quarter(corner, (u - patch.u0) / du, (v - patch.v0) / dv);
      const double scale = std::ldexp(1., cap->level - 1); // of quarters
      if(scale * (std::max)(st[0], st[1]) > 1)
        continue;
      Basis_matrix values;
      cap->functions->evaluate(cap->sector, scale * st[0], scale * st[1], order, values);
      values.middleRows(1, 2) *= scale;
      values.bottomRows(3) *= scale * scale;
      Extraordinary_face::rotate_derivatives(corner, values);
      visit_columns(values, cap->functions->control_points(), du, dv, visit);
      return true;
    }
    return false;
  }

  // returns the patch on the same rectangle, or `no_index`
  std::size_t find(const Patch& patch) const
  {
    if(patch.quad < m_patches_of_quad.size())
      for(std::size_t i : m_patches_of_quad[patch.quad])
      {
        const Patch& p = m_patches[i];
        if(p.u0 == patch.u0 && p.v0 == patch.v0 && p.u1 == patch.u1 && p.v1 == patch.v1)
          return i;
      }
    return no_index;
  }

  bool has_functions(const Patch& patch, const Patch_basis& other, const Patch& of_other) const
  {
    if((patch.extraordinary == no_index) != (of_other.extraordinary == no_index)
       || (patch.extraordinary != no_index
           && !extraordinary_face(patch).has_functions(other.extraordinary_face(of_other))))
      return false;
    const auto elements = m_bezier.elements.begin(), others = other.m_bezier.elements.begin();
    return std::equal(elements + std::ptrdiff_t(first_element(patch)),
                      elements + std::ptrdiff_t(last_element(patch)),
                      others + std::ptrdiff_t(other.first_element(of_other)),
                      others + std::ptrdiff_t(other.last_element(of_other)),
                      [&](const Regular_element& a, const Regular_element& b)
                      { return has_functions(a, other, b); });
  }

  bool has_functions(const Regular_element& a, const Patch_basis& other,
                     const Regular_element& b) const
  {
    const auto functions = m_bezier.functions.begin(), others = other.m_bezier.functions.begin();
    return a.u0 == b.u0 && a.v0 == b.v0 && a.u1 == b.u1 && a.v1 == b.v1
           && std::equal(functions + std::ptrdiff_t(a.first), functions + std::ptrdiff_t(a.last),
                         others + std::ptrdiff_t(b.first), others + std::ptrdiff_t(b.last));
  }

  template <typename Visitor>
  void evaluate_regular(const Patch& patch, double u, double v, int order,
                        const Visitor& visit) const
  {
    const Regular_element& element = element_at(patch, u, v);
    const double du = element.u1 - element.u0, dv = element.v1 - element.v0;
    const double s = (u - element.u0) / du, t = (v - element.v0) / dv;
    std::array<Row, 3> bu = {}, bv = {}; // derivatives above `order` are not computed
    for(int k = 0; k <= order; ++k)
    {
      bu[k] = bernstein(s, k);
      bv[k] = bernstein(t, k);
      for(int i = 0; i < 4; ++i)
      {
        bu[k][i] /= (k > 0 ? du : 1) * (k > 1 ? du : 1);
        bv[k][i] /= (k > 0 ? dv : 1) * (k > 1 ? dv : 1);
      }
    }
    for(std::size_t i = element.first; i < element.last; ++i)
    {
      const Element_function& f = m_bezier.functions[i];
      const Row& u_factor = factor_u(f);
      const Row& v_factor = factor_v(f);
      std::array<double, 6> value = {{0, 0, 0, 0, 0, 0}};
      const double fu = dot(bu[0], u_factor), fv = dot(bv[0], v_factor);
      value[0] = fu * fv;
      if(order > 0)
      {
        const double gu = dot(bu[1], u_factor), gv = dot(bv[1], v_factor);
        value[1] = gu * fv;
        value[2] = fu * gv;
        if(order > 1)
        {
          value[3] = dot(bu[2], u_factor) * fv;
          value[4] = gu * gv;
          value[5] = fu * dot(bv[2], v_factor);
        }
      }
      visit(f.control_point, value);
    }
  }

  template <typename Visitor>
  void evaluate_extraordinary(const Patch& patch, double u, double v, int order,
                              const Visitor& visit) const
  {
    const Extraordinary_face& face = extraordinary_face(patch);
    const double du = patch.u1 - patch.u0, dv = patch.v1 - patch.v0;
    Basis_matrix values;
    face.evaluate((u - patch.u0) / du, (v - patch.v0) / dv, order, values);
    visit_columns(values, face.control_points, du, dv, visit);
  }

  // `values`: in the unit square
  template <typename Visitor>
  static void visit_columns(const Basis_matrix& values,
                            const std::vector<std::size_t>& control_points, double du, double dv,
                            const Visitor& visit)
  {
    for(std::size_t i = 0; i < control_points.size(); ++i)
    {
      const auto c = values.col(static_cast<Eigen::Index>(i));
      visit(control_points[i], std::array<double, 6>{{c[0], c[1] / du, c[2] / dv,
        c[3] / (du * du), c[4] / (du * dv), c[5] / (dv * dv)}});
    }
  }

  Catmull_clark_tables m_tables;
  std::vector<Patch> m_patches;
  std::vector<std::size_t> m_stamps; // of the patches
  std::size_t m_last_stamp = 0;
  std::vector<std::size_t> m_patch_of_face;
  std::vector<std::vector<std::size_t> > m_patches_of_quad;
  Bezier_elements m_bezier;
  std::vector<Extraordinary_face> m_extraordinary_faces;
  bool m_has_caps = false;
  std::vector<std::array<Cap, 4> > m_caps; // at the corners of the extraordinary faces
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_PATCH_BASIS_H
