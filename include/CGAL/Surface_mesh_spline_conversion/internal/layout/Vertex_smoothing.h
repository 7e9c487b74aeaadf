// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_VERTEX_SMOOTHING_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_VERTEX_SMOOTHING_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Work_budget.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Harmonic_disk.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/evenness.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/scaled_jacobian.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

inline Surface_sample surface_sample(const Working_mesh& mesh, const Working_location& at)
{
  return Surface_sample{point_at(mesh, at), mesh.normal(at.face)};
}

// Motions of the surface around the corners of flat quads that are not convex or next to it, one
// corner after the other, where these make the worst quad at the corner better. A quad may be as
// the map wants it, and yet be inverted when it is drawn flat, as where the surface turns much
// within it, or where the projection from a proxy displaces its corners. Quads are judged where the
// layout has them, which is not on the proxy. If some stay inverted, corners move farther: at a
// place much thinner than a quad, a short motion in a disk around a corner is next to none.
//
// Several motions of the same corner may squeeze the map beside it so much that no surface follows
// it without folds, though the flat quads are fine. Such motions are refused, unless flat quads have
// the priority.
class Vertex_smoothing
{
public:
  // from a point of the working mesh to the one of the layout's surface, and a normal there
  typedef std::function<Surface_sample(const Working_location&)> Image;

  enum class Priority { EVEN_MAP, FLAT_QUADS };

  // of a quad: see `oriented_scaled_jacobian()`
  static constexpr double tolerable_shape = 0.15;

  Vertex_smoothing() {}

  // `locate`: the point of the working mesh at the local coordinates of a quad, before the motions
  template <typename Locate>
  Vertex_smoothing(const Seamless_map& map, const Quad_grid& grid, const Image& image,
                   const Locate& locate, Priority priority = Priority::EVEN_MAP,
                   const Work_budget& budget = Work_budget())
    : m_motions_at(map.mesh.number_of_faces()), m_map(&map), m_grid(&grid), m_image(image),
      m_locate(locate), m_priority(priority), m_budget(budget)
  {
    locate_vertices(locate);
    improve_all(tolerable_shape, Reach::NEAR);
    if(has_inverted_quads())
    {
      m_failures.assign(m_vertices.size(), std::nullopt);
      improve_all(0, Reach::FAR);
      if(!has_inverted_quads())
        improve_all(tolerable_shape, Reach::FAR);
    }
    forget_construction();
  }

  Working_location operator()(Working_location at) const
  {
    if(m_motions_at.empty())
      return at;
    // a motion may lead to a face with later ones
    for(int next = 0; (next = first_motion(at.face, next)) >= 0; ++next)
      at = (*m_motions[next])(at);
    return at;
  }

private:
  // of the map in a quad: see `evenness()`
  static constexpr double tolerable_evenness = 0.1;

  // of images of points
  static constexpr double work_per_image = 3;

  // disks around the corner and short motions; disks beside it and motions through all of the disk
  enum class Reach { NEAR, FAR };

  // an attempt to move a vertex that made nothing better, and what it depended on
  struct Failure
  {
    int motions;                                // how many there were
    std::vector<int> faces, quads;
  };

  struct Disk_at_middle
  {
    Working_location middle;
    std::shared_ptr<Harmonic_disk> disk;
  };

  template <typename Locate>
  void locate_vertices(const Locate& locate)
  {
    m_vertices.assign(m_grid->number_of_vertices(), Working_location{-1, {{0, 0, 0}}});
    m_points.resize(m_vertices.size());
    m_middles.resize(m_grid->number_of_quads());
    m_normals.resize(m_middles.size());
    m_quads_at.resize(m_grid->number_of_vertices());
    m_failures.assign(m_vertices.size(), std::nullopt);
    m_last_motion_of.assign(m_middles.size(), -1);
    for(int q = 0; q < m_grid->number_of_quads(); ++q)
    {
      for(int i = 0; i < 4; ++i)
      {
        const int v = m_grid->vertices[q][i];
        m_quads_at[v].push_back(q);
        if(m_vertices[v].face < 0)
          move_vertex(v, locate(q, i == 1 || i == 2, i >= 2));
      }
      move_middle(q, locate(q, 0.5, 0.5));
    }
  }

  void move_vertex(int v, const Working_location& at)
  {
    m_budget.spend(work_per_image);
    m_vertices[v] = at;
    m_points[v] = m_image(at).point;
  }

  void move_middle(int quad, const Working_location& at)
  {
    m_middles[quad] = at;
    m_normals[quad] = m_image(at).normal;
  }

  void forget_construction()
  {
    m_map = nullptr;
    m_grid = nullptr;
    m_image = Image();
    m_locate = nullptr;
    m_vertices.clear();
    m_points.clear();
    m_middles.clear();
    m_normals.clear();
    m_quads_at.clear();
    m_failures.clear();
    m_last_motion_of.clear();
    m_disks_at_middle.clear();
  }

  // the first of the motions from number `i` on with parts of a face, or -1
  int first_motion(int face, int i) const
  {
    const std::vector<int>& motions = m_motions_at[face];
    const auto next = std::lower_bound(motions.begin(), motions.end(), i);
    return next == motions.end() ? -1 : *next;
  }

  bool has_inverted_quads() const
  {
    for(int q = 0; q < m_grid->number_of_quads(); ++q)
      if(!(shape_of(q) > 0))
        return true;
    return false;
  }

  void improve_all(double bad_shape, Reach reach)
  {
    const int most_rounds = 8;
    bool is_changed = true;
    for(int round = 0; round < most_rounds && is_changed; ++round)
    {
      is_changed = false;
      for(int q = 0; q < m_grid->number_of_quads(); ++q)
        if(!m_budget.is_used_up() && shape_of(q) <= bad_shape)
          is_changed = improve(q, reach) || is_changed;
    }
  }

  // Moves the inner corners of a quad; `false` if none did.
  bool improve(int quad, Reach reach)
  {
    bool is_changed = false;
    for(const int v : m_grid->vertices[quad])
      if(!m_grid->is_border_vertex[v])
        is_changed = improve_vertex(v, reach) || is_changed;
    return is_changed;
  }

  bool improve_vertex(int v, Reach reach)
  {
    if(m_failures[v] && is_current(*m_failures[v]))
      return false;
    Failure failure{static_cast<int>(m_motions.size()), {}, m_quads_at[v]};
    if(reach == Reach::NEAR ? shift_in_disks(v, failure) : drag_in_disks(v, failure))
      return true;
    m_failures[v] = std::move(failure);
    return false;
  }

  bool shift_in_disks(int v, Failure& failure)
  {
    for(const double radius : {0.8, 0.4, 0.2}) // in quads
    {
      const auto disk = std::make_shared<Harmonic_disk>(
        Map_neighborhood(*m_map, std::vector<Working_location>(1, m_vertices[v]), radius), radius,
        Harmonic_disk::Weights::GEOMETRIC, m_budget);
      if(disk->is_valid() && shift(v, disk, failure))
        return true;
    }
    return false;
  }

  // in disks around the middles of the quads at the vertex
  bool drag_in_disks(int v, Failure& failure)
  {
    for(const double radius : {0.8, 1.1}) // in quads
      for(const int q : m_quads_at[v])
      {
        const std::shared_ptr<Harmonic_disk> disk = disk_at_middle(q, radius);
        if(!disk || !disk->is_valid() || !drag(v, disk, failure))
          continue;
        m_disks_at_middle.erase(std::make_pair(q, radius));
        return true;
      }
    return false;
  }

  // Combinatorial weights leave room to what is small: no part of the surface is too thin. Null at
  // the boundary, which a drag leaves where it is only within rounding.
  std::shared_ptr<Harmonic_disk> disk_at_middle(int quad, double radius)
  {
    const Working_location& middle = m_middles[quad];
    Disk_at_middle& known = m_disks_at_middle[std::make_pair(quad, radius)];
    if(known.disk && known.middle.face == middle.face
       && known.middle.barycentric == middle.barycentric)
      return known.disk;
    known = Disk_at_middle{middle, nullptr};
    const Map_neighborhood neighborhood(*m_map, std::vector<Working_location>(1, middle), radius);
    if(!neighborhood.reaches_border())
      known.disk = std::make_shared<Harmonic_disk>(neighborhood, radius,
                                                   Harmonic_disk::Weights::COMBINATORIAL,
                                                   m_budget);
    return known.disk;
  }

  // `true` if nothing has moved that the attempt depended on: another one would fail as well
  bool is_current(const Failure& failure) const
  {
    return std::all_of(failure.faces.begin(), failure.faces.end(), [&](int f)
             { return m_motions_at[f].empty() || m_motions_at[f].back() < failure.motions; })
           && std::all_of(failure.quads.begin(), failure.quads.end(), [&](int q)
                { return m_last_motion_of[q] < failure.motions; });
  }

  // Looks for the best place of the vertex in the disk. Adds to `failure` what a rejection depends
  // on.
  bool shift(int v, const std::shared_ptr<Harmonic_disk>& disk, Failure& failure)
  {
    const Working_location old = m_vertices[v];
    const std::optional<Eigen::Vector2d> place = disk->place(old);
    if(!place)
      return false;
    const Eigen::Vector2d from = *place;
    const double shape = least_shape(m_quads_at[v]);
    double best_shape = shape;
    Eigen::Vector2d best = from;
    const int directions = 12;
    for(const double length : {0.12, 0.24, 0.36})
      for(int i = 0; i < directions; ++i)
      {
        const double angle = 2 * pi * i / directions;
        const Eigen::Vector2d to
          = from + length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        move_vertex(v, disk->at_place(to));
        if(const double moved_shape = least_shape(m_quads_at[v]); moved_shape > best_shape)
        {
          best_shape = moved_shape;
          best = to;
        }
      }
    move_vertex(v, old);
    return best != from && disk->shift(from, best) && accept(disk, failure);
  }

  // Looks for the best place of the vertex in all of the disk that others agree with.
  bool drag(int v, const std::shared_ptr<Harmonic_disk>& disk, Failure& failure)
  {
    const double largest_radius = 0.99;
    const int directions = 12, most_trials = 6;
    const Working_location old = m_vertices[v];
    const std::optional<Eigen::Vector2d> from = disk->place(old);
    if(!from || from->norm() > largest_radius)
      return false;
    const double shape = least_shape(m_quads_at[v]);
    std::vector<std::pair<double, Eigen::Vector2d> > better;
    for(const double length : {0.2, 0.5, 0.8})
      for(int i = 0; i < directions; ++i)
      {
        const double angle = 2 * pi * i / directions;
        const Eigen::Vector2d to = length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        move_vertex(v, disk->at_place(to));
        if(const double moved_shape = least_shape(m_quads_at[v]); moved_shape > shape)
          better.emplace_back(moved_shape, to);
      }
    move_vertex(v, old);
    std::stable_sort(better.begin(), better.end(), [](const auto& a, const auto& b)
      { return a.first > b.first; });
    better.resize((std::min)(better.size(), std::size_t(most_trials)));
    return std::any_of(better.begin(), better.end(), [&](const auto& candidate)
    {
      disk->drag(*from, candidate.second);
      return accept(disk, failure);
    });
  }

  // Moves all that lies in the disk if this makes the worst of the quads that change better, and
  // leaves the map tolerable.
  bool accept(const std::shared_ptr<const Harmonic_disk>& disk, Failure& failure)
  {
    const auto is_at = [&](const Working_location& at)
    { return std::binary_search(disk->faces().begin(), disk->faces().end(), at.face); };
    std::vector<int> vertices, middles, quads;
    for(int v = 0; v < m_grid->number_of_vertices(); ++v)
      if(is_at(m_vertices[v]))
      {
        vertices.push_back(v);
        quads.insert(quads.end(), m_quads_at[v].begin(), m_quads_at[v].end());
      }
    for(int q = 0; q < m_grid->number_of_quads(); ++q)
      if(is_at(m_middles[q]))
      {
        middles.push_back(q);
        quads.push_back(q);
      }
    const std::vector<double> before = shapes_of(quads);
    const std::vector<Working_location> old_vertices = m_vertices, old_middles = m_middles;
    for(const int v : vertices)
      move_vertex(v, (*disk)(m_vertices[v]));
    for(const int q : middles)
      move_middle(q, (*disk)(m_middles[q]));
    if(!is_worst_change_better(before, shapes_of(quads)) || squeezes(*disk, quads))
    {
      for(const int v : vertices)
        move_vertex(v, old_vertices[v]);
      for(const int q : middles)
        move_middle(q, old_middles[q]);
      failure.faces.insert(failure.faces.end(), disk->faces().begin(), disk->faces().end());
      failure.quads.insert(failure.quads.end(), quads.begin(), quads.end());
      return false;
    }
    for(const int q : quads)
      m_last_motion_of[q] = static_cast<int>(m_motions.size());
    for(const int f : disk->faces())
      m_motions_at[f].push_back(static_cast<int>(m_motions.size()));
    m_motions.push_back(disk);
    return true;
  }

  std::vector<double> shapes_of(const std::vector<int>& quads) const
  {
    std::vector<double> shapes;
    for(const int q : quads)
      shapes.push_back(shape_of(q));
    return shapes;
  }

  // Would the motion of a disk make the map in a quad less even, and intolerable?
  bool squeezes(const Harmonic_disk& disk, const std::vector<int>& quads) const
  {
    if(m_priority == Priority::FLAT_QUADS)
      return false;
    const auto stay = [](const Working_location& at) { return at; };
    const std::set<int> different(quads.begin(), quads.end());
    return std::any_of(different.begin(), different.end(), [&](int q)
    {
      const double after = evenness_after(disk, q);
      return after < tolerable_evenness && after < evenness_after(stay, q);
    });
  }

  template <typename Motion>
  double evenness_after(const Motion& motion, int quad) const
  {
    const double cells = samples_per_side - 1;
    m_budget.spend(work_per_image * samples_per_side * samples_per_side);
    std::vector<Surface_sample> samples;
    for(int j = 0; j < samples_per_side; ++j)
      for(int i = 0; i < samples_per_side; ++i)
        samples.push_back(m_image(motion((*this)(m_locate(quad, i / cells, j / cells)))));
    return evenness(samples);
  }

  // Compares the least of the values that differ.
  static bool is_worst_change_better(const std::vector<double>& before,
                                     const std::vector<double>& after)
  {
    double least_before = 1, least_after = 1;
    for(std::size_t i = 0; i < before.size(); ++i)
      if(before[i] != after[i])
      {
        least_before = (std::min)(least_before, before[i]);
        least_after = (std::min)(least_after, after[i]);
      }
    return least_after > least_before;
  }

  double least_shape(const std::vector<int>& quads) const
  {
    double least = 1;
    for(const int q : quads)
      least = (std::min)(least, shape_of(q));
    return least;
  }

  double shape_of(int quad) const
  {
    std::array<Eigen::Vector3d, 4> points;
    for(int i = 0; i < 4; ++i)
      points[i] = m_points[m_grid->vertices[quad][i]];
    return oriented_scaled_jacobian(points, m_normals[quad]);
  }

  std::vector<std::shared_ptr<const Harmonic_disk> > m_motions; // one after the other
  std::vector<std::vector<int> > m_motions_at;  // per face of the working mesh, sorted
  // during construction only
  const Seamless_map* m_map = nullptr;
  const Quad_grid* m_grid = nullptr;
  Image m_image;
  std::function<Working_location(int, double, double)> m_locate; // before the motions
  Priority m_priority = Priority::EVEN_MAP;
  Work_budget m_budget;
  std::vector<Working_location> m_vertices;     // per vertex of the grid
  std::vector<Eigen::Vector3d> m_points;        // per vertex of the grid, on the layout's surface
  std::vector<Working_location> m_middles;      // per quad
  std::vector<Eigen::Vector3d> m_normals;       // per quad, at its middle
  std::vector<std::vector<int> > m_quads_at;    // per vertex of the grid
  std::vector<std::optional<Failure> > m_failures; // per vertex of the grid: the last one, if any
  std::map<std::pair<int, double>, Disk_at_middle> m_disks_at_middle; // by quad and radius
  std::vector<int> m_last_motion_of;            // per quad: the last motion of a part of it, or -1
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_VERTEX_SMOOTHING_H
