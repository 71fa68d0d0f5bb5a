// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/mt/multitriangulation.h"
#include "io/store/entropy/rans.h"
#include "io/store/packed/nodes/tables.h"

namespace arete::packed {

/// The nodes of one packet in one band. They are consecutive nodes of the MT.
struct Run {
  std::uint32_t band = 0;
  std::uint32_t nodes = 0, slots = 0;
  std::uint32_t listed = 0;  ///< nodes without a parent in the packet, which come first
  /// The balls of a page's nodes lie in the balls of their stars, grown by this factor, as a code
  /// (spread.h).
  std::uint8_t spread = 0;
  // Set by Directory::number(): ids of the first node and the first slot.
  std::uint32_t firstNode = 0, firstSlot = 0;
};

/// Runs of a packet whose streams are coded and checked by themselves, so that the packet can be read down to
/// the end of one. A packet of the packed form is one segment, a page several.
struct Segment {
  std::uint32_t runs = 0;
  std::array<std::uint32_t, kParts> streamBytes{};
  std::uint64_t checksum = 0;  ///< of the bytes
  /// A page has bytes before the streams, which say what runs there are; the band of the first run; the
  /// nodes.
  std::uint32_t headerBytes = 0, firstBand = 0, nodes = 0;
  std::uint32_t carriedBytes = 0;  ///< of a surface's page: behind the streams (io/store/packed/surface/carried.h)
  std::uint64_t offset = 0;  ///< of the streams; set by Directory::number(), of a page by its directory

  std::uint64_t begin() const { return offset - headerBytes; }
  std::uint64_t bytes() const {
    std::uint64_t sum = std::uint64_t{headerBytes} + carriedBytes;
    for (const std::uint32_t b : streamBytes) sum += b;
    return sum;
  }
};

/// Nodes that are decoded together, one after the other. Their parents are in the packet itself and in those
/// that it depends on. Packet 0 begins with the root's vertices and triangles.
struct Packet {
  std::vector<std::uint32_t>
      dependsOn;  ///< the packets that it depends on, rising, all before it; packets but 0 depend on 0
  /// A box around the floors and stars of its nodes, of a heightfield in plan coordinates; of a page with all
  /// that the floors stand for, and with heights.
  double xMin = 0, yMin = 0, xMax = 0, yMax = 0;
  double zMin = 0, zMax = 0;  ///< of a surface, and of a page
  std::vector<Run> runs;      ///< bands falling, no empty runs
  std::uint32_t borders = 0;  ///< triangles that it leaves to packets that depend on it
  std::vector<Segment> segments;
  std::uint32_t number = 0;  ///< of a page, among all of the file

  // Set by Directory::number().
  std::uint32_t nodes = 0;
  std::uint64_t firstBorder = 0;  ///< borders of the packets before it
  bool isCut = false;             ///< the runs of its last bands are not required, and were dropped
  std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (const Segment& segment : segments) sum += segment.bytes();
    return sum;
  }
};

/// What the chunk PDIR holds.
struct Directory {
  bool isOfSurface = false;
  std::array<std::uint8_t, MultiTriangulation::kBands> bandClass{};
  std::vector<Packet> packets;  ///< at least packet 0

  /// Computes offsets, and numberNodes().
  void number();
  /// Computes sums, and the ids of the runs, which rise through the falling bands and, within a band, through
  /// the packets.
  void numberNodes();
  std::uint64_t nodes() const;
  std::uint64_t slots() const;
  std::uint64_t borders() const;
};

/// The least bytes of a packet: half a bit for each of its nodes (in packet 0 also for the root's vertices
/// and triangles). Smaller packets are padded with zeros, so that a small file cannot make a reader allocate
/// much memory.
constexpr std::uint64_t leastBytes(std::uint64_t things) {
  return (things + 15) / 16;
}

/// The bytes of the chunk PDIR.
std::vector<std::byte> toBytes(const Directory& directory);
/// Reads and checks a directory: all of the above holds, and all sums fit in 32-bit ids.
/// @param isOfSurface  as the metadata says
/// @param problem  receives a sentence if the bytes are refused
/// @return nothing if they are
std::optional<Directory> directoryOf(std::span<const std::byte> bytes, std::string& problem,
                                     bool isOfSurface = false);

}  // namespace arete::packed
