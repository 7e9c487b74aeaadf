// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_MAKE_PROXY_MESH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_MAKE_PROXY_MESH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/limit_gradation.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Isotropic_remesher.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Proxy_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Proxy_projection.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Makes the proxy of a mesh, and checks it.
class Proxy_builder
{
public:
  // `size`: per vertex of `original`, which has no ears, the wanted edge length of the quads;
  // `is_kept`: the vertices that the proxy must have besides the corners; `refinement`: by how much
  // the edges are shorter than usual
  Proxy_builder(std::shared_ptr<const Working_mesh> original, const std::vector<double>& size,
                const std::vector<char>& is_kept, double refinement)
    : m_shared_original(original), m_original(*original), m_size(size), m_is_kept(is_kept),
      m_refinement(refinement)
  {}

  // Is the mesh much finer than the quads, or does it have many badly shaped triangles?
  bool is_proxy_wanted() const
  {
    const double least_ratio = 1.5, largest_share_of_slivers = 0.01, sliver = 0.05;
    double wanted_faces = 0;
    int slivers = 0;
    for(int f = 0; f < m_original.number_of_faces(); ++f)
    {
      const Eigen::Vector3d n = m_original.normal(f);
      wanted_faces += n.norm() / 2 / equilateral_area(face_size(f) / edges_per_quad / m_refinement);
      const std::array<int, 3>& t = m_original.triangles[f];
      if(triangle_shape(m_original.points[t[0]], m_original.points[t[1]],
                        m_original.points[t[2]], n) < sliver)
        ++slivers;
    }
    return m_original.number_of_faces() > least_ratio * wanted_faces
           || slivers > largest_share_of_slivers * m_original.number_of_faces();
  }

  // Returns `false` if there is no proxy that passes the checks. The proxy of a surface that is
  // itself folded, by noise, cannot pass in all faces: a few that are projected to both sides of a
  // fold are accepted if nothing better is found.
  bool build(Proxy_mesh& proxy)
  {
    const int most_attempts = 4;
    find_lengths();
    keep_corners_and_starts_of_chains();
    std::size_t fewest_folds = (std::numeric_limits<std::size_t>::max)();
    Isotropic_remesher remesher(m_original, m_length, m_is_kept);
    for(int i = 0; i < most_attempts && fewest_folds > 0; ++i)
    {
      remesher.run();
      Proxy_mesh candidate = make_proxy(remesher);
      const Defects defects = repair_projection(candidate);
      if(is_acceptable(candidate, defects))
      {
        if(defects.folded.size() >= fewest_folds)
          break;
        fewest_folds = defects.folded.size();
        proxy = candidate;
      }
      refine_near(candidate, defects);
    }
    return fewest_folds < (std::numeric_limits<std::size_t>::max)();
  }

private:
  static constexpr double edges_per_quad = 3;

  static double equilateral_area(double edge) { return std::sqrt(3.) / 4 * edge * edge; }

  double face_size(int f) const
  {
    const std::array<int, 3>& t = m_original.triangles[f];
    return (m_size[t[0]] + m_size[t[1]] + m_size[t[2]]) / 3;
  }

  // A quarter of a quad, or up to a half where this is the present length. Short loops and small
  // components get their share of edges.
  void find_lengths()
  {
    const double longest_per_quad = 0.5;
    double mean = 0;
    for(int h = 0; h < m_original.number_of_halfedges(); ++h)
      mean += m_original.vector(h).norm() / m_original.number_of_halfedges();
    m_length.clear();
    for(const double size : m_size)
      m_length.push_back((std::max)(size / edges_per_quad,
                                    (std::min)(mean, longest_per_quad * size)));
    limit_by_components();
    limit_by_loops();
    for(double& length : m_length)
      length /= m_refinement;
    limit_gradation(m_original, gradation, m_length);
  }

  void limit_by_components()
  {
    const double least_faces = 300;
    const std::vector<int> component = face_components(m_original);
    std::vector<double> area;
    for(int f = 0; f < m_original.number_of_faces(); ++f)
    {
      if(component[f] == static_cast<int>(area.size()))
        area.push_back(0);
      area[component[f]] += m_original.normal(f).norm() / 2;
    }
    for(int f = 0; f < m_original.number_of_faces(); ++f)
      for(const int v : m_original.triangles[f])
        m_length[v] = (std::min)(m_length[v], std::sqrt(area[component[f]] / least_faces));
  }

  void limit_by_loops()
  {
    const double edges_per_loop = 12;
    std::vector<char> is_visited(m_original.number_of_halfedges(), 0);
    for(int seed = 0; seed < m_original.number_of_halfedges(); ++seed)
    {
      std::vector<int> loop;
      double length = 0;
      for(int h = seed; m_original.is_border(h) && !is_visited[h];
          h = m_original.vertex_halfedge[m_original.target(h)])
      {
        is_visited[h] = 1;
        loop.push_back(m_original.source(h));
        length += m_original.vector(h).norm();
      }
      for(const int v : loop)
        m_length[v] = (std::min)(m_length[v], length / edges_per_loop);
    }
  }

  // The loops keep more than these: their edges are at most a ninth of their length.
  void keep_corners_and_starts_of_chains()
  {
    for(int h = 0; h < m_original.number_of_halfedges(); ++h)
    {
      const int v = m_original.source(h);
      if(m_original.is_border(h)
         && (m_original.is_corner[v] || !(m_original.boundary_piece[h].first > 0)))
        m_is_kept[v] = 1;
    }
  }

  Proxy_mesh make_proxy(const Isotropic_remesher& remesher) const
  {
    Proxy_mesh proxy;
    proxy.original = m_shared_original;
    proxy.mesh = remesher.mesh();
    proxy.place = remesher.places();
    proxy.normal = smoothed_normals(proxy.mesh, 0);
    for(const Working_location& place : proxy.place)
    {
      const std::array<int, 3>& t = m_original.triangles[place.face];
      proxy.size.push_back(place.barycentric[0] * m_size[t[0]] + place.barycentric[1] * m_size[t[1]]
                           + place.barycentric[2] * m_size[t[2]]);
    }
    return proxy;
  }

  enum class Projection_quality { GOOD, FOLDED, TORN };

  // faces of the proxy, and vertices of the original that belong to none of them
  struct Defects
  {
    std::vector<int> folded, torn, uncovered;
  };

  static bool is_acceptable(const Proxy_mesh& proxy, const Defects& defects)
  {
    const double largest_share_of_folds = 2e-3;
    return defects.torn.empty() && defects.uncovered.empty()
           && defects.folded.size() <= largest_share_of_folds * proxy.mesh.number_of_faces();
  }

  // Directions of projection that vary less cure most folds.
  Defects repair_projection(Proxy_mesh& proxy) const
  {
    const int most_rounds = 4;
    const Proxy_projection projection(proxy);
    std::vector<int> faces;
    for(int f = 0; f < proxy.mesh.number_of_faces(); ++f)
      faces.push_back(f);
    Defects defects;
    for(int round = 0;; ++round)
    {
      defects = find_defects(proxy, projection, faces);
      if(defects.folded.empty() || round == most_rounds)
        break;
      faces = smooth_directions(proxy, defects.folded);
    }
    defects.uncovered = uncovered_vertices(proxy);
    return defects;
  }

  // smooths the directions at the vertices of some faces, and returns all faces around
  static std::vector<int> smooth_directions(Proxy_mesh& proxy, const std::vector<int>& faces)
  {
    std::vector<int> vertices, affected;
    for(const int f : faces)
      vertices.insert(vertices.end(), proxy.mesh.triangles[f].begin(),
                      proxy.mesh.triangles[f].end());
    sort_and_unify(vertices);
    const std::vector<Eigen::Vector3d> normal = proxy.normal;
    for(const int v : vertices)
    {
      proxy.mesh.for_each_outgoing(v, [&](int h)
      {
        proxy.normal[v] += normal[proxy.mesh.target(h)];
        affected.push_back(h / 3);
      });
      proxy.normal[v].normalize();
    }
    sort_and_unify(affected);
    return affected;
  }

  static void sort_and_unify(std::vector<int>& values)
  {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }

  static Defects find_defects(const Proxy_mesh& proxy, const Proxy_projection& projection,
                              const std::vector<int>& faces)
  {
    Defects defects;
    for(const int f : faces)
      switch(projection_quality(proxy, projection, f))
      {
        case Projection_quality::GOOD: break;
        case Projection_quality::FOLDED: defects.folded.push_back(f); break;
        case Projection_quality::TORN: defects.torn.push_back(f); break;
      }
    return defects;
  }

  // The images of small triangles of a face are oriented like it, and not much larger or far away.
  static Projection_quality projection_quality(const Proxy_mesh& proxy,
                                               const Proxy_projection& projection, int f)
  {
    constexpr int n = 3;
    const double largest_stretch = 4, largest_distance = 0.5;
    const std::array<int, 3>& t = proxy.mesh.triangles[f];
    const Eigen::Vector3d normal = proxy.mesh.normal(f);
    std::array<std::array<Eigen::Vector3d, n + 1>, n + 1> image;
    double longest = 0;
    for(int i = 0; i < 3; ++i)
      longest = (std::max)(longest, proxy.mesh.vector(3 * f + i).norm());
    for(int i = 0; i <= n; ++i)
      for(int j = 0; i + j <= n; ++j)
      {
        const std::array<double, 3> b = {{double(n - i - j) / n, double(i) / n, double(j) / n}};
        image[i][j] = projection.point(projection(Working_location{f, b}));
        const Eigen::Vector3d p = b[0] * proxy.mesh.points[t[0]] + b[1] * proxy.mesh.points[t[1]]
                                  + b[2] * proxy.mesh.points[t[2]];
        if(!((image[i][j] - p).norm() <= largest_distance * longest))
          return Projection_quality::TORN;
      }
    const double longest_image = largest_stretch * longest / n;
    Projection_quality quality = Projection_quality::GOOD;
    const auto check = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c)
    {
      if((std::max)({(b - a).norm(), (c - b).norm(), (a - c).norm()}) > longest_image)
        quality = Projection_quality::TORN;
      else if(quality == Projection_quality::GOOD && !(normal.dot((b - a).cross(c - a)) > 0))
        quality = Projection_quality::FOLDED;
    };
    for(int i = 0; i < n; ++i)
      for(int j = 0; i + j < n; ++j)
      {
        check(image[i][j], image[i + 1][j], image[i][j + 1]);
        if(i + j + 1 < n)
          check(image[i + 1][j], image[i + 1][j + 1], image[i][j + 1]);
      }
    return quality;
  }

  // Every vertex of the original must be near a vertex of the proxy, on a way along edges.
  std::vector<int> uncovered_vertices(const Proxy_mesh& proxy) const
  {
    const double largest_distance = 3;
    typedef std::pair<double, int> Entry; // (relative distance, vertex)
    std::vector<double> distance(m_original.number_of_vertices(),
                                 std::numeric_limits<double>::infinity());
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry> > queue;
    const auto reach = [&](int v, double d)
    {
      if(!(d < distance[v]) || d > largest_distance)
        return;
      distance[v] = d;
      queue.emplace(d, v);
    };
    for(const Working_location& place : proxy.place)
      for(const int v : m_original.triangles[place.face])
        reach(v, 0);
    while(!queue.empty())
    {
      const Entry top = queue.top();
      queue.pop();
      if(top.first > distance[top.second])
        continue;
      const auto step = [&](int w, int h)
        { reach(w, top.first + m_original.vector(h).norm() / m_length[w]); };
      m_original.for_each_outgoing(top.second, [&](int h)
      {
        const int back = Working_mesh::previous(h);
        step(m_original.target(h), h);
        step(m_original.source(back), back);
      });
    }
    std::vector<int> uncovered;
    for(int v = 0; v < m_original.number_of_vertices(); ++v)
      if(!(distance[v] <= largest_distance))
        uncovered.push_back(v);
    return uncovered;
  }

  void refine_near(const Proxy_mesh& proxy, const Defects& defects)
  {
    const double reduction = 0.5;
    std::vector<int> vertices = defects.uncovered;
    for(const std::vector<int>* faces : {&defects.folded, &defects.torn})
      for(const int f : *faces)
        for(const int v : proxy.mesh.triangles[f])
          for(const int w : m_original.triangles[proxy.place[v].face])
            vertices.push_back(w);
    sort_and_unify(vertices);
    for(const int v : vertices)
      m_length[v] *= reduction;
    limit_gradation(m_original, gradation, m_length);
  }

  // growth of the edge length per unit length
  static constexpr double gradation = 0.3;

  std::shared_ptr<const Working_mesh> m_shared_original;
  const Working_mesh& m_original;
  const std::vector<double>& m_size;
  std::vector<char> m_is_kept;
  double m_refinement;
  std::vector<double> m_length; // per vertex of the original: wanted edge length of the proxy
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PROXY_MAKE_PROXY_MESH_H
