// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file of a terrain, and whether what is read of it is the same.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <span>
#include <string>

#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/store/amt/file.h"
#include "terrain/builder/build.h"

namespace arete::test {

/// A file of a terrain, plain or packed.
inline std::string writtenTo(const TemporaryFolder& folder, bool isPacked, bool isRound = true,
                             std::uint32_t columns = 220, std::uint32_t rows = 180) {
  RasterHeightfield field =
      hills(columns, rows, [&](double z) { return isRound ? std::round(4 * z) / 4 : z; });
  field.georeference.geoTransform = {0, 30, 0, 0, 0, -30};
  const std::string path = folder.file(isPacked ? "packed.amt" : "plain.amt");
  EXPECT_TRUE(writeAmt(path, built(build(field)), {}, {.isPacked = isPacked}));
  return path;
}

template <class T>
bool areSame(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

inline void expectSame(const TerrainModel& x, const TerrainModel& y) {
  const MtArrays &a = x.mt.arrays(), &b = y.mt.arrays();
  EXPECT_EQ(a.rootVertices, b.rootVertices);
  EXPECT_TRUE(areSame(a.rootTriangles, b.rootTriangles));
  EXPECT_TRUE(areSame(a.slotBegin, b.slotBegin));
  EXPECT_TRUE(areSame(a.link, b.link));
  EXPECT_TRUE(areSame(a.remover, b.remover));
  EXPECT_TRUE(areSame(a.error, b.error));
  EXPECT_TRUE(areSame(a.columns.of(kBelow), b.columns.of(kBelow)));
  EXPECT_TRUE(areSame(a.columns.of(kAbove), b.columns.of(kAbove)));
  EXPECT_TRUE(areSame(a.floor, b.floor));
  EXPECT_TRUE(areSame(a.saturatedError, b.saturatedError));
  EXPECT_TRUE(areSame(a.sphere, b.sphere));
  EXPECT_TRUE(areSame(a.blockError, b.blockError));
  EXPECT_TRUE(areSame(a.creatorHint, b.creatorHint));
  EXPECT_TRUE(areSame(a.vertices.samples, b.vertices.samples));
  EXPECT_TRUE(areSame(a.vertices.rawHeights, b.vertices.rawHeights));
}

}  // namespace arete::test
