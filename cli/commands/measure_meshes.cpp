// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes in degrees are scaled to metres first; distances are computed by terrain/measure; places are scaled
// back.
#include "cli/commands/measure_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/commands/mesh_distance_text.h"
#include "io/files/text/stated_size.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/formats/exchange/metric_mesh.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/names.h"
#include "io/query/attributes/deviation_text.h"
#include "io/query/certificate/report_json.h"
#include "io/query/extract/model_file.h"
#include "io/store/amt/surface_file.h"
#include "measure/mesh_distance.h"
#include "surface/front/front.h"
#include "viewer/color/color_tables.h"

namespace arete {
namespace {

struct Measured : MeshFile {
  double positionError = 0;  ///< how far rounding has moved its vertices
};

/// A mesh, or the finest front of a surface's model: its source as the build mended it.
Result<Measured> readMeasured(const std::string& path, const Session& session) {
  const Result<AmtContainer> container = openModelFile(path);
  if (!container || !container->isOfSurface()) {
    ARETE_TRY(MeshFile read, readMesh(path, session.context()));
    return Measured{std::move(read)};
  }
  ARETE_TRY(const SurfaceModel model, loadSurfaceAmt(*container, {}, session.context()));
  Measured file;
  file.positionError = model.positionError;
  file.mesh = finestSurfaceOf(model).mesh;
  file.crsWkt = model.crsWkt;
  file.verticalUnit = model.verticalUnit;
  return file;
}

void compareFrames(const MeshFile& first, const MeshFile& second, const Session& session) {
  if (compareCrs(first.crsWkt, second.crsWkt) == CrsAgreement::different)
    session.warn(
        fmt::format("the first mesh is in {}, the second in {}: they are compared as if they were in one",
                    crsName(first.crsWkt), crsName(second.crsWkt)));
}

bool areDegrees(const MeshFile& first, const MeshFile& second) {
  return isGeographicCrs(first.crsWkt) && isGeographicCrs(second.crsWkt);
}

/// The meshes in metres if both are in degrees; else nothing, and they are compared as they are. A distance
/// between degrees and heights has no meaning, and the search for the nearest triangle would be slow: all are
/// about equally near.
Result<std::optional<MetricMeshes>> inMetres(const MeshFile& first, const MeshFile& second,
                                             const Session& session) {
  if (areDegrees(first, second)) {
    ARETE_TRY(MetricMeshes metric, toMetres(first, second));
    session.warn(fmt::format(
        "x and y are degrees: they are compared in metres, by the size of a degree at latitude {:.4g}",
        metric.latitude));
    return metric;
  }
  if (isGeographicCrs(first.crsWkt) || isGeographicCrs(second.crsWkt))
    return failure(ErrorCode::invalidData,
                   fmt::format("its x and y are degrees and those of the {} mesh are not",
                               isGeographicCrs(first.crsWkt) ? "second" : "first"),
                   isGeographicCrs(first.crsWkt) ? "first" : "second");
  return std::nullopt;
}

/// Scales the places of the report back to the coordinates of the files.
void restorePlaces(MeshDistanceReport& report, const MetricMeshes& meshes) {
  const auto divide = [](Vec3& place, const Vec3& units) {
    place = {place.x / units.x, place.y / units.y, place.z / units.z};
  };
  divide(report.forward.worst, meshes.firstUnits);
  divide(report.forward.worstNearest, meshes.secondUnits);
  divide(report.backward.worst, meshes.secondUnits);
  divide(report.backward.worstNearest, meshes.firstUnits);
}

double longest(const Vec3& v) {
  return std::max({v.x, v.y, v.z});
}

/// The unit of the distances, if both files have the same.
std::string unitOf(const MeshFile& first, const MeshFile& second) {
  if (areDegrees(first, second)) return "metre";
  return first.verticalUnit == second.verticalUnit ? first.verticalUnit : "";
}

Status writeDistances(const std::string& path, const MeshFile& mesh, const std::string& reference,
                      const std::vector<double>& distances, const Session& session) {
  const double largest = *std::ranges::max_element(distances);
  std::vector<float> qualities;
  std::vector<std::array<std::uint8_t, 3>> colors;
  qualities.reserve(distances.size());
  colors.reserve(distances.size());
  for (const double distance : distances) {
    qualities.push_back(static_cast<float>(distance));
    const double fraction = largest > 0 ? distance / largest : 0;
    const Rgba color = colorTable("difference").at(fraction);  // its upper half: zero is near-white
    colors.push_back({color.r, color.g, color.b});
  }
  MeshWriteOptions options;
  options.crsWkt = mesh.crsWkt;
  options.verticalUnit = mesh.verticalUnit;
  options.vertexQualities = qualities;
  options.vertexColors = colors;
  options.notes = {
      fmt::format("quality is the distance to {}, colours are from 0 to {}", reference, largest)};
  const TriangleMesh& shape = mesh.mesh;
  ARETE_CHECK(writeMesh(shape, path, options, session.context()));
  return {};
}

/// The library knows the meshes as the first and the second.
Error named(Error error, const MeasureMeshesArguments& arguments) {
  if (error.culprit == "first") error.culprit = arguments.first;
  if (error.culprit == "second") error.culprit = arguments.second;
  return error;
}

/// The attributes of the second mesh beside the first's.
/// @param within  no point of the second is farther from the first than this
Result<AttributeReport> attributesOf(const MeasureMeshesArguments& arguments, const MeshFile& first,
                                     const MeshFile& second, const std::optional<MetricMeshes>& metric,
                                     double within, const RunContext& context) {
  AttributeOptions options{.within = within,
                           .isStated = !arguments.expect.empty(),
                           .samples = static_cast<std::uint64_t>(arguments.samples),
                           .seed = static_cast<std::uint64_t>(arguments.seed)};
  if (!arguments.expectAttribute.empty()) {
    ARETE_TRY(options.expected, parseAttributeNumbers(arguments.expectAttribute));
  }
  Result<AttributeReport> report =
      measureAttributes({first.mesh, first.folder, metric ? &metric->first : nullptr},
                        {second.mesh, second.folder, metric ? &metric->second : nullptr}, options, context);
  if (report) {
    const auto restore = [&](Vec3& place, const Vec3& units) {
      place = {place.x / units.x, place.y / units.y, place.z / units.z};
    };
    for (AttributeDeviation& a : report->attributes) {
      if (!metric) break;
      restore(a.found.worst, metric->secondUnits);
      if (a.found.worstNear) restore(*a.found.worstNear, metric->firstUnits);
    }
    return report;
  }
  Error error = report.error();
  constexpr std::string_view kExpected = "expectAttribute ";
  if (error.culprit.starts_with(kExpected))
    error.culprit = "--expect-attribute " + error.culprit.substr(kExpected.size());
  return tl::unexpected(named(std::move(error), arguments));
}

}  // namespace

Status measureMeshes(const MeasureMeshesArguments& arguments, Session& session) {
  if (!arguments.errorMesh.empty()) {
    const auto format = meshFormatOf(arguments.errorMesh);
    if (!format || !format->holds.holdsQualities)
      return failure(ErrorCode::usage, "the mesh of distances is a PLY: its name ends in .ply",
                     fmt::format("--error-mesh {}", arguments.errorMesh));
    ARETE_CHECK(checkOutput("--error-mesh", arguments.errorMesh, {arguments.first, arguments.second}));
  }
  // Before the meshes are read: a list may be wrong by itself.
  if (const auto list = arguments.expectAttribute.empty() ? Result<std::vector<AttributeNumber>>()
                                                          : parseAttributeNumbers(arguments.expectAttribute);
      !list)
    return failure(ErrorCode::usage, list.error().message, "--expect-attribute " + list.error().culprit);
  ARETE_TRY(const Measured first, readMeasured(arguments.first, session));
  ARETE_TRY(const Measured second, readMeasured(arguments.second, session));
  session.warn(first.warnings, arguments.first);
  session.warn(second.warnings, arguments.second);
  compareFrames(first, second, session);

  const Result<std::optional<MetricMeshes>> metric = inMetres(first, second, session);
  if (!metric) return tl::unexpected(named(metric.error(), arguments));
  MeshDistanceOptions options;
  options.samples = static_cast<std::uint64_t>(arguments.samples);
  options.seed = static_cast<std::uint64_t>(arguments.seed);
  std::vector<double> distances;
  Result<MeshDistanceReport> report =
      measureDistance(*metric ? (*metric)->first : first.mesh, *metric ? (*metric)->second : second.mesh,
                      options, session.context(), arguments.errorMesh.empty() ? nullptr : &distances);
  if (!report) return tl::unexpected(named(report.error(), arguments));
  if (*metric) restorePlaces(*report, **metric);
  const double moved = *metric ? longest((*metric)->firstUnits) * first.positionError +
                                     longest((*metric)->secondUnits) * second.positionError
                               : first.positionError + second.positionError;
  const bool expects = !arguments.expect.empty();
  const double diagonal = report->second.diagonal;
  double expected = 0;
  if (expects) {
    const DataUnit unitOfDistances = *metric ? DataUnit{1} : spaceUnitOf(second.crsWkt, second.verticalUnit);
    ARETE_TRY(const auto stated, parseStatedSize(arguments.expect, "--expect", &unitOfDistances));
    expected = stated.of(diagonal);
  }
  const PromisedWay way = arguments.measuresBothWays ? PromisedWay::both : PromisedWay::fromSecond;
  // A promise is broken by what is found, and proven by what is certain of the source itself.
  const Status promise = expects ? checkDistance(*report, expected, way) : Status();
  std::optional<AttributeReport> attributes;
  if (arguments.wantsAttributes || !arguments.expectAttribute.empty()) {
    const double within = expects ? expected : report->backward.atMost;
    ARETE_TRY(attributes, attributesOf(arguments, first, second, *metric, within + moved, session.context()));
    session.warn(attributes->warnings, arguments.second);
  }
  const Status attributePromise = attributes ? checkAttributes(*attributes) : Status();
  report->raise(moved);
  if (!arguments.errorMesh.empty())
    ARETE_CHECK(writeDistances(arguments.errorMesh, first, arguments.second, distances, session));

  const std::string unit = unitOf(first, second);
  session.say(
      fmt::format("{} against {}\n{}", arguments.first, arguments.second, meshDistanceText(*report, unit)));
  if (moved > 0)
    session.say(fmt::format("each with the {} by which rounding may have moved vertices of the source\n",
                            withUnit(moved, unit)));
  if (expects && promise) {
    const std::string limit = fmt::format(
        "{} ({:.4g} % of the diagonal), {}", withUnit(expected, unit), 100 * expected / diagonal,
        arguments.measuresBothWays ? "both ways" : "from the second; --both-ways asks the other way too");
    session.say(isProven(*report, expected, way)
                    ? fmt::format("kept: nowhere farther than {}\n", limit)
                    : fmt::format("kept as far as found: nothing is known to be farther than {}\n", limit));
  }
  if (attributes) session.say(attributeReportText(*attributes, unit));
  if (attributePromise && !arguments.expectAttribute.empty())
    session.say(fmt::format("kept at every point that was looked at: {}\n", arguments.expectAttribute));
  Json json = {{"first", {{"path", arguments.first}, {"crs", crsName(first.crsWkt)}}},
               {"second", {{"path", arguments.second}, {"crs", crsName(second.crsWkt)}}},
               {"unit", unit},
               {"positionError", moved}};
  const Json found = toJson(*report);
  for (const char* which : {"first", "second"}) json[which].update(found[which]);
  for (const auto& [key, value] : found.items())
    if (!json.contains(key)) json[key] = value;
  if (expects) {
    json["expect"] = std::isfinite(expected) ? Json(expected) : Json();
    json["expectPercent"] = std::isfinite(expected) ? Json(100 * expected / diagonal) : Json();
    json["expectOf"] = arguments.measuresBothWays ? "bothWays" : "fromSecond";
    json["kept"] = promise.has_value();
    json["proven"] = !promise || isProven(*report, expected, way);
    if (!promise) json["broken"] = promise.error().message;
  }
  if (attributes) {
    json.update(toJson(*attributes));
    if (!arguments.expectAttribute.empty()) json["attributesKept"] = attributePromise.has_value();
  }
  session.answer(json);
  for (const Status& broken : {promise, attributePromise})
    if (!broken) return failure(broken.error().code, broken.error().message, arguments.first);
  return {};
}

}  // namespace arete
