// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_JSON_WRITER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_JSON_WRITER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <locale>
#include <ostream>
#include <sstream>
#include <string>
#include <type_traits>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Returns `value` with as many digits as are needed to read it back unchanged, independently of the
// global locale; JSON has no word for NaN and infinity, for which `undefined` is returned.
inline std::string number_to_string(double value, const std::string& undefined)
{
  if(!std::isfinite(value))
    return undefined;
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(std::numeric_limits<double>::max_digits10);
  out << value;
  return out.str();
}

// Returns `text` as a JSON string: control characters, quotes, and backslashes are escaped.
inline std::string quoted(const std::string& text)
{
  static const char* const hexadecimal = "0123456789abcdef";
  std::string result = "\"";
  for(const char c : text)
  {
    const unsigned char code = static_cast<unsigned char>(c);
    if(c == '"' || c == '\\')
      (result += '\\') += c;
    else if(c == '\n')
      result += "\\n";
    else if(c == '\t')
      result += "\\t";
    else if(code < 0x20)
      ((result += "\\u00") += hexadecimal[code >> 4]) += hexadecimal[code & 15];
    else
      result += c;
  }
  return result += '"';
}

// Writes indented JSON. Commas and line breaks are set between the members; the caller opens and
// closes objects and arrays. Arrays of numbers stay on one line.
class JSON_writer
{
public:
  explicit JSON_writer(std::ostream& out) : m_out(out) {}

  void open(const std::string& key, char bracket)
  {
    begin_member(key);
    m_out << bracket;
    m_indentation += 2;
    m_is_first = true;
  }

  void close(char bracket)
  {
    m_indentation -= 2;
    if(!m_is_first)
      new_line();
    m_out << bracket;
    m_is_first = false;
    if(m_indentation == 0)
      m_out << '\n';
  }

  template <typename Value>
  void member(const std::string& key, const Value& value)
  {
    begin_member(key);
    m_out << text(value);
  }

private:
  static std::string text(const std::string& value) { return quoted(value); }
  static std::string text(const char* value) { return quoted(value); }
  static std::string text(double value) { return number_to_string(value, "null"); }

  template <typename Integer>
  static std::enable_if_t<std::is_integral<Integer>::value, std::string> text(Integer value)
  {
    return std::to_string(value);
  }

  template <typename Range>
  static std::enable_if_t<std::is_class<Range>::value, std::string> text(const Range& values)
  {
    std::string result = "[";
    for(const auto& value : values)
      (result += (result.size() > 1) ? ", " : "") += text(value);
    return result += "]";
  }

  void begin_member(const std::string& key)
  {
    if(!m_is_first)
      m_out << ',';
    if(m_indentation > 0)
      new_line();
    if(!key.empty())
      m_out << quoted(key) << ": ";
    m_is_first = false;
  }

  void new_line() { m_out << '\n' << std::string(m_indentation, ' '); }

  std::ostream& m_out;
  std::size_t m_indentation = 0;
  bool m_is_first = true;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_JSON_WRITER_H
