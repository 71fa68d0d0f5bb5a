// SPDX-License-Identifier: GPL-3.0-or-later
//
// The set is the one a greedy pass in the order of costs takes, but nothing is sorted and nobody waits: a
// candidate is chosen when every neighbour that precedes it is a blocked candidate (or none at all), and
// blocked as soon as one of them is chosen (Blelloch, Fineman, Shun 2012, "Greedy sequential maximal
// independent set and matching are parallel on average"). Candidates are visited in the order of memory; one
// that waits for a neighbour decides the neighbour first. Decisions are functions of the costs alone, so
// threads may decide the same vertex twice and agree. Chains longer than a bounded depth are left for another
// round.
#include "terrain/independent_set.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <atomic>

#include "terrain/star_prefetch.h"

namespace arete {
namespace {

constexpr int kDeepest = 200;

std::uint32_t load(std::uint32_t& where) {
  return std::atomic_ref(where).load(std::memory_order_relaxed);
}
void store(std::uint32_t& where, std::uint32_t value) {
  std::atomic_ref(where).store(value, std::memory_order_relaxed);
}

}  // namespace

IndependentSet::Choice IndependentSet::decide(std::uint32_t v, std::uint32_t level, int depth) {
  bool isBlocked = false, isWaiting = false;
  forLink(mesh_, v, [&](std::uint32_t u) {
    const std::uint32_t candidacy = load(notes_[u].candidacy);
    if (candidacy / 4 != level || candidacy % 4 == kBlocked || !precedes(u, v)) return true;
    auto choice = static_cast<Choice>(candidacy % 4);
    if (choice == kOpen && depth < kDeepest) choice = decide(u, level, depth + 1);
    if (choice == kChosen) isBlocked = true;
    if (choice == kOpen) isWaiting = true;
    return !isBlocked;
  });
  const Choice choice = isBlocked ? kBlocked : isWaiting ? kOpen : kChosen;
  if (choice != kOpen) store(notes_[v].candidacy, 4 * level + choice);
  return choice;
}

void IndependentSet::choose(std::span<const std::uint32_t> candidates, std::uint32_t level,
                            std::vector<std::uint32_t>& chosen) {
  for (bool isOpen = true; isOpen;) {
    std::atomic<bool> isLeft = false;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 256), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        prefetchStars<StarReach::neighbours>(mesh_, i, candidates.size(),
                                             [&](std::size_t k) { return candidates[k]; });
        if (load(notes_[candidates[i]].candidacy) % 4 == kOpen && decide(candidates[i], level, 0) == kOpen)
          isLeft.store(true, std::memory_order_relaxed);
      }
    });
    isOpen = isLeft;
  }
  collectChosen(candidates, level, chosen);
}

void IndependentSet::sortByCost(std::vector<std::uint32_t>& vertices) const {
  tbb::parallel_sort(vertices.begin(), vertices.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return precedes(a, b); });
}

void IndependentSet::collectChosen(std::span<const std::uint32_t> candidates, std::uint32_t level,
                                   std::vector<std::uint32_t>& chosen) const {
  chosen.clear();
  for (const std::uint32_t v : candidates)
    if (notes_[v].candidacy == 4 * level + kChosen) chosen.push_back(v);
}

}  // namespace arete
