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
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Disk_smoothing.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Integer_grid_cells.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid_check.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Rectangle_composition.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Triangle_locator.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Vertex_smoothing.h>

#include <cstddef>
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

  // Moves the corners of badly shaped quads and their neighbours, where this makes them better.
  // `image`: where the layout has a point of the working mesh
  void smooth(const Integer_grid_map& igm, const Vertex_smoothing::Image& image,
              Vertex_smoothing::Priority priority, const Work_budget& budget)
  {
    const double share_of_disks = 0.5;
    m_disk_smoothing = Disk_smoothing(igm.map, m_quads, [this](int quad, double u, double v)
      { return locate(quad, u, v); }, budget.share(share_of_disks));
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
  Working_location locate(std::size_t quad, double u, double v) const
  {
    const Quad_grid::Place p
      = m_quads.representative(Quad_grid::Place{static_cast<int>(quad), u, v});
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
