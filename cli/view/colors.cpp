// SPDX-License-Identifier: GPL-3.0-or-later
//
// A ramp by name is stretched over the range of the data, or over the range stated; a ramp from a file states
// values itself, so a range is for its per cent alone. What would have no effect is refused.
#include "cli/view/colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/criterion.h"

namespace arete {
namespace {

std::string namesOfTables() {
  std::vector<std::string_view> names;
  for (const ColorTable& table : colorTables()) names.push_back(table.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::optional<ColorsBetween> betweenNamed(const std::string& name) {
  if (name == "linear") return ColorsBetween::linear;
  if (name == "discrete") return ColorsBetween::discrete;
  if (name == "nearest") return ColorsBetween::nearest;
  if (name == "exact") return ColorsBetween::exact;
  return std::nullopt;
}

tl::unexpected<Error> refusal(const std::string& option, const std::string& sentence) {
  return failure(ErrorCode::usage, sentence, option);
}

struct ColoredRange {
  double low = 0, high = 0;
};

}  // namespace

void ColorArguments::addTo(CLI::App& command, const std::string& group, OptionKinds& kinds) {
  kinds.ofTerrain(
      command
          .add_option(
              "--ramp", ramp,
              fmt::format("Colours of heights, slopes or aspects: {}, or a file of gdaldem, QGIS or GRASS",
                          namesOfTables()))
          ->type_name("NAME|FILE")
          ->group(group));
  kinds.ofTerrain(
      command
          .add_option("--ramp-mode", mode,
                      "What lies between the ramp's colours (default: as its file says, else linear)")
          ->check(oneOf({"linear", "nearest", "exact", "discrete"}))
          ->type_name("NAME")
          ->group(group));
  kinds.ofTerrain(command
                      .add_option("--range", range,
                                  "Values of the ramp's first and last colour, or of 0% and 100% in its file "
                                  "(default: of the heights)")
                      ->type_name("LOW,HIGH")
                      ->group(group));
  seaOption = kinds.ofTerrain(
      command
          .add_option(
              "--sea-level", seaLevel,
              "Height at and below which the ground has colours of water, in the DEM's unit of height")
          ->check(finiteBetween(-1e6, 1e6))
          ->type_name("H")
          ->group(group));
}

bool ColorArguments::isStated() const {
  return !ramp.empty() || !mode.empty() || !range.empty() || (seaOption && seaOption->count() > 0);
}

std::string ColorArguments::wordOfSea(const std::string& coloring, const TerrainModel& model) const {
  if (isStated() || (!coloring.empty() && coloring != "height")) return {};
  constexpr double kMuch = 0.05;
  std::uint32_t zeros = 0;
  const std::uint32_t count = model.mt.vertexCount();
  bool hasLand = false;
  for (std::uint32_t v = 0; v < count; ++v) {
    const double height = model.mt.vertices().height(VertexId(v));
    zeros += height == 0 ? 1 : 0;
    hasLand = hasLand || height > 0;
  }
  if (!hasLand || zeros < kMuch * count) return {};
  return fmt::format(
      "{:.0f} % of the heights are exactly 0, perhaps a sea: --sea-level 0 gives them colours of water",
      100.0 * zeros / count);
}

Result<TerrainColors> ColorArguments::of(const std::string& coloring, const TerrainModel& model,
                                         Warnings& warnings) const {
  double lowest = INFINITY, highest = -INFINITY;
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) {
    const double height = model.mt.vertices().height(VertexId(v));
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  TerrainColors colors = TerrainColors::over(lowest, highest);
  if (!isStated()) return colors;
  const std::string what = coloring.empty() ? "height" : coloring;
  const bool hasSea = seaOption && seaOption->count() > 0;
  const std::string first = !ramp.empty()    ? "--ramp " + ramp
                            : !range.empty() ? "--range " + range
                            : !mode.empty()  ? "--ramp-mode " + mode
                                             : "--sea-level";
  if (what != "height" && what != "slope" && what != "aspect")
    return refusal(first,
                   fmt::format("is for colours of height, slope or aspect, and --color {} shows none", what));
  if (hasSea && what != "height")
    return refusal("--sea-level", fmt::format("is for heights, not for --color {}", what));

  std::optional<ColoredRange> stated;
  if (!range.empty()) {
    ARETE_TRY(const auto ends, twoNumbers("--range", range, ','));
    if (!std::isfinite(ends.first) || !std::isfinite(ends.second) || !(ends.first < ends.second))
      return refusal("--range " + range, "must be LOW,HIGH, the lower value first");
    stated = ColoredRange{ends.first, ends.second};
  }
  const ColoredRange ofData = what == "height"  ? ColoredRange{lowest, highest}
                              : what == "slope" ? ColoredRange{0, 90}
                                                : ColoredRange{0, 360};
  ColorMap& map = what == "height" ? colors.heights : what == "slope" ? colors.slopes : colors.aspects;
  const auto between = betweenNamed(mode);
  const ColorTable* table = findColorTable(ramp.empty() ? what : ramp);
  if (!table) {
    Result<RampFile> file = readRampFile(ramp);
    // A word without a file is taken for a misspelt name.
    if (!file && file.error().code == ErrorCode::notFound && ramp.find_first_of("./\\") == ramp.npos)
      return refusal("--ramp " + ramp, fmt::format("is neither a file nor one of {}", namesOfTables()));
    if (!file) return tl::unexpected(file.error());
    if (stated && !file->usesPercent())
      return refusal("--range " + range,
                     fmt::format("is for named ramps and per cent; {} states values", ramp));
    if (hasSea)
      return refusal("--sea-level",
                     fmt::format("is for named ramps; {} states the colours of the sea itself", ramp));
    const ColoredRange over = stated.value_or(ofData);
    ARETE_TRY(map, file->map(over.low, over.high, between, warnings));
    if (file->nodata)
      warnings.push_back({WarningCode::display,
                          "the colour of NODATA is not shown: places without data have no ground to colour"});
    return colors;
  }
  if (between == ColorsBetween::exact)
    return refusal("--ramp-mode exact", "requires --ramp FILE, whose values have a meaning");
  if (hasSea && between.value_or(ColorsBetween::linear) != ColorsBetween::linear)
    return refusal("--sea-level", fmt::format("does not go with --ramp-mode {}", mode));
  if (what == "aspect" && stated)
    return refusal("--range " + range, "is not for aspects, which run from 0 to 360");
  // Slopes have the range of their own table, whatever table colours them.
  const ColoredRange over = stated ? *stated : what == "slope" ? ColoredRange{0, 60} : ofData;
  if (what == "height") {
    const bool hasExtent = over.low < over.high;
    const ColorMap stretched =
        table->map.over(hasExtent ? over.low : over.low - 0.5, hasExtent ? over.high : over.low + 0.5);
    const double shore = std::max(over.low, seaLevel);
    map = hasSea ? withSea(table->map.over(shore, std::max(shore, over.high)), seaLevel,
                           std::min(over.low, lowest))
                 : stretched;
  } else {
    map = table->map.over(over.low, over.high);
  }
  if (between) {
    ColorMapOptions options = map.options();
    options.between = *between;
    ARETE_TRY(map, ColorMap::make(map.stops(), options));
  }
  return colors;
}

}  // namespace arete
