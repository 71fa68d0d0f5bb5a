// SPDX-License-Identifier: GPL-3.0-or-later
//
// The indices of the multitriangulation are checked by io/store/amt/index_check.h. Isolated samples and fixed
// vertices are few, so they are checked one after the other. Checksums are compared by segments where the
// file has them, otherwise by chunks.
#include "io/store/amt/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/store/amt/index_check.h"
#include "io/store/amt/segments.h"
#include "io/store/format/checksum.h"

namespace arete {

std::uint64_t amtGridSamples(const AmtFile& file) {
  return std::uint64_t{file.model().columns} * file.model().rows;
}

Status checkAmtExtras(const AmtFile& file) {
  const auto refuse = [&](const AmtTag& tag, const std::string& what) {
    return failure(ErrorCode::corrupt,
                   fmt::format("chunk {}: {}", std::string_view(tag.data(), tag.size()), what), file.path());
  };
  const TerrainModel& model = file.model();
  const std::uint64_t gridSamples = amtGridSamples(file);
  const auto samples = file.isolatedSamples();
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (samples[i] >= gridSamples || (i > 0 && samples[i] <= samples[i - 1]))
      return refuse(amt_tag::kIsolatedSamples,
                    fmt::format("entry {} is sample {} of {}, or not above the one before it", i, samples[i],
                                gridSamples));
  const auto heights = file.isolatedHeights();
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (!std::isfinite(heights[i]))
      return refuse(amt_tag::kIsolatedHeights, fmt::format("entry {} is not finite", i));
  const auto fixed = file.fixedVertices();
  const std::uint64_t bound = model.isRaster ? gridSamples : model.mt.rootVertexCount();
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i] >= bound)
      return refuse(amt_tag::kFixedVertices,
                    model.isRaster
                        ? fmt::format("entry {} is sample {} of {}", i, fixed[i], bound)
                        : fmt::format("entry {} is vertex {}, the root has {}", i, fixed[i], bound));
  return {};
}

Status checkAmtIndices(const AmtFile& file, const RunContext& context) try {
  ARETE_CHECK(file.loadAllButPacked());
  if (!file.isPacked())
    if (Status indices = checkMtIndices(file.model().mt, amtGridSamples(file), context); !indices)
      return failure(indices.error().code, indices.error().message, file.path());
  return checkAmtExtras(file);
} catch (...) {
  return caughtFailure(file.path());
}

namespace {

/// All chunks have segments, but for the two that are checked as a whole.
Status checkSegments(const AmtFile& file, const RunContext& context) {
  for (const AmtTag& tag : {amt_tag::kMetadata, amt_tag::kSegmentChecksums})
    ARETE_CHECK(checkAmtChunk(file, tag));
  AmtSegments segments(file);
  segments.touchAll();
  return segments.check(context);
}

}  // namespace

Status checkAmtChunk(const AmtFile& file, const AmtTag& tag) {
  const auto chunk = std::ranges::find(file.chunks(), tag, &AmtChunk::tag);
  ARETE_CHECK(file.container().load(file.bytes(*chunk)));
  return amtChecksum(file.bytes(*chunk)) == chunk->checksum ? Status() : file.container().altered(*chunk);
}

Status checkAmtChecksums(const AmtFile& file, const RunContext& context) try {
  constexpr std::array kCheckedApart = {amt_tag::kPackedNodes, amt_tag::kPageBlocks};
  ARETE_CHECK(file.hasSegments() ? checkSegments(file, context)
                                 : file.container().checkSums(kCheckedApart, context));
  // Of a paged file a part is read, and the bytes between chunks are no part.
  return file.isPaged() ? Status() : file.container().checkZeros();
} catch (...) {
  return caughtFailure(file.path());
}

Status checkAmt(const AmtFile& file, AmtVerify verify, const RunContext& context) try {
  Status status;
  if (verify == AmtVerify::all) status = checkAmtChecksums(file, context);
  if (status && verify != AmtVerify::none) status = checkAmtIndices(file, context);
  return status;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
