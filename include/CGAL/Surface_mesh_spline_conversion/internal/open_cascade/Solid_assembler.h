// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_SOLID_ASSEMBLER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_SOLID_ASSEMBLER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/volume.h>

#include <BRepClass3d_SolidClassifier.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Assembles faces that share edges to shells, and closed shells to solids. The faces of a shell
/// are oriented like its first one; a shell that is turned inside out is a cavity of the solid
/// around it if there is one.
class Solid_assembler
{
  static constexpr std::size_t NONE = (std::numeric_limits<std::size_t>::max)();

public:
  explicit Solid_assembler(const std::vector<TopoDS_Face>& faces) : m_faces(faces)
  {
    for(std::size_t f = 0; f < faces.size(); ++f)
      for(TopExp_Explorer x(faces[f], TopAbs_EDGE); x.More(); x.Next())
      {
        const TopoDS_Edge& edge = TopoDS::Edge(x.Current());
        if(BRep_Tool::Degenerated(edge))
          continue;
        const std::size_t e = m_edges.Add(edge);
        m_uses.resize((std::max)(m_uses.size(), e + 1));
        m_uses[e].push_back({f, edge.Orientation() == TopAbs_FORWARD});
      }
  }

  std::size_t number_of_free_edges() const
  {
    std::size_t n = 0;
    for(const auto& uses : m_uses)
      n += (uses.size() == 1);
    return n;
  }

  /// returns a solid, a shell, or a compound of several ones.
  TopoDS_Shape operator()()
  {
    std::vector<TopoDS_Shape> parts = shells();
    std::vector<TopoDS_Shape> cavities, result;
    for(const TopoDS_Shape& shell : parts)
      if(!shell.Closed())
        result.push_back(shell);
      else if(volume(shell) < 0)
        cavities.push_back(shell);
      else
        result.push_back(solid(shell));
    const std::size_t number_of_parts = result.size();
    for(const TopoDS_Shape& cavity : cavities)
    {
      const std::size_t i = surrounding_solid(result, number_of_parts, cavity);
      if(i == NONE)
        result.push_back(solid(cavity.Reversed()));
      else
        BRep_Builder().Add(result[i], cavity);
    }
    return (result.size() == 1) ? result.front() : compound(result);
  }

private:
  struct Use
  {
    std::size_t face;
    bool is_forward;
  };

  std::vector<TopoDS_Shape> shells()
  {
    std::vector<std::vector<std::size_t> > edges_of_face(m_faces.size());
    for(std::size_t e = 0; e < m_uses.size(); ++e)
      for(const Use& use : m_uses[e])
        edges_of_face[use.face].push_back(e);
    std::vector<TopoDS_Shape> result;
    std::vector<char> is_reached(m_faces.size(), false), is_turned(m_faces.size(), false);
    for(std::size_t f = 0; f < m_faces.size(); ++f)
    {
      if(is_reached[f])
        continue;
      is_reached[f] = true;
      std::vector<std::size_t> queue(1, f);
      for(std::size_t i = 0; i < queue.size(); ++i)
        for(std::size_t e : edges_of_face[queue[i]])
          reach_across(e, queue[i], is_reached, is_turned, queue);
      result.push_back(shell(queue, is_turned, edges_of_face));
    }
    return result;
  }

  void reach_across(std::size_t e, std::size_t face, std::vector<char>& is_reached,
                    std::vector<char>& is_turned, std::vector<std::size_t>& queue) const
  {
    if(m_uses[e].size() != 2)
      return;
    const std::size_t here = (m_uses[e][0].face == face) ? 0 : 1;
    const Use& other = m_uses[e][1 - here];
    if(is_reached[other.face])
      return;
    is_reached[other.face] = true;
    is_turned[other.face]
      = (is_turned[face] != (m_uses[e][here].is_forward == other.is_forward));
    queue.push_back(other.face);
  }

  TopoDS_Shape shell(const std::vector<std::size_t>& faces, const std::vector<char>& is_turned,
                     const std::vector<std::vector<std::size_t> >& edges_of_face) const
  {
    BRep_Builder builder;
    TopoDS_Shell result;
    builder.MakeShell(result);
    bool is_closed = true;
    for(std::size_t f : faces)
    {
      builder.Add(result, is_turned[f] ? m_faces[f].Reversed() : TopoDS_Shape(m_faces[f]));
      for(std::size_t e : edges_of_face[f])
        is_closed = is_closed && m_uses[e].size() == 2;
    }
    result.Closed(is_closed);
    return result;
  }

  static TopoDS_Shape solid(const TopoDS_Shape& shell)
  {
    TopoDS_Solid result;
    BRep_Builder().MakeSolid(result);
    BRep_Builder().Add(result, shell);
    return result;
  }

  static std::size_t surrounding_solid(const std::vector<TopoDS_Shape>& parts,
                                       std::size_t number_of_parts, const TopoDS_Shape& cavity)
  {
    const TopExp_Explorer x(cavity, TopAbs_VERTEX);
    if(!x.More())
      return NONE;
    const gp_Pnt p = BRep_Tool::Pnt(TopoDS::Vertex(x.Current()));
    for(std::size_t i = 0; i < number_of_parts; ++i)
      if(parts[i].ShapeType() == TopAbs_SOLID
         && BRepClass3d_SolidClassifier(parts[i], p, Precision::Confusion()).State() == TopAbs_IN)
        return i;
    return NONE;
  }

  static TopoDS_Shape compound(const std::vector<TopoDS_Shape>& parts)
  {
    TopoDS_Compound result;
    BRep_Builder().MakeCompound(result);
    for(const TopoDS_Shape& part : parts)
      BRep_Builder().Add(result, part);
    return result;
  }

  std::vector<TopoDS_Face> m_faces;
  TopTools_IndexedMapOfShape m_edges;   // regardless of orientation
  std::vector<std::vector<Use> > m_uses; // by the index in m_edges
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_SOLID_ASSEMBLER_H
