// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_BEZIER_EXTRACTION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_BEZIER_EXTRACTION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Face_search.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Rows, each of which is kept once: most knots are uniform, and most factors of functions occur
// again and again.
class Row_table
{
public:
  const Row& operator[](std::size_t i) const { return m_rows[i]; }

  // returns the number of a row
  std::uint32_t insert(const Row& row)
  {
    const auto entry = m_numbers.emplace(row, std::uint32_t(m_rows.size()));
    if(entry.second)
      m_rows.push_back(row);
    return entry.first->second;
  }

private:
  std::vector<Row> m_rows;
  std::map<Row, std::uint32_t> m_numbers;
};

// a basis function on a Bezier element: a product of two cubics, in Bernstein form
struct Element_function
{
  std::uint32_t control_point;
  std::uint32_t u, v; // numbers of rows

  bool operator==(const Element_function& f) const
  {
    return control_point == f.control_point && u == f.u && v == f.v;
  }
};

// a rectangle of a face on which the surface is one bicubic polynomial; coordinates of the face in
// parameters
struct Regular_element
{
  double u0, v0, u1, v1;
  std::size_t first, last; // its functions
};

// the Bezier elements of all patches
struct Bezier_elements
{
  std::vector<Element_function> functions;
  std::vector<Regular_element> elements;
  std::vector<std::size_t> first_element; // of a face, one more than there are faces
  Row_table rows; // a refinement adds to those there are

  // visits the functions of a face, element by element
  template <typename Visitor>
  void for_each_function(std::size_t face, const Visitor& visit) const
  {
    for(std::size_t e = first_element[face]; e < first_element[face + 1]; ++e)
      for(std::size_t i = elements[e].first; i < elements[e].last; ++i)
        visit(functions[i]);
  }
};

// Finds the Bezier elements of all patches: each function is spread over the faces of its support
// by a search through the faces, each face is split at the knots inside, and each function is
// written in Bernstein form there. On a face with extraordinary corners, these are only the
// functions of vertices that are no neighbors of these corners, see `Extraordinary_face`.
//
// Where a refinement has not changed the functions of a face, its elements are copied.
template <typename Point>
class Bezier_extraction
{
  typedef T_mesh<Point> Mesh;
  typedef typename Mesh::Vertex Vertex;
  typedef typename Mesh::Halfedge Halfedge;
  typedef typename Mesh::Face Face;
  typedef std::array<std::int64_t, 5> Knots; // rounded, relative to the origin of the face

  // a basis function in the frame of a face
  struct Face_function
  {
    Vertex vertex;
    std::array<Knots, 2> knots;

    bool operator==(const Face_function& f) const
    {
      return vertex == f.vertex && knots == f.knots;
    }
  };

  typedef Face_search<Point> Search;
  typedef typename Search::Placement Placement;
  typedef std::array<std::array<Ticks, 2>, 4> Intervals; // two along each direction

  static constexpr int bits_of_rows = 10;

public:
  // `old_mesh`: the mesh before it was refined, or an empty one; it has the elements `old`.
  // \pre both meshes are up to date
  Bezier_extraction(const Mesh& mesh, const Mesh& old_mesh, const Bezier_elements& old)
    : m_mesh(mesh), m_old_mesh(old_mesh), m_old(old), m_search(mesh), m_rows(1 << bits_of_rows)
  {
    const std::size_t faces = mesh.mesh().num_faces();
    m_result.rows = old.rows;
    m_functions_of_face.resize(faces);
    m_excluded.resize(faces);
    find_changes();
    for(Face f : mesh.mesh().faces())
      if(m_is_new[f])
        m_excluded[f] = mesh.extraordinary_neighbors(f);
    for(Vertex v : mesh.mesh().vertices())
      if(m_is_spread[v])
        spread(v);
    m_result.elements.reserve(faces);
    m_result.functions.reserve(16 * faces);
    for(Face f : mesh.mesh().faces())
    {
      m_result.first_element.push_back(m_result.elements.size());
      if(m_is_new[f])
        extract(f);
      else if(m_mesh.is_patch(f))
        copy(f);
    }
    m_result.first_element.push_back(m_result.elements.size());
  }

  Bezier_elements& result() { return m_result; }

private:
  bool is_old(Vertex v) const { return std::size_t(v) < m_old_mesh.mesh().num_vertices(); }
  bool is_old(Face f) const { return std::size_t(f) < m_old_mesh.mesh().num_faces(); }

  // may the function of a vertex have changed?
  bool is_changed(Vertex v) const
  {
    return !is_old(v) || m_mesh.is_extraordinary(v)
           || !m_mesh.star(v).has_knots_of(m_old_mesh.star(v));
  }

  // Finds the patches whose elements have to be computed, and the vertices whose functions may be
  // among them.
  void find_changes()
  {
    constexpr std::size_t fraction = 4; // of vertices from which on it is simpler to compute all
    m_is_spread.resize(m_mesh.mesh().num_vertices());
    std::size_t number_of_changes = 0;
    for(Vertex v : m_mesh.mesh().vertices())
    {
      m_is_spread[v] = is_changed(v);
      number_of_changes += m_is_spread[v] ? 1 : 0;
    }
    const bool is_whole = fraction * number_of_changes >= m_is_spread.size();
    m_is_new.resize(m_mesh.mesh().num_faces());
    for(Face f : m_mesh.mesh().faces())
      m_is_new[f] = m_mesh.is_patch(f) && (is_whole || !is_old(f) || !has_old_functions(f));
    if(is_whole)
      std::fill(m_is_spread.begin(), m_is_spread.end(), char(true));
    else
      complete_changes();
  }

  // is a patch an old one on which no function acted that may have changed?
  bool has_old_functions(Face f) const
  {
    bool result = m_mesh.origin(f) == m_old_mesh.origin(f);
    m_old.for_each_function(f, [&](const Element_function& function)
      { result = result && !m_is_spread[function.control_point]; });
    return result;
  }

  // adds the patches that functions act on now that may have changed, then all functions that acted
  // on patches that have to be computed
  void complete_changes()
  {
    for(Vertex v : m_mesh.mesh().vertices())
      if(m_is_spread[v])
        for_each_placement(v, [this](const Placement& p, const Intervals&)
          { m_is_new[p.face] = m_mesh.is_patch(p.face); });
    for(Face f : m_old_mesh.mesh().faces())
      if(m_is_new[f])
      {
        m_old.for_each_function(f, [this](const Element_function& function)
          { m_is_spread[function.control_point] = true; });
        for(Vertex v : m_old_mesh.extraordinary_neighbors(f))
          m_is_spread[v] = true;
      }
  }

  void copy(Face f)
  {
    for(std::size_t e = m_old.first_element[f]; e < m_old.first_element[f + 1]; ++e)
    {
      Regular_element element = m_old.elements[e];
      const auto begin = m_old.functions.begin();
      m_result.functions.insert(m_result.functions.end(), begin + std::ptrdiff_t(element.first),
                                begin + std::ptrdiff_t(element.last));
      element.first = m_result.functions.size() - (element.last - element.first);
      element.last = m_result.functions.size();
      m_result.elements.push_back(element);
    }
  }

  void spread(Vertex v)
  {
    for_each_placement(v, [&](const Placement& p, const Intervals& intervals)
    {
      if(m_is_new[p.face] && !is_excluded(v, p.face))
        add_function(v, p, intervals);
    });
  }

  // Calls `visit(placement, intervals)` for the faces on which the function of `v` acts: quadrant by
  // quadrant of its support, in whose frame the face is placed; `intervals` belong to the directions
  // 0 to 3 there.
  template <typename Visitor>
  void for_each_placement(Vertex v, const Visitor& visit)
  {
    if(m_mesh.is_extraordinary(v))
      return visit_extraordinary(v, visit);
    const auto& star = m_mesh.star(v);
    for(int d = 0; d < 4; ++d)
    {
      Halfedge h = star.out[d];
      int turns = 0;
      if(!h.is_valid() && star.into[d].is_valid())
      {
        h = star.out[(d + 3) & 3]; // its face reaches over direction d
        turns = 3;
      }
      if(h.is_valid() && !m_mesh.is_border(h))
        visit_quadrant(h, turns, {{star.interval[d], star.interval[(d + 1) & 3],
                                   star.interval[(d + 2) & 3], star.interval[(d + 3) & 3]}}, visit);
    }
  }

  // Between two edges of an extraordinary vertex, the knots behind it are those along the next edge
  // to the left and to the right: a face outside of the faces around the vertex is near to one of
  // the two edges only, and does not depend on the knots that belong to the other one.
  template <typename Visitor>
  void visit_extraordinary(Vertex v, const Visitor& visit)
  {
    const Halfedge first = m_mesh.opposite(m_mesh.mesh().halfedge(v));
    Halfedge h = first;
    do
    {
      const Halfedge g = m_mesh.rotated(h), right = m_mesh.next(m_mesh.opposite(h));
      visit_quadrant(h, 0, {{m_mesh.intervals_along(h), m_mesh.intervals_along(g),
                             m_mesh.intervals_along(m_mesh.rotated(g)),
                             m_mesh.intervals_along(right)}}, visit);
      h = g;
    }
    while(h != first);
  }

  // one quadrant, [0, x] times [0, y]; `h` leaves its origin in the direction `turns`
  template <typename Visitor>
  void visit_quadrant(Halfedge h, int turns, const Intervals& intervals, const Visitor& visit)
  {
    const std::array<Ticks, 2> extent = {{intervals[0][0] + intervals[0][1],
                                          intervals[1][0] + intervals[1][1]}};
    for(const Placement& p : m_search(h, turns, extent))
      visit(p, intervals);
  }

  bool is_excluded(Vertex v, Face f) const
  {
    return std::binary_search(m_excluded[f].begin(), m_excluded[f].end(), v);
  }

  void add_function(Vertex v, const Placement& p, const Intervals& intervals)
  {
    Face_function function;
    function.vertex = v;
    for(int axis = 0; axis < 2; ++axis)
    {
      const int forward = (p.turns + axis) & 3; // direction of this axis of the face
      const auto& ahead = intervals[forward];
      const auto& behind = intervals[(forward + 2) & 3];
      const Ticks sign = forward < 2 ? 1 : -1;
      const std::int64_t origin = rounded_parameter(sign * p.origin[forward & 1]);
      const std::array<Ticks, 5> x = {{-behind[0] - behind[1], -behind[0], 0, ahead[0],
                                       ahead[0] + ahead[1]}};
      for(int i = 0; i < 5; ++i)
        function.knots[axis][i] = rounded_parameter(x[i]) - origin;
    }
    // a face may reach over two quadrants; but on a short closed strip of faces the support of a
    // function may cover a face twice, in different places
    auto& functions_of_face = m_functions_of_face[p.face];
    if(functions_of_face.empty())
      functions_of_face.reserve(16); // as many as there are if the face is not cut
    if(std::find(functions_of_face.begin(), functions_of_face.end(), function)
       == functions_of_face.end())
      functions_of_face.push_back(function);
  }

  // the parameters where the face is cut along an axis, its ends included
  std::vector<std::int64_t> cuts(Face f, int axis) const
  {
    const std::int64_t size = rounded_parameter(m_mesh.extent(f, axis));
    std::vector<std::int64_t> result = {0, size};
    for(const Face_function& function : m_functions_of_face[f])
      for(std::int64_t x : function.knots[axis])
        if(0 < x && x < size && std::find(result.begin(), result.end(), x) == result.end())
          result.push_back(x);
    std::sort(result.begin(), result.end());
    return result;
  }

  // one factor of a function on a span
  struct Span_row
  {
    Knots knots;
    std::int64_t begin = 0, end = 0; // an empty span is none
    std::uint32_t row = 0;
  };

  // Returns the number of the row of a factor. The last one of those with the same hash value is
  // remembered.
  std::uint32_t row(const Knots& knots, std::int64_t begin, std::int64_t end)
  {
    constexpr std::uint64_t multiplier = 0x9e3779b97f4a7c15; // 2^64 divided by the golden ratio
    std::uint64_t hash = std::uint64_t(begin);
    for(std::int64_t x : knots)
      hash = multiplier * (hash ^ (hash >> 32)) + std::uint64_t(x);
    Span_row& result = m_rows[(multiplier * hash) >> (64 - bits_of_rows)];
    if(result.begin != begin || result.end != end || result.knots != knots)
      result = Span_row{knots, begin, end, m_result.rows.insert(
        bezier_row(local_knots(knots), parameter(begin), parameter(end)))};
    return result.row;
  }

  void extract(Face f)
  {
    const std::vector<std::int64_t> u = cuts(f, 0), v = cuts(f, 1);
    for(std::size_t j = 0; j + 1 < v.size(); ++j)
      for(std::size_t i = 0; i + 1 < u.size(); ++i)
      {
        Regular_element element;
        element.u0 = parameter(u[i]);
        element.u1 = parameter(u[i + 1]);
        element.v0 = parameter(v[j]);
        element.v1 = parameter(v[j + 1]);
        element.first = m_result.functions.size();
        for(const Face_function& function : m_functions_of_face[f])
          if(is_active(function.knots[0], u[i], u[i + 1])
             && is_active(function.knots[1], v[j], v[j + 1]))
          {
            Element_function result;
            result.control_point = std::uint32_t(std::size_t(function.vertex));
            result.u = row(function.knots[0], u[i], u[i + 1]);
            result.v = row(function.knots[1], v[j], v[j + 1]);
            m_result.functions.push_back(result);
          }
        element.last = m_result.functions.size();
        m_result.elements.push_back(element);
      }
    std::vector<Face_function>().swap(m_functions_of_face[f]);
  }

  static bool is_active(const Knots& knots, std::int64_t begin, std::int64_t end)
  {
    return knots.front() < end && begin < knots.back();
  }

  static double parameter(std::int64_t x)
  {
    return double(x) / double(std::int64_t(1) << parameter_bits);
  }

  static Local_knots local_knots(const Knots& knots)
  {
    Local_knots result;
    for(int i = 0; i < 5; ++i)
      result[i] = parameter(knots[i]);
    return result;
  }

  const Mesh& m_mesh;
  const Mesh& m_old_mesh;
  const Bezier_elements& m_old;
  Bezier_elements m_result;
  Search m_search;
  std::vector<char> m_is_new;    // are the elements of a face computed?
  std::vector<char> m_is_spread; // are the functions of a vertex among them?
  std::vector<std::vector<Face_function> > m_functions_of_face;
  std::vector<std::vector<Vertex> > m_excluded; // by face
  std::vector<Span_row> m_rows; // see row()
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_BEZIER_EXTRACTION_H
