// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/box3.h"
#include "engine/mt/multitriangulation.h"
#include "io/store/packed/nodes/layout.h"

namespace arete::packed {

/// The directory of a paged file (docs/topics/amt-format.md, "Pages"): a tree of blocks over the pages in
/// their order. A leaf describes kPagesPerBlock pages, any other block refers to as many blocks of the level
/// below. The root, chunk PAGE, lies at the beginning of the file; the blocks, chunk PBLK, are read where a
/// query needs them.

inline constexpr std::uint32_t kPagesPerBlock = 128;

/// Where a block lies, and what is known of its pages without reading it.
struct BlockEntry {
  std::uint64_t offset = 0;  ///< in the chunk of blocks
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;
  std::uint8_t highestBand = 0;  ///< of all of its pages' runs
  Box3 box;                      ///< around the boxes of its pages
};

/// What the chunk PAGE holds.
struct PageRoot {
  std::array<std::uint8_t, MultiTriangulation::kBands> bandClass{};
  std::array<std::uint64_t, MultiTriangulation::kBands> nodesOfBand{};
  std::uint64_t pages = 0, slots = 0;
  /// Levels of blocks; the entries are of the topmost one.
  std::uint32_t levels = 1;
  std::vector<BlockEntry> entries;

  std::uint64_t nodes() const;
};

/// The two chunks of a directory.
struct PageDirectoryBytes {
  std::vector<std::byte> root, blocks;
};
/// Precondition: the directory's pages are encoded, and numbered. O(pages).
PageDirectoryBytes pageDirectoryBytes(const Directory& directory);

/// Reads the root. @param problem receives a sentence if the bytes are refused
std::optional<PageRoot> pageRootOf(std::span<const std::byte> bytes, std::string& problem);
/// Reads a block that is no leaf: nothing if the bytes are damaged.
std::optional<std::vector<BlockEntry>> blockEntriesOf(std::span<const std::byte> bytes);
/// Reads a leaf: its pages, with the segments as wholes (Segment::headerBytes are all bytes of a segment
/// until its header is read). @param first the number of the first page
/// @return nothing if the bytes are damaged
std::optional<std::vector<Packet>> pagesOf(std::span<const std::byte> bytes, const BlockEntry& entry,
                                           std::uint32_t first);

}  // namespace arete::packed
