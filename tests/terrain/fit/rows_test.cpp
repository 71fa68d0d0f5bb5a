// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/fit/rows.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "terrain/fit_fixture.h"

namespace arete {
namespace {

using namespace fit_test;

TEST(FitRows, HaveTheResidualOfEverySampleOnceInUnitsOfItsBound) {
  for (const CutOfModel& c : cutsOfAllFamilies(4)) {
    SCOPED_TRACE(c.name);
    const double bound = std::max(c.maxError, 1e-3);
    FitMesh mesh = meshOf(c, bound);
    for (const bool differ : {false, true}) {
      FitBounds bounds = mesh.bounds();
      if (differ)
        for (std::uint32_t s = 0; s < c.model.mt.vertexCount(); ++s)
          bounds.of.push_back(bound * (s % 3 == 0 ? 1 : 4));
      mesh.setBounds(std::move(bounds));
      const FitRows rows(mesh);
      std::size_t count = 0;
      for (std::uint32_t t = 0; t < mesh.slotCount(); ++t) {
        const FitMesh::Corners& corners = mesh.triangle(t).corners;
        std::array<double, 3> heights = {};
        for (int i = 0; i < 3; ++i) heights[i] = mesh.heights()[corners[i]];
        std::size_t row = 0;
        mesh.forSamples(t, [&](std::uint32_t s) {
          const double residual = mesh.residual(corners, mesh.weights(corners).of(mesh.plan(s)), s);
          EXPECT_EQ(residualOf(rows.of(t)[row], heights), residual);
          EXPECT_EQ(rows.perBound(t, row), 1 / mesh.bounds().at(s));
          EXPECT_EQ(rows.isLoose(t, row), differ && s % 3 != 0);
          ++row;
        });
        EXPECT_EQ(rows.of(t).size(), row);
        count += row;
      }
      EXPECT_EQ(count, c.model.mt.vertexCount());
    }
  }
}

}  // namespace
}  // namespace arete
