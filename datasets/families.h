// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "terrain/model/heightfield.h"

namespace arete {

/// Families of small heightfields for property tests: run an operation over every family at several sizes and
/// seeds, validate after each, and print name, size and seed where it fails. The same arguments give the same
/// bits on every machine.

/// A kind of raster, made at any size.
struct RasterFamily {
  std::string_view name;
  RasterHeightfield (*make)(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed);
};

/// A kind of scattered point set, made with any number of points.
struct PointFamily {
  std::string_view name;
  PointHeightfield (*make)(std::uint32_t count, std::uint64_t seed);
};

/// Rasters that have a triangulation: at least one cell with four valid corners whatever the seed.
/// Precondition of every make: columns >= 2 and rows >= 2. O(columns * rows).
std::span<const RasterFamily> rasterFamilies();

/// Rasters that have none: a row, a column, one sample, no valid sample, valid samples that share no cell.
/// Each keeps what its name says and takes what it can of the size asked for. Precondition: columns, rows
/// >= 1.
std::span<const RasterFamily> degenerateFamilies();

/// Point sets that have a triangulation. Precondition of every make: count >= 4. The sets have exactly count
/// points.
std::span<const PointFamily> pointFamilies();

/// Point sets that have none, or that contradict themselves: one point, two points, all collinear, all at one
/// place, one place with two heights. Precondition: count >= 1.
std::span<const PointFamily> degeneratePointFamilies();

}  // namespace arete
