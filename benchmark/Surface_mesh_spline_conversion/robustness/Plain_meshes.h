// Meshes, layouts and boundary curves as plain arrays: what the checker works on. Nothing here uses
// the package.
#ifndef ROBUSTNESS_PLAIN_MESHES_H
#define ROBUSTNESS_PLAIN_MESHES_H

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace Check {

typedef std::array<double, 3> Point;

inline Point operator+(const Point& p, const Point& q)
{
  return {{p[0] + q[0], p[1] + q[1], p[2] + q[2]}};
}

inline Point operator-(const Point& p, const Point& q)
{
  return {{p[0] - q[0], p[1] - q[1], p[2] - q[2]}};
}

inline Point operator*(double a, const Point& p) { return {{a * p[0], a * p[1], a * p[2]}}; }

inline double dot(const Point& p, const Point& q)
{
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

inline Point cross(const Point& p, const Point& q)
{
  return {{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]}};
}

inline double norm(const Point& p) { return std::sqrt(dot(p, p)); }

inline double distance(const Point& p, const Point& q) { return norm(p - q); }

inline double distance_to_segment(const Point& p, const Point& a, const Point& b)
{
  const Point d = b - a;
  const double length = dot(d, d);
  double t = length > 0 ? dot(p - a, d) / length : 0;
  t = t < 0 ? 0 : (t > 1 ? 1 : t);
  return distance(p, a + t * d);
}

inline Point sum(const Point& p, const Point& q) { return p + q; }

inline Point unit(const Point& p)
{
  const double length = norm(p);
  return length > 0 ? (1 / length) * p : p;
}

// the point at `t` in [0,1] between two points
inline Point interpolate(const Point& a, const Point& b, double t) { return a + t * (b - a); }

struct Triangle_mesh
{
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3> > triangles;
  double diameter = 0;                ///< unit of all tolerances
  std::vector<std::size_t> corners;   ///< vertices that have to be vertices of the layout

  // twice as long as the area of the face
  Point normal(std::size_t face) const
  {
    const auto& t = triangles[face];
    return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
  }

  double area() const
  {
    double sum = 0;
    for(std::size_t f = 0; f < triangles.size(); ++f)
      sum += norm(normal(f)) / 2;
    return sum;
  }
};

// The curves of the boundary, each from corner to corner or closed.
struct Boundary_chains
{
  std::vector<double> lengths;
  std::vector<bool> is_closed;
  std::vector<double> distances;  ///< of each chain from the edges of the mesh
  std::function<Point(std::size_t chain, double arc_length)> point;
};

struct Quad_mesh
{
  typedef std::pair<std::size_t, int> Side; ///< (quad, number of the side)
  static constexpr std::size_t null = (std::numeric_limits<std::size_t>::max)();

  struct Piece ///< what a boundary side lies on
  {
    std::size_t chain;
    double first, last;
  };

  struct Location ///< a point on the triangle mesh
  {
    std::size_t face;
    Point barycentric;
    Point point;
  };

  std::vector<Point> points;
  std::vector<std::array<std::size_t, 4> > quads;
  std::vector<std::array<Side, 4> > neighbors;  ///< `null` at the boundary
  std::vector<std::array<Piece, 4> > pieces;    ///< empty if they are not known
  std::vector<bool> is_corner;                  ///< empty if they are not known
  std::function<Location(std::size_t quad, double u, double v)> inverse_map; ///< may be empty
};

} // namespace Check

#endif // ROBUSTNESS_PLAIN_MESHES_H
