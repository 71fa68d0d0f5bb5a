// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/simplify/measured_floor.h"

namespace arete {

/// Keeps the floors (triangulated holes) that a level's evaluations measure until the chosen vertices are
/// removed, but only if the level fits a processor's cache. Late levels fit, and measuring takes most of
/// their time.
class FloorCache {
 public:
  /// Starts a level.
  /// @param evaluations the number of vertices that the level evaluates.
  /// @param indices the number of indices in the ThresholdList.
  void begin(std::size_t evaluations, std::size_t indices) {
    isKeeping_ = evaluations <= kMostEvaluations && indices <= kMostIndices;
    if (!isKeeping_) return;
    if (floors_.size() < evaluations) floors_.resize(evaluations);
    if (evaluationOf_.size() <= indices) evaluationOf_.resize(indices + 1);
  }

  /// An empty floor for the i-th evaluation to fill; null if the level is too large. Call it once for each
  /// evaluation. Thread-safe for different evaluations.
  /// @param index of the vertex in the ThresholdList.
  MeasuredFloor* keep(std::size_t i, std::uint32_t index) {
    if (!isKeeping_) return nullptr;
    evaluationOf_[index] = static_cast<std::uint32_t>(i);
    floors_[i].clear();
    return &floors_[i];
  }

  /// The floor that was kept for the vertex with this index; null if the level is too large. Precondition:
  /// keep() was called for this index in this level.
  MeasuredFloor* of(std::uint32_t index) { return isKeeping_ ? &floors_[evaluationOf_[index]] : nullptr; }

 private:
  static constexpr std::size_t kMostEvaluations = 4096, kMostIndices = 1 << 17;

  bool isKeeping_ = false;
  std::vector<MeasuredFloor> floors_;        // per evaluation
  std::vector<std::uint32_t> evaluationOf_;  // by index
};

}  // namespace arete
