// SPDX-License-Identifier: GPL-3.0-or-later
//
// A calendar queue (Brown 1988): a clock's watches lie in buckets, each a quarter of a unit long, in a ring
// of 256 units. The clock advances by the part of the motion that takes longest at its rate, so it never
// shows less than the motion was; a bucket is due when its beginning has come, so no watch is due late. What
// would be due within the bucket of the present is due with the next motion, whatever it is.
//
// A clock's rate should be what the camera does in a frame: then a watch is due when its verdict may turn,
// and not before because the clock allowed for a turn that is not made. When the ratios of the mean motion
// are more than twice away from the clock's, or its size more than four times, new watches go by another.
#include "engine/follow/kinetic_queue.h"

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

constexpr double kLeastTurn = 1e-5, kLeastScale = 1e-5;
constexpr double kShare = 0.25;  // of the last motion in the mean
constexpr double kMostSkew = 2, kMostSize = 4;
constexpr std::size_t kMostClocks = 6;

/// How unlike a rate a motion is: the largest of its parts in units of the rate, and the smallest.
struct Fit {
  double largest, smallest;
  bool isGood() const {
    return largest <= kMostSkew * smallest && largest <= kMostSize && largest >= 1 / kMostSize;
  }
};

Fit fitOf(const Motion& motion, const Motion& rate) {
  const auto [smallest, largest] =
      std::minmax({motion.travel / rate.travel, motion.turn / rate.turn, motion.scale / rate.scale});
  return {largest, smallest};
}

}  // namespace

KineticQueue::KineticQueue(double leastTravel) : leastTravel_(leastTravel), clocks_(1) {
  clocks_[0].rate = widened({});
}

Motion KineticQueue::widened(const Motion& rate) const {
  return {std::max(rate.travel, leastTravel_), std::max(rate.turn, kLeastTurn),
          std::max(rate.scale, kLeastScale)};
}

std::uint32_t KineticQueue::blockFor(std::uint32_t chain) {
  if (chain != kNone && blocks_[chain].count < Block::kMost) return chain;
  std::uint32_t block = free_;
  if (block == kNone) {
    block = static_cast<std::uint32_t>(blocks_.size());
    blocks_.emplace_back();
  } else {
    free_ = blocks_[block].next;
    blocks_[block].count = 0;
  }
  blocks_[block].next = chain;
  return block;
}

void KineticQueue::add(const Sphere& ball, float error, std::uint32_t node, float units) {
  Clock& clock = clocks_[current_];
  // The longest are spread, not to be due all at once.
  constexpr double kMostUnits = double(kBuckets - 8) / kPerUnit;
  double time = double(units) * 0.9999;
  if (time >= kMostUnits / 2) {
    spread_ = spread_ * 1664525u + 1013904223u;
    time = std::min(time, kMostUnits * (0.5 + 0.5 * double(spread_ >> 8) / double(1u << 24)));
  }
  const auto bucket = static_cast<std::uint64_t>((clock.now + time) * kPerUnit);
  std::uint32_t& chain = bucket <= clock.passed ? clock.soon : clock.buckets[bucket % kBuckets];
  chain = blockFor(chain);
  blocks_[chain].put(ball, error, node);
}

void KineticQueue::makeDue(std::uint32_t& chain) {
  for (std::uint32_t block = chain; block != kNone; block = blocks_[block].next) due_.push_back(block);
  chain = kNone;
}

void KineticQueue::makeDue(Clock& clock) {
  makeDue(clock.soon);
  for (std::uint32_t& chain : clock.buckets) makeDue(chain);
  clock.now = 0;
  clock.passed = 0;
}

void KineticQueue::pass(Clock& clock, double units) {
  const double now = clock.now + units * (1 + 1e-9);
  if (!(now < 1e9)) return makeDue(clock);
  makeDue(clock.soon);
  const auto bucket = static_cast<std::uint64_t>(now * kPerUnit);
  const std::uint64_t last = std::min(bucket, clock.passed + kBuckets);
  for (std::uint64_t b = clock.passed + 1; b <= last; ++b) makeDue(clock.buckets[b % kBuckets]);
  clock.now = now;
  clock.passed = bucket;
}

void KineticQueue::pass(const Motion& moved) {
  if (moved.isZero()) return;
  for (Clock& clock : clocks_) pass(clock, moved.in(clock.rate));
  const auto mean = [](double old, double now) { return old == 0 ? now : old + kShare * (now - old); };
  usual_ = {mean(usual_.travel, moved.travel), mean(usual_.turn, moved.turn),
            mean(usual_.scale, moved.scale)};
  chooseClock();
}

void KineticQueue::passAll() {
  for (Clock& clock : clocks_) makeDue(clock);
}

void KineticQueue::chooseClock() {
  const Motion wanted = widened(usual_);
  if (fitOf(wanted, clocks_[current_].rate).isGood()) return;
  for (std::size_t i = 0; i < clocks_.size(); ++i)
    if (fitOf(wanted, clocks_[i].rate).isGood()) {
      current_ = i;
      return;
    }
  current_ = clocks_.size();
  if (clocks_.size() < kMostClocks) {
    clocks_.emplace_back();
  } else {
    const auto oldest = std::ranges::min_element(clocks_, {}, &Clock::age);
    makeDue(*oldest);
    current_ = static_cast<std::size_t>(oldest - clocks_.begin());
  }
  clocks_[current_].rate = wanted;
  clocks_[current_].age = ++made_;
}

void KineticQueue::take(std::size_t blocks) {
  for (; blocks > 0; --blocks) {
    const std::uint32_t block = due_[taken_++];
    blocks_[block].next = free_;
    free_ = block;
  }
  if (2 * taken_ < due_.size()) return;
  due_.erase(due_.begin(), due_.begin() + static_cast<std::ptrdiff_t>(taken_));
  taken_ = 0;
}

void KineticQueue::forget() {
  blocks_.clear();
  free_ = kNone;
  due_.clear();
  taken_ = 0;
  for (Clock& clock : clocks_) {
    clock.buckets.assign(kBuckets, kNone);
    clock.soon = kNone;
  }
}

}  // namespace arete
