// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/columns_json.h"
#include "cli/remote/directory_info.h"
#include "cli/scene/info.h"
#include "cli/surface/info.h"
#include "engine/base/counted.h"
#include "io/files/text/stated_size.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/names.h"
#include "io/query/extract/model_file.h"
#include "io/query/extract/tin.h"
#include "io/query/scene/scene_file.h"
#include "io/store/amt/file.h"
#include "terrain/measure/measure.h"
#include "terrain/model/error_curve.h"
#include "terrain/model/relief.h"

namespace arete {
namespace {

struct InfoArguments {
  std::string model;
  std::size_t curvePoints = 12;
  std::string at;
  const CLI::Option* curve = nullptr;
};

struct Facts {
  std::uint64_t bytes = 0;
  bool isPacked = false;
  std::string writer;
  double rootError = 0, relief = 0;
  std::vector<CurvePoint> curve;
  std::vector<double> means;  ///< with --at: of the minimal cut of each point, z_TIN - z_sample
};

/// The mean errors of the minimal cuts, measured: no file stores them.
Result<std::vector<double>> meanErrors(const TerrainModel& model, const std::vector<double>& tolerances,
                                       const RunContext& context) {
  std::vector<double> means;
  const auto meanOf = [&](const auto& samples) -> Status {
    for (const double maxError : tolerances) {
      ExtractedTin unused;
      ARETE_TRY(const TinExport tin,
                takeTin(model, {.maxError = maxError}, std::nullopt, 0, std::nullopt, unused, context));
      const Result<MeasureReport> report = measure(tin.mesh, samples, {}, context);
      if (!report && report.error().code == ErrorCode::interrupted) return tl::unexpected(report.error());
      // A file may hold what cannot be measured; the rest of the answer does not depend on it.
      means.push_back(report ? report->meanError : std::numeric_limits<double>::quiet_NaN());
    }
    return {};
  };
  ARETE_CHECK(model.isRaster ? meanOf(model.rasterSamples()) : meanOf(model.pointSamples()));
  return means;
}

/// The error of the coarsest triangulation, with which the curve ends.
double largestRootError(const MultiTriangulation& mt) {
  double largest = 0;
  for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t)
    largest = std::max(largest, mt.error(TriangleId(t)));
  return largest;
}

std::string gridText(const TerrainModel& model) {
  if (!model.isRaster) return grouped(model.mt.vertexCount(), "scattered point", "scattered points");
  const auto& g = model.georeference.geoTransform;
  std::string text =
      fmt::format("{} x {}", counted(model.columns, "column", "columns"), counted(model.rows, "row", "rows"));
  if (!model.georeference.hasGeoTransform) return text + ", not placed";
  // A step along a row or a column is a vector, so rotated grids have pixel sizes as well.
  const bool rotated = g[2] != 0 || g[4] != 0;
  return text + fmt::format(", pixel {:.9g} x {:.9g}{}, corner {:.9g}, {:.9g}", std::hypot(g[1], g[4]),
                            std::hypot(g[2], g[5]), rotated ? " (rotated)" : "", g[0], g[3]);
}

std::string heightText(const Georeference& georeference) {
  const std::string unit = georeference.verticalUnit.empty() ? "not stated" : georeference.verticalUnit;
  return georeference.verticalDatum.empty() ? unit : fmt::format("{}, {}", unit, georeference.verticalDatum);
}

void sayFacts(const InfoArguments& arguments, const TerrainModel& model, const Facts& facts,
              const Session& session) {
  const MultiTriangulation& mt = model.mt;
  const BuildOptions& o = model.options;
  // Isolated samples are in no triangle and so no vertices, but the file holds them.
  const double bytesPerSample = static_cast<double>(facts.bytes) /
                                static_cast<double>(std::uint64_t{mt.vertexCount()} + model.isolated.size());
  std::string text = fmt::format(
      "{}: {}{}, written by {}\n", arguments.model, byteCount(facts.bytes),
      facts.isPacked ? fmt::format(", packed ({:.1f} bytes a sample)", bytesPerSample) : "", facts.writer);
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<14} {}\n", what, value);
  };
  line("source", model.source);
  line("checksum", model.sourceChecksum);
  line("CRS", crsName(model.georeference.crsWkt));
  line("heights", heightText(model.georeference));
  line("relief", withUnit(facts.relief, model.georeference.verticalUnit));
  line("grid", gridText(model));
  line("samples", fmt::format("{}{}", grouped(mt.vertexCount() + model.isolated.size()),
                              model.isolated.empty()
                                  ? ""
                                  : fmt::format(", {} of them isolated", grouped(model.isolated.size()))));
  line("triangles", fmt::format("{} at the finest, {} in all", grouped(mt.finestTriangleCount()),
                                grouped(mt.triangleCount())));
  line("root",
       fmt::format("{}, {} ({} fixed)", grouped(mt.rootTriangleCount(), "triangle", "triangles"),
                   grouped(mt.rootVertexCount(), "vertex", "vertices"), grouped(o.fixedVertices.size())));
  line("levels", std::to_string(model.levels));
  line(
      "built with",
      fmt::format("--shape {} --ratio {} --max-degree {}{}{}", toString(o.shape), o.thresholdRatioOrDefault(),
                  o.maxDegree,
                  o.shape == HoleShape::dataDependent ? fmt::format(" --min-aspect {}", o.minimumAspect) : "",
                  o.rimTolerance > 0 ? fmt::format(" --rim-tolerance {}", o.rimTolerance) : ""));
  const std::string& unit = model.georeference.verticalUnit;
  text += fmt::format("\n  {:>12}  {:>9}  {:>13}  {:>13}{}\n",
                      unit.empty() ? std::string("error") : fmt::format("error ({})", unit), "relief",
                      "minimal", "saturated", facts.means.empty() ? "" : "  mean TIN minus DEM");
  const auto row = [&](const std::string& error, double value, std::uint64_t minimal, std::uint64_t saturated,
                       const std::string& mean = "") {
    const std::string share =
        facts.relief > 0 ? fmt::format("{:.3g} %", 100 * value / facts.relief) : std::string();
    text += fmt::format("  {:>12}  {:>9}  {:>13}  {:>13}{}\n", error, share, grouped(minimal),
                        grouped(saturated), mean);
  };
  // Stated errors are answered alone; otherwise the finest and the root triangulation frame the curve.
  if (arguments.at.empty()) row("0 (finest)", 0, mt.finestTriangleCount(), mt.finestTriangleCount());
  for (std::size_t i = 0; i < facts.curve.size(); ++i)
    row(fmt::format("{:g}", facts.curve[i].maxError), facts.curve[i].maxError,
        facts.curve[i].minimalTriangles, facts.curve[i].saturatedTriangles,
        facts.means.empty()          ? ""
        : std::isnan(facts.means[i]) ? "             unknown"
                                     : fmt::format("  {:>18.3g}", facts.means[i]));
  if (arguments.at.empty())
    row(fmt::format("{:.4g} (root)", facts.rootError), facts.rootError, mt.rootTriangleCount(),
        mt.rootTriangleCount());
  session.say(text);
}

Json factsJson(const InfoArguments& arguments, const TerrainModel& model, const Facts& facts) {
  const MultiTriangulation& mt = model.mt;
  const Georeference& g = model.georeference;
  Json grid = nullptr;
  if (model.isRaster)
    grid = {{"columns", model.columns},
            {"rows", model.rows},
            {"geoTransform", g.hasGeoTransform ? Json(g.geoTransform) : Json()}};
  // JSON has no infinity, so an error without a number is null.
  Json curve = Json::array();
  for (const CurvePoint& point : facts.curve)
    curve.push_back({{"maxError", std::isfinite(point.maxError) ? Json(point.maxError) : Json()},
                     {"maxErrorPercent", std::isfinite(point.maxError) && facts.relief > 0
                                             ? Json(100 * point.maxError / facts.relief)
                                             : Json()},
                     {"minimal", point.minimalTriangles},
                     {"saturated", point.saturatedTriangles}});
  for (std::size_t i = 0; i < facts.means.size(); ++i)
    curve[i]["minimalMeanError"] = std::isnan(facts.means[i]) ? Json() : Json(facts.means[i]);
  return {{"file", arguments.model},
          {"bytes", facts.bytes},
          {"isPacked", facts.isPacked},
          {"writer", facts.writer},
          {"source", {{"path", model.source}, {"checksum", model.sourceChecksum}}},
          {"crs", crsName(g.crsWkt)},
          {"crsWkt", g.crsWkt},
          {"verticalUnit", g.verticalUnit},
          {"verticalDatum", g.verticalDatum},
          {"relief", facts.relief},
          {"kind", model.isRaster ? "raster" : "points"},
          {"grid", std::move(grid)},
          {"samples", mt.vertexCount() + model.isolated.size()},
          {"isolated", model.isolated.size()},
          {"vertices", mt.vertexCount()},
          {"triangles", mt.triangleCount()},
          {"finestTriangles", mt.finestTriangleCount()},
          {"rootTriangles", mt.rootTriangleCount()},
          {"rootVertices", mt.rootVertexCount()},
          {"rootError", facts.rootError},
          {"fixedVertices", model.options.fixedVertices.size()},
          {"levels", model.levels},
          {"options",
           {{"shape", toString(model.options.shape)},
            {"ratio", model.options.thresholdRatioOrDefault()},
            {"maxDegree", model.options.maxDegree},
            {"minAspect", model.options.minimumAspect},
            {"rimTolerance", model.options.rimTolerance}}},
          {"curve", std::move(curve)}};
}

Status runInfo(const InfoArguments& arguments, Session& session) {
  if (isSceneFile(arguments.model)) {
    if (!arguments.at.empty()) return failure(ErrorCode::usage, "is for one model, not for a scene", "--at");
    return sayAboutScene(arguments.model, session);
  }
  ARETE_TRY(AmtContainer container, openModelFile(arguments.model));
  if (container.owner()->isFar() && arguments.at.empty() && arguments.curve->count() == 0)
    return sayOfDirectory(container, session);
  if (container.isOfSurface())
    return sayAboutSurface(container, arguments.at, arguments.curvePoints, session);
  ARETE_TRY(const AmtFile file, openAmt(std::move(container)));
  ARETE_TRY(const TerrainModel model, file.read({}, session.context()));
  Facts facts;
  facts.bytes = file.bytes().size();
  facts.writer = file.writer();
  facts.isPacked = file.isPacked();
  facts.rootError = largestRootError(model.mt);
  facts.relief = reliefOf(model);
  // Stated shares are of the relief, which only the model knows.
  std::vector<double> tolerances = toleranceLadder(model.mt, arguments.curvePoints);
  if (!arguments.at.empty()) {
    const DataUnit unit = heightUnitOf(model.georeference);
    ARETE_TRY(const auto stated, parseStatedSizes(arguments.at, "--at", &unit));
    tolerances.clear();
    for (const StatedSize& size : stated) tolerances.push_back(size.of(facts.relief));
  }
  ARETE_TRY(auto curve, errorCurve(model.mt, tolerances, session.context()));
  facts.curve = std::move(curve);
  if (!arguments.at.empty()) {
    ARETE_TRY(auto means, meanErrors(model, tolerances, session.context()));
    facts.means = std::move(means);
  }
  sayFacts(arguments, model, facts, session);
  Json answer = factsJson(arguments, model, facts);
  ARETE_TRY(answer["columns"], columnsJson(file.container()));
  session.answer(answer);
  return {};
}

}  // namespace

void addInfoCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command = session.addCommand(
      app, "info", "Describe a multitriangulation, and its curve of triangles against error",
      "  arete info dem.amt\n"
      "  arete info dem.amt --at 1,5,20\n"
      "  arete info dem.amt --json | jq '.curve'",
      [arguments](Session& s) { return runInfo(*arguments, s); });
  command->add_option("FILE.amt", arguments->model, "Multitriangulation, or a scene.json")
      ->required()
      ->type_name("");
  CLI::Option* points = command
                            ->add_option("--curve", arguments->curvePoints,
                                         "Number of steps 1, 2, 5, 10 ... of the curve, from the coarsest "
                                         "(default 12; of a surface at most "
                                         "12, in % of its diagonal)")
                            ->check(wholeNumber(0, 1000))
                            ->type_name("N");
  arguments->curve = points;
  command
      ->add_option(
          "--at", arguments->at,
          "Errors at which the curve is computed, of terrain with the mean error of the minimal cut; E% is "
          "a share of the relief, or of a surface's diagonal")
      ->check(tolerances())
      ->type_name("E[,E...]")
      ->excludes(points);
}

}  // namespace arete
