// Pictures: the PNG bytes are decoded again by an own inflater that is written from the standard
// (RFC 1951), and the z-buffer shows the nearer of two triangles.

#include <CGAL/Surface_mesh_spline_conversion/IO/PNG.h>

#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;
using SC::internal::Bytes;
using SC::internal::Color;
using SC::internal::Raster_image;

// decodes blocks of fixed Huffman codes only
class Inflater
{
public:
  explicit Inflater(const Bytes& bytes) : m_bytes(bytes) {}

  Bytes decode()
  {
    assert(bits(1) == 1 && bits(2) == 1);
    static const int length_base[] = {3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27,
                                      31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
    static const int length_extra[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                       2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
    static const int distance_base[] = {1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129,
                                        193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097,
                                        6145, 8193, 12289, 16385, 24577};
    Bytes out;
    for(int s = symbol(); s != 256; s = symbol())
    {
      if(s < 256)
      {
        out.push_back(static_cast<unsigned char>(s));
        continue;
      }
      int length = length_base[s - 257] + bits(length_extra[s - 257]);
      const int d = reversed_bits(5);
      const std::size_t distance = distance_base[d] + bits(d < 4 ? 0 : d / 2 - 1);
      assert(distance <= out.size());
      for(; length > 0; --length)
        out.push_back(out[out.size() - distance]);
    }
    return out;
  }

private:
  int bit() { const int b = (m_bytes[m_i / 8] >> (m_i % 8)) & 1; ++m_i; return b; }
  int bits(int n) { int r = 0; for(int i = 0; i < n; ++i) r |= bit() << i; return r; }
  int reversed_bits(int n) { int r = 0; for(int i = 0; i < n; ++i) r = 2 * r + bit(); return r; }

  int symbol()
  {
    int code = reversed_bits(7);
    if(code <= 23)
      return 256 + code;
    code = 2 * code + bit();
    if(code >= 48 && code <= 191)
      return code - 48;
    if(code >= 192 && code <= 199)
      return 280 + code - 192;
    code = 2 * code + bit();
    return 144 + code - 400;
  }

  const Bytes& m_bytes;
  std::size_t m_i = 0;
};

void test_deflate()
{
  std::mt19937 random(1);
  for(std::size_t size : {0, 1, 2, 3, 300, 70000})
    for(unsigned alphabet : {1u, 3u, 256u})
    {
      Bytes data(size);
      for(unsigned char& byte : data)
        byte = static_cast<unsigned char>(random() % alphabet);
      for(std::size_t i = size / 2; i < size; ++i) // a far repetition of every length
        data[i] = (i % 517 == 0) ? data[i] : data[i - size / 2];
      const Bytes code = SC::internal::Deflate_encoder::encode(data);
      assert(Inflater(code).decode() == data);
    }
}

std::uint32_t number(const Bytes& bytes, std::size_t i)
{
  return (std::uint32_t(bytes[i]) << 24) | (bytes[i + 1] << 16) | (bytes[i + 2] << 8) | bytes[i + 3];
}

void test_PNG()
{
  // published check values of the two checksums
  const std::string digits = "123456789", wikipedia = "Wikipedia";
  assert(SC::internal::crc32(Bytes(digits.begin(), digits.end())) == 0xcbf43926u);
  assert(SC::internal::adler32(Bytes(wikipedia.begin(), wikipedia.end())) == 0x11e60398u);

  Raster_image image(37, 21, Color{{10, 20, 30}});
  image.draw_text(1, 2, "D=1.5E-06", Color{{200, 0, 0}}, 1);
  const Bytes file = image.PNG();
  assert(number(file, 16) == 37 && number(file, 20) == 21);
  const std::size_t begin = 8 + 25; // signature and header
  const std::size_t size = number(file, begin);
  const Bytes stream(file.begin() + begin + 8 + 2, file.begin() + begin + 8 + size - 4);
  Bytes rows = Inflater(stream).decode();
  assert(rows.size() == 21 * (1 + 3 * 37));
  for(std::size_t y = 0; y < 21; ++y)
    for(std::size_t i = 0; i < 3 * 37; ++i)
    {
      unsigned char& byte = rows[y * 112 + 1 + i];
      byte = static_cast<unsigned char>(byte + (y ? rows[(y - 1) * 112 + 1 + i] : 0));
      assert(byte == image.pixel(i / 3, y)[i % 3]);
    }
}

void test_visibility()
{
  SC::Picture_scene scene;
  scene.shading = SC::Picture_scene::Shading::VALUES;
  scene.points = {{{-1, -1, 0}}, {{1, -1, 0}}, {{0, 1, 0}}, {{-1, -1, 1}}, {{1, -1, 1}}, {{0, 1, 1}}};
  scene.normals.assign(6, {{0, 0, 1}});
  scene.values = {-1, -1, -1, 1, 1, 1};
  scene.triangles = {{{3, 4, 5}}, {{0, 1, 2}}};
  SC::Picture_view top, bottom;
  top.azimuth = bottom.azimuth = -90; // x to the right
  top.elevation = 90;
  bottom.elevation = -90;
  top.width = bottom.width = top.height = bottom.height = 100;
  const Raster_image from_above = SC::internal::Scene_painter(scene, top).paint();
  const Raster_image from_below = SC::internal::Scene_painter(scene, bottom).paint();
  const Color above = from_above.pixel(50, 50), below = from_below.pixel(50, 50);
  assert(above[0] > 150 && above[2] < 100); // red: the triangle with the value +1
  assert(below[2] > 150 && below[0] < 100); // blue

  scene.marks.push_back({{{0, 0, 0}}, {{0, 255, 0}}, 3.});
  const Color hidden = SC::internal::Scene_painter(scene, top).paint().pixel(50, 50);
  const Color seen = SC::internal::Scene_painter(scene, bottom).paint().pixel(50, 50);
  assert(hidden == above);
  assert((seen == Color{{0, 255, 0}}));
}

void test_odd_scenes()
{
  const double nan = std::nan("");
  SC::Picture_scene scene;
  assert(CGAL::IO::write_PNG("empty.png", scene));
  scene.points = {{{0, 0, 0}}, {{0, 0, 0}}, {{nan, 0, 1e300}}};
  scene.normals.assign(3, {{0, 0, 0}});
  scene.triangles = {{{0, 1, 2}}, {{0, 0, 0}}};
  scene.lines.push_back({{{0, 0, 0}}, {{nan, 1e300, 0}}, {{0, 0, 0}}, 1.});
  scene.marks.push_back({{{nan, 0, 0}}, {{0, 0, 0}}, 1.});
  scene.marks.push_back({{{1e300, 0, 0}}, {{0, 0, 0}}, 1.});
  assert(CGAL::IO::write_PNG("odd.png", scene));
  assert(!CGAL::IO::write_PNG("no/such/folder/picture.png", scene));
  std::remove("empty.png");
  std::remove("odd.png");
}

int main()
{
  test_deflate();
  test_PNG();
  test_visibility();
  test_odd_scenes();
  return EXIT_SUCCESS;
}
