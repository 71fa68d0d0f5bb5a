// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cut comes from the engine (takeTin()). The proof does not use it: the exported file is read back and
// measured, where it is, against the samples that the model was built from (measureAndWrite()).
// Where the format rounds heights and the cut's error and the rounding together may exceed the tolerance, the
// TIN is taken a second time with a smaller tolerance.
#include "io/query/extract/tin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/cut/cut.h"
#include "io/files/output_file.h"
#include "io/files/text_scan.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/formats/exchange/written_mesh.h"
#include "io/geo/crs/local_frame.h"
#include "io/geo/crs/map_scale.h"
#include "io/geo/crs/names.h"
#include "io/geo/dem/raster_writer.h"
#include "io/query/extract/tin_normals.h"
#include "io/query/request/check_request.h"
#include "io/query/request/criterion.h"
#include "terrain/fit/fit.h"
#include "terrain/model/plan_region.h"

namespace arete {
namespace {

/// Heights are written as float32 if rounding changes them by less than this, in their unit.
constexpr double kNegligibleRounding = 1e-3;

/// What a triangle that keeps the tolerance may come to where a mesh is bent, and the least gain.
constexpr double kMostOfTolerance = 1.1, kLeastGain = 1e-2;

bool isRaster(const ExtractRequest& request) {
  return request.format.empty() && isGeoTiffName(request.output);
}

/// "EPSG:32632" of a CRS whose name has it, else the WKT.
std::string shortCrs(const std::string& wkt) {
  const std::string name = crsName(wkt);
  const std::size_t code = name.rfind("(EPSG:");
  return code == std::string::npos || !name.ends_with(')') ? wkt
                                                           : name.substr(code + 1, name.size() - code - 2);
}

/// The largest stored error of the triangles that meet the region.
double storedErrorInside(const TerrainModel& model, const Cut& cut, const Region& region) {
  const VertexArrays& v = model.mt.vertices();
  double largest = 0;
  for (std::size_t i = 0; i < cut.triangles.size(); ++i) {
    const double error = model.mt.error(TriangleId(cut.ids[i]));
    if (error <= largest) continue;
    const auto position = [&](int k) { return v.planPosition(VertexId(cut.vertices[cut.triangles[i][k]])); };
    if (region.meetsTriangle(position(0), position(1), position(2))) largest = error;
  }
  return largest;
}

/// What a fit that keeps a cut's triangles may use: the error that the cut has reached, so that no fit makes
/// the largest error larger.
FitTolerance toleranceOf(const TerrainModel& model, const CutRequest& c, const std::optional<Region>& region,
                         const Cut& cut) {
  const double inside = region ? storedErrorInside(model, cut, *region) : cut.achievedError;
  return {.maxError = inside,
          .region = region ? &*region : nullptr,
          .outsideError = std::max(inside, c.outsideError)};
}

/// A file's name without its folder, which an export does not tell.
std::string nameOf(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

std::string commentOf(const ExtractRequest& request, const TerrainModel& model, const ExtractedTin& tin) {
  return fmt::format(
      "arete: TIN of {} ({}), vertical error at most {}{}{}{}", nameOf(model.source), model.sourceChecksum,
      tin.promisedError, model.georeference.verticalUnit.empty() ? "" : " " + model.georeference.verticalUnit,
      request.region ? " in the region " + request.criterion.region : "", tin.fit ? ", heights fitted" : "");
}

std::optional<MeshPacking> packingOf(const ExtractRequest& request) {
  if (!request.packedBits) return {};
  return MeshPacking{.positionBits = *request.packedBits};
}

Status within(Status status, const std::string& path) {
  if (!status && status.error().culprit.empty()) status.error().culprit = path;
  return status;
}

ExportFormat formatOf(const std::string& path, const WrittenMesh& written, const MeshWriteOptions& options) {
  const Result<MeshFormat> format = meshFormatOf(path, options.format);
  if (!format) return {};
  return {.name = std::string(format->name),
          .frame = written.frame,
          .heightRounding = written.heightRounding,
          .saysCrs = format->holds.holdsCrs && !options.crsWkt.empty(),
          .saysVerticalUnit = format->holds.holdsVerticalUnit && !options.verticalUnit.empty(),
          .saysErrors = format->holds.holdsErrors};
}

}  // namespace

Status checkExtractOutput(const std::string& path, const TerrainModel& model, const std::string& name) try {
  if (name.empty() && isGeoTiffName(path)) {
    if (model.isRaster) return {};
    return failure(ErrorCode::usage,
                   "the model was built from scattered points: there is no source grid to sample the TIN on",
                   path);
  }
  std::string known;
  for (const MeshFormat& format : meshFormats())
    if (format.write) known += fmt::format("{} ({}), ", format.extension, format.name);
  const Result<MeshFormat> format = meshFormatOf(path, name);
  if (format && format->write) return {};
  const std::string extension = text::lowerExtension(path);
  return failure(
      ErrorCode::usage,
      fmt::format("{}; known are {}.tif (GeoTIFF: the TIN sampled on the source grid)",
                  extension.empty() ? "the extension that names a format is missing"
                                    : fmt::format("'.{}' is not a format that can be written", extension),
                  known),
      path);
} catch (...) {
  return caughtFailure();
}

Status checkExtractPlace(const ExtractRequest& request) {
  if (!request.place.isStated()) return {};
  if (isRaster(request))
    return failure(ErrorCode::usage,
                   "leads meshes, and a .tif is on the DEM's grid; gdalwarp -t_srs leads a raster",
                   request.place.isMetric ? "metric" : fmt::format("toCrs {}", request.place.crs));
  ARETE_TRY(const MeshFormat format, meshFormatOf(request.output, request.format));
  return checkPlacing(request.place, format);
}

Status checkExtractNormals(const ExtractRequest& request, const TerrainModel& model) {
  if (request.normals.kind == NormalsKind::keep) return {};
  if (isRaster(request))
    return failure(ErrorCode::usage, "are for meshes, and a .tif holds heights", "normals");
  if (request.place.isStated())
    return failure(ErrorCode::usage,
                   "cannot be combined with `metric` or `toCrs`; a .glb has metres, and normals of them",
                   "normals");
  ARETE_TRY(const MeshFormat format, meshFormatOf(request.output, request.format));
  if (model.georeference.isGeographic && !format.holds.isYUp)
    return failure(ErrorCode::usage,
                   fmt::format("are made of lengths, and {} holds the degrees of the DEM; a .glb has metres",
                               format.name),
                   "normals");
  return {};
}

Result<TinExport> takeTin(const TerrainModel& model, const CutRequest& c, const std::optional<Region>& region,
                          double reserve, std::optional<Cut> taken, ExtractedTin& tin,
                          const RunContext& context) try {
  ARETE_CHECK(checkRequest(c, ModelKind::terrain));
  const auto describe = [&](const Cut& cut) {
    tin.isComplete = cut.isComplete;
    tin.triangles = cut.triangles.size();
    tin.vertices = cut.vertices.size();
    tin.storedError = cut.achievedError;
    if (c.promisesMaxError(cut.isComplete))
      tin.promisedError = *c.maxError;
    else
      tin.promisedError = region ? storedErrorInside(model, cut, *region) : cut.achievedError;
  };
  const auto finish = [&](const Result<FittedCut>& fitted) -> Result<TinExport> {
    if (!fitted) return tl::unexpected(fitted.error());
    describe(fitted->cut);
    tin.fit = FitFigures{fitted->trianglesBefore, fitted->errorBefore, fitted->meanBefore};
    return exportTin(model, *fitted);
  };
  if (c.fit == CutFit::triangles) {
    const double maxError = std::max(0.0, c.maxError.value_or(0) - reserve);
    const Result<FittedCut> fewest = fitFewestTriangles(model,
                                                        {.maxError = maxError,
                                                         .region = region ? &*region : nullptr,
                                                         .outsideError = std::max(maxError, c.outsideError)},
                                                        {}, context);
    if (!fewest || !c.maxTriangles || fewest->cut.triangles.size() <= *c.maxTriangles) return finish(fewest);
    // Where the budget ends the cut, the fit makes its error as small as so many triangles allow.
  }
  ARETE_TRY(const auto criterion, engineCriterion(c, region, reserve, model));
  if (!taken) {
    ARETE_TRY(const auto options, engineOptions(c, model));
    ARETE_TRY(Cut cut, takeCut(model.mt, *criterion, options, context));
    taken = std::move(cut);
  }
  if (c.fit == CutFit::unbiased)
    return finish(fitUnbiased(model, *taken, toleranceOf(model, c, region, *taken), {}, context));
  if (c.fit == CutFit::error || (c.fit == CutFit::triangles && !region))
    return finish(fitLeastError(model, *taken, {}, context));
  if (c.camera) tin.pixels = worstSeverity(model.mt, *criterion, *taken);
  // Where a triangle passed by the bound over a node's ball, its own bound may be the looser of the two.
  if (c.camera && c.pixelError && taken->isComplete) tin.pixels = std::min(*tin.pixels, *c.pixelError);
  describe(*taken);
  return exportTin(model, *taken);
} catch (...) {
  return caughtFailure();
}

const TinExtractor::Samples& TinExtractor::samples() {
  if (!samples_) {
    if (model_->isRaster)
      samples_.emplace(model_->rasterSamples());
    else
      samples_.emplace(model_->pointSamples());
  }
  return *samples_;
}

// A cut keeps its tolerance near a focus, in sight or in a region, and may be far coarser elsewhere: there
// each triangle may gain a part of its own error.
Result<PlacedMesh> TinExtractor::lead(const ExtractRequest& request, const TinExport& exported,
                                      ExtractedTin& tin, double& bound, const RunContext& context) const {
  const CutRequest& asked = request.criterion;
  const bool isUneven = asked.focus || asked.camera;
  const double tolerance = isUneven ? asked.maxError.value_or(0) : tin.promisedError;
  ARETE_TRY(const MeshFormat format, meshFormatOf(request.output, request.format));
  const std::uint64_t samples = model_->isRaster ? std::uint64_t{model_->columns} * model_->rows
                                                 : std::uint64_t{model_->mt.vertexCount()};
  ARETE_TRY(PlacedMesh placed,
            placeInTarget(exported.mesh, exported.errors, model_->georeference, request.place, format,
                          {.tolerance = std::isfinite(tolerance) ? tolerance : 0,
                           .samples = samples,
                           .origin = exported.origin},
                          context));
  // Triangles that are coarser than the promise lie outside the region.
  bound = 0;
  const double most = request.region ? kMostOfTolerance * tin.promisedError + kLeastGain
                                     : std::numeric_limits<double>::infinity();
  for (const double error : placed.sourceErrors)
    if (error <= most) bound = std::max(bound, error);
  tin.promisedError = std::max(tin.promisedError, bound);
  tin.storedError = placed.figures.largestError;
  tin.triangles = placed.mesh.triangles.size();
  tin.vertices = placed.mesh.positions.size();
  tin.placed = placed.figures;
  tin.warnings.insert(tin.warnings.end(), placed.warnings.begin(), placed.warnings.end());
  return placed;
}

// A glTF has a frame of metres; other formats have the coordinates of the DEM, about an origin, so that the
// numbers are small.
Result<SurfaceMesh> TinExtractor::shade(const ExtractRequest& request, const TinExport& exported) const {
  ARETE_TRY(const MeshFormat format, meshFormatOf(request.output, request.format));
  const Vec3& origin = exported.origin;
  if (!format.holds.isYUp)
    return withNormals(
        exported.mesh, exported.vertexOf, *model_, [&](const Vec3& p) { return p - origin; },
        request.normals);
  Georeference georeference = model_->georeference;
  stateMapScale(georeference, {origin.x, origin.y});
  ARETE_TRY(const LocalFrame frame, LocalFrame::create(localFrameSpec(georeference, origin)));
  return withNormals(
      exported.mesh, exported.vertexOf, *model_, [&](const Vec3& p) { return frame.toLocal(p); },
      request.normals);
}

// A vertex on the rim that moves inwards leaves samples without a triangle.
void TinExtractor::warnOfRim(int bits, ExtractedTin& tin) const {
  const Vec3& rounding = tin.format.frame.rounding;
  const MeasureOptions options{.planRounding = {rounding.x, rounding.y}};
  if (!model_->isRaster || planTolerancePixels(options, model_->georeference) < kMostPlanTolerance) return;
  tin.warnings.push_back(
      {WarningCode::bound,
       fmt::format("a grid of {} bits moves the rim of the terrain by up to {:.2g}, {:.2g} (x, y), so that "
                   "samples there may lie in no triangle; `positionBits` states more",
                   bits, rounding.x, rounding.y)});
}

Result<TriangleMesh> TinExtractor::cutAndWrite(const ExtractRequest& request, double reserve,
                                               std::optional<Cut> taken, ExtractedTin& tin,
                                               const RunContext& context) {
  place_.reset();
  tin.warnings.clear();
  ARETE_TRY(TinExport made,
            takeTin(*model_, request.criterion, request.region, reserve, std::move(taken), tin, context));
  TinExport& exported = made;
  if (isRaster(request)) {
    tin.format = {.name = "GeoTIFF",
                  .saysCrs = !model_->georeference.crsWkt.empty(),
                  .saysVerticalUnit = !model_->georeference.verticalUnit.empty()};
    return std::move(exported.mesh);
  }
  std::optional<PlacedMesh> placed;
  double bound = 0;
  if (request.place.isStated()) {
    ARETE_TRY(placed, lead(request, exported, tin, bound, context));
  }
  if (const auto format = meshFormatOf(request.output, request.format)) {
    const std::string& crs = placed ? placed->crsWkt : model_->georeference.crsWkt;
    if (auto degrees = warningOfDegrees(*format, crs, model_->georeference.verticalUnit))
      tin.warnings.push_back(std::move(*degrees));
  }
  const double statedInFile = tin.promisedError;
  MeshWriteOptions write{.crsWkt = model_->georeference.crsWkt,
                         .verticalUnit = model_->georeference.verticalUnit,
                         .verticalUnitMetres = model_->georeference.verticalUnitMetres,
                         .triangleErrors = exported.errors,
                         .origin = exported.origin,
                         .format = request.format,
                         .notes = {commentOf(request, *model_, tin)},
                         .existing = request.existing,
                         .packing = packingOf(request)};
  if (placed) placed->describe(write);
  TriangleMesh& mesh = placed ? placed->mesh : exported.mesh;
  std::optional<SurfaceMesh> shaded;
  if (request.normals.kind != NormalsKind::keep) {
    ARETE_TRY(shaded, shade(request, exported));
    write.normalsAreOfFrame = true;
  }
  const MeshRef drawn = shaded ? MeshRef(*shaded) : MeshRef(mesh);
  Result<WrittenMesh> written =
      writeAndReadBack(drawn, request.output, write, model_->isRaster && !placed, context);
  if (!written) return tl::unexpected(within(tl::unexpected(written.error()), request.output).error());
  tin.format = formatOf(request.output, *written, write);
  if (!placed && !request.criterion.promisesMaxError(tin.isComplete))
    tin.promisedError += tin.format.heightRounding;
  // The heights of the file may count in metres.
  const double unit = placed && placed->metresAbout ? model_->georeference.verticalUnitMetres : 1;
  // The note in a packed file tells what its grid adds, which is known once it is written.
  const double promised = tin.promisedError,
               noted = (placed ? bound : tin.storedError) + tin.format.heightRounding / unit;
  if (request.packedBits && noted > statedInFile) {
    tin.promisedError = noted;
    write.notes = {commentOf(request, *model_, tin)};
    tin.promisedError = promised;
    written = writeAndReadBack(drawn, request.output, write, false, context);
    if (!written) return tl::unexpected(within(tl::unexpected(written.error()), request.output).error());
  }
  if (shaded)
    for (const std::string& lost : written->report.lost)
      tin.warnings.push_back({WarningCode::omitted, fmt::format("cannot hold {}", lost)});
  if (request.packedBits && !placed) warnOfRim(*request.packedBits, tin);
  TriangleMesh& held = written->mesh ? *written->mesh : mesh;
  if (!placed) return std::move(held);
  tin.promisedError = std::max(tin.promisedError, bound + tin.format.heightRounding / unit);
  place_ = TinPlace{.crsWkt = placed->crsWkt, .metresAbout = placed->metresAbout};
  if (placed->isFramedByWriter && model_->georeference.isGeographic) {
    // As programs draw it: triangles that are flat in the frame of the file.
    ARETE_TRY(const LocalFrame frame,
              LocalFrame::create(localFrameSpec(model_->georeference, *placed->origin)));
    for (Vec3& p : held.positions) p = frame.toLocal(p);
    place_ = TinPlace{.metresAbout = placed->origin};
  }
  return std::move(held);
}

Status TinExtractor::deepen(double maxError, double reserve, const RunContext& context) {
  if (!readAll_ || reserve <= kReadReserve * maxError) return {};
  ARETE_TRY(TerrainModel whole, readAll_(context));
  model_ = std::make_shared<const TerrainModel>(std::move(whole));
  readAll_ = {};
  return {};
}

Result<ExtractedTin> TinExtractor::extract(const ExtractRequest& request, const RunContext& context,
                                           std::optional<Cut> taken) try {
  ExtractedTin tin;
  ARETE_CHECK(checkExtractPlace(request));
  ARETE_CHECK(checkExtractNormals(request, *model_));
  OutputGroup together;
  Result<TriangleMesh> mesh = cutAndWrite(request, 0, std::move(taken), tin, context);
  if (!mesh) return tl::unexpected(mesh.error());
  // Twice, because another cut may be rounded differently.
  const double reserve = tin.placed ? 0 : 2 * tin.format.heightRounding;
  const double promised = tin.promisedError;
  if (reserve > 0 && request.criterion.promisesMaxError(tin.isComplete) && reserve < promised &&
      tin.storedError + reserve > promised) {
    ARETE_CHECK(deepen(promised, reserve, context));
    mesh = cutAndWrite(request, reserve, std::nullopt, tin, context);
    if (!mesh) return tl::unexpected(mesh.error());
  }
  // A grid that is coarse beside the tolerance moves more than a finer cut can make good.
  if (request.packedBits && tin.storedError + tin.format.heightRounding > tin.promisedError)
    tin.promisedError = tin.storedError + tin.format.heightRounding;
  // A fit promises nothing before it is measured.
  tin.isRaster = model_->isRaster;
  const bool needsMeasure =
      tin.fit || isRaster(request) || !request.certificate.empty() || !request.errorRaster.empty();
  if (needsMeasure) ARETE_CHECK(measureAndWrite(request, *mesh, tin, context));
  ARETE_CHECK(together.commit());
  if (request.keepsMesh) tin.mesh = std::move(*mesh);
  return tin;
} catch (...) {
  return caughtFailure(request.output);
}

Status TinExtractor::measureAndWrite(const ExtractRequest& request, const TriangleMesh& mesh,
                                     ExtractedTin& tin, const RunContext& context) {
  const bool wantsRasters =
      isRaster(request) || !request.errorRaster.empty() || (request.keepsMesh && model_->isRaster);
  MeasureRasters rasters;
  const Vec3& rounding = tin.format.frame.rounding;
  const auto measureWith = [&](MeasureOptions options, MeasureRasters* into) {
    options.planRounding = {rounding.x, rounding.y};
    return std::visit(
        [&](const auto& field) {
          if (place_ && isElsewhere(*place_, field.georeference))
            return measureElsewhere(mesh, *place_, field, options, context, into);
          return measure(mesh, field, options, context, into);
        },
        samples());
  };
  ARETE_TRY(MeasureReport all, measureWith({}, wantsRasters ? &rasters : nullptr));
  tin.measured = std::move(all);
  if (request.region) {
    const auto mask =
        std::visit([&](const auto& field) { return samplesInside(*request.region, field); }, samples());
    MeasureOptions options;
    options.mask = mask;
    ARETE_TRY(MeasureReport inside, measureWith(options, nullptr));
    tin.measuredInside = std::move(inside);
  }
  const ExpectOptions expect{.allowCoveredNodata = model_->options.rimTolerance > 0};
  tin.isKept =
      keepsPromise(tin.measuredInside ? *tin.measuredInside : *tin.measured, tin.promisedError, expect);

  if (place_)
    tin.format.planTolerancePixels = kBeyondRimPixels;
  else if (!isRaster(request))
    tin.format.planTolerancePixels =
        planTolerancePixels({.planRounding = {rounding.x, rounding.y}}, model_->georeference);
  ARETE_CHECK(writeRasters(request, rasters, tin, context));
  if (request.keepsMesh) tin.errors = std::move(rasters.errors);
  if (request.certificate.empty()) return {};
  ExtractRequest resolved = request;
  if (place_ && !request.place.crs.empty()) resolved.place.crs = shortCrs(place_->crsWkt);
  const Certificate certificate{
      .file = request.output,
      .model = modelPath_,
      .format = tin.format,
      .criterion = request.criterion,
      .isComplete = tin.isComplete,
      .storedError = tin.storedError,
      .fit = tin.fit,
      .placed = tin.placed,
      .measured = *tin.measured,
      .measuredInside = tin.measuredInside,
      .promisedError = tin.promisedError,
      .isKept = tin.isKept,
      .checkCommand = checkCommand_ ? checkCommand_(resolved, tin.promisedError) : ""};
  return within(writeCertificate(request.certificate, certificate, *model_), request.certificate);
}

Status TinExtractor::writeRasters(const ExtractRequest& request, const MeasureRasters& rasters,
                                  ExtractedTin& tin, const RunContext& context) const {
  if (isRaster(request)) {
    double largest = 0;
    for (const double z : rasters.tinHeights)
      if (!std::isnan(z)) largest = std::max(largest, std::abs(z));
    GeoTiffOptions options;
    options.description = "TIN height";
    if (largest * std::numeric_limits<float>::epsilon() / 2 > kNegligibleRounding)
      options.sample = GeoTiffOptions::Sample::float64;
    tin.format.frame.coordinates = options.sample == GeoTiffOptions::Sample::float64
                                       ? "float64 heights on the source grid"
                                       : "float32 heights on the source grid";
    if (Status written = writeGeoTiff(request.output, model_->columns, model_->rows, rasters.tinHeights,
                                      model_->georeference, options, context);
        !written)
      return within(written, request.output);
  }
  if (request.errorRaster.empty()) return {};
  GeoTiffOptions options;
  options.description = "TIN height minus DEM height";
  return within(writeGeoTiff(request.errorRaster, model_->columns, model_->rows, rasters.errors,
                             model_->georeference, options, context),
                request.errorRaster);
}

}  // namespace arete
