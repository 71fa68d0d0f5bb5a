// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace arete {

/// A page of a paged file as a query needs it: from its beginning down to a band, with which its last needed
/// segment ends or goes on.
struct PageNeed {
  std::uint64_t page = 0;            ///< its number among all of the file
  std::uint32_t lowestBand = 0;      ///< the last band that is needed
  std::span<const std::byte> bytes;  ///< in the file: all segments down to that band; none may be needed
};

}  // namespace arete
