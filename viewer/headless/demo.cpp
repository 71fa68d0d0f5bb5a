// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps in the order of a user's work: build, compute the curve of triangles against tolerance, choose
// tolerances, extract the TINs, measure them, draw them. The default tolerances are the finest of the 1-2-5
// ladder that leave out most of the triangles and keep more than a few.
#include "viewer/headless/demo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <system_error>
#include <utility>
#include <variant>

#include "engine/base/stopwatch.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "io/files/shell_text.h"
#include "io/geo/crs/ellipsoid_earth.h"
#include "io/geo/dem/dem_reader.h"
#include "io/query/extract/tin.h"
#include "io/store/amt/file.h"
#include "terrain/builder/build.h"
#include "terrain/features/fixed_vertices.h"
#include "terrain/locate/ground_height.h"
#include "terrain/measure/measure.h"
#include "terrain/model/relief.h"
#include "terrain/sight/earth.h"
#include "terrain/viewshed/viewshed.h"
#include "viewer/camera/home_view.h"
#include "viewer/camera/round_flight.h"
#include "viewer/headless/headless.h"
#include "viewer/map/error_map.h"
#include "viewer/map/tin_picture.h"
#include "viewer/map/viewshed_map.h"
#include "viewer/picture/chart.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestPercent = 30;  // of the finest triangles, among the tolerances chosen
constexpr std::uint32_t kFewTriangles = 24;
constexpr std::size_t kCurvePoints = 15;
constexpr std::size_t kTinPictures = 3;

/// A TIN that has been written and measured, as long as the pictures need it.
struct Shown {
  double maxError = 0;
  TriangleMesh mesh;
  MeasureReport measured;
  std::vector<double> errors;  ///< TIN minus DEM, by sample
};

/// "5 m", or "5" where the unit is not known.
std::string withUnit(double value, const std::string& unit) {
  return numberText(value) + (unit.empty() ? "" : " " + unit);
}

/// What a person calls the unit.
std::string shortUnit(const std::string& unit) {
  return unit == "metre" || unit == "meter" ? "m" : unit == "foot" ? "ft" : unit;
}

Status interruptedIf(const RunContext& context) {
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the demo was interrupted");
  return {};
}

Result<std::vector<double>> checkedTolerances(std::vector<double> tolerances) {
  for (const double e : tolerances) {
    if (!(e >= 0) || !std::isfinite(e))
      return failure(ErrorCode::usage, fmt::format("{} is not a tolerance: it must be 0 or more", e),
                     "maxError");
  }
  std::sort(tolerances.begin(), tolerances.end());
  tolerances.erase(std::unique(tolerances.begin(), tolerances.end()), tolerances.end());
  return tolerances;
}

std::vector<double> chosenTolerances(const std::vector<CurvePoint>& curve, const MultiTriangulation& mt,
                                     std::size_t most) {
  std::vector<double> chosen;
  const double finest = mt.finestTriangleCount();
  for (const CurvePoint& p : curve) {
    const bool isCoarser = p.minimalTriangles * 100.0 <= kLargestPercent * finest;
    const bool isFiner = p.minimalTriangles >= mt.rootTriangleCount() + kFewTriangles;
    if (isCoarser && isFiner && chosen.size() < std::max<std::size_t>(most, 1)) chosen.push_back(p.maxError);
  }
  if (chosen.empty()) chosen.push_back(curve.empty() ? 1 : curve[curve.size() / 2].maxError);
  return chosen;
}

/// Everything one run carries along.
class Demo {
 public:
  Demo(const DemoOptions& options, const RunContext& context) : options_(options), context_(context) {}

  Result<DemoReport> run(const std::string& dem) {
    for (const auto step : {&Demo::read, &Demo::buildModel, &Demo::takeAll, &Demo::drawChart, &Demo::drawMap,
                            &Demo::drawTins, &Demo::drawViewshed, &Demo::drawView}) {
      ARETE_CHECK(interruptedIf(context_));
      report_.dem = dem;
      ARETE_CHECK((this->*step)());
    }
    report_.totalSeconds = all_.seconds();
    for (const DemoResult& r : report_.results) {
      if (!r.isKept)
        return failure(ErrorCode::brokenPromise,
                       fmt::format("the TIN within {} was measured to be off by {:.6g}, {} samples uncovered",
                                   r.maxError, r.measuredMax, r.uncovered),
                       dem);
    }
    return std::move(report_);
  }

 private:
  std::string path(const std::string& name) const { return (fs::path(options_.folder) / name).string(); }

  std::string written(const std::string& name) {
    report_.files.push_back(path(name));
    return report_.files.back();
  }

  Status read() {
    for (const std::vector<double>* stated : {&options_.maxErrors, &options_.reliefShares})
      ARETE_CHECK(checkedTolerances(*stated));
    ARETE_TRY(DemRead dem, readDem(report_.dem, options_.reading, context_));
    if (!std::holds_alternative<RasterHeightfield>(dem.heightfield))
      return failure(ErrorCode::unsupported,
                     "the demo draws maps of rasters and these are scattered points; build, extract and "
                     "measure take them",
                     report_.dem);
    field_ = std::move(std::get<RasterHeightfield>(dem.heightfield));
    report_.warnings = std::move(dem.warnings);
    report_.columns = field_.columns;
    report_.rows = field_.rows;
    report_.relief = reliefOf(field_.heights);
    report_.unit = shortUnit(field_.georeference.verticalUnit);
    std::error_code error;
    fs::create_directories(options_.folder, error);
    if (error)
      return failure(ErrorCode::unreadable, "the folder cannot be made: " + error.message(), options_.folder);
    return {};
  }

  Status buildModel() {
    BuildOptions build = options_.build;
    const Stopwatch watch;
    ARETE_TRY(const FixedVertices fixed, chooseFixedVertices(field_, {}, context_));
    build.fixedVertices.insert(build.fixedVertices.end(), fixed.vertices.begin(), fixed.vertices.end());
    std::sort(build.fixedVertices.begin(), build.fixedVertices.end());
    build.fixedVertices.erase(std::unique(build.fixedVertices.begin(), build.fixedVertices.end()),
                              build.fixedVertices.end());
    ARETE_TRY(TerrainModel built, arete::build(field_, build, context_));
    model_ = std::move(built);
    report_.buildSeconds = watch.seconds();
    report_.finestTriangles = model_.mt.finestTriangleCount();
    return writeAmt(written("dem.amt"), model_, context_);
  }

  Status takeAll() {
    const std::vector<double> ladder = toleranceLadder(model_.mt, kCurvePoints);
    ARETE_TRY(std::vector<CurvePoint> curve, errorCurve(model_.mt, ladder, context_));
    report_.curve = std::move(curve);
    std::vector<double> stated = options_.maxErrors;
    for (const double percent : options_.reliefShares) stated.push_back(percent / 100 * report_.relief);
    std::vector<double> tolerances = *checkedTolerances(std::move(stated));
    if (tolerances.empty()) tolerances = chosenTolerances(report_.curve, model_.mt, options_.mostTolerances);
    TinExtractor extractor(
        std::shared_ptr<const TerrainModel>(std::shared_ptr<void>(), &model_),  // this outlives it
        path("dem.amt"), {}, [&](const ExtractRequest& asked, double promised) {
          return fmt::format("arete measure {} {} --expect {}", shellQuoted(asked.output),
                             shellQuoted(report_.dem), promised);
        });
    for (std::size_t i = 0; i < tolerances.size(); ++i) {
      context_.report("extract", double(i) / double(tolerances.size()));
      ARETE_CHECK(interruptedIf(context_));
      ARETE_CHECK(take(extractor, tolerances[i], i >= firstPictured(tolerances.size())));
    }
    context_.report("extract", 1);
    return {};
  }

  /// For the parts of a step that reports its own progress.
  RunContext quiet() const {
    RunContext context = context_;
    context.progress = nullptr;
    return context;
  }

  /// The finest tolerances give lines too dense for a picture of the whole.
  static std::size_t firstPictured(std::size_t tolerances) {
    return tolerances > kTinPictures ? tolerances - kTinPictures : 0;
  }

  /// Cut, write, measure, certify.
  Status take(TinExtractor& extractor, double maxError, bool isPictured) {
    const Stopwatch watch;
    ARETE_TRY(Cut cut, takeCut(model_.mt, UniformError(maxError), {}, quiet()));
    const double seconds = watch.seconds();

    ExtractRequest request;
    request.criterion.maxError = maxError;
    const std::string name = fmt::format("tin-{:g}", maxError);
    request.output = written(name + ".ply");
    request.certificate = written(name + ".certificate.json");
    request.keepsMesh = isPictured;
    ARETE_TRY(ExtractedTin tin, extractor.extract(request, quiet(), std::move(cut)));
    const MeasureReport& measured = *tin.measured;

    DemoResult row;
    row.maxError = maxError;
    if (report_.relief > 0) row.percentOfRelief = 100 * maxError / report_.relief;
    row.triangles = static_cast<std::uint32_t>(tin.triangles);
    row.percentOfFinest = 100.0 * row.triangles / report_.finestTriangles;
    row.measuredMax = measured.maxAbsError;
    row.measuredRms = measured.rmsError;
    row.measuredMean = measured.meanError;
    row.uncovered = measured.uncovered;
    row.cutSeconds = seconds;
    row.isKept = tin.isKept;
    report_.results.push_back(row);
    report_.isolated = measured.isolated;
    if (isPictured) shown_.push_back({maxError, std::move(tin.mesh), measured, std::move(tin.errors)});
    return {};
  }

  std::string title(const std::string& what) const {
    return fs::path(report_.dem).filename().string() + ": " + what;
  }

  Status save(const Result<Canvas>& canvas, const std::string& name) {
    if (!canvas) return tl::unexpected(canvas.error());
    return canvas->savePng(written(name));
  }

  Status drawChart() {
    ChartSeries minimal{.name = "minimal cut"}, saturated{.name = "saturated cut", .dashed = true};
    for (const CurvePoint& p : report_.curve) {
      minimal.points.push_back({p.maxError, double(p.minimalTriangles)});
      saturated.points.push_back({p.maxError, double(p.saturatedTriangles)});
    }
    const std::vector<ChartSeries> series = {minimal, saturated};
    const std::string unit = report_.unit.empty() ? "" : ", " + report_.unit;
    return save(
        drawLogLogChart(series, {.title = title("triangles against tolerance"),
                                 .subtitle = fmt::format("one model, every tolerance; {} triangles at full "
                                                         "resolution",
                                                         countText(report_.finestTriangles)),
                                 .xLabel = "largest vertical error allowed" + unit,
                                 .yLabel = "triangles"}),
        "triangles.png");
  }

  Status drawMap() {
    const Shown& middle = shown_[shown_.size() / 2];
    RasterHeightfield errors;
    errors.columns = field_.columns;
    errors.rows = field_.rows;
    errors.georeference = field_.georeference;
    errors.heights = middle.errors;
    errors.source = report_.dem;
    return save(drawErrorMap(errors, {.width = options_.pictureWidth,
                                      .title = title("error of the TIN within " +
                                                     withUnit(middle.maxError, report_.unit)),
                                      .caption = {countText(middle.mesh.triangles.size()) +
                                                  " triangles   \u00b7   height of the TIN minus height of "
                                                  "the DEM, at every sample"},
                                      .unit = report_.unit,
                                      .limit = middle.maxError,
                                      .isDecorated = options_.isDecorated}),
                fmt::format("error-{:g}.png", middle.maxError));
  }

  Status drawTins() {
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      context_.report("draw", double(i) / double(shown_.size()));
      ARETE_CHECK(interruptedIf(context_));
      const Shown& s = shown_[i];
      Status status = save(drawTin(field_, s.mesh,
                                   {.width = options_.pictureWidth,
                                    .title = title("TIN within " + withUnit(s.maxError, report_.unit)),
                                    .tolerance = s.maxError,
                                    .measuredError = s.measured.maxAbsError,
                                    .finestTriangles = report_.finestTriangles,
                                    .isDecorated = options_.isDecorated}),
                           fmt::format("tin-{:g}.png", s.maxError));
      if (!status) return status;
    }
    context_.report("draw", 1);
    return {};
  }

  /// From the highest sample, where a person would climb.
  Status drawViewshed() {
    constexpr double kMetresUp = 2;
    const auto& z = field_.heights;
    std::size_t highest = 0;
    for (std::size_t i = 0; i < z.size(); ++i)
      if (!(z[i] <= z[highest]) && !std::isnan(z[i])) highest = i;
    // As the command asks by default.
    const bool isCurved = isOnEllipsoid(model_.georeference);
    ARETE_TRY(const std::unique_ptr<SightEarth> earth,
              isCurved ? makeEllipsoidEarth(model_, kUsualRefraction) : makePlaneEarth(model_));
    ARETE_TRY(const ViewshedMaker maker, ViewshedMaker::make(model_, *earth, {}, quiet()));
    const Vec2 place{double(highest % field_.columns), double(highest / field_.columns)};
    const double up = kMetresUp / field_.georeference.verticalUnitMetres;
    ARETE_TRY(const Viewshed viewshed, maker.from({place, z[highest] + up}, {}, quiet()));
    return save(
        drawViewshedMap(
            field_, viewshed.cells, {}, {{place}},
            {.width = options_.pictureWidth,
             .title = title("what is seen from the highest place, " + withUnit(z[highest], report_.unit)),
             .caption = {fmt::format("observer {} above the ground, target on the ground   \u00b7   {}",
                                     withUnit(up, report_.unit),
                                     earthWords(field_.georeference, isCurved, kUsualRefraction))},
             .isDecorated = options_.isDecorated}),
        "viewshed.png");
  }

  /// A machine without OpenGL has all of the demo but this.
  Status drawView() {
    const GroundHeights heights(model_);
    const CameraSpace space(model_);
    const MetricBox box = metricBox(model_);
    Camera camera = homeCamera(HomeView::overview, space, box);
    // A terrain too small to fly around is shown whole.
    if (const Result<FlightPlan> round = roundFlight(heights, space, box))
      if (const Result<Flight> flight = Flight::create(*round, space)) camera = flight->at(0);
    HeadlessOptions options;
    options.widthPixels = options_.pictureWidth;
    options.heightPixels = options_.pictureWidth * 9 / 16;
    options.settings.look.hazeKilometres = box.diagonal() / 1000;
    if (options_.isDecorated) options.decorations = Decorations();
    Result<HeadlessView> view = HeadlessView::create(model_, options, quiet());
    if (!view) {
      report_.warnings.push_back({WarningCode::display, "no view.png: " + view.error().describe()});
      return {};
    }
    ARETE_CHECK(view->draw(camera));
    ARETE_TRY(const Image picture, view->picture());
    return savePng(picture, written("view.png"));
  }

  const DemoOptions& options_;
  const RunContext& context_;
  Stopwatch all_;
  RasterHeightfield field_;
  TerrainModel model_;
  std::vector<Shown> shown_;
  DemoReport report_;
};

}  // namespace

Result<DemoReport> runDemo(const std::string& dem, const DemoOptions& options, const RunContext& context) {
  return Demo(options, context).run(dem);
}

std::string demoTable(const DemoReport& report) {
  const std::string unit = report.unit.empty() ? "" : ", " + report.unit;
  std::vector<std::vector<std::string>> rows = {{"tolerance" + unit, "triangles", "% of full",
                                                 "measured max" + unit, "RMS" + unit, "mean" + unit,
                                                 "uncovered", "cut, s", "% of relief"}};
  for (const DemoResult& r : report.results)
    rows.push_back({fmt::format("{:g}", r.maxError), std::to_string(r.triangles),
                    fmt::format("{:.3g}", r.percentOfFinest), fmt::format("{:.4g}", r.measuredMax),
                    fmt::format("{:.3g}", r.measuredRms), fmt::format("{:.3g}", r.measuredMean),
                    std::to_string(r.uncovered), fmt::format("{:.3f}", r.cutSeconds),
                    fmt::format("{:.3g}", r.percentOfRelief)});
  std::vector<std::size_t> width(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c)
      text += fmt::format("{}{:>{}}", c == 0 ? "" : "  ", row[c], width[c]);
    text += "\n";
  }
  return text;
}

}  // namespace arete
