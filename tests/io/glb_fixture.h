// SPDX-License-Identifier: GPL-3.0-or-later
//
// GLB files made by hand, for the tests of io/mesh/glb.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/base/triangle_mesh.h"

namespace arete::test {

using Json = nlohmann::json;

inline const TriangleMesh kTwo = {{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}, {1, 1, 4}}, {{0, 1, 2}, {2, 1, 3}}};

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

inline Json jsonOf(const std::string& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  return Json::parse(glb.substr(20, length));
}

}  // namespace arete::test
