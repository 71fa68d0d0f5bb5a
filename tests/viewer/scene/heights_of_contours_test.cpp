// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene/heights_of_contours.h"

#include <gtest/gtest.h>

#include <vector>

namespace arete {
namespace {

/// Remembers the intervals that heights were asked for.
struct Writer {
  std::vector<double> asked = {};
  WriteHeights write() {
    return [this](double interval) -> Result<Layer::Drawn> {
      asked.push_back(interval);
      return Layer::Drawn();
    };
  }
};

TEST(HeightsOfContours, ComeAndGoWithTheLines) {
  Writer writer;
  HeightsOfContours heights(writer.write());
  Layers layers;
  ASSERT_TRUE(heights.follow(layers));
  EXPECT_EQ(layers.find("heights of contours"), nullptr);
  layers.put("contours", Contours{50});
  ASSERT_TRUE(heights.follow(layers));
  ASSERT_TRUE(heights.follow(layers));
  EXPECT_NE(layers.find("heights of contours"), nullptr);
  EXPECT_EQ(writer.asked, std::vector<double>{50});
  layers.remove("contours");
  ASSERT_TRUE(heights.follow(layers));
  EXPECT_EQ(layers.find("heights of contours"), nullptr);
}

TEST(HeightsOfContours, AreNeverOfAnotherInterval) {
  Writer writer;
  HeightsOfContours heights(writer.write());
  Layers layers;
  layers.put("contours", Contours{50});
  ASSERT_TRUE(heights.follow(layers));
  layers.put("contours", Contours{20});
  ASSERT_TRUE(heights.follow(layers, true));
  EXPECT_EQ(layers.find("heights of contours"), nullptr);
  ASSERT_TRUE(heights.follow(layers));
  EXPECT_NE(layers.find("heights of contours"), nullptr);
  EXPECT_EQ(writer.asked, (std::vector<double>{50, 20}));
}

TEST(HeightsOfContours, AreSeenAsTheLinesAre) {
  Writer writer;
  HeightsOfContours heights(writer.write());
  Layers layers;
  Layer& lines = layers.put("contours", Contours{50});
  lines.isVisible = false;
  lines.opacity = 0.25;
  ASSERT_TRUE(heights.follow(layers));
  const Layer* written = layers.find("heights of contours");
  ASSERT_NE(written, nullptr);
  EXPECT_FALSE(written->isVisible);
  EXPECT_EQ(written->opacity, 0.25);
}

TEST(HeightsOfContours, AreNotWrittenWithoutAWriter) {
  HeightsOfContours heights({});
  Layers layers;
  layers.put("contours", Contours{50});
  ASSERT_TRUE(heights.follow(layers));
  EXPECT_EQ(layers.list().size(), 1u);
}

TEST(HeightsOfContours, ThatCannotBeWrittenAreAnError) {
  HeightsOfContours heights(
      [](double) -> Result<Layer::Drawn> { return failure(ErrorCode::unsupported, "no room", "heights"); });
  Layers layers;
  layers.put("contours", Contours{50});
  const Status followed = heights.follow(layers);
  ASSERT_FALSE(followed);
  EXPECT_EQ(followed.error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace arete
