// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/certificate/certificate.h"

#include <nlohmann/json.hpp>

#include "engine/base/caught_failure.h"
#include "io/geo/crs/names.h"
#include "io/query/certificate/parts.h"
#include "io/query/certificate/report_json.h"

namespace arete {
namespace {

using Json = nlohmann::ordered_json;

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

Json terrainFormatJson(const ExportFormat& format, const Georeference& georeference,
                       const std::optional<PlacedFigures>& placed) {
  Json json = formatJson({.name = format.name,
                          .frame = format.frame,
                          .heightRounding = format.heightRounding,
                          .planTolerancePixels = format.planTolerancePixels,
                          .says = {format.saysCrs, format.saysVerticalUnit, format.saysErrors},
                          .crsWkt = georeference.crsWkt,
                          .verticalUnit = georeference.verticalUnit});
  // What the file is in, not the source.
  Json& missing = json["doesNotSay"];
  if (placed && !placed->isMetric && missing.contains("crs")) missing["crs"] = placed->target;
  if (placed && placed->isMetric && missing.contains("verticalUnit")) missing["verticalUnit"] = "metre";
  return json;
}

}  // namespace

std::string certificateJson(const Certificate& certificate, const TerrainModel& model) {
  Json json = {{"areteCertificate", kCertificateVersion},
               {"program", programName()},
               {"file", certificate.file},
               {"format", terrainFormatJson(certificate.format, model.georeference, certificate.placed)},
               {"model",
                {{"path", certificate.model},
                 {"shape", toString(model.options.shape)},
                 {"rimTolerance", model.options.rimTolerance}}},
               {"source", sourceJson(model)},
               {"criterion", toJson(certificate.criterion)},
               {"complete", certificate.isComplete},
               {"promise",
                {{"maxError", limitJson(certificate.promisedError)},
                 {"storedError", certificate.storedError},
                 {"kept", certificate.isKept}}},
               {"measured", measuredJson(certificate.measured, model.isRaster)}};
  if (certificate.fit)
    json["fit"] = {{"trianglesBefore", certificate.fit->trianglesBefore},
                   {"errorBefore", certificate.fit->errorBefore},
                   {"meanBefore", certificate.fit->meanBefore}};
  if (certificate.placed) json["placed"] = placedJson(*certificate.placed);
  if (certificate.measuredInside)
    json["measuredInside"] = measuredJson(*certificate.measuredInside, model.isRaster);
  json["check"] = certificate.checkCommand;
  return certificateText(json);
}

Status writeCertificate(const std::string& path, const Certificate& certificate,
                        const TerrainModel& model) try {
  return writeCertificateText(path, certificateJson(certificate, model));
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
