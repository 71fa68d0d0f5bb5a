// SPDX-License-Identifier: GPL-3.0-or-later
// arete-datasets: terrain to try Arete on, generated here or fetched from those who publish it.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "datasets/asteroid.h"
#include "datasets/catalogue.h"
#include "datasets/fetch.h"
#include "datasets/terrain_generator.h"
#include "engine/base/counted.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/dem/raster_writer.h"

namespace arete {
namespace {

std::atomic<bool> gInterrupted = false;

/// Progress on a terminal only: 0...10...20, a stage at a time.
RunContext contextOf(bool quiet) {
  RunContext context;
  context.cancel = &gInterrupted;
  if (quiet || isatty(STDERR_FILENO) == 0) return context;
  context.progress = [stage = std::string(), ticks = -1](std::string_view name, double fraction) mutable {
    if (stage != name) {
      if (ticks >= 0 && ticks < 40) std::fputc('\n', stderr);
      stage = name;
      ticks = -1;
      fmt::print(stderr, "{} ", stage);
    }
    for (const int now = static_cast<int>(fraction * 40); ticks < now;) {
      ++ticks;
      if (ticks % 4 == 0)
        fmt::print(stderr, "{}", ticks * 5 / 2);
      else
        std::fputc('.', stderr);
      if (ticks == 40) std::fputs(" - done.\n", stderr);
    }
    std::fflush(stderr);
  };
  return context;
}

int exitCodeOf(const Error& error) {
  fmt::print(stderr, "arete-datasets: {}\n", error.describe());
  switch (error.code) {  // as `arete` has them
    case ErrorCode::usage:
      return 2;
    case ErrorCode::notFound:
    case ErrorCode::unreadable:
    case ErrorCode::unsupported:
      return 3;
    case ErrorCode::interrupted:
      return 130;
    default:
      return 4;
  }
}

// The checksum of the heights is printed, so that two machines can compare what one seed has made.
int generate(const TerrainOptions& options, const std::string& output, bool quiet) {
  const RunContext context = contextOf(quiet);
  const Result<RasterHeightfield> field = generateTerrain(options, context);
  if (!field) return exitCodeOf(field.error());
  GeoTiffOptions tiff;
  tiff.description = field->source;
  const Status written =
      writeGeoTiff(output, field->columns, field->rows, field->heights, field->georeference, tiff, context);
  if (!written) return exitCodeOf(written.error());
  fmt::print("{}: {} x {} samples of {} m, seed {}, heights {}\n", output, field->columns, field->rows,
             options.pixelMetres, options.seed, field->sourceChecksum);
  return 0;
}

int generateSurface(const AsteroidOptions& options, const std::string& output, bool quiet) {
  const TriangleMesh mesh = generateAsteroid(options);
  MeshWriteOptions write;
  write.up = MeshUp::z;
  const Result<MeshWriteReport> written = writeMesh(mesh, output, write, contextOf(quiet));
  if (!written) return exitCodeOf(written.error());
  fmt::print("{}: {} vertices, {} faces, seed {}\n", output, mesh.positions.size(), mesh.triangles.size(),
             options.seed);
  return 0;
}

// A collection of tiles has no size of its own, so its entry states the size of one square degree.
int list(bool asJson) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const PublicDem& dem : publicDems()) {
    nlohmann::ordered_json entry = {
        {"name", dem.name}, {"summary", dem.summary}, {"licence", dem.licence},          {"page", dem.page},
        {"url", dem.url},   {"tiled", dem.isTiled()}, {"pixelDegrees", dem.pixelDegrees}};
    if (dem.scene) {
      entry["bbox"] = {dem.scene->xMin, dem.scene->yMin, dem.scene->xMax, dem.scene->yMax};
      entry["sampleBytes"] = sampleBytes(dem, *dem.scene);
    }
    all.push_back(std::move(entry));
    if (asJson) continue;
    const Box2 degree = {0, 0, 1, 1};
    const double megabytes = sampleBytes(dem, dem.scene.value_or(degree)) / 1e6;
    fmt::print("{:<20} {}\n{:20} {:.0f} MB{}; licence: {}\n", dem.name, dem.summary, "", megabytes,
               dem.scene ? "" : " a square degree (needs --bbox)", dem.licence);
  }
  if (asJson) fmt::print("{}\n", all.dump(2));
  return 0;
}

int fetch(const std::string& name, const std::vector<double>& box, const std::string& mirror,
          const std::string& output, bool quiet) {
  const Result<PublicDem> dem = findPublicDem(name);
  if (!dem) return exitCodeOf(dem.error());
  if (box.empty() && !dem->scene)
    return exitCodeOf(
        {ErrorCode::usage, "this is a whole collection: say which part of it with --bbox", name});
  const Box2 degrees = box.empty() ? *dem->scene : Box2{box[0], box[1], box[2], box[3]};
  Warnings warnings;
  const Status fetched = fetchPublicDem(*dem, degrees, mirror, output, warnings, contextOf(quiet));
  for (const std::string& warning : warnings) fmt::print(stderr, "arete-datasets: warning: {}\n", warning);
  if (!fetched) return exitCodeOf(fetched.error());
  fmt::print("{}: {}\nLicence: {}\n", output, dem->summary, dem->licence);
  return 0;
}

// The command line has four subcommands, of which exactly one is wanted. Values go directly into the options
// that the functions above take.
int run(int argc, char** argv) {
  CLI::App app{
      "Terrain and a surface to try Arete on: generated here, or fetched from those who publish it."};
  app.name("arete-datasets");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 2 the command line makes no sense, 3 a file or the network fails, 4 the data is "
      "invalid,\n"
      "130 interrupted.\n"
      "Examples:\n"
      "  arete-datasets generate -o dem.tif\n"
      "  arete-datasets generate -o big.tif --size 4097 --seed 7\n"
      "  arete-datasets asteroid -o rock.ply\n"
      "  arete-datasets list\n"
      "  arete-datasets fetch matterhorn -o matterhorn.tif\n"
      "  arete-datasets fetch copernicus-glo30 --bbox 6.8,45.8,7.0,45.9 -o mont-blanc.tif");

  std::string output;
  bool quiet = false;
  TerrainOptions terrain;
  std::uint32_t size = 0;
  bool noLake = false, noSea = false;
  CLI::App* generateCommand = app.add_subcommand("generate", "Make mountains that rivers have carved");
  generateCommand->add_option("-o,--output", output, "GeoTIFF to write")->required();
  CLI::Option* sizeOption = generateCommand->add_option("--size", size, "Columns and rows (default 1025)")
                                ->check(CLI::Range(2, 1 << 20));
  generateCommand->add_option("--columns", terrain.columns, "Columns")->excludes(sizeOption);
  generateCommand->add_option("--rows", terrain.rows, "Rows")->excludes(sizeOption);
  generateCommand->add_option("--seed", terrain.seed, "Which terrain (default 1)");
  generateCommand->add_option("--pixel-metres", terrain.pixelMetres, "Size of a pixel (default 30)");
  generateCommand->add_flag("--no-lake", noLake, "Without the lake of NODATA");
  generateCommand->add_flag("--no-sea", noSea, "Without a coast");
  generateCommand->add_flag("-q,--quiet", quiet, "No progress");

  // The mesh's format follows from the name of the file; writeMesh() refuses those that it does not know.
  AsteroidOptions asteroid;
  CLI::App* asteroidCommand = app.add_subcommand("asteroid", "Make a rock with craters, a closed surface");
  asteroidCommand->add_option("-o,--output", output, "Mesh to write (.ply, .obj, .stl, .glb)")->required();
  asteroidCommand->add_option("--vertices", asteroid.vertices, "About so many (default 150000)")
      ->check(CLI::Range(8, 50'000'000));
  asteroidCommand->add_option("--seed", asteroid.seed, "Which rock (default 1)");
  asteroidCommand->add_flag("-q,--quiet", quiet, "No progress");

  bool asJson = false;
  CLI::App* listCommand = app.add_subcommand("list", "Public DEMs that fetch knows");
  listCommand->add_flag("--json", asJson, "As JSON");

  std::string name, mirror;
  std::vector<double> box;
  CLI::App* fetchCommand = app.add_subcommand("fetch", "Cut a box out of a public DEM");
  fetchCommand->add_option("name", name, "Its name in the list")->required();
  fetchCommand->add_option("-o,--output", output, "GeoTIFF to write")->required();
  fetchCommand->add_option("--bbox", box, "west,south,east,north in degrees")->delimiter(',')->expected(4);
  fetchCommand->add_option("--mirror", mirror, "A folder or URL that holds the publisher's paths");
  fetchCommand->add_flag("-q,--quiet", quiet, "No progress");

  // Help ends here too, with exit code 0; whatever else the parser refuses is a wrong command line. The name
  // of a GeoTIFF is checked before anything is computed or fetched.
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (sizeOption->count() > 0) terrain.columns = terrain.rows = size;
  if ((generateCommand->parsed() || fetchCommand->parsed()) && !isGeoTiffName(output)) {
    fmt::print(stderr, "arete-datasets: --output {}: a GeoTIFF's name ends in .tif\n", output);
    return 2;
  }
  terrain.lake = !noLake;
  terrain.sea = !noSea;
  if (generateCommand->parsed()) return generate(terrain, output, quiet);
  if (asteroidCommand->parsed()) return generateSurface(asteroid, output, quiet);
  if (listCommand->parsed()) return list(asJson);
  return fetch(name, box, mirror, output, quiet);
}

}  // namespace
}  // namespace arete

int main(int argc, char** argv) {
  std::signal(SIGINT, [](int) { arete::gInterrupted = true; });
  std::signal(SIGTERM, [](int) { arete::gInterrupted = true; });
  return arete::run(argc, argv);
}
