// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vec.h"
#include "io/formats/glb/reader/primitive.h"
#include "io/formats/glb/reader/transform.h"

namespace arete {

/// The vertices of the primitives that share all accessors of their attributes, their morph targets and their
/// place, and which of them are used. First use() all, then number() once, then the rest.
class VertexGroup {
 public:
  /// @param like One of the primitives; must outlive this.
  VertexGroup(const GltfPrimitive& like, const Affine& place) : primitive(like), placed(place) {}

  const GltfPrimitive& primitive;
  Affine placed;              ///< from the accessor to the scene
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

  /// @return The position of a vertex in the scene.
  Vec3 positionOf(std::uint32_t vertex) const;
  /// @return A number of an attribute, with the fraction taken, moved by the morph targets.
  double valueOf(const GltfAttribute& attribute, std::uint32_t vertex, std::size_t component) const;

 private:
  bool isDense() const { return primitive.vertices() / 4 <= corners; }

  std::vector<std::uint32_t> used_;   ///< sorted once numbered; empty: all are used
  std::vector<std::uint32_t> table_;  ///< dense: by vertex; while it is marked, 1 for those that are used
  std::uint32_t base_ = 0;
};

}  // namespace arete
