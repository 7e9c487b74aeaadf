// Measures the stages of the conversion one by one. The input of each stage is computed once.
// usage: benchmark_stages [CASE [XI DELTA]] [options of Google Benchmark]

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_spline_conversion/Boundary_curve_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/STEP.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/read_case.h>
#include <CGAL/Surface_mesh_spline_conversion/Transfinite_patch_network_3.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_integer_grid_map.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_NURBS_faces.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_boundary.h>
#include <CGAL/Surface_mesh_spline_conversion/fit_interior.h>
#include <CGAL/Real_timer.h>
#include <CGAL/T_NURCC_surface_3.h>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;

typedef CGAL::Simple_cartesian<double> K;
typedef SC::Conversion_case<K> Case;
typedef SC::Boundary_curve_network_3<Case::Triangle_mesh, Case::Curve_traits> Network;
typedef SC::Quad_layout<K> Layout;
typedef SC::Transfinite_patch_network_3<K, Case::Triangle_mesh, Case::Curve_traits> Target;
typedef CGAL::T_NURCC_surface_3<K> Surface;

// what the stages hand on to each other
struct Pipeline
{
  Case input;
  SC::Cross_field field;
  SC::Integer_grid_map map;
  Layout layout;

  Network network() const
  {
    return Network(input.mesh, input.halfedge_curve_map(), input.traits,
                   CGAL::parameters::corner_angle(0.5)
                     .vertex_is_constrained_map(input.vertex_is_corner_map()));
  }
};

void check(benchmark::State& state, SC::Error_code code)
{
  if(code != SC::Error_code::OK && code != SC::Error_code::TOLERANCE_NOT_REACHED)
    state.SkipWithError(SC::error_message(code));
}

void measure_network(benchmark::State& state, const Pipeline& pipeline)
{
  for(auto _ : state)
    check(state, pipeline.network().error());
}

void measure_cross_field(benchmark::State& state, const Pipeline& pipeline)
{
  const Network network = pipeline.network();
  for(auto _ : state)
  {
    SC::Cross_field field;
    check(state, SC::compute_cross_field(pipeline.input.mesh, network, field));
  }
}

void measure_integer_grid_map(benchmark::State& state, const Pipeline& pipeline)
{
  for(auto _ : state)
  {
    SC::Integer_grid_map map;
    check(state, SC::compute_integer_grid_map(pipeline.field, map));
  }
}

void measure_quad_layout(benchmark::State& state, const Pipeline& pipeline)
{
  const Network network = pipeline.network();
  for(auto _ : state)
  {
    Layout layout;
    check(state, SC::extract_quad_layout(pipeline.map, pipeline.input.mesh, network, layout));
  }
  state.counters["quads"] = static_cast<double>(pipeline.layout.number_of_quads());
}

void measure_target(benchmark::State& state, const Pipeline& pipeline)
{
  const Network network = pipeline.network();
  for(auto _ : state)
    Target(pipeline.layout, network, pipeline.input.mesh);
}

// the tolerances are relative to the diameter
double xi = 1e-5, delta = 5e-3;

void measure_fit_boundary(benchmark::State& state, const Pipeline& pipeline)
{
  const Network network = pipeline.network();
  const Target target(pipeline.layout, network, pipeline.input.mesh);
  for(auto _ : state)
  {
    Surface surface(pipeline.layout);
    SC::Conversion_report report;
    check(state, SC::fit_boundary(surface, target, report,
                                  CGAL::parameters::boundary_tolerance(xi * network.diameter())));
    state.counters["patches"] = static_cast<double>(surface.number_of_patches());
  }
}

// returns how long it takes to sample, assemble and solve the system of the interior fit once, from
// control points at the origin on
double final_system_seconds(const Surface& surface, const Target& target)
{
  typedef SC::internal::Interior_samples<Surface, Target> Samples;
  typedef SC::internal::Interior_system<Samples> System;
  const double accuracy = 1e-6;
  CGAL::Real_timer timer;
  timer.start();
  const Samples samples(surface, target, nullptr);
  std::vector<bool> is_fixed(surface.number_of_control_points(), false);
  System::Points points = System::Points::Zero(Eigen::Index(is_fixed.size()), 3);
  for(std::size_t c = 0; c < surface.number_of_boundary_chains(); ++c)
    for(std::size_t i : surface.boundary_curve(c).control_points)
    {
      is_fixed[i] = true;
      points.row(Eigen::Index(i))
        = SC::internal::to_eigen(surface.control_point(i)).transpose();
    }
  std::vector<std::size_t> patches(surface.number_of_patches());
  std::iota(patches.begin(), patches.end(), std::size_t(0));
  System(samples, is_fixed, patches).solve(points, accuracy);
  benchmark::DoNotOptimize(points.data());
  return timer.time();
}

// returns how long it takes to find out once whether the surface meets the tolerance
double measurement_seconds(const Surface& surface, const Target& target, double tolerance)
{
  typedef SC::internal::Interior_samples<Surface, Target> Samples;
  typedef SC::internal::Interior_error<Surface, Target> Errors;
  const Samples samples(surface, target, nullptr);
  CGAL::Real_timer timer;
  timer.start();
  Errors errors(surface, target, samples, false, nullptr);
  benchmark::DoNotOptimize(errors.violations(tolerance).size());
  return timer.time();
}

// Both fits, and their time in units of that of the final system. A fit measures the error at least
// once: the time of that is given in the same unit.
void measure_fit(benchmark::State& state, const Pipeline& pipeline)
{
  const Network network = pipeline.network();
  const Target target(pipeline.layout, network, pipeline.input.mesh);
  const auto np = CGAL::parameters::boundary_tolerance(xi * network.diameter())
                    .interior_tolerance(delta * network.diameter());
  CGAL::Real_timer timer;
  double sum_of_systems = 0, sum_of_measurements = 0;
  for(auto _ : state)
  {
    Surface surface(pipeline.layout);
    SC::Conversion_report report;
    timer.start();
    check(state, SC::fit_boundary(surface, target, report, np));
    check(state, SC::fit_interior(surface, target, report, np));
    timer.stop();
    state.PauseTiming();
    sum_of_systems += final_system_seconds(surface, target);
    sum_of_measurements += measurement_seconds(surface, target, delta * network.diameter());
    state.ResumeTiming();
    state.counters["control_points"] = static_cast<double>(surface.number_of_control_points());
  }
  state.counters["final_systems"] = timer.time() / sum_of_systems;
  state.counters["measurement"] = sum_of_measurements / sum_of_systems;
  state.counters["system_seconds"] = sum_of_systems / double(state.iterations());
}

void measure_fit_interior(benchmark::State& state, const Pipeline& pipeline)
{
  const Network network = pipeline.network();
  const Target target(pipeline.layout, network, pipeline.input.mesh);
  Surface start(pipeline.layout);
  SC::Conversion_report report;
  const auto np = CGAL::parameters::boundary_tolerance(xi * network.diameter())
                    .interior_tolerance(delta * network.diameter());
  check(state, SC::fit_boundary(start, target, report, np));
  for(auto _ : state)
  {
    Surface surface(start);
    check(state, SC::fit_interior(surface, target, report, np));
    state.counters["patches"] = static_cast<double>(surface.number_of_patches());
  }
}

void measure_evaluation(benchmark::State& state, const Pipeline& pipeline)
{
  const Surface surface(pipeline.layout);
  for(auto _ : state)
    for(std::size_t patch = 0; patch < surface.number_of_patches(); ++patch)
    {
      const auto origin = surface.patch_origin(patch);
      const double u = (origin.u0 + origin.u1) / 2, v = (origin.v0 + origin.v1) / 2;
      benchmark::DoNotOptimize(surface.position(patch, u, v));
    }
  state.SetItemsProcessed(static_cast<std::int64_t>(surface.number_of_patches())
                          * state.iterations());
}

// The surface with all patches halved in turns until there are more than 50000.
Surface refined_surface(const Layout& layout)
{
  const std::size_t patches = 50000;
  Surface surface(layout);
  for(bool along_u = true; surface.number_of_patches() < patches; along_u = !along_u)
  {
    std::vector<Surface::Patch_split> splits;
    for(std::size_t patch = 0; patch < surface.number_of_patches(); ++patch)
      splits.push_back({patch, along_u, !along_u});
    surface.refine(splits);
  }
  return surface;
}

void measure_extraction(benchmark::State& state, const Pipeline& pipeline)
{
  const Surface surface = refined_surface(pipeline.layout);
  for(auto _ : state)
  {
    SC::NURBS_shell_3<K> shell;
    SC::extract_NURBS_faces(surface, shell);
    state.counters["faces"] = static_cast<double>(shell.number_of_faces());
  }
  state.counters["patches"] = static_cast<double>(surface.number_of_patches());
}

void measure_writing(benchmark::State& state, const Pipeline& pipeline, bool do_merge)
{
  const Surface surface = refined_surface(pipeline.layout);
  SC::NURBS_shell_3<K> shell;
  SC::extract_NURBS_faces(surface, shell, CGAL::parameters::do_merge_patches(do_merge));
  for(auto _ : state)
  {
    std::ostringstream os;
    CGAL::IO::write_STEP(os, shell);
    state.counters["bytes"] = static_cast<double>(os.tellp());
  }
  state.counters["faces"] = static_cast<double>(shell.number_of_faces());
}

void measure_STEP(benchmark::State& state, const Pipeline& pipeline)
{
  measure_writing(state, pipeline, true);
}

void measure_STEP_of_elements(benchmark::State& state, const Pipeline& pipeline)
{
  measure_writing(state, pipeline, false);
}

// Runs the stages up to the layout; returns `false` if one of them fails.
bool prepare(const std::string& path, Pipeline& pipeline)
{
  std::string message;
  if(!CGAL::IO::read_case(path, pipeline.input, message))
  {
    std::cerr << message << std::endl;
    return false;
  }
  const Network network = pipeline.network();
  SC::Error_code code = network.error();
  if(code == SC::Error_code::OK)
    code = SC::compute_cross_field(pipeline.input.mesh, network, pipeline.field);
  if(code == SC::Error_code::OK)
    code = SC::compute_integer_grid_map(pipeline.field, pipeline.map);
  if(code == SC::Error_code::OK)
    code = SC::extract_quad_layout(pipeline.map, pipeline.input.mesh, network, pipeline.layout);
  if(code != SC::Error_code::OK)
    std::cerr << SC::error_message(code) << std::endl;
  return code == SC::Error_code::OK;
}

int main(int argc, char* argv[])
{
  std::string path = CGAL::data_file_path("cases/d4_bracket_simp/case.json");
  benchmark::Initialize(&argc, argv);
  if(argc > 1)
    path = argv[1];
  if(argc > 3)
  {
    xi = std::atof(argv[2]);
    delta = std::atof(argv[3]);
  }
  Pipeline pipeline;
  if(!prepare(path, pipeline))
    return EXIT_FAILURE;

  typedef void (*Measurement)(benchmark::State&, const Pipeline&);
  const std::pair<const char*, Measurement> measurements[] = {
    {"network", measure_network},
    {"cross_field", measure_cross_field},
    {"integer_grid_map", measure_integer_grid_map},
    {"quad_layout", measure_quad_layout},
    {"target", measure_target},
    {"fit_boundary", measure_fit_boundary},
    {"fit_interior", measure_fit_interior},
    {"fit", measure_fit},
    {"evaluation", measure_evaluation},
    {"extraction", measure_extraction},
    {"STEP", measure_STEP},
    {"STEP_of_elements", measure_STEP_of_elements}};
  for(const auto& measurement : measurements)
    benchmark::RegisterBenchmark(
      measurement.first,
      [&pipeline, measurement](benchmark::State& state) { measurement.second(state, pipeline); })
      ->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
  return EXIT_SUCCESS;
}
