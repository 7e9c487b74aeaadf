// The whole conversion: a case with two components and curves, a closed polyhedron with another
// kernel, interruption, and bad input.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/convert_to_T_NURCC.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_NURBS_faces.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef SC::Conversion_case<K> Case;
typedef CGAL::T_NURCC_surface_3<K> Surface;

constexpr double relative_xi = 1e-4, relative_delta = 5e-3;

SC::Error_code convert(const Case& input, std::vector<Surface>& surfaces,
                       SC::Conversion_report& report)
{
  const double diameter = SC::smallest_enclosing_sphere_diameter(input.mesh);
  return SC::convert_to_T_NURCC(input.mesh, input.halfedge_curve_map(), input.traits, surfaces,
                                report, CGAL::parameters::boundary_tolerance(relative_xi * diameter)
                                          .interior_tolerance(relative_delta * diameter));
}

// the distance of a point to the points of all curves, sampled and then refined by halving the step
double distance_to_curves(const Case& input, const K::Point_3& p)
{
  constexpr int halvings = 40;
  const auto point = input.traits.construct_point_on_curve_3_object();
  double best = std::numeric_limits<double>::infinity();
  for(const Case::Curve_segment& s : input.segments)
  {
    if(s.is_empty())
      continue;
    auto squared = [&](double t)
    { return CGAL::squared_distance(p, point(s.curve, s.first + t * (s.second - s.first))); };
    double t = 0, step = 1. / 16;
    for(int i = 0; i <= 16; ++i)
      if(squared(i / 16.) < squared(t))
        t = i / 16.;
    if(std::sqrt(squared(t)) > 2 * best)
      continue;
    for(int i = 0; i < halvings; ++i, step /= 2)
      for(const double next : {(std::max)(0., t - step), (std::min)(1., t + step)})
        if(squared(next) < squared(t))
          t = next;
    best = (std::min)(best, std::sqrt(squared(t)));
  }
  return best;
}

// de Boor's algorithm for the cubic boundary curve of a surface
K::Point_3 boundary_point(const Surface& surface, const Surface::Boundary_curve& curve, double x)
{
  const auto& t = curve.knots;
  const std::size_t n = curve.control_points.size();
  std::size_t k = 3;
  while(k + 1 < n && t[k + 1] <= x)
    ++k;
  std::vector<K::Point_3> d;
  for(std::size_t j = 0; j < 4; ++j)
    d.push_back(surface.control_point(curve.control_points[k - 3 + j]));
  for(std::size_t r = 1; r < 4; ++r)
    for(std::size_t j = 3; j >= r; --j)
    {
      const double a = (x - t[j + k - 3]) / (t[j + 1 + k - r] - t[j + k - 3]);
      d[j] = d[j - 1] + a * (d[j] - d[j - 1]);
    }
  return d[3];
}

// the surfaces keep to the curves and corners, as seen without the code that measures this
void check_boundary(const Case& input, const std::vector<Surface>& surfaces, double diameter)
{
  std::vector<K::Point_3> ends;
  for(const Surface& surface : surfaces)
    for(std::size_t i = 0; i < surface.number_of_patches(); ++i)
    {
      const auto origin = surface.patch_origin(i);
      for(int c = 0; c < 4; ++c)
        ends.push_back(surface.position(i, c % 2 ? origin.u1 : origin.u0,
                                        c / 2 ? origin.v1 : origin.v0));
    }
  for(const auto v : input.mesh.vertices())
    if(input.corners[v])
    {
      double nearest = std::numeric_limits<double>::infinity();
      for(const K::Point_3& p : ends)
        nearest = (std::min)(nearest, CGAL::squared_distance(p, input.mesh.point(v)));
      assert(std::sqrt(nearest) < 1e-12 * diameter);
    }
  for(const Surface& surface : surfaces)
    for(std::size_t c = 0; c < surface.number_of_boundary_chains(); ++c)
    {
      const auto curve = surface.boundary_curve(c);
      assert(!curve.is_closed && curve.knots.size() == curve.control_points.size() + 4);
      constexpr int samples = 60;
      for(int i = 0; i <= samples; ++i)
      {
        const double x = curve.knots.front()
                         + i * (curve.knots.back() - curve.knots.front()) / samples;
        assert(distance_to_curves(input, boundary_point(surface, curve, x))
               < relative_xi * diameter);
      }
    }
}

void test_case()
{
  Case input;
  std::string message;
  assert(CGAL::IO::read_case(CGAL::data_file_path("cases/d4_bracket_simp"), input, message));
  std::vector<Surface> surfaces, again;
  SC::Conversion_report report, second_report;
  assert(convert(input, surfaces, report) == SC::Error_code::OK);
  const double diameter = report.input.diameter;
  assert(surfaces.size() == 2 && report.input.components == 2);
  assert(report.input.loops == 6 && report.input.corners == 16 && report.input.genus == 0);
  assert(report.boundary.max_deviation < relative_xi * diameter);
  assert(report.boundary.certified_bound < relative_xi * diameter);
  assert(report.boundary.max_deviation <= report.boundary.certified_bound);
  assert(report.interior.max_deviation < relative_delta * diameter);
  assert(report.smoothness.max_normal_angle_degrees < 5);
  std::size_t patches = 0;
  for(const Surface& surface : surfaces)
  {
    assert(surface.is_valid());
    patches += surface.number_of_patches();
  }
  assert(patches == report.counts.patches);
  check_boundary(input, surfaces, diameter);

  // same input, same output, bit for bit
  assert(convert(input, again, second_report) == SC::Error_code::OK);
  for(std::size_t s = 0; s < surfaces.size(); ++s)
  {
    assert(surfaces[s].number_of_control_points() == again[s].number_of_control_points());
    for(std::size_t i = 0; i < surfaces[s].number_of_control_points(); ++i)
      assert(surfaces[s].control_point(i) == again[s].control_point(i));
  }
}

struct Interrupting_visitor : SC::Default_visitor
{
  int stages_left;
  explicit Interrupting_visitor(int stages) : stages_left(stages) {}
  void on_stage_begin(const std::string&) { --stages_left; }
  bool go_further() { return stages_left > 0; }
};

// Vertices next to their curves: the accepted distance is a share of the diameter of the whole mesh,
// not of the component.
void test_inexact_vertices()
{
  Case input;
  std::string message;
  assert(CGAL::IO::read_case(CGAL::data_file_path("cases/d4_bracket_simp"), input, message));
  const double diameter = SC::smallest_enclosing_sphere_diameter(input.mesh);
  for(K::Point_3& p : input.mesh.points())
    p = p + K::Vector_3(0.9e-6 * diameter, 0, 0);
  std::vector<Surface> surfaces;
  SC::Conversion_report report;
  Interrupting_visitor visitor(1);
  assert(SC::convert_to_T_NURCC(input.mesh, input.halfedge_curve_map(), input.traits, surfaces,
                                report, CGAL::parameters::visitor(std::ref(visitor)))
         == SC::Error_code::INTERRUPTED);
}

// asks for an end at one call only
struct Hesitating_visitor : SC::Default_visitor
{
  int calls_left;
  explicit Hesitating_visitor(int calls) : calls_left(calls) {}
  bool go_further() { return calls_left-- != 0; }
};

// An interruption is final, in whichever stage and on whichever way to a better surface it comes.
template <typename NamedParameters>
void check_interruption(const CGAL::Surface_mesh<K::Point_3>& mesh, const NamedParameters& np)
{
  std::vector<Surface> surfaces;
  SC::Conversion_report report;
  const int enough = 1000;
  Hesitating_visitor counter(enough);
  SC::convert_to_T_NURCC(mesh, surfaces, report, np.visitor(std::ref(counter)));
  const int calls = enough - counter.calls_left;
  assert(surfaces.size() == 1 && calls > 5 && calls < enough);
  for(int i = 0; i < calls; ++i)
  {
    Hesitating_visitor visitor(i);
    assert(SC::convert_to_T_NURCC(mesh, surfaces, report, np.visitor(std::ref(visitor)))
           == SC::Error_code::INTERRUPTED);
    assert(surfaces.empty() && visitor.calls_left == -1 && !report.message.empty());
  }
}

void test_interruption()
{
  namespace params = CGAL::parameters;
  CGAL::Surface_mesh<K::Point_3> sphere;
  CGAL::make_icosahedron(sphere, K::Point_3(0, 0, 0), 1.);
  CGAL::Subdivision_method_3::Loop_subdivision(sphere, params::number_of_iterations(2));
  const auto np = params::interior_tolerance(0.02).quad_size_map(0.5);
  check_interruption(sphere, np.do_coarsen_patches(true).do_fair_interior(true)
                               .do_certify_interior(true));
  check_interruption(sphere, params::interior_tolerance(1e-3).quad_size_map(0.5)
                               .maximum_number_of_patches(60).do_certify_interior(true));
}

// Caps that the fit has seen are the faces; those of another surface only approximate it.
template <typename TriangleMesh, typename Kernel>
void check_caps(const TriangleMesh& mesh, std::vector<CGAL::T_NURCC_surface_3<Kernel> >& surfaces,
                double delta)
{
  namespace params = CGAL::parameters;
  for(bool use_caps : {false, true})
  {
    SC::Conversion_report report;
    assert(SC::convert_to_T_NURCC(mesh, surfaces, report,
                                  params::interior_tolerance(delta).use_caps(use_caps)
                                    .do_coarsen_patches(true).do_fair_interior(true))
           == SC::Error_code::OK);
    assert(surfaces[0].number_of_extraordinary_points() > 0);
    assert(surfaces[0].has_caps() == use_caps && report.interior.max_deviation < delta);
    SC::NURBS_shell_3<Kernel> shell;
    const auto statistics
      = SC::extract_NURBS_faces(surfaces[0], shell, params::interior_tolerance(delta));
    assert((statistics.deviation < 1e-12) == use_caps);
  }
}

// a sphere as a polyhedron, with another kernel and without curves
void test_closed_polyhedron()
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel Epick;
  typedef CGAL::Polyhedron_3<Epick> Polyhedron;
  Polyhedron sphere;
  CGAL::make_icosahedron(sphere, Epick::Point_3(0, 0, 0), 10.);
  CGAL::Subdivision_method_3::Loop_subdivision(sphere,
                                               CGAL::parameters::number_of_iterations(3));
  for(auto v : vertices(sphere))
    v->point() = CGAL::ORIGIN + (v->point() - CGAL::ORIGIN)
                                  * (10 / std::sqrt((v->point() - CGAL::ORIGIN).squared_length()));

  std::vector<CGAL::T_NURCC_surface_3<Epick> > surfaces;
  SC::Conversion_report report;
  const double delta = 0.1;
  assert(SC::convert_to_T_NURCC(sphere, surfaces, report,
                                CGAL::parameters::interior_tolerance(delta))
         == SC::Error_code::OK);
  assert(surfaces.size() == 1 && surfaces[0].number_of_boundary_chains() == 0);
  double largest = 0;
  for(std::size_t i = 0; i < surfaces[0].number_of_patches(); ++i)
  {
    const auto o = surfaces[0].patch_origin(i);
    const auto p = surfaces[0].position(i, (o.u0 + o.u1) / 2, (o.v0 + o.v1) / 2);
    largest = (std::max)(largest, std::abs(std::sqrt((p - CGAL::ORIGIN).squared_length()) - 10));
  }
  assert(largest < delta + 0.05); // the facets lie up to 0.05 inside the sphere

  check_caps(sphere, surfaces, delta);

  for(int stages : {0, 1, 3})
  {
    Interrupting_visitor visitor(stages);
    assert(SC::convert_to_T_NURCC(sphere, surfaces, report,
                                  CGAL::parameters::interior_tolerance(delta)
                                    .visitor(std::ref(visitor)))
           == SC::Error_code::INTERRUPTED);
    assert(!report.message.empty());
  }
  assert(SC::convert_to_T_NURCC(sphere, surfaces, report, CGAL::parameters::interior_tolerance(-1.))
         == SC::Error_code::INVALID_PARAMETER);
  assert(SC::convert_to_T_NURCC(Polyhedron(), surfaces, report) == SC::Error_code::EMPTY_MESH);
  sphere.erase_facet(sphere.halfedges_begin()); // a boundary without curves
  assert(SC::convert_to_T_NURCC(sphere, surfaces, report)
         == SC::Error_code::INVALID_BOUNDARY_ASSOCIATION);
  assert(!report.message.empty() && surfaces.empty());
}

int main()
{
  test_case();
  test_inexact_vertices();
  test_interruption();
  test_closed_polyhedron();
  return EXIT_SUCCESS;
}
