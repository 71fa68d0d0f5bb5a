// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "io/format/layout.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The sizes that all chunks of a file follow from.
struct AmtCounts {
  std::uint64_t rootVertices = 0, rootTriangles = 0, nodes = 0, slots = 0;
  std::uint64_t isolated = 0, fixedVertices = 0;
};

/// What the metadata chunk says: all of a model but its arrays.
struct AmtMetadata {
  std::string writer;  ///< the program that wrote the file
  AmtCounts counts;
  TerrainModel model;  ///< without mt, isolated samples and fixed vertices
  HeightEncoding encoding;
  OutwardScale scale;
  MetricFrame metric;
};

AmtMetadata amtMetadataOf(const TerrainModel& model, std::string writer);

/// The first thing in the metadata that cannot be, as a sentence: counts beyond 32 bits or at odds with each
/// other, numbers that are not finite or out of range. Nothing when all is well.
std::optional<std::string> findAmtProblem(const AmtMetadata& metadata);

/// JSON. Doubles and strings come back to the bit; a string that is not UTF-8 is written as
/// {"hex": "..."}. Precondition: findAmtProblem() finds nothing.
std::string toAmtJson(const AmtMetadata& metadata);
/// Errors: corrupt (no JSON, a field that is missing or of the wrong type, findAmtProblem()), without a
/// culprit.
Result<AmtMetadata> fromAmtJson(std::string_view text);

/// A chunk that the counts call for.
struct AmtShape {
  AmtTag tag{};
  AmtScalar scalar = AmtScalar::u8;
  std::uint32_t elementBytes = 1;
  std::uint64_t count = 0;
};

/// Every chunk but the metadata, the checksums of segments and the three of packed files, in the order in
/// which they are written. Precondition: findAmtProblem() finds nothing.
std::vector<AmtShape> amtShapes(const AmtMetadata& metadata, bool isPacked = false);

/// The chunk behind them in a file that is not packed: so many checksums of segments.
constexpr AmtShape amtSegmentShape(std::uint64_t segments) {
  return {amt_tag::kSegmentChecksums, AmtScalar::u32, 8, segments};
}

}  // namespace arete
