// SPDX-License-Identifier: GPL-3.0-or-later
//
// The small problems of a fit, against exact linear programs.
#include "terrain/fit/patch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/random.h"
#include "terrain/chebyshev_oracle.h"

namespace arete {
namespace {

using testing::leastMaximum;
using testing::LinearResidual;

TEST(FitPatch, FindsTheHeightBetweenTwoSamples) {
  for (const double apart : {0.0, 1.0, 1.98, 2.02, 3.0}) {
    FitPatch patch;
    patch.start(1);
    patch.add({.weight = {1, 0, 0}, .unknown = {0, 0, 0}, .rest = 10});
    patch.add({.weight = {1, 0, 0}, .unknown = {0, 0, 0}, .rest = 10 + apart});
    ASSERT_EQ(patch.solve(1), apart < 2) << apart;
    if (apart >= 2) continue;
    EXPECT_NEAR(patch.values()[0], -10 - apart / 2, 1 - apart / 2 + 1e-9) << apart;
  }
}

TEST(FitPatch, LeavesAnUnknownAloneThatNothingDependsOn) {
  FitPatch patch;
  patch.start(3);
  patch.add({.weight = {0.5, 0, 0}, .unknown = {2, 0, 0}, .rest = -4});
  ASSERT_TRUE(patch.solve(1));
  EXPECT_EQ(patch.values()[0], 0);
  EXPECT_EQ(patch.values()[1], 0);
  EXPECT_NEAR(patch.values()[2], 8, 2 + 1e-9);
}

TEST(FitPatch, StartsAfresh) {
  FitPatch patch;
  patch.start(1);
  patch.add({.weight = {1, 0, 0}, .unknown = {0, 0, 0}, .rest = 5});
  patch.start(2);
  EXPECT_EQ(patch.rowCount(), 0u);
  EXPECT_TRUE(patch.solve(1));
}

/// Rows as triangles make them: barycentric weights, rests of which some are far off.
std::vector<FitPatch::Row> randomRows(Random& random, std::uint32_t unknowns, std::size_t count) {
  std::vector<FitPatch::Row> rows(count);
  for (FitPatch::Row& row : rows) {
    const double a = random.unit(), b = (1 - a) * random.unit();
    row.weight = {a, b, 1 - a - b};
    const auto first = static_cast<std::uint32_t>(random.next() % unknowns);
    for (std::uint32_t i = 0; i < 3; ++i) {
      row.unknown[i] = (first + i) % unknowns;
      if (i > 0 && random.unit() < 0.3) row.weight[i] = 0;  // a corner that does not move
    }
    row.rest = random.between(-1.4, 1.4);
  }
  return rows;
}

TEST(FitPatch, IsNeverWrongAndSeldomMissesASolution) {
  std::size_t solvable = 0, solved = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto unknowns = static_cast<std::uint32_t>(3 + random.next() % 12);
    const std::vector<FitPatch::Row> rows = randomRows(random, unknowns, 4 + random.next() % (4 * unknowns));
    FitPatch patch;
    patch.start(unknowns);
    std::vector<LinearResidual> residuals;
    for (const FitPatch::Row& row : rows) {
      patch.add(row);
      LinearResidual residual{{}, row.rest};
      for (int i = 0; i < 3; ++i)
        if (row.weight[i] != 0) residual.terms.emplace_back(row.unknown[i], row.weight[i]);
      residuals.push_back(std::move(residual));
    }
    const double least = leastMaximum(unknowns, residuals);
    const bool isSolved = patch.solve(1);
    if (isSolved) {
      EXPECT_LE(least, 1 + 1e-12);
      for (const FitPatch::Row& row : rows) {
        double r = row.rest;
        for (int i = 0; i < 3; ++i) r += row.weight[i] * patch.values()[row.unknown[i]];
        EXPECT_LE(std::abs(r), 1 + 1e-12);
      }
    }
    if (least < 0.98) {
      ++solvable;
      solved += isSolved ? 1 : 0;
    }
  }
  EXPECT_GT(solvable, 100u);
  EXPECT_GE(double(solved), 0.95 * double(solvable)) << solved << " of " << solvable;
}

}  // namespace
}  // namespace arete
