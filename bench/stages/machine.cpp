// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the machine can do at best, to hold the other stages against. Bandwidth after McCalpin's STREAM: bytes
// are counted as the program names them, and what the caches fetch before they are overwritten is not, so
// triad shows less than the memory moves; arrays of 256 MiB leave every cache. Random access twice: along a
// chain, in which every address comes out of the load before it (latency), and at addresses known beforehand
// (throughput: as many misses at once as the core can keep in flight). Of several runs the best counts: these
// are limits, and whatever disturbs only slows.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "bench/stages/stages.h"
#include "bench/threads.h"
#include "datasets/random.h"

namespace arete::bench {
namespace {

constexpr std::size_t kStreamItems = std::size_t(32) << 20;  // 256 MiB of doubles
constexpr std::size_t kLine = 64;
constexpr std::size_t kFarBytes = std::size_t(512) << 20;

/// What is computed for its time only goes here, so that no compiler leaves it out.
std::atomic<std::uint64_t> theSink{0};

/// Seconds of the fastest of several runs of work(begin, end) on equal parts of [0, items).
template <class Work>
double bestSeconds(std::size_t items, int runs, const Work& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const Stopwatch watch;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, items, 1 << 16),
        [&](const auto& range) { work(range.begin(), range.end()); }, tbb::static_partitioner());
    best = std::min(best, watch.seconds());
  }
  return best;
}

/// murmur3's finaliser: consecutive numbers become places all over the memory.
std::uint64_t scatter(std::uint64_t x) {
  x ^= x >> 33;
  x *= 0xff51afd7ed558ccdull;
  x ^= x >> 33;
  x *= 0xc4ceb9fe1a85ec53ull;
  return x ^ (x >> 33);
}

class MachineStage {
 public:
  explicit MachineStage(int runs) : runs_(runs) {}

  Figures run() {
    for (const int threads : {1, 0}) {
      const auto limit = limitTo(threads);
      variant_ = threadsText(threads);
      streams();
      farAway();
      arithmetic();
    }
    variant_ = threadsText(1);
    add("chase, 512 KiB", chaseNanoseconds(std::size_t(512) << 10), "ns", Better::lower);
    add("chase, 16 MiB", chaseNanoseconds(std::size_t(16) << 20), "ns", Better::lower);
    add("chase, 512 MiB", chaseNanoseconds(kFarBytes), "ns", Better::lower);
    return std::move(figures_);
  }

 private:
  void add(const char* name, double value, const char* unit, Better better) {
    figures_.push_back({"this machine", "machine", variant_, name, value, unit, better});
  }

  void streams() {
    const auto a = std::make_unique_for_overwrite<double[]>(kStreamItems);
    const auto b = std::make_unique_for_overwrite<double[]>(kStreamItems);
    const auto c = std::make_unique_for_overwrite<double[]>(kStreamItems);
    for (std::size_t i = 0; i < kStreamItems; ++i) {
      a[i] = 0;
      b[i] = double(i);
      c[i] = 1;
    }
    const double gigabytes = 1e-9 * double(kStreamItems * sizeof(double));
    const double reading = bestSeconds(kStreamItems, runs_, [&](std::size_t begin, std::size_t end) {
      // Bits, in eight sums: no addition waits for the one before it.
      std::array<std::uint64_t, 8> sums{}, words{};
      for (std::size_t i = begin; i + 8 <= end; i += 8) {
        std::memcpy(words.data(), &b[i], sizeof words);
        for (std::size_t k = 0; k < 8; ++k) sums[k] += words[k];
      }
      theSink += std::accumulate(sums.begin(), sums.end(), std::uint64_t(0));
    });
    add("read", gigabytes / reading, "GB/s", Better::higher);
    const double copying = bestSeconds(kStreamItems, runs_, [&](std::size_t begin, std::size_t end) {
      std::memcpy(&a[begin], &b[begin], (end - begin) * sizeof(double));
    });
    add("copy", 2 * gigabytes / copying, "GB/s", Better::higher);
    const double triad = bestSeconds(kStreamItems, runs_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) a[i] = b[i] + 3 * c[i];
    });
    add("triad", 3 * gigabytes / triad, "GB/s", Better::higher);
    theSink += std::uint64_t(a[kStreamItems / 2]);
  }

  /// Loads and stores of four bytes at unrelated places of 512 MiB.
  void farAway() {
    const std::size_t words = kFarBytes / sizeof(std::uint32_t);
    const auto memory = std::make_unique<std::uint32_t[]>(words);
    for (std::size_t i = 0; i < words; i += kLine / 8) memory[i] = 1;
    constexpr std::size_t kPlaces = 8 << 20;
    const double gathering = bestSeconds(kPlaces, runs_, [&](std::size_t begin, std::size_t end) {
      std::uint64_t sum = 0;
      for (std::size_t i = begin; i < end; ++i) sum += memory[scatter(i) & (words - 1)];
      theSink += sum;
    });
    add("gather", 1e9 * gathering / kPlaces, "ns", Better::lower);
    const double scattering = bestSeconds(kPlaces, runs_, [&](std::size_t begin, std::size_t end) {
      // Threads may meet in a word: what stands there afterwards does not matter, that it is defined does.
      for (std::size_t i = begin; i < end; ++i)
        std::atomic_ref(memory[scatter(i) & (words - 1)]).store(1, std::memory_order_relaxed);
    });
    add("scatter", 1e9 * scattering / kPlaces, "ns", Better::lower);
  }

  /// Multiplications and additions of doubles in sixteen chains, as the compiler arranges them.
  void arithmetic() {
    constexpr std::size_t kRounds = 32 << 20;
    const double seconds = bestSeconds(kRounds, runs_, [&](std::size_t begin, std::size_t end) {
      std::array<double, 16> x;
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = double(begin + k);
      for (std::size_t i = begin; i < end; ++i)
        for (double& one : x) one = one * 0.999 + 1;
      theSink += std::uint64_t(std::accumulate(x.begin(), x.end(), 0.0));
    });
    add("arithmetic", 1e-9 * 2 * 16 * kRounds / seconds, "Gflop/s", Better::higher);
  }

  /// One cycle through all lines, in random order (Sattolo): every load says where the next one is.
  double chaseNanoseconds(std::size_t bytes) const {
    const std::size_t lines = bytes / kLine, stride = kLine / sizeof(std::uint64_t);
    std::vector<std::uint32_t> order(lines);
    std::iota(order.begin(), order.end(), 0u);
    Random random(1);
    for (std::size_t i = lines - 1; i > 0; --i)
      std::swap(order[i], order[std::min(i - 1, std::size_t(random.between(0, double(i))))]);
    const auto memory = std::make_unique<std::uint64_t[]>(lines * stride);
    for (std::size_t i = 0; i < lines; ++i) memory[i * stride] = order[i] * stride;
    constexpr std::size_t kSteps = 4 << 20;
    double best = std::numeric_limits<double>::infinity();
    std::uint64_t at = 0;
    for (int run = 0; run < runs_; ++run) {
      const Stopwatch watch;
      for (std::size_t i = 0; i < kSteps; ++i) at = memory[at];
      best = std::min(best, watch.seconds());
    }
    theSink += at;
    return 1e9 * best / double(kSteps);
  }

  int runs_;
  std::string variant_;
  Figures figures_;
};

}  // namespace

Figures machineStage(const Plan& plan) {
  return MachineStage(std::max(5, plan.repetition.most)).run();
}

}  // namespace arete::bench
