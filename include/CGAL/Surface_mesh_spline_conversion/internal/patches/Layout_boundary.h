// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_LAYOUT_BOUNDARY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_LAYOUT_BOUNDARY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/Boundary_location.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/smooth_correspondence.h>

#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The boundary of a layout: for each chain the correspondence s(x), smooth or linear on each side
// of a quad, and the slide sigma(x), by which it moves points of the boundary against the inverse
// map of the layout.
template <typename GeomTraits>
class Layout_boundary
{
public:
  typedef std::size_t size_type;
  typedef Quad_layout<GeomTraits> Layout;
  typedef typename Layout::Side Side;

  // where the sides of a quad lie on the boundary
  struct Quad_side
  {
    size_type chain = Layout::null; // null: inside
    size_type index = 0;            // position in the chain
    bool is_on_boundary() const { return chain != Layout::null; }
  };
  typedef std::array<Quad_side, 4> Quad_sides;

  template <typename TriangleMesh, typename Network>
  Layout_boundary(const Layout& layout, const TriangleMesh& tm, const Network& network,
                  bool is_smooth)
    : m_is_smooth(is_smooth), m_boundary_quad(layout.number_of_quads(), Layout::null)
  {
    collect_sides(layout, static_cast<size_type>(network.number_of_chains()));
    const Boundary_location<TriangleMesh, Network> location(tm, network);
    for(size_type c = 0; c < m_chains.size(); ++c)
      if(!m_chains[c].sides.empty())
        initialize(layout, c, network.is_closed(c), CGAL::to_double(network.length(c)), location);
  }

  size_type number_of_chains() const { return m_chains.size(); }

  const std::vector<Side>& sides(size_type chain) const { return m_chains[chain].sides; }

  const Boundary_correspondence& correspondence(size_type chain) const
  {
    return m_chains[chain].correspondence;
  }

  // returns the boundary sides of a quad, or a null pointer if it has none
  const Quad_sides* quad_sides(size_type quad) const
  {
    const size_type i = m_boundary_quad[quad];
    return i == Layout::null ? nullptr : &m_quad_sides[i];
  }

  // returns sigma(x): x + sigma(x) is the place of the boundary to which the inverse map assigns
  // the arc length s(x)
  double slide(size_type chain, double x) const
  {
    const Chain& c = m_chains[chain];
    const double period = c.arc_lengths.back() - c.arc_lengths.front();
    double s = c.correspondence(x), turn = 0;
    if(c.correspondence.is_closed())
      turn = std::floor((s - c.arc_lengths.front()) / period);
    s -= turn * period;
    auto it = std::upper_bound(c.arc_lengths.begin() + 1, c.arc_lengths.end() - 1, s);
    const size_type k = static_cast<size_type>(it - c.arc_lengths.begin()) - 1;
    return double(k) + turn * double(c.sides.size()) + position(c.tables[k], s) - x;
  }

private:
  // arc lengths at equidistant parameters of a side, strictly increasing
  static constexpr size_type intervals_per_side = 16;
  typedef std::array<double, intervals_per_side + 1> Table;

  struct Chain
  {
    std::vector<Side> sides;
    std::vector<double> arc_lengths; // at the vertices, one more than sides
    std::vector<Table> tables;
    Boundary_correspondence correspondence;
  };

  void collect_sides(const Layout& layout, size_type number_of_chains)
  {
    m_chains.resize(number_of_chains);
    for(size_type q = 0; q < layout.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
        if(layout.is_border(q, i) && layout.boundary_side(q, i).chain < number_of_chains)
          m_chains[layout.boundary_side(q, i).chain].sides.emplace_back(q, i);
    for(size_type c = 0; c < number_of_chains; ++c)
    {
      std::vector<Side>& sides = m_chains[c].sides;
      std::sort(sides.begin(), sides.end(), [&layout](const Side& a, const Side& b)
      {
        return layout.boundary_side(a.first, a.second).first
               < layout.boundary_side(b.first, b.second).first;
      });
      for(size_type k = 0; k < sides.size(); ++k)
        register_side(sides[k], c, k);
    }
  }

  void register_side(const Side& side, size_type chain, size_type index)
  {
    size_type& i = m_boundary_quad[side.first];
    if(i == Layout::null)
    {
      i = m_quad_sides.size();
      m_quad_sides.emplace_back();
    }
    m_quad_sides[i][static_cast<size_type>(side.second)].chain = chain;
    m_quad_sides[i][static_cast<size_type>(side.second)].index = index;
  }

  template <typename Location>
  void initialize(const Layout& layout, size_type chain, bool is_closed, double length,
                  const Location& location)
  {
    Chain& c = m_chains[chain];
    std::vector<bool> is_fixed;
    for(size_type k = 0; k < c.sides.size(); ++k)
    {
      const auto& side = layout.boundary_side(c.sides[k].first, c.sides[k].second);
      c.arc_lengths.push_back(CGAL::to_double(side.first));
      is_fixed.push_back(!is_regular(layout, c.sides, k));
    }
    const double begin = is_closed ? c.arc_lengths.front() : 0;
    c.arc_lengths.front() = begin;
    c.arc_lengths.push_back(begin + length);
    make_increasing(c.arc_lengths);
    is_fixed.push_back(false);
    c.correspondence = m_is_smooth
      ? Correspondence_smoother(c.arc_lengths, is_fixed, is_closed)()
      : Boundary_correspondence(c.arc_lengths, is_closed);
    for(size_type k = 0; k < c.sides.size(); ++k)
      c.tables.push_back(make_table(layout, chain, k, length, location));
  }

  // a layout with a side without length is not valid, but must not lead to undefined numbers
  static void make_increasing(std::vector<double>& arc_lengths)
  {
    constexpr double smallest_share = 1e-6; // of the mean length of a side
    const size_type n = arc_lengths.size() - 1;
    const double gap = smallest_share * (arc_lengths.back() - arc_lengths.front()) / double(n);
    for(size_type k = 1; k < n; ++k)
      arc_lengths[k] = (std::max)(arc_lengths[k], arc_lengths[k - 1] + gap);
    for(size_type k = n; k > 1; --k)
      arc_lengths[k - 1] = (std::min)(arc_lengths[k - 1], arc_lengths[k] - gap);
  }

  // A vertex slides only if two quads meet there, so that the next quad along the boundary is the
  // neighbour of the one before.
  static bool is_regular(const Layout& layout, const std::vector<Side>& sides, size_type k)
  {
    const Side& before = sides[(k + sides.size() - 1) % sides.size()];
    const Side& after = sides[k];
    return layout.neighbor(before.first, before.second + 1)
           == Side(after.first, (after.second + 3) & 3);
  }

  // the arc lengths that the inverse map assigns to a side; in proportion to the parameter where
  // this is not known
  template <typename Location>
  Table make_table(const Layout& layout, size_type chain, size_type k, double length,
                   const Location& location) const
  {
    typedef typename GeomTraits::FT FT;
    const Chain& c = m_chains[chain];
    const Side& side = c.sides[k];
    const double first = c.arc_lengths[k], last = c.arc_lengths[k + 1];
    Table linear, table;
    bool is_known = true;
    for(size_type i = 0; i <= intervals_per_side; ++i)
    {
      const double t = double(i) / intervals_per_side;
      table[i] = linear[i] = first + t * (last - first);
      if(i == 0 || i == intervals_per_side || !is_known)
        continue;
      const auto uv = from_side<FT>(side.second, FT(t), FT(0));
      const std::optional<double> s
        = location(chain, layout.inverse_map()(side.first, uv[0], uv[1]));
      is_known = s.has_value();
      // the turn of a closed chain that is nearest
      if(is_known)
        table[i] = *s + length * (c.correspondence.is_closed()
                                  ? std::round((linear[i] - *s) / length) : 0);
    }
    return is_known ? strictly_increasing(table, linear) : linear;
  }

  static Table strictly_increasing(Table table, const Table& linear)
  {
    constexpr double share_of_linear = 0.01; // keeps the inverse function bounded
    for(size_type i = 1; i < intervals_per_side; ++i)
    {
      table[i] = (std::min)((std::max)(table[i], table[i - 1]), table[intervals_per_side]);
      if(!(table[i] == table[i]))
        return linear;
    }
    for(size_type i = 0; i <= intervals_per_side; ++i)
      table[i] += share_of_linear * (linear[i] - table[i]);
    return table;
  }

  static double position(const Table& table, double s)
  {
    auto it = std::upper_bound(table.begin() + 1, table.end() - 1, s);
    const size_type i = static_cast<size_type>(it - table.begin()) - 1;
    return (double(i) + (s - table[i]) / (table[i + 1] - table[i])) / double(intervals_per_side);
  }

  bool m_is_smooth;
  std::vector<Chain> m_chains;
  std::vector<size_type> m_boundary_quad; // position in m_quad_sides
  std::vector<Quad_sides> m_quad_sides;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_LAYOUT_BOUNDARY_H
