// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_SURFACE_WALK_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_SURFACE_WALK_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// barycentric coordinates of the point of a triangle that is closest to `p`
inline std::array<double, 3> closest_point_of_triangle(
  const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector3d& p)
{
  const Eigen::Vector3d normal
    = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double squared_area = normal.squaredNorm();
  std::array<double, 3> b;
  bool is_inside = squared_area > 0;
  for(int i = 0; i < 3 && is_inside; ++i)
  {
    b[i] = normal.dot((triangle[(i + 1) % 3] - p).cross(triangle[(i + 2) % 3] - p))
           / squared_area;
    is_inside = b[i] >= 0;
  }
  if(is_inside)
    return b;
  double smallest = std::numeric_limits<double>::infinity();
  for(int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    const Eigen::Vector3d e = triangle[j] - triangle[i];
    const double length = e.squaredNorm();
    const double t
      = length > 0 ? (std::max)(0., (std::min)(1., e.dot(p - triangle[i]) / length)) : 0;
    const double distance = (triangle[i] + t * e - p).squaredNorm();
    if(distance < smallest)
    {
      smallest = distance;
      b[i] = 1 - t;
      b[j] = t;
      b[3 - i - j] = 0;
    }
  }
  return b;
}

// Finds points of a mesh near a given face, by steps from face to face: other sheets of the surface
// that happen to be close are never reached.
class Surface_walk
{
public:
  explicit Surface_walk(const Working_mesh& mesh) : m_mesh(&mesh) {}

  Eigen::Vector3d point(const Working_location& location) const
  {
    return point_at(*m_mesh, location);
  }

  // the point where the line through `q` in the direction `n` meets the mesh, or the closest point
  // if there is none; the walk starts at `face`
  Working_location project(const Eigen::Vector3d& q, const Eigen::Vector3d& n, int face) const
  {
    Meeting meeting;
    return meet(q, n, face, meeting) ? meeting.location : closest_point(q, face);
  }

  // The same, but for a point not farther from `q` than `largest_distance`. A walk over a face that
  // is turned away from the line may go round the surface to another sheet: the walks from the other
  // faces are tried then, and the nearest of the points taken.
  Working_location project(const Eigen::Vector3d& q, const Eigen::Vector3d& n,
                           const std::array<int, 3>& faces, double largest_distance) const
  {
    Working_location best{-1, {{0, 0, 0}}};
    double smallest = largest_distance;
    for(const int face : faces)
    {
      Meeting meeting;
      if(!meet(q, n, face, meeting))
        continue;
      const double distance = (point(meeting.location) - q).norm();
      if(!(distance <= largest_distance))
        continue;
      if(meeting.is_direct)
        return meeting.location;
      if(best.face >= 0 && !(distance < smallest))
        continue;
      smallest = distance;
      best = meeting.location;
    }
    return best.face >= 0 ? best : closest_point(q, faces[0]);
  }

  // the closest point of the faces around `face`
  Working_location closest_point(const Eigen::Vector3d& q, int face) const
  {
    const int most_faces = 400, patience = 40;
    typedef std::pair<double, int> Entry; // (squared distance, face)
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry> > queue;
    std::unordered_set<int> is_known;
    Working_location best{-1, {{0, 0, 0}}};
    double smallest = std::numeric_limits<double>::infinity();
    queue.emplace(0., face);
    is_known.insert(face);
    for(int n = 0, since_progress = 0; n < most_faces && since_progress < patience
                                       && !queue.empty(); ++n, ++since_progress)
    {
      const int f = queue.top().second;
      queue.pop();
      const Working_location candidate{f, closest_point_of_triangle(corners(f), q)};
      const double distance = (point(candidate) - q).squaredNorm();
      if(distance < smallest)
      {
        smallest = distance;
        best = candidate;
        since_progress = 0;
      }
      for(int h = 3 * f; h < 3 * f + 3; ++h)
        if(const int o = m_mesh->opposite[h]; o >= 0 && is_known.insert(o / 3).second)
          queue.emplace(squared_distance(o / 3, q), o / 3);
    }
    return best;
  }

private:
  // where a line meets the mesh
  struct Meeting
  {
    Working_location location;
    bool is_direct = true; // Are no faces on the way there turned away from the line?
  };

  std::array<Eigen::Vector3d, 3> corners(int f) const
  {
    const std::array<int, 3>& t = m_mesh->triangles[f];
    return {{m_mesh->points[t[0]], m_mesh->points[t[1]], m_mesh->points[t[2]]}};
  }

  double squared_distance(int f, const Eigen::Vector3d& q) const
  {
    return (point(Working_location{f, closest_point_of_triangle(corners(f), q)}) - q)
      .squaredNorm();
  }

  // Walks across the edge that separates the face most clearly from the line.
  bool meet(const Eigen::Vector3d& q, const Eigen::Vector3d& n, int face, Meeting& result) const
  {
    const int most_steps = 1000;
    int entered = -1;
    for(int step = 0; step < most_steps; ++step)
    {
      std::array<Eigen::Vector3d, 3> t = corners(face);
      for(Eigen::Vector3d& p : t)
        p -= q;
      std::array<double, 3> area; // of the line with edge i, seen along the line
      int exit = -1;
      double smallest = 0;
      for(int i = 0; i < 3; ++i)
      {
        const Eigen::Vector3d& a = t[i];
        const Eigen::Vector3d& b = t[(i + 1) % 3];
        area[i] = n.dot(a.cross(b));
        const double depth = area[i] < 0 ? area[i] / n.cross(b - a).norm() : 0;
        if(3 * face + i != entered && depth < smallest)
        {
          smallest = depth;
          exit = i;
        }
      }
      result.is_direct = result.is_direct && area[0] + area[1] + area[2] > 0;
      if(exit < 0)
      {
        double sum = 0;
        for(double& x : area)
          sum += x = (std::max)(0., x);
        if(!(sum > 0))
          return false;
        for(int i = 0; i < 3; ++i)
          result.location.barycentric[i] = area[(i + 1) % 3] / sum;
        result.location.face = face;
        return true;
      }
      entered = m_mesh->opposite[3 * face + exit];
      if(entered < 0)
        return false;
      face = entered / 3;
    }
    return false;
  }

  const Working_mesh* m_mesh;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_SURFACE_WALK_H
