// SPDX-License-Identifier: GPL-3.0-or-later
//
// A hash table of vertex indices with linear probing. The key of an entry is its position in the list of
// positions. The finaliser of splitmix64 mixes the bits of each coordinate into the hash, so that a regular
// grid spreads over the whole table.
#include "io/formats/common/vertex_welder.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace arete {

namespace {

constexpr std::uint32_t kFree = 0xFFFFFFFF;
constexpr std::size_t kFewestSlots = 64;

std::uint64_t mixed(std::uint64_t h) {
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9U;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBU;
  return h ^ (h >> 31);
}

std::uint64_t hashOf(const Vec3& p) {
  std::uint64_t h = 0;
  for (const double value : {p.x, p.y, p.z})
    h = mixed(h + 0x9E3779B97F4A7C15U + std::bit_cast<std::uint64_t>(value));
  return h;
}

}  // namespace

VertexWelder::VertexWelder(std::size_t expected) {
  positions_.reserve(expected);
  grow(std::max(kFewestSlots, std::bit_ceil(2 * expected)));
}

void VertexWelder::grow(std::size_t slots) {
  slots_.assign(slots, kFree);
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    std::size_t slot = hashOf(positions_[v]) & (slots - 1);
    while (slots_[slot] != kFree) slot = (slot + 1) & (slots - 1);
    slots_[slot] = static_cast<std::uint32_t>(v);
  }
}

std::uint32_t VertexWelder::add(Vec3 position) {
  position = {position.x + 0.0, position.y + 0.0, position.z + 0.0};  // -0 becomes 0
  std::size_t slot = hashOf(position) & (slots_.size() - 1);
  for (; slots_[slot] != kFree; slot = (slot + 1) & (slots_.size() - 1))
    if (positions_[slots_[slot]] == position) return slots_[slot];
  const auto number = static_cast<std::uint32_t>(positions_.size());
  slots_[slot] = number;
  positions_.push_back(position);
  if (2 * positions_.size() > slots_.size()) grow(2 * slots_.size());
  return number;
}

std::vector<Vec3> VertexWelder::take() {
  slots_.assign(kFewestSlots, kFree);
  return std::exchange(positions_, {});
}

}  // namespace arete
