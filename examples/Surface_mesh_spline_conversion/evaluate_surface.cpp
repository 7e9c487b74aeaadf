// Converts a closed mesh, a torus, and evaluates the surface: points, derivatives, and normals.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/convert_to_T_NURCC.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef CGAL::Surface_mesh<K::Point_3> Mesh;
typedef CGAL::T_NURCC_surface_3<K> Surface;

Mesh make_torus(std::size_t n, std::size_t m)
{
  const double step_n = 2 * CGAL_PI / n, step_m = 2 * CGAL_PI / m;
  Mesh mesh;
  for(std::size_t i = 0; i < n; ++i)
    for(std::size_t j = 0; j < m; ++j)
    {
      const double r = 3 + std::cos(j * step_m);
      mesh.add_vertex(K::Point_3(r * std::cos(i * step_n), r * std::sin(i * step_n),
                                 std::sin(j * step_m)));
    }
  const auto vertex = [n, m](std::size_t i, std::size_t j)
  { return Mesh::Vertex_index((i % n) * m + j % m); };
  for(std::size_t i = 0; i < n; ++i)
    for(std::size_t j = 0; j < m; ++j)
    {
      mesh.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      mesh.add_face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  return mesh;
}

int main()
{
  const Mesh mesh = make_torus(48, 16);
  std::vector<Surface> surfaces;
  SC::Conversion_report report;
  const SC::Error_code code = SC::convert_to_T_NURCC(
    mesh, surfaces, report, CGAL::parameters::interior_tolerance(0.1).quad_size_map(0.8));
  if(code != SC::Error_code::OK)
  {
    std::cerr << report.message << std::endl;
    return EXIT_FAILURE;
  }
  const Surface& surface = surfaces.front();
  std::cout << surface.number_of_patches() << " patches, " << surface.number_of_control_points()
            << " control points\n";
  for(std::size_t patch = 0; patch < surface.number_of_patches();
      patch += 1 + surface.number_of_patches() / 5)
  {
    // the parameters are those of the quad of the layout to which the patch belongs
    const auto origin = surface.patch_origin(patch);
    const double u = (origin.u0 + origin.u1) / 2, v = (origin.v0 + origin.v1) / 2;
    std::cout << "patch " << patch << ": point " << surface.position(patch, u, v) << ", d/du "
              << surface.derivative(patch, u, v, 1, 0) << ", normal "
              << surface.normal(patch, u, v) << '\n';
  }
  return EXIT_SUCCESS;
}
