// SPDX-License-Identifier: GPL-3.0-or-later
//
// A program that links io/store alone: it reads models of both kinds, and nothing that reads DEMs or builds
// comes with it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "io/store/amt/surface_file.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

TEST(StoreAlone, ReadsModelsOfBothKinds) {
  int terrain = 0, surfaces = 0;
  for (const char* kind : {"amt", "surface_amt"})
    for (const auto& entry : fs::directory_iterator(fs::path(ARETE_CORPUS) / kind)) {
      const std::string path = entry.path().string();
      Result<AmtContainer> file = AmtContainer::open(path);
      if (!file) continue;  // most of the corpus is damaged
      if (file->isOfSurface()) {
        const Result<SurfaceModel> model = loadSurfaceAmt(*file);
        surfaces += model && model->mt.finestTriangleCount() > 0 ? 1 : 0;
      } else {
        const Result<TerrainModel> model = loadAmt(path);
        terrain += model && model->mt.finestTriangleCount() > 0 ? 1 : 0;
      }
    }
  EXPECT_GT(terrain, 0);
  EXPECT_GT(surfaces, 0);
}

TEST(StoreAlone, LoadsNoLibraryThatReadsDemsOrBuilds) {
  std::ifstream maps("/proc/self/maps");
  if (!maps) GTEST_SKIP() << "/proc/self/maps cannot be read";
  for (std::string line; std::getline(maps, line);)
    for (const char* library :
         {"libgdal", "libproj", "libsqlite3", "libdraco", "libmeshopt", "libgmp", "libmpfr", "libembree"})
      EXPECT_EQ(line.find(library), line.npos) << line;
}

}  // namespace
}  // namespace arete
