// SPDX-License-Identifier: GPL-3.0-or-later
//
// One request for each tolerance. The requests say which part of the file is read; each is then cut, fitted,
// measured and written by TinExtractor. A broken promise is reported after all files are written.
#include "cli/commands/extract.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/criterion.h"
#include "cli/arguments/drop_attributes.h"
#include "cli/arguments/extract_outputs.h"
#include "cli/arguments/level_files.h"
#include "cli/arguments/mesh_options.h"
#include "cli/arguments/normals_option.h"
#include "cli/arguments/option_kinds.h"
#include "cli/arguments/place_hint.h"
#include "cli/commands/check_command.h"
#include "cli/commands/extract_text.h"
#include "cli/surface/extract.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/bent/target.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/map_scale.h"
#include "io/geo/dem/raster_writer.h"
#include "io/query/extract/extract.h"
#include "io/query/extract/model_file.h"
#include "io/query/extract/part.h"
#include "io/query/extract/region_argument.h"
#include "io/query/extract/tin.h"
#include "io/query/parts/asked_places.h"
#include "io/query/request/wholes.h"
#include "terrain/model/plan_box.h"
#include "terrain/model/plan_region.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

/// --certificate has an optional value, and CLI11 takes the next word for it: FILE.amt, or the output, if
/// that comes last. With --output stated, a mesh that clashes with it is refused by checkOutputsOf().
CLI::Validator notTheModel(const CLI::App& command) {
  return CLI::Validator(
      [&command](std::string& text) -> std::string {
        const bool isModel = fs::path(text).extension() == ".amt";
        const bool isOutput =
            command.get_option("--output")->count() == 0 && (meshFormatOf(text, "") || isGeoTiffName(text));
        if (!isModel && !isOutput) return {};
        return fmt::format("'{}' cannot be the certificate; put {} before --certificate", text,
                           isModel ? "FILE.amt" : "the output");
      },
      "");
}

struct ExtractArguments {
  std::string model;
  MeshOutput output;
  CriterionArguments criterion;
  std::string certificate, errorRaster, map;
  std::string dropParts;
  std::vector<std::string> dropAttributes;
  std::string attributeErrors = {}, importance = {};
  NormalsArguments normals;
  bool areLevels = false, measuresBothWays = false, staysUndisplaced = false;
  PlaceTarget place;
  ExistingFile existing = ExistingFile::keepsOtherLayers;
  CLI::Option* certificateOption = nullptr;
  OptionKinds kinds;

  ExtractOutputs outputs(Session& session) const {
    ExtractOutputs outputs{.output = output.open(session),
                           .format = output.format,
                           .packedBits = output.packedBits(),
                           .flipsV = output.flipsV,
                           .areLevels = areLevels,
                           .errorRaster = errorRaster,
                           .map = map,
                           .place = place,
                           .existing = existing};
    outputs.isStdout = outputs.output != output.path;
    if (certificateOption->count() > 0) outputs.certificate = certificate;
    return outputs;
  }
};

/// What shares are of. A file in pages says it of itself.
Result<std::optional<Wholes>> wholesOf(const AmtFile& file, const Session& session) {
  if (file.summary().isThere())
    return std::optional(Wholes{file.summary().relief, file.summary().finestTriangles});
  ARETE_TRY(const TerrainModel whole, file.read({}, session.context()));
  return std::optional(wholesOf(whole));
}

Result<std::vector<ExtractRequest>> requestsOf(const ExtractArguments& arguments, const TerrainModel& model,
                                               const std::optional<Wholes>& wholes, Session& session) {
  ARETE_TRY(const auto criteria, arguments.criterion.criteria(model, wholes));
  if (!model.isRaster && criteria.front().criterion.fit == CutFit::unbiased)
    session.warn(
        {{WarningCode::bound,
          "the points are scattered: the mean error is over the points and not over the area, so that "
          "a volume gains or loses where they are uneven"}},
        arguments.model);
  const ExtractOutputs outputs = arguments.outputs(session);
  const bool several = criteria.size() > 1;
  ARETE_CHECK(outputs.check(several));
  std::vector<ExtractRequest> requests;
  for (const auto& [criterion, tag] : criteria) {
    requests.push_back(outputs.requestOf(criterion, tag, several));
    requests.back().normals = arguments.normals.ofTerrain();
  }
  for (const ExtractRequest& request : requests) {
    if (Status known = checkExtractOutput(request.output, model, request.format); !known)
      return failure(known.error().code, known.error().message, fmt::format("--output {}", request.output));
    ARETE_CHECK(checkExtractPlace(request));
    ARETE_CHECK(checkExtractNormals(request, model));
    if (arguments.criterion.hasDeadline() && request.format.empty() && isGeoTiffName(request.output))
      return failure(ErrorCode::usage, "cannot be a raster with --deadline; write a mesh",
                     fmt::format("--output {}", request.output));
    if (request.errorRaster.empty()) continue;
    if (!isGeoTiffName(request.errorRaster))
      return failure(ErrorCode::usage, "the error raster is a GeoTIFF: its name ends in .tif",
                     fmt::format("--error-raster {}", request.errorRaster));
    if (Status known = checkExtractOutput(request.errorRaster, model); !known)
      return failure(known.error().code, known.error().message,
                     fmt::format("--error-raster {}", request.errorRaster));
  }
  return requests;
}

Status checkOutputs(const std::vector<ExtractRequest>& requests, const ExtractArguments& arguments,
                    const TerrainModel& model) {
  std::vector<std::string> inputs = {arguments.model, model.source};
  if (fs::exists(arguments.criterion.region())) inputs.push_back(arguments.criterion.region());
  if (arguments.areLevels) return checkOutputsOf({requests.front()}, inputs);
  return checkOutputsOf(requests, inputs);
}

/// What a typed box that is not on the terrain looks like; empty: nothing else.
std::string regionHint(const RegionText& region, const TerrainModel& model) {
  const auto numbers = parseNumbers("--region", region.text);
  if (!region.crs.empty() || !numbers || numbers->size() != 4) return {};
  return degreesHint(Box2{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]}, model);
}

Result<std::optional<Region>> regionOf(const ExtractArguments& arguments, const TerrainModel& model,
                                       Session& session) {
  const std::string& text = arguments.criterion.region();
  if (text.empty()) return std::nullopt;
  ARETE_TRY(auto read, readRegionArgument(arguments.criterion.regionText(), model.georeference,
                                          LongitudeTurns(model), session.context()));
  session.warn(read.warnings, text);
  Region region = planRegion(std::move(read.shape), model);
  if (region.isEmpty() || !meetsDomain(region, model.mt))
    return failure(ErrorCode::usage,
                   fmt::format("does not meet the data of {}{}", arguments.model,
                               behindSemicolon(regionHint(arguments.criterion.regionText(), model))),
                   fmt::format("--region {}", text));
  return std::optional<Region>(std::move(region));
}

/// Warns where the format rounds heights by more than the promise allows.
void warnOfRounding(const ExtractedTin& tin, const std::string& output, const std::string& unit,
                    const Session& session) {
  const double rounding = tin.format.heightRounding;
  if (!tin.measured && rounding > 0 && tin.storedError + rounding > tin.promisedError)
    session.warn(fmt::format("{}: {} rounds heights by up to {}, which a promise of {} does not allow for",
                             output, tin.format.name, withUnit(rounding, unit),
                             withUnit(tin.promisedError, unit)));
}

std::string brokenPromise(const ExtractedTin& tin) {
  std::string sentence =
      fmt::format("the measurement of the exported TIN contradicts the promised error {}", tin.promisedError);
  if (tin.format.heightRounding > 0)
    sentence += fmt::format("; {} rounds heights by up to {}", tin.format.name, tin.format.heightRounding);
  return sentence;
}

/// Reads the root, and the terrain below a camera.
Result<TerrainModel> outlineForPlaces(const AmtFile& file, const CriterionArguments& criterion,
                                      const Session& session) {
  Result<TerrainModel> root = file.read({.wanted = requiredNowhere()}, session.context());
  if (!root) return root;
  ARETE_TRY(const auto place, criterion.placeAboveGround(*root));
  if (!place) return root;
  return file.read({.wanted = wantedAt({&*place, 1}, *root)}, session.context());
}

/// Warns where metres are asked for of a model that was built before the scale of its map was stored.
void warnOfMapMetres(const std::vector<ExtractRequest>& requests, const TerrainModel& outline,
                     const Session& session) {
  Georeference known = outline.georeference;
  const Box2 box = planBox(outline);
  if (known.mapScale) return;
  stateMapScale(known, outline.toSource({(box.xMin + box.xMax) / 2, (box.yMin + box.yMax) / 2}));
  const bool wantsMetres = std::ranges::any_of(requests, [](const ExtractRequest& request) {
    const Result<MeshFormat> format = meshFormatOf(request.output, request.format);
    return request.criterion.focus || request.criterion.camera || (format && format->holds.isYUp);
  });
  if (known.mapScale && wantsMetres)
    session.warn(fmt::format(
        "the model was built without the scale of its map, {:.3g} and {:.3g}: metres are those of "
        "the map, not of the ground; build it again",
        (*known.mapScale)[0], (*known.mapScale)[1]));
}

Status runSurfaceExtract(const ExtractArguments& arguments, const AmtContainer& file, Session& session) {
  return extractSurface({.model = arguments.model,
                         .outputs = arguments.outputs(session),
                         .asked = arguments.criterion.ofSurface(),
                         .dropParts = arguments.dropParts,
                         .dropAttributes = arguments.dropAttributes,
                         .normals = arguments.normals.options,
                         .measuresBothWays = arguments.measuresBothWays,
                         .attributeErrors = arguments.attributeErrors,
                         .importance = arguments.importance,
                         .staysUndisplaced = arguments.staysUndisplaced},
                        file, session);
}

Status runExtract(const ExtractArguments& arguments, Session& session) {
  ARETE_CHECK(arguments.criterion.check());
  ARETE_CHECK(arguments.output.checkPacking());
  ARETE_TRY(AmtContainer container, openModelFile(arguments.model));
  ARETE_CHECK(arguments.kinds.refuseOther(kindOf(container)));
  if (container.isOfSurface()) return runSurfaceExtract(arguments, container, session);
  ARETE_TRY(const AmtFile file, openAmt(std::move(container)));
  std::optional<Wholes> wholes;
  if (arguments.criterion.statesShares()) {
    ARETE_TRY(wholes, wholesOf(file, session));
  }
  ARETE_TRY(const TerrainModel outline, outlineForPlaces(file, arguments.criterion, session));
  ARETE_TRY(auto requests, requestsOf(arguments, outline, wholes, session));
  ARETE_CHECK(checkOutputs(requests, arguments, outline));
  warnOfMapMetres(requests, outline, session);
  if (const std::string hint = arguments.criterion.focusHint(outline); !hint.empty()) session.warn(hint);
  ARETE_TRY(const auto region, regionOf(arguments, outline, session));
  for (ExtractRequest& request : requests) request.region = region;
  ARETE_TRY(PartAndCut part, readForExtract(file, requests, outline, session.context()));

  const std::string& verticalUnit = outline.georeference.verticalUnit;
  TinExtractor extractor(
      std::move(part.model), arguments.model,
      [&file](const RunContext& context) { return file.read({}, context); },
      [&](const ExtractRequest& request, double promisedError) {
        return checkCommand(request, outline, arguments.model, promisedError);
      });
  Json exports = Json::array();
  Status promise;
  std::optional<LevelFiles> levels;
  if (arguments.areLevels) {
    ARETE_TRY(levels, LevelFiles::create());
  }
  for (const ExtractRequest& request : requests) {
    ARETE_TRY(ExtractedTin tin, extractor.extract(levels ? levels->redirected(request) : request,
                                                  session.context(), std::exchange(part.cut, std::nullopt)));
    // A glTF of terrain is in metres.
    const double metres = heightUnitOf(outline.georeference).metres;
    if (levels) levels->describe(tin.promisedError, tin.triangles, metres > 0 ? metres : 1);
    if (wholes) {
      tin.relief = wholes->length;
      tin.finestTriangles = wholes->triangles;
    }
    session.warn(tin.warnings, request.output);
    warnOfRounding(tin, request.output, verticalUnit, session);
    session.say(extractText(request, tin, verticalUnit));
    exports.push_back(toJson(request, ExtractReport(tin)));
    if (!tin.isKept && promise)
      promise = failure(ErrorCode::brokenPromise, brokenPromise(tin), request.output);
  }
  if (levels) ARETE_CHECK(levels->join(requests.front(), session));
  Json answer = {{"model", arguments.model}, {"verticalUnit", verticalUnit}};
  if (wholes) {
    answer["relief"] = wholes->length;
    answer["finestTriangles"] = wholes->triangles;
  }
  answer["exports"] = std::move(exports);
  session.answer(answer);
  return promise;
}

}  // namespace

void addExtractCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<ExtractArguments>();
  CLI::App* command = session.addCommand(
      app, "extract", "Extract TINs from a multitriangulation by tolerance, budget, region or view",
      "  arete extract dem.amt -o tin.ply --max-error 5\n"
      "  arete extract dem.amt -o tin.ply --max-error 1,5,20      tin_1.ply, tin_5.ply, tin_20.ply\n"
      "  arete extract dem.amt -o 'out/{}m.obj' --max-error 5     out/5m.obj\n"
      "  arete extract dem.amt -o tin.ply --max-error 5 --fit triangles\n"
      "  arete extract dem.amt -o tin.ply --max-error 5 --fit unbiased    the same triangles, mean error 0\n"
      "  arete extract dem.amt -o tin.ply --max-triangles 50000 --certificate\n"
      "  arete extract dem.amt -o tin.ply --max-error 0.5% --max-triangles 50000   whichever ends first\n"
      "  arete extract dem.amt -o tin.ply --max-error 1 --region park.gpkg --outside-error 20\n"
      "  arete extract dem.amt -o tin.ply --max-error 1 --region road.gpkg --distance 500\n"
      "  arete extract dem.amt -o tin.ply --camera 384000,3800000,50 --look 120,-10 --pixel-error 2\n"
      "  arete extract dem.amt -o - --format ply --max-error 5 | gzip > tin.ply.gz\n"
      "  arete extract scan.amt -o small.glb --max-error 0.5% --certificate\n"
      "  arete extract scan.amt -o tiny.glb --max-error 0.5% --packed --position-bits 14\n"
      "  arete extract scan.amt -o tiny.glb --max-error 0.1%,0.5%,2% --levels --packed\n"
      "  arete extract scan.amt -o small.ply --max-triangles 10%,2%       small_10%.ply, small_2%.ply\n"
      "  arete extract scan.amt -o small.ply --max-error 0.1% --focus 1,2,0.5 --error-growth 0.01\n"
      "  arete extract dem.amt -o tin.stl --max-error 5 --metric\n"
      "  arete extract dem.amt -o tin.obj --max-error 5 --to-crs utm\n"
      "  arete extract dem.amt -o smooth.tif --max-error 5 --error-raster error.tif",
      [arguments](Session& s) { return runExtract(*arguments, s); });
  command->add_option("FILE.amt", arguments->model, "Multitriangulation")->required()->type_name("");
  arguments->output.addTo(
      *command, "File to write",
      ", or .tif (the TIN sampled on the source grid). {} in the name becomes the tolerance; "
      "with several tolerances and no {}, _E is put before the extension",
      {".tif", ".tiff"});
  addOverwriteTo(*command, arguments->existing);
  command->add_flag(
      "--levels", arguments->areLevels,
      "Several tolerances or budgets become the levels of detail of one .glb or .gltf (MSFT_lod)");
  OptionKinds& kinds = arguments->kinds;
  kinds.ofSurfaces(arguments->output.flipOption);
  const PlaceOptions placed = addPlaceTo(*command, arguments->place);
  kinds.ofTerrain(placed.toCrs);
  kinds.ofTerrain(placed.metric);
  arguments->criterion.addTo(*command, kinds);
  arguments->certificateOption =
      command
          ->add_option("--certificate", arguments->certificate,
                       "Measure the mesh and write a certificate as JSON: promised error, measured error, "
                       "and how to check them (default: the output's name with .certificate.json)")
          ->expected(0, 1)
          ->check(notTheModel(*command))
          ->type_name("[FILE]");
  kinds.ofTerrain(command
                      ->add_option("--error-raster", arguments->errorRaster,
                                   "GeoTIFF to write on the source grid: TIN height minus DEM height")
                      ->type_name("FILE"));
  kinds.ofSurfaces(
      command
          ->add_option("--map", arguments->map,
                       "CSV to write, with the input vertex of each output vertex and the output\n"
                       "face of each input face, all from 0")
          ->type_name("FILE"));
  kinds.ofSurfaces(
      command
          ->add_option("--drop-parts", arguments->dropParts,
                       "Leave out the components whose box has a diagonal below D, in the file's unit "
                       "or in % of the whole diagonal")
          ->type_name("D"));
  kinds.ofSurfaces(addDropAttributesTo(*command, arguments->dropAttributes));
  kinds.ofSurfaces(
      command
          ->add_option("--attribute-error", arguments->attributeErrors,
                       "What attributes may be off by: uv:2px,normal:10,color:8 (build --attributes)")
          ->type_name("NAME:E,..."));
  kinds.ofSurfaces(command
                       ->add_option("--importance", arguments->importance,
                                    "Divide the tolerance by a number of the file's vertices: twice as "
                                    "important, half the error")
                       ->type_name("NAME"));
  arguments->normals.addTo(*command, ", of terrain by the finest triangles",
                           "; of terrain none are unless it is stated");
  kinds.ofSurfaces(command->add_flag("--both-ways", arguments->measuresBothWays,
                                     "Also measure how far the result is from the source"));
  kinds.ofSurfaces(command->add_flag(
      "--no-displacement", arguments->staysUndisplaced,
      "Vertices stay where they are in the source, though it was built with --displacement"));
}

}  // namespace arete
