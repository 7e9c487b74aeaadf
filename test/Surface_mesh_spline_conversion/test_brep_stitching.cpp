// Stitching with a B-Rep: a dome in a window of a box, whose volume is known, and a disk on a
// cylinder, whose boundary is only near the circle and has other vertices.
#include "brep_models.h"
#include "shell_checks.h"

#include <CGAL/Surface_mesh_spline_conversion/IO/BRep.h>
#include <CGAL/Surface_mesh_spline_conversion/stitch_with_BRep.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>

namespace SMSC = CGAL::Surface_mesh_spline_conversion;

void check_solid(const SMSC::Stitching_report& report, std::size_t faces)
{
  assert(report.method == "shared edges" && report.unmatched_edges == 0);
  assert(report.solids == 1 && report.shells == 1 && report.faces == faces);
  assert(report.free_edges == 0 && report.multiple_edges == 0 && report.is_valid);
}

// reads back what is written; a STEP file keeps no tolerances, the reader measures them
void check_files(const TopoDS_Shape& shape, const SMSC::Stitching_report& report)
{
  for(const std::string filename : {"test_brep_stitching.step", "test_brep_stitching.brep"})
  {
    TopoDS_Shape copy;
    std::string message;
    assert(CGAL::IO::write_BRep(filename, shape));
    assert(CGAL::IO::read_BRep(filename, copy, message));
    std::ifstream file(filename);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const bool is_step = (filename == "test_brep_stitching.step");
    assert((text.find("1970-01-01T00:00:00") != std::string::npos) == is_step);
    std::remove(filename.c_str());
    const SMSC::Stitching_report again = SMSC::measure_BRep(copy);
    assert(again.solids == report.solids && again.shells == report.shells);
    assert(again.edges == report.edges && again.vertices == report.vertices);
    assert(again.faces == report.faces && again.free_edges == 0 && again.is_valid);
    assert(std::abs(again.volume - report.volume) <= 1e-9 * report.volume);
    // the curves in the parameter planes are kept, too
    assert(again.edge_deviation <= report.edge_deviation * (1 + 1e-6) + 1e-10);
    assert(again.edge_tolerance <= report.edge_tolerance * (1 + 1e-9));
    assert(again.vertex_tolerance <= report.vertex_tolerance * (1 + 1e-9));
  }
}

// The unit of a STEP file changes neither the model nor the files that are written after it.
void test_units()
{
  const char* filename = "test_brep_stitching_units.step";
  const double volume = SMSC::measure_BRep(BRepPrimAPI_MakeBox(10, 20, 30).Shape()).volume;
  for(const std::string unit : {"in", "mm", "m", "um", "cm", "mm"})
  {
    TopoDS_Shape copy;
    std::string message;
    assert(CGAL::IO::write_BRep(filename, BRepPrimAPI_MakeBox(10, 20, 30).Shape(), unit));
    assert(CGAL::IO::read_BRep(filename, copy, message));
    assert(std::abs(SMSC::measure_BRep(copy).volume - volume) < 1e-9 * volume);
  }
  assert(!CGAL::IO::write_BRep(filename, BRepPrimAPI_MakeBox(10, 20, 30).Shape(), "furlong"));
  std::remove(filename);
}

// A gap in the plane of the neighbouring face leaves no trace in the tolerances of edges.
void test_window(std::size_t m, std::size_t n)
{
  const double height = 6, gap = 1e-3;
  const Shell shell = window_dome(m, n, height, gap);
  const Shell_checks<K> checks(shell);
  assert(checks.largest_gap < 1e-12);
  TopoDS_Shape solid;
  SMSC::Stitching_report report;
  assert(SMSC::stitch_with_BRep(shell, box_with_window(), 2 * gap, solid, report));
  check_solid(report, 6 + m * n);
  std::cout << m << " x " << n << ": distance " << report.edge_distance << ", deviation "
            << report.edge_deviation << ", tolerances " << report.edge_tolerance << ' '
            << report.vertex_tolerance << ", volume error "
            << report.volume - window_volume(height, gap) << std::endl;
  assert(report.edge_distance > 0.9 * gap && report.edge_distance < gap);
  assert(report.edge_deviation < 1e-12);
  assert(report.edge_tolerance == 1e-7 && report.vertex_tolerance == 1e-7);
  assert(std::abs(report.volume - window_volume(height, gap)) < 1e-9 * report.volume);
  check_files(solid, report);
}

// What is farther apart than the tolerance stays open, and this is told.
void test_too_far()
{
  const double gap = 1e-2;
  TopoDS_Shape result;
  SMSC::Stitching_report report;
  assert(!SMSC::stitch_with_BRep(window_dome(1, 1, 6, gap), box_with_window(), gap / 10, result,
                                 report));
  assert(report.unmatched_edges == 4 && report.free_edges > 0 && report.solids == 0);
}

template <typename Function>
Shell transformed(const Shell& shell, const Function& function)
{
  Shell result;
  for(std::size_t v = 0; v < shell.number_of_vertices(); ++v)
    result.add_vertex(function(shell.point(v)));
  for(std::size_t e = 0; e < shell.number_of_edges(); ++e)
  {
    Shell::Edge edge = shell.edge(e);
    for(Point_3& p : edge.curve.control_points)
      p = function(p);
    result.add_edge(edge);
  }
  for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
  {
    Shell::Face face = shell.face(f);
    for(Point_3& p : face.surface.control_points)
      p = function(p);
    result.add_face(face);
  }
  return result;
}

// The shell has vertices at 45, 135, ... degrees, the cylinder at 0; the shell is in meters.
void test_disk()
{
  const double gap = 20 * 2.73e-4;
  const Shell shell = transformed(disk(5), [](const Point_3& p)
    { return CGAL::ORIGIN + (p - CGAL::ORIGIN) / 1000; });
  TopoDS_Shape solid;
  SMSC::Stitching_report report;
  assert(SMSC::stitch_with_BRep(shell, open_cylinder(), 2 * gap, solid, report, 1000));
  std::cout << "disk: distance " << report.edge_distance << ", deviation " << report.edge_deviation
            << ", tolerances " << report.edge_tolerance << ' ' << report.vertex_tolerance
            << ", volume " << report.volume << std::endl;
  check_solid(report, 3);
  // the gap is normal to the cylinder: all of it remains, and nothing more
  assert(report.edge_distance > 0.9 * gap && report.edge_distance < 1.01 * gap);
  assert(report.edge_deviation > 0.9 * gap && report.edge_deviation < 1.01 * gap);
  assert(report.edge_tolerance <= 1.06 * gap && report.vertex_tolerance <= 1.06 * gap);
  assert(report.volume > CGAL_PI * 20 * 20 * 30);
  check_files(solid, report);
}

// Edges that deviate more from the cylinder than the others, and change this from span to span.
void test_wavy_disk()
{
  const double wave = 1e-3;
  TopoDS_Shape solid;
  SMSC::Stitching_report report;
  assert(SMSC::stitch_with_BRep(wavy_disk(5, wave), open_cylinder(), 2 * wave, solid, report));
  check_solid(report, 3);
  assert(report.edge_deviation > wave / 2 && report.edge_deviation < wave);
  check_files(solid, report);
}

// The seam of the cylinder divides an edge that is not parallel to the circle there, and runs around
// the cylinder against it.
void test_seam()
{
  const double wave = 1e-3;
  for(double angle = -0.6; angle < 0.7; angle += 0.2)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    const Shell shell = transformed(wavy_disk(5, wave), [c, s](const Point_3& p)
      { return Point_3(s * p.x() - c * p.y(), -c * p.x() - s * p.y(), p.z()); });
    TopoDS_Shape solid;
    SMSC::Stitching_report report;
    assert(SMSC::stitch_with_BRep(shell, open_cylinder(), 2 * wave, solid, report));
    check_solid(report, 3);
    assert(report.edge_deviation < wave);
  }
}

// A shell that looks inwards becomes a solid with positive volume, too.
void test_orientation()
{
  const Shell shell = window_dome(1, 1, 6, 0);
  TopoDS_Shape solid;
  SMSC::Stitching_report report;
  assert(SMSC::stitch_with_BRep(shell, box_with_window().Reversed(), 1e-6, solid, report));
  check_solid(report, 7);
  assert(std::abs(report.volume - window_volume(6, 0)) < 1e-9 * report.volume);
}

int main()
{
  std::cout.precision(3);
  test_window(1, 1);
  test_window(3, 2);
  test_too_far();
  test_disk();
  test_wavy_disk();
  test_seam();
  test_orientation();
  test_units();
  return 0;
}
