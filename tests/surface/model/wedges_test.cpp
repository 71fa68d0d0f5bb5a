// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/wedges.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>
#include <vector>

#include "surface/shapes.h"

namespace arete {
namespace {

Attribute random(std::string name, std::size_t elements, int values, std::mt19937& generator) {
  Attribute attribute{.name = std::move(name), .type = ScalarType::float32, .components = 2};
  for (std::size_t i = 0; i < elements; ++i) {
    const std::array<double, 2> numbers = {double(generator() % unsigned(values)), 1};
    attribute.append(numbers);
  }
  return attribute;
}

/// A sheet whose corners have wedges, some of them shared between vertices and some equal.
SurfaceMesh randomMesh(unsigned seed) {
  std::mt19937 generator(seed);
  SurfaceMesh mesh;
  mesh.shape() = shapes::sheet(3 + int(seed % 4), 3);
  mesh.wedgeCount = 5 + seed % 40;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto& wedges = mesh.wedges.emplace_back();
    for (std::uint32_t& w : wedges) w = generator() % mesh.wedgeCount;
  }
  mesh.vertexAttributes.push_back(random("quality", mesh.positions.size(), 9, generator));
  mesh.wedgeAttributes.push_back(random("texcoord", mesh.wedgeCount, 1 + int(seed % 5), generator));
  mesh.wedgeAttributes.push_back(random("normal", mesh.wedgeCount, 2, generator));
  return mesh;
}

/// The bytes that a corner has for a name, of its wedge or else of its vertex.
std::vector<std::byte> valueAt(const SurfaceMesh& mesh, std::size_t t, std::size_t i,
                               const std::string& name) {
  for (const Attribute& a : mesh.wedgeAttributes)
    if (a.name == name) return {a.element(mesh.wedges[t][i]).begin(), a.element(mesh.wedges[t][i]).end()};
  for (const Attribute& a : mesh.vertexAttributes)
    if (a.name == name)
      return {a.element(mesh.triangles[t][i]).begin(), a.element(mesh.triangles[t][i]).end()};
  return {};
}

void expectSameCorners(const SurfaceMesh& a, const SurfaceMesh& b) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t t = 0; t < a.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(a.positions[a.triangles[t][i]], b.positions[b.triangles[t][i]]);
      for (const char* name : {"quality", "texcoord", "normal"})
        EXPECT_EQ(valueAt(a, t, i, name), valueAt(b, t, i, name)) << name << " of triangle " << t;
    }
}

TEST(Wedges, EveryCornerKeepsItsValuesThroughEveryMove) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const SurfaceMesh mesh = randomMesh(seed);
    SurfaceMesh moved = mesh;
    moveToWedges(moved);
    ASSERT_TRUE(moved.validate());
    EXPECT_TRUE(moved.vertexAttributes.empty());
    expectSameCorners(mesh, moved);
    moveToVertices(moved);
    ASSERT_TRUE(moved.validate());
    expectSameCorners(mesh, moved);
    const SplitMesh split = splitByWedges(mesh);
    ASSERT_TRUE(split.mesh.validate());
    EXPECT_FALSE(split.mesh.hasWedges());
    expectSameCorners(mesh, split.mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) EXPECT_EQ(split.vertexOf[v], v);
  }
}

TEST(Wedges, WhatAllCornersOfAVertexAgreeAboutBecomesTheVertexs) {
  SurfaceMesh mesh;
  mesh.shape() = shapes::sheet(3, 3);
  std::mt19937 generator(1);
  mesh.vertexAttributes.push_back(random("quality", mesh.positions.size(), 9, generator));
  SurfaceMesh moved = mesh;
  moveToWedges(moved);
  EXPECT_TRUE(moved.hasWedges());
  moveToVertices(moved);
  EXPECT_EQ(moved, mesh);
}

TEST(Wedges, EqualWedgesOfAVertexBecomeOneAndAFanOfManyIsFast) {
  SurfaceMesh fan;
  constexpr std::uint32_t kFaces = 50'000;
  fan.positions.assign(kFaces + 2, {});
  Attribute attribute{.name = "texcoord", .type = ScalarType::float32, .components = 1};
  for (std::uint32_t t = 0; t < kFaces; ++t) {
    fan.triangles.push_back({0, t + 1, t + 2});
    fan.wedges.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    for (const double value : {double(t / 2), 1.0, 1.0}) attribute.append(std::span(&value, 1));
  }
  fan.wedgeCount = 3 * kFaces;
  fan.wedgeAttributes = {attribute};
  moveToVertices(fan);
  EXPECT_TRUE(fan.validate());
  EXPECT_EQ(fan.wedgeCount, kFaces / 2 + kFaces + 1);
}

TEST(Wedges, ThatAreEqualAreJoinedWhereTheyAre) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const SurfaceMesh mesh = randomMesh(seed);
    SurfaceMesh joined = mesh;
    joinEqualWedges(joined);
    ASSERT_TRUE(joined.validate());
    expectSameCorners(mesh, joined);
    ASSERT_EQ(joined.wedgeAttributes.size(), 2u) << "nothing moves to the vertices";
    std::map<std::pair<std::uint32_t, std::vector<std::byte>>, std::uint32_t> wedgeOf;
    for (std::size_t t = 0; t < joined.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        std::vector<std::byte> value = valueAt(joined, t, i, "texcoord");
        const std::vector<std::byte> normal = valueAt(joined, t, i, "normal");
        value.insert(value.end(), normal.begin(), normal.end());
        const std::uint32_t w = joined.wedges[t][i];
        EXPECT_EQ(wedgeOf.try_emplace({joined.triangles[t][i], value}, w).first->second, w);
      }
  }
  SurfaceMesh bare = randomMesh(1);
  bare.wedgeAttributes.clear();
  joinEqualWedges(bare);
  EXPECT_FALSE(bare.hasWedges());
  EXPECT_TRUE(bare.validate());
}

TEST(Wedges, AMeshWithoutCornersIsCopied) {
  SurfaceMesh mesh;
  mesh.shape() = shapes::sheet(3, 3);
  EXPECT_EQ(splitByWedges(mesh).mesh, mesh);
}

}  // namespace
}  // namespace arete
