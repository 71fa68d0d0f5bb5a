// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/extract.h"

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/query/certificate/parts.h"
#include "io/query/certificate/report_json.h"

namespace arete {
namespace {

using Json = nlohmann::ordered_json;

Json tinJson(const ExtractRequest& request, const ExtractedTin& tin) {
  const CutRequest& asked = request.criterion;
  Json json = {{"file", request.output}};
  if (asked.maxError) json["maxError"] = limitJson(*asked.maxError);
  if (asked.maxTriangles) json["maxTriangles"] = *asked.maxTriangles;
  if (asked.pixelError) json["pixelError"] = *asked.pixelError;
  if (asked.deadlineMilliseconds) json["deadline"] = *asked.deadlineMilliseconds;
  json["complete"] = tin.isComplete;
  if (const std::string_view ended = endedBy(asked, tin.isComplete); !ended.empty()) json["endedBy"] = ended;
  json["triangles"] = tin.triangles;
  if (tin.finestTriangles)
    json["trianglesPercent"] =
        100 * static_cast<double>(tin.triangles) / static_cast<double>(*tin.finestTriangles);
  json["vertices"] = tin.vertices;
  json["storedError"] = tin.storedError;
  if (tin.pixels) json["pixels"] = limitJson(*tin.pixels);
  json["promisedError"] = limitJson(tin.promisedError);
  if (tin.relief && *tin.relief > 0) {
    if (asked.maxError && std::isfinite(*asked.maxError))
      json["maxErrorPercent"] = 100 * *asked.maxError / *tin.relief;
    json["storedErrorPercent"] = 100 * tin.storedError / *tin.relief;
  }
  if (!request.certificate.empty()) json["certificate"] = request.certificate;
  if (!request.errorRaster.empty()) json["errorRaster"] = request.errorRaster;
  if (tin.fit)
    json["fit"] = {{"for", fitName(asked.fit)},
                   {"trianglesBefore", tin.fit->trianglesBefore},
                   {"errorBefore", tin.fit->errorBefore},
                   {"meanBefore", tin.fit->meanBefore}};
  if (tin.placed) json["placed"] = placedJson(*tin.placed);
  if (tin.measured) json["measured"] = toJson(*tin.measured, tin.isRaster);
  if (tin.measuredInside) json["measuredInside"] = toJson(*tin.measuredInside, tin.isRaster);
  if (tin.measured) json["kept"] = tin.isKept;
  return json;
}

Json surfaceJson(const ExtractRequest& request, const ExtractedSurface& found) {
  const CutRequest& asked = request.criterion;
  Json json = {{"file", request.output},
               {"triangles", found.triangles},
               {"trianglesPercent",
                100 * static_cast<double>(found.triangles) / static_cast<double>(found.finestTriangles)},
               {"vertices", found.vertices},
               {"error", found.error},
               {"errorPercent", 100 * found.error / found.diagonal},
               {"boundsLines", found.boundsLines},
               {"complete", found.isComplete && found.leftByRounding == 0},
               {"displaced", found.isDisplaced},
               {"selfIntersections", found.crossings},
               {"movedByFloats", found.movedByFloats},
               {"lost", found.written.lost}};
  if (found.droppedComponents)
    json["dropped"] = {{"components", *found.droppedComponents},
                       {"faces", *found.droppedFaces},
                       {"distance", found.droppedDistance ? Json(*found.droppedDistance) : Json()}};
  if (found.importance)
    json["importance"] = {{"name", asked.importance},
                          {"least", found.importance->least},
                          {"largest", found.importance->largest},
                          {"weightedError", found.importance->weighted}};
  if (!found.attributeErrors.empty()) {
    json["attributeErrors"] = Json::object();
    for (const AttributeNumber& of : found.attributeErrors)
      json["attributeErrors"][of.name] = std::isfinite(of.number) ? Json(of.number) : Json();
  }
  for (const AttributeChange& change : found.attributeChanges)
    json["attributeChanges"].push_back(toJson(change));
  if (found.leftByRounding > 0) json["leftByRounding"] = found.leftByRounding;
  if (request.packedBits) json["movedByGrid"] = found.movedByGrid;
  if (found.otherWay) json["otherWay"] = *found.otherWay;
  if (found.fit)
    json["fit"] = {{"rmsBefore", found.fit->rmsBefore},
                   {"rmsAfter", found.fit->rmsAfter},
                   {"errorBefore", found.storedError},
                   {"part", found.fit->part}};
  for (const AttributeRms& of : found.movedAttributes) json["movedAttributes"].push_back(toJson(of));
  if (found.sourceCrossings) json["sourceSelfIntersections"] = *found.sourceCrossings;
  if (asked.maxError && std::isfinite(*asked.maxError)) {
    json["maxError"] = *asked.maxError;
    json["maxErrorPercent"] = 100 * *asked.maxError / found.diagonal;
  }
  if (asked.maxTriangles) json["maxTriangles"] = *asked.maxTriangles;
  if (asked.deadlineMilliseconds) json["deadline"] = *asked.deadlineMilliseconds;
  if (const std::string_view ended = endedBy(asked, found.isComplete); !ended.empty())
    json["endedBy"] = ended;
  if (!request.map.empty()) json["map"] = request.map;
  if (found.measured) {
    json["certificate"] = request.certificate;
    json["promisedError"] = limitJson(found.promisedError);
    json["measured"] = toJson(found.measured->distances);
    json["kept"] = found.isKept;
  }
  return json;
}

}  // namespace

std::string_view endedBy(const CutRequest& request, bool isComplete) {
  if (!isComplete && request.deadlineMilliseconds) return "deadline";
  if (!request.maxError || !request.maxTriangles) return {};
  return isComplete ? "maxError" : "maxTriangles";
}

Result<ExtractReport> extract(const Model& model, const ExtractRequest& request, const RunContext& context,
                              const std::string& modelPath) {
  if (const auto* const terrain = std::get_if<TerrainModel>(&model)) {
    // The caller's model outlives this call.
    TinExtractor extractor(std::shared_ptr<const TerrainModel>(std::shared_ptr<void>(), terrain), modelPath);
    ARETE_TRY(ExtractedTin tin, extractor.extract(request, context));
    return ExtractReport(std::move(tin));
  }
  SurfaceExtractor extractor(std::get<SurfaceModel>(model), modelPath);
  ARETE_TRY(ExtractedSurface surface, extractor.extract(request, context));
  return ExtractReport(std::move(surface));
}

nlohmann::ordered_json toJson(const ExtractRequest& request, const ExtractReport& report) {
  if (const auto* const tin = std::get_if<ExtractedTin>(&report)) return tinJson(request, *tin);
  return surfaceJson(request, std::get<ExtractedSurface>(report));
}

}  // namespace arete
