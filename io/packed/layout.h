// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/mt/multitriangulation.h"
#include "io/packed/rans.h"
#include "io/packed/tables.h"

namespace arete::packed {

/// The nodes of one chunk in one band: consecutive nodes of the MT.
struct Run {
  std::uint32_t band = 0;
  std::uint32_t nodes = 0, slots = 0;
  std::uint32_t listed = 0;  ///< nodes without a parent in the chunk; they come first
  // Known once all runs are: the ids of the first of each.
  std::uint32_t firstNode = 0, firstSlot = 0;
};

/// Nodes that are read one after the other. Their parents are in the chunk itself and in those that it leans
/// on; the root's triangles and its vertices come with chunk 0.
struct Chunk {
  std::vector<std::uint32_t> leansOn;  ///< chunks before this one, rising; all others lean on chunk 0
  /// Plan coordinates: a box around the floors and stars of its nodes.
  double xMin = 0, yMin = 0, xMax = 0, yMax = 0;
  std::vector<Run> runs;      ///< bands falling, no empty runs
  std::uint32_t borders = 0;  ///< triangles that it leaves to chunks that lean on it
  std::array<std::uint32_t, kParts> streamBytes{};
  std::uint64_t checksum = 0;  ///< of the streams' bytes

  // Derived.
  std::uint64_t offset = 0;
  std::uint32_t nodes = 0;
  std::uint64_t firstBorder = 0;  ///< those of the chunks before it
  bool isCut = false;             ///< the runs of its last bands are not wanted
  std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (const std::uint32_t b : streamBytes) sum += b;
    return sum;
  }
};

struct Directory {
  std::array<std::uint8_t, MultiTriangulation::kBands> bandClass{};
  std::vector<Chunk> chunks;  ///< at least chunk 0

  /// Fills in what is derived: offsets, sums, and the ids of the runs: bands falling, then chunks.
  void number();
  std::uint64_t nodes() const;
  std::uint64_t slots() const;
  std::uint64_t borders() const;
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
