// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the DEM, chooses the vertices that stay, builds, writes. Each step is timed for the report.
#include "cli/commands/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "cli/arguments/arguments.h"
#include "cli/arguments/drop_attributes.h"
#include "cli/arguments/option_kinds.h"
#include "cli/commands/build_source.h"
#include "cli/surface/build.h"
#include "cli/surface/convert.h"
#include "engine/base/stopwatch.h"
#include "io/files/text/stated_size.h"
#include "io/files/text_scan.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/names.h"
#include "io/geo/dem/dem_reader.h"
#include "io/geo/table/plan_point_reader.h"
#include "io/query/source/build_terrain.h"
#include "io/query/surface/mesh_input.h"
#include "io/store/amt/file.h"
#include "terrain/builder/build.h"
#include "terrain/features/fixed_vertices.h"
#include "terrain/model/relief.h"

namespace arete {
namespace {

struct BuildArguments {
  DemArguments dem;
  std::string output;
  BuildOptions options;
  std::string shape = "delaunay";
  std::size_t featureCount = FeatureOptions{}.count;
  std::string featurePersistence;  // empty: not stated
  bool noFeatures = false;
  bool isPacked = false, isPaged = false;
  int positionBits = 0;
  std::string fixedPath;
  double creaseAngleDegrees = -1;  // < 0: not stated
  double minimumAspect = -1;       // < 0: not stated
  std::string kind;                // --as; empty: the file says
  bool keepsBorders = false, isDisplaced = false, boundsAttributes = false;
  const CLI::App* command = nullptr;
  std::vector<std::string> dropAttributes;
  OptionKinds kinds;
  ExpectedAmtSize expected;  // once the source is read
};

struct Seconds {
  double read = 0, features = 0, build = 0, write = 0;
};

Result<FixedVertexOptions> fixedOptions(const BuildArguments& arguments, std::span<const double> heights,
                                        const Georeference& georeference, Session& session) {
  FixedVertexOptions fixed;
  fixed.features->count = arguments.featureCount;
  if (!arguments.featurePersistence.empty()) {
    const DataUnit unit = heightUnitOf(georeference);
    ARETE_TRY(const auto stated,
              parseStatedSize(arguments.featurePersistence, "--feature-persistence", &unit));
    const std::optional<double> relief = stated.isShare ? std::optional(reliefOf(heights)) : std::nullopt;
    // A stated persistence replaces the number of features, which is then unlimited.
    fixed.features->count = std::numeric_limits<std::size_t>::max();
    fixed.features->minimumPersistence = stated.of(relief.value_or(0));
    if (relief)
      session.note(fmt::format(
          "features of at least {}",
          withReliefShare(fixed.features->minimumPersistence, georeference.verticalUnit, relief)));
  }
  if (arguments.noFeatures) fixed.features.reset();
  if (arguments.creaseAngleDegrees >= 0) fixed.creaseAngleDegrees = arguments.creaseAngleDegrees;
  if (!arguments.fixedPath.empty()) {
    ARETE_TRY(auto points,
              readPlanPoints(inputPath(arguments.fixedPath), georeference.crsWkt, session.context()));
    session.warn(points.warnings, arguments.fixedPath);
    fixed.given = std::move(points.positions);
  }
  return fixed;
}

void report(Session& session, const BuildArguments& arguments, const TerrainModel& model,
            const FixedVertices& fixed, const Seconds& seconds) {
  const MultiTriangulation& mt = model.mt;
  const std::uint64_t samples = std::uint64_t(mt.vertexCount()) + model.isolated.size();
  std::error_code error;
  // The report does not fail where the size of the file cannot be read.
  const auto size = std::filesystem::file_size(arguments.output, error);
  const std::uint64_t bytes = error ? 0 : size;
  const double count = static_cast<double>(samples), rate = count / seconds.build;
  const double bytesPerSample = static_cast<double>(bytes) / count;
  if (session.wantsAnswer())
    session.answer({{"file", arguments.output},
                    {"source", model.source},
                    {"sourceChecksum", model.sourceChecksum},
                    {"crs", crsName(model.georeference.crsWkt)},
                    {"samples", samples},
                    {"isolated", model.isolated.size()},
                    {"vertices", mt.vertexCount()},
                    {"triangles", mt.triangleCount()},
                    {"finestTriangles", mt.finestTriangleCount()},
                    {"rootTriangles", mt.rootTriangleCount()},
                    {"rootVertices", mt.rootVertexCount()},
                    {"levels", model.levels},
                    {"fixedVertices", fixed.vertices.size()},
                    {"features", fixed.features},
                    {"given", fixed.given},
                    {"creaseVertices", fixed.creases},
                    {"shape", toString(model.options.shape)},
                    {"seconds",
                     {{"read", seconds.read},
                      {"features", seconds.features},
                      {"build", seconds.build},
                      {"write", seconds.write}}},
                    {"samplesPerSecond", rate},
                    {"expectedBytes",
                     {{"plain", std::round(arguments.expected.plain)},
                      {"packed", std::round(arguments.expected.packed)}}},
                    {"bytes", bytes},
                    {"bytesPerSample", bytesPerSample}});
  session.say(fmt::format(
      "{}\n"
      "{}"
      "  samples    {}{}\n"
      "  triangles  {} at the finest, {} in the multitriangulation\n"
      "  root       {}, {} ({} fixed), {}\n"
      "  built in   {:.2f} s, {} samples/s (read {:.2f} s, features {:.2f} s, write {:.2f} s)\n"
      "  size       {}, {:.0f} bytes a sample\n",
      arguments.output,
      model.georeference.verticalUnit.empty()
          ? "  heights    no unit is stated: taken as metres where distances count (--vertical-unit)\n"
          : "",
      grouped(samples),
      model.isolated.empty() ? "" : fmt::format(", {} of them isolated", grouped(model.isolated.size())),
      grouped(mt.finestTriangleCount()), grouped(mt.triangleCount()),
      grouped(mt.rootTriangleCount(), "triangle", "triangles"),
      grouped(mt.rootVertexCount(), "vertex", "vertices"), grouped(fixed.vertices.size()),
      grouped(model.levels, "level", "levels"), seconds.build, grouped(static_cast<std::uint64_t>(rate)),
      seconds.read, seconds.features, seconds.write, byteCount(bytes), bytesPerSample));
}

/// The smallest aspect has a meaning only where the shape of holes follows the data.
Status takeShape(BuildArguments& arguments) {
  if (arguments.shape == "fidelity") arguments.options.shape = HoleShape::dataDependent;
  if (arguments.minimumAspect < 0) return {};
  if (arguments.options.shape != HoleShape::dataDependent)
    return failure(ErrorCode::usage, "requires --shape fidelity", "--min-aspect");
  arguments.options.minimumAspect = arguments.minimumAspect;
  return {};
}

/// Builds from a heightfield and writes the file.
///
/// @param finest for points: their finest triangulation.
template <class Heightfield, class... Finest>
Status buildFrom(BuildArguments& arguments, const FixedVertexOptions& fixedChoice, Session& session,
                 Seconds& seconds, const Heightfield& field, Finest... finest) {
  Stopwatch choosing;
  ARETE_TRY(FixedVertices fixed, chooseFixedVertices(field, finest..., fixedChoice, session.context()));
  if (!fixedChoice.given.empty() && fixed.givenOutside == fixedChoice.given.size())
    return failure(ErrorCode::invalidData,
                   fmt::format("none of {} lies on the DEM's data",
                               grouped(fixedChoice.given.size(), "point", "points")),
                   fmt::format("--fixed {}", arguments.fixedPath));
  if (fixed.givenOutside > 0)
    session.warn(
        fmt::format("--fixed {}: {} of {} {} outside the DEM's data and {} left out", arguments.fixedPath,
                    fixed.givenOutside, grouped(fixedChoice.given.size(), "point", "points"),
                    fixed.givenOutside == 1 ? "lies" : "lie", fixed.givenOutside == 1 ? "is" : "are"));
  arguments.options.fixedVertices = fixed.vertices;
  seconds.features = choosing.seconds();

  Stopwatch building;
  ARETE_TRY(TerrainModel model, build(field, std::move(finest)..., arguments.options, session.context()));
  seconds.build += building.seconds();
  model.reading = arguments.dem.reading;

  Stopwatch writing;
  const AmtWriteOptions options{.isPacked = arguments.isPacked, .isPaged = arguments.isPaged};
  ARETE_CHECK(writeAmt(arguments.output, model, session.context(), options));
  seconds.write = writing.seconds();
  report(session, arguments, model, fixed, seconds);
  return {};
}

Status runSurfaceBuild(const BuildArguments& arguments, MeshInput input, double secondsToRead,
                       Session& session) {
  ARETE_CHECK(arguments.kinds.refuseOther(ModelKind::surface,
                                          "--as terrain takes its vertices as samples of a terrain"));
  SurfaceBuildArguments surface{arguments.dem.path, arguments.output, {}};
  surface.options.build.keepsBorders = arguments.keepsBorders;
  surface.options.build.boundsAttributes = arguments.boundsAttributes;
  if (arguments.creaseAngleDegrees >= 0)
    surface.options.build.creaseAngleDegrees = arguments.creaseAngleDegrees;
  surface.isPacked = arguments.isPacked || arguments.isPaged;
  surface.isPaged = arguments.isPaged;
  surface.positionBits = arguments.positionBits;
  surface.options.isDisplaced = arguments.isDisplaced;
  surface.options.dropAttributes = arguments.dropAttributes;
  if (surface.positionBits != 0 && !surface.isPacked)
    return failure(ErrorCode::usage, "requires --packed or --paged", "--position-bits");
  SurfaceBuildOptions& build = surface.options.build;
  build.thresholdRatio = arguments.options.thresholdRatio.value_or(build.thresholdRatio);
  if (arguments.command->count("--max-degree") > 0) build.maxDegree = arguments.options.maxDegree;
  return buildSurfaceFile(surface, std::move(input), secondsToRead, session);
}

Status runBuild(BuildArguments& arguments, Session& session) {
  ARETE_CHECK(takeShape(arguments));
  const std::string extension = text::lowerExtension(arguments.output);
  if (extension != "amt" && arguments.output != "-")  // checkOutput() answers that
    return failure(
        ErrorCode::usage,
        extension.empty()
            ? fmt::format("must end in .amt, as {}.amt", arguments.output)
            : fmt::format("must end in .amt, not .{}; arete extract writes other formats", extension),
        fmt::format("--output {}", arguments.output));
  std::vector<std::string> inputs = arguments.dem.files();
  inputs.push_back(arguments.fixedPath);
  ARETE_CHECK(checkOutput("--output", arguments.output, inputs));
  const bool mayBeSurface = isMeshSource(arguments.dem.path, arguments.dem.reading) &&
                            (arguments.kind.empty() || arguments.kind == "surface");
  if (!mayBeSurface) ARETE_CHECK(arguments.kinds.refuseOther(ModelKind::terrain));
  Seconds seconds;
  Stopwatch reading;
  ARETE_TRY(Source source, readSource(arguments.dem, arguments.kind, session));
  if (auto* const mesh = std::get_if<MeshInput>(&source))
    return runSurfaceBuild(arguments, std::move(*mesh), reading.seconds(), session);
  ARETE_CHECK(arguments.kinds.refuseOther(ModelKind::terrain));
  const DemRead dem = std::get<DemRead>(std::move(source));
  seconds.read = reading.seconds();
  arguments.expected = announceSize(dem, arguments.output, arguments.isPacked || arguments.isPaged, session);
  ARETE_CHECK(checkBuildMemory(dem.heightfield, arguments.dem.path));
  return std::visit(
      [&](const auto& field) -> Status {
        ARETE_TRY(const auto fixedChoice,
                  fixedOptions(arguments, field.heights, field.georeference, session));
        if constexpr (std::is_same_v<decltype(field), const PointHeightfield&>) {
          ARETE_CHECK(checkBuild(field, arguments.options));
          Stopwatch triangulating;
          ARETE_TRY(FinestPoints finest, finestPoints(field, session.context()));
          seconds.build = triangulating.seconds();
          return buildFrom(arguments, fixedChoice, session, seconds, field, std::move(finest));
        } else {
          return buildFrom(arguments, fixedChoice, session, seconds, field);
        }
      },
      dem.heightfield);
}

}  // namespace

void addBuildCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<BuildArguments>();
  CLI::App* command =
      session.addCommand(app, "build", "Build a multitriangulation of a DEM or a mesh, once",
                         "  arete build dem.tif -o dem.amt\n"
                         "  arete build N46E008.hgt.zip -o alps.amt --shape fidelity\n"
                         "  arete build tiles/*.tif -o all.amt\n"
                         "  arete build scan.ply -o scan.amt                          a surface\n"
                         "  arete build points.csv -o points.amt --crs EPSG:32611 --fixed peaks.gpkg\n"
                         "  arete build dem.tif -o dem.amt --feature-persistence 100 --rim-tolerance 2",
                         [arguments](Session& s) { return runBuild(*arguments, s); });
  arguments->dem.addFilesTo(
      *command,
      "Raster, mesh or scattered points: any format that GDAL reads, also zipped, or text (CSV, XYZ); "
      "several\n"
      "rasters, a folder of them or a pattern become one DEM: later ones lie over earlier ones");
  command->add_option("-o,--output", arguments->output, "Multitriangulation to write (.amt)")
      ->required()
      ->type_name("FILE.amt");
  command
      ->add_option(
          "--as", arguments->kind,
          "What the files are (default: a raster is terrain, a mesh with faces is a surface, any other\n"
          "file holds points): terrain or points take the vertices of a mesh as samples of a terrain")
      ->check(oneOf({"terrain", "surface", "points"}))
      ->type_name("KIND");
  command->add_flag("--packed", arguments->isPacked,
                    "Write the compressed form: a ninth to a fifteenth of the size (of a surface a fifth);\n"
                    "it is unpacked when read");
  command->add_flag(
      "--paged", arguments->isPaged,
      "Write the compressed form in pages: a query reads those that it needs, from disk or from a\n"
      "server");
  // Options for terrain or for surfaces alone are declared as such; one check refuses them with the other
  // kind.
  OptionKinds& kinds = arguments->kinds;
  kinds.ofSurfaces(addPositionBitsTo(*command, arguments->positionBits));
  kinds.ofSurfaces(addDropAttributesTo(*command, arguments->dropAttributes));
  kinds.ofTerrain(
      command
          ->add_option(
              "--shape", arguments->shape,
              "delaunay (default), for well-shaped triangles, or fidelity, for far fewer at the same error")
          ->check(oneOf({"delaunay", "fidelity"}))
          ->type_name("NAME"));
  command
      ->add_option("--ratio", arguments->options.thresholdRatio,
                   "Growth of the error threshold from the first level to the second; it decreases as\n"
                   "fewer vertices are left (default 1.17; 1.13328 with --shape fidelity)")
      ->check(finiteAbove(1))
      ->type_name("R");
  command
      ->add_option("--max-degree", arguments->options.maxDegree,
                   "Largest number of neighbours of a vertex that is removed (default 14)")
      ->check(wholeNumber(6, 32))
      ->type_name("D");
  kinds.ofTerrain(command
                      ->add_option("--min-aspect", arguments->minimumAspect,
                                   "Smallest ratio of a triangle's altitude to its longest edge, with "
                                   "--shape fidelity (default 0.02)")
                      ->check(finiteAtLeast(0))
                      ->type_name("A"));
  kinds.ofTerrain(
      command
          ->add_option("--rim-tolerance", arguments->options.rimTolerance,
                       "Distance in samples by which rims of NODATA may be simplified (default 0: exact)")
          ->check(finiteAtLeast(0))
          ->type_name("SAMPLES"));
  const std::string keeping = "Vertices kept at every tolerance";
  // Features are chosen by number or by persistence, or not at all: these three exclude each other.
  CLI::Option* count =
      kinds.ofTerrain(command
                          ->add_option("--features", arguments->featureCount,
                                       "Number of the most persistent peaks, pits and passes (default 64)")
                          ->check(wholeNumber(0, 100'000'000))
                          ->type_name("N")
                          ->group(keeping));
  CLI::Option* persistence =
      kinds.ofTerrain(command
                          ->add_option("--feature-persistence", arguments->featurePersistence,
                                       "All peaks, pits and passes of at least this persistence, or "
                                       "P% of the relief")
                          ->check(shareOrTolerance(false))
                          ->type_name("P")
                          ->group(keeping));
  CLI::Option* none = kinds.ofTerrain(
      command->add_flag("--no-features", arguments->noFeatures, "No peaks, pits and passes")->group(keeping));
  count->excludes(persistence)->excludes(none);
  persistence->excludes(none);
  kinds.ofTerrain(command
                      ->add_option("--fixed", arguments->fixedPath,
                                   "Points (GeoPackage, CSV, ...): the sample nearest to each is kept")
                      ->type_name("FILE")
                      ->group(keeping));
  command
      ->add_option("--crease-angle", arguments->creaseAngleDegrees,
                   "Of terrain the vertices on creases sharper than this (classes corner and interior\n"
                   "edge), of a surface these creases as lines")
      ->check(finiteBetween(0, 180))
      ->type_name("DEGREES")
      ->group(keeping);
  kinds.ofSurfaces(command
                       ->add_flag("--keep-borders", arguments->keepsBorders,
                                  "All border vertices, so that parts meet at every tolerance")
                       ->group(keeping));
  kinds.ofSurfaces(
      command->add_flag("--displacement", arguments->isDisplaced,
                        "Also find where coarse cuts are drawn nearer to it, at the same errors\n"
                        "(8 bytes a vertex more, packed 4)"));
  kinds.ofSurfaces(
      command->add_flag("--attributes", arguments->boundsAttributes,
                        "Bound what attributes are off by, and let them count: colours, normals, texture\n"
                        "coordinates, numbers of vertices and corners (2 bytes a triangle and attribute)"));
  arguments->dem.addTo(*command);
  kinds.groupOfTerrain(*command, DemArguments::kGroup);
  arguments->command = command;
}

}  // namespace arete
