// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/amt/segments.h"

#include <gtest/gtest.h>

#include <atomic>

#include "datasets/families.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::AmtBytes;
using test::built;

/// A file whose chunk LINK has several segments, and one byte of it changed.
class SegmentsTest : public ::testing::Test {
 protected:
  SegmentsTest() : path_(folder_.file("a.amt")) {
    const auto model = built(build(test::hills(200, 150, [](double z) { return std::round(z); })));
    if (!writeAmt(path_, model)) throw std::runtime_error("cannot write");
    AmtBytes bytes = AmtBytes::of(path_);
    links_ = bytes.chunk(amt_tag::kLink).bytes / 4;
    altered_ = links_ / 2;
    bytes.array<std::uint32_t>(amt_tag::kLink)[altered_] ^= 1;
    bytes.save(path_);
    file_ = *openAmt(path_);
  }

  test::TemporaryFolder folder_;
  std::string path_;
  std::uint64_t links_ = 0, altered_ = 0;
  std::optional<AmtFile> file_;
};

TEST_F(SegmentsTest, AreCheckedWhereTheyWereTouchedAlone) {
  constexpr std::uint64_t kPerSegment = kAmtSegmentBytes / 4;
  const std::uint64_t begin = altered_ / kPerSegment * kPerSegment, end = begin + kPerSegment;
  ASSERT_GT(begin, 0u);
  ASSERT_LT(end, links_);
  AmtSegments segments(*file_);
  const auto link = segments.of(amt_tag::kLink);
  segments.touch(link, 0, begin);
  segments.touch(link, end, links_);
  segments.touch(link, altered_, altered_);  // nothing
  segments.touchAll(segments.of(amt_tag::kFloor));
  EXPECT_TRUE(segments.check({}));
  segments.touch(link, begin, begin + 1);
  const Status status = segments.check({});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::corrupt);
  EXPECT_NE(status.error().message.find("LINK"), std::string::npos);
}

TEST_F(SegmentsTest, AreAllOfTheFile) {
  AmtSegments segments(*file_);
  segments.touchAll();
  EXPECT_FALSE(segments.check({}));
}

TEST_F(SegmentsTest, AreNotCheckedAgain) {
  AmtSegments segments(*file_);
  const auto floor = segments.of(amt_tag::kFloor);
  segments.touchAll(floor);
  EXPECT_TRUE(segments.check({}));
  segments.touchAll(floor);
  EXPECT_TRUE(segments.check({}));
}

TEST_F(SegmentsTest, StopWhenCancelled) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  AmtSegments segments(*file_);
  segments.touchAll();
  EXPECT_EQ(segments.check(context).error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete
