// The alternative to transfinite interpolation in Fig. 12 of the paper: a mesh that is refined
// along its boundary, and whose boundary is left polygonal.
#ifndef QUALITY_POLYGON_BOUNDARY_H
#define QUALITY_POLYGON_BOUNDARY_H

#include "surface_stages.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

// a polygon as a curve: point i at the parameter i
inline Case::Curve_3 make_polygon_curve(std::vector<Kernel::Point_3> points)
{
  const auto piece = [](double t, std::size_t n)
  { return (std::min)(static_cast<std::size_t>((std::max)(0., std::floor(t))), n - 2); };
  const auto point = [points, piece](double t)
  {
    const std::size_t i = piece(t, points.size());
    return points[i] + (t - double(i)) * (points[i + 1] - points[i]);
  };
  const auto derivative = [points, piece](double t, int order)
  {
    const std::size_t i = piece(t, points.size());
    return order == 1 ? points[i + 1] - points[i] : Kernel::Vector_3(0, 0, 0);
  };
  return SC::Function_curve_traits_3<Kernel>::Curve_3(point, derivative);
}

// splits each boundary edge at a point of its curve, and makes the polygons the boundary curves
inline void make_polygon_boundary(const Input& input, Input& result)
{
  typedef Case::Triangle_mesh Mesh;
  const Network& network = input.network.front();
  result.data = input.data;
  Mesh& mesh = result.data.mesh;
  std::vector<std::vector<Mesh::Halfedge_index> > chains;
  for(std::size_t c = 0; c < network.number_of_chains(); ++c)
  {
    chains.emplace_back();
    const std::vector<Mesh::Halfedge_index> halfedges(network.chain_halfedges(c).begin(),
                                                      network.chain_halfedges(c).end());
    for(std::size_t i = 0; i < halfedges.size(); ++i)
    {
      const double s = (network.arc_length(c, i) + network.arc_length(c, i + 1)) / 2;
      const Mesh::Halfedge_index first = CGAL::Euler::split_edge(halfedges[i], mesh);
      mesh.point(mesh.target(first)) = network.point(c, s);
      CGAL::Euler::split_face(first, mesh.next(halfedges[i]), mesh);
      chains.back().push_back(first);
      chains.back().push_back(halfedges[i]);
    }
  }
  result.data.segments.assign(mesh.num_halfedges(), Case::Curve_segment());
  result.data.corners.resize(mesh.num_vertices(), 0);
  for(const auto& chain : chains)
  {
    std::vector<Kernel::Point_3> points(1, mesh.point(mesh.source(chain.front())));
    for(Mesh::Halfedge_index h : chain)
      points.push_back(mesh.point(mesh.target(h)));
    const Case::Curve_3 curve = make_polygon_curve(std::move(points));
    for(std::size_t i = 0; i < chain.size(); ++i)
      result.data.segments[chain[i]] = Case::Curve_segment{curve, double(i), double(i + 1)};
  }
  for(Mesh::Vertex_index v : input.data.mesh.vertices())
    result.data.corners[v] = input.data.mesh.is_border(v) && network.is_corner(v);
  // the kinks of the polygons are no corners
  const double any_angle = 179;
  result.network.emplace_back(
    mesh, result.data.halfedge_curve_map(), result.data.traits,
    CGAL::parameters::corner_angle(any_angle)
      .vertex_is_constrained_map(result.data.vertex_is_corner_map()));
  result.is_valid = result.network.front().error() == SC::Error_code::OK;
  result.message = result.network.front().message();
}

#endif // QUALITY_POLYGON_BOUNDARY_H
