// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_RASTER_IMAGE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_RASTER_IMAGE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/IO/PNG_encoder.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

typedef std::array<unsigned char, 3> Color;

// Returns the rows of the 5 x 7 picture of a character, the leftmost pixel in bit 4. There are
// digits, capital letters (also used for small letters), and the signs of numbers.
inline std::array<unsigned char, 7> glyph(char c)
{
  static const char* const characters = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ.-+:,/=()%<";
  static const unsigned char rows[][7] = {
    {14, 17, 19, 21, 25, 17, 14}, {4, 12, 4, 4, 4, 4, 14},      {14, 17, 1, 2, 4, 8, 31},
    {31, 2, 4, 2, 1, 17, 14},     {2, 6, 10, 18, 31, 2, 2},     {31, 16, 30, 1, 1, 17, 14},
    {6, 8, 16, 30, 17, 17, 14},   {31, 1, 2, 4, 8, 8, 8},       {14, 17, 17, 14, 17, 17, 14},
    {14, 17, 17, 15, 1, 2, 12},   {14, 17, 17, 31, 17, 17, 17}, {30, 17, 17, 30, 17, 17, 30},
    {14, 17, 16, 16, 16, 17, 14}, {30, 17, 17, 17, 17, 17, 30}, {31, 16, 16, 30, 16, 16, 31},
    {31, 16, 16, 30, 16, 16, 16}, {14, 17, 16, 23, 17, 17, 15}, {17, 17, 17, 31, 17, 17, 17},
    {14, 4, 4, 4, 4, 4, 14},      {7, 2, 2, 2, 2, 18, 12},      {17, 18, 20, 24, 20, 18, 17},
    {16, 16, 16, 16, 16, 16, 31}, {17, 27, 21, 21, 17, 17, 17}, {17, 25, 21, 19, 17, 17, 17},
    {14, 17, 17, 17, 17, 17, 14}, {30, 17, 17, 30, 16, 16, 16}, {14, 17, 17, 17, 21, 18, 13},
    {30, 17, 17, 30, 20, 18, 17}, {15, 16, 16, 14, 1, 1, 30},   {31, 4, 4, 4, 4, 4, 4},
    {17, 17, 17, 17, 17, 17, 14}, {17, 17, 17, 17, 17, 10, 4},  {17, 17, 17, 21, 21, 27, 17},
    {17, 17, 10, 4, 10, 17, 17},  {17, 17, 10, 4, 4, 4, 4},     {31, 1, 2, 4, 8, 16, 31},
    {0, 0, 0, 0, 0, 12, 12},      {0, 0, 0, 31, 0, 0, 0},       {0, 4, 4, 31, 4, 4, 0},
    {0, 12, 12, 0, 12, 12, 0},    {0, 0, 0, 0, 12, 4, 8},       {1, 1, 2, 4, 8, 16, 16},
    {0, 0, 31, 0, 31, 0, 0},      {2, 4, 8, 8, 8, 4, 2},        {8, 4, 2, 2, 2, 4, 8},
    {24, 25, 2, 4, 8, 19, 3},     {2, 4, 8, 16, 8, 4, 2}};

  const char upper = (c >= 'a' && c <= 'z') ? static_cast<char>(c - 'a' + 'A') : c;
  std::array<unsigned char, 7> result = {{0, 0, 0, 0, 0, 0, 0}};
  for(std::size_t i = 0; characters[i] != '\0'; ++i)
    if(characters[i] == upper)
      std::copy(rows[i], rows[i] + 7, result.begin());
  return result;
}

// A picture with three bytes per pixel, rows from top to bottom.
class Raster_image
{
public:
  Raster_image(std::size_t width, std::size_t height, const Color& background)
    : m_width(width), m_height(height)
  {
    m_pixels.reserve(3 * width * height);
    for(std::size_t i = 0; i < width * height; ++i)
      m_pixels.insert(m_pixels.end(), background.begin(), background.end());
  }

  std::size_t width() const { return m_width; }
  std::size_t height() const { return m_height; }

  Color pixel(std::size_t x, std::size_t y) const
  {
    const std::size_t i = 3 * (y * m_width + x);
    return {{m_pixels[i], m_pixels[i + 1], m_pixels[i + 2]}};
  }

  // pixels outside of the picture are ignored
  void set_pixel(std::size_t x, std::size_t y, const Color& color)
  {
    if(x < m_width && y < m_height)
      std::copy(color.begin(), color.end(), m_pixels.begin() + 3 * (y * m_width + x));
  }

  void fill_rectangle(std::size_t x0, std::size_t y0, std::size_t width, std::size_t height,
                      const Color& color)
  {
    for(std::size_t y = y0; y < y0 + height; ++y)
      for(std::size_t x = x0; x < x0 + width; ++x)
        set_pixel(x, y, color);
  }

  // writes with characters of 6 x 8 pixels times `scale`
  void draw_text(std::size_t x0, std::size_t y0, const std::string& text, const Color& color,
                 std::size_t scale = 2)
  {
    for(std::size_t i = 0; i < text.size(); ++i)
    {
      const std::array<unsigned char, 7> rows = glyph(text[i]);
      for(std::size_t row = 0; row < 7; ++row)
        for(std::size_t column = 0; column < 5; ++column)
          if((rows[row] >> (4 - column)) & 1)
            fill_rectangle(x0 + scale * (6 * i + column), y0 + scale * row, scale, scale, color);
    }
  }

  // copies `image` so that its upper left pixel comes to (x0, y0)
  void paste(const Raster_image& image, std::size_t x0, std::size_t y0)
  {
    for(std::size_t y = 0; y < image.height(); ++y)
      for(std::size_t x = 0; x < image.width(); ++x)
        set_pixel(x0 + x, y0 + y, image.pixel(x, y));
  }

  // returns the picture in half the size, each pixel the mean of four
  Raster_image half_size() const
  {
    Raster_image result(m_width / 2, m_height / 2, Color{{0, 0, 0}});
    for(std::size_t y = 0; y < result.height(); ++y)
      for(std::size_t x = 0; x < result.width(); ++x)
      {
        Color mean;
        for(std::size_t c = 0; c < 3; ++c)
        {
          const unsigned sum = pixel(2 * x, 2 * y)[c] + pixel(2 * x + 1, 2 * y)[c]
                             + pixel(2 * x, 2 * y + 1)[c] + pixel(2 * x + 1, 2 * y + 1)[c];
          mean[c] = static_cast<unsigned char>(sum / 4);
        }
        result.set_pixel(x, y, mean);
      }
    return result;
  }

  Bytes PNG() const { return PNG_encoder::encode(m_width, m_height, m_pixels); }

  bool write_PNG(const std::string& filename) const
  {
    const Bytes bytes = PNG();
    std::ofstream out(filename, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
    return out.flush().good();
  }

private:
  std::size_t m_width, m_height;
  Bytes m_pixels;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_RASTER_IMAGE_H
