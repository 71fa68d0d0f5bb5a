// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace arete {

/// What a glTF has and a mesh has no place for.
struct GltfLeftOut {
  std::uint64_t pointsAndLines = 0, withoutPositions = 0, unknownMaterials = 0;  ///< primitives
  std::uint64_t skinnedNodes = 0;
  bool jointsWithoutSkin = false;
  bool appliedMorphs = false;
  std::uint64_t shownMeshes = 0;         ///< of the document
  std::uint64_t farRotations = 0;        ///< not of length 1, beyond rounding
  std::uint64_t instanceAttributes = 0;  ///< of EXT_mesh_gpu_instancing
  /// Attributes of the file that are damaged or of no use, each with the reason.
  std::map<std::string, std::string> attributes;

  /// One sentence for each kind of thing, with counts and some names: those above, and what the document has
  /// besides its meshes. O(size of the JSON).
  std::vector<std::string> sentences(const nlohmann::json& document) const;
};

/// "a", "b" and 3 more.
std::string listOfNames(const std::vector<std::string>& names);

}  // namespace arete
