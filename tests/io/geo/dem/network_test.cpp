// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rasters over the network, from a server that loses connections, sends too little, replaces files and asks
// for patience.
#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <thread>

#include "io/geo/dem/dem_reader.h"
#include "io/geo/dem/raster_reader.h"
#include "io/http_server.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::contains;
using test::HttpFault;
using test::HttpServer;
using test::RasterSpec;
using test::TemporaryFolder;

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Heights of a tile of three seconds, as the files of SRTM hold them.
std::string tileOfHeights() {
  std::string tile;
  for (int i = 0; i < 1201 * 1201; ++i) {
    const int height = 100 + i % 1201 + i / 1201;
    tile += char(height >> 8);
    tile += char(height & 255);
  }
  return tile;
}

std::string rasterAs(const std::string& driver, const std::string& extension, int side = 600) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.driver = driver;
  spec.type = GDT_Float32;
  spec.columns = spec.rows = side;
  spec.values.resize(std::size_t(side) * std::size_t(side));
  for (std::size_t i = 0; i < spec.values.size(); ++i) spec.values[i] = double(i % 977);
  return contentOf(writeRaster(folder.file("a." + extension), spec));
}

class Network : public ::testing::Test {
 protected:
  void SetUp() override {
    GDALAllRegister();
    CPLSetConfigOption("GDAL_HTTP_RETRY_DELAY", "0.01");
  }
  void TearDown() override {
    CPLSetConfigOption("GDAL_HTTP_RETRY_DELAY", nullptr);
    CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", nullptr);
  }

  /// The four kinds of readers: bytes without a header, strips, libraries with files of their own.
  const std::map<std::string, std::string> files_ = {{"N46E008.hgt", tileOfHeights()},
                                                     {"a.tif", rasterAs("GTiff", "tif")},
                                                     {"a.nc", rasterAs("netCDF", "nc")}};
};

TEST_F(Network, GivesTheHeightsOfTheFile) {
  TemporaryFolder folder;
  for (const bool knowsRanges : {true, false}) {
    const HttpServer server(files_, [&](const std::string&, int) {
      HttpFault fault;
      fault.knowsNoRanges = !knowsRanges;
      return fault;
    });
    for (const auto& [name, content] : files_) {
      SCOPED_TRACE(name);
      const auto local = readRaster(folder.write(name, content));
      ASSERT_TRUE(local) << local.error().describe();
      for (const std::string& path : {"/vsicurl/" + server.address(name), server.address(name)}) {
        const auto remote = readDem(path);
        ASSERT_TRUE(remote) << remote.error().describe();
        const auto& field = std::get<RasterHeightfield>(remote->heightfield);
        EXPECT_EQ(field.sourceChecksum, local->heightfield.sourceChecksum);
        EXPECT_EQ(field.georeference.geoTransform, local->heightfield.georeference.geoTransform);
      }
    }
  }
}

TEST_F(Network, FindsTheOneRasterInAnArchive) {
  TemporaryFolder folder;
  const std::string zip = folder.file("a.zip");
  VSILFILE* out = VSIFOpenL(("/vsizip/" + zip + "/N46E008.hgt").c_str(), "wb");
  ASSERT_NE(out, nullptr);
  const std::string& tile = files_.at("N46E008.hgt");
  VSIFWriteL(tile.data(), 1, tile.size(), out);
  VSIFCloseL(out);
  for (const bool isDropped : {false, true}) {
    const HttpServer server({{"a.zip", contentOf(zip)}}, [&](const std::string&, int number) {
      HttpFault fault;
      fault.isDropped = isDropped && number > 1;
      return fault;
    });
    for (const std::string& path : {"/vsicurl/" + server.address("a.zip"), server.address("a.zip"),
                                    "/vsizip//vsicurl/" + server.address("a.zip") + "/N46E008.hgt"}) {
      const auto read = readDem(path);
      EXPECT_EQ(read.has_value(), !isDropped) << path << (read ? "" : read.error().describe());
    }
  }
}

TEST_F(Network, TriesAgainWhereTheServerAsksForItOrLosesTheConnection) {
  const auto passing = [](int status, const char* headers, bool isDropped) {
    return [=](const std::string&, int number) {
      HttpFault fault;
      if (number % 3 != 0) {
        fault.status = status;
        fault.headers = headers;
        fault.isDropped = isDropped;
      }
      return fault;
    };
  };
  for (const auto& faults :
       {passing(503, "", false), passing(429, "Retry-After: 0\r\n", false), passing(0, "", true)}) {
    HttpServer server(files_, faults);
    for (const auto& [name, content] : files_) {
      const auto read = readRaster("/vsicurl/" + server.address(name));
      EXPECT_TRUE(read) << name << ": " << read.error().describe();
    }
  }
}

TEST_F(Network, GivesUpWithinALimitAndSaysWhy) {
  for (const auto& [status, sentence] :
       {std::pair{503, "answers 503, 5 times"}, {429, "answers 429, 5 times"}, {404, "answers 404"}}) {
    HttpServer server(files_, [status = status](const std::string&, int) {
      HttpFault fault;
      fault.status = status;
      return fault;
    });
    for (const auto& [name, content] : files_) {
      const auto read = readDem("/vsicurl/" + server.address(name));
      ASSERT_FALSE(read) << name;
      EXPECT_EQ(read.error().code, status == 404 ? ErrorCode::notFound : ErrorCode::unreadable) << name;
      EXPECT_TRUE(contains(read.error().message, sentence)) << read.error().describe();
    }
  }
}

TEST_F(Network, NeverTakesTooFewBytesOrThoseOfAnotherFile) {
  CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", "1");
  // From which request on, so that the file opens first.
  for (const int from : {1, 2, 3, 4}) {
    for (const char* kind : {"dropped", "short", "replaced", "longer"}) {
      HttpServer server(files_, [&](const std::string& name, int number) {
        HttpFault fault;
        if (number < from) return fault;
        fault.isDropped = kind == std::string("dropped");
        fault.isShort = kind == std::string("short");
        if (kind == std::string("replaced"))
          fault.tag = "\"two\"", fault.content = std::string(files_.at(name).size(), 'x');
        if (kind == std::string("longer")) fault.content = files_.at(name) + "x";
        return fault;
      });
      for (const auto& [name, content] : files_) {
        SCOPED_TRACE(std::string(name) + " " + kind + " from request " + std::to_string(from));
        const auto read = readRaster("/vsicurl/" + server.address(name));
        // From the first request on it is simply another file, which may be read where it is the whole of
        // one.
        if (from == 1 && read && (kind == std::string("longer") || kind == std::string("replaced"))) continue;
        ASSERT_FALSE(read && server.requests(name) >= from);
        if (!read) {
          EXPECT_TRUE(contains(read.error().describe(), name)) << read.error().describe();
        }
      }
    }
  }
}

TEST_F(Network, ReadsTheFilesBesideItsOwnAndTellsAFailureFromAMissingOne) {
  std::map<std::string, std::string> files = files_;
  files["a.tif.aux.xml"] =
      "<PAMDataset><PAMRasterBand band=\"1\"><NoDataValue>5</NoDataValue></PAMRasterBand></PAMDataset>";
  CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", "1");
  for (const int status : {0, 403, 404, 500}) {
    const HttpServer server(files, [&](const std::string& name, int) {
      HttpFault fault;
      if (name == "a.tif.aux.xml") fault.status = status;
      return fault;
    });
    const auto read = readDem(server.address("a.tif"));
    ASSERT_EQ(read.has_value(), status != 500) << (read ? "" : read.error().describe());
    if (!read) {
      EXPECT_TRUE(contains(read.error().message, "a.tif.aux.xml: the server answers 500"))
          << read.error().describe();
      continue;
    }
    const auto& heights = std::get<RasterHeightfield>(read->heightfield).heights;
    EXPECT_EQ(std::isnan(heights[5]), status == 0) << status;
  }
}

TEST_F(Network, EndsSoonAfterTheSignal) {
  for (const int from : {1, 2}) {
    HttpServer server(files_, [&](const std::string&, int number) {
      HttpFault fault;
      fault.isStalled = number >= from;
      return fault;
    });
    for (const auto& [name, content] : files_) {
      std::atomic<bool> cancel = false;
      RunContext context;
      context.cancel = &cancel;
      std::thread signal([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        cancel = true;
      });
      const auto read = readDem("/vsicurl/" + server.address(name), {}, context);
      signal.join();
      ASSERT_FALSE(read) << name;
      EXPECT_EQ(read.error().code, ErrorCode::interrupted) << read.error().describe();
    }
  }
}

}  // namespace
}  // namespace arete
