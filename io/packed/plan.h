// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "io/format/slot_to_node.h"
#include "io/packed/layout.h"
#include "terrain/model/terrain_model.h"

namespace arete::packed {

/// Which node of a model goes into which chunk and band.
struct Plan {
  Directory directory;                         ///< runs with their sizes; no bytes yet
  SlotToNode owners;                           ///< of the model
  UninitializedVector<std::uint8_t> band;      ///< per node: of the least saturated error that law 6 allows
  UninitializedVector<std::uint32_t> chunkOf;  ///< per node
  /// Per node: triangles of its floor that its own chunk creates.
  UninitializedVector<std::uint8_t> ownParents;
  std::vector<std::vector<std::uint32_t>> listed;  ///< per chunk: nodes with none of those, rising

  explicit Plan(const MtArrays& arrays) : owners(arrays) {}
};

/// Precondition: the indices of the model's MT are in range, parents come first (checkAmtIndices).
/// O(triangles), 16 bytes per node, of which 12 stay.
Plan planChunks(const TerrainModel& model);

}  // namespace arete::packed
