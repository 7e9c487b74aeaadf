// Compares the number of control points of T-NURCC surfaces, uniform B-splines and truncated
// hierarchical B-splines on a smooth patch with steep features, at equal tolerances.
// usage: compare_with_hierarchical_splines

#include "Height_field.h"
#include "Hierarchical_splines.h"
#include "surface_types.h"

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_boundary.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_interior.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

const int samples_per_side = 401;
const int spans_at_start = 8; // of all three

Hierarchical::Samples sample(const Height_field& field)
{
  Eigen::VectorXd z(samples_per_side * samples_per_side);
  for(int j = 0; j < samples_per_side; ++j)
    for(int i = 0; i < samples_per_side; ++i)
      z[j * samples_per_side + i]
        = field(double(i) / (samples_per_side - 1), double(j) / (samples_per_side - 1));
  return Hierarchical::Samples(samples_per_side, z);
}

// the smallest number of spans of uniform splines that meets the tolerance, if the error falls
// steadily
int number_of_uniform_spans(const Hierarchical::Samples& samples, double tolerance)
{
  int low = spans_at_start / 2, high = spans_at_start;
  while(Hierarchical::error_of_uniform_splines(samples, high) >= tolerance
        && 2 * high + 3 < samples.size)
  {
    low = high;
    high *= 2;
  }
  while(high - low > 1)
  {
    const int middle = (low + high) / 2;
    (Hierarchical::error_of_uniform_splines(samples, middle) < tolerance ? high : low) = middle;
  }
  return high;
}

// the largest difference in height at the samples
double error_at_samples(const Surface& surface, const Height_target& target,
                        const Hierarchical::Samples& samples)
{
  const int n = int(target.number_of_sides(0));
  double result = 0;
  for(int j = 0; j < samples.size; ++j)
    for(int i = 0; i < samples.size; ++i)
    {
      const double x = n * samples.coordinate(i), y = n * samples.coordinate(j);
      const int a = (std::min)(int(x), n - 1), b = (std::min)(int(y), n - 1);
      const std::size_t quad = std::size_t(b * n + a);
      const Kernel::Point_3 p
        = surface.position(surface.patch_at(quad, x - a, y - b), x - a, y - b);
      result = (std::max)(result, std::abs(p.z() - samples.values[j * samples.size + i]));
    }
  return result;
}

struct T_NURCC_result
{
  std::size_t control_points, iterations;
  double error;
};

T_NURCC_result fit_T_NURCC(const Height_field& field, const Hierarchical::Samples& samples,
                           double tolerance)
{
  const Height_target target(field, spans_at_start);
  Surface surface(target.layout());
  SC::Conversion_report report;
  const auto np = CGAL::parameters::boundary_tolerance(tolerance).interior_tolerance(tolerance)
                    .error_metric(SC::Error_metric::PARAMETRIC);
  if(SC::fit_boundary(surface, target, report, np) != SC::Error_code::OK
     || SC::fit_interior(surface, target, report, np) != SC::Error_code::OK)
    std::printf("  (%s)\n", report.message.c_str());
  return T_NURCC_result{surface.number_of_control_points(), report.iterations.size(),
                        error_at_samples(surface, target, samples)};
}

int main()
{
  const Height_field field;
  const Hierarchical::Samples samples = sample(field);
  std::printf("control points at equal tolerance; %d x %d samples, all start with %d x %d spans\n"
              "%9s %-28s %14s %10s %10s %7s\n", samples.size, samples.size, spans_at_start,
              spans_at_start, "tolerance", "surface", "control points", "iterations", "error",
              "/ THB");
  for(const double tolerance : {1e-4, 1e-5, 1e-6})
  {
    const int spans = number_of_uniform_spans(samples, tolerance);
    const std::size_t uniform = std::size_t((spans + 3) * (spans + 3));
    const Hierarchical::Result narrow = Hierarchical::fit(samples, spans_at_start, tolerance,
                                                           Hierarchical::Marking::QUARTER);
    const Hierarchical::Result wide = Hierarchical::fit(samples, spans_at_start, tolerance,
                                                         Hierarchical::Marking::RING);
    const T_NURCC_result ours = fit_T_NURCC(field, samples, tolerance);
    const double best = double((std::min)(narrow.error < tolerance ? narrow.functions : uniform,
                                          wide.error < tolerance ? wide.functions : uniform));
    const auto print = [&](const char* name, std::size_t n, std::size_t iterations, double error)
    {
      std::printf("%9.0e %-28s %14zu %10zu %10.2e %7.2f\n", tolerance, name, n, iterations, error,
                  double(n) / best);
      std::fflush(stdout);
    };
    print("uniform B-splines", uniform, 1,
          Hierarchical::error_of_uniform_splines(samples, spans));
    print("THB, two by two cells", narrow.functions, std::size_t(narrow.iterations), narrow.error);
    print("THB, three by three cells", wide.functions, std::size_t(wide.iterations), wide.error);
    print("T-NURCC", ours.control_points, ours.iterations, ours.error);
    if((std::max)(narrow.largest_sum_error, wide.largest_sum_error) > 1e-9)
    {
      std::fprintf(stderr, "the truncated functions do not sum up to one\n");
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}
