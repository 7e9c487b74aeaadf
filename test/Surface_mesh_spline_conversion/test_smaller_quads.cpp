// Where quads of the wanted size are too large for the corner below them, and the surface would be
// folded over, larger weights at the fold are tried, then smaller quads; the report tells the latter.
// Others keep their size.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/convert_to_T_NURCC.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_NURBS_faces.h>
#include <CGAL/Surface_mesh_spline_conversion/interpolate_boundary_curves.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Normal_net.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;
namespace params = CGAL::parameters;
typedef CGAL::Simple_cartesian<double> K;
typedef CGAL::Surface_mesh<K::Point_3> Mesh;
typedef SC::NURBS_curve_traits_3<K> Traits;
typedef CGAL::T_NURCC_surface_3<K> Surface;

namespace {

// a bent square without a wedge of the given angle, whose tip is at the origin
Mesh wedged_square(double wedge)
{
  constexpr int rings = 8, columns = 24;
  Mesh mesh;
  auto add = [&mesh](double x, double y)
  { return mesh.add_vertex(K::Point_3(x, y, 0.25 * std::sin(2 * x) * std::cos(1.5 * y))); };
  std::vector<Mesh::Vertex_index> inner(columns + 1, add(0, 0));
  for(int i = 1; i <= rings; ++i)
  {
    std::vector<Mesh::Vertex_index> outer;
    for(int k = 0; k <= columns; ++k)
    {
      const double angle = wedge / 2 + (2 * CGAL_PI - wedge) * k / columns;
      const double x = std::cos(angle), y = std::sin(angle);
      const double radius = double(i) / rings / (std::max)(std::abs(x), std::abs(y));
      outer.push_back(add(radius * x, radius * y));
    }
    for(int k = 0; k < columns; ++k)
    {
      mesh.add_face(inner[k], outer[k], outer[k + 1]);
      if(i > 1)
        mesh.add_face(inner[k], outer[k + 1], inner[k + 1]);
    }
    inner = outer;
  }
  return mesh;
}

// `wedge`: its angle in degrees. Does the report tell that the quads were made smaller?
bool convert(double wedge, double relative_size, Surface& surface)
{
  Mesh mesh = wedged_square(wedge * CGAL_PI / 180);
  auto curves
    = mesh.add_property_map<Mesh::Halfedge_index, SC::Curve_segment<Traits> >("h:curve").first;
  std::string message;
  assert(SC::interpolate_boundary_curves(mesh, Traits(), curves, message) == SC::Error_code::OK);
  const double diameter = SC::smallest_enclosing_sphere_diameter(mesh);
  std::vector<Surface> surfaces;
  SC::Conversion_report report;
  assert(SC::convert_to_T_NURCC(mesh, curves, Traits(), surfaces, report,
                                params::boundary_tolerance(1e-5 * diameter)
                                  .interior_tolerance(1e-3 * diameter)
                                  .quad_size_map(relative_size * diameter)) == SC::Error_code::OK);
  assert(surfaces.size() == 1);
  assert(report.counts.patches == surfaces[0].number_of_patches());
  surface = surfaces[0];
  return std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& warning)
    { return warning.find("they were made smaller") != std::string::npos; });
}

bool is_folded(const Surface& surface)
{
  SC::NURBS_shell_3<K> shell;
  SC::extract_NURBS_faces(surface, shell);
  return !SC::internal::folds_of_pieces(SC::internal::bezier_pieces(shell)).empty();
}

} // namespace

int main()
{
  Surface surface;
  for(const double size : {0.15, 0.25, 0.3}) // larger weights are enough at 0.3
  {
    assert(!convert(35, size, surface));
    assert(!is_folded(surface));
  }
  assert(convert(25, 0.45, surface));
  assert(!is_folded(surface));
  return 0;
}
