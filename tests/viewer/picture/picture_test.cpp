// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/picture/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <tuple>

#include "viewer/picture/chart.h"
#include "viewer/picture/color_ramp.h"
#include "viewer/picture/error_map.h"
#include "viewer/picture/hillshade.h"
#include "viewer/picture/map_page.h"
#include "viewer/picture/ticks.h"
#include "viewer/picture/tin_picture.h"

namespace arete {

void PrintTo(const Rgb& c, std::ostream* out) {
  *out << "(" << int(c.r) << ", " << int(c.g) << ", " << int(c.b) << ")";
}

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

template <class Height>
RasterHeightfield field(std::uint32_t columns, std::uint32_t rows, const Height& height) {
  RasterHeightfield h;
  h.columns = columns;
  h.rows = rows;
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) h.heights.push_back(height(c, r));
  }
  return h;
}

/// A CRS by name only: the viewer asks whether there is one, never what it says.
RasterHeightfield located(RasterHeightfield h, double cell, bool southUp = false) {
  h.georeference.crsWkt = "LOCAL_CS[\"metres\"]";
  h.georeference.hasGeoTransform = true;
  h.georeference.geoTransform = {1000, cell, 0, 5000, 0, southUp ? cell : -cell};
  return h;
}

class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("arete_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::size_t files() const {
    return std::size_t(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::uint32_t bigEndian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::uint8_t(bytes[at + i]);
  return value;
}

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

TEST(Ticks, NumbersReadWell) {
  EXPECT_EQ(numberText(0), "0");
  EXPECT_EQ(numberText(1234), "1234");
  EXPECT_EQ(numberText(-0.5), "\u22120.5");
  EXPECT_EQ(numberText(93410), "93\u2009410");
  EXPECT_EQ(numberText(9.98765), "9.988");
  EXPECT_EQ(numberText(kNone), "?");
  EXPECT_EQ(countText(1535664), "1\u2009535\u2009664");
  EXPECT_EQ(signedText(2.5), "+2.5");
}

TEST(Ticks, StepsAreRound) {
  EXPECT_DOUBLE_EQ(roundDownNice(4999), 2000);
  EXPECT_DOUBLE_EQ(roundDownNice(5000), 5000);
  EXPECT_DOUBLE_EQ(roundDownNice(0.003), 0.002);
  EXPECT_EQ(linearTicks(-10, 10, 4), (std::vector<double>{-10, -5, 0, 5, 10}));
  std::vector<double> major;
  for (const LogTick& tick : logTicks(1, 100)) {
    if (tick.major) major.push_back(tick.value);
  }
  EXPECT_EQ(major, (std::vector<double>{1, 2, 5, 10, 20, 50, 100}));
}

TEST(ColorRamp, EndsAndMiddleAreWhatTheySay) {
  const auto ramp = divergingRamp();
  EXPECT_EQ(rampColor(ramp, -3), ramp.front());
  EXPECT_EQ(rampColor(ramp, 7), ramp.back());
  EXPECT_EQ(rampColor(ramp, 0.5), ramp[ramp.size() / 2]);
  EXPECT_EQ(rampColor(ramp, kNone), ramp.front());
}

TEST(MapView, KeepsTheGroundsAspect) {
  // At 60 degrees a degree of longitude is about half a degree of latitude.
  RasterHeightfield h = field(101, 101, [](double, double) { return 0.0; });
  h.georeference.crsWkt = "GEOGCS";
  h.georeference.isGeographic = true;
  h.georeference.hasGeoTransform = true;
  h.georeference.geoTransform = {10, 0.001, 0, 60.05, 0, -0.001};
  const MapView view = fitGrid(101, 101, h.georeference, 1000, 1000);
  EXPECT_EQ(view.height, 1000);
  EXPECT_NEAR(view.width, 501, 3);
  const auto north = northInView(view, h.georeference);
  ASSERT_TRUE(north);
  EXPECT_NEAR(north->y, -1, 1e-9);
}

TEST(MapView, TurnsASouthUpGridOver) {
  const auto h = located(field(11, 6, [](double, double) { return 0.0; }), 10, true);
  const MapView view = fitGrid(11, 6, h.georeference, 100, 100);
  EXPECT_EQ(view.toPixel(0, 5).y, 0);
  EXPECT_EQ(view.toPixel(0, 0).y, view.height);
  EXPECT_NEAR(northInView(view, h.georeference)->y, -1, 1e-12);
  EXPECT_FALSE(northInView(view, Georeference{})) << "without a CRS nobody knows where north is";
}

TEST(Hillshade, IsUniformOnFlatGround) {
  const auto h = located(field(40, 30, [](double, double) { return 250.0; }), 30);
  const Image image = drawHillshade(h, fitGrid(40, 30, h.georeference, 117, 117));
  for (const Rgb& pixel : image.pixels) ASSERT_EQ(pixel, image.at(0, 0));
}

TEST(Hillshade, LightsTheUpperLeftOfAHill) {
  const auto h =
      located(field(41, 41, [](double c, double r) { return 400 - 14 * std::hypot(c - 20, r - 20); }), 30);
  const Image image = drawHillshade(h, fitGrid(41, 41, h.georeference, 200, 200), {.tint = 0});
  EXPECT_GT(image.at(70, 70).g, image.at(130, 130).g + 40);
  const auto southUp = located(h, 30, true);
  const Image turned = drawHillshade(southUp, fitGrid(41, 41, southUp.georeference, 200, 200), {.tint = 0});
  EXPECT_EQ(turned.at(70, 70), image.at(70, 70)) << "a hill is its own mirror image, and the light stays put";
}

TEST(Hillshade, LeavesNodataAlone) {
  const auto h = located(field(40, 40, [](double c, double) { return c < 20 ? kNone : 5.0; }), 30);
  const Image image = drawHillshade(h, fitGrid(40, 40, h.georeference, 80, 80));
  EXPECT_EQ(image.at(5, 40), kNodataColor);
  EXPECT_NE(image.at(75, 40), kNodataColor);
  const Image none =
      drawHillshade(located(field(4, 4, [](double, double) { return kNone; }), 1), fitGrid(4, 4, {}, 20, 20));
  for (const Rgb& pixel : none.pixels) ASSERT_EQ(pixel, kNodataColor);
}

TEST(Hillshade, AveragesAllSamplesWhenReduced) {
  // A fine checkerboard of 10 m around a level of 100 m is level when its samples are far smaller than a
  // pixel.
  const auto h = located(
      field(801, 801, [](std::uint32_t c, std::uint32_t r) { return (c + r) % 2 == 0 ? 90.0 : 110.0; }), 1);
  const Image image =
      drawHillshade(h, fitGrid(801, 801, h.georeference, 40, 40), {.verticalExaggeration = 1});
  for (int y = 2; y < 38; ++y) {
    for (int x = 2; x < 38; ++x) ASSERT_NEAR(image.at(x, y).g, image.at(20, 20).g, 2);
  }
}

TEST(ErrorMap, PaintsZeroExtremesAndNodata) {
  // Four quarters: -8 m, +8 m, 0, none.
  const auto errors = located(field(60, 40,
                                    [](double c, double r) {
                                      if (r < 20) return c < 30 ? -8.0 : 8.0;
                                      return c < 30 ? 0.0 : kNone;
                                    }),
                              30);
  const ErrorMapOptions options = {.width = 800, .title = "Errors", .limit = 8};
  const auto layout = errorMapLayout(errors, options);
  const auto canvas = drawErrorMap(errors, options);
  ASSERT_TRUE(layout && canvas);
  EXPECT_EQ(canvas->width(), 800);
  const auto at = [&](double x, double y) {
    return canvas->pixel(int(layout->map.left + layout->map.width * x),
                         int(layout->map.top + layout->map.height * y));
  };
  const auto ramp = divergingRamp();
  EXPECT_EQ(at(0.25, 0.25), ramp.front());
  EXPECT_EQ(at(0.75, 0.25), ramp.back());
  EXPECT_EQ(at(0.25, 0.75), ramp[ramp.size() / 2]);
  const Rgb none = at(0.75, 0.75);
  EXPECT_TRUE(none.r == 190 && none.g == 191 && none.b == 194);

  // The frame covers the outermost row of the bar.
  const Rect bar = layout->colorBar;
  const int middle = int(bar.left + bar.width / 2);
  const auto near = [](Rgb a, Rgb b) {
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) <= 16;
  };
  EXPECT_TRUE(near(canvas->pixel(middle, int(bar.top) + 2), ramp.back()));
  EXPECT_TRUE(near(canvas->pixel(middle, int(bar.bottom()) - 3), ramp.front()));
}

TEST(ErrorMap, ShowsALoneExtremeHoweverFarReduced) {
  const auto errors = located(
      field(2001, 1001, [](std::uint32_t c, std::uint32_t r) { return c == 777 && r == 333 ? 5.0 : 0.0; }),
      1);
  const ErrorMapOptions options = {.width = 640};
  const auto canvas = drawErrorMap(errors, options);
  const auto layout = errorMapLayout(errors, options);
  ASSERT_TRUE(canvas && layout);
  EXPECT_DOUBLE_EQ(layout->limit, 5);
  int found = 0;
  for (int y = int(layout->map.top) + 1; y < int(layout->map.bottom()) - 1; ++y) {
    for (int x = int(layout->map.left) + 1; x < int(layout->map.right()) - 1; ++x)
      found += canvas->pixel(x, y) == divergingRamp().back();
  }
  EXPECT_EQ(found, 1);
}

TEST(ErrorMap, RefusesWhatItCannotDraw) {
  EXPECT_EQ(drawErrorMap(field(5, 5, [](double, double) { return kNone; })).error().code,
            ErrorCode::invalidData);
  EXPECT_EQ(drawErrorMap(field(5, 5, [](double, double) { return 1.0; }), {.limit = -1}).error().code,
            ErrorCode::invalidData);
  EXPECT_EQ(drawErrorMap(field(5, 1, [](double, double) { return 1.0; })).error().code,
            ErrorCode::degenerate);
  EXPECT_EQ(drawErrorMap(field(5, 5, [](double, double) { return 1.0; }), {.width = 100}).error().code,
            ErrorCode::usage);
}

RasterHeightfield hills() {
  return located(
      field(120, 80, [](double c, double r) { return 300 + 120 * std::sin(c / 9) * std::cos(r / 11); }), 30);
}

/// Every cell in two triangles.
TriangleMesh finest(const RasterHeightfield& h) {
  TriangleMesh mesh;
  for (std::uint32_t r = 0; r < h.rows; ++r) {
    for (std::uint32_t c = 0; c < h.columns; ++c) {
      const Vec2 p = h.georeference.toSource(c, r);
      mesh.positions.push_back({p.x, p.y, h.at(c, r)});
      if (r + 1 == h.rows || c + 1 == h.columns) continue;
      const std::uint32_t ul = h.index(c, r), ll = ul + h.columns;
      mesh.triangles.push_back({ul, ll, ll + 1});
      mesh.triangles.push_back({ul, ll + 1, ul + 1});
    }
  }
  return mesh;
}

TEST(TinPicture, IsTheSameFileTwice) {
  const TemporaryFolder folder;
  const RasterHeightfield h = hills();
  for (const char* name : {"a.png", "b.png"}) {
    auto canvas = drawTin(
        h, finest(h),
        {.width = 700, .title = "Hills", .tolerance = 1.0, .measuredError = 0.5, .finestTriangles = 20000});
    ASSERT_TRUE(canvas);
    ASSERT_TRUE(canvas->savePng(folder / name));
  }
  EXPECT_EQ(bytesOf(folder / "a.png"), bytesOf(folder / "b.png"));
}

TEST(TinPicture, DrawsTheEdges) {
  const RasterHeightfield h = located(field(11, 11, [](double, double) { return 100.0; }), 30);
  TriangleMesh mesh;
  for (const auto& [c, r] : {std::pair{0, 0}, {0, 10}, {10, 10}, {10, 0}}) {
    const Vec2 p = h.georeference.toSource(c, r);
    mesh.positions.push_back({p.x, p.y, 100});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto canvas = drawTin(h, mesh, {.width = 700});
  const auto page = makeMapPage(11, 11, h.georeference, {.width = 700, .caption = {"", ""}});
  ASSERT_TRUE(canvas && page);
  const Vec2 middle = page->toPage(5, 5), beside = page->toPage(2, 8);
  EXPECT_LT(canvas->pixel(int(middle.x), int(middle.y)).g + 40,
            canvas->pixel(int(beside.x), int(beside.y)).g);
}

TEST(TinPicture, PutsADetailOnATinTooDenseToSee) {
  const RasterHeightfield h = hills();
  const auto with = drawTin(h, finest(h), {.width = 700}),
             without = drawTin(h, finest(h), {.width = 700, .detail = false});
  ASSERT_TRUE(with && without);
  const auto reddish = [](const Canvas& canvas) {
    int count = 0;
    for (int y = 0; y < canvas.height(); ++y) {
      for (int x = 0; x < canvas.width(); ++x) count += canvas.pixel(x, y) == Rgb{168, 44, 30};
    }
    return count;
  };
  EXPECT_GT(reddish(*with), 500);
  EXPECT_EQ(reddish(*without), 0);
}

TEST(MapPage, GivesALongCaptionARowOfItsOwn) {
  const std::string longCaption(200, 'm');
  const auto brief = makeMapPage(60, 40, {}, {.width = 700, .caption = {"brief"}});
  const auto wordy = makeMapPage(60, 40, {}, {.width = 700, .caption = {longCaption}});
  ASSERT_TRUE(brief && wordy);
  EXPECT_GT(wordy->canvas.height(), brief->canvas.height());
  // However long the line, it ends at the margin.
  for (int y = 0; y < wordy->canvas.height(); ++y) {
    for (int x = 662; x < 700; ++x) ASSERT_EQ(wordy->canvas.pixel(x, y), (Rgb{255, 255, 255}));
  }
}

TEST(TinPicture, RefusesABrokenMesh) {
  TriangleMesh mesh;
  mesh.triangles = {{0, 1, 2}};
  EXPECT_FALSE(drawTin(hills(), mesh));
}

TEST(Chart, DrawsEverySeriesInItsColor) {
  const std::vector<ChartSeries> series = {{"one", {{1, 1000}, {10, 100}, {100, 10}}, false},
                                           {"two", {{1, 500}, {100, 5}}, true}};
  const auto canvas =
      drawLogLogChart(series, {.width = 640, .height = 480, .title = "T", .xLabel = "x", .yLabel = "y"});
  ASSERT_TRUE(canvas);
  EXPECT_EQ(canvas->width(), 640);
  EXPECT_EQ(canvas->height(), 480);
  std::set<std::tuple<int, int, int>> colors;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const Rgb c = canvas->pixel(x, y);
      colors.insert({c.r, c.g, c.b});
    }
  }
  EXPECT_TRUE(colors.contains({0, 114, 178}));
  EXPECT_TRUE(colors.contains({213, 94, 0}));
}

TEST(Chart, DrawsOnePointAndNone) {
  EXPECT_TRUE(drawLogLogChart({}));
  const std::vector<ChartSeries> series = {{"one point", {{5, 7}}}, {"none", {}}};
  EXPECT_TRUE(drawLogLogChart(series));
}

TEST(Chart, NamesTheSeriesThatHasNoLogarithm) {
  const std::vector<ChartSeries> series = {{"good", {{1, 1}}}, {"bad", {{1, 1}, {0, 5}}}};
  const auto canvas = drawLogLogChart(series);
  ASSERT_FALSE(canvas);
  EXPECT_EQ(canvas.error().culprit, "bad");
}

}  // namespace
}  // namespace arete
