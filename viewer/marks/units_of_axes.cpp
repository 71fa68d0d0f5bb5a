// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/marks/units_of_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer/scene/terrain_subject.h"

namespace arete {
namespace {

/// Of x and y of a map; empty for units without a name of their own.
std::string unitOfMap(const Georeference& map) {
  if (map.crsWkt.empty()) return {};
  if (map.isGeographic)
    return std::abs(map.angularUnitRadians * 180 / std::numbers::pi - 1) < 1e-9 ? " degrees" : "";
  if (map.linearUnitMetres == 1) return " m";
  // Feet, international and of the US survey.
  return std::abs(map.linearUnitMetres - 0.3048) < 1e-5 ? " ft" : "";
}

}  // namespace

std::array<std::string, 3> unitsOfAxes(const Subject& subject) {
  const std::string up = subject.heightUnit().empty() ? std::string() : " " + subject.heightUnit();
  const TerrainSubject* const terrain = subject.terrain();
  // The three axes of a surface have one unit.
  if (!terrain) return {up, up, up};
  const std::string map = unitOfMap(terrain->model().georeference);
  return {map, map, up};
}

std::string numberOf(double coordinate, double range) {
  if (!(range > 0) || !(std::abs(coordinate) < 1e15)) return fmt::format("{:.9g}", coordinate);
  const int decimals = std::clamp(4 - int(std::floor(std::log10(range))), 0, 15);
  std::string text = fmt::format("{:.{}f}", coordinate, decimals);
  if (decimals > 0) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

}  // namespace arete
