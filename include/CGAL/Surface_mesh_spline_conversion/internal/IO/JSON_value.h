// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_JSON_VALUE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_JSON_VALUE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// is thrown by the functions of this file, and caught by the readers that use them.
struct JSON_error : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

// A JSON document. The accessors throw a JSON_error that names the line of the value if it is not
// of the kind asked for.
class JSON_value
{
public:
  typedef std::size_t size_type;

  enum Kind { NIL, BOOLEAN, NUMBER, STRING, ARRAY, OBJECT };

  Kind kind = NIL;
  size_type line = 0;
  bool boolean = false;
  double number = 0;
  std::string string;
  std::vector<JSON_value> items;
  std::vector<std::string> names; // of the items of an object

  // returns the member with this name, or a null pointer.
  const JSON_value* find(const std::string& name) const
  {
    require(OBJECT, "an object");
    for(size_type i = 0; i < names.size(); ++i)
      if(names[i] == name)
        return &items[i];
    return nullptr;
  }

  const JSON_value& at(const std::string& name) const
  {
    const JSON_value* value = find(name);
    if(!value)
      throw JSON_error(place() + "\"" + name + "\" is missing");
    return *value;
  }

  const std::vector<JSON_value>& as_array() const
  {
    require(ARRAY, "an array");
    return items;
  }

  const std::string& as_string() const
  {
    require(STRING, "a string");
    return string;
  }

  double as_number() const
  {
    require(NUMBER, "a number");
    return number;
  }

  size_type as_index() const
  {
    const double largest_index = 9007199254740992.; // beyond, a double is not every integer
    if(as_number() < 0 || number != std::floor(number) || number > largest_index)
      throw JSON_error(place() + "a natural number is expected");
    return static_cast<size_type>(number);
  }

  // returns an array of numbers; of the given size unless this is 0.
  std::vector<double> as_numbers(size_type size = 0) const
  {
    require(ARRAY, "an array of numbers");
    if(size != 0 && items.size() != size)
      throw JSON_error(place() + "an array of " + std::to_string(size) + " numbers is expected");
    std::vector<double> result;
    result.reserve(items.size());
    for(const JSON_value& item : items)
      result.push_back(item.as_number());
    return result;
  }

  // returns the begin of a message about this value.
  std::string place() const { return "line " + std::to_string(line) + ": "; }

private:
  void require(Kind required_kind, const char* name) const
  {
    if(kind != required_kind)
      throw JSON_error(place() + name + " is expected");
  }
};

// A parser of JSON (RFC 8259). Strings keep their hexadecimal escapes: no name or file of this
// package needs them.
class JSON_parser
{
  typedef JSON_value::size_type size_type;

public:
  explicit JSON_parser(const std::string& text) : m_text(text) {}

  JSON_value operator()()
  {
    JSON_value value = parse_value(0);
    skip_white_space();
    if(m_position != m_text.size())
      fail("text follows the end of the document");
    return value;
  }

private:
  // deeper nesting than any format of this package has, yet safe for the stack
  static constexpr int maximum_depth = 64;

  JSON_value parse_value(int depth)
  {
    if(depth > maximum_depth)
      fail("arrays or objects are nested too deeply");
    skip_white_space();
    JSON_value value;
    value.line = m_line;
    switch(peek())
    {
      case '{': parse_object(value, depth); break;
      case '[': parse_array(value, depth); break;
      case '"':
        value.kind = JSON_value::STRING;
        value.string = parse_string();
        break;
      case 't': parse_word("true", JSON_value::BOOLEAN, value); value.boolean = true; break;
      case 'f': parse_word("false", JSON_value::BOOLEAN, value); break;
      case 'n': parse_word("null", JSON_value::NIL, value); break;
      default: parse_number(value);
    }
    return value;
  }

  void parse_object(JSON_value& value, int depth)
  {
    value.kind = JSON_value::OBJECT;
    ++m_position;
    if(skip_if('}'))
      return;
    do
    {
      skip_white_space();
      if(peek() != '"')
        fail("a name in quotation marks is expected");
      value.names.push_back(parse_string());
      if(!skip_if(':'))
        fail("':' is expected");
      value.items.push_back(parse_value(depth + 1));
    }
    while(skip_if(','));
    if(!skip_if('}'))
      fail("',' or '}' is expected");
  }

  void parse_array(JSON_value& value, int depth)
  {
    value.kind = JSON_value::ARRAY;
    ++m_position;
    if(skip_if(']'))
      return;
    do
      value.items.push_back(parse_value(depth + 1));
    while(skip_if(','));
    if(!skip_if(']'))
      fail("',' or ']' is expected");
  }

  std::string parse_string()
  {
    std::string result;
    for(++m_position; peek() != '"'; ++m_position)
    {
      if(peek() == '\n')
        fail("a string is not closed");
      if(peek() == '\\')
      {
        ++m_position;
        switch(peek())
        {
          case 'n': result += '\n'; continue;
          case 't': result += '\t'; continue;
          case 'r': result += '\r'; continue;
          case 'b': result += '\b'; continue;
          case 'f': result += '\f'; continue;
          case 'u': result += '\\'; break;
        }
      }
      result += peek();
    }
    ++m_position;
    return result;
  }

  void parse_word(const std::string& word, JSON_value::Kind kind, JSON_value& value)
  {
    if(m_text.compare(m_position, word.size(), word) != 0)
      fail("a value is expected");
    m_position += word.size();
    value.kind = kind;
  }

  void parse_number(JSON_value& value)
  {
    const char* const begin = m_text.data() + m_position;
    const char* const end = m_text.data() + m_text.size();
    const auto result = std::from_chars(begin, end, value.number);
    if(result.ec == std::errc::invalid_argument)
      fail("a value is expected");
    if(result.ec == std::errc::result_out_of_range || !std::isfinite(value.number))
      fail("a number is not in the range of double precision");
    m_position += static_cast<size_type>(result.ptr - begin);
    value.kind = JSON_value::NUMBER;
  }

  char peek() const
  {
    if(m_position >= m_text.size())
      fail("the text ends unexpectedly");
    return m_text[m_position];
  }

  bool skip_if(char c)
  {
    skip_white_space();
    if(peek() != c)
      return false;
    ++m_position;
    return true;
  }

  void skip_white_space()
  {
    while(m_position < m_text.size()
          && (m_text[m_position] == ' ' || m_text[m_position] == '\t'
              || m_text[m_position] == '\r' || m_text[m_position] == '\n'))
    {
      if(m_text[m_position] == '\n')
        ++m_line;
      ++m_position;
    }
  }

  [[noreturn]] void fail(const std::string& what) const
  {
    throw JSON_error("line " + std::to_string(m_line) + ": " + what);
  }

  const std::string& m_text;
  size_type m_position = 0;
  size_type m_line = 1;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_JSON_VALUE_H
