// Properties of shells, computed from their public data only.
#ifndef SHELL_CHECKS_H
#define SHELL_CHECKS_H

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_type_config.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

template <typename K>
struct Shell_checks
{
  typedef CGAL::Surface_mesh_spline_conversion::NURBS_shell_3<K> Shell;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  long euler_characteristic = 0;
  long number_of_border_edges = 0;
  double largest_gap = 0;    // between edges and the sides of faces
  double largest_angle = 0;  // between normals of adjacent faces, in degrees

  explicit Shell_checks(const Shell& shell)
  {
    std::map<std::size_t, std::vector<Vector_3> > normals;
    std::vector<int> uses(2 * shell.number_of_edges(), 0);
    std::vector<char> is_used(shell.number_of_vertices(), false);
    for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
      check_face(shell, f, normals, uses);
    for(std::size_t e = 0; e < shell.number_of_edges(); ++e)
    {
      assert(uses[2 * e] + uses[2 * e + 1] >= 1 && uses[2 * e] <= 1 && uses[2 * e + 1] <= 1);
      number_of_border_edges += (uses[2 * e] + uses[2 * e + 1] == 1);
      is_used[shell.edge(e).source] = is_used[shell.edge(e).target] = true;
      assert(shell.edge(e).source != shell.edge(e).target);
      assert(shell.edge(e).curve.control_points.front() == shell.point(shell.edge(e).source));
      assert(shell.edge(e).curve.control_points.back() == shell.point(shell.edge(e).target));
    }
    for(char used : is_used)
      assert(used);
    euler_characteristic = long(shell.number_of_vertices()) - long(shell.number_of_edges())
                         + long(shell.number_of_faces());
  }

private:
  static double norm(const Vector_3& v) { return std::sqrt(v * v); }

  void check_face(const Shell& shell, std::size_t f,
                  std::map<std::size_t, std::vector<Vector_3> >& normals, std::vector<int>& uses)
  {
    const auto& face = shell.face(f);
    const auto& ku = face.surface.knots[0].knots();
    const auto& kv = face.surface.knots[1].knots();
    int side = 0;
    double at = 0;
    std::size_t first = 0, last = 0;
    for(std::size_t i = 0; i < face.loop.size(); ++i)
    {
      const auto& use = face.loop[i];
      const auto& edge = shell.edge(use.edge);
      ++uses[2 * use.edge + (use.is_forward ? 0 : 1)];
      const std::size_t source = use.is_forward ? edge.source : edge.target;
      if(i == 0)
        first = source;
      else
        assert(source == last); // the loop is connected
      last = use.is_forward ? edge.target : edge.source;

      const double length = edge.curve.last() - edge.curve.first();
      const double total = (side & 1) ? kv.back() - kv.front() : ku.back() - ku.front();
      if(at > total - length / 2)
      {
        assert(std::abs(at - total) < 1e-12); // parameters of edges and sides agree
        ++side;
        at = 0;
      }
      std::vector<Vector_3> along;
      for(int k = 0; k <= 16; ++k)
      {
        const double s = at + length * (use.is_forward ? k : 16 - k) / 16;
        const double u = (side == 0) ? ku.front() + s : (side == 1) ? ku.back()
                       : (side == 2) ? ku.back() - s : ku.front();
        const double v = (side == 0) ? kv.front() : (side == 1) ? kv.front() + s
                       : (side == 2) ? kv.back() : kv.back() - s;
        const auto d = face.surface.derivatives(u, v, 1);
        const Point_3 p = edge.curve.point(edge.curve.first() + length * k / 16);
        largest_gap = (std::max)(largest_gap, norm(p - (CGAL::ORIGIN + d[0][0])));
        const Vector_3 n = CGAL::cross_product(d[1][0], d[0][1]);
        assert(norm(n) > 0);
        along.push_back(n / norm(n));
      }
      compare_normals(along, normals[use.edge]);
      at += length;
    }
    assert(last == first && side == 3);
  }

  void compare_normals(const std::vector<Vector_3>& along, std::vector<Vector_3>& other)
  {
    if(other.empty())
    {
      other = along;
      return;
    }
    for(std::size_t k = 0; k < along.size(); ++k)
      largest_angle = (std::max)(largest_angle, std::atan2(
        norm(CGAL::cross_product(along[k], other[k])), along[k] * other[k]) * 180 / CGAL_PI);
  }
};

#endif // SHELL_CHECKS_H
