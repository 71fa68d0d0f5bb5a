// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/nodes/order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <vector>

#include "engine/parallel/with_threads.h"

namespace arete::packed {
namespace {

/// Packets that lean on a few of the ones before them.
std::vector<Packet> packetsOf(std::uint32_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Packet> packets(count);
  for (std::uint32_t i = 1; i < count; ++i) {
    std::vector<std::uint32_t>& dependsOn = packets[i].dependsOn;
    dependsOn.push_back(0);
    for (unsigned k = random() % 4; k > 0; --k) dependsOn.push_back(static_cast<std::uint32_t>(random() % i));
    std::ranges::sort(dependsOn);
    dependsOn.erase(std::unique(dependsOn.begin(), dependsOn.end()), dependsOn.end());
  }
  return packets;
}

constexpr auto kNothingWrong = [](std::size_t) { return std::optional<std::string>(); };
constexpr auto kNothingDone = [](std::size_t) {};

TEST(PackedOrder, TakesEveryPacketOnceAndAfterThoseBeforeItOnTheWay) {
  for (const Direction direction : {Direction::forwards, Direction::backwards})
    for (const int threads : {1, 2, 4}) {
      const std::vector<Packet> packets = packetsOf(500, 3);
      std::vector<std::atomic<int>> taken(packets.size());
      std::atomic<int> early = 0;
      std::size_t done = 0;
      RunContext context;
      context.threads = threads;
      const auto body = [&](std::size_t i) {
        for (std::size_t j = 0; j < packets.size(); ++j) {
          const std::size_t leaner = std::max(i, j), other = std::min(i, j);
          const bool isBound =
              std::ranges::binary_search(packets[leaner].dependsOn, static_cast<std::uint32_t>(other));
          if (isBound && (direction == Direction::forwards ? j < i : j > i) && taken[j] != 1) ++early;
        }
        ++taken[i];
        return std::optional<std::string>();
      };
      const auto problem = withThreads(context, [&] {
        return forPackets(packets, direction, context, body, [&](std::size_t) { ++done; });
      });
      EXPECT_FALSE(problem);
      EXPECT_EQ(early, 0);
      EXPECT_EQ(done, packets.size());
      EXPECT_TRUE(std::ranges::all_of(taken, [](const auto& times) { return times == 1; }));
    }
}

TEST(PackedOrder, NamesTheFirstProblemOnTheWayForAnyNumberOfThreads) {
  const std::vector<Packet> packets = packetsOf(300, 7);
  const auto body = [](std::size_t i) {
    return i % 50 == 21 ? std::optional<std::string>("is odd") : std::nullopt;
  };
  for (const int threads : {1, 2, 4}) {
    RunContext context;
    context.threads = threads;
    const auto first = withThreads(
        context, [&] { return forPackets(packets, Direction::forwards, context, body, kNothingDone); });
    const auto last = withThreads(
        context, [&] { return forPackets(packets, Direction::backwards, context, body, kNothingDone); });
    ASSERT_TRUE(first && last);
    EXPECT_EQ(first->packet, 21u);
    EXPECT_EQ(last->packet, 271u);
    EXPECT_EQ(first->what, "is odd");
  }
}

TEST(PackedOrder, BeginsNothingOnceItIsCancelled) {
  const std::vector<Packet> packets = packetsOf(50, 1);
  std::atomic<bool> cancel = false;
  RunContext context;
  context.cancel = &cancel;
  std::size_t done = 0;
  EXPECT_FALSE(forPackets(packets, Direction::forwards, context, kNothingWrong, [&](std::size_t) {
    ++done;
    cancel = true;
  }));
  EXPECT_EQ(done, 1u);
}

}  // namespace
}  // namespace arete::packed
