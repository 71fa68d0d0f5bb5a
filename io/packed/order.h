// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/task_group.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "engine/parallel/run_context.h"
#include "io/packed/layout.h"

namespace arete::packed {

/// Which way chunks are taken: each after those that it leans on, or after those that lean on it.
enum class Direction { forwards, backwards };

/// What is wrong with a chunk.
struct ChunkProblem {
  std::size_t chunk;
  std::string what;
};

/// Calls body(chunk) in parallel for all chunks, each as soon as those due before it are done, and of those
/// that could begin the one nearest to the first (the last, backwards): neighbours follow each other, so what
/// they have in common stays in a cache. body returns what is wrong with the chunk, or nothing; then, one at
/// a time, done(chunk) is called. Nothing is begun any more once the context is cancelled, nor beyond a chunk
/// that has a problem; of several problems the first one on the way is returned, so it does not depend on
/// the threads if body's does not. O(chunks log chunks + what they lean on) beside the bodies.
template <class Body, class Done>
class ChunkOrder {
 public:
  ChunkOrder(const std::vector<Chunk>& chunks, Direction direction, const RunContext& context,
             const Body& body, const Done& done)
      : direction_(direction), context_(context), body_(body), done_(done), size_(chunks.size()) {
    next_.resize(size_);
    waitsFor_.assign(size_, 0);
    for (std::size_t i = 0; i < size_; ++i)
      for (const std::uint32_t other : chunks[i].leansOn) {
        const std::size_t before = direction == Direction::forwards ? other : i;
        const std::size_t after = direction == Direction::forwards ? i : other;
        next_[before].push_back(static_cast<std::uint32_t>(after));
        ++waitsFor_[after];
      }
  }

  std::optional<ChunkProblem> run() {
    std::size_t ready = 0;
    for (std::size_t i = 0; i < size_; ++i)
      if (waitsFor_[i] == 0) {
        ready_.push(placeOf(i));
        ++ready;
      }
    firstBad_ = size_;
    start(ready);
    tasks_.wait();
    if (firstBad_ == size_) return std::nullopt;
    return ChunkProblem{placeOf(firstBad_), std::move(problem_)};
  }

 private:
  /// A chunk's place on the way, and the chunk at a place.
  std::size_t placeOf(std::size_t chunk) const {
    return direction_ == Direction::forwards ? chunk : size_ - 1 - chunk;
  }
  void start(std::size_t count) {
    for (; count > 0; --count) tasks_.run([this] { step(); });
  }

  /// One chunk. There are as many tasks as chunks that are ready.
  void step() {
    std::size_t place = 0;
    {
      const std::lock_guard lock(mutex_);
      place = ready_.top();
      ready_.pop();
      if (place > firstBad_) return;
    }
    if (context_.cancelled()) return;
    const std::size_t chunk = placeOf(place);
    std::optional<std::string> bad = body_(chunk);
    std::size_t ready = 0;
    {
      const std::lock_guard lock(mutex_);
      if (bad) {
        if (place < firstBad_) {
          firstBad_ = place;
          problem_ = std::move(*bad);
        }
        return;
      }
      done_(chunk);
      for (const std::uint32_t after : next_[chunk])
        if (--waitsFor_[after] == 0) {
          ready_.push(placeOf(after));
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
  tbb::task_group tasks_;
};

template <class Body, class Done>
std::optional<ChunkProblem> forChunks(const std::vector<Chunk>& chunks, Direction direction,
                                      const RunContext& context, const Body& body, const Done& done) {
  return ChunkOrder<Body, Done>(chunks, direction, context, body, done).run();
}

}  // namespace arete::packed
