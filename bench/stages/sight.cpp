// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines of sight between places spread evenly over the DEM, by each method. Both ends stand between the
// ground and a height above it that leaves about a third of the lines clear. Lines of 2000 cells and more are
// those longer than that in rows and columns together; a DEM too small for them has none. Below the same
// lines whole profiles are taken.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "bench/sources.h"
#include "bench/stages/stages.h"
#include "bench/threads.h"
#include "datasets/random.h"
#include "terrain/sight/earth.h"
#include "terrain/sight/engine.h"
#include "terrain/sight/profile.h"

namespace arete::bench {
namespace {

constexpr std::size_t kLines = 2000;
constexpr double kLongCells = 2000;
constexpr double kClearShare = 1.0 / 3;

struct Ends {
  Vec2 from, to;
  double fromGround, toGround, fromShare, toShare;
};

std::vector<Ends> endsOn(const TerrainModel& model, const SightGrid& grid, double leastCells) {
  Random random(2);
  std::vector<Ends> ends;
  if (!(model.columns + model.rows > 2 * leastCells)) return ends;
  for (std::size_t tries = 0; ends.size() < kLines && tries < 100 * kLines; ++tries) {
    const auto place = [&] {
      return Vec2{random.between(0, model.columns - 1), random.between(0, model.rows - 1)};
    };
    Ends pair{place(), place(), 0, 0, random.between(0, 1), random.between(0, 1)};
    if (std::fabs(pair.from.x - pair.to.x) + std::fabs(pair.from.y - pair.to.y) < leastCells) continue;
    pair.fromGround = grid.at(pair.from);
    pair.toGround = grid.at(pair.to);
    if (!std::isnan(pair.fromGround + pair.toGround)) ends.push_back(pair);
  }
  return ends;
}

std::vector<SightLine> linesOf(const TerrainModel& model, const std::vector<Ends>& ends, double aboveGround) {
  const auto earth = makePlaneEarth(model);
  std::vector<SightLine> lines;
  for (const Ends& e : ends)
    if (auto track = earth->track(e.from, e.to))
      lines.emplace_back(std::move(*track), e.fromGround + aboveGround * e.fromShare,
                         e.toGround + aboveGround * e.toShare, model.georeference.verticalUnitMetres);
  return lines;
}

double clearShare(const SightEngine& engine, const std::vector<SightLine>& lines) {
  SightOptions options;
  options.wantsClearance = false;
  options.nodata = NodataSight::clear;
  double clear = 0;
  for (const SightLine& line : lines)
    clear += engine.answer(line, options).verdict == SightVerdict::visible ? 1 : 0;
  return clear / static_cast<double>(std::max<std::size_t>(1, lines.size()));
}

/// Microseconds for a thousand vertices.
double profileTime(const Profiles& profiles, const std::vector<SightLine>& lines, const Plan& plan) {
  std::size_t vertices = 0;
  for (const SightLine& line : lines) vertices += profiles.along(line.track()).vertices.size();
  const double seconds = medianSeconds(plan.repetition, [&] {
    double sum = 0;
    for (const SightLine& line : lines) sum += profiles.along(line.track()).gapMetres;
    return sum;
  });
  return seconds / static_cast<double>(vertices) * 1e9;
}

}  // namespace

Result<Figures> sightStage(const DemSource& source, const std::string& path, const Plan& plan) {
  ARETE_TRY(const TerrainModel model, loadModel(path));
  const auto limit = limitTo(1);
  const auto grid = std::make_shared<const SightGrid>(model);
  const auto pyramid = makeSightPyramid(grid);
  const double relief = model.mt.largestError();
  Figures figures;
  for (const bool isLong : {false, true}) {
    const std::vector<Ends> ends = endsOn(model, *grid, isLong ? kLongCells : 0);
    if (ends.empty()) continue;
    double low = 0, high = 20 * relief;
    for (int i = 0; i < 12; ++i) {
      const double middle = (low + high) / 2;
      (clearShare(*pyramid, linesOf(model, ends, middle)) < kClearShare ? low : high) = middle;
    }
    const std::vector<SightLine> lines = linesOf(model, ends, high);
    for (const char* what : {"verdict", "first obstruction", "clearance"}) {
      SightOptions options;
      options.wantsClearance = std::string_view(what) == "clearance";
      options.wantsObstruction = std::string_view(what) != "verdict";
      options.nodata = NodataSight::clear;
      double scanSeconds = 0;
      for (const SightMethod method :
           {SightMethod::scan, SightMethod::pyramid, SightMethod::descent, SightMethod::embree}) {
        ARETE_TRY(const auto engine, makeSightEngine(method, model, grid));
        double visited = 0;
        for (const SightLine& line : lines)
          visited += static_cast<double>(engine->answer(line, options).visited);
        const double seconds = medianSeconds(plan.repetition, [&] {
          double sum = 0;
          for (const SightLine& line : lines) sum += engine->answer(line, options).gapMetres;
          return sum;
        });
        if (method == SightMethod::scan) scanSeconds = seconds;
        const std::string variant =
            fmt::format("{}{}, {}", isLong ? "2000 cells and more, " : "", what, toString(method));
        const auto add = [&](const char* name, double value, const char* unit, Better better) {
          figures.push_back({source.name, "sight", variant, name, value, unit, better});
        };
        const auto count = static_cast<double>(lines.size());
        add("visited", visited / count, "", Better::lower);
        add("time", seconds / count * 1e6, "us/line", Better::lower);
        add("times the scan", scanSeconds / seconds, "", Better::higher);
      }
    }
    for (const bool overCells : {true, false})
      figures.push_back({source.name, "sight",
                         fmt::format("{}profile, {}", isLong ? "2000 cells and more, " : "",
                                     overCells ? "cells" : "descent"),
                         "time per 1000 vertices",
                         profileTime(overCells ? Profiles(model, grid) : Profiles(model), lines, plan), "us",
                         Better::lower});
  }
  return figures;
}

}  // namespace arete::bench
