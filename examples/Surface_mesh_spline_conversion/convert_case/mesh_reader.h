// Reads mesh files, and names the element that makes a file unusable.
#ifndef CONVERT_CASE_MESH_READER_H
#define CONVERT_CASE_MESH_READER_H

#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

typedef std::vector<std::vector<std::size_t> > Polygons;

inline std::string lower_case_extension(const std::string& filename)
{
  std::string extension = std::filesystem::path(filename).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

inline bool is_mesh_file(const std::string& filename)
{
  const std::set<std::string> extensions = {".off", ".ply", ".obj", ".stl"};
  return extensions.count(lower_case_extension(filename)) > 0;
}

// Returns what is wrong with a single face, or nothing.
inline std::string check_faces(const Polygons& polygons, std::size_t number_of_points)
{
  for(std::size_t f = 0; f < polygons.size(); ++f)
  {
    const std::string face = "face " + std::to_string(f);
    if(polygons[f].size() != 3)
      return face + " has " + std::to_string(polygons[f].size()) + " vertices instead of 3";
    for(std::size_t i = 0; i < 3; ++i)
    {
      const std::string vertex = "vertex " + std::to_string(polygons[f][i]);
      if(polygons[f][i] >= number_of_points)
        return face + " refers to " + vertex + ", which does not exist";
      if(polygons[f][i] == polygons[f][(i + 1) % 3])
        return face + " uses " + vertex + " twice";
    }
  }
  return std::string();
}

// Returns the edge that is used twice in the same direction, or nothing.
inline std::string check_edges(const Polygons& triangles)
{
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> face_of_edge;
  for(std::size_t f = 0; f < triangles.size(); ++f)
    for(std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t source = triangles[f][i], target = triangles[f][(i + 1) % 3];
      const auto inserted = face_of_edge.emplace(std::make_pair(source, target), f);
      if(!inserted.second)
        return "the faces " + std::to_string(inserted.first->second) + " and " + std::to_string(f)
             + " both have an edge from vertex " + std::to_string(source) + " to vertex "
             + std::to_string(target) + ": it is not manifold, or the orientations differ";
    }
  return std::string();
}

// Returns the first vertex whose faces form more than one fan, or nothing.
// \pre check_edges() finds nothing
inline std::string check_vertices(const Polygons& triangles, std::size_t number_of_points)
{
  std::vector<std::map<std::size_t, std::size_t> > next(number_of_points); // opposite edges
  for(const std::vector<std::size_t>& t : triangles)
    for(std::size_t i = 0; i < 3; ++i)
      next[t[i]][t[(i + 1) % 3]] = t[(i + 2) % 3];
  for(std::size_t v = 0; v < number_of_points; ++v)
  {
    if(next[v].empty())
      continue;
    // walk one fan from its first edge, or around if it is closed
    std::set<std::size_t> targets;
    for(const auto& edge : next[v])
      targets.insert(edge.second);
    std::size_t start = next[v].begin()->first;
    for(const auto& edge : next[v])
      if(!targets.count(edge.first))
        start = edge.first;
    std::size_t length = 0;
    for(std::size_t w = start; next[v].count(w) && (length == 0 || w != start); w = next[v][w])
      ++length;
    if(length != next[v].size())
      return "several fans of faces meet at vertex " + std::to_string(v) + ": it is not manifold";
  }
  return std::string();
}

struct Mesh_defect
{
  CGAL::Surface_mesh_spline_conversion::Error_code code;
  std::string message;
};

// Returns what is wrong with the elements of a mesh.
template <typename Points>
Mesh_defect check_mesh(const Points& points, const Polygons& polygons)
{
  using CGAL::Surface_mesh_spline_conversion::Error_code;
  if(polygons.empty())
    return {Error_code::EMPTY_MESH, "the mesh has no face"};
  for(std::size_t i = 0; i < points.size(); ++i)
    if(!(std::isfinite(points[i].x()) && std::isfinite(points[i].y())
         && std::isfinite(points[i].z())))
      return {Error_code::DEGENERATE_MESH,
              "a coordinate of vertex " + std::to_string(i) + " is not finite"};
  std::string message = check_faces(polygons, points.size());
  if(!message.empty())
    return {Error_code::NON_TRIANGULAR_MESH, message};
  message = check_edges(polygons);
  if(message.empty())
    message = check_vertices(polygons, points.size());
  return {message.empty() ? Error_code::OK : Error_code::NON_MANIFOLD_MESH, message};
}

// Some programs write each face with vertices of its own: merges those at the same point. Returns
// what was done, or nothing.
template <typename Points>
std::string merge_soup(Points& points, Polygons& polygons)
{
  std::size_t corners = 0;
  for(const std::vector<std::size_t>& polygon : polygons)
    corners += polygon.size();
  if(polygons.size() < 2 || points.size() != corners)
    return std::string();
  const std::size_t merged
    = CGAL::Polygon_mesh_processing::merge_duplicate_points_in_polygon_soup(points, polygons);
  return merged == 0 ? std::string() : "each face has vertices of its own: " + std::to_string(merged)
                                       + " vertices at the points of others were merged with them";
}

// Reads a triangle mesh from a file in the format OFF, PLY, OBJ, or STL. Returns what is wrong with
// it; what is only suspicious is added to `warnings`.
template <typename Mesh>
Mesh_defect read_mesh(const std::string& filename, Mesh& mesh, std::vector<std::string>& warnings)
{
  using CGAL::Surface_mesh_spline_conversion::Error_code;
  std::vector<typename Mesh::Point> points;
  Polygons polygons;
  if(!std::filesystem::is_regular_file(filename))
    return {Error_code::EMPTY_MESH, "there is no file " + filename};
  if(!CGAL::IO::read_polygon_soup(filename, points, polygons))
    return {Error_code::EMPTY_MESH, "the file " + filename + " cannot be read as "
            + lower_case_extension(filename).substr(1) + " file"};
  const std::string merging = merge_soup(points, polygons);
  if(!merging.empty())
    warnings.push_back(merging);
  const Mesh_defect defect = check_mesh(points, polygons);
  if(defect.code != Error_code::OK)
    return {defect.code, filename + ": " + defect.message};

  const std::size_t unused
    = CGAL::Polygon_mesh_processing::remove_isolated_points_in_polygon_soup(points, polygons);
  if(unused > 0)
    warnings.push_back(std::to_string(unused) + " vertices belong to no face and were left out");
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  return defect;
}

#endif // CONVERT_CASE_MESH_READER_H
