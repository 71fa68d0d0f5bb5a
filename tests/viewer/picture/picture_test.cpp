// SPDX-License-Identifier: GPL-3.0-or-later
// The canvas: pixels, clipping, PNG files.
#include "viewer/picture/picture.h"

#include <gtest/gtest.h>
#include <cstdint>
#include <filesystem>
#include <string>

#include "viewer/picture_fixture.h"

namespace arete {
namespace {

using test::bigEndian;
using test::bytesOf;
using test::TemporaryFolder;

TEST(Picture, SavesAPngOfItsSize) {
  const TemporaryFolder folder;
  auto canvas = Canvas::create(37, 21, {10, 20, 30});
  ASSERT_TRUE(canvas);
  ASSERT_TRUE(canvas->savePng(folder / "a.png"));
  const std::string png = bytesOf(folder / "a.png");
  ASSERT_GT(png.size(), 33u);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(png.substr(12, 4), "IHDR");
  EXPECT_EQ(bigEndian(png, 16), 37u);
  EXPECT_EQ(bigEndian(png, 20), 21u);
  EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND");
  EXPECT_EQ(folder.files(), 1u) << "no temporary file stays behind";
}

TEST(Picture, SaysWhyItCannotBeMadeOrSaved) {
  EXPECT_EQ(Canvas::create(0, 10).error().code, ErrorCode::usage);
  EXPECT_EQ(Canvas::create(10, 40000).error().code, ErrorCode::usage);
  const TemporaryFolder folder;
  auto canvas = Canvas::create(4, 4);
  ASSERT_TRUE(canvas);
  EXPECT_FALSE(canvas->savePng(folder / "missing/a.png"));
}

TEST(Picture, DrawsWhatItIsTold) {
  auto canvas = Canvas::create(20, 20, {255, 255, 255});
  ASSERT_TRUE(canvas);
  canvas->fill({5, 5, 10, 10}, {200, 0, 0});
  EXPECT_EQ(canvas->pixel(10, 10), (Rgb{200, 0, 0}));
  EXPECT_EQ(canvas->pixel(4, 4), (Rgb{255, 255, 255}));
  Image image(2, 1);
  image.at(0, 0) = {1, 2, 3};
  image.at(1, 0) = {4, 5, 6};
  canvas->image(image, 18, 0);
  EXPECT_EQ(canvas->pixel(18, 0), (Rgb{1, 2, 3}));
  EXPECT_EQ(canvas->pixel(19, 0), (Rgb{4, 5, 6}));
  canvas->clip({0, 0, 2, 20});
  canvas->fill({0, 0, 20, 20}, {0, 0, 0});
  canvas->unclip();
  EXPECT_EQ(canvas->pixel(1, 19), (Rgb{0, 0, 0}));
  EXPECT_EQ(canvas->pixel(2, 19), (Rgb{255, 255, 255}));
}

}  // namespace
}  // namespace arete
