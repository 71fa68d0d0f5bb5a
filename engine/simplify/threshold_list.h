// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "engine/parallel/loop_threads.h"
#include "engine/parallel/parallel_filter.h"

namespace arete {

/// The vertices of a triangulation that shrinks, each with the threshold from which on a level concerns it.
///
/// A level looks through all of them for the few that are due, so the thresholds lie side by side in the
/// order of the look, that of the ground; a vertex finds its own by its place. One that has gone keeps its
/// place, and is never due, until forgetGone(). Those that stay for ever have a place as well, and are never
/// due either.
class ThresholdList {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;  ///< no vertex
  static constexpr float kNow = 0, kNever = std::numeric_limits<float>::infinity();

  /// Places from `begin` to before `end`: a piece of the ground.
  struct Piece {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t size() const { return end - begin; }
  };

  /// What collect() works with.
  using Space = ParallelFilter<std::uint32_t>;

  /// `vertices`: in the order in which they shall be visited, those that stay among them; the others are all
  /// due now. isStaying: per vertex, not 0 = yes.
  void assign(std::span<const std::uint32_t> vertices, std::span<const std::uint8_t> isStaying);

  /// How many may still go.
  std::size_t size() const { return waiting_; }
  bool empty() const { return size() == 0; }

  /// All places.
  Piece everything() const { return {kNobody + 1, static_cast<std::uint32_t>(vertices_.size())}; }
  /// Whether v, which has not gone, has its place in the piece.
  bool isWithin(Piece piece, std::uint32_t v) const { return place_[v] - piece.begin < piece.size(); }
  /// Who has each place, in order; kNone where he has gone.
  std::span<const std::uint32_t> vertices() const { return std::span(vertices_).subspan(kNobody + 1); }
  /// v's place, which it keeps until forgetGone(). Precondition: v has not gone.
  std::uint32_t placeOf(std::uint32_t v) const { return place_[v]; }
  /// Forgets those that have gone if they are more than half: places change. O(size), parallel.
  void forgetGone();

  /// `due` receives, in order, those whose threshold has come. O(places), parallel.
  void collect(double threshold, std::vector<std::uint32_t>& due, Space& space) const;
  /// The same of those in the piece, by the calling thread alone. O(size of the piece).
  void collect(Piece piece, double threshold, UninitializedVector<std::uint32_t>& due) const;
  /// The same of `some`. Those that have gone are never due. O(some), parallel.
  void collect(std::span<const std::uint32_t> some, double threshold, std::vector<std::uint32_t>& due,
               Space& space) const;

  /// When v is due: a threshold, kNow or kNever. Safe for different vertices at once, but for one that is not
  /// in the list, or has gone: of that nothing is noted, here and in wakeIf().
  void set(std::uint32_t v, float threshold) { dueAt_[place_[v]] = threshold; }
  /// Makes v due now, if so told: callers cannot foresee it, and no branch is needed. Safe for the same
  /// vertex at once, not beside set() of the same.
  void wakeIf(bool isDue, std::uint32_t v) {
    float nowhere = kNow;  // of this call: a place that all threads wrote to would hold them up
    float* const where[] = {&nowhere, &dueAt_[place_[v]]};
    std::atomic_ref(*where[isDue]).store(kNow, std::memory_order_relaxed);
  }
  /// These have gone. Safe for different vertices at once. O(gone).
  void remove(std::span<const std::uint32_t> gone, LoopThreads threads);
  /// Puts vertices, none of whom has gone, into the order of their places, each once.
  void sort(std::vector<std::uint32_t>& vertices) const;

  /// The least threshold of all, kNever where none will come. O(size).
  float least() const;

  /// The threshold up to which about such a part of those that will ever be due are, told by a sample of a
  /// thousand; kNow where there are too few to tell. Precondition: 0 <= part < 1. O(the sample).
  float thresholdOf(double part) const;

  /// Asks for what set() and wakeIf() read.
  [[gnu::always_inline]] void prefetch(std::uint32_t v) const { __builtin_prefetch(&place_[v]); }

 private:
  /// Writes those of some places that are due, returns where it ended. There is room for all.
  std::uint32_t* collectTo(std::size_t begin, std::size_t end, double threshold, std::uint32_t* to) const;

  static constexpr std::uint32_t kNobody = 0;    // the place of all who are not in the list; never looked at
  UninitializedVector<std::uint32_t> vertices_;  // by place; kNone
  UninitializedVector<float> dueAt_;             // by place
  UninitializedVector<std::uint32_t> place_;     // by vertex
  std::atomic<std::size_t> waiting_ = 0;
  std::size_t staying_ = 0;
};

}  // namespace arete
