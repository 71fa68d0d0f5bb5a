// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a server may answer, given by a client that sends nothing: no test here waits or opens a connection.
#include "io/files/ranges/ranged_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <utility>

namespace arete {
namespace {

namespace fs = std::filesystem;
using FileBytes = std::vector<std::byte>;

FileBytes nonzeroBytes(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  FileBytes bytes(count);
  for (std::byte& byte : bytes) byte = std::byte(1 + random() % 255);
  return bytes;
}

/// A server without faults; `spoil` changes what it answers to a request, counted from 1.
class SpoiledServer final : public HttpClient {
 public:
  using Spoil = std::function<void(HttpReply& reply, int number)>;

  explicit SpoiledServer(FileBytes file, Spoil spoil = {})
      : file(std::move(file)), spoil_(std::move(spoil)) {}

  HttpReply get(std::uint64_t first, std::uint64_t last) override {
    HttpReply reply;
    asked.push_back({first, last + 1});
    if (first >= file.size()) {
      reply.status = 416;
      reply.problem = "the server answers 416";
    } else {
      const std::uint64_t end = std::min<std::uint64_t>(last + 1, file.size());
      reply.bytes.assign(file.begin() + std::ptrdiff_t(first), file.begin() + std::ptrdiff_t(end));
      reply.range = fmt::format("bytes {}-{}/{}", first, end - 1, file.size());
      reply.length = std::to_string(end - first);
      reply.tag = tag;
      sent += reply.bytes.size();
    }
    if (spoil_) spoil_(reply, int(asked.size()));
    return reply;
  }
  void cancelBy(const std::atomic<bool>* cancel) override { cancel_ = cancel; }
  bool wait(double seconds) override {
    waits.push_back(seconds);
    return !isCancelled();
  }
  bool isCancelled() const override { return cancel_ != nullptr && *cancel_; }

  FileBytes file;
  std::string tag = "\"one\"";
  std::vector<ByteRange> asked;
  std::vector<double> waits;
  std::uint64_t sent = 0;

 private:
  Spoil spoil_;
  const std::atomic<bool>* cancel_ = nullptr;
};

Result<std::shared_ptr<const RangedFile>> openedFrom(const std::shared_ptr<SpoiledServer>& server,
                                                     WebSettings settings = {}, int retries = 0) {
  return RangedFile::open({"http://host/a", "host", "http://host/a", server, {retries, 0.25}}, settings);
}

std::string sentenceOf(const RangedFile& file) {
  const auto problem = file.problem();
  return problem ? problem->describe() : "";
}

TEST(RangedFile, HasTheBytesOfThePartsThatWereLoaded) {
  constexpr unsigned kSeed = 5;
  for (const std::size_t size : {1, 1000, 16383, 16384, 16385, 65535, 65536, 65537, 3000000}) {
    const auto server = std::make_shared<SpoiledServer>(nonzeroBytes(size, kSeed));
    const auto file = openedFrom(server);
    ASSERT_TRUE(file) << file.error().describe();
    ASSERT_EQ((*file)->bytes().size(), size);
    std::mt19937 random(kSeed);
    for (int i = 0; i < 40; ++i) {
      std::vector<FileImage::Part> parts;
      for (int k = 0; k < 3; ++k) {
        const std::size_t begin = random() % size,
                          count = random() % (std::min<std::size_t>(size - begin, 50000) + 1);
        parts.push_back((*file)->bytes().subspan(begin, count));
      }
      ASSERT_TRUE((*file)->loadParts(parts)) << sentenceOf(**file);
      for (const FileImage::Part part : parts)
        ASSERT_TRUE(std::ranges::equal(
            part,
            std::span(server->file).subspan(std::size_t(part.data() - (*file)->bytes().data()), part.size())))
            << size << " bytes, seed " << kSeed;
    }
  }
}

TEST(RangedFile, FetchesNoBlockTwiceAndFarLessThanTheWhole) {
  const auto server = std::make_shared<SpoiledServer>(nonzeroBytes(5'000'000, 1));
  const auto file = openedFrom(server);
  ASSERT_TRUE(file);
  EXPECT_EQ(server->asked.size(), 1u);
  EXPECT_EQ(server->sent, 65536u) << "the first request";
  const auto all = (*file)->bytes();
  const FileImage::Part parts[] = {all.subspan(2'000'000, 10), all.subspan(2'050'000, 10),
                                   all.subspan(4'900'000, 10)};
  ASSERT_TRUE((*file)->loadParts(parts));
  EXPECT_EQ(server->asked.size(), 3u) << "two near parts are one request";
  EXPECT_LE(server->sent, 65536u + 16384u * 6);
  EXPECT_EQ(all[3'000'000], std::byte{0}) << "it is nonzero in the file and was not asked for";
  ASSERT_TRUE((*file)->loadParts(parts));
  ASSERT_TRUE((*file)->load(all.subspan(0, 16384)));
  EXPECT_EQ(server->asked.size(), 3u);
}

TEST(RangedFile, RefusesEveryAnswerThatIsNotWhatWasAskedForAndAsksNothingMore) {
  using Spoil = void (*)(HttpReply&);
  const std::pair<const char*, Spoil> lies[] = {
      {"the server sent", [](HttpReply& r) { r.bytes.pop_back(); }},
      {"the server sent", [](HttpReply& r) { r.bytes.push_back({}); }},
      {"the server sent", [](HttpReply& r) { r.range.replace(0, 7, "bytes 7"); }},
      {"does not say how long", [](HttpReply& r) { r.range = "bytes 0-9/*"; }},
      {"does not say how long", [](HttpReply& r) { r.range = "none"; }},
      {"as gzip, which was not asked for", [](HttpReply& r) { r.encoding = "gzip"; }},
      {"replaced while it was read", [](HttpReply& r) { r.tag = "\"two\""; }},
      {"replaced while it was read", [](HttpReply& r) { r.date = "today"; }},
      {"replaced while it was read", [](HttpReply& r) { r.range.back() = '1'; }},
      {"replaced while it was read",
       [](HttpReply& r) {
         r = {};
         r.status = 416;
         r.problem = "the server answers 416";
       }},
      {"the server answers 404",
       [](HttpReply& r) {
         r = {};
         r.status = 404;
         r.problem = "the server answers 404";
       }},
      {"the whole file instead of a part", [](HttpReply& r) {
         r.range.clear();
         r.bytes.resize(3000000);
         r.length = "3000000";
       }}};
  for (const auto& [sentence, spoil] : lies) {
    const auto server = std::make_shared<SpoiledServer>(nonzeroBytes(3000000, 2),
                                                        [spoil = spoil](HttpReply& reply, int number) {
                                                          if (number > 1) spoil(reply);
                                                        });
    const auto file = openedFrom(server);
    ASSERT_TRUE(file);
    const auto part = (*file)->bytes().subspan(2000000, 100);
    EXPECT_FALSE((*file)->load(part)) << sentence;
    EXPECT_NE(sentenceOf(**file).find(sentence), std::string::npos) << sentenceOf(**file);
    EXPECT_EQ((*file)->problem()->culprit, "http://host/a");
    EXPECT_TRUE(std::ranges::all_of(part, [](std::byte b) { return b == std::byte{0}; })) << sentence;
    const std::size_t requests = server->asked.size();
    EXPECT_FALSE((*file)->load(part));
    EXPECT_FALSE((*file)->load((*file)->bytes().subspan(1000000, 100)));
    EXPECT_EQ(server->asked.size(), requests);
    EXPECT_NE(sentenceOf(**file).find(sentence), std::string::npos);
  }
}

TEST(RangedFile, CannotBeOpenedWhereTheFirstAnswerIsAnError) {
  const auto errorOf = [](const SpoiledServer::Spoil& spoil, std::size_t size = 100) {
    return openedFrom(std::make_shared<SpoiledServer>(nonzeroBytes(size, 3), spoil)).error();
  };
  for (const auto& [status, code] : {std::pair{404, ErrorCode::notFound},
                                     {410, ErrorCode::notFound},
                                     {401, ErrorCode::unreadable},
                                     {403, ErrorCode::unreadable},
                                     {503, ErrorCode::unreadable}}) {
    const Error error = errorOf([status = status](HttpReply& reply, int) {
      reply = {};
      reply.status = status;
      reply.problem = fmt::format("the server answers {}", status);
    });
    EXPECT_EQ(error.code, code);
    EXPECT_NE(error.describe().find(std::to_string(status)), std::string::npos) << error.describe();
    EXPECT_NE(error.message.find("host"), std::string::npos);
  }
  EXPECT_EQ(openedFrom(std::make_shared<SpoiledServer>(FileBytes())).error().message, "is empty");
  const Error part = errorOf([](HttpReply& reply, int) { reply.range.clear(); }, 3000000);
  EXPECT_NE(part.message.find("a part of the file"), std::string::npos) << part.message;
  const Error length = errorOf([](HttpReply& reply, int) { reply.range = "bytes 0-99/9223372036854775807"; });
  EXPECT_EQ(length.code, ErrorCode::unreadable) << length.describe();
  const Error vast =
      errorOf([](HttpReply& reply, int) { reply.range = "bytes 0-65535/9223372036854775807"; }, 70000);
  EXPECT_EQ(vast.code, ErrorCode::outOfMemory) << vast.describe();
}

TEST(RangedFile, OfAServerWithoutRangesIsReadOnce) {
  const auto server = std::make_shared<SpoiledServer>(nonzeroBytes(1000, 1),
                                                      [](HttpReply& reply, int) { reply.range.clear(); });
  const auto file = openedFrom(server);
  ASSERT_TRUE(file);
  ASSERT_TRUE((*file)->load((*file)->bytes()));
  EXPECT_TRUE(std::ranges::equal((*file)->bytes(), server->file));
  EXPECT_EQ(server->asked.size(), 1u);
}

TEST(RangedFile, AsksAgainForWhatFailedAlone) {
  const auto server =
      std::make_shared<SpoiledServer>(nonzeroBytes(3'000'000, 1), [](HttpReply& reply, int number) {
        if (number != 3 && number != 5) return;
        reply = {};
        reply.status = 503;
        reply.problem = "the server answers 503";
        if (number == 5) reply.retryAfter = 1000;
      });
  const auto file = openedFrom(server, {}, 4);
  const auto all = (*file)->bytes();
  const FileImage::Part parts[] = {all.subspan(500'000, 10), all.subspan(1'500'000, 10),
                                   all.subspan(2'500'000, 10)};
  ASSERT_TRUE((*file)->loadParts(parts)) << sentenceOf(**file);
  ASSERT_EQ(server->asked.size(), 6u);
  EXPECT_EQ(server->asked[4], server->asked[2]);
  EXPECT_EQ(server->asked[5], server->asked[2]);
  EXPECT_EQ(server->waits, (std::vector<double>{0.25, 30}));
  for (const auto part : parts)
    EXPECT_TRUE(
        std::ranges::equal(part, std::span(server->file).subspan(std::size_t(part.data() - all.data()), 10)));
}

TEST(RangedFile, IsGivenUpAfterTheRetries) {
  const auto server =
      std::make_shared<SpoiledServer>(nonzeroBytes(100'000, 1), [](HttpReply& reply, int number) {
        if (number > 1) reply.bytes.pop_back();
      });
  const auto file = openedFrom(server, {}, 2);
  EXPECT_FALSE((*file)->load((*file)->bytes()));
  EXPECT_EQ(server->asked.size(), 4u);
  EXPECT_NE(sentenceOf(**file).find("3 times"), std::string::npos) << sentenceOf(**file);
}

TEST(RangedFile, EndsWhereTheReadingIsStopped) {
  std::atomic<bool> cancel = false;
  const auto server =
      std::make_shared<SpoiledServer>(nonzeroBytes(1'000'000, 1), [&](HttpReply& reply, int number) {
        if (number < 2) return;
        cancel = true;
        reply.problem = "lost";
      });
  const auto file = openedFrom(server, {}, 100);
  RunContext context;
  context.cancel = &cancel;
  const FileImage::Part all = (*file)->bytes();
  EXPECT_FALSE((*file)->loadParts({&all, 1}, context));
  EXPECT_EQ((*file)->problem()->code, ErrorCode::interrupted);
  EXPECT_EQ(server->asked.size(), 2u);
  EXPECT_FALSE((*file)->load(all)) << "what is missing stays missing";
  EXPECT_EQ(openedFrom(std::make_shared<SpoiledServer>(nonzeroBytes(10, 1),
                                                       [](HttpReply& reply, int) { reply.problem = "lost"; }),
                       {&cancel, nullptr}, 100)
                .error()
                .code,
            ErrorCode::interrupted);
}

TEST(RangedFile, MayBeLoadedOnManyThreads) {
  const auto server = std::make_shared<SpoiledServer>(nonzeroBytes(2'000'000, 9));
  const auto file = openedFrom(server);
  std::vector<std::thread> threads;
  std::atomic<bool> isWrong = false;
  for (unsigned t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      std::mt19937 random(t);
      for (int i = 0; i < 50; ++i) {
        const std::size_t begin = random() % 1'900'000;
        const auto part = (*file)->bytes().subspan(begin, 90'000);
        if (!(*file)->load(part) || !std::ranges::equal(part, std::span(server->file).subspan(begin, 90'000)))
          isWrong = true;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_FALSE(isWrong);
  EXPECT_LE(server->sent, server->file.size());
}

class RangedFileCache : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("arete_ranged_file_{}", ::getpid());
    fs::remove_all(folder_);
    settings_.cache = *SpanCache::open(folder_, 50'000'000);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
  WebSettings settings_;
};

TEST_F(RangedFileCache, IsAskedBeforeTheServer) {
  const FileBytes bytes = nonzeroBytes(3'000'000, 1);
  for (const bool isFirst : {true, false}) {
    const auto server = std::make_shared<SpoiledServer>(bytes);
    const auto file = openedFrom(server, settings_);
    const auto all = (*file)->bytes();
    for (const auto& [begin, count] : {std::pair(1'000'000, 300'000), {2'900'000, 100'000}, {200'000, 5}}) {
      ASSERT_TRUE((*file)->load(all.subspan(std::size_t(begin), std::size_t(count))));
      ASSERT_TRUE(std::equal(all.begin() + begin, all.begin() + begin + count, bytes.begin() + begin));
    }
    EXPECT_EQ(server->asked.size(), isFirst ? 4u : 1u) << "the version is asked for";
  }
}

TEST_F(RangedFileCache, HasNothingOfAReplacedFile) {
  for (unsigned seed = 1; seed < 4; ++seed) {
    const auto server = std::make_shared<SpoiledServer>(nonzeroBytes(1'000'000, seed));
    server->tag = fmt::format("\"{}\"", seed);
    const auto file = openedFrom(server, settings_);
    ASSERT_TRUE((*file)->load((*file)->bytes()));
    EXPECT_TRUE(std::ranges::equal((*file)->bytes(), server->file));
    EXPECT_EQ(server->asked.size(), 2u);
  }
}

TEST_F(RangedFileCache, KeepsNothingOfAFileWithoutAVersion) {
  for (unsigned seed = 1; seed < 4; ++seed) {
    const auto server = std::make_shared<SpoiledServer>(nonzeroBytes(1'000'000, seed));
    server->tag.clear();
    const auto file = openedFrom(server, settings_);
    ASSERT_TRUE((*file)->load((*file)->bytes()));
    EXPECT_TRUE(std::ranges::equal((*file)->bytes(), server->file));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(RangedFileCache, IsFetchedAgainWhereItIsDamaged) {
  const FileBytes bytes = nonzeroBytes(1'000'000, 1);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto server = std::make_shared<SpoiledServer>(bytes);
    const auto file = openedFrom(server, settings_);
    ASSERT_TRUE((*file)->load((*file)->bytes()));
    ASSERT_TRUE(std::ranges::equal((*file)->bytes(), bytes)) << "seed " << seed;
    EXPECT_EQ(server->asked.size(), 2u) << "seed " << seed;
    std::mt19937 random(seed);
    const auto which = random() % 4;
    std::size_t i = 0;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (i++ != which) continue;
      std::fstream damaged(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
      const auto at = static_cast<std::streamoff>(random() % fs::file_size(entry.path()));
      damaged.seekg(at);
      const char old = static_cast<char>(damaged.get());
      damaged.seekp(at);
      damaged.put(static_cast<char>(old ^ 16));
    }
  }
}

}  // namespace
}  // namespace arete
