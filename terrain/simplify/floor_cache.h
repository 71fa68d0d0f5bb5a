// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/simplify/measured_floor.h"

namespace arete {

/// The floors that the looks of a level have measured, until those that were chosen go: of levels that are
/// small enough for a cache. Late levels are, and there most of the time goes into measuring.
class FloorCache {
 public:
  /// A level in which so many are looked at, of vertices that have so many places.
  void begin(std::size_t looks, std::size_t places) {
    isKeeping_ = looks <= kMostLooks && places <= kMostPlaces;
    if (!isKeeping_) return;
    if (floors_.size() < looks) floors_.resize(looks);
    if (lookAt_.size() <= places) lookAt_.resize(places + 1);
  }

  /// Where the i-th look, of the vertex with this place, shall keep its floor, which is empty; null if
  /// nowhere. Safe for different looks at once. Called for each of them.
  MeasuredFloor* keep(std::size_t i, std::uint32_t place) {
    if (!isKeeping_) return nullptr;
    lookAt_[place] = static_cast<std::uint32_t>(i);
    floors_[i].clear();
    return &floors_[i];
  }

  /// What the look of this level has kept of the vertex with this place; null if nothing. Precondition:
  /// keep() was called for it in this level.
  MeasuredFloor* of(std::uint32_t place) { return isKeeping_ ? &floors_[lookAt_[place]] : nullptr; }

 private:
  static constexpr std::size_t kMostLooks = 4096, kMostPlaces = 1 << 17;

  bool isKeeping_ = false;
  std::vector<MeasuredFloor> floors_;  // per look
  std::vector<std::uint32_t> lookAt_;  // per place
};

}  // namespace arete
