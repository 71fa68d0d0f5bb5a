// SPDX-License-Identifier: GPL-3.0-or-later
//
// One in ten to twenty is due, nobody knows which: so the look writes every vertex down and moves on by the
// outcome of the comparison, without a branch.
#include "engine/simplify/threshold_list.h"

#include <algorithm>
#include <utility>

namespace arete {
namespace {

constexpr std::size_t kChunk = 1 << 14;

}  // namespace

void ThresholdList::assign(std::span<const std::uint32_t> vertices, std::span<const std::uint8_t> isStaying) {
  // All threads fill them: there are many, and the memory is fresh.
  place_.resize(isStaying.size());
  forRanges(LoopThreads::all, place_.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::fill(place_.begin() + std::ptrdiff_t(begin), place_.begin() + std::ptrdiff_t(end), kNobody);
  });
  vertices_.resize(vertices.size() + 1);
  dueAt_.resize(vertices_.size());
  vertices_[kNobody] = kNone;
  dueAt_[kNobody] = kNow;
  std::atomic<std::size_t> staying = 0;
  forRanges(LoopThreads::all, vertices.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::size_t stayingHere = 0;
    for (std::size_t i = begin; i != end; ++i) {
      const std::uint32_t v = vertices[i];
      const std::size_t place = kNobody + 1 + i;
      vertices_[place] = v;
      dueAt_[place] = isStaying[v] != 0 ? kNever : kNow;
      place_[v] = static_cast<std::uint32_t>(place);
      stayingHere += isStaying[v] != 0 ? 1 : 0;
    }
    staying += stayingHere;
  });
  staying_ = staying;
  waiting_ = vertices.size() - staying_;
}

void ThresholdList::collect(double threshold, std::vector<std::uint32_t>& due, Space& space) const {
  space(everything().size(), kChunk, due, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
    const std::size_t first = everything().begin;
    return collectTo(first + begin, first + end, threshold, to);
  });
}

void ThresholdList::collect(Piece piece, double threshold, UninitializedVector<std::uint32_t>& due) const {
  due.resize(piece.size());
  std::uint32_t* const end = collectTo(piece.begin, piece.end, threshold, due.data());
  due.resize(static_cast<std::size_t>(end - due.data()));
}

std::uint32_t* ThresholdList::collectTo(std::size_t begin, std::size_t end, double threshold,
                                        std::uint32_t* to) const {
  for (std::size_t place = begin; place < end; ++place) {
    *to = vertices_[place];
    to += dueAt_[place] <= threshold ? 1 : 0;
  }
  return to;
}

void ThresholdList::collect(std::span<const std::uint32_t> some, double threshold,
                            std::vector<std::uint32_t>& due, Space& space) const {
  space(some.size(), kChunk, due, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
    for (const std::uint32_t v : some.subspan(begin, end - begin)) {
      *to = v;
      to += place_[v] != kNobody && dueAt_[place_[v]] <= threshold ? 1 : 0;
    }
    return to;
  });
}

void ThresholdList::remove(std::span<const std::uint32_t> gone, LoopThreads threads) {
  forRanges(threads, gone.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (const std::uint32_t v : gone.subspan(begin, end - begin)) {
      std::uint32_t& place = place_[v];
      dueAt_[place] = kNever;
      vertices_[place] = kNone;
      place = kNobody;
    }
  });
  waiting_ -= gone.size();
}

void ThresholdList::sort(std::vector<std::uint32_t>& vertices) const {
  std::ranges::sort(vertices, {}, [&](std::uint32_t v) { return place_[v]; });
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

float ThresholdList::least() const {
  float least = kNever;
  for (std::size_t place = kNobody + 1; place < dueAt_.size(); ++place)
    least = std::min(least, dueAt_[place]);
  return least;
}

float ThresholdList::thresholdOf(double part) const {
  constexpr std::size_t kMost = 1024, kFewest = 64;
  std::vector<float> sample;
  for (std::size_t place = kNobody + 1; place < dueAt_.size(); place += dueAt_.size() / kMost + 1)
    if (dueAt_[place] < kNever) sample.push_back(dueAt_[place]);
  if (sample.size() < kFewest) return kNow;
  const auto at = sample.begin() + static_cast<std::ptrdiff_t>(part * double(sample.size()));
  std::nth_element(sample.begin(), at, sample.end());
  return *at;
}

void ThresholdList::forgetGone() {
  if (waiting_ + staying_ + 1 >= vertices_.size() / 2) return;
  UninitializedVector<std::uint32_t> kept;  // places
  const std::size_t first = everything().begin;
  Space()(everything().size(), kChunk, kept, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
    for (std::size_t place = first + begin; place < first + end; ++place) {
      *to = static_cast<std::uint32_t>(place);
      to += vertices_[place] != kNone ? 1 : 0;
    }
    return to;
  });
  UninitializedVector<std::uint32_t> vertices(first + kept.size());
  UninitializedVector<float> dueAt(vertices.size());
  vertices[kNobody] = vertices_[kNobody];
  dueAt[kNobody] = dueAt_[kNobody];
  forRanges(LoopThreads::all, kept.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      const std::size_t place = first + i;
      vertices[place] = vertices_[kept[i]];
      dueAt[place] = dueAt_[kept[i]];
      place_[vertices[place]] = static_cast<std::uint32_t>(place);
    }
  });
  vertices_ = std::move(vertices);
  dueAt_ = std::move(dueAt);
}

}  // namespace arete
