// A surface that is refined by the rules of the paper.
#ifndef QUALITY_PAPER_SURFACE_H
#define QUALITY_PAPER_SURFACE_H

#include "Quadrisection_closure.h"
#include "surface_stages.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/surface/T_mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

class Paper_surface : public Surface
{
  typedef CGAL::Surface_mesh_spline_conversion::internal::T_mesh<Kernel::Point_3> T_mesh;
  typedef CGAL::Surface_mesh_spline_conversion::internal::Face_origin Face_origin;
  typedef Quadrisection_closure<Kernel::Point_3> Closure;

public:
  Paper_surface(const Layout& layout, Standardization standardization)
    : Surface(layout), m_layout(layout), m_standardization(standardization)
  {}

  void refine(const std::vector<std::size_t>& patches)
  {
    change_mesh([&, this](T_mesh& mesh, std::vector<std::int64_t>& units)
    {
      Closure closure(mesh, units, m_standardization);
      for(std::size_t patch : patches)
        closure.mark(face_of_patch(patch));
      closure.run();
    });
  }

  // quadrisects the patches, whatever the direction
  void refine(const std::vector<Patch_split>& splits)
  {
    std::vector<std::size_t> patches;
    for(const Patch_split& split : splits)
      patches.push_back(split.patch);
    refine(patches);
  }

  // bisects the faces of the 0-channel that overlap the spans
  void refine_boundary(const std::vector<Boundary_span>& spans)
  {
    change_mesh([&, this](T_mesh& mesh, std::vector<std::int64_t>& units)
    {
      using CGAL::Surface_mesh_spline_conversion::internal::to_parameter;
      const std::vector<Place> places = places_of_sides();
      Closure closure(mesh, units, m_standardization);
      for(auto f : mesh.mesh().faces())
      {
        const Face_origin& origin = mesh.origin(f);
        if(origin.kind != Face_origin::CHANNEL)
          continue;
        const Place& place = places[4 * origin.quad + std::size_t(origin.side)];
        const double x0 = place.x + to_parameter(origin.first[0]);
        const double x1 = place.x + to_parameter(origin.last[0]);
        for(const Boundary_span& span : spans)
          if(span.chain == place.chain && overlaps(span, x0, x1, place.number_of_sides))
            closure.mark(f);
      }
      closure.run();
    });
  }

private:
  // where a side of a quad begins on its chain
  struct Place
  {
    std::size_t chain;
    double x;
    double number_of_sides;
  };

  std::vector<Place> places_of_sides() const
  {
    std::vector<Place> result(4 * m_layout.number_of_quads());
    for(std::size_t c = 0; c < m_layout.number_of_chains(); ++c)
    {
      const auto sides = m_layout.chain_sides(c);
      for(std::size_t k = 0; k < sides.size(); ++k)
        result[4 * sides[k].first + std::size_t(sides[k].second)]
          = Place{c, double(k), double(sides.size())};
    }
    return result;
  }

  // spans of closed chains may begin before zero or end after the last side
  static bool overlaps(const Boundary_span& span, double x0, double x1, double period)
  {
    for(double shift : {-period, 0., period})
      if(x0 < x1 && span.x0 < x1 + shift && x0 + shift < span.x1)
        return true;
    return false;
  }

  const Layout& m_layout;
  Standardization m_standardization;
};

#endif // QUALITY_PAPER_SURFACE_H
