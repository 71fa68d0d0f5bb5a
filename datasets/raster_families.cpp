// SPDX-License-Identifier: GPL-3.0-or-later
// Every family fills a blank raster sample by sample from hashes of (seed, column, row), so that no order of
// evaluation matters, then plants what its name promises.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <string>

#include "datasets/crs_wkt.h"
#include "datasets/families.h"
#include "datasets/noise.h"
#include "datasets/random.h"

namespace arete {
namespace {

constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();

std::string sourceOf(std::string_view name) {
  return fmt::format("family:{}", name);
}

/// A raster of zeros, 30 m pixels, north up, no CRS.
RasterHeightfield blank(std::string_view name, std::uint32_t columns, std::uint32_t rows) {
  RasterHeightfield field;
  field.columns = columns;
  field.rows = rows;
  field.heights.assign(std::size_t(columns) * rows, 0.0);
  field.georeference.geoTransform = {500000, 30, 0, 5200000, 0, -30};
  field.georeference.hasGeoTransform = true;
  field.source = sourceOf(name);
  return field;
}

/// Height by a function of (column, row).
template <class Function>
RasterHeightfield fill(std::string_view name, std::uint32_t columns, std::uint32_t rows, Function height) {
  RasterHeightfield field = blank(name, columns, rows);
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column)
      field.heights[field.index(column, row)] = height(column, row);
  return field;
}

double hills(std::uint64_t seed, double column, double row) {
  return 500 + 300 * fractalNoise(seed, column / 24, row / 24);
}

/// Writes one sample; positions outside the raster are ignored, so that shapes may hang over the border.
void put(RasterHeightfield& field, std::int64_t column, std::int64_t row, double height) {
  if (column < 0 || row < 0 || column >= field.columns || row >= field.rows) return;
  field.heights[std::size_t(row) * field.columns + std::size_t(column)] = height;
}

template <class Height>
void putDisc(RasterHeightfield& field, std::int64_t column, std::int64_t row, std::int64_t radius,
             Height height) {
  for (std::int64_t y = -radius; y <= radius; ++y)
    for (std::int64_t x = -radius; x <= radius; ++x)
      if (x * x + y * y <= radius * radius) put(field, column + x, row + y, height(column + x, row + y));
}

/// The promise of rasterFamilies(): one whole cell at least, at the lower right.
void keepOneCell(RasterHeightfield& field, std::uint64_t seed) {
  for (std::uint32_t row = field.rows - 2; row < field.rows; ++row)
    for (std::uint32_t column = field.columns - 2; column < field.columns; ++column)
      if (!field.isValid(column, row)) field.heights[field.index(column, row)] = hills(seed, column, row);
}

RasterHeightfield makeFlat(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  const double height = Random(seed).below(2000);
  return fill("flat", columns, rows, [&](auto, auto) { return height; });
}

// Coefficients in sixteenths: every height is exact, and so is every difference of two.
RasterHeightfield makeRamp(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  Random random(seed);
  const double base = random.below(1000);
  const double dx = (static_cast<double>(random.below(129)) - 64) / 16;
  const double dy = (static_cast<double>(random.below(129)) - 64) / 16;
  return fill("ramp", columns, rows, [&](auto column, auto row) { return base + dx * column + dy * row; });
}

RasterHeightfield makeNoise(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  return fill("noise", columns, rows,
              [&](auto column, auto row) { return 100 * Random::toUnit(Random::at(seed, column, row)); });
}

RasterHeightfield makeFractal(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  return fill("fractal", columns, rows, [&](auto column, auto row) { return hills(seed, column, row); });
}

RasterHeightfield makeCliffs(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  return fill("cliffs", columns, rows,
              [&](auto column, auto row) { return 80 * std::floor(hills(seed, column, row) / 80); });
}

RasterHeightfield makePits(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  return fill("pits and spikes", columns, rows, [&](auto column, auto row) {
    const std::uint64_t hash = Random::at(seed + 1, column, row);
    const double spike = hash % 11 == 0 ? 200 * (Random::toUnit(hash) - 0.5) : 0;
    return hills(seed, column, row) + spike;
  });
}

// Parallel roof ridges: every flank is one plane, every crest one line.
RasterHeightfield makeRidges(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  constexpr std::array<std::array<int, 2>, 5> kDirections = {{{1, 0}, {0, 1}, {1, 1}, {1, -1}, {2, 1}}};
  Random random(seed);
  const auto direction = kDirections[random.below(kDirections.size())];
  const std::int64_t half = 3 + random.below(5);
  return fill("collinear ridges", columns, rows, [&](auto column, auto row) {
    const std::int64_t across = direction[0] * std::int64_t(column) + direction[1] * std::int64_t(row);
    const std::int64_t phase = ((across % (2 * half)) + 2 * half) % (2 * half);
    return 1.5 * static_cast<double>(phase < half ? phase : 2 * half - phase);
  });
}

RasterHeightfield makeInteger(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  return fill("integer", columns, rows,
              [&](auto column, auto row) { return std::floor(hills(seed, column, row) / 8); });
}

RasterHeightfield makeHugeOffset(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  RasterHeightfield field = fill("huge offset", columns, rows,
                                 [&](auto column, auto row) { return 1e7 + hills(seed, column, row); });
  field.georeference.geoTransform = {399960, 10, 0, 9000040, 0, -10};
  return field;
}

RasterHeightfield makeGeographic(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  RasterHeightfield field = makeFractal(columns, rows, seed);
  field.source = sourceOf("geographic");
  // Three arc-seconds: 93 m north, 46 m east at 60 degrees.
  field.georeference.geoTransform = {10, 1. / 1200, 0, 60.05, 0, -1. / 1200};
  field.georeference.crsWkt = kWgs84Wkt;
  field.georeference.isGeographic = true;
  field.georeference.verticalUnit = std::string("m");
  return field;
}

// A grid turned by the 3-4-5 triangle's angle, so that the transform is exact.
RasterHeightfield makeRotated(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  RasterHeightfield field = makeFractal(columns, rows, seed);
  field.source = sourceOf("rotated");
  field.georeference.geoTransform = {1000, 24, 18, 5000, 18, -24};
  return field;
}

RasterHeightfield makeSouthUp(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  RasterHeightfield field = makeFractal(columns, rows, seed);
  field.source = sourceOf("south up");
  field.georeference.geoTransform = {1000, 25, 0, 5000, 0, 10};
  return field;
}

// All the ways a void can meet the triangulation: blobs, single samples, border bites, a missing corner,
// voids that touch at a corner, a pinch of the domain, and valid samples alone inside a void.
RasterHeightfield makeHoles(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  RasterHeightfield field = makeFractal(columns, rows, seed);
  field.source = sourceOf("nodata holes");
  Random random(seed);
  const auto hole = [](auto, auto) { return kNoData; };
  const auto samples = static_cast<std::uint32_t>(field.size());
  const auto anywhere = [&] {
    return std::array<std::int64_t, 2>{random.below(columns), random.below(rows)};
  };

  for (std::uint32_t i = 0; i < samples / 500 + 1; ++i) {
    const auto [x, y] = anywhere();
    putDisc(field, x, y, 1 + random.below(std::min(columns, rows) / 10 + 1), hole);
    putDisc(field, x + 2, y + 1, 1 + random.below(3), hole);
  }
  for (std::uint32_t i = 0; i < samples / 150 + 1; ++i) {
    const auto [x, y] = anywhere();
    put(field, x, y, kNoData);
  }
  const std::int64_t bite = random.below(rows);
  for (std::int64_t y = bite; y < bite + 5; ++y) put(field, 0, y, kNoData);
  putDisc(field, random.below(columns), 0, 2, hole);
  put(field, columns - 1, 0, kNoData);

  for (std::uint32_t i = 0; i < samples / 600 + 1; ++i) {
    const auto [x, y] = anywhere();  // two single voids that touch diagonally
    put(field, x, y, kNoData);
    put(field, x + 1, y + 1, kNoData);
    put(field, x + 1, y, hills(seed, double(x + 1), double(y)));
    put(field, x, y + 1, hills(seed, double(x), double(y + 1)));
  }
  for (std::uint32_t i = 0; i < samples / 600 + 1; ++i) {
    // A pinch: the domain passes through (x, y) from the upper left to the lower right, and only there.
    const auto [x, y] = anywhere();
    for (std::int64_t b = -1; b <= 1; ++b)
      for (std::int64_t a = -1; a <= 1; ++a)
        put(field, x + a, y + b, hills(seed, double(x + a), double(y + b)));
    put(field, x, y - 1, kNoData);
    put(field, x + 1, y - 1, kNoData);
    put(field, x - 1, y + 1, kNoData);
    put(field, x, y + 1, kNoData);
  }
  for (std::uint32_t i = 0; i < samples / 900 + 1; ++i) {
    const auto [x, y] = anywhere();
    putDisc(field, x, y, 3, hole);
    put(field, x, y, hills(seed, double(x), double(y)));
  }
  keepOneCell(field, seed);
  return field;
}

RasterHeightfield makeIslands(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  RasterHeightfield field = fill("islands", columns, rows, [](auto, auto) { return kNoData; });
  Random random(seed);
  const auto land = [&](std::int64_t x, std::int64_t y) { return hills(seed, double(x), double(y)); };
  const std::uint32_t largest = std::min(columns, rows) / 8 + 1;
  for (std::size_t i = 0; i < field.size() / 700 + 2; ++i) {
    // One statement each: compilers take arguments in different orders.
    const auto radius = 1 + random.below(largest);
    const auto y = random.below(rows);
    const auto x = random.below(columns);
    putDisc(field, x, y, radius, land);
  }
  keepOneCell(field, seed);
  return field;
}

/// The degenerate families follow: rasters that are too small or too empty for a triangle.
RasterHeightfield makeOneRow(std::uint32_t columns, std::uint32_t, std::uint64_t seed) {
  return fill("one row", columns, 1, [&](auto column, auto row) { return hills(seed, column, row); });
}

RasterHeightfield makeOneColumn(std::uint32_t, std::uint32_t rows, std::uint64_t seed) {
  return fill("one column", 1, rows, [&](auto column, auto row) { return hills(seed, column, row); });
}

RasterHeightfield makeSingleSample(std::uint32_t, std::uint32_t, std::uint64_t seed) {
  return fill("single sample", 1, 1, [&](auto column, auto row) { return hills(seed, column, row); });
}

RasterHeightfield makeAllNoData(std::uint32_t columns, std::uint32_t rows, std::uint64_t) {
  return fill("all nodata", columns, rows, [](auto, auto) { return kNoData; });
}

// The arguments are drawn in statements of their own, so that compilers agree on their order.
RasterHeightfield makeOneValid(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  RasterHeightfield field = fill("one valid sample", columns, rows, [](auto, auto) { return kNoData; });
  Random random(seed);
  const auto y = random.below(rows);
  const auto x = random.below(columns);
  put(field, x, y, 100);
  return field;
}

// No two valid samples are neighbours along a row or column, so every cell lacks two corners.
RasterHeightfield makeCheckerboard(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
  return fill("checkerboard", columns, rows, [&](auto column, auto row) {
    return (column + row) % 2 == 0 ? hills(seed, column, row) : kNoData;
  });
}

// These families have triangles; the ones below have none and are for what must be refused.
constexpr std::array kRasterFamilies = {
    RasterFamily{"flat", makeFlat},
    RasterFamily{"ramp", makeRamp},
    RasterFamily{"noise", makeNoise},
    RasterFamily{"fractal", makeFractal},
    RasterFamily{"cliffs", makeCliffs},
    RasterFamily{"pits and spikes", makePits},
    RasterFamily{"nodata holes", makeHoles},
    RasterFamily{"islands", makeIslands},
    RasterFamily{"collinear ridges", makeRidges},
    RasterFamily{"integer", makeInteger},
    RasterFamily{"huge offset", makeHugeOffset},
    RasterFamily{"geographic", makeGeographic},
    RasterFamily{"rotated", makeRotated},
    RasterFamily{"south up", makeSouthUp},
};

constexpr std::array kDegenerateFamilies = {
    RasterFamily{"one row", makeOneRow},
    RasterFamily{"one column", makeOneColumn},
    RasterFamily{"single sample", makeSingleSample},
    RasterFamily{"all nodata", makeAllNoData},
    RasterFamily{"one valid sample", makeOneValid},
    RasterFamily{"checkerboard", makeCheckerboard},
};

}  // namespace

std::span<const RasterFamily> rasterFamilies() {
  return kRasterFamilies;
}
std::span<const RasterFamily> degenerateFamilies() {
  return kDegenerateFamilies;
}

}  // namespace arete
