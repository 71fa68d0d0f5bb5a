// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each block is hashed as a stream, segment by segment; a segment is hashed by itself while it is in the
// cache. After every kTurn bytes progress is reported and cancellation is checked. The sum of a block is that
// of hashing it at once.
#include "io/store/format/checksum.h"

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "io/store/format/layout.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <new>

namespace arete {
namespace {

constexpr std::size_t kTurn = std::size_t{1} << 22;
static_assert(kTurn % kAmtSegmentBytes == 0);

struct FreeState {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

}  // namespace

std::uint64_t amtChecksum(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::optional<AmtChecksums> amtChecksums(std::span<const std::span<const std::byte>> blocks,
                                         std::string_view stage, const RunContext& context) {
  std::uint64_t total = 1, done = 0;
  for (const auto& block : blocks) total += block.size();
  std::mutex mutex;
  std::atomic<bool> stopped = false;
  AmtChecksums sums;
  sums.blocks.resize(blocks.size());
  sums.segments.resize(blocks.size());
  const auto hash = [&](std::size_t i) {
    const std::span<const std::byte> block = blocks[i];
    const std::unique_ptr<XXH3_state_t, FreeState> state(XXH3_createState());
    if (!state) throw std::bad_alloc();
    XXH3_64bits_reset(state.get());
    for (std::size_t turn = 0; turn < block.size() && !stopped; turn += kTurn) {
      const std::size_t end = std::min(turn + kTurn, block.size());
      for (std::size_t at = turn; at < end; at += kAmtSegmentBytes) {
        const auto segment = block.subspan(at, std::min(kAmtSegmentBytes, end - at));
        sums.segments[i].push_back(amtChecksum(segment));
        XXH3_64bits_update(state.get(), segment.data(), segment.size());
      }
      const std::lock_guard lock(mutex);
      done += end - turn;
      context.report(stage, static_cast<double>(done) / static_cast<double>(total));
      if (context.cancelled()) stopped = true;
    }
    sums.blocks[i] = XXH3_64bits_digest(state.get());
  };
  withThreads(context, [&] { parallelFor(std::size_t{0}, blocks.size(), hash); });
  if (stopped || context.cancelled()) return std::nullopt;
  context.report(stage, 1);
  return sums;
}

}  // namespace arete
