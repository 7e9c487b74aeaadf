// Checks of a quad layout that use nothing but its public interface and the mesh.
#ifndef TEST_QUAD_LAYOUT_CHECKS_H
#define TEST_QUAD_LAYOUT_CHECKS_H

#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>

#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace Test {

// local coordinates of the point `t` of side `i`
inline std::array<double, 2> on_side(int i, double t)
{
  switch(i)
  {
    case 0: return {{t, 0}};
    case 1: return {{1, t}};
    case 2: return {{1 - t, 1}};
    default: return {{0, 1 - t}};
  }
}

template <typename Layout, typename TriangleMesh>
class Quad_layout_checks
{
  typedef typename Layout::Point_3 Point_3;
  typedef typename Layout::Location Location;
  typedef typename Layout::Side Side;

public:
  Quad_layout_checks(const Layout& layout, const TriangleMesh& tm, double diameter)
    : m_layout(layout), m_tm(tm), m_diameter(diameter)
  {
    for(auto f : faces(tm))
    {
      std::array<Point_3, 3> corners;
      int i = 0;
      for(auto v : vertices_around_face(halfedge(f, tm), tm))
        corners[i++] = get(CGAL::vertex_point, tm, v);
      m_faces.push_back(corners);
    }
  }

  void check_combinatorics(int euler_characteristic, int number_of_loops) const
  {
    int border_sides = 0;
    std::map<std::size_t, std::size_t> next; // along the boundary
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        if(m_layout.is_border(q, i))
        {
          ++border_sides;
          const bool is_new
            = next.emplace(m_layout.vertex(q, i), m_layout.vertex(q, i + 1)).second;
          assert(is_new);
          (void)is_new;
          continue;
        }
        const Side other = m_layout.neighbor(q, i);
        assert(m_layout.neighbor(other.first, other.second) == Side(q, i));
        assert(m_layout.vertex(q, i) == m_layout.vertex(other.first, other.second + 1));
      }
    const int n = static_cast<int>(m_layout.number_of_quads());
    assert(2 * static_cast<int>(m_layout.number_of_vertices()) - (4 * n + border_sides) + 2 * n
           == 2 * euler_characteristic);
    int loops = 0;
    while(!next.empty())
    {
      ++loops;
      std::size_t v = next.begin()->first;
      int sides = 0;
      for(auto it = next.find(v); it != next.end(); it = next.find(v))
      {
        v = it->second;
        next.erase(it);
        ++sides;
      }
      assert(sides >= 4);
    }
    assert(loops == number_of_loops);
  }

  // the numbers of quads at the irregular vertices
  std::multiset<int> irregular_valences() const
  {
    std::vector<int> valence(m_layout.number_of_vertices(), 0);
    std::vector<char> is_border(m_layout.number_of_vertices(), 0);
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        ++valence[m_layout.vertex(q, i)];
        if(m_layout.is_border(q, i))
          is_border[m_layout.vertex(q, i)] = is_border[m_layout.vertex(q, i + 1)] = 1;
      }
    std::multiset<int> irregular;
    for(std::size_t v = 0; v < valence.size(); ++v)
      if(valence[v] != (is_border[v] ? 2 : 4))
        irregular.insert(is_border[v] ? -valence[v] : valence[v]);
    return irregular;
  }

  // The sides of each chain follow each other and cover `[0, length]`, or one period.
  void check_boundary(const std::vector<double>& chain_lengths,
                      const std::vector<bool>& is_closed) const
  {
    assert(m_layout.number_of_chains() == chain_lengths.size());
    for(std::size_t c = 0; c < chain_lengths.size(); ++c)
    {
      const std::vector<Side> sides = m_layout.chain_sides(c);
      const double tolerance = 1e-10 * chain_lengths[c];
      assert(!sides.empty());
      double end = is_closed[c]
        ? m_layout.boundary_side(sides.back().first, sides.back().second).last - chain_lengths[c]
        : 0;
      for(std::size_t i = 0; i < sides.size(); ++i)
      {
        const auto& piece = m_layout.boundary_side(sides[i].first, sides[i].second);
        assert(std::abs(piece.first - end) < tolerance && piece.first < piece.last);
        assert(!is_closed[c] || (piece.first >= 0 && piece.first < chain_lengths[c]));
        end = piece.last;
        if(i + 1 < sides.size())
          assert(m_layout.vertex(sides[i].first, sides[i].second + 1)
                 == m_layout.vertex(sides[i + 1].first, sides[i + 1].second));
      }
      assert(is_closed[c] || std::abs(end - chain_lengths[c]) < tolerance);
    }
  }

  // Locations are points of their faces, and the vertices are where the inverse map sends them.
  void check_points(int n) const
  {
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
      for(int j = 0; j <= n; ++j)
        for(int i = 0; i <= n; ++i)
        {
          const Location at = m_layout.inverse_map()(q, double(i) / n, double(j) / n);
          assert(at.face < m_faces.size());
          const std::array<Point_3, 3>& corners = m_faces[at.face];
          double p[3] = {0, 0, 0}, sum = 0;
          for(int k = 0; k < 3; ++k)
          {
            const double b = CGAL::to_double(at.barycentric[k]);
            assert(b > -1e-9);
            sum += b;
            for(int d = 0; d < 3; ++d)
              p[d] += b * CGAL::to_double(corners[k][d]);
          }
          assert(std::abs(sum - 1) < 1e-9);
          assert(distance(Point_3(p[0], p[1], p[2]), at.point) < 1e-11 * m_diameter);
        }
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        const std::array<double, 2> uv = on_side(i, 0);
        assert(distance(m_layout.inverse_map()(q, uv[0], uv[1]).point,
                        m_layout.point(m_layout.vertex(q, i))) < 1e-12 * m_diameter);
      }
  }

  // The inverse map agrees on both sides of a common side.
  void check_continuity(int n) const
  {
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        const Side other = m_layout.neighbor(q, i);
        for(int k = 0; k <= n && !m_layout.is_border(q, i); ++k)
        {
          const std::array<double, 2> here = on_side(i, double(k) / n);
          const std::array<double, 2> there = on_side(other.second, 1 - double(k) / n);
          assert(distance(m_layout.inverse_map()(q, here[0], here[1]).point,
                          m_layout.inverse_map()(other.first, there[0], there[1]).point)
                 < 1e-12 * m_diameter);
        }
      }
  }

  // Without any rounding: all quads at a vertex see the same point of the same face there, and so
  // do both quads at a side, where they divide it in halves, quarters and eighths.
  void check_agreement() const
  {
    std::map<std::size_t, Location> at_vertex;
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        const Location here = image(q, i, 0);
        const Location first = at_vertex.emplace(m_layout.vertex(q, i), here).first->second;
        assert(is_same(here, first));
        const Side other = m_layout.neighbor(q, i);
        for(int k = 1; k < 8 && !m_layout.is_border(q, i); ++k)
          assert(is_same(image(q, i, k / 8.), image(other.first, other.second, 1 - k / 8.)));
      }
  }

  // Small steps in u and v turn counter clockwise in the face that contains them all. Returns the
  // share of the samples whose three points lie in one face.
  double check_orientation(int n) const
  {
    const double step = 1e-6;
    std::size_t used = 0, all = 0;
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
      for(int j = 0; j < n; ++j)
        for(int i = 0; i < n; ++i)
        {
          const double u = (i + 0.4) / n, v = (j + 0.6) / n;
          const Location a = m_layout.inverse_map()(q, u, v);
          const Location b = m_layout.inverse_map()(q, u + step, v);
          const Location c = m_layout.inverse_map()(q, u, v + step);
          ++all;
          if(a.face != b.face || a.face != c.face)
            continue;
          ++used;
          const std::array<Point_3, 3>& f = m_faces[a.face];
          const auto normal = CGAL::cross_product(f[1] - f[0], f[2] - f[0]);
          assert(CGAL::cross_product(b.point - a.point, c.point - a.point) * normal > 0);
        }
    return double(used) / all;
  }

  // Area of the layout by flat cells of a grid, relative to that of the mesh. Where the mesh is
  // flat a homeomorphism reaches 1; a map that covers a place twice exceeds it.
  double relative_area(int n) const
  {
    double layout_area = 0, mesh_area = 0;
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
    {
      std::vector<Point_3> p;
      for(int j = 0; j <= n; ++j)
        for(int i = 0; i <= n; ++i)
          p.push_back(m_layout.inverse_map()(q, double(i) / n, double(j) / n).point);
      for(int j = 0; j < n; ++j)
        for(int i = 0; i < n; ++i)
        {
          const int k = j * (n + 1) + i;
          layout_area += area(p[k], p[k + 1], p[k + n + 2])
                         + area(p[k], p[k + n + 2], p[k + n + 1]);
        }
    }
    for(const auto& f : m_faces)
      mesh_area += area(f[0], f[1], f[2]);
    return layout_area / mesh_area;
  }

private:
  // of a point of a side
  Location image(std::size_t quad, int i, double t) const
  {
    const std::array<double, 2> uv = on_side(i, t);
    return m_layout.inverse_map()(quad, uv[0], uv[1]);
  }

  static bool is_same(const Location& a, const Location& b)
  {
    return a.face == b.face && a.barycentric == b.barycentric && a.point == b.point;
  }

  static double distance(const Point_3& p, const Point_3& q)
  {
    return std::sqrt(CGAL::to_double(CGAL::squared_distance(p, q)));
  }

  static double area(const Point_3& p, const Point_3& q, const Point_3& r)
  {
    return std::sqrt(CGAL::to_double(CGAL::cross_product(q - p, r - p).squared_length())) / 2;
  }

  const Layout& m_layout;
  const TriangleMesh& m_tm;
  double m_diameter;
  std::vector<std::array<Point_3, 3> > m_faces;
};

} // namespace Test

#endif // TEST_QUAD_LAYOUT_CHECKS_H
