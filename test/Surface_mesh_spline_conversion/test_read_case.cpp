// Reading of cases: what is read, and the message for each defect of a file.

#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <cassert>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

namespace SC = CGAL::Surface_mesh_spline_conversion;
namespace fs = std::filesystem;

typedef CGAL::Simple_cartesian<double> Kernel;

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

std::string read_text(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
}

template <typename K>
void test_contents()
{
  SC::Conversion_case<K> c;
  std::string message;
  assert(CGAL::IO::read_case(CGAL::data_file_path("cases/d4_bracket_simp"), c, message));
  assert(message.empty() && c.name == "d4_bracket_simp" && c.unit == "mm");
  assert(fs::exists(c.residual_file));
  assert(c.curves.size() == 16 && num_vertices(c.mesh) > 1000);
  const auto curve_map = c.halfedge_curve_map();
  const auto corner_map = c.vertex_is_corner_map();
  std::size_t edges = 0, corners = 0;
  for(const auto h : halfedges(c.mesh))
    if(!get(curve_map, h).is_empty())
    {
      ++edges;
      assert(is_border(opposite(h, c.mesh), c.mesh) && !is_border(h, c.mesh));
      corners += get(corner_map, source(h, c.mesh));
      const auto& segment = get(curve_map, h);
      const auto p
        = c.traits.construct_point_on_curve_3_object()(segment.curve, segment.first);
      assert((p - c.mesh.point(source(h, c.mesh))).squared_length() < 1e-24);
    }
  assert(edges == 168 && corners == 16);
}

// A folder with a copy of a case in which one text is replaced.
class Broken_case
{
public:
  Broken_case()
    : m_folder(fs::temp_directory_path() / "test_read_case"),
      m_source(CGAL::data_file_path("cases/d2_square_corner"))
  {
    fs::remove_all(m_folder);
    fs::create_directories(m_folder);
  }

  ~Broken_case() { fs::remove_all(m_folder); }

  // returns the message on the case with `file` changed.
  std::string operator()(const std::string& file, const std::string& from, const std::string& to)
  {
    for(const std::string name : {"case.json", "mesh.off"})
    {
      std::string text = read_text(m_source / name);
      if(name == file)
      {
        const std::size_t position = text.find(from);
        assert(position != std::string::npos);
        text.replace(position, from.size(), to);
      }
      std::ofstream(m_folder / name, std::ios::binary) << text;
    }
    return message(m_folder);
  }

  // returns the message on the case with the whole text of `file` replaced.
  std::string replace(const std::string& file, const std::string& text)
  {
    (*this)("case.json", "mm", "mm");
    std::ofstream(m_folder / file, std::ios::binary) << text;
    return message(m_folder);
  }

  static std::string message(const fs::path& path)
  {
    SC::Conversion_case<Kernel> c;
    std::string result;
    assert(CGAL::IO::read_case(path.string(), c, result) == result.empty());
    return result;
  }

  fs::path m_folder, m_source;
};

void test_defects_of_the_document()
{
  Broken_case broken;
  const std::string json = "case.json";
  assert(broken(json, "mm", "mm").empty());
  assert(contains(Broken_case::message("/no/such/folder"), "/no/such/folder cannot be opened"));
  assert(contains(broken(json, "mesh.off", "nothing.off"), "nothing.off cannot be opened"));
  assert(contains(broken(json, "boundary-conforming-case", "x"), "line 2: the format"));
  assert(contains(broken(json, "\"version\":1", "\"version\":2"), "only version 1"));
  assert(contains(broken(json, "\"mesh\":", "\"mess\":"), "\"mesh\" is missing"));
  assert(contains(broken(json, "\"curves\":[", "\"curves\":["
                  "{\"id\":0,\"type\":\"line\"},"), "type \"line\" is unknown"));
  assert(contains(broken(json, "\"degree\":3", "\"degree\":-3"), "natural number"));
  assert(contains(broken(json, "\"degree\":3", "\"degree\":1e9"), "curve 0: there are"));
  assert(contains(broken(json, "\"degree\":3", "\"degree\":2"), "curve 0: there are 39 knots"));
  assert(contains(broken(json, "[0,0,0,0,0.125", "[0,0,0,0,5"), "ascending"));
  assert(contains(broken(json, "[0,0,0],[", "[0,0],["), "line 5: an array of 3 numbers"));
  assert(contains(broken(json, "[0,0,0],[", "[0,0,\"0\"],["), "a number is expected"));
  assert(contains(broken(json, "[0,0,0],[", "[0,0,1e999],["), "double precision"));
  assert(contains(broken(json, "\"vertices\":[0,1,4", "\"vertices\":[0,4,1"), "not an edge"));
  assert(contains(broken(json, "\"vertices\":[0,1,4", "\"vertices\":[0,9999,4"), "no vertex 9999"));
  assert(contains(broken(json, "\"vertices\":[0,1,4", "\"vertices\":[0,1.5,4"), "natural number"));
  assert(contains(broken(json, "\"vertices\":[0,", "\"vertices\":["), "31 vertices and 32 edges"));
  assert(contains(broken(json, "[0,0.125,0.25]", "[7,0.125,0.25]"), "no curve with the id 7"));
  assert(contains(broken(json, "[0,0.125,0.25]", "[0,0.125,25]"), "outside the range of curve 0"));
  assert(contains(broken(json, "\"corners\":[0]", "\"corners\":[-1]"), "natural number"));
  assert(contains(broken(json, "[0,0,0.125]", "[0,0,0.125"), "line "));
  assert(contains(broken.replace(json, ""), "ends unexpectedly"));
  assert(contains(broken.replace(json, "\"text\""), "an object is expected"));
  assert(contains(broken.replace(json, std::string(1000000, '[')), "nested too deeply"));
  assert(contains(broken.replace(json, "{\"format\" \"x\"}"), "':' is expected"));
  assert(contains(broken.replace(json, "{} {}"), "follows the end"));
  assert(contains(broken.replace(json, "{\"format\":\"x"), "ends unexpectedly"));
  assert(contains(broken.replace(json, std::string("{\0}", 3)), "a name"));
}

void test_defects_of_the_mesh()
{
  Broken_case broken;
  const std::string off = "mesh.off";
  const auto mesh = [&](const std::string& text) { return broken.replace(off, text); };
  assert(contains(mesh(""), "not a valid OFF file"));
  assert(contains(mesh("OFF\n3 1 0\n0 0 0\n1 0 0\n"), "not a valid OFF file"));
  assert(!mesh("OFF\n999999999999 1 0\n0 0 0\n").empty());
  assert(!mesh("OFF\n-3 1 0\n0 0 0\n").empty());
  const std::string points = " 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  assert(contains(mesh("OFF\n4 2" + points + "3 0 1 2\n3 0 2 7\n"), "not a valid OFF file"));
  assert(contains(mesh("OFF\n4 2" + points + "3 0 1 2\n3 0 2 2\n"), "three different"));
  assert(contains(mesh("OFF\n4 2" + points + "3 0 1 2\n2 0 2\n"), "three different"));
  assert(contains(mesh("OFF\n4 2" + points + "3 0 1 2\n3 0 3 2\n"), "face 1 (vertices 0 3 2)"));
}

// Curves on all surfaces, in a document of its own.
void test_curves_on_surfaces()
{
  Broken_case broken;
  const std::string begin = "{\"format\":\"boundary-conforming-case\",\"version\":1,"
    "\"mesh\":\"mesh.off\",\"curves\":[{\"id\":4,\"type\":\"curve_on_surface\",\"pcurve\":"
    "{\"degree\":1,\"knots\":[0,0,1,1],\"control_points\":[[0,0],[1,1]],\"weights\":[1,2]},"
    "\"surface\":{\"origin\":[0,0,0],\"x_axis\":[1,0,0],\"y_axis\":[0,1,0],\"z_axis\":[0,0,1],";
  const std::string end = "}}]}";
  for(const std::string surface : {"\"type\":\"plane\"", "\"type\":\"cylinder\",\"radius\":1",
                                   "\"type\":\"cone\",\"radius\":1,\"half_angle\":0.3",
                                   "\"type\":\"sphere\",\"radius\":1",
                                   "\"type\":\"torus\",\"radius\":3,\"minor_radius\":1"})
    assert(broken.replace("case.json", begin + surface + end).empty());
  assert(contains(broken.replace("case.json", begin + "\"type\":\"sphere\",\"radius\":-1" + end),
                  "curve 4: the radius is not positive"));
  assert(contains(broken.replace("case.json", begin + "\"type\":\"torus\",\"radius\":3" + end),
                  "\"minor_radius\" is missing"));
  assert(contains(broken.replace("case.json", begin + "\"type\":\"saddle\"" + end),
                  "surface type \"saddle\" is unknown"));
}

int main()
{
  test_contents<Kernel>();
  test_contents<CGAL::Exact_predicates_inexact_constructions_kernel>();
  test_defects_of_the_document();
  test_defects_of_the_mesh();
  test_curves_on_surfaces();
  std::cout << "done" << std::endl;
  return EXIT_SUCCESS;
}
