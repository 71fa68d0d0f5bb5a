// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface between -1 and 1 is scaled, moved, rounded to some unit, and gets outliers. Each choice is drawn
// by itself, so that a few thousand seeds meet every pair of choices.
#include "datasets/hostile_heights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "datasets/noise.h"
#include "datasets/random.h"

namespace arete {
namespace {

struct Surface {
  const char* name;
  double (*at)(std::uint64_t seed, double x, double y);
};

constexpr std::array kSurfaces = {
    Surface{"hills", [](std::uint64_t seed, double x, double y) { return fractalNoise(seed, x / 7, y / 7); }},
    Surface{"noise",
            [](std::uint64_t seed, double x, double y) {
              return 2 * Random::toUnit(Random::at(seed, std::int64_t(x), std::int64_t(y))) - 1;
            }},
    Surface{"plane", [](std::uint64_t, double x, double y) { return x / 33 - y / 41; }},
    Surface{"steps",
            [](std::uint64_t, double x, double y) { return std::floor((x + 2 * y) / 8) / 16 - 0.5; }},
    Surface{"level with hills", [](std::uint64_t seed, double x, double y) {
              return std::max(0.0, fractalNoise(seed, x / 5, y / 5) - 0.2);
            }}};

constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();

/// Whether some heights stand apart from the others: across a gap that is wider than the range of those on
/// its side with more of them.
bool standApart(std::vector<double> heights) {
  std::ranges::sort(heights);
  for (std::size_t i = 1; i < heights.size(); ++i) {
    const double rest =
        2 * i < heights.size() ? heights.back() - heights[i] : heights[i - 1] - heights.front();
    if (heights[i] - heights[i - 1] > rest) return true;
  }
  return false;
}

}  // namespace

HostileHeights hostileHeights(std::uint64_t seed, std::uint32_t columns, std::uint32_t rows) {
  Random random(seed);
  HostileHeights made;
  RasterHeightfield& field = made.field;
  field.columns = columns;
  field.rows = rows;
  field.georeference.geoTransform = {500000, 30, 0, 5200000, 0, -30};
  field.georeference.hasGeoTransform = true;
  field.source = fmt::format("hostile:{}", seed);

  const Surface& surface = kSurfaces[random.below(kSurfaces.size())];
  // Half of the magnitudes are those of heights on the ground.
  const int exponent = random.below(2) == 0 ? int(random.below(7)) - 2 : int(random.below(601)) - 300;
  const double scale = std::pow(10.0, exponent);
  constexpr std::array kOffsets = {0.0, 0.0, 1.0, -1000.0, 1e9, 0x1p40, -1e13, 0x1p51};
  const double offset = kOffsets[random.below(kOffsets.size())];
  constexpr std::array kUnits = {0.0, 0.0, 0x1p-4, 0x1p-10, 0.1, 0.001};
  const double unit = kUnits[random.below(kUnits.size())];
  const bool isFloat = random.below(4) == 0;
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      double z = surface.at(seed, column, row) + offset;
      if (unit > 0) z = std::nearbyint(z / unit) * unit;
      z *= scale;
      field.heights.push_back(isFloat ? double(float(z)) : z);
    }
  made.what = fmt::format("seed {}: {} times 1e{}, offset {}, unit {}{}", seed, surface.name, exponent,
                          offset, unit, isFloat ? ", floats" : "");
  // Where 1e39 and more is made a float it is infinite, and where doubles overflow too.
  for (double& z : field.heights)
    if (!std::isfinite(z)) z = std::copysign(1e38, z);

  const auto [low, high] = std::ranges::minmax(field.heights);
  const double largest = std::max(std::abs(low), std::abs(high));
  const double ulp = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  made.isOrdinary = largest < 1e30 && high - low > 0x1p20 * ulp;

  // On a level with a few hills the hills themselves may stand alone.
  if (standApart(field.heights)) made.isOrdinary = false;

  const double relief = high - low;
  const auto anywhere = [&] { return std::size_t(random.below(columns * rows)); };
  switch (random.below(6)) {
    case 0:  // one that stands alone
    case 1: {
      const double away = std::pow(10.0, 3.1 + random.unit() * (made.isOrdinary ? 12 : 3));
      const double z = random.below(2) == 0 ? high + away * relief : low - away * relief;
      if (!made.isOrdinary || !(std::abs(z) < 1e29)) break;
      field.heights[anywhere()] = z;
      made.planted = 1;
      made.what += fmt::format(", one of {}", z);
      break;
    }
    case 2: {  // a block of one value
      const double z = low - (2000 + random.below(100)) * relief;
      if (!made.isOrdinary || !(std::abs(z) < 1e29)) break;
      const std::uint32_t width = 1 + random.below(columns / 4), height = 1 + random.below(rows / 4);
      const std::uint32_t left = random.below(columns - width), top = random.below(rows - height);
      for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) field.heights[field.index(left + x, top + y)] = z;
      made.planted = std::size_t(width) * height;
      made.what += fmt::format(", {} by {} of {}", width, height, z);
      break;
    }
    case 3: {  // heights of every magnitude: which of them stand alone is anybody's guess
      for (std::uint32_t i = 0; i < 1 + random.below(6); ++i) {
        const double sign = random.unit() - 0.5;
        field.heights[anywhere()] = std::copysign(std::pow(10.0, random.between(-300, 29)), sign);
      }
      made.isOrdinary = false;
      made.what += ", a few of any magnitude";
      break;
    }
    case 4:  // voids
      for (std::uint32_t i = 0; i < columns; ++i) field.heights[anywhere()] = kNoData;
      made.what += ", voids";
      break;
    default:
      break;
  }
  return made;
}

PointHeightfield hostilePoints(std::uint64_t seed, std::uint32_t columns, std::uint32_t rows) {
  const RasterHeightfield field = hostileHeights(seed, columns, rows).field;
  Random random(~seed);
  PointHeightfield points;
  points.source = field.source;
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double z = field.at(column, row);
      if (std::isnan(z)) continue;
      // Half of the points stay on the lattice, so that many are in line and many triangles are alike.
      const double move = random.below(2) == 0 ? 0 : 0.4;
      points.positions.push_back({column + move * random.unit(), row + move * random.unit()});
      points.heights.push_back(z);
    }
  return points;
}

}  // namespace arete
