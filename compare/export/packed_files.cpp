#include "compare/export/packed_files.hpp"

#include <zlib.h>

#include <algorithm>
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

/// A number of `bytes` bytes, the lowest first.
std::string little_endian(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>((value >> (8 * i)) & 0xffU);
  return text;
}

/// Without the header of zlib, as archives have it.
std::string raw_deflated(const std::string& plain) {
  z_stream stream{};
  constexpr int no_header = -15, memory = 8;
  if (::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, no_header, memory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib could not begin to compress a file");
  std::string packed(::deflateBound(&stream, static_cast<uLong>(plain.size())), '\0');
  stream.next_in = const_cast<Bytef*>(bytes_of(plain));  // zlib only reads it
  stream.avail_in = static_cast<uInt>(plain.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int status = ::deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  ::deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib could not compress a file");
  return packed;
}

}  // namespace

std::string zip_of(const std::vector<PackedFile>& files) {
  constexpr std::uint64_t needed = 20, by_unix = 3 << 8, deflated = 8, utf8 = 1 << 11, first_day = 0x21;
  constexpr std::uint64_t plain_file = 0100644;  // to be read by everyone, as Unix tells it
  std::string archive, directory;
  for (const PackedFile& file : files) {
    const std::string packed = raw_deflated(file.content);
    if (std::max(file.content.size(), packed.size()) > 0xfffffffeU)
      throw std::runtime_error(file.name + " is too large for an archive");
    const std::string about = little_endian(utf8, 2) + little_endian(deflated, 2) + little_endian(0, 2) +
                              little_endian(first_day, 2) + little_endian(crc_of(file.content), 4) +
                              little_endian(packed.size(), 4) + little_endian(file.content.size(), 4) +
                              little_endian(file.name.size(), 2) + little_endian(0, 2);
    directory += "PK\x01\x02" + little_endian(by_unix | needed, 2) + little_endian(needed, 2) + about +
                 little_endian(0, 6) + little_endian(plain_file << 16, 4) + little_endian(archive.size(), 4) +
                 file.name;
    archive += "PK\x03\x04" + little_endian(needed, 2) + about + file.name + packed;
  }
  const std::uint64_t begin = archive.size();
  return archive + directory + "PK\x05\x06" + little_endian(0, 4) + little_endian(files.size(), 2) +
         little_endian(files.size(), 2) + little_endian(directory.size(), 4) + little_endian(begin, 4) +
         little_endian(0, 2);
}

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
