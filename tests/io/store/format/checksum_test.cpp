// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/format/checksum.h"

#include <gtest/gtest.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "datasets/random.h"
#include "io/store/format/layout.h"

namespace arete {
namespace {

std::vector<std::byte> noise(std::size_t size, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::byte> bytes(size);
  for (std::byte& b : bytes) b = static_cast<std::byte>(random.next());
  return bytes;
}

TEST(Checksum, OfBlocksAndTheirSegmentsIsThatOfTheBytesAtOnceForAnyNumberOfThreads) {
  std::vector<std::vector<std::byte>> kept;
  for (const std::size_t size : {0u, 1u, 65535u, 65536u, 65537u, 5000000u}) kept.push_back(noise(size, size));
  const std::vector<std::span<const std::byte>> blocks(kept.begin(), kept.end());
  for (const int threads : {1, 2, 4}) {
    RunContext context;
    context.threads = threads;
    const auto sums = amtChecksums(blocks, "checksum", context);
    ASSERT_TRUE(sums);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      EXPECT_EQ(sums->blocks[i], XXH3_64bits(kept[i].data(), kept[i].size()));
      EXPECT_EQ(sums->blocks[i], amtChecksum(blocks[i]));
      ASSERT_EQ(sums->segments[i].size(), amtSegmentCount(amt_tag::kLink, kept[i].size()));
      for (std::size_t s = 0; s < sums->segments[i].size(); ++s) {
        const std::size_t at = s * kAmtSegmentBytes;
        EXPECT_EQ(
            sums->segments[i][s],
            XXH3_64bits(kept[i].data() + at, std::min<std::size_t>(kAmtSegmentBytes, kept[i].size() - at)));
      }
    }
  }
}

TEST(Checksum, StopsWhenCancelled) {
  const auto bytes = noise(100, 1);
  const std::vector<std::span<const std::byte>> blocks{bytes};
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  EXPECT_FALSE(amtChecksums(blocks, "checksum", context));
}

}  // namespace
}  // namespace arete
