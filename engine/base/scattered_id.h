// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace arete {

/// A hash for ids that come in runs (the triangles of a root, of a star): multiplicative hashing by 2^64 over
/// the golden ratio [Knuth1998]. With the id as its own hash a run fills a stretch of a table of open
/// addressing, and every other id that falls there is searched for to the end of the stretch.
struct ScatteredId {
  std::size_t operator()(std::uint32_t id) const noexcept {
    return static_cast<std::size_t>((id * 0x9E3779B97F4A7C15ull) >> 32);
  }
};

}  // namespace arete
