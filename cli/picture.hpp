// A drawing, which is made as SVG, in other formats: PNG and PDF. The only file that knows librsvg is picture.cpp.
#pragma once

#include <string>

namespace soilbin::cli {

/// The drawing as a PNG file, two pixels a unit of the drawing. Throws std::runtime_error where it can't be drawn.
std::string png_of(const std::string& svg);

/// The drawing as a PDF file of one page, of the drawing's size. Throws as png_of.
std::string pdf_of(const std::string& svg);

}  // namespace soilbin::cli
