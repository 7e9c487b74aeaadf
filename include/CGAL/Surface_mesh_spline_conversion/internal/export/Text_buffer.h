// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_TEXT_BUFFER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_TEXT_BUFFER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <charconv>
#include <cstddef>
#include <ostream>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Text output without the cost of formatted streams: large files are mostly numbers. Numbers are
/// written with as few digits as identify them (at most 17), independent of the locale.
class Text_buffer
{
public:
  explicit Text_buffer(std::ostream& os) : m_os(os) { m_text.reserve(CAPACITY + RESERVE); }

  ~Text_buffer() { flush(); }

  Text_buffer(const Text_buffer&) = delete;
  Text_buffer& operator=(const Text_buffer&) = delete;

  Text_buffer& operator<<(const char* text) { m_text += text; return checked(); }
  Text_buffer& operator<<(const std::string& text) { m_text += text; return checked(); }
  Text_buffer& operator<<(char c) { m_text += c; return checked(); }
  Text_buffer& operator<<(int i) { return number(i); }
  Text_buffer& operator<<(std::size_t i) { return number(i); }
  Text_buffer& operator<<(double x) { return number(x); }

  /// writes a number with a decimal point and with `E` before an exponent, as STEP demands
  Text_buffer& real(double x)
  {
    const std::size_t begin = m_text.size();
    number(x);
    const std::size_t exponent = m_text.find('e', begin);
    if(m_text.find('.', begin) == std::string::npos)
      m_text.insert((exponent == std::string::npos) ? m_text.size() : exponent, 1, '.');
    const std::size_t e = m_text.find('e', begin);
    if(e != std::string::npos)
      m_text[e] = 'E';
    return *this;
  }

  void flush()
  {
    m_os.write(m_text.data(), std::streamsize(m_text.size()));
    m_text.clear();
  }

private:
  static constexpr std::size_t CAPACITY = 1 << 16;
  static constexpr std::size_t RESERVE = 1 << 10;
  static constexpr std::size_t LONGEST_NUMBER = 32;

  // numbers are short: only texts can fill the buffer
  template <typename Number>
  Text_buffer& number(Number x)
  {
    char digits[LONGEST_NUMBER];
    const std::to_chars_result result = std::to_chars(digits, digits + LONGEST_NUMBER, x);
    m_text.append(digits, result.ptr);
    return *this;
  }

  Text_buffer& checked()
  {
    if(m_text.size() >= CAPACITY)
      flush();
    return *this;
  }

  std::ostream& m_os;
  std::string m_text;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_TEXT_BUFFER_H
