// SPDX-License-Identifier: GPL-3.0-or-later
//
// A flight over the DEM and a cut for every frame, on one thread: 60 frames a second, 150 metres a second,
// 200 metres above the ground, turning by 20 degrees a second all the time, a quarter circle to the right and
// one to the left; the tolerance is 1 pixel of 1920 x 1080. Every way of taking the cuts flies it alone, so
// that none finds the caches as another left them. Whether the cuts are those from scratch is asked outside
// the time.
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>

#include "bench/sources.h"
#include "bench/stages/stages.h"
#include "bench/threads.h"
#include "engine/criteria/view_error.h"
#include "engine/follow/incremental_cut.h"
#include "terrain/locate/ground_height.h"
#include "terrain/model/camera.h"

namespace arete::bench {
namespace {

constexpr int kFrames = 1000;
constexpr double kFramesPerSecond = 60, kMetresPerSecond = 150, kDegreesPerSecond = 20, kAboveGround = 200,
                 kPixels = 1, kDeadlineMilliseconds = 4;

/// From the middle of the DEM. Near its borders the camera goes on turning the same way.
Result<std::vector<View>> viewsOfFlight(const TerrainModel& model) {
  const GroundHeights heights(model);
  const MetricFrame& metric = model.mt.metric();
  Vec2 plan = model.toPlan(model.toSource({0.5 * (model.columns - 1), 0.5 * (model.rows - 1)}));
  double azimuth = 30, turned = 0, turn = kDegreesPerSecond / kFramesPerSecond, ground = 0;
  std::vector<View> views;
  while (views.size() < std::size_t(kFrames)) {
    Camera camera{.xy = model.toSource(plan), .azimuthDegrees = azimuth, .pitchDegrees = -8};
    if (const auto surface = heights.at(camera.xy)) ground = surface->height;
    camera.height = ground + kAboveGround / model.georeference.verticalUnitMetres;
    ARETE_TRY(const View view, viewOf(camera, model));
    views.push_back(view);
    const double step = kMetresPerSecond / kFramesPerSecond / std::hypot(view.forward.x, view.forward.y);
    plan = {plan.x + step * view.forward.x / metric.scale.x, plan.y + step * view.forward.y / metric.scale.y};
    const bool isInside = plan.x > 0.1 * model.columns && plan.x < 0.9 * model.columns &&
                          plan.y > 0.1 * model.rows && plan.y < 0.9 * model.rows;
    azimuth += turn;
    turned += std::abs(turn);
    if (turned < 90 || !isInside) continue;
    turned = 0;
    turn = -turn;
  }
  return views;
}

/// Of this thread's own: other processes of a busy machine do not count.
double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

class FollowStage {
 public:
  FollowStage(const DemSource& source, const MultiTriangulation& mt, std::vector<View> views)
      : source_(source), mt_(mt), views_(std::move(views)) {}

  Result<Figures> run() {
    const CutOptions saturated{.method = CutMethod::saturated};
    fromScratch("minimal, from scratch", {});
    const double scratch = fromScratch("saturated, from scratch", saturated);
    const double scratchFront = front("saturated, from scratch, with its front", saturated);
    const std::vector<double> triangles = follow("followed", [] { return IncrementalOptions{}; });
    add("followed", "times as fast as from scratch", scratch / median_, "", Better::higher);
    add("followed", "times as fast as from scratch with its front", scratchFront / median_, "",
        Better::higher);
    add("followed", "frames unlike from scratch", unlike(saturated, {}), "", Better::lower);
    follow("followed, 4 ms", [] {
      return IncrementalOptions{
          .deadline = Deadline::in(std::chrono::duration<double, std::milli>(kDeadlineMilliseconds))};
    });
    // A budget that binds in every frame.
    const auto half = std::max(mt_.rootTriangleCount(), std::uint32_t(quantile(triangles, 0) / 2));
    follow("followed, half of the triangles", [&] { return IncrementalOptions{.maxTriangles = half}; });
    if (failed_) return tl::unexpected(*failed_);
    return figures_;
  }

 private:
  void add(const std::string& variant, const char* name, double value, const char* unit, Better better) {
    figures_.push_back({source_.name, "follow", variant, name, value, unit, better});
  }

  ViewError criterionOf(const View& view) const {
    return ViewError({.view = view, .pixels = kPixels}, mt_.metric());
  }

  /// Times work(criterion) for every frame. Returns the median of its milliseconds.
  double time(const std::string& variant, const std::function<Status(const ViewError&)>& work) {
    std::vector<double> milliseconds;
    for (const View& view : views_) {
      const ViewError criterion = criterionOf(view);
      const double begin = threadSeconds();
      const Status done = work(criterion);
      milliseconds.push_back((threadSeconds() - begin) * 1e3);
      if (!done) failed_ = done.error();
    }
    milliseconds.erase(milliseconds.begin());  // following, it starts at the root
    median_ = quantile(milliseconds, 0.5);
    add(variant, "median", median_, "ms", Better::lower);
    add(variant, "99 %", quantile(milliseconds, 0.99), "ms", Better::lower);
    return median_;
  }

  double fromScratch(const std::string& variant, const CutOptions& options) {
    return time(variant, [&](const ViewError& criterion) -> Status {
      const auto cut = takeNodes(mt_, criterion, options);
      return cut ? Status{} : tl::unexpected(cut.error());
    });
  }

  double front(const std::string& variant, const CutOptions& options) {
    return time(variant, [&](const ViewError& criterion) -> Status {
      const auto cut = takeCut(mt_, criterion, options);
      return cut ? Status{} : tl::unexpected(cut.error());
    });
  }

  /// Returns the triangles of every frame.
  std::vector<double> follow(const std::string& variant, const std::function<IncrementalOptions()>& options) {
    IncrementalCut cut(mt_);
    std::vector<double> triangles, steps;
    int incomplete = 0;
    time(variant, [&](const ViewError& criterion) -> Status {
      ARETE_TRY(const auto update, cut.update(criterion, options()));
      triangles.push_back(double(cut.triangles().size()));
      steps.push_back(double(cut.lastSteps().size()));
      incomplete += update.isComplete ? 0 : 1;
      return {};
    });
    add(variant, "triangles", quantile(triangles, 0.5), "", Better::neither);
    add(variant, "modifications", quantile(steps, 0.5), "", Better::neither);
    if (options().deadline) add(variant, "frames not finished", incomplete, "", Better::lower);
    return triangles;
  }

  int unlike(const CutOptions& scratch, const IncrementalOptions& followed) {
    IncrementalCut cut(mt_);
    int different = 0;
    for (const View& view : views_) {
      const ViewError criterion = criterionOf(view);
      const auto expected = takeNodes(mt_, criterion, scratch);
      const auto update = cut.update(criterion, followed);
      if (!expected || !update) return kFrames;
      different += cut.nodes() != expected->nodes ? 1 : 0;
    }
    return different;
  }

  const DemSource& source_;
  const MultiTriangulation& mt_;
  const std::vector<View> views_;
  Figures figures_;
  double median_ = 0;
  std::optional<Error> failed_;
};

}  // namespace

Result<Figures> followStage(const DemSource& source, const std::string& path, const Plan&) {
  ARETE_TRY(const TerrainModel model, loadModel(path));
  ARETE_TRY(std::vector<View> views, viewsOfFlight(model));
  const auto limit = limitTo(1);
  return FollowStage(source, model.mt, std::move(views)).run();
}

}  // namespace arete::bench
