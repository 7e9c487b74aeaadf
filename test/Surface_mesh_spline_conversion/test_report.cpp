// The report as JSON, CSV, and SVG: JSON is read back by Boost.PropertyTree, an independent parser.

#include <CGAL/Surface_mesh_spline_conversion/IO/JSON_report.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/conversion_history.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/conversion/merge_reports.h>

#include <boost/property_tree/json_parser.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

namespace SC = CGAL::Surface_mesh_spline_conversion;

SC::Conversion_report make_report()
{
  SC::Conversion_report report;
  report.status = SC::Error_code::TOLERANCE_NOT_REACHED;
  report.message = "chain \"3\" \\ line one\nline\ttwo \x01";
  report.warnings = {"first", "second"};
  report.input.vertices = 12;
  report.input.diameter = 0.1;
  report.input.facet_sagitta = 0.002;
  report.boundary_tolerance = 1e-6;
  report.interior_tolerance = 1. / 3;
  report.boundary.max_deviation = 1e-300;
  report.boundary.worst_curve = 7;
  report.interior.worst = {{1, -2.5, 1e22}};
  report.counts.patches = 5287;
  for(std::size_t i = 0; i < 3; ++i)
  {
    SC::Conversion_report::Iteration record;
    record.stage = "fit_boundary";
    record.iteration = i;
    record.patches = 100 * (i + 1);
    record.boundary_linf = std::pow(10., -1. - 2. * static_cast<double>(i));
    report.iterations.push_back(record);
  }
  report.add_time("map", 0.25);
  report.add_time("fit", 1.5);
  report.add_time("map", 0.5);
  return report;
}

void test_JSON(const SC::Conversion_report& report)
{
  std::stringstream stream;
  assert(CGAL::IO::write_JSON(stream, report));
  boost::property_tree::ptree tree;
  boost::property_tree::read_json(stream, tree);
  assert(tree.get<std::string>("status") == "a tolerance was not reached");
  assert(tree.get<std::string>("message") == report.message);
  assert(tree.get_child("warnings").size() == 2);
  assert(tree.get<int>("input.vertices") == 12);
  assert(tree.get<double>("input.diameter") == 0.1);
  assert(tree.get<double>("input.facet_sagitta") == 0.002);
  assert(tree.get<double>("delta") == 1. / 3);
  assert(tree.get<double>("boundary.max_deviation") == 1e-300);
  assert(tree.get<int>("boundary.worst.curve") == 7);
  assert(tree.get<std::string>("boundary.mean_deviation") == "null");
  assert(tree.get_child("interior.worst").back().second.get_value<double>() == 1e22);
  assert(tree.get<int>("counts.patches") == 5287);
  assert(tree.get<std::string>("map.fallback") == "none");
  assert(tree.get_child("iterations").size() == 3);
  assert(tree.get_child("iterations").back().second.get<double>("boundary_linf") == 1e-5);
  assert(tree.get_child("stages").size() == 2);
  assert(tree.get_child("stages").front().second.get<double>("seconds") == 0.75);
  for(const char* key : {"smoothness.max_normal_angle_degrees", "peak_memory_bytes", "quad_size"})
    assert(tree.get_optional<std::string>(key));
}

void test_history(const SC::Conversion_report& report)
{
  std::stringstream stream;
  assert(CGAL::IO::write_history_CSV(stream, report));
  std::string line;
  for(std::size_t lines = 0; lines < 4; ++lines)
  {
    assert(std::getline(stream, line));
    assert(std::count(line.begin(), line.end(), ',') == 8);
  }
  assert(line == "fit_boundary,2,300,0,1.0000000000000001e-05,,,0,0");
  assert(!std::getline(stream, line));
}

void test_chart(const SC::Conversion_report& report)
{
  std::stringstream stream;
  SC::internal::History_chart(report).write(stream);
  const std::string text = stream.str();
  assert(text.find("nan") == std::string::npos && text.find("inf") == std::string::npos);
  std::size_t circles = 0;
  for(std::size_t i = text.find("<circle"); i != std::string::npos; i = text.find("<circle", i + 1))
    ++circles;
  assert(circles == 3);
}

// the courses of two components are told apart, and no line joins them
void test_components()
{
  SC::Conversion_report whole, part;
  part.iterations.resize(2);
  part.iterations[0].boundary_linf = 1;
  part.iterations[1].boundary_linf = 0.1;
  SC::internal::merge_reports(part, whole);
  SC::internal::merge_reports(part, whole);
  assert(whole.iterations.size() == 4);
  for(std::size_t i = 0; i < 4; ++i)
    assert(whole.iterations[i].component == i / 2);

  std::stringstream stream;
  SC::internal::History_chart(whole).write(stream);
  const std::string text = stream.str();
  assert(text.find("component 2") != std::string::npos);
  const std::string line = "stroke=\"#1f6fb4\" points=\"";
  std::size_t lines = 0;
  for(std::size_t i = text.find(line); i != std::string::npos; i = text.find(line, i + 1))
  {
    const std::string points = text.substr(i + line.size(), text.find('"', i + line.size())
                                                              - i - line.size());
    assert(std::count(points.begin(), points.end(), ',') == 2);
    ++lines;
  }
  assert(lines == 2);
}

void test_empty_report()
{
  const SC::Conversion_report report;
  std::stringstream stream;
  assert(CGAL::IO::write_JSON(stream, report));
  boost::property_tree::ptree tree;
  boost::property_tree::read_json(stream, tree);
  assert(tree.get<std::string>("status") == "ok");

  std::stringstream chart;
  SC::internal::History_chart(report).write(chart);
  assert(chart.str().find("nan") == std::string::npos);
}

int main()
{
  const SC::Conversion_report report = make_report();
  test_JSON(report);
  test_history(report);
  test_chart(report);
  test_components();
  test_empty_report();
  assert(!CGAL::IO::write_JSON("no/such/folder/report.json", report));
  return EXIT_SUCCESS;
}
