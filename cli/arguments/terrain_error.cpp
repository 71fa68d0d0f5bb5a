// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/terrain_error.h"

#include <fmt/format.h>

#include <cmath>

#include "io/files/text/stated_size.h"
#include "io/geo/crs/data_unit.h"
#include "terrain/model/relief.h"

namespace arete {
namespace {

constexpr const char* kOption = "--max-error";

}  // namespace

std::string TerrainError::text(const std::string& unit) const {
  return withReliefShare(value, unit, relief);
}

std::string TerrainError::shareText(const std::string& unit) const {
  return relief ? "; within " + text(unit) : std::string();
}

void TerrainError::addTo(Json& json) const {
  json["maxError"] = std::isfinite(value) ? Json(value) : Json();
  if (!relief) return;
  json["maxErrorPercent"] = *relief > 0 ? Json(100 * value / *relief) : Json();
  json["relief"] = *relief;
}

void addTerrainErrorTo(CLI::App& command, std::string& text, const std::string& help, bool mayBeInfinite) {
  command
      .add_option(kOption, text,
                  help +
                      ", in the DEM's unit of height or as E% of its relief, the highest minus the lowest\n"
                      "sample (default 0: full resolution)")
      ->check(shareOrTolerance(mayBeInfinite))
      ->type_name("E");
}

bool isAboveZero(const std::string& text) {
  const DataUnit any{1};  // whether it is above zero does not depend on the unit
  const Result<StatedSize> stated = parseStatedSize(text, kOption, &any);
  return stated && stated->number > 0;
}

Result<TerrainError> terrainErrorOf(const std::string& text, const AmtFile& file, const Session& session) {
  const DataUnit unit = heightUnitOf(file.model().georeference);
  ARETE_TRY(const StatedSize stated, parseStatedSize(text, kOption, &unit));
  if (!stated.isShare) return TerrainError{stated.number};
  // A file in pages says it of itself.
  if (file.summary().isThere()) return TerrainError{stated.of(file.summary().relief), file.summary().relief};
  ARETE_TRY(const TerrainModel whole, file.read({}, session.context()));
  const double relief = reliefOf(whole);
  return TerrainError{stated.of(relief), relief};
}

}  // namespace arete
