// SPDX-License-Identifier: GPL-3.0-or-later
//
// The set is the one a greedy pass in the order of costs takes, but little is sorted and nobody waits: a
// candidate is chosen when every neighbour that precedes it is blocked (or no candidate), and blocked as soon
// as one of them is chosen (Blelloch, Fineman, Shun 2012, "Greedy sequential maximal independent set and
// matching are parallel on average"). Candidates are visited in the order of memory; one that waits for a
// neighbour decides the neighbour first, within a budget of such steps. Decisions are functions of the costs
// alone, so threads may decide the same vertex twice and agree. What long chains leave open, costs that rise
// steadily along the ground, is visited again the other way round, and what is open after a few rounds is
// decided in the order of costs after all.
#include "engine/simplify/independent_set.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>

#include "engine/simplify/star_prefetch.h"

namespace arete {
namespace {

constexpr int kSteps = 64, kRounds = 4;
constexpr std::size_t kLinksAhead = 4, kNotesAhead = 8;
constexpr std::size_t kChunk = 4096;

std::uint32_t load(std::uint32_t& where) {
  return std::atomic_ref(where).load(std::memory_order_relaxed);
}
void store(std::uint32_t& where, std::uint32_t value) {
  std::atomic_ref(where).store(value, std::memory_order_relaxed);
}

}  // namespace

template <class Stays>
void IndependentSet::filter(std::span<const std::uint32_t> vertices, std::vector<std::uint32_t>& kept,
                            const Stays& stays) {
  filter_(vertices.size(), kChunk, kept, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
    for (const std::uint32_t v : vertices.subspan(begin, end - begin)) {
      *to = v;
      to += stays(v) ? 1 : 0;
    }
    return to;
  });
}

IndependentSet::Choice IndependentSet::decide(std::uint32_t v, const Link& link, std::uint32_t level,
                                              int& steps) {
  bool isBlocked = false, isWaiting = false;
  for (int i = 0; i < link.size && !isBlocked; ++i) {
    const std::uint32_t u = link.vertices[i], candidacy = load(notes_[u].candidacy);
    if (candidacy / 4 != level || candidacy % 4 == kBlocked || !precedes(u, v)) continue;
    auto choice = static_cast<Choice>(candidacy % 4);
    if (choice == kOpen && --steps > 0) {
      Link further;
      gather(u, further);
      choice = decide(u, further, level, steps);
    }
    if (choice == kChosen) isBlocked = true;
    if (choice == kOpen) isWaiting = true;
  }
  const Choice choice = isBlocked ? kBlocked : isWaiting ? kOpen : kChosen;
  if (choice != kOpen) store(notes_[v].candidacy, 4 * level + choice);
  return choice;
}

void IndependentSet::gather(std::uint32_t v, Link& link) const {
  link.size = 0;
  forLink(mesh_, v, [&](std::uint32_t u) {
    __builtin_prefetch(&notes_[u]);
    link.vertices[link.size++] = u;
    return true;
  });
}

void IndependentSet::choose(std::span<const std::uint32_t> candidates, std::uint32_t level,
                            std::vector<std::uint32_t>& chosen) {
  const auto isOpen = [&](std::uint32_t v) { return load(notes_[v].candidacy) % 4 == kOpen; };
  std::span<const std::uint32_t> left = candidates;
  for (int round = 0; round < kRounds && !left.empty(); ++round) {
    const bool isBackwards = round % 2 == 1;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, left.size(), 256), [&](const auto& range) {
      const auto candidate = [&](std::size_t i) { return left[isBackwards ? left.size() - 1 - i : i]; };
      // The links of the next ones are gathered early: their notes are on their way when they are read.
      std::array<Link, kLinksAhead> ahead;
      const auto ask = [&](std::size_t i) {
        if (i + kNotesAhead < range.end()) __builtin_prefetch(&notes_[candidate(i + kNotesAhead)]);
        if (i < range.end() && isOpen(candidate(i))) gather(candidate(i), ahead[i % kLinksAhead]);
      };
      for (std::size_t i = range.begin(); i < range.begin() + kLinksAhead - 1; ++i) ask(i);
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        prefetchStars(mesh_, i + kLinksAhead - 1, left.size(), candidate);
        ask(i + kLinksAhead - 1);
        int steps = kSteps;
        if (isOpen(candidate(i))) decide(candidate(i), ahead[i % kLinksAhead], level, steps);
      }
    });
    filter(left, ordered_, isOpen);
    left = ordered_;
  }
  sortByCost(ordered_);
  for (const std::uint32_t v : ordered_) {
    Link link;
    gather(v, link);
    int steps = 1;
    decide(v, link, level, steps);
  }
  collectChosen(candidates, level, chosen);
}

void IndependentSet::sortByCost(std::vector<std::uint32_t>& vertices) const {
  tbb::parallel_sort(vertices.begin(), vertices.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return precedes(a, b); });
}

void IndependentSet::collectChosen(std::span<const std::uint32_t> candidates, std::uint32_t level,
                                   std::vector<std::uint32_t>& chosen) {
  filter(candidates, chosen, [&](std::uint32_t v) { return notes_[v].candidacy == 4 * level + kChosen; });
}

}  // namespace arete
