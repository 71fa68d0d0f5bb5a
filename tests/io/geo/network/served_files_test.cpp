// SPDX-License-Identifier: GPL-3.0-or-later
//
// Our files in GDAL, and GDAL's own beside them.
#include "io/geo/network/served_files.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <cpl_vsi_virtual.h>
#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "io/geo/dem/dem_reader.h"
#include "io/geo/gdal/support.h"
#include "io/geo/network/network_path.h"
#include "io/http_server.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::HttpFault;
using test::HttpServer;

std::string readAll(const std::string& name) {
  VSILFILE* file = VSIFOpenL(name.c_str(), "rb");
  if (!file) return "no file";
  std::string text(1000, ' ');
  text.resize(VSIFReadL(text.data(), 1, text.size(), file));
  VSIFCloseL(file);
  return text;
}

std::string encoded(std::string address) {
  for (std::size_t at = 0; (at = address.find_first_of(":/", at)) != address.npos; at += 3)
    address.replace(at, 1, address[at] == ':' ? "%3A" : "%2F");
  return address;
}

// Before main(): no function of ours has run.
VSIFilesystemHandler* const gdalsOwn = VSIFileManager::GetHandler("/vsicurl/");
VSIFilesystemHandler* const gdalsOwnWithOptions = VSIFileManager::GetHandler("/vsicurl?");

TEST(ServedFiles, LeaveGdalsOwnAlone) {
  ASSERT_NE(gdalsOwn, VSIFileManager::GetHandler(""));
  registerGdal();
  const HttpServer server({{"a.csv", "x,y,z\n0,0,1\n9,0,2\n0,9,3\n9,9,4\n"}}, {});
  EXPECT_TRUE(readDem("/vsicurl/" + server.address("a.csv")));
  EXPECT_EQ(VSIFileManager::GetHandler("/vsicurl/"), gdalsOwn);
  EXPECT_EQ(VSIFileManager::GetHandler("/vsicurl?"), gdalsOwnWithOptions);
  EXPECT_NE(VSIFileManager::GetHandler((servedName() + "/").c_str()), gdalsOwn);
}

TEST(ServedFiles, AreReadByAnyProgramUnderThePrefix) {
  const GdalErrors quiet;
  const HttpServer server({{"a.txt", "0123456789"}, {"empty", ""}});
  const std::string name = servedName() + "/" + server.address("a.txt");
  EXPECT_EQ(readAll(name), "0123456789");
  const std::string url = encoded(server.address("a.txt"));
  EXPECT_EQ(readAll(servedName() + "?max_retry=0&url=" + url), "0123456789");
  EXPECT_EQ(readAll(servedName() + "?what=0&url=" + url), "no file");
  EXPECT_EQ(readAll(servedName() + "/" + server.address("none.txt")), "no file");
  VSIStatBufL status;
  ASSERT_EQ(VSIStatL(name.c_str(), &status), 0);
  EXPECT_EQ(status.st_size, 10);
  EXPECT_NE(VSIStatL((servedName() + "/" + server.address("none.txt")).c_str(), &status), 0);
  EXPECT_EQ(VSIFOpenL(name.c_str(), "wb"), nullptr) << "they are for reading";
  EXPECT_EQ(VSIFOpenL(name.c_str(), "r+b"), nullptr);

  VSILFILE* file = VSIFOpenL(name.c_str(), "rb");
  ASSERT_NE(file, nullptr);
  char bytes[20] = {};
  VSIFSeekL(file, 8, SEEK_SET);
  EXPECT_EQ(VSIFReadL(bytes, 1, 20, file), 2u);
  EXPECT_TRUE(VSIFEofL(file));
  VSIFSeekL(file, 0, SEEK_END);
  EXPECT_EQ(VSIFTellL(file), 10u);
  EXPECT_FALSE(VSIFEofL(file));
  VSIFCloseL(file);
}

TEST(ServedFiles, OfOtherPathsAreTheFilesThemselves) {
  const GdalErrors quiet;
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "text");
  EXPECT_EQ(readAll(servedName() + "/" + path), "text");
  EXPECT_EQ(readAll(servedName() + "/" + folder.file("none")), "no file");
  VSIStatBufL status;
  ASSERT_EQ(VSIStatL((servedName() + "/" + folder.file("")).c_str(), &status), 0);
  EXPECT_TRUE(VSI_ISDIR(status.st_mode));
}

TEST(ServedFiles, FollowARedirection) {
  const HttpServer server({{"a.txt", "0123456789"}}, {});
  const HttpServer before({{"a.txt", "moved"}}, [&](const std::string&, int) {
    HttpFault fault;
    fault.status = 302;
    fault.headers = "ETag: \"before\"\r\nLocation: " + server.address("a.txt") + "\r\n";
    return fault;
  });
  EXPECT_EQ(readAll(servedName() + "/" + before.address("a.txt")), "0123456789");
}

TEST(ServedFiles, AreRequestedWithTheOptionsOfTheThreadAndOfTheName) {
  HttpServer server({{"a.txt", "0123456789"}}, {});
  CPLSetThreadLocalConfigOption("GDAL_HTTP_USERAGENT", "one of this thread");
  EXPECT_EQ(readAll(servedName() + "/" + server.address("a.txt")), "0123456789");
  EXPECT_NE(server.lastRequest().find("User-Agent: one of this thread"), std::string::npos);
  CPLSetThreadLocalConfigOption("GDAL_HTTP_USERAGENT", nullptr);
  EXPECT_EQ(readAll(servedName() + "?useragent=mine&referer=page&url=" + encoded(server.address("a.txt"))),
            "0123456789");
  EXPECT_NE(server.lastRequest().find("User-Agent: mine"), std::string::npos);
  EXPECT_NE(server.lastRequest().find("Referer: page"), std::string::npos);
}

TEST(ServedFiles, AreReadByManyThreadsAtOnce) {
  const std::string text(900, 'x');
  const HttpServer server({{"a.txt", text}});
  std::vector<std::string> got(8);
  {
    std::vector<std::jthread> threads;
    for (std::string& one : got)
      threads.emplace_back([&] { one = readAll(servedName() + "/" + server.address("a.txt")); });
  }
  for (const std::string& one : got) EXPECT_EQ(one, text);
}

// GDAL's cache for files (VSI_CACHE) lies in front of its own handlers: nothing changes here.
TEST(ServedFiles, DoNotDependOnTheCacheOfGdal) {
  const HttpServer server({{"a.txt", "0123456789"}}, {});
  CPLSetConfigOption("VSI_CACHE", "TRUE");
  EXPECT_EQ(readAll(servedName() + "/" + server.address("a.txt")), "0123456789");
  CPLSetConfigOption("VSI_CACHE", nullptr);
}

}  // namespace
}  // namespace arete
