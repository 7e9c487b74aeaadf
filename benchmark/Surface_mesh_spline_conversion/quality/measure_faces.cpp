// Measures the faces of converted cases: their number beside that of the rectangles between
// separatrices, their shape, and the size of the STEP file beside that of one with a face for each
// Bezier element.
// usage: measure_faces CASE...

#include "../../../test/Surface_mesh_spline_conversion/separatrix_rectangles.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/STEP.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/convert_to_T_NURCC.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_NURBS_faces.h>
#include <CGAL/Surface_mesh_spline_conversion/find_boundary_vertices.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef SC::Conversion_case<K> Case;
typedef SC::Boundary_curve_network_3<Case::Triangle_mesh, Case::Curve_traits> Network;
typedef CGAL::T_NURCC_surface_3<K> Surface;
typedef SC::NURBS_shell_3<K> Shell;
typedef std::pair<std::size_t, int> Side; // a quad of the layout and its side

// a point of a side of a quad, at `t` counter clockwise
K::Point_3 point_on_side(const Surface& surface, const Side& side, double t)
{
  const std::array<std::array<double, 2>, 4> p = {{{{t, 0}}, {{1, t}}, {{1 - t, 1}}, {{0, 1 - t}}}};
  const auto& q = p[side.second & 3];
  return surface.position(surface.patch_at(side.first, q[0], q[1]), q[0], q[1]);
}

// by how much the boundary turns from one side to the next, in radians
double turning_angle(const Surface& surface, const Side& before, const Side& after)
{
  const double step = 1e-5;
  const K::Vector_3 u = point_on_side(surface, before, 1) - point_on_side(surface, before, 1 - step);
  const K::Vector_3 v = point_on_side(surface, after, step) - point_on_side(surface, after, 0);
  return std::atan2(std::sqrt(CGAL::cross_product(u, v).squared_length()), u * v);
}

// the rectangles of the coarsest T-mesh of separatrices from extraordinary points and from corners
// between two quads
std::size_t number_of_rectangles(const Surface& surface)
{
  const double corner_angle = 0.5;
  const auto neighbors = SC::internal::quad_neighbors(surface);
  const std::size_t none = SC::internal::NO_INDEX;
  std::vector<Side> corners;
  for(std::size_t q = 0; q < neighbors.size(); ++q)
    for(int i = 0; i < 4; ++i)
    {
      const Side before(q, (i + 3) & 3), across = neighbors[q][i];
      if(across.first == none || neighbors[q][before.second].first != none)
        continue;
      const Side after(across.first, (across.second + 1) & 3);
      if(neighbors[after.first][after.second].first == none
         && turning_angle(surface, before, after) > corner_angle)
        corners.push_back(Side(q, i));
    }
  return Separatrix_rectangles({neighbors.begin(), neighbors.end()}, none, corners)
    .number_of_rectangles();
}

// the lengths of the lines in the middle of a face
std::array<double, 2> extents(const SC::B_spline_surface_3<K>& s)
{
  constexpr int samples = 32;
  std::array<double, 2> low, size, result = {{0, 0}};
  for(int axis = 0; axis < 2; ++axis)
  {
    low[axis] = s.knots[axis].knots().front();
    size[axis] = s.knots[axis].knots().back() - low[axis];
  }
  for(int axis = 0; axis < 2; ++axis)
    for(int i = 0; i < samples; ++i)
    {
      std::array<K::Point_3, 2> p;
      for(int k = 0; k < 2; ++k)
      {
        std::array<double, 2> t = {{0.5, 0.5}};
        t[axis] = (i + k) / double(samples);
        p[k] = s.point(low[0] + t[0] * size[0], low[1] + t[1] * size[1]);
      }
      result[axis] += std::sqrt(CGAL::squared_distance(p[0], p[1]));
    }
  return result;
}

struct Faces
{
  std::size_t number = 0, sectors = 0, bytes = 0;
  double smallest_width = (std::numeric_limits<double>::max)();
  double largest_aspect = 0; // length by width
};

Faces measure_faces(const Surface& surface, const std::vector<SC::Boundary_vertex<double> >& vertices,
                    double delta, bool do_merge)
{
  Shell shell;
  SC::extract_NURBS_faces(surface, shell,
                          CGAL::parameters::interior_tolerance(delta).do_merge_patches(do_merge)
                            .boundary_vertices(vertices));
  Faces result;
  result.number = shell.number_of_faces();
  for(std::size_t f = 0; f < shell.number_of_faces(); ++f)
  {
    result.sectors += shell.face(f).is_extraordinary;
    const auto size = extents(shell.face(f).surface);
    const double width = (std::min)(size[0], size[1]);
    result.smallest_width = (std::min)(result.smallest_width, width);
    result.largest_aspect = (std::max)(result.largest_aspect, (std::max)(size[0], size[1]) / width);
  }
  std::ostringstream os;
  CGAL::IO::write_STEP(os, shell);
  result.bytes = os.str().size();
  return result;
}

void add(const Faces& part, Faces& all)
{
  all.number += part.number;
  all.sectors += part.sectors;
  all.bytes += part.bytes;
  all.smallest_width = (std::min)(all.smallest_width, part.smallest_width);
  all.largest_aspect = (std::max)(all.largest_aspect, part.largest_aspect);
}

// Faces that are narrower than so many boundary tolerances, or so much longer than wide, are
// slivers: kernels have difficulties with them.
const double narrowest_face = 200, longest_face = 100;

// Returns whether the faces are few and wide enough; the size of the file is only printed.
bool measure_case(const std::string& path)
{
  const double relative_xi = 1e-6, relative_delta = 1e-3;
  Case input;
  std::string message;
  if(!CGAL::IO::read_case(path, input, message))
  {
    std::fprintf(stderr, "%s\n", message.c_str());
    return false;
  }
  const Network network(input.mesh, input.halfedge_curve_map(), input.traits,
                        CGAL::parameters::vertex_is_constrained_map(input.vertex_is_corner_map()));
  const double xi = relative_xi * network.diameter(), delta = relative_delta * network.diameter();
  std::vector<Surface> surfaces;
  SC::Conversion_report report;
  const SC::Error_code code = SC::convert_to_T_NURCC(
    input.mesh, input.halfedge_curve_map(), input.traits, surfaces, report,
    CGAL::parameters::boundary_tolerance(xi).interior_tolerance(delta)
      .vertex_is_constrained_map(input.vertex_is_corner_map()));
  std::size_t rectangles = 0;
  Faces merged, elements;
  for(const Surface& surface : surfaces)
  {
    const auto vertices = SC::find_boundary_vertices(surface, network, xi);
    rectangles += number_of_rectangles(surface);
    add(measure_faces(surface, vertices, delta, true), merged);
    add(measure_faces(surface, vertices, delta, false), elements);
  }
  const std::size_t faces_per_rectangle = 4;
  const std::size_t limit = faces_per_rectangle * rectangles + merged.sectors;
  std::printf("%s: %zu faces (%zu sectors of caps), limit %zu; narrowest %.0f xi, longest %.1f widths;"
              " %zu bytes, with a face for each element %zu (%.2f times)\n",
              path.c_str(), merged.number, merged.sectors, limit, merged.smallest_width / xi,
              merged.largest_aspect, merged.bytes, elements.bytes,
              double(elements.bytes) / double(merged.bytes));
  std::fflush(stdout);
  return code == SC::Error_code::OK && merged.number <= limit
      && merged.smallest_width >= narrowest_face * xi && merged.largest_aspect <= longest_face;
}

int main(int argc, char* argv[])
{
  if(argc < 2)
  {
    std::fprintf(stderr, "usage: measure_faces CASE...\n");
    return EXIT_FAILURE;
  }
  bool is_good = true;
  for(int i = 1; i < argc; ++i)
    is_good = measure_case(argv[i]) && is_good;
  return is_good ? EXIT_SUCCESS : EXIT_FAILURE;
}
