// One run of the map stage on one input at one size, checked and measured.
#ifndef ROBUSTNESS_LAYOUT_RUN_H
#define ROBUSTNESS_LAYOUT_RUN_H

#include "../quality/Quad_quality.h"
#include "../quality/layout_picture.h"
#include "Layout_bound.h"
#include "Layout_checker.h"
#include "Layout_input.h"
#include "Limited_process.h"

#include <CGAL/Surface_mesh_spline_conversion/IO/OBJ_quad_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/JSON_writer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

struct Run_options
{
  bool is_relative = false;  // sizes are relative to the diameter
  double seconds = 0;        // limit of the processor time, 0: by the numbers of triangles and quads
  std::string layout_folder;  // where layouts are written; empty: nowhere
  std::string picture_folder; // where they are drawn
};

inline std::string json(double value) { return SC::internal::number_to_string(value, "null"); }
inline std::string json(const std::string& text) { return SC::internal::quoted(text); }
inline std::string json(std::size_t value) { return std::to_string(value); }

inline void write_json(const std::string& filename, const std::vector<Record>& records)
{
  std::ofstream out(filename);
  out << "[\n";
  for(std::size_t i = 0; i < records.size(); ++i)
  {
    out << "  {";
    for(const auto& member : records[i].members())
      out << (&member == &records[i].members().front() ? "" : ", ") << json(member.first) << ": "
          << member.second;
    out << (i + 1 < records.size() ? "},\n" : "}\n");
  }
  out << "]\n";
}

// ten seconds, and ten more for each 10000 triangles and each 10000 quads
inline double allowed_seconds(double triangles, double quads)
{
  return 10 + 10 * (triangles + quads) / 10000;
}

// Adds up the processor time of the stages.
class Stage_clock : public SC::Default_visitor
{
public:
  void on_stage_begin(const std::string&) { m_begin = processor_time(); }

  void on_stage_end(const std::string& name, double)
  {
    for(auto& stage : m_stages)
      if(stage.first == name)
      {
        stage.second += processor_time() - m_begin;
        return;
      }
    m_stages.emplace_back(name, processor_time() - m_begin);
  }

  // a JSON object
  std::string seconds() const
  {
    std::string result;
    for(const auto& stage : m_stages)
      result += (result.empty() ? "{" : ", ") + json(stage.first) + ": " + json(stage.second);
    return result.empty() ? "{}" : result + "}";
  }

private:
  double m_begin = 0;
  std::vector<std::pair<std::string, double> > m_stages; // in the order in which they began
};

// Runs the stages from the field to the layout, and reports their times, the rung of the ladder,
// and what the library says of the map.
inline SC::Error_code compute_layout(const Network& network, double size, Layout& layout,
                                     Reporter& report)
{
  Stage_clock clock;
  SC::Conversion_report figures;
  const SC::Error_code code
    = SC::compute_quad_layout(network.triangle_mesh(), network, layout, figures,
                              CGAL::parameters::quad_size_map(size).visitor(std::ref(clock)));
  report("stages", clock.seconds());
  report("rung", json(code == SC::Error_code::OK ? figures.map.fallback : std::string("no layout")));
  report("message", json(figures.message));
  report("mean_singular_value_ratio", json(figures.map.mean_singular_value_ratio));
  report("max_singular_value_ratio", json(figures.map.max_singular_value_ratio));
  report("mean_area_ratio", json(figures.map.mean_area_ratio));
  report("max_area_ratio", json(figures.map.max_area_ratio));
  report("mean_kink_degrees", json(figures.map.mean_kink_degrees));
  report("max_kink_degrees", json(figures.map.max_kink_degrees));
  return code;
}

// `report(name, json)` takes the figures
template <typename Report>
void report_quality(const Check::Quad_quality& quality, Report&& report)
{
  report("inverted", json(quality.inverted));
  report("min_scaled_jacobian", json(quality.min_scaled_jacobian));
  report("mean_scaled_jacobian", json(quality.mean_scaled_jacobian));
  report("mean_angle_deviation", json(quality.mean_angle_deviation));
  report("max_angle_deviation", json(quality.max_angle_deviation));
  report("min_size_ratio", json(quality.min_size_ratio));
  report("mean_size_ratio", json(quality.mean_size_ratio));
  report("max_size_ratio", json(quality.max_size_ratio));
  report("relative_count", json(quality.relative_count));
}

// judges the layout, and reports all figures
inline void check_and_measure(const Network& network, double size, const Layout& layout,
                              const Check::Triangle_mesh& mesh, const std::string& picture,
                              Reporter& report)
{
  const double begin = processor_time();
  const Check::Quad_mesh plain = to_plain(layout);
  const Check::Boundary_chains chains = chains_of(network);
  Check::Layout_checker checker(plain, mesh, chains);
  std::string defects;
  for(const Check::Defect& defect : checker.check())
    defects += (defects.empty() ? "" : "; ") + defect.property
               + (defect.place.empty() ? "" : " (" + defect.place + ")");
  report("defects", json(defects));
  report("quads", json(plain.quads.size()));
  Check::Layout_bound bound(mesh);
  report("least_quads", json(std::size_t(bound.number_of_quads())));
  report("least_quads_with_low_valences",
         json(std::size_t(bound.number_of_quads_with_low_valences())));
  report("extraordinary_points", json(checker.number_of_extraordinary_points()));
  report("relative_area", json(checker.relative_area()));
  const auto normal = [&](std::size_t q)
  { return mesh.normal(plain.inverse_map(q, 0.5, 0.5).face); };
  report_quality(Check::measure_quality(plain, mesh.area(), normal, size), report);
  report("check_seconds", json(processor_time() - begin));
  if(!picture.empty())
    draw_layout(picture, mesh, plain,
                std::to_string(plain.quads.size()) + " quads, "
                + std::to_string(checker.number_of_extraordinary_points())
                + " extraordinary points");
}

// The whole run; what it reports says how far it came. `make` fills the case.
inline void run_layout(const std::function<Mesh_defect(Case&)>& make, double size,
                       const std::string& name, const Run_options& options, Reporter& report)
{
  Case input;
  const Mesh_defect defect = make(input);
  if(defect.code != SC::Error_code::OK)
    return report("error", json(defect.message));
  report("triangles", json(std::size_t(input.mesh.number_of_faces())));
  const Network network(input.mesh, input.halfedge_curve_map(), input.traits,
                        CGAL::parameters::vertex_is_constrained_map(input.vertex_is_corner_map()));
  if(network.error() != SC::Error_code::OK)
    return report("error", json(network.message()));
  const Check::Triangle_mesh mesh = to_plain(network);
  const double h = options.is_relative ? size * network.diameter() : size;
  const double wanted_quads = mesh.area() / (h * h);
  report("loops", json(network.number_of_loops()));
  report("corners", json(mesh.corners.size()));
  report("wanted_quads", json(wanted_quads));

  const double seconds = options.seconds > 0
    ? options.seconds : allowed_seconds(double(mesh.triangles.size()), wanted_quads);
  report("allowed_seconds", json(seconds));
  limit_processor_time(seconds);
  const double begin = processor_time();
  Layout layout;
  const SC::Error_code code = compute_layout(network, h, layout, report);
  report("seconds", json(processor_time() - begin));
  const double seconds_for_checks = 600;
  limit_processor_time(seconds_for_checks);
  if(code != SC::Error_code::OK)
    return report("failure", json(std::string(SC::error_message(code))));
  if(!options.layout_folder.empty())
    CGAL::IO::write_OBJ(options.layout_folder + "/" + name + ".obj", layout);
  const std::string picture
    = options.picture_folder.empty() ? "" : options.picture_folder + "/" + name + ".png";
  check_and_measure(network, h, layout, mesh, picture, report);
}

#endif // ROBUSTNESS_LAYOUT_RUN_H
