// SPDX-License-Identifier: GPL-3.0-or-later
//
// GLB files made by hand, for the tests of io/formats/glb.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/base/triangle_mesh.h"

namespace arete::test {

using Json = nlohmann::json;

inline const TriangleMesh kTwo = {{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}, {1, 1, 4}}, {{0, 1, 2}, {2, 1, 3}}};

/// The same with y up, as a glTF has it.
inline const TriangleMesh kTwoYUp = {{{0, 1, 0}, {1, 2, 0}, {0, 3, -1}, {1, 4, -1}}, kTwo.triangles};

inline std::string glbOf(const std::string& json, const std::string& bytes) {
  std::string text = json;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string glb = "glTF";
  const auto put = [&](std::size_t value) {
    const auto number = static_cast<std::uint32_t>(value);
    glb.append(reinterpret_cast<const char*>(&number), 4);
  };
  put(2);
  put(12 + 8 + text.size() + (bytes.empty() ? 0 : 8 + bytes.size()));
  put(text.size());
  glb += "JSON" + text;
  if (bytes.empty()) return glb;
  put(bytes.size());
  return glb + std::string("BIN\0", 4) + bytes;
}

template <class T>
std::string packed(const std::vector<T>& values) {
  std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
  return bytes;
}

/// Four vertices of a square and two triangles over it, as another program might write them.
struct Foreign {
  Json json = {
      {"asset", {{"version", "2.0"}}},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
      {"accessors",
       {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
        {{"bufferView", 1}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteLength", 48}}, {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 12}}}},
      {"buffers", {{{"byteLength", 60}}}},
  };
  // x, height, -y
  std::string bytes =
      packed<float>({0, 1, 0, 1, 2, 0, 0, 3, -1, 1, 4, -1}) + packed<std::uint16_t>({0, 1, 2, 2, 1, 3});
  std::string glb() const { return glbOf(json.dump(), bytes); }
};

/// The glTF number of a type of numbers.
template <class T>
constexpr int componentTypeOf() {
  if constexpr (std::is_same_v<T, std::int8_t>) return 5120;
  if constexpr (std::is_same_v<T, std::uint8_t>) return 5121;
  if constexpr (std::is_same_v<T, std::int16_t>) return 5122;
  if constexpr (std::is_same_v<T, std::uint16_t>) return 5123;
  if constexpr (std::is_same_v<T, std::uint32_t>) return 5125;
  return 5126;
}

/// A glTF that is put together piece by piece: one node, one mesh, one primitive, until a test changes it.
struct Assembled {
  Json json = {
      {"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},      {"meshes", {{{"primitives", {{{"attributes", Json::object()}}}}}}},
      {"accessors", Json::array()},    {"bufferViews", Json::array()}};
  std::string bytes;

  /// @return the number of a view of these bytes.
  std::size_t view(const std::string& of, std::size_t stride = 0) {
    Json added = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", of.size()}};
    if (stride > 0) added["byteStride"] = stride;
    json["bufferViews"].push_back(added);
    bytes += of;
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    return json["bufferViews"].size() - 1;
  }
  /// @return the number of an accessor of these numbers.
  template <class T>
  std::size_t add(const std::vector<T>& values, const std::string& type, bool normalized = false) {
    const std::size_t last = type == "SCALAR" ? 1 : std::size_t(type.back() - '0');
    const std::size_t components = type.starts_with("MAT") ? last * last : last;
    Json added = {{"bufferView", view(std::string(reinterpret_cast<const char*>(values.data()),
                                                  values.size() * sizeof(T)))},
                  {"componentType", componentTypeOf<T>()},
                  {"count", values.size() / components},
                  {"type", type}};
    if (normalized) added["normalized"] = true;
    json["accessors"].push_back(added);
    return json["accessors"].size() - 1;
  }
  Json& primitive(std::size_t p = 0) { return json["meshes"][0]["primitives"][p]; }
  Json& attributes(std::size_t p = 0) { return primitive(p)["attributes"]; }

  std::string glb() const {
    Json whole = json;
    if (!bytes.empty()) whole["buffers"] = {{{"byteLength", bytes.size()}}};
    return glbOf(whole.dump(), bytes);
  }
};

/// One triangle in the plane z = 0, seen from +z.
inline Assembled oneTriangle() {
  Assembled made;
  made.attributes()["POSITION"] = made.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  return made;
}

inline Json jsonOf(const std::string& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  return Json::parse(glb.substr(20, length));
}

}  // namespace arete::test
