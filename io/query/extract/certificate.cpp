// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/certificate.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/base/caught_failure.h"
#include "io/files/file_writer.h"
#include "io/geo/crs/names.h"
#include "io/query/extract/report_json.h"

namespace arete {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchemaVersion = 1;

/// JSON has no infinity: null says that there is no limit.
Json limit(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json criterionJson(const ExtractCriterion& criterion) {
  Json json = Json::object();
  if (criterion.maxError) json["maxError"] = limit(*criterion.maxError);
  if (criterion.maxTriangles) json["maxTriangles"] = *criterion.maxTriangles;
  if (!criterion.region.empty()) json["region"] = criterion.region;
  if (!criterion.regionCrs.empty()) json["regionCrs"] = criterion.regionCrs;
  if (criterion.distance > 0) json["distance"] = criterion.distance;
  if (criterion.focus)
    json["focus"] = {
        {"x", criterion.focus->xy.x}, {"y", criterion.focus->xy.y}, {"errorGrowth", criterion.focus->growth}};
  if (criterion.camera) {
    const Camera& camera = *criterion.camera;
    json["camera"] = {{"x", camera.xy.x},
                      {"y", camera.xy.y},
                      {"height", camera.height},
                      {"azimuth", camera.azimuthDegrees},
                      {"pitch", camera.pitchDegrees},
                      {"fieldOfView", camera.verticalFieldOfViewDegrees},
                      {"viewport", {camera.widthPixels, camera.heightPixels}}};
    json["pixelError"] = criterion.pixelError ? Json(*criterion.pixelError) : Json();
  }
  if (!criterion.region.empty() || criterion.focus || criterion.camera)
    json["outsideError"] = limit(criterion.outsideError);
  if (criterion.deadlineMilliseconds) json["deadlineMilliseconds"] = *criterion.deadlineMilliseconds;
  json["method"] = criterion.method == CutMethod::minimal ? "minimal" : "saturated";
  if (criterion.fit != ExtractFit::none) json["fit"] = fitName(criterion.fit);
  return json;
}

/// A model numbers scattered points in its own way: the number would mislead.
Json measuredJson(const MeasureReport& report, bool isRaster) {
  Json json = toJson(report, isRaster);
  if (!isRaster && report.worst) json["error"]["worst"].erase("point");
  return json;
}

Json sourceJson(const TerrainModel& model) {
  const Georeference& g = model.georeference;
  Json json = {{"path", model.source},
               {"checksum", model.sourceChecksum},
               {"kind", model.isRaster ? "raster" : "points"},
               {"crs", crsName(g.crsWkt)},
               {"crsWkt", g.crsWkt},
               {"verticalUnit", g.verticalUnit},
               {"verticalDatum", g.verticalDatum}};
  if (model.isRaster) {
    json["columns"] = model.columns;
    json["rows"] = model.rows;
  }
  return json;
}

Json vectorJson(const Vec3& v) {
  return {v.x, v.y, v.z};
}

Json formatJson(const ExportFormat& format, const Georeference& georeference) {
  Json json = {{"name", format.name}, {"coordinates", format.frame.coordinates}};
  if (format.frame.origin) json["origin"] = vectorJson(*format.frame.origin);
  json["rounding"] = vectorJson(format.frame.rounding);
  json["heightRounding"] = format.heightRounding;
  if (format.planTolerancePixels > 0) json["planTolerancePixels"] = format.planTolerancePixels;
  Json says = Json::array(), missing = Json::object();
  const auto tell = [&](const char* what, bool isSaid, const std::string& value) {
    if (isSaid)
      says.push_back(what);
    else if (!value.empty())
      missing[what] = value;
  };
  tell("crs", format.saysCrs, georeference.crsWkt.empty() ? "" : crsName(georeference.crsWkt));
  tell("verticalUnit", format.saysVerticalUnit, georeference.verticalUnit);
  tell("errors", format.saysErrors, "of each triangle");
  json["says"] = std::move(says);
  json["doesNotSay"] = std::move(missing);
  return json;
}

}  // namespace

std::string certificateJson(const Certificate& certificate, const TerrainModel& model) {
  Json json = {{"areteCertificate", kSchemaVersion},
               {"program", "Arete " ARETE_VERSION},
               {"file", certificate.file},
               {"format", formatJson(certificate.format, model.georeference)},
               {"model",
                {{"path", certificate.model},
                 {"shape", toString(model.options.shape)},
                 {"rimTolerance", model.options.rimTolerance}}},
               {"source", sourceJson(model)},
               {"criterion", criterionJson(certificate.criterion)},
               {"complete", certificate.isComplete},
               {"promise",
                {{"maxError", limit(certificate.promisedError)},
                 {"storedError", certificate.storedError},
                 {"kept", certificate.isKept}}},
               {"measured", measuredJson(certificate.measured, model.isRaster)}};
  if (certificate.fit)
    json["fit"] = {{"trianglesBefore", certificate.fit->trianglesBefore},
                   {"errorBefore", certificate.fit->errorBefore}};
  if (certificate.measuredInside)
    json["measuredInside"] = measuredJson(*certificate.measuredInside, model.isRaster);
  json["check"] = certificate.checkCommand;
  // A path need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Status writeCertificate(const std::string& path, const Certificate& certificate,
                        const TerrainModel& model) try {
  ARETE_TRY(FileWriter writer, FileWriter::create(path));
  writer.write(certificateJson(certificate, model));
  return writer.finish();
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
