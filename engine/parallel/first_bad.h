// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Finds the least i in [0, size) with isBad(i), in parallel; skips most indices above one that is known to
/// be bad.
/// @return nothing if no index is bad; undefined if the context was cancelled meanwhile.
template <class IsBad>
std::optional<std::uint32_t> firstBad(std::size_t size, const RunContext& context, const IsBad& isBad) {
  constexpr std::size_t kBlock = 1 << 14;
  std::atomic<std::size_t> first = size;
  const std::size_t blocks = (size + kBlock - 1) / kBlock;
  parallelFor(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t begin = block * kBlock, end = std::min(size, begin + kBlock);
    if (context.cancelled() || begin > first.load(std::memory_order_relaxed)) return;
    for (std::size_t i = begin; i < end; ++i) {
      if (!isBad(static_cast<std::uint32_t>(i))) continue;
      std::size_t known = first;
      while (i < known && !first.compare_exchange_weak(known, i)) {
      }
      return;
    }
  });
  if (first == size) return std::nullopt;
  return static_cast<std::uint32_t>(first.load());
}

}  // namespace arete
