// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/cut/missing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "datasets/families.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

/// An MT whose nodes from `nodes` on are called missing: a part with the arrays of the whole.
struct WithMissing {
  explicit WithMissing(const MultiTriangulation& whole, std::uint32_t nodes)
      : remover(whole.arrays().remover.begin(), whole.arrays().remover.end()),
        missing((remover.size() + 63) / 64, 0) {
    for (std::size_t t = 0; t < remover.size(); ++t) {
      const bool isTriangle =
          t < whole.rootTriangleCount() || whole.creator(TriangleId(std::uint32_t(t))) != NodeId(remover[t]);
      if (!isTriangle || remover[t] == MultiTriangulation::kNone || remover[t] < nodes) continue;
      remover[t] = MultiTriangulation::kNone;
      missing[t / 64] |= std::uint64_t{1} << t % 64;
    }
    MtArrays a = whole.arrays();
    a.remover = remover;
    a.missing = missing;
    mt = MultiTriangulation(a, nullptr);
  }
  std::vector<std::uint32_t> remover;
  std::vector<std::uint64_t> missing;
  MultiTriangulation mt;
};

MultiTriangulation someMt() {
  const auto fractal = std::ranges::find(rasterFamilies(), std::string("fractal"),
                                         [](const RasterFamily& family) { return std::string(family.name); });
  return build(fractal->make(60, 50, 3))->mt;
}

TEST(Missing, IsNothingInAWholeMt) {
  const MultiTriangulation mt = someMt();
  const auto cut = takeCut(mt, UniformError(0));
  ASSERT_TRUE(cut);
  EXPECT_TRUE(cut->missing.empty());
}

TEST(Missing, AreTheTrianglesThatAreTooCoarseAndNothingElse) {
  const MultiTriangulation mt = someMt();
  const WithMissing part(mt, mt.nodeCount() / 8);
  for (const double share : {0.5, 0.1, 0.02}) {
    const UniformError criterion(mt.largestError() * share);
    const auto cut = takeCut(part.mt, criterion);
    ASSERT_TRUE(cut);
    std::vector<std::uint32_t> coarse;
    for (const std::uint32_t t : cut->ids)
      if (part.mt.error(TriangleId(t)) > mt.largestError() * share) coarse.push_back(t);
    EXPECT_EQ(cut->missing, coarse);
    const auto whole = takeCut(mt, criterion);
    if (coarse.empty()) {
      EXPECT_EQ(cut->ids, whole->ids);
    }
  }
}

TEST(Missing, OfABudgetAreThoseThatTheRefinementCameTo) {
  const MultiTriangulation mt = someMt();
  const WithMissing part(mt, mt.nodeCount() / 4);
  bool isAny = false, isNone = false;
  for (std::uint32_t budget = mt.rootTriangleCount() + 2; budget < mt.finestTriangleCount(); budget *= 2) {
    const auto cut = takeCut(part.mt, UniformError(0), {.maxTriangles = budget}),
               whole = takeCut(mt, UniformError(0), {.maxTriangles = budget});
    ASSERT_TRUE(cut && whole);
    (cut->missing.empty() ? isNone : isAny) = true;
    if (cut->missing.empty()) {
      EXPECT_EQ(cut->ids, whole->ids) << budget;
    }
  }
  EXPECT_TRUE(isAny && isNone);
}

}  // namespace
}  // namespace arete
