// The evenness of quads by closed forms: of grids that are conformal, stretched, sheared, or turned
// over, flat and bent, and of one that is uneven in a single cell. The angles at the corners of the
// quad itself do not count.
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/evenness.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cassert>
#include <cmath>
#include <vector>

using CGAL::Surface_mesh_spline_conversion::internal::evenness;
using CGAL::Surface_mesh_spline_conversion::internal::samples_per_side;
using CGAL::Surface_mesh_spline_conversion::internal::Surface_sample;

namespace {

// the samples of a quad with a constant normal; `place` returns a point for a column and a row
template <typename Place>
std::vector<Surface_sample> flat_samples(const Place& place)
{
  std::vector<Surface_sample> samples;
  for(int j = 0; j < samples_per_side; ++j)
    for(int i = 0; i < samples_per_side; ++i)
      samples.push_back(Surface_sample{place(i, j), Eigen::Vector3d(0, 0, 3)});
  return samples;
}

double evenness_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return evenness(flat_samples([&](int i, int j) { return Eigen::Vector3d(i * a + j * b); }));
}

bool is_near(double a, double b) { return std::abs(a - b) < 1e-12; }

void test_linear_maps()
{
  const Eigen::Vector3d x(0.3, 0, 0), y(0, 0.3, 0);
  assert(is_near(evenness_of(x, y), 1));
  assert(is_near(evenness_of(x + y, y - x), 1));
  for(const double ratio : {0.1, 4., 25.})
    assert(is_near(evenness_of(ratio * x, y), 2 * ratio / (1 + ratio * ratio)));
  for(const double angle : {0.2, 1., 3.})
    assert(is_near(evenness_of(x, std::cos(angle) * x + std::sin(angle) * y), std::sin(angle)));
  assert(is_near(evenness_of(y, x), -1));
  assert(is_near(evenness_of(x, 2 * x), 0));
}

// half a cylinder, whose normals turn
void test_bent_quad()
{
  std::vector<Surface_sample> samples;
  for(int j = 0; j < samples_per_side; ++j)
    for(int i = 0; i < samples_per_side; ++i)
    {
      const double angle = 3 * (1 - double(i) / (samples_per_side - 1));
      const Eigen::Vector3d outwards(std::cos(angle), 0, std::sin(angle));
      samples.push_back(Surface_sample{outwards + 0.3 * j * Eigen::Vector3d::UnitY(), outwards});
    }
  assert(evenness(samples) > 0.9);
  for(Surface_sample& s : samples)
    s.normal *= -1;
  assert(evenness(samples) < -0.9);
}

void test_one_sample()
{
  auto samples = flat_samples([](int i, int j) { return Eigen::Vector3d(i, j, 0); });
  const int middle = samples_per_side * samples_per_side / 2;
  samples[middle].point += Eigen::Vector3d(0.4, 0.4, 0);
  assert(evenness(samples) > 0);
  samples[middle].point += Eigen::Vector3d(0.6, 0.6, 0);
  assert(evenness(samples) < 0);
}

void test_corner_of_quad()
{
  auto samples = flat_samples([](int i, int j) { return Eigen::Vector3d(i, j, 0); });
  samples[0].point += Eigen::Vector3d(0.6, 0.6, 0); // an angle of more than a straight one
  assert(evenness(samples) > 0);
  samples[0].point += Eigen::Vector3d(0.5, 0.5, 0); // across the diagonal and beyond: both beside it
  assert(evenness(samples) < 0);
}

} // namespace

int main()
{
  test_linear_maps();
  test_bent_quad();
  test_one_sample();
  test_corner_of_quad();
  return 0;
}
