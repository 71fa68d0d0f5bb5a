// SPDX-License-Identifier: GPL-3.0-or-later
//
// Draco's own encoder makes the bytes.
#include "io/formats/glb/draco.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "io/formats/glb/base64.h"

namespace arete {
namespace {

constexpr int kSide = 12;
constexpr std::uint64_t kRoomy = 1 << 20;

struct Corner {
  std::array<float, 3> position;
  std::array<std::uint8_t, 4> color;
  std::uint16_t label;
  auto operator<=>(const Corner&) const = default;
};
using Triangle = std::array<Corner, 3>;

/// A bent square of triangles.
std::vector<Triangle> square() {
  const auto corner = [](int x, int y) {
    return Corner{{float(x) / 3, float(y) / 7, std::sin(float(x * y))},
                  {std::uint8_t(x), std::uint8_t(y), std::uint8_t(x * y), 255},
                  static_cast<std::uint16_t>(1000 * x + y)};
  };
  std::vector<Triangle> triangles;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      triangles.push_back({corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)});
      triangles.push_back({corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)});
    }
  return triangles;
}

std::string encoded(const std::vector<Triangle>& triangles, int method, int bits) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(triangles.size()));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32),
            color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8),
            label = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 1, draco::DT_UINT16);
  for (std::uint32_t f = 0; f < triangles.size(); ++f) {
    const auto& [a, b, c] = triangles[f];
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(f), a.position.data(), b.position.data(),
                                      c.position.data());
    builder.SetAttributeValuesForFace(color, draco::FaceIndex(f), a.color.data(), b.color.data(),
                                      c.color.data());
    builder.SetAttributeValuesForFace(label, draco::FaceIndex(f), &a.label, &b.label, &c.label);
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  mesh->attribute(position)->set_unique_id(7);
  mesh->attribute(color)->set_unique_id(3);
  mesh->attribute(label)->set_unique_id(5);
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  if (bits > 0) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

const DracoAttribute& attribute(const DracoMesh& mesh, int id) {
  const auto found = std::ranges::find(mesh.attributes, id, &DracoAttribute::uniqueId);
  EXPECT_NE(found, mesh.attributes.end());
  return *found;
}

template <class T>
T valueAt(const DracoAttribute& attribute, std::size_t i) {
  T value{};
  std::memcpy(&value, attribute.bytes.data() + i * sizeof value, sizeof value);
  return value;
}

/// Triangles of one turn, however they begin.
Triangle turned(Triangle triangle) {
  std::rotate(triangle.begin(), std::ranges::min_element(triangle, {}, &Corner::label), triangle.end());
  return triangle;
}

TEST(Draco, DecodesTheTrianglesThatWereEncoded) {
  struct Case {
    int method, bits;
  };
  for (const Case& c :
       {Case{draco::MESH_SEQUENTIAL_ENCODING, 0}, Case{draco::MESH_SEQUENTIAL_ENCODING, 14},
        Case{draco::MESH_EDGEBREAKER_ENCODING, 11}, Case{draco::MESH_EDGEBREAKER_ENCODING, 16},
        Case{draco::MESH_EDGEBREAKER_ENCODING, 0}}) {
    const std::vector<Triangle> triangles = square();
    const Result<DracoMesh> mesh = decodeDraco(encoded(triangles, c.method, c.bits), kRoomy);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->points, (kSide + 1) * (kSide + 1));
    const DracoAttribute &positions = attribute(*mesh, 7), &colors = attribute(*mesh, 3),
                         &labels = attribute(*mesh, 5);
    EXPECT_EQ(std::pair(positions.type, positions.components), std::pair(ScalarType::float32, 3));
    EXPECT_EQ(std::pair(colors.type, colors.components), std::pair(ScalarType::uint8, 4));
    EXPECT_EQ(std::pair(labels.type, labels.components), std::pair(ScalarType::uint16, 1));
    // The label says which corner a point is.
    std::map<std::uint16_t, Corner> corners;
    for (const Triangle& triangle : triangles)
      for (const Corner& corner : triangle) corners[corner.label] = corner;
    const double step = c.bits == 0 ? 0 : 4.0 / ((1 << c.bits) - 1);
    for (std::size_t p = 0; p < mesh->points; ++p) {
      const Corner& corner = corners.at(valueAt<std::uint16_t>(labels, p));
      EXPECT_EQ((valueAt<std::array<std::uint8_t, 4>>(colors, p)), corner.color);
      const auto position = valueAt<std::array<float, 3>>(positions, p);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(position[k], corner.position[k], step / 2 + step * 1e-3);
    }
    std::multiset<Triangle> found, expected;
    for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
      Triangle triangle;
      for (std::size_t k = 0; k < 3; ++k)
        triangle[k] = corners.at(valueAt<std::uint16_t>(labels, mesh->indices[i + k]));
      found.insert(turned(triangle));
    }
    for (const Triangle& triangle : triangles) expected.insert(turned(triangle));
    EXPECT_EQ(found, expected);
  }
}

TEST(Draco, RefusesWhatIsNoMeshOrLargerThanAnnounced) {
  const std::string bytes = encoded(square(), draco::MESH_EDGEBREAKER_ENCODING, 11);
  EXPECT_FALSE(decodeDraco("", kRoomy));
  EXPECT_FALSE(decodeDraco("DRACO", kRoomy));
  EXPECT_FALSE(decodeDraco("no Draco at all", kRoomy));
  const Result<DracoMesh> larger = decodeDraco(bytes, 1000);
  ASSERT_FALSE(larger);
  EXPECT_EQ(larger.error().code, ErrorCode::corrupt);
  for (std::size_t size = 0; size < bytes.size(); size += 37)
    if (const auto mesh = decodeDraco(std::string_view(bytes).substr(0, size), kRoomy); !mesh) {
      EXPECT_FALSE(mesh.error().message.empty());
    }
}

// google/draco, issue 1169: 61 bytes for which libdraco takes gigabytes.
TEST(Draco, RefusesAFewBytesThatAnnounceManyTriangles) {
  const auto bytes =
      fromBase64("RFJBQ08BAAEBXQEBAAB9AAAzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMzMAAA==");
  ASSERT_TRUE(bytes);
  EXPECT_FALSE(decodeDraco(*bytes, std::uint64_t{1} << 40));
}

TEST(Draco, OutlivesDamage) {
  const std::vector<Triangle> triangles = square();
  int refused = 0;
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
    for (unsigned seed = 0; seed < 100; ++seed) {
      std::string bytes = encoded(triangles, method, 11);
      std::mt19937 random(seed);
      for (unsigned i = 0; i <= seed % 5; ++i) {
        // Headers and counts stand at the front.
        const std::size_t at = random() % (seed % 2 == 0 ? 40 : bytes.size());
        bytes[at] = static_cast<char>(random());
      }
      const Result<DracoMesh> mesh = decodeDraco(bytes, kRoomy);
      refused += mesh ? 0 : 1;
      if (!mesh) continue;
      for (const std::uint32_t index : mesh->indices) ASSERT_LT(index, mesh->points) << seed;
      for (const DracoAttribute& a : mesh->attributes)
        ASSERT_EQ(a.bytes.size(), mesh->points * sizeOf(a.type) * std::size_t(a.components)) << seed;
    }
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace arete
