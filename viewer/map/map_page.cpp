// SPDX-License-Identifier: GPL-3.0-or-later
//
// The layout is computed from the top down: title, map, caption; the page is made as high as they need.
#include "viewer/map/map_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr int kSmallestWidth = 640;
constexpr double kMargin = 40;
constexpr double kTitleSize = 26, kCaptionSize = 15.5, kLineHeight = 24;
constexpr double kScaleBarRoom = 230;
constexpr double kFurnitureWidth = 330, kFurnitureHeight = 64;
constexpr double kTallest = 0.8;  // of the map, in widths of the room it has

/// Smaller, if need be, so that it ends within `room`.
void writeFitted(Canvas& canvas, const std::string& text, Vec2 anchor, double room, TextStyle style) {
  // Advances are rounded at every size, so a scaled text does not scale exactly: ask again.
  for (double width = canvas.textWidth(text, style); width > room; width = canvas.textWidth(text, style)) {
    style.size *= room / width * 0.995;
  }
  canvas.text(text, anchor, style);
}

void drawNorthArrow(Canvas& canvas, Vec2 center, Vec2 north) {
  const Vec2 across = {-north.y, north.x};
  const auto at = [&](double along, double aside) {
    return Vec2{center.x + north.x * along + across.x * aside, center.y + north.y * along + across.y * aside};
  };
  const Vec2 dark[] = {at(13, 0), at(-11, -7), at(-6, 0)};
  const Vec2 light[] = {at(13, 0), at(-6, 0), at(-11, 7)};
  const Vec2 outline[] = {at(13, 0), at(-11, -7), at(-6, 0), at(-11, 7), at(13, 0)};
  canvas.fillPolygon(dark, kInk);
  canvas.fillPolygon(light, {255, 255, 255});
  canvas.polyline(outline, {.color = kInk, .width = 1});
  canvas.text(
      "N", at(23, 0),
      {.size = 14, .color = kInk, .bold = true, .horizontal = Align::center, .vertical = Align::center});
}

}  // namespace

void drawScaleBar(Canvas& canvas, Vec2 right, double maxWidth, double groundPerPixel, bool metres) {
  const double length = roundDownNice(maxWidth * groundPerPixel);
  const double width = length / groundPerPixel;
  const Vec2 left = {right.x - width, right.y};
  const int parts = 4;
  for (int i = 0; i < parts; ++i) {
    const Rect part = {left.x + width * i / parts, left.y - 3, width / parts, 6};
    canvas.fill(part, i % 2 == 0 ? kInk : Rgb{255, 255, 255});
  }
  canvas.frame({left.x, left.y - 3, width, 6}, {.color = kInk, .width = 1});
  const std::string label = !metres          ? numberText(length) + " units"
                            : length >= 1000 ? numberText(length / 1000) + " km"
                                             : numberText(length) + " m";
  canvas.text("0", {left.x, left.y - 9}, {.size = 13, .color = kInk, .horizontal = Align::center});
  canvas.text(label, {left.x + width, left.y - 9}, {.size = 13, .color = kInk, .horizontal = Align::center});
}

Result<MapPage> makeMapPage(std::uint32_t columns, std::uint32_t rows, const Georeference& georeference,
                            const MapPageOptions& options) {
  if (options.width < kSmallestWidth) {
    return failure(ErrorCode::usage,
                   fmt::format("A page {} pixels wide has no room for a map; take {} or more.", options.width,
                               kSmallestWidth));
  }
  if (columns < 2 || rows < 2) {
    return failure(ErrorCode::degenerate,
                   fmt::format("A grid of {} x {} samples has no area to draw.", columns, rows));
  }
  const double above = kMargin + (options.title.empty() ? 0 : 40);
  const double side = options.sideWidth;
  const int room = options.width - int(2 * kMargin + side);
  const MapView view = fitGrid(columns, rows, georeference, room, int(room * kTallest));
  const Rect map = {kMargin, above, double(view.width), double(view.height)};
  const auto width = std::max(kSmallestWidth, int(view.width + 2 * kMargin + side));
  // The caption stands beside the furniture where both fit, else below it.
  ARETE_TRY(auto ruler, Canvas::create(1, 1));
  double longest = 0;
  for (const std::string& text : options.caption) {
    longest = std::max(longest, ruler.textWidth(text, {.size = kCaptionSize}));
  }
  const double captionTop = longest > view.width - kFurnitureWidth ? kFurnitureHeight : 0;
  const double captionHeight = 30 + kLineHeight * double(options.caption.size());
  const double footer = std::max(kFurnitureHeight, captionTop + captionHeight);
  ARETE_TRY(auto canvas, Canvas::create(width, int(map.bottom() + footer + kMargin / 2)));

  MapPage page{std::move(canvas), view, map, {map.right(), map.top, side, map.height}};
  const double textRoom = width - 2 * kMargin;
  writeFitted(page.canvas, options.title, {kMargin, kMargin + 18}, textRoom,
              {.size = kTitleSize, .color = kInk, .bold = true});
  for (std::size_t i = 0; i < options.caption.size(); ++i) {
    writeFitted(page.canvas, options.caption[i],
                {kMargin, map.bottom() + captionTop + 32 + kLineHeight * double(i)}, textRoom,
                {.size = kCaptionSize, .color = i == 0 ? kInk : kQuietInk});
  }
  const auto north = northInView(view, georeference);
  const double right = std::max(map.right(), kMargin + kFurnitureWidth);
  if (north) drawNorthArrow(page.canvas, {right - 14, map.bottom() + 42}, *north);
  drawScaleBar(page.canvas, {right - (north ? 62 : 34), map.bottom() + 44}, kScaleBarRoom,
               view.groundPerPixel, !georeference.crsWkt.empty());
  return page;
}

}  // namespace arete
