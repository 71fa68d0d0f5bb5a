// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kind of the second file decides: a DEM is compared sample by sample, a mesh by distances in space.
#include "cli/commands/measure.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "cli/arguments/arguments.h"
#include "cli/arguments/option_kinds.h"
#include "cli/commands/measure_meshes.h"
#include "cli/commands/measure_report_text.h"
#include "io/files/text/address_text.h"
#include "io/files/text/stated_size.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/names.h"
#include "io/geo/dem/dem_reader.h"
#include "io/geo/dem/raster_writer.h"
#include "io/query/certificate/report_json.h"
#include "io/query/extract/model_file.h"
#include "io/query/extract/region_argument.h"
#include "io/query/placed/measure_placed.h"
#include "io/store/amt/file.h"
#include "terrain/measure/measure.h"
#include "terrain/model/plan_region.h"
#include "terrain/model/relief.h"

namespace arete {
namespace {

struct MeasureArguments {
  std::string tin;
  DemArguments dem;
  std::string expectText;
  std::string distanceWithUnit;  // as checkGroundUnits() takes it
  std::string region, regionCrs, errorRaster, tinCrs;
  double distance = 0;
  bool allowCoveredNodata = false, measuresBothWays = false;
  std::int64_t samples = 0, seed = -1;  // not stated
  std::string errorMesh, expectAttribute;
  bool wantsAttributes = false;
  OptionKinds kinds{"Against a DEM", "Against a mesh"};
};

/// Refuses options for a DEM that are given with a mesh, and the other way round.
Status checkKind(const MeasureArguments& arguments, bool isMesh) {
  const ModelKind kind = isMesh ? ModelKind::surface : ModelKind::terrain;
  std::optional<std::string> other = arguments.kinds.statedForOther(kind);
  if (!other && isMesh && !arguments.dem.reading.otherFiles.empty()) other = "more than one file";
  if (other)
    return failure(ErrorCode::usage,
                   isMesh ? fmt::format("requires a DEM, and {} is a mesh", arguments.dem.path)
                          : fmt::format("requires another mesh, and {} is a DEM", arguments.dem.path),
                   *other);
  return {};
}

/// The metres of the unit of a TIN's heights; 0 where it is not known.
double metresOf(const MeshFile& tin) {
  return spaceUnitOf(std::string(), tin.verticalUnit).metres;
}

void compareFrames(const MeshFile& tin, const Georeference& georeference, const Session& session) {
  if (tin.metresAbout && georeference.crsWkt.empty())
    session.warn(
        "the TIN is in metres about a place of a CRS, and the DEM has none: they are compared as if they "
        "were in one");
  if (!tin.metresAbout && !tin.verticalUnit.empty() && !georeference.verticalUnit.empty() &&
      metresOf(tin) != heightUnitOf(georeference).metres)
    session.warn(fmt::format("the TIN's heights are in '{}', the DEM's in '{}': they are {}",
                             tin.verticalUnit, georeference.verticalUnit,
                             metresOf(tin) > 0 && heightUnitOf(georeference).metres > 0
                                 ? "turned into that of the DEM"
                                 : "compared as they are, since one is not known"));
}

/// Turns heights in another unit than the DEM's into it, where both are known; compareFrames() says so.
void turnHeights(MeshFile& tin, const Georeference& georeference) {
  const double ofTin = metresOf(tin), ofDem = heightUnitOf(georeference).metres;
  if (tin.metresAbout || ofTin == 0 || ofDem == 0 || ofTin == ofDem) return;
  for (Vec3& p : tin.mesh.positions) p.z *= ofTin / ofDem;
}

template <class Heightfield>
Result<std::vector<std::uint8_t>> maskOf(const MeasureArguments& arguments, const Heightfield& field,
                                         Session& session) {
  if (arguments.region.empty()) return std::vector<std::uint8_t>();
  ARETE_TRY(auto read, readRegionArgument({arguments.region, arguments.distance, arguments.regionCrs},
                                          field.georeference, LongitudeTurns(field), session.context()));
  session.warn(read.warnings, arguments.region);
  std::vector<std::uint8_t> mask = samplesInside(planRegion(std::move(read.shape), field), field);
  bool any = false;
  for (std::size_t i = 0; i < mask.size() && !any; ++i) any = mask[i] != 0 && !std::isnan(field.heights[i]);
  if (!any)
    return failure(ErrorCode::usage, fmt::format("holds no sample of {}", arguments.dem.path),
                   fmt::format("--region {}", arguments.region));
  return mask;
}

Status writeErrors(const MeasureArguments& arguments, const RasterHeightfield& field,
                   const MeasureRasters& rasters, Session& session) {
  GeoTiffOptions options;
  options.description = "TIN height minus DEM height";
  return writeGeoTiff(arguments.errorRaster, field.columns, field.rows, rasters.errors, field.georeference,
                      options, session.context());
}

Status writeErrors(const MeasureArguments& arguments, const PointHeightfield&, const MeasureRasters&,
                   Session&) {
  return failure(ErrorCode::usage, "the DEM is a set of scattered points, which have no grid",
                 fmt::format("--error-raster {}", arguments.errorRaster));
}

template <class Heightfield>
Status compare(const MeasureArguments& arguments, const MeshFile& tin, const Heightfield& field,
               Session& session) {
  constexpr bool isRaster = std::is_same_v<Heightfield, RasterHeightfield>;
  const Georeference& georeference = field.georeference;
  if (!arguments.tinCrs.empty() && compareCrs(arguments.tinCrs, tin.crsWkt) == CrsAgreement::different)
    return failure(ErrorCode::usage,
                   fmt::format("contradicts {}, which is in {}", arguments.tin, crsName(tin.crsWkt)),
                   fmt::format("--tin-crs {}", arguments.tinCrs));
  compareFrames(tin, georeference, session);
  ARETE_CHECK(checkGroundUnits(georeference, {arguments.distanceWithUnit}));
  ARETE_TRY(const auto mask, maskOf(arguments, field, session));
  MeasureOptions options;
  options.mask = mask;
  options.planRounding = {tin.frame.rounding.x, tin.frame.rounding.y};
  MeasureRasters rasters;
  MeasureRasters* const into = arguments.errorRaster.empty() ? nullptr : &rasters;
  const TinPlace place{.crsWkt = tin.crsWkt.empty() ? arguments.tinCrs : tin.crsWkt,
                       .metresAbout = tin.metresAbout};
  const bool isApart = isElsewhere(place, georeference);
  ARETE_TRY(const MeasureReport report,
            isApart ? measureElsewhere(tin.mesh, place, field, options, session.context(), into)
                    : measure(tin.mesh, field, options, session.context(), into));
  if (!arguments.errorRaster.empty()) ARETE_CHECK(writeErrors(arguments, field, rasters, session));

  const bool expects = !arguments.expectText.empty();
  const double relief = expects ? reliefOf(field.heights) : 0;
  double expected = 0;
  if (expects) {
    const DataUnit unit = heightUnitOf(georeference);
    ARETE_TRY(const auto stated, parseStatedSize(arguments.expectText, "--expect", &unit));
    expected = stated.of(relief);
  }
  const Status promise =
      expects ? checkPromise(report, expected, {.allowCoveredNodata = arguments.allowCoveredNodata})
              : Status();
  const std::string where = !isApart ? ""
                            : place.metresAbout
                                ? ", in metres, where each sample is"
                                : fmt::format(", in {}, where each sample is", crsName(place.crsWkt));
  const bool coversNothing = report.covered == 0 && report.valid > 0;
  const Box2 tinBox = planBoxOf(tin.mesh, 1), demBox = planBoxOf(field);
  session.say(fmt::format("{} against {}{}{}\n{}", arguments.tin, nameWithoutQuery(arguments.dem.path),
                          arguments.region.empty() ? "" : fmt::format(" in {}", arguments.region), where,
                          coversNothing ? apartText(report, tinBox, demBox)
                                        : measureReportText(report, georeference.verticalUnit, isRaster)));
  if (expects && promise)
    session.say(fmt::format("kept: nowhere more than {}\n",
                            withReliefShare(expected, georeference.verticalUnit, relief)));
  Json json = {{"tin", {{"path", arguments.tin}, {"crs", crsName(tin.crsWkt)}}},
               {"dem",
                {{"path", arguments.dem.path},
                 {"checksum", field.sourceChecksum},
                 {"crs", crsName(georeference.crsWkt)},
                 {"verticalUnit", georeference.verticalUnit}}}};
  if (!arguments.region.empty()) json["region"] = arguments.region;
  json.update(toJson(report, isRaster));
  std::string apart;
  if (coversNothing) {
    for (const char* figure : {"maximum", "rms", "meanAbsolute", "mean"}) json["error"][figure] = nullptr;
    for (const auto& [name, box] : {std::pair{"tin", tinBox}, {"dem", demBox}})
      json[name]["extent"] = {box.xMin, box.yMin, box.xMax, box.yMax};
    apart =
        fmt::format("covers no sample of {}, so there is nothing to compare: the TIN has {}, the DEM {}{}",
                    nameWithoutQuery(arguments.dem.path), rangesText(tinBox), rangesText(demBox),
                    reasonOfApart(tinBox, planBoxOf(tin.mesh, 2), demBox));
  }
  if (expects) {
    json["expect"] = std::isfinite(expected) ? Json(expected) : Json();
    json["expectPercent"] = std::isfinite(expected) && relief > 0 ? Json(100 * expected / relief) : Json();
    json["relief"] = relief;
    json["kept"] = promise.has_value();
    if (!promise) json["broken"] = coversNothing ? apart : promise.error().message;
  }
  session.answer(json);
  if (coversNothing)
    return failure(promise ? ErrorCode::invalidData : promise.error().code, apart, arguments.tin);
  if (!promise) return failure(promise.error().code, promise.error().message, arguments.tin);
  return {};
}

/// A model of terrain cannot be the reference, since it is what is checked: the DEM that it was built from
/// is.
Error isModel(const std::string& path, AmtContainer container) {
  const Result<AmtFile> file = openAmt(std::move(container));
  const std::string source = file ? file->model().source : std::string();
  return {ErrorCode::usage,
          fmt::format("is a model; a TIN is measured against the DEM that it was built from{}",
                      source.empty() ? "" : ", " + source),
          path};
}

Status runMeasure(MeasureArguments arguments, Session& session) {
  if (!arguments.expectText.empty()) {
    // Whether it is a size is checked before the unit of the data is read.
    const DataUnit metre{1};
    ARETE_TRY([[maybe_unused]] const auto stated, parseStatedSize(arguments.expectText, "--expect", &metre));
  }
  Result<AmtContainer> model = openModelFile(arguments.dem.path);
  const bool isAgainstMesh = isMeshFile(arguments.dem.path) || (model && model->isOfSurface());
  ARETE_CHECK(checkKind(arguments, isAgainstMesh));
  if (isAgainstMesh) {
    MeasureMeshesArguments meshes;
    meshes.first = arguments.tin;
    meshes.second = arguments.dem.path;
    meshes.expect = arguments.expectText;
    meshes.measuresBothWays = arguments.measuresBothWays;
    meshes.samples = arguments.samples;
    if (arguments.seed >= 0) meshes.seed = arguments.seed;
    meshes.errorMesh = arguments.errorMesh;
    meshes.wantsAttributes = arguments.wantsAttributes;
    meshes.expectAttribute = arguments.expectAttribute;
    return measureMeshes(meshes, session);
  }
  if (!arguments.errorRaster.empty()) {
    if (!isGeoTiffName(arguments.errorRaster))
      return failure(ErrorCode::usage, "the error raster is a GeoTIFF: its name ends in .tif",
                     fmt::format("--error-raster {}", arguments.errorRaster));
    std::vector<std::string> inputs = arguments.dem.files();
    inputs.push_back(arguments.tin);
    ARETE_CHECK(checkOutput("--error-raster", arguments.errorRaster, inputs));
  }
  ARETE_TRY(MeshFile tin, readMesh(arguments.tin, session.context()));
  session.warn(tin.warnings, arguments.tin);
  Result<DemRead> read = arguments.dem.read(session);
  if (!read && read.error().code == ErrorCode::unsupported && model)
    return tl::unexpected(isModel(arguments.dem.path, std::move(*model)));
  ARETE_TRY(const DemRead dem, std::move(read));
  return std::visit(
      [&](const auto& field) {
        turnHeights(tin, field.georeference);
        return compare(arguments, tin, field, session);
      },
      dem.heightfield);
}

}  // namespace

void addMeasureCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<MeasureArguments>();
  CLI::App* command = session.addCommand(
      app, "measure", "Measure any TIN against any DEM, or any mesh against another",
      "  arete measure tin.ply dem.tif\n"
      "  arete measure tin.ply dem.tif --expect 5         exit code 5 when the promise is broken\n"
      "  arete measure tin.obj dem.tif --json --error-raster error.tif\n"
      "  arete measure tin.ply dem.tif --expect 1 --region park.gpkg\n"
      "  arete measure small.ply original.obj             distances in space: Hausdorff, mean, RMS, both "
      "ways\n"
      "  arete measure small.ply original.obj --error-mesh distances.ply\n"
      "  arete measure small.glb scan.obj --attributes --expect-attribute uv:2px,color:8,normal:10",
      [arguments](Session& s) { return runMeasure(*arguments, s); });
  OptionKinds& kinds = arguments->kinds;
  command->add_option("TIN", arguments->tin, "Triangle mesh: " + readableMeshExtensions())
      ->required()
      ->type_name("");
  arguments->dem.addFilesTo(*command,
                            "Reference: a DEM, or the files of one as build takes them, or another mesh");
  command
      ->add_option(
          "--expect", arguments->expectText,
          "Promise to check: every sample covered once, no NODATA covered, no error above this by more than "
          "4 ulp of the heights there; between meshes: no point of the second, the source, is farther from\n"
          "the first. E% is a share of the DEM's relief, or of the second mesh's diagonal")
      ->check(shareOrTolerance())
      ->type_name("E");
  kinds.ofTerrain(
      command
          ->add_option(
              "--tin-crs", arguments->tinCrs,
              "CRS of the TIN, where its file states none (an STL): the DEM's samples are led into it")
          ->type_name("CRS"));
  kinds.ofTerrain(command->add_flag("--allow-covered-nodata", arguments->allowCoveredNodata,
                                    "Accept covered NODATA (of a build with --rim-tolerance)"));
  CLI::Option* region = kinds.ofTerrain(
      command
          ->add_option(
              "--region", arguments->region,
              "Region whose samples are compared: polygons, with --distance lines and points too, or "
              "xmin,ymin,xmax,ymax in the DEM's CRS")
          ->type_name("FILE|BOX"));
  kinds.ofTerrain(
      command
          ->add_option(
              "--region-crs", arguments->regionCrs,
              "CRS of the region, where its file has none or a wrong one, or of the box (EPSG:4326, ...)")
          ->needs(region)
          ->type_name("CRS"));
  kinds.ofTerrain(
      command
          ->add_option(
              "--distance", arguments->distance,
              "Length along the ground, in metres or with a unit, by which the region is extended (without a "
              "CRS: the DEM's units)")
          ->transform(groundLength("--distance", arguments->distanceWithUnit))
          ->check(finiteAbove(0))
          ->needs(region)
          ->type_name("D"));
  kinds.ofTerrain(command
                      ->add_option("--error-raster", arguments->errorRaster,
                                   "GeoTIFF to write on the DEM's grid: TIN height minus DEM height")
                      ->type_name("FILE"));
  kinds.ofSurfaces(
      command->add_flag("--both-ways", arguments->measuresBothWays,
                        "--expect of the points of the first mesh too, not of the second's alone"));
  kinds.ofSurfaces(
      command
          ->add_option(
              "--samples", arguments->samples,
              "Number of samples on each mesh (default: 10 per triangle of the larger, at least 1 000 000)")
          ->check(wholeNumber(1, 100'000'000'000))
          ->type_name("N"));
  kinds.ofSurfaces(command->add_option("--seed", arguments->seed, "Seed of the samples (default 1)")
                       ->check(wholeNumber(0, std::numeric_limits<std::int64_t>::max()))
                       ->type_name("S"));
  kinds.ofSurfaces(
      command
          ->add_option("--error-mesh", arguments->errorMesh,
                       "PLY to write: the first mesh, each vertex with its distance as 'quality' and colour")
          ->type_name("FILE"));
  kinds.ofSurfaces(command->add_flag(
      "--attributes", arguments->wantsAttributes,
      "Compare attributes too: of points of the second mesh the least change among all points of the first\n"
      "within E (--expect, else the largest distance), on their side of a seam"));
  kinds.ofSurfaces(
      command
          ->add_option(
              "--expect-attribute", arguments->expectAttribute,
              "Promise to check of attributes: none changes by more. Colours in 255ths, normals in degrees,\n"
              "texture coordinates in their unit or in pixels: uv:2px,color:8,normal:10,material:0")
          ->type_name("LIST"));
  arguments->dem.addKindTo(*command);
  arguments->dem.addTo(*command);
  kinds.groupOfTerrain(*command, DemArguments::kGroup);
}

}  // namespace arete
