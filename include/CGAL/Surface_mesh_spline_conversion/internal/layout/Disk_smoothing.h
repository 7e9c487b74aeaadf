// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_DISK_SMOOTHING_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_DISK_SMOOTHING_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/Work_budget.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Harmonic_disk.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/scaled_jacobian.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Motions of the surface near badly shaped flat quads of a map, where these make the worst quad
// better: see `Harmonic_disk`. Disks that would meet are replaced by one around all their centers.
class Disk_smoothing
{
public:
  Disk_smoothing() {}

  // `locate`: the point of the working mesh at the local coordinates of a quad, without motions
  template <typename Locate>
  Disk_smoothing(const Seamless_map& map, const Quad_grid& grid, const Locate& locate,
                 const Work_budget& budget = Work_budget())
    : m_disks_at(map.mesh.number_of_faces()), m_map(&map), m_grid(&grid),
      m_quads_at(map.mesh.number_of_faces()), m_budget(budget)
  {
    locate_quads(locate);
    std::vector<std::pair<double, int> > bad;
    for(int q = 0; q < grid.number_of_quads(); ++q)
      if(const double shape = shape_of(q, Change()); shape < good_shape)
        bad.emplace_back(shape, q);
    std::sort(bad.begin(), bad.end());
    for(const auto& quad : bad)
      if(!m_budget.is_used_up() && shape_of(quad.second, Change()) < good_shape)
        smooth(quad.second);
    forget_construction();
  }

  Working_location operator()(const Working_location& at) const
  {
    return m_disks_at.empty() ? at : moved(at, Change());
  }

private:
  struct Disk
  {
    std::vector<Working_location> centers;
    std::shared_ptr<const Harmonic_disk> motion;
  };

  // one more disk, and those that it replaces
  struct Change
  {
    Disk disk;
    std::vector<int> replaced; // sorted
  };

  // of a quad: see `shape_of()`
  static constexpr double good_shape = 0.5;
  // of a disk: a quad with a long part in its middle has a good shape when it is drawn flat, but
  // next to all of the surface lies below a small part of it then
  static constexpr double largest_squeezed_share = 0.1;

  template <typename Locate>
  void locate_quads(const Locate& locate)
  {
    for(int q = 0; q < m_grid->number_of_quads(); ++q)
    {
      std::array<Working_location, 5> at;
      for(int i = 0; i < 4; ++i)
        at[i] = locate(q, i == 1 || i == 2, i >= 2);
      at[4] = locate(q, 0.5, 0.5);
      for(int i = 0; i < 4; ++i)
        m_quads_at[at[i].face].push_back(q);
      m_places.push_back(at);
    }
  }

  void forget_construction()
  {
    m_map = nullptr;
    m_grid = nullptr;
    m_places.clear();
    m_quads_at.clear();
  }

  // Takes the first disk that makes the quads good, or else the best one if it is better than none.
  void smooth(int quad)
  {
    const std::array<double, 6> radii = {{1.6, 2.4, 4, 6.4, 10, 0.8}}; // in quads
    Change best;
    double best_shape = 0;
    bool is_too_large = false;
    for(const double radius : radii)
    {
      Change change;
      if((is_too_large && radius > radii[0]) || !make_change(quad, radius, change))
      {
        is_too_large = true;
        continue;
      }
      const std::vector<int> quads = quads_near(change);
      const double shape = least_shape(quads, change);
      if(best.disk.motion ? shape <= best_shape : shape <= least_shape(quads, Change()))
        continue;
      best = change;
      best_shape = shape;
      if(shape > good_shape)
        break;
    }
    if(best.disk.motion)
      apply(best);
  }

  // A disk around the quad, and around the centers of the disks that it meets.
  bool make_change(int quad, double radius, Change& change) const
  {
    const std::size_t most_replaced = 12;
    change.disk.centers = centers_at(quad);
    Map_neighborhood neighborhood(*m_map, change.disk.centers, radius);
    while(change.replaced.size() <= most_replaced)
    {
      const auto disk = std::make_shared<Harmonic_disk>(
        neighborhood, radius, Harmonic_disk::Weights::GEOMETRIC, m_budget);
      if(!disk->is_valid() || !disk->follow_map()
         || disk->squeezed_share() > largest_squeezed_share)
        return false;
      change.disk.motion = disk;
      std::vector<int> met;
      for(const int other : disks_near(*disk))
        if(!contains(change.replaced, other) && disk->meets(*m_disks[other].motion))
          met.push_back(other);
      if(met.empty())
        return true;
      for(const int other : met)
        for(const Working_location& center : m_disks[other].centers)
        {
          change.disk.centers.push_back(center);
          neighborhood.add_place(center);
        }
      change.replaced.insert(change.replaced.end(), met.begin(), met.end());
      std::sort(change.replaced.begin(), change.replaced.end());
    }
    return false;
  }

  // the singularities of a quad, or else its middle
  std::vector<Working_location> centers_at(int quad) const
  {
    std::vector<Working_location> centers;
    for(int i = 0; i < 4; ++i)
      if(const int v = m_grid->vertices[quad][i];
         !m_grid->is_border_vertex[v] && m_grid->valence[v] != 4)
        centers.push_back(m_places[quad][i]);
    if(centers.empty())
      centers.push_back(m_places[quad][4]);
    return centers;
  }

  static bool contains(const std::vector<int>& sorted, int i)
  {
    return std::binary_search(sorted.begin(), sorted.end(), i);
  }

  // those with faces of the disk, sorted
  std::vector<int> disks_near(const Harmonic_disk& disk) const
  {
    std::vector<int> others;
    for(const int f : disk.faces())
      others.insert(others.end(), m_disks_at[f].begin(), m_disks_at[f].end());
    make_unique(others);
    return others;
  }

  static void make_unique(std::vector<int>& list)
  {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  // the quads with a vertex in a face of the disks of a change, sorted
  std::vector<int> quads_near(const Change& change) const
  {
    std::vector<int> quads;
    const auto add = [&](const Harmonic_disk& disk)
    {
      for(const int f : disk.faces())
        quads.insert(quads.end(), m_quads_at[f].begin(), m_quads_at[f].end());
    };
    add(*change.disk.motion);
    for(const int i : change.replaced)
      add(*m_disks[i].motion);
    make_unique(quads);
    return quads;
  }

  void apply(const Change& change)
  {
    for(const int i : change.replaced)
      for(const int f : m_disks[i].motion->faces())
        m_disks_at[f].erase(std::find(m_disks_at[f].begin(), m_disks_at[f].end(), i));
    for(const int f : change.disk.motion->faces())
      m_disks_at[f].push_back(static_cast<int>(m_disks.size()));
    m_disks.push_back(change.disk);
  }

  double least_shape(const std::vector<int>& quads, const Change& change) const
  {
    double least = 1;
    for(const int q : quads)
      least = (std::min)(least, shape_of(q, change));
    return least;
  }

  // of a flat quad after a change
  double shape_of(int quad, const Change& change) const
  {
    std::array<Eigen::Vector3d, 4> points;
    for(int i = 0; i < 4; ++i)
      points[i] = point_at(m_map->mesh, moved(m_places[quad][i], change));
    return oriented_scaled_jacobian(
      points, m_map->mesh.normal(moved(m_places[quad][4], change).face));
  }

  // Disks do not meet: at most one moves the point.
  Working_location moved(const Working_location& at, const Change& change) const
  {
    if(change.disk.motion && contains(change.disk.motion->faces(), at.face))
    {
      const Working_location result = (*change.disk.motion)(at);
      if(!is_same(result, at))
        return result;
    }
    for(const int disk : m_disks_at[at.face])
    {
      if(contains(change.replaced, disk))
        continue;
      const Working_location result = (*m_disks[disk].motion)(at);
      if(!is_same(result, at))
        return result;
    }
    return at;
  }

  static bool is_same(const Working_location& a, const Working_location& b)
  {
    return a.face == b.face && a.barycentric == b.barycentric;
  }

  std::vector<std::vector<int> > m_disks_at; // per face of the working mesh
  std::vector<Disk> m_disks;
  // during construction only
  const Seamless_map* m_map = nullptr;
  const Quad_grid* m_grid = nullptr;
  std::vector<std::array<Working_location, 5> > m_places; // per quad: its corners and its middle
  std::vector<std::vector<int> > m_quads_at;              // per face: quads with a corner there
  Work_budget m_budget;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_DISK_SMOOTHING_H
