// Files that other programs read packed: a picture as PNG. The only file of this folder that knows zlib is
// packed_files.cpp.
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

}  // namespace soilbin::compare
