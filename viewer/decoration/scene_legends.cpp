// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/decoration/scene_legends.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <ranges>
#include <string>

#include "engine/base/vec.h"

namespace arete {
namespace {

/// As the painter takes it where nothing is stated.
TerrainColors usualColors(const TerrainModel& model) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) {
    const double z = model.mt.vertices().height(VertexId(v));
    low = std::min(low, z);
    high = std::max(high, z);
  }
  return low <= high ? TerrainColors::over(low, high) : TerrainColors();
}

}  // namespace

ColorLegend legendOf(Coloring coloring, const TerrainColors& colors, const std::string& unit,
                     double heatError, double heatPixels) {
  switch (coloring) {
    case Coloring::height:
      return legendOf(colors.heights, "height", unit);
    case Coloring::slope:
      return legendOf(colors.slopes, "slope", "degrees");
    case Coloring::aspect: {
      ColorLegend legend = legendOf(colors.aspects, "aspect: slopes down to the");
      if (legend.scale)
        legend.scale->ticks = {{0, "north"}, {90, "east"}, {180, "south"}, {270, "west"}, {360, "north"}};
      return legend;
    }
    case Coloring::error:
      return heatError > 0 ? legendOf(colors.errors.over(0, heatError), "error", unit)
                           : legendOf(colors.errors.over(0, heatPixels), "error", "pixels");
    default:
      return {};
  }
}

std::vector<ColorLegend> SceneLegends::of(const ViewSettings& settings, std::span<const Layer> layers) const {
  std::vector<ColorLegend> legends;
  for (const Layer& layer : layers | std::views::reverse) {
    if (!layer.isVisible || layer.legend.entries.empty()) continue;
    ColorLegend legend{.title = layer.legend.title.empty() ? layer.name : layer.legend.title};
    for (const Legend::Entry& entry : layer.legend.entries)
      legend.classes.push_back({{laidOver(entry.color, {255, 255, 255})}, entry.label});
    legends.push_back(std::move(legend));
  }
  const ViewLook& look = settings.look;
  const TerrainModel* model = subject_->heights() ? &subject_->heights()->model() : nullptr;
  if (!look.colors && !usual_) usual_ = model ? usualColors(*model) : TerrainColors();
  ColorLegend ground =
      legendOf(look.coloring, look.colors ? *look.colors : *usual_,
               model ? model->georeference.verticalUnit : "", look.heatError, settings.pixels);
  if (ground.scale || !ground.classes.empty()) legends.push_back(std::move(ground));
  return legends;
}

}  // namespace arete
