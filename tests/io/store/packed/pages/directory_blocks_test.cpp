// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/pages/directory_blocks.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "io/store/packed/pages/page_choice.h"
#include "io/store/packed/pages/page_header.h"

namespace arete::packed {
namespace {

/// Pages of one or two segments in a row, each of which depends on the first one and on the one before it.
Directory pagesInARow(std::uint32_t count) {
  Directory directory;
  for (std::size_t band = 0; band < directory.bandClass.size(); ++band)
    directory.bandClass[band] = static_cast<std::uint8_t>(band % kClasses);
  for (std::uint32_t i = 0; i < count; ++i) {
    Packet page;
    if (i > 0) page.dependsOn.push_back(0);
    if (i > 1) page.dependsOn.push_back(i - 1);
    page.xMin = 3.1 * i;
    page.xMax = 3.1 * i + 4;
    page.yMin = -1e7 / 3;
    page.yMax = -1e7 / 3 + 0.01;
    page.zMax = i % 7;
    page.borders = i % 5;
    for (const std::uint32_t band : {20u - i % 3, 4u}) {
      Run run;
      run.band = band;
      run.nodes = 20 + i % 9;
      run.slots = 3 * run.nodes + 5;
      run.listed = 2;
      run.spread = 17;
      page.runs.push_back(run);
      Segment segment;
      segment.runs = 1;
      segment.firstBand = band;
      segment.nodes = run.nodes;
      segment.streamBytes = {10, 20, 0, 0, 3, 0, 1 + i % 4};
      segment.checksum = 0x1234567890abcdef + i;
      segment.headerBytes =
          static_cast<std::uint32_t>(segmentHeader(segment, std::span(&page.runs.back(), 1), false).size());
      page.segments.push_back(segment);
    }
    directory.packets.push_back(std::move(page));
  }
  directory.number();
  return directory;
}

TEST(DirectoryBlocks, ReadBackWithBoxesThatHoldThoseOfThePages) {
  const Directory directory = pagesInARow(300);
  const PageDirectoryBytes bytes = pageDirectoryBytes(directory);
  std::string problem;
  const auto root = pageRootOf(bytes.root, problem);
  ASSERT_TRUE(root) << problem;
  EXPECT_EQ(root->pages, 300u);
  EXPECT_EQ(root->nodes(), directory.nodes());
  EXPECT_EQ(root->slots, directory.slots());
  EXPECT_EQ(root->bandClass, directory.bandClass);
  ASSERT_EQ(root->levels, 1u);
  ASSERT_EQ(root->entries.size(), 3u);
  std::uint32_t i = 0;
  for (const BlockEntry& entry : root->entries) {
    EXPECT_EQ(entry.highestBand, 20u);
    const auto pages = pagesOf(std::span(bytes.blocks).subspan(entry.offset, entry.bytes), entry, i);
    ASSERT_TRUE(pages);
    for (const Packet& page : *pages) {
      const Packet& was = directory.packets[i];
      EXPECT_EQ(page.number, i++);
      EXPECT_EQ(page.dependsOn, was.dependsOn);
      EXPECT_EQ(page.borders, was.borders);
      EXPECT_LE(page.xMin, was.xMin);
      EXPECT_GE(page.xMax, was.xMax);
      EXPECT_LE(page.yMin, was.yMin);
      EXPECT_GE(page.yMax, was.yMax);
      EXPECT_LE(page.zMin, was.zMin);
      EXPECT_GE(page.zMax, was.zMax);
      EXPECT_NEAR(page.xMin, was.xMin, 0.02);
      ASSERT_EQ(page.segments.size(), was.segments.size());
      for (std::size_t s = 0; s < was.segments.size(); ++s) {
        EXPECT_EQ(page.segments[s].begin(), was.segments[s].begin());
        EXPECT_EQ(page.segments[s].bytes(), was.segments[s].bytes());
        EXPECT_EQ(page.segments[s].checksum, was.segments[s].checksum);
        EXPECT_EQ(page.segments[s].firstBand, was.segments[s].firstBand);
      }
    }
  }
}

TEST(DirectoryBlocks, HaveARootOfAFewKilobytesWhateverTheNumberOfPages) {
  for (const std::uint32_t count : {1u, 128u, 129u, 128u * 128, 128u * 128 + 1, 40'000u}) {
    const PageDirectoryBytes bytes = pageDirectoryBytes(pagesInARow(count));
    EXPECT_LT(bytes.root.size(), 6000u) << count;
    std::string problem;
    const auto root = pageRootOf(bytes.root, problem);
    ASSERT_TRUE(root) << problem;
    EXPECT_EQ(root->levels, count <= 128u * 128 ? 1u : 2u) << count;
  }
}

TEST(DirectoryBlocks, ReadOnlyTheBlocksThatAChoiceNeedsAndWhatItsPagesDependOn) {
  const Directory directory = pagesInARow(40'000);
  const PageDirectoryBytes bytes = pageDirectoryBytes(directory);
  std::string problem;
  const auto root = pageRootOf(bytes.root, problem);
  ASSERT_TRUE(root);
  std::size_t loaded = 0;
  const LoadParts load = [&](std::span<const std::span<const std::byte>> parts) {
    for (const auto part : parts) loaded += part.size();
    return Status();
  };
  // Pages of the row depend on all before them, so the first ones take little.
  const auto choice = choosePages(
      *root, bytes.blocks,
      [](const Box3& box) { return box.low.x < 310 ? 0 : std::numeric_limits<double>::infinity(); },
      OutwardScale(40.0), load);
  ASSERT_TRUE(choice) << choice.error().message;
  EXPECT_GE(choice->directory.packets.size(), 100u);
  EXPECT_LE(choice->directory.packets.size(), 105u);
  EXPECT_FALSE(choice->isEvenly);
  EXPECT_LT(loaded, bytes.blocks.size() / 20);
  // One far behind takes all.
  const auto far = choosePages(
      *root, bytes.blocks,
      [](const Box3& box) { return box.high.x > 120'000 ? 0 : std::numeric_limits<double>::infinity(); },
      OutwardScale(40.0), load);
  ASSERT_TRUE(far);
  EXPECT_EQ(far->directory.packets.size(), 40'000u);
}

TEST(DirectoryBlocks, AreRefusedWhereABitIsFlipped) {
  const Directory directory = pagesInARow(200);
  const PageDirectoryBytes bytes = pageDirectoryBytes(directory);
  std::mt19937 random(5);
  std::string problem;
  for (int i = 0; i < 300; ++i) {
    PageDirectoryBytes changed = bytes;
    const std::size_t at = random() % changed.blocks.size();
    changed.blocks[at] ^= std::byte(1u << random() % 8);
    const auto root = pageRootOf(changed.root, problem);
    ASSERT_TRUE(root);
    const auto choice = choosePages(*root, changed.blocks, {}, OutwardScale(40.0), {});
    ASSERT_FALSE(choice);
    EXPECT_NE(choice.error().message.find("block "), std::string::npos) << choice.error().message;
  }
  // A root with a wrong number is refused or names blocks that do not fit.
  for (std::size_t at = 0; at < bytes.root.size(); ++at) {
    PageDirectoryBytes changed = bytes;
    changed.root[at] ^= std::byte(1u << random() % 8);
    if (const auto root = pageRootOf(changed.root, problem))
      static_cast<void>(choosePages(*root, changed.blocks, {}, OutwardScale(40.0), {}));
  }
}

}  // namespace
}  // namespace arete::packed
