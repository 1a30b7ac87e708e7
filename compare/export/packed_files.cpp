#include "compare/export/packed_files.hpp"

#include <zlib.h>

#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace soilbin::compare {
namespace {

const Bytef* bytes_of(std::string_view text) { return reinterpret_cast<const Bytef*>(text.data()); }

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(::crc32(0, bytes_of(bytes), static_cast<uInt>(bytes.size())));
}

std::string big_endian(std::uint32_t value) {
  std::string four;
  for (int shift = 24; shift >= 0; shift -= 8) four += static_cast<char>((value >> shift) & 0xffU);
  return four;
}

std::string png_chunk(const std::string& kind, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + kind + data + big_endian(crc_of(kind + data));
}

std::string in_zlib(const std::string& plain) {
  uLongf size = ::compressBound(static_cast<uLong>(plain.size()));
  std::string packed(size, '\0');
  if (::compress(reinterpret_cast<Bytef*>(packed.data()), &size, bytes_of(plain), static_cast<uLong>(plain.size())) !=
      Z_OK)
    throw std::runtime_error("zlib could not compress a picture");
  packed.resize(size);
  return packed;
}

}  // namespace

std::string rgb_png(const RgbPicture& picture) {
  const auto width = static_cast<std::size_t>(picture.width), height = picture.rgb.size() / width;
  std::string rows;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    if (i % width == 0) rows += '\0';  // this row is not filtered
    for (const unsigned char channel : picture.rgb[i]) rows += static_cast<char>(channel);
  }
  const std::string eight_bits_true_colour("\x08\x02\x00\x00\x00", 5);
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR", big_endian(static_cast<std::uint32_t>(width)) +
                               big_endian(static_cast<std::uint32_t>(height)) + eight_bits_true_colour) +
         png_chunk("IDAT", in_zlib(rows)) + png_chunk("IEND", "");
}

}  // namespace soilbin::compare
