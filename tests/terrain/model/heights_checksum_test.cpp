// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/model/heights_checksum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "terrain/model/heightfield.h"

namespace arete {
namespace {

TEST(HeightsChecksumInPieces, IsThatOfTheWholeHoweverItIsCut) {
  RasterHeightfield field;
  field.columns = 173;
  field.rows = 61;
  for (std::uint32_t i = 0; i < 173 * 61; ++i)
    field.heights.push_back(i % 17 == 0 ? std::nan("") : std::sin(i * 0.7) * 100);
  for (const std::size_t piece : {1u, 173u, 1000u, 4096u, 5000u, 20000u}) {
    HeightsChecksum checksum(field.columns, field.rows);
    for (std::size_t begin = 0; begin < field.size(); begin += piece)
      checksum.add(
          std::span<const double>(field.heights).subspan(begin, std::min(piece, field.size() - begin)));
    EXPECT_EQ(checksum.text(), heightsChecksum(field)) << piece;
  }
}

}  // namespace
}  // namespace arete
