// Shows the progress of a conversion on the standard error stream.
#ifndef CONVERT_CASE_PROGRESS_VISITOR_H
#define CONVERT_CASE_PROGRESS_VISITOR_H

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/boost/graph/properties.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

// The stages that convert_to_T_NURCC() goes through: the same ones for each component.
template <typename Mesh>
std::size_t number_of_stages(const Mesh& mesh)
{
  const std::size_t stages_per_component = 6;
  const auto component = get(CGAL::dynamic_face_property_t<std::size_t>(), mesh);
  return stages_per_component
       * CGAL::Polygon_mesh_processing::connected_components(mesh, component);
}

// Prints one line per stage and iteration; on a terminal with the percentage of the stages that
// have begun.
class Progress_visitor
{
public:
  typedef CGAL::Surface_mesh_spline_conversion::Conversion_report Report;

  Progress_visitor(bool is_quiet, std::size_t expected_stages)
    : m_is_quiet(is_quiet), m_is_terminal(is_terminal()), m_expected_stages(expected_stages)
  {}

  void on_stage_begin(const std::string&) {}

  void on_stage_end(const std::string& name, double seconds)
  {
    ++m_stages;
    if(m_is_quiet)
      return;
    print_percentage();
    std::fprintf(stderr, "%-28s %8.3f s\n", name.c_str(), seconds);
  }

  void on_iteration(const Report::Iteration& record)
  {
    if(m_is_quiet)
      return;
    print_percentage();
    std::fprintf(stderr, "  %s %zu: %zu patches, %zu control points", record.stage.c_str(),
                 record.iteration, record.patches, record.control_points);
    print_error("boundary", record.boundary_linf);
    print_error("interior", record.interior_linf);
    std::fprintf(stderr, ", %.3f s\n", record.seconds);
  }

  bool go_further() const { return true; }

private:
  static bool is_terminal()
  {
#ifdef _WIN32
    return _isatty(_fileno(stderr)) != 0;
#else
    return isatty(fileno(stderr)) != 0;
#endif
  }

  void print_percentage() const
  {
    if(m_is_terminal)
      std::fprintf(stderr, "[%3zu%%] ",
                   (std::min)(std::size_t(100), 100 * m_stages / m_expected_stages));
  }

  static void print_error(const char* name, double error)
  {
    if(Report::is_measured(error))
      std::fprintf(stderr, ", %s %.3g", name, error);
  }

  bool m_is_quiet;
  bool m_is_terminal;
  std::size_t m_stages = 0;
  std::size_t m_expected_stages;
};

#endif // CONVERT_CASE_PROGRESS_VISITOR_H
