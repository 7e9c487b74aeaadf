// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_FIND_BOUNDARY_VERTICES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_FIND_BOUNDARY_VERTICES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/T_NURCC_surface_3.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_NURBS_faces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/quad_neighbors.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

tells on which part of a boundary chain an edge of a shell lies.
*/
template <typename FT>
struct Border_edge_place
{
  std::size_t edge;  ///< index of the edge
  std::size_t chain; ///< of the network
  FT first;          ///< arc length at the source of the edge
  FT last;           ///< arc length at its target; greater than `first`, if the edge runs along the
                     ///< chain, otherwise smaller; it may leave the period of a closed chain
};

namespace internal {

// Finds the points of the boundary of a surface that are closest to given points.
template <typename K>
class Boundary_foot_finder
{
  typedef typename K::FT FT;
  typedef Boundary_vertex<FT> Vertex;
  typedef Eigen::Vector3d Vector;

public:
  explicit Boundary_foot_finder(const T_NURCC_surface_3<K>& surface) : m_surface(surface)
  {
    const Quad_neighbors neighbors = quad_neighbors(surface);
    for(std::size_t q = 0; q < neighbors.size(); ++q)
      for(int i = 0; i < 4; ++i)
        if(neighbors[q][i].first == NO_INDEX)
          for(int k = 0; k <= intervals_per_side; ++k)
          {
            const Vertex place{q, i, FT(double(k) / intervals_per_side)};
            m_samples.push_back({place, point(place)});
          }
  }

  bool is_empty() const { return m_samples.empty(); }

  // A side end or a patch corner within `tolerance` of `p` is preferred to the closest point, so
  // that no edge becomes shorter than that.
  Vertex operator()(const Vector& p, double tolerance) const
  {
    Vertex best = m_samples.front().place;
    double distance = (std::numeric_limits<double>::infinity)();
    for(std::size_t first = 0; first < m_samples.size(); first += intervals_per_side + 1)
    {
      Vertex v;
      if(!find_start(p, first, v))
        continue;
      descend(p, v);
      const double next_distance = (point(v) - p).norm();
      if(!(next_distance < distance))
        continue;
      best = v;
      distance = next_distance;
    }
    for(const FT& end : patch_ends(best))
    {
      const Vertex candidate{best.quad, best.side, end};
      if((point(candidate) - p).norm() <= tolerance)
        best = candidate;
    }
    return best;
  }

  Vector point(const Vertex& v) const
  {
    const auto uv = from_side<FT>(v.side, v.parameter, FT(0));
    return to_eigen(m_surface.position(m_surface.patch_at(v.quad, uv[0], uv[1]), uv[0], uv[1]));
  }

private:
  static constexpr int intervals_per_side = 16;
  static constexpr int maximum_number_of_steps = 30;
  static constexpr int maximum_number_of_halvings = 8; // of a step

  struct Sample
  {
    Vertex place;
    Vector point;
  };

  Vector tangent(const Vertex& v) const
  {
    const auto uv = from_side<FT>(v.side, v.parameter, FT(0));
    const std::size_t patch = m_surface.patch_at(v.quad, uv[0], uv[1]);
    const Vector t = to_eigen(m_surface.derivative(patch, uv[0], uv[1], 1 - (v.side & 1),
                                                   v.side & 1));
    return v.side < 2 ? t : Vector(-t);
  }

  // The sample of a side, the samples of which begin at `first`, that is closest to `p`. Returns
  // `false` if it is so far that `p` cannot lie on the side between it and its neighbors. (Beside a
  // vertex of the layout, the closest sample of all may be that of the wrong side.)
  bool find_start(const Vector& p, std::size_t first, Vertex& start) const
  {
    constexpr double largest_ratio = 2; // of the distance from a sample to that of its neighbors
    auto distance = [&](std::size_t i) { return (m_samples[i].point - p).norm(); };
    const std::size_t last = first + intervals_per_side;
    std::size_t closest = first;
    for(std::size_t i = first + 1; i <= last; ++i)
      if(distance(i) < distance(closest))
        closest = i;
    double spacing = 0;
    for(std::size_t i : {closest == first ? closest : closest - 1, (std::min)(closest, last - 1)})
      spacing = (std::max)(spacing, (m_samples[i + 1].point - m_samples[i].point).norm());
    start = m_samples[closest].place;
    return distance(closest) <= largest_ratio * spacing;
  }

  // Gauss-Newton steps along the side, as long as they come closer
  void descend(const Vector& p, Vertex& v) const
  {
    for(int k = 0; k < maximum_number_of_steps; ++k)
    {
      const Vector t = tangent(v);
      if(!move(p, t.dot(p - point(v)) / t.squaredNorm(), v))
        return;
    }
  }

  // moves a point along the side by a step, or by the largest of its halves, that comes closer
  bool move(const Vector& p, double step, Vertex& v) const
  {
    const double distance = (point(v) - p).norm();
    for(int i = 0; i < maximum_number_of_halvings; ++i, step /= 2)
    {
      Vertex next = v;
      next.parameter = FT((std::min)(1., (std::max)(0., CGAL::to_double(v.parameter) + step)));
      if(!((point(next) - p).norm() < distance))
        continue;
      v = next;
      return true;
    }
    return false;
  }

  std::array<FT, 2> patch_ends(const Vertex& v) const
  {
    const auto uv = from_side<FT>(v.side, v.parameter, FT(0));
    const auto o = m_surface.patch_origin(m_surface.patch_at(v.quad, uv[0], uv[1]));
    return {{to_side<FT>(v.side, o.u0, o.v0)[0], to_side<FT>(v.side, o.u1, o.v1)[0]}};
  }

  const T_NURCC_surface_3<K>& m_surface;
  std::vector<Sample> m_samples;
};

// the chain of the network to which a point belongs, and its foot there
template <typename Network>
struct Chain_foot
{
  std::size_t chain = 0;
  typename Network::Projection foot;
};

template <typename Network>
Chain_foot<Network> closest_chain(const Network& network, const typename Network::Point_3& p)
{
  Chain_foot<Network> best;
  for(std::size_t c = 0; c < network.number_of_chains(); ++c)
  {
    const auto foot = network.project(c, p);
    if(c == 0 || foot.distance < best.foot.distance)
      best = {c, foot};
  }
  return best;
}

// The arc length of the point of a chain that is closest to `p`. Where several belong to one point,
// the one closest to `guess`: a closed chain has a period, and an open one may end where it begins.
template <typename Network>
typename Network::FT arc_length_near(const Network& network, std::size_t chain,
                                     const typename Network::Point_3& p,
                                     const typename Network::FT& guess)
{
  typedef typename Network::FT FT;
  constexpr double relative_equality = 1e-9; // of points; curves meet at corners up to rounding
  const FT length = network.length(chain), s = network.project(chain, p).arc_length;
  if(network.is_closed(chain))
    return s + length * FT(std::round(CGAL::to_double((guess - s) / length)));
  const FT tolerance = FT(relative_equality) * network.diameter();
  FT best = s;
  for(const FT& end : {FT(0), length})
    if((network.point(chain, end) - network.point(chain, s)).squared_length()
         <= tolerance * tolerance
       && CGAL::abs(end - guess) < CGAL::abs(best - guess))
      best = end;
  return best;
}

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

finds where the boundary of a surface passes the joints of its curves, the seams of closed curves,
the seams of their surfaces and the corners of the network: there the exported boundary needs
vertices, as the neighboring faces of a CAD model have them there. The result is meant for the
parameter `boundary_vertices` of `extract_NURBS_faces()`.

\param surface the surface
\param network the boundary curves of the mesh the surface was made from, or of a mesh of which it
       is a component
\param tolerance in model units: joints that are further from the boundary are left out, and corners
       of patches that are closer to a joint are taken instead of a point beside them

\return at most one vertex for each joint, seam or corner
*/
template <typename K, typename Network>
std::vector<Boundary_vertex<typename K::FT> >
find_boundary_vertices(const T_NURCC_surface_3<K>& surface, const Network& network,
                       const typename K::FT& tolerance)
{
  typedef typename K::FT FT;
  std::vector<Boundary_vertex<FT> > result;
  const internal::Boundary_foot_finder<K> finder(surface);
  if(finder.is_empty())
    return result;
  auto add = [&](std::size_t chain, const FT& arc_length)
  {
    const Eigen::Vector3d p = internal::to_eigen(network.point(chain, arc_length));
    const Boundary_vertex<FT> v = finder(p, CGAL::to_double(tolerance));
    if((finder.point(v) - p).norm() <= CGAL::to_double(tolerance))
      result.push_back(v);
  };
  for(std::size_t c = 0; c < network.number_of_chains(); ++c)
  {
    if(!network.is_closed(c))
      add(c, FT(0));
    for(const auto& joint : network.joints(c))
      add(c, joint.arc_length);
    for(const FT& s : network.surface_seams(c))
      add(c, s);
  }
  return result;
}

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

finds on which part of which boundary chain the border edges of a shell lie: the middle of the edge
decides on the chain. If the shell has the vertices of `find_boundary_vertices()`, each edge lies on
a single curve, see `Boundary_curve_network_3::locate()`.

\return one entry for each border edge, by ascending index of the edge
*/
template <typename K, typename Network>
std::vector<Border_edge_place<typename K::FT> >
locate_border_edges(const NURBS_shell_3<K>& shell, const Network& network)
{
  typedef typename K::FT FT;
  std::vector<Border_edge_place<FT> > result;
  for(std::size_t e = 0; e < shell.number_of_edges() && network.number_of_chains() > 0; ++e)
  {
    if(!shell.is_border(e))
      continue;
    const auto& curve = shell.edge(e).curve;
    const FT middle = (curve.first() + curve.last()) / FT(2);
    const auto chain_foot = internal::closest_chain(network, curve.point(middle));
    const std::size_t c = chain_foot.chain;
    const FT s = chain_foot.foot.arc_length;
    const FT speed = network.derivative(c, s, 1) * curve.derivative(middle, 1);
    auto arc_length = [&](const FT& t)
    { return internal::arc_length_near(network, c, curve.point(t), s + speed * (t - middle)); };
    result.push_back({e, c, arc_length(curve.first()), arc_length(curve.last())});
  }
  return result;
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_FIND_BOUNDARY_VERTICES_H
