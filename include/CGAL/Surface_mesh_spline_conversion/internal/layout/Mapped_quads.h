// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_MAPPED_QUADS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_MAPPED_QUADS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Integer_grid_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Boundary_positions.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Collapse_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Collapse_sequence.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Disk_smoothing.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Integer_grid_cells.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_collapse.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid_check.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_relaxation.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Rectangle_composition.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Triangle_locator.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Vertex_smoothing.h>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The quads of an integer grid map together with the inverse map.
class Mapped_quads
{
public:
  // Finds the quads; returns an empty string or what is wrong with the map.
  const char* build(const Integer_grid_map& igm)
  {
    m_quads = Quad_grid();
    m_relaxations.clear();
    m_locator = Triangle_locator();
    m_places.clear();
    m_shears.clear();
    m_disk_smoothing = Disk_smoothing();
    m_vertex_smoothing = Vertex_smoothing();
    const Boundary_positions positions(igm.map);
    const char* failure = igm.is_resolved ? build_from_cells(igm, positions)
                                          : build_from_rectangles(igm, positions);
    if(*failure)
      return failure;
    m_locator.make_cells();
    return Quad_grid_check(igm.map, positions, m_quads).run();
  }

  // Finds chords and quads of the layout to be collapsed one after the other, until there are not
  // more than `enough` quads, or nothing is left that can be collapsed.
  std::vector<Collapse_sequence::Move> find_collapses(const Integer_grid_map& igm,
                                                      Collapse_sequence::Parts parts,
                                                      double enough,
                                                      const Work_budget& budget) const
  {
    return Collapse_sequence(m_quads, corners(igm), point(igm), parts).find(enough, budget);
  }

  // Collapses parts of the layout, after the first motions of `smooth()`; `false` if there is no
  // map then. \pre there are no motions yet
  bool collapse(const Integer_grid_map& igm, const std::vector<Collapse_sequence::Move>& moves,
                const Work_budget& budget)
  {
    const double work_per_quad = 700; // including a judgement of the layout
    budget.spend(work_per_quad * m_quads.number_of_quads());
    if(m_relaxations.empty())
      smooth_in_disks(igm, budget);
    const Quad_collapse collapse(m_quads, corners(igm));
    Collapse_pattern pattern(m_quads);
    for(const Collapse_sequence::Move& move : moves)
      for(const Collapse_step& step : move.steps)
        pattern.apply(step);
    std::optional<Collapsed_quads> collapsed = collapse.collapse(pattern);
    if(!collapsed)
      return false;
    const auto map
      = std::make_shared<Collapse_map>(m_quads, collapse, pattern, *collapsed, point(igm));
    if(!map->is_valid())
      return false;
    m_relaxations.push_back(Relaxation{[map](const Quad_grid::Place& p) { return (*map)(p); },
                                       std::make_shared<const Quad_grid>(std::move(m_quads))});
    m_quads = std::move(collapsed->quads);
    relax(igm);
    return true;
  }

  // Collapses parts of the layout in rounds, each of which leaves the same share of the quads,
  // until there are not more than `enough`. After each round, the quads find their shapes, which
  // the choices of the next one depend on. Returns what has collapsed, nothing if there is no map
  // then.
  // \pre there are no motions yet
  std::vector<Collapse_sequence::Move> collapse_in_rounds(const Integer_grid_map& igm, int rounds,
                                                          double enough,
                                                          const Work_budget& budget)
  {
    std::vector<Collapse_sequence::Move> all;
    const double number = m_quads.number_of_quads();
    for(int i = 1; i <= rounds; ++i)
    {
      const double target
        = i == rounds ? enough : number * std::pow(enough / number, i / double(rounds));
      const std::vector<Collapse_sequence::Move> moves
        = find_collapses(igm, Collapse_sequence::Parts::CHORDS_AND_QUADS, target, budget);
      if(moves.empty())
        continue;
      if(!collapse(igm, moves, budget))
        return {};
      all.insert(all.end(), moves.begin(), moves.end());
    }
    return all;
  }

  // Moves the corners of badly shaped quads and their neighbours, where this makes them better.
  // `image`: where the layout has a point of the working mesh
  void smooth(const Integer_grid_map& igm, const Vertex_smoothing::Image& image,
              Vertex_smoothing::Priority priority, const Work_budget& budget)
  {
    const double share_of_disks = 0.5;
    if(m_relaxations.empty())
      smooth_in_disks(igm, budget.share(share_of_disks));
    m_vertex_smoothing
      = Vertex_smoothing(igm.map, m_quads, image, [this](int quad, double u, double v)
        { return m_disk_smoothing(locate(quad, u, v)); }, priority, budget);
  }

  const Quad_grid& quads() const { return m_quads; }

  // the point of the working mesh at the local coordinates (u,v) of a quad; neighbours agree
  // exactly
  Working_location operator()(std::size_t quad, double u, double v) const
  {
    return m_vertex_smoothing(m_disk_smoothing(locate(quad, u, v)));
  }

private:
  // a map from places in the quads to those in quads before
  struct Relaxation
  {
    std::function<Quad_grid::Place(const Quad_grid::Place&)> place;
    std::shared_ptr<const Quad_grid> quads; // before
  };

  void smooth_in_disks(const Integer_grid_map& igm, const Work_budget& budget)
  {
    m_disk_smoothing = Disk_smoothing(igm.map, m_quads, [this](int quad, double u, double v)
      { return locate(quad, u, v); }, budget);
  }

  // After a collapse, the quads find their shapes, first inside their sides, and then inside the
  // lines between their middles.
  void relax(const Integer_grid_map& igm)
  {
    const auto inside = std::make_shared<Quad_relaxation>(m_quads, point(igm));
    if(!inside->is_valid())
      return;
    const auto quads = std::make_shared<const Quad_grid>(m_quads);
    m_relaxations.push_back(Relaxation{[inside](const Quad_grid::Place& p)
                                       { return (*inside)(p); }, quads});
    const Quad_collapse collapse(m_quads, corners(igm));
    const Collapse_pattern none(m_quads);
    const std::optional<Collapsed_quads> all = collapse.collapse(none);
    const auto around
      = std::make_shared<Collapse_map>(m_quads, collapse, none, *all, point(igm));
    if(around->is_valid())
      m_relaxations.push_back(Relaxation{[around](const Quad_grid::Place& p)
                                         { return (*around)(p); }, quads});
  }

  std::vector<char> corners(const Integer_grid_map& igm) const
  {
    std::vector<char> is_corner(m_quads.number_of_vertices(), 0);
    for(int v = 0; v < m_quads.number_of_vertices(); ++v)
      is_corner[v] = m_quads.mesh_vertex[v] >= 0 && igm.map.mesh.is_corner[m_quads.mesh_vertex[v]];
    return is_corner;
  }

  // the point of the surface at a place, before all motions
  std::function<Eigen::Vector3d(const Quad_grid::Place&)> point(const Integer_grid_map& igm) const
  {
    return [this, &igm](const Quad_grid::Place& p)
    { return point_at(igm.map.mesh, m_disk_smoothing(locate(p.quad, p.u, p.v))); };
  }

  Working_location locate(std::size_t quad, double u, double v) const
  {
    Quad_grid::Place p
      = m_quads.representative(Quad_grid::Place{static_cast<int>(quad), u, v});
    for(std::size_t i = m_relaxations.size(); i-- > 0;)
      p = m_relaxations[i].quads->representative(m_relaxations[i].place(p));
    if(m_places.empty())
      return m_locator(p.quad, p.u, p.v);
    const Rectangle_composition::Quad_place& place = m_places[p.quad];
    const Rectangle_shears& shears = m_shears[place.rectangle];
    const double t = place.j + p.v;
    const double x = shears.x(place.i + p.u, t);
    return m_locator(p.quad, x, shears.y(x, t));
  }

  const char* build_from_cells(const Integer_grid_map& igm, const Boundary_positions& positions)
  {
    return Integer_grid_cells(igm.map, positions, m_quads, m_locator).build();
  }

  const char* build_from_rectangles(const Integer_grid_map& igm,
                                    const Boundary_positions& positions)
  {
    Rectangle_composition composition(igm.map, igm.graph, igm.lengths, positions, m_quads,
                                      m_locator);
    const char* failure = composition.build();
    m_places = composition.places();
    m_shears = composition.shears();
    return failure;
  }

  Quad_grid m_quads;
  std::vector<Relaxation> m_relaxations;                   // the first of them is a collapse
  Triangle_locator m_locator;
  std::vector<Rectangle_composition::Quad_place> m_places; // per quad, empty for integer grid maps
  std::vector<Rectangle_shears> m_shears;                  // per rectangle
  Disk_smoothing m_disk_smoothing;
  Vertex_smoothing m_vertex_smoothing;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_MAPPED_QUADS_H
