// SPDX-License-Identifier: GPL-3.0-or-later
//
// One in ten to twenty is due, nobody knows which: so the look writes every vertex down and moves on by the
// outcome of the comparison, without a branch.
#include "terrain/waiting_list.h"

#include <algorithm>

namespace arete {
namespace {

constexpr std::size_t kChunk = 1 << 14;

}  // namespace

void WaitingList::assign(std::vector<std::uint32_t> vertices, std::span<const std::uint8_t> isStaying) {
  vertices_ = std::move(vertices);
  vertices_.insert(vertices_.begin(), kGone);
  dueAt_.assign(vertices_.size(), kNow);
  place_.assign(isStaying.size(), kNobody);
  staying_ = 0;
  for (std::uint32_t place = kNobody + 1; place < vertices_.size(); ++place) {
    const std::uint32_t v = vertices_[place];
    place_[v] = place;
    if (isStaying[v] == 0) continue;
    dueAt_[place] = kNever;
    ++staying_;
  }
  waiting_ = vertices_.size() - 1 - staying_;
}

void WaitingList::collect(double threshold, std::vector<std::uint32_t>& due, Space& space) const {
  space(everything().size(), kChunk, due, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
    const std::size_t first = everything().begin;
    return collectTo(first + begin, first + end, threshold, to);
  });
}

void WaitingList::collect(Piece piece, double threshold, UninitializedVector<std::uint32_t>& due) const {
  due.resize(piece.size());
  std::uint32_t* const end = collectTo(piece.begin, piece.end, threshold, due.data());
  due.resize(static_cast<std::size_t>(end - due.data()));
}

std::uint32_t* WaitingList::collectTo(std::size_t begin, std::size_t end, double threshold,
                                      std::uint32_t* to) const {
  for (std::size_t place = begin; place < end; ++place) {
    *to = vertices_[place];
    to += dueAt_[place] <= threshold ? 1 : 0;
  }
  return to;
}

void WaitingList::collect(std::span<const std::uint32_t> some, double threshold,
                          std::vector<std::uint32_t>& due, Space& space) const {
  space(some.size(), kChunk, due, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
    for (const std::uint32_t v : some.subspan(begin, end - begin)) {
      *to = v;
      to += place_[v] != kNobody && dueAt_[place_[v]] <= threshold ? 1 : 0;
    }
    return to;
  });
}

void WaitingList::remove(std::span<const std::uint32_t> gone, LoopThreads threads) {
  forRanges(threads, gone.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (const std::uint32_t v : gone.subspan(begin, end - begin)) {
      std::uint32_t& place = place_[v];
      dueAt_[place] = kNever;
      vertices_[place] = kGone;
      place = kNobody;
    }
  });
  waiting_ -= gone.size();
}

void WaitingList::sort(std::vector<std::uint32_t>& vertices) const {
  std::ranges::sort(vertices, {}, [&](std::uint32_t v) { return place_[v]; });
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

float WaitingList::least() const {
  float least = kNever;
  for (std::size_t place = kNobody + 1; place < dueAt_.size(); ++place)
    least = std::min(least, dueAt_[place]);
  return least;
}

void WaitingList::forgetGone() {
  if (waiting_ + staying_ + 1 >= vertices_.size() / 2) return;
  std::uint32_t kept = kNobody + 1;
  for (std::size_t i = kept; i < vertices_.size(); ++i) {
    if (vertices_[i] == kGone) continue;
    vertices_[kept] = vertices_[i];
    dueAt_[kept] = dueAt_[i];
    place_[vertices_[kept]] = kept;
    ++kept;
  }
  vertices_.resize(kept);
  dueAt_.resize(kept);
}

}  // namespace arete
