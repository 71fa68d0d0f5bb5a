// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/simplify/star_prefetch.h"

namespace arete {

inline constexpr std::size_t kHeightsAhead = 12;  ///< prefetch distance of heights, in vertices

/// Prefetches what the evaluation of the next vertices of a list reads, on the visit of its i-th.
template <class State, class Vertices>
[[gnu::always_inline]] inline void prefetchForEvaluation(const State& state, const Vertices& vertices,
                                                         std::size_t i) {
  prefetchStars(state.mesh, i, vertices.size(), [&](std::size_t k) { return vertices[k]; });
  if (i + kHeightsAhead >= vertices.size()) return;
  const VertexId v = vertices[i + kHeightsAhead];
  state.errors.prefetch(v);
  __builtin_prefetch(&state.records[v], 1);
  state.thresholds.prefetch(v);
}

}  // namespace arete
