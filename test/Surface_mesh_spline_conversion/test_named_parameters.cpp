// The named parameters of the package: each one arrives, in every order of a chain, mixed with
// those of CGAL; what is not given keeps its default; and functions of CGAL accept the chains.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>
#include <CGAL/boost/graph/IO/OFF.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <cassert>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>

namespace params = CGAL::parameters;
namespace internal_np = CGAL::internal_np;

// Parameter number i is always given the value Value<i>.
template <int i>
struct Value
{
  static const int number = i;
};

template <int i>
using Number = std::integral_constant<int, i>;

// For each parameter: its tag, how it begins a chain (only those of the package do), and how it
// continues one.
#define PARAMETER(i, tag_, name)                                                                   \
  auto tag(Number<i>) { return internal_np::tag_; }                                                \
  template <typename NamedParameters>                                                              \
  auto append(Number<i>, const NamedParameters& np) { return np.name(Value<i>()); }
#define PACKAGE_PARAMETER(i, name)                                                                 \
  PARAMETER(i, name, name)                                                                         \
  auto begin(Number<i>) { return params::name(Value<i>()); }

PACKAGE_PARAMETER(0, boundary_tolerance)
PACKAGE_PARAMETER(1, interior_tolerance)
PACKAGE_PARAMETER(2, quad_size_map)
PACKAGE_PARAMETER(3, corner_angle)
PACKAGE_PARAMETER(4, association_tolerance)
PACKAGE_PARAMETER(5, error_metric)
PACKAGE_PARAMETER(6, maximum_number_of_patches)
PACKAGE_PARAMETER(7, do_merge_patches)
PACKAGE_PARAMETER(8, boundary_vertices)
PACKAGE_PARAMETER(9, use_proxy_mesh)
PACKAGE_PARAMETER(10, cross_field_map)
PACKAGE_PARAMETER(11, boundary_tangency)
PACKAGE_PARAMETER(12, do_coarsen_patches)
PACKAGE_PARAMETER(13, do_certify_interior)
PACKAGE_PARAMETER(14, do_keep_large_corners)
PACKAGE_PARAMETER(15, do_fair_interior)
PACKAGE_PARAMETER(16, use_smooth_target)
PACKAGE_PARAMETER(17, boundary_band)
PACKAGE_PARAMETER(18, use_caps)
PARAMETER(19, vertex_point, vertex_point_map)
PARAMETER(20, geom_traits, geom_traits)
PARAMETER(21, vertex_is_constrained, vertex_is_constrained_map)
PARAMETER(22, visitor, visitor)
PARAMETER(23, verbose, verbose)
PARAMETER(24, number_of_iterations, number_of_iterations)
const int number_of_parameters = 25;

// checks that parameter i is found if and only if it is among `given`
template <int i, int... given, typename NamedParameters>
void check_parameter(const NamedParameters& np)
{
  typedef std::decay_t<decltype(params::get_parameter(np, tag(Number<i>())))> Found;
  if constexpr(((given == i) || ...))
    static_assert(std::is_same<Found, Value<i> >::value, "the parameter must arrive");
  else
  {
    static_assert(std::is_same<Found, internal_np::Param_not_found>::value,
                  "the parameter must have its default");
    const int number
      = params::choose_parameter(params::get_parameter(np, tag(Number<i>())), 42);
    assert(number == 42);
  }
}

template <int... given, typename NamedParameters, int... i>
void check_chain(const NamedParameters& np, std::integer_sequence<int, i...>)
{
  (check_parameter<i, given...>(np), ...);
}

template <typename NamedParameters>
NamedParameters extend(const NamedParameters& np) { return np; }

template <int first, int... others, typename NamedParameters>
auto extend(const NamedParameters& np, Number<first> parameter, Number<others>... rest)
{
  return extend(append(parameter, np), rest...);
}

template <int first, int... others>
void test_chain()
{
  check_chain<first, others...>(extend(begin(Number<first>()), Number<others>()...),
                                std::make_integer_sequence<int, number_of_parameters>());
}

// all orders of three parameters of the package and one of CGAL, as far as the latter is not first
template <int a, int b, int c, int d>
void test_orders()
{
  test_chain<a, b, c, d>(); test_chain<a, b, d, c>(); test_chain<a, c, b, d>();
  test_chain<a, c, d, b>(); test_chain<a, d, b, c>(); test_chain<a, d, c, b>();
  test_chain<b, a, c, d>(); test_chain<b, a, d, c>(); test_chain<b, c, a, d>();
  test_chain<b, c, d, a>(); test_chain<b, d, a, c>(); test_chain<b, d, c, a>();
  test_chain<c, a, b, d>(); test_chain<c, a, d, b>(); test_chain<c, b, a, d>();
  test_chain<c, b, d, a>(); test_chain<c, d, a, b>(); test_chain<c, d, b, a>();
}

void test_default()
{
  typedef std::decay_t<decltype(params::get_parameter(params::default_values(),
                                                      internal_np::boundary_tolerance))> Found;
  static_assert(std::is_same<Found, internal_np::Param_not_found>::value, "nothing is given");
  check_chain(params::verbose(true).visitor(Value<22>()), std::integer_sequence<int, 0, 6, 24>());
}

// a visitor with a state is passed by std::ref() and comes back as a reference
void test_reference()
{
  int visitor = 0, default_visitor = 0;
  const auto np = params::boundary_tolerance(1.).visitor(std::ref(visitor)).interior_tolerance(2.);
  typedef internal_np::Lookup_named_param_def<internal_np::visitor_t, decltype(np),
                                              int>::reference Reference;
  Reference found = params::choose_parameter(
    params::get_parameter_reference(np, internal_np::visitor), default_visitor);
  found = 7;
  assert(visitor == 7 && default_visitor == 0);
}

void test_function_of_CGAL()
{
  typedef CGAL::Simple_cartesian<double>::Point_3 Point_3;
  CGAL::Surface_mesh<Point_3> mesh;
  mesh.add_face(mesh.add_vertex(Point_3(0, 0, 0)), mesh.add_vertex(Point_3(1, 0, 0)),
                mesh.add_vertex(Point_3(0, 1, 0)));
  auto moved = mesh.add_property_map<CGAL::SM_Vertex_index, Point_3>("v:moved").first;
  for(const auto v : mesh.vertices())
    moved[v] = mesh.point(v) + (Point_3(5, 5, 5) - Point_3(0, 0, 0));

  std::stringstream with_map, plain;
  assert(CGAL::IO::write_OFF(with_map, mesh,
                             params::interior_tolerance(0.1).vertex_point_map(moved)));
  assert(CGAL::IO::write_OFF(plain, mesh, params::interior_tolerance(0.1)));
  assert(with_map.str().find("5 5 5") != std::string::npos);
  assert(plain.str().find("5 5 5") == std::string::npos);
}

int main()
{
  test_orders<0, 1, 2, 9>();
  test_orders<3, 4, 5, 14>();
  test_orders<6, 7, 10, 13>();
  test_orders<8, 9, 11, 12>();
  test_orders<15, 16, 18, 20>();
  test_chain<0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20>();
  test_chain<8, 20, 19, 18, 17, 16, 15, 14, 7, 13, 6, 12, 5, 11, 4, 10, 3, 9, 2, 1, 0>();
  test_chain<4>();
  test_default();
  test_reference();
  test_function_of_CGAL();
  return EXIT_SUCCESS;
}
