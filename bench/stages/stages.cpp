// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which stage runs when, and in which process. A build is repeated in a new process each time, so that its
// peak memory is its own and no run inherits another's heap; figures of the repetitions become medians.
#include "bench/stages/stages.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "bench/forked.h"

namespace arete::bench {
namespace {

namespace fs = std::filesystem;

struct BuildVariant {
  HoleShape shape;
  int threads;  ///< 0 = all
  std::string name() const {
    return fmt::format("{}, {}", toString(shape), threads == 1 ? "1 thread" : "all threads");
  }
};

Result<Figures> inProcess(const std::string& dem, const std::function<Result<Figures>()>& stage) {
  const Result<Json> json = runForked([&]() -> Result<Json> {
    ARETE_TRY(const Figures figures, stage());
    return toJson(figures);
  });
  if (!json) return failure(json.error().code, json.error().message, dem);
  return figuresFromJson(*json);
}

/// The figures of all runs, each the median of its values.
Figures mediansOf(const std::vector<Figures>& runs) {
  Figures medians = runs.front();
  for (std::size_t i = 0; i < medians.size(); ++i) {
    std::vector<double> values;
    for (const Figures& run : runs) values.push_back(run[i].value);
    medians[i].value = medianOf(values);
  }
  return medians;
}

class DemRun {
 public:
  DemRun(const DemSource& source, const Plan& plan) : source_(source), plan_(plan) {}

  Result<Figures> run() {
    const Result<Figures> done = everything();
    std::error_code ignored;
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent})
      fs::remove(modelPath(shape), ignored);
    return done;
  }

 private:
  std::string modelPath(HoleShape shape) const {
    return (fs::path(plan_.scratch) / fmt::format("{}-{}-{}.amt", source_.name, toString(shape), parent_))
        .string();
  }

  Status add(const std::function<Result<Figures>()>& stage) {
    ARETE_TRY(Figures figures, inProcess(source_.name, stage));
    figures_.insert(figures_.end(), figures.begin(), figures.end());
    return {};
  }

  /// Builds as often as asked for and leaves the model.
  Status build(const BuildVariant& variant, int repeats, bool isMeasured) {
    std::vector<Figures> runs;
    const Stopwatch watch;
    do {
      ARETE_TRY(Figures run, inProcess(source_.name, [&] {
                  return buildOnce(source_, variant.shape, variant.threads, modelPath(variant.shape));
                }));
      for (Figure& f : run) f.variant = variant.name();
      runs.push_back(std::move(run));
    } while (int(runs.size()) < repeats && watch.seconds() < plan_.repetition.enoughSeconds);
    if (!isMeasured) return {};
    const Figures medians = mediansOf(runs);
    figures_.insert(figures_.end(), medians.begin(), medians.end());
    return {};
  }

  bool hasFidelity() const { return source_.side <= kLargestInFull; }

  Status buildAll(const std::vector<GreedyBaseline>& baselines) {
    // Some stages need a model but not its time, so a build may be needed and not measured.
    const bool isMeasured = plan_.wants("build");
    const bool isCompared = plan_.wants("triangles") && !baselines.empty();
    const bool needsDelaunay = isCompared || plan_.wants("file") || plan_.wants("cut") ||
                               plan_.wants("follow") || plan_.wants("height") || plan_.wants("export") ||
                               plan_.wants("measure") || plan_.wants("sight") || plan_.wants("viewshed") ||
                               plan_.wants("view");
    std::vector<BuildVariant> variants;
    if (isMeasured) variants.push_back({HoleShape::delaunay, 1});
    if (isMeasured || needsDelaunay) variants.push_back({HoleShape::delaunay, 0});
    if (hasFidelity() && (isMeasured || isCompared || plan_.wants("file")))
      variants.push_back({HoleShape::dataDependent, 0});
    for (const BuildVariant& variant : variants) {
      const int repeats = isMeasured ? plan_.repetition.most : 1;
      ARETE_CHECK(build(variant, repeats, isMeasured));
    }
    return {};
  }

  Result<Figures> everything() {
    const std::string delaunay = modelPath(HoleShape::delaunay),
                      fidelity = modelPath(HoleShape::dataDependent);
    std::vector<GreedyBaseline> baselines;
    // Baselines are of real DEMs, which have no side.
    if (plan_.wants("triangles") && source_.side == 0) {
      ARETE_TRY(const auto all, readBaselines(plan_.baselines));
      for (const GreedyBaseline& b : all)
        if (b.dem == source_.name) baselines.push_back(b);
    }
    Status status = add([&]() -> Result<Figures> {
      ARETE_CHECK(generateDem(source_));
      return plan_.wants("read") && !source_.isScattered ? readStage(source_, plan_) : Figures{};
    });
    if (status) status = buildAll(baselines);
    if (status && plan_.wants("file"))
      status = add([&] { return fileStage(source_, HoleShape::delaunay, delaunay, plan_); });
    if (status && plan_.wants("file") && hasFidelity())
      status = add([&] { return fileStage(source_, HoleShape::dataDependent, fidelity, plan_); });
    if (source_.isScattered) return finished(status);
    // All further stages are of rasters.
    if (status && plan_.wants("cut")) status = add([&] { return cutStage(source_, delaunay, plan_); });
    if (status && plan_.wants("follow")) status = add([&] { return followStage(source_, delaunay, plan_); });
    if (status && plan_.wants("height")) status = add([&] { return heightStage(source_, delaunay, plan_); });
    if (status && plan_.wants("sight")) status = add([&] { return sightStage(source_, delaunay, plan_); });
    if (status && plan_.wants("viewshed"))
      status = add([&] { return viewshedStage(source_, delaunay, plan_); });
    if (status && plan_.wants("view")) status = add([&] { return viewStage(source_, delaunay, plan_); });
    if (status && plan_.wants("export")) status = add([&] { return exportStage(source_, delaunay, plan_); });
    if (status && plan_.wants("measure"))
      status = add([&] { return measureStage(source_, delaunay, plan_); });
    if (status && !baselines.empty())
      status = add([&] { return trianglesStage(source_, delaunay, fidelity, baselines); });
    if (status && plan_.wants("rival") && !plan_.hmm.empty()) {
      ARETE_TRY(const Figures figures, rivalStage(source_, plan_));
      figures_.insert(figures_.end(), figures.begin(), figures.end());
    }
    return finished(status);
  }

  Result<Figures> finished(const Status& status) {
    if (!status) return tl::unexpected(status.error());
    return std::move(figures_);
  }

  const DemSource& source_;
  const Plan& plan_;
  const pid_t parent_ = getpid();  // the children have numbers of their own
  Figures figures_;
};

}  // namespace

bool Plan::wants(const std::string& stage) const {
  return only.empty() || std::find(only.begin(), only.end(), stage) != only.end();
}

const std::vector<std::string>& stageNames() {
  static const std::vector<std::string> names = {"read",    "build",     "file",     "cut",     "follow",
                                                 "height",  "sight",     "viewshed", "view",    "export",
                                                 "measure", "triangles", "rival",    "surface", "machine"};
  return names;
}

Result<Figures> measureDem(const DemSource& source, const Plan& plan) {
  return DemRun(source, plan).run();
}

Result<Figures> measureMesh(const MeshSource& source, const Plan& plan) {
  return inProcess(source.name, [&] { return surfaceStage(source, plan); });
}

Result<Figures> measureSurfaceMemory(const Plan& plan) {
  return surfaceMemoryStage(plan);
}

Result<Figures> measureMachine(const Plan& plan) {
  return inProcess("this machine", [&]() -> Result<Figures> { return machineStage(plan); });
}

Figures geometricMeans(const Figures& figures) {
  Figures means;
  std::vector<int> counts;
  for (const Figure& f : figures) {
    if ((f.stage != "triangles" && f.stage != "surface") || f.better != Better::lower ||
        f.name.rfind("ratio", 0) != 0)
      continue;
    auto mean = std::find_if(means.begin(), means.end(), [&](const Figure& m) { return m.name == f.name; });
    if (mean == means.end()) {
      mean = means.insert(means.end(),
                          {"geometric mean", f.stage, "all of the above", f.name, 0, f.unit, f.better});
      counts.push_back(0);
    }
    mean->value += std::log(f.value);
    ++counts[std::size_t(mean - means.begin())];
  }
  for (std::size_t i = 0; i < means.size(); ++i) means[i].value = std::exp(means[i].value / counts[i]);
  return means;
}

}  // namespace arete::bench
