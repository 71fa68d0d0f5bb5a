// SPDX-License-Identifier: GPL-3.0-or-later
//
// Binary OFF as Geomview writes it, made byte by byte.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "io/formats/off/off.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

std::string whole(std::int64_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> shift & 0xFF);
  return bytes;
}
std::string number(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return whole(bits);
}
std::string numbers(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) bytes += number(value);
  return bytes;
}
std::string face(const std::vector<int>& corners, const std::vector<float>& color = {}) {
  std::string bytes = whole(std::int64_t(corners.size()));
  for (const int corner : corners) bytes += whole(corner);
  return bytes + whole(std::int64_t(color.size())) + numbers(color);
}
const std::string kSquare = numbers({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.5F});
std::string counts(int vertices, int faces) {
  return whole(vertices) + whole(faces) + whole(0);
}

class BinaryOff : public MeshFileTest {};

TEST_F(BinaryOff, HasVerticesAndFacesOfAnySize) {
  for (const char* begin : {"OFF BINARY\n", "OFF BINARY\r\n", "off binary\n", "OFF  BINARY \n"}) {
    const Result<MeshFile> file = readOff(
        put("a.off", begin + counts(4, 2) + kSquare + face({0, 1, 2, 3}) + face({0, 2, 1}, {1, 0, 0, 1})));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_TRUE(file->mesh.validate());
    EXPECT_EQ(file->mesh.positions[3], (Vec3{0, 1, 0.5}));
    EXPECT_EQ(file->mesh.triangles.size(), 3u);
    EXPECT_EQ(file->mesh.faceOf, (std::vector<std::uint32_t>{0, 0, 1}));
    ASSERT_EQ(file->mesh.triangleAttributes.size(), 1u);
    EXPECT_EQ(file->mesh.triangleAttributes[0].numbers(2), (std::vector<double>{1, 0, 0, 1}));
    EXPECT_EQ(file->frame.coordinates, "float32");
  }
}

TEST_F(BinaryOff, HasWhatItsKeywordSaysInGeomviewsOrder) {
  struct Case {
    const char* keyword;
    std::vector<float> behind;
    std::vector<std::pair<std::string, std::vector<double>>> attributes;
  };
  const std::vector<Case> cases = {
      {"COFF", {1, 0.5F, 0.25F, 1}, {{"color", {1, 0.5, 0.25, 1}}}},
      {"NOFF", {0, 0, 1}, {{"normal", {0, 0, 1}}}},
      {"STOFF", {0.5F, 2}, {{"texcoord", {0.5, 2}}}},
      {"CNOFF", {0, 1, 0, 1, 0.5F, 1, 0}, {{"normal", {0, 1, 0}}, {"color", {1, 0.5, 1, 0}}}},
      {"STCNOFF",
       {0, 1, 0, 1, 0.5F, 1, 0, 3, 4},
       {{"normal", {0, 1, 0}}, {"color", {1, 0.5, 1, 0}}, {"texcoord", {3, 4}}}},
  };
  for (const Case& c : cases) {
    std::string bytes = std::string(c.keyword) + " BINARY\n" + counts(3, 1);
    for (const std::vector<float>& p : {std::vector<float>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})
      bytes += numbers(p) + numbers(c.behind);
    const Result<MeshFile> file = readOff(put("a.off", bytes + face({0, 1, 2})));
    ASSERT_TRUE(file) << c.keyword << ' ' << file.error().describe();
    ASSERT_EQ(file->mesh.vertexAttributes.size(), c.attributes.size()) << c.keyword;
    for (std::size_t a = 0; a < c.attributes.size(); ++a) {
      EXPECT_EQ(file->mesh.vertexAttributes[a].name, c.attributes[a].first) << c.keyword;
      EXPECT_EQ(file->mesh.vertexAttributes[a].numbers(1), c.attributes[a].second) << c.keyword;
    }
  }
}

TEST_F(BinaryOff, WhatIsMalformedIsRefusedByName) {
  const std::string begin = "OFF BINARY\n", good = begin + counts(4, 1) + kSquare + face({0, 1, 2});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  struct Case {
    std::string bytes;
    const char* says;
  };
  const std::vector<Case> cases = {
      {begin, "ends in its counts"},
      {begin + whole(4) + whole(1), "ends in its counts"},
      {begin + counts(-1, 1) + kSquare, "counts below 0"},
      {begin + counts(4, -2) + kSquare, "counts below 0"},
      {begin + counts(2'000'000'000, 1) + kSquare, "truncated"},
      {begin + counts(4, 2'000'000'000) + kSquare, "truncated"},
      {begin + counts(4, 1) + kSquare, "truncated"},
      {good.substr(0, good.size() - 1), "corners"},
      {good.substr(0, good.size() - 4), "corners"},
      {good + "x", "bytes behind"},
      {good + whole(3), "bytes behind"},
      {begin + counts(4, 1) + kSquare + face({0, 1, 4}), "names vertex 4 of 4"},
      {begin + counts(4, 1) + kSquare + face({0, -1, 2}), "names vertex -1 of 4"},
      {begin + counts(4, 1) + kSquare + whole(-3) + whole(0), "corners"},
      {begin + counts(4, 1) + kSquare + whole(1'000'000) + whole(0), "corners"},
      {begin + counts(4, 1) + kSquare + whole(3) + whole(0) + whole(1) + whole(2) + whole(7),
       "color of 7 parts"},
      {begin + counts(4, 1) + kSquare + whole(3) + whole(0) + whole(1) + whole(2) + whole(-1),
       "color of -1 parts"},
      {begin + counts(4, 1) + kSquare + whole(3) + whole(0) + whole(1) + whole(2) + whole(4) + number(1),
       "truncated in the color"},
      {begin + counts(3, 1) + numbers({0, 0, 0, nan, 0, 0, 0, 1, 0}) + face({0, 1, 2}), "not finite"},
      {begin + counts(4, 0) + kSquare, "no face of three"},
      {begin + counts(4, 1) + kSquare + face({0, 1}), "no face of three"},
      {"4OFF BINARY\n" + counts(3, 1), "three coordinates"},
      {"OFF BINARY 4 1 0\n", "BINARY"},
  };
  for (const Case& c : cases) {
    const Error error = refusal("a.off", c.bytes);
    EXPECT_NE(error.message.find(c.says), std::string::npos) << c.says << ": " << error.message;
  }
}

}  // namespace
}  // namespace arete
