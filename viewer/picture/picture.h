// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "viewer/color/rgb.h"

namespace arete {

/// Pixels, row-major from the top left.
struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  Image() = default;
  Image(int widthPixels, int heightPixels, Rgb fill = {255, 255, 255})
      : width(widthPixels),
        height(heightPixels),
        pixels(std::size_t(widthPixels) * std::size_t(heightPixels), fill) {}

  Rgb& at(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  Rgb at(int x, int y) const { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

/// A rectangle of the picture, in pixels; y grows downwards.
struct Rect {
  double left = 0, top = 0, width = 0, height = 0;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

struct Stroke {
  Rgb color = {};
  double width = 1;  ///< pixels
  double alpha = 1;
  double dash = 0;  ///< length of a dash and of a gap, pixels; 0 = a whole line
};

enum class Align { start, center, end };

struct TextStyle {
  double size = 16;  ///< pixels
  Rgb color = {40, 44, 52};
  bool bold = false;
  Align horizontal = Align::start;  ///< of the text about its anchor
  Align vertical = Align::end;      ///< start = hangs below the anchor, center, end = stands on it (baseline)
  double turnDegrees = 0;           ///< counter-clockwise about the anchor
  double halo = 0;                  ///< width of a white border, pixels: text on a picture needs one
};

/// A picture to draw on: antialiased lines, areas, text and images, saved as PNG. Text is UTF-8, in DejaVu
/// Sans. The same calls give the same pixels and the same file. Drawing outside the canvas is clipped.
class Canvas {
 public:
  /// Errors: usage, when a side is not 1..32767 pixels (what cairo can draw); unreadable, when there is no
  /// memory.
  static Result<Canvas> create(int widthPixels, int heightPixels, Rgb background = {255, 255, 255});
  /// Without a background, to be laid over another picture. pixel() shows it over black. Errors: as create().
  static Result<Canvas> createClear(int widthPixels, int heightPixels);

  Canvas(Canvas&&) noexcept;
  Canvas& operator=(Canvas&&) noexcept;
  ~Canvas();

  int width() const;
  int height() const;
  /// Precondition: 0 <= x < width(), 0 <= y < height().
  Rgb pixel(int x, int y) const;
  /// All pixels, as they are drawn. O(pixels).
  Image picture() const;
  /// Red, green, blue (multiplied by the opacity) and opacity of each pixel, row-major from the top left.
  /// O(pixels).
  std::vector<std::uint8_t> premultipliedRgba() const;

  void fill(const Rect& area, Rgb color, double alpha = 1);
  void frame(const Rect& area, const Stroke& stroke);
  void fillPolygon(std::span<const Vec2> corners, Rgb color, double alpha = 1);
  void fillCircle(Vec2 center, double radius, Rgb color);
  void line(Vec2 from, Vec2 to, const Stroke& stroke);
  void polyline(std::span<const Vec2> points, const Stroke& stroke);
  /// Many separate lines, ends[2i] to ends[2i + 1], drawn in groups: where lines of a group cross, their
  /// alpha does not add up.
  void segments(std::span<const Vec2> ends, const Stroke& stroke);
  /// One picture pixel per image pixel.
  void image(const Image& image, int left, int top);

  void text(std::string_view utf8, Vec2 anchor, const TextStyle& style = {});
  /// Width of a text before it is turned, in pixels.
  double textWidth(std::string_view utf8, const TextStyle& style) const;

  /// Drawing is confined to `area` until unclip(). Not nested.
  void clip(const Rect& area);
  void unclip();

  /// Writes a PNG under a temporary name and renames it. Errors: those of FileWriter.
  Status savePng(const std::filesystem::path& path) const;

 private:
  struct Drawing;
  explicit Canvas(std::unique_ptr<Drawing> drawing);
  static Result<Canvas> make(int widthPixels, int heightPixels, bool isClear);
  std::unique_ptr<Drawing> drawing_;
};

}  // namespace arete
