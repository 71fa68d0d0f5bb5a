// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where most positions are used, a table has the number of each. Where few are, as of an accessor that many
// small meshes share, the used ones are a sorted list.
#include "io/formats/glb/reader/vertex_group.h"

#include <algorithm>

namespace arete {

bool VertexGroup::use(std::uint32_t vertex) {
  if (vertex >= primitive.vertices()) return false;
  if (isDense()) {
    if (table_.empty()) table_.resize(primitive.vertices(), 0);
    table_[vertex] = 1;
  } else {
    used_.push_back(vertex);
  }
  return true;
}

std::uint64_t VertexGroup::number(std::uint64_t base, bool all) {
  base_ = static_cast<std::uint32_t>(base);
  std::uint64_t count = 0;
  if (isDense()) {
    for (const std::uint32_t mark : table_) count += mark;
  } else {
    std::ranges::sort(used_);
    used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
    count = used_.size();
  }
  if (all || count == primitive.vertices()) {
    used_.clear();
    table_.clear();
    return primitive.vertices();
  }
  if (!isDense()) return count;
  used_.reserve(count);
  for (std::uint32_t v = 0; v < table_.size(); ++v) {
    if (table_[v] == 0) continue;
    table_[v] = static_cast<std::uint32_t>(used_.size());
    used_.push_back(v);
  }
  return count;
}

std::uint32_t VertexGroup::indexOf(std::uint32_t vertex) const {
  if (used_.empty()) return base_ + vertex;
  if (!table_.empty()) return base_ + table_[vertex];
  return base_ + static_cast<std::uint32_t>(std::ranges::lower_bound(used_, vertex) - used_.begin());
}

double VertexGroup::valueOf(const GltfAttribute& attribute, std::uint32_t vertex,
                            std::size_t component) const {
  double value = attribute.elements.value(vertex, component);
  for (const GltfMorph& morph : primitive.morphs)
    if (morph.name == attribute.name && component < morph.moves.components)
      value += morph.weight * morph.moves.value(vertex, component);
  return value;
}

Vec3 VertexGroup::positionOf(std::uint32_t vertex) const {
  const GltfAttribute& positions = primitive.attributes.front();
  const Vec3 p{valueOf(positions, vertex, 0), valueOf(positions, vertex, 1), valueOf(positions, vertex, 2)};
  return placed.isIdentity() ? p : placed(p);  // -0 stays
}

}  // namespace arete
