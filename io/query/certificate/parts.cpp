// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/certificate/parts.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/files/file_writer.h"
#include "io/geo/crs/names.h"

namespace arete {
namespace {

using Json = nlohmann::ordered_json;

Json vectorJson(const Vec3& v) {
  return {v.x, v.y, v.z};
}

/// With the height of a parallel picture, which has no field of view that counts.
template <class AnyCamera>
Json withProjection(Json view, const AnyCamera& camera) {
  if (camera.parallelHeight > 0) {
    view.erase("fieldOfView");
    view["parallelHeight"] = camera.parallelHeight;
  }
  return view;
}

Json viewJson(const Camera& camera) {
  Json view = {{"x", camera.xy.x},
               {"y", camera.xy.y},
               {"height", camera.height},
               {"azimuth", camera.azimuthDegrees},
               {"pitch", camera.pitchDegrees},
               {"fieldOfView", camera.verticalFieldOfViewDegrees},
               {"viewport", {camera.widthPixels, camera.heightPixels}}};
  return withProjection(std::move(view), camera);
}

Json viewJson(const SurfaceCamera& camera) {
  Json view = {{"eye", vectorJson(camera.eye)},
               {"target", vectorJson(camera.target)},
               {"fieldOfView", camera.verticalFieldOfViewDegrees},
               {"viewport", {camera.widthPixels, camera.heightPixels}}};
  return withProjection(std::move(view), camera);
}

}  // namespace

std::string programName() {
  return "Arete " ARETE_VERSION;
}

Json limitJson(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json toJson(const CutRequest& request) {
  Json json = Json::object();
  if (request.maxError) json["maxError"] = limitJson(*request.maxError);
  if (request.maxTriangles) json["maxTriangles"] = *request.maxTriangles;
  if (!request.region.empty()) json["region"] = request.region;
  if (!request.regionCrs.empty()) json["regionCrs"] = request.regionCrs;
  if (request.distance > 0) json["distance"] = request.distance;
  if (request.focus) {
    json["focus"] = {{"x", request.focus->xy.x}, {"y", request.focus->xy.y}};
    if (request.focus->z) json["focus"]["z"] = *request.focus->z;
    json["focus"]["errorGrowth"] = request.focus->growth;
  }
  if (request.camera) json["camera"] = viewJson(*request.camera);
  if (request.spaceCamera) json["camera"] = viewJson(*request.spaceCamera);
  if (request.hasCamera()) json["pixelError"] = request.pixelError ? Json(*request.pixelError) : Json();
  if (!request.region.empty() || request.focus || request.hasCamera())
    json["outsideError"] = limitJson(request.outsideError);
  if (request.deadlineMilliseconds) json["deadlineMilliseconds"] = *request.deadlineMilliseconds;
  if (request.dropParts > 0) json["dropParts"] = request.dropParts;
  if (!request.importance.empty()) json["importance"] = request.importance;
  for (const AttributeNumber& of : request.attributeErrors)
    json["attributeErrors"][of.name] =
        of.unit.empty() ? Json(of.number) : Json(fmt::format("{}{}", of.number, of.unit));
  json["method"] = request.method == CutMethod::minimal ? "minimal" : "saturated";
  if (request.fit != CutFit::none) json["fit"] = fitName(request.fit);
  return json;
}

Json placedJson(const PlacedFigures& placed) {
  return {{"target", placed.target},
          {"addedVertices", placed.addedVertices},
          {"addedTriangles", placed.addedTriangles},
          {"addedError", placed.added}};
}

Json formatJson(const StatedFormat& format) {
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
  tell("crs", format.says.crs, format.crsWkt.empty() ? "" : crsName(format.crsWkt));
  tell("verticalUnit", format.says.verticalUnit, format.verticalUnit);
  tell("errors", format.says.errors, "of each triangle");
  json["says"] = std::move(says);
  json["doesNotSay"] = std::move(missing);
  return json;
}

std::string certificateText(const Json& certificate) {
  // A path need not be UTF-8.
  return certificate.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Status writeCertificateText(const std::string& path, const std::string& text) {
  ARETE_TRY(FileWriter writer, FileWriter::create(path));
  writer.write(text);
  return writer.finish();
}

}  // namespace arete
