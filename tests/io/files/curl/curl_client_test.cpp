// SPDX-License-Identifier: GPL-3.0-or-later
//
// A server on this machine that misbehaves, asked through libcurl.
#include "io/files/curl/curl_client.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "io/http_server.h"

namespace arete {
namespace {

using test::HttpFault;
using test::HttpServer;

std::string textOf(const HttpReply& reply) {
  return {reinterpret_cast<const char*>(reply.bytes.data()), reply.bytes.size()};
}

CurlOptions impatient() {
  CurlOptions options;
  options.stallSeconds = 1;
  options.connectSeconds = 2;
  return options;
}

HttpReply replyTo(const HttpFault& fault, CurlOptions options = impatient(), std::uint64_t first = 2,
                  std::uint64_t last = 5) {
  HttpServer server({{"a", "0123456789"}}, [&](const std::string&, int) { return fault; });
  return curlHttpClient(server.address("a"), std::move(options))->get(first, last);
}

TEST(CurlClient, GetsARangeWithWhatTheServerSaysOfIt) {
  HttpServer server({{"a", "0123456789"}}, {});
  const auto client = curlHttpClient(server.address("a"), {});
  const HttpReply reply = client->get(2, 5);
  EXPECT_EQ(reply.problem, "");
  EXPECT_EQ(textOf(reply), "2345");
  EXPECT_EQ(reply.range, "bytes 2-5/10");
  EXPECT_EQ(reply.tag, "\"one\"");
  EXPECT_EQ(reply.length, "4");
  EXPECT_EQ(reply.encoding, "");
  EXPECT_NE(server.lastRequest().find("Accept-Encoding: identity"), std::string::npos);
  EXPECT_EQ(textOf(client->get(8, 100)), "89");
  EXPECT_EQ(client->get(10, 100).status, 416);
}

TEST(CurlClient, GetsManyRangesInTheirOrder) {
  std::string bytes(100'000, ' ');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>('a' + i * i % 26);
  HttpServer server({{"a", bytes}}, {});
  const auto client = curlHttpClient(server.address("a"), {});
  std::vector<HttpRange> ranges;
  for (std::uint64_t i = 0; i < 50; ++i)
    ranges.push_back({(i * 7919) % 90'000, (i * 7919) % 90'000 + 1000 + i});
  const auto replies = client->getAll(ranges);
  ASSERT_EQ(replies.size(), ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i)
    EXPECT_EQ(textOf(replies[i]), bytes.substr(ranges[i].first, ranges[i].last + 1 - ranges[i].first)) << i;
}

TEST(CurlClient, SaysWhatIsWrong) {
  HttpFault dropped, more, shorter, missing, gzip, later, noRanges, gone;
  dropped.isDropped = true;
  more.more = 3;
  shorter.isShort = true;
  missing.status = 404;
  gzip.headers = "Content-Encoding: gzip\r\n";
  later.status = 503;
  later.headers = "Retry-After: 7\r\n";
  noRanges.knowsNoRanges = true;
  EXPECT_EQ(replyTo(dropped).problem, "the connection was lost");
  EXPECT_FALSE(replyTo(dropped).isLasting);
  EXPECT_EQ(replyTo(more).problem, "the server sent more than the 4 bytes that were asked for");
  EXPECT_EQ(textOf(replyTo(shorter)), "23") << "who asks sees that it is less than the range";
  EXPECT_EQ(replyTo(missing).status, 404);
  EXPECT_EQ(replyTo(gzip).encoding, "gzip");
  EXPECT_EQ(replyTo(later).status, 503);
  EXPECT_EQ(replyTo(later).retryAfter, 7);
  EXPECT_EQ(replyTo(noRanges).problem, "the server sent the whole file instead of a part of it");
  EXPECT_EQ(textOf(replyTo(noRanges, {}, 0, 3)), "0123456789");
  EXPECT_EQ(replyTo(noRanges, {}, 0, 3).range, "");
  CurlOptions few;
  few.mostWhole = 9;
  const HttpReply tooLong = replyTo(noRanges, few, 0, 3);
  EXPECT_NE(tooLong.problem.find("gives no parts of files"), std::string::npos) << tooLong.problem;
  EXPECT_TRUE(tooLong.isLasting);
}

TEST(CurlClient, FollowsRedirectionsButNotForEver) {
  HttpServer server({{"a", "0123456789"}, {"b", "b"}, {"loop", "l"}, {"file", "f"}},
                    [&](const std::string& name, int) {
                      HttpFault fault;
                      if (name != "a") fault.status = 302;
                      if (name == "b") fault.headers = "Location: /a\r\n";
                      if (name == "loop") fault.headers = "Location: /loop\r\n";
                      if (name == "file") fault.headers = "Location: file:///etc/passwd\r\n";
                      return fault;
                    });
  EXPECT_EQ(textOf(curlHttpClient(server.address("b"), {})->get(2, 5)), "2345");
  const HttpReply loop = curlHttpClient(server.address("loop"), {})->get(2, 5);
  EXPECT_EQ(loop.problem, "the server redirects more than 10 times");
  EXPECT_TRUE(loop.isLasting);
  EXPECT_LE(server.requests("loop"), 11);
  const HttpReply file = curlHttpClient(server.address("file"), {})->get(0, 5);
  EXPECT_NE(file.problem, "");
  EXPECT_TRUE(file.bytes.empty());
}

// libcurl counts in whole seconds.
void expectGivenUp(bool drips) {
  HttpFault fault;
  (drips ? fault.drips : fault.isStalled) = true;
  HttpServer server({{"a", std::string(1000, 'x')}}, [&](const std::string&, int) { return fault; });
  const auto begin = std::chrono::steady_clock::now();
  const HttpReply reply = curlHttpClient(server.address("a"), impatient())->get(0, 900);
  EXPECT_NE(reply.problem, "");
  EXPECT_FALSE(reply.isLasting);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5)) << reply.problem;
}

TEST(CurlClient, GivesUpWhereNothingComes) {
  expectGivenUp(false);
}

TEST(CurlClient, GivesUpWhereBytesDrip) {
  expectGivenUp(true);
}

TEST(CurlClient, EndsSoonAfterItIsCancelled) {
  HttpFault fault;
  fault.isStalled = true;
  HttpServer server({{"a", "0123456789"}}, [&](const std::string&, int) { return fault; });
  const auto client = curlHttpClient(server.address("a"), {});
  std::atomic<bool> cancel = false;
  client->cancelBy(&cancel);
  const auto begin = std::chrono::steady_clock::now();
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    cancel = true;
  });
  const std::vector<HttpRange> ranges(10, HttpRange{0, 5});
  for (const HttpReply& reply : client->getAll(ranges)) EXPECT_EQ(reply.problem, "reading was stopped");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
  canceller.join();
  EXPECT_FALSE(client->wait(100));
}

TEST(CurlClient, SaysLastinglyWhereNoServerOrNoCertificateIs) {
  const HttpReply nothing = curlHttpClient("http://127.0.0.1:9/a", impatient())->get(0, 5);
  EXPECT_NE(nothing.problem, "");
  EXPECT_TRUE(nothing.isLasting);
  HttpServer server({{"a", "0123456789"}}, {});
  std::string address = server.address("a");
  address.insert(4, "s");
  CurlOptions hasty = impatient();
  hasty.connectSeconds = 0.2;
  EXPECT_NE(curlHttpClient(address, hasty)->get(0, 5).problem, "") << "it speaks no TLS";
  EXPECT_NE(curlHttpClient("ftp://127.0.0.1:9/a", impatient())->get(0, 5).problem, "");
  EXPECT_NE(curlHttpClient("file:///etc/passwd", impatient())->get(0, 5).problem, "");
}

TEST(CurlClient, SendsAddressesWithLettersThatNeedCodes) {
  HttpServer server({{"a%20b%C3%A9", "0123456789"}}, {});
  EXPECT_EQ(textOf(curlHttpClient(server.address("a b\xc3\xa9"), {})->get(2, 5)), "2345");
  EXPECT_EQ(textOf(curlHttpClient(server.address("a%20b%C3%A9"), {})->get(2, 5)), "2345");
}

TEST(CurlClient, SendsWhatItsOptionsState) {
  HttpServer server({{"a", "0123456789"}}, {});
  CurlOptions options;
  options.headers = {"X-Key: five"};
  options.userAgent = "Some agent";
  options.userPassword = "user:password";
  curlHttpClient(server.address("a"), options)->get(0, 1);
  for (const char* line :
       {"X-Key: five\r\n", "User-Agent: Some agent\r\n", "Authorization: Basic dXNlcjpwYXNzd29yZA=="})
    EXPECT_NE(server.lastRequest().find(line), std::string::npos) << server.lastRequest();
}

TEST(CurlClient, InAForkedProcessHasConnectionsOfItsOwn) {
  HttpServer server({{"a", "0123456789"}}, {});
  const auto client = curlHttpClient(server.address("a"), {});
  EXPECT_EQ(textOf(client->get(0, 1)), "01");
  const pid_t child = ::fork();
  if (child == 0) ::_exit(textOf(client->get(4, 5)) == "45" ? 0 : 1);
  int status = 1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(textOf(client->get(2, 3)), "23");
}

}  // namespace
}  // namespace arete
