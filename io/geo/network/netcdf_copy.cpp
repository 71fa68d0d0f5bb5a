// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/network/netcdf_copy.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal.h>

#include <atomic>

#include "io/geo/network/gdal_http.h"
#include "io/geo/network/network_path.h"
#include "io/geo/network/network_reading.h"
#include "io/geo/network/served_files.h"

namespace arete {
namespace {

/// Each library in the process has copies of its own, as it has a prefix of its own.
std::string nameOfCopies() {
  return fmt::format("/vsimem{}-network-", servedName());
}

}  // namespace

std::string pathWithoutNetcdf(const std::string& path) {
  if (!isServedAddress(path)) return path;
  GDALDriverH driver = GDALIdentifyDriverEx(path.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
  if (!driver || !EQUAL(GDALGetDriverShortName(driver), "netCDF")) return path;
  const std::size_t begin = path.find("/vsi");
  std::size_t end = path.size();
  std::string variable;
  if (begin > 0) {  // NETCDF:"file":variable
    end = path.rfind(':');
    if (end == path.npos || end <= begin || path.compare(end, 3, "://") == 0) return {};
    variable = path.substr(end);
    if (path[end - 1] == '"') --end;
  }
  const std::string file = path.substr(begin, end - begin);
  static std::atomic<unsigned> number = 0;
  const std::string folder = fmt::format("{}{}", nameOfCopies(), number++);
  const std::string copy = fmt::format("{}/{}", folder, CPLGetFilename(file.c_str()));
  const bool hadFailed = firstNetworkFailure().has_value();
  if (VSIMkdir(folder.c_str(), 0700) != 0 || CPLCopyFile(copy.c_str(), file.c_str()) != 0 ||
      requestsAreCancelled() || firstNetworkFailure().has_value() != hadFailed) {
    removeNetworkCopy(copy);
    return {};
  }
  return begin > 0 ? fmt::format("NETCDF:\"{}\"{}", copy, variable) : copy;
}

void removeNetworkCopy(const std::string& description) {
  const std::string copies = nameOfCopies();
  const std::size_t begin = description.find(copies);
  if (begin == description.npos) return;
  VSIRmdirRecursive(description.substr(begin, description.find('/', begin + copies.size()) - begin).c_str());
}

}  // namespace arete
