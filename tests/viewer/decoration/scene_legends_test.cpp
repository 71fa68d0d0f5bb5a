// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/decoration/scene_legends.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "terrain/builder/build.h"
#include "viewer/color/color_tables.h"
#include "viewer/scene/terrain_subject.h"

namespace arete {
namespace {

/// A ramp from 200 to 300.
TerrainModel rampOfHeights() {
  RasterHeightfield field;
  field.columns = field.rows = 11;
  for (std::uint32_t i = 0; i < 121; ++i) field.heights.push_back(200 + 10 * (i % 11));
  field.georeference.verticalUnit = "m";
  field.georeference.hasGeoTransform = true;
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model) << model.error().describe();
  return std::move(*model);
}

TEST(SceneLegends, AreOfWhatTheGroundIsColouredBy) {
  const TerrainModel model = rampOfHeights();
  const TerrainSubject subject(model);
  const SceneLegends legends(subject);
  ViewSettings settings;
  const auto only = [&] {
    const auto all = legends.of(settings, {});
    EXPECT_EQ(all.size(), 1u);
    return all.empty() ? ColorLegend() : all[0];
  };
  const ColorLegend heights = only();
  EXPECT_EQ(heights.unit, "m");
  ASSERT_TRUE(heights.scale);
  EXPECT_EQ(heights.scale->low, 200);
  EXPECT_EQ(heights.scale->high, 300);
  EXPECT_EQ(heights.scale->map, heightColors(200, 300));
  settings.look.coloring = Coloring::aspect;
  EXPECT_EQ(only().scale->ticks.at(1).second, "east");
  settings.look.coloring = Coloring::error;
  settings.pixels = 3;
  EXPECT_EQ(only().scale->high, 3);
  EXPECT_EQ(only().unit, "pixels");
  settings.look.heatError = 12;
  EXPECT_EQ(only().scale->high, 12);
  EXPECT_EQ(only().unit, "m");
  settings.look.coloring = Coloring::plain;
  EXPECT_TRUE(legends.of(settings, {}).empty());
}

TEST(SceneLegends, OfAnInkAreItsScaleAndItsClasses) {
  const TriangleInk ink{.numbers = {-2, 3},
                        .colors = colorTable("error").over(-7, 3),
                        .title = "error of uv",
                        .unit = "pixels",
                        .ticks = {{-7, "0 to 0.1"}, {3, "8"}},
                        .classes = {{{70, 130, 220, 255}, "no bound"}}};
  const ColorLegend legend = legendOf(ink);
  EXPECT_EQ(legend.title, "error of uv");
  EXPECT_EQ(legend.unit, "pixels");
  ASSERT_TRUE(legend.scale);
  EXPECT_EQ(legend.scale->low, -7);
  EXPECT_EQ(legend.scale->high, 3);
  EXPECT_EQ(legend.scale->ticks, ink.ticks);
  EXPECT_EQ(legend.scale->map, ink.colors);
  ASSERT_EQ(legend.classes.size(), 1u);
  EXPECT_EQ(legend.classes[0].label, "no bound");
  const TerrainModel model = rampOfHeights();
  const TerrainSubject subject(model);
  ViewSettings settings;
  settings.look.coloring = Coloring::ink;
  settings.look.ink = "charts";
  EXPECT_EQ(subject.ink("charts").error().culprit, "charts");
  EXPECT_TRUE(SceneLegends(subject).of(settings, {}).empty()) << "terrain has no inks";
}

TEST(SceneLegends, OfLayersComeFirstAndTheHighestIsTheFirst) {
  const TerrainModel model = rampOfHeights();
  const TerrainSubject subject(model);
  const SceneLegends legends(subject);
  Layers layers;
  layers.put("contours", Contours{25});
  layers.put("roads", SpaceVertices{}).legend = {"Roads", {{Rgba{1, 2, 3, 255}, "paved"}}};
  const auto all = legends.of({}, layers.list());
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].title, "Roads");
  EXPECT_EQ(all[0].classes.at(0).label, "paved");
  EXPECT_EQ(all[0].classes.at(0).colors.at(0), (Rgb{1, 2, 3}));
  EXPECT_EQ(all[1].classes.at(0).label, "contours, every 25 m");
  EXPECT_EQ(all[1].classes.at(1).label, "where close, every 125 m");
  EXPECT_EQ(all[2].title, "height");
  layers.find("roads")->isVisible = false;
  EXPECT_EQ(legends.of({}, layers.list()).size(), 2u);
}

TEST(SceneLegends, AreasShineThroughUnderTheHeadingOfTheirLines) {
  const TerrainModel model = rampOfHeights();
  const TerrainSubject subject(model);
  const SceneLegends legends(subject);
  Layers layers;
  Layer& areas = layers.put("park (areas)", std::make_shared<const PlanPicture>());
  areas.legend = {"Park", {{Rgba{255, 0, 0, 255}, "areas"}}};
  areas.opacity = 0.2;
  layers.put("park", SpaceVertices{}).legend = {"Park",
                                                {{Rgba{255, 0, 0, 255}, "points", Legend::Mark::point},
                                                 {Rgba{255, 0, 0, 255}, "lines", Legend::Mark::line}}};
  const auto all = legends.of({}, layers.list());
  ASSERT_EQ(all.size(), 2u) << "and that of the ground";
  ASSERT_EQ(all[0].classes.size(), 3u);
  EXPECT_EQ(all[0].classes[0].mark, Legend::Mark::point);
  EXPECT_EQ(all[0].classes[1].colors.at(0), (Rgb{255, 0, 0}));
  EXPECT_EQ(all[0].classes[2].mark, Legend::Mark::area);
  EXPECT_EQ(all[0].classes[2].colors.at(0), (Rgb{255, 204, 204}));
}

}  // namespace
}  // namespace arete
