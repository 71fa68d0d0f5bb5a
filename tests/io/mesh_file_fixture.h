// SPDX-License-Identifier: GPL-3.0-or-later
//
// A folder of mesh files, and a small mesh of awkward numbers, for the tests of the formats that hold
// doubles.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "io/formats/exchange/mesh_formats.h"

namespace arete::test {

namespace fs = std::filesystem;

inline const std::string kWkt =
    R"(PROJCRS["WGS 84 / UTM zone 11N",BASEGEOGCRS["WGS 84",ID["EPSG",4326]],ID["EPSG",32611]])";

class MeshFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("arete-mesh-" + std::to_string(::getpid()) + "-" +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path put(const std::string& name, std::string_view text) const {
    const fs::path path = folder_ / name;
    // Cutting an old file to zero length makes some file systems wait for the disk.
    fs::remove(path);
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  static std::string contents(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }

  /// What reading `text` says is wrong. A culprit other than the file fails the test.
  Error refusal(const std::string& name, std::string_view text) const {
    const fs::path path = put(name, text);
    const Result<MeshFile> file = readMesh(path);
    if (file) {
      ADD_FAILURE() << "was read: " << text.substr(0, 200);
      return {};
    }
    EXPECT_EQ(file.error().culprit, path.string());
    EXPECT_FALSE(file.error().message.empty());
    return file.error();
  }

  /// A small mesh of awkward numbers.
  static TriangleMesh awkward() {
    TriangleMesh mesh;
    mesh.positions = {{376313.65545, 3807917.82763, 315.1},
                      {1.0 / 3, -0.0, 5e-324},
                      {1.7976931348623157e308, -2.2250738585072014e-308, 0.1},
                      {123456789.123456789, 1e22, -17.5}};
    mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
    return mesh;
  }

  static void expectSameBits(const TriangleMesh& a, const TriangleMesh& b) {
    ASSERT_EQ(a.positions.size(), b.positions.size());
    EXPECT_TRUE(std::ranges::equal(a.positions, b.positions, [](const Vec3& p, const Vec3& q) {
      return std::memcmp(&p, &q, sizeof p) == 0;
    }));
    EXPECT_EQ(a.triangles, b.triangles);
  }

  fs::path folder_;
};

}  // namespace arete::test
