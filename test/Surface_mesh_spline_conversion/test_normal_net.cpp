// Folds of polynomial pieces are found by the Bezier points of their normals, however small they are
// and wherever they lie; pieces that only bend have none.
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Normal_net.h>

#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;
using SC::internal::Bezier_piece;
using SC::internal::Normal_net;
typedef Eigen::Vector3d Vector;

namespace {

Bezier_piece piece(int du, int dv, const std::function<Vector(double, double)>& point)
{
  Bezier_piece result;
  result.degree = {{du, dv}};
  result.face = 0;
  for(int j = 0; j <= dv; ++j)
    for(int i = 0; i <= du; ++i)
      result.points.push_back(point(double(i) / du, double(j) / dv));
  return result;
}

bool has_fold(const Bezier_piece& p)
{
  double u, v;
  return Normal_net(p).find_fold(u, v);
}

// no fold where the surface is a graph, bends by less than a straight angle or has a straight corner
void test_pieces_without_folds()
{
  for(int degree : {3, 5})
  {
    assert(!has_fold(piece(degree, 3, [](double u, double v) { return Vector(u, v, 0); })));
    assert(!has_fold(piece(3, degree, [](double u, double v)
      { return Vector(u + v, v, std::sin(5 * u) * std::cos(4 * v)); })));
  }
  // more than half of a roll: the normals have no half space, but those of its parts have
  assert(!has_fold(piece(5, 3, [](double u, double v)
    { return Vector(std::cos(4 * u), std::sin(4 * u), v); })));
  // the sides at (0,0) lie on a straight line, where the normal vanishes
  Bezier_piece straight = piece(3, 3, [](double u, double v) { return Vector(u, v, 0); });
  straight.points[4] = Vector(-1. / 3, 0, 0);
  straight.points[5] = Vector(0.1, 0.4, 0);
  assert(!has_fold(straight));
}

// the second column of points is moved to the other side of the first one over a part of the side
// at u = 0: no more than `share` of the piece folds
Bezier_piece folded_at_side(double share)
{
  Bezier_piece result = piece(3, 3, [](double u, double v) { return Vector(u, v, 0); });
  result.points[1][0] = -share;
  return result;
}

void test_folds()
{
  for(double share : {0.5, 0.1, 0.01})
    assert(has_fold(folded_at_side(share)));
  assert(!has_fold(folded_at_side(-0.01)));
  // the place is found, too
  double u, v;
  assert(Normal_net(folded_at_side(0.01)).find_fold(u, v));
  assert(u < 0.1 && v < 0.1);
  Bezier_piece inner = piece(5, 5, [](double x, double y) { return Vector(x, y, 0); });
  inner.points[2 * 6 + 2][0] = 5;
  assert(Normal_net(inner).find_fold(u, v));
  assert(0.1 < u && u < 0.9 && 0.1 < v && v < 0.9);
}

void test_places()
{
  std::vector<Bezier_piece> pieces;
  pieces.push_back(piece(3, 3, [](double u, double v) { return Vector(u, v, 0); }));
  pieces.push_back(folded_at_side(0.1));
  const std::vector<Vector> places = SC::internal::folds_of_pieces(pieces);
  assert(places.size() == 1 && places[0].norm() < 0.2);
}

} // namespace

int main()
{
  test_pieces_without_folds();
  test_folds();
  test_places();
  return 0;
}
