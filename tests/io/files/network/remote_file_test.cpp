// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a server may answer, given by a client that sends nothing: no test here waits or opens a connection.
#include "io/files/network/remote_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>
#include <utility>

namespace arete {
namespace {

std::vector<std::byte> someBytes(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::byte> bytes(count);
  for (std::byte& byte : bytes) byte = std::byte(random() & 255);
  return bytes;
}

/// A server without faults; `spoil` changes what it answers to a request, counted from 1.
class FakeServer final : public HttpClient {
 public:
  using Spoil = std::function<void(HttpReply& reply, int number)>;

  explicit FakeServer(std::vector<std::byte> file, Spoil spoil = {})
      : file_(std::move(file)), spoil_(std::move(spoil)) {}

  HttpReply get(std::uint64_t first, std::uint64_t last) override {
    HttpReply reply;
    if (first >= file_.size()) {
      reply.status = 416;
      reply.problem = "the server answers 416";
    } else {
      const std::uint64_t end = std::min<std::uint64_t>(last + 1, file_.size());
      reply.bytes.assign(file_.begin() + std::ptrdiff_t(first), file_.begin() + std::ptrdiff_t(end));
      reply.range = fmt::format("bytes {}-{}/{}", first, end - 1, file_.size());
      reply.length = std::to_string(end - first);
      reply.tag = "\"one\"";
    }
    ++requests;
    if (spoil_) spoil_(reply, requests);
    return reply;
  }
  bool wait(double seconds) override {
    waits.push_back(seconds);
    return !isStopped;
  }
  bool isCancelled() const override { return isStopped; }

  const std::vector<std::byte>& file() const { return file_; }

  int requests = 0;
  std::vector<double> waits;
  bool isStopped = false;

 private:
  std::vector<std::byte> file_;
  Spoil spoil_;
};

void answersWith(HttpReply& reply, int status) {
  reply = {};
  reply.status = status;
  reply.problem = fmt::format("the server answers {}", status);
}

RemoteFile openedFrom(const std::shared_ptr<FakeServer>& server, int retries = 0) {
  return RemoteFile("http://host/a", server, {retries, 0.25});
}

TEST(RemoteFile, GivesTheBytesOfAnyRange) {
  constexpr unsigned kSeed = 5;
  for (const std::size_t size : {1, 1000, 262143, 262144, 262145, 3000000}) {
    const auto server = std::make_shared<FakeServer>(someBytes(size, kSeed));
    const RemoteFile file = openedFrom(server);
    ASSERT_FALSE(file.problem());
    ASSERT_EQ(file.size(), size);
    std::mt19937 random(kSeed);
    for (int i = 0; i < 40; ++i) {
      const std::size_t begin = random() % size, count = random() % (size - begin + 1);
      std::vector<std::byte> got(count);
      const Status read = file.read(begin, got);
      ASSERT_TRUE(read) << read.error().describe();
      ASSERT_TRUE(std::equal(got.begin(), got.end(), server->file().begin() + std::ptrdiff_t(begin)))
          << size << " bytes, seed " << kSeed << ", from " << begin << " on";
    }
    EXPECT_TRUE(file.compare());
  }
}

TEST(RemoteFile, OfAServerWithoutRangesIsReadOnce) {
  const auto server =
      std::make_shared<FakeServer>(someBytes(1000, 1), [](HttpReply& reply, int) { reply.range.clear(); });
  const RemoteFile file = openedFrom(server);
  std::vector<std::byte> got(1000);
  ASSERT_TRUE(file.read(0, got));
  EXPECT_EQ(got, server->file());
  EXPECT_EQ(server->requests, 1);
}

TEST(RemoteFile, MayBeEmpty) {
  const RemoteFile file = openedFrom(std::make_shared<FakeServer>(std::vector<std::byte>()));
  EXPECT_FALSE(file.problem());
  EXPECT_EQ(file.size(), 0u);
  EXPECT_TRUE(file.read(0, {}));
}

TEST(RemoteFile, RefusesEveryAnswerThatIsNotWhatWasAskedFor) {
  using Spoil = void (*)(HttpReply&);
  const std::pair<const char*, Spoil> lies[] = {
      {"the server sent", [](HttpReply& r) { r.bytes.pop_back(); }},
      {"the server sent", [](HttpReply& r) { r.bytes.push_back({}); }},
      {"the server sent", [](HttpReply& r) { r.range.replace(0, 7, "bytes 7"); }},
      {"does not say how long", [](HttpReply& r) { r.range = "bytes 0-9/*"; }},
      {"does not say how long", [](HttpReply& r) { r.range = "bytes"; }},
      {"as gzip, which was not asked for", [](HttpReply& r) { r.encoding = "gzip"; }},
      {"replaced while it was read", [](HttpReply& r) { r.tag = "\"two\""; }},
      {"replaced while it was read", [](HttpReply& r) { r.date = "today"; }},
      {"replaced while it was read", [](HttpReply& r) { r.range.back() = '1'; }},
      {"the whole file instead of a part", [](HttpReply& r) {
         r.range.clear();
         r.bytes.resize(3000000);
         r.length = "3000000";
       }}};
  for (const auto& [sentence, spoil] : lies) {
    const auto server =
        std::make_shared<FakeServer>(someBytes(3000000, 2), [spoil = spoil](HttpReply& reply, int number) {
          if (number > 1) spoil(reply);
        });
    const RemoteFile file = openedFrom(server);
    ASSERT_FALSE(file.problem());
    std::vector<std::byte> got(100);
    const Status read = file.read(2000000, got);
    ASSERT_FALSE(read) << sentence;
    EXPECT_EQ(read.error().code, ErrorCode::unreadable);
    EXPECT_EQ(read.error().culprit, "http://host/a");
    EXPECT_NE(read.error().message.find(sentence), std::string::npos) << read.error().message;
    // A reader that takes no notice goes on: it gets errors, and the server no requests.
    const int requests = server->requests;
    EXPECT_FALSE(file.read(1000000, got));
    EXPECT_EQ(server->requests, requests);
  }
}

TEST(RemoteFile, IsNotThePartThatAServerSendsWithoutSayingSo) {
  const auto server =
      std::make_shared<FakeServer>(someBytes(3000000, 3), [](HttpReply& reply, int) { reply.range.clear(); });
  const RemoteFile file = openedFrom(server);
  ASSERT_TRUE(file.problem());
  EXPECT_NE(file.problem()->message.find("a part of the file"), std::string::npos);
  // A whole file of exactly that length is one.
  const std::vector<std::byte> piece = someBytes(262144, 3);
  const auto whole = std::make_shared<FakeServer>(piece, [&](HttpReply& reply, int) {
    reply.range.clear();
    reply.bytes = piece;
    reply.length = std::to_string(piece.size());
  });
  EXPECT_FALSE(openedFrom(whole).problem());
}

TEST(RemoteFile, AsksAgainAfterAsLongAsTheServerSaysOrTwiceAsLongEachTime) {
  const auto server = std::make_shared<FakeServer>(someBytes(10, 4), [](HttpReply& reply, int number) {
    if (number == 5) return;
    answersWith(reply, 503);
    if (number == 2) reply.retryAfter = 7;
    if (number == 3) reply.retryAfter = 1000;
  });
  const RemoteFile file = openedFrom(server, 4);
  EXPECT_FALSE(file.problem());
  EXPECT_EQ(server->waits, (std::vector<double>{0.25, 7, 30, 2}));
}

TEST(RemoteFile, IsGivenUpAfterTheRetriesAndAtOnceWhereNothingWouldChange) {
  const auto requestsFor = [](const FakeServer::Spoil& spoil) {
    const auto server = std::make_shared<FakeServer>(someBytes(10, 4), spoil);
    EXPECT_TRUE(openedFrom(server, 2).problem());
    return server->requests;
  };
  for (const int status : {429, 500, 502, 503, 504})
    EXPECT_EQ(requestsFor([&](HttpReply& reply, int) { answersWith(reply, status); }), 3) << status;
  for (const int status : {400, 401, 403, 404, 410})
    EXPECT_EQ(requestsFor([&](HttpReply& reply, int) { answersWith(reply, status); }), 1) << status;
  EXPECT_EQ(requestsFor([&](HttpReply& reply, int) { reply.problem = "lost"; }), 3);
  EXPECT_EQ(requestsFor([&](HttpReply& reply, int) {
              reply.problem = "no such host";
              reply.isLasting = true;
            }),
            1);
}

TEST(RemoteFile, SaysWhetherThereIsNoSuchFile) {
  for (const auto& [status, isAbsent, code] : {std::tuple{404, true, ErrorCode::notFound},
                                               {410, true, ErrorCode::notFound},
                                               {403, true, ErrorCode::unreadable},
                                               {401, false, ErrorCode::unreadable}}) {
    const RemoteFile file = openedFrom(std::make_shared<FakeServer>(
        someBytes(10, 4), [status = status](HttpReply& reply, int) { answersWith(reply, status); }));
    ASSERT_TRUE(file.problem());
    EXPECT_EQ(file.isAbsent(), isAbsent) << status;
    EXPECT_EQ(file.problem()->code, code) << status;
  }
}

TEST(RemoteFile, EndsItsRetriesWhereTheReadingIsStopped) {
  const auto server =
      std::make_shared<FakeServer>(someBytes(10, 4), [](HttpReply& reply, int) { reply.problem = "lost"; });
  server->isStopped = true;
  EXPECT_TRUE(openedFrom(server, 100).problem());
  EXPECT_EQ(server->requests, 1);
}

}  // namespace
}  // namespace arete
