// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/parallel/run_context.h"

namespace arete {

/// XXH3-64 of bytes, seed 0.
std::uint64_t amtChecksum(std::span<const std::byte> bytes);

/// Checksums of blocks of bytes.
struct AmtChecksums {
  std::vector<std::uint64_t> blocks;
  std::vector<std::vector<std::uint64_t>> segments;  ///< per block, of every kAmtSegmentBytes
};

/// XXH3-64 of each block of bytes and of its segments, blocks in parallel.
/// @param stage  under which progress is reported
/// @return nothing if the context was cancelled
std::optional<AmtChecksums> amtChecksums(std::span<const std::span<const std::byte>> blocks,
                                         std::string_view stage, const RunContext& context);

}  // namespace arete
