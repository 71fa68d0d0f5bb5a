// SPDX-License-Identifier: GPL-3.0-or-later
// arete-datasets as a user meets it: arguments in, files and exit codes out. Fetching is tried on a mirror
// that the test makes, so that no network is needed.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/geo/dem/raster_reader.h"
#include "io/geo/dem/raster_writer.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

class DatasetsProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("arete-" + std::string(test->name()) + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  int run(const std::string& arguments) const {
    const std::string command = std::string("'" ARETE_DATASETS_PROGRAM "' ") + arguments + " >'" +
                                path("out") + "' 2>'" + path("err") + "' </dev/null";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string contentOf(const std::string& name) const {
    std::ifstream file(path(name));
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// A tile of one degree, 100 samples a side, in the place where the publisher would have it.
  void publish(const std::string& tile, double west, double north, double height) const {
    const std::string folder = path("mirror/Copernicus_DSM_COG_10_" + tile + "_DEM");
    fs::create_directories(folder);
    Georeference georeference;
    georeference.geoTransform = {west, 0.01, 0, north, 0, -0.01};
    georeference.hasGeoTransform = true;
    const std::vector<double> heights(100 * 100, height);
    ASSERT_TRUE(writeGeoTiff(folder + "/Copernicus_DSM_COG_10_" + tile + "_DEM.tif", 100, 100, heights,
                             georeference));
  }

  fs::path folder_;
};

TEST_F(DatasetsProgram, GeneratesADemThatReadsBack) {
  ASSERT_EQ(run("generate --columns 97 --rows 65 --seed 3 -o '" + path("dem.tif") + "'"), 0)
      << contentOf("err");
  const auto read = readRaster(path("dem.tif"));
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_EQ(read->heightfield.columns, 97u);
  EXPECT_EQ(read->heightfield.rows, 65u);
  EXPECT_EQ(read->heightfield.georeference.verticalUnit, "m");
  EXPECT_NE(contentOf("out").find(heightsChecksum(read->heightfield)), std::string::npos) << contentOf("out");
  EXPECT_EQ(contentOf("err"), "");
}

TEST_F(DatasetsProgram, ListsTheCatalogueAsJson) {
  ASSERT_EQ(run("list --json"), 0);
  const auto list = nlohmann::json::parse(contentOf("out"));
  ASSERT_FALSE(list.empty());
  EXPECT_EQ(list[0]["name"], "copernicus-glo30");
}

TEST_F(DatasetsProgram, FetchesABoxAcrossTilesAndLeavesTheSeaOut) {
  publish("N10_00_E020_00", 20, 11, 100);
  publish("N10_00_E021_00", 21, 11, 200);
  publish("N11_00_E020_00", 20, 12, 300);
  ASSERT_EQ(run("fetch copernicus-glo30 --bbox 20.5,10.5,21.5,11.5 --mirror '" + path("mirror") + "' -o '" +
                path("box.tif") + "'"),
            0)
      << contentOf("err");
  EXPECT_NE(contentOf("err").find("N11_00_E021"), std::string::npos) << "the missing tile is not named";
  const auto read = readRaster(path("box.tif"));
  ASSERT_TRUE(read) << read.error().describe();
  const RasterHeightfield& field = read->heightfield;
  ASSERT_EQ(field.columns, 100u);
  ASSERT_EQ(field.rows, 100u);
  EXPECT_EQ(field.at(10, 90), 100);
  EXPECT_EQ(field.at(90, 90), 200);
  EXPECT_EQ(field.at(10, 10), 300);
  EXPECT_TRUE(std::isnan(field.at(90, 10)));
}

TEST_F(DatasetsProgram, SaysWhenNothingCanBeFetchedAndLeavesNoFile) {
  EXPECT_EQ(run("fetch matterhorn --mirror '" + path("nowhere") + "' -o '" + path("box.tif") + "'"), 3);
  EXPECT_NE(contentOf("err").find("matterhorn"), std::string::npos);
  EXPECT_FALSE(fs::exists(path("box.tif")));
}

TEST_F(DatasetsProgram, RefusesCommandLinesThatMakeNoSense) {
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run("generate"), 2);
  EXPECT_EQ(run("generate --size 3 -o '" + path("dem.tif") + "'"), 2);
  EXPECT_EQ(run("fetch copernicus-glo30 -o '" + path("dem.tif") + "'"), 2);
  EXPECT_EQ(run("fetch atlantis -o '" + path("dem.tif") + "'"), 2);
  EXPECT_FALSE(fs::exists(path("dem.tif")));
}

TEST_F(DatasetsProgram, SaysWhenTheOutputCannotBeWritten) {
  EXPECT_EQ(run("generate --size 32 -o '" + path("no/such/folder/dem.tif") + "'"), 3);
  EXPECT_NE(contentOf("err").find("no/such/folder"), std::string::npos) << contentOf("err");
}

}  // namespace
}  // namespace arete
