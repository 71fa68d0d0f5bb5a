// SPDX-License-Identifier: GPL-3.0-or-later
//
// A flight over the DEM, a cut for every frame: from scratch, and by a cut that follows. The camera wanders
// at random 300 metres above the ground and turns back at the borders; the tolerance is 2 pixels of 1080.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>

#include "bench/stages.h"
#include "bench/threads.h"
#include "datasets/random.h"
#include "engine/incremental_cut.h"
#include "engine/view_error.h"
#include "io/amt_file.h"
#include "terrain/camera.h"
#include "terrain/surface_height.h"

namespace arete::bench {
namespace {

constexpr int kFrames = 1000, kFramesOfGenerated = 200;
constexpr double kAboveGround = 300, kPixels = 2, kDeadlineMilliseconds = 5;

class Flight {
 public:
  explicit Flight(const TerrainModel& model) : model_(model), heights_(model) {
    grid_ = {0.5 * (model.columns - 1), 0.5 * (model.rows - 1)};
  }

  Result<View> next() {
    azimuth_ += random_.between(-8, 8);
    const double step = 0.0007 * std::max(model_.columns, model_.rows);
    const double x = grid_.x + step * std::sin(azimuth_ * kRadians),
                 y = grid_.y - step * std::cos(azimuth_ * kRadians);
    const bool isInside = x > 0.1 * model_.columns && x < 0.9 * model_.columns && y > 0.1 * model_.rows &&
                          y < 0.9 * model_.rows;
    if (isInside)
      grid_ = {x, y};
    else
      azimuth_ += 20;
    Camera camera{.xy = model_.toSource(grid_), .azimuthDegrees = azimuth_, .pitchDegrees = -8};
    if (const auto ground = heights_.at(camera.xy)) ground_ = 0.9 * ground_ + 0.1 * ground->height;
    camera.height = ground_ + kAboveGround / model_.georeference.verticalUnitMetres;
    return viewOf(camera, model_);
  }

 private:
  static constexpr double kRadians = std::numbers::pi / 180;
  const TerrainModel& model_;
  const SurfaceHeights heights_;
  Random random_{1};
  Vec2 grid_;
  double azimuth_ = 30, ground_ = 0;
};

struct Times {
  std::vector<double> milliseconds, triangles;
  template <class Work>
  auto time(const Work& work) {
    const Stopwatch watch;
    auto result = work();
    milliseconds.push_back(watch.seconds() * 1e3);
    return result;
  }
};

double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[std::size_t(part * double(values.size() - 1))];
}

}  // namespace

Result<Figures> followStage(const DemSource& source, const std::string& path, const Plan&) {
  AmtLoadOptions trusted;  // the model was written by this very run
  trusted.verify = AmtVerify::none;
  const Result<TerrainModel> model = loadAmt(path, trusted);
  if (!model) return tl::unexpected(model.error());
  const MultiTriangulation& mt = model->mt;
  enum Variant { minimal, saturated, followedExactly, followed, followedSaturated, inTime, kVariants };
  std::array<Times, kVariants> times;
  std::array<IncrementalCut, 4> cuts = {IncrementalCut(mt), IncrementalCut(mt), IncrementalCut(mt),
                                        IncrementalCut(mt)};
  std::vector<double> excess, steps;
  int different = 0, incomplete = 0;
  Flight flight(*model);
  const int frames = source.side == 0 ? kFrames : kFramesOfGenerated;
  for (int frame = 0; frame < frames; ++frame) {
    const Result<View> view = flight.next();
    if (!view) return tl::unexpected(view.error());
    const ViewError criterion({.view = *view, .pixels = kPixels}, mt.arrays().metric);
    const auto least = times[minimal].time([&] { return takeNodes(mt, criterion); });
    const auto all =
        times[saturated].time([&] { return takeNodes(mt, criterion, {.method = CutMethod::saturated}); });
    const auto exactly = times[followedExactly].time([&] { return cuts[0].update(criterion); });
    const auto quickly = times[followed].time([&] { return cuts[1].update(criterion, {.exact = false}); });
    const auto wholly = times[followedSaturated].time(
        [&] { return cuts[2].update(criterion, {.method = CutMethod::saturated}); });
    const auto soon = times[inTime].time([&] {
      return cuts[3].update(
          criterion,
          {.deadline = Deadline::in(std::chrono::duration<double, std::milli>(kDeadlineMilliseconds)),
           .exact = false});
    });
    for (const auto* failed : {&exactly, &quickly, &wholly, &soon})
      if (!*failed) return tl::unexpected(failed->error());
    if (!least || !all) return tl::unexpected((least ? all : least).error());
    different += cuts[0].nodes() != least->nodes || cuts[2].nodes() != all->nodes ? 1 : 0;
    incomplete += soon->isComplete ? 0 : 1;
    const double n = double(cuts[0].triangles().size());
    excess.push_back(100 * (double(cuts[1].triangles().size()) / n - 1));
    steps.push_back(double(cuts[2].lastSteps().size()));
    for (const auto& [variant, cut] : {std::pair(minimal, 0),
                                       {saturated, 2},
                                       {followedExactly, 0},
                                       {followed, 1},
                                       {followedSaturated, 2},
                                       {inTime, 3}})
      times[variant].triangles.push_back(double(cuts[std::size_t(cut)].triangles().size()));
  }
  Figures figures;
  const std::array names = {"minimal, from scratch", "saturated, from scratch", "minimal, followed exactly",
                            "minimal, followed",     "saturated, followed",     "minimal, followed, 5 ms"};
  for (std::size_t v = 0; v < kVariants; ++v) {
    const auto add = [&](const char* name, double value, const char* unit, Better better) {
      figures.push_back({source.name, "follow", names[v], name, value, unit, better});
    };
    // The first frame starts at the root.
    const std::vector<double> later(times[v].milliseconds.begin() + 1, times[v].milliseconds.end());
    add("triangles", quantile(times[v].triangles, 0.5), "", Better::neither);
    add("median", quantile(later, 0.5), "ms", Better::lower);
    add("99 %", quantile(later, 0.99), "ms", Better::lower);
    if (v == followedExactly) add("frames unlike from scratch", different, "", Better::lower);
    if (v == followed) {
      add("excess, median", quantile(excess, 0.5), "%", Better::lower);
      add("excess, worst", quantile(excess, 1), "%", Better::lower);
    }
    if (v == followedSaturated) add("modifications", quantile(steps, 0.5), "", Better::neither);
    if (v == inTime) add("frames not finished", incomplete, "", Better::lower);
  }
  return figures;
}

}  // namespace arete::bench
