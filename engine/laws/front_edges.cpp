// SPDX-License-Identifier: GPL-3.0-or-later
//
// A counting sort of the sides by their lower ends, then a sort of each vertex's few sides: a tenth of the
// time of one sort of all. Threads place sides in any order; the second sort makes the result independent of
// it.
#include "engine/laws/front_edges.h"

#include <algorithm>
#include <atomic>

#include "engine/parallel/parallel_loops.h"

namespace arete {

FrontEdges::FrontEdges(const Cut& front)
    : begin_(front.vertices.size() + 1), sides_(front.triangles.size() * 3) {
  std::ranges::fill(begin_, 0u);
  const auto forSides = [&](const auto& visit) {
    parallelFor(IndexRange<std::size_t>(0, front.triangles.size(), 4096), [&](const auto& range) {
      for (std::size_t t = range.begin(); t != range.end(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
          const std::uint32_t u = front.triangles[t][i], v = front.triangles[t][(i + 1) % 3];
          visit(std::min(u, v), Side{std::max(u, v), static_cast<std::uint32_t>(3 * t + i)});
        }
    });
  };
  forSides([&](std::uint32_t low, const Side&) {
    std::atomic_ref(begin_[low]).fetch_add(1, std::memory_order_relaxed);
  });
  // begin_ holds ends first; each side that is placed decrements its vertex's.
  std::uint32_t end = 0;
  for (std::uint32_t& b : begin_) b = end += b;
  forSides([&](std::uint32_t low, const Side& side) {
    sides_[std::atomic_ref(begin_[low]).fetch_sub(1, std::memory_order_relaxed) - 1] = side;
  });
  parallelFor(IndexRange<std::uint32_t>(0, vertices(), 4096), [&](const auto& range) {
    for (std::uint32_t v = range.begin(); v != range.end(); ++v)
      std::sort(sides_.begin() + begin_[v], sides_.begin() + begin_[v + 1]);
  });
}

}  // namespace arete
