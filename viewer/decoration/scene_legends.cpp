// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/decoration/scene_legends.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <ranges>
#include <string>

#include "viewer/picture/ticks.h"

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

ColorLegend legendOf(const TriangleInk& ink) {
  ColorLegend legend{.title = ink.title, .unit = ink.unit};
  if (!ink.ticks.empty())
    legend.scale = LegendScale{
        .map = ink.colors, .low = ink.colors.low(), .high = ink.colors.high(), .ticks = ink.ticks};
  for (const Legend::Entry& entry : ink.classes)
    legend.classes.push_back({{laidOver(entry.color, {255, 255, 255})}, entry.label, entry.mark});
  return legend;
}

std::vector<ColorLegend> SceneLegends::of(const ViewSettings& settings, std::span<const Layer> layers) const {
  std::vector<ColorLegend> legends;
  const TerrainModel* model = subject_->heights() ? &subject_->heights()->model() : nullptr;
  const std::string unit = model ? model->georeference.verticalUnit : "";
  for (const Layer& layer : layers | std::views::reverse) {
    if (!layer.isVisible) continue;
    if (const auto* lines = std::get_if<Contours>(&layer.content); lines && layer.legend.entries.empty()) {
      const auto every = [&](const char* which, double interval) {
        return fmt::format("{}, every {}{}", which, numberText(interval), unit.empty() ? "" : " " + unit);
      };
      legends.push_back(
          {.title = "",
           .classes = {{{Contours::kInk}, every("contours", lines->interval), Legend::Mark::line},
                       {{Contours::kInk}, every("where close", 5 * lines->interval), Legend::Mark::line}}});
    }
    if (layer.legend.entries.empty()) continue;
    const std::string& title = layer.legend.title.empty() ? layer.name : layer.legend.title;
    // The areas of a layer follow its lines under one heading.
    if (legends.empty() || legends.back().title != title) legends.push_back({.title = title});
    for (const Legend::Entry& entry : layer.legend.entries) {
      Rgba color = entry.color;
      color.a = std::uint8_t(std::lround(color.a * std::clamp(layer.opacity, 0.0, 1.0)));
      legends.back().classes.push_back({{laidOver(color, {255, 255, 255})}, entry.label, entry.mark});
    }
  }
  const ViewLook& look = settings.look;
  if (look.coloring == Coloring::ink) {
    if (const auto ink = subject_->ink(look.ink)) legends.push_back(legendOf(**ink));
    return legends;
  }
  if (!look.colors && !usual_) usual_ = model ? usualColors(*model) : TerrainColors();
  ColorLegend ground =
      legendOf(look.coloring, look.colors ? *look.colors : *usual_, unit, look.heatError, settings.pixels);
  // Directions are the grid's, which true north is beside.
  if (look.coloring == Coloring::aspect && model && !model->georeference.crsWkt.empty() &&
      !model->georeference.isGeographic)
    ground.title = "aspect: slopes down to the grid's";
  if (ground.scale || !ground.classes.empty()) legends.push_back(std::move(ground));
  return legends;
}

}  // namespace arete
