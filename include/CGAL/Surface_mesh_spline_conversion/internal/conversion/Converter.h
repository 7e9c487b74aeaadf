// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_CONVERTER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_CONVERTER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/Transfinite_patch_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/bound_interior_deviation.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_NURBS_faces.h>
#include <CGAL/Surface_mesh_spline_conversion/find_boundary_vertices.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_boundary.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/boundary_band.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/conversion/Mesh_component.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/conversion/conversion_options.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/conversion/facet_sagitta.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/conversion/large_corners.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/conversion/merge_reports.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Normal_net.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_fitter.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/format_number.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/run_stage.h>
#include <CGAL/Surface_mesh_spline_conversion/measure_deviation.h>

#include <CGAL/T_NURCC_surface_3.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Runs the stages of the conversion on one connected component after the other.
//
// SizeMap: property map from the vertices of the mesh to the wanted size of the quads.
// CrossFieldMap: property map from the faces of the mesh to the wanted direction of the quads.
template <typename TriangleMesh, typename VertexPointMap, typename BoundaryCurveTraits,
          typename SizeMap, typename CrossFieldMap, typename Surface, typename Visitor>
class Converter
{
  typedef typename boost::property_traits<VertexPointMap>::value_type Point_3;
  typedef typename Kernel_traits<Point_3>::Kernel Kernel;
  typedef typename Kernel::FT FT;
  typedef Boundary_curve_network_3<TriangleMesh, BoundaryCurveTraits> Network;
  typedef Component_splitter<TriangleMesh, VertexPointMap, BoundaryCurveTraits> Splitter;
  typedef typename Splitter::Component Component;
  typedef typename Component::Mesh Component_mesh;
  typedef Boundary_curve_network_3<Component_mesh, BoundaryCurveTraits> Component_network;
  typedef Transfinite_patch_network_3<Kernel, Component_mesh, BoundaryCurveTraits> Target;
  typedef typename boost::property_map<Component_mesh, vertex_point_t>::const_type
    Component_point_map;
  typedef Deviation_meter<Component_mesh, Component_point_map, Component_network> Meter;

public:
  Converter(const TriangleMesh& tm, const VertexPointMap& vpm, const Network& network,
            const SizeMap& size_map, const CrossFieldMap& cross_field_map,
            const Conversion_options& options,
            const Normal_function<BoundaryCurveTraits>& normals, Visitor& visitor,
            std::vector<Surface>& surfaces, Conversion_report& report)
    : m_tm(tm), m_vpm(vpm), m_network(network), m_size_map(size_map)
    , m_cross_field_map(cross_field_map), m_options(options), m_normals(normals)
    , m_visitor(visitor), m_surfaces(surfaces), m_report(report)
    , m_band(boundary_band_width(tm, vpm))
  {}

  // `curves`: the property map of the curve segments of the halfedges
  template <typename HalfedgeCurveMap>
  Error_code operator()(const HalfedgeCurveMap& curves)
  {
    const Splitter splitter(m_tm, m_vpm);
    describe_input(splitter.number_of_components());
    Error_code result = Error_code::OK;
    for(std::size_t i = 0; i < splitter.number_of_components(); ++i)
    {
      Component component;
      splitter.copy(i, curves, [&](auto v) { return m_network.is_corner(v); },
                    [&](auto v) { return CGAL::to_double(get(m_size_map, v)); },
                    [&](auto f) { return get(m_cross_field_map, f); }, component);
      Conversion_report part;
      const Error_code code = convert(component, part);
      merge_reports(part, m_report);
      if(code != Error_code::OK)
        result = code;
      if(code != Error_code::OK && code != Error_code::TOLERANCE_NOT_REACHED)
      {
        m_report.message = in_component(i, splitter.number_of_components(), part.message);
        break;
      }
    }
    return result;
  }

private:
  // The fit and the independent measurement have different samples, and the latter sees the faces
  // around extraordinary points and above corners as they leave for a CAD system. Where it finds
  // more than the tolerance, the surface is refined, and the fit goes on; so many times at most.
  static constexpr int maximum_number_of_improvements = 8;

  // Before each refinement, and against pieces that are folded over, larger weights are tried that
  // many times.
  static constexpr int maximum_number_of_closer_fits = 4;

  // Where the normals of neighbouring faces do not agree, or a face looks the other way than the mesh,
  // only the first times count: below the size of the faces of the mesh the normals have no meaning.
  static constexpr int maximum_number_of_smoothings = 4;

  // Where quads are too large for the shape and the corners below them, the map onto them is so
  // uneven that no surface follows it without folds, or closely enough. Quads of that share of their
  // size are tried then, again and again down to the smallest one.
  static constexpr double next_factor = 0.7, smallest_factor = 0.3;

  // Where they do not help, the surface is refined around the same places again and again. A further
  // attempt ends at that many patches per control point of the best one; there may be few patches
  // beside many control points of the boundary.
  static constexpr std::size_t patches_per_control_point = 4;

  void describe_input(std::size_t number_of_components)
  {
    Conversion_report::Input& input = m_report.input;
    input.vertices = num_vertices(m_tm);
    input.triangles = num_faces(m_tm);
    input.components = number_of_components;
    input.loops = m_network.number_of_loops();
    for(const auto v : vertices(m_tm))
      if(m_network.is_corner(v))
        ++input.corners;
    std::ptrdiff_t border_halfedges = 0;
    for(const auto h : halfedges(m_tm))
      if(is_border(h, m_tm))
        ++border_halfedges;
    const std::ptrdiff_t vertices = num_vertices(m_tm), faces = num_faces(m_tm);
    const std::ptrdiff_t euler_characteristic = vertices - (3 * faces + border_halfedges) / 2 + faces;
    input.genus = (2 * std::ptrdiff_t(number_of_components) - std::ptrdiff_t(input.loops)
                   - euler_characteristic) / 2;
    input.diameter = CGAL::to_double(m_network.diameter());
  }

  static std::string in_component(std::size_t i, std::size_t n, const std::string& message)
  {
    return n == 1 ? message
                  : "component " + std::to_string(i + 1) + " of " + std::to_string(n) + ": " + message;
  }

  template <typename Stage>
  Error_code run(const std::string& name, Conversion_report& part, const Stage& stage)
  {
    return run_stage(name, m_visitor, part, stage);
  }

  Error_code convert(Component& component, Conversion_report& part)
  {
    const Component_network network(component.mesh, component.segments, m_network.traits(),
                                    parameters::corner_angle(m_options.corner_angle)
                                      .association_tolerance(m_network.association_tolerance())
                                      .vertex_is_constrained_map(component.corners));
    if(network.error() != Error_code::OK)
    {
      part.message = network.message();
      return network.error();
    }
    part.input.facet_sagitta = facet_sagitta(component.mesh, get(vertex_point, component.mesh));
    warn_about_large_corners(component.mesh, get(vertex_point, component.mesh), network, part);
    Attempt best
      = make_attempt(component, network, part, m_options.maximum_number_of_patches);
    for(double factor = next_factor; best.is_flawed && factor >= smallest_factor;
        factor *= next_factor)
    {
      for(const auto v : vertices(component.mesh))
        component.sizes[v] *= next_factor;
      Attempt attempt = make_attempt(component, network, part, most_patches_after(best));
      if(attempt.code == Error_code::INTERRUPTED)
      {
        part = attempt.part;
        return attempt.code;
      }
      attempt.part.warnings.push_back("with quads of the wanted size the surface would be folded "
        "over, or miss a tolerance: they were made smaller by the factor " + format_number(factor));
      for(const Conversion_report::Stage& stage : best.part.stages)
        attempt.part.add_time(stage.name, stage.seconds);
      if(attempt.comes_before(best))
        best = std::move(attempt);
      else
        best.part.stages = attempt.part.stages;
    }
    part = best.part;
    if(best.surface)
      m_surfaces.push_back(std::move(*best.surface));
    return best.code;
  }

  // a layout and the surface on it
  struct Attempt
  {
    Error_code code = Error_code::OK;
    Conversion_report part;
    std::optional<Surface> surface;
    std::size_t folds = 0;  // pieces that are folded over, and faces that look against the mesh
    bool is_flawed = false; // may smaller quads help?

    bool comes_before(const Attempt& other) const
    {
      return std::make_tuple(!surface, code != Error_code::OK, folds)
             < std::make_tuple(!other.surface, other.code != Error_code::OK, other.folds);
    }
  };

  // of a further attempt
  std::size_t most_patches_after(const Attempt& best) const
  {
    const std::size_t most = m_options.maximum_number_of_patches;
    return best.surface
      ? (std::min)(most, patches_per_control_point * best.part.counts.control_points) : most;
  }

  // `part`: what is known before the layout
  Attempt make_attempt(const Component& component, const Component_network& network,
                       const Conversion_report& part, std::size_t most_patches)
  {
    Attempt result;
    result.part = part;
    Quad_layout<Kernel> layout;
    result.code
      = compute_quad_layout(component.mesh, network, layout, result.part,
                            parameters::quad_size_map(component.sizes)
                              .cross_field_map(component.directions)
                              .visitor(std::ref(m_visitor)));
    if(result.code == Error_code::OK)
      result.code = fit(component, network, layout, most_patches, result);
    return result;
  }

  // the surface stages; the surface is kept if a tolerance is missed.
  Error_code fit(const Component& component, const Component_network& network,
                 const Quad_layout<Kernel>& layout, std::size_t most_patches, Attempt& attempt)
  {
    Conversion_report& part = attempt.part;
    const Target target(layout, network, component.mesh,
                        parameters::use_smooth_target(m_options.use_smooth_target)
                          .boundary_band(m_band)
                          .interior_tolerance(m_options.interior_tolerance));
    if(target.has_smooth_target())
      part.interior.target_height = CGAL::to_double(target.smooth_target_height());
    Surface surface(layout);
    if(surface.error() != Error_code::OK)
    {
      part.message = surface.message();
      return surface.error();
    }
    surface.set_caps(m_options.use_caps);
    const auto np = parameters::boundary_tolerance(m_options.boundary_tolerance)
                      .interior_tolerance(m_options.interior_tolerance)
                      .error_metric(m_options.error_metric)
                      .maximum_number_of_patches(most_patches)
                      .visitor(std::ref(m_visitor));
    Error_code result = run("fit_boundary", part, [&]()
      { return fit_boundary(surface, target, part, np); });
    if(!is_surface(result))
      return result;
    Interior_fitter<Surface, Target, Visitor> fitter(
      surface, target, interior_fit_options(target, np), boundary_fit_options(target, np),
      boundary_normals(target, m_normals), m_visitor, part);
    Meter meter(component.mesh, get(vertex_point, component.mesh), network, m_band,
                m_options.interior_tolerance, largest_deviation(part));
    Error_code interior = fit_interior(fitter, surface, component, network, meter, attempt);
    if(is_surface(interior) && m_options.do_certify)
    {
      const Error_code certified = run("certify_interior", part, [&]()
        { return certify(surface, component, network, part); });
      interior = is_surface(certified) ? interior : certified;
    }
    if(!is_surface(interior))
      return interior;
    if(target.has_smooth_target())
      part.interior.target_deviation = fitter.largest_error();
    count(surface, part);
    warn_about_facets(m_options.interior_tolerance, part);
    attempt.surface = std::move(surface);
    return interior == Error_code::OK ? result : interior;
  }

  // fits, measures, and improves the fit where the measurement asks for it.
  template <typename Fitter>
  Error_code fit_interior(Fitter& fitter, const Surface& surface, const Component& component,
                          const Component_network& network, Meter& meter, Attempt& attempt)
  {
    Conversion_report& part = attempt.part;
    const std::string message = part.message;
    Error_code code = run("fit_interior", part, [&]() { return fitter(); });
    if(code == Error_code::OK && m_options.do_coarsen)
      code = run("fit_interior", part, [&]() { return fitter.coarsen(); });
    int refinements = 0, closer_fits = 0;
    while(is_surface(code))
    {
      Deviation<Kernel> deviation;
      const Error_code measured = run("measure_deviation", part, [&]()
        { return measure(surface, network, meter, part, deviation); });
      if(!is_surface(measured))
        return measured;
      const bool has_folds = has_avoidable_folds(deviation, component, network);
      const std::vector<Point_3>& far = deviation.interior_violations;
      const std::vector<Point_3> rough = refinements < maximum_number_of_smoothings
                                           ? rough_places(deviation) : std::vector<Point_3>();
      if(code == Error_code::OK && rough.empty() && closer_fits < maximum_number_of_closer_fits
         && (has_folds || !far.empty()))
      {
        bool is_closer = false;
        const Error_code refitted = far.empty()
          ? straighten(fitter, surface, component, network, part, deviation.piece_folds, closer_fits,
                       is_closer)
          : move_closer(fitter, part, far, closer_fits, is_closer);
        if(refitted != Error_code::OK)
          return refitted;
        if(is_closer)
        {
          part.message = message;
          continue;
        }
      }
      if(code != Error_code::OK || refinements == maximum_number_of_improvements
         || (far.empty() && rough.empty()))
      {
        attempt.folds = deviation.piece_folds.size() + deviation.faces_against_mesh;
        attempt.is_flawed = has_folds || (code == Error_code::OK && measured != Error_code::OK);
        if(code == Error_code::OK && measured == Error_code::OK && m_options.do_fair)
          return make_fair(fitter, surface, network, meter, part, deviation);
        warn_about_normals(deviation, part);
        warn_about_folds(deviation, part);
        return code == Error_code::OK ? measured : code;
      }
      part.message = message;
      code = run("fit_interior", part, [&]() { return fitter.improve(far, rough); });
      ++refinements;
      closer_fits = 0;
    }
    return code;
  }

  // fits closer at places, and counts how often that was done; not again where it does not help.
  template <typename Fitter>
  Error_code move_closer(Fitter& fitter, Conversion_report& part, const std::vector<Point_3>& places,
                         int& closer_fits, bool& is_closer)
  {
    return run("fit_interior", part, [&]()
    {
      is_closer = fitter.move_closer(places);
      closer_fits = is_closer ? closer_fits + 1 : maximum_number_of_closer_fits;
      return Error_code::OK;
    });
  }

  // fits closer where the surface is folded, until it is not: to look for folds alone takes a small
  // part of the time of a measurement. `is_closer`: whether the surface has changed.
  template <typename Fitter>
  Error_code straighten(Fitter& fitter, const Surface& surface, const Component& component,
                        const Component_network& network, Conversion_report& part,
                        std::vector<Point_3> folds, int& closer_fits, bool& is_closer)
  {
    Error_code code = move_closer(fitter, part, folds, closer_fits, is_closer);
    while(code == Error_code::OK && closer_fits < maximum_number_of_closer_fits)
    {
      code = run("measure_deviation", part, [&]()
      {
        folds = folds_of_surface(surface, network);
        return Error_code::OK;
      });
      if(code != Error_code::OK || number_of_avoidable_folds(folds, component, network) == 0)
        break;
      bool is_closer_again = false;
      code = move_closer(fitter, part, folds, closer_fits, is_closer_again);
    }
    return code;
  }

  // returns a place in each polynomial piece of the surface that is folded over.
  std::vector<Point_3> folds_of_surface(const Surface& surface, const Component_network& network) const
  {
    std::vector<Bezier_piece> pieces;
    extract_shell(surface, network, &pieces);
    std::vector<Point_3> result;
    for(const Eigen::Vector3d& p : folds_of_pieces(pieces))
      result.emplace_back(p.x(), p.y(), p.z());
    return result;
  }

  static std::size_t number_of_avoidable_folds(const std::vector<Point_3>& folds,
                                               const Component& component,
                                               const Component_network& network)
  {
    return internal::number_of_avoidable_folds(component.mesh, get(vertex_point, component.mesh),
                                               network, component.sizes, folds);
  }

  static bool has_avoidable_folds(const Deviation<Kernel>& deviation, const Component& component,
                                  const Component_network& network)
  {
    return deviation.faces_against_mesh > 0
           || number_of_avoidable_folds(deviation.piece_folds, component, network) > 0;
  }

  // where the normals do not agree with one another, or with those of the mesh
  static std::vector<Point_3> rough_places(const Deviation<Kernel>& deviation)
  {
    std::vector<Point_3> result = deviation.normal_violations;
    result.insert(result.end(), deviation.folds.begin(), deviation.folds.end());
    return result;
  }

  // makes a surface that has met the tolerances fair, so that it still does; `deviation` is that of
  // the surface before.
  template <typename Fitter>
  Error_code make_fair(Fitter& fitter, const Surface& surface, const Component_network& network,
                       Meter& meter, Conversion_report& part, Deviation<Kernel>& deviation)
  {
    constexpr int maximum_number_of_attempts = 4;
    const Conversion_report before = part;
    const Deviation<Kernel> deviation_before = deviation;
    std::vector<Point_3> places;
    for(int attempt = 0; attempt < maximum_number_of_attempts; ++attempt)
    {
      const Error_code code
        = run("fair_interior", part, [&]() { return fitter.make_fair(places); });
      if(!is_surface(code))
        return code;
      const Error_code measured = run("measure_deviation", part, [&]()
        { return measure(surface, network, meter, part, deviation); });
      if(!is_surface(measured))
        return measured;
      places = rough_places(deviation);
      places.insert(places.end(), deviation.interior_violations.begin(),
                    deviation.interior_violations.end());
      if(places.empty() && measured == Error_code::OK)
        return code;
    }
    fitter.restore_fit();
    part = before;
    warn_about_normals(deviation_before, part);
    warn_about_folds(deviation_before, part);
    return Error_code::OK;
  }

  // measures the surface as it leaves for a CAD system, caps included.
  Error_code measure(const Surface& surface, const Component_network& network, Meter& meter,
                     Conversion_report& part, Deviation<Kernel>& deviation)
  {
    std::vector<Bezier_piece> pieces;
    const NURBS_shell_3<Kernel> shell = extract_shell(surface, network, &pieces);
    deviation = meter(shell, std::move(pieces));
    part.boundary.max_deviation = CGAL::to_double(deviation.boundary_maximum);
    part.boundary.mean_deviation = CGAL::to_double(deviation.boundary_mean);
    locate_worst(deviation.boundary_worst, part);
    part.boundary.max_corner_error = CGAL::to_double(deviation.corner_maximum);
    part.interior.max_deviation = CGAL::to_double(deviation.interior_maximum);
    part.interior.mean_deviation = CGAL::to_double(deviation.interior_mean);
    part.interior.fraction_within_delta = CGAL::to_double(deviation.fraction_within);
    for(int i = 0; i < 3; ++i)
      part.interior.worst[i] = CGAL::to_double(deviation.interior_worst[i]);
    part.smoothness.max_normal_angle_degrees = CGAL::to_double(deviation.normal_angle_maximum);
    part.smoothness.max_crease_angle_degrees = CGAL::to_double(deviation.crease_angle_maximum);
    part.counts.nurbs_faces = shell.number_of_faces();
    return check_deviation(deviation, part);
  }

  // The interior tolerance is that of the target; this one is that of the mesh.
  double largest_deviation(const Conversion_report& part) const
  {
    const double height = part.interior.target_height;
    return m_options.interior_tolerance + (Conversion_report::is_measured(height) ? height : 0);
  }

  // Faces that are merged better are the same surface, with other edges at which normals are compared.
  // `pieces`: those of the cells if not null, see pieces_of_cells()
  NURBS_shell_3<Kernel> extract_shell(const Surface& surface, const Component_network& network,
                                      std::vector<Bezier_piece>* pieces) const
  {
    NURBS_shell_3<Kernel> shell;
    extract_faces(surface, surface_cells(surface), m_options.interior_tolerance,
                  find_boundary_vertices(surface, network, FT(m_options.boundary_tolerance)),
                  Merging::FAST, shell, pieces);
    return shell;
  }

  // proves a bound of the distance from the surface to the mesh.
  Error_code certify(const Surface& surface, const Component& component,
                     const Component_network& network, Conversion_report& part) const
  {
    part.interior.certified_bound = CGAL::to_double(bound_interior_deviation(
      extract_shell(surface, network, nullptr), component.mesh, network,
      parameters::interior_tolerance(m_options.interior_tolerance).boundary_band(m_band)));
    if(part.interior.certified_bound > largest_deviation(part))
      part.warnings.push_back("the distance of the surface from the mesh is proved to be below "
                              + format_number(part.interior.certified_bound)
                              + " only, which is more than the tolerance");
    return Error_code::OK;
  }

  // Chains are numbered anew in each component; the report speaks of those of the whole mesh.
  void locate_worst(const Point_3& p, Conversion_report& part) const
  {
    double smallest = std::numeric_limits<double>::infinity();
    for(std::size_t c = 0; c < m_network.number_of_chains(); ++c)
    {
      const auto foot = m_network.project(c, p);
      if(!(CGAL::to_double(foot.distance) < smallest))
        continue;
      smallest = CGAL::to_double(foot.distance);
      part.boundary.worst_curve = c;
      part.boundary.worst_parameter = CGAL::to_double(foot.arc_length);
    }
  }

  static double largest_angle(const Deviation<Kernel>& deviation)
  {
    return CGAL::to_double((std::max)(deviation.normal_angle_maximum,
                                      deviation.crease_angle_maximum));
  }

  static void warn_about_normals(const Deviation<Kernel>& deviation, Conversion_report& part)
  {
    const double angle = largest_angle(deviation), limit = 1; // in degrees
    if(!(angle > limit))
      return;
    const Point_3& p = deviation.normal_angle_worst;
    part.warnings.push_back("the normals of two faces differ by "
      + format_number(angle) + " degrees at ("
      + format_number(CGAL::to_double(p.x())) + ", " + format_number(CGAL::to_double(p.y())) + ", "
      + format_number(CGAL::to_double(p.z())) + "): a larger interior tolerance or another quad size "
      "may give a smoother surface");
  }

  static void warn_about_folds(const Deviation<Kernel>& deviation, Conversion_report& part)
  {
    if(deviation.piece_folds.empty())
      return;
    const Point_3& p = deviation.piece_folds.front();
    part.warnings.push_back("the surface is folded over in "
      + std::to_string(deviation.piece_folds.size()) + " of its polynomial pieces, for instance at ("
      + format_number(CGAL::to_double(p.x())) + ", " + format_number(CGAL::to_double(p.y())) + ", "
      + format_number(CGAL::to_double(p.z())) + "): another quad size may avoid it");
  }

  // The fits have the last word on the tolerances of the surface; this is the independent one.
  Error_code check_deviation(const Deviation<Kernel>& deviation, Conversion_report& part) const
  {
    if(part.boundary.max_deviation > m_options.boundary_tolerance)
      part.message = "the boundary of the surface is farther from the curves than the tolerance";
    else if(part.interior.max_deviation > largest_deviation(part))
      part.message = m_options.use_smooth_target
        ? "the surface is farther from the mesh than the smooth target and the tolerance allow"
        : "the surface is farther from the mesh than the tolerance";
    else if(deviation.faces_against_mesh > 0)
      part.message = "the surface is folded over: a face looks the other way than the mesh";
    else if(largest_angle(deviation) > 90)
      part.message = "the surface is folded over: the normals of two faces are opposite";
    else
      return Error_code::OK;
    return Error_code::TOLERANCE_NOT_REACHED;
  }

  static void count(const Surface& surface, Conversion_report& part)
  {
    part.counts.patches = surface.number_of_patches();
    part.counts.control_points = surface.number_of_control_points();
    part.counts.extraordinary_points = surface.number_of_extraordinary_points();
    part.counts.t_junctions = surface.number_of_t_junctions();
    part.counts.bezier_elements = surface.bezier_elements(1).size();
  }

  static bool is_surface(Error_code code)
  {
    return code == Error_code::OK || code == Error_code::TOLERANCE_NOT_REACHED;
  }

  const TriangleMesh& m_tm;
  VertexPointMap m_vpm;
  const Network& m_network;
  SizeMap m_size_map;
  CrossFieldMap m_cross_field_map;
  Conversion_options m_options;
  Normal_function<BoundaryCurveTraits> m_normals;
  Visitor& m_visitor;
  std::vector<Surface>& m_surfaces;
  Conversion_report& m_report;
  double m_band; // along the boundary of all components
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_CONVERTER_H
