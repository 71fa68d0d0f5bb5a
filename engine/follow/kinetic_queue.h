// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "engine/criteria/motion.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// The event queue of a kinetic data structure [BaschGuibasHershberger1997] in which motion takes the place
/// of time. A certificate is a criterion's verdict on a ball and an error; it fails, and must be evaluated
/// again, after as much motion as the verdict holds for. Certificates are queued in batches, which is what
/// KineticCriterion::exceedingFor() evaluates.
///
/// A timeline has a rate (an amount of travel, turn and change of scale), and its time is at least the number
/// of rates that the criterion has moved. As long as the camera keeps the ratio of travel to turn one
/// timeline is enough; when the ratio changes, new certificates use a new timeline and the old ones keep
/// theirs.
class KineticQueue {
 public:
  /// Up to 64 certificates.
  struct Batch {
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

  /// @param leastTravel A travel too small to matter, > 0: the rates of timelines have at least so much.
  explicit KineticQueue(double leastTravel);

  /// The rate of new certificates: a mean of the last motions. All parts are positive.
  const Motion& rate() const { return timelines_[current_].rate; }
  /// Adds a certificate that is due after at most units * rate(). Moves no batch.
  void add(const Sphere& ball, float error, std::uint32_t node, float units);

  /// Advances by the motion of the criterion: certificates that may have failed become due.
  void advance(const Motion& moved);
  /// Makes all certificates due.
  void advanceToEnd();

  /// Batches with certificates that are due, in the order in which they became due. The caller evaluates them
  /// and removes them from the front.
  std::size_t dueCount() const { return due_.size() - removed_; }
  const Batch& due(std::size_t i) const { return batches_[due_[removed_ + i]]; }
  void removeDue(std::size_t batches);

  /// Removes all certificates.
  /// @param visit visit(node): called for each before, and for some that were removed earlier.
  template <class Visit>
  void clear(const Visit& visit) {
    for (const Batch& batch : batches_)
      for (std::uint32_t i = 0; i < batch.count; ++i) visit(batch.nodes[i]);
    reset();
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  static constexpr std::uint32_t kPerUnit = 4, kBuckets = 1024;  // a power of two

  struct Timeline {
    Motion rate;
    double now = 0;
    std::uint64_t passed = 0;  // the bucket of `now`; it and those before are empty
    std::vector<std::uint32_t> buckets = std::vector<std::uint32_t>(kBuckets, kNone);
    std::uint32_t soon = kNone;  // due with the next motion
    std::uint64_t age = 0;       // when it was made
  };

  std::uint32_t batchFor(std::uint32_t chain);
  void reset();
  void makeDue(std::uint32_t& chain);
  void makeDue(Timeline& timeline);
  void advance(Timeline& timeline, double units);
  void chooseTimeline();
  Motion widened(const Motion& rate) const;

  const double leastTravel_;
  std::deque<Batch> batches_;  // a deque, so that none moves
  std::uint32_t free_ = kNone;
  std::vector<std::uint32_t> due_;
  std::size_t removed_ = 0;
  Motion usual_;  // the mean of the last motions
  std::vector<Timeline> timelines_;
  std::size_t current_ = 0;
  std::uint64_t made_ = 0;
  std::uint32_t spread_ = 0;
};

}  // namespace arete
