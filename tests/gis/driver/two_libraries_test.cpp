// SPDX-License-Identifier: GPL-3.0-or-later
//
// A program that has the library in it and loads the plugin as well: two copies of our files of the network,
// beside GDAL's own.
#include <cpl_string.h>
#include <cpl_vsi_virtual.h>
#include <dlfcn.h>

#include "gis/driver/driver_fixture.h"
#include "io/geo/network/served_files.h"
#include "io/http_server.h"

namespace arete {
namespace {

// Before main(): no function of ours has run.
VSIFilesystemHandler* const own = VSIFileManager::GetHandler("/vsicurl/");

class TwoLibraries : public test::DriverFixture {};

TEST_F(TwoLibraries, HaveAPrefixEachAndLeaveGdalsAlone) {
  GDALDriverManager& drivers = *GetGDALDriverManager();
  GDALDriver* const linked = drivers.GetDriverByName("AMT");
  drivers.DeregisterDriver(linked);
  void* const plugin = dlopen(ARETE_PLUGIN, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(plugin, nullptr) << dlerror();
  reinterpret_cast<void (*)()>(dlsym(plugin, "GDALRegister_AMT"))();
  GDALDriver* const loaded = drivers.GetDriverByName("AMT");
  ASSERT_NE(loaded, nullptr);

  EXPECT_EQ(VSIFileManager::GetHandler("/vsicurl/"), own);
  VSIFilesystemHandler* const local = VSIFileManager::GetHandler("");
  VSIFilesystemHandler* const first = VSIFileManager::GetHandler("/vsiarete/");
  VSIFilesystemHandler* const second = VSIFileManager::GetHandler("/vsiarete2/");
  EXPECT_EQ(servedName(), "/vsiarete");
  EXPECT_NE(first, local);
  EXPECT_NE(second, local);
  EXPECT_NE(first, second);

  // The plugin opens a model on a server; one that is cut short is an error that names the address.
  const std::string path = terrain("m.amt", 9, 9, [](double x, double y) { return x * y * 1e-9; });
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  for (const bool isShort : {false, true}) {
    const test::HttpServer server({{"m.amt", bytes}}, [&](const std::string&, int) {
      test::HttpFault fault;
      fault.isShort = isShort;
      return fault;
    });
    CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", "0");
    const std::string name = "/vsicurl/" + server.address("m.amt");
    EXPECT_EQ(open(name) != nullptr, !isShort) << message();
    EXPECT_EQ(message().find("vsiarete"), std::string::npos) << message();
    CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", nullptr);
  }
  drivers.DeregisterDriver(loaded);
  GDALDestroyDriver(loaded);
  drivers.RegisterDriver(linked);
}

}  // namespace
}  // namespace arete
