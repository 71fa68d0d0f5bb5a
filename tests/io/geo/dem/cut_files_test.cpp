// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file of every raster format that GDAL writes is cut at ten places. What is left must be refused, or give
// the heights of the whole.
#include <cpl_string.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "io/geo/dem/raster_reader.h"
#include "io/geo/gdal/file_length.h"
#include "io/geo/gdal/support.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

namespace fs = std::filesystem;
using test::contains;
using test::TemporaryFolder;

constexpr int kSide = 60;

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const fs::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc).write(bytes.data(), std::streamsize(bytes.size()));
}

GdalDatasetPtr inMemory(GDALDataType type, int columns, int rows, bool isGeographic) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
  GdalDatasetPtr dataset(driver->Create("", columns, rows, 1, type, nullptr));
  double transform[] = {7, 0.01, 0, 47, 0, -0.01};
  if (!isGeographic) transform[0] = transform[3] = 0, transform[1] = 1, transform[5] = 1;
  dataset->SetGeoTransform(transform);
  OGRSpatialReference crs;
  crs.SetFromUserInput("EPSG:4326");
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (isGeographic) dataset->SetSpatialRef(&crs);
  std::vector<double> heights;
  for (int i = 0; i < columns * rows; ++i) heights.push_back(10 + i % columns + i / columns);
  EXPECT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, columns, rows, heights.data(), columns, rows,
                                                GDT_Float64, 0, 0, nullptr),
            CE_None);
  return dataset;
}

RasterReadOptions firstBand() {
  RasterReadOptions options;
  options.band = 1;
  return options;
}

/// Writes a copy of the raster in a folder of its own; an empty path where the format cannot hold it.
std::string copyIn(GDALDriver& driver, GDALDataset& source, const fs::path& folder,
                   const CPLStringList& options) {
  const GdalErrors quiet;
  fs::create_directories(folder);
  std::string extension = "dat";
  if (const char* stated = driver.GetMetadataItem(GDAL_DMD_EXTENSIONS); stated && *stated)
    extension = std::string(stated).substr(0, std::string_view(stated).find(' '));
  if (const char* stated = driver.GetMetadataItem(GDAL_DMD_EXTENSION); stated && *stated) extension = stated;
  const std::string path = (folder / ("a." + extension)).string();
  GdalDatasetPtr copy(driver.CreateCopy(path.c_str(), &source, false, options.List(), nullptr, nullptr));
  copy.reset();
  return readRaster(path, firstBand()) ? path : std::string();
}

/// The largest file of a folder that holds no metadata only.
fs::path largestIn(const fs::path& folder) {
  fs::path largest;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() != ".xml" &&
        (largest.empty() || entry.file_size() > fs::file_size(largest)))
      largest = entry.path();
  return largest;
}

/// @return The number of cuts that were refused.
int cutEverywhere(const std::string& path, const fs::path& folder, bool hasNumbers) {
  const auto whole = readRaster(path, firstBand());
  if (!whole) return 0;
  const fs::path largest = largestIn(folder);
  const std::string bytes = contentOf(largest);
  int refused = 0;
  for (int cut = 0; cut < 10; ++cut) {
    const std::size_t left = bytes.size() * std::size_t(10 * cut + 5) / 100;
    write(largest, std::string_view(bytes).substr(0, left));
    const auto read = readRaster(path, firstBand());
    if (read) {
      EXPECT_EQ(read->heightfield.sourceChecksum, whole->heightfield.sourceChecksum)
          << path << " cut to " << left << " of " << bytes.size() << " bytes";
    } else
      ++refused;
    if (!read && hasNumbers && left > 600) {
      EXPECT_EQ(read.error().code, ErrorCode::unreadable) << read.error().describe();
      EXPECT_TRUE(contains(read.error().message, std::to_string(left))) << read.error().describe();
    }
  }
  write(largest, bytes);
  return refused;
}

TEST(CutFiles, OfEveryFormatAreRefusedOrWhole) {
  registerGdal();
  TemporaryFolder folder;
  int formats = 0, refused = 0;
  GDALDriverManager& drivers = *GetGDALDriverManager();
  for (int d = 0; d < drivers.GetDriverCount(); ++d) {
    GDALDriver& driver = *drivers.GetDriver(d);
    const std::string name = driver.GetDescription();
    const auto can = [&](const char* item) { return driver.GetMetadataItem(item) != nullptr; };
    if (!can(GDAL_DCAP_RASTER) || !(can(GDAL_DCAP_CREATE) || can(GDAL_DCAP_CREATECOPY))) continue;
    // In memory, over the network, of other files, of pictures; a text has no length.
    constexpr std::string_view kOthers[] = {"MEM",        "VRT",           "WMS", "PDF", "KMLSUPEROVERLAY",
                                            "Rasterlite", "PostGISRaster", "XYZ"};
    if (std::find(std::begin(kOthers), std::end(kOthers), name) != std::end(kOthers)) continue;
    for (const GDALDataType type : {GDT_Float32, GDT_Byte}) {
      const fs::path own = folder.file(name + std::to_string(type));
      std::string path;
      for (const bool isGeographic : {true, false})
        if (path.empty()) path = copyIn(driver, *inMemory(type, kSide, kSide, isGeographic), own, {});
      if (path.empty()) continue;
      ++formats;
      const bool hasNumbers = name == "ENVI" || name == "EHdr" || name == "netCDF" || name == "PCRaster";
      refused += cutEverywhere(path, own, hasNumbers);
      break;
    }
  }
  EXPECT_GE(formats, 35);
  EXPECT_GE(refused, 8 * formats);
}

TEST(CutFiles, OfCalsAreRefusedOrWarnedOfWhereverTheyAreCut) {
  registerGdal();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("CALS");
  if (!driver) GTEST_SKIP() << "GDAL has no CALS";
  TemporaryFolder folder;
  GdalDatasetPtr source = inMemory(GDT_Byte, kSide, kSide, false);
  source->GetRasterBand(1)->SetMetadataItem("NBITS", "1", "IMAGE_STRUCTURE");
  std::vector<unsigned char> bits(kSide * kSide);
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = (i * 7 + i / kSide * 13) % 3 == 0;
  ASSERT_EQ(source->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, kSide, kSide, bits.data(), kSide, kSide,
                                               GDT_Byte, 0, 0, nullptr),
            CE_None);
  const std::string path = copyIn(*driver, *source, folder.file("cals"), {});
  ASSERT_FALSE(path.empty());
  const auto whole = readRaster(path, firstBand());
  ASSERT_TRUE(whole) << whole.error().describe();
  EXPECT_FALSE(contains(test::joined(whole->warnings), "EOFB")) << test::joined(whole->warnings);
  const std::string bytes = contentOf(path);
  for (std::size_t left = 2041; left < bytes.size(); left += 7) {
    write(path, std::string_view(bytes).substr(0, left));
    const auto cut = readRaster(path, firstBand());
    if (left < 2048 + 8) {
      ASSERT_FALSE(cut) << left;
      EXPECT_TRUE(contains(cut.error().message, std::to_string(left))) << cut.error().describe();
    }
    if (!cut) continue;
    EXPECT_EQ(cut->heightfield.sourceChecksum, whole->heightfield.sourceChecksum) << left;
    EXPECT_TRUE(contains(test::joined(cut->warnings), "EOFB")) << left;
  }
  write(path, bytes + std::string(100, '\0'));  // filled up to a record
  const auto filled = readRaster(path, firstBand());
  ASSERT_TRUE(filled) << filled.error().describe();
  EXPECT_FALSE(contains(test::joined(filled->warnings), "EOFB"));
}

TEST(CutFiles, OfRawLayoutsGiveTheBytesWantedAndThere) {
  registerGdal();
  TemporaryFolder folder;
  struct Layout {
    const char* driver;
    std::vector<const char*> options;
    GDALDataType type;
    int columns = kSide, rows = kSide;
  };
  int number = 0;
  for (const Layout& layout :
       {Layout{"ENVI", {"INTERLEAVE=BIL"}, GDT_Float64}, Layout{"ENVI", {"INTERLEAVE=BIP"}, GDT_UInt16},
        Layout{"ENVI", {"INTERLEAVE=BSQ", "SUFFIX=ADD"}, GDT_Int32}, Layout{"EHdr", {}, GDT_Int32},
        Layout{"RRASTER", {}, GDT_Float64}, Layout{"ISCE", {}, GDT_Float32}, Layout{"ERS", {}, GDT_Float32},
        Layout{"VICAR", {}, GDT_Int16}, Layout{"GTX", {}, GDT_Float32}, Layout{"PAux", {}, GDT_UInt16},
        Layout{"netCDF", {"FORMAT=NC"}, GDT_Float64}, Layout{"netCDF", {"FORMAT=NC2"}, GDT_Float32},
        Layout{"PCRaster", {}, GDT_Int32}, Layout{"PCIDSK", {}, GDT_Float32},
        Layout{"DTED", {}, GDT_Int16, 121, 121}}) {
    CPLStringList options;
    for (const char* option : layout.options) options.AddString(option);
    const fs::path own = folder.file(std::to_string(number++));
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(layout.driver);
    if (!driver) continue;
    GdalDatasetPtr source = inMemory(layout.type, layout.columns, layout.rows, true);
    if (layout.columns == 121) {
      double transform[] = {7 - 1 / 240.0, 1 / 120.0, 0, 47 + 1 / 240.0, 0, -1 / 120.0};
      source->SetGeoTransform(transform);
    }
    const std::string path = copyIn(*driver, *source, own, options);
    ASSERT_FALSE(path.empty()) << layout.driver;
    EXPECT_GE(cutEverywhere(path, own, true), 9) << layout.driver;
  }
}

/// What is read of the file, or nothing if it is refused.
std::optional<RasterRead> readOf(const std::string& path) {
  auto read = readRaster(path, firstBand());
  if (!read) return std::nullopt;
  return std::move(*read);
}

TEST(CutFiles, WithoutTheirLastBytesLoseNeitherHeightsNorTheirPlaceWithoutAWord) {
  registerGdal();
  TemporaryFolder folder;
  struct Layout {
    const char* driver;
    std::vector<const char*> options;
    GDALDataType type;
  };
  int number = 0, refused = 0;
  for (const Layout& layout : {Layout{"HFA", {}, GDT_Float32},
                               Layout{"HFA", {"COMPRESSED=YES"}, GDT_Int16},
                               Layout{"HFA", {"BLOCKSIZE=32"}, GDT_Float64},
                               Layout{"HFA", {"USE_SPILL=YES"}, GDT_Float32},
                               Layout{"HFA", {"USE_SPILL=YES"}, GDT_Byte},
                               Layout{"ILWIS", {}, GDT_Float32},
                               Layout{"ILWIS", {}, GDT_Int16},
                               Layout{"GTiff", {}, GDT_Float32},
                               Layout{"GTiff", {"COMPRESS=DEFLATE"}, GDT_Float32},
                               Layout{"COG", {}, GDT_Int16},
                               Layout{"NITF", {}, GDT_Float32},
                               Layout{"AAIGrid", {}, GDT_Float32},
                               Layout{"GSBG", {}, GDT_Float32},
                               Layout{"RST", {}, GDT_Float32},
                               Layout{"SAGA", {}, GDT_Float32},
                               Layout{"BT", {}, GDT_Float32},
                               Layout{"GPKG", {}, GDT_Byte},
                               Layout{"PCRaster", {}, GDT_Float32},
                               Layout{"netCDF", {"FORMAT=NC4"}, GDT_Float32},
                               Layout{"JPEG", {}, GDT_Byte}}) {
    CPLStringList options;
    for (const char* option : layout.options) options.AddString(option);
    const fs::path own = folder.file(std::to_string(number++));
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(layout.driver);
    if (!driver) continue;
    const std::string path = copyIn(*driver, *inMemory(layout.type, kSide, kSide, true), own, options);
    if (path.empty()) continue;
    const auto whole = readOf(path);
    ASSERT_TRUE(whole) << layout.driver;
    const fs::path largest = largestIn(own);
    const std::string bytes = contentOf(largest);
    for (const double part : {0.91, 0.95, 0.96, 0.97, 0.98, 0.99, 0.995, 0.999}) {
      const auto left = std::size_t(double(bytes.size()) * part);
      write(largest, std::string_view(bytes).substr(0, left));
      const auto cut = readRaster(path, firstBand());
      if (!cut) {
        ++refused;
        EXPECT_FALSE(contains(cut.error().describe(), "0x")) << cut.error().describe();
        continue;
      }
      const RasterHeightfield &a = whole->heightfield, &b = cut->heightfield;
      EXPECT_EQ(a.sourceChecksum, b.sourceChecksum) << layout.driver << " cut to " << part;
      const bool isSame = a.georeference.geoTransform == b.georeference.geoTransform &&
                          a.georeference.crsWkt == b.georeference.crsWkt;
      EXPECT_TRUE(isSame || !cut->warnings.empty()) << layout.driver << " cut to " << part;
    }
    write(largest, bytes);
  }
  EXPECT_GE(refused, 110);
}

TEST(CutFiles, OfAnHfaAreNamedAsDamaged) {
  registerGdal();
  TemporaryFolder folder;
  const std::string path = copyIn(*GetGDALDriverManager()->GetDriverByName("HFA"),
                                  *inMemory(GDT_Float32, kSide, kSide, true), folder.file("hfa"), {});
  ASSERT_FALSE(path.empty());
  const std::string bytes = contentOf(path);
  write(path, std::string_view(bytes).substr(0, bytes.size() * 97 / 100));
  const auto cut = readRaster(path);
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, ErrorCode::corrupt);
  EXPECT_EQ(cut.error().culprit, path);
  EXPECT_TRUE(contains(cut.error().message, "cut short")) << cut.error().describe();
}

TEST(CutFiles, InTilesThatAreCountedInAdvanceAreWarnedOf) {
  registerGdal();
  TemporaryFolder folder;
  CPLStringList options;
  options.SetNameValue("INTERLEAVING", "TILED");
  const std::string path = copyIn(*GetGDALDriverManager()->GetDriverByName("PCIDSK"),
                                  *inMemory(GDT_Float32, kSide, kSide, true), folder.file("tiles"), options);
  ASSERT_FALSE(path.empty());
  const auto read = readRaster(path);
  ASSERT_TRUE(read);
  EXPECT_TRUE(contains(test::joined(read->warnings), "have been cut off")) << test::joined(read->warnings);
}

TEST(CutFiles, OfATileOfHeightsGiveTheBytesThere) {
  TemporaryFolder folder;
  const std::string path = folder.write("S46W008.HGT", std::string(std::size_t{2} * 1201 * 1201, '\1'));
  EXPECT_TRUE(readRaster(path));
  for (const std::size_t length : {1000, 2884800, 2884804}) {
    const auto read = readRaster(folder.write("S46W008.HGT", std::string(length, '\1')));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::unreadable);
    EXPECT_TRUE(contains(read.error().message, std::to_string(length) + " bytes") &&
                contains(read.error().message, "2884802"))
        << read.error().describe();
  }
}

TEST(CutFiles, WithinVirtualRastersAndArchivesAreFoundToo) {
  registerGdal();
  TemporaryFolder folder;
  const fs::path own = folder.file("pair");
  const std::string pair = copyIn(*GetGDALDriverManager()->GetDriverByName("ENVI"),
                                  *inMemory(GDT_Float32, kSide, kSide, true), own, {});
  const std::string band = "<VRTRasterBand dataType=\"Float32\" band=\"1\"",
                    size = "<VRTDataset rasterXSize=\"60\" rasterYSize=\"60\">";
  const std::string overPair = folder.write(
      "over.vrt",
      size + band + "><SimpleSource><SourceFilename>" + pair +
          "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
  const std::string overBoth =
      folder.write("both.vrt", size + band +
                                   "><SimpleSource><SourceFilename "
                                   "relativeToVRT=\"1\">over.vrt</SourceFilename><SourceBand>1</SourceBand></"
                                   "SimpleSource></VRTRasterBand></VRTDataset>");
  const std::string raw = folder.write(
      "raw.vrt", size + band + " subClass=\"VRTRawRasterBand\"><SourceFilename relativeToVRT=\"1\">pair/" +
                     fs::path(pair).filename().string() +
                     "</SourceFilename><PixelOffset>4</PixelOffset><LineOffset>240</LineOffset></"
                     "VRTRasterBand></VRTDataset>");
  for (const std::string& path : {overPair, overBoth, raw}) ASSERT_TRUE(readRaster(path)) << path;
  fs::resize_file(pair, 10000);
  for (const std::string& path : {overPair, overBoth, raw}) {
    const auto read = readRaster(path);
    ASSERT_FALSE(read) << path;
    EXPECT_TRUE(contains(read.error().message, "14400 bytes and 10000 are there")) << read.error().describe();
  }
  const std::string zip = folder.file("pair.zip");
  for (const auto& entry : fs::directory_iterator(own)) {
    VSILFILE* out = VSIFOpenL(("/vsizip/" + zip + "/" + entry.path().filename().string()).c_str(), "wb");
    const std::string bytes = contentOf(entry.path());
    VSIFWriteL(bytes.data(), 1, bytes.size(), out);
    VSIFCloseL(out);
  }
  const auto read = readRaster("/vsizip/" + zip + "/" + fs::path(pair).filename().string());
  ASSERT_FALSE(read);
  EXPECT_TRUE(contains(read.error().message, "14400 bytes and 10000 are there")) << read.error().describe();
}

/// A number, big-endian.
std::string number(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = bytes; i-- > 0;) text += char(value >> (8 * i) & 255);
  return text;
}

TEST(ClassicNetcdf, LengthIsThatOfTheLastVariable) {
  TemporaryFolder folder;
  // Dimensions: records, 5; variables: one of 5 bytes, and records of 5 shorts and 1 byte.
  for (const int version : {1, 2, 5}) {
    const int wide = version == 5 ? 8 : 4, offset = version == 1 ? 4 : 8;
    const auto name = [&](const std::string& text) {
      return number(text.size(), wide) + text + std::string((4 - text.size() % 4) % 4, '\0');
    };
    const std::string none = number(0, 4) + number(0, wide);
    const auto variable = [&](const char* text, std::vector<int> dimensions, int type, std::uint64_t begin) {
      std::string made = name(text) + number(dimensions.size(), wide);
      for (const int d : dimensions) made += number(std::uint64_t(d), wide);
      return made + none + number(std::uint64_t(type), 4) + number(0, wide) + number(begin, offset);
    };
    for (const int records : {0, 1, 3}) {
      const std::string header = std::string("CDF") + char(version) + number(std::uint64_t(records), wide) +
                                 number(10, 4) + number(2, wide) + name("time") + number(0, wide) +
                                 name("x") + number(5, wide) + number(12, 4) + number(1, wide) +
                                 name("title") + number(2, 4) + number(3, wide) + std::string("abc\0", 4) +
                                 number(11, 4) + number(3, wide) + variable("a", {1}, 1, 1000) +
                                 variable("b", {0, 1}, 3, 1008) + variable("c", {0}, 1, 1020);
      const auto length = classicNetcdfLength(folder.write("a.nc", header));
      ASSERT_TRUE(length);
      // Records of 12 + 4 bytes; the last ends with the one byte of c.
      EXPECT_EQ(*length, records == 0 ? 1005u : 1020u + 16u * unsigned(records - 1) + 1u) << version;
      for (std::size_t cut = 0; cut < header.size(); ++cut)
        classicNetcdfLength(folder.write("a.nc", header.substr(0, cut)));
    }
  }
  EXPECT_FALSE(classicNetcdfLength(folder.write("a.nc", "CDF\4....")));
  EXPECT_FALSE(classicNetcdfLength(folder.file("none.nc")));
}

}  // namespace
}  // namespace arete
