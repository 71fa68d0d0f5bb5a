// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/drape/source.h"

#include <gtest/gtest.h>

#include "io/drape_fixture.h"

namespace arete {
namespace {

using test::joined;
using test::PictureSpec;
using test::TemporaryFolder;

class DrapeSourceTest : public ::testing::Test {
 protected:
  static PictureSpec spec(int bands) {
    PictureSpec spec;
    spec.columns = spec.rows = 64;
    spec.transform = {0, 1, 0, 64, 0, -1};
    spec.bands = bands;
    spec.value = [](int column, int row, int band) { return (column + 2 * row + 50 * band) % 256; };
    return spec;
  }
  std::string write(const PictureSpec& spec) { return test::writePicture(folder_.file("a.tif"), spec); }
  Result<DrapeSource> open(const PictureSpec& spec, const std::vector<int>& bands = {}) {
    warnings_.clear();
    return openDrapeSource(write(spec), bands, warnings_);
  }
  static void interpret(GDALDataset& dataset, std::initializer_list<GDALColorInterp> meanings) {
    int band = 0;
    for (const GDALColorInterp meaning : meanings)
      dataset.GetRasterBand(++band)->SetColorInterpretation(meaning);
  }
  TemporaryFolder folder_;
  Warnings warnings_;
};

TEST_F(DrapeSourceTest, TakesTheBandsThatTheFileNames) {
  PictureSpec picture = spec(4);
  picture.options = {"PHOTOMETRIC=MINISBLACK", "ALPHA=NO"};
  picture.adjust = [](GDALDataset& dataset) {
    interpret(dataset, {GCI_BlueBand, GCI_GreenBand, GCI_RedBand, GCI_AlphaBand});
  };
  const auto source = open(picture);
  ASSERT_TRUE(source) << source.error().describe();
  EXPECT_EQ(source->colors, (std::vector<int>{3, 2, 1}));
  EXPECT_EQ(source->alpha, 4);
  EXPECT_FALSE(source->isStretched);
  EXPECT_TRUE(warnings_.empty()) << joined(warnings_);
}

TEST_F(DrapeSourceTest, TakesTheFirstBandsOtherwise) {
  PictureSpec five = spec(5), two = spec(2);
  for (PictureSpec* picture : {&five, &two}) picture->options = {"PHOTOMETRIC=MINISBLACK", "ALPHA=NO"};
  const auto colors = open(five);
  ASSERT_TRUE(colors);
  EXPECT_EQ(colors->colors, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(warnings_.size(), 1u);
  const auto grey = open(two);
  ASSERT_TRUE(grey);
  EXPECT_EQ(grey->colors, (std::vector<int>{1}));
  EXPECT_EQ(warnings_.size(), 1u);
  const auto stated = open(five, {5});
  ASSERT_TRUE(stated);
  EXPECT_EQ(stated->colors, (std::vector<int>{5}));
}

TEST_F(DrapeSourceTest, RefusesBandsThatAreMissing) {
  for (const std::vector<int>& bands : {std::vector<int>{4}, {0}, {1, 2}, {1, 2, 3, 1}}) {
    const auto source = open(spec(3), bands);
    ASSERT_FALSE(source);
    EXPECT_EQ(source.error().code, ErrorCode::usage);
  }
  PictureSpec complex = spec(1);
  complex.type = GDT_CFloat32;
  EXPECT_EQ(open(complex).error().code, ErrorCode::unsupported);
  EXPECT_EQ(openDrapeSource(folder_.file("no.tif"), {}, warnings_).error().code, ErrorCode::notFound);
}

TEST_F(DrapeSourceTest, StretchesNumbersOfOtherTypes) {
  PictureSpec picture = spec(1);
  picture.type = GDT_UInt16;
  const auto source = open(picture);
  ASSERT_TRUE(source);
  EXPECT_TRUE(source->isStretched);
}

TEST_F(DrapeSourceTest, ExpandsAColorTableWithItsNodata) {
  PictureSpec picture = spec(1);
  picture.value = [](int column, int, int) { return column % 3; };
  picture.adjust = [](GDALDataset& dataset) {
    GDALColorTable table;
    const GDALColorEntry red{255, 0, 0, 255}, green{0, 255, 0, 255}, blue{0, 0, 255, 255};
    table.SetColorEntry(0, &red);
    table.SetColorEntry(1, &green);
    table.SetColorEntry(2, &blue);
    dataset.GetRasterBand(1)->SetColorTable(&table);
    dataset.GetRasterBand(1)->SetNoDataValue(2);
  };
  const auto source = open(picture);
  ASSERT_TRUE(source) << source.error().describe();
  EXPECT_TRUE(source->opened.isExpanded());
  EXPECT_EQ(source->colors, (std::vector<int>{1, 2, 3}));
  std::array<std::uint8_t, 3> green{}, alpha{};
  for (const auto& [band, line] : {std::pair{2, &green}, {4, &alpha}})
    ASSERT_EQ(source->dataset().GetRasterBand(band)->RasterIO(GF_Read, 0, 0, 3, 1, line->data(), 3, 1,
                                                              GDT_Byte, 0, 0, nullptr),
              CE_None);
  EXPECT_EQ(green[1], 255);
  EXPECT_EQ(alpha[0], 255);
  EXPECT_EQ(alpha[2], 0) << "the NODATA index is transparent";
}

TEST_F(DrapeSourceTest, ReopensAtAnOverviewThatIsFineEnough) {
  const std::string path = write(spec(1));
  {
    const GdalDatasetPtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
    const int levels[] = {2, 4};
    ASSERT_EQ(dataset->BuildOverviews("AVERAGE", 2, const_cast<int*>(levels), 0, nullptr, nullptr, nullptr),
              CE_None);
  }
  for (const auto& [coarser, expected] : {std::pair{1.5, 1.0}, {2.0, 2.0}, {3.9, 2.0}, {100.0, 4.0}}) {
    auto source = openDrapeSource(path, {}, warnings_);
    ASSERT_TRUE(source);
    const auto overview = openDrapeOverview(path, std::move(*source), coarser);
    ASSERT_TRUE(overview);
    EXPECT_EQ(overview->coarser, expected) << coarser;
    EXPECT_EQ(overview->dataset().GetRasterXSize(), int(64 / expected));
  }
}

}  // namespace
}  // namespace arete
