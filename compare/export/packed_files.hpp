// Files that other programs read packed: a picture as PNG, an archive as ZIP. The only file of this folder that knows
// zlib is packed_files.cpp.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace soilbin::compare {

/// A picture of 8 bits a channel.
struct RgbPicture {
  int width = 0;                                  ///< [pixels]
  std::vector<std::array<unsigned char, 3>> rgb;  ///< red, green, blue; by rows from the top, each from the left
};

/// The picture as a PNG file (W3C, Portable Network Graphics, 2003): true colour, 8 bits, its values as they are. Equal
/// pictures give equal bytes. Throws std::runtime_error where zlib fails.
std::string rgb_png(const RgbPicture& picture);

/// A file in an archive.
struct PackedFile {
  std::string name;  ///< with '/' between folders
  std::string content;
};

/// The files as a ZIP archive (PKWARE APPNOTE 6.3), deflated, all of 1 January 1980: equal files give equal bytes.
/// Throws std::runtime_error for a file of 4 GiB or more, and where zlib fails.
std::string zip_of(const std::vector<PackedFile>& files);

}  // namespace soilbin::compare
