// SPDX-License-Identifier: GPL-3.0-or-later
//
// The set is the one that a greedy pass in the order of costs chooses, found without sorting all candidates
// and without a thread that waits for another [BlellochFinemanShun2012]: a candidate is chosen if every
// neighbour that precedes it is blocked (or no candidate), and blocked if one of them is chosen. Candidates
// are visited in the order of memory; if a preceding neighbour is undecided, it is decided first, by
// recursion with a limited number of steps. Decisions depend on the costs alone, so two threads that decide
// the same vertex agree. Where costs rise steadily along the ground, chains of undecided vertices are longer
// than the limit: these are visited again in the opposite direction, and what is open after four rounds is
// decided in the order of costs.
#include "engine/simplify/independent_set.h"

#include <algorithm>
#include <atomic>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/parallel_sort.h"
#include "engine/simplify/star_prefetch.h"

namespace arete {
namespace {

constexpr int kSteps = 64, kRounds = 4;
constexpr std::size_t kLinksAhead = 4, kRecordsAhead = 8;
constexpr std::size_t kSpan = 4096;

std::uint32_t load(std::uint32_t& where) {
  return std::atomic_ref(where).load(std::memory_order_relaxed);
}
void store(std::uint32_t& where, std::uint32_t value) {
  std::atomic_ref(where).store(value, std::memory_order_relaxed);
}

}  // namespace

template <class Keep>
void IndependentSet::filter(std::span<const VertexId> vertices, std::vector<VertexId>& kept,
                            const Keep& keep) {
  filter_(vertices.size(), kSpan, kept, [&](std::size_t begin, std::size_t end, VertexId* to) {
    for (const VertexId v : vertices.subspan(begin, end - begin)) {
      *to = v;
      to += keep(v) ? 1 : 0;
    }
    return to;
  });
}

IndependentSet::Decision IndependentSet::decide(VertexId v, const Link& link, std::uint32_t level,
                                                int& steps) {
  bool isBlocked = false, isUndecided = false;
  for (int i = 0; i < link.size && !isBlocked; ++i) {
    const VertexId u = link.vertices[i];
    const std::uint32_t selection = load(records_[u].selection);
    if (selection / 4 != level || selection % 4 == kBlocked || !precedes(u, v)) continue;
    auto decision = static_cast<Decision>(selection % 4);
    if (decision == kOpen && --steps > 0) {
      Link further;
      gather(u, further);
      decision = decide(u, further, level, steps);
    }
    if (decision == kChosen) isBlocked = true;
    if (decision == kOpen) isUndecided = true;
  }
  const Decision decision = isBlocked ? kBlocked : isUndecided ? kOpen : kChosen;
  if (decision != kOpen) store(records_[v].selection, 4 * level + decision);
  return decision;
}

void IndependentSet::gather(VertexId v, Link& link) const {
  link.size = 0;
  forLink(mesh_, v, [&](VertexId u) {
    __builtin_prefetch(&records_[u]);
    link.vertices[link.size++] = u;
    return true;
  });
}

void IndependentSet::choose(std::span<const VertexId> candidates, std::uint32_t level,
                            std::vector<VertexId>& chosen) {
  const auto isOpen = [&](VertexId v) { return load(records_[v].selection) % 4 == kOpen; };
  std::span<const VertexId> open = candidates;
  for (int round = 0; round < kRounds && !open.empty(); ++round) {
    const bool isBackwards = round % 2 == 1;
    parallelFor(IndexRange<std::size_t>(0, open.size(), 256), [&](const auto& range) {
      const auto candidate = [&](std::size_t i) { return open[isBackwards ? open.size() - 1 - i : i]; };
      // The links of the next candidates are gathered early, which prefetches their records.
      std::array<Link, kLinksAhead> ahead;
      const auto gatherAhead = [&](std::size_t i) {
        if (i + kRecordsAhead < range.end()) __builtin_prefetch(&records_[candidate(i + kRecordsAhead)]);
        if (i < range.end() && isOpen(candidate(i))) gather(candidate(i), ahead[i % kLinksAhead]);
      };
      for (std::size_t i = range.begin(); i < range.begin() + kLinksAhead - 1; ++i) gatherAhead(i);
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        prefetchStars(mesh_, i + kLinksAhead - 1, open.size(), candidate);
        gatherAhead(i + kLinksAhead - 1);
        int steps = kSteps;
        if (isOpen(candidate(i))) decide(candidate(i), ahead[i % kLinksAhead], level, steps);
      }
    });
    filter(open, ordered_, isOpen);
    open = ordered_;
  }
  sortByCost(ordered_);
  for (const VertexId v : ordered_) {
    Link link;
    gather(v, link);
    int steps = 1;
    decide(v, link, level, steps);
  }
  collectChosen(candidates, level, chosen);
}

void IndependentSet::sortByCost(std::vector<VertexId>& vertices) const {
  parallelSort(vertices.begin(), vertices.end(), [&](VertexId a, VertexId b) { return precedes(a, b); });
}

void IndependentSet::collectChosen(std::span<const VertexId> candidates, std::uint32_t level,
                                   std::vector<VertexId>& chosen) {
  filter(candidates, chosen, [&](VertexId v) { return records_[v].selection == 4 * level + kChosen; });
}

}  // namespace arete
