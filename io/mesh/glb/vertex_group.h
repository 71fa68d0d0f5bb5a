// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/vec.h"
#include "io/mesh/glb/document.h"

namespace arete {

/// A morph target that moves positions, with its weight.
struct MorphTarget {
  std::uint64_t accessor = 0;
  double weight = 0;
  GltfDocument::Elements moves;  ///< one for each position

  bool operator==(const MorphTarget& other) const {
    return accessor == other.accessor && weight == other.weight;
  }
};

/// The vertices of the primitives of a mesh that share an accessor of positions and its morph targets, and
/// which of them are used. First use() all, then number() once, then the rest.
class VertexGroup {
 public:
  VertexGroup(std::uint64_t accessor, const GltfDocument::Elements& elements, std::vector<MorphTarget> moved)
      : position(accessor), positions(elements), targets(std::move(moved)) {}

  std::uint64_t position;  ///< the accessor
  GltfDocument::Elements positions;
  std::vector<MorphTarget> targets;
  std::uint64_t corners = 0;  ///< of all primitives: an upper bound on the vertices that are used

  /// Marks a vertex as used. False if there is none of that index. Memory and time are of the order of
  /// `corners`, however many positions the accessor has.
  bool use(std::uint32_t vertex);

  /// Numbers the vertices that are used, or all, in their order in the accessor.
  ///
  /// @param base The number of the first.
  /// @return How many they are.
  std::uint64_t number(std::uint64_t base, bool all);

  /// @return The index in the accessor of the i-th vertex that was numbered.
  std::uint32_t vertex(std::uint64_t i) const {
    return used_.empty() ? static_cast<std::uint32_t>(i) : used_[i];
  }
  /// @return The number of a vertex that was marked.
  std::uint32_t indexOf(std::uint32_t vertex) const;

  /// @return The position of a vertex, moved by the targets.
  Vec3 positionOf(std::uint32_t vertex) const;

 private:
  bool isDense() const { return positions.count / 4 <= corners; }

  std::vector<std::uint32_t> used_;   ///< sorted once numbered; empty: all are used
  std::vector<std::uint32_t> table_;  ///< dense: by vertex; while it is marked, 1 for those that are used
  std::uint32_t base_ = 0;
};

}  // namespace arete
