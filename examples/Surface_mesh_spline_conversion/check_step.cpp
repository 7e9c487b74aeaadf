// Checks a STEP file as the user of a CAD system would: free edges, gaps, tolerances, volume, and
// whether usual operations work. It needs Open CASCADE.
// usage: check_step [FILE.step] [--operations] [--twin EXACT.step] [--size MM] [--gmsh]

#include <CGAL/Surface_mesh_spline_conversion/IO/BRep.h>
#include <CGAL/Surface_mesh_spline_conversion/measure_BRep.h>
#include <CGAL/Surface_mesh_spline_conversion/try_BRep_operation.h>

#include <CGAL/config.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "check_step/gmsh.h"

namespace SC = CGAL::Surface_mesh_spline_conversion;

struct Options
{
  std::string file = CGAL::data_file_path("cases/d2_square_corner/residual.step");
  std::string twin;
  double size = 0; // of offset, wall, fillet, and chamfer, in mm; 0 for the default
  bool do_operate = false, do_mesh = false;
};

bool parse(int argc, char* argv[], Options& options)
{
  for(int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    if(argument == "--operations")
      options.do_operate = true;
    else if(argument == "--gmsh")
      options.do_mesh = true;
    else if(argument == "--twin" && i + 1 < argc)
      options.twin = argv[++i];
    else if(argument == "--size" && i + 1 < argc)
      options.size = std::atof(argv[++i]);
    else if(argument[0] != '-')
      options.file = argument;
    else
      return false;
  }
  return true;
}

void print_measures(const TopoDS_Shape& shape)
{
  const SC::Stitching_report r = SC::measure_BRep(shape);
  const SC::BRep_gaps gaps = SC::measure_BRep_gaps(shape);
  std::printf("solids, shells, faces       %zu %zu %zu\n", r.solids, r.shells, r.faces);
  std::printf("edges, vertices             %zu %zu\n", r.edges, r.vertices);
  std::printf("free edges, multiple edges  %zu %zu\n", r.free_edges, r.multiple_edges);
  std::printf("valid for Open CASCADE      %s\n", r.is_valid ? "yes" : "no");
  std::printf("tolerance of edges          %.3g mm\n", r.edge_tolerance);
  std::printf("tolerance of vertices       %.3g mm\n", r.vertex_tolerance);
  std::printf("deviation of edges          %.3g mm\n", r.edge_deviation);
  std::printf("gap between faces, normal   %.3g mm\n", gaps.normal);
  std::printf("gap between faces, tangent  %.3g mm\n", gaps.tangential);
  std::printf("angle between spline faces  %.3g degrees\n", gaps.angle);
  std::printf("volume                      %.12g mm^3\n", r.volume);
}

// Returns whether all operations work that also work on the exact twin, with volumes that agree.
bool print_operations(const TopoDS_Shape& shape, const TopoDS_Shape& twin, double size)
{
  const char* names[] = {"offset", "thicken", "fillet", "chamfer", "cut"};
  bool is_good = true;
  for(int i = 0; i < 5; ++i)
  {
    const SC::BRep_operation operation = static_cast<SC::BRep_operation>(i);
    const SC::BRep_operation_result r = SC::try_BRep_operation(shape, operation, size);
    std::printf("%-27s %s, volume %.9g mm^3", names[i], r.status.c_str(), r.volume);
    if(!twin.IsNull())
    {
      const SC::BRep_operation_result t = SC::try_BRep_operation(twin, operation, size);
      std::printf("; exact twin %s, volume %.9g mm^3", t.status.c_str(), t.volume);
      const bool is_same = r.is_ok() && std::abs(r.volume - t.volume) < 1e-3 * t.volume;
      is_good = is_good && (is_same || !t.is_ok());
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  return is_good;
}

int main(int argc, char* argv[])
{
  Options options;
  TopoDS_Shape shape, twin;
  std::string message = "usage: check_step [FILE.step] [--operations] [--twin EXACT.step] "
                        "[--size MM] [--gmsh]";
  if(!parse(argc, argv, options) || !CGAL::IO::read_BRep(options.file, shape, message)
     || (!options.twin.empty() && !CGAL::IO::read_BRep(options.twin, twin, message)))
  {
    std::fprintf(stderr, "check_step: %s\n", message.c_str());
    return EXIT_FAILURE;
  }
  print_measures(shape);
  bool is_good = true;
  if(options.do_operate)
    is_good = print_operations(shape, twin, options.size);
  if(options.do_mesh)
  {
    const bool is_solid = SC::measure_BRep(shape).solids > 0;
    const std::size_t n = mesh_with_gmsh(
      options.file, is_solid ? Gmsh_element::TETRAHEDRON : Gmsh_element::TRIANGLE, 600);
    std::printf("%s of gmsh          %zu\n", is_solid ? "tetrahedra" : "triangles ", n);
    is_good = is_good && n > 0;
  }
  return is_good ? EXIT_SUCCESS : EXIT_FAILURE;
}
