// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_BOUNDARY_ASSOCIATION_CHECK_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_BOUNDARY_ASSOCIATION_CHECK_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Oriented_segment.h>

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The checks of one boundary loop: does every edge have a curve that leads from its source to its
// target, in the right direction?
template <typename Traits>
class Boundary_association_check
{
public:
  typedef std::size_t size_type;
  typedef typename Traits::FT FT;
  typedef typename Traits::Point_3 Point_3;
  typedef typename Traits::Vector_3 Vector_3;
  typedef Curve_segment<Traits> Segment;

  // `points` and `numbers` belong to the sources of the edges of the loop, `segments` to the edges.
  Boundary_association_check(const Traits& traits, size_type loop,
                             const std::vector<Point_3>& points,
                             const std::vector<size_type>& numbers,
                             const std::vector<Segment>& segments, const FT& tolerance)
    : m_traits(traits), m_loop(loop), m_points(points), m_numbers(numbers),
      m_segments(segments), m_tolerance(tolerance)
  {}

  // returns a message on the first defect, or an empty string.
  std::string operator()() const
  {
    for(const auto check : {&Self::check_presence, &Self::check_finiteness})
      for(size_type i = 0; i < m_segments.size(); ++i)
        if(const std::string defect = (this->*check)(i); !defect.empty())
          return edge_name(i) + ": " + defect;
    if(const std::string defect = check_reversed_loop(); !defect.empty())
      return defect;
    for(const auto check : {&Self::check_reversed_edge, &Self::check_direction,
                            &Self::check_monotonicity, &Self::check_ends})
      for(size_type i = 0; i < m_segments.size(); ++i)
        if(const std::string defect = (this->*check)(i); !defect.empty())
          return edge_name(i) + ": " + defect;
    return std::string();
  }

  // checks the length of the curve of edge i.
  std::string check_length(size_type i, const FT& length) const
  {
    // A circular arc reaches pi/2 where it would run against the edge; beyond twice of that, the
    // parameters are wrong (one turn too many) or the mesh does not follow the curve.
    const FT maximum_ratio(4);
    const FT chord = distance(m_points[i], m_points[next(i)]);
    if(length <= maximum_ratio * chord + m_tolerance)
      return std::string();
    return edge_name(i) + ": the curve between the parameters " + number(m_segments[i].first)
           + " and " + number(m_segments[i].second) + " is " + number(length / chord)
           + " times as long as the edge; the parameters may lead around a closed curve, or the "
             "mesh is too coarse there.";
  }

  // checks that the tangent of the curve of edge i does not jump by more than `corner_angle` (in
  // radians) between its ends. An interval of parameters in which the tangent turns by more is
  // bisected towards the larger turn: of a smooth curve the turn decreases with the width, across a
  // jump it does not.
  std::string check_smoothness(size_type i, const FT& corner_angle) const
  {
    const int number_of_intervals = 8;
    const FT smallest_width(1e-7); // relative to the segment, far above the rounding of parameters
    const Oriented_segment<Traits> curve(m_traits, m_segments[i]);
    const FT first = m_segments[i].first, second = m_segments[i].second;
    const auto tangent = [&](const FT& x)
      { return curve.derivative((FT(1) - x) * first + x * second, 1); };
    for(int k = 0; k < number_of_intervals; ++k)
    {
      FT low = FT(k) / FT(number_of_intervals), high = FT(k + 1) / FT(number_of_intervals);
      while(angle(tangent(low), tangent(high)) > corner_angle)
      {
        const FT middle = (low + high) / FT(2);
        if(high - low < smallest_width)
          return edge_name(i) + ": the tangent of the curve jumps at the parameter "
                 + number((FT(1) - middle) * first + middle * second)
                 + " between the ends of the edge; the mesh needs a vertex there.";
        const bool is_left = angle(tangent(low), tangent(middle))
                             > angle(tangent(middle), tangent(high));
        (is_left ? high : low) = middle;
      }
    }
    return std::string();
  }

  // names edge i in a message.
  std::string edge_name(size_type i) const
  {
    return "Loop " + std::to_string(m_loop) + ", edge " + std::to_string(i) + " (vertices "
           + std::to_string(m_numbers[i]) + " to " + std::to_string(m_numbers[next(i)]) + ")";
  }

private:
  typedef Boundary_association_check Self;

  std::string check_presence(size_type i) const
  {
    if(!m_segments[i].is_empty())
      return std::string();
    return "no curve is assigned (both parameters are " + number(m_segments[i].first)
           + "); assign a curve segment to the halfedge whose face lies in the mesh, or call "
             "interpolate_boundary_curves().";
  }

  std::string check_finiteness(size_type i) const
  {
    const Segment& s = m_segments[i];
    if(!std::isfinite(s.first) || !std::isfinite(s.second))
      return "a parameter of the curve is not a finite number.";
    const Oriented_segment<Traits> curve(m_traits, s);
    for(const FT& t : {s.first, s.second, (s.first + s.second) / FT(2)})
      if(!is_finite(curve.point(t) - m_points[i]) || !is_finite(curve.derivative(t, 1)))
        return "the point or the tangent of the curve at the parameter " + number(t)
               + " is not finite, or the tangent vanishes.";
    return std::string();
  }

  // A loop all of whose edges are reversed has one cause, and gets one message.
  std::string check_reversed_loop() const
  {
    for(size_type i = 0; i < m_segments.size(); ++i)
      if(!is_reversed(i))
        return std::string();
    return "Loop " + std::to_string(m_loop) + " (beginning with vertices "
           + std::to_string(m_numbers[0]) + " to " + std::to_string(m_numbers[next(0)])
           + "): the curves of all edges run against the loop; the segments must be assigned to "
             "the halfedges whose faces lie in the mesh, and run from source to target.";
  }

  std::string check_reversed_edge(size_type i) const
  {
    if(!is_reversed(i))
      return std::string();
    return "the curve runs against the edge; exchange the parameters " + number(m_segments[i].first)
           + " and " + number(m_segments[i].second) + ".";
  }

  // Along consecutive edges of the same curve the parameter must run on, but for a jump between
  // parameters of the same point (the seam of a closed curve).
  std::string check_monotonicity(size_type i) const
  {
    const Segment& s = m_segments[i];
    const Segment& t = m_segments[next(i)];
    if(m_segments.size() == 1 || !(s.curve == t.curve))
      return std::string();
    const bool is_jump = s.second != t.first;
    const bool is_same_direction = (s.first < s.second) == (t.first < t.second);
    const Oriented_segment<Traits> curve(m_traits, s);
    const bool is_same_point
      = distance(curve.point(s.second), curve.point(t.first)) <= FT(2) * m_tolerance;
    if(is_same_point && (is_jump || is_same_direction))
      return std::string();
    return "the parameter is not monotone: it runs from " + number(s.first) + " to "
           + number(s.second) + ", and on the next edge of the same curve from " + number(t.first)
           + " to " + number(t.second) + ".";
  }

  std::string check_ends(size_type i) const
  {
    const Segment& s = m_segments[i];
    const Oriented_segment<Traits> curve(m_traits, s);
    const FT source_distance = distance(curve.point(s.first), m_points[i]);
    if(!(source_distance <= m_tolerance))
      return end_message(m_numbers[i], s.first, source_distance);
    const FT target_distance = distance(curve.point(s.second), m_points[next(i)]);
    if(!(target_distance <= m_tolerance))
      return end_message(m_numbers[next(i)], s.second, target_distance);
    return std::string();
  }

  std::string end_message(size_type vertex, const FT& t, const FT& distance) const
  {
    return "the point of the curve at the parameter " + number(t) + " is " + number(distance)
           + " away from vertex " + std::to_string(vertex) + ", more than the tolerance "
           + number(m_tolerance) + "; correct the parameter, or move the vertex onto the curve.";
  }

  // An arc of more than half a turn leaves and arrives against the direction of its edge: then the
  // parameters lead the long way round a closed curve. (Where not even the ends fit, there are
  // better messages.)
  std::string check_direction(size_type i) const
  {
    const Oriented_segment<Traits> curve(m_traits, m_segments[i]);
    const Vector_3 chord = m_points[next(i)] - m_points[i];
    const bool is_against = check_ends(i).empty()
                            && curve.derivative_at_begin(1) * chord < FT(0)
                            && curve.derivative_at_end(1) * chord < FT(0);
    if(!is_against)
      return std::string();
    return "the curve runs against the edge at both ends; the parameters "
           + number(m_segments[i].first) + " and " + number(m_segments[i].second)
           + " lead the long way round, or the mesh is too coarse there.";
  }

  bool is_reversed(size_type i) const
  {
    const Oriented_segment<Traits> curve(m_traits, m_segments[i]);
    const Point_3 begin = curve.point(m_segments[i].first), end = curve.point(m_segments[i].second);
    const Point_3 &source = m_points[i], &target = m_points[next(i)];
    return distance(begin, target) <= m_tolerance && distance(end, source) <= m_tolerance
           && distance(begin, source) > m_tolerance && distance(end, target) > m_tolerance;
  }

  size_type next(size_type i) const { return (i + 1 == m_points.size()) ? 0 : i + 1; }

  static FT distance(const Point_3& p, const Point_3& q)
  {
    return std::sqrt((p - q).squared_length());
  }

  static FT angle(const Vector_3& a, const Vector_3& b)
  {
    return std::atan2(std::sqrt(cross_product(a, b).squared_length()), a * b);
  }

  static bool is_finite(const Vector_3& v) { return std::isfinite(v.squared_length()); }

  static std::string number(const FT& value)
  {
    std::ostringstream stream;
    stream.precision(12);
    stream << value;
    return stream.str();
  }

  const Traits& m_traits;
  size_type m_loop;
  const std::vector<Point_3>& m_points;
  const std::vector<size_type>& m_numbers;
  const std::vector<Segment>& m_segments;
  FT m_tolerance;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_BOUNDARY_ASSOCIATION_CHECK_H
