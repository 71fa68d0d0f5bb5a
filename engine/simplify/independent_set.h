// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/id_array.h"
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
  using Records = IdArray<VertexId, UninitializedVector<RemovalRecord>>;

  IndependentSet(const LiveMesh& mesh, Records& records) : mesh_(mesh), records_(records) {}

  /// Whether a is chosen before b.
  bool precedes(VertexId a, VertexId b) const {
    const float costA = records_[a].cost, costB = records_[b].cost;
    return costA != costB ? costA < costB : scatter(a.index()) < scatter(b.index());
  }

  /// Makes v a candidate of a level, > 0. Thread-safe for different vertices.
  void enter(VertexId v, std::uint32_t level) { records_[v].selection = 4 * level + kOpen; }

  /// Decides all candidates. O(candidates) expected, parallel. Preconditions: enter() was called for each of
  /// them and for no other vertex, with this level; their links have at most kMaxHoleCorners vertices.
  /// @param chosen receives the chosen candidates, in the order of `candidates`.
  void choose(std::span<const VertexId> candidates, std::uint32_t level, std::vector<VertexId>& chosen);

  /// choose() on one thread, where the caller may reject candidates. O(candidates * log).
  /// @param accept accept(v): false rejects v, which then blocks no neighbour; called in the order of costs.
  template <class Accept>
  void chooseInTurn(std::span<const VertexId> candidates, std::uint32_t level, std::vector<VertexId>& chosen,
                    const Accept& accept) {
    ordered_.assign(candidates.begin(), candidates.end());
    sortByCost(ordered_);
    for (const VertexId v : ordered_) {
      if (records_[v].selection != 4 * level + kOpen || !accept(v)) continue;
      forLink(mesh_, v, [&](VertexId u) {
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
    std::array<VertexId, kMaxHoleCorners> vertices;
  };
  /// Gathers the link of v and prefetches its records.
  void gather(VertexId v, Link& link) const;
  Decision decide(VertexId v, const Link& link, std::uint32_t level, int& steps);
  void sortByCost(std::vector<VertexId>& vertices) const;
  void collectChosen(std::span<const VertexId> candidates, std::uint32_t level,
                     std::vector<VertexId>& chosen);
  /// `kept` receives the vertices for which keep(v) holds, in order.
  template <class Keep>
  void filter(std::span<const VertexId> vertices, std::vector<VertexId>& kept, const Keep& keep);

  const LiveMesh& mesh_;
  Records& records_;
  std::vector<VertexId> ordered_;
  ParallelFilter<VertexId> filter_;
};

}  // namespace arete
