// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/sources.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>
#include <variant>

#include "bench/figure.h"
#include "datasets/random.h"
#include "datasets/terrain_generator.h"
#include "io/geo/dem/dem_reader.h"
#include "io/geo/dem/raster_writer.h"
#include "io/store/amt/file.h"

namespace arete::bench {
namespace {

namespace fs = std::filesystem;

struct RealDem {
  const char* name;
  const char* file;
  std::vector<double> tolerances;
};

/// Mountains at two scales, mountains with voids, lidar of the ground and of roofs and trees.
const std::vector<RealDem>& knownDems() {
  static const std::vector<RealDem> known = {
      {"bigtujunga", "dem/srtm1_bigtujunga_utm11.tif", {1, 5, 20}},
      {"aconcagua", "dem/srtm3_S33W071_aconcagua.tif", {5, 20, 100}},
      {"bernese-alps", "dem/srtm3_N46E008_bernese_alps.tif", {5, 20, 100}},
      {"maungawhau", "dem/lidar2m_maungawhau_nztm.tif", {0.1, 0.5, 2}},
      {"edinburgh", "dem/lidar_dsm2.5m_edinburgh_bng.tif", {0.5, 2, 10}},
  };
  return known;
}

/// As many points as the raster has samples, at places of no order, to the centimetre.
Status writeScattered(const std::string& path, const RasterHeightfield& field) {
  std::ofstream file(path);
  fmt::print(file, "x,y,z\n");
  Random random(1);
  for (std::size_t i = 0; i < field.size(); ++i) {
    const double column = random.between(0, field.columns - 1), row = random.between(0, field.rows - 1);
    const auto c = static_cast<std::uint32_t>(column), r = static_cast<std::uint32_t>(row);
    const double u = column - c, w = row - r;
    const double above = field.at(c, r) + u * (field.at(c + 1, r) - field.at(c, r)),
                 below = field.at(c, r + 1) + u * (field.at(c + 1, r + 1) - field.at(c, r + 1));
    const Vec2 place = field.georeference.toSource(column, row);
    fmt::print(file, "{:.2f},{:.2f},{:.2f}\n", place.x, place.y, above + w * (below - above));
  }
  file.close();
  if (!file) return failure(ErrorCode::unreadable, "the points cannot be written", path);
  return {};
}

}  // namespace

/// A damaged file ends as an error with the message of the JSON library.
Result<std::vector<GreedyBaseline>> readBaselines(const std::string& path) {
  std::ifstream file(path);
  if (!file) return failure(ErrorCode::notFound, "the baselines cannot be opened", path);
  try {
    std::vector<GreedyBaseline> baselines;
    const Json json = Json::parse(file);
    for (const auto& dem : json.at("dems")) {
      for (const auto& point : dem.at("greedy"))
        baselines.push_back({dem.at("name").get<std::string>(), point.at("tolerance").get<double>(),
                             point.at("triangles").get<std::uint32_t>()});
    }
    return baselines;
  } catch (const Json::exception& error) {
    return failure(ErrorCode::corrupt, error.what(), path);
  }
}

// Without ARETE_DATA the data is looked for in a folder next to the sources.
std::string dataFolder() {
  if (const char* stated = std::getenv("ARETE_DATA")) return stated;
  const fs::path beside = fs::path(ARETE_SOURCE_FOLDER).parent_path() / "shared" / "data";
  std::error_code ignored;
  return fs::exists(beside, ignored) ? beside.string() : std::string();
}

// DEMs that are not here are passed over, so that the benchmarks run with whatever part of the data exists.
std::vector<DemSource> realDems(const std::string& folder) {
  std::vector<DemSource> sources;
  std::error_code ignored;
  for (const RealDem& dem : knownDems()) {
    const fs::path path = fs::path(folder) / dem.file;
    if (!folder.empty() && fs::exists(path, ignored))
      sources.push_back({dem.name, path.string(), dem.tolerances, 0});
  }
  return sources;
}

// A million samples is a square of 1024 by 1024 cells; one more sample in each direction closes the last
// cells. The side is in the name of the file, so that it is generated once and used again.
DemSource generatedDem(double millions, const std::string& scratch) {
  DemSource source;
  source.name = fmt::format("generated-{:g}M", millions);
  source.side = static_cast<std::uint32_t>(std::lround(1024 * std::sqrt(millions))) + 1;
  source.path = (fs::path(scratch) / fmt::format("generated-{}.tif", source.side)).string();
  source.tolerances = {1, 5, 20};
  return source;
}

DemSource withoutLake(const DemSource& source) {
  DemSource dry = source;
  if (source.side == 0 || !source.hasLake) return dry;
  dry.hasLake = false;
  dry.path = fs::path(source.path).replace_extension().string() + "-dry.tif";
  return dry;
}

// The points of the lake would be missing, so the terrain of scattered points is made without it.
DemSource scattered(const DemSource& source) {
  DemSource points = withoutLake(source);
  points.name = "points" + points.name.substr(points.name.find('-'));
  points.path = fs::path(points.path).replace_extension().string() + "-points.csv";
  points.isScattered = true;
  return points;
}

Status generateDem(const DemSource& source) {
  std::error_code ignored;
  if (source.side == 0 || fs::exists(source.path, ignored)) return {};
  TerrainOptions options;
  options.columns = options.rows = source.side;
  options.lake = source.hasLake;
  ARETE_TRY(const RasterHeightfield field, generateTerrain(options));
  if (source.isScattered) return writeScattered(source.path, field);
  return writeGeoTiff(source.path, field.columns, field.rows, field.heights, field.georeference);
}

Result<RasterHeightfield> readField(const DemSource& source) {
  ARETE_TRY(DemRead dem, readDem(source.path));
  if (!std::holds_alternative<RasterHeightfield>(dem.heightfield))
    return failure(ErrorCode::unsupported, "not a raster", source.path);
  return std::move(std::get<RasterHeightfield>(dem.heightfield));
}

// The benchmark has written the model itself, so the checksums are not verified.
Result<TerrainModel> loadModel(const std::string& path) {
  AmtLoadOptions trusted;
  trusted.verify = AmtVerify::none;
  return loadAmt(path, trusted);
}

}  // namespace arete::bench
