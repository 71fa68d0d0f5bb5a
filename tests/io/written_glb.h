// SPDX-License-Identifier: GPL-3.0-or-later
//
// GLB files that the writer made, looked at without Arete's reader.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/formats/glb/glb.h"
#include "io/glb_fixture.h"
#include "io/mesh_fixture.h"
#include "surface/model/surface_mesh.h"

namespace arete::test {

/// Two triangles over a square.
inline SurfaceMesh square() {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 1}, {1, 0, 2}, {0, 1, 3}, {1, 1, 4}};
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
  return mesh;
}

inline Attribute attribute(const char* name, AttributeMeaning meaning, ScalarType type,
                           std::uint8_t components, const std::vector<double>& numbers) {
  Attribute a{.name = name, .meaning = meaning, .type = type, .components = components};
  for (std::size_t i = 0; i < numbers.size(); i += components)
    a.append(std::span(numbers).subspan(i, components));
  return a;
}

/// A GLB that was written, as its JSON and its bytes.
class Written {
 public:
  explicit Written(const SurfaceMesh& mesh, const MeshWriteOptions& options = {.up = MeshUp::y}) {
    const std::string path = folder_.file("a.glb");
    const Result<MeshWriteReport> report = writeGlb(mesh, path, options);
    if (!report) {
      ADD_FAILURE() << report.error().describe();
      return;
    }
    lost = report->lost;
    const std::string glb = bytesOf(path);
    json = jsonOf(glb);
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, 4);
    if (glb.size() > 28 + length) bin_ = glb.substr(28 + length);
    for (const Json& accessor : json.value("accessors", Json::array())) checkAccessor(accessor);
  }

  /// The numbers of an accessor, element by element.
  std::vector<double> numbers(std::size_t accessor) const {
    const Json& a = json["accessors"][accessor];
    const Json& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t size = sizeOfComponent(a), count = a["count"], n = components(a);
    const std::size_t stride = view.value("byteStride", size * n), begin = view["byteOffset"];
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < n; ++k)
        result.push_back(number(begin + i * stride + k * size, a["componentType"]));
    return result;
  }
  const Json& primitive(std::size_t mesh = 0, std::size_t p = 0) const {
    return json["meshes"][mesh]["primitives"][p];
  }
  const Json& accessorOf(const char* semantic) const {
    return json["accessors"][primitive()["attributes"].at(semantic).get<std::size_t>()];
  }
  std::vector<double> numbersOf(const char* semantic, std::size_t mesh = 0) const {
    return numbers(primitive(mesh)["attributes"].at(semantic).get<std::size_t>());
  }
  std::vector<double> indices(std::size_t mesh = 0, std::size_t p = 0) const {
    return numbers(primitive(mesh, p)["indices"].get<std::size_t>());
  }
  bool hasLost(const std::string& part) const {
    return std::ranges::any_of(lost, [&](const std::string& what) { return what.find(part) != what.npos; });
  }
  std::string bytesOfView(std::size_t view) const {
    return bin_.substr(json["bufferViews"][view]["byteOffset"], json["bufferViews"][view]["byteLength"]);
  }

  Json json;
  std::vector<std::string> lost;

 private:
  static std::size_t components(const Json& accessor) {
    static const std::map<std::string, std::size_t> kCounts = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3},
                                                               {"VEC4", 4},   {"MAT3", 9}, {"MAT4", 16}};
    return kCounts.at(accessor["type"]);
  }
  static std::size_t sizeOfComponent(const Json& accessor) {
    const int type = accessor["componentType"];
    return type <= 5121 ? 1 : type <= 5123 ? 2 : 4;
  }
  double number(std::size_t at, int type) const {
    const auto as = [&](auto value) {
      std::memcpy(&value, bin_.data() + at, sizeof value);
      return double(value);
    };
    switch (type) {
      case 5120:
        return as(std::int8_t());
      case 5121:
        return as(std::uint8_t());
      case 5122:
        return as(std::int16_t());
      case 5123:
        return as(std::uint16_t());
      case 5125:
        return as(std::uint32_t());
      default:
        return double(as(float()));
    }
  }
  /// What the standard requires of every accessor: alignment, and bytes within the buffer.
  void checkAccessor(const Json& a) const {
    const Json& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t tight = sizeOfComponent(a) * components(a);
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
    EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(), bin_.size());
    if (view["target"] == 34962) {
      EXPECT_EQ(view.value("byteStride", tight) % 4, 0u) << a;
    } else {
      EXPECT_FALSE(view.contains("byteStride"));
    }
    EXPECT_EQ(view["byteLength"].get<std::size_t>(),
              a["count"].get<std::size_t>() * view.value("byteStride", tight));
  }

  TemporaryFolder folder_;
  std::string bin_;
};

}  // namespace arete::test
