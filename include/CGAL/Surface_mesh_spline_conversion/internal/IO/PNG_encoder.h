// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_PNG_ENCODER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_PNG_ENCODER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

typedef std::vector<unsigned char> Bytes;

// The checksum of the chunks of a PNG file (PNG specification, annex D).
inline std::uint32_t crc32(const Bytes& data)
{
  std::uint32_t crc = 0xffffffffu;
  for(const unsigned char byte : data)
  {
    crc ^= byte;
    for(int bit = 0; bit < 8; ++bit)
      crc = (crc >> 1) ^ ((crc & 1u) ? 0xedb88320u : 0u);
  }
  return ~crc;
}

// The checksum of a zlib stream (RFC 1950, section 9).
inline std::uint32_t adler32(const Bytes& data)
{
  const std::uint32_t prime = 65521;
  std::uint32_t a = 1, b = 0;
  for(const unsigned char byte : data)
  {
    a = (a + byte) % prime;
    b = (b + a) % prime;
  }
  return (b << 16) | a;
}

inline void append_big_endian(Bytes& bytes, std::uint32_t value)
{
  for(int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<unsigned char>(value >> shift));
}

// Compresses with one block of fixed Huffman codes (RFC 1951, section 3.2.6). Repetitions are found
// through a table of the last position of each hash of three bytes.
class Deflate_encoder
{
public:
  static Bytes encode(const Bytes& data)
  {
    Deflate_encoder encoder;
    encoder.put_bits(1, 1); // the last block
    encoder.put_bits(1, 2); // fixed codes
    encoder.put_data(data);
    encoder.put_literal(256); // end of the block
    encoder.flush();
    return encoder.m_bytes;
  }

private:
  static constexpr std::size_t minimum_match = 3, maximum_match = 258, window = 32768;
  static constexpr int hash_bits = 15;

  void put_data(const Bytes& data)
  {
    const std::size_t none = data.size();
    std::vector<std::size_t> last_position(std::size_t(1) << hash_bits, none);
    std::size_t i = 0;
    while(i < data.size())
    {
      std::size_t length = 0, distance = 0;
      if(i + minimum_match <= data.size())
      {
        std::size_t& candidate = last_position[hash(data, i)];
        if(candidate != none && i - candidate <= window)
        {
          length = match_length(data, candidate, i);
          distance = i - candidate;
        }
        candidate = i;
      }
      if(length >= minimum_match)
      {
        put_match(length, distance);
        i += length;
      }
      else
        put_literal(data[i++]);
    }
  }

  static std::size_t hash(const Bytes& data, std::size_t i)
  {
    const std::uint32_t three = data[i] | (data[i + 1] << 8) | (data[i + 2] << 16);
    return (three * 2654435761u) >> (32 - hash_bits); // Knuth's multiplicative hash
  }

  static std::size_t match_length(const Bytes& data, std::size_t candidate, std::size_t i)
  {
    const std::size_t limit = (std::min)(maximum_match, data.size() - i);
    std::size_t length = 0;
    while(length < limit && data[candidate + length] == data[i + length])
      ++length;
    return length;
  }

  // bits are packed from the least significant one
  void put_bits(std::uint32_t bits, int count)
  {
    for(int i = 0; i < count; ++i)
    {
      m_byte |= ((bits >> i) & 1u) << m_count;
      if(++m_count == 8)
        flush();
    }
  }

  // Huffman codes are packed from their most significant bit
  void put_code(std::uint32_t code, int count)
  {
    for(int i = count - 1; i >= 0; --i)
      put_bits(code >> i, 1);
  }

  void put_literal(int symbol)
  {
    if(symbol < 144)
      put_code(0x30 + symbol, 8);
    else if(symbol < 256)
      put_code(0x190 + symbol - 144, 9);
    else if(symbol < 280)
      put_code(symbol - 256, 7);
    else
      put_code(0xc0 + symbol - 280, 8);
  }

  void put_match(std::size_t length, std::size_t distance)
  {
    // the symbols of lengths and distances grow in groups with one more extra bit each
    if(length == maximum_match)
      put_literal(285);
    else
    {
      const std::uint32_t value = static_cast<std::uint32_t>(length - minimum_match);
      const int extra = (value < 8) ? 0 : number_of_bits(value) - 3;
      put_literal(257 + 4 * extra + static_cast<int>(value >> extra));
      put_bits(value & ((1u << extra) - 1), extra);
    }
    const std::uint32_t value = static_cast<std::uint32_t>(distance - 1);
    const int extra = (value < 4) ? 0 : number_of_bits(value) - 2;
    put_code(2 * extra + (value >> extra), 5);
    put_bits(value & ((1u << extra) - 1), extra);
  }

  static int number_of_bits(std::uint32_t value)
  {
    int count = 0;
    for(; value != 0; value >>= 1)
      ++count;
    return count;
  }

  void flush()
  {
    if(m_count > 0)
      m_bytes.push_back(static_cast<unsigned char>(m_byte));
    m_byte = 0;
    m_count = 0;
  }

  Bytes m_bytes;
  std::uint32_t m_byte = 0;
  int m_count = 0;
};

// Makes the bytes of PNG files: 8 bits per channel, red, green, blue.
class PNG_encoder
{
public:
  // `pixels` are rows from top to bottom, three bytes per pixel
  static Bytes encode(std::size_t width, std::size_t height, const Bytes& pixels)
  {
    Bytes file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    Bytes header;
    append_big_endian(header, static_cast<std::uint32_t>(width));
    append_big_endian(header, static_cast<std::uint32_t>(height));
    for(const unsigned char byte : {8, 2, 0, 0, 0}) // bits, colour type RGB, no interlacing
      header.push_back(byte);
    append_chunk(file, "IHDR", header);

    const Bytes rows = filtered(3 * width, height, pixels);
    Bytes stream = {0x78, 0x01};
    const Bytes compressed = Deflate_encoder::encode(rows);
    stream.insert(stream.end(), compressed.begin(), compressed.end());
    append_big_endian(stream, adler32(rows));
    append_chunk(file, "IDAT", stream);
    append_chunk(file, "IEND", Bytes());
    return file;
  }

private:
  // each row as the difference to the row above (filter type 2): backgrounds become zeros
  static Bytes filtered(std::size_t row_size, std::size_t height, const Bytes& pixels)
  {
    Bytes rows;
    rows.reserve((row_size + 1) * height);
    for(std::size_t y = 0; y < height; ++y)
    {
      rows.push_back(2);
      for(std::size_t i = y * row_size; i < (y + 1) * row_size; ++i)
        rows.push_back(static_cast<unsigned char>(pixels[i] - (y ? pixels[i - row_size] : 0)));
    }
    return rows;
  }

  static void append_chunk(Bytes& file, const std::string& type, const Bytes& data)
  {
    append_big_endian(file, static_cast<std::uint32_t>(data.size()));
    Bytes chunk(type.begin(), type.end());
    chunk.insert(chunk.end(), data.begin(), data.end());
    file.insert(file.end(), chunk.begin(), chunk.end());
    append_big_endian(file, crc32(chunk));
  }
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_PNG_ENCODER_H
