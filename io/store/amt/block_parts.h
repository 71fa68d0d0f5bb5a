// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace arete {

/// What to fetch of a server where some parts of a paged file are wanted: a request costs more time than some
/// hundred kilobytes, and the blocks of the directory lead to further ones. Where many blocks of a small
/// directory are wanted, all of it is fetched, with the first pages, which every question needs; else blocks
/// that are near each other are joined.
///
/// @param parts  of the file, in any order
/// @param blocks, nodes  where the directory below its root and the pages lie
/// @return parts that hold all of `parts`. O(n log n)
std::vector<std::span<const std::byte>> withBlocksJoined(std::span<const std::span<const std::byte>> parts,
                                                         std::span<const std::byte> blocks,
                                                         std::span<const std::byte> nodes);

}  // namespace arete
