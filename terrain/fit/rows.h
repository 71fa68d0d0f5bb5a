// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/fit/mesh.h"

namespace arete {

/// The samples of a mesh by triangle, with their weights: what sweeps over a whole mesh read again and again.
/// Residuals are in units of the sample's bound, as in FitPatch. The mesh must not lose triangles afterwards.
class FitRows {
 public:
  struct Row {
    std::array<double, 3> weight;  ///< of the triangle's corners; they sum to 1
    double height;                 ///< of the sample
  };

  /// O(samples), parallel; 32 bytes per sample, and 8 more where bounds differ. @throw std::bad_alloc
  explicit FitRows(const FitMesh& mesh);

  std::span<const Row> of(std::uint32_t slot) const {
    return std::span(rows_).subspan(first_[slot], first_[slot + 1] - first_[slot]);
  }
  /// 1 / bound of the row with an index within of(slot).
  double perBound(std::uint32_t slot, std::size_t row) const {
    return perBound_.empty() ? perBoundEverywhere_ : perBound_[first_[slot] + row];
  }
  /// Whether a row's bound is larger than the least one: outside a region.
  bool isLoose(std::uint32_t slot, std::size_t row) const {
    return !perBound_.empty() && perBound_[first_[slot] + row] < perBoundEverywhere_;
  }
  bool hasLooseRows() const { return !perBound_.empty(); }

 private:
  std::vector<std::size_t> first_;  // per slot, and the end
  std::vector<Row> rows_;
  std::vector<double> perBound_;  // empty where all bounds are the same
  double perBoundEverywhere_ = 0;
};

/// z_TIN - z_sample, from differences of heights.
inline double residualOf(const FitRows::Row& row, const std::array<double, 3>& corner) {
  return row.weight[0] * (corner[0] - row.height) + row.weight[1] * (corner[1] - row.height) +
         row.weight[2] * (corner[2] - row.height);
}

}  // namespace arete
