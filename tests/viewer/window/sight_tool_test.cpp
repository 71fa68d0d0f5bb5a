// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of sight between two clicks, as they are drawn and described.
#include "viewer/window/sight_tool.h"

#include <gtest/gtest.h>
#include <cmath>

#include "viewer/camera_models.h"

namespace arete {
namespace {

class SightTools : public ::testing::Test {
 protected:
  const TerrainModel& model_ = test::cameraModels()[0].model;
  Profiles profiles_{model_};
  SightTool tool_{model_, profiles_};
  CameraSpace space_{model_};

  Pick pickAt(Vec2 plan) const {
    Pick pick;
    pick.plan = plan;
    pick.xy = model_.toSource(plan);
    pick.height = profiles_.heights().at(pick.xy)->height;
    pick.metric = space_.position(pick.xy, pick.height);
    return pick;
  }
};

TEST_F(SightTools, SeeEverythingFromHighAbove) {
  const auto picture = tool_.between(pickAt({5, 5}), 1e5, pickAt({30, 20}), 1e5);
  ASSERT_TRUE(picture) << picture.error().describe();
  EXPECT_EQ(picture->answer.sight.verdict, SightVerdict::visible);
  EXPECT_FALSE(picture->obstruction);
  EXPECT_EQ(picture->pointsBefore, picture->points.size());
  ASSERT_FALSE(picture->text.empty());
  EXPECT_EQ(picture->text[0].rfind("visible", 0), 0u) << picture->text[0];
}

TEST_F(SightTools, DrawTheLineFromEndToEnd) {
  const Pick from = pickAt({5, 5}), to = pickAt({30, 20});
  const auto picture = tool_.between(from, 50, to, 70);
  ASSERT_TRUE(picture);
  const double metres = space_.metresPerHeight();
  const Vec3 first = picture->points.front(), last = picture->points.back();
  EXPECT_NEAR(first.x, from.metric.x, 1e-6);
  EXPECT_NEAR(first.y, from.metric.y, 1e-6);
  EXPECT_NEAR(first.z, from.metric.z + 50 * metres, 1e-6);
  EXPECT_NEAR(last.x, to.metric.x, 1e-6);
  EXPECT_NEAR(last.y, to.metric.y, 1e-6);
  EXPECT_NEAR(last.z, to.metric.z + 70 * metres, 1e-6);
}

TEST_F(SightTools, MarkTheFirstObstructionOnTheLine) {
  int blocked = 0;
  for (double y = 2; y < 28; y += 5) {
    const auto picture = tool_.between(pickAt({2, y}), 0.01, pickAt({44, y}), 0.01);
    ASSERT_TRUE(picture);
    if (picture->answer.sight.verdict != SightVerdict::blocked) continue;
    ++blocked;
    ASSERT_TRUE(picture->obstruction);
    EXPECT_LT(picture->pointsBefore, picture->points.size());
    const Vec3 a = picture->points.front(), b = picture->points.back(), o = *picture->obstruction;
    const double part = std::hypot(o.x - a.x, o.y - a.y) / std::hypot(b.x - a.x, b.y - a.y);
    EXPECT_NEAR(o.z, a.z + part * (b.z - a.z), 1e-6 * std::abs(b.x - a.x))
        << "over a plane the line is straight";
    EXPECT_EQ(picture->text[0], "blocked");
    // The pieces follow each other without a gap, and their kind changes at the obstruction.
    const std::vector<SightPiece> pieces = piecesOf(*picture);
    EXPECT_EQ(pieces.front().from, a);
    EXPECT_EQ(pieces.back().to, b);
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      EXPECT_EQ(pieces[i].from, pieces[i - 1].to);
      EXPECT_EQ(pieces[i].isBefore != pieces[i - 1].isBefore, pieces[i].from == o);
    }
  }
  EXPECT_GT(blocked, 0);
}

TEST_F(SightTools, TakeTheMapAsAPlaneWithoutAnEllipsoid) {
  EXPECT_EQ(tool_.earthName(), "plane") << "the CRS of this model is a name only";
}

}  // namespace
}  // namespace arete
