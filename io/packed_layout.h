// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/multitriangulation.h"
#include "io/packed_symbols.h"
#include "io/rans.h"

namespace arete::packed {

/// The nodes of one chunk in one band: consecutive nodes of the MT.
struct Run {
  std::uint32_t band = 0;
  std::uint32_t nodes = 0, slots = 0;
  std::uint32_t listed = 0;  ///< nodes without a parent in the chunk; they come first
  // Known once all runs are: the ids of the first of each.
  std::uint32_t firstNode = 0, firstSlot = 0;
};

/// Nodes that can be read together. The nodes of the highest bands are chunk 0. Of the others, each has a
/// rectangle of tiles: its own tile and the rectangles of its parents, rounded outwards to tiles of the least
/// level at which it has at most 2 x 2 of them (a tile of level l is 2^l x 2^l tiles), and no level below its
/// parents'. Nodes with the same rectangle and level are a chunk. A node's parents are in its own chunk, in
/// chunk 0, or in chunks of lower rank whose rectangles are parts of its own.
struct Chunk {
  enum class Kind : std::uint8_t { coarse = 0, one = 1, two = 2, four = 3 };
  Kind kind = Kind::coarse;
  std::uint8_t level = 0;
  std::uint32_t row = 0, column = 0, rowEnd = 0, columnEnd = 0;  ///< tiles of level 0; unused in chunk 0
  /// Plan coordinates: a box around the floors and stars of its nodes.
  double xMin = 0, yMin = 0, xMax = 0, yMax = 0;
  std::vector<Run> runs;                                  ///< bands falling, no empty runs
  std::array<std::uint32_t, kStreams + 1> streamBytes{};  ///< the last: raw bits
  std::uint64_t checksum = 0;                             ///< of the streams' bytes

  /// Chunks of the same rank do not lean on each other.
  unsigned rank() const { return kind == Kind::coarse ? 0 : level * 3u + static_cast<unsigned>(kind); }

  // Derived.
  std::uint64_t offset = 0;
  std::uint32_t nodes = 0;
  std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (const std::uint32_t b : streamBytes) sum += b;
    return sum;
  }
  /// Whether nodes of this chunk may have parents in `other` (a chunk before it).
  bool mayLeanOn(const Chunk& other) const;
};

struct Directory {
  std::array<std::uint8_t, MultiTriangulation::kBands> bandClass{};
  double tileX = 0, tileY = 0, tileSize = 1;  ///< tile (row, column) begins at tileX + column * tileSize, ...
  std::vector<Chunk> chunks;                  ///< by rising rank; at least chunk 0

  /// Fills in what is derived: offsets, sums, and the ids of the runs: bands falling, then chunks.
  void number();
  std::uint64_t nodes() const;
  std::uint64_t slots() const;
};

/// A chunk takes at least a bit for every two things it tells of (nodes, and in chunk 0 vertices and
/// triangles of the root), filled up with zeros if need be: so a small file cannot call for much memory.
constexpr std::uint64_t leastBytes(std::uint64_t things) {
  return (things + 15) / 16;
}

std::vector<std::byte> toBytes(const Directory& directory);
/// Everything said above holds; sums do not overflow, and are no larger than what 32-bit ids can number.
/// Nothing, and a sentence, when not.
std::optional<Directory> directoryOf(std::span<const std::byte> bytes, std::string& problem);

std::vector<std::byte> toBytes(std::span<const RansTable> tables);
/// kTables tables, or nothing.
std::optional<std::vector<RansTable>> tablesOf(std::span<const std::byte> bytes);

}  // namespace arete::packed
