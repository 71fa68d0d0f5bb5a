// SPDX-License-Identifier: GPL-3.0-or-later
//
// The arrow turns about the middle of a square, so that its words stay where they are.
#include "viewer/decoration/north_arrow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer/picture/inks.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr double kSameDirection = 2;        // degrees that a reader need not know of
constexpr double kSmallConvergence = 0.05;  // degrees
constexpr double kArrowRoom = 3.4;          // in sizes of the text

bool turnsOverThePicture(const PictureGround& ground, Vec2 toNorth) {
  const Rect& frame = ground.frame();
  for (const double x : {0.02, 0.98})
    for (const double y : {0.02, 0.98}) {
      const auto other = ground.northAt({frame.left + x * frame.width, frame.top + y * frame.height});
      if (!other) continue;
      const double cosine = std::clamp(dot(other->toNorth, toNorth), -1.0, 1.0);
      if (std::acos(cosine) * 180 / std::numbers::pi > kSameDirection) return true;
    }
  return false;
}

}  // namespace

std::optional<NorthArrow> northArrowOf(const PictureGround& ground) {
  const Rect& frame = ground.frame();
  std::optional<PictureGround::North> north;
  constexpr int kSteps = 32;
  for (int i = 0; i < kSteps && !north; ++i)
    north =
        ground.northAt({frame.left + frame.width / 2, frame.top + frame.height * (0.5 + 0.5 * i / kSteps)});
  if (!north) return {};
  NorthArrow arrow{north->toNorth, {north->isTrue ? "true north" : "grid north"}};
  const bool turns = !ground.isPerspective() && north->isTrue && turnsOverThePicture(ground, north->toNorth);
  if (turns) arrow.words.emplace_back("at the middle");
  const double off = north->convergenceDegrees;
  if (north->isTrue && std::abs(off) >= kSmallConvergence)
    arrow.words.push_back(
        fmt::format("grid north {:.1f}\u00b0 {}", std::abs(off), off > 0 ? "east of it" : "west of it"));
  return arrow;
}

Vec2 northArrowSize(const Canvas& canvas, const NorthArrow& arrow, double textSize) {
  double width = 0;
  for (const std::string& line : arrow.words)
    width = std::max(width, canvas.textWidth(line, {.size = textSize}));
  return {(kArrowRoom + 0.4) * textSize + width,
          std::max(kArrowRoom, 1.3 * double(arrow.words.size())) * textSize};
}

void drawNorthArrow(Canvas& canvas, const NorthArrow& arrow, Vec2 corner, double textSize) {
  const double height = northArrowSize(canvas, arrow, textSize).y, reach = textSize * 1.05;
  const Vec2 center = {corner.x + kArrowRoom * textSize / 2, corner.y + height / 2};
  const Vec2 n = arrow.toNorth, across = {-n.y, n.x};
  const auto at = [&](double along, double aside) {
    return center + n * (along * reach) + across * (aside * reach);
  };
  const Vec2 dark[] = {at(0.8, 0), at(-1.1, -0.6), at(-0.7, 0)};
  const Vec2 light[] = {at(0.8, 0), at(-0.7, 0), at(-1.1, 0.6)};
  const Vec2 outline[] = {at(0.8, 0), at(-1.1, -0.6), at(-0.7, 0), at(-1.1, 0.6), at(0.8, 0)};
  canvas.fillPolygon(dark, kInk);
  canvas.fillPolygon(light, {255, 255, 255});
  canvas.polyline(outline, {.color = kInk, .width = 1});
  canvas.text("N", at(1.35, 0),
              {.size = textSize,
               .color = kInk,
               .bold = true,
               .horizontal = Align::center,
               .vertical = Align::center});
  const double first = corner.y + height / 2 - 0.65 * textSize * double(arrow.words.size());
  for (std::size_t i = 0; i < arrow.words.size(); ++i)
    canvas.text(arrow.words[i],
                {corner.x + (kArrowRoom + 0.4) * textSize, first + 1.3 * textSize * (double(i) + 0.5)},
                {.size = textSize, .color = kInk, .vertical = Align::center});
}

}  // namespace arete
