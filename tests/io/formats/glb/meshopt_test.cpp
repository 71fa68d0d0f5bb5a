// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's own encoders make the bytes.
#include "io/formats/glb/meshopt.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <set>
#include <vector>

namespace arete {
namespace {

std::string attributesOf(const std::string& elements, std::size_t stride) {
  std::string bytes(meshopt_encodeVertexBufferBound(elements.size() / stride, stride), '\0');
  bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                          elements.data(), elements.size() / stride, stride));
  return bytes;
}

std::string elementsOf(std::size_t count, std::size_t stride) {
  std::string elements;
  for (std::size_t i = 0; i < count * stride; ++i)
    elements += static_cast<char>(i / stride * (i % stride + 1) + i % 3);
  return elements;
}

std::vector<unsigned> gridIndices(unsigned side) {
  std::vector<unsigned> indices;
  for (unsigned y = 0; y < side; ++y)
    for (unsigned x = 0; x < side; ++x) {
      const unsigned a = y * (side + 1) + x, b = a + side + 1;
      indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  return indices;
}

std::string trianglesOf(const std::vector<unsigned>& indices) {
  std::string bytes(meshopt_encodeIndexBufferBound(indices.size(), 100000), '\0');
  bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                         indices.data(), indices.size()));
  return bytes;
}

std::string sequenceOf(const std::vector<unsigned>& indices) {
  std::string bytes(meshopt_encodeIndexSequenceBound(indices.size(), 100000), '\0');
  bytes.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                           indices.data(), indices.size()));
  return bytes;
}

unsigned indexAt(const std::string& bytes, std::size_t i, std::size_t stride) {
  unsigned index = 0;
  std::memcpy(&index, bytes.data() + i * stride, stride);
  return index;
}

std::multiset<std::array<unsigned, 3>> cyclic(const std::vector<unsigned>& indices) {
  std::multiset<std::array<unsigned, 3>> triangles;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    std::array t{indices[i], indices[i + 1], indices[i + 2]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.insert(t);
  }
  return triangles;
}

TEST(Meshopt, DecodesAttributesOfEveryStride) {
  for (std::size_t stride = 4; stride <= 256; stride += 4)
    for (const std::size_t count : {1, 15, 16, 17, 1000}) {
      const std::string elements = elementsOf(count, stride);
      const auto decoded = decodeMeshopt(attributesOf(elements, stride), count, stride, "ATTRIBUTES", "NONE");
      ASSERT_TRUE(decoded) << decoded.error().message;
      EXPECT_EQ(*decoded, elements) << stride << " " << count;
    }
}

TEST(Meshopt, DecodesConstantAttributes) {  // that take the fewest bytes
  for (const std::size_t stride : {4, 12, 16, 64, 256}) {
    const std::string elements(100'000 * stride, 'x');
    const auto decoded = decodeMeshopt(attributesOf(elements, stride), 100'000, stride, "ATTRIBUTES", "");
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(*decoded, elements);
  }
}

TEST(Meshopt, DecodesTrianglesAndSequences) {
  const std::vector<unsigned> indices = gridIndices(40);
  for (const std::size_t stride : {2, 4}) {
    const auto triangles = decodeMeshopt(trianglesOf(indices), indices.size(), stride, "TRIANGLES", "");
    ASSERT_TRUE(triangles) << triangles.error().message;
    std::vector<unsigned> found;
    for (std::size_t i = 0; i < indices.size(); ++i) found.push_back(indexAt(*triangles, i, stride));
    EXPECT_EQ(cyclic(found), cyclic(indices)) << "a triangle may begin at another corner, but not turn";
    const auto sequence = decodeMeshopt(sequenceOf(indices), indices.size(), stride, "INDICES", "NONE");
    ASSERT_TRUE(sequence) << sequence.error().message;
    for (std::size_t i = 0; i < indices.size(); ++i) ASSERT_EQ(indexAt(*sequence, i, stride), indices[i]);
  }
}

// zeux/meshoptimizer, issue 202: the filter of a count that is no multiple of 4.
TEST(Meshopt, AppliesFilters) {
  constexpr std::size_t kCount = 7;
  std::vector<float> units, any;
  for (std::size_t i = 0; i < kCount; ++i) {
    const float a = float(i) / 2, b = float(i) / 3;
    for (const float value : {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b), 0.0F})
      units.push_back(value);
    for (const float value : {a, b * 100, -a / 1000, 0.0F}) any.push_back(value);
  }
  for (const std::size_t stride : {4, 8}) {
    std::string elements(kCount * stride, '\0');
    const int bits = stride == 4 ? 8 : 16;
    meshopt_encodeFilterOct(elements.data(), kCount, stride, bits, units.data());
    const auto decoded =
        decodeMeshopt(attributesOf(elements, stride), kCount, stride, "ATTRIBUTES", "OCTAHEDRAL");
    ASSERT_TRUE(decoded) << decoded.error().message;
    for (std::size_t i = 0; i < kCount; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        std::int16_t wide = 0;
        std::memcpy(&wide, decoded->data() + i * stride + k * 2, stride == 4 ? 1 : 2);
        const double value =
            stride == 4 ? static_cast<std::int8_t>((*decoded)[i * 4 + k]) / 127.0 : wide / 32767.0;
        EXPECT_NEAR(value, units[4 * i + k], stride == 4 ? 0.02 : 1e-4);
      }
  }
  std::string elements(kCount * 8, '\0');
  meshopt_encodeFilterQuat(elements.data(), kCount, 8, 16, units.data());
  const auto quaternions = decodeMeshopt(attributesOf(elements, 8), kCount, 8, "ATTRIBUTES", "QUATERNION");
  ASSERT_TRUE(quaternions) << quaternions.error().message;
  for (std::size_t i = 0; i < kCount; ++i) {
    std::array<std::int16_t, 4> q{};
    std::memcpy(q.data(), quaternions->data() + 8 * i, 8);
    double dot = 0;
    for (std::size_t k = 0; k < 4; ++k) dot += q[k] / 32767.0 * double{units[4 * i + k]};
    EXPECT_NEAR(std::abs(dot), 1, 1e-3) << "the same rotation, of either sign";
  }
  std::string exponents(kCount * 16, '\0');
  meshopt_encodeFilterExp(exponents.data(), kCount, 16, 24, any.data());
  const auto floats = decodeMeshopt(attributesOf(exponents, 16), kCount, 16, "ATTRIBUTES", "EXPONENTIAL");
  ASSERT_TRUE(floats) << floats.error().message;
  for (std::size_t i = 0; i < any.size(); ++i) {
    float value = 0;
    std::memcpy(&value, floats->data() + 4 * i, 4);
    EXPECT_NEAR(value, any[i], 1e-4);
  }
}

TEST(Meshopt, RefusesWhatTheModeDoesNotAllow) {
  const std::string attributes = attributesOf(elementsOf(32, 16), 16);
  const std::string triangles = trianglesOf(gridIndices(4)), sequence = sequenceOf(gridIndices(4));
  std::string later = attributes;
  later[0] = '\xA1';
  struct Case {
    std::string source;
    std::uint64_t count, stride;
    const char *mode, *filter;
    ErrorCode code;
  };
  const ErrorCode corrupt = ErrorCode::corrupt, unsupported = ErrorCode::unsupported;
  const std::vector<Case> cases = {
      {attributes, 32, 0, "ATTRIBUTES", "NONE", corrupt},
      {attributes, 32, 6, "ATTRIBUTES", "NONE", corrupt},
      {attributes, 32, 260, "ATTRIBUTES", "NONE", corrupt},
      {attributes, 32, 16, "ATTRIBUTES", "OCTAHEDRAL", corrupt},
      {attributes, 32, 16, "ATTRIBUTES", "QUATERNION", corrupt},
      {attributes, 32, 16, "ATTRIBUTES", "COLOR", unsupported},
      {attributes, 32, 16, "POINTS", "NONE", unsupported},
      {later, 32, 16, "ATTRIBUTES", "NONE", unsupported},
      {attributes, 200, 16, "ATTRIBUTES", "NONE", corrupt},
      {attributes, std::uint64_t{1} << 40, 16, "ATTRIBUTES", "NONE", corrupt},
      {attributes, ~std::uint64_t{0}, 256, "ATTRIBUTES", "NONE", corrupt},
      {triangles, 32, 16, "ATTRIBUTES", "NONE", corrupt},
      {triangles, 95, 2, "TRIANGLES", "NONE", corrupt},  // google/filament, pull request 10405
      {triangles, 96, 1, "TRIANGLES", "NONE", corrupt},
      {triangles, 96, 8, "TRIANGLES", "NONE", corrupt},
      {triangles, 96, 2, "TRIANGLES", "EXPONENTIAL", corrupt},
      {triangles, 3 << 20, 4, "TRIANGLES", "NONE", corrupt},
      {sequence, 96, 3, "INDICES", "NONE", corrupt},
      {sequence, ~std::uint64_t{0}, 4, "INDICES", "NONE", corrupt},
      {"", 3, 4, "INDICES", "NONE", corrupt},
      {"", 1, 4, "ATTRIBUTES", "NONE", corrupt},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const auto decoded = decodeMeshopt(c.source, c.count, c.stride, c.mode, c.filter);
    ASSERT_FALSE(decoded) << i;
    EXPECT_EQ(decoded.error().code, c.code) << i << ": " << decoded.error().message;
  }
}

TEST(Meshopt, OutlivesDamage) {
  const std::string attributes = attributesOf(elementsOf(300, 12), 12);
  const std::vector<unsigned> indices = gridIndices(10);
  const std::string triangles = trianglesOf(indices), sequence = sequenceOf(indices);
  for (unsigned seed = 0; seed < 5000; ++seed) {
    std::mt19937 random(seed);
    const bool areAttributes = seed % 3 == 0, areTriangles = seed % 3 == 1;
    std::string bytes = areAttributes ? attributes : areTriangles ? triangles : sequence;
    for (unsigned i = 0; i <= seed % 7; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
    bytes.resize(bytes.size() - random() % 2 * (random() % bytes.size()));
    const std::uint64_t count = areAttributes ? 300 : indices.size();
    const auto decoded = areAttributes
                             ? decodeMeshopt(bytes, count, 12, "ATTRIBUTES", "EXPONENTIAL")
                             : decodeMeshopt(bytes, count, 2, areTriangles ? "TRIANGLES" : "INDICES", "");
    if (decoded) {
      EXPECT_EQ(decoded->size(), count * (areAttributes ? 12 : 2));
    }
  }
}

}  // namespace
}  // namespace arete
