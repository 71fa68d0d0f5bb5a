// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "datasets/families.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::AmtBytes;
using test::built;
using test::TemporaryFolder;

TEST(Reader, KnowsWhatTheFileIsBeforeItsArraysAreRead) {
  const TemporaryFolder folder;
  const TerrainModel model = test::tinyModel();
  for (const bool isPacked : {false, true}) {
    const std::string path = folder.file("a.amt");
    ASSERT_TRUE(writeAmt(path, model, {}, {.writer = "me", .isPacked = isPacked}));
    const auto file = openAmt(path);
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->path(), path);
    EXPECT_EQ(file->writer(), "me");
    EXPECT_EQ(file->isPacked(), isPacked);
    EXPECT_EQ(file->hasSegments(), !isPacked);
    EXPECT_EQ(file->nodeCount(), 2u);
    EXPECT_EQ(file->bytes().size(), std::filesystem::file_size(path));
    EXPECT_EQ(file->model().source, "tiny.tif");
    EXPECT_EQ(file->model().mt.nodeCount(), isPacked ? 0u : 2u);
    EXPECT_EQ(file->isolatedSamples().size(), 1u);
    EXPECT_EQ(file->fixedVertices().size(), 2u);
    EXPECT_EQ(file->read()->mt.nodeCount(), 2u);
  }
}

TEST(Reader, SkipsAChunkWhoseTagItDoesNotKnow) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.amt");
  ASSERT_TRUE(writeAmt(path, test::tinyModel()));
  // The checksums of segments, under an unknown tag.
  AmtBytes bytes = AmtBytes::of(path);
  bytes.chunk(amt_tag::kSegmentChecksums).tag = {'N', 'E', 'W', '1'};
  bytes.sealHeader();
  bytes.save(path);
  const auto file = openAmt(path);
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_FALSE(file->hasSegments());
  test::expectSameModel(built(file->read()), test::tinyModel());
}

TEST(Reader, TellsWhatIsWrongWithAFileThatCannotBeOpened) {
  const TemporaryFolder folder;
  const std::string good = folder.file("a.amt"), path = folder.file("b.amt");
  ASSERT_TRUE(writeAmt(good, test::tinyModel()));
  const auto refusal = [&](const auto& change) {
    AmtBytes bytes = AmtBytes::of(good);
    change(bytes);
    bytes.sealHeader();
    bytes.save(path);
    const auto file = openAmt(path);
    return file ? std::string("is opened")
                : std::string(toString(file.error().code)) + ": " + file.error().message;
  };
  const auto holds = [&](const auto& change, const std::string& sentence) {
    const std::string refused = refusal(change);
    EXPECT_NE(refused.find(sentence), std::string::npos) << refused;
  };
  holds([](AmtBytes& b) { b.header().magic[1] = 'B'; }, "is not an .amt file");
  holds([](AmtBytes& b) { b.header().byteOrder = kAmtByteOrderSwapped; }, "big-endian");
  holds([](AmtBytes& b) { b.header().version = 4; }, "4");
  holds([](AmtBytes& b) { b.header().reserved = 1; }, "reserved");
  holds([](AmtBytes& b) { b.header().fileBytes += 64; }, "is cut short");
  holds([](AmtBytes& b) { b.chunks()[2].offset += 64; }, "gap");
  holds([](AmtBytes& b) { b.chunks()[2].tag = b.chunks()[1].tag; }, "occurs twice");
  holds([](AmtBytes& b) { b.chunks()[1].scalar = AmtScalar::f32; }, "elements of another type");
  EXPECT_EQ(openAmt(folder.file("none.amt")).error().code, ErrorCode::notFound);
}

TEST(Reader, GuessesTheErrorBeyondANumberOfNodes) {
  const TemporaryFolder folder;
  const TerrainModel model = built(build(test::hills(200, 150, [](double z) { return std::round(z); })));
  for (const bool isPacked : {false, true}) {
    ASSERT_TRUE(writeAmt(folder.file("a.amt"), model, {}, {.isPacked = isPacked}));
    const auto file = openAmt(folder.file("a.amt"));
    double last = std::numeric_limits<double>::infinity();
    for (const std::uint64_t nodes : {100u, 1000u, 5000u, 20000u}) {
      const double error = file->errorBeyond(nodes);
      EXPECT_LE(error, last);
      last = error;
      if (!(error > 0)) continue;
      const auto part = file->read({.wanted = [error](const Box3&) { return error; }});
      ASSERT_TRUE(part);
      EXPECT_GE(part->mt.nodeCount(), nodes * 9 / 10) << "a guess, by spans of nodes";
    }
    EXPECT_EQ(file->errorBeyond(file->nodeCount() + 5000), 0);
  }
}

TEST(Reader, LoadsWhatOpenAndReadGive) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.amt");
  ASSERT_TRUE(writeAmt(path, test::tinyModel()));
  for (const bool randomAccess : {false, true})
    test::expectSameModel(built(loadAmt(path, {.open = {.randomAccess = randomAccess}})), test::tinyModel());
}

}  // namespace
}  // namespace arete
