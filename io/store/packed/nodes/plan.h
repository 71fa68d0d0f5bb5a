// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "io/store/format/slot_to_node.h"
#include "io/store/packed/nodes/arrays.h"
#include "io/store/packed/nodes/layout.h"

namespace arete::packed {

/// How nodes are distributed. The rule is fixed, so that the bytes depend on the model alone.
struct PlanRule {
  /// Samples along the side of a tile of class 0: small enough for the nodes of a tile to stay near a
  /// processor's second cache, large enough that most nodes lie inside a tile.
  double tileSamples = 128;
  /// The width of a tile in reaches: the largest reach of its class.
  double reachesPerTile = 8;
  /// The binary logarithm of the width of a tile in tiles of the class below.
  int levelsPerClass = 2;
  /// Nodes of large errors are of higher classes too: the largest bands together whose nodes are at most this
  /// share of all are of class 1 at least. For each further class the share is divided by the area of a tile
  /// in tiles of the class below. 0: classes are of reaches alone.
  double shareOfClassOne = 0;
  /// A segment ends with the run that brings it to this number of nodes, and to as many as all segments
  /// before it have; 0: a packet is one segment.
  std::uint32_t segmentNodes = 0;

  bool isPaged() const { return segmentNodes > 0; }
};
/// Pages (docs/decisions/0063): a coarse question finds its nodes together, and reads few others.
inline constexpr PlanRule kPageRule{
    .tileSamples = 64, .reachesPerTile = 4, .levelsPerClass = 1, .shareOfClassOne = 0.05, .segmentNodes = 64};

/// The packet and band of each node of a model.
struct Plan {
  Directory directory;  ///< runs with their sizes; no bytes yet
  SlotToNode owners;    ///< of the model
  UninitializedVector<std::uint8_t>
      band;  ///< per node: the band of the least saturated error that law 6 allows
  UninitializedVector<std::uint32_t> packetOf;  ///< per node
  /// Per node: the number of triangles of its floor that its own packet creates.
  UninitializedVector<std::uint8_t> ownParents;
  std::vector<std::vector<std::uint32_t>> listed;  ///< per packet: its nodes without such triangles, rising

  explicit Plan(const MtArrays& arrays) : owners(arrays) {}
};

/// Distributes the nodes of an MT to packets. Precondition: its indices are in range, parents come first
/// (checkAmtIndices). O(triangles), 16 bytes per node, of which 12 stay.
Plan planPackets(const MultiTriangulation& mt, const MtKind& kind, const PlanRule& rule = {});

}  // namespace arete::packed
