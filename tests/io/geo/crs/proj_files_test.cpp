// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/proj_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <utility>
#include <vector>

#include "io/geo/crs/reader.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

TEST(ProjFiles, AreFoundInTextsOfEveryForm) {
  const std::vector<std::pair<std::string, std::string>> texts = {
      {"+init=/tmp/x:1", "/tmp/x:1"},
      {"+init=./x:1 +type=crs", "./x:1"},
      {"+INIT=/tmp/x:1", "/tmp/x:1"},
      {"init=/tmp/x:1", "/tmp/x:1"},
      {"+proj=longlat +nadgrids=conus,@/tmp/x", "@/tmp/x"},
      {"+proj=longlat +nadgrids=../x +no_defs", "../x"},
      {"+proj=longlat +nadgrids=~/x", "~/x"},
      {"+proj=longlat +nadgrids=https://host/x.tif", "https://host/x.tif"},
      {"+proj=longlat +nadgrids=C:\\x", "C:\\x"},
      {"+proj=utm +zone=1 +geoidgrids=/x", "/x"},
      {"+proj=pipeline +step +proj=xyzgridshift +grids=/x", "/x"},
      {"+proj=pipeline +step +proj=deformation +xy_grids=/x +z_grids=/y", "/x"},
      {"+proj=tinshift +file=/x.json", "/x.json"},
      {"+proj=defmodel +model=/x.json", "/x.json"},
      {R"(PROJCS["n",EXTENSION["PROJ4","+proj=merc +nadgrids=/x +wktext"]])", "/x"},
      {R"(BOUNDCRS[ABRIDGEDTRANSFORMATION["n",PARAMETERFILE["Latitude and longitude difference file","/x/y.gsb"]]])",
       "/x/y.gsb"},
      {R"({"type":"BoundCRS","parameters":[{"name":"grid file","value": "/x.gsb"}]})", "/x.gsb"},
  };
  for (const auto& [text, name] : texts) {
    EXPECT_EQ(fileNamedBy(text), name) << text;
    const auto parsed = crsFromText(text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_EQ(parsed.error().code, ErrorCode::invalidData) << text;
    EXPECT_NE(parsed.error().message.find(name), std::string::npos) << parsed.error().message;
  }
}

TEST(ProjFiles, AreNoneInTextsThatNameGridsOfProj) {
  for (const char* text :
       {"EPSG:32633", "+init=epsg:32633", "+init=ESRI:54009",
        "+proj=longlat +ellps=clrk66 +nadgrids=conus,@alaska",
        "+proj=merc +a=6378137 +b=6378137 +nadgrids=@null +wktext",
        "+proj=utm +zone=33 +geoidgrids=egm96_15.gtx", R"(GEOGCS["a/b ./c",SPHEROID["http://x",1,0]])",
        R"({"name": "a/b", "id": {"code": 4326}})"})
    EXPECT_EQ(fileNamedBy(text), "") << text;
  EXPECT_TRUE(crsFromText("+init=epsg:32633"));
  EXPECT_TRUE(crsFromText("+proj=merc +a=6378137 +b=6378137 +nadgrids=@null +wktext"));
}

TEST(ProjFiles, MayBeThoseOfProjAndThoseThatAPersonNamed) {
  const test::TemporaryFolder folder;
  const std::string named = folder.write("named.gsb", "x"), other = folder.write("other.gsb", "x"),
                    pipe = folder.file("pipe.gsb");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_FALSE(projMayOpen(named.c_str()));
  allowProjFiles("+proj=longlat +nadgrids=" + named + ",@" + pipe + " +no_defs");
  EXPECT_TRUE(projMayOpen(named.c_str()));
  EXPECT_FALSE(projMayOpen(pipe.c_str())) << "it could wait for ever";
  EXPECT_FALSE(projMayOpen(other.c_str()));
  EXPECT_FALSE(projMayOpen("named.gsb")) << "in the current folder";
  EXPECT_FALSE(projMayOpen("/usr/share/proj/../../../etc/passwd"));
  EXPECT_FALSE(projMayOpen("/etc/passwd"));
}

}  // namespace
}  // namespace arete
