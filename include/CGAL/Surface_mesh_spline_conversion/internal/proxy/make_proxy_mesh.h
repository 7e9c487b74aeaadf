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
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Projection_fold_check.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Proxy_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Proxy_projection.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Surface_unfolder.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
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

  // Returns `false` if there is no proxy that passes the checks. The projection from a proxy of a
  // surface that is itself folded may have folds in a few faces. Where folds are not local, the
  // proxy would grow at each attempt: one that is much larger than the mesh is given up.
  bool build(Proxy_mesh& proxy)
  {
    const int most_attempts = 4;
    const std::size_t many = (std::numeric_limits<std::size_t>::max)(), tolerable_growth = 2;
    find_lengths();
    keep_corners_and_starts_of_chains();
    std::size_t fewest_folds = many, folds_before = many / tolerable_growth, most_faces = 0;
    Isotropic_remesher remesher(m_original, m_length, m_is_kept);
    for(int i = 0; i < most_attempts && fewest_folds > 0; ++i)
    {
      remesher.run();
      const std::size_t present_faces = remesher.mesh().triangles.size();
      if(i == 0)
        most_faces = tolerable_growth * (std::max)(m_original.triangles.size(), present_faces);
      if(present_faces > most_faces)
        break;
      Proxy_mesh candidate = make_proxy(remesher);
      const Defects defects = repair_projection(candidate);
      if(is_acceptable(candidate, defects))
      {
        if(defects.folded.size() >= fewest_folds)
          break;
        fewest_folds = defects.folded.size();
        proxy = candidate;
        proxy.is_folded = fewest_folds > 0;
      }
      // smaller faces meet more of the folds of the original
      if(defects.folded.size() > tolerable_growth * folds_before)
        break;
      folds_before = defects.folded.size();
      refine_near(candidate, defects);
    }
    return fewest_folds < many;
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
    proxy.original = proxy.unfolded = m_shared_original;
    proxy.mesh = remesher.mesh();
    proxy.place = remesher.places();
    proxy.normal = smoothed_normals(proxy.mesh, 0);
    for(int v = 0; v < proxy.mesh.number_of_vertices(); ++v)
      turn_to_all_faces(proxy.mesh, v, proxy.normal[v]);
    for(const Working_location& place : proxy.place)
    {
      const std::array<int, 3>& t = m_original.triangles[place.face];
      proxy.size.push_back(place.barycentric[0] * m_size[t[0]] + place.barycentric[1] * m_size[t[1]]
                           + place.barycentric[2] * m_size[t[2]]);
    }
    return proxy;
  }

  // Turns a direction at a vertex, such as the mean normal at a thin rim, until no face around is
  // seen from behind or edge-on, if possible: a step towards the normal of the face seen worst.
  static void turn_to_all_faces(const Working_mesh& mesh, int v, Eigen::Vector3d& direction)
  {
    const double least_cosine = 0.02, step = 0.1;
    const int most_steps = 200;
    std::vector<Eigen::Vector3d> normals;
    mesh.for_each_outgoing(v, [&](int h) { normals.push_back(mesh.normal(h / 3).normalized()); });
    const Eigen::Vector3d start = direction;
    for(int i = 0; i < most_steps; ++i)
    {
      const auto worst = std::min_element(normals.begin(), normals.end(),
        [&](const Eigen::Vector3d& m, const Eigen::Vector3d& n)
        { return m.dot(direction) < n.dot(direction); });
      if(worst->dot(direction) >= least_cosine)
        return;
      direction += (least_cosine - worst->dot(direction) + step / (i + 1)) * *worst;
      direction.normalize();
    }
    direction = start;
  }

  // faces of the proxy, and vertices of the original that belong to no face of the proxy
  struct Defects
  {
    std::vector<int> folded, torn, uncovered;
  };

  static bool is_acceptable(const Proxy_mesh& proxy, const Defects& defects)
  {
    const double largest_share_of_folds = 5e-3;
    return defects.torn.empty() && defects.uncovered.empty()
           && defects.folded.size() <= largest_share_of_folds * proxy.mesh.number_of_faces();
  }

  // Cures what folds it can. Directions of projection that vary less help most, unless so much is
  // folded that the proxy has little to do with the mesh; what remains is mostly folded itself,
  // unless there is so much that the proxy is too coarse.
  Defects repair_projection(Proxy_mesh& proxy) const
  {
    const double largest_share = 0.25, largest_share_to_unfold = 0.02;
    std::vector<int> faces;
    for(int f = 0; f < proxy.mesh.number_of_faces(); ++f)
      faces.push_back(f);
    std::vector<int> folded = folded_faces(proxy, faces);
    if(can_cure(proxy, folded, largest_share))
    {
      Proxy_mesh candidate = proxy;
      const std::size_t remaining = cure_folds(candidate, folded,
        [&candidate](const std::vector<int>& present) { smooth_directions(candidate, present); });
      if(remaining < folded.size())
        keep_if_better(candidate, faces_to_check(proxy, candidate, folded), proxy, folded);
    }
    const int most_rounds = 2;
    for(int i = 0; i < most_rounds && can_cure(proxy, folded, largest_share_to_unfold); ++i)
    {
      Proxy_mesh candidate = proxy;
      // where it fails once, it does so again
      if(unfold(candidate, folded) >= folded.size()
         || !keep_if_better(candidate, faces, proxy, folded))
        break;
    }
    return Defects{folded, torn_faces(proxy), uncovered_vertices(proxy)};
  }

  static bool can_cure(const Proxy_mesh& proxy, const std::vector<int>& folded,
                       double largest_share)
  {
    return !folded.empty() && folded.size() <= largest_share * proxy.mesh.number_of_faces();
  }

  // Replaces a proxy and its folded faces if the other one has fewer. `faces`: those of the other
  // one that may be folded
  static bool keep_if_better(Proxy_mesh& candidate, const std::vector<int>& faces,
                             Proxy_mesh& proxy, std::vector<int>& folded)
  {
    std::vector<int> remaining = folded_faces(candidate, faces);
    if(remaining.size() >= folded.size())
      return false;
    folded = std::move(remaining);
    proxy = std::move(candidate);
    return true;
  }

  // the folded faces, and those at which directions have changed, sorted
  static std::vector<int> faces_to_check(const Proxy_mesh& before, const Proxy_mesh& after,
                                         const std::vector<int>& folded)
  {
    std::vector<int> faces = folded;
    for(int f = 0; f < after.mesh.number_of_faces(); ++f)
    {
      const std::array<int, 3>& t = after.mesh.triangles[f];
      if(std::any_of(t.begin(), t.end(), [&before, &after](int v)
         { return after.normal[v] != before.normal[v]; }))
        faces.push_back(f);
    }
    sort_and_unify(faces);
    return faces;
  }

  // Applies `cure(folded)` a few times, to what is left. Returns how many faces near the present
  // ones are folded in the end: there are no fewer in all.
  template <typename Cure>
  static std::size_t cure_folds(const Proxy_mesh& proxy, std::vector<int> folded, const Cure& cure)
  {
    const int rounds = 8;
    const std::size_t most_folds = 2 * folded.size();
    for(int i = 0; i < rounds && !folded.empty() && folded.size() <= most_folds; ++i)
    {
      cure(folded);
      folded = folded_faces(proxy, faces_around(proxy.mesh, folded));
    }
    return folded.size();
  }

  // Unfolds the original, and lets the proxy follow. Returns what `cure_folds()` does.
  std::size_t unfold(Proxy_mesh& proxy, const std::vector<int>& folded) const
  {
    Surface_unfolder unfolder(m_original, *proxy.unfolded);
    proxy.unfolded = unfolder.mesh();
    return cure_folds(proxy, folded, [&](const std::vector<int>& present)
    {
      unfolder.unfold(faces_below(proxy, present));
      follow_unfolded(proxy, present);
    });
  }

  // Places the vertices on the unfolded original, those of some faces near the means of their
  // neighbors.
  static void follow_unfolded(Proxy_mesh& proxy, const std::vector<int>& faces)
  {
    const Surface_walk walk(*proxy.unfolded);
    const auto place_near = [&](int v, const Eigen::Vector3d& p)
    {
      proxy.place[v] = walk.project(p, proxy.normal[v], proxy.place[v].face);
      proxy.mesh.points[v] = walk.point(proxy.place[v]);
    };
    for(int v = 0; v < proxy.mesh.number_of_vertices(); ++v)
      if(!proxy.mesh.is_border_vertex(v) && walk.point(proxy.place[v]) != proxy.mesh.points[v])
        place_near(v, proxy.mesh.points[v]);
    const std::vector<int> vertices = vertices_of(proxy.mesh, faces);
    for(const int v : vertices)
      if(!proxy.mesh.is_border_vertex(v))
        place_near(v, mean_of_neighbors(proxy.mesh, v));
    for(const int v : vertices)
      turn_to_all_faces(proxy.mesh, v, proxy.normal[v]);
  }

  static void smooth_directions(Proxy_mesh& proxy, const std::vector<int>& faces)
  {
    const std::vector<Eigen::Vector3d> normal = proxy.normal;
    for(const int v : vertices_of(proxy.mesh, faces))
    {
      proxy.mesh.for_each_outgoing(v, [&](int h)
        { proxy.normal[v] += normal[proxy.mesh.target(h)]; });
      proxy.normal[v].normalize();
      turn_to_all_faces(proxy.mesh, v, proxy.normal[v]);
    }
  }

  // sorted
  static std::vector<int> vertices_of(const Working_mesh& mesh, const std::vector<int>& faces)
  {
    std::vector<int> vertices;
    for(const int f : faces)
      vertices.insert(vertices.end(), mesh.triangles[f].begin(), mesh.triangles[f].end());
    sort_and_unify(vertices);
    return vertices;
  }

  // the faces with a vertex of one of some faces, sorted
  static std::vector<int> faces_around(const Working_mesh& mesh, const std::vector<int>& faces)
  {
    std::vector<int> around;
    for(const int v : vertices_of(mesh, faces))
      mesh.for_each_outgoing(v, [&around](int h) { around.push_back(h / 3); });
    sort_and_unify(around);
    return around;
  }

  static void sort_and_unify(std::vector<int>& values)
  {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }

  // those of some faces that may be folded
  static std::vector<int> folded_faces(const Proxy_mesh& proxy, const std::vector<int>& faces)
  {
    Projection_fold_check fold_check(proxy);
    std::vector<int> folded;
    std::copy_if(faces.begin(), faces.end(), std::back_inserter(folded),
                 [&fold_check](int f) { return fold_check.is_folded(f); });
    return folded;
  }

  // the faces of the original at which the projection of some folded faces has its folds, sorted
  static std::vector<int> faces_below(const Proxy_mesh& proxy, const std::vector<int>& folded)
  {
    Projection_fold_check fold_check(proxy);
    std::vector<int> below;
    for(const int f : folded)
      fold_check.append_folded(f, below);
    sort_and_unify(below);
    return below;
  }

  static std::vector<int> torn_faces(const Proxy_mesh& proxy)
  {
    const Proxy_projection projection(proxy);
    std::vector<int> torn;
    for(int f = 0; f < proxy.mesh.number_of_faces(); ++f)
      if(is_torn(proxy, projection, f))
        torn.push_back(f);
    return torn;
  }

  // Are the images of some small triangles of a face much larger or far away?
  static bool is_torn(const Proxy_mesh& proxy, const Proxy_projection& projection, int f)
  {
    constexpr int n = 3;
    const double largest_stretch = 4, largest_distance = 0.5;
    std::array<std::array<Eigen::Vector3d, n + 1>, n + 1> image;
    double longest = 0;
    for(int i = 0; i < 3; ++i)
      longest = (std::max)(longest, proxy.mesh.vector(3 * f + i).norm());
    const double longest_image = largest_stretch * longest / n;
    for(int i = 0; i <= n; ++i)
      for(int j = 0; i + j <= n; ++j)
      {
        const Working_location at{f, {{double(n - i - j) / n, double(i) / n, double(j) / n}}};
        image[i][j] = projection.point(projection(at));
        if(!((image[i][j] - point_at(proxy.mesh, at)).norm() <= largest_distance * longest)
           || (i > 0 && (image[i][j] - image[i - 1][j]).norm() > longest_image)
           || (j > 0 && (image[i][j] - image[i][j - 1]).norm() > longest_image)
           || (i > 0 && (image[i][j] - image[i - 1][j + 1]).norm() > longest_image))
          return true;
      }
    return false;
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
