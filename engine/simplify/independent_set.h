// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "engine/parallel/parallel_filter.h"
#include "engine/simplify/live_mesh.h"
#include "engine/simplify/removal_record.h"

namespace arete {

/// Chooses the removals of a level among its candidates: in the order of their costs (equal ones by a hash of
/// the vertex), each unless a neighbour was chosen before it [BlellochFinemanShun2012]. The set is
/// independent (no two stars share a triangle), maximal, and the same for any number of threads.
class IndependentSet {
 public:
  IndependentSet(const LiveMesh& mesh, UninitializedVector<RemovalRecord>& records)
      : mesh_(mesh), records_(records) {}

  /// Whether a is chosen before b.
  bool precedes(std::uint32_t a, std::uint32_t b) const {
    const float costA = records_[a].cost, costB = records_[b].cost;
    return costA != costB ? costA < costB : scatter(a) < scatter(b);
  }

  /// Makes v a candidate of a level, > 0. Thread-safe for different vertices.
  void enter(std::uint32_t v, std::uint32_t level) { records_[v].selection = 4 * level + kOpen; }

  /// Decides all candidates. O(candidates) expected, parallel. Preconditions: enter() was called for each of
  /// them and for no other vertex, with this level; their links have at most kMaxHoleCorners vertices.
  /// @param chosen receives the chosen candidates, in the order of `candidates`.
  void choose(std::span<const std::uint32_t> candidates, std::uint32_t level,
              std::vector<std::uint32_t>& chosen);

  /// choose() on one thread, where the caller may reject candidates. O(candidates * log).
  /// @param accept accept(v): false rejects v, which then blocks no neighbour; called in the order of costs.
  template <class Accept>
  void chooseInTurn(std::span<const std::uint32_t> candidates, std::uint32_t level,
                    std::vector<std::uint32_t>& chosen, const Accept& accept) {
    ordered_.assign(candidates.begin(), candidates.end());
    sortByCost(ordered_);
    for (const std::uint32_t v : ordered_) {
      if (records_[v].selection != 4 * level + kOpen || !accept(v)) continue;
      forLink(mesh_, v, [&](std::uint32_t u) {
        records_[u].selection = 4 * level + kBlocked;
        return true;
      });
      records_[v].selection = 4 * level + kChosen;
    }
    collectChosen(candidates, level, chosen);
  }

 private:
  enum Decision : std::uint32_t { kOpen = 1, kChosen = 2, kBlocked = 3 };

  static std::uint32_t scatter(std::uint32_t x) {  // murmur3's finaliser: a bijection
    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    x *= 0xc2b2ae35u;
    x ^= x >> 16;
    return x;
  }
  /// The link of a candidate.
  struct Link {
    int size = 0;
    std::array<std::uint32_t, kMaxHoleCorners> vertices;
  };
  /// Gathers the link of v and prefetches its records.
  void gather(std::uint32_t v, Link& link) const;
  Decision decide(std::uint32_t v, const Link& link, std::uint32_t level, int& steps);
  void sortByCost(std::vector<std::uint32_t>& vertices) const;
  void collectChosen(std::span<const std::uint32_t> candidates, std::uint32_t level,
                     std::vector<std::uint32_t>& chosen);
  /// `kept` receives the vertices for which keep(v) holds, in order.
  template <class Keep>
  void filter(std::span<const std::uint32_t> vertices, std::vector<std::uint32_t>& kept, const Keep& keep);

  const LiveMesh& mesh_;
  UninitializedVector<RemovalRecord>& records_;
  std::vector<std::uint32_t> ordered_;
  ParallelFilter<std::uint32_t> filter_;
};

}  // namespace arete
