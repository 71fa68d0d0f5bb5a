// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/cursor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "viewer/camera_models.h"
#include "viewer/scene/drawn_within.h"
#include "viewer/viewed_terrain.h"

namespace arete {
namespace {

struct Looked {
  TerrainSubject subject;
  Layers layers;
  std::optional<TerrainTools> tools;
  Cursor cursor{subject, tools};
  Camera camera;

  explicit Looked(const TerrainModel& model) : subject(model) {
    tools.emplace(subject, layers);
    camera = subject.home(HomeView::fromAbove, {.widthPixels = 800, .heightPixels = 600}, {});
  }
  Cursor::Now at(Vec2 pixel) const {
    return {.mouse = pixel, .camera = camera, .cutFor = camera, .pixels = 1};
  }
};

TEST(Cursor, ShowsTheHeightOfFullResolutionAndHowFarTheDrawnOneMayBeFromIt) {
  for (const test::CameraModel& m : test::cameraModels()) {
    SCOPED_TRACE(m.name);
    Looked looked(m.model);
    looked.cursor.update(looked.at({400, 300}));
    const auto& pick = looked.cursor.pick();
    const auto wanted = looked.subject.pick(looked.camera, {400, 300});
    ASSERT_EQ(pick.has_value(), wanted.has_value());
    if (!pick) continue;
    EXPECT_EQ(pick->height, looked.subject.heights()->at(pick->xy)->height);
    EXPECT_NE(looked.cursor.text().find(looked.tools->places.height(pick->height)), std::string::npos)
        << looked.cursor.text();
    EXPECT_NE(looked.cursor.text().find(looked.cursor.within() > 0 ? "drawn within" : "drawn as it is"),
              std::string::npos)
        << looked.cursor.text();
    EXPECT_EQ(looked.cursor.within(),
              drawnWithin(looked.subject, looked.camera, {.isGeomorphed = false}, 1, *pick));
  }
}

TEST(Cursor, AsksNothingWhileNothingChanges) {
  Looked looked(test::cameraModels()[0].model);
  for (int i = 0; i < 10; ++i) looked.cursor.update(looked.at({400, 300}));
  EXPECT_EQ(looked.cursor.asked(), 1);
  looked.cursor.update(looked.at({401, 300}));
  EXPECT_EQ(looked.cursor.asked(), 2);
  for (int i = 0; i < 10; ++i) looked.cursor.update({.camera = looked.camera});
  EXPECT_EQ(looked.cursor.asked(), 2) << "the mouse is over a panel";
  EXPECT_EQ(looked.cursor.text(), "");
  EXPECT_FALSE(looked.cursor.pick());
}

TEST(Cursor, SaysNoDataOverAHoleAndNothingOverTheSky) {
  RasterHeightfield field;
  field.columns = field.rows = 30;
  for (std::uint32_t row = 0; row < 30; ++row)
    for (std::uint32_t column = 0; column < 30; ++column)
      field.heights.push_back(row > 10 && row < 20 && column > 10 && column < 20
                                  ? std::numeric_limits<double>::quiet_NaN()
                                  : 100.0 + 0.01 * (row * row + column));
  auto model = build(field);
  ASSERT_TRUE(model);
  Looked looked(*model);
  const auto textAt = [&](Vec2 pixel) {
    looked.cursor.update(looked.at(pixel));
    return looked.cursor.text();
  };
  EXPECT_EQ(textAt({400, 300}), "no data");
  EXPECT_EQ(textAt({2, 2}), "");
  EXPECT_NE(textAt({250, 300}).find("drawn"), std::string::npos) << looked.cursor.text();
  looked.camera.pitchDegrees = 30;
  EXPECT_EQ(textAt({400, 300}), "") << "the sky";
}

}  // namespace
}  // namespace arete
