// SPDX-License-Identifier: GPL-3.0-or-later
#include "gis/driver/amt_dataset.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "engine/parallel/guest_work.h"
#include "gis/driver/gdal_errors.h"
#include "io/formats/exchange/export_tin.h"
#include "io/geo/crs/reader.h"
#include "io/query/extract/model_file.h"
#include "io/query/request/extract_request.h"
#include "io/query/surface/surface_part.h"
#include "io/store/format/layout.h"
#include "surface/model/surface_model.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

/// Overviews end where they are smaller than this.
constexpr int kLeastOverview = 128;

struct FineSurface {
  MultiTriangulation mt;  ///< of the part that was read
  Cut cut;
};

/// The minimal cut at a tolerance, with what it needs of the file: of pages a part, else everything.
Result<FineSurface> surfaceWithin(const AmtContainer& file, const SurfaceModel& outline, double tolerance) {
  ExtractRequest request;
  request.criterion.maxError = tolerance;
  ARETE_TRY(SurfaceModel part, readForExtract(file, {&request, 1}, outline));
  ARETE_TRY(Cut cut, takeCut(part.mt, UniformError(tolerance)));
  return FineSurface{std::move(part.mt), std::move(cut)};
}

}  // namespace

int AmtDataset::identify(GDALOpenInfo* info) {
  return info->nHeaderBytes >= static_cast<int>(kAmtMagic.size()) &&
         std::memcmp(info->pabyHeader, kAmtMagic.data(), kAmtMagic.size()) == 0;
}

GDALDataset* AmtDataset::open(GDALOpenInfo* info) {
  if (identify(info) == FALSE) return nullptr;
  if (info->eAccess == GA_Update) {
    // QGIS tries this of every layer first, and its log shows in red what is said of it.
    if ((info->nOpenFlags & GDAL_OF_VERBOSE_ERROR) != 0)
      CPLError(CE_Failure, CPLE_NotSupported, "%s: an .amt file is only read", info->pszFilename);
    return nullptr;
  }
  const auto refuse = [](const Error& error) {
    reportError(error);
    return nullptr;
  };
  const Result<DriverOptions> options = readOpenOptions(info->papszOpenOptions);
  if (!options) return refuse(options.error());
  // The file is not mapped: the host program must not end if another one truncates it.
  Result<AmtContainer> container = openModelFile(info->pszFilename, {.isCopied = true});
  if (!container) return refuse(container.error());
  auto dataset = std::make_unique<AmtDataset>();
  dataset->SetDescription(info->pszFilename);
  const bool wantsRaster = (info->nOpenFlags & GDAL_OF_RASTER) != 0,
             wantsLayer = (info->nOpenFlags & GDAL_OF_VECTOR) != 0;
  const Status opened = container->isOfSurface()
                            ? dataset->openSurface(*container, *options, wantsLayer)
                            : dataset->openTerrain(std::move(*container), *options, wantsRaster, wantsLayer);
  if (!opened) return refuse(opened.error());
  return dataset.release();
}

Status AmtDataset::openTerrain(AmtContainer container, const DriverOptions& options, bool wantsRaster,
                               bool wantsLayer) {
  Result<TerrainCuts> cuts = TerrainCuts::open(std::move(container), options.tolerance, options.cell);
  if (!cuts) return tl::unexpected(cuts.error());
  cuts_ = std::make_shared<TerrainCuts>(std::move(*cuts));
  const TerrainModel& outline = cuts_->outline();
  ARETE_CHECK(takeCrs(outline.georeference.crsWkt));
  // A raster without a geotransform is not placed; points always are, and so are pixels of a stated size.
  hasPosition_ = outline.georeference.hasGeoTransform || !outline.isRaster || options.cell;
  SetMetadataItem("SOURCE", fs::path(outline.source).filename().c_str());
  SetMetadataItem("TOLERANCE", CPLSPrintf("%.9g", options.tolerance));
  if (!outline.isolated.empty())
    SetMetadataItem("ISOLATED_SAMPLES", std::to_string(outline.isolated.size()).c_str());
  if (wantsRaster) {
    nRasterXSize = cuts_->grid().columns;
    nRasterYSize = cuts_->grid().rows;
    auto band = std::make_unique<HeightBand>(this, cuts_, 0);
    for (int k = 1; std::max(nRasterXSize, nRasterYSize) >> k >= kLeastOverview; ++k)
      band->addOverview(std::make_unique<HeightBand>(this, cuts_, k));
    SetBand(1, band.release());
    SetMetadataItem("AREA_OR_POINT", "Area");
  }
  // A cut of triangles is taken only when features are read; the layer keeps alive what it needs for that.
  if (wantsLayer)
    layer_ = std::make_unique<TriangleLayer>("triangles", crs_, [cuts = cuts_]() -> Result<PlacedTriangles> {
      ARETE_TRY(const TerrainCuts::Whole whole, cuts->take(cuts->tolerance()));
      ARETE_TRY(TinExport tin, runAsGuest([&] { return exportTin(whole.model, whole.cut); }));
      return PlacedTriangles::sorted(std::move(tin.mesh), whole.cut.ids, tin.errors);
    });
  return {};
}

Status AmtDataset::openSurface(const AmtContainer& container, const DriverOptions& options, bool wantsLayer) {
  if (!wantsLayer)
    return failure(
        ErrorCode::unsupported,
        "is of a surface, which has no single height over a place: it opens as a layer of triangles",
        container.path());
  ARETE_TRY(SurfaceModel read, runAsGuest([&] { return readOutline(container); }));
  const auto outline = std::make_shared<const SurfaceModel>(std::move(read));
  ARETE_CHECK(takeCrs(outline->crsWkt));
  SetMetadataItem("SOURCE", fs::path(outline->source).filename().c_str());
  SetMetadataItem("TOLERANCE", CPLSPrintf("%.9g", options.tolerance));
  // As of terrain, the triangles are read when features are.
  layer_ = std::make_unique<TriangleLayer>(
      "triangles", crs_, [container, outline, tolerance = options.tolerance]() -> Result<PlacedTriangles> {
        ARETE_TRY(const FineSurface fine,
                  runAsGuest([&] { return surfaceWithin(container, *outline, tolerance); }));
        const auto& [mt, cut] = fine;
        TriangleMesh mesh{{}, cut.triangles};
        for (const std::uint32_t v : cut.vertices) mesh.positions.push_back(mt.position(VertexId(v)));
        std::vector<float> errors;
        for (const std::uint32_t t : cut.ids) errors.push_back(static_cast<float>(mt.error(TriangleId(t))));
        return PlacedTriangles::sorted(std::move(mesh), cut.ids, errors);
      });
  return {};
}

Status AmtDataset::takeCrs(const std::string& wkt) {
  if (wkt.empty()) return {};
  // Text of a file: parsed without opening what it names.
  Result<OGRSpatialReference> crs = crsFromText(wkt);
  if (!crs)
    return failure(ErrorCode::corrupt, "its CRS is damaged: " + crs.error().message, GetDescription());
  crs_ = std::move(*crs);
  crs_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return {};
}

CPLErr AmtDataset::IRasterIO(GDALRWFlag mode, int left, int top, int width, int height, void* buffer,
                             int bufferColumns, int bufferRows, GDALDataType type, int bandCount, int* bands,
                             GSpacing pixelStep, GSpacing lineStep, GSpacing bandStep,
                             GDALRasterIOExtraArg* extra) {
  for (int i = 0; i < bandCount; ++i) {
    const CPLErr done = GetRasterBand(bands[i])->RasterIO(
        mode, left, top, width, height, static_cast<GByte*>(buffer) + i * bandStep, bufferColumns, bufferRows,
        type, pixelStep, lineStep, extra);
    if (done != CE_None) return done;
  }
  return CE_None;
}

CPLErr AmtDataset::GetGeoTransform(double* transform) {
  if (!cuts_ || !hasPosition_) return CE_Failure;
  std::ranges::copy(cuts_->grid().geoTransform, transform);
  return CE_None;
}

const OGRSpatialReference* AmtDataset::GetSpatialRef() const {
  return crs_.IsEmpty() ? nullptr : &crs_;
}

}  // namespace arete
