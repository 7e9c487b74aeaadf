// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_COLLAPSE_MAP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_COLLAPSE_MAP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/field/Face_geometry.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Place_cell.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_collapse.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A homeomorphism from the quads that are left by a collapse to those before. Lines between the
// middles of neighbours that are left cross the quads that are not, and divide the surface into a
// cell around each vertex: a disk. Each cell is laid flat by a harmonic map to a convex polygon, in
// which the quarters of the new quads are the parts between the center, the middles of two sides,
// and the corner between these.
class Collapse_map
{
public:
  typedef Quad_grid::Place Place;
  typedef Quad_grid::Side Side;
  typedef Place_cell::Locate Locate;

  Collapse_map() {}

  // `collapsed`: `before` after the collapses of `pattern`. `locate`: the point of the surface
  Collapse_map(const Quad_grid& before, const Quad_collapse& collapse,
               const Collapse_pattern& pattern, const Collapsed_quads& collapsed,
               const Locate& locate)
    : m_before(&before), m_collapse(&collapse), m_pattern(&pattern), m_collapsed(&collapsed),
      m_locate(&locate), m_kites(collapsed.original.size())
  {
    lay_lines();
    lay_boundary();
    collect_parts();
    for(int v = 0; v < collapsed.quads.number_of_vertices() && m_is_valid; ++v)
      m_is_valid = add_cell(v);
    forget_construction();
  }

  // Have all cells been laid flat without inverted faces?
  bool is_valid() const { return m_is_valid; }

  // the place before the collapse
  Place operator()(const Place& place) const
  {
    const int side = place.v == 0 ? 0 : place.u == 1 ? 1 : place.v == 1 ? 2 : place.u == 0 ? 3 : -1;
    for(int i = (std::max)(side, 0); side >= 0 && i < 4; ++i)
      if(const auto found = m_border.find(Side(place.quad, i));
         found != m_border.end() && is_on_side(place, i))
        return found->second(along_side(place, i));
    const int corner = place.v < 0.5 ? (place.u < 0.5 ? 0 : 1) : (place.u < 0.5 ? 3 : 2);
    const Kite& kite = m_kites[place.quad][corner];
    const double s = 2 * along_side(place, corner), t = 2 * (1 - along_side(place, corner + 3));
    const Eigen::Vector2d p
      = s * (1 - t) * kite.first + s * t * kite.far + (1 - s) * t * kite.last;
    return m_cells[kite.cell](p);
  }

private:
  static constexpr int half = Place_cell::half;

  // a quarter of a new quad in the cell around its corner
  struct Kite
  {
    int cell;
    Eigen::Vector2d first, far, last; // the middles of its sides, and the middle of the quad
  };

  // A side at the boundary: shares of it, where sides of quads before begin and end.
  struct Border_side
  {
    std::vector<double> shares;   // one more than pieces
    std::vector<Side> sides;      // per piece
    std::vector<std::pair<double, double> > ends; // per piece: along its side

    Place operator()(double share) const
    {
      const std::size_t i = std::upper_bound(shares.begin() + 1, shares.end() - 1, share)
                            - shares.begin() - 1;
      const double t = (share - shares[i]) / (shares[i + 1] - shares[i]);
      return place_on_side(sides[i].first, sides[i].second,
                           (1 - t) * ends[i].first + t * ends[i].second);
    }
  };

  // Sets the shares of the grid vertices on the lines between the middles of new neighbours, by
  // length: 0 in the middle of the quad with the side, 1 in that of the neighbour or at the
  // boundary.
  void lay_lines()
  {
    const Quad_grid& quads = m_collapsed->quads;
    for(int k = 0; k < quads.number_of_quads(); ++k)
      for(int i = 0; i < 4; ++i)
      {
        std::vector<Place> line;
        Side side(m_collapsed->original[k], i);
        for(int j = 0; j <= half; ++j)
          line.push_back(place_near_side(side.first, side.second, 0.5, 0.5 - j / (2. * half)));
        const Side next = m_pattern->beyond(side, [&](const Side& from, const Side& to)
        {
          cross(from, to, line);
          side = to;
        });
        if(next.first == Quad_grid::border)
          m_middle[Side(k, i)] = side;
        else
          for(int j = 1; j <= half; ++j)
            line.push_back(place_near_side(next.first, next.second, 0.5, j / (2. * half)));
        set_shares(line, m_lines[Side(k, i)]);
      }
  }

  // Appends the line between the middles of two sides of a quad.
  static void cross(const Side& from, const Side& to, std::vector<Place>& line)
  {
    const Place first = place_on_side(from.first, from.second, 0.5);
    const Place last = place_on_side(to.first, to.second, 0.5);
    const int steps = ((from.second - to.second) & 1) == 0 ? 2 * half : half;
    for(int j = 1; j <= steps; ++j)
    {
      const double t = j / double(steps);
      line.push_back(Place{from.first, (1 - t) * first.u + t * last.u,
                           (1 - t) * first.v + t * last.v});
    }
  }

  void set_shares(const std::vector<Place>& line,
                  std::vector<std::pair<Place, double> >& shares) const
  {
    std::vector<double> length(1, 0);
    for(std::size_t j = 1; j < line.size(); ++j)
      length.push_back(length.back() + ((*m_locate)(line[j]) - (*m_locate)(line[j - 1])).norm());
    for(std::size_t j = 0; j < line.size(); ++j)
      shares.emplace_back(line[j], length[j] / length.back());
  }

  // The middle of a side lies in that of the side before to which a line of the middle leads.
  void lay_boundary()
  {
    for(const auto& entry : m_middle)
    {
      const Side& side = entry.first;
      const auto& vertices = m_collapsed->quads.vertices[side.first];
      const std::vector<Side> sides
        = m_collapse->sides_between(m_collapsed->anchor[vertices[side.second]],
                                  m_collapsed->anchor[vertices[(side.second + 1) & 3]]);
      std::vector<double> positions(1, 0);
      double middle = 0;
      Border_side result;
      for(const Side& s : sides)
      {
        const Quad_grid::Border& b = m_before->borders[s.first][s.second];
        const double length = b.last - b.first;
        const auto add = [&](double first, double last)
        {
          result.sides.push_back(s);
          result.ends.emplace_back(first, last);
          positions.push_back(positions.back() + (last - first) * length);
        };
        if(s != entry.second)
        {
          add(0, 1);
          continue;
        }
        add(0, 0.5);
        middle = positions.back();
        add(0.5, 1);
      }
      for(const double x : positions)
        result.shares.push_back(x <= middle ? x / middle / 2
                                            : 1 - (positions.back() - x)
                                                    / (positions.back() - middle) / 2);
      m_border.emplace(side, std::move(result));
    }
  }

  // the parts at the corners of the quads before, by the vertices after the collapse
  void collect_parts()
  {
    const Quad_grid& quads = m_collapsed->quads;
    m_parts.resize(quads.number_of_vertices());
    for(int q = 0; q < m_before->number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
        m_parts[m_collapsed->vertex_of[m_before->vertices[q][i]]].push_back(Side(q, i));
  }

  bool add_cell(int v)
  {
    Place_cell cell;
    for(const Side& corner : m_parts[v])
      if(const int diagonal = m_pattern->diagonal(corner.first); diagonal < 0)
        cell.add_quarter(*m_before, corner, *m_locate);
      else
        cell.add_part(*m_before, corner, diagonal, *m_locate);
    lay_polygon(v, cell);
    const bool is_flat = cell.lay_flat();
    m_cells.push_back(std::move(cell));
    return is_flat;
  }

  // Sets the points on the boundary of a cell. Half of the polygon lies at the boundary of the
  // surface there.
  void lay_polygon(int v, Place_cell& cell)
  {
    const Quad_grid& quads = m_collapsed->quads;
    const std::vector<Side> corners = corners_around(v);
    const bool is_border = quads.is_border_vertex[v];
    const double n = static_cast<double>(corners.size());
    const double step = !is_border ? 2 * pi / n : n == 1 ? pi / 2 : pi / n;
    const auto at_angle = [](double angle)
    { return Eigen::Vector2d(std::cos(angle), std::sin(angle)); };
    const auto set = [&](const Place& place, const Eigen::Vector2d& p)
    { cell.fix(*m_before, place, p); };
    const auto far = [&](int k) -> Eigen::Vector2d { return at_angle((k + 0.5) * step); };
    const auto middle = [&](int k) -> Eigen::Vector2d
    { return std::cos(step / 2) * at_angle(k * step); };
    for(int k = 0; k < static_cast<int>(corners.size()); ++k)
    {
      const Side& c = corners[k];
      const Side last(c.first, (c.second + 3) & 3);
      m_kites[c.first][c.second]
        = Kite{static_cast<int>(m_cells.size()), middle(k), far(k), middle(k + 1)};
      const Eigen::Vector2d end = is_border && k == 0 ? middle(0) : far(k - 1);
      for(const auto& entry : m_lines.at(c))
        set(entry.first, far(k) + entry.second * (end - far(k)));
      if(!is_border || k + 1 < static_cast<int>(corners.size()))
        continue;
      for(const auto& entry : m_lines.at(last))
        set(entry.first, far(k) + entry.second * (middle(k + 1) - far(k)));
      lay_border(last, middle(k + 1), [](double share) { return 2 - 2 * share; }, 0.5, 1, set);
    }
    if(is_border)
      lay_border(corners[0], middle(0), [](double share) { return 2 * share; }, 0, 0.5, set);
  }

  // Lays half of a border side on the segment from the origin to a point.
  template <typename Position, typename Set>
  void lay_border(const Side& side, const Eigen::Vector2d& end, const Position& position,
                  double first, double last, const Set& set) const
  {
    const Border_side& border = m_border.at(side);
    for(std::size_t i = 0; i < border.sides.size(); ++i)
    {
      if(border.shares[i] < first || border.shares[i + 1] > last)
        continue;
      const int steps = static_cast<int>(
        std::lround(2 * half * (border.ends[i].second - border.ends[i].first)));
      for(int j = 0; j <= steps; ++j)
      {
        const double t = j / double(steps);
        const double x = (1 - t) * border.ends[i].first + t * border.ends[i].second;
        const double share = (1 - t) * border.shares[i] + t * border.shares[i + 1];
        set(place_on_side(border.sides[i].first, border.sides[i].second, x),
            position(share) * end);
      }
    }
  }

  // the corners of quads at a vertex, counter clockwise, from the boundary on
  std::vector<Side> corners_around(int v) const
  {
    const Quad_grid& quads = m_collapsed->quads;
    Side first = quads.first_corner[v];
    for(int i = 0; i < quads.valence[v]; ++i)
    {
      const Side beyond = quads.neighbors[first.first][first.second];
      if(beyond.first == Quad_grid::border)
        break;
      first = Side(beyond.first, (beyond.second + 1) & 3);
    }
    std::vector<Side> corners;
    for(int i = 0; i < quads.valence[v]; ++i)
    {
      corners.push_back(first);
      first = quads.neighbors[first.first][(first.second + 3) & 3];
    }
    return corners;
  }

  void forget_construction()
  {
    m_before = nullptr;
    m_collapse = nullptr;
    m_pattern = nullptr;
    m_collapsed = nullptr;
    m_locate = nullptr;
    m_lines.clear();
    m_middle.clear();
    m_parts.clear();
  }

  bool m_is_valid = true;
  std::vector<Place_cell> m_cells;              // per new vertex
  std::map<Side, Border_side> m_border;      // by side of the new quads
  // during construction only
  const Quad_grid* m_before = nullptr;
  const Quad_collapse* m_collapse = nullptr;
  const Collapse_pattern* m_pattern = nullptr;
  const Collapsed_quads* m_collapsed = nullptr;
  const Locate* m_locate = nullptr;
  std::map<Side, std::vector<std::pair<Place, double> > > m_lines; // by side of the new quads
  std::map<Side, Side> m_middle;             // by border side: the one before, in whose middle that
                                             // of the new one lies
  std::vector<std::vector<Side> > m_parts; // per new vertex: corners of quads before
  std::vector<std::array<Kite, 4> > m_kites; // per new quad
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_COLLAPSE_MAP_H
