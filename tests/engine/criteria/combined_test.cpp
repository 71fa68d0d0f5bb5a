// SPDX-License-Identifier: GPL-3.0-or-later
//
// Combinations against their parts, triangle by triangle and ball by ball.
#include "engine/criteria/combined.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "engine/cut_promises.h"
#include "engine/family_models.h"

namespace arete {
namespace {

TEST(Combined, AreFineEnoughForAllOfTheirPartsOrForAny) {
  std::mt19937_64 random(1);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    CriterionParts parts;
    for (const auto& [name, criterion] : criteriaFor(mt, random)) parts.push_back(criterion);
    parts.resize(6);
    const auto all = allOf(parts), any = anyOf(parts);
    for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
      const TriangleId id(t);
      if (mt.remover(id).isValid() && mt.remover(id) == mt.creator(id)) continue;
      const auto corners = mt.corners(id);
      int fine = 0;
      double worst = 0, least = std::numeric_limits<double>::infinity();
      for (const auto& part : parts) {
        const bool isFine = part->isFineEnough(mt, id, corners);
        const double severity = part->severity(mt, id, corners);
        fine += isFine ? 1 : 0;
        if (!isFine) worst = std::max(worst, severity);
        least = std::min(least, severity);
      }
      ASSERT_EQ(all->isFineEnough(mt, id, corners), fine == 6) << m.name;
      ASSERT_EQ(any->isFineEnough(mt, id, corners), fine > 0) << m.name;
      ASSERT_EQ(all->severity(mt, id, corners), worst) << m.name;
      ASSERT_EQ(any->severity(mt, id, corners), least) << m.name;
    }
  }
}

TEST(Combined, AreBoundedIfAllOfTheirPartsAre) {
  const auto bounded = std::make_shared<UniformError>(1);
  const auto plain = std::make_shared<Predicate>(
      [](const MultiTriangulation&, TriangleId, const Criterion::Corners&) { return true; });
  EXPECT_NE(allOf({bounded, bounded})->bounded(), nullptr);
  EXPECT_NE(anyOf({bounded})->bounded(), nullptr);
  EXPECT_EQ(allOf({bounded, plain})->bounded(), nullptr);
  EXPECT_EQ(anyOf({plain, bounded})->bounded(), nullptr);
  EXPECT_NE(allOf({anyOf({bounded, bounded}), bounded})->bounded(), nullptr);
  EXPECT_EQ(allOf({anyOf({bounded, plain}), bounded})->bounded(), nullptr);
}

TEST(Combined, AllowTheLeastOrTheLargestOfTheirPartsErrors) {
  std::mt19937_64 random(2);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    CriterionParts parts;
    for (const auto& [name, criterion] : criteriaFor(mt, random))
      if (criterion->bounded() != nullptr) parts.push_back(criterion);
    const auto all = allOf(parts), any = anyOf(parts);
    ASSERT_TRUE(all->bounded() && any->bounded());
    std::vector<float> errors;
    const auto spheres = mt.arrays().sphere.first(std::min<std::size_t>(64, mt.nodeCount()));
    for (std::size_t i = 0; i < spheres.size(); ++i)
      errors.push_back(static_cast<float>(mt.saturatedError(NodeId(static_cast<std::uint32_t>(i)))));
    const std::uint64_t allBits = all->bounded()->exceeding(spheres, errors),
                        anyBits = any->bounded()->exceeding(spheres, errors);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      double least = std::numeric_limits<double>::infinity(), largest = 0;
      for (const auto& part : parts) {
        least = std::min(least, part->bounded()->allowedError(spheres[i]));
        largest = std::max(largest, part->bounded()->allowedError(spheres[i]));
      }
      EXPECT_EQ(all->bounded()->allowedError(spheres[i]), least) << m.name;
      EXPECT_EQ(any->bounded()->allowedError(spheres[i]), largest) << m.name;
      EXPECT_EQ((allBits >> i & 1) != 0, errors[i] > least) << m.name;
      EXPECT_EQ((anyBits >> i & 1) != 0, errors[i] > largest) << m.name;
    }
  }
}

}  // namespace
}  // namespace arete
