// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/extract.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/drop_attributes.h"
#include "cli/arguments/mesh_options.h"
#include "cli/mesh/tolerance.h"
#include "cli/surface/criterion.h"
#include "engine/base/counted.h"
#include "engine/base/float_bounds.h"
#include "engine/cut/cut.h"
#include "io/files/file_writer.h"
#include "io/files/output_file.h"
#include "io/formats/exchange/grouped_faces.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/query/surface/fit_front.h"
#include "io/store/amt/surface_file.h"
#include "measure/mesh_distance.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/displacement/displaced_places.h"
#include "surface/front/face_map.h"
#include "surface/front/front.h"
#include "surface/front/model_components.h"
#include "surface/model/labels.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

struct Request {
  std::string output, map;
  std::optional<SurfaceTolerance> tolerance;
  std::optional<std::uint32_t> maxTriangles;
  bool statesShare = false;  ///< of the finest triangles
};

/// The part of a file's name that stands for what is asked.
/// @param error, budget as they were stated; empty: they were not.
std::string tagOf(const CriterionArguments::OfSurface& asked, const std::string& error,
                  const std::string& budget) {
  if (!error.empty() && !budget.empty()) return fmt::format("{}_{}", error, budget);
  if (!error.empty() || !budget.empty()) return error + budget;
  return fmt::format("{}px", asked.pixelError.value_or(1));
}

Result<std::vector<Request>> requestsOf(const SurfaceExtractArguments& arguments, const SurfaceModel& model) {
  const CriterionArguments::OfSurface& asked = arguments.asked;
  std::vector<std::optional<SurfaceTolerance>> tolerances(1);
  if (!asked.maxErrors.empty()) {
    ARETE_TRY(const auto stated, parseSurfaceTolerances("--max-error", asked.maxErrors, model.diagonal));
    tolerances.assign(stated.begin(), stated.end());
  }
  std::vector<std::optional<StatedTriangles>> budgets(1);
  if (!asked.maxTriangles.empty()) {
    ARETE_TRY(const auto stated, parseTriangleBudgets(asked.maxTriangles, model.mt.finestTriangleCount()));
    budgets.assign(stated.begin(), stated.end());
  }
  const bool several = tolerances.size() * budgets.size() > 1;
  std::vector<Request> requests;
  for (const auto& tolerance : tolerances)
    for (const auto& budget : budgets) {
      const std::string tag = tagOf(asked, tolerance ? tolerance->text : "", budget ? budget->text : "");
      requests.push_back({outputName(arguments.output, tag, several), outputName(arguments.map, tag, several),
                          tolerance, budget ? std::optional(budget->count) : std::nullopt,
                          budget && budget->text.ends_with('%')});
    }
  return requests;
}

Status checkOutputs(const SurfaceExtractArguments& arguments, const std::vector<Request>& requests) {
  std::vector<std::string> outputs;
  for (const Request& request : requests) {
    const Result<MeshFormat> format = meshFormatOf(request.output, arguments.format);
    if (!format || !format->write)
      return failure(ErrorCode::usage,
                     format ? fmt::format("{} cannot be written", format->name) : format.error().message,
                     fmt::format("--output {}", request.output));
    for (const auto& [option, path] :
         {std::pair{"--output", &request.output}, std::pair{"--map", &request.map}}) {
      if (path->empty()) continue;
      ARETE_CHECK(checkOutput(option, *path, {arguments.model}, outputs));
      outputs.push_back(*path);
    }
  }
  return {};
}

/// seamsOf() a model, whose build can leave attributes out.
std::string seamsOfModel(const SurfaceModel& model) {
  std::string seams = seamsOf(finestSurfaceOf(model).mesh);
  if (const std::size_t option = seams.find("--drop-attributes"); option != std::string::npos)
    seams.insert(option, "arete build with ");
  return seams;
}

/// What keeps the root from having fewer triangles.
std::string whyNotFewer(const SurfaceModel& model, const DroppedComponents* dropped,
                        const RunContext& context) {
  Cut root = frontOfPrefix(model.mt, 0);
  if (dropped) root = withoutDropped(model.mt, root, *dropped).cut;
  TriangleMesh mesh;
  for (const std::uint32_t v : root.vertices) mesh.positions.push_back(model.mt.position(VertexId(v)));
  mesh.triangles = root.triangles;
  const Result<MeshDiagnosis> d = diagnose(mesh, {.selfIntersections = false}, context);
  if (!d) return {};
  std::uint64_t handles = 0, borders = 0;
  for (const ComponentDiagnosis& c : d->components) {
    handles += static_cast<std::uint64_t>(std::max<std::int64_t>(0, c.genus.value_or(0)));
    borders += c.borders;
  }
  std::string why = grouped(d->components.size(), "component", "components");
  if (handles > 0) why += ", " + grouped(handles, "handle", "handles");
  if (borders > 0) {
    why += ", " + grouped(borders, "border", "borders");
    if (model.options.keepsBorders) why += agreeing(borders, ", which is kept", ", which are kept");
  }
  if (model.hasWedges()) why += ", seams";
  if (!model.attributes.materialOf.empty() || !model.attributes.objectOf.empty())
    why += ", edges between materials or objects";
  for (const Attribute& attribute : model.attributes.triangleAttributes)
    if (isLabel(attribute)) why += fmt::format(", edges between values of {}", attribute.name);
  return why + seamsOfModel(model);
}

/// @param criterion the engine's for what is asked
/// @param dropped components that need no triangles; null: none.
Result<Cut> cutOf(const SurfaceCriterion& asked, const SurfaceModel& model, const Criterion& criterion,
                  const DroppedComponents* dropped, const RunContext& context) {
  CutOptions options = engineOptions(asked);
  const std::uint32_t droppedTriangles = dropped ? dropped->rootTriangles : 0;
  if (options.maxTriangles) *options.maxTriangles += droppedTriangles;
  std::optional<OfTheRest> ofTheRest;
  if (dropped && asked.method == CutMethod::minimal) ofTheRest.emplace(criterion, *dropped);
  Result<Cut> cut =
      takeCut(model.mt, ofTheRest ? static_cast<const Criterion&>(*ofTheRest) : criterion, options, context);
  const std::uint32_t least = model.mt.rootTriangleCount() - droppedTriangles;
  if (!cut && asked.maxTriangles && *asked.maxTriangles < least)
    return failure(ErrorCode::usage,
                   fmt::format("the coarsest surface has {}: it has {}",
                               grouped(least, "triangle", "triangles"), whyNotFewer(model, dropped, context)),
                   fmt::format("--max-triangles {}", *asked.maxTriangles));
  return cut;
}

/// @param faces by face of the source: the triangle that stands for it.
Status writeMap(const std::string& path, const SurfaceModel& model, const SurfaceFront& front,
                const std::vector<std::uint32_t>& faces) {
  ARETE_TRY(FileWriter out, FileWriter::create(path));
  out.write("what,output,input\n");
  for (std::size_t v = 0; v < front.vertexOf.size(); ++v)
    out.write(fmt::format("vertex,{},{}\n", v, front.vertexOf[v]));
  const std::vector<std::uint32_t>& fileFace = model.attributes.faceOf;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (faces[f] != MeshAttributes::kNone)
      out.write(fmt::format("face,{},{}\n", faces[f], fileFace.empty() ? f : fileFace[f]));
  return out.finish();
}

Result<std::uint64_t> crossingsOf(const TriangleMesh& mesh, const RunContext& context) {
  ARETE_TRY(const MeshDiagnosis d, diagnose(mesh, {.mostPlaces = 1}, context));
  return d.selfIntersections->count;
}

class Extraction {
 public:
  Extraction(const SurfaceExtractArguments& arguments, const SurfaceModel& model, Session& session)
      : arguments_(arguments), model_(model), session_(session) {}

  Status run(const Request& request) {
    const DroppedComponents* dropped = dropped_ ? &*dropped_ : nullptr;
    const std::optional<double> maxError =
        request.tolerance ? std::optional(request.tolerance->distance) : std::nullopt;
    ARETE_TRY(const auto asked, readSurfaceCriterion(arguments_.asked, maxError, request.maxTriangles, model_,
                                                     session_.context()));
    ARETE_TRY(const auto criterion, engineCriterion(asked, model_));
    ARETE_TRY(const Cut whole, cutOf(asked, model_, *criterion, dropped, session_.context()));
    const CutOfTheRest rest = dropped ? withoutDropped(model_.mt, whole, *dropped) : CutOfTheRest{whole, {}};
    const Cut& cut = rest.cut;
    SurfaceFront front = surfaceOf(model_, cut);
    std::optional<FitOutcome> fit;
    if (arguments_.asked.isFitted) {
      // A cut that the budget ended does not keep the tolerance before the fit.
      ARETE_TRY(
          const auto fitted,
          fitFront(front, finestOfTheRest(), chartsOfCut(model_, finestCutOfTheRest(), cut),
                   model_.options.keepsBorders, cut.achievedError, whole.isComplete ? maxError : std::nullopt,
                   session_.context(), model_.positionError));
      fit = fitted;
    } else if (isDisplaced()) {
      displace(cut, criterion.get(), front);
    }
    ARETE_TRY(const std::uint64_t crossings, crossingsOf(front.mesh, session_.context()));
    if (crossings > 0) ARETE_CHECK(countSourceCrossings());
    MeshWriteOptions options;
    options.crsWkt = model_.crsWkt;
    options.verticalUnit = model_.verticalUnit;
    // A glTF has them in a frame of its own, whose z is up.
    const Result<MeshFormat> format = meshFormatOf(request.output, arguments_.format);
    const bool hasOwnFrame = format && format->holds.isYUp;
    // After a fit only the error of the whole mesh is known.
    if (!fit && (!hasOwnFrame || model_.up == "z")) options.triangleErrors = front.errors;
    options.format = arguments_.format;
    options.existing = arguments_.existing;
    OutputGroup together;
    options.up = model_.up == "y" ? MeshUp::y : model_.up == "z" ? MeshUp::z : MeshUp::unknown;
    ARETE_CHECK(dropNamed(front.mesh, arguments_.dropAttributes));
    ARETE_TRY(const MeshWriteReport written,
              writeMesh(front.mesh, request.output, options, session_.context()));
    Warnings warnings;
    for (const std::string& lost : written.lost)
      warnings.push_back({WarningCode::omitted, fmt::format("cannot hold {}", lost)});
    session_.warn(warnings, request.output);
    if (!request.map.empty()) {
      std::vector<std::uint32_t> faces = facesOf(model_, whole);
      for (std::uint32_t& face : faces)
        if (dropped && face != MeshAttributes::kNone) face = rest.numberOf[face];
      if (const std::vector<std::uint32_t> triangleOf = trianglesOfFile(front.mesh, *format);
          !triangleOf.empty()) {
        std::vector<std::uint32_t> placeOf(triangleOf.size());
        for (std::uint32_t i = 0; i < placeOf.size(); ++i) placeOf[triangleOf[i]] = i;
        for (std::uint32_t& face : faces)
          if (face != MeshAttributes::kNone) face = placeOf[face];
      }
      ARETE_CHECK(writeMap(request.map, model_, front, faces));
    }
    // A fit is measured by itself, and may keep what the stored errors cannot promise.
    const bool isKeptByFit = fit && request.tolerance && fit->distance <= request.tolerance->distance;
    const double left =
        isToleranceStated(request) && !isKeptByFit ? errorLeftByRounding(model_, *criterion, cut) : 0;
    if (left > 0)
      session_.warn(
          fmt::format("{}: the tolerance is not kept everywhere: rounding (--position-bits) has moved "
                      "vertices of the source by up to {}, and with it no error is below {}",
                      request.output, withShare(model_.positionError, model_.diagonal),
                      withShare(left, model_.diagonal)));
    ARETE_CHECK(together.commit());
    std::optional<double> droppedDistance;
    if (dropped && dropped->count > 0) {
      ARETE_TRY(const auto distance, distanceFrom(droppedSurface(model_, *dropped_), front.mesh));
      droppedDistance = distance;
    }
    std::optional<double> otherWay;
    if (arguments_.isBothWays) {
      ARETE_TRY(const auto distance, distanceFrom(front.mesh, finest()));
      otherWay = distance;
    }
    say(request, cut, front, {crossings, droppedDistance, otherWay, fit, left}, written);
    return {};
  }

  /// Errors: usage: nothing would be left.
  Status drop(double leastDiagonal) {
    dropped_ = componentsBelow(model_, leastDiagonal);
    if (dropped_->rootTriangles < model_.mt.rootTriangleCount()) return {};
    return failure(ErrorCode::usage, "leaves nothing: every component is smaller",
                   fmt::format("--drop-parts {}", arguments_.dropParts));
  }

  Json& exports() { return exports_; }

 private:
  /// What is found of a result beside its bound.
  struct Findings {
    std::uint64_t crossings = 0;
    std::optional<double> droppedDistance, otherWay;
    std::optional<FitOutcome> fit;
    double leftByRounding = 0;  ///< errorLeftByRounding() where a tolerance is not kept
  };

  /// Whether a tolerance is stated that rounding may break; a budget alone states none.
  bool isToleranceStated(const Request& request) const {
    const CriterionArguments::OfSurface& asked = arguments_.asked;
    return request.tolerance || asked.pixelError || (!asked.camera.empty() && asked.maxTriangles.empty());
  }

  bool isDisplaced() const { return !model_.displacement.isEmpty() && !arguments_.isUndisplaced; }

  /// Moves the vertices, and states of each triangle what is certain of it then.
  void displace(const Cut& cut, const BoundedCriterion* criterion, SurfaceFront& front) const {
    const std::vector<double> promised = promisedErrors(model_.mt, cut, criterion);
    front.mesh.positions = displacedPlaces(model_.mt, model_.displacement, cut, promised);
    for (std::size_t t = 0; t < promised.size(); ++t) front.errors[t] = floatAtLeast(promised[t]);
  }

  /// No point of a mesh is farther than this from another, one of which is the source as it was before
  /// rounding.
  Result<double> distanceFrom(const TriangleMesh& mesh, const TriangleMesh& other) const {
    ARETE_TRY(const double distance, farthestDistance(mesh, other, session_.context()));
    return distance + model_.positionError;
  }

  const TriangleMesh& finest() {
    if (!finest_) finest_ = finestSurfaceOf(model_).mesh.shape();
    return *finest_;
  }

  /// Without the components that are left out.
  TriangleMesh finestOfTheRest() {
    if (!dropped_) return finest();
    return surfaceOf(model_, finestCutOfTheRest()).mesh.shape();
  }
  Cut finestCutOfTheRest() const {
    const Cut whole = frontOfPrefix(model_.mt, model_.mt.nodeCount());
    return dropped_ ? withoutDropped(model_.mt, whole, *dropped_).cut : whole;
  }

  Status countSourceCrossings() {
    if (sourceCrossings_) return {};
    ARETE_TRY(const std::uint64_t count, crossingsOf(finest(), session_.context()));
    sourceCrossings_ = count;
    return {};
  }

  void say(const Request& request, const Cut& cut, const SurfaceFront& front, const Findings& found,
           const MeshWriteReport& written) {
    const double error = found.fit ? found.fit->distance : cut.achievedError;
    const bool hasBoth = request.tolerance && request.maxTriangles;
    const double percent = 100 * static_cast<double>(front.mesh.triangles.size()) /
                           static_cast<double>(model_.mt.finestTriangleCount());
    const char* const ended = cut.isComplete ? "--max-error" : "--max-triangles";
    std::string text =
        fmt::format("{}: {}{}, {}, no point of the source{} farther than {}{}\n", request.output,
                    grouped(front.mesh.triangles.size(), "triangle", "triangles"),
                    request.statesShare ? fmt::format(" ({:.4g} % of the finest)", percent) : "",
                    grouped(front.mesh.positions.size(), "vertex", "vertices"),
                    found.droppedDistance ? " but what is left out" : "", withShare(error, model_.diagonal),
                    hasBoth ? fmt::format("; ended by {}", ended) : "");
    if (!model_.boundsLines && model_.mayHaveLines())
      text +=
          "  lines      not bounded: an earlier version built the file, whose errors are distances to "
          "anything\n";
    // They keep most of the surface from being coarser.
    if (2 * model_.mt.rootTriangleCount() > model_.mt.finestTriangleCount())
      if (const std::string seams = seamsOfModel(model_); seams.size() > 2)
        text += fmt::format("  seams      {}\n", seams.substr(2));
    if (found.fit)
      text += fmt::format("  fit        RMS {:.4g} % of the diagonal instead of {:.4g} %{}\n",
                          100 * found.fit->rmsAfter / model_.diagonal,
                          100 * found.fit->rmsBefore / model_.diagonal,
                          found.fit->part == 1
                              ? ""
                              : fmt::format("; {:.3g} of each move, to keep the tolerance", found.fit->part));
    else if (isDisplaced())
      text += "  displaced  to where the distances are smaller (--no-displacement: as in the source)\n";
    if (found.otherWay)
      text += fmt::format("  other way  no point of the result farther than {}\n",
                          withShare(*found.otherWay, model_.diagonal));
    if (found.droppedDistance)
      text += fmt::format("  left out   {} of {}, no point of {} farther than {}\n",
                          grouped(dropped_->count, "component", "components"),
                          grouped(dropped_->sourceFaces, "face", "faces"),
                          agreeing(dropped_->count, "it", "them"),
                          withShare(*found.droppedDistance, model_.diagonal));
    if (found.crossings > 0)
      text += fmt::format("  crossings  {} of triangles; the source has {}\n",
                          grouped(found.crossings, "pair", "pairs"), grouped(*sourceCrossings_));
    const Result<MeshFormat> format = meshFormatOf(request.output, arguments_.format);
    const bool mayDouble =
        format && format->holds.statesScalarType && model_.up != "z" && model_.mt.vertices().places64.empty();
    const double moved = mayDouble ? movedByFloats(front.mesh) : 0;
    if (moved > 0) text += doublesText(moved);
    for (const fs::path& beside : written.filesBeside)
      text += fmt::format("  beside     {}\n", beside.string());
    if (!request.map.empty()) text += fmt::format("  map        {}\n", request.map);
    session_.say(text);
    Json json = {{"file", request.output},
                 {"triangles", front.mesh.triangles.size()},
                 {"trianglesPercent", percent},
                 {"vertices", front.mesh.positions.size()},
                 {"error", error},
                 {"errorPercent", 100 * error / model_.diagonal},
                 {"boundsLines", model_.boundsLines},
                 {"complete", cut.isComplete && found.leftByRounding == 0},
                 {"displaced", !found.fit && isDisplaced()},
                 {"selfIntersections", found.crossings},
                 {"movedByFloats", moved},
                 {"lost", written.lost}};
    if (dropped_)
      json["dropped"] = {{"components", dropped_->count},
                         {"faces", dropped_->sourceFaces},
                         {"distance", found.droppedDistance ? Json(*found.droppedDistance) : Json()}};
    if (found.leftByRounding > 0) json["leftByRounding"] = found.leftByRounding;
    if (found.otherWay) json["otherWay"] = *found.otherWay;
    if (found.fit)
      json["fit"] = {{"rmsBefore", found.fit->rmsBefore},
                     {"rmsAfter", found.fit->rmsAfter},
                     {"errorBefore", cut.achievedError},
                     {"part", found.fit->part}};
    if (sourceCrossings_) json["sourceSelfIntersections"] = *sourceCrossings_;
    if (request.tolerance && std::isfinite(request.tolerance->distance)) {
      json["maxError"] = request.tolerance->distance;
      json["maxErrorPercent"] = 100 * request.tolerance->distance / model_.diagonal;
    }
    if (request.maxTriangles) json["maxTriangles"] = *request.maxTriangles;
    if (hasBoth) json["endedBy"] = cut.isComplete ? "maxError" : "maxTriangles";
    if (!request.map.empty()) json["map"] = request.map;
    exports_.push_back(std::move(json));
  }

  const SurfaceExtractArguments& arguments_;
  const SurfaceModel& model_;
  Session& session_;
  std::optional<std::uint64_t> sourceCrossings_;
  std::optional<DroppedComponents> dropped_;
  std::optional<TriangleMesh> finest_;
  Json exports_ = Json::array();
};

}  // namespace

Status extractSurface(const SurfaceExtractArguments& arguments, const AmtContainer& file, Session& session) {
  ARETE_TRY(const SurfaceModel model, loadSurfaceAmt(file, AmtVerify::all, session.context()));
  ARETE_TRY(const auto requests, requestsOf(arguments, model));
  ARETE_CHECK(checkOutputs(arguments, requests));
  Extraction extraction(arguments, model, session);
  if (!arguments.dropParts.empty()) {
    ARETE_TRY(const auto least, parseSurfaceTolerances("--drop-parts", arguments.dropParts, model.diagonal));
    if (least.size() != 1) return failure(ErrorCode::usage, "takes one length", "--drop-parts");
    ARETE_CHECK(extraction.drop(least.front().distance));
  }
  for (const Request& request : requests) ARETE_CHECK(extraction.run(request));
  session.answer({{"model", arguments.model},
                  {"kind", "surface"},
                  {"diagonal", model.diagonal},
                  {"finestTriangles", model.mt.finestTriangleCount()},
                  {"exports", std::move(extraction.exports())}});
  return {};
}

}  // namespace arete
