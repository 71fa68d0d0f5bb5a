// SPDX-License-Identifier: GPL-3.0-or-later
//
// One vertex in ten to twenty is due, in no predictable pattern. So a scan has no branch: it writes every
// vertex to the output and advances the output by the result of the comparison.
#include "engine/simplify/threshold_list.h"

#include <algorithm>
#include <utility>

namespace arete {
namespace {

constexpr std::size_t kVerticesPerSpan = 1 << 14;

}  // namespace

void ThresholdList::assign(std::span<const VertexId> vertices, std::span<const std::uint8_t> isFixed) {
  // All threads fill the arrays: the first write to fresh memory is what takes time.
  index_.resize(isFixed.size());
  forRanges(LoopThreads::all, index_.size(), kVerticesPerSpan, [&](std::size_t begin, std::size_t end) {
    std::fill(index_.begin() + std::ptrdiff_t(begin), index_.begin() + std::ptrdiff_t(end), kNoIndex);
  });
  vertices_.resize(vertices.size() + 1);
  thresholds_.resize(vertices_.size());
  vertices_[kNoIndex] = VertexId();
  thresholds_[kNoIndex] = kNow;
  std::atomic<std::size_t> fixed = 0;
  forRanges(LoopThreads::all, vertices.size(), kVerticesPerSpan, [&](std::size_t begin, std::size_t end) {
    std::size_t fixedHere = 0;
    for (std::size_t i = begin; i != end; ++i) {
      const VertexId v = vertices[i];
      const std::size_t index = kNoIndex + 1 + i;
      vertices_[index] = v;
      thresholds_[index] = isFixed[v.index()] != 0 ? kNever : kNow;
      index_[v] = static_cast<std::uint32_t>(index);
      fixedHere += isFixed[v.index()] != 0 ? 1 : 0;
    }
    fixed += fixedHere;
  });
  fixed_ = fixed;
  removable_ = vertices.size() - fixed_;
}

// The output has room for every vertex, so that a write past the last due one is harmless.
void ThresholdList::collect(double threshold, std::vector<VertexId>& due, Scratch& scratch) const {
  scratch(all().size(), kVerticesPerSpan, due, [&](std::size_t begin, std::size_t end, VertexId* to) {
    const std::size_t first = all().begin;
    return collectTo(first + begin, first + end, threshold, to);
  });
}

void ThresholdList::collect(Tile tile, double threshold, UninitializedVector<VertexId>& due) const {
  due.resize(tile.size());
  VertexId* const end = collectTo(tile.begin, tile.end, threshold, due.data());
  due.resize(static_cast<std::size_t>(end - due.data()));
}

VertexId* ThresholdList::collectTo(std::size_t begin, std::size_t end, double threshold, VertexId* to) const {
  for (std::size_t index = begin; index < end; ++index) {
    *to = vertices_[index];
    to += thresholds_[index] <= threshold ? 1 : 0;
  }
  return to;
}

/// This looks at some vertices only; one that was removed has no index and is passed over.
void ThresholdList::collect(std::span<const VertexId> some, double threshold, std::vector<VertexId>& due,
                            Scratch& scratch) const {
  scratch(some.size(), kVerticesPerSpan, due, [&](std::size_t begin, std::size_t end, VertexId* to) {
    for (const VertexId v : some.subspan(begin, end - begin)) {
      *to = v;
      to += index_[v] != kNoIndex && thresholds_[index_[v]] <= threshold ? 1 : 0;
    }
    return to;
  });
}

/// A removed vertex leaves its place, with a threshold that is never due, until compact() closes the gaps.
/// Vertices are distinct, so threads need no lock.
void ThresholdList::remove(std::span<const VertexId> removed, LoopThreads threads) {
  forRanges(threads, removed.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (const VertexId v : removed.subspan(begin, end - begin)) {
      std::uint32_t& index = index_[v];
      thresholds_[index] = kNever;
      vertices_[index] = VertexId();
      index = kNoIndex;
    }
  });
  removable_ -= removed.size();
}

void ThresholdList::sort(std::vector<VertexId>& vertices) const {
  std::ranges::sort(vertices, {}, [&](VertexId v) { return index_[v]; });
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

// Fixed and removed vertices have the threshold kNever, above any other, so they need no test.
float ThresholdList::least() const {
  float least = kNever;
  for (std::size_t index = kNoIndex + 1; index < thresholds_.size(); ++index)
    least = std::min(least, thresholds_[index]);
  return least;
}

// A sample at even steps is enough, since the quantile only guides the next level. With few vertices left
// everything is due now.
float ThresholdList::quantile(double fraction) const {
  constexpr std::size_t kMost = 1024, kFewest = 64;
  std::vector<float> sample;
  for (std::size_t index = kNoIndex + 1; index < thresholds_.size(); index += thresholds_.size() / kMost + 1)
    if (thresholds_[index] < kNever) sample.push_back(thresholds_[index]);
  if (sample.size() < kFewest) return kNow;
  const auto at = sample.begin() + static_cast<std::ptrdiff_t>(fraction * double(sample.size()));
  std::nth_element(sample.begin(), at, sample.end());
  return *at;
}

void ThresholdList::compact() {
  if (removable_ + fixed_ + 1 >= vertices_.size() / 2) return;
  UninitializedVector<std::uint32_t> kept;  // indices
  const std::size_t first = all().begin;
  ParallelFilter<std::uint32_t>()(all().size(), kVerticesPerSpan, kept,
                                  [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
                                    for (std::size_t index = first + begin; index < first + end; ++index) {
                                      *to = static_cast<std::uint32_t>(index);
                                      to += vertices_[index].isValid() ? 1 : 0;
                                    }
                                    return to;
                                  });
  UninitializedVector<VertexId> vertices(first + kept.size());
  UninitializedVector<float> thresholds(vertices.size());
  vertices[kNoIndex] = vertices_[kNoIndex];
  thresholds[kNoIndex] = thresholds_[kNoIndex];
  forRanges(LoopThreads::all, kept.size(), kVerticesPerSpan, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      const std::size_t index = first + i;
      vertices[index] = vertices_[kept[i]];
      thresholds[index] = thresholds_[kept[i]];
      index_[vertices[index]] = static_cast<std::uint32_t>(index);
    }
  });
  vertices_ = std::move(vertices);
  thresholds_ = std::move(thresholds);
}

}  // namespace arete
