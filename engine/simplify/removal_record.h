// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "engine/base/ids.h"

namespace arete {

/// What a build stores of a vertex that may be removed: 16 bytes, four to a cache line. RemovalRecord{}: the
/// cost is unknown.
struct RemovalRecord {
  enum class State : std::uint8_t {
    stale,    ///< the cost is unknown
    atLeast,  ///< removing the vertex costs at least `cost`
    exact,    ///< removing the vertex costs `cost`
    stuck,    ///< the vertex cannot be removed at any cost while its star is as it is
    fixed,    ///< the vertex is never removed
  };

  float cost;
  /// Hashes of the corners of the witness, the triangle whose error is the cost: see isWitnessedBy(). Unused
  /// for the data-dependent shape.
  std::uint32_t witness;
  /// The last level in which the vertex was a candidate and the decision, 4 * level + decision
  /// (IndependentSet); or ~level, if a neighbour was taken in that level (TileWorker).
  std::uint32_t selection;
  State state;
  std::uint8_t isTouched;      ///< 1: a neighbour was removed
  std::uint8_t isWitnessGone;  ///< 1: a corner of the witness was removed
  std::uint8_t linkSize;       ///< of the star, if the state is exact

  /// Updates the state after the removal of neighbours. A hole that a removal enlarges keeps every Delaunay
  /// triangle whose corners remain: its circle stays empty. So while the corners of the witness remain, the
  /// cost can only have grown (except for ties between cocircular corners, where another diagonal may be
  /// taken), and the vertex need not be evaluated before the threshold reaches it.
  void settle() {
    if (!isTouched) return;
    state = isWitnessGone || state == State::stuck ? State::stale : State::atLeast;
    isTouched = isWitnessGone = 0;
  }

  /// The threshold of the first level that evaluates the vertex again; infinity if it is stuck.
  float nextThreshold() const {
    return state == State::stuck ? std::numeric_limits<float>::infinity() : cost;
  }

  void setWitness(VertexId a, VertexId b, VertexId c) { witness = hash(a) | hash(b) << 10 | hash(c) << 20; }
  /// Whether v may be a corner of the witness. Ten bits of a hash for each corner: a false match leads to an
  /// evaluation that was not needed, never to a wrong cost.
  bool isWitnessedBy(VertexId v) const {
    const std::uint32_t h = hash(v);
    return ((witness & 1023) == h) | (((witness >> 10) & 1023) == h) | (((witness >> 20) & 1023) == h);
  }

 private:
  static std::uint32_t hash(VertexId v) { return (v.index() * 0x9E3779B1u) >> 22; }
};
static_assert(sizeof(RemovalRecord) == 16);

}  // namespace arete
