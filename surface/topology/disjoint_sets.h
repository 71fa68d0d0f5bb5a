// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/memory/uninitialized_vector.h"

namespace arete {

/// Disjoint sets of 0 .. size - 1 [TarjanVanLeeuwen1984]: union to the lower number, path halving. The lowest
/// number of a set stands for it, so the result does not depend on the order of the unions.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a > b) std::swap(a, b);
    parent_[b] = a;
  }
  /// Numbers the sets from 0 in the order of their lowest members.
  /// @param count receives how many there are.
  /// @return the number of the set of each member.
  UninitializedVector<std::uint32_t> numbered(std::uint32_t& count) {
    UninitializedVector<std::uint32_t> number(parent_.size());
    count = 0;
    for (std::uint32_t i = 0; i < parent_.size(); ++i) {
      const std::uint32_t lowest = find(i);
      number[i] = lowest == i ? count++ : number[lowest];
    }
    return number;
  }

 private:
  UninitializedVector<std::uint32_t> parent_;
};

}  // namespace arete
