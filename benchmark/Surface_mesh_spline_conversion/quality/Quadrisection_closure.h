// The refinement rules of the paper (3.2.4, 3.3.4): patches are quadrisected.
#ifndef QUALITY_QUADRISECTION_CLOSURE_H
#define QUALITY_QUADRISECTION_CLOSURE_H

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/Refinement_closure.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

// Refines a T-mesh by the rules of the paper:
//  - faces of the 0-channel are bisected, on both rows (Fig. 8 b); neighbouring intervals differ
//    at most by a factor of two;
//  - a patch whose side on the 0-channel is more than twice as long as the shortest edge there is
//    quadrisected (Fig. 8 c), and so is one with more than four times the area of a neighbour;
//  - greedily, until the basis is standard: patches in which extensions of T-junctions cross are
//    quadrisected (`Standardization::QUADRISECTION`), or left to the closure of the package
//    (`Standardization::EXTENSION`).
// Quadrisection alone cannot end in a standard basis unless the whole surface is uniform: at each
// convex corner of a refined region, two extensions meet in the middle of a refined patch, and the
// functions do not sum up to one. The paper does not say what it does there; here, the
// closure of the package extends one of the two by one bay. It also keeps the surroundings of
// extraordinary points uniform, as the evaluation demands.
enum class Standardization { QUADRISECTION, EXTENSION };

template <typename Point>
class Quadrisection_closure
{
  typedef CGAL::Surface_mesh_spline_conversion::internal::T_mesh<Point> Mesh;
  typedef CGAL::Surface_mesh_spline_conversion::internal::Face_origin Face_origin;
  typedef typename Mesh::Vertex Vertex;
  typedef typename Mesh::Halfedge Halfedge;
  typedef typename Mesh::Face Face;

public:
  Quadrisection_closure(Mesh& mesh, std::vector<std::int64_t>& units,
                        Standardization standardization)
    : m_mesh(mesh), m_units(units), m_standardization(standardization)
  {}

  // marks a patch to be quadrisected, or a face of the 0-channel to be bisected
  void mark(Face f)
  {
    const bool is_patch = m_mesh.is_patch(f);
    if((is_patch || m_mesh.origin(f).kind == Face_origin::CHANNEL) && size(f, 0) > 1
       && (!is_patch || size(f, 1) > 1))
      m_marks.insert(f);
  }

  // refines the marked faces, and restores all rules; \pre the mesh is up to date
  void run()
  {
    typedef CGAL::Surface_mesh_spline_conversion::internal::Refinement_closure<Point> Closure;
    do
    {
      do
      {
        split_marked_faces();
        mark_channels();
        mark_patches();
        if(m_marks.empty())
          mark_crossed_patches();
      }
      while(!m_marks.empty());
      Closure(m_mesh, m_units).run();
      mark_channels();
      mark_patches();
      mark_crossed_patches();
    }
    while(!m_marks.empty());
  }

private:
  // notes in which directions the faces are cut by extensions of T-junctions
  struct Recorder
  {
    std::vector<unsigned char>& axes; // a bit per axis, for each face

    void on_face(Face f, int axis) { axes[f] |= static_cast<unsigned char>(1 << axis); }
    void on_edge(Halfedge) {}
    void on_crossing(Halfedge) {}
    void on_vertex(Vertex, int) {}
  };

  std::int64_t size(Face f, int axis) const
  {
    return CGAL::Surface_mesh_spline_conversion::internal::rounded_parameter(
      m_mesh.extent(f, axis));
  }
  std::int64_t size(Halfedge h) const
  {
    return CGAL::Surface_mesh_spline_conversion::internal::rounded_parameter(m_mesh.length(h));
  }
  std::int64_t area(Face f) const { return size(f, 0) * size(f, 1); }

  void split_marked_faces()
  {
    for(Face f : m_marks)
    {
      const bool is_patch = m_mesh.is_patch(f);
      for(Face part : m_mesh.bisect(f, 0))
        if(is_patch)
          m_mesh.bisect(part, 1);
    }
    m_marks.clear();
    m_mesh.update();
  }

  // a face of the 0-channel has the knots of the patches beside it, and is graded along the
  // boundary
  void mark_channels()
  {
    for(Halfedge h : m_mesh.mesh().halfedges())
      if(m_mesh.is_border(m_mesh.opposite(h)) && is_channel(m_mesh.face(h)))
      {
        const Face f = m_mesh.face(h);
        Halfedge row_1 = m_mesh.first_of_side(f, 2);
        if(!m_mesh.is_corner(row_1))
          mark(f);
        Face next = f; // along the boundary, past the face at a convex corner
        Halfedge g = h;
        do
        {
          g = m_mesh.opposite(m_mesh.prev(m_mesh.opposite(g)));
          next = m_mesh.face(g);
        }
        while(next == f || !is_channel(next));
        if(size(f, 0) > 2 * size(next, 0))
          mark(f);
        if(size(next, 0) > 2 * size(f, 0))
          mark(next);
      }
  }

  bool is_channel(Face f) const { return m_mesh.origin(f).kind == Face_origin::CHANNEL; }

  void mark_patches()
  {
    for(Halfedge h : m_mesh.mesh().halfedges())
      if(!m_mesh.is_border(h) && !m_mesh.is_border(m_mesh.opposite(h))
         && m_mesh.is_patch(m_mesh.face(h))
         && is_channel(m_mesh.face(m_mesh.opposite(h))) && size(h) > 0
         && size(m_mesh.face(h), m_mesh.side(h) & 1) > 2 * size(h))
        mark(m_mesh.face(h));
    for(Vertex v : m_mesh.mesh().vertices())
    {
      std::int64_t smallest = 0;
      for(Halfedge h : m_mesh.mesh().halfedges_around_target(m_mesh.mesh().halfedge(v)))
        if(!m_mesh.is_border(h) && m_mesh.is_patch(m_mesh.face(h)))
        {
          const std::int64_t a = area(m_mesh.face(h));
          smallest = smallest == 0 ? a : (std::min)(smallest, a);
        }
      for(Halfedge h : m_mesh.mesh().halfedges_around_target(m_mesh.mesh().halfedge(v)))
        if(!m_mesh.is_border(h) && m_mesh.is_patch(m_mesh.face(h))
           && area(m_mesh.face(h)) > 4 * smallest)
          mark(m_mesh.face(h));
    }
  }

  void mark_crossed_patches()
  {
    if(m_standardization == Standardization::EXTENSION)
      return;
    std::vector<unsigned char> axes(m_mesh.mesh().num_faces(), 0);
    Recorder recorder{axes};
    for(Vertex v : m_mesh.mesh().vertices())
      for(int d = 0; d < 4; ++d)
        if(!m_mesh.is_extraordinary(v) && m_mesh.star(v).into[d].is_valid())
        {
          m_mesh.follow(v, d, 2, recorder);
          m_mesh.follow(v, (d + 2) & 3, 1, recorder);
        }
    for(Face f : m_mesh.mesh().faces())
      if(axes[f] == 3)
        mark(f);
  }

  Mesh& m_mesh;
  std::vector<std::int64_t>& m_units;
  Standardization m_standardization;
  std::set<Face> m_marks;
};

#endif // QUALITY_QUADRISECTION_CLOSURE_H
