// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh comes from a file or from arrays, and goes back as a mesh that is written as a cut is.
#include "python/bindings/meshes.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "io/files/text/stated_size.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/crs/map_scale.h"
#include "io/geo/crs/names.h"
#include "io/geo/crs/reader.h"
#include "io/geo/dem/dem_reader.h"
#include "io/query/attributes/deviation_text.h"
#include "io/query/certificate/report_json.h"
#include "io/query/mesh/decimation.h"
#include "io/query/mesh/diagnosis_json.h"
#include "io/query/mesh/facts.h"
#include "io/query/mesh/mend.h"
#include "io/query/placed/measure_placed.h"
#include "io/query/surface/mesh_input.h"
#include "measure/mesh_distance.h"
#include "python/bindings/arrays.h"
#include "python/bindings/build.h"
#include "python/bindings/calls.h"
#include "python/bindings/region.h"
#include "python/bindings/tin.h"
#include "surface/edit/drop_attributes.h"
#include "surface/edit/small_components.h"
#include "terrain/measure/measure.h"
#include "terrain/model/relief.h"

namespace arete::python {
namespace {

namespace py = pybind11;
using Json = nlohmann::ordered_json;

/// A file's name, or vertices and triangles.
using MeshSource = std::variant<std::string, std::tuple<Doubles, Indices>>;

/// A mesh with a report as JSON.
using Reported = std::tuple<CutTin, std::string>;

std::string nameOfSource(const MeshSource& source) {
  const auto* const path = std::get_if<std::string>(&source);
  return path ? *path : "arrays";
}

bool isOfArrays(const MeshSource& source) {
  return !std::holds_alternative<std::string>(source);
}

/// Arrays are taken while Python's lock is held.
std::optional<TriangleMesh> arraysOf(const MeshSource& source) {
  const auto* const arrays = std::get_if<std::tuple<Doubles, Indices>>(&source);
  if (!arrays) return std::nullopt;
  return meshOf(std::get<0>(*arrays), std::get<1>(*arrays));
}

Result<MeshInput> inputOf(const std::string& name, std::optional<TriangleMesh> arrays,
                          const RunContext& context) {
  if (!arrays) return readMeshInput(name, context);
  MeshInput input;
  input.format = "arrays";
  input.file.mesh = SurfaceMesh(std::move(*arrays));
  input.fileVertices = input.file.mesh.positions.size();
  input.fileFaces = input.file.mesh.triangles.size();
  return input;
}

std::string meshInfo(const MeshSource& source, bool findsCrossings, const py::object& progress) {
  const std::string name = nameOfSource(source);
  std::optional<TriangleMesh> arrays = arraysOf(source);
  return callOn(isOfArrays(source), progress, [&](const RunContext& context) -> Result<std::string> {
    ARETE_TRY(const MeshInput input, inputOf(name, std::move(arrays), context));
    ARETE_TRY(const MeshFacts facts, meshFactsOf(input.file.mesh,
                                                 {.mostPlaces = std::numeric_limits<std::size_t>::max(),
                                                  .selfIntersections = findsCrossings,
                                                  .rounding = input.rounding},
                                                 context));
    return meshFactsJson(name, input, facts).dump(-1, ' ', false, Json::error_handler_t::replace);
  });
}

/// @param vertexOf  by vertex: the vertex of the input that it is
CutTin tinOf(MeshFile file, std::vector<std::uint32_t> vertexOf) {
  Tin tin;
  tin.mesh = std::move(file.mesh);
  tin.crsWkt = std::move(file.crsWkt);
  tin.verticalUnit = std::move(file.verticalUnit);
  tin.up = file.up;
  tin.origin = file.frame.origin;
  tin.vertexOf = std::move(vertexOf);
  return CutTin(std::move(tin));
}

Reported repairMesh(const MeshSource& source, const std::string& weld, std::uint32_t fillHoles,
                    bool splitsSheets, const py::object& progress) {
  const std::string name = nameOfSource(source);
  std::optional<TriangleMesh> arrays = arraysOf(source);
  Warnings warnings;
  Reported reported =
      callOn(isOfArrays(source), progress, [&](const RunContext& context) -> Result<Reported> {
        ARETE_TRY(MeshInput input, inputOf(name, std::move(arrays), context));
        warnings = input.file.warnings;
        MendOptions options;
        options.repair.mostHoleEdges = fillHoles;
        options.repair.splitsSheets = splitsSheets;
        if (!weld.empty()) {
          ARETE_TRY(const StatedSize distance, parseStatedSize(weld, "weld"));
          options.weld = distance.of(diagonalOf(input.file.mesh));
        }
        Result<MendedMesh> mended = mendMesh(input, options, context);
        if (!mended && mended.error().culprit.empty()) mended.error().culprit = name;
        if (!mended) return tl::unexpected(mended.error());
        ARETE_TRY(const MeshDiagnosis diagnosis,
                  diagnose(mended->repaired.mesh,
                           {.mostPlaces = std::numeric_limits<std::size_t>::max(),
                            .selfIntersections = false,
                            .rounding = input.rounding},
                           context));
        for (const Warning& warning : input.file.warnings) warnings.push_back(warning);
        Json report = {{"joinedAtSeams", input.joinedAtSeams}};
        report.update(mendJson(*mended, input.rounding));
        report["result"] = diagnosisJson(diagnosis, {});
        return Reported(tinOf(std::move(input.file), std::move(mended->repaired.vertexOf)), report.dump());
      });
  warn(warnings);
  return reported;
}

Reported decimate(const MeshSource& source, DecimationRequest request, const std::string& maxError,
                  const std::string& dropParts, const std::vector<std::string>& dropNames,
                  double shareOfFaces, const py::object& progress) {
  const std::string name = nameOfSource(source);
  std::optional<TriangleMesh> arrays = arraysOf(source);
  Warnings warnings;
  Reported reported =
      callOn(isOfArrays(source), progress, [&](const RunContext& context) -> Result<Reported> {
        if (!maxError.empty()) {
          ARETE_TRY(request.maxError, parseStatedSize(maxError, "maxError"));
        }
        ARETE_TRY(MeshInput input, inputOf(name, std::move(arrays), context));
        if (std::holds_alternative<std::string>(source)) ARETE_CHECK(warnOfGaps(input, context));
        warnings = input.file.warnings;
        MeshFile& file = input.file;
        const std::size_t before = file.mesh.triangles.size();
        if (before == 0) return failure(ErrorCode::invalidData, "has no faces to be decimated", name);
        if (shareOfFaces > 0)
          request.maxTriangles = static_cast<std::uint32_t>(shareOfFaces * static_cast<double>(before));
        if (request.maxTriangles == 0u)
          return failure(ErrorCode::usage, "is less than one triangle", "maxTriangles");
        if (Status dropped = dropAttributes(file.mesh, dropNames); !dropped)
          return failure(dropped.error().code, dropped.error().message,
                         "drop_attributes=" + dropped.error().culprit);
        SmallComponents left;
        if (!dropParts.empty()) {
          ARETE_TRY(const StatedSize least, parseStatedSize(dropParts, "dropParts"));
          ARETE_TRY(left, withoutSmallComponents(file.mesh, least.of(diagonalOf(file.mesh))));
          if (left.mesh.triangles.empty())
            return failure(ErrorCode::usage, "leaves nothing: every component is smaller", "dropParts");
          file.mesh = std::exchange(left.mesh, {});
        }
        ARETE_TRY(DecimatedOutcome outcome, decimateMesh(std::move(file.mesh), request, context));
        if (outcome.dropsFlatNormals)
          warnings.push_back(
              {WarningCode::omitted, "normals of corners are left out: they belong to flat faces"});
        for (const std::string& lost : outcome.lost)
          warnings.push_back(
              {WarningCode::omitted, fmt::format("{} cannot carry {}: left out", request.method, lost)});
        if (!left.vertexOf.empty())
          for (std::uint32_t& v : outcome.vertexOf) v = left.vertexOf[v];
        Json report = {{"operator", request.method},
                       {"trianglesBefore", before},
                       {"triangles", outcome.mesh.triangles.size()},
                       {"error", outcome.fit ? Json(outcome.fit->distance) : Json()},
                       {"rms", outcome.fit ? Json(outcome.fit->rmsAfter) : Json()},
                       {"isComplete", outcome.isComplete},
                       {"selfIntersections", outcome.crossings ? Json(*outcome.crossings) : Json()},
                       {"dropped", {{"components", left.components}, {"faces", left.triangles}}}};
        file.mesh = std::move(outcome.mesh);
        return Reported(tinOf(std::move(file), std::move(outcome.vertexOf)), report.dump());
      });
  warn(warnings);
  return reported;
}

/// Distances between two meshes, as `arete measure --json` has them.
std::string measureMeshes(const MeshSource& first, const MeshSource& second, std::uint64_t samples,
                          std::uint64_t seed, const std::string& expect, bool bothWays, bool wantsAttributes,
                          const std::string& expectAttribute, const py::object& progress) {
  const std::string names[] = {nameOfSource(first), nameOfSource(second)};
  std::optional<TriangleMesh> arrays[] = {arraysOf(first), arraysOf(second)};
  const bool isArgument = isOfArrays(first) && isOfArrays(second);
  return callOn(isArgument, progress, [&](const RunContext& context) -> Result<std::string> {
    SurfaceMesh meshes[2];
    std::filesystem::path folders[2];
    for (int i = 0; i < 2; ++i) {
      if (arrays[i]) {
        meshes[i] = SurfaceMesh(std::move(*arrays[i]));
        continue;
      }
      ARETE_TRY(MeshFile file, readMesh(names[i], context));
      folders[i] = file.folder;
      meshes[i] = std::move(file.mesh);
    }
    ARETE_TRY(const MeshDistanceReport report,
              measureDistance(meshes[0], meshes[1], {.samples = samples, .seed = seed}, context));
    Json json = toJson(report);
    double within = report.backward.atMost;
    if (!expect.empty()) {
      ARETE_TRY(const StatedSize stated, parseStatedSize(expect, "expect"));
      const double most = stated.of(report.second.diagonal);
      const Status kept = checkDistance(report, most, bothWays ? PromisedWay::both : PromisedWay::fromSecond);
      json["expect"] = most;
      json["kept"] = kept.has_value();
      if (!kept) json["broken"] = kept.error().message;
      within = most;
    }
    if (wantsAttributes || !expectAttribute.empty()) {
      AttributeOptions options{
          .within = within, .isStated = !expect.empty(), .samples = samples, .seed = seed};
      if (!expectAttribute.empty()) {
        ARETE_TRY(options.expected, parseAttributeNumbers(expectAttribute));
      }
      ARETE_TRY(const AttributeReport attributes,
                measureAttributes({meshes[0], folders[0]}, {meshes[1], folders[1]}, options, context));
      json.update(toJson(attributes));
      if (const Status kept = checkAttributes(attributes); !expectAttribute.empty()) {
        json["attributesKept"] = kept.has_value();
        if (!kept) json["attributesBroken"] = kept.error().message;
      }
    }
    return json.dump();
  });
}

/// Where a TIN is. What its file or its object says goes before what the caller states.
Result<TinPlace> placeOfTin(const MeshFile& file, const std::string& name, const std::string& stated) {
  if (!stated.empty()) {
    if (const Result<OGRSpatialReference> crs = crsFromUser(stated); !crs)
      return failure(ErrorCode::usage, crs.error().message, "tin_crs=" + stated);
    if (compareCrs(stated, file.crsWkt) == CrsAgreement::different)
      return failure(ErrorCode::usage,
                     fmt::format("contradicts {}, which is in {}", name, crsName(file.crsWkt)),
                     "tin_crs=" + stated);
  }
  return TinPlace{.crsWkt = file.crsWkt.empty() ? stated : file.crsWkt, .metresAbout = file.metresAbout};
}

/// A TIN against a DEM, as `arete measure --json` has it.
/// @param ownCrs  of arrays: what their object says; may be empty
/// @param tinCrs  what the caller says; may be empty
std::string measureDem(const MeshSource& tin, const std::string& ownCrs, const std::string& tinCrs,
                       const std::string& dem, const BuildRequest& request,
                       const std::optional<AskedRegion>& region, const std::string& expect, bool allowsNodata,
                       const py::object& progress) {
  const std::string name = nameOfSource(tin);
  std::optional<TriangleMesh> arrays = arraysOf(tin);
  Warnings warnings;
  std::string answer = call(progress, [&](const RunContext& context) -> Result<std::string> {
    MeshFile file;
    if (arrays) {
      file.mesh = SurfaceMesh(std::move(*arrays));
      file.crsWkt = ownCrs;
    } else {
      ARETE_TRY(file, readMesh(name, context));
    }
    ARETE_TRY(const TinPlace place, placeOfTin(file, name, tinCrs));
    warnings = file.warnings;
    ARETE_TRY(const DemRead read, readDem(dem, request.reading, context));
    for (const Warning& warning : read.warnings) warnings.push_back(warning);
    return std::visit(
        [&](const auto& field) -> Result<std::string> {
          std::vector<std::uint8_t> mask;
          if (region) {
            ARETE_TRY(mask, samplesIn(*region, field, warnings, context));
          }
          MeasureOptions options;
          options.mask = mask;
          options.planRounding = {file.frame.rounding.x, file.frame.rounding.y};
          if (place.metresAbout && field.georeference.crsWkt.empty())
            warnings.push_back({WarningCode::position,
                                "the TIN is in metres about a place of a CRS, and the DEM has none: they are "
                                "compared as if they were in one"});
          ARETE_TRY(const MeasureReport report,
                    isElsewhere(place, field.georeference)
                        ? measureElsewhere(file.mesh, place, field, options, context)
                        : measure(file.mesh, field, options, context));
          Json json = toJson(report, std::holds_alternative<RasterHeightfield>(read.heightfield));
          if (!expect.empty()) {
            ARETE_TRY(const StatedSize stated, parseStatedSize(expect, "expect"));
            const double most = stated.of(stated.isShare ? reliefOf(field.heights) : 0);
            const Status kept = checkPromise(report, most, {.allowCoveredNodata = allowsNodata});
            json["expect"] = most;
            json["kept"] = kept.has_value();
            if (!kept) json["broken"] = kept.error().message;
          }
          return json.dump();
        },
        read.heightfield);
  });
  warn(warnings);
  return answer;
}

/// Metres of ground for a unit of x and of y at places along y: rows of two. Without a CRS a unit is one.
/// @param middle  x, y where the scale of a map is taken
Doubles groundUnits(const std::string& crsWkt, const std::array<double, 2>& middle, const Doubles& y) {
  Doubles units(std::vector<py::ssize_t>{y.size(), 2});
  Georeference georeference;
  if (!crsWkt.empty()) {
    const Result<OGRSpatialReference> crs = crsFromText(crsWkt);
    if (!crs) raise(crs.error());
    if (const Status described = describeCrs(*crs, georeference); !described) raise(described.error());
  }
  const auto scale = georeference.isGeographic || crsWkt.empty()
                         ? std::nullopt
                         : mapScaleAt(georeference, {middle[0], middle[1]});
  for (py::ssize_t i = 0; i < y.size(); ++i) {
    Vec2 unit{1, 1};
    if (georeference.isGeographic)
      unit = groundUnit(georeference, y.data()[i]);
    else if (!crsWkt.empty())
      unit = {georeference.linearUnitMetres / (scale ? (*scale)[0] : 1),
              georeference.linearUnitMetres / (scale ? (*scale)[1] : 1)};
    units.mutable_data()[2 * i] = unit.x;
    units.mutable_data()[2 * i + 1] = unit.y;
  }
  return units;
}

}  // namespace

void defineMeshes(py::module_& module) {
  py::class_<DecimationRequest>(module, "DecimationRequest")
      .def(py::init<>())
      .def_readwrite("operator", &DecimationRequest::method)
      .def_readwrite("queue", &DecimationRequest::queue)
      .def_readwrite("quadric_weight", &DecimationRequest::quadricWeight)
      .def_readwrite("cluster_vertices", &DecimationRequest::clusterVertices)
      .def_readwrite("attribute_weight", &DecimationRequest::attributeWeights)
      .def_readwrite("max_triangles", &DecimationRequest::maxTriangles)
      .def_readwrite("keep_borders", &DecimationRequest::keepsBorders)
      .def_readwrite("no_crossings", &DecimationRequest::forbidsCrossings);
  module.def("is_mesh_file", [](const std::string& path) { return isMeshFile(path); });
  module.def("holds_crs", [](const std::string& path) {
    const Result<MeshFormat> format = meshFormatOf(path);
    return format && format->holds.holdsCrs;
  });
  module.def("mesh_info", &meshInfo);
  module.def("repair", &repairMesh);
  module.def("decimate", &decimate);
  module.def("measure_meshes", &measureMeshes);
  module.def("measure_dem", &measureDem);
  module.def("ground_units", &groundUnits);
}

}  // namespace arete::python
