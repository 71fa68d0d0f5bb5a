// SPDX-License-Identifier: GPL-3.0-or-later
//
// The structure of the sources: which room includes which (ARCHITECTURE.md). What is declared is read from
// the build (arete_room), what is there from the sources.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include "house/house.h"

namespace arete::house {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ARETE_SOURCE_FOLDER;
const std::vector<std::string> kLayers = {"engine", "measure", "surface", "terrain", "io",
                                          "gis",    "python",  "viewer",  "cli"};
/// The layers inside io/, each with those below it.
const std::map<std::string, std::set<std::string>> kBelow = {
    {"io/files", {}},
    {"io/store", {"io/files"}},
    {"io/geo", {"io/files"}},
    {"io/formats", {"io/files", "io/geo"}},
    {"io/query", {"io/files", "io/store", "io/geo", "io/formats"}}};

Rooms declaredRooms() {
  return readRooms(ARETE_ROOMS);
}

std::string layerOf(const std::string& room) {
  return room.substr(0, room.find('/'));
}

TEST(Rooms, IncludeOnlyTheRoomsTheyDeclare) {
  const Rooms rooms = declaredRooms();
  ASSERT_GT(rooms.size(), 30u);
  for (const std::string& sentence : undeclaredIncludes(rooms, kRoot)) ADD_FAILURE() << sentence;
}

TEST(Rooms, DeclareNoRoomTheyDoNotInclude) {
  for (const std::string& sentence : unusedDeclarations(declaredRooms(), kRoot)) ADD_FAILURE() << sentence;
}

TEST(Rooms, FormNoCircle) {
  EXPECT_TRUE(findCircle(declaredRooms()).empty())
      << fmt::format("{}", fmt::join(findCircle(declaredRooms()), " -> "));
}

TEST(Rooms, IncludeNoLayerAboveTheirOwn) {
  const auto rank = [](const std::string& room) {
    return std::ranges::find(kLayers, layerOf(room)) - kLayers.begin();
  };
  for (const auto& [room, declared] : declaredRooms())
    for (const std::string& other : declared)
      EXPECT_LE(rank(other), rank(room)) << room << " declares " << other;
}

TEST(Rooms, OfIoIncludeOnlyTheLayersBelowTheirOwn) {
  const auto layerOfIo = [](const std::string& room) {
    return room.substr(0, room.find('/', std::string("io/").size()));
  };
  for (const auto& [room, declared] : declaredRooms()) {
    if (layerOf(room) != "io") continue;
    const std::string own = layerOfIo(room);
    ASSERT_TRUE(kBelow.contains(own)) << room;
    for (const std::string& other : declared) {
      const bool isBelow =
          layerOf(other) != "io" || layerOfIo(other) == own || kBelow.at(own).contains(layerOfIo(other));
      EXPECT_TRUE(isBelow) << room << " declares " << other;
    }
  }
}

// What the bytes of a model are, is known without what builds it.
TEST(Rooms, OfStoreIncludeOfTerrainAndSurfacesTheModelAlone) {
  for (const auto& [room, declared] : declaredRooms()) {
    if (!room.starts_with("io/store")) continue;
    for (const std::string& other : declared) {
      const bool isModel = other == "terrain/model" || other == "surface/model";
      EXPECT_TRUE(isModel || (layerOf(other) != "terrain" && layerOf(other) != "surface"))
          << room << " declares " << other;
    }
  }
}

TEST(Rooms, NameThreadsInParallelAlone) {
  for (const std::string& layer : kLayers)
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / layer)) {
      if (!entry.is_regular_file() || entry.path().parent_path() == kRoot / "engine/parallel") continue;
      std::ifstream stream(entry.path());
      for (std::string line; std::getline(stream, line);)
        EXPECT_FALSE(line.starts_with("#include <") && line.find("tbb/") != line.npos)
            << entry.path() << ": " << line;
    }
}

// The two stand beside each other over engine/.
TEST(Rooms, OfTerrainAndSurfaceDoNotIncludeEachOther) {
  for (const auto& [room, declared] : declaredRooms())
    for (const std::string& other : declared) {
      const std::set<std::string> layers = {layerOf(room), layerOf(other)};
      EXPECT_FALSE(layers.contains("terrain") && layers.contains("surface")) << room << " declares " << other;
    }
}

TEST(Rooms, HoldEverySourceFileOfTheirLayer) {
  const Rooms rooms = declaredRooms();
  for (const std::string& layer : kLayers)
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / layer)) {
      const fs::path file = fs::relative(entry.path(), kRoot);
      if (file.extension() != ".h" && file.extension() != ".cpp") continue;
      EXPECT_TRUE(rooms.contains(file.parent_path().string()) || file == "cli/main.cpp" ||
                  file == "gis/plugin.cpp" || file == "python/module.cpp")
          << file;
    }
}

TEST(Rooms, HoldAtMostThirtySourceFilesEach) {
  std::vector<std::string> folders = {"bench", "bench/stages", "datasets", "examples"};
  for (const auto& [room, declared] : declaredRooms()) folders.push_back(room);
  for (const std::string& folder : folders) EXPECT_LE(filesOf(kRoot / folder).size(), 30u) << folder;
}

// The independence of the check: what measures shares nothing with what builds but the types that both speak
// of.
TEST(Rooms, OfMeasureIncludeTheModelAndBasicsAlone) {
  const std::set<std::string> allowed = {"terrain/model", "engine/base", "engine/parallel"};
  const Rooms rooms = declaredRooms();
  ASSERT_TRUE(rooms.contains("terrain/measure"));
  for (const std::string& other : rooms.at("terrain/measure"))
    EXPECT_TRUE(allowed.contains(other)) << "terrain/measure declares " << other;
}

TEST(Rooms, OfDistancesIncludeNeitherTerrainNorSurfaces) {
  for (const std::string& other : declaredRooms().at("measure"))
    EXPECT_TRUE(other == "engine/base" || other == "engine/parallel") << "measure declares " << other;
}

class PlantedRooms : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "arete-rooms-XXXXXX").string();
    root_ = mkdtemp(pattern.data());
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  void plant(const std::string& file, const std::string& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }

  fs::path root_;
};

TEST_F(PlantedRooms, AnUndeclaredIncludeIsFoundAndBothFilesAreNamed) {
  plant("engine/a/x.cpp", "#include <vector>\n\n#include \"engine/a/x.h\"\n#include \"engine/b/y.h\"\n");
  plant("engine/a/x.h", "#pragma once\n#include \"engine/c/z.h\"\n");
  plant("engine/b/y.h", "#pragma once\n");
  plant("engine/c/z.h", "#pragma once\n");
  plant("rooms.txt", "engine/a: engine/c\nengine/b: \nengine/c:\n");
  EXPECT_EQ(undeclaredIncludes(readRooms(root_ / "rooms.txt"), root_),
            std::vector<std::string>{
                "engine/a/x.cpp includes engine/b/y.h, but engine/a does not declare engine/b"});
}

TEST_F(PlantedRooms, ACircleIsFoundAndItsRoomsAreNamed) {
  const Rooms rooms = {{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}, {"d", {}}};
  EXPECT_EQ(findCircle(rooms), (std::vector<std::string>{"b", "c", "b"}));
  EXPECT_TRUE(findCircle({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {}}}).empty());
}

}  // namespace
}  // namespace arete::house
