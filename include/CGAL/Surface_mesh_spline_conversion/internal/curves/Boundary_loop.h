// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_BOUNDARY_LOOP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_BOUNDARY_LOOP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Curve_joint.h>
#include <CGAL/Surface_mesh_spline_conversion/Curve_segment.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Arc_length_table.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Boundary_association_check.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Oriented_segment.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/seam_parameters.h>

#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The part of a loop between two corners, or a closed loop; see Boundary_curve_network_3.
template <typename TriangleMesh, typename Traits>
struct Boundary_chain
{
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_descriptor;
  typedef typename Traits::FT FT;

  std::size_t loop;
  bool is_closed;
  std::vector<halfedge_descriptor> halfedges;
  std::vector<Curve_segment<Traits> > segments;
  std::vector<Curve_joint<FT> > joints;
  std::vector<FT> surface_seams; // arc lengths
  Arc_length_table<FT> table;
};

// A boundary loop on its way from mesh and curves to chains: read, check, find corners, split.
template <typename TriangleMesh, typename Traits>
class Boundary_loop
{
public:
  typedef std::size_t size_type;
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_descriptor;
  typedef typename Traits::FT FT;
  typedef typename Traits::Point_3 Point_3;
  typedef typename Traits::Vector_3 Vector_3;
  typedef Boundary_chain<TriangleMesh, Traits> Chain;

  Boundary_loop(const TriangleMesh& tm, const Traits& traits, size_type number,
                const std::vector<halfedge_descriptor>& halfedges)
    : m_tm(tm), m_traits(traits), m_number(number), m_halfedges(halfedges)
  {}

  // gathers points, vertex numbers and curves.
  template <typename HalfedgeCurveMap, typename VertexPointMap, typename MeshCheck>
  void read(const HalfedgeCurveMap& halfedge_curve_map, const VertexPointMap& vpm,
            const MeshCheck& mesh_check)
  {
    for(const halfedge_descriptor h : m_halfedges)
    {
      m_points.push_back(get(vpm, source(h, m_tm)));
      m_vertex_numbers.push_back(mesh_check.number(source(h, m_tm)));
      m_segments.push_back(get(halfedge_curve_map, h));
    }
  }

  // returns true if every edge has a curve that fits; else `message()` tells why not.
  bool check_association(const FT& tolerance, const FT& corner_angle)
  {
    m_tolerance = tolerance;
    const Boundary_association_check<Traits> check = association_check();
    m_message = check();
    for(size_type i = 0; i < m_halfedges.size() && m_message.empty(); ++i)
      m_message = check.check_smoothness(i, corner_angle);
    return m_message.empty();
  }

  // A source of an edge is a corner if it is flagged, or if the tangents turn by more than
  // `corner_angle` (in radians).
  template <typename VertexIsConstrainedMap>
  void find_corners(const VertexIsConstrainedMap& is_constrained, const FT& corner_angle,
                    const FT& diameter)
  {
    const size_type n = m_halfedges.size();
    m_joint_continuity.resize(n);
    m_turning_angle.resize(n);
    for(size_type i = 0; i < n; ++i)
    {
      m_turning_angle[i] = turning_angle(i);
      const bool is_corner = m_turning_angle[i] > corner_angle
                             || get(is_constrained, source(m_halfedges[i], m_tm));
      if(is_corner)
        m_joint_continuity[i] = CORNER;
      else if(!is_curvature_continuous(i, diameter))
        m_joint_continuity[i] = TANGENT_CONTINUOUS;
      else
        m_joint_continuity[i] = is_same_curve(i) ? NO_JOINT : CURVATURE_CONTINUOUS;
    }
  }

  // appends the chains in their order along the loop, beginning with that of the first corner.
  // A closed chain begins at a joint if there is one.
  void append_chains(std::vector<Chain>& chains)
  {
    const size_type n = m_halfedges.size();
    std::vector<size_type> corners;
    for(size_type i = 0; i < n; ++i)
      if(m_joint_continuity[i] == CORNER)
        corners.push_back(i);
    if(corners.empty())
    {
      const auto joint = std::find_if(m_joint_continuity.begin(), m_joint_continuity.end(),
                                      [](Joint_continuity c) { return c != NO_JOINT; });
      const size_type begin = (joint == m_joint_continuity.end())
                                ? 0 : static_cast<size_type>(joint - m_joint_continuity.begin());
      append_chain(begin, n, true, chains);
    }
    for(size_type k = 0; k < corners.size() && m_message.empty(); ++k)
    {
      const size_type end = (k + 1 < corners.size()) ? corners[k + 1] : corners[0] + n;
      append_chain(corners[k], end - corners[k], false, chains);
    }
  }

  // returns what is wrong with the loop, or an empty string.
  const std::string& message() const { return m_message; }

private:
  // how the curves meet at a vertex; the middle values are those of Curve_joint
  enum Joint_continuity
  {
    CORNER = 0,
    TANGENT_CONTINUOUS = 1,
    CURVATURE_CONTINUOUS = 2,
    NO_JOINT = 3
  };

  Boundary_association_check<Traits> association_check() const
  {
    return Boundary_association_check<Traits>(m_traits, m_number, m_points, m_vertex_numbers,
                                              m_segments, m_tolerance);
  }

  // appends the chain of the given number of edges from edge `begin`.
  void append_chain(size_type begin, size_type number_of_edges, bool is_closed,
                    std::vector<Chain>& chains)
  {
    Chain chain;
    chain.loop = m_number;
    chain.is_closed = is_closed;
    for(size_type k = 0; k < number_of_edges; ++k)
    {
      const size_type i = (begin + k) % m_halfedges.size();
      if(m_joint_continuity[i] != CORNER && m_joint_continuity[i] != NO_JOINT)
        chain.joints.push_back(Curve_joint<FT>{k, chain.table.length(), m_joint_continuity[i],
                                               m_turning_angle[i]});
      if(!append_edge(i, chain))
        return;
    }
    find_surface_seams(chain);
    chains.push_back(std::move(chain));
  }

  // finds the arc lengths at which the curves of a chain pass through the seams of their surfaces
  void find_surface_seams(Chain& chain) const
  {
    std::vector<FT> parameters; // of the curve of the edge
    for(size_type k = 0; k < chain.segments.size(); ++k)
    {
      const Curve_segment<Traits>& s = chain.segments[k];
      if(k == 0 || !(s.curve == chain.segments[k - 1].curve))
        parameters = seam_parameters(m_traits, s.curve);
      for(const FT& t : parameters)
        if((std::min)(s.first, s.second) <= t && t < (std::max)(s.first, s.second))
          chain.surface_seams.push_back(chain.table.arc_length(k, t));
    }
    std::sort(chain.surface_seams.begin(), chain.surface_seams.end());
  }

  bool append_edge(size_type i, Chain& chain)
  {
    const Oriented_segment<Traits> curve(m_traits, m_segments[i]);
    const FT begin = chain.table.length();
    chain.halfedges.push_back(m_halfedges[i]);
    chain.segments.push_back(m_segments[i]);
    if(!chain.table.append_edge([&](const FT& t) { return curve.speed(t); },
                                m_segments[i].first, m_segments[i].second))
      m_message = association_check().edge_name(i)
                  + ": the curve has no finite positive length; correct its parameters.";
    else
      m_message = association_check().check_length(i, chain.table.length() - begin);
    return m_message.empty();
  }

  FT turning_angle(size_type i) const
  {
    const Vector_3 in = before(i).derivative_at_end(1), out = after(i).derivative_at_begin(1);
    return std::atan2(std::sqrt(cross_product(in, out).squared_length()), in * out);
  }

  bool is_curvature_continuous(size_type i, const FT& diameter) const
  {
    // A smaller jump changes a spline fit by less than it can resolve: at spans of D/40 about
    // 1e-8 D. Curves of a CAD system that are said to be G2 agree to about 1e-5.
    const FT relative_tolerance(1e-3);
    const Vector_3 in = before(i).derivative_at_end(2), out = after(i).derivative_at_begin(2);
    const FT scale = (std::max)({in.squared_length(), out.squared_length(),
                                 FT(1) / (diameter * diameter)});
    return (in - out).squared_length() <= relative_tolerance * relative_tolerance * scale;
  }

  // returns true if the parameter of one curve runs through the source of edge i.
  bool is_same_curve(size_type i) const
  {
    const Curve_segment<Traits>& last = m_segments[previous(i)];
    return last.curve == m_segments[i].curve && last.second == m_segments[i].first;
  }

  Oriented_segment<Traits> before(size_type i) const
  {
    return Oriented_segment<Traits>(m_traits, m_segments[previous(i)]);
  }

  Oriented_segment<Traits> after(size_type i) const
  {
    return Oriented_segment<Traits>(m_traits, m_segments[i]);
  }

  size_type previous(size_type i) const { return (i == 0 ? m_halfedges.size() : i) - 1; }

  const TriangleMesh& m_tm;
  const Traits& m_traits;
  size_type m_number;
  const std::vector<halfedge_descriptor>& m_halfedges;
  std::vector<Point_3> m_points;
  std::vector<size_type> m_vertex_numbers;
  std::vector<Curve_segment<Traits> > m_segments;
  std::vector<FT> m_turning_angle;
  std::vector<Joint_continuity> m_joint_continuity;
  FT m_tolerance = FT(0);
  std::string m_message;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_BOUNDARY_LOOP_H
