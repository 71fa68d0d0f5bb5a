// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle applies modifications one by one to a set of triangles.
#include "engine/cut/front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "engine/cut_promises.h"
#include "engine/family_models.h"

namespace arete {
namespace {

TEST(Front, AreWhatApplyingTheModificationsOneByOneGives) {
  std::mt19937_64 random(99);
  for (const FamilyModel& s : familyModels()) {
    const MultiTriangulation& mt = s.model.mt;
    NodeSet set(mt.nodeCount(), 0);
    for (std::uint32_t i = 0; i < mt.nodeCount() / 20 + 1 && mt.nodeCount() > 0; ++i)
      set[random() % mt.nodeCount()] = 1;
    closeUpwards(mt, set);
    std::set<std::uint32_t> current;
    for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) current.insert(t);
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
      if (!set[n]) continue;
      for (const std::uint32_t t : mt.floor(NodeId(n))) ASSERT_EQ(current.erase(t), 1u) << s.name;
      for (std::uint32_t i = 0; i < mt.ceilingSize(NodeId(n)); ++i)
        current.insert(mt.slotTriangle(NodeId(n), i).index());
    }
    const Cut cut = front(mt, set);
    EXPECT_EQ(std::set<std::uint32_t>(cut.ids.begin(), cut.ids.end()), current) << s.name;
    for (std::size_t t = 0; t < cut.ids.size(); ++t) {
      std::array<std::uint32_t, 3> corners;
      for (int i = 0; i < 3; ++i) corners[i] = cut.vertices[cut.triangles[t][i]];
      EXPECT_EQ(corners, mt.corners(TriangleId(cut.ids[t]))) << s.name;
    }
  }
}

TEST(Front, OfAPrefixAreThoseOfTheSameSet) {
  for (const FamilyModel& s : familyModels()) {
    const std::uint32_t n = s.model.mt.nodeCount() / 2;
    NodeSet set(s.model.mt.nodeCount(), 0);
    std::fill(set.begin(), set.begin() + n, std::uint8_t(1));
    const Cut a = frontOfPrefix(s.model.mt, n), b = front(s.model.mt, set);
    EXPECT_EQ(a.ids, b.ids);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.triangles.size(), s.model.mt.prefixTriangleCount(n));
  }
}

TEST(Front, OfTheClosureAddsTheMissingParentsAndNoOthers) {
  std::mt19937_64 random(100);
  for (const FamilyModel& s : familyModels()) {
    const MultiTriangulation& mt = s.model.mt;
    if (mt.nodeCount() == 0) continue;
    for (int round = 0; round < 10; ++round) {
      NodeSet set(mt.nodeCount(), 0);
      for (int i = 0; i < 5; ++i) set[random() % mt.nodeCount()] = 1;
      NodeSet closed = set;
      const std::uint32_t members = closeUpwards(mt, closed);
      const Cut cut = frontOfClosure(mt, MemberSet(set)), expected = front(mt, closed);
      EXPECT_EQ(cut.ids, expected.ids) << s.name;
      EXPECT_EQ(cut.vertices, expected.vertices) << s.name;
      EXPECT_EQ(cut.nodes, members) << s.name;
      EXPECT_EQ(frontSize(mt, MemberSet(closed)), expected.ids.size()) << s.name;
      double worst = 0;
      for (const std::uint32_t t : expected.ids) worst = std::max(worst, mt.error(TriangleId(t)));
      EXPECT_EQ(expected.achievedError, worst) << s.name;
    }
  }
}

}  // namespace
}  // namespace arete
