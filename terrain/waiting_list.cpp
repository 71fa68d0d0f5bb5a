// SPDX-License-Identifier: GPL-3.0-or-later
//
// One in ten to twenty is due, nobody knows which: so the look writes every vertex down and moves on by the
// outcome of the comparison, without a branch.
#include "terrain/waiting_list.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace arete {
namespace {

constexpr std::size_t kChunk = 1 << 14;

}  // namespace

void WaitingList::assign(std::vector<std::uint32_t> vertices, std::uint32_t vertexCount) {
  vertices_ = std::move(vertices);
  living_ = vertices_.size();
  vertices_.insert(vertices_.begin(), kGone);
  dueAt_.assign(vertices_.size(), kNow);
  place_.assign(vertexCount, kNobody);
  for (std::uint32_t place = kNobody + 1; place < vertices_.size(); ++place) place_[vertices_[place]] = place;
}

void WaitingList::collect(double threshold, std::vector<std::uint32_t>& due) {
  if (living_ + 1 < vertices_.size() / 2) forgetGone();
  const std::size_t first = kNobody + 1;
  filter_(vertices_.size() - first, kChunk, due, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
    const float* dueAt = dueAt_.data() + first;
    const std::uint32_t* vertex = vertices_.data() + first;
    for (std::size_t i = begin; i < end; ++i) {
      *to = vertex[i];
      to += dueAt[i] <= threshold ? 1 : 0;
    }
    return to;
  });
}

void WaitingList::remove(std::span<const std::uint32_t> gone) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, gone.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      std::uint32_t& place = place_[gone[i]];
      dueAt_[place] = kNever;
      vertices_[place] = kGone;
      place = kNobody;
    }
  });
  living_ -= gone.size();
}

float WaitingList::least() const {
  float least = kNever;
  for (std::size_t place = kNobody + 1; place < dueAt_.size(); ++place)
    least = std::min(least, dueAt_[place]);
  return least;
}

void WaitingList::forgetGone() {
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
