// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <atomic>

#include "datasets/families.h"
#include "io/amt_fixture.h"
#include "io/store/format/checksum.h"
#include "io/store/packed/nodes/layout.h"
#include "io/store/packed/packed.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::built;
using test::hills;

const auto kWhole = [](double z) { return std::round(z); };

TEST(Pack, StatesEveryPacketsSizeAndChecksum) {
  const TerrainModel model = built(build(hills(300, 260, kWhole)));
  const auto packed = packMt(model);
  ASSERT_TRUE(packed) << packed.error().describe();
  std::string problem;
  const auto directory = packed::directoryOf(packed->directory, problem);
  ASSERT_TRUE(directory) << problem;
  EXPECT_TRUE(tablesOf(packed->tables, packed::kTables));
  EXPECT_EQ(directory->nodes(), model.mt.nodeCount());
  EXPECT_EQ(directory->slots(), model.mt.arrays().link.size());
  std::uint64_t end = 0;
  for (const packed::Packet& packet : directory->packets) {
    const packed::Segment& all = packet.segments[0];
    EXPECT_EQ(all.begin(), end);
    end += packet.bytes();
    ASSERT_LE(end, packed->nodes.size());
    EXPECT_GE(packet.bytes(), packed::leastBytes(packet.nodes));
    EXPECT_EQ(amtChecksum(std::span(packed->nodes).subspan(all.begin(), all.bytes())), all.checksum);
  }
  EXPECT_EQ(end, packed->nodes.size());
}

TEST(Pack, GivesTheSameBytesForAnyNumberOfThreads) {
  const TerrainModel model = built(build(hills(300, 260, kWhole)));
  const auto packed = packMt(model);
  for (const int threads : {1, 2, 4}) {
    RunContext context;
    context.threads = threads;
    const auto again = packMt(model, {}, context);
    ASSERT_TRUE(again);
    EXPECT_TRUE(again->directory == packed->directory && again->tables == packed->tables &&
                again->nodes == packed->nodes)
        << threads;
  }
}

TEST(Pack, RefusesAnMtWhoseFloorsAreNotWhatItsRemoversSay) {
  const TerrainModel model = built(build(hills(40, 30, kWhole)));
  MtArrays a = model.mt.arrays();
  // The first node takes a triangle that another one removes.
  std::vector<std::uint32_t> remover(a.remover.begin(), a.remover.end());
  const std::uint32_t t = model.mt.floor(NodeId(0))[0];
  std::uint32_t last = static_cast<std::uint32_t>(remover.size() - 1);
  while (remover[last] == MultiTriangulation::kNone || remover[last] == 0) --last;
  std::swap(remover[t], remover[last]);
  a.remover = remover;
  TerrainModel broken = model;
  broken.mt = MultiTriangulation(a, nullptr);
  const auto packed = packMt(broken);
  ASSERT_FALSE(packed);
  EXPECT_EQ(packed.error().code, ErrorCode::invalidData);
}

TEST(Pack, StopsWhenCancelled) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const auto packed = packMt(built(build(hills(40, 30, kWhole))), {}, context);
  ASSERT_FALSE(packed);
  EXPECT_EQ(packed.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete
