// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which files of a folder belong to another one is what GDAL says of that other one.
#include "io/geo/dem/dem_files.h"

#include <cpl_string.h>
#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "io/files/text_scan.h"
#include "io/geo/gdal/support.h"
#include "io/geo/network/network_path.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

bool isFolder(const std::string& name) {
  std::error_code ignored;
  return fs::is_directory(name, ignored);
}

bool isPattern(const std::string& name) {
  std::error_code ignored;
  return name.find_first_of("*?[") != name.npos && !isVirtualPath(name) && name.find("://") == name.npos &&
         !fs::exists(name, ignored);
}

std::vector<std::string> matching(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> files;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    for (std::size_t i = 0; i < found.gl_pathc; ++i) files.emplace_back(found.gl_pathv[i]);
  globfree(&found);
  std::sort(files.begin(), files.end());
  return files;
}

/// The rasters of a folder, sorted by name.
std::vector<std::string> rastersIn(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> candidates;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path& path = entry->path();
    std::error_code ignored;
    if (path.filename().string().starts_with(".") || !entry->is_regular_file(ignored)) continue;
    candidates.push_back(path.string());
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<std::string> rasters;
  std::set<std::string> belonging;
  for (const std::string& path : candidates) {
    if (text::lowerExtension(path) == "zip") {
      rasters.push_back(path);
      continue;
    }
    GDALDriverH driver = GDALIdentifyDriverEx(path.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
    if (!driver || isTextDriver(driver)) continue;
    rasters.push_back(path);
    const GdalDatasetPtr dataset = openGdal(path, GDAL_OF_RASTER);
    if (!dataset) continue;  // reading it will say why
    const CPLStringList files(dataset->GetFileList());
    for (int i = 0; i < files.Count(); ++i)
      if (const std::string file = withoutServing(files[i]); file != path)
        belonging.insert(fs::path(file).lexically_normal().string());
  }
  std::erase_if(rasters, [&](const std::string& path) {
    return belonging.contains(fs::path(path).lexically_normal().string());
  });
  return rasters;
}

}  // namespace

bool namesSeveralFiles(const std::string& name) {
  if (isPattern(name)) return true;
  if (!isFolder(name)) return false;
  registerGdal();
  const GdalErrors quiet;
  return GDALIdentifyDriverEx(name.c_str(), GDAL_OF_RASTER | GDAL_OF_VECTOR, nullptr, nullptr) == nullptr;
}

Result<std::vector<std::string>> demFilesOf(const std::vector<std::string>& names) {
  registerGdal();
  const GdalErrors quiet;
  std::vector<std::string> files;
  for (const std::string& name : names) {
    std::vector<std::string> found = {name};
    if (isPattern(name)) {
      found = matching(name);
      if (found.empty()) return failure(ErrorCode::notFound, "there is no file of that pattern", name);
    } else if (namesSeveralFiles(name)) {
      found = rastersIn(name);
      if (found.empty()) return failure(ErrorCode::unsupported, "is a folder without a raster", name);
    }
    for (std::string& file : found)
      if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(std::move(file));
  }
  return files;
}

}  // namespace arete
