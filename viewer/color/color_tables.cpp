// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stops were made once: colours chosen by hand, resampled so that CIELAB L* is linear in the value, and
// rounded. tests/viewer/color/color_tables_test.cpp computes their lightness and what the colour-blind see.
#include "viewer/color/color_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "viewer/color/terrain_colors.h"

namespace arete {
namespace {

// NOLINTBEGIN(modernize-use-designated-initializers)
constexpr Rgb kHeightStops[] = {{116, 95, 95},   {138, 109, 102}, {161, 124, 108},
                                {178, 141, 114}, {195, 159, 120}, {210, 178, 132},
                                {224, 197, 147}, {237, 216, 168}, {247, 236, 196}};
constexpr Rgb kDepthStops[] = {{14, 40, 84},   {19, 56, 104},   {24, 73, 124},
                               {33, 90, 143},  {48, 107, 159},  {63, 125, 174},
                               {82, 144, 188}, {105, 162, 200}, {128, 180, 212}};
constexpr Rgb kSlopeStops[] = {{247, 244, 229}, {241, 213, 165}, {231, 180, 127},
                               {218, 148, 96},  {197, 119, 82},  {174, 91, 72},
                               {147, 65, 64},   {115, 44, 59},   {84, 24, 54}};
constexpr Rgb kErrorStops[] = {{30, 24, 62},    {85, 30, 81},    {132, 41, 89},
                               {179, 57, 90},   {210, 89, 91},   {235, 125, 95},
                               {246, 166, 106}, {251, 207, 143}, {252, 246, 190}};
constexpr Rgb kGreyStops[] = {{24, 24, 24},    {47, 47, 47},    {72, 72, 72},
                              {98, 98, 98},    {125, 125, 125}, {154, 154, 154},
                              {184, 184, 184}, {214, 214, 214}, {246, 246, 246}};
constexpr Rgb kDifferenceStops[] = {{10, 48, 92},    {31, 95, 148},   {91, 150, 190},
                                    {170, 202, 220}, {243, 241, 238}, {232, 198, 168},
                                    {207, 139, 92},  {166, 80, 42},   {106, 34, 14}};
// L* 68, chroma 37, hue 270 degrees less 15 a stop.
constexpr Rgb kAspectStops[] = {
    {117, 169, 232}, {87, 174, 230},  {56, 178, 223},  {27, 181, 212},  {19, 183, 198},
    {42, 184, 182},  {67, 183, 165},  {91, 182, 147},  {113, 180, 131}, {134, 178, 117},
    {153, 174, 107}, {171, 169, 100}, {188, 164, 98},  {202, 158, 101}, {215, 152, 109},
    {224, 147, 120}, {230, 143, 134}, {231, 140, 150}, {228, 140, 167}, {220, 142, 184},
    {208, 146, 200}, {191, 151, 213}, {169, 157, 224}, {145, 163, 230}, {117, 169, 232}};
// NOLINTEND(modernize-use-designated-initializers)

ColorMap evenly(std::span<const Rgb> colors, double low, double high) {
  std::vector<ColorStop> stops;
  for (std::size_t i = 0; i < colors.size(); ++i)
    stops.push_back({low + (high - low) * double(i) / double(colors.size() - 1), colors[i], {}});
  return ColorMap::make(std::move(stops)).value();
}

}  // namespace

std::span<const ColorTable> colorTables() {
  static const std::array<ColorTable, 7> kTables = {
      {{"height", ColorTableKind::sequential, "heights, dark to light", evenly(kHeightStops, 0, 1)},
       {"depth", ColorTableKind::sequential, "depths of water, deep is dark", evenly(kDepthStops, 0, 1)},
       {"slope", ColorTableKind::sequential, "slopes in degrees, steep is dark", evenly(kSlopeStops, 0, 60)},
       {"aspect", ColorTableKind::cyclic, "directions, hues of one lightness", evenly(kAspectStops, 0, 360)},
       {"error", ColorTableKind::sequential, "errors, large is light", evenly(kErrorStops, 0, 1)},
       {"difference", ColorTableKind::diverging, "signed values, near-white at 0",
        evenly(kDifferenceStops, -1, 1)},
       {"grey", ColorTableKind::sequential, "greys, dark to light", evenly(kGreyStops, 0, 1)}}};
  return kTables;
}

const ColorTable* findColorTable(std::string_view name) {
  const auto tables = colorTables();
  const auto found = std::ranges::find(tables, name, &ColorTable::name);
  return found == tables.end() ? nullptr : &*found;
}

const ColorMap& colorTable(std::string_view name) {
  return findColorTable(name)->map;
}

ColorMap withSea(const ColorMap& land, double seaLevel, double low) {
  const auto level = float(seaLevel);
  const ColorMap& depths = colorTable("depth");
  std::vector<ColorStop> stops;
  if (low < seaLevel) {
    stops = depths.over(std::min(low, seaLevel - 1), double(level)).stops();
  } else {
    // Without depths all water has the colour of the shore, on a strip of its own in legends.
    const double strip = std::max(0.05 * (land.high() - seaLevel), 1e-6);
    for (const double value : {seaLevel - strip, double(level)}) stops.push_back({value, depths.at(1), {}});
  }
  // A sea at exactly its level is sea, so the land begins at the next float.
  const double shore = double(std::nextafter(level, std::numeric_limits<float>::infinity()));
  ColorMapOptions options = land.options();
  stops.push_back({shore, land.at(shore), {}});
  for (const ColorStop& stop : land.stops())
    if (stop.value > shore) stops.push_back(stop);
  return ColorMap::make(std::move(stops), options).value();
}

ColorMap heightColors(double low, double high, std::optional<double> seaLevel) {
  const ColorMap& table = colorTable("height");
  // Level ground has the colour in the middle.
  if (!seaLevel) return low < high ? table.over(low, high) : table.over(low - 0.5, low + 0.5);
  const double shore = std::max(low, *seaLevel);
  return withSea(table.over(shore, std::max(shore, high)), *seaLevel, low);
}

SharedColors::~SharedColors() = default;

std::span<const Rgb> classColors() {
  static constexpr Rgb kColors[] = {{230, 159, 0}, {86, 180, 233}, {0, 114, 178},  {240, 228, 66},
                                    {30, 30, 34},  {213, 94, 0},   {236, 236, 236}};
  return kColors;
}

}  // namespace arete
