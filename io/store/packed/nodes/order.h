// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "engine/parallel/per_thread.h"
#include "engine/parallel/run_context.h"
#include "io/store/packed/nodes/layout.h"

namespace arete::packed {

/// The order of packets: each after those that it depends on, or after those that depend on it.
enum class Direction { forwards, backwards };

/// A packet, and what is wrong with it.
struct PacketProblem {
  std::size_t packet;
  std::string what;
};

/// Calls body(packet) in parallel for all packets, each as soon as those before it in the order are done. Of
/// the packets that are ready the first one is taken (backwards: the last one), so that neighbours follow
/// each other and share a cache. body() returns what is wrong with the packet, or nothing; then done(packet)
/// is called, for one packet at a time. No packet is begun once the context is cancelled, or after a packet
/// with a problem. Of several problems the first one in the order is returned, so the result does not depend
/// on the threads if that of body() does not. O(packets log packets + dependencies) beside the calls.
template <class Body, class Done>
class PacketOrder {
 public:
  PacketOrder(const std::vector<Packet>& packets, Direction direction, const RunContext& context,
              const Body& body, const Done& done)
      : direction_(direction), context_(context), body_(body), done_(done), size_(packets.size()) {
    next_.resize(size_);
    waitsFor_.assign(size_, 0);
    for (std::size_t i = 0; i < size_; ++i)
      for (const std::uint32_t other : packets[i].dependsOn) {
        const std::size_t before = direction == Direction::forwards ? other : i;
        const std::size_t after = direction == Direction::forwards ? i : other;
        next_[before].push_back(static_cast<std::uint32_t>(after));
        ++waitsFor_[after];
      }
  }

  std::optional<PacketProblem> run() {
    std::size_t ready = 0;
    for (std::size_t i = 0; i < size_; ++i)
      if (waitsFor_[i] == 0) {
        ready_.push(rankOf(i));
        ++ready;
      }
    firstBad_ = size_;
    start(ready);
    tasks_.wait();
    if (firstBad_ == size_) return std::nullopt;
    return PacketProblem{rankOf(firstBad_), std::move(problem_)};
  }

 private:
  /// The rank of a packet in the order, and the packet of a rank: the same map.
  std::size_t rankOf(std::size_t packet) const {
    return direction_ == Direction::forwards ? packet : size_ - 1 - packet;
  }
  void start(std::size_t count) {
    for (; count > 0; --count) tasks_.run([this] { step(); });
  }

  /// Takes one packet. There are as many tasks as packets that are ready.
  void step() {
    std::size_t rank = 0;
    {
      const std::lock_guard lock(mutex_);
      rank = ready_.top();
      ready_.pop();
      if (rank > firstBad_) return;
    }
    if (context_.cancelled()) return;
    const std::size_t packet = rankOf(rank);
    std::optional<std::string> bad = body_(packet);
    std::size_t ready = 0;
    {
      const std::lock_guard lock(mutex_);
      if (bad) {
        if (rank < firstBad_) {
          firstBad_ = rank;
          problem_ = std::move(*bad);
        }
        return;
      }
      done_(packet);
      for (const std::uint32_t after : next_[packet])
        if (--waitsFor_[after] == 0) {
          ready_.push(rankOf(after));
          ++ready;
        }
    }
    start(ready);
  }

  const Direction direction_;
  const RunContext& context_;
  const Body& body_;
  const Done& done_;
  const std::size_t size_;
  std::vector<std::vector<std::uint32_t>> next_;
  std::vector<std::uint32_t> waitsFor_;
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready_;
  std::size_t firstBad_ = 0;
  std::string problem_;
  std::mutex mutex_;
  TaskGroup tasks_;
};

/// PacketOrder, constructed and run.
template <class Body, class Done>
std::optional<PacketProblem> forPackets(const std::vector<Packet>& packets, Direction direction,
                                        const RunContext& context, const Body& body, const Done& done) {
  return PacketOrder<Body, Done>(packets, direction, context, body, done).run();
}

}  // namespace arete::packed
