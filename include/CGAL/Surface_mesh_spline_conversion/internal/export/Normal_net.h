// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_NORMAL_NET_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_NORMAL_NET_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// The cross product of the derivatives of a polynomial piece, itself a polynomial, by its Bezier
/// points. All normals lie in their convex cone: where this lies in a half space, the piece does not
/// fold. No samples are needed, which would miss a fold between them.
class Normal_net
{
public:
  typedef Eigen::Vector3d Vector;

  explicit Normal_net(const Bezier_piece& piece)
    : m_size{{2 * piece.degree[0], 2 * piece.degree[1]}},
      m_points(std::size_t(m_size[0] * m_size[1]), Vector::Zero())
  {
    const Scaled_points du = derivative(piece, 0), dv = derivative(piece, 1);
    for(int j = 0; j < du.size[1]; ++j)
      for(int i = 0; i < du.size[0]; ++i)
        for(int l = 0; l < dv.size[1]; ++l)
          for(int k = 0; k < dv.size[0]; ++k)
            point(i + k, j + l) += du(i, j).cross(dv(k, l));
    const std::vector<double> bu = binomials(m_size[0] - 1), bv = binomials(m_size[1] - 1);
    for(int j = 0; j < m_size[1]; ++j)
      for(int i = 0; i < m_size[0]; ++i)
        point(i, j) /= bu[std::size_t(i)] * bv[std::size_t(j)];
  }

  /// Do the normals have no common half space even in a small part of the piece? Then its middle is
  /// at the parameters `u` and `v`.
  bool find_fold(double& u, double& v) const
  {
    return find_fold(0, 0, 1, u, v);
  }

private:
  // The Bezier points of a product are sums of products of such points with binomial coefficients.
  struct Scaled_points
  {
    std::array<int, 2> size;
    std::vector<Vector> points;

    const Vector& operator()(int i, int j) const { return points[std::size_t(j * size[0] + i)]; }
  };

  // smaller coordinates, relative to the largest one, are rounding
  static constexpr double relative_rounding = 1e-10;

  // The normals may turn by a straight angle in a part of that size: an edge of the part that is
  // rounded by less looks like a fold.
  static constexpr double smallest_part = 1. / 64;

  Vector& point(int i, int j) { return m_points[std::size_t(j * m_size[0] + i)]; }
  const Vector& point(int i, int j) const { return m_points[std::size_t(j * m_size[0] + i)]; }

  static std::vector<double> binomials(int n)
  {
    std::vector<double> result(1, 1.);
    for(int k = 0; k < n; ++k)
      result.push_back(result.back() * (n - k) / (k + 1));
    return result;
  }

  // the derivative along an axis, up to a factor
  static Scaled_points derivative(const Bezier_piece& piece, int axis)
  {
    std::array<int, 2> degree = piece.degree;
    const std::size_t row = std::size_t(degree[0] + 1), step = (axis == 0) ? 1 : row;
    --degree[std::size_t(axis)];
    const std::vector<double> bu = binomials(degree[0]), bv = binomials(degree[1]);
    Scaled_points result{{{degree[0] + 1, degree[1] + 1}}, {}};
    for(std::size_t j = 0; j < bv.size(); ++j)
      for(std::size_t i = 0; i < bu.size(); ++i)
      {
        const std::size_t k = j * row + i;
        result.points.push_back(bu[i] * bv[j] * (piece.points[k + step] - piece.points[k]));
      }
    return result;
  }

  // Is the projection of all points to the direction of their sum positive?
  bool has_half_space() const
  {
    Vector sum = Vector::Zero();
    for(const Vector& p : m_points)
      sum += p;
    double smallest = (std::numeric_limits<double>::max)(), largest = 0;
    for(const Vector& p : m_points)
    {
      smallest = (std::min)(smallest, p.dot(sum));
      largest = (std::max)(largest, p.dot(sum));
    }
    return largest > 0 && smallest >= -relative_rounding * largest;
  }

  // `u0`, `v0`, `size`: of this net in the piece
  bool find_fold(double u0, double v0, double size, double& u, double& v) const
  {
    if(has_half_space())
      return false;
    if(size <= smallest_part)
    {
      u = u0 + size / 2;
      v = v0 + size / 2;
      return true;
    }
    for(int i : {0, 1})
    {
      const Normal_net half = this->half(0, i);
      for(int j : {0, 1})
        if(half.half(1, j).find_fold(u0 + i * size / 2, v0 + j * size / 2, size / 2, u, v))
          return true;
    }
    return false;
  }

  // the part over the lower (0) or upper (1) half of the interval of an axis, by the algorithm of
  // de Casteljau
  Normal_net half(int axis, int part) const
  {
    Normal_net result(*this);
    const int n = m_size[std::size_t(axis)], rows = m_size[std::size_t(1 - axis)];
    const int step = (axis == 0) ? 1 : m_size[0], row_step = (axis == 0) ? m_size[0] : 1;
    for(int row = 0; row < rows; ++row)
    {
      Vector* p = result.m_points.data() + row * row_step;
      for(int r = 1; r < n; ++r)
        if(part == 0)
          for(int i = n - 1; i >= r; --i)
            p[i * step] = (p[i * step] + p[(i - 1) * step]) / 2;
        else
          for(int i = 0; i < n - r; ++i)
            p[i * step] = (p[i * step] + p[(i + 1) * step]) / 2;
    }
    return result;
  }

  std::array<int, 2> m_size;
  std::vector<Vector> m_points; // `u` runs fastest
};

/// a place in each piece that folds, in the order of the pieces
inline std::vector<Eigen::Vector3d> folds_of_pieces(const std::vector<Bezier_piece>& pieces)
{
  std::vector<std::vector<Eigen::Vector3d> > parts(pieces.size());
  for_each_index(pieces.size(), [&](std::size_t i)
  {
    double u, v;
    if(Normal_net(pieces[i]).find_fold(u, v))
      parts[i].push_back(pieces[i].point(u, v));
  });
  std::vector<Eigen::Vector3d> result;
  for(const auto& part : parts)
    result.insert(result.end(), part.begin(), part.end());
  return result;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_NORMAL_NET_H
