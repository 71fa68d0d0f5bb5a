// SPDX-License-Identifier: GPL-3.0-or-later
//
// Without its small components, made smaller (io/query/mesh/decimation.h), and written as a conversion is.
#include "cli/mesh/decimate.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/conversion_report.h"
#include "cli/arguments/drop_attributes.h"
#include "cli/arguments/mesh_options.h"
#include "cli/arguments/normals_option.h"
#include "cli/mesh/tolerance.h"
#include "cli/session/option_names.h"
#include "engine/base/stopwatch.h"
#include "io/files/text/stated_size.h"
#include "io/formats/common/file.h"
#include "io/formats/exchange/convert.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/crs/names.h"
#include "io/query/mesh/decimation.h"
#include "io/query/surface/changes_of_cut.h"
#include "io/query/surface/map_file.h"
#include "io/query/surface/mesh_input.h"
#include "surface/edit/small_components.h"

namespace arete {
namespace {

struct DecimateArguments {
  std::string input, maxTriangles, maxError, map, dropParts;
  DecimationRequest request;
  MeshOutput output;
  MeshPlacing placing;
  NormalsArguments normals;
  std::vector<std::string> dropAttributes;
  ExistingFile existing = ExistingFile::keepsOtherLayers;
};

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

Status writeNumbers(const std::string& path, const DecimatedOutcome& outcome, const MeshInput& input,
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

Result<StatedSize> distanceOf(const std::string& text, const DataUnit& unit) {
  ARETE_TRY(const auto sizes, parseStatedSizes(text, "--max-error", &unit));
  if (sizes.size() != 1) return failure(ErrorCode::usage, "takes one distance", "--max-error");
  return sizes.front();
}

Result<double> leastPart(const std::string& text, double diagonal, const DataUnit& unit) {
  ARETE_TRY(const auto sizes, parseSurfaceTolerances("--drop-parts", text, diagonal, unit));
  if (sizes.size() != 1) return failure(ErrorCode::usage, "takes one length", "--drop-parts");
  return sizes.front().distance;
}

/// For checks of a length before the mesh, and thus its unit, is read.
constexpr DataUnit kAnyUnit{1};

/// What is asked for, as far as the mesh does not decide it: a share of its faces is 1 here.
Result<DecimationRequest> requestOf(const DecimateArguments& arguments) {
  DecimationRequest request = arguments.request;
  request.wantsFaces = !arguments.map.empty();
  // Whether a share is a triangle or more is known with the faces.
  const bool isShare = arguments.maxTriangles.find('%') != std::string::npos;
  if (!arguments.maxTriangles.empty() && !isShare) ARETE_CHECK(triangleBudget(arguments.maxTriangles, 0));
  if (!arguments.maxTriangles.empty()) request.maxTriangles = 1;
  if (!arguments.maxError.empty()) {
    ARETE_TRY(request.maxError, distanceOf(arguments.maxError, kAnyUnit));
  }
  if (!arguments.dropParts.empty()) {
    ARETE_TRY([[maybe_unused]] const double least, leastPart(arguments.dropParts, 1, kAnyUnit));
  }
  ARETE_CHECK(checkDecimation(request));
  return request;
}

Status runDecimate(const DecimateArguments& arguments, Session& session) {
  ARETE_TRY(DecimationRequest request, requestOf(arguments));
  ARETE_TRY(const MeshTarget target, meshTarget(arguments.output, arguments.input, session));
  if (!arguments.map.empty() && arguments.output.isPacked)
    return failure(ErrorCode::usage, "tells numbers of the file, whose order --packed makes anew",
                   fmt::format("--map {}", arguments.map));
  if (!arguments.map.empty())
    ARETE_CHECK(checkOutput("--map", arguments.map, {arguments.input}, {target.path}));
  ARETE_TRY(MeshInput input, readMeshInput(arguments.input, session.context()));
  ARETE_CHECK(warnOfGaps(input, session.context()));
  session.warn(input.file.warnings, arguments.input);
  MeshFile& file = input.file;
  if (file.mesh.triangles.empty())
    return failure(ErrorCode::invalidData, "has no faces to be decimated", arguments.input);
  if (isGeographicCrs(file.crsWkt))
    session.warn({{WarningCode::position,
                   "x and y are degrees and heights are not, so that distances and errors mix them; "
                   "`arete convert --metric` makes metres of all"}},
                 arguments.input);
  const std::size_t facesBefore = file.mesh.triangles.size();
  const bool isOfFloats = movedByFloats(file.mesh) == 0;
  ARETE_CHECK(dropNamed(file.mesh, arguments.dropAttributes));

  SmallComponents dropped;
  if (!arguments.dropParts.empty()) {
    ARETE_TRY(const double least, leastPart(arguments.dropParts, diagonalOf(file.mesh), spaceUnitOf(file)));
    ARETE_TRY(SmallComponents without, withoutSmallComponents(file.mesh, least));
    dropped = std::move(without);
    if (dropped.mesh.triangles.empty())
      return failure(ErrorCode::usage, "leaves nothing: every component is smaller",
                     fmt::format("--drop-parts {}", arguments.dropParts));
    file.mesh = std::exchange(dropped.mesh, {});
  }
  if (!arguments.maxTriangles.empty()) {
    ARETE_TRY(request.maxTriangles, triangleBudget(arguments.maxTriangles, facesBefore));
  }
  if (!arguments.maxError.empty()) {
    ARETE_TRY(request.maxError, distanceOf(arguments.maxError, spaceUnitOf(file)));
  }
  Stopwatch working;
  const double diagonal = diagonalOf(file.mesh);
  Result<DecimatedOutcome> outcome = decimateMesh(std::move(file.mesh), request, session.context());
  if (!outcome) {
    Error error = outcome.error();
    if (error.culprit.empty()) error.culprit = arguments.input;
    // As it was stated, perhaps as a share.
    if (error.culprit.starts_with("maxTriangles"))
      error.culprit = fmt::format("--max-triangles {}", arguments.maxTriangles);
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
        {WarningCode::omitted, fmt::format("{} cannot carry {}: left out", request.method, lost)});
  ARETE_TRY(const ConvertedMesh converted, convertMesh(std::move(result), target.path,
                                                       {.format = arguments.output.format,
                                                        .existing = arguments.existing,
                                                        .placing = arguments.placing,
                                                        .normals = arguments.normals.options,
                                                        .isOfFloats = isOfFloats,
                                                        .packing = packingOf(arguments.output),
                                                        .flipsV = arguments.output.flipsV},
                                                       session.context()));
  renumberForFile(outcome->triangleFor, converted.triangleOf);
  if (!arguments.map.empty())
    ARETE_CHECK(writeNumbers(arguments.map, *outcome, input, dropped.vertexOf, dropped.triangleOf));
  warnOfConversion(converted, arguments.input, target.format.name, session);
  std::string text = writtenText(target.path, converted);
  const double percent = 100 * static_cast<double>(triangles) / static_cast<double>(facesBefore);
  text += fmt::format("  of         {}, {:.4g} % of them, by {} in {:.2f} s\n",
                      grouped(facesBefore, "triangle", "triangles"), percent, request.method, seconds);
  if (dropped.components > 0)
    text += fmt::format("  left out   {} of {}\n", grouped(dropped.components, "component", "components"),
                        grouped(dropped.triangles, "face", "faces"));
  const bool hasBoth = !arguments.maxError.empty() && !arguments.maxTriangles.empty();
  if (outcome->fit)
    text += fmt::format("  distance   no point of the source{} farther than {}\n",
                        dropped.components > 0 ? " but what is left out" : "",
                        withShare(outcome->fit->distance, diagonal));
  if (outcome->fit && arguments.normals.options.kind == NormalsKind::keep)
    text += movedText(outcome->fit->attributes);
  if (outcome->seams.size() > 2)
    text += fmt::format("  seams      {}\n", withOptionNames(outcome->seams).substr(2));
  if (hasBoth)
    text += fmt::format("  ended by   {}\n", outcome->isComplete ? "--max-error" : "--max-triangles");
  text += changesText(outcome->attributeChanges);
  if (outcome->sourceCrossings)
    text += fmt::format("  crossings  {} of triangles; the source has {}\n",
                        grouped(*outcome->crossings, "pair", "pairs"), grouped(*outcome->sourceCrossings));
  if (outcome->evaluations > 0)
    text += fmt::format("  steps      {}; costs computed {} ({} queue)\n", grouped(outcome->steps),
                        grouped(outcome->evaluations, "time", "times"), request.queue);
  session.say(text);
  Json json = writtenJson(arguments.input, target.path, target.format.name, converted);
  json["operator"] = request.method;
  json["trianglesBefore"] = facesBefore;
  json["trianglesPercent"] = percent;
  json["diagonal"] = diagonal;
  if (request.maxTriangles) json["maxTriangles"] = *request.maxTriangles;
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
    for (const AttributeRms& of : outcome->fit->attributes) json["movedAttributes"].push_back(toJson(of));
  }
  for (const AttributeChange& change : outcome->attributeChanges)
    json["attributeChanges"].push_back(toJson(change));
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
  addMeshFilesTo(*command, arguments->input, arguments->output, arguments->existing);
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
          "--operator", arguments->request.method,
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
          "--queue", arguments->request.queue,
          "When costs are computed anew: lazy, where they would be the least (default); greedy, at once;\n"
          "estimate: their estimates, lazily")
      ->check(oneOf({"lazy", "greedy", "estimate"}))
      ->type_name("NAME");
  command
      ->add_option("--quadric-weight", arguments->request.quadricWeight,
                   "Of a quadric's planes: area (default) or none")
      ->check(oneOf({"area", "none"}))
      ->type_name("NAME");
  command
      ->add_option("--cluster-vertices", arguments->request.clusterVertices,
                   "Of a cluster: quadric, the least of it (default), or original, the best of its vertices")
      ->check(oneOf({"quadric", "original"}))
      ->type_name("NAME");
  command
      ->add_option(
          "--attribute-weight", arguments->request.attributeWeights,
          "What a change of an attribute counts beside a distance: uv:1,color:0.5. By 1, a change of 1\n"
          "counts as the diagonal; of colours, one of a whole channel. Default: uv:0.2 of each set (of "
          "measured\n"
          "0.4, with --max-triangles) and color:0.15; what is not in the list counts nothing")
      ->type_name("NAME:W,...");
  command->add_flag("--keep-borders", arguments->request.keepsBorders,
                    "Vertices on borders stay, to the bit");
  command->add_flag("--no-crossings", arguments->request.forbidsCrossings,
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
  arguments->normals.addTo(*command);
  addPlacingTo(*command, arguments->placing);
}

}  // namespace arete
