// SPDX-License-Identifier: GPL-3.0-or-later
// --confined: the named files and what lies beside them, and nothing else. And without it: a text in a file
// opens no other file.
#include <sys/stat.h>

#include "cli/arguments_fixture.h"
#include "io/http_server.h"

namespace arete::cli_test {
namespace {

class Confined : public Arguments {
 protected:
  void SetUp() override {
    Arguments::SetUp();
    fs::create_directory(path("other"));
    fs::copy_file(path("dem.tif"), path("other/secret.tif"));
  }
  Outcome build(const std::string& dem, bool isConfined = true) const {
    std::vector<std::string> words = {"build", dem, "-o", "out.amt", "-q"};
    if (isConfined) words.push_back("--confined");
    return run(words);
  }
};

TEST_F(Confined, CommandsDoTheirWork) {
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"build", "dem.tif", "-o", "x.amt"},
           {"build", "./dem.tif", "-o", path("x.amt")},
           {"extract", "dem.amt", "-o", "x.ply", "--max-error", "5"},
           {"extract", "dem.amt", "-o", "x.gpkg", "--max-error", "5"},
           {"extract", "dem.amt", "-o", "x.gpkg", "--max-error", "9"},
           {"extract", "dem.amt", "--output=x.tif", "--max-error", "5", "--error-raster", "e.tif"},
           {"measure", "x.gpkg", "dem.tif"},
           {"height", "dem.amt", "--at", middle()},
           {"los", "dem.amt", "--from", middle() + ",5", "--to", middle() + ",9"},
           {"convert", "x.ply", "-o", "x.glb"}}) {
    std::vector<std::string> words = command;
    words.push_back("--confined");
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << command[0] << outcome.err;
  }
}

TEST_F(Confined, SidecarsAreRead) {
  write("raw.bil", std::string(6, '\0'));
  write("raw.hdr", "NROWS 2\nNCOLS 3\nNBANDS 1\nNBITS 8\nULXMAP 0\nULYMAP 1\nXDIM 1\nYDIM 1\n");
  EXPECT_EQ(build("raw.bil").code, 0) << build("raw.bil").err;
}

TEST_F(Confined, FilesThatNameOthersAreRefused) {
  const std::string source =
      "<SimpleSource><SourceFilename relativeToVRT=\"1\">other/secret.tif</SourceFilename>"
      "<SourceBand>1</SourceBand></SimpleSource>";
  write("a.vrt",
        "<VRTDataset rasterXSize=\"30\" rasterYSize=\"30\"><VRTRasterBand dataType=\"Float64\" "
        "band=\"1\">" +
            source + "</VRTRasterBand></VRTDataset>");
  write("ogr.vrt",
        "<OGRVRTDataSource><OGRVRTLayer name=\"p\"><SrcDataSource>other/p.csv</SrcDataSource>"
        "</OGRVRTLayer></OGRVRTDataSource>");
  write("wms.xml",
        "<GDAL_WMS><Service name=\"TMS\"><ServerUrl>http://127.0.0.1:9/${z}</ServerUrl></Service>"
        "</GDAL_WMS>");
  EXPECT_EQ(build("a.vrt", false).code, 0) << "GDAL can";
  for (const char* name :
       {"a.vrt", "ogr.vrt", "wms.xml", "http://127.0.0.1:9/a.tif", "/vsicurl/http://127.0.0.1:9/a.tif",
        "/vsiarete/http://127.0.0.1:9/a.tif", "/vsiarete/a.vrt", "/vsis3/bucket/a.tif"}) {
    const Outcome outcome = build(name);
    EXPECT_EQ(outcome.code, 3) << name << outcome.err;
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
  }
  // The sentence has the address alone: options may hold a secret.
  const Outcome withOptions = build("/vsicurl?cookie=5ecret&url=http%3A%2F%2F127.0.0.1%3A9%2Fa.tif");
  EXPECT_EQ(withOptions.code, 3) << withOptions.err;
  EXPECT_NE(withOptions.err.find("http://127.0.0.1:9/a.tif"), std::string::npos) << withOptions.err;
  EXPECT_EQ(withOptions.err.find("5ecret"), std::string::npos) << withOptions.err;
}

TEST_F(Confined, NoFormOfAnAddressMakesAConnection) {
  test::HttpServer server({{"a.tif", read("dem.tif")}}, {});
  const std::string address = server.address("a.tif");
  std::string encoded = address;
  for (std::size_t at = 0; (at = encoded.find_first_of(":/", at)) != encoded.npos; at += 3)
    encoded.replace(at, 1, encoded[at] == ':' ? "%3A" : "%2F");
  for (const std::string& name :
       {address, "/vsicurl?url=" + encoded, "/vsiarete?url=" + encoded, "vrt:///vsicurl/" + address})
    EXPECT_EQ(build(name).code, 3) << name;
  EXPECT_EQ(server.requests("a.tif"), 0);
  EXPECT_EQ(build(address, false).code, 0);
}

TEST_F(Confined, LinksLeadNowhereElse) {
  fs::create_symlink("other/secret.tif", path("link.tif"));
  EXPECT_EQ(build("link.tif", false).code, 0);
  const Outcome outcome = build("link.tif");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("is a link to"), std::string::npos) << outcome.err;
  fs::create_symlink("other/secret.tif", path("dem.tif.msk"));
  EXPECT_EQ(build("dem.tif").code, 0) << "a sidecar that leads elsewhere is not there";
}

TEST_F(Confined, TextsInFilesOpenNothingEvenWithout) {
  ASSERT_EQ(mkfifo(path("fifo").c_str(), 0600), 0);  // opening it blocks
  const std::string fifo = path("fifo");
  const std::vector<std::string> texts = {"+init=" + fifo + ":1",
                                          "+init=fifo:1 +type=crs",
                                          "+proj=longlat +ellps=clrk66 +nadgrids=" + fifo,
                                          "+proj=longlat +ellps=clrk66 +nadgrids=./fifo",
                                          "+proj=longlat +ellps=clrk66 +nadgrids=fifo",
                                          "+proj=utm +zone=33 +geoidgrids=" + fifo + " +vunits=m",
                                          fifo};
  for (const std::string& text : texts) {
    SCOPED_TRACE(text);
    const auto withoutWaiting = [&](const std::vector<std::string>& words) {
      return run(words, killIfItHangs);
    };
    write("m.ply", "ply\nformat ascii 1.0\ncomment crs " + text +
                       "\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                       "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                       "0 0 1\n9 0 2\n0 9 3\n3 0 1 2\n");
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"convert", "m.ply", "-o", "x.gpkg", "--overwrite"},
                                               {"convert", "m.ply", "-o", "x.glb"},
                                               {"measure", "m.ply", "dem.tif"},
                                               {"measure", "m.ply", "tin.ply", "--samples", "10"}}) {
      const Outcome outcome = withoutWaiting(words);
      EXPECT_LT(outcome.code, 6) << words[0] << outcome.err;
      EXPECT_TRUE(outcome.code == 0 || outcome.err.starts_with("arete: ")) << outcome.err;
    }
    // GDAL reads this one itself.
    write("dem.tif.aux.xml", "<PAMDataset><SRS>" + text + "</SRS></PAMDataset>");
    EXPECT_LT(withoutWaiting({"build", "dem.tif", "-o", "x.amt"}).code, 6);
  }
}

TEST_F(Confined, ABadCrsInAFileIsAFaultOfThatFile) {
  write("m.ply",
        "ply\nformat ascii 1.0\ncomment crs gibberish\nelement vertex 3\nproperty double x\n"
        "property double y\nproperty double z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 1\n9 0 2\n0 9 3\n3 0 1 2\n");
  const Outcome outcome = run({"convert", "m.ply", "-o", "x.gpkg"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(outcome.err.rfind("arete: m.ply: its CRS, 'gibberish', is not a CRS", 0), 0u) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

}  // namespace
}  // namespace arete::cli_test
