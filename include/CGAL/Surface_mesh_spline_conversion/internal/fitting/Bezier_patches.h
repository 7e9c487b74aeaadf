// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_BEZIER_PATCHES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_BEZIER_PATCHES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/cubic_B_spline.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The patches of a surface in Bezier form, in which many points are computed faster than from the
// control points. Patches with an extraordinary point have no such form and are evaluated by the
// surface.
template <typename Surface>
class Bezier_patches
{
  typedef std::size_t size_type;
  typedef typename Surface::FT FT;

public:
  struct Point_and_tangents
  {
    Eigen::Vector3d point, u, v; // derivatives along `u` and `v`
  };

  // see `Surface::Bezier_element`
  struct Element
  {
    double u0, v0, u1, v1;
    std::array<Eigen::Vector3d, 16> points;

    double s(double u) const { return (u - u0) / (u1 - u0); }
    double t(double v) const { return (v - v0) / (v1 - v0); }
  };

  // those of a patch, which do not change; none of an extraordinary one
  typedef std::shared_ptr<const std::vector<Element> > Elements;

  // \pre update() is called for all patches before they are evaluated
  explicit Bezier_patches(const Surface& surface)
    : m_surface(surface), m_elements(surface.number_of_patches())
  {}

  const Surface& surface() const { return m_surface; }

  // takes over that control points that act on a patch have moved
  void update(size_type patch)
  {
    m_elements[patch].reset();
    if(m_surface.is_extraordinary_patch(patch))
      return;
    const auto of_surface = m_surface.patch_elements(patch);
    const auto elements = std::make_shared<std::vector<Element> >();
    elements->reserve(of_surface.size());
    for(const auto& e : of_surface)
    {
      elements->emplace_back();
      Element& element = elements->back();
      element.u0 = CGAL::to_double(e.u0);
      element.v0 = CGAL::to_double(e.v0);
      element.u1 = CGAL::to_double(e.u1);
      element.v1 = CGAL::to_double(e.v1);
      for(size_type k = 0; k < 16; ++k)
        element.points[k] = to_eigen(e.points[k]);
    }
    m_elements[patch] = elements;
  }

  // takes a patch of another surface with the same functions and control points
  void copy(size_type patch, const Bezier_patches& other, size_type patch_of_other)
  {
    m_elements[patch] = other.m_elements[patch_of_other];
  }

  // returns the elements of a patch, to be set again later
  const Elements& elements(size_type patch) const { return m_elements[patch]; }

  void set_elements(size_type patch, const Elements& elements) { m_elements[patch] = elements; }

  // computes the points of a patch on a uniform grid, see `Surface::positions()`
  // \pre the patch has a Bezier form
  void points(size_type patch, size_type nu, size_type nv, std::vector<Eigen::Vector3d>& out) const
  {
    out.resize((nu + 1) * (nv + 1));
    const auto o = m_surface.patch_origin(patch);
    const double u0 = CGAL::to_double(o.u0), v0 = CGAL::to_double(o.v0);
    const double du = CGAL::to_double(o.u1) - u0, dv = CGAL::to_double(o.v1) - v0;
    // the elements are the cells of a grid
    std::vector<std::pair<double, Row> > columns;
    columns.reserve(nu + 1);
    for(size_type i = 0; i <= nu; ++i)
    {
      const double u = u0 + du * double(i) / double(nu);
      columns.emplace_back(u, bernstein(element_at(patch, u, v0).s(u), 0));
    }
    for(size_type j = 0; j <= nv; ++j)
    {
      const double v = v0 + dv * double(j) / double(nv);
      const Element* last = &element_at(patch, u0, v);
      Curve along_u = curve(*last, bernstein(last->t(v), 0));
      for(size_type i = 0; i <= nu; ++i)
      {
        const Element& e = element_at(patch, columns[i].first, v);
        if(&e != last)
          along_u = curve(e, bernstein(e.t(v), 0));
        last = &e;
        out[j * (nu + 1) + i] = combination(columns[i].second, along_u);
      }
    }
  }

  // returns the point of a patch at `(u,v)`
  // \pre the patch has a Bezier form
  Eigen::Vector3d point(size_type patch, const FT& u, const FT& v) const
  {
    const double x = CGAL::to_double(u), y = CGAL::to_double(v);
    const Element& e = element_at(patch, x, y);
    return combination(bernstein(e.s(x), 0), curve(e, bernstein(e.t(y), 0)));
  }

  // evaluates a patch at `(u,v)`
  Point_and_tangents point_and_tangents(size_type patch, const FT& u, const FT& v) const
  {
    if(!m_elements[patch])
      return point_and_tangents_of_surface(patch, u, v);
    const double x = CGAL::to_double(u), y = CGAL::to_double(v);
    const Element& e = element_at(patch, x, y);
    const Curve along_u = curve(e, bernstein(e.t(y), 0));
    const Row row = bernstein(e.s(x), 0);
    return Point_and_tangents{
      combination(row, along_u), combination(bernstein(e.s(x), 1), along_u) / (e.u1 - e.u0),
      combination(row, curve(e, bernstein(e.t(y), 1))) / (e.v1 - e.v0)};
  }

private:
  typedef std::array<Eigen::Vector3d, 4> Curve; // Bezier points

  const Element& element_at(size_type patch, double u, double v) const
  {
    const std::vector<Element>& elements = *m_elements[patch];
    for(size_type i = 0; i + 1 < elements.size(); ++i)
      if(u <= elements[i].u1 && v <= elements[i].v1)
        return elements[i];
    return elements.back();
  }

  // returns the line of an element along `u` with the values `row` of the functions of `v`
  static Curve curve(const Element& e, const Row& row)
  {
    Curve result;
    for(size_type k = 0; k < 4; ++k)
      result[k] = row[0] * e.points[k] + row[1] * e.points[4 + k] + row[2] * e.points[8 + k]
                  + row[3] * e.points[12 + k];
    return result;
  }

  static Eigen::Vector3d combination(const Row& row, const Curve& c)
  {
    return row[0] * c[0] + row[1] * c[1] + row[2] * c[2] + row[3] * c[3];
  }

  Point_and_tangents point_and_tangents_of_surface(size_type patch, const FT& u, const FT& v) const
  {
    std::vector<typename Surface::Basis_function> functions;
    m_surface.basis(patch, u, v, 1, functions);
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    Point_and_tangents result{zero, zero, zero};
    for(const auto& f : functions)
    {
      const Eigen::Vector3d p = to_eigen(m_surface.control_point(f.control_point));
      result.point += f.value[0] * p;
      result.u += f.value[1] * p;
      result.v += f.value[2] * p;
    }
    return result;
  }

  const Surface& m_surface;
  std::vector<Elements> m_elements; // of the patches
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_BEZIER_PATCHES_H
