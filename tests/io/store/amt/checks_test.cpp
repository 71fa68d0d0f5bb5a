// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/amt/checks.h"

#include <gtest/gtest.h>

#include <limits>

#include "io/amt_fixture.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::AmtBytes;

class ChecksTest : public ::testing::Test {
 protected:
  ChecksTest() : path_(folder_.file("a.amt")) {
    if (!writeAmt(path_, test::tinyModel())) throw std::runtime_error("cannot write");
  }
  /// The file with a change, its checksums made right again or not.
  template <class Change>
  AmtFile changed(const Change& change, bool isSealed = true) {
    AmtBytes bytes = AmtBytes::of(path_);
    change(bytes);
    if (isSealed) bytes.seal();
    bytes.save(folder_.file("b.amt"));
    return *openAmt(folder_.file("b.amt"));
  }

  test::TemporaryFolder folder_;
  std::string path_;
};

TEST_F(ChecksTest, PassWhatWasWritten) {
  const AmtFile file = *openAmt(path_);
  EXPECT_EQ(amtGridSamples(file), 9u);
  EXPECT_TRUE(checkAmtExtras(file));
  EXPECT_TRUE(checkAmtIndices(file));
  EXPECT_TRUE(checkAmtChecksums(file));
  EXPECT_TRUE(checkAmtChunk(file, amt_tag::kLink));
  for (const AmtVerify verify : {AmtVerify::none, AmtVerify::indices, AmtVerify::all})
    EXPECT_TRUE(checkAmt(file, verify));
}

TEST_F(ChecksTest, LookAtWhatStandsBesideTheMultitriangulation) {
  const auto problemOf = [&](const auto& change) {
    const Status status = checkAmtExtras(changed(change));
    return status ? std::string() : status.error().message;
  };
  EXPECT_EQ(problemOf([](AmtBytes& b) {
              b.array<std::uint32_t>(amt_tag::kIsolatedSamples)[0] = 9;
            }).rfind("chunk ISAM: entry 0 is sample 9 of 9", 0),
            0u);
  EXPECT_EQ(problemOf([](AmtBytes& b) {
              b.array<double>(amt_tag::kIsolatedHeights)[0] = std::numeric_limits<double>::infinity();
            }).rfind("chunk IHGT: entry 0 is not finite", 0),
            0u);
  EXPECT_EQ(problemOf([](AmtBytes& b) {
              b.array<std::uint32_t>(amt_tag::kFixedVertices)[1] = 9;
            }).rfind("chunk FIXV: entry 1", 0),
            0u);
}

TEST_F(ChecksTest, SeeAChangedByteOnlyWhereTheyAreAskedForChecksums) {
  const AmtFile file = changed([](AmtBytes& b) { b.array<std::uint16_t>(amt_tag::kError)[3] ^= 1; }, false);
  EXPECT_TRUE(checkAmt(file, AmtVerify::none));
  EXPECT_TRUE(checkAmt(file, AmtVerify::indices));
  const Status all = checkAmt(file, AmtVerify::all);
  ASSERT_FALSE(all);
  EXPECT_EQ(all.error().code, ErrorCode::corrupt);
  EXPECT_NE(all.error().message.find("ERRR"), std::string::npos);
  EXPECT_FALSE(checkAmtChunk(file, amt_tag::kError));
  EXPECT_TRUE(checkAmtChunk(file, amt_tag::kLink));
}

TEST_F(ChecksTest, SeeChangedIndicesWhateverTheChecksumsSay) {
  const AmtFile file = changed([](AmtBytes& b) { b.array<std::uint32_t>(amt_tag::kLink)[0] = 99; });
  EXPECT_TRUE(checkAmtChecksums(file));
  EXPECT_TRUE(checkAmt(file, AmtVerify::none));
  const Status status = checkAmt(file, AmtVerify::indices);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().culprit, file.path());
}

TEST_F(ChecksTest, SeeBytesBetweenChunks) {
  AmtBytes bytes = AmtBytes::of(path_);
  const AmtChunk& link = bytes.chunk(amt_tag::kLink);
  std::string text = bytes.bytes();
  text[link.offset + link.bytes] = 1;
  test::writeAll(folder_.file("b.amt"), text);
  const Status status = checkAmtChecksums(*openAmt(folder_.file("b.amt")));
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("between its chunks"), std::string::npos);
}

}  // namespace
}  // namespace arete
