// Inputs of the drivers: a case, or a mesh file with smooth curves along its boundary.
#ifndef ROBUSTNESS_LAYOUT_INPUT_H
#define ROBUSTNESS_LAYOUT_INPUT_H

#include "../../../examples/Surface_mesh_spline_conversion/convert_case/mesh_reader.h"
#include "Input_generator.h"
#include "Plain_meshes.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef SC::Conversion_case<K> Case;
typedef SC::Boundary_curve_network_3<Case::Triangle_mesh, Case::Curve_traits> Network;
typedef SC::Quad_layout<K> Layout;

// Gives a mesh smooth curves through its boundary vertices, between corners found by angle.
inline Mesh_defect add_curves(Case& input)
{
  typedef SC::NURBS_curve_traits_3<K> Curve_traits;
  Case::Triangle_mesh& mesh = input.mesh;
  auto curves = mesh.add_property_map<CGAL::SM_Halfedge_index, SC::Curve_segment<Curve_traits> >(
    "h:curve").first;
  Mesh_defect defect;
  defect.code = SC::interpolate_boundary_curves(mesh, Curve_traits(), curves, defect.message);
  for(const CGAL::SM_Halfedge_index h : mesh.halfedges())
    input.segments.push_back({Case::Curve_3(curves[h].curve), curves[h].first, curves[h].second});
  input.corners.assign(mesh.number_of_vertices(), false);
  return defect;
}

inline Mesh_defect read_input(const std::string& path, Case& input)
{
  std::string message;
  if(!is_mesh_file(path))
    return CGAL::IO::read_case(path, input, message)
             ? Mesh_defect{SC::Error_code::OK, message}
             : Mesh_defect{SC::Error_code::INVALID_BOUNDARY_ASSOCIATION, message};
  std::vector<std::string> warnings;
  const Mesh_defect defect = read_mesh(path, input.mesh, warnings);
  return defect.code == SC::Error_code::OK ? add_curves(input) : defect;
}

// Makes the mesh `seed` of the generator.
inline Mesh_defect generate_input(std::size_t seed, Case& input)
{
  std::string description;
  const Check::Triangle_mesh mesh = Check::generate_mesh(seed, description);
  std::vector<CGAL::SM_Vertex_index> vertices;
  for(const Check::Point& p : mesh.points)
    vertices.push_back(input.mesh.add_vertex(K::Point_3(p[0], p[1], p[2])));
  for(const auto& t : mesh.triangles)
    input.mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  return add_curves(input);
}

inline std::string generated_name(std::size_t seed) { return "generated_" + std::to_string(seed); }

// the meshes and cases that `path` stands for, sorted
inline std::vector<std::string> find_inputs(const std::string& path)
{
  namespace fs = std::filesystem;
  if(!fs::is_directory(path) || fs::exists(fs::path(path) / "case.json"))
    return {path};
  std::vector<std::string> entries, inputs;
  for(const auto& entry : fs::directory_iterator(path))
    if(entry.is_directory() || is_mesh_file(entry.path().string()))
      entries.push_back(entry.path().string());
  std::sort(entries.begin(), entries.end());
  for(const std::string& entry : entries)
    for(const std::string& input : find_inputs(entry))
      inputs.push_back(input);
  return inputs;
}

// the name of a mesh file without extension, or of the folder of a case
inline std::string input_name(const std::string& path)
{
  namespace fs = std::filesystem;
  const fs::path p = fs::path(path).lexically_normal();
  if(is_mesh_file(path))
    return p.stem().string();
  return (p.filename() == "case.json" || !p.has_filename() ? p.parent_path() : p)
    .filename().string();
}

inline Check::Point to_plain(const K::Point_3& p) { return {{p.x(), p.y(), p.z()}}; }

// vertices and faces are numbered by their order, the vertices of a face begin with that of its
// halfedge: as `Surface_location` counts them
inline Check::Triangle_mesh to_plain(const Network& network)
{
  const Case::Triangle_mesh& mesh = network.triangle_mesh();
  Check::Triangle_mesh result;
  result.diameter = network.diameter();
  std::vector<std::size_t> position(mesh.number_of_vertices());
  for(const auto v : mesh.vertices())
  {
    position[v] = result.points.size();
    if(network.is_corner(v))
      result.corners.push_back(result.points.size());
    result.points.push_back(to_plain(mesh.point(v)));
  }
  for(const auto f : mesh.faces())
  {
    std::array<std::size_t, 3> triangle;
    std::size_t i = 0;
    for(const auto v : vertices_around_face(mesh.halfedge(f), mesh))
      triangle[i++] = position[v];
    result.triangles.push_back(triangle);
  }
  return result;
}

// the largest distance between the points of a chain and those of its edges at equal parameters
inline double distance_from_edges(const Network& network, std::size_t chain)
{
  const Case::Triangle_mesh& mesh = network.triangle_mesh();
  double largest = 0;
  std::size_t i = 0;
  for(const auto h : network.chain_halfedges(chain))
  {
    const Check::Point a = to_plain(mesh.point(mesh.source(h)));
    const Check::Point b = to_plain(mesh.point(mesh.target(h)));
    const double first = network.arc_length(chain, i), last = network.arc_length(chain, i + 1);
    const int samples = 8;
    for(int k = 0; k <= samples; ++k)
    {
      const double t = double(k) / samples;
      largest = (std::max)(largest, Check::distance(
        to_plain(network.point(chain, first + t * (last - first))), Check::interpolate(a, b, t)));
    }
    ++i;
  }
  return largest;
}

inline Check::Boundary_chains chains_of(const Network& network)
{
  Check::Boundary_chains chains;
  for(std::size_t c = 0; c < network.number_of_chains(); ++c)
  {
    chains.lengths.push_back(network.length(c));
    chains.is_closed.push_back(network.is_closed(c));
    chains.distances.push_back(distance_from_edges(network, c));
  }
  chains.point = [&network](std::size_t chain, double s)
  { return to_plain(network.point(chain, s)); };
  return chains;
}

// the layout as plain arrays; its inverse map is used as long as `layout` lives
inline Check::Quad_mesh to_plain(const Layout& layout)
{
  Check::Quad_mesh result;
  for(std::size_t v = 0; v < layout.number_of_vertices(); ++v)
  {
    result.points.push_back(to_plain(layout.point(v)));
    result.is_corner.push_back(layout.is_corner(v));
  }
  for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
  {
    std::array<std::size_t, 4> quad;
    std::array<Check::Quad_mesh::Side, 4> sides;
    std::array<Check::Quad_mesh::Piece, 4> pieces;
    for(int i = 0; i < 4; ++i)
    {
      const auto& piece = layout.boundary_side(q, i);
      quad[i] = layout.vertex(q, i);
      sides[i] = layout.neighbor(q, i);
      pieces[i] = {piece.chain, piece.first, piece.last};
    }
    result.quads.push_back(quad);
    result.neighbors.push_back(sides);
    result.pieces.push_back(pieces);
  }
  result.inverse_map = [&layout](std::size_t q, double u, double v)
  {
    const Layout::Location at = layout.inverse_map()(q, u, v);
    return Check::Quad_mesh::Location{
      at.face, {{at.barycentric[0], at.barycentric[1], at.barycentric[2]}}, to_plain(at.point)};
  };
  return result;
}

#endif // ROBUSTNESS_LAYOUT_INPUT_H
