// SPDX-License-Identifier: GPL-3.0-or-later
//
// The layout is computed from the top down: title, map, caption; the page is made as high as they need.
#include "viewer/map/map_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/decoration/graticule.h"
#include "viewer/decoration/north_arrow.h"
#include "viewer/decoration/scale_bar.h"
#include "viewer/picture/inks.h"

namespace arete {
namespace {

constexpr int kSmallestWidth = 640;
constexpr double kMargin = 40;
constexpr double kTitleSize = 26, kCaptionSize = 15.5, kLineHeight = 24;
constexpr double kScaleBarRoom = 230;
constexpr double kFurnitureText = 13, kFurnitureHeight = 64, kGap = 26;
constexpr double kLegendGap = 24;
constexpr LegendStyle kLegendStyle = {.textSize = 13.5, .barHeight = 260};
constexpr double kTallest = 0.8;  // of the map, in widths of the room it has

/// Smaller, if need be, so that it ends within `room`.
void writeFitted(Canvas& canvas, const std::string& text, Vec2 anchor, double room, TextStyle style) {
  // Advances are rounded at every size, so a scaled text does not scale exactly: ask again.
  for (double width = canvas.textWidth(text, style); width > room; width = canvas.textWidth(text, style)) {
    style.size *= room / width * 0.995;
  }
  canvas.text(text, anchor, style);
}

/// Scale bar and north arrow, which stand below the map at its right.
struct Furniture {
  std::optional<ScaleBar> bar;
  std::optional<NorthArrow> north;
  Vec2 barSize = {}, northSize = {};

  double width() const { return barSize.x + (bar && north ? kGap : 0) + northSize.x; }
};

Furniture furnitureOf(const PictureGround& ground, const Canvas& ruler) {
  Furniture f{scaleBarOf(ground, kScaleBarRoom), northArrowOf(ground)};
  if (f.bar) f.barSize = scaleBarSize(ruler, *f.bar, kFurnitureText);
  if (f.north) f.northSize = northArrowSize(ruler, *f.north, kFurnitureText);
  return f;
}

}  // namespace

void MapPage::finish() {
  if (isDecorated) {
    const double size = std::clamp(map.width / 100, 10.0, 13.0);
    const auto lines = graticuleOf(ground, std::max(120.0, map.width / 7));
    drawGraticuleLines(canvas, ground, lines);
    drawGraticuleLabels(canvas, ground, lines, {}, size);
  }
  canvas.frame(map, {.color = kInk, .width = 1});
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
  const bool hasLegends = options.isDecorated && !options.legends.empty();
  const double legendWidth =
      hasLegends ? std::ceil(legendSize(options.legends, kLegendStyle).x + kLegendGap) : 0;
  const double side = options.sideWidth + legendWidth;
  const int room = options.width - int(2 * kMargin + side);
  const MapView view = fitGrid(columns, rows, georeference, room, int(room * kTallest));
  const Rect map = {kMargin, above, double(view.width), double(view.height)};
  const auto width = std::max(kSmallestWidth, int(view.width + 2 * kMargin + side));
  PictureGround ground = PictureGround::ofMap(view, georeference, {map.left, map.top});
  ARETE_TRY(auto ruler, Canvas::create(1, 1));
  const Furniture furniture = options.isDecorated ? furnitureOf(ground, ruler) : Furniture{};
  // The caption stands beside the furniture where both fit, else below it.
  double longest = 0;
  for (const std::string& text : options.caption) {
    longest = std::max(longest, ruler.textWidth(text, {.size = kCaptionSize}));
  }
  const double furnitureHeight = options.isDecorated ? kFurnitureHeight : 0;
  const double captionTop = longest > view.width - furniture.width() - kGap ? furnitureHeight : 0;
  const double captionHeight = 30 + kLineHeight * double(options.caption.size());
  const double footer = std::max(furnitureHeight, captionTop + captionHeight);
  const double legendBottom = hasLegends ? map.top + legendSize(options.legends, kLegendStyle).y : 0;
  ARETE_TRY(auto canvas,
            Canvas::create(width, int(std::max(map.bottom() + footer, legendBottom) + kMargin / 2)));

  MapPage page{std::move(canvas),
               view,
               map,
               {map.right(), map.top, double(options.sideWidth), map.height},
               std::move(ground),
               options.isDecorated};
  if (hasLegends)
    page.scales = drawLegends(page.canvas, options.legends,
                              {map.right() + options.sideWidth + kLegendGap, map.top}, kLegendStyle);
  const double textRoom = width - 2 * kMargin;
  writeFitted(page.canvas, options.title, {kMargin, kMargin + 18}, textRoom,
              {.size = kTitleSize, .color = kInk, .bold = true});
  for (std::size_t i = 0; i < options.caption.size(); ++i) {
    writeFitted(page.canvas, options.caption[i],
                {kMargin, map.bottom() + captionTop + 32 + kLineHeight * double(i)}, textRoom,
                {.size = kCaptionSize, .color = i == 0 ? kInk : kQuietInk});
  }
  double right = std::max(map.right(), kMargin + furniture.width());
  const double top = map.bottom() + 12;
  if (furniture.north) {
    right -= furniture.northSize.x;
    drawNorthArrow(page.canvas, *furniture.north, {right, top}, kFurnitureText);
    right -= kGap;
  }
  if (furniture.bar)
    drawScaleBar(page.canvas, *furniture.bar, {right - furniture.barSize.x, top}, kFurnitureText);
  return page;
}

}  // namespace arete
