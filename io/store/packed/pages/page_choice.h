// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/mt/outward_scale.h"
#include "io/store/format/load_parts.h"
#include "io/store/format/required_error.h"
#include "io/store/packed/nodes/layout.h"
#include "io/store/packed/pages/directory_blocks.h"

namespace arete::packed {

/// The pages that a query needs, with all that they depend on.
struct PageChoice {
  /// The pages, in their order and numbered among themselves; each down to the segment that holds the last
  /// band that is required of it. Their headers have not been read.
  Directory directory;
  std::vector<std::uint32_t> lowest;  ///< per page: the last band that is required
  bool isEvenly = false;              ///< that band is the same in all pages
};

/// Chooses pages from the root down, reading the blocks that may hold one. A page is required down to the
/// band of the error that is required of its box, and so are the pages that it depends on.
///
/// @param wanted null requires everything
/// Errors: corrupt: a damaged block, by its number; errors of `load`. O(blocks read + pages in them); blocks
/// of one level are loaded at once, and then the blocks of pages that others depend on, a few times.
Result<PageChoice> choosePages(const PageRoot& root, std::span<const std::byte> blocks,
                               const RequiredError& wanted, const OutwardScale& scale, const LoadParts& load);

}  // namespace arete::packed
