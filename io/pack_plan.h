// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "io/packed_layout.h"
#include "terrain/terrain_model.h"

namespace arete::packed {

/// Which node of a model goes into which chunk and band.
struct Plan {
  Directory directory;                        ///< runs with their sizes; no bytes yet
  std::vector<std::uint32_t> creator;         ///< per slot of the model: its node
  std::vector<std::uint16_t> saturatedError;  ///< per node: the least that law 6 allows
  std::vector<std::uint32_t> chunkOf;         ///< per node
  std::vector<std::uint8_t> ownParents;       ///< per node: triangles of its floor that its own chunk creates
  std::vector<std::vector<std::uint32_t>> listed;  ///< per chunk: nodes with none of those
};

/// Precondition: the indices of the model's MT are in range, parents come first (checkAmtIndices).
/// O(triangles).
Plan planChunks(const TerrainModel& model);

}  // namespace arete::packed
