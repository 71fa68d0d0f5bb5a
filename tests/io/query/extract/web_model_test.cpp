// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models on a server that misbehaves: what is read of them is what the plain file has, or there is an error.
#include <cpl_conv.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <tuple>

#include "io/files/network/network_use.h"
#include "io/files/ranges/span_cache.h"
#include "io/files/ranges/web_settings.h"
#include "io/http_server.h"
#include "io/query/extract/model.h"
#include "io/query/extract/model_file.h"
#include "io/written_amt.h"

namespace arete {
namespace {

using test::built;
using test::expectSame;
using test::HttpFault;
using test::HttpServer;
using test::TemporaryFolder;
using test::writtenTo;

/// Quick retries, so that what never works fails soon.
class WebModel : public testing::Test {
 protected:
  void SetUp() override {
    set("GDAL_HTTP_MAX_RETRY", "2");
    set("GDAL_HTTP_RETRY_DELAY", "0.01");
    set("GDAL_HTTP_LOW_SPEED_TIME", "1");
  }
  void TearDown() override {
    for (const char* name : {"GDAL_HTTP_MAX_RETRY", "GDAL_HTTP_RETRY_DELAY", "GDAL_HTTP_LOW_SPEED_TIME"})
      set(name, nullptr);
    setWebSettings({});
  }
  static void set(const char* name, const char* value) { CPLSetConfigOption(name, value); }

  static std::string bytesOf(const std::string& path) {
    std::ifstream from(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(from), {}};
  }
  static Result<TerrainModel> read(const std::string& path, const RequiredError& wanted = {}) {
    ARETE_TRY(const AmtFile file, openTerrainFile(path));
    return file.read({.wanted = wanted});
  }
  /// The error of boxes that meet a window at (x, y), and elsewhere.
  static RequiredError near(double x, double y, double inside) {
    return requiredInPlan([=](const Box2& b) {
      const bool meets = b.xMin < x + 300 && b.xMax > x && b.yMin < y + 300 && b.yMax > y;
      return meets ? inside : std::numeric_limits<double>::infinity();
    });
  }

  TemporaryFolder folder_;
};

TEST_F(WebModel, GivesThePartsThatThePlainFileGives) {
  for (const bool isPacked : {false, true}) {
    const std::string path = writtenTo(folder_, isPacked, true, 150, 120);
    const HttpServer server({{"a.amt", bytesOf(path)}}, {});
    for (unsigned seed = 1; seed <= 9; ++seed) {
      std::mt19937 random(seed);
      const double error = std::array{0.0, 0.3, 1.0, 4.0}[random() % 4];
      const RequiredError wanted = seed % 3 == 0
                                       ? RequiredError([error](const Box3&) { return error; })
                                       : near(double(random() % 4000), -double(random() % 3500), error);
      SCOPED_TRACE(fmt::format("seed {}, packed {}", seed, isPacked));
      const TerrainModel local = built(read(path, wanted));
      const auto remote = read((seed % 2 == 0 ? "" : "/vsicurl/") + server.address("a.amt"), wanted);
      ASSERT_TRUE(remote) << remote.error().describe();
      expectSame(local, *remote);
    }
  }
}

TEST_F(WebModel, IsOpenedByOneRequestAndReadInPartByFewBytes) {
  const std::string path = writtenTo(folder_, true, false, 240, 180);
  const std::string bytes = bytesOf(path);
  HttpServer server({{"a.amt", bytes}}, {});
  const NetworkUse before = networkUse();
  const auto file = openTerrainFile(server.address("a.amt"));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_EQ(networkUse().requests - before.requests, 1u);
  EXPECT_EQ(networkUse().bytes - before.bytes, 65536u);
  ASSERT_TRUE(file->read({.wanted = near(3000, -3000, 2)}));
  EXPECT_LT(networkUse().bytes - before.bytes, bytes.size() / 2) << bytes.size();
  EXPECT_LE(networkUse().requests - before.requests, 10u);
}

TEST_F(WebModel, ThatIsNotThereIsNotFound) {
  const HttpServer server({}, {});
  const auto missing = openModel(server.address("b.amt"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::notFound);
  EXPECT_EQ(missing.error().culprit, server.address("b.amt"));
}

/// Each misbehaviour begins at one of the first requests, and passes or stays.
class WebModelOfABadServer : public WebModel, public testing::WithParamInterface<std::tuple<bool, bool>> {};

TEST_P(WebModelOfABadServer, IsRightOrRefused) {
  const auto [isPacked, passes] = GetParam();
  using Fault = std::function<void(HttpFault&)>;
  const std::pair<const char*, Fault> faults[] = {
      {"dropped", [](HttpFault& f) { f.isDropped = true; }},
      {"short", [](HttpFault& f) { f.isShort = true; }},
      {"too long", [](HttpFault& f) { f.more = 5; }},
      {"another range", [](HttpFault& f) { f.shift = 3; }},
      {"no ranges", [](HttpFault& f) { f.knowsNoRanges = true; }},
      {"compressed", [](HttpFault& f) { f.headers = "Content-Encoding: gzip\r\n"; }},
      {"401", [](HttpFault& f) { f.status = 401; }},
      {"403", [](HttpFault& f) { f.status = 403; }},
      {"404", [](HttpFault& f) { f.status = 404; }},
      {"429", [](HttpFault& f) { f.status = 429; }},
      {"500", [](HttpFault& f) { f.status = 500; }},
      {"503", [](HttpFault& f) { f.status = 503; }},
      {"redirected to itself",
       [](HttpFault& f) {
         f.status = 302;
         f.headers = "Location: /a.amt\r\n";
       }},
      {"another tag", [](HttpFault& f) { f.tag = "\"two\""; }},
      {"another date", [](HttpFault& f) { f.headers = "Last-Modified: today\r\n"; }},
      {"another length", [](HttpFault& f) { f.content = "short"; }},
      {"empty", [](HttpFault& f) { f.content = " "; }}};
  // More than the first request fetches.
  const std::string path = writtenTo(folder_, isPacked, true, isPacked ? 150 : 60, isPacked ? 120 : 50),
                    bytes = bytesOf(path);
  const TerrainModel wanted = built(read(path, near(1000, -1000, 0)));
  for (const auto& [name, spoil] : faults)
    for (const int first : {1, 2, 3}) {
      const HttpServer server({{"a.amt", bytes}},
                              [&, spoil = spoil, passes = passes](const std::string&, int number) {
                                HttpFault fault;
                                if (number >= first && (!passes || number < first + 1)) spoil(fault);
                                return fault;
                              });
      SCOPED_TRACE(fmt::format("{} from request {} on", name, first));
      const auto begin = std::chrono::steady_clock::now();
      const auto model = read(server.address("a.amt"), near(1000, -1000, 0));
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
      if (model) {
        expectSame(wanted, *model);
      } else {
        EXPECT_EQ(model.error().culprit, server.address("a.amt"));
        EXPECT_FALSE(passes && std::string(name).find_first_of("5") == 0) << model.error().describe();
      }
    }
}

INSTANTIATE_TEST_SUITE_P(PackedOrNotAndForAWhileOrForEver, WebModelOfABadServer,
                         testing::Combine(testing::Bool(), testing::Bool()));

TEST_F(WebModel, IsRefusedWhereAReplacedFileLooksLikeTheOldOne) {
  for (const bool isPacked : {false, true}) {
    const std::string bytes = bytesOf(writtenTo(folder_, isPacked, true, 120, 90));
    std::string other = bytes;  // of the same length, date and tag
    for (std::size_t i = 20'000; i < other.size(); i += 1000) other[i] ^= 1;
    const HttpServer server({{"a.amt", bytes}}, [&](const std::string&, int number) {
      HttpFault fault;
      if (number > 1) fault.content = other;
      return fault;
    });
    const auto model = read(server.address("a.amt"));
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, ErrorCode::corrupt) << model.error().describe();
  }
}

TEST_F(WebModel, IsReadOnceWithACache) {
  const std::string path = writtenTo(folder_, true), bytes = bytesOf(path);
  HttpServer server({{"a.amt", bytes}}, {});
  setWebSettings({nullptr, *SpanCache::open(folder_.file("cache"), 10'000'000)});
  const TerrainModel wanted = built(read(path));
  expectSame(wanted, built(read(server.address("a.amt"))));
  const NetworkUse before = networkUse();
  expectSame(wanted, built(read(server.address("a.amt"))));
  EXPECT_EQ(networkUse().requests - before.requests, 1u);
  EXPECT_EQ(networkUse().cachedBytes - before.cachedBytes, bytes.size() - 65536);
}

TEST_F(WebModel, TakesTheOptionsOfGdal) {
  HttpServer server({{"a.amt", bytesOf(writtenTo(folder_, true, true, 40, 40))}}, {});
  set("GDAL_HTTP_HEADERS", "X-Key: five");
  set("GDAL_HTTP_USERAGENT", "some agent");
  std::string encoded;
  for (const char c : server.address("a.amt"))
    encoded += c == ':' ? "%3A" : c == '/' ? "%2F" : std::string(1, c);
  for (const std::string& name :
       {server.address("a.amt"), "/vsicurl?max_retry=1&referer=here&url=" + encoded}) {
    EXPECT_TRUE(read(name)) << read(name).error().describe();
    EXPECT_NE(server.lastRequest().find("X-Key: five\r\n"), std::string::npos);
    EXPECT_NE(server.lastRequest().find("User-Agent: some agent\r\n"), std::string::npos);
  }
  EXPECT_NE(server.lastRequest().find("Referer: here\r\n"), std::string::npos);
  set("GDAL_HTTP_HEADERS", nullptr);
  set("GDAL_HTTP_USERAGENT", nullptr);
  const auto unknown = read("/vsicurl?bad_option=1&url=" + encoded);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::usage);
}

TEST_F(WebModel, IsReadFromAStoreOfACloudThroughGdal) {
  const std::string path = writtenTo(folder_, true, false, 200, 150), bytes = bytesOf(path);
  HttpServer server({{"bucket/a.amt", bytes}}, {});
  const std::string host = server.address("");
  for (const auto& [name, value] : {std::pair<const char*, std::string>{"AWS_NO_SIGN_REQUEST", "YES"},
                                    {"AWS_HTTPS", "NO"},
                                    {"AWS_VIRTUAL_HOSTING", "FALSE"},
                                    {"AWS_S3_ENDPOINT", host.substr(7, host.size() - 8)}})
    set(name, value.c_str());
  for (const RequiredError& wanted : {RequiredError(), near(1000, -1000, 0.5)}) {
    const auto model = read("/vsis3/bucket/a.amt", wanted);
    ASSERT_TRUE(model) << model.error().describe();
    expectSame(built(read(path, wanted)), *model);
  }
  const auto missing = read("/vsis3/bucket/b.amt");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().culprit, "/vsis3/bucket/b.amt");
  for (const char* name : {"AWS_NO_SIGN_REQUEST", "AWS_HTTPS", "AWS_VIRTUAL_HOSTING", "AWS_S3_ENDPOINT"})
    set(name, nullptr);
}

TEST_F(WebModel, EndsWhereItIsStopped) {
  const HttpServer server({{"a.amt", bytesOf(writtenTo(folder_, true, true, 150, 120))}},
                          [&](const std::string&, int number) {
                            HttpFault fault;
                            fault.isStalled = number > 1;
                            return fault;
                          });
  std::atomic<bool> cancel = false;
  RunContext context;
  context.cancel = &cancel;
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    cancel = true;
  });
  set("GDAL_HTTP_LOW_SPEED_TIME", "30");
  const auto begin = std::chrono::steady_clock::now();
  const auto model = openModel(server.address("a.amt"), {}, context);
  canceller.join();
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::interrupted) << model.error().describe();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

}  // namespace
}  // namespace arete
