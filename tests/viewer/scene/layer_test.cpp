// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene/layer.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

TEST(Layers, KeepTheirOrderAndTheirSettingsWhenTheirContentChanges) {
  Layers layers;
  layers.put("a", Contours{10});
  layers.put("b", SpaceVertices{});
  layers.find("a")->opacity = 0.25;
  layers.find("a")->isVisible = false;
  layers.put("a", Contours{20});
  ASSERT_EQ(layers.list().size(), 2u);
  EXPECT_EQ(layers.list()[0].name, "a");
  EXPECT_EQ(std::get<Contours>(layers.list()[0].content).interval, 20);
  EXPECT_EQ(layers.list()[0].opacity, 0.25);
  EXPECT_FALSE(layers.list()[0].isVisible);
  layers.move(0, true);
  EXPECT_EQ(layers.list()[1].name, "a");
  layers.move(1, true);
  layers.move(0, false);
  EXPECT_EQ(layers.list()[1].name, "a") << "what is at an end stays there";
  layers.remove("a");
  EXPECT_EQ(layers.find("a"), nullptr);
  EXPECT_EQ(layers.list().size(), 1u);
}

TEST(Layers, SayWhatTheyAreAndWhetherTheyLieOnTheGround) {
  const Layer drape{.name = "", .content = Layer::Drape()}, overlay{.name = "", .content = Layer::Overlay()},
      contours{.name = "", .content = Contours{}}, lines{.name = "", .content = SpaceVertices{}};
  for (const Layer* layer : {&drape, &overlay, &contours}) EXPECT_TRUE(layer->isOnGround()) << layer->kind();
  EXPECT_FALSE(lines.isOnGround());
  EXPECT_EQ(drape.kind(), "a drape");
  EXPECT_EQ(overlay.kind(), "an overlay");
  EXPECT_EQ(contours.kind(), "contours");
  EXPECT_EQ(lines.kind(), "lines");
}

}  // namespace
}  // namespace arete
