// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bytes that writeAmt() writes, parsed by this file's own reading of docs/topics/amt-format.md.
#include <gtest/gtest.h>

#include <filesystem>

#include "datasets/families.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::built;
using test::readAll;
using test::TemporaryFolder;

template <class T>
T numberAt(const std::string& bytes, std::uint64_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

struct Entry {
  std::string tag;
  std::uint64_t offset, bytes, checksum;
};

std::vector<Entry> directoryOf(const std::string& bytes) {
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < numberAt<std::uint32_t>(bytes, 20); ++i) {
    const std::uint64_t at = 64 + 40 * i;
    entries.push_back({bytes.substr(at, 4), numberAt<std::uint64_t>(bytes, at + 16),
                       numberAt<std::uint64_t>(bytes, at + 24), numberAt<std::uint64_t>(bytes, at + 32)});
  }
  return entries;
}

void expectWellFormed(const std::string& bytes) {
  ASSERT_EQ(bytes.substr(0, 8), std::string("\x89"
                                            "AMT\r\n\x1a\n",
                                            8));
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 12), 2u);
  EXPECT_EQ(numberAt<std::uint64_t>(bytes, 24), bytes.size());
  const auto entries = directoryOf(bytes);
  std::string front = bytes.substr(0, 56) + bytes.substr(64, 40 * entries.size());
  EXPECT_EQ(numberAt<std::uint64_t>(bytes, 56), XXH3_64bits(front.data(), front.size()));
  std::uint64_t end = 64 + 40 * entries.size();
  for (const Entry& e : entries) {
    const std::uint64_t begin = (end + 63) / 64 * 64;
    ASSERT_EQ(e.offset, begin) << e.tag;
    for (; end < begin; ++end) ASSERT_EQ(bytes[end], 0);
    EXPECT_EQ(e.checksum, XXH3_64bits(bytes.data() + e.offset, e.bytes)) << e.tag;
    end = e.offset + e.bytes;
  }
  EXPECT_EQ(bytes.size(), (end + 63) / 64 * 64);
}

TEST(Writer, PutsEveryChunkWhereTheFormatSaysWithItsChecksum) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.amt");
  for (const bool isPacked : {false, true}) {
    ASSERT_TRUE(writeAmt(path, test::tinyModel(), {}, {.isPacked = isPacked}));
    expectWellFormed(readAll(path));
    ASSERT_TRUE(writeAmt(path, built(build(pointFamilies()[0].make(500, 1))), {}, {.isPacked = isPacked}));
    expectWellFormed(readAll(path));
  }
}

TEST(Writer, KeepsTheOrderOfTheChunks) {
  const TemporaryFolder folder;
  const auto tagsOf = [&](const TerrainModel& model, bool isPacked) {
    const std::string path = folder.file("a.amt");
    EXPECT_TRUE(writeAmt(path, model, {}, {.isPacked = isPacked}));
    std::string tags;
    for (const Entry& e : directoryOf(readAll(path))) tags += e.tag + " ";
    return tags;
  };
  EXPECT_EQ(
      tagsOf(test::tinyModel(), false),
      "META RTRI SLOT LINK RMVR ERRR BLOW ABOV FLOR SERR SPHR BERR BSPH HINT SAMP HGHT ISAM IHGT FIXV PSUM ");
  EXPECT_EQ(tagsOf(test::tinyModel(), true), "META PDIR PTAB PNOD ISAM IHGT FIXV ");
}

TEST(Writer, StatesTheChecksumOfEverySegment) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.amt");
  ASSERT_TRUE(writeAmt(path, built(build(test::hills(200, 150, [](double z) { return z; })))));
  const std::string bytes = readAll(path);
  const auto entries = directoryOf(bytes);
  ASSERT_EQ(entries.back().tag, "PSUM");
  std::uint64_t at = entries.back().offset;
  for (const Entry& e : entries) {
    if (e.tag == "META" || e.tag == "PSUM") continue;
    for (std::uint64_t begin = 0; begin < e.bytes; begin += 65536, at += 8)
      ASSERT_EQ(
          numberAt<std::uint64_t>(bytes, at),
          XXH3_64bits(bytes.data() + e.offset + begin, std::min<std::uint64_t>(65536, e.bytes - begin)));
  }
  EXPECT_EQ(at, entries.back().offset + entries.back().bytes);
}

TEST(Writer, NamesItsProgramOnlyInTheMetadata) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeAmt(folder.file("a.amt"), test::tinyModel(), {}, {.writer = "A"}));
  ASSERT_TRUE(writeAmt(folder.file("b.amt"), test::tinyModel(), {}, {.writer = "B"}));
  EXPECT_EQ(openAmt(folder.file("a.amt"))->writer(), "A");
  const std::string a = readAll(folder.file("a.amt")), b = readAll(folder.file("b.amt"));
  ASSERT_EQ(a.size(), b.size());
  const std::uint64_t behind = directoryOf(a)[0].offset + directoryOf(a)[0].bytes;
  EXPECT_EQ(a.substr(behind), b.substr(behind));
}

TEST(Writer, RefusesAModelThatIsNotOfItsGridAndWritesNothing) {
  const TemporaryFolder folder;
  TerrainModel model = test::tinyModel();
  model.columns = 4;
  const Status written = writeAmt(folder.file("a.amt"), model);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::invalidData);
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace arete
