// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/ranges/span_cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace arete {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

class SpanCacheFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("arete_span_cache_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::shared_ptr<SpanCache> opened(std::uint64_t budget = 10'000'000) const {
    auto cache = SpanCache::open(folder_, budget);
    EXPECT_TRUE(cache) << (cache ? "" : cache.error().describe());
    return *cache;
  }
  static Bytes someBytes(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    Bytes bytes(count);
    for (std::byte& byte : bytes) byte = std::byte(random() & 255);
    return bytes;
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_)) found.push_back(entry.path());
    return found;
  }
  std::uint64_t bytesThere() const {
    std::uint64_t sum = 0;
    for (const fs::path& file : files()) sum += fs::file_size(file);
    return sum;
  }

  fs::path folder_;
  CacheKey key_ = CacheKey::of("https://host/a.amt", "\"one\" ", 1'000'000);
};

TEST_F(SpanCacheFolder, GivesBackTheBlocksThatWereKeptAndNoOthers) {
  const Bytes span = someBytes(SpanCache::kSpan, 1);
  opened()->write(key_, 3, span, 0b101);
  opened()->write(key_, 3, span, 0b1000000000000010);  // another process adds to them
  Bytes got(span.size(), std::byte{7});
  EXPECT_EQ(opened()->read(key_, 3, got), 0b1000000000000111);
  for (std::size_t i = 0; i < span.size(); ++i) {
    const std::size_t block = i / SpanCache::kBlock;
    const bool isKept = block < 3 || block == 15;
    ASSERT_EQ(got[i], isKept ? span[i] : std::byte{7}) << i;
  }
  EXPECT_EQ(opened()->read(key_, 2, got), 0);
}

TEST_F(SpanCacheFolder, KeepsTheShortSpanAtTheEndOfAFile) {
  const Bytes span = someBytes(SpanCache::kBlock + 5, 2);
  opened()->write(key_, 0, span, 0b10);
  Bytes got(span.size());
  EXPECT_EQ(opened()->read(key_, 0, got), 0b10);
  EXPECT_TRUE(std::equal(got.begin() + SpanCache::kBlock, got.end(), span.begin() + SpanCache::kBlock));
  Bytes longer(span.size() + 1);
  EXPECT_EQ(opened()->read(key_, 0, longer), 0) << "a file of another length";
}

TEST_F(SpanCacheFolder, OfAnotherVersionAddressOrLengthHasNothing) {
  const Bytes span = someBytes(SpanCache::kSpan, 1);
  opened()->write(key_, 0, span, 0xffff);
  Bytes got(span.size());
  for (const CacheKey& other : {CacheKey::of("https://host/a.amt", "\"two\" ", 1'000'000),
                                CacheKey::of("https://host/b.amt", "\"one\" ", 1'000'000),
                                CacheKey::of("https://host/a.amt?key=5", "\"one\" ", 1'000'000),
                                CacheKey::of("https://host/a.amt", "\"one\" ", 1'000'001)})
    EXPECT_EQ(opened()->read(other, 0, got), 0);
  EXPECT_EQ(opened()->read(key_, 0, got), 0xffff);
  // A file under the name of another key is not taken for it.
  const CacheKey other = CacheKey::of("https://host/b.amt", "\"one\" ", 1'000'000);
  opened()->write(other, 0, span, 1);
  const auto all = files();
  ASSERT_EQ(all.size(), 2u);
  for (const auto& [from, to] : {std::pair(all[0], all[1])})
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  const int sound = int(opened()->read(key_, 0, got) != 0) + int(opened()->read(other, 0, got) != 0);
  EXPECT_EQ(sound, 1);
}

TEST_F(SpanCacheFolder, DoesNotTrustAFileThatIsDamagedOrCutShort) {
  const Bytes span = someBytes(SpanCache::kSpan, 1);
  const auto cache = opened();
  for (unsigned seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    cache->write(key_, 0, span, 0b11);
    const auto all = files();
    ASSERT_EQ(all.size(), 1u);
    const std::uint64_t size = fs::file_size(all[0]);
    if (seed % 3 == 0) {
      fs::resize_file(all[0], seed % 2 == 0 ? random() % size : size + 1 + random() % 100);
    } else {
      std::fstream file(all[0], std::ios::in | std::ios::out | std::ios::binary);
      const auto at = static_cast<std::streamoff>(seed % 3 == 1 ? random() % 48 : random() % size);
      file.seekg(at);
      const char old = static_cast<char>(file.get());
      file.seekp(at);
      file.put(static_cast<char>(old ^ (1 << random() % 8)));
    }
    Bytes got(span.size(), std::byte{7});
    ASSERT_EQ(cache->read(key_, 0, got), 0) << "seed " << seed;
    ASSERT_TRUE(std::ranges::all_of(got, [](std::byte b) { return b == std::byte{7}; })) << "seed " << seed;
  }
  cache->write(key_, 0, span, 0b1);
  Bytes got(span.size());
  EXPECT_EQ(cache->read(key_, 0, got), 0b1) << "what is damaged is replaced";
}

TEST_F(SpanCacheFolder, RemovesWhatWasUsedLongestAgoAndNoOtherFile) {
  constexpr std::uint64_t kBudget = 2'000'000;
  const Bytes span = someBytes(SpanCache::kSpan, 1);
  const auto cache = opened(kBudget);
  std::ofstream(folder_ / "mine.txt") << "mine";
  std::ofstream(folder_ / "mine.span") << "mine";
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(5);
  cache->write(key_, 0, span, 0xffff);
  cache->write(key_, 1, span, 0xffff);
  for (const fs::path& file : files()) fs::last_write_time(file, old);
  Bytes got(span.size());
  EXPECT_NE(cache->read(key_, 0, got), 0) << "used now";
  for (std::uint64_t s = 2; s < 8; ++s) {
    cache->write(key_, s, span, 0xffff);
    EXPECT_LE(bytesThere(), kBudget + 100);
  }
  EXPECT_NE(cache->read(key_, 0, got), 0);
  EXPECT_EQ(cache->read(key_, 1, got), 0) << "it was used longest ago";
  EXPECT_TRUE(fs::exists(folder_ / "mine.txt") && fs::exists(folder_ / "mine.span"));
}

TEST_F(SpanCacheFolder, IsSharedBySeveralThatWriteAtOnce) {
  const Bytes span = someBytes(SpanCache::kSpan, 1);
  std::vector<std::thread> threads;
  std::atomic<bool> isWrong = false;
  for (unsigned t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      const auto cache = opened(1'500'000);
      std::mt19937 random(t);
      Bytes got(span.size());
      for (int i = 0; i < 60; ++i) {
        const std::uint64_t s = random() % 8;
        cache->write(key_, s, span, static_cast<SpanCache::Blocks>(1 << random() % 16));
        const unsigned blocks = cache->read(key_, s, got);
        for (std::size_t b = 0; b < 16; ++b)
          if ((blocks >> b & 1) != 0 && !std::equal(got.begin() + std::ptrdiff_t(b * SpanCache::kBlock),
                                                    got.begin() + std::ptrdiff_t((b + 1) * SpanCache::kBlock),
                                                    span.begin() + std::ptrdiff_t(b * SpanCache::kBlock)))
            isWrong = true;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_FALSE(isWrong);
}

TEST_F(SpanCacheFolder, ThatCannotBeWrittenToIsAnError) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "file") << "x";
  const auto cache = SpanCache::open(folder_ / "file" / "below", 1'000'000);
  ASSERT_FALSE(cache);
  EXPECT_EQ(cache.error().code, ErrorCode::unreadable);
  EXPECT_EQ(cache.error().culprit, (folder_ / "file" / "below").string());
}

}  // namespace
}  // namespace arete
