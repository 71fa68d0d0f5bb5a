// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace arete {

/// Reads a number of bytes: by itself or followed by B; kB, MB, GB, TB (powers of 1000); K, M, G, T or KiB,
/// MiB, GiB, TiB (powers of 1024).
/// @return nothing for another text, and for less than 0 or more than 1e18
std::optional<std::uint64_t> parseByteSize(std::string_view text);

}  // namespace arete
