// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace arete {

/// What a build knows of a vertex that may go: 16 bytes, so that one cache line tells of four neighbours. Of
/// RemovalRecord{} nothing is known.
struct RemovalRecord {
  enum class State : std::uint8_t {
    stale,    ///< nothing is known of its star
    atLeast,  ///< removing it costs at least `cost`
    exact,    ///< removing it costs `cost`
    stuck,    ///< it cannot go, whatever it costs, as its star stands
    fixed,    ///< it stays
  };

  float cost;
  /// Marks of the corners of the triangle that costs that much: see isWitnessedBy(). Not of the fidelity
  /// shape.
  std::uint32_t witness;
  /// Whether it was a candidate of a level, and what became of it: 4 * level + choice (IndependentSet); or,
  /// that a neighbour was taken, ~level (PieceWorker).
  std::uint32_t candidacy;
  State state;
  std::uint8_t isTouched;      ///< a neighbour went
  std::uint8_t isWitnessGone;  ///< one of the witness's corners
  std::uint8_t linkSize;       ///< of its star, when exact

  /// What the removal of neighbours left of what was known. A hole that a removal enlarges keeps every
  /// Delaunay triangle whose corners remain: its circle stays empty. So while the corners of the worst
  /// triangle are there the cost can only have grown (but for ties between cocircular corners, where another
  /// diagonal may be taken), and no look at the star is needed before the threshold reaches it.
  void settle() {
    if (!isTouched) return;
    state = isWitnessGone || state == State::stuck ? State::stale : State::atLeast;
    isTouched = isWitnessGone = 0;
  }

  /// The threshold from which on a level concerns it again.
  float dueAt() const { return state == State::stuck ? std::numeric_limits<float>::infinity() : cost; }

  /// Ten bits of a hash for each corner: a false match makes a look at a star that was not needed.
  void setWitness(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    witness = mark(a) | mark(b) << 10 | mark(c) << 20;
  }
  bool isWitnessedBy(std::uint32_t v) const {
    const std::uint32_t m = mark(v);
    return ((witness & 1023) == m) | (((witness >> 10) & 1023) == m) | (((witness >> 20) & 1023) == m);
  }

 private:
  static std::uint32_t mark(std::uint32_t v) { return (v * 0x9E3779B1u) >> 22; }
};
static_assert(sizeof(RemovalRecord) == 16);

}  // namespace arete
