// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/parallel/run_context.h"
#include "terrain/model/heightfield.h"

namespace arete {

/// A critical vertex of a terrain and how much it matters.
struct Feature {
  enum class Kind : std::uint8_t { peak, pit, pass };
  Kind kind = Kind::peak;
  std::uint32_t sample = 0;  ///< index into the heights
  double height = 0;         ///< of that sample, in the DEM's vertical unit
  /// How far the surface would have to be raised or cut, in the DEM's vertical unit, for the feature to
  /// vanish.
  double persistence = 0;

  bool operator==(const Feature&) const = default;
};

std::string_view toString(Feature::Kind kind);

struct FeatureOptions {
  /// How many vertices selectFeatures() returns at most.
  std::size_t count = 64;
  /// Features under it, in the DEM's vertical unit, are dropped. Persistence 0 is always dropped: it is a
  /// plateau's tie-breaking, not the terrain's shape.
  double minimumPersistence = 0;
};

/// Peaks, pits and passes of a triangulated surface, the most persistent first.
///
/// A peak is paired with the pass at which its summit area joins that of a higher peak, and the pair's
/// persistence is the height between the two (climbers call it prominence); a pit is paired likewise with the
/// pass over which it spills into a lower one. A pass appears once for every extremum it kills, so a sample
/// can appear more than once. The highest and the lowest vertex of each connected component are never killed:
/// their persistence is the component's height range (finite, so that an islet among NODATA does not outrank
/// a mountain). The border counts as it lies: where a valley leaves the domain there is a pit. Equal heights
/// are told apart by the sample index, the higher index above (simulation of simplicity), so a plateau has
/// one peak or pit, and the triangulation alone decides the answer. Samples in no triangle have no features.
///
/// `heights` by sample, NaN = none; `triangles` index into it. Returns features sorted by falling
/// persistence, then rising sample, then kind; the same for any number of threads. Empty when cancelled: ask
/// context.cancelled(). Precondition: every index is in range and names a finite height; fewer than 2^31
/// triangles. O(n log n) time, 28 bytes per sample while it runs.
///
/// Edelsbrunner, Letscher, Zomorodian, "Topological persistence and simplification", Discrete & Computational
/// Geometry 28, 2002; Edelsbrunner, Muecke, "Simulation of simplicity", ACM Transactions on Graphics 9, 1990.
std::vector<Feature> rankFeatures(std::span<const double> heights,
                                  std::span<const std::array<std::uint32_t, 3>> triangles,
                                  const FeatureOptions& options = {}, const RunContext& context = {});

/// The same on the finest triangulation of a raster (finest_raster.h), which is not laid out for it: 8 bytes
/// per sample while it runs, O(n) but for sorting its passes. Parallel.
std::vector<Feature> rankFeatures(const RasterHeightfield& heightfield, const FeatureOptions& options = {},
                                  const RunContext& context = {});

/// The samples of the first `options.count` distinct vertices of a ranking whose persistence is at least
/// `options.minimumPersistence`, in the ranking's order. O(size of the part read).
std::vector<std::uint32_t> selectFeatures(std::span<const Feature> ranked,
                                          const FeatureOptions& options = {});

}  // namespace arete
