// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "io/store/format/metadata_head.h"
#include "io/store/format/summary.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The content of the metadata chunk: all of a model but its arrays.
struct AmtMetadata : AmtHead {
  TerrainModel model;  ///< without mt, isolated samples and fixed vertices
  HeightEncoding encoding;
  AmtSummary summary;  ///< of a file in pages
};

/// The metadata of a model.
/// @param writer  the program that writes the file
AmtMetadata amtMetadataOf(const TerrainModel& model, std::string writer);

/// @return the first problem of the metadata, as a sentence: counts beyond 32 bits or in contradiction,
/// numbers that are not finite or out of range; nothing if it has no problem
std::optional<std::string> findAmtProblem(const AmtMetadata& metadata);

/// The metadata as JSON. Doubles and strings read back to the bit; a string that is not UTF-8 is written as
/// {"hex": "..."}. Precondition: findAmtProblem() finds nothing.
std::string toAmtJson(const AmtMetadata& metadata);
/// Reads the metadata. Errors, without a culprit: corrupt: not JSON, a field that is missing or of the wrong
/// type, a problem that findAmtProblem() finds.
Result<AmtMetadata> fromAmtJson(std::string_view text);

/// What decides which columns a plain file of it has (io/store/format/schema.h). Precondition:
/// findAmtProblem() finds nothing.
AmtFacts amtFactsOf(const AmtMetadata& metadata);

}  // namespace arete
