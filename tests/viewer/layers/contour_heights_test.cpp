// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/layers/contour_heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "terrain/builder/build.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/headless/headless.h"

namespace arete {
namespace {

TEST(ContourHeights, StandOnEveryFifthLineAndFarFromEachOther) {
  { ARETE_NEEDS_OPENGL(context); }
  // A plane that rises by 1 m in 1 m to the east: every fifth line of 10 m is a meridian at a multiple of 50.
  RasterHeightfield field;
  field.columns = field.rows = 100;
  field.georeference.geoTransform = {0, 4, 0, 0, 0, -4};
  field.georeference.hasGeoTransform = true;
  for (int row = 0; row < 100; ++row)
    for (int column = 0; column < 100; ++column) field.heights.push_back(4 * column + 2.0);
  auto model = build(field);
  ASSERT_TRUE(model);
  const auto labels = contourLabels(*model, 10);
  ASSERT_TRUE(labels);
  ASSERT_FALSE(labels->empty());
  for (const ContourLabel& label : *labels) ASSERT_NEAR(label.xy.x, label.height, 1e-6);

  const auto imageWith = [&](std::span<const ContourLabel> written) {
    HeadlessOptions options{.widthPixels = 300, .heightPixels = 300, .samples = 1, .settings = {}};
    options.settings.look.isShaded = false;
    options.settings.look.coloring = Coloring::plain;
    auto view = HeadlessView::create(options, [&](Scene& scene) -> Status {
      ARETE_TRY(TerrainDrawable made, TerrainDrawable::create(*model, {}));
      ARETE_CHECK(scene.add(std::make_unique<TerrainDrawable>(std::move(made))));
      ARETE_TRY(auto heights, ContourHeights::create(written));
      scene.layers.put("heights of contours", Layer::Drawn(std::move(heights)));
      return {};
    });
    EXPECT_TRUE(view) << view.error().describe();
    EXPECT_TRUE(view->draw({.xy = {200, -200}, .height = 800, .pitchDegrees = -90}));
    return view->image();
  };
  const Image bare = imageWith({}), written = imageWith(*labels),
              one = imageWith(std::span(*labels).first(1));
  int ofAll = 0, ofOne = 0;
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x) {
      ofAll += written.at(x, y) != bare.at(x, y) ? 1 : 0;
      ofOne += one.at(x, y) != bare.at(x, y) ? 1 : 0;
    }
  EXPECT_GT(ofOne, 20);
  EXPECT_GT(ofAll, 2 * ofOne);
  // At most one in a square of 70 pixels, and the picture has 18 of them.
  EXPECT_LT(ofAll, 26 * ofOne);
}

}  // namespace
}  // namespace arete
