// SPDX-License-Identifier: GPL-3.0-or-later
//
// The scale is taken at one place, and compared with the scales of others: where they differ, the bar says
// where it holds.
#include "viewer/decoration/scale_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "viewer/picture/inks.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr double kSameScale = 1.05;  // the largest ratio of scales that a reader need not know of
constexpr int kParts = 4;

/// The middle, or the ground nearest below it: above it is the sky.
std::optional<Vec2> placeOfScale(const PictureGround& ground) {
  const Rect& frame = ground.frame();
  const double x = frame.left + frame.width / 2;
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const Vec2 pixel = {x, frame.top + frame.height * (0.5 + 0.5 * i / kSteps)};
    if (ground.lengthPerPixel(pixel)) return pixel;
  }
  return {};
}

bool isSameEverywhere(const PictureGround& ground, double scale) {
  if (ground.isPerspective()) return false;
  const Rect& frame = ground.frame();
  for (const double x : {0.02, 0.5, 0.98})
    for (const double y : {0.02, 0.5, 0.98}) {
      const auto other = ground.lengthPerPixel({frame.left + x * frame.width, frame.top + y * frame.height});
      // A parallel picture has one scale wherever it has ground at all.
      if (!other && ground.statesPixel()) continue;
      if (!other || *other > scale * kSameScale || *other * kSameScale < scale) return false;
    }
  return true;
}

}  // namespace

std::string lengthText(double length, bool isMetres, const std::string& unit) {
  if (!isMetres) return numberText(length) + (unit.empty() ? "" : " " + unit);
  // A hair of slack: 0.01 is often a little less.
  if (length >= 999.999) return numberText(length / 1000) + " km";
  if (length >= 0.999999) return numberText(length) + " m";
  if (length >= 0.00999999) return numberText(length * 100) + " cm";
  return numberText(length * 1000) + " mm";
}

std::optional<ScaleBar> scaleBarOf(const PictureGround& ground, double maxPixels) {
  const auto place = placeOfScale(ground);
  if (!place) return {};
  const double scale = *ground.lengthPerPixel(*place);
  if (!(scale > 0) || !std::isfinite(scale)) return {};
  ScaleBar bar;
  bar.length = roundDownNice(maxPixels * scale);
  bar.pixels = bar.length / scale;
  bar.label = lengthText(bar.length, ground.hasCrs(), ground.unitName());
  const Rect& frame = ground.frame();
  if (place->y > frame.top + frame.height * 0.51) {
    bar.where = "at the cross";
    bar.cross = *place;
  } else if (!isSameEverywhere(ground, scale)) {
    bar.where = "at the middle";
  }
  if (ground.statesPixel()) {
    const double rounded = std::strtod(fmt::format("{:.2e}", scale).c_str(), nullptr);
    bar.where = "1 pixel = " + lengthText(rounded, ground.hasCrs(), ground.unitName()) +
                (bar.where.empty() ? "" : " " + bar.where);
  }
  return bar;
}

Vec2 scaleBarSize(const Canvas& canvas, const ScaleBar& bar, double textSize) {
  const TextStyle style = {.size = textSize};
  const double zero = canvas.textWidth("0", style), label = canvas.textWidth(bar.label, style);
  const double width = zero / 2 + bar.pixels + label / 2;
  return {std::max(width, canvas.textWidth(bar.where, style)), textSize * (bar.where.empty() ? 1.9 : 3.1)};
}

void drawScaleBar(Canvas& canvas, const ScaleBar& bar, Vec2 corner, double textSize) {
  const TextStyle style = {.size = textSize, .color = kInk};
  const double left = corner.x + canvas.textWidth("0", style) / 2, thickness = std::max(4.0, textSize * 0.45);
  const double top = corner.y + textSize * 1.3;
  for (int i = 0; i < kParts; ++i)
    canvas.fill({left + bar.pixels * i / kParts, top, bar.pixels / kParts, thickness},
                i % 2 == 0 ? kInk : Rgb{255, 255, 255});
  canvas.frame({left, top, bar.pixels, thickness}, {.color = kInk, .width = 1});
  const double baseline = corner.y + textSize;
  canvas.text("0", {left, baseline}, {.size = textSize, .color = kInk, .horizontal = Align::center});
  canvas.text(bar.label, {left + bar.pixels, baseline},
              {.size = textSize, .color = kInk, .horizontal = Align::center});
  if (!bar.where.empty()) canvas.text(bar.where, {corner.x, top + thickness + textSize * 1.1}, style);
  if (!bar.cross) return;
  const Vec2 c = *bar.cross;
  for (const auto& [color, width] : {std::pair{Rgb{255, 255, 255}, 3.5}, {kInk, 1.5}}) {
    canvas.line({c.x - 7, c.y}, {c.x + 7, c.y}, {.color = color, .width = width});
    canvas.line({c.x, c.y - 7}, {c.x, c.y + 7}, {.color = color, .width = width});
  }
}

}  // namespace arete
