// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/pages/page_header.h"

#include <gtest/gtest.h>

#include <random>

namespace arete::packed {
namespace {

Run runOfBand(std::uint32_t band, std::uint32_t nodes) {
  Run run;
  run.band = band;
  run.nodes = nodes;
  run.slots = 4 * nodes;
  run.listed = nodes / 2;
  run.spread = static_cast<std::uint8_t>(band);
  return run;
}

/// A page of two segments, and its bytes: headers with streams of zeros.
struct HeadedPage {
  Packet page;
  std::vector<std::byte> bytes;

  HeadedPage() {
    const std::vector<std::vector<Run>> runs = {{runOfBand(25, 10), runOfBand(19, 7)}, {runOfBand(18, 90)}};
    for (const auto& of : runs) {
      Segment segment;
      segment.runs = static_cast<std::uint32_t>(of.size());
      segment.firstBand = of[0].band;
      for (const Run& run : of) segment.nodes += run.nodes;
      segment.streamBytes = {8, 12, 0, 0, 4, 9, 1};
      const auto header = segmentHeader(segment, of, false);
      segment.headerBytes = static_cast<std::uint32_t>(header.size());
      bytes.insert(bytes.end(), header.begin(), header.end());
      segment.offset = bytes.size();
      bytes.resize(bytes.size() + segment.bytes() - header.size());
      // As the directory has it: all bytes are of the header.
      segment.headerBytes = static_cast<std::uint32_t>(segment.bytes());
      segment.offset = bytes.size();
      segment.streamBytes = {};
      segment.runs = 0;
      page.segments.push_back(segment);
    }
  }
};

TEST(PageHeader, ReadsBackRunsAndStreams) {
  HeadedPage headed;
  ASSERT_TRUE(readHeaders(headed.bytes, false, headed.page));
  const auto& runs = headed.page.runs;
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[1].band, 19u);
  EXPECT_EQ(runs[2].band, 18u);
  EXPECT_EQ(runs[2].nodes, 90u);
  EXPECT_EQ(runs[2].slots, 360u);
  EXPECT_EQ(runs[0].spread, 25u);
  EXPECT_EQ(headed.page.segments[0].streamBytes[1], 12u);
  EXPECT_EQ(headed.page.segments[1].begin(), headed.page.segments[0].offset + 34);
}

TEST(PageHeader, RefusesWhatTheDirectoryDoesNotState) {
  const HeadedPage good;
  const auto isRead = [&](const auto& change) {
    HeadedPage page = good;
    change(page);
    return readHeaders(page.bytes, false, page.page);
  };
  EXPECT_TRUE(isRead([](HeadedPage&) {}));
  EXPECT_FALSE(isRead([](HeadedPage& p) { ++p.page.segments[0].nodes; }));
  EXPECT_FALSE(isRead([](HeadedPage& p) { p.page.segments[1].firstBand = 19; }));
  EXPECT_FALSE(isRead([](HeadedPage& p) { p.bytes[0] = std::byte{200}; }));
  std::mt19937 random(4);
  for (std::size_t at = 0; at < good.bytes.size(); ++at)
    isRead([&](HeadedPage& p) { p.bytes[at] ^= std::byte(1u << random() % 8); });
}

}  // namespace
}  // namespace arete::packed
