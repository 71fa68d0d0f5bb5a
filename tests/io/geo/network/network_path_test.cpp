// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/network/network_path.h"

#include <cpl_vsi.h>
#include <cpl_vsi_virtual.h>
#include <gtest/gtest.h>

#include "io/geo/network/served_files.h"

namespace arete {
namespace {

TEST(NetworkPath, OfAnAddressIsUnderOurPrefixWhereverItStands) {
  const std::string own = servedName();
  ASSERT_FALSE(own.empty());
  for (const auto& [path, served] :
       {std::pair{"https://h/a.tif?sig=1", own + "/https://h/a.tif?sig=1"},
        {"HTTP://h/a.tif", own + "/HTTP://h/a.tif"},
        {"/vsicurl/http://h/a.tif", own + "/http://h/a.tif"},
        {"/vsicurl/ftp://h/a.tif", own + "/ftp://h/a.tif"},
        {"/vsicurl_streaming/http://h/a.csv", own + "/http://h/a.csv"},
        {"/vsicurl?max_retry=1&url=http%3A%2F%2Fh%2Fa", own + "?max_retry=1&url=http%3A%2F%2Fh%2Fa"},
        {"/vsizip//vsicurl/http://h/a.zip/b.tif", "/vsizip/" + own + "/http://h/a.zip/b.tif"},
        {"/vsizip/vsicurl/http://h/a.zip/b.tif", "/vsizip" + own + "/http://h/a.zip/b.tif"},
        {"/vsizip/{/vsizip/{/vsicurl/http://h/a.zip}/b.zip}/c",
         "/vsizip/{/vsizip/{" + own + "/http://h/a.zip}/b.zip}/c"},
        {"/vsisubfile/9_9,/vsicurl/http://h/a", "/vsisubfile/9_9," + own + "/http://h/a"},
        {"NETCDF:\"/vsicurl/http://h/a.nc\":z", "NETCDF:\"" + own + "/http://h/a.nc\":z"},
        {"vrt:///vsicurl/http://h/a.tif?bands=1", "vrt://" + own + "/http://h/a.tif?bands=1"},
        {"vrt://http://h/a.tif?bands=1", "vrt://" + own + "/http://h/a.tif?bands=1"}}) {
    EXPECT_EQ(servedPath(path), served);
    EXPECT_EQ(servedPath(served), served);
    EXPECT_TRUE(isServedAddress(served));
    EXPECT_EQ(withoutServing("in '" + served + "'").find(own), std::string::npos);
    EXPECT_EQ(servedPath(withoutServing(served)), served);
  }
}

TEST(NetworkPath, OfAnotherFileStays) {
  for (const char* path : {"a.tif", "/data/a.tif", "/vsizip/a.zip/b.tif", "/vsis3/bucket/a.tif", "/vsimem/a",
                           "/data/vsicurl/a.tif", "vsicurl/http:/a.tif", "WMS:http://h/wms?x",
                           "WFS:https://h", "PG:host=h", "", "http:/a"}) {
    EXPECT_EQ(servedPath(path), path);
    EXPECT_FALSE(isServedAddress(path));
    EXPECT_EQ(withoutServing(path), path);
  }
}

TEST(NetworkPath, IsNamedInSentencesAsAPersonNamesIt) {
  const std::string own = servedName();
  EXPECT_EQ(withoutServing(own + "/http://h/a.tif: cut short"), "/vsicurl/http://h/a.tif: cut short");
  EXPECT_EQ(withoutServing("no " + own + "//data/a.vrt, " + own + "/b.vrt"), "no /data/a.vrt, b.vrt");
  EXPECT_EQ(withoutServing(own + "?url=http"), "/vsicurl?url=http");
  EXPECT_EQ(withoutServing(own + "2x"), own + "2x");
}

// GDAL knows one handler for each prefix: a second library in the process takes another one.
TEST(NetworkPath, HasAPrefixThatNoOtherLibraryTakes) {
  VSIFilesystemHandler* const local = VSIFileManager::GetHandler("");
  EXPECT_NE(VSIFileManager::GetHandler((servedName() + "/").c_str()), local);
  EXPECT_NE(VSIFileManager::GetHandler((servedName() + "?").c_str()), local);
  EXPECT_EQ(VSIFileManager::GetHandler((servedName() + "2/").c_str()), local);
}

}  // namespace
}  // namespace arete
