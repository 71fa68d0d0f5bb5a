// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL gets no path that was not rewritten for the network (io/geo/network/network_path.h): an address in it
// would be read by GDAL's own handler, which checks nothing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "house/house.h"

namespace arete::house {
namespace {

namespace fs = std::filesystem;

/// The calls in a source whose first argument does not say that it is served: "line: call".
std::vector<std::string> callsWithoutServing(const std::string& source) {
  static const std::regex pattern(
      "(VSIFOpenL|VSIFOpenExL|VSIStatL|VSIStatExL|VSIReadDirRecursive|VSIReadDir|VSIIngestFile|"
      "GDALIdentifyDriverEx|GDALDataset::Open|GDALOpenEx|GDALOpen)\\(([^;]*)");
  std::vector<std::string> calls;
  for (std::sregex_iterator match(source.begin(), source.end(), pattern), end; match != end; ++match) {
    const std::string arguments = (*match)[2];
    if (arguments.find("served") < arguments.find("\"rb\"")) continue;
    const auto line = 1 + std::count(source.begin(), source.begin() + match->position(0), '\n');
    calls.push_back(fmt::format("{}: {}", line, (*match)[1].str()));
  }
  return calls;
}

TEST(ServedPaths, AreWhatGdalGets) {
  // They open what they have written themselves, pictures in memory, and folders.
  constexpr std::array<std::string_view, 4> kOfOwnFiles = {
      "io/geo/dem/raster_writer.cpp", "io/geo/dem/dem_files.cpp", "io/geo/geopackage/geopackage.cpp",
      "io/formats/common/picture_pixels.cpp"};
  const fs::path root = ARETE_SOURCE_FOLDER;
  int seen = 0;
  for (const char* layer : {"io", "gis", "python", "viewer", "cli", "datasets"})
    for (const auto& entry : fs::recursive_directory_iterator(root / layer)) {
      const std::string name = fs::relative(entry.path(), root).string();
      if (entry.path().extension() != ".cpp" || name.starts_with("io/geo/network/") ||
          std::ranges::find(kOfOwnFiles, name) != kOfOwnFiles.end())
        continue;
      std::ifstream stream(entry.path(), std::ios::binary);
      const std::string source{std::istreambuf_iterator<char>(stream), {}};
      ++seen;
      for (const std::string& call : callsWithoutServing(source)) ADD_FAILURE() << name << ':' << call;
    }
  EXPECT_GT(seen, 200);
}

TEST(ServedPaths, AreMissedWhereTheyAreNot) {
  EXPECT_EQ(callsWithoutServing("\n x = VSIFOpenL(path.c_str(), \"rb\");"),
            std::vector<std::string>{"2: VSIFOpenL"});
  EXPECT_EQ(callsWithoutServing("VSIStatL(servedPath(path).c_str(), &status);"), std::vector<std::string>());
}

}  // namespace
}  // namespace arete::house
