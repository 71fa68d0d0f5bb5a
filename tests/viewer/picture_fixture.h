// SPDX-License-Identifier: GPL-3.0-or-later
//
// Heightfields, files and meshes for the tests of pictures.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <ostream>
#include <string>

#include "engine/base/triangle_mesh.h"
#include "terrain/model/heightfield.h"
#include "viewer/picture/picture.h"

namespace arete {

inline void PrintTo(const Rgb& c, std::ostream* out) {
  *out << "(" << int(c.r) << ", " << int(c.g) << ", " << int(c.b) << ")";
}

namespace test {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

template <class Height>
RasterHeightfield field(std::uint32_t columns, std::uint32_t rows, const Height& height) {
  RasterHeightfield h;
  h.columns = columns;
  h.rows = rows;
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) h.heights.push_back(height(c, r));
  }
  return h;
}

/// A CRS by name only: the viewer asks whether there is one, never what it says.
inline RasterHeightfield located(RasterHeightfield h, double cell, bool southUp = false) {
  h.georeference.crsWkt = "LOCAL_CS[\"metres\"]";
  h.georeference.hasGeoTransform = true;
  h.georeference.geoTransform = {1000, cell, 0, 5000, 0, southUp ? cell : -cell};
  return h;
}

class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("arete_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::size_t files() const {
    return std::size_t(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

inline std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::uint32_t bigEndian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::uint8_t(bytes[at + i]);
  return value;
}

inline RasterHeightfield hills() {
  return located(
      field(120, 80, [](double c, double r) { return 300 + 120 * std::sin(c / 9) * std::cos(r / 11); }), 30);
}

/// Every cell in two triangles.
inline TriangleMesh finest(const RasterHeightfield& h) {
  TriangleMesh mesh;
  for (std::uint32_t r = 0; r < h.rows; ++r) {
    for (std::uint32_t c = 0; c < h.columns; ++c) {
      const Vec2 p = h.georeference.toSource(c, r);
      mesh.positions.push_back({p.x, p.y, h.at(c, r)});
      if (r + 1 == h.rows || c + 1 == h.columns) continue;
      const std::uint32_t ul = h.index(c, r), ll = ul + h.columns;
      mesh.triangles.push_back({ul, ll, ll + 1});
      mesh.triangles.push_back({ul, ll + 1, ul + 1});
    }
  }
  return mesh;
}

}  // namespace test
}  // namespace arete
