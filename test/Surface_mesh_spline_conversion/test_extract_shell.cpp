// Extraction from Catmull-Clark surfaces: topology, gaps, tangent planes, and the faces against
// limit points that come from uniform subdivision of the whole mesh.
#include "Catmull_clark_cells.h"
#include "shell_checks.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/Point_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/extract_shell.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;

const double RADIUS = 10;

// the cube with m x m quads on each side, projected to a sphere, frames turned in all ways
Catmull_clark_surface sphere(int m, int depth)
{
  std::map<std::array<int, 3>, int> index;
  std::vector<Eigen::Vector3d> points;
  std::vector<Catmull_clark_surface::Quad> quads;
  auto vertex = [&](int axis, int level, int i, int j)
  {
    std::array<int, 3> p;
    p[axis] = level;
    p[(axis + 1) % 3] = i;
    p[(axis + 2) % 3] = j;
    const auto it = index.emplace(p, int(points.size()));
    if(it.second)
      points.push_back(RADIUS * (Eigen::Vector3d(p[0], p[1], p[2]) * 2. / m
                                 - Eigen::Vector3d::Ones()).normalized());
    return it.first->second;
  };
  for(int axis = 0; axis < 3; ++axis)
    for(int level : {0, m})
      for(int j = 0; j < m; ++j)
        for(int i = 0; i < m; ++i)
        {
          Catmull_clark_surface::Quad q = {vertex(axis, level, i, j), vertex(axis, level, i + 1, j),
                                           vertex(axis, level, i + 1, j + 1),
                                           vertex(axis, level, i, j + 1)};
          if(level == 0)
            std::swap(q[1], q[3]);
          std::rotate(q.begin(), q.begin() + (7 * i + 3 * j + axis) % 4, q.end());
          quads.push_back(q);
        }
  return Catmull_clark_surface(points, quads, depth + 3);
}

// The largest distance between limit points and points of the faces at multiples of 1/16 of a quad,
// which are limit points, except in caps.
template <typename K>
double distance_from_limit_points(const SMSC::NURBS_shell_3<K>& shell,
                                  const SMSC::internal::Point_index& index,
                                  const std::vector<Eigen::Vector3d>& limit_points)
{
  double largest = 0;
  for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
  {
    const auto& s = shell.face(f).surface;
    if(shell.face(f).is_extraordinary)
      continue;
    const int nu = int(std::lround((s.knots[0].knots().back() - s.knots[0].knots().front()) * 16));
    const int nv = int(std::lround((s.knots[1].knots().back() - s.knots[1].knots().front()) * 16));
    for(int j = 0; j <= nv; ++j)
      for(int i = 0; i <= nu; ++i)
      {
        const Eigen::Vector3d p = SMSC::internal::to_eigen(s.point(i / 16., j / 16.));
        largest = (std::max)(largest, (limit_points[index.nearest(p, 1)[0]] - p).norm());
      }
  }
  return largest;
}

double area(const std::vector<SMSC::internal::Bezier_piece>& pieces)
{
  constexpr int INTERVALS = 8;
  double result = 0;
  for(const auto& piece : pieces)
    for(int j = 0; j < INTERVALS; ++j)
      for(int i = 0; i < INTERVALS; ++i)
      {
        const auto d = piece.point_and_tangents((i + 0.5) / INTERVALS, (j + 0.5) / INTERVALS);
        result += d[1].cross(d[2]).norm() / (INTERVALS * INTERVALS);
      }
  return result;
}

// the pieces of the cells are those of the faces, cut in another way
template <typename K>
void check_pieces(const std::vector<SMSC::internal::Bezier_piece>& pieces,
                  const SMSC::NURBS_shell_3<K>& shell)
{
  const auto pieces_of_faces = SMSC::internal::bezier_pieces(shell);
  assert(pieces.size() <= pieces_of_faces.size());
  assert(std::abs(area(pieces) / area(pieces_of_faces) - 1) < 1e-4);
  for(const auto& piece : pieces)
  {
    double distance = RADIUS;
    for(const auto& other : pieces_of_faces)
    {
      double u = 0.5, v = 0.5;
      if(other.face == piece.face)
        distance = (std::min)(distance, SMSC::internal::project_to_piece(
                                          other, piece.point(0.3, 0.6), u, v));
    }
    assert(distance < 1e-12 * RADIUS);
  }
}

template <typename K>
void test(int m, int depth)
{
  const Catmull_clark_surface surface = sphere(m, depth);
  const auto limit_points = surface.limit_points();
  std::vector<Eigen::Vector3d> points;
  for(const auto& entry : limit_points)
    points.push_back(entry.second);
  const SMSC::internal::Point_index index(points);
  const int n = 1 << (depth + 3);
  auto position = [&](std::size_t patch, double u, double v) -> Eigen::Vector3d
  { return limit_points.at({{int(patch), int(std::lround(u * n)), int(std::lround(v * n))}}); };
  double last_deviation = 1e9;
  for(double tolerance : {1., 1e-4, 1e-5})
    for(const auto merging : {SMSC::internal::Merging::NONE, SMSC::internal::Merging::FAST,
                              SMSC::internal::Merging::BEST})
    {
      SMSC::NURBS_shell_3<K> shell;
      std::vector<SMSC::internal::Bezier_piece> pieces;
      const auto result
        = SMSC::internal::extract_shell<K>(surface.cells(depth), surface.neighbors(), position,
                                           {merging, depth, tolerance, {}}, shell, &pieces);
      check_pieces(pieces, shell);
      const Shell_checks<K> checks(shell);
      std::cout << "sphere " << m << ": " << shell.number_of_faces() << " faces, caps deviate "
                << result.cap_deviation << ", gap " << checks.largest_gap << ", angle "
                << checks.largest_angle << std::endl;
      assert(checks.euler_characteristic == 2);
      assert(checks.number_of_border_edges == 0);
      assert(shell.components().size() == 1);
      assert(checks.largest_gap < 1e-13 * RADIUS);
      assert(checks.largest_angle < 1e-8);
      assert(result.number_of_caps == 8 && result.number_of_sharp_caps == 0);
      assert(result.cap_deviation < (std::max)(tolerance, 2e-5) && result.cap_deviation <= last_deviation);
      last_deviation = result.cap_deviation;
      assert(distance_from_limit_points(shell, index, points) < 1e-13 * RADIUS);
    }
}

// Ribbons with arbitrary cross derivatives admit no smooth cap; what remains exact are the curves
// of the outer sides and the spokes.
void test_ribbons_that_do_not_fit(int n)
{
  typedef SMSC::internal::Cap_operator Cap_operator;
  const Cap_operator smooth(n), rough(n, false);
  Eigen::MatrixXd data(smooth.number_of_data(), 3);
  for(int i = 0; i < data.rows(); ++i)
    data.row(i) << std::sin(1.1 * i), std::cos(1.7 * i), std::sin(2.3 * i + 1);
  for(int k = 0; k < n; ++k) // the sides meet in their ends
  {
    const int row = Cap_operator::RIBBON_DATA * k;
    data.row(row + 8 + 3) = data.row(row + 3);
    data.row(row) = data.row(Cap_operator::RIBBON_DATA * ((k + n - 1) % n) + 8);
  }
  assert(smooth.residual(smooth(data), data) > 0.1);
  const Eigen::MatrixXd points = rough(data), raise = Cap_operator::elevation(3, 5);
  for(int k = 0; k < n; ++k)
    for(int b = 0; b < 6; ++b)
    {
      const int row = Cap_operator::RIBBON_DATA * k, first = Cap_operator::POINTS * k;
      const int previous = Cap_operator::POINTS * ((k + n - 1) % n);
      assert((points.row(first + 6 * b + 5)
              - raise.row(b) * data.block(row, 0, 4, 3)).norm() < 1e-11);
      assert((points.row(first + 30 + b)
              - raise.row(b) * data.block(row + 8, 0, 4, 3)).norm() < 1e-11);
      assert((points.row(first + b) - points.row(previous + 6 * b)).norm() < 1e-11);
    }
}

int main()
{
  for(int n : {3, 5, 9})
    test_ribbons_that_do_not_fit(n);
  test<CGAL::Simple_cartesian<double> >(1, 4);
  test<CGAL::Exact_predicates_inexact_constructions_kernel>(2, 3);
  return 0;
}
