// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_CASE_READER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_CASE_READER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_case.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/JSON_value.h>

#include <CGAL/IO/OFF.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Reads a case in the format "boundary-conforming-case", version 1. What is wrong is told by
// exceptions, which IO::read_case() catches.
template <typename K>
class Case_reader
{
  typedef std::size_t size_type;
  typedef typename K::FT FT;
  typedef typename K::Point_2 Point_2;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;
  typedef Conversion_case<K> Case;
  typedef typename Case::Triangle_mesh Mesh;
  typedef typename Mesh::Vertex_index Vertex_index;
  typedef typename Mesh::Halfedge_index Halfedge_index;
  typedef typename Case::Curve_segment Curve_segment;

public:
  // `path` is a folder or a file.
  explicit Case_reader(const std::string& path) : m_file(path)
  {
    std::error_code ignored;
    if(std::filesystem::is_directory(m_file, ignored))
      m_file /= "case.json";
  }

  void read(Case& result)
  {
    const std::string text = read_text();
    try
    {
      const JSON_value document = JSON_parser(text)();
      read_header(document, result);
      read_mesh(sibling(document.at("mesh")), result.mesh);
      if(const JSON_value* residual = document.find("residual"))
        result.residual_file = sibling(*residual);
      if(const JSON_value* curves = document.find("curves"))
        for(const JSON_value& curve : curves->as_array())
          read_curve(curve, result);
      result.segments.resize(num_halfedges(result.mesh));
      result.corners.resize(num_vertices(result.mesh), false);
      if(const JSON_value* loops = document.find("loops"))
        for(const JSON_value& loop : loops->as_array())
          read_loop(loop, result);
    }
    catch(const JSON_error& error)
    {
      throw std::runtime_error(m_file.string() + ", " + error.what() + ".");
    }
  }

private:
  std::string read_text() const
  {
    std::ifstream in(m_file, std::ios::binary);
    if(!in)
      throw std::runtime_error("The file " + m_file.string() + " cannot be opened.");
    std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    if(in.bad())
      throw std::runtime_error("The file " + m_file.string() + " cannot be read.");
    return text;
  }

  std::string sibling(const JSON_value& name) const
  {
    return (m_file.parent_path() / name.as_string()).string();
  }

  static void read_header(const JSON_value& document, Case& result)
  {
    const JSON_value& format = document.at("format");
    if(format.as_string() != "boundary-conforming-case")
      throw JSON_error(format.place() + "the format is not \"boundary-conforming-case\"");
    const JSON_value& version = document.at("version");
    if(version.as_number() != 1)
      throw JSON_error(version.place() + "only version 1 of the format is known");
    if(const JSON_value* name = document.find("name"))
      result.name = name->as_string();
    if(const JSON_value* unit = document.find("unit"))
      result.unit = unit->as_string();
  }

  static void read_mesh(const std::string& file, Mesh& mesh)
  {
    std::ifstream in(file, std::ios::binary);
    if(!in)
      throw std::runtime_error("The file " + file + " cannot be opened.");
    std::vector<Point_3> points;
    std::vector<std::vector<size_type> > polygons;
    if(!CGAL::IO::read_OFF(in, points, polygons))
      throw std::runtime_error("The file " + file + " is not a valid OFF file.");
    for(const Point_3& p : points)
      mesh.add_vertex(p);
    for(size_type i = 0; i < polygons.size(); ++i)
      add_face(file, i, polygons[i], mesh);
  }

  static void add_face(const std::string& file, size_type number,
                       const std::vector<size_type>& polygon, Mesh& mesh)
  {
    std::string name = "The file " + file + ": face " + std::to_string(number) + " (vertices";
    std::vector<Vertex_index> face;
    for(const size_type v : polygon)
      name += " " + std::to_string(v);
    name += ") ";
    for(const size_type v : polygon)
    {
      if(v >= num_vertices(mesh))
        throw std::runtime_error(name + "has a vertex that does not exist.");
      face.push_back(Vertex_index(static_cast<typename Mesh::size_type>(v)));
    }
    std::sort(face.begin(), face.end());
    if(face.size() < 3 || std::adjacent_find(face.begin(), face.end()) != face.end())
      throw std::runtime_error(name + "has fewer than three different vertices.");
    std::transform(polygon.begin(), polygon.end(), face.begin(), [](size_type v)
      { return Vertex_index(static_cast<typename Mesh::size_type>(v)); });
    if(mesh.add_face(face) == Mesh::null_face())
      throw std::runtime_error(name + "has an edge or vertex that is not manifold, or is oriented "
                                      "against a neighbor.");
  }

  // the data of a B-spline curve with points of any dimension
  template <typename Point>
  struct Spline
  {
    int degree;
    std::vector<FT> knots;
    std::vector<Point> control_points;
    std::vector<FT> weights;
  };

  template <typename Point>
  static Spline<Point> read_spline(const JSON_value& value)
  {
    const double maximum_degree = 1000; // far beyond any use, yet an int
    Spline<Point> result;
    const JSON_value& degree = value.at("degree");
    result.degree = static_cast<int>((std::min)(double(degree.as_index()), maximum_degree));
    result.knots = numbers(value.at("knots"));
    for(const JSON_value& point : value.at("control_points").as_array())
      result.control_points.push_back(read_point(point, static_cast<Point*>(nullptr)));
    if(const JSON_value* weights = value.find("weights"))
      result.weights = numbers(*weights);
    return result;
  }

  static std::vector<FT> numbers(const JSON_value& value)
  {
    const std::vector<double> result = value.as_numbers();
    return std::vector<FT>(result.begin(), result.end());
  }

  static Point_2 read_point(const JSON_value& value, Point_2*)
  {
    const std::vector<double> c = value.as_numbers(2);
    return Point_2(FT(c[0]), FT(c[1]));
  }

  static Point_3 read_point(const JSON_value& value, Point_3*)
  {
    const std::vector<double> c = value.as_numbers(3);
    return Point_3(FT(c[0]), FT(c[1]), FT(c[2]));
  }

  static Vector_3 read_vector(const JSON_value& value)
  {
    const std::vector<double> c = value.as_numbers(3);
    return Vector_3(FT(c[0]), FT(c[1]), FT(c[2]));
  }

  void read_curve(const JSON_value& value, Case& result)
  {
    const size_type id = value.at("id").as_index();
    if(!m_curve_of_id.emplace(id, result.curves.size()).second)
      throw JSON_error(value.place() + "there are two curves with the id " + std::to_string(id));
    const std::string name = value.place() + "curve " + std::to_string(id) + ": ";
    const std::string& type = value.at("type").as_string();
    if(type == "nurbs")
    {
      const Spline<Point_3> s = read_spline<Point_3>(value);
      require_no_defect(
        name, NURBS_curve_3<K>::defect(s.degree, s.knots, s.control_points, s.weights));
      add_curve(value, NURBS_curve_3<K>(s.degree, s.knots, s.control_points, s.weights), result);
    }
    else if(type == "curve_on_surface")
    {
      const Spline<Point_2> s = read_spline<Point_2>(value.at("pcurve"));
      const Elementary_surface_3<K> surface = read_surface(value.at("surface"));
      require_no_defect(name, Curve_on_surface_3<K>::defect(surface, s.degree, s.knots,
                                                            s.control_points, s.weights));
      add_curve(value, Curve_on_surface_3<K>(surface, s.degree, s.knots, s.control_points,
                                             s.weights), result);
    }
    else
      throw JSON_error(name + "the type \"" + type + "\" is unknown");
  }

  template <typename Curve>
  void add_curve(const JSON_value& value, const Curve& curve, Case& result)
  {
    result.curves.push_back(curve);
    m_ranges.push_back(read_range(value, {curve.first_parameter(), curve.last_parameter()}));
  }

  static void require_no_defect(const std::string& name, const std::string& defect)
  {
    if(!defect.empty())
      throw JSON_error(name + defect);
  }

  // returns the interval of parameters allowed on edges.
  static std::pair<FT, FT> read_range(const JSON_value& value, std::pair<FT, FT> range)
  {
    if(const JSON_value* member = value.find("range"))
    {
      const std::vector<double> r = member->as_numbers(2);
      if(!(r[0] < r[1]))
        throw JSON_error(member->place() + "the range is empty");
      range.first = (std::max)(range.first, FT(r[0]));
      range.second = (std::min)(range.second, FT(r[1]));
    }
    return range;
  }

  static Elementary_surface_3<K> read_surface(const JSON_value& value)
  {
    typedef Elementary_surface_3<K> Surface;
    const std::map<std::string, typename Surface::Type> types
      = {{"plane", Surface::PLANE}, {"cylinder", Surface::CYLINDER}, {"cone", Surface::CONE},
         {"sphere", Surface::SPHERE}, {"torus", Surface::TORUS}};
    const JSON_value& name = value.at("type");
    const auto type = types.find(name.as_string());
    if(type == types.end())
      throw JSON_error(name.place() + "the surface type \"" + name.string + "\" is unknown");
    Surface result;
    result.type = type->second;
    result.origin = read_point(value.at("origin"), static_cast<Point_3*>(nullptr));
    result.x_axis = read_vector(value.at("x_axis"));
    result.y_axis = read_vector(value.at("y_axis"));
    result.z_axis = read_vector(value.at("z_axis"));
    if(result.type != Surface::PLANE)
      result.radius = FT(value.at("radius").as_number());
    if(result.type == Surface::TORUS)
      result.minor_radius = FT(value.at("minor_radius").as_number());
    if(result.type == Surface::CONE)
      result.half_angle = FT(value.at("half_angle").as_number());
    return result;
  }

  void read_loop(const JSON_value& value, Case& result) const
  {
    const std::vector<JSON_value>& vertices = value.at("vertices").as_array();
    const std::vector<JSON_value>& edges = value.at("edges").as_array();
    if(edges.size() != vertices.size())
      throw JSON_error(value.place() + "a loop has " + std::to_string(vertices.size())
                       + " vertices and " + std::to_string(edges.size()) + " edges");
    for(size_type i = 0; i < edges.size(); ++i)
    {
      const Vertex_index source = read_vertex(vertices[i], result.mesh);
      const Vertex_index target = read_vertex(vertices[(i + 1) % edges.size()], result.mesh);
      const Halfedge_index h = boundary_halfedge(vertices[i], source, target, result.mesh);
      if(!result.segments[h].is_empty())
        throw JSON_error(vertices[i].place() + edge_name(source, target)
                         + " occurs twice in the loops");
      result.segments[h] = read_segment(edges[i], result);
    }
    if(const JSON_value* corners = value.find("corners"))
      for(const JSON_value& corner : corners->as_array())
        result.corners[read_vertex(corner, result.mesh)] = true;
  }

  static Vertex_index read_vertex(const JSON_value& value, const Mesh& mesh)
  {
    if(value.as_index() >= num_vertices(mesh))
      throw JSON_error(value.place() + "the mesh has no vertex "
                       + std::to_string(value.as_index()));
    return Vertex_index(static_cast<typename Mesh::size_type>(value.as_index()));
  }

  static Halfedge_index boundary_halfedge(const JSON_value& place, Vertex_index source,
                                          Vertex_index target, const Mesh& mesh)
  {
    const Halfedge_index h = mesh.halfedge(source, target);
    if(h == Mesh::null_halfedge())
      throw JSON_error(place.place() + edge_name(source, target) + " is not an edge of the mesh");
    if(mesh.is_border(h))
      throw JSON_error(place.place() + edge_name(source, target)
                       + " runs with the mesh to its right; reverse the loop");
    if(!mesh.is_border(mesh.opposite(h)))
      throw JSON_error(place.place() + edge_name(source, target)
                       + " is not on the boundary of the mesh");
    return h;
  }

  static std::string edge_name(Vertex_index source, Vertex_index target)
  {
    return "the edge from vertex " + std::to_string(size_type(source)) + " to vertex "
           + std::to_string(size_type(target));
  }

  Curve_segment read_segment(const JSON_value& value, const Case& result) const
  {
    const std::vector<double> numbers = value.as_numbers(3);
    const auto position = m_curve_of_id.find(value.items[0].as_index());
    if(position == m_curve_of_id.end())
      throw JSON_error(value.place() + "there is no curve with the id "
                       + std::to_string(value.items[0].as_index()));
    const auto& range = m_ranges[position->second];
    // parameters may be off by the rounding of their decimal notation
    const FT slack = FT(1e-9) * (range.second - range.first);
    for(const FT& t : {FT(numbers[1]), FT(numbers[2])})
      if(!(range.first - slack <= t && t <= range.second + slack))
        throw JSON_error(value.place() + "a parameter is outside the range of curve "
                         + std::to_string(position->first));
    return Curve_segment{result.curves[position->second], FT(numbers[1]), FT(numbers[2])};
  }

  std::filesystem::path m_file;
  std::map<size_type, size_type> m_curve_of_id;
  std::vector<std::pair<FT, FT> > m_ranges; // of the curves
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_CASE_READER_H
