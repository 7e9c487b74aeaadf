// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_PROJECTION_FOLD_CHECK_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_PROJECTION_FOLD_CHECK_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Boundary_chains.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Proxy_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Surface_walk.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Finds the faces of a proxy in which the projection (see `Proxy_projection`) may not be one to
// one. No samples are taken: each face of the mesh below a face of the proxy is judged as a whole.
// The lines of projection of a triangle fill a prism; they do not cross between two heights, and
// the projection is a homeomorphism if the mesh lies between these, with no face turned away from
// the lines.
class Projection_fold_check
{
public:
  // \pre `proxy` outlives this object
  explicit Projection_fold_check(const Proxy_mesh& proxy)
    : m_proxy(&proxy), m_target(*proxy.unfolded), m_walk(*proxy.unfolded),
      m_chains(*proxy.unfolded),
      m_visit(proxy.unfolded->number_of_faces(), 0)
  {}

  // May the projection of face `f` of the proxy have a fold? None is missed; one that is all but
  // folded counts as folded.
  bool is_folded(int f)
  {
    const std::vector<Prism> parts = prisms(f);
    std::vector<int> faces;
    return std::any_of(parts.begin(), parts.end(), [&](const Prism& prism)
      { return is_folded(prism, 1, faces); });
  }

  // Appends the faces of the mesh at which the projection of face `f` may have a fold, at least the
  // first ones; none if `f` is itself turned against the directions at its corners. Takes longer.
  void append_folded(int f, std::vector<int>& faces)
  {
    const int most_found = 50;
    for(const Prism& prism : prisms(f))
      is_folded(prism, most_found, faces);
  }

private:
  typedef std::array<Eigen::Vector3d, 3> Triangle;

  // a triangle whose points and directions of projection are interpolated linearly, and faces of
  // the mesh at its corners
  struct Prism
  {
    Triangle points, directions;
    std::array<int, 3> faces;
  };

  // heights along the directions
  struct Slab
  {
    double lower, upper;
  };

  // the parts of face `f` in which the projection is that of a prism: one per edge of the mesh
  // below the boundary edge of `f`, or the face itself
  std::vector<Prism> prisms(int f) const
  {
    const Working_mesh& mesh = m_proxy->mesh;
    Prism whole;
    for(int i = 0; i < 3; ++i)
    {
      const int v = mesh.triangles[f][i];
      whole.points[i] = mesh.points[v];
      whole.directions[i] = m_proxy->normal[v];
      whole.faces[i] = m_proxy->place[v].face;
    }
    int border = 0;
    while(border < 3 && !mesh.is_border(3 * f + border))
      ++border;
    if(border == 3)
      return std::vector<Prism>(1, whole);
    return cut(whole, border, mesh.boundary_piece[3 * f + border]);
  }

  // the parts of a prism below the edges of the mesh along its side `i`
  std::vector<Prism> cut(const Prism& whole, int i, const Working_mesh::Boundary_piece& piece) const
  {
    std::vector<Prism> parts;
    const int j = (i + 1) % 3;
    Prism part = whole;
    for(const double s : m_chains.vertices_between(piece.chain, piece.first, piece.last))
    {
      const double t = (s - piece.first) / (piece.last - piece.first);
      const Working_location place = m_chains(piece.chain, s);
      part.faces[j] = place.face;
      part.points[j] = point_at(m_target, place);
      part.directions[j] = (1 - t) * whole.directions[i] + t * whole.directions[j];
      parts.push_back(part);
      part.faces[i] = part.faces[j];
      part.points[i] = part.points[j];
      part.directions[i] = part.directions[j];
    }
    part.faces[j] = whole.faces[j];
    part.points[j] = whole.points[j];
    part.directions[j] = whole.directions[j];
    parts.push_back(part);
    return parts;
  }

  Triangle corners(int f) const
  {
    const std::array<int, 3>& t = m_target.triangles[f];
    return {{m_target.points[t[0]], m_target.points[t[1]], m_target.points[t[2]]}};
  }

  // Visits the faces of the mesh that meet the prism, from where the line in its middle does. The
  // way leads across edges inside of the prism: what lies beyond a rim along its side is another
  // sheet. It ends with the last of so many folds.
  bool is_folded(const Prism& prism, int most_found, std::vector<int>& faces)
  {
    const Slab slab = slab_without_crossings(prism);
    if(!(slab.lower < slab.upper))
      return true;
    ++m_round;
    m_queue.clear();
    for(int i = 0; i < 3; ++i)
      visit(m_walk.project(mean(prism.points), mean(prism.directions),
                           {{prism.faces[i], prism.faces[(i + 1) % 3], prism.faces[(i + 2) % 3]}},
                           longest_side(prism)).face);
    int found = 0;
    for(std::size_t i = 0; i < m_queue.size() && found < most_found; ++i)
    {
      const int f = m_queue[i];
      const Triangle face = corners(f);
      int divisions = most_divisions;
      if(is_folded(prism, slab, face, largest_depth, divisions))
      {
        faces.push_back(f);
        ++found;
      }
      for(int h = 3 * f; h < 3 * f + 3; ++h)
        if(!m_target.is_border(h))
          if(const Sides sides = sides_of(prism, face[h % 3], face[(h + 1) % 3]);
             sides.least < -sides.rounding && sides.most > sides.rounding)
            visit(m_target.opposite[h] / 3);
    }
    return found > 0;
  }

  static Eigen::Vector3d mean(const Triangle& t) { return (t[0] + t[1] + t[2]) / 3; }

  void visit(int f)
  {
    if(m_visit[f] == m_round)
      return;
    m_visit[f] = m_round;
    m_queue.push_back(f);
  }

  // The heights at which the parallel triangles of the prism have the orientation of its
  // directions, next to 0. The determinant of the motion along the triangle and its direction is
  // quadratic in the height, and linear in the triangle.
  static Slab slab_without_crossings(const Prism& prism)
  {
    const Eigen::Vector3d e = prism.points[1] - prism.points[0],
                          f = prism.points[2] - prism.points[0],
                          d = prism.directions[1] - prism.directions[0],
                          g = prism.directions[2] - prism.directions[0];
    const double longest = longest_side(prism);
    Slab slab{-longest, longest};
    for(const Eigen::Vector3d& n : prism.directions)
    {
      const double a = n.dot(d.cross(g)), b = n.dot(e.cross(g) + d.cross(f)), c = n.dot(e.cross(f));
      if(!(c > 0))
        return Slab{0, 0};
      limit(a, b, c, slab);
    }
    const double margin = 1e-6;
    return Slab{(1 - margin) * slab.lower, (1 - margin) * slab.upper};
  }

  // Limits a slab by the zeros of the quadratic polynomial a x^2 + b x + c, where c > 0.
  static void limit(double a, double b, double c, Slab& slab)
  {
    const double discriminant = b * b - 4 * a * c;
    if(!(discriminant >= 0))
      return;
    const double q = -0.5 * (b + (b < 0 ? -1 : 1) * std::sqrt(discriminant));
    for(const double zero : {q / a, c / q})
      if(zero > 0)
        slab.upper = (std::min)(slab.upper, zero);
      else if(zero < 0)
        slab.lower = (std::max)(slab.lower, zero);
  }

  // `false` if no line of the prism meets the inside of the face: the lines pass an edge on the
  // wrong side, or meet it.
  static bool may_meet(const Prism& prism, const Triangle& face)
  {
    bool is_some_negative = false, is_some_positive = false;
    const Eigen::Vector3d normal = (face[1] - face[0]).cross(face[2] - face[0]);
    bool is_front = true, is_back = true;
    for(const Eigen::Vector3d& n : prism.directions)
    {
      is_front = is_front && normal.dot(n) > 0;
      is_back = is_back && normal.dot(n) < 0;
    }
    for(int i = 0; i < 3; ++i)
    {
      const Sides sides = sides_of(prism, face[i], face[(i + 1) % 3]);
      is_some_negative = is_some_negative || sides.most <= sides.rounding;
      is_some_positive = is_some_positive || sides.least >= -sides.rounding;
    }
    return !((is_some_negative && is_some_positive) || (is_some_negative && is_front)
             || (is_some_positive && is_back));
  }

  // on which side lines pass an edge
  struct Sides
  {
    double least, most, rounding;
  };

  // Bounds, by Bernstein coefficients, of the side on which the lines of a prism pass an edge, as a
  // quadratic polynomial.
  static Sides sides_of(const Prism& prism, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
  {
    const double relative_rounding = 1e-12;
    std::array<Eigen::Vector3d, 3> moment;
    Sides sides{std::numeric_limits<double>::infinity(),
                -std::numeric_limits<double>::infinity(), 0};
    for(int i = 0; i < 3; ++i)
    {
      const Eigen::Vector3d from = a - prism.points[i], to = b - prism.points[i];
      moment[i] = from.cross(to);
      sides.rounding
        = (std::max)(sides.rounding, relative_rounding * from.norm() * to.norm());
    }
    for(int i = 0; i < 3; ++i)
      for(int j = i; j < 3; ++j)
      {
        const double side
          = (prism.directions[i].dot(moment[j]) + prism.directions[j].dot(moment[i])) / 2;
        sides.least = (std::min)(sides.least, side);
        sides.most = (std::max)(sides.most, side);
      }
    return sides;
  }

  // Is a part of the face in the prism outside of the slab or turned away? Divides the prism where
  // that is not clear: at most so many times over, and so often in all.
  static bool is_folded(const Prism& prism, const Slab& slab, const Triangle& face, int depth,
                        int& divisions)
  {
    if(!may_meet(prism, face))
      return false;
    if(is_front(prism, face) && is_inside(prism, slab, face))
      return false;
    if(depth == 0 || divisions == 0)
      return true;
    --divisions;
    const std::array<Prism, 4> parts = quarters(prism);
    for(const Prism& part : parts)
      if(is_folded_in_the_middle(part, face))
        return true;
    for(const Prism& part : parts)
      if(is_folded(part, slab_without_crossings(part), face, depth - 1, divisions))
        return true;
    return false;
  }

  // Is the projection turned over where the line in the middle of the prism meets the face?
  static bool is_folded_in_the_middle(const Prism& prism, const Triangle& face)
  {
    const Eigen::Vector3d q = mean(prism.points), n = mean(prism.directions);
    const double cosine = (face[1] - face[0]).cross(face[2] - face[0]).dot(n);
    for(int i = 0; i < 3; ++i)
    {
      const double side = n.dot((face[i] - q).cross(face[(i + 1) % 3] - q));
      if(cosine > 0 ? side <= 0 : side >= 0)
        return false;
    }
    if(cosine <= 0)
      return true;
    const double height = (face[1] - face[0]).cross(face[2] - face[0]).dot(face[0] - q) / cosine;
    const Triangle t = at_height(prism, height);
    return (t[1] - t[0]).cross(t[2] - t[0]).dot(n) <= 0;
  }

  static bool is_front(const Prism& prism, const Triangle& face)
  {
    const Eigen::Vector3d normal = (face[1] - face[0]).cross(face[2] - face[0]);
    return std::all_of(prism.directions.begin(), prism.directions.end(),
                       [&normal](const Eigen::Vector3d& n) { return normal.dot(n) > 0; });
  }

  // Lies the part of the face in the prism within the slab? A thinner slab has a closer hull.
  static bool is_inside(const Prism& prism, const Slab& slab, const Triangle& face)
  {
    for(const double share : {0.05, 0.3, 1.})
    {
      const double most = share * longest_side(prism);
      const Slab part{(std::max)(slab.lower, -most), (std::min)(slab.upper, most)};
      if(is_between(prism, part, part_in_hull(prism, part, face)))
        return true;
    }
    return false;
  }

  static double longest_side(const Prism& prism)
  {
    const Triangle& t = prism.points;
    return std::sqrt((std::max)({(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(),
                                 (t[0] - t[2]).squaredNorm()}));
  }

  // the triangle of the prism at a height
  static Triangle at_height(const Prism& prism, double height)
  {
    Triangle triangle = prism.points;
    for(int i = 0; i < 3; ++i)
      triangle[i] += height * prism.directions[i];
    return triangle;
  }

  // Cuts a face with three planes between which the part of the prism in the slab lies.
  static std::vector<Eigen::Vector3d> part_in_hull(const Prism& prism, const Slab& slab,
                                                   const Triangle& face)
  {
    const Triangle lower = at_height(prism, slab.lower), upper = at_height(prism, slab.upper);
    const Eigen::Vector3d up = prism.directions[0] + prism.directions[1] + prism.directions[2];
    std::vector<Eigen::Vector3d> polygon(face.begin(), face.end());
    for(int i = 0; i < 3; ++i)
    {
      const int j = (i + 1) % 3;
      const Eigen::Vector3d outward = (prism.points[j] - prism.points[i]).cross(up);
      polygon = cut_off(polygon, outward,
                        (std::max)({outward.dot(lower[i]), outward.dot(lower[j]),
                                    outward.dot(upper[i]), outward.dot(upper[j])}));
    }
    return polygon;
  }

  // the part of a convex polygon where the scalar product with `normal` is at most `limit`
  static std::vector<Eigen::Vector3d> cut_off(const std::vector<Eigen::Vector3d>& polygon,
                                              const Eigen::Vector3d& normal, double limit)
  {
    std::vector<Eigen::Vector3d> part;
    for(std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Eigen::Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double x = normal.dot(a) - limit, y = normal.dot(b) - limit;
      if(x <= 0)
        part.push_back(a);
      if((x < 0 && y > 0) || (x > 0 && y < 0))
        part.push_back(a + x / (x - y) * (b - a));
    }
    return part;
  }

  static bool is_between(const Prism& prism, const Slab& slab,
                         const std::vector<Eigen::Vector3d>& points)
  {
    const auto side_of = [](const Triangle& t, const Eigen::Vector3d& p)
    { return (t[1] - t[0]).cross(t[2] - t[0]).dot(p - t[0]); };
    const Triangle lower = at_height(prism, slab.lower), upper = at_height(prism, slab.upper);
    return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& p)
      { return side_of(lower, p) > 0 && side_of(upper, p) < 0; });
  }

  static std::array<Prism, 4> quarters(const Prism& prism)
  {
    Prism middle = prism;
    for(int i = 0; i < 3; ++i)
    {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      middle.points[i] = (prism.points[j] + prism.points[k]) / 2;
      middle.directions[i] = (prism.directions[j] + prism.directions[k]) / 2;
    }
    std::array<Prism, 4> parts = {{middle, middle, middle, middle}};
    for(int i = 0; i < 3; ++i)
    {
      parts[i].points[i] = prism.points[i];
      parts[i].directions[i] = prism.directions[i];
      // the middles are those of the sides opposite to the corners: keep the orientation
      std::swap(parts[i].points[(i + 1) % 3], parts[i].points[(i + 2) % 3]);
      std::swap(parts[i].directions[(i + 1) % 3], parts[i].directions[(i + 2) % 3]);
    }
    return parts;
  }

  static constexpr int largest_depth = 7, most_divisions = 60;

  const Proxy_mesh* m_proxy;
  const Working_mesh& m_target; // that of the projection
  Surface_walk m_walk;
  Boundary_chains m_chains;
  std::vector<int> m_visit; // per face of the mesh: the last round in which it was visited
  int m_round = 0;
  std::vector<int> m_queue;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_PROJECTION_FOLD_CHECK_H
