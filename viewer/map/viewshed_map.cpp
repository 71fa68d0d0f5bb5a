// SPDX-License-Identifier: GPL-3.0-or-later
//
// A pixel shows the sample nearest to its centre: a viewshed is an answer for samples, and mixed answers have
// no meaning.
#include "viewer/map/viewshed_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/picture/hillshade.h"
#include "viewer/map/map_page.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr Rgb kSeen = {255, 176, 32}, kShade = {38, 44, 62}, kUnknown = {60, 120, 220};

Rgb cellColor(Rgb ground, ViewshedCell cell) {
  switch (cell) {
    case ViewshedCell::seen:
      return mix(ground, kSeen, 0.55);
    case ViewshedCell::hidden:
      return mix(ground, kShade, 0.45);
    case ViewshedCell::unknown:
    case ViewshedCell::undecided:
      return mix(ground, kUnknown, 0.5);
    default:
      return ground;
  }
}

std::uint32_t nearest(double v, std::uint32_t count) {
  return static_cast<std::uint32_t>(std::clamp(std::round(v), 0.0, count - 1.0));
}

}  // namespace

Result<Canvas> drawViewshedMap(const RasterHeightfield& field, const Viewshed& viewshed, Vec2 observer,
                               const ViewshedMapOptions& options) {
  std::vector<std::string> caption = options.caption;
  const double cells = static_cast<double>(viewshed.seen + viewshed.hidden + viewshed.unknown);
  caption.push_back(fmt::format("{} of {} samples are seen, {:.1f} %", countText(viewshed.seen),
                                countText(static_cast<std::size_t>(cells)),
                                100 * static_cast<double>(viewshed.seen) / std::max(1.0, cells)));
  ARETE_TRY(auto page, makeMapPage(field.columns, field.rows, field.georeference,
                                   {.width = options.width, .title = options.title, .caption = caption}));
  const MapView& view = page.view;
  Image image = drawHillshade(field, view, {.tint = 0});
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Vec2 at = view.toGrid(x + 0.5, y + 0.5);
      const std::size_t sample =
          std::size_t{nearest(at.y, field.rows)} * field.columns + nearest(at.x, field.columns);
      image.at(x, y) = cellColor(image.at(x, y), viewshed.cells[sample]);
    }
  page.canvas.image(image, int(page.map.left), int(page.map.top));
  page.canvas.frame(page.map, {.color = kInk, .width = 1});
  const Vec2 dot = page.toPage(observer.x, observer.y);
  page.canvas.fillCircle(dot, 9, {255, 255, 255});
  page.canvas.fillCircle(dot, 6, {200, 30, 40});
  return std::move(page.canvas);
}

}  // namespace arete
