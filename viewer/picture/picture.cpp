// SPDX-License-Identifier: GPL-3.0-or-later
//
// A thin coat over cairo: an image surface and its context, both released with the canvas. Text goes
// through cairo's toy interface, which finds DejaVu Sans by fontconfig; hinting is off, so that metrics scale
// evenly.
#include "viewer/picture/picture.h"

#include <cairo.h>
#include <fmt/core.h>

#include <numbers>
#include <utility>

#include "io/files/file_writer.h"

namespace arete {
namespace {

constexpr int kLargestSide = 32767;
constexpr std::size_t kSegmentsPerGroup = 512;  // one path of many segments costs more than linear time

double channel(std::uint8_t value) {
  return value / 255.0;
}

void setColor(cairo_t* cairo, Rgb color, double alpha) {
  cairo_set_source_rgba(cairo, channel(color.r), channel(color.g), channel(color.b), alpha);
}

void setStroke(cairo_t* cairo, const Stroke& stroke) {
  setColor(cairo, stroke.color, stroke.alpha);
  cairo_set_line_width(cairo, stroke.width);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  if (stroke.dash > 0) {
    cairo_set_dash(cairo, &stroke.dash, 1, 0);
  } else {
    cairo_set_dash(cairo, nullptr, 0, 0);
  }
}

void setFont(cairo_t* cairo, const TextStyle& style) {
  cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, style.size);
}

void trace(cairo_t* cairo, std::span<const Vec2> points) {
  cairo_new_path(cairo);
  for (const Vec2& p : points) cairo_line_to(cairo, p.x, p.y);
}

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

struct Canvas::Drawing {
  cairo_surface_t* surface = nullptr;
  cairo_t* cairo = nullptr;

  Drawing(int width, int height, cairo_format_t format)
      : surface(cairo_image_surface_create(format, width, height)), cairo(cairo_create(surface)) {
    // Without hinting, the extents of a text grow in proportion to its size.
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(cairo, options);
    cairo_font_options_destroy(options);
  }
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;
  ~Drawing() {
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
  }

  std::uint32_t* row(int y) const {
    unsigned char* data = cairo_image_surface_get_data(surface);
    return reinterpret_cast<std::uint32_t*>(data +
                                            std::ptrdiff_t(y) * cairo_image_surface_get_stride(surface));
  }
};

Canvas::Canvas(std::unique_ptr<Drawing> drawing) : drawing_(std::move(drawing)) {}
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;
Canvas::~Canvas() = default;

Result<Canvas> Canvas::make(int widthPixels, int heightPixels, bool isClear) {
  if (widthPixels < 1 || heightPixels < 1 || widthPixels > kLargestSide || heightPixels > kLargestSide) {
    return failure(ErrorCode::usage,
                   fmt::format("A picture of {} x {} pixels cannot be drawn; a side is 1 to {} pixels.",
                               widthPixels, heightPixels, kLargestSide));
  }
  auto drawing = std::make_unique<Drawing>(widthPixels, heightPixels,
                                           isClear ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24);
  // cairo never returns null: an object that could not be made is in a state of error.
  if (cairo_status(drawing->cairo) != CAIRO_STATUS_SUCCESS) {
    return failure(ErrorCode::unreadable,
                   fmt::format("A picture of {} x {} pixels cannot be made: {}.", widthPixels, heightPixels,
                               cairo_status_to_string(cairo_status(drawing->cairo))));
  }
  return Canvas(std::move(drawing));
}

Result<Canvas> Canvas::create(int widthPixels, int heightPixels, Rgb background) {
  ARETE_TRY(auto canvas, make(widthPixels, heightPixels, false));
  canvas.fill({0, 0, double(widthPixels), double(heightPixels)}, background);
  return canvas;
}

Result<Canvas> Canvas::createClear(int widthPixels, int heightPixels) {
  return make(widthPixels, heightPixels, true);
}

int Canvas::width() const {
  return cairo_image_surface_get_width(drawing_->surface);
}
int Canvas::height() const {
  return cairo_image_surface_get_height(drawing_->surface);
}

Rgb Canvas::pixel(int x, int y) const {
  // cairo may hold drawing back; after a flush the memory is the picture.
  cairo_surface_flush(drawing_->surface);
  const std::uint32_t value = drawing_->row(y)[x];
  return {std::uint8_t(value >> 16), std::uint8_t(value >> 8), std::uint8_t(value)};
}

Image Canvas::picture() const {
  cairo_surface_flush(drawing_->surface);
  Image image(width(), height());
  for (int y = 0; y < image.height; ++y) {
    const std::uint32_t* row = drawing_->row(y);
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = {std::uint8_t(row[x] >> 16), std::uint8_t(row[x] >> 8), std::uint8_t(row[x])};
  }
  return image;
}

std::vector<std::uint8_t> Canvas::premultipliedRgba() const {
  cairo_surface_flush(drawing_->surface);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(std::size_t(width()) * std::size_t(height()) * 4);
  for (int y = 0; y < height(); ++y) {
    const std::uint32_t* row = drawing_->row(y);
    for (int x = 0; x < width(); ++x)
      for (const int shift : {16, 8, 0, 24}) bytes.push_back(std::uint8_t(row[x] >> shift));
  }
  return bytes;
}

void Canvas::fill(const Rect& area, Rgb color, double alpha) {
  setColor(drawing_->cairo, color, alpha);
  cairo_rectangle(drawing_->cairo, area.left, area.top, area.width, area.height);
  cairo_fill(drawing_->cairo);
}

void Canvas::frame(const Rect& area, const Stroke& stroke) {
  setStroke(drawing_->cairo, stroke);
  cairo_rectangle(drawing_->cairo, area.left, area.top, area.width, area.height);
  cairo_stroke(drawing_->cairo);
}

void Canvas::fillPolygon(std::span<const Vec2> corners, Rgb color, double alpha) {
  trace(drawing_->cairo, corners);
  setColor(drawing_->cairo, color, alpha);
  cairo_fill(drawing_->cairo);
}

void Canvas::fillCircle(Vec2 center, double radius, Rgb color) {
  setColor(drawing_->cairo, color, 1);
  cairo_new_path(drawing_->cairo);
  cairo_arc(drawing_->cairo, center.x, center.y, radius, 0, 2 * std::numbers::pi);
  cairo_fill(drawing_->cairo);
}

void Canvas::line(Vec2 from, Vec2 to, const Stroke& stroke) {
  const Vec2 ends[] = {from, to};
  polyline(ends, stroke);
}

void Canvas::polyline(std::span<const Vec2> points, const Stroke& stroke) {
  trace(drawing_->cairo, points);
  setStroke(drawing_->cairo, stroke);
  cairo_stroke(drawing_->cairo);
}

void Canvas::segments(std::span<const Vec2> ends, const Stroke& stroke) {
  setStroke(drawing_->cairo, stroke);
  cairo_new_path(drawing_->cairo);
  // A full group is stroked at once; the last stroke draws what is left.
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    cairo_move_to(drawing_->cairo, ends[i].x, ends[i].y);
    cairo_line_to(drawing_->cairo, ends[i + 1].x, ends[i + 1].y);
    if ((i / 2 + 1) % kSegmentsPerGroup == 0) cairo_stroke(drawing_->cairo);
  }
  cairo_stroke(drawing_->cairo);
}

void Canvas::image(const Image& image, int left, int top) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height);
  if (cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS) {
    cairo_surface_flush(surface);
    unsigned char* data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    // A pixel of RGB24 is a 32-bit word with red in its upper byte; rows may be padded.
    for (int y = 0; y < image.height; ++y) {
      auto* row = reinterpret_cast<std::uint32_t*>(data + std::ptrdiff_t(y) * stride);
      for (int x = 0; x < image.width; ++x) {
        const Rgb c = image.at(x, y);
        row[x] = std::uint32_t(c.r) << 16 | std::uint32_t(c.g) << 8 | std::uint32_t(c.b);
      }
    }
    cairo_surface_mark_dirty(surface);
    cairo_set_source_surface(drawing_->cairo, surface, left, top);
    cairo_paint(drawing_->cairo);
  }
  cairo_surface_destroy(surface);
}

void Canvas::text(std::string_view utf8, Vec2 anchor, const TextStyle& style) {
  cairo_t* cairo = drawing_->cairo;
  setFont(cairo, style);
  const std::string terminated(utf8);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, terminated.c_str(), &extents);
  // Digits and capitals are what is centred: by their height, not by the letters that happen to hang below.
  const double capHeight = 0.73 * style.size;
  const double shiftX = style.horizontal == Align::start    ? 0
                        : style.horizontal == Align::center ? -extents.x_advance / 2
                                                            : -extents.x_advance;
  const double shiftY = style.vertical == Align::start    ? capHeight
                        : style.vertical == Align::center ? capHeight / 2
                                                          : 0;
  cairo_save(cairo);
  cairo_translate(cairo, anchor.x, anchor.y);
  cairo_rotate(cairo, -style.turnDegrees * std::numbers::pi / 180);
  if (style.halo > 0) {
    cairo_move_to(cairo, shiftX, shiftY);
    cairo_text_path(cairo, terminated.c_str());
    setStroke(cairo, {.color = {255, 255, 255}, .width = 2 * style.halo, .alpha = 0.85});
    cairo_stroke(cairo);
  }
  cairo_move_to(cairo, shiftX, shiftY);
  setColor(cairo, style.color, 1);
  cairo_show_text(cairo, terminated.c_str());
  cairo_restore(cairo);
  cairo_new_path(cairo);
}

double Canvas::textWidth(std::string_view utf8, const TextStyle& style) const {
  setFont(drawing_->cairo, style);
  cairo_text_extents_t extents;
  cairo_text_extents(drawing_->cairo, std::string(utf8).c_str(), &extents);
  return extents.x_advance;
}

void Canvas::clip(const Rect& area) {
  cairo_rectangle(drawing_->cairo, area.left, area.top, area.width, area.height);
  cairo_clip(drawing_->cairo);
}

void Canvas::unclip() {
  cairo_reset_clip(drawing_->cairo);
}

Status Canvas::savePng(const std::filesystem::path& path) const {
  std::string bytes;
  const cairo_status_t encoded = cairo_surface_write_to_png_stream(drawing_->surface, append, &bytes);
  if (encoded != CAIRO_STATUS_SUCCESS) {
    return failure(ErrorCode::unreadable,
                   fmt::format("The picture cannot be encoded: {}.", cairo_status_to_string(encoded)),
                   path.string());
  }
  ARETE_TRY(auto writer, FileWriter::create(path));
  writer.write(bytes);
  return writer.finish();
}

}  // namespace arete
