// The STEP file of a shell, read back by a parser that knows the syntax of ISO 10303-21 only.
#include "Catmull_clark_cells.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/STEP.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/VTU.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/extract_shell.h>

#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <string>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;
typedef CGAL::Simple_cartesian<double> K;
typedef SMSC::NURBS_shell_3<K> Shell;

struct Entity
{
  std::string type;
  std::string arguments;           // with the parentheses
  std::vector<long> references;    // in their order
};

struct STEP_file
{
  std::map<long, Entity> entities;

  explicit STEP_file(const std::string& text)
  {
    assert(text.compare(0, 14, "ISO-10303-21;\n") == 0);
    const std::string end = "ENDSEC;\nEND-ISO-10303-21;\n";
    assert(text.size() > end.size() && text.substr(text.size() - end.size()) == end);
    std::size_t at = text.find("DATA;\n");
    assert(at != std::string::npos);
    for(at += 6; text[at] == '#'; )
    {
      const std::size_t equal = text.find('=', at), stop = text.find(";\n", at);
      const std::string body = text.substr(equal + 1, stop - equal - 1);
      Entity entity;
      entity.type = body.substr(0, body.find('('));
      entity.arguments = body.substr(body.find('('));
      long depth = 0;
      for(std::size_t i = 0; i < body.size(); ++i)
      {
        depth += (body[i] == '(') - (body[i] == ')');
        assert(depth >= 0);
        if(body[i] == '#')
          entity.references.push_back(std::stol(body.substr(i + 1)));
      }
      assert(depth == 0);
      const bool is_new
        = entities.emplace(std::stol(text.substr(at + 1, equal - at - 1)), entity).second;
      assert(is_new);
      at = stop + 2;
    }
    assert(text.compare(at, end.size(), end) == 0);
    for(const auto& e : entities)
      for(long r : e.second.references)
        assert(entities.count(r)); // references resolve
  }

  std::vector<long> of_type(const std::string& type) const
  {
    std::vector<long> result;
    for(const auto& e : entities)
      if(e.second.type == type)
        result.push_back(e.first);
    return result;
  }

  // the numbers in the last pair of parentheses but `skip` others
  static std::vector<double> numbers(const std::string& arguments, int skip)
  {
    std::size_t open = arguments.size();
    for(int i = 0; i <= skip; ++i)
      open = arguments.rfind('(', open - 1);
    std::vector<double> result;
    std::istringstream is(arguments.substr(open + 1, arguments.find(')', open) - open - 1));
    for(std::string word; std::getline(is, word, ','); )
    {
      assert(word.find('.') != std::string::npos && word.find('e') == std::string::npos);
      result.push_back(std::stod(word));
    }
    return result;
  }
};

Shell sphere_shell(int m, double tolerance)
{
  std::vector<Eigen::Vector3d> points;
  for(int k = 0; k < 8; ++k)
    points.emplace_back((k & 1) ? 10 : -10, (k & 2) ? 10 : -10, (k & 4) ? 10 : -10);
  const Catmull_clark_surface surface(
    points, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}},
    m + 3);
  const auto limit_points = surface.limit_points();
  const int n = 1 << (m + 3);
  auto position = [&](std::size_t patch, double u, double v) -> Eigen::Vector3d
  { return limit_points.at({{int(patch), int(std::lround(u * n)), int(std::lround(v * n))}}); };
  Shell shell;
  SMSC::internal::extract_shell<K>(surface.cells(m), surface.neighbors(), position,
                                   {SMSC::internal::Merging::BEST, m, tolerance, {}}, shell);
  return shell;
}

void test_round_trip(const Shell& shell)
{
  std::ostringstream os, again;
  bool written = CGAL::IO::write_STEP(os, shell) && CGAL::IO::write_STEP(again, shell);
  assert(written && os.str() == again.str()); // deterministic
  const STEP_file file(os.str());
  assert(file.of_type("VERTEX_POINT").size() == shell.number_of_vertices());
  assert(file.of_type("EDGE_CURVE").size() == shell.number_of_edges());
  assert(file.of_type("ADVANCED_FACE").size() == shell.number_of_faces());
  assert(file.of_type("CLOSED_SHELL").size() == 1);
  assert(file.of_type("MANIFOLD_SOLID_BREP").size() == 1);

  // every edge twice, in opposite directions, and loops that hang together
  std::map<long, std::array<int, 2> > uses;
  for(long l : file.of_type("EDGE_LOOP"))
  {
    std::vector<std::array<long, 2> > ends;
    for(long o : file.entities.at(l).references)
    {
      const Entity& oriented = file.entities.at(o);
      const bool is_forward = oriented.arguments.find(".T.") != std::string::npos;
      const long e = oriented.references[0];
      ++uses[e][is_forward];
      const auto& r = file.entities.at(e).references;
      ends.push_back({{r[is_forward ? 0 : 1], r[is_forward ? 1 : 0]}});
    }
    for(std::size_t i = 0; i < ends.size(); ++i)
      assert(ends[i][1] == ends[(i + 1) % ends.size()][0]);
  }
  assert(uses.size() == shell.number_of_edges());
  for(const auto& use : uses)
    assert(use.second[0] == 1 && use.second[1] == 1);

  // control points of curves and surfaces are the same numbers
  const std::vector<long> curves = file.of_type("B_SPLINE_CURVE_WITH_KNOTS");
  for(std::size_t e = 0; e < curves.size(); ++e)
  {
    const auto& curve = shell.edge(e).curve;
    const Entity& entity = file.entities.at(curves[e]);
    assert(entity.references.size() == curve.control_points.size());
    for(std::size_t i = 0; i < entity.references.size(); ++i)
    {
      const auto x = STEP_file::numbers(file.entities.at(entity.references[i]).arguments, 0);
      assert(K::Point_3(x[0], x[1], x[2]) == curve.control_points[i]);
    }
    assert(STEP_file::numbers(entity.arguments, 0) == curve.knots.knots());
  }
  const std::vector<long> surfaces = file.of_type("B_SPLINE_SURFACE_WITH_KNOTS");
  for(std::size_t f = 0; f < surfaces.size(); ++f)
  {
    const auto& surface = shell.face(f).surface;
    const Entity& entity = file.entities.at(surfaces[f]);
    const std::size_t nu = surface.knots[0].number_of_functions();
    const std::size_t nv = surface.knots[1].number_of_functions();
    assert(entity.references.size() == nu * nv);
    for(std::size_t i = 0; i < nu; ++i)
      for(std::size_t j = 0; j < nv; ++j)
      {
        const auto x
          = STEP_file::numbers(file.entities.at(entity.references[i * nv + j]).arguments, 0);
        assert(K::Point_3(x[0], x[1], x[2]) == surface.control_point(i, j));
      }
    assert(STEP_file::numbers(entity.arguments, 1) == surface.knots[0].knots());
    assert(STEP_file::numbers(entity.arguments, 0) == surface.knots[1].knots());
  }
}

// vertices lend their points to edges, and edges theirs to the sectors of caps: all but the 16 inside
void test_number_of_points(const Shell& shell)
{
  std::ostringstream os;
  CGAL::IO::write_STEP(os, shell);
  std::size_t expected = shell.number_of_vertices() + 1; // and the origin
  for(std::size_t e = 0; e < shell.number_of_edges(); ++e)
    expected += shell.edge(e).curve.control_points.size() - 2;
  std::size_t sectors = 0;
  for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
  {
    expected += shell.face(f).surface.control_points.size();
    sectors += shell.face(f).is_extraordinary;
  }
  assert(sectors == 24);
  const std::size_t points_on_sides = 20;
  assert(STEP_file(os.str()).of_type("CARTESIAN_POINT").size()
         == expected - points_on_sides * sectors);
}

// one bilinear face, as a shell of its own
void add_square(Shell& shell, double x, double y, double z)
{
  const SMSC::Knot_vector<double> knots(1, {0, 1});
  const std::array<K::Point_3, 4> p
    = {{{x, y, z}, {x + 1, y, z}, {x + 1, y + 1, z}, {x, y + 1, z}}};
  std::array<std::size_t, 4> v;
  for(int i = 0; i < 4; ++i)
    v[i] = shell.add_vertex(p[i]);
  Shell::Face face;
  face.surface.knots = {{knots, knots}};
  face.surface.control_points = {p[0], p[1], p[3], p[2]};
  face.patch = 0;
  face.is_extraordinary = false;
  for(int i = 0; i < 4; ++i)
    face.loop.push_back(
      {shell.add_edge({v[i], v[(i + 1) % 4], {knots, {p[i], p[(i + 1) % 4]}}}), true});
  shell.add_face(face);
}

void test_components_and_header()
{
  Shell shell = sphere_shell(3, 1);
  add_square(shell, 1e-300, -0., 123456789.123456789);
  add_square(shell, 1e22, 1. / 3, -1e-7);
  SMSC::STEP_information information;
  information.product = "it's a \\ part";
  information.unit = "in";
  std::ostringstream os;
  bool written = CGAL::IO::write_STEP(os, shell, information);
  assert(written);
  const STEP_file file(os.str());
  assert(file.of_type("CLOSED_SHELL").size() == 1 && file.of_type("OPEN_SHELL").size() == 2);
  assert(file.of_type("SHELL_BASED_SURFACE_MODEL").size() == 2);
  assert(os.str().find("PRODUCT('it''s a \\\\ part'") != std::string::npos);
  assert(os.str().find("CONVERSION_BASED_UNIT('INCH'") != std::string::npos);
  assert(os.str().find("1970-01-01T00:00:00") != std::string::npos);
  for(long p : file.of_type("CARTESIAN_POINT"))
    assert(STEP_file::numbers(file.entities.at(p).arguments, 0).size() == 3);
  for(double bad : {0., -1., std::nan(""), std::numeric_limits<double>::infinity()})
  {
    information.uncertainty = bad;
    written = CGAL::IO::write_STEP(os, shell, information);
    assert(!written);
  }
  information = SMSC::STEP_information();
  information.unit = "furlong";
  written = CGAL::IO::write_STEP(os, shell, information);
  assert(!written);
}

// the points of the cells are the Bezier points of the faces, corners first
void test_vtu(const Shell& shell)
{
  std::ostringstream os;
  bool written = CGAL::IO::write_VTU(os, shell);
  assert(written);
  std::istringstream is(os.str());
  std::string line;
  while(std::getline(is, line) && line.find("Name=\"Points\"") == std::string::npos) {}
  for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
  {
    const auto& surface = shell.face(f).surface;
    const auto &ku = surface.knots[0].knots(), &kv = surface.knots[1].knots();
    for(std::size_t j = 0; j + 1 < kv.size(); ++j)
      for(std::size_t i = 0; i + 1 < ku.size(); ++i)
      {
        const int n = (surface.knots[0].degree() + 1) * (surface.knots[1].degree() + 1);
        for(int k = 0; k < n; ++k)
        {
          double x, y, z;
          is >> x >> y >> z;
          if(k >= 4)
            continue;
          const K::Point_3 p = surface.point(ku[i + (k == 1 || k == 2)], kv[j + (k >= 2)]);
          assert(CGAL::squared_distance(p, K::Point_3(x, y, z)) < 1e-20);
        }
      }
  }
  is >> line;
  assert(line == "</DataArray>");
}

int main()
{
  for(double tolerance : {1., 1e-3})
  {
    const Shell shell = sphere_shell(4, tolerance);
    test_round_trip(shell);
    test_number_of_points(shell);
    test_vtu(shell);
  }
  test_components_and_header();
  return 0;
}
