// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle is the walk from the root, without the shortcuts that bounds and limits allow.
#include "engine/cut/refine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/cut_promises.h"
#include "engine/family_models.h"
#include "engine/laws/validate.h"

namespace arete {
namespace {

double spanToRefine(const MultiTriangulation& mt) {
  return mt.nodeCount() ? mt.largestError() : 1;
}

TEST(Budget, IsNeverExceededAndNearlySpent) {
  for (const FamilyModel& s : familyModels()) {
    const MultiTriangulation& mt = s.model.mt;
    const std::uint32_t roots = mt.rootTriangleCount(), finest = mt.finestTriangleCount();
    for (const double part : {0.0, 0.05, 0.3, 0.8, 1.0})
      for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
        const auto budget = static_cast<std::uint32_t>(roots + part * (finest - roots));
        const auto cut = takeCut(mt, UniformError(0), {.method = method, .maxTriangles = budget});
        ASSERT_TRUE(cut) << s.name;
        EXPECT_LE(cut->triangles.size(), budget) << s.name;
        EXPECT_TRUE(validateFront(mt, *cut, domainExtent(mt))) << s.name;
        // Of the uniform cuts of at most that size in the same MT, none is more than 10 % better. A smaller
        // error never takes fewer triangles, so what lies below a billionth is not asked for.
        const double best = cut->achievedError * 0.89;
        for (double e = best; e > best * 1e-9; e *= 0.5) {
          const auto better = takeCut(mt, UniformError(e), {.method = method});
          EXPECT_GT(better->triangles.size(), budget) << s.name << " budget " << budget << " error " << e;
        }
      }
  }
}

/// Refinement from the root, worst first, is what a budget means; for a criterion without bounds there is no
/// shortcut.
TEST(Budget, OfAUniformErrorResultsInTheCutOfTheWalkFromTheRoot) {
  struct Silent final : Criterion {
    double maxError = 0;
    bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners&) const override {
      return mt.error(t) <= maxError;
    }
  };
  for (const FamilyModel& s : familyModels()) {
    const MultiTriangulation& mt = s.model.mt;
    const std::uint32_t roots = mt.rootTriangleCount(), finest = mt.finestTriangleCount();
    for (const double maxError : {0.0, 0.02 * spanToRefine(mt)})
      for (int i = 0; i <= 40; ++i) {
        const std::uint32_t budget = roots + (finest - roots) * static_cast<std::uint32_t>(i) / 40;
        Silent silent;
        silent.maxError = maxError;
        const auto fast = takeNodes(mt, UniformError(maxError), {.maxTriangles = budget}),
                   walk = takeNodes(mt, silent, {.maxTriangles = budget});
        ASSERT_TRUE(fast && walk);
        EXPECT_EQ(fast->nodes, walk->nodes) << s.name << " " << budget;
        EXPECT_EQ(fast->isComplete, walk->isComplete) << s.name << " " << budget;
      }
  }
}

/// A view without a severity limit: refinement starts at the root.
class SilentView final : public BoundedCriterion {
 public:
  explicit SilentView(const ViewError& view) : view_(view) {}
  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return view_.isFineEnough(mt, t, corners);
  }
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return view_.severity(mt, t, corners);
  }
  double allowedError(const Sphere& s) const override { return view_.allowedError(s); }

 private:
  const ViewError& view_;
};

TEST(Budget, OfAViewResultsInTheCutOfTheWalkFromTheRoot) {
  std::mt19937_64 random(5);
  std::uint64_t binding = 0;
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    for (int i = 0; i < 12; ++i) {
      ViewError::Options options{.view = randomView(Extent(mt), random),
                                 .pixels = std::pow(10, -static_cast<double>(random() % 10))};
      if (i % 3 == 0) options.outsideError = mt.largestError() / static_cast<double>(1 + random() % 20);
      const ViewError view(options, mt.arrays().metric);
      const SilentView silent(view);
      const std::uint32_t roots = mt.rootTriangleCount(), finest = mt.finestTriangleCount();
      for (int k = 0; k < 8; ++k) {
        const std::uint32_t budget =
            roots + static_cast<std::uint32_t>(random() % (finest - roots + 1)) / (1 + k);
        const auto fast = takeNodes(mt, view, {.maxTriangles = budget}),
                   walk = takeNodes(mt, silent, {.maxTriangles = budget});
        ASSERT_TRUE(fast && walk);
        EXPECT_EQ(fast->nodes, walk->nodes) << m.name << " " << i << " " << budget;
        EXPECT_EQ(fast->isComplete, walk->isComplete) << m.name << " " << i << " " << budget;
        binding += fast->isComplete ? 0 : 1;
      }
    }
  }
  EXPECT_GT(binding, 100u);
}

}  // namespace
}  // namespace arete
