// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/terrain_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arete {
namespace {

constexpr const char* kSight = "line of sight";
constexpr const char* kViewshed = "viewshed";

}  // namespace

TerrainTools::TerrainTools(const TerrainSubject& subject, Layers& layers)
    : places(subject.profiles().heights()),
      sights(subject.model(), subject.profiles()),
      subject_(subject),
      layers_(layers) {}

std::string TerrainTools::add(const Pick& pick) {
  if (picks.size() >= 2) picks.clear();
  picks.push_back(pick);
  return updateSight();
}

std::string TerrainTools::updateSight() {
  sight.reset();
  layers_.remove(kSight);
  if (picks.size() < 2) return {};
  auto found = sights.between(picks[0], observerAbove, picks[1], targetAbove);
  if (!found) return found.error().describe();
  sight = std::move(*found);
  SpaceVertices lines;
  for (const SightPiece& piece : piecesOf(*sight)) lines.addLine(piece.from, piece.to, piece.color);
  layers_.put(kSight, std::move(lines));
  return {};
}

void TerrainTools::clear() {
  picks.clear();
  updateSight();
  viewshed.cancel();
  overlay.reset();
  layers_.remove(kViewshed);
}

std::string TerrainTools::startViewshed() {
  if (picks.empty()) return "a viewshed is seen from a pick: click on the terrain first";
  const Pick& from = picks.back();
  viewshed.start(model(), sights.earth(), {sightPlan(model(), from.xy), from.height + observerAbove},
                 targetAbove, mostOverlayPixels);
  return {};
}

std::string TerrainTools::step() {
  auto done = viewshed.take();
  if (!done) return {};
  if (!*done) return done->error().describe();
  overlay = std::move(**done);
  layers_.put(kViewshed, overlay->picture).legend = overlayLegend();
  return fmt::format("{:.1f} % of the samples are seen",
                     100 * double(overlay->seen) / std::max(1.0, double(overlay->cells)));
}

double usualContourInterval(double heightRange) {
  if (!(heightRange > 0)) return 1;
  // The leading digits become the nearest of 1, 2, 5 and 10.
  const double rough = heightRange / 12, power = std::pow(10, std::floor(std::log10(rough)));
  const double lead = rough / power;
  return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

}  // namespace arete
