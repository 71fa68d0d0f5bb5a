// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "engine/mt/multitriangulation.h"
#include "full_run.h"
#include "terrain/builder/build_in_tiles.h"
#include "terrain/model/build_options.h"

namespace arete {

inline std::vector<std::uint64_t> seeds() {
  return test::isFull() ? std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6} : std::vector<std::uint64_t>{1, 2};
}

inline BuildOptions withShape(HoleShape shape) {
  BuildOptions options;
  options.shape = shape;
  return options;
}

/// Tiles of so few vertices that a small heightfield has many.
inline TileOptions tilesOf(std::uint32_t vertices) {
  return {.most = vertices, .least = vertices, .fewest = 2, .span = 1.6};
}

struct BuildWay {
  BuildOptions options;
  TileOptions tiles;
};
/// Both shapes, undivided and in tiles.
inline std::vector<BuildWay> eachWay() {
  std::vector<BuildWay> ways;
  for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent})
    for (const TileOptions& tiles : {TileOptions::of(shape), tilesOf(30)})
      ways.push_back({withShape(shape), tiles});
  return ways;
}

template <class T>
bool sameBytes(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

inline void expectSameArrays(const MultiTriangulation& x, const MultiTriangulation& y,
                             const std::string& name) {
  const MtArrays &a = x.arrays(), &b = y.arrays();
  EXPECT_EQ(a.rootVertices, b.rootVertices) << name;
  EXPECT_TRUE(sameBytes(a.rootTriangles, b.rootTriangles)) << name;
  EXPECT_TRUE(sameBytes(a.slotBegin, b.slotBegin)) << name;
  EXPECT_TRUE(sameBytes(a.link, b.link)) << name;
  EXPECT_TRUE(sameBytes(a.remover, b.remover)) << name;
  EXPECT_TRUE(sameBytes(a.error, b.error)) << name;
  EXPECT_TRUE(sameBytes(a.columns.of(kBelow), b.columns.of(kBelow))) << name;
  EXPECT_TRUE(sameBytes(a.columns.of(kAbove), b.columns.of(kAbove))) << name;
  EXPECT_TRUE(sameBytes(a.floor, b.floor)) << name;
  EXPECT_TRUE(sameBytes(a.saturatedError, b.saturatedError)) << name;
  EXPECT_TRUE(sameBytes(a.sphere, b.sphere)) << name;
  EXPECT_TRUE(sameBytes(a.blockError, b.blockError)) << name;
  EXPECT_TRUE(sameBytes(a.blockSphere, b.blockSphere)) << name;
  EXPECT_TRUE(sameBytes(a.creatorHint, b.creatorHint)) << name;
  EXPECT_TRUE(sameBytes(a.vertices.samples, b.vertices.samples)) << name;
  EXPECT_TRUE(sameBytes(a.vertices.plan, b.vertices.plan)) << name;
  EXPECT_TRUE(sameBytes(a.vertices.rawHeights, b.vertices.rawHeights)) << name;
}

}  // namespace arete
