// SPDX-License-Identifier: GPL-3.0-or-later
//
// A block is hashed as a stream of pieces, between which progress is told and a wish to stop is heard; the
// result is that of hashing it at once.
#include "io/amt_checksum.h"

#include "engine/with_threads.h"

#include <tbb/parallel_for.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>

namespace arete {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 22;

struct FreeState {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

}  // namespace

std::uint64_t amtChecksum(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::optional<std::vector<std::uint64_t>> amtChecksums(std::span<const std::span<const std::byte>> blocks,
                                                       std::string_view stage, const RunContext& context) {
  std::uint64_t total = 1, done = 0;
  for (const auto& block : blocks) total += block.size();
  std::mutex mutex;
  std::atomic<bool> stopped = false;
  std::vector<std::uint64_t> sums(blocks.size());
  const auto hash = [&](std::size_t i) {
    const std::unique_ptr<XXH3_state_t, FreeState> state(XXH3_createState());
    XXH3_64bits_reset(state.get());
    for (std::size_t at = 0; at < blocks[i].size() && !stopped; at += kPiece) {
      const std::size_t count = std::min(kPiece, blocks[i].size() - at);
      XXH3_64bits_update(state.get(), blocks[i].data() + at, count);
      const std::lock_guard lock(mutex);
      done += count;
      context.report(stage, static_cast<double>(done) / static_cast<double>(total));
      if (context.cancelled()) stopped = true;
    }
    sums[i] = XXH3_64bits_digest(state.get());
  };
  withThreads(context, [&] { tbb::parallel_for(std::size_t{0}, blocks.size(), hash); });
  if (stopped || context.cancelled()) return std::nullopt;
  context.report(stage, 1);
  return sums;
}

}  // namespace arete
