// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace arete {

/// Numbers of the standard.
struct GltfCode {
  static constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                       kUnsignedInt = 5125, kFloat = 5126;
  static constexpr int kVertexData = 34962, kIndexData = 34963;
};

/// Plans the one buffer of a glTF: its views, one for each array, and the accessors of those.
class BufferPlan {
 public:
  using Json = nlohmann::ordered_json;

  Json views = Json::array(), accessors = Json::array();
  std::uint64_t size = 0;

  /// Adds an array with an accessor.
  /// @param stride From one element to the next: bytesEach, or more.
  /// @return The number of the accessor.
  std::size_t add(std::size_t count, std::size_t bytesEach, std::size_t stride, int target, int component,
                  const char* type) {
    views.push_back(
        {{"buffer", 0}, {"byteOffset", size}, {"byteLength", count * stride}, {"target", target}});
    if (stride != bytesEach) views.back()["byteStride"] = stride;
    accessors.push_back(
        {{"bufferView", views.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
    size += count * stride;
    return accessors.size() - 1;
  }

  /// Adds bytes of another kind. @return The number of the view.
  std::size_t addBytes(std::size_t count) {
    views.push_back({{"buffer", 0}, {"byteOffset", size}, {"byteLength", count}});
    size += count;
    return views.size() - 1;
  }

  /// Ends an array so that the next one begins at a multiple of four bytes, as the standard requires.
  /// @return The bytes to add, zeros.
  std::size_t align() {
    const std::size_t padding = (4 - size % 4) % 4;
    size += padding;
    return padding;
  }
};

}  // namespace arete
