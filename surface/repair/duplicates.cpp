// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles with the same vertices are side by side when sorted by their corners from the lowest on; those of
// the same turn are duplicates, those of either turn a sheet with two sides, which stays.
#include <algorithm>
#include <utility>

#include "surface/repair/draft.h"

namespace arete::repair_passes {

void removeDuplicates(Draft& draft) {
  const auto& triangles = draft.mesh.triangles;
  std::vector<std::pair<Triangle, std::uint32_t>> sorted;
  sorted.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    Triangle t = triangles[i];
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());  // keeps the turn
    sorted.push_back({t, i});
  }
  std::ranges::sort(sorted);
  std::vector<std::uint8_t> isGone(triangles.size(), 0);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[i - 1].first) continue;
    isGone[sorted[i].second] = 1;
    ++draft.counts.duplicateTriangles;
  }
  draft.removeTriangles(isGone);
}

}  // namespace arete::repair_passes
