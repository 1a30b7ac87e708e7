#include "cli/picture.hpp"

#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/core.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace soilbin::cli {
namespace {

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* owned) const {
    Free(owned);
  }
};

using Handle = std::unique_ptr<RsvgHandle, Freed<g_object_unref>>;
using Canvas = std::unique_ptr<cairo_surface_t, Freed<cairo_surface_destroy>>;
using Pen = std::unique_ptr<cairo_t, Freed<cairo_destroy>>;

[[noreturn]] void cannot_draw(GError* error) {
  const std::unique_ptr<GError, Freed<g_error_free>> owned(error);
  throw std::runtime_error(fmt::format("the drawing can't be made: {}", owned ? owned->message : "no reason is told"));
}

void check_status(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("the drawing can't be made: {}", cairo_status_to_string(status)));
}

/// A drawing that was read, and its size in its own units.
struct Drawing {
  Handle handle;
  double width = 0, height = 0;
};

Drawing read_drawing(const std::string& svg) {
  GError* error = nullptr;
  Drawing drawing;
  drawing.handle.reset(rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
  if (!drawing.handle) cannot_draw(error);
  if (!rsvg_handle_get_intrinsic_size_in_pixels(drawing.handle.get(), &drawing.width, &drawing.height))
    throw std::runtime_error("the drawing can't be made: it has no size");
  return drawing;
}

void draw(const Drawing& drawing, cairo_surface_t* canvas, double scale) {
  const Pen pen(cairo_create(canvas));
  cairo_scale(pen.get(), scale, scale);
  const RsvgRectangle whole{0, 0, drawing.width, drawing.height};
  GError* error = nullptr;
  if (!rsvg_handle_render_document(drawing.handle.get(), pen.get(), &whole, &error)) cannot_draw(error);
  check_status(cairo_status(pen.get()));
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string png_of(const std::string& svg) {
  constexpr double pixels = 2;  // a unit: sharp on a screen of today, and in print at a third of its width
  const Drawing drawing = read_drawing(svg);
  const Canvas canvas(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                 static_cast<int>(std::ceil(pixels * drawing.width)),
                                                 static_cast<int>(std::ceil(pixels * drawing.height))));
  draw(drawing, canvas.get(), pixels);
  std::string bytes;
  check_status(cairo_surface_write_to_png_stream(canvas.get(), append, &bytes));
  return bytes;
}

std::string pdf_of(const std::string& svg) {
  constexpr double points = 0.75;  // a unit: 96 of them are an inch, as are 72 points
  const Drawing drawing = read_drawing(svg);
  std::string bytes;
  const Canvas canvas(
      cairo_pdf_surface_create_for_stream(append, &bytes, points * drawing.width, points * drawing.height));
  draw(drawing, canvas.get(), points);
  cairo_surface_finish(canvas.get());
  check_status(cairo_surface_status(canvas.get()));
  return bytes;
}

}  // namespace soilbin::cli
