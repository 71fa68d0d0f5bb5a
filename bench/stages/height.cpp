// SPDX-License-Identifier: GPL-3.0-or-later
//
// Heights at a million places spread evenly over the DEM, in no order: what sorting them along a curve takes
// is in the time.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bench/sources.h"
#include "bench/stages/stages.h"
#include "bench/threads.h"
#include "datasets/random.h"
#include "terrain/locate/ground_height.h"

namespace arete::bench {
namespace {

constexpr std::size_t kPlaces = 1'000'000;

std::vector<Vec2> placesOn(const TerrainModel& model) {
  Random random(1);
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < kPlaces; ++i)
    places.push_back(
        model.toSource({random.between(0, model.columns - 1), random.between(0, model.rows - 1)}));
  return places;
}

}  // namespace

Result<Figures> heightStage(const DemSource& source, const std::string& path, const Plan& plan) {
  ARETE_TRY(const TerrainModel model, loadModel(path));
  const GroundHeights heights(model);
  const std::vector<Vec2> places = placesOn(model);
  Figures figures;
  std::vector<double> tolerances = {0};
  tolerances.insert(tolerances.end(), source.tolerances.begin(), source.tolerances.end());
  for (const double tolerance : tolerances)
    for (const int threads : {1, 0}) {
      const auto limit = limitTo(threads);
      ARETE_TRY(const auto answers, heights.at(places, tolerance, onThreads(threads)));
      double visited = 0, found = 0;
      for (const auto& answer : answers)
        if (answer) {
          visited += answer->nodesVisited;
          ++found;
        }
      const double seconds =
          medianSeconds(plan.repetition, [&] { return heights.at(places, tolerance, onThreads(threads)); });
      const std::string resolution =
          tolerance > 0 ? fmt::format("within {:g}", tolerance) : "full resolution";
      const std::string variant = fmt::format("{}, {}", resolution, threadsText(threads));
      const auto add = [&](const char* name, double value, const char* unit, Better better) {
        figures.push_back({source.name, "height", variant, name, value, unit, better});
      };
      add("nodes", visited / std::max(1.0, found), "", Better::lower);
      add("time", seconds, "s", Better::lower);
      add("rate", double(kPlaces) / seconds, "places/s", Better::higher);
    }
  return figures;
}

}  // namespace arete::bench
