// SPDX-License-Identifier: GPL-3.0-or-later
//
// `measured` builds the multitriangulation in memory, takes the cut that is wanted and fits it; the other
// operators are those of surface/decimate/decimate.h.
#include "cli/mesh/decimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/conversion_report.h"
#include "cli/arguments/drop_attributes.h"
#include "cli/arguments/mesh_options.h"
#include "cli/mesh/tolerance.h"
#include "engine/base/stopwatch.h"
#include "io/formats/exchange/convert.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/query/surface/map_file.h"
#include "io/query/surface/mesh_input.h"
#include "io/query/surface/take_surface.h"
#include "surface/builder/build.h"
#include "surface/decimate/decimate.h"
#include "surface/edit/small_components.h"
#include "surface/front/face_map.h"
#include "surface/front/front.h"

namespace arete {
namespace {

struct DecimateArguments {
  std::string input, maxTriangles, maxError, map, dropParts;
  std::string method = "measured", queue = "lazy", weight = "area", clusterVertices = "quadric";
  MeshOutput output;
  MeshPlacing placing;
  bool keepsBorders = false, forbidsCrossings = false;
  std::vector<std::string> dropAttributes;
  ExistingFile existing = ExistingFile::keepsOtherLayers;
};

constexpr std::array<std::pair<const char*, DecimateOperator>, 6> kOperators = {
    {{"qem", DecimateOperator::edge},
     {"lindstrom-turk", DecimateOperator::lindstromTurk},
     {"half-edge", DecimateOperator::halfEdge},
     {"vertex-pair", DecimateOperator::vertexPair},
     {"face", DecimateOperator::face},
     {"cluster", DecimateOperator::cluster}}};

/// "5000", or "10%" or "10%f" of the faces.
Result<std::uint32_t> triangleBudget(const std::string& text, std::uint64_t faces) {
  const std::string culprit = fmt::format("--max-triangles {}", text);
  std::string number = text;
  if (number.ends_with("%f")) number.pop_back();
  const bool isShare = number.ends_with('%');
  if (isShare) number.pop_back();
  ARETE_TRY(const auto parsed, parseNumbers(culprit, number));
  const double count = parsed.size() != 1 ? 0 : isShare ? parsed[0] / 100 * double(faces) : parsed[0];
  if (!(count >= 1) || !(count < 4e9) || (!isShare && count != std::floor(count)))
    return failure(ErrorCode::usage, "must be a number of triangles, or a percentage of the faces as 10%",
                   culprit);
  return static_cast<std::uint32_t>(count);
}

/// What is made of the mesh, whatever the method.
struct Outcome {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> vertexOf;  ///< by vertex: of the input
  /// By face of the input: the triangle that stands for it, or MeshAttributes::kNone. Of a measured one only
  /// for --map.
  std::vector<std::uint32_t> triangleFor;
  std::optional<std::uint64_t> crossings = {},
                               sourceCrossings = {};  ///< pairs of triangles; the source's if there are any
  std::vector<std::string> lost = {};
  std::uint64_t evaluations = 0, steps = 0;
  std::optional<FitOutcome> fit = {};
  std::optional<double> maxError = {};  ///< the tolerance that was stated
  bool isComplete = true;               ///< false: the budget ended it before the tolerance was reached
  bool dropsFlatNormals = false;
  std::string seams = {};  ///< seamsOf() where they keep most of the mesh from being smaller
};

/// The numbers as far as they do not depend on the mesh, which may take long to read.
Status checkNumbers(const DecimateArguments& a) {
  // Whether a share is a triangle or more is known with the faces.
  const bool isShare = a.maxTriangles.find('%') != std::string::npos;
  if (!a.maxTriangles.empty() && !isShare) ARETE_CHECK(triangleBudget(a.maxTriangles, 0));
  for (const auto& [option, text] : {std::pair{"--max-error", a.maxError}, {"--drop-parts", a.dropParts}}) {
    if (text.empty()) continue;
    ARETE_TRY(const auto sizes, parseSurfaceTolerances(option, text, 1));
    if (sizes.size() != 1)
      return failure(ErrorCode::usage,
                     option == std::string_view("--max-error") ? "takes one distance" : "takes one length",
                     option);
  }
  return {};
}

Status checkArguments(const DecimateArguments& a) {
  const auto refuse = [&](const char* option, const std::string& method) {
    return failure(ErrorCode::usage, fmt::format("is for --operator {}, not {}", method, a.method), option);
  };
  if (a.maxTriangles.empty() && a.maxError.empty())
    return failure(ErrorCode::usage, "one of --max-triangles and --max-error is required");
  if (!a.maxError.empty() && a.method != "measured") return refuse("--max-error", "measured, which measures");
  const bool hasQueue =
      a.method == "qem" || a.method == "half-edge" || a.method == "vertex-pair" || a.method == "face";
  if (a.queue != "lazy" && !hasQueue) return refuse("--queue", "qem, half-edge, vertex-pair or face");
  if (a.weight != "area" && !hasQueue && a.method != "cluster")
    return refuse("--quadric-weight", "qem, half-edge, vertex-pair, face or cluster");
  if (a.forbidsCrossings && (!hasQueue || a.method == "vertex-pair"))
    return refuse("--no-crossings", "qem, half-edge or face");
  if (a.clusterVertices != "quadric" && a.method != "cluster") return refuse("--cluster-vertices", "cluster");
  if (a.keepsBorders && a.method == "cluster")
    return failure(ErrorCode::usage, "cannot be combined with --operator cluster", "--keep-borders");
  return checkNumbers(a);
}

/// @param mesh whose attributes and parts keep more.
Error tooFew(const std::string& budget, std::uint64_t least, const std::string& method,
             const SurfaceMesh& mesh) {
  return {ErrorCode::usage,
          fmt::format(
              "the least that {} reaches is {}: components, handles, borders, seams and edges between "
              "objects, materials or labels of faces stay, edges of more than two faces too, and no triangle "
              "turns over{}",
              method, grouped(least, "triangle", "triangles"), seamsOf(mesh)),
          fmt::format("--max-triangles {}", budget)};
}

Result<Outcome> measured(SurfaceMesh mesh, const DecimateArguments& arguments,
                         std::optional<std::uint32_t> maxTriangles, Session& session) {
  SurfaceBuildOptions options;
  options.keepsBorders = arguments.keepsBorders;
  // A cut of so many triangles has what is coarser than a quarter of them whole.
  ARETE_TRY(const SurfaceModel model,
            buildSurface(std::move(mesh), options, session.context(), maxTriangles.value_or(0) / 4));
  CutRequest request;
  request.fit = CutFit::rms;
  request.maxTriangles = maxTriangles;
  if (maxTriangles && *maxTriangles < model.mt.rootTriangleCount())
    return tl::unexpected(tooFew(arguments.maxTriangles, model.mt.rootTriangleCount(), "measured",
                                 finestSurfaceOf(model).mesh));
  if (!arguments.maxError.empty()) {
    ARETE_TRY(const auto tolerances,
              parseSurfaceTolerances("--max-error", arguments.maxError, model.diagonal));
    if (tolerances.size() != 1) return failure(ErrorCode::usage, "takes one distance", "--max-error");
    request.maxError = tolerances.front().distance;
  }
  ARETE_TRY(TakenSurface taken, takeSurface(model, request, nullptr, session.context()));
  Outcome outcome;
  if (!arguments.map.empty()) outcome.triangleFor = facesOf(model, taken.whole);
  outcome.mesh = std::move(taken.front.mesh);
  outcome.vertexOf = std::move(taken.front.vertexOf);
  outcome.fit = taken.fit;
  ARETE_TRY(const std::uint64_t crossings, crossingsOf(outcome.mesh, session.context()));
  outcome.crossings = crossings;
  if (crossings > 0) {
    ARETE_TRY(const std::uint64_t ofSource, crossingsOf(finestSurfaceOf(model).mesh, session.context()));
    outcome.sourceCrossings = ofSource;
  }
  outcome.isComplete = taken.whole.isComplete;
  if (2 * model.mt.rootTriangleCount() > model.mt.finestTriangleCount())
    outcome.seams = seamsOf(finestSurfaceOf(model).mesh);
  outcome.maxError = request.maxError;
  outcome.dropsFlatNormals = model.mending.dropsFlatNormals;
  return outcome;
}

Result<Outcome> contracted(const SurfaceMesh& mesh, const DecimateArguments& arguments,
                           std::uint32_t maxTriangles, Session& session) {
  DecimateOptions options;
  for (const auto& [name, method] : kOperators)
    if (arguments.method == name) options.method = method;
  options.queue = arguments.queue == "greedy"     ? DecimateQueue::greedy
                  : arguments.queue == "estimate" ? DecimateQueue::estimate
                                                  : DecimateQueue::lazy;
  options.maxTriangles = maxTriangles;
  options.weighsByArea = arguments.weight == "area";
  options.keepsClusterVertices = arguments.clusterVertices == "original";
  options.keepsBorders = arguments.keepsBorders;
  options.forbidsCrossings = arguments.forbidsCrossings;
  ARETE_TRY(DecimatedMesh decimated, decimate(mesh, options, session.context()));
  if (decimated.mesh.triangles.size() > maxTriangles)
    return tl::unexpected(
        tooFew(arguments.maxTriangles, decimated.mesh.triangles.size(), arguments.method, decimated.mesh));
  Outcome outcome;
  outcome.mesh = std::move(decimated.mesh);
  outcome.vertexOf = std::move(decimated.vertexOf);
  outcome.triangleFor = std::move(decimated.triangleFor);
  outcome.lost = std::move(decimated.lost);
  outcome.evaluations = decimated.evaluations;
  outcome.steps = decimated.steps;
  outcome.dropsFlatNormals = decimated.dropsFlatNormals;
  return outcome;
}

Status writeNumbers(const std::string& path, const Outcome& outcome, const MeshInput& input,
                    const std::vector<std::uint32_t>& vertexBefore,
                    const std::vector<std::uint32_t>& faceBefore) {
  const auto through = [](const std::vector<std::uint32_t>& map, std::uint32_t i) {
    return map.empty() ? i : map[i];
  };
  return writeNumberMap(
      path,
      {.vertexOf = outcome.vertexOf,
       .triangleFor = outcome.triangleFor,
       .vertexOfFile =
           [&](std::uint32_t v) { return through(input.numbers.vertexOf, through(vertexBefore, v)); },
       .faceOfFile = [&](std::uint32_t f) { return through(input.numbers.faceOf, through(faceBefore, f)); }});
}

Status runDecimate(const DecimateArguments& arguments, Session& session) {
  ARETE_CHECK(checkArguments(arguments));
  ARETE_TRY(const MeshTarget target, meshTarget(arguments.output, arguments.input, session));
  if (!arguments.map.empty())
    ARETE_CHECK(checkOutput("--map", arguments.map, {arguments.input}, {target.path}));
  ARETE_TRY(MeshInput input, readMeshInput(arguments.input, session.context()));
  ARETE_CHECK(warnOfGaps(input, session.context()));
  session.warn(input.file.warnings, arguments.input);
  MeshFile& file = input.file;
  if (file.mesh.triangles.empty())
    return failure(ErrorCode::invalidData, "has no faces to be decimated", arguments.input);
  const std::size_t facesBefore = file.mesh.triangles.size();
  const bool isOfFloats = movedByFloats(file.mesh) == 0;
  ARETE_CHECK(dropNamed(file.mesh, arguments.dropAttributes));

  SmallComponents dropped;
  if (!arguments.dropParts.empty()) {
    ARETE_TRY(const auto least,
              parseSurfaceTolerances("--drop-parts", arguments.dropParts, diagonalOf(file.mesh)));
    if (least.size() != 1) return failure(ErrorCode::usage, "takes one length", "--drop-parts");
    ARETE_TRY(SmallComponents without, withoutSmallComponents(file.mesh, least.front().distance));
    dropped = std::move(without);
    if (dropped.mesh.triangles.empty())
      return failure(ErrorCode::usage, "leaves nothing: every component is smaller",
                     fmt::format("--drop-parts {}", arguments.dropParts));
    file.mesh = std::exchange(dropped.mesh, {});
  }
  std::optional<std::uint32_t> maxTriangles;
  if (!arguments.maxTriangles.empty()) {
    ARETE_TRY(const std::uint32_t budget, triangleBudget(arguments.maxTriangles, facesBefore));
    maxTriangles = budget;
  }
  Stopwatch working;
  const double diagonal = diagonalOf(file.mesh);
  Result<Outcome> outcome = arguments.method == "measured"
                                ? measured(std::move(file.mesh), arguments, maxTriangles, session)
                                : contracted(file.mesh, arguments, *maxTriangles, session);
  if (!outcome) {
    Error error = outcome.error();
    if (error.culprit.empty()) error.culprit = arguments.input;
    return tl::unexpected(std::move(error));
  }
  const double seconds = working.seconds();
  MeshFile result = std::move(file);
  result.mesh = std::move(outcome->mesh);
  const std::size_t triangles = result.mesh.triangles.size();
  result.triangleErrors.clear();
  result.warnings.clear();
  if (outcome->dropsFlatNormals)
    result.warnings.push_back(
        {WarningCode::omitted, "normals of corners are left out: they are those of flat faces"});
  for (const std::string& lost : outcome->lost)
    result.warnings.push_back(
        {WarningCode::omitted, fmt::format("{} cannot carry {}: left out", arguments.method, lost)});
  ARETE_TRY(const ConvertedMesh converted, convertMesh(std::move(result), target.path,
                                                       {.format = arguments.output.format,
                                                        .existing = arguments.existing,
                                                        .placing = arguments.placing,
                                                        .isOfFloats = isOfFloats},
                                                       session.context()));
  renumberForFile(outcome->triangleFor, converted.triangleOf);
  if (!arguments.map.empty())
    ARETE_CHECK(writeNumbers(arguments.map, *outcome, input, dropped.vertexOf, dropped.triangleOf));
  warnOfConversion(converted, arguments.input, target.format.name, session);
  std::string text = writtenText(target.path, converted);
  const double percent = 100 * static_cast<double>(triangles) / static_cast<double>(facesBefore);
  text += fmt::format("  of         {}, {:.4g} % of them, by {} in {:.2f} s\n",
                      grouped(facesBefore, "triangle", "triangles"), percent, arguments.method, seconds);
  if (dropped.components > 0)
    text += fmt::format("  left out   {} of {}\n", grouped(dropped.components, "component", "components"),
                        grouped(dropped.triangles, "face", "faces"));
  const bool hasBoth = !arguments.maxError.empty() && !arguments.maxTriangles.empty();
  if (outcome->fit)
    text += fmt::format("  distance   no point of the source{} farther than {}\n",
                        dropped.components > 0 ? " but what is left out" : "",
                        withShare(outcome->fit->distance, diagonal));
  if (outcome->seams.size() > 2) text += fmt::format("  seams      {}\n", outcome->seams.substr(2));
  if (hasBoth)
    text += fmt::format("  ended by   {}\n", outcome->isComplete ? "--max-error" : "--max-triangles");
  if (outcome->sourceCrossings)
    text += fmt::format("  crossings  {} of triangles; the source has {}\n",
                        grouped(*outcome->crossings, "pair", "pairs"), grouped(*outcome->sourceCrossings));
  if (outcome->evaluations > 0)
    text += fmt::format("  steps      {}; costs computed {} ({} queue)\n", grouped(outcome->steps),
                        grouped(outcome->evaluations, "time", "times"), arguments.queue);
  session.say(text);
  Json json = writtenJson(arguments.input, target.path, target.format.name, converted);
  json["operator"] = arguments.method;
  json["trianglesBefore"] = facesBefore;
  json["trianglesPercent"] = percent;
  json["diagonal"] = diagonal;
  if (maxTriangles) json["maxTriangles"] = *maxTriangles;
  if (outcome->maxError && std::isfinite(*outcome->maxError)) {
    json["maxError"] = *outcome->maxError;
    json["maxErrorPercent"] = 100 * *outcome->maxError / diagonal;
  }
  json["seconds"] = seconds;
  if (hasBoth) json["endedBy"] = outcome->isComplete ? "maxError" : "maxTriangles";
  if (outcome->fit) {
    json["error"] = outcome->fit->distance;
    json["errorPercent"] = 100 * outcome->fit->distance / diagonal;
    json["rms"] = outcome->fit->rmsAfter;
  }
  if (outcome->crossings) json["selfIntersections"] = *outcome->crossings;
  if (outcome->sourceCrossings) json["sourceSelfIntersections"] = *outcome->sourceCrossings;
  if (outcome->evaluations > 0) {
    json["steps"] = outcome->steps;
    json["evaluations"] = outcome->evaluations;
  }
  if (!arguments.dropParts.empty())
    json["dropped"] = {{"components", dropped.components}, {"faces", dropped.triangles}};
  session.answer(json);
  return {};
}

}  // namespace

void addMeshDecimateCommand(CLI::App& mesh, Session& session) {
  auto arguments = std::make_shared<DecimateArguments>();
  CLI::App* command =
      session.addCommand(mesh, "decimate", "Make a mesh smaller, once",
                         "  arete mesh decimate scan.obj -o small.obj --max-triangles 5000\n"
                         "  arete mesh decimate scan.ply -o small.glb --max-triangles 10%\n"
                         "  arete mesh decimate scan.ply -o small.ply --max-error 0.5%\n"
                         "  arete mesh decimate scan.ply -o small.ply --max-triangles 5000 --operator qem",
                         [arguments](Session& s) { return runDecimate(*arguments, s); });
  command->add_option("MESH", arguments->input, "Triangle mesh: " + readableMeshExtensions())
      ->required()
      ->type_name("");
  arguments->output.addTo(*command, "File to write", "");
  addOverwriteTo(*command, arguments->existing);
  command
      ->add_option("--max-triangles", arguments->maxTriangles,
                   "Largest number of triangles, or a percentage of the faces: 10% (or 10%f)")
      ->type_name("N|P%");
  command
      ->add_option("--max-error", arguments->maxError,
                   "Largest distance of a point of the mesh from the result, in its unit or as 0.5% of the\n"
                   "diagonal; measured after the fit (--operator measured)")
      ->type_name("E|P%");
  command
      ->add_option(
          "--operator", arguments->method,
          "measured: the multitriangulation's cut, fitted (default, the closest; two to seven times the "
          "processor time\n"
          "of qem); qem: edges, at the least of their quadric; lindstrom-turk: edges, memoryless (CGAL); "
          "half-edge: vertices go to a\n"
          "neighbour; vertex-pair: edges and near vertices; face: triangles become a vertex; cluster:\n"
          "cells of an octree. Only measured states a distance, to the same object, material and chart; the "
          "others\n"
          "bound none, nor how far a line between parts moves")
      ->check(oneOf({"measured", "qem", "lindstrom-turk", "half-edge", "vertex-pair", "face", "cluster"}))
      ->type_name("NAME");
  command
      ->add_option(
          "--queue", arguments->queue,
          "When costs are computed anew: lazy, where they would be the least (default); greedy, at once;\n"
          "estimate: their estimates, lazily")
      ->check(oneOf({"lazy", "greedy", "estimate"}))
      ->type_name("NAME");
  command->add_option("--quadric-weight", arguments->weight, "Of a quadric's planes: area (default) or none")
      ->check(oneOf({"area", "none"}))
      ->type_name("NAME");
  command
      ->add_option("--cluster-vertices", arguments->clusterVertices,
                   "Of a cluster: quadric, the least of it (default), or original, the best of its vertices")
      ->check(oneOf({"quadric", "original"}))
      ->type_name("NAME");
  command->add_flag("--keep-borders", arguments->keepsBorders, "Vertices on borders stay, to the bit");
  command->add_flag("--no-crossings", arguments->forbidsCrossings,
                    "Refuse steps that make the surface cross itself (qem, half-edge, face)");
  command
      ->add_option(
          "--drop-parts", arguments->dropParts,
          "Leave out components whose box has a diagonal below this, in the unit of the mesh or as 1%")
      ->type_name("D|P%");
  command
      ->add_option("--map", arguments->map,
                   "CSV to write: of each output vertex the input's, and of each input face the output's "
                   "that\nstands for it")
      ->type_name("FILE");
  addDropAttributesTo(*command, arguments->dropAttributes);
  addPlacingTo(*command, arguments->placing);
}

}  // namespace arete
