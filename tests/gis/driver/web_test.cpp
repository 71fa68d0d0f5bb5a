// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models on a server: the pixels of the plain file, or a failure.
#include <cpl_conv.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "gis/driver/driver_fixture.h"
#include "io/http_server.h"

namespace arete {
namespace {

class WebDriver : public test::DriverFixture {
 protected:
  void SetUp() override { CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", "0"); }
  void TearDown() override { CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", nullptr); }

  std::string bytesOfHills() const {
    std::ifstream file(terrain("hills.amt", 300, 200, hills), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// Empty where it cannot be read.
  static std::vector<double> window(GDALDataset& dataset, int left, int top) {
    std::vector<double> heights(30 * 20, -1);
    CPLPushErrorHandler(CPLQuietErrorHandler);
    const CPLErr read = dataset.GetRasterBand(1)->RasterIO(GF_Read, left, top, 30, 20, heights.data(), 30, 20,
                                                           GDT_Float64, 0, 0, nullptr);
    CPLPopErrorHandler();
    return read == CE_None ? heights : std::vector<double>();
  }
};

TEST_F(WebDriver, GivesThePixelsOfThePlainFile) {
  const test::HttpServer server({{"hills.amt", bytesOfHills()}}, {});
  const test::Dataset local = open(folder().file("hills.amt")),
                      remote = open("/vsicurl/" + server.address("hills.amt"));
  ASSERT_TRUE(remote) << message();
  EXPECT_EQ(remote->GetRasterXSize(), local->GetRasterXSize());
  for (const auto& [left, top] : {std::pair(0, 0), {100, 90}, {270, 180}}) {
    const std::vector<double> mine = window(*remote, left, top), its = window(*local, left, top);
    ASSERT_EQ(mine.size(), 600u);
    EXPECT_EQ(std::memcmp(mine.data(), its.data(), mine.size() * sizeof(double)), 0) << left;
  }
}

TEST_F(WebDriver, FailsWhereTheServerStopsAnswering) {
  std::atomic<bool> isDown = false;
  const test::HttpServer server({{"hills.amt", bytesOfHills()}}, [&](const std::string&, int) {
    test::HttpFault fault;
    if (isDown) fault.status = 503;
    return fault;
  });
  const test::Dataset dataset = open("/vsicurl/" + server.address("hills.amt"));
  ASSERT_TRUE(dataset) << message();
  isDown = true;
  EXPECT_TRUE(window(*dataset, 100, 90).empty());
  isDown = false;
  EXPECT_TRUE(window(*dataset, 100, 90).empty()) << "nothing is asked for again";
}

}  // namespace
}  // namespace arete
