// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_JUNCTION_EXTENSIONS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_JUNCTION_EXTENSIONS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The exact test for a T-mesh to be analysis-suitable: no extension of a T-junction in one
// direction meets one in the other direction. The extension of a T-junction is closed and has two
// parts: the face extension continues the edge that ends there over two knot intervals, the edge
// extension goes back over one. If there are no crossings, the basis functions are linearly
// independent and sum up to one (Beirao da Veiga, Buffa, Sangalli, Vazquez: Analysis-suitable
// T-splines of arbitrary degree).
template <typename Point>
class T_junction_extensions
{
  typedef T_mesh<Point> Mesh;
  typedef typename Mesh::Vertex Vertex;
  typedef typename Mesh::Halfedge Halfedge;
  typedef typename Mesh::Face Face;

public:
  struct T_junction
  {
    Vertex vertex;
    int direction; // in which the edge is missing
    std::vector<std::size_t> crossings; // T-junctions whose extensions cross that of this one
  };

  explicit T_junction_extensions(const Mesh& mesh) : m_mesh(mesh)
  {
    for(Vertex v : mesh.mesh().vertices())
      for(int d = 0; d < 4; ++d)
        if(!mesh.is_extraordinary(v) && mesh.star(v).into[d].is_valid())
          m_junctions.push_back(T_junction{v, d, {}});
    for(std::size_t i = 0; i < m_junctions.size(); ++i)
      trace(i);
    find_crossings();
  }

  const std::vector<T_junction>& junctions() const { return m_junctions; }

private:
  // the T-junctions whose extensions touch an element of the mesh, in its two directions; elements
  // are numbered: faces, then edges, then vertices
  struct Touch
  {
    std::size_t element;
    int axis;
    std::size_t junction;

    bool operator<(const Touch& t) const
    {
      return element != t.element ? element < t.element
                                  : (axis != t.axis ? axis < t.axis : junction < t.junction);
    }
  };

  struct Recorder
  {
    T_junction_extensions& extensions;
    std::size_t junction;

    void add(std::size_t element, int axis)
    {
      extensions.m_touches.push_back(Touch{element, axis, junction});
    }
    void on_face(Face f, int axis) { add(f, axis); }
    void on_edge(Halfedge h) { add(extensions.number(h), 0); }
    void on_crossing(Halfedge h) { add(extensions.number(h), 1); }
    void on_vertex(Vertex v, int direction) { add(extensions.number(v), direction & 1); }
  };

  std::size_t number(Halfedge h) const
  {
    return m_mesh.mesh().num_faces() + std::size_t(m_mesh.mesh().edge(h));
  }

  std::size_t number(Vertex v) const
  {
    return m_mesh.mesh().num_faces() + m_mesh.mesh().num_edges() + std::size_t(v);
  }

  void trace(std::size_t i)
  {
    Recorder recorder{*this, i};
    const T_junction& t = m_junctions[i];
    recorder.on_vertex(t.vertex, t.direction);
    m_mesh.follow(t.vertex, t.direction, 2, recorder);
    m_mesh.follow(t.vertex, (t.direction + 2) & 3, 1, recorder);
  }

  void find_crossings()
  {
    std::sort(m_touches.begin(), m_touches.end());
    for(std::size_t first = 0; first < m_touches.size();)
    {
      std::size_t middle = first;
      while(middle < m_touches.size() && m_touches[middle].element == m_touches[first].element
            && m_touches[middle].axis == m_touches[first].axis)
        ++middle;
      std::size_t last = middle;
      while(last < m_touches.size() && m_touches[last].element == m_touches[first].element)
        ++last;
      for(std::size_t i = first; i < middle; ++i)
        for(std::size_t j = middle; j < last; ++j)
        {
          m_junctions[m_touches[i].junction].crossings.push_back(m_touches[j].junction);
          m_junctions[m_touches[j].junction].crossings.push_back(m_touches[i].junction);
        }
      first = last;
    }
    for(T_junction& t : m_junctions)
    {
      std::sort(t.crossings.begin(), t.crossings.end());
      t.crossings.erase(std::unique(t.crossings.begin(), t.crossings.end()), t.crossings.end());
    }
  }

  const Mesh& m_mesh;
  std::vector<T_junction> m_junctions;
  std::vector<Touch> m_touches;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_T_JUNCTION_EXTENSIONS_H
