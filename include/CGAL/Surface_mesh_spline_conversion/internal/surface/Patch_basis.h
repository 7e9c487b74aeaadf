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
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Extraordinary_face.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
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
    for(std::size_t i = 0; i < face.control_points.size(); ++i)
    {
      const auto c = values.col(static_cast<Eigen::Index>(i));
      visit(face.control_points[i], std::array<double, 6>{{c[0], c[1] / du, c[2] / dv,
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
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_PATCH_BASIS_H
