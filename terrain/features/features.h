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

/// A critical vertex of a terrain and its persistence.
struct Feature {
  enum class Kind : std::uint8_t { peak, pit, pass };
  Kind kind = Kind::peak;
  std::uint32_t sample = 0;  ///< index into the heights
  double height = 0;         ///< of that sample, in the DEM's vertical unit
  /// By how much the surface must be raised or lowered, in the DEM's vertical unit, to remove the feature.
  double persistence = 0;

  bool operator==(const Feature&) const = default;
};

std::string_view toString(Feature::Kind kind);

struct FeatureOptions {
  /// The maximal number of vertices that selectFeatures() returns.
  std::size_t count = 64;
  /// Features of lower persistence, in the DEM's vertical unit, are dropped. Persistence 0 is always dropped:
  /// it results from breaking ties on a plateau, not from the terrain's shape.
  double minimumPersistence = 0;
};

/// Peaks, pits and passes of a triangulated surface, ranked by topological persistence
/// [EdelsbrunnerLetscherZomorodian2002].
///
/// A peak is paired with the pass at which its superlevel component joins that of a higher peak; the pair's
/// persistence is the height between the two (climbers call it prominence). A pit is paired likewise with the
/// pass over which it spills into a lower one. A pass appears once for every extremum paired with it, so a
/// sample can appear more than once. The highest and the lowest vertex of each connected component have no
/// pass: their persistence is the component's height range (finite, so that an islet among NODATA does not
/// outrank a mountain). The border is part of the surface: where a valley leaves the domain there is a pit.
/// Ties between equal heights are broken by the sample index, the larger index higher
/// [EdelsbrunnerMuecke1990], so a plateau has one peak or pit and the result is unique. Samples in no
/// triangle have no features.
///
/// O(n log n) time, 28 bytes per sample of temporary memory. Precondition: every index is in range and its
/// height finite; fewer than 2^31 triangles.
/// @param heights  by sample, NaN for NODATA
/// @param triangles  index into `heights`
/// @return features by falling persistence, then rising sample, then kind; the same for any number of
/// threads.
///         Empty when cancelled (context.cancelled()).
std::vector<Feature> rankFeatures(std::span<const double> heights,
                                  std::span<const std::array<std::uint32_t, 3>> triangles,
                                  const FeatureOptions& options = {}, const RunContext& context = {});

/// The same on the finest triangulation of a raster (finest_raster.h), without storing its triangles: 8 bytes
/// per sample of temporary memory, O(n) but for sorting the candidates for passes. Parallel.
std::vector<Feature> rankFeatures(const RasterHeightfield& heightfield, const FeatureOptions& options = {},
                                  const RunContext& context = {});

/// The first `options.count` distinct samples of a ranking, down to a persistence of
/// `options.minimumPersistence`. O(features read).
/// @param ranked  by falling persistence, as rankFeatures() returns them
/// @return samples in the order of the ranking
std::vector<std::uint32_t> selectFeatures(std::span<const Feature> ranked,
                                          const FeatureOptions& options = {});

}  // namespace arete
