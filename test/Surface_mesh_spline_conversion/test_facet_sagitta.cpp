// The sagitta of the facets of prisms, which is known, and the warning about tolerances below it.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/conversion/facet_sagitta.h>
#include <CGAL/number_type_config.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

// the sides of a prism, split into triangles along parallel diagonals
template <typename Mesh, typename Point>
void make_prism(std::size_t n, double radius, double height, Mesh& mesh)
{
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3> > triangles;
  for(std::size_t i = 0; i < n; ++i)
  {
    const double a = 2 * CGAL_PI * double(i) / double(n);
    points.emplace_back(radius * std::cos(a), radius * std::sin(a), 0);
    points.emplace_back(radius * std::cos(a), radius * std::sin(a), height);
    const std::size_t j = (i + 1) % n;
    triangles.push_back({{2 * i, 2 * j, 2 * j + 1}});
    triangles.push_back({{2 * i, 2 * j + 1, 2 * i + 1}});
  }
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, mesh);
}

template <typename Mesh, typename Point>
void test_prisms()
{
  for(const std::size_t n : {12, 40})
    for(const double radius : {1e-3, 7.})
    {
      Mesh mesh;
      make_prism<Mesh, Point>(n, radius, 3 * radius, mesh);
      const double expected = radius * (1 - std::cos(CGAL_PI / double(n)));
      const double sagitta = SC::internal::facet_sagitta(mesh, get(CGAL::vertex_point, mesh));
      assert(std::abs(sagitta - expected) < 0.02 * expected);
    }
  const Point p(0, 0, 0), q(2, 0, 0), r(2, 1, 0), s(0, 1, 0);
  Mesh flat;
  const std::vector<Point> points = {p, q, r, s};
  const std::vector<std::array<std::size_t, 3> > triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, flat);
  assert(SC::internal::facet_sagitta(flat, get(CGAL::vertex_point, flat)) == 0);
}

void test_warning()
{
  SC::Conversion_report report;
  report.input.facet_sagitta = 0.01;
  report.counts.patches = 90;
  for(const std::size_t k : {1, 2, 3})
  {
    SC::Conversion_report::Iteration iteration;
    iteration.stage = "fit_interior";
    iteration.patches = 30 * k;
    iteration.interior_linf = 0.0098 / double(k); // the second one is below half the sagitta
    report.iterations.push_back(iteration);
  }
  SC::internal::warn_about_facets(0.005, report);
  assert(report.warnings.empty());
  SC::internal::warn_about_facets(0.0049, report);
  assert(report.warnings.size() == 1);
  assert(report.warnings[0].find("30 of 90 patches") != std::string::npos);
  report.iterations.clear(); // the tolerance was never near
  SC::internal::warn_about_facets(0.0049, report);
  assert(report.warnings.size() == 2);
  assert(report.warnings[1].find("0 of 90 patches") != std::string::npos);
  SC::Conversion_report unmeasured;
  SC::internal::warn_about_facets(0.005, unmeasured);
  assert(unmeasured.warnings.empty());
}

// with a smooth target, the distance from the mesh counts, not the sagitta
void test_warning_about_smooth_target()
{
  SC::Conversion_report report;
  report.input.facet_sagitta = 0.01;
  report.interior.target_height = 0.012;
  report.interior.target_deviation = 0.0006;
  report.interior.max_deviation = 0.001;
  SC::internal::warn_about_facets(0.001, report);
  assert(report.warnings.empty());
  report.interior.max_deviation = 0.0075;
  SC::internal::warn_about_facets(0.001, report);
  assert(report.warnings.size() == 1);
  for(const char* figure : {"0.001", "0.012", "0.0006", "0.0075"})
    assert(report.warnings[0].find(figure) != std::string::npos);
}

int main()
{
  typedef CGAL::Simple_cartesian<double> K;
  typedef CGAL::Exact_predicates_inexact_constructions_kernel Epick;
  test_prisms<CGAL::Surface_mesh<K::Point_3>, K::Point_3>();
  test_prisms<CGAL::Polyhedron_3<Epick>, Epick::Point_3>();
  test_warning();
  test_warning_about_smooth_target();
  return EXIT_SUCCESS;
}
