// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_MERGER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_MERGER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_rectangle.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Rectangle_grower.h>

#include <CGAL/Random.h>
#include <CGAL/algorithm.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Partition of a cell complex into rectangles of cells that join with C2 continuity, such that the
/// file of the faces is small. Rectangles grow from one cell after the other; then each is taken
/// apart together with those beside it, and their cells are put together in other ways, of which the
/// smallest is kept.
class Cell_merger
{
  typedef Rectangle_grower::Growth Growth;

public:
  /// two pieces are C2 if their blossoms agree to `tolerance`
  Cell_merger(const Cell_complex& complex, double tolerance)
    : m_complex(complex), m_grower(complex, tolerance)
  {}

  /// returns the rectangles; without `do_merge`, each cell is one, but beside creases
  std::vector<Cell_rectangle> operator()(bool do_merge)
  {
    std::vector<std::size_t> cells(m_complex.cells().size());
    std::iota(cells.begin(), cells.end(), std::size_t(0));
    large_first(cells);
    if(!do_merge)
      return single_cells(cells);
    const std::vector<Cell_rectangle> by_saving = partition(cells, Growth::BY_SAVING);
    const double least = cost(by_saving, 0);
    std::vector<Cell_rectangle> faces = partition(cells, Growth::IN_TURN);
    if(least < cost(faces, 0))
    {
      faces = by_saving;
      assign(faces, 0);
    }
    improve(faces);
    return faces;
  }

private:
  // What a face costs beside its control points, an edge beside those inside it, in records of a
  // file of the size of a point with a reference to it (93 bytes on average): the entities of the
  // face; those of the edge, its two uses, and its share of the vertices.
  static constexpr double POINTS_PER_FACE = 3;
  static constexpr double POINTS_PER_EDGE = 4.5;

  // Kernels and mesh generators have difficulties with slivers: each width by which a face is longer
  // than so many counts as so many points. In two of the test cases this halves the longest faces,
  // and their files do not become larger.
  static constexpr double LONG_FACE = 16;
  static constexpr double POINTS_PER_WIDTH = 4;

  // more gain little: of d5, four ways save 4 percent of the file, eight 5.5, and twenty 5.7
  static constexpr int NUMBER_OF_WAYS = 8;
  static constexpr int MAXIMUM_NUMBER_OF_PASSES = 4;

  Cell_rectangle single_cell(std::size_t cell) const
  {
    return {{{cell, Tick_frame()}}, m_complex.cells()[cell].rectangle};
  }

  std::vector<Cell_rectangle> single_cells(const std::vector<std::size_t>& cells)
  {
    std::vector<Cell_rectangle> faces;
    for(std::size_t c : cells)
      if(m_complex.cells()[c].crease == NO_INDEX)
        faces.push_back(single_cell(c));
    append_crease_faces(faces);
    return faces;
  }

  std::vector<Cell_rectangle> partition(const std::vector<std::size_t>& seeds, Growth growth)
  {
    for(std::size_t c = 0; c < m_complex.cells().size(); ++c)
      m_grower.set_face_of_cell(c, NO_INDEX);
    std::vector<Cell_rectangle> faces;
    for(std::size_t seed : seeds)
    {
      if(m_grower.is_mergeable(seed) && m_grower.face_of_cell(seed) == NO_INDEX)
        faces.push_back(m_grower.grown(seed, faces.size(), growth));
      else if(m_complex.cells()[seed].cap != NO_INDEX)
      {
        m_grower.set_face_of_cell(seed, faces.size());
        faces.push_back(single_cell(seed));
      }
    }
    append_crease_faces(faces);
    return faces;
  }

  // so that small cells do not cut large ones up
  void large_first(std::vector<std::size_t>& cells) const
  {
    std::stable_sort(cells.begin(), cells.end(), [this](std::size_t a, std::size_t b)
    {
      return area(m_complex.cells()[a].rectangle) > area(m_complex.cells()[b].rectangle);
    });
  }

  // the cells on one side of a crease make one face
  void append_crease_faces(std::vector<Cell_rectangle>& faces)
  {
    std::map<std::pair<std::size_t, std::size_t>, Cell_rectangle> by_side;
    for(std::size_t c = 0; c < m_complex.cells().size(); ++c)
    {
      const Cell& cell = m_complex.cells()[c];
      if(cell.crease == NO_INDEX)
        continue;
      Cell_rectangle& face = by_side[{cell.crease, cell.sector}];
      const Tick_rectangle r = cell.frame(cell.rectangle);
      if(face.cells.empty())
        face.bounds = r;
      for(int axis = 0; axis < 2; ++axis)
      {
        face.bounds.low[axis] = (std::min)(face.bounds.low[axis], r.low[axis]);
        face.bounds.high[axis] = (std::max)(face.bounds.high[axis], r.high[axis]);
      }
      face.cells.push_back({c, cell.frame});
    }
    for(auto& entry : by_side)
    {
      Cell_rectangle& face = entry.second;
      std::sort(face.cells.begin(), face.cells.end(),
                [this](const Placed_cell& a, const Placed_cell& b)
      { // the cell at the smallest parameters first
        const Tick_point p = placed_rectangle(m_complex, a).low, q = placed_rectangle(m_complex, b).low;
        return p[1] < q[1] || (p[1] == q[1] && p[0] < q[0]);
      });
      for(const Placed_cell& placed : face.cells)
        m_grower.set_face_of_cell(placed.cell, faces.size());
      faces.push_back(face);
    }
  }

  // makes the cells of face i members of face `first + i`
  void assign(const std::vector<Cell_rectangle>& faces, std::size_t first)
  {
    for(std::size_t i = 0; i < faces.size(); ++i)
      for(const Placed_cell& placed : faces[i].cells)
        m_grower.set_face_of_cell(placed.cell, first + i);
  }

  // of the B-spline, whose knots are simple inside
  double number_of_points(const Cell_rectangle& face) const
  {
    return double(breakpoints(m_complex, face, 0).size() + 2)
         * double(breakpoints(m_complex, face, 1).size() + 2);
  }

  // without the edges
  double cost(const Cell_rectangle& face) const
  {
    const double a = double(face.bounds.extent(0)), b = double(face.bounds.extent(1));
    const double widths = (std::max)(a, b) / (std::min)(a, b);
    return POINTS_PER_FACE + number_of_points(face)
         + POINTS_PER_WIDTH * (std::max)(0., widths - LONG_FACE);
  }

  // The cost of faces with the indices from `first` on, and of their edges: those between two of
  // them belong to both by halves.
  double cost(const std::vector<Cell_rectangle>& faces, std::size_t first) const
  {
    double sum = 0;
    for(const Cell_rectangle& face : faces)
    {
      sum += cost(face);
      for(int side = 0; side < 4; ++side)
      {
        bool is_first = true;
        std::size_t last = NO_INDEX;
        for(const Placed_cell& placed : cells_on_side(m_complex, face, side))
          for(const auto& use : m_complex.uses(placed.cell, cell_side(placed, side)))
          {
            const std::size_t other = face_across(use);
            const double share = (other != NO_INDEX && other >= first) ? 0.5 : 1;
            sum += share * ((is_first || other != last) ? POINTS_PER_EDGE + 1 : 1);
            is_first = false;
            last = other;
          }
      }
    }
    return sum;
  }

  std::size_t face_across(const Cell_complex::Segment_use& use) const
  {
    const std::size_t cell = m_complex.across(use).cell;
    return (cell == NO_INDEX) ? NO_INDEX : m_grower.face_of_cell(cell);
  }

  bool is_mergeable(const Cell_rectangle& face) const
  {
    return !face.cells.empty() && m_grower.is_mergeable(face.cells.front().cell);
  }

  void improve(std::vector<Cell_rectangle>& faces)
  {
    CGAL::Random random(0);
    std::vector<char> is_settled(faces.size(), false);
    bool has_changed = true;
    for(int pass = 0; pass < MAXIMUM_NUMBER_OF_PASSES && has_changed; ++pass)
    {
      has_changed = false;
      for(std::size_t f = 0; f < faces.size(); ++f)
        if(!is_settled[f])
        {
          is_settled[f] = true;
          if(is_mergeable(faces[f]))
            has_changed = improve(f, faces, is_settled, random) || has_changed;
        }
    }
    faces.erase(std::remove_if(faces.begin(), faces.end(), [](const Cell_rectangle& face)
                               { return face.cells.empty(); }), faces.end());
  }

  // puts a face and those beside it together anew; returns `true` if that costs less than before
  bool improve(std::size_t f, std::vector<Cell_rectangle>& faces, std::vector<char>& is_settled,
               CGAL::Random& random)
  {
    const std::vector<std::size_t> region = face_and_neighbors(f, faces);
    std::vector<Cell_rectangle> best;
    std::vector<std::size_t> cells;
    for(std::size_t i : region)
    {
      for(const Placed_cell& placed : faces[i].cells)
        cells.push_back(placed.cell);
      best.push_back(std::move(faces[i]));
      faces[i].cells.clear();
    }
    std::sort(cells.begin(), cells.end());
    large_first(cells);
    assign(best, faces.size());
    double least = cost(best, faces.size());
    bool has_improved = false;
    for(int way = 0; way < NUMBER_OF_WAYS && region.size() > 1; ++way)
    {
      if(way == 2)
        std::reverse(cells.begin(), cells.end());
      else if(way > 3)
        CGAL::cpp98::random_shuffle(cells.begin(), cells.end(), random);
      std::vector<Cell_rectangle> next = grown(
        cells, faces.size(), (way & 1) ? Growth::BY_SAVING : Growth::IN_TURN, least);
      const double c = next.empty() ? least : cost(next, faces.size());
      if(!(c < least))
        continue;
      least = c;
      best = std::move(next);
      has_improved = true;
    }
    put(best, region, has_improved, faces, is_settled);
    return has_improved;
  }

  std::vector<std::size_t> face_and_neighbors(std::size_t f,
                                              const std::vector<Cell_rectangle>& faces) const
  {
    std::vector<std::size_t> result;
    for(int side = 0; side < 4; ++side)
      for(const Placed_cell& placed : cells_on_side(m_complex, faces[f], side))
        for(const auto& use : m_complex.uses(placed.cell, cell_side(placed, side)))
        {
          const std::size_t other = face_across(use);
          if(other != NO_INDEX && is_mergeable(faces[other]))
            result.push_back(other);
        }
    result.push_back(f);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  // faces of all given cells with the indices from `first` on; none if they cost more than `limit`
  std::vector<Cell_rectangle> grown(const std::vector<std::size_t>& cells, std::size_t first,
                                    Growth growth, double limit)
  {
    for(std::size_t c : cells)
      m_grower.set_face_of_cell(c, NO_INDEX);
    std::vector<Cell_rectangle> result;
    double sum = 0;
    for(std::size_t c : cells)
    {
      if(m_grower.face_of_cell(c) != NO_INDEX)
        continue;
      result.push_back(m_grower.grown(c, first + result.size(), growth));
      sum += cost(result.back());
      if(sum > limit)
        return std::vector<Cell_rectangle>();
    }
    return result;
  }

  // puts faces in the places of others, or behind all of them
  void put(std::vector<Cell_rectangle>& from, const std::vector<std::size_t>& places,
           bool have_changed, std::vector<Cell_rectangle>& faces, std::vector<char>& is_settled)
  {
    for(std::size_t i = 0; i < from.size(); ++i)
    {
      const std::size_t f = (i < places.size()) ? places[i] : faces.size();
      if(f == faces.size())
      {
        faces.emplace_back();
        is_settled.push_back(false);
      }
      faces[f] = std::move(from[i]);
      for(const Placed_cell& placed : faces[f].cells)
        m_grower.set_face_of_cell(placed.cell, f);
    }
    if(have_changed)
      for(std::size_t i = 0; i < from.size() && i < places.size(); ++i)
        for(std::size_t f : face_and_neighbors(places[i], faces))
          is_settled[f] = false;
  }

  const Cell_complex& m_complex;
  Rectangle_grower m_grower;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_CELL_MERGER_H
