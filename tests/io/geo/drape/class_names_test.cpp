// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/drape/class_names.h"

#include <gdal_priv.h>
#include <gdal_rat.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace arete {
namespace {

namespace fs = std::filesystem;

class DrapeClasses : public testing::Test {
 protected:
  void SetUp() override {
    GDALAllRegister();
    path_ = (fs::temp_directory_path() /
             ("arete_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".img"))
                .string();
  }
  void TearDown() override {
    fs::remove(path_);
    fs::remove(path_ + ".aux.xml");
  }

  /// 8 x 8 with the classes 1, 2 and 5, of which 5 is NODATA.
  void save(bool hasNames) const {
    GDALDataset* file =
        GetGDALDriverManager()->GetDriverByName("HFA")->Create(path_.c_str(), 8, 8, 1, GDT_Byte, nullptr);
    ASSERT_NE(file, nullptr);
    GDALRasterBand& band = *file->GetRasterBand(1);
    GDALColorTable colors;
    for (short i = 0; i < 6; ++i) {
      const GDALColorEntry entry = {short(10 * i), short(20 * i), short(30 * i), 255};
      colors.SetColorEntry(i, &entry);
    }
    band.SetColorTable(&colors);
    band.SetNoDataValue(5);
    if (hasNames) {
      GDALDefaultRasterAttributeTable table;
      table.CreateColumn("Class_Names", GFT_String, GFU_Name);
      table.SetRowCount(4);
      int row = 0;
      for (const char* name : {"nothing", "water", "forest", "ice"}) table.SetValue(row++, 0, name);
      band.SetDefaultRAT(&table);
    }
    std::vector<std::uint8_t> values(64, 1);
    for (std::size_t i = 20; i < 40; ++i) values[i] = 2;
    values[50] = 5;
    ASSERT_EQ(band.RasterIO(GF_Write, 0, 0, 8, 8, values.data(), 8, 8, GDT_Byte, 0, 0, nullptr), CE_None);
    GDALClose(file);
  }

  std::string path_;
};

TEST_F(DrapeClasses, AreThoseThatOccurWithTheirNames) {
  save(true);
  const auto classes = readDrapeClasses(path_);
  ASSERT_TRUE(classes) << classes.error().describe();
  ASSERT_EQ(classes->size(), 2u);
  EXPECT_EQ((*classes)[0].name, "water");
  EXPECT_EQ((*classes)[1].name, "forest");
  EXPECT_EQ((*classes)[1].number, 2u);
  EXPECT_EQ((*classes)[1].color, (std::array<std::uint8_t, 4>{20, 40, 60, 255}));
}

TEST_F(DrapeClasses, HaveNumbersWithoutNames) {
  save(false);
  const auto classes = readDrapeClasses(path_);
  ASSERT_TRUE(classes && classes->size() == 2);
  EXPECT_EQ((*classes)[0].name, "class 1");
}

TEST_F(DrapeClasses, AreNoneInAPictureOfColours) {
  GDALDataset* file =
      GetGDALDriverManager()->GetDriverByName("HFA")->Create(path_.c_str(), 4, 4, 3, GDT_Byte, nullptr);
  GDALClose(file);
  const auto classes = readDrapeClasses(path_);
  ASSERT_TRUE(classes);
  EXPECT_TRUE(classes->empty());
  EXPECT_FALSE(readDrapeClasses(path_ + ".missing"));
}

}  // namespace
}  // namespace arete
