// SPDX-License-Identifier: GPL-3.0-or-later
//
// Panels are placed first, then the labels of the graticule where no panel is.
#include "viewer/decoration/decorations.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "viewer/decoration/graticule.h"
#include "viewer/decoration/north_arrow.h"
#include "viewer/decoration/scale_bar.h"
#include "viewer/picture/inks.h"

namespace arete {
namespace {

constexpr double kPanelAlpha = 0.82;
constexpr double kLeastSide = 60;  // of a picture that has room for anything, pixels
constexpr double kSpacing = 9;     // of the lines of a graticule, in sizes of the text

void drawPanel(Canvas& canvas, const Rect& panel) {
  canvas.fill(panel, {255, 255, 255}, kPanelAlpha);
}

}  // namespace

double decorationTextSize(const Rect& frame) {
  return std::clamp(std::min(frame.width, frame.height) / 56, 9.5, 20.0);
}

void decorate(Canvas& canvas, const PictureGround& ground, std::span<const ColorLegend> legends,
              const Decorations& decorations) {
  const Rect& frame = ground.frame();
  if (std::min(frame.width, frame.height) < kLeastSide) return;
  const double size = decorationTextSize(frame), pad = size * 0.7, margin = size * 0.6;
  const auto fits = [&](Vec2 room) { return room.x <= frame.width * 0.6 && room.y <= frame.height * 0.75; };

  std::vector<GraticuleLine> lines;
  if (decorations.graticule)
    lines = graticuleOf(ground, std::max(70.0, (ground.isPerspective() ? 1.6 : 1) * kSpacing * size));
  drawGraticuleLines(canvas, ground, lines);

  std::vector<Rect> taken;
  double left = frame.left + margin;
  const auto lowerLeft = [&](Vec2 room) {
    const Rect panel = {left, frame.bottom() - margin - room.y - pad, room.x + 2 * pad, room.y + pad};
    drawPanel(canvas, panel);
    taken.push_back(panel);
    left = panel.right() + margin / 2;
    return Vec2{panel.left + pad, panel.top + pad / 2};
  };
  if (decorations.scaleBar)
    if (const auto bar = scaleBarOf(ground, std::min(frame.width * 0.25, size * 14)))
      if (const Vec2 room = scaleBarSize(canvas, *bar, size); fits(room))
        drawScaleBar(canvas, *bar, lowerLeft(room), size);
  if (decorations.north)
    if (const auto arrow = northArrowOf(ground))
      if (const Vec2 room = northArrowSize(canvas, *arrow, size);
          fits(room) && left + room.x + 2 * pad < frame.left + frame.width * 0.75)
        drawNorthArrow(canvas, *arrow, lowerLeft(room), size);
  if (decorations.legend && !legends.empty()) {
    const LegendStyle style = {.textSize = size,
                               .barHeight = std::min(frame.height * 0.35, size * 12),
                               .maxHeight = frame.height * 0.7};
    const Vec2 room = legendSize(legends, style);
    if (room.x <= frame.width * 0.5 && room.y <= frame.height * 0.8) {
      const double panelLeft = frame.right() - margin - room.x - 2 * pad;
      // Above the other panels where both do not fit beside each other.
      const double below = panelLeft < left ? taken.empty() ? 0 : taken.front().height + margin : 0;
      const Rect panel = {panelLeft, frame.bottom() - margin - below - room.y - pad, room.x + 2 * pad,
                          room.y + pad};
      if (panel.top >= frame.top) {
        drawPanel(canvas, panel);
        taken.push_back(panel);
        drawLegends(canvas, legends, {panel.left + pad, panel.top + pad / 2}, style);
      }
    }
  }
  drawGraticuleLabels(canvas, ground, lines, taken, 0.85 * size);
}

}  // namespace arete
