// SPDX-License-Identifier: GPL-3.0-or-later
//
// The coder against the definition of rANS [Duda2013]: streams decode to the symbols that were encoded, take
// about as many bits as the tables' entropy, and show where they are cut short or damaged.
#include "io/store/entropy/rans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "datasets/random.h"

namespace arete {
namespace {

using Counts = std::array<std::uint64_t, RansTable::kAlphabet>;

std::uint32_t sharesOf(const RansTable& table) {
  std::uint32_t sum = 0;
  for (unsigned s = 0; s < RansTable::kAlphabet; ++s) sum += table.share(s);
  return sum;
}

/// Symbols of several tables, some rare, and the tables made of them.
struct Source {
  std::vector<RansSymbol> symbols;
  std::vector<RansTable> tables;

  Source(std::size_t size, std::uint64_t seed) {
    Random random(seed);
    std::vector<Counts> counts(3, Counts{});
    for (std::size_t i = 0; i < size; ++i) {
      const auto table = static_cast<std::uint8_t>(random.below(3));
      const double skewed = std::pow(random.unit(), 1 + 3 * table);
      const auto symbol = static_cast<std::uint8_t>(skewed * (table == 2 ? 256 : 20));
      symbols.push_back({table, symbol});
      ++counts[table][symbol];
    }
    for (const Counts& c : counts) tables.push_back(RansTable::ofCounts(c));
  }
};

std::vector<std::vector<std::uint32_t>> entriesOf(const std::vector<RansTable>& tables) {
  std::vector<std::vector<std::uint32_t>> entries;
  for (const RansTable& table : tables) table.writeEntries(entries.emplace_back(RansTable::kEntries).data());
  return entries;
}

/// A decoder must be able to read some bytes behind its stream.
std::vector<std::byte> padded(std::vector<std::byte> bytes) {
  bytes.resize(bytes.size() + RansDecoder::kReadable);
  return bytes;
}

TEST(Rans, TablesGiveEverySymbolThatOccursAShareOf1024) {
  Counts counts{};
  counts[0] = 1;
  counts[7] = 1'000'000'000;
  counts[255] = 3;
  const RansTable table = RansTable::ofCounts(counts);
  EXPECT_EQ(sharesOf(table), 1024u);
  EXPECT_EQ(table.share(0), 1u);
  EXPECT_EQ(table.share(7), 1022u);
  EXPECT_EQ(table.share(255), 1u);
  EXPECT_EQ(table.share(1), 0u);
  EXPECT_EQ(table.begin(7), 1u);
  EXPECT_EQ(table.begin(255), 1023u);
  EXPECT_TRUE(RansTable::ofCounts(Counts{}).isEmpty());
  counts.fill(12345);
  EXPECT_EQ(sharesOf(RansTable::ofCounts(counts)), 1024u);
}

TEST(Rans, TablesAreOfSharesThatSumTo1024) {
  std::array<std::uint16_t, RansTable::kAlphabet> shares{};
  EXPECT_FALSE(RansTable::ofShares(shares));
  shares[3] = 1024;
  ASSERT_TRUE(RansTable::ofShares(shares));
  shares[4] = 1;
  EXPECT_FALSE(RansTable::ofShares(shares));
  shares[3] = 1023;
  ASSERT_TRUE(RansTable::ofShares(shares));
  EXPECT_EQ(RansTable::ofShares(shares)->begin(4), 1023u);
}

TEST(Rans, DecodesWhatWasEncodedAndEndsThere) {
  for (const std::size_t size : {0u, 1u, 2u, 3u, 10u, 1000u, 50000u})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(::testing::Message() << size << " symbols, seed " << seed);
      const Source source(size, seed);
      const auto bytes = ransEncode(source.symbols, source.tables);
      EXPECT_EQ(bytes.size() % 4, 0u);
      const auto stream = padded(bytes);
      const auto entries = entriesOf(source.tables);
      RansDecoder decoder(stream.data(), bytes.size());
      for (const RansSymbol s : source.symbols) ASSERT_EQ(decoder.decode(entries[s.table].data()), s.symbol);
      EXPECT_TRUE(decoder.isAtEnd());
    }
}

TEST(Rans, TakesHardlyMoreBitsThanTheSharesSay) {
  const Source source(200'000, 5);
  double bits = 0;
  for (const RansSymbol s : source.symbols) bits += 10 - std::log2(source.tables[s.table].share(s.symbol));
  const auto bytes = ransEncode(source.symbols, source.tables);
  EXPECT_GE(8.0 * static_cast<double>(bytes.size()) + 1, bits);
  EXPECT_LE(8.0 * static_cast<double>(bytes.size()), bits * 1.0001 + 64);
}

TEST(Rans, ASymbolWithAllSharesTakesNoBits) {
  Counts counts{};
  counts[9] = 4;
  const std::vector<RansTable> tables{RansTable::ofCounts(counts)};
  const std::vector<RansSymbol> symbols(100'000, RansSymbol{0, 9});
  EXPECT_EQ(ransEncode(symbols, tables).size(), 8u);
}

TEST(Rans, SeesWhereAStreamIsCutShortOrHasMoreSymbolsThanAreRead) {
  const Source source(2000, 6);
  const auto bytes = ransEncode(source.symbols, source.tables);
  const auto stream = padded(bytes);
  const auto entries = entriesOf(source.tables);
  const auto decodes = [&](std::size_t size, std::size_t symbols) {
    RansDecoder decoder(stream.data(), size);
    for (std::size_t i = 0; i < symbols; ++i)
      static_cast<void>(decoder.decode(entries[source.symbols[i].table].data()));
    return decoder.isAtEnd();
  };
  EXPECT_TRUE(decodes(bytes.size(), source.symbols.size()));
  EXPECT_FALSE(decodes(bytes.size(), source.symbols.size() - 1));
  EXPECT_FALSE(decodes(bytes.size() - 4, source.symbols.size()));
  EXPECT_FALSE(decodes(0, source.symbols.size()));
}

TEST(Rans, AnEmptyTableDecodesToSomethingAndDoesNotEnd) {
  const std::vector<RansTable> tables(1);
  const auto entries = entriesOf(tables);
  const std::vector<std::byte> stream(64, std::byte{0x5a});
  RansDecoder decoder(stream.data(), 32);
  for (int i = 0; i < 1000; ++i) EXPECT_LT(decoder.decode(entries[0].data()), 256u);
  EXPECT_FALSE(decoder.isAtEnd());
}

TEST(Bits, ReadBackWhatWasWrittenAndZerosBeyondTheEnd) {
  Random random(3);
  std::vector<std::pair<std::uint64_t, int>> values;
  BitWriter writer;
  for (int i = 0; i < 5000; ++i) {
    const int count = static_cast<int>(random.below(65));
    const std::uint64_t value = count == 0 ? 0 : random.next() >> (64 - count);
    values.emplace_back(value, count);
    writer.write(value, count);
  }
  const std::vector<std::byte> bytes = writer.take();
  BitReader reader(bytes);
  for (const auto& [value, count] : values) ASSERT_EQ(reader.read(count), value);
  EXPECT_FALSE(reader.isOver());
  for (int i = 0; i < 10; ++i) static_cast<void>(reader.read(8));
  EXPECT_EQ(reader.read(64), 0u);
  EXPECT_TRUE(reader.isOver());
}

TEST(Bits, GoFromTheLowestBitOfTheLowestByte) {
  BitWriter writer;
  writer.write(1, 1);
  writer.write(0b10, 2);
  writer.write(0xFF, 8);
  EXPECT_EQ(writer.take(), (std::vector<std::byte>{std::byte{0b11111101}, std::byte{0b111}}));
  EXPECT_TRUE(writer.take().empty());
}

TEST(RansTables, ReadBackToTheSameBytes) {
  Random random(5);
  std::vector<RansTable> tables(100);
  for (RansTable& table : tables) {
    if (random.below(4) == 0) continue;
    std::array<std::uint64_t, RansTable::kAlphabet> counts{};
    for (std::uint32_t i = random.below(300); i > 0; --i) ++counts[random.below(256)];
    table = RansTable::ofCounts(counts);
  }
  const auto bytes = toBytes(tables);
  const auto back = tablesOf(bytes, tables.size());
  ASSERT_TRUE(back);
  EXPECT_EQ(toBytes(*back), bytes);
  for (std::size_t t = 0; t < tables.size(); ++t)
    for (unsigned s = 0; s < 256; ++s) ASSERT_EQ((*back)[t].share(s), tables[t].share(s));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(tablesOf(std::span(bytes).first(size), tables.size()));
}

}  // namespace
}  // namespace arete
