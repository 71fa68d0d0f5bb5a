// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's encoders have a version as a global variable: EXT_meshopt_compression wants 1 for indices,
// which is set once, and 0 for vertices, which is the default.
#include "io/formats/glb/packing/meshopt_streams.h"

#include <meshoptimizer.h>

#include <mutex>

namespace arete {

std::vector<std::uint32_t> orderForCache(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
  std::vector<std::uint32_t> ordered(indices.size());
  meshopt_optimizeVertexCacheStrip(ordered.data(), indices.data(), indices.size(), vertices);
  return ordered;
}

std::vector<std::uint32_t> orderOfFirstUse(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
  std::vector<std::uint32_t> numberOf(vertices);
  auto next = static_cast<std::uint32_t>(
      meshopt_optimizeVertexFetchRemap(numberOf.data(), indices.data(), indices.size(), vertices));
  for (std::uint32_t& number : numberOf)
    if (number == ~0U) number = next++;
  return numberOf;
}

std::string encodeMeshoptVertices(const std::string& bytes, std::size_t count, std::size_t stride) {
  std::string encoded(meshopt_encodeVertexBufferBound(count, stride), '\0');
  encoded.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(encoded.data()), encoded.size(),
                                            bytes.data(), count, stride));
  return encoded;
}

std::string encodeMeshoptTriangles(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
  static std::once_flag once;
  std::call_once(once, [] { meshopt_encodeIndexVersion(1); });
  std::string encoded(meshopt_encodeIndexBufferBound(indices.size(), vertices), '\0');
  encoded.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(encoded.data()), encoded.size(),
                                           indices.data(), indices.size()));
  return encoded;
}

std::string encodeOctahedral(std::span<const std::array<float, 4>> vectors) {
  constexpr std::size_t kStride = 4;
  constexpr int kBits = 8;
  std::string encoded(vectors.size() * kStride, '\0');
  if (!vectors.empty())
    meshopt_encodeFilterOct(encoded.data(), vectors.size(), kStride, kBits, vectors.front().data());
  return encoded;
}

}  // namespace arete
