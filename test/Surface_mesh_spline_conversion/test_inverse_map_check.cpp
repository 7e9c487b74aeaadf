// Folds of an inverse map are found, whatever their size: of one quad that is mapped to a square of
// two triangles, with its lines of constant u bent back in a part of the square.

#include <CGAL/Simple_cartesian.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Inverse_map_check.h>

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef SC::Quad_layout<K> Layout;

namespace {

// (u,v) goes to (u + shift(u,v), v), where the shift is a wave in a disk
struct Waved_map
  : public Layout::Inverse_map
{
  Waved_map(double amplitude, double radius) : m_amplitude(amplitude), m_radius(radius) {}

  Layout::Location operator()(std::size_t, double u, double v) const override
  {
    const double r = std::hypot(u - 0.6, v - 0.3) / m_radius;
    const double bump = r < 1 ? (1 - r * r) * (1 - r * r) : 0;
    const double s = u + m_amplitude * m_radius * bump * std::sin(6 * (u - 0.6) / m_radius);
    Layout::Location location;
    location.point = K::Point_3(s, v, 0);
    location.face = s > v ? 0 : 1;
    location.barycentric = s > v ? std::array<double, 3>{{1 - s, s - v, v}}
                                 : std::array<double, 3>{{1 - v, s, v - s}};
    return location;
  }

  double m_amplitude, m_radius;
};

bool is_orientation_kept(double amplitude, double radius, std::size_t number_of_faces)
{
  const std::vector<std::array<std::size_t, 4> > quads = {{{0, 1, 2, 3}}};
  Layout layout({K::Point_3(0, 0, 0), K::Point_3(1, 0, 0), K::Point_3(1, 1, 0),
                 K::Point_3(0, 1, 0)}, quads);
  layout.set_inverse_map(std::make_shared<const Waved_map>(amplitude, radius));
  return SC::internal::Inverse_map_check<K>(layout, number_of_faces).is_orientation_kept();
}

} // namespace

int main()
{
  // the shift changes by at most 10 times the amplitude per unit: small waves do not fold
  for(double radius : {0.3, 0.1, 0.03})
  {
    assert(is_orientation_kept(0, radius, 2));
    assert(is_orientation_kept(0.05, radius, 2));
    assert(is_orientation_kept(-0.05, radius, 1000));
  }
  assert(!is_orientation_kept(1, 0.3, 2));
  assert(!is_orientation_kept(-1, 0.3, 2));
  // folds as small as a tenth of a quad are seen if the faces are as small
  assert(!is_orientation_kept(1, 0.1, 200));
  assert(!is_orientation_kept(1, 0.03, 2000));
  return 0;
}
