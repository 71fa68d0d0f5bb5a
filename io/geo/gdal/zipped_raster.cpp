// SPDX-License-Identifier: GPL-3.0-or-later
//
// The candidates are the files in the archive that a raster driver of GDAL identifies. Text that may be
// points ("XYZ") is a candidate only if there is no other. GDAL would list the whole archive for each file,
// to find its sidecars: it is given those with the same name up to the extension.
#include "io/geo/gdal/zipped_raster.h"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/files/text_scan.h"
#include "io/geo/gdal/support.h"
#include "io/geo/network/network_path.h"

namespace arete {
namespace {

constexpr std::size_t kNamesListed = 10;
constexpr int kNamesPerCheck = 64;

bool isSidecar(const std::string& name) {
  const std::string extension = text::lowerExtension(name);
  constexpr std::string_view kSidecars[] = {"xml", "prj", "tfw", "wld", "ovr", "msk", "txt", "pdf", "html"};
  return std::find(std::begin(kSidecars), std::end(kSidecars), extension) != std::end(kSidecars);
}

std::string withoutExtension(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  const std::size_t dot = name.find('.', slash == name.npos ? 0 : slash + 1);
  return text::lowered(name.substr(0, dot));
}

std::string withoutFolder(const std::string& name) {
  return name.substr(name.rfind('/') + 1);
}

/// The names without folder of the files that share a name up to the extension.
std::unordered_map<std::string, CPLStringList> siblingsOf(const CPLStringList& names) {
  std::unordered_map<std::string, CPLStringList> siblings;
  for (int i = 0; i < names.Count(); ++i)
    siblings[withoutExtension(names[i])].AddString(withoutFolder(names[i]).c_str());
  return siblings;
}

}  // namespace

bool isPlainZip(const std::string& path) {
  return (!isVirtualPath(path) || path.starts_with("/vsicurl/")) && text::lowerExtension(path) == "zip";
}

Result<std::string> findZippedRaster(const std::string& given, const RunContext& context) {
  registerGdal();
  const std::string archive = networkPathOf(given);
  GdalErrors errors;
  if (auto problem = findInputProblem(archive)) return tl::unexpected(*problem);
  VSIStatBufL status;
  if (VSIStatL(servedPath(archive).c_str(), &status) != 0)
    return failure(ErrorCode::notFound, "there is no such file", archive);

  const std::string root = fmt::format("/vsizip/{{{}}}", archive);
  const CPLStringList names(VSIReadDirRecursive(servedPath(root).c_str()));
  if (names.Count() == 0)
    return failure(ErrorCode::corrupt, "is not a zip archive, or an empty one", archive);
  std::vector<std::string> rasters, texts;
  auto siblings = siblingsOf(names);
  for (int i = 0; i < names.Count(); ++i) {
    if (i % kNamesPerCheck == 0) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted", archive);
      context.report("looking into the archive", double(i) / names.Count());
    }
    const std::string name = names[i];
    if (name.back() == '/' || isSidecar(name)) continue;
    GDALDriverH driver =
        GDALIdentifyDriverEx(fmt::format("{}/{}", servedPath(root), name).c_str(), GDAL_OF_RASTER, nullptr,
                             siblings[withoutExtension(name)].List());
    if (driver) (isTextDriver(driver) ? texts : rasters).push_back(name);
  }
  if (rasters.empty()) rasters = std::move(texts);
  if (rasters.empty()) return failure(ErrorCode::unsupported, "the archive holds no raster", archive);
  if (rasters.size() > 1) {
    std::sort(rasters.begin(), rasters.end());
    const std::size_t listed = std::min(kNamesListed, rasters.size());
    return failure(
        ErrorCode::unsupported,
        fmt::format("the archive holds {} rasters; name one of them as /vsizip/{}/NAME: {}{}", rasters.size(),
                    archive, fmt::join(rasters.begin(), rasters.begin() + std::ptrdiff_t(listed), ", "),
                    listed < rasters.size() ? ", ..." : ""),
        archive);
  }
  return root + "/" + rasters.front();
}

Result<std::string> rasterPathOf(const std::string& path, const RunContext& context) {
  return isPlainZip(path) ? findZippedRaster(path, context) : Result<std::string>(path);
}

}  // namespace arete
