// SPDX-License-Identifier: GPL-3.0-or-later
// The tiles become one virtual mosaic, and GDAL's translate cuts the box out of it: over https only the
// blocks the box touches travel.
#include "datasets/fetch.h"

#include <fmt/format.h>
#include <gdal_utils.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "io/geo/gdal/support.h"

namespace arete {
namespace {

int CPL_STDCALL reportProgress(double fraction, const char*, void* context) {
  const auto* run = static_cast<const RunContext*>(context);
  run->report("fetching", fraction);
  return !run->cancelled();
}

/// GDAL's utilities take their options as a command line.
class Arguments {
 public:
  explicit Arguments(const std::vector<std::string>& words) {
    for (const std::string& word : words) list_ = CSLAddString(list_, word.c_str());
  }
  ~Arguments() { CSLDestroy(list_); }
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;
  char** get() const { return list_; }

 private:
  char** list_ = nullptr;
};

GdalDatasetPtr mosaicOf(const std::vector<GdalDatasetPtr>& tiles) {
  std::vector<GDALDatasetH> handles;
  for (const GdalDatasetPtr& tile : tiles) handles.push_back(GDALDataset::ToHandle(tile.get()));
  const Arguments arguments({"-resolution", "highest"});
  const std::unique_ptr<GDALBuildVRTOptions, decltype(&GDALBuildVRTOptionsFree)> options(
      GDALBuildVRTOptionsNew(arguments.get(), nullptr), GDALBuildVRTOptionsFree);
  // An empty name: the mosaic lives in memory only.
  return GdalDatasetPtr(GDALDataset::FromHandle(
      GDALBuildVRT("", static_cast<int>(handles.size()), handles.data(), nullptr, options.get(), nullptr)));
}

Status translate(GDALDataset& source, const Box2& box, const std::string& output, const RunContext& context) {
  const auto text = [](double degrees) { return fmt::format("{:.12f}", degrees); };
  const Arguments arguments({"-projwin", text(box.xMin), text(box.yMax), text(box.xMax), text(box.yMin),
                             "-of", "GTiff", "-co", "TILED=YES", "-co", "COMPRESS=DEFLATE", "-co",
                             "BIGTIFF=IF_SAFER"});
  const std::unique_ptr<GDALTranslateOptions, decltype(&GDALTranslateOptionsFree)> options(
      GDALTranslateOptionsNew(arguments.get(), nullptr), GDALTranslateOptionsFree);
  RunContext run = context;
  GDALTranslateOptionsSetProgress(options.get(), reportProgress, &run);
  GdalErrors errors;
  int usageError = 0;
  const GdalDatasetPtr written(GDALDataset::FromHandle(
      GDALTranslate(output.c_str(), GDALDataset::ToHandle(&source), options.get(), &usageError)));
  if (context.cancelled()) return failure(ErrorCode::interrupted, "fetching was interrupted");
  if (written) written->FlushCache();
  if (!written || errors.anyFailure())
    return failure(ErrorCode::unreadable,
                   fmt::format("the box could not be fetched: {}", errors.firstFailure()), output);
  return {};
}

}  // namespace

Status fetchPublicDem(const PublicDem& dem, const Box2& degrees, std::string_view mirror,
                      const std::string& output, Warnings& warnings, const RunContext& context) {
  registerGdal();
  // No listing of remote folders: publishers' buckets have thousands of files in one.
  CPLSetConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR");
  ARETE_TRY(const std::vector<std::string> paths, rasterPaths(dem, degrees, mirror));

  std::vector<GdalDatasetPtr> tiles;
  std::string cause;
  for (const std::string& path : paths) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "fetching was interrupted");
    GdalErrors errors;
    if (GdalDatasetPtr tile = openGdal(path, GDAL_OF_RASTER)) {
      tiles.push_back(std::move(tile));
      continue;
    }
    if (cause.empty()) cause = errors.firstFailure();
    warnings.push_back({WarningCode::omitted,
                        fmt::format("{}: this tile is left out: {}", path,
                                    errors.anyFailure() ? errors.firstFailure() : "it cannot be opened")});
  }
  if (tiles.empty())
    return failure(
        ErrorCode::notFound,
        fmt::format("none of the {} rasters of this box could be read; is there a network, and land? {}",
                    paths.size(), cause),
        std::string(dem.name));

  namespace fs = std::filesystem;
  const std::string temporary = fmt::format("{}.part{}.tif", output, getpid());
  const GdalDatasetPtr mosaic = mosaicOf(tiles);
  if (!mosaic) return failure(ErrorCode::unsupported, "the tiles do not fit together", std::string(dem.name));
  Status status = translate(*mosaic, degrees, temporary, context);
  std::error_code ignored, renamed;
  if (status) fs::rename(temporary, output, renamed);
  if (!status || renamed) fs::remove(temporary, ignored);
  if (renamed)
    return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", renamed.message()), output);
  return status;
}

}  // namespace arete
