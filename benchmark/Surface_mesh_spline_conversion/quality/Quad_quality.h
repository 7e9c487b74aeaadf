// Shape and size of the flat quads of a layout or quad mesh, from plain arrays.
#ifndef QUALITY_QUAD_QUALITY_H
#define QUALITY_QUAD_QUALITY_H

#include "../robustness/Plain_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

namespace Check {

struct Quad_quality
{
  std::size_t inverted = 0; ///< quads that are not convex, or face the wrong side of the mesh
  double min_scaled_jacobian = 1;  ///< smallest sine of a corner, seen along the normal of its quad
  double mean_scaled_jacobian = 0; ///< mean over the quads of their smallest
  double mean_angle_deviation = 0; ///< of the corners from a right angle, in degrees
  double max_angle_deviation = 0;
  double min_size_ratio = std::numeric_limits<double>::infinity(); ///< side length / wanted length
  double mean_size_ratio = 0;
  double max_size_ratio = 0;
  double relative_count = 0; ///< number of quads / (area of the mesh / square of the wanted length)
};

// Measures one quad; `outside` is a normal of the mesh near its middle.
inline void add_quad(const Point (&p)[4], const Point& outside, double size, Quad_quality& quality)
{
  const double degrees = 57.29577951308232;
  const Point normal = cross(p[2] - p[0], p[3] - p[1]);
  const double normal_length = norm(normal);
  double least = 1;
  for(int i = 0; i < 4; ++i)
  {
    const Point out = p[(i + 1) % 4] - p[i], in = p[(i + 3) % 4] - p[i];
    const double product = norm(out) * norm(in) * normal_length;
    least = (std::min)(least, product > 0 ? dot(cross(out, in), normal) / product : -1.);
    const double angle = std::atan2(norm(cross(out, in)), dot(out, in)) * degrees;
    const double deviation = std::abs(angle - 90);
    quality.mean_angle_deviation += deviation / 4;
    quality.max_angle_deviation = (std::max)(quality.max_angle_deviation, deviation);
    const double ratio = norm(out) / size;
    quality.min_size_ratio = (std::min)(quality.min_size_ratio, ratio);
    quality.max_size_ratio = (std::max)(quality.max_size_ratio, ratio);
    quality.mean_size_ratio += ratio / 4;
  }
  quality.inverted += (least <= 0 || dot(normal, outside) <= 0) ? 1 : 0;
  quality.min_scaled_jacobian = (std::min)(quality.min_scaled_jacobian, least);
  quality.mean_scaled_jacobian += least;
}

// Measures all quads. `normal(q)` is a normal of the mesh near the middle of quad q, `size(q)` the
// wanted length of its sides.
inline Quad_quality measure_quality(const Quad_mesh& layout, double area_of_mesh,
                                    const std::function<Point(std::size_t)>& normal,
                                    double size)
{
  Quad_quality quality;
  for(std::size_t q = 0; q < layout.quads.size(); ++q)
  {
    Point p[4];
    for(int i = 0; i < 4; ++i)
      p[i] = layout.points[layout.quads[q][i]];
    add_quad(p, normal(q), size, quality);
  }
  const double n = static_cast<double>(layout.quads.size());
  quality.mean_scaled_jacobian /= n;
  quality.mean_angle_deviation /= n;
  quality.mean_size_ratio /= n;
  quality.relative_count = n * size * size / area_of_mesh;
  return quality;
}

} // namespace Check

#endif // QUALITY_QUAD_QUALITY_H
