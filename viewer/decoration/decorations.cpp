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

  std::vector<GraticuleLine> lines;
  if (decorations.graticule)
    lines = graticuleOf(ground, std::max(70.0, (ground.isPerspective() ? 1.6 : 1) * kSpacing * size));
  drawGraticuleLines(canvas, ground, lines);

  // From the lower right corner to the left: the legends, the scale bar, the north arrow.
  std::vector<Rect> taken;
  double right = frame.right() - margin;
  const auto panelOf = [&](Vec2 room) -> std::optional<Vec2> {
    const double width = room.x + 2 * pad, height = room.y + pad;
    const Rect panel = {right - width, frame.bottom() - margin - height, width, height};
    if (panel.left < frame.left + margin || panel.top < frame.top + margin) return {};
    drawPanel(canvas, panel);
    taken.push_back(panel);
    right = panel.left - margin / 2;
    return Vec2{panel.left + pad, panel.top + pad / 2};
  };
  if (decorations.legend) {
    const LegendStyle style = {.textSize = size,
                               .barHeight = std::min(frame.height * 0.35, size * 12),
                               .maxHeight = frame.height * 0.7};
    // The last legends have no room in a small picture.
    while (!legends.empty() && legendSize(legends, style).y > frame.height * 0.85)
      legends = legends.first(legends.size() - 1);
    const Vec2 room = legendSize(legends, style);
    if (!legends.empty() && room.x <= frame.width * 0.5)
      if (const auto corner = panelOf(room)) drawLegends(canvas, legends, *corner, style);
  }
  if (decorations.scaleBar)
    if (const auto bar = scaleBarOf(ground, std::min(frame.width * 0.25, size * 14)))
      if (const auto corner = panelOf(scaleBarSize(canvas, *bar, size)))
        drawScaleBar(canvas, *bar, *corner, size);
  if (decorations.north)
    if (const auto arrow = northArrowOf(ground))
      if (const auto corner = panelOf(northArrowSize(canvas, *arrow, size)))
        drawNorthArrow(canvas, *arrow, *corner, size);
  drawGraticuleLabels(canvas, ground, lines, taken, 0.85 * size);
}

}  // namespace arete
