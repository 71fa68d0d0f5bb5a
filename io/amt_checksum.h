// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/run_context.h"

namespace arete {

/// XXH3-64 of some bytes.
std::uint64_t amtChecksum(std::span<const std::byte> bytes);

/// XXH3-64 of each block of bytes, blocks in parallel, with progress; nothing when the caller asked to stop.
std::optional<std::vector<std::uint64_t>> amtChecksums(std::span<const std::span<const std::byte>> blocks,
                                                       std::string_view stage, const RunContext& context);

}  // namespace arete
