// The cross field is aligned with the boundary, its singularities obey the theorem of Poincare and
// Hopf, and the boundary has regular vertices and convex corners only; the working mesh is the
// input as a point set. The indices are recomputed from the directions in space.

#include "generated_working_meshes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_cross_field.h>

#include <boost/unordered_map.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <limits>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;
using SC::Cross_field;
using SC::Error_code;
using Test::Working_mesh;

Eigen::Vector3d normal(const Working_mesh& mesh, int f)
{
  return mesh.vector(3 * f).cross(mesh.vector(3 * f + 1)).normalized();
}

// direction `branch` of the cross of `f` in space
Eigen::Vector3d direction(const Cross_field& field, int f, int branch)
{
  const double angle = field.angle[f] + branch * Test::pi / 2;
  return std::cos(angle) * field.axis[f]
         + std::sin(angle) * normal(field.mesh, f).cross(field.axis[f]);
}

// angle from the halfedge `h` to direction `branch` of its face
double angle_to_halfedge(const Cross_field& field, int h, int branch)
{
  const Eigen::Vector3d e = field.mesh.vector(h), d = direction(field, h / 3, branch);
  return std::atan2(e.cross(d).dot(normal(field.mesh, h / 3)), e.dot(d));
}

// Follows a direction from face to face about `v`: the total angle minus the turns at the edges.
double turns_about(const Cross_field& field, int v)
{
  const Working_mesh& mesh = field.mesh;
  double total = 0;
  int branch = 0;
  mesh.for_each_outgoing(v, [&](int h)
  {
    const int back = Working_mesh::previous(h);
    const Eigen::Vector3d a = mesh.vector(h), b = -mesh.vector(back);
    total += std::atan2(a.cross(b).norm(), a.dot(b));
    if(mesh.is_border(back))
      return;
    const int next_branch = branch + field.period_jump[back];
    // seen from the same edge, which the neighbour runs through the other way
    const double before = angle_to_halfedge(field, back, branch) + Test::pi;
    const double after = angle_to_halfedge(field, mesh.opposite[back], next_branch);
    total -= std::remainder(after - before, 2 * Test::pi);
    branch = next_branch;
  });
  return total / (Test::pi / 2);
}

void check_field(const Cross_field& field, int euler_characteristic)
{
  const Working_mesh& mesh = field.mesh;
  int sum = 0;
  for(int v = 0; v < mesh.number_of_vertices(); ++v)
  {
    const int k = field.quarter_turns[v];
    assert(std::abs(turns_about(field, v) - k) < 1e-6);
    sum += (mesh.is_border_vertex(v) ? 2 : 4) - k;
    if(!mesh.is_border_vertex(v))
      assert(3 <= k && k <= 5);
    else
      assert(k == 2 || (k == 1 && mesh.is_corner[v]));
  }
  assert(sum == 4 * euler_characteristic);
  for(int h = 0; h < mesh.number_of_halfedges(); ++h)
    if(mesh.is_border(h))
      assert(std::abs(std::sin(2 * angle_to_halfedge(field, h, 0))) < 1e-9);
    else
      assert(field.period_jump[h] == -field.period_jump[mesh.opposite[h]]);
}

// faces lie in their parents and have the same area; chains are covered once
void check_refinement(const Working_mesh& mesh, const Working_mesh& input)
{
  std::vector<double> area(input.number_of_faces(), 0.);
  for(int f = 0; f < mesh.number_of_faces(); ++f)
  {
    const int parent = static_cast<int>(mesh.parent[f]);
    area[parent] += mesh.vector(3 * f).cross(mesh.vector(3 * f + 1)).norm();
    for(int v : mesh.triangles[f])
    {
      const Eigen::Vector3d p = mesh.points[v];
      const double scale = input.vector(3 * parent).norm();
      assert(std::abs((p - input.points[input.triangles[parent][0]]).dot(normal(input, parent)))
             < 1e-9 * scale);
    }
  }
  for(int f = 0; f < input.number_of_faces(); ++f)
  {
    const double wanted = input.vector(3 * f).cross(input.vector(3 * f + 1)).norm();
    assert(std::abs(area[f] - wanted) < 1e-9 * wanted);
  }
  double covered = 0, wanted = 0;
  for(const Working_mesh* m : {&mesh, &input})
    for(int h = 0; h < m->number_of_halfedges(); ++h)
      if(m->is_border(h))
      {
        const auto& piece = m->boundary_piece[h];
        assert(piece.chain != Working_mesh::no_chain && piece.first < piece.last);
        (m == &mesh ? covered : wanted) += piece.last - piece.first;
      }
  assert(std::abs(covered - wanted) <= 1e-12 * wanted);
}

void test_generated_inputs()
{
  for(const Test::Input& input : Test::working_mesh_inputs())
  {
    std::cout << input.name << std::endl;
    Cross_field field;
    field.mesh = input.mesh;
    field.size.assign(input.mesh.number_of_vertices(), input.quad_size);
    assert(SC::internal::build_cross_field(field) == Error_code::OK);
    check_field(field, input.euler_characteristic);
    // here the parents are those of the mesh without ears
    Working_mesh start = input.mesh;
    if(start.parent.back() + 1 == start.triangles.size())
      check_refinement(field.mesh, start);
  }
}

// The surplus of the concave corner of an L goes to a vertex near the bisector, about two quads
// away.
void test_concave_corner()
{
  Cross_field field;
  field.mesh = Test::make_grid(32, 32, false, false, Test::in_plane,
                               [](int i, int j) { return i >= 16 && j >= 16; });
  field.size.assign(field.mesh.number_of_vertices(), 2.);
  assert(SC::internal::build_cross_field(field) == Error_code::OK);
  check_field(field, 1);
  int singularities = 0;
  for(int v = 0; v < field.mesh.number_of_vertices(); ++v)
    if(!field.mesh.is_border_vertex(v) && field.quarter_turns[v] != 4)
    {
      ++singularities;
      const Eigen::Vector3d offset = field.mesh.points[v] - Eigen::Vector3d(16, 16, 0);
      assert(field.quarter_turns[v] == 5);
      assert(3 < offset.norm() && offset.norm() < 6);
      assert(offset[0] < 0 && offset[1] < 0 && std::abs(offset[0] - offset[1]) <= 3);
    }
  assert(singularities == 1);
}

// Three corners of 150 degrees in place of one of a square, much closer to each other than the
// quads, turn the boundary like that one.
void test_close_corners()
{
  const double e = 0.4, b = e * (std::sqrt(3.) - 1) / 2;
  Cross_field field;
  field.mesh = Test::make_grid(32, 32, false, false, Test::in_plane, Test::no_hole);
  for(int v = 0; v < field.mesh.number_of_vertices(); ++v)
  {
    Eigen::Vector3d& p = field.mesh.points[v];
    const bool is_first = p == Eigen::Vector3d(0, 1, 0), is_last = p == Eigen::Vector3d(1, 0, 0);
    if(is_first || is_last)
      field.mesh.is_corner[v] = 1;
    if(p.isZero())
      p = Eigen::Vector3d(b, b, 0);
    else if(is_first || is_last)
      p *= e;
  }
  field.size.assign(field.mesh.number_of_vertices(), 2.);
  assert(SC::internal::build_cross_field(field) == Error_code::OK);
  check_field(field, 1);
  int corners = 0;
  for(int v = 0; v < field.mesh.number_of_vertices(); ++v)
    if(field.mesh.is_border_vertex(v))
      corners += 2 - field.quarter_turns[v];
    else
      assert(field.quarter_turns[v] == 4);
  assert(corners == 4);
}

// On a cylinder the field follows axis and circles.
void test_curvature_alignment()
{
  Cross_field field;
  // a cylinder whose mesh runs along a helix
  field.mesh = Test::make_grid(48, 40, true, false, [](double u, double v)
    { const double angle = Test::pi * u / 24 + v / 9;
      return Eigen::Vector3d(std::cos(angle), std::sin(angle), v / 8); }, Test::no_hole);
  field.size.assign(field.mesh.number_of_vertices(), 0.3);
  assert(SC::internal::build_cross_field(field) == Error_code::OK);
  for(int f = 0; f < field.mesh.number_of_faces(); ++f)
    assert(std::abs(std::sin(2 * std::acos(std::abs(direction(field, f, 0)[2])))) < 0.1);
}

template <typename TriangleMesh, typename Case>
Error_code field_of_case(const Case& input, TriangleMesh& tm, Cross_field& field)
{
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor Halfedge;
  boost::unordered_map<Halfedge, typename Case::Curve_segment> segments;
  std::vector<std::pair<typename Case::Triangle_mesh::Halfedge_index, Halfedge> > halfedges;
  CGAL::copy_face_graph(input.mesh, tm, CGAL::parameters::halfedge_to_halfedge_output_iterator(
                                          std::back_inserter(halfedges)));
  for(const auto& h : halfedges)
    segments[h.second] = input.segments[h.first];
  const auto curves = boost::make_assoc_property_map(segments);
  const SC::Boundary_curve_network_3<TriangleMesh, typename Case::Curve_traits>
    network(tm, curves, input.traits);
  assert(network.error() == Error_code::OK);
  return SC::compute_cross_field(tm, network, field);
}

template <typename K>
void test_case()
{
  typedef typename K::Point_3 Point_3;
  SC::Conversion_case<K> input;
  std::string message;
  assert(CGAL::IO::read_case(CGAL::data_file_path("cases/d4_bracket_simp"), input, message));
  CGAL::Surface_mesh<Point_3> mesh;
  CGAL::Polyhedron_3<K> polyhedron;
  Cross_field field, same;
  assert(field_of_case(input, mesh, field) == Error_code::OK);
  assert(field_of_case(input, polyhedron, same) == Error_code::OK);
  const int chi = static_cast<int>(num_vertices(mesh)) - static_cast<int>(num_edges(mesh))
                  + static_cast<int>(num_faces(mesh));
  check_field(field, chi);
  check_field(same, chi);
}

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

Mesh make_mesh(const Working_mesh& input)
{
  Mesh tm;
  for(const Eigen::Vector3d& p : input.points)
    tm.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
  for(const auto& t : input.triangles)
    tm.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
  return tm;
}

// the direction on a torus about the z axis that winds at 30 degrees to the circles of latitude
Eigen::Vector3d winding(const Eigen::Vector3d& p)
{
  const Eigen::Vector3d latitude = Eigen::Vector3d(-p[1], p[0], 0).normalized();
  const Eigen::Vector3d radius(p[0], p[1], 0);
  const Eigen::Vector3d meridian = latitude.cross(p - 3 * radius.normalized()).normalized();
  return std::cos(Test::pi / 6) * latitude + std::sin(Test::pi / 6) * meridian;
}

// A field that winds about a torus is wanted, against its curvature: it arrives on the mesh and on
// a proxy, without singularities.
void test_wanted_directions()
{
  Mesh tm = make_mesh(Test::make_grid(120, 60, true, true, [](double u, double v)
    { const double a = Test::pi * u / 60, b = Test::pi * v / 30, r = 3 + std::cos(b);
      return Eigen::Vector3d(r * std::cos(a), r * std::sin(a), std::sin(b)); }, Test::no_hole));
  const SC::Boundary_curve_network_3<Mesh> network(tm);
  auto wanted = tm.add_property_map<Mesh::Face_index, Kernel::Vector_3>("f:wanted").first;
  const auto compute = [&](bool use_proxy, Cross_field& field)
  {
    return SC::compute_cross_field(tm, network, field, CGAL::parameters::quad_size_map(0.5)
                                     .cross_field_map(wanted).use_proxy_mesh(use_proxy));
  };
  const auto set_all = [&](auto direction)
  {
    for(const auto f : faces(tm))
    {
      Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
      for(const auto v : vertices_around_face(halfedge(f, tm), tm))
        centroid += SC::internal::to_eigen(tm.point(v)) / 3;
      const Eigen::Vector3d d = direction(centroid);
      wanted[f] = Kernel::Vector_3(d[0], d[1], d[2]);
    }
  };
  const auto largest_angle = [](const Cross_field& field)
  {
    double largest = 0; // as the sine of its double
    for(int f = 0; f < field.mesh.number_of_faces(); ++f)
    {
      const auto& t = field.mesh.triangles[f];
      const Eigen::Vector3d d = winding((field.mesh.points[t[0]] + field.mesh.points[t[1]]
                                         + field.mesh.points[t[2]]) / 3);
      const double cosine = std::abs(d.dot(direction(field, f, 0)));
      largest = (std::max)(largest, std::abs(std::sin(2 * std::acos((std::min)(cosine, 1.)))));
    }
    return largest;
  };
  set_all(winding);
  for(const bool use_proxy : {false, true})
  {
    Cross_field field;
    assert(compute(use_proxy, field) == Error_code::OK);
    assert((field.proxy != nullptr) == use_proxy);
    assert(std::count(field.quarter_turns.begin(), field.quarter_turns.end(), 4)
           == field.mesh.number_of_vertices());
    assert(largest_angle(field) < 0.15);
  }
  Cross_field without_wish, free;
  set_all([](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 0); });
  assert(compute(false, without_wish) == Error_code::OK);
  assert(largest_angle(without_wish) > 0.8);
  assert(SC::compute_cross_field(tm, network, free, CGAL::parameters::quad_size_map(0.5)
                                   .use_proxy_mesh(false)) == Error_code::OK);
  assert(free.angle == without_wish.angle);
  wanted[Mesh::Face_index(7)] = Kernel::Vector_3(0, std::nan(""), 1);
  assert(compute(false, free) == Error_code::INVALID_PARAMETER);
}

// Half of the size near one point of a plane; from there on the size grows by half of the distance,
// along edges.
void test_reduced_sizes()
{
  Cross_field field;
  field.mesh = Test::make_grid(24, 24, false, false, Test::in_plane, Test::no_hole);
  const int middle = 24 * 24;
  field.size.assign(field.mesh.number_of_vertices(), 4);
  std::vector<double> shares(field.mesh.number_of_faces(), 1);
  shares[middle] = 0.5;
  for(std::size_t f = 0; f < shares.size(); ++f)
    field.mesh.parent[f] = shares.size() - 1 - f;
  SC::internal::reduce_sizes(shares, field);
  const std::array<int, 3>& t = field.mesh.triangles[shares.size() - 1 - middle];
  int reduced = 0;
  for(int v = 0; v < field.mesh.number_of_vertices(); ++v)
  {
    double distance = std::numeric_limits<double>::infinity();
    for(const int w : t)
      distance = (std::min)(distance, (field.mesh.points[v] - field.mesh.points[w]).norm());
    const double along_edges = std::sqrt(2.) * distance;
    assert(field.size[v] >= (std::min)(4., 2 + 0.5 * distance) - 1e-12);
    assert(field.size[v] <= (std::min)(4., 2 + 0.5 * along_edges) + 1e-12);
    reduced += field.size[v] == 2;
  }
  assert(reduced == 3);
}

void test_sizes_and_errors()
{
  Mesh tm = make_mesh(Test::make_sphere(3));
  const SC::Boundary_curve_network_3<Mesh> network(tm);
  namespace params = CGAL::parameters;
  Cross_field field;
  assert(SC::compute_cross_field(tm, network, field) == Error_code::OK);
  check_field(field, 2);
  assert(SC::compute_cross_field(tm, network, field, params::quad_size_map(0.))
         == Error_code::INVALID_PARAMETER);
  const auto tiny = [](Mesh::Vertex_index) { return 1e-4; }; // more than a million quads
  assert(SC::compute_cross_field(tm, network, field, params::quad_size_map(tiny))
         == Error_code::INVALID_PARAMETER);
  assert(SC::compute_cross_field(tm, network, field, params::quad_size_map(0.25))
         == Error_code::OK);
  assert(*std::min_element(field.size.begin(), field.size.end()) == 0.25);

  // sizes that jump are smoothed; new vertices may exceed the bound a little
  auto size = tm.add_property_map<Mesh::Vertex_index, double>("v:size", 5).first;
  size[Mesh::Vertex_index(0)] = 0.1;
  assert(SC::compute_cross_field(tm, network, field, params::quad_size_map(size))
         == Error_code::OK);
  for(int h = 0; h < field.mesh.number_of_halfedges(); ++h)
    assert(field.size[field.mesh.target(h)] - field.size[field.mesh.source(h)]
           < field.mesh.vector(h).norm());
}

int main()
{
  test_generated_inputs();
  test_concave_corner();
  test_close_corners();
  test_curvature_alignment();
  test_case<CGAL::Simple_cartesian<double> >();
  test_case<CGAL::Exact_predicates_inexact_constructions_kernel>();
  test_wanted_directions();
  test_reduced_sizes();
  test_sizes_and_errors();
  return 0;
}
