// A closed Catmull-Clark surface over a quad mesh, by uniform subdivision of the whole mesh: an
// independent source of cells for the export, and of limit points.
#ifndef CATMULL_CLARK_CELLS_H
#define CATMULL_CLARK_CELLS_H

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>

#include <Eigen/Core>

#include <array>
#include <cassert>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace SMSC_internal = CGAL::Surface_mesh_spline_conversion::internal;

struct Catmull_clark_surface
{
  typedef Eigen::Vector3d Point;
  typedef std::array<int, 4> Quad;

  struct Level
  {
    std::vector<Point> points;
    std::vector<Quad> quads;                     // corner 0 towards the origin of the base quad
    std::vector<std::array<int, 3> > where;      // (base quad, i, j) of each quad
    std::map<std::pair<int, int>, int> quad_of;  // by directed edge

    void index()
    {
      for(int f = 0; f < int(quads.size()); ++f)
        for(int i = 0; i < 4; ++i)
          quad_of[{quads[f][i], quads[f][(i + 1) % 4]}] = f;
    }

    int corner(int f, int v) const
    {
      for(int i = 0; i < 4; ++i)
        if(quads[f][i] == v)
          return i;
      assert(false);
      return -1;
    }

    // the quads round vertex i of quad f, clockwise
    std::vector<int> round(int f, int i) const
    {
      const int v = quads[f][i];
      std::vector<int> result;
      int g = f;
      do
      {
        result.push_back(g);
        const int w = quads[g][(corner(g, v) + 1) % 4];
        g = quad_of.at({w, v});
      }
      while(g != f);
      return result;
    }

    Point limit(int f, int i) const
    {
      const std::vector<int> ring = round(f, i);
      const int v = quads[f][i];
      const double n = double(ring.size());
      Point sum = n * n * points[v];
      for(int g : ring)
        sum += 4 * points[quads[g][(corner(g, v) + 1) % 4]] + points[quads[g][(corner(g, v) + 2) % 4]];
      return sum / (n * (n + 5));
    }
  };

  std::vector<Level> levels;

  Catmull_clark_surface(std::vector<Point> points, std::vector<Quad> quads, int depth)
  {
    Level base;
    base.points = std::move(points);
    base.quads = std::move(quads);
    for(int f = 0; f < int(base.quads.size()); ++f)
      base.where.push_back({f, 0, 0});
    base.index();
    levels.push_back(base);
    for(int l = 0; l < depth; ++l)
      levels.push_back(subdivided(levels.back()));
  }

  static Level subdivided(const Level& coarse)
  {
    Level fine;
    const int nv = int(coarse.points.size()), nf = int(coarse.quads.size());
    fine.points.resize(nv);
    std::vector<int> face_point(nf);
    for(int f = 0; f < nf; ++f)
    {
      Point sum = Point::Zero();
      for(int v : coarse.quads[f])
        sum += coarse.points[v] / 4;
      face_point[f] = int(fine.points.size());
      fine.points.push_back(sum);
    }
    std::map<std::pair<int, int>, int> edge_point;
    for(const auto& e : coarse.quad_of)
    {
      const int a = e.first.first, b = e.first.second;
      if(a > b)
        continue;
      const int g = coarse.quad_of.at({b, a});
      edge_point[{a, b}] = edge_point[{b, a}] = int(fine.points.size());
      fine.points.push_back((coarse.points[a] + coarse.points[b] + fine.points[face_point[e.second]]
                             + fine.points[face_point[g]]) / 4);
    }
    std::vector<char> is_done(nv, false);
    for(int f = 0; f < nf; ++f)
      for(int i = 0; i < 4; ++i)
      {
        const int v = coarse.quads[f][i];
        if(is_done[v])
          continue;
        is_done[v] = true;
        const std::vector<int> ring = coarse.round(f, i);
        const double n = double(ring.size());
        Point sum = (n - 3) / n * coarse.points[v];
        for(int g : ring)
        {
          const Point& w = coarse.points[coarse.quads[g][(coarse.corner(g, v) + 1) % 4]];
          sum += (fine.points[face_point[g]] + coarse.points[v] + w) / (n * n);
        }
        fine.points[v] = sum;
      }
    for(int f = 0; f < nf; ++f)
    {
      const Quad& q = coarse.quads[f];
      std::array<int, 4> e;
      for(int i = 0; i < 4; ++i)
        e[i] = edge_point[{q[i], q[(i + 1) % 4]}];
      const int c = face_point[f];
      const std::array<int, 3> w = {coarse.where[f][0], 2 * coarse.where[f][1],
                                    2 * coarse.where[f][2]};
      fine.quads.insert(fine.quads.end(), {{q[0], e[0], c, e[3]}, {e[0], q[1], e[1], c},
                                           {c, e[1], q[2], e[2]}, {e[3], c, e[2], q[3]}});
      fine.where.insert(fine.where.end(), {{w[0], w[1], w[2]}, {w[0], w[1] + 1, w[2]},
                                           {w[0], w[1] + 1, w[2] + 1}, {w[0], w[1], w[2] + 1}});
    }
    fine.index();
    return fine;
  }

  // the Bezier points of quad f, if its vertices are regular
  static bool bezier(const Level& level, int f, SMSC_internal::Bicubic& result)
  {
    const Quad& q = level.quads[f];
    std::array<std::array<Point, 4>, 4> grid; // [row][column]
    static const int at[4][2] = {{1, 1}, {2, 1}, {2, 2}, {1, 2}};
    static const int out[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}}; // across side i
    for(int i = 0; i < 4; ++i)
    {
      if(level.round(f, i).size() != 4)
        return false;
      grid[at[i][1]][at[i][0]] = level.points[q[i]];
      const int v = q[i], w = q[(i + 1) % 4];
      const int g = level.quad_of.at({w, v}), c = level.corner(g, v);
      const int a = level.quads[g][(c + 1) % 4], b = level.quads[g][(c + 2) % 4];
      const int j = (i + 1) % 4;
      grid[at[i][1] + out[i][1]][at[i][0] + out[i][0]] = level.points[a];
      grid[at[j][1] + out[i][1]][at[j][0] + out[i][0]] = level.points[b];
      const int d = level.quad_of.at({a, v}), k = (i + 3) % 4;
      grid[at[i][1] + out[i][1] + out[k][1]][at[i][0] + out[i][0] + out[k][0]]
        = level.points[level.quads[d][(level.corner(d, a) + 3) % 4]];
    }
    static const double m[4][4] = {{1, 4, 1, 0}, {0, 4, 2, 0}, {0, 2, 4, 0}, {0, 1, 4, 1}};
    for(int j = 0; j < 4; ++j)
      for(int i = 0; i < 4; ++i)
      {
        Point sum = Point::Zero();
        for(int b = 0; b < 4; ++b)
          for(int a = 0; a < 4; ++a)
            sum += m[j][b] * m[i][a] / 36 * grid[b][a];
        result[4 * j + i] = sum;
      }
    return true;
  }

  SMSC_internal::Quad_neighbors neighbors() const
  {
    SMSC_internal::Quad_neighbors result(levels[0].quads.size());
    for(int f = 0; f < int(levels[0].quads.size()); ++f)
      for(int i = 0; i < 4; ++i)
      {
        const int v = levels[0].quads[f][i], w = levels[0].quads[f][(i + 1) % 4];
        const int g = levels[0].quad_of.at({w, v});
        result[f][i] = {std::size_t(g), levels[0].corner(g, w)};
      }
    return result;
  }

  // base quads without extraordinary point are one cell; the others are cut towards it, level by
  // level, and end with a cell whose points are of no use
  std::vector<SMSC_internal::Cell> cells(int depth) const
  {
    std::vector<SMSC_internal::Cell> result;
    std::set<std::array<int, 4> > done; // (base quad, i, j) at a level, and the level
    for(int l = 0; l <= depth; ++l)
      for(int f = 0; f < int(levels[l].quads.size()); ++f)
      {
        const std::array<int, 3> w = levels[l].where[f];
        bool is_covered = false;
        for(int k = 1; k <= l; ++k)
          is_covered = is_covered || done.count({w[0], w[1] >> k, w[2] >> k, l - k});
        SMSC_internal::Bicubic points;
        points.fill(Point::Zero());
        if(is_covered || (!bezier(levels[l], f, points) && l < depth))
          continue;
        SMSC_internal::Cell cell;
        cell.points = std::make_shared<const SMSC_internal::Bicubic>(points);
        done.insert({w[0], w[1], w[2], l});
        const std::int64_t size = SMSC_internal::QUAD_TICKS >> l;
        cell.quad = cell.patch = w[0];
        cell.rectangle = {{{w[1] * size, w[2] * size}}, {{(w[1] + 1) * size, (w[2] + 1) * size}}};
        result.push_back(cell);
      }
    return result;
  }

  // limit points on the dyadic grid of the finest level
  std::map<std::array<int, 3>, Point> limit_points() const
  {
    std::map<std::array<int, 3>, Point> result;
    const Level& finest = levels.back();
    for(int f = 0; f < int(finest.quads.size()); ++f)
      for(int i = 0; i < 4; ++i)
      {
        const auto& w = finest.where[f];
        result[{w[0], w[1] + (i == 1 || i == 2), w[2] + (i >= 2)}] = finest.limit(f, i);
      }
    return result;
  }
};

#endif // CATMULL_CLARK_CELLS_H
