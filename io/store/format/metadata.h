// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "io/store/format/layout.h"
#include "io/store/format/shapes.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The counts that determine the sizes of all chunks of a file.
struct AmtCounts {
  std::uint64_t rootVertices = 0, rootTriangles = 0, nodes = 0, slots = 0;
  std::uint64_t isolated = 0, fixedVertices = 0;
};

/// The content of the metadata chunk: all of a model but its arrays.
struct AmtMetadata {
  std::string writer;  ///< the program that wrote the file
  AmtCounts counts;
  TerrainModel model;  ///< without mt, isolated samples and fixed vertices
  HeightEncoding encoding;
  OutwardScale scale;
  MetricFrame metric;
};

/// The metadata of a model.
/// @param writer  the program that writes the file
AmtMetadata amtMetadataOf(const TerrainModel& model, std::string writer);

/// The first problem of counts that determine arrays; of a scale of codes.
std::optional<std::string> findCountProblem(const AmtCounts& counts);
std::optional<std::string> findScaleProblem(const OutwardScale& scale);

/// @return the first problem of the metadata, as a sentence: counts beyond 32 bits or in contradiction,
/// numbers that are not finite or out of range; nothing if it has no problem
std::optional<std::string> findAmtProblem(const AmtMetadata& metadata);

/// The metadata as JSON. Doubles and strings read back to the bit; a string that is not UTF-8 is written as
/// {"hex": "..."}. Precondition: findAmtProblem() finds nothing.
std::string toAmtJson(const AmtMetadata& metadata);
/// Reads the metadata. Errors, without a culprit: corrupt: not JSON, a field that is missing or of the wrong
/// type, a problem that findAmtProblem() finds.
Result<AmtMetadata> fromAmtJson(std::string_view text);

/// The arrays that every multitriangulation has, in the order in which they are written, with those of u16 a
/// triangle that belong to its kind.
std::vector<AmtShape> mtShapes(const AmtCounts& counts, std::span<const AmtTag> ofTriangles);

/// The chunks whose sizes follow from the metadata, in the order in which they are written: all but the
/// metadata, the checksums of segments and the three of packed files. Precondition: findAmtProblem() finds
/// nothing.
std::vector<AmtShape> amtShapes(const AmtMetadata& metadata, bool isPacked = false);

/// The chunk that follows them in a file that is not packed: a checksum per segment.
constexpr AmtShape amtSegmentShape(std::uint64_t segments) {
  return {amt_tag::kSegmentChecksums, AmtScalar::u32, 8, segments};
}

}  // namespace arete
