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
#include "engine/cut/error_curve.h"
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
  bool isPacked = false, isPaged = false;
  std::string writer;
  std::uint64_t vertices = 0, isolated = 0, triangles = 0, finestTriangles = 0, rootTriangles = 0,
                rootVertices = 0, fixedVertices = 0;
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

std::string gridText(const TerrainModel& model, std::uint64_t vertices) {
  if (!model.isRaster) return grouped(vertices, "scattered point", "scattered points");
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
  const BuildOptions& o = model.options;
  // Isolated samples are in no triangle and so no vertices, but the file holds them.
  const double bytesPerSample =
      static_cast<double>(facts.bytes) / static_cast<double>(facts.vertices + facts.isolated);
  std::string text = fmt::format(
      "{}: {}{}, written by {}\n", arguments.model, byteCount(facts.bytes),
      facts.isPacked
          ? fmt::format(", {} ({:.1f} bytes a sample)", facts.isPaged ? "in pages" : "packed", bytesPerSample)
          : "",
      facts.writer);
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<14} {}\n", what, value);
  };
  line("source", model.source);
  line("checksum", model.sourceChecksum);
  line("CRS", crsName(model.georeference.crsWkt));
  line("heights", heightText(model.georeference));
  line("relief", withUnit(facts.relief, model.georeference.verticalUnit));
  line("grid", gridText(model, facts.vertices));
  line("samples",
       fmt::format("{}{}", grouped(facts.vertices + facts.isolated),
                   facts.isolated == 0 ? "" : fmt::format(", {} of them isolated", grouped(facts.isolated))));
  line("triangles",
       fmt::format("{} at the finest, {} in all", grouped(facts.finestTriangles), grouped(facts.triangles)));
  line("root", fmt::format("{}, {} ({} fixed)", grouped(facts.rootTriangles, "triangle", "triangles"),
                           grouped(facts.rootVertices, "vertex", "vertices"), grouped(facts.fixedVertices)));
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
  if (arguments.at.empty()) row("0 (finest)", 0, facts.finestTriangles, facts.finestTriangles);
  for (std::size_t i = 0; i < facts.curve.size(); ++i)
    row(fmt::format("{:g}", facts.curve[i].maxError), facts.curve[i].maxError,
        facts.curve[i].minimalTriangles, facts.curve[i].saturatedTriangles,
        facts.means.empty()          ? ""
        : std::isnan(facts.means[i]) ? "             unknown"
                                     : fmt::format("  {:>18.3g}", facts.means[i]));
  if (arguments.at.empty())
    row(fmt::format("{:.4g} (root)", facts.rootError), facts.rootError, facts.rootTriangles,
        facts.rootTriangles);
  session.say(text);
}

Json factsJson(const InfoArguments& arguments, const TerrainModel& model, const Facts& facts) {
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
          {"isPaged", facts.isPaged},
          {"writer", facts.writer},
          {"source", {{"path", model.source}, {"checksum", model.sourceChecksum}}},
          {"crs", crsName(g.crsWkt)},
          {"crsWkt", g.crsWkt},
          {"verticalUnit", g.verticalUnit},
          {"verticalDatum", g.verticalDatum},
          {"relief", facts.relief},
          {"kind", model.isRaster ? "raster" : "points"},
          {"grid", std::move(grid)},
          {"samples", facts.vertices + facts.isolated},
          {"isolated", facts.isolated},
          {"vertices", facts.vertices},
          {"triangles", facts.triangles},
          {"finestTriangles", facts.finestTriangles},
          {"rootTriangles", facts.rootTriangles},
          {"rootVertices", facts.rootVertices},
          {"rootError", facts.rootError},
          {"fixedVertices", facts.fixedVertices},
          {"levels", model.levels},
          {"options",
           {{"shape", toString(model.options.shape)},
            {"ratio", model.options.thresholdRatioOrDefault()},
            {"maxDegree", model.options.maxDegree},
            {"minAspect", model.options.minimumAspect},
            {"rimTolerance", model.options.rimTolerance}}},
          {"curve", std::move(curve)}};
}

/// What a file in pages says of itself; of the curve as many of the largest tolerances as are wanted.
void takeSummary(const AmtSummary& summary, std::size_t curvePoints, Facts& facts) {
  facts.triangles = summary.triangles;
  facts.finestTriangles = summary.finestTriangles;
  facts.rootError = summary.rootError;
  facts.relief = summary.relief;
  const std::size_t count = std::min(curvePoints, summary.curve.size());
  for (std::size_t i = summary.curve.size() - count; i < summary.curve.size(); ++i) {
    const auto& [maxError, minimal, saturated] = summary.curve[i];
    facts.curve.push_back(
        {maxError, static_cast<std::uint32_t>(minimal), static_cast<std::uint32_t>(saturated)});
  }
}

Status computeFacts(const InfoArguments& arguments, const TerrainModel& model, Facts& facts,
                    Session& session) {
  facts.triangles = model.mt.triangleCount();
  facts.finestTriangles = model.mt.finestTriangleCount();
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
  if (arguments.at.empty()) return {};
  ARETE_TRY(auto means, meanErrors(model, tolerances, session.context()));
  facts.means = std::move(means);
  return {};
}

Status runInfo(const InfoArguments& arguments, Session& session) {
  if (isSceneFile(arguments.model)) {
    if (!arguments.at.empty()) return failure(ErrorCode::usage, "is for one model, not for a scene", "--at");
    return sayAboutScene(arguments.model, session);
  }
  ARETE_TRY(AmtContainer container, openModelFile(arguments.model));
  // Terrain in pages says of itself what any other model is read for.
  if (const bool isSummed = container.isPaged() && !container.isOfSurface();
      container.owner()->isFar() && !isSummed && arguments.at.empty() && arguments.curve->count() == 0)
    return sayOfDirectory(container, session);
  if (container.isOfSurface())
    return sayAboutSurface(container, arguments.at, arguments.curvePoints, session);
  ARETE_TRY(const AmtFile file, openAmt(std::move(container)));
  Facts facts;
  facts.bytes = file.bytes().size();
  facts.writer = file.writer();
  facts.isPacked = file.isPacked();
  facts.isPaged = file.isPaged();
  const AmtCounts& counts = file.counts();
  facts.vertices = counts.rootVertices + counts.nodes;
  facts.isolated = counts.isolated;
  facts.rootTriangles = counts.rootTriangles;
  facts.rootVertices = counts.rootVertices;
  facts.fixedVertices = counts.fixedVertices;
  // A file in pages says of itself what is asked here; of any other all nodes are read.
  const bool isSummed =
      file.summary().isThere() && arguments.at.empty() &&
      (arguments.curvePoints <= file.summary().curve.size() || file.summary().curve.size() < kSummarySteps);
  TerrainModel model = file.model();
  if (isSummed) {
    takeSummary(file.summary(), arguments.curvePoints, facts);
  } else {
    ARETE_TRY(model, file.read({}, session.context()));
    ARETE_CHECK(computeFacts(arguments, model, facts, session));
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
