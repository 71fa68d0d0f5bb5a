// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a finished model answers: cuts, exports, measurements. "MT triangles tested" are the triangle ids of
// the root and of the nodes in the cut: each is tested for its remover, and those that pass are written, all
// of which is in the time, as is the memory for the result.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "bench/sources.h"
#include "bench/stages/stages.h"
#include "bench/threads.h"
#include "engine/criteria/criterion.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "io/formats/exchange/export_tin.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/store/amt/file.h"
#include "terrain/locate/ground_height.h"
#include "terrain/measure/measure.h"
#include "terrain/model/camera.h"

namespace arete::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kViewTriangles = 200'000, kUniformTriangles[] = {100'000, 1'000'000};
constexpr Repetition kShort = {9, 20};  // for what takes milliseconds

/// A box of a tenth of the raster in its middle.
Region middle(const TerrainModel& model) {
  const double halfSide = 0.5 * std::sqrt(0.1);
  const double c = (model.columns - 1) * halfSide, r = (model.rows - 1) * halfSide;
  const double x = (model.columns - 1) / 2.0, y = (model.rows - 1) / 2.0;
  return Region::box({x - c, y - r, x + c, y + r});
}

class CutStage {
 public:
  CutStage(const DemSource& source, const TerrainModel& model, const Plan& plan)
      : source_(source), model_(model), plan_(plan) {}

  Result<Figures> run() {
    for (const int threads : {1, 0}) {
      const auto limit = limitTo(threads);
      for (const double e : source_.tolerances)
        saturated(fmt::format("saturated, {:g}, {}", e, threadsText(threads)), e);
      saturated(fmt::format("saturated, finest, {}", threadsText(threads)), 0);
    }
    for (const std::size_t triangles : kUniformTriangles) ARETE_CHECK(uniform(triangles));
    for (const double e : source_.tolerances)
      ARETE_CHECK(general(fmt::format("minimal, {:g}", e), UniformError(e), {}));
    const double inside = source_.tolerances.front(), outside = source_.tolerances.back();
    const RegionError region(middle(model_), model_.mt.metric(), inside, outside);
    for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
      const char* name = method == CutMethod::minimal ? "minimal" : "saturated";
      const std::string variant =
          fmt::format("{}, region of a tenth, {:g} and {:g} outside", name, inside, outside);
      ARETE_CHECK(general(variant, region, {.method = method}));
    }
    ARETE_CHECK(view());
    const std::uint32_t budget =
        std::max(model_.mt.rootTriangleCount(), model_.mt.finestTriangleCount() / 100);
    for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
      const char* name = method == CutMethod::minimal ? "minimal" : "saturated";
      ARETE_CHECK(general(fmt::format("{}, budget of 1 %", name), UniformError(0),
                          {.method = method, .maxTriangles = budget}));
    }
    return std::move(figures_);
  }

 private:
  void add(const std::string& variant, const char* name, double value, const char* unit, Better better) {
    figures_.push_back({source_.name, "cut", variant, name, value, unit, better});
  }

  void saturated(const std::string& variant, double maxError) {
    const MultiTriangulation& mt = model_.mt;
    const UniformError criterion(maxError);
    const CutOptions options{.method = CutMethod::saturated};
    const Result<Cut> cut = takeCut(mt, criterion, options);
    double tested = mt.rootTriangleCount();
    for (std::size_t v = mt.rootVertexCount(); v < cut->vertices.size(); ++v)
      tested += mt.slotCount(NodeId(cut->vertices[v] - mt.rootVertexCount()));
    const double seconds = medianSeconds(kShort, [&] { return takeCut(mt, criterion, options); });
    add(variant, "triangles", double(cut->triangles.size()), "", Better::neither);
    add(variant, "time", seconds * 1e3, "ms", Better::lower);
    add(variant, "tested", tested / seconds / 1e6, "million/s", Better::higher);
  }

  /// Uniform cuts of so many triangles, if the model has twice as many.
  Status uniform(std::size_t triangles) {
    if (model_.mt.finestTriangleCount() < 2 * triangles) return {};
    const auto within = [](double error) { return UniformError(error); };
    for (const CutMethod method : {CutMethod::saturated, CutMethod::minimal}) {
      const char* const name = method == CutMethod::saturated ? "saturated" : "minimal";
      const std::string variant = fmt::format("{}, {} triangles", name, triangles);
      ARETE_CHECK(ofSize(variant, triangles, {.method = method}, 1e-6, 1e6, within));
    }
    return {};
  }

  /// From 300 m above the middle, with the pixels of error that make a cut of kViewTriangles.
  Status view() {
    const Vec2 middleOf{0.5 * (model_.columns - 1), 0.5 * (model_.rows - 1)};
    Camera camera{.xy = model_.toSource(middleOf), .azimuthDegrees = 30, .pitchDegrees = -8};
    const auto ground = GroundHeights(model_).at(camera.xy);
    camera.height = (ground ? ground->height : 0) + 300 / model_.georeference.verticalUnitMetres;
    ARETE_TRY(const View seen, viewOf(camera, model_));
    const auto withPixels = [&](double pixels) {
      return ViewError({.view = seen, .pixels = pixels}, model_.mt.metric());
    };
    return ofSize("saturated, view", kViewTriangles, {.method = CutMethod::saturated}, 1e-3, 1e3, withPixels);
  }

  /// Cuts of no more than so many triangles, by each number of threads. criterionOf(bound): the least bound
  /// is looked for, between a fine one that takes more triangles and a coarse one that does not.
  template <class CriterionOf>
  Status ofSize(const std::string& variant, std::size_t triangles, const CutOptions& options, double fine,
                double coarse, const CriterionOf& criterionOf) {
    for (int step = 0; step < 30; ++step) {
      const double bound = std::sqrt(fine * coarse);
      ARETE_TRY(const Cut cut, takeCut(model_.mt, criterionOf(bound), options));
      (cut.triangles.size() > triangles ? fine : coarse) = bound;
    }
    const auto criterion = criterionOf(coarse);
    ARETE_TRY(const Cut cut, takeCut(model_.mt, criterion, options));
    for (const int threads : {1, 0}) {
      const auto limit = limitTo(threads);
      const double seconds = medianSeconds(kShort, [&] { return takeCut(model_.mt, criterion, options); });
      const std::string byThreads = fmt::format("{}, {}", variant, threadsText(threads));
      add(byThreads, "triangles", double(cut.triangles.size()), "", Better::neither);
      add(byThreads, "time", seconds * 1e3, "ms", Better::lower);
    }
    return {};
  }

  Status general(const std::string& variant, const Criterion& criterion, const CutOptions& options) {
    ARETE_TRY(const Cut cut, takeCut(model_.mt, criterion, options));
    const double seconds =
        medianSeconds(plan_.repetition, [&] { return takeCut(model_.mt, criterion, options); });
    add(variant, "triangles", double(cut.triangles.size()), "", Better::neither);
    add(variant, "time", seconds * 1e3, "ms", Better::lower);
    if (options.maxTriangles) add(variant, "achieved error", cut.achievedError, "", Better::lower);
    return {};
  }

  const DemSource& source_;
  const TerrainModel& model_;
  const Plan& plan_;
  Figures figures_;
};

}  // namespace

Result<Figures> cutStage(const DemSource& source, const std::string& path, const Plan& plan) {
  ARETE_TRY(const TerrainModel model, loadModel(path));
  return CutStage(source, model, plan).run();
}

// Only the writing is timed: the cut is taken before. The file is removed, and its size gives the rate.
Result<Figures> exportStage(const DemSource& source, const std::string& path, const Plan& plan) {
  ARETE_TRY(const TerrainModel model, loadModel(path));
  const double tolerance = source.tolerances.front();
  ARETE_TRY(const Cut cut, takeCut(model.mt, UniformError(tolerance)));
  const std::string file = path + ".ply";
  Status status;
  const double seconds = medianSeconds(plan.repetition, [&] {
    const TinExport tin = exportTin(model, cut).value();
    MeshWriteOptions options;
    options.triangleErrors = tin.errors;
    options.crsWkt = model.georeference.crsWkt;
    const auto written = writeMesh(tin.mesh, file, options);
    status = written ? Status() : Status(tl::unexpected(written.error()));
    return status.has_value();
  });
  if (!status) return tl::unexpected(status.error());
  std::error_code ignored;
  const double bytes = double(fs::file_size(file, ignored));
  fs::remove(file, ignored);
  const double triangles = double(cut.triangles.size());
  const std::string variant = fmt::format("PLY, {:g}", tolerance);
  return Figures{{source.name, "export", variant, "triangles", triangles, "", Better::neither},
                 {source.name, "export", variant, "time", seconds, "s", Better::lower},
                 {source.name, "export", variant, "rate", bytes / seconds / 1e6, "MB/s", Better::higher}};
}

// The measurement that is timed is also checked: a result that breaks its promise fails the stage.
Result<Figures> measureStage(const DemSource& source, const std::string& path, const Plan& plan) {
  ARETE_TRY(const TerrainModel model, loadModel(path));
  ARETE_TRY(const RasterHeightfield field, readField(source));
  const double tolerance = source.tolerances[source.tolerances.size() / 2];
  ARETE_TRY(const Cut cut, takeCut(model.mt, UniformError(tolerance)));
  const TinExport tin = exportTin(model, cut).value();
  ARETE_TRY(const MeasureReport report, measure(tin.mesh, field));
  ARETE_CHECK(checkPromise(report, tolerance));
  Figures figures;
  for (const int threads : {1, 0}) {
    const auto limit = limitTo(threads);
    const double seconds =
        medianSeconds(plan.repetition, [&] { return measure(tin.mesh, field, {}, onThreads(threads)); });
    const std::string variant = fmt::format("{:g}, {}", tolerance, threadsText(threads));
    figures.push_back({source.name, "measure", variant, "time", seconds, "s", Better::lower});
    figures.push_back({source.name, "measure", variant, "rate", double(report.valid) / seconds, "samples/s",
                       Better::higher});
  }
  return figures;
}

// Two models of the same terrain are compared with counts of other programs; each count is of a mesh that
// keeps the tolerance.
Result<Figures> trianglesStage(const DemSource& source, const std::string& delaunay,
                               const std::string& fidelity, const std::vector<GreedyBaseline>& baselines) {
  ARETE_TRY(const RasterHeightfield field, readField(source));
  const Result<TerrainModel> models[] = {loadModel(delaunay), loadModel(fidelity)};
  const char* names[] = {"Delaunay", "fidelity"};
  Figures figures;
  for (const GreedyBaseline& baseline : baselines) {
    const std::string variant = fmt::format("{:g} m", baseline.tolerance);
    const auto add = [&](const std::string& name, double value, Better better) {
      figures.push_back({source.name, "triangles", variant, name, value, "", better});
    };
    add("best greedy insertion", baseline.triangles, Better::neither);
    for (std::size_t i = 0; i < 2; ++i) {
      if (!models[i]) return tl::unexpected(models[i].error());
      ARETE_TRY(const Cut cut, takeCut(models[i]->mt, UniformError(baseline.tolerance)));
      // A count that does not keep its tolerance is worth nothing.
      ARETE_TRY(const MeasureReport report, measure(exportTin(*models[i], cut)->mesh, field));
      ARETE_CHECK(checkPromise(report, baseline.tolerance));
      const double count = double(cut.triangles.size());
      add(names[i], count, Better::lower);
      add(fmt::format("ratio, {}", names[i]), count / baseline.triangles, Better::lower);
    }
    add("Delaunay, saturated", uniformTriangleCount(models[0]->mt, baseline.tolerance), Better::lower);
  }
  return figures;
}

}  // namespace arete::bench
