// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_CUT_GRAPH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_CUT_GRAPH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Cuts the mesh open so that the frames of neighbouring faces can be turned to agree except across
// cuts, which all singularities lie on (combing). Corners at a vertex that are not separated by
// cuts form a wedge; a maximal chain of cut edges through regular vertices is a branch, along which
// the transition between the two sides is the same.
class Cut_graph
{
public:
  // `period_jump` per halfedge, `cone` = number of right angles per vertex
  Cut_graph(const Working_mesh& mesh, const std::vector<int>& period_jump,
            const std::vector<int>& cone)
    : m_mesh(mesh), m_cone(cone), m_is_cut(mesh.number_of_halfedges(), 1),
      m_turns(mesh.number_of_faces(), 0), m_rotation(mesh.number_of_halfedges(), 0)
  {
    grow_tree(period_jump);
    comb(period_jump);
    prune();
    join_corners();
    collect_branches();
  }

  const std::vector<std::vector<int> >& branches() const { return m_branches; }
  int number_of_wedges() const { return m_number_of_wedges; }
  int wedge(int corner) const { return m_wedge[corner]; }

  // number of right angles by which the frame of face `f` is turned
  int turns(int f) const { return m_turns[f]; }

  // quarter turns of the coordinates across `h`, 0..3, zero where the mesh is not cut
  const std::vector<int>& rotation() const { return m_rotation; }

  // branch of a cut halfedge, -1 for others; halfedges in `branches()` are forward
  int branch(int h) const { return m_branch[h]; }
  bool is_forward(int h) const { return m_is_forward[h] != 0; }

  // one face per connected component
  const std::vector<int>& roots() const { return m_roots; }

private:
  // breadth first, so that charts are compact
  void grow_tree(const std::vector<int>& period_jump)
  {
    std::vector<char> is_reached(m_mesh.number_of_faces(), 0);
    std::vector<int> queue;
    queue.reserve(m_mesh.number_of_faces());
    for(int root = 0; root < m_mesh.number_of_faces(); ++root)
    {
      if(is_reached[root])
        continue;
      m_roots.push_back(root);
      is_reached[root] = 1;
      std::size_t first = queue.size();
      queue.push_back(root);
      for(; first < queue.size(); ++first)
        for(int h = 3 * queue[first]; h < 3 * queue[first] + 3; ++h)
        {
          const int o = m_mesh.opposite[h];
          if(o < 0 || is_reached[o / 3])
            continue;
          is_reached[o / 3] = 1;
          m_turns[o / 3] = m_turns[h / 3] + period_jump[h];
          m_is_cut[h] = m_is_cut[o] = 0;
          queue.push_back(o / 3);
        }
    }
  }

  void comb(const std::vector<int>& period_jump)
  {
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_mesh.is_border(h))
        m_is_cut[h] = 0;
      else
        m_rotation[h]
          = (period_jump[h] + m_turns[h / 3] - m_turns[m_mesh.opposite[h] / 3]) & 3;
  }

  bool is_regular_inside(int v) const { return m_cone[v] == 4 && !m_mesh.is_border_vertex(v); }

  // removes ends of cuts at regular vertices, where the rotation must be zero
  void prune()
  {
    m_degree.assign(m_mesh.number_of_vertices(), 0);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_is_cut[h])
        ++m_degree[m_mesh.source(h)];
    for(int seed = 0; seed < m_mesh.number_of_vertices(); ++seed)
      for(int v = seed; m_degree[v] == 1 && is_regular_inside(v);)
      {
        const int h = cut_halfedge(v);
        m_is_cut[h] = m_is_cut[m_mesh.opposite[h]] = 0;
        --m_degree[v];
        v = m_mesh.target(h);
        --m_degree[v];
      }
  }

  int cut_halfedge(int v) const
  {
    int found = -1;
    m_mesh.for_each_outgoing(v, [&](int h) { if(m_is_cut[h]) found = h; });
    return found;
  }

  void join_corners()
  {
    m_wedge.assign(m_mesh.number_of_halfedges(), -1);
    for(int v = 0; v < m_mesh.number_of_vertices(); ++v)
    {
      // start behind a cut, if there is one
      int first = m_mesh.vertex_halfedge[v];
      if(!m_mesh.is_border_vertex(v) && m_degree[v] > 0)
        first = cut_halfedge(v);
      int h = first;
      do
      {
        if(h == first || m_is_cut[h])
          ++m_number_of_wedges;
        m_wedge[h] = m_number_of_wedges - 1;
        h = m_mesh.next_around_source(h);
      }
      while(h >= 0 && h != first);
    }
  }

  // branches end at boundary vertices, singularities and where cuts meet
  bool is_node(int v) const { return m_degree[v] != 2 || !is_regular_inside(v); }

  void collect_branches()
  {
    m_branch.assign(m_mesh.number_of_halfedges(), -1);
    m_is_forward.assign(m_mesh.number_of_halfedges(), 0);
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_is_cut[h] && m_branch[h] < 0 && is_node(m_mesh.source(h)))
        walk_branch(h);
    // closed cuts
    for(int h = 0; h < m_mesh.number_of_halfedges(); ++h)
      if(m_is_cut[h] && m_branch[h] < 0)
        walk_branch(h);
  }

  void walk_branch(int h)
  {
    const int b = static_cast<int>(m_branches.size());
    m_branches.emplace_back();
    while(h >= 0)
    {
      m_branch[h] = m_branch[m_mesh.opposite[h]] = b;
      m_is_forward[h] = 1;
      m_branches.back().push_back(h);
      const int v = m_mesh.target(h);
      h = -1;
      if(!is_node(v))
        m_mesh.for_each_outgoing(v, [&](int x) { if(m_is_cut[x] && m_branch[x] < 0) h = x; });
    }
  }

  const Working_mesh& m_mesh;
  const std::vector<int>& m_cone;
  std::vector<char> m_is_cut;           // per halfedge
  std::vector<int> m_turns;             // per face
  std::vector<int> m_rotation;          // per halfedge
  std::vector<int> m_roots;
  std::vector<int> m_degree;            // per vertex: number of cut edges
  std::vector<int> m_wedge;             // per corner
  int m_number_of_wedges = 0;
  std::vector<std::vector<int> > m_branches;
  std::vector<int> m_branch;            // per halfedge
  std::vector<char> m_is_forward;       // per halfedge
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_CUT_GRAPH_H
