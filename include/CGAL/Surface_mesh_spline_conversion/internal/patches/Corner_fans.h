// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_CORNER_FANS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_CORNER_FANS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Mesh_projection.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/split_corners.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Turns the lines of a layout that leave a corner of the boundary between two quads, where one of
// these has an angle close to a straight one, or above it. No surface can follow such a line: it
// leaves the corner along the bisector of the interior angle, see Corner_tangents, and would have to
// turn from there to the line within its first patch, which folds it over. Smaller patches do not
// help, as the faces of the mesh around the corner look the same at each scale.
//
// The faces around the corner are developed into the plane. Points at the distance r from the corner
// keep r and move around it: the line to an angle between its own and that of the bisector, by the
// logarithm of r, and the angles on both sides of the line in proportion.
template <typename Layout>
class Corner_fans
{
  typedef std::size_t size_type;
  typedef typename Layout::FT FT;
  typedef typename Layout::Point_3 Point_3;
  typedef typename Layout::Location Location;
  typedef Eigen::Vector3d Vector;

public:
  Corner_fans(const Layout& layout, const Mesh_projection& mesh) : m_mesh(mesh)
  {
    for_each_split_corner(layout, [&](size_type first, int i, size_type, int)
      { add_fan(layout, first, i); });
  }

  // returns where the point of a layout shall be
  Location operator()(const Location& at) const
  {
    const auto range = m_sectors_of_face.equal_range(at.face);
    for(auto it = range.first; it != range.second; ++it)
    {
      const Fan& fan = m_fans[it->second.first];
      const Vector d = to_eigen(at.point) - fan.center;
      if(d.norm() < fan.radius && d.norm() > 0)
        return turn(fan, fan.sectors[it->second.second], d);
    }
    return at;
  }

private:
  // a face at the corner, in the plane of polar coordinates around this
  struct Sector
  {
    size_type face, corner; // which of the vertices of the face is the corner?
    double begin, end;      // angles
    Vector x, y;            // directions at the begin, and perpendicular to it in the face
  };

  struct Fan
  {
    Vector center;
    std::vector<Sector> sectors; // from the outgoing edge of the boundary to the incoming one
    double radius = 0, line = 0; // angle of the line

    double angle() const { return sectors.back().end; }
  };

  // larger angles of a quad at a corner are turned away (in radians)
  static constexpr double largest_angle = 0.9 * CGAL_PI;

  // the line has reached the bisector at that share of the radius
  static constexpr double inner_share = 1. / 16;

  Vector vertex(size_type face, size_type i) const
  {
    return to_eigen(m_mesh.vertex(m_mesh.corners(face)[i % 3]));
  }

  // the corner is the end of side `i` of `quad`
  void add_fan(const Layout& layout, size_type quad, int i)
  {
    const auto uv = from_side<FT>(i, FT(1), FT(0));
    const Location corner = layout.inverse_map()(quad, uv[0], uv[1]);
    const auto largest = std::max_element(corner.barycentric.begin(), corner.barycentric.end());
    Fan fan = make_fan(corner.face, size_type(largest - corner.barycentric.begin()));
    if(fan.sectors.empty() || !find_line(layout, quad, i, fan)
       || (std::max)(fan.line, fan.angle() - fan.line) <= largest_angle)
      return;
    for(size_type s = 0; s < fan.sectors.size(); ++s)
      m_sectors_of_face.emplace(fan.sectors[s].face, std::make_pair(m_fans.size(), s));
    m_fans.push_back(fan);
  }

  // collects the faces around a vertex of the boundary, a corner of the given face; none around
  // other vertices
  Fan make_fan(size_type face, size_type corner) const
  {
    constexpr double share = 0.5; // then fans of neighboring corners are disjoint
    const size_type v = m_mesh.corners(face)[corner];
    size_type first = face;
    for(size_type f = before(face, v); f != Mesh_projection::none; f = before(f, v))
    {
      if(f == face)
        return Fan();
      first = f;
    }
    Fan fan;
    fan.radius = (std::numeric_limits<double>::max)();
    fan.center = vertex(face, corner);
    double angle = 0;
    for(size_type f = first; f != Mesh_projection::none; f = m_mesh.neighbors(f)[number(f, v)])
    {
      const size_type k = number(f, v);
      const Vector a = vertex(f, k + 1) - fan.center, b = vertex(f, k + 2) - fan.center;
      const Vector x = a.normalized(), y = (b - b.dot(x) * x).normalized();
      fan.radius = (std::min)(fan.radius, share * a.cross(b).norm() / (b - a).norm());
      fan.sectors.push_back(Sector{f, k, angle, angle + std::atan2(b.dot(y), b.dot(x)), x, y});
      angle = fan.angle();
    }
    return fan;
  }

  // returns the face before another one, counter clockwise around a vertex
  size_type before(size_type face, size_type v) const
  {
    return m_mesh.neighbors(face)[(number(face, v) + 1) % 3];
  }

  // returns which of the vertices of a face `v` is
  size_type number(size_type face, size_type v) const
  {
    const std::array<size_type, 3>& corners = m_mesh.corners(face);
    return size_type(std::find(corners.begin(), corners.end(), v) - corners.begin());
  }

  // finds the angle of the line that begins at the end of side `i` of `quad`
  static bool find_line(const Layout& layout, size_type quad, int i, Fan& fan)
  {
    constexpr int maximum_number_of_steps = 16;
    double inwards = 1. / 64;
    for(int step = 0; step < maximum_number_of_steps; ++step, inwards /= 4)
    {
      const auto uv = from_side<FT>(i, FT(1), FT(inwards));
      const Location at = layout.inverse_map()(quad, uv[0], uv[1]);
      const Vector d = to_eigen(at.point) - fan.center;
      for(const Sector& s : fan.sectors)
        if(s.face == at.face && d.norm() < fan.radius)
        {
          fan.line = angle(s, d);
          return 0 < fan.line && fan.line < fan.angle();
        }
    }
    return false;
  }

  static double angle(const Sector& s, const Vector& d)
  {
    return (std::min)((std::max)(s.begin + std::atan2(d.dot(s.y), d.dot(s.x)), s.begin), s.end);
  }

  // `d`: from the corner to a point of the sector
  Location turn(const Fan& fan, const Sector& sector, const Vector& d) const
  {
    const double r = d.norm(), phi = angle(sector, d), total = fan.angle();
    const double share
      = (std::min)(1., std::log(r / fan.radius) / std::log(inner_share));
    const double line = fan.line + share * (total / 2 - fan.line);
    const double turned = phi < fan.line
                            ? phi * line / fan.line
                            : total - (total - phi) * (total - line) / (total - fan.line);
    auto s = fan.sectors.begin();
    while(s + 1 != fan.sectors.end() && s->end < turned)
      ++s;
    return location(*s, fan.center, r, turned - s->begin);
  }

  // the point at an angle and a distance from the corner of a face
  Location location(const Sector& s, const Vector& center, double r, double angle) const
  {
    const Vector d = r * (std::cos(angle) * s.x + std::sin(angle) * s.y);
    const Vector a = vertex(s.face, s.corner + 1) - center, b = vertex(s.face, s.corner + 2) - center;
    Location result;
    result.face = s.face;
    result.point = Point_3(FT(center[0] + d[0]), FT(center[1] + d[1]), FT(center[2] + d[2]));
    const double weight_b = d.dot(s.y) / b.dot(s.y);
    const double weight_a = (d.dot(s.x) - weight_b * b.dot(s.x)) / a.dot(s.x);
    result.barycentric[s.corner] = FT(1 - weight_a - weight_b);
    result.barycentric[(s.corner + 1) % 3] = FT(weight_a);
    result.barycentric[(s.corner + 2) % 3] = FT(weight_b);
    return result;
  }

  const Mesh_projection& m_mesh;
  std::vector<Fan> m_fans;
  std::unordered_multimap<size_type, std::pair<size_type, size_type> > m_sectors_of_face; // and fan
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_CORNER_FANS_H
