// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include "datasets/families.h"
#include "io/amt_fixture.h"
#include "io/store/amt/index_check.h"
#include "io/store/format/metadata.h"
#include "io/store/packed/packed.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::built;
using test::hills;

/// A model, packed, with what unpacking needs.
struct Packed {
  explicit Packed(const TerrainModel& from)
      : model(from), metadata(amtMetadataOf(from, "test")), bytes(*packMt(from)) {}

  Result<MultiTriangulation> unpacked(const RequiredError& wanted = {},
                                      const RunContext& context = {}) const {
    return unpackMt(metadata, bytes.directory, bytes.tables, bytes.nodes, wanted, context);
  }

  TerrainModel model;
  AmtMetadata metadata;
  PackedMt bytes;
};

Packed packedHills() {
  return Packed(built(build(hills(300, 260, [](double z) { return std::round(z); }))));
}

TEST(Unpack, HasAsManyNodesAndTrianglesWithIndicesThatPassTheCheck) {
  const Packed packed = packedHills();
  const auto mt = packed.unpacked();
  ASSERT_TRUE(mt) << mt.error().describe();
  EXPECT_EQ(mt->nodeCount(), packed.model.mt.nodeCount());
  EXPECT_EQ(mt->finestTriangleCount(), packed.model.mt.finestTriangleCount());
  EXPECT_EQ(mt->largestError(), packed.model.mt.largestError());
  const Status sound = checkMtIndices(*mt, 300 * 260);
  EXPECT_TRUE(sound) << sound.error().describe();
}

TEST(Unpack, ReadsTheFirstBandsAloneWithTheNumbersOfTheWhole) {
  const Packed packed = packedHills();
  const auto whole = packed.unpacked();
  const double error = packed.model.mt.largestError() / 16;
  const auto part = packed.unpacked([error](const Box3&) { return error; });
  ASSERT_TRUE(whole && part);
  ASSERT_LT(part->nodeCount(), whole->nodeCount());
  ASSERT_GT(part->nodeCount(), 0u);
  for (std::uint32_t n = 0; n < part->nodeCount(); ++n) {
    ASSERT_EQ(part->vertices().samples[part->apex(NodeId(n)).index()],
              whole->vertices().samples[whole->apex(NodeId(n)).index()]);
    ASSERT_EQ(part->slotCount(NodeId(n)), whole->slotCount(NodeId(n)));
  }
  EXPECT_TRUE(checkMtIndices(*part, 300 * 260));
}

TEST(Unpack, ReadsTheRootAloneWhereNothingIsWanted) {
  const Packed packed = packedHills();
  const auto root = packed.unpacked([](const Box3&) { return std::numeric_limits<double>::infinity(); });
  ASSERT_TRUE(root) << root.error().describe();
  EXPECT_EQ(root->nodeCount(), 0u);
  EXPECT_EQ(root->rootTriangleCount(), packed.model.mt.rootTriangleCount());
}

TEST(Unpack, RefusesBytesThatDoNotFitTogether) {
  const Packed good = packedHills();
  const auto refusal = [&](const auto& change) {
    Packed packed = good;
    change(packed);
    const auto mt = packed.unpacked();
    return mt ? std::string("is read") : mt.error().message;
  };
  const auto holds = [&](const auto& change, const std::string& sentence) {
    EXPECT_NE(refusal(change).find(sentence), std::string::npos) << refusal(change);
  };
  holds([](Packed& p) { p.bytes.directory.pop_back(); }, "directory");
  holds([](Packed& p) { p.bytes.tables.pop_back(); }, "tables");
  holds([](Packed& p) { p.bytes.nodes.pop_back(); }, "bytes where their directory");
  holds([](Packed& p) { --p.metadata.counts.nodes; }, "not as many");
  holds([](Packed& p) { p.bytes.nodes[p.bytes.nodes.size() / 2] ^= std::byte{1}; }, "checksum");
}

TEST(Unpack, StopsWhenCancelled) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const auto mt = packedHills().unpacked({}, context);
  ASSERT_FALSE(mt);
  EXPECT_EQ(mt.error().code, ErrorCode::interrupted);
}

TEST(Unpack, StatesTheErrorBeyondANumberOfNodes) {
  const Packed packed = packedHills();
  const auto beyond = [&](std::uint64_t nodes) {
    return packedErrorBeyond(packed.bytes.directory, packed.metadata.scale, nodes);
  };
  double last = std::numeric_limits<double>::infinity();
  for (std::uint64_t nodes = 1; nodes < packed.model.mt.nodeCount(); nodes *= 3) {
    const double error = beyond(nodes);
    EXPECT_LE(error, last);
    last = error;
    if (!(error > 0)) break;
    const auto part = packed.unpacked([error](const Box3&) { return error; });
    ASSERT_TRUE(part);
    EXPECT_GE(part->nodeCount(), nodes);
  }
  EXPECT_EQ(beyond(packed.model.mt.nodeCount() + 1), 0);
  EXPECT_EQ(packedErrorBeyond({}, packed.metadata.scale, 1), 0);
}

}  // namespace
}  // namespace arete
