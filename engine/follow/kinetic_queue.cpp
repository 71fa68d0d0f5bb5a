// SPDX-License-Identifier: GPL-3.0-or-later
//
// A calendar queue [Brown1988]: a timeline's certificates lie in buckets, each a quarter of a unit long, in a
// ring of 256 units. The timeline advances by the part of the motion that takes longest at its rate, so its
// time is never less than the motion; a bucket is due when its beginning has passed, so no certificate is due
// late. A certificate that would be due within the present bucket is due with the next motion, whatever that
// is.
//
// A timeline's rate should be the camera's motion in one frame: then a certificate is due when its verdict
// may change, and not earlier because the timeline counts a turn that did not happen. When the parts of the
// mean motion are more than a factor of two from the rate relative to each other, or more than a factor of
// four in size, new certificates use another timeline.
#include "engine/follow/kinetic_queue.h"

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

constexpr double kLeastTurn = 1e-5, kLeastScale = 1e-5;
constexpr double kShare = 0.25;  // of the last motion in the mean
constexpr double kMostSkew = 2, kMostSize = 4;
constexpr std::size_t kMostTimelines = 6;

/// A motion relative to a rate: its largest and its smallest part, in units of the rate.
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

KineticQueue::KineticQueue(double leastTravel) : leastTravel_(leastTravel), timelines_(1) {
  timelines_[0].rate = widened({});
}

Motion KineticQueue::widened(const Motion& rate) const {
  return {std::max(rate.travel, leastTravel_), std::max(rate.turn, kLeastTurn),
          std::max(rate.scale, kLeastScale)};
}

std::uint32_t KineticQueue::batchFor(std::uint32_t chain) {
  if (chain != kNone && batches_[chain].count < Batch::kMost) return chain;
  std::uint32_t batch = free_;
  if (batch == kNone) {
    batch = static_cast<std::uint32_t>(batches_.size());
    batches_.emplace_back();
  } else {
    free_ = batches_[batch].next;
    batches_[batch].count = 0;
  }
  batches_[batch].next = chain;
  return batch;
}

void KineticQueue::add(const Sphere& ball, float error, std::uint32_t node, float units) {
  Timeline& timeline = timelines_[current_];
  // The longest are spread, so that they are not due all at once.
  constexpr double kMostUnits = double(kBuckets - 8) / kPerUnit;
  double time = double(units) * 0.9999;
  if (time >= kMostUnits / 2) {
    spread_ = spread_ * 1664525u + 1013904223u;
    time = std::min(time, kMostUnits * (0.5 + 0.5 * double(spread_ >> 8) / double(1u << 24)));
  }
  // A certificate of a bucket that has begun already is due with the next motion.
  const auto bucket = static_cast<std::uint64_t>((timeline.now + time) * kPerUnit);
  std::uint32_t& chain = bucket <= timeline.passed ? timeline.soon : timeline.buckets[bucket % kBuckets];
  chain = batchFor(chain);
  batches_[chain].put(ball, error, node);
}

/// A bucket is due as a whole: its batches are listed and it is empty afterwards.
void KineticQueue::makeDue(std::uint32_t& chain) {
  for (std::uint32_t batch = chain; batch != kNone; batch = batches_[batch].next) due_.push_back(batch);
  chain = kNone;
}

void KineticQueue::makeDue(Timeline& timeline) {
  makeDue(timeline.soon);
  for (std::uint32_t& chain : timeline.buckets) makeDue(chain);
  timeline.now = 0;
  timeline.passed = 0;
}

// The ring holds one round: a bucket that is passed twice is due once. A time so large that digits are lost
// makes everything due.
void KineticQueue::advance(Timeline& timeline, double units) {
  const double now = timeline.now + units * (1 + 1e-9);
  if (!(now < 1e9)) return makeDue(timeline);
  makeDue(timeline.soon);
  const auto bucket = static_cast<std::uint64_t>(now * kPerUnit);
  const std::uint64_t last = std::min(bucket, timeline.passed + kBuckets);
  for (std::uint64_t b = timeline.passed + 1; b <= last; ++b) makeDue(timeline.buckets[b % kBuckets]);
  timeline.now = now;
  timeline.passed = bucket;
}

// Every timeline advances, since each may still hold certificates. The mean forgets earlier motions by a
// share at each step, so it follows the present ones.
void KineticQueue::advance(const Motion& moved) {
  if (moved.isZero()) return;
  for (Timeline& timeline : timelines_) advance(timeline, moved.in(timeline.rate));
  const auto mean = [](double old, double now) { return old == 0 ? now : old + kShare * (now - old); };
  usual_ = {mean(usual_.travel, moved.travel), mean(usual_.turn, moved.turn),
            mean(usual_.scale, moved.scale)};
  chooseTimeline();
}

void KineticQueue::advanceToEnd() {
  for (Timeline& timeline : timelines_) makeDue(timeline);
}

// The present timeline is kept while it fits, then any other that fits. A new one takes the place of the
// oldest, whose certificates are due at once.
void KineticQueue::chooseTimeline() {
  const Motion rate = widened(usual_);
  if (fitOf(rate, timelines_[current_].rate).isGood()) return;
  for (std::size_t i = 0; i < timelines_.size(); ++i)
    if (fitOf(rate, timelines_[i].rate).isGood()) {
      current_ = i;
      return;
    }
  current_ = timelines_.size();
  if (timelines_.size() < kMostTimelines) {
    timelines_.emplace_back();
  } else {
    const auto oldest = std::ranges::min_element(timelines_, {}, &Timeline::age);
    makeDue(*oldest);
    current_ = static_cast<std::size_t>(oldest - timelines_.begin());
  }
  timelines_[current_].rate = rate;
  timelines_[current_].age = ++made_;
}

// Batches are reused, so that memory stays as large as the most that were in use. The list is cut only when
// half of it is removed, which makes a removal O(1) in the mean.
void KineticQueue::removeDue(std::size_t batches) {
  for (; batches > 0; --batches) {
    const std::uint32_t batch = due_[removed_++];
    batches_[batch].next = free_;
    free_ = batch;
  }
  if (2 * removed_ < due_.size()) return;
  due_.erase(due_.begin(), due_.begin() + static_cast<std::ptrdiff_t>(removed_));
  removed_ = 0;
}

void KineticQueue::reset() {
  batches_.clear();
  free_ = kNone;
  due_.clear();
  removed_ = 0;
  for (Timeline& timeline : timelines_) {
    timeline.buckets.assign(kBuckets, kNone);
    timeline.soon = kNone;
  }
}

}  // namespace arete
