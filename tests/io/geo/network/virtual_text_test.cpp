// SPDX-License-Identifier: GPL-3.0-or-later
//
// Virtual rasters and layers that name addresses, on servers that behave and on servers that do not.
#include "io/geo/network/virtual_text.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "full_run.h"
#include "io/geo/dem/dem_reader.h"
#include "io/geo/network/served_files.h"
#include "io/http_server.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::HttpFault;
using test::HttpServer;
using test::RasterSpec;
using test::TemporaryFolder;

constexpr int kSide = 300;

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Rows of floats that a driver without checks reads, one byte after the other.
std::string rasterBytes() {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.type = GDT_Float32;
  spec.columns = spec.rows = kSide;
  spec.values.resize(std::size_t(kSide) * kSide);
  for (std::size_t i = 0; i < spec.values.size(); ++i) spec.values[i] = double(i % 977);
  return contentOf(writeRaster(folder.file("a.tif"), spec));
}

std::string sourceOf(const std::string& name, bool isRelative = false) {
  return fmt::format(
      "<SimpleSource><SourceFilename relativeToVRT=\"{}\">{}</SourceFilename>"
      "<SourceBand>1</SourceBand></SimpleSource>",
      isRelative ? 1 : 0, name);
}

std::string vrtOf(const std::string& sources) {
  return fmt::format(
      "<VRTDataset rasterXSize=\"{0}\" rasterYSize=\"{0}\"><GeoTransform>500000, 30, 0, "
      "4000000, 0, -30</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\">{1}"
      "</VRTRasterBand></VRTDataset>",
      kSide, sources);
}

std::string escaped(const std::string& text) {
  char* plain = CPLEscapeString(text.c_str(), -1, CPLES_XML);
  std::string result = plain;
  CPLFree(plain);
  return result;
}

void writeZip(const std::string& zip, const std::string& name, const std::string& content) {
  VSILFILE* out = VSIFOpenL(("/vsizip/" + zip + "/" + name).c_str(), "wb");
  ASSERT_NE(out, nullptr);
  VSIFWriteL(content.data(), 1, content.size(), out);
  VSIFCloseL(out);
}

class VirtualText : public ::testing::Test {
 protected:
  void SetUp() override {
    GDALAllRegister();
    CPLSetConfigOption("GDAL_HTTP_RETRY_DELAY", "0.01");
    CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", "1");
    writeZip(folder_.file("z.zip"), "a.tif", tile_);
    files_ = {{"a.tif", tile_}, {"z.zip", contentOf(folder_.file("z.zip"))}};
  }
  void TearDown() override {
    CPLSetConfigOption("GDAL_HTTP_RETRY_DELAY", nullptr);
    CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", nullptr);
  }

  /// What a person may name so that the tile of a server is read through a virtual raster.
  std::vector<std::string> pathsThrough(const HttpServer& server) const {
    const std::string address = server.address("a.tif"), zip = server.address("z.zip");
    const auto write = [&](const std::string& name, const std::string& text) {
      std::filesystem::create_directories(std::filesystem::path(folder_.file(name)).parent_path());
      return folder_.write(name, text);
    };
    std::string encoded = address;
    for (std::size_t at = 0; (at = encoded.find_first_of(":/", at)) != encoded.npos; at += 3)
      encoded.replace(at, 1, encoded[at] == ':' ? "%3A" : "%2F");
    std::vector<std::string> paths = {
        write("address.vrt", vrtOf(sourceOf(address))),
        write("curl.vrt", vrtOf(sourceOf("/vsicurl/" + address))),
        write("options.vrt", vrtOf(sourceOf("/vsicurl?use_head=no&amp;url=" + encoded))),
        write("zip.vrt", vrtOf(sourceOf("/vsizip//vsicurl/" + zip + "/a.tif"))),
        write("braces.vrt", vrtOf(sourceOf("/vsizip/{/vsicurl/" + zip + "}/a.tif"))),
        write("odd.tif", vrtOf(sourceOf("/vsicurl/" + address))),
        write("warped.vrt", warpedOf("/vsicurl/" + address)),
        "vrt:///vsicurl/" + address + "?bands=1"};
    write("inner/inner.vrt", vrtOf(sourceOf(address)));
    write("inner/inner.img", vrtOf(sourceOf("/vsicurl/" + address)));
    paths.push_back(write("nested.vrt", vrtOf(sourceOf("inner/inner.vrt", true))));
    paths.push_back(write("odd.vrt", vrtOf(sourceOf("inner/inner.img", true))));
    paths.push_back(write("whole.vrt", vrtOf(sourceOf(folder_.file("inner/inner.vrt")))));
    paths.push_back(write("twice.vrt", vrtOf(sourceOf("nested.vrt", true))));
    paths.push_back(write("text.vrt", vrtOf(sourceOf(escaped(vrtOf(sourceOf(address)))))));
    paths.push_back("vrt://" + folder_.file("nested.vrt") + "?bands=1");
    return paths;
  }

  static std::string warpedOf(const std::string& source) {
    return fmt::format(
        "<VRTDataset rasterXSize=\"{0}\" rasterYSize=\"{0}\" "
        "subClass=\"VRTWarpedDataset\"><GeoTransform>500000,"
        "30,0,4000000,0,-30</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\" "
        "subClass=\"VRTWarpedRasterBand\"/><BlockXSize>128</BlockXSize><BlockYSize>128</BlockYSize>"
        "<GDALWarpOptions><WarpMemoryLimit>6e7</WarpMemoryLimit><ResampleAlg>NearestNeighbour</ResampleAlg>"
        "<WorkingDataType>Float32</WorkingDataType><SourceDataset relativeToVRT=\"0\">{1}</SourceDataset>"
        "<Transformer><GenImgProjTransformer><SrcGeoTransform>500000,30,0,4000000,0,-30</SrcGeoTransform>"
        "<SrcInvGeoTransform>-16666.6666666666667,0.0333333333333333,0,133333.3333333333,0,-0."
        "0333333333333333"
        "</SrcInvGeoTransform><DstGeoTransform>500000,30,0,4000000,0,-30</"
        "DstGeoTransform><DstInvGeoTransform>"
        "-16666.6666666666667,0.0333333333333333,0,133333.3333333333,0,-0.0333333333333333</"
        "DstInvGeoTransform>"
        "</GenImgProjTransformer></Transformer><BandList><BandMapping src=\"1\" dst=\"1\"/></BandList>"
        "</GDALWarpOptions></VRTDataset>",
        kSide, source);
  }

  TemporaryFolder folder_;
  std::string tile_ = rasterBytes();
  std::map<std::string, std::string> files_;
};

TEST_F(VirtualText, NamesAddressesThatAreReadByCheckedRequests) {
  const auto local = readDem(folder_.write("local.tif", tile_));
  ASSERT_TRUE(local);
  const HttpServer server(files_);
  for (const std::string& path : pathsThrough(server)) {
    const auto read = readDem(path);
    ASSERT_TRUE(read) << path << ": " << read.error().describe();
    EXPECT_EQ(std::get<RasterHeightfield>(read->heightfield).heights,
              std::get<RasterHeightfield>(local->heightfield).heights)
        << path;
    for (const std::string& warning : read->warnings)
      EXPECT_EQ(warning.find("vsiarete"), std::string::npos) << warning;
  }
}

TEST_F(VirtualText, GivesNoHeightsOfAServerThatLies) {
  const std::size_t count = pathsThrough(HttpServer(files_)).size();
  std::size_t tried = 0;
  for (const std::string kind : {"dropped", "short", "replaced", "longer", "compressed", "gone"})
    for (std::size_t i = 0; i < count; ++i) {
      if (++tried % 5 != 0 && !test::isFull()) continue;
      // From the second request on, so that the file opens first.
      HttpServer server(files_, [&](const std::string& name, int number) {
        HttpFault fault;
        if (number < 2) return fault;
        fault.isDropped = kind == "dropped";
        fault.isShort = kind == "short";
        if (kind == "replaced")
          fault.tag = "\"two\"", fault.content = std::string(files_.at(name).size(), 'x');
        if (kind == "longer") fault.content = files_.at(name) + "x";
        if (kind == "compressed") fault.headers = "Content-Encoding: gzip\r\n";
        if (kind == "gone") fault.status = 404;
        return fault;
      });
      const std::string path = pathsThrough(server)[i];
      const auto read = readDem(path);
      ASSERT_FALSE(read) << kind << " " << path;
      EXPECT_NE(read.error().message.find("127.0.0.1"), std::string::npos) << read.error().describe();
      EXPECT_EQ(read.error().describe().find("vsiarete"), std::string::npos) << read.error().describe();
    }
}

TEST_F(VirtualText, SaysWhichAddressItsServerDoesNotGive) {
  const HttpServer server({{"b", ""}}, {});
  const auto read = readDem(folder_.write("m.vrt", vrtOf(sourceOf("/vsicurl/" + server.address("a.tif")))));
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().describe().find("m.vrt"), std::string::npos) << read.error().describe();
  EXPECT_NE(read.error().describe().find("127.0.0.1"), std::string::npos) << read.error().describe();
  EXPECT_EQ(read.error().describe().find("vsiarete"), std::string::npos) << read.error().describe();
}

TEST_F(VirtualText, OnAServerFindsWhatIsBesideIt) {
  files_["m.vrt"] = vrtOf(sourceOf("a.tif", true));
  files_["outer.vrt"] = vrtOf(sourceOf("m.vrt", true));
  const HttpServer other(files_);
  files_["far.vrt"] = vrtOf(sourceOf("/vsicurl/" + other.address("a.tif")));
  const HttpServer server(files_);
  const auto local = readDem(folder_.write("local.tif", tile_));
  for (const char* name : {"m.vrt", "outer.vrt", "far.vrt"}) {
    const auto read = readDem(server.address(name));
    ASSERT_TRUE(read) << name << ": " << read.error().describe();
    EXPECT_EQ(std::get<RasterHeightfield>(read->heightfield).heights,
              std::get<RasterHeightfield>(local->heightfield).heights);
  }
}

TEST_F(VirtualText, KeepsTheOtherFilesOfAMosaic) {
  const HttpServer server(files_);
  std::filesystem::create_directory(folder_.file("tiles"));
  const auto local = readDem(folder_.write("local.tif", tile_));
  for (const std::string& file : {std::string("tiles/b.tif"), folder_.file("tiles/c.tif")}) {
    const bool isRelative = file[0] != '/';
    const std::string name = "tiles/" + std::filesystem::path(file).filename().string();
    folder_.write(name, tile_);
    const std::string vrt =
        folder_.write("m.vrt", vrtOf(sourceOf(server.address("a.tif")) + sourceOf(file, isRelative)));
    const auto read = readDem(vrt);
    ASSERT_TRUE(read) << read.error().describe();
    EXPECT_EQ(std::get<RasterHeightfield>(read->heightfield).heights,
              std::get<RasterHeightfield>(local->heightfield).heights);
    std::filesystem::remove(folder_.file(name));
    EXPECT_FALSE(readDem(vrt)) << "one of its files is not there";
  }
}

TEST_F(VirtualText, KeepsTheMaskBesideIt) {
  const HttpServer server(files_);
  const std::string path = folder_.write("m.vrt", vrtOf(sourceOf(server.address("a.tif"))));
  RasterSpec mask;
  mask.type = GDT_Byte;
  mask.columns = mask.rows = kSide;
  mask.values.assign(std::size_t(kSide) * kSide, 255);
  mask.values[5] = 0;
  mask.adjust = [](GDALDataset& dataset) { dataset.SetMetadataItem("INTERNAL_MASK_FLAGS_1", "2"); };
  writeRaster(path + ".msk", mask);
  const auto read = readDem(path);
  ASSERT_TRUE(read) << read.error().describe();
  const std::vector<double>& heights = std::get<RasterHeightfield>(read->heightfield).heights;
  EXPECT_EQ(heights[4], 4);
  EXPECT_TRUE(std::isnan(heights[5]));
}

TEST_F(VirtualText, InAnArchiveFindsWhatIsBesideIt) {
  const HttpServer server(files_);
  const std::string zip = folder_.file("m.zip");
  writeZip(zip, "m.vrt", vrtOf(sourceOf("/vsicurl/" + server.address("a.tif"))));
  const auto read = readDem("/vsizip/" + zip + "/m.vrt");
  EXPECT_TRUE(read) << read.error().describe();
}

TEST_F(VirtualText, InAnArchiveOnAServerNamesAddressesOfOtherServers) {
  const HttpServer tiles(files_);
  writeZip(folder_.file("m.zip"), "m.vrt", vrtOf(sourceOf(tiles.address("a.tif"))));
  writeZip(folder_.file("b.zip"), "b.vrt", vrtOf(sourceOf("a.tif", true)));
  writeZip(folder_.file("b.zip"), "a.tif", tile_);
  writeZip(folder_.file("outer.zip"), "z.zip", files_.at("z.zip"));
  std::map<std::string, std::string> archives;
  for (const char* name : {"m.zip", "b.zip", "outer.zip"}) archives[name] = contentOf(folder_.file(name));
  for (const bool isShort : {false, true}) {
    const HttpServer server(archives, [&](const std::string&, int number) {
      HttpFault fault;
      fault.isShort = isShort && number > 1;
      return fault;
    });
    for (const std::string& path :
         {server.address("m.zip"), "/vsizip//vsicurl/" + server.address("m.zip") + "/m.vrt",
          "/vsizip/vsicurl/" + server.address("b.zip") + "/b.vrt",
          "/vsizip/{/vsizip/{/vsicurl/" + server.address("outer.zip") + "}/z.zip}/a.tif"}) {
      const auto read = readDem(path);
      EXPECT_EQ(read.has_value(), !isShort) << path << (read ? "" : read.error().describe());
    }
  }
}

TEST_F(VirtualText, IsReadAnewAfterAFailureAndAfterAChange) {
  std::atomic<bool> lies = true, isChanged = false;
  const std::string later = std::string(tile_).replace(tile_.size() - 400, 4, std::string(4, '\0'));
  const HttpServer server(files_, [&](const std::string&, int number) {
    HttpFault fault;
    fault.isShort = lies && number > 1;
    if (isChanged) fault.tag = "\"two\"", fault.content = later;
    return fault;
  });
  const std::string tile = "/vsicurl/" + server.address("a.tif");
  folder_.write("inner.vrt", vrtOf(sourceOf(tile)));
  const std::string outer = folder_.write("outer.vrt", vrtOf(sourceOf("inner.vrt", true)));
  EXPECT_FALSE(readDem(outer));
  lies = false;
  const auto first = readDem(outer);
  ASSERT_TRUE(first) << first.error().describe();
  isChanged = true;
  const auto second = readDem(outer);
  ASSERT_TRUE(second) << second.error().describe();
  EXPECT_NE(std::get<RasterHeightfield>(second->heightfield).sourceChecksum,
            std::get<RasterHeightfield>(first->heightfield).sourceChecksum);
}

TEST_F(VirtualText, WithoutAnAddressIsOpenedUnderItsOwnName) {
  folder_.write("a.tif", tile_);
  const std::string inner = folder_.write("inner.vrt", vrtOf(sourceOf("a.tif", true)));
  const std::string outer = folder_.write("outer.vrt", vrtOf(sourceOf("inner.vrt", true)));
  const std::string crs = folder_.write(
      "crs.vrt", "<VRTDataset><SRS>http://www.opengis.net/def/crs/EPSG/0/4326</SRS></VRTDataset>");
  const std::string itself = folder_.write("itself.vrt", vrtOf(sourceOf("itself.vrt", true)));
  for (const std::string& path : {inner, outer, crs, itself, folder_.file("a.tif"), folder_.file("none.vrt")})
    EXPECT_EQ(servedDatasetPath(path), path);
}

// Twelve files, each of which names the next one a hundred times, and the last one the first.
TEST_F(VirtualText, LooksIntoEachFileOnce) {
  for (int i = 0; i < 12; ++i) {
    std::string sources;
    for (int k = 0; k < 100; ++k) sources += sourceOf(fmt::format("{}.vrt", (i + 1) % 12), true);
    folder_.write(fmt::format("{}.vrt", i), vrtOf(sources));
  }
  EXPECT_EQ(servedDatasetPath(folder_.file("0.vrt")), folder_.file("0.vrt"));
  folder_.write("11.vrt", vrtOf(sourceOf("0.vrt", true) + sourceOf("http://127.0.0.1:9/a.tif")));
  EXPECT_EQ(servedDatasetPath(folder_.file("0.vrt")), servedName() + "/" + folder_.file("0.vrt"));
}

TEST_F(VirtualText, OfALayerNamesAddressesToo) {
  std::string points = "x,y,z\n";  // more than one piece of a file
  for (int i = 0; i < 25000; ++i) points += fmt::format("{},{},{}\n", i % 14, i / 14, i);
  for (const bool isShort : {false, true}) {
    const HttpServer server({{"p.csv", points}}, [&](const std::string&, int number) {
      HttpFault fault;
      fault.isShort = isShort && number > 1;
      return fault;
    });
    for (const std::string& address : {server.address("p.csv"), "/vsicurl/" + server.address("p.csv")}) {
      const std::string layer =
          folder_.write("p.vrt", "<OGRVRTDataSource><OGRVRTLayer name=\"p\"><SrcDataSource>" + address +
                                     "</SrcDataSource><GeometryType>wkbPoint25D</GeometryType><GeometryField "
                                     "encoding=\"PointFromColumns\" x=\"x\" y=\"y\" z=\"z\"/></OGRVRTLayer>"
                                     "</OGRVRTDataSource>");
      EXPECT_EQ(servedDatasetPath(layer), servedName() + "/" + layer);
      const auto read = readDem(layer);
      EXPECT_EQ(read.has_value(), !isShort) << address << (read ? "" : read.error().describe());
    }
  }
}

}  // namespace
}  // namespace arete
