// The stages from curves to the quad layout on real cases: the layout has the corners, chains and
// singularities that network and field prescribe, at sizes from the default to very coarse, on the
// mesh itself and on a proxy, and does not depend on the run.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "quad_layout_checks.h"

#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_integer_grid_map.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_quad_layout.h>

#include <iostream>
#include <string>

namespace SC = CGAL::Surface_mesh_spline_conversion;

namespace {

template <typename K, typename Case, typename Network>
SC::Quad_layout<K> make_layout(const Case& input, const Network& network, double size,
                               bool use_proxy, SC::Cross_field& field,
                               SC::Integer_grid_map& map)
{
  SC::Quad_layout<K> layout;
  const auto np = CGAL::parameters::quad_size_map(size).use_proxy_mesh(use_proxy);
  const bool is_made
    = SC::compute_cross_field(input.mesh, network, field, np) == SC::Error_code::OK
      && (field.proxy != nullptr) == use_proxy
      && SC::compute_integer_grid_map(field, map) == SC::Error_code::OK
      && SC::extract_quad_layout(map, input.mesh, network, layout) == SC::Error_code::OK;
  if(!is_made)
    std::cerr << map.message << std::endl;
  assert(is_made);
  return layout;
}

// every corner of the network is a vertex of the layout, exactly
template <typename Layout, typename Case, typename Network>
void check_corners(const Layout& layout, const Case& input, const Network& network)
{
  std::size_t corners = 0, found = 0;
  for(std::size_t v = 0; v < layout.number_of_vertices(); ++v)
    found += layout.is_corner(v) ? 1 : 0;
  for(auto v : vertices(input.mesh))
  {
    if(!network.is_corner(v))
      continue;
    ++corners;
    bool is_vertex = false;
    for(std::size_t w = 0; w < layout.number_of_vertices(); ++w)
      is_vertex = is_vertex || (layout.is_corner(w) && layout.point(w) == input.mesh.point(v));
    assert(is_vertex);
  }
  assert(found == corners);
}

std::multiset<int> irregular_valences(const SC::Cross_field& field)
{
  std::multiset<int> valences;
  for(int v = 0; v < field.mesh.number_of_vertices(); ++v)
  {
    const bool is_border = field.mesh.is_border_vertex(v);
    if(field.quarter_turns[v] != (is_border ? 2 : 4))
      valences.insert(is_border ? -field.quarter_turns[v] : field.quarter_turns[v]);
  }
  return valences;
}

template <typename K>
void test_case(const std::string& name, const std::vector<double>& relative_sizes,
               bool use_proxy = false)
{
  typedef SC::Conversion_case<K> Case;
  typedef SC::Boundary_curve_network_3<typename Case::Triangle_mesh, typename Case::Curve_traits>
    Network;
  Case input;
  std::string message;
  const bool is_read = CGAL::IO::read_case(CGAL::data_file_path("cases/" + name), input, message);
  assert(is_read);
  (void)is_read;
  const Network network(input.mesh, input.halfedge_curve_map(), input.traits);
  assert(network.error() == SC::Error_code::OK);
  std::vector<double> lengths;
  std::vector<bool> is_closed;
  for(std::size_t c = 0; c < network.number_of_chains(); ++c)
  {
    lengths.push_back(CGAL::to_double(network.length(c)));
    is_closed.push_back(network.is_closed(c));
  }
  const double diameter = CGAL::to_double(network.diameter());
  const int chi = static_cast<int>(num_vertices(input.mesh))
                  - static_cast<int>(num_edges(input.mesh))
                  + static_cast<int>(num_faces(input.mesh));

  for(double size : relative_sizes)
  {
    SC::Cross_field field;
    SC::Integer_grid_map map, again;
    const SC::Quad_layout<K> layout
      = make_layout<K>(input, network, size * diameter, use_proxy, field, map);
    const Test::Quad_layout_checks<SC::Quad_layout<K>, typename Case::Triangle_mesh>
      checks(layout, input.mesh, diameter);
    checks.check_combinatorics(chi, static_cast<int>(network.number_of_loops()));
    assert(checks.irregular_valences() == irregular_valences(field));
    checks.check_boundary(lengths, is_closed);
    checks.check_points(4);
    checks.check_continuity(5);
    checks.check_agreement();
    assert(checks.check_orientation(4) > 0.9);
    // where quads hold many triangles, the sampled cells cut their edges: an error of first order
    const int samples_per_side = size < 0.1 ? 12 : 600;
    const double area = checks.relative_area(samples_per_side);
    assert(area > 0.98 && area < 1.001);
    check_corners(layout, input, network);

    const SC::Quad_layout<K> copy
      = make_layout<K>(input, network, size * diameter, use_proxy, field, again);
    assert(copy.number_of_quads() == layout.number_of_quads());
    for(std::size_t v = 0; v < layout.number_of_vertices(); ++v)
      assert(layout.point(v) == copy.point(v));
    std::cout << name << " at " << size << ": " << layout.number_of_quads() << " quads, "
              << (use_proxy ? "proxy, " : "") << (map.is_resolved ? "solved again" : "rectangles") << ", "
              << layout.number_of_quads() / map.parameter_area << " of the wanted number"
              << std::endl;
  }
}

} // namespace

int main()
{
  test_case<CGAL::Simple_cartesian<double> >("d2_square_corner", {0.02, 0.05, 0.5});
  test_case<CGAL::Simple_cartesian<double> >("d4_bracket_simp", {0.042});
  test_case<CGAL::Simple_cartesian<double> >("d4_bracket_simp", {0.09}, true);
  test_case<CGAL::Exact_predicates_inexact_constructions_kernel>("d4_bracket_simp", {0.05});
  return 0;
}
