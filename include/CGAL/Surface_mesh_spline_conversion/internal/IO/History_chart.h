// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_HISTORY_CHART_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_HISTORY_CHART_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <locale>
#include <ostream>
#include <sstream>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Draws the course of a conversion as an SVG chart. Errors belong to the logarithmic axis on the
// left, which covers whole decades; the number of patches belongs to the linear axis on the right.
class History_chart
{
public:
  explicit History_chart(const Conversion_report& report)
    : m_report(report)
  {
    for(const Iteration& record : report.iterations)
    {
      extend_range(record.boundary_linf);
      extend_range(record.boundary_hausdorff);
      extend_range(record.interior_linf);
      m_maximum_patches = (std::max)(m_maximum_patches, static_cast<double>(record.patches));
    }
    extend_range(report.boundary_tolerance);
    extend_range(report.interior_tolerance);
    if(m_first_decade > m_last_decade)
      m_first_decade = m_last_decade = 0;
    if(m_first_decade == m_last_decade)
      ++m_last_decade;
  }

  void write(std::ostream& out) const
  {
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << number(width) << "\" height=\""
        << number(height) << "\" font-family=\"sans-serif\" font-size=\"12\">\n"
        << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    write_axes(out);
    write_components(out);
    write_tolerance(out, m_report.boundary_tolerance, "xi", "#1f6fb4");
    write_tolerance(out, m_report.interior_tolerance, "delta", "#c0392b");
    write_curve(out, &Iteration::boundary_linf, "#1f6fb4");
    write_curve(out, &Iteration::boundary_hausdorff, "#27ae60");
    write_curve(out, &Iteration::interior_linf, "#c0392b");
    write_patches(out);
    write_legend(out);
    out << "</svg>\n";
  }

private:
  typedef Conversion_report::Iteration Iteration;

  // pixels of the chart and its plotting area
  static constexpr double width = 760, height = 420;
  static constexpr double left = 70, right = 690, top = 40, bottom = 370;

  void extend_range(double error)
  {
    if(!std::isfinite(error) || error <= 0)
      return;
    m_first_decade = (std::min)(m_first_decade, static_cast<int>(std::floor(std::log10(error))));
    m_last_decade = (std::max)(m_last_decade, static_cast<int>(std::ceil(std::log10(error))));
  }

  double x_of(std::size_t i) const
  {
    const std::size_t n = m_report.iterations.size();
    return (n < 2) ? (left + right) / 2
                   : left + (right - left) * static_cast<double>(i) / static_cast<double>(n - 1);
  }

  double y_of_decade(double decade) const
  {
    return bottom - (bottom - top) * (decade - m_first_decade) / (m_last_decade - m_first_decade);
  }

  double y_of_patches(std::size_t patches) const
  {
    return bottom - (bottom - top) * static_cast<double>(patches) / m_maximum_patches;
  }

  // does another component begin with the iteration?
  bool begins_component(std::size_t i) const
  {
    return i > 0 && m_report.iterations[i].component != m_report.iterations[i - 1].component;
  }

  // a pixel position with one decimal, independent of the locale
  static std::string number(double value)
  {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::round(10 * value) / 10;
    return out.str();
  }

  static void write_line(std::ostream& out, double x0, double y0, double x1, double y1,
                         const std::string& style)
  {
    out << "<line x1=\"" << number(x0) << "\" y1=\"" << number(y0) << "\" x2=\"" << number(x1)
        << "\" y2=\"" << number(y1) << "\" " << style << "/>\n";
  }

  static void write_text(std::ostream& out, double x, double y, const std::string& text,
                         const std::string& style)
  {
    out << "<text x=\"" << number(x) << "\" y=\"" << number(y) << "\" " << style << ">" << text
        << "</text>\n";
  }

  void write_axes(std::ostream& out) const
  {
    for(int decade = m_first_decade; decade <= m_last_decade; ++decade)
    {
      const double y = y_of_decade(decade);
      write_line(out, left, y, right, y, "stroke=\"#dddddd\"");
      write_text(out, left - 8, y + 4, "1e" + std::to_string(decade), "text-anchor=\"end\"");
    }
    // at most about twenty labels fit below the axis
    const std::size_t step = 1 + m_report.iterations.size() / 20;
    for(std::size_t i = 0; i < m_report.iterations.size(); i += step)
      write_text(out, x_of(i), bottom + 18, std::to_string(i), "text-anchor=\"middle\"");
    for(double share : {0., 0.5, 1.})
      write_text(out, right + 8, bottom + 4 - share * (bottom - top),
                 number(std::floor(share * m_maximum_patches)), "");
    out << "<rect x=\"" << number(left) << "\" y=\"" << number(top) << "\" width=\""
        << number(right - left) << "\" height=\"" << number(bottom - top)
        << "\" fill=\"none\" stroke=\"black\"/>\n";
    write_text(out, (left + right) / 2, bottom + 38, "iteration", "text-anchor=\"middle\"");
  }

  void write_components(std::ostream& out) const
  {
    for(std::size_t i = 0; i < m_report.iterations.size(); ++i)
      if(begins_component(i))
      {
        const double x = (x_of(i - 1) + x_of(i)) / 2;
        write_line(out, x, top, x, bottom, "stroke=\"#888888\" stroke-dasharray=\"2 3\"");
        write_text(out, x + 4, bottom - 6,
                   "component " + std::to_string(m_report.iterations[i].component + 1),
                   "fill=\"#888888\"");
      }
  }

  void write_tolerance(std::ostream& out, double tolerance, const std::string& name,
                       const std::string& color) const
  {
    if(!std::isfinite(tolerance) || tolerance <= 0)
      return;
    const double y = y_of_decade(std::log10(tolerance));
    write_line(out, left, y, right, y, "stroke=\"" + color + "\" stroke-dasharray=\"6 4\"");
    write_text(out, right - 6, y - 4, name, "fill=\"" + color + "\" text-anchor=\"end\"");
  }

  void write_curve(std::ostream& out, double Iteration::*error, const std::string& color) const
  {
    std::string points;
    for(std::size_t i = 0; i < m_report.iterations.size(); ++i)
    {
      if(begins_component(i))
        end_polyline(out, points, color);
      const double value = m_report.iterations[i].*error;
      if(!std::isfinite(value) || value <= 0)
        continue;
      const std::string x = number(x_of(i)), y = number(y_of_decade(std::log10(value)));
      points += x + "," + y + " ";
      out << "<circle cx=\"" << x << "\" cy=\"" << y << "\" r=\"3\" fill=\"" << color << "\"/>\n";
    }
    end_polyline(out, points, color);
  }

  void write_patches(std::ostream& out) const
  {
    std::string points;
    for(std::size_t i = 0; i < m_report.iterations.size(); ++i)
    {
      if(begins_component(i))
        end_polyline(out, points, "black");
      points += number(x_of(i)) + "," + number(y_of_patches(m_report.iterations[i].patches)) + " ";
    }
    end_polyline(out, points, "black");
  }

  // writes the polyline through the points, and forgets them
  static void end_polyline(std::ostream& out, std::string& points, const std::string& color)
  {
    out << "<polyline fill=\"none\" stroke=\"" << color << "\" points=\"" << points << "\"/>\n";
    points.clear();
  }

  static void write_legend(std::ostream& out)
  {
    write_text(out, 0, 0, "error (model units)",
               "text-anchor=\"middle\" transform=\"translate(16 "
                 + number((top + bottom) / 2) + ") rotate(-90)\"");
    write_text(out, left, top - 14, "boundary, parametric", "fill=\"#1f6fb4\"");
    write_text(out, left + 160, top - 14, "boundary, distance", "fill=\"#27ae60\"");
    write_text(out, left + 310, top - 14, "interior", "fill=\"#c0392b\"");
    write_text(out, left + 400, top - 14, "patches (right axis)", "");
  }

  const Conversion_report& m_report;
  int m_first_decade = (std::numeric_limits<int>::max)();
  int m_last_decade = (std::numeric_limits<int>::min)();
  double m_maximum_patches = 1;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_HISTORY_CHART_H
