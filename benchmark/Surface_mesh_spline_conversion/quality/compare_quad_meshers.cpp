// Runs this package and other quad meshers in turn on the same meshes, and measures the results
// with the same functions. The others are given as command lines. Run it with --help for the
// options.

#include "../robustness/layout_run.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

const char* const usage =
  "usage: compare_quad_meshers INPUT... --quads N [options]\n"
  "INPUT is a mesh file (OFF, PLY, OBJ, STL), the folder of a case, or a folder of these.\n"
  "  --quads N            wanted number of quads\n"
  "  --mesher NAME=LINE   command line of another mesher; {input}, {output}, and {quads} stand for\n"
  "                       the input (OBJ), the output (OBJ), and the number of quads\n"
  "  --folder DIR         where the files are written (default: .)\n"
  "  --json FILE          write all figures\n"
  "  --seconds S          limit of the processor time of a run (default: 600)\n"
  "exit status: 0, or 2 for bad arguments\n";

struct Options
{
  std::vector<std::string> inputs;
  std::vector<std::pair<std::string, std::string> > meshers; // (name, command line)
  double quads = 0, seconds = 600;
  std::string folder = ".", json_file;
  bool asks_for_help = false;
};

// Reads the command line; returns what is wrong with it, or nothing.
std::string parse(const std::vector<std::string>& arguments, Options& options)
{
  for(std::size_t i = 0; i < arguments.size(); ++i)
  {
    const std::string& argument = arguments[i];
    if(argument == "--help")
      options.asks_for_help = true;
    else if(argument.substr(0, 2) != "--")
      options.inputs.push_back(argument);
    else
    {
      if(i + 1 == arguments.size())
        return argument + " needs a value";
      const std::string& value = arguments[++i];
      const std::size_t equals = value.find('=');
      if(argument == "--quads")
        options.quads = std::strtod(value.c_str(), nullptr);
      else if(argument == "--mesher" && equals != std::string::npos)
        options.meshers.emplace_back(value.substr(0, equals), value.substr(equals + 1));
      else if(argument == "--folder")
        options.folder = value;
      else if(argument == "--json")
        options.json_file = value;
      else if(argument == "--seconds")
        options.seconds = std::strtod(value.c_str(), nullptr);
      else
        return "'" + argument + " " + value + "' is not understood";
    }
  }
  if(options.asks_for_help)
    return std::string();
  if(options.inputs.empty())
    return "there is no input";
  return options.quads > 0 ? std::string() : "--quads is missing";
}

std::string replace_all(std::string text, const std::string& from, const std::string& to)
{
  for(std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

bool write_obj(const std::string& filename, const Check::Triangle_mesh& mesh)
{
  std::ofstream out(filename);
  out.precision(17);
  for(const Check::Point& p : mesh.points)
    out << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for(const auto& t : mesh.triangles)
    out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return out.flush().good();
}

// A quad mesh as it came from a file.
struct Result
{
  Check::Quad_mesh mesh; // the quads among the faces
  Polygons polygons;     // all faces
  std::size_t repeated_edges = 0; // edges with two faces on one side
};

// Reads a quad mesh, and glues its quads at common vertices.
bool read_result(const std::string& filename, Result& result)
{
  std::vector<K::Point_3> points;
  if(!std::filesystem::exists(filename)
     || !CGAL::IO::read_polygon_soup(filename, points, result.polygons))
    return false;
  CGAL::Polygon_mesh_processing::remove_isolated_points_in_polygon_soup(points, result.polygons);
  for(const K::Point_3& p : points)
    result.mesh.points.push_back(to_plain(p));
  typedef Check::Quad_mesh::Side Side;
  std::map<std::pair<std::size_t, std::size_t>, Side> sides;
  for(const auto& polygon : result.polygons)
  {
    if(polygon.size() != 4)
      continue;
    const std::size_t q = result.mesh.quads.size();
    result.mesh.quads.push_back({{polygon[0], polygon[1], polygon[2], polygon[3]}});
    for(int i = 0; i < 4; ++i)
      result.repeated_edges
        += sides.emplace(std::make_pair(polygon[std::size_t(i)], polygon[std::size_t(i + 1) % 4]),
                         Side(q, i)).second ? 0 : 1;
  }
  const Side none(Check::Quad_mesh::null, 0);
  result.mesh.neighbors.assign(result.mesh.quads.size(), {{none, none, none, none}});
  for(const auto& side : sides)
  {
    const auto other = sides.find({side.first.second, side.first.first});
    if(other != sides.end())
      result.mesh.neighbors[side.second.first][std::size_t(side.second.second)] = other->second;
  }
  return true;
}

typedef std::vector<std::pair<Check::Point, Check::Point> > Segments;

// the edges with a face on one side only
template <typename Faces>
Segments boundary_edges(const std::vector<Check::Point>& points, const Faces& faces)
{
  std::set<std::pair<std::size_t, std::size_t> > halfedges;
  for(const auto& face : faces)
    for(std::size_t i = 0; i < face.size(); ++i)
      halfedges.emplace(face[i], face[(i + 1) % face.size()]);
  Segments edges;
  for(const auto& h : halfedges)
    if(!halfedges.count({h.second, h.first}))
      edges.emplace_back(points[h.first], points[h.second]);
  return edges;
}

// the largest distance of the ends of `from` to `to`
double largest_distance(const Segments& from, const Segments& to)
{
  double largest = 0;
  for(const auto& segment : from)
  {
    double least = std::numeric_limits<double>::infinity();
    for(const auto& other : to)
      least = (std::min)(least,
                         Check::distance_to_segment(segment.first, other.first, other.second));
    largest = (std::max)(largest, least);
  }
  return largest;
}

std::string text_of(const Check::Topology& topology)
{
  std::string text;
  for(const auto& component : topology)
    text += (text.empty() ? "" : ", ") + std::string("chi ") + std::to_string(component.first)
            + " with " + std::to_string(component.second) + " loops";
  return text;
}

// The closest faces of the input give the normals.
class Input_normals
{
  typedef CGAL::AABB_face_graph_triangle_primitive<Case::Triangle_mesh> Primitive;
  typedef CGAL::AABB_tree<CGAL::AABB_traits<K, Primitive> > Tree;

public:
  Input_normals(const Case::Triangle_mesh& mesh, const Check::Triangle_mesh& plain)
    : m_plain(plain), m_tree(faces(mesh).begin(), faces(mesh).end(), mesh)
  {}

  Check::Point operator()(const Check::Point& p) const
  {
    const auto closest = m_tree.closest_point_and_primitive(K::Point_3(p[0], p[1], p[2]));
    return m_plain.normal(std::size_t(closest.second));
  }

private:
  const Check::Triangle_mesh& m_plain;
  Tree m_tree;
};

void measure(const Result& result, const Network& network, const Check::Triangle_mesh& input,
             Record& record)
{
  const Check::Quad_mesh& mesh = result.mesh;
  record.set("quads", json(mesh.quads.size()));
  record.set("other_faces", json(result.polygons.size() - mesh.quads.size()));
  record.set("repeated_edges", json(result.repeated_edges));
  const Check::Topology topology = Check::topology_of(mesh.points.size(), result.polygons);
  record.set("topology", json(text_of(topology)));
  record.set("has_right_topology",
             topology == Check::topology_of(input) && result.repeated_edges == 0 ? "true" : "false");
  const Segments wanted = boundary_edges(input.points, input.triangles);
  const Segments edges = boundary_edges(mesh.points, result.polygons);
  // relative to the diameter; of the vertices, and of what lies between
  record.set("boundary_vertex_distance", json(largest_distance(edges, wanted) / input.diameter));
  record.set("boundary_distance", json((std::max)(largest_distance(edges, wanted),
                                                  largest_distance(wanted, edges))
                                       / input.diameter));
  std::size_t missed = 0;
  for(const std::size_t corner : input.corners)
  {
    double least = input.diameter;
    for(const auto& edge : edges)
      least = (std::min)(least, Check::distance(edge.first, input.points[corner]));
    const double exact = 1e-12;
    missed += least > exact * input.diameter ? 1 : 0;
  }
  record.set("missed_corners", json(missed));
  const Check::Boundary_chains no_chains;
  if(result.repeated_edges == 0)
  {
    Check::Layout_checker checker(mesh, input, no_chains);
    checker.check();
    record.set("extraordinary_points", json(checker.number_of_extraordinary_points()));
  }
  const Input_normals normals(network.triangle_mesh(), input);
  const auto normal = [&](std::size_t q)
  {
    Check::Point middle = {{0, 0, 0}};
    for(const std::size_t v : mesh.quads[q])
      middle = Check::sum(middle, mesh.points[v]);
    return normals(Check::interpolate(Check::Point{{0, 0, 0}}, middle, 0.25));
  };
  const double area = input.area();
  report_quality(Check::measure_quality(mesh, area, normal,
                                        std::sqrt(area / double(mesh.quads.size()))),
                 [&record](const std::string& name, const std::string& value)
                 { record.set(name, value); });
}

// Runs a command line; the processor time is that of all its processes.
Record run_command(const std::string& command, double seconds)
{
  std::string outcome;
  const auto task = [&](Reporter& report)
  {
    limit_processor_time(seconds);
    const int status = std::system(command.c_str());
    report("status", std::to_string(status));
    report("seconds", json(processor_time(RUSAGE_CHILDREN)));
  };
  const double patience = 10; // of elapsed time, compared with processor time
  Record record = run_process(task, patience * seconds, outcome);
  record.set("outcome", json(outcome == "done" && record.number("status") != 0
                             ? "exit status " + record.get("status") : outcome));
  return record;
}

Record run_ours(const Network& network, double size, const std::string& output, double seconds)
{
  std::string outcome;
  const auto task = [&](Reporter& report)
  {
    limit_processor_time(seconds);
    const double begin = processor_time();
    Layout layout;
    const SC::Error_code code = compute_layout(network, size, layout, report);
    report("seconds", json(processor_time() - begin));
    if(code == SC::Error_code::OK)
      CGAL::IO::write_OBJ(output, layout);
  };
  const double patience = 10;
  Record record = run_process(task, patience * seconds, outcome);
  record.set("outcome", json(outcome));
  return record;
}

void print_line(const std::string& input, const std::string& mesher, const Record& record)
{
  std::printf("%-22s %-16s %7.2f s", input.c_str(), mesher.c_str(), record.number("seconds"));
  if(record.get("quads").empty())
    std::printf(" no result: %s", record.text("outcome").c_str());
  else
    std::printf(" %6.0f quads, %4.0f other, %4.0f EP, %3.0f inverted, sj %.2f/%.2f, boundary %.1e "
                "(vertices %.1e), %.0f corners missed, %s%s",
                record.number("quads"), record.number("other_faces"),
                record.number("extraordinary_points"), record.number("inverted"),
                record.number("min_scaled_jacobian"), record.number("mean_scaled_jacobian"),
                record.number("boundary_distance"), record.number("boundary_vertex_distance"),
                record.number("missed_corners"), record.text("topology").c_str(),
                record.get("has_right_topology") == "true" ? "" : " (WRONG)");
  std::printf("\n");
  std::fflush(stdout);
}

// Runs all meshers on one input.
void compare(const std::string& path, const Options& options, std::vector<Record>& records)
{
  const std::string name = input_name(path), stem = options.folder + "/" + name;
  Case input;
  const Mesh_defect defect = read_input(path, input);
  const Network network(input.mesh, input.halfedge_curve_map(), input.traits,
                        CGAL::parameters::vertex_is_constrained_map(input.vertex_is_corner_map()));
  if(defect.code != SC::Error_code::OK || network.error() != SC::Error_code::OK)
  {
    std::printf("%s: %s\n", name.c_str(), (defect.message + network.message()).c_str());
    return;
  }
  const Check::Triangle_mesh mesh = to_plain(network);
  const double size = std::sqrt(mesh.area() / options.quads);
  const std::string input_file = stem + ".obj";
  write_obj(input_file, mesh);
  std::vector<std::pair<std::string, std::string> > meshers = options.meshers;
  meshers.insert(meshers.begin(), std::make_pair(std::string("ours"), std::string()));
  for(const auto& mesher : meshers)
  {
    const std::string output_file = stem + "-" + mesher.first + ".obj";
    std::filesystem::remove(output_file);
    std::string command = replace_all(mesher.second, "{input}", input_file);
    command = replace_all(command, "{output}", output_file);
    command = replace_all(command, "{quads}", std::to_string(long(options.quads)));
    Record record = mesher.second.empty() ? run_ours(network, size, output_file, options.seconds)
                                          : run_command(command, options.seconds);
    record.set("input", json(name));
    record.set("mesher", json(mesher.first));
    Result result;
    if(read_result(output_file, result))
      measure(result, network, mesh, record);
    print_line(name, mesher.first, record);
    records.push_back(record);
  }
}

} // namespace

int main(int argc, char* argv[])
{
  Options options;
  const std::string error = parse(std::vector<std::string>(argv + 1, argv + argc), options);
  if(!error.empty() || options.asks_for_help)
  {
    std::fprintf(stderr, "%s%s%s", error.c_str(), error.empty() ? "" : "\n", usage);
    return error.empty() ? EXIT_SUCCESS : 2;
  }
  std::filesystem::create_directories(options.folder);
  std::vector<Record> records;
  for(const std::string& path : options.inputs)
    for(const std::string& input : find_inputs(path))
      compare(input, options, records);
  if(!options.json_file.empty())
    write_json(options.json_file, records);
  return EXIT_SUCCESS;
}
