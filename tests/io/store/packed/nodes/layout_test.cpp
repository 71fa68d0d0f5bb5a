// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/nodes/layout.h"

#include <gtest/gtest.h>

#include "datasets/random.h"

namespace arete::packed {
namespace {

Run runOf(std::uint32_t band, std::uint32_t nodes, std::uint32_t slots, std::uint32_t listed) {
  Run run;
  run.band = band;
  run.nodes = nodes;
  run.slots = slots;
  run.listed = listed;
  return run;
}

/// Three packets, the last of which leans on both others.
Directory someDirectory() {
  Directory directory;
  for (std::size_t band = 0; band < directory.bandClass.size(); ++band)
    directory.bandClass[band] = static_cast<std::uint8_t>(band % kClasses);
  directory.packets.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    Packet& packet = directory.packets[i];
    packet.xMin = -1.5 * static_cast<double>(i);
    packet.xMax = 1e300;
    packet.yMax = 0.1;
    packet.segments.resize(1);
    for (std::uint32_t s = 0; s < kParts; ++s)
      packet.segments[0].streamBytes[s] = 100u * static_cast<std::uint32_t>(i) + s;
    packet.segments[0].checksum = 0x0123456789ABCDEF + i;
    if (i > 0) packet.dependsOn.push_back(0);
  }
  directory.packets[2].dependsOn.push_back(1);
  directory.packets[0].runs = {runOf(20, 5, 17, 5), runOf(3, 1, 3, 0)};
  directory.packets[0].borders = 4;
  directory.packets[1].runs = {runOf(20, 2, 66, 1), runOf(0, 10, 45, 10)};
  directory.packets[2].runs = {runOf(3, 7, 21, 2)};
  directory.number();
  return directory;
}

TEST(PackedLayout, ADirectoryReadsBackToTheSameBytes) {
  const Directory directory = someDirectory();
  const auto bytes = toBytes(directory);
  std::string problem;
  const auto back = directoryOf(bytes, problem);
  ASSERT_TRUE(back) << problem;
  EXPECT_EQ(toBytes(*back), bytes);
  EXPECT_EQ(back->bandClass, directory.bandClass);
  EXPECT_EQ(back->packets[2].dependsOn, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(back->packets[1].xMin, -1.5);
  EXPECT_EQ(back->nodes(), 25u);
  EXPECT_EQ(back->slots(), 152u);
  EXPECT_EQ(back->borders(), 4u);
}

TEST(PackedLayout, NumbersGoThroughTheBandsAndThroughThePacketsWithinABand) {
  const Directory directory = someDirectory();
  const auto& packets = directory.packets;
  EXPECT_EQ(packets[0].runs[0].firstNode, 0u);
  EXPECT_EQ(packets[1].runs[0].firstNode, 5u);
  EXPECT_EQ(packets[0].runs[1].firstNode, 7u);
  EXPECT_EQ(packets[2].runs[0].firstNode, 8u);
  EXPECT_EQ(packets[1].runs[1].firstNode, 15u);
  EXPECT_EQ(packets[1].runs[1].firstSlot, 17u + 66 + 3 + 21);
  EXPECT_EQ(packets[1].segments[0].offset, packets[0].bytes());
  EXPECT_EQ(packets[2].firstBorder, 4u);
  EXPECT_EQ(packets[1].nodes, 12u);
}

TEST(PackedLayout, ADirectoryThatIsCutShortOrLongerIsRefused) {
  auto bytes = toBytes(someDirectory());
  std::string problem;
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(directoryOf(std::span(bytes).first(size), problem)) << size;
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(directoryOf(bytes, problem));
}

TEST(PackedLayout, ADirectoryOfAnotherVersionSaysSo) {
  auto bytes = toBytes(someDirectory());
  std::string problem;
  bytes[0] = std::byte{17};
  EXPECT_FALSE(directoryOf(bytes, problem));
  EXPECT_NE(problem.find("older"), std::string::npos);
  bytes[0] = std::byte{19};
  EXPECT_FALSE(directoryOf(bytes, problem));
  EXPECT_NE(problem.find("version 19"), std::string::npos);
}

TEST(PackedLayout, ADirectoryThatContradictsItselfIsRefused) {
  const auto isRefused = [](const auto& change) {
    Directory directory = someDirectory();
    change(directory);
    std::string problem;
    return !directoryOf(toBytes(directory), problem);
  };
  EXPECT_FALSE(isRefused([](Directory&) {}));
  EXPECT_TRUE(isRefused([](Directory& d) { d.bandClass[3] = kClasses; }));
  EXPECT_TRUE(isRefused([](Directory& d) { d.packets[1].dependsOn.push_back(1); }));
  EXPECT_TRUE(isRefused([](Directory& d) { d.packets[0].borders = 21; }));
  EXPECT_TRUE(isRefused([](Directory& d) { d.packets[0].runs[0].slots = 5 * 33 + 1; }));
  EXPECT_TRUE(isRefused([](Directory& d) { d.packets[0].runs[0].listed = 6; }));
  EXPECT_TRUE(isRefused([](Directory& d) { d.packets[0].runs[1].band = 20; }));
  EXPECT_TRUE(isRefused([](Directory& d) { d.packets[0].runs[0].nodes = 0; }));
  EXPECT_TRUE(isRefused([](Directory& d) { d.packets.clear(); }));
}

TEST(PackedLayout, AnyBytesAreReadOrRefused) {
  const auto good = toBytes(someDirectory());
  Random random(8);
  std::string problem;
  for (int i = 0; i < 20'000; ++i) {
    auto bytes = good;
    for (std::uint32_t changes = 1 + random.below(3); changes > 0; --changes)
      bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] = static_cast<std::byte>(random.next());
    if (const auto read = directoryOf(bytes, problem)) {
      EXPECT_LT(read->slots(), std::uint64_t{1} << 32);
      EXPECT_LE(toBytes(*read).size(), bytes.size());
    }
  }
}

TEST(PackedLayout, ASmallFileCannotCallForMuchMemory) {
  EXPECT_EQ(leastBytes(0), 0u);
  EXPECT_EQ(leastBytes(1), 1u);
  EXPECT_EQ(leastBytes(16), 1u);
  EXPECT_EQ(leastBytes(17), 2u);
}

}  // namespace
}  // namespace arete::packed
