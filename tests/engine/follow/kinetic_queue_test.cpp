// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle adds up the motion since each certificate was added.
#include "engine/follow/kinetic_queue.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace arete {
namespace {

struct Promise {
  Motion rate, passed;
  double units;
};

class Oracle {
 public:
  explicit Oracle(KineticQueue& queue) : queue_(queue) {}

  void add(std::uint32_t node, float units) {
    promises_[node] = {queue_.rate(), {}, units};
    queue_.add({float(node), 1, 2, 3}, float(node) / 2, node, units);
  }
  void pass(const Motion& m) {
    queue_.advance(m);
    for (auto& [node, p] : promises_)
      p.passed = {p.passed.travel + m.travel, p.passed.turn + m.turn, p.passed.scale + m.scale};
  }
  /// Takes what is due, and returns it; what is late is an error.
  std::vector<std::uint32_t> take() {
    std::vector<std::uint32_t> taken;
    for (; queue_.dueCount() > 0; queue_.removeDue(1)) {
      const KineticQueue::Batch& batch = queue_.due(0);
      for (std::uint32_t i = 0; i < batch.count; ++i) {
        EXPECT_EQ(batch.balls[i].x, float(batch.nodes[i]));
        EXPECT_EQ(batch.errors[i], float(batch.nodes[i]) / 2);
        EXPECT_TRUE(promises_.contains(batch.nodes[i])) << "due twice: " << batch.nodes[i];
        waited.push_back(promises_[batch.nodes[i]].passed.in(promises_[batch.nodes[i]].rate) /
                         promises_[batch.nodes[i]].units);
        promises_.erase(batch.nodes[i]);
        taken.push_back(batch.nodes[i]);
      }
    }
    for (const auto& [node, p] : promises_) {
      // The parts of one motion pass at once: the most of them is what the promise is about.
      EXPECT_LE(p.passed.in(p.rate), p.units) << "late: " << node;
    }
    return taken;
  }
  std::size_t left() const { return promises_.size(); }

  std::vector<double> waited;  // of what was taken: the part of its time that had passed

 private:
  KineticQueue& queue_;
  std::map<std::uint32_t, Promise> promises_;
};

TEST(KineticQueue, IsNeverLateHoweverTheCameraMoves) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::lognormal_distribution<double> size(0, 2), often(1, 2);
    KineticQueue queue(1e-6);
    Oracle oracle(queue);
    std::uint32_t node = 0;
    Motion usual{1, 0.01, 0};
    for (int step = 0; step < 600; ++step) {
      if (step % 60 == 0) usual = {size(random), 0.01 * size(random), unit(random) < 0.5 ? 0 : 1e-3};
      if (step % 60 == 31) usual = {0, 0.02, 0};  // turning on the spot
      const double jerk = step % 7 == 0 ? 20 * unit(random) : 1;
      const bool isStill = step % 11 == 0;
      if (!isStill) oracle.pass({usual.travel * jerk, usual.turn * jerk, usual.scale});
      if (step % 211 == 0) oracle.pass({1e12, 3, 40});
      for (const std::uint32_t n : oracle.take())
        if (unit(random) < 0.9) oracle.add(n, static_cast<float>(often(random)));
      for (int i = 0; i < 20; ++i)
        oracle.add(node++, static_cast<float>(unit(random) < 0.1 ? 1e30 : often(random)));
    }
    queue.advanceToEnd();
    oracle.take();
    EXPECT_EQ(oracle.left(), 0u);
  }
}

TEST(KineticQueue, HoldsCertificatesForMostOfTheirTimeWhenTheCameraIsSteady) {
  KineticQueue queue(1e-6);
  Oracle oracle(queue);
  const Motion frame{2.5, 0.006, 0};
  for (int i = 0; i < 10; ++i) oracle.pass(frame);
  for (std::uint32_t n = 0; n < 1000; ++n) oracle.add(n, 2 + 0.1f * float(n));
  for (int i = 0; i < 101; ++i) {
    oracle.pass(frame);
    oracle.take();
  }
  ASSERT_GT(oracle.waited.size(), 900u);
  double sum = 0;
  for (const double part : oracle.waited) sum += part;
  EXPECT_GT(sum / double(oracle.waited.size()), 0.9);
}

TEST(KineticQueue, MakesNothingDueWhileNothingMoves) {
  KineticQueue queue(1);
  queue.add({}, 0, 7, 0);
  queue.advance({});
  EXPECT_EQ(queue.dueCount(), 0u);
  queue.advance({.turn = 1e-9});
  EXPECT_EQ(queue.dueCount(), 1u);
}

TEST(KineticQueue, ClearsAllAndVisitsEach) {
  KineticQueue queue(1);
  std::vector<std::uint32_t> cleared;
  for (std::uint32_t n = 0; n < 200; ++n) queue.add({}, 0, n, float(n));
  queue.clear([&](std::uint32_t n) { cleared.push_back(n); });
  EXPECT_EQ(cleared.size(), 200u);
  queue.advanceToEnd();
  EXPECT_EQ(queue.dueCount(), 0u);
}

}  // namespace
}  // namespace arete
