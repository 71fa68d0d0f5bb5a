// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distances between the mesh and the source bound what is promised of all points. Where the error differs
// from place to place, each vertex of the source is held against what is allowed where it lies; that is
// stated here anew, in doubles, and not taken from the criterion of the cut.
#include "io/query/certificate/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/files/file_bytes.h"
#include "io/geo/crs/names.h"
#include "io/query/certificate/parts.h"
#include "io/query/certificate/report_json.h"
#include "io/store/format/checksum.h"

namespace arete {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

/// What a point of the source may be away from the mesh.
double allowedAt(const Vec3& place, const CutRequest& request) {
  const double error = request.maxError.value_or(0);
  if (request.spaceRegion) return request.spaceRegion->holdsBall(place, 0) ? error : request.outsideError;
  const Vec3 focus{request.focus->xy.x, request.focus->xy.y, request.focus->z.value_or(0)};
  return std::min(error + request.focus->growth * norm(place - focus), request.outsideError);
}

Result<SurfaceMeasure::Places> measurePlaces(const TriangleMesh& source, const TriangleMesh& mesh,
                                             const SurfaceModel& model, const CutRequest& request,
                                             const RunContext& context) {
  std::vector<double> distances;
  // The vertices alone: one sample, and no search.
  ARETE_TRY(const MeshDistanceReport report,
            measureDistance(source, mesh, {.samples = 1, .accuracy = kEverywhere}, context, &distances));
  SurfaceMeasure::Places places;
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * report.largestCoordinate;
  for (std::size_t v = 0; v < distances.size(); ++v) {
    const double allowed = allowedAt(source.positions[v], request) + model.positionError + rounding;
    if (!std::isfinite(allowed)) continue;
    ++places.vertices;
    if (distances[v] > allowed) ++places.beyond;
    places.largestShare = std::max(places.largestShare, allowed > 0 ? distances[v] / allowed : 0);
  }
  return places;
}

/// XXH3-64 of a file's bytes; empty where they cannot be read again, from a pipe.
std::string checksumOfFile(const std::string& path) {
  const Result<FileBytes> bytes = FileBytes::read(path);
  if (!bytes) return {};
  return fmt::format("{:016x}", amtChecksum(std::as_bytes(std::span(bytes->begin(), bytes->size()))));
}

}  // namespace

std::uint64_t certificateSamples(const TriangleMesh& source, const TriangleMesh& mesh) {
  constexpr std::uint64_t kLeast = 100'000;
  return std::max<std::uint64_t>(kLeast, 10 * std::max(source.triangles.size(), mesh.triangles.size()));
}

Result<SurfaceMeasure> measureSurface(const TriangleMesh& source, const TriangleMesh& mesh,
                                      const SurfaceModel& model, const CutRequest& request, bool isComplete,
                                      std::uint64_t samples, const RunContext& context) try {
  SurfaceMeasure measured;
  ARETE_TRY(MeshDistanceReport distances, measureDistance(mesh, source, {.samples = samples}, context));
  measured.distances = std::move(distances);
  measured.distances.raise(model.positionError);
  // By importance the error is another one at each vertex; its cut states the largest of them.
  if (isComplete && request.importance.empty() && (request.spaceRegion || request.focus)) {
    ARETE_TRY(const auto places, measurePlaces(source, mesh, model, request, context));
    measured.places = places;
  }
  return measured;
} catch (...) {
  return caughtFailure();
}

bool keepsPromise(const SurfaceMeasure& measured, double promisedError) {
  return checkDistance(measured.distances, promisedError, PromisedWay::fromSecond).has_value() &&
         (!measured.places || measured.places->beyond == 0);
}

std::string certificateJson(const SurfaceCertificate& c, const SurfaceModel& model) {
  Json json = {{"areteCertificate", kCertificateVersion},
               {"program", programName()},
               {"file", c.file},
               {"checksum", checksumOfFile(c.writtenAt)},
               {"format", formatJson({.name = c.formatName,
                                      .frame = c.frame,
                                      .says = {c.holds.holdsCrs && !model.crsWkt.empty(),
                                               c.holds.holdsVerticalUnit && !model.verticalUnit.empty(),
                                               c.holds.holdsErrors && !c.fit},
                                      .crsWkt = model.crsWkt,
                                      .verticalUnit = model.verticalUnit})},
               {"model",
                {{"path", c.model},
                 {"checksum", checksumOfFile(c.model)},
                 {"keepsBorders", model.options.keepsBorders},
                 {"displaced", !model.displacement.isEmpty()},
                 {"boundsLines", model.boundsLines},
                 {"positionError", model.positionError}}},
               {"source",
                {{"path", model.source},
                 {"kind", "surface"},
                 {"vertices", model.sourceVertices},
                 {"faces", model.fileFaces},
                 {"diagonal", model.diagonal},
                 {"crs", crsName(model.crsWkt)},
                 {"crsWkt", model.crsWkt},
                 {"verticalUnit", model.verticalUnit}}},
               {"criterion", toJson(c.criterion)},
               {"complete", c.isComplete},
               {"triangles", c.triangles},
               {"vertices", c.vertices},
               {"promise",
                {{"maxError", limitJson(c.promisedError)},
                 {"storedError", c.storedError},
                 {"kept", c.isKept},
                 {"proven", isProven(c.measured.distances, c.promisedError, PromisedWay::fromSecond)}}},
               {"measured", toJson(c.measured.distances)}};
  json["format"].erase("heightRounding");
  if (c.measured.places)
    json["measuredPlaces"] = {{"vertices", c.measured.places->vertices},
                              {"beyond", c.measured.places->beyond},
                              {"largestShare", c.measured.places->largestShare}};
  if (c.fit)
    json["fit"] = {{"rmsBefore", c.fit->rmsBefore},
                   {"rmsAfter", c.fit->rmsAfter},
                   {"errorBefore", c.fit->errorBefore},
                   {"part", c.fit->part}};
  if (c.droppedComponents > 0)
    json["dropped"] = {{"components", c.droppedComponents}, {"faces", c.droppedFaces}};
  json["check"] = c.checkCommand;
  return certificateText(json);
}

Status writeCertificate(const std::string& path, const SurfaceCertificate& certificate,
                        const SurfaceModel& model) try {
  return writeCertificateText(path, certificateJson(certificate, model));
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
