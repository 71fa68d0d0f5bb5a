// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "engine/criteria/motion.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// Balls and errors about which a moving criterion gave a verdict, and when to ask again: each watch is due
/// once the criterion has moved as far as its verdict was good for. Watches come and go in blocks, which are
/// what Criterion::exceedingFor() takes.
///
/// Time is motion. A clock has a rate, some travel, turn and change of scale at once, and shows how many
/// times the rate has passed at least. As long as the camera keeps its ratio of travel to turn one clock is
/// all there is; when it changes, new watches go by a new clock and the old ones by theirs.
class KineticQueue {
 public:
  struct Block {
    static constexpr std::uint32_t kMost = 64;
    std::array<Sphere, kMost> balls;
    std::array<float, kMost> errors;
    std::array<std::uint32_t, kMost> nodes;
    std::uint32_t count = 0, next = 0;

    void put(const Sphere& ball, float error, std::uint32_t node) {
      balls[count] = ball;
      errors[count] = error;
      nodes[count++] = node;
    }
  };

  /// `leastTravel`: a travel too small to matter, above 0.
  explicit KineticQueue(double leastTravel);

  /// The rate of the clock by which new watches go: what the last motions were like. All parts are positive.
  const Motion& rate() const { return clocks_[current_].rate; }
  /// To be due after at most so many times the rate. Moves no block.
  void add(const Sphere& ball, float error, std::uint32_t node, float units);

  /// The criterion moves: what that makes due is due.
  void pass(const Motion& moved);
  /// Everything is due.
  void passAll();

  /// Blocks that are due, those that have been for longest first; what is done with is taken from the front.
  std::size_t dueCount() const { return due_.size() - taken_; }
  const Block& due(std::size_t i) const { return blocks_[due_[taken_ + i]]; }
  void take(std::size_t blocks);

  /// Forgets all watches, after visit(node) of each (and of some that were taken).
  template <class Visit>
  void clear(const Visit& visit) {
    for (const Block& block : blocks_)
      for (std::uint32_t i = 0; i < block.count; ++i) visit(block.nodes[i]);
    forget();
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  static constexpr std::uint32_t kPerUnit = 4, kBuckets = 1024;  // a power of two

  struct Clock {
    Motion rate;
    double now = 0;
    std::uint64_t passed = 0;  // buckets up to this one are empty: it is that of `now`
    std::vector<std::uint32_t> buckets = std::vector<std::uint32_t>(kBuckets, kNone);
    std::uint32_t soon = kNone;  // due as soon as anything moves
    std::uint64_t age = 0;       // when it was made
  };

  std::uint32_t blockFor(std::uint32_t chain);
  void forget();
  void makeDue(std::uint32_t& chain);
  void makeDue(Clock& clock);
  void pass(Clock& clock, double units);
  void chooseClock();
  Motion widened(const Motion& rate) const;

  const double leastTravel_;
  std::deque<Block> blocks_;  // which stay where they are
  std::uint32_t free_ = kNone;
  std::vector<std::uint32_t> due_;
  std::size_t taken_ = 0;
  Motion usual_;  // the last motions' mean
  std::vector<Clock> clocks_;
  std::size_t current_ = 0;
  std::uint64_t made_ = 0;
  std::uint32_t spread_ = 0;
};

}  // namespace arete
